# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview in the 3D view: struts with their radii, or as lines, in the transparent solid."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep import preferences
from freecad_volfrep.features.sizing.sized_states import limit_names
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.coloured_struts import coloured_struts, colours_of, row_colours
from freecad_volfrep.gui.draw.legend import Legend
from freecad_volfrep.gui.in_steps import do_in_steps, drop_steps
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from freecad_volfrep.features.infill.live_preview import Shown
    from freecad_volfrep.gui.draw.drawn_preview import DrawnSolid
    from volfrep.jobs.preview import Preview
    from volfrep.mesh.display_parts import Pieces

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
        self._drawn_solid: Any = None  # the same once it is in the scene
        self._drawn: Any = None
        self._steps: Iterator[None] | None = None
        self._scene = Gui.activeDocument().activeView().getSceneGraph()
        self._scene.addChild(self._root)

    def show(self, shown: Shown, struts: Pieces | None, solid: DrawnSolid, with_grid: bool) -> None:
        """Draw a preview in the place of the last one, which stays until all of it is there.

        Args:
            shown: the preview.
            struts: what its struts or walls are drawn with, see `draw_struts`.
            solid: what its solid is drawn with.
            with_grid: whether cells are drawn, too.
        """
        drop_steps(self._steps)
        self._shown_solid = shown.solid
        self._grid.removeAllChildren()
        self._legend.remove()
        if with_grid:
            look = drawing.material(GRID)
            lines = drawing.lines(*shown.preview.grid_lines, LINE_WIDTH)
            self._grid.addChild(drawing.separate(look, lines))
        drawn = self._coloured(shown) or Struts(shown.preview, struts)
        self._steps = self._draw(shown, drawn, solid)
        do_in_steps(self._steps)

    def _draw(
        self, shown: Shown, drawn: ColouredStruts | Struts, solid: DrawnSolid
    ) -> Iterator[None]:
        """Bring solid and struts into the scene, a piece at each step."""
        from pivy import coin

        if self._drawn_solid is not shown.solid:
            shape = coin.SoGroup()
            for arrays in solid.pieces:
                shape.addChild(drawing.piece(*arrays))
                yield
            skin = drawing.SeeThrough(drawing.edge_lines(solid.edges), shape)
            paint_solid(skin, self._view)
            self._solid.removeAllChildren()
            self._solid.addChild(skin.node)
            self._drawn_solid = shown.solid
        yield from drawn.add_pieces()
        self._drawn = drawn
        drawn.set_look(self._view, self._plane is not None)
        self._struts.removeAllChildren()
        self._struts.addChild(drawn.node)

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
        return ColouredStruts(shown.preview, colours.reshape(-1, 2, 3))

    @property
    def bounds(self) -> np.ndarray:
        """(2, 3) lowest and highest coordinates of the solid that is shown, mm; or zeros."""
        return np.zeros((2, 3)) if self._shown_solid is None else self._shown_solid.bounds

    def show_solid_only(self) -> None:
        """Leave the solid that was drawn last: its values have no struts to show."""
        drop_steps(self._steps)
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
        drop_steps(self._steps)
        self._legend.remove()
        for part in (self._struts, self._grid, self._solid):
            part.removeAllChildren()
        self._shown_solid = self._drawn_solid = None

    def remove(self) -> None:
        """Leave nothing in the view."""
        drop_steps(self._steps)
        self._legend.remove()
        self._scene.removeChild(self._root)


class Struts:
    """Struts as a lattice's view has them: prisms, or lines where there are very many; or walls.

    Args:
        shown: the struts, or the walls.
        pieces: their faces; None for lines.

    Attributes:
        node: a separator, empty of faces until `add_pieces` has ended.
    """

    def __init__(self, shown: Preview, pieces: Pieces | None) -> None:
        from pivy import coin

        self._look, self._inside = drawing.material((0.0, 0.0, 0.0)), None
        self._pieces, self._shape = pieces, coin.SoGroup()
        if pieces is None:
            lines = drawing.lines(shown.start, shown.end, LINE_WIDTH)
            self.node = drawing.separate(self._look, lines)
            return
        self._inside = drawing.Inside(self._shape)
        front = drawing.separate(drawing.seen_from(outside=True), self._look, self._shape)
        self.node = drawing.separate(self._inside.node, front)

    def add_pieces(self) -> Iterator[None]:
        """Draw the faces, a piece at each step."""
        for arrays in self._pieces or ():
            self._shape.addChild(drawing.piece(*arrays))
            yield

    def set_look(self, view: Any, is_cut: bool) -> None:
        """Colours of the object's view."""
        drawing.paint(self._look, view.LatticeColor, drawing.STRUT)
        if self._inside is not None:
            cut = preferences.colour(preferences.CUT_COLOUR)
            self._inside.paint(cut if is_cut else view.LatticeColor)


class ColouredStruts:
    """The same in colours.

    Args:
        shown: the struts.
        colours: (k, 2, 3) at their ends.
    """

    def __init__(self, shown: Preview, colours: np.ndarray) -> None:
        most = preferences.read(preferences.MOST_PRISMS)
        self.node = coloured_struts(shown.start, shown.end, shown.radii, colours, most)

    def add_pieces(self) -> Iterator[None]:
        """It is there at once."""
        return iter(())

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
