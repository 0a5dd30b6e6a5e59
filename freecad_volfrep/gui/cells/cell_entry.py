# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cell as the library lists it, of struts or of walls, and what cells are for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from freecad_volfrep.translation import QT_TRANSLATE_NOOP
from volfrep.design.cells import LIBRARY, UnitCell
from volfrep.design.tpms import PeriodicSurface

from .cell_picture import cell_icon, wall_icon

#: What cells are for, as `volfrep.design.cells.USES` has it; and walls.
USES = {
    "stiff": QT_TRANSLATE_NOOP("VolfrepCells", "stiff in every direction"),
    "axial": QT_TRANSLATE_NOOP("VolfrepCells", "stiff along its columns"),
    "soft": QT_TRANSLATE_NOOP("VolfrepCells", "soft: energy, vibration"),
    "open": QT_TRANSLATE_NOOP("VolfrepCells", "open: flow, bone, foams"),
    "auxetic": QT_TRANSLATE_NOOP("VolfrepCells", "auxetic: wider when pulled"),
    "walls": QT_TRANSLATE_NOOP("VolfrepCells", "walls along a surface"),
}


@dataclass(eq=False)
class Entry:
    """A cell of the list.

    Attributes:
        cell: with its name; of walls the surface.
        path: of its file; None for one of the library, and for one that is not saved yet.
        notes: what to know about it.
    """

    cell: UnitCell | PeriodicSurface
    path: str | None = None
    notes: tuple[str, ...] = ()

    @property
    def is_own(self) -> bool:
        """Whether it is not one of the library's."""
        return not self.is_wall and LIBRARY.get(self.cell.name) is not self.cell

    @property
    def is_wall(self) -> bool:
        """Whether it is one of walls."""
        return isinstance(self.cell, PeriodicSurface)

    @property
    def use(self) -> str | None:
        """What it is for: one of `USES`."""
        return "walls" if isinstance(self.cell, PeriodicSurface) else self.cell.use

    def icon(self, size: int) -> Any:
        """Its picture."""
        cell = self.cell
        return wall_icon(cell.name, size) if self.is_wall else cell_icon(cell, size)  # type: ignore[arg-type]
