# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window in Italian and German, and in one of FreeCAD's dark themes: nothing is cut off."""

import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

from freecad_volfrep.gui.study.study_plot import COLOURS
from freecad_volfrep.gui.widgets.plot_colours import plot_colours

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    OUT,
    answer_panel,
    check,
    click,
    comes_true,
    costly,
    infills,
    lightness,
    panel,
    panel_part,
    picture,
    preferences_open,
    run_checks,
    said,
    select,
    settle,
    show_model,
    slow,
    told,
    turn_to,
    type_value,
    wait_until,
    window,
)

from freecad_volfrep.compat import version

GROUP = "User parameter:BaseApp/Preferences/Mod/VOLFREP"
#: What FreeCAD calls the language, and words that must then be seen.
LANGUAGES = {
    "Italian": ("Riempimento reticolare", "guscio", "Dimensione cella", "celle attive"),
    "German": ("Gitterfüllung", "Haut", "Zellgröße", "aktive Zellen"),
    "English": ("Lattice Infill", "skin", "Cell size", "active cells"),
}


def commands():
    """Tips of all our commands' buttons by their texts."""
    tips = {}
    for bar in Gui.getMainWindow().findChildren(QtGui.QToolBar):
        if bar.windowTitle().startswith("VOLFREP"):
            tips.update({a.text().replace("&", ""): a.toolTip() for a in bar.actions()})
    return tips


def cut_off(form):
    """Texts of a form's widgets that have less room than they need."""
    found = []
    is_panel = form.objectName().endswith("Panel")
    if is_panel and form.visibleRegion().boundingRect().width() < form.width():
        found.append(f"{form.objectName()} is {form.width()} wide and hangs over")
    for widget in form.findChildren(QtGui.QWidget):
        if isinstance(widget, (QtGui.QLabel, QtGui.QAbstractButton)) and widget.isVisible():
            needed = widget.minimumSizeHint()
            wraps = isinstance(widget, QtGui.QLabel) and widget.wordWrap()
            if widget.text() and not wraps and widget.width() < needed.width():
                found.append(f"{widget.text()}: {widget.width()} of {needed.width()}")
        elif isinstance(widget, QtGui.QComboBox) and widget.isVisible():
            option = QtGui.QStyleOptionComboBox()
            widget.initStyleOption(option)
            field = QtGui.QStyle.SC_ComboBoxEditField
            place = widget.style().subControlRect(QtGui.QStyle.CC_ComboBox, option, field, widget)
            needed = widget.fontMetrics().boundingRect(widget.currentText()).width()
            if place.width() < needed:
                found.append(f"{widget.currentText()}: {place.width()} of {needed}")
        elif isinstance(widget, QtGui.QAbstractSpinBox) and widget.isVisible():
            line = widget.findChild(QtGui.QLineEdit)
            # Qt leaves two pixels at either side, FreeCAD a place for its sign.
            signs = [sign for sign in line.findChildren(QtGui.QLabel) if sign.isVisible()]
            room = line.contentsRect().width() - sum(sign.width() for sign in signs) - 4
            text = max(line.text(), "10.00 mm" if line.text().endswith(" mm") else "", key=len)
            needed = line.fontMetrics().boundingRect(text).width()
            if room < needed:
                found.append(f"{text}: {room} of {needed}")
    return found


def speak(language, command, word, label, figure):
    """One language: toolbar, panel, preferences."""
    Gui.setLocale(language)
    settle()
    box = App.ActiveDocument.getObject("Block")
    check(f"{language}: the commands", word in commands().get(command, ""), commands())
    select(box)
    Gui.runCommand("VOLFREP_LatticeInfill", 0)
    check(f"{language}: the panel opens", wait_until(lambda: panel() is not None))
    obj = App.ActiveDocument.getObject("LatticeInfill")
    obj.RadiusGrading = "Direction"
    settle()
    labels = [widget.text() for widget in panel().findChildren(QtGui.QLabel)]
    check(f"{language}: the panel's labels", label in labels, labels)
    figures = panel().findChild(QtGui.QLabel, "Figures").text()
    check(f"{language}: its figures", figure in figures, figures)
    choice = panel().findChild(QtGui.QComboBox, "Activation")
    check(f"{language}: values stay what they are", choice.currentData() == "Touching")
    check(f"{language}: nothing is cut off in it", cut_off(panel()) == [], cut_off(panel()))
    picture(f"language_{language}_1_panel")
    refuse(language)
    choose_boundary(obj)
    leave(QtGui.QDialogButtonBox.Cancel)
    check(f"{language}: the panel closes", wait_until(lambda: panel() is None))
    other_panels(language)
    for_the_printer(language)
    preferences(language)


#: What begins a refusal of the engine, and what a mesh that is there is called.
SENTENCES = {
    "Italian": ("Nessuna asta di celle di 5 mm", "Aggiornato"),
    "German": ("Keine Strebe von Zellen von 5 mm", "Aktuell"),
    "English": ("No strut of cells of 5 mm", "Up to date"),
}


#: Of the line that the report view has of a mesh.
LINES = {"Italian": " celle su 192, ", "German": " von 192 Zellen, ", "English": " of 192 cells, "}


#: Of a slicer infill: how a line of the report view begins, and the object's name.
BANDS = {
    "Italian": ("pieno: ", "Block riempimento"),
    "German": ("massiv: ", "Block Füllung"),
    "English": ("solid: ", "Block infill"),
}
#: Of what a print check finds.
FOUND = {
    "Italian": (("asta più sottile", "2 mm (limite 2 mm)"), ("massa", "11,99 g")),
    "German": (("dünnste Strebe", "2 mm (Grenze 2 mm)"), ("Masse", "11,99 g")),
    "English": (("thinnest strut", "2 mm (limit 2 mm)"), ("mass", "11.99 g")),
}


def refuse(language):
    """What the engine refuses, and the state of a mesh, in the user's words."""
    refused, made = SENTENCES[language]
    type_value("ShellThickness", "15 mm")
    told_so = wait_until(lambda: told().startswith(refused))
    check(f"{language}: what is refused", told_so, told())
    type_value("ShellThickness", "1 mm")
    click(panel_part("Compute"))
    check(f"{language}: the mesh", wait_until(lambda: told().startswith(made)), told())
    check(f"{language}: the report view", LINES[language] in said(), said())
    figures = told().splitlines()[-1]
    check(f"{language}: and its figures", " g, " in figures and figures[0].isdigit(), figures)


def leave(answer):
    """Press a button of the open panel, whatever it is called."""
    boxes = Gui.getMainWindow().findChildren(QtGui.QDialogButtonBox)
    next(filter(None, (box.button(answer) for box in boxes if box.isVisible()))).click()
    settle()


def other_panels(language):
    """Those of sizing and of a study, whose buttons are as narrow as the tree."""
    from freecad_volfrep import make_lattice_infill

    doc = App.ActiveDocument
    obj = make_lattice_infill(doc, doc.Block, CellSize=10)
    for command, name, answer in (
        ("SizeLattice", "Size", QtGui.QDialogButtonBox.Cancel),
        ("DesignStudy", "Study", QtGui.QDialogButtonBox.Close),
    ):
        select(obj)
        Gui.runCommand(f"VOLFREP_{command}", 0)
        settle()
        found = Gui.getMainWindow().findChildren(QtGui.QWidget, f"Volfrep{name}Panel")
        form = next(widget for widget in found if widget.isVisible())
        check(f"{language}: nothing is cut off in {name}", cut_off(form) == [], cut_off(form))
        picture(f"language_{language}_4_{name}")
        leave(answer)
    doc.removeObject(obj.Name)
    settle()


def for_the_printer(language):
    """The windows of those who print: slicer infill, a file's limits, coupons, cells to find."""
    from freecad_volfrep import make_lattice_infill
    from freecad_volfrep.gui.cells.cell_finder import CellFinder
    from freecad_volfrep.gui.printing.coupon_box import CouponBox
    from freecad_volfrep.gui.printing.export_box import PrinterBox

    doc = App.ActiveDocument
    select(doc.Block)
    Gui.runCommand("VOLFREP_SlicerInfill", 0)
    wait_until(lambda: shown("VolfrepSlicerPanel") is not None)
    form = shown("VolfrepSlicerPanel")
    form.findChild(QtGui.QPushButton, "ShowBands").click()
    table = form.findChild(QtGui.QLabel, "BandTable")
    check(f"{language}: bands are cut", wait_until(lambda: table.text() != "", 60))
    settle()
    look(language, "5_slicer", form)
    area = next(a for a in Gui.getMainWindow().findChildren(QtGui.QScrollArea)
                if a.isAncestorOf(form))  # fmt: skip
    area.ensureWidgetVisible(table)
    line, label = BANDS[language]
    check(f"{language}: and told", any(one.startswith(line) for one in said().splitlines()))
    check(f"{language}: their object's name", any(one.Label == label for one in doc.Objects))
    picture(f"language_{language}_5_slicer_end")
    leave(QtGui.QDialogButtonBox.Cancel)
    obj = make_lattice_infill(doc, doc.Block, CellSize=10, Resolution=8)
    doc.recompute()
    select(obj)
    picture(f"language_{language}_9_result")
    Gui.runCommand("VOLFREP_PrintCheck", 0)
    wait_until(lambda: doc.getObject("PrintCheck") is not None)
    text = said().splitlines()
    for found in FOUND[language]:
        is_told = any(line.startswith(found[0]) and found[1] in line for line in text)
        check(f"{language}: what a print check finds: {found[1]}", is_told, text)
    picture(f"language_{language}_9_print_check")
    doc.removeObject("PrintCheck")
    select(obj)
    export = PrinterBox(obj)
    export.findChild(QtGui.QComboBox, "Service").setCurrentIndex(1)
    export.findChild(QtGui.QComboBox, "Printer").setCurrentIndex(1)
    for number, name, box in ((6, "export", export), (7, "coupons", CouponBox()),
                              (8, "find", CellFinder())):  # fmt: skip
        box.show()
        wait_until(box.isVisible)
        settle()
        look(language, f"{number}_{name}", box)
        box.close()
        box.deleteLater()
    doc.removeObject(obj.Name)
    settle()


def look(language, name, form):
    """Nothing of a form is cut off; its picture."""
    check(f"{language}: nothing is cut off in {name}", cut_off(form) == [], cut_off(form))
    picture(f"language_{language}_{name}")


def shown(name):
    """A panel of that name, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QWidget, name)
    return next((widget for widget in found if widget.isVisible()), None)


def choose_boundary(obj):
    """What is chosen in the user's words is set in the document's."""
    choice = panel().findChild(QtGui.QComboBox, "Boundary")
    choice.setCurrentIndex(choice.findData("Whole"))
    settle()
    check("a translated choice sets the plain value", obj.Boundary == "Whole", obj.Boundary)


def tables(language, word):
    """The window of figures says them in the user's words."""
    from freecad_volfrep import make_lattice_infill

    doc = App.ActiveDocument
    obj = make_lattice_infill(doc, doc.Block, CellSize=10, Resolution=10)
    doc.recompute()
    select(obj)
    Gui.runCommand("VOLFREP_Statistics", 0)
    wait_until(lambda: window("VolfrepReport") is not None)
    text = window("VolfrepReport").findChild(QtGui.QTextBrowser).toPlainText()
    check(f"{language}: the tables' names", word in text, text[:200])
    check(f"{language}: and what is in them", "Aktuell" in text and "Up to date" not in text, text)
    check(f"{language}: its numbers", "11.992" in text, text)
    picture(f"language_{language}_3_statistics")
    window("VolfrepReport").close()
    doc.removeObject(obj.Name)
    settle()


def preferences(language):
    """Both pages, with room for their words."""

    def look(dialog):
        for name in ("NewInfillPage", "DisplayPage"):
            page = dialog.findChild(QtGui.QWidget, name)
            turn_to(page, dialog)
            check(f"{language}: nothing is cut off in {name}", cut_off(page) == [], cut_off(page))
            picture(f"language_{language}_2_{name}")

    preferences_open(look, keep=False)


def wear_dark():
    """One of FreeCAD's own dark themes; returns what takes it off again."""
    application = QtGui.QApplication.instance()
    before = application.styleSheet()
    folder = Path(App.getResourceDir()) / "Gui" / "Stylesheets"
    sheets = sorted(folder.glob("*[Dd]ark*.qss"))
    group = App.ParamGet("User parameter:BaseApp/Preferences/MainWindow")
    worn = {name: group.GetString(name) for name in ("Theme", "StyleSheet")}
    # FreeCAD 1.1 has one style sheet, and its colours in a theme.
    group.SetString("Theme", "FreeCAD Dark")
    group.SetString("StyleSheet", sheets[0].name if sheets else "FreeCAD.qss")
    if version() < (1, 0) or not comes_true(lambda: application.styleSheet() != before, 10):
        application.setStyleSheet(sheets[0].read_text(encoding="utf-8"))

    def take_off():
        for name, value in worn.items():
            group.SetString(name, value)
        application.setStyleSheet(before)

    return take_off


def go_dark():
    """The panel in one of FreeCAD's own dark themes."""
    take_off = wear_dark()
    try:
        look_at_the_dark()
    finally:
        take_off()


def look_at_the_dark():
    """The panel, what it refuses, and the library."""
    settle()
    select(App.ActiveDocument.getObject("Block"))
    Gui.runCommand("VOLFREP_LatticeInfill", 0)
    wait_until(lambda: panel() is not None)
    obj = App.ActiveDocument.getObject("LatticeInfill")
    settle()
    check("dark: nothing is cut off", cut_off(panel()) == [], cut_off(panel()))
    picture("dark_1_panel")
    light = lightness("dark_1_panel", panel())
    check("dark: the panel is dark", light < 0.4, light)
    drawn_in = plot_colours(panel())
    paper = drawn_in.paper.lightnessF()
    dim = [name for name in COLOURS if abs(drawn_in.seen(name).lightnessF() - paper) < 0.2]
    check("dark: a plot's points are seen", dim == [], dim)
    obj.ShellThickness = 15
    panel().findChild(QtGui.QWidget, "Preview").click()
    settle()
    picture("dark_2_refused")
    answer_panel("Cancel")
    settle()
    Gui.runCommand("VOLFREP_CellLibrary", 0)
    wait_until(lambda: window("VolfrepCellLibrary") is not None)
    picture("dark_3_cells")
    click(window("VolfrepCellLibrary").findChild(QtGui.QPushButton, "Find..."))
    wait_until(lambda: window("VolfrepCellFinder") is not None)
    picture("dark_4_finder")
    light = lightness(
        "dark_4_finder", window("VolfrepCellFinder").findChild(QtGui.QWidget, "CellChart")
    )
    check("dark: the chart of cells is dark", light < 0.4, light)


def boxed():
    """A document with a box."""
    new_infill.boxed("Drive")
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    settle()
    return ()


def in_language(language):
    """The window in a language; it is left in English whatever comes of it."""
    try:
        speak(language, *LANGUAGES[language])
        if language == "German":
            tables(language, "Zellen des Rasters")
    finally:
        Gui.setLocale("English")


@slow
def italian():
    """The whole window in Italian."""
    in_language("Italian")


@slow
def german():
    """The whole window in German, and the tables."""
    in_language("German")


@slow
def english():
    """Back to the texts of the sources."""
    Gui.setLocale("German")
    settle()
    in_language("English")


@costly
def see_the_status():
    """The property editor says the status in the user's language; scripts and files keep theirs."""
    file = OUT / "status.FCStd"
    try:
        Gui.setLocale("German")
        doc, _, obj = new_infill.filled()
        select(obj)
        show_model()
        seen = wait_until(lambda: getattr(obj, "StatusShown", "") == "Aktuell")
        check("it is shown in German", seen, obj.PropertiesList)
        check("in its own group", obj.getGroupOfProperty("StatusShown") == "5 Result")
        check("and kept in English", obj.Status == "Up to date", obj.Status)
        check("nothing is to be recomputed for it", "Up-to-date" in obj.State, obj.State)
        picture("language_German_status")
        obj.StrutRadius = 1.2
        doc.recompute()
        settle()
        check("it follows", wait_until(lambda: obj.StatusShown == "Aktuell"), obj.StatusShown)
        doc.saveAs(str(file))
        settle()
        App.closeDocument(doc.Name)
        doc = App.openDocument(str(file))
        settle()
        obj = infills(doc)[0]
        again = wait_until(lambda: getattr(obj, "StatusShown", "") == "Aktuell")
        check("it is there again", again, obj.PropertiesList)
        check("and nothing to be saved for it", not Gui.getDocument(doc.Name).Modified)
        App.closeDocument(doc.Name)
    finally:
        Gui.setLocale("English")
    doc = App.openDocument(str(file))
    settle()
    obj = infills(doc)[0]
    check("English is English", "StatusShown" not in obj.PropertiesList, obj.PropertiesList)
    check("where nothing is to be saved", not Gui.getDocument(doc.Name).Modified)


run_checks(
    "languages",
    {
        see_the_status: None,
        italian: boxed,
        german: boxed,
        english: boxed,
        go_dark: boxed,
    },
)
