# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points that fill a square or a cube evenly, Sobol's sequence, scrambled, or a sphere.

scipy has the sequence for any number of dimensions, in a part that takes as long to load as a small
lattice takes to be made. These are the points of its `qmc.Sobol`.
"""

from __future__ import annotations

import numpy as np

from ..util.types import Floats, Ints

#: Binary digits of a coordinate.
BITS = 30


def even_points(dimensions: int, points_log2: int, seed: int = 1) -> Floats:
    """(2 ** points_log2, dimensions) points from 0 to 1, the same in every run.

    Args:
        dimensions: 1 to 3.
        points_log2: 0 to `BITS`.
        seed: of the scrambling; sets with different ones tell how far they are off.

    Source: Sobol 1967, "On the distribution of points in a cube and the approximate evaluation of
    integrals"; Matousek 1998, "On the L2-discrepancy for anchored boxes", for the scrambling.
    """
    random = np.random.default_rng(seed)
    digit = 1 << np.arange(BITS, dtype=np.int64)
    shift = (random.integers(2, size=(dimensions, BITS), dtype=np.uint32) * digit).sum(axis=1)
    mixed = np.tril(random.integers(2, size=(dimensions, BITS, BITS), dtype=np.uint32), -1)
    mixed |= np.eye(BITS, dtype=np.uint32)
    points = np.empty((2**points_log2, dimensions))
    for k in range(dimensions):
        digits = _directions(k)[:, None] // digit[::-1] % 2
        digits = (digits[:, None] * mixed[k]).sum(axis=2) % 2
        directions = (digits * digit[::-1]).sum(axis=1)
        place = shift[k : k + 1]
        for direction in directions[:points_log2]:  # by Gray's code, which is mirrored and goes on
            place = np.concatenate([place, place[::-1] ^ direction])
        points[:, k] = place / 2**BITS
    return points


def _directions(dimension: int) -> Ints:
    """(BITS,) the direction numbers of a dimension, by its polynomial: 1, x + 1, x^2 + x + 1."""
    numbers = [1, 3] if dimension == 2 else [1]
    for _ in range(len(numbers), BITS):
        if dimension == 2:
            numbers.append(2 * numbers[-1] ^ 4 * numbers[-2] ^ numbers[-2])
        else:
            numbers.append(2 * numbers[-1] ^ numbers[-1] if dimension else 1)
    return np.array(numbers, np.int64) << np.arange(BITS, dtype=np.int64)[::-1]


def even_directions(count: int) -> Floats:
    """(count, 3) unit vectors, evenly over a sphere (Fibonacci's spiral)."""
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    turn = np.pi * (1.0 + np.sqrt(5.0)) * k
    flat = np.sqrt(1.0 - z**2)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)
