# SPDX-License-Identifier: LGPL-2.1-or-later
"""The surface of a trimmed lattice: a mesh of what the wall has cut, and whole octants inside.

What the wall does not cross needs no look at its triangles: it is proved by kinds of octants, and
joined to the mesh where both are open, by the vertices that they share.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..lattice.assembly import (
    Layout,
    box,
    facets,
    in_steps,
    lay_out,
    neighbour_missing,
    numbers,
    placed,
)
from ..lattice.certificate import CertifiedPieces, certify_pieces
from ..mesh.edge_table import pieces_of
from ..mesh.quality import Inspection, Quality, inspect
from ..mesh.triangle_mesh import TriangleMesh, box_of, corners_among
from ..util.progress import Monitor
from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints
from .laid import Laid

#: Points are first told apart by what is left of their hashes by this.
ASKED = 1 << 22
#: A triangle reaches into an octant where it does by more than this, in units of L.
REACH = 1e-9


@dataclass(frozen=True, eq=False)
class JoinedInspection:
    """A surface's quality, and the shells that it was found on.

    Attributes:
        found: of the whole; its triangles are those of the mesh.
        beyond: (shells,) bool, which shells have a share of the octants beside the mesh.
    """

    found: Inspection
    beyond: Bools


@dataclass(frozen=True, eq=False)
class Caps:
    """Flat faces where octants follow on a solid.

    Attributes:
        mesh: the faces, mm.
        at_rim: (n,) which of the vertices at the octants' rim each of its vertices is; -1 for none.
    """

    mesh: TriangleMesh
    at_rim: Ints


@dataclass(frozen=True, eq=False)
class InnerOctants:
    """Octants that belong to a surface without being in its mesh.

    Attributes:
        laid: all the octants.
        where: (nx, ny, nz) bool, these.
    """

    laid: Laid
    where: Bools

    @cached_property
    def layout(self) -> Layout:
        """They alone, numbered as among all."""
        return self.laid.alone(self.where)

    @cached_property
    def pieces(self) -> CertifiedPieces:
        """What is proved of them by their kinds."""
        return certify_pieces(self.layout, box(self.layout).mean(axis=0))

    @cached_property
    def rim(self) -> Ints:
        """The vertices, by their numbers, at which octants are open; ascending."""
        return np.unique(self.pieces.rim)

    @cached_property
    def rim_points(self) -> Floats:
        """(k, 3) where they are, mm."""
        return self.laid.coordinates(self.rim.astype(np.int32), self._at_rim, Monitor())

    @cached_property
    def _at_rim(self) -> Bools:
        """(nx, ny, nz) bool, octants that have all the vertices at the rim."""
        inner = np.pad(self.where, 1)
        for axis in range(3):
            inner &= np.roll(inner, 1, axis) & np.roll(inner, -1, axis)
        result: Bools = self.where & ~inner[1:-1, 1:-1, 1:-1]
        return result

    @property
    def numbered_alone(self) -> tuple[Layout, Ints]:
        """They alone with numbers of their own, and those of the vertices at the rim."""
        layout, alone = self.layout, lay_out(self.layout.grid, self.layout.octants)
        result = np.full(len(self.rim), -1, np.int64)
        for key, place in zip(layout.grid.keys, layout.places, strict=True):
            octant = layout.octants[key]
            some = place[self._at_rim[tuple(place.T)]]
            number = numbers(layout, octant, some).ravel()
            row = np.minimum(np.searchsorted(self.rim, number), len(self.rim) - 1)
            at_rim = self.rim[row] == number
            result[row[at_rim]] = numbers(alone, octant, some).ravel()[at_rim]
        return alone, result

    @property
    def bounds(self) -> Floats:
        """(2, 3) of their vertices, mm."""
        motion = self.laid.motion
        if motion.frame is None:
            return motion(box(self.layout))
        farthest = []
        for key, place in zip(self.layout.grid.keys, self.layout.places, strict=True):
            octant = self.layout.octants[key]
            if not len(octant.vertices) or not len(place):
                continue
            steps = in_steps(self.layout.grid, octant)
            corner, sign = self.layout.frames(place)
            for frame in np.unique(sign, axis=0):
                # What is farthest has the farthest place and the farthest vertex of an octant.
                own, points = corner[(sign == frame).all(axis=1)], frame * steps
                where, what = motion.turned(1.0 * own), motion.turned(points)
                for end in (np.argmin, np.argmax):
                    at, of = end(where, axis=0), end(what, axis=0)
                    farthest.append(motion(placed(self.layout.grid, own[at], points[of])))
        return box_of(np.concatenate(farthest))

    def middle(self, places: Ints) -> Floats:
        """(k, 3) the middles of octants at some places, mm."""
        grid = self.laid.layout.grid
        return self.laid.motion(grid.origin + 0.5 * grid.cell_size * (places - 0.5))

    def caps(self, monitor: Monitor) -> Caps:
        """What closes the solid that follows on them, seen from there."""
        layout, others = self.laid.layout, (self.laid.layout.grid.kind >= 0) & ~self.where
        every, at = [], np.zeros_like(others)
        for axis in range(3):
            for high in (False, True):
                missing = neighbour_missing(layout.grid, others, axis, high)
                missing &= ~neighbour_missing(layout.grid, others | self.where, axis, high)
                every.append(facets(layout, monitor, missing, (axis, high)))
                at |= missing
        mesh, number = self.laid.mesh(np.concatenate(every), at, monitor)
        row = np.minimum(np.searchsorted(self.rim, number), len(self.rim) - 1)
        return Caps(mesh, np.where(self.rim[row] == number, row, -1))

    def reached(self, corners: Floats) -> Bools:
        """(nx, ny, nz) bool, those of them that (k, 3, 3) triangles reach into."""
        grid = self.laid.layout.grid
        # Octant 0 lies on the low side of the grid's corner.
        places = (self.laid.motion.back(corners) - grid.origin) / (0.5 * grid.cell_size) + 1.0
        limit = np.array(self.where.shape)
        low = np.clip(np.floor(places.min(axis=1) + REACH).astype(np.int64), 0, limit)
        high = np.clip(np.ceil(places.max(axis=1) - REACH).astype(np.int64), 0, limit)
        span = np.maximum(high - low, 0)
        row, place = spread(span.prod(axis=1))
        place, z = np.divmod(place, span[row, 2])
        x, y = np.divmod(place, span[row, 1])
        index = low[row] + np.stack([x, y, z], axis=1)
        some = self.where[tuple(index.T)]
        index, row = index[some], row[some]
        # A large triangle is near few of the octants that its box is near.
        normal = np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])[row]
        above = np.einsum("ij,ij->i", index + 0.5 - places[row, 0], normal)
        meets = np.abs(above) <= (0.5 - REACH) * np.abs(normal).sum(axis=1)
        result = np.zeros(self.where.shape, bool)
        result[tuple(index[meets].T)] = True
        return result


@dataclass(frozen=True, eq=False)
class TrimmedSurface:
    """A closed surface in two parts.

    Attributes:
        mesh: what was cut; open where octants inside follow.
        octants: those that belong to the surface beside the mesh; None for none.
    """

    mesh: TriangleMesh
    octants: InnerOctants | None = None

    @property
    def triangles(self) -> int:
        """How many there are in both parts."""
        return len(self.mesh.triangles) + (self.octants.pieces.triangles if self.octants else 0)

    @property
    def bounds(self) -> Floats:
        """(2, 3) of both parts, mm."""
        if self.octants is None:
            return self.mesh.bounds
        return box_of(np.concatenate([self.mesh.bounds, self.octants.bounds]))

    def whole(self, monitor: Monitor) -> TriangleMesh:
        """All of it as one mesh: first what was cut, then the octants."""
        if self.octants is None:
            return self.mesh
        return self.with_octants(self.octants.where, monitor).mesh

    def with_octants(self, where: Bools, monitor: Monitor) -> TrimmedSurface:
        """The surface with some of the octants in its mesh."""
        inner = self.octants
        if inner is None or not where.any():
            return self
        more, number = inner.laid.mesh(inner.laid.facets(where, monitor), where, monitor)
        # Vertices that both parts have are the mesh's.
        place = np.minimum(np.searchsorted(number, inner.rim), len(number) - 1)
        shared = number[place] == inner.rim
        fresh = np.ones(len(number), bool)
        fresh[place[shared]] = False
        row = np.cumsum(fresh) - 1 + len(self.mesh.vertices)
        row[place[shared]] = self._rim_rows[shared]
        mesh = TriangleMesh(
            np.concatenate([self.mesh.vertices, more.vertices[fresh]]),
            np.concatenate([self.mesh.triangles, row.astype(np.int32)[more.triangles]]),
        )
        rest = inner.where & ~where
        return TrimmedSurface(mesh, InnerOctants(inner.laid, rest) if rest.any() else None)

    @property
    def is_joined(self) -> bool:
        """Whether the mesh is open just where the octants are, edge for edge."""
        if self.octants is None:
            return True
        return bool((self._rim_rows >= 0).all()) and self._rim_triangles is not None

    def has_inner_edges(self, among: Bools) -> bool:
        """Whether chosen triangles of the mesh join vertices at the rim otherwise than along it."""
        at_rim = np.zeros(len(self.mesh.vertices), bool)
        at_rim[self._rim_rows] = True
        start = self.mesh.triangles[among].astype(np.int64)
        end = np.roll(start, -1, axis=1)
        both = at_rim[start] & at_rim[end]
        size = np.int64(len(at_rim))
        row = self._rim_rows[np.searchsorted(self._inner.rim, self._inner.pieces.rim)]
        return not np.isin(start[both] * size + end[both], row[:, 1] * size + row[:, 0]).all()

    def inspected(self, monitor: Monitor) -> JoinedInspection:
        """Topology, volume and size of the whole.

        Raises:
            RuntimeError: the parts do not fit together.
        """
        found = inspect(self.mesh, monitor)
        inner = self.octants
        if inner is None:
            return JoinedInspection(found, np.zeros(len(found.volume), bool))
        if not self.is_joined:
            raise RuntimeError("the octants inside do not fit to what the wall has cut")
        pieces, cut, count = inner.pieces, found.quality, len(found.volume)
        # Two parts enclose their volume about one point only together.
        own = pieces.volume_about(inner.laid.motion.back(cut.bounds.mean(axis=0)))
        shells, label = pieces_of(
            found.shell[self._rim_triangles].astype(np.int64),
            count + pieces.piece_at_rim,
            count + len(own),
        )
        both = np.concatenate([found.volume, own])
        volume = np.bincount(label, both, minlength=shells).astype(np.float64)
        shell = label[found.shell].astype(np.int32)
        beyond, used = np.zeros(shells, bool), np.zeros(shells, bool)
        beyond[label[count:]] = True
        used[shell] = True
        used |= beyond
        vertices = cut.vertices + inner.layout.count - len(inner.rim)
        sound = not (cut.overused_edges or cut.misoriented_edges or _repeats(self.mesh.triangles))
        quality = Quality(
            triangles=self.triangles,
            vertices=vertices,
            watertight=sound and cut.open_edges == len(pieces.rim),
            open_edges=cut.open_edges - len(pieces.rim),
            overused_edges=cut.overused_edges,
            misoriented_edges=cut.misoriented_edges,
            degenerate_triangles=cut.degenerate_triangles + pieces.degenerate,
            shells=int(used.sum()),
            bodies=int((volume[used] > 0).sum()),
            voids=int((volume[used] < 0).sum()),
            genus=int(used.sum()) - (vertices - self.triangles // 2) // 2 if sound else -1,
            volume=float(volume.sum()),
            area=cut.area + pieces.area,
            bounds=self.bounds,
        )
        return JoinedInspection(Inspection(quality, shell, volume), beyond)

    @property
    def rim_rows(self) -> Ints:
        """(k,) the mesh's vertices at the octants' rim.

        Raises:
            RuntimeError: some are not there.
        """
        if (self._rim_rows < 0).any():
            raise RuntimeError("the octants inside do not fit to what the wall has cut")
        return self._rim_rows

    @property
    def _inner(self) -> InnerOctants:
        if self.octants is None:
            raise RuntimeError("no octants are beside the mesh")
        return self.octants

    @cached_property
    def _rim_rows(self) -> Ints:
        """The mesh's vertices at the rim, as they are at the octants' rim; -1 for none."""
        return equal_rows(self._inner.rim_points, self.mesh.vertices)

    @cached_property
    def _rim_triangles(self) -> Ints | None:
        """The mesh's triangles at each open edge of the octants; None where any does not fit."""
        row = np.full(len(self.mesh.vertices), -1, np.int64)
        row[self._rim_rows] = np.arange(len(self._inner.rim))
        # Twice among candidates: only triangles with two corners at the rim have an edge there.
        some = np.flatnonzero(corners_among(row >= 0, self.mesh.triangles) >= 2)
        corners = row[self.mesh.triangles[some]]
        start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
        here = (start >= 0) & (end >= 0)
        start, end, owner = start[here], end[here], np.repeat(some, 3)[here]
        size = np.int64(len(self._inner.rim))
        key = start * size + end
        is_open = ~np.isin(key, end * size + start)
        key, owner = key[is_open], owner[is_open]
        order = np.argsort(key)
        # The octants' edges run the other way.
        first, second = np.searchsorted(self._inner.rim, self._inner.pieces.rim).T
        wanted = second * size + first
        place = np.argsort(wanted)
        if not np.array_equal(key[order], wanted[place]):
            return None
        result = np.empty(len(wanted), np.int64)
        result[place] = owner[order]
        return result


def concatenated_at(mesh: TriangleMesh, rows: Ints, caps: Caps) -> TriangleMesh:
    """A mesh closed by caps; `rows` are its vertices at the rim."""
    fresh = caps.at_rim < 0
    number = rows[caps.at_rim]
    number[fresh] = len(mesh.vertices) + np.arange(int(fresh.sum()))
    return TriangleMesh(
        np.concatenate([mesh.vertices, caps.mesh.vertices[fresh]]),
        np.concatenate([mesh.triangles, number.astype(np.int32)[caps.mesh.triangles]]),
    )


def _repeats(triangles: NDArray[np.int32]) -> bool:
    """Whether a triangle names a vertex twice."""
    a, b, c = (triangles[:, k] for k in range(3))
    return bool(((a == b) | (b == c) | (c == a)).any())


def equal_rows(points: Floats, among: Floats) -> Ints:
    """(k,) the row of `among` (n, 3) with the very same numbers as each of `points`; -1: none."""
    ours, theirs = _hashed(points), _hashed(among)
    # Most rows end otherwise than all that are looked for, and need no place in an order.
    asked = np.zeros(ASKED, bool)
    asked[ours % ASKED] = True
    some = np.flatnonzero(asked[theirs % ASKED])
    if not len(some):
        return np.full(len(ours), -1, np.int64)
    some = some[np.argsort(theirs[some])]
    row = some[np.minimum(np.searchsorted(theirs[some], ours), len(some) - 1)]
    result: Ints = np.where((among[row] == points).all(axis=1), row, -1)
    return result


def _hashed(points: Floats) -> NDArray[np.uint64]:
    """(n,) a number for each point, equal where the coordinates are."""
    x, y, z = (np.ascontiguousarray(points[:, k] + 0.0).view(np.uint64) for k in range(3))
    with np.errstate(over="ignore"):
        mixed = x * np.uint64(0x9E3779B97F4A7C15) ^ (y * np.uint64(0xC2B2AE3D27D4EB4F))
        mixed = (mixed ^ (mixed >> np.uint64(29))) * np.uint64(0xBF58476D1CE4E5B9)
        mixed += z * np.uint64(0x165667B19E3779F9)
        result: NDArray[np.uint64] = mixed ^ (mixed >> np.uint64(32))
    return result
