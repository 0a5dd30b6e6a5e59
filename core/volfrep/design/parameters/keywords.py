# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parameters of a call: what a script's author gives, as the fields of a `LatticeSpec`."""

from __future__ import annotations

import dataclasses
from typing import Any

from ...util.errors import VolfrepError
from ..spec import LatticeSpec
from ..spec_parts import first_radius
from ..target import AIMS, Target, read_stiffness
from ..walls import FORMULA, Wall, find_surface, surface_name

#: What of a `Wall` a parameter of a call, an option or an entry of a file says.
_WALL = {"wall_kind": "kind", "wall_thickness": "thickness", "wall_offset": "offset"}


def accepted() -> set[str]:
    """The names of a call's parameters: a `LatticeSpec`'s, with walls and targets as files say."""
    names = {field.name for field in dataclasses.fields(LatticeSpec)} - {"wall"}
    return names | set(AIMS) | set(_WALL) | {"wall_formula"}


def with_wall(parameters: dict[str, Any], spec: LatticeSpec | None) -> dict[str, Any]:
    """The parameters with a `Wall` in place of what describes one."""
    given = {_WALL[name]: value for name, value in parameters.items() if name in _WALL}
    rest = {name: value for name, value in parameters.items() if name not in _WALL}
    formula = rest.pop("wall_formula", None)
    if given:
        rest["wall"] = dataclasses.replace(Wall() if spec is None else spec.wall, **given)
    if formula is not None:
        cell = rest.get("cell", FORMULA)
        if not isinstance(cell, str) or surface_name(cell) != FORMULA:
            raise VolfrepError(f"A wall_formula is of the cell {FORMULA}, not of another one.")
        rest["cell"] = find_surface(FORMULA, formula)
    return rest


def with_target(
    parameters: dict[str, Any], spec: LatticeSpec | None, young: float
) -> dict[str, Any]:
    """The parameters with a `Target` in place of what one is given by."""
    given = [name for name in ("strut_radius", *AIMS, "target") if parameters.get(name) is not None]
    if len(given) > 1:
        raise VolfrepError(
            f"{', '.join(given[:-1])} and {given[-1]} each say how thick the struts are: give one "
            "of them."
        )
    rest = {name: value for name, value in parameters.items() if name not in AIMS}
    if given == ["strut_radius"] and spec is not None:
        rest["target"] = None
    if not given or given[0] not in AIMS:
        return rest
    aim = given[0]
    value = parameters[aim]
    rest["target"] = read_stiffness(value, young) if aim == "stiffness" else Target(aim, value)
    usual = spec or LatticeSpec()
    size, fillet = (parameters.get(n, getattr(usual, n)) for n in ("cell_size", "fillet"))
    rest["strut_radius"] = first_radius(size, fillet)
    return rest
