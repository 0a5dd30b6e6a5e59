# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load cases on a body's nodes: which are held, and what force and moment each of them gets.

What is shared out adds up to what was asked: the forces' sum, and their moment about any point.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..mesh.remesh import facet_normals
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.numbers import place_text
from ..util.types import Bools, Floats, Ints
from .load_cases import Force, Load, LoadCase, Pressure
from .regions import NearPoint, Region, simple_regions

#: Nodes and corners lie in a region when they are nearer to it than this part of the body's size.
ROUNDING = 1e-4
#: The node nearest to a point may be this part of the body's size away from it.
NEAREST = 0.1
#: A moment of inertia below this part of the largest turns nothing.
_NOTHING = 1e-9


@dataclass(frozen=True, eq=False)
class Body:
    """What of a part can be held and loaded.

    Attributes:
        nodes: (n, 3) float64, mm: joints of struts, nodes of a skin.
        facets: (m, 3) int64, rows of `nodes`: the skin's outside, wound as seen from outside. None
            (shape (0, 3)) for a bare lattice, which is held and loaded at its nodes.
        reach: (n,) float64, mm: how far the material of a node reaches, such as a joint's radius. A
            node belongs to a region that is no farther than that.
        turns: (n,) bool, nodes that have rotations, as those of beams and shells have.
    """

    nodes: Floats
    facets: Ints
    reach: Floats
    turns: Bools

    @property
    def size(self) -> float:
        """The diagonal of its box, mm."""
        return float(np.linalg.norm(np.ptp(self.nodes, axis=0)))

    def surface(self) -> TriangleMesh:
        """Its facets as a mesh that shares its nodes."""
        return TriangleMesh(self.nodes, self.facets.astype(np.int32))


@dataclass(frozen=True, eq=False)
class Share:
    """The part of a body that a region takes.

    Attributes:
        nodes: (k,) rows of the body's nodes, each once.
        weights: (k,) their parts of it, together 1: of its area, or alike where it has none.
        area: mm2; 0 where it has none.
        pushes: (k, 3) mm2, the force on each node under a pressure of 1 MPa.
    """

    nodes: Ints
    weights: Floats
    area: float
    pushes: Floats


@dataclass(frozen=True, eq=False)
class NodalCase:
    """A load case on the nodes of a body; the six columns are x, y, z and turns about x, y, z.

    Attributes:
        name: the load case's.
        fixed: (n, 6) bool, what is prescribed.
        prescribed: (n, 6) float64, mm: to what; 0 elsewhere.
        loads: (n, 6) float64, N and N mm.
        acceleration: (3,) float64, mm/s2; weights are the solver's to add, who knows masses.
    """

    name: str
    fixed: Bools
    prescribed: Floats
    loads: Floats
    acceleration: Floats


def nodal_case(body: Body, case: LoadCase) -> NodalCase:
    """Lay a load case on the nodes of a body.

    What expands evenly is solved as what does not, whose supports move the other way: stresses are
    the same, and displacements are those beside free expansion about the middle of the body.

    Raises:
        VolfrepError: nothing of the body lies in a region, a load cannot act there, or two supports
            contradict each other.
    """
    fixed, prescribed = _constraints(body, case)
    if case.expansion:
        middle = 0.5 * (body.nodes.min(axis=0) + body.nodes.max(axis=0))
        prescribed[:, :3] -= np.where(fixed[:, :3], case.expansion * (body.nodes - middle), 0.0)
    loads = np.zeros((len(body.nodes), 6))
    for load in case.loads:
        try:
            loads += nodal_loads(body, load)
        except VolfrepError as error:
            raise VolfrepError(f"Load case '{case.name}', '{load.name}': {error}") from error
    return NodalCase(case.name, fixed, prescribed, loads, np.array(case.acceleration, float))


def nodal_loads(body: Body, load: Load) -> Floats:
    """(n, 6) N and N mm: what each node of a body gets of a load.

    Raises:
        VolfrepError: nothing of the body lies in its region, or it cannot act there.
    """
    share = share_of(body, load.region)
    result = np.zeros((len(body.nodes), 6))
    if isinstance(load, Pressure):
        if not share.area:
            raise VolfrepError(
                f"A pressure needs a surface, and {load.region} has none: give a force instead."
            )
        result[share.nodes, :3] = load.pressure * share.pushes
        return result
    moment = np.zeros(3)
    if isinstance(load, Force):
        force = np.array(load.force, float)
        result[share.nodes, :3] = share.weights[:, None] * force
        if load.at is not None:
            middle = share.weights @ body.nodes[share.nodes]
            moment = np.cross(np.array(load.at) - middle, force)
    else:
        moment = np.array(load.moment, float)
    if moment.any():
        result[share.nodes] += _couple(body, share, moment, load)
    return result


def nodes_in(body: Body, region: Region) -> Ints:
    """Rows of the nodes that a region takes: corners of its facets, and nodes that reach into it.

    Raises:
        VolfrepError: one of the regions that it consists of takes none.
    """
    surface = body.surface()
    tolerance = ROUNDING * body.size
    found = np.zeros(len(body.nodes), bool)
    for simple in simple_regions(region):
        own = _reaching(body, simple)
        own[body.facets[simple.facets(surface, tolerance)].ravel()] = True
        if not own.any():
            raise _empty(body, simple)
        found |= own
    return np.flatnonzero(found)


def share_of(body: Body, region: Region) -> Share:
    """What a region takes of a body: its facets by area, or where it has none its nodes alike.

    Raises:
        VolfrepError: one of the regions that it consists of takes nothing, or some of them take
            facets and others nodes.
    """
    surface = body.surface()
    parts = simple_regions(region)
    taken = [simple.facets(surface, ROUNDING * body.size) for simple in parts]
    with_area = [bool(facets.any()) for facets in taken]
    if all(with_area):
        return _facets_share(body, surface, np.any(taken, axis=0))
    reaching = [_reaching(body, simple) for simple in parts]
    for simple, facets, nodes in zip(parts, with_area, reaching, strict=True):
        if not (facets or nodes.any()):
            raise _empty(body, simple)
    if any(with_area):
        one, other = parts[with_area.index(True)], parts[with_area.index(False)]
        raise VolfrepError(
            f"{one} has a surface and {other} has none, so that they cannot share a load: give "
            "each its own."
        )
    rows = np.flatnonzero(np.any(reaching, axis=0))
    even = np.full(len(rows), 1.0 / len(rows))
    return Share(rows, even, 0.0, np.zeros((len(rows), 3)))


def resultant(
    nodes: Floats, loads: Floats, about: ArrayLike = (0.0, 0.0, 0.0)
) -> tuple[Floats, Floats]:
    """(3,) N and (3,) N mm: the sum of loads at nodes, and their moment about a point.

    Args:
        nodes: (n, 3) mm.
        loads: (n, 3) forces, or (n, 6) forces and moments.
        about: the point, mm.
    """
    moment: Floats = np.cross(nodes - np.asarray(about), loads[:, :3]).sum(axis=0)
    if loads.shape[1] == 6:
        moment = loads[:, 3:].sum(axis=0) + moment
    return loads[:, :3].sum(axis=0), moment


def _constraints(body: Body, case: LoadCase) -> tuple[Bools, Floats]:
    fixed = np.zeros((len(body.nodes), 6), bool)
    prescribed = np.zeros((len(body.nodes), 6))
    for support in case.supports:
        try:
            nodes = nodes_in(body, support.region)
        except VolfrepError as error:
            raise VolfrepError(f"Load case '{case.name}', '{support.name}': {error}") from error
        for axis, value in enumerate(support.displacement):
            if value is None:
                continue
            other = nodes[fixed[nodes, axis] & (prescribed[nodes, axis] != value)]
            if len(other):
                raise VolfrepError(
                    f"Load case '{case.name}': '{support.name}' moves the node at "
                    f"{place_text(body.nodes[other[0]])} by {value:g} mm along {'xyz'[axis]}, "
                    f"another support by {prescribed[other[0], axis]:g} mm: keep one of them."
                )
            fixed[nodes, axis] = True
            prescribed[nodes, axis] = value
        turning = nodes[body.turns[nodes]]
        for axis, free in enumerate(support.turns):
            if not free:
                fixed[turning, 3 + axis] = True
    return fixed, prescribed


def _reaching(body: Body, region: Region) -> Bools:
    """(n,) the nodes whose material reaches into a region; of a mere point the nearest."""
    distance = region.distance(body.nodes)
    if isinstance(region, NearPoint) and region.within is None:
        nearest = np.zeros(len(body.nodes), bool)
        one = int(np.argmin(distance))
        nearest[one] = distance[one] <= NEAREST * body.size
        return nearest
    return np.asarray(distance <= body.reach + ROUNDING * body.size)


def _facets_share(body: Body, surface: TriangleMesh, facets: Bools) -> Share:
    """A third of each facet to each of its corners."""
    chosen = TriangleMesh(surface.vertices, surface.triangles[facets])
    third = chosen.areas() / 3.0
    count = len(body.nodes)
    corners = chosen.triangles.ravel()
    area = np.bincount(corners, np.repeat(third, 3), count)
    inward = -np.repeat(third[:, None] * facet_normals(chosen), 3, axis=0)
    pushes = np.stack([np.bincount(corners, inward[:, k], count) for k in range(3)], axis=1)
    nodes = np.unique(corners).astype(np.int64)
    total = float(area.sum())
    return Share(nodes, area[nodes] / total, total, pushes[nodes])


def _couple(body: Body, share: Share, moment: Floats, load: Load) -> Floats:
    """(k, 6) forces at a share's nodes that add up to nothing but a moment.

    They are those of a rigid turn about the middle: proportional to weight and lever. About a line
    on which all nodes lie they have no lever, and the nodes get the moment itself.

    Raises:
        VolfrepError: such nodes do not turn.
    """
    points = body.nodes[share.nodes]
    lever = points - share.weights @ points
    square = np.einsum("n,nij->ij", share.weights, lever[:, :, None] * lever[:, None, :])
    inertia = np.trace(square) * np.eye(3) - square
    values, axes = np.linalg.eigh(inertia)
    turned = values > _NOTHING * max(values[-1], body.size**2 * _NOTHING)
    along = axes.T @ moment
    turn = axes[:, turned] @ (along[turned] / values[turned])
    rest = axes[:, ~turned] @ along[~turned]
    result = np.zeros((len(points), 6))
    result[:, :3] = share.weights[:, None] * np.cross(turn, lever)
    if np.linalg.norm(rest) > _NOTHING * np.linalg.norm(moment):
        if not body.turns[share.nodes].all():
            raise VolfrepError(
                f"{load.region} takes nodes on one line only, which cannot carry a moment about "
                "it: choose a region that is wider."
            )
        result[:, 3:] = share.weights[:, None] * rest
    return result


def _empty(body: Body, region: Region) -> VolfrepError:
    distance = region.distance(body.nodes)
    nearest = int(np.argmin(distance))
    return VolfrepError(
        f"Nothing of the part lies in {region}: the nearest node, at "
        f"{place_text(body.nodes[nearest])}, is {distance[nearest]:.4g} mm off; check the "
        "place, in mm, or enlarge the region."
    )
