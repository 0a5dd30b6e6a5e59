# SPDX-License-Identifier: LGPL-2.1-or-later
"""Unit cells from drawn lines: what becomes a node and a strut, and what is said about it."""

from pathlib import Path

import numpy as np
import pytest

from volfrep.design.cells import LIBRARY, PAPERS, UnitCell, load_cell
from volfrep.design.drawn_cell import cell_from_lines, save_cell
from volfrep.util.errors import VolfrepError


def lines_of(cell: UnitCell, size: float = 1.0, corner: tuple[float, ...] = (0, 0, 0)):
    return size * cell.nodes[cell.struts] + np.array(corner)


def strut_set(cell: UnitCell) -> set[frozenset[tuple[float, ...]]]:
    ends = np.round(cell.nodes[cell.struts], 6) + 0.0
    return {frozenset(map(tuple, pair)) for pair in ends.tolist()}


@pytest.mark.parametrize("name", PAPERS)
def test_a_library_cell_drawn_anywhere_comes_back(name: str) -> None:
    lines = lines_of(LIBRARY[name], 7.3, (120.1, -35.7, 3.9))
    noisy = lines + np.random.default_rng(1).uniform(-2e-6, 2e-6, lines.shape)
    drawn = cell_from_lines("mine", noisy)
    assert strut_set(drawn.cell) == strut_set(LIBRARY[name])
    assert drawn.cell.name == "mine"
    assert drawn.size == pytest.approx(7.3, abs=1e-5)
    np.testing.assert_allclose(drawn.origin, (120.1, -35.7, 3.9), atol=1e-5)
    assert drawn.warnings == ()
    outer = drawn.cell.nodes[(drawn.cell.nodes == 0) | (drawn.cell.nodes == 1)]
    assert len(outer), "nodes on the cube's faces lie on them exactly"


def test_lines_that_cross_or_touch_are_joined_there() -> None:
    diagonals = np.array([[[0, 0, 0], [10, 10, 10]], [[10, 0, 0], [0, 10, 10]]], float)
    crossed = cell_from_lines("X", diagonals).cell
    assert (len(crossed.nodes), len(crossed.struts)) == (5, 4)
    assert [0.5, 0.5, 0.5] in crossed.nodes.tolist()
    tee = np.array([[[0, 0, 0], [10, 0, 0]], [[5, 0, 0], [5, 10, 0]]], float)
    touched = cell_from_lines("T", tee).cell
    assert (len(touched.nodes), len(touched.struts)) == (4, 3)


def test_what_is_drawn_twice_is_one_strut() -> None:
    once = np.array([[[0, 0, 0], [10, 0, 0]], [[0, 0, 0], [0, 0, 10]]], float)
    over = np.array([[[10, 0, 0], [0, 0, 0]], [[0, 0, 0], [5, 0, 0]]], float)
    cell = cell_from_lines("L", np.concatenate([once, over])).cell
    assert strut_set(cell) == {
        frozenset({(0.0, 0.5, 0.0), (0.5, 0.5, 0.0)}),
        frozenset({(0.5, 0.5, 0.0), (1.0, 0.5, 0.0)}),
        frozenset({(0.0, 0.5, 0.0), (0.0, 0.5, 1.0)}),
    }


def test_lines_that_pass_each_other_are_not_joined() -> None:
    passing = np.array([[[0, 5, 0], [10, 5, 0]], [[5, 0, 10], [5, 10, 10]]], float)
    cell = cell_from_lines("skew", passing).cell
    assert (len(cell.nodes), len(cell.struts)) == (4, 2)


def test_a_flat_drawing_is_in_the_middle_of_its_cube_and_says_so() -> None:
    square = np.array([[0, 0, 4], [10, 0, 4], [10, 10, 4], [0, 10, 4], [0, 0, 4]], float)
    drawn = cell_from_lines("square", np.stack([square[:-1], square[1:]], axis=1))
    assert drawn.size == 10.0
    np.testing.assert_allclose(drawn.origin, (0, 0, -1))
    assert set(drawn.cell.nodes[:, 2]) == {0.5}
    assert len(drawn.warnings) == 1
    assert "do not meet along z" in drawn.warnings[0]


def test_a_node_without_counterpart_is_named() -> None:
    lines = np.array([[[0, 2, 5], [10, 5, 5]], [[10, 5, 5], [10, 0, 0]], [[10, 5, 5], [5, 10, 10]]])
    said = " ".join(cell_from_lines("odd", lines.astype(float)).warnings)
    assert "1 of the nodes on the face x = 0 has no counterpart" in said
    assert "first the one at (0, 0.2, 0.5) L" in said
    assert "2 of the nodes on the face x = 1 have no counterpart" in said


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (np.zeros((0, 2, 3)), "There is no line to make a cell of"),
        (np.zeros((1, 2, 3)), r"The line at \(0, 0, 0\) mm has no length"),
        (np.array([[[0, 0, 0], [1, 1, 1]], [[2, 2, 3], [2, 2, 3]]], float), r"at \(2, 2, 3\) mm"),
        (np.random.default_rng(1).uniform(size=(2001, 2, 3)), "2,001 lines are too many"),
    ],
)
def test_what_cannot_be_a_cell(lines: np.ndarray, message: str) -> None:
    with pytest.raises(VolfrepError, match=message):
        cell_from_lines("bad", lines)


def test_a_saved_cell_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "cell.json"
    drawn = cell_from_lines('Böse "Zelle"', lines_of(LIBRARY["Octet"], 3.0)).cell
    save_cell(drawn, path)
    again = load_cell(path)
    assert again.name == 'Böse "Zelle"'
    np.testing.assert_allclose(again.nodes, drawn.nodes, atol=1e-9)
    np.testing.assert_array_equal(again.struts, drawn.struts)
    with pytest.raises(VolfrepError, match="there is no folder"):
        save_cell(drawn, tmp_path / "nowhere" / "cell.json")
