# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strut radii for load cases, and what the struts carry."""
