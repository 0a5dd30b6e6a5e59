# SPDX-License-Identifier: LGPL-2.1-or-later
"""A worker that starts before it is known how many a job is worth.

What it imports takes it as long as this process takes to prove a part and to foretell what comes of
it: it is there when there is something to do, and not only asked to start then.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

from ..util.threads import threads
from .worker import Program, Worker, this_python


class HeadStart:
    """One of as many processes as there are cores; none where there is only one.

    Args:
        modules: as of `pool.processes`.
    """

    def __init__(self, modules: Sequence[str]) -> None:
        self._modules = modules
        self._program: Program | None = None
        self._worker: Worker | None = None

    def begin(self) -> None:
        """Start it. What stands in the way is told where a pool starts its own."""
        if threads() > 1 and self._worker is None:
            self._program = this_python(1, *self._modules)
            with suppress(OSError):
                self._worker = Worker(self._program)

    def taken(self, program: Program) -> Worker | None:
        """It, which is the caller's now; None where it is another program, or there is none."""
        if program != self._program:
            return None
        worker, self._worker = self._worker, None
        return worker

    def end(self) -> None:
        """End it, unless it was taken."""
        worker, self._worker = self._worker, None
        if worker is not None:
            worker.kill()
            worker.end()
