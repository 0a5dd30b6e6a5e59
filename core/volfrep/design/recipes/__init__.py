# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specifications to start from, one a file; `parameters.recipes` finds them by their names."""
