# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other programs: run until they end, or ended when the user cancels."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from .progress import Monitor


def run_program(
    command: Sequence[str],
    folder: Path,
    monitor: Monitor | None = None,
    environment: Mapping[str, str] | None = None,
) -> subprocess.CompletedProcess[str]:
    """Run a program in a folder and keep what it says, errors included.

    Args:
        command: the program and its arguments.
        folder: where it runs.
        monitor: asked for a cancel while it runs.
        environment: its variables; None for this process's.

    Raises:
        Cancelled: when the monitor says so; the program has been ended.
    """
    process = subprocess.Popen(
        command,
        cwd=folder,
        env=None if environment is None else dict(environment),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    )
    try:
        said, _ = process.communicate() if monitor is None else monitor.call(process.communicate)
    except BaseException:  # cancelled or interrupted: it must not go on alone
        process.kill()
        process.wait()
        raise
    return subprocess.CompletedProcess(list(command), process.returncode, said)
