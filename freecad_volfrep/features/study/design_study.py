# SPDX-License-Identifier: LGPL-2.1-or-later
"""A design study: designs of a lattice infill over a few of its properties, with their figures."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable
from functools import cache, partial
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.deps import engine_folders, python_executable
from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.lattice_infill import check_infill, is_infill
from freecad_volfrep.features.infill.materials import material_of
from freecad_volfrep.features.infill.values import json_values, values_in_effect
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.features.jobs.screen import attach_view
from freecad_volfrep.features.properties.property_table import Property, add_missing, result
from freecad_volfrep.features.properties.quantities import set_value
from freecad_volfrep.saved_names import SavesNothing, saved_module
from freecad_volfrep.sentences import report_line
from freecad_volfrep.translation import translate
from volfrep.design.cells import LIBRARY
from volfrep.design.parameters import BY_NAME, PARAMETERS, Parameter
from volfrep.design.parameters.parameter import effective
from volfrep.design.parameters.values import from_text
from volfrep.design.target import stiffness_text
from volfrep.util.errors import Cancelled, VolfrepError

if TYPE_CHECKING:
    from volfrep.design.spec import LatticeSpec
    from volfrep.process.worker import Program
    from volfrep.studies.study import Study

#: Kinds of parameters that can vary.
_VARIED = ("length", "number", "integer", "mass", "choice", "cell")
#: Properties of a document that say otherwise what a study's own parameters do.
_OF_THE_DOCUMENT = frozenset(
    p.name for p in PARAMETERS if p.name.startswith(("target_", "print_", "material_"))
) | {"radius_driven_by", "stiffness_direction"}
#: What a target is called in a study, by the property that gives it.
_AIMED = {"target_density": "relative_density", "target_mass": "mass"}
#: So many times its present value, a number begins with.
_AROUND = (0.8, 0.9, 1.0, 1.1, 1.25)
_RANGE = re.compile(r"\s*(.+?)\s+to\s+(.+?)\s+in\s+(\d+)\s*")
#: Of each property so many values, and its last, tell how long a study takes.
_FEW = 2
#: That begins with starting the workers, s.
_BEGIN = 4.0
OF_THE_SOLID = "of the solid's"
IN_TURN = (
    "The Python that goes with this FreeCAD cannot run the engine by itself: runs are done one "
    "after the other."
)
NOT_RUN = "Not run yet"
CANCELLED = "Cancelled: what was done is kept, and the next start goes on from there."

PROPERTIES = (
    Property("App::PropertyLink", "Infill", "Study", "The lattice infill whose designs these are"),
    Property(
        "App::PropertyStringList",
        "Vary",
        "Study",
        "Properties and their values: 'CellSize: 6, 8, 10' or 'ShellThickness: 1 to 3 in 5'",
    ),
    Property("App::PropertyBool", "Fill", "Study", "Make and measure every design, too", False),
    result("App::PropertyInteger", "Designs", "Designs with figures"),
    result("App::PropertyStringList", "Refused", "Why combinations were passed over, or failed"),
    result("App::PropertyString", "Folder", "Where the records and the page of the study are"),
    result("App::PropertyString", "Table", "Designs and their figures, as JSON"),
    result("App::PropertyString", "Status", "What the figures are of"),
)


class DesignStudy(SavesNothing):
    """Proxy of an ``App::FeaturePython`` that holds the designs of a lattice infill."""

    def __init__(self, obj: App.DocumentObject) -> None:
        obj.Proxy = self
        add_missing(obj, PROPERTIES, {})

    def execute(self, obj: App.DocumentObject) -> None:
        """Nothing: a study is run when its panel or a script says so (`run_study`)."""

    def onDocumentRestored(self, obj: App.DocumentObject) -> None:  # noqa: N802
        """Bring an object of an older file up to the present table of properties."""
        add_missing(obj, PROPERTIES, {})
        attach_view(obj)


# Saved files find the class under this name.
DesignStudy.__module__ = saved_module("features")


def make_design_study(
    doc: App.Document, infill: App.DocumentObject, **vary: str
) -> App.DocumentObject:
    """Add a design study of a lattice infill; `run_study` then runs it.

    Args:
        doc: the document that holds the infill.
        infill: a lattice infill.
        vary: values by the names of properties, such as ``CellSize="6, 8, 10"`` or
            ``ShellThickness="1 to 3 in 5"``; none for a first suggestion.

    Raises:
        VolfrepError: that is no lattice infill, or a property cannot vary so; nothing is added.
    """
    check_infill(infill)
    lines = [f"{name}: {text}" for name, text in vary.items()]
    variations(infill, lines)
    obj = doc.addObject("App::FeaturePython", "DesignStudy")
    DesignStudy(obj)
    obj.Infill = infill
    obj.Label = translate("VolfrepLabels", "{label} study").format(label=infill.Label)
    obj.Vary = lines or suggested(infill)
    obj.Status = NOT_RUN
    attach_view(obj)
    return obj


def variable(infill: App.DocumentObject) -> list[Parameter]:
    """The parameters of an infill that can vary: those that have an effect now."""
    values = json_values(infill)
    _, idle = effective(PARAMETERS, values)
    left_out = _OF_THE_DOCUMENT - _AIMED.keys()
    if values["radius_driven_by"] != "radius":
        left_out |= {"strut_radius"}
    return [
        parameter
        for parameter in PARAMETERS
        if parameter.in_freecad
        and parameter.kind in _VARIED
        and parameter.name not in idle
        and parameter.name not in left_out
    ]


def suggested(infill: App.DocumentObject) -> list[str]:
    """What a new study varies: the library's cells, the cell size, and the radius if there is one.

    The size is not among them: the same cell, larger, is as dense and as stiff.
    """
    names = {parameter.property_name: parameter for parameter in variable(infill)}
    wanted = ("CellType", "StrutRadius", "TargetDensity", "TargetMass", "ShellThickness")
    return [f"{name}: {values_about(infill, names[name])}" for name in wanted if name in names]


def values_about(infill: App.DocumentObject, parameter: Parameter) -> str:
    """Values that a parameter may take, about its present one, as a user writes them."""
    if parameter.kind == "cell":
        return ", ".join(LIBRARY)
    if parameter.kind == "choice":
        return ", ".join(parameter.labels)
    present = json_values(infill)[parameter.name]
    if parameter.kind == "integer":
        return ", ".join(str(max(1, round(present)) + step) for step in range(3))
    return ", ".join(f"{(present or 1.0) * share:.3g}" for share in _AROUND)


def designs_asked(infill: App.DocumentObject, lines: list[str]) -> int:
    """How many designs such lines ask for.

    Raises:
        VolfrepError: as `variations`.
    """
    from volfrep.studies.sampling import Range

    varied = variations(infill, lines)
    return prod(
        len(span.values(name)) if isinstance(span, Range) else len(span)
        for name, span in varied.items()
    )


def expected_seconds(infill: App.DocumentObject, lines: list[str], is_filled: bool) -> float:
    """About how long a start takes that such lines ask for, s.

    A few of the designs are forecast and stand for all.

    Args:
        infill: whose designs they are.
        lines: what varies.
        is_filled: whether every design is made.

    Raises:
        VolfrepError: as `variations`, or none of the designs makes sense.
    """
    from volfrep.studies.actions import ACTIONS
    from volfrep.studies.designs import specified
    from volfrep.studies.expectation import plan
    from volfrep.studies.running.executors import fitting_workers
    from volfrep.studies.running.scheduling import weight
    from volfrep.studies.sampling import Range, grid

    spec, solid = infill.Proxy.read(infill)
    varied = {
        name: span.values(name) if isinstance(span, Range) else span
        for name, span in variations(infill, lines).items()
    }
    few = {
        name: (*values[:: -(-len(values) // _FEW)], values[-1]) for name, values in varied.items()
    }
    actions = {name: ACTIONS[name].meshed for name in _actions(spec.is_graded, is_filled)}
    fixed, material = _fixed(infill, varied), material_of(infill)
    seconds, memory = [], 0.0
    for values in grid(few):
        try:
            design = specified({**fixed, **values}, material)
            forecast = plan(solid, design)
        except VolfrepError as error:
            refused = error
            continue
        seconds.append(weight(design, forecast.seconds, actions))
        memory = max(memory, forecast.memory_gb if is_filled else 0.2)
    if not seconds:
        raise refused
    count = prod(map(len, varied.values()))
    return _BEGIN + count * sum(seconds) / len(seconds) / fitting_workers(memory, None)


def variations(infill: App.DocumentObject, lines: list[str]) -> dict[str, Any]:
    """What varies, by the names of parameters, of lines such as ``CellSize: 6, 8``.

    Raises:
        VolfrepError: a property cannot vary, or a value makes no sense.
    """
    from volfrep.studies.sampling import Range

    known = {parameter.property_name: parameter for parameter in variable(infill)}
    found: dict[str, Any] = {}
    for line in lines:
        name, _, text = (part.strip() for part in line.partition(":"))
        if name not in known:
            raise VolfrepError(f"'{name}' cannot vary here: choose from {', '.join(known)}.")
        parameter = known[name]
        called = _AIMED.get(parameter.name, parameter.name)
        span = _RANGE.fullmatch(text)
        try:
            if span is not None and parameter.kind not in ("cell", "choice"):
                low, high = (from_text(parameter, end) for end in span.group(1, 2))
                found[called] = Range(low, high, int(span[3]), whole=parameter.kind == "integer")
                found[called].values(name)
            else:
                words = [word.strip() for word in text.split(",") if word.strip()]
                read = _cell if parameter.kind == "cell" else partial(from_text, parameter)
                found[called] = tuple(read(word) for word in words)
        except VolfrepError as error:
            raise VolfrepError(f"{name}: {error}") from error
        if found[called] == ():
            raise VolfrepError(f"{name} has no values: write them as 6, 8, 10 or as 6 to 10 in 5.")
    return found


def study_of(obj: App.DocumentObject) -> Study:
    """The study that the object's properties stand for.

    Raises:
        VolfrepError: they make no sense, or there is no infill.
    """
    from volfrep.io.solid import check_solid
    from volfrep.studies.study import Front, Study

    infill = obj.Infill
    if not is_infill(infill):
        raise VolfrepError("There is nothing to vary: choose a lattice infill as Infill.")
    vary = variations(infill, obj.Vary)
    spec, solid = infill.Proxy.read(infill)
    goals = {"forecast.mass_g": "least"}
    goals |= {} if spec.is_graded else {"properties.E100": "most"}
    return Study(
        parts=(check_solid(solid, infill.Base.Label),),
        vary=vary,
        fixed=_fixed(infill, vary),
        do=_actions(spec.is_graded, obj.Fill),
        front=Front(goals),
        material=material_of(infill),
    )


def _fixed(infill: App.DocumentObject, vary: Iterable[str]) -> dict[str, Any]:
    """The values that an infill gives to all designs, by the names of parameters."""
    values, target = values_in_effect(infill)
    if target is not None:
        values.pop("strut_radius")
        is_stiffness = target.aim == "stiffness"
        values[target.aim] = stiffness_text(target) if is_stiffness else target.value
    return {
        name: value
        for name, value in values.items()
        if value is not None and name not in vary and name not in _OF_THE_DOCUMENT
    }


def _actions(is_graded: bool, is_filled: bool) -> tuple[str, ...]:
    """What is done with every design; what is graded has no one stiffness."""
    known = ("forecast",) if is_graded else ("forecast", "properties")
    return (*known, "fill") if is_filled else known


def run_study(obj: App.DocumentObject) -> bool:
    """Do what is missing of a study, and note its table; False where the user has cancelled it.

    Raises:
        VolfrepError: the study makes no sense; the last table stays.
    """
    require_engine()
    from volfrep.studies.running.executors import state_text
    from volfrep.studies.sweep import sweep

    study, folder = study_of(obj), _folder(obj)
    python = _python(python_executable(), engine_folders())
    if python is None:
        App.Console.PrintMessage(report_line(obj.Label, IN_TURN))
    try:
        made = run_job(
            job_title("Studying {label}", obj.Infill),
            sweep,
            study,
            folder,
            workers=1 if python is None else None,
            interpreter=python,
            words=partial(state_text, text=_words()),
        )
    except Cancelled:
        obj.Status = CANCELLED
        App.Console.PrintMessage(report_line(obj.Label, CANCELLED))
        return False
    failed = dict.fromkeys(text for text in made.table.column("error") if text)
    obj.Refused = [f"{count} x {text}" for text, count in made.refused.items()]
    obj.Refused += [*failed, *made.damaged]
    obj.Designs = made.count("done")
    obj.Folder = str(made.page.parent)
    obj.Table = json.dumps(
        {
            "columns": made.table.columns,
            "rows": made.table.rows,
            "varied": list(study.varied),
            "front": list(made.front),
            "in_mpa": study.material is not None,
        }
    )
    obj.Status = f"{obj.Designs} designs of {obj.Infill.Label}"
    for sentence in obj.Refused:
        App.Console.PrintWarning(report_line(obj.Label, sentence))
    return True


def designs_of_study(obj: App.DocumentObject) -> list[dict[str, Any]]:
    """The designs of the last run, each with its figures by name, and ``chosen``."""
    if not obj.Table:
        return []
    table = json.loads(obj.Table)
    rows = [dict(zip(table["columns"], row, strict=True)) for row in table["rows"]]
    return [{**row, "chosen": row["key"] in table["front"]} for row in rows]


def varied_of_study(obj: App.DocumentObject) -> list[str]:
    """The names of the parameters that varied in the last run."""
    return list(json.loads(obj.Table)["varied"]) if obj.Table else []


def unit_of_moduli(obj: App.DocumentObject) -> str:
    """What the moduli of the last run are in: MPa, or the solid's; empty where nobody knows."""
    units = {True: "MPa", False: OF_THE_SOLID, None: ""}
    return units[json.loads(obj.Table).get("in_mpa") if obj.Table else None]


def design_spec(obj: App.DocumentObject, key: str) -> LatticeSpec:
    """The lattice of one of a study's designs.

    Args:
        obj: a design study.
        key: of one of its designs.

    Raises:
        VolfrepError: there is no such design, or its values make no sense.
    """
    from volfrep.studies.designs import specified

    varied = {name: _row(obj, key)[name] for name in varied_of_study(obj)}
    values = {**_fixed(obj.Infill, varied), **varied}
    return specified(values, material_of(obj.Infill))


def _row(obj: App.DocumentObject, key: str) -> dict[str, Any]:
    rows = {row["key"]: row for row in designs_of_study(obj)}
    if key not in rows:
        raise VolfrepError(f"The study has no design '{key}'.")
    return rows[key]


def parameter_of(name: str) -> Parameter:
    """The parameter that varies under a name of a study."""
    return BY_NAME[{aim: name for name, aim in _AIMED.items()}.get(name, name)]


def apply_design(obj: App.DocumentObject, key: str) -> bool:
    """Give a design's values to the infill, and compute it; whether that went well.

    Args:
        obj: a design study.
        key: of one of its designs.

    Raises:
        VolfrepError: there is no such design, or the infill has gone.
    """
    row, infill = _row(obj, key), obj.Infill
    if not is_infill(infill):
        raise VolfrepError("The infill of this study has gone: choose another one as Infill.")
    for name in varied_of_study(obj):
        parameter, value = parameter_of(name), row[name]
        if parameter.kind == "choice":
            value = str(value).capitalize()
        set_value(infill, parameter.property_name, value)
    return bool(infill.Proxy.update(infill))


@cache
def _python(executable: str, folders: tuple[str, ...]) -> Program | None:
    """The interpreter that goes with this FreeCAD; None where it cannot run the engine."""
    from volfrep.process.worker import Program
    from volfrep.studies.running.child import runs_engine

    python = Program((executable,), folders)
    return python if runs_engine(python) else None


def _words() -> str:
    """How far a study is, for the window, as `state_text` takes it."""
    return str(translate("VolfrepProgress", "{done} of {runs} runs, about {time} left"))


def _cell(word: str) -> str:
    """The library's name of a cell, whatever its case."""
    for name in LIBRARY:
        if name.lower() == word.lower():
            return name
    raise VolfrepError(f"There is no cell '{word}' in the library: choose {', '.join(LIBRARY)}.")


def _folder(obj: App.DocumentObject) -> Path:
    """Where the records of a study lie: with the user's data, one folder a study."""
    name = hashlib.blake2b(f"{obj.Document.Uid}{obj.Name}".encode(), digest_size=8).hexdigest()
    return Path(App.getUserAppDataDir()) / "VOLFREP" / "studies" / name
