# SPDX-License-Identifier: LGPL-2.1-or-later
"""Unit cells: the nodes N and the struts M of section 2.2 of the VOLFREP paper.

The library is a folder of files, `cell_library`, in the format of a user's own: a new cell is one
more file. All are read by `load_cell`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..util.content import content_of, freeze
from ..util.errors import VolfrepError
from ..util.numbers import number_rows, strut_rows
from ..util.reading import read_json
from ..util.types import Floats
from .cell_files.parameters import CellParameter, chosen_values, read_parameters
from .expression import CONSTANTS, FUNCTIONS, evaluate_numbers
from .tpms.library import SURFACES, PeriodicSurface, find_surface, surface_name

#: A custom cell's file may not be larger than this, nor have more nodes or struts.
MAX_FILE_BYTES = 1_000_000
MAX_NODES = 500
MAX_STRUTS = 2000
#: And of the points whose bodies it is a tessellation of.
MOST_POINTS = 64
#: Nodes nearer than this, in units of L, are taken for the same node.
NODE_TOLERANCE = 1e-6


@dataclass(frozen=True)
class UnitCell:
    """A strut-and-node cell on the unit cube; equal to any other of the same name and content.

    `make_cell` tells what is wrong with numbers that somebody wrote.

    Attributes:
        name: what a user picks it by.
        nodes: N, (n, 3) float64, in units of the cell size L, each coordinate in [0, 1].
        struts: M, (m, 2) int64, rows of `nodes`.
        edges: of its box along x, y, z, in units of L; nodes are in units of these. (1, 1, 1) for
            a cube.
        widths: (m,) float64, what the lattice's radius is multiplied by at each strut; none, (0,),
            for 1.
        source: the file that it was read from; empty for none.
        use: what it is for, a key of `USES`; empty where nobody said.
        about: what it is, in a few words.
        also: names that others know it by.
        parameters: that its file leaves to be chosen.
        values: the chosen ones that differ from the usual, as ``t = 0.3, angle = 60``.

    Raises:
        VolfrepError: a node has no strut: its joint would be a ball that hangs on nothing.

    >>> cell = find_cell("BCC")
    >>> len(cell.nodes), len(cell.struts), cell.maxwell_number
    (9, 20, -1)
    """

    #: The parameter that says how thick a lattice of it is.
    measure: ClassVar[str] = "strut_radius"

    name: str
    nodes: NDArray[np.float64] = field(compare=False)
    struts: NDArray[np.int64] = field(compare=False)
    edges: tuple[float, float, float] = (1.0, 1.0, 1.0)
    widths: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0), compare=False)
    source: str = field(default="", compare=False, repr=False)
    use: str = field(default="", compare=False, repr=False)
    about: str = field(default="", compare=False, repr=False)
    also: tuple[str, ...] = field(default=(), compare=False, repr=False)
    parameters: tuple[CellParameter, ...] = field(default=(), compare=False, repr=False)
    values: str = field(default="", compare=False, repr=False)
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "nodes", freeze(self.nodes, np.float64))
        object.__setattr__(self, "struts", freeze(self.struts, np.int64))
        object.__setattr__(self, "widths", freeze(self.widths, np.float64))
        object.__setattr__(self, "_content", content_of(self.nodes, self.struts, self.widths))
        _refuse_loose(self.nodes, self.struts, f"unit cell '{self.name}'")

    def as_values(self) -> dict[str, Any]:
        """The parameters that name it.

        Raises:
            VolfrepError: it is not the library's, and has no file.
        """
        own = self.name not in LIBRARY or find_cell(self.name, self.values) != self
        if own and not (self.source and Path(self.source).is_file()):
            raise VolfrepError(
                f"The cell '{self.name}' has no file that could be named: save it as .json first."
            )
        return {"cell": self.source if own else self.name, "cell_values": self.values}

    @property
    def is_uniform_cube(self) -> bool:
        """Whether it is a cube with struts of one radius, of which octants are made."""
        return self.edges == (1.0, 1.0, 1.0) and not len(self.widths)

    @property
    def maxwell_number(self) -> int:
        """Maxwell number b - 3 j + 6 for b struts and j nodes (pin-jointed frames in 3D)."""
        return len(self.struts) - 3 * len(self.nodes) + 6

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


def find_same(nodes: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """(k,) rows of (n, 3) nodes that differ, in units of L, and (n,) which of them each is."""
    steps = np.round(nodes / NODE_TOLERANCE).astype(np.int64)
    _, first, inverse = np.unique(steps, axis=0, return_index=True, return_inverse=True)
    return first, inverse.ravel()


def _strut_keys(
    nodes: NDArray[np.float64], struts: NDArray[np.int64]
) -> set[frozenset[tuple[int, ...]]]:
    quantised = np.round(nodes / NODE_TOLERANCE).astype(np.int64)
    keys = [tuple(int(c) for c in row) for row in quantised]
    return {frozenset((keys[a], keys[b])) for a, b in struts}


#: The paper's six (section 2.2).
PAPERS = ("Box", "FCC", "BCC", "Octet", "Octahedron", "CVC")
#: What cells are for, in the order of the library, and how that is said.
USES = {
    "stiff": "stiff in every direction",
    "axial": "stiff along its columns",
    "soft": "soft: energy, vibration",
    "open": "open: flow, bone, foams",
    "auxetic": "auxetic: wider when pulled",
}
_FOLDER = Path(__file__).with_name("cell_library")


class _Library(Mapping[str, UnitCell]):
    """The library's cells by name, sorted by what they are for.

    A cell is made when it is first asked for: all of them take longer than most of an import.
    """

    def __init__(self) -> None:
        self._made: dict[str, UnitCell] = {}

    @cached_property
    def _names(self) -> dict[str, tuple[Path, set[str]]]:
        """Of each cell its file, and all its names in lower case."""
        names_of = {}
        for path in sorted(_FOLDER.glob("*.json")):
            data = read_json(path, "cell file", MAX_FILE_BYTES)
            names = [data["name"], *data.get("also", [])]
            names_of[names[0]] = path, {name.lower() for name in names}
        return names_of

    @cached_property
    def _order(self) -> list[str]:
        uses = list(USES)

        def place(name: str) -> tuple[int, int, str]:
            return uses.index(self[name].use), len(self[name].struts), name

        return sorted(self._names, key=place)

    def __getitem__(self, name: str) -> UnitCell:
        if name not in self._made:
            self._made[name] = replace(load_cell(self.file(name)), source="")
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._order)

    def __len__(self) -> int:
        return len(self._names)

    def file(self, name: str) -> Path:
        """The file of the cell of a name."""
        return self._names[name][0]

    def named(self, name: str) -> str | None:
        """The name of the cell that is called so, by whatever of its names; None for none."""
        wanted = name.strip().lower()
        return next((own for own, (_, names) in self._names.items() if wanted in names), None)


def find_cell(name: str, values: str = "") -> UnitCell:
    """The library's cell of that name (case does not matter), or the cell of a JSON file.

    A library's cell is found by the names that others know it by, too.

    Args:
        name: of the cell, or its file.
        values: of its parameters, such as ``t = 0.3, angle = 60``; empty for the usual ones.

    Raises:
        VolfrepError: no such cell, the file is not a valid cell, or it has no such values.

    >>> find_cell("octet").name
    'Octet'
    """
    own = LIBRARY.named(name)
    if own is not None:
        if not values.strip():
            return LIBRARY[own]
        return replace(load_cell(LIBRARY.file(own), values), source="")
    if name.lower().endswith(".json"):
        return load_cell(name, values)
    raise VolfrepError(
        f"There is no unit cell named '{name}': choose one of {', '.join(LIBRARY)}, for walls one "
        f"of {', '.join(SURFACES)}, or give the path of a cell's .json file."
    )


def any_cell(name: str, values: str = "", formula: str = "") -> UnitCell | PeriodicSurface:
    """What is called so: a cell of struts (`find_cell`), or a surface that walls follow.

    Args:
        name: of it, or a cell's file.
        values: as of `find_cell`.
        formula: of the user's own surface.

    Raises:
        VolfrepError: as `find_cell` and `find_surface`.
    """
    return find_surface(name, formula) or find_cell(name, values)


def measure_of(name: str) -> str:
    """The parameter that says how thick a lattice of the cell of a name is."""
    return (UnitCell if surface_name(name) is None else PeriodicSurface).measure


def load_cell(path: str | os.PathLike[str], values: str = "") -> UnitCell:
    """Read a custom cell: ``{"name": …, "nodes": [[x, y, z], …], "struts": [[i, j], …]}``.

    Nodes are in units of L within [0, 1], struts are pairs of node indices from 0. ``edges`` are
    three lengths of its box in units of L where it is no cube, and nodes are in units of these;
    ``widths`` are one number for each strut where the lattice's radius is multiplied by it. In
    place of nodes and struts there may be a ``tessellation`` (`cell_files.tessellation`). Numbers
    may be formulas of the cell's ``parameters`` (`cell_files.parameters`). The file may tell a
    ``use``, a key of `USES`, a few words ``about`` the cell, and in ``also`` a list of other names.

    Args:
        path: of the file.
        values: of its parameters, such as ``t = 0.3, angle = 60``; empty for the usual ones.

    Raises:
        VolfrepError: naming the file and what is wrong in it.
    """
    file = Path(path)
    data = read_json(file, "cell file", MAX_FILE_BYTES)
    if not isinstance(data, dict) or not (
        {"nodes", "struts"} <= data.keys() or "tessellation" in data
    ):
        raise VolfrepError(
            f"The cell file '{file}' must be an object with 'nodes' and 'struts', or with a "
            "'tessellation'."
        )
    name = data.get("name", file.stem)
    if not isinstance(name, str) or not name.strip():
        raise VolfrepError(f"In the cell file '{file}', 'name' must be a text.")
    use, about_text, also = data.get("use", ""), data.get("about", ""), data.get("also", [])
    if use not in ("", *USES):
        raise VolfrepError(
            f"In the cell file '{file}', 'use' must be one of {', '.join(USES)}, or left out."
        )
    if not isinstance(about_text, str):
        raise VolfrepError(f"In the cell file '{file}', 'about' must be a text.")
    if not isinstance(also, list) or not all(isinstance(other, str) for other in also):
        raise VolfrepError(f"In the cell file '{file}', 'also' must be a list of names.")
    where = f"cell file '{file}'"
    parameters = read_parameters(data.get("parameters", {}), where, {*FUNCTIONS, *CONSTANTS})
    chosen = chosen_values(parameters, values, name.strip())
    edges = evaluate_numbers(data.get("edges", [1.0, 1.0, 1.0]), chosen, where)
    widths = evaluate_numbers(data.get("widths", []), chosen, where)
    if "tessellation" in data:
        # of no use to most cells, and slow to import
        from .cell_files.tessellation import tessellate

        if "nodes" in data or "struts" in data or "widths" in data:
            raise VolfrepError(
                f"The {where} has a 'tessellation': leave nodes, struts and widths out."
            )
        x, y, z = _numbers(edges, 3, "edges", where)
        rules = data["tessellation"]
        if isinstance(rules, dict) and isinstance(points := rules.get("about"), list):
            points = evaluate_numbers(points, chosen, where)
            rules = rules | {"about": number_rows(points, 3, "point", where, MOST_POINTS)}
        nodes, struts = tessellate(rules, (x, y, z), where)
    else:
        nodes = evaluate_numbers(data["nodes"], chosen, where)
        struts = data["struts"]
    cell = make_cell(name.strip(), nodes, struts, where, edges=edges, widths=widths or ())
    usual = {one.name: one.usual for one in parameters}
    text = ", ".join(f"{key} = {value!r}" for key, value in chosen.items() if value != usual[key])
    return replace(
        cell, source=str(file), use=use, about=about_text, also=tuple(also),
        parameters=parameters, values=text,
    )  # fmt: skip


def make_cell(
    name: str,
    nodes: object,
    struts: object,
    where: str = "unit cell",
    *,
    edges: object = (1.0, 1.0, 1.0),
    widths: object = (),
) -> UnitCell:
    """A validated cell from lists or arrays; `where` names the source in error messages.

    Raises:
        VolfrepError: naming the first node or strut that is wrong.

    >>> cell = make_cell("Tent", [[0, 0, 0], [1, 0, 0], [0.5, 0.5, 1]], [[0, 1], [1, 2], [2, 0]])
    >>> cell.nodes.shape, cell.is_mirror_symmetric
    ((3, 3), False)
    """
    points = number_rows(nodes, 3, "node", where, MAX_NODES)
    rows = number_rows(struts, 2, "strut", where, MAX_STRUTS)
    bad = np.flatnonzero(((points < 0.0) | (points > 1.0)).any(axis=1))
    if len(bad):
        raise VolfrepError(
            f"In the {where}, node {bad[0]} lies outside the cell: give coordinates in units "
            "of L, from 0 to 1."
        )
    pairs = strut_rows(rows, len(points), where)
    first, inverse = find_same(points)
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
    _refuse_loose(points, pairs, where)
    x, y, z = _numbers(edges, 3, "edges", where)
    factors = [] if widths == () else _numbers(widths, len(pairs), "widths", where)
    return UnitCell(name, points, pairs, (x, y, z), np.array(factors))


def _refuse_loose(nodes: Floats, struts: NDArray[np.int64], where: str) -> None:
    """Raise a `VolfrepError` where a node has no strut."""
    loose = np.ones(len(nodes), bool)
    loose[struts[(struts >= 0) & (struts < len(nodes))]] = False
    if loose.any():
        raise VolfrepError(
            f"In the {where}, node {int(loose.argmax())} has no strut: remove it or join it."
        )


def _numbers(values: object, count: int, name: str, where: str) -> list[float]:
    """So many numbers from a tenth to ten.

    Raises:
        VolfrepError: they are none.
    """
    fits = isinstance(values, (list, tuple, np.ndarray)) and len(values) == count
    if not fits or not all(
        isinstance(value, (int, float)) and 0.1 <= value <= 10.0
        for value in values  # type: ignore[attr-defined]
    ):
        raise VolfrepError(
            f"In the {where}, '{name}' must be a list of {count} numbers from 0.1 to 10."
        )
    return [float(value) for value in values]  # type: ignore[attr-defined]


#: The library's cells by name, sorted by what they are for.
LIBRARY = _Library()

Number = TypeVar("Number", float, Floats)


def joint_radius(strut_radius: Number, cell_size: float) -> Number:
    """Radius of a joint sphere, r (1 + r / L), mm (Eq. 8).

    >>> joint_radius(1.0, 10.0)
    1.1
    """
    return strut_radius * (1.0 + strut_radius / cell_size)
