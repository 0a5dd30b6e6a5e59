# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is to be open in a skin: faces without one, and drain holes."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..mesh.remesh import facet_normals
from ..mesh.smooth_faces import smooth_faces
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..util.content import content_of, freeze
from ..util.errors import VolfrepError
from ..util.linalg import along
from ..util.numbers import direction, number, place_text, point, whole
from ..util.types import Bools, Floats

Vector = tuple[float, float, float]

#: A face lies in a plane when its corners are nearer to it than this part of the diagonal of the
#: solid's box, and a facet belongs to a patch when its corners are nearer to that than this.
IN_PLANE = 1e-4
NEAR_PATCH = 1e-3
#: A point lies on a face when it is this near to it, in diagonals of the solid's box.
ON_FACE = 5e-3
#: Points lie in open faces when they are this near to them, in units of their size.
ON_OPENING = 1e-7
#: A facet lies along a plane or a patch when the cosine of the angle between them is above this.
ALONG_PLANE = 0.999
ALONG_PATCH = 0.9
#: The box about a patch is wider than what is near by this, for rounding.
BOX_ROOM = 1.01
#: More places than this, or automatic holes for one void, are a mistake.
MOST_HOLES = 100


@dataclass(frozen=True)
class OpenPlane:
    """The faces of a part in a plane.

    Attributes:
        point: any point of the plane, mm.
        normal: across it, of any length and either sense.
    """

    point: Vector
    normal: Vector

    def __post_init__(self) -> None:
        point("point of an open plane", self.point)
        direction("normal of an open plane", self.normal)

    def contains(self, solid: TriangleMesh) -> Bools:
        """(m,) which triangles of a solid lie in the plane."""
        normal = np.array(self.normal, float) / np.linalg.norm(self.normal)
        size = float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
        off = np.abs(along(solid.vertices - np.array(self.point), normal)) < IN_PLANE * size
        level = np.abs(along(facet_normals(solid), normal)) > ALONG_PLANE
        return np.asarray(off[solid.triangles].all(axis=1) & level)

    def __str__(self) -> str:
        return f"the plane through {place_text(self.point)}"


@dataclass(frozen=True)
class OpenPatch:
    """The faces of a part near some facets, such as those of a face picked in FreeCAD.

    Attributes:
        corners: (k, 3, 3) float64, of the facets, mm.
    """

    corners: Floats = field(compare=False)
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "corners", freeze(self.corners, np.float64))
        object.__setattr__(self, "_content", content_of(self.corners))

    def contains(self, solid: TriangleMesh) -> Bools:
        """(m,) which triangles of a solid lie on the patch: corners, middle and direction."""
        patch = TriangleMesh(
            self.corners.reshape(-1, 3),
            np.arange(3 * len(self.corners), dtype=np.int32).reshape(-1, 3),
        )
        reach = NEAR_PATCH * float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
        # A patch is a small part of a solid: what lies outside of its box is not asked further.
        low, high = patch.bounds
        beyond = np.maximum(low - solid.vertices, solid.vertices - high).max(axis=1)
        result = (beyond < BOX_ROOM * reach)[solid.triangles].all(axis=1)
        some = TriangleMesh(solid.vertices, solid.triangles[result])
        if not len(some.triangles):
            return np.asarray(result)
        corners = np.stack(some.corners(), axis=1)
        points = np.concatenate([corners, corners.mean(axis=1)[:, None]], axis=1)
        from ..spatial.proximity import closest_points  # slow to import, and most jobs open no face

        _, distance, facet = closest_points(patch, points.reshape(-1, 3))
        near = (distance.reshape(-1, 4) < reach).all(axis=1)
        towards = facet_normals(patch)[facet.reshape(-1, 4)[:, 3]]
        along = np.einsum("ij,ij->i", facet_normals(some), towards) > ALONG_PATCH
        result[result] = near & along
        return np.asarray(result)

    def identity(self) -> tuple[Floats, int]:
        """What counts of it for `util.content.digest_of`: corners, and how many facets there are.

        To a thousandth of a micrometre, so that the rounding of a placement that is undone is no
        change. In whatever order, and joined by whatever diagonals: FreeCAD draws other ones in a
        face that was saved and opened.
        """
        return np.unique(np.round(self.corners.reshape(-1, 3), 6) + 0.0, axis=0), len(self.corners)

    def as_json(self) -> dict[str, Any]:
        """What tells one patch from another, as plain JSON values."""
        digest = hashlib.blake2b(np.round(self.corners, 6).tobytes(), digest_size=8)
        return {"facets": len(self.corners), "digest": digest.hexdigest()}

    def __str__(self) -> str:
        return f"the face near {place_text(self.corners.reshape(-1, 3).mean(axis=0))}"


@dataclass(frozen=True)
class SmoothFace:
    """The face of a part at a point, as far as no sharp edge ends it.

    Attributes:
        point: on the face, or near it, mm.
    """

    point: Vector

    def __post_init__(self) -> None:
        point("point of a face", self.point)

    def contains(self, solid: TriangleMesh) -> Bools:
        """(m,) which triangles of a solid belong to it; none where the point is off the surface."""
        from ..spatial.proximity import closest_points  # slow to import, and seldom needed

        _, distance, facet = closest_points(solid, np.array([self.point], float))
        size = float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
        if distance[0] > ON_FACE * size:
            return np.zeros(len(solid.triangles), bool)
        face = smooth_faces(solid)
        return np.asarray(face == face[facet[0]])

    def __str__(self) -> str:
        return f"the point {place_text(self.point)}"


OpenFace = OpenPlane | OpenPatch | SmoothFace


@dataclass(frozen=True)
class DrainPlace:
    """Where a drain hole is wanted.

    Attributes:
        point: on the part's surface, or near it: the nearest point of the surface counts, mm.
        direction: along the hole, of any length and either sense; None for across the surface.
    """

    point: Vector
    direction: Vector | None = None

    def __post_init__(self) -> None:
        point("place of a drain hole", self.point)
        if self.direction is not None:
            direction("direction of a drain hole", self.direction)


@dataclass(frozen=True)
class DrainHoles:
    """Holes through the skin.

    Attributes:
        diameter: mm.
        places: where they are wanted.
        count: holes for each void that is still closed then, at its lowest places.
        build_direction: which way is up, of any length.
    """

    diameter: float
    places: tuple[DrainPlace, ...] = ()
    count: int = 0
    build_direction: Vector = (0.0, 0.0, 1.0)

    def __post_init__(self) -> None:
        number("diameter of drain holes", self.diameter, "mm", positive=True)
        whole("number of drain holes", self.count, 0, MOST_HOLES)
        if len(self.places) > MOST_HOLES:
            raise VolfrepError(
                f"There are {len(self.places)} places for drain holes: give at most {MOST_HOLES}."
            )
        if not self.places and not self.count:
            raise VolfrepError("Drain holes need places, or a count of how many to place.")
        direction("build direction", self.build_direction)


def open_surface(solid: TriangleMesh, is_open: Bools) -> TriangleMesh:
    """The open faces of a solid, (m,) of its triangles, as a mesh."""
    return compact(TriangleMesh(solid.vertices, solid.triangles[is_open]))


def lie_on(openings: TriangleMesh, points: Floats, reach: Floats | float = 0.0) -> Bools:
    """(n,) which points lie in open faces, or as near to them as the reach, mm."""
    if not len(points):
        return np.zeros(0, bool)
    size = float(np.ptp(openings.bounds, axis=0).max())
    from ..spatial.proximity import closest_points

    return np.asarray(closest_points(openings, points)[1] <= np.maximum(reach, ON_OPENING * size))


def open_triangles(solid: TriangleMesh, faces: tuple[OpenFace, ...]) -> Bools:
    """(m,) which triangles of a solid are left open.

    Raises:
        VolfrepError: a plane or a patch holds no face of the solid, or all of it is open.
    """
    result = np.zeros(len(solid.triangles), bool)
    for face in faces:
        found = face.contains(solid)
        if not found.any():
            raise VolfrepError(
                f"No face of the part lies in {face}: give a point on a face that is to be open."
            )
        result |= found
    if result.all():
        raise VolfrepError(
            "All faces of the part are left open: for no skin at all, reduce the skin thickness "
            "to 0."
        )
    return result
