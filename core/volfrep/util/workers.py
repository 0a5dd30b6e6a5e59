# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who works beside this process: processes of this machine, or the workers of a Dask cluster.

Calls that hold Python's lock, such as those of the Boolean library, run side by side only there.
"""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from .errors import VolfrepError
from .threads import threads, use_threads
from .version import VERSION

#: A scheduler that does not answer within so long is not there, s.
PATIENCE = 20
#: While it works, it is asked for its workers so often, s.
ASKED_EVERY = 1.0


@contextmanager
def processes(count: int | None = None, module: str = "") -> Iterator[Executor | None]:
    """An executor of so many processes; None where that is one.

    They are new interpreters: a script that uses them needs its `if __name__ == "__main__":`.

    Args:
        count: of the processes; None for as many as `threads` says.
        module: where what they will be given lies: they start at once and import it, while this
            process does something else. Empty: they start when they are first given something.

    Raises:
        VolfrepError: fewer than one is wanted.
    """
    count = threads() if count is None else count
    if count < 1:
        raise VolfrepError(f"At least 1 worker is needed, not {count}.")
    if count == 1:
        yield None
        return
    import multiprocessing  # slow to load, as the next one is
    from concurrent.futures import ProcessPoolExecutor

    context = multiprocessing.get_context("spawn")
    each = max(1, threads() // count)
    pool = ProcessPoolExecutor(count, context, _prepared, (module, each))
    if module:
        for _ in range(count):  # each call starts one process, while none is idle
            pool.submit(int)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def let_go(executor: Executor | None) -> None:
    """End an executor's processes early, with what they hold, where it has any of this machine.

    What is still given to it is refused with a `RuntimeError`.
    """
    from concurrent.futures import ProcessPoolExecutor  # slow to load

    if isinstance(executor, ProcessPoolExecutor):
        executor.shutdown(wait=False, cancel_futures=True)


def _prepared(module: str, thread_count: int) -> None:
    """Leave Ctrl-C, which a terminal sends to all its processes, to the one that is asked.

    The cores are for the processes: threads of each would only wait for one another.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    use_threads(thread_count)
    if module:
        import_module(module)


@contextmanager
def dask_workers(address: str) -> Iterator[Executor]:
    """The executor of a Dask scheduler; needs the package distributed.

    Dask gives what a lost worker was doing to another one; where there is none, see `Watch`.

    Args:
        address: of the scheduler, such as tcp://HOST:8786.

    Raises:
        VolfrepError: the package is missing, nobody answers, there is no worker, or one has
            another version of this package.
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise VolfrepError(
            "A scheduler needs the package distributed, which is not installed: run "
            "'pip install volfrep[dask]'."
        ) from error
    try:
        client = Client(address, timeout=PATIENCE)
    except (OSError, ValueError, TimeoutError) as error:
        raise VolfrepError(
            f"No Dask scheduler answers at '{address}': start 'dask scheduler', or correct the "
            "address."
        ) from error
    with client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError as error:
            raise VolfrepError(
                f"The Dask scheduler at '{address}' has no worker: start 'dask worker {address}'."
            ) from error
        _refuse_other_versions(client)
        executor = client.get_executor(pure=False)
        # As the standard library's executors know it of themselves: see `at_once`.
        executor._max_workers = sum(client.nthreads().values())
        yield executor


class Watch:
    """Sees that an executor still has workers, where those can leave: of a Dask cluster."""

    def __init__(self, executor: Executor | None) -> None:
        self._client: Any = getattr(executor, "_client", None)
        self._seen = self._asked = time.monotonic()

    def __call__(self) -> None:
        """Called again and again while waiting; asks the scheduler every `ASKED_EVERY` seconds.

        Raises:
            VolfrepError: since `PATIENCE` seconds there is no worker, or no scheduler.
        """
        now = time.monotonic()
        if self._client is None or now < self._asked + ASKED_EVERY:
            return
        self._asked = now
        try:
            some = bool(self._client.nthreads())
        except (OSError, TimeoutError):  # the scheduler has gone
            some = False
        if some:
            self._seen = now
        elif now > self._seen + PATIENCE:
            raise VolfrepError(
                f"The Dask scheduler has had no worker for {PATIENCE:g} s: the last one has ended, "
                "as for want of memory. Start 'dask worker' anew, and run this again."
            )


def _refuse_other_versions(client: Any) -> None:
    """Raise a `VolfrepError` where a worker would compute something else than this process."""
    for worker, found in client.run(version, on_error="return").items():
        if found != VERSION:
            has = found if isinstance(found, str) else f"none that it can import ({found})"
            raise VolfrepError(
                f"The Dask worker at '{worker}' has another VOLFREP than this one, {VERSION}: "
                f"{has}. Install the same on every worker."
            )


def version() -> str:
    """The version of this package, as a worker has it."""
    return VERSION


def at_once(executor: Executor) -> int:
    """How many calls an executor runs side by side, where it tells; else as `threads` says."""
    return int(getattr(executor, "_max_workers", 0)) or threads()
