# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keywords whose value is a function of points, a formula of x, y and z, or points with values."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from ...util.errors import VolfrepError
from ...util.types import Floats
from ..cell_sizes import SAMPLES, cells_by, points_by
from ..field_files import TABLE_SUFFIXES, VTK_SUFFIXES
from ..grading import Field, RadiusGrading
from ..graphs.graph import is_random, straight, with_density_by
from ..profile import Profile
from ..sampled_field import SAMPLES_ALONG_CELL, sample_function
from ..scattered_field import PointField

#: Keywords that take a field, whose values are: mm; mm; shares; what `radius_start` and
#: `radius_end`, or `radius_curve`, map to mm; what `network_density` is a formula of; how dense
#: points lie; mm; mm; mm.
FIELD_KEYWORDS = (
    "strut_radius", "wall_thickness", "relative_density", "radius_field", "network_field",
    "network_density", "skin_field", "shell", "cell_size",
)  # fmt: skip
_OF_PLACE = re.compile(r"\b[xyz]\b")


def is_field(name: str, value: object) -> bool:
    """Whether a keyword's value is a field, given in one of the ways of this module."""
    if name not in FIELD_KEYWORDS:
        return False
    if isinstance(value, str):
        is_file = value.lower().endswith(TABLE_SUFFIXES + VTK_SUFFIXES)
        return not is_file and _OF_PLACE.search(value) is not None
    is_pair = isinstance(value, (tuple, list)) and len(value) == 2 and np.ndim(value[0]) > 0
    return callable(value) or isinstance(value, Field) or is_pair


def is_sampled(name: str, value: object) -> bool:
    """Whether a field needs the part's box: a function or a formula, and any field of sizes."""
    is_made = isinstance(value, (Field, tuple, list)) and name != "cell_size"
    return is_field(name, value) and not is_made


def field_of(name: str, value: Any, bounds: Floats | None, cell_size: float) -> Field:
    """The field that a keyword's value stands for.

    Args:
        name: the keyword.
        value: a field; (n, 3) points in mm and (n,) values; a function; or a formula.
        bounds: (2, 3) the box that a function is sampled in, mm; None where there is none.
        cell_size: L, mm: samples lie a quarter of it apart.

    Raises:
        VolfrepError: it is none, or there is no box.
    """
    if isinstance(value, Field):
        return value
    if isinstance(value, (tuple, list)):
        try:
            value = (value[0], value[1])
            return PointField(np.asarray(value[0], float), np.asarray(value[1], float))
        except (TypeError, ValueError, IndexError) as error:
            if isinstance(error, VolfrepError):
                raise VolfrepError(f"{name}: {error}") from error
            raise VolfrepError(
                f"'{name}' takes (n, 3) points and (n,) values, and these are no such arrays."
            ) from error
    if bounds is None:
        raise VolfrepError(_needs_part(name))
    return sample_function(value, bounds, cell_size / SAMPLES_ALONG_CELL, name)


def with_fields(
    given: Mapping[str, Any], bounds: Floats | None, cell_size: float
) -> dict[str, Any]:
    """The keywords with fields, and what uses them, in place of what stands for fields.

    Raises:
        VolfrepError: as `field_of`; or a radius is not above 0, or given twice.
    """
    result = dict(given)
    fields = {
        name: field_of(name, value, bounds, cell_size)
        for name, value in given.items()
        if is_field(name, value)
    }
    result |= fields
    if "shell" in fields:
        if result.get("skin_field") is not None:
            raise VolfrepError("'shell' is a field itself: leave 'skin_field' out.")
        low, high = fields["shell"].range
        if low <= 0.0:
            raise VolfrepError(
                f"'shell' is {low:g} mm somewhere: by place it must be above 0 everywhere; "
                "'open_plane' opens faces."
            )
        result |= {"shell": low, "skin_field": fields["shell"] if high > low else None}
    if "radius_field" in fields:
        result.setdefault("radius_grading", "field")
    for name in ("strut_radius", "wall_thickness"):
        if name in fields:
            if result.get("radius_grading") not in (None, "none"):
                raise VolfrepError(
                    f"'{name}' is a field, which says how thick all struts or walls are: leave "
                    "'radius_grading' out."
                )
            grading, size = radius_by(name, fields[name])
            result |= {"radius_grading": grading, name: size}
    if "network_density" in fields:
        if "network_field" in fields:
            raise VolfrepError("'network_density' is a field itself: leave 'network_field' out.")
        low, high = fields["network_density"].range
        if low < 0.0 or high <= 0.0:
            raise VolfrepError(
                f"'network_density' is {low:g} somewhere: points cannot be less than none."
            )
        result["network_density"] = straight(low, high) if high > low else ""
        result["network_field"] = fields["network_density"] if high > low else None
    return result


def with_cell_size(given: Mapping[str, Any], bounds: Floats | None) -> dict[str, Any]:
    """The keywords with a size, and what follows a field, in place of a field of cell sizes.

    Raises:
        VolfrepError: there is no box, another keyword says the same, or cells cannot follow.
    """
    size, network = given.get("cell_size"), given.get("network")
    if not is_field("cell_size", size):
        return dict(given)
    if bounds is None:
        raise VolfrepError(_needs_part("cell_size"))
    spacing = float(np.ptp(bounds, axis=0).max()) / SAMPLES
    field = field_of("cell_size", size, bounds, SAMPLES_ALONG_CELL * spacing)
    result = dict(given)
    if is_random(network):
        _only(given, "network_density", "network_field")
        density, result["cell_size"] = points_by(field, bounds)
        return result if density is None else {**result, **with_density_by(network, density)}
    _only(given, "size_grading")
    grading, result["cell_size"] = cells_by(field, bounds)
    if grading is not None:
        result["size_grading"] = grading
    return result


def _only(given: Mapping[str, Any], *names: str) -> None:
    """Refuse what is said by a field of cell sizes, too."""
    for name in names:
        if given.get(name) not in (None, "none", ""):
            raise VolfrepError(f"'cell_size' is a field, which says as much: leave '{name}' out.")


def _needs_part(name: str) -> str:
    """What is said of a field without a part."""
    return (
        f"'{name}' is a function of places in a part: give it to 'fill', 'size', 'block' or "
        "'mesh_network', which know the part."
    )


def radius_by(name: str, field: Field) -> tuple[RadiusGrading | None, float]:
    """The grading by a field whose values are radii or thicknesses, and the largest of them, mm.

    None for the grading where the field is the same everywhere.

    Raises:
        VolfrepError: one is not above 0.
    """
    low, high = field.range
    if low <= 0.0:
        raise VolfrepError(f"'{name}' is {low:g} mm somewhere: it must be above 0 everywhere.")
    if low == high:
        return None, high
    curve = ((low, low), (high, high))
    return RadiusGrading("field", Profile(), field=field, curve=curve), high
