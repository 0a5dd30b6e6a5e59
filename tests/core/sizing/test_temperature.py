# SPDX-License-Identifier: LGPL-2.1-or-later
"""An even temperature: stress where supports hold the part, none where they let it grow."""

import numpy as np
import pytest

import samples
import volfrep
from volfrep import LatticeSpec
from volfrep.fem.calculix import find_calculix
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal
from volfrep.jobs.sizing.part_model import part_model
from volfrep.loads.load_file import load_cases_of
from volfrep.sizing.analysis import Limits, analyse
from volfrep.util.cache import StageCache
from volfrep.util.errors import VolfrepError
from volfrep.util.progress import Monitor

YOUNG, EXPANSION, DEGREES = 100_000.0, 1e-5, 150.0
SIZE = (40.0, 20.0, 10.0)


def plane(axis, value):
    point, normal = [0.0] * 3, [0.0] * 3
    point[axis], normal[axis] = value, 1.0
    return {"plane": {"point": point, "normal": normal}}


def entries(*, both_ends, degrees=DEGREES):
    """Held along x at one end or both, and free to grow across."""
    ends = [0.0, SIZE[0]] if both_ends else [0.0]
    supports = [{**plane(0, end), "x": 0} for end in ends]
    supports += [{**plane(1, 0.0), "y": 0}, {**plane(2, 0.0), "z": 0}]
    return {
        "material": {"name": "test", "density": 4.0, "young": YOUNG, "poisson": 0.3},
        "expansion": EXPANSION,
        "support": supports,
        "case": [{"name": "hot", "temperature": degrees}],
    }


@pytest.mark.parametrize("both_ends", [True, False], ids=["held", "free"])
def test_a_solid_is_pressed_by_what_it_may_not_grow(both_ends):
    """E times the strain, and nothing where one end is free."""
    solved = volfrep.solve(samples.box(SIZE), entries(both_ends=both_ends), voxel=2.5)
    (case,) = solved.report["cases"]
    expected = YOUNG * EXPANSION * DEGREES if both_ends else 0.0
    assert case["stress_mpa"]["outside"] == pytest.approx(expected, rel=1e-3, abs=1e-3)


@pytest.mark.costly_cases("free")
@pytest.mark.parametrize("both_ends", [True, False], ids=["held", "free"])
def test_a_skin_is_pressed_by_what_it_may_not_grow(both_ends):
    loads = load_cases_of(entries(both_ends=both_ends))
    spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.3, shell=1.0)
    infill = Infill(samples.box(SIZE), spec, monitor=Monitor(), cache=StageCache())
    problem = part_model(infill, loads, Goal(thinnest=0.2), StageCache()).problem
    found = analyse(problem, np.full(len(problem.low), 0.3), Limits())[0]
    skin = problem.around
    felt = skin.stresses(found.displacements[problem.skin_first :])[:, 0]
    along = np.abs(skin.shells.axes[:, 2, 0]) < 0.5
    mean = np.average(felt[along], weights=skin.shells.area[along])
    expected = YOUNG * EXPANSION * DEGREES
    if both_ends:
        assert mean == pytest.approx(expected, rel=0.06)  # bent a little beside the ends
    else:
        assert felt.max() < 1e-3 * expected


@pytest.mark.costly
@pytest.mark.skipif(find_calculix() is None, reason="CalculiX is not installed")
def test_struts_are_sized_for_it_and_calculix_agrees():
    given = entries(both_ends=True)
    given["material"] = "Ti-6Al-4V"
    made = volfrep.size(
        samples.box(SIZE), given, cell="CVC", cell_size=10, strut_radius=0.5, shell=0,
        boundary="whole", max_stress=150, thickest=1.5, steps=6, resolution=8,
    ).sized  # fmt: skip
    assert made.report["uses"]["stress"] <= 1.001
    assert made.report["calculix"]["largest_stress"] == pytest.approx(1.0, abs=0.05)
    assert made.report["same_mass"]["stiffer"] == []
    assert "same mass" not in dict(made.rows())
    assert any("beside free expansion" in note for note in made.report["notes"])


def test_what_is_missing_is_said():
    given = entries(both_ends=True)
    del given["expansion"]
    with pytest.raises(VolfrepError, match="needs the material's expansion"):
        load_cases_of(given)
    with pytest.raises(VolfrepError, match="makes no sense"):
        load_cases_of(entries(both_ends=True, degrees=1e6))
    with pytest.raises(VolfrepError, match="leave out the limit of displacement"):
        volfrep.size(
            samples.box(SIZE),
            entries(both_ends=True),
            cell="CVC",
            cell_size=10,
            shell=1,
            max_displacement=0.1,
        )
