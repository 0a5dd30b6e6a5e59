# SPDX-License-Identifier: LGPL-2.1-or-later
"""TOML files: read whole, with one sentence for whatever keeps them from being read."""

from __future__ import annotations

import os
from pathlib import Path
from types import ModuleType
from typing import Any

from .errors import VolfrepError

#: Bytes of the largest file that is read.
LARGEST = 1_000_000


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
        try:
            import tomli as tomllib  # type: ignore[import-not-found, no-redef, unused-ignore]
        except ModuleNotFoundError as error:
            raise VolfrepError(
                f"{what.capitalize()} are read by Python 3.11 or later, or with the package tomli: "
                "run 'pip install tomli'."
            ) from error
    return tomllib


def read_toml(path: str | os.PathLike[str], what: str) -> dict[str, Any]:
    """The entries of a TOML file.

    Args:
        path: of the file.
        what: it should be, in the singular, for the sentences.

    Raises:
        VolfrepError: it cannot be read, is far too large, or is no TOML.
    """
    path = Path(path)
    library = toml_library(f"{what}s")
    try:
        with path.open("rb") as file:
            text = file.read(LARGEST + 1)
    except OSError as error:
        raise VolfrepError(f"{path} cannot be read: {error.strerror}.") from error
    if len(text) > LARGEST:
        raise VolfrepError(f"{path} has more than {LARGEST:,} bytes: that is no {what}.")
    try:
        return dict(library.loads(text.decode()))
    except UnicodeDecodeError as error:
        raise VolfrepError(f"{path} is no text in UTF-8.") from error
    except (library.TOMLDecodeError, RecursionError) as error:
        raise VolfrepError(f"{path} is no TOML: {error}.") from error
