# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workers of a Dask cluster: found, asked for their version, and watched."""

from __future__ import annotations

import time
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Any

from ..util.errors import VolfrepError
from ..util.packages import package
from ..util.version import VERSION

#: A scheduler that does not answer within so long is not there, s.
PATIENCE = 20
#: While it works, it is asked for its workers so often, s.
ASKED_EVERY = 1.0


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
    library = package("distributed", "A scheduler")
    try:
        client = library.Client(address, timeout=PATIENCE)
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
        # As the standard library's executors know it of themselves: see `pool.at_once`.
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
