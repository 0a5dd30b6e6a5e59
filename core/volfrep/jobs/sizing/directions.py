# SPDX-License-Identifier: LGPL-2.1-or-later
"""Along which axis a part is best built, when struts that lie too flat then are gone.

Of a truss as thick everywhere as its forces ask for, compliance times volume is the square of the
length over which these are carried, whatever its radii: by this directions are compared, each
after one solution. A design is searched for along one of them only.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...design.cells import LIBRARY, UnitCell
from ...design.spec import LatticeSpec
from ...grid.inclination import unit_direction
from ...mesh.triangle_mesh import TriangleMesh
from ...reports.printability import overhanging_facets
from ...reports.sizing_results import along_text
from ...sizing.analysis import Analysis
from ...util.errors import Cancelled, VolfrepError
from ..infill import Infill
from .building import Building
from .goal import Goal
from .part_model import all_struts

_Direction = tuple[float, float, float]
#: The part's axes, the first of equals first.
AXES: tuple[_Direction, ...] = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
#: Axes with no more work than this times the least are as good: of them the one along which less
#: of the outside hangs over.
AS_GOOD = 1.1
#: Another direction is told of where it has so much less work.
MUCH_BETTER = 1.5


@dataclass(frozen=True)
class Along:
    """A part built along a direction, without the struts that lie too flat then.

    Attributes:
        up: from the build plate up.
        work: N mm times mm3: compliance in all cases, times volume.
        hanging_mm2: of the part's outside.
    """

    up: _Direction
    work: float
    hanging_mm2: float


def along_directions(
    solid: TriangleMesh,
    spec: LatticeSpec,
    building: Building,
    solved: Callable[[LatticeSpec], Analysis],
) -> list[Along]:
    """The directions along which enough struts stay to carry the loads, the best first.

    Those of the part's axes, either way as less of its outside hangs over, and the building's own.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with; not a network, of which all struts stay.
        building: whose process does not build every inclination.
        solved: what the struts of a specification do.
    """
    own, found = building.build_direction, []
    is_axis = any(_is_along(own, axis) for axis in AXES)
    for up in AXES if is_axis else (*AXES, own):
        steeper = replace(building, build_direction=up).without_flat_struts(all_struts(spec))
        assert steeper is not None
        try:
            analysis = solved(steeper)
        except VolfrepError:  # what is left carries nothing
            continue
        turned = (0.0 - up[0], 0.0 - up[1], 0.0 - up[2])
        ways = (own,) if _is_along(own, up) and not building.is_free else (up, turned)
        hanging, _, way = min((_hanging(solid, building, w), k, w) for k, w in enumerate(ways))
        found.append(Along(way, float(analysis.compliance.sum()) * analysis.volume, hanging))
    least = min((one.work for one in found), default=0.0)
    return sorted(found, key=lambda one: (one.work > AS_GOOD * least, one.hanging_mm2, one.work))


def directed(goal: Goal, found: Sequence[Along]) -> tuple[Goal, str]:
    """The goal with the best direction for that of its building, which is free; why, in words."""
    building, printing = goal.building, goal.printing
    assert building is not None
    best, *others = found
    building = replace(building, build_direction=best.up, is_free=False)
    if printing is not None:
        printing = replace(printing, build_direction=best.up)
    than = [
        f"{one.work / best.work:.2g} times as stiff as along {along_text(one.up)}" for one in others
    ]
    than += [
        f"too few struts are left along {along_text(axis)}"
        for axis in AXES
        if not any(_is_along(one.up, axis) for one in found)
    ]
    told = (
        f"Built along {along_text(best.up)}, the best of the part's axes for its lattice without "
        f"flatter struts, at the same volume: {', '.join(than)}."
    )
    return replace(goal, building=building, printing=printing), told


def advice(
    goal: Goal,
    infill: Infill,
    found: Sequence[Along] | None,
    along: Callable[[], Sequence[Along]],
    stays: bool,
) -> list[str]:
    """Which other build direction, or cell, may do better, in a sentence; or nothing.

    Args:
        goal: with the direction that the part was sized for.
        infill: the part as it was sized.
        found: of `along_directions`; None where it was not asked.
        along: asks it.
        stays: whether struts stay that lie too flat.
    """
    building = goal.building
    assert building is not None
    if found is None:
        flat = 0 if infill.pruned is None else infill.pruned.left.flat
        # A skin carries what flat struts did, and takes long to solve.
        if not stays and (not flat or infill.spec.with_skin):
            return []
        try:
            found = along()
        except Cancelled:  # the design is there
            return []
    own = [one for one in found if _is_along(one.up, building.build_direction)]
    others = [one for one in found if one not in own]
    if others and not own:
        return [
            f"Built along {along_text(others[0].up)} the lattice carries without flatter struts: "
            "choose that build direction where you can."
        ]
    if others and own[0].work > MUCH_BETTER * others[0].work:
        return [
            f"Built along {along_text(others[0].up)} the lattice without flatter struts is "
            f"{own[0].work / others[0].work:.2g} times as stiff for its volume: choose that build "
            "direction where you can."
        ]
    if stays and not found:
        return [
            "Built along none of the part's axes the cell carries without flatter struts: choose "
            f"another one, such as {', '.join(steep_cells(building.process.inclination))} with "
            "its z upwards."
        ]
    return []


def steep_cells(inclination: float) -> list[str]:
    """Cells of the library of which no strut lies flatter than so many degrees, with z upwards."""
    return [name for name, cell in LIBRARY.items() if _is_steep(cell, inclination)]


def _is_steep(cell: UnitCell, inclination: float) -> bool:
    """Struts that do not reach along x and y carry nothing across."""
    ends = (cell.nodes * np.array(cell.edges))[cell.struts]
    along = ends[:, 1] - ends[:, 0]
    along /= np.linalg.norm(along, axis=1)[:, None]
    least = np.degrees(np.arcsin(np.minimum(np.abs(along[:, 2]), 1.0))).min()
    return bool(least > inclination - 1e-6 and np.abs(along).max(axis=0).min() > 1e-6)


def _is_along(one: _Direction, other: _Direction) -> bool:
    """Whether two directions have one axis."""
    return bool(abs((unit_direction(one) * unit_direction(other)).sum()) > 1.0 - 1e-9)


def _hanging(solid: TriangleMesh, building: Building, up: _Direction) -> float:
    """mm2 of the outside."""
    hanging = overhanging_facets(solid, unit_direction(up), building.process.inclination)
    return float(solid.areas()[hanging].sum())
