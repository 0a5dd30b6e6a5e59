# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a first-time user stumbles over in panels and dialogs, in the real FreeCAD; see
tools/run_gui.sh."""

import re
import shutil
import sys
from pathlib import Path

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
    costly,
    figures,
    hover,
    in_sight,
    panel,
    panel_part,
    picture,
    run_checks,
    select,
    settle,
    slow,
    toolbar_button,
    type_value,
    wait_until,
    when_dialog,
    window,
    xdotool,
)
from new_infill import boxed, cancelled, opened

LONG = "an_import_with_a_label_of_a_length_that_every_unnamed_part_of_an_assembly_has"


def filled():
    """A document with a box that has a lattice."""
    doc, _, obj = new_infill.filled()
    return doc, obj


def scroll_over_fields(doc, box):
    """The wheel scrolls the panel, and changes a field only where one has clicked into it."""
    obj = opened(box)
    wheels = []

    class Seen(QtCore.QObject):
        def eventFilter(self, widget, event):  # noqa: N802
            if event.type() == QtCore.QEvent.Wheel:
                wheels.append(widget)
            return False

    seen = Seen()
    QtGui.QApplication.instance().installEventFilter(seen)
    try:
        for name in ("CellSize", "StrutRadius", "RadiusDrivenBy", "Boundary"):
            field, before = panel_part(name), getattr(obj, name)
            in_sight(field)
            if field.hasFocus():
                field.clearFocus()
            hover(field)
            wheels.clear()
            xdotool("click", 5)
            wait_until(lambda: wheels)
            settle()
            check(f"the wheel leaves {name}", getattr(obj, name) == before, getattr(obj, name))
        field, before = panel_part("CellSize"), obj.CellSize.Value
        click(field)
        wait_until(field.hasFocus)
        hover(field)
        xdotool("click", 5)
        check("one that was clicked into follows it", wait_until(
            lambda: obj.CellSize.Value != before))  # fmt: skip
    finally:
        QtGui.QApplication.instance().removeEventFilter(seen)
    cancelled()


def call_it_something_long(doc, box):
    """A long label widens no panel."""
    opened(box)
    narrow = panel().sizeHint().width(), panel().minimumSizeHint().width()
    cancelled()
    box.Label = LONG
    opened(box)
    type_value("ShellThickness", "12 mm")
    wide = panel().sizeHint().width(), panel().minimumSizeHint().width()
    check("the panel wants no more room", wide[1] <= narrow[1] and wide[0] <= narrow[0] + 8,
          (narrow, wide))  # fmt: skip
    check("its title has room", len(panel().windowTitle()) < 40, panel().windowTitle())
    area = next(a for a in Gui.getMainWindow().findChildren(QtGui.QScrollArea)
                if a.isAncestorOf(panel()))  # fmt: skip
    inside = panel_part("Compute").mapTo(area, panel_part("Compute").rect().topRight()).x()
    check("Compute is in sight", inside <= area.width(), (inside, area.width()))
    picture("manners_1_long_label")
    cancelled()


def bind_a_radius(doc, box):
    """The figures are those of what expressions say, as the mesh is."""
    obj = opened(box)
    type_value("CellSize", "10 mm")
    obj.setExpression("StrutRadius", "CellSize * 0.15")
    type_value("CellSize", "8 mm")
    check("the expression is followed", abs(obj.StrutRadius.Value - 1.2) < 1e-9, obj.StrutRadius)
    text = panel_part("Figures").text()
    told = float(re.search(r"relative density ([\d.]+) %", text).group(1))
    answer_panel("OK")
    wait_until(lambda: panel() is None)
    settle()
    made = 100 * obj.RelativeDensity
    figures["relative density told and made, %"] = told, round(made, 1)
    check("the figures are of the mesh", abs(told - made) < 0.1 * made, (told, made))


def ok_button():
    """The panel's OK."""
    buttons = Gui.getMainWindow().findChildren(QtGui.QPushButton)
    return next(b for b in buttons if b.isVisible() and b.text().replace("&", "") == "OK")


def type_what_makes_no_sense(doc, box):
    """OK waits for values that can be computed, and no figure is absurd."""
    opened(box)
    check("OK can be pressed", wait_until(lambda: ok_button().isEnabled()))
    type_value("ShellThickness", "12 mm")
    check("not with what is refused", wait_until(lambda: not ok_button().isEnabled()))
    type_value("CellSize", "10 mm")
    type_value("StrutRadius", "1 mm")
    type_value("ShellThickness", "9.9 mm")
    text = panel_part("Figures").text()
    told = float(re.search(r"relative density ([\d.,]+) %", text).group(1).replace(",", ""))
    check("no more than all is filled", told <= 100, text)
    check("no powers of ten", "e+" not in text, text)
    type_value("ShellThickness", "1 mm")
    check("OK can be pressed again", wait_until(lambda: ok_button().isEnabled()))
    cancelled()


@slow
def type_another_extension(doc, obj):
    """What is typed into the file dialog says more than the kind of file it stands at."""
    for suffix, what in ((".inp", "beams"), (".step", "plane faces")):
        path = OUT / f"typed{suffix}"
        path.unlink(missing_ok=True)
        select(obj)
        asked = []

        def answer(box, asked=asked):
            asked.append(box.text())
            place = box.button(QtGui.QMessageBox.Yes)
            point = place.mapToGlobal(place.rect().center())
            xdotool("mousemove", point.x(), point.y(), "click", 1)

        answer_file_dialog(path, f"manners_export{suffix}")
        when_dialog(QtGui.QMessageBox, answer)
        click(toolbar_button("Export Lattice"))
        check(f"{suffix} is written", wait_until(path.exists))
        settle()
        check("after a question of its size", asked and "MB" in asked[0], asked)
        figures[f"asked for {what}"] = asked


def export_layers(doc, obj):
    """A name with a picture's extension is a folder of layers, whose height is asked for."""
    from freecad_volfrep.gui.messages import LengthsBox

    folder = OUT / "typed_layers"
    shutil.rmtree(folder, ignore_errors=True)
    select(obj)
    asked = []

    def answer(box):
        spin = box.findChildren(QtGui.QLineEdit)[0]
        spin.setFocus()
        wait_until(spin.hasFocus)
        xdotool("key", "ctrl+a")
        xdotool("type", "0.5 mm")
        note = box.findChildren(QtGui.QLabel)[-1]
        wait_until(lambda: "of 0.5 mm" in note.text())
        asked.append(note.text())
        picture("manners_export_layers")
        click(box.findChild(QtGui.QDialogButtonBox).button(QtGui.QDialogButtonBox.Ok))

    answer_file_dialog(folder.with_suffix(".svg"), "manners_export.svg")
    when_dialog(LengthsBox, answer)
    click(toolbar_button("Export Lattice"))
    check("layers are written", wait_until((folder / "layers.json").exists), asked)
    settle()
    check("as many as was said", asked and asked[0].split(": ")[1].startswith(
        f"{len(list(folder.glob('*.svg')))} layers"), asked)  # fmt: skip


@costly
def read_many_notes(doc, obj):
    """Many sentences on a cell lie on nothing else in the Cell Library."""
    click(toolbar_button("Cell Library"))
    wait_until(lambda: window("VolfrepCellLibrary") is not None)
    library = window("VolfrepCellLibrary")
    library._note.say(
        "\n".join(f"Sentence {k} about what was drawn, and that is long." for k in range(40))
    )
    settle()
    picture("manners_2_library")
    notes, others = library._notes, (library._picture, library._figures, library._list)
    place = QtCore.QRect(notes.mapTo(library, QtCore.QPoint(0, 0)), notes.size())
    for other in others:
        rect = QtCore.QRect(other.mapTo(library, QtCore.QPoint(0, 0)), other.size())
        check("notes lie on nothing", not place.intersects(rect), (place, rect))
    click(library.findChild(QtGui.QPushButton, "Close"))
    wait_until(lambda: window("VolfrepCellLibrary") is None)


run_checks(
    "manners",
    {
        scroll_over_fields: boxed,
        call_it_something_long: boxed,
        bind_a_radius: boxed,
        type_what_makes_no_sense: boxed,
        type_another_extension: filled,
        export_layers: filled,
        read_many_notes: filled,
    },
)
