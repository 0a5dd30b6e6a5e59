# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes and lines as nodes of Coin's scene, from arrays."""

from __future__ import annotations

from typing import Any

import numpy as np

from volfrep.mesh import TriangleMesh
from volfrep.shading import CREASE_ANGLE, shaded, sharp_edges

#: How shiny what we draw is.
SPECULAR, SHININESS = (0.22, 0.22, 0.22), 0.35
AMBIENT = (0.35, 0.35, 0.35)
EDGE_WIDTH = 1.5


def faces(mesh: TriangleMesh, crease_angle: float = CREASE_ANGLE) -> Any:
    """A group that draws a mesh, without a look: coordinates, normals, triangles."""
    from pivy import coin

    drawn = shaded(mesh, crease_angle)
    coordinates, normals = coin.SoCoordinate3(), coin.SoNormal()
    coordinates.point.setValues(0, len(drawn.points), drawn.points)
    normals.vector.setValues(0, len(drawn.normals), drawn.normals)
    binding = coin.SoNormalBinding()
    binding.value = coin.SoNormalBinding.PER_VERTEX_INDEXED
    triangles = coin.SoIndexedFaceSet()
    index = np.full((len(drawn.triangles), 4), -1)
    index[:, :3] = drawn.triangles
    triangles.coordIndex.setValues(0, index.size, index.ravel().tolist())
    return _group(coin.SoGroup(), coordinates, normals, binding, triangles)


def edges(mesh: TriangleMesh) -> Any:
    """A group that draws a mesh's sharp edges, without a colour."""
    from pivy import coin

    ends = sharp_edges(mesh)
    vertices, index = np.unique(ends, return_inverse=True)
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(vertices), mesh.vertices[vertices].astype(np.float32))
    lines = coin.SoIndexedLineSet()
    rows = np.full((len(ends), 3), -1)
    rows[:, :2] = index.reshape(-1, 2)
    lines.coordIndex.setValues(0, rows.size, rows.ravel().tolist())
    style = coin.SoDrawStyle()
    style.lineWidth = EDGE_WIDTH
    return _group(coin.SoGroup(), flat_light(), style, coordinates, lines)


def material(colour: Any, transparency: float = 0.0) -> Any:
    """What all that we draw is made of, in a colour of red, green and blue from 0 to 1."""
    from pivy import coin

    node = coin.SoMaterial()
    node.ambientColor, node.specularColor, node.shininess = AMBIENT, SPECULAR, SHININESS
    node.diffuseColor, node.transparency = tuple(colour[:3]), transparency
    return node


def seen_from(outside: bool) -> Any:
    """Draw triangles only where their outside, or their inside, faces the viewer."""
    from pivy import coin

    hints = coin.SoShapeHints()
    ordering = "COUNTERCLOCKWISE" if outside else "CLOCKWISE"
    hints.vertexOrdering = getattr(coin.SoShapeHints, ordering)
    hints.shapeType = coin.SoShapeHints.SOLID
    return hints


def behind_edges() -> Any:
    """Push faces back a little, so that the edges on them are whole lines."""
    from pivy import coin

    offset = coin.SoPolygonOffset()
    offset.factor, offset.units = 1.0, 1.0
    return offset


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


def nearest_only() -> Any:
    """Let what is drawn hide what is behind it, though it is transparent."""
    from pivy import coin

    depth = coin.SoDepthBuffer()
    depth.test, depth.write = True, True
    depth.function = coin.SoDepthBuffer.LEQUAL
    return depth


def separate(*parts: Any) -> Any:
    """A separator of these nodes."""
    from pivy import coin

    return _group(coin.SoSeparator(), *parts)


def _group(group: Any, *parts: Any) -> Any:
    for part in parts:
        group.addChild(part)
    return group
