# SPDX-License-Identifier: LGPL-2.1-or-later
"""A stage's result is kept under what the stage was given."""

import numpy as np

from volfrep import StageCache
from volfrep.util.cache import Kept
from volfrep.util.content import content_of


def counted(runs, function):
    """The function, and a note in the list at each of its calls."""

    def call(*given):
        runs.append(given)
        return function(*given)

    return call


def test_a_stage_runs_again_only_when_what_it_is_given_changes():
    cache, runs = StageCache(), []
    add = counted(runs, lambda a, b: a + b)
    assert cache.run("sum", add, 1, 2).value == 3
    assert cache.run("sum", add, 1, 2).value == 3
    assert len(runs) == 1
    assert cache.run("sum", add, 1, 3).value == 4
    assert cache.run("sum", add, 1, 2).value == 3  # the last one only is kept
    assert len(runs) == 3


def test_what_cannot_be_compared_is_told_by_its_key():
    cache, runs = StageCache(), []
    largest = counted(runs, np.max)
    one, same, other = np.arange(3), np.arange(3), np.arange(4)
    for array in (one, same):
        assert cache.run("largest", largest, Kept(array, content_of(array))).value == 2
    assert len(runs) == 1
    assert runs[0][0] is one
    assert cache.run("largest", largest, Kept(other, content_of(other))).value == 3


def test_a_stage_runs_again_when_an_earlier_one_did():
    cache, runs = StageCache(), []
    double = counted(runs, lambda value: 2 * value)
    for start in (1, 1, 5):
        first = cache.run("first", lambda value: value + 1, start)
        assert cache.run("second", double, first).value == 2 * (start + 1)
    assert len(runs) == 2


def test_arrays_of_the_same_bytes_and_another_shape_are_told_apart():
    flat = np.zeros(6)
    assert content_of(flat) == content_of(flat.copy())
    assert content_of(flat) != content_of(flat.reshape(2, 3))
    assert content_of(flat) != content_of(flat.astype(np.int64))
    assert content_of(flat, flat) != content_of(flat)
