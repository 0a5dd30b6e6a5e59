# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cell as the library lists it, of struts or a TPMS, and what cells are for."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.design.cells import LIBRARY, UnitCell
from volfrep.design.tpms import SURFACES, PeriodicSurface
from volfrep.mechanics.endless import stretched_strains

from .cell_picture import cell_icon, tpms_icon

_CONTEXT = "VolfrepCells"
#: What cells are for, as `volfrep.design.cells.USES` has it; and walls.
USES = {
    "stiff": QT_TRANSLATE_NOOP("VolfrepCells", "stiff in every direction"),
    "axial": QT_TRANSLATE_NOOP("VolfrepCells", "stiff along its columns"),
    "soft": QT_TRANSLATE_NOOP("VolfrepCells", "soft: energy, vibration"),
    "open": QT_TRANSLATE_NOOP("VolfrepCells", "open: flow, bone, foams"),
    "auxetic": QT_TRANSLATE_NOOP("VolfrepCells", "auxetic: wider when pulled"),
    "walls": QT_TRANSLATE_NOOP("VolfrepCells", "walls along a surface"),
}
_STRETCHING = QT_TRANSLATE_NOOP("VolfrepCells", "stretching")
_BENDING = QT_TRANSLATE_NOOP("VolfrepCells", "bending")


@dataclass(eq=False)
class Entry:
    """A cell of the list.

    Attributes:
        cell: with its name; of walls the surface.
        path: of its file; None for one of the library, and for one that is not saved yet.
        notes: what to know about it.
    """

    cell: Any
    path: str | None = None
    notes: tuple[str, ...] = ()

    #: Whether it can be kept in a file.
    has_file = False
    #: Whether it is not one of the library's.
    is_own = False

    @property
    def use(self) -> str | None:
        """What it is for: one of `USES`."""
        raise NotImplementedError

    def icon(self, size: int) -> Any:
        """Its picture."""
        raise NotImplementedError

    def rows(self) -> tuple[tuple[str, Any], ...]:
        """What is told of it at once."""
        return (
            (
                translate(_CONTEXT, "Good for"),
                translate(_CONTEXT, USES[self.use]) if self.use else "-",
            ),
            (translate(_CONTEXT, "Also known as"), "\n".join(self.cell.also) or "-"),
        )


class StrutEntry(Entry):
    """A cell of struts."""

    has_file = True

    @property
    def is_own(self) -> bool:  # type: ignore[override]
        """Whether it is not one of the library's."""
        return LIBRARY.get(self.cell.name) is not self.cell

    @property
    def use(self) -> str | None:
        """What it is for: one of `USES`."""
        use: str = self.cell.use
        return use

    def icon(self, size: int) -> Any:
        """Its picture."""
        return cell_icon(self.cell, size)

    def rows(self) -> tuple[tuple[str, Any], ...]:
        """What is told of it at once."""
        cell, file = self.cell, "-"
        if self.is_own:
            file = translate(_CONTEXT, "not saved")
        if self.path:
            file = Path(self.path).name
        carries = _STRETCHING if stretched_strains(cell) == 6 else _BENDING
        return (
            (translate(_CONTEXT, "Nodes"), len(cell.nodes)),
            (translate(_CONTEXT, "Struts"), len(cell.struts)),
            (translate(_CONTEXT, "Maxwell number"), cell.maxwell_number),
            (translate(_CONTEXT, "Carries load by"), translate(_CONTEXT, carries)),
            *super().rows(),
            (translate(_CONTEXT, "File"), file),
        )


class TpmsEntry(Entry):
    """A surface that walls follow."""

    use = "walls"

    def icon(self, size: int) -> Any:
        """Its picture."""
        return tpms_icon(self.cell.name, size)


#: By the class of a cell.
ENTRIES: dict[type, type[Entry]] = {UnitCell: StrutEntry, PeriodicSurface: TpmsEntry}


def entry_of(
    cell: UnitCell | PeriodicSurface, path: str | None = None, notes: tuple[str, ...] = ()
) -> Entry:
    """A cell as the list has it."""
    return ENTRIES[type(cell)](cell, path, notes)


def icon_of(name: str, size: int) -> Any:
    """The picture of a cell of the library; of a formula of one's own an empty cube."""
    cell = LIBRARY.get(name) or SURFACES.get(name)
    return cell_icon(None, size) if cell is None else entry_of(cell).icon(size)
