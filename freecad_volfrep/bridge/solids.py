# SPDX-License-Identifier: LGPL-2.1-or-later
"""From what a user picks (a solid, a Body, an App::Part, a Link, a mesh) to a triangle mesh."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import numpy as np
import Part
from numpy.typing import NDArray

from volfrep.io.tessellation import ANGULAR_DEVIATION, MAX_DEVIATION, RELATIVE_DEVIATION
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.util.content import rough
from volfrep.util.errors import VolfrepError

from .meshes import from_freecad

#: Before the kinds of elements.
_A = {"Face": "a", "Edge": "an", "Vertex": "a"}


def resolve_base(obj: App.DocumentObject) -> App.DocumentObject:
    """What to fill when `obj` was picked: the Body for a feature inside one, else `obj`."""
    parent = obj.getParentGeoFeatureGroup()
    if parent is not None and parent.TypeId == "PartDesign::Body":
        return parent
    return obj


def is_fillable(obj: App.DocumentObject) -> bool:
    """Whether the object holds a solid or a mesh; quick enough to be asked at every click."""
    target = _linked(resolve_base(obj))
    if target is None:
        return False
    if target.isDerivedFrom("Mesh::Feature"):
        return bool(target.Mesh.CountFacets)
    if target.TypeId == "App::Part":
        return any(is_fillable(member) for member in target.Group)
    if target.isDerivedFrom("Part::Feature"):
        return not target.Shape.isNull() and bool(target.Shape.Solids)
    return False


def surface_of(obj: App.DocumentObject) -> Part.Shape | None:
    """The shape of an object that has faces and no solid; None for any other."""
    target = _linked(resolve_base(obj))
    if target is None or not target.isDerivedFrom("Part::Feature") or target.Shape.isNull():
        return None
    shape = target.Shape
    return shape if shape.Faces and not shape.Solids else None


def parent_placement(obj: App.DocumentObject) -> App.Placement:
    """Placement of the coordinate system that `obj.Placement` refers to: its App::Part's."""
    parent = obj.getParentGeoFeatureGroup()
    return App.Placement() if parent is None else parent.getGlobalPlacement()


class SolidReader:
    """Reads a base object and remembers the last shape's mesh, for as long as it is the same."""

    def __init__(self) -> None:
        self._shape: Part.Shape | None = None
        self._mesh: TriangleMesh | None = None
        self._size: tuple[str, str] | None = None

    def read(self, base: App.DocumentObject, frame: App.Placement) -> TriangleMesh:
        """The base's solid as a mesh, in mm, in the coordinates of `frame`.

        Solids that overlap are fused. The mesh is as FreeCAD made it: not checked.

        Raises:
            VolfrepError: the base has no solid.
        """
        base = resolve_base(base)
        parent = parent_placement(base)
        to_frame = frame.inverse().multiply(parent)
        meshes = _mesh_objects(base)
        if meshes:
            self._shape = self._size = None
            mesh = concatenate(*(placed(from_freecad(m), p) for m, p in meshes))
            return placed(mesh, to_frame)
        shape = Part.getShape(base)
        if shape.isNull():
            raise VolfrepError(
                f"'{base.Label}' has no shape yet: recompute or repair it, or choose another Base."
            )
        known = self._shape is not None and self._shape.isPartner(shape)
        if not known or self._mesh is None:
            self._mesh = mesh_of_shape(_unplaced(shape), base.Label)
            self._size = rough(shape.Volume), rough(shape.Area)
            self._shape = shape
        return placed(self._mesh, to_frame.multiply(shape.Placement))

    def identity(self, mesh: TriangleMesh) -> tuple[Any, ...]:
        """What counts of the solid that was read last, for `volfrep.util.content.digest_of`.

        To a thousandth of a micrometre, so that the rounding of a placement that is undone, or of
        a file that was saved and opened, is no change. OpenCASCADE meshes a shape that was opened
        from a file in another order and, here and there, with other diagonals than before: so of
        a shape the corners of its mesh count, and how much it encloses.

        Args:
            mesh: what `read` has returned.
        """
        points = np.round(mesh.vertices, 6) + 0.0  # plus zero turns -0 to 0
        if self._size is None:
            return points, mesh.triangles.astype(np.int32)
        return points[np.lexsort(points.T)], len(mesh.triangles), *self._size


def mesh_of_shape(shape: Part.Shape, label: str) -> TriangleMesh:
    """The solids of a shape as one mesh; `label` names the object in error messages.

    Raises:
        VolfrepError: the shape has no solid, or it cannot be meshed.
    """
    import MeshPart

    solids = shape.Solids
    if not solids:
        raise VolfrepError(
            f"'{label}' is a {shape.ShapeType.lower()} without a solid: choose a solid, or close "
            "it and convert it to one (Part > Convert to solid)."
        )
    if _boxes_overlap(solids):
        solids = solids[0].multiFuse(solids[1:]).Solids
        if not solids:
            raise VolfrepError(f"The solids of '{label}' cannot be fused: fuse them yourself.")
    # A copy has no facets of its own: those made for the display would be used again, and the
    # result would depend on what was shown.
    body = Part.Compound(solids).copy()
    deviation = min(body.BoundBox.DiagonalLength * RELATIVE_DEVIATION, MAX_DEVIATION)
    mesh = MeshPart.meshFromShape(
        Shape=body, LinearDeflection=deviation, AngularDeflection=ANGULAR_DEVIATION, Relative=False
    )
    if not mesh.CountFacets:
        raise VolfrepError(f"'{label}' cannot be meshed: check its geometry (Part > Check).")
    return from_freecad(mesh)


def face_facets(owner: App.DocumentObject, name: str, frame: App.Placement) -> NDArray[np.float64]:
    """(k, 3, 3) corners of the facets of a face, in mm, in the coordinates of `frame`.

    Args:
        owner: the object that has it; the feature at the tip of a Body stands for the Body.
        name: such as Face6.
        frame: a placement in the document.

    Raises:
        VolfrepError: there is no such face.
    """
    face = _face(owner, name)
    size = Part.getShape(owner).BoundBox.DiagonalLength
    points, facets = face.tessellate(min(size * RELATIVE_DEVIATION, MAX_DEVIATION))
    mesh = TriangleMesh(
        np.array([tuple(point) for point in points], np.float64), np.array(facets, np.int32)
    )
    return np.stack(placed(mesh, _to_frame(owner, frame)).corners(), axis=1)


def face_middle(
    owner: App.DocumentObject, name: str, frame: App.Placement
) -> tuple[float, float, float]:
    """The middle of a face, as `face_facets` finds it; on the face where that is convex.

    Raises:
        VolfrepError: there is no such face.
    """
    middle = _to_frame(owner, frame).multVec(_face(owner, name).CenterOfMass)
    return middle.x, middle.y, middle.z


def placed_face(owner: App.DocumentObject, name: str, frame: App.Placement) -> Part.Face:
    """A face of an object in the coordinates of `frame`.

    Raises:
        VolfrepError: there is no such face.
    """
    face = _face(owner, name)
    move = _to_frame(owner, frame)
    return face if move.isIdentity() else face.transformed(move.toMatrix())


def edge_points(owner: App.DocumentObject, name: str, frame: App.Placement) -> NDArray[np.float64]:
    """(k, 3) points along an edge, in mm, in the coordinates of `frame`; two where it is straight.

    Raises:
        VolfrepError: there is no such edge.
    """
    edge = _element(owner, name, "Edge")
    size = Part.getShape(owner).BoundBox.DiagonalLength
    if edge.Curve.TypeId == "Part::GeomLine":
        points = [vertex.Point for vertex in edge.Vertexes]
    else:
        points = edge.discretize(Deflection=min(size * RELATIVE_DEVIATION, MAX_DEVIATION))
    to_frame = _to_frame(owner, frame)
    return np.array([tuple(to_frame.multVec(point)) for point in points], np.float64)


def vertex_point(
    owner: App.DocumentObject, name: str, frame: App.Placement
) -> tuple[float, float, float]:
    """A vertex, in mm, in the coordinates of `frame`.

    Raises:
        VolfrepError: there is no such vertex.
    """
    point = _to_frame(owner, frame).multVec(_element(owner, name, "Vertex").Point)
    return point.x, point.y, point.z


def _face(owner: App.DocumentObject, name: str) -> Part.Face:
    """A face of an object, where the object is placed."""
    return _element(owner, name, "Face")


def _element(owner: App.DocumentObject, name: str, kind: str) -> Part.Shape:
    """A face, an edge or a vertex of an object, where the object is placed."""
    shape = Part.getShape(resolve_base(owner), name, needSubElement=True)
    if shape.isNull() or shape.ShapeType != kind:
        what = kind.lower()
        raise VolfrepError(
            f"'{owner.Label}' has no {what} '{name}' any more: choose {_A[kind]} {what} again."
        )
    return shape


def _to_frame(owner: App.DocumentObject, frame: App.Placement) -> App.Placement:
    return frame.inverse().multiply(parent_placement(resolve_base(owner)))


def _linked(obj: App.DocumentObject) -> App.DocumentObject | None:
    """What a link, or a link to a link, stands for; any other object itself."""
    target: App.DocumentObject | None = obj.getLinkedObject(True)
    return target


def _mesh_objects(base: App.DocumentObject) -> list[tuple[object, App.Placement]]:
    """The meshes of a mesh object, of a link to one, or of an App::Part that holds no shape.

    Each comes with a placement that takes it to the coordinates `base.Placement` refers to.
    """
    target = _linked(base)
    if target is None:
        raise VolfrepError(f"The link '{base.Label}' leads nowhere: choose another Base.")
    if target.isDerivedFrom("Mesh::Feature"):
        own = target.Placement.inverse()  # the mesh already lies where its object does
        place = base.getSubObject("", retType=3)
        return [(target.Mesh, place.multiply(own))]
    if target.TypeId == "App::Part" and Part.getShape(base).isNull():
        place = base.getSubObject("", retType=3)
        return [(mesh, place.multiply(p)) for o in target.Group for mesh, p in _mesh_objects(o)]
    return []


def _unplaced(shape: Part.Shape) -> Part.Shape:
    """The shape in its own coordinates; shares its geometry with the original."""
    bare = Part.Shape(shape)
    bare.Placement = App.Placement()
    return bare


def placed(mesh: TriangleMesh, placement: App.Placement) -> TriangleMesh:
    """The mesh moved by a placement."""
    if placement.isIdentity():
        return mesh
    matrix = np.array(placement.toMatrix().A).reshape(4, 4)
    vertices = mesh.vertices @ matrix[:3, :3].T + matrix[:3, 3]
    return TriangleMesh(vertices, mesh.triangles)


def _boxes_overlap(solids: list[Part.Shape]) -> bool:
    """Whether any two solids' boxes touch, so that the solids may."""
    boxes = np.array(
        [
            [b.XMin, b.YMin, b.ZMin, b.XMax, b.YMax, b.ZMax]
            for b in (solid.BoundBox for solid in solids)
        ]
    )
    low, high = boxes[:, None, :3], boxes[:, None, 3:]
    apart = ((low > high.swapaxes(0, 1)) | (high < low.swapaxes(0, 1))).any(axis=2)
    return bool((~apart).sum() > len(solids))


def mesh_in_document(obj: App.DocumentObject) -> TriangleMesh:
    """The mesh of a mesh object in the document's coordinates, its App::Part's place included."""
    return placed(from_freecad(obj.Mesh), parent_placement(obj))
