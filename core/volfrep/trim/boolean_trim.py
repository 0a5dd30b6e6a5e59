# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice trimmed to its domain: groups of octants at the wall are cut, and joined again.

The border is grown until no two of its octants touch along an edge or a corner only: their caps
would share an edge between four triangles.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..mesh.booleans import to_library
from ..mesh.float32_repair import shortest_edge
from ..mesh.open_shells import OpenShells, joined_shells
from ..mesh.topology import corners_among, pieces_of, vertices_of, ways_along
from ..mesh.triangle_mesh import TriangleMesh, compact, rows_where
from ..process.cluster import Watch
from ..process.pool import at_once, awaited, backend_of
from ..spatial.rays import inside_points
from ..spatial.resolve_crossings import Looks
from ..util.errors import VolfrepError
from ..util.linalg import along
from ..util.manifold import manifold_library
from ..util.parallel import ParallelBackend, SharedValue
from ..util.progress import Monitor
from ..util.threads import threads
from ..util.types import Bools, Floats, Ints
from .alike_groups import Alike, find_alike
from .culling import KeptOctants, without_pinches
from .group_cut import Piece, cut_group, read_runs
from .octant_groups import Groups, group_octants
from .placed_lattice import InnerOctants, PlacedLattice, Proof, prove
from .trimmed_surface import (
    TrimmedSurface,
    concatenated_at,
    hash_points,
    rows_along,
)

if TYPE_CHECKING:
    import manifold3d

#: Makes a piece; keyword ``monitor`` for cancel.
Cut = Callable[..., Piece]
#: Is told octants inside.
Ahead = Callable[[InnerOctants], None]
#: Vertices of two groups are the same within this part of the shortest edge that files hold.
SAME_VERTEX = 1e-4
#: A direction along which points that repeat in a lattice are far from each other.
ASKEW = np.array([0.5773102, 0.6180339, 0.5335218])


@dataclass(frozen=True, eq=False)
class Trimmed:
    """The lattice trimmed to its domain.

    Attributes:
        surface: for a part: the cavity's, seen from the material. Otherwise the lattice's.
        on_boundary: (m,) bool, triangles of its mesh that lie on the domain's wall.
    """

    surface: TrimmedSurface
    on_boundary: Bools


def trim(
    domain: TriangleMesh,
    lattice: PlacedLattice,
    *,
    cavity: bool,
    monitor: Monitor,
    executor: Executor | None = None,
    precision: float = 0.0,
    ahead: Ahead | None = None,
) -> Trimmed:
    """Cut the lattice at the domain's wall.

    Octants that the wall crosses are cut in groups, those inside follow where these are open. What
    comes out is the same with any executor.

    Args:
        domain: closed mesh of what the lattice fills.
        lattice: the octants of the lattice.
        cavity: True for domain - lattice turned inside out (the wall with holes where struts
            meet it, and the struts), False for domain & lattice.
        monitor: for progress and cancel.
        executor: cuts groups beside each other; None: threads of this process.
        precision: slivers thinner than that go where groups do not meet, mm; 0: all stay.
        ahead: told the octants inside once all groups are cut; a few may still go into the mesh.

    Raises:
        VolfrepError: the domain's mesh is not a solid that can be cut.
    """
    monitor.tick(0.1)
    kept = lattice.kept
    inner = InnerOctants(lattice, kept.inside) if kept.inside.any() else None
    proof = _ask_for_proof(inner, executor)
    groups = group_octants(lattice, domain, monitor, precision)
    found, inner = _join_groups(groups, inner, proof, cavity, monitor, executor, ahead)
    trimmed = TrimmedSurface(found.mesh, inner, found.looks, found.at_rim, found.shells)
    if not trimmed.is_joined:
        # The Boolean has taken out vertices at the caps, as it may do between tiny triangles: let
        # all the octants go through it, which takes longer.
        every = KeptOctants(kept.grid, kept.border | kept.inside, np.zeros_like(kept.inside))
        whole = replace(lattice, kept=every)
        return trim(
            domain, whole, cavity=cavity, monitor=monitor, executor=executor, precision=precision
        )
    return Trimmed(trimmed, found.on_boundary)


def _join_groups(
    groups: Groups,
    inner: InnerOctants | None,
    proof: Future[Proof] | None,
    cavity: bool,
    monitor: Monitor,
    executor: Executor | None,
    ahead: Ahead | None,
) -> tuple[Joined, InnerOctants | None]:
    """All groups, cut and joined; those that do not meet exactly are cut as one.

    And the octants inside, with their proof if that was asked for.
    """
    same = SAME_VERTEX * shortest_edge(groups.boundary)
    pieces: dict[int, Piece] = {}
    while True:
        missing = np.array([k for k in range(groups.count) if k not in pieces], np.int64)
        pieces.update(_cut(groups, missing, cavity, executor, monitor))
        if ahead is not None and inner is not None:
            ahead(inner.sound)
            ahead = None
        wrong = np.array([k for k, piece in pieces.items() if piece.defect], np.int64)
        if groups.count == 1:
            piece = pieces[0]
            if len(wrong):
                raise piece.error
            return Joined(piece.mesh, piece.on_boundary, wrong), inner
        if not len(wrong):
            if inner is not None and proof is not None:
                inner = replace(inner, proof=awaited(proof, Watch(executor), monitor))
            proof = None
            rim = np.zeros((0, 3)) if inner is None else inner.rim_points
            together = [pieces[k] for k in range(groups.count)]
            if cavity:
                together.append(groups.untouched)
            found = join(together, rim, same, monitor.backend)
            if not len(found.loose):
                return found, inner
            wrong = found.loose[found.loose < groups.count]
        if len(wrong) < 2:
            wrong = np.arange(groups.count)
        groups, number = groups.merged(wrong)
        pieces = {int(number[k]): piece for k, piece in pieces.items() if k not in wrong}


def _ask_for_proof(inner: InnerOctants | None, executor: Executor | None) -> Future[Proof] | None:
    """The proof of octants that keep their places, which a worker finds meanwhile."""
    if inner is None or inner.lattice.points is not None or executor is None:
        return None
    try:
        return executor.submit(prove, inner)
    except RuntimeError:  # it takes nothing more
        return None


def _cut(
    groups: Groups, which: Ints, cavity: bool, executor: Executor | None, monitor: Monitor
) -> dict[int, Piece]:
    """What the Boolean leaves of some of the groups."""
    found: dict[int, Piece] = {}
    copied: dict[int, Alike] = {}
    if groups.count > 1:  # few are not certain where the wall is open, mostly none
        backend = backend_of(executor if len(which) > 1 else None)
        given = groups.to_share() if backend.uses_processes else groups
        with backend.sharing_value(given) as shared:
            copied = find_alike(groups, which, cavity, shared, backend)
            others = [k for alike in copied.values() for k, _ in alike.others]
            which = np.setdiff1d(which, np.array(others, np.int64))
            cuts = _open_cuts(groups, which, cavity, shared, executor)
            found.update(_cut_each(cuts, len(which), executor, monitor))
        which = np.array([k for k in which if found[k].needs_solid], np.int64)
        if len(which):
            monitor.count("groups cut again at a solid wall", len(which))
    if len(which):
        solids = groups.with_solids(which, cavity, monitor)
        closed = ((k, partial(cut_group, group)) for k, group in solids)
        found.update(_cut_each(closed, len(which), executor, monitor))
    for number, alike in copied.items():
        found.update(alike.copies(found[number]))
        monitor.count("groups copied", len(alike.others))
    return found


def _open_cuts(
    groups: Groups,
    which: Ints,
    cavity: bool,
    shared: SharedValue[Groups],
    executor: Executor | None,
) -> Iterator[tuple[int, Cut]]:
    """Cuts of numbered groups at open walls; each group is made where it is cut.

    For processes of other machines it is made here.
    """
    if not (executor is None or isinstance(executor, ThreadPoolExecutor)):
        return ((int(k), partial(cut_group, groups.group(int(k), cavity))) for k in which)
    return ((int(k), partial(cut_one, shared, int(k), cavity)) for k in which)


def cut_one(
    groups: SharedValue[Groups], number: int, cavity: bool, monitor: Monitor | None = None
) -> Piece:
    """As `cut_group`, of one of several groups that calls share."""
    return cut_group(groups.value.group(number, cavity), monitor)


def _cut_each(
    cuts: Iterator[tuple[int, Cut]], count: int, executor: Executor | None, monitor: Monitor
) -> Iterator[tuple[int, Piece]]:
    """What the Boolean leaves of numbered groups, in their order."""
    own = None
    if count == 1:
        executor = None  # to start a worker takes longer than the group
    elif executor is None and threads() > 1:
        executor = own = ThreadPoolExecutor(threads())
    try:
        yield from _cut_with(cuts, count, executor, monitor)
    finally:
        if own is not None:  # after a cancel it does not wait for the groups that were begun
            own.shutdown(wait=False, cancel_futures=True)


def _cut_with(
    cuts: Iterator[tuple[int, Cut]], count: int, executor: Executor | None, monitor: Monitor
) -> Iterator[tuple[int, Piece]]:
    """As `_cut_each`, with this executor; None: here."""
    ahead: deque[tuple[int, Cut, Future[Piece] | None]] = deque()
    watch = Watch(executor)
    for done in range(count):
        piece = None
        # Some groups ahead, so that no worker waits; not all, so that they take no memory.
        while executor is not None and len(ahead) < 2 * at_once(executor):
            following = next(cuts, None)
            if following is None:
                break
            try:
                ahead.append((*following, executor.submit(following[1])))
            except RuntimeError:  # it takes nothing more, as when a process of it was killed
                executor = None
                ahead.append((*following, None))
        if ahead:
            number, cut, future = ahead.popleft()
            piece = None if future is None else _await_piece(future, watch, monitor)
        else:
            number, cut = next(cuts)
        if piece is None:
            piece = cut(monitor=monitor)
        for name, amount in piece.work.items():
            monitor.count(name, amount)
        monitor.tick(0.1 + 0.8 * (done + 1) / count)
        yield number, piece


def _await_piece(future: Future[Piece], watch: Watch, monitor: Monitor) -> Piece | None:
    """What a worker made; None where it was lost, as for want of memory.

    What is wrong with a group itself shows again where it is cut next.
    """
    piece = awaited(future, watch, monitor)
    if piece is None:
        monitor.count("groups whose worker was lost", 1)
    return piece


def cut_again(
    surface: TrimmedSurface,
    by: Sequence[TriangleMesh],
    cut: Callable[[manifold3d.Manifold], manifold3d.Manifold],
    monitor: Monitor,
    *,
    keeps: bool,
    is_void: bool = False,
) -> TrimmedSurface:
    """A trimmed surface after a further Boolean, which octants beside its mesh stay out of.

    Flat caps close the mesh where octants follow, and are taken off again.

    Args:
        surface: closed.
        by: closed meshes that cut it, mm.
        cut: gives what they leave of it.
        monitor: for cancel.
        keeps: whether the octants inside of these are what stays; otherwise those outside.
        is_void: whether it is handed over, and taken away, as the void that it bounds.

    Raises:
        VolfrepError: the surface is no solid that can be cut.
    """
    library = manifold_library("Cutting a part once more")
    if surface.octants is not None and surface.octants.lattice.points is not None:
        surface = TrimmedSurface(surface.whole(monitor))  # a middle of theirs is not known
    if surface.octants is not None:
        surface = surface.with_octants(_find_met(surface.octants, by, keeps, monitor), monitor)
    mesh, inner = surface.mesh, surface.octants
    if inner is not None:
        mesh = concatenated_at(mesh, surface.rim_rows, inner.caps(monitor))
    mesh = mesh.reversed() if is_void else mesh
    runs = np.array([0, len(surface.mesh.triangles), len(mesh.triangles)], np.uint64)
    ids = library.Manifold.reserve_ids(2)
    source = to_library(
        mesh,
        run_index=runs[: 2 + (inner is not None)] * np.uint64(3),
        run_original_id=np.arange(ids, ids + 1 + (inner is not None), dtype=np.uint32),
    )
    solid = monitor.call(lambda: library.Manifold(source))
    if solid.status() != library.Error.NoError:
        raise VolfrepError(
            f"The part cannot be cut once more ({solid.status().name}): change the lattice's "
            "origin or radius by a little."
        )
    result = monitor.call(lambda: cut(solid).to_mesh64())
    left, origin = read_runs(result)
    kept = TriangleMesh(left.vertices, left.triangles[origin != ids + 1])
    found = TrimmedSurface(compact(kept), inner)
    if found.is_joined:
        return found
    # The Boolean has taken out vertices at the caps.
    whole = TrimmedSurface(surface.whole(monitor))
    return cut_again(whole, by, cut, monitor, keeps=keeps, is_void=is_void)


def _find_met(
    inner: InnerOctants, by: Sequence[TriangleMesh], keeps: bool, monitor: Monitor
) -> Bools:
    """Octants that solids cut, or that do not stay, and those about them that caps need."""
    from scipy import ndimage  # slow to import

    near = np.zeros_like(inner.where)
    for mesh in by:
        near |= inner.reached(mesh.vertices[mesh.triangles])
    # What no surface reaches into is on one side as a whole.
    label, count = ndimage.label(inner.where & ~near)
    first = np.unique(label, return_index=True)[1][1 if (label == 0).any() else 0 :]
    middle = inner.middle(np.stack(np.unravel_index(first, label.shape), axis=1))
    inside = np.zeros(count, bool)
    for mesh in by:
        inside |= inside_points(mesh, middle, monitor)
    near |= np.append(False, inside != keeps)[label]
    present = inner.lattice.kept.grid.kind >= 0
    border = without_pinches(present & ~(inner.where & ~near), present, inner.lattice.periodic)
    result: Bools = inner.where & border
    return result


@dataclass(frozen=True, eq=False)
class Joined:
    """Pieces as one mesh.

    Attributes:
        mesh: of all of them, first vertices first.
        on_boundary: (m,) bool, triangles that lie on the wall.
        loose: pieces that are open where no other one nor the rim follows.
        looks: what is known of its triangles; None: nothing.
        at_rim: (k,) its vertices at the rim, -1 for none; None: not known.
        shells: of it; None: not known.
    """

    mesh: TriangleMesh
    on_boundary: Bools
    loose: Ints
    looks: Looks | None = None
    at_rim: Ints | None = None
    shells: OpenShells | None = None


def join(
    pieces: Sequence[Piece],
    rim: Floats,
    tolerance: float,
    backend: ParallelBackend | None = None,
) -> Joined:
    """Join pieces of a surface along their seams.

    Vertices at open edges that lie within the tolerance of each other become one, in the place
    that the first piece has. The same edge and facet met in both, so that they differ by rounding.

    Args:
        pieces: each closed but for its seams.
        rim: (k, 3) vertices at which the whole may be open, mm.
        tolerance: mm.
        backend: gathers the mesh, for its calls; None: for threads.
    """
    backend = backend or ParallelBackend()
    on_boundary = np.concatenate([piece.on_boundary for piece in pieces])
    first = np.cumsum([0] + [len(piece.mesh.vertices) for piece in pieces])
    begin = np.cumsum([0] + [len(piece.mesh.triangles) for piece in pieces])
    seam = np.concatenate([piece.rim + k for piece, k in zip(pieces, first, strict=False)])
    owner = np.searchsorted(first, seam, "right") - 1
    points = np.concatenate([piece.mesh.vertices[piece.rim] for piece in pieces])
    cluster, chosen, row = _same_vertices(points, rim, tolerance)
    # Of one piece no two vertices may become one.
    loose = [_twice(cluster, owner)]
    stays = np.ones(first[-1], bool)
    stays[seam] = False
    stays[seam[chosen]] = True
    number = np.cumsum(stays, dtype=np.int32)
    number -= 1
    number[seam] = number[seam[chosen[cluster]]]
    each = [(piece, slice(*own)) for piece, own in zip(pieces, pairwise(first), strict=True)]
    corners = (np.take(number[own], piece.mesh.triangles, mode="clip") for piece, own in each)
    kept = (rows_where(stays[own], piece.mesh.vertices) for piece, own in each)
    mesh = TriangleMesh(
        backend.gathered(kept, (int(stays.sum()), 3), np.float64),
        backend.gathered(corners, (int(begin[-1]), 3), np.int32),
    )
    at_seam, some, shells = np.zeros(len(stays), bool), [np.zeros(0, np.int64)], []
    at_seam[seam] = True
    for (piece, own), start in zip(each, begin, strict=False):
        at_edge = rows_along(at_seam[own], piece.mesh.triangles, piece.looks)
        some.append(at_edge + start)
        if piece.shells is not None:
            shells.append(piece.shells.at(piece.rim, piece.mesh, at_edge))
    at_rim = np.where(row < 0, -1, number[seam[chosen[row]]]).astype(np.int64)
    open_ = _open(mesh, np.concatenate(some), number[seam[chosen]], at_rim[row >= 0])
    loose.append(np.searchsorted(begin, open_, "right") - 1)
    sound = not any(map(len, loose))
    return Joined(
        mesh, on_boundary, np.unique(np.concatenate(loose)), _known_looks(pieces), at_rim,
        _join_shells(pieces, shells, cluster, len(mesh.vertices)) if sound else None,
    )  # fmt: skip


def _same_vertices(points: Floats, rim: Floats, tolerance: float) -> tuple[Ints, Ints, Ints]:
    """Which vertices at seams are one.

    Args:
        points: (n, 3) of all pieces, mm.
        rim: (k, 3) vertices at which the whole may be open, mm.
        tolerance: mm.

    Returns:
        (n,) a number for each, (c,) the first one of each number, and (k,) the number of each at
        the rim, -1 for none.
    """
    # Mostly both sides have the very same numbers: only where one has no fellow is it looked for.
    each, first, cluster, often = np.unique(
        hash_points(points), return_index=True, return_inverse=True, return_counts=True
    )
    cluster, row = cluster.ravel(), np.full(len(rim), -1, np.int64)
    if len(each):
        place = np.minimum(np.searchsorted(each, hash_points(rim)), len(each) - 1)
        same = (points[first[place]] == rim).all(axis=1)
        row[same] = place[same]
    alone = often == 1
    alone[row[row >= 0]] = False
    other = np.flatnonzero((points[first[cluster]] != points).any(axis=1))  # of the same hash
    cluster[other] = len(first) + np.arange(len(other))
    first, alone = np.append(first, other), np.append(alone, np.ones(len(other), bool))
    if not alone.any():
        return cluster, first, row
    one, two = _within(points[first], tolerance)
    count, joined = pieces_of(one, two, len(first))
    lowest = np.empty(count, np.int64)
    lowest[joined] = first
    for near in (one, two):  # few have more than one
        np.minimum.at(lowest, joined[near], first[near])
    # It has the place of the first piece's.
    there = np.flatnonzero(row >= 0)
    moves = lowest[joined[row[there]]] != first[row[there]]
    row[there] = np.where(moves, -1, joined[row[there]])
    return joined[cluster], lowest, row


def _within(points: Floats, tolerance: float) -> tuple[Ints, Ints]:
    """Pairs of points that lie within the tolerance, mm: few."""
    height = along(points, ASKEW)
    order = np.argsort(height)
    height, found = height[order], [np.zeros((2, 0), np.int64)]
    first = np.arange(len(points))
    for step in range(1, len(points)):
        first = first[: np.searchsorted(first, len(points) - step)]
        first = first[height[first + step] - height[first] <= 2.0 * tolerance]  # and rounding
        if not len(first):
            break
        pair = order[np.stack([first, first + step])]
        near = ((points[pair[0]] - points[pair[1]]) ** 2).sum(axis=1) <= tolerance**2
        found.append(pair[:, near])
    one, two = np.concatenate(found, axis=1)
    return one, two


def _join_shells(
    pieces: Sequence[Piece], shells: Sequence[Ints], cluster: Ints, vertices: int
) -> OpenShells | None:
    """The shells of pieces that are joined.

    Args:
        pieces: joined edge for edge.
        shells: of the vertices at the rims of those whose shells are known.
        cluster: (k,) a number for each vertex at their rims; those of one number are one.
        vertices: how many there are then.
    """
    parts = [piece.shells for piece in pieces if piece.shells is not None]
    if len(parts) < len(pieces):
        return None
    begin = np.cumsum([0] + [len(part.volume) for part in parts])
    each = [shell + k for shell, k in zip(shells, begin, strict=False)]
    order = np.argsort(cluster, kind="stable")
    shell, same = np.concatenate(each)[order], np.diff(cluster[order]) == 0
    return joined_shells(parts, shell[:-1][same], shell[1:][same], vertices)


def _known_looks(pieces: Sequence[Piece]) -> Looks | None:
    """What is known of the triangles of pieces, one after the other."""
    steps = {piece.looks.step for piece in pieces if piece.looks is not None}
    if len(steps) != 1:
        return None
    marks = [
        np.zeros(len(piece.on_boundary), np.uint8) if piece.looks is None else piece.looks.marks
        for piece in pieces
    ]
    return Looks(np.concatenate(marks), steps.pop())


def _twice(cluster: Ints, owner: Ints) -> Ints:
    """The owners of more than one vertex of a cluster."""
    pair, often = np.unique(cluster * (owner.max(initial=0) + 1) + owner, return_counts=True)
    result: Ints = pair[often > 1] % (owner.max(initial=0) + 1)
    return result


def _open(mesh: TriangleMesh, some: Ints, seam: Ints, rim: Ints) -> Ints:
    """The triangles with an edge that does not run once each way and is not at the rim.

    And those that lie on each other: back to back they are closed, edge for edge.

    Args:
        mesh: of all of them.
        some: triangles with an edge between vertices at seams, among others.
        seam: vertices at seams.
        rim: vertices at which the mesh may be open.
    """
    at_seam = vertices_of(seam, len(mesh.vertices))
    at_rim = vertices_of(rim, len(mesh.vertices))
    triangles, size = mesh.triangles[some], np.int64(len(at_seam))
    corners = [np.ascontiguousarray(triangles[:, k]) for k in range(3)]
    ends = list(zip(corners, [*corners[1:], corners[0]], strict=True))
    here = [at_seam.take(one, mode="clip") & at_seam.take(two, mode="clip") for one, two in ends]
    way = np.concatenate(
        [ways_along(one[at], two[at], size) for (one, two), at in zip(ends, here, strict=True)]
    )
    # Whose they are is asked of faulty ones only: numpy sorts numbers alone in a fifth of the time.
    every = np.sort(way)
    first = np.flatnonzero(np.diff(every >> 1, prepend=-1))
    often = np.diff(first, append=len(every))
    sound = (often == 2) & (every[first] != every[first + often - 1])
    low, high = np.divmod(every[first[often == 1]] >> 1, size)
    sound[often == 1] = at_rim[low] & at_rim[high]
    owner = np.zeros(0, np.int64)
    if not sound.all():
        wrong = np.isin(way >> 1, every[first[~sound]] >> 1)
        owner = np.concatenate([some[at] for at in here])[wrong]
    return np.concatenate([owner, some[_alike(triangles, at_seam)]])


def _alike(triangles: NDArray[np.int32], at_seam: Bools) -> Ints:
    """Which triangles have the same three corners, all of them at seams, in any order."""
    rows = np.flatnonzero(corners_among(at_seam, triangles) == 3)
    low, middle, high = np.sort(triangles[rows], axis=1).astype(np.int64).T
    size = np.int64(len(at_seam))
    edge = np.unique(low * size + middle, return_inverse=True)[1].ravel()
    _, each, often = np.unique(edge * size + high, return_inverse=True, return_counts=True)
    result: Ints = rows[often[each.ravel()] > 1]
    return result
