# SPDX-License-Identifier: LGPL-2.1-or-later
"""Holes through the skin, and what they let out."""

from dataclasses import replace

import manifold3d
import numpy as np
import pytest

import samples
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.openings import DrainHoles, DrainPlace, OpenPlane
from volfrep.io.write.stl import as_read
from volfrep.jobs.beam_part import beam_model
from volfrep.jobs.pipeline import fill
from volfrep.mesh import quality
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial.rays import inside_points
from volfrep.trim.drains import drain
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.progress import Monitor

SPEC = LatticeSpec(cell="CVC", cell_size=8, strut_radius=0.8, shell=2, resolution=10)


def drained(solid, *places, diameter=3.0, count=0, up=(0.0, 0.0, 1.0)):
    holes = DrainHoles(diameter, tuple(DrainPlace(*place) for place in places), count, up)
    return fill(solid, replace(SPEC, drains=holes))


def is_material(mesh, *points):
    return inside_points(mesh, np.array(points, float), Monitor()).tolist()


@pytest.mark.costly
def test_a_hole_opens_the_void_and_takes_its_cylinder():
    solid = samples.box()
    closed, opened = fill(solid, SPEC).report, drained(solid, ((20, 15, 20),))
    report = opened.report
    assert (closed.voids, report.voids) == (1, 0)
    assert report.drain_holes == ((20.0, 15.0, 20.0),)
    assert report.warnings == ()
    # Closed form: a cylinder through 2 mm of skin; a strut may lose what reaches into the
    # overlap of 0.15 mm.
    taken = closed.volume_mm3 - report.volume_mm3
    cylinder = np.pi * 1.5**2 * 2.0
    assert cylinder * 0.999 < taken < cylinder * 1.075
    # One hole joins the void's surface to the outside: the handles stay as many.
    assert report.genus == closed.genus
    read = quality.measure(as_read(opened.mesh))
    assert read.watertight
    assert (read.bodies, read.voids, read.genus) == (1, 0, report.genus)
    # Through this skin, and not through the opposite one.
    below = (20.0, 15.0, 19.0), (20.0, 16.4, 18.2), (20.0, 16.6, 19.0), (20.0, 15.0, 1.0)
    assert is_material(opened.mesh, *below) == [False, False, True, True]


def test_every_further_hole_is_one_more_handle():
    solid = samples.box()
    one = drained(solid, ((20, 15, 20),)).report
    three = drained(solid, ((20, 15, 20),), ((10, 15, 0),), ((0, 15, 10),)).report
    assert three.genus == one.genus + 2
    assert len(three.drain_holes) == 3


@pytest.mark.slow
def test_a_splinter_that_the_drill_leaves_is_no_body(monkeypatch):
    corners = np.array([[0.0, 0, 0], [0, 0.01, 0], [0.01, 0, 0], [0, 0, 0.01]]) + 15.0
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]], np.int32)

    def splintered(*given):
        found = drain(*given)
        mesh = concatenate(found.surface.whole(Monitor()), TriangleMesh(corners, faces))
        return replace(found, surface=TrimmedSurface(mesh))

    monkeypatch.setattr("volfrep.trim.stage.drain", splintered)
    result = drained(samples.box((30.0, 30.0, 30.0)), diameter=3.0, count=1)
    assert (result.report.bodies, result.report.specks_removed) == (1, 1)
    assert quality.measure(result.mesh).bodies == 1


@pytest.mark.slow
def test_a_hole_may_slant():
    solid = samples.box()
    closed = fill(solid, SPEC).report
    straight = drained(solid, ((20, 15, 20),)).report
    slanting = drained(solid, ((20, 15, 20), (1, 0, 1))).report
    assert slanting.voids == 0
    lost = [closed.volume_mm3 - report.volume_mm3 for report in (straight, slanting)]
    # At 45 degrees the skin is the root of 2 as thick along the hole; its lower end, square to
    # it, reaches on into the cavity and may meet struts there.
    assert lost[1] > lost[0] * 1.35


@pytest.mark.slow_but("up0")
@pytest.mark.parametrize("up", [(0.0, 0.0, 1.0), (0.0, 0.0, -2.0), (1.0, 0.0, 0.0)])
def test_automatic_holes_are_at_the_lowest_places(up):
    solid = samples.box()
    report = drained(solid, count=2, up=up).report
    assert report.voids == 0
    assert len(report.drain_holes) == 2
    heights = np.array(report.drain_holes) @ np.array(up)
    np.testing.assert_allclose(heights, (solid.vertices @ np.array(up)).min(), atol=1e-9)
    one, two = np.array(report.drain_holes)
    assert np.linalg.norm(one - two) > 6.0


@pytest.mark.slow
def test_on_a_ball_the_hole_is_near_the_pole():
    report = drained(samples.sphere(), count=1).report
    (place,) = report.drain_holes
    assert place[2] < -0.97 * 20.0
    assert report.voids == 0


def dumbbell():
    """Two blocks, joined by a neck thinner than two walls: two cavities."""
    block = manifold3d.Manifold.cube((20.0, 20.0, 20.0))
    neck = manifold3d.Manifold.cube((20.0, 3.0, 3.0)).translate((15.0, 8.0, 8.0))
    data = (block + neck + block.translate((30.0, 0.0, 0.0))).to_mesh64()
    return TriangleMesh(
        np.array(data.vert_properties[:, :3], np.float64), np.array(data.tri_verts, np.int32)
    )


@pytest.mark.costly
def test_every_void_is_drained():
    solid = dumbbell()
    assert fill(solid, SPEC).report.voids == 2
    report = drained(solid, count=1).report
    assert report.voids == 0
    assert sorted(place[0] > 25.0 for place in report.drain_holes) == [False, True]


@pytest.mark.costly
def test_a_void_that_stays_closed_is_said():
    solid = dumbbell()
    report = drained(solid, ((10.0, 10.0, 20.0),)).report
    assert report.voids == 1
    assert "1 closed void is left" in report.warnings[0]
    # The place that was given counts: only the other void gets a hole of its own.
    report = drained(solid, ((10.0, 10.0, 20.0),), count=1).report
    assert (report.voids, len(report.drain_holes)) == (0, 2)
    assert report.drain_holes[1][0] > 25.0


@pytest.mark.slow
def test_a_void_behind_no_open_face_is_said():
    spec = replace(SPEC, open_faces=(OpenPlane((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)),))
    report = fill(dumbbell(), spec).report
    assert report.voids == 1
    assert "1 closed void is left" in report.warnings[0]


def test_holes_that_find_no_room_are_said():
    report = drained(samples.box((40.0, 9.0, 9.0)), diameter=7.5, count=1).report
    assert report.voids == 1
    assert "has room for 0 of its 1 drain holes" in report.warnings[0]


def test_beams_have_the_holes_in_their_skin():
    solid = samples.box()
    holes = DrainHoles(3.0, (DrainPlace((20, 15, 20)),))
    model = beam_model(solid, replace(SPEC, drains=holes))
    closed = beam_model(solid, SPEC)
    assert closed.skin.volume - model.skin.volume == pytest.approx(np.pi * 1.5**2 * 2.0, rel=0.01)


@pytest.mark.parametrize(
    ("place", "message"),
    [
        (((0.5, 15, 20),), "does not go through the skin alone"),  # over the side wall
        (((20, 15, 40),), "20 mm off the part's surface"),
    ],
)
def test_holes_that_miss_the_cavity_are_refused(place, message):
    with pytest.raises(VolfrepError, match=message):
        drained(samples.box(), place)


def test_what_makes_no_sense_is_refused():
    holes = DrainHoles(2.0, count=1)
    for changes, message in (
        ({"shell": 0.0, "drains": holes}, "need a skin"),
        ({"output": "lattice", "drains": holes}, "skin of a part"),
    ):
        with pytest.raises(VolfrepError, match=message):
            replace(SPEC, **changes)
    for arguments, message in (
        ((0.0, (), 1), "diameter of drain holes must be above 0"),
        ((2.0, (), -1), "whole number from 0 to 100"),
        ((2.0,), "need places, or a count"),
        ((2.0, (), 1, (0.0, 0.0, 0.0)), "build direction must not be zero"),
    ):
        with pytest.raises(VolfrepError, match=message):
            DrainHoles(*arguments)
