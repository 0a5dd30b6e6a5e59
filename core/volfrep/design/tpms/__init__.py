# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls in place of struts: surfaces that repeat, and what is made solid beside them."""

from .library import FORMULA, SURFACES, PeriodicSurface, find_surface, surface_name
from .sheet import KINDS, SIDES, TpmsSheet

__all__ = [
    "FORMULA",
    "KINDS",
    "SIDES",
    "SURFACES",
    "PeriodicSurface",
    "TpmsSheet",
    "find_surface",
    "surface_name",
]
