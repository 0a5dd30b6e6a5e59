# SPDX-License-Identifier: LGPL-2.1-or-later
"""How symmetric a wall is: what of its cell must be solved, and how many constants it has."""

from __future__ import annotations

import itertools

import numpy as np

from ...tpms.solid import TpmsSolid
from ...util.types import Floats

#: Points at which values of the formula are compared, and by how much, over the largest, they may
#: differ.
_POINTS = 64
_ALIKE = 1e-9
#: Screw axes and glide planes shift by multiples of this.
_SHIFT = 0.25
_TURN = np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]], float)
_HALF_TURN = np.diag([-1.0, -1.0, 1.0])
_MIRROR = np.diag([1.0, 1.0, -1.0])


def is_mirror_symmetric(solid: TpmsSolid) -> bool:
    """Whether a cell equals its mirror images about its three mid-planes."""
    unmoved = np.zeros((1, 3))
    ways = (np.diag(row) for row in 1.0 - 2.0 * np.eye(3))
    return all(_maps_onto_itself(solid, way, unmoved) for way in ways)


def is_cubic(solid: TpmsSolid) -> bool:
    """Whether x, y and z are alike and a half turn or a mirror keeps the wall: then it is cubic.

    With the turn about [111] that makes tetrahedral symmetry at least, and three constants say all
    of the stiffness (J. F. Nye, Physical Properties of Crystals, 1957, table 9).
    """
    steps = np.arange(0.0, 1.0, _SHIFT)
    shifts = np.array(list(itertools.product(steps, repeat=3)))
    return _maps_onto_itself(solid, _TURN, shifts) and (
        _maps_onto_itself(solid, _HALF_TURN, shifts) or _maps_onto_itself(solid, _MIRROR, shifts)
    )


def _maps_onto_itself(solid: TpmsSolid, way: Floats, shifts: Floats) -> bool:
    """Whether a motion, with one of some shifts, takes the solid to itself.

    A sheet may have its sides exchanged.
    """
    points = np.random.default_rng(0).random((_POINTS, 3))
    own = solid.surface.values(points)
    moved = (np.einsum("nj,ij->ni", points, way)[None] + shifts[:, None]).reshape(-1, 3)
    other = solid.surface.values(moved).reshape(len(shifts), -1)
    signs = (1.0, -1.0) if solid.kind == "sheet" else (1.0,)
    gaps = [np.abs(other - sign * own).max(axis=1).min() for sign in signs]
    return bool(min(gaps) < _ALIKE * np.abs(own).max())
