# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of a sized part that a later run reads: its radii, its skin's thickness, how it is made."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import numpy as np

from ...design.parameters.specification import values_of
from ...design.scattered_field import PointField
from ...design.spec import LatticeSpec
from ...util.files import replacing
from .sizing import SizedPart


def write_radii(part: SizedPart, path: str | os.PathLike[str]) -> None:
    """Write the radii as a table that ``--radius-field`` reads: x, y, z and radius, mm."""
    with replacing(path) as file:
        file.write(b"x,y,z,radius\n")
        table = np.column_stack([part.points, part.radii])
        file.writelines(b"%.9g,%.9g,%.9g,%.6f\n" % tuple(row) for row in table.tolist())


def values_with_radii(
    part: SizedPart,
    path: str | os.PathLike[str],
    thickness: str | os.PathLike[str] | None = None,
) -> dict[str, Any]:
    """What a specification's file says of a sized part whose radii are in a file of their own.

    Args:
        part: the sized part.
        path: the file of its radii.
        thickness: that of its skin's thickness; None where that was not sized.
    """
    assert part.spec.radius_grading is not None
    grading = replace(part.spec.radius_grading, field=str(path))
    spec = replace(part.spec, radius_grading=grading)
    if thickness is None:
        return values_of(spec)
    return {**values_of(replace(spec, skin_field=None)), "skin_field": str(thickness)}


def write_thickness(spec: LatticeSpec, path: str | os.PathLike[str]) -> None:
    """Write the skin's thickness as a table that ``--skin-field`` reads: x, y, z, mm."""
    field = spec.skin_field
    assert isinstance(field, PointField)
    with replacing(path) as file:
        file.write(b"x,y,z,thickness\n")
        table = np.column_stack([field.points, field.values])
        file.writelines(b"%.12g,%.12g,%.12g,%.6f\n" % tuple(row) for row in table.tolist())
