# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can be done with a design: a row each of one table, read by all that speaks about studies.

What is behind a row is a function of the same name in `running.bench`.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..mechanics.materials import SolidMaterial
from ..output.form import suffixes
from ..reports.picture import drawing_library
from ..reports.processes import Process, find_process
from ..util.errors import VolfrepError

#: A figure of the table: a number, a word, a truth.
Figure = float | int | str | bool | None


@dataclass(frozen=True)
class Loads:
    """A load file.

    Attributes:
        path: where every worker sees it.
        content: all that it says, as text.
        material: of it, as plain JSON values.
    """

    path: Path
    content: str
    material: Mapping[str, Any]


@dataclass(frozen=True)
class Asked:
    """What the actions of a study take.

    Attributes:
        material: of the solid; None: figures in units of the solid's.
        process: of the print check.
        export: extension of the files.
        folder: of the study, for files.
        loads: what the part carries; None where nothing asks for it.
        goal: what is wanted of sized struts, as numbers by name.
    """

    material: SolidMaterial | None
    process: Process | None
    export: str
    folder: Path
    loads: Loads | None = None
    goal: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Action:
    """A row of the table.

    Attributes:
        name: as a study calls it.
        help: one phrase.
        meshed: whether it needs the filled part.
        settings: what of the asked its figures hang on, as plain JSON values.
        file: the folder and suffix of the file that it leaves, if it leaves one.
    """

    name: str
    help: str
    meshed: bool = True
    settings: Callable[[Asked], Any] = lambda asked: None
    file: Callable[[Asked], tuple[str, str] | None] = lambda asked: None


def _material(asked: Asked) -> Any:
    return None if asked.material is None else asked.material.as_dict()


def _process(asked: Asked) -> Any:
    return None if asked.process is None else dataclasses.asdict(asked.process)


def _loads(asked: Asked) -> Any:
    return None if asked.loads is None else [asked.loads.content, dict(asked.loads.material)]


def _goal(asked: Asked) -> Any:
    return [_loads(asked), dict(asked.goal)]


_ROWS = (
    Action("forecast", "mass, cells, triangles, time and memory, before any work",
           meshed=False),
    Action("properties", "stiffness, strength and conductivity of the endless lattice",
           meshed=False, settings=_material),
    Action("fill", "the part is made and measured"),
    Action("measure", "what a reader of its file sees: defects, angles, edges"),
    Action("print", "the print check against a process", settings=_process),
    Action("solve", "its struts and skin under the load cases: displacement, stress, buckling",
           settings=_loads),
    Action("size", "its struts sized for the load cases; what they come to", settings=_goal,
           file=lambda asked: ("sized", ".toml")),
    Action("export", "its file, in the study's folder",
           settings=lambda asked: asked.export, file=lambda asked: ("files", asked.export)),
    Action("picture", "a picture, cut open (needs pyvista)",
           file=lambda asked: ("pictures", ".png")),
)  # fmt: skip
#: The actions by their names, in the order in which they are done.
ACTIONS = {action.name: action for action in _ROWS}

#: Those that look at what the part carries.
CARRIED = ("solve", "size")


def check_actions(
    names: Sequence[str], process: str | None, export: str, loads: object = None
) -> None:
    """Refuse, before any work, actions that cannot be done.

    Raises:
        VolfrepError: there is none of a name, or what it needs is missing.
    """
    for name in names:
        if name not in ACTIONS:
            raise VolfrepError(f"There is no action '{name}': choose from {', '.join(ACTIONS)}.")
    if not names:
        raise VolfrepError(f"Nothing is to be done: choose from {', '.join(ACTIONS)}.")
    if "print" in names:
        if process is None:
            raise VolfrepError("The action 'print' needs a process, such as process = \"SLS\".")
        find_process(process)
    for name in CARRIED:
        if name in names and loads is None:
            raise VolfrepError(
                f"The action '{name}' needs what the part carries: loads = \"loads.toml\"."
            )
    if "export" in names and export.lower() not in suffixes():
        raise VolfrepError(
            f"Nothing is written as '{export}': choose {', '.join(sorted(suffixes()))}."
        )
    if "picture" in names:
        drawing_library()
