# SPDX-License-Identifier: LGPL-2.1-or-later
"""The profiles of section 2.5 of the paper, by their values, and what no profile may be."""

import json
import math
import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from volfrep.design.profile import KINDS, Profile
from volfrep.util.errors import VolfrepError

POSITIVE = st.floats(1e-6, 1e6)
PLACE = st.floats(0.0, 1.0)
FORMULA_OF = {
    "linear": "{a} + s * ({b} - {a})",
    "quadratic": "{a} + ({b} - {a}) * s**2",
    "exponential": "{a} * exp(log({b} / {a}) * s)",
}


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("scalar", [2.0, 2.0, 2.0]),
        ("linear", [2.0, 5.0, 8.0]),
        ("quadratic", [2.0, 3.5, 8.0]),
        ("polynomial", [2.0, 3.5, 8.0]),
        ("exponential", [2.0, 4.0, 8.0]),
    ],
)
def test_values_at_both_ends_and_half_way(kind: str, expected: list[float]) -> None:
    np.testing.assert_allclose(Profile(kind, 2.0, 8.0)([0.0, 0.5, 1.0]), expected, rtol=1e-15)


@pytest.mark.parametrize("kind", FORMULA_OF)
@given(a=POSITIVE, b=POSITIVE, s=PLACE)
def test_a_law_is_the_published_formula(kind: str, a: float, b: float, s: float) -> None:
    profile = Profile(kind, a, b)
    by_hand = {
        "linear": a + s * (b - a),
        "quadratic": a + (b - a) * s * s,
        "exponential": a * math.exp(math.log(b / a) * s),
    }[kind]
    assert float(profile(s)) == pytest.approx(by_hand, rel=1e-12, abs=1e-12 * max(a, b))
    low, high = profile.extremes()
    assert (low, high) == (min(a, b), max(a, b))
    assert low * (1 - 1e-9) - 1e-9 <= float(profile(s)) <= high * (1 + 1e-9)


@pytest.mark.parametrize("kind", FORMULA_OF)
@given(a=st.floats(0.01, 100), b=st.floats(0.01, 100))
def test_a_formula_can_say_the_same(kind: str, a: float, b: float) -> None:
    s = np.linspace(0, 1, 17)
    formula = Profile("expression", expression=FORMULA_OF[kind].format(a=repr(a), b=repr(b)))
    np.testing.assert_allclose(formula(s), Profile(kind, a, b)(s), rtol=1e-9)
    np.testing.assert_allclose(formula.extremes(), Profile(kind, a, b).extremes(), rtol=1e-9)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("shape", [(), (0,), (4,), (2, 3)])
def test_values_have_the_shape_of_s(kind: str, shape: tuple[int, ...]) -> None:
    profile = Profile(kind, 1.0, 2.0, "1 + s" if kind == "expression" else "")
    values = profile(np.full(shape, 0.5))
    assert isinstance(values, np.ndarray)
    assert values.shape == shape
    assert values.dtype == np.float64


@pytest.mark.parametrize("kind", KINDS)
def test_beyond_its_ends_a_law_stays_what_it_is_there(kind: str) -> None:
    profile = Profile(kind, 1.0, 2.0, "1 + s" if kind == "expression" else "")
    np.testing.assert_array_equal(profile([-3.0, 7.0]), profile([0.0, 1.0]))


def test_the_widest_exponential_does_not_overflow() -> None:
    profile = Profile("exponential", 1e-6, 1e6)
    np.testing.assert_allclose(profile([0.0, 0.5, 1.0]), [1e-6, 1.0, 1e6], rtol=1e-12)


@pytest.mark.costly
@given(centre=st.floats(0.02, 0.98), height=st.floats(0.1, 50))
def test_extremes_of_a_formula_between_samples(centre: float, height: float) -> None:
    text = f"1 + {height!r} * exp(-(200 * (s - {centre!r})) ** 2)"
    low, high = Profile("expression", expression=text).extremes()
    assert high == pytest.approx(1 + height, rel=1e-9)
    assert low == pytest.approx(1.0, abs=1e-6)


def test_a_formulas_ends_are_its_own() -> None:
    profile = Profile("expression", 5.0, 6.0, "1 + 2 * s")
    assert (profile.start, profile.end) == (1.0, 3.0)
    assert profile == Profile("expression", expression=" 1 + 2 * s ")


def test_laws_that_mean_the_same_are_equal() -> None:
    assert Profile("scalar", 2.0, 9.0) == Profile("scalar", 2.0)
    assert Profile("polynomial", 1, 2) == Profile("quadratic", 1.0, 2.0)
    assert Profile("linear", 1, 2) != Profile("quadratic", 1, 2)
    assert len({Profile("scalar", 2.0, 9.0), Profile("scalar", 2.0)}) == 1


@pytest.mark.parametrize(
    "profile",
    [
        Profile(),
        Profile("linear", 1, 2),
        Profile("exponential", 0.1, 3),
        Profile("expression", expression="1 + 0.3 * sin(2 * pi * s)"),
    ],
)
def test_a_law_survives_json_and_pickle(profile: Profile) -> None:
    assert Profile(**json.loads(json.dumps(profile.as_dict()))) == profile
    s = np.linspace(0, 1, 11)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(profile))(s), profile(s))


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("cubic",), "There is no profile 'cubic': choose one of scalar, linear"),
        (("scalar", 0.0), "start must be above 0, not 0"),
        (("linear", 1.0, -1.0), "end must be above 0, not -1"),
        (("exponential", math.inf, 1.0), "start must be a finite number, not inf"),
        (("quadratic", 1.0, math.nan), "end must be a finite number, not nan"),
        (("linear", "thick", 1.0), "start must be a number, not 'thick'"),
        (("linear", 1.0, 2.0, "1 + s"), "belongs to the profile 'formula'"),
        (("expression",), "The formula is empty"),
        (("expression", 1, 1, "s"), "gives 0 at s = 0: it must stay above 0"),
        (("expression", 1, 1, "0.5 - s"), "at s = 0.5"),
        (("expression", 1, 1, "1 / (s - 0.25)"), "no finite value at s = 0.25"),
        (("expression", 1, 1, "sqrt(-s)"), "no finite value at s = 8.33"),
        (("expression", 1, 1, "os.getcwd()"), "In the formula, 'os.getcwd"),
        (("expression", 1, 1, None), "must be a text"),
    ],
)
def test_what_is_no_law_is_refused(arguments: tuple[Any, ...], sentence: str) -> None:
    with pytest.raises(VolfrepError, match=sentence):
        Profile(*arguments)


def test_a_pole_between_the_samples_is_found_when_it_is_hit() -> None:
    profile = Profile("expression", expression="1 / abs(s - 0.12345678)")
    with pytest.raises(VolfrepError, match=r"gives inf at s = 0\.123457"):
        profile([0.0, 0.12345678])


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"kind": "linear", "start": None}, "start must be a number"),
        ({"kind": 7}, "There is no profile '7'"),
        ({"kind": []}, "There is no profile"),
    ],
)
def test_what_is_no_law_in_a_file_is_refused(values: Any, sentence: str) -> None:
    with pytest.raises(VolfrepError, match=sentence):
        Profile(**values)
