# SPDX-License-Identifier: LGPL-2.1-or-later
"""How thin walls are, how near to each other, and what the print check says of it."""

from __future__ import annotations

import numpy as np
import pytest

import volfrep
from volfrep.design.grading import CellMap
from volfrep.design.spec import LatticeSpec
from volfrep.design.tpms import PeriodicSurface, TpmsSheet
from volfrep.jobs.kinds import lattice_kind
from volfrep.tpms.solid import TpmsSolid
from volfrep.tpms.widths import measure_widths

#: Flat walls half a cell apart: what is between them is known.
PLANES = PeriodicSurface("Formula", "sin(x)", "")


def test_flat_walls_are_as_thick_and_as_far_apart_as_they_are_made() -> None:
    found = measure_widths(TpmsSolid.of(PLANES, TpmsSheet("sheet", 1.2), 10.0))
    assert found.thickness == pytest.approx(0.12, rel=1e-6)
    assert found.gap == pytest.approx(0.38, rel=0.01)


@pytest.mark.slow
def test_a_skeletons_neck_is_the_ball_that_just_fits_through_it() -> None:
    # In the plane x = 0 the Schwarz P is cos y + cos z = -1 about (pi, pi): nearest to that along
    # the diagonal, at 2 pi / 3.
    neck = 2.0 * (np.pi / 3.0) * 2.0**0.5 / (2.0 * np.pi)
    spec = LatticeSpec("Schwarz P", 10.0, shell=0.0, wall=TpmsSheet("skeleton"))
    thickness, gap = lattice_kind(spec).sheet_and_gap()
    assert thickness == pytest.approx(10.0 * neck, rel=0.04)
    assert gap == pytest.approx(10.0 * neck, rel=0.04)  # the other side is alike
    assert lattice_kind(spec).largest_ball() == pytest.approx(10.0 * neck, rel=0.02)


def test_a_sheet_keeps_its_thickness_where_cells_are_bent_and_nothing_is_said_of_gaps() -> None:
    spec = LatticeSpec("Gyroid", 9.0, wall=TpmsSheet("sheet", 0.8), cell_map=CellMap("cylindrical"))
    assert lattice_kind(spec).sheet_and_gap() == (0.8, None)
    assert lattice_kind(spec).largest_ball() is None
    assert lattice_kind(LatticeSpec("BCC")).sheet_and_gap() == (None, None)


@pytest.mark.slow
def test_the_print_check_names_walls_that_are_too_thin_and_too_near() -> None:
    sheet = LatticeSpec("Gyroid", 3.0, resolution=16, wall=TpmsSheet("sheet", 0.5))
    found = volfrep.block((1, 1, 1), sheet).check("SLS")
    assert found.thinnest_wall_mm == pytest.approx(0.5, rel=0.01)
    assert found.narrowest_gap_mm == pytest.approx(3.0 * 0.433 - 0.5, rel=0.06)
    assert "Walls are down to 0.5 mm thick" in found.findings[0]
    assert "Walls are only" in found.findings[1]
    assert "thinnest wall" in found.to_text()
