# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large meshes on the screen: a coarse likeness in the place of millions of triangles."""

from __future__ import annotations

from typing import Any

from freecad_volfrep.preferences import largest_shown

#: Display modes: the coarse likeness, and FreeCAD's own for meshes.
COARSE, FINE = "Coarse", "Shaded"
#: The likeness has this share of the triangles that may be shown: what is small keeps turning.
SHARE = 0.25
CREASE_ANGLE = 0.6


def show_likeness(obj: Any, node: Any) -> None:
    """Fill the node with a likeness of the object's mesh.

    The cavity is shown opaque without the walls that face away, and the skin round it transparent:
    so the lattice is seen, and nothing has to be sorted when the view turns.
    """
    from freecad_volfrep.bridge.meshes import from_freecad
    from freecad_volfrep.bridge.solids import placed
    from volfrep.coarse import coarse_likeness, outside_and_cavities

    # The view moves its nodes by the object's Placement, which the mesh has in it already.
    view = obj.ViewObject
    mesh = placed(from_freecad(obj.Mesh), obj.Placement.inverse())
    outside, cavities = outside_and_cavities(mesh)
    limit = int(SHARE * largest_shown())
    if len(cavities.triangles):
        _add(node, coarse_likeness(cavities, limit), view, 0.0)
        _add(node, coarse_likeness(outside, limit), view, view.Transparency / 100.0)
    else:
        _add(node, coarse_likeness(outside, limit), view, 0.0)


def _add(node: Any, mesh: Any, view: Any, transparency: float) -> None:
    """A mesh under the node, without the triangles that are seen from behind."""
    from pivy import coin

    material = coin.SoMaterial()
    material.diffuseColor = view.ShapeColor[:3]
    material.transparency = transparency
    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    hints.shapeType = coin.SoShapeHints.SOLID
    hints.creaseAngle = CREASE_ANGLE
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(mesh.vertices), mesh.vertices.tolist())
    faces = coin.SoIndexedFaceSet()
    index = [number for triangle in mesh.triangles.tolist() for number in (*triangle, -1)]
    faces.coordIndex.setValues(0, len(index), index)
    group = coin.SoSeparator()
    for part in (material, hints, coordinates, faces):
        group.addChild(part)
    node.addChild(group)
