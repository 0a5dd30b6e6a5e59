# SPDX-License-Identifier: LGPL-2.1-or-later
"""How stiff a TPMS is that ends at free faces, beside the endless one.

Where a face cuts it, nothing beyond holds the edges of sheets: they bend out of their way in place
of being stretched. A layer of one cell between two free faces, endless along them, tells by how
much: what half a cell behind each of them lacks.
"""

from __future__ import annotations

import numpy as np

from ..util.types import Floats
from .homogenise import solve_grid
from .summary import POISSON
from .voxels import Voxels

#: Voxels along L. Of a gyroid's sheet of 0.12 L: 0.88 on 18 and on 24, 0.87 on 32 at three places.
ALONG = 18
#: Where in the cell the faces lie, in voxels: parts cut cells anywhere.
SHIFTS = (0, ALONG // 3)
#: Ways that carry nothing count as carrying this part of the tensor's trace.
_NOTHING = 1e-6
#: Rows of strains along a face, Voigt, by the axis across it: two stretches, then the shear.
_ALONG_FACE = ([1, 2, 3], [0, 2, 4], [0, 1, 5])


def free_layer(voxels: Voxels, *, cubic: bool) -> float:
    """Young's modulus along a layer of one cell with free faces, over the endless TPMS's.

    Args:
        voxels: of a whole cell, `ALONG` along L.
        cubic: whether it looks the same along x, y and z.

    Returns:
        The mean over both axes along the faces, and over axes and places of the faces; 1 at most.

    Raises:
        VolfrepError: it is too slender for so few voxels.
    """
    whole = solve_grid(voxels, POISSON, cubic=False).tensor
    nothing = _NOTHING * float(np.trace(whole)) * np.eye(6)
    compliance = np.linalg.inv(whole + nothing)
    found = []
    for axis in (2,) if cubic else (0, 1, 2):
        rows = np.ix_(_ALONG_FACE[axis], _ALONG_FACE[axis])
        for shift in SHIFTS:
            layer = solve_grid(_opened(voxels, axis, shift), POISSON, cubic=False).tensor
            # Of a layer that is thinner by the gap.
            stiffness: Floats = layer[rows] * ALONG / (ALONG - 1)
            layers = np.linalg.inv(stiffness + nothing[rows])
            softer = np.diag(layers) / np.diag(compliance[rows])
            found += (1.0 / softer[:2]).tolist()
    return min(float(np.mean(found)), 1.0)


def _opened(voxels: Voxels, axis: int, shift: int) -> Voxels:
    """Without one layer of voxels across an axis, so that the cell has two free faces."""
    index = voxels.index.copy()
    index[:, axis] = (index[:, axis] + shift) % voxels.along
    kept = index[:, axis] < voxels.along - 1
    return Voxels(
        index[kept], voxels.full[kept], voxels.parts[kept[~voxels.full]], voxels.along, False
    )
