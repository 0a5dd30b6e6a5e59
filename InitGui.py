# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run by FreeCAD at the start of its windows: tells it about the workbench.

FreeCAD executes this file inside a function, so its names are not visible inside the methods
below, which import what they need, when they need it.
"""

import FreeCADGui as Gui

from freecad_volfrep import window
from freecad_volfrep.gui.preferences_page import register_pages
from freecad_volfrep.translation import TRANSLATIONS

# First: what follows is said in the user's language.
Gui.addLanguagePath(str(TRANSLATIONS))
Gui.updateLocale()


class VolfrepWorkbench(Gui.Workbench):
    """The VOLFREP workbench: fill a solid with a strut lattice."""

    def __init__(self):
        from freecad_volfrep import ICONS
        from freecad_volfrep.translation import translate

        self.__class__.MenuText = "VOLFREP"
        self.__class__.ToolTip = translate(
            "VolfrepWorkbench", "Fill a solid with a strut lattice, ready for the printer"
        )
        self.__class__.Icon = str(ICONS / "volfrep.svg")

    def Initialize(self):  # noqa: N802
        """Called by FreeCAD when the workbench is first activated."""
        import FreeCAD as App

        from freecad_volfrep.deps import explain_missing, missing_packages
        from freecad_volfrep.gui.commands.table import EXAMPLES, PARTS, TOOLBAR, register_commands
        from freecad_volfrep.translation import QT_TRANSLATE_NOOP

        register_commands()
        self.appendToolbar("VOLFREP", TOOLBAR)
        for _, names in PARTS:
            self.appendMenu("&VOLFREP", [*names, "Separator"])
        self.appendMenu(["&VOLFREP", QT_TRANSLATE_NOOP("Workbench", "Examples")], EXAMPLES)
        self.appendMenu("&VOLFREP", ["Separator", "VOLFREP_Help"])
        missing = missing_packages()
        if missing:
            App.Console.PrintError(explain_missing(missing) + "\n")

    def ContextMenu(self, recipient):  # noqa: N802
        """Offer the commands that apply in the context menu of the view and the tree."""
        from freecad_volfrep.gui.commands.table import applicable_commands

        self.appendContextMenu("VOLFREP", applicable_commands())

    def GetClassName(self):  # noqa: N802
        """Tell FreeCAD that this is a workbench written in Python."""
        return "Gui::PythonWorkbench"


Gui.addWorkbench(VolfrepWorkbench())
# From the start, whether or not the workbench is ever opened.
register_pages()
window.register()
