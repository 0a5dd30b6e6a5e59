# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which struts and balls of a network come too near to each other to be meshed joint by joint."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..grid.strut_graph import Wireframe
from ..util.ragged import spread
from ..util.types import Floats, Ints


def segment_distances(a: Floats, b: Floats, c: Floats, d: Floats) -> Floats:
    """(k,) distance between the segments a b and c d, each (k, 3).

    Closed form by cases, C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9.

    >>> one, two = np.zeros((1, 3)), np.array([[0.0, 0.0, 1.0]])
    >>> float(segment_distances(one, one + [2, 0, 0], two + [1, 0, 0], two + [1, 5, 0])[0])
    1.0
    """
    u, v, w = b - a, d - c, a - c
    uu, vv, uv = (u * u).sum(1), (v * v).sum(1), (u * v).sum(1)
    uw, vw = (u * w).sum(1), (v * w).sum(1)
    cross = uu * vv - uv * uv
    tiny = np.finfo(float).tiny
    with np.errstate(divide="ignore", invalid="ignore"):
        s = np.where(cross > 1e-12 * uu * vv, (uv * vw - uw * vv) / cross, 0.0)
    s = np.clip(s, 0.0, 1.0)
    t = (uv * s + vw) / np.maximum(vv, tiny)
    outside = (t < 0.0) | (t > 1.0)
    t = np.clip(t, 0.0, 1.0)
    s = np.where(outside, np.clip((uv * t - uw) / np.maximum(uu, tiny), 0.0, 1.0), s)
    found: Floats = np.linalg.norm(w + u * s[:, None] - v * t[:, None], axis=1)
    return found


def too_near(frame: Wireframe, wide: float, ball: float) -> Ints:
    """(k, 2) struts and nodes that overlap without sharing a node, nodes counted after the struts.

    Args:
        frame: the network.
        wide: by what the struts' corners lie outside their radius.
        ball: by what the balls' corners lie outside theirs.
    """
    struts, count = frame.struts.astype(np.int64), len(frame.struts)
    start, end = (np.concatenate([frame.nodes[struts[:, k]], frame.nodes]) for k in (0, 1))
    radius = np.concatenate([wide * frame.radii.max(axis=1), ball * frame.joint_radii])
    length = np.linalg.norm(end - start, axis=1)
    widest = float(radius.max())
    # Long struts are looked for piece by piece, so that the tree's balls are small.
    piece = max(float(np.median(length[:count])), 4.0 * widest)
    pieces = np.maximum(np.ceil(length / piece).astype(np.int64), 1)
    owner, place = spread(pieces)
    share = (place + 0.5) / pieces[owner]
    middle = start[owner] + share[:, None] * (end - start)[owner]
    half = 0.5 * length[owner] / pieces[owner] + radius[owner]
    pairs = cKDTree(middle).query_pairs(2.0 * float(half.max()), output_type="ndarray")
    near = np.linalg.norm(middle[pairs[:, 0]] - middle[pairs[:, 1]], axis=1)
    pairs = owner[pairs[near < half[pairs].sum(axis=1)]]
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    ends = np.concatenate([struts, np.repeat(np.arange(len(frame.nodes))[:, None], 2, axis=1)])
    one, two = pairs.T
    apart = (ends[one][:, :, None] != ends[two][:, None, :]).all(axis=(1, 2))
    nodes = len(frame.nodes)
    low, high = struts.min(axis=1), struts.max(axis=1)
    joined = np.isin(ends[one, 0] * nodes + ends[two, 0], low * nodes + high) & (one >= count)
    pairs = pairs[apart & ~joined]
    one, two = pairs.T
    distance = segment_distances(start[one], end[one], start[two], end[two])
    found: Ints = pairs[distance < radius[one] + radius[two]]
    return found
