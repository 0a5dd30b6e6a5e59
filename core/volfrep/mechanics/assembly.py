# SPDX-License-Identifier: LGPL-2.1-or-later
"""From voxels to a system of equations, and its solution by conjugate gradients.

Lengths are in voxels here: with h the voxel's edge in units of L, displacements are h and energies
h3 times what comes out.

Conjugate gradients stop by the energy that they still release: a residual says nothing where a
slender lattice keeps a thousandth of the energy.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np
import scipy.sparse

from ..util.errors import VolfrepError
from ..util.types import Floats, Ints
from .elements import CORNERS
from .voxels import Voxels

#: A node and its 26 neighbours.
_STENCIL = np.stack(np.meshgrid(*[np.arange(-1, 2)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
#: Conjugate gradients stop when the energy of what is left is this part of the lattice's own, as
#: the energy that the last steps have released tells it (Hestenes & Stiefel, 1952).
TOLERANCE = 1e-4
#: Last steps that are looked at, per voxel along the grid.
_LOOK_BACK = 0.25
MOST_STEPS = 20_000
#: A squared residual that is this part of the first one is rounding.
_ROUNDING = 1e-22
#: Energy below this part of the uniform gradient's counts as none.
_NOTHING = 1e-9
#: Voxels whose matrices are made at once.
_CHUNK = 20_000


@dataclass(frozen=True, eq=False)
class Nodes:
    """The corners of voxels, each once.

    Attributes:
        place: (n, 3) int64 on the grid of corners.
        of_voxels: (k, 8) int64, rows of `place`.
        neighbours: (n, 27) int64 rows of `place` about each node; -1 where there is none.
        last: the grid's last corner along each axis, where it is an octant's; 0 where the grid
            closes upon itself.
    """

    place: Ints
    of_voxels: Ints
    neighbours: Ints
    last: int


@dataclass(frozen=True, eq=False)
class System:
    """Stiffness and loads of a quantity with `size` numbers a node.

    Attributes:
        matrix: (n size, n size) sparse, symmetric.
        loads: (n size, cases) nodal forces of each unit macroscopic gradient.
        size: 3 for displacements, 1 for a temperature.
    """

    matrix: scipy.sparse.bsr_matrix
    loads: Floats
    size: int


def nodes_of(voxels: Voxels) -> Nodes:
    """Number the corners of voxels; opposite faces of a whole cell have the same."""
    count = voxels.along // 2 + 1 if voxels.octant else voxels.along
    shape = (count,) * 3
    corners = voxels.index[:, None] + CORNERS
    if not voxels.octant:
        corners %= count
    flat = np.ravel_multi_index(tuple(np.moveaxis(corners, -1, 0)), shape)
    number = np.full(count**3, -1, np.int64)
    number[flat.ravel()] = 0
    used = np.flatnonzero(number == 0)
    number[used] = np.arange(len(used))
    place = np.stack(np.unravel_index(used, shape), axis=1)
    about = place[:, None] + _STENCIL
    beyond = ((about < 0) | (about >= count)).any(axis=2)
    about %= count
    neighbours = number[np.ravel_multi_index(tuple(np.moveaxis(about, -1, 0)), shape)]
    if voxels.octant:
        neighbours[beyond] = -1
    return Nodes(place, number[flat], neighbours, count - 1 if voxels.octant else 0)


def assemble(voxels: Voxels, nodes: Nodes, stiffness: Floats, load: Floats) -> System:
    """Add up the voxels.

    Args:
        voxels: full ones first.
        nodes: their corners.
        stiffness: (parts, 8 size, 8 size) of an element's parts.
        load: (parts, 8 size, cases) of them.
    """
    size = stiffness.shape[1] // 8
    count = len(nodes.place)
    full = int(np.count_nonzero(voxels.full))
    towards = (CORNERS[None] - CORNERS[:, None] + 1) @ np.array([9, 3, 1])  # (8, 8) in _STENCIL
    block = np.zeros((count * 27, size * size))
    force = np.zeros((count * size, load.shape[2]))
    whole = stiffness.sum(axis=0)[None]
    own = [(np.arange(full), whole, load.sum(axis=0)[None])] if full else []
    flat, flat_load = (a.reshape(len(a), -1) for a in (stiffness, load))
    for first in range(0, len(voxels.parts), _CHUNK):
        parts = voxels.parts[first : first + _CHUNK]
        rows = full + first + np.arange(len(parts))
        own.append(
            (
                rows,
                (parts @ flat).reshape(-1, *stiffness.shape[1:]),
                (parts @ flat_load).reshape(-1, *load.shape[1:]),
            )
        )
    for rows, matrices, forces in own:
        corners = nodes.of_voxels[rows]
        key = (corners[:, :, None] * 27 + towards).ravel()
        pairs = matrices.reshape(-1, 8, size, 8, size).transpose(0, 1, 3, 2, 4)
        pairs = pairs.reshape(-1, 64, size * size)
        repeat = len(rows) // len(matrices)
        for entry in range(size * size):
            values = np.tile(pairs[:, :, entry].ravel(), repeat)
            block[:, entry] += np.bincount(key, values, len(block))
        unknown = (size * corners[:, :, None] + np.arange(size)).ravel()
        for case in range(force.shape[1]):
            values = np.tile(forces[:, :, case].ravel(), repeat)
            force[:, case] += np.bincount(unknown, values, len(force))
    block = block.reshape(count, 27, size, size)
    there = (nodes.neighbours >= 0) & block.any(axis=(2, 3))
    start = np.concatenate([[0], np.cumsum(there.sum(axis=1))])
    matrix = scipy.sparse.bsr_matrix(
        (block[there], nodes.neighbours[there], start), shape=(count * size, count * size)
    )
    return System(matrix, force, size)


def solve(
    system: System,
    forces: Floats,
    energy: Floats,
    free: Floats | None = None,
    *,
    look_back: int = 20,
    tolerance: float = TOLERANCE,
) -> Floats:
    """(n, cases) solutions by conjugate gradients, all cases side by side.

    Args:
        system: the equations; it may leave a rigid motion open.
        forces: (n, cases) right-hand sides.
        energy: (cases,) twice what the uniform gradient alone would store; every step releases
            some of it, and what remains is the lattice's.
        free: (n, cases) 1 where an unknown is free, 0 where it is held at zero; None: all free.
        look_back: so many steps must together have released next to nothing.
        tolerance: of the lattice's energy.

    Raises:
        VolfrepError: no convergence: the solid falls apart or hangs together by next to nothing.
    """
    free = np.ones_like(forces) if free is None else free
    inverse = free / system.matrix.diagonal()[:, None]
    solution = np.zeros_like(forces)
    residual = forces * free
    direction = inverse * residual
    change = (residual * direction).sum(axis=0)
    left = np.asarray(energy, float).copy()
    # What is as small as rounding has nothing to release.
    least = _NOTHING * np.abs(left)
    released: deque[Floats] = deque(maxlen=look_back)
    rounding = _ROUNDING * change
    for _ in range(MOST_STEPS):
        settled = np.sum(np.array(released), axis=0) <= np.maximum(tolerance * left, least)
        solved = change <= rounding
        if (len(released) == look_back and (settled | solved).all()) or solved.all():
            return solution
        image = (system.matrix @ direction) * free
        step = change / np.maximum((direction * image).sum(axis=0), 1e-300)
        step[solved] = 0.0
        solution += step * direction
        residual -= step * image
        released.append(step * change)
        left -= released[-1]
        improved = inverse * residual
        before, change = change, (residual * improved).sum(axis=0)
        direction = improved + change / np.maximum(before, 1e-300) * direction
    raise VolfrepError(
        f"The cell's equations did not converge in {MOST_STEPS:,} steps: do its struts hang "
        "together through every face?"
    )


def look_back(voxels: Voxels) -> int:
    """How many steps of conjugate gradients tell that nothing more comes, on a grid."""
    return max(20, round(_LOOK_BACK * voxels.along))
