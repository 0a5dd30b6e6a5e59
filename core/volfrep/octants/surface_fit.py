# SPDX-License-Identifier: LGPL-2.1-or-later
"""Least-squares fit of the facets to the exact surface, so that the volume is right.

The facets of a mesh with its vertices on a strut cut inside it: ten round a strut lose 6 % of its
volume. Here the vertices move to where the mean square distance of the facets to the exact surface
is least. The facets then stray to both sides alike, and so volume, mass and stiffness are right:
the normal equations of the fit set the mean distance about every vertex to zero.
"""

from __future__ import annotations

import numpy as np

from ..mesh import remesh
from ..util.linalg import along, normalize, solve_symmetric
from ..util.types import Floats, Ints
from .constrained_mesh import (
    Surface,
    between_samples,
    move_vertices,
    neighbour_mean,
    shorten_steps,
    step_to_primitives,
)
from .sdf import Field
from .untangle import proper_border

#: Steps of the fit.
FIT_PASSES = 4
#: How strongly the fit draws a vertex along the surface, against its hold across it.
DRIFT = 0.03
#: No step is longer than this part of the shortest edge of its vertex.
STEP = 0.3
#: Facets that stray weigh more in the fit: by this, and the square of how far they stray.
STRAYING = 20.0
#: Points that are looked at at a time: cells of many struts would take gigabytes.
AT_ONCE = 1 << 17
#: The last correction of the volume moves no vertex further than this, in wanted edges.
BALANCE_REACH = 0.05

# Three points inside a triangle and their weights, exact to degree 2.
QUADRATURE = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4]]) / 6.0
QUADRATURE_WEIGHTS = np.full(3, 1.0 / 3.0)


def fit_border(remeshed: Surface) -> Surface:
    """The border fitted, each vertex in its face, as the octant beyond does it.

    Args:
        remeshed: what `volfrep.octants.isotropic_remesh.remesh_evenly` made.
    """
    if not len(remeshed.triangles):
        return remeshed
    return proper_border(remeshed, _offset_border(remeshed))


def fit_facets(
    surface: Surface,
    farthest: float | None = None,
    passes: int = FIT_PASSES,
    missed: Floats | float = 0.0,
) -> Surface:
    """The facets fitted to the exact surface, those on the border as they are, volume put right.

    Args:
        surface: its vertices near the exact surface.
        farthest: how far facets should stray at most, mm: those that stray farther weigh more.
            None for least squares.
        passes: steps of the fit.
        missed: what the facets are left to miss of the volume, (pieces,) mm3: of a part of a
            piece that what the rest misses.
    """
    if not len(surface.triangles):
        return surface
    for _ in range(passes):
        surface = _fit(surface, farthest)
    for _ in range(2):
        surface = _balance(surface, missed)
    return surface


def _offset_border(surface: Surface) -> Surface:
    """The border's vertices moved outwards, in their faces, by what the fit gives inside.

    The border of even facets, of edge e, on a surface of curvature k strays inwards from its
    corners by e2 k / 16 in the mean. Inside the octant the fit finds that by itself; on a face it
    must not depend on the mesh, which is another one beyond the face.
    """
    index = np.flatnonzero(surface.pinned.any(axis=1))
    if not len(index):
        return surface
    field = surface.field.rows(index)
    points, loose = surface.vertices[index], ~surface.pinned[index]
    held = surface.held[index]
    level = surface.edge**2 * _curvature(field, points, held, surface.edge) / 16.0
    single = held[:, 0] < 0
    held = held.copy()
    if field.fillet <= 0.0:
        held[single, 0] = field.nearest(points)[1][single]
        for _ in range(2):
            points = points + shorten_steps(
                step_to_primitives(surface, points, held, loose, level), 0.2 * surface.edge
            )
    else:
        for _ in range(2):
            value, gradient = field.values_and_gradients(points)
            gradient = gradient * loose
            size = np.maximum(np.einsum("ij,ij->i", gradient, gradient), 0.05)
            points = points - shorten_steps(
                gradient * ((value - level) / size)[:, None], 0.2 * surface.edge
            )
    on_edge = (~loose).sum(axis=1) == 2
    low, high = between_samples(surface, index[on_edge])
    points[on_edge] = np.clip(points[on_edge], low, high)
    vertices = surface.vertices.copy()
    vertices[index] = points
    return move_vertices(surface, vertices)


def _curvature(field: Field, points: Floats, held: Ints, edge: float) -> Floats:
    """The curvature of the surface at points on it, 1/mm, positive where it is convex.

    On a crease the largest of the primitives that hold the points, (k, 3): each of these is the
    nearest, but for rounding, and the octant beyond a face rounds otherwise. Of a rounded joint
    k1 + k2, and no more than a strut has.
    """
    primitives = field.primitives
    if field.fillet <= 0.0:
        nearest = 1.0 / primitives.radius[field.nearest(points)[1]]
        several = np.where(held >= 0, 1.0 / primitives.radius[held], 0.0).max(axis=1)
        return np.where(held[:, 0] >= 0, several, nearest)
    step = 0.2 * edge
    total = -6.0 * field.values(points)
    for axis in range(3):
        for sign in (-step, step):
            shifted = points.copy()
            shifted[:, axis] += sign
            total += field.values(shifted)
    limit = 1.0 / primitives.radius.min()
    return np.clip(total / step**2, -limit, limit)


def _fit(surface: Surface, farthest: float | None) -> Surface:
    """One step of the least squares fit of the facets to the exact surface.

    A facet's point x = sum b_i v_i moves by sum b_i d_i and its distance f by grad f . that. Each
    vertex solves for its own d as if its neighbours moved alike (row sums for the matrix), which
    keeps the step from overshooting, and is drawn weakly to the middle of its neighbours along
    the surface, in the directions that the fit leaves open.
    """
    triangles, count = surface.triangles, len(surface.vertices)
    area, value, gradient = _sampled(surface)
    if farthest is not None:
        area = area * (1.0 + STRAYING * (value / farthest) ** 2).max(axis=1)
    products = np.concatenate(
        [
            np.einsum("mqi,mqj->mqij", gradient, gradient).reshape(*value.shape, 9),
            value[:, :, None] * gradient,
            gradient,
        ],
        axis=2,
    )
    total = np.zeros((count, 15))
    for corner in range(3):
        share = area[:, None] * QUADRATURE_WEIGHTS * QUADRATURE[:, corner]
        local = np.einsum("mq,mqk->mk", share, products)
        for k in range(15):
            total[:, k] += np.bincount(triangles[:, corner], local[:, k], minlength=count)
    matrix, right, normal = total[:, :9].reshape(-1, 3, 3), total[:, 9:12], total[:, 12:]
    normal = normalize(normal)
    pairs = np.concatenate([triangles[:, :2], triangles[:, 1:], triangles[:, ::2]])
    mean, _ = neighbour_mean(count, pairs, surface.vertices)
    drift = mean - surface.vertices
    drift -= normal * np.einsum("ij,ij->i", normal, drift)[:, None]
    pull = DRIFT * np.trace(matrix, axis1=1, axis2=2) / 3.0
    matrix = matrix + (pull[:, None, None] + 1e-12) * np.eye(3)
    step = solve_symmetric(matrix, pull[:, None] * drift - right)
    step = np.where(surface.pinned.any(axis=1)[:, None], 0.0, step)
    # No vertex passes another one where edges are short.
    reach = np.full(count, 0.2 * surface.edge)
    length = STEP * np.linalg.norm(
        surface.vertices[pairs[:, 1]] - surface.vertices[pairs[:, 0]], axis=1
    )
    np.minimum.at(reach, pairs.ravel(), np.repeat(length, 2))
    return move_vertices(surface, surface.vertices + shorten_steps(step, reach))


def _sampled(surface: Surface) -> tuple[Floats, Floats, Floats]:
    """(m,) areas of the facets, and (m, q) values and (m, q, 3) gradients of the field in them."""
    corners = surface.vertices[surface.triangles]
    points = np.einsum("qi,mik->mqk", QUADRATURE, corners).reshape(-1, 3)
    rows = surface.triangles.ravel()  # each of the points is nearest to one of the corners
    parts = [
        surface.field.rows(rows[begin : begin + AT_ONCE]).values_and_gradients(
            points[begin : begin + AT_ONCE]
        )
        for begin in range(0, len(rows), AT_ONCE)
    ]
    value, gradient = (np.concatenate(part) for part in zip(*parts, strict=True))
    area = 0.5 * np.linalg.norm(remesh.normals(corners), axis=1)
    return area, value.reshape(len(area), -1), gradient.reshape(len(area), -1, 3)


def missed_volume(surface: Surface, pieces: int) -> Floats:
    """(pieces,) the volume that the facets miss: the integral of the distance over them, mm3."""
    if not len(surface.triangles):
        return np.zeros(pieces)
    area, value, _ = _sampled(surface)
    return _missed(surface, area, value, pieces)


def _missed(surface: Surface, area: Floats, value: Floats, pieces: int) -> Floats:
    missed = area * along(value, QUADRATURE_WEIGHTS)
    return np.asarray(np.bincount(surface.piece[surface.triangles[:, 0]], missed, pieces))


def _balance(surface: Surface, wanted: Floats | float) -> Surface:
    """The volume of every piece put right.

    Its inner vertices move along the surface's normal, all by the same amount, so that the facets
    miss what is wanted of the volume.
    """
    triangles, count, piece = surface.triangles, len(surface.vertices), surface.piece
    area, value, gradient = _sampled(surface)
    missed = _missed(surface, area, value, piece.max() + 1) - wanted
    free = ~surface.pinned.any(axis=1)
    swept = np.bincount(piece[triangles[:, 0]], area * free[triangles].sum(axis=1) / 3.0)
    amount = np.zeros(piece.max() + 1)
    some = np.flatnonzero(swept > 0.0)
    amount[some] = -missed[some] / swept[some]
    limit = BALANCE_REACH * surface.edge
    flux = area[:, None] * np.einsum("q,mqk->mk", QUADRATURE_WEIGHTS, gradient)
    sums = [
        np.bincount(triangles.ravel(), np.repeat(flux[:, k], 3), minlength=count) for k in range(3)
    ]
    normal = normalize(np.stack(sums, axis=1))
    step = np.clip(amount, -limit, limit)[piece][:, None] * normal
    return move_vertices(surface, surface.vertices + np.where(free[:, None], step, 0.0))
