# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh filled with second-order tetrahedra by Gmsh, without the needles of a cut.

By Gmsh's Delaunay algorithm: its parallel one (HXT) fails on the needles that a Boolean leaves.
What Gmsh cannot fill is filled with tetrahedra of a lattice, whose outside lies near the mesh's.
"""

from __future__ import annotations

import re
import shutil
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..mesh.brep import FacetedBrep, faceted_brep
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..mesh.well_shaped import Tolerance, angles_of, mend_bad_facets
from ..process.child import Limits, OverLimit
from ..process.programs import run_program
from ..spatial.proximity import closest_points, sample_triangles
from ..spatial.self_intersection import crossing_triangles
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Floats, Ints
from .facet_grading import grade_facets, side_lengths
from .fins import folded_facets, without_fins
from .single_moves import without_faults
from .stuffed_mesh import bodies_of, face_pairs, signed_volumes, stuffed_mesh

#: A solver needs about 50 kB for each of these: more are not a job for tetrahedra.
MAX_TRIANGLES = 200_000
#: The tetrahedra's volume may differ from the mesh's by this fraction.
VOLUME_TOLERANCE = 1e-6
#: Mending is told where it changes the volume by more than this fraction: beside the thin lip of a
#: wing small moves take much.
VOLUME_WARNED = 2e-3
#: Nodes are on a wall within this part of its box's diagonal: what single precision keeps.
SURFACE_TOLERANCE = 1e-6
#: Gmsh copes with facets that have no angle below this, degrees.
NEEDLE = 2.0
#: Needles and caps are mended where no move takes the surface farther than this part of the mesh's
#: median edge. About places where facets would cross or fold it may be less in the next try, each
#: time so many median edges farther about them, and they are mended so many times.
MENDING = 0.05
NEAR = 1.0
#: Facets that run through each other by less (median edges) touch: they lie in one plane.
TOUCHING = 1e-7
TRIES = 6
#: What Gmsh finds to intersect is mended less in a next try, so many times.
GMSH_TRIES = 4
#: Gmsh improves what it has filled, which does not end with a few meshes: it may take so many times
#: what is told for all, and at least so many seconds, and is left out then. After that time no
#: other try begins.
PATIENCE = 5.0
LEAST_PATIENCE = 120.0
#: No edge is split into pieces shorter than this part of it.
SHORTEST = 0.25
#: Seconds, nodes, elements and bytes of the deck per triangle, each within a factor of two of what
#: was measured on blocks, boxes with a skin and without, and the demo's bracket, of 16,000 to
#: 197,000 triangles: 2 to 7e-4 s, 2.5 to 4.6 nodes, 1.2 to 2.5 elements, 200 to 410 bytes. A skin
#: takes the most. Where a wall cuts the lattice the needles are mended before, in one to six tries
#: of 2 to 4e-4 s each.
SECONDS_PER_TRIANGLE = 4e-4
SECONDS_PER_CUT_TRIANGLE = 1e-3
NODES_PER_TRIANGLE = 3.6
ELEMENTS_PER_TRIANGLE = 1.9
BYTES_PER_TRIANGLE = 300

#: Tetrahedra of a lattice that fills what Gmsh cannot, and where those lose too much. With their
#: mid-edge nodes they have 1.7 to 1.8 nodes each: the first are as many nodes as the largest mesh
#: that Gmsh is given would have. A volume V with a surface A takes about 12 V / L^3 + 2 A / L^2 of
#: an edge L (where that says 400,000 it took 378,000 to 422,000). No edge need be shorter than the
#: surface's own.
LATTICE_TETRAHEDRA = (400_000, 1_200_000)
#: No more than this part of the volume may come or go by it.
MOST_GROWN = 0.05

#: Gmsh orders the last two mid-edge nodes of a tetrahedron the other way round than solvers do.
_SOLVER_ORDER = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
#: Edges in the order of their mid-edge nodes.
_EDGES = np.array([[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]])
#: The corners of each face, and the middles of its edges.
_FACES = [[0, 1, 2, 4, 5, 6], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [0, 2, 3, 6, 9, 7]]
#: Delaunay (1): Gmsh's parallel HXT (10) fails on the needles that a Boolean leaves. Facets that
#: meet at less than 0.1 degrees are a fault to Gmsh, if not told otherwise; where a strut grazes
#: the wall there may be such, and they cross nowhere.
_GEO = """Merge "surface.msh";
%s
Mesh.Algorithm3D = 1;
Mesh.AngleToleranceFacetOverlap = 0.001;
Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;
Mesh.Optimize = %d;
Mesh.MshFileVersion = 2.2;
"""


@dataclass(frozen=True, eq=False)
class TetrahedralMesh:
    """Second-order tetrahedra with straight edges.

    Attributes:
        nodes: (n, 3) float64, mm.
        elements: (m, 10) int64, rows of `nodes`: four corners, then the middles of the edges
            1-2, 2-3, 3-1, 1-4, 2-4, 3-4 (the order of CalculiX and of FreeCAD).
        moved: how far each move to mend the surface could take it, mm; 0 where nothing was.
        grown: by what part of it the volume became larger by that.
        improved: whether Gmsh came to an end with improving their shapes.
        lattice: the edge of the lattice that they are cut from, mm; 0 where Gmsh made them.
        away: how far places of the mesh's surface are from theirs then, mm: the farthest, and all
            but one in a hundred.
    """

    nodes: Floats
    elements: Ints
    moved: float = 0.0
    grown: float = 0.0
    improved: bool = True
    lattice: float = 0.0
    away: tuple[float, float] = (0.0, 0.0)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences where mending changed the volume, and where shapes were not improved."""
        if self.lattice:
            return (
                f"Gmsh cannot fill this mesh: its {len(self.elements):,} tetrahedra are cut from a "
                f"lattice of {self.lattice:.3g} mm instead, so that edges are rounded and what is "
                f"thinner may be lost. The surface is within {self.away[0]:.2g} mm of it "
                f"({self.away[1]:.2g} mm for 99 % of its places), the volume differs by "
                f"{self.grown:+.2%}.",
            )
        warnings = []
        if abs(self.grown) > VOLUME_WARNED:
            warnings.append(
                f"The tetrahedra's volume differs by {self.grown:+.2%} from the mesh's: its "
                "needles were mended, which takes from thin lips. A finer deviation takes less."
            )
        if not self.improved:
            warnings.append(
                "Gmsh came to no end with improving the tetrahedra, so that this is left out: some "
                "are flat. Another resolution or origin may do better."
            )
        return tuple(warnings)

    def volumes(self) -> Floats:
        """(m,) signed volume of each tetrahedron, mm3."""
        a, b, c, d = (self.nodes[self.elements[:, k]] for k in range(4))
        volumes: Floats = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6.0
        return volumes


class CannotFill(VolfrepError):
    """Gmsh does not manage a mesh."""


class FaultyMesh(VolfrepError):
    """A mesh is not closed, or has facets without an area."""


def tetrahedra(mesh: TriangleMesh, monitor: Monitor | None = None) -> TetrahedralMesh:
    """Fill a closed mesh with tetrahedra: by Gmsh, or where that fails from a lattice of them.

    Args:
        mesh: closed, mm.
        monitor: asked for a cancel.

    Raises:
        VolfrepError: Gmsh is not installed, the mesh is not closed or has more than
            `MAX_TRIANGLES` triangles, or neither way fills it.
        Cancelled: when the monitor says so.
    """
    monitor = monitor or Monitor()
    try:
        return filled_by_gmsh(mesh, monitor)
    except CannotFill as failure:
        return _filled_from_lattice(mesh, monitor, failure)


def filled_by_gmsh(mesh: TriangleMesh, monitor: Monitor | None = None) -> TetrahedralMesh:
    """Fill a closed mesh with tetrahedra whose outer faces are its triangles.

    Needles and caps, as a cut leaves them, are mended first, with little about them, and facets
    that are large beside those near them are divided.

    Raises:
        CannotFill: Gmsh does not manage it.
        VolfrepError, Cancelled: as of `tetrahedra`.
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
    monitor = monitor or Monitor()
    places: list[Floats] = []
    end = time.monotonic() + _patience(mesh)
    while True:
        surface, moved = mend_surface(compact(mesh), monitor, tuple(places))
        surface = monitor.call(lambda: grade_facets(surface))  # noqa: B023
        try:
            said, filled = _run_gmsh(program, surface, monitor)
        except FaultyMesh as fault:
            if not moved:
                raise
            raise _cannot_fill(f"mended it is no solid: {fault}") from fault
        place = _intersection(said)
        if filled is not None:
            break
        # Facets that touch in one plane cross nowhere, but are not to Gmsh's liking.
        if place is None or not moved or len(places) == GMSH_TRIES or time.monotonic() > end:
            raise _cannot_fill(said)
        places.append(place)
    result = replace(filled, moved=moved, grown=surface.volume / mesh.volume - 1.0)
    volumes = result.volumes()
    if not len(volumes) or volumes.min() <= 0:
        raise _cannot_fill("it made tetrahedra that are inside out")
    if abs(volumes.sum() / surface.volume - 1.0) > VOLUME_TOLERANCE:
        raise _cannot_fill(f"it filled {volumes.sum():.6g} of {surface.volume:.6g} mm3")
    return result


def _filled_from_lattice(
    mesh: TriangleMesh, monitor: Monitor, failure: CannotFill
) -> TetrahedralMesh:
    """A mesh that Gmsh cannot fill as tetrahedra of a lattice; the failure where these differ."""
    wanted = faceted_brep(mesh).bodies
    for count in LATTICE_TETRAHEDRA:
        # Of L^3 = V + A L the positive root.
        volume, area = 12.0 * mesh.volume / count, 2.0 * mesh.area / count
        edge = float(np.roots([1.0, 0.0, -area, -volume]).real.max())
        edge = max(edge, _median_edge(mesh))
        points, corners = stuffed_mesh(mesh, edge, monitor)
        bodies = monitor.call(lambda: bodies_of(corners)[0])  # noqa: B023
        grown = float(signed_volumes(points, corners).sum()) / mesh.volume - 1.0
        if bodies == wanted and abs(grown) <= MOST_GROWN:
            break
    else:
        raise CannotFill(
            f"{failure} A lattice of tetrahedra of {edge:.3g} mm does not fill it, either: its "
            f"bodies are {bodies} where the mesh has {wanted}, its volume differs by {grown:+.1%}."
        ) from failure
    outside, facets = np.unique(face_pairs(corners)[1], return_inverse=True)
    surface = TriangleMesh(points[outside], facets.reshape(-1, 3).astype(np.int32))
    away = monitor.call(lambda: closest_points(surface, _places(mesh, edge))[1])
    far = (float(away.max()), float(np.quantile(away, 0.99)))
    nodes, elements = _second_order(points, corners)
    return TetrahedralMesh(nodes, elements, grown=grown, lattice=edge, away=far)


def _median_edge(mesh: TriangleMesh) -> float:
    return float(np.median(side_lengths(mesh.vertices[mesh.triangles])))


def _places(mesh: TriangleMesh, edge: float) -> Floats:
    """The vertices of a mesh, and places in those facets that are larger than an edge."""
    corners = mesh.vertices[mesh.triangles]
    length = side_lengths(corners).max(axis=1)
    return np.concatenate([mesh.vertices, sample_triangles(corners[length > edge], edge)[0]])


def _second_order(points: Floats, corners: Ints) -> tuple[Floats, Ints]:
    """Nodes and elements with a node in the middle of each edge."""
    ends = np.sort(corners[:, _EDGES], axis=2) @ np.array([len(points), 1])
    names, row = np.unique(ends, return_inverse=True)
    one, two = np.divmod(names, len(points))
    nodes = np.concatenate([points, 0.5 * (points[one] + points[two])])
    return nodes, np.concatenate([corners, len(points) + row.reshape(-1, 6)], axis=1)


def _patience(mesh: TriangleMesh) -> float:
    """Seconds."""
    return max(PATIENCE * SECONDS_PER_TRIANGLE * len(mesh.triangles), LEAST_PATIENCE)


def _run_gmsh(
    program: str, surface: TriangleMesh, monitor: Monitor
) -> tuple[str, TetrahedralMesh | None]:
    """What Gmsh says of a closed surface, and the tetrahedra where it fills it."""
    try:
        brep = faceted_brep(surface)
    except VolfrepError as fault:
        raise FaultyMesh(str(fault)) from fault
    patience = _patience(surface)
    for improved in (True, False):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "surface.msh").write_bytes(_surface(surface, brep.shell))
            geo = _GEO % (_volumes(brep), improved)
            (folder / "fill.geo").write_text(geo, encoding="ascii")
            command = [program, "fill.geo", "-3", "-o", "filled.msh", "-v", "2"]
            try:
                said = run_program(command, folder, monitor, limits=Limits(patience))
            except OverLimit:
                continue
            filled = folder / "filled.msh"
            if not filled.is_file() or said.returncode:
                return said.stdout, None
            return said.stdout, replace(_read(filled.read_bytes()), improved=improved)
    return f"it came to no end within {patience:.0f} s", None


def _intersection(said: str) -> Floats | None:
    """(1, 3) where Gmsh says that facets intersect, mm."""
    found = re.search(r"intersection \(([^,()]+),([^,()]+),([^,()]+)\)", said)
    return None if found is None else np.array([[float(number) for number in found.groups()]])


def mend_surface(
    mesh: TriangleMesh, monitor: Monitor, places: tuple[Floats, ...] = ()
) -> tuple[TriangleMesh, float]:
    """A closed mesh without needles and caps, and how far a move could take its surface, mm.

    The mesh as it is where it has no angle below `NEEDLE`, or where facets would cross then;
    one in which no facet lies on its neighbour that did not before, where there is one.
    """
    if angles_of(mesh.vertices[mesh.triangles]).min(initial=180.0) >= NEEDLE:
        return mesh, 0.0
    edge = _median_edge(mesh)
    tolerance = Tolerance(MENDING * edge, places, NEAR * edge)
    best, folded_before = (mesh, 0.0), folded_facets(mesh).sum()
    for done in range(TRIES):
        better = monitor.call(lambda: mend_bad_facets(mesh, tolerance, SHORTEST * edge))  # noqa: B023
        every = np.ones(len(better.triangles), bool)
        wrong = monitor.call(lambda: crossing_triangles(better, every, TOUCHING * edge))  # noqa: B023
        if not wrong.any():
            # What folds in the end may still be filled, and needles surely are not.
            better = without_fins(better, folded_facets(better))
            better = _one_by_one(better, tolerance.usual, TOUCHING * edge, monitor)
            best = better, tolerance.usual
            wrong = folded_facets(better)
            if wrong.sum() <= folded_before:
                break
        place = better.vertices[np.unique(better.triangles[wrong])]
        near = NEAR * (done + 1) * edge
        tolerance = replace(tolerance, places=(*tolerance.places, place), reach=near)
    return best


def _one_by_one(
    mesh: TriangleMesh, tolerance: float, touching: float, monitor: Monitor
) -> TriangleMesh:
    """A mended mesh without the folds that are left, then without the needles, if none cross."""
    for needle in (0.0, NEEDLE):
        better = without_faults(mesh, tolerance, needle, monitor)
        if better is not mesh:
            every = np.ones(len(better.triangles), bool)
            wrong = monitor.call(lambda: crossing_triangles(better, every, touching))  # noqa: B023
            mesh = mesh if wrong.any() else better
    return mesh


def nodes_on(filled: TetrahedralMesh, surface: TriangleMesh) -> Ints:
    """Rows of the nodes that lie on a surface, within rounding and what mending moved."""
    low, high = surface.bounds
    near = max(SURFACE_TOLERANCE * float(np.linalg.norm(high - low)), filled.moved)
    # Nodes inside may be as near as that.
    rows = outer_nodes(filled)
    on = np.zeros(len(filled.nodes), bool)
    on[rows] = closest_points(surface, filled.nodes[rows])[1] < near
    if filled.lattice:
        # Its corners lie on the mesh; the middles of edges bridge what it rounds.
        faces = _outer_faces(filled)
        on[faces[on[faces[:, :3]].all(axis=1)]] = True
    return np.flatnonzero(on)


def outer_nodes(filled: TetrahedralMesh) -> Ints:
    """Rows of the nodes of faces that belong to one tetrahedron only, ascending."""
    return np.unique(_outer_faces(filled))


def _outer_faces(filled: TetrahedralMesh) -> Ints:
    """(k, 6) those faces: corners, then the middles of their edges."""
    faces = filled.elements[:, _FACES].reshape(-1, 6)
    _, index, uses = np.unique(
        np.sort(faces[:, :3], axis=1), axis=0, return_index=True, return_counts=True
    )
    result: Ints = faces[index[uses == 1]]
    return result


def _cannot_fill(why: str) -> CannotFill:
    lines = [line.partition(":")[2] for line in why.splitlines() if line.startswith("Error")]
    reason = (lines[0] if lines else why).strip().rstrip(".") or "it said nothing"
    return CannotFill(
        f"Gmsh cannot fill this mesh with tetrahedra ({reason}): solve its struts with beams, "
        "which need no such mesh, or try another resolution or origin."
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
