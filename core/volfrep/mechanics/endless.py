# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice without end that a unit cell makes: its own struts and joints, and all near a cell.

Lengths are in units of the cell size L throughout this package.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..design.cells import NODE_TOLERANCE, UnitCell, joint_radius
from ..octants import sdf
from ..octants.sdf import Field, Primitives
from ..util.errors import VolfrepError
from ..util.types import Floats, Ints

#: Points that are looked up together: blocks of so many voxels along an edge.
BLOCK = 4
_STEPS = round(1.0 / NODE_TOLERANCE)
#: A stiffness below this, over that of all struts side by side, is none.
_HINGED = 1e-9


@dataclass(frozen=True, eq=False)
class EndlessCell:
    """One period of the endless lattice; what cells share is there once.

    Attributes:
        nodes: (n, 3) float64 in [0, 1).
        struts: (m, 2) int64, rows of `nodes`.
        start: (m, 3) float64, where each strut begins, in or on the cell.
        end: (m, 3) float64, where it ends.
    """

    nodes: Floats
    struts: Ints
    start: Floats
    end: Floats

    @property
    def lengths(self) -> Floats:
        """(m,) lengths of the struts."""
        result: Floats = np.linalg.norm(self.end - self.start, axis=1)
        return result


def endless_cell(cell: UnitCell) -> EndlessCell:
    """The struts and nodes of a cell that are not copies of one another under a shift by L."""
    grid = np.round(cell.nodes * _STEPS).astype(np.int64)
    places, node = np.unique(grid % _STEPS, axis=0, return_inverse=True)
    node = node.ravel()
    ends = grid[cell.struts]  # (m, 2, 3)
    # The end that comes first by its place in the period, then by its shift, begins the strut.
    shift = ends // _STEPS
    number = node[cell.struts]
    delta = shift[:, 1] - shift[:, 0]
    flip = (number[:, 1] < number[:, 0]) | (
        (number[:, 1] == number[:, 0]) & (_first_sign(delta) < 0)
    )
    number = np.where(flip[:, None], number[:, ::-1], number)
    ends = np.where(flip[:, None, None], ends[:, ::-1], ends)
    delta = np.where(flip[:, None], -delta, delta)
    keys = np.concatenate([number, delta], axis=1)
    _, first = np.unique(keys, axis=0, return_index=True)
    first.sort()
    return EndlessCell(
        places / _STEPS, number[first], ends[first, 0] / _STEPS, ends[first, 1] / _STEPS
    )


def refuse_odd(cell: UnitCell) -> None:
    """Refuse a cell that is no cube, or whose struts differ: what is computed here is of others.

    Raises:
        VolfrepError: it is one.
    """
    if not cell.is_uniform_cube:
        raise VolfrepError(
            f"Properties, joints and targets are of cells that are cubes with struts of one "
            f"radius, which '{cell.name}' is not: leave out what asks for them, or choose another "
            "cell."
        )


def stretched_strains(cell: UnitCell) -> int:
    """How many of the six strains stretch the struts of the endless lattice, were they hinged.

    All six: the lattice carries whatever comes by pulling and pressing its struts (it is stretching
    dominated). Where struts need not change their lengths, they bend: the lattice is softer, and
    takes up more energy. The rank of a periodic pin-jointed frame, R. G. Hutchinson and
    N. A. Fleck, J. Mech. Phys. Solids 54, 2006.

    >>> from volfrep.design.cells import find_cell
    >>> stretched_strains(find_cell("Octet")), stretched_strains(find_cell("Box"))
    (6, 3)
    """
    endless = endless_cell(cell)
    length = endless.lengths
    along = (endless.end - endless.start) / length[:, None]
    rows = np.arange(len(length))
    # The strut's elongation by its ends' displacements, and by a strain of the whole.
    compatibility = np.zeros((len(length), len(endless.nodes), 3))
    np.add.at(compatibility, (rows, endless.struts[:, 1]), along)
    np.add.at(compatibility, (rows, endless.struts[:, 0]), -along)
    root = np.sqrt(length)[:, None]
    compatibility = compatibility.reshape(len(length), -1) / root
    strained = np.concatenate([along**2, along * np.roll(along, 1, axis=1)], axis=1) * root
    left = strained - compatibility @ np.linalg.lstsq(compatibility, strained, rcond=1e-9)[0]
    stiffness = np.linalg.eigvalsh(left.T @ left) / length.sum()
    return int((stiffness > _HINGED).sum())


def _first_sign(rows: Ints) -> Ints:
    """(n,) the sign of each row's first number that is not zero."""
    place = (rows != 0).argmax(axis=1)
    result: Ints = np.sign(rows[np.arange(len(rows)), place])
    return result


def own_primitives(endless: EndlessCell, radius: float) -> Primitives:
    """Struts and then joint spheres of one period, as `frep` knows them."""
    return sdf.join(
        sdf.struts(endless.start, endless.end, radius),
        sdf.spheres(endless.nodes, joint_radius(radius, 1.0)),
    )


def all_primitives(endless: EndlessCell, radius: float, reach: float) -> Primitives:
    """The struts and joints, copies included, that come nearer to the cell [0, 1]^3 than `reach`.

    By boxes: takes in a few too many, leaves out none.
    """
    own = own_primitives(endless, radius)
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)), float)
    sphere = ~own.direction.any(axis=1)
    half = np.where(sphere, 0.0, own.half_length)[:, None] * np.abs(own.direction)
    margin = own.radius[:, None] + half + reach
    middle = own.middle[None] + shifts[:, None]
    near = ((middle + margin > 0.0) & (middle - margin < 1.0)).all(axis=2)
    copy, row = np.nonzero(near)
    taken = own.take(row)
    return Primitives(
        taken.middle + shifts[copy],
        taken.direction,
        taken.half_length,
        taken.radius,
        taken.slope,
    )


def field_near(
    points: Floats,
    block: Ints,
    centres: Floats,
    primitives: Primitives,
    reach: float,
    fillet: float,
) -> Field:
    """The distance field at points in blocks, from the primitives that come near each block.

    Args:
        points: (n, 3).
        block: (n,) the block of each point, a row of `centres`.
        centres: (b, 3).
        primitives: of the lattice.
        reach: a primitive matters to a block if its distance to the centre is below this.
        fillet: radius of the round union.
    """
    values = sdf.distances(centres[:, None], primitives)
    near = (values < reach) | (values == values.min(axis=1, keepdims=True))
    start = np.concatenate([[0], np.cumsum(near.sum(axis=1))])
    of_blocks = Field(primitives, start, np.nonzero(near)[1], fillet)
    return of_blocks.rows(block)


def keep_near(field: Field, points: Floats, rows: Ints, reach: float) -> Field:
    """Some rows of a field, with only the primitives nearer than `reach` to their points."""
    chosen = field.rows(rows)
    owner = np.repeat(np.arange(len(rows)), np.diff(chosen.start))
    values = sdf.distances(points[rows][owner], chosen.primitives.take(chosen.near))
    least = np.minimum.reduceat(values, chosen.start[:-1])
    near: NDArray[np.bool_] = (values < reach) | (values == least[owner])
    start = np.concatenate([[0], np.cumsum(np.bincount(owner[near], minlength=len(rows)))])
    return Field(field.primitives, start, chosen.near[near], field.fillet)
