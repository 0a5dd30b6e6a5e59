# SPDX-License-Identifier: LGPL-2.1-or-later
"""A unit cell from lines that somebody has drawn, and its file.

The cube about the drawing is the cell. Lines that cross, or that touch along their way, get a node
there, as struts would be joined there anyway.
"""

from __future__ import annotations

import itertools
import json
import os
from dataclasses import dataclass

import numpy as np

from ..util.errors import VolfrepError, brief
from ..util.files import replacing
from ..util.linalg import along
from ..util.types import Floats
from .cells import MAX_STRUTS, NODE_TOLERANCE, UnitCell, make_cell

#: Coordinates that differ by less than this share of the cube's edge are the same.
SAME = 1e-5
_AXES = "xyz"


@dataclass(frozen=True, eq=False)
class DrawnCell:
    """A cell, where it was drawn, and what to know about it.

    Attributes:
        cell: in units of `size`.
        size: edge of the cube about the drawing, mm.
        origin: (3,) its lowest corner, mm.
        warnings: a sentence for each way in which cells of it will not join.
    """

    cell: UnitCell
    size: float
    origin: Floats
    warnings: tuple[str, ...]


def _as_lines(lines: object) -> Floats:
    """(n, 2, 3) of what a script gives.

    Raises:
        VolfrepError: it is none.
    """
    try:
        found = np.asarray(lines, np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise VolfrepError(f"Lines are (n, 2, 3) numbers in mm, not {brief(lines)}.") from error
    if (found.ndim != 3 or found.shape[1:] != (2, 3)) and found.size:
        raise VolfrepError(f"Lines are (n, 2, 3) numbers in mm, not an array of {found.shape}.")
    return found


def cell_from_lines(name: str, lines: Floats) -> DrawnCell:
    """The unit cell whose struts are straight lines.

    The cube is as large as the drawing's longest extent; along the others the drawing is in the
    middle of it. What is drawn twice is one strut.

    Args:
        name: of the cell.
        lines: (n, 2, 3) starts and ends, mm.

    Raises:
        VolfrepError: there are no lines, too many, one without length, or they make no cell.

    >>> lines = np.array([[[0, 0, 0], [8, 8, 8]], [[0, 8, 0], [8, 0, 8]]], float)
    >>> drawn = cell_from_lines("Cross", lines)
    >>> drawn.size, len(drawn.cell.nodes), len(drawn.cell.struts)  # a node where they cross
    (8.0, 5, 4)
    """
    lines = _as_lines(lines)
    if not len(lines):
        raise VolfrepError("There is no line to make a cell of: draw its struts as straight lines.")
    if len(lines) > MAX_STRUTS:
        raise VolfrepError(
            f"{len(lines):,} lines are too many for a cell: the limit is {MAX_STRUTS:,} struts."
        )
    low, high = lines.min(axis=(0, 1)), lines.max(axis=(0, 1))
    size = float((high - low).max())
    origin = (low + high - size) / 2.0
    length = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
    if size == 0.0 or length.min() <= SAME * size:
        x, y, z = lines[int(length.argmin()), 0]
        raise VolfrepError(
            f"The line at ({x:g}, {y:g}, {z:g}) mm has no length and cannot be a strut: remove it."
        )
    ends = (lines - origin) / size
    points = _snap(np.concatenate([ends.reshape(-1, 3), _crossings(ends)]))
    nodes, index = np.unique(points, axis=0, return_inverse=True)
    own = index.reshape(-1)[: 2 * len(lines)].reshape(-1, 2)
    struts = {
        (min(pair), max(pair))
        for a, b in own.tolist()
        for pair in itertools.pairwise(_along(nodes, a, b))
    }
    cell = make_cell(name, nodes, sorted(struts), f"cell '{name}'")
    return DrawnCell(cell, size, origin, tuple(_loose_faces(nodes, (high - low) / size)))


def save_cell(cell: UnitCell, path: str | os.PathLike[str]) -> None:
    """Write a cell as a JSON file that `load_cell` reads.

    Raises:
        VolfrepError: the file cannot be written; an older one stays.
    """
    rows = {
        "nodes": [[round(value, 9) for value in node] for node in cell.nodes.tolist()],
        "struts": cell.struts.tolist(),
    }
    lines = [f'  "name": {json.dumps(cell.name)}']
    if cell.edges != (1.0, 1.0, 1.0):
        lines.append(f'  "edges": {json.dumps(list(cell.edges))}')
    if len(cell.widths):
        lines.append(f'  "widths": {json.dumps(cell.widths.tolist())}')
    for key, values in rows.items():
        lines.append(f'  "{key}": [\n    ' + ",\n    ".join(map(json.dumps, values)) + "\n  ]")
    with replacing(path) as file:
        file.write(("{\n" + ",\n".join(lines) + "\n}\n").encode())


def _snap(points: Floats) -> Floats:
    """Coordinates that are the same but for rounding made equal, the cube's faces exact."""
    settled = np.empty_like(points)
    for axis in range(3):
        values = np.concatenate([[0.0, 1.0], points[:, axis]])
        order = np.argsort(values, kind="stable")
        group = np.concatenate([[0], np.cumsum(np.diff(values[order]) > SAME)])
        first = np.searchsorted(group, np.arange(group[-1] + 1))
        known = values[order][first]
        known[group[order == 0]], known[group[order == 1]] = 0.0, 1.0
        placed = np.empty(len(values))
        placed[order] = known[group]
        settled[:, axis] = placed[2:]
    return settled


def _crossings(ends: Floats) -> Floats:
    """(k, 3) where two lines cross between their ends, or touch."""
    start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    found = [np.zeros((0, 3))]
    for k in range(len(ends) - 1):
        s, w = start[k + 1 :], way[k + 1 :]
        apart = s - start[k]
        # Nearest places of two lines, as shares of their lengths.
        a, b, c = along(way[k], way[k]), along(w, way[k]), (w * w).sum(axis=1)
        d, e = along(apart, way[k]), (apart * w).sum(axis=1)
        determinant = a * c - b * b
        skew = determinant > SAME * SAME * a * c
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (d * c - b * e) / determinant
            u = (d * b - a * e) / determinant
        inside = skew & (t > 0.0) & (t < 1.0) & (u > 0.0) & (u < 1.0)
        one, two = start[k] + t[inside, None] * way[k], s[inside] + u[inside, None] * w[inside]
        found.append(one[np.linalg.norm(one - two, axis=1) < SAME])
    return np.concatenate(found)


def _along(nodes: Floats, first: int, last: int) -> list[int]:
    """The nodes on a line in their order, from its first to its last."""
    way = nodes[last] - nodes[first]
    share = along(nodes - nodes[first], way) / along(way, way)
    off = np.linalg.norm(nodes - nodes[first] - share[:, None] * way, axis=1)
    inside = (off < 2.0 * SAME) & (share > 0.0) & (share < 1.0)
    inside[[first, last]] = False  # the share of the last is 1 but for rounding
    on = np.flatnonzero(inside)
    between: list[int] = on[np.argsort(share[on])].tolist()
    return [first, *between, last]


def _loose_faces(nodes: Floats, extent: Floats) -> list[str]:
    """Sentences about where cells do not meet."""
    said = []
    keys = {tuple(row) for row in np.round(nodes / NODE_TOLERANCE).astype(np.int64).tolist()}
    for axis in range(3):
        if extent[axis] < 1.0 - SAME:
            said.append(
                f"Cells do not meet along {_AXES[axis]}: the drawing reaches over "
                f"{extent[axis]:.3g} L there and is in the middle of the cell."
            )
            continue
        for side in (0.0, 1.0):
            alone = []
            for node in nodes[nodes[:, axis] == side]:
                opposite = node.copy()
                opposite[axis] = 1.0 - side
                if tuple(np.round(opposite / NODE_TOLERANCE).astype(np.int64).tolist()) not in keys:
                    alone.append(node)
            if alone:
                place = ", ".join(f"{value:.4g}" for value in alone[0])
                said.append(
                    f"{len(alone)} of the nodes on the face {_AXES[axis]} = {side:g} "
                    f"{'has' if len(alone) == 1 else 'have'} no counterpart on the opposite face, "
                    f"first the one at ({place}) L: cells are not joined there."
                )
    return said
