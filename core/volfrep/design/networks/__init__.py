# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks in place of cells: a user's graphs, cells laid into meshes, and random ones."""

from .files import read_network
from .laid_cells import laid_along, laid_into, layers_on
from .wanted import KINDS, GivenNetwork, RandomNetwork, make_network

__all__ = [
    "KINDS",
    "GivenNetwork",
    "RandomNetwork",
    "laid_along",
    "laid_into",
    "layers_on",
    "make_network",
    "read_network",
]
