# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rows of figures as Markdown, and the power law through them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

#: One measurement by column; with a "note" it has that instead of the figures it lacks.
Row = dict[str, Any]


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Attributes:
        title: as it is shown.
        key: of the value in a row.
        form: what makes a text of the value: a format such as ``.2f``, or a function.
    """

    title: str
    key: str
    form: str | Callable[[Any], str] = ""

    def text(self, row: Row) -> str:
        """The value of a row, empty where it has none."""
        value = row.get(self.key)
        if value is None:
            return ""
        if callable(self.form):
            return self.form(value)
        return format(value, self.form)


def yes_no(value: bool) -> str:
    """How a table tells whether something holds."""
    return "yes" if value else "no"


#: Of a table with as many rows a column that says the same in all is a sentence below it.
TOLD_ONCE = 3


def table(columns: Sequence[Column], rows: Sequence[Row]) -> str:
    """The rows as a Markdown table, columns without any value left out.

    A column whose values are all the same is told once, below. Notes come in a last column of
    their own, if there is one.
    """
    shown = [column for column in columns if any(column.text(row) for row in rows)]
    same = []
    for column in shown[1:] if len(rows) >= TOLD_ONCE else []:
        values = {column.text(row) for row in rows}
        if len(values) == 1:
            same.append(f"{column.title}: {values.pop()}")
            shown = [other for other in shown if other is not column]
    if any(row.get("note") for row in rows):
        shown.append(Column("", "note"))
    lines = [[column.title for column in shown], ["---"] * len(shown)]
    lines += [[column.text(row).replace("|", "/") for column in shown] for row in rows]
    text = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    return f"{text}\n\nIn all rows {', '.join(same)}." if same else text


def figures_of(row: Row) -> str:
    """Seconds, MB of the file and MB of memory, as far as they were measured."""
    forms = (("seconds", ".2f"), ("mb", ",.1f"), ("peak_mb", ",.0f"))
    return ", ".join(format(row[key], form) for key, form in forms if row.get(key) is not None)


def measured(rows: Sequence[Row], *keys: str) -> list[Row]:
    """The rows that have all of these values."""
    return [row for row in rows if all(row.get(key) is not None for key in keys)]


@dataclass(frozen=True)
class PowerLaw:
    """y = factor x^exponent, least squares of the logarithms; r2 of the logarithms."""

    exponent: float
    factor: float
    r2: float

    def inverse(self, y: float) -> float:
        """The x at which the law reaches y."""
        return float((y / self.factor) ** (1.0 / self.exponent))


def power_law(x: Sequence[float], y: Sequence[float]) -> PowerLaw:
    """The power law through two points or more, all above 0.

    Raises:
        ValueError: there are fewer than two different x, or a value is not above 0.
    """
    if len(set(x)) < 2 or min(*x, *y) <= 0:
        raise ValueError("a power law needs two different points, all above 0")
    u, v = np.log(np.array(x, float)), np.log(np.array(y, float))
    slope, offset = np.polyfit(u, v, 1)
    spread = float(((v - v.mean()) ** 2).sum())
    left = float(((v - slope * u - offset) ** 2).sum())
    return PowerLaw(float(slope), math.exp(offset), 1.0 if spread == 0 else 1 - left / spread)


def bar(text: str, value: float | None, limit: float, unit: str, form: str = ".2f") -> Row:
    """A promise beside its figure: met where the value is not above the limit."""
    if value is None:
        return {"text": text, "bar": f"{limit:g} {unit}".strip(), "met": None}
    figure = f"{value:{form}} {unit}".strip()
    return {"text": text, "bar": f"{limit:g} {unit}".strip(), "measured": figure,
            "met": value <= limit}  # fmt: skip


def verdict(met: bool | None) -> str:
    """What a bar came to, in a word."""
    return {True: "met", False: "missed", None: "not measured"}[met]


def bars_told(bars: Sequence[Row]) -> str:
    """Promises beside their figures, a line for those of one job with the same bar."""
    lines: dict[tuple[str, str], list[str]] = {}
    for row in bars:
        job, _, rest = row["text"].partition(", ")
        words = [rest, *([row["measured"]] if "measured" in row else [])]
        words += [f"({verdict(row['met'])})"] if row["met"] is not False else []
        lines.setdefault((job, row["bar"]), []).append(" ".join(filter(None, words)))
    return "\n".join(
        f"- {job}, bar of {limit}: {'; '.join(rows)}" for (job, limit), rows in lines.items()
    )
