# SPDX-License-Identifier: LGPL-2.1-or-later
"""A solid's surface in even triangles of about one edge length, its sharp edges kept."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.spatial import cKDTree

from ..mesh import remesh
from ..mesh.topology import edge_keys
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import NearestTriangles, closest_points
from ..util.linalg import lengths, normalize
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints

#: Edges where the surface turns by more than this stay, degrees.
SHARP = 30.0
#: A triangle may turn by no more than this when a neighbour goes: so round holes stay round enough.
_TURN = np.cos(np.radians(28.0))
_PASSES, _FLIPS = 10, 3
#: Edges longer and shorter than so many times the wanted length are split and taken out.
_LONG, _SHORT = 1.4, 0.75
#: A step of this part of the wanted length may lead off a crease: strips so narrow are closed.
_TINY = 0.1
#: Triangles of less quality face nowhere; so many of them may lie behind one another.
_NEEDLE, _NEEDLES_DEEP = 0.01, 4
#: Vertices are put at given places, no two of them nearer than a part of the wanted length, in this
#: pass, when the triangles are even already.
_PINNED_AT, _APART = 4, 0.3
#: What is nearer than this part of the wanted length to a vertex, or to an edge, is there.
_AT_VERTEX, _AT_EDGE = 0.2, 0.25
#: The part's surface is sampled every so many times the wanted length.
_SAMPLED = 0.2


class _Creases:
    """Sharp edges of a mesh, and how far each vertex is held by them (`rank`)."""

    def __init__(self, vertices: Floats, triangles: Ints, pinned: Floats, tiny: float) -> None:
        self.count, self.vertices, self.tiny = len(vertices), vertices, tiny
        table = remesh.edges(triangles, self.count)
        normal = remesh.unit_normals(vertices[triangles])
        one, two = table.triangles.T
        # A needle faces nowhere: it counts with its neighbour beyond its longest edge, which so
        # can be flipped, and a crease that it lies on runs along its other two.
        length = lengths(vertices[table.ends[:, 0]] - vertices[table.ends[:, 1]])
        longest = np.zeros(len(triangles))
        for side in (one, two[two >= 0]):
            np.maximum.at(longest, side, length if side is one else length[two >= 0])
        beyond = np.arange(len(triangles))
        for side, other in ((one, two), (two, one)):
            at = (two >= 0) & (length == longest[side])
            beyond[side[at]] = other[at]
        is_needle = remesh.qualities(vertices[triangles]) < _NEEDLE
        needles = np.flatnonzero(is_needle)
        for _ in range(_NEEDLES_DEEP):
            normal[needles] = normal[beyond[needles]]
        cosine = np.einsum("ij,ij->i", normal[one], normal[two])
        sharp = (cosine < np.cos(np.radians(SHARP))) & ~(is_needle[one] & is_needle[two])
        sharp |= two < 0
        ends = table.ends[sharp]
        self.keys = np.sort(self._key(ends[:, 0], ends[:, 1]))
        number = np.bincount(ends.ravel(), minlength=self.count)
        # On a crease of two edges that run straight on; a corner elsewhere.
        way = np.zeros((self.count, 3))
        step = normalize(vertices[ends[:, 1]] - vertices[ends[:, 0]])
        np.add.at(way, ends[:, 0], step)
        np.add.at(way, ends[:, 1], -step)
        bent = lengths(way) > 0.7
        self.rank = np.where(number == 0, 0, np.where((number == 2) & ~bent, 1, 2))
        if len(pinned):
            self.rank[cKDTree(pinned).query(vertices)[0] == 0.0] = 2

    def _key(self, one: Ints, two: Ints) -> Ints:
        return edge_keys(one, two, self.count)

    def are_sharp(self, one: Ints, two: Ints) -> Bools:
        """Whether edges between (k,) vertices are."""
        if not len(self.keys):
            return np.zeros(len(one), bool)
        key = self._key(one, two)
        at = np.minimum(np.searchsorted(self.keys, key), len(self.keys) - 1)
        return np.asarray(self.keys[at] == key)

    def may_slide(self, gone: Ints, kept: Ints) -> Bools:
        """Whether a vertex may be merged into another without leaving its crease."""
        free = self.rank[gone] == 0
        step = lengths(self.vertices[gone] - self.vertices[kept])
        free |= (self.rank[gone] <= self.rank[kept]) & (self.rank[gone] == 1) & (step < self.tiny)
        return np.asarray(free | ((self.rank[gone] == 1) & self.are_sharp(gone, kept)))


def begun_surface(mesh: TriangleMesh, edge: float, monitor: Monitor) -> TriangleMesh:
    """What `even_surface` begins with, whatever places are given to it."""
    return _evened(mesh, mesh, edge, monitor, None, range(_PINNED_AT))


def even_surface(
    mesh: TriangleMesh,
    edge: float,
    monitor: Monitor | None = None,
    places: Floats | None = None,
    begun: TriangleMesh | None = None,
) -> TriangleMesh:
    """The surface in triangles whose edges are about so long, where its details allow it.

    Args:
        mesh: closed, mm.
        edge: mm.
        monitor: asked for a cancel.
        places: (k, 3) near which there are to be vertices, mm; those at sharp edges are moved
            there.
        begun: of `begun_surface` for the same mesh and edge; None to begin anew.
    """
    monitor = monitor or Monitor()
    begun = begun_surface(mesh, edge, monitor) if begun is None else begun
    return _evened(mesh, begun, edge, monitor, places, range(_PINNED_AT, _PASSES))


def _evened(
    mesh: TriangleMesh,
    begun: TriangleMesh,
    edge: float,
    monitor: Monitor,
    places: Floats | None,
    passes: range,
) -> TriangleMesh:
    """Some of the passes of `even_surface`, from a surface that earlier ones have made."""
    vertices, triangles = begun.vertices.copy(), begun.triangles.astype(np.int64)
    surface = NearestTriangles(mesh, _SAMPLED * edge)
    pinned = wanted = np.empty((0, 3))
    if places is not None and len(places):
        wanted = surface.closest(places)[0]
        near = cKDTree(wanted).query_pairs(_APART * edge, output_type="ndarray")
        wanted = np.delete(wanted, near.max(axis=1), axis=0)
    outwards = remesh.normals(mesh.vertices[mesh.triangles])

    def below(points: Floats) -> Floats:
        return np.asarray(outwards[surface.closest(points)[2]])

    may, allowed = _keeps_shape(below, _TINY * edge)
    for number in passes:
        monitor.tick()

        def is_long(one: Ints, two: Ints, points: Floats = vertices) -> Bools:
            length = lengths(points[one] - points[two])
            return np.asarray(length > _LONG * edge)

        vertices, triangles = remesh.split(vertices, triangles, is_long)
        if number == _PINNED_AT and len(wanted):
            vertices, triangles, pinned = _with_vertices(vertices, triangles, wanted, edge)
        for _ in range(3):
            creases = _Creases(vertices, triangles, pinned, _TINY * edge)
            rules = remesh.Rules(creases.rank, creases.may_slide, _nothing, may, lastly=allowed)
            before = len(vertices)
            vertices, triangles, _ = remesh.collapse(
                vertices, triangles, rules, _SHORT * edge, _LONG * edge
            )
            if len(vertices) == before:
                break
        creases = _Creases(vertices, triangles, pinned, _TINY * edge)
        for _ in range(_FLIPS):
            triangles, _ = remesh.flip(vertices, triangles, _rounder(vertices, creases), _nothing)
            creases = _Creases(vertices, triangles, pinned, _TINY * edge)
        if number < _PASSES - 1:
            vertices = _relaxed(vertices, triangles, creases, surface)
    return TriangleMesh(vertices, triangles.astype(np.int32))


def _with_vertices(
    vertices: Floats, triangles: Ints, places: Floats, edge: float
) -> tuple[Floats, Ints, Floats]:
    """The mesh with vertices at or near places (k, 3) on it; and where they are.

    A place near a vertex takes that one, one near an edge divides it, any other one its triangle.
    """
    waiting, found = places, []
    while len(waiting):
        away, nearest = cKDTree(vertices).query(waiting)
        taken = away < _AT_VERTEX * edge
        found.append(vertices[nearest[taken]])
        waiting = waiting[~taken]
        if not len(waiting):
            break
        mesh = TriangleMesh(vertices, triangles.astype(np.int32))
        at, _, triangle = closest_points(mesh, waiting)
        corners = vertices[triangles[triangle]]
        span = np.roll(corners, -1, axis=1) - corners
        square = np.maximum((span**2).sum(axis=2), 1e-300)
        share = np.einsum("kci,kci->kc", at[:, None] - corners, span) / square
        share = np.clip(share, 0.0, 1.0)
        foot = corners + share[:, :, None] * span
        off = lengths(at[:, None] - foot)
        side, every = np.argmin(off, axis=1), np.arange(len(at))
        table = remesh.edges(triangles, len(vertices))
        keys = edge_keys(table.ends[:, 0], table.ends[:, 1], len(vertices))
        order = np.argsort(keys)
        ends = np.stack([triangles[triangle, side], triangles[triangle, (side + 1) % 3]], axis=1)
        wanted = edge_keys(ends[:, 0], ends[:, 1], len(vertices))
        number = order[np.searchsorted(keys[order], wanted)]
        on_edge = (off[every, side] < _AT_EDGE * edge) & (table.triangles[number, 1] >= 0)
        touched = np.where(on_edge[:, None], table.triangles[number], triangle[:, None])
        # One at a time in a triangle: the first that asks for it.
        owner = np.full(len(triangles), len(at), np.int64)
        np.minimum.at(owner, touched.ravel(), np.repeat(every, 2))
        now = (owner[touched] == every[:, None]).all(axis=1)
        cut, inside = np.flatnonzero(now & on_edge), np.flatnonzero(now & ~on_edge)
        (u, v), (a, b) = table.ends[number[cut]].T, table.opposite[number[cut]].T
        new = len(vertices) + np.arange(len(cut))
        p, q, r = triangles[triangle[inside]].T
        other = len(vertices) + len(cut) + np.arange(len(inside))
        vertices = np.concatenate([vertices, foot[cut, side[cut]], at[inside]])
        triangles = triangles.copy()
        triangles[touched[cut, 0]] = np.stack([u, new, a], axis=1)
        triangles[touched[cut, 1]] = np.stack([v, new, b], axis=1)
        triangles[triangle[inside], 2] = other
        more = [(new, v, a), (new, u, b), (q, r, other), (r, p, other)]
        triangles = np.concatenate([triangles, *(np.stack(row, axis=1) for row in more)])
    return vertices, triangles, np.unique(np.concatenate([places[:0], *found]), axis=0)


def _nothing(one: Ints, two: Ints) -> Bools:
    del two
    return np.zeros(len(one), bool)


def _keeps_shape(
    below: Callable[[Floats], Floats], tiny: float
) -> tuple[Callable[[Floats, Floats], Bools], Callable[[Floats, Floats], Bools]]:
    """Which triangles may change as they would, and which of these indeed.

    Of needles, and of those lower than `tiny`, which close strips, it is only asked that they do
    not lie on the surface with their back outside: their own direction may be any.

    Args:
        below: the normals of the surface next to some points.
        tiny: mm.
    """

    def judged(before: Floats, after: Floats) -> tuple[Bools, Bools, Floats]:
        old, new = remesh.normals(before), remesh.normals(after)
        cosine = np.einsum("ij,ij->i", old, new)
        size, now = lengths(old), lengths(new)
        first, quality = remesh.qualities(before), remesh.qualities(after)
        shape = (quality > 0.1) | (quality > first)
        good = (cosine > _TURN * size * now) & (now > 0) & shape
        side = remesh.longest_sides(before)
        low = size < tiny * side
        maybe = ~good & (low | ((first < _NEEDLE) & (now > 0) & shape))
        return good, maybe, new

    def may(before: Floats, after: Floats) -> Bools:
        good, maybe, _ = judged(before, after)
        return np.asarray(good | maybe)

    def allowed(before: Floats, after: Floats) -> Bools:
        good, maybe, new = judged(before, after)
        rest = np.flatnonzero(maybe)
        if len(rest):
            outwards = below(after[rest].mean(axis=1))
            good[rest] = np.einsum("ij,ij->i", new[rest], outwards) >= 0.0
        return np.asarray(good)

    return may, allowed


def _rounder(vertices: Floats, creases: _Creases) -> Callable[[Ints, Ints], Floats]:
    """By how much a flip makes the worse of two triangles better; flat pairs only."""

    def gain(ends: Ints, corners: Ints) -> Floats:
        u, v = vertices[ends].swapaxes(0, 1)
        a, b = vertices[corners].swapaxes(0, 1)
        now = [np.stack([u, v, a], axis=1), np.stack([v, u, b], axis=1)]
        then = [np.stack([a, b, v], axis=1), np.stack([b, a, u], axis=1)]
        first, second = (remesh.normals(side) for side in now)
        size = lengths(first) * lengths(second)
        flat = np.einsum("ij,ij->i", first, second) > np.cos(np.radians(20.0)) * size
        before, after = (
            np.minimum(*(remesh.qualities(side) for side in pair)) for pair in (now, then)
        )
        # Across a needle nothing can be told of flatness: its neighbours' turn decides.
        flat |= before < 0.01
        sharp = creases.are_sharp(ends[:, 0], ends[:, 1])
        return np.where(flat & ~sharp, after - before - 1e-3, -1.0)

    return gain


def _relaxed(
    vertices: Floats, triangles: Ints, creases: _Creases, surface: NearestTriangles
) -> Floats:
    """Free vertices half-way towards the middle of their neighbours, back on the surface."""
    table = remesh.edges(triangles, len(vertices))
    both = np.concatenate([table.ends, table.ends[:, ::-1]])
    total = np.zeros_like(vertices)
    np.add.at(total, both[:, 0], vertices[both[:, 1]])
    number = np.maximum(np.bincount(both[:, 0], minlength=len(vertices)), 1)
    free = creases.rank == 0
    moved = 0.5 * (vertices + total / number[:, None])
    result = vertices.copy()
    result[free] = surface.closest(moved[free])[0]
    # A triangle that would turn over keeps its corners where they were, which may turn those
    # about it over, whose other corners have moved: these go back, too.
    old = remesh.normals(vertices[triangles])
    size = lengths(old)
    while True:
        new = remesh.normals(result[triangles])
        turned = np.einsum("ij,ij->i", old, new) <= 0.5 * size * lengths(new)
        turned &= (result[triangles] != vertices[triangles]).any(axis=(1, 2))
        if not turned.any():
            return result
        back = np.unique(triangles[turned])
        result[back] = vertices[back]
