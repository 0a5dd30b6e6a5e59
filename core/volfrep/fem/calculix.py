# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs CalculiX on a deck and reads the displacements back."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.subprocesses import run_program
from ..util.threads import threads

_RESULT = re.compile(r"^ displacements .*?\n\n((?: +\d+(?: +\S+){3}\n)*)", re.MULTILINE)


def solve(deck: str | os.PathLike[str], monitor: Monitor | None = None) -> NDArray[np.float64]:
    """Solve a deck that prints the displacements of all its nodes (as ours with a step do).

    Args:
        deck: the .inp file; CalculiX's own files go to a temporary folder.
        monitor: asked for a cancel while CalculiX runs.

    Returns:
        (n, 3) displacement, mm, of nodes 1 to n: those of the last step.

    Raises:
        VolfrepError: CalculiX is not installed, or does not solve the deck.
        Cancelled: when the monitor says so.
    """
    program = shutil.which("ccx")
    if program is None:
        raise VolfrepError(
            "CalculiX (ccx) is not installed: install it ('apt-get install calculix-ccx')."
        )
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shutil.copyfile(deck, folder / "job.inp")
        environment = {**os.environ, "OMP_NUM_THREADS": str(threads())}
        said = run_program([program, "-i", "job"], folder, monitor, environment)
        printed = folder / "job.dat"
        blocks = (
            _RESULT.findall(printed.read_text(encoding="utf-8", errors="replace"))
            if printed.is_file()
            else []
        )
        if said.returncode or not blocks:
            reason = [line for line in said.stdout.splitlines() if "ERROR" in line]
            detail = f": {reason[0].strip().rstrip('.')}" if reason else ""
            raise VolfrepError(f"CalculiX did not solve '{deck}'{detail}.")
    table = np.array(blocks[-1].split(), np.float64).reshape(-1, 4)
    result = np.zeros((int(table[:, 0].max()), 3))
    result[table[:, 0].astype(np.int64) - 1] = table[:, 1:]
    return result
