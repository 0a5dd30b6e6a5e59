# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is told of a deck of tetrahedra: how far their surface is from the mesh's."""

import numpy as np

from volfrep.fem.tet_mesh import TetrahedralMesh
from volfrep.output.decks import _told


def told(strayed, deviation):
    nothing = np.zeros((0, 3)), np.zeros((0, 10), np.int64)
    return _told(TetrahedralMesh(*nothing, strayed=strayed), deviation)


def test_a_surface_that_was_mended_is_told_and_warned_of_beyond_the_deviation():
    assert told(0.0, 0.08) == ((), ())
    for deviation in (0.08, None):
        warnings, rows = told(0.052, deviation)
        assert not warnings
        assert rows == (("surface", "within 0.052 mm of the mesh's, its needles mended"),)
    (warning,), rows = told(0.052, 0.04)
    assert "up to 0.052 mm from the mesh's, which is more than the deviation of 0.04 mm" in warning
    assert rows
