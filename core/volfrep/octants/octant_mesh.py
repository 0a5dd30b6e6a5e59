# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octant meshing, done once a pattern: sample, contour, remesh, fit, untangle.

Octants whose samples near the surface are equal, and whose field at the facets is, share one mesh:
most patterns differ by struts that end inside a joint.
"""

from __future__ import annotations

import hashlib
import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from enum import Enum
from functools import reduce

import numpy as np

from ..design.cells import UnitCell
from ..design.spec_parts import Resolution, Struts
from ..mesh import remesh
from ..mesh.topology import touching, vertices_of
from ..util.errors import VolfrepError
from ..util.linalg import lengths
from ..util.progress import Monitor
from ..util.types import Floats, Ints
from .batch import Batch, sample_all
from .constrained_mesh import Meshed, Surface
from .exchanged_axes import Axes, copies, forms, orders_between, values_at_facets
from .isotropic_remesh import remesh_evenly
from .octant import (
    ALL_ACTIVE,
    Octant,
    OctantKey,
    octant_primitives,
)
from .octant_spec import OctantSpec
from .refinement import (
    coarser,
    flipped_nearer,
    split_where_it_deviates,
    surface_deviations,
    with_vertices,
)
from .sdf import Primitives
from .surface_fit import fit_facets, missed_volume
from .untangle import crossing_facets, untangle
from .windows import sampled_finely_enough

#: Samples are clamped to so many steps: farther from the surface only their sign matters.
SEEN_STEPS = 2.0
#: How far facets may stray, in deviations, after vertices that are not needed are merged, and after
#: facets that stray are divided: 1.5 is what is promised.
MERGED_TO = 1.15
DIVIDED_TO = 1.45
#: Facets that stray by more than this part of it are looked at closely.
LOOKED_AT = 0.8
#: About facets that are divided, and those with sharper angles than `SHARPEST`, so many rings of
#: facets are fitted; what lies farther is as it was.
RINGS = 3
#: A piece of fewer facets is fitted whole: where all is near all else, that brings it nearer.
SMALL = 400
#: A place (see `PinnedMesh`) that no face has: of vertices that stay.
STAYS = np.int8(3)
#: So often, at most, facets are divided.
REFINEMENTS = 16
#: Steps of the fit after vertices are merged, and after facets are divided.
REFITS = (2, 4)
#: Of a piece no more facets are divided when it has this many and so many times those that it began
#: with: a ball's eighth begins with nine.
ROOM, GROWTH = 50, 2.0
#: Nor when in so many rounds its worst facet has come nearer by less than this.
STALLED, NEARER = 8, 0.95
#: Sine of the smallest angle that facets may be left with: a piece with sharper ones is fitted so
#: often more, and counts as farther by the root of how much sharper they are, by `FARTHER` at
#: most. What strays however it is divided, as where a crease runs out, would end in needles.
SHARPEST = 0.088
EASED = 2
FARTHER = 2.0
#: An octant whose facets become so many times as many as they are divided had most of them stray a
#: little, as where a row too few runs round a strut: edges so many times smaller are tried then,
#: which have to do with so much fewer.
MANY_DIVIDED = 1.4
SMALLER = 1.05, 1.1
FEWER = 0.9
#: One of a lattice without end.
ENDLESS = OctantKey(0, ALL_ACTIVE)


class FacetsCross(VolfrepError):
    """Facets of an octant run through each other, whatever is done about it."""


class _TooMany(Exception):
    """An octant comes to more facets than are wanted: to `count`."""

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.count = count


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
    surfaces are the same, or are so with their axes exchanged, are meshed once.

    All have edges a little smaller than wanted where an octant of a lattice without end, if that is
    among them, keeps the deviation with fewer facets then.

    Raises:
        FacetsCross: there is an octant whose facets run through each other, however it is meshed.
    """
    spec = sampled_finely_enough(cell, spec)
    try:
        return _mesh_kinds(cell, spec, keys, monitor, lambda even: MANY_DIVIDED * even)
    except _TooMany as many:
        most = FEWER * many.count
    for times in SMALLER:
        facets = math.ceil(times * spec.facets)
        smaller = replace(spec, facets=facets, within=spec.facets)
        try:
            return _mesh_kinds(cell, smaller, keys, monitor, lambda _: most)
        except (_TooMany, FacetsCross):
            continue
    return _mesh_kinds(cell, spec, keys, monitor)


def _mesh_kinds(
    cell: UnitCell,
    spec: OctantSpec,
    keys: Sequence[OctantKey],
    monitor: Monitor,
    most: Callable[[int], float] | None = None,
) -> dict[OctantKey, Octant]:
    """As `mesh_octants`, with edges as wanted.

    Of the facets that an octant of a lattice without end has before any are divided `most` tells
    how many they may become.

    Raises:
        FacetsCross: as there.
        _TooMany: they become more.
    """
    # What an octant's surface may consist of, as far as its vertices may move.
    primitives = {
        key: octant_primitives(cell, key, spec.cell_size, spec.strut_radius, spec.reach)
        for key in dict.fromkeys(keys)
    }
    groups: dict[bytes, list[OctantKey]] = {}
    firsts: dict[bytes, tuple[OctantKey, list[bytes]]] = {}
    exchanged: dict[OctantKey, tuple[OctantKey, list[Axes]]] = {}
    for key, samples in sample_all(spec, primitives):
        seen = np.clip(samples, -SEEN_STEPS * spec.step, SEEN_STEPS * spec.step)
        group = groups.setdefault(hashlib.blake2b(seen.tobytes()).digest(), [])
        if not group:
            own = forms(seen, spec.step)
            first, its = firsts.setdefault(min(own), (key, own))
            if first != key:
                exchanged[key] = first, orders_between(its, own)
        group.append(key)
        monitor.tick()
    result: dict[OctantKey, Octant] = {}
    _mesh(spec, {key: primitives[key] for key, _ in firsts.values()}, result, monitor, most)
    result.update(copies(spec, primitives, exchanged, result, DIVIDED_TO * spec.deviation))
    others = {key: primitives[key] for key in exchanged if key not in result}
    _mesh(spec, others, result, monitor)
    for group in groups.values():
        octant = result[group[0]]
        result.update(dict.fromkeys(_alike(spec, octant, group, primitives), octant))
    rest = {key: own for key, own in primitives.items() if key not in result}
    _mesh(spec, rest, result, monitor)
    return result


def mesh_elsewhere(
    cell: UnitCell, spec: OctantSpec, keys: Sequence[OctantKey]
) -> tuple[dict[OctantKey, Octant], dict[str, int]]:
    """As `mesh_octants`, which any process may do, and what was done, counted.

    Raises:
        FacetsCross: as there.
    """
    monitor = Monitor()
    return mesh_octants(cell, spec, keys, monitor), monitor.work


def _mesh(
    spec: OctantSpec,
    primitives: Mapping[OctantKey, Primitives],
    result: dict[OctantKey, Octant],
    monitor: Monitor,
    most: Callable[[int], float] | None = None,
) -> None:
    """Mesh octants, each by itself, and put them to the others.

    Raises:
        FacetsCross: there is an octant whose facets run through each other, however it is meshed.
        _TooMany: as of `_mesh_kinds`.
    """
    todo = list(primitives)
    while todo:
        batch = Batch.of(spec, {key: primitives[key] for key in todo})
        todo = todo[len(batch.keys) :]
        result.update(_meshed(spec, batch, monitor, most))
        monitor.tick(1.0 - len(todo) / len(primitives))
    monitor.count("kinds of octants meshed", len(primitives))


def _meshed(
    spec: OctantSpec, batch: Batch, monitor: Monitor, most: Callable[[int], float] | None
) -> dict[OctantKey, Octant]:
    """The octants of a batch: those whose facets cross once more, in the next manner.

    Raises:
        FacetsCross: there is one whose facets run through each other, however it is meshed.
        _TooMany: as of `_mesh_kinds`.
    """
    result: dict[OctantKey, Octant] = {}
    farthest = DIVIDED_TO * spec.deviation
    even = _bordered(*remesh_evenly(batch.surface, asked=monitor.tick), batch, farthest)
    gentle: Meshed | None = None
    left = np.ones(len(batch.keys), bool)
    # Facets that touch are better than none, where nothing keeps them apart.
    for exact, manner in itertools.product((True, False), _Manner):
        if manner is _Manner.GENTLE:
            if gentle is None:
                evened = remesh_evenly(batch.surface, gently=True, asked=monitor.tick)
                gentle = _bordered(*evened, batch, farthest)
            meshed = gentle
        else:
            meshed = even
        meshed = meshed.where(left[meshed.surface.piece])
        if manner is _Manner.COARSE_AND_FINE:
            # To draw facets apart moves them off the surface, and smaller ones less.
            meshed = _refined(_coarsened(meshed, spec.deviation), spec.deviation, monitor)
            if most is not None and ENDLESS in batch.keys:
                piece = batch.keys.index(ENDLESS)
                before, now = (each.surface.facets_of(piece) for each in (even, meshed))
                if now > most(before):
                    raise _TooMany(now)
            fitted, crossed = meshed.surface, crossing_facets(meshed.surface, exact)
        else:
            if manner is _Manner.FINE:
                meshed = _refined(meshed, spec.deviation, monitor)
            fitted, crossed = untangle(meshed.surface, meshed.home, exact, monitor.tick)
        bad = np.zeros(len(left), bool)
        bad[fitted.piece[fitted.triangles[crossed, 0]]] = True
        result.update(batch.split(replace(meshed, surface=fitted), left & ~bad))
        left = bad
        if not left.any():
            return result
    raise FacetsCross(
        f"Where struts meet, facets of a {spec.facets}th of a cell run through each other: "
        "choose another resolution or strut radius, or move the nodes of the cell."
    )


def _bordered(remeshed: Surface, origin: Ints, batch: Batch, farthest: float) -> Meshed:
    """The surface fitted, with more vertices where its border strays by more than that, mm."""
    found = batch.bordered(remeshed, origin, farthest)
    surface = found.surface
    surface = replace(surface, field=surface.field.anchored(surface.vertices))
    return replace(found, surface=fit_facets(surface))


def _coarsened(meshed: Meshed, deviation: float) -> Meshed:
    """With vertices merged that facets within a deviation in mm do without."""
    farthest = MERGED_TO * deviation
    fewer, stay = coarser(meshed.surface, farthest)
    if len(stay) == len(meshed.home):
        return meshed
    fewer = fit_facets(flipped_nearer(fewer, farthest), farthest, REFITS[0])
    return meshed.of(fewer, stay)


def _refined(meshed: Meshed, deviation: float, monitor: Monitor) -> Meshed:
    """With more vertices where facets stray, which is where struts meet, until none does.

    A piece that strays however it is divided, as where a crease runs out, stays as it was before
    that made needles of facets.
    """
    farthest = DIVIDED_TO * deviation
    rounds: list[Meshed] = []
    reached: list[Floats] = []
    beyond: list[Ints] = []
    sines: list[Floats] = []
    pieces = int(meshed.surface.piece[-1]) + 1 if len(meshed.surface.piece) else 0
    count = np.bincount(meshed.surface.piece[meshed.surface.triangles[:, 0]], None, pieces)
    most, eased = ROOM + GROWTH * count, np.zeros(pieces, np.int64)
    deviations = surface_deviations(meshed.surface, LOOKED_AT * farthest)
    missed = missed_volume(meshed.surface, pieces)
    while True:
        monitor.tick()
        surface = meshed.surface
        owner, sine = surface.piece[surface.triangles[:, 0]], _sines(surface)
        reached.append(np.where(np.isin(np.arange(pieces), surface.piece), 0.0, np.inf))
        np.maximum.at(reached[-1], owner, deviations)
        beyond.append(np.bincount(owner[deviations > farthest], minlength=pieces))
        sines.append(np.ones(pieces))
        np.minimum.at(sines[-1], owner, sine)
        rounds.append(meshed)
        if len(rounds) > REFINEMENTS:
            break
        far = (reached[-1] > farthest) & (np.bincount(owner, minlength=pieces) < most)
        if surface.field.fillet > 0.0 and len(rounds) > 1:
            # Where fillets' field bends faster than facets can, it is not for want of vertices.
            idle = (beyond[-1] >= beyond[-2].clip(1)) & (reached[-1] >= NEARER * reached[-2])
            reached[-1][idle] = np.inf
            far &= ~idle
        if len(rounds) > STALLED:
            far &= reached[-1] < NEARER * reached[-1 - STALLED]
        # What was divided last is sharp until the vertices about it have moved apart.
        ease = (reached[-1] <= farthest) & (sines[-1] < SHARPEST) & (eased < EASED)
        ease &= len(rounds) > 1
        eased += ease
        left = far | ease
        meshed = meshed.where(left[surface.piece])
        divided = _divided(meshed, deviations[left[owner]], sine[left[owner]], farthest, missed)
        if divided is None:
            break
        meshed, deviations, missed = divided
    # The last round of each piece that is nearly as near as any.
    weight = np.sqrt(SHARPEST / np.array(sines).clip(1e-9)).clip(1.0, FARTHER)
    value = np.array(reached).clip(farthest) * weight
    enough = np.maximum(value.min(axis=0) / NEARER, farthest)
    chosen = len(rounds) - 1 - np.argmax((value <= enough)[::-1], axis=0)
    parts = [part.where((chosen == k)[part.surface.piece]) for k, part in enumerate(rounds)]
    return reduce(Meshed.joined, parts)


def _divided(
    meshed: Meshed, deviations: Floats, sines: Floats, farthest: float, missed: Floats
) -> tuple[Meshed, Floats, Floats] | None:
    """With more vertices where facets stray, and what is about these and sharp ones fitted.

    Args:
        meshed: fitted.
        deviations: (m,) how far its facets stray, mm.
        sines: (m,) of their smallest angles.
        farthest: facets may stray so far, mm.
        missed: (pieces,) the volume that they miss, mm3.

    Returns:
        The mesh, how far its facets stray and what they miss; None where nothing is to be done.
    """
    surface = meshed.surface
    triangles, count = surface.triangles, len(surface.vertices)
    sharp = sines < SHARPEST
    near = (deviations > farthest) | sharp
    for _ in range(RINGS):
        near = touching(vertices_of(triangles[near], count), triangles)
    owner = surface.piece[triangles[:, 0]]
    near |= (np.bincount(owner) < SMALL)[owner]
    within = vertices_of(triangles[near], count)
    index = np.flatnonzero(within)
    # What the rest has, too, stays, and no edge of the rest is made once more.
    beside = vertices_of(triangles[~near], count)[index]
    place = np.where(beside[:, None] & (surface.place[index] == 1), STAYS, surface.place[index])
    window = replace(
        surface, vertices=surface.vertices[index],
        triangles=(np.cumsum(within) - 1)[triangles[near]], place=place,
        held=surface.held[index], field=surface.field.rows(index), piece=surface.piece[index],
    )  # fmt: skip
    finer, parents = split_where_it_deviates(window, deviations[near], farthest)
    if finer is window and not sharp.any():
        return None
    rest = missed - missed_volume(window, len(missed))
    wanted = -rest[: window.piece.max() + 1]
    finer = fit_facets(flipped_nearer(finer, farthest), farthest, REFITS[1], wanted)
    found = surface_deviations(finer, LOOKED_AT * farthest)
    # The window put back.
    fresh = np.flatnonzero(parents[:, 0] != parents[:, 1])
    number = index[parents[:, 0]]
    number[fresh] = count + np.arange(len(fresh))
    vertices = surface.vertices.copy()
    old = number < count
    vertices[number[old]] = finer.vertices[old]
    whole, parents = with_vertices(
        replace(surface, vertices=vertices),
        np.concatenate([triangles[~near], number[finer.triangles]]),
        index[parents[fresh]], finer.vertices[fresh], finer.place[fresh],
    )  # fmt: skip
    missed = rest + missed_volume(finer, len(missed))
    return meshed.of(whole, parents), np.concatenate([deviations[~near], found]), missed


def _sines(surface: Surface) -> Floats:
    """(m,) the sines of the smallest angles of the facets."""
    corners = surface.vertices[surface.triangles]
    sides = np.sort(np.stack(remesh.side_lengths(corners), axis=1), axis=1)
    sine: Floats = lengths(remesh.normals(corners)) / np.maximum(sides[:, 1] * sides[:, 2], 1e-300)
    return sine


def _alike(
    spec: OctantSpec,
    octant: Octant,
    group: list[OctantKey],
    primitives: Mapping[OctantKey, Primitives],
) -> list[OctantKey]:
    """Which octants have the surface of their group's first one, by the field at its facets.

    The samples said so already; a strut that shows between them only is found here.
    """
    others = group[1:]
    if not len(octant.triangles) or not others:
        return others
    wanted, *values = (values_at_facets(octant, primitives[key], spec.fillet) for key in group)
    return [key for key, own in zip(others, values, strict=True) if np.array_equal(own, wanted)]
