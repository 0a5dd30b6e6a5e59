# SPDX-License-Identifier: LGPL-2.1-or-later
"""The animation of the README, a frame after the other, in the real window: tools/film.sh."""

import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    OUT,
    answer_panel,
    check,
    click,
    infills,
    panel,
    picture,
    run_checks,
    section_docks,
    select,
    settle,
    toolbar_button,
    type_value,
    wait_until,
)

#: The mesh may take so long, s.
MAKING = 120
#: Frames so far: name and how long it stays, hundredths of a second.
shown = []


def frame(hundredths):
    """The window as it is now, for so long."""
    name = f"film_{len(shown):02d}"
    picture(name)
    shown.append(f"{hundredths} {name}.png")
    (OUT / "film.txt").write_text("\n".join(shown) + "\n", encoding="utf-8")


def fill_the_bracket():
    """Select the bracket, set cells and radius with the preview, make it, cut it open, turn it."""
    from freecad_volfrep.examples import make_bracket

    doc = App.newDocument("Bracket")
    part = make_bracket(doc)
    doc.recompute()
    view = Gui.activeDocument().activeView()
    view.viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    select(part)
    frame(120)
    click(toolbar_button("Lattice Infill"))
    check("the panel opens", wait_until(lambda: panel() is not None))
    for name, value, wait in (
        ("CellSize", "24 mm", 120), ("CellSize", "18 mm", 80), ("CellSize", "14 mm", 120),
        ("StrutRadius", "2 mm", 80), ("StrutRadius", "1.2 mm", 120),
    ):  # fmt: skip
        type_value(name, value)
        settle()
        frame(wait)
    answer_panel("OK")
    check("the panel closes", wait_until(lambda: panel() is None, MAKING))
    obj = infills(doc)[0]
    wait_until(lambda: obj.Mesh.CountFacets, MAKING)
    check("the bracket is filled", obj.isValid() and obj.Mesh.isSolid(), obj.Status)
    select()
    frame(120)
    obj.ViewObject.DisplayMode = "Skin and Lattice"
    select(obj)
    click(toolbar_button("Section View"))
    settle()
    dock = section_docks()[0]
    select()
    dock.findChild(QtGui.QComboBox, "Axis").setCurrentText("Z")
    slider = dock.findChild(QtGui.QSlider, "Slider")
    for place in (920, 840, 760, 680, 600):
        slider.setValue(place)
        settle()
        frame(35)
    camera = view.getCameraNode()
    start = App.Rotation(*camera.orientation.getValue().getValue())
    for step in range(1, 9):
        turn = App.Rotation(App.Vector(0, 0, 1), 9 * step)
        camera.orientation.setValue(*turn.multiply(start).Q)
        Gui.SendMsgToActiveView("ViewFit")
        frame(30 if step < 8 else 200)


run_checks("film", {fill_the_bracket: None})
