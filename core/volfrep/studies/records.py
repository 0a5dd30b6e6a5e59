# SPDX-License-Identifier: LGPL-2.1-or-later
"""The folder of a study: a record for each design, and the parts it is made of.

A record is JSON, named by the design's key, and written whole or not at all. What was done for one
study counts for every other one in the same folder.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from ..io.solid import Solid
from ..util.content import content_of
from ..util.errors import VolfrepError
from ..util.files import replacing
from ..util.reading import own_bytes
from .actions import ACTIONS, Asked, Figure

RECORDS, PARTS = "records", "parts"
#: Bytes of the largest record that is read.
LARGEST = 20_000_000


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
    """The record of a design; None where there is none, or a damaged one that is to be done anew.

    Raises:
        VolfrepError: something of that name is no file, or closed to us.
    """
    path = record_path(folder, key)
    return None if damage_of(path) else _read(path)


def damage_of(path: Path) -> str:
    """What is wrong with a record, as a clause; empty for nothing, or where there is none.

    Raises:
        VolfrepError: as `read_record`.
    """
    try:
        _read(path)
    except _DamageError as error:
        return str(error)
    return ""


class _DamageError(Exception):
    """What a record's file is not."""


def _read(path: Path) -> Record | None:
    if not path.exists():
        return None
    data = own_bytes(path, "record", LARGEST)
    try:
        found = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise _DamageError(f"it is no JSON: {error}") from error
    if not isinstance(found, dict):
        raise _DamageError("it is no object")
    wrong = {one.name for one in fields(Record)} ^ found.keys()
    if wrong:
        raise _DamageError(f"its entry '{min(wrong)}' is missing or unknown")
    for name, is_sound in _SOUND.items():
        if not is_sound(found[name]):
            raise _DamageError(f"its entry '{name}' is not what a run writes")
    if found["key"] != path.stem:
        raise _DamageError(f"it is of the design '{found['key']}'")
    return Record(**found)


def _table_of(kind: Callable[[Any], bool]) -> Callable[[Any], bool]:
    """Whether a value is a table whose values are all of a kind."""
    return lambda value: isinstance(value, dict) and all(map(kind, value.values()))


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def _is_seconds(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _is_figure(value: Any) -> bool:
    return value is None or isinstance(value, (int, float, str, bool))


#: What makes an entry one that `write_record` wrote.
_SOUND: dict[str, Callable[[Any], bool]] = {
    "key": _is_text,
    "version": _is_text,
    "part": _table_of(_is_text),
    "values": lambda value: isinstance(value, dict),
    "results": lambda value: (
        _table_of(_table_of(_is_figure))(value) and value.keys() <= ACTIONS.keys()
    ),
    "settings": lambda value: isinstance(value, dict),
    "errors": _table_of(_is_text),
    "notes": _table_of(lambda value: isinstance(value, list) and all(map(_is_text, value))),
    "seconds": _table_of(_is_seconds),
}


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
        with suppress(VolfrepError):  # a damaged one is written anew
            kept = kept_part(folder, content)
            if content_of(kept.vertices, kept.triangles).hex() == content:
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
    except (OSError, ValueError, KeyError, EOFError, BadZipFile, zlib.error) as error:
        raise VolfrepError(
            f"The study's part '{path}' cannot be read ({error}): workers must see the study's "
            "folder under the same name."
        ) from error


def _json(value: Any) -> Any:
    """As it will come back from JSON."""
    return json.loads(json.dumps(value))
