# SPDX-License-Identifier: LGPL-2.1-or-later
"""The density that sizing wants: radii or thicknesses that were sized, as percents of a solid.

A slicer's infill is no such lattice: what is taken over is how much of the material goes where.
"""

from __future__ import annotations

import numpy as np

from ...design.banded_infill import MOST
from ...design.cells import LIBRARY, UnitCell
from ...design.scattered_field import PointField
from ...design.spec import LatticeSpec
from ...mechanics.catalogue import catalogue
from ...mechanics.density import relative_density
from ...util.errors import VolfrepError
from ...util.types import Floats
from ..kinds import lattice_kind

#: Radii at which the density of a cell that the catalogue does not know is computed.
_PLACES = 5
#: A joint and the strut's radius stay within half a cell up to here, r / L.
_THICKEST = 0.36


def sized_densities(spec: LatticeSpec) -> tuple[PointField, str]:
    """The density of a lattice that was sized, where its radii are known.

    Args:
        spec: of cells of one size whose struts follow a field of points, as `volfrep size` writes
            it and Loads and Sizing leaves it.

    Returns:
        The field in percent, no more than a slicer's infill may have; and the curve by which
        `BandedInfill` takes its values as they are.

    Raises:
        VolfrepError: the lattice was not sized, or is of another kind.
    """
    grading, cell = spec.radius_grading, spec.kind.cube
    points = None if grading is None else grading.field
    if grading is None or grading.by != "field" or not isinstance(points, PointField):
        raise VolfrepError(
            "This lattice has no radii of a sizing: size it first, or give the specification that "
            "sizing has written."
        )
    if spec.size_grading is not None or spec.cell_map is not None:
        raise VolfrepError(
            "Densities are known of sized struts and walls in cubic cells of one size: leave cell "
            "gradings and maps out."
        )
    radii = grading.radii(points.points, np.zeros((2, 3)), lambda at: np.zeros(len(at)))
    ratios = radii / spec.cell_size
    found = lattice_kind(spec).densities(radii) if cell is None else _densities(cell, ratios)
    percent = np.minimum(100.0 * found, MOST)
    low, high = float(percent.min()), float(percent.max())
    high = max(high, low + 1e-3)
    field = PointField(points.points, percent, source=f"density of {points.source}")
    return field, f"{low:.6g}:{low:.6g},{high:.6g}:{min(high, MOST):.6g}"


def _densities(cell: UnitCell, ratios: Floats) -> Floats:
    """(n,) relative densities at r / L: by the powers of r between, and beyond, known ones."""
    listed = catalogue().get(cell.name) if LIBRARY.get(cell.name) == cell else None
    if listed is not None:
        known, values = listed.ratios, listed.values[:, 0]
    else:
        ends = np.minimum([ratios.min(), ratios.max()], [0.9 * _THICKEST, _THICKEST])
        known = np.geomspace(ends[0], max(ends[1], 1.05 * ends[0]), _PLACES)
        values = np.array([relative_density(cell, float(ratio)).value for ratio in known])
    places, logs = np.log(known), np.log(values)
    at = np.log(ratios)
    result = np.interp(at, places, logs)
    for rows, first, last in ((at < places[0], 0, 1), (at > places[-1], -1, -2)):
        slope = (logs[last] - logs[first]) / (places[last] - places[first])
        result[rows] = logs[first] + slope * (at[rows] - places[first])
    return np.asarray(np.exp(result))
