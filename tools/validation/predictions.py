# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the engine says of each specimen and of each benchmark: nothing here is fitted to a test."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

import volfrep
from volfrep.design.cells import LIBRARY, UnitCell
from volfrep.fem.model import Case
from volfrep.jobs import crushing
from volfrep.mechanics.catalogue import catalogue, joint_law
from volfrep.mechanics.frame import CIRCLE, frame_tensor
from volfrep.mechanics.joint_fit import periodic_frame
from volfrep.mechanics.materials import find_material
from volfrep.mechanics.tensor import moduli
from volfrep.sizing.structure import Structure
from volfrep.sizing.strut_results import stresses
from volfrep.sizing.tapered_beams import Elastic, beams_of, end_table
from volfrep.util.reading import read_toml

FILE = Path(__file__).with_name("specimens.toml")
#: Voxels along L of TPMS: within 2 % of the finest in a fiftieth of the time.
ALONG = 40
#: Strain that energies are told to.
STRAIN = 0.5
#: Cells along the edges of blocks that are crushed: with three BCC's plateau is 1 % lower, with
#: four 8 %.
BLOCK = 2


def specimens() -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """The specimens, and the series whose growth with density is known."""
    data = read_toml(FILE, "table of specimens")
    return data["specimen"], data["growth"]


def predict(specimen: dict[str, Any], diameter: float | None) -> dict[str, float]:
    """Modulus, first yield and plateau, MPa, energy to `STRAIN`, J/g, density of a specimen.

    Plateau (from a strain of 20 to 30 %) and energy are of a block of cells that is crushed, where
    they were measured; "unhardened" is the plateau of metal or plastic that only yields.

    Args:
        specimen: a row of the table.
        diameter: of its struts, mm; None where its density says all.
    """
    if specimen["cell"] == "tube":
        assert diameter is not None
        return _tube(diameter, specimen["solid_young"], specimen["solid_yield"])
    solid = find_material(specimen["material"])
    more: dict[str, Any] = {}
    size: dict[str, Any]
    if "density" in specimen:
        if "kind" in specimen:
            more = {"wall_kind": specimen["kind"], "along": ALONG}
            more |= {"wall_formula": specimen["formula"]} if "formula" in specimen else {}
        cell, size = specimen["cell"], {"cell_size": 10.0, "relative_density": specimen["density"]}
    else:
        assert diameter is not None
        cell = octagons() if specimen["cell"] == "octagons" else specimen["cell"]
        size = {"cell_size": specimen["cell_size"], "strut_radius": diameter / 2.0}
    found = volfrep.properties(cell, **size, **more)
    limit = solid.yield_stress or math.nan
    density = found.relative_density
    result = {
        "young": solid.young * found.values["E100"],
        "strength": limit * found.values["strength"],
        "density": density,
    }
    if "plateau" in specimen or "energy" in specimen:
        curve = volfrep.crush(cell, **size, material=solid, count=BLOCK)
        result["plateau"] = curve.plateau or math.nan
        # From where the curve ends its last stress is held.
        end = float(curve.strain[-1])
        energy = curve.energy_to(end) + (STRAIN - end) * float(curve.stress[-1])
        result["energy"] = energy / (density * solid.density)
    if "plateau" in specimen:
        with patch.object(crushing, "HARDENING", 0.0):
            curve = volfrep.crush(cell, **size, material=solid, count=BLOCK)
        result["unhardened"] = curve.plateau or math.nan
    return result


def octagons(side: float = 0.414) -> UnitCell:
    """Three octagons that cross, one in each mid-plane, whose flat sides meet the faces."""
    places: list[tuple[float, ...]] = []
    struts: list[tuple[int, int]] = []

    def node(point: Any) -> int:
        key = tuple(np.round(point, 9).tolist())
        if key not in places:
            places.append(key)
        return places.index(key)

    half = 0.5 * side
    flat = [(1, 0), (1, half), (half, 1), (0, 1), (-half, 1), (-1, half),
            (-1, 0), (-1, -half), (-half, -1), (0, -1), (half, -1), (1, -half)]  # fmt: skip
    for one, other in ((0, 1), (0, 2), (1, 2)):
        ring = []
        for u, v in flat:
            point = np.full(3, 0.5)
            point[one] += 0.5 * u if abs(u) == 1 else u
            point[other] += 0.5 * v if abs(v) == 1 else v
            ring.append(node(point))
        for k, begin in enumerate(ring):
            struts.append((begin, ring[(k + 1) % len(ring)]))
    return UnitCell("Octagons", np.array(places), np.array(struts))


def tube(levels: int = 6, around: int = 12) -> tuple[Any, Any]:
    """Nodes, mm, and struts of the F-BCC tube: diagonals, edges along the axis and around."""
    places: list[Any] = []
    number: dict[tuple[int, ...], int] = {}
    struts = set()

    def corner(a: int, side: int, level: int) -> int:
        key = (a % around, side, level)
        if key not in number:
            turn = 2.0 * np.pi * key[0] / around
            radius = (9.0, 15.0)[side]
            number[key] = len(places)
            places.append((radius * np.cos(turn), radius * np.sin(turn), 6.0 * level))
        return number[key]

    for a in range(around):
        for level in range(levels + 1):
            for side in (0, 1):
                struts.add((corner(a, side, level), corner(a + 1, side, level)))
                if level < levels:
                    struts.add((corner(a, side, level), corner(a, side, level + 1)))
            if level < levels:
                eight = [
                    corner(a + x, side, level + z)
                    for x in (0, 1)
                    for side in (0, 1)
                    for z in (0, 1)
                ]
                places.append(np.mean([places[k] for k in eight], axis=0))
                struts |= {(len(places) - 1, k) for k in eight}
    return np.array(places, float), np.array(sorted(struts), np.int64)


def _tube(diameter: float, young: float, limit: float) -> dict[str, float]:
    """The tube as beams between plates that hold its ends."""
    nodes, struts = tube()
    radius, height = 0.5 * diameter, float(nodes[:, 2].max())
    law = end_table(joint_law(LIBRARY["BCC"], 6.0, "circle"), 0.99 * radius, 1.01 * radius)
    beams = beams_of(nodes, struts, Elastic(young, 0.3, 7.7e-9), section=CIRCLE, ends=law)
    frame = Structure(nodes, beams)
    held = np.zeros((len(nodes), 6), bool)
    top = nodes[:, 2] > height - 1e-6
    held[top | (nodes[:, 2] < 1e-6)] = True
    moved = np.zeros((len(nodes), 6))
    strain = 1e-3
    moved[top, 2] = -strain * height
    radii = np.full((len(struts), 2), radius)
    found, _ = frame.displacements(radii, [Case(held, np.zeros_like(moved), moved)])
    forces = frame.forces(radii, found)
    # Along z: what struts pull and push at the plate above.
    ends = top[struts].sum(axis=1) == 1
    sign = np.where(top[struts[:, 1]], -1.0, 1.0)
    along = np.einsum("mi,mi->m", forces[:, :3, 0], beams.axes[:, :, 2])
    force = float((sign * along)[ends].sum())
    area = np.pi * ((15.0 + radius) ** 2 - (9.0 - radius) ** 2)
    mises = float(stresses(beams, radii, forces).mises.max())
    return {
        "young": force / area / strain,
        "strength": force / area * limit / mises,
        "density": float(beams.length.sum() * np.pi * radius**2 / (area * (height + diameter))),
    }


def growth(cell: str, densities: list[float]) -> float:
    """How many times as stiff along an edge the second density is, as a frame of slender beams."""
    frame = periodic_frame(LIBRARY[cell])
    length = np.linalg.norm(frame.end - frame.start, axis=1).sum()
    young = [
        moduli(frame_tensor(frame, math.sqrt(density * frame.volume / (np.pi * length)))).E100
        for density in densities
    ]
    return float(young[1] / young[0])


@dataclass(frozen=True)
class Benchmark:
    """A problem whose answer is known.

    Attributes:
        name: what it is.
        source: whose answer.
        expected, found: the answer, and ours.
        within: by how much they may differ, relative.
    """

    name: str
    source: str
    expected: float
    found: float
    within: float

    @property
    def error(self) -> float:
        """Relative."""
        return self.found / self.expected - 1.0


def benchmarks() -> list[Benchmark]:
    """Closed forms of trusses, frames and slender lattices."""
    result = [_tripod(), _portal()]
    for name, about in (("Octet", "stretching"), ("CVC", "bending"), ("Box", "stretching")):
        known = catalogue()[name]
        ratio = float(known.ratios[0])
        bulk = moduli(known.tensor(ratio)).bulk / known.at(ratio)["relative_density"]
        result.append(
            Benchmark(
                f"bulk modulus over density of slender {name} ({about})",
                "1/9: every strut carries its part",
                1.0 / 9.0, bulk, 0.15,
            )
        )  # fmt: skip
    octet = catalogue()["Octet"].at(float(catalogue()["Octet"].ratios[0]))
    result.append(
        Benchmark(
            "first yield of slender Octet along an edge, over density",
            "1/3 at collapse (Deshpande, Fleck, Ashby, JMPS 49, 2001): yield comes before",
            1.0 / 3.0, octet["strength"] / octet["relative_density"], 0.35,
        )
    )  # fmt: skip
    return result


def _solved(nodes: Any, struts: Any, radius: float, held: Any, loads: Any) -> Any:
    beams = beams_of(nodes, struts, Elastic(210_000.0, 0.3, 7.8e-9), section=CIRCLE)
    frame = Structure(nodes, beams)
    return frame.displacements(np.full((len(struts), 2), radius), [Case(held, loads)])[0][:, :, 0]


def _tripod() -> Benchmark:
    """Three slender struts under a force at their top."""
    turn = 2.0 * np.pi * np.arange(3) / 3.0
    feet = np.stack([60.0 * np.cos(turn), 60.0 * np.sin(turn), np.zeros(3)], axis=1)
    nodes = np.vstack([feet, [[0.0, 0.0, 80.0]]])
    held, loads = np.zeros((4, 6), bool), np.zeros((4, 6))
    held[:3], loads[3, 2] = True, -100.0
    found = -_solved(nodes, np.array([[0, 3], [1, 3], [2, 3]]), 0.5, held, loads)[3, 2]
    expected = 100.0 * 100.0 / (3.0 * 210_000.0 * np.pi * 0.25 * 0.8**2)
    return Benchmark("tripod: how far its top sinks", "pinned bars", expected, float(found), 1e-3)


def _portal() -> Benchmark:
    """A portal of equal slender members, clamped, pushed sideways: k = 12 E I / h3 * 2 * 7 / 10."""
    side, radius = 100.0, 0.5
    nodes = np.array([[0, 0, 0], [0, 0, side], [side, 0, side], [side, 0, 0]], float)
    held, loads = np.zeros((4, 6), bool), np.zeros((4, 6))
    held[[0, 3]] = True
    held[:, [1, 3, 5]] = True
    loads[[1, 2], 0] = 0.5
    found = _solved(nodes, np.array([[0, 1], [1, 2], [2, 3]]), radius, held, loads)[1, 0]
    stiff = 210_000.0 * np.pi * radius**4 / 4.0 / side**3
    expected = 1.0 / (24.0 * stiff * 7.0 / 10.0)
    return Benchmark(
        "portal frame: how far it sways", "slope deflection", expected, float(found), 5e-3
    )
