# SPDX-License-Identifier: LGPL-2.1-or-later
"""What of a part hangs over when it is built, against the areas of a tilted box."""

import pytest

import samples
from volfrep import LatticeSpec
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Building
from volfrep.jobs.sizing.overhanging import building_figures, overhanging_skin
from volfrep.reports.processes import find_process
from volfrep.util.cache import StageCache
from volfrep.util.progress import Monitor


def infill(size, shell):
    spec = LatticeSpec("BCC", cell_size=10.0, strut_radius=0.5, shell=shell, resolution=6)
    return Infill(samples.box(size), spec, monitor=Monitor(), cache=StageCache())


def test_of_a_tilted_box_the_side_that_faces_down_hangs_over_and_the_top_within_its_skin():
    tilted = Building(find_process("LPBF"), (0.0, 1.0, 2.0))  # 27 and 63 degrees steep
    told = building_figures(tilted, infill((30.0, 10.0, 20.0), 1.0))
    assert told["outside"]["area_mm2"] == pytest.approx(30.0 * 10.0)
    assert told["ceilings"]["area_mm2"] == pytest.approx(28.0 * 8.0, rel=0.02)
    assert told["outside"]["middle_mm"][2] == pytest.approx(0.0)
    assert told["ceilings"]["middle_mm"][2] == pytest.approx(19.0, abs=0.05)
    outside, ceilings = overhanging_skin(told)
    assert outside.startswith(
        "LPBF builds 45 degrees and more without support, and 300 mm2 of the part's outside are "
        "flatter, as at ("
    )
    assert " mm2 of ceilings within its skin, which only struts hold, are flatter" in ceilings


def test_nothing_hangs_over_of_a_box_without_a_skin_that_stands_on_the_plate():
    told = building_figures(Building(find_process("LPBF")), infill((30.0, 10.0, 20.0), 0.0))
    assert told["outside"] == {"area_mm2": 0.0, "middle_mm": None}
    assert "ceilings" not in told
    assert overhanging_skin(told) == []
