# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants are laid as far out as their struts reach, in a bounded number of tries."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

from volfrep import VolfrepError
from volfrep.lattice.deform import Deformed
from volfrep.trim.placed_lattice import FIRST_MARGIN, MOST_WIDENINGS, SPARE_MARGIN, lay
from volfrep.util.progress import Monitor


@dataclass
class Octants:
    """Stand-in for the octants within a margin: laid out, they are that margin."""

    margin: float

    def lay_out(self, octants):
        return self.margin


def laid(reach):
    """The margins that were tried where octants within a margin reach so far out."""
    tried = [FIRST_MARGIN]

    def within(margin):
        tried.append(margin)
        return Octants(margin), {}

    def place(margin):
        return Deformed(np.zeros((0, 3)), reach(margin))

    found = lay((Octants(FIRST_MARGIN), {}), FIRST_MARGIN, within, place, Monitor())
    assert found.layout == tried[-1]
    return tried


def test_octants_that_stay_near_are_laid_at_once():
    assert laid(lambda margin: 0.04) == [FIRST_MARGIN]


def test_octants_that_reach_out_are_looked_for_as_far_as_they_reach():
    assert laid(lambda margin: 0.3) == [FIRST_MARGIN, SPARE_MARGIN * 0.3]


def test_a_search_that_finds_ever_farther_ones_ends():
    """Where every step finds octants a little farther out, steps double; it cannot go on."""
    tried = laid(lambda margin: min(1.2 * margin, 3.0))
    assert len(tried) < MOST_WIDENINGS
    assert all(b >= 2.0 * a for a, b in pairwise(tried[1:]))
    with pytest.raises(VolfrepError, match="out of their places"):
        laid(lambda margin: 1.2 * margin)
