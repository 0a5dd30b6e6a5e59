# SPDX-License-Identifier: LGPL-2.1-or-later

import manifold3d
import numpy as np
import pytest
import trimesh

import samples
from bench.parts import NO_PARTS, PARTS
from volfrep.io.solid import read_solid
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.shell import offset
from volfrep.shell.offset import find_cavity
from volfrep.spatial.self_intersection import crossing_triangles
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.progress import Monitor
from walls import wall_errors

#: One side of a box has no skin: its wall is found by cubes, however few its faces are.
ONE_OPEN = np.arange(12) < 2
needs_parts = pytest.mark.skipif(not PARTS.is_dir(), reason=NO_PARTS)


def check_closed(wall, thickness, crossing_share=0.0):
    t = trimesh.Trimesh(wall.vertices, wall.triangles, process=False)
    assert t.is_watertight
    assert t.is_winding_consistent
    mesh = manifold3d.Mesh64(wall.vertices, wall.triangles.astype(np.uint64))
    assert manifold3d.Manifold(mesh).status() == manifold3d.Error.NoError
    everywhere = np.ones(len(wall.triangles), bool)
    crossing = crossing_triangles(wall, everywhere, 1e-4 * thickness)
    assert crossing.mean() <= crossing_share


def test_a_box_gives_the_smaller_box():
    wall = find_cavity(samples.box(), 3.0, Monitor()).mesh
    check_closed(wall, 3.0)
    np.testing.assert_allclose(wall.bounds, [[3.0, 3.0, 3.0], [37.0, 27.0, 17.0]], atol=1e-6)
    assert wall.volume == pytest.approx(34.0 * 24.0 * 14.0, rel=1e-6)
    assert len(wall.triangles) == 12


def test_a_sphere_gives_the_smaller_sphere():
    solid = samples.sphere(20.0, 5)
    wall = find_cavity(solid, 3.0, Monitor()).mesh
    check_closed(wall, 3.0)
    radius = np.linalg.norm(wall.vertices, axis=1)
    assert radius.min() > 16.9
    assert radius.max() < 17.1
    assert wall.volume == pytest.approx(4.0 / 3.0 * np.pi * 17.0**3, rel=0.005)


@pytest.mark.costly_cases("33.0")
@pytest.mark.parametrize("turn", [0.0, 33.0])
def test_a_bracket_has_sharp_and_round_edges_where_it_should(turn):
    solid = samples.bracket(turn)
    wall = find_cavity(solid, 2.0, Monitor()).mesh
    check_closed(wall, 2.0)
    assert np.abs(wall_errors(solid, wall, 2.0)).max() < 0.05
    # Mitred outside corners, and round the inner edge of the L a quarter of a cylinder of
    # radius 2 instead of the corner.
    section = 46.0 * 6.0 + 6.0 * 40.0 + (2.0**2 - np.pi * 2.0**2 / 4.0)
    assert wall.volume == pytest.approx(section * 26.0, rel=0.005)


@pytest.mark.slow
def test_a_plate_with_holes_keeps_its_wall_round_them():
    solid = samples.plate()
    wall = find_cavity(solid, 2.0, Monitor()).mesh
    check_closed(wall, 2.0)
    assert np.abs(wall_errors(solid, wall, 2.0)).max() < 0.05
    area = 56.0 * 36.0 - 3.0 * np.pi * 7.0**2
    assert wall.volume == pytest.approx(area * 8.0, rel=0.005)
    assert trimesh.Trimesh(wall.vertices, wall.triangles).euler_number == 2 - 2 * 3


def test_what_is_thin_everywhere_stays_solid():
    for thickness in (5.9, 6.0, 10.0, 30.0):
        wall = find_cavity(samples.plate(), thickness, Monitor()).mesh
        if thickness >= 6.0:
            assert not len(wall.triangles)
            assert wall.volume == 0.0
    ball = samples.sphere(20.0, 3)
    assert not len(find_cavity(ball, 20.0, Monitor()).mesh.triangles)


def test_a_cavity_has_a_wall_too():
    hollow = concatenate(
        samples.box(), samples.box((20.0, 10.0, 6.0), (10.0, 10.0, 7.0)).reversed()
    )
    wall = find_cavity(hollow, 2.0, Monitor()).mesh
    check_closed(wall, 2.0)
    assert np.abs(wall_errors(hollow, wall, 2.0)).max() < 0.05
    # The box less the cavity grown by 2 with round edges and corners.
    a, b, c, r = 20.0, 10.0, 6.0, 2.0
    grown = a * b * c + 2 * r * (a * b + b * c + c * a) + np.pi * r**2 * (a + b + c)
    grown += 4.0 / 3.0 * np.pi * r**3
    assert wall.volume == pytest.approx(36.0 * 26.0 * 16.0 - grown, rel=0.005)


def test_a_wall_too_thin_for_memory_is_refused(monkeypatch):
    monkeypatch.setattr(offset, "MEMORY_LIMIT", offset.MEMORY_LIMIT / 100)
    with pytest.raises(VolfrepError, match=r"wall of 0\.01 mm is too thin.*at least"):
        find_cavity(samples.box(), 0.01, Monitor(), ONE_OPEN)


def test_no_skin_is_advised_that_the_part_has_no_room_for(monkeypatch):
    """A plate of which no skin fits into memory: its deepest points lie half its thickness deep."""
    monkeypatch.setattr(offset, "MEMORY_LIMIT", offset.MEMORY_LIMIT / 100)
    plate = samples.box((2_000.0, 2_000.0, 0.5))
    with pytest.raises(VolfrepError, match=r"nowhere deeper than about 0\.2.* without a skin"):
        find_cavity(plate, 0.02, Monitor(), ONE_OPEN)


@pytest.mark.costly
def test_cancel_is_honoured_in_time():
    asked = []

    def callback(fraction, name):
        asked.append(fraction)
        return len(asked) < 8

    with pytest.raises(Cancelled):
        find_cavity(samples.plate(), 0.3, Monitor(callback))
    assert len(asked) == 8


@pytest.mark.slow
@needs_parts
def test_the_industrial_bracket():
    solid = read_solid(PARTS / "ge_bracket.stl")
    wall = find_cavity(solid, 3.0, Monitor()).mesh
    check_closed(wall, 3.0)
    assert np.abs(wall_errors(solid, wall, 3.0)).max() < 0.05
    many = np.abs(wall_errors(solid, wall, 3.0, 100_000))
    assert np.mean(many > 0.05) < 1e-4
    assert many.max() < 0.1
    assert len(wall.triangles) < 20_000


@pytest.mark.slow
@needs_parts
@pytest.mark.parametrize(
    ("name", "thickness"),
    [
        ("ge_bracket.stl", 5.0),
        ("ge_bracket.stl", 8.0),
        pytest.param("piston_rod.stl", 1.0, marks=pytest.mark.slow),
        ("odri_lower_leg_v2.STL", 2.0),
    ],
)
def test_parts_with_room_thinner_than_a_voxel(name, thickness):
    """Finer voxels are tried there; what is left are a few places where the wall is thicker."""
    solid = read_solid(PARTS / name)
    wall = find_cavity(solid, thickness, Monitor()).mesh
    check_closed(wall, thickness, crossing_share=0.003)
    errors = wall_errors(solid, wall, thickness)
    assert errors.min() > -0.05
    assert np.mean(np.abs(errors) > 0.05) < 0.002
    assert errors.max() < 0.25


def test_a_wall_that_crossed_itself_is_measured_as_it_is_in_the_end(monkeypatch):
    solid, looked = samples.sphere(10.0, 3), []

    def drawn_apart(mesh, thickness, monitor, known):
        looked.append((len(known.names) == len(mesh.triangles), len(known.pairs)))
        return TriangleMesh(0.9 * mesh.vertices, mesh.triangles)

    plain = offset.find_cavity(solid, 2.0, Monitor())
    monkeypatch.setattr(offset, "without_crossings", drawn_apart)
    moved = offset.find_cavity(solid, 2.0, Monitor())
    assert looked == [(True, 0)]
    np.testing.assert_array_equal(moved.mesh.vertices, 0.9 * plain.mesh.vertices)
    assert plain.worst < 0.05
    assert moved.worst == pytest.approx(0.4, abs=0.05)
