# SPDX-License-Identifier: LGPL-2.1-or-later
"""What of an infill's skin is open or has a thickness of its own, and what is kept solid."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from volfrep.design.openings import OpenPatch
from volfrep.design.skins.kept_bodies import KeptBody
from volfrep.design.skins.own_faces import FaceSkin, KeptFace
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError


def openings_of(obj: App.DocumentObject) -> dict[str, Any]:
    """The values of the parameters for open faces and drain holes.

    Raises:
        VolfrepError: a property makes no sense, or a face is no more.
    """
    from freecad_volfrep.bridge.solids import face_facets, face_middle, parent_placement

    frame = parent_placement(obj)
    result: dict[str, Any] = {}
    if obj.OpenFaces:
        result["open_faces"] = tuple(
            OpenPatch(face_facets(owner, name, frame)) for owner, name in _each(obj.OpenFaces)
        )
    if obj.DrainDiameter.Value > 0:
        points = [tuple(point) for point in obj.DrainPoints]
        points += [face_middle(owner, name, frame) for owner, name in _each(obj.DrainFaces)]
        result["drain_points"] = tuple(points)
    if obj.SkinFaces:
        result["skin_faces"] = tuple(
            FaceSkin(OpenPatch(face_facets(owner, name, frame)), thickness)
            for owner, name, thickness in thick_faces(obj)
        )
    if obj.KeepSolidAround:
        result["keep_solid_around"] = tuple(
            _kept(obj, owner, name, frame) for owner, name in _each(obj.KeepSolidAround)
        )
    return result


def thick_faces(obj: App.DocumentObject) -> list[tuple[App.DocumentObject, str, float]]:
    """The faces of an infill with a skin of their own: objects, names and thicknesses in mm.

    Raises:
        VolfrepError: there are not as many thicknesses as faces.
    """
    faces, numbers = _each(obj.SkinFaces), list(obj.SkinThicknesses)
    if len(faces) != len(numbers):
        raise VolfrepError(
            f"SkinFaces holds {len(faces)} faces and SkinThicknesses {len(numbers)} numbers: give "
            "each face one."
        )
    return [(owner, name, number) for (owner, name), number in zip(faces, numbers, strict=True)]


def kept_mesh(owner: App.DocumentObject, frame: App.Placement) -> TriangleMesh:
    """The solid of an object whose room stays solid, as a mesh in the coordinates of `frame`.

    Raises:
        VolfrepError: it has none.
    """
    from freecad_volfrep.bridge.solids import SolidReader

    return SolidReader().read(owner, frame)


def _kept(
    obj: App.DocumentObject, owner: App.DocumentObject, name: str, frame: App.Placement
) -> KeptFace | KeptBody:
    """A face that is kept solid round, or a solid whose room is."""
    from freecad_volfrep.bridge.solids import face_facets
    from volfrep.io.solid import check_solid

    if name:
        return KeptFace(OpenPatch(face_facets(owner, name, frame)), obj.KeepDistance.Value)
    solid = check_solid(kept_mesh(owner, frame), owner.Label)
    return KeptBody(solid.vertices, solid.triangles, name=owner.Label)


def open_faces(
    infill: App.DocumentObject, picked: list[tuple[App.DocumentObject, tuple[str, ...]]]
) -> None:
    """Leave faces without a skin, beside those that are open already.

    Args:
        infill: a lattice infill; it is recomputed with the document.
        picked: objects and the names of their faces.
    """
    faces = {owner: list(names) for owner, names in infill.OpenFaces}
    for owner, names in picked:
        known = faces.setdefault(owner, [])
        known += [name for name in names if name not in known]
    infill.OpenFaces = [(owner, tuple(names)) for owner, names in faces.items()]


def _each(links: list[Any]) -> list[tuple[App.DocumentObject, str]]:
    """The objects and their elements of a property that links to elements of several objects."""
    return [(owner, name) for owner, names in links for name in names]
