# SPDX-License-Identifier: LGPL-2.1-or-later
"""The voxels of a cell: which are solid, and how much of each that the surface cuts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..util.types import Floats, Ints
from .elements import PARTS, part_centres
from .endless import BLOCK, EndlessCell, all_primitives, field_near, keep_near

#: Half of a unit cube's diagonal.
_HALF_DIAGONAL = 0.5 * np.sqrt(3.0)


@dataclass(frozen=True, eq=False)
class Voxels:
    """The voxels of a cell, or of its first octant, that hold some of the solid.

    Attributes:
        index: (k, 3) int64, place in the grid.
        full: (k,) bool, wholly solid.
        parts: (cut, PARTS^3) float64 in [0, 1], the solid share of each part of a voxel that is
            not full, in the order of the rows of `index`.
        along: how many voxels lie along L.
        octant: whether these are of the octant [0, 1/2]^3 only.
    """

    index: Ints
    full: NDArray[np.bool_]
    parts: Floats
    along: int
    octant: bool

    @property
    def shares(self) -> Floats:
        """(k,) the solid share of each voxel."""
        result = np.ones(len(self.index))
        result[~self.full] = self.parts.mean(axis=1)
        return result

    @property
    def relative_density(self) -> float:
        """The solid share of the whole cell."""
        return float(self.shares.sum()) / self.along**3 * (8 if self.octant else 1)


def voxels_of(
    endless: EndlessCell,
    radius: float,
    fillet: float,
    along: int,
    *,
    octant: bool,
    density: float | None = None,
) -> Voxels:
    """Cut a lattice into voxels.

    The parts of a voxel that the surface cuts are filled by their distance to it. All distances
    are shifted by one small amount so that the voxels hold the exact relative density.

    Args:
        endless: the lattice.
        radius: of the struts, in units of L.
        fillet: of the round union, in units of L.
        along: voxels along L, even where only an octant is wanted.
        octant: the octant [0, 1/2]^3 only (of a cell that is its own mirror image).
        density: the exact relative density; None leaves the distances as they are.
    """
    step = 1.0 / along
    count = along // 2 if octant else along
    index = np.stack(np.meshgrid(*[np.arange(count)] * 3, indexing="ij"), -1).reshape(-1, 3)
    centres = (index + 0.5) * step
    primitives = all_primitives(endless, radius, fillet + _HALF_DIAGONAL * step)
    blocks = -(-count // BLOCK)
    block = np.ravel_multi_index(tuple((index // BLOCK).T), (blocks,) * 3)
    middles = np.stack(np.meshgrid(*[np.arange(blocks)] * 3, indexing="ij"), -1).reshape(-1, 3)
    middles = (middles + 0.5) * BLOCK * step
    reach = _HALF_DIAGONAL * step + fillet
    field = field_near(
        centres, block, middles, primitives, reach + _HALF_DIAGONAL * BLOCK * step, fillet
    )
    least, _ = field.nearest(centres)
    full = least < -_HALF_DIAGONAL * step
    cut = np.flatnonzero(~full & (least < reach))
    near = keep_near(field, centres, cut, reach)
    inner = part_centres()
    points = (index[cut][:, None] + inner).reshape(-1, 3) * step
    distance = near.rows(np.repeat(np.arange(len(cut)), len(inner))).values(points)
    distance = distance.reshape(len(cut), -1) * (along * PARTS)
    return voxels_by_distance(index, full, cut, distance, along, octant=octant, density=density)


def voxels_by_distance(
    index: Ints,
    full: NDArray[np.bool_],
    cut: Ints,
    distance: Floats,
    along: int,
    *,
    octant: bool,
    density: float | None,
) -> Voxels:
    """The voxels of a grid, filled by the distances of the parts of those that are cut.

    Args:
        index: (n, 3) int64, places in the grid.
        full: (n,) which are wholly solid.
        cut: (k,) int64, rows of those that the surface may cut.
        distance: (k, PARTS^3) of their parts' middles from the surface, negative inside, in edges
            of a part.
        along: voxels along L.
        octant: whether the grid is of an octant only.
        density: as for `voxels_of`.
    """
    count = distance.shape[1]

    def shares(shift: float) -> Floats:
        result: Floats = np.clip(0.5 - distance + shift, 0.0, 1.0)
        return result

    shift = 0.0
    if density is not None:
        wanted = density * along**3 / (8 if octant else 1) - np.count_nonzero(full)
        for _ in range(6):
            filled = shares(shift)
            rate = np.count_nonzero((filled > 0.0) & (filled < 1.0)) / count
            shift += (wanted - filled.sum() / count) / max(rate, 1e-12)
    parts = shares(shift)
    filled = parts.any(axis=1)
    rows = np.concatenate([np.flatnonzero(full), cut[filled]])
    whole = np.arange(len(rows)) < np.count_nonzero(full)
    return Voxels(index[rows], whole, parts[filled], along, octant)
