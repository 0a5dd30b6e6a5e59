# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report says of its target."""

from __future__ import annotations

from dataclasses import replace

from ..design.spec import LatticeSpec
from ..reports.report import Report, told
from .stiffness_target import modulus

#: What is promised: a part that misses its target by more, relative, says so.
PROMISED = 5e-3


def judged(report: Report, spec: LatticeSpec) -> Report:
    """A report that says, in `target`, what was aimed at, what was reached, and by what radius."""
    target = spec.target
    if target is None:
        return report
    size = spec.cell_size
    if target.aim == "stiffness":
        reached = modulus(spec.unit_cell(), spec.strut_radius / size, target, spec.fillet / size)
    else:
        reached = report.mass_g if target.aim == "mass" else report.relative_density
    found = {"strut_radius_mm": spec.strut_radius}
    if spec.surface is not None:
        found = {"wall_offset_mm": spec.wall.offset}
        if spec.wall.is_sheet:
            found = {"wall_thickness_mm": spec.wall.thickness}
    figures = {**target.as_plain(), "reached": reached, **found}
    off = reached / target.value - 1.0
    notes: tuple[str, ...] = ()
    if abs(off) > PROMISED:
        notes = (
            f"The target, a {target.called} of {target.value:.5g}, is missed by {off:+.2%}: "
            f"{reached:.5g} came out.",
        )
    return told(replace(report, target=figures), notes)
