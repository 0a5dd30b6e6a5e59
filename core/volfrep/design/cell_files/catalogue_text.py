# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells of a catalogue's text: the format of Lumpe and Stankovic, and of what descends from it.

T. S. Lumpe and T. Stankovic, PNAS 118, 2021, published 17,000 trusses in one text: of each its
name, the edges and angles of its cell, its nodes in units of these edges, and its bars as pairs of
nodes from 1. Nothing of it comes with this package.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

from ...util.errors import VolfrepError
from ...util.reading import regular_file

MAX_FILE_BYTES = 500_000_000

#: Words that begin what is read of an entry. Any other line of words ends a list.
_NAME, _EDGES, _NODES, _BARS = "name:", "normalized unit cell parameters", "nodal positions", "bar "
#: Angles of a box, degrees, to so much.
_RIGHT = 1e-3

Entry = tuple[str, tuple[float, float, float], list[list[float]], list[list[int]]]


def catalogue_names(path: str | os.PathLike[str]) -> list[str]:
    """The names of a catalogue's cells, in its order.

    Raises:
        VolfrepError: it cannot be read, or holds none.
    """
    names = [lines[0] for lines in _entries(path)]
    if not names:
        raise VolfrepError(
            f"The catalogue '{path}' holds no cells: each must begin with a line 'Name: ...'."
        )
    return names


def catalogue_entry(path: str | os.PathLike[str], name: str) -> Entry:
    """A cell of a catalogue.

    Returns:
        its name, the edges of its box in units of the longest, nodes in units of these edges and
        struts from 0.

    Raises:
        VolfrepError: there is no such cell, it is no box, or what is wrong with it.
    """
    wanted = name.strip().lower()
    for lines in _entries(path):
        if lines[0].lower() == wanted:
            return _entry(lines, f"cell '{lines[0]}' of the catalogue '{path}'")
    raise VolfrepError(
        f"The catalogue '{path}' holds no cell '{name}': 'volfrep cells {path}' lists them."
    )


def _entries(path: str | os.PathLike[str]) -> Iterator[list[str]]:
    """Of each cell its name, and its lines after that; one at a time, for there may be many."""
    path = regular_file(path, "catalogue", MAX_FILE_BYTES)
    try:
        with path.open(encoding="utf-8-sig") as file:
            lines: list[str] = []
            for line in file:
                text = line.strip()
                if text.lower().startswith(_NAME):
                    if lines:
                        yield lines
                    lines = [text[len(_NAME) :].strip()]
                elif lines:
                    lines.append(text)
            if lines:
                yield lines
    except OSError as error:
        raise VolfrepError(f"Cannot read the catalogue '{path}': {error.strerror}.") from error
    except UnicodeDecodeError as error:
        raise VolfrepError(f"The catalogue '{path}' is no text: {error.reason}.") from error


def _entry(lines: list[str], where: str) -> Entry:
    edges: tuple[float, ...] = (1.0, 1.0, 1.0, 90.0, 90.0, 90.0)
    lists: dict[str, list[list[float]]] = {_NODES: [], _BARS: []}
    current = ""
    for text in lines[1:]:
        low = text.lower()
        if any(letter.isalpha() for letter in low.replace("e", "")) or low.startswith("--"):
            current = next((key for key in (_EDGES, _NODES, _BARS) if low.startswith(key)), "")
            continue
        if not text or not current:
            continue
        try:
            row = [float(word) for word in text.replace(",", " ").split()]
        except ValueError as error:
            raise VolfrepError(f"In the {where}, '{text}' are no numbers.") from error
        if current == _EDGES:
            edges, current = tuple(row), ""
        else:
            lists[current].append(row)
    if len(edges) != 6 or min(edges) <= 0.0:
        raise VolfrepError(f"In the {where}, there must be three edges and three angles.")
    if any(abs(angle - 90.0) > _RIGHT for angle in edges[3:]):
        raise VolfrepError(
            f"The {where} is no box (its angles are {edges[3]:g}, {edges[4]:g} and {edges[5]:g} "
            "degrees): choose one with right angles."
        )
    bars = lists[_BARS]
    if not lists[_NODES] or not bars or any(len(bar) != 2 for bar in bars):
        raise VolfrepError(f"In the {where}, there must be nodal positions and bars of two nodes.")
    # Every node has a bar: where none is called 0, they are counted from 1.
    first = min(min(bar) for bar in bars)
    struts = [[int(end - min(first, 1.0)) for end in bar] for bar in bars]
    x, y, z = (edge / max(edges[:3]) for edge in edges[:3])
    return lines[0], (x, y, z), lists[_NODES], struts
