# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes and lines as nodes of Coin's scene, from arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from volfrep.mesh.display_parts import in_pieces
from volfrep.mesh.shading import CREASE_ANGLE, shade, sharp_edges
from volfrep.mesh.triangle_mesh import TriangleMesh

if TYPE_CHECKING:
    from volfrep.mesh.display_parts import Pieces

#: How shiny what we draw is.
SPECULAR, SHININESS = (0.10, 0.10, 0.10), 0.3
#: Shares of a colour: that glows, that no shade takes away, that of the light that falls on it.
#: Large faces are seen by their colour, struts by their shade.
FACE, STRUT = (0.14, 0.20, 0.70), (0.06, 0.10, 0.88)
#: Of what is coloured by a value, in the shade too: without it the dark end would be black there.
VALUE_SHADE = (0.5, 0.5, 0.5)
#: So much of the depth of the view edges are drawn nearer than the faces that they are on, and
#: what is cut through nearer still, because the edges behind it are hidden.
EDGES_NEARER, CUT_NEARER = 2e-4, 3e-4
EDGE_WIDTH, EDGE_DARKER = 2.0, 0.4


def faces(mesh: TriangleMesh, crease_angle: float = CREASE_ANGLE) -> Any:
    """A group that draws a mesh, without a look: coordinates, normals, triangles."""
    group = _group(_coin().SoGroup())
    for arrays in in_pieces(shade(mesh, crease_angle)):
        group.addChild(piece(*arrays))
    return group


def piece(
    points: NDArray[np.float32], normals: NDArray[np.float32], index: NDArray[np.int32]
) -> Any:
    """A separator that draws a piece of a mesh, see `volfrep.mesh.display_parts`."""
    coin = _coin()
    coordinates, directions = coin.SoCoordinate3(), coin.SoNormal()
    coordinates.point.setValues(0, len(points), points)
    directions.vector.setValues(0, len(normals), normals)
    binding = coin.SoNormalBinding()
    binding.value = coin.SoNormalBinding.PER_VERTEX_INDEXED
    triangles = coin.SoIndexedFaceSet()
    # Coin takes a list in a fifth of the time that it takes an array in.
    triangles.coordIndex.setValues(0, index.size, index.ravel().tolist())
    return separate(coordinates, directions, binding, triangles)


#: What `kept_pieces` has made.
_kept: WeakKeyDictionary[Pieces, list[Any]] = WeakKeyDictionary()


def kept_pieces(pieces: Pieces) -> list[Any]:
    """The `piece` of each, made once for all places in the scene; they take no colours."""
    if pieces not in _kept:
        _kept[pieces] = [piece(*arrays) for arrays in pieces]
    return _kept[pieces]


def colour_piece(node: Any, colours: NDArray[np.float32] | None) -> None:
    """Give the points of a `piece` (n, 3) colours of their own, or take them away."""
    coin = _coin()
    if isinstance(node.getChild(0), coin.SoMaterial):
        node.removeChild(0)
        node.removeChild(0)
    if colours is None:
        return
    look = coin.SoMaterial()
    look.ambientColor, look.specularColor = VALUE_SHADE, SPECULAR
    look.shininess = SHININESS
    look.diffuseColor.setValues(0, len(colours), np.ascontiguousarray(colours, np.float32))
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_VERTEX_INDEXED
    node.insertChild(look, 0)
    node.insertChild(binding, 1)


def edges(mesh: TriangleMesh) -> Any:
    """A group that draws a mesh's sharp edges, without a colour."""
    return edge_lines(mesh.vertices[sharp_edges(mesh)])


def edge_lines(ends: NDArray[Any]) -> Any:
    """The same of their (e, 2, 3) ends."""
    return lines(ends[:, 0], ends[:, 1], EDGE_WIDTH)


def lines(start: NDArray[np.float64], end: NDArray[np.float64], width: float) -> Any:
    """A group that draws lines, (k, 3) starts and ends, so many pixels wide, without a colour."""
    from pivy import coin

    coordinates = coin.SoCoordinate3()
    points = np.stack([start, end], axis=1).reshape(-1, 3).astype(np.float32)
    coordinates.point.setValues(0, len(points), points)
    drawn = coin.SoLineSet()
    drawn.numVertices.setValues(0, len(start), [2] * len(start))
    style = coin.SoDrawStyle()
    style.lineWidth = width
    return _group(coin.SoGroup(), flat_light(), style, coordinates, drawn)


def material(colour: Any, transparency: float = 0.0) -> Any:
    """What all that we draw is made of, in a colour of red, green and blue from 0 to 1."""
    from pivy import coin

    node = coin.SoMaterial()
    node.specularColor, node.shininess, node.transparency = SPECULAR, SHININESS, transparency
    paint(node, colour)
    return node


def paint(node: Any, colour: Any, shares: tuple[float, float, float] = FACE) -> None:
    """Give a material a colour, which it has where it faces the viewer.

    The light comes from there: without some of the colour in the shade, faces that he sees at a
    slant would be nearly black.
    """
    glow, ambient, diffuse = shares
    # Coin gives a material a fifth of its ambient colour, whatever the light.
    for name, share in (
        ("emissiveColor", glow), ("ambientColor", 5 * ambient), ("diffuseColor", diffuse),
    ):  # fmt: skip
        setattr(node, name, tuple(float(share * part) for part in colour[:3]))


def seen_from(outside: bool) -> Any:
    """Draw triangles only where their outside, or their inside, faces the viewer."""
    from pivy import coin

    hints = coin.SoShapeHints()
    ordering = "COUNTERCLOCKWISE" if outside else "CLOCKWISE"
    hints.vertexOrdering = getattr(coin.SoShapeHints, ordering)
    hints.shapeType = coin.SoShapeHints.SOLID
    return hints


def nearer(share: float) -> Any:
    """Draw a little nearer to the viewer than it is."""
    from pivy import coin

    depth = coin.SoDepthBuffer()
    depth.test, depth.write = True, True
    depth.function, depth.range = coin.SoDepthBuffer.LEQUAL, (0.0, 1.0 - share)
    return depth


def flat_light() -> Any:
    """Draw in the colour itself, unshaded."""
    from pivy import coin

    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    return light


def see_through() -> Any:
    """Draw what is transparent after all that is opaque, as it stands, and not sorted.

    FreeCAD sorts transparent triangles by their middles. Of large ones that overlap the wrong one
    is then drawn first, which shows as diagonal borders of brightness.
    """
    from pivy import coin

    kind = coin.SoTransparencyType()
    kind.value = coin.SoTransparencyType.DELAYED_BLEND
    return kind


class Inside:
    """The insides of surfaces that are seen, evenly in one colour.

    Where a section cuts a closed surface open one looks at its inside, just where the cut face
    would be: so this shows cut faces, exactly and at once. It also shows the ends of struts
    whose roots are not drawn. It goes before what shows the outside of surfaces: Coin leaves
    OpenGL as the last shape needed it, and FreeCAD's background would be taken for a back side.

    Args:
        shapes: groups of `faces`.
    """

    def __init__(self, *shapes: Any) -> None:
        self._look = material((0.0, 0.0, 0.0))
        hints = seen_from(outside=False), nearer(CUT_NEARER), flat_light()
        self.node = separate(*hints, self._look, *shapes)

    def paint(self, colour: Any) -> None:
        """Give it a colour."""
        self._look.diffuseColor = tuple(colour[:3])


class SeeThrough:
    """The outside of a solid: its edges, and its faces opaque or see-through.

    Of faces that are seen through, only those nearest to the viewer are drawn: first without any
    colour, so that they hide all others, and then with it. So the picture does not depend on
    their order.

    Args:
        lines: its `edges`.
        shape: its `faces`, or those of a part of it.
    """

    def __init__(self, lines: Any, shape: Any) -> None:
        from pivy import coin

        self._look, self._edge_look = material((0.0, 0.0, 0.0)), material((0.0, 0.0, 0.0))
        unseen = separate(material((1.0, 1.0, 1.0), 1.0), shape)
        coloured = separate(self._look, shape)
        self._faces = coin.SoSwitch()
        self._faces.addChild(coloured)
        self._faces.addChild(separate(see_through(), nearer(0.0), unseen, coloured))
        self.node = separate(
            separate(self._edge_look, nearer(EDGES_NEARER), lines),
            seen_from(outside=True), self._faces,
        )  # fmt: skip

    def paint(self, colour: Any, transparency: float) -> None:
        """Give it a colour, and a transparency from 0 to 1."""
        paint(self._look, colour)
        self._edge_look.diffuseColor = tuple(EDGE_DARKER * part for part in colour[:3])
        self._look.transparency = transparency
        self._faces.whichChild = 0 if transparency == 0 else 1


def transform(placement: Any) -> Any:
    """What moves nodes as FreeCAD's Placement does."""
    from pivy import coin

    turn = coin.SoMatrixTransform()
    a = placement.toMatrix().A
    turn.matrix.setValue(*[a[4 * column + row] for row in range(4) for column in range(4)])
    return turn


def unpickable() -> Any:
    """Clicks go through what is drawn."""
    from pivy import coin

    pick = coin.SoPickStyle()
    pick.style = coin.SoPickStyle.UNPICKABLE
    return pick


def separate(*parts: Any) -> Any:
    """A separator of these nodes."""
    from pivy import coin

    return _group(coin.SoSeparator(), *parts)


def _coin() -> Any:
    from pivy import coin

    return coin


def _group(group: Any, *parts: Any) -> Any:
    for part in parts:
        group.addChild(part)
    return group
