# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of a study: a row for each design, as CSV, and as Parquet where pandas is there.

Times stand in the last columns: all the others are the same however often a study was interrupted.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..util.errors import VolfrepError
from ..util.files import replacing
from ..util.packages import make_frame
from ..util.types import Floats
from .actions import ACTIONS
from .designs import Design
from .records import Record

if TYPE_CHECKING:
    import pandas

#: Before the name of an action, in the column of its time.
SECONDS = "seconds."
#: What a row says of its design.
DONE, FAILED, OPEN = "done", "failed", "open"


@dataclass(frozen=True, repr=False)
class Table:
    """Designs and what is known of them.

    Attributes:
        columns: names: ``key``, ``part``, the values of parameters, ``state``, ``front``, then the
            figures by action and name such as ``fill.mass_g``, ``error``, and the times.
        rows: a value a column; None where there is none.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]

    def __repr__(self) -> str:
        return f"<Table of {len(self.rows)} designs: {', '.join(self.columns)}>"

    def column(self, name: str) -> list[Any]:
        """The values of a column.

        Raises:
            VolfrepError: there is none of that name.
        """
        if name not in self.columns:
            raise VolfrepError(
                f"The table has no column '{name}': choose from {', '.join(self.columns)}."
            )
        place = self.columns.index(name)
        return [row[place] for row in self.rows]

    def numbers(self, name: str) -> Floats:
        """(n,) the values of a column, not a number where there is none."""
        values = self.column(name)
        numeric = (float(v) if isinstance(v, (int, float)) else np.nan for v in values)
        return np.array(list(numeric), float)

    def dicts(self) -> list[dict[str, Any]]:
        """The rows by the names of their columns."""
        return [dict(zip(self.columns, row, strict=True)) for row in self.rows]

    def to_frame(self) -> pandas.DataFrame:
        """It as a frame of pandas.

        Raises:
            VolfrepError: pandas is missing.
        """
        return make_frame({name: self.column(name) for name in self.columns})


def table_of(
    designs: Sequence[Design],
    records: Sequence[Record | None],
    actions: tuple[str, ...],
    front: Mapping[str, int],
    on_all: tuple[str, ...],
) -> Table:
    """The table of designs and their records.

    Args:
        designs: in the order of the rows.
        records: of each; None for one that is not begun.
        actions: whose figures are shown.
        front: the front of each design that is chosen, by its key.
        on_all: the actions that every design is to have; the others are for the front.
    """
    shown = [record.values if record else {} for record in records]
    parameters = tuple(dict.fromkeys(name for values in shown for name in values))
    figures = tuple(
        dict.fromkeys(
            f"{name}.{figure}"
            for name in ACTIONS
            if name in actions
            for record in records
            if record is not None
            for figure in record.results.get(name, ())
        )
    )
    times = tuple(f"{SECONDS}{name}" for name in ACTIONS if name in actions)
    columns = ("key", "part", *parameters, "state", "front", *figures, "error", *times)
    rows = []
    for design, record, values in zip(designs, records, shown, strict=True):
        known = record or Record(design.key, "", {}, {})
        wanted = actions if design.key in front else on_all
        errors = [f"{name}: {known.errors[name]}" for name in wanted if name in known.errors]
        missing = [n for n in wanted if n not in known.results and n not in known.errors]
        state = OPEN if missing else FAILED if errors else DONE
        row: list[Any] = [design.key, design.part.name]
        row += [values.get(name) for name in parameters]
        row += [state, front.get(design.key)]
        for column in figures:
            action, _, figure = column.partition(".")
            row.append(known.results.get(action, {}).get(figure))
        row += [" ".join(errors) or None]
        row += [known.seconds.get(name.removeprefix(SECONDS)) for name in times]
        rows.append(tuple(_cell(value) for value in row))
    return Table(columns, tuple(rows))


def write_csv(table: Table, path: Path) -> None:
    """Write a table; numbers as they are, nothing where there is none.

    Raises:
        VolfrepError: the file cannot be written.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table.columns)
    writer.writerows(["" if value is None else value for value in row] for row in table.rows)
    with replacing(path) as file:
        file.write(text.getvalue().encode())


def write_parquet(table: Table, path: Path) -> bool:
    """Write a table where pandas is there, and what it writes Parquet with; whether it was.

    Raises:
        VolfrepError: the file cannot be written.
    """
    try:
        import pandas  # noqa: F401

        data = table.to_frame().to_parquet(index=False)
    except ImportError:  # no pandas, or neither pyarrow nor fastparquet
        return False
    with replacing(path) as file:
        file.write(data)
    return True


def _cell(value: Any) -> Any:
    """A list as a person writes it."""
    if not isinstance(value, list):
        return value
    if value and isinstance(value[0], list):
        return "; ".join(str(_cell(item)) for item in value)
    return ",".join(f"{number:g}" for number in value)
