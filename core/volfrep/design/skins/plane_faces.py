# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plane faces of a solid, whatever facets they came in, and where a skin's wall has them moved.

A skin's wall is made by moving faces (`shell/moved_faces`) where cubes would take long and these
are few; else it is looked for with cubes.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...mesh.remesh import facet_normals, heights
from ...mesh.topology import pieces_of
from ...mesh.triangle_mesh import TriangleMesh
from ...spatial.proximity import neighbours
from ...util.linalg import along, lengths, normalize
from ...util.types import Floats, Ints
from .. import costs

#: Faces are moved where cubes would take longer, and more seconds than this; and no more than so
#: many bodies, of no more triangles.
SLOW = 2.18
MOST_BODIES = 3000
MOST_TRIANGLES = 20_000
#: Vertices of one face lie off its plane by no more than this, in thicknesses, and facets that are
#: higher than that are turned from it by less than this (cosine).
PLANE = 1e-3
ALONG_PLANE = 0.9
#: Sums of slopes (sines) up to this tell where faces end: the angles are no more than 1.1 times as
#: large.
STEEP = 0.5
#: Edges bent by less than this, radians, count as flat: their sectors only close gaps.
BEND = 1e-3
#: A part of a ball takes as long as so many prisms.
PER_BALL = 20


@dataclass(frozen=True, eq=False)
class PlaneFaces:
    """The plane faces of a solid, and the edges and vertices that need bodies of their own.

    Attributes:
        solid: its mesh.
        face: (m,) the face of each triangle.
        normal: (f, 3) of the faces, outward.
        edges: (e, 2) ends of the edges that are reentrant, or flat, between two faces.
        beside: (e, 2) the face to the left of each, seen from outside, and the one to the right.
        angle: (e,) by which they are reentrant, radians.
        corners: (v,) vertices of three or more reentrant edges.
    """

    solid: TriangleMesh
    face: Ints
    normal: Floats
    edges: Ints
    beside: Ints
    angle: Floats
    corners: Ints

    @property
    def bodies(self) -> int:
        """How many bodies are taken from the solid, a part of a ball counted as `PER_BALL`."""
        return len(self.normal) + len(self.edges) + PER_BALL * len(self.corners)


def find_plane_faces(
    solid: TriangleMesh, thickness: float, most: int = MOST_BODIES
) -> PlaneFaces | None:
    """The plane faces of a closed solid, flat to `PLANE` of a thickness, mm.

    None where they take more than so many bodies: of a round solid that is known early.

    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    >>> triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.int32)
    >>> find_plane_faces(TriangleMesh(corners, triangles), 0.1).bodies
    4
    """
    across = neighbours(solid)
    if least_faces(solid, across, PLANE * thickness) > most:
        return None
    face, normal = _grow_faces(solid, across, PLANE * thickness, most)
    if len(normal) > most:
        return None
    triangle, side = np.nonzero(across > np.arange(len(across))[:, None])
    beside = face[np.stack([triangle, across[triangle, side]], axis=1)]
    parts = beside[:, 0] != beside[:, 1]
    triangle, side, beside = triangle[parts], side[parts], beside[parts]
    ends = np.stack(
        [solid.triangles[triangle, side], solid.triangles[triangle, (side + 1) % 3]], axis=1
    ).astype(np.int64)
    way = solid.vertices[ends[:, 1]] - solid.vertices[ends[:, 0]]
    one, other = normal[beside[:, 0]], normal[beside[:, 1]]
    sine = np.einsum("ij,ij->i", np.cross(other, one), normalize(way))
    angle = np.arctan2(sine, np.einsum("ij,ij->i", one, other))
    count = np.bincount(ends[angle > BEND].ravel(), minlength=len(solid.vertices))
    needed = angle > -BEND
    found = PlaneFaces(
        solid, face, normal, ends[needed], beside[needed], np.maximum(angle[needed], 0.0),
        np.flatnonzero(count >= 3),
    )  # fmt: skip
    return found if found.bodies <= most else None


def _grow_faces(solid: TriangleMesh, across: Ints, reach: float, most: int) -> tuple[Ints, Floats]:
    """(m,) the face of each triangle and (f, 3) normals: from the largest triangles on.

    It ends once there are more than so many; other triangles then have the face -1.
    """
    corners = np.stack(solid.corners(), axis=1)
    normal, low = facet_normals(solid), heights(corners) < reach
    face = np.full(len(corners), -1)
    seeds: list[int] = []
    for seed in np.argsort(-solid.areas(), kind="stable").tolist():
        if face[seed] >= 0:
            continue
        level = along(corners[seed, 0], normal[seed])
        face[seed] = len(seeds)
        border = np.array([seed])
        while len(border):
            near = np.unique(across[border])
            near = near[face[near] < 0]
            off = np.abs(along(corners[near], normal[seed]) - level).max(axis=1, initial=0.0)
            alike = (along(normal[near], normal[seed]) > ALONG_PLANE) | low[near]
            border = near[(off <= reach) & alike]
            face[border] = len(seeds)
        seeds.append(seed)
        if len(seeds) > most:
            break
    return face, normal[seeds]


def least_faces(solid: TriangleMesh, across: Ints, reach: float) -> int:
    """So many faces there are at least: one in each patch between edges that divide faces.

    The planes of two triangles whose corners lie within the reach of one plane, mm, have no larger
    angle between them than both have towards that.
    """
    normal, high = facet_normals(solid), heights(np.stack(solid.corners(), axis=1))
    triangle, side = np.nonzero(across > np.arange(len(across))[:, None])
    other = across[triangle, side]
    slope = 2.0 * reach / np.maximum(high, 1e-300)
    slopes = slope[triangle] + slope[other]
    bent = lengths(np.cross(normal[triangle], normal[other]))
    divides = (slopes < STEEP) & (bent > 1.1 * slopes)
    return pieces_of(triangle[~divides], other[~divides], len(across))[0]


@lru_cache(maxsize=4)
def bending(solid: TriangleMesh) -> float:
    """The angles across a surface's edges, in radians, times these' lengths: mm."""
    across = neighbours(solid)
    a, b, c = solid.corners()
    normal = normalize(np.cross(b - a, c - a))
    total = 0.0
    for k, (start, end) in enumerate(((a, b), (b, c), (c, a))):
        cosine = np.einsum("ij,ij->i", normal, normal[across[:, k]])
        angle = np.arccos(np.clip(cosine, -1.0, 1.0))
        total += 0.5 * float((np.linalg.norm(end - start, axis=1) * angle).sum())
    return total


@lru_cache(maxsize=2)
def few_plane_faces(solid: TriangleMesh, thickness: float) -> PlaneFaces | None:
    """The plane faces that are moved to make an even skin; None where its wall needs cubes.

    Args:
        solid: closed, mm.
        thickness: of the skin, mm.
    """
    if len(solid.triangles) > MOST_TRIANGLES:
        return None
    by_cubes = costs.SECONDS_PER_BEND * bending(solid) / thickness
    if by_cubes <= SLOW:
        return None
    most = int(by_cubes / costs.SECONDS_PER_BODY)
    return find_plane_faces(solid, thickness, min(most, MOST_BODIES))
