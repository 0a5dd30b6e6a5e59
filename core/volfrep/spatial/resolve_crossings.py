# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets that run through each other once a file has rounded them, drawn apart.

Where a wall grazes a strut two sheets of a surface enclose a wedge that is as thin as the steps of
single precision, and where struts have next to no room between them facets fold over. Both have an
edge at which the surface turns back, or one that is sharper than struts have it: only there, and in
the triangles next to it, is looked. Of a wedge only where rounding may close it: a wall along
struts that lie flat makes one on either side of each, and nearly all of them are open by far more.

Parts of a surface may be looked at before they are joined (`look_at`); of the whole only the rest
is looked at then (`Looks`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..mesh.float32_repair import Repair
from ..mesh.precision import decimal_step, merging
from ..mesh.topology import (
    corners_among,
    displaced_vertices,
    edge_keys,
    pieces_of,
    touching,
    vertices_of,
)
from ..mesh.triangle_mesh import TriangleMesh, compact, concatenate, corners_at, triangle_boxes
from ..util.linalg import cross_columns, normalize
from ..util.parallel import ParallelBackend
from ..util.progress import Monitor
from ..util.threads import in_threads
from ..util.types import Bools, Floats, Ints
from .crossing_watch import CrossingWatch, crossing_in_files
from .piercing import pairs_at_planes
from .regions import in_regions
from .self_intersection import near_corners

#: Vertices of crossing triangles move by so much of the way to the middle of their neighbours, one
#: share after the other; below 0 that far anywhere.
SHARES = (1e-4, -1e-3, 1e-3, -1e-3, 0.01, -0.01, 0.03, -0.03, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3,
          0.5, -0.1, 0.5, -0.3, 0.5, -0.3)  # fmt: skip
#: Facets that fold overlap by more than a hair.
FOLDED_SHARES = (0.1, 0.3, 0.5, 0.5, 0.5, 0.5, -0.1, 0.5)
#: Of a deformed mesh, facets that cross by less than so many steps of a file only graze each other,
#: and so many rounds of `SHARES` are for them.
GRAZING, GRAZED = 8.0, 4
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
#: The surface turns back at an edge where the cosine between its normals is below this.
TURNS_BACK = -0.9
#: Rounding, and slivers that went (`float32_repair.STEPS`), do not close what the third corner on
#: either side of such an edge leaves open by so many steps of a file.
OPEN_STEPS = 1000.0
#: Deformed struts do so at an edge that sticks out and is sharper than this: facets round a strut
#: turn by 60 degrees at most, and where struts meet is a valley.
STICKS_OUT = -0.2
#: By how much a vertex' rough normals may be wrong, each.
ROUGHNESS = 1e-6
#: Triangles whose rough normals are found at a time: they should stay in the processor's cache.
BLOCK_TRIANGLES = 1 << 15
#: Of a triangle it is known whether the surface turns back at its edges, all of them (where it is
#: not, at those to known ones); it does at one of them; it crosses nothing of its part, and meets
#: nothing of another one; it is no sliver of the precision that goes with the step.
JUDGED, TURNED, APART, SOUND = 1, 2, 4, 8
#: A part that is moved is rounded by so much more of a step before files do it.
MORE_ROUNDING = 0.01


@dataclass(frozen=True, eq=False)
class Folds:
    """Where a surface turns back on itself.

    Attributes:
        among: (m,) bool, triangles that have a corner at such an edge.
        pairs: (k, 2) triangles, among these or beside them, that cross in a file.
    """

    among: Bools
    pairs: Ints

    def followed_by(self, more: int) -> Folds:
        """The same, of a mesh to which so many triangles were added."""
        return Folds(np.pad(self.among, (0, more)), self.pairs)


@dataclass(frozen=True, eq=False)
class Looks:
    """What is known of the triangles of a mesh before all of it is looked at.

    Attributes:
        marks: (m,) uint8, for each triangle the sum of `JUDGED`, `TURNED`, `APART` and `SOUND`.
        step: of the decimals that a text resolves, for which they are apart, mm.
        close: (k, 2) those of which it hangs on how a file rounds them whether they cross.
    """

    marks: NDArray[np.uint8]
    step: float
    close: Ints = field(default_factory=lambda: np.zeros((0, 2), np.int64))

    def of(self, rows: Ints | Bools) -> Looks:
        """The same, of some of the triangles."""
        return Looks(self.marks[rows], self.step)

    def elsewhere(self, moved: Sequence[TriangleMesh]) -> list[Looks]:
        """The same, of parts that were moved: a file rounds them otherwise there."""
        used = np.unique(self.close)
        close = np.searchsorted(used, self.close)
        parts = [compact(TriangleMesh(mesh.vertices, mesh.triangles[used])) for mesh in moved]
        begin = len(used) * np.arange(len(parts))
        every = (begin[:, None, None] + close).reshape(-1, 2)
        crossing = crossing_in_files(concatenate(*parts), every, self.step)
        of, row = np.divmod(crossing, max(len(used), 1))
        result = []
        for number in range(len(parts)):
            marks = self.marks.copy()
            marks[used] |= APART
            marks[used[row[of == number]]] &= ~np.uint8(APART)
            result.append(Looks(marks, self.step))
        return result

    def padded(self, before: int, after: int) -> Looks:
        """The same, with so many triangles before and after them of which nothing is known."""
        return Looks(np.pad(self.marks, (before, after)), self.step)

    def repaired(self, repair: Repair, stays: Bools, beside: Ints, piece_stays: Bools) -> Looks:
        """The same, of what a repair leaves.

        Args:
            repair: what changes.
            stays: (m,) bool, triangles that stay.
            beside: those that touch new ones, at whose edges the surface may turn otherwise now.
            piece_stays: (p,) bool, triangles that come and stay.
        """
        piece = self.marks[repair.old[repair.origin]]
        fresh = np.isin(repair.piece, repair.piece[repair.new]).any(axis=1)
        piece[fresh] &= np.uint8(APART)
        piece[repair.new] = 0
        marks = self.marks.copy()
        marks[beside] &= np.uint8(APART)
        return Looks(np.concatenate([marks[stays], piece[piece_stays]]), self.step)

    @property
    def unsound(self) -> Ints:
        """Triangles that may be slivers."""
        return np.flatnonzero(self.marks & SOUND == 0)

    @property
    def unjudged(self) -> Ints:
        """Triangles at whose edges others may follow: all others have none that is open."""
        return np.flatnonzero(self.marks & JUDGED == 0)

    @property
    def uncrossed(self) -> Bools:
        """(m,) bool, triangles of which no two cross each other in a file."""
        return np.asarray(self.marks & APART != 0, np.bool_)

    def folds(self, mesh: TriangleMesh, deformed: bool, backend: ParallelBackend) -> Bools:
        """As `find_folds`, by a look at edges between triangles that are not judged."""
        turned = self.marks & TURNED != 0
        rows = self.unjudged
        if len(rows):
            part = compact(TriangleMesh(mesh.vertices, mesh.triangles[rows]))
            turned[rows[turning(part, deformed, self.step)]] = True
        at_turned = vertices_of(mesh.triangles[turned], len(mesh.vertices))
        return touching(at_turned, mesh.triangles, backend)


def look_at(
    mesh: TriangleMesh,
    rim: Ints,
    deformed: bool,
    step: float,
    alone: Callable[[Ints], Bools],
    monitor: Monitor,
    at_wall: Bools | None = None,
) -> Looks:
    """Look at a part of a surface, where it turns back and crosses itself.

    Args:
        mesh: the part.
        rim: its vertices at which others follow: what has an edge there is not judged, and of what
            touches them it is not told that it crosses nothing.
        deformed: as of `folds_of`.
        step: of the decimals of a text of the whole surface, mm.
        alone: tells which of its triangles meet nothing of another part.
        monitor: asked for a cancel.
        at_wall: as of `turning`.
    """
    at_rim = corners_among(vertices_of(rim, len(mesh.vertices)), mesh.triangles)
    open_, marks = at_rim > 0, np.where(at_rim > 1, np.uint8(0), np.uint8(JUDGED))
    turned = turning(mesh, deformed, step, at_wall)
    if not len(turned):
        return Looks(marks, step)
    marks[turned] |= TURNED
    # Those at a fold, and those beside them.
    near = vertices_of(mesh.triangles[turned], len(mesh.vertices))
    near = vertices_of(mesh.triangles[touching(near, mesh.triangles)], len(near))
    rows = np.flatnonzero(touching(near, mesh.triangles) & ~open_)
    rows = rows[alone(rows)]
    if not len(rows):
        return Looks(marks, step)
    part = compact(TriangleMesh(mesh.vertices, mesh.triangles[rows]))
    every, far = np.ones(len(rows), bool), (1.0 + MORE_ROUNDING) * step
    close = pairs_at_planes(part, far, monitor, every)
    marks[rows] |= APART
    marks[rows[crossing_in_files(part, close, step)]] &= ~np.uint8(APART)
    return Looks(marks, step, rows[close])


def folds_of(
    mesh: TriangleMesh,
    monitor: Monitor,
    deformed: bool = False,
    also: Bools | None = None,
    looks: Looks | None = None,
) -> Folds:
    """Where a mesh turns back, and crosses itself there; as of `resolve_fold_crossings`.

    Deformed struts of different joints may meet where nothing turns back: of a mesh that is no
    larger than `MOST_ANYWHERE` all is looked at; of any the triangles (m,) that are looked at
    `also`. What its parts' `looks` tell is not looked at again.
    """
    if looks is not None and looks.step != decimal_step(mesh.vertices):
        looks = None
    if deformed and len(mesh.triangles) <= MOST_ANYWHERE:
        among, looks = np.ones(len(mesh.triangles), bool), None
    elif looks is None:
        among = find_folds(mesh, deformed)
    else:
        among = looks.folds(mesh, deformed, monitor.backend)
    if also is not None:
        among |= also
    apart = None if looks is None else looks.uncrossed
    return Folds(among, _crossing(mesh, among, monitor, apart=apart))


def resolve_fold_crossings(
    mesh: TriangleMesh, monitor: Monitor, deformed: bool = False, folded: Folds | None = None
) -> tuple[TriangleMesh, Floats | None]:
    """The mesh with no triangles that cross where its surface turns back, as far as that goes.

    Vertices of triangles that cross move a little towards the middle of their neighbours, or
    anywhere, in turn. A move that leaves more crossings than before is taken back.

    Args:
        mesh: closed, or open where nothing turns back.
        monitor: asked for a cancel.
        deformed: whether vertices are elsewhere than they were meshed, so that facets may fold.
        folded: of the mesh, where they are known.

    Returns:
        The mesh, the same one where nothing crosses; and (3,) where triangles still do, mm.
    """
    folded = folded or folds_of(mesh, monitor, deformed)
    if not len(folded.pairs):
        return mesh, None
    before, pairs = mesh, folded.pairs
    if deformed:
        # What grazes needs steps of a file only; with as much as folds do it would cross deeper.
        grazes = _depths(mesh, pairs) < GRAZING * decimal_step(mesh.vertices)
        mesh, left = _resolve(mesh, pairs[grazes], folded.among, SHARES[:GRAZED], monitor)
        pairs = np.concatenate([pairs[~grazes], left])
        mesh, pairs = _resolve(mesh, pairs, folded.among, FOLDED_SHARES, monitor)
    if not deformed or len(pairs) <= MOST_PLACES:
        mesh, pairs = _resolve(mesh, pairs, folded.among, SHARES, monitor)
    if mesh is not before:  # what moved may have met what lies anywhere
        moved = displaced_vertices(before, mesh)
        went = touching(moved, mesh.triangles, monitor.backend)
        stay = folded.pairs[~went[folded.pairs].any(axis=1)]
        # Nothing else has moved, and the mesh as it was may lie in a file already.
        corners = corners_at(mesh.vertices, mesh.triangles[went])
        beside = near_corners(before, corners, monitor.backend)
        now = _crossing(mesh, beside | went, monitor, moved)
        pairs = np.concatenate([stay, now])
    if not len(pairs):
        return mesh, None
    return mesh, mesh.vertices[mesh.triangles[pairs[0, 0]]].mean(axis=0)


def _resolve(
    mesh: TriangleMesh, pairs: Ints, among: Bools, shares: tuple[float, ...], monitor: Monitor
) -> tuple[TriangleMesh, Ints]:
    """The mesh after rounds of moves about pairs of triangles that cross; the pairs that are left.

    Args:
        mesh: any mesh, mm.
        pairs: (k, 2) triangles that cross.
        among: (m,) bool, triangles where the surface turns back, which they may meet.
        shares: as `SHARES`, a round each.
        monitor: asked for a cancel.
    """
    if not len(pairs):
        return mesh, pairs
    places = _Places.around(mesh, pairs, _about(mesh, pairs, among), monitor)
    for share in shares:
        if not len(places.pairs):
            break
        crossed = len(places.pairs)
        places.move(share)
        stuck = crossed > MOST_PLACES and len(places.pairs) > STUCK * crossed
        if shares is FOLDED_SHARES and share >= FAR and stuck:
            break
    return places.mesh, places.found


def _depths(mesh: TriangleMesh, pairs: Ints) -> Floats:
    """(k,) how far pairs of triangles that cross reach through each other's planes, mm."""
    corners = mesh.vertices[mesh.triangles[pairs]]
    result = np.full(len(pairs), np.inf)
    for one, other in ((0, 1), (1, 0)):
        a, b, c = (corners[:, other, k] for k in range(3))
        normal = normalize(np.cross(b - a, c - a))
        height = np.einsum("nij,nj->ni", corners[:, one] - a[:, None], normal)
        reach = np.minimum(height.max(axis=1), -height.min(axis=1))
        result = np.minimum(result, reach)
    return result


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
        self._step = decimal_step(mesh.vertices)
        self._watch = self._watched()

    @classmethod
    def around(cls, mesh: TriangleMesh, pairs: Ints, among: Bools, monitor: Monitor) -> _Places:
        """With triangles among the chosen or beside them, and all that may move."""
        near = vertices_of(mesh.triangles[pairs], len(mesh.vertices))
        for _ in range(MOST_RINGS):
            near[mesh.triangles[touching(near, mesh.triangles, monitor.backend)]] = True
        near[mesh.triangles[among]] = True
        inside = touching(near, mesh.triangles, monitor.backend)
        rows = np.flatnonzero(inside)
        # What else has a corner there holds that, and is little beside the rest of the mesh.
        there = vertices_of(mesh.triangles[rows], len(near))
        ring = touching(there, mesh.triangles, monitor.backend) & ~inside
        return cls(
            mesh, rows, pairs, there & ~vertices_of(mesh.triangles[ring], len(near)), monitor
        )

    @property
    def mesh(self) -> TriangleMesh:
        """The whole mesh as it is now; the same one if nothing has moved."""
        before = self._whole.vertices
        moved = np.flatnonzero((before[self._used] != self._vertices).any(axis=1))
        if not len(moved):
            return self._whole
        rows, places = self._used[moved], self._vertices[moved]
        vertices = self._monitor.backend.replaced(before, rows, places)
        return TriangleMesh(vertices, self._whole.triangles)

    @property
    def found(self) -> Ints:
        """(k, 2) of the whole mesh's triangles that cross now."""
        result: Ints = self._rows[self.pairs]
        return result

    def move(self, share: float) -> None:
        """Vertices go so much of their way, or a random one below 0, where that helps.

        Not where one would be one with another in a file.
        """
        if len(self.pairs) < FEWER * self._watched_pairs:
            self._watch = self._watched()
        chosen = self._grow(MOST_RINGS) & self._free
        rows = np.flatnonzero(chosen)
        here = self._mesh_of(self._vertices)
        way = _to_neighbours(here, rows, self._triangles[touching(chosen, self._triangles)])
        long = np.linalg.norm(way, axis=1)
        way *= np.minimum(1.0, self._farthest / np.maximum(long, 1e-300))[:, None]
        if share < 0.0:
            long = np.minimum(long, self._farthest)
            way = self._random.normal(size=way.shape) * long[:, None]
        vertices = self._vertices.copy()
        vertices[rows] += abs(share) * way
        left = self._watch.crossing(vertices, chosen)
        worse = _find_worse(here, chosen, self.pairs, left)
        together = merging(vertices, self._step)
        worse[together] |= chosen[together]
        if worse.any():  # each place by itself: what got worse there goes back
            vertices[worse] = self._vertices[worse]
            chosen &= ~worse
            stays = ~touching(chosen, self._triangles)[self.pairs].any(axis=1)
            left = np.concatenate([self.pairs[stays], self._watch.crossing(vertices, chosen)])
            together = merging(vertices, self._step) if len(together) else together
        if len(left) <= len(self.pairs) and not chosen[together].any():
            self._vertices, self.pairs = vertices, np.unique(left, axis=0)
        self._deep += share >= DEEP
        if share >= DEEP and not self._deep % 2:  # places that are left need more room
            still = np.unique(self._triangles[self.pairs])
            self._rings[still] = np.minimum(self._rings[still] + 1, MOST_RINGS + 1)

    def _watched(self) -> CrossingWatch:
        self._watched_pairs = len(self.pairs)
        near = touching(self._grow(MOST_RINGS), self._triangles)
        return CrossingWatch(self._mesh_of(self._vertices), near, self._monitor)

    def _grow(self, most: int) -> Bools:
        """(n,) the vertices of triangles that cross, and their rings, at most so many."""
        level = np.zeros(len(self._used), np.int8)
        some = np.unique(self._triangles[self.pairs])
        level[some] = self._rings[some]
        for _ in range(most):
            if not (level > 1).any():
                break
            rows = self._triangles[touching(level > 1, self._triangles)]
            np.maximum.at(level, rows.ravel(), np.repeat(level[rows].max(axis=1) - 1, 3))
        return np.asarray(level > 0, np.bool_)

    def _mesh_of(self, vertices: Floats) -> TriangleMesh:
        return TriangleMesh(vertices, self._triangles)


def _about(mesh: TriangleMesh, pairs: Ints, among: Bools) -> Bools:
    """(m,) of some triangles those about pairs that cross; all of them where there are many."""
    if not 0 < len(pairs) <= MOST_PLACES:
        return among
    rows = np.flatnonzero(among)
    low, high = triangle_boxes(mesh.vertices.T, mesh.triangles[pairs.ravel()].T)
    from_, to = low.reshape(3, -1, 2).min(axis=2).T, high.reshape(3, -1, 2).max(axis=2).T
    reach = REACH * (to - from_).max(axis=1)[:, None]
    least, most = triangle_boxes(mesh.vertices.T, mesh.triangles[rows].T)
    meets = np.zeros(len(rows), bool)
    for lowest, highest in zip(from_ - reach, to + reach, strict=True):
        near = np.ones(len(rows), bool)
        for axis in range(3):
            near &= (least[axis] <= highest[axis]) & (most[axis] >= lowest[axis])
        meets |= near
    found = np.zeros(len(among), bool)
    found[rows[meets]] = True
    return found


def _crossing(
    mesh: TriangleMesh,
    among: Bools,
    monitor: Monitor,
    moved: Bools | None = None,
    *,
    apart: Bools | None = None,
) -> Ints:
    """(k, 2) triangles, chosen or beside such, that cross in a binary file or in one of text.

    At least one of each two has a vertex that was moved, (n,) bool, where these are given; or is
    not among those of which it is known that no two cross, (m,) bool.
    """
    near = vertices_of(mesh.triangles[among], len(mesh.vertices))
    rows = np.flatnonzero(touching(near, mesh.triangles, monitor.backend))
    step = decimal_step(mesh.vertices)
    wanted = None if apart is None else ~apart[rows]
    if moved is not None:
        wanted = touching(moved, mesh.triangles[rows])
    if not len(rows) or (wanted is not None and not wanted.any()):
        return np.zeros((0, 2), np.int64)
    part = compact(TriangleMesh(mesh.vertices, mesh.triangles[rows]))
    if wanted is None:
        wanted = np.ones(len(rows), bool)
    pairs: Ints = np.unique(
        rows[np.concatenate(list(in_regions(_crossing_in_file, part, wanted, step, monitor)))],
        axis=0,
    )
    return pairs


def _crossing_in_file(part: TriangleMesh, wanted: Bools, step: float, monitor: Monitor) -> Ints:
    """(k, 2) triangles of a mesh, one of them wanted, that cross in a file of either kind."""
    # Neither rounding moves a coordinate by more than a step: few pairs need an exact look, twice.
    return crossing_in_files(part, pairs_at_planes(part, step, monitor, wanted), step)


def _find_worse(mesh: TriangleMesh, chosen: Bools, before: Ints, after: Ints) -> Bools:
    """(n,) the chosen vertices of places where more triangles cross than before."""
    t = mesh.triangles
    start, end = t.ravel(), np.roll(t, -1, axis=1).ravel()
    both = chosen[start] & chosen[end]
    count, place = pieces_of(start[both], end[both], len(mesh.vertices))
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


def find_folds(mesh: TriangleMesh, deformed: bool = False) -> Bools:
    """(m,) the triangles that have a corner at a triangle where the surface turns back on itself.

    So little that a file may close it; where it is deformed, however much, and also those at sharp
    edges that stick out.
    """
    turned = mesh.triangles[turning(mesh, deformed, decimal_step(mesh.vertices))]
    return touching(vertices_of(turned, len(mesh.vertices)), mesh.triangles)


def turning(mesh: TriangleMesh, deformed: bool, step: float, at_wall: Bools | None = None) -> Ints:
    """The triangles at both sides of the edges of `find_folds`, ascending.

    Args:
        mesh: any mesh, mm.
        deformed: as of `folds_of`.
        step: of the decimals of a text of the whole surface, mm.
        at_wall: (m,) bool, triangles of a wall that cuts it: what is deformed does not fold there,
            and its edges count as those of any other lattice; None: there are none.
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
    edge = edge_keys(start, end, size)
    order = np.argsort(edge)
    same = edge[order[1:]] == edge[order[:-1]]
    side, other = order[:-1][same], order[1:][same]
    one, two = owner[side], owner[other]
    cosine = sum(along[one] * along[two] for along in normal)
    turned = cosine < TURNS_BACK
    bent = np.full(len(one), deformed)
    if at_wall is not None:
        bent &= ~(at_wall[rows[one]] | at_wall[rows[two]])

    def above(owner: Ints, side: Ints, apex: Ints) -> Floats:
        """How far corners lie above the planes of facets that have sides, mm."""
        beyond = mesh.vertices[apex] - mesh.vertices[start[side]]
        return np.asarray(sum(along[owner] * beyond[:, k] for k, along in enumerate(normal)))

    beyond = above(one, side, apex[other])
    turned |= bent & (cosine < STICKS_OUT) & (beyond < 0.0)
    if not bent.all():
        nearest = np.minimum(np.abs(beyond), np.abs(above(two, other, apex[side])))
        turned &= bent | (nearest < OPEN_STEPS * step)
    found: Ints = np.unique(rows[np.concatenate([one[turned], two[turned]])])
    return found


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
    normal = cross_columns(e, f)
    length = np.maximum(np.sqrt(sum(along * along for along in normal)), 1e-300)
    return [along / length for along in normal]
