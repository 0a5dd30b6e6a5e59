# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stiffness matrices of blocks: summed, ordered, solved, and known when they are not definite."""

import numpy as np
import pytest

from volfrep.sizing import block_matrix
from volfrep.sizing.block_matrix import BlockPattern, definite, factorise
from volfrep.util.errors import VolfrepError

#: Nodes on a grid of 4 x 4 x 4, a spring of six by six between neighbours.
PLACES = np.stack(np.meshgrid(*[np.arange(4.0)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
PAIRS = np.array(
    [(i, j) for i in range(64) for j in range(i) if np.abs(PLACES[i] - PLACES[j]).sum() == 1]
)
ROWS = np.concatenate([PAIRS[:, 0], PAIRS[:, 0], PAIRS[:, 1], PAIRS[:, 1]])
COLUMNS = np.concatenate([PAIRS[:, 0], PAIRS[:, 1], PAIRS[:, 0], PAIRS[:, 1]])
#: The first node is held.
HELD = np.zeros((64, 6), bool)
HELD[0] = True


def springs(stiffness):
    """Contributions of springs of these stiffnesses (p, 6, 6)."""
    return np.concatenate([stiffness, -stiffness, -stiffness, stiffness])


def stiffnesses(seed=0):
    half = np.random.default_rng(seed).normal(size=(len(PAIRS), 6, 6))
    return half @ half.swapaxes(1, 2) + np.eye(6)


def dense(blocks):
    """The same matrix, node by node."""
    full = np.zeros((64, 64, 6, 6))
    np.add.at(full, (ROWS, COLUMNS), blocks)
    return full.swapaxes(1, 2).reshape(384, 384)


@pytest.fixture(params=["SuperLU", "CHOLMOD"])
def solver(request, monkeypatch):
    """Both ways to factor a matrix, of which an installation has one or two."""
    if request.param == "SuperLU":
        monkeypatch.setattr(block_matrix, "_cholmod", lambda: None)
    elif block_matrix._cholmod() is None:
        pytest.skip("scikit-sparse 0.4 is not installed")
    return request.param


def test_contributions_that_stay_add_to_those_that_change():
    blocks = springs(stiffnesses())
    whole = BlockPattern(PLACES, ROWS, COLUMNS, len(ROWS)).matrix(blocks)
    for changing in (0, len(PAIRS), 3 * len(PAIRS)):
        pattern = BlockPattern(PLACES, ROWS, COLUMNS, changing)
        constant = pattern.constant(blocks[changing:])
        parted = pattern.matrix(blocks[:changing], constant)
        assert np.allclose(parted.toarray(), whole.toarray(), rtol=0, atol=1e-12)


def test_displacements_are_those_of_the_full_matrix(solver):
    blocks = springs(stiffnesses())
    pattern = BlockPattern(PLACES, ROWS, COLUMNS, len(ROWS))
    loads = np.random.default_rng(1).normal(size=(64, 6, 3))
    found = factorise(pattern, pattern.matrix(blocks), HELD).displacements(loads)
    expected = np.linalg.solve(dense(blocks)[6:, 6:], loads[1:].reshape(378, 3))
    assert np.abs(found[0]).max() == 0.0
    assert np.allclose(found[1:].reshape(378, 3), expected, rtol=1e-9)


def test_what_nothing_holds_is_refused(solver):
    pattern = BlockPattern(PLACES, ROWS, COLUMNS, len(ROWS))
    matrix = pattern.matrix(springs(stiffnesses()))

    def solve():
        nothing = np.zeros((64, 6), bool)
        return factorise(pattern, matrix, nothing).displacements(np.ones((64, 6, 1)))

    with pytest.raises(VolfrepError, match="can move freely"):
        solve()


def test_a_matrix_is_definite_until_its_lowest_eigenvalue_is_negative(solver):
    pattern = BlockPattern(PLACES, ROWS, COLUMNS, len(ROWS))
    factored = factorise(pattern, pattern.matrix(springs(stiffnesses())), HELD)
    lowest = np.linalg.eigvalsh(factored.matrix.toarray()).min()
    shifted = factored.matrix.copy()
    for share, is_definite in ((0.99, True), (1.01, False), (50.0, False)):
        shifted.data = factored.matrix.data.copy()
        shifted.setdiag(factored.matrix.diagonal() - share * lowest)
        solve = definite(shifted)
        assert (solve is not None) == is_definite
        if solve is not None:
            right = np.ones(384)
            assert np.allclose(shifted @ solve(right), right, atol=1e-6)
