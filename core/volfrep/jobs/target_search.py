# SPDX-License-Identifier: LGPL-2.1-or-later
"""The thickness of a target: volumes that are wanted, and meshes made until one has them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeVar

from ..design.spec import LatticeSpec
from ..design.target import Target
from ..reports.report import Report

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
