# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a triangle mesh to a `Part` solid with a plane face for every triangle.

FreeCAD's own way (makeShapeFromMesh) sews the triangles together again by tolerance, for minutes
from some ten thousand triangles on. A mesh knows its neighbours already, so the solid is written
down as it is, in OpenCASCADE's BREP text, and read: the time is proportional to the triangles.
"""

from __future__ import annotations

import numpy as np
import Part
from numpy.typing import NDArray

from volfrep.mesh.brep import TOLERANCE, FacetedBrep, faceted_brep
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError

_VERTEX = f"Ve\n{TOLERANCE:g}\n%.17g %.17g %.17g\n0 0\n\n0101101\n*\n"
_EDGE = f"Ed\n {TOLERANCE:g} 1 1 0\n1  %d 0 0 %.17g\n0\n\n0101000\n+%d 0 -%d 0 *\n"
_WIRE = "Wi\n\n0101100\n%+d 0 %+d 0 %+d 0 *\n"
_FACE = f"Fa\n0  {TOLERANCE:g} %d 0\n\n0101000\n+%d 0 *\n"
_LINE = "1 %.17g %.17g %.17g %.17g %.17g %.17g\n"
_PLANE = "1 %.17g %.17g %.17g" + " %.17g" * 9 + "\n"


def faceted_solid(mesh: TriangleMesh) -> Part.Shape:
    """The mesh as a solid, or as a compound of solids where it has several bodies.

    Surfaces that enclose emptiness become voids of the solid they lie in.

    Raises:
        VolfrepError: the mesh is not closed, has triangles without an area, or OpenCASCADE does
            not take it.
    """
    brep = faceted_brep(mesh)
    shape = Part.Shape()
    shape.importBrepFromString(_text(brep))
    if shape.isNull() or len(shape.Solids) != brep.bodies:
        raise VolfrepError("OpenCASCADE did not make a solid of this mesh.")
    return shape


def _text(brep: FacetedBrep) -> str:
    """The BREP text. Shapes refer to earlier ones by their place counted from the last one, 1."""
    mesh, edges, wires, normals, bodies = (
        brep.mesh, brep.edges, brep.loops, brep.normals, brep.bodies
    )  # fmt: skip
    shells = len(brep.body)
    n_vertices, n_edges, n_faces = len(mesh.vertices), len(edges), len(wires)
    total = n_vertices + n_edges + 2 * n_faces + shells + bodies
    if bodies > 1:
        total += 1  # the compound around them
    first_edge = total - n_vertices
    first_wire = first_edge - n_edges
    first_face = first_wire - n_faces
    first_shell = first_face - n_faces
    first_solid = first_shell - shells

    tail, head = mesh.vertices[edges[:, 0]], mesh.vertices[edges[:, 1]]
    along = head - tail
    length = np.linalg.norm(along, axis=1, keepdims=True)
    along = along / length
    corner, second, _ = mesh.corners()
    x = second - corner
    x = x / np.linalg.norm(x, axis=1, keepdims=True)
    planes = np.hstack([corner, normals, x, np.cross(normals, x)])
    number = np.arange(1, n_edges + 1)[:, None]
    edge_rows = np.hstack([number, length, total - edges])
    wire_rows = np.sign(wires) * (first_edge + 1 - np.abs(wires))
    face_rows = np.stack([np.arange(1, n_faces + 1), first_wire - np.arange(n_faces)], axis=1)
    shell_texts = [
        "Sh\n\n0101100\n" + _rows("+%d 0 ", first_face - np.flatnonzero(brep.shell == k)) + "*\n"
        for k in range(shells)
    ]
    solid_texts = [
        "So\n\n1100000\n" + "".join(f"+{first_shell - k} 0 " for k in brep.shells_of(body)) + "*\n"
        for body in range(bodies)
    ]
    if bodies > 1:
        solids = "".join(f"+{first_solid - k} 0 " for k in range(bodies))
        solid_texts.append(f"Co\n\n1100000\n{solids}*\n")
    parts = [
        "\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\n",
        f"Curves {n_edges}\n",
        _rows(_LINE, np.hstack([tail, along])),
        "Polygon3D 0\nPolygonOnTriangulations 0\n",
        f"Surfaces {n_faces}\n",
        _rows(_PLANE, planes),
        f"Triangulations 0\n\nTShapes {total}\n",
        _rows(_VERTEX, mesh.vertices),
        _rows(_EDGE, edge_rows),
        _rows(_WIRE, wire_rows),
        _rows(_FACE, face_rows),
        *shell_texts,
        *solid_texts,
        "\n+1 0 \n",
    ]
    return "".join(parts)


def _rows(template: str, values: NDArray[np.generic]) -> str:
    """The template once for every row, filled in by one formatting call."""
    return (template * len(values)) % tuple(values.ravel().tolist())
