# SPDX-License-Identifier: LGPL-2.1-or-later
"""That every command is reached by mouse and keys, and what has lost its proxy is alive again.

In the real FreeCAD window; see tools/run_gui.sh. Leaves with 0 when every check held.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    check,
    click,
    click_menu,
    context_menu,
    figures,
    infills,
    picture,
    run,
    select,
    step,
    toolbar_button,
    view_3d,
    wait,
    wait_until,
    xdotool,
)

FOLDER = Path(tempfile.mkdtemp(prefix="volfrep-"))


def drive():
    """The whole session."""
    Gui.activateWorkbench("VolfrepWorkbench")
    wait(800)
    step(every_command_can_be_reached)
    obj = step(fill_a_box)
    step(open_sections, obj)
    step(revive_what_was_saved_elsewhere, obj, True)
    step(revive_what_was_saved_elsewhere, fill_a_box(), False)
    step(check_the_bracket)


def texts_of(actions):
    """Texts of the entries of a menu, and of its submenus'."""
    texts = []
    for action in actions:
        if action.menu() is not None:
            texts += texts_of(action.menu().actions())
        elif not action.isSeparator():
            texts.append(action.text().replace("&", ""))
    return texts


def every_command_can_be_reached():
    """By the menu each; by a button all but the help and the examples."""
    from freecad_volfrep.gui.commands import COMMANDS, EXAMPLES

    bar = Gui.getMainWindow().menuBar()
    ours = [action for action in bar.actions() if action.text().replace("&", "") == "VOLFREP"]
    offered = texts_of(ours)
    figures["entries of the menu"] = len(offered)
    registered = [name for name in Gui.Command.listAll() if name.startswith("VOLFREP_")]
    check("every command is registered", set(registered) == set(COMMANDS), registered)
    for name in registered:
        text = COMMANDS[name].text
        check(f"{text} is in the menu once", offered.count(text) == 1, offered)
        if name not in (*EXAMPLES, "VOLFREP_Help"):
            button = toolbar_button(text)
            check(f"{text} has a button that is seen", button is not None and button.isVisible())


def fill_a_box():
    """An infill to work with."""
    from freecad_volfrep import make_lattice_infill

    doc = App.newDocument("Reach")
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 20
    obj = make_lattice_infill(doc, box, CellSize=10, StrutRadius=1, ShellThickness=2, Resolution=8)
    doc.recompute()
    box.Visibility = False
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    return obj


def sections():
    """The open docks of sections."""
    docks = Gui.getMainWindow().findChildren(QtGui.QDockWidget, "VolfrepSectionView")
    return [dock for dock in docks if dock.isVisible()]


def close_sections():
    """Close them, as their own buttons do."""
    for dock in sections():
        dock.close()
    wait(300)


def open_sections(obj):
    """Section View by its button, the menu, the context menu of the tree, and its shortcut."""
    select(obj)
    click(toolbar_button("Section View"))
    check("by its button", wait_until(lambda: len(sections()) == 1, 5))
    picture("section_by_button")
    close_sections()
    click_menu("VOLFREP", "Section View")
    check("by the menu", wait_until(lambda: len(sections()) == 1, 5))
    close_sections()
    context_menu(obj, "VOLFREP", "Section View")
    check("by the context menu", wait_until(lambda: len(sections()) == 1, 5))
    close_sections()
    select(obj)
    view = view_3d()
    corner = view.mapToGlobal(view.rect().topLeft())
    xdotool("mousemove", corner.x() + 15, corner.y() + 15)  # nothing is there to be selected
    view.setFocus()
    wait(300)
    xdotool("key", "l", "n")
    check("by its shortcut", wait_until(lambda: len(sections()) == 1, 5))
    close_sections()
    Gui.activateWorkbench("PartWorkbench")
    wait(800)
    context_menu(obj, "VOLFREP", "Section View")
    check("by the context menu elsewhere", wait_until(lambda: len(sections()) == 1, 5))
    close_sections()
    Gui.activateWorkbench("VolfrepWorkbench")
    wait(800)


def revive_what_was_saved_elsewhere(obj, windows):
    """A FreeCAD without the workbench saves it, with or without windows: it lives here again."""
    doc, facets = obj.Document, obj.Mesh.CountFacets
    path = FOLDER / f"part{windows}.FCStd"
    doc.saveAs(str(path))
    App.closeDocument(doc.Name)
    script = FOLDER / "elsewhere.py"
    script.write_text(
        "import os, sys\n"
        "import FreeCAD as App\n"
        "from PySide import QtCore\n"
        "def main():\n"
        f"    doc = App.openDocument({str(path)!r})\n"
        "    obj = doc.LatticeInfill\n"
        "    obj.StrutRadius = 0.8\n"
        "    doc.recompute()\n"
        "    doc.save()\n"
        "    print('PROXY', obj.Proxy, obj.Status)\n"
        "    sys.stdout.flush()\n"
        "    os._exit(0)\n"
        f"{'QtCore.QTimer.singleShot(3000, main)' if windows else 'main()'}\n"
    )
    home = FOLDER / f"home{windows}"
    home.mkdir()
    elsewhere = dict(os.environ, FREECAD_USER_HOME=str(home))
    elsewhere.pop("PYTHONPATH", None)
    said = subprocess.run(
        ["freecad" if windows else "freecadcmd", str(script)],
        env=elsewhere,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120,
    )
    check("there it is dead", "PROXY None Up to date" in said.stdout, said)
    again = App.openDocument(str(path))
    wait(1500)
    found = again.getObject("LatticeInfill")
    check("it is an infill again", infills(again) == [found] and found.Proxy is not None)
    check("it says so", "without VOLFREP" in found.Status, found.Status)
    check("with its mesh", found.Mesh.CountFacets == facets)
    view = found.ViewObject.Proxy
    check("with its icon", view is not None and view.getIcon().endswith("lattice_infill.svg"))
    modes = found.ViewObject.listDisplayModes()
    for mode in ("Coarse", "Simplified", "Shaded"):
        found.ViewObject.DisplayMode = mode
        check(f"it can be shown {mode}", found.ViewObject.DisplayMode == mode, modes)
    picture("revived")
    select(found)
    check("it can be updated", toolbar_button("Update Lattice Infill").isEnabled())
    click_menu("Edit", "Refresh")
    wait_until(lambda: found.Status == "Up to date", 30)
    check("a refresh follows what was changed", found.StrutRadii[0] < 0.81, found.StrutRadii)
    click(toolbar_button("Edit Lattice Infill"))
    check(
        "it can be edited",
        wait_until(
            lambda: Gui.getMainWindow().findChild(QtGui.QWidget, "VolfrepTaskPanel") is not None, 10
        ),
    )
    picture("revived_panel")
    Gui.Control.closeDialog()
    App.closeDocument(again.Name)
    wait(500)


def check_the_bracket():
    """The shipped bracket is checked, by clicks alone, and found to be what it is."""
    click_menu("VOLFREP", "Examples", "Bracket")
    wait_until(lambda: App.ActiveDocument is not None and infills(App.ActiveDocument), 60)
    obj = infills(App.ActiveDocument)[0]
    wait_until(lambda: obj.Mesh.CountFacets, 60)
    select(obj)
    click(toolbar_button("Check Mesh"))

    def report():
        found = Gui.getMainWindow().findChildren(QtGui.QDialog, "VolfrepReport")
        return next((window for window in found if window.isVisible()), None)

    check("the bracket has a report", wait_until(lambda: report() is not None, 60))
    text = report().text.toPlainText()
    check("it is without defects", "closed and without defects" in text, text)
    rows = text.replace(" ", "").replace("\n", "")
    check("no triangles cross", "trianglesthatcrossnone" in rows, text)
    picture("bracket_checked")
    view = Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view")
    said = view.toPlainText() if view is not None else ""
    check("nothing red is said", "Traceback" not in said, said)
    report().close()
    App.closeDocument(obj.Document.Name)


run(drive, "reach")
