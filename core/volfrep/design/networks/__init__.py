# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks in place of cells: graphs that a user brings, and random ones as they are asked for."""

from .files import read_network
from .wanted import KINDS, GivenNetwork, RandomNetwork, make_network

__all__ = ["KINDS", "GivenNetwork", "RandomNetwork", "make_network", "read_network"]
