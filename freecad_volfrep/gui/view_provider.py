# SPDX-License-Identifier: LGPL-2.1-or-later
"""How our objects show in the tree and in the view."""

from __future__ import annotations

from typing import Any

import FreeCADGui as Gui

from freecad_volfrep import ICONS, preferences

from .coarse_view import COARSE, FINE
from .qt import QtGui


class LatticeInfillView:
    """View provider of a lattice infill: its icon, the commands for it, and a coarse mesh.

    A mesh of more triangles than the preference allows is shown by a coarse likeness of it, as the
    display mode Coarse; whoever chooses another mode sees all of it.
    """

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.Transparency = preferences.read(preferences.TRANSPARENCY)

    def attach(self, view: Any) -> None:
        """Called by FreeCAD for a new object and for one from a file."""
        from pivy import coin

        self.object = view.Object
        self._coarse = coin.SoSeparator()
        view.addDisplayMode(self._coarse, COARSE)

    def getDisplayModes(self, view: Any) -> list[str]:  # noqa: N802
        """The modes beside those of every mesh."""
        return [COARSE]

    def getDefaultDisplayMode(self) -> str:  # noqa: N802
        """The mode of a new object."""
        return FINE

    def setDisplayMode(self, mode: str) -> str:  # noqa: N802
        """Every mode of the list is one of the view's own."""
        return mode

    def updateData(self, obj: Any, name: str) -> None:  # noqa: N802
        """A new mesh: shown coarsely if it is too large, else as it is."""
        if name == "Mesh":
            from .coarse_view import show_mesh

            show_mesh(obj, self._coarse)

    def getIcon(self) -> str:  # noqa: N802
        """Path of the tree's icon."""
        return str(ICONS / "lattice_infill.svg")

    def doubleClicked(self, view: Any) -> bool:  # noqa: N802
        """Edit the infill in its task panel."""
        view.Document.setEdit(view.Object.Name)
        return True

    def setEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Open the task panel."""
        from .task_panel import TaskPanel

        Gui.Control.showDialog(TaskPanel(view.Object, f"Edit {view.Object.Label}"))
        return True

    def unsetEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Leave the panel to its own buttons."""
        return False

    def setupContextMenu(self, view: Any, menu: Any) -> None:  # noqa: N802
        """Offer the commands that apply, where another workbench than ours is in front."""
        from .commands import COMMANDS, applicable_commands

        if Gui.activeWorkbench().name() == "VolfrepWorkbench":
            return  # which offers them itself
        submenu = menu.addMenu("VOLFREP")
        for name in applicable_commands():
            command = COMMANDS[name]
            submenu.addAction(
                QtGui.QIcon(str(ICONS / command.icon)), command.text
            ).triggered.connect(lambda _=False, command=command: command.Activated())

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
        view.ShapeColor = preferences.colour(preferences.OVERHANG_COLOUR)

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
