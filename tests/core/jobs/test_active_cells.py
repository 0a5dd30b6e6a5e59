# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which cells of a part hold a lattice, and what is said of those that have no room for one."""

import numpy as np
import pytest

import samples
from volfrep.design.grading import CellMap
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.infill import Infill


def infill_of(kind, radius=0.5, size=(40.0, 40.0, 20.0)):
    spec = LatticeSpec("BCC", 6.0, radius, shell=0.0, cell_map=CellMap(kind) if kind else None)
    return Infill(samples.box(size), spec)


@pytest.mark.parametrize("kind", ["cylindrical", "spherical"])
def test_cells_too_narrow_next_to_an_axis_are_told(kind):
    found = infill_of(kind)
    assert found.cells.narrow > 0
    assert found.warnings[-1].startswith(f"{found.cells.narrow:,} cells are too narrow")


def test_thinner_struts_leave_fewer_hollow():
    told = [infill_of("cylindrical", radius).cells.narrow for radius in (0.9, 0.5, 0.2)]
    assert told == sorted(told, reverse=True)
    assert told[0] > told[-1]


def test_the_cells_left_hollow_lie_about_the_axis():
    found = infill_of("cylindrical")
    usable = found.cells.padded.inner_usable
    # Along the radius first: whole rings are left out, from the axis on.
    hollow = ~usable.any(axis=(1, 2))
    assert hollow[0]
    assert (np.diff(hollow.astype(int)) <= 0).all()


def test_nothing_is_told_of_straight_cells():
    assert infill_of(None).warnings == ()
