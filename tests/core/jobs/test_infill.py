# SPDX-License-Identifier: LGPL-2.1-or-later
"""The stages of an infill, each asked for alone."""

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace

import numpy as np
import pytest

import samples
from volfrep import Cancelled, LatticeSpec, StageCache, VolfrepError
from volfrep.design.openings import DrainHoles, OpenPlane
from volfrep.grid.placement import NUDGE
from volfrep.jobs.blocks import block, block_wireframe
from volfrep.jobs.infill import Infill
from volfrep.jobs.pipeline import fill
from volfrep.process.pool import WorkerPool
from volfrep.process.worker import this_python

SPEC = LatticeSpec(cell="BCC", cell_size=8, strut_radius=0.8, shell=2, resolution=8)


@pytest.fixture(scope="module")
def solid():
    return samples.box((40.0, 32.0, 24.0))


@pytest.mark.parametrize(
    ("stage", "run"),
    [
        ("domain", {"shell"}),
        ("cavity", {"shell"}),
        ("cells", {"shell", "voxels"}),
        ("struts", {"shell", "voxels"}),
        ("axes", {"shell", "voxels"}),
        ("beams", {"shell", "voxels"}),
        ("cavity_result", {"shell", "voxels"}),
        ("lattice", {"shell", "voxels", "tile", "lattice", "trim", "check"}),
        ("part", {"shell", "voxels", "tile", "lattice", "trim", "check"}),
    ],
)
def test_a_stage_runs_those_that_it_needs_and_no_others(solid, stage, run):
    infill = Infill(solid, SPEC)
    assert infill.monitor.stages == {}
    getattr(infill, stage)
    assert infill.monitor.stages.keys() == run
    assert ("kinds of octants meshed" in infill.monitor.work) == ("tile" in run)


class _Elsewhere(WorkerPool):
    """Workers that do at once what they are asked for."""

    def __init__(self, infill: Callable[[], Infill]) -> None:
        super().__init__(this_python(), 1)
        self.infill, self.asked = infill, 0

    def elsewhere(self, function, *given):
        assert not self.infill().part_domain.has_domain
        self.asked += 1
        future = Future()
        future.set_result(function(*given))
        return future


def test_a_worker_meshes_octants_before_there_is_a_wall(solid):
    with _Elsewhere(lambda: infill) as workers:
        infill = Infill(solid, replace(SPEC, shell=0), executor=workers)
        infill.filling.mesh(is_cut=True)
    assert workers.asked == 1
    assert infill.monitor.work["kinds of octants meshed"] == 1, "and nobody once more"


@pytest.mark.slow_cases("part")
@pytest.mark.parametrize(
    "stage", ["domain", "cavity", "cells", "struts", "axes", "beams", "lattice", "part"]
)
def test_a_stage_is_computed_once(solid, stage):
    infill = Infill(solid, SPEC)
    first = getattr(infill, stage)
    work = dict(infill.monitor.work)
    assert getattr(infill, stage) is first
    assert infill.monitor.work == work


def test_later_stages_use_earlier_ones(solid):
    infill = Infill(solid, SPEC)
    domain, struts = infill.domain, infill.struts
    part, lattice = infill.part, infill.lattice
    work = infill.monitor.work
    assert work["walls found"] == 1
    assert work["kinds of octants meshed"] == 1
    assert infill.domain is domain
    assert part.wireframe is lattice.wireframe is struts
    skin = solid.volume - infill.cavity.volume
    assert part.mesh.volume == pytest.approx(skin + lattice.mesh.volume, rel=1e-5)


@pytest.mark.costly_cases("strut_radius-octants-shell-voxels")
@pytest.mark.slow_but("strut_radius-octants-shell-voxels", "origin-shell-tile")
@pytest.mark.parametrize(
    ("changes", "kept"),
    [
        ({}, {"shell", "voxels", "octants", "tile"}),
        ({"density": 3.0}, {"shell", "voxels", "octants", "tile"}),
        ({"drains": DrainHoles(3.0, count=1)}, {"shell", "voxels", "octants", "tile"}),
        ({"remove_dangling": True}, {"shell", "voxels", "octants", "tile"}),  # a skin holds all
        ({"strut_radius": 0.9}, {"shell", "voxels", "octants"}),
        ({"fillet": 0.2}, {"shell", "voxels", "octants"}),
        ({"resolution": 14}, {"shell", "voxels", "octants"}),
        ({"cell": "CVC"}, {"shell", "voxels", "octants"}),
        ({"origin": (1.0, 0.0, 0.0)}, {"shell", "tile"}),
        ({"activation": "centre"}, {"shell"}),
        ({"shell": 1.5}, {"tile"}),
        ({"open_faces": (OpenPlane((0, 0, 0), (0, 0, 1)),)}, {"tile"}),
    ],
    ids=lambda value: "-".join(sorted(value)),
)
def test_a_change_of_the_specification_repeats_the_stages_it_goes_to(solid, changes, kept):
    cache = StageCache()
    _ = Infill(solid, SPEC, cache=cache).part
    before = {name: entry[1] for name, entry in cache._entries.items()}
    _ = Infill(solid, replace(SPEC, **changes), cache=cache).part
    after = {name: entry[1] for name, entry in cache._entries.items()}
    assert {name for name in before if after[name] is before[name]} == kept


@pytest.mark.slow
def test_another_solid_repeats_everything_but_the_octants_meshes(solid):
    cache = StageCache()
    first = Infill(solid, SPEC, cache=cache)
    second = Infill(samples.box((40.0, 32.0, 25.0)), SPEC, cache=cache)
    _ = first.part, second.part
    assert second.monitor.work["walls found"] == 1
    assert "kinds of octants meshed" not in second.monitor.work


@pytest.mark.slow_but("part")
@pytest.mark.parametrize("output", ["part", "lattice", "domain"])
def test_fill_is_one_call_on_top(solid, output):
    spec = replace(SPEC, output=output)
    infill = Infill(solid, spec)
    stage = {"part": "part", "lattice": "lattice", "domain": "cavity_result"}[output]
    assert infill.result is getattr(infill, stage)
    filled = fill(solid, spec)
    assert np.array_equal(filled.mesh.vertices, infill.result.mesh.vertices)
    assert np.array_equal(filled.mesh.triangles, infill.result.mesh.triangles)
    assert filled.report.work == infill.result.report.work


def test_a_report_says_which_stage_it_is_of(solid):
    infill = Infill(solid, SPEC)
    for stage, output in (("part", "part"), ("lattice", "lattice"), ("cavity_result", "domain")):
        assert getattr(infill, stage).report.spec == {**SPEC.as_dict(), "output": output}


def test_without_a_skin_the_part_is_its_lattice(solid):
    infill = Infill(solid, replace(SPEC, shell=0))
    assert infill.part is infill.lattice
    assert infill.beams.skin is None


@pytest.mark.slow
def test_whole_cells_are_cut_by_the_skin_only(solid):
    infill = Infill(solid, replace(SPEC, boundary="whole", activation="centre"))
    low, high = infill.lattice.mesh.bounds
    cavity = infill.cavity.bounds
    assert (low < cavity[0]).any()
    assert (high > cavity[1]).any()
    np.testing.assert_allclose(infill.part.mesh.bounds, solid.bounds)


@pytest.mark.costly
@pytest.mark.slow_but("changes0")
@pytest.mark.parametrize("changes", [{}, {"remove_dangling": True}, {"shell": 0}])
def test_mesh_struts_beams_and_axes_lie_in_the_same_place(solid, changes):
    """Against a block on the same grid, that nothing cuts and nothing moves."""
    spec = replace(SPEC, origin=(0.0, 0.0, 0.0), **changes)
    infill = Infill(solid, spec)
    nudge = NUDGE * spec.cell_size
    uncut = block(spec, (5, 4, 3)).mesh.vertices + nudge
    nodes = block_wireframe(spec, (5, 4, 3)).nodes + nudge

    def shared(points, others):
        return len({*map(tuple, points.tolist())} & {*map(tuple, others.tolist())})

    assert shared(infill.part.mesh.vertices, uncut) > 1000
    for frame in (infill.struts, infill.beams.lattice, infill.axes.wireframe):
        assert shared(frame.nodes, nodes) >= 4 * 3 * 2


def test_what_nothing_cuts_lies_on_its_grid(solid):
    spec = replace(SPEC, shell=0, boundary="whole", origin=(0.0, 0.0, 0.0))
    nodes = Infill(solid, spec).struts.nodes / 4.0
    np.testing.assert_array_equal(nodes, np.round(nodes))


@pytest.mark.costly
def test_progress_is_told_and_a_cancel_stops_any_stage(solid):
    seen = []
    infill = Infill(solid, SPEC, progress=lambda fraction, stage: seen.append((fraction, stage)))
    _ = infill.domain
    assert {stage for _, stage in seen} == {"shell"}
    assert max(fraction for fraction, _ in seen) <= 0.3
    _ = infill.part
    fractions = [fraction for fraction, _ in seen]
    assert fractions == sorted(fractions)
    for stage in ("domain", "struts", "part"):
        with pytest.raises(Cancelled):
            getattr(Infill(solid, SPEC, progress=lambda *_: False), stage)


def test_a_stage_that_is_refused_leaves_the_earlier_ones(solid):
    infill = Infill(solid, replace(SPEC, fillet=0.2))
    with pytest.raises(VolfrepError, match="no fillets"):
        _ = infill.beams
    assert infill.part.report.watertight
    thick = Infill(solid, replace(SPEC, shell=13.0))
    with pytest.raises(VolfrepError, match="nowhere thicker"):
        _ = thick.domain
    with pytest.raises(VolfrepError, match="larger than the part"):
        Infill(solid, replace(SPEC, cell_size=50.0))
