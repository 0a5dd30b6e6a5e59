# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import samples
from volfrep.grid.activation import active_cells, crossed_cells, make_grid
from volfrep.grid.cell_grid import CellGrid
from volfrep.mesh.triangle_mesh import concatenate
from volfrep.spatial.rays import column_crossings, inside_grid, inside_points
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.progress import Monitor


def grid_at(low, size, shape):
    return CellGrid(np.asarray(low, float), size, shape)


def test_grid_covers_the_box_from_its_lowest_corner():
    grid = make_grid(np.array([[1.0, 2.0, 3.0], [41.0, 31.9, 23.1]]), 10.0)
    assert grid.shape == (4, 3, 3)
    np.testing.assert_array_equal(grid.origin, [1.0, 2.0, 3.0])
    assert grid.cells == 36


def test_grid_through_an_origin_is_aligned_and_covers_the_box():
    bounds = np.array([[0.0, 0.0, 0.0], [40.0, 30.0, 20.0]])
    for origin in [(5.0, 5.0, 5.0), (-103.0, 47.0, 1000.0), (0.0, 0.0, 0.0)]:
        grid = make_grid(bounds, 10.0, origin)
        steps = (np.array(origin) - grid.origin) / 10.0
        np.testing.assert_allclose(steps, np.round(steps), atol=1e-9)
        top = grid.origin + 10.0 * np.array(grid.shape)
        assert (grid.origin <= 1e-9).all()
        assert (top >= bounds[1] - 1e-9).all()
        assert (grid.origin > -10.0 + 1e-6).all()
        assert (top < bounds[1] + 10.0 - 1e-6).all()
    assert make_grid(bounds, 10.0, (10.0, 20.0, 30.0)).shape == (4, 3, 2)


def test_a_grid_beyond_memory_is_refused():
    with pytest.raises(VolfrepError, match="enlarge the cells"):
        make_grid(np.array([[0.0, 0.0, 0.0], [1e3, 1e3, 1e3]]), 0.1)


def test_a_box_of_whole_cells_activates_exactly_its_cells():
    grid = grid_at([-10.0, -10.0, -10.0], 10.0, (6, 5, 4))
    expected = np.zeros(grid.shape, bool)
    expected[1:-1, 1:-1, 1:-1] = True
    for rule in ("touching", "centre"):
        active = active_cells(grid, samples.box(), rule, Monitor())
        np.testing.assert_array_equal(active, expected)


def test_a_sliver_of_volume_activates_a_cell():
    grid = grid_at([0.0, 0.0, 0.0], 10.0, (5, 3, 2))
    part = samples.box((40.01, 30.0, 20.0))
    assert active_cells(grid, part, "touching", Monitor())[4].all()
    assert not active_cells(grid, part, "centre", Monitor())[4].any()


def test_a_part_inside_one_cell_activates_it():
    grid = grid_at([0.0, 0.0, 0.0], 10.0, (3, 3, 3))
    active = active_cells(
        grid, samples.box((1.0, 1.0, 1.0), (12.0, 12.0, 12.0)), "touching", Monitor()
    )
    assert active.sum() == 1
    assert active[1, 1, 1]


@pytest.mark.parametrize(
    ("part", "inside"),
    [
        (samples.plate(), samples.inside_plate),
        (samples.bracket(), samples.inside_bracket),
        (samples.bracket(33.0), lambda p: samples.inside_bracket(p, 33.0)),
    ],
    ids=["plate", "bracket", "turned bracket"],
)
@pytest.mark.parametrize("size", [2.3, 7.0, 25.0])
def test_activation_agrees_with_monte_carlo(part, inside, size):
    grid = make_grid(part.bounds, size)
    touching = active_cells(grid, part, "touching", Monitor())
    random = np.random.default_rng(5)
    points = grid.origin + random.random((400_000, 3)) * size * np.array(grid.shape)
    cell = tuple(((points - grid.origin) / size).astype(int).T)
    hit = inside(points)
    assert touching[cell][hit].all()
    # And nothing is active far from the part: every active cell has a point of the part in it,
    # or is one of the few whose overlap is too small to be sampled.
    seen = np.zeros(grid.shape, bool)
    seen[tuple(index[hit] for index in cell)] = True
    unseen = touching & ~seen
    assert unseen.sum() <= max(0.08 * touching.sum(), 1)
    centre = active_cells(grid, part, "centre", Monitor())
    middles = np.stack(np.meshgrid(*(grid.centres(k) for k in range(3)), indexing="ij"), axis=-1)
    exact = inside(middles.reshape(-1, 3)).reshape(grid.shape)
    assert not (centre & ~touching).any()
    assert (exact & ~centre).sum() <= 1  # a lonely cell is dropped
    assert (centre & ~exact).sum() == 0


def test_cells_at_a_wall_are_the_same_of_many_calls(monkeypatch):
    """A call looks at a few triangles of the wall, which lie in many cells."""
    part = samples.bracket(turn=20.0)
    low, high = part.bounds
    grid = make_grid(np.array([low - 1.0, high + 1.0]), 0.9)
    corners = part.vertices[part.triangles]
    at_once = crossed_cells(grid, corners, Monitor())
    monkeypatch.setattr("volfrep.grid.activation.CALL_PAIRS", 1_000)
    np.testing.assert_array_equal(crossed_cells(grid, corners, Monitor()), at_once)
    # Of its area there is one cell for every L^2, and two to three where it is tilted.
    assert 1.0 < at_once.sum() * 0.9**2 / part.area < 3.0


def test_a_lonely_cell_is_dropped_under_the_centre_rule():
    grid = grid_at([0.0, 0.0, 0.0], 10.0, (8, 3, 3))
    two = concatenate(
        samples.box((20.0, 10.0, 10.0), (0.0, 10.0, 10.0)),
        samples.box((10.0, 10.0, 10.0), (50.0, 10.0, 10.0)),
    )
    assert active_cells(grid, two, "touching", Monitor()).sum() == 3
    kept = active_cells(grid, two, "centre", Monitor())
    assert np.argwhere(kept).tolist() == [[0, 1, 1], [1, 1, 1]]
    diagonal = concatenate(
        samples.box((10.0, 10.0, 10.0), (0.0, 0.0, 0.0)),
        samples.box((10.0, 10.0, 10.0), (10.0, 10.0, 10.0)),
    )
    assert active_cells(grid, diagonal, "centre", Monitor()).sum() == 2


def test_the_wing_of_the_paper():
    wing = samples.naca2412()
    grid = make_grid(wing.bounds, 20.0)
    assert grid.shape == (51, 7, 50)
    touching = active_cells(grid, wing, "touching", Monitor()).mean()
    centre = active_cells(grid, wing, "centre", Monitor()).mean()
    # The paper prints 72.3 %; a section has 357 cells, so one more or less is 0.28 %.
    assert touching == pytest.approx(0.723, abs=0.012)
    assert 0.5 < centre < touching


def test_lines_through_vertices_and_edges_balance():
    # Every column runs along vertices, edges or faces of the boxes.
    part = concatenate(samples.box((4.0, 4.0, 4.0)), samples.box((4.0, 4.0, 4.0), (4.0, 4.0, 1.0)))
    xs = ys = np.arange(-1.0, 10.0)
    i, j, z, step = column_crossings(part, xs, ys, Monitor())
    balance = np.zeros((len(xs), len(ys)))
    np.add.at(balance, (i, j), step)
    assert (balance == 0).all()
    assert len(z)
    inside = inside_grid(part, xs, ys, np.array([-0.5, 0.5, 2.5, 4.5, 6.0]), Monitor())
    assert inside[2, 2].tolist() == [False, True, True, False, False]
    assert inside[6, 6].tolist() == [False, False, True, True, False]
    assert inside.sum(axis=(0, 1)).tolist() == [0, 16, 32, 16, 0]


def test_overlapping_bodies_count_as_inside():
    part = concatenate(samples.box(), samples.box((40.0, 30.0, 20.0), (10.0, 10.0, 5.0)))
    middle = inside_grid(part, np.array([20.5]), np.array([15.5]), np.array([10.5]), Monitor())
    assert middle.all()


def test_cancel_is_honoured():
    with pytest.raises(Cancelled):
        active_cells(
            make_grid(samples.box().bounds, 5.0),
            samples.box(),
            "touching",
            Monitor(lambda fraction, name: False),
        )


def test_an_unknown_rule_is_refused():
    grid = make_grid(samples.box().bounds, 5.0)
    with pytest.raises(VolfrepError, match="choose touching, centre or inside"):
        active_cells(grid, samples.box(), "some", Monitor())


@pytest.mark.costly
def test_scattered_points_inside():
    plate = samples.plate()
    points = np.random.default_rng(1).uniform((-5, -5, -5), (65, 45, 17), (20_000, 3))
    near_a_wall = samples.inside_plate(points, -0.05) & ~samples.inside_plate(points, 0.05)
    points = points[~near_a_wall]
    np.testing.assert_array_equal(
        inside_points(plate, points, Monitor()), samples.inside_plate(points)
    )


def test_scattered_points_above_vertices_and_edges():
    bracket = samples.bracket(30.0)
    axes = [np.linspace(low, high, 9) for low, high in bracket.bounds.T]
    nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    below = bracket.vertices - np.array([0.0, 0.0, 99.0])
    nodes = np.concatenate([nodes, bracket.vertices, below])
    expected = inside_grid(bracket, *axes, Monitor()).ravel()
    found = inside_points(bracket, nodes, Monitor())
    np.testing.assert_array_equal(found[: len(expected)], expected)
    assert not found[-len(bracket.vertices) :].any()
    assert not inside_points(bracket, np.zeros((0, 3)), Monitor()).any()
