# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a reader of single precision sees of a mesh, and numbers written as text for it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from ..util.errors import VolfrepError
from ..util.parallel import ParallelBackend, SharedArray
from ..util.types import Ints
from .triangle_mesh import TriangleMesh, corners_at

#: Triangles or points looked at, or lines of text made, in one step (bounds the memory).
BLOCK_ROWS = 1 << 16
#: Numbers of many points are sorted in so many shares, on all threads.
KEY_SHARES = 4
#: Cubes in which points are near each other are so many times as wide as what near is, so that few
#: points lie at their faces; they are taken so many points at a time, which stay in the cache.
CUBE, CUBE_ROWS = 1024.0, 1 << 14
#: Odd numbers that mix the places of cubes along x, y and z into one number.
MIXERS = (0x1E3779B97F4A7C15, 0x42B2AE3D27D4EB4F, 0x165667B19E3779F9)
#: Bits of that number, from the lowest, that two rounds tell cubes apart by.
LOWEST_BITS = (40, 8)


def single_precision(mesh: TriangleMesh, path: str | os.PathLike[str]) -> NDArray[np.float32]:
    """The vertices (n, 3) as a file of single precision holds them.

    Raises:
        VolfrepError: the mesh is empty or has coordinates that float32 cannot hold; `path` is
            named in the text.
    """
    if not len(mesh.triangles):
        raise VolfrepError(f"There is nothing to write to '{path}': the mesh is empty.")
    if not np.abs(mesh.bounds).max() < np.finfo(np.float32).max:
        raise VolfrepError(
            f"Cannot write '{path}': the mesh holds coordinates that are not finite "
            "single-precision numbers."
        )
    return mesh.vertices.astype(np.float32)


def refuse_lost_corners(
    vertices: NDArray[np.float32], triangles: NDArray[np.int32], path: str | os.PathLike[str]
) -> None:
    """Refuse triangles of which two corners became one when they were rounded.

    Raises:
        VolfrepError: saying where the first of them is.
    """
    for start in range(0, len(triangles), BLOCK_ROWS):
        corners = corners_at(vertices, triangles[start : start + BLOCK_ROWS])
        lost = np.zeros(len(corners), bool)
        for a, b in ((0, 1), (1, 2), (2, 0)):
            lost |= (corners[:, a] == corners[:, b]).all(axis=1)
        if lost.any():
            x, y, z = corners[int(lost.argmax()), 0]
            raise VolfrepError(
                f"Cannot write '{path}': near ({x:g}, {y:g}, {z:g}) the mesh is finer than the "
                "single precision of the file there; move the part nearer to the origin or use a "
                "coarser resolution."
            )


def decimal_step(points: NDArray[np.float64]) -> float:
    """What the decimals of a text have to resolve, mm."""
    farthest = max(float(points.max(initial=1.0)), -float(points.min(initial=-1.0)))
    return float(np.spacing(np.float32(farthest)))


def rounded(numbers: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Numbers rounded to the decimal place that resolves `step`."""
    decimals = int(np.ceil(-np.log10(step)))
    return np.round(numbers, decimals) + 0.0  # -0 becomes 0


def lines(template: str, blocks: Iterable[NDArray[np.generic]]) -> Iterator[bytes]:
    """The template once for every row of (n, k) values, in formatting calls of bounded size."""
    for values in blocks:
        for start in range(0, len(values), BLOCK_ROWS):
            block = values[start : start + BLOCK_ROWS]
            yield ((template * len(block)) % tuple(block.ravel().tolist())).encode("ascii")


def merging_vertices(mesh: TriangleMesh, backend: ParallelBackend | None = None) -> Ints:
    """The vertices that a reader of a file would take for one with another, such together.

    A binary file holds the nearest float32 of every coordinate, a text the nearest decimal. The
    backend sorts; None: threads.
    """
    return merging(mesh.vertices, decimal_step(mesh.vertices), backend)


def merging(
    vertices: NDArray[np.float64], step: float, backend: ParallelBackend | None = None
) -> Ints:
    """`merging_vertices` among points (n, 3), where the decimals of a text resolve a step in mm."""
    backend = backend or ParallelBackend()
    twins = _twins(vertices, None, backend)
    return twins if len(twins) else _twins(vertices, step, backend)


def near_others(points: NDArray[np.float64], reach: float) -> Ints:
    """Points that may lie within so many mm of another one along every axis, and a few more.

    Such two are in one cube of a grid, or both at its faces. Cubes are told apart by few bits of a
    number each, and what shares these with others by others: nothing is sorted.

    Args:
        points: (n, 3), mm; fewer than 2^31.
        reach: mm.
    """
    code, chosen = np.empty(len(points), np.int64), np.empty(len(points), bool)
    per_mm = 1.0 / (CUBE * reach)
    for start in range(0, len(points), CUBE_ROWS):
        part = points[start : start + CUBE_ROWS] * per_mm
        cube = np.floor(part)
        part -= cube
        part -= 0.5
        at_face = (np.abs(part, out=part) > 0.5 - 1.0 / CUBE).T
        chosen[start : start + CUBE_ROWS] = at_face[0] | at_face[1] | at_face[2]
        x, y, z = (along * odd for along, odd in zip(cube.astype(np.int64).T, MIXERS, strict=True))
        code[start : start + CUBE_ROWS] = x + y + z
    rows = np.arange(len(points), dtype=np.int32)
    for lowest in LOWEST_BITS:
        count = len(rows)
        # From four to eight places for each, of which few have two points then.
        slots = 1 << (8 * count | 1).bit_length() - 1
        slot = (code >> lowest) & (slots - 1)
        number, last = np.arange(count, dtype=np.int32), np.empty(slots, np.int32)
        last[slot] = number  # of several the last one
        held = last[slot]
        others = np.flatnonzero(held != number)
        shared = np.zeros(count, bool)
        shared[others] = shared[held[others]] = True
        rows, code = rows[shared], code[shared]
    chosen[rows] = True
    return np.flatnonzero(chosen)


def _read(numbers: NDArray[np.float64], step: float | None) -> NDArray[np.float32]:
    """What a reader of a binary file has of numbers; of one of text, where it resolves a step."""
    # Zero has two signs and is one number.
    exact = numbers if step is None else rounded(numbers, step)
    return np.asarray(exact.astype(np.float32) + np.float32(0.0))


def _twins(vertices: NDArray[np.float64], step: float | None, backend: ParallelBackend) -> Ints:
    """Indices of the points that share all their coordinates with another one, twins together."""
    shares = KEY_SHARES
    if len(vertices) <= BLOCK_ROWS:
        shares, backend = 1, ParallelBackend()
    with backend.sharing(vertices) as (every,):
        given = ((every, step, share, shares) for share in range(shares))
        index = np.sort(np.concatenate(list(backend.starmap(_find_repeated, given))))
    if not len(index):
        return index
    points = _read(vertices[index], step)
    _, inverse, count = np.unique(points, axis=0, return_inverse=True, return_counts=True)
    inverse = inverse.ravel()
    shared = count[inverse] > 1
    twins: Ints = index[shared][np.argsort(inverse[shared], kind="stable")]
    return twins


def _find_repeated(every: SharedArray, step: float | None, share: int, shares: int) -> Ints:
    """The points of one share, twins among them, whose numbers occur more than once in it."""
    # Their rows are found once more rather than held beside what is sorted: mostly there are none.
    vertices = every.array
    some = np.concatenate([key for _, key in _numbers(vertices, step, share, shares)])
    some.sort()
    repeated = some[1:][some[1:] == some[:-1]]
    if not len(repeated):
        return np.zeros(0, np.int64)
    found = _numbers(vertices, step, share, shares)
    return np.concatenate([rows[np.isin(key, repeated)] for rows, key in found])


def _numbers(
    vertices: NDArray[np.float64], step: float | None, share: int, shares: int
) -> Iterator[tuple[Ints, NDArray[np.uint64]]]:
    """Points of one share, which x tells, some at a time, and a number for each.

    Equal where the coordinates are.
    """
    yield np.zeros(0, np.int64), np.zeros(0, np.uint64)
    for start in range(0, len(vertices), BLOCK_ROWS):
        part = vertices[start : start + BLOCK_ROWS]
        rows = np.arange(len(part))
        if shares > 1:
            bits = _read(part[:, 0], step).view(np.uint32)
            # The lowest bits of many numbers are alike, and so are the highest.
            mixed = (bits * np.uint32(0x9E3779B9)) >> np.uint32(16)
            rows = np.flatnonzero(mixed % np.uint32(shares) == np.uint32(share))
        columns = _read(corners_at(part, rows), step).view(np.uint32).astype(np.uint64)
        x, y, z = columns.T
        with np.errstate(over="ignore"):
            key = x * np.uint64(0x9E3779B97F4A7C15)
            key ^= y * np.uint64(0xC2B2AE3D27D4EB4F)
            key += (z << np.uint64(32)) ^ (z * np.uint64(0x165667B19E3779F9))
        yield rows + start, key
