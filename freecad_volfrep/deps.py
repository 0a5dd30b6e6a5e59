# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Python packages of the engine: which are missing, and how to get them for this FreeCAD."""

from __future__ import annotations

import importlib
import importlib.machinery
import importlib.metadata
import importlib.util
import os
import shlex
import sys
from pathlib import Path

import FreeCAD as App

from .compat import package_folder

#: Name to import by, name to install by.
PACKAGES = {
    "numpy": "numpy",
    "scipy": "scipy",
    "skimage": "scikit-image",
    "trimesh": "trimesh",
    "manifold3d": "manifold3d",
}
#: What is not on FreeCAD's list of allowed packages: only the user's own command installs it, and
#: the engine does without where it can (`volfrep.util.manifold`).
OPTIONAL = ("manifold3d",)
#: FreeCAD and its other add-ons use these too: their version must stay what it is.
SHARED = ("numpy", "scipy")


def missing_packages() -> list[str]:
    """Names to install by of the packages without which nothing is computed."""
    return [package for package in _missing() if package not in OPTIONAL]


def missing_optional() -> list[str]:
    """Names to install by of the packages that only some jobs need."""
    return [package for package in _missing() if package in OPTIONAL]


def _missing() -> list[str]:
    """What this FreeCAD cannot import."""
    return [
        package
        for module, package in PACKAGES.items()
        if module not in sys.modules and importlib.util.find_spec(module) is None
    ]


def python_executable() -> str:
    """The Python interpreter that belongs to this FreeCAD (`sys.executable` is FreeCAD itself)."""
    home = Path(App.getHomePath())
    if os.name == "nt":
        candidates = [home / "bin" / "python.exe"]
    else:
        name = f"python{sys.version_info.major}.{sys.version_info.minor}"
        prefixes = [Path(sys.prefix), Path(sys.base_prefix), home, home / "usr"]
        candidates = [prefix / "bin" / name for prefix in prefixes]
    for candidate in candidates:
        if candidate.is_file():
            return str(candidate)
    return candidates[0].name


def engine_folders() -> tuple[str, ...]:
    """The folders that hold the engine and its packages, in the order in which they are found.

    FreeCAD's own folders are not among them: they hide packages of the same name.
    """
    found = (find_home(module) for module in ("volfrep.util", *PACKAGES))
    return tuple(dict.fromkeys(folder for folder in found if folder is not None))


def find_home(module: str) -> str | None:
    """The folder from which Python imports a module by its whole name; None where it cannot."""
    spec = importlib.util.find_spec(module)
    if spec is None or spec.origin is None:
        return None
    return str(Path(spec.origin).parents[module.count(".") + bool(spec.submodule_search_locations)])


def install_arguments(packages: list[str]) -> list[str]:
    """The program and its arguments that install the packages where this FreeCAD finds them."""
    pins = [f"{name}=={importlib.metadata.version(name)}" for name in SHARED if _installed(name)]
    wanted = [name for name in packages if not _installed(name)]
    target = str(package_folder())
    return [python_executable(), "-m", "pip", "install", "--target", target, *wanted, *pins]


def install_command(packages: list[str]) -> str:
    """The same as a command for a shell."""
    arguments = install_arguments(packages)
    if os.name == "nt":
        return " ".join(f'"{part}"' if " " in part else part for part in arguments)
    return shlex.join(arguments)


def explain_missing(packages: list[str]) -> str:
    """One sentence for the user: what is missing and the command that installs it."""
    return (
        f"VOLFREP needs the Python packages {', '.join(packages)}: install them for this FreeCAD "
        f"with the command  {install_command(packages)}  and restart FreeCAD."
    )


def find_installed(packages: list[str]) -> tuple[list[str], bool]:
    """Look again after an installation.

    Returns:
        What of the packages is missing yet, and whether FreeCAD must be restarted to find the
        rest: it looks into the folder only where that was there at its start.
    """
    folder = str(package_folder())
    importlib.invalidate_caches()
    modules = [module for module, package in PACKAGES.items() if package in packages]
    find = importlib.machinery.PathFinder.find_spec
    missing = [PACKAGES[name] for name in modules if find(name, [*sys.path, folder]) is None]
    return missing, folder not in sys.path


def _installed(name: str) -> bool:
    try:
        importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return False
    return True
