# SPDX-License-Identifier: LGPL-2.1-or-later
"""Directions and points of what a user has picked: faces, edges, vertices, axes and planes."""

from __future__ import annotations

import FreeCAD as App
import Part

from volfrep.util.errors import VolfrepError

from .solids import face_middle, parent_placement, resolve_base

#: Directions of an origin's axes and planes, by their roles.
_ROLES = {
    "X_Axis": (1, 0, 0), "Y_Axis": (0, 1, 0), "Z_Axis": (0, 0, 1),
    "XY_Plane": (0, 0, 1), "XZ_Plane": (0, 1, 0), "YZ_Plane": (1, 0, 0),
}  # fmt: skip
#: Datums of PartDesign and the kind, which have theirs along their own Z.
_DATUMS = ("PartDesign::Line", "PartDesign::Plane", "Part::DatumLine", "Part::DatumPlane")
#: Faces are alike whose areas and radii differ by no more, as a share.
ALIKE = 0.05


def direction_of(owner: App.DocumentObject, name: str, frame: App.Placement) -> App.Vector:
    """Where something that was picked points, of length 1.

    A straight edge along itself, a round one and a face of a cylinder, cone or torus along their
    axis, a plane face outwards, an axis or a plane of an origin or of a datum as they do.

    Args:
        owner: the object.
        name: of the element, or empty for the whole object.
        frame: the coordinate system that the direction is wanted in.

    Raises:
        VolfrepError: it has no direction.
    """
    way = _direction(owner, name)
    if way is None:
        raise VolfrepError(
            f"'{name or owner.Label}' has no direction: pick a straight or a round edge, a plane "
            "or a round face, an axis or a plane."
        )
    turn = frame.inverse().multiply(parent_placement(resolve_base(owner))).Rotation
    turned = turn.multVec(way)
    length = turned.Length
    return App.Vector(*(_clean(part / length) for part in turned))


def point_of(owner: App.DocumentObject, name: str, frame: App.Placement) -> App.Vector:
    """The point that something stands for that was picked, mm.

    A vertex itself, the centre of a round edge, the middle of another edge or of a face.

    Args:
        owner: the object.
        name: of the element.
        frame: the coordinate system that the point is wanted in.

    Raises:
        VolfrepError: it stands for none.
    """
    element = _element(owner, name)
    kind = None if element is None else element.ShapeType
    if kind == "Face":
        return App.Vector(*face_middle(owner, name, frame))
    if kind not in ("Edge", "Vertex"):
        raise VolfrepError(f"'{name or owner.Label}' has no middle: pick a vertex, edge or face.")
    assert element is not None
    if kind == "Vertex":
        point = element.Point
    else:
        centre = getattr(element.Curve, "Center", None)
        point = element.CenterOfMass if centre is None else centre
    return frame.inverse().multiply(parent_placement(resolve_base(owner))).multVec(point)


def faces_alike(owner: App.DocumentObject, name: str) -> list[str]:
    """Names of the faces like one that was picked, itself among them: all bolt holes, say.

    They are of the same kind of surface and of about its area, and where they have an axis or a
    normal it is parallel; round ones are of about its radius.
    """
    picked = _element(owner, name)
    if picked is None or picked.ShapeType != "Face":
        return [name]
    faces = Part.getShape(resolve_base(owner)).Faces
    return [f"Face{k}" for k, face in enumerate(faces, 1) if _are_alike(face, picked)]


def _are_alike(face: Part.Face, picked: Part.Face) -> bool:
    sizes = [(face.Area, picked.Area)]
    if face.Surface.TypeId != picked.Surface.TypeId:
        return False
    if hasattr(picked.Surface, "Radius"):
        sizes.append((face.Surface.Radius, picked.Surface.Radius))
    ways = [getattr(one.Surface, "Axis", None) for one in (face, picked)]
    is_along = None in ways or ways[0].cross(ways[1]).Length < ALIKE
    return is_along and all(abs(one - other) <= ALIKE * other for one, other in sizes)


def _direction(owner: App.DocumentObject, name: str) -> App.Vector | None:
    role = getattr(owner, "Role", "")
    if role in _ROLES:
        return App.Vector(*_ROLES[role])
    if owner.TypeId in _DATUMS:
        return owner.Placement.Rotation.multVec(App.Vector(0, 0, 1))
    element = _element(owner, name)
    if element is None or element.ShapeType not in ("Edge", "Face"):
        return None
    if element.ShapeType == "Edge":
        if element.Curve.TypeId == "Part::GeomLine":
            return element.tangentAt(element.FirstParameter)
        return getattr(element.Curve, "Axis", None)
    if element.Surface.TypeId == "Part::GeomPlane":
        return element.normalAt(*(0.5 * sum(ends) for ends in _spans(element)))
    return getattr(element.Surface, "Axis", None)


def _spans(face: Part.Face) -> tuple[tuple[float, float], tuple[float, float]]:
    low_u, high_u, low_v, high_v = face.ParameterRange
    return (low_u, high_u), (low_v, high_v)


def _element(owner: App.DocumentObject, name: str) -> Part.Shape | None:
    """A face, edge or vertex of an object, where the object is placed."""
    if not name:
        return None
    shape = Part.getShape(resolve_base(owner), name, needSubElement=True)
    return None if shape.isNull() else shape


def _clean(number: float) -> float:
    """Without what rounding leaves of a 0 or a 1."""
    return round(number, 12) + 0.0
