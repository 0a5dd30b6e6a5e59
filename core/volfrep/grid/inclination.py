# SPDX-License-Identifier: LGPL-2.1-or-later
"""How flat struts lie when a part is built along a direction."""

from __future__ import annotations

import numpy as np

from ..util.arguments import three_numbers
from ..util.errors import VolfrepError
from ..util.types import Bools, Floats
from .strut_graph import Graph

#: Degrees by which a strut of just an inclination may differ from it, as nodes are rounded.
_EXACT = 1e-6


def unit_direction(direction: tuple[float, float, float]) -> Floats:
    """The direction as a unit vector (3,).

    Raises:
        VolfrepError: it has no length, or is not three finite numbers.
    """
    vector = np.array(three_numbers("build direction", direction))
    size = float(np.linalg.norm(vector))
    if not 0 < size < np.inf:
        raise VolfrepError(
            f"The build direction must be three numbers that are not all 0, not {direction}."
        )
    return vector / size


def inclinations(lattice: Graph, up: Floats) -> Floats:
    """(m,) the angle of every strut to the build plate, degrees from 0 to 90."""
    ends = lattice.nodes[lattice.struts]
    return inclinations_along(ends[:, 1] - ends[:, 0], up)


def inclinations_along(spans: Floats, up: Floats) -> Floats:
    """(m,) the angle to the build plate of straight lines, degrees from 0 to 90.

    Args:
        spans: (m, 3) from their starts to their ends, of any length.
        up: (3,) a unit vector.
    """
    rise = np.abs((spans * up).sum(axis=1)) / np.maximum(np.linalg.norm(spans, axis=1), 1e-300)
    result: Floats = np.degrees(np.arcsin(np.minimum(rise, 1.0)))
    return result


def is_flat(lattice: Graph, up: Floats, inclination: float) -> Bools:
    """(m,) which struts lie flatter than so many degrees, those of just as many not."""
    return is_below(inclinations(lattice, up), inclination)


def is_below(angle: Floats, inclination: float) -> Bools:
    """(m,) which angles are less than one, degrees, those that are just as large not."""
    return np.asarray(angle < inclination - _EXACT)
