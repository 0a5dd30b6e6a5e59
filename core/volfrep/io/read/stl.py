# SPDX-License-Identifier: LGPL-2.1-or-later
"""STL, binary and ASCII: any header, colours passed over, all solids of the file together."""

from __future__ import annotations

import re
import struct

import numpy as np

from ...util.errors import VolfrepError
from ...util.numbers import plural
from ...util.types import Floats
from .contents import Contents, as_numbers, as_words, damaged, triangle_soup
from .units import unit_hint

HEADER_BYTES = 84
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
#: ASCII files are taken apart in pieces of this size, which bounds the memory for words.
CHUNK_BYTES = 8_000_000
_SOLID_LINE = re.compile(rb"^[ \t]*(?:end)?solid\b[^\n]*", re.MULTILINE)
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
#: A facet of an ASCII file, word by word; None stands for a number.
_GRAMMAR: tuple[bytes | None, ...] = (
    b"facet", b"normal", None, None, None, b"outer", b"loop",
    b"vertex", None, None, None, b"vertex", None, None, None, b"vertex", None, None, None,
    b"endloop", b"endfacet",
)  # fmt: skip
_KEYWORDS = {place: word for place, word in enumerate(_GRAMMAR) if word is not None}
_COORDINATES = [8, 9, 10, 12, 13, 14, 16, 17, 18]


def read_stl(data: bytes, name: str) -> Contents:
    """The triangles of an STL file.

    Args:
        data: the whole file.
        name: of the file, for messages.

    Raises:
        VolfrepError: the file is cut short, damaged, or no STL.
    """
    # Many binary files begin with "solid" too: the length decides.
    count, there = 0, (len(data) - HEADER_BYTES) // FACET.itemsize
    if len(data) >= HEADER_BYTES:
        count = struct.unpack_from("<I", data, HEADER_BYTES - 4)[0]
        exact = len(data) == HEADER_BYTES + FACET.itemsize * count
        # What follows the last triangle is no reason to refuse, if this is no text.
        if exact or (there >= count > 0 and b"\0" in data[:512]):
            return _read_binary(data, count, name)
    text = data.removeprefix(_BYTE_ORDER_MARK)
    if text.lstrip()[:5].lower() == b"solid" and b"\0" not in data[:512]:
        return _read_ascii(text, name)
    if len(data) < HEADER_BYTES:
        raise VolfrepError(
            f"'{name}' is not an STL file: it ends inside its header; export it again."
        )
    if count == 0 and there > 0:
        raise damaged(name, f"its header promises no triangles and there is room for {there}")
    raise VolfrepError(
        f"'{name}' is cut short or damaged: its header promises {count} triangles and there are "
        f"{there}; export or download it again."
    )


def _read_binary(data: bytes, count: int, name: str) -> Contents:
    rows = np.frombuffer(data, FACET, count, HEADER_BYTES)
    with np.errstate(invalid="ignore"):  # numbers that are none are refused later
        corners = rows["corners"].astype(np.float64).reshape(-1, 3)
    mesh = triangle_soup(corners)
    spare = len(data) - HEADER_BYTES - rows.nbytes
    surplus = plural(spare, "byte")
    warnings = (f"{surplus} after the last triangle of '{name}' passed over.",)
    return Contents(mesh, unit_hint(data[: HEADER_BYTES - 4]), warnings if spare else ())


def _read_ascii(data: bytes, name: str) -> Contents:
    if b"endsolid" not in data[-4096:].lower():
        raise VolfrepError(
            f"'{name}' is cut short: it has no 'endsolid' at its end; export or download it again."
        )
    blocks: list[Floats] = []
    start, facets = 0, 0
    while start < len(data):
        end = _end_of_facet(data, start + CHUNK_BYTES)
        block = _read_facets(data[start:end], facets, name)
        facets += len(block)
        blocks.append(block)
        start = end
    corners = np.concatenate(blocks).reshape(-1, 3)
    return Contents(triangle_soup(corners), unit_hint(data.split(b"\n", 1)[0][:200]))


def _end_of_facet(data: bytes, start: int) -> int:
    """Where the facet that reaches over a place ends, or the file does."""
    if start >= len(data):
        return len(data)
    match = re.compile(rb"endfacet", re.IGNORECASE).search(data, start)
    return len(data) if match is None else match.end()


def _read_facets(text: bytes, before: int, name: str) -> Floats:
    """(n, 9) coordinates of a piece of the file that `before` facets precede."""
    bare = _SOLID_LINE.sub(b"", text.lower().replace(b"\r", b"\n"))
    words = as_words(bare.split(), name)
    rows = len(words) // len(_GRAMMAR)
    table = words[: rows * len(_GRAMMAR)].reshape(rows, len(_GRAMMAR))
    wrong = np.stack([table[:, place] != word for place, word in _KEYWORDS.items()], axis=1)
    if wrong.any():
        row, keyword = (int(k) for k in np.argwhere(wrong)[0])
        place, expected = list(_KEYWORDS.items())[keyword]
        found = table[row, place].decode("ascii", "replace")
        raise damaged(
            name, f"facet {before + row + 1} has '{found}' where '{expected.decode()}' belongs"
        )
    if len(words) != table.size:
        raise damaged(name, f"facet {before + rows + 1} is not complete")
    return as_numbers(table[:, _COORDINATES], name)
