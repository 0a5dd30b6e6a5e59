# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh filled with second-order tetrahedra by Gmsh, its triangles kept as they are."""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..mesh.brep import FacetedBrep, faceted_brep
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..spatial.proximity import closest_points
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.subprocesses import run_program
from ..util.types import Floats, Ints

#: A solver needs about 50 kB for each of these: more are not a job for tetrahedra.
MAX_TRIANGLES = 200_000
#: The tetrahedra's volume may differ from the mesh's by this fraction.
VOLUME_TOLERANCE = 1e-6
#: Nodes are on a wall within this part of its box's diagonal: what single precision keeps.
WALL_TOLERANCE = 1e-6
#: Seconds, nodes, elements and bytes of the deck per triangle; measured on blocks and filled parts
#: of 10,000 to 40,000 triangles (the needles along a curved wall take up to three times as long).
SECONDS_PER_TRIANGLE = 2e-4
NODES_PER_TRIANGLE = 3.5
ELEMENTS_PER_TRIANGLE = 1.8
BYTES_PER_TRIANGLE = 250

#: Gmsh orders the last two mid-edge nodes of a tetrahedron the other way round than solvers do.
_SOLVER_ORDER = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
#: Delaunay (1): Gmsh's parallel HXT (10) fails on the needles that a Boolean leaves.
_GEO = """Merge "surface.msh";
%s
Mesh.Algorithm3D = 1;
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
    brep = faceted_brep(surface)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "surface.msh").write_bytes(_surface(surface, brep.shell))
        (folder / "fill.geo").write_text(_GEO % _volumes(brep), encoding="ascii")
        command = [program, "fill.geo", "-3", "-o", "filled.msh", "-v", "2"]
        said = run_program(command, folder, monitor)
        filled = folder / "filled.msh"
        if not filled.is_file() or said.returncode:
            raise _cannot_fill(said.stdout)
        result = _read(filled.read_bytes())
    volumes = result.volumes()
    if not len(volumes) or volumes.min() <= 0:
        raise _cannot_fill("it made tetrahedra that are inside out")
    if abs(volumes.sum() / surface.volume - 1.0) > VOLUME_TOLERANCE:
        raise _cannot_fill(f"it filled {volumes.sum():.6g} of {surface.volume:.6g} mm3")
    return result


def nodes_on(filled: TetrahedralMesh, wall: TriangleMesh) -> Ints:
    """Rows of the nodes that lie on a surface, within rounding."""
    low, high = wall.bounds
    near = WALL_TOLERANCE * float(np.linalg.norm(high - low))
    return np.flatnonzero(closest_points(wall, filled.nodes)[1] < near)


def _cannot_fill(why: str) -> VolfrepError:
    lines = [line.partition(":")[2] for line in why.splitlines() if line.startswith("Error")]
    reason = (lines[0] if lines else why).strip().rstrip(".") or "it said nothing"
    return VolfrepError(
        f"Gmsh cannot fill this mesh with tetrahedra ({reason}): use a coarser deviation, a joint "
        "fillet of 0, or beams."
    )


def _volumes(brep: FacetedBrep) -> str:
    """Each body as a volume of Gmsh's: its outer shell, then its voids."""
    loops = [f"Surface Loop({k + 1}) = {{{k + 1}}};" for k in range(len(brep.body))]
    volumes = [
        f"Volume({k + 1}) = {{{','.join(str(shell + 1) for shell in brep.shells_of(k))}}};"
        for k in range(brep.bodies)
    ]
    return "\n".join([*loops, *volumes, f"Physical Volume(1) = {{1:{brep.bodies}}};"])


def _surface(mesh: TriangleMesh, shell: Ints) -> bytes:
    """The mesh in Gmsh's format 2.2, a surface for each shell."""
    count, triangles = len(mesh.vertices), len(mesh.triangles)
    nodes = np.empty(count, np.dtype([("number", "<i4"), ("place", "<f8", 3)]))
    nodes["number"] = np.arange(1, count + 1)
    nodes["place"] = mesh.vertices
    # Number, tags (no physical group, so that it is not written again; surface), corners.
    rows = np.empty((triangles, 6), "<i4")
    rows[:, 0] = np.arange(1, triangles + 1)
    rows[:, 1] = 0
    rows[:, 2] = shell + 1
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
