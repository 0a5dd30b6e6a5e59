# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview in the 3D view: struts with their radii, or as lines, in the transparent solid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep import preferences
from freecad_volfrep.features.sizing.sized_states import limit_names
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.coloured_struts import coloured_struts, colours_of, row_colours
from freecad_volfrep.gui.draw.legend import Legend
from freecad_volfrep.gui.draw.prisms import CREASE_ANGLE, prisms
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from freecad_volfrep.features.infill.live_preview import Shown
    from volfrep.jobs.preview import Preview
    from volfrep.mesh.triangle_mesh import TriangleMesh

#: Name of what is added to the view's scene.
NODE = "VolfrepPreview"
GRID = (0.55, 0.55, 0.55)
LINE_WIDTH = 2
#: Where the preview itself is seen through a solid that the view shows opaque, in percent.
LEAST_TRANSPARENCY = 50


class PreviewView:
    """What is drawn beside the document's objects, until it is removed.

    Args:
        obj: the infill, whose colours it has.
    """

    def __init__(self, obj: App.DocumentObject) -> None:
        from pivy import coin

        from freecad_volfrep.bridge.solids import parent_placement

        self._obj, self._view = obj, obj.ViewObject
        self._legend = Legend()
        self._plane: Any = None
        self._root = coin.SoSeparator()
        self._root.setName(NODE)
        turn = drawing.transform(parent_placement(obj))
        self._struts, self._grid, self._solid = (coin.SoSeparator() for _ in range(3))
        for part in (turn, drawing.unpickable(), self._struts, self._grid, self._solid):
            self._root.addChild(part)
        self._shown_solid: Any = None
        self._drawn: Any = None
        self._scene = Gui.activeDocument().activeView().getSceneGraph()
        self._scene.addChild(self._root)

    def show(self, shown: Shown, with_grid: bool) -> None:
        """Draw a preview in the place of the last one."""
        self._struts.removeAllChildren()
        self._grid.removeAllChildren()
        self._legend.remove()
        self._drawn = self._coloured(shown) or Struts(self._struts, shown.preview)
        self._drawn.set_look(self._view, self._plane is not None)
        if with_grid:
            look = drawing.material(GRID)
            lines = drawing.lines(*shown.preview.grid_lines, LINE_WIDTH)
            self._grid.addChild(drawing.separate(look, lines))
        if self._shown_solid is not shown.solid:
            self._solid.removeAllChildren()
            skin = drawing.SeeThrough(drawing.edges(shown.solid), drawing.faces(shown.solid))
            paint_solid(skin, self._view)
            self._solid.addChild(skin.node)
            self._shown_solid = shown.solid

    def _coloured(self, shown: Shown) -> ColouredStruts | None:
        """The struts in the colours of what the view is coloured by, if that is known of them."""
        from volfrep.jobs.figures.point_values import OF_LOADS

        quantity = self._view.ColourBy
        values = preview_values(self._obj, shown, quantity)
        if values is None or not values.size:
            return None
        low, high = float(values.min()), float(values.max())
        if quantity == "Overhang":
            low, high = 0.0, 90.0
        elif quantity in OF_LOADS:
            low = 0.0
        if self._view.ColourFrom != self._view.ColourTo:
            low, high = self._view.ColourFrom, self._view.ColourTo
        names = limit_names(self._obj, quantity)
        self._legend.show(self._obj, quantity, low, high, names)
        flat = values.ravel()
        colours = row_colours(flat) if names else colours_of(flat, low, high)
        return ColouredStruts(self._struts, shown.preview, colours.reshape(-1, 2, 3))

    @property
    def bounds(self) -> np.ndarray:
        """(2, 3) lowest and highest coordinates of the solid that is shown, mm; or zeros."""
        return np.zeros((2, 3)) if self._shown_solid is None else self._shown_solid.bounds

    def show_solid_only(self) -> None:
        """Leave the solid that was drawn last: its values have no struts to show."""
        self._legend.remove()
        self._struts.removeAllChildren()
        self._grid.removeAllChildren()

    def cut_by(self, plane: Any) -> None:
        """Cut it open by a clipping plane in the coordinates of the infill's group; None: whole."""
        if self._plane is not None:
            self._root.removeChild(self._plane)
        self._plane = plane
        if plane is not None:
            self._root.insertChild(plane, 1)
        if self._drawn is not None:
            self._drawn.set_look(self._view, plane is not None)

    def clear(self) -> None:
        """Draw nothing."""
        self._legend.remove()
        for part in (self._struts, self._grid, self._solid):
            part.removeAllChildren()
        self._shown_solid = None

    def remove(self) -> None:
        """Leave nothing in the view."""
        self._legend.remove()
        self._scene.removeChild(self._root)


class Struts:
    """Struts in a node of the scene, as a lattice's view has them.

    They are prisms as long as there are not more than the preference allows, else lines.

    Args:
        node: an empty node of the scene.
        shown: the struts, or the walls.
    """

    def __init__(self, node: Any, shown: Preview) -> None:
        self._look, self._inside = drawing.material((0.0, 0.0, 0.0)), None
        if shown.surface is not None:
            self._draw_faces(node, shown.surface)
            return
        if len(shown.start) > preferences.read(preferences.MOST_PRISMS):
            lines = drawing.lines(shown.start, shown.end, LINE_WIDTH)
            node.addChild(drawing.separate(self._look, lines))
            return
        if len(shown.start):
            self._draw_faces(node, prisms(shown.start, shown.end, shown.radii))

    def _draw_faces(self, node: Any, mesh: TriangleMesh) -> None:
        shape = drawing.faces(mesh, CREASE_ANGLE)
        self._inside = drawing.Inside(shape)
        front = drawing.seen_from(outside=True)
        node.addChild(self._inside.node)
        node.addChild(drawing.separate(front, self._look, shape))

    def set_look(self, view: Any, is_cut: bool) -> None:
        """Colours of the object's view."""
        drawing.paint(self._look, view.LatticeColor, drawing.STRUT)
        if self._inside is not None:
            cut = preferences.colour(preferences.CUT_COLOUR)
            self._inside.paint(cut if is_cut else view.LatticeColor)


class ColouredStruts:
    """The same in colours.

    Args:
        node: an empty node of the scene.
        shown: the struts.
        colours: (k, 2, 3) at their ends.
    """

    def __init__(self, node: Any, shown: Preview, colours: np.ndarray) -> None:
        most = preferences.read(preferences.MOST_PRISMS)
        node.addChild(coloured_struts(shown.start, shown.end, shown.radii, colours, most))

    def set_look(self, view: Any, is_cut: bool) -> None:
        """Colours say something: a section leaves them."""


def preview_values(obj: App.DocumentObject, shown: Shown, quantity: str) -> np.ndarray | None:
    """(k, 2) a quantity at the ends of a preview's struts; None where it is not known of them."""
    from freecad_volfrep.features.sizing.sized_states import sized_states
    from volfrep.jobs.figures.point_values import (
        GOVERNING,
        OF_LOADS,
        values_in_space,
        values_on_struts,
    )

    struts = shown.preview
    if quantity == "Radius":
        return struts.radii
    if quantity == "Overhang":
        along = struts.end - struts.start
        up = np.array(tuple(obj.BuildDirection))
        rise = np.abs((along * up).sum(axis=1)) / np.maximum(
            np.linalg.norm(along, axis=1) * np.linalg.norm(up), 1e-12
        )
        return np.repeat(np.degrees(np.arcsin(np.minimum(rise, 1.0)))[:, None], 2, axis=1)
    if quantity in (*OF_LOADS, GOVERNING[0]) and shown.is_sized:
        ends, states = sized_states(obj)
        if quantity not in states:
            return None  # kept by an earlier release
        return values_on_struts(struts.start, struts.end, ends, states[quantity])
    if quantity not in ("Cell size", "Field"):
        return None
    points = np.concatenate([struts.start, struts.end])
    try:
        values = values_in_space(shown.solid, struts.spec, quantity, points)
    except VolfrepError:
        return None  # there is no such thing in this lattice
    return values.reshape(2, -1).T


def paint_solid(skin: drawing.SeeThrough, view: Any) -> None:
    """Give the solid round struts the skin's colour; it is seen through, whatever the skin is."""
    skin.paint(view.ShapeColor, max(view.Transparency, LEAST_TRANSPARENCY) / 100.0)
