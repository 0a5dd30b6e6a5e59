# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where struts carry nothing and go, and what is told of it."""

import pytest

from volfrep import LatticeSpec
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.blocks import block_wireframe
from volfrep.jobs.sizing.thin_struts import empty_places


def without(frame, gone):
    return Wireframe(frame.nodes, frame.struts[~gone], frame.radii[~gone], frame.joint_radii)


def test_struts_that_hang_together_are_a_place():
    """Two cells of a row of four taken out, at its ends: two places of eight diagonals each."""
    frame = block_wireframe(LatticeSpec("CVC", cell_size=10.0, strut_radius=1.0), (4, 1, 1))
    x = frame.nodes[frame.struts].mean(axis=1)[:, 0]
    gone = (x < 10.0) | (x > 30.0)
    first, second = empty_places(frame, without(frame, gone))
    assert first["struts"] == second["struts"] == gone.sum() / 2
    middles = sorted(place["middle_mm"][0] for place in (first, second))
    assert middles == pytest.approx([5.0, 35.0])
    assert empty_places(frame, frame) == []
