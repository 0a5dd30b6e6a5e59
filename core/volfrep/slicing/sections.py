# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a plane of equal z cuts round struts and joint spheres: polygons of their own area.

At each place along its axis a cone has a disc, and a plane cuts a chord of it: place and length of
the chord are closed forms.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..grid.strut_graph import Wireframe
from ..util.types import Floats, Ints

#: A strut whose slope to the vertical is below this is cut in a circle.
_UPRIGHT = 1e-7


@dataclass(frozen=True, eq=False)
class Bodies:
    """Struts as cones between their nodes, and the joint spheres about these; mm.

    Attributes:
        start: (m, 3) one end of each strut's axis.
        axis: (m, 3) unit vectors from there.
        length: (m,) of the axes.
        radius: (m,) at the start.
        growth: (m,) of the radius along the axis, mm a mm.
        centres: (n, 3) of the joint spheres.
        radii: (n,) of the joint spheres.
        spans: (m, 2) z of each strut's lowest and highest point.
    """

    start: Floats
    axis: Floats
    length: Floats
    radius: Floats
    growth: Floats
    centres: Floats
    radii: Floats
    spans: Floats


def bodies_of(lattice: Wireframe) -> Bodies:
    """The struts and joint spheres of a lattice, ready to be cut.

    Raises:
        ValueError: a strut of no length.
    """
    ends = lattice.nodes[lattice.struts]
    along = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(along, axis=1)
    if len(length) and not length.min() > 0:
        raise ValueError("a strut has no length")
    axis = along / length[:, None]
    slope = np.hypot(axis[:, 0], axis[:, 1])[:, None]
    low = (ends[:, :, 2] - lattice.radii * slope).min(axis=1)
    high = (ends[:, :, 2] + lattice.radii * slope).max(axis=1)
    growth = (lattice.radii[:, 1] - lattice.radii[:, 0]) / length
    return Bodies(
        ends[:, 0], axis, length, lattice.radii[:, 0], growth,
        lattice.nodes, lattice.joint_radii, np.stack([low, high], axis=1),
    )  # fmt: skip


def section_polygons(bodies: Bodies, z: float, error: float) -> tuple[Floats, Floats]:
    """What a plane cuts of struts and of joint spheres.

    Each polygon runs counter-clockwise and has the area of what it stands for where that is a
    whole ellipse or circle. Corners may coincide.

    Args:
        bodies: what is cut.
        z: of the plane, mm.
        error: largest distance of a polygon's edges from the true outline, mm.

    Returns:
        (k, c, 2) polygons of struts and (l, c2, 2) polygons of joints, mm; they overlap.
    """
    struts = np.flatnonzero((bodies.spans[:, 0] < z) & (z < bodies.spans[:, 1]))
    joints = np.flatnonzero(np.abs(z - bodies.centres[:, 2]) < bodies.radii)
    return _of_struts(bodies, struts, z, error), _of_joints(bodies, joints, z, error)


def _corners(radius: float, error: float) -> int:
    """Half the corners of a polygon that strays so far from a circle of a radius at most."""
    # Of a polygon with the circle's area the corners lie outside by what the edges lie inside.
    half_angle = np.arccos(max(1.0 - 1.5 * min(error / radius, 0.3), 0.5))
    return int(np.clip(np.ceil(0.5 * np.pi / half_angle), 4, 64))


def _swelling(half: int) -> float:
    """What a polygon of so many corners in each half is scaled by to have its ellipse's area."""
    return float(np.pi / half / np.sin(np.pi / half))


def _of_joints(bodies: Bodies, joints: Ints, z: float, error: float) -> Floats:
    """Polygons of circles."""
    if not len(joints):
        return np.zeros((0, 3, 2))
    rise = z - bodies.centres[joints, 2]
    radius = np.sqrt(bodies.radii[joints] ** 2 - rise**2)
    half = _corners(float(bodies.radii[joints].max()), error)
    angle = np.arange(2 * half) * (np.pi / half)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1) * np.sqrt(_swelling(half))
    polygons: Floats = bodies.centres[joints, None, :2] + radius[:, None, None] * circle
    return polygons


def _of_struts(bodies: Bodies, struts: Ints, z: float, error: float) -> Floats:
    """Polygons of the sections of cones with flat ends.

    At each place t along its axis a cone has a disc, and the plane cuts a chord of it, at the
    distance h(t) from the disc's middle and of the half-length sqrt(r(t)^2 - h(t)^2). Both r and
    h are linear in t, so the places with a chord are an interval, flat ends included.
    """
    if not len(struts):
        return np.zeros((0, 3, 2))
    axis, start = bodies.axis[struts], bodies.start[struts]
    radius, growth = bodies.radius[struts], bodies.growth[struts]
    slope = np.hypot(axis[:, 0], axis[:, 1])
    upright = slope < _UPRIGHT
    safe = np.where(upright, 1.0, slope)
    rise = z - start[:, 2]
    # Where |rise - axis_z t| <= slope (radius + growth t), and 0 <= t <= length.
    low, high = np.zeros(len(struts)), bodies.length[struts].copy()
    for factor, most in (
        (-(axis[:, 2] + slope * growth), slope * radius - rise),
        (axis[:, 2] - slope * growth, slope * radius + rise),
    ):
        with np.errstate(divide="ignore", invalid="ignore"):
            bound = most / factor
        low = np.where(factor < 0, np.maximum(low, bound), low)
        high = np.where(factor > 0, np.minimum(high, bound), high)
        high = np.where((factor == 0) & (most < 0), -1.0, high)
    with np.errstate(divide="ignore", invalid="ignore"):
        level = rise / axis[:, 2]  # where an upright strut's axis meets the plane
    low, high = np.where(upright, level, low), np.where(upright, level, high)
    cut = (low <= high) & (low >= 0) & (high <= bodies.length[struts])
    axis, start, radius, growth = axis[cut], start[cut], radius[cut], growth[cut]
    slope, upright, safe, rise = slope[cut], upright[cut], safe[cut], rise[cut]
    low, high = low[cut], high[cut]
    if not len(low):
        return np.zeros((0, 3, 2))

    # An ellipse as long as the strut needs no more corners than its circle: they crowd where it
    # is curved.
    half = _corners(float(radius.max()), error)
    place = -np.cos(np.arange(half + 1) * (np.pi / half))
    t = 0.5 * (low + high)[:, None] + 0.5 * (high - low)[:, None] * place
    wide = radius[:, None] + growth[:, None] * t
    h = np.where(upright[:, None], wide * place, (rise[:, None] - axis[:, 2:] * t) / safe[:, None])
    chord = np.sqrt(np.maximum(wide**2 - h**2, 0.0))
    # Round ends lose area between the corners, flat ones do not.
    flat = (chord[:, [0, -1]] > 1e-6 * wide[:, [0, -1]]).mean(axis=1)
    chord *= 1.0 + (_swelling(half) - 1.0) * (1.0 - flat[:, None])
    # Along the strut as seen from above, and to its left.
    along = np.where(upright[:, None], [1.0, 0.0], axis[:, :2] / safe[:, None])
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    # The disc's own up is `up` along the strut and `slope` upwards.
    up = np.where(upright, 1.0, -axis[:, 2])
    reach = np.where(upright, 0.0, slope)[:, None] * t + up[:, None] * h
    middle = start[:, None, :2] + reach[:, :, None] * along[:, None, :]
    side = chord[:, :, None] * across[:, None, :]
    # `reach` grows or falls along t: which side comes first decides the polygon's turn.
    right, left = middle - side, middle + side
    polygons: Floats = np.concatenate([right, left[:, ::-1]], axis=1)
    turns = reach[:, -1] < reach[:, 0]
    polygons[turns] = polygons[turns, ::-1]
    return polygons
