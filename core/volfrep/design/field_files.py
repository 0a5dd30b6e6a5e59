# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points with a value each, read from tables (CSV) and from VTK files.

A table holds a point a line, separated by semicolons, tabs, commas or blanks (the first of these
that the first line holds). Blank lines and lines that begin with # are passed over. Without a
header the columns are x, y, z and the value; with one they are found by their names. Between
semicolons and tabs a decimal comma is understood; between commas and blanks it cannot be, and
such a line is refused. Lengths are mm, unless the header of x, y or z
says cm, m or in, as in ``X Location (m)``.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TextIO

import numpy as np

from ..util.errors import VolfrepError
from ..util.files import replacing
from ..util.reading import regular_file
from ..util.types import Floats
from .vtk_files import MAX_POINTS, TOO_MANY, load_vtk

PointsAndValues = tuple[Floats, Floats]

TABLE_SUFFIXES = (".csv", ".txt", ".tsv", ".dat", ".xyz")
VTK_SUFFIXES = (".vtk", ".vtu")
MAX_FILE_BYTES = 500_000_000
#: Lines parsed at once.
CHUNK = 50_000
#: Of the length units that a header may name, in mm.
UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}
#: How the programs that write such tables call the coordinates.
_COORDINATE = re.compile(
    r"(?:(?P<letter>[xyz])(?:[ _-]?(?:coord\w*|location|position))?|points[:_](?P<digit>[012]))"
    r"(?:\s*[\[(]\s*(?P<unit>[^\])]*?)\s*[\])])?"
)


def read_points(path: str | os.PathLike[str], column: str | None) -> PointsAndValues:
    """The points (n, 3) in mm and the values (n,) of a table or a VTK file.

    Args:
        path: a file with one of the extensions above.
        column: name of the value's column or array; None where there is only one.

    Raises:
        VolfrepError: naming the file, the line where there is one, and what is wrong.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix == ".vtp":
        raise VolfrepError(
            f"'{file.name}' holds polydata, which cannot be read: save it as .vtu or CSV, for "
            "instance with ParaView."
        )
    if suffix not in TABLE_SUFFIXES + VTK_SUFFIXES:
        raise VolfrepError(
            f"'{file.name}' is not a kind of file that holds a field: give a table "
            f"({', '.join(TABLE_SUFFIXES)}) or a VTK file ({', '.join(VTK_SUFFIXES)})."
        )
    try:
        regular_file(file, "field file", MAX_FILE_BYTES)
        if suffix in TABLE_SUFFIXES:
            # What is no UTF-8 can only stand in a header or a comment: it does no harm there.
            with file.open(encoding="utf-8-sig", errors="replace") as text:
                return _read_table(text, file.name, column)
        return _read_vtk(file, column)
    except OSError as error:
        raise VolfrepError(f"Cannot read '{file}': {error.strerror or error}.") from error


def write_points(
    path: str | os.PathLike[str], points: Floats, values: Floats, name: str, digits: int = 9
) -> None:
    """Write a table of points (n, 3) and values (n,), mm, that `read_points` reads.

    Args:
        path: of the file; an old file stays if anything goes wrong.
        points: where the values are.
        values: to a millionth.
        name: of the value's column.
        digits: of the coordinates.

    Raises:
        VolfrepError: the file cannot be written.
    """
    row = f"{3 * f'%.{digits}g,'}%.6f\n"
    table = np.column_stack([points, values]).tolist()
    with replacing(path) as file:
        file.write(f"x,y,z,{name}\n".encode())
        file.writelines((row % tuple(values)).encode() for values in table)


@dataclass(frozen=True)
class _Layout:
    """What the first line of a table says about the others."""

    separator: str | None
    columns: tuple[int, ...]
    scale: tuple[float, ...]
    count: int

    @property
    def decimal_comma(self) -> bool:
        return self.separator in (";", "\t")


def _read_table(text: TextIO, name: str, column: str | None) -> PointsAndValues:
    lines = _lines(text)
    first = list(islice(lines, 1))
    if not first:
        raise VolfrepError(f"'{name}' holds no points: give a line 'x, y, z, value' for each.")
    number, line = first[0]
    if "\0" in line:
        raise VolfrepError(f"'{name}' is not a text in UTF-8: save it as one.")
    separator = next((s for s in ";\t," if s in line), None)
    fields = _fields(line.partition("#")[0], separator)
    if any(map(_is_number, fields)) and not any(map(_coordinate, fields)):
        layout = _layout_without_header(fields, separator, name, column)
        waiting = first
    else:
        layout = _layout_of_header(_fields(line, separator), separator, name, column)
        waiting = []
    blocks: list[Floats] = []
    total = 0
    while chunk := waiting + list(islice(lines, CHUNK - len(waiting))):
        waiting = []
        block = _parse(chunk, layout, name)
        total += len(block)
        if total > MAX_POINTS:
            raise VolfrepError(TOO_MANY.format(name))
        blocks.append(block)
    if not blocks:
        raise VolfrepError(f"'{name}' holds no points below its header in line {number}.")
    table = np.concatenate(blocks)
    return table[:, :3], table[:, 3]


def _lines(text: TextIO) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(text, start=1):
        bare = line.strip()
        if bare and not bare.startswith("#"):
            yield number, line.rstrip("\r\n").replace('"', "")


def _fields(line: str, separator: str | None) -> list[str]:
    parts = line.split(separator) if separator else line.split()
    return [part.strip() for part in parts]


def _coordinate(title: str) -> re.Match[str] | None:
    return _COORDINATE.fullmatch(title.lower())


def _is_number(text: str) -> bool:
    try:
        float(text.replace(",", "."))
    except ValueError:
        return False
    return True


def _layout_without_header(
    fields: list[str], separator: str | None, name: str, column: str | None
) -> _Layout:
    if column is not None:
        raise VolfrepError(
            f"'{name}' has no header, so no column '{column}': name its columns in its first line."
        )
    if len(fields) != 4:
        raise VolfrepError(
            f"'{name}' has {len(fields)} columns and no header: give 'x, y, z, value', or name "
            "the columns in its first line."
        )
    return _Layout(separator, (0, 1, 2, 3), (1.0, 1.0, 1.0, 1.0), 4)


def _layout_of_header(
    names: list[str], separator: str | None, name: str, column: str | None
) -> _Layout:
    axes: dict[int, int] = {}
    scale = [1.0, 1.0, 1.0]
    for place, title in enumerate(names):
        match = _coordinate(title)
        if match is None:
            continue
        axis = "xyz".find(match["letter"]) if match["letter"] else int(match["digit"])
        if axis in axes:
            raise VolfrepError(
                f"'{name}' has two columns for {'xyz'[axis]}, '{names[axes[axis]]}' and "
                f"'{title}': keep one."
            )
        if (match["unit"] or "mm") not in UNITS:
            raise VolfrepError(
                f"In '{name}', the column '{title}' is not in {', '.join(UNITS)}: give mm."
            )
        axes[axis] = place
        scale[axis] = UNITS[match["unit"] or "mm"]
    if len(axes) < 3:
        raise VolfrepError(
            f"The header of '{name}' must name columns x, y and z, and it names {_listed(names)}."
        )
    others = [title for place, title in enumerate(names) if place not in axes.values()]
    value = names.index(_choose(others, column, f"'{name}'", "column"))
    return _Layout(separator, (axes[0], axes[1], axes[2], value), (*scale, 1.0), len(names))


def _choose(names: list[str], wanted: str | None, where: str, noun: str) -> str:
    """The one of `names` that is wanted, or the only one; case does not matter."""
    if wanted is None:
        if len(names) == 1:
            return names[0]
        if not names:
            raise VolfrepError(f"In {where} there is no {noun} that holds a value.")
        raise VolfrepError(f"In {where} there are several {noun}s: choose one of {_listed(names)}.")
    same = [n for n in names if n == wanted] or [
        n for n in names if n.casefold() == wanted.casefold()
    ]
    if len(same) != 1:
        raise VolfrepError(
            f"In {where} there is no {noun} '{wanted}': choose one of {_listed(names)}."
        )
    return same[0]


def _listed(names: list[str]) -> str:
    shown = ", ".join(f"'{n[:60]}'" for n in names[:20])
    return shown + (" and others" if len(names) > 20 else "")


def _parse(chunk: list[tuple[int, str]], layout: _Layout, name: str) -> Floats:
    """x, y, z and value (n, 4) of numbered lines."""
    texts = [text for _, text in chunk]
    if layout.decimal_comma:
        texts = [text.replace(",", ".") for text in texts]
    try:
        table = _load(texts, layout)
    except ValueError:
        for (number, line), text in zip(chunk, texts, strict=True):
            _check_line(number, line, text, layout, name)
        raise
    if table.shape[1] != layout.count:
        _check_line(*chunk[0], texts[0], layout, name)
    rows = table[:, layout.columns]
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise VolfrepError(
            f"In '{name}', line {chunk[bad[0]][0]} holds a number that is not finite: remove the "
            "line or mend it."
        )
    return np.asarray(rows * layout.scale)


def _load(texts: list[str], layout: _Layout) -> Floats:
    return np.loadtxt(texts, delimiter=layout.separator, comments="#", ndmin=2)


def _check_line(number: int, line: str, text: str, layout: _Layout, name: str) -> None:
    """Raise the sentence that belongs to a line which is no row of the table."""
    fields = _fields(line.partition("#")[0], layout.separator)
    if len(fields) != layout.count:
        raise VolfrepError(
            f"In '{name}', line {number} has {len(fields)} columns and not {layout.count}: write "
            "a decimal point, and the same columns in every line."
        )
    try:
        _load([text], layout)
    except ValueError as error:
        wrong = next((f for f in fields if not _is_number(f)), line)
        raise VolfrepError(
            f"In '{name}', line {number}: '{wrong[:40]}' is not a number."
        ) from error


def _read_vtk(file: Path, column: str | None) -> PointsAndValues:
    points, data, in_cells = load_vtk(file)
    scalars = [name for name, array in data.items() if array.size == len(points)]
    if (column in in_cells and column not in data) or (in_cells and not scalars):
        raise VolfrepError(
            f"'{file.name}' has '{column or in_cells[0]}' in its cells and not at its points: "
            "convert it, for instance with ParaView's filter 'Cell Data to Point Data'."
        )
    if column in data and column not in scalars:
        raise VolfrepError(
            f"In '{file.name}', '{column}' has several components a point: choose one of "
            f"{_listed(scalars)}."
        )
    chosen = _choose(scalars, column, f"'{file.name}'", "array")
    values = data[chosen].reshape(-1).astype(np.float64)
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1) | ~np.isfinite(values))
    if len(bad):
        raise VolfrepError(
            f"In '{file.name}', point {bad[0]} of '{chosen}' holds a number that is not finite."
        )
    return points, values
