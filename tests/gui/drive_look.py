# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a computed part looks like in the real FreeCAD window; see tools/run_gui.sh.

The look is judged by pixels on an even background: skin, lattice and cut faces are there in their
colours, and nothing depends on the order in which triangles are drawn or on turning the view.
"""

import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np
from PySide import QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
import new_infill
from driving import (
    OUT,
    answer_panel,
    check,
    click,
    costly,
    figures,
    infills,
    look_along,
    look_at_all,
    panel,
    panel_part,
    picture,
    run_checks,
    section_docks,
    seen,
    select,
    settle,
    slow,
    toolbar_button,
    view_3d,
    wait_until,
)

GROUP = "User parameter:BaseApp/Preferences/Mod/VOLFREP"
VIEW = "User parameter:BaseApp/Preferences/View"
OURS = "Skin and Lattice"
#: A computed part fills so much of the view; of that, what must be seen of each colour.
LEAST_DRAWN, LEAST_LATTICE, LEAST_SKIN, LEAST_CUT = 0.05, 0.15, 0.10, 0.03
#: Pixels of two pictures that may differ: at borders that lie between two pixels.
STRAY = 0.002


def even_background():
    """White, so that a pixel's colour says what it is of."""
    group = App.ParamGet(VIEW)
    group.SetBool("Simple", True)
    group.SetBool("Gradient", False)
    group.SetUnsigned("BackgroundColor", 0xFFFFFFFF)


def pixels(name):
    """The middle of the 3D view in a picture: red, green and blue of every pixel."""
    image = seen(name, view_3d())
    height, width = image.shape[:2]
    part = image[int(0.08 * height) : int(0.92 * height), int(0.08 * width) : int(0.80 * width)]
    return part.reshape(-1, 3).astype(int)


def shares(name):
    """Shares of a picture: what is drawn, and of that the lattice, the skin, cut faces."""
    colours = pixels(name)
    drawn = colours[colours.min(axis=1) < 240]
    red, green, blue = drawn.T
    low, high = drawn.min(axis=1, initial=255), drawn.max(axis=1, initial=0)
    count = max(len(drawn), 1)
    found = {
        "drawn": len(drawn) / len(colours),
        "lattice": ((blue > 1.25 * red) & (blue > green)).sum() / count,
        "skin": ((high - low < 50) & (low > 90)).sum() / count,
        "cut": ((red > 200) & (red > 2.5 * blue)).sum() / count,
        "black": (high < 40).sum() / count,
    }
    figures[name] = {part: round(float(share), 3) for part, share in found.items()}
    return found


def differing(one, two):
    """Share of pixels that differ between two pictures."""
    return float((np.abs(pixels(one) - pixels(two)).max(axis=1) > 5).mean())


def looks_good(name, with_skin=True):
    """A picture of the whole part shows lattice and skin, and nothing is nearly black."""
    picture(name)
    found = shares(name)
    check(f"{name}: there is something", found["drawn"] > LEAST_DRAWN, found)
    check(f"{name}: the lattice has its colour", found["lattice"] > LEAST_LATTICE, found)
    check(f"{name}: nothing is nearly black", found["black"] < 0.01, found)
    if with_skin:
        check(f"{name}: the skin has its colour", found["skin"] > LEAST_SKIN, found)
        check(f"{name}: nothing is cut", found["cut"] < 0.001, found)


def reverse_order(node):
    """Have the triangles below a node drawn from the last to the first."""
    from pivy import coin

    search = coin.SoSearchAction()
    search.setType(coin.SoIndexedFaceSet.getClassTypeId())
    search.setInterest(coin.SoSearchAction.ALL)
    search.setSearchingAll(True)
    search.apply(node)
    done = set()
    for path in list(search.getPaths()):
        shape = path.getTail()
        if int(shape.this) in done:  # the same one is drawn in several ways
            continue
        done.add(int(shape.this))
        index = list(shape.coordIndex.getValues())
        rows = [index[k : k + 4] for k in range(0, len(index), 4)]
        shape.coordIndex.setValues(0, len(index), [v for row in reversed(rows) for v in row])
    return len(done)


def does_not_depend_on_order(obj, name):
    """The picture is the same with the triangles in another order, and after a whole turn."""
    view = Gui.activeDocument().activeView()
    # Two layers in the wrong order differ by the square of their opacity.
    transparency, obj.ViewObject.Transparency = obj.ViewObject.Transparency, 30
    picture(f"{name}_before")
    start = view.getCameraOrientation()
    for turned in range(1, 13):
        look_along(start * App.Rotation(App.Vector(0, 1, 0), 30 * turned))
        view.redraw()
    picture(f"{name}_turned")
    stray = differing(f"{name}_before", f"{name}_turned")
    check(f"{name}: a whole turn changes nothing", stray < STRAY, stray)
    look_along(start)
    mode = obj.ViewObject.DisplayMode
    shapes = reverse_order(obj.ViewObject.Proxy._modes[mode][0])
    check(f"{name}: there are shapes to turn round", shapes >= 2, shapes)
    view.redraw()
    picture(f"{name}_reversed")
    stray = differing(f"{name}_before", f"{name}_reversed")
    check(f"{name}: neither does the order of its triangles", stray < STRAY, stray)
    figures[f"{name}: pixels that differ"] = stray
    obj.ViewObject.Transparency = transparency


def button(name):
    """A push button of the panel."""
    return panel_part(name, QtGui.QPushButton)


def boxed():
    """A document with a box, before white."""
    even_background()
    return new_infill.boxed("Look")


def filled():
    """The same with a lattice."""
    even_background()
    doc, _, obj = new_infill.filled("Look", ShellThickness=1.5, Deviation=0.01)
    return doc, obj


@slow
def fill_a_box(doc, box):
    """From a box by clicks to a part that is computed, cutting it open on the way."""
    select(box)
    click(toolbar_button("Lattice Infill"))
    wait_until(lambda: panel() is not None)
    settle()
    obj = infills(doc)[0]
    obj.CellSize, obj.StrutRadius, obj.ShellThickness = 10, 1, 1.5
    obj.Deviation = 0.01
    panel_part("Preview").toggle()
    panel_part("Preview").toggle()
    settle()
    looks_good("look_1_preview")
    click(button("Section"))
    check("one click cuts the preview open", wait_until(section_docks))
    picture("look_2_preview_cut")
    check("it shows what is cut", shares("look_2_preview_cut")["cut"] > LEAST_CUT / 3)
    click(button("Compute"))
    wait_until(lambda: obj.Mesh.CountFacets)
    check("it is still cut open", section_docks())
    picture("look_3_result_cut")
    found = shares("look_3_result_cut")
    check("a result's cut faces are filled", found["cut"] > LEAST_CUT, found)
    check("its lattice is seen", found["lattice"] > LEAST_LATTICE, found)
    click(button("Section"))
    check("one more shows it whole", wait_until(lambda: not section_docks()))
    answer_panel("OK")
    wait_until(lambda: panel() is None)
    look_at_all()
    check("it is selected", Gui.Selection.getSelection() == [obj])
    looks_good("look_4_result")
    preview, result = figures["look_1_preview"], figures["look_4_result"]
    check("much as in the preview", abs(preview["lattice"] - result["lattice"]) < 0.25)
    select()
    click(view_3d())
    check("a click on it selects it", wait_until(lambda: Gui.Selection.getSelection() == [obj]))


@slow
def look_alike_in_any_order(doc, obj):
    """Neither the order of triangles nor turning the view changes the picture."""
    does_not_depend_on_order(obj, "look_5_box")


@slow
def fill_cut_faces_in_every_mode(doc, obj):
    """Ours fill what is cut; so does FreeCAD's own, opaque."""
    view = obj.ViewObject
    from freecad_volfrep.gui.view.section_view import open_section

    for mode in (OURS, "Coarse", "Simplified", "Shaded"):
        view.DisplayMode = mode
        view.Transparency = 0 if mode == "Shaded" else 60
        opened = open_section(obj)
        name = f"look_6_cut_{mode.replace(' ', '_')}"
        picture(name)
        found = shares(name)
        check(f"{mode}: cut faces are filled", found["cut"] > LEAST_CUT / 3, found)
        check(f"{mode}: nothing is nearly black", found["black"] < 0.05, found)
        opened.close()
    view.DisplayMode = OURS
    view.Transparency = 60
    picture("look_6_whole_again")
    check("closed, nothing is cut", shares("look_6_whole_again")["cut"] < 0.001)


@costly
def show_the_colours_chosen(doc, obj):
    """Who changes the colours of the view sees them at once."""
    view = obj.ViewObject
    before = view.LatticeColor
    view.LatticeColor = (0.1, 0.7, 0.2)
    picture("look_7_green")
    red, green, blue = pixels("look_7_green").T
    share = float(((green > 1.4 * red) & (green > 1.1 * blue)).mean())
    check("the lattice is green", share > 0.02, share)
    view.LatticeColor = before
    view.Transparency = 0
    picture("look_7_opaque")
    found = shares("look_7_opaque")
    check("an opaque skin hides the lattice", found["lattice"] < 0.01, found)
    check("and is all there is", found["skin"] > 0.9, found)


@slow
def show_large_ones_alike(doc, obj):
    """A mesh above the preference is drawn coarsely, in the same colours."""
    group = App.ParamGet(GROUP)
    facets = obj.Mesh.CountFacets
    group.SetInt("LargestShownTriangles", facets // 2)
    obj.StrutRadius = 1.01
    doc.recompute()
    group.RemInt("LargestShownTriangles")
    check("a large mesh is shown coarsely", obj.ViewObject.DisplayMode == "Coarse")
    looks_good("look_8_coarse")
    does_not_depend_on_order(obj, "look_8_coarse")
    obj.ViewObject.DisplayMode = "Simplified"
    looks_good("look_8_simplified")


@slow
def show_a_graded_part(doc, obj):
    """Struts that thicken along the part; then one without a skin."""
    obj.RadiusGrading = "Direction"
    obj.RadiusStart, obj.RadiusEnd = 0.5, 1.8
    doc.recompute()
    check("graded", obj.isValid(), obj.getStatusString())
    look_at_all()
    looks_good("look_9_graded")
    does_not_depend_on_order(obj, "look_9_graded")
    obj.Output = "Lattice"
    doc.recompute()
    looks_good("look_9_lattice", with_skin=False)


@slow
def look_alike_undone_and_reopened(doc, obj):
    """A step back, and a file that is opened, look like what was computed."""
    doc.openTransaction("smaller cells")
    obj.CellSize = 8
    doc.recompute()
    doc.commitTransaction()
    doc.undo()
    settle()
    check("undone", obj.CellSize.Value == 10)
    looks_good("look_a_undone")
    path = OUT / "look.FCStd"
    doc.saveAs(str(path))
    App.closeDocument(doc.Name)
    again = App.openDocument(str(path))
    settle()
    found = infills(again)[0]
    check("opened as it was saved", found.ViewObject.DisplayMode == OURS)
    look_at_all()
    looks_good("look_a_reopened")


@slow
def show_the_bracket():
    """The shipped example, in both of our modes."""
    from freecad_volfrep.examples.filled import open_example

    even_background()
    obj = open_example("Bracket")
    obj.Base.Visibility = False
    settle()
    check("the bracket is shown so", obj.ViewObject.DisplayMode == OURS)
    turn = App.Rotation(App.Vector(0, 1, 0), 35) * App.Rotation(App.Vector(1, 0, 0), -30)
    look_along(turn)
    Gui.SendMsgToActiveView("ViewFit")
    select()
    looks_good("look_b_bracket")
    does_not_depend_on_order(obj, "look_b_bracket")
    # Here no inner wall hides the layers of the outside that lie behind each other.
    obj.ViewObject.DisplayMode = "Simplified"
    does_not_depend_on_order(obj, "look_b_simplified")


run_checks(
    "look",
    {
        fill_a_box: boxed,
        look_alike_in_any_order: filled,
        fill_cut_faces_in_every_mode: filled,
        show_the_colours_chosen: filled,
        show_large_ones_alike: filled,
        show_a_graded_part: filled,
        look_alike_undone_and_reopened: filled,
        show_the_bracket: None,
    },
)
