# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers that stay for the next job of a process that makes one after the other.

They end with that process, however it ends, for their pipes close (`child`); with a job that fails
or is cancelled, as what they do is not wanted any more; and once nobody has needed them for a
while, as they hold memory.
"""

from __future__ import annotations

import atexit
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from ..util.threads import threads
from .pool import WorkerPool, let_go, pool_of
from .worker import Ending, has_python

#: Workers that nobody needs for so long, s, are let go.
IDLE_SECONDS = 120.0


class KeptPool:
    """A pool of workers that one job after the other is lent.

    Args:
        modules: as of `processes`.
    """

    def __init__(self, modules: Sequence[str]) -> None:
        self._modules = modules
        self._changing = threading.Lock()
        self._kept: tuple[int, int, WorkerPool] | None = None
        self._timer: threading.Timer | None = None
        atexit.register(self.end)
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_child=self._forked)

    @contextmanager
    def lent(
        self, count: int, lost: Callable[[Ending], None] = lambda _: None
    ) -> Iterator[WorkerPool | None]:
        """So many processes for a job, with this one among them where they are few.

        Those that are kept serve where they are at least half as many. None where one is enough,
        or where no Python is known that could be another one.

        Args:
            count: of the processes.
            lost: told, on any thread, how a worker has ended that should not have.
        """
        if count < 2 or not has_python():
            yield None
            return
        most, size, pool = self._taken(count, lost)
        try:
            yield pool
        except BaseException:
            let_go(pool)
            raise
        self._give_back(most, size, pool)

    def end(self) -> None:
        """Let go of workers that no job is lent."""
        with self._changing:
            self._end()

    def _taken(self, count: int, lost: Callable[[Ending], None]) -> tuple[int, int, WorkerPool]:
        with self._changing:
            self._stop_timer()
            kept, self._kept = self._kept, None
            if kept is not None:
                most, size, pool = kept
                if pool.is_sound and most == threads() and 2 * size >= count:
                    pool.lost = lost
                    return kept
                let_go(pool)
        new = pool_of(count, self._modules, lost, with_this=True)
        assert new is not None
        return threads(), count, new

    def _give_back(self, most: int, size: int, pool: WorkerPool) -> None:
        """Keep a pool for the next job, in place of one that waits: jobs may overlap."""
        with self._changing:
            self._end()
            self._kept = most, size, pool
            self._timer = threading.Timer(IDLE_SECONDS, self.end)
            self._timer.daemon = True
            self._timer.start()

    def _end(self) -> None:
        self._stop_timer()
        if self._kept is not None:
            let_go(self._kept[-1])
        self._kept = None

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None

    def _forked(self) -> None:
        """In a process that was forked from this one: the workers are that one's."""
        self._changing, self._timer = threading.Lock(), None
        if self._kept is not None:
            self._kept[-1].disown()
        self._kept = None
