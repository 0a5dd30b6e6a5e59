# SPDX-License-Identifier: LGPL-2.1-or-later
"""Symmetric sparse matrices of 6 x 6 blocks, a block for each pair of nodes, and their solution.

The pattern is found once; a new set of radii only fills in numbers. Nodes are numbered by nested
dissection of their places (A. George, SIAM J. Numer. Anal. 10, 1973), with which a frame of
16,000 struts is factored twice as fast as with scipy's own orderings.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from types import ModuleType

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import SuperLU, splu

from ..util.errors import VolfrepError
from ..util.types import Bools, Floats, Ints

#: A set of so few nodes is not divided any further.
_LEAF = 24
#: A solution that leaves less than this part of the loads is one.
_UNSOLVED = 1e-4
#: Where more is left, as between rows of very different stiffness, it is one when its error has
#: less than this part of its strain energy; where something moves freely, that has all of it.
_UNCERTAIN = 1e-6


def nested_dissection(places: Floats, pairs: Ints) -> Ints:
    """(n,) nodes in the order of elimination: two halves, then the nodes between them, and so on.

    Args:
        places: (n, 3) of the nodes.
        pairs: (p, 2) nodes that share a block.
    """
    count = len(places)
    both = np.concatenate([pairs, pairs[:, ::-1]])
    near = sparse.csr_matrix(
        (np.ones(len(both), np.int8), (both[:, 0], both[:, 1])), shape=(count, count)
    )
    near.data[:] = 1
    marked = np.zeros(count, np.int8)

    def touching(some: Ints, others: Ints) -> Bools:
        marked[others] = 1
        found: Bools = (near[some] @ marked) > 0
        marked[others] = 0
        return found

    waiting, ordered = [np.arange(count)], []
    while waiting:  # from the last to be eliminated to the first
        some = waiting.pop()
        if len(some) <= _LEAF:
            ordered.append(some)
            continue
        where = places[some, np.argmax(np.ptp(places[some], axis=0))]
        middle = np.median(where)
        is_low = where < middle if (where < middle).any() else where <= middle
        low, high = some[is_low], some[~is_low]
        if not len(high):
            ordered.append(some)
            continue
        of_low, of_high = touching(low, high), touching(high, low)
        if of_low.sum() < of_high.sum():
            between, low = low[of_low], low[~of_low]
        else:
            between, high = high[of_high], high[~of_high]
        ordered.append(between)
        waiting += [low, high]
    return np.concatenate(ordered[::-1])


class BlockPattern:
    """Where a symmetric matrix of n x n blocks has numbers, and how it is made of contributions.

    Args:
        places: (n, 3) of the nodes, by which they are ordered; mm.
        rows, columns: (c,) int64 the block that each contribution goes to; for what is not on the
            diagonal the mirrored block must be among them, too.
        changing: how many of the contributions, from the first on, have other numbers in every
            matrix; the rest is summed once, by `constant`.
    """

    def __init__(self, places: Floats, rows: Ints, columns: Ints, changing: int) -> None:
        self.count = len(places)
        beside = rows < columns
        order = nested_dissection(places, np.stack([rows[beside], columns[beside]], axis=1))
        self._order = order
        self._place = np.empty(self.count, np.int64)
        self._place[order] = np.arange(self.count)
        # Every diagonal block is there, whether or not something contributes to it.
        every = np.arange(self.count)
        key = np.concatenate(
            [self._place[rows] * self.count + self._place[columns], every * self.count + every]
        )
        blocks, block_of = np.unique(key, return_inverse=True)
        block_of = block_of[: len(rows)]
        self._changing = _sums(block_of[:changing], len(blocks))
        self._constant = _sums(block_of[changing:], len(blocks))
        row, column = np.divmod(blocks, self.count)
        per_row = np.bincount(row, minlength=self.count)
        start = np.cumsum(per_row) - per_row
        # Scalar rows of compressed storage: the blocks of a block row lie side by side.
        inside, wide = np.arange(6), per_row[row]
        at = (
            36 * start[row, None, None]
            + 6 * wide[:, None, None] * inside[:, None]
            + 6 * (np.arange(len(row)) - start[row])[:, None, None]
            + inside
        )
        self._at = at.reshape(-1, 36).astype(np.int32 if at.size < 2**31 else np.int64)
        self._indices = np.empty(at.size, np.int32)
        self._indices[at] = (6 * column[:, None, None] + inside).astype(np.int32)
        self._pointers = np.append(0, np.cumsum(np.repeat(6 * per_row, 6)))

    def constant(self, blocks: Floats) -> Floats:
        """(blocks, 36) sums of the contributions (c - changing, 6, 6) that stay, for `matrix`."""
        sums: Floats = self._constant @ blocks.reshape(-1, 36)
        return sums

    def matrix(self, blocks: Floats, constant: Floats | None = None) -> sparse.csc_matrix:
        """The matrix of contributions (changing, 6, 6), nodes in the order of elimination.

        Args:
            blocks: what changes.
            constant: what stays; None for nothing.
        """
        summed = self._changing @ blocks.reshape(-1, 36)
        if constant is not None:
            summed += constant
        data = np.empty(summed.size)
        data[self._at] = summed
        size = 6 * self.count
        return sparse.csc_matrix((data, self._indices, self._pointers), shape=(size, size))

    def ordered(self, values: Floats) -> Floats:
        """(6 n, ...) of (n, 6, ...), in the order of elimination."""
        return values[self._order].reshape(6 * self.count, *values.shape[2:])

    def restored(self, values: Floats) -> Floats:
        """(n, 6, ...) of (6 n, ...): the reverse of `ordered`."""
        return values.reshape(self.count, 6, *values.shape[1:])[self._place]


def _sums(block_of: Ints, count: int) -> sparse.csr_matrix:
    """(count, c) what adds up contributions (c,) to the blocks that they go to."""
    entries = len(block_of)
    return sparse.csr_matrix(
        (np.ones(entries), (block_of, np.arange(entries))), shape=(count, entries)
    )


@dataclass(frozen=True, eq=False)
class Factored:
    """A stiffness that is ready to be solved, some of its unknowns held.

    Attributes:
        pattern: whose order everything is in.
        matrix: with rows and columns of what is held as of the unit matrix.
        whole: as it was.
        free: (6 n,) bool.
        solve: displacements (6 n, k) of loads (6 n, k).
    """

    pattern: BlockPattern
    matrix: sparse.csc_matrix
    whole: sparse.csc_matrix
    free: Bools
    solve: Callable[[Floats], Floats]

    def displacements(self, loads: Floats, prescribed: Floats | None = None) -> Floats:
        """(n, 6, k) of loads (n, 6, k), N and N mm; `prescribed` says how what is held is moved.

        Raises:
            VolfrepError: a part of the structure can move without resistance.
        """
        right = self.pattern.ordered(loads)
        if prescribed is not None:
            given = self.pattern.ordered(prescribed) * ~self.free[:, None]
            right = right - self.whole @ given
            right[~self.free] = given[~self.free]
        else:
            right = right * self.free[:, None]
        result = self.solve(np.ascontiguousarray(right))
        rest = right - self.matrix @ result
        if not (np.linalg.norm(rest, axis=0) <= _UNSOLVED * np.linalg.norm(right, axis=0)).all():
            error = self.solve(np.ascontiguousarray(rest))
            result = result + error
            energy = np.einsum("nk,nk->k", right, result)
            wrong = np.abs(np.einsum("nk,nk->k", rest, error))
            if not (wrong <= _UNCERTAIN * energy).all():
                raise _loose()
        return self.pattern.restored(result)


def factorise(pattern: BlockPattern, whole: sparse.csc_matrix, fixed: Bools) -> Factored:
    """Factor a stiffness.

    Args:
        pattern: of the matrix.
        whole: its numbers, of `BlockPattern.matrix`.
        fixed: (n, 6) bool, what neither moves nor turns (or is moved by what is given).

    Raises:
        VolfrepError: a part of the structure can move without resistance.
    """
    diagonal = whole.diagonal()
    # What nothing resists because nothing is there (nodes without struts) is held, too.
    free = (pattern.ordered(fixed.astype(float)) == 0.0) & (diagonal > 0)
    matrix = mask_fixed(whole, free)
    solve = _by_cholesky(matrix)
    if solve is None:
        try:
            solve = _split(matrix).solve
        except RuntimeError as error:
            raise _loose() from error
    return Factored(pattern, matrix, whole, free, solve)


def definite(matrix: sparse.csc_matrix) -> Callable[[Floats], Floats] | None:
    """What solves a matrix in a pattern's order; None where it is not positive definite.

    It is when all pivots are above 0, of which no row changes places (Sylvester's law).
    """
    if _cholmod() is not None:
        return _by_cholesky(matrix)
    try:
        factor = _split(matrix)
    except RuntimeError:  # a pivot is 0
        return None
    kept = bool((factor.perm_r == np.arange(matrix.shape[0])).all())
    solve: Callable[[Floats], Floats] = factor.solve
    return solve if kept and float(factor.U.diagonal().min()) > 0.0 else None


def _split(matrix: sparse.csc_matrix) -> SuperLU:
    return splu(
        matrix, permc_spec="NATURAL", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )


@cache
def _cholmod() -> ModuleType | None:
    """CHOLMOD through scikit-sparse 0.4, where it is installed: a third of SuperLU's time.

    Its supernodal factors work on dense blocks (Y. Chen, T. A. Davis et al., ACM TOMS 35, 2008).
    """
    try:
        cholmod = import_module("sksparse.cholmod")
    except ImportError:
        return None
    return cholmod if hasattr(cholmod, "analyze") else None  # 0.5 has other functions


def _by_cholesky(matrix: sparse.csc_matrix) -> Callable[[Floats], Floats] | None:
    """What solves a matrix; None without CHOLMOD, and where the matrix is not positive definite."""
    cholmod = _cholmod()
    if cholmod is None:
        return None
    try:
        factor: Callable[[Floats], Floats] = cholmod.cholesky(
            matrix, mode="supernodal", ordering_method="natural"
        )
    except cholmod.CholmodNotPositiveDefiniteError:
        return None
    return factor


def _loose() -> VolfrepError:
    return VolfrepError(
        "A part of the structure can move freely: hold it in more places, or see whether a piece "
        "of the lattice hangs on nothing."
    )


def mask_fixed(whole: sparse.csc_matrix, free: Bools, diagonal: float = 1.0) -> sparse.csc_matrix:
    """A matrix with rows and columns that are not free as those of a multiple of the unit one."""
    kept = free.astype(float)
    column = np.repeat(kept, np.diff(whole.indptr))
    data = whole.data * column * kept[whole.indices]
    on = whole.indices == np.repeat(np.arange(len(free)), np.diff(whole.indptr))
    data[on & (column == 0)] = diagonal
    return sparse.csc_matrix((data, whole.indices, whole.indptr), shape=whole.shape)
