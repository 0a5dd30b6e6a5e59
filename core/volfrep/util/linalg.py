# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rotations and frames."""

from __future__ import annotations

import math

import numpy as np

from .types import Floats


def rotation(axis: Floats, angle: float) -> Floats:
    """(3, 3) the rotation about a (3,) axis by an angle in radians (Rodrigues)."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    result: Floats = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return result


def frame_about(axis: Floats) -> Floats:
    """(3, 3) right-handed frame whose third column is the (3,) axis, its first near the x-axis."""
    third = np.asarray(axis, float) / np.linalg.norm(axis)
    near = np.eye(3)[0 if abs(third[0]) < 0.9 else 1]
    first = near - third * (near @ third)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(third, first), third], axis=1)
