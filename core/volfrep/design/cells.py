# SPDX-License-Identifier: LGPL-2.1-or-later
"""Unit cells: the nodes N and the struts M of section 2.2 of the VOLFREP paper.

A cell is added to the library in one place: `LIBRARY`. A user's own cell comes from a JSON file
through `load_cell`.
"""

from __future__ import annotations

import itertools
import json
import os
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..util.content import content_of, held
from ..util.errors import VolfrepError
from ..util.types import Floats

#: A custom cell's file may not be larger than this, nor have more nodes or struts.
MAX_FILE_BYTES = 1_000_000
MAX_NODES = 500
MAX_STRUTS = 2000
#: Nodes nearer than this, in units of L, are taken for the same node.
NODE_TOLERANCE = 1e-6


@dataclass(frozen=True)
class UnitCell:
    """A strut-and-node cell on the unit cube; equal to any other of the same name and content.

    Attributes:
        name: what a user picks it by.
        nodes: N, (n, 3) float64, in units of the cell size L, each coordinate in [0, 1].
        struts: M, (m, 2) int64, rows of `nodes`.
        source: the file that it was read from; empty for none.

    >>> cell = find_cell("BCC")
    >>> len(cell.nodes), len(cell.struts), cell.maxwell_number, cell.deformation_mode
    (9, 20, -1, 'bending')
    """

    name: str
    nodes: NDArray[np.float64] = field(compare=False)
    struts: NDArray[np.int64] = field(compare=False)
    source: str = field(default="", compare=False, repr=False)
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "nodes", held(self.nodes, np.float64))
        object.__setattr__(self, "struts", held(self.struts, np.int64))
        object.__setattr__(self, "_content", content_of(self.nodes, self.struts))

    @property
    def maxwell_number(self) -> int:
        """Maxwell number b - 3 j + 6 for b struts and j nodes (pin-jointed frames in 3D)."""
        return len(self.struts) - 3 * len(self.nodes) + 6

    @property
    def deformation_mode(self) -> str:
        """``stretch`` where Maxwell's number is not negative, else ``bending``."""
        return "stretch" if self.maxwell_number >= 0 else "bending"

    @property
    def is_mirror_symmetric(self) -> bool:
        """Whether the cell equals its mirror image about each of its three mid-planes."""
        own = _strut_keys(self.nodes, self.struts)
        for axis in range(3):
            mirrored = self.nodes.copy()
            mirrored[:, axis] = 1.0 - mirrored[:, axis]
            if _strut_keys(mirrored, self.struts) != own:
                return False
        return True


def _strut_keys(
    nodes: NDArray[np.float64], struts: NDArray[np.int64]
) -> set[frozenset[tuple[int, ...]]]:
    quantised = np.round(nodes / NODE_TOLERANCE).astype(np.int64)
    keys = [tuple(int(c) for c in row) for row in quantised]
    return {frozenset((keys[a], keys[b])) for a, b in struts}


def _from_rule(
    name: str,
    points: list[tuple[float, ...]],
    squared_lengths: set[float],
    from_first: int | None = None,
) -> UnitCell:
    """Join every pair of points whose squared distance, in L2, is in the set.

    With `from_first`, at least one end must be among that many first points.
    """
    nodes = np.array(points, float)
    pairs = [
        (a, b)
        for a, b in itertools.combinations(range(len(points)), 2)
        if (from_first is None or a < from_first)
        and any(abs(float(((nodes[a] - nodes[b]) ** 2).sum()) - s) < 1e-9 for s in squared_lengths)
    ]
    return UnitCell(name, nodes, np.array(pairs, np.int64))


_CORNERS: list[tuple[float, ...]] = [
    tuple(map(float, p)) for p in itertools.product((0, 1), repeat=3)
]
_FACES: list[tuple[float, ...]] = [
    tuple(side if axis == k else 0.5 for k in range(3)) for axis in range(3) for side in (0.0, 1.0)
]
_CENTRE: list[tuple[float, ...]] = [(0.5, 0.5, 0.5)]

#: The paper's six (section 2.2), by name. A new built-in cell is one more line here.
LIBRARY: dict[str, UnitCell] = {
    cell.name: cell
    for cell in (
        _from_rule("Box", _CORNERS, {1.0}),
        _from_rule("FCC", _CORNERS + _FACES, {1.0, 0.5}, from_first=8),
        _from_rule("BCC", _CORNERS + _CENTRE, {1.0, 0.75}),
        _from_rule("Octet", _CORNERS + _FACES, {0.5}),
        _from_rule("Octahedron", _FACES, {0.5}),
        _from_rule("CVC", _CORNERS + _CENTRE, {0.75}),
    )
}


def find_cell(name: str) -> UnitCell:
    """The library's cell of that name (case does not matter), or the cell of a JSON file.

    Raises:
        VolfrepError: no such cell, or the file is not a valid cell.

    >>> find_cell("octet").name
    'Octet'
    """
    for cell in LIBRARY.values():
        if cell.name.lower() == name.strip().lower():
            return cell
    if name.lower().endswith(".json"):
        return load_cell(name)
    raise VolfrepError(
        f"There is no unit cell named '{name}': choose one of {', '.join(LIBRARY)}, "
        "or give the path of a cell's .json file."
    )


def load_cell(path: str | os.PathLike[str]) -> UnitCell:
    """Read a custom cell: ``{"name": …, "nodes": [[x, y, z], …], "struts": [[i, j], …]}``.

    Nodes are in units of L within [0, 1], struts are pairs of node indices from 0.

    Raises:
        VolfrepError: naming the file and what is wrong in it.
    """
    file = Path(path)
    try:
        if file.exists() and not file.is_file():
            raise VolfrepError(f"Cannot read the cell file '{file}': it is not a file.")
        with file.open("rb") as opened:
            text = opened.read(MAX_FILE_BYTES + 1)
        if len(text) > MAX_FILE_BYTES:
            raise VolfrepError(
                f"The cell file '{file}' is larger than {MAX_FILE_BYTES // 1000} kB: "
                "a unit cell is a short list of nodes and struts."
            )
        data = json.loads(text.decode("utf-8"))
    except OSError as error:
        raise VolfrepError(f"Cannot read the cell file '{file}': {error.strerror}.") from error
    except (ValueError, RecursionError) as error:
        if isinstance(error, VolfrepError):
            raise
        raise VolfrepError(f"The cell file '{file}' is not valid JSON: {error}.") from error
    if not isinstance(data, dict) or not {"nodes", "struts"} <= data.keys():
        raise VolfrepError(f"The cell file '{file}' must be an object with 'nodes' and 'struts'.")
    name = data.get("name", file.stem)
    if not isinstance(name, str) or not name.strip():
        raise VolfrepError(f"In the cell file '{file}', 'name' must be a text.")
    cell = make_cell(name.strip(), data["nodes"], data["struts"], f"cell file '{file}'")
    return replace(cell, source=str(file))


def make_cell(name: str, nodes: object, struts: object, where: str = "unit cell") -> UnitCell:
    """A validated cell from lists or arrays; `where` names the source in error messages.

    Raises:
        VolfrepError: naming the first node or strut that is wrong.

    >>> cell = make_cell("Tent", [[0, 0, 0], [1, 0, 0], [0.5, 0.5, 1]], [[0, 1], [1, 2], [2, 0]])
    >>> cell.nodes.shape, cell.is_mirror_symmetric
    ((3, 3), False)
    """
    points = _rows(nodes, 3, MAX_NODES, "node", where)
    index = _rows(struts, 2, MAX_STRUTS, "strut", where)
    bad = np.flatnonzero(((points < 0.0) | (points > 1.0)).any(axis=1))
    if len(bad):
        raise VolfrepError(
            f"In the {where}, node {bad[0]} lies outside the cell: give coordinates in units "
            "of L, from 0 to 1."
        )
    with np.errstate(invalid="ignore"):  # a number too large for an index is none of the nodes
        pairs = index.astype(np.int64)
    bad = np.flatnonzero(
        (pairs != index).any(axis=1) | ((pairs < 0) | (pairs >= len(points))).any(1)
    )
    if len(bad):
        raise VolfrepError(
            f"In the {where}, strut {bad[0]} must name two nodes by whole numbers "
            f"from 0 to {len(points) - 1}."
        )
    grid = np.round(points / NODE_TOLERANCE).astype(np.int64)
    _, first, inverse = np.unique(grid, axis=0, return_index=True, return_inverse=True)
    inverse = inverse.ravel()
    if len(first) < len(points):
        second = int(np.flatnonzero(first[inverse] != np.arange(len(points)))[0])
        raise VolfrepError(f"In the {where}, node {second} repeats node {first[inverse[second]]}.")
    seen: set[frozenset[int]] = set()
    for k, (a, b) in enumerate(pairs.tolist()):
        if a == b:
            raise VolfrepError(f"In the {where}, strut {k} joins node {a} to itself.")
        if frozenset((a, b)) in seen:
            raise VolfrepError(f"In the {where}, strut {k} repeats an earlier strut.")
        seen.add(frozenset((a, b)))
    loose = np.setdiff1d(np.arange(len(points)), pairs)
    if len(loose):
        raise VolfrepError(f"In the {where}, node {loose[0]} has no strut: remove it or join it.")
    return UnitCell(name, points, pairs)


def _rows(value: object, width: int, most: int, noun: str, where: str) -> NDArray[np.float64]:
    try:
        rows = np.array(value, float)
    except (TypeError, ValueError, OverflowError) as error:
        raise VolfrepError(
            f"In the {where}, every {noun} must be a list of {width} numbers."
        ) from error
    if rows.ndim != 2 or rows.shape[1] != width or not len(rows):
        raise VolfrepError(f"In the {where}, every {noun} must be a list of {width} numbers.")
    if len(rows) > most:
        raise VolfrepError(f"The {where} has {len(rows)} {noun}s: the limit is {most}.")
    if not np.isfinite(rows).all():
        raise VolfrepError(f"In the {where}, a {noun} holds a number that is not finite.")
    return rows


Number = TypeVar("Number", float, Floats)


def joint_radius(strut_radius: Number, cell_size: float) -> Number:
    """Radius of a joint sphere, r (1 + r / L), mm (Eq. 8).

    >>> joint_radius(1.0, 10.0)
    1.1
    """
    return strut_radius * (1.0 + strut_radius / cell_size)
