# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants laid into one surface to be meshed together, and cut into octants again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..util.types import Bools, Floats, Ints
from . import sdf
from .constrained_mesh import Meshed, Surface
from .octant import (
    STEPS,
    Octant,
    OctantKey,
    RawOctant,
    raw_octant,
    sample_octants,
)
from .octant_spec import OctantSpec
from .refinement import BORDER_ROUNDS, finer_border, surface_deviations
from .sdf import Anchors, Field, Primitives
from .surface_fit import fit_border

#: By which places make an entity (see `Octant`).
ENTITY_WEIGHTS = np.array([9, 3, 1])
#: Samples of octants that are found together.
SAMPLES_AT_ONCE = 1 << 20
#: Pieces are meshed together up to about this many vertices.
BATCH_VERTICES = 150_000
#: What strays by more than so many deviations is measured closely: far less than is told.
CLOSELY = 0.5


def sample_all(
    spec: OctantSpec, primitives: Mapping[OctantKey, Primitives]
) -> Iterator[tuple[OctantKey, Floats]]:
    """The samples of octants, one after another."""
    keys = list(primitives)
    size = max(1, SAMPLES_AT_ONCE // (spec.steps + 1) ** 3)
    for begin in range(0, len(keys), size):
        part = keys[begin : begin + size]
        own = [primitives[key] for key in part]
        yield from zip(
            part, sample_octants(own, spec.cell_size, spec.steps, spec.fillet), strict=True
        )


@dataclass(frozen=True, eq=False)
class Batch:
    """Raw octants laid into one surface.

    Attributes:
        keys: which ones.
        raw: marching cubes' surfaces.
        solid_corners: of each.
        surface: all in one.
        step: that their vertices are rounded to, mm.
        deviation: how far their facets stray from a strut, mm.
    """

    keys: list[OctantKey]
    raw: list[RawOctant]
    solid_corners: list[NDArray[np.bool_]]
    surface: Surface
    step: float
    deviation: float

    @staticmethod
    def of(spec: OctantSpec, todo: Mapping[OctantKey, Primitives]) -> Batch:
        """As many of the octants, from the first, as fit in a batch."""
        used: list[OctantKey] = []
        raw: list[RawOctant] = []
        solid: list[NDArray[np.bool_]] = []
        primitives: list[Primitives] = []
        counts: list[Ints] = []
        near: list[Ints] = []
        away: list[Floats] = []
        total = offset = 0
        for key, samples in sample_all(spec, todo):
            own = todo[key]
            piece = raw_octant(samples, spec.cell_size)
            if used and total + len(piece.vertices) > BATCH_VERTICES:
                break
            used.append(key)
            raw.append(piece)
            solid.append(samples[:: spec.steps, :: spec.steps, :: spec.steps] < 0.0)
            primitives.append(own)
            if len(piece.vertices):
                count, index, far = _near(piece.vertices, own, spec.reach)
                counts.append(count)
                near.append(index + offset)
                away.append(far)
            total += len(piece.vertices)
            offset += len(own)
        first = np.cumsum([0] + [len(piece.vertices) for piece in raw])
        place = np.concatenate([piece.place for piece in raw])
        none = np.zeros(0, np.int64)
        vertices = np.concatenate([piece.vertices for piece in raw])
        start = np.concatenate([[0], np.cumsum(np.concatenate([none, *counts]))]).astype(np.int64)
        far = np.concatenate([np.zeros(0), *away])
        field = Field(
            sdf.join(*primitives),
            start,
            np.concatenate([none, *near]),
            spec.fillet,
            Anchors(vertices, far, np.minimum.reduceat(far, start[:-1]) if len(far) else far),
        )
        whole = Surface(
            vertices,
            np.concatenate([piece.triangles + k for piece, k in zip(raw, first[:-1], strict=True)]),
            place,
            spec.edge,
            spec.step,
            np.repeat(np.arange(len(raw)), np.diff(first)),
            0.5 * spec.cell_size,
            np.full(place.shape, -1, np.int64),
            field,
        )
        return Batch(used, raw, solid, whole, 0.5 * spec.cell_size / STEPS, spec.deviation)

    def bordered(self, remeshed: Surface, origin: Ints, farthest: float) -> Meshed:
        """The surface with its border fitted, and more vertices there where it strays.

        Every octant that shares a face has the same there, however it is meshed inside.

        Args:
            remeshed: evenly.
            origin: which of the raw vertices its own were.
            farthest: edges of the border stray no farther, mm.
        """
        order = np.concatenate([piece.order for piece in self.raw])[origin]
        found = Meshed(fit_border(remeshed), self.surface.vertices[origin], order)
        for _ in range(BORDER_ROUNDS):
            finer, parents = finer_border(found.surface, farthest)
            if finer is found.surface:
                break
            found = found.of(finer, parents)
        return found

    def split(self, meshed: Meshed, which: Bools) -> dict[OctantKey, Octant]:
        """The surface cut into the octants again, some of (k,), with how far each strays."""
        meshed = meshed.where(which[meshed.surface.piece])
        refined = meshed.surface
        deviations = np.zeros(len(self.raw))
        if refined.field.fillet == 0.0:  # otherwise values are no distances
            owner = refined.piece[refined.triangles[:, 0]]
            np.maximum.at(deviations, owner, surface_deviations(refined, CLOSELY * self.deviation))
        number = {key: k for k, key in enumerate(self.keys)}
        return {
            key: replace(octant, deviation=float(deviations[number[key]]))
            for key, octant in self.octants(meshed, which)
        }

    def octants(self, meshed: Meshed, which: Bools) -> Iterator[tuple[OctantKey, Octant]]:
        """The surface cut into the octants again, some of (k,)."""
        refined, order = meshed.surface, meshed.order
        # Pieces are runs of vertices.
        begin = np.searchsorted(refined.piece, np.arange(len(self.raw) + 1))
        owner = refined.piece[refined.triangles[:, 0]]
        by_piece = np.argsort(owner, kind="stable")
        cuts = np.searchsorted(owner[by_piece], np.arange(len(self.raw) + 1))
        for k, key in enumerate(self.keys):
            if not which[k]:
                continue
            part = slice(begin[k], begin[k + 1])
            vertices = np.rint(refined.vertices[part] / self.step) * self.step
            triangles = refined.triangles[by_piece[cuts[k] : cuts[k + 1]]] - begin[k]
            yield (
                key,
                ranked_octant(
                    vertices, triangles, refined.place[part], order[part], self.solid_corners[k]
                ),
            )


def ranked_octant(
    vertices: Floats,
    triangles: Ints,
    place: NDArray[np.int8],
    order: Ints,
    solid_corners: NDArray[np.bool_],
) -> Octant:
    """An octant whose vertices are numbered on each face and edge by their order there.

    Arguments as the attributes of `Octant` and `RawOctant`.
    """
    entity = (place.astype(np.int64) * ENTITY_WEIGHTS).sum(axis=1)
    return Octant(
        vertices,
        triangles.astype(np.int32),
        entity.astype(np.int8),
        _ranks(entity, order),
        solid_corners,
    )


def _near(points: Floats, primitives: Primitives, reach: float) -> tuple[Ints, Ints, Floats]:
    """For every point how many primitives are up to `reach` beyond the nearest, which, how far."""
    counts, index, away = [], [], []
    chunk = max(1, 1_000_000 // max(len(primitives), 1))
    for k in range(0, len(points), chunk):
        distance = sdf.distances(points[k : k + chunk, None], primitives)
        is_near = distance <= distance.min(axis=1, keepdims=True).clip(min=0.0) + reach
        counts.append(is_near.sum(axis=1))
        index.append(np.nonzero(is_near)[1])
        away.append(distance[is_near])
    return np.concatenate(counts), np.concatenate(index), np.concatenate(away)


def _ranks(entity: Ints, order: Ints) -> NDArray[np.int32]:
    """Number of every vertex within its entity, by `order`."""
    sequence = np.lexsort((order, entity))
    count = np.bincount(entity, minlength=27)
    start = np.cumsum(count) - count
    rank = np.empty(len(entity), np.int32)
    rank[sequence] = np.arange(len(entity)) - start[entity[sequence]]
    return rank
