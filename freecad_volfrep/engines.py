# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the window's jobs run: in a Python beside FreeCAD, in FreeCAD without windows, or here."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import FreeCAD as App

from .compat import package_folder
from .deps import PACKAGES, find_home, python_executable
from .preferences import THREADS, read

if TYPE_CHECKING:
    from volfrep.process.engines import Engines
    from volfrep.process.worker import Program

#: What the process imports before it is given anything to do.
_WARM = ("volfrep.jobs.pipeline",)
_CONSOLES = ("freecadcmd", "FreeCADCmd")
_running: dict[int, Engines] = {}
_freecads: list[Engines] = []


def engines() -> Engines:
    """The processes for jobs, which use as many threads as is preferred now."""
    from volfrep.process.engines import Engines

    threads = read(THREADS)
    if threads not in _running:
        for others in _running.values():
            others.end()
        _running.clear()
        _running[threads] = Engines(programs(threads), _missed)
    return _running[threads]


def freecads() -> Engines:
    """The processes for jobs that need OpenCASCADE: FreeCAD without windows."""
    from volfrep.process.engines import Engines

    if not _freecads:
        console = _freecad(read(THREADS))
        _freecads.append(Engines([] if console is None else [console], _missed))
    return _freecads[0]


def programs(threads: int) -> list[Program]:
    """What can run the engine beside this FreeCAD, the best first."""
    found = [python_program(threads)]
    console = _freecad(threads)
    return found if console is None else [*found, console]


def python_program(threads: int) -> Program:
    """The Python beside this FreeCAD, as a program that runs the engine."""
    from volfrep.process.worker import Program

    front = find_home("volfrep.process")
    assert front is not None
    command = (python_executable(),)
    return Program(command, (front,), _package_folders(), warm=_WARM, threads=threads)


def _freecad(threads: int) -> Program | None:
    """FreeCAD without windows as a program that runs the engine and the workbench."""
    from volfrep.process.worker import Program

    console = _console()
    if console is None:
        return None
    # It has its own folders; of the workbench it needs what mends them.
    whole = "from freecad_volfrep.engine import require_engine; require_engine()"
    home = find_home(__name__)
    assert home is not None
    return Program((console,), (home,), tuple(sys.path), whole, _WARM, threads)


def _package_folders() -> tuple[str, ...]:
    """Where this FreeCAD finds the engine's packages: its own folders hold other things, too."""
    found = (find_home(name) for name in PACKAGES)
    return tuple(dict.fromkeys([str(package_folder()), *filter(None, found)]))


def _console() -> str | None:
    """FreeCAD without windows that belongs to this FreeCAD; else whichever is found."""
    from volfrep.process.programs import find_freecad

    suffix = ".exe" if os.name == "nt" else ""
    for name in _CONSOLES:
        program = Path(App.getHomePath(), "bin", name + suffix)
        if program.is_file():
            return str(program)
    return find_freecad()


def _missed(sentence: str) -> None:
    """Called on another thread, where FreeCAD's console may be used."""
    App.Console.PrintWarning(
        f"VOLFREP: the engine cannot run in a process of its own by {sentence}\n"
    )
