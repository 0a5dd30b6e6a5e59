# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact self-intersection: which triangles of a mesh run through each other.

A part's facets lie as close as a millionth of a millimetre to each other where the Boolean has cut
needles. Rounding then decides what a test of floating-point numbers finds: FreeCAD's, in single
precision and with a tolerance, names pairs that do not meet. Here the signs of determinants are
taken as computed where they are larger than any rounding could be (the bound of Shewchuk, Adaptive
Precision Floating-Point Arithmetic, 1997), and are otherwise computed again in whole numbers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.triangle_mesh import TriangleMesh
from ..util.progress import Monitor
from ..util.types import Floats, Ints
from .self_intersection import close_pairs

Signs = NDArray[np.int8]

#: A determinant of 3 x 3 differences errs by no more than this times its terms without signs.
ROUNDING = 8.0 * np.finfo(np.float64).eps


def piercing_pairs(mesh: TriangleMesh, monitor: Monitor | None = None) -> Ints:
    """Pairs of triangles of which an edge of the first runs through the second.

    Neighbours over an edge are not looked at. Triangles that only touch, with a corner or in a
    plane that they share, do not count. Edges that meet each other between their ends do, where
    either triangle has corners on both sides of the other's plane: from the two alone nobody can
    tell whether surfaces cross or touch there.

    Args:
        mesh: any mesh; exact for the coordinates as they are, so read it as a file would be.
        monitor: told how far it is, asked for a cancel.

    Returns:
        (k, 2) int64, in rising order; two triangles may pierce each other and come in both orders.

    Raises:
        Cancelled: when the monitor says so.
    """
    monitor = monitor or Monitor()
    count = len(mesh.triangles)
    found = [np.empty((0, 2), np.int64)]
    for a, b in close_pairs(mesh.vertices[mesh.triangles], np.ones(count, bool)):
        monitor.tick()
        found.append(_piercing(mesh, a, b))
    return np.unique(np.concatenate(found), axis=0)


def _piercing(mesh: TriangleMesh, a: Ints, b: Ints) -> Ints:
    """(k, 2) of the pairs (a, b) and (b, a), those of which the first pierces the second."""
    one, two = mesh.triangles[a], mesh.triangles[b]
    alike = one[:, :, None] == two[:, None, :]
    near = alike.sum(axis=(1, 2)) < 2
    a, b, one, two = a[near], b[near], one[near], two[near]
    for _ in range(2):
        both = _on_both_sides(mesh.vertices, one, two)
        a, b, one, two = b[both], a[both], two[both], one[both]
    pairs = []
    for first, second, edges, faces in ((a, b, one, two), (b, a, two, one)):
        pierced = _edges_pierce(mesh.vertices, edges, faces)
        pairs.append(np.stack([first[pierced], second[pierced]], axis=1))
    return np.concatenate(pairs)


def _on_both_sides(
    vertices: Floats, one: NDArray[np.int32], two: NDArray[np.int32]
) -> NDArray[np.bool_]:
    """(n,) whether triangles `one` have corners on both sides of the planes of `two`."""
    sides = np.stack([_sides(vertices, two, one[:, k]) for k in range(3)], axis=1)
    return np.asarray((sides > 0).any(axis=1) & (sides < 0).any(axis=1), np.bool_)


def _edges_pierce(
    vertices: Floats, edges: NDArray[np.int32], faces: NDArray[np.int32]
) -> NDArray[np.bool_]:
    """(n,) whether an edge of the first triangles runs through the second ones."""
    pierced = np.zeros(len(edges), bool)
    sides = np.stack([_sides(vertices, faces, edges[:, k]) for k in range(3)], axis=1)
    for k in range(3):
        following = (k + 1) % 3
        rows = np.flatnonzero(sides[:, k] * sides[:, following] < 0)
        p, q = edges[rows, k], edges[rows, following]
        turns = np.stack(
            [
                _sides(vertices, np.stack([p, q, faces[rows, e]], axis=1), faces[rows, (e + 1) % 3])
                for e in range(3)
            ],
            axis=1,
        )
        pierced[rows[(turns >= 0).all(axis=1) | (turns <= 0).all(axis=1)]] = True
    return pierced


def _sides(vertices: Floats, planes: NDArray[np.int32], points: NDArray[np.int32]) -> Signs:
    """(n,) the exact side, -1, 0 or 1, of points against planes through three vertices each."""
    origin = vertices[points]
    u, v, w = (vertices[planes[:, k]] - origin for k in range(3))
    value = np.zeros(len(points))
    size = np.zeros(len(points))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        left, right = v[:, j] * w[:, k], v[:, k] * w[:, j]
        value += u[:, i] * (left - right)
        size += np.abs(u[:, i]) * (np.abs(left) + np.abs(right))
    signs = np.sign(value).astype(np.int8)
    unsure = np.flatnonzero(np.abs(value) <= ROUNDING * size)
    # Where every term is zero a difference is, and that is exact.
    unsure = unsure[size[unsure] > 0.0]
    if len(unsure):
        signs[unsure] = _exact_sides(vertices, planes[unsure], points[unsure])
    return signs


def _exact_sides(vertices: Floats, planes: NDArray[np.int32], points: NDArray[np.int32]) -> Signs:
    """As `_sides`, in whole numbers of any length."""
    used, rows = np.unique(np.column_stack([planes, points]), return_inverse=True)
    whole = _as_whole_numbers(vertices[used])[rows.reshape(-1, 4)]
    u, v, w = (whole[:, k] - whole[:, 3] for k in range(3))
    value = sum(
        u[:, i] * (v[:, (i + 1) % 3] * w[:, (i + 2) % 3] - v[:, (i + 2) % 3] * w[:, (i + 1) % 3])
        for i in range(3)
    )
    signs: Signs = (value > 0).astype(np.int8) - (value < 0).astype(np.int8)
    return signs


def _as_whole_numbers(values: Floats) -> NDArray[np.object_]:
    """All values times one power of two that makes Python integers of them."""
    mantissa, exponent = np.frexp(values)
    digits = np.ldexp(mantissa, 53).astype(np.int64).astype(object)
    lowest = int(exponent[mantissa != 0.0].min(initial=exponent.max()))
    shift = np.where(mantissa != 0.0, exponent - lowest, 0)
    whole: NDArray[np.object_] = digits * np.power(np.array(2, object), shift.astype(object))
    return whole
