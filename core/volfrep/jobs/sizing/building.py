# SPDX-License-Identifier: LGPL-2.1-or-later
"""A design that its process can build: how thin struts may be, and which lie too flat.

The limits are those of the print check, so that a design within them passes it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...design.as_printed import PrintedTable
from ...design.spec import LatticeSpec
from ...design.spec_parts import FlatStruts
from ...grid.inclination import unit_direction
from ...reports.processes import Process, find_process


@dataclass(frozen=True)
class Building:
    """How a part is built.

    Attributes:
        process: its limits.
        build_direction: from the build plate up, of any length.
        is_free: nobody asks for this direction: the best of the part's axes is taken for it.

    Raises:
        VolfrepError: the direction is none.
    """

    process: Process
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    is_free: bool = False

    def __post_init__(self) -> None:
        unit_direction(self.build_direction)

    def least_radius(self, table: PrintedTable | None) -> float:
        """The smallest radius to draw, mm: where a table is given, what comes out has the limit."""
        if table is None:
            return 0.5 * self.process.strut
        angles = np.linspace(0.0, 90.0, 91)
        drawn = table.drawn(np.full(len(angles), self.process.strut), angles)
        return 0.5 * float(drawn.max())

    def without_flat_struts(self, spec: LatticeSpec) -> LatticeSpec | None:
        """The same without struts that lie too flat; None where none does, or a network has them.

        Of a network they are what there is: no cell says which may go.
        """
        if self.process.inclination <= 0.0 or spec.kind.cube is None:
            return None
        flat = FlatStruts(self.process.inclination, self.build_direction)
        return replace(spec, flat_struts=flat)


def building_of(process: str, up: tuple[float, float, float] | None, spec: LatticeSpec) -> Building:
    """How a part is built, as a user asks for it.

    Args:
        process: its name.
        up: the build direction; None for that of the specification's flat struts or drain holes,
            without which it is free.
        spec: of the part.

    Raises:
        VolfrepError: there is no such process, or the direction is none.
    """
    along = spec.flat_struts or spec.drains
    if up is None and along is not None:
        up = along.build_direction
    if up is None:
        return Building(find_process(process), is_free=True)
    return Building(find_process(process), up)
