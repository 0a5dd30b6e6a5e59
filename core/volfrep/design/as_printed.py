# SPDX-License-Identifier: LGPL-2.1-or-later
"""How thick struts come out of a printer: tables of diameter against inclination, with sources.

A row says what is added to a drawn diameter within a range of inclinations. Between rows the
addition goes over evenly, beyond the last it stays. These are single publications, of one machine
each: your own printer's figures are better, and `volfrep coupon` prints what to measure.
"""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..util.arguments import check_path
from ..util.errors import VolfrepError
from ..util.numbers import number
from ..util.reading import read_text
from ..util.types import Floats

#: Columns of a file of the user's.
COLUMNS = ("inclination", "nominal", "measured")


@dataclass(frozen=True)
class PrintedRow:
    """What comes out within a range of inclinations: ``diameter * (1 + share) + offset``.

    Attributes:
        low: least inclination to the build plate, degrees.
        high: largest one.
        offset: added to a drawn diameter, mm.
        share: added as a share of it.
        source: what was drawn and measured, and where that is written.
        scatter: standard deviation of what comes out, mm; 0 where it is not known.
    """

    low: float
    high: float
    offset: float
    share: float
    source: str
    scatter: float = 0.0


@dataclass(frozen=True)
class PrintedTable:
    """Diameters as they come out.

    Attributes:
        name: as a user picks it, or the file.
        title: process and material.
        rows: rising in inclination; they do not overlap.
    """

    name: str
    title: str
    rows: tuple[PrintedRow, ...]

    def printed(self, diameters: ArrayLike, inclinations: ArrayLike) -> Floats:
        """(n,) diameters in mm that come out.

        Args:
            diameters: (n,) as drawn, mm.
            inclinations: (n,) to the build plate, degrees from 0 to 90.
        """
        offset, share, _ = self.at(np.asarray(inclinations, float))
        return np.asarray(np.asarray(diameters, float) * (1.0 + share) + offset)

    def drawn(self, diameters: ArrayLike, inclinations: ArrayLike) -> Floats:
        """(n,) diameters in mm to draw, so that these come out; not above 0 where none do."""
        offset, share, _ = self.at(np.asarray(inclinations, float))
        return np.asarray((np.asarray(diameters, float) - offset) / (1.0 + share))

    def at(self, angle: Floats) -> tuple[Floats, Floats, Floats]:
        """(n,) what is added in mm, and as a share; and the scatter, mm; at (n,) degrees."""
        places = [place for row in self.rows for place in (row.low, row.high)]
        values = [(row.offset, row.share, row.scatter) for row in self.rows for _ in range(2)]
        # Where two rows meet the later one counts, but a row of one inclination before both.
        found = [np.interp(angle, places, column) for column in np.array(values, float).T]
        for row in self.rows:
            if row.low == row.high:
                on = np.abs(angle - row.low) < 1e-6
                for column, value in zip(found, (row.offset, row.share, row.scatter), strict=True):
                    column[on] = value
        return found[0], found[1], found[2]


_NPJ = "npj Adv. Manuf. s44334-025-00019-y, Table 2 (SEM, 10 struts each; sizes differ by class)"
_TABLES = (
    PrintedTable("LPBF-Ti64", "LPBF, Ti-6Al-4V", (
        PrintedRow(0.0, 0.0, 0.036, 0.0, f"1.250 -> 1.286 mm; {_NPJ}", 0.058),
        PrintedRow(1e-3, 29.0, 0.032, 0.0, f"1.208 -> 1.240 mm; {_NPJ}", 0.041),
        PrintedRow(31.0, 59.0, 0.080, 0.0, f"0.839 -> 0.919 mm; {_NPJ}", 0.037),
        PrintedRow(61.0, 89.999, 0.038, 0.0, f"0.324 -> 0.362 mm; {_NPJ}", 0.034),
        PrintedRow(90.0, 90.0, 0.036, 0.0, f"0.200 -> 0.236 mm; {_NPJ}", 0.048),
    )),
    PrintedTable("LPBF-316L", "LPBF, 316L", (
        PrintedRow(0.0, 90.0, 0.0227, 0.0,
                   "0.800 -> 0.8227 +- 0.084 mm; Bio-inspired dual-phase lattice cylindrical "
                   "tubes, Table 3", 0.084),
    )),
    PrintedTable("SLS-PA12", "SLS, PA2200", (
        PrintedRow(0.0, 90.0, 0.0, 0.075,
                   "+5 to +10 % of 1 to 2.5 mm (EOS P395, optical); Daynes, Feih, Lu and Wei, "
                   "Mater. Des. 2017"),
    )),
)  # fmt: skip
TABLES = {table.name.lower(): table for table in _TABLES}


def find_printed_table(text: str | os.PathLike[str]) -> PrintedTable:
    """The table of a name (case does not matter), or of a .csv file of one's own.

    A file has the columns inclination (degrees), nominal and measured (mm). Of one nominal
    diameter at an inclination the difference is taken, of several the straight line through them;
    the scatter is what measurements lie beside that.

    Raises:
        VolfrepError: there is no such table, or the file makes none.
    """
    check_path("table of printed diameters", text)
    word = os.fspath(text)
    if word.lower() in TABLES:
        return TABLES[word.lower()]
    if not word.lower().endswith(".csv"):
        names = ", ".join(table.name for table in _TABLES)
        raise VolfrepError(
            f"There is no table '{word}' of printed diameters: choose {names}, or name a .csv file "
            f"with the columns {', '.join(COLUMNS)}."
        )
    return _read_table(word)


def _read_table(path: str) -> PrintedTable:
    lines = [line.strip() for line in read_text(path, "table of printed diameters").splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    heads = [head.strip().lower() for head in lines[0].split(",")] if lines else []
    missing = [name for name in COLUMNS if name not in heads]
    if missing:
        raise VolfrepError(
            f"The table '{path}' has no column '{missing[0]}': its first line must name "
            f"{', '.join(COLUMNS)}."
        )
    found: dict[float, list[tuple[float, float]]] = {}
    for count, line in enumerate(lines[1:], 2):
        cells = line.split(",")
        values = []
        for name in COLUMNS:
            text = cells[heads.index(name)].strip() if heads.index(name) < len(cells) else ""
            if name == "measured" and not text:
                break  # not measured yet
            where = f"{name} in row {count} of '{path}'"
            unit, positive = ("degrees", None) if name == COLUMNS[0] else ("mm", True)
            values.append(number(where, text, unit, positive=positive))  # type: ignore[arg-type]
        if len(values) < len(COLUMNS):
            continue
        angle, nominal, measured = values
        if not 0.0 <= angle <= 90.0:
            raise VolfrepError(
                f"The inclination in row {count} of '{path}' must be from 0 to 90 degrees, not "
                f"{angle:g}."
            )
        found.setdefault(angle, []).append((nominal, measured))
    if not found:
        raise VolfrepError(f"The table '{path}' holds no measured diameter: fill its last column.")
    rows = tuple(_row(angle, found[angle]) for angle in sorted(found))
    return PrintedTable(path, f"measured, {path}", rows)


def _row(angle: float, pairs: list[tuple[float, float]]) -> PrintedRow:
    nominal, measured = np.array(pairs, float).T
    source = f"{len(pairs)} measured"
    if np.ptp(nominal) < 1e-6:
        added = measured - nominal
        scatter = float(added.std(ddof=1)) if len(pairs) > 1 else 0.0
        return PrintedRow(angle, angle, float(added.mean()), 0.0, source, scatter)
    slope, offset = np.polyfit(nominal, measured, 1)
    if slope <= 0.0:
        raise VolfrepError(
            f"At {angle:g} degrees thicker struts were measured to be thinner: look at the table."
        )
    beside = measured - slope * nominal - offset
    scatter = float(np.sqrt((beside**2).sum() / max(len(pairs) - 2, 1)))
    return PrintedRow(angle, angle, float(offset), float(slope - 1.0), source, scatter)
