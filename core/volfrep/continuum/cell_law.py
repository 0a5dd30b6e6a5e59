# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the lattice of a cell is as a material, over what says how thick it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..design.cells import UnitCell
from ..mechanics.catalogue import joint_law
from ..mechanics.frame import PeriodicFrame, axial_forces, frame_tensor
from ..mechanics.joint_fit import periodic_frame
from ..util.types import Floats

#: Stiffness below this part of a tensor's largest counts as so much.
LEAST = 1e-5
#: Stretches and radii of cells that are not cubes are told apart by this share of them.
_ALIKE = 0.02
_VOIGT = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


@dataclass(frozen=True, eq=False)
class CellLaw:
    """An endless lattice of a solid with Young's modulus, yield stress and conductivity 1.

    Attributes:
        thickness: (n,) rising, mm: radii of struts, thicknesses or offsets of walls.
        density: (n,) relative.
        tensors: (n, 6, 6) stiffness in the cell's axes, Voigt.
        strength: (n, 2) macroscopic stress along an edge and shear at which the solid yields.
        conductivity: (n,) the mean over the axes.
        pressed: (n, m, 6) of each strut what presses it under a unit strain, Voigt in the cell's
            axes, over what buckles it between pinned ends; None of walls.
        free_layer: stiffness of a TPMS within half a cell of a free face, over that elsewhere; None
            of struts.
    """

    thickness: Floats
    density: Floats
    tensors: Floats
    strength: Floats
    conductivity: Floats
    pressed: Floats | None = None
    free_layer: float | None = None

    def tensors_at(self, thickness: Floats) -> Floats:
        """(k, 6, 6), between samples by logarithms of both; (1, 6, 6) of one sample."""
        values, vectors = np.linalg.eigh(self.tensors)
        values = np.maximum(values, LEAST * values[:, -1:])
        if len(values) == 1:
            result: Floats = (vectors * values[:, None]) @ vectors.swapaxes(1, 2)
            return result
        logs = ((vectors * np.log(values)[:, None]) @ vectors.swapaxes(1, 2)).reshape(-1, 36)
        at, known = np.log(thickness), np.log(self.thickness)
        found = np.stack([np.interp(at, known, row) for row in logs.T], axis=1)
        values, vectors = np.linalg.eigh(found.reshape(-1, 6, 6))
        result = (vectors * np.exp(values)[:, None]) @ vectors.swapaxes(1, 2)
        return result

    def at(self, column: Floats, thickness: Floats) -> Floats:
        """(k, ...) another column of the law at thicknesses, between its samples."""
        if len(self.thickness) == 1:
            return np.repeat(column, len(thickness), axis=0)
        flat = column.reshape(len(column), -1)
        found = np.stack([np.interp(thickness, self.thickness, row) for row in flat.T], axis=1)
        return np.asarray(found.reshape(len(thickness), *column.shape[1:]))


def turned(tensors: Floats, frames: Floats) -> Floats:
    """(k, 6, 6) tensors of lattices whose axes are turned to the columns of (k, 3, 3) frames."""
    bond = np.empty((len(frames), 6, 6))
    for row, (i, j) in enumerate(_VOIGT):
        for column, (p, q) in enumerate(_VOIGT):
            one = frames[:, i, p] * frames[:, j, q]
            bond[:, row, column] = one if p == q else one + frames[:, i, q] * frames[:, j, p]
    result: Floats = bond @ tensors @ bond.swapaxes(1, 2)
    return result


def in_cell(stress: Floats, frames: Floats) -> Floats:
    """(k, 6) stresses, Voigt, in the axes of cells turned to the columns of (k, 3, 3) frames."""
    full = stress[:, [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]
    back = np.einsum("kia,kij,kjb->kab", frames, full, frames)
    return np.stack([back[:, i, j] for i, j in _VOIGT], axis=1)


def pressed_struts(cell: UnitCell, cell_size: float, radius: float) -> Floats:
    """(m, 6) what presses struts under unit strains, over what buckles them between pinned ends.

    Joints hold struts more than pins do, and move aside: alone, struts bear as much or more.
    """
    frame, ratio = periodic_frame(cell), radius / cell_size
    axial = axial_forces(frame, ratio, joint_law(cell, cell_size)(radius))
    square = ((frame.end - frame.start) ** 2).sum(axis=1)
    result: Floats = -axial * (square / (np.pi**3 * ratio**4 / 4.0))[:, None]
    return result


def split(jacobians: Floats) -> tuple[Floats, Floats]:
    """(k, 3, 3) rotations and (k, 3, 3) symmetric stretches of jacobians, R and U of R U."""
    left, sizes, right = np.linalg.svd(jacobians)
    rotation = left @ right
    stretch = right.swapaxes(1, 2) @ (sizes[:, :, None] * right)
    return rotation, stretch


def stretched_tensors(
    cell: UnitCell, cell_size: float, radii: Floats, stretches: Floats, law: CellLaw
) -> Floats:
    """(k, 6, 6) of cells that a map has stretched, whose struts stay round: frames of them.

    What the frame of the unstretched cell lacks of the homogenised one, all are given.

    Args:
        cell: the unit cell, a cube.
        cell_size: L, mm.
        radii: (k,) mm.
        stretches: (k, 3, 3) symmetric.
        law: of the cube.
    """
    frame = periodic_frame(cell)
    ends = joint_law(cell, cell_size)
    upper = np.triu_indices(3)
    key = np.column_stack([np.log(radii / cell_size), stretches[:, upper[0], upper[1]]])
    _, first, group = np.unique(
        np.round(key / _ALIKE), axis=0, return_index=True, return_inverse=True
    )
    found = np.empty((len(first), 6, 6))
    for k, row in enumerate(first.tolist()):
        stretch, ratio = stretches[row], float(radii[row]) / cell_size
        grown = float(np.cbrt(np.linalg.det(stretch)))
        radius = float(radii[row])
        shape = PeriodicFrame(
            frame.nodes, frame.struts, frame.start @ stretch, frame.end @ stretch, grown**3
        )
        own = frame_tensor(shape, ratio, ends(radius / grown))
        even = frame_tensor(frame, ratio, ends(radius))
        wanted = law.tensors_at(np.array([radius]))[0]
        found[k] = own * float(np.trace(wanted) / np.trace(even))
    result: Floats = found[group.ravel()]
    return result
