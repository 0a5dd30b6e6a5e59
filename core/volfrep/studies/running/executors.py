# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who runs the batches: this process, processes beside it, or any `concurrent.futures.Executor`."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field, replace
from typing import Any

from ...design.memory_guard import free_memory
from ...process.cluster import Watch
from ...util.errors import Cancelled, VolfrepError
from ...util.progress import ProgressCallback
from ...util.threads import threads
from ...util.version import VERSION
from .batches import Batch, Ended, note
from .child import run_in_child
from .runs import run_in_turn

#: How often the caller is told how far the runs are, s.
TELL = 0.5
#: The share of the free memory that the runs may take together.
SHARE = 0.8
#: How far runs are.
STATE = "{done} of {runs} runs, about {time} left"


#: Says how far runs are, of how many are done, how many there are, and the seconds left.
Words = Callable[[int, int, float], str]


@dataclass
class Tally:
    """How far a study is; told by forecasts, corrected by what the runs before have taken.

    Attributes:
        weights: expected seconds of each run that is to be done, by its key.
        workers: side by side.
        progress: called with the fraction done, and runs and time left in words.
        words: of runs done, all of them, and seconds left.
    """

    weights: dict[str, float]
    workers: int
    progress: ProgressCallback | None
    words: Words
    _ended: set[str] = field(default_factory=set)
    _start: float = field(default_factory=time.monotonic)
    _cancelled: threading.Event = field(default_factory=threading.Event)

    def ended(self, key: str) -> None:
        """Note a run's end."""
        self._ended.add(key)

    def goes_on(self, fraction: float = 0.0, stage: str = "") -> bool:
        """A progress callback of a single run: False once the study is cancelled."""
        return not self._cancelled.is_set()

    def cancel(self) -> None:
        """From now on every run is told to stop."""
        self._cancelled.set()

    def tell(self) -> bool:
        """Say how far the study is; False when the caller says to stop."""
        if self.progress is not None and self.progress(self.fraction, self.text) is False:
            self.cancel()
        return self.goes_on()

    @property
    def fraction(self) -> float:
        """Done, of the expected time."""
        total = sum(self.weights.values())
        return self._done / total if total else 1.0

    @property
    def text(self) -> str:
        """Runs done, and the time left."""
        left = sum(self.weights.values()) - self._done
        seconds = left / self.workers
        if self._done > 0.0:
            seconds = left * (time.monotonic() - self._start) / self._done
        return self.words(len(self._ended), len(self.weights), seconds)

    @property
    def _done(self) -> float:
        return sum(self.weights[key] for key in tuple(self._ended))


def state_text(done: int, runs: int, seconds: float, text: str = STATE) -> str:
    """How far runs are, in the words of a text that holds {done}, {runs} and {time}."""
    return text.format(done=f"{done:,}", runs=f"{runs:,}", time=time_text(seconds))


def time_text(seconds: float) -> str:
    """A time with its unit, to be read.

    >>> time_text(89), time_text(1200), time_text(5400)
    ('89 s', '20 min', '1.5 h')
    """
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


def fitting_workers(memory_gb: float, wanted: int | None) -> int:
    """How many runs of so much memory each fit side by side; at most one a core.

    Args:
        memory_gb: of the largest run, as forecast.
        wanted: taken as it is; None for as many as fit.

    Raises:
        VolfrepError: fewer than one is wanted.
    """
    if wanted is not None:
        if wanted < 1:
            raise VolfrepError(f"At least 1 worker is needed, not {wanted}.")
        return wanted
    fit = int(SHARE * free_memory() / (1e9 * max(memory_gb, 1e-3)))
    return max(1, min(threads(), fit))


def run_batch(
    batch: Batch, ended: Ended | None = None, progress: ProgressCallback | None = None
) -> int:
    """Do the runs of a batch; what is in the records already is not done again.

    Args:
        batch: what to do.
        ended: called after each run.
        progress: called while a run goes on; returning False cancels.

    Returns:
        How many designs there were.

    Raises:
        VolfrepError: this worker has another version of the engine, does not see the study's
            folder, or cannot tell how much memory a run takes.
        Cancelled: the callback said so; the run that was going on leaves no record.
    """
    if batch.version != VERSION:
        raise VolfrepError(
            f"The study was begun with VOLFREP {batch.version}, and this worker has {VERSION}: "
            "install the same version."
        )
    if batch.apart or batch.limits.any:
        run_in_child((batch,), ended, progress)
    else:
        run_in_turn((batch,), ended, progress)
    return len(batch.designs)


def run_here(batches: Sequence[Batch], tally: Tally) -> None:
    """Run batches in this process, one after the other.

    Raises:
        Cancelled: the caller said so.
    """

    def ask(_: float = 0.0, __: str = "") -> bool:
        return tally.tell()

    limited = any(batch.limits.any for batch in batches)
    (run_in_child if limited else run_in_turn)(_asking(batches, ask), tally.ended, ask)
    tally.tell()


def run_in_background(batches: Sequence[Batch], tally: Tally) -> None:
    """Run batches in as many processes as the tally has workers.

    Raises:
        Cancelled: the caller said so; the processes have been ended.
    """
    left = deque(batches)
    with ThreadPoolExecutor(tally.workers, "volfrep-study") as pool:
        try:
            futures = [
                pool.submit(run_in_child, _take_batches(left), tally.ended, tally.goes_on)
                for _ in range(tally.workers)
            ]
            _wait(futures, tally)
            for future in futures:
                future.result()
        except BaseException:  # cancelled, interrupted, or a folder that is gone: all runs stop
            tally.cancel()
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _asking(batches: Sequence[Batch], ask: Callable[[], bool]) -> Iterator[Batch]:
    """Batches in turn, as long as the caller wants more."""
    for batch in batches:
        if not ask():
            raise Cancelled("the study was cancelled")
        yield batch


def _take_batches(batches: deque[Batch]) -> Iterator[Batch]:
    """Batches that nobody else has taken, until there are none."""
    while True:
        try:
            yield batches.popleft()
        except IndexError:
            return


def run_by(executor: Executor, batches: Sequence[Batch], tally: Tally) -> None:
    """Run batches by any executor; what its workers cannot do is noted in the records.

    Raises:
        VolfrepError: the executor takes nothing more, or a worker cannot use the study's folder.
        Cancelled: the caller said so; runs that have begun go on.
    """
    lost = _submit(executor, batches, tally)
    # Alone, a run that ends its worker takes no other one with it.
    single = [replace(b, designs=(d,)) for b, _ in lost for d in b.designs]
    for batch, error in _submit(executor, single, tally):
        why = f"The worker of this run was lost ({type(error).__name__}: {error})."
        note(batch, batch.designs[0], why)


def _submit(
    executor: Executor, batches: Sequence[Batch], tally: Tally
) -> list[tuple[Batch, BaseException]]:
    """Run batches; those whose workers were lost, with why."""
    futures: list[Future[int]] = []

    def count(batch: Batch) -> Callable[[Future[int]], None]:
        def ended(future: Future[int]) -> None:
            if not future.cancelled() and future.exception() is None:
                for design in batch.designs:
                    tally.ended(design.key)

        return ended

    try:
        for batch in batches:
            future = executor.submit(run_batch, batch)
            future.add_done_callback(count(batch))
            futures.append(future)
    except RuntimeError as error:  # BrokenExecutor is one
        raise VolfrepError(
            f"The executor takes no more runs ({error}): start it anew; what is done is kept."
        ) from error
    try:
        _wait(futures, tally, Watch(executor))
    except BaseException:
        for future in futures:
            future.cancel()
        raise
    lost = []
    for batch, future in zip(batches, futures, strict=True):
        why = future.exception()
        if isinstance(why, VolfrepError):
            raise why
        if why is not None:
            lost.append((batch, why))
    return lost


def _wait(
    futures: Sequence[Future[Any]], tally: Tally, watch: Callable[[], None] = lambda: None
) -> None:
    pending: set[Future[Any]] = set(futures)
    while pending:
        watch()
        if not tally.tell():
            raise Cancelled("the study was cancelled")
        finished, pending = wait(pending, timeout=TELL)
        for future in finished:
            if isinstance(future.exception(), VolfrepError):
                future.result()
    tally.tell()
