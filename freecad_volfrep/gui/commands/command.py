# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a command of the workbench is: an icon, its texts, what must be selected, what it does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import FreeCADGui as Gui

from freecad_volfrep import ICONS
from freecad_volfrep.deps import missing_packages
from freecad_volfrep.gui.windows.help_window import page_address
from freecad_volfrep.gui.windows.install_window import offer_packages
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate

from .reasons import tell_in_group, tell_why

#: Why no command can be used beside a task panel.
PANEL_OPEN = QT_TRANSLATE_NOOP("VolfrepCommands", "A panel is open: end it first.")


@dataclass(frozen=True)
class Command:
    """A command as FreeCAD wants it; active while its selection is there and no panel is open.

    Attributes:
        name: that FreeCAD knows it by; its help page has the same.
        icon: file name.
        text: of the menu.
        tip: of the button.
        keys: shortcut as FreeCAD writes it, or nothing; none of FreeCAD's own.
        selected: what of the selection the command works on, or None; says why (`wants`).
        act: is called with that.
        computes: whether it needs the engine's packages.
        of_mesh: whether it uses the mesh of what is selected, so that one which is out of date is
            asked about: ``as it is`` may be, or ``fresh`` only; empty where it does not.
    """

    name: str
    icon: str
    text: str
    tip: str
    keys: str
    selected: Callable[[], Any]
    act: Callable[[Any], None]
    computes: bool = True
    of_mesh: str = ""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon, texts, shortcut, and the address of the help page."""
        resources = {
            "Pixmap": str(ICONS / self.icon),
            "MenuText": self.text,
            "ToolTip": self.tip,
            "StatusTip": self.tip,
            "WhatsThis": page_address(self.name),
        }
        return {**resources, "Accel": self.keys} if self.keys else resources

    def IsActive(self) -> bool:  # noqa: N802
        """Whether it can be used now; its tips say why not."""
        why = self.why_not()
        tell_why(self.name, why)
        return not why

    def why_not(self) -> str:
        """Why it cannot be used now, in the user's language; empty where it can."""
        if Gui.Control.activeDialog():
            return str(translate("VolfrepCommands", PANEL_OPEN))
        if self.selected() is None:
            return self.selected.why_not()
        return ""

    def Activated(self) -> None:  # noqa: N802
        """Do it; where packages are missing, offer to install them."""
        missing = missing_packages()
        if missing and self.computes:
            offer_packages(missing)
            return
        if not self.of_mesh:
            self.act(self.selected())
            return
        from freecad_volfrep.gui.jobs.fresh import when_fresh

        when_fresh(self.selected(), self.act, can_be_stale=self.of_mesh == "as it is")


@dataclass(frozen=True)
class CommandGroup:
    """A drop-down of the toolbar, as FreeCAD wants it; its button is that of the last one used.

    FreeCAD has entries of its own for the commands in it: those that cannot be used are greyed
    here, and say why.

    Attributes:
        name: that FreeCAD knows it by.
        text: of what its commands do.
        commands: that are in it.
    """

    name: str
    text: str
    commands: tuple[Command, ...]

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Its text; icons and tips are its commands', the help page is the first one's."""
        page = page_address(self.commands[0].name)
        return {"MenuText": self.text, "ToolTip": self.text, "WhatsThis": page}

    def GetCommands(self) -> tuple[str, ...]:  # noqa: N802
        """The names of the commands in it."""
        return tuple(command.name for command in self.commands)

    def GetDefaultCommand(self) -> int:  # noqa: N802
        """The first one's number."""
        return 0

    def IsActive(self) -> bool:  # noqa: N802
        """Whether one of them can be used now."""
        reasons = [command.why_not() for command in self.commands]
        tell_in_group(self.name, reasons)
        return not all(reasons)
