# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whole jobs with networks in place of cells."""
