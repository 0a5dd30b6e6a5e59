# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load cases on voxels: a part's surface is held and loaded, and its voxels' nodes take that over.

Regions take the surface itself, in pieces no longer than a voxel. A force on it goes to the eight
nodes of the voxel that holds its place, or the nearest that is solid enough, trilinearly, so that
sum and moment stay what they are. Held are the nodes within about half a voxel of what is held: as
many lie outside as inside, so that a support is neither deeper nor shallower than it is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from scipy.sparse import csr_matrix
from scipy.spatial import cKDTree

from ..loads.load_cases import LoadCase
from ..loads.nodal_loads import Body, nodal_case, resultant, share_of
from ..loads.regions import Region
from ..mechanics.elements import CORNERS
from ..mesh.remesh import facet_normals
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..spatial.proximity import closest_points
from ..util.errors import VolfrepError
from ..util.types import Bools, Floats, Ints
from .multigrid import Elements, Multigrid
from .shares import VoxelGrid

S = TypeVar("S")

#: Forces that are left when a case counts as solved, over its loads.
TOLERANCE = 1e-6
#: Voxels that are looked at about a place that is loaded.
NEAR = 8
#: A hair more than a voxel.
HAIR = 1.0 + 1e-6
#: Held are nodes no deeper below what is held, and no farther outside, in edges: one on each line
#: across it. Half and half would be a little stiff where the surface lies askew: a node that is
#: held holds those beside it. Of walls of holes and ends of bars, askew, the error is least so.
INNER, OUTER = 0.4, 0.6


@dataclass(frozen=True, eq=False)
class VoxelCase:
    """A load case on the nodes of voxels.

    Attributes:
        name: the load case's.
        fixed: (n, 3) bool.
        prescribed: (n, 3) mm, to what; 0 elsewhere.
        loads: (n, 3) N, with what the mass weighs.
        places: of each load its name, and (n,) weights of the nodes whose mean it moves by.
        asked: (6,) N and N mm, all loads together and their moment about the origin, with what
            the voxels' mass weighs.
    """

    name: str
    fixed: Bools
    prescribed: Floats
    loads: Floats
    places: tuple[tuple[str, Floats], ...]
    asked: Floats

    def mean_displacements(self, displacements: Floats) -> list[dict[str, Any]]:
        """How far each load moves of displacements (n, 3), mm, as plain JSON values."""
        return [
            {"name": name, "moved_mm": (weights @ displacements).tolist()}
            for name, weights in self.places
        ]

    def solve(
        self, solver: Multigrid, tolerance: float = TOLERANCE, start: Floats | None = None
    ) -> tuple[Floats, int]:
        """(n, 3) displacements, mm, what is prescribed with them, and the steps that they took.

        Args:
            solver: of the equations with its supports.
            tolerance: of the forces that are left, over the loads.
            start: displacements to begin with; None for none.

        Raises:
            VolfrepError: it does not converge.
            Cancelled: when the solver's monitor says so.
        """
        loads = self.loads
        if self.prescribed.any():
            loads = loads - solver.fine.full(self.prescribed)
        displacements, steps = solver.solve(loads, start, tolerance)
        return displacements + self.prescribed, steps


def solve_nodal_cases(
    cases: Sequence[VoxelCase],
    solver_of: Callable[[Bools], Multigrid],
    state_of: Callable[[VoxelCase, Floats, Floats, int], S],
) -> list[S]:
    """Solve load cases: those with equal supports with one solver.

    Args:
        cases: on the nodes.
        solver_of: the equations' solver where (n, 3) are free.
        state_of: what a case is told by: itself, its (n, 3) displacements, mm, the (n, 3) forces
            that hold these, N, and the steps that they took.

    Raises:
        VolfrepError: it does not converge.
        Cancelled: when the solver's monitor says so.
    """
    states: dict[int, S] = {}
    for first, like in enumerate(cases):
        if first in states:
            continue
        solver = solver_of(~like.fixed)
        for k, case in enumerate(cases):
            if k in states or not np.array_equal(case.fixed, like.fixed):
                continue
            displacements, steps = case.solve(solver)
            states[k] = state_of(case, displacements, solver.fine.full(displacements), steps)
    return [states[k] for k in range(len(cases))]


def surface_body(mesh: TriangleMesh, longest: float) -> Body:
    """A part's surface as what is held and loaded, in pieces with edges no longer than that, mm."""
    corners = np.stack(mesh.corners(), axis=1)
    done = []
    while len(corners):
        edges = np.roll(corners, -1, axis=1) - corners
        length = np.einsum("mij,mij->mi", edges, edges)
        whole = length.max(axis=1) <= longest**2
        done.append(corners[whole])
        corners, length = corners[~whole], length[~whole]
        turn = (length.argmax(axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = np.moveaxis(np.take_along_axis(corners, turn[:, :, None], axis=1), 1, 0)
        middle = 0.5 * (a + b)
        corners = np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
    points = np.concatenate(done).reshape(-1, 3)
    nodes, rows = np.unique(points, axis=0, return_inverse=True)
    facets = rows.reshape(-1, 3).astype(np.int64)
    return Body(nodes, facets, np.zeros(len(nodes)), np.zeros(len(nodes), bool))


class Loaded:
    """Takes load cases from a surface to voxels.

    Args:
        body: the surface, of `surface_body`.
        grid: of the voxels.
        elements: those that are there.
        shares: (e,) how full they are.
        density: of the material, g/cm3.
    """

    def __init__(
        self, body: Body, grid: VoxelGrid, elements: Elements, shares: Floats, density: float
    ) -> None:
        self.body, self.grid, self.elements, self.shares = body, grid, elements, shares
        self.density = density
        self.nodes = elements.node_place * grid.edge + grid.low
        self._middles = cKDTree((elements.place + 0.5) * grid.edge + grid.low)
        self._near_node = cKDTree(self.nodes)
        self._found: dict[bytes, tuple[Ints, Ints]] = {}

    def case(self, case: LoadCase) -> VoxelCase:
        """A load case on the nodes.

        Raises:
            VolfrepError: nothing of the part lies in a region, a load cannot act there, two
                supports contradict each other, or what is held leaves the part free to move.
        """
        nodal = nodal_case(self.body, case)
        fixed, prescribed = self._constraints(nodal.fixed[:, :3], nodal.prescribed[:, :3])
        self._refuse_loose(case.name, fixed)
        acting = np.flatnonzero(nodal.loads[:, :3].any(axis=1))
        forces = nodal.loads[acting, :3]
        loads = np.zeros_like(self.nodes)
        if len(acting):
            loads = np.asarray(self._weights(self.body.nodes[acting]).T @ forces)
        own = self._weight(nodal.acceleration)
        places = [(load.name, self.weights_of(load.region)) for load in case.loads]
        of_forces, of_weight = (
            resultant(self.body.nodes[acting], forces),
            resultant(self.nodes, own),
        )
        asked = np.concatenate(of_forces) + np.concatenate(of_weight)
        return VoxelCase(case.name, fixed, prescribed, loads + own, tuple(places), asked)

    def _constraints(self, fixed: Bools, prescribed: Floats) -> tuple[Bools, Floats]:
        result, to = np.zeros((len(self.nodes), 3), bool), np.zeros((len(self.nodes), 3))
        for axis in range(3):
            key = fixed[:, axis].tobytes()
            if key not in self._found:
                self._found[key] = self.nodes_at(fixed[:, axis])
            rows, nearest = self._found[key]
            result[rows, axis] = True
            to[rows, axis] = prescribed[nearest, axis]
        return result, to

    def weights_of(self, region: Region) -> Floats:
        """(n,) the nodes' parts of what a region takes, together 1.

        Raises:
            VolfrepError: it takes nothing.
        """
        share = share_of(self.body, region)
        return np.asarray(self._weights(self.body.nodes[share.nodes]).T @ share.weights)

    def area_of(self, region: Region) -> float:
        """mm2 that a region takes of the surface; 0 where it takes nodes alone.

        Raises:
            VolfrepError: it takes nothing.
        """
        return share_of(self.body, region).area

    def nodes_at(self, fixed: Bools) -> tuple[Ints, Ints]:
        """Nodes that lie on fixed places of the surface, and the surface's node that each is at."""
        if not fixed.any():
            return np.zeros(0, np.int64), np.zeros(0, np.int64)
        facets = self.body.facets[fixed[self.body.facets].all(axis=1)]
        rows, nearest = np.zeros(0, np.int64), np.zeros(0, np.int64)
        single = fixed.copy()
        if len(facets):
            single[facets.ravel()] = False
            edge = HAIR * float(self.grid.edge.max())
            corners = np.unique(facets)
            points = self.body.nodes[corners]
            low, high = points.min(axis=0) - edge, points.max(axis=0) + edge
            rows = np.flatnonzero(((self.nodes >= low) & (self.nodes <= high)).all(axis=1))
            # No place of a facet is farther from its corners than a voxel.
            most = 2.0 * edge
            there = cKDTree(points).query(self.nodes[rows], distance_upper_bound=most)[0] < most
            rows = np.union1d(rows[there], self._near_node.query(points)[1])
            surface = compact(TriangleMesh(self.body.nodes, facets.astype(np.int32)))
            place, distance, triangle = closest_points(surface, self.nodes[rows])
            side = np.einsum("ni,ni->n", self.nodes[rows] - place, facet_normals(surface)[triangle])
            aside = np.sqrt(np.maximum(distance**2 - side**2, 0.0))
            on = (side >= -INNER * edge) & (side <= OUTER * edge) & (aside <= 0.5 * edge)
            rows, nearest = rows[on], facets[triangle[on], 0]
        alone = np.flatnonzero(single)
        if len(alone):
            rows = np.concatenate([rows, self._near_node.query(self.body.nodes[alone])[1]])
            nearest = np.concatenate([nearest, alone])
        return rows, nearest

    def _weights(self, points: Floats) -> Any:
        """(k, n) the parts that nodes have in points of the surface, or in what lies just there."""
        count = min(NEAR, len(self.shares))
        distance, voxel = self._middles.query(points, count)
        distance, voxel = distance.reshape(len(points), -1), voxel.reshape(len(points), -1)
        # A voxel that is hardly filled gives way more than the part does.
        rank = distance / float(self.grid.edge.mean()) + (1.0 - self.shares[voxel])
        voxel = np.take_along_axis(voxel, rank.argmin(axis=1)[:, None], axis=1)[:, 0]
        inside = (points - self.grid.low) / self.grid.edge - self.elements.place[voxel]
        near = np.where(CORNERS[None], inside[:, None], 1.0 - inside[:, None]).prod(axis=2)
        rows = np.repeat(np.arange(len(points)), 8)
        entries = (near.ravel(), (rows, self.elements.nodes[voxel].ravel()))
        return csr_matrix(entries, (len(points), len(self.nodes)))

    def _weight(self, acceleration: Floats) -> Floats:
        """(n, 3) N, what an acceleration makes of the voxels' mass."""
        result = np.zeros_like(self.nodes)
        if acceleration.any():
            mass = self.shares * float(np.prod(self.grid.edge)) * self.density * 1e-9  # tonnes
            each = np.repeat(mass / 8.0, 8)
            at = np.bincount(self.elements.nodes.ravel(), each, len(self.nodes))
            result = at[:, None] * acceleration
        return result

    def _refuse_loose(self, name: str, fixed: Bools) -> None:
        """Refuse a part that may move as a whole."""
        middle = self.nodes.mean(axis=0)
        lever = (self.nodes - middle) / float(np.ptp(self.nodes, axis=0).max())
        motions = np.zeros((len(self.nodes), 3, 6))
        for axis in range(3):
            motions[:, axis, axis] = 1.0
            motions[:, :, 3 + axis] = np.cross(np.eye(3)[axis], lever)
        there = motions[fixed]
        if len(there) < 6 or np.linalg.matrix_rank(there.T @ there, 1e-9 * len(there)) < 6:
            raise VolfrepError(
                f"Load case '{name}': the part may move as a whole, since its supports do not hold "
                "it in all directions and turns: hold more of it."
            )
