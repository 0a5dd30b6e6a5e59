# SPDX-License-Identifier: LGPL-2.1-or-later
"""The map from lattice space to the part: there and back, by the published equations, no folds."""

import numpy as np
import pytest

import samples
from volfrep.design.grading import CellMap, Orientation, SizeGrading
from volfrep.design.profile import Profile
from volfrep.grid.coordinate_map import lattice_map, triangles_in_lattice
from volfrep.util.errors import VolfrepError
from volfrep.util.linalg import frame_about, rotation

BOX = np.array([[-10.0, 5.0, 0.0], [50.0, 45.0, 30.0]])
L = 5.0


def mapping(size=None, cells=None, turned=None):
    return lattice_map(L, BOX, size, cells, turned)


CHARTS = {
    "nothing": mapping(),
    "turned": mapping(turned=Orientation((1, 2, 3), 40.0)),
    "linear": mapping(SizeGrading(Profile("linear", 1.0, 2.0))),
    "quadratic, oblique": mapping(SizeGrading(Profile("quadratic", 0.8, 1.7), (1, 2, -1))),
    "exponential, turned": mapping(
        SizeGrading(Profile("exponential", 2.0, 1.2)),
        turned=Orientation((0, 0, 1), 30.0, (1, 2, 3)),
    ),
    "formula": mapping(
        SizeGrading(Profile("expression", expression="1 + 0.3*sin(3*s)"), (0, 1, 0))
    ),
    "cylindrical": mapping(cells=CellMap("cylindrical", axis=(1, 1, 0))),
    "spherical": mapping(cells=CellMap("spherical", around=20)),
    "cylindrical, graded": mapping(
        SizeGrading(Profile("linear", 1.0, 1.5)), CellMap("cylindrical")
    ),
}


@pytest.mark.parametrize("name", CHARTS)
def test_there_and_back(name):
    points = np.random.default_rng(1).uniform(BOX[0] - 3.0, BOX[1] + 3.0, (2000, 3))
    there = CHARTS[name].to_lattice(points)
    assert CHARTS[name].to_part(there) == pytest.approx(points, abs=1e-5)


@pytest.mark.parametrize("name", CHARTS)
def test_jacobians_turn_no_cell_inside_out(name):
    points = np.random.default_rng(2).uniform(*BOX, (500, 3))
    assert (np.linalg.det(CHARTS[name].jacobians(CHARTS[name].to_lattice(points))) > 0.0).all()


def test_nothing_asked_for_changes_nothing():
    assert CHARTS["nothing"].is_identity
    assert not CHARTS["turned"].is_identity
    assert CHARTS["turned"].is_rigid


@pytest.mark.parametrize(
    ("profile", "value"),
    [
        (Profile("linear", 1.0, 2.0), lambda s: 1 + s),
        (Profile("quadratic", 1.0, 2.0), lambda s: 1 + s * s),
        (Profile("exponential", 1.0, 2.0), lambda s: np.exp(np.log(2) * s)),
        (Profile("expression", expression="1 + s"), lambda s: 1 + s),
    ],
)
def test_points_move_by_equation_13_and_are_rescaled_to_the_box(profile, value):
    """s moves to s lambda(s / s_max), over lambda(1): the published equations 11 to 13."""
    found = mapping(SizeGrading(profile))
    start, length = BOX[0, 0], np.ptp(BOX[:, 0])
    before = found.stretch.before
    s = np.linspace(0.0, 1.0, 50)
    points = np.stack([start + s * before, 0 * s, 0 * s], axis=1)
    assert found.to_part(points)[:, 0] == pytest.approx(start + length * s * value(s) / value(1.0))


def test_cells_begin_as_long_as_the_law_says_and_fill_the_box_with_whole_ones():
    stretch = mapping(SizeGrading(Profile("linear", 1.0, 2.0))).stretch
    assert stretch.before / L == round(stretch.before / L)
    ends = mapping(SizeGrading(Profile("linear", 1.0, 2.0), (1, 1, 0))).stretch
    first = np.array([[0.0, 0, 0], [0.01, 0, 0]]) @ frame_about((1, 1, 0))[:, [2, 0, 1]].T
    first += ends.start * ends.direction
    assert np.linalg.norm(np.diff(ends.to_part(first), axis=0)) == pytest.approx(0.01, rel=1e-3)


@pytest.mark.parametrize(
    "profile",
    [
        Profile("linear", 2.0, 0.9),
        Profile("expression", expression="2 - 1.9*s"),
        Profile("quadratic", 3, 1),
    ],
)
def test_a_law_that_folds_space_is_refused(profile):
    with pytest.raises(VolfrepError, match=r"folds the lattice at s = 0\.\d"):
        mapping(SizeGrading(profile))


def test_the_full_turn_closes():
    found = CHARTS["cylindrical"]
    turn = found.base.turn
    points = np.array([[7.0, 0.0, 3.0], [12.0, 4.0, -3.0]])
    assert found.to_part(points) == pytest.approx(found.to_part(points + np.array([0, turn, 0])))
    assert turn / L == found.base.around


def test_distances_along_radius_and_axis_are_kept_in_cylindrical_cells():
    jacobian = CHARTS["cylindrical"].jacobians(np.array([[8.0, 2.0, 1.0]]))[0]
    assert np.linalg.norm(jacobian, axis=0)[[0, 2]] == pytest.approx([1.0, 1.0])
    assert jacobian.T @ jacobian == pytest.approx(np.diag(np.diag(jacobian.T @ jacobian)), abs=1e-6)


@pytest.mark.parametrize("name", ["cylindrical", "linear", "spherical"])
def test_split_triangles_lie_on_the_surface(name):
    part = samples.bracket()
    found = lattice_map(L, part.bounds, *{
        "cylindrical": (None, CellMap("cylindrical"), None),
        "linear": (SizeGrading(Profile("linear", 1.0, 2.0)), None, None),
        "spherical": (None, CellMap("spherical"), None),
    }[name])  # fmt: skip
    corners = triangles_in_lattice(part, found)
    middle = found.to_part(corners.mean(axis=1))
    whole = found.to_part(corners.reshape(-1, 3)).reshape(-1, 3, 3)
    sizes = np.linalg.norm(np.diff(whole, axis=1), axis=2).max(axis=1)
    off = np.linalg.norm(middle - whole.mean(axis=1), axis=1)
    # Away from the axis, where nothing is straight.
    assert np.quantile(off[sizes > 0.1 * L], 0.99) < 0.03 * L


def test_rotation_is_counter_clockwise():
    assert rotation(np.array([0, 0, 2.0]), np.pi / 2) @ [1, 0, 0] == pytest.approx([0, 1, 0])


def test_frames_are_right_handed():
    for axis in np.random.default_rng(3).normal(size=(20, 3)):
        frame = frame_about(axis)
        assert frame.T @ frame == pytest.approx(np.eye(3))
        assert np.linalg.det(frame) == pytest.approx(1.0)
