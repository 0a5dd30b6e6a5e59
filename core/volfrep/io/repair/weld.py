# SPDX-License-Identifier: LGPL-2.1-or-later
"""Vertices that are one, and triangles that are none or twice there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...mesh.topology import edges_of, pieces_of
from ...mesh.triangle_mesh import TriangleMesh, compact
from ...util.numbers import plural
from ...util.types import Ints

#: Vertices of open edges nearer than this, in units of the part's largest dimension, are one
#: vertex written twice with different rounding (float32 resolves 6e-8).
ROUNDING = 1e-6
#: Wider cracks are closed only where that closes all of them; 1e-4 is 0.01 mm on 100 mm.
WIDEST_CRACK = 1.28e-4
#: Pairs of near vertices; more are no cracks.
MOST_PAIRS = 3_000_000


def weld_equal(mesh: TriangleMesh) -> TriangleMesh:
    """Vertices at the same place become one."""
    points = mesh.vertices + 0.0  # no negative zeros
    key = np.unique(points[:, 0], return_inverse=True)[1].ravel()
    for axis in (1, 2):
        values, rank = np.unique(points[:, axis], return_inverse=True)
        key = np.unique(key * len(values) + rank.ravel(), return_inverse=True)[1].ravel()
    first = np.full(int(key.max()) + 1, len(key))
    np.minimum.at(first, key, np.arange(len(key)))
    return TriangleMesh(points[first], key[mesh.triangles].astype(np.int32))


def weld_near(mesh: TriangleMesh, tolerance: float) -> TriangleMesh | None:
    """Vertices of open edges within a tolerance become one, in their mean place.

    Returns:
        None where there are too many such pairs, or where a chain of them would draw vertices
        together that are much farther apart than the tolerance.
    """
    from scipy.spatial import cKDTree  # slow to import

    edges = edges_of(mesh)
    loose = np.unique(edges.sides[edges.open_sides])
    cells = np.floor((mesh.vertices[loose] - mesh.bounds[0]) / tolerance).astype(np.int64)
    # Vertices in one cell of this size are near each other: their number bounds that of pairs.
    crowd = np.unique((cells * np.array([1, 1 << 20, 1 << 40])).sum(axis=1), return_counts=True)[1]
    if float((crowd.astype(np.float64) ** 2).sum()) > MOST_PAIRS:
        return None
    tree = cKDTree(mesh.vertices[loose])
    pairs = loose[tree.query_pairs(tolerance, output_type="ndarray")]
    _, index = pieces_of(pairs[:, 0], pairs[:, 1], len(mesh.vertices))
    number = np.bincount(index)
    middle = [np.bincount(index, weights=mesh.vertices[:, k]) / number for k in range(3)]
    vertices = np.stack(middle, axis=1)
    alone = number[index] == 1
    vertices[index[alone]] = mesh.vertices[alone]  # bit for bit
    if np.abs(vertices[index] - mesh.vertices).max() > 4.0 * tolerance:
        return None
    return TriangleMesh(vertices, index[mesh.triangles].astype(np.int32))


def close_cracks(mesh: TriangleMesh, size: float) -> tuple[TriangleMesh, list[str]]:
    """Open edges that lie along each other, joined.

    Rounding is mended wherever it is met; wider cracks only with the least tolerance that leaves
    no open edge at all.
    """
    left = len(edges_of(mesh).open_sides)
    if not left:
        return mesh, []
    done: list[str] = []
    welded, after = _weld(mesh, ROUNDING * size)
    if after < left:
        done.append(_closed_text(ROUNDING * size, left - after))
        mesh, left = welded, after
    tolerance = max(2.0 * ROUNDING * size, _widest_gap(mesh, WIDEST_CRACK * size))
    while left and tolerance <= WIDEST_CRACK * size:
        welded, after = _weld(mesh, tolerance)
        if not after:
            return welded, [*done, _closed_text(tolerance, left)]
        tolerance *= 2.0
    return mesh, done


def _weld(mesh: TriangleMesh, tolerance: float) -> tuple[TriangleMesh, int]:
    """The mesh welded, and how many open sides it has then; as it was where that cannot be."""
    welded = weld_near(mesh, tolerance)
    welded = mesh if welded is None else without_repeats(welded)[0]
    welded = welded if len(welded.triangles) else mesh
    return welded, len(edges_of(welded).open_sides)


def _closed_text(tolerance: float, sides: int) -> str:
    return f"Cracks of up to {tolerance:.2g} mm along {plural(sides, 'edge')} closed"


def _widest_gap(mesh: TriangleMesh, most: float) -> float:
    """How far the vertices of open edges have to reach until each has found another, mm.

    Infinite where one finds none within `most`.
    """
    from scipy.spatial import cKDTree  # slow to import

    edges = edges_of(mesh)
    if not len(edges.open_sides):
        return 0.0
    loose = mesh.vertices[np.unique(edges.sides[edges.open_sides])]
    found = cKDTree(loose).query(loose, k=2, distance_upper_bound=most)[0]
    return float(found[:, 1].max())


def without_repeats(mesh: TriangleMesh) -> tuple[TriangleMesh, list[str]]:
    """Without triangles that use a vertex twice, and without further copies of a triangle.

    Where copies look to both sides the surplus of one side stays. In a surface that is double all
    over one side stays; a double face elsewhere is kept, for it may be where two bodies touch.
    """
    t = mesh.triangles
    flat = (t[:, 0] == t[:, 1]) | (t[:, 1] == t[:, 2]) | (t[:, 2] == t[:, 0])
    t = t[~flat]
    done = [f"{plural(int(flat.sum()), 'triangle')} without an area removed"] if flat.any() else []
    face, up, total = _faces(t, len(mesh.vertices))
    if (total == 1).all():
        return compact(TriangleMesh(mesh.vertices, t)), done
    net = 2 * np.bincount(face[up], minlength=len(total)) - total
    all_double = not net.any()
    keep = np.zeros(len(t), bool)
    for side in (up, ~up):
        rows = np.flatnonzero(side)
        keep[rows[np.unique(face[rows], return_index=True)[1]]] = True
    keep &= np.where(up, 1, -1) * np.sign(net)[face] >= 0
    if all_double:
        keep &= up
        done.append("One of the two sides of the surface removed, as all of it was double")
    elif not keep.all():
        copies = plural(int(np.count_nonzero(~keep)), "repeated triangle")
        done.append(f"{copies} removed")
    return compact(TriangleMesh(mesh.vertices, t[keep])), done


def without_double_faces(mesh: TriangleMesh) -> tuple[TriangleMesh, list[str]]:
    """Without triangles that lie face to face, which enclose nothing."""
    t = mesh.triangles
    face, _, total = _faces(t, len(mesh.vertices))
    double = (total > 1)[face]
    if not double.any() or double.all():
        return mesh, []
    rest = compact(TriangleMesh(mesh.vertices, t[~double]))
    return rest, [f"{plural(int(double.sum()), 'triangle')} that lie face to face removed"]


def _faces(t: NDArray[np.int32], vertices: int) -> tuple[Ints, NDArray[np.bool_], Ints]:
    """The face (three vertices in any order) of each triangle, whether it looks up, and the
    number of triangles on each face.
    """
    # Odd permutations of the sorted corners face the other way.
    odd = (t[:, 0] > t[:, 1]) ^ (t[:, 1] > t[:, 2]) ^ (t[:, 0] > t[:, 2])
    ordered = np.sort(t.astype(np.int64), axis=1)
    key = np.unique(ordered[:, 0] * vertices + ordered[:, 1], return_inverse=True)[1].ravel()
    key = np.unique(key * vertices + ordered[:, 2], return_inverse=True)[1].ravel()
    return key, ~odd, np.bincount(key)
