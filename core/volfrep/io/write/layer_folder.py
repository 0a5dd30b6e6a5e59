# SPDX-License-Identifier: LGPL-2.1-or-later
"""A folder of layers: what the last run wrote is replaced by the next one, and nothing else."""

from __future__ import annotations

import json
import os
import re
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ...util.errors import VolfrepError
from ...util.files import not_written, refuse_input, replacing
from ...util.reading import own_bytes

#: What tells a folder of layers from any other, and says which files are its own.
FIGURES = "layers.json"
#: Bytes that it may have.
_MOST = 500_000_000
#: How files of layers are called: nothing else is ever taken away.
_LAYER = re.compile(r"layer_\d{6,}\.(png|svg)|part\.cli")
#: Folders of runs that were killed.
_UNFINISHED = re.compile(r"\.volfrep-[0-9a-f]{8}\.part")


@contextmanager
def replacing_layers(path: str | os.PathLike[str]) -> Iterator[tuple[Path, dict[str, Any]]]:
    """A folder to fill with layers, which go into the target only when the block succeeds.

    It is made in the target; after an error or an interruption it is removed, and layers that were
    there stay. The table of the last run says which files it wrote: these are taken away, before
    the new ones come, and a run that is killed in between leaves a table of both. Files of anybody
    else are neither touched nor written over.

    Args:
        path: of the target: nothing yet, an empty folder, or one that holds layers.

    Yields:
        the folder, and a table to fill in, whose ``layers`` name the ``file`` of each.

    Raises:
        VolfrepError: naming the target and why it cannot be written.
    """
    target = Path(path)
    try:
        if not target.resolve().parent.is_dir():
            raise VolfrepError(
                f"Cannot write '{target}': there is no folder '{target.resolve().parent}'."
            )
        if target.exists() and not target.is_dir():
            raise VolfrepError(f"Cannot write '{target}': it exists and is not a folder.")
        is_new = not target.exists()
        old = set() if is_new else _list_written(target)
        target.mkdir(exist_ok=True)
        part = target / f".volfrep-{secrets.token_hex(4)}.part"
        try:
            part.mkdir()
            figures: dict[str, Any] = {}
            yield part, figures
            _exchange(target, part, old, figures)
        finally:
            shutil.rmtree(part, ignore_errors=True)
            if is_new and not any(target.iterdir()):
                target.rmdir()
    except OSError as error:
        raise not_written(target, error) from error


def _exchange(target: Path, part: Path, old: set[str], figures: dict[str, Any]) -> None:
    new = {one["file"] for one in figures["layers"]}
    for name in sorted(new):
        if name not in old and os.path.lexists(target / name):
            raise VolfrepError(
                f"Cannot write '{target / name}': the last run did not write the file that is "
                "there; move it away, or name a new folder."
            )
    for name in sorted(old | new | {FIGURES}):
        refuse_input(target / name)
    if old:  # killed from here on, the next run knows what is whose
        _write_table(target, {**figures, "unfinished": sorted(old | new)})
    for name in sorted(old):
        (target / name).unlink(missing_ok=True)
    for name in sorted(new):
        os.replace(part / name, target / name)
    _write_table(target, figures)
    for left in target.iterdir():
        if left != part and _UNFINISHED.fullmatch(left.name) and left.is_dir():
            shutil.rmtree(left, ignore_errors=True)  # of a run that was killed


def _write_table(target: Path, figures: dict[str, Any]) -> None:
    with replacing(target / FIGURES) as file:
        file.write(json.dumps(figures, indent=1).encode() + b"\n")


def _list_written(target: Path) -> set[str]:
    """The files of layers that the last run wrote, without its table.

    Raises:
        VolfrepError: the folder holds other files, and no table that says which are its own.
    """
    table = target / FIGURES
    if not table.exists():
        if all(_UNFINISHED.fullmatch(one.name) for one in target.iterdir()):
            return set()
        raise VolfrepError(
            f"Cannot write '{target}': the folder holds other files; name a new one."
        )
    try:
        found = json.loads(own_bytes(table, "table of layers", _MOST))
        names = {str(one["file"]) for one in found["layers"]} | set(found.get("unfinished", ()))
        if found["program"] != "VOLFREP":
            raise ValueError
    except VolfrepError:
        raise
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise VolfrepError(
            f"Cannot write '{target}': its '{FIGURES}' does not say which files are layers, so "
            "none can be taken away; name a new folder."
        ) from error
    return {name for name in names if isinstance(name, str) and _LAYER.fullmatch(name)}
