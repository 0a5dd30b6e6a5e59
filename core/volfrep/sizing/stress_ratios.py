# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many times as stressed as they say a skin's shells and struts are found to be.

Of struts each has its own; of a skin it is a smooth field. Triangles' stress scatters where it
changes from one to the next, as beside a bolt, and a limit on the largest values holds to the
scatter. So a solver's stress is set beside that of the shells by means about places, in which large
values count most.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..util.peaks import most_but_peaks
from ..util.types import Floats
from .skin import SkinModel
from .skin_thickness import control_points, shares_of

#: The power of the mean: large values govern, and no single triangle does.
_POWER = 8.0
#: Ratios beyond these are of places next to a clamped edge, and say nothing of those about them.
_LEAST, _MOST = 0.5, 2.0


@dataclass(frozen=True, eq=False)
class SkinRatio:
    """A field of ratios.

    Attributes:
        points: (p, 3) mm.
        values: (p,) of them.
        apart: how far apart they are, mm.
    """

    points: Floats
    values: Floats
    apart: float

    def at(self, places: Floats) -> Floats:
        """(n,) at places (n, 3) on the skin or near to it."""
        return np.asarray(shares_of(self.points, places, self.apart) @ self.values)


@dataclass(frozen=True, eq=False)
class StressRatios:
    """Ratios of a skin and of struts.

    Attributes:
        skin: a field.
        middles: (m, 3) mm, of the struts.
        struts: (m,) their ratios.
    """

    skin: SkinRatio
    middles: Floats
    struts: Floats

    def of_struts(self, middles: Floats) -> Floats:
        """(k,) of struts with middles (k, 3), which may be shorter or longer: the nearest one's."""
        return np.asarray(self.struts[cKDTree(self.middles).query(middles)[1]])


def skin_ratio(skin: SkinModel, own: Floats, found: Floats, apart: float) -> SkinRatio:
    """What a solver says over what the shells do.

    Args:
        skin: the shells.
        own: (t, k) their stress in each case, MPa, as they say it by themselves.
        found: (t, k) the solver's; nan where it has none.
        apart: how far apart ratios are chosen, mm.
    """
    points = control_points(skin.centres, apart)
    shares = shares_of(points, skin.centres, apart)
    known = np.isfinite(found).all(axis=1)
    area = sparse.diags(skin.shells.area * known)
    theirs = shares.T @ (area @ np.where(known, found.max(axis=1, initial=0.0), 0.0) ** _POWER)
    ours = shares.T @ (area @ own.max(axis=1) ** _POWER)
    there = (theirs > 0.0) & (ours > 0.0)
    ratio = np.where(there, theirs, 1.0) / np.where(there, ours, 1.0)
    values = np.clip(ratio ** (1.0 / _POWER), _LEAST, _MOST)
    # Means leave a little of the worst value, which is what the limit is for.
    changed = own * (shares @ values)[:, None]
    weight = skin.shells.area
    most = max(most_but_peaks(row, weight) for row in changed.T)
    worst = max(most_but_peaks(row, weight[known]) for row in found[known].T)
    return SkinRatio(points, values * worst / max(most, 1e-300), apart)
