# SPDX-License-Identifier: LGPL-2.1-or-later
"""Predictions beside printed and tested specimens: `specimens.toml`, and what is made of it."""
