# SPDX-License-Identifier: LGPL-2.1-or-later
"""A process that this one has started: what it may take, how it is ended, and how it has ended.

Nothing that is started outlives who started it, however that ends. A Python of the engine sees its
pipe close. A program knows of no pipe: on POSIX systems a shell beside it does, and ends it with
all that it has started. Windows has no such shell: there `kill` ends a program with all of its
own, but one goes on where this process is ended by force.
"""

from __future__ import annotations

import math
import os
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TypeVar

from ..util.packages import package
from ..util.progress import POLL_SECONDS
from ..util.threads import MATRIX_THREADS

T = TypeVar("T")

#: For `subprocess`: a program of the console opens no window of its own on Windows.
NO_WINDOW: int = getattr(subprocess, "CREATE_NO_WINDOW", 0)
#: A program with a shell of its session that waits for the end of standard input, and then ends
#: the session. It is no child of the program's, which may wait for its children.
_SHELL = 'exec 3<&0 </dev/null; ((read -r _ <&3; kill -9 0) >/dev/null 2>&1 &); exec "$@" 3<&-'
#: Before it: at so many seconds of a processor the system ends the program, without a core file; a
#: lower limit of the user stays.
_LIMIT = "{{ ulimit -S -c 0; ulimit -S -t {}; }} 2>/dev/null; "
_IS_WINDOWS = os.name == "nt"


@dataclass(frozen=True)
class Limits:
    """What a process may take.

    Attributes:
        seconds: of time, for a call or a program's run; None for no limit.
        processor_seconds: for a program's run, however many others there are beside it; None for
            no limit. Windows has no such limit.
        memory_gb: of resident memory; None for no limit.
        threads: for it to use; 0 for one on each core.
    """

    seconds: float | None = None
    memory_gb: float | None = None
    threads: int = 0
    processor_seconds: float | None = None

    @property
    def any(self) -> bool:
        """Whether the process must be watched."""
        return self.seconds is not None or self.memory_gb is not None

    def environment(self) -> dict[str, str]:
        """Variables that say how many threads to use; none where all may be used."""
        return dict.fromkeys(MATRIX_THREADS, str(self.threads)) if self.threads else {}


NO_LIMITS = Limits()


class OverLimit(Exception):
    """A process took more than its limits, and was ended.

    `what` is "time", "processor time" or "memory".
    """

    def __init__(self, what: str) -> None:
        super().__init__(what)
        self.what = what


class Child:
    """A process, from its start to its end.

    Args:
        command: the program and its arguments.
        limits: the threads that it is told, and its processor seconds where it does not speak;
            `guarded` sees to time and memory.
        folder: where it runs; None for where this process does.
        environment: its variables; None for this process's.
        speaks: whether this process writes to its standard input, and it ends when that closes.
        errors: its standard error, as `subprocess` takes it.

    Raises:
        OSError: the program cannot be started.
    """

    def __init__(
        self,
        command: Sequence[str],
        *,
        limits: Limits = NO_LIMITS,
        folder: Path | None = None,
        environment: Mapping[str, str] | None = None,
        speaks: bool = False,
        errors: int | IO[bytes] = subprocess.STDOUT,
    ) -> None:
        shell = not speaks and not _IS_WINDOWS
        most = limits.processor_seconds
        script = _SHELL if most is None else _LIMIT.format(math.ceil(most)) + _SHELL
        variables = os.environ if environment is None else environment
        self._process = subprocess.Popen(
            ["/bin/sh", "-c", script, "volfrep", *command] if shell else list(command),
            cwd=folder,
            env={**variables, **limits.environment()},
            stdin=subprocess.PIPE if speaks or shell else subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=errors,
            creationflags=NO_WINDOW,
            start_new_session=not _IS_WINDOWS,
        )
        self._is_killed = False
        #: Kept apart from `subprocess`, which would close it while it waits for an answer.
        self.input, self._process.stdin = self._process.stdin, None

    @property
    def number(self) -> int:
        """The system's of the process."""
        return self._process.pid

    @property
    def output(self) -> IO[bytes]:
        """What it says."""
        assert self._process.stdout is not None
        return self._process.stdout

    @property
    def is_alive(self) -> bool:
        """Whether it has not ended, and nobody has ended it."""
        return not self._is_killed and self._process.poll() is None

    def said(self) -> bytes:
        """All that it says until it ends."""
        return self._process.communicate()[0]

    def guarded(
        self, read: Callable[[], T], limits: Limits, ask: Callable[[], object] | None = None
    ) -> T:
        """What `read` returns, which waits for this process; that is ended where it must be.

        Args:
            read: runs on another thread if there is anything to look at meanwhile.
            limits: of time, from now on, and of memory.
            ask: called again and again on this thread; what it raises ends the process.

        Raises:
            OverLimit: it took more than its limits.
            VolfrepError: it cannot be told here how much memory it takes.
        """
        if ask is None and not limits.any:
            return read()
        end = None if limits.seconds is None else time.monotonic() + limits.seconds
        pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="volfrep")
        try:
            future = pool.submit(read)
            while not future.done():
                left = math.inf if end is None else max(0.0, end - time.monotonic())
                wait([future], min(POLL_SECONDS, left))
                if end is not None and time.monotonic() >= end and not future.done():
                    raise OverLimit("time")
                if limits.memory_gb is not None and resident_gb(self.number) > limits.memory_gb:
                    raise OverLimit("memory")
                if ask is not None:
                    ask()
        except BaseException:
            self.kill()
            raise
        finally:
            pool.shutdown(wait=False)
        return future.result()

    def kill(self) -> None:
        """End it at once, with what it has started."""
        if _IS_WINDOWS and self.is_alive:
            command = ["taskkill", "/F", "/T", "/PID", str(self.number)]
            subprocess.run(command, capture_output=True, creationflags=NO_WINDOW, check=False)
        self._is_killed = True
        self._process.kill()
        self._let_go()

    def wait(self, patience: float | None = None) -> tuple[int, bool]:
        """The code with which it has ended, and whether by itself, within so many seconds."""
        by_itself = True
        try:
            code = self._process.wait(patience)
        except subprocess.TimeoutExpired:
            by_itself = False
            self.kill()
            code = self._process.wait()
        self._let_go()
        return code, by_itself

    def disown(self) -> None:
        """In a process forked from the one whose child it is: do not keep it from ending."""
        self._let_go()

    def _let_go(self) -> None:
        """Close what it listens to, so that those that it has started end as well."""
        if self.input is not None:
            with suppress(OSError):  # what was still to be sent has no reader any more
                self.input.close()


def how_ended(code: int) -> str:
    """In words.

    >>> how_ended(-9), how_ended(3)
    ('by signal 9', 'with code 3')
    """
    return f"by signal {-code}" if code < 0 else f"with code {code}"


def resident_gb(process: int) -> float:
    """The resident memory of a process, GB; 0 for one that has ended.

    Raises:
        VolfrepError: it cannot be told here.
    """
    if Path("/proc/self/statm").exists():
        try:
            pages = Path(f"/proc/{process}/statm").read_text().split()[1]
            return int(pages) * os.sysconf("SC_PAGE_SIZE") / 1e9
        except (OSError, IndexError):  # it has ended meanwhile
            return 0.0
    psutil = package("psutil", "A limit of memory", then="or leave the limit out")
    try:
        return float(psutil.Process(process).memory_info().rss) / 1e9
    except psutil.NoSuchProcess:
        return 0.0
