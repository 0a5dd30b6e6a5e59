# SPDX-License-Identifier: LGPL-2.1-or-later
"""PLY: ASCII and binary of either byte order, polygons cut into triangles."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.types import Ints
from ..repair.polygons import cut_polygons
from .contents import Contents, as_numbers, as_words, damaged
from .units import unit_hint

_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8", "int64": "i8", "uint64": "u8",
}  # fmt: skip
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_END = re.compile(rb"(?:^|\n)end_header[ \t]*\r?\n")
MAX_HEADER_BYTES = 100_000
#: Rows looked at in one go: first few, then ever more, since rows of one shape come in runs.
FIRST_ROWS, MOST_ROWS = 64, 1 << 20
#: Lists of ever-changing length would be read row by row.
MOST_RUNS = 100_000


@dataclass(frozen=True)
class _Property:
    name: str
    kind: str
    counted_by: str | None = None


@dataclass
class _Element:
    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)


def read_ply(data: bytes, name: str) -> Contents:
    """The polygons of a PLY file, cut into triangles.

    Args:
        data: the whole file.
        name: of the file, for messages.

    Raises:
        VolfrepError: the file is cut short, damaged, or holds no faces.
    """
    end = _END.search(data, 0, MAX_HEADER_BYTES)
    if not data.startswith(b"ply") or end is None:
        raise VolfrepError(f"'{name}' is not a PLY file: its header is missing; export it again.")
    header = data[: end.start()]
    order, elements = _header(header.decode("ascii", "replace"), name)
    body = memoryview(data)[end.end() :]
    if order == "":
        body = memoryview(as_numbers(as_words(bytes(body).split(), name), name).tobytes())
    vertices, corners, counts = None, None, None
    offset = 0
    for element in elements:
        columns, offset = _rows(body, offset, element, order, name)
        if element.name == "vertex":
            vertices = _coordinates(columns, name)
        elif element.name == "face":
            corners, counts = _polygons(columns, name)
    if vertices is None or corners is None or counts is None:
        raise VolfrepError(f"'{name}' holds no faces: export the solid as a mesh.")
    if (counts < 3).any():
        raise damaged(name, "a face has fewer than three corners")
    if len(corners) and (corners.min() < 0 or corners.max() >= len(vertices)):
        raise damaged(name, f"a face names a vertex that is not among the {len(vertices)}")
    triangles = cut_polygons(vertices, corners, counts, name)
    return Contents(TriangleMesh(vertices, triangles.astype(np.int32)), unit_hint(header))


def _header(text: str, name: str) -> tuple[str, list[_Element]]:
    order: str | None = None
    elements: list[_Element] = []
    for line in text.splitlines()[1:]:
        words = line.split()
        try:
            if not words or words[0] in ("comment", "obj_info"):
                continue
            if words[0] == "format":
                order = _ORDERS[words[1]]
            elif words[0] == "element":
                elements.append(_Element(words[1], int(words[2])))
            elif words[0] == "property" and words[1] == "list":
                kind, counted_by = _TYPES[words[3]], _TYPES[words[2]]
                elements[-1].properties.append(_Property(words[4], kind, counted_by))
            elif words[0] == "property":
                elements[-1].properties.append(_Property(words[2], _TYPES[words[1]]))
            else:
                raise KeyError(words[0])
        except (LookupError, ValueError) as error:
            shown = line.strip()[:60]
            raise damaged(name, f"its header has the line '{shown}'") from error
    if order is None:
        raise damaged(name, "its header names no format")
    for element in elements:
        names = [prop.name for prop in element.properties]
        if len(set(names)) < len(names):
            raise damaged(name, f"a property of '{element.name}' is named twice")
    return order, elements


Columns = dict[str, tuple[NDArray[np.generic], Ints | None]]


def _rows(
    body: memoryview, offset: int, element: _Element, order: str, name: str
) -> tuple[Columns, int]:
    """Each property's values, with the lengths of lists, and where the next element begins."""
    values: dict[str, list[NDArray[np.generic]]] = {p.name: [] for p in element.properties}
    lengths: dict[str, list[Ints]] = {p.name: [] for p in element.properties if p.counted_by}
    left, look, runs = element.count, FIRST_ROWS, 0
    if not element.properties:
        left = 0
    while left > 0:
        runs += 1
        if runs > MOST_RUNS:
            raise VolfrepError(
                f"'{name}' mixes polygons of different sizes too often: export triangles."
            )
        row = _row_type(body, offset, element, order, name)
        rows = min(left, look, (len(body) - offset) // row.itemsize)
        if rows < 1:
            raise VolfrepError(
                f"'{name}' is cut short: it ends {left} rows before the end of its element "
                f"'{element.name}'; export or download it again."
            )
        table = np.frombuffer(body, row, rows, offset)
        alike = np.ones(rows, bool)
        for number, prop in enumerate(element.properties):
            if prop.counted_by:
                alike &= table[f"n{number}"] == table[f"n{number}"][0]
        same = rows if alike.all() else int(alike.argmin())
        for number, prop in enumerate(element.properties):
            part = table[f"v{number}"][:same]
            values[prop.name].append(part.reshape(-1))
            if prop.counted_by:
                width = part.shape[1]
                lengths[prop.name].append(np.full(same, width, np.int64))
        left -= same
        offset += same * row.itemsize
        look = min(2 * look, MOST_ROWS) if same == rows else FIRST_ROWS
    columns: Columns = {}
    for key, parts in values.items():
        column = np.concatenate(parts) if parts else np.zeros(0)
        counts = lengths.get(key)
        columns[key] = (column, None if counts is None else np.concatenate([*counts, _NONE]))
    return columns, offset


_NONE = np.zeros(0, np.int64)


def _row_type(
    body: memoryview, offset: int, element: _Element, order: str, name: str
) -> np.dtype[np.void]:
    """The layout of the row at a place: its lists are as long as they say there."""
    fields: list[tuple[str, str] | tuple[str, str, tuple[int, ...]]] = []
    place = offset
    for number, prop in enumerate(element.properties):
        kind = f"{order}{prop.kind}" if order else "<f8"
        size = np.dtype(kind).itemsize
        if prop.counted_by is None:
            fields.append((f"v{number}", kind))
            place += size
            continue
        counter = np.dtype(f"{order}{prop.counted_by}" if order else "<f8")
        if place + counter.itemsize > len(body):
            raise VolfrepError(
                f"'{name}' is cut short: it ends inside its element '{element.name}'; export or "
                "download it again."
            )
        count = np.frombuffer(body, counter, 1, place)[0]
        if not 0 <= count <= (len(body) - place) // size:
            raise damaged(name, f"a list in '{element.name}' promises {count:.0f} values")
        fields.append((f"n{number}", counter.str))
        fields.append((f"v{number}", kind, (int(count),)))
        place += counter.itemsize + int(count) * size
    return np.dtype(fields)


def _coordinates(columns: Columns, name: str) -> NDArray[np.float64]:
    if not {"x", "y", "z"} <= columns.keys():
        raise damaged(name, "its vertices have no x, y and z")
    with np.errstate(invalid="ignore"):  # numbers that are none are refused later
        return np.stack([columns[axis][0].astype(np.float64) for axis in "xyz"], axis=1)


def _polygons(columns: Columns, name: str) -> tuple[Ints, Ints]:
    for key in ("vertex_indices", "vertex_index"):
        if key in columns:
            values, counts = columns[key]
            indices = values.astype(np.int64)
            if counts is not None and (indices == values).all():
                return indices, counts
    raise damaged(name, "its faces have no list 'vertex_indices' of whole numbers")
