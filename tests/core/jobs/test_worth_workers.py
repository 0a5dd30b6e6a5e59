# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many processes a fill is worth."""

import pytest

import samples
from volfrep import LatticeSpec
from volfrep.design.forecast import forecast_fill
from volfrep.jobs import workers

SPEC = LatticeSpec("CVC", 4.0, 0.4, shell=1.0)


@pytest.mark.parametrize(("room", "count"), [(-1.0, 1), (0.5, 1), (3.5, 4), (100.0, 6)])
def test_a_fill_has_no_more_workers_than_memory_has_room_for(monkeypatch, room, count):
    expected = forecast_fill(samples.box((60.0, 60.0, 60.0)), SPEC)
    assert expected.triangles > 6 * workers.WORTH_WORKER
    free = 1e9 * expected.memory_gb + room * workers.WORKER_BYTES
    monkeypatch.setattr(workers, "free_memory", lambda: free)
    monkeypatch.setattr(workers, "threads", lambda: 6)
    assert workers.worth_processes(SPEC, expected) == count


def test_a_small_fill_and_the_bare_domain_have_no_workers(monkeypatch):
    monkeypatch.setattr(workers, "threads", lambda: 6)
    solid = samples.box((60.0, 60.0, 60.0))
    small = LatticeSpec("CVC", 30.0, 1.0, shell=1.0)
    assert workers.worth_processes(small, forecast_fill(solid, small)) == 1
    domain = LatticeSpec("CVC", 4.0, 0.4, shell=1.0, output="domain")
    assert workers.worth_processes(domain, forecast_fill(solid, SPEC)) == 1
