# SPDX-License-Identifier: LGPL-2.1-or-later
"""The area and the curvature of a surface that repeats, by its formula at points of one period."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ...util.types import Bools, Floats
from ..expression import compile_expression
from .library import PeriodicSurface

#: Samples along a cell by which the area is known, and near which curvatures are taken.
AREA_SAMPLES, CURVATURE_SAMPLES = 32, 40
#: Slopes are taken over so much to either side, in units of L.
SLOPE_STEP = 1e-3
#: All but a hundredth of a surface is bent no more than what counts as the most.
STRONGEST = 0.99
_TINY = 1e-12

#: Values of a formula at (..., 3) points, in units of L.
Values = Callable[[Floats], Floats]


@lru_cache(maxsize=8)
def surface_area(surface: PeriodicSurface) -> float:
    """About the area of a surface in a cell, in units of L squared.

    By how often lines along x, y and z cross it (Crofton): where it faces all ways alike they do
    so on 3/2 of its area; of Schwarz P this is 6 % too much, of the gyroid (3.09) 4 %.

    >>> from volfrep.design.tpms.library import SURFACES
    >>> 3.1 < surface_area(SURFACES["Gyroid"]) < 3.3
    True
    """
    crosses = _crossings(_values(surface)(_points(AREA_SAMPLES)))
    return int(crosses.sum()) / (1.5 * AREA_SAMPLES**2)


@lru_cache(maxsize=8)
def strongest_curvature(surface: PeriodicSurface) -> float:
    """About the strongest curvature of a surface, in units of 1 / L: of all but a hundredth of it.

    >>> from volfrep.design.tpms.library import SURFACES
    >>> 5.3 < strongest_curvature(SURFACES["Gyroid"]) < 5.5
    True
    """
    values, points = _values(surface), _points(CURVATURE_SAMPLES)
    points = points[_crossings(values(points)).any(axis=0)]
    if not len(points):
        return 0.0
    # A step of Newton's to the surface, no longer than from sample to sample.
    slope = _slopes(values, points)
    away = values(points) / np.maximum(np.einsum("ij,ij->i", slope, slope), _TINY)
    step = slope * away[:, None]
    size = np.maximum(np.linalg.norm(step, axis=1, keepdims=True), _TINY)
    points = points - step * np.minimum(1.0, 1.0 / (CURVATURE_SAMPLES * size))
    slope = _slopes(values, points)
    size = np.maximum(np.linalg.norm(slope, axis=1), _TINY)[:, None, None]
    normal = slope[:, :, None] / size
    across = np.eye(3) - normal * normal.transpose(0, 2, 1)
    steps = SLOPE_STEP * np.eye(3)
    bent = np.stack([_slopes(values, points + a) - _slopes(values, points - a) for a in steps],
                    axis=1) / (2.0 * SLOPE_STEP)  # fmt: skip
    shape = np.einsum("nij,njk,nkl->nil", across, bent, across) / size
    # Of the two curvatures their sum and the sum of their squares.
    total, squares = np.trace(shape, axis1=1, axis2=2), np.einsum("nij,nij->n", shape, shape)
    strongest = 0.5 * (np.abs(total) + np.sqrt(np.maximum(2.0 * squares - total**2, 0.0)))
    return float(np.quantile(strongest, STRONGEST))


def _values(surface: PeriodicSurface) -> Values:
    formula = compile_expression(surface.formula, ("x", "y", "z"))
    return lambda points: formula(*np.moveaxis(2.0 * np.pi * points, -1, 0))


def _points(count: int) -> Floats:
    """(count, count, count, 3) places of samples, in units of L."""
    axis = (np.arange(count) + 0.3) / count
    return np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)


def _crossings(samples: Floats) -> Bools:
    """(3, n, n, n) whether the surface lies between a sample and the next one along each axis."""
    above = samples > 0.0
    return np.stack([above != np.roll(above, -1, axis) for axis in range(3)])


def _slopes(values: Values, points: Floats) -> Floats:
    """(..., 3) gradients at (..., 3) points."""
    steps = SLOPE_STEP * np.eye(3)
    near = points[..., None, :]
    result: Floats = (values(near + steps) - values(near - steps)) / (2.0 * SLOPE_STEP)
    return result
