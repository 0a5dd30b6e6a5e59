# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice as lines against the lattice that is made."""

from dataclasses import replace

import numpy as np
import pytest

import samples
from volfrep.design.cells import PAPERS
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.openings import OpenPlane
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.pipeline import fill
from volfrep.jobs.preview import PartDepth, preview
from volfrep.util.errors import VolfrepError


def both(solid, spec):
    return preview(solid, spec, PartDepth(solid, spec.open_faces)), fill(solid, spec).report


@pytest.mark.costly
@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", PAPERS)
def test_its_figures_are_those_of_the_part(cell):
    spec = LatticeSpec(cell=cell, cell_size=8.0, strut_radius=0.8, shell=2.0, density=1.2)
    shown, report = both(samples.sphere(20.0), spec)
    # Joints on the wall and the facets of the sphere are left out of the account.
    assert shown.mass == pytest.approx(report.mass_g, rel=0.03)
    assert shown.volume == pytest.approx(report.volume_mm3, rel=0.03)
    assert shown.relative_density == pytest.approx(report.relative_density, rel=0.06)
    assert shown.cells == pytest.approx(report.cells_active, rel=0.01)
    assert shown.grid.shape == report.grid


@pytest.mark.parametrize("shell", [0.0, 3.0])
def test_its_struts_end_at_the_wall(shell):
    spec = LatticeSpec(cell="CVC", cell_size=8.0, strut_radius=0.8, shell=shell)
    solid = samples.sphere(20.0, 5)
    shown = preview(solid, spec, PartDepth(solid, spec.open_faces))
    for points in (shown.start, shown.end):
        assert np.linalg.norm(points, axis=1).max() < 20.0 - shell + 0.05
    # In a ball a line enters once and leaves once: no strut is in two pieces.
    assert len(shown.start) == shown.struts
    reach = np.linalg.norm(np.concatenate([shown.start, shown.end]), axis=1)
    assert (np.abs(reach - (20.0 - shell)) < 0.05).sum() > 20


@pytest.mark.costly
def test_a_strut_through_a_hole_is_in_two_pieces():
    # Struts along x from 7.5 to 22.5 cross the hole at x = 15.
    spec = LatticeSpec(
        cell="Box", cell_size=15.0, strut_radius=1.0, shell=1.0, origin=(7.5, 15.0, 6.0)
    )
    solid = samples.plate()
    shown = preview(solid, spec, PartDepth(solid, spec.open_faces))
    middle = 0.5 * (shown.start + shown.end)
    assert samples.inside_plate(middle, margin=0.9).all()
    assert len(shown.start) > shown.struts


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        {"size_grading": SizeGrading(Profile("linear", 1.0, 1.6))},
        {"radius_grading": RadiusGrading("skin", Profile("linear", 0.6, 1.0), reach=5.0)},
        {"orientation": Orientation((1.0, 1.0, 0.0), 0.5)},
        {"cell_map": CellMap("cylindrical")},
        {"boundary": "whole", "activation": "inside"},
        {"activation": "centre"},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_graded_turned_bent_and_whole(changes):
    spec = LatticeSpec(cell="BCC", cell_size=6.0, strut_radius=0.8, shell=1.5, **changes)
    shown, report = both(samples.sphere(20.0), spec)
    assert shown.mass == pytest.approx(report.mass_g, rel=0.05)
    assert shown.cells == pytest.approx(report.cells_active, rel=0.25)


@pytest.mark.costly
def test_under_an_open_face_there_is_no_skin():
    spec = LatticeSpec(
        cell="CVC", cell_size=8.0, strut_radius=0.8, shell=3.0,
        open_faces=(OpenPlane((0.0, 0.0, 20.0), (0.0, 0.0, 1.0)),),
    )  # fmt: skip
    solid = samples.box((40.0, 30.0, 20.0))
    shown = preview(solid, spec, PartDepth(solid, spec.open_faces))
    highest = max(shown.start[:, 2].max(), shown.end[:, 2].max())
    lowest = min(shown.start[:, 2].min(), shown.end[:, 2].min())
    assert highest == pytest.approx(20.0, abs=0.05)
    assert lowest == pytest.approx(3.0, abs=0.05)


@pytest.mark.slow
def test_a_cell_larger_than_the_part_is_active_and_no_more_than_all_is_filled():
    box = samples.box()
    spec = LatticeSpec(cell="BCC", cell_size=100.0, strut_radius=10.0, shell=2.0)
    assert preview(box, spec, PartDepth(box)).cells >= 1
    narrow = LatticeSpec(cell="BCC", cell_size=10.0, strut_radius=1.0, shell=9.9)
    shown = preview(box, narrow, PartDepth(box))
    assert 0.0 < shown.relative_density <= 1.0
    assert shown.mass <= 24.0 + 1e-9, "no more than the box weighs"


def test_a_part_too_thin_for_its_skin_is_refused():
    solid = samples.box((40.0, 30.0, 4.0))
    spec = LatticeSpec(cell="CVC", cell_size=4.0, strut_radius=0.4, shell=5.0)
    with pytest.raises(VolfrepError, match="inside the skin"):
        preview(solid, spec, PartDepth(solid, spec.open_faces))


def test_another_radius_asks_for_no_depth_again(monkeypatch):
    solid = samples.sphere(20.0)
    depth = PartDepth(solid)
    spec = LatticeSpec(cell="BCC", cell_size=8.0, strut_radius=0.8, shell=2.0)
    preview(solid, spec, depth)
    thicker = replace(spec, strut_radius=1.1)
    fresh = preview(solid, thicker, PartDepth(solid))
    monkeypatch.setattr(PartDepth, "_found_below", None)
    again = preview(solid, thicker, depth)
    assert again.mass == fresh.mass
    assert np.array_equal(again.start, fresh.start)
