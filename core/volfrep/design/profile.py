# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grading profiles: a quantity from one end of the part to the other (section 2.5 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..util.errors import VolfrepError
from ..util.numbers import number
from ..util.types import Floats
from .expression import SAMPLES, Expression, check_finite, compile_expression

KINDS = ("scalar", "linear", "quadratic", "exponential", "expression")
#: The kind of values that a field gave.
SAMPLED = "sampled"
#: Other names of kinds; the paper calls its quadratic profile polynomial, users say formula.
ALIASES = {"polynomial": "quadratic", "formula": "expression"}


@dataclass(frozen=True)
class Profile:
    """A positive quantity as a function of s, the place along the part from 0 to 1.

    With a = `start` and b = `end`:

    - ``scalar``: a everywhere;
    - ``linear``: a + (b - a) s;
    - ``quadratic`` (or ``polynomial``): a + (b - a) s2;
    - ``exponential``: a exp(ln(b / a) s);
    - ``expression``: the user's formula of s;
    - ``sampled``: straight between `values` at even steps of s, which no user types
      (`volfrep.design.cell_sizes`).

    Attributes:
        kind: one of `KINDS`, or ``sampled``.
        start: the value at s = 0, in whatever unit the quantity has.
        end: the value at s = 1. ``scalar`` takes `start` for it, and ``expression`` takes both
            from the formula, whatever was given: profiles that mean the same are equal.
        expression: the formula, for that kind only (see `volfrep.design.expression`).
        values: of the kind ``sampled`` only, two or more.

    Raises:
        VolfrepError: at construction: an unknown kind, a value that is not finite and positive,
            or a formula that is not so somewhere on [0, 1], naming the s.

    >>> Profile("linear", 1, 3)([0, 0.5, 1]).tolist()
    [1.0, 2.0, 3.0]
    >>> float(Profile("exponential", 1, 4)(0.5))
    2.0
    >>> Profile("formula", expression="1 + s * (1 - s)").extremes()
    (1.0, 1.25)
    """

    kind: str = "scalar"
    start: float = 1.0
    end: float = 1.0
    expression: str = ""
    values: tuple[float, ...] = ()
    _formula: Expression | None = field(init=False, repr=False, compare=False, default=None)

    def __post_init__(self) -> None:
        kind = ALIASES.get(str(self.kind), self.kind)
        if kind == SAMPLED and len(self.values) > 1:
            object.__setattr__(self, "values", tuple(_positive("value", v) for v in self.values))
            object.__setattr__(self, "start", self.values[0])
            object.__setattr__(self, "end", self.values[-1])
            return
        if kind not in KINDS:
            raise VolfrepError(
                f"There is no profile '{self.kind}': choose one of {', '.join(KINDS)}."
            )
        object.__setattr__(self, "kind", kind)
        if kind == "expression":
            self._compile()
            return
        if self.expression:
            raise VolfrepError(
                f"A formula belongs to the profile 'formula', not to '{kind}': leave it out or "
                "change the profile."
            )
        start = _positive("start", self.start)
        object.__setattr__(self, "start", start)
        object.__setattr__(self, "end", start if kind == "scalar" else _positive("end", self.end))

    def _compile(self) -> None:
        formula = compile_expression(self.expression)
        check_finite(formula)
        object.__setattr__(self, "expression", formula.text)
        object.__setattr__(self, "_formula", formula)
        start, end = self(SAMPLES)[[0, -1]].tolist()
        object.__setattr__(self, "start", start)
        object.__setattr__(self, "end", end)

    def __call__(self, s: ArrayLike) -> Floats:
        """The profile's values at `s`, float64 of the same shape; s is held to [0, 1].

        Raises:
            VolfrepError: a formula is not positive and finite at some s, which is named.
        """
        at = np.clip(np.asarray(s, dtype=np.float64), 0.0, 1.0)
        if self._formula is not None:
            return self._positive_values(self._formula(at), at)
        if self.kind == SAMPLED:
            return np.interp(at, np.linspace(0.0, 1.0, len(self.values)), self.values)
        if self.kind == "linear":
            return np.asarray(self.start + at * (self.end - self.start))
        if self.kind == "quadratic":
            return np.asarray(self.start + (self.end - self.start) * at * at)
        if self.kind == "exponential":
            # The published a exp(ln(b / a) s), in a form that is exact at both ends.
            return np.asarray(self.start ** (1.0 - at) * self.end**at)
        return np.full(at.shape, self.start)

    def _positive_values(self, values: Floats, at: Floats) -> Floats:
        bad = np.flatnonzero(~(np.isfinite(values) & (values > 0.0)).ravel())
        if len(bad):
            raise VolfrepError(
                f"The formula '{self.expression}' gives {values.flat[bad[0]]:.6g} at "
                f"s = {at.flat[bad[0]]:.6g}: it must stay above 0 from s = 0 to s = 1."
            )
        return values

    def extremes(self) -> tuple[float, float]:
        """The smallest and the largest value on [0, 1].

        Exact for every kind but ``expression``, which is sampled, and sampled again more densely
        about the smallest and the largest of the samples.
        """
        if self.kind == SAMPLED:
            return min(self.values), max(self.values)
        if self._formula is None:
            return min(self.start, self.end), max(self.start, self.end)
        values = self(SAMPLES)
        step = SAMPLES[1]
        about = SAMPLES[[values.argmin(), values.argmax()]]
        closer = self(about[:, None] + np.linspace(-step, step, 2001))
        return float(min(values.min(), closer.min())), float(max(values.max(), closer.max()))

    def as_dict(self) -> dict[str, Any]:
        """The profile as plain JSON values."""
        return {
            "kind": self.kind,
            "start": self.start,
            "end": self.end,
            "expression": self.expression,
        }


def _positive(name: str, value: Any) -> float:
    return number(f"profile's {name}", value, "", positive=True)
