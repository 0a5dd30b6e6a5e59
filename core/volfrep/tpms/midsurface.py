# SPDX-License-Identifier: LGPL-2.1-or-later
"""The surface that walls follow: true distances to it, its foot points and normals.

A formula says on which side a point lies, but not how far off: thickness in mm needs the distance.
A cloud of points on the surface tells the nearest place (with the copies about a period, so that no
other part of the surface is overlooked), and a few steps settle on the foot of the perpendicular
there.
All lengths are in units of L.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree
from skimage.measure import marching_cubes

from ..design.expression import Expression, compile_expression
from ..design.tpms import PeriodicSurface
from ..util.errors import VolfrepError
from ..util.types import Floats

#: What formulas of surfaces are formulas of.
VARIABLES = ("x", "y", "z")
#: Step of the difference quotients that make the gradient.
DIFFERENCE = 1e-5
#: Samples along a cell for the cloud of points.
CLOUD = 48
#: So far beyond a period the cloud's copies are looked through first: all near places are there,
#: and a tree that does not repeat answers twice as fast.
COPIES_WITHIN = 0.25
#: Points of the cloud in one leaf of that tree.
LEAF = 32
#: Steps to a foot point, and the longest of them: the cloud's points are nearer than that.
FOOT_STEPS = 6
LONGEST_STEP = 0.05
#: A formula that differs by more than this part of its range a period further does not repeat.
REPEATS = 1e-6
#: A point counts as on the surface where Newton's next step to it is shorter.
ON_SURFACE = 1e-6


@dataclass(frozen=True, eq=False)
class Feet:
    """The nearest places of a surface.

    Attributes:
        points: (n, 3) the feet.
        normals: (n, 3) of the surface there, towards where the formula is positive.
        distances: (n,) from the surface, positive on that side.
    """

    points: Floats
    normals: Floats
    distances: Floats


@dataclass(frozen=True, eq=False)
class Midsurface:
    """A surface that repeats with period 1 along x, y and z.

    Attributes:
        expression: its formula.
        cloud: (n, 3) points on it in one period, from 0 to 1.
        spacing: about how far they lie apart.
    """

    expression: Expression
    cloud: Floats
    spacing: float
    _near: cKDTree
    _copies: Floats
    _anywhere: cKDTree

    def values(self, points: Floats) -> Floats:
        """(n,) values of the formula."""
        return _values(self.expression, points)

    def near(self, points: Floats, within: float = np.inf) -> tuple[Floats, Floats]:
        """(n, 3) the nearest points of the cloud, and (n,) how far; infinite beyond `within`."""
        folded = points - np.floor(points)
        folded[folded >= 1.0] = 0.0
        away, row = self._near.query(folded, distance_upper_bound=within)
        found = self._copies[np.minimum(row, len(self._copies) - 1)]
        far = np.flatnonzero(away > COPIES_WITHIN) if within > COPIES_WITHIN else ()
        if len(far):
            away[far], row = self._anywhere.query(folded[far], distance_upper_bound=within)
            found[far] = self.cloud[np.minimum(row, len(self.cloud) - 1)]
        return found + np.round(points - found), away

    def feet(self, points: Floats, start: Floats | None = None, steps: int = FOOT_STEPS) -> Feet:
        """The feet of points, sought from places near them.

        Each step goes to the surface along its normal, and along the surface to where the point
        is straight above: the error shrinks by distance times curvature.

        Args:
            points: (n, 3).
            start: (n, 3) places to begin at; None: the nearest ones of the cloud.
            steps: how many.
        """
        foot = self.near(points)[0] if start is None else start
        for _ in range(steps):
            value, gradient = values_and_gradients(self.expression, foot)
            size = np.einsum("ij,ij->i", gradient, gradient) + 1e-12
            gap = points - foot
            along = gap - gradient * (np.einsum("ij,ij->i", gap, gradient) / size)[:, None]
            step = along - gradient * (value / size)[:, None]
            length = np.linalg.norm(step, axis=1)
            foot = foot + step * np.minimum(1.0, LONGEST_STEP / np.maximum(length, 1e-30))[:, None]
        gradient = values_and_gradients(self.expression, foot)[1]
        normal = gradient / np.maximum(np.linalg.norm(gradient, axis=1), 1e-30)[:, None]
        return Feet(foot, normal, np.einsum("ij,ij->i", points - foot, normal))


@lru_cache(maxsize=8)
def midsurface(surface: PeriodicSurface) -> Midsurface:
    """The surface of a formula, with points on it.

    Raises:
        VolfrepError: the formula cannot be read, does not repeat, has no finite value everywhere,
            or is nowhere zero.
    """
    expression = compile_expression(surface.formula, VARIABLES)
    axis = np.arange(CLOUD + 1) / CLOUD
    # Off the lattice points, on which symmetric formulas like to be zero.
    shift = np.array([0.113, 0.171, 0.137]) / CLOUD
    grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3) + shift
    values = _values(expression, grid).reshape((CLOUD + 1,) * 3)
    if not np.isfinite(values).all():
        raise VolfrepError(
            f"The formula '{surface.formula}' must have a finite value for all x, y and z."
        )
    span = float(np.ptp(values))
    for k, name in enumerate(VARIABLES):
        ends = np.take(values, [0, CLOUD], axis=k)
        if np.abs(np.diff(ends, axis=k)).max() > REPEATS * max(span, 1e-300):
            raise VolfrepError(
                f"The formula '{surface.formula}' must repeat after 2 pi along {name}: x, y and z "
                "run from 0 to 2 pi over a cell."
            )
    if not values.min() < 0.0 < values.max():
        raise VolfrepError(
            f"The formula '{surface.formula}' is nowhere zero, so that there is no surface: its "
            f"values go from {values.min():.3g} to {values.max():.3g}."
        )
    found = marching_cubes(values, 0.0)[0] / CLOUD + shift  # type: ignore[no-untyped-call]
    for _ in range(3):
        value, gradient = values_and_gradients(expression, found)
        size = np.einsum("ij,ij->i", gradient, gradient) + 1e-12
        step = gradient * (value / size)[:, None]
        short = np.minimum(1.0, 1.0 / CLOUD / np.maximum(np.linalg.norm(step, axis=1), 1e-30))
        found = found - step * short[:, None]
    value, gradient = values_and_gradients(expression, found)
    near = np.abs(value) <= ON_SURFACE * np.linalg.norm(gradient, axis=1)
    if not near.any():
        raise VolfrepError(
            f"The formula '{surface.formula}' only jumps from below 0 to above it: give one that "
            "is 0 in between."
        )
    cloud = found[near] % 1.0
    cloud[cloud >= 1.0] = 0.0
    copies = _with_copies(cloud)
    near_tree, anywhere = cKDTree(copies, LEAF), cKDTree(cloud, boxsize=1.0)
    return Midsurface(expression, cloud, 1.0 / CLOUD, near_tree, copies, anywhere)


def _with_copies(cloud: Floats) -> Floats:
    """Points of the period from 0 to 1 and their copies that lie near to it."""
    for axis in np.eye(3):
        along = (cloud * axis).sum(axis=1)
        low, high = cloud[along < COPIES_WITHIN], cloud[along > 1.0 - COPIES_WITHIN]
        cloud = np.concatenate([cloud, low + axis, high - axis])
    return cloud


def values_and_gradients(expression: Expression, points: Floats) -> tuple[Floats, Floats]:
    """(n,) values of a formula and (n, 3) gradients, by central differences."""
    gradient = np.empty_like(points)
    for k in range(3):
        step = np.zeros(3)
        step[k] = DIFFERENCE
        ahead, behind = _values(expression, points + step), _values(expression, points - step)
        gradient[:, k] = (ahead - behind) / (2.0 * DIFFERENCE)
    return _values(expression, points), gradient


def _values(expression: Expression, points: Floats) -> Floats:
    return expression(*(2.0 * np.pi * points[:, k] for k in range(3)))
