# SPDX-License-Identifier: LGPL-2.1-or-later
"""Skins that are not alike everywhere: faces with their own thickness, and what stays solid."""
