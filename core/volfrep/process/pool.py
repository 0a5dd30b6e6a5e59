# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers of this machine that make calls side by side.

Calls that hold Python's lock, such as those of the Boolean library, run side by side only there.
"""

from __future__ import annotations

import itertools
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from queue import PriorityQueue
from typing import Any, TypeVar

from ..util.errors import VolfrepError
from ..util.parallel import ParallelBackend
from ..util.progress import POLL_SECONDS, Monitor, peak_memory_of
from ..util.threads import threads
from .head_start import HeadStart
from .worker import Call, Ending, Program, Worker, WorkerLost, this_python

T = TypeVar("T")

#: This process makes calls beside its workers up to so many processes. To take in what a worker has
#: cut takes it about a twentieth of what the cut takes, so that of 16 it would be late for most,
#: and while it cuts itself Python's lock comes three times as late (1 ms, not 0.3, on average).
FEW = 4
#: After so many have ended there is something wrong with all of them, and no other one is started.
MOST_LOST = 8


class _ThisProcess:
    """Makes calls in the place of a worker."""

    def answer(self, call: Call) -> Any:
        """As a worker does."""
        return call.here()


class WorkerPool(ThreadPoolExecutor):
    """An executor of workers. One that dies costs its call, and another one takes its place.

    Args:
        program: what the workers are.
        count: how many; those of a program that is to be warm start now, while this process does
            something else, others when they are needed.
        lost: called, on any thread, with how a worker has ended that should not have.
        with_this: this process makes calls as well, on a thread, where no worker is idle. The
            workers start now.
        first: one that has started already; None for none.
    """

    def __init__(
        self,
        program: Program,
        count: int,
        lost: Callable[[Ending], None] = lambda _: None,
        *,
        with_this: bool = False,
        first: Worker | None = None,
    ) -> None:
        super().__init__(count + with_this, "volfrep-worker")
        self._first = first
        self._program, self.lost, self._losses = program, lost, 0
        self._changing = threading.Lock()
        self._is_open = True
        self._memory_mb = 0.0
        self.workers: list[Worker] = []
        self._idle: PriorityQueue[tuple[bool, int, Worker | _ThisProcess | None]] = PriorityQueue()
        self._turn = itertools.count()
        start_now = bool(program.warm) or with_this
        self._waiting: list[tuple[Future[Any], Call]] | None = [] if count and start_now else None
        for _ in range(count):
            if start_now:  # on a thread, and this one goes on
                super().submit(self._greeted)
            else:
                self._rests(None)
        if with_this:
            self._rests(_ThisProcess())

    @property
    def is_open(self) -> bool:
        """Whether it still takes calls."""
        return self._is_open

    @property
    def is_sound(self) -> bool:
        """Whether it takes calls, and no worker has ended that should not have."""
        return self._is_open and not self._losses

    @property
    def memory_mb(self) -> float:
        """Peak resident memory of its workers together, MB; 0 where the system does not tell."""
        if self._is_open:
            self._memory_mb = sum(peak_memory_of(each.number) for each in self.workers)
        return self._memory_mb

    def submit(self, function: Callable[..., Any], /, *given: Any, **named: Any) -> Future[Any]:
        """As of any executor; the call fails with `WorkerLost` where its worker ends.

        Raises:
            RuntimeError: it is shut down, or too many workers have ended.
        """
        if self._losses >= MOST_LOST:
            raise BrokenExecutor("its workers end again and again")
        return super().submit(self._made, Call(function, given, named, has_progress=False))

    def elsewhere(self, function: Callable[..., T], *given: Any) -> Future[T]:
        """As `submit`, but no worker that starts is overtaken by this process.

        The first one that is ready makes the call before all others; until then it can be
        cancelled.
        """
        with self._changing:
            if self._waiting is not None:
                future: Future[T] = Future()
                self._waiting.append((future, Call(function, given, has_progress=False)))
                return future
        return self.submit(function, *given)

    def _greeted(self) -> None:
        """Start a worker; the first one that is ready makes what waits for one."""
        worker: Worker | None = None
        try:
            worker = self._started()
            worker.greets()
        except WorkerLost as lost:
            self._tell(lost)
        with self._changing:
            waiting, self._waiting = self._waiting or [], None
        for future, call in waiting:
            if future.set_running_or_notify_cancel():
                try:
                    worker = worker or self._started()
                    future.set_result(worker.answer(call))
                except Exception as error:
                    future.set_exception(error)  # one that is lost is told with its next call
        self._rests(worker)

    def _rests(self, worker: Worker | _ThisProcess | None) -> None:
        """Keep one for the next call: this process comes last."""
        self._idle.put((isinstance(worker, _ThisProcess), next(self._turn), worker))

    def _made(self, call: Call) -> Any:
        worker = self._idle.get()[-1]  # there are as many as threads
        try:
            if worker is None:
                worker = self._started()
            return worker.answer(call)
        except WorkerLost as lost:
            worker = None
            self._tell(lost)
            raise
        finally:
            self._rests(worker)

    def _tell(self, lost: WorkerLost) -> None:
        """Tell of one that has ended, unless that was wanted, or too many have."""
        if self._is_open and self._losses < MOST_LOST:
            with self._changing:
                self._losses += 1
            self.lost(lost.ending)

    def _started(self) -> Worker:
        with self._changing:
            if not self._is_open or self._losses >= MOST_LOST:
                raise WorkerLost(Ending("before it began"))
            try:
                worker, self._first = self._first or Worker(self._program), None
            except OSError as error:
                raise WorkerLost(Ending("before it began", str(error))) from error
            self.workers.append(worker)
            return worker

    def disown(self) -> None:
        """In a process forked from the one whose it is: that one sees to the workers' end."""
        for worker in self.workers:
            worker.disown()

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Take nothing more; with `cancel_futures` the workers end, whatever they do."""
        if cancel_futures:
            with self._changing:
                self._memory_mb = self.memory_mb
                self._is_open = False
            for worker in self.workers:
                worker.kill()
        super().shutdown(wait=wait, cancel_futures=cancel_futures)
        if wait or cancel_futures:
            for worker in self.workers:
                worker.end()


@contextmanager
def processes(
    count: int | None = None,
    modules: Sequence[str] = (),
    lost: Callable[[Ending], None] = lambda _: None,
    *,
    with_this: bool = False,
    first: HeadStart | None = None,
) -> Iterator[Executor | None]:
    """An executor of so many processes; None where that is one.

    Args:
        count: of the processes; None for as many as `threads` says.
        modules: where what they will be given lies: they import them at once, while this process
            does something else. Empty: they import them when they are first given something.
        lost: told, on any thread, how a process has ended that should not have.
        with_this: as of `pool_of`.
        first: as of `pool_of`.

    Raises:
        VolfrepError: fewer than one is wanted.
    """
    count = threads() if count is None else count
    pool = pool_of(count, modules, lost, with_this=with_this, first=first)
    try:
        yield pool
    finally:
        if pool is not None:
            pool.shutdown(cancel_futures=True)


def pool_of(
    count: int,
    modules: Sequence[str],
    lost: Callable[[Ending], None],
    *,
    with_this: bool = False,
    first: HeadStart | None = None,
) -> WorkerPool | None:
    """So many processes, as of `processes`, which are not ended; None where that is one.

    Args:
        count: of the processes.
        modules: as of `processes`.
        lost: as of `processes`.
        with_this: where they are few this process is one of them, so that one less is started.
        first: what may have started one of them already.

    Raises:
        VolfrepError: as `processes`.
    """
    if count < 1:
        raise VolfrepError(f"At least 1 worker is needed, not {count}.")
    if count == 1:
        return None
    with_this = with_this and count <= FEW
    program = this_python(max(1, threads() // count), *modules)
    worker = first.taken(program) if first is not None else None
    return WorkerPool(program, count - with_this, lost, with_this=with_this, first=worker)


def on_this_machine(executor: Executor | None) -> WorkerPool | None:
    """An executor of processes of this machine, which see its files; None for any other one.

    And once they are let go.
    """
    return executor if isinstance(executor, WorkerPool) and executor.is_open else None


class WorkerBackend(ParallelBackend):
    """Workers of this machine, as long as they are not let go."""

    def __init__(self, executor: WorkerPool) -> None:
        self._executor = executor

    @property
    def uses_processes(self) -> bool:
        """As of any backend."""
        return self._executor.is_open

    @property
    def memory_mb(self) -> float:
        """As of any backend, those that were let go among them."""
        return self._executor.memory_mb

    def starmap(self, function: Callable[..., T], given: Iterable[tuple[Any, ...]]) -> Iterator[T]:
        """As of any backend, a few calls ahead; what a worker was lost with is made here."""
        if not self.uses_processes:
            yield from super().starmap(function, given)
            return
        executor = self._executor
        waiting: deque[tuple[tuple[Any, ...], Future[T] | None]] = deque()

        def first() -> T:
            each, future = waiting.popleft()
            if future is None or future.cancelled() or future.exception() is not None:
                return function(*each)  # what is wrong with the call itself shows again
            return future.result()

        for each in given:
            try:
                waiting.append((each, executor.submit(function, *each)))
            except RuntimeError:  # it takes nothing more, as when its processes were killed
                waiting.append((each, None))
            if len(waiting) > 2 * at_once(executor):
                yield first()
        while waiting:
            yield first()

    def begun(self, function: Callable[..., T], *given: Any) -> Callable[[], T]:
        """As of any backend; what a worker was lost with is made here."""
        try:
            future = self._executor.submit(function, *given)
        except RuntimeError:  # as in `starmap`
            return super().begun(function, *given)

        def made() -> T:
            is_lost = future.cancelled() or future.exception() is not None
            return function(*given) if is_lost else future.result()

        return made


def backend_of(executor: Executor | None) -> ParallelBackend:
    """An executor's processes of this machine; threads for any other."""
    return WorkerBackend(executor) if isinstance(executor, WorkerPool) else ParallelBackend()


def let_go(executor: Executor | None) -> None:
    """End an executor's processes early, with what they hold, where it has any of this machine.

    What is still given to it is refused with a `RuntimeError`.
    """
    if isinstance(executor, WorkerPool):
        executor.shutdown(wait=False, cancel_futures=True)


def awaited(future: Future[T], watch: Callable[[], object], monitor: Monitor) -> T | None:
    """What a worker made; None where it failed or was lost. A cancel does not wait.

    Args:
        future: of an executor.
        watch: called again and again while it is waited for.
        monitor: for cancel.
    """
    while not future.done():
        wait([future], POLL_SECONDS)
        watch()
        monitor.tick()
    return None if future.cancelled() or future.exception() is not None else future.result()


def at_once(executor: Executor) -> int:
    """How many calls an executor runs side by side, where it tells; else as `threads` says."""
    return int(getattr(executor, "_max_workers", 0)) or threads()
