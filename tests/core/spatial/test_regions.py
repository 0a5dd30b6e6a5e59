# SPDX-License-Identifier: LGPL-2.1-or-later
"""Workers that look for crossings region by region find what one look over all does."""

from __future__ import annotations

import numpy as np
import pytest

import samples
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.process.pool import backend_of, processes
from volfrep.spatial import regions
from volfrep.spatial.resolve_crossings import _crossing_in_file
from volfrep.util.progress import Monitor


def crossing_balls() -> TriangleMesh:
    """A row of balls, each of which runs through the next one."""
    ball = samples.sphere(10.0, 3)
    way = np.array([13.0, 0.3, 0.2])
    return concatenate(*(TriangleMesh(ball.vertices + k * way, ball.triangles) for k in range(4)))


@pytest.mark.costly
def test_regions_are_looked_at_by_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(regions, "REGION_TRIANGLES", 200)
    mesh, monitor = crossing_balls(), Monitor()
    wanted = np.arange(len(mesh.triangles)) % 3 == 0

    def found() -> tuple[int, np.ndarray]:
        parts = list(regions.in_regions(_crossing_in_file, mesh, wanted, 1e-6, monitor))
        return len(parts), np.unique(np.concatenate(parts), axis=0)

    whole, pairs = found()
    assert whole == 1
    assert len(pairs) > 50
    with processes(2) as executor:
        monitor.backend = backend_of(executor)
        many, again = found()
        assert many > 4
        np.testing.assert_array_equal(again, pairs)
    # With the workers gone this process looks.
    assert found()[0] == 1
