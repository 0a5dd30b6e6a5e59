# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts sized as they come out of a printer: four bars that are pulled, by hand."""

import numpy as np
import pytest

import samples
import volfrep
from volfrep.design.as_printed import find_printed_table
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, Printing
from volfrep.jobs.sizing.part_model import part_model
from volfrep.loads.load_file import load_cases_of
from volfrep.sizing.analysis import Limits, analyse
from volfrep.util.cache import StageCache

FORCE, LENGTH, RADIUS, YOUNG = 400.0, 40.0, 0.5, 110_000.0
#: A row of cells whose struts along x carry a quarter each, and those across nothing.
ROW = {"cell": "Box", "cell_size": 10, "strut_radius": RADIUS, "shell": 0, "boundary": "whole",
       "resolution": 8}  # fmt: skip
BOX = samples.box((LENGTH, 10.0, 10.0))
#: Added to a diameter by the published table: at 0, 45 and 90 degrees; and its scatter at 45.
FLAT, SLANTED, UPRIGHT, SCATTER = 0.036, 0.080, 0.036, 0.037


def pulled():
    ends = ({"plane": {"point": [x, 0, 0], "normal": [1, 0, 0]}} for x in (0, LENGTH))
    held, loaded = ends
    return {
        "material": "Ti-6Al-4V",
        "support": [{**held, "fixed": True}],
        "case": [{"load": [{**loaded, "force": [FORCE, 0, 0]}]}],
    }


def solved(printing=None, radius=RADIUS):
    infill = Infill(BOX, LatticeSpec(**{**ROW, "strut_radius": radius}))
    goal = Goal(thinnest=0.3, thickest=0.8, printing=printing)
    problem = part_model(infill, load_cases_of(pulled(), BOX), goal, StageCache()).problem
    return problem, np.full(len(problem.low), radius)


def stress_of(diameter):
    return FORCE / 4.0 / (np.pi / 4.0 * diameter**2)


@pytest.mark.parametrize(
    ("up", "added"), [((0, 0, 1), FLAT), ((1, 0, 1), SLANTED), ((1, 0, 0), UPRIGHT)]
)
def test_stress_is_force_over_the_section_that_comes_out(up, added):
    problem, radii = solved(Printing(find_printed_table("LPBF-Ti64"), up))
    found = analyse(problem, radii, Limits())[0]
    assert found.stress.max() == pytest.approx(stress_of(2 * RADIUS + added), rel=1e-3)
    drawn = analyse(*solved(), Limits())[0]
    assert drawn.stress.max() == pytest.approx(stress_of(2 * RADIUS), rel=1e-3)
    stretch = stress_of(2 * RADIUS + added) * LENGTH / YOUNG
    assert found.largest[0] == pytest.approx(stretch, rel=0.04)  # joints are not quite as bars


def test_a_thicker_lattice_is_stiff_and_heavy_as_one_that_is_drawn_so():
    problem, radii = solved(Printing(find_printed_table("LPBF-316L")))
    found = analyse(problem, radii, Limits())[0]
    other, thicker = solved(radius=RADIUS + 0.0227 / 2)
    drawn = analyse(other, thicker, Limits())[0]
    assert found.compliance == pytest.approx(drawn.compliance, rel=1e-6)
    assert found.volume == pytest.approx(drawn.volume, rel=1e-3)
    assert (found.radii == RADIUS).all()


def test_the_lower_radius_governs_strength_and_not_stiffness():
    table = find_printed_table("LPBF-Ti64")
    mean, low = (
        analyse(*solved(Printing(table, (1, 0, 1), times)), Limits())[0] for times in (0.0, 2.0)
    )
    diameter = 2 * RADIUS + SLANTED - 2 * SCATTER
    assert low.stress.max() == pytest.approx(stress_of(diameter), rel=1e-3)
    assert low.compliance == pytest.approx(mean.compliance, rel=1e-12)
    assert low.volume == mean.volume


def test_derivatives_are_those_to_the_radii_that_are_drawn():
    problem, radii = solved(Printing(find_printed_table("SLS-PA12")))
    limits = Limits(displacement=0.1)
    changes = analyse(problem, radii, limits, with_changes=True)[1]
    step = np.zeros(len(radii))
    row = int(np.argmin(changes.compliance[:, 0]))
    step[row] = 1e-4
    ahead, behind = (analyse(problem, radii + s * step, limits)[0] for s in (1, -1))
    for name, told in (("compliance", changes.compliance[row, 0]),
                       ("volume", problem.radii.volume_change(radii)[row])):  # fmt: skip
        change = np.ravel(getattr(ahead, name) - getattr(behind, name))[0] / 2e-4
        assert told == pytest.approx(change, rel=2e-3)


def test_a_row_is_drawn_so_that_what_comes_out_holds_the_stress():
    """At 300 MPa four bars need a section of F / 4 / 300 each."""
    made = volfrep.size(
        BOX, pulled(), **ROW, max_stress=300, thinnest=0.2, proof=False, as_printed="lpbf-ti64",
        build_direction=(1, 0, 1), steps=12,
    )  # fmt: skip
    needed = np.sqrt(FORCE / 4.0 / 300.0 / np.pi)
    assert made.sized.radii.max() == pytest.approx(needed - SLANTED / 2, rel=5e-3)
    assert made.struts.radii.max() == pytest.approx(made.sized.radii.max(), rel=1e-6)
    told = made.sized.report["as_printed"]
    assert told["diameters_mm"][1] == pytest.approx(2 * needed, rel=5e-3)
    assert told["drawn_strut_mass_g"] < made.sized.report["strut_mass_g"]
    assert any("struts as printed" in note for note in made.sized.report["notes"])


@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        ({"scatter": 2}, "name it by 'as_printed'"),
        ({"as_printed": "SLS-PA12", "scatter": 1}, "does not say how far diameters scatter"),
        ({"as_printed": "LPBF-316L", "scatter": 50}, "may not come out at all"),
        ({"as_printed": "LPBF-316L", "prove": "file"}, "leave out the proof by the file"),
        ({"as_printed": "LPBF-316L", "scatter": -1}, "must be 0 or more"),
    ],
)
def test_what_cannot_be_is_refused(wanted, said):
    with pytest.raises(volfrep.VolfrepError, match=said):
        volfrep.size(BOX, pulled(), **ROW, safety=2, **wanted)


def test_ones_own_measurements_tell_their_scatter(tmp_path):
    path = tmp_path / "mine.csv"
    path.write_text("inclination,nominal,measured\n0,1,1.02\n0,1,1.06\n90,1,1.1\n")
    scatter = find_printed_table(path).at(np.array([0.0, 90.0]))[2]
    assert scatter == pytest.approx([np.std([1.02, 1.06], ddof=1), 0.0])
