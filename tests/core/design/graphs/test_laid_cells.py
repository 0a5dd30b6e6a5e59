# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells laid into hexahedra, along a function, and in layers upon quadrilaterals."""

import numpy as np
import pytest

import samples
from volfrep.design.cells import LIBRARY, find_cell
from volfrep.design.graphs.conformal_cells import (
    CORNERS,
    layers_on,
    place_cells_along,
    place_cells_into,
)
from volfrep.spatial.proximity import closest_points
from volfrep.util.errors import VolfrepError

#: The numbers of a cube's corners, the cube turned about x by a right angle.
TURNED = [3, 2, 6, 7, 0, 1, 5, 4]
#: Cells that have an axis or a hand of their own.
HANDED = {"Kagome", "Columns", "BCCz", "FCCz", "Laves", "Vintiles", "Weaire-Phelan", "Re-entrant"}


def grid(count: tuple[int, int, int], size: float = 10.0) -> tuple[np.ndarray, np.ndarray]:
    """Corners and hexahedra of a box of cubes that share no corner."""
    at = np.stack(np.meshgrid(*map(np.arange, count), indexing="ij"), axis=-1).reshape(-1, 3)
    corners = size * (at[:, None] + CORNERS).reshape(-1, 3)
    return corners, np.arange(len(corners)).reshape(-1, 8)


def tube(turns: float, inner: float, outer: float, height: float):
    """A function that bends a grid to a sector of a tube."""

    def place(q: np.ndarray) -> np.ndarray:
        angle = 2.0 * np.pi * turns * q[:, 0]
        radius = inner + (outer - inner) * q[:, 2]
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), height * q[:, 1]], axis=1)

    return place


@pytest.mark.parametrize("name", sorted(LIBRARY))
def test_cells_in_cubes_are_the_cells_of_a_grid(name: str) -> None:
    cell = LIBRARY[name]
    made = place_cells_into(cell, *grid((2, 2, 2)))
    step = place_cells_along(cell, lambda q: 20.0 * q, (2, 2, 2))
    assert len(made.nodes) == len(step.nodes)
    assert len(made.struts) == len(step.struts)
    ends = [
        {frozenset(map(tuple, np.round(net.nodes[pair], 6) + 0.0)) for pair in net.struts}
        for net in (made, step)
    ]
    assert ends[0] == ends[1]


@pytest.mark.parametrize("name", sorted(LIBRARY))
def test_a_cell_that_looks_alike_from_all_sides_fits_a_turned_neighbour(name: str) -> None:
    corners, boxes = grid((2, 1, 1))
    boxes[1] = boxes[1][TURNED]
    if name in HANDED:
        with pytest.raises(VolfrepError, match="does not fit itself"):
            place_cells_into(LIBRARY[name], corners, boxes)
    else:
        straight = place_cells_into(LIBRARY[name], *grid((2, 1, 1)))
        # A diamond has every second corner: turned cells share those that straight ones do not.
        assert len(place_cells_into(LIBRARY[name], corners, boxes).nodes) <= len(straight.nodes)


def test_a_hexahedron_and_its_mirror_image_serve_and_a_folded_one_does_not() -> None:
    cell = find_cell("BCC")
    mirrored = 10.0 * CORNERS * [1.0, 1.0, -1.0]
    assert len(place_cells_into(cell, mirrored, [range(8)]).struts) == 20
    folded = 10.0 * CORNERS.astype(float)
    folded[6] = [1.0, 1.0, 1.0]
    with pytest.raises(VolfrepError, match=r"hexahedron 0 at .* is folded"):
        place_cells_into(cell, folded, [range(8)])


def test_a_closed_tube_joins_where_it_comes_round() -> None:
    cell = find_cell("Box")
    made = place_cells_along(cell, tube(1.0, 10.0, 15.0, 30.0), (12, 6, 1))
    # Of a ring of 12 x 6 x 1 boxes: nodes 12 x 7 x 2.
    assert len(made.nodes) == 12 * 7 * 2
    assert len(made.struts) == 12 * 7 * 2 + 12 * 6 * 2 + 12 * 7
    radius = np.hypot(made.nodes[:, 0], made.nodes[:, 1])
    assert set(np.round(radius, 9)) == {10.0, 15.0}


def test_every_node_of_a_tubes_outer_layer_lies_on_it() -> None:
    made = place_cells_along(find_cell("Octet"), tube(0.25, 20.0, 30.0, 40.0), (4, 4, 2))
    radius = np.hypot(made.nodes[:, 0], made.nodes[:, 1])
    assert radius.min() == pytest.approx(20.0, abs=1e-12)
    assert radius.max() == pytest.approx(30.0, abs=1e-12)
    # Octet has a node in the middle of every face, which a chord would miss.
    assert (np.abs(radius - 30.0) < 1e-12).sum() == 5 * 5 + 4 * 4


def test_the_nodes_of_a_layer_in_a_wing_lie_on_its_skin_and_as_deep_below() -> None:
    chord, deep = 200.0, 5.0
    wing = samples.naca2412(chord, 60.0, points=400)

    def skin(x: np.ndarray) -> np.ndarray:
        """(n, 2) places of the upper side, of the NACA 2412 of chord 1."""
        half = 0.6 * (
            0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4
        )
        front = x < 0.4
        camber = np.where(front, 0.125 * (0.8 * x - x**2), (0.2 + 0.8 * x - x**2) / 18.0)
        angle = np.arctan(np.where(front, 0.25 * (0.4 - x), (0.8 - 2.0 * x) / 18.0))
        return np.stack([x - half * np.sin(angle), camber + half * np.cos(angle)], axis=1)

    def place(q: np.ndarray) -> np.ndarray:
        share = 0.15 + 0.5 * q[:, 0]
        way = skin(share + 1e-6) - skin(share - 1e-6)
        way /= np.linalg.norm(way, axis=1)[:, None]
        inward = np.stack([way[:, 1], -way[:, 0]], axis=1)
        flat = chord * skin(share) + deep * q[:, 2:] * inward
        return np.concatenate([flat, 10.0 + 40.0 * q[:, 1:2]], axis=1)

    laid = place_cells_along(find_cell("BCC"), place, (20, 8, 1))
    away = closest_points(wing, laid.nodes)[1]
    assert (away < 0.01).sum() == 21 * 9  # the corners on the skin: its facets are chords
    np.testing.assert_allclose(away[away > 0.75 * deep], deep, atol=0.02)
    assert (away > 0.75 * deep).sum() == 21 * 9


def test_layers_stand_upon_quadrilaterals_along_their_normals() -> None:
    steps = np.linspace(0.0, np.pi / 2.0, 7)
    arc = np.stack([20.0 * np.cos(steps), 20.0 * np.sin(steps)], axis=1)
    corners = np.array([[x, y, z] for z in (0.0, 10.0, 20.0) for x, y in arc])
    first = np.array([7 * row + k for row in range(2) for k in range(6)])
    quads = np.stack([first, first + 1, first + 8, first + 7], axis=1)
    made = layers_on(find_cell("Box"), corners, quads, 6.0, 3)
    assert len(made.nodes) == 21 * 4
    radius = np.hypot(made.nodes[:, 0], made.nodes[:, 1])
    assert np.round(sorted(set(np.round(radius, 1))), 1).tolist() == [20.0, 22.0, 24.0, 26.0]
    inward = layers_on(find_cell("Box"), corners, quads, -6.0, 3)
    assert np.hypot(inward.nodes[:, 0], inward.nodes[:, 1]).min() == pytest.approx(14.0, abs=0.1)
    quads[3] = quads[3][::-1]
    with pytest.raises(VolfrepError, match="turned the same way"):
        layers_on(find_cell("Box"), corners, quads, 6.0)
    with pytest.raises(VolfrepError, match="need a thickness"):
        layers_on(find_cell("Box"), corners, quads, 0.0)


def test_a_function_that_draws_a_cell_together_is_refused() -> None:
    with pytest.raises(VolfrepError, match="draws a cell together"):
        place_cells_along(find_cell("Box"), tube(0.5, 0.0, 10.0, 10.0), (4, 1, 1))
    with pytest.raises(VolfrepError, match="choose another cell size"):
        place_cells_along(find_cell("Octet"), tube(0.5, 1.0, 10.0, 10.0), (400, 400, 1))
