# SPDX-License-Identifier: LGPL-2.1-or-later
"""The one door to packages that a single feature needs, and what is said where one is missing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any

from .errors import VolfrepError

if TYPE_CHECKING:
    import pandas

#: What pip is asked for, where that is not the package's own name.
_BY_PIP = {"distributed": "volfrep[dask]"}


class MissingPackage(VolfrepError):
    """What was asked for needs a package that this Python does not have."""


def install_command(name: str) -> str:
    """What installs a package, as a command for a shell.

    >>> install_command("distributed")
    'pip install volfrep[dask]'
    """
    return f"pip install {_BY_PIP.get(name, name)}"


def package(name: str, purpose: str, command: str = "", then: str = "and start again") -> Any:
    """An optional package, imported.

    Args:
        name: of the package, or of a module of it.
        purpose: what needs it, as the subject of a sentence: "A table as a frame".
        command: installs it; "" for `install_command`.
        then: what to do beside that, as the end of the sentence: "or leave the limit out".

    Raises:
        MissingPackage: it is not there, or cannot be loaded.

    >>> package("no_such_package", "This example")
    Traceback (most recent call last):
    ...
    volfrep.util.packages.MissingPackage: This example needs the Python package no_such_package, \
which is not installed: install it with the command  pip install no_such_package  \
and start again.
    """
    root = name.partition(".")[0]
    try:
        return import_module(name)
    except ImportError as error:
        if not (isinstance(error, ModuleNotFoundError) and error.name == root):
            raise MissingPackage(
                f"{purpose} needs the Python package {root}, which cannot be loaded: {error}."
            ) from error
        raise MissingPackage(
            f"{purpose} needs the Python package {root}, which is not installed: install it with "
            f"the command  {command or install_command(root)}  {then}."
        ) from error


def make_frame(columns: Mapping[str, Any], index: Sequence[str] | None = None) -> pandas.DataFrame:
    """A frame of columns by name.

    Raises:
        MissingPackage: pandas is missing.
    """
    frame: pandas.DataFrame = package("pandas", "A table as a frame").DataFrame
    return frame(dict(columns), index=index)
