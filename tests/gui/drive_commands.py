# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drives every other command in the real FreeCAD with real clicks and keys; see tools/run_gui.sh.

Writes pictures (among them those of the tutorial) and ``commands.json`` to GUI_OUT and leaves with
0 when every check held.
"""

import json
import shutil
import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    OUT,
    answer_file_dialog,
    answer_panel,
    check,
    click,
    click_item,
    click_menu,
    context_menu,
    costly,
    drawn_share,
    figures,
    infills,
    mark,
    move_mouse,
    panel,
    panel_part,
    picture,
    press_button,
    previews,
    run_checks,
    said,
    select,
    settle,
    shades,
    show_model,
    slow,
    toolbar_button,
    type_value,
    wait_until,
    window,
    xdotool,
)

from freecad_volfrep.compat import version

HOME = "VolfrepWorkbench"
#: Of the files that are typed into dialogs: pictures of it go into the documentation.
FOLDER = OUT / "typed"
# A dialog asks before it replaces a file, and no one would answer.
shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir()


def filled():
    """A document with a box that has a lattice, and an empty report view."""
    made = new_infill.filled("Tutorial")
    show_report_view()
    return made


def filled_but_the_box():
    """The same for checks that do not look at the box."""
    doc, _, obj = filled()
    return doc, obj


def show_report_view():
    """The report view in front and empty, so that pictures show what is said."""
    for dock in Gui.getMainWindow().findChildren(QtGui.QDockWidget):
        if dock.objectName() == "Report view":
            dock.show()
            dock.raise_()
    Gui.getMainWindow().findChild(QtGui.QTextEdit, "Report view").clear()


def button_of(dialog, name):
    """A button of a window."""
    return dialog.findChild(QtGui.QPushButton, name)


def close(name):
    """Really click a window's Close, and see it go."""
    click(button_of(window(name), "Close"))
    check(f"{name} closes", wait_until(lambda: window(name) is None))


def every_command_is_known():
    """FreeCAD knows each, with icon, texts and a help page; no shortcut of its own is taken."""
    from freecad_volfrep.gui.commands.table import COMMANDS

    others = {}
    for name in Gui.Command.listAll():
        keys = Gui.Command.get(name).getShortcut()
        if keys and not name.startswith("VOLFREP_"):
            others.setdefault(keys, name)
    figures["shortcuts of FreeCAD's looked at"] = len(others)
    for name in COMMANDS:
        info = Gui.Command.get(name).getInfo()
        keys = Gui.Command.get(name).getShortcut()
        check(f"{name} has its texts", info["menuText"] and info["toolTip"] and info["statusTip"])
        check(f"{name} has an icon", Path(info["pixmap"]).is_file(), info["pixmap"])
        check(f"{name} names its help page", info["whatsThis"].endswith(f"{name}.md"))
        check(f"{name} has a shortcut of its own", keys not in others, others.get(keys))
    ours = [Gui.Command.get(name).getShortcut() for name in COMMANDS]
    ours = [keys for keys in ours if keys]
    check("no two have the same shortcut", len(set(ours)) == len(ours), ours)


def the_commands_without_a_document():
    """Only what needs no document can be used."""
    for name, active in (("Preview Only", False), ("Check Mesh", False), ("Statistics", False),
                         ("Cell Library", True)):  # fmt: skip
        check(f"{name} without a document", toolbar_button(name).isEnabled() == active)


@slow
def fill_a_box():
    """The tutorial's first steps: select a box, fill it by way of the panel."""
    doc, box = new_infill.boxed("Tutorial")
    select(box)
    picture("tutorial_1_select")
    mark("tutorial_1_select", toolbar_button("Lattice Infill"))
    click(toolbar_button("Lattice Infill"))
    check("the panel opens", wait_until(lambda: panel() is not None))
    type_value("CellSize", "10 mm")
    type_value("StrutRadius", "1 mm")
    picture("tutorial_2_panel")
    buttons = Gui.getMainWindow().findChildren(QtGui.QPushButton)
    fields = [panel_part("CellSize"), panel_part("StrutRadius")]
    mark("tutorial_2_panel", *fields, *(b for b in buttons if b.isVisible() and "OK" in b.text()))
    check("the panel's preview is in the picture", drawn_share("tutorial_2_panel") > 0.1)
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: panel() is None))
    obj = infills(doc)[0]
    check("the box is filled", obj.isValid() and obj.Mesh.isSolid(), obj.Status)
    select()
    picture("tutorial_4_computed")


@slow
def preview_without_a_mesh(doc, box, obj):
    """Preview Only shows struts and figures, follows the values, and goes as it came."""
    obj.AutoUpdate = False
    obj.StrutRadius = 0.8
    doc.recompute()
    select(obj)
    triangles = obj.Mesh.CountFacets
    button = toolbar_button("Preview Only")
    check("a preview is offered", button.isEnabled())
    click(button)
    check("the preview shows", wait_until(lambda: previews() == 1), previews())
    check("no mesh was made", obj.Mesh.CountFacets == triangles and "Out of date" in obj.Status)
    check("its figures are in the report view", "active cells" in said(), said())
    check("the mesh makes room", not obj.ViewObject.isVisible())
    picture("preview_only")
    share = drawn_share("preview_only")
    check("the picture shows the struts", share > 0.1, share)
    figures_before = said().count("active cells")
    obj.StrutRadius = 1
    check("it follows a value", wait_until(lambda: said().count("active cells") > figures_before))
    click(button)
    check("once more takes it away", wait_until(lambda: previews() == 0), previews())
    check("the mesh is back", obj.ViewObject.isVisible() and not box.ViewObject.isVisible())
    click(button)
    wait_until(lambda: previews() == 1)
    obj.StrutRadius = 1.1
    click(toolbar_button("Update Lattice Infill"))
    check("a mesh ends the preview", wait_until(lambda: previews() == 0), previews())
    check("the new mesh shows", obj.Mesh.CountFacets != triangles and obj.ViewObject.isVisible())
    obj.AutoUpdate = True


def property_editor():
    """FreeCAD's table of data properties."""
    kind = "Gui::PropertyEditor::PropertyEditor"
    found = Gui.getMainWindow().findChildren(QtGui.QTreeView)
    return next(e for e in found if e.metaObject().className() == kind and e.isVisible())


def is_in(editor, widget):
    """Whether a widget is part of the editor."""
    return widget is not None and editor.isAncestorOf(widget)


def row_of(editor, name):
    """Where a property's value stands in the editor."""
    model = editor.model()

    def search(parent):
        for row in range(model.rowCount(parent)):
            index = model.index(row, 0, parent)
            if model.data(index, QtCore.Qt.DisplayRole) == name:
                return model.index(row, 1, parent)
            below = search(index)
            if below is not None:
                return below
        return None

    return search(QtCore.QModelIndex())


@slow
def type_a_radius(doc, obj):
    """A radius that is typed into the property editor makes a new mesh, once."""
    from freecad_volfrep.gui.jobs import progress

    quick, progress.SHOW_AFTER = progress.SHOW_AFTER, 0  # the bar must not take the editor's focus
    try:
        type_it(doc, obj)
    finally:
        progress.SHOW_AFTER = quick


def type_it(doc, obj):
    """What is typed, and what comes of it."""
    show_model()
    select(obj)
    facets, volume = obj.Mesh.CountFacets, obj.Volume.Value
    editor = property_editor()
    wait_until(lambda: row_of(editor, "Strut Radius") is not None)
    index = row_of(editor, "Strut Radius")
    editor.scrollTo(index)
    settle()
    move_mouse(editor.viewport().mapToGlobal(editor.visualRect(index).center()))
    press_button("--repeat", 2, "--delay", 80)
    wait_until(lambda: is_in(editor, QtGui.QApplication.focusWidget()))
    settle()
    xdotool("key", "ctrl+a")
    xdotool("type", "1.3 mm")
    picture("property_typed")
    xdotool("key", "Return")
    check("a typed radius is set", wait_until(lambda: abs(obj.StrutRadius.Value - 1.3) < 1e-9))
    wait_until(lambda: obj.Volume.Value != volume)
    check("and makes a new mesh", obj.Mesh.CountFacets != facets and obj.isValid(), obj.Status)
    check("with more material", obj.Volume.Value > volume)
    check("no recompute ran inside another", "Recursive" not in said(), said())
    picture("property_recomputed")
    check(
        "the picture shows the lattice: property_recomputed",
        drawn_share("property_recomputed") > 0.1,
        drawn_share("property_recomputed"),
    )


@costly
def check_the_mesh(doc, obj):
    """Check Mesh reports on a good mesh; what it says can be copied and saved."""
    select(obj)
    click(toolbar_button("Check Mesh"))
    check("the report opens", wait_until(lambda: window("VolfrepReport") is not None))
    report = window("VolfrepReport")
    check("and keeps nobody waiting", not report.isModal())
    text = report.text.toPlainText()
    check("the mesh is fine", "closed and without defects" in text, text)
    for figure in (
        "genus",
        "smallest angle",
        "every place inside is enclosed once",
        "every triangle keeps its corners",
        "triangles that cross",
    ):
        check(f"the report tells: {figure}", figure in text, text)
    picture("check_mesh")
    mark("check_mesh", toolbar_button("Check Mesh"))
    check(
        "the picture shows the window: check_mesh",
        shades("check_mesh", report) > 20,
        shades("check_mesh", report),
    )
    QtGui.QApplication.clipboard().clear()
    click(button_of(report, "Copy"))
    check("it is on the clipboard", "genus" in QtGui.QApplication.clipboard().text())
    path = FOLDER / "check.csv"
    answer_file_dialog(path, "save_report")
    click(button_of(report, "Save..."))
    check("it is saved", wait_until(path.is_file))
    check("with its figures", path.is_file() and "genus" in path.read_text())
    close("VolfrepReport")


def check_a_broken_mesh():
    """Check Mesh takes any mesh and says what is wrong with it."""
    import Mesh

    doc = App.newDocument("Broken")
    one, two = Mesh.createBox(10, 10, 10), Mesh.createBox(10, 10, 10)
    two.translate(3, 3, 3)
    one.addMesh(two)
    crossing = doc.addObject("Mesh::Feature", "Crossing")
    crossing.Mesh = one
    doc.recompute()
    select(crossing)
    click(toolbar_button("Check Mesh"))
    wait_until(lambda: window("VolfrepReport") is not None)
    text = window("VolfrepReport").text.toPlainText()
    check("crossing surfaces are found", "mm3 enclosed more than once" in text, text)
    check("and triangles that cross", "pairs, first near" in text, text)
    check("it is not called ready", "has defects" in text, text)
    close("VolfrepReport")
    doc.removeObject(crossing.Name)


@costly
def read_the_statistics(doc, obj):
    """Statistics are those of all infills where none is selected."""
    select()
    click(toolbar_button("Statistics"))
    check("statistics open", wait_until(lambda: window("VolfrepReport") is not None))
    text = window("VolfrepReport").text.toPlainText()
    for figure in ("joints", "relative density", "What the lattice does", "E along [111]",
                   "strength", "Seconds by stage", "Peak memory"):  # fmt: skip
        check(f"statistics tell: {figure}", figure in text, text)
    check("of this infill", obj.Label in text and f"{obj.Triangles:,}" in text, text)
    picture("statistics")
    check(
        "the picture shows the window: statistics",
        shades("statistics", window("VolfrepReport")) > 20,
        shades("statistics", window("VolfrepReport")),
    )
    path = FOLDER / "statistics.csv"
    answer_file_dialog(path, "save_statistics")
    click(button_of(window("VolfrepReport"), "Save..."))
    check("statistics are saved", wait_until(path.is_file))
    check("as plain numbers", path.is_file() and f"triangles,{obj.Triangles}" in path.read_text())
    close("VolfrepReport")


def draw_a_cell(doc):
    """A cube's edges and one diagonal of its body, as sketches cannot draw but wires can."""
    import Part

    cube = doc.addObject("Part::Feature", "Cube")
    cube.Shape = Part.makeBox(8, 8, 8)
    diagonal = doc.addObject("Part::Feature", "Diagonal")
    diagonal.Shape = Part.makeLine((0, 0, 0), (8, 8, 8))
    arc = doc.addObject("Part::Feature", "Arc")
    arc.Shape = Part.makeCircle(4)
    doc.recompute()
    return cube, diagonal, arc


def read_what_a_cell_does(library):
    """The figures of the picked cell follow size, radius and material at once."""
    does = library.findChild(QtGui.QLabel, "Properties")
    told = does.text()
    check("what the cell does is told", "E along [100]" in told and "E of the solid" in told, told)
    before = does.text()
    radius = library.findChild(QtGui.QWidget, "StrutRadius")
    click(radius)
    xdotool("key", "ctrl+a")
    xdotool("type", "0.7 mm")
    xdotool("key", "Tab")
    check("it follows the radius", wait_until(lambda: does.text() != before), before)
    material = library.findChild(QtGui.QComboBox, "Material")
    click(material)
    wait_until(lambda: material.view().isVisible())
    xdotool("type", "316L")
    xdotool("key", "Return")
    check("and the material", wait_until(lambda: "MPa" in does.text()), does.text())
    check("with its density", "g/cm3" in does.text(), does.text())


@slow
def compute_what_walls_do(doc, obj):
    """The library ships no figures of TPMS: they are computed at a click."""
    select(obj)
    click(toolbar_button("Cell Library"))
    wait_until(lambda: window("VolfrepCellLibrary") is not None)
    library = window("VolfrepCellLibrary")
    cells = library.findChild(QtGui.QListWidget, "Cells")
    use = library.findChild(QtGui.QComboBox, "Use")
    use.setCurrentIndex(use.findData("walls"))
    click_item(cells, cells.findItems("Schwarz P", QtCore.Qt.MatchExactly)[0])
    click(library.findChild(QtGui.QPushButton, "ComputeProperties"))
    does = library.findChild(QtGui.QLabel, "Properties")
    check(
        "what they do is computed", wait_until(lambda: "E along [100]" in does.text()), does.text()
    )
    picture("cell_library_walls")
    close("VolfrepCellLibrary")


@costly
def use_the_cell_library(doc, obj):
    """The library shows cells, refuses wrong ones, makes one of a drawing, and applies it."""
    select(obj)
    click(toolbar_button("Cell Library"))
    check("the library opens", wait_until(lambda: window("VolfrepCellLibrary") is not None))
    library = window("VolfrepCellLibrary")
    # Its layout's, with what a desktop puts around it: a screen of 800 has room for it.
    check(
        "it fits a low screen", library.minimumSizeHint().height() <= 720, library.minimumSizeHint()
    )
    cells = library.findChild(QtGui.QListWidget, "Cells")
    note = library.findChild(QtGui.QLabel, "Note")
    told = library.findChild(QtGui.QLabel, "Figures")
    from volfrep.design.cells import LIBRARY
    from volfrep.design.tpms import SURFACES

    listed = len(LIBRARY) + len(SURFACES)
    check("with the library's cells and walls", cells.count() == listed, cells.count())
    check("the infill's is picked", cells.currentItem().text() == "CVC")
    use = library.findChild(QtGui.QComboBox, "Use")
    use.setCurrentIndex(use.findData("auxetic"))
    shown = [cells.item(k).text() for k in range(cells.count()) if not cells.item(k).isHidden()]
    check("one use shows its cells", shown == ["Re-entrant"], shown)
    check("the first of them is picked", "Auxetic" in told.text(), told.text())
    picture("cell_library_auxetic")
    use.setCurrentIndex(use.findData("walls"))
    check("walls are a use of their own", cells.currentItem().text() == "Gyroid", told.text())
    check("no file is made of them", not button_of(library, "Save As...").isEnabled())
    thickness = library.findChild(QtGui.QWidget, "WallThickness")
    check("they have a thickness in place of a radius", thickness.isVisible())
    use.setCurrentIndex(0)
    click_item(cells, cells.findItems("Octet", QtCore.Qt.MatchExactly)[0])
    check("a click shows its figures", wait_until(lambda: "stretching" in told.text()))
    read_what_a_cell_does(library)
    picture("cell_library")
    check(
        "the picture shows the window: cell_library",
        shades("cell_library", library) > 20,
        shades("cell_library", library),
    )
    bad = FOLDER / "bad.json"
    bad.write_text(json.dumps({"nodes": [[0, 0, 0], [1, 1, 2]], "struts": [[0, 1]]}))
    answer_file_dialog(bad, "cell_load")
    click(button_of(library, "Load..."))
    check("a wrong cell is refused", wait_until(lambda: "node 1 lies outside" in note.text()),
          note.text())  # fmt: skip
    picture("cell_refused")
    check(
        "the picture shows the window: cell_refused",
        shades("cell_refused", library) > 20,
        shades("cell_refused", library),
    )
    cube, diagonal, arc = draw_a_cell(doc)
    select(cube, arc)
    click(button_of(library, "From Selection"))
    check("an arc is no strut", "Edge1 of 'Arc' cannot be a strut, it is a circle" in note.text(),
          note.text())  # fmt: skip
    select(cube, diagonal)
    click(button_of(library, "From Selection"))
    check(
        "a drawing is a cell",
        cells.count() == listed + 1 and cells.currentItem().text() == "Cube",
    )
    check("its size is told", "L = 8 mm" in note.text(), note.text())
    check("its struts are counted", "13" in told.text(), told.text())
    picture("cell_drawn")
    check(
        "the picture shows the window: cell_drawn",
        shades("cell_drawn", library) > 20,
        shades("cell_drawn", library),
    )
    select(obj)
    path = FOLDER / "cube.json"
    answer_file_dialog(path, "cell_save")
    click(button_of(library, "Apply"))
    check("to apply it saves it first", wait_until(path.is_file))
    wait_until(lambda: obj.CellType == "Custom" and obj.isValid())
    check("the infill has the cell", obj.CellType == "Custom" and obj.CellFile == str(path))
    check("and is computed", obj.isValid() and obj.Mesh.isSolid(), obj.Status)
    check("the library says so", "Up to date" in note.text(), note.text())
    picture("cell_applied")
    check(
        "the picture shows the window: cell_applied",
        shades("cell_applied", library) > 20,
        shades("cell_applied", library),
    )
    for item in cells.findItems("CVC", QtCore.Qt.MatchExactly):
        cells.setCurrentItem(item)
    click(button_of(library, "Apply"))
    wait_until(lambda: obj.CellType == "CVC")
    check("a cell of the library can be applied", obj.CellType == "CVC" and obj.isValid())
    close("VolfrepCellLibrary")
    obj.AutoUpdate, obj.CellFile, obj.CellType = False, str(bad), "Custom"
    click(toolbar_button("Cell Library"))
    wait_until(lambda: window("VolfrepCellLibrary") is not None)
    note = window("VolfrepCellLibrary").findChild(QtGui.QLabel, "Note")
    check("what is wrong with the infill's own cell is told", "node 1 lies" in note.text())
    close("VolfrepCellLibrary")
    obj.CellFile, obj.CellType, obj.AutoUpdate = "", "CVC", True
    doc.recompute()
    for part in (cube, diagonal, arc):
        doc.removeObject(part.Name)


def export_by_typing_a_name(doc, obj):
    """A name typed into the dialog is the file's."""
    path = FOLDER / "typed.stl"
    select(obj)
    mark("export", toolbar_button("Export Lattice"))
    answer_file_dialog(path.with_suffix(""), "export")
    click(toolbar_button("Export Lattice"))
    check("the file is written", wait_until(path.is_file), list(FOLDER.iterdir()))
    size = path.stat().st_size if path.is_file() else 0
    check("with every triangle", size == 84 + 50 * obj.Mesh.CountFacets, size)
    check("it is told", wait_until(lambda: "typed.stl written" in told()), told())


def told():
    """What FreeCAD's status bar says; from 1.0 on messages are in the report view alone, and a
    notification shows what is wrong."""
    if version() >= (1, 0):
        return said()
    return Gui.getMainWindow().statusBar().currentMessage()


def menu_of(doc, obj):
    """Texts of the tree's context menu of an object, by a real right click; VOLFREP's apart."""
    texts, ours = [], []

    def read(menu):
        for action in menu.actions():
            texts.append(action.text().replace("&", ""))
            if action.menu() is not None and texts[-1] == "VOLFREP":
                ours.extend(a.text().replace("&", "") for a in action.menu().actions())
        picture(f"menu_{obj.Name}")

    context_menu(obj, read)
    return texts, ours


@costly
def look_at_the_context_menus(doc, box, obj):
    """The tree offers what applies, and nothing else, in our workbench and in others."""
    texts, ours = menu_of(doc, obj)
    check("the infill's menu has ours", texts.count("VOLFREP") == 1, texts)
    for name in ("Update Lattice Infill", "Preview Only", "Check Mesh", "Statistics",
                 "Export Lattice"):  # fmt: skip
        check(f"it offers {name}", name in ours, ours)
    check("it does not offer what does not apply", "Open Faces" not in ours, ours)
    _, ours = menu_of(doc, box)
    check("the solid's menu offers to fill", "Lattice Infill" in ours, ours)
    check("and nothing of an infill", "Update Lattice Infill" not in ours, ours)
    Gui.activateWorkbench("PartWorkbench")
    settle()
    texts, ours = menu_of(doc, obj)
    check("in another workbench, too", "Update Lattice Infill" in ours, texts)
    Gui.activateWorkbench(HOME)
    settle()


def tell_errors_without_a_box(doc, obj):
    """An error that only informs is in the status bar and the report view."""
    before = obj.ShellThickness.Value
    obj.AutoUpdate = False
    obj.ShellThickness = 30
    select(obj)
    click(toolbar_button("Preview Only"))
    settle()
    check("no box asks to be closed", QtGui.QApplication.activeModalWidget() is None)
    check("what is wrong is told", "inside the skin" in told(), told())
    check("so does the report view", "inside the skin" in said())
    check("nothing is previewed", previews() == 0)
    picture("error_told")
    obj.ShellThickness = before
    obj.AutoUpdate = True
    doc.recompute()
    Gui.activeDocument().setEdit(obj.Name)
    check("the panel opens", wait_until(lambda: panel() is not None))
    settle()
    check("no command while it is open", not toolbar_button("Check Mesh").isEnabled())
    answer_panel("Cancel")
    wait_until(lambda: panel() is None)


def menu_action(*texts):
    """An entry of FreeCAD's menu bar by the texts on the way to it."""
    actions = Gui.getMainWindow().menuBar().actions()
    for text in texts:
        action = next(a for a in actions if a.text().replace("&", "") == text)
        actions = action.menu().actions() if action.menu() is not None else []
    return action


class Opened(QtCore.QObject):
    """Takes the addresses that FreeCAD asks the desktop to open."""

    def __init__(self):
        super().__init__()
        self.addresses = []

    @QtCore.Slot("QUrl")
    def take(self, address):
        """Note one."""
        self.addresses.append(address.toString())


def ask_whats_this():
    """FreeCAD's What's This on a button opens the page of its command, or of its first one."""
    opened = Opened()
    # FreeCAD 1.0 leaves the scheme out.
    for scheme in ("file", ""):
        QtGui.QDesktopServices.setUrlHandler(scheme, opened, "take")
    try:
        QtGui.QWhatsThis.enterWhatsThisMode()
        wait_until(QtGui.QWhatsThis.inWhatsThisMode)
        click(toolbar_button("Cell Library").button)
        wait_until(lambda: opened.addresses)
    finally:
        for scheme in ("file", ""):
            QtGui.QDesktopServices.unsetUrlHandler(scheme)
    page = opened.addresses and Path(QtCore.QUrl(opened.addresses[0]).path())
    check("What's This opens a page", page and page.name == "VOLFREP_CellLibrary.md", page)
    check("that is there", page and page.is_file(), page)


def take_away_what_is_previewed(doc, obj):
    """A preview goes with its infill and with its document, and shows the solid again."""
    from freecad_volfrep.gui.view.preview_only import toggle_preview

    base = obj.Base
    base.Visibility = True
    toggle_preview(obj)
    settle()
    check("the solid is hidden", not base.ViewObject.isVisible())
    doc.removeObject(obj.Name)
    check("an infill that goes takes its preview along", previews() == 0, previews())
    check("and its solid shows", base.ViewObject.isVisible())
    doc.undo()
    again = infills(doc)[0]
    toggle_preview(again)
    settle()
    check("it can be previewed again", previews() == 1, previews())
    App.closeDocument(doc.Name)
    settle()
    check("a document that is closed raises nothing", "Traceback" not in said(), said())


def read_the_help():
    """The help window shows the index, and a link leads to a command's page."""
    menu_action("VOLFREP", "VOLFREP Help").trigger()
    check("the help opens", wait_until(lambda: window("VolfrepHelp") is not None))
    settle()
    text = window("VolfrepHelp").findChild(QtGui.QTextBrowser)
    check("with its index", "Preview Only" in text.toPlainText(), text.toPlainText()[:200])
    picture("help")
    check(
        "the picture shows the window: help",
        shades("help", window("VolfrepHelp")) > 20,
        shades("help", window("VolfrepHelp")),
    )
    window("VolfrepHelp").close()


@slow
def open_the_bracket():
    """Its entry of Examples opens it, computed."""
    opened_example("Bracket")


@slow
def open_the_piston_rod():
    """So does its entry."""
    opened_example("Piston Rod")


def opened_example(entry):
    """What a real click on an entry of Examples opens: a document with a part and its lattice."""
    click_menu("VOLFREP", "Examples", entry)
    wait_until(lambda: App.ActiveDocument is not None and infills(App.ActiveDocument))
    check("one document opens", len(App.listDocuments()) == 1, App.listDocuments())
    found = infills(App.ActiveDocument)
    wait_until(lambda: found[0].Mesh.CountFacets)
    settle()
    check("with one infill", len(found) == 1)
    check("computed", found[0].isValid() and found[0].Mesh.isSolid())
    check("it is what shows", not found[0].Base.ViewObject.isVisible())
    figures[f"{entry}: seconds"] = round(found[0].Seconds, 2)
    figures[f"{entry}: triangles"] = found[0].Triangles
    name = f"example_{entry.lower().replace(' ', '_')}"
    picture(name)
    share = drawn_share(name)
    check("the picture shows the lattice", share > 0.05, share)
    return found[0]


run_checks(
    "commands",
    {
        every_command_is_known: None,
        the_commands_without_a_document: None,
        fill_a_box: None,
        preview_without_a_mesh: filled,
        type_a_radius: filled_but_the_box,
        check_the_mesh: filled_but_the_box,
        check_a_broken_mesh: None,
        read_the_statistics: filled_but_the_box,
        compute_what_walls_do: filled_but_the_box,
        use_the_cell_library: filled_but_the_box,
        export_by_typing_a_name: filled_but_the_box,
        look_at_the_context_menus: filled,
        tell_errors_without_a_box: filled_but_the_box,
        ask_whats_this: None,
        read_the_help: None,
        take_away_what_is_previewed: filled_but_the_box,
        open_the_bracket: None,
        open_the_piston_rod: None,
    },
)
