# SPDX-License-Identifier: LGPL-2.1-or-later
"""The address space that a process may take, where a limit such as `ulimit -v` says so.

Nothing but the standard library is imported here: below a limit OpenBLAS, which numpy loads, ends
the process or waits for ever.
"""

from __future__ import annotations

import math
import os

from .errors import VolfrepError
from .threads import threads, use_threads

#: Bytes that a small job takes on one thread: 0.32 GB was enough for a block of a cell.
LEAST = 0.4e9
#: Bytes of address space for each further thread: its stack, and what OpenBLAS and malloc set
#: aside for it. 0.14 GB were taken.
EACH_THREAD = 0.15e9


def allowed() -> float:
    """Bytes of address space that this process may take; infinite where nothing limits it."""
    try:
        import resource
    except ImportError:  # Windows has no such limit
        return math.inf
    soft, _ = resource.getrlimit(resource.RLIMIT_AS)
    return math.inf if soft == resource.RLIM_INFINITY else float(soft)


def left() -> float:
    """Bytes of address space that are still to be had; infinite where nothing limits it."""
    most = allowed()
    if most == math.inf:
        return most
    try:
        with open("/proc/self/statm", encoding="ascii") as file:
            pages = int(file.read().split()[0])
    except OSError:  # only Linux tells what is taken
        return most
    return max(0.0, most - pages * float(os.sysconf("SC_PAGE_SIZE")))


def keep_within() -> None:
    """Before numpy is loaded: use one thread where a limit leaves no room for one on each core.

    Raises:
        VolfrepError: the limit is too low for any job.
    """
    most = allowed()
    if most < LEAST:
        raise VolfrepError(
            f"There is not enough memory: this process may take {most / 1e9:.2g} GB of address "
            f"space, and {LEAST / 1e9:.2g} GB is the least that any job needs. Raise the limit "
            "('ulimit -v', or that of the batch system)."
        )
    if most < LEAST + EACH_THREAD * (threads() - 1):
        os.environ["OPENBLAS_NUM_THREADS"] = "1"
        use_threads(1)


def is_want_of_memory(error: BaseException) -> bool:
    """Whether an error says that memory, or room for a thread or a library, was not to be had."""
    if isinstance(error, MemoryError):
        return True
    thread = isinstance(error, RuntimeError) and "can't start new thread" in str(error)
    return thread or (isinstance(error, ImportError) and "failed to map" in str(error))


def not_enough() -> str:
    """What to tell of such an error, in a sentence."""
    most = allowed()
    if most == math.inf:
        return "There is not enough memory for this job: use a coarser resolution or larger cells."
    return (
        f"There is not enough memory for this job within the {most / 1e9:,.3g} GB of address space "
        "that this process may take: raise the limit ('ulimit -v', or that of the batch system), "
        "use a coarser resolution or larger cells."
    )
