# SPDX-License-Identifier: LGPL-2.1-or-later
"""Progress, cancelling, and the measure of what every stage costs.

Work is counted as well as timed (kinds of octants meshed, triangles placed and cut, bytes written):
tests compare counts, which no busy machine changes.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures import TimeoutError as FutureTimeoutError
from contextlib import contextmanager, suppress
from typing import TypeVar

from .errors import Cancelled
from .parallel import ParallelBackend

#: Called with the fraction done (0 to 1) and the name of the stage; returning ``False`` cancels.
ProgressCallback = Callable[[float, str], "bool | None"]

T = TypeVar("T")

#: How often a long call into a compiled library is interrupted to ask for a cancel, in seconds.
POLL_SECONDS = 0.2


class Monitor:
    """One run's progress: forwards to the callback, raises on cancel, times every stage.

    ``stages`` maps a stage's name to its seconds, ``memory_mb`` to the process's peak resident
    memory in MB at its end, ``work`` what was done, by its name, to how often; ``backend`` makes
    the calls that the run divides its work into.
    """

    def __init__(self, callback: ProgressCallback | None = None) -> None:
        self._callback = callback
        self._low = 0.0
        self._high = 1.0
        self._name = ""
        self._fraction = 0.0
        self.stages: dict[str, float] = {}
        self.memory_mb: dict[str, float] = {}
        self.work: dict[str, int] = {}
        self.backend = ParallelBackend()

    @contextmanager
    def stage(self, name: str, low: float, high: float) -> Iterator[Monitor]:
        """Run a stage that spans the fractions `low` to `high` of the whole job."""
        self._name, self._low, self._high = name, low, high
        start = time.perf_counter()
        self.tick(0.0)
        try:
            yield self
        finally:
            self.stages[name] = self.stages.get(name, 0.0) + time.perf_counter() - start
            self.memory_mb[name] = peak_memory_mb()

    def count(self, name: str, amount: int) -> None:
        """Note that so much more of something was done: a figure that no busy machine blurs."""
        self.work[name] = self.work.get(name, 0) + amount

    def tick(self, fraction: float | None = None) -> None:
        """Say how far the running stage is (0 to 1); raises `Cancelled` when asked to stop."""
        if fraction is not None:
            within = self._low + (self._high - self._low) * min(max(fraction, 0.0), 1.0)
            self._fraction = max(self._fraction, within)  # a step that is repeated does not fall
        if self._callback is not None and self._callback(self._fraction, self._name) is False:
            raise Cancelled(f"cancelled during {self._name}")

    def call(self, function: Callable[[], T]) -> T:
        """Run one uninterruptible call, asking for a cancel every `POLL_SECONDS`.

        The call runs on a thread of its own, so that a compiled library that releases the
        interpreter does not keep a user's Cancel waiting; on cancel its result is abandoned.
        """
        if self._callback is None:
            return function()
        pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="volfrep")
        try:
            future = pool.submit(function)
            while True:
                try:
                    return future.result(timeout=POLL_SECONDS)
                except FutureTimeoutError:
                    if future.done():  # the call itself timed out: its own error, not ours
                        raise
                    self.tick()
        finally:
            pool.shutdown(wait=False)


def release_memory() -> None:
    """Give the system back what arrays that are gone have left behind.

    glibc keeps freed pieces below 32 MB for later ones, and after many of these a third of what a
    large job holds is such; other C libraries are left alone.
    """
    if sys.platform.startswith("linux"):
        import ctypes

        trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
        if trim is not None:
            trim(ctypes.c_size_t(0))


def peak_memory_of(process: int | str) -> float:
    """Peak resident memory of a process so far, in MB (0 where Linux' /proc does not tell)."""
    with (
        suppress(OSError),
        open(f"/proc/{process}/status", encoding="utf-8", errors="replace") as file,
    ):
        for line in file:
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024.0
    return 0.0


def peak_memory_mb() -> float:
    """Peak resident memory of this process so far, in MB (0 where the system does not tell)."""
    # Of Linux: getrusage would also count the process that started this one, up to its exec.
    told = peak_memory_of("self")
    if told:
        return told
    if sys.platform == "win32":
        import ctypes

        # PROCESS_MEMORY_COUNTERS: two fields of 32 bits, the first its length, then eight of 64
        # bits, of which the first is the peak of the working set. -1 is this process.
        counters = (ctypes.c_uint64 * 9)()
        ctypes.cast(counters, ctypes.POINTER(ctypes.c_uint32))[0] = ctypes.sizeof(counters)
        is_known = ctypes.windll.kernel32.K32GetProcessMemoryInfo(
            ctypes.c_void_p(-1), ctypes.byref(counters), ctypes.sizeof(counters)
        )
        return float(counters[1]) / 2**20 if is_known else 0.0
    try:
        import resource
    except ImportError:
        return 0.0
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 1e6 if sys.platform == "darwin" else peak / 1024.0
