# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the C library does with memory that arrays have left: kept for the next ones.

glibc begins by handing it back at once, and the system clears every page before it comes again,
which took 6 % of a small job's processor time. As arrays of 32 MB come and go glibc itself raises
what it keeps to the figures here, so that large jobs take no more memory for it.
"""

from __future__ import annotations

import os
import sys

from .threads import threads

#: Pieces below so many bytes come out of what is kept, and so much of that stays at the end of it.
KEPT_PIECE, KEPT = 1 << 25, 1 << 26
#: What these are to `mallopt` (malloc.h), and how many threads have memory of their own.
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD, M_ARENA_MAX = -1, -3, -8


def keep_freed_memory() -> None:
    """Keep freed memory, of as many threads as compute, in this process from now on.

    For processes that are the engine's own, once the number of threads is known. Nothing changes
    with other C libraries than glibc, or where the user has set one of its ``MALLOC_`` variables.
    """
    if not sys.platform.startswith("linux") or any(map(_is_set_by_user, os.environ)):
        return
    import ctypes

    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        mallopt(M_MMAP_THRESHOLD, KEPT_PIECE)
        mallopt(M_TRIM_THRESHOLD, KEPT)
        mallopt(M_ARENA_MAX, threads())


def _is_set_by_user(name: str) -> bool:
    return name.startswith("MALLOC_")
