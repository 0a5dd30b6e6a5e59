"""Needles and caps along a cut: mended, on the same surface."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh import remesh
from volfrep.mesh import well_shaped as well_shaped_module
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.mesh.well_shaped import Tolerance, angles_of, is_bad, mend_bad_facets
from volfrep.spatial.proximity import closest_points
from volfrep.spatial.self_intersection import crossing_triangles

TOLERANCE = 0.02


@pytest.fixture(scope="module", params=["CVC", "Kelvin"])
def trimmed(request):
    solid = samples.box((24.0, 17.0, 13.0))
    spec = LatticeSpec(request.param, cell_size=10, strut_radius=1, shell=1.3, deviation=0.05)
    return fill(solid, spec).mesh


@pytest.fixture(scope="module")
def better(trimmed):
    return mend_bad_facets(trimmed, Tolerance(TOLERANCE), 0.1, no_fault)


def no_fault(_, new):
    return np.zeros(len(new), bool)


def corners(mesh):
    return mesh.vertices[mesh.triangles]


def test_angles_are_those_of_triangles_that_are_known():
    flat = np.zeros((3, 3, 3))
    flat[0, 1], flat[0, 2] = (3, 0, 0), (0, 4, 0)
    flat[1, 1], flat[1, 2] = (1, 0, 0), (0.5, 0.75**0.5, 0)
    assert angles_of(flat)[0] == pytest.approx([90, 53.1301, 36.8699], abs=1e-4)
    assert angles_of(flat)[1] == pytest.approx([60, 60, 60])
    assert not angles_of(flat)[2].any()
    assert is_bad(flat).tolist() == [False, False, True]


@pytest.mark.slow
def test_few_needles_of_a_trimmed_part_are_left(trimmed, better):
    before, after = (is_bad(corners(mesh)).sum() for mesh in (trimmed, better))
    assert before > 100
    assert after < 0.02 * before


@pytest.mark.costly
@pytest.mark.slow_cases("CVC")
def test_its_surface_stays(trimmed, better):
    was, now = measure(trimmed), measure(better)
    assert now.watertight
    assert (now.genus, now.bodies, now.voids) == (was.genus, was.bodies, was.voids)
    assert now.volume == pytest.approx(was.volume, rel=3e-4)
    assert now.area == pytest.approx(was.area, rel=1e-3)
    for one, two in ((better, trimmed), (trimmed, better)):
        points = np.concatenate([one.vertices, corners(one).mean(axis=1)])
        assert closest_points(two, points)[1].max() < 2 * TOLERANCE
    assert not crossing_triangles(better, np.ones(len(better.triangles), bool), 1e-9).any()


@pytest.mark.slow_cases("CVC")
def test_it_does_not_grow_out_of_hand(trimmed, better):
    assert len(better.triangles) < 2 * len(trimmed.triangles)


def test_a_mesh_without_needles_is_left_alone():
    mesh = block(LatticeSpec("CVC", cell_size=10, strut_radius=1), (1, 1, 1)).mesh
    assert not is_bad(corners(mesh)).any()
    same = mend_bad_facets(mesh, Tolerance(TOLERANCE), 0.1, no_fault)
    assert np.array_equal(corners(same), corners(mesh))


@pytest.mark.slow_but("Box")
@pytest.mark.parametrize("cell", ["Box", "BCC", "FCC"])
def test_a_wall_along_struts_leaves_no_needles(cell):
    """Its faces run through the middles of struts, a hair beside facets' corners."""
    spec = LatticeSpec(cell, cell_size=10, strut_radius=1, shell=0, deviation=0.05)
    mesh = fill(samples.box((10.0, 10.0, 10.0)), spec).mesh
    assert is_bad(corners(mesh)).sum() > 100
    better = mend_bad_facets(mesh, Tolerance(TOLERANCE), 0.1, no_fault)
    assert not is_bad(corners(better)).any()
    assert better.volume == pytest.approx(mesh.volume, rel=1e-3)
    assert not crossing_triangles(better, np.ones(len(better.triangles), bool), 1e-9).any()


def test_about_places_the_tolerance_is_less():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0]])
    usual = Tolerance(0.16, 0.75)
    assert usual.at(points) == pytest.approx([0.16, 0.16, 0.16])
    less = usual.with_less(np.array([[0.5, 0, 0]])).with_less(np.array([[-0.1, 0, 0]]))
    assert less.at(points) == pytest.approx([0.01, 0.04, 0.16])


def test_a_sharp_edge_stays_sharp():
    """A box whose faces are fans of needles: its corners and edges are those of the box."""
    count = 40
    ring = np.array([[-5 + 10 * k / count, -5.0] for k in range(count)])
    turns = [ring @ np.array([[c, s], [-s, c]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    border = np.concatenate(turns)
    size = len(border)
    points = np.concatenate([np.c_[border, np.full(size, -5.0)], np.c_[border, np.full(size, 5.0)]])
    low, high = np.arange(size), np.arange(size) + size
    after = np.roll(low, -1), np.roll(high, -1)
    sides = np.concatenate([np.c_[low, after[0], high], np.c_[after[0], after[1], high]])
    lids = [[size, size + k, size + k + 1] for k in range(1, size - 1)]
    bottoms = [[0, k + 1, k] for k in range(1, size - 1)]
    mesh = TriangleMesh(points, np.array([*sides.tolist(), *lids, *bottoms], np.int32))
    assert measure(mesh).watertight
    better = mend_bad_facets(mesh, Tolerance(TOLERANCE), 0.1, no_fault)
    assert measure(better).watertight
    assert better.volume == pytest.approx(1000.0, rel=1e-9)
    assert is_bad(corners(better)).sum() < 0.05 * is_bad(corners(mesh)).sum()


def test_a_tube_of_long_strips_keeps_its_volume_and_its_ends():
    """Each flip cuts its outside off by up to 0.02 mm, or fills its bore: it lost 0.24 %."""
    mesh = tube(radii=(2.0, 5.0), length=6.0, count=128)
    better = mend_bad_facets(mesh, Tolerance(TOLERANCE), 0.1, no_fault)
    assert measure(better).watertight
    assert is_bad(corners(better)).sum() < 0.1 * is_bad(corners(mesh)).sum()
    assert better.volume == pytest.approx(mesh.volume, rel=1e-6)
    for one, other in ((mesh, better), (better, mesh)):
        places = np.concatenate([one.vertices, corners(one).mean(axis=1)])
        assert closest_points(other, places)[1].max() < 2.0 * TOLERANCE
    # Its ends stay in their planes.
    ends = np.abs(remesh.unit_normals(corners(better))[:, 2]) > 0.99
    assert set(corners(better)[ends][:, :, 2].ravel()) == {0.0, 6.0}


def tube(radii, length, count):
    """A closed tube along z, whose walls are strips as long as it is."""
    turn = 2.0 * np.pi * np.arange(count) / count
    round_it = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    rings = [np.c_[r * round_it, np.full(count, z)] for r in radii for z in (0.0, length)]
    this, after = np.arange(count), np.roll(np.arange(count), -1)
    # Inner low, inner high, outer low, outer high: each wall from a ring to the next outwards.
    walls = [(1, 0), (2, 3), (0, 2), (3, 1)]
    facets = [
        side
        for low, high in walls
        for side in (
            np.stack([this + low * count, after + low * count, after + high * count], axis=1),
            np.stack([this + low * count, after + high * count, this + high * count], axis=1),
        )
    ]
    return TriangleMesh(np.concatenate(rings), np.concatenate(facets).astype(np.int32))


@pytest.mark.parametrize("height", [-0.2, -0.02])
def test_a_facet_turned_over_its_neighbour_is_put_right(height):
    """The corner beyond an edge was brought over the facet on the other side, in its plane."""
    inner = [[0.0, 0, 0], [4, 0, 0], [1.5, -3, 0], [2, height, 0]]
    points = np.array([*inner, [-5, -5, 0], [8.8, -5, 0], [4, 4, 0], [0, 4, 0]])
    ring = [[2, 0, 4], [1, 2, 5], [3, 1, 6], [0, 3, 7], [2, 4, 5], [1, 5, 6], [3, 6, 7], [0, 7, 4]]
    turned = np.array([[0, 2, 1], [0, 1, 3], *ring])
    assert remesh.normals(points[turned])[:, 2].min() < 0
    put_right = well_shaped_module._flip(points, turned, Tolerance(TOLERANCE))
    normal = remesh.normals(points[put_right])
    assert normal[:, 2].min() > 0
    assert normal[:, 2].sum() == pytest.approx(remesh.normals(points[turned])[:, 2].sum())
    # A true crease stays.
    points[3, 2] = 0.2
    assert (well_shaped_module._flip(points, turned, Tolerance(TOLERANCE)) == turned).all()


@pytest.mark.costly
def test_a_flip_makes_no_edge_that_others_have():
    """Where some facets about both its ends were not looked at, an edge was made twice."""
    spec = LatticeSpec("FCC", cell_size=10, strut_radius=1, shell=0, deviation=0.05)
    mesh = fill(samples.sphere(11.0), spec).mesh
    better = mend_bad_facets(mesh, Tolerance(0.03), 0.15, no_fault)
    assert measure(better).watertight


def test_the_tip_of_a_thin_lip_stays():
    """All planes about it are within a fifth of the tolerance of what lies 0.2 mm behind it."""
    section = np.array([[0.0, 0.0], [0.2, 0.002], [10.0, 0.1], [10.0, -0.1], [0.2, -0.002]])
    count, rows = len(section), 6
    points = np.array([[x, 2.0 * row, z] for row in range(rows) for x, z in section])
    a, b = np.arange(count), (np.arange(count) + 1) % count
    ring = np.concatenate([[a, b, b + count], [a, b + count, a + count]], axis=1).T
    sides = [ring + row * count for row in range(rows - 1)]
    end = np.array([[0, 1, 4], [1, 3, 4], [1, 2, 3]])
    facets = np.concatenate([*sides, end[:, ::-1], end + (rows - 1) * count])
    mesh = TriangleMesh(points, facets[:, ::-1].astype(np.int32))
    assert measure(mesh).watertight
    better = mend_bad_facets(mesh, Tolerance(TOLERANCE), 0.1, no_fault)
    assert is_bad(corners(better)).sum() < is_bad(corners(mesh)).sum()
    for one, other in ((mesh, better), (better, mesh)):
        at = corners(one)
        middles = 0.5 * (at + np.roll(at, 1, axis=1))
        places = np.concatenate([at, middles], axis=1).reshape(-1, 3)
        assert closest_points(other, places)[1].max() < 2.0 * TOLERANCE
