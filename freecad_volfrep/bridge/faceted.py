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
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from volfrep.errors import VolfrepError
from volfrep.mesh import TriangleMesh

#: OpenCASCADE's own default, in mm: points nearer than this are the same to it.
TOLERANCE = 1e-7

_VERTEX = f"Ve\n{TOLERANCE:g}\n%.17g %.17g %.17g\n0 0\n\n0101101\n*\n"
_EDGE = f"Ed\n {TOLERANCE:g} 1 1 0\n1  %d 0 0 %.17g\n0\n\n0101000\n+%d 0 -%d 0 *\n"
_WIRE = "Wi\n\n0101100\n%+d 0 %+d 0 %+d 0 *\n"
_FACE = f"Fa\n0  {TOLERANCE:g} %d 0\n\n0101000\n+%d 0 *\n"
_LINE = "1 %.17g %.17g %.17g %.17g %.17g %.17g\n"
_PLANE = "1 %.17g %.17g %.17g" + " %.17g" * 9 + "\n"


def faceted_solid(mesh: TriangleMesh) -> Part.Shape:
    """The mesh as a solid, or as a compound of solids where it has several bodies.

    Surfaces that enclose emptiness become voids of the one solid they lie in.

    Raises:
        VolfrepError: the mesh is not closed, has triangles without an area, has several bodies
            as well as voids, or OpenCASCADE does not take it.
    """
    edges, wires, normals = _topology(mesh)
    pieces, shell_of = connected_components(
        coo_matrix(
            (np.ones(3 * len(wires), bool), (np.repeat(np.arange(len(wires)), 3), _index(wires))),
            shape=(len(wires), len(edges)),
        )
        @ coo_matrix(
            (np.ones(3 * len(wires), bool), (_index(wires), np.repeat(np.arange(len(wires)), 3))),
            shape=(len(edges), len(wires)),
        ),
        directed=False,
    )
    volumes = np.bincount(shell_of, mesh.signed_volumes(), pieces)
    bodies = int((volumes > 0).sum())
    if bodies == 0:
        raise VolfrepError("The mesh encloses no volume: update the object first.")
    if 1 < bodies < pieces:
        raise VolfrepError(
            f"The mesh has {bodies} separate bodies, and voids that belong to one of them: "
            "make a solid of each body by itself."
        )
    shape = Part.Shape()
    shape.importBrepFromString(_brep(mesh, edges, wires, normals, shell_of, bodies))
    if shape.isNull() or len(shape.Solids) != bodies:
        raise VolfrepError("OpenCASCADE did not make a solid of this mesh.")
    return shape


def _index(wires: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.abs(wires).ravel() - 1


def _topology(
    mesh: TriangleMesh,
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Edges (n, 2) as vertices, wires (m, 3) as edges from 1 (minus: backwards), normals (m, 3)."""
    start = mesh.triangles.astype(np.int64)
    end = np.roll(start, -1, axis=1)
    packed = np.minimum(start, end) * len(mesh.vertices) + np.maximum(start, end)
    keys, inverse, counts = np.unique(packed.ravel(), return_inverse=True, return_counts=True)
    inverse = inverse.reshape(start.shape)
    sign = np.where(start < end, 1, -1)
    balance = np.bincount(inverse.ravel(), sign.ravel(), len(keys))
    if not (counts == 2).all() or balance.any():
        bad = int(((counts != 2) | (balance != 0)).sum())
        raise VolfrepError(
            f"The mesh is not closed: {bad} of its edges do not have a triangle on either side."
        )
    edges = np.stack([keys // len(mesh.vertices), keys % len(mesh.vertices)], axis=1)
    a, b, c = mesh.corners()
    normals = np.cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    if not (length > TOLERANCE**2).all():
        raise VolfrepError(
            f"The mesh has {int((length <= TOLERANCE**2).sum())} triangles without an area: "
            "use a coarser deviation."
        )
    return edges, sign * (inverse + 1), normals / length


def _brep(
    mesh: TriangleMesh,
    edges: NDArray[np.int64],
    wires: NDArray[np.int64],
    normals: NDArray[np.float64],
    shell_of: NDArray[np.int32],
    bodies: int,
) -> str:
    """The BREP text. Shapes refer to earlier ones by their place counted from the last one, 1."""
    shells = int(shell_of.max()) + 1
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
        "Sh\n\n0101100\n" + _rows("+%d 0 ", first_face - np.flatnonzero(shell_of == k)) + "*\n"
        for k in range(shells)
    ]
    groups = [range(shells)] if bodies == 1 else [[k] for k in range(shells)]
    solid_texts = [
        "So\n\n1100000\n" + "".join(f"+{first_shell - k} 0 " for k in group) + "*\n"
        for group in groups
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
