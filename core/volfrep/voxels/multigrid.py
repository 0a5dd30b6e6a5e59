# SPDX-License-Identifier: LGPL-2.1-or-later
"""Equations of bricks on a grid, solved by conjugate gradients that multigrid preconditions.

The finest level has no matrix where bricks are full: an element's displacements are gathered,
multiplied by the one matrix of a full brick, and scattered. Elements that are cut differ, and make
a matrix of their nodes. Each coarser level joins 2 x 2 x 2 elements
into one whose matrix is Galerkin's, of the finer ones under trilinear displacements with what is
held left out; it is kept as 27 blocks a node. The smoother is Chebyshev's polynomial about the
nodes' own 3 x 3 blocks, in single precision; the conjugate gradients are in double. The coarsest
level is factorised.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import bsr_matrix, csr_matrix, diags
from scipy.sparse.linalg import splu

from ..mechanics.elements import CORNERS
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints

Any32 = NDArray[Any]
#: Degrees of freedom of a level that is factorised.
FACTORISED = 6_000
#: Degree of the smoother's polynomial, and the largest eigenvalue over the least that it damps.
DEGREE, DAMPED = 3, 12.0
#: Steps of the power method for the largest eigenvalue, and what is added to it.
POWERS, SAFE = 12, 1.1
#: Elements that are multiplied in one go, and matrices of elements that are held in one go.
AT_ONCE, MATRICES = 60_000, 8_000
#: The largest number of steps; more than three times what any part has taken.
MOST_STEPS = 600


@dataclass(frozen=True, eq=False)
class Elements:
    """Elements of one level and their nodes.

    Attributes:
        place: (e, 3) int64, in the level's grid, in rising order.
        nodes: (e, 8) int32, rows of `node_place`, in the order of `CORNERS`.
        node_place: (n, 3) int64, in rising order.
    """

    place: Ints
    nodes: NDArray[np.int32]
    node_place: Ints


def elements_at(place: Ints, size: tuple[int, ...]) -> Elements:
    """The elements at (e, 3) places, in rising order, of a grid of that many."""
    shape = tuple(one + 1 for one in size)
    number = np.full(shape, -1, np.int32)
    for corner in CORNERS:
        number[tuple((place + corner).T)] = 0
    flat = np.flatnonzero(number.ravel() == 0)
    number.ravel()[flat] = np.arange(len(flat), dtype=np.int32)
    nodes = np.stack([number[tuple((place + corner).T)] for corner in CORNERS], axis=1)
    return Elements(place, nodes, np.stack(np.unravel_index(flat, shape), axis=1))


class Fine:
    """The equations of the finest level: no matrix where bricks are full, one where they are cut.

    Args:
        elements: of the finest level.
        cut: (e,) bool, elements with a matrix of their own.
        stiffness: (24, 24) of a full brick.
        matrices: (k, 24, 24) of k of the cut elements, by their rows.
        free: (n, 3) bool, what is not held.
    """

    def __init__(
        self,
        elements: Elements,
        cut: Bools,
        stiffness: Floats,
        matrices: Callable[[Ints], Floats],
        free: Bools,
    ) -> None:
        self.elements, self.stiffness, self.free = elements, stiffness, free
        self._whole_rows, self._cut_rows = np.flatnonzero(~cut), np.flatnonzero(cut)
        self._matrices = matrices
        self._whole = elements.nodes[self._whole_rows]
        flat, size = self._whole.ravel(), len(elements.node_place)
        order = np.argsort(flat, kind="stable").astype(np.int32)
        ends = np.concatenate([[0], np.cumsum(np.bincount(flat, minlength=size))])
        self._scatter = {
            np.dtype(kind): csr_matrix(
                (np.ones(len(order), kind), order, ends.astype(np.int32)), (size, len(order))
            )
            for kind in _KINDS
        }
        self._matrix = {np.dtype(kind): stiffness.astype(kind) for kind in _KINDS}
        self._cut: dict[Any, Any] = {}
        self._cut_nodes = np.unique(elements.nodes[self._cut_rows])
        self._cut_blocks = np.zeros((0, 3, 3))

    def full(self, displacements: Any32) -> Any32:
        """(n, 3) N that hold (n, 3) displacements, mm, whatever is held; in their precision."""
        nodes, kind = self._whole, displacements.dtype
        forces = np.empty((len(nodes), 24), kind)
        for begin in range(0, len(nodes), AT_ONCE):
            part = slice(begin, begin + AT_ONCE)
            own = np.take(displacements, nodes[part], axis=0).reshape(-1, 24)
            np.matmul(own, self._matrix[kind], out=forces[part])
        result: Any32 = self._scatter[kind] @ forces.reshape(-1, 3)
        if len(self._cut_nodes):
            own = np.take(displacements, self._cut_nodes, axis=0)
            result[self._cut_nodes] += (self._cut[kind] @ own.ravel()).reshape(-1, 3)
        return result

    def __call__(self, displacements: Any32) -> Any32:
        """(n, 3) N on what is free of displacements that are zero where it is not."""
        return self.full(displacements) * self.free

    def blocks(self) -> Floats:
        """(n, 3, 3) the nodes' own parts of the matrix; 1 where it is held."""
        own = np.stack([self.stiffness[3 * a : 3 * a + 3, 3 * a : 3 * a + 3] for a in range(8)])
        result = np.zeros((len(self.free), 3, 3))
        for a in range(8):  # no node is the same corner of two elements
            result[self._whole[:, a]] += own[a]
        result[self._cut_nodes] += self._cut_blocks
        result *= self.free[:, :, None] & self.free[:, None, :]
        return with_unit_rows(result)

    def assemble(
        self, parent: Ints, child: Ints, count: int, monitor: Monitor
    ) -> NDArray[np.float32]:
        """Make the matrix of cut elements, and (count, 24, 24) those of the next level's elements.

        Args:
            parent: (e,) the coarse element of each.
            child: (e,) which of its eight it is.
            count: of the coarse elements.
            monitor: asked for a cancel.
        """
        inner = child_prolongations()
        weights = np.zeros((count, 8))
        nodes = self.elements.nodes
        rows = self._whole_rows
        bound = ~self.free[nodes[rows]].all(axis=(1, 2))
        weights[parent[rows[~bound]], child[rows[~bound]]] = 1.0
        joined = np.einsum("cai,ab,cbj->cij", inner, self.stiffness, inner).reshape(8, -1)
        result: Any32 = (weights @ joined).astype(np.float32).reshape(-1, 24, 24)

        def add(rows: Ints, own: Floats) -> None:
            mask = self.free[nodes[rows]].reshape(-1, 24)
            own = own * (mask[:, :, None] & mask[:, None, :])
            for c in range(8):  # a parent has one such child
                part = child[rows] == c
                result[parent[rows[part]]] += inner[c].T @ own[part] @ inner[c]

        for part in _pieces(rows[bound]):
            add(part, np.broadcast_to(self.stiffness, (len(part), 24, 24)))
        cut = Stencils(len(self._cut_nodes), np.float64)
        for part in _pieces(self._cut_rows):
            monitor.tick()
            own = self._matrices(part)
            cut.add(np.searchsorted(self._cut_nodes, nodes[part]), own)
            add(part, own)
        matrix, self._cut_blocks = cut.matrix()
        self._cut = {np.dtype(kind): matrix.astype(kind) for kind in _KINDS}
        return result


_KINDS = (np.float32, np.float64)


def _pieces(rows: Ints) -> list[Ints]:
    """Rows in pieces, whose matrices are held in one go."""
    return [rows[begin : begin + MATRICES] for begin in range(0, len(rows), MATRICES)]


def child_prolongations() -> Floats:
    """(8, 24, 24) displacements of the nodes of each of eight children by those of their parent."""
    place = 0.5 * (CORNERS[:, None] + CORNERS[None])  # child, node, axis
    near = np.where(CORNERS[None, None], place[:, :, None], 1.0 - place[:, :, None]).prod(axis=3)
    return np.stack([np.kron(one, np.eye(3)) for one in near])


def with_unit_rows(blocks: Floats) -> Floats:
    """(n, 3, 3) blocks with 1 on the diagonal where a row is empty."""
    row = np.arange(3)
    own = blocks[:, row, row]
    blocks[:, row, row] = np.where(own > 0.0, own, 1.0)
    return blocks


def inverse(blocks: Floats) -> Floats:
    """(n, 3, 3) the inverse of symmetric blocks, by their cofactors."""
    rows = [blocks[:, k] for k in range(3)]
    turned = np.stack([np.cross(rows[k - 2], rows[k - 1]) for k in range(3)], axis=2)
    result: Floats = turned / np.einsum("ni,ni->n", rows[0], turned[:, :, 0])[:, None, None]
    return result


class Stencils:
    """A matrix that grows by elements of a grid: 27 blocks of 3 x 3 a node.

    Args:
        count: of nodes.
        kind: float32 or float64.
    """

    def __init__(self, count: int, kind: Any) -> None:
        self.value = np.zeros((count, 27, 3, 3), kind)
        self._column = np.full((count, 27), -1, np.int32)

    def add(self, nodes: NDArray[np.integer[Any]], matrices: Any32) -> None:
        """Add (k, 24, 24) matrices of elements with (k, 8) nodes in the order of `CORNERS`."""
        steps = (CORNERS[None] - CORNERS[:, None] + 1) @ np.array([9, 3, 1])
        split = matrices.reshape(-1, 8, 3, 8, 3)
        for a in range(8):
            for b in range(8):  # no node is the same corner of two elements
                row, way = nodes[:, a], steps[a, b]
                self.value[row, way] += split[:, a, :, b, :]
                self._column[row, way] = nodes[:, b]

    def matrix(self) -> tuple[Any, Floats]:
        """The matrix, scipy's, and (n, 3, 3) its diagonal blocks."""
        value, column, size = self.value, self._column, 3 * len(self.value)
        own = value[:, 13].astype(float)
        there = column >= 0
        ends = np.concatenate([[0], np.cumsum(there.sum(axis=1))])
        kept = (value[there], column[there], ends)
        return bsr_matrix(kept, (size, size), blocksize=(3, 3)), own


def block_matrix(elements: Elements, matrices: Any32) -> tuple[Any, Floats]:
    """The matrix of a level, and (n, 3, 3) its diagonal blocks; 1 on it where a row is empty."""
    made = Stencils(len(elements.node_place), np.float32)
    made.add(elements.nodes, matrices)
    made.value[:, 13] = with_unit_rows(made.value[:, 13])
    return made.matrix()


def prolongation(fine: Elements, coarse: Elements, size: tuple[int, ...]) -> Any:
    """The matrix that takes nodal values of a level to the next finer one, trilinearly."""
    number = np.full(tuple(one + 1 for one in size), -1, np.int32)
    number[tuple(coarse.node_place.T)] = np.arange(len(coarse.node_place), dtype=np.int32)
    low, odd = fine.node_place >> 1, fine.node_place & 1
    rows, columns, values = [], [], []
    for corner in CORNERS:
        row = np.flatnonzero((odd | (corner == 0)).all(axis=1))
        rows.append(row)
        columns.append(number[tuple((low[row] + corner).T)])
        values.append(0.5 ** odd[row].sum(axis=1))
    shape = (len(fine.node_place), len(coarse.node_place))
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return csr_matrix(entries, shape, np.float32)


class Level:
    """A level above the coarsest: its equations, its smoother, the way to the next.

    Args:
        apply: (n, 3) float32 displacements to forces.
        blocks: (n, 3, 3) the diagonal ones.
        prolong: from the next coarser level.
    """

    def __init__(self, apply: Callable[[Any32], Any32], blocks: Floats, prolong: Any) -> None:
        self.apply = apply
        self.prolong, self.restrict = prolong, prolong.T.tocsr()
        self.inverse = inverse(blocks).astype(np.float32)
        self.largest = self._largest()

    def _scaled(self, forces: Any32) -> Any32:
        return np.asarray(np.einsum("nij,nj->ni", self.inverse, forces))

    def _largest(self) -> float:
        """The largest eigenvalue of the equations scaled by their blocks, and some more."""
        random = np.random.default_rng(1)
        vector = random.standard_normal((len(self.inverse), 3)).astype(np.float32)
        size = 1.0
        for _ in range(POWERS):
            vector = self._scaled(self.apply(vector))
            size = float(np.linalg.norm(vector))
            vector /= np.float32(size)
        return SAFE * size

    def smooth(self, forces: Any32) -> Any32:
        """(n, 3) Chebyshev's polynomial of the scaled equations, applied to forces."""
        high = self.largest
        middle, half = 0.5 * high * (1 + 1 / DAMPED), 0.5 * high * (1 - 1 / DAMPED)
        ratio = half / middle
        step = self._scaled(forces) / np.float32(middle)
        displacements, before = step.copy(), ratio
        for _ in range(DEGREE - 1):
            left = self._scaled(forces - self.apply(displacements))
            after = 1.0 / (2.0 / ratio - before)
            step = np.float32(after * before) * step + np.float32(2.0 * after / half) * left
            displacements += step
            before = after
        return displacements


class Multigrid:
    """Equations of bricks, and their solver.

    Args:
        fine: the finest level.
        size: of its grid.
        monitor: asked for a cancel.
    """

    def __init__(
        self,
        fine: Fine,
        size: tuple[int, ...],
        monitor: Monitor | None = None,
    ) -> None:
        self.monitor = monitor or Monitor()
        self.fine, elements, free = fine, fine.elements, fine.free
        self._free32 = free.astype(np.float32)
        self.levels: list[Level] = []
        self.sizes = [len(elements.node_place)]
        apply: Callable[[Any32], Any32] = self.fine
        blocks, matrices, matrix = np.zeros(0), None, None
        while True:
            self.monitor.tick()
            half = tuple(-(-one // 2) for one in size)
            above = elements.place >> 1
            key = np.ravel_multi_index(tuple(above.T), half)
            found, parent = np.unique(key, return_inverse=True)
            child = (elements.place & 1) @ np.array([4, 2, 1])
            coarse = elements_at(np.stack(np.unravel_index(found, half), axis=1), half)
            if matrices is None:
                joined = self.fine.assemble(parent, child, len(found), self.monitor)
                blocks = self.fine.blocks()
            else:
                joined = join(matrices, parent, child, len(found))
            self.levels.append(Level(apply, blocks, prolongation(elements, coarse, half)))
            matrix, blocks = block_matrix(coarse, joined)
            elements, matrices, size = coarse, joined, half
            self.sizes.append(len(coarse.node_place))
            if 3 * len(coarse.node_place) <= FACTORISED:
                break
            apply = _applied(matrix)
        self._lowest = factorised(matrix)

    def precondition(self, forces: Floats) -> Floats:
        """(n, 3) one cycle's displacements under forces; symmetric, in single precision."""
        size = float(np.abs(forces).max()) or 1.0
        displacements = self._cycle(0, (forces / size).astype(np.float32)) * self._free32
        return displacements.astype(float) * size

    def _cycle(self, k: int, forces: Any32) -> Any32:
        if k == len(self.levels):
            solved = self._lowest(forces.astype(float).ravel())
            return np.asarray(solved.reshape(-1, 3).astype(np.float32))
        level = self.levels[k]
        displacements = level.smooth(forces)
        left = forces - level.apply(displacements)
        displacements += self._only_free(
            k, level.prolong @ self._cycle(k + 1, level.restrict @ left)
        )
        left = forces - level.apply(displacements)
        displacements += level.smooth(left)
        return displacements

    def _only_free(self, k: int, displacements: Any32) -> Any32:
        return displacements * self._free32 if k == 0 else displacements

    def solve(
        self, loads: Floats, start: Floats | None = None, tolerance: float = 1e-6
    ) -> tuple[Floats, int]:
        """(n, 3) displacements on what is free, mm, and the steps that they took.

        Args:
            loads: (n, 3) N.
            start: displacements to begin with; None for none.
            tolerance: of the forces that are left, over the loads.

        Raises:
            VolfrepError: it does not converge: something is held badly.
            Cancelled: when the monitor says so.
        """
        fine = self.fine
        right = loads * fine.free
        displacements = np.zeros_like(right) if start is None else start * fine.free
        left = right - fine(displacements) if start is not None else right.copy()
        small = tolerance * float(np.linalg.norm(right))
        if float(np.linalg.norm(left)) <= small:
            return displacements, 0
        ahead = self.precondition(left)
        step, work = ahead, float(np.vdot(left, ahead))
        first = float(np.linalg.norm(left))
        for number in range(1, MOST_STEPS + 1):
            force = fine(step)
            size = work / float(np.vdot(step, force))
            displacements += size * step
            before = left
            left = left - size * force
            norm = float(np.linalg.norm(left))
            self.monitor.tick(min(np.log(first / norm) / np.log(first / small), 1.0))
            if norm <= small:
                return displacements, number
            ahead = self.precondition(left)
            after = float(np.vdot(left, ahead))
            # The preconditioner is rounded: the step is made conjugate to the one before.
            step = ahead + (after - float(np.vdot(before, ahead))) / work * step
            work = after
        raise VolfrepError(
            f"The voxels' equations did not converge in {MOST_STEPS} steps: something of the part "
            "hangs on next to nothing; choose smaller voxels, or hold more of it."
        )


def _applied(matrix: Any) -> Callable[[Any32], Any32]:
    def apply(displacements: Any32) -> Any32:
        return np.asarray((matrix @ displacements.ravel()).reshape(-1, 3))

    return apply


def join(matrices: Any32, parent: Ints, child: Ints, count: int) -> NDArray[np.float32]:
    """(count, 24, 24) matrices of coarse elements of those of their children."""
    inner = child_prolongations()
    result = np.zeros((count, 24, 24))
    for c in range(8):
        rows = np.flatnonzero(child == c)
        for part in np.array_split(rows, len(rows) // AT_ONCE + 1):
            # A parent has one such child.
            result[parent[part]] += inner[c].T @ matrices[part].astype(float) @ inner[c]
    return result.astype(np.float32)


def factorised(matrix: Any) -> Callable[[Floats], Floats]:
    """The solution of a level's equations."""
    whole = matrix.astype(float).tocsc()
    # A free node between coarse ones that are held else makes two of them one.
    whole = 0.5 * (whole + whole.T) + diags(1e-6 * whole.diagonal())
    solution: Callable[[Floats], Floats] = splu(
        whole.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    ).solve  # fmt: skip
    return solution
