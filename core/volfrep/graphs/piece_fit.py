# SPDX-License-Identifier: LGPL-2.1-or-later
"""The facets of joints fitted to the true surface: diagonals flipped, vertices moved."""

from __future__ import annotations

import numpy as np

from ..grid.strut_graph import Wireframe
from ..mesh import remesh
from ..util.ragged import table_of
from ..util.types import Bools, Floats, Ints
from .half_struts import HalfStruts, corner_scale

#: Passes of the fit, and how far it moves a vertex at most each time, in units of the ball times
#: the square of the angle between rulings.
_FITS, _FIT_REACH = 2, 0.1
# Three points inside a triangle, which integrate to degree 2.
_QUADRATURE = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4]]) / 6.0
#: Edges that stray less than so many times what one across a strut does are left as they are.
_USUAL = 2.0
#: Passes of flips, the least share of a ball's radius squared that one must gain, and the flattest
#: triangle of directions that it may leave.
_FLIPS, _WORTH, _FLAT = 8, 1e-5, 1e-5


class Pieces:
    """Triangulated pieces, drawn nearer to the true surface; each is seen from its own node."""

    def __init__(self, place: Floats, node: Ints, frame: Wireframe, halves: HalfStruts) -> None:
        self._place, self._node, self._halves = place, node, halves
        self._sides = halves.rays.shape[1]
        self._balls = frame.joint_radii
        self._arms = table_of(halves.node, len(frame.nodes))

    def flipped(self, rows: Ints) -> Ints:
        """The triangles, flipped where the other diagonal lies nearer to the surface.

        Seen from the node they stay a triangulation of the directions.
        """
        place = self._place
        # Edges across a strut stray by that much, and mostly nothing else does.
        usual = (_USUAL * (np.pi / self._sides) ** 2 / 3.0) ** 2

        def gain(ends: Ints, corners: Ints) -> Floats:
            a, b = place[corners[:, 0]], place[corners[:, 1]]
            u, v = place[ends[:, 0]], place[ends[:, 1]]
            turn = np.cross(a, b)
            valid = ((turn * v).sum(axis=1) > _FLAT * _size(a, b, v)) & (
                (turn * u).sum(axis=1) < -_FLAT * _size(a, b, u)
            )
            better = np.full(len(ends), -1.0)
            some = np.flatnonzero(valid)
            old = self._deviations(ends[some])
            some, old = some[old > usual], old[old > usual]
            better[some] = old - self._deviations(corners[some]) - _WORTH
            return better

        edge = np.sort(np.concatenate([rows[:, [0, 1]], rows[:, [1, 2]], rows[:, [2, 0]]]), axis=1)
        edge = edge[np.unique(edge[:, 0] * len(place) + edge[:, 1], return_index=True)[1]]
        touched = np.zeros(len(place), bool)
        touched[edge[self._deviations(edge, (0.5,)) > usual]] = True
        near = np.flatnonzero(touched[rows].any(axis=1))
        some = rows[near]
        for _ in range(_FLIPS):
            some, flipped = remesh.flip(place, some, gain, lambda a, b: np.zeros(len(a), bool))
            if not flipped:
                break
        result: Ints = rows.copy()
        result[near] = some
        return result

    def fitted(self, rows: Ints, free: Bools) -> Floats:
        """The vertices, where facets about them stray from the surface to both sides alike."""
        place, limit = self._place.copy(), _FIT_REACH * (2.0 * np.pi / self._sides) ** 2
        for _ in range(_FITS):
            a, b, c = place[rows].swapaxes(0, 1)
            normal = np.cross(b - a, c - a)
            area = np.linalg.norm(normal, axis=1)
            of = self._node[rows[:, 0]]
            points = np.einsum("qk,mkj->qmj", _QUADRATURE, place[rows])
            off = np.mean([self._off(some, of) for some in points], axis=0)
            lean, weight, total = np.zeros_like(place), np.zeros(len(place)), np.zeros(len(place))
            for corner in range(3):
                np.add.at(lean, rows[:, corner], normal)
                np.add.at(weight, rows[:, corner], area)
                np.add.at(total, rows[:, corner], area * off)
            size = np.maximum(np.linalg.norm(lean, axis=1), 1e-30)
            reach = limit * self._balls[self._node]
            step = np.clip(-total / np.maximum(weight, 1e-30), -reach, reach) * free
            place += (step / size)[:, None] * lean
        return place

    def _off(self, points: Floats, of: Ints) -> Floats:
        """(k,) how far points lie outside the surface of joints, about; negative inside."""
        halves, shrink = self._halves, 1.0 / corner_scale(self._sides)
        found = np.linalg.norm(points, axis=-1) - self._balls[of]
        for column in range(self._arms.shape[1]):
            has = np.flatnonzero(self._arms[of, column] >= 0)
            half = self._arms[of[has], column]
            some = points[has]
            along = (some * halves.along[half]).sum(axis=1)
            across = np.sqrt(np.maximum((some * some).sum(axis=1) - along**2, 0.0))
            beside = across - shrink * (halves.radius[half] + halves.slope[half] * along)
            found[has] = np.minimum(found[has], np.where(along > 0.0, beside, np.inf))
        result: Floats = found
        return result

    def _deviations(self, edge: Ints, shares: tuple[float, ...] = (0.25, 0.5, 0.75)) -> Floats:
        """(k,) mean square distance of edges from the surface, in units of the ball."""
        one, two = self._place[edge[:, 0]], self._place[edge[:, 1]]
        of = self._node[edge[:, 0]]
        far = [self._off(one + share * (two - one), of) ** 2 for share in shares]
        return np.asarray(np.mean(far, axis=0) / self._balls[of] ** 2)


def _size(a: Floats, b: Floats, c: Floats) -> Floats:
    """Product of the lengths of three vectors each."""
    found: Floats = np.prod([np.linalg.norm(v, axis=1) for v in (a, b, c)], axis=0)
    return found
