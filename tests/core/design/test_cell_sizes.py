# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells, and random points, as large as a function of places says."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import trimesh

import volfrep
from volfrep.api import specified
from volfrep.design.cell_sizes import cells_by, points_by
from volfrep.design.sampled_field import sample_function
from volfrep.design.scattered_field import PointField
from volfrep.grid.coordinate_map import lattice_map

BOX = np.array([[0.0, 0, 0], [60, 20, 20]])
PLACES = np.random.default_rng(3).uniform(BOX[0], BOX[1], (400, 3))


def borders(value: Any, axis: int = 0) -> np.ndarray:
    """Where cells begin and end along an axis of the box."""
    spec = specified(None, {"cell": "BCC", "cell_size": value}, None, lambda size: BOX)
    mapping = lattice_map(spec.cell_size, BOX, spec.size_grading, None, None)
    count = round(np.ptp(BOX[:, axis]) / spec.cell_size)
    at = np.zeros((count + 1, 3))
    at[:, axis] = spec.cell_size * np.arange(count + 1)
    return mapping.to_part(at)[:, axis]


@pytest.mark.parametrize(
    "value",
    [
        lambda at: 3.0 + at[:, 0] / 10.0,
        "3 + x / 10",
        (PLACES, 3.0 + PLACES[:, 0] / 10.0),
        ([[0, 0, 0], [60, 0, 0]], [3, 9]),
    ],
    ids=["function", "formula", "points", "two"],
)
def test_a_cell_is_as_long_as_is_said_where_it_lies(value: Any) -> None:
    found = borders(value)
    assert found[[0, -1]] == pytest.approx((0.0, 60.0))
    wanted = 3.0 + 0.5 * (found[1:] + found[:-1]) / 10.0
    # A whole number of cells makes all longer or shorter alike.
    ratio = np.diff(found) / wanted
    assert ratio == pytest.approx(ratio.mean(), rel=0.01)
    assert ratio.mean() == pytest.approx(1.0, abs=0.05)


def test_cells_may_grow_and_shrink_again_and_by_steps() -> None:
    lengths = np.diff(borders("4 + 4 * sin(pi * x / 60)"))
    assert lengths.argmax() in (len(lengths) // 2, len(lengths) // 2 - 1)
    assert lengths == pytest.approx(lengths[::-1], rel=1e-3)
    steps = np.diff(borders(lambda at: np.where(at[:, 0] < 30, 3.0, 6.0)))
    assert steps[:9] == pytest.approx(steps[0], rel=1e-3)
    assert steps[-1] / steps[0] == pytest.approx(2.0, rel=1e-3)


def test_the_direction_is_found() -> None:
    for formula, way in (("5 - z / 10", (0, 0, 1)), ("4 + (x + y) / 20", (0.5**0.5, 0.5**0.5, 0))):
        grading, _ = cells_by(sample_function(formula, BOX, 1.0, "cell_size"), BOX)
        assert grading is not None
        assert grading.direction == pytest.approx(way, abs=1e-6)


def test_a_size_that_is_the_same_everywhere_is_a_size() -> None:
    assert cells_by(sample_function("0 * x + 7", BOX, 1.0, "cell_size"), BOX) == (None, 7.0)


def test_what_varies_across_every_direction_is_refused_with_how_much() -> None:
    hot = sample_function(lambda at: np.where(at[:, 0] ** 2 + at[:, 1] ** 2 < 90, 3.0, 6.0),
                          BOX, 1.0, "cell_size")  # fmt: skip
    with pytest.raises(volfrep.VolfrepError, match=r"differs by up to \d+% across .*voronoi"):
        cells_by(hot, BOX)
    radial = PointField(PLACES, 2.0 + np.linalg.norm(PLACES[:, 1:] - 10.0, axis=1))
    with pytest.raises(volfrep.VolfrepError, match="differs by up to"):
        cells_by(radial, BOX)


def test_random_points_lie_as_far_apart_as_is_said_anywhere() -> None:
    density, size = points_by(sample_function("2 + x / 30 + y / 20", BOX, 1.0, "cell_size"), BOX)
    assert density is not None
    for place in ((1.0, 1, 1), (30.0, 10, 3), (59.0, 19, 10)):
        wanted = 2.0 + place[0] / 30.0 + place[1] / 20.0
        assert size * density([place])[0] ** (-1.0 / 3.0) == pytest.approx(wanted, rel=2e-3)
    made = specified(None, {"network": "voronoi", "cell_size": "3 + x / 20"}, None, lambda s: BOX)
    assert made.size_grading is None
    low, high = made.network.formula(np.array([0.0, 1.0]))
    assert (high / low) ** (1.0 / 3.0) == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"cell_size": "x - 5"}, "must be above 0 mm"),
        ({"cell_size": "5 + x", "size_grading": "linear", "lambda_end": 2.0}, "'size_grading' out"),
        ({"cell_size": "5 + x", "network": "voronoi", "network_density": "1 + s"}, "density' out"),
    ],
)
def test_what_makes_no_sense_is_a_sentence(given: dict[str, Any], message: str) -> None:
    with pytest.raises(volfrep.VolfrepError, match=message):
        specified(None, given, None, lambda size: BOX)


@pytest.mark.costly
def test_a_part_a_sheet_and_a_graph_are_filled_so() -> None:
    box = trimesh.creation.box(bounds=((0, 0, 0), (24, 12, 12)))
    even: dict[str, Any] = {"shell": 1.0, "resolution": 8}
    part = volfrep.fill(box, cell="BCC", cell_size="4 + x / 6", strut_radius=0.6, **even)
    shortest, longest = part.report.cell_edges_mm
    assert shortest < 5.2
    assert longest > 6.5
    sheet = volfrep.fill(box, cell="Gyroid", cell_size="5 + x / 5", wall_thickness=0.8, **even)
    assert sheet.report.watertight
    with pytest.raises(volfrep.VolfrepError, match="'size_grading', or 'fill' a box"):
        volfrep.block((2, 2, 2), cell="BCC", cell_size="4 + x")
    with pytest.raises(volfrep.VolfrepError, match="no entry in a file"):
        volfrep.write_spec(part.spec, "spec.toml")


def test_points_are_as_many_as_are_asked_for_however_they_crowd() -> None:
    from volfrep.design.graphs import RandomGraph
    from volfrep.graphs.random_graph import _points
    from volfrep.spatial.rays import inside_points
    from volfrep.util.progress import Monitor

    solid = volfrep.as_solid(trimesh.creation.box((20, 20, 20)))
    wanted = RandomGraph(points=200, density="step(0.7, s) + 0.01")
    points, _ = _points(wanted, solid, 5.0, lambda at: 10.0 - np.abs(at).max(axis=1), Monitor(None))
    assert inside_points(solid, points, Monitor(None)).sum() == 200
