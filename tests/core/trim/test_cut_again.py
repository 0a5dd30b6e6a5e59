# SPDX-License-Identifier: LGPL-2.1-or-later
"""Open faces and drain holes: a further cut, which whole octants inside stay out of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import samples
from contract import assert_same_quality
from volfrep import LatticeSpec
from volfrep.design.openings import DrainHoles, DrainPlace, OpenPlane
from volfrep.jobs.infill import Infill
from volfrep.mesh import quality
from volfrep.reports.result import Result
from volfrep.trim import stage
from volfrep.util.progress import Monitor

SPEC = LatticeSpec("CVC", cell_size=5, strut_radius=0.5, shell=1, resolution=8)
TOP = OpenPlane((15.0, 15.0, 30.0), (0.0, 0.0, 1.0))
HOLES = DrainHoles(3.0, (DrainPlace((15.0, 15.0, 30.0)), DrainPlace((0.0, 14.0, 17.0))))
CASES = {
    "drains": replace(SPEC, drains=HOLES),
    "a drain deep into the cells": replace(
        SPEC, drains=DrainHoles(9.0, (DrainPlace((15.0, 15.0, 30.0), (1.0, 0.0, 1.0)),))
    ),
    "drains by themselves": replace(SPEC, drains=DrainHoles(3.0, (), 2)),
    "an open face": replace(SPEC, open_faces=(TOP,)),
    "a thick skin that is open": replace(SPEC, shell=4.0, cell_size=4, open_faces=(TOP,)),
    "the lattice of an open part": replace(SPEC, open_faces=(TOP,), output="lattice"),
    "an open face and a drain": replace(
        SPEC, open_faces=(TOP,), drains=replace(HOLES, places=HOLES.places[1:])
    ),
}


def made(name: str) -> Result:
    return Infill(samples.box((30.0, 30.0, 30.0)), CASES[name]).result


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_it_is_what_the_whole_mesh_would_have_become(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    some = made(name)
    assert some.surface.octants is not None, "octants that nothing cuts stay out of the mesh"
    monkeypatch.setattr(stage, "_to_look_at", lambda laid, _: laid.kept.inside)
    every = made(name)
    assert every.surface.octants is None
    one, two = (quality.measure(result.mesh) for result in (some, every))
    assert one.watertight
    if name == "drains by themselves":
        assert (one.bodies, one.voids) == (two.bodies, two.voids) == (1, 0)
        assert len(some.report.drain_holes) == 2
        return
    assert one.volume == pytest.approx(two.volume, rel=1e-9)
    assert one.area == pytest.approx(two.area, rel=1e-9)
    assert (one.bodies, one.voids, one.genus) == (two.bodies, two.voids, two.genus)
    assert some.report.drain_holes == every.report.drain_holes
    np.testing.assert_allclose(one.bounds, two.bounds)


@pytest.mark.costly
@pytest.mark.slow_cases("drains")
@pytest.mark.parametrize("name", ["drains", "an open face"])
def test_its_figures_are_those_of_its_triangles(name: str) -> None:
    found = made(name)
    report, measured = found.report, quality.measure(found.mesh)
    assert_same_quality(found.surface.inspected(Monitor()).found.quality, measured)
    assert (report.triangles, report.genus) == (measured.triangles, measured.genus)
