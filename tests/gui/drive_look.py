# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a computed part looks like in the real FreeCAD window; see tools/run_gui.sh.

The look is judged by pixels on an even background: skin, lattice and cut faces are there in their
colours, and nothing depends on the order in which triangles are drawn or on turning the view.
"""

import sys
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

sys.path.insert(0, str(Path(__file__).resolve().parent))
from driving import (
    OUT,
    answer_panel,
    check,
    click,
    figures,
    infills,
    look_at_all,
    panel,
    panel_part,
    picture,
    run,
    select,
    toolbar_button,
    view_3d,
    wait,
    wait_until,
    xdotool,
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
    wait(300)


def pixels(name):
    """The middle of the 3D view in a picture: rows of red, green and blue."""
    image = QtGui.QImage(str(OUT / f"{name}.png"))
    corner = view_3d().mapToGlobal(QtCore.QPoint(0, 0))
    width, height = view_3d().width(), view_3d().height()
    return [
        QtGui.QColor(image.pixel(corner.x() + x, corner.y() + y)).getRgb()[:3]
        for y in range(int(0.08 * height), int(0.92 * height), 2)
        for x in range(int(0.08 * width), int(0.80 * width), 2)
    ]


def shares(name):
    """Shares of a picture: what is drawn, and of that the lattice, the skin, cut faces."""
    seen = [rgb for rgb in pixels(name) if min(rgb) < 240]
    count = max(len(seen), 1)
    found = {
        "drawn": len(seen) / len(pixels(name)),
        "lattice": sum(b > 1.25 * r and b > g for r, g, b in seen) / count,
        "skin": sum(max(rgb) - min(rgb) < 50 and min(rgb) > 90 for rgb in seen) / count,
        "cut": sum(r > 200 and r > 2.5 * b for r, _, b in seen) / count,
        "black": sum(max(rgb) < 40 for rgb in seen) / count,
    }
    figures[name] = {part: round(share, 3) for part, share in found.items()}
    return found


def differing(one, two):
    """Share of pixels that differ between two pictures."""
    pairs = list(zip(pixels(one), pixels(two), strict=True))
    return sum(max(abs(p - q) for p, q in zip(*pair, strict=True)) > 5 for pair in pairs) / len(
        pairs
    )


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
    for _ in range(12):
        turned = view.getCameraOrientation() * App.Rotation(App.Vector(0, 1, 0), 30)
        view.setCameraOrientation(turned.Q)
        wait(20)
    Gui.updateGui()
    picture(f"{name}_turned")
    stray = differing(f"{name}_before", f"{name}_turned")
    check(f"{name}: a whole turn changes nothing", stray < STRAY, stray)
    view.setCameraOrientation(start.Q)
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


def dock():
    """The section's dock, or None."""
    found = Gui.getMainWindow().findChildren(QtGui.QDockWidget, "VolfrepSectionView")
    return next((widget for widget in found if widget.isVisible()), None)


def fill_a_box(doc):
    """From a box by clicks to a part that is computed, cutting it open on the way."""
    box = doc.addObject("Part::Box", "Block")
    box.Length, box.Width, box.Height = 40, 30, 20
    doc.recompute()
    look_at_all()
    select(box)
    click(toolbar_button("Lattice Infill"))
    wait_until(lambda: panel() is not None, 20)
    wait(1000)
    obj = infills(doc)[0]
    obj.CellSize, obj.StrutRadius, obj.ShellThickness = 10, 1, 1.5
    obj.Deviation = 0.01
    panel_part("Preview").toggle()
    panel_part("Preview").toggle()
    wait(800)
    looks_good("look_1_preview")
    click(button("Section"))
    check("one click cuts the preview open", wait_until(lambda: dock() is not None, 5))
    wait(500)
    picture("look_2_preview_cut")
    check("it shows what is cut", shares("look_2_preview_cut")["cut"] > LEAST_CUT / 3)
    click(button("Compute"))
    wait_until(lambda: obj.Mesh.CountFacets, 60)
    wait(1000)
    check("it is still cut open", dock() is not None)
    picture("look_3_result_cut")
    found = shares("look_3_result_cut")
    check("a result's cut faces are filled", found["cut"] > LEAST_CUT, found)
    check("its lattice is seen", found["lattice"] > LEAST_LATTICE, found)
    click(button("Section"))
    check("one more shows it whole", wait_until(lambda: dock() is None, 5))
    answer_panel("OK")
    wait_until(lambda: panel() is None, 60)
    look_at_all()
    check("it is selected", Gui.Selection.getSelection() == [obj])
    looks_good("look_4_result")
    preview, result = figures["look_1_preview"], figures["look_4_result"]
    check("much as in the preview", abs(preview["lattice"] - result["lattice"]) < 0.25)
    Gui.Selection.clearSelection()
    wait(300)
    does_not_depend_on_order(obj, "look_5_box")
    click(view_3d())
    check("a click on it selects it", Gui.Selection.getSelection() == [obj])
    Gui.Selection.clearSelection()
    return obj


def fill_cut_faces_in_every_mode(obj):
    """Ours fill what is cut; so does FreeCAD's own, opaque."""
    view = obj.ViewObject
    select(obj)
    from freecad_volfrep.gui.section_view import open_section

    for mode in (OURS, "Coarse", "Simplified", "Shaded"):
        view.DisplayMode = mode
        view.Transparency = 0 if mode == "Shaded" else 60
        opened = open_section(obj)
        Gui.Selection.clearSelection()
        wait(400)
        name = f"look_6_cut_{mode.replace(' ', '_')}"
        picture(name)
        found = shares(name)
        check(f"{mode}: cut faces are filled", found["cut"] > LEAST_CUT / 3, found)
        check(f"{mode}: nothing is nearly black", found["black"] < 0.05, found)
        opened.close()
        wait(300)
    view.DisplayMode = OURS
    view.Transparency = 60
    picture("look_6_whole_again")
    check("closed, nothing is cut", shares("look_6_whole_again")["cut"] < 0.001)


def colours_follow(obj):
    """Who changes the colours of the view sees them at once."""
    view = obj.ViewObject
    before = view.LatticeColor
    view.LatticeColor = (0.1, 0.7, 0.2)
    wait(300)
    picture("look_7_green")
    green = [g > 1.4 * r and g > 1.1 * b for r, g, b in pixels("look_7_green")]
    check("the lattice is green", sum(green) / len(green) > 0.02, sum(green) / len(green))
    view.LatticeColor = before
    view.Transparency = 0
    wait(300)
    picture("look_7_opaque")
    found = shares("look_7_opaque")
    check("an opaque skin hides the lattice", found["lattice"] < 0.01, found)
    check("and is all there is", found["skin"] > 0.9, found)
    view.Transparency = 60


def large_ones_look_the_same(obj):
    """A mesh above the preference is drawn coarsely, in the same colours."""
    group = App.ParamGet(GROUP)
    facets = obj.Mesh.CountFacets
    group.SetInt("LargestShownTriangles", facets // 2)
    obj.StrutRadius = 1.01
    obj.Document.recompute()
    group.RemInt("LargestShownTriangles")
    check("a large mesh is shown coarsely", obj.ViewObject.DisplayMode == "Coarse")
    looks_good("look_8_coarse")
    does_not_depend_on_order(obj, "look_8_coarse")
    obj.ViewObject.DisplayMode = "Simplified"
    looks_good("look_8_simplified")
    obj.ViewObject.DisplayMode = OURS


def a_graded_part(doc, obj):
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
    obj.Output = "Part"
    doc.recompute()


def undone_and_reopened(doc, obj):
    """A step back, and a file that is opened, look like what was computed."""
    doc.openTransaction("smaller cells")
    obj.CellSize = 8
    doc.recompute()
    doc.commitTransaction()
    doc.undo()
    wait(800)
    check("undone", obj.CellSize.Value == 10)
    looks_good("look_a_undone")
    path = OUT / "look.FCStd"
    doc.saveAs(str(path))
    App.closeDocument(doc.Name)
    again = App.openDocument(str(path))
    wait(1500)
    found = infills(again)[0]
    check("opened as it was saved", found.ViewObject.DisplayMode == OURS)
    look_at_all()
    looks_good("look_a_reopened")
    App.closeDocument(again.Name)


def click_through(menu, *texts):
    """Really click on an entry of the menu bar, and on those of the menus that open."""
    for text in texts:
        action = next(a for a in menu.actions() if a.text().replace("&", "") == text)
        point = menu.mapToGlobal(menu.actionGeometry(action).center())
        xdotool("mousemove", point.x(), point.y())
        wait(300)
        xdotool("click", 1)
        wait(500)
        menu = QtGui.QApplication.activePopupWidget()


def the_bracket():
    """The shipped example, by its entry of the menu."""
    click_through(Gui.getMainWindow().menuBar(), "VOLFREP", "Examples", "Bracket")
    check("the bracket is there", wait_until(lambda: App.ActiveDocument is not None, 60))
    wait(1500)
    obj = infills(App.ActiveDocument)[0]
    check("the bracket is shown so", obj.ViewObject.DisplayMode == OURS)
    turn = App.Rotation(App.Vector(0, 1, 0), 35) * App.Rotation(App.Vector(1, 0, 0), -30)
    Gui.activeDocument().activeView().setCameraOrientation(turn.Q)
    Gui.SendMsgToActiveView("ViewFit")
    Gui.Selection.clearSelection()
    wait(500)
    looks_good("look_b_bracket")
    does_not_depend_on_order(obj, "look_b_bracket")
    # Here no inner wall hides the layers of the outside that lie behind each other.
    obj.ViewObject.DisplayMode = "Simplified"
    does_not_depend_on_order(obj, "look_b_simplified")
    App.closeDocument(obj.Document.Name)


def drive():
    """The whole session."""
    App.ParamGet(GROUP).Clear()
    even_background()
    doc = App.newDocument("Look")
    doc.UndoMode = 1
    Gui.activateWorkbench("VolfrepWorkbench")
    wait(800)
    obj = fill_a_box(doc)
    fill_cut_faces_in_every_mode(obj)
    colours_follow(obj)
    large_ones_look_the_same(obj)
    a_graded_part(doc, obj)
    undone_and_reopened(doc, obj)
    the_bracket()


def restored():
    """The session, and FreeCAD's background as it was."""
    try:
        drive()
    finally:
        for kind, key in (
            ("Bool", "Simple"),
            ("Bool", "Gradient"),
            ("Unsigned", "BackgroundColor"),
        ):
            getattr(App.ParamGet(VIEW), f"Rem{kind}")(key)


run(restored, "look")
