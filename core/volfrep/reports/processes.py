# SPDX-License-Identifier: LGPL-2.1-or-later
"""What printing processes can do, as a table with its sources.

Importing it costs nothing (no numpy).
"""

from __future__ import annotations

from dataclasses import dataclass

from ..util.errors import VolfrepError, brief


@dataclass(frozen=True)
class Process:
    """What a printing process can do, typically; its machine and material may do better or worse.

    Attributes:
        name: as a user picks it.
        title: in words.
        strut: smallest diameter of a strut, mm.
        wall: least thickness of a wall that is held on two sides, mm.
        gap: smallest gap between two struts, or two walls, mm.
        inclination: least inclination that needs no support, degrees; 0: none needs it.
        bridge: longest flat strut without support, mm; None: no limit.
        escape_hole: smallest diameter of a hole that empties a closed void of powder or resin,
            mm; None: nothing is left in a void.
        source: where the figures are from.
    """

    name: str
    title: str
    strut: float
    wall: float
    gap: float
    inclination: float
    bridge: float | None
    escape_hole: float | None
    source: str


_RULES = "Hubs (now Protolabs Network), Design rules for 3D printing"
_WALLS = "wall: ARTI90, Design clues for 3D printing"
PROCESSES = {
    process.name: process
    for process in (
        Process("FFF", "fused filament", 2.0, 1.0, 0.5, 45.0, 10.0, None, f"{_RULES}; {_WALLS}"),
        Process(
            "SLA", "stereolithography", 0.5, 0.8, 0.5, 15.0, 2.5, 4.0,
            f"{_RULES}; inclination and bridge: ETEC, Self-supporting features (Xtreme 8K); wall: "
            "printit4me, Designing parts for 3D printing",
        ),
        Process(
            "SLS", "polymer powder, laser", 0.8, 0.7, 1.0, 0.0, None, 5.0,
            f"{_RULES}; gap: Materialise, Design guidelines PA 12 (MJF), lattice structures; "
            f"{_WALLS}",
        ),
        Process(
            "MJF", "polymer powder, multi-jet", 1.0, 1.0, 1.0, 0.0, None, 5.0,
            "3faktur, Basic design requirements (PA12, ribs; for walls, too); gap: Materialise, "
            "Design guidelines PA 12 (MJF), lattice structures; escape hole: as SLS",
        ),
        Process(
            "LPBF", "metal powder, laser", 0.6, 0.4, 0.5, 45.0, 2.0, 5.0,
            f"{_RULES}; gap, inclination and wall: ARTI90, Design clues for 3D printing (DMLS)",
        ),
        Process(
            "EBM", "metal powder, electron beam", 0.6, 0.4, 0.5, 45.0, 2.0, 5.0,
            "as LPBF; a published table of design rules (Arcam Q20 plus) has 0.4 mm for walls and "
            "holes and 30 to 45 degrees",
        ),
    )
}  # fmt: skip


def find_process(name: str) -> Process:
    """The process of that name; case does not matter.

    Raises:
        VolfrepError: listing the known ones.
    """
    process = PROCESSES.get(name.upper()) if isinstance(name, str) else None
    if process is None:
        known = ", ".join(PROCESSES)
        raise VolfrepError(f"There is no process {brief(name)}: choose one of {known}.")
    return process
