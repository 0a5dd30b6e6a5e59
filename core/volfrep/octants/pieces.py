# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants' surfaces in one: what is known of their vertices, some of them taken out, and joined."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..util.types import Bools, Floats, Ints
from .constrained_mesh import Surface


@dataclass(frozen=True, eq=False)
class Meshed:
    """Surfaces of octants that are meshed together, with what is known of their vertices.

    Attributes:
        surface: its vertices piece by piece.
        home: (n, 3) where marching cubes found them, or the middle of those they lie between, mm.
        order: (n,) int64, orders the vertices of a face or edge alike in all octants that share it.
    """

    surface: Surface
    home: Floats
    order: Ints

    def of(self, surface: Surface, parents: Ints) -> Meshed:
        """The surface that came of this one: (n, 2) of which vertices its own came, or one each."""
        if parents.ndim == 1:
            return Meshed(surface, self.home[parents], self.order[parents])
        # What is between two comes after both, whatever else there is: in any octant that has them.
        order = np.sort(self.order[parents], axis=1)
        _, rank = np.unique(order, axis=0, return_inverse=True)
        return Meshed(surface, self.home[parents].mean(axis=1), rank.reshape(-1))

    def where(self, which: Bools) -> Meshed:
        """Some of its pieces: those of (n,) vertices."""
        surface, number = self.surface, np.cumsum(which) - 1
        triangles = number[surface.triangles[which[surface.triangles[:, 0]]]]
        part = replace(
            surface, vertices=surface.vertices[which], triangles=triangles,
            place=surface.place[which], held=surface.held[which],
            field=surface.field.rows(np.flatnonzero(which)), piece=surface.piece[which],
        )  # fmt: skip
        return Meshed(part, self.home[which], self.order[which])

    def joined(self, other: Meshed) -> Meshed:
        """Both, piece by piece again."""
        one, two = self.surface, other.surface
        piece = np.concatenate([one.piece, two.piece])
        by_piece = np.argsort(piece, kind="stable")
        rank = np.empty(len(piece), np.int64)
        rank[by_piece] = np.arange(len(piece))

        def both(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
            result: NDArray[Any] = np.concatenate([a, b])[by_piece]
            return result

        triangles = rank[np.concatenate([one.triangles, two.triangles + len(one.vertices)])]
        surface = replace(
            one, vertices=both(one.vertices, two.vertices), triangles=triangles,
            place=both(one.place, two.place), held=both(one.held, two.held),
            field=one.field.joined(two.field).rows(by_piece), piece=piece[by_piece],
        )  # fmt: skip
        return Meshed(surface, both(self.home, other.home), both(self.order, other.order))
