# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs CalculiX on a deck, and reads what it prints (.dat) and its results at nodes (.frd)."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from ..process.child import Limits, OverLimit
from ..process.programs import run_program
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.threads import threads
from ..util.types import Floats, Ints

_DISPLACEMENTS = re.compile(r"^ displacements .*?\n\n((?: +\d+(?: +\S+){3}\n)*)", re.MULTILINE)
#: The first row of its table of load factors.
_FIRST = re.compile(r"^ +1 +(\S+)$", re.MULTILINE)
#: Columns of an .frd file: the node's number, then numbers of so many characters.
_NODE, _NUMBER = slice(3, 13), 12


def find_calculix() -> str | None:
    """The program; None where it is not installed."""
    return shutil.which("ccx")


@dataclass(frozen=True)
class Results:
    """The files of a run, as long as it lasts.

    Attributes:
        folder: where `job.dat` and `job.frd` lie.
    """

    folder: Path

    @cached_property
    def printed(self) -> str:
        """What stands in the .dat file."""
        path = self.folder / "job.dat"
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    @cached_property
    def displacements(self) -> list[tuple[Ints, Floats]]:
        """For every step that prints them: (n,) rows of nodes, and (n, 3) mm."""
        tables = []
        for block in _DISPLACEMENTS.findall(self.printed):
            table = np.array(block.split(), np.float64).reshape(-1, 4)
            tables.append((table[:, 0].astype(np.int64) - 1, table[:, 1:]))
        return tables

    def section_forces(self) -> list[tuple[Ints, Floats]]:
        """For every static step: (n,) rows of nodes, and (n, 6) N and N mm."""
        tables: list[tuple[Ints, Floats]] = []
        inside = False
        node: list[int] = []
        found: list[list[float]] = []
        with (self.folder / "job.frd").open(encoding="ascii", errors="replace") as lines:
            for line in lines:
                if line.startswith(" -4  STRESS"):
                    inside, node, found = True, [], []
                elif inside and line.startswith(" -1"):
                    node.append(int(line[_NODE]) - 1)
                    values = line[_NODE.stop :].rstrip("\n")
                    found.append(
                        [float(values[k : k + _NUMBER]) for k in range(0, 6 * _NUMBER, _NUMBER)]
                    )
                elif inside and line.startswith(" -3"):
                    tables.append((np.array(node, np.int64), np.array(found)))
                    inside = False
        return tables

    def frequencies(self) -> Floats:
        """(modes,) Hz, of its table of eigenvalues."""
        start = self.printed.index("E I G E N V A L U E   O U T P U T")
        found = []
        for line in self.printed[start:].splitlines()[1:]:
            parts = line.split()
            if len(parts) == 5 and parts[0].isdigit():
                found.append(float(parts[3]))
            elif found:
                break
        return np.array(found)

    def load_factor(self) -> float | None:
        """How many times the load may be before it buckles; None where no factor was found."""
        found = _FIRST.search(self.printed)
        return None if found is None else float(found[1])


@contextmanager
def run(
    deck: Iterable[bytes],
    name: str,
    monitor: Monitor | None = None,
    *,
    steps: int = 0,
    seconds: float | None = None,
) -> Iterator[Results]:
    """Solve a deck in a temporary folder, on as many cores as the engine may use.

    Args:
        deck: its text in pieces.
        name: of what is solved, for messages.
        monitor: asked for a cancel while CalculiX runs.
        steps: how many must have printed displacements.
        seconds: how long it may take; None for any time.

    Raises:
        VolfrepError: CalculiX is not installed, does not solve the deck, or takes longer.
        Cancelled: when the monitor says so.
    """
    program = find_calculix()
    if program is None:
        raise VolfrepError(
            "CalculiX (ccx) is not installed: install it ('apt-get install calculix-ccx')."
        )
    with tempfile.TemporaryDirectory() as there:
        folder = Path(there)
        with (folder / "job.inp").open("wb") as file:
            file.writelines(deck)
        limits = Limits(seconds, threads=threads())
        try:
            done = run_program([program, "-i", "job"], folder, monitor, limits=limits)
        except OverLimit as error:
            raise VolfrepError(
                f"CalculiX did not solve {name} within {seconds:g} s: use fewer or larger cells."
            ) from error
        results = Results(folder)
        if done.returncode or len(results.displacements) < steps:
            reason = [line for line in done.stdout.splitlines() if "ERROR" in line]
            detail = f": {reason[0].strip().rstrip('.')}" if reason else ""
            raise VolfrepError(f"CalculiX did not solve {name}{detail}.")
        yield results


def solve(
    deck: str | os.PathLike[str], monitor: Monitor | None = None, seconds: float | None = None
) -> Floats:
    """Solve a deck that prints the displacements of all its nodes (as ours with a step do).

    Args:
        deck: the .inp file.
        monitor: asked for a cancel while CalculiX runs.
        seconds: how long it may take; None for any time.

    Returns:
        (n, 3) displacement, mm, of nodes 1 to n: those of the last step.

    Raises:
        VolfrepError: CalculiX is not installed, does not solve the deck, or takes longer.
        Cancelled: when the monitor says so.
    """
    with run([Path(deck).read_bytes()], f"'{deck}'", monitor, steps=1, seconds=seconds) as results:
        node, displacements = results.displacements[-1]
    result = np.zeros((int(node.max()) + 1, 3))
    result[node] = displacements
    return result
