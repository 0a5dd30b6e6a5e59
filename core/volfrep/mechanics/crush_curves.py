# SPDX-License-Identifier: LGPL-2.1-or-later
"""Crush curves that were computed beforehand and ship with the package, and cells found by them.

`make crush-curves` computes what is missing (`jobs.crushing`): blocks of 3 x 3 x 3 cells at three
relative densities of a few materials.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ..util.errors import VolfrepError, listed
from ..util.types import Floats

FILE = Path(__file__).with_name("crush_curves.json")
#: Of every curve, from 0; a curve ends where its struts would touch.
STRAINS: Floats = np.arange(31) / 100.0
#: Strain from which on the plateau is averaged (ISO 13314); it ends where the curve does.
PLATEAU_FROM = 0.2


@dataclass(frozen=True)
class Cushion:
    """A lattice by how it is crushed.

    Attributes:
        cell: its name.
        relative_density: of the endless lattice.
        ratio: r / L.
        plateau: mean stress from a strain of 20 % to the curve's end, MPa.
        energy: absorbed till there, mJ/mm3.
        end: strain where the curve ends.
    """

    cell: str
    relative_density: float
    ratio: float
    plateau: float
    energy: float
    end: float


def mean_stress(strain: Floats, stress: Floats, start: float) -> float | None:
    """The mean stress of a curve from a strain to its end; None where it ends before."""
    end = float(strain[-1])
    if end <= start:
        return None
    return (work(strain, stress, end) - work(strain, stress, start)) / (end - start)


def work(strain: Floats, stress: Floats, end: float) -> float:
    """What a curve takes up to a strain, mJ/mm3 with MPa."""
    inside = strain < end
    strains = np.append(strain[inside], end)
    stresses = np.append(stress[inside], np.interp(end, strain, stress))
    return float(0.5 * (np.diff(strains) * (stresses[1:] + stresses[:-1])).sum())


@lru_cache(maxsize=1)
def known_cushions() -> dict[tuple[str, str], tuple[Cushion, ...]]:
    """The shipped lattices by cell and material, with rising density; those with a plateau."""
    found: dict[tuple[str, str], list[Cushion]] = {}
    for row in json.loads(FILE.read_text(encoding="utf-8")):
        stress = np.array(row["stress"])
        strain = STRAINS[: len(stress)]
        plateau, end = mean_stress(strain, stress, PLATEAU_FROM), float(strain[-1])
        if plateau is not None:
            one = Cushion(row["cell"], row["relative_density"], row["ratio"], plateau,
                          work(strain, stress, end), end)  # fmt: skip
            found.setdefault((row["cell"], row["material"]), []).append(one)
    return {
        key: tuple(sorted(rows, key=lambda one: one.relative_density))
        for key, rows in found.items()
    }


def find_cushions(plateau: float, material: str) -> list[Cushion]:
    """The cells whose plateau is a stress at some density, those that absorb most first.

    Between the shipped densities by power laws; none beyond them.

    Args:
        plateau: MPa.
        material: by name, of those whose curves ship.

    Raises:
        VolfrepError: no curves of the material ship.
    """
    known = known_cushions()
    names = sorted({of for _, of in known})
    asked = {name.lower(): name for name in names}.get(material.lower())
    if asked is None:
        raise VolfrepError(
            f"No crush curves of {material} ship: choose {listed(names)}, "
            "or compute one by 'volfrep crush'."
        )
    found = []
    for (cell, of), rows in known.items():
        stresses = np.log([one.plateau for one in rows])
        if of != asked or not stresses[0] <= np.log(plateau) <= stresses[-1]:
            continue
        density, ratio, energy = (
            float(np.exp(np.interp(np.log(plateau), stresses, np.log(values))))
            for values in (
                [one.relative_density for one in rows],
                [one.ratio for one in rows],
                [one.energy for one in rows],
            )
        )
        end = float(np.interp(np.log(plateau), stresses, [one.end for one in rows]))
        found.append(Cushion(cell, density, ratio, plateau, energy, end))
    return sorted(found, key=lambda one: -one.energy)
