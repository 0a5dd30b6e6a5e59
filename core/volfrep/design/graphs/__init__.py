# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks in place of cells: a user's graphs, cells laid into meshes, and random ones.

Files of them are read by `files`, and cells laid by `conformal_cells`.
"""

from .graph import KINDS, GivenGraph, RandomGraph, StretchedCells, make_network

__all__ = ["KINDS", "GivenGraph", "RandomGraph", "StretchedCells", "make_network"]
