# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets that run through each other once a file has rounded them, drawn apart.

Where a wall grazes a strut two sheets of a surface enclose a wedge that is as thin as the steps of
single precision, and where struts have next to no room between them facets fold over. Both have an
edge at which the surface turns back, or one that is sharper than struts have it: only there, and in
the triangles next to it, is looked.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..mesh.precision import decimal_step, rounded
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..util.progress import Monitor
from ..util.threads import in_threads
from ..util.types import Bools, Floats, Ints
from .crossing_watch import CrossingWatch
from .piercing import pairs_at_planes, piercing_among

#: The surface turns back at an edge where the cosine between its normals is below this.
TURNS_BACK = -0.9
#: Deformed struts do so at an edge that sticks out and is sharper than this: facets round a strut
#: turn by 60 degrees at most, and where struts meet is a valley.
STICKS_OUT = -0.2
#: Vertices of crossing triangles move by so much of the way to the middle of their neighbours, one
#: share after the other; below 0 that far anywhere.
SHARES = (1e-4, -1e-3, 1e-3, -1e-3, 0.01, -0.01, 0.03, -0.03, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3,
          0.5, -0.1, 0.5, -0.3, 0.5, -0.3)  # fmt: skip
#: Facets that fold overlap by more than a hair.
FOLDED_SHARES = (0.1, 0.3, 0.5, 0.5, 0.5, 0.5, -0.1, 0.5)
#: By how much a vertex' rough normals may be wrong, each.
ROUGHNESS = 1e-6
#: Triangles whose rough normals are found at a time: they should stay in the processor's cache.
BLOCK_TRIANGLES = 1 << 15
#: Places that cross are looked at with what lies nearer than so many of their triangles' edges;
#: more places than these with everything.
REACH, MOST_PLACES = 4.0, 200
#: So many triangles of a deformed mesh are all looked at, which takes a fifth of a second.
MOST_ANYWHERE = 40_000
#: From this share on each place that is left gets a ring more every second time.
DEEP = 0.1
#: So many rings of triangles round those that cross move, at most.
MOST_RINGS = 3
#: With so many times fewer places that cross than at first only what is about them is watched.
FEWER = 0.1
#: Of many places a round that goes so far and leaves more than this part of them as they are is the
#: last one: folds that are all alike may need more than a little way, all of them.
FAR, STUCK = 0.5, 0.95


@dataclass(frozen=True, eq=False)
class Turns:
    """Where a surface turns back on itself.

    Attributes:
        among: (m,) bool, triangles that have a corner at such an edge.
        pairs: (k, 2) triangles, among these or beside them, that cross in a file.
    """

    among: Bools
    pairs: Ints

    def followed_by(self, more: int) -> Turns:
        """The same, of a mesh to which so many triangles were added."""
        return Turns(np.pad(self.among, (0, more)), self.pairs)


def turns_of(mesh: TriangleMesh, monitor: Monitor, deformed: bool = False) -> Turns:
    """Where a mesh turns back, and crosses itself there; as of `uncrossed`.

    Deformed struts of different joints may meet where nothing turns back: of a mesh that is no
    larger than `MOST_ANYWHERE` all is looked at.
    """
    if deformed and len(mesh.triangles) <= MOST_ANYWHERE:
        among = np.ones(len(mesh.triangles), bool)
    else:
        among = turning_back(mesh, deformed)
    return Turns(among, _crossing(mesh, among, monitor))


def uncrossed(
    mesh: TriangleMesh, monitor: Monitor, deformed: bool = False, turns: Turns | None = None
) -> tuple[TriangleMesh, Floats | None]:
    """The mesh with no triangles that cross where its surface turns back, as far as that goes.

    Vertices of triangles that cross move a little towards the middle of their neighbours, or
    anywhere, in turn. A move that leaves more crossings than before is taken back.

    Args:
        mesh: closed, or open where nothing turns back.
        monitor: asked for a cancel.
        deformed: whether vertices are elsewhere than they were meshed, so that facets may fold.
        turns: of the mesh, where they are known.

    Returns:
        The mesh, the same one where nothing crosses; and (3,) where triangles still do, mm.
    """
    turns = turns or turns_of(mesh, monitor, deformed)
    everywhere, pairs = turns.among, turns.pairs
    if not len(pairs):
        return mesh, None
    among, before = _about(mesh, pairs, everywhere), mesh
    places = _Places.around(mesh, pairs, among, monitor)
    for share in FOLDED_SHARES if deformed else SHARES:
        if not len(places.pairs):
            break
        crossed = len(places.pairs)
        places.move(share)
        stuck = crossed > MOST_PLACES and len(places.pairs) > STUCK * crossed
        if deformed and share >= FAR and stuck:
            break
    mesh, pairs = places.mesh, places.found
    if among is not everywhere:  # what moved may have met what lies farther away
        elsewhere = (mesh.vertices != before.vertices).any(axis=1)
        went = _touching(elsewhere, mesh.triangles.T)
        farther = _crossing(mesh, everywhere | went, monitor, elsewhere)
        pairs = np.unique(np.concatenate([pairs, farther]), axis=0)
    if not len(pairs):
        return mesh, None
    return mesh, mesh.vertices[mesh.triangles[pairs[0, 0]]].mean(axis=0)


class _Places:
    """Where triangles of a mesh cross, with what lies about there; vertices that move.

    Attributes:
        pairs: (k, 2) of the part's triangles that cross now.
    """

    def __init__(
        self, mesh: TriangleMesh, rows: Ints, pairs: Ints, free: Bools, monitor: Monitor
    ) -> None:
        """Triangles `rows` of a mesh, some of which cross; `free` vertices may move."""
        self._whole, self._rows = mesh, rows
        self._used = np.unique(mesh.triangles[rows])
        number = np.zeros(len(mesh.vertices), np.int32)
        number[self._used] = np.arange(len(self._used))
        self._triangles = number[mesh.triangles[rows]]
        self._corners = np.ascontiguousarray(self._triangles.T)
        self._vertices = mesh.vertices[self._used]
        self._free = free[self._used]
        self.pairs = np.searchsorted(rows, pairs)
        own = self._vertices[self._triangles[np.unique(self.pairs)]]
        self._farthest = float(np.median((own.max(axis=1) - own.min(axis=1)).max(axis=1)))
        # How many rings of vertices move about each that crosses.
        self._rings = np.ones(len(self._used), np.int8)
        self._deep = 0
        self._random = np.random.default_rng(0)
        self._monitor = monitor
        self._watch = self._watched()

    @classmethod
    def around(cls, mesh: TriangleMesh, pairs: Ints, among: Bools, monitor: Monitor) -> _Places:
        """With triangles among the chosen or beside them, and all that may move."""
        near, corners = np.zeros(len(mesh.vertices), bool), np.ascontiguousarray(mesh.triangles.T)
        near[mesh.triangles[pairs]] = True
        for _ in range(MOST_RINGS):
            near[mesh.triangles[_touching(near, corners)]] = True
        near[mesh.triangles[among]] = True
        inside = _touching(near, corners)
        free = np.ones(len(mesh.vertices), bool)
        free[mesh.triangles[~inside]] = False
        return cls(mesh, np.flatnonzero(inside), pairs, free, monitor)

    @property
    def mesh(self) -> TriangleMesh:
        """The whole mesh as it is now; the same one if nothing has moved."""
        vertices = self._whole.vertices
        if np.array_equal(vertices[self._used], self._vertices):
            return self._whole
        vertices = vertices.copy()
        vertices[self._used] = self._vertices
        return TriangleMesh(vertices, self._whole.triangles)

    @property
    def found(self) -> Ints:
        """(k, 2) of the whole mesh's triangles that cross now."""
        result: Ints = self._rows[self.pairs]
        return result

    def move(self, share: float) -> None:
        """Vertices go so much of their way, or a random one below 0, where that helps."""
        if len(self.pairs) < FEWER * self._watched_pairs:
            self._watch = self._watched()
        chosen = self._grown(MOST_RINGS) & self._free
        rows = np.flatnonzero(chosen)
        here = self._mesh_of(self._vertices)
        way = _to_neighbours(here, rows, self._triangles[self._touching(chosen)])
        long = np.linalg.norm(way, axis=1)
        way *= np.minimum(1.0, self._farthest / np.maximum(long, 1e-300))[:, None]
        if share < 0.0:
            long = np.minimum(long, self._farthest)
            way = self._random.normal(size=way.shape) * long[:, None]
        vertices = self._vertices.copy()
        vertices[rows] += abs(share) * way
        left = self._watch.crossing(vertices, chosen)
        worse = _got_worse(here, chosen, self.pairs, left)
        if worse.any():  # each place by itself: what got worse there goes back
            vertices[worse] = self._vertices[worse]
            chosen &= ~worse
            stays = ~self._touching(chosen)[self.pairs].any(axis=1)
            left = np.concatenate([self.pairs[stays], self._watch.crossing(vertices, chosen)])
        if len(left) <= len(self.pairs):
            self._vertices, self.pairs = vertices, np.unique(left, axis=0)
        self._deep += share >= DEEP
        if share >= DEEP and not self._deep % 2:  # places that are left need more room
            still = np.unique(self._triangles[self.pairs])
            self._rings[still] = np.minimum(self._rings[still] + 1, MOST_RINGS + 1)

    def _watched(self) -> CrossingWatch:
        self._watched_pairs = len(self.pairs)
        near = self._touching(self._grown(MOST_RINGS))
        return CrossingWatch(self._mesh_of(self._vertices), near, self._monitor)

    def _grown(self, most: int) -> Bools:
        """(n,) the vertices of triangles that cross, and their rings, at most so many."""
        level = np.zeros(len(self._used), np.int8)
        some = np.unique(self._triangles[self.pairs])
        level[some] = self._rings[some]
        for _ in range(most):
            if not (level > 1).any():
                break
            rows = self._triangles[self._touching(level > 1)]
            np.maximum.at(level, rows.ravel(), np.repeat(level[rows].max(axis=1) - 1, 3))
        return np.asarray(level > 0, np.bool_)

    def _touching(self, near: Bools) -> Bools:
        return _touching(near, self._corners)

    def _mesh_of(self, vertices: Floats) -> TriangleMesh:
        return TriangleMesh(vertices, self._triangles)


def _about(mesh: TriangleMesh, pairs: Ints, among: Bools) -> Bools:
    """(m,) of some triangles those about pairs that cross; all of them where there are many."""
    if not 0 < len(pairs) <= MOST_PLACES:
        return among
    rows = np.flatnonzero(among)
    low, high = _ends(mesh, pairs.ravel())
    low, high = low.reshape(-1, 2, 3), high.reshape(-1, 2, 3)
    from_, to = low.min(axis=1), high.max(axis=1)
    reach = REACH * (to - from_).max(axis=1)[:, None]
    # Axis by axis, which numpy takes in faster than rows of three.
    least, most = (np.ascontiguousarray(ends.T) for ends in _ends(mesh, rows))
    meets = np.zeros(len(rows), bool)
    for lowest, highest in zip(from_ - reach, to + reach, strict=True):
        near = np.ones(len(rows), bool)
        for axis in range(3):
            near &= (least[axis] <= highest[axis]) & (most[axis] >= lowest[axis])
        meets |= near
    found = np.zeros(len(among), bool)
    found[rows[meets]] = True
    return found


def _ends(mesh: TriangleMesh, rows: Ints) -> tuple[Floats, Floats]:
    """(k, 3) lowest and highest corners of some triangles."""
    corners = mesh.vertices[mesh.triangles[rows]]
    return corners.min(axis=1), corners.max(axis=1)


def turning_back(mesh: TriangleMesh, deformed: bool = False) -> Bools:
    """(m,) the triangles that have a corner at an edge where the surface turns back on itself.

    Where it is deformed, also those at sharp edges that stick out.
    """
    size = len(mesh.vertices)
    corners, columns = mesh.triangles.T, mesh.vertices.T
    # At both ends of such an edge two of the normals nearly cancel out, and so their sum is short.
    # For that they need not be known well, and half as long numbers take half the memory.
    length, count = np.zeros(size), np.zeros(size, np.int32)
    for along in _rough_normals(columns, corners):
        total = np.zeros(size)
        for corner in corners:
            total += np.bincount(corner, along, size)
        length += np.square(total, out=total)
    for corner in corners:
        count += np.bincount(corner, minlength=size)
    least = STICKS_OUT if deformed else TURNS_BACK
    sharp = np.sqrt(length) <= count - 2.0 + np.sqrt(2.0 + 2.0 * least) + ROUGHNESS * count
    rows = np.flatnonzero(sum(sharp[corner].view(np.int8) for corner in corners) > 1)
    normal = _unit_normals(columns, corners[:, rows])
    start = mesh.triangles[rows].astype(np.int64)
    end = np.roll(start, -1, axis=1)
    side = np.flatnonzero((sharp[start] & sharp[end]).ravel())
    apex = np.roll(start, -2, axis=1).ravel()[side]
    start, end, owner = start.ravel()[side], end.ravel()[side], side // 3
    edge = np.minimum(start, end) * np.int64(size) + np.maximum(start, end)
    order = np.argsort(edge)
    same = edge[order[1:]] == edge[order[:-1]]
    side, other = order[:-1][same], order[1:][same]
    one, two = owner[side], owner[other]
    cosine = sum(along[one] * along[two] for along in normal)
    turned = cosine < TURNS_BACK
    if deformed:
        beyond = mesh.vertices[apex[other]] - mesh.vertices[start[side]]
        sticks_out = sum(along[one] * beyond[:, k] for k, along in enumerate(normal)) < 0.0
        turned |= (cosine < STICKS_OUT) & sticks_out
    near = np.zeros(size, bool)
    near[mesh.triangles[rows[one[turned]]]] = True
    near[mesh.triangles[rows[two[turned]]]] = True
    return _touching(near, corners)


def _rough_normals(columns: Floats, corners: NDArray[np.int32]) -> NDArray[np.float32]:
    """(3, m) the unit normals of triangles, (3, m), of vertices (3, n), to single precision."""
    normal = np.empty(corners.shape, np.float32)

    def block(start: int) -> None:
        part = slice(start, start + BLOCK_TRIANGLES)
        normal[:, part] = _unit_normals(columns, np.ascontiguousarray(corners[:, part]))

    for _ in in_threads(block, range(0, corners.shape[1], BLOCK_TRIANGLES)):
        pass
    return normal


def _unit_normals(columns: Floats, corners: NDArray[np.int32]) -> list[Floats]:
    """Three of (m,): the normals of triangles, (3, m), of length 1, axis by axis."""
    a, b, c = ([column[corner] for column in columns] for corner in corners)
    e, f = ([q[k] - a[k] for k in range(3)] for q in (b, c))
    normal = [e[i] * f[j] - e[j] * f[i] for i, j in ((1, 2), (2, 0), (0, 1))]
    length = np.maximum(np.sqrt(sum(along * along for along in normal)), 1e-300)
    return [along / length for along in normal]


def _touching(near: Bools, corners: NDArray[np.int32]) -> Bools:
    """(m,) which of the triangles, (3, m), have a corner among the near vertices."""
    a, b, c = (near[corner] for corner in corners)
    return np.asarray(a | b | c, np.bool_)


def _crossing(
    mesh: TriangleMesh, among: Bools, monitor: Monitor, moved: Bools | None = None
) -> Ints:
    """(k, 2) triangles, chosen or beside such, that cross in a binary file or in one of text.

    At least one of each two has a vertex that was moved, (n,) bool, where these are given.
    """
    near = np.zeros(len(mesh.vertices), bool)
    near[mesh.triangles[among]] = True
    rows = np.flatnonzero(_touching(near, mesh.triangles.T))
    if not len(rows):
        return np.zeros((0, 2), np.int64)
    step = decimal_step(mesh.vertices)
    part = compact(TriangleMesh(mesh.vertices, mesh.triangles[rows]))
    # Neither rounding moves a coordinate by more than a step: few pairs need an exact look, twice.
    wanted = None if moved is None else _touching(moved, mesh.triangles[rows].T)
    close = pairs_at_planes(part, step, monitor, wanted)
    found = [
        piercing_among(TriangleMesh(vertices, part.triangles), close)
        for vertices in (_single(part.vertices), _single(rounded(part.vertices, step)))
    ]
    pairs: Ints = np.unique(rows[np.concatenate(found)], axis=0)
    return pairs


def _single(vertices: Floats) -> Floats:
    return vertices.astype(np.float32).astype(np.float64)


def _got_worse(mesh: TriangleMesh, chosen: Bools, before: Ints, after: Ints) -> Bools:
    """(n,) the chosen vertices of places where more triangles cross than before."""
    t, size = mesh.triangles, len(mesh.vertices)
    start, end = t.ravel(), np.roll(t, -1, axis=1).ravel()
    both = chosen[start] & chosen[end]
    pairs = (start[both], end[both])
    graph = coo_matrix((np.ones(len(pairs[0]), np.int8), pairs), shape=(size, size))
    count, place = connected_components(graph, directed=False)
    crossing = []
    for found in (before, after):
        corners = t[found].reshape(len(found), 6)
        where = np.where(chosen[corners], place[corners], -1).max(axis=1)
        crossing.append(np.bincount(where[where >= 0], minlength=count))
    return np.asarray(chosen & (crossing[1] > crossing[0])[place], np.bool_)


def _to_neighbours(mesh: TriangleMesh, rows: Ints, near: Ints) -> Floats:
    """(k, 3) the way from vertices, whose triangles are `near`, to their neighbours' middle."""
    size = len(mesh.vertices)
    here = np.tile(near.ravel(), 2)
    there = np.concatenate([np.roll(near, -1, axis=1).ravel(), np.roll(near, 1, axis=1).ravel()])
    degree = np.maximum(np.bincount(here, minlength=size)[rows], 1)
    middle = np.stack(
        [np.bincount(here, mesh.vertices[there, k], minlength=size)[rows] for k in range(3)], axis=1
    )
    result: Floats = middle / degree[:, None] - mesh.vertices[rows]
    return result
