# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether a part suits a printing process: thin struts, narrow gaps, overhangs, trapped powder.

Directions are told as inclinations: the angle to the build plate, 0 degrees for a strut or facet
that lies flat and 90 for one that stands upright along the build direction.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..design.spec import LatticeSpec
from ..grid.inclination import inclinations, inclinations_along, is_below, unit_direction
from ..grid.strut_graph import Wireframe
from ..mesh.quality import inspect
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.rays import inside_points
from ..util.numbers import place_text
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .clearance import endless_gap, narrowest_gap
from .processes import Process

#: Pieces of a strut, each of which counts as inside the part by its middle.
PIECES = 8
#: Struts below this inclination lie flat: they are bridges, which nothing grows from below.
FLAT = 15.0
#: Gaps up to so many times the limit are looked for.
LOOK_FOR = 2.0
#: Width of the classes of inclinations, degrees.
CLASS = 15
#: Facets this near to the build plate, in units of the part's height, lie on it.
ON_PLATE = 1e-4


@dataclass(frozen=True)
class PrintReport:
    """How a part suits a process.

    Attributes:
        process: its limits.
        build_direction: unit vector from the build plate up.
        struts: that lie in the part, wholly or in part.
        strut_length_mm: their length in the part.
        thinnest_strut_mm: smallest diameter in the part; None where there is no strut.
        thinnest_at: where, mm.
        thinnest_wall_mm: least thickness of walls, which every cell has; None of struts, or where
            it is not known.
        narrowest_gap_mm: smallest gap between two struts without a common node, None where it is
            more than `LOOK_FOR` times the limit; or between walls. Gaps to the skin do not count.
        narrowest_at: where, mm.
        largest_ball_mm: diameter of the largest ball that gets through the endless lattice, by the
            windows between struts that meet as well; None where the lattice is graded.
        inclinations: share of the struts' length by inclination, in classes of `CLASS` degrees.
        overhanging_share: share of the struts' length below the process's inclination, without
            what it bridges (`overhanging_struts`).
        longest_overhang_mm: length in the part of the longest strut of these.
        longest_bridge_mm: the same of the struts that lie flat.
        longest_bridge_at: the middle of that one, mm.
        overhang_area_mm2: of the downward facets below that inclination, without the build plate.
        voids: closed cavities.
        void_volume_mm3: their volume.
        area_mm2, volume_mm3, mass_g: of the whole part.
        findings: a sentence for each limit that is not kept.
    """

    process: Process
    build_direction: tuple[float, float, float]
    struts: int
    strut_length_mm: float
    thinnest_strut_mm: float | None
    thinnest_at: tuple[float, float, float] | None
    thinnest_wall_mm: float | None
    narrowest_gap_mm: float | None
    narrowest_at: tuple[float, float, float] | None
    largest_ball_mm: float | None
    inclinations: tuple[float, ...]
    overhanging_share: float
    longest_overhang_mm: float
    longest_bridge_mm: float
    longest_bridge_at: tuple[float, float, float] | None
    overhang_area_mm2: float
    voids: int
    void_volume_mm3: float
    area_mm2: float
    volume_mm3: float
    mass_g: float
    findings: tuple[str, ...]

    def as_dict(self) -> dict[str, Any]:
        """The figures as plain JSON values."""
        return asdict(self)

    def to_json(self) -> str:
        """The figures as a JSON text."""
        return json.dumps(self.as_dict(), indent=2)

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        process = self.process
        thin, gap = self.thinnest_strut_mm, self.narrowest_gap_mm
        flat = process.inclination
        rows = [
            ("process", f"{process.name}, {process.title}"),
            ("limits from", process.source),
            ("thinnest strut", _against(thin, process.strut, "none")),
            *(
                [("thinnest wall", _against(self.thinnest_wall_mm, process.wall, "none"))]
                if self.thinnest_wall_mm is not None
                else []
            ),
            ("narrowest gap", _against(gap, process.gap, f"over {LOOK_FOR * process.gap:g} mm")),
        ]
        if self.largest_ball_mm is not None:
            rows.append(("largest ball that gets out", f"{self.largest_ball_mm:.3g} mm"))
        if flat:
            overhang = f"{100 * self.overhanging_share:.1f} % of the struts' length"
            rows += [
                (f"below {flat:g} degrees", f"{overhang}, {self.overhang_area_mm2:,.1f} mm2"),
                ("longest of these", f"{self.longest_overhang_mm:.3g} mm"),
            ]
        if process.bridge is not None:
            rows.append(
                ("longest flat", _against(self.longest_bridge_mm or None, process.bridge, "none"))
            )
        classes = " ".join(f"{100 * share:.0f}" for share in self.inclinations)
        return [
            *rows,
            ("inclinations", f"{classes} % from 0 to 90 degrees, by {CLASS}"),
            ("closed voids", f"{self.voids:,}, holding {self.void_volume_mm3:,.1f} mm3"),
            ("surface", f"{self.area_mm2:,.1f} mm2"),
            ("mass", f"{self.mass_g:,.2f} g"),
            ("findings", f"{len(self.findings)}" if self.findings else "none"),
            *(("", sentence) for sentence in self.findings),
        ]

    def to_text(self) -> str:
        """The rows, one a line."""
        width = max(len(name) for name, _ in self.rows()) + 2
        return "\n".join(f"{name:<{width}}{value}" for name, value in self.rows())


@dataclass(frozen=True)
class PrintForecast:
    """What of a print report is known before anything is meshed.

    Attributes:
        thinnest_strut_mm: smallest diameter; None where there are no struts, as of walls.
        narrowest_gap_mm: between struts without a common node; None where it is above
            `clearance.WIDEST_GAP` times L, or not the same everywhere (graded lattices).
        is_gap_known: whether None means that gaps are wide.
        overhanging_share: of the struts' length, below the inclination that needs no support and
            not bridged; 0 without a process.
        longest_flat_mm: length of the longest strut that lies flat.
        void_mm3: volume of what a closed skin holds beside the lattice, which keeps its powder or
            resin; 0 where it is open.
        mass_g: of the part.
        saved_g: that the solid has more.
        saved_share: of the solid's mass.
    """

    thinnest_strut_mm: float | None
    narrowest_gap_mm: float | None
    is_gap_known: bool
    overhanging_share: float
    longest_flat_mm: float
    void_mm3: float
    mass_g: float
    saved_g: float
    saved_share: float


def print_report(
    mesh: TriangleMesh,
    lattice: Wireframe,
    process: Process,
    *,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
    density: float = 1.0,
    domain: TriangleMesh | None = None,
    ball_mm: float | None = None,
    sheet_and_gap_mm: tuple[float | None, float | None] = (None, None),
) -> PrintReport:
    """Hold a part against a process.

    Args:
        mesh: the part as it will be printed, closed, mm.
        lattice: its nodes and struts.
        process: the limits.
        build_direction: from the build plate up, of any length.
        density: of the material, g/cm3.
        domain: closed mesh of what the lattice fills; struts outside do not count. None: all do.
        ball_mm: diameter of the largest ball that gets through the lattice (`largest_ball`); None
            where it is not known.
        sheet_and_gap_mm: least thickness of walls and least gap between them (`LatticeKind.walls`).

    Raises:
        VolfrepError: the build direction is no direction.
    """
    up = unit_direction(build_direction)
    inspection = inspect(mesh)
    quality, shells = inspection.quality, inspection.volume
    ends = lattice.nodes[lattice.struts]
    pieces = (np.arange(PIECES) + 0.5) / PIECES
    points = ends[:, :1] + pieces[:, None] * (ends[:, 1:] - ends[:, :1])
    inside = np.ones(points.shape[:2], bool)
    if domain is not None:
        inside = inside_points(domain, points.reshape(-1, 3), Monitor()).reshape(inside.shape)
    share = inside.mean(axis=1)
    length = share * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    present = np.flatnonzero(share > 0)

    thinnest, thinnest_at = None, None
    if len(present):
        radius = lattice.radii[:, :1] + pieces * (lattice.radii[:, 1:] - lattice.radii[:, :1])
        radius = np.where(inside, radius, np.inf)
        strut, piece = np.unravel_index(radius.argmin(), radius.shape)
        thinnest, thinnest_at = 2.0 * float(radius[strut, piece]), _point(points[strut, piece])
    narrowest = narrowest_gap(lattice, present, LOOK_FOR * process.gap)

    gap_mm = sheet_and_gap_mm[1] if narrowest is None else narrowest[0]
    gap_at = None if narrowest is None else _point(narrowest[1])

    angle = inclinations(lattice, up)
    total = max(float(length.sum()), 1e-300)
    edges = np.arange(0, 90 + CLASS, CLASS)
    classes = np.histogram(angle, edges, weights=length)[0] / total
    overhanging = np.where(overhanging_struts(angle, length, process), length, 0.0)
    flat = np.where(angle < FLAT, length, 0.0)
    overhangs = overhanging_facets(mesh, up, process.inclination)
    report = PrintReport(
        process=process,
        build_direction=_point(up),
        struts=len(present),
        strut_length_mm=float(length.sum()),
        thinnest_strut_mm=thinnest,
        thinnest_at=thinnest_at,
        thinnest_wall_mm=sheet_and_gap_mm[0],
        narrowest_gap_mm=gap_mm,
        narrowest_at=gap_at,
        largest_ball_mm=ball_mm,
        inclinations=tuple(float(share) for share in classes),
        overhanging_share=float(overhanging.sum()) / total,
        longest_overhang_mm=float(overhanging.max(initial=0.0)),
        longest_bridge_mm=float(flat.max(initial=0.0)),
        longest_bridge_at=_point(ends[flat.argmax()].mean(axis=0)) if flat.any() else None,
        overhang_area_mm2=TriangleMesh(mesh.vertices, mesh.triangles[overhangs]).area,
        voids=quality.voids,
        void_volume_mm3=float(np.abs(shells[shells < 0]).sum()),
        area_mm2=quality.area,
        volume_mm3=quality.volume,
        mass_g=quality.volume * density / 1000.0,
        findings=(),
    )
    return PrintReport(**{**vars(report), "findings": tuple(_findings(report))})


def print_forecast(
    spec: LatticeSpec,
    struts: tuple[Floats, Floats, Floats],
    volumes: tuple[float, float],
    process: Process | None = None,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
) -> PrintForecast:
    """What is known of how a part will be printed while it is but lines, as a preview has it.

    Args:
        spec: what is to be made.
        struts: (k, 3) starts and ends of what of them lies in the part, and (k, 2) radii, mm.
        volumes: of the solid, and of the part made of it, mm3.
        process: whose inclination overhangs are told for; None for none.
        build_direction: from the build plate up, of any length.

    Raises:
        VolfrepError: the build direction is no direction.
    """
    up, (start, end, radii), (solid, part) = unit_direction(build_direction), struts, volumes
    span = end - start
    length, angle = np.linalg.norm(span, axis=1), inclinations_along(span, up)
    hangs = np.zeros(len(length), bool)
    if process is not None:
        hangs = overhanging_struts(angle, length, process)
    overhanging = float(length[hangs].sum()) / max(float(length.sum()), 1e-300)
    saved = max(abs(solid) - part, 0.0)
    cell = None if spec.varies else spec.kind.cube
    gap = None if cell is None else endless_gap(cell, spec.strut_radius / spec.cell_size)
    is_closed = spec.with_skin and not spec.open_faces and spec.drains is None
    return PrintForecast(
        thinnest_strut_mm=2.0 * float(radii.min()) if len(radii) else None,
        narrowest_gap_mm=None if gap is None else gap * spec.cell_size,
        is_gap_known=cell is not None,
        overhanging_share=overhanging,
        longest_flat_mm=float(length[angle < FLAT].max(initial=0.0)),
        void_mm3=saved if is_closed else 0.0,
        mass_g=part * spec.density / 1000.0,
        saved_g=saved * spec.density / 1000.0,
        saved_share=saved / abs(solid),
    )


def overhanging_struts(angle: Floats, length: Floats, process: Process) -> Bools:
    """(m,) the struts at a lesser inclination than a process's, without flat ones that it bridges.

    Args:
        angle: (m,) to the build plate, degrees.
        length: (m,) mm, of each strut what is to be built.
        process: its limits.
    """
    return is_below(angle, process.inclination) & ~_bridged(angle, length, process)


def _bridged(angle: Floats, length: Floats, process: Process) -> Bools:
    """(m,) the struts that lie flat and are no longer than a process bridges."""
    longest = np.inf if process.bridge is None else process.bridge + 1e-9
    return np.asarray((angle < FLAT) & (length <= longest))


def overhanging_facets(mesh: TriangleMesh, up: Floats, inclination: float) -> Bools:
    """(m,) the triangles that face down at a lesser inclination, without the build plate's."""
    a, b, c = mesh.corners()
    normal = np.cross(b - a, c - a)
    fall = -(normal @ up) / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    height = mesh.vertices @ up
    low, high = height.min(initial=np.inf), height.max(initial=-np.inf)
    on_plate = (height < low + ON_PLATE * (high - low))[mesh.triangles].all(axis=1)
    # A hair of tolerance, so that facets of just that inclination do not flicker.
    result: Bools = (fall > np.cos(np.radians(inclination)) + 1e-6) & ~on_plate
    return result


def _point(vector: Floats) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return x, y, z


def _against(value: float | None, limit: float, otherwise: str) -> str:
    return f"{otherwise if value is None else f'{value:.3g} mm'} (limit {limit:g} mm)"


def _findings(report: PrintReport) -> list[str]:
    process, found = report.process, []
    thin, gap = report.thinnest_strut_mm, report.narrowest_gap_mm
    if thin is not None and thin < process.strut - 1e-9:
        found.append(
            f"Struts are down to {thin:.3g} mm thick near {_place(report.thinnest_at)}, and "
            f"{process.name} wants {process.strut:g} mm: enlarge the radius."
        )
    if (wall := report.thinnest_wall_mm) is not None and wall < process.wall - 1e-9:
        found.append(
            f"Walls are down to {wall:.3g} mm thick in every cell, and {process.name} wants "
            f"{process.wall:g} mm: make them thicker, or enlarge the cells of a skeleton."
        )
    if gap is not None and gap < process.gap - 1e-9 and report.narrowest_at is None:
        found.append(
            f"Walls are only {gap:.3g} mm apart in every cell, and {process.name} wants "
            f"{process.gap:g} mm: they may fuse or hold powder; make them thinner, or enlarge the "
            "cells."
        )
    elif gap is not None and gap < process.gap - 1e-9:
        found.append(
            f"Struts are only {gap:.3g} mm apart near {_place(report.narrowest_at)}, and "
            f"{process.name} wants {process.gap:g} mm: they may fuse or hold powder; enlarge the "
            "cells."
        )
    if report.overhanging_share > 0:
        found.append(
            f"{100 * report.overhanging_share:.0f} % of the struts' length is less than "
            f"{process.inclination:g} degrees above the build plate: choose another build "
            "direction or cell, or count on sagging undersides."
        )
    if process.bridge is not None and report.longest_bridge_mm > process.bridge + 1e-9:
        found.append(
            f"Flat struts hang free over up to {report.longest_bridge_mm:.3g} mm near "
            f"{_place(report.longest_bridge_at)}, and {process.name} bridges {process.bridge:g} "
            "mm: make the cells smaller or choose another build direction."
        )
    if report.voids and process.escape_hole is not None:
        found.append(
            f"{report.voids:,} closed {'void holds' if report.voids == 1 else 'voids hold'} "
            f"{report.void_volume_mm3:,.0f} mm3 of unused material: open each with a hole of "
            f"{process.escape_hole:g} mm or more."
        )
    return found


def _place(point: tuple[float, float, float] | None) -> str:
    return "-" if point is None else place_text(point)
