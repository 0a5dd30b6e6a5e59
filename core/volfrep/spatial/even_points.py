# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points that fill a square or a cube evenly: Sobol's sequence.

scipy's part for it is slow to load, as long as a small lattice takes: it is loaded when asked for.
"""

from __future__ import annotations

from ..util.types import Floats


def even_points(dimensions: int, points_log2: int) -> Floats:
    """(2 ** points_log2, dimensions) points from 0 to 1, the same in every run.

    Source: Sobol 1967, "On the distribution of points in a cube and the approximate evaluation of
    integrals".
    """
    from scipy.stats import qmc

    points: Floats = qmc.Sobol(dimensions, seed=1).random_base2(points_log2)
    return points
