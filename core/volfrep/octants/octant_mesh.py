# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octant meshing, done once a pattern: sample, contour, remesh, fit, untangle."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell
from ..design.spec_parts import Resolution, Struts
from ..mesh import remesh
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Floats, Ints
from . import sdf
from .border_refinement import ROUNDS, finer_border
from .constrained_mesh import Surface
from .isotropic_remesh import even_out
from .octant import (
    STEPS,
    Octant,
    OctantKey,
    RawOctant,
    octant_primitives,
    raw_octant,
    sample_octant,
)
from .octant_spec import OctantSpec
from .pieces import Meshed
from .refinement import all_stray, coarser, flipped_nearer, split_where_it_strays
from .sdf import Field, Primitives
from .surface_fit import fit_border, fit_facets
from .untangle import crossing_facets, untangled
from .windows import sampled_finely_enough

#: Samples are clamped to so many steps: farther from the surface only their sign matters.
SEEN_STEPS = 2.0
#: Pieces are meshed together up to about this many vertices.
BATCH_VERTICES = 150_000
#: How far facets may stray, in deviations, after vertices that are not needed are merged, and after
#: facets that stray are divided: 1.5 is what is promised.
MERGED_TO = 1.15
DIVIDED_TO = 1.45
#: Facets that stray by more than this part of it are looked at closely.
LOOKED_AT = 0.8
#: So often, at most, facets are divided.
REFINEMENTS = 16
#: Steps of the fit after vertices are merged, and after facets are divided.
REFITS = (2, 4)
#: Of a piece no more facets are divided when it has so many times those that it began with.
GROWTH = 2.0
#: Nor when in so many rounds its worst facet has come nearer by less than this.
STALLED, NEARER = 8, 0.95
#: Sine of the smallest angle that facets may be left with: what strays however it is divided, as
#: where a crease runs out, would end in needles.
SHARPEST = 0.088
#: They are left all the same where without them a piece strays so many times as far.
FARTHER = 2.0


class FacetsCross(VolfrepError):
    """Facets of an octant run through each other, whatever is done about it."""


class _Manner(Enum):
    """How octants are meshed: those whose facets cross once more, in the next manner."""

    COARSE_AND_FINE = 0
    FINE = 1
    EVEN = 2
    GENTLE = 3


def octant_spec(cell_size: float, struts: Struts, detail: Resolution) -> OctantSpec:
    """What the octants of a lattice are meshed for, with cells of a size in mm."""
    facets = detail.along_cell(cell_size, struts)
    return OctantSpec(cell_size, struts.template_radius, struts.fillet, facets)


def mesh_octants(
    cell: UnitCell, spec: OctantSpec, keys: Sequence[OctantKey], monitor: Monitor
) -> dict[OctantKey, Octant]:
    """Mesh the octants of the given keys.

    Struts that an octant has and another one lacks are often hidden in its joints: octants whose
    surfaces are the same are meshed once.

    Raises:
        FacetsCross: there is an octant whose facets run through each other, however it is meshed.
    """
    spec = sampled_finely_enough(cell, spec)
    # What an octant's surface may consist of, as far as its vertices may move.
    primitives = {
        key: octant_primitives(cell, key, spec.cell_size, spec.strut_radius, spec.reach)
        for key in dict.fromkeys(keys)
    }
    groups: dict[bytes, list[OctantKey]] = {}
    for key, own in primitives.items():
        samples = sample_octant(own, spec.cell_size, spec.steps, spec.fillet)
        seen = np.clip(samples, -SEEN_STEPS * spec.step, SEEN_STEPS * spec.step)
        groups.setdefault(hashlib.blake2b(seen.tobytes()).digest(), []).append(key)
        monitor.tick()
    result: dict[OctantKey, Octant] = {}
    firsts = [group[0] for group in groups.values()]
    _mesh(spec, {key: primitives[key] for key in firsts}, result, monitor)
    for group in groups.values():
        octant = result[group[0]]
        result.update(dict.fromkeys(_alike(spec, octant, group, primitives), octant))
    rest = {key: own for key, own in primitives.items() if key not in result}
    _mesh(spec, rest, result, monitor)
    return result


def _mesh(
    spec: OctantSpec,
    primitives: Mapping[OctantKey, Primitives],
    result: dict[OctantKey, Octant],
    monitor: Monitor,
) -> None:
    """Mesh octants, each by itself, and put them to the others.

    Raises:
        FacetsCross: there is an octant whose facets run through each other, however it is meshed.
    """
    monitor.count("kinds of octants meshed", len(primitives))
    todo = list(primitives)
    # Facets that touch are better than none, where nothing keeps them apart.
    for exact, manner in itertools.product((True, False), _Manner):
        same, todo = todo, []
        done = 0
        while done < len(same):
            batch = _Batch.of(spec, {key: primitives[key] for key in same[done:]})
            remeshed, origin = even_out(batch.surface, manner is _Manner.GENTLE)
            meshed = _bordered(remeshed, batch, origin, DIVIDED_TO * spec.deviation)
            if manner is _Manner.COARSE_AND_FINE:
                fine = _refined(_coarsened(meshed, spec.deviation), spec.deviation)
                # To draw facets apart moves them off the surface, and smaller ones less.
                fitted, order = fine.surface, fine.order
                crossed = crossing_facets(fitted, exact)
            else:
                if manner is _Manner.FINE:
                    meshed = _refined(meshed, spec.deviation)
                fitted, crossed = untangled(meshed.surface, meshed.home, exact)
                order = meshed.order
            bad = np.unique(fitted.piece[fitted.triangles[crossed, 0]])
            result.update(batch.split(fitted, order))
            todo += [batch.keys[k] for k in bad]
            done += len(batch.keys)
            monitor.tick(done / len(same))
        if not todo:
            return
    raise FacetsCross(
        f"Where struts meet, facets of a {spec.facets}th of a cell run through each other: "
        "choose another resolution or strut radius, or move the nodes of the cell."
    )


def _bordered(remeshed: Surface, batch: _Batch, origin: Ints, farthest: float) -> Meshed:
    """The surface fitted, with more vertices where its border strays by more than that, mm.

    Every octant that shares a face has the same there, however it is meshed inside.
    """
    order = np.concatenate([piece.order for piece in batch.raw])[origin]
    found = Meshed(fit_border(remeshed), batch.surface.vertices[origin], order)
    for _ in range(ROUNDS):
        finer, parents = finer_border(found.surface, farthest)
        if finer is found.surface:
            break
        found = found.of(finer, parents)
    return replace(found, surface=fit_facets(found.surface))


def _coarsened(meshed: Meshed, deviation: float) -> Meshed:
    """With vertices merged that facets within a deviation in mm do without."""
    farthest = MERGED_TO * deviation
    fewer, stay = coarser(meshed.surface, farthest)
    if len(stay) == len(meshed.home):
        return meshed
    fewer = fit_facets(flipped_nearer(fewer, farthest), farthest, REFITS[0])
    return meshed.of(fewer, stay)


def _refined(meshed: Meshed, deviation: float) -> Meshed:
    """With more vertices where facets stray, which is where struts meet, until none does.

    A piece that strays however it is divided, as where a crease runs out, stays as it was before
    that made needles of facets.
    """
    farthest = DIVIDED_TO * deviation
    rounds: list[Meshed] = []
    reached: list[Floats] = []
    beyond: list[Ints] = []
    pieces = int(meshed.surface.piece[-1]) + 1 if len(meshed.surface.piece) else 0
    most = GROWTH * np.bincount(meshed.surface.piece[meshed.surface.triangles[:, 0]], None, pieces)
    while True:
        surface = meshed.surface
        owner = surface.piece[surface.triangles[:, 0]]
        stray = all_stray(surface, LOOKED_AT * farthest)
        reached.append(np.where(np.isin(np.arange(pieces), surface.piece), 0.0, np.inf))
        np.maximum.at(reached[-1], owner, stray)
        beyond.append(np.bincount(owner[stray > farthest], minlength=pieces))
        rounds.append(meshed)
        if len(rounds) > REFINEMENTS:
            break
        far = (reached[-1] > farthest) & (np.bincount(owner, minlength=pieces) < most)
        if surface.field.fillet > 0.0 and len(rounds) > 1:
            # Where fillets' field bends faster than facets can, it is not for want of vertices.
            idle = (beyond[-1] >= beyond[-2]) & (reached[-1] >= NEARER * reached[-2])
            reached[-1][idle] = np.inf
            far &= ~idle
        if len(rounds) > STALLED:
            far &= reached[-1] < NEARER * reached[-1 - STALLED]
        meshed = meshed.where(far[surface.piece])
        finer, parents = split_where_it_strays(meshed.surface, stray[far[owner]], farthest)
        if finer is meshed.surface:
            break
        finer = fit_facets(flipped_nearer(finer, farthest), farthest, REFITS[1])
        meshed = meshed.of(finer, parents)
    # The last round of each piece that is nearly as near as any, of those without needles, if these
    # are not much farther than the others.
    sharp = np.array([_sines(part.surface, pieces) for part in rounds]) < SHARPEST
    value = np.array(reached)
    blunt = np.where(sharp, np.inf, value)
    value = np.where(blunt.min(axis=0) < FARTHER * value.min(axis=0).clip(farthest), blunt, value)
    enough = np.maximum(value.min(axis=0) / NEARER, farthest)
    chosen = len(rounds) - 1 - np.argmax((value <= enough)[::-1], axis=0)
    parts = [part.where((chosen == k)[part.surface.piece]) for k, part in enumerate(rounds)]
    result = parts[0]
    for part in parts[1:]:
        result = result.joined(part)
    return result


def _sines(surface: Surface, pieces: int) -> Floats:
    """(pieces,) the sine of the smallest angle of the facets of each piece."""
    corners = surface.vertices[surface.triangles]
    sides = np.sort(np.linalg.norm(corners - corners[:, [1, 2, 0]], axis=2), axis=1)
    twice = np.linalg.norm(remesh.normals(corners), axis=1)
    result = np.ones(pieces)
    sine = twice / np.maximum(sides[:, 1] * sides[:, 2], 1e-300)
    np.minimum.at(result, surface.piece[surface.triangles[:, 0]], sine)
    return result


def _alike(
    spec: OctantSpec,
    octant: Octant,
    group: list[OctantKey],
    primitives: Mapping[OctantKey, Primitives],
) -> list[OctantKey]:
    """Which octants have the surface of their group's first one, by the field at its facets.

    The samples said so already; a strut that shows between them only is found here.
    """
    first, *others = group
    if not len(octant.triangles) or not others:
        return others
    middles = octant.vertices[octant.triangles].mean(axis=1)
    points = np.concatenate([octant.vertices, middles])[:, None]

    def values(key: OctantKey) -> Floats:
        return sdf.union(sdf.distances(points, primitives[key]), spec.fillet)

    wanted = values(first)
    return [key for key in others if np.array_equal(values(key), wanted)]


@dataclass(frozen=True, eq=False)
class _Batch:
    """Raw octants laid into one surface, and the step that their vertices are rounded to."""

    keys: list[OctantKey]
    raw: list[RawOctant]
    solid_corners: list[NDArray[np.bool_]]
    surface: Surface
    step: float

    @staticmethod
    def of(spec: OctantSpec, todo: Mapping[OctantKey, Primitives]) -> _Batch:
        """As many of the octants, from the first, as fit in a batch."""
        used: list[OctantKey] = []
        raw: list[RawOctant] = []
        solid: list[NDArray[np.bool_]] = []
        primitives: list[Primitives] = []
        counts: list[Ints] = []
        near: list[Ints] = []
        total = offset = 0
        for key, own in todo.items():
            samples = sample_octant(own, spec.cell_size, spec.steps, spec.fillet)
            piece = raw_octant(samples, spec.cell_size)
            if used and total + len(piece.vertices) > BATCH_VERTICES:
                break
            used.append(key)
            raw.append(piece)
            solid.append(samples[:: spec.steps, :: spec.steps, :: spec.steps] < 0.0)
            primitives.append(own)
            if len(piece.vertices):
                count, index = _near(piece.vertices, own, spec.reach)
                counts.append(count)
                near.append(index + offset)
            total += len(piece.vertices)
            offset += len(own)
        first = np.cumsum([0] + [len(piece.vertices) for piece in raw])
        place = np.concatenate([piece.place for piece in raw])
        none = np.zeros(0, np.int64)
        field = Field(
            sdf.join(*primitives),
            np.concatenate([[0], np.cumsum(np.concatenate([none, *counts]))]).astype(np.int64),
            np.concatenate([none, *near]),
            spec.fillet,
        )
        whole = Surface(
            np.concatenate([piece.vertices for piece in raw]),
            np.concatenate([piece.triangles + k for piece, k in zip(raw, first[:-1], strict=True)]),
            place,
            np.full(place.shape, -1, np.int64),
            field,
            spec.edge,
            spec.step,
            np.repeat(np.arange(len(raw)), np.diff(first)),
            0.5 * spec.cell_size,
        )
        return _Batch(used, raw, solid, whole, 0.5 * spec.cell_size / STEPS)

    def split(self, refined: Surface, order: Ints) -> dict[OctantKey, Octant]:
        """The refined surface cut into the octants again, with how far each strays."""
        # Pieces are runs of vertices.
        begin = np.searchsorted(refined.piece, np.arange(len(self.raw) + 1))
        owner = refined.piece[refined.triangles[:, 0]]
        by_piece = np.argsort(owner, kind="stable")
        cuts = np.searchsorted(owner[by_piece], np.arange(len(self.raw) + 1))
        stray = np.zeros(len(self.raw))
        if refined.field.fillet == 0.0:  # otherwise values are no distances
            np.maximum.at(stray, owner, all_stray(refined, 0.0))
        result = {}
        for k, key in enumerate(self.keys):
            part = slice(begin[k], begin[k + 1])
            vertices = np.rint(refined.vertices[part] / self.step) * self.step
            triangles = refined.triangles[by_piece[cuts[k] : cuts[k + 1]]] - begin[k]
            octant = ranked_octant(
                vertices, triangles, refined.place[part], order[part], self.solid_corners[k]
            )
            result[key] = replace(octant, stray=float(stray[k]))
        return result


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
    entity = (place.astype(np.int64) * np.array([9, 3, 1])).sum(axis=1)
    return Octant(
        vertices,
        triangles.astype(np.int32),
        entity.astype(np.int8),
        _ranks(entity, order),
        solid_corners,
    )


def _near(points: Floats, primitives: Primitives, reach: float) -> tuple[Ints, Ints]:
    """For every point how many and which primitives are up to `reach` beyond the nearest."""
    counts, index = [], []
    chunk = max(1, 1_000_000 // max(len(primitives), 1))
    for k in range(0, len(points), chunk):
        distance = sdf.distances(points[k : k + chunk, None], primitives)
        is_near = distance <= distance.min(axis=1, keepdims=True).clip(min=0.0) + reach
        counts.append(is_near.sum(axis=1))
        index.append(np.nonzero(is_near)[1])
    return np.concatenate(counts), np.concatenate(index)


def _ranks(entity: Ints, order: Ints) -> NDArray[np.int32]:
    """Number of every vertex within its entity, by `order`."""
    sequence = np.lexsort((order, entity))
    count = np.bincount(entity, minlength=27)
    start = np.cumsum(count) - count
    rank = np.empty(len(entity), np.int32)
    rank[sequence] = np.arange(len(entity)) - start[entity[sequence]]
    return rank
