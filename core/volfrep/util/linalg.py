# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rotations, frames, and small matrices in bulk, with the same bits whatever the threads.

The library behind numpy's `@` and `numpy.linalg` orders its sums by the number of its threads, also
those of 3 x 3 matrices; what a file's coordinates come from is computed here instead.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .types import Floats

#: Sweeps of Jacobi's method, which converges quadratically: 3 x 3 matrices take five.
SWEEPS = 6


def along(vectors: Floats, direction: Floats) -> Floats:
    """(...) the products of (..., 3) vectors with a (3,) direction."""
    return np.asarray(np.einsum("...j,j->...", vectors, direction))


def times(vectors: Floats, matrix: Floats) -> Floats:
    """(..., k) the products of (..., 3) rows with a (3, k) matrix."""
    return np.asarray(np.einsum("...j,jk->...k", vectors, matrix))


def cross_columns(a: Sequence[Floats] | Floats, b: Sequence[Floats] | Floats) -> list[Floats]:
    """Cross products of vectors whose x, y and z are arrays each: faster than rows of three."""
    return [a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))]


def dot_columns(a: Sequence[Floats] | Floats, b: Sequence[Floats] | Floats) -> Floats:
    """Products of vectors as of `cross_columns`, or of (3, n)."""
    return np.asarray(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def less_columns(a: Iterable[Floats], b: Iterable[Floats]) -> list[Floats]:
    """Differences of vectors as of `cross_columns`."""
    return [one - other for one, other in zip(a, b, strict=True)]


def squares(vectors: Floats) -> Floats:
    """(...) squares of (..., 3) vectors' lengths: faster than a sum along an axis of three."""
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.asarray(x * x + y * y + z * z)


def lengths(vectors: Floats) -> Floats:
    """(...) lengths of (..., 3) vectors, to the bit as `numpy.linalg.norm` has them."""
    return np.asarray(np.sqrt(squares(vectors)))


def normalize(vectors: NDArray[Any]) -> Floats:
    """(n, 3) vectors of length 1 along (n, 3) vectors; zero along those of no length."""
    return np.asarray(vectors / np.maximum(lengths(vectors), 1e-300)[:, None])


def determinants(matrices: Floats) -> Floats:
    """(n,) the determinants of (n, 3, 3) matrices."""
    first, second, third = np.moveaxis(matrices, -2, 0)
    return np.asarray(np.einsum("...j,...j->...", first, np.cross(second, third)))


def solve_symmetric(matrices: Floats, right: Floats) -> Floats:
    """(n, 3) the solutions of symmetric, positive definite systems, by L D L^T.

    Args:
        matrices: (n, 3, 3).
        right: (n, 3).
    """
    a, d, f = matrices[:, 0, 0], matrices[:, 0, 1], matrices[:, 0, 2]
    low, side = d / a, f / a
    b = matrices[:, 1, 1] - low * d
    e = matrices[:, 1, 2] - low * f
    last = e / b
    c = matrices[:, 2, 2] - side * f - last * e
    x, y, z = right.T
    y = y - low * x
    z = (z - side * x - last * y) / c
    y = y / b - last * z
    x = x / a - low * y - side * z
    return np.stack([x, y, z], axis=1)


def symmetric_eigen(matrices: Floats) -> tuple[Floats, Floats]:
    """Eigenvalues and eigenvectors of symmetric matrices, by Jacobi's method.

    Args:
        matrices: (n, 3, 3).

    Returns:
        (n, 3) values, rising, and (n, 3, 3) unit vectors as columns.
    """
    # A column for every entry, (3, 3, n): numpy takes rows of three slowly.
    left = np.ascontiguousarray(np.moveaxis(matrices, 0, -1), float)
    turned = np.broadcast_to(np.eye(3)[:, :, None], left.shape).copy()
    for _ in range(SWEEPS):
        for i, j in ((0, 1), (0, 2), (1, 2)):
            off = left[i, j]
            gap = left[j, j] - left[i, i]
            room = np.hypot(gap, 2.0 * off) + np.abs(gap)
            tangent = np.where(gap < 0.0, -2.0, 2.0) * off / np.where(room > 0.0, room, 1.0)
            cosine = 1.0 / np.sqrt(1.0 + tangent**2)
            sine = tangent * cosine
            for table in (left, turned):
                p, q = table[:, i].copy(), table[:, j]
                table[:, i], table[:, j] = cosine * p - sine * q, sine * p + cosine * q
            p, q = left[i].copy(), left[j]
            left[i], left[j] = cosine * p - sine * q, sine * p + cosine * q
    values, vectors = np.stack([left[k, k] for k in range(3)], axis=1), np.moveaxis(turned, -1, 0)
    order = np.argsort(values, axis=1, kind="stable")
    return np.take_along_axis(values, order, axis=1), np.take_along_axis(
        vectors, order[:, None, :], axis=2
    )


def turns(matrices: Floats) -> Floats:
    """(n, 3, 3) the rotations that are nearest to (n, 3, 3) matrices (their polar parts)."""
    squares = np.einsum("nki,nkj->nij", matrices, matrices)
    values, vectors = symmetric_eigen(squares)
    inverse = np.einsum("nik,nk,njk->nij", vectors, 1.0 / np.sqrt(values), vectors)
    return np.asarray(np.einsum("nik,nkj->nij", matrices, inverse))


def cross_matrix(vectors: Floats) -> Floats:
    """(..., 3, 3) by which each of (..., 3) vectors is crossed with another."""
    result = np.zeros((*vectors.shape, 3))
    x, y, z = np.moveaxis(vectors, -1, 0)
    result[..., 2, 1], result[..., 1, 2] = x, -x
    result[..., 0, 2], result[..., 2, 0] = y, -y
    result[..., 1, 0], result[..., 0, 1] = z, -z
    return result


def rotation(axis: Floats, angle: float) -> Floats:
    """(3, 3) the rotation about a (3,) axis by an angle in radians (Rodrigues)."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    twice = times(cross, cross)
    result: Floats = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * twice
    return result


def axes_across(axes: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors (n, 3) across each of (n, 3), right-handed with it."""
    first = normalize(np.cross(axes, np.eye(3)[np.abs(axes).argmin(axis=1)]))
    return first, np.cross(axes, first)


def frame_about(axis: Floats) -> Floats:
    """(3, 3) right-handed frame whose third column is the (3,) axis, its first near the x-axis."""
    third = np.asarray(axis, float) / np.linalg.norm(axis)
    near = np.eye(3)[0 if abs(third[0]) < 0.9 else 1]
    first = near - third * along(near, third)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(third, first), third], axis=1)
