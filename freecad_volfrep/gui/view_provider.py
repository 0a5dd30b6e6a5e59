# SPDX-License-Identifier: LGPL-2.1-or-later
"""How our objects show in the tree and in the view."""

from __future__ import annotations

from typing import Any

from freecad_volfrep import ICONS

#: Of a new infill, in percent: the lattice shows through the skin.
TRANSPARENCY = 60
#: Of facets that hang over: red, green, blue.
OVERHANG = (0.85, 0.16, 0.12)


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


class PrintCheckView:
    """View provider of a print check: its icon, and its facets in red."""

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.ShapeColor = OVERHANG

    def getIcon(self) -> str:  # noqa: N802
        """Path of the tree's icon."""
        return str(ICONS / "print_check.svg")

    def dumps(self) -> None:
        """Nothing to save."""

    def loads(self, state: Any) -> None:
        """Nothing to restore."""

    __getstate__ = dumps  # FreeCAD 0.20
    __setstate__ = loads


# Saved files find the classes under these names.
PrintCheckView.__module__ = "freecad_volfrep.gui.view_provider"
LatticeInfillView.__module__ = "freecad_volfrep.gui.view_provider"
