# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other programs: found, run until they end, or ended when the user cancels."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from .progress import Monitor

#: FreeCAD without windows, as it is called on the PATH; Windows adds `.exe` by itself.
FREECAD = ("freecadcmd", "FreeCADCmd", "freecad.cmd")
#: Where its installers put it on systems that do not put it on the PATH, by `sys.platform`.
FREECAD_PLACES = {
    "win32": (r"C:\Program Files", "FreeCAD*/bin/freecadcmd.exe"),
    "darwin": ("/Applications", "FreeCAD*.app/Contents/Resources/bin/freecadcmd"),
}
#: For `subprocess`: a program of the console opens no window of its own on Windows.
NO_WINDOW: int = getattr(subprocess, "CREATE_NO_WINDOW", 0)


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
    seconds: float | None = None,
) -> subprocess.CompletedProcess[str]:
    """Run a program in a folder and keep what it says, errors included.

    Args:
        command: the program and its arguments.
        folder: where it runs.
        monitor: asked for a cancel while it runs.
        environment: its variables; None for this process's.
        seconds: how long it may take; None for any time.

    Raises:
        Cancelled: when the monitor says so; the program has been ended.
        subprocess.TimeoutExpired: when it takes longer; it has been ended.
    """
    process = subprocess.Popen(
        command,
        cwd=folder,
        env=None if environment is None else dict(environment),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        creationflags=NO_WINDOW,
        text=True,
        errors="replace",
    )
    monitor = monitor or Monitor()
    try:
        said, _ = monitor.call(lambda: process.communicate(timeout=seconds))
    except BaseException:  # cancelled, interrupted or out of time: it must not go on alone
        process.kill()
        process.wait()
        raise
    return subprocess.CompletedProcess(list(command), process.returncode, said)
