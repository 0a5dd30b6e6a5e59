# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which strut is nearest to a point, and how far along it."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..util.ragged import spread
from ..util.threads import threads
from ..util.types import Floats, Ints

#: A strut has four samples or so, and a long one no more than so many.
MOST_SAMPLES = 24
#: So many samples are looked at near each point.
LOOKED_AT = 6


class NearestStrut:
    """Struts as lines between two points, asked for the one nearest to a point.

    Every strut is sampled along its line; the exact distance to the struts of the samples next to
    a point decides. With samples closer together than struts are apart that is the nearest one.

    Args:
        ends: (m, 2, 3) mm, at least one strut.
    """

    def __init__(self, ends: Floats) -> None:
        self._ends = ends
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        spacing = max(float(np.median(length)) / 4.0, 1e-9)
        count = np.clip(np.ceil(length / spacing), 1, MOST_SAMPLES).astype(np.int64)
        self._owner, within = spread(count)
        share = ((within + 0.5) / count[self._owner])[:, None]
        along = ends[self._owner]
        self._tree = cKDTree((1.0 - share) * along[:, 0] + share * along[:, 1])

    def of(self, points: Floats) -> tuple[Ints, Floats]:
        """For (n, 3) points, mm: (n,) the strut, and (n,) the share of its length from 0 to 1."""
        looked_at = min(LOOKED_AT, len(self._owner))
        rows = self._tree.query(points, looked_at, workers=threads())[1].reshape(len(points), -1)
        strut = self._owner[rows]
        start = self._ends[strut, 0]
        along = self._ends[strut, 1] - start
        squared = np.maximum((along**2).sum(axis=2), 1e-300)
        share = np.clip(((points[:, None] - start) * along).sum(axis=2) / squared, 0.0, 1.0)
        away = ((start + share[..., None] * along - points[:, None]) ** 2).sum(axis=2)
        best = away.argmin(axis=1)[:, None]
        return (
            np.take_along_axis(strut, best, axis=1)[:, 0],
            np.take_along_axis(share, best, axis=1)[:, 0],
        )
