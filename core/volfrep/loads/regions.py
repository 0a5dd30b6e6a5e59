# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where supports and loads act: regions of space and of a part's surface.

A region says two things: how far points are from it, by which nodes are found, and which facets of
a surface it takes. What a length is compared with is given by the caller: a tolerance of rounding,
or how far the material of a node reaches.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..design.openings import OpenPatch
from ..mesh.remesh import facet_normals
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import closest_points
from ..util.content import content_of, freeze
from ..util.errors import VolfrepError, listed
from ..util.numbers import place_text
from ..util.types import Bools, Floats

Vector = tuple[float, float, float]

#: A facet lies along a plane when the cosine of the angle between them is above this.
ALONG_PLANE = 0.999


@dataclass(frozen=True)
class InPlane:
    """All that lies in a plane.

    Attributes:
        point: any of the plane, mm.
        normal: across it, of any length and either sense.
    """

    point: Vector
    normal: Vector

    def __post_init__(self) -> None:
        check_vector("point of a plane", self.point)
        check_vector("normal of a plane", self.normal, not_zero=True)

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points."""
        result: Floats = np.abs((points - np.array(self.point)) @ _unit(self.normal))
        return result

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) which triangles lie in it with their corners, and along it."""
        near = self.distance(mesh.vertices) <= tolerance
        along = np.abs(facet_normals(mesh) @ _unit(self.normal)) > ALONG_PLANE
        return np.asarray(near[mesh.triangles].all(axis=1) & along)

    def __str__(self) -> str:
        return f"the plane through {place_text(self.point)} across {place_text(self.normal)}"


@dataclass(frozen=True)
class InBox:
    """All that lies in a box along the axes.

    Attributes:
        low, high: its corners, mm.
    """

    low: Vector
    high: Vector

    def __post_init__(self) -> None:
        check_vector("corner of a box", self.low)
        check_vector("corner of a box", self.high)
        if any(low > high for low, high in zip(self.low, self.high, strict=True)):
            raise VolfrepError(
                f"The box from {place_text(self.low)} to {place_text(self.high)} is inside out: "
                "give its lowest corner first."
            )

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points; 0 inside."""
        outside = np.maximum(np.array(self.low) - points, points - np.array(self.high))
        result: Floats = np.linalg.norm(np.maximum(outside, 0.0), axis=1)
        return result

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) which triangles lie in it with their middles."""
        return self.distance(facet_middles(mesh)) <= tolerance

    def __str__(self) -> str:
        return f"the box from {place_text(self.low)} to {place_text(self.high)}"


@dataclass(frozen=True)
class InCylinder:
    """All that lies in a cylinder, its mantle included: a bolt's hole, for example.

    Attributes:
        point: any of the axis, mm; where the cylinder begins if it has a length.
        axis: along it, of any length.
        radius: mm.
        length: along the axis from the point, mm; None for a cylinder without ends.
    """

    point: Vector
    axis: Vector
    radius: float
    length: float | None = None

    def __post_init__(self) -> None:
        check_vector("point of a cylinder", self.point)
        check_vector("axis of a cylinder", self.axis, not_zero=True)
        _check_above_zero("radius of a cylinder", self.radius)
        if self.length is not None:
            _check_above_zero("length of a cylinder", self.length)

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points; 0 inside."""
        axis = _unit(self.axis)
        offset = points - np.array(self.point)
        height = offset @ axis
        aside = np.linalg.norm(offset - height[:, None] * axis, axis=1) - self.radius
        beyond = np.zeros(len(points))
        if self.length is not None:
            beyond = np.maximum(np.maximum(-height, height - self.length), 0.0)
        result: Floats = np.hypot(np.maximum(aside, 0.0), beyond)
        return result

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) which triangles lie in it with their middles."""
        return self.distance(facet_middles(mesh)) <= tolerance

    def __str__(self) -> str:
        return (
            f"the cylinder of radius {self.radius:.4g} mm about {place_text(self.point)} along "
            f"{place_text(self.axis)}"
        )


@dataclass(frozen=True)
class NearPoint:
    """All within a distance of a point; without one, the nearest node alone.

    Attributes:
        point: mm.
        within: mm; None for the nearest node.
    """

    point: Vector
    within: float | None = None

    def __post_init__(self) -> None:
        check_vector("point", self.point)
        if self.within is not None:
            _check_above_zero("distance from a point", self.within)

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points; 0 within its distance."""
        far: Floats = np.linalg.norm(points - np.array(self.point), axis=1)
        return np.maximum(far - (self.within or 0.0), 0.0)

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) which triangles lie in it with their middles; the nearest node has none."""
        if self.within is None:
            return np.zeros(len(mesh.triangles), bool)
        return self.distance(facet_middles(mesh)) <= tolerance

    def __str__(self) -> str:
        if self.within is None:
            return f"the point {place_text(self.point)}"
        return f"the ball of radius {self.within:.4g} mm about {place_text(self.point)}"


@dataclass(frozen=True)
class OnFacets:
    """A part of the surface: faces picked in a program, or found by their number.

    Attributes:
        corners: (k, 3, 3) float64, of its facets, mm.
        name: for messages, such as "face 3".
    """

    corners: Floats = field(compare=False)
    name: str = "the facets"
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "corners", freeze(self.corners, np.float64))
        object.__setattr__(self, "_content", content_of(self.corners))
        if self.corners.ndim != 3 or self.corners.shape[1:] != (3, 3) or not len(self.corners):
            raise VolfrepError(f"{self.name.capitalize()} needs facets of three corners.")

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points."""
        return closest_points(self._mesh(), points)[1]

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) which triangles lie on it, and look its way."""
        return OpenPatch(self.corners).contains(mesh)

    def _mesh(self) -> TriangleMesh:
        rows = np.arange(3 * len(self.corners), dtype=np.int32)
        return TriangleMesh(self.corners.reshape(-1, 3), rows.reshape(-1, 3))

    def __str__(self) -> str:
        middle = self.corners.reshape(-1, 3).mean(axis=0)
        return f"{self.name} near {place_text(middle)}"


@dataclass(frozen=True)
class OnLine:
    """A line of straight pieces, such as an edge picked in a program.

    Attributes:
        points: (k, 3) float64, along it, mm.
        name: for messages, such as "edge 3".
    """

    points: Floats = field(compare=False)
    name: str = "the line"
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", freeze(self.points, np.float64))
        object.__setattr__(self, "_content", content_of(self.points))
        if self.points.ndim != 2 or self.points.shape[1] != 3 or len(self.points) < 2:
            raise VolfrepError(f"{self.name.capitalize()} needs two points or more.")

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points."""
        nearest = np.full(len(points), np.inf)
        for start, end in zip(self.points[:-1], self.points[1:], strict=True):
            span = end - start
            share = (points - start) @ span / max(float(span @ span), 1e-300)
            foot = start + np.clip(share, 0.0, 1.0)[:, None] * span
            nearest = np.minimum(nearest, np.linalg.norm(points - foot, axis=1))
        return nearest

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) none: a line has no area."""
        return np.zeros(len(mesh.triangles), bool)

    def __str__(self) -> str:
        return f"{self.name} from {place_text(self.points[0])} to {place_text(self.points[-1])}"


@dataclass(frozen=True)
class AllOf:
    """What several regions have in common, such as a plane's part in a box."""

    regions: tuple[Region, ...]

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points, of the region that is farthest: at most the true one."""
        return np.asarray(np.max([region.distance(points) for region in self.regions], axis=0))

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) which triangles all of them take."""
        taken = [region.facets(mesh, tolerance) for region in self.regions]
        return np.asarray(np.all(taken, axis=0))

    def __str__(self) -> str:
        return " within ".join(str(region) for region in self.regions)


@dataclass(frozen=True)
class AnyOf:
    """Several regions as one, such as the faces that share a force."""

    regions: tuple[Region, ...]

    def distance(self, points: Floats) -> Floats:
        """(n,) mm, from (n, 3) points, of the nearest."""
        return np.asarray(np.min([region.distance(points) for region in self.regions], axis=0))

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        """(m,) which triangles one of them takes."""
        taken = [region.facets(mesh, tolerance) for region in self.regions]
        return np.asarray(np.any(taken, axis=0))

    def __str__(self) -> str:
        return listed([str(region) for region in self.regions], "and")


Region = InPlane | InBox | InCylinder | NearPoint | OnFacets | OnLine | AllOf | AnyOf


def simple_regions(region: Region) -> tuple[Region, ...]:
    """The regions that a union consists of; any other region by itself."""
    if isinstance(region, AnyOf):
        return tuple(simple for part in region.regions for simple in simple_regions(part))
    return (region,)


def facet_middles(mesh: TriangleMesh) -> Floats:
    """(m, 3) mm."""
    a, b, c = mesh.corners()
    middles: Floats = (a + b + c) / 3.0
    return middles


def check_vector(name: str, vector: Sequence[float], not_zero: bool = False) -> None:
    """Refuse what is not three finite numbers, or where asked their zero."""
    if len(vector) != 3 or not all(math.isfinite(value) for value in vector):
        raise VolfrepError(f"The {name} must be three finite numbers.")
    if not_zero and not any(vector):
        raise VolfrepError(f"The {name} must not be zero.")


def _check_above_zero(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0):
        raise VolfrepError(f"The {name} must be above 0 mm, not {value:g}.")


def _unit(vector: Vector) -> Floats:
    result: Floats = np.array(vector, float) / np.linalg.norm(vector)
    return result
