# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many threads the engine's parallel loops use: as many as there are cores, or as told."""

from __future__ import annotations

import os

from .errors import VolfrepError

_told = 0


def use_threads(count: int) -> None:
    """Use so many threads from now on, in the whole process; 0 for one on each core.

    Writing STL files, measuring meshes and looking for nearest points run in parallel. The
    Boolean is manifold3d's, which cannot be told.

    Raises:
        VolfrepError: the number is negative.
    """
    global _told
    if count < 0:
        raise VolfrepError(
            f"There cannot be {count} threads: give 0 for one on each core, or more."
        )
    _told = count


def threads() -> int:
    """How many threads a parallel loop is to use."""
    return _told or _cores()


def _cores() -> int:
    """Cores that this process may run on."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
