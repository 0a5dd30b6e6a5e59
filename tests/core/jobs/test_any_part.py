# SPDX-License-Identifier: LGPL-2.1-or-later
"""Real and modelled parts under random parameters: one closed surface each, as a reader sees it."""

from functools import cache

import numpy as np
import pytest

import samples
from bench import parts
from bench.parts import NO_PARTS, PARTS
from contract import check_contract
from volfrep import LatticeSpec, StageCache, read_solid
from volfrep.design.cells import PAPERS, find_cell
from volfrep.design.openings import DrainHoles, OpenPlane

REAL = (
    "ge_bracket.stl",
    "piston_rod.stl",
    "odri_lower_leg_v2.STL",
    "conrod_slevin48.stl",
    "trimesh_angle_block.STL",
)
MODELLED = {
    "box": samples.box,
    "sphere": samples.sphere,
    "plate": samples.plate,
    "bracket": lambda: samples.bracket(17.0),
    "wing": lambda: samples.naca2412(100.0, 60.0, 60),
    "ribbed_housing": parts.ribbed_housing,
    "imported_flange": parts.imported_flange,
    "three_bodies": parts.three_bodies,
}
EACH = 50
#: Cells are made larger than asked for where a part would hold more of them than this.
MOST_CELLS = 600.0
#: What a refusal tells to do; one that says none of it is a fault.
REFUSALS = ("reduce", "enlarge", "at least", "smaller diameter")


@cache
def solid_of(name):
    if name in MODELLED:
        return MODELLED[name](), StageCache()
    if not (PARTS / name).is_file():
        pytest.skip(NO_PARTS)
    return read_solid(PARTS / name), StageCache()


def largest_plane(solid):
    """The plane of the solid's largest facet."""
    a, b, c = solid.corners()
    normal = np.cross(b - a, c - a)
    k = int(np.linalg.norm(normal, axis=1).argmax())
    return OpenPlane(tuple(a[k]), tuple(normal[k] / np.linalg.norm(normal[k])))


def random_spec(solid, name, number):
    random = np.random.default_rng([sum(name.encode()), number])
    size = np.sort(np.ptp(solid.bounds, axis=0))
    cell_size = random.uniform(0.15, 0.5) * size[1]
    cell_size = float(max(cell_size, (solid.volume / MOST_CELLS) ** (1.0 / 3.0)))
    # The same skin for some in turn, whose wall is then found once.
    shell = float((0.0, 0.04, 0.08, 0.15)[number * 4 // EACH] * size[0])
    output = str(random.choice(["part", "part", "lattice"]))
    openings = {}
    if shell > 0.0 and random.random() < 0.15:
        openings["open_faces"] = (largest_plane(solid),)
    if shell > 0.0 and output == "part" and random.random() < 0.25:
        openings["drains"] = DrainHoles(0.4 * shell + 0.02 * size[0], count=1)
    return LatticeSpec(
        cell=random.choice([*map(find_cell, PAPERS), samples.SKEW]),
        cell_size=cell_size,
        strut_radius=cell_size * float(random.uniform(0.05, 0.18)),
        shell=shell,
        resolution=int(random.integers(8, 14)),
        activation=str(random.choice(["touching", "touching", "centre", "inside"])),
        boundary=str(random.choice(["trim", "trim", "whole"])),
        remove_dangling=bool(random.random() < 0.2),
        shortest_stub=0.2 * cell_size * float(random.random() < 0.2),
        output=output,
        fillet=0.03 * cell_size * float(random.random() < 0.2),
        origin=None if random.random() < 0.5 else tuple(random.uniform(-1, 1, 3) * cell_size),
        **openings,
    )


QUICK = {(name, number) for name in MODELLED for number in (15, 30)} - {
    ("ribbed_housing", 15), ("imported_flange", 15),
}  # fmt: skip


@pytest.mark.costly
@pytest.mark.slow_but("box-15")
@pytest.mark.parametrize(
    ("name", "number"),
    [
        pytest.param(name, number, marks=() if (name, number) in QUICK else pytest.mark.slow)
        for name in (*MODELLED, *REAL)
        for number in range(EACH)
    ],
)
def test_random_parameters_hold_the_contract(name, number):
    solid, stages = solid_of(name)
    check_contract(solid, random_spec(solid, name, number), REFUSALS, stages)
