# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh as a STEP solid with a plane face for every triangle, written as text.

No shape is built: the mesh knows its neighbours, so that edges and vertices are shared in the
file as they are in the mesh, and every reader sees a closed solid without sewing anything.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...design.costs import FILE_BYTES
from ...mesh.brep import FacetedBrep, faceted_brep
from ...mesh.triangle_mesh import TriangleMesh, compact
from ...util.errors import VolfrepError
from ...util.files import replacing
from ...util.progress import Monitor
from ...util.text_rows import rows
from ...util.types import Ints
from .step import CLOSING, CONTEXT, FIRST_FREE, PLACEMENT, POINT, REAL, opening, product, references

#: No program reads more of these faces in reasonable time (FreeCAD: a minute for a tenth).
MAX_TRIANGLES = 1_000_000
#: Seconds of a file, per triangle; measured on spheres of 1,000 to 500,000 triangles.
SECONDS_PER_TRIANGLE = 1.5e-5

_VERTEX = f"#%d=CARTESIAN_POINT('',{POINT});\n#%d=VERTEX_POINT('',#%d);\n"
_EDGE = (
    f"#%d=DIRECTION('',{POINT});\n#%d=VECTOR('',#%d,{REAL});\n"
    "#%d=LINE('',#%d,#%d);\n#%d=EDGE_CURVE('',#%d,#%d,#%d,.T.);\n"
)
_FACE = (
    "#%d=ORIENTED_EDGE('',*,*,#%d,.%s.);\n" * 3
    + "#%d=EDGE_LOOP('',(#%d,#%d,#%d));\n#%d=FACE_OUTER_BOUND('',#%d,.T.);\n"
    + f"#%d=DIRECTION('',{POINT});\n#%d=AXIS2_PLACEMENT_3D('',#%d,#%d,$);\n"
    + "#%d=PLANE('',#%d);\n#%d=ADVANCED_FACE('',(#%d),#%d,.T.);\n"
)
_ENTITIES_OF_VERTEX, _ENTITIES_OF_EDGE, _ENTITIES_OF_FACE = 2, 4, 9


def write_step_faceted(
    mesh: TriangleMesh, path: str | os.PathLike[str], monitor: Monitor | None = None
) -> None:
    """Write a closed mesh as STEP (AP214): one solid a body, with its voids.

    Args:
        mesh: closed, in mm.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.

    Raises:
        VolfrepError: the mesh is empty, not closed or has more than `MAX_TRIANGLES` triangles;
            or the path cannot be written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    if len(mesh.triangles) > MAX_TRIANGLES:
        raise VolfrepError(
            f"Cannot write '{path}': {len(mesh.triangles):,} triangles are more than the "
            f"{MAX_TRIANGLES:,} plane faces that any program reads; choose larger cells, a "
            "coarser deviation, the exact STEP form, or STL."
        )
    brep = faceted_brep(compact(mesh))
    with replacing(path) as file:
        written, total = 0, FILE_BYTES["step"] * len(mesh.triangles)
        for piece in _pieces(brep, Path(path).stem):
            file.write(piece)
            written += len(piece)
            if monitor is not None:
                monitor.tick(written / total)


def predict_faceted(triangles: int) -> tuple[float, float]:
    """Seconds and megabytes of the file of so many triangles."""
    return SECONDS_PER_TRIANGLE * triangles, 1e-6 * FILE_BYTES["step"] * triangles


def _pieces(brep: FacetedBrep, name: str) -> Iterator[bytes]:
    mesh, edges = brep.mesh, brep.edges
    # Entities are numbered by counting: vertices, then edges, then faces, then what holds them.
    vertex = FIRST_FREE + _ENTITIES_OF_VERTEX * np.arange(len(mesh.vertices))
    first_edge = FIRST_FREE + _ENTITIES_OF_VERTEX * len(vertex)
    edge = first_edge + _ENTITIES_OF_EDGE * np.arange(len(edges))
    first_face = first_edge + _ENTITIES_OF_EDGE * len(edges)
    face = first_face + _ENTITIES_OF_FACE * np.arange(len(mesh.triangles))
    last = first_face + _ENTITIES_OF_FACE * len(face)

    yield opening(name, "one plane face a triangle").encode("ascii")
    yield from rows(_VERTEX, vertex, mesh.vertices, vertex + 1, vertex)

    along = mesh.vertices[edges[:, 1]] - mesh.vertices[edges[:, 0]]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    ends = vertex[edges]
    yield from rows(
        _EDGE, edge, along, edge + 1, edge, np.ones(len(edge)),
        edge + 2, ends[:, 0], edge + 1, edge + 3, ends + 1, edge + 2,
    )  # fmt: skip

    curves = edge[np.abs(brep.loops) - 1] + 3
    ways = np.where(brep.loops > 0, "T", "F")
    used = [column for k in range(3) for column in (face + k, curves[:, k], ways[:, k])]
    yield from rows(
        _FACE, *used, face + 3, face, face + 1, face + 2, face + 4, face + 3,
        face + 5, brep.normals, face + 6, vertex[mesh.triangles[:, 0]], face + 5,
        face + 7, face + 6, face + 8, face + 4, face + 7,
    )  # fmt: skip
    yield _solids(brep, face + 8, last, name).encode("ascii")


def _solids(brep: FacetedBrep, faces: Ints, first: int, name: str) -> str:
    """The shells, the solids, their representation and the product; numbered from `first`."""
    order = np.argsort(brep.shell, kind="stable")
    by_shell = np.split(faces[order], np.cumsum(np.bincount(brep.shell))[:-1])
    shells = [
        f"#{first + k}=CLOSED_SHELL('',({references(own)}));\n" for k, own in enumerate(by_shell)
    ]
    shell, number, text = first, first + len(shells), shells
    solids = []
    for body in range(brep.bodies):
        outer, *voids = brep.shells_of(body)
        for void in voids:
            text.append(f"#{number}=ORIENTED_CLOSED_SHELL('',*,#{shell + void},.T.);\n")
            number += 1
        inner = references(np.arange(number - len(voids), number))
        kind = (
            f"BREP_WITH_VOIDS('',#{shell + outer},({inner}))"
            if voids
            else (f"MANIFOLD_SOLID_BREP('',#{shell + outer})")
        )
        text.append(f"#{number}={kind};\n")
        solids.append(number)
        number += 1
    items = references(np.array([PLACEMENT, *solids]))
    text.append(
        f"#{number}=ADVANCED_BREP_SHAPE_REPRESENTATION('',({items}),#{CONTEXT});\n"
        + product(number + 1, name, number)
        + CLOSING
    )
    return "".join(text)
