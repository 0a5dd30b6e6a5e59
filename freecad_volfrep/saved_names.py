# SPDX-License-Identifier: LGPL-2.1-or-later
"""The names by which documents find our classes, however the workbench is installed.

A document names the class of each object by module. The workbench is the package
`freecad_volfrep` in a checkout and `freecad.volfrep` as installed from the index, and documents of
either open in both: the name that is not the package's own is a stand-in, which imports the real
module when something is asked of it. What is saved names `freecad.volfrep`.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import Any

#: Names of the package: the one that is saved first, then that of documents before 0.1.0.
PACKAGES = ("freecad.volfrep", "freecad_volfrep")
#: Modules of it that documents name; the package itself is for scripts.
_MODULES = ("", ".features", ".gui", ".gui.view_provider")


def saved_module(name: str) -> str:
    """The module that documents name for a class, from its name below the package."""
    return f"{PACKAGES[0]}.{name}"


def register_names() -> None:
    """Make every name known to Python's imports; does nothing the second time."""
    for package in PACKAGES:
        for module in _MODULES:
            if package != __package__:
                sys.modules.setdefault(package + module, _StandIn(package, module))


class SavesNothing:
    """A proxy of which a document keeps the class alone: all else is in the properties."""

    def dumps(self) -> None:
        """Nothing to save beside the properties."""

    def loads(self, state: Any) -> None:
        """Nothing to restore."""

    __getstate__ = dumps  # FreeCAD 0.20
    __setstate__ = loads


class _StandIn(ModuleType):
    """A module that has what another one has."""

    def __init__(self, package: str, module: str) -> None:
        super().__init__(package + module, "A stand-in, see `saved_names`.")
        self._real = f"{__package__}{module}"
        self.__path__: list[str] = []

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(import_module(self._real), name)
