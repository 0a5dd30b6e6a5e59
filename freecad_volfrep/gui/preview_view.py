# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview in the 3D view: struts with their radii, or as lines, in the transparent solid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep import preferences
from volfrep.mesh.triangle_mesh import TriangleMesh

from . import drawing

if TYPE_CHECKING:
    from freecad_volfrep.features.live_preview import Shown
    from volfrep.jobs.preview import Preview

#: Name of what is added to the view's scene.
NODE = "VolfrepPreview"
#: Struts are drawn as prisms of so many sides, or as lines where there are very many.
SIDES = 6
GRID = (0.55, 0.55, 0.55)
LINE_WIDTH = 2
#: Prisms are drawn round: their sides meet at a smaller angle, in radians.
CREASE_ANGLE = 1.2
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

        self._view = obj.ViewObject
        self._plane: Any = None
        self._root = coin.SoSeparator()
        self._root.setName(NODE)
        turn = coin.SoMatrixTransform()
        a = parent_placement(obj).toMatrix().A
        turn.matrix.setValue(*[a[4 * column + row] for row in range(4) for column in range(4)])
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
        self._drawn = Struts(self._struts, shown.preview)
        self._drawn.set_look(self._view, self._plane is not None)
        if with_grid:
            look = drawing.material(GRID)
            lines = drawing.lines(*shown.preview.grid_lines, LINE_WIDTH)
            self._grid.addChild(drawing.separate(look, lines))
        if self._shown_solid is not shown.solid:
            self._solid.removeAllChildren()
            skin = drawing.SeeThrough(shown.solid, drawing.faces(shown.solid))
            paint_solid(skin, self._view)
            self._solid.addChild(skin.node)
            self._shown_solid = shown.solid

    @property
    def bounds(self) -> np.ndarray:
        """(2, 3) lowest and highest coordinates of the solid that is shown, mm; or zeros."""
        return np.zeros((2, 3)) if self._shown_solid is None else self._shown_solid.bounds

    def show_solid_only(self) -> None:
        """Leave the solid that was drawn last: its values have no struts to show."""
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
        for part in (self._struts, self._grid, self._solid):
            part.removeAllChildren()
        self._shown_solid = None

    def remove(self) -> None:
        """Leave nothing in the view."""
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
        if shown.wall is not None:
            self._draw_faces(node, shown.wall)
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


def paint_solid(skin: drawing.SeeThrough, view: Any) -> None:
    """Give the solid round struts the skin's colour; it is seen through, whatever the skin is."""
    skin.paint(view.ShapeColor, max(view.Transparency, LEAST_TRANSPARENCY) / 100.0)


def prisms(start: np.ndarray, end: np.ndarray, radii: np.ndarray) -> TriangleMesh:
    """Closed prisms in the place of struts, (k, 3) starts and ends, (k, 2) radii."""
    axis = end - start
    axis /= np.maximum(np.linalg.norm(axis, axis=1), 1e-12)[:, None]
    helper = np.where(np.abs(axis[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    one = np.cross(axis, helper)
    one /= np.linalg.norm(one, axis=1)[:, None]
    two = np.cross(axis, one)
    angle = 2.0 * np.pi * np.arange(SIDES) / SIDES
    out = np.cos(angle)[:, None] * one[:, None] + np.sin(angle)[:, None] * two[:, None]
    rings = [
        middle[:, None] + radius[:, None, None] * out
        for middle, radius in ((start, radii[:, 0]), (end, radii[:, 1]))
    ]
    vertices = np.concatenate(rings, axis=1).reshape(-1, 3)
    k = np.arange(SIDES)
    following, inner = (k + 1) % SIDES, k[1:-1]
    sides = np.concatenate(
        [
            np.stack([k, following, following + SIDES], 1),
            np.stack([k, following + SIDES, k + SIDES], 1),
            np.stack([0 * inner, inner + 1, inner], 1),
            np.stack([0 * inner, inner, inner + 1], 1) + SIDES,
        ]
    )
    first = 2 * SIDES * np.arange(len(start))
    triangles = (first[:, None, None] + sides).reshape(-1, 3)
    return TriangleMesh(vertices, triangles.astype(np.int32))
