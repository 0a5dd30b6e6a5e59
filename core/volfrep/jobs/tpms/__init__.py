# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whole jobs with walls in place of struts."""
