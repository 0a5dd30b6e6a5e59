# SPDX-License-Identifier: LGPL-2.1-or-later
"""The folder of a study: a record for each design, and the parts it is made of.

A record is JSON, named by the design's key, and written whole or not at all. What was done for one
study counts for every other one in the same folder.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..io.solid import Solid
from ..util.errors import VolfrepError
from ..util.files import replacing
from .actions import ACTIONS, Asked, Figure

RECORDS, PARTS = "records", "parts"


@dataclass
class Record:
    """What is known of a design.

    Attributes:
        key: of the design.
        version: of the engine.
        part: the part's name and content.
        values: of its parameters, as plain JSON values.
        results: figures by the names of actions.
        settings: what these figures hang on beside the design, by the same names.
        errors: of actions that failed: a sentence each.
        notes: sentences for the user, such as a fill's warnings, by the same names.
        seconds: that each action took.
    """

    key: str
    version: str
    part: dict[str, str]
    values: dict[str, Any]
    results: dict[str, dict[str, Figure]] = field(default_factory=dict)
    settings: dict[str, Any] = field(default_factory=dict)
    errors: dict[str, str] = field(default_factory=dict)
    notes: dict[str, list[str]] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)

    def missing(self, actions: tuple[str, ...], asked: Asked, retry: bool) -> list[str]:
        """The actions that are still to be done, in their order.

        Figures of other settings, or whose file is gone, do not count; what failed counts as done
        unless `retry`.
        """
        return [
            name
            for name in ACTIONS
            if name in actions
            and not self._has(name, asked)
            and (retry or name not in self.errors or not self._same(name, asked))
        ]

    def _has(self, name: str, asked: Asked) -> bool:
        file = ACTIONS[name].file(asked)
        there = file is None or (asked.folder / file[0] / f"{self.key}{file[1]}").is_file()
        return name in self.results and self._same(name, asked) and there

    def _same(self, name: str, asked: Asked) -> bool:
        return bool(self.settings.get(name) == _json(ACTIONS[name].settings(asked)))

    def keep(self, name: str, asked: Asked, seconds: float) -> None:
        """Note what an action's outcome hangs on, and how long it took."""
        self.settings[name] = _json(ACTIONS[name].settings(asked))
        self.seconds[name] = round(seconds, 3)


def record_path(folder: Path, key: str) -> Path:
    """Where the record of a design is."""
    return folder / RECORDS / f"{key}.json"


def read_record(folder: Path, key: str) -> Record | None:
    """The record of a design; None where there is none.

    Raises:
        VolfrepError: a file of that name is no record.
    """
    path = record_path(folder, key)
    try:
        return Record(**json.loads(path.read_text(encoding="utf-8")))
    except FileNotFoundError:
        return None
    except (OSError, ValueError, TypeError) as error:
        raise VolfrepError(
            f"'{path}' is no record of a run ({error}): move it away, and the run is done anew."
        ) from error


def write_record(folder: Path, record: Record) -> None:
    """Write a record, whole or not at all.

    Raises:
        VolfrepError: the folder is closed to us, or full.
    """
    with replacing(record_path(folder, record.key)) as file:
        file.write(json.dumps(vars(record), indent=1).encode() + b"\n")


def prepare(folder: Path) -> None:
    """Make the folder of a study.

    Raises:
        VolfrepError: it cannot be made.
    """
    try:
        for name in (RECORDS, PARTS):
            (folder / name).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise VolfrepError(f"The folder '{folder}' cannot be made: {error.strerror}.") from error


def keep_part(folder: Path, content: str, solid: Solid) -> None:
    """Write a proved solid beside the records, so that no run reads and repairs it again."""
    path = folder / PARTS / f"{content}.npz"
    if path.is_file():
        return
    notes = np.array(solid.notes, str)
    with replacing(path) as file:
        np.savez(file, vertices=solid.vertices, triangles=solid.triangles, notes=notes)


def kept_part(folder: Path, content: str) -> Solid:
    """The proved solid that `keep_part` wrote.

    Raises:
        VolfrepError: it is not there, or cannot be read.
    """
    path = folder / PARTS / f"{content}.npz"
    try:
        with np.load(path) as data:
            notes = tuple(str(note) for note in data["notes"])
            return Solid(data["vertices"], data["triangles"], (), notes)
    except (OSError, ValueError, KeyError) as error:
        raise VolfrepError(
            f"The study's part '{path}' cannot be read ({error}): workers must see the study's "
            "folder under the same name."
        ) from error


def _json(value: Any) -> Any:
    """As it will come back from JSON."""
    return json.loads(json.dumps(value))
