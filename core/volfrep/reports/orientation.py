# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which way a part is built best: overhangs, supports in closed rooms, height, footprint.

Some hundreds of directions over the sphere are judged, the best of them refined; and each face that
the part can stand on, since only what lies on the plate needs no support at all. For a direction
over the sphere facets are gathered by their normal, so that it costs the same for any mesh; what is
told is exact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

from ..mesh.remesh import facet_normals
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..spatial.even_points import even_directions
from ..util.errors import VolfrepError
from ..util.linalg import normalize, rotation
from ..util.numbers import number, place_text
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..util.types import Bools, Floats, Ints
from .printability import ON_PLATE
from .processes import find_process

#: Directions over the sphere; faces of the hull, the largest, that the part may stand on.
DIRECTIONS, FACES = 400, 80
#: How many of the best are refined, by which tilts, degrees.
REFINED, TILTS = 8, (6.0, 3.0, 1.5, 0.75)
#: Normals are gathered in steps of one over this.
STEPS = 40
#: What a direction costs: the share of the surface that hangs over, outside and in closed rooms,
#: where no support comes out again; supports over the hull's volume; height over the diagonal; the
#: share of the footprint that does not stand on the plate. Half of an area's cost comes with its
#: hanging over, the other half as it becomes flat.
OUTSIDE, INSIDE, SUPPORT, HEIGHT, BASE = 1.0, 3.0, 0.5, 0.1, 0.05
#: Costs that differ by less are equal: then the lower part, the larger base, the lesser turn.
EQUAL = 1e-5
#: Directions nearer to each other than this, degrees, are one.
APART = 8.0
#: Facets of the hull within so much, degrees, are one face.
ONE_FACE = 0.2


@dataclass(frozen=True)
class Orientation:
    """A direction in which a part may be built.

    Attributes:
        up: unit vector from the build plate up, in the part's coordinates.
        rotation: three rows: the turn that makes it z.
        axis, angle: the same as a turn about an axis, degrees.
        overhang_mm2: facets that face down at less than the inclination, without the plate's.
        inside_mm2: those of these in closed rooms.
        support_mm3: below the others, down to the plate: at most.
        height_mm: of the part.
        base_mm2: what lies on the plate.
        footprint_mm2: shadow of the part's convex hull on the plate.
        cost: what they are sorted by, of area, supports, height and base, to the fifth decimal.
    """

    up: tuple[float, float, float]
    rotation: tuple[tuple[float, float, float], ...]
    axis: tuple[float, float, float]
    angle: float
    overhang_mm2: float
    inside_mm2: float
    support_mm3: float
    height_mm: float
    base_mm2: float
    footprint_mm2: float
    cost: float


@dataclass(frozen=True, eq=False, repr=False)
class Orientations(Shown):
    """The best directions for a part.

    Attributes:
        mesh: the part as it came.
        inclination: least that needs no support, degrees.
        best: the best first.
        as_it_is: with z up.
        tried: how many directions.
    """

    mesh: TriangleMesh
    inclination: float
    best: tuple[Orientation, ...]
    as_it_is: Orientation
    tried: int

    def turned(self, number: int = 0) -> TriangleMesh:
        """The part as it stands on the plate, z up, its lowest place at z = 0.

        Args:
            number: of the directions in `best`.
        """
        turn = np.array(self.best[number].rotation)
        vertices = self.mesh.vertices @ turn.T
        vertices[:, 2] -= vertices[:, 2].min()
        return TriangleMesh(vertices, self.mesh.triangles)

    def hanging(self, up: Sequence[float]) -> TriangleMesh:
        """The facets that hang over, where they lie.

        Args:
            up: as of an `Orientation`.
        """
        normal = facet_normals(self.mesh)
        least = math.cos(math.radians(self.inclination))
        _, _, over = _overhang(self.mesh, normal, np.array(up), least)
        return compact(TriangleMesh(self.mesh.vertices, self.mesh.triangles[over]))

    def as_dict(self) -> dict[str, Any]:
        """The figures as plain JSON values."""
        return {
            "inclination": self.inclination,
            "tried": self.tried,
            "as_it_is": asdict(self.as_it_is),
            "best": [asdict(one) for one in self.best],
        }

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        named = [("as it is", self.as_it_is)]
        named += [(f"{k}.", one) for k, one in enumerate(self.best, 1)]
        rows = [("directions", f"{self.tried:,} tried, below {self.inclination:g} degrees hangs")]
        rows.append(("sorted by", "cost: overhang, supports, height, footprint off the plate"))
        for name, one in named:
            rows.append((name, f"cost {one.cost:.4f}, up {place_text(one.up)}{_turn(one)}"))
            inside = f", {one.inside_mm2:,.4g} of it in closed rooms" * bool(one.inside_mm2)
            rows.append(
                (
                    "",
                    f"hangs over {one.overhang_mm2:,.4g} mm2{inside}; supports at most "
                    f"{one.support_mm3:,.4g} mm3; {one.height_mm:.4g} mm high, stands on "
                    f"{one.base_mm2:,.4g} mm2, footprint {one.footprint_mm2:,.4g} mm2",
                )
            )
        return rows


def orient(
    mesh: TriangleMesh,
    inclination: float = 45.0,
    *,
    best: int = 5,
    progress: ProgressCallback | None = None,
) -> Orientations:
    """The best build directions of a part.

    Args:
        mesh: closed, mm.
        inclination: least inclination of a facet that needs no support, degrees; 0 where nothing
            needs one.
        best: how many are told, at most.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: the inclination is none.
        Cancelled: the callback said so.
    """
    inclination = number("inclination", inclination, "degrees", positive=False)
    if inclination >= 90.0:
        raise VolfrepError(
            f"The inclination must be from 0 to below 90 degrees, not {inclination:g}."
        )
    monitor = Monitor(progress)
    with monitor.stage("directions", 0.0, 1.0):
        judge = _Judge(mesh, inclination)
        sphere = even_directions(DIRECTIONS)
        ranked = sphere[np.argsort([judge.rough(up) for up in sphere], kind="stable")]
        monitor.tick(0.2)
        fine = [judge.refined(up) for up in _distinct(ranked, REFINED)]
        monitor.tick(0.3)
        wanted = [*judge.faces(), *np.concatenate([np.eye(3), -np.eye(3)]), *fine]
        found = []
        for k, up in enumerate(wanted):
            monitor.tick(0.3 + 0.7 * k / len(wanted))
            found.append(judge.exact(up))
        found.sort(key=_rank)
        chosen: list[Orientation] = []
        for one in found:
            if all(_angle(one.up, other.up) > APART for other in chosen):
                chosen.append(one)
        tried = len(sphere) + len(wanted) + 6 * len(TILTS) * len(fine)
        return Orientations(
            mesh, inclination, tuple(chosen[:best]), judge.exact(np.array([0.0, 0.0, 1.0])), tried
        )


def inclination_of(process: str | None, inclination: float | None) -> float:
    """The least inclination that needs no support, degrees: as given, or a process's, or 45.

    Raises:
        VolfrepError: there is no such process, or both are given.
    """
    if process is not None and inclination is not None:
        raise VolfrepError("A process has its own inclination: give one of the two.")
    if process is not None:
        return find_process(process).inclination
    return 45.0 if inclination is None else inclination


class _Judge:
    """What directions of a part cost."""

    def __init__(self, mesh: TriangleMesh, inclination: float) -> None:
        # 90 degrees of inclination is a wall; 0 degrees a ceiling, which no facet falls short of.
        self.least = math.cos(math.radians(inclination))
        self.mesh = compact(mesh)
        a, b, c = self.mesh.corners()
        self.area, self.normal = self.mesh.areas(), facet_normals(self.mesh)
        self.middle = (a + b + c) / 3.0
        self.inside = _in_rooms(self.mesh)
        self.total = float(self.area.sum())
        self.hull = ConvexHull(self.mesh.vertices)
        self.corners = self.mesh.vertices[self.hull.vertices]
        self.diagonal = float(np.linalg.norm(np.ptp(self.corners, axis=0)))
        self.hull_normal = self.hull.equations[:, :3]
        facets = self.mesh.vertices[self.hull.simplices]
        across = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
        self.hull_area = 0.5 * np.linalg.norm(across, axis=1)
        self._gather()

    def _gather(self) -> None:
        """Facets with nearly one normal as one."""
        step = np.round(self.normal * STEPS).astype(np.int64) + STEPS
        key = ((step[:, 0] * 128 + step[:, 1]) * 128 + step[:, 2]) * 2 + self.inside
        found, row = np.unique(key, return_inverse=True)
        count = len(found)
        self.many = np.asarray(np.bincount(row, self.area, count), float)

        def mean(values: Floats) -> Floats:
            sums = [np.bincount(row, self.area * values[:, k], count) for k in range(3)]
            result: Floats = np.stack(sums, axis=1) / np.maximum(self.many, 1e-300)[:, None]
            return result

        self.many_normal = normalize(mean(self.normal))
        self.many_middle = mean(self.middle)
        self.many_inside = found % 2 == 1

    def _cost(
        self, up: Floats, fall: Floats, area: Floats, inside: Bools, middle: Floats
    ) -> tuple[float, float]:
        """What overhanging facets cost, with the part's height; and the supports, mm3."""
        low, high = _span(self.corners, up)
        weight = area * (0.5 + 0.5 * (fall - self.least) / max(1.0 - self.least, 1e-9))
        under = float((area * fall * (middle @ up - low))[~inside].sum())
        cost = OUTSIDE * weight[~inside].sum() / self.total
        cost += INSIDE * weight[inside].sum() / self.total
        cost += SUPPORT * under / float(self.hull.volume)
        return float(cost + HEIGHT * (high - low) / self.diagonal), under

    def rough(self, up: Floats) -> float:
        """The cost of a direction in which nothing lies on the plate."""
        fall = -(self.many_normal @ up)
        over = fall > self.least + 1e-6
        return self._cost(
            up, fall[over], self.many[over], self.many_inside[over], self.many_middle[over]
        )[0]

    def refined(self, up: Floats) -> Floats:
        """The direction near one that costs least."""
        best, cost = up, self.rough(up)
        for tilt in TILTS:
            one = np.cross(best, np.eye(3)[int(np.argmin(np.abs(best)))])
            one /= np.linalg.norm(one)
            other = np.cross(best, one)
            size = math.tan(math.radians(tilt))
            for turn in np.arange(6) * math.pi / 3:
                near = best + size * (math.cos(turn) * one + math.sin(turn) * other)
                near /= np.linalg.norm(near)
                if (found := self.rough(near)) < cost - EQUAL:
                    best, cost = near, found
        return best

    def faces(self) -> list[Floats]:
        """Directions with the largest faces of the hull on the plate."""
        order = np.argsort(-self.hull_area, kind="stable")
        found: list[Floats] = []
        area: list[float] = []
        near = math.cos(math.radians(ONE_FACE))
        for row in order[: 50 * FACES]:
            normal = self.hull_normal[row]
            hit = np.flatnonzero(np.array(found) @ normal > near) if found else np.zeros(0, int)
            if len(hit):
                area[hit[0]] += float(self.hull_area[row])
            else:
                found.append(normal)
                area.append(float(self.hull_area[row]))
        return [-found[k] for k in np.argsort(-np.array(area), kind="stable")[:FACES]]

    def exact(self, up: Floats) -> Orientation:
        """All figures of a direction."""
        up = np.where(np.abs(up) < 1e-9, 0.0, up)
        up = up / np.linalg.norm(up)
        low, high = _span(self.corners, up)
        fall, on_plate, over = _overhang(self.mesh, self.normal, up, self.least)
        rows = np.flatnonzero(over)
        inside = self.inside[rows]
        cost, under = self._cost(up, fall[rows], self.area[rows], inside, self.middle[rows])
        base = float(self.area[on_plate].sum())
        footprint = 0.5 * float((self.hull_area * np.abs(self.hull_normal @ up)).sum())
        turn, axis, angle = _turn_to_z(up)
        return Orientation(
            up=_three(up),
            rotation=tuple(_three(row) for row in turn),
            axis=_three(axis),
            angle=angle,
            overhang_mm2=float(self.area[rows].sum()),
            inside_mm2=float(self.area[rows][inside].sum()),
            support_mm3=under,
            height_mm=high - low,
            base_mm2=base,
            footprint_mm2=footprint,
            cost=EQUAL * round((cost + BASE * (1.0 - min(base / footprint, 1.0))) / EQUAL),
        )


def _overhang(
    mesh: TriangleMesh, normal: Floats, up: Floats, least: float
) -> tuple[Floats, Ints, Bools]:
    """(m,) how far facets look down, from -1 to 1; those on the plate; (m,) which hang over."""
    low, high = _span(mesh.vertices, up)
    fall = -(normal @ up)
    flat = np.flatnonzero(fall > 0.99)
    heights = mesh.vertices[mesh.triangles[flat]] @ up
    on_plate = flat[(heights < low + ON_PLATE * (high - low)).all(axis=1)]
    over = fall > least + 1e-6
    over[on_plate] = False
    return fall, on_plate, over


def _in_rooms(mesh: TriangleMesh) -> Bools:
    """(m,) the facets of shells that bound a closed room: wound about what they leave empty."""
    first, second, third = mesh.triangles.T
    count, piece = pieces_of(
        np.concatenate([first, second]), np.concatenate([second, third]), len(mesh.vertices)
    )
    own = piece[first]
    volume = np.bincount(own, mesh.signed_volumes(), count)
    return np.asarray(volume[own] < 0.0)


def _distinct(ranked: Floats, count: int) -> list[Floats]:
    """The first of directions that lie apart from each other."""
    found: list[Floats] = []
    for up in ranked:
        if all(_angle(up, other) > 2 * APART for other in found):
            found.append(up)
        if len(found) == count:
            break
    return found


def _rank(one: Orientation) -> tuple[Any, ...]:
    """What they are sorted by: cost, then height, base, how little it turns, place."""
    return (
        one.cost, round(one.height_mm, 4), -round(one.base_mm2, 3),
        round(one.angle, 3), one.up,
    )  # fmt: skip


def _span(points: Floats, up: Floats) -> tuple[float, float]:
    height = points @ up
    return float(height.min()), float(height.max())


def _angle(one: Sequence[float] | Floats, other: Sequence[float] | Floats) -> float:
    """Between unit vectors, degrees."""
    return math.degrees(math.acos(min(1.0, max(-1.0, float(np.dot(one, other))))))


def _turn_to_z(up: Floats) -> tuple[Floats, Floats, float]:
    """The least turn that takes a direction to z: (3, 3), its (3,) axis, its angle in degrees."""
    angle = math.atan2(math.hypot(up[0], up[1]), up[2])
    if math.hypot(up[0], up[1]) < 1e-9:
        axis = np.array([1.0, 0.0, 0.0])
    else:
        axis = np.array([up[1], -up[0], 0.0]) / math.hypot(up[0], up[1])
    turn = rotation(axis, angle)
    turn[np.abs(turn) < 1e-15] = 0.0
    return turn, axis, math.degrees(angle)


def _turn(one: Orientation) -> str:
    """The turn in words; nothing where it stands so."""
    if one.angle < 1e-6:
        return ""
    return f": turn by {one.angle:.4g} degrees about {place_text(one.axis)}"


def _three(vector: Floats | Ints) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return x, y, z
