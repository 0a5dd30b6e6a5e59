# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours of limits that govern."""

import numpy as np
import pytest

from volfrep.sizing.limit_colours import COLOURS, limit_colour, limit_colours


def test_each_limit_has_its_colour_and_very_many_share_the_last():
    found = limit_colours(np.array([0.0, 1.0000001, 200.0]))
    assert found == pytest.approx(np.array([[68, 119, 170], [238, 102, 119], [187] * 3]) / 255)
    assert limit_colour(0) == "#4477aa"
    assert limit_colour(200) == COLOURS[-1]
