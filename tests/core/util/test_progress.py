# SPDX-License-Identifier: LGPL-2.1-or-later
"""Progress comes in order, a cancel is honoured soon, every stage is timed."""

import threading
import time

import pytest

from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor, peak_memory_mb


def test_progress_is_scaled_into_the_whole() -> None:
    seen: list[tuple[float, str]] = []
    monitor = Monitor(lambda fraction, stage: seen.append((fraction, stage)))
    with monitor.stage("first", 0.0, 0.4):
        monitor.tick(0.5)
        monitor.tick()
    with monitor.stage("second", 0.4, 1.0) as inner:
        inner.tick(7.0)  # more than all of it counts as all of it
    assert seen == [
        (0.0, "first"),
        (0.2, "first"),
        (0.2, "first"),
        (0.4, "second"),
        (1.0, "second"),
    ]


def test_only_false_cancels() -> None:
    for answer in (None, True):
        with Monitor(lambda fraction, stage, answer=answer: answer).stage("work", 0, 1) as monitor:
            monitor.tick(0.5)
    with (
        pytest.raises(Cancelled, match="cancelled during work"),
        Monitor(lambda fraction, stage: False).stage("work", 0, 1),
    ):
        pytest.fail("the stage must not begin")


def test_stages_are_timed_and_repeated_ones_add_up() -> None:
    monitor = Monitor()
    for _ in range(2):
        with monitor.stage("sleep", 0, 1):
            time.sleep(0.02)
    assert monitor.stages["sleep"] >= 0.04
    assert monitor.memory_mb["sleep"] > 1.0


def test_a_stage_that_fails_is_timed_all_the_same() -> None:
    monitor = Monitor()
    with pytest.raises(KeyError), monitor.stage("failing", 0, 1):
        raise KeyError
    assert "failing" in monitor.stages


def test_a_call_returns_its_value_or_its_error() -> None:
    for monitor in (Monitor(), Monitor(lambda fraction, stage: None)):
        assert monitor.call(lambda: 42) == 42
        with pytest.raises(ZeroDivisionError):
            monitor.call(lambda: 1 // 0)
        with pytest.raises(TimeoutError, match="its own"):
            monitor.call(_times_out)


def _times_out() -> None:
    raise TimeoutError("its own")


def test_a_long_call_is_left_on_cancel() -> None:
    release, ended = threading.Event(), threading.Event()
    asked: list[float] = []

    def answer(fraction: float, stage: str) -> bool:
        asked.append(fraction)
        return len(asked) < 2

    with pytest.raises(Cancelled):
        Monitor(answer).call(lambda: release.wait(300) and ended.set())
    assert len(asked) == 2
    assert not ended.is_set()
    release.set()
    assert ended.wait(300)


def test_peak_memory_grows_with_what_is_held() -> None:
    before = peak_memory_mb()
    held = bytearray(200_000_000)
    held[::4096] = b"x" * len(held[::4096])
    assert peak_memory_mb() > before + 100 or before > 200
