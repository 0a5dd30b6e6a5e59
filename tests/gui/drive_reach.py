# SPDX-License-Identifier: LGPL-2.1-or-later
"""That every command is reached by mouse and keys, and what has lost its proxy is alive again.

In the real FreeCAD window; see tools/run_gui.sh. Leaves with 0 when every check held.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    OUT,
    PATIENCE,
    Watch,
    check,
    choose_in_context_menu,
    click,
    click_menu,
    costly,
    figures,
    infills,
    move_mouse,
    panel,
    picture,
    run_checks,
    said,
    section_docks,
    select,
    settle,
    slow,
    toolbar_button,
    view_3d,
    wait_until,
    xdotool,
)

FOLDER = Path(tempfile.mkdtemp(prefix="volfrep-"))
#: What FreeCAD without the workbench does with a document, once it is up.
ELSEWHERE = """
import os
import FreeCAD as App
from PySide import QtCore, QtGui
def main():
    doc = App.openDocument({path!r})
    obj = doc.LatticeInfill
    obj.StrutRadius = 0.8
    doc.recompute()
    doc.save()
    open({told!r}, 'w').write(f'PROXY {{obj.Proxy}} {{obj.Status}}')
    os._exit(0)
def main_once_there_is_a_window():
    import FreeCADGui as Gui
    if Gui.getMainWindow().isVisible():
        main()
    else:
        QtCore.QTimer.singleShot(50, main_once_there_is_a_window)
if {windows}:
    QtCore.QTimer.singleShot(50, main_once_there_is_a_window)
else:
    main()
"""


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
    from freecad_volfrep.gui.commands.table import COMMANDS, EXAMPLES, GROUPS

    bar = Gui.getMainWindow().menuBar()
    ours = [action for action in bar.actions() if action.text().replace("&", "") == "VOLFREP"]
    offered = texts_of(ours)
    figures["entries of the menu"] = len(offered)
    registered = [name for name in Gui.Command.listAll() if name.startswith("VOLFREP_")]
    check("every command is registered", set(registered) == {*COMMANDS, *GROUPS}, registered)
    for name in COMMANDS:
        text = COMMANDS[name].text
        check(f"{text} is in the menu once", offered.count(text) == 1, offered)
        if name not in (*EXAMPLES, "VOLFREP_Help"):
            button = toolbar_button(text)
            check(f"{text} has a button that is seen", button is not None and button.isVisible())


def filled():
    """An infill to work with."""
    _, _, obj = new_infill.filled("Reach", ShellThickness=2, Resolution=8)
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    settle()
    return (obj,)


def one_opens(how):
    """See a section open, and close it as its own button does."""
    check(how, wait_until(lambda: len(section_docks()) == 1))
    picture(f"section_{how.replace(' ', '_')}")
    for dock in section_docks():
        dock.close()
    wait_until(lambda: not section_docks())
    settle()


@costly
def open_sections(obj):
    """Section View by its button, the menu, the context menu of the tree, and its shortcut."""
    select(obj)
    click(toolbar_button("Section View"))
    label, obj.Label = obj.Label, "Another name"
    titles = ["Section of Another name"]
    check("its title follows the object's", wait_until(
        lambda: [dock.windowTitle() for dock in section_docks()] == titles))  # fmt: skip
    obj.Label = label
    one_opens("by its button")
    click_menu("VOLFREP", "Section View")
    one_opens("by the menu")
    choose_in_context_menu(obj, "VOLFREP", "Section View")
    one_opens("by the context menu")
    select(obj)
    view = view_3d()
    # Where nothing is that could be selected.
    move_mouse(view.mapToGlobal(view.rect().topLeft()) + QtCore.QPoint(15, 15))
    view.setFocus()
    settle()
    xdotool("key", "l", "n")
    one_opens("by its shortcut")
    Gui.activateWorkbench("PartWorkbench")
    choose_in_context_menu(obj, "VOLFREP", "Section View")
    one_opens("by the context menu elsewhere")


def view_state():
    """What hangs in the view, and whether its objects are seen."""
    if Gui.activeDocument() is None:
        return None
    shown = [obj.Name for obj in App.ActiveDocument.Objects if obj.Visibility]
    return Gui.activeDocument().activeView().getSceneGraph().getNumChildren(), shown


def answer_of(text):
    """Really click a command in the menu; what comes of it, in words, which is then closed."""
    doc, boxes = App.ActiveDocument, []

    def look():
        box = QtGui.QApplication.activeModalWidget()
        if box is not None and box.isVisible():
            boxes.append(f"box *{box.windowTitle() or box.text()}*")
            photograph(text)
            box.reject()
        return False

    labels = [one.Label for one in doc.Objects] if doc else []
    before, told, watch = view_state(), len(said()), Watch(look, f"a box of {text}")
    click_menu("VOLFREP", text)
    watch.stop()
    main = Gui.getMainWindow()
    found = boxes
    if Gui.Control.activeDialog():
        found.append("panel")
        photograph(text)
        buttons = [b for b in main.findChildren(QtGui.QPushButton) if b.isVisible()]
        texts = [b.text().replace("&", "") for b in buttons]
        click(buttons[texts.index("Cancel" if "Cancel" in texts else "Close")])
        wait_until(lambda: not Gui.Control.activeDialog())
    for window in main.findChildren(QtGui.QDialog) + main.findChildren(QtGui.QDockWidget):
        if window.objectName().startswith("Volfrep") and window.isVisible():
            found.append(f"window *{window.windowTitle()}*")
            photograph(text)
            outside = main.screen().geometry().united(window.frameGeometry())
            check(f"{window.windowTitle()} is on the screen", outside == main.screen().geometry(),
                  window.frameGeometry())  # fmt: skip
            window.close()
    settle()
    found += [f"object *{one.Label}*" for one in (doc.Objects if doc else [])
              if one.Label not in labels]  # fmt: skip
    if not found and view_state() != before:
        photograph(text)
        found.append("shown in the view")
    if not found and said()[told:].strip():
        found.append("said in the report view")
    return ", ".join(dict.fromkeys(found))


def photograph(text):
    """A picture of what a command of the menu shows."""
    picture(f"menu_{text.replace(' ', '_').lower()}")


@slow
def click_every_entry_of_the_menu(obj):
    """With a lattice selected, and with nothing: a box, a panel, a result, or why it is greyed."""
    from freecad_volfrep.gui.commands.table import COMMANDS, EXAMPLES

    doc, table = obj.Document, {}
    for name, command in COMMANDS.items():
        if name in EXAMPLES:
            continue
        table[command.text] = {}
        for given in ("a lattice", "nothing"):
            App.setActiveDocument(doc.Name)
            select(*([obj] if given == "a lattice" else []))
            told = len(said())
            (entry,) = Gui.Command.get(name).getAction()
            if entry.isEnabled():
                seen = answer_of(command.text)
            else:
                seen = f"grey: {entry.statusTip().rpartition(chr(0x2192))[2].strip()}"
            table[command.text][given] = seen
            print(f"{command.text} | {given} | {seen}", file=sys.__stdout__, flush=True)
            check(f"{command.text} answers with {given} selected", seen not in ("", "grey: "))
            check("nothing is raised", "Traceback" not in said()[told:], said()[told:][-500:])
            if not is_alive(obj):
                check(f"{command.text} leaves the lattice", False)
                return
    (OUT / "menu.json").write_text(
        json.dumps({"FreeCAD": ".".join(App.Version()[:2]), "seen": table}, indent=1),
        encoding="utf-8",
    )


def is_alive(obj):
    """Whether an object is still in its document."""
    try:
        return bool(obj.Name)
    except ReferenceError:
        return False


@slow
def revive_what_windows_have_saved(obj):
    """A FreeCAD without the workbench saves it, with windows: it lives here again."""
    revive_what_was_saved_elsewhere(obj, True)


@slow
def revive_what_no_window_has_saved(obj):
    """The same of a FreeCAD without windows, in which views are lost."""
    revive_what_was_saved_elsewhere(obj, False)


def revive_what_was_saved_elsewhere(obj, windows):
    """Saved by another FreeCAD and opened here it is an infill again, and follows its values."""
    doc, facets = obj.Document, obj.Mesh.CountFacets
    path = FOLDER / f"part{windows}.FCStd"
    doc.saveAs(str(path))
    App.closeDocument(doc.Name)
    script = FOLDER / "elsewhere.py"
    told = FOLDER / f"told{windows}.txt"
    script.write_text(ELSEWHERE.format(path=str(path), told=str(told), windows=windows))
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
        timeout=4 * PATIENCE,
    )
    dead = told.is_file() and told.read_text() == "PROXY None Up to date"
    check("there it is dead", dead, said)
    again = App.openDocument(str(path))
    settle()
    found = again.getObject("LatticeInfill")
    wait_until(lambda: found.Proxy is not None and found.ViewObject.Proxy is not None)
    settle()
    check("it is an infill again", infills(again) == [found])
    check("it says so", "without VOLFREP" in found.Status, found.Status)
    check("with its mesh", found.Mesh.CountFacets == facets)
    icon = found.ViewObject.Proxy.getIcon()
    check("with the icon of one to be updated", icon.endswith("lattice_infill_stale.svg"), icon)
    modes = found.ViewObject.listDisplayModes()
    for mode in ("Coarse", "Simplified", "Shaded"):
        found.ViewObject.DisplayMode = mode
        check(f"it can be shown {mode}", found.ViewObject.DisplayMode == mode, modes)
    picture("revived")
    select(found)
    check("it can be updated", toolbar_button("Update Lattice Infill").isEnabled())
    click_menu("Edit", Gui.Command.get("Std_Refresh").getInfo()["menuText"].replace("&", ""))
    wait_until(lambda: found.Status == "Up to date")
    check("a refresh follows what was changed", found.StrutRadii[0] < 0.81, found.StrutRadii)
    click(toolbar_button("Edit Lattice Infill"))
    check("it can be edited", wait_until(lambda: panel() is not None))
    picture("revived_panel")


run_checks(
    "reach",
    {
        every_command_can_be_reached: None,
        open_sections: filled,
        click_every_entry_of_the_menu: filled,
        revive_what_windows_have_saved: filled,
        revive_what_no_window_has_saved: filled,
    },
)
