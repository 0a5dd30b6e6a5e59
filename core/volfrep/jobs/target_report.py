# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a mesh lacks of its target, and what a report says of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

from ..design.spec import LatticeSpec
from ..design.target import Target
from ..reports.report import Report, with_warnings

#: A mesh that misses its target by more, relative, is made again; so many are made at most.
CLOSE = 3e-3
MESHES = 3
#: A joint sphere's radius over the strut's is less: points farther away are never solid.
REACH = 1.5
#: What is promised: a part that misses its target by more, relative, says so.
PROMISED = 5e-3


@dataclass(frozen=True)
class WantedVolume:
    """What a target of relative density or mass asks of the solid.

    Attributes:
        target: the density or the mass.
        density: of the material, g/cm3.
        domain: volume of the room for the lattice, mm3.
        skin: volume of the skin, mm3.
    """

    target: Target
    density: float
    domain: float
    skin: float = 0.0

    @property
    def scale(self) -> float:
        """The volume that errors are relative to, mm3: with the skin where a mass is wanted."""
        return self.target.lattice_volume(self.density, self.domain, 0.0)

    @property
    def lattice(self) -> float:
        """The volume of the lattice, mm3."""
        return self.target.lattice_volume(self.density, self.domain, self.skin)

    def missing(self, report: Report) -> float:
        """The volume that a mesh lacks, mm3."""
        if self.target.aim == "mass":
            return self.scale - report.volume_mm3
        return (self.target.value - report.relative_density) * self.domain


Made = TypeVar("Made")


def make_until_met(
    make: Callable[[float], Made], measure: Callable[[Made], Report] | None, wanted: WantedVolume
) -> Made:
    """What has the wanted volume when it is measured, or the last of what was made.

    Args:
        make: makes what has a volume of the lattice, mm3, as far as is known before.
        measure: meshes it and reports; None: the first one is taken.
        wanted: the volume.
    """
    volume = wanted.lattice
    made = make(volume)
    for _ in range(MESHES - 1):
        if measure is None:
            break
        missing = wanted.missing(measure(made))
        if abs(missing) <= CLOSE * wanted.scale:
            break
        # Of a mesh with more than twice what was foreseen so much less would be next to nothing.
        less = wanted.lattice / max(wanted.lattice - missing, 1e-300)
        volume = volume + missing if volume + missing > 0.5 * volume else volume * less
        made = make(volume)
    return made


def report_target(report: Report, spec: LatticeSpec) -> Report:
    """A report that says, in `target`, what was aimed at, what was reached, and by what radius."""
    target = spec.target
    if target is None:
        return report
    size = spec.cell_size
    if target.aim == "stiffness":
        if spec.surface is not None:
            from .tpms.stiffness import tpms_modulus  # slow to load, and every block loads this

            reached = tpms_modulus(spec, target)
        else:
            from .stiffness_target import modulus

            ratio, fillet = spec.strut_radius / size, spec.fillet / size
            reached = modulus(spec.unit_cell(), ratio, target, fillet)
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
    return with_warnings(replace(report, target=figures), notes)
