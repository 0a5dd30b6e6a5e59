# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a part is solid: because its skin's two sides meet, or because a skin is not enough there.

A skin that needs to be thicker than it may be becomes as thick as the part: half of its wall on
either side. So what is solid is a place of the same field of thicknesses, in the model, the part
and the file.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from ...mesh.topology import pieces_of
from ...mesh.triangle_mesh import TriangleMesh
from ...sizing.analysis import Analysis, Limits, Problem, analyse
from ...sizing.model import SizingModel
from ...sizing.optimise import next_radii
from ...sizing.skin_thickness import SkinThickness
from ...spatial.even_points import even_points
from ...spatial.medial_balls import wall_thickness
from ...spatial.proximity import closest_points
from ...spatial.rays import inside_points
from ...util.progress import Monitor
from ...util.types import Floats

#: A part is solid where its skin has this part of what there is room for, or more: half of it.
_MEETS = 0.4975
#: A skin of this part of the wall leaves nothing between its sides.
_FILLS = 0.6
#: A value is the largest that is allowed within this factor.
_AT_MOST = 0.999
#: A place fills shells in which it has more than this share.
_SAY = 0.1
#: The volume of a place is measured by so many points (a power of 2).
_POINTS = 12


@dataclass(frozen=True, eq=False)
class SolidPlaces:
    """Which places of the skin's surface are solid.

    Attributes:
        points: (p, 3) mm, places at which the skin's thickness was chosen.
        thickness: (p,) mm, what fills the part below them; 0 where it has a skin.
    """

    points: Floats
    thickness: Floats

    @property
    def deepest(self) -> float:
        """The largest thickness, mm; 0 where nothing is solid."""
        return float(self.thickness.max(initial=0.0))

    def depth(self, places: Floats) -> Floats:
        """(n,) mm, what fills the part below the nearest of its points; 0 where it has a skin."""
        if not self.thickness.any():
            return np.zeros(len(places))
        return np.asarray(self.thickness[cKDTree(self.points).query(places)[1]])


NOWHERE = SolidPlaces(np.empty((0, 3)), np.empty(0))


def more_solid(
    problem: Problem,
    limits: Limits,
    radii: Floats,
    part: TriangleMesh,
    before: SolidPlaces,
    thickest: float,
) -> SolidPlaces:
    """What is solid, with those places where a design wants more than the thickest skin.

    Where that is for a strut wider than long, its own place is filled, and no more below.

    Args:
        problem: whose skin is varied.
        limits: of the design.
        radii: the design's variables.
        part: whose walls are filled.
        before: what was solid already.
        thickest: mm, that the skin may be.

    Returns:
        `before` itself where there is nothing more.
    """
    skin = problem.skin
    assert skin is not None
    chosen = skin.wanted(radii)
    full = (chosen >= _AT_MOST * thickest) & (before.depth(skin.points) == 0.0)
    if not full.any():
        return before
    found, changes = analyse(problem, radii, limits, with_changes=True)
    assert changes is not None
    high = problem.high.copy()
    high[skin.radii :] *= 2.0
    more = skin.wanted(next_radii(replace(problem, high=high), found, changes, limits))
    full &= more > chosen / _AT_MOST
    if not full.any():
        return before
    # Near an edge a ball is small: what fills a place is the largest of those below it.
    middles = skin.skin.outside.vertices[skin.skin.shells.triangles].mean(axis=1)
    entries = skin.shares.tocoo()
    shells = entries.row[entries.data > _SAY]
    walls = np.zeros(len(skin.points))
    below = wall_thickness(part, middles)
    np.maximum.at(walls, entries.col[entries.data > _SAY], below[shells])
    filled = np.where(full, _FILLS * walls, before.depth(skin.points))
    # What the skin does not ask for itself is for a stub, and no deeper than there.
    stubs = _about_stubs(problem, found, limits, skin, middles, below)
    if limits.skin_stress is not None and found.skin_stress is not None:
        asks = skin.largest_near(skin.largest(found.skin_stress)) > limits.skin_stress
        some = full & ~asks & (stubs > 0.0)
        filled[some] = np.maximum(thickest, _FILLS * stubs[some])
    return SolidPlaces(skin.points, filled)


def solid_stubs(
    model: SizingModel,
    found: Analysis,
    limits: Limits,
    part: TriangleMesh,
    skin: SkinThickness,
    before: SolidPlaces,
    thickest: float,
) -> SolidPlaces:
    """What is solid, with the places of struts wider than long that cannot bear their load.

    Args:
        model: with a skin as it was laid.
        found: its struts, each as thick as it asks for or may be.
        limits: of the design.
        part: whose walls are filled.
        skin: where its thickness was chosen.
        before: what was solid already.
        thickest: mm, that the skin may be.

    Returns:
        `before` itself where there is nothing more.
    """
    assert model.skin is not None
    middles = model.skin.outside.vertices[model.skin.shells.triangles].mean(axis=1)
    below = wall_thickness(part, middles)
    stubs = _about_stubs(model.problem, found, limits, skin, middles, below)
    was = before.depth(skin.points)
    more = np.where((stubs > 0.0) & (was == 0.0), np.maximum(thickest, _FILLS * stubs), was)
    return before if np.array_equal(more, was) else SolidPlaces(skin.points, more)


def _about_stubs(
    problem: Problem,
    found: Analysis,
    limits: Limits,
    skin: SkinThickness,
    middles: Floats,
    below: Floats,
) -> Floats:
    """(p,) mm, about struts wider than long that a design stresses beyond the limit, 0 elsewhere.

    At the points of the skin's thickness nearest to such a strut: the thickest wall beside it, of
    those below the middles of shells.
    """
    result = np.zeros(len(skin.points))
    if limits.stress is None:
        return result
    over = found.stress.max(axis=(1, 2)) > limits.stress
    rows = np.flatnonzero(problem.stubs(found.radii) & over)
    structure = problem.structure
    places = structure.nodes[structure.beams.struts[rows]].mean(axis=1)
    reach = problem.radii.of_struts(found.radii)[rows].sum(axis=1)
    tree = cKDTree(middles)
    for place, far in zip(places, reach.tolist(), strict=True):
        beside = below[tree.query_ball_point(place, far)].max(initial=0.0)
        np.maximum.at(result, skin.nearest(place[None])[0], beside)
    return result


def solid_places(
    model: SizingModel,
    part: TriangleMesh,
    domain: TriangleMesh,
    density: float,
    filled: SolidPlaces = NOWHERE,
) -> list[dict[str, Any]]:
    """Where the skin's two sides meet, so that the part is solid: the heaviest place first.

    Args:
        model: of the part as it is.
        part: the solid, mm.
        domain: what lies within its skin.
        density: g/cm3.
        filled: where it is solid because no skin was enough.

    Returns:
        Of each place its volume in mm3 and mass in g, its middle, the box that it lies in, mm, and
        whether it was filled.
    """
    skin = model.skin
    assert skin is not None
    shells = skin.shells
    was_filled = filled.depth(skin.centres) > 0.0
    full = was_filled | (
        shells.thickness >= _MEETS * skin.thickness_below[shells.triangles].mean(axis=1)
    )
    own = shells.triangles[full]
    if not len(own):
        return []
    # A wall's two sides are one place: each vertex hangs together with those beyond it.
    beyond = skin.joined.beyond
    one = np.concatenate([own[:, 0], own[:, 1], np.repeat(skin.joined.vertices, 3)])
    two = np.concatenate([own[:, 1], own[:, 2], beyond.ravel()])
    place = pieces_of(one, two, len(skin.middle))[1][own[:, 0]]
    of_shell = np.full(len(full), -1, np.int64)
    of_shell[full] = place
    was_filled = was_filled[full]
    surface = TriangleMesh(skin.outside.vertices, shells.triangles.astype(np.int32))
    unit, found = even_points(3, _POINTS), []
    for number in np.unique(place):
        there = skin.outside.vertices[own[place == number]].reshape(-1, 3)
        low, high = there.min(axis=0), there.max(axis=0)
        points = low + unit * (high - low)
        points = points[inside_points(part, points, Monitor())]
        points = points[~inside_points(domain, points, Monitor())]
        if len(points):
            points = points[of_shell[closest_points(surface, points)[2]] == number]
        if not len(points):
            continue  # nothing that could be measured
        volume = float(np.prod(high - low)) * len(points) / len(unit)
        found.append(
            {
                "volume_mm3": volume,
                "mass_g": volume * density / 1000.0,
                "middle_mm": points.mean(axis=0).tolist(),
                "box_mm": [low.tolist(), high.tolist()],
                "filled": bool(was_filled[place == number].any()),
            }
        )
    return sorted(found, key=lambda place: -place["mass_g"])


def filled_notes(places: list[dict[str, Any]], thickest: float) -> list[str]:
    """A sentence on what was filled, of `solid_places`; none where nothing was."""
    filled = [place for place in places if place["filled"]]
    if not filled:
        return []
    x, y, z = filled[0]["middle_mm"]
    volume, mass = (sum(place[what] for place in filled) for what in ("volume_mm3", "mass_g"))
    return [
        f"The part is solid where a skin of {thickest:.4g} mm is not enough: {volume:,.0f} mm3 "
        f"({mass:.4g} g) in {len(filled)} places, the largest about ({x:.4g}, {y:.4g}, {z:.4g}). "
        "Its inside is not modelled as a solid: solve the finished file (--prove file)."
    ]
