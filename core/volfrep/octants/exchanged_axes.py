# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants that are others with their axes exchanged: one of them is meshed, the others follow it.

A cell that rotations of a cube leave as it is has up to six such octants. What lies in a face must
be what the octant beyond has there, and rounding, and choices between places that are equally near,
depend on which axis is the first. So each octant's border is made in its own frame, as for meshing:
only where it is the other's with its axes exchanged is the inside taken over.
"""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ..mesh import remesh
from ..util.types import Bools, Floats, Ints
from . import sdf
from .batch import ENTITY_WEIGHTS, Batch
from .constrained_mesh import PinnedMesh
from .isotropic_remesh import remesh_evenly
from .octant import Octant, OctantKey
from .octant_spec import OctantSpec
from .sdf import Primitives
from .untangle import crossing_facets

#: Samples that are the same in whole steps of this part of the sampling step are so but for
#: rounding.
SAMPLE_STEP = 2.0**-20
#: So are, in wanted edges, vertices of the border and values of the field.
ALIKE = 1e-6
#: So many times farther apart are places that are told from each other; no round number lies
#: between two such steps.
COARSELY, BESIDE = 1000.0, 0.38

#: An octant's axes in the order of another one's.
Axes = tuple[int, ...]
ORDERS: list[Axes] = list(itertools.permutations(range(3)))


def forms(samples: Floats, step: float) -> list[bytes]:
    """(6,) digests of an octant's samples, its axes in every order: another's has them, too.

    Args:
        samples: (s, s, s) signed distances, mm.
        step: between them, mm.
    """
    rounded = np.rint(samples * (1.0 / (SAMPLE_STEP * step))).astype(np.int32)
    return [hashlib.blake2b(rounded.transpose(axes).tobytes()).digest() for axes in ORDERS]


def orders_between(first: list[bytes], own: list[bytes]) -> list[Axes]:
    """In which orders the axes of the first octant are those of another, by the forms of both."""
    return [axes for axes, form in zip(ORDERS, first, strict=True) if form == own[0]]


def values_at_facets(octant: Octant, primitives: Primitives, fillet: float) -> Floats:
    """The signed distance at an octant's vertices and the middles of its facets, mm."""
    middles = octant.vertices[octant.triangles].mean(axis=1)
    points = np.concatenate([octant.vertices, middles])[:, None]
    return sdf.union(sdf.distances(points, primitives), fillet)


def copies(
    spec: OctantSpec,
    primitives: Mapping[OctantKey, Primitives],
    firsts: Mapping[OctantKey, tuple[OctantKey, list[Axes]]],
    meshed: Mapping[OctantKey, Octant],
    farthest: float,
) -> dict[OctantKey, Octant]:
    """Octants that are others with their axes exchanged.

    Args:
        spec: what they are meshed for.
        primitives: of all octants.
        firsts: of which octants copies are wanted, and in which orders these axes are theirs: of
            what looks the same in several, one may have the border.
        meshed: those octants.
        farthest: edges of the border stray no farther, mm.

    Returns:
        Those that have the border and the field of the one that they are made of, and whose facets
        do not cross.
    """
    result: dict[OctantKey, Octant] = {}
    todo = list(firsts)
    while todo:
        batch = Batch.of(spec, {key: primitives[key] for key in todo})
        todo = todo[len(batch.keys) :]
        bordered = batch.bordered(*remesh_evenly(batch.surface, gently=True), farthest)
        made: dict[OctantKey, Octant] = {}
        for key, own in batch.octants(bordered, np.ones(len(batch.keys), bool)):
            first, orders = firsts[key]
            tries = (
                _on_border(_exchanged(meshed[first], axes), own, ALIKE * spec.edge)
                for axes in orders
            )
            copy = next((octant for octant in tries if octant is not None), None)
            if copy is None:
                continue
            wanted = values_at_facets(meshed[first], primitives[first], spec.fillet)
            values = values_at_facets(copy, primitives[key], spec.fillet)
            if np.abs(values - wanted).max() < ALIKE * spec.edge:
                made[key] = copy
        crossed = _crossed(spec, list(made.values()))
        result.update((key, made[key]) for key, bad in zip(made, crossed, strict=True) if not bad)
    return result


def _exchanged(octant: Octant, axes: Axes) -> Octant:
    """An octant with its axes in another order; its ranks are as they were."""
    order = list(axes)
    odd = (order[1] - order[0]) % 3 == 2  # mirrors it
    return replace(
        octant,
        vertices=np.ascontiguousarray(octant.vertices[:, order]),
        triangles=np.ascontiguousarray(octant.triangles[:, ::-1]) if odd else octant.triangles,
        entity=(octant.places[:, order] * ENTITY_WEIGHTS).sum(axis=1).astype(np.int8),
        solid_corners=np.ascontiguousarray(octant.solid_corners.transpose(order)),
    )


def _on_border(octant: Octant, own: Octant, tolerance: float) -> Octant | None:
    """The octant with the border of another one, to the bit; None where its own is different.

    Args:
        octant: whose inside is wanted.
        own: whose border is.
        tolerance: vertices of the border are nearer to each other, mm.
    """
    mine, same = (_border_in_order(part, COARSELY * tolerance) for part in (octant, own))
    if not len(mine) or len(mine) != len(same):
        return None
    away = np.abs(octant.vertices[mine] - own.vertices[same])
    number = np.full(len(octant.vertices), -1)
    number[mine] = same
    as_own = (
        away.max() < tolerance
        and np.array_equal(octant.entity[mine], own.entity[same])
        and np.array_equal(octant.solid_corners, own.solid_corners)
        and np.array_equal(
            np.unique(number[_open_edges(octant)], axis=0),
            np.unique(_open_edges(own), axis=0),
        )
    )
    if not as_own:
        return None
    vertices, rank = octant.vertices.copy(), octant.rank.copy()
    vertices[mine], rank[mine] = own.vertices[same], own.rank[same]
    return replace(octant, vertices=vertices, rank=rank)


def _border_in_order(octant: Octant, step: float) -> Ints:
    """The vertices of the border by their entities and then their places, in whole steps of mm."""
    index = np.flatnonzero((octant.places != 1).any(axis=1))
    places = np.floor(octant.vertices[index] / step + BESIDE)
    return np.asarray(index[np.lexsort((*places.T, octant.entity[index]))])


def _open_edges(octant: Octant) -> Ints:
    """(k, 2) the edges of the surface's border, as its facets run."""
    table = remesh.edges(octant.triangles.astype(np.int64), len(octant.vertices))
    return table.ends[table.triangles[:, 1] < 0]


def _crossed(spec: OctantSpec, octants: list[Octant]) -> Bools:
    """(k,) in which octants facets run through each other."""
    if not octants:
        return np.zeros(0, bool)
    first = np.cumsum([0] + [len(octant.vertices) for octant in octants])
    piece = np.repeat(np.arange(len(octants)), np.diff(first))
    triangles = [one.triangles + begin for one, begin in zip(octants, first[:-1], strict=True)]
    together = PinnedMesh(
        np.concatenate([octant.vertices for octant in octants]),
        np.concatenate(triangles).astype(np.int64),
        np.concatenate([octant.places for octant in octants]).astype(np.int8),
        spec.edge,
        spec.step,
        piece,
        0.5 * spec.cell_size,
    )
    crossed = np.zeros(len(octants), bool)
    crossed[piece[together.triangles[crossing_facets(together), 0]]] = True
    return crossed
