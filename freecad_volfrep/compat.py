# SPDX-License-Identifier: LGPL-2.1-or-later
"""What differs between FreeCAD versions: the only place that looks at the version."""

from __future__ import annotations

import importlib.util
import sys
from importlib.machinery import PathFinder
from pathlib import Path

import FreeCAD as App

#: mm/s2
STANDARD_GRAVITY = 9806.65
#: 0 degrees C in K, and 1 W in FreeCAD's own unit of power, kg mm2/s3.
ZERO_CELSIUS, OWN_WATT = 273.15, 1e6


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


def in_unit(value: float | App.Units.Quantity, unit: str) -> float:
    """A property's value in a unit; FreeCAD 0.20 has mere numbers of N, MPa and mm there."""
    return float(value.getValueAs(unit).Value) if hasattr(value, "getValueAs") else float(value)


def set_in_unit(obj: App.DocumentObject, name: str, value: float, unit: str) -> None:
    """Set a property to a value in a unit, which is a mere number of it in FreeCAD 0.20."""
    is_number = isinstance(getattr(obj, name), float)
    setattr(obj, name, value if is_number else App.Units.Quantity(f"{value!r} {unit}"))


def celsius(value: float | App.Units.Quantity) -> float:
    """A temperature's value, which FreeCAD has in K, in degrees C."""
    return round(in_unit(value, "K") - ZERO_CELSIUS, 9)


def set_celsius(obj: App.DocumentObject, name: str, value: float) -> None:
    """Set a temperature to degrees C."""
    set_in_unit(obj, name, value + ZERO_CELSIUS, "K")


def watts(value: float | App.Units.Quantity) -> float:
    """The value of a heat flow in W; FreeCAD 0.20 has mere numbers of its own unit of power."""
    return in_unit(value, "W") / (OWN_WATT if isinstance(value, float) else 1.0)


def set_watts(obj: App.DocumentObject, name: str, value: float) -> None:
    """Set a heat flow to a value in W."""
    own = OWN_WATT if isinstance(getattr(obj, name), float) else 1.0
    set_in_unit(obj, name, value * own, "W")


def prescribed(constraint: App.DocumentObject, axis: str) -> float | None:
    """The displacement, mm, that a FEM constraint prescribes along x, y or z; None where free."""
    return _prescribed(constraint, axis, f"{axis}Displacement", "mm")


def prescribed_turn(constraint: App.DocumentObject, axis: str) -> float | None:
    """The rotation, degrees, that a FEM constraint prescribes about an axis; None where free."""
    return _prescribed(constraint, f"rot{axis}", f"{axis}Rotation", "deg")


def _prescribed(
    constraint: App.DocumentObject, direction: str, name: str, unit: str
) -> float | None:
    if getattr(constraint, f"{direction}Fix", False):  # FreeCAD 0.20
        return 0.0
    if getattr(constraint, f"{direction}Free"):
        return None
    return in_unit(getattr(constraint, name), unit)


def gravity_of(constraint: App.DocumentObject) -> App.Vector:
    """What a FEM constraint of self-weight pulls with, mm/s2; zero where it has no direction."""
    if hasattr(constraint, "GravityDirection"):
        direction = App.Vector(constraint.GravityDirection)
        size = in_unit(constraint.GravityAcceleration, "mm/s^2")
    else:  # FreeCAD 0.20
        direction = App.Vector(constraint.Gravity_x, constraint.Gravity_y, constraint.Gravity_z)
        size = STANDARD_GRAVITY
    return direction.normalize() * size if direction.Length else direction
