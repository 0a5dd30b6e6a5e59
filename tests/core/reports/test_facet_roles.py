# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a part's triangles are: its outside, its skin's inner wall, its lattice."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.design.grading import RadiusGrading
from volfrep.design.openings import DrainHoles, DrainPlace, OpenPlane
from volfrep.design.profile import Profile
from volfrep.design.scattered_field import PointField
from volfrep.jobs.pipeline import fill
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.reports.facet_roles import LATTICE, OUTSIDE, WALL, kinds_of_triangles

SIZE = np.array([40.0, 30.0, 20.0])
SHELL = 1.5
SPEC = {"cell": "BCC", "cell_size": 10.0, "strut_radius": 1.0, "shell": SHELL}


def told(solid=None, **values):
    """A filled solid (a box unless given), and what its triangles are."""
    solid = samples.box(SIZE) if solid is None else solid
    spec = LatticeSpec(**(SPEC | values))
    part = fill(solid, spec)
    return part.mesh, kinds_of_triangles(part.mesh, solid, spec)


def area(mesh, rows):
    """Of some triangles, mm2."""
    return TriangleMesh(mesh.vertices, mesh.triangles[rows]).area


def faces(size):
    """Area of a box, mm2."""
    a, b, c = size
    return 2 * (a * b + b * c + c * a)


def depth(points):
    """Of points below the faces of the box, mm."""
    return np.minimum(points, SIZE - points).min(axis=1)


@pytest.mark.costly
@pytest.mark.slow_but("uniform")
@pytest.mark.parametrize(
    "grading",
    [{}, {"radius_grading": RadiusGrading("direction", Profile("linear", 0.5, 1.5))}],
    ids=["uniform", "graded"],
)
def test_the_outside_of_a_box_is_its_faces_and_the_wall_a_smaller_box(grading):
    mesh, kinds = told(**grading)
    assert area(mesh, kinds == OUTSIDE) == pytest.approx(faces(SIZE), rel=1e-6)
    wall = area(mesh, kinds == WALL)
    # Struts stand on the wall: some of it is missing, and nothing is too much.
    assert 0.5 * faces(SIZE - 2 * SHELL) < wall < faces(SIZE - 2 * SHELL)
    on_boundary = depth(mesh.vertices[mesh.triangles[kinds == WALL]].reshape(-1, 3))
    assert np.abs(on_boundary - SHELL).max() < 0.02 * SHELL
    middles = depth(mesh.vertices[mesh.triangles[kinds == LATTICE]].mean(axis=1))
    assert middles.min() > SHELL * (1 - 1e-5)


@pytest.mark.slow
def test_wall_and_outside_of_a_ball_are_two_spheres():
    solid = samples.sphere(20.0, 4)
    mesh, kinds = told(solid)
    radius = np.linalg.norm(mesh.vertices[mesh.triangles].mean(axis=1), axis=1)
    assert radius[kinds == OUTSIDE].min() > 20.0 - 0.1
    assert np.abs(radius[kinds == WALL] - (20.0 - SHELL)).max() < 0.1 + 0.02 * SHELL
    assert radius[kinds == LATTICE].max() < 20.0 - SHELL
    assert area(mesh, kinds == OUTSIDE) == pytest.approx(solid.area)


@pytest.mark.costly
def test_behind_an_open_face_there_is_no_wall():
    top = OpenPlane(tuple(SIZE / 2 * (1, 1, 2)), (0.0, 0.0, 1.0))
    mesh, kinds = told(open_faces=(top,))
    corners = mesh.vertices[mesh.triangles]
    rim = (corners[..., 2] > SIZE[2] - 1e-6).all(axis=1)
    # What is left of the top is the rim, a closed frame as wide as the skin, and cut struts.
    frame = SIZE[0] * SIZE[1] - (SIZE[0] - 2 * SHELL) * (SIZE[1] - 2 * SHELL)
    assert area(mesh, rim & (kinds == OUTSIDE)) == pytest.approx(frame, rel=0.2)
    assert (kinds[rim] != WALL).all()
    walls = corners[kinds == WALL].mean(axis=1)
    # A triangle across an edge of the wall has its corners there and its middle a little deeper.
    assert depth(walls).max() < SHELL * 1.1
    assert not ((kinds == WALL) & (corners[..., 2].min(axis=1) > SIZE[2] - 1e-3)).any()


def test_the_sides_of_a_drain_hole_are_wall():
    place = DrainPlace((20.0, 15.0, 0.0))
    mesh, kinds = told(drains=DrainHoles(2.0, (place,)))
    corners = mesh.vertices[mesh.triangles]
    across = np.linalg.norm(corners[..., :2] - (20.0, 15.0), axis=2)
    through = (corners[..., 2].max(axis=1) < SHELL * 1.001) & (across.max(axis=1) < 1.01)
    low = corners[..., 2].min(axis=1) < 1e-6
    high = corners[..., 2].max(axis=1) > SHELL * 0.999
    sides = through & low & high
    assert sides.any()
    assert (kinds[sides] == WALL).all()


@pytest.mark.parametrize("values", [{"shell": 0.0}, {"output": "lattice"}])
def test_without_a_skin_all_is_lattice(values):
    _, kinds = told(**values)
    assert (kinds == LATTICE).all()


def test_a_domain_holds_no_lattice():
    _, kinds = told(output="domain")
    assert (kinds == OUTSIDE).all()


@pytest.mark.costly
def test_the_wall_of_a_skin_that_follows_a_field_is_wall_where_it_is_thick():
    places = np.stack(np.meshgrid(*(np.linspace(0, side, 9) for side in SIZE)), -1).reshape(-1, 3)
    thickness = PointField(places, SHELL + 2.0 * places[:, 0] / SIZE[0], "test")
    mesh, kinds = told(skin_field=thickness)
    wall = area(mesh, kinds == WALL)
    assert 0.5 * faces(SIZE - 5.0) < wall < faces(SIZE - 5.0)
    corners = mesh.vertices[mesh.triangles[kinds == LATTICE]].reshape(-1, 3)
    far = corners[:, 0] > 0.8 * SIZE[0]
    assert np.quantile(depth(corners[far]), 0.05) > SHELL + 1.2
