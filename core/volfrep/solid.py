# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading a solid from a mesh file, and making sure that it is one."""

from __future__ import annotations

import os
import struct
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .errors import VolfrepError
from .facets import winding
from .mesh import TriangleMesh, compact

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Vertices of open edges nearer than this, in units of the part's largest dimension, are one
#: vertex written twice with different rounding (float32 resolves 6e-8).
ROUNDING = 1e-6
MESH_SUFFIXES = (".stl", ".obj", ".ply")
CAD_SUFFIXES = (".step", ".stp", ".brep", ".brp", ".iges", ".igs", ".fcstd")


def read_solid(path: str | os.PathLike[str]) -> TriangleMesh:
    """Read a closed solid from an STL (binary or ASCII), OBJ or PLY file.

    Args:
        path: the file; its lengths are taken as mm.

    Returns:
        The checked solid, as `check_solid` returns it.

    Raises:
        VolfrepError: the file is missing, damaged, of another kind, or holds no closed solid.
    """
    return check_solid(read_triangles(path), Path(path).name)


def read_triangles(path: str | os.PathLike[str]) -> TriangleMesh:
    """The triangles of an STL (binary or ASCII), OBJ or PLY file as they are, nothing repaired.

    Raises:
        VolfrepError: the file is missing, damaged, or of another kind.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix in CAD_SUFFIXES:
        raise VolfrepError(
            f"'{file.name}' is a CAD file, which the engine alone does not read: open it in "
            "FreeCAD and fill it there, or convert it to STL first."
        )
    if suffix not in MESH_SUFFIXES:
        raise VolfrepError(
            f"'{file.name}' is not a kind of file that holds a solid mesh: give an STL, OBJ or "
            "PLY file."
        )
    try:
        data = file.read_bytes()
    except OSError as error:
        raise VolfrepError(f"Cannot read '{file}': {error.strerror}.") from error
    if not data.strip():
        raise VolfrepError(f"'{file.name}' is empty: export the solid again.")
    mesh = _read_stl(data, file.name) if suffix == ".stl" else _read_other(data, suffix, file.name)
    _refuse_nonsense(mesh, file.name)
    return mesh


def _refuse_nonsense(mesh: TriangleMesh, name: str) -> None:
    if not len(mesh.triangles):
        raise VolfrepError(f"'{name}' holds no triangles: export the solid again.")
    if not np.isfinite(mesh.vertices[mesh.triangles]).all():
        raise VolfrepError(f"'{name}' has a coordinate that is not a number: export it again.")


def _read_stl(data: bytes, name: str) -> TriangleMesh:
    # Many binary files begin with "solid" too: the length decides.
    if len(data) >= 84:
        count = struct.unpack_from("<I", data, 80)[0]
        if len(data) == 84 + 50 * count or (len(data) > 84 + 50 * count and b"\0" in data[:512]):
            return _read_binary_stl(data, count)
    if data.lstrip()[:5].lower() == b"solid" and b"\0" not in data[:512]:
        return _read_ascii_stl(data, name)
    if len(data) < 84:
        raise VolfrepError(f"'{name}' is not an STL file: it ends inside its header.")
    raise VolfrepError(
        f"'{name}' is cut short or damaged: its header promises {count} triangles and there are "
        f"{(len(data) - 84) // 50}; export or download it again."
    )


def _read_binary_stl(data: bytes, count: int) -> TriangleMesh:
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows = np.frombuffer(data, record, count, 84)
    return _soup(rows["corners"].astype(np.float64).reshape(-1, 3))


def _read_ascii_stl(data: bytes, name: str) -> TriangleMesh:
    words = data.lower().split()
    if b"endsolid" not in words[-64:]:
        raise VolfrepError(
            f"'{name}' is cut short: it has no 'endsolid'; export or download it again."
        )
    text = np.array(words, dtype=bytes)
    at = np.flatnonzero(text == b"vertex")
    loops = int((text == b"endloop").sum())
    if not len(at) or len(at) != 3 * loops or at[-1] + 3 >= len(text):
        raise VolfrepError(
            f"'{name}' is damaged: {len(at)} vertices do not make {loops} triangles; export it "
            "again."
        )
    try:
        corners = text[at[:, None] + np.arange(1, 4)].astype(np.float64)
    except ValueError as error:
        raise VolfrepError(f"'{name}' is damaged: a coordinate is not a number.") from error
    return _soup(corners)


def _soup(corners: Floats) -> TriangleMesh:
    return TriangleMesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))


def _read_other(data: bytes, suffix: str, name: str) -> TriangleMesh:
    kind = suffix.lstrip(".")
    try:
        loaded: Any = trimesh.load(
            trimesh.util.wrap_as_stream(data), file_type=kind, process=False, force="mesh"
        )
    # What a damaged file raises inside trimesh's parsers.
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, EOFError) as error:
        raise VolfrepError(
            f"'{name}' is damaged or not a valid {kind.upper()} file: export it again."
        ) from error
    vertices = np.asarray(loaded.vertices, np.float64).reshape(-1, 3)
    triangles = np.asarray(loaded.faces, np.int64).reshape(-1, 3)
    if len(triangles) and (triangles.min() < 0 or triangles.max() >= len(vertices)):
        raise VolfrepError(f"'{name}' is damaged: a triangle names a vertex that is not there.")
    return TriangleMesh(vertices, triangles.astype(np.int32))


def check_solid(mesh: TriangleMesh, name: str) -> TriangleMesh:
    """The mesh as a clean closed solid.

    Welds equal vertices, drops degenerate and repeated triangles, makes the orientation outward
    (cavities stay cavities) and unites closed shells that overlap.

    Args:
        mesh: any triangles.
        name: of the part, for error messages.

    Raises:
        VolfrepError: naming what keeps it from being a solid, and where.
    """
    _refuse_nonsense(mesh, name)
    mesh = compact(mesh)
    size = float(np.ptp(mesh.bounds, axis=0).max())
    if not 1e-9 < size < 1e9:
        raise VolfrepError(f"'{name}' is {size:.3g} mm large, which is no sensible part.")
    mesh = _drop_repeated(_weld(mesh, 0.0))
    if len(_odd_edges(mesh)):
        mesh = _drop_repeated(_weld(mesh, ROUNDING * size))
    if not len(mesh.triangles):
        raise VolfrepError(f"'{name}' has no triangle with an area: export the solid again.")
    _refuse_defects(mesh, name)
    mesh = _orient(mesh, name)
    solid = _unite_overlaps(mesh, name)
    if solid.volume <= 1e-9 * size**3:
        raise VolfrepError(f"'{name}' encloses no volume: give a solid, not a surface.")
    return solid


def _weld(mesh: TriangleMesh, tolerance: float) -> TriangleMesh:
    """Vertices that are equal, or of open edges and within the tolerance, become one."""
    if tolerance == 0.0:
        vertices, index = np.unique(mesh.vertices + 0.0, axis=0, return_inverse=True)
    else:
        loose = np.unique(_odd_edges(mesh))
        pairs = loose[cKDTree(mesh.vertices[loose]).query_pairs(tolerance, output_type="ndarray")]
        count = len(mesh.vertices)
        graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
        index = connected_components(graph, directed=False)[1]
        vertices = mesh.vertices[np.unique(index, return_index=True)[1]]
    return TriangleMesh(vertices, index.ravel()[mesh.triangles].astype(np.int32))


def _drop_repeated(mesh: TriangleMesh) -> TriangleMesh:
    """Without triangles that use a vertex twice, and without a second copy of a triangle.

    Two copies that face each other enclose nothing and both go.
    """
    t = mesh.triangles
    t = t[(t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])]
    # From its least vertex on, a triangle is written in one way only.
    t = np.take_along_axis(t, (t.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
    t = t[np.sort(np.unique(t, axis=0, return_index=True)[1])]
    same, count = np.unique(np.sort(t, axis=1), axis=0, return_inverse=True, return_counts=True)[1:]
    return compact(TriangleMesh(mesh.vertices, t[count[same.ravel()] == 1]))


def _edges(mesh: TriangleMesh) -> tuple[Ints, Ints]:
    """(3 m, 2) directed edges, triangle by triangle, and the number of each undirected edge."""
    t = mesh.triangles.astype(np.int64)
    directed = np.stack([t, np.roll(t, -1, axis=1)], axis=2).reshape(-1, 2)
    low, high = directed.min(axis=1), directed.max(axis=1)
    return directed, np.unique(low * len(mesh.vertices) + high, return_inverse=True)[1].ravel()


def _odd_edges(mesh: TriangleMesh) -> Ints:
    """(k, 2) the edges that are not shared by exactly two triangles."""
    directed, number = _edges(mesh)
    return directed[np.bincount(number)[number] != 2] if len(directed) else directed


def _refuse_defects(mesh: TriangleMesh, name: str) -> None:
    directed, number = _edges(mesh)
    shared = np.bincount(number)[number]
    open_edges, branched = np.flatnonzero(shared == 1), np.flatnonzero(shared > 2)
    if len(open_edges):
        raise VolfrepError(
            f"'{name}' is not closed: {len(open_edges)} edges have a triangle on one side only, "
            f"the first near {_place(mesh, directed[open_edges[0]])}; close the hole and try again."
        )
    if len(branched):
        raise VolfrepError(
            f"'{name}' is not one clean surface: {len(np.unique(number[branched]))} edges are "
            f"shared by more than two triangles, the first near "
            f"{_place(mesh, directed[branched[0]])}; separate the bodies that meet there."
        )


def _place(mesh: TriangleMesh, vertices: Ints) -> str:
    return "({:.4g}, {:.4g}, {:.4g})".format(*mesh.vertices[vertices].mean(axis=0))


def _pairs_across(mesh: TriangleMesh) -> tuple[Ints, NDArray[np.bool_]]:
    """(e, 2) triangles that share each edge, and whether both run along it the same way."""
    directed, number = _edges(mesh)
    order = np.argsort(number, kind="stable").reshape(-1, 2)
    return order // 3, directed[order[:, 0], 0] == directed[order[:, 1], 0]


def _orient(mesh: TriangleMesh, name: str) -> TriangleMesh:
    """Every shell wound consistently, and the shells outward, or inward where they bound a void."""
    pairs, disagree = _pairs_across(mesh)
    count = len(mesh.triangles)
    # Two copies of every triangle, as given and turned; an edge joins the copies that agree.
    a, b = pairs.T
    c = np.where(disagree, b + count, b)
    d = np.where(disagree, b, b + count)
    rows, columns = np.concatenate([a, a + count]), np.concatenate([c, d])
    graph = coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(2 * count, 2 * count))
    label = connected_components(graph, directed=False)[1]
    if (label[:count] == label[count:]).any():
        where = mesh.triangles[np.flatnonzero(label[:count] == label[count:])[0]]
        raise VolfrepError(
            f"'{name}' has a one-sided surface near {_place(mesh, where)}: it encloses no volume."
        )
    turned = label[:count] > label[count:]
    triangles = np.where(turned[:, None], mesh.triangles[:, ::-1], mesh.triangles)
    graph = coo_matrix((np.ones(len(pairs)), (a, b)), shape=(count, count))
    shells, shell = connected_components(graph, directed=False)
    consistent = TriangleMesh(mesh.vertices, triangles)
    volume = np.bincount(shell, weights=consistent.signed_volumes(), minlength=shells)
    # A consistent input says itself which shells are cavities, unless it is inside out.
    if disagree.any():
        wanted = _nesting_signs(consistent, shell)
    else:
        given = np.bincount(shell, weights=mesh.signed_volumes(), minlength=shells)
        wanted = np.sign(given) * np.sign(given.sum())
    wrong = (np.sign(volume) * wanted < 0)[shell]
    return TriangleMesh(
        mesh.vertices,
        np.ascontiguousarray(np.where(wrong[:, None], triangles[:, ::-1], triangles)),
    )


def _containing(mesh: TriangleMesh, shell: Ints, signs: Floats) -> NDArray[np.bool_]:
    """(s, s) bool: shell j lies inside shell i, judged by one vertex of j."""
    first = mesh.vertices[mesh.triangles[np.unique(shell, return_index=True)[1], 0]]
    inside = np.stack([winding(mesh, point, shell) * signs > 0.5 for point in first], axis=1)
    np.fill_diagonal(inside, False)
    return inside


def _nesting_signs(mesh: TriangleMesh, shell: Ints) -> Floats:
    """+1 for shells inside an even number of others, -1 for those that bound a cavity."""
    volume = np.bincount(shell, weights=mesh.signed_volumes())
    depth = _containing(mesh, shell, np.sign(volume)).sum(axis=0)
    return np.where(depth % 2 == 0, 1.0, -1.0)


def _unite_overlaps(mesh: TriangleMesh, name: str) -> TriangleMesh:
    pairs, _ = _pairs_across(mesh)
    count = len(mesh.triangles)
    graph = coo_matrix((np.ones(len(pairs)), tuple(pairs.T)), shape=(count, count))
    shells, shell = connected_components(graph, directed=False)
    volume = np.bincount(shell, weights=mesh.signed_volumes(), minlength=shells)
    bodies = np.flatnonzero(volume > 0)
    if len(bodies) < 2:
        return mesh
    # A cavity belongs to the smallest body around it.
    owner = np.arange(shells)
    cavities = np.flatnonzero(volume <= 0)
    if len(cavities):
        around = _containing(mesh, shell, np.sign(volume))[np.ix_(bodies, cavities)]
        nearest = np.where(around, volume[bodies][:, None], np.inf).argmin(axis=0)
        owner[cavities] = bodies[nearest]
    solids = [_to_manifold(mesh, owner[shell] == body, name) for body in bodies]
    union = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
    if abs(union.volume() - volume.sum()) <= 1e-9 * abs(volume.sum()):
        return mesh
    result = union.to_mesh64()
    return TriangleMesh(
        np.array(result.vert_properties[:, :3], np.float64), np.array(result.tri_verts, np.int32)
    )


def _to_manifold(mesh: TriangleMesh, rows: NDArray[np.bool_], name: str) -> Any:
    part = compact(TriangleMesh(mesh.vertices, mesh.triangles[rows]))
    solid = manifold3d.Manifold(
        manifold3d.Mesh64(
            np.ascontiguousarray(part.vertices),
            np.ascontiguousarray(part.triangles, dtype=np.uint64),
        )
    )
    if solid.status() != manifold3d.Error.NoError:
        raise VolfrepError(
            f"'{name}' has overlapping bodies that cannot be united: unite them before export."
        )
    return solid
