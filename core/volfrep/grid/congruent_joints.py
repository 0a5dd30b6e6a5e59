# SPDX-License-Identifier: LGPL-2.1-or-later
"""Congruent joints: each node with the nearer halves of its struts, equal ones told once.

Struts overlap near their joints only. Cut in the middle of every strut, a lattice falls into
joints that touch in circles, and a block of any size has few kinds of them: what is costly, such
as a Boolean of exact surfaces, is done once a kind.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..util.errors import VolfrepError
from ..util.linalg import axes_across, times
from ..util.numbers import place_text
from ..util.types import Floats, Ints
from .strut_graph import Wireframe

#: Joints whose arms agree within this are equal, mm: what solid modellers take for equal, too.
TOLERANCE = 1e-7
#: Points in each piece of a joint by which its volume is estimated, within about 0.3 %.
SAMPLES = 4000


class Unsuitable(Exception):
    """A joint that cannot be made of exact surfaces; the text says why: "the joint ..."."""


@dataclass(frozen=True, eq=False)
class Joint:
    """A kind of joint, at the origin.

    Attributes:
        arms: (k, 3) float64, from the joint to the middles of its struts, mm.
        radii: (k, 2) float64, of each arm at the joint and at the strut's middle, mm.
        ball: radius of the joint sphere, mm.
        places: (c,) int64, the nodes that are joints of this kind.
        struts: (c, k) int64, the strut of each arm of each of them.
        at_end: (c, k) bool, whether that arm is the second half of its strut.
    """

    arms: Floats
    radii: Floats
    ball: float
    places: Ints
    struts: Ints
    at_end: NDArray[np.bool_]


def distinct_joints(wireframe: Wireframe) -> list[Joint]:
    """The kinds of joints of a lattice; nodes without struts are left out."""
    count = len(wireframe.struts)
    ends = wireframe.nodes[wireframe.struts]
    middle = ends.mean(axis=1)
    halfway = wireframe.radii.mean(axis=1)
    node = wireframe.struts.T.astype(np.int64).ravel()
    arm = np.concatenate([middle - ends[:, 0], middle - ends[:, 1]])
    radii = np.stack([wireframe.radii.T.ravel(), np.tile(halfway, 2)], axis=1)
    strut = np.tile(np.arange(count), 2)
    at_end = np.repeat([False, True], count)

    # The arms of a node in an order that equal joints share, as whole numbers.
    steps = np.round(np.hstack([arm, radii]) / TOLERANCE).astype(np.int64)
    order = np.lexsort((*steps.T[::-1], node))
    arms_of = np.bincount(node, minlength=len(wireframe.nodes))
    joints = []
    for valence in np.unique(arms_of[arms_of > 0]):
        chosen = order[arms_of[node[order]] == valence].reshape(-1, valence)
        places = node[chosen[:, 0]]
        ball = np.round(wireframe.joint_radii[places, None] / TOLERANCE).astype(np.int64)
        keys = np.hstack([steps[chosen].reshape(len(chosen), -1), ball])
        _, first, kind = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        by_kind = np.argsort(kind.ravel(), kind="stable")
        bounds = np.cumsum(np.bincount(kind.ravel()))[:-1]
        for example, own in zip(first, np.split(chosen[by_kind], bounds), strict=True):
            joints.append(
                Joint(
                    arm[chosen[example]],
                    radii[chosen[example]],
                    float(wireframe.joint_radii[places[example]]),
                    node[own[:, 0]],
                    strut[own],
                    at_end[own],
                )
            )
    return joints


def refuse_overlaps(wireframe: Wireframe) -> None:
    """Refuse struts that touch others away from a common joint.

    Raises:
        VolfrepError: naming the first place.
    """
    start, end = wireframe.nodes[wireframe.struts].swapaxes(0, 1)
    radius = wireframe.radii.max(axis=1)
    # Spheres are struts without length, between a node and itself.
    start, end = np.concatenate([start, wireframe.nodes]), np.concatenate([end, wireframe.nodes])
    radius = np.concatenate([radius, wireframe.joint_radii])
    own = np.arange(len(wireframe.nodes), dtype=np.int32)
    nodes = np.concatenate([wireframe.struts, np.stack([own, own], axis=1)])
    reach = 0.5 * np.linalg.norm(end - start, axis=1).max() + radius.max()
    pairs = cKDTree(0.5 * (start + end)).query_pairs(2.0 * reach, output_type="ndarray")
    a, b = pairs.T
    apart = (nodes[a][:, :, None] != nodes[b][:, None, :]).all(axis=(1, 2))
    a, b = a[apart], b[apart]
    one, two = _closest(start[a], end[a], start[b], end[b])
    gap = np.linalg.norm(one - two, axis=1) - radius[a] - radius[b]
    if (gap < 0).any():
        raise VolfrepError(
            f"Struts overlap near {place_text(one[np.argmin(gap)])}, where they have no joint: "
            "make them thinner, or use the faceted STEP form."
        )


def _closest(p: Floats, q: Floats, r: Floats, s: Floats) -> tuple[Floats, Floats]:
    """The points of the segments p-q and r-s that are nearest to each other."""
    u, v, w = q - p, s - r, p - r
    a, b, c = (np.einsum("ij,ij->i", *pair) for pair in ((u, u), (u, v), (v, v)))
    d, e = np.einsum("ij,ij->i", u, w), np.einsum("ij,ij->i", v, w)
    across = a * c - b * b
    skew = across > 1e-12 * a * c
    first = np.where(skew, (b * e - c * d) / np.where(skew, across, 1.0), 0.0).clip(0.0, 1.0)
    # The best place on the second for the first, then the other way round: exact once clipped.
    second = ((b * first + e) / np.where(c > 0, c, 1.0)).clip(0.0, 1.0)
    first = ((b * second - d) / np.where(a > 0, a, 1.0)).clip(0.0, 1.0)
    return p + first[:, None] * u, r + second[:, None] * v


def joint_volume(joint: Joint) -> float:
    """Volume of a kind of joint, mm3, estimated by sampling: the spread is about 0.3 %.

    A point that lies in k pieces stands for a k-th of itself in each of them (Karp and Luby).
    """
    length = np.linalg.norm(joint.arms, axis=1)
    direction = joint.arms / length[:, None]
    first, last = joint.radii.T
    rng = np.random.default_rng(1)
    count = len(length)
    # Uniform in a frustum: its volume up to a height is a cubic in the radius there.
    share = rng.random((count, SAMPLES))
    cone = np.cbrt(first[:, None] ** 3 + share * (last**3 - first**3)[:, None])
    slope = (last - first)[:, None]
    steep = np.abs(slope) > 1e-6 * first[:, None]
    height = np.where(steep, (cone - first[:, None]) / np.where(steep, slope, 1.0), share)
    radius = (first[:, None] + height * slope) * np.sqrt(rng.random((count, SAMPLES)))
    one, two = axes_across(direction)
    angle = rng.random((count, SAMPLES, 1)) * 2.0 * np.pi
    across = np.cos(angle) * one[:, None] + np.sin(angle) * two[:, None]
    in_arms = height[..., None] * joint.arms[:, None] + radius[..., None] * across
    way = rng.normal(size=(SAMPLES, 3))
    way *= joint.ball / np.linalg.norm(way, axis=1, keepdims=True)
    in_ball = way * np.cbrt(rng.random((SAMPLES, 1)))

    points = np.concatenate([in_arms.reshape(-1, 3), in_ball])
    along = times(points, direction.T)
    off = np.sqrt(np.maximum((points**2).sum(axis=1)[:, None] - along**2, 0.0))
    inside = (along >= 0) & (along <= length) & (off <= first + along / length * (last - first))
    pieces = inside.sum(axis=1) + ((points**2).sum(axis=1) <= joint.ball**2)
    # Rounding may put a point just outside the piece that it was drawn from.
    weight = (1.0 / np.maximum(pieces, 1)).reshape(count + 1, SAMPLES).mean(axis=1)
    volumes = np.pi / 3.0 * length * (first**2 + first * last + last**2)
    return float(weight[:-1] @ volumes + weight[-1] * 4.0 / 3.0 * np.pi * joint.ball**3)
