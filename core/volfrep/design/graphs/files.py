# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks from files: nodes and struts, lines, beams, and meshes that cells are laid into."""

from __future__ import annotations

import dataclasses
import itertools
import json
import os
import re
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from ...util.errors import VolfrepError
from ...util.reading import read_bytes, read_text, regular_file
from ..cells import UnitCell
from ..vtk_files import mesh_of
from .conformal_cells import layers_on, place_cells_into
from .graph import GivenGraph, make_network

#: A file may not be larger than this, nor what a 3MF unpacks to.
MAX_BYTES = 200_000_000
SUFFIXES = (".json", ".csv", ".obj", ".vtk", ".vtu", ".inp", ".msh", ".3mf")
#: Of these, those that may hold lines as text, and those that meshio reads the elements of.
LINES, ELEMENTS = (".obj", ".vtk"), (".obj", ".vtk", ".vtu", ".inp", ".msh")
#: Edges of a tetrahedron.
_TETRAHEDRON = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
#: Ends of a CSV's lines nearer than this are one node, mm.
SAME_PLACE = 1e-6
#: Units of a 3MF in mm.
_UNITS = {
    "micron": 1e-3, "millimeter": 1.0, "centimeter": 10.0, "meter": 1e3, "inch": 25.4,
    "foot": 304.8,
}  # fmt: skip


def read_network(
    path: str | os.PathLike[str],
    cell: UnitCell | None = None,
    thickness: float = 0.0,
    layers: int = 1,
) -> GivenGraph:
    """The network of a file, by its extension; lengths are mm (a 3MF says its unit).

    - ``.json``: ``{"nodes": [[x, y, z], …], "struts": [[i, j], …], "radii": […]}``; radii for
      each strut, each of its ends, or each node may be left out.
    - ``.csv``: a line a strut: x, y, z of both ends, and then none, one or two radii.
    - ``.obj``, ``.vtk`` (legacy), ``.vtu``, ``.inp`` (Abaqus), ``.msh`` (Gmsh): lines; without
      them hexahedra, with the cell in each (`place_cells_into`); without these tetrahedra's edges;
      without these quadrilaterals, with layers of the cell upon them (`layers_on`).
    - ``.3mf``: its beam lattice, with the beams' radii.

    Args:
        path: of the file.
        cell: for hexahedra and quadrilaterals.
        thickness: of all layers on quadrilaterals, mm.
        layers: how many these are.

    Raises:
        VolfrepError: naming the file and what is wrong in it.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix not in SUFFIXES:
        raise VolfrepError(
            f"Cannot read a network from '{file}': choose one of {', '.join(SUFFIXES)}."
        )
    where = f"network file '{file}'"
    try:
        regular_file(file, "network file", MAX_BYTES)
        if suffix == ".3mf":
            return make_network(*_beams(file, where), where, str(file))
        if suffix not in ELEMENTS or (suffix in LINES and _holds_lines(file)):
            text = read_text(file, "network file", MAX_BYTES)
            reader = {".json": _json, ".csv": _csv, ".obj": _obj, ".vtk": _vtk}[suffix]
            return make_network(*reader(text, where), where, str(file))
        return _of_elements(file, cell, thickness, layers, where)
    except OSError as error:
        raise VolfrepError(f"Cannot read the {where}: {error.strerror}.") from error
    except VolfrepError:
        raise
    except (ValueError, KeyError, IndexError, TypeError, RecursionError) as error:
        raise VolfrepError(f"The {where} cannot be read: {_error_text(error)}.") from error


def _holds_lines(file: Path) -> bool:
    word = rb"(?mi)^l[ \t]" if file.suffix.lower() == ".obj" else rb"(?mi)^LINES[ \t]"
    return re.search(word, read_bytes(file, "network file", MAX_BYTES)) is not None


def _of_elements(
    file: Path, cell: UnitCell | None, thickness: float, layers: int, where: str
) -> GivenGraph:
    """The network of a mesh: its lines, or what lies in or on its elements."""
    mesh, points = mesh_of(file, "save the struts as .csv", "a legacy ASCII .vtk")

    def elements(kind: str, corners: int) -> NDArray[np.int64]:
        """Of second-order ones the corners, which come first."""
        found = [
            np.asarray(block.data, np.int64)[:, :corners]
            for block in mesh.cells
            if block.type.rstrip("0123456789") == kind
        ]
        rows = np.concatenate(found) if found else np.zeros((0, corners), np.int64)
        if rows.size and not (rows.min() >= 0 and rows.max() < len(points)):
            raise VolfrepError(f"In the {where}, an element names a point that is not there.")
        return rows

    source = str(file)
    lines = elements("line", 2)
    if len(lines):
        return make_network(points, lines, (), where, source)
    boxes, tetrahedra, quads = (
        elements(*kind) for kind in (("hexahedron", 8), ("tetra", 4), ("quad", 4))
    )
    if len(boxes) or (len(quads) and not len(tetrahedra)):
        if cell is None:
            raise VolfrepError(f"The {where} holds a mesh to lay cells into: give the cell.")
        if len(boxes):
            return place_cells_into(cell, points, boxes, where, source)
        made = layers_on(cell, points, quads, thickness, layers, where, source)
        return dataclasses.replace(made, thickness=thickness, layers=layers)
    if not len(tetrahedra):
        raise VolfrepError(
            f"The {where} holds no lines, hexahedra, tetrahedra or quadrilaterals to make a "
            "network of."
        )
    edges = np.sort(tetrahedra[:, np.array(_TETRAHEDRON)].reshape(-1, 2), axis=1)
    return make_network(points, np.unique(edges, axis=0), (), where, source)


def _error_text(error: Exception) -> str:
    text = str(error).strip().rstrip(".")
    return text or type(error).__name__


Found = tuple[object, object, object]


def _json(text: str, where: str) -> Found:
    data: Any = json.loads(text)
    if not isinstance(data, dict) or not {"nodes", "struts"} <= data.keys():
        raise VolfrepError(f"The {where} must be an object with 'nodes' and 'struts'.")
    return data["nodes"], data["struts"], data.get("radii", ())


def _csv(text: str, where: str) -> Found:
    lines = [line.replace(";", ",") for line in text.splitlines() if line.strip()]
    lines = [line for line in lines if not line.lstrip().startswith("#")]
    if lines and not any(map(_is_number, lines[0].split(","))):
        lines = lines[1:]  # the columns' names
    rows = [[float(word) for word in line.split(",") if word.strip()] for line in lines]
    widths = {len(row) for row in rows}
    if len(widths) != 1 or not widths <= {6, 7, 8}:
        raise VolfrepError(
            f"In the {where}, every line must hold x, y, z of both ends of a strut, and then "
            "none, one or two radii: the same on every line."
        )
    table = np.array(rows, float)
    ends = table[:, :6].reshape(-1, 3)
    if not np.isfinite(ends).all():
        raise VolfrepError(f"In the {where}, a line holds a number that is not finite.")
    _, first, number = np.unique(
        np.round(ends / SAME_PLACE), axis=0, return_index=True, return_inverse=True
    )
    return ends[first], number.reshape(-1, 2), _radii(table[:, 6:])


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _radii(columns: NDArray[np.float64]) -> object:
    return columns[:, 0] if columns.shape[1] == 1 else columns


def _obj(text: str, where: str) -> Found:
    nodes: list[list[float]] = []
    struts: list[tuple[int, int]] = []
    for line in text.splitlines():
        word, *rest = line.split("#")[0].split() or [""]
        if word == "v":
            nodes.append([float(value) for value in rest[:3]])
        elif word == "l":
            at = [int(value.split("/")[0]) for value in rest]
            at = [k - 1 if k > 0 else len(nodes) + k for k in at]
            struts += itertools.pairwise(at)
    return _with_lines(nodes, struts, where)


def _with_lines(nodes: object, struts: list[tuple[int, int]], where: str) -> Found:
    if not struts:
        raise VolfrepError(f"The {where} holds no lines.")
    return nodes, struts, ()


def _vtk(text: str, where: str) -> Found:
    if "BINARY" in text[:400].split():
        raise VolfrepError(f"The {where} is binary: save it as legacy ASCII VTK.")
    words = text.split()
    upper = [word.upper() for word in words]
    at = upper.index("POINTS")
    count = int(words[at + 1])
    nodes = np.array(words[at + 3 : at + 3 + 3 * count], float).reshape(-1, 3)
    at = upper.index("LINES")
    lines, size = int(words[at + 1]), int(words[at + 2])
    if words[at + 3].upper() == "OFFSETS":  # of version 5 of the format
        begin = at + 5
        offsets = np.array(words[begin : begin + lines], int)
        begin += lines + 2
        chain = np.array(words[begin : begin + size], int)
    else:
        numbers = np.array(words[at + 3 : at + 3 + size], int)
        chains, place = [], 0
        for _ in range(lines):
            chains.append(numbers[place + 1 : place + 1 + numbers[place]])
            place += 1 + int(numbers[place])
        chain = np.concatenate(chains)
        offsets = np.cumsum([0] + [len(one) for one in chains])
    pairs = np.stack([chain[:-1], chain[1:]], axis=1)
    inside = np.ones(len(pairs), bool)
    inside[offsets[1:-1] - 1] = False
    return _with_lines(nodes, [(int(a), int(b)) for a, b in pairs[inside]], where)


def _beams(file: Path, where: str) -> Found:
    """All beam lattices of a 3MF, objects where they lie in their own frames."""
    try:
        with zipfile.ZipFile(file) as opened:
            names = [n for n in opened.namelist() if n.lower().endswith(".model")]
            if sum(opened.getinfo(n).file_size for n in names) > MAX_BYTES:
                raise VolfrepError(f"The {where} unpacks to more than {MAX_BYTES // 10**6} MB.")
            texts = [opened.read(name) for name in names]
    except zipfile.BadZipFile as error:
        raise VolfrepError(f"The {where} is no 3MF: {error}.") from error
    nodes: list[list[float]] = []
    struts: list[tuple[int, int]] = []
    radii: list[tuple[float, float]] = []
    for text in texts:
        if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
            raise VolfrepError(f"The {where} holds declarations that no 3MF has.")
        try:
            root = ElementTree.fromstring(text)
        except ElementTree.ParseError as error:
            raise VolfrepError(f"The {where} is damaged: {error}.") from error
        scale = _UNITS[root.get("unit", "millimeter")]
        for mesh in root.iterfind(".//{*}mesh"):
            lattice = mesh.find("{*}beamlattice")
            if lattice is None:
                continue
            first, usual = len(nodes), lattice.get("radius")
            corners = mesh.iterfind(".//{*}vertex")
            nodes += [[scale * float(v.attrib[axis]) for axis in "xyz"] for v in corners]
            for beam in lattice.iterfind(".//{*}beam"):
                struts.append((first + int(beam.attrib["v1"]), first + int(beam.attrib["v2"])))
                one = float(beam.get("r1", usual or "nan"))
                radii.append((scale * one, scale * float(beam.get("r2", one))))
    if not struts:
        raise VolfrepError(f"The {where} holds no beam lattice.")
    return nodes, struts, radii
