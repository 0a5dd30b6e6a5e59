# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bricks with a stiffness each, of which a part may be filled: a skin that is thinner than they.

The brick of `voxels.bricks`, integrated over `PARTS`^3 parts of itself, each with the share that
skin and lattice have of it: so a skin lies where it is, and bends a part as it should. Its nine
incompatible modes count without their mean stress: whatever fills it, the patch test is passed.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Any

import numpy as np

from ..mechanics.elements import CORNERS, PARTS, gradients, part_centres, strain_matrices
from ..util.types import Bools, Floats, Ints
from ..voxels.bricks import brick_strains

#: The 21 constants of a stiffness, rows and columns of its upper triangle.
PAIRS = np.array(list(combinations_with_replacement(range(6), 2)))
#: Elements whose matrices are made at once.
AT_ONCE = 4_000


def constants(tensors: Floats) -> Floats:
    """(..., 21) of symmetric (..., 6, 6)."""
    result: Floats = tensors[..., PAIRS[:, 0], PAIRS[:, 1]]
    return result


@dataclass(frozen=True, eq=False)
class Shares:
    """What fills the parts of elements.

    Attributes:
        lattice, solid: (e, PARTS^3) float32 in [0, 1], the shares of the part's lattice and of its
            skin or kept solids.
    """

    lattice: Floats
    solid: Floats


class Bricks:
    """Integrals of elements of one size.

    Args:
        edge: (3,) of them, mm.
        bending: whether they bend without locking, by modes beside their nodes.
    """

    def __init__(self, edge: Floats, *, bending: bool = True) -> None:
        self.edge, self._bending = np.asarray(edge, float), bending
        offsets = (CORNERS - 0.5) / (np.sqrt(3.0) * PARTS)
        points = (part_centres()[:, None] + offsets).reshape(-1, 3)
        weight = float(np.prod(self.edge)) / (8 * PARTS**3)
        strain = np.stack([brick_strains(2.0 * point - 1.0, self.edge) for point in points])
        strain = strain.reshape(PARTS**3, 8, 6, 33)
        # What each constant of each part adds to stiffness, and to its mean stress.
        table = np.empty((PARTS**3, len(PAIRS), 33 * 33 + 6 * 33), np.float32)
        mean = strain.sum(axis=1) * weight
        for k, (i, j) in enumerate(PAIRS):
            one = np.einsum("pqa,pqb->pab", strain[:, :, i], strain[:, :, j]) * weight
            whole = one if i == j else one + one.swapaxes(1, 2)
            stress = np.zeros((PARTS**3, 6, 33))
            stress[:, i], stress[:, j] = mean[:, j], mean[:, i]
            table[:, k, : 33 * 33] = whole.reshape(-1, 33 * 33)
            table[:, k, 33 * 33 :] = stress.reshape(-1, 6 * 33)
        self._table, self._whole = table.reshape(-1, table.shape[2]), table.sum(axis=0)

    def strains(self, points: Floats) -> Floats:
        """(n, 6, 24) strains, Voigt, of the nodes' displacements at points of the unit cube."""
        return strain_matrices(points, self.edge)

    def matrices(self, shares: Shares, lattice: Floats, solid: Floats) -> Floats:
        """(e, 24, 24) float32 N/mm.

        Args:
            shares: what fills each.
            lattice: (e, 21) `constants` of the lattice there, or (1, 21) of all, MPa.
            solid: (21,) of the skin, MPa.
        """
        count = len(shares.lattice)
        result: Any = np.empty((count, 24, 24), np.float32)
        full = (shares.lattice == 1.0).all(axis=1)
        solid32, every = solid.astype(np.float32), np.broadcast_to(lattice, (count, 21))
        if full.any():
            kinds, kind = np.unique(every[full], axis=0, return_inverse=True)
            made = [self._condensed(rows.astype(np.float32) @ self._whole, rows)
                    for rows in np.array_split(kinds, len(kinds) // AT_ONCE + 1)]  # fmt: skip
            result[full] = np.concatenate(made)[kind.ravel()]
        for rows in _batches(~full):
            own = shares.lattice[rows][:, :, None] * every[rows].astype(np.float32)[:, None]
            own += shares.solid[rows][:, :, None] * solid32
            found = own.reshape(len(rows), -1) @ self._table
            result[rows] = self._condensed(found, own.mean(axis=1))
        filled: Floats = result
        return filled

    def _condensed(self, found: Floats, mean: Floats) -> Floats:
        """(k, 24, 24) N/mm of nodes alone, from sums of the table and (k, 21) mean constants."""
        found = found.astype(float)
        whole = found[:, : 33 * 33].reshape(-1, 33, 33)
        if not self._bending:
            return whole[:, :24, :24]
        stress = found[:, 33 * 33 :].reshape(-1, 6, 33)
        law = np.zeros((len(mean), 6, 6))
        law[:, PAIRS[:, 0], PAIRS[:, 1]] = law[:, PAIRS[:, 1], PAIRS[:, 0]] = mean
        law *= float(np.prod(self.edge))
        own, modes = stress[:, :, :24], stress[:, :, 24:]
        even = np.linalg.solve(law, modes).swapaxes(1, 2)
        inner = whole[:, 24:, 24:] - even @ modes
        across = whole[:, 24:, :24] - even @ own
        result = whole[:, :24, :24] - across.swapaxes(1, 2) @ np.linalg.solve(inner, across)
        symmetric: Floats = 0.5 * (result + result.swapaxes(1, 2))
        return symmetric

    def conductances(self, shares: Shares, lattice: Floats, solid: float) -> Floats:
        """(e, 8, 8) W/K times what units the conductivities (e, 3, 3) or (1, 3, 3) have."""
        slopes = gradients(part_centres()) / self.edge
        weight = float(np.prod(self.edge)) / PARTS**3
        table = np.einsum("pai,pbj->pijab", slopes, slopes).reshape(-1, 9, 64) * weight
        every = np.broadcast_to(lattice, (len(shares.lattice), 3, 3)).reshape(-1, 9)
        result = np.empty((len(every), 64))
        for rows in np.array_split(np.arange(len(every)), len(every) // AT_ONCE + 1):
            own = shares.lattice[rows][:, :, None] * every[rows][:, None]
            own = own + shares.solid[rows][:, :, None] * (solid * np.eye(3).ravel())
            result[rows] = own.reshape(len(rows), -1) @ table.reshape(-1, 64)
        return result.reshape(-1, 8, 8)


def _batches(chosen: Bools) -> list[Ints]:
    """Rows that are chosen, so many at once."""
    rows = np.flatnonzero(chosen)
    return np.array_split(rows, -(-len(rows) // AT_ONCE)) if len(rows) else []


def along_lines(ways: Floats) -> tuple[Floats, Floats]:
    """(q, 6) stretch along and (q, 3, 6) what moves along (q, 3) unit vectors, by unit strains."""
    full = np.zeros((3, 3, 6))
    for row, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))):
        full[i, j, row] = full[j, i, row] = 1.0 if i == j else 0.5
    moved = np.einsum("ijv,qj->qiv", full, ways)
    stretch: Floats = np.einsum("qiv,qi->qv", moved, ways)
    return stretch, moved


def add_bars(
    matrices: Floats, bricks: Bricks, elements: Ints, places: Floats, ways: Floats, sizes: Floats,
    bent: Floats,
) -> None:  # fmt: skip
    """Add what lies along lines through elements and is stiff along them, less across, in place.

    Across them it takes shear: joints turn as the solid does, and struts between them are bent.

    Args:
        matrices: (e, 24, 24) float32.
        bricks: their integrals.
        elements: (q,) rows of them that pieces of lines lie in.
        places: (q, 3) the pieces' middles in the unit cube.
        ways: (q, 3) unit vectors along them.
        sizes: (q,) N mm: E times the section times the piece's length.
        bent: (q,) N mm: 12 E I over the square of the strut's length, times the piece's length.
    """
    stretch, turned = along_lines(ways)
    for rows in np.array_split(np.arange(len(elements)), len(elements) // AT_ONCE + 1):
        every = bricks.strains(places[rows])
        strain = np.einsum("qi,qia->qa", stretch[rows], every)
        ends = np.einsum("qiv,qva->qia", turned[rows], every, optimize=True)
        along = sizes[rows] - bent[rows]
        own = along[:, None, None] * strain[:, :, None] * strain[:, None]
        own += bent[rows, None, None] * np.einsum("qia,qib->qab", ends, ends, optimize=True)
        np.add.at(matrices, elements[rows], own.astype(np.float32))


def bar_conductances(bricks: Bricks, places: Floats, ways: Floats, sizes: Floats) -> Floats:
    """(q, 8, 8) mm, over the solid's conductivity, of lines through elements.

    Args:
        bricks: their integrals.
        places: (q, 3) the pieces' middles in the unit cube.
        ways: (q, 3) unit vectors along them.
        sizes: (q,) mm3: the section times the piece's length.
    """
    slopes = np.einsum("qai,qi->qa", gradients(places) / bricks.edge, ways)
    result: Floats = sizes[:, None, None] * slopes[:, :, None] * slopes[:, None]
    return result
