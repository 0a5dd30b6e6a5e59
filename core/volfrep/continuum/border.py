# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts in a free face of whole cells, of which homogenised cells know a part only.

A strut in the faces of cells belongs to two or four of them, and in the endless lattice all are
there. Where some are not, the strut is there all the same: what of it the missing cells would have
is added as a bar along it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..design.cells import UnitCell
from ..util.types import Bools, Floats

#: How near to a face a node lies in it, in units of L.
_ON = 1e-9


@dataclass(frozen=True, eq=False)
class Bars:
    """Bars in lattice space, in units of L, counted from the grid's first corner.

    Attributes:
        start, end: (k, 3) their ends.
        shares: (k,) of a whole strut that each has.
    """

    start: Floats
    end: Floats
    shares: Floats


def sharing_steps(one: Floats, two: Floats) -> Floats:
    """(k, 3) steps to the cells, itself first, that have a strut between (3,) places, too."""
    inside = (np.abs(one) < _ON) & (np.abs(two) < _ON)
    beyond = (np.abs(one - 1) < _ON) & (np.abs(two - 1) < _ON)
    sides = [(0, -1) if low else (0, 1) if high else (0,)
             for low, high in zip(inside, beyond, strict=True)]  # fmt: skip
    steps: Floats = np.array(np.meshgrid(*sides, indexing="ij")).reshape(3, -1).T
    return steps


def border_bars(cell: UnitCell, active: Bools) -> Bars:
    """What homogenised cells lack of the struts in their free faces.

    Args:
        cell: the unit cell, a cube.
        active: (nx, ny, nz) which cells there are.
    """
    around = np.pad(active, 1)
    ends = cell.nodes[cell.struts]  # (m, 2, 3)
    parts: list[Floats] = []
    for one, two in ends:
        steps = sharing_steps(one, two)
        if len(steps) == 1:
            continue
        sharers = np.stack(
            [
                around[
                    tuple(slice(1 + s, 1 + s + n) for s, n in zip(step, active.shape, strict=True))
                ]
                for step in steps
            ]
        )
        there = sharers.sum(axis=0)
        places = np.argwhere(active & (there < len(steps)))
        if not len(places):
            continue
        count = there[tuple(places.T)]
        # Each cell that is there takes its part of what is missing.
        share = (len(steps) - count) / len(steps) / count
        parts.append(np.concatenate([places + one, places + two, share[:, None]], axis=1))
    found = np.concatenate(parts) if parts else np.zeros((0, 7))
    return Bars(found[:, :3], found[:, 3:6], found[:, 6])
