# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh filled with second-order tetrahedra by Gmsh, its triangles kept as they are."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .errors import VolfrepError
from .mesh import TriangleMesh, compact
from .progress import Monitor

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

#: A solver needs about 50 kB for each of these: more are not a job for tetrahedra.
MAX_TRIANGLES = 200_000
#: The tetrahedra's volume may differ from the mesh's by this fraction.
VOLUME_TOLERANCE = 1e-6
#: Seconds, nodes and elements per triangle; measured on blocks of struts of 10,000 to 100,000.
SECONDS_PER_TRIANGLE = 1.5e-4
NODES_PER_TRIANGLE = 3.8
ELEMENTS_PER_TRIANGLE = 2.0

#: Gmsh orders the last two mid-edge nodes of a tetrahedron the other way round than solvers do.
_SOLVER_ORDER = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
_GEO = """Merge "surface.msh";
Surface Loop(1) = {1};
Volume(1) = {1};
Physical Volume(1) = {1};
Mesh.Algorithm3D = 10;
Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;
Mesh.Optimize = 1;
Mesh.MshFileVersion = 2.2;
"""


@dataclass(frozen=True, eq=False)
class TetrahedralMesh:
    """Second-order tetrahedra with straight edges.

    Attributes:
        nodes: (n, 3) float64, mm.
        elements: (m, 10) int64, rows of `nodes`: four corners, then the middles of the edges
            1-2, 2-3, 3-1, 1-4, 2-4, 3-4 (the order of CalculiX and of FreeCAD).
    """

    nodes: Floats
    elements: Ints

    def volumes(self) -> Floats:
        """(m,) signed volume of each tetrahedron, mm3."""
        a, b, c, d = (self.nodes[self.elements[:, k]] for k in range(4))
        volumes: Floats = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6.0
        return volumes


def tetrahedra(mesh: TriangleMesh, monitor: Monitor | None = None) -> TetrahedralMesh:
    """Fill a closed mesh with tetrahedra whose outer faces are its triangles.

    Args:
        mesh: closed, without needles: a block's, or one that was remeshed; mm.
        monitor: asked for a cancel while Gmsh runs.

    Raises:
        VolfrepError: Gmsh is not installed, the mesh has more than `MAX_TRIANGLES` triangles, or
            Gmsh cannot fill it.
        Cancelled: when the monitor says so.
    """
    program = shutil.which("gmsh")
    if program is None:
        raise VolfrepError("Gmsh is not installed: install it ('apt-get install gmsh').")
    if len(mesh.triangles) > MAX_TRIANGLES:
        raise VolfrepError(
            f"Tetrahedra from {len(mesh.triangles):,} triangles would be more than a solver takes "
            f"(the limit is {MAX_TRIANGLES:,}): choose a coarser deviation or fewer cells, or "
            "solve it with beams."
        )
    surface = compact(mesh)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "surface.msh").write_bytes(_surface(surface))
        (folder / "fill.geo").write_text(_GEO, encoding="ascii")
        command = [program, "fill.geo", "-3", "-o", "filled.msh", "-v", "2"]
        said = _run(command, folder, monitor)
        filled = folder / "filled.msh"
        if not filled.is_file() or said.returncode:
            raise _cannot_fill(said.stdout + said.stderr)
        result = _read(filled.read_bytes())
    volumes = result.volumes()
    if not len(volumes) or volumes.min() <= 0:
        raise _cannot_fill("it made tetrahedra that are inside out")
    if abs(volumes.sum() / surface.volume - 1.0) > VOLUME_TOLERANCE:
        raise _cannot_fill(f"it filled {volumes.sum():.6g} of {surface.volume:.6g} mm3")
    return result


def _run(
    command: list[str], folder: Path, monitor: Monitor | None
) -> subprocess.CompletedProcess[str]:
    def call() -> subprocess.CompletedProcess[str]:
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)

    return call() if monitor is None else monitor.call(call)


def _cannot_fill(why: str) -> VolfrepError:
    lines = [line.partition(":")[2] for line in why.splitlines() if line.startswith("Error")]
    reason = (lines[0] if lines else why).strip().rstrip(".") or "it said nothing"
    return VolfrepError(
        f"Gmsh cannot fill this mesh with tetrahedra ({reason}): use a coarser deviation, a joint "
        "fillet of 0, or beams."
    )


def _surface(mesh: TriangleMesh) -> bytes:
    """The mesh in Gmsh's format 2.2, as the triangles of surface 1."""
    count, triangles = len(mesh.vertices), len(mesh.triangles)
    nodes = np.empty(count, np.dtype([("number", "<i4"), ("place", "<f8", 3)]))
    nodes["number"] = np.arange(1, count + 1)
    nodes["place"] = mesh.vertices
    # Number, tags (no physical group, so that it is not written again; surface 1), corners.
    rows = np.empty((triangles, 6), "<i4")
    rows[:, 0] = np.arange(1, triangles + 1)
    rows[:, 1:3] = 0, 1
    rows[:, 3:] = mesh.triangles + 1
    one = np.array([1], "<i4").tobytes()
    kind = np.array([2, triangles, 2], "<i4").tobytes()
    return b"".join(
        [
            b"$MeshFormat\n2.2 1 8\n", one, b"\n$EndMeshFormat\n",
            b"$Nodes\n%d\n" % count, nodes.tobytes(), b"\n$EndNodes\n",
            b"$Elements\n%d\n" % triangles, kind, rows.tobytes(), b"\n$EndElements\n",
        ]
    )  # fmt: skip


def _read(data: bytes) -> TetrahedralMesh:
    """Nodes and elements of Gmsh's format 2.2, as text that holds nothing but tetrahedra."""
    nodes = np.array(_section(data, b"Nodes").split()[1:], np.float64).reshape(-1, 4)
    rows = np.array(_section(data, b"Elements").split()[1:], np.int64).reshape(-1, 15)
    # Gmsh's numbers may have gaps: they become rows.
    row_of = np.zeros(int(nodes[:, 0].max()) + 1, np.int64)
    row_of[nodes[:, 0].astype(np.int64)] = np.arange(len(nodes))
    return TetrahedralMesh(nodes[:, 1:].copy(), row_of[rows[:, 5:][:, _SOLVER_ORDER]])


def _section(data: bytes, name: bytes) -> bytes:
    start = data.index(b"$" + name + b"\n") + len(name) + 2
    return data[start : data.index(b"$End" + name, start)]
