# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a filled part or a block is handed out as."""

from dataclasses import replace

import numpy as np

import volfrep
from volfrep.trim.trimmed_surface import TrimmedSurface


def test_a_mesh_that_lies_in_a_file_is_handed_out_to_be_written() -> None:
    made = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1).result
    kept = made.mesh
    for array in (kept.vertices, kept.triangles):
        array.setflags(write=False)
    found = replace(made, surface=TrimmedSurface(kept)).mesh
    assert np.array_equal(found.triangles, kept.triangles)
    before = kept.vertices.copy()
    found.vertices[:] += 1.0
    found.triangles[:] = 0
    assert np.array_equal(kept.vertices, before)
