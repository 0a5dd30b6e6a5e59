# SPDX-License-Identifier: LGPL-2.1-or-later
"""Constrained mesh over an implicit surface: its vertices are projected onto it.

Vertices on an octant's faces move in those faces only, and by what is on the face only, so that
the neighbour on the other side comes to the same places.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..util.linalg import solve_symmetric
from ..util.types import Bools, Floats, Ints
from .sdf import Field, distances_and_gradients

#: Vertices that are not on a face of their octant keep this distance to it, in sampling steps.
FACE_MARGIN = 1e-3
#: Surfaces that meet at a lesser angle than this (cosine) have no crease worth a vertex.
CREASE_COSINE = np.cos(np.radians(12.0))
#: A vertex nearer to a primitive's surface than this, in units of the wanted edge, lies on it.
ON_SURFACE = 1e-3


@dataclass(frozen=True, eq=False)
class PinnedMesh:
    """A mesh in octants, on whose faces vertices stay.

    Attributes:
        vertices: (n, 3) float64, mm.
        triangles: (m, 3) int64.
        place: (n, 3) int8, per axis 0 on an octant's low face, 2 on its high face, else 1.
        edge: wanted edge length, mm.
        step: sampling step of the raw surface, mm.
        piece: (n,) int64, which of the octants that are meshed together a vertex belongs to.
        size: of an octant, mm.
    """

    vertices: Floats
    triangles: Ints
    place: NDArray[np.int8]
    edge: float
    step: float
    piece: Ints
    size: float

    @property
    def pinned(self) -> Bools:
        """(n, 3) bool, coordinates that must keep their value: on an octant's face."""
        result: Bools = self.place != 1
        return result

    def facets_of(self, piece: int) -> int:
        """How many facets one of the octants has."""
        return int((self.piece[self.triangles[:, 0]] == piece).sum())

    def share_face(self, one: Ints, two: Ints) -> Bools:
        """Whether vertices lie on a common face of their octant."""
        result: Bools = ((self.place[one] == self.place[two]) & self.pinned[one]).any(axis=1)
        return result

    @property
    def rank(self) -> Ints:
        """0 free, 3 on the border."""
        rank: Ints = np.where(self.pinned.any(axis=1), 3, 0)
        return rank


#: Such a mesh, or one that knows more of itself.
Mesh = TypeVar("Mesh", bound=PinnedMesh)


@dataclass(frozen=True, eq=False)
class Surface(PinnedMesh):
    """A mesh over the surface of primitives.

    Attributes:
        held: (n, 3) int64, primitives on whose surfaces a vertex must stay: none (-1) for one
            that is free on the surface, two on a crease, three at a corner.
        field: the signed distance about each vertex.
    """

    held: Ints
    field: Field

    @property
    def rank(self) -> Ints:
        """0 free, 1 on a crease, 2 at a corner, 3 on the border."""
        crease = np.maximum((self.held >= 0).sum(axis=1) - 1, 0)
        rank: Ints = np.where(self.pinned.any(axis=1), 3, crease)
        return rank


def project(surface: Surface, passes: int = 2) -> Surface:
    """Every vertex moved onto the exact surface, crease or corner, by Newton's method.

    Those on an octant's edges are left where `_settle_on_edges` put them.
    """
    vertices = surface.vertices.copy()
    loose = ~surface.pinned
    movable = loose.sum(axis=1) >= 2
    held = surface.held[:, 0] >= 0
    free = np.flatnonzero(~held & movable)
    bound = np.flatnonzero(held & movable)
    free_field = surface.field.rows(free)
    for _ in range(passes):
        value, gradient = free_field.values_and_gradients(vertices[free])
        gradient = gradient * loose[free]
        # Where the surface grazes the face that the vertex is pinned to, the step is kept short.
        size = np.maximum(np.einsum("ij,ij->i", gradient, gradient), 0.05)
        vertices[free] -= shorten_steps(gradient * (value / size)[:, None], 0.5 * surface.edge)
        if len(bound):
            step = step_to_primitives(surface, vertices[bound], surface.held[bound], loose[bound])
            vertices[bound] += shorten_steps(step, 0.5 * surface.edge)
    return move_vertices(surface, vertices)


def move_vertices(surface: Mesh, vertices: Floats) -> Mesh:
    """The surface with its vertices elsewhere, each still in its octant, face or edge.

    A facet that left its octant would run through those of the next one, and a vertex that came
    next to a face without lying on it could become one with the next octant's in single precision.
    """
    margin = FACE_MARGIN * surface.step
    kept = np.clip(vertices, margin, surface.size - margin)
    return replace(surface, vertices=np.where(surface.pinned, surface.vertices, kept))


def step_to_primitives(
    surface: Surface, points: Floats, held: Ints, loose: Bools, level: Floats | float = 0.0
) -> Floats:
    """(n, 3) shortest step that brings each point onto all of up to three primitives.

    Args:
        surface: whose primitives they are.
        points: (n, 3), mm.
        held: (n, 3) the primitives; -1 for none.
        loose: (n, 3) coordinates that may change.
        level: distance that the points are to have from the primitives' surfaces, mm.
    """
    flat = np.maximum(held, 0).ravel()
    value, gradient = distances_and_gradients(
        np.repeat(points, 3, axis=0), surface.field.primitives.take(flat)
    )
    value = value - np.repeat(np.broadcast_to(level, len(points)), 3)
    none = (held < 0).ravel()
    value[none] = 0.0
    gradient[none] = 0.0
    jacobian: Floats = gradient.reshape(-1, 3, 3) * loose[:, None, :]
    # Not `einsum`, whose last bits hang on where in the batch a row lies: neighbours that see the
    # same on their common face must come to the same place.
    normal = (jacobian[:, :, None, :] * jacobian[:, None, :, :]).sum(axis=3) + 1e-6 * np.eye(3)
    factor = solve_symmetric(normal, value.reshape(-1, 3))
    return np.asarray(-(jacobian * factor[:, :, None]).sum(axis=1))


def shorten_steps(steps: Floats, longest: float | Floats) -> Floats:
    """The (n, 3) steps, none of them longer than `longest`, one for all or (n,)."""
    size = np.linalg.norm(steps, axis=1)
    short: Floats = steps * np.minimum(1.0, longest / np.maximum(size, 1e-300))[:, None]
    return short


def neighbour_mean(
    count: int, pairs: Ints, vertices: Floats, least: int = 1
) -> tuple[Floats, Bools]:
    """Mean of the vertices that `pairs` joins each vertex to; whether it has at least so many."""
    start = np.concatenate([pairs[:, 0], pairs[:, 1]])
    end = np.concatenate([pairs[:, 1], pairs[:, 0]])
    number = np.bincount(start, minlength=count)
    mean = np.stack(
        [np.bincount(start, vertices[end, axis], minlength=count) for axis in range(3)], axis=1
    )
    return mean / np.maximum(number, 1)[:, None], number >= least


def between_samples(surface: Surface, index: Ints) -> tuple[Floats, Floats]:
    """The stretch of an octant's edge that each of its vertices stays on."""
    points, loose = surface.vertices[index], ~surface.pinned[index]
    cell = np.floor(points / surface.step)
    margin = 1e-3
    low = np.where(loose, (cell + margin) * surface.step, points)
    high = np.where(loose, (cell + 1.0 - margin) * surface.step, points)
    return low, high


def crease_points(
    surface: Surface, ends: Ints, one: Ints, two: Ints, loose: Bools
) -> tuple[Floats, Ints, Bools]:
    """Where edges between two primitives cross their crease.

    Args:
        surface: whose primitives they are.
        ends: (k, 2) vertices of the edges.
        one: (k,) the primitives that the first ends lie on.
        two: (k,) those of the second ones.
        loose: (k, 3) coordinates that may change.

    Returns:
        (k, 3) points; (k, 3) the primitives that meet there, -1 for no third one, which is where
        a third one would bury the crossing; (k,) whether there is such a place.
    """
    primitives = surface.field.primitives
    a, b = surface.vertices[ends[:, 0]], surface.vertices[ends[:, 1]]
    first, second = primitives.take(one), primitives.take(two)
    # The two distances are equal about here along the edge.
    at_a = distances_and_gradients(a, second)[0]
    at_b = distances_and_gradients(b, first)[0]
    share = np.clip(at_a / np.maximum(at_a + at_b, 1e-300), 0.0, 1.0)
    point = a + share[:, None] * (b - a)
    held = np.stack([one, two, np.full(len(one), -1)], axis=1)
    for _ in range(5):
        step = step_to_primitives(surface, point, held, loose)
        point = point + shorten_steps(step, 0.5 * surface.edge)
    field = surface.field.rows(ends[:, 0])
    least, third = field.nearest(point)
    tolerance = ON_SURFACE * surface.edge
    buried = least < -tolerance
    held[buried, 2] = third[buried]
    for _ in range(6):
        step = step_to_primitives(surface, point[buried], held[buried], loose[buried])
        point[buried] += shorten_steps(step, 0.5 * surface.edge)
    value_one, gradient_one = distances_and_gradients(point, first)
    value_two, gradient_two = distances_and_gradients(point, second)
    good = np.einsum("ij,ij->i", gradient_one, gradient_two) < CREASE_COSINE
    good &= np.maximum(np.abs(value_one), np.abs(value_two)) < tolerance
    good &= field.values(point) > -tolerance
    return point, held, good


@dataclass(frozen=True, eq=False)
class Meshed:
    """Surfaces of octants that are meshed together, with what is known of their vertices.

    Attributes:
        surface: its vertices piece by piece.
        home: (n, 3) where marching cubes found them, or the middle of those they lie between, mm.
        order: (n,) int64, orders the vertices of a face or edge alike in all octants that share it.
    """

    surface: Surface
    home: Floats
    order: Ints

    def of(self, surface: Surface, parents: Ints) -> Meshed:
        """The surface that came of this one: (n, 2) of which vertices its own came, or one each."""
        if parents.ndim == 1:
            return Meshed(surface, self.home[parents], self.order[parents])
        # What is between two comes after both, whatever else there is: in any octant that has them.
        order = np.sort(self.order[parents], axis=1)
        _, rank = np.unique(order, axis=0, return_inverse=True)
        return Meshed(surface, self.home[parents].mean(axis=1), rank.reshape(-1))

    def where(self, which: Bools) -> Meshed:
        """Some of its pieces: those of (n,) vertices."""
        surface, number = self.surface, np.cumsum(which) - 1
        triangles = number[surface.triangles[which[surface.triangles[:, 0]]]]
        part = replace(
            surface, vertices=surface.vertices[which], triangles=triangles,
            place=surface.place[which], held=surface.held[which],
            field=surface.field.rows(np.flatnonzero(which)), piece=surface.piece[which],
        )  # fmt: skip
        return Meshed(part, self.home[which], self.order[which])

    def joined(self, other: Meshed) -> Meshed:
        """Both, piece by piece again."""
        one, two = self.surface, other.surface
        piece = np.concatenate([one.piece, two.piece])
        by_piece = np.argsort(piece, kind="stable")
        rank = np.empty(len(piece), np.int64)
        rank[by_piece] = np.arange(len(piece))

        def both(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
            result: NDArray[Any] = np.concatenate([a, b])[by_piece]
            return result

        triangles = rank[np.concatenate([one.triangles, two.triangles + len(one.vertices)])]
        surface = replace(
            one, vertices=both(one.vertices, two.vertices), triangles=triangles,
            place=both(one.place, two.place), held=both(one.held, two.held),
            field=one.field.joined(two.field).rows(by_piece), piece=piece[by_piece],
        )  # fmt: skip
        return Meshed(surface, both(self.home, other.home), both(self.order, other.order))
