# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks in place of cells: a user's graphs, cells laid into meshes, and random ones."""

from .conformal_cells import layers_on, place_cells_along, place_cells_into
from .files import read_network
from .graph import KINDS, GivenGraph, RandomGraph, StretchedCells, make_network

__all__ = [
    "KINDS",
    "GivenGraph",
    "RandomGraph",
    "StretchedCells",
    "layers_on",
    "make_network",
    "place_cells_along",
    "place_cells_into",
    "read_network",
]
