# SPDX-License-Identifier: LGPL-2.1-or-later
"""A study: parts, the parameters that vary, what is done with each design, what is best."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from ..design.parameters.spec_file import KEYS, nearest_key, parse_spec, read_values, with_paths
from ..design.parameters.specification import merge_values
from ..design.parameters.table import BY_NAME
from ..design.parameters.values import SCALES, value_from_json
from ..io.solid import MeshLike
from ..mechanics.materials import SolidMaterial, find_material
from ..mesh.triangle_mesh import TriangleMesh
from ..reports.processes import Process, find_process
from ..util.arguments import check_kind, check_path
from ..util.errors import VolfrepError, listed
from .actions import check_actions
from .sampling import SAMPLINGS, Range

#: Keys of a study's file.
_KEYS = (
    "part", "parts", "unit", "spec", "do", "material", "process", "loads", "export", "sampling",
    "samples", "seed", "fixed", "vary", "designs", "size", "front",
)  # fmt: skip
_FRONT_KEYS = ("objectives", "do", "designs")
#: What an objective may ask for.
_WAYS = ("least", "most")


@dataclass(frozen=True)
class Front:
    """What is best, and what more is done with it.

    Attributes:
        objectives: ``least`` or ``most`` by the name of a figure, such as ``forecast.mass_g``.
        do: actions for the designs that are chosen, beside those of the study.
        designs: how many are chosen; None for the Pareto front as it is. More than there are on it
            are taken from the next fronts, fewer from where they lie farthest apart.

    >>> Front({"forecast.mass_g": "least", "properties.E100": "most"}).designs is None
    True
    """

    objectives: Mapping[str, str]
    do: Sequence[str] = ()
    designs: int | None = None

    def __post_init__(self) -> None:
        check_kind("objectives", self.objectives, Mapping, "a dict of figures, least or most")
        if not self.objectives:
            raise VolfrepError("A Pareto front needs objectives: name figures, least or most.")
        for name, way in self.objectives.items():
            if way not in _WAYS:
                raise VolfrepError(
                    f"The objective '{name}' cannot be {way!r}: choose {listed(_WAYS)}."
                )
            if "." not in name:
                raise VolfrepError(
                    f"The objective '{name}' names no figure of an action: write it as "
                    f"'forecast.{name}', or as another column of the table is called."
                )
        if self.designs is not None and self.designs < 1:
            raise VolfrepError(f"At least 1 design is chosen of a front, not {self.designs}.")


@dataclass(frozen=True, eq=False)
class Study:
    """Many designs of one part or of several.

    Attributes:
        parts: files, or meshes and arrays as `fill` takes them.
        vary: by the name of a parameter: its values, or the `Range` that they lie in.
        fixed: values of other parameters by name, as `design.parameters.specification` takes them.
        sampling: ``grid`` (every combination), ``list`` (the `designs`) or ``latin-hypercube``
            (`samples` that fill the space of what varies).
        designs: of a list: values by name.
        samples: of a hypercube.
        seed: of a hypercube; the same one gives the same designs.
        do: names of actions (`studies.actions.ACTIONS`).
        front: what is best; None for no front.
        material: the solid's, itself or as `find_material` takes it: its density where none is
            given, its modulus and yield stress in the properties.
        process: of the print check.
        loads: file of the load cases (docs/loads.md) that ``solve`` and ``size`` look at; its own
            material holds there.
        goal: of ``size``: limits or a mass, as numbers by name (`jobs.sizing.GOALS`).
        export: extension of the files that the action ``export`` writes.
        unit: of the files' lengths; None for what they say.

    Raises:
        VolfrepError: at construction, naming what makes no sense.

    >>> study = Study(parts=("part.stl",), vary={"cell": ("BCC", "CVC")}, fixed={"shell": 1.0})
    >>> study.varied, study.all_actions
    (('cell',), ('forecast', 'properties'))
    """

    parts: Sequence[str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike]]
    vary: Mapping[str, Sequence[Any] | Range] = field(default_factory=dict)
    fixed: Mapping[str, Any] = field(default_factory=dict)
    sampling: str = "grid"
    designs: Sequence[Mapping[str, Any]] = ()
    samples: int = 0
    seed: int = 0
    do: Sequence[str] = ("forecast", "properties")
    front: Front | None = None
    material: str | SolidMaterial | None = None
    process: str | None = None
    loads: str | os.PathLike[str] | None = None
    goal: Mapping[str, float] = field(default_factory=dict)
    export: str = ".stl"
    unit: str | None = None

    def __post_init__(self) -> None:
        check_kind("parts", self.parts, (tuple, list), "a tuple of files or solids")
        check_kind("do", self.do, (tuple, list), "a tuple of names of actions")
        for name in ("vary", "fixed", "goal"):
            check_kind(name, getattr(self, name), Mapping, "a dict of values by name")
            for key in getattr(self, name):
                check_kind(name, key, str, "a dict of values by name")
        for name, values in self.vary.items():
            what = "its values or a Range"
            check_kind(f"vary, {name}", values, (tuple, list, Range), what)
        for name in self.do:
            check_kind("do", name, str, "a tuple of names of actions")
        if not self.parts:
            raise VolfrepError("A study needs a part: name one or several files.")
        if self.sampling not in SAMPLINGS:
            raise VolfrepError(
                f"There is no sampling '{self.sampling}': choose {', '.join(SAMPLINGS)}."
            )
        is_list = self.sampling == "list"
        if is_list and (self.vary or not self.designs):
            raise VolfrepError("A list of designs has designs, each with its values, and no vary.")
        if not is_list and self.designs:
            raise VolfrepError(f"The sampling '{self.sampling}' makes the designs: list none.")
        if self.sampling == "latin-hypercube" and not self.vary:
            raise VolfrepError("A Latin hypercube needs parameters that vary.")
        if (self.sampling == "latin-hypercube") != (self.samples > 0):
            raise VolfrepError(
                "A Latin hypercube, and nothing else, needs samples: how many designs it has."
            )
        names = {*self.vary, *(name for values in self.designs for name in values)}
        for name in (*names, *self.fixed):
            if name not in BY_NAME:
                raise VolfrepError(_unknown(name))
        both = names & self.fixed.keys()
        if both:
            raise VolfrepError(f"'{min(both)}' is fixed and varies: leave one of them out.")
        check_actions(self.all_actions, self.process, self.export, self.loads)
        if self.goal and "size" not in self.all_actions:
            raise VolfrepError("A goal of sizing has no effect without the action 'size'.")
        for name in self.front.objectives if self.front is not None else ():
            if name.partition(".")[0] not in self.do:
                raise VolfrepError(
                    f"The objective '{name}' is of no action that is done with every design: those "
                    f"are {', '.join(self.do)}."
                )
        self.solid_material()

    @property
    def all_actions(self) -> tuple[str, ...]:
        """Of every design, then those of the front alone."""
        more = self.front.do if self.front is not None else ()
        return (*self.do, *(name for name in more if name not in self.do))

    @property
    def varied(self) -> tuple[str, ...]:
        """Names of the parameters that differ from design to design."""
        if self.sampling != "list":
            return tuple(self.vary)
        return tuple(dict.fromkeys(name for values in self.designs for name in values))

    def solid_material(self) -> SolidMaterial | None:
        """The material itself."""
        if isinstance(self.material, str):
            return find_material(self.material)
        return self.material

    def print_process(self) -> Process | None:
        """The process itself."""
        return None if self.process is None else find_process(self.process)


def read_study(path: str | os.PathLike[str]) -> Study:
    r"""The study of a TOML file (docs/studies.md); the files it names are seen from its folder.

    Raises:
        VolfrepError: naming the file, the entry, and what is wrong with it.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "study.toml"
    ...     _ = file.write_text('part = "a.stl"\n[vary]\ncell = ["BCC", "CVC"]\n')
    ...     read_study(file).vary
    {'cell': ('BCC', 'CVC')}
    """
    check_path("path", path)
    path = Path(path)
    data = parse_spec(path, "study")
    try:
        return _study(path.parent, data)
    except VolfrepError as error:
        raise VolfrepError(f"{path}: {error}") from error


def _study(folder: Path, data: Mapping[str, Any]) -> Study:
    _refuse_unknown("The study", data, _KEYS)
    if ("part" in data) == ("parts" in data):
        raise VolfrepError("Give either 'part', a file, or 'parts', a list of files.")
    parts = data["parts"] if "parts" in data else [data["part"]]
    if not isinstance(parts, list) or not all(isinstance(part, str) for part in parts):
        raise VolfrepError("'parts' is a list of files, and 'part' is one file.")
    fixed = {name: _value(folder, name, v) for name, v in _table(data, "fixed").items()}
    vary = {name: _variation(folder, name, v) for name, v in _table(data, "vary").items()}
    designs = data.get("designs", [])
    if not isinstance(designs, list) or not all(isinstance(row, dict) for row in designs):
        raise VolfrepError("'designs' are tables: write each below a line [[designs]].")
    rows = tuple({n: _value(folder, n, v) for n, v in row.items()} for row in designs)
    if "spec" in data:
        varied = {name for table in (vary, *rows) for name in table}
        base = read_values(folder / _text(data, "spec"))
        fixed = merge_values(fixed, {name: v for name, v in base.items() if name not in varied})
    return Study(
        parts=tuple(str(folder / part) for part in parts),
        vary=vary,
        fixed=fixed,
        sampling=_text(data, "sampling", "list" if rows else "grid"),
        designs=rows,
        samples=_whole(data, "samples", 0),
        seed=_whole(data, "seed", 0),
        do=_names(data, "do", ("forecast", "properties")),
        front=_front(data),
        material=_text(data, "material", None),
        process=_text(data, "process", None),
        loads=None if "loads" not in data else str(folder / _text(data, "loads")),
        goal=_numbers(data, "size"),
        export=_text(data, "export", ".stl"),
        unit=_text(data, "unit", None),
    )


def _front(data: Mapping[str, Any]) -> Front | None:
    if "front" not in data:
        return None
    table = _table(data, "front")
    _refuse_unknown("The front", table, _FRONT_KEYS)
    designs = _whole(table, "designs", 0) if "designs" in table else None
    return Front(_flat(_table(table, "objectives")), _names(table, "do", ()), designs)


def _flat(table: Mapping[str, Any], before: str = "") -> dict[str, str]:
    """Names with dots, which TOML reads as tables in tables, as one name again."""
    result: dict[str, str] = {}
    for name, value in table.items():
        if isinstance(value, dict):
            result |= _flat(value, f"{before}{name}.")
        else:
            result[before + name] = value
    return result


def _value(folder: Path, name: str, value: Any) -> Any:
    if name not in KEYS:
        raise VolfrepError(_unknown(name))
    try:
        result = value_from_json(BY_NAME[name], value)
    except VolfrepError as error:
        raise VolfrepError(f"{name}: {error}") from error
    return with_paths(name, result, lambda file: os.path.join(folder, file))


def _variation(folder: Path, name: str, value: Any) -> tuple[Any, ...] | Range:
    if isinstance(value, list) and value:
        return tuple(_value(folder, name, item) for item in value)
    if not isinstance(value, dict) or not {"from", "to"} <= value.keys():
        raise VolfrepError(
            f"'{name}' varies over a list of values, or from one value to another: write "
            f"{name} = {{ from = 1, to = 2, steps = 5 }}."
        )
    _refuse_unknown(f"The range of '{name}'", value, ("from", "to", "steps"))
    if name not in KEYS:
        raise VolfrepError(_unknown(name))
    kind = BY_NAME[name].kind
    if kind not in ("integer", "number", *SCALES):
        raise VolfrepError(f"'{name}' has no range, as it is no number: list its values.")
    low, high = (_value(folder, name, value[end]) for end in ("from", "to"))
    return Range(low, high, _whole(value, "steps", 0), whole=kind == "integer")


def _table(data: Mapping[str, Any], name: str) -> dict[str, Any]:
    table = data.get(name, {})
    if not isinstance(table, dict):
        raise VolfrepError(f"'{name}' is a table: write its entries below a line [{name}].")
    return table


def _text(data: Mapping[str, Any], name: str, default: Any = "") -> Any:
    value = data.get(name, default)
    if value is not None and not isinstance(value, str):
        raise VolfrepError(f"'{name}' is a text, not {value!r}.")
    return value


def _numbers(data: Mapping[str, Any], name: str) -> dict[str, float]:
    table = _table(data, name)
    for key, value in table.items():
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise VolfrepError(f"'{name}.{key}' is a number, not {value!r}.")
    return {key: float(value) for key, value in table.items()}


def _whole(data: Mapping[str, Any], name: str, default: int) -> int:
    value = data.get(name, default)
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise VolfrepError(f"'{name}' is a whole number that is not negative, not {value!r}.")
    return value


def _names(data: Mapping[str, Any], name: str, default: tuple[str, ...]) -> tuple[str, ...]:
    value = data.get(name, list(default))
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise VolfrepError(f'\'{name}\' is a list of actions, such as ["forecast", "fill"].')
    return tuple(value)


def _refuse_unknown(what: str, table: Mapping[str, Any], known: tuple[str, ...]) -> None:
    for name in table:
        if name not in known:
            raise VolfrepError(f"{what} has an unknown entry '{name}': use {', '.join(known)}.")


def _unknown(name: str) -> str:
    return f"A lattice has no parameter '{name}': the nearest is '{nearest_key(name)}'."
