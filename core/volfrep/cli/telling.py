# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the command prints: rows of figures, warnings."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..util.numbers import place_text

if TYPE_CHECKING:
    from ..reports.printability import PrintReport
    from ..reports.report import Report


def write_report(report: Report, path: str, printing: PrintReport | None = None) -> None:
    """Write the figures as JSON."""
    from ..util.files import write_json

    figures = report.as_dict()
    if printing is not None:
        figures["print_report"] = printing.as_dict()
    write_json(path, figures)


def print_summary(
    report: Report,
    output: str,
    printing: PrintReport | None = None,
    *,
    quiet: bool = False,
    before: float = 0.0,
) -> None:
    """Say what was made; `before` it so many seconds went by."""
    print_warnings(report.warnings)
    if quiet:
        return
    size = Path(output).stat().st_size / 1e6
    grid = " x ".join(str(n) for n in report.grid)
    seconds = before + sum(report.stages.values())
    print_rows(
        ("file", f"{output}, {size:.1f} MB"),
        ("cells", f"{report.cells_active:,} active of {report.cells_total:,} ({grid})")
        if report.cells_total
        else ("lattice", report.lattice),
        _lattice(report),
        *_sizes(report),
        ("triangles", f"{report.triangles:,}"),
        ("watertight", f"{_yes(report.watertight)}, {_bodies(report.bodies, report.voids)}"),
        ("volume", f"{report.volume_mm3:,.1f} mm3"),
        ("relative density", f"{100 * report.relative_density:.2f} %"),
        ("mass", f"{report.mass_g:,.2f} g"),
        *_target(report),
        *_removal_rows(report),
        ("time", f"{seconds:.2f} s, {_memory(report)}"),
        *(printing.rows() if printing is not None else ()),
    )


def _memory(report: Report) -> str:
    beside = f", and {report.workers_memory_mb:,.0f} MB of workers"
    told = beside if report.workers_memory_mb else ""
    return f"{report.peak_memory_mb:,.0f} MB of memory{told}"


def print_rows(*rows: tuple[str, str]) -> None:
    """Names and values in two columns."""
    width = max(len(name) for name, _ in rows) + 2
    for name, value in rows:
        print(f"{name:<{width}}{value}")


def print_warnings(warnings: Sequence[str]) -> None:
    """A line each, on standard error."""
    for warning in warnings:
        print(f"volfrep: warning: {warning}", file=sys.stderr)


def _lattice(report: Report) -> tuple[str, str]:
    """What the lattice consists of."""
    wall = report.spec.get("wall")
    if wall is None:
        return "struts", f"{report.struts:,} between {report.nodes:,} nodes"
    size = f"{wall['thickness']:g} mm thick" if "thickness" in wall else f"{wall['offset']:+g} mm"
    if report.spec["radius_grading"] is not None:
        size = "graded"
    return "walls", f"{report.spec['cell']}, {wall['kind']}, {size}"


def _target(report: Report) -> list[tuple[str, str]]:
    """What the radius was chosen for, and what was reached; nothing where it was given."""
    target = report.target
    if target is None:
        return []
    along = "along " + ",".join(f"{part:g}" for part in target.get("direction", ()))
    along = f" {along} in {target['unit']}" if "direction" in target else ""
    aim = target["aim"].replace("_", " ")
    found = next(name for name in target if name.endswith("_mm"))
    return [
        (found.removesuffix("_mm").replace("_", " "), f"{target[found]:.5g} mm"),
        ("target", f"{aim}{along}: {target['value']:.5g}, {target['reached']:.5g} reached"),
    ]


def _sizes(report: Report) -> list[tuple[str, str]]:
    """What a grading came to; nothing for a lattice that is the same everywhere."""
    gradings = ("size_grading", "radius_grading", "cell_map", "orientation")
    if all(report.spec[name] is None for name in gradings):
        return []
    of_struts = (("strut lengths", report.strut_lengths_mm), ("strut radii", report.strut_radii_mm))
    return [
        (name, f"{least:.4g} to {most:.4g} mm")
        for name, (least, most) in (
            ("cell edges", report.cell_edges_mm), *(of_struts if report.struts else ())
        )
    ]  # fmt: skip


def _removal_rows(report: Report) -> list[tuple[str, str]]:
    """What was taken away, and drain holes; nothing where there is nothing."""
    counts = (
        (report.struts_dangling_removed, "dangling struts"),
        (report.stubs_removed, "stubs"),
        (report.thin_struts_removed, "thin struts"),
        (report.flat_struts_removed, "flat struts"),
        (report.pieces_removed, "loose pieces"),
    )
    text = ", ".join(f"{count:,} {what}" for count, what in counts if count)
    result = [("removed", text)] if text else []
    if report.drain_holes:
        places = ", ".join(map(place_text, report.drain_holes))
        result.append(("drain holes", f"{len(report.drain_holes)} at {places}"))
    return result


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def _bodies(bodies: int, voids: int) -> str:
    text = f"{bodies:,} " + ("body" if bodies == 1 else "bodies")
    return text + (f", {voids:,} closed " + ("void" if voids == 1 else "voids")) * bool(voids)
