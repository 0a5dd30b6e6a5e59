# SPDX-License-Identifier: LGPL-2.1-or-later
"""The surface of a trimmed lattice: a mesh of what the wall has cut, and whole octants inside.

What the wall does not cross needs no look at its triangles: it is proved by kinds of octants, and
joined to the mesh where both are open, by the vertices that they share.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..lattice.assembly import facet_blocks
from ..mesh.open_shells import ORIGIN, OpenShells, joined_shells, open_shells
from ..mesh.quality import Inspection, Quality, inspect, present_shells
from ..mesh.topology import corners_among, pieces_of, touching, vertices_of, ways_along
from ..mesh.triangle_mesh import TriangleMesh, box_of, corners_at
from ..spatial.resolve_crossings import Looks
from ..spatial.winding import Lines, Windings, mesh_blocks
from ..util.parallel import ParallelBackend
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .placed_lattice import Caps, InnerOctants, PlacedVertices

#: Points are first told apart by what is left of their hashes by this.
ASKED = 1 << 22


@dataclass(frozen=True, eq=False)
class JoinedInspection:
    """A surface's quality, and the shells that it was found on.

    Attributes:
        found: of the whole; its triangles are those of the mesh.
        beyond: (shells,) bool, which shells have a share of the octants beside the mesh.
        within: (shells,) bool, which shells have a share of the mesh.
    """

    found: Inspection
    beyond: Bools
    within: Bools


@dataclass(frozen=True, eq=False)
class TrimmedSurface:
    """A closed surface in two parts.

    Attributes:
        mesh: what was cut; open where octants inside follow.
        octants: those that belong to the surface beside the mesh; None for none.
        looks: what is known of the mesh's triangles; None: nothing.
        rim_guess: (k,) the mesh's vertices that are probably those at the octants' rim, or those
            that are known of them; None: not known.
        shells: of the mesh, which is open nowhere but at the rim; None: not known.
    """

    mesh: TriangleMesh
    octants: InnerOctants | None = None
    looks: Looks | None = None
    rim_guess: Ints | None = None
    shells: OpenShells | None = None

    def on(
        self,
        mesh: TriangleMesh,
        looks: Looks | None = None,
        number: Callable[[Ints], NDArray[np.integer[Any]]] | None = None,
        shells: OpenShells | None = None,
    ) -> TrimmedSurface:
        """The surface with another mesh, and what is known of that.

        Args:
            mesh: in place of its own.
            looks: of the mesh.
            number: gives the numbers that vertices of its own have there; None: the same.
            shells: of the mesh.
        """
        if self.octants is None:
            return TrimmedSurface(mesh, None, looks, None, shells)
        guess = self.__dict__.get("_rim_rows", self.rim_guess)
        if guess is not None and number is not None:
            guess = number(guess).astype(np.int64)
        return TrimmedSurface(mesh, self.octants, looks, guess, shells)

    @property
    def triangles(self) -> int:
        """How many there are in both parts."""
        return len(self.mesh.triangles) + (self.octants.triangles if self.octants else 0)

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
        return self.with_octants(self.octants.where, monitor, ParallelBackend()).mesh

    def with_octants(
        self, where: Bools, monitor: Monitor, backend: ParallelBackend | None = None
    ) -> TrimmedSurface:
        """The surface with some of the octants in its mesh.

        Args:
            where: (nx, ny, nz) bool, the octants.
            monitor: for cancel.
            backend: gathers the mesh, for its calls; None: the monitor's.
        """
        backend = backend or monitor.backend
        inner = self.octants
        if inner is None or not where.any():
            return self
        more, number = inner.lattice.mesh(inner.lattice.facets(where, monitor), where, monitor)
        # Vertices that both parts have are the mesh's.
        place = np.minimum(np.searchsorted(number, inner.rim), len(number) - 1)
        shared = (number[place] == inner.rim) & (self._rim_rows >= 0)
        fresh = np.ones(len(number), bool)
        fresh[place[shared]] = False
        row = np.cumsum(fresh) - 1 + len(self.mesh.vertices)
        row[place[shared]] = self._rim_rows[shared]
        mesh = TriangleMesh(
            backend.extended(self.mesh.vertices, more.vertices[fresh]),
            backend.extended(self.mesh.triangles, row.astype(np.int32)[more.triangles]),
        )
        rest = inner.where & ~where
        looks = self.looks and self.looks.padded(0, len(more.triangles))
        shells = self._shells_with(more, self._rim_rows[shared], place[shared], len(mesh.vertices))
        if not rest.any():
            return TrimmedSurface(mesh, None, looks, None, shells)
        if (self._rim_rows < 0).any():
            return TrimmedSurface(mesh, InnerOctants(inner.lattice, rest), looks)
        # The others are open where all were, and where those that are in the mesh now follow.
        numbers = np.concatenate([number, inner.rim[~shared]])
        order = np.argsort(numbers, kind="stable")
        rows = np.concatenate([row, self._rim_rows[~shared]])[order]
        known = PlacedVertices(numbers[order], mesh.vertices[rows])
        return TrimmedSurface(mesh, InnerOctants(inner.lattice, rest, known), looks, rows, shells)

    def _shells_with(
        self, more: TriangleMesh, ours: Ints, theirs: Ints, vertices: int
    ) -> OpenShells | None:
        """The shells of the mesh with octants in it; None where they, or its own, are not known.

        Args:
            more: these octants.
            ours: vertices of the mesh that octants have, too.
            theirs: the same vertices, as octants number them.
            vertices: how many there are then.
        """
        if self.shells is None or not self.is_joined:
            return None
        others = open_shells(more)
        if others is None:
            return None
        at_rim = touching(vertices_of(ours, len(self.mesh.vertices)), self.mesh.triangles)
        first = self.shells.at(ours, self.mesh, np.flatnonzero(at_rim))
        second = others.at(theirs, more, np.arange(len(more.triangles)))
        pair = self.shells, others
        return joined_shells(pair, first, second + len(self.shells.volume), vertices)

    def met_by(self, lines: Lines) -> Windings:
        """What lines meet of it."""
        return lines.windings(self._near(lines))

    def _near(self, lines: Lines) -> Iterator[Floats]:
        """(k, 3, 3) the corners of triangles, some at a time, without many that no line meets."""
        inner = self.octants
        points = None if inner is None else inner.lattice.points
        mesh = self.mesh if points is not None else self.whole(Monitor())
        yield from lines.near(mesh.vertices, mesh_blocks(mesh))
        if inner is not None and points is not None:
            yield from lines.near(points, facet_blocks(inner.layout))

    @property
    def is_joined(self) -> bool:
        """Whether the mesh is open just where the octants are, edge for edge."""
        if self.octants is None:
            return True
        return bool((self._rim_rows >= 0).all()) and self._rim_triangles is not None

    def has_inner_edges(self, triangles: NDArray[np.int32]) -> bool:
        """Whether triangles of the mesh's vertices join some at the rim otherwise than along it."""
        at_rim = np.zeros(len(self.mesh.vertices), bool)
        at_rim[self._rim_rows] = True
        start = triangles.astype(np.int64)
        end = np.roll(start, -1, axis=1)
        both = at_rim[start] & at_rim[end]
        size = np.int64(len(at_rim))
        row = self._rim_rows[np.searchsorted(self._inner.rim, self._inner.pieces.rim)]
        return not np.isin(start[both] * size + end[both], row[:, 1] * size + row[:, 0]).all()

    def inspected(self, monitor: Monitor, shells: OpenShells | None = None) -> JoinedInspection:
        """Topology, volume and size of the whole; with `shells` in place of those of its mesh.

        Raises:
            RuntimeError: the parts do not fit together.
        """
        inner, shells = self.octants, shells or self.shells
        if shells is None:
            found = inspect(self.mesh, monitor)
        else:
            found = shells.inspection(self.mesh, 0 if inner is None else len(inner.pieces.rim))
        if inner is None:
            within = present_shells(found.shell, len(found.volume))
            return JoinedInspection(found, np.zeros_like(within), within)
        if not self.is_joined:
            raise RuntimeError("the octants inside do not fit to what the wall has cut")
        pieces, cut, count = inner.pieces, found.quality, len(found.volume)
        # Two parts enclose their volume about one point only together.
        centre = cut.bounds.mean(axis=0) if shells is None else ORIGIN
        own = pieces.volume_about(inner.lattice.motion.back(centre))
        both, label = pieces_of(
            found.shell[self._rim_triangles].astype(np.int64),
            count + pieces.piece_at_rim,
            count + len(own),
        )
        each = np.concatenate([found.volume, own])
        volume = np.bincount(label, each, minlength=both).astype(np.float64)
        shell, own_label = found.shell, label[:count].astype(np.int32)
        beyond, within = np.zeros(both, bool), np.zeros(both, bool)
        beyond[label[count:]] = True
        within[own_label[present_shells(shell, count)]] = True
        used = within | beyond
        if not np.array_equal(own_label, np.arange(count)):
            shell = own_label[shell]
        vertices = cut.vertices + inner.layout.count - len(inner.rim)
        triangles = cut.triangles + pieces.triangles
        sound = not (cut.overused_edges or cut.misoriented_edges)
        sound &= shells is not None or not _repeats(self.mesh.triangles)
        quality = Quality(
            triangles=triangles,
            vertices=vertices,
            watertight=sound and cut.open_edges == len(pieces.rim),
            open_edges=cut.open_edges - len(pieces.rim),
            overused_edges=cut.overused_edges,
            misoriented_edges=cut.misoriented_edges,
            degenerate_triangles=cut.degenerate_triangles + pieces.degenerate,
            shells=int(used.sum()),
            bodies=int((volume[used] > 0).sum()),
            voids=int((volume[used] < 0).sum()),
            genus=int(used.sum()) - (vertices - triangles // 2) // 2 if sound else -1,
            volume=float(volume.sum()),
            area=cut.area + pieces.area,
            bounds=box_of(np.concatenate([cut.bounds, inner.bounds])),
        )
        return JoinedInspection(Inspection(quality, shell, volume), beyond, within)

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
    def rows_about_rim(self) -> Ints:
        """The mesh's vertices at the octants' rim, and maybe others that octants have.

        Raises:
            RuntimeError: some of the rim are not there.
        """
        guess, known = self.rim_guess, self._inner.known
        if guess is not None and known is not None and self._is_at(guess, known.points):
            return guess  # of all that are known, so that nobody asks which are the rim's
        return self.rim_rows

    def _is_at(self, rows: Ints, points: Floats) -> bool:
        """Whether rows of the mesh's vertices have the very same numbers as so many points."""
        if len(rows) != len(points) or not (rows >= 0).all():
            return False
        return np.array_equal(np.take(self.mesh.vertices, rows, axis=0, mode="clip"), points)

    @property
    def _inner(self) -> InnerOctants:
        if self.octants is None:
            raise RuntimeError("no octants are beside the mesh")
        return self.octants

    @cached_property
    def _rim_rows(self) -> Ints:
        """The mesh's vertices at the rim, as they are at the octants' rim; -1 for none."""
        points, guess, known = self._inner.rim_points, self.rim_guess, self._inner.known
        if guess is not None and known is not None and len(guess) == len(known.numbers):
            guess = guess[self._inner.rim_in_known]
        if guess is not None and self._is_at(guess, points):
            return guess
        return equal_rows(points, self.mesh.vertices)

    @cached_property
    def _rim_triangles(self) -> Ints | None:
        """The mesh's triangles at each open edge of the octants; None where any does not fit."""
        at_rim = vertices_of(self._rim_rows, len(self.mesh.vertices))
        row = np.empty(len(at_rim), np.int64)  # of no meaning elsewhere, and not read
        row[self._rim_rows] = np.arange(len(self._inner.rim))
        # Twice among candidates: only triangles with two corners at the rim have an edge there.
        some = rows_along(at_rim, self.mesh.triangles, self.looks)
        corners = corners_at(self.mesh.triangles, some)
        start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
        here = at_rim[start] & at_rim[end]
        start, end, owner = row[start[here]], row[end[here]], np.repeat(some, 3)[here]
        size = np.int64(len(self._inner.rim))
        way = ways_along(start, end, size)
        # Open edges are run along one way only. Numpy sorts numbers alone in a fifth of the time.
        every = np.sort(way)
        begins = np.flatnonzero(np.diff(every >> 1, prepend=-1))
        often = np.diff(begins, append=len(every))
        is_open = np.repeat(every[begins] == every[begins + often - 1], often)
        # The octants' edges run the other way.
        first, second = np.searchsorted(self._inner.rim, self._inner.pieces.rim).T
        wanted = ways_along(second, first, size)
        place = np.argsort(wanted)
        if not np.array_equal(every[is_open], wanted[place]):
            return None
        result = np.empty(len(wanted), np.int64)
        if len(wanted):
            row = np.searchsorted(wanted, way, sorter=place)
            at = place[np.minimum(row, len(wanted) - 1)]
            met = wanted[at] == way
            result[at[met]] = owner[met]
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


def rows_along(chosen: Bools, triangles: NDArray[np.int32], looks: Looks | None) -> Ints:
    """Triangles with two corners among chosen vertices, (n,) bool, that may have an open edge.

    Args:
        chosen: vertices at open edges.
        triangles: of the mesh.
        looks: what is known of them; None: nothing.
    """
    if looks is None:
        return np.flatnonzero(corners_among(chosen, triangles) >= 2)
    some = looks.unjudged
    result: Ints = some[corners_among(chosen, triangles[some]) >= 2]
    return result


def _repeats(triangles: NDArray[np.int32]) -> bool:
    """Whether a triangle names a vertex twice."""
    a, b, c = (triangles[:, k] for k in range(3))
    return bool(((a == b) | (b == c) | (c == a)).any())


def equal_rows(points: Floats, among: Floats) -> Ints:
    """(k,) the row of `among` (n, 3) with the very same numbers as each of `points`; -1: none."""
    ours, theirs = hash_points(points), hash_points(among)
    # Most rows end otherwise than all that are looked for, and need no place in an order.
    asked = np.zeros(ASKED, bool)
    asked[ours % ASKED] = True
    some = np.flatnonzero(asked[theirs % ASKED])
    if not len(some):
        return np.full(len(ours), -1, np.int64)
    some = some[np.argsort(theirs[some])]
    theirs = theirs[some]
    result: Ints = np.full(len(ours), -1, np.int64)
    waiting, place = np.arange(len(ours)), np.searchsorted(theirs, ours)
    while len(waiting):  # other points may have the same number
        alike = theirs[np.minimum(place, len(some) - 1)] == ours[waiting]
        alike &= place < len(some)
        waiting, place = waiting[alike], place[alike]
        row = some[place]
        found = (among[row] == points[waiting]).all(axis=1)
        result[waiting[found]] = row[found]
        waiting, place = waiting[~found], place[~found] + 1
    return result


def hash_points(points: Floats) -> NDArray[np.uint64]:
    """(n,) a number for each point, equal where the coordinates are.

    Each coordinate is mixed in by the finaliser of SplitMix64 (Steele, Lea and Flood, 2014): cells
    repeat, and less leaves points whose coordinates differ by the same steps with one number.
    """
    result = np.zeros(len(points), np.uint64)
    with np.errstate(over="ignore"):
        for k in range(3):
            result ^= np.ascontiguousarray(points[:, k] + 0.0).view(np.uint64)
            for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
                result ^= result >> np.uint64(shift)
                result *= np.uint64(factor)
            result ^= result >> np.uint64(31)
    return result
