# SPDX-License-Identifier: LGPL-2.1-or-later
"""The depth at the corners of cubes: the closed form, taken once, and cubes all along the wall."""

import numpy as np
import pytest

import samples
from volfrep.shell import octree
from volfrep.shell.sampled_depth import COARSEST
from walled import field_of

SIZE, THICKNESS = np.array([40.0, 30.0, 20.0]), 2.0


@pytest.fixture(scope="module")
def box():
    return field_of(samples.box(SIZE), THICKNESS)


def nodes_of(field, count=2000):
    """Random corners of coarsest cubes."""
    top = (SIZE / field.unit / COARSEST).astype(int)
    return COARSEST * np.random.default_rng(2).integers(0, top, (count, 3))


def value_in_the_box(points):
    """Thickness less signed depth: the depth inside is the nearest face's, outside the box's."""
    inside = np.minimum(points, SIZE - points).min(axis=1)
    beyond = np.linalg.norm(np.maximum(np.maximum(-points, points - SIZE), 0.0), axis=1)
    return THICKNESS - np.where(inside > 0.0, inside, -beyond)


def test_samples_are_the_depth_where_it_matters(box):
    nodes = nodes_of(box)
    exact = value_in_the_box(box.point(nodes))
    value, gradient = box.sample(nodes)
    near = np.abs(exact) < 0.5 * THICKNESS
    assert near.sum() > 100
    np.testing.assert_allclose(value[near], exact[near], atol=box.depth.error)
    sure = np.abs(exact) > box.depth.error
    assert ((value < 0) == (exact < 0))[sure].all()
    np.testing.assert_allclose(np.linalg.norm(gradient, axis=1)[value != THICKNESS], 1.0)


def test_a_node_is_sampled_once(box, monkeypatch):
    nodes = nodes_of(box)
    before = box.sample(nodes)
    asked = []
    depth = type(box.depth)
    monkeypatch.setattr(depth, "values", lambda *given: asked.append(given))
    again = box.sample(nodes[::-1])
    assert not asked
    np.testing.assert_array_equal(again[0][::-1], before[0])
    np.testing.assert_array_equal(again[1][::-1], before[1])


def test_nodes_lie_at_whole_steps_of_the_unit(box):
    one, two = box.point(np.array([[0, 0, 0], [32, 64, 0]]))
    np.testing.assert_allclose(two - one, [32 * box.unit, 64 * box.unit, 0.0])
    assert COARSEST * box.unit == pytest.approx(0.5 * THICKNESS)


@pytest.mark.slow_but("box", "plate")
@pytest.mark.parametrize(
    "part", [samples.box(SIZE), samples.sphere(), samples.plate(64)], ids=["box", "ball", "plate"]
)
def test_the_coarsest_cubes_cover_every_change_of_sign(part):
    """Of all cubes of the grid, those with different signs at their corners are among them."""
    field = field_of(part, THICKNESS)
    leaves = field.coarsest_leaves()
    assert (leaves.size == COARSEST).all()
    top = np.ceil((part.bounds[1] - field.point(np.zeros(3))) / (COARSEST * field.unit)).astype(int)
    grid = COARSEST * np.indices(top).reshape(3, -1).T
    negative = field.hide(octree.Leaves(grid, np.full(len(grid), COARSEST)), 0.1)[1]
    mixed = negative.any(axis=1) & ~negative.all(axis=1)
    assert mixed.sum() > 500
    names = np.sort(octree.name(leaves.corner))
    assert (octree.find(names, octree.name(grid[mixed])) >= 0).all()
    assert len(leaves.size) < 0.7 * len(grid)


def test_a_thin_cavity_is_suspected_where_corners_do_not_tell():
    """A plate of two skins and 0.3 mm: corners of coarse cubes lie in the skins."""
    plate = samples.box((30.0, 30.0, 2 * THICKNESS + 0.3))
    field = field_of(plate, THICKNESS, cube=1.7)
    leaves = field.coarsest_leaves()
    blind = ~field.hide(leaves, 0.1)[1].any(axis=1)
    middle = field.point(leaves.corner + leaves.size[:, None] / 2)
    about = blind & (np.abs(middle - [15.0, 15.0, 2.15]) < [10.0, 10.0, 0.8]).all(axis=1)
    assert about.any()
    assert field.hide(leaves, 0.1)[0][about].all()
    assert not field.hide(leaves, 0.2)[0][about].any()
