# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview in the 3D view: struts with their radii, or as lines, in the transparent solid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep import preferences

if TYPE_CHECKING:
    from freecad_volfrep.features.live_preview import Shown
    from volfrep.mesh import TriangleMesh

#: Name of what is added to the view's scene.
NODE = "VolfrepPreview"
#: Struts are drawn as prisms of so many sides, or as lines where there are very many.
SIDES = 6
SOLID, GRID = (0.75, 0.75, 0.78), (0.55, 0.55, 0.55)
SOLID_TRANSPARENCY = 0.8


class PreviewView:
    """What is drawn beside the document's objects, until it is removed."""

    def __init__(self, placement: App.Placement) -> None:
        from pivy import coin

        self._root = coin.SoSeparator()
        self._root.setName(NODE)
        turn = coin.SoMatrixTransform()
        a = placement.toMatrix().A
        turn.matrix.setValue(*[a[4 * column + row] for row in range(4) for column in range(4)])
        self._struts, self._grid, self._solid = (coin.SoSeparator() for _ in range(3))
        for part in (turn, self._struts, self._grid, self._solid):
            self._root.addChild(part)
        self._shown_solid: Any = None
        self._scene = Gui.activeDocument().activeView().getSceneGraph()
        self._scene.addChild(self._root)

    def show(self, shown: Shown, with_grid: bool) -> None:
        """Draw a preview in the place of the last one."""
        p = shown.preview
        self._struts.removeAllChildren()
        self._grid.removeAllChildren()
        add_struts(self._struts, p.start, p.end, p.radii)
        if with_grid:
            _add_lines(self._grid, *shown.preview.grid_lines, GRID)
        if self._shown_solid is not shown.solid:
            self._solid.removeAllChildren()
            add_solid(self._solid, shown.solid)
            self._shown_solid = shown.solid

    def show_solid_only(self) -> None:
        """Leave the solid that was drawn last: its values have no struts to show.

        Coin draws a transparent shape opaque where nothing else is drawn, which serves well here.
        """
        self._struts.removeAllChildren()
        self._grid.removeAllChildren()

    def clear(self) -> None:
        """Draw nothing."""
        for part in (self._struts, self._grid, self._solid):
            part.removeAllChildren()
        self._shown_solid = None

    def remove(self) -> None:
        """Leave nothing in the view."""
        self._scene.removeChild(self._root)


def add_solid(node: Any, mesh: TriangleMesh, pickable: bool = False) -> None:
    """Draw a solid that can be seen through."""
    faces = mesh.vertices, mesh.triangles
    _add_faces(node, *faces, SOLID, SOLID_TRANSPARENCY, crease=0.6, pickable=pickable)


def add_struts(
    node: Any, start: np.ndarray, end: np.ndarray, radii: np.ndarray, pickable: bool = False
) -> None:
    """Draw struts, (k, 3) starts and ends and (k, 2) radii, in the preferred colour.

    They are prisms as long as there are not more than the preference allows, else lines.
    """
    colour = preferences.colour(preferences.STRUT_COLOUR)
    if len(start) <= preferences.read(preferences.MOST_PRISMS):
        _add_faces(node, *prisms(start, end, radii), colour, 0.0, crease=1.2, pickable=pickable)
    else:
        _add_lines(node, start, end, colour, pickable)


def prisms(start: np.ndarray, end: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of the sides of struts, (k, 3) starts and ends, (k, 2) radii."""
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
    following = (k + 1) % SIDES
    sides = np.concatenate(
        [
            np.stack([k, following, following + SIDES], 1),
            np.stack([k, following + SIDES, k + SIDES], 1),
        ]
    )
    first = 2 * SIDES * np.arange(len(start))
    return vertices, (first[:, None, None] + sides).reshape(-1, 3)


def _add_faces(
    node: Any, vertices: np.ndarray, triangles: np.ndarray, colour: Any, transparency: float,
    crease: float, pickable: bool = False,
) -> None:  # fmt: skip
    from pivy import coin

    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    hints.shapeType = coin.SoShapeHints.SOLID
    hints.creaseAngle = crease
    faces = coin.SoIndexedFaceSet()
    index = np.full((len(triangles), 4), -1)
    index[:, :3] = triangles
    faces.coordIndex.setValues(0, index.size, index.ravel().tolist())
    _add(node, vertices, (colour, transparency), hints, faces, pickable)


def _add_lines(
    node: Any, start: np.ndarray, end: np.ndarray, colour: Any, pickable: bool = False
) -> None:
    from pivy import coin

    lines = coin.SoLineSet()
    lines.numVertices.setValues(0, len(start), [2] * len(start))
    style = coin.SoDrawStyle()
    style.lineWidth = 2
    points = np.stack([start, end], axis=1).reshape(-1, 3)
    _add(node, points, (colour, 0.0), style, lines, pickable)


def _add(
    node: Any, points: np.ndarray, look: tuple[Any, float], style: Any, shape: Any, pickable: bool
) -> None:
    from pivy import coin

    material = coin.SoMaterial()
    material.diffuseColor, material.transparency = look
    pick = coin.SoPickStyle()
    pick.style = coin.SoPickStyle.SHAPE if pickable else coin.SoPickStyle.UNPICKABLE
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), points.tolist())
    group = coin.SoSeparator()
    for part in (pick, material, style, coordinates, shape):
        group.addChild(part)
    node.addChild(group)
