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


def show_mesh(obj: Any, node: Any) -> None:
    """Fill the node with a likeness of the object's mesh, and show it, where the mesh is large.

    Where it is not, the node is emptied and FreeCAD's own display takes over again.
    """
    node.removeAllChildren()
    view, most = obj.ViewObject, largest_shown()
    if obj.Mesh.CountFacets <= most:
        if view.DisplayMode == COARSE:
            view.DisplayMode = FINE
        return
    from freecad_volfrep.bridge.meshes import from_freecad
    from freecad_volfrep.bridge.solids import placed
    from volfrep.coarse import coarse_likeness

    # The view moves its nodes by the object's Placement, which the mesh has in it already.
    mesh = placed(from_freecad(obj.Mesh), obj.Placement.inverse())
    likeness = coarse_likeness(mesh, int(SHARE * most))
    _fill(node, likeness.vertices.tolist(), likeness.triangles.tolist(), view)
    view.DisplayMode = COARSE


def _fill(node: Any, points: list[Any], triangles: list[Any], view: Any) -> None:
    from pivy import coin

    material = coin.SoMaterial()
    material.diffuseColor = view.ShapeColor[:3]
    material.transparency = view.Transparency / 100.0
    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    hints.creaseAngle = CREASE_ANGLE
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), points)
    faces = coin.SoIndexedFaceSet()
    index = [number for triangle in triangles for number in (*triangle, -1)]
    faces.coordIndex.setValues(0, len(index), index)
    for part in (material, hints, coordinates, faces):
        node.addChild(part)
