# SPDX-License-Identifier: LGPL-2.1-or-later
"""Triangles that cross while vertices move, against a look at all of the mesh."""

import numpy as np
import pytest

import samples
from volfrep.io.write.stl import as_read
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial.crossing_watch import CrossingWatch
from volfrep.spatial.piercing import piercing_pairs
from volfrep.util.progress import Monitor


@pytest.mark.parametrize("far", [0.01, 0.3, 1.5], ids=["within room", "out of it", "far away"])
def test_no_pair_is_missed_however_far_vertices_move(far):
    ball = samples.sphere(10.0, 2)
    shifted = TriangleMesh(ball.vertices + np.array([17.0, 3.1, 1.7]), ball.triangles)
    mesh = concatenate(ball, shifted)
    watch = CrossingWatch(mesh, np.arange(len(mesh.triangles)) < 200, Monitor())
    random, vertices = np.random.default_rng(0), mesh.vertices.copy()
    found = 0
    for _ in range(4):
        moved = random.random(len(vertices)) < 0.3
        vertices = vertices + np.where(moved[:, None], random.normal(0.0, far, (len(moved), 3)), 0)
        every = piercing_pairs(as_read(TriangleMesh(vertices, mesh.triangles)))
        wanted = every[moved[mesh.triangles[every]].any(axis=(1, 2))]
        got = watch.crossing(vertices, moved)
        assert {tuple(pair) for pair in wanted} <= {tuple(pair) for pair in got}
        assert moved[mesh.triangles[got]].any(axis=(1, 2)).all()
        found += len(wanted)
    assert found > 5
