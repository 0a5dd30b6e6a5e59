# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many threads the engine's parallel loops use: as many as there are cores, or as told."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import chain, islice
from typing import TypeVar

from .errors import VolfrepError

S = TypeVar("S")
T = TypeVar("T")

#: Variables by which linear algebra is told its threads.
MATRIX_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")

_wanted = 0


def use_threads(count: int) -> None:
    """Use so many threads from now on, in the whole process; 0 for one on each core.

    Writing STL files, measuring meshes and looking for nearest points run in parallel. The
    Boolean is manifold3d's, which cannot be told.

    Raises:
        VolfrepError: the number is negative.
    """
    global _wanted
    if count < 0:
        raise VolfrepError(
            f"There cannot be {count} threads: give 0 for one on each core, or more."
        )
    _wanted = count


def threads() -> int:
    """How many threads a parallel loop is to use."""
    return _wanted or _cores()


def one_for_matrices() -> None:
    """Before numpy is loaded: one thread for its linear algebra, where nothing says how many.

    Where matrices are small, more threads wait for each other, and on a busy machine for the
    processor: sizing a homogenised part took 125 s with one, and was not done in 20 min with two.
    """
    if not any(name in os.environ for name in MATRIX_THREADS):
        os.environ["OPENBLAS_NUM_THREADS"] = "1"


def in_threads(work: Callable[[S], T], items: Iterable[S]) -> Generator[T, None, None]:
    """`work(item)` for each item, in their order, on `threads` threads and a few items ahead.

    One item alone, as small jobs mostly have, is no work for another thread. Numpy lets go of the
    interpreter while it computes: portions of 10,000 numbers and more gain.
    """
    count, rest = threads(), iter(items)
    first = list(islice(rest, 2))
    if count == 1 or len(first) < 2:
        yield from map(work, chain(first, rest))
        return
    waiting: deque[Future[T]] = deque()
    with ThreadPoolExecutor(max_workers=count) as pool:
        try:
            for item in chain(first, rest):
                waiting.append(pool.submit(work, item))
                if len(waiting) > 2 * count:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()


def _cores() -> int:
    """Cores that this process may run on."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
