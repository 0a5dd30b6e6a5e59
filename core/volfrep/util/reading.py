# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one door through which files of the user's are read: regular ones, of a size, text in UTF-8.

What comes through it is kept from being written over (`files.keeping_inputs`).
"""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path
from types import ModuleType
from typing import Any

from .errors import VolfrepError
from .files import note_input
from .packages import package

#: Bytes of the largest text with entries (a specification, a load file) that is read.
LARGEST = 1_000_000


def regular_file(path: str | os.PathLike[str], what: str, most: int) -> Path:
    """The path, once it is clear that a regular file of at most so many bytes is there.

    For readers that take a path, or go through a file line by line; a pipe or a device, which may
    never end, is refused before it is opened.

    Args:
        path: of the file.
        what: it should be, in the singular, for the sentences and for what may not be written over.
        most: bytes that it may have.

    Raises:
        VolfrepError: it is not there, closed to us, no regular file, or too large.
    """
    path = Path(path)
    _size(path, what, most)
    note_input(path, what)
    return path


def read_bytes(path: str | os.PathLike[str], what: str, most: int) -> bytes:
    """All of a regular file; arguments and errors as of `regular_file`."""
    path = regular_file(path, what, most)
    return own_bytes(path, what, most)


def own_bytes(path: Path, what: str, most: int) -> bytes:
    """As `read_bytes`, of a file that this program wrote for itself, and may write again."""
    size = _size(path, what, most)
    try:
        with path.open("rb") as file:
            data = file.read(size + 1)
    except OSError as error:
        raise _unread(path, what, str(error.strerror or error)) from error
    if len(data) > size:
        raise _unread(path, what, "it grows while it is read")
    return data


def read_text(path: str | os.PathLike[str], what: str, most: int = LARGEST) -> str:
    """The text of a file in UTF-8, with or without a byte order mark.

    Raises:
        VolfrepError: as `regular_file`; or it is no such text.
    """
    return as_text(read_bytes(path, what, most), path, what)


def as_text(data: bytes, path: str | os.PathLike[str], what: str) -> str:
    """The text that a file's bytes are; line ends as they are, for JSON, TOML and Python's splits.

    Raises:
        VolfrepError: they are none in UTF-8.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise VolfrepError(f"The {what} '{path}' is no text in UTF-8: save it as one.") from error


def read_json(path: str | os.PathLike[str], what: str, most: int = LARGEST) -> Any:
    """What a JSON file holds.

    Raises:
        VolfrepError: as `read_text`; or it is no JSON.
    """
    return parsed_json(read_text(path, what, most), path, what)


def parsed_json(text: str, path: str | os.PathLike[str], what: str) -> Any:
    """What a text in JSON holds; errors as of `read_json`."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise VolfrepError(f"The {what} '{path}' is not valid JSON: {error}.") from error


def read_toml(path: str | os.PathLike[str], what: str) -> dict[str, Any]:
    """The entries of a TOML file.

    Raises:
        VolfrepError: as `read_text`; or it is no TOML.
    """
    library = toml_library(f"{what}s")
    text = read_text(path, what)
    try:
        # A carriage return before a line's end is TOML, but not for every reader of it.
        return dict(library.loads(text.replace("\r\n", "\n")))
    except (library.TOMLDecodeError, RecursionError) as error:
        raise VolfrepError(f"The {what} '{path}' is no TOML: {error}.") from error


def toml_library(what: str) -> ModuleType:
    """Python's own reader of TOML, or the package that Python 3.10 needs in its place.

    Args:
        what: is to be read, in the plural, for the sentence.

    Raises:
        VolfrepError: there is neither.
    """
    try:
        import tomllib
    except ModuleNotFoundError:  # Python 3.10
        library: ModuleType = package("tomli", f"To read {what} this Python")
        return library
    return tomllib


def _size(path: Path, what: str, most: int) -> int:
    try:
        status = path.stat()
    except (OSError, ValueError) as error:  # a null byte in the name is the latter
        raise _unread(path, what, str(getattr(error, "strerror", None) or error)) from error
    if stat.S_ISDIR(status.st_mode):
        raise _unread(path, what, "it is not a file but a folder")
    if not stat.S_ISREG(status.st_mode):
        raise _unread(path, what, "it is not a file but a pipe or a device")
    if not os.access(path, os.R_OK):
        raise _unread(path, what, "permission denied")
    if status.st_size > most:
        raise VolfrepError(
            f"The {what} '{path}' has {_size_text(status.st_size)}, and at most {_size_text(most)} "
            "are read: give a smaller one."
        )
    return status.st_size


def _size_text(size: int) -> str:
    return f"{size:,} bytes" if size < 10_000_000 else f"{size / 1e6:,.0f} MB"


def _unread(path: Path, what: str, why: str) -> VolfrepError:
    return VolfrepError(f"Cannot read the {what} '{path}': {why}.")
