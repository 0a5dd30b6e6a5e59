# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts of a surface are joined at the vertices that both have, and at no others."""

import numpy as np
import pytest

from volfrep.trim import trimmed_surface
from volfrep.trim.trimmed_surface import equal_rows

#: Of cells that repeat: where the first hash of these points was at a loss.
REPEATED = np.array(
    [
        [-27.735274293336868, 8.84580461098671, 0.8006799523162842],
        [20.264725706663132, -15.15419538901329, 0.8006799523162842],
        [-27.735274293336868, -15.15419538901329, 0.8006799523162842],
        [20.264725706663132, 8.84580461098671, 0.8006799523162842],
    ]
)


@pytest.mark.parametrize("points", [REPEATED, REPEATED * [-1, -1, 1], REPEATED[:, [2, 0, 1]]])
def test_points_of_cells_that_repeat_are_found(points):
    assert equal_rows(points, points[::-1]).tolist() == [3, 2, 1, 0]
    assert equal_rows(points[:2], points[2:]).tolist() == [-1, -1]


def test_points_of_cells_that_repeat_differ_in_their_numbers():
    steps = np.stack(np.meshgrid(*[np.arange(-12, 12)] * 3, indexing="ij"), axis=-1)
    points = 4.0 * steps.reshape(-1, 3) + REPEATED[0]
    both = np.concatenate([points, points * [-1.0, -1.0, 1.0]])
    assert len(np.unique(trimmed_surface.hash_points(both))) == len(both)


def test_points_of_one_number_are_told_apart(monkeypatch):
    monkeypatch.setattr(
        trimmed_surface, "hash_points", lambda points: np.full(len(points), 7, np.uint64)
    )
    points = np.concatenate([REPEATED, [[1.0, 2.0, 3.0]]])
    assert equal_rows(points, REPEATED[[2, 0, 3, 1]]).tolist() == [1, 3, 0, 2, -1]


def test_both_zeros_are_one_number():
    assert equal_rows(np.array([[0.0, -0.0, 1.0]]), np.array([[-0.0, 0.0, 1.0]])).tolist() == [0]


def test_nothing_is_found_among_nothing():
    assert equal_rows(REPEATED, np.zeros((0, 3))).tolist() == [-1] * 4
