# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of a sized part that a later run reads: its radii, its skin's thickness, how it is made."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

from ..design.field_files import write_points
from ..design.parameters.specification import values_of
from ..design.scattered_field import PointField
from ..design.spec import LatticeSpec


def write_field(spec: LatticeSpec, path: str | os.PathLike[str]) -> None:
    """Write a sized field as a table that ``--radius-field`` reads: x, y, z and radius, mm."""
    assert spec.radius_grading is not None
    assert isinstance(spec.radius_grading.field, PointField)
    write_points(path, spec.radius_grading.field.points, spec.radius_grading.field.values, "radius")


def write_thickness(spec: LatticeSpec, path: str | os.PathLike[str]) -> None:
    """Write the skin's thickness as a table that ``--skin-field`` reads: x, y, z, mm."""
    assert isinstance(spec.skin_field, PointField)
    write_points(path, spec.skin_field.points, spec.skin_field.values, "thickness", digits=12)


def values_with_radii(
    spec: LatticeSpec,
    path: str | os.PathLike[str],
    thickness: str | os.PathLike[str] | None = None,
) -> dict[str, Any]:
    """What a specification's file says of a sized part whose radii are in a file of their own.

    Args:
        spec: of the sized part.
        path: the file of its radii.
        thickness: that of its skin's thickness; None where that was not sized.
    """
    assert spec.radius_grading is not None
    spec = replace(spec, radius_grading=replace(spec.radius_grading, field=str(path)))
    if thickness is None:
        return values_of(spec)
    return {**values_of(replace(spec, skin_field=None)), "skin_field": str(thickness)}
