# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a window draws of a mesh, made beside it: a proxy at once, all of it piece by piece.

FreeCAD reads its own binary format, which holds neighbours, faster than PLY. Coin gets arrays, some
thousand triangles at a time, between which the window answers.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .shading import Shaded, shade, sharp_edges
from .topology import triangles_across
from .triangle_mesh import TriangleMesh, compact, rows_where
from .vertex_cluster import cluster_vertices

#: Triangles of a piece: a graphics driver without a card takes them in a few hundredths of a
#: second.
PIECE = 20_000
#: Meshes of more triangles are drawn as a proxy of so many first.
AT_ONCE = 120_000
#: No triangle on the other side: -1 without its sign.
NOTHING = 0xFFFFFFFF


@dataclass(frozen=True, eq=False)
class Pieces:
    """A mesh to draw, whose triangles come in pieces with points of their own.

    The arrays hold piece after piece, so that they travel as a whole.

    Attributes:
        points: (n, 3) float32, mm.
        normals: (n, 3) float32, of length 1, outwards.
        index: (t, 4) int32, three points of the own piece each, and -1, as Coin has it.
        first_points: (p + 1,) where the points of each piece begin, and where the last one ends.
        first_triangles: (p + 1,) the same of its triangles.
    """

    points: NDArray[np.float32]
    normals: NDArray[np.float32]
    index: NDArray[np.int32]
    first_points: NDArray[np.int64]
    first_triangles: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.first_points) - 1

    def __iter__(
        self,
    ) -> Iterator[tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.int32]]]:
        """Points, normals and index of one piece after the other."""
        for k in range(len(self)):
            points = slice(self.first_points[k], self.first_points[k + 1])
            triangles = slice(self.first_triangles[k], self.first_triangles[k + 1])
            yield self.points[points], self.normals[points], self.index[triangles]


@dataclass(frozen=True, eq=False)
class DrawnPart:
    """Those triangles of a mesh that are of one kind.

    Attributes:
        kind: the number of the kind.
        first: a proxy that is drawn at once; None where the pieces are few enough.
        pieces: all that is to be seen in the end.
        edges: (e, 2, 3) float32 ends of the sharp edges, mm.
    """

    kind: int
    first: Pieces | None
    pieces: Pieces
    edges: NDArray[np.float32]


def drawn_parts(
    mesh: TriangleMesh, kinds: NDArray[np.uint8], most: int, with_edges: tuple[int, ...]
) -> tuple[DrawnPart, ...]:
    """What is drawn of a mesh.

    Args:
        mesh: any.
        kinds: (t,) of its triangles.
        most: of each kind so many triangles at most; where there are more, a proxy of them.
        with_edges: the kinds whose sharp edges are drawn.
    """
    found = []
    has_proxy = len(mesh.triangles) > AT_ONCE
    for kind in np.unique(kinds).tolist():
        rows = kinds == kind
        whole = compact(TriangleMesh(mesh.vertices, rows_where(rows, mesh.triangles)), owned=True)
        part = cluster_vertices(whole, most)
        first = None
        if has_proxy:
            share = rows.mean() * AT_ONCE
            first = in_pieces(shade(cluster_vertices(part, max(int(share), AT_ONCE // 8))))
        edges = np.zeros((0, 2, 3), np.float32)
        if kind in with_edges:
            edges = part.vertices[sharp_edges(part)].astype(np.float32)
        found.append(DrawnPart(kind, first, in_pieces(shade(part)), edges))
    return tuple(found)


def in_pieces(drawn: Shaded, most: int = PIECE) -> Pieces:
    """The same triangles in their order, in pieces of so many."""
    count = len(drawn.triangles)
    firsts = np.append(np.arange(0, count, most), count)
    index = np.full((count, 4), -1, np.int32)
    used, ends = [], [0]
    for low, high in itertools.pairwise(firsts):
        points, local = np.unique(drawn.triangles[low:high], return_inverse=True)
        index[low:high, :3] = local.reshape(-1, 3)
        used.append(points)
        ends.append(ends[-1] + len(points))
    rows = np.concatenate(used) if used else np.zeros(0, np.int64)
    return Pieces(drawn.points[rows], drawn.normals[rows], index, np.array(ends, np.int64), firsts)


def finer(pieces: Pieces, longest: float) -> Pieces:
    """The same surface in triangles without longer sides, so that colours follow values within it.

    Triangles are halved across their longest side, again and again, up to `AT_ONCE` of them.

    Args:
        pieces: to be drawn.
        longest: side, mm.
    """
    points, normals, counts = [], [], []
    total = len(pieces.index)
    for own_points, own_normals, index in pieces:
        corners = np.concatenate([own_points, own_normals], axis=1)[index[:, :3]]
        while total < AT_ONCE:
            sides = np.linalg.norm((np.roll(corners, -1, axis=1) - corners)[..., :3], axis=2)
            over = sides.max(axis=1) > longest
            if not over.any():
                break
            turned = (sides[over].argmax(axis=1)[:, None] + np.arange(3)) % 3
            one, two, three = np.take_along_axis(corners[over], turned[:, :, None], 1).swapaxes(
                0, 1
            )
            middle = 0.5 * (one + two)
            halves = [
                np.stack(half, axis=1) for half in ((one, middle, three), (middle, two, three))
            ]
            corners = np.concatenate([corners[~over], *halves])
            total += int(over.sum())
        points.append(corners.reshape(-1, 6)[:, :3])
        turns = corners.reshape(-1, 6)[:, 3:]
        normals.append(turns / np.maximum(np.linalg.norm(turns, axis=1), 1e-30)[:, None])
        counts.append(len(corners))
    first = np.append(0, np.cumsum(counts)).astype(np.int64)
    index = np.full((first[-1], 4), -1, np.int32)
    for low, high in itertools.pairwise(first):
        index[low:high, :3] = np.arange(3 * (high - low)).reshape(-1, 3)
    return Pieces(
        np.concatenate(points).astype(np.float32), np.concatenate(normals).astype(np.float32),
        index, 3 * first, first,
    )  # fmt: skip


def facets_with_neighbours(mesh: TriangleMesh) -> NDArray[np.uint32]:
    """(t, 6) the corners of each triangle, and the triangles across its sides, or `NOTHING`.

    Side k goes from corner k to the next.
    """
    facets = np.empty((len(mesh.triangles), 6), np.uint32)
    facets[:, :3] = mesh.triangles
    facets[:, 3:] = triangles_across(mesh).view(np.uint32)
    return facets
