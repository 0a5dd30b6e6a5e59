# SPDX-License-Identifier: LGPL-2.1-or-later
"""A quantity at points of a filled part: what its surface, or its struts, are coloured by.

Of the strut nearest to each point, whatever mesh there is: nothing needs to know how the mesh was
made.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ...design.grading import Field
from ...design.spec import LatticeSpec
from ...grid.placement import part_map
from ...mesh.triangle_mesh import TriangleMesh
from ...sizing.strut_state import strut_states
from ...spatial.nearest_struts import NearestStrut
from ...util.cache import StageCache
from ...util.errors import VolfrepError
from ...util.progress import ProgressCallback
from ...util.types import Floats

if TYPE_CHECKING:
    from ...loads.load_cases import LoadCases
    from ..sizing import Printing

#: What there is, and what it is called.
QUANTITIES = {
    "Radius": "Strut radius, mm",
    "Skin": "Skin thickness, mm",
    "Cell size": "Cell size, mm",
    "Overhang": "Overhang, degrees",
    "Stress": "Stress (von Mises), MPa",
    "Buckling": "Share of the buckling load",
    "Displacement": "Displacement, mm",
    "Governing limit": "Governing limit",
    "Governing limit of the skin": "Governing limit of the skin",
    "Field": "Field of the radius",
    "Temperature": "Temperature, \u00b0C",
}
#: Those that need loads: names of the attributes of a `StrutState`.
OF_LOADS = {"Stress": "stress", "Buckling": "buckling", "Displacement": "displacement"}
#: What needs heat among the loads.
OF_HEAT = "Temperature"
#: Those that are known of a sized part only: rows of names, for struts and for the skin.
GOVERNING = "Governing limit", "Governing limit of the skin"


class PointValues(NamedTuple):
    """A quantity at points.

    Attributes:
        values: (n,) float32.
        low: where a scale of colours begins.
        high: where it ends.
    """

    values: NDArray[np.float32]
    low: float
    high: float


def point_values(
    solid: TriangleMesh,
    spec: LatticeSpec,
    quantity: str,
    points: Floats,
    normals: Floats,
    *,
    up: tuple[float, float, float] = (0.0, 0.0, 1.0),
    loads: LoadCases | None = None,
    carried: tuple[Floats, Floats] | None = None,
    printing: Printing | None = None,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> PointValues:
    """A quantity at points of the lattice's surface; of a strut, that of the nearest one there.

    Of several load cases it is the largest value of all.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with.
        quantity: one of `QUANTITIES`.
        points: (n, 3) mm.
        normals: (n, 3) of the surface, of length 1, outwards; only overhangs need them.
        up: from the build plate, for overhangs.
        loads: for those of `OF_LOADS` and `OF_HEAT`.
        carried: in place of loads, what is known of struts: their ends, (m, 2, 3) mm, and the
            values there, (m, 2); for the skin points, (m, 3), and (m,).
        printing: how struts come out that carry loads; None as they are drawn.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the costly stages of the part.

    Raises:
        VolfrepError: the quantity is unknown, or the part has nothing of it.
        Cancelled: the callback said so.
    """
    if quantity not in QUANTITIES:
        raise VolfrepError(
            f"There is no quantity '{quantity}': choose from {', '.join(QUANTITIES)}."
        )
    if quantity == "Overhang":
        return PointValues(overhang(normals, up).astype(np.float32), 0.0, 90.0)
    if quantity == "Skin":
        return _in_range(_skin(solid, spec, points))
    if quantity == OF_HEAT:
        from ..heat import solve_heat

        if loads is None:
            raise VolfrepError(f"'{quantity}' needs heat: there is none.")
        warm = solve_heat(solid, spec, loads, progress=progress, cache=cache)
        return PointValues(warm.at(points).astype(np.float32), *warm.ends)
    if quantity in ("Cell size", "Field"):
        return _in_range(values_in_space(solid, spec, quantity, points))
    if quantity in GOVERNING and carried is None:
        raise VolfrepError(f"'{quantity}' is known of a sized part only.")
    if quantity == GOVERNING[1] and carried is not None:
        places, rows = carried
        return _in_range(rows[cKDTree(places).query(points)[1]])
    if not spec.kind.has_struts:
        raise VolfrepError(f"Walls have no struts to colour by '{quantity}'.")
    from ..infill import Infill
    from ..sizing import solve_struts

    if quantity == "Radius":
        frame = Infill(solid, spec, progress=progress, cache=cache).struts
        ends, values, lowest = frame.nodes[frame.struts], frame.radii, None
    elif carried is not None:
        (ends, values), lowest = carried, 0.0
    else:
        if loads is None:
            raise VolfrepError(f"'{quantity}' needs loads: there are none.")
        model, analysis = solve_struts(
            solid, spec, loads, printing=printing, progress=progress, cache=cache
        )
        states = strut_states(model.problem, analysis)
        ends, lowest = states[0].ends, 0.0
        values = np.max([state.values(OF_LOADS[quantity]) for state in states], axis=0)
    strut, share = NearestStrut(ends).of(np.asarray(points, np.float64))
    found = (1.0 - share) * values[strut, 0] + share * values[strut, 1]
    low = float(values.min()) if lowest is None else lowest
    return PointValues(found.astype(np.float32), low, float(values.max()))


def values_on_struts(start: Floats, end: Floats, ends: Floats, values: Floats) -> Floats:
    """(k, 2) at both ends of struts, of values that are known at the ends of others on their lines.

    Args:
        start: (k, 3) where they begin, mm.
        end: (k, 3) where they end.
        ends: (m, 2, 3) of the others, mm.
        values: (m, 2) there.
    """
    strut, _ = NearestStrut(ends).of(0.5 * (start + end))
    origin, along = ends[strut, 0], ends[strut, 1] - ends[strut, 0]
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    low, high = values[strut, 0], values[strut, 1]
    found = [
        low + np.clip(((place - origin) * along).sum(axis=1) / length, 0.0, 1.0) * (high - low)
        for place in (start, end)
    ]
    return np.stack(found, axis=1)


def values_in_space(
    solid: TriangleMesh, spec: LatticeSpec, quantity: str, points: Floats
) -> Floats:
    """(n,) of (n, 3) points: the cell size there, or the field that drives the radius.

    The cell size is the cube root of the volume that a cell of that place would have.

    Raises:
        VolfrepError: no field drives the radius, or cells follow no grid.
    """
    if quantity == "Field":
        field = None if spec.radius_grading is None else spec.radius_grading.field
        if not isinstance(field, Field):
            raise VolfrepError("No field drives the radius: choose a file or a FEM result first.")
        return np.asarray(field(points), np.float64)
    if not spec.kind.has_grid:
        raise VolfrepError("The struts of a network have no cells to colour by.")
    mapping = part_map(spec.grid, solid.bounds)
    if mapping is None:
        return np.full(len(points), spec.cell_size)
    slopes = mapping.jacobians(mapping.to_lattice(np.asarray(points, np.float64)))
    sides = np.moveaxis(slopes, 2, 0)
    volume = np.abs((sides[0] * np.cross(sides[1], sides[2])).sum(axis=1))
    return np.asarray(spec.cell_size * np.cbrt(volume))


def _skin(solid: TriangleMesh, spec: LatticeSpec, points: Floats) -> Floats:
    """(n,) mm, the thickness of the skin below (n, 3) points of the part's surface."""
    from ..sizing.part_model import thickness_of_skin

    if not spec.with_skin:
        raise VolfrepError("The part has no skin to colour: give it a skin thickness.")
    thickness = thickness_of_skin(solid, spec)
    places = np.asarray(points, np.float64)
    return thickness(places) if callable(thickness) else np.full(len(places), thickness)


def overhang(normals: Floats, up: tuple[float, float, float]) -> Floats:
    """(n,) degrees between surfaces and the build plate, where they face down; 90 elsewhere.

    Args:
        normals: (n, 3) of length 1, outwards.
        up: from the build plate.
    """
    direction = np.asarray(up, np.float64)
    fall = -(np.asarray(normals, np.float64) * direction).sum(axis=1)
    fall /= max(float(np.sqrt((direction**2).sum())), 1e-300)
    return np.asarray(np.degrees(np.arccos(np.clip(fall, 0.0, 1.0))))


def _in_range(values: Floats) -> PointValues:
    ends = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    return PointValues(values.astype(np.float32), *ends)
