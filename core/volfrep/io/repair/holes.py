# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holes in a surface: small or flat ones are closed, sheets that hang on it are cut off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...mesh.topology import edges_of, pieces_of
from ...mesh.triangle_mesh import TriangleMesh, compact
from ...util.linalg import along, normalize
from ...util.numbers import place_text, plural
from ...util.types import Floats, Ints
from .polygons import cut_loops, mean_normal
from .weld import ROUNDING

#: Holes are walked edge by edge: with more open edges than this the surface is not mended.
MOST_OPEN = 20_000
#: A hole is flat when its rim strays from its plane by no more than this part of its width. Its
#: closing is then certain, and may make up this part of the surface's area.
FLAT = 1e-3
MOST_FLAT_AREA = 0.1
#: A hole in a curved place has a rim that strays by no more than this part of its width; what is
#: cut off or added by a flat closing is then a small part of a small area.
NEARLY_FLAT = 0.2
MOST_CURVED_AREA = 0.01
#: How often the farthest point of a rim is gone to.
ROUNDS = 8
#: Sheets that are cut off make up no more than this part of the area.
MOST_SHEET_AREA = 0.1


@dataclass(frozen=True, eq=False)
class _Hole:
    rim: Ints
    normal: Floats
    width: float
    deviation: float

    @property
    def area(self) -> float:
        return float(np.linalg.norm(self.normal)) / 2.0


def cut_off_sheets(mesh: TriangleMesh) -> tuple[TriangleMesh, list[str]]:
    """Without small open sheets that hang on an edge of a surface, or are flat."""
    edges = edges_of(mesh)
    if not (edges.count == 1).any():
        return mesh, []
    one, other = edges.pairs()
    pieces, piece = pieces_of(one // 3, other // 3, len(mesh.triangles))
    piece_of_side = np.repeat(piece, 3)
    is_open = np.zeros(pieces, bool)
    is_open[piece_of_side[(edges.count == 1)[edges.number]]] = True
    hangs = np.zeros(pieces, bool)
    hangs[piece_of_side[((edges.count > 2) & (edges.count % 2 == 1))[edges.number]]] = True
    areas = mesh.areas()
    small = np.bincount(piece, weights=areas) <= MOST_SHEET_AREA * areas.sum()
    gone = (is_open & small & (hangs | _flat_pieces(mesh, piece, pieces)))[piece]
    if not gone.any() or gone.all():
        return mesh, []
    rest = compact(TriangleMesh(mesh.vertices, mesh.triangles[~gone]))
    if len(edges_of(rest).open_sides) >= len(edges.open_sides):
        return mesh, []
    place = mesh.vertices[mesh.triangles[np.flatnonzero(gone)[0]]].mean(axis=0)
    sheets = len(np.unique(piece[gone]))
    return rest, [f"{plural(sheets, 'sheet')} without a thickness cut off near {place_text(place)}"]


def _flat_pieces(mesh: TriangleMesh, piece: Ints, pieces: int) -> NDArray[np.bool_]:
    """(pieces,) whether all triangles of a piece lie in one plane."""
    corners = np.stack(mesh.corners(), axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    largest = np.lexsort((-np.linalg.norm(normal, axis=1), piece))
    first = largest[np.unique(piece[largest], return_index=True)[1]]
    unit = normalize(normal[first])
    above = np.abs(np.einsum("nij,nj->ni", corners - corners[first[piece], :1], unit[piece]))
    bent = above.max(axis=1) > ROUNDING * float(np.ptp(mesh.bounds, axis=0).max())
    flat = np.ones(pieces, bool)
    flat[piece[bent]] = False
    return flat


def close_holes(mesh: TriangleMesh) -> tuple[TriangleMesh, list[str], str]:
    """The mesh with its holes closed by plane pieces, as far as that is certain.

    Args:
        mesh: neighbours wound alike.

    Returns:
        The mesh, what was done, and why the worst of the other holes was left, if any was.
    """
    edges = edges_of(mesh)
    rims = edges.sides[edges.open_sides]
    if not len(rims):
        return mesh, [], ""
    if len(rims) > MOST_OPEN:
        return mesh, [], "there are too many of them to be holes"
    loops = _loops(rims)
    if loops is None:
        return mesh, [], "they do not lie round holes"
    holes = [_hole(mesh, loop) for loop in loops]
    total = float(mesh.areas().sum())
    pieces: list[Ints] = []
    left = ""
    closed: list[_Hole] = []
    for face in _faces(holes, mesh):
        area = abs(float(np.linalg.norm(sum(hole.normal for hole in face)))) / 2.0
        width, deviation = max(h.width for h in face), max(h.deviation for h in face)
        most = MOST_FLAT_AREA if deviation <= FLAT * width else MOST_CURVED_AREA
        place = place_text(mesh.vertices[face[0].rim].mean(axis=0))
        if deviation > NEARLY_FLAT * width:
            left = f"the hole near {place} is not flat enough to be closed for certain"
        elif area > most * total:
            left = f"the hole near {place} is too large to be closed for certain"
        else:
            cut = cut_loops(mesh.vertices, [hole.rim for hole in face])
            if cut is None:
                left = f"the rim of the hole near {place} crosses itself"
            else:
                pieces.append(cut)
                closed += face
    if not closed:
        return mesh, [], left
    triangles = np.concatenate([mesh.triangles.astype(np.int64), *pieces]).astype(np.int32)
    widest = max(closed, key=lambda hole: hole.width)
    text = (
        f"{plural(len(closed), 'hole')} closed, the widest {widest.width:.3g} mm near "
        f"{place_text(mesh.vertices[widest.rim].mean(axis=0))}"
    )
    return TriangleMesh(mesh.vertices, triangles), [text], left


def _loops(rims: Ints) -> list[Ints] | None:
    """The rims of holes, each walked against its open sides; None where they are no loops.

    Where rims touch in a vertex each is walked by itself: a walk that comes back to a vertex has
    gone round a hole.
    """
    rims = rims[:, ::-1]  # what closes the hole runs the other way
    order = np.argsort(rims[:, 0], kind="stable")
    starts, ends = rims[order, 0], rims[order, 1]
    if not np.array_equal(np.sort(starts), np.sort(ends)):
        return None
    following: dict[int, list[int]] = {}
    for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
        following.setdefault(start, []).append(end)
    loops: list[Ints] = []
    for first in list(following):
        walk = [first]
        seen = {first: 0}
        while walk:
            ways = following[walk[-1]]
            if not ways:
                break
            vertex = ways.pop()
            if vertex not in seen:
                seen[vertex] = len(walk)
                walk.append(vertex)
                continue
            loop = walk[seen[vertex] :]
            loops.append(np.array(loop, np.int64))
            for gone in loop[1:]:
                del seen[gone]
            del walk[seen[vertex] + 1 :]
    return loops


def _hole(mesh: TriangleMesh, rim: Ints) -> _Hole:
    points = mesh.vertices[rim]
    normal = mean_normal(points)
    centred = points - points.mean(axis=0)
    width = _farthest_apart(points)
    length = float(np.linalg.norm(normal))
    deviation = float(np.abs(along(centred, normal)).max()) / length if length > 0.0 else np.inf
    return _Hole(rim, normal, width, deviation if len(rim) > 3 else 0.0)


def _farthest_apart(points: Floats) -> float:
    """Distance of the two points of a rim that are farthest apart, by going to and fro, mm."""
    width, here = 0.0, points.mean(axis=0)
    for _ in range(ROUNDS):
        away = np.linalg.norm(points - here, axis=1)
        here = points[away.argmax()]
        width = max(width, float(np.linalg.norm(points - here, axis=1).max()))
    return width


def _faces(holes: list[_Hole], mesh: TriangleMesh) -> list[list[_Hole]]:
    """Holes by the plane faces they leave open: a rim in a rim bounds the same face from inside.

    Only rims that run the other way, in the same plane and in the box of the larger one, belong
    to its face.
    """
    by_size = sorted(holes, key=lambda hole: -hole.area)
    faces: list[list[_Hole]] = []
    for hole in by_size:
        for face in faces:
            outer = face[0]
            unit = outer.normal / max(float(np.linalg.norm(outer.normal)), 1e-300)
            points, around = mesh.vertices[hole.rim], mesh.vertices[outer.rim]
            above = np.abs(along(points - around.mean(axis=0), unit)).max()
            inside = (points >= around.min(axis=0) - above).all() and (
                points <= around.max(axis=0) + above
            ).all()
            flat = outer.deviation <= FLAT * outer.width and above <= FLAT * outer.width
            if flat and inside and float(along(hole.normal, unit)) < 0.0:
                face.append(hole)
                break
        else:
            faces.append([hole])
    return faces
