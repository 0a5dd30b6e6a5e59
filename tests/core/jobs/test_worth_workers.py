# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many processes a fill is worth."""

import pytest

import samples
from volfrep import LatticeSpec
from volfrep.design import forecast
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


@pytest.mark.parametrize("part", [samples.box((60.0, 60.0, 60.0)), samples.sphere(30.0, 4)])
@pytest.mark.parametrize(
    "spec", [LatticeSpec("CVC", 6.0, 0.6, shell=1.0), LatticeSpec("Octet", 10.0, 1.0)]
)
def test_a_fill_that_is_not_foretold_has_about_as_many_workers(monkeypatch, part, spec):
    monkeypatch.setattr(workers, "threads", lambda: 64)
    told = workers.worth_processes(spec, forecast_fill(part, spec))
    monkeypatch.setattr(forecast, "forecast_fill", None)
    monkeypatch.setattr(workers, "free_memory", lambda: 2.0 * workers.MUCH_MEMORY)
    assert 0.75 * told - 1 <= workers.worth_untold(spec, part, streamed=False) <= told


def test_where_memory_is_short_or_much_is_made_a_fill_is_foretold(monkeypatch):
    solid, asked = samples.box((60.0, 60.0, 60.0)), []

    def foretell(solid, spec, *, streamed):
        asked.append(streamed)
        return forecast_fill(solid, spec, streamed=streamed)

    monkeypatch.setattr(forecast, "forecast_fill", foretell)
    monkeypatch.setattr(workers, "free_memory", lambda: 0.5 * workers.MUCH_MEMORY)
    workers.worth_untold(SPEC, solid, streamed=True)
    monkeypatch.setattr(workers, "free_memory", lambda: 2.0 * workers.MUCH_MEMORY)
    workers.worth_untold(LatticeSpec("CVC", 2.0, 0.2, shell=1.0), solid, streamed=False)
    assert asked == [True, False]
