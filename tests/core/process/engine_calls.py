# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of the engine's process let it do."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from volfrep.process.kept_pool import KeptPool
from volfrep.process.programs import run_program
from volfrep.util.cache import StageCache
from volfrep.util.errors import Cancelled, VolfrepError

#: After so long nobody is there any more, s.
AT_MOST = 600.0


def same(value: Any) -> Any:
    """What it is given."""
    return value


def has_imported(module: str) -> bool:
    """Whether this process has a module."""
    return module in sys.modules


def note(cache: StageCache, word: str) -> list[str]:
    """The words that were noted in a cache so far."""
    words: list[str] = cache.run("words", list).value
    words.append(word)
    return words


def note_late(cache: StageCache, word: str, path: str) -> list[str]:
    """The same, once there is a file."""
    while not Path(path).exists():
        time.sleep(0.01)
    return note(cache, word)


def tell(
    times: int, *, progress: Callable[[float, str], bool], watch: Callable[[int, str], bool]
) -> int:
    """Tell steps and progress."""
    for step in range(times):
        watch(step, "step")
    progress(0.5, "telling")
    return times


def refuse(sentence: str) -> None:
    """Fail as the engine does."""
    raise VolfrepError(sentence)


def wait_for_a_cancel(*, progress: Callable[[float, str], bool]) -> None:
    """A call that asks whether it is still wanted."""
    _until_cancelled(progress)
    raise Cancelled("as asked")


def best_so_far(*, progress: Callable[[float, str], bool]) -> str:
    """A call that has something to give after a cancel."""
    _until_cancelled(progress)
    return "the best"


def hold(seconds: float, *, progress: Callable[[float, str], bool]) -> None:
    """A call that asks nobody."""
    progress(0.0, "begun")
    time.sleep(seconds)


def leave(sentence: str, code: int) -> None:
    """End the process, as a crash of a library does."""
    print(sentence, file=sys.stderr, flush=True)
    os._exit(code)


def _until_cancelled(progress: Callable[[float, str], bool]) -> None:
    end = time.monotonic() + AT_MOST
    while progress(0.0, "begun") and time.monotonic() < end:
        time.sleep(0.01)


def run_a_program(told: str) -> None:
    """Run a program that never ends, and leave its number and a temporary folder in a file."""
    folder = tempfile.mkdtemp()
    code = (
        f"import os, time; open({told!r}, 'w').write(f'{{os.getpid()}} {folder}.'); time.sleep(600)"
    )
    run_program([sys.executable, "-c", code], Path(folder))


def take_memory(bytes_wanted: int) -> None:
    """Hold so much memory, and ask nobody."""
    held = bytearray(bytes_wanted)
    for at in range(0, bytes_wanted, 4096):
        held[at] = 1
    time.sleep(AT_MOST)


def write_beside(text: str, name: str) -> tuple[str, str]:
    """Write a file into a folder for temporary files; its text as read again, and where it is."""
    path = Path(tempfile.mkdtemp()) / name
    path.write_text(text, encoding="utf-8")
    return path.read_text(encoding="utf-8"), str(path)


def number_after(seconds: float) -> int:
    """The process's number, after so long."""
    time.sleep(seconds)
    return os.getpid()


def sleep(seconds: float) -> None:
    """Do nothing so long."""
    time.sleep(seconds)


def number_of_kept(told: str, *, progress: Callable[[float, str], bool]) -> None:
    """Keep a worker in this process, leave its number and its folder in a file, and wait."""
    kept = KeptPool(())
    with kept.lent(2) as workers:
        assert workers is not None
        beside = workers.elsewhere(os.getpid).result()
        Path(told).write_text(f"{beside} {workers.workers[0]._folder}.")
    hold(AT_MOST, progress=progress)
