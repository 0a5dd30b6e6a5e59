# SPDX-License-Identifier: LGPL-2.1-or-later
"""The specification that the keywords of a call stand for."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

from ..design.cells import any_cell
from ..design.grading import Field
from ..design.parameters.field_keywords import with_fields
from ..design.parameters.keywords import (
    BAD_KINDS,
    FIELDS,
    KEYS,
    is_key,
    own_data,
    refuse_kind,
    refuse_unknown,
    spec_by_keys,
    with_current_names,
)
from ..design.spec import LatticeSpec
from ..design.spec_parts import first_radius
from ..design.target import AIMS, THICKNESSES, read_target
from ..design.tpms import FORMULA, TpmsSheet, find_surface, surface_name
from ..util.arguments import check_kind
from ..util.errors import VolfrepError
from ..util.types import Floats

#: What of a `Wall` a parameter of a call, an option or an entry of a file says.
_WALL = {"wall_kind": "kind", "wall_thickness": "thickness", "wall_offset": "offset"}


def specified(
    spec: LatticeSpec | None,
    parameters: dict[str, Any],
    material: str | None,
    box: Callable[[float], Floats] | None = None,
) -> LatticeSpec:
    """The specification with parameters of a call on top of it, as `fill` takes them.

    Args:
        spec: what they stand on top of; None for the defaults.
        parameters: by the names of `accepted`.
        material: as of `fill`.
        box: gives the (2, 3) box that functions of points are sampled in, of a cell size, mm;
            None for no part.

    Raises:
        VolfrepError: there is no such parameter, or they make no sense.
    """
    check_kind("spec", spec, (LatticeSpec, type(None)), "a LatticeSpec")
    parameters = with_current_names(parameters)
    refuse_unknown(parameters, accepted())
    young = 1.0
    if material is not None:
        from ..mechanics.materials import find_material

        solid = find_material(material)
        young = solid.young
        parameters = {"density": solid.density, **parameters}
    usual = LatticeSpec.cell_size if spec is None else spec.cell_size
    parameters = _with_density_field(own_data(parameters, box, usual), spec)
    plain = set(AIMS) | set(_WALL) | {"wall_formula"}
    try:
        if any(name not in plain and is_key(name, parameters[name]) for name in parameters):
            return spec_by_keys(spec, parameters, young)
        parameters = _with_sheet(_with_target(parameters, spec, young), spec)
        if spec is None:
            return LatticeSpec(**parameters)
        return dataclasses.replace(spec, **parameters) if parameters else spec
    except VolfrepError:
        raise
    except BAD_KINDS as error:
        raise refuse_kind(parameters, error) from error


def accepted() -> set[str]:
    """The names of a call's parameters: the keys of a file, and the fields of a `LatticeSpec`."""
    return KEYS | FIELDS


def _with_sheet(parameters: dict[str, Any], spec: LatticeSpec | None) -> dict[str, Any]:
    """The parameters with a `Wall` in place of what describes one."""
    given = {_WALL[name]: value for name, value in parameters.items() if name in _WALL}
    rest = {name: value for name, value in parameters.items() if name not in _WALL}
    formula = rest.pop("wall_formula", None)
    if given:
        rest["wall"] = dataclasses.replace(TpmsSheet() if spec is None else spec.wall, **given)
    if formula is not None:
        cell = rest.get("cell", FORMULA)
        if not isinstance(cell, str) or surface_name(cell) != FORMULA:
            raise VolfrepError(f"A wall_formula is of the cell {FORMULA}, not of another one.")
        rest["cell"] = find_surface(FORMULA, formula)
    return rest


def _with_density_field(parameters: dict[str, Any], spec: LatticeSpec | None) -> dict[str, Any]:
    """The parameters with the radii, in place of a field of densities, that give them."""
    field = parameters.get("relative_density")
    if not isinstance(field, Field):
        return parameters
    from ..jobs.kinds import kind_of_cell
    from ..jobs.kinds.kind import LatticeKind

    rest = {name: value for name, value in parameters.items() if name != "relative_density"}
    if rest.get("strut_radius") is not None:
        raise VolfrepError("'relative_density' and 'strut_radius' each say how thick struts are.")
    usual = spec or LatticeSpec()
    cell, size, fillet = (rest.get(n, getattr(usual, n)) for n in ("cell", "cell_size", "fillet"))
    cell = any_cell(cell) if isinstance(cell, str) else cell
    is_of_cells = rest.get("network") in (None, "cells")
    kind = kind_of_cell(cell) if is_of_cells else LatticeKind
    radii = size * kind.radii_of_densities(cell, field.values, fillet / size)
    return with_fields(
        rest | {"strut_radius": dataclasses.replace(field, values=radii)}, None, size
    )


def _with_target(
    parameters: dict[str, Any], spec: LatticeSpec | None, young: float
) -> dict[str, Any]:
    """The parameters with a `Target` in place of what one is given by."""
    target = read_target(parameters, young)
    rest = {name: value for name, value in parameters.items() if name not in AIMS}
    if target is not None:
        usual = spec or LatticeSpec()
        size, fillet = (parameters.get(n, getattr(usual, n)) for n in ("cell_size", "fillet"))
        rest |= {"target": target, "strut_radius": first_radius(size, fillet)}
    elif spec is not None and any(rest.get(name) is not None for name in THICKNESSES):
        rest["target"] = None
    return rest
