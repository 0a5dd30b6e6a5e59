# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers that look up the distances of a wall's points: the wall is the same."""

from __future__ import annotations

import numpy as np
import pytest

import samples
from volfrep.process.pool import WorkerPool, backend_of, processes
from volfrep.shell import depth
from volfrep.shell.offset import find_cavity
from volfrep.util.progress import Monitor


@pytest.mark.costly
def test_a_wall_by_workers_is_that_of_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(depth, "POINTS_PER_CALL", 500)
    solid, monitor = samples.sphere(10.0, 3), Monitor()
    here = find_cavity(solid, 2.0, monitor)
    with processes(2) as executor:
        monitor.backend = backend_of(executor)
        there = find_cavity(solid, 2.0, monitor)
        assert isinstance(executor, WorkerPool)
        assert executor.workers, "they were asked"
    np.testing.assert_array_equal(there.mesh.vertices, here.mesh.vertices)
    np.testing.assert_array_equal(there.mesh.triangles, here.mesh.triangles)
    assert there.worst == here.worst
