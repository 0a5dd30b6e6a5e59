# SPDX-License-Identifier: LGPL-2.1-or-later
"""One period of a wall, meshed as its eight octants, which fit each other and their copies.

Marching cubes finds the surface on samples of the true distance. Both sides of a sheet are found
each for itself, so that a thin one needs no finer samples than a thick one. What lies on the
octants' edges and faces is settled first, each vertex once for all the octants that share it; then
the octants are evened out inside, on the exact surface.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..lattice.assembly import Layout, coordinates, lay_out, numbers
from ..mesh import remesh
from ..octants.batch import ranked_octant
from ..octants.constrained_mesh import PinnedMesh, shorten_steps
from ..octants.octant import (
    ALL_ACTIVE,
    STEPS,
    Octant,
    OctantGrid,
    OctantKey,
    RawOctant,
    octant_mirrors,
    raw_octant,
)
from ..octants.octant_mesh import FacetsCross
from ..octants.untangle import untangle
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .isotropic_remesh import SLIDE, remesh_evenly
from .solid import TpmsSolid

#: Samples are right up to so many steps from the surface.
BAND = 2.5
#: Samples nearer to the surface are moved off it, in steps: symmetric surfaces like to pass through
#: them, and would leave slivers at the octants' corners. As near come vertices on their edges.
ZERO_BAND = 0.06
MARGIN = 0.05
#: Rounds of sliding the border's vertices.
BORDER_ROUNDS = 4
BISECTIONS = 26
#: An edge of the border that turns by an angle of a lesser cosine has folded over.
FOLDED = 0.2
#: Where the surface grazes a face, vertices in it stay as marching cubes found them: the least
#: square of the sine between the two. None goes farther from there than this, in wanted edges.
GRAZING = 0.1
FARTHEST = 0.6


def tpms_octants(
    solid: TpmsSolid, cell_size: float, facets: int, monitor: Monitor
) -> dict[OctantKey, Octant]:
    """The octants of an endless wall: of each mirroring of the frame one.

    Args:
        solid: what is solid, in units of L.
        cell_size: L, mm.
        facets: facet edges along L.
        monitor: for cancel.

    Raises:
        FacetsCross: an octant's facets run through each other, whatever is done about it.
    """
    steps = (facets + 1) // 2
    step = 0.5 / steps
    found = []
    for side in solid.sides:
        samples = side.samples(2 * steps, BAND * step)
        samples[np.abs(samples) < ZERO_BAND * step] = ZERO_BAND * step
        found.append(samples * cell_size)
        monitor.tick()
    keys = [OctantKey(mirror, ALL_ACTIVE) for mirror in range(8)]
    raw, corners = [], []
    for key in keys:
        own = [_octant_samples(samples, key.mirror, steps) for samples in found]
        raw.append([raw_octant(samples, cell_size) for samples in own])
        corners.append(np.max(own, axis=0)[::steps, ::steps, ::steps] < 0.0)
    period = _Period.of(solid.sides, cell_size, facets, keys, raw, corners)
    monitor.count("kinds of octants meshed", len(keys))
    vertices = period.with_settled_border()
    raw_surface = _surface(period, vertices)
    for gently in (False, True):
        surface, origin = remesh_evenly(raw_surface, period.in_frames, gently, monitor)
        surface = replace(surface, piece=surface.piece % len(keys))
        surface, crossed = untangle(surface, raw_surface.vertices[origin])
        if not crossed.any():
            return period.octants(surface, origin)
    raise FacetsCross(
        f"Facets of a {facets}th of a cell run through each other: choose another resolution or "
        "thickness."
    )


def _octant_samples(samples: Floats, mirror: int, steps: int) -> Floats:
    """The samples of one octant, in its own frame: a mirrored one begins at the cell's far side."""
    cut = tuple(
        slice(2 * steps, steps - 1 or None, -1) if mirror >> axis & 1 else slice(0, steps + 1)
        for axis in range(3)
    )
    return np.ascontiguousarray(samples[cut])


@dataclass(frozen=True, eq=False)
class _Period:
    """Raw octants of a period, joined on their faces.

    Attributes:
        sides: what is solid on one side of each of the surfaces, in units of L.
        cell_size: L, mm.
        edge: wanted, mm.
        step: between samples, mm.
        keys, raw, corners: of the eight octants, and whether their corners are solid.
        layout: numbers the vertices that they share.
        number: (n,) of each octant's vertices, one octant after another.
        sign: (n, 3) direction of the frame that each lies in.
        piece: (n,) its octant.
        side: (n,) which of the sides it is on.
    """

    sides: Sequence[TpmsSolid]
    cell_size: float
    edge: float
    step: float
    keys: list[OctantKey]
    raw: list[RawOctant]
    corners: list[Bools]
    layout: Layout
    number: Ints
    sign: Floats
    piece: Ints
    side: Ints

    @staticmethod
    def of(
        sides: Sequence[TpmsSolid],
        cell_size: float,
        facets: int,
        keys: list[OctantKey],
        found: list[list[RawOctant]],
        corners: list[Bools],
    ) -> _Period:
        raw = [_together(octants) for octants in found]
        octants = {
            key: ranked_octant(one.vertices, one.triangles, one.place, one.order, solid_corners)
            for key, one, solid_corners in zip(keys, raw, corners, strict=True)
        }
        kind = octant_mirrors((2, 2, 2)).astype(np.int16)
        grid = OctantGrid(keys, kind, np.zeros(3), cell_size, False, (True, True, True))
        layout = lay_out(grid, octants)
        places = [place[0] for place in layout.places]
        number = [
            numbers(layout, octants[key], place[None])[0]
            for key, place in zip(keys, places, strict=True)
        ]
        sign = [np.where(place % 2 == 0, -1.0, 1.0) for place in places]
        counts = [len(one.vertices) for one in raw]
        return _Period(
            sides, cell_size, cell_size / facets, 0.5 * cell_size / ((facets + 1) // 2), keys, raw,
            corners, layout, np.concatenate(number).astype(np.int64),
            np.repeat(sign, counts, axis=0), np.repeat(np.arange(len(raw)), counts),
            np.concatenate([np.full(len(one.vertices), k)
                            for octants in found for k, one in enumerate(octants)]),
        )  # fmt: skip

    @property
    def half(self) -> float:
        """Edge of an octant, mm."""
        return 0.5 * self.cell_size

    @property
    def place(self) -> NDArray[np.int8]:
        """(n, 3) where the octants' vertices lie in them."""
        return np.concatenate([one.place for one in self.raw])

    def at(self, points: Floats, side: Ints) -> tuple[Floats, Floats]:
        """Distances in mm to the surface of a side and their gradients, at points of the period."""
        value, gradient = np.empty(len(points)), np.empty((len(points), 3))
        for k, solid in enumerate(self.sides):
            own = side == k
            value[own], gradient[own] = solid.values_and_gradients(points[own] / self.cell_size)
        return value * self.cell_size, gradient

    def with_settled_border(self) -> Floats:
        """The octants' vertices, each in its frame, those on their faces in their last places."""
        count = self.layout.count
        points = coordinates(self.layout, Monitor())
        pinned = np.zeros((count, 3), bool)
        pinned[self.number] = self.place != 1
        side = np.zeros(count, int)
        side[self.number] = self.side
        pins = pinned.sum(axis=1)
        on_edge, on_face = np.flatnonzero(pins == 2), np.flatnonzero(pins == 1)
        points[on_edge] = self._on_edges(points[on_edge], pinned[on_edge], side[on_edge])
        found = points[on_face].copy()
        points[on_face] = self._in_faces(found, found, ~pinned[on_face], side[on_face])
        pairs = self._border()
        first = points.copy()
        for _ in range(BORDER_ROUNDS):
            gap = self._apart(points[pairs[:, 1]] - points[pairs[:, 0]])
            total = np.stack(
                [
                    np.bincount(pairs[:, 0], gap[:, k], minlength=count)
                    - np.bincount(pairs[:, 1], gap[:, k], minlength=count)
                    for k in range(3)
                ],
                axis=1,
            )
            often = np.bincount(pairs.ravel(), minlength=count)
            step = SLIDE * total / np.maximum(often, 1)[:, None] * ~pinned
            slid = points[on_face] + step[on_face]
            points[on_face] = self._in_faces(slid, found, ~pinned[on_face], side[on_face])
        points = self._unfold(first, points, pairs, on_face)
        # Whole steps: octants that share a vertex give it the very same place.
        whole = self.half / STEPS
        points = np.rint(points / whole) * whole
        own = self.sign * points[self.number]
        own -= self.cell_size * np.floor(own / self.cell_size)
        fixed = self.place != 1
        own = np.where(fixed, np.where(self.place == 2, self.half, 0.0), own)
        inner = ~fixed.any(axis=1)
        own[inner] = np.concatenate([one.vertices for one in self.raw])[inner]
        return own

    def _on_edges(self, points: Floats, pinned: Bools, side: Ints) -> Floats:
        """Vertices on the octants' edges, where the wall's surface is between two samples."""
        cell = np.floor(points / self.step + 1e-9)
        low = np.where(pinned, points, (cell + MARGIN) * self.step)
        high = np.where(pinned, points, (cell + 1.0 - MARGIN) * self.step)
        positive = self.at(high, side)[0] > 0.0
        at_low = self.at(low, side)[0] > 0.0
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            to_high = ((self.at(middle, side)[0] > 0.0) == positive)[:, None]
            low, high = np.where(to_high, low, middle), np.where(to_high, middle, high)
        # Where the surface is nearly at a sample there may be no change of sign left in between.
        return np.where((at_low == positive)[:, None], points, 0.5 * (low + high))

    def _in_faces(self, points: Floats, found: Floats, loose: Bools, side: Ints) -> Floats:
        """Vertices on the octants' faces brought to the wall's surface within them.

        Args:
            points: (n, 3) where they are.
            found: (n, 3) where marching cubes had them.
            loose: (n, 3) coordinates that may change.
            side: (n,) which side's surface.
        """
        grazes = np.zeros(len(points), bool)
        for _ in range(3):
            value, gradient = self.at(points, side)
            gradient = gradient * loose
            size = np.einsum("ij,ij->i", gradient, gradient)
            grazes |= size < GRAZING
            step = gradient * (value / np.maximum(size, GRAZING))[:, None]
            points = points - shorten_steps(step, 0.5 * self.edge)
        gap = points - found
        grazes |= np.linalg.norm(gap, axis=1) > FARTHEST * self.edge
        return np.where(grazes[:, None], found, points)

    def _border(self) -> Ints:
        """(k, 2) numbers of vertices that an open edge of an octant joins."""
        found, first = [], 0
        for one in self.raw:
            table = remesh.edges(one.triangles, len(one.vertices))
            ends = table.ends[table.triangles[:, 1] < 0]
            found.append(self.number[first + ends])
            first += len(one.vertices)
        result: Ints = np.unique(np.sort(np.concatenate(found), axis=1), axis=0)
        return result

    def _apart(self, gaps: Floats) -> Floats:
        """The shortest of the ways between vertices of a period."""
        result: Floats = gaps - self.cell_size * np.round(gaps / self.cell_size)
        return result

    def _unfold(self, before: Floats, after: Floats, pairs: Ints, on_face: Ints) -> Floats:
        """Vertices of faces put back where their border folds over."""
        may_return = np.zeros(len(before), bool)
        may_return[on_face] = True
        old = self._apart(before[pairs[:, 1]] - before[pairs[:, 0]])
        after = after.copy()
        while True:
            new = self._apart(after[pairs[:, 1]] - after[pairs[:, 0]])
            size = np.linalg.norm(old, axis=1) * np.linalg.norm(new, axis=1)
            wrong = np.einsum("ij,ij->i", old, new) < FOLDED * size
            back = np.zeros(len(before), bool)
            back[pairs[wrong]] = True
            back &= may_return
            if not back.any():
                return after
            after[back] = before[back]
            may_return &= ~back

    @property
    def sides_of_octants(self) -> Ints:
        """(n,) numbers of the sides of octants: those of all octants, side by side."""
        return self.side * len(self.raw) + self.piece

    def in_frames(self, points: Floats, piece: Ints) -> tuple[Floats, Floats]:
        """Distances to sides and gradients at points in the frames of octants."""
        side, octant = np.divmod(piece, len(self.raw))
        first = np.searchsorted(self.piece, np.arange(len(self.raw)))
        sign = self.sign[np.minimum(first, len(self.sign) - 1)][octant]
        value, gradient = self.at(sign * points, side)
        return value, sign * gradient

    def octants(self, surface: PinnedMesh, origin: Ints) -> dict[OctantKey, Octant]:
        """The octants of an evened-out surface."""
        order = np.concatenate([one.order for one in self.raw])[origin]
        whole = self.half / STEPS
        result = {}
        for k, key in enumerate(self.keys):
            rows = np.flatnonzero(surface.piece == k)
            own = surface.triangles[surface.piece[surface.triangles[:, 0]] == k]
            vertices = np.rint(surface.vertices[rows] / whole) * whole
            result[key] = ranked_octant(
                vertices, np.searchsorted(rows, own), surface.place[rows], order[rows],
                self.corners[k],
            )  # fmt: skip
        return result


def _together(sides: Sequence[RawOctant]) -> RawOctant:
    """The sides' surfaces in an octant as one, ordered alike in every octant."""
    first = np.cumsum([0] + [len(one.vertices) for one in sides])
    return RawOctant(
        np.concatenate([one.vertices for one in sides]),
        np.concatenate([one.triangles + k for one, k in zip(sides, first[:-1], strict=True)]),
        np.concatenate([one.place for one in sides]),
        np.concatenate([len(sides) * one.order + k for k, one in enumerate(sides)]),
    )


def _surface(period: _Period, vertices: Floats) -> PinnedMesh:
    """All the octants as one surface, each in its own frame."""
    first = np.cumsum([0] + [len(one.vertices) for one in period.raw])
    triangles = [one.triangles + k for one, k in zip(period.raw, first[:-1], strict=True)]
    return PinnedMesh(
        vertices, np.concatenate(triangles), period.place, period.edge, period.step,
        period.sides_of_octants, period.half,
    )  # fmt: skip
