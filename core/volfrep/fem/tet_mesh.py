# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh filled with second-order tetrahedra by Gmsh, without the needles of a cut.

By Gmsh's Delaunay algorithm: its parallel one (HXT) fails on the needles that a Boolean leaves.
What Gmsh cannot fill is filled with tetrahedra of a lattice, whose outside lies near the mesh's.
"""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..mesh.brep import TOLERANCE as LEAST_LENGTH
from ..mesh.brep import FacetedBrep, faceted_brep
from ..mesh.narrow_gaps import with_wider_gaps
from ..mesh.remesh import longest_sides, normals, side_lengths
from ..mesh.topology import edge_keys
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..mesh.well_shaped import Tolerance, angles_of, mend_bad_facets, names
from ..process.child import Limits, OverLimit
from ..process.programs import run_program
from ..spatial.piercing import meeting_triangles, piercing_pairs
from ..spatial.proximity import are_nearer, closest_points, sample_triangles
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .facet_grading import grade_facets
from .folds import folded_facets
from .single_moves import without_faults
from .strayed import farthest_apart
from .stuffed_mesh import FACES, bodies_of, face_pairs, signed_volumes, stuffed_mesh

#: A solver needs about 50 kB for each of these: more are not a job for tetrahedra.
MAX_TRIANGLES = 200_000
#: The tetrahedra's volume may differ from the mesh's by this fraction.
VOLUME_TOLERANCE = 1e-6
#: Mending is told where it changes the volume by more than this fraction. It makes up for what it
#: takes where points may move.
VOLUME_WARNED = 2e-3
#: Nodes are on a wall within this part of its box's diagonal: what single precision keeps.
SURFACE_TOLERANCE = 1e-6
#: No places at all, mm.
NOWHERE = np.zeros((0, 3))
#: Gmsh copes with facets that have no angle below this, degrees.
NEEDLE = 2.0
#: Needles and caps are mended where no move takes the surface farther than this part of the mesh's
#: median edge. It is less so many median edges about places where facets would cross or fold.
MENDING = 0.05
NEAR = 1.0
#: Where a deviation is asked for no move takes more than this part of it: together they took the
#: surface 1.9 to 2.9 times as far as one may.
SHARE = 1.0 / 3.0
#: Facets that mending leaves no farther apart than this touch, mm: Gmsh takes them to intersect.
TOUCHING = 1e-6
#: What Gmsh finds to intersect is mended less in a next try, so many times.
GMSH_TRIES = 1
#: Gmsh improves what it has filled, which does not end with a few meshes: of a processor it may
#: take so many times what is told for all, at least so many seconds; what it has filled is taken as
#: it is then. On a machine that is busy with others this may take so many times as long.
PATIENCE = 3.0
LEAST_PATIENCE = 120.0
BUSY = 20.0
#: Tetrahedra with less than this of a regular one's volume, by their edges' mean square, are flat.
FLAT = 0.02
#: No edge is split into pieces shorter than this part of it.
SHORTEST = 0.25
#: Seconds, nodes, elements and bytes of the deck per triangle, each within a factor of two of what
#: was measured on blocks, boxes with a skin and without, and the demo's bracket, of 16,000 to
#: 197,000 triangles: 2 to 7e-4 s, 2.5 to 4.6 nodes, 1.2 to 2.5 elements, 200 to 410 bytes. A skin
#: takes the most. Where a wall cuts the lattice the needles are mended before.
SECONDS_PER_TRIANGLE = 4e-4
SECONDS_PER_CUT_TRIANGLE = 1e-3
NODES_PER_TRIANGLE = 3.6
ELEMENTS_PER_TRIANGLE = 1.9
BYTES_PER_TRIANGLE = 300
#: The same for a tetrahedron of a lattice, its seconds by a card's cover cut into 400,000; of a
#: connecting rod 394,111 were 159 bytes each.
SECONDS_PER_LATTICE_TETRAHEDRON = 1e-4
BYTES_PER_LATTICE_TETRAHEDRON = 160
NODES_PER_LATTICE_TETRAHEDRON = 1.75

#: Tetrahedra of a lattice that fills what Gmsh cannot, and where those lose too much. With their
#: mid-edge nodes they have 1.7 to 1.8 nodes each: the first are as many nodes as the largest mesh
#: that Gmsh is given would have. A volume V with a surface A takes about 12 V / L^3 + 2 A / L^2 of
#: an edge L (where that says 400,000 it took 378,000 to 422,000). No edge need be shorter than the
#: surface's own.
LATTICE_TETRAHEDRA = (400_000, 1_200_000)
#: No more than this part of the volume may come or go by it.
MOST_GROWN = 0.05

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
Mesh.Optimize = 0;
Mesh.MshFileVersion = 2.2;
Mesh 3;
Save "filled.msh";
OptimizeMesh "Gmsh";
Save "improved.msh";
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
        away: how far places of the mesh's surface are from theirs then, or places of theirs from
            the mesh's, mm: the farthest of both, and all but one in a hundred.
        strayed: the same of mended ones, the farthest at vertices and middles of edges, mm.
        before: the mesh that was mended; None where nothing was.
    """

    nodes: Floats
    elements: Ints
    moved: float = 0.0
    grown: float = 0.0
    improved: bool = True
    lattice: float = 0.0
    away: tuple[float, float] = (0.0, 0.0)
    strayed: float = 0.0
    before: TriangleMesh | None = None

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences where mending changed the volume, and where shapes were not improved."""
        if self.lattice:
            return (
                f"Gmsh cannot fill this mesh: its {len(self.elements):,} tetrahedra are cut from a "
                f"lattice of {self.lattice:.3g} mm instead, so that edges are rounded and what is "
                f"thinner may be lost. Either surface is within {self.away[0]:.2g} mm of the other "
                f"({self.away[1]:.2g} mm for 99 % of its places), the volume differs by "
                f"{self.grown:+.2%}.",
            )
        warnings = []
        if abs(self.grown) > VOLUME_WARNED:
            warnings.append(
                f"The tetrahedra's volume differs by {self.grown:+.2%} from the mesh's: its "
                "needles were mended, and what that changed could not be made up for everywhere."
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


def tetrahedra(
    mesh: TriangleMesh,
    monitor: Monitor | None = None,
    tell: Callable[[int], None] = lambda _: None,
    deviation: float | None = None,
) -> TetrahedralMesh:
    """Fill a closed mesh with tetrahedra: by Gmsh, or where that fails from a lattice of them.

    Args:
        mesh: closed, mm.
        monitor: asked for a cancel.
        tell: told about how many are to be cut from a lattice, before it is.
        deviation: how far mending should leave the surface from the mesh's, mm; None: as far as
            its facets' size asks for.

    Raises:
        VolfrepError: Gmsh is not installed, the mesh is not closed or has more than
            `MAX_TRIANGLES` triangles, or neither way fills it.
        Cancelled: when the monitor says so.
    """
    monitor = monitor or Monitor()
    try:
        return filled_by_gmsh(mesh, monitor, deviation)
    except CannotFill as failure:
        return _filled_from_lattice(mesh, monitor, failure, tell)


def filled_by_gmsh(
    mesh: TriangleMesh, monitor: Monitor | None = None, deviation: float | None = None
) -> TetrahedralMesh:
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
    places = NOWHERE
    while True:
        surface, moved = mend_surface(compact(mesh), monitor, places, deviation)
        surface = monitor.call(lambda: grade_facets(surface))  # noqa: B023
        try:
            said, filled = _run_gmsh(program, surface, monitor)
        except FaultyMesh as fault:
            if not moved:
                raise
            raise _cannot_fill(f"mended it is no solid: {fault}") from fault
        if filled is not None:
            break
        place = _intersection(said)
        # Facets that touch in one plane cross nowhere, but are not to Gmsh's liking.
        if place is None or not moved or len(places) == GMSH_TRIES:
            raise _cannot_fill(said)
        places = np.concatenate([places, place])
    points, corners, improved = filled
    volume = signed_volumes(points, corners).sum()
    if abs(volume / surface.volume - 1.0) > VOLUME_TOLERANCE:
        raise _cannot_fill(f"it filled {volume:.6g} of {surface.volume:.6g} mm3")
    least = SURFACE_TOLERANCE * float(np.linalg.norm(np.diff(mesh.bounds, axis=0)))
    corners = without_flat(points, corners, max(moved, least))
    volumes = signed_volumes(points, corners)
    if not len(volumes) or volumes.min() <= 0:
        raise _cannot_fill("it made tetrahedra that are inside out")
    nodes, elements = _second_order(points, corners)
    grown = float(volumes.sum()) / mesh.volume - 1.0
    strayed = 0.0
    if moved:
        outside = TriangleMesh(points, face_pairs(corners)[1].astype(np.int32))
        strayed = monitor.call(lambda: farthest_apart(mesh, outside))
    before = mesh if moved else None
    return TetrahedralMesh(nodes, elements, moved, grown, improved, strayed=strayed, before=before)


def _filled_from_lattice(
    mesh: TriangleMesh, monitor: Monitor, failure: CannotFill, tell: Callable[[int], None]
) -> TetrahedralMesh:
    """A mesh that Gmsh cannot fill as tetrahedra of a lattice; the failure where these differ."""
    wanted = faceted_brep(mesh).bodies
    for count in LATTICE_TETRAHEDRA:
        # Of L^3 = V + A L the positive root.
        volume, area = 12.0 * mesh.volume / count, 2.0 * mesh.area / count
        edge = float(np.roots([1.0, 0.0, -area, -volume]).real.max())
        edge = max(edge, _median_edge(mesh))
        tell(round((12.0 * mesh.volume / edge + 2.0 * mesh.area) / edge**2))
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
    away = monitor.call(lambda: _apart(mesh, surface, edge))
    nodes, elements = _second_order(points, corners)
    return TetrahedralMesh(nodes, elements, grown=grown, lattice=edge, away=away)


def _median_edge(mesh: TriangleMesh) -> float:
    return float(np.median(side_lengths(mesh.vertices[mesh.triangles])))


def _apart(one: TriangleMesh, other: TriangleMesh, spacing: float) -> tuple[float, float]:
    """How far places of either surface are from the other: the farthest, all but one in a hundred.

    Args:
        one: mm.
        other: mm.
        spacing: of the places in large facets, mm; of smaller ones corners and middles are asked.
    """
    ways = []
    for asked, place in ((one, other), (other, one)):
        corners = asked.vertices[asked.triangles]
        length = longest_sides(corners)
        middles = corners[length > 0.5 * spacing].mean(axis=1)
        inner = sample_triangles(corners[length > spacing], spacing)[0]
        places = np.concatenate([asked.vertices, middles, inner])
        ways.append(closest_points(place, places)[1])
    return float(max(way.max() for way in ways)), float(max(np.quantile(way, 0.99) for way in ways))


def _second_order(points: Floats, corners: Ints) -> tuple[Floats, Ints]:
    """Nodes and elements with a node in the middle of each edge; points that none uses go."""
    used, corners = np.unique(corners, return_inverse=True)
    points, corners = points[used], corners.reshape(-1, 4)
    ends = edge_keys(corners[:, _EDGES[:, 0]], corners[:, _EDGES[:, 1]], len(points))
    keys, row = np.unique(ends, return_inverse=True)
    one, two = np.divmod(keys, len(points))
    nodes = np.concatenate([points, 0.5 * (points[one] + points[two])])
    return nodes, np.concatenate([corners, len(points) + row.reshape(-1, 6)], axis=1)


def _run_gmsh(
    program: str, surface: TriangleMesh, monitor: Monitor
) -> tuple[str, tuple[Floats, Ints, bool] | None]:
    """What Gmsh says of a closed surface; where it fills it points, corners, whether improved."""
    try:
        brep = faceted_brep(surface)
    except VolfrepError as fault:
        raise FaultyMesh(str(fault)) from fault
    patience = max(PATIENCE * SECONDS_PER_TRIANGLE * len(surface.triangles), LEAST_PATIENCE)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "surface.msh").write_bytes(_surface(surface, brep.shell))
        (folder / "fill.geo").write_text(_GEO % _volumes(brep), encoding="ascii")
        command = [program, "fill.geo", "-parse_and_exit", "-v", "2"]
        limits = Limits(BUSY * patience, processor_seconds=patience)
        try:
            said = run_program(command, folder, monitor, limits=limits).stdout
        except OverLimit as over:
            most = limits.seconds if over.what == "time" else patience
            said = f"it came to no end within {most:.0f} s of {over.what}"
        improved, filled = folder / "improved.msh", folder / "filled.msh"
        if "Error" in said:
            return said, None
        for file in (improved, filled):
            if file.is_file() and (read := _read(file.read_bytes())) is not None:
                return said, (*read, file is improved)
        return said, None


def without_flat(points: Floats, corners: Ints, tolerance: float) -> Ints:
    """Tetrahedra (m, 4) without those that lie flat on the surface, with two or three faces in it.

    Gmsh makes them of needles in a plane, and where the surface has an edge that a Delaunay mesh
    would not have. Nothing but they is at the edge of those two faces: the other two take their
    place, unless these would meet at an edge that the surface has already. Of three the fourth
    takes the place, and the point where they meet goes.

    Args:
        points: (n, 3) mm.
        corners: (m, 4) of positive volume, but for rounding.
        tolerance: how far that may take the surface, mm.
    """
    edges = points[corners[:, _EDGES[:, 0]]] - points[corners[:, _EDGES[:, 1]]]
    volume = np.abs(signed_volumes(points, corners))
    length = np.sqrt(np.einsum("ijk,ijk->i", edges, edges) / len(_EDGES))
    flat = 6.0 * np.sqrt(2.0) * volume < FLAT * length**3
    pairs, outside = face_pairs(corners)
    shared = np.bincount(pairs.ravel(), minlength=len(corners))
    # Neither a face nor the edge at which new ones meet may be of two that go: the flatter does.
    both = pairs[flat[pairs].all(axis=1)]
    both = np.take_along_axis(both, np.argsort(volume[both], axis=1), axis=1)
    for one, two in both[np.argsort(volume[both[:, 0]])].tolist():
        flat[two] &= not flat[one]
    rows = np.flatnonzero(flat & (shared == 2))
    count = len(points)
    faces = names(corners[rows][:, FACES].reshape(-1, 3), count).reshape(-1, len(FACES))
    is_outer = np.isin(faces, names(outside, count))
    # Opposite to its faces in the surface are the ends of that edge.
    one, two = corners[rows][is_outer].reshape(-1, 2).T
    other = corners[rows][~is_outer].reshape(-1, 2).T
    across = np.cross(points[two] - points[one], points[other[1]] - points[other[0]])
    low = 6.0 * volume[rows] <= tolerance * np.linalg.norm(across, axis=1)
    ends = edge_keys(one, two, count)
    known = np.isin(ends, edge_keys(outside, np.roll(outside, 1, axis=1), count))
    _, first, uses = np.unique(ends, return_index=True, return_counts=True)
    once = np.zeros(len(rows), bool)
    once[first[uses == 1]] = True
    stays = np.ones(len(corners), bool)
    stays[rows[low & ~known & once]] = False
    rows = np.flatnonzero(flat & (shared == 1))
    faces = names(corners[rows][:, FACES].reshape(-1, 3), count).reshape(-1, len(FACES))
    inner = ~np.isin(faces, names(outside, count))
    size = np.linalg.norm(normals(points[corners[rows][:, FACES][inner]]), axis=1)
    stays[rows[6.0 * volume[rows] <= tolerance * size]] = False
    result: Ints = corners[stays]
    return result


def _intersection(said: str) -> Floats | None:
    """(1, 3) where Gmsh says that facets intersect, mm."""
    found = re.search(r"intersection \(([^,()]+),([^,()]+),([^,()]+)\)", said)
    return None if found is None else np.array([[float(number) for number in found.groups()]])


def mend_surface(
    mesh: TriangleMesh,
    monitor: Monitor,
    places: Floats = NOWHERE,
    deviation: float | None = None,
) -> tuple[TriangleMesh, float]:
    """A closed mesh without needles and caps, and how far a move could take its surface, mm.

    No facets cross, and none lies on its neighbour or has no area, that did not before. The mesh as
    it is where it has no angle below `NEEDLE`.

    Args:
        mesh: closed.
        monitor: for cancel.
        places: about which moves are less from the start, mm; one that is there several times, so
            many times.
        deviation: as of `tetrahedra`.
    """
    if angles_of(mesh.vertices[mesh.triangles]).min(initial=180.0) >= NEEDLE:
        return mesh, 0.0
    edge = _median_edge(mesh)
    most = MENDING * edge if deviation is None else min(MENDING * edge, SHARE * deviation)
    tolerance = Tolerance(most, NEAR * edge)
    for place in places:
        tolerance = tolerance.with_less(place[None])

    def find_faults(part: TriangleMesh, new: Bools) -> Bools:
        monitor.tick()
        faulty = meeting_triangles(part, new, TOUCHING, monitor) | folded_facets(part, new)
        rows = np.flatnonzero(new)
        size = np.linalg.norm(normals(part.vertices[part.triangles[rows]]), axis=1)
        faulty[rows] |= size <= LEAST_LENGTH**2
        return faulty

    wider = with_wider_gaps(mesh, tolerance.at, SHORTEST * edge, find_faults)
    better = mend_bad_facets(wider, tolerance, SHORTEST * edge, find_faults)
    single = without_faults(better, tolerance.usual, NEEDLE, monitor)
    if single is not better and not len(piercing_pairs(single, monitor)):
        better = single
    return better, tolerance.usual


def nodes_on(filled: TetrahedralMesh, surface: TriangleMesh) -> Ints:
    """Rows of the nodes that lie on a surface, or on what of it was mended."""
    low, high = surface.bounds
    near = SURFACE_TOLERANCE * float(np.linalg.norm(high - low))
    # Nodes inside may be as near as that.
    faces = _outer_faces(filled)
    rows = np.unique(faces)

    def are_within(reach: float) -> Bools:
        result = np.zeros(len(filled.nodes), bool)
        result[rows] = are_nearer(surface, filled.nodes[rows], np.full(len(rows), reach))
        return result

    on = are_within(near)
    if filled.lattice:
        # Its corners lie on the mesh; the middles of edges bridge what it rounds.
        on[faces[on[faces[:, :3]].all(axis=1)]] = True
    elif filled.before is not None:
        # Mending takes nodes off the surface. Struts have some as near: faces tell them apart.
        asked = faces[are_within(filled.strayed + near)[faces].all(axis=1)]
        asked = asked[~on[asked].all(axis=1)]
        on[asked[_come_from(filled.before, surface, near, filled.nodes[asked[:, :3]])]] = True
    return np.flatnonzero(on)


def _come_from(before: TriangleMesh, surface: TriangleMesh, near: float, faces: Floats) -> Bools:
    """Whether faces (k, 3, 3) of a mended mesh are nearest to what of it lay on a surface."""
    corners = before.vertices[before.triangles]
    # Where all three corners lie on it the facet may still bridge a hollow.
    count = len(before.vertices)
    at_corners = are_nearer(surface, before.vertices, np.full(count, near))
    lies = at_corners[before.triangles].all(axis=1)
    lies[lies] = closest_points(surface, corners[lies].mean(axis=1))[1] < near
    own, others = (TriangleMesh(before.vertices, before.triangles[some]) for some in (lies, ~lies))
    middles = faces.mean(axis=1)
    if not len(own.triangles) or not len(others.triangles) or not len(faces):
        return np.full(len(faces), bool(len(own.triangles)))
    return ~are_nearer(others, middles, closest_points(own, middles)[1])


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


def _read(data: bytes) -> tuple[Floats, Ints] | None:
    """Nodes (n, 3) and elements in Gmsh's order, of its format 2.2 as text of one kind of elements.

    None where there are no elements, or the file does not end.
    """
    if b"$EndElements" not in data:
        return None
    nodes = np.array(_section(data, b"Nodes").split()[1:], np.float64).reshape(-1, 4)
    count, *numbers = _section(data, b"Elements").split()
    if not int(count):
        return None
    # Gmsh's numbers may have gaps: they become rows.
    row_of = np.zeros(int(nodes[:, 0].max()) + 1, np.int64)
    row_of[nodes[:, 0].astype(np.int64)] = np.arange(len(nodes))
    # Number, kind, two tags before the nodes.
    elements = np.array(numbers, np.int64).reshape(int(count), -1)[:, 5:]
    return nodes[:, 1:].copy(), row_of[elements]


def _section(data: bytes, name: bytes) -> bytes:
    start = data.index(b"$" + name + b"\n") + len(name) + 2
    return data[start : data.index(b"$End" + name, start)]
