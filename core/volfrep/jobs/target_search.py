# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thickness of a target: volumes that are wanted, and meshes made until one has them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeVar

from ..design.spec import LatticeSpec
from ..design.target import Target
from ..reports.report import Report
from ..util.search import make_until_met

#: A mesh that misses its target by more, relative, is made again; so many are made at most.
CLOSE = 3e-3
MESHES = 3
#: A joint sphere's radius over the strut's is less: points farther away are never solid.
REACH = 1.5


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


class TargetSearch(Protocol):
    """Thicknesses of volumes, of a lattice whose nodes and cells are known."""

    @property
    def wanted(self) -> WantedVolume:
        """The volume of the target."""
        ...

    def specification(self, volume: float) -> LatticeSpec:
        """With the thickness for which the lattice has a volume in mm3, as far as is known."""
        ...


Made = TypeVar("Made")


def make_with_volume(
    make: Callable[[float], Made], measure: Callable[[Made], Report] | None, wanted: WantedVolume
) -> Made:
    """What has the wanted volume when it is measured, or the last of what was made.

    Args:
        make: makes what has a volume of the lattice, mm3, as far as is known before.
        measure: meshes it and reports; None: the first one is taken.
        wanted: the volume.
    """
    if measure is None:
        return make(wanted.lattice)
    report_of, enough = measure, CLOSE * wanted.scale

    def missing(made: Made) -> float:
        return wanted.missing(report_of(made))

    return make_until_met(make, missing, wanted.lattice, enough=enough, times=MESHES - 1)
