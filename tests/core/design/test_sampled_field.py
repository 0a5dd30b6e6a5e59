# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields by functions and formulas: samples of them, which are all that counts."""

import pickle

import numpy as np
import pytest

from volfrep.design.sampled_field import MOST_SAMPLES, sample_function
from volfrep.util.errors import VolfrepError

BOX = np.array([[0.0, 0.0, 0.0], [20.0, 10.0, 5.0]])


def linear(points):
    return 1.0 + points @ np.array([0.1, -0.02, 0.05])


def test_a_linear_function_is_met_everywhere_and_held_beyond_the_box():
    field = sample_function(linear, BOX, 2.5, "radius")
    places = np.random.default_rng(1).uniform(*BOX, (100, 3))
    assert field(places) == pytest.approx(linear(places))
    assert field([[99.0, 5.0, 5.0]]) == pytest.approx(linear(np.array([[20.0, 5.0, 5.0]])))
    assert field.bounds.tolist() == BOX.tolist()


def test_a_function_and_a_formula_of_the_same_values_are_equal_and_travel():
    field = sample_function(linear, BOX, 2.5, "radius")
    alike = sample_function("1 + 0.1 * x - 0.02 * y + 0.05 * z", BOX, 2.5, "radius")
    assert alike(BOX) == pytest.approx(field(BOX))
    by_lambda = sample_function(lambda points: linear(points), BOX, 2.5, "radius")
    assert by_lambda == field == pickle.loads(pickle.dumps(field))
    assert by_lambda != sample_function(lambda at: linear(at) + 1e-9, BOX, 2.5, "radius")


def test_many_samples_lie_farther_apart():
    field = sample_function("x", BOX * 100.0, 1.0, "radius")
    assert 0.5 * MOST_SAMPLES < field.values.size <= MOST_SAMPLES


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda points: points, r"gives \(n,\) values"),
        (lambda points: 1.0 / 0.0, "ZeroDivisionError"),
        (lambda points: np.log(points[:, 0] - 1.0), "no finite value at"),
        ("1 / x", r"no finite value at \(0, 0, 0\)"),
        ("1 + q", "'q' is not known"),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_what_is_no_field_is_refused(function, words):
    with pytest.raises(VolfrepError, match=words):
        sample_function(function, BOX, 2.5, "radius")
