# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load cases from TOML files, as docs/loads.md describes them."""

from __future__ import annotations

import difflib
import math
import os
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..mechanics.materials import SolidMaterial, find_material, material_of
from ..mesh.smooth_faces import smooth_faces
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import closest_points
from ..util.errors import VolfrepError, listed
from ..util.reading import read_toml
from ..util.types import Ints
from .load_cases import (
    Force,
    Heat,
    Load,
    LoadCase,
    LoadCases,
    Mass,
    Moment,
    Pressure,
    Support,
    cone_of,
)
from .regions import (
    AllOf,
    AnyOf,
    InBox,
    InCylinder,
    InPlane,
    NearPoint,
    OnFacets,
    Region,
    Vector,
)

#: So many of the first unit is one of these; a mere number is in the first.
UNITS: dict[str, dict[str, float]] = {
    "length": {"mm": 1.0, "um": 1e-3, "cm": 10.0, "m": 1e3, "in": 25.4},
    "force": {"N": 1.0, "kN": 1e3, "mN": 1e-3, "lbf": 4.4482216152605},
    "moment": {"N mm": 1.0, "N m": 1e3, "kN m": 1e6, "lbf in": 112.9848290276167},
    "pressure": {"MPa": 1.0, "N/mm2": 1.0, "kPa": 1e-3, "Pa": 1e-6, "bar": 0.1,
                 "psi": 6.894757293168e-3},
    "mass": {"g": 1.0, "kg": 1e3, "lb": 453.59237},
    "acceleration": {"mm/s2": 1.0, "m/s2": 1e3, "g": 9806.65},
}  # fmt: skip
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")

_REGION = ("plane", "box", "cylinder", "sphere", "point", "face", "any")
_SHAPES = {
    "plane": ("point", "normal"),
    "box": ("low", "high"),
    "cylinder": ("point", "axis", "radius", "length"),
    "sphere": ("point", "radius"),
}
_MAKERS: dict[str, Callable[..., Region]] = {
    "plane": InPlane,
    "box": InBox,
    "cylinder": InCylinder,
    "sphere": lambda point, radius: NearPoint(point, radius),
}
_OPTIONAL = {"length"}
_LOADS = ("force", "moment", "pressure")
_SUPPORT = ("name", *_REGION, "fixed", "x", "y", "z")
_LOAD = ("name", *_REGION, *_LOADS, "at", "cone")
_CASE = ("name", "acceleration", "temperature", "support", "load")
_MASS = ("name", *_REGION, "mass")
_HEAT = ("name", *_REGION, "temperature", "power", "film")
_FILE = (
    "material", "yield_stress", "expansion", "reference", "conductivity", "support", "mass",
    "heat", "case",
)  # fmt: skip


def read_load_cases(path: str | os.PathLike[str], solid: TriangleMesh | None = None) -> LoadCases:
    """The material and the load cases of a file.

    Args:
        path: of a TOML file; lengths in it are mm, in the part's coordinates.
        solid: the part, of which ``face`` names faces; None where the file has no ``face``.

    Raises:
        VolfrepError: the file cannot be read, or the first entry that makes no sense, by its place.
    """
    path = Path(path)
    entries = read_toml(path, "load file")
    try:
        return _Reader(path.parent, solid).cases(entries)
    except VolfrepError as error:
        raise VolfrepError(f"{path}, {error}") from error


def load_cases_of(entries: Mapping[str, Any], solid: TriangleMesh | None = None) -> LoadCases:
    """The material and the load cases of tables, as those of a file, in Python.

    Args:
        entries: dicts and lists with the entries of a file (docs/loads.md); files that they name
            are looked for from where the program runs.
        solid: as of `read_load_cases`.

    Raises:
        VolfrepError: the first entry that makes no sense, by its place.
    """
    try:
        return _Reader(Path(), solid).cases(_as_json(entries))
    except VolfrepError as error:
        raise VolfrepError(f"Loads, {error}") from error


def _as_json(value: Any) -> Any:
    """Tuples and arrays as lists, numpy's numbers as Python's."""
    if isinstance(value, Mapping):
        return {str(name): _as_json(item) for name, item in value.items()}
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    return [_as_json(item) for item in value] if isinstance(value, (list, tuple)) else value


class _Reader:
    """Reads the tables of a file; every method takes the place of its table, for messages."""

    def __init__(self, folder: Path, solid: TriangleMesh | None) -> None:
        self.folder, self.solid = folder, solid
        self._numbers: Ints | None = None
        self.expansion: float | None = None
        self.reference = 20.0

    def cases(self, entries: Mapping[str, Any]) -> LoadCases:
        where = "the file"
        _known(entries, _FILE, where)
        material = self._material(entries, where)
        if "expansion" in entries:
            self.expansion = _number(entries["expansion"], "expansion")
        if "reference" in entries:
            self.reference = _number(entries["reference"], "reference")
        common = self._supports(entries, where)
        tables = _tables(entries, "case", where)
        if not tables and "heat" not in entries:
            raise VolfrepError("the file: it has no load case: begin one with [[case]].")
        cases = [
            case for k, table in enumerate(tables, 1) for case in self._cases(table, common, k)
        ]
        with _at("the file"):
            conductivity = None
            if "conductivity" in entries:
                conductivity = _number(entries["conductivity"], "conductivity")
            masses, heat = self._masses(entries, where), self._heat(entries, where)
            return LoadCases(material, tuple(cases), masses, heat, conductivity)

    def _masses(self, entries: Mapping[str, Any], where: str) -> tuple[Mass, ...]:
        found = []
        for k, table in enumerate(_tables(entries, "mass", where), 1):
            place = f"mass {k}"
            _known(table, _MASS, place)
            if "mass" not in table:
                raise VolfrepError(f'{place}: it has no mass: give one, such as mass = "2 kg".')
            grams = _quantity(table["mass"], "mass", f"{place}, mass")
            with _at(place):
                found.append(Mass(self._region(table, place), grams, _name(table, place, place)))
        return tuple(found)

    def _heat(self, entries: Mapping[str, Any], where: str) -> tuple[Heat, ...]:
        found = []
        for k, table in enumerate(_tables(entries, "heat", where), 1):
            place = f"heat {k}"
            _known(table, _HEAT, place)
            values = {
                key: _number(table[key], f"{place}, {key}")
                for key in ("temperature", "power", "film")
                if key in table
            }
            with _at(place):
                region = self._region(table, place)
                found.append(Heat(region, **values, name=_name(table, place, place)))
        return tuple(found)

    def _material(self, entries: Mapping[str, Any], where: str) -> SolidMaterial:
        value = entries.get("material")
        if isinstance(value, dict):
            material = material_of(value, "[material]", "material")
        elif isinstance(value, str):
            if value.lower().endswith((".json", ".toml")):
                value = os.path.join(self.folder, value)
            with _at("material"):
                material = find_material(value)
        else:
            raise VolfrepError(
                f'{where}: it needs a material: its name, such as material = "Ti-6Al-4V", or a '
                "table [material]."
            )
        if "yield_stress" in entries:
            limit = _quantity(entries["yield_stress"], "pressure", "yield_stress")
            with _at("yield_stress"):
                material = replace(material, yield_stress=limit)
        return material

    def _cases(
        self, table: Mapping[str, Any], common: tuple[Support, ...], k: int
    ) -> tuple[LoadCase, ...]:
        """A case, or those of the cone that one of its forces may act in."""
        name = table.get("name", f"case {k}")
        if not isinstance(name, str) or not name.strip():
            raise VolfrepError(f"case {k}, name: {name!r} is no text.")
        where = f"case '{name}'"
        _known(table, _CASE, where)
        loads = tuple(
            self._load(load, f"{where}, load {j}", f"load {j}")
            for j, load in enumerate(_tables(table, "load", where), 1)
        )
        acceleration = (0.0, 0.0, 0.0)
        if "acceleration" in table:
            acceleration = _vector(table["acceleration"], "acceleration", f"{where}, acceleration")
        heated = None
        if table.get("temperature") == "heat":
            heated = self._coefficient(where), self.reference
        strain = 0.0 if heated else self._strain(table, where)
        own = self._supports(table, where)
        cones = [
            (j, load["cone"]) for j, load in enumerate(_tables(table, "load", where))
            if "cone" in load
        ]  # fmt: skip
        if len(cones) > 1:
            raise VolfrepError(f"{where}: {len(cones)} loads have a cone: give it to one.")
        with _at(where):
            case = LoadCase(name, common + own, loads, acceleration, strain, heated)
            for j, angle in cones:
                if isinstance(angle, bool) or not isinstance(angle, (int, float)):
                    raise VolfrepError(f"{where}, cone: {angle!r} is no number of degrees.")
                return cone_of(case, j, float(angle))
            return (case,)

    def _strain(self, table: Mapping[str, Any], where: str) -> float:
        """By which a case's temperature makes the part larger."""
        if "temperature" not in table:
            return 0.0
        return self._coefficient(where) * _number(table["temperature"], f"{where}, temperature")

    def _coefficient(self, where: str) -> float:
        if self.expansion is None:
            raise VolfrepError(
                f"{where}, temperature: the file needs the material's expansion, such as "
                "expansion = 9e-6 a degree, before the first [[case]]."
            )
        return self.expansion

    def _supports(self, table: Mapping[str, Any], where: str) -> tuple[Support, ...]:
        return tuple(
            self._support(support, f"{where}, support {j}", f"support {j}")
            for j, support in enumerate(_tables(table, "support", where), 1)
        )

    def _support(self, table: Mapping[str, Any], where: str, name: str) -> Support:
        _known(table, _SUPPORT, where)
        fixed = table.get("fixed", False)
        if not isinstance(fixed, bool):
            raise VolfrepError(f"{where}, fixed: {fixed!r} is neither true nor false.")
        axes = [axis for axis in "xyz" if axis in table]
        if fixed == bool(axes):
            raise VolfrepError(
                f"{where}: give either fixed = true, or displacements along some of x, y and z, "
                "such as x = 0."
            )
        displacement = [
            _quantity(table[axis], "length", f"{where}, {axis}") if axis in axes else None
            for axis in "xyz"
        ]
        region = self._region(table, where)
        turns = (not fixed,) * 3
        with _at(where):
            if fixed:
                return Support(region, turns=turns, name=_name(table, name, where))
            return Support(
                region,
                (displacement[0], displacement[1], displacement[2]),
                turns,
                _name(table, name, where),
            )

    def _load(self, table: Mapping[str, Any], where: str, name: str) -> Load:
        _known(table, _LOAD, where)
        given = [key for key in _LOADS if key in table]
        if len(given) != 1:
            what = f"gives {listed(given, 'and')}" if given else "gives none"
            raise VolfrepError(f"{where}: it {what}: give one of force, moment and pressure.")
        kind = given[0]
        if "at" in table and kind != "force":
            raise VolfrepError(f"{where}, at: only a force acts at a point: leave it out.")
        region = self._region(table, where)
        name = _name(table, name, where)
        place = f"{where}, {kind}"
        with _at(where):
            if kind == "pressure":
                return Pressure(region, _quantity(table[kind], kind, place), name)
            vector = _vector(table[kind], kind, place)
            if kind == "moment":
                return Moment(region, vector, name)
            at = _vector(table["at"], "length", f"{where}, at") if "at" in table else None
            return Force(region, vector, at, name)

    def _region(self, table: Mapping[str, Any], where: str) -> Region:
        """All that the shapes of a table have in common."""
        parts = [self._shape(key, table[key], f"{where}, {key}") for key in _REGION if key in table]
        if not parts:
            raise VolfrepError(f"{where}: it says nowhere: give one of {', '.join(_REGION)}.")
        return parts[0] if len(parts) == 1 else AllOf(tuple(parts))

    def _shape(self, key: str, value: Any, where: str) -> Region:
        if key == "any":
            if not isinstance(value, list) or not value:
                raise VolfrepError(f"{where}: it is no list of regions such as [{{ face = 3 }}].")
            regions = []
            for k, table in enumerate(value, 1):
                place = f"{where} {k}"
                _known(_table(table, place), _REGION, place)
                regions.append(self._region(table, place))
            return AnyOf(tuple(regions))
        if key == "face":
            return self._face(value, where)
        if key == "point":
            with _at(where):
                return NearPoint(_vector(value, "length", where))
        shape = _table(value, where)
        _known(shape, _SHAPES[key], where)
        missing = [name for name in _SHAPES[key] if name not in shape and name not in _OPTIONAL]
        if missing:
            raise VolfrepError(f"{where}: it has no '{missing[0]}': give {_and(_SHAPES[key])}.")
        read: dict[str, Any] = {
            name: (_quantity if name in ("radius", "length") else _vector)(
                shape[name], "length", f"{where}, {name}"
            )
            for name in shape
        }
        with _at(where):
            return _MAKERS[key](**read)

    def _face(self, value: Any, where: str) -> OnFacets:
        """A smooth face of the part: by its number, or by a point on it."""
        if self.solid is None:
            raise VolfrepError(f"{where}: there is no part here to find a face of.")
        if self._numbers is None:
            self._numbers = smooth_faces(self.solid)
        faces = int(self._numbers.max())
        if isinstance(value, list):
            point = np.array([_vector(value, "length", where)])
            number = int(self._numbers[closest_points(self.solid, point)[2][0]])
        elif isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= faces:
            number = value
        else:
            raise VolfrepError(
                f"{where}: {value!r} is no face: give its number, from 1 for the largest to "
                f"{faces}, or a point on it."
            )
        corners = np.stack(self.solid.corners(), axis=1)[self._numbers == number]
        return OnFacets(corners, f"face {number}")


@contextmanager
def _at(where: str) -> Iterator[None]:
    """Names the place of whatever a table's object refuses."""
    try:
        yield
    except VolfrepError as error:
        if str(error).startswith(where):
            raise
        raise VolfrepError(f"{where}: {error}") from error


def _tables(table: Mapping[str, Any], key: str, where: str) -> list[Mapping[str, Any]]:
    value = table.get(key, [])
    if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
        raise VolfrepError(f"{where}, {key}: begin each with [[...{key}]], in double brackets.")
    return value


def _table(value: Any, where: str) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise VolfrepError(f"{where}: {value!r} is no table such as {{ point = [0, 0, 0], ... }}.")
    return value


def _known(table: Mapping[str, Any], names: tuple[str, ...], where: str) -> None:
    for name in table:
        if name not in names:
            near = difflib.get_close_matches(name, names, 1, 0.0)[0]
            raise VolfrepError(
                f"{where}: it has an unknown entry '{name}': the nearest is '{near}'."
            )


def _name(table: Mapping[str, Any], name: str, where: str) -> str:
    value = table.get("name", name)
    if not isinstance(value, str):
        raise VolfrepError(f"{where}, name: {value!r} is no text.")
    return value


def _vector(value: Any, kind: str, where: str) -> Vector:
    if not isinstance(value, list) or len(value) != 3:
        first = next(iter(UNITS[kind]))
        raise VolfrepError(
            f'{where}: {value!r} is no list of three, such as [0, 0, 10] or [0, 0, "10 {first}"].'
        )
    x, y, z = (_quantity(item, kind, where) for item in value)
    return x, y, z


def _number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise VolfrepError(f"{where}: {value!r} is no number.")
    return float(value)


def _quantity(value: Any, kind: str, where: str) -> float:
    """A number in the kind's first unit, from a number or a text with a unit."""
    units = UNITS[kind]
    unit = ""
    if isinstance(value, str):
        match = _NUMBER.fullmatch(value)
        if match is None:
            first = next(iter(units))
            raise VolfrepError(f"{where}: '{value}' is no {kind} such as 10 or \"10 {first}\".")
        value, unit = float(match[1]), " ".join(match[2].split())
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise VolfrepError(f"{where}: {value!r} is no {kind}: give a number.")
    if unit and unit not in units:
        raise VolfrepError(f"{where}: '{unit}' is no unit of {kind}: use {', '.join(units)}.")
    return float(value) * units.get(unit, 1.0)


def _and(names: tuple[str, ...]) -> str:
    wanted = [f"{name} if it ends" if name in _OPTIONAL else name for name in names]
    return listed(wanted, "and")
