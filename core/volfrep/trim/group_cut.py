# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Boolean of one group of octants with the wall near it: a pure function, for any process.

part = outer - (inner - lattice). The cavity (inner - lattice) lies strictly inside the part, so
that the outer minus adds a reversed surface and intersects nothing. Octants go in closed by flat
caps where their neighbours are left out; these follow where the caps were, vertex on vertex: the
Boolean hands the caps out untouched, and what it hands out untouched has exactly the coordinates
that went in.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..lattice.assembly import facets, neighbour_missing
from ..lattice.placed_octants import Placed
from ..mesh.booleans import from_library, to_library
from ..mesh.float32_repair import NEARLY, STEPS, slivers, without_inner_slivers
from ..mesh.open_shells import OpenShells, open_shells
from ..mesh.topology import open_vertices
from ..mesh.triangle_mesh import TriangleMesh, compact, compacted, empty_mesh
from ..spatial.rays import inside_points
from ..spatial.resolve_crossings import SOUND, Looks, look_at
from ..spatial.self_intersection import crossing_triangles, meeting_boxes
from ..util.errors import VolfrepError
from ..util.manifold import manifold_library
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .mutual_cut import cut_mutually
from .seams import NotCertain

if TYPE_CHECKING:
    import manifold3d

#: What is farther than so many steps of a file's numbers from what lies elsewhere does not meet it.
CLEAR_STEPS = 4.0


@dataclass(frozen=True, eq=False)
class Group:
    """Octants at the wall that are cut together, and what they are cut by.

    Attributes:
        placed: the octants.
        own: (nx, ny, nz) bool, those whose surface the group gives out.
        adjacent: others that its part of the wall touches.
        follow: where the lattice goes on.
        boundary: mesh of the domain's wall near the octants, mm.
        own_boundary: (m,) bool, triangles of it whose remains the group gives out.
        cavity: True for the wall less the lattice, turned inside out, False for what is in both.
        alone: whether there is no other group; otherwise no source triangle is joined with
            another in one plane, so that groups leave the same vertices where they meet.
        closed: whether the boundary is a solid's. Otherwise it is what reaches into the box about
            the octants, and where only a solid tells what is inside nothing is cut.
        precision: slivers thinner than that are taken out, mm; 0: they stay.
    """

    placed: Placed
    own: Bools
    adjacent: Bools
    follow: Bools
    boundary: TriangleMesh
    own_boundary: Bools
    cavity: bool
    alone: bool
    closed: bool
    precision: float = 0.0


@dataclass(frozen=True, eq=False)
class Piece:
    """What the Boolean left of a group.

    Attributes:
        mesh: open where other groups or octants inside follow; all of its vertices are in use.
        on_boundary: (m,) bool, its triangles that lie on the wall.
        rim: vertices at open edges.
        work: what was done, counted.
        defect: what is not a solid; empty otherwise.
        looks: what is known of its triangles; None: nothing.
        shells: of the mesh; None: not known.
        needs_solid: nothing was cut, for the wall has to be a solid for that.
    """

    mesh: TriangleMesh
    on_boundary: Bools
    rim: Ints
    work: dict[str, int] = field(default_factory=dict)
    defect: str = ""
    looks: Looks | None = None
    shells: OpenShells | None = None
    needs_solid: bool = False

    @property
    def error(self) -> Exception:
        """What to raise for the defect."""
        if self.defect.startswith("wall"):
            what = self.defect.partition(" ")[2]
            return VolfrepError(
                f"The domain's surface cannot be cut ({what}): repair the part's mesh."
            )
        return RuntimeError(f"not a manifold: {self.defect}")


def cut_group(group: Group, monitor: Monitor | None = None) -> Piece:
    """Cut a group's octants at the wall, and the wall at them.

    Args:
        group: the octants and their wall.
        monitor: for cancel; None where there is nobody to ask.
    """
    asked, monitor = monitor or Monitor(), Monitor()
    surfaces = _surfaces(group, monitor)
    both = group.own | group.adjacent

    @cache
    def capped() -> tuple[TriangleMesh, int]:
        caps = _caps(group, monitor)
        every = np.concatenate([*surfaces, caps])
        return group.placed.mesh(every, both, monitor)[0], len(caps)

    try:
        piece = _cut_along_seam(group, surfaces, capped, asked, monitor)
    except NotCertain:
        if not group.closed:
            none = np.zeros(0, np.int64)
            return Piece(empty_mesh(), none > 0, none, needs_solid=True)
        piece = _cut_by_library(group, surfaces, *capped(), asked, monitor)
    if piece.defect:
        return piece
    piece = _tidy(piece, group.precision, asked)
    return piece if group.alone or not group.precision else _look_at_piece(piece, group, asked)


def _look_at_piece(piece: Piece, group: Group, monitor: Monitor) -> Piece:
    """The piece with its shells and what its triangles tell of slivers, folds and crossings."""
    mesh, placed, step = piece.mesh, group.placed, group.precision / STEPS
    layout, far = placed.layout, CLEAR_STEPS * step
    half = 0.5 * layout.grid.cell_size
    others = np.pad(group.adjacent | group.follow, 1, constant_values=True)
    elsewhere = group.boundary.vertices[group.boundary.triangles[~group.own_boundary]]

    def alone(rows: Ints) -> Bools:
        """Those that lie in the group's own octants only, and beside no wall of other groups."""
        if placed.points is not None:  # octants reach out of their places
            return np.zeros(len(rows), bool)
        corners = mesh.vertices[mesh.triangles[rows]]
        # As `InnerOctants.reached` counts places, and one more on every side.
        places = (placed.motion.back(corners) - layout.grid.origin) / half
        places += 2.0 - 2.0 * layout.first
        limit = np.array(others.shape) - 1
        low, high = places.min(axis=1) - far / half, places.max(axis=1) + far / half
        first, last = (np.clip(np.floor(end).astype(np.int64), 0, limit) for end in (low, high))
        taken = np.pad(others.astype(np.int64), ((1, 0),) * 3)
        taken = taken.cumsum(0).cumsum(1).cumsum(2)
        met = np.zeros(len(rows), np.int64)
        for i, j, k in np.ndindex(2, 2, 2):
            at = [(last if end else first)[:, axis] + end for axis, end in enumerate((i, j, k))]
            met += (1 if (i + j + k) % 2 else -1) * taken[tuple(at)]
        result = met == 0
        if len(elsewhere) and len(rows):
            least, most = corners.min(axis=1) - far, corners.max(axis=1) + far
            ends = elsewhere.min(axis=1), elsewhere.max(axis=1)
            result[meeting_boxes(least, most, *ends, half)[0]] = False
        return np.asarray(result, np.bool_)

    deformed = placed.points is not None
    at_wall = piece.on_boundary
    looks = monitor.call(
        lambda: look_at(mesh, piece.rim, deformed, step, alone, Monitor(), at_wall)
    )
    # Where it is joined its vertices may move by far less than is left of them then.
    sound = np.ones(len(mesh.triangles), bool)
    sound[slivers(mesh, NEARLY * group.precision)] = False
    looks.marks[sound] |= SOUND
    return replace(piece, looks=looks, shells=monitor.call(lambda: open_shells(mesh)))


def _tidy(piece: Piece, precision: float, monitor: Monitor) -> Piece:
    """The piece without slivers where it meets no other one, if nothing crosses then."""
    smooth, new, was = without_inner_slivers(piece.mesh, piece.rim, precision)
    if not new.any() or monitor.call(lambda: crossing_triangles(smooth, new, precision)).any():
        return piece
    # What was rebuilt counts as of the wall where all its corners were on it.
    at_boundary = np.zeros(len(smooth.vertices), bool)
    stayed = piece.on_boundary[was] & ~new
    at_boundary[smooth.triangles[stayed]] = True
    on_boundary = np.where(new, at_boundary[smooth.triangles].all(axis=1), stayed)
    smooth, number = compacted(smooth)
    return Piece(smooth, on_boundary, number[piece.rim].astype(np.int64), piece.work)


def _cut_along_seam(
    group: Group,
    surfaces: list[NDArray[np.int32]],
    capped: Callable[[], tuple[TriangleMesh, int]],
    asked: Monitor,
    monitor: Monitor,
) -> Piece:
    """What the seam of octants and wall divides.

    Raises:
        NotCertain: they touch.
    """
    lattice = group.placed.mesh(np.concatenate(surfaces), group.own | group.adjacent, monitor)[0]
    own = np.arange(len(lattice.triangles)) < len(surfaces[0])
    monitor.count(
        "triangles into the Boolean", len(lattice.triangles) + len(group.boundary.triangles)
    )
    wanted = own, group.own_boundary

    def within(points: Floats) -> Bools:
        return inside_points(capped()[0], points, monitor)

    parts = asked.call(
        lambda: cut_mutually(
            lattice,
            group.boundary,
            wanted,
            within,
            in_front=group.cavity,
            closed=group.closed,
            monitor=monitor,
        )
    )
    boundary = parts.second[:, ::-1] if group.cavity else parts.second
    triangles = np.concatenate([parts.first, boundary]).astype(np.int32)
    piece = compact(TriangleMesh(parts.vertices, triangles))
    on_boundary = np.arange(len(triangles)) >= len(parts.first)
    return Piece(
        piece,
        on_boundary,
        rim_of(piece),
        monitor.work,
    )


def _cut_by_library(
    group: Group,
    surfaces: list[NDArray[np.int32]],
    capped: TriangleMesh,
    caps: int,
    asked: Monitor,
    monitor: Monitor,
) -> Piece:
    """What manifold3d's Boolean leaves, which decides where octants and wall touch, too."""
    library = manifold_library("Cutting a lattice at a skin")
    monitor.count(
        "triangles into the Boolean", len(capped.triangles) + len(group.boundary.triangles)
    )
    ids = library.Manifold.reserve_ids(5)
    order = np.argsort(~group.own_boundary, kind="stable")
    boundary_mesh = TriangleMesh(group.boundary.vertices, group.boundary.triangles[order])
    owned = int(group.own_boundary.sum())
    boundary = _solid(boundary_mesh, [owned, len(order) - owned], ids, group.alone, asked)
    sizes = [len(surfaces[0]), len(surfaces[1]), caps]
    cutter = _solid(capped, sizes, ids + 2, group.alone, asked)
    for solid, what in ((boundary, "wall"), (cutter, "lattice")):
        if solid.status() != library.Error.NoError:
            defect = f"{what} {solid.status().name}"
            return Piece(empty_mesh(), np.zeros(0, bool), np.zeros(0, np.int64), {}, defect)
    del boundary_mesh
    cavity = group.cavity
    result = asked.call(lambda: (boundary - cutter if cavity else boundary ^ cutter).to_mesh64())
    mesh, origin = read_runs(result)
    on_boundary = origin == ids
    kept = on_boundary | (origin == ids + 2)
    triangles = mesh.triangles[kept]
    piece = compact(TriangleMesh(mesh.vertices, triangles[:, ::-1] if cavity else triangles))
    return Piece(
        piece,
        on_boundary[kept],
        rim_of(piece),
        monitor.work,
    )


def cut_mesh(
    boundary: TriangleMesh, lattice: TriangleMesh, *, cavity: bool, monitor: Monitor
) -> tuple[TriangleMesh, NDArray[np.bool_]]:
    """Cut a lattice that is one closed mesh at the wall, as `cut` does octants.

    Returns:
        the cavity's surface seen from the material, or the lattice, and (m,) bool which of its
        triangles lie on the wall.

    Raises:
        VolfrepError: one of the two is not a solid that can be cut.
    """
    library = manifold_library("Cutting a lattice at a skin")
    ids = library.Manifold.reserve_ids(2)
    solids = [
        _solid(mesh, [len(mesh.triangles)], ids + k, True, monitor)
        for k, mesh in enumerate((boundary, lattice))
    ]
    for solid, what in zip(solids, ("domain", "lattice"), strict=True):
        if solid.status() != library.Error.NoError:
            raise VolfrepError(
                f"The {what}'s surface cannot be cut ({solid.status().name}): repair the part's "
                "mesh, or make the struts thinner."
            )
    one, two = solids
    monitor.count("triangles into the Boolean", len(boundary.triangles) + len(lattice.triangles))
    result = monitor.call(lambda: (one - two if cavity else one ^ two).to_mesh64())
    mesh, origin = read_runs(result)
    return mesh.reversed() if cavity else mesh, origin == ids


def _surfaces(group: Group, monitor: Monitor) -> list[NDArray[np.int32]]:
    """The surface of a group's own octants, and of those beside them.

    Caps towards nothing lie beyond the wall; what a wall that grazes them leaves belongs to it.
    """
    layout, both = group.placed.layout, group.own | group.adjacent
    found, faces = [], list(_missing(group, both))
    for where in (group.own, group.adjacent):
        ends = [facets(layout, monitor, last & where, face) for face, _, last in faces]
        found.append(np.concatenate([group.placed.facets(where, monitor), *ends]))
    return found


def _caps(group: Group, monitor: Monitor) -> NDArray[np.int32]:
    """What closes a group's octants towards those that follow; it is taken off again."""
    layout, both = group.placed.layout, group.own | group.adjacent
    return np.concatenate(
        [
            facets(layout, monitor, every & ~last, face)
            for face, every, last in _missing(group, both)
        ]
    )


def _missing(group: Group, both: Bools) -> Iterator[tuple[tuple[int, bool], Bools, Bools]]:
    """Faces of octants, those beyond which there are no others of the group, and no others."""
    grid = group.placed.layout.grid
    for axis, high in product(range(3), (False, True)):
        every = neighbour_missing(grid, both, axis, high)
        yield (axis, high), every, neighbour_missing(grid, both | group.follow, axis, high)


def _solid(
    mesh: TriangleMesh, runs: list[int], first_id: int, alone: bool, monitor: Monitor
) -> manifold3d.Manifold:
    """A manifold whose runs of triangles can be told apart after a Boolean."""
    library = manifold_library("Cutting a lattice at a skin")
    more: dict[str, NDArray[np.uint64]] = {}
    if not alone:
        more["face_id"] = np.arange(len(mesh.triangles), dtype=np.uint64)
    source = to_library(
        mesh,
        run_index=np.concatenate([[0], np.cumsum(runs)]).astype(np.uint64) * np.uint64(3),
        run_original_id=np.arange(first_id, first_id + len(runs), dtype=np.uint32),
        **more,
    )
    return monitor.call(lambda: library.Manifold(source))


def read_runs(result: manifold3d.Mesh64) -> tuple[TriangleMesh, NDArray[np.int64]]:
    """The Boolean's result, and the run that each triangle came from."""
    index = np.asarray(result.run_index).astype(np.int64) // 3
    origin = np.repeat(np.asarray(result.run_original_id).astype(np.int64), np.diff(index))
    return from_library(result), origin


def rim_of(mesh: TriangleMesh) -> Ints:
    """The vertices at edges of one triangle, ascending."""
    return np.flatnonzero(open_vertices(mesh.triangles, len(mesh.vertices)))
