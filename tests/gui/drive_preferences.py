# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens FreeCAD's preferences at VOLFREP's pages, types, and looks at what comes of it."""

import sys
from pathlib import Path

import FreeCAD as App
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import check, picture, preferences_open, run_checks, turn_to

GROUP = "User parameter:BaseApp/Preferences/Mod/VOLFREP"


def editor(dialog, key):
    """The widget of a preference, on either of our pages."""
    pages = [dialog.findChild(QtGui.QWidget, name) for name in ("NewInfillPage", "DisplayPage")]
    return next(filter(None, (page.findChild(QtGui.QWidget, key) for page in pages)))


def fill_in(dialog):
    """Look at both pages and set values of every kind."""
    check("the preferences open", dialog is not None)
    first = dialog.findChild(QtGui.QWidget, "NewInfillPage")
    second = dialog.findChild(QtGui.QWidget, "DisplayPage")
    check("both pages are there", first is not None and second is not None)
    check("the first is shown", first.isVisible())
    check("they show the defaults", editor(dialog, "NewCellType").currentText() == "CVC")
    check("0 is automatic", editor(dialog, "NewCellSize").text() == "automatic")
    picture("preferences_1_new_infill")
    editor(dialog, "NewCellType").setCurrentText("Octet")
    editor(dialog, "NewCellSize").setValue(5)
    editor(dialog, "NewAutoUpdate").setChecked(False)
    turn_to(second, dialog)
    check("the second is shown", second.isVisible())
    picture("preferences_2_display")
    editor(dialog, "Transparency").setValue(30)
    editor(dialog, "StrutColour").setProperty("color", QtGui.QColor(200, 80, 20))


def read_back(dialog):
    """What was set is shown again; Defaults shows the defaults."""
    check("a choice is kept", editor(dialog, "NewCellType").currentText() == "Octet")
    check("a number is kept", editor(dialog, "NewCellSize").value() == 5)
    check("a switch is kept", not editor(dialog, "NewAutoUpdate").isChecked())
    shown = editor(dialog, "StrutColour").property("color")
    check("a colour is kept", shown.red() == 200, shown)
    page = dialog.findChild(QtGui.QWidget, "NewInfillPage")
    page.findChild(QtGui.QPushButton, "Defaults").click()
    check("Defaults shows them", editor(dialog, "NewCellType").currentText() == "CVC")


def set_use_and_read_back():
    """What is set in the preferences is used, shown again, and forgotten."""
    group = App.ParamGet(GROUP)
    group.Clear()
    preferences_open(fill_in)
    check("a choice is stored", group.GetString("NewCellType") == "Octet", group.GetContents())
    check("a number is stored", group.GetFloat("NewCellSize") == 5.0)
    check("a colour is stored", group.GetUnsigned("StrutColour") == 0xC85014FF)
    check("defaults are not", len(group.GetContents()) == 5, group.GetContents())
    use()
    preferences_open(read_back)
    stored = {name for _, name, _ in group.GetContents() or ()}
    check("OK then forgets them", stored == {"Transparency", "StrutColour"}, stored)
    group.Clear()
    App.saveParameter()  # OK has written them to the profile


def use():
    """The command makes an infill of what was set."""
    from freecad_volfrep.gui.commands.infill_commands import make_suitable_infill

    doc = App.newDocument("Drive")
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 20
    doc.recompute()
    obj = make_suitable_infill(doc, box)
    check("the infill has the cell", obj.CellType == "Octet")
    check("and its size", obj.CellSize.Value == 5)
    check("and does not update", not obj.AutoUpdate)
    check("and is as transparent", obj.ViewObject.Transparency == 30)
    App.closeDocument(doc.Name)


run_checks("preferences", {set_use_and_read_back: None})
