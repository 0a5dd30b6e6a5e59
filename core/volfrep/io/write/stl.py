# SPDX-License-Identifier: LGPL-2.1-or-later
"""Binary STL: the format of every slicer, with the precision of float32."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, wait
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...mesh.precision import refuse_lost_corners, single_precision
from ...mesh.triangle_mesh import TriangleMesh, compact
from ...util.errors import VolfrepError
from ...util.files import check_writable, refuse_full, replacing, write_at
from ...util.parallel import LocalArray, MappedArray, ParallelBackend, SharedArray
from ...util.progress import POLL_SECONDS, Monitor
from ...util.threads import in_threads
from ...util.types import Floats

HEADER_BYTES = 80
#: One facet as it lies in the file.
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
#: Facets as they lie in the file: (m,) of `FACET`.
Facets = NDArray[np.void]
#: The file counts its facets in 32 bits.
MOST_FACETS = int(np.iinfo(np.uint32).max)
#: Facets prepared at once by each thread: they should stay in the processor's cache.
BLOCK_FACETS = 1 << 13
#: Facets that a worker is asked for at a time.
CALL_FACETS = 1 << 18


@dataclass(frozen=True)
class Block:
    """Facets that follow each other in a file.

    Attributes:
        count: of them.
        make: called on any thread.
        goes: whether it pickles, and is little beside what it makes: any process may make it.
    """

    count: int
    make: Callable[[], Facets]
    goes: bool = False


#: Where blocks lie in a file, and they.
Placed = list[tuple[int, Block]]


def write_stl(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write a binary STL with facet normals, beside the target and then renamed.

    Args:
        mesh: in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.

    Raises:
        VolfrepError: the mesh is empty, holds coordinates that float32 cannot, or has triangles
            that lose a corner in float32; or the path cannot be written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    write_facets(path, len(mesh.triangles), mesh_blocks(mesh, path), monitor)


def mesh_blocks(
    mesh: TriangleMesh, path: str | os.PathLike[str], first: int = 0
) -> Iterator[Block]:
    """The facets of a mesh in mm, from the first one wanted, block by block, for the file.

    Raises:
        VolfrepError: as `write_stl`.
    """
    vertices, triangles = LocalArray(single_precision(mesh, path)), LocalArray(mesh.triangles)
    return _blocks_between(vertices, triangles, first, len(mesh.triangles), path, goes=False)


@contextmanager
def blocks_for(
    mesh: TriangleMesh, path: str | os.PathLike[str], executor: Executor | None
) -> Iterator[Callable[[int], Iterator[Block]]]:
    """`mesh_blocks` from a facet on, which an executor's processes on this machine may make."""
    backend = ParallelBackend()
    if executor is not None:
        from ...process.pool import backend_of  # of no use to blocks, and slow to import

        backend = backend_of(executor)
    count = len(mesh.triangles)
    with backend.sharing(single_precision(mesh, path), mesh.triangles) as (vertices, triangles):
        goes = isinstance(triangles, MappedArray)
        yield lambda first: _blocks_between(vertices, triangles, first, count, path, goes=goes)


def _blocks_between(
    vertices: SharedArray,
    triangles: SharedArray,
    first: int,
    count: int,
    path: str | os.PathLike[str],
    *,
    goes: bool,
) -> Iterator[Block]:
    for start in range(first, count, BLOCK_FACETS):
        stop = min(start + BLOCK_FACETS, count)
        yield Block(stop - start, partial(_facets, vertices, triangles, start, stop, path), goes)


def _facets(
    vertices: SharedArray,
    triangles: SharedArray,
    start: int,
    stop: int,
    path: str | os.PathLike[str],
) -> Facets:
    return facets_at(vertices.array, triangles.array[start:stop], path)


def write_facets(
    path: str | os.PathLike[str],
    count: int,
    blocks: Iterable[Block],
    monitor: Monitor | None,
    executor: Executor | None = None,
) -> None:
    """Write a binary STL of blocks of facets.

    Args:
        path: of the file; an old file stays if anything goes wrong.
        count: of all the facets.
        blocks: each is made and written on one of the threads, at its place in the file.
        monitor: told the progress, asked for a cancel.
        executor: its processes on this machine make the blocks that go; None: threads.

    Raises:
        VolfrepError: there are more facets than the format can count, or the path cannot be
            written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    refuse_facets(count, path)
    if executor is not None:
        from ...process.pool import on_this_machine  # of no use to blocks, and slow to import

        executor = on_this_machine(executor)
    head = b"binary STL, mm".ljust(HEADER_BYTES, b" ") + np.array(count, "<u4").tobytes()
    with replacing(path) as file:
        file.write(head)
        file.flush()

        def placed() -> Iterator[tuple[int, Block]]:
            place = len(head)
            for block in blocks:
                yield place, block
                place += FACET.itemsize * block.count

        given: list[tuple[Placed, Future[int]]] = []
        here: Iterable[tuple[int, Block]] = placed()
        if executor is not None:
            here, calls = _share_out(here)
            for call in calls:
                try:
                    given.append((call, executor.submit(write_blocks, file.name, call)))
                except RuntimeError:  # it takes nothing more, as when its processes were killed
                    here += call

        def write(each: tuple[int, Block]) -> int:
            place, block = each
            write_at(file, block.make().data, place)
            return block.count

        written = 0

        def note(more: int) -> None:
            nonlocal written
            written += more
            if monitor is not None:
                monitor.count("bytes written", FACET.itemsize * more)
                monitor.tick(written / count)

        with closing(in_threads(write, here)) as ended:  # before the file is
            for more in ended:
                note(more)
        for call, future in given:
            while not future.done():
                wait([future], POLL_SECONDS)
                note(0)
            if future.cancelled() or future.exception() is not None:
                for each in call:  # its worker was lost; what is wrong otherwise shows again
                    note(write(each))
            else:
                note(future.result())


def _share_out(blocks: Iterable[tuple[int, Block]]) -> tuple[Placed, list[Placed]]:
    """Blocks that stay in this process, and those that go, some at a time."""
    here: Placed = []
    calls: list[Placed] = [[]]
    facets = 0
    for place, block in blocks:
        if not block.goes:
            here.append((place, block))
            continue
        calls[-1].append((place, block))
        facets += block.count
        if facets >= CALL_FACETS:
            calls.append([])
            facets = 0
    return here, [call for call in calls if call]


def write_blocks(path: str, blocks: Placed) -> int:
    """Write blocks at their places in a file that is there; how many facets they have."""
    with open(path, "r+b") as file:
        for place, block in blocks:
            write_at(file, block.make().data, place)
    return sum(block.count for _, block in blocks)


def refuse_facets(count: int, path: str | os.PathLike[str]) -> None:
    """Raise a `VolfrepError` where a file cannot count so many facets or the disk not hold them."""
    if count > MOST_FACETS:
        raise VolfrepError(
            f"Cannot write '{path}': an STL file holds at most {MOST_FACETS:,} triangles, and "
            f"there are {count:,}; use a coarser resolution or fewer cells."
        )
    refuse_full(check_writable(path), HEADER_BYTES + 4 + FACET.itemsize * count)


def merge_corners(corners: NDArray[np.float32]) -> TriangleMesh:
    """A mesh from (3 m, 3) float32 corners, three a triangle, equal ones made one vertex."""
    # Adding zero turns -0.0 into 0.0: equal numbers then have equal bits.
    bits = (np.asarray(corners, np.float32) + np.float32(0.0)).view(np.uint32)
    key = bits[:, 0].astype(np.uint64) << np.uint64(32) | bits[:, 1]
    _, column = np.unique(key, return_inverse=True)
    key = column.ravel().astype(np.uint64) << np.uint64(32) | bits[:, 2]
    del column
    _, first, index = np.unique(key, return_index=True, return_inverse=True)
    return TriangleMesh(corners[first].astype(np.float64), index.reshape(-1, 3).astype(np.int32))


def as_read(mesh: TriangleMesh) -> TriangleMesh:
    """The mesh as it will come back from an STL file, without the way through the disk."""
    used = compact(mesh)
    return merge_corners(used.vertices.astype(np.float32)[used.triangles].reshape(-1, 3))


def facets_at(
    vertices: NDArray[np.float32] | Floats,
    triangles: NDArray[np.int32],
    path: str | os.PathLike[str],
) -> Facets:
    """`facets_of` triangles of numbered vertices, (n, 3) mm."""
    corners = np.take(vertices, triangles, axis=0, mode="clip")  # as `corners_at`
    return facets_of(corners.astype(np.float32, copy=False), path)


def facets_of(corners: NDArray[np.float32], path: str | os.PathLike[str]) -> Facets:
    """Triangles by their corners, (m, 3, 3), as they lie in the file at the path.

    Raises:
        VolfrepError: single precision took a corner of one.
    """
    facets = np.zeros(len(corners), FACET)
    facets["corners"] = corners
    # A row for every number of a facet: numpy is slow at many short rows.
    a, b, c = np.ascontiguousarray(corners.reshape(-1, 9).T).reshape(3, 3, -1)
    e, f = b - a, c - a
    normal = np.stack([e[i] * f[j] - e[j] * f[i] for i, j in ((1, 2), (2, 0), (0, 1))])
    length = np.sqrt((normal * normal).sum(axis=0))
    flat = np.flatnonzero(length == 0.0)
    refuse_lost_corners(
        corners[flat].reshape(-1, 3), np.arange(3 * len(flat), dtype=np.int32).reshape(-1, 3), path
    )
    length[flat] = 1.0
    facets["normal"] = (normal / length).T
    return facets
