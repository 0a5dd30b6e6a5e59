# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids whose inner wall is known in closed form, as the stages of the shelling get them."""

from volfrep.shell.depth import Depth
from volfrep.shell.sampled_depth import DepthField
from volfrep.spatial.proximity import index_surface
from volfrep.util.progress import Monitor


def depth_of(solid, thickness) -> Depth:
    """The depth below the surface of a solid, sampled as the shelling samples it."""
    return Depth(index_surface(solid, 0.25 * thickness), thickness, Monitor())


def field_of(solid, thickness, cube=None) -> DepthField:
    """Its samples, on cubes of half the thickness where nothing else is said."""
    return DepthField(solid, depth_of(solid, thickness), cube or 0.5 * thickness)
