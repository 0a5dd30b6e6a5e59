# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of figures: shown to the user as HTML or text, saved as CSV."""

from __future__ import annotations

import csv
import html
import io
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any

#: Separates columns in a CSV file.
SEPARATOR = ","
#: A table whose lines have more letters is as wide as the window, but for a hundredth: Qt rounds
#: columns that it has to squeeze up, and a whole window would then be scrolled by that pixel.
LONG, WIDTH = 48, ' width="99%"'
#: In text a cell of more letters does not widen its column.
WORDY = 40


@dataclass(frozen=True)
class Table:
    """Named rows of figures.

    Attributes:
        title: above it.
        rows: the cells of each row; the first of a row says what the others are.
        header: the columns' names, or nothing.
    """

    title: str
    rows: tuple[tuple[Any, ...], ...]
    header: tuple[str, ...] = ()


def shown(value: Any) -> str:
    """A cell as a person reads it."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, float):
        return f"{value:,.1f}" if abs(value) >= 1000 else f"{value:.4g}"
    return str(value)


def as_html(tables: list[Table], said: Callable[[str], str] = str) -> str:
    """The tables as a document that a window shows and a browser opens.

    `said` gives titles, names and words in the user's language; what it does not know it returns.
    """
    parts = ['<!DOCTYPE html><html><head><meta charset="utf-8"></head><body>']
    for table in tables:
        parts += [f"<h3>{html.escape(said(table.title))}</h3>", table_html(table, said)]
    return "\n".join([*parts, "</body></html>"])


def table_html(table: Table, said: Callable[[str], str] = str) -> str:
    """A table without its title, as `as_html` has it."""
    lines = (table.header, *table.rows)
    long = max(sum(len(shown(cell)) for cell in line) for line in lines) > LONG
    parts = [f'<table cellspacing="0" cellpadding="3"{WIDTH * long}>']
    if table.header:
        cells = "".join(f'<th align="left">{html.escape(said(name))}</th>' for name in table.header)
        parts.append(f"<tr>{cells}</tr>")
    for first, *others in table.rows:
        cells = "".join(f"<td>{html.escape(said(shown(value)))}</td>" for value in others)
        parts.append(f"<tr><td>{html.escape(said(str(first)))}&nbsp;&nbsp;</td>{cells}</tr>")
    return "\n".join([*parts, "</table>"])


def as_text(tables: Iterable[Table]) -> str:
    """The tables one below the other as a terminal shows them, their columns in line."""
    lines = []
    for table in tables:
        rows = [[table.title, *table.header[1:]]]
        for first, *others in table.rows:
            rows.append([f"  {first}", *("" if cell is None else shown(cell) for cell in others)])
        short = [[len(cell) if len(cell) <= WORDY else 0 for cell in row] for row in rows]
        widths = [max(column) for column in zip_longest(*short, fillvalue=0)]
        lines += ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    return "\n".join(lines)


def as_csv(tables: list[Table]) -> str:
    """The tables one below the other, an empty line between; numbers as they are."""
    text = io.StringIO()
    writer = csv.writer(text, delimiter=SEPARATOR, lineterminator="\n")
    for k, table in enumerate(tables):
        if k:
            writer.writerow(())
        writer.writerow((table.title,))
        if table.header:
            writer.writerow(table.header)
        writer.writerows(
            tuple("" if value is None else value for value in row) for row in table.rows
        )
    return text.getvalue()
