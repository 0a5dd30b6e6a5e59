# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a solver is told beside the mesh: supports and loads."""

from __future__ import annotations

from dataclasses import dataclass

from ..util.types import Bools, Floats


@dataclass(frozen=True, eq=False)
class Case:
    """Loads that act together, on the nodes.

    Attributes:
        fixed: (n, 6) bool, which displacements (x, y, z) and turns are given.
        loads: (n, 6) forces, N, and moments, N mm.
        prescribed: (n, 6) mm and radians, how what is held is moved; None for not at all.
        acceleration: (3,) mm/s2, of all that has a mass.
        name: for messages and reports.
    """

    fixed: Bools
    loads: Floats
    prescribed: Floats | None = None
    acceleration: tuple[float, float, float] = (0.0, 0.0, 0.0)
    name: str = "load"
