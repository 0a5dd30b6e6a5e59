# SPDX-License-Identifier: LGPL-2.1-or-later
"""A solid's surface in even triangles of about one edge length, its sharp edges kept."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..mesh import remesh
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import closest_points
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints

#: Edges where the surface turns by more than this stay, degrees.
SHARP = 30.0
#: A triangle may turn by no more than this when a neighbour goes: so round holes stay round enough.
_TURN = np.cos(np.radians(28.0))
_PASSES = 10
#: Edges longer and shorter than so many times the wanted length are split and taken out.
_LONG, _SHORT = 1.4, 0.75


class _Creases:
    """Sharp edges of a mesh, and how far each vertex is held by them (`rank`)."""

    def __init__(self, vertices: Floats, triangles: Ints) -> None:
        self.count = len(vertices)
        table = remesh.edges(triangles, self.count)
        normal = remesh.normals(vertices[triangles])
        normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        one, two = table.triangles.T
        cosine = np.einsum("ij,ij->i", normal[one], normal[two])
        sharp = (cosine < np.cos(np.radians(SHARP))) | (two < 0)
        ends = table.ends[sharp]
        self.keys = np.sort(self._key(ends[:, 0], ends[:, 1]))
        number = np.bincount(ends.ravel(), minlength=self.count)
        # On a crease of two edges that run straight on; a corner elsewhere.
        way = np.zeros((self.count, 3))
        step = vertices[ends[:, 1]] - vertices[ends[:, 0]]
        step /= np.maximum(np.linalg.norm(step, axis=1), 1e-300)[:, None]
        np.add.at(way, ends[:, 0], step)
        np.add.at(way, ends[:, 1], -step)
        bent = np.linalg.norm(way, axis=1) > 0.7
        self.rank = np.where(number == 0, 0, np.where((number == 2) & ~bent, 1, 2))

    def _key(self, one: Ints, two: Ints) -> Ints:
        return np.asarray(np.minimum(one, two) * np.int64(self.count) + np.maximum(one, two))

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
        return np.asarray(free | ((self.rank[gone] == 1) & self.are_sharp(gone, kept)))


def even_surface(mesh: TriangleMesh, edge: float, monitor: Monitor | None = None) -> TriangleMesh:
    """The surface in triangles whose edges are about so long, where its details allow it.

    Args:
        mesh: closed, mm.
        edge: mm.
        monitor: asked for a cancel.
    """
    monitor = monitor or Monitor()
    vertices, triangles = mesh.vertices.copy(), mesh.triangles.astype(np.int64)
    for number in range(_PASSES):
        monitor.tick()

        def is_long(one: Ints, two: Ints, points: Floats = vertices) -> Bools:
            length = np.linalg.norm(points[one] - points[two], axis=1)
            return np.asarray(length > _LONG * edge)

        vertices, triangles = remesh.split(vertices, triangles, is_long)
        for _ in range(3):
            creases = _Creases(vertices, triangles)
            rules = remesh.Rules(creases.rank, creases.may_slide, _nothing, _stays_good)
            before = len(vertices)
            vertices, triangles, _ = remesh.collapse(
                vertices, triangles, rules, _SHORT * edge, _LONG * edge
            )
            if len(vertices) == before:
                break
        creases = _Creases(vertices, triangles)
        triangles, _ = remesh.flip(vertices, triangles, _rounder(vertices, creases), _nothing)
        if number < _PASSES - 1:
            vertices = _relaxed(vertices, triangles, creases, mesh)
    return TriangleMesh(vertices, triangles.astype(np.int32))


def _nothing(one: Ints, two: Ints) -> Bools:
    del two
    return np.zeros(len(one), bool)


def _stays_good(before: Floats, after: Floats) -> Bools:
    old, new = remesh.normals(before), remesh.normals(after)
    cosine = np.einsum("ij,ij->i", old, new)
    size = np.linalg.norm(old, axis=1) * np.linalg.norm(new, axis=1)
    quality = remesh.qualities(after)
    shape = (quality > 0.1) | (quality > remesh.qualities(before))
    # A needle has no direction worth keeping.
    needle = remesh.qualities(before) < 0.01
    return np.asarray(((cosine > _TURN * size) | needle) & (size > 0) & shape)


def _rounder(vertices: Floats, creases: _Creases) -> Callable[[Ints, Ints], Floats]:
    """By how much a flip makes the worse of two triangles better; flat pairs only."""

    def gain(ends: Ints, corners: Ints) -> Floats:
        u, v = vertices[ends].swapaxes(0, 1)
        a, b = vertices[corners].swapaxes(0, 1)
        now = [np.stack([u, v, a], axis=1), np.stack([v, u, b], axis=1)]
        then = [np.stack([a, b, v], axis=1), np.stack([b, a, u], axis=1)]
        first, second = (remesh.normals(side) for side in now)
        size = np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1)
        flat = np.einsum("ij,ij->i", first, second) > np.cos(np.radians(20.0)) * size
        before, after = (
            np.minimum(*(remesh.qualities(side) for side in pair)) for pair in (now, then)
        )
        # Across a needle nothing can be told of flatness: its neighbours' turn decides.
        flat |= before < 0.01
        sharp = creases.are_sharp(ends[:, 0], ends[:, 1])
        return np.where(flat & ~sharp, after - before - 1e-3, -1.0)

    return gain


def _relaxed(vertices: Floats, triangles: Ints, creases: _Creases, mesh: TriangleMesh) -> Floats:
    """Free vertices half-way towards the middle of their neighbours, back on the surface."""
    table = remesh.edges(triangles, len(vertices))
    both = np.concatenate([table.ends, table.ends[:, ::-1]])
    total = np.zeros_like(vertices)
    np.add.at(total, both[:, 0], vertices[both[:, 1]])
    number = np.maximum(np.bincount(both[:, 0], minlength=len(vertices)), 1)
    free = creases.rank == 0
    moved = 0.5 * (vertices + total / number[:, None])
    result = vertices.copy()
    result[free] = closest_points(mesh, moved[free])[0]
    # A triangle that would turn over keeps its corners where they were.
    old, new = remesh.normals(vertices[triangles]), remesh.normals(result[triangles])
    turned = np.einsum("ij,ij->i", old, new) <= 0.5 * np.linalg.norm(old, axis=1) * np.linalg.norm(
        new, axis=1
    )
    back = np.unique(triangles[turned])
    result[back] = vertices[back]
    return result
