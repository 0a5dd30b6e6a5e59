# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a lattice lies in its part, and how deep its nodes are below the surface."""

import numpy as np

import samples
from volfrep.grid import placement
from volfrep.grid.placement import DepthsBelow
from volfrep.util.progress import Monitor


def test_depths_of_points_that_were_asked_for_before_are_not_looked_for_again(monkeypatch):
    """The depth in a box is the way to its nearest face."""
    solid = samples.box((10.0, 10.0, 10.0))
    low, high = solid.bounds
    asked = []
    look = placement.depth_below

    def counted(solid, monitor, points):
        asked.append(len(points))
        return look(solid, monitor, points)

    monkeypatch.setattr(placement, "depth_below", counted)
    depths = DepthsBelow(solid, Monitor())
    first = np.random.default_rng(0).uniform(low, high, (50, 3))
    more = np.concatenate([first[::-1] + 1e-14, first + 0.5, high[None] + 1.0])
    for points in (first, more):
        inside = ((points > low) & (points < high)).all(axis=1)
        exact = np.minimum(points - low, high - points).min(axis=1)
        assert np.allclose(depths(points), np.where(inside, exact, 0.0), atol=1e-9)
    assert asked == [50, 51]
