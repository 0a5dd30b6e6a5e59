# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells that a wall cuts: how much of each of their struts is left, beside how much of the cell.

As a homogenised solid a cell has its stiffness and mass all over. Struts lie in places: where a
skin takes the layer that holds a cell's face, the struts in that face are gone, whatever the
layer's share of the cell is. So the stiffness of a cut cell follows what its struts, moved as the
solid is, would have in what is left of them, over what they would have by the cell's share; and its
mass, and how it leads heat, the length of struts that is left. A TPMS that a free face cuts has all
of its mass, and less of its stiffness within half a cell, as nothing holds the edges of its sheets.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from ..design.cells import UnitCell
from ..util.types import Floats, Ints
from .border import sharing_steps
from .bricks import AT_ONCE, along_lines

#: Places along each edge of a cell, and along each strut, that are looked at.
LOOKS = 8
#: A cell with less left of it is as others are.
_LEAST = 0.01
#: Where a strut's half has its middle, in units of its radius.
_HALF = 4.0 / (3.0 * np.pi)

#: Shares in [0, 1] of what lattice fills about (n, 3) points, in cells from the grid's corner.
Filled = Callable[[Floats], Floats]


@dataclass(frozen=True, eq=False)
class CutCells:
    """What walls leave of cells, beside what their shares of these would be.

    Attributes:
        stiffness: (k, 6, 6) symmetric, Voigt: a tensor's root times this times its root is the cut
            cell's, over its share.
        mass: (k,) of the struts that are left, over their share.
    """

    stiffness: Floats
    mass: Floats

    @staticmethod
    def softened(factors: Floats) -> CutCells:
        """Of (e,) factors of all of their stiffness, at their mass."""
        return CutCells(factors[:, None, None] * np.eye(6), np.ones(len(factors)))

    def means(self, rows: Ints, weights: Floats) -> CutCells:
        """(e,) means of the cells in (e, n) rows, by (e, n) weights."""
        weights = weights / weights.sum(axis=1)[:, None]
        stiffness: Floats = np.einsum("en,enab->eab", weights, self.stiffness[rows])
        return CutCells(stiffness, (weights * self.mass[rows]).sum(axis=1))


def cut_cells(cell: UnitCell, ratio: float, places: Ints, filled: Filled) -> CutCells:
    """What walls leave of cells.

    Args:
        cell: the unit cell, a cube.
        ratio: radius of its struts over L.
        places: (k, 3) the cells.
        filled: what the walls have left.
    """
    stiffness, mass = np.tile(np.eye(6), (len(places), 1, 1)), np.ones(len(places))
    near = np.stack(np.meshgrid(*[(0.01, 0.5, 0.99)] * 3), axis=-1).reshape(-1, 3)
    seen = _filled_at(places, near, filled)
    cut = np.flatnonzero((seen < 1.0).any(axis=1) & (seen > 0.0).any(axis=1))
    axis = (np.arange(LOOKS) + 0.5) / LOOKS
    points = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3)
    left = np.zeros(len(cut))
    for rows in np.array_split(np.arange(len(cut)), len(cut) // AT_ONCE + 1):
        left[rows] = _filled_at(places[cut[rows]], points, filled).mean(axis=1)
    cut, left = cut[left > _LEAST], left[left > _LEAST]
    if not len(cut):
        return CutCells(stiffness, mass)
    ends = cell.nodes[cell.struts]
    span = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(span, axis=1)
    # In a face the cell has the half of a strut that lies in it.
    at = ends[:, :1] + span[:, None] * axis[:, None]
    shared = [sharing_steps(one, two) for one, two in ends]
    inwards = np.stack([-steps.sum(axis=0) / max(len(steps) / 2, 1) for steps in shared])
    at = (at + _HALF * ratio * np.clip(inwards, -1.0, 1.0)[:, None]).reshape(-1, 3)
    volume = length / [len(steps) for steps in shared]
    stretched, turned = along_lines(span / length[:, None])
    bent = 3.0 * (ratio / length) ** 2
    own = (1.0 - bent)[:, None, None] * stretched[:, :, None] * stretched[:, None]
    own += bent[:, None, None] * np.einsum("mia,mib->mab", turned, turned)
    own *= volume[:, None, None]
    values, vectors = np.linalg.eigh(own.sum(axis=0))
    root = (vectors / np.sqrt(values)) @ vectors.T
    held = _filled_at(places[cut], at, filled).reshape(len(cut), len(ends), LOOKS).mean(axis=2)
    held /= left[:, None]
    stiffness[cut] = root @ np.einsum("km,mab->kab", held, own) @ root
    mass[cut] = held @ volume / volume.sum()
    return CutCells(stiffness, mass)


def _filled_at(places: Ints, points: Floats, filled: Filled) -> Floats:
    """(k, n) of (n, 3) points in each of (k, 3) cells."""
    every = (places[:, None] + points).reshape(-1, 3)
    return filled(every).reshape(len(places), len(points))


def near_free_faces(lattice: Floats, solid: Floats, step: Floats, depth: float) -> Floats:
    """(nx, ny, nz) 1 where lattice lies within a depth of a free face that it ends in, else 0.

    Args:
        lattice: (nx, ny, nz) in [0, 1] of the parts of a grid, as of `Shares`.
        solid: the same, of the skin.
        step: (3,) edges of a part, mm.
        depth: mm.
    """
    own = np.pad((lattice > 0.5) & (solid == 0.0), 1)
    there = np.pad((lattice + solid > 0.5) | (solid > 0.0), 1)
    free = ~there & ndimage.binary_dilation(own)
    if not free.any():
        return np.zeros(lattice.shape)
    away = ndimage.distance_transform_edt(~free, sampling=step) - 0.5 * float(step.mean())
    result: Floats = (own & (away < depth))[1:-1, 1:-1, 1:-1].astype(float)
    return result


def cut_tensors(tensors: Floats, factors: Floats) -> Floats:
    """(k, 6, 6) of cut cells: of (k, 6, 6) or (1, 6, 6) whole ones, by `CutCells.stiffness`."""
    values, vectors = np.linalg.eigh(tensors)
    root = (vectors * np.sqrt(np.maximum(values, 0.0))[:, None]) @ vectors.swapaxes(1, 2)
    result: Floats = root @ factors @ root
    return result
