# SPDX-License-Identifier: LGPL-2.1-or-later
"""What differs between FreeCAD versions: the only place that looks at the version."""

from __future__ import annotations

import importlib.util
import sys
from importlib.machinery import PathFinder
from pathlib import Path

import FreeCAD as App


def version() -> tuple[int, int]:
    """FreeCAD's version as numbers: (0, 20), (1, 0), (26, 3)..."""
    major, minor = App.Version()[:2]
    return int(major), int(minor)


def package_folder() -> Path:
    """The user's folder in which this FreeCAD looks for extra Python packages."""
    folder = Path(App.getUserAppDataDir()) / "AdditionalPythonPackages"
    if version() >= (1, 0):
        folder /= f"py{sys.version_info.major}{sys.version_info.minor}"
    return folder


def repair_lazy_loader() -> None:
    """Make scikit-image importable inside FreeCAD; does nothing where it already is.

    FreeCAD has a module of its own called ``lazy_loader``, found before the package of that name
    that scikit-image 0.20 and later needs. FreeCAD needs its own too, so the missing functions
    are added to it.
    """
    if importlib.util.find_spec("lazy_loader") is None:
        return
    import lazy_loader

    if hasattr(lazy_loader, "attach_stub") or lazy_loader.__file__ is None:
        return
    shadowing = Path(lazy_loader.__file__).resolve().parent.parent
    folders = [folder for folder in sys.path if Path(folder).resolve() != shadowing]
    spec = PathFinder.find_spec("lazy_loader", folders)
    if spec is None or spec.loader is None:
        return  # either scikit-image is older than 0.20 or it is missing: see deps
    package = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(package)
    for name in package.__all__:
        setattr(lazy_loader, name, getattr(package, name))
