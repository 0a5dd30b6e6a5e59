# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other programs: found, run until they end, or ended when the user cancels."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..util.progress import Monitor
from .child import NO_LIMITS, Child, Limits, OverLimit

#: FreeCAD without windows, as it is called on the PATH; Windows adds `.exe` by itself.
FREECAD = ("freecadcmd", "FreeCADCmd", "freecad.cmd")
#: Where its installers put it on systems that do not put it on the PATH, by `sys.platform`.
FREECAD_PLACES = {
    "win32": (r"C:\Program Files", "FreeCAD*/bin/freecadcmd.exe"),
    "darwin": ("/Applications", "FreeCAD*.app/Contents/Resources/bin/freecadcmd"),
}


def find_freecad() -> str | None:
    """FreeCAD without windows; None where there is none.

    The environment variable VOLFREP_FREECAD names it; else it is looked for on the PATH, and where
    the installers for Windows and macOS put it, the newest first.
    """
    named = os.environ.get("VOLFREP_FREECAD")
    if named:
        return shutil.which(named)
    for name in FREECAD:
        program = shutil.which(name)
        if program is not None:
            return program
    folder, pattern = FREECAD_PLACES.get(sys.platform, ("", ""))
    found = sorted(Path(folder).glob(pattern)) if folder else []
    return str(found[-1]) if found else None


def run_program(
    command: Sequence[str],
    folder: Path,
    monitor: Monitor | None = None,
    environment: Mapping[str, str] | None = None,
    limits: Limits = NO_LIMITS,
) -> subprocess.CompletedProcess[str]:
    """Run a program in a folder and keep what it says, errors included.

    Args:
        command: the program and its arguments.
        folder: where it runs.
        monitor: asked for a cancel while it runs.
        environment: its variables; None for this process's.
        limits: of the run.

    Raises:
        Cancelled: when the monitor says so; the program has been ended.
        OverLimit: when it takes more than it may; it has been ended.
        OSError: it cannot be started.
    """
    if shutil.which(command[0]) is None:
        raise FileNotFoundError(2, os.strerror(2), command[0])
    child = Child(command, limits=limits, folder=folder, environment=environment)
    try:
        said = child.guarded(child.said, limits, None if monitor is None else monitor.tick)
    except BaseException:  # cancelled, interrupted or over its limits: it must not go on alone
        child.kill()
        raise
    finally:
        code, _ = child.wait()
    if limits.processor_seconds is not None and code == -getattr(signal, "SIGXCPU", 0):
        raise OverLimit("processor time")
    text = said.decode(errors="replace").replace(os.linesep, "\n")
    return subprocess.CompletedProcess(list(command), code, text)
