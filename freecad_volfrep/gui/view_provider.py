# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a lattice infill shows in the tree and what a double click on it does."""

from __future__ import annotations

from typing import Any

from freecad_volfrep import ICONS

#: Of a new infill, in percent: the lattice shows through the skin.
TRANSPARENCY = 60


class LatticeInfillView:
    """View provider of a lattice infill: its icon, and Update in the context menu."""

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.Transparency = TRANSPARENCY

    def attach(self, view: Any) -> None:
        """Called by FreeCAD for a new object and for one from a file."""
        self.object = view.Object

    def getIcon(self) -> str:  # noqa: N802
        """Path of the tree's icon."""
        return str(ICONS / "lattice_infill.svg")

    def setupContextMenu(self, view: Any, menu: Any) -> None:  # noqa: N802
        """Offer Update, which works with AutoUpdate off too."""
        action = menu.addAction("Update Lattice Infill")
        action.triggered.connect(lambda: self.object.Proxy.update(self.object))

    def dumps(self) -> None:
        """Nothing to save."""

    def loads(self, state: Any) -> None:
        """Nothing to restore: `attach` is called with the view."""

    __getstate__ = dumps  # FreeCAD 0.20
    __setstate__ = loads


# Saved files find the class under this name.
LatticeInfillView.__module__ = "freecad_volfrep.gui.view_provider"
