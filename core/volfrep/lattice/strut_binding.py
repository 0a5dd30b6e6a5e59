# SPDX-License-Identifier: LGPL-2.1-or-later
"""Strut-local coordinates of template vertices, for deforming them onto graded struts.

A straight line along a strut's side, its ruling, leaves the strut's joint where it leaves the
last of the other struts and of the joint sphere: at the crease. A vertex is bound by its ruling,
by how far along it lies between the crease and the strut's middle, and by how far it stands off the
strut (facets fitted to a round strut have their corners outside it). With the same binding it has
a place on any strut: of another radius, a cone, turned or stretched, at a joint of other angles.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell, joint_radius
from ..grid.strut_graph import neighbour_table
from ..octants import sdf
from ..octants.octant import NEIGHBOURS, Octant, OctantKey, octant_graph
from ..octants.octant_spec import OctantSpec
from ..util.linalg import lengths
from ..util.types import Floats, Ints
from .strut_masks import cells_of_nodes

#: A vertex belongs to a joint sphere where that lies farther out than every strut by this, in r.
SPHERE_MARGIN = 0.02
#: Nodes on the far faces of the eight cells lack struts there; in units of L.
OUTERMOST = 1.0 - 1e-6
#: Rulings that run along another strut, in the square of the sine of the angle between them.
PARALLEL = 1e-9

#: Between its creases a strut must be at least this long, in units of its radius, on each side of
#: its middle.
LEAST_ROOM = 0.05

#: Creases that meet no farther than this from a strut beside them, in turns from one to the next,
#: meet at that strut.
AT_SIDE = 0.05

#: A place is inside another strut where it is farther along that by more than this part.
AS_FAR = 1e-6

#: A strut stands off another one by more than this, as the sine of the angle between them; and
#: struts whose directions across it differ by less than this, in radians, are behind one another.
STANDS_OFF = 1e-3
SAME_ANGLE = 1e-6

STRUT, SPHERE, SPACE = 0, 1, 2
#: Entities that are corners of the octant: only `caps.with_corners` puts vertices there.
_CORNER_ENTITIES = np.array([0, 2, 6, 8, 18, 20, 24, 26])


@dataclass(frozen=True, eq=False)
class StrutBinding:
    """The strut-local coordinates of the vertices of one kind of octant, in the octant's frame.

    Attributes:
        kind: (n,) int8, `STRUT`, `SPHERE` or `SPACE` (a corner of the octant, inside the lattice).
        copy: (k,) int64, bit number of the cell of `octant.NEIGHBOURS` that a node belongs to.
        place: (k, 3) float64, where the node is in that cell, in units of L.
        near: (n,) int64, row of the node whose joint the vertex is at.
        far: (n,) int64, row of the strut's other end; that of `near` for a sphere.
        left: (n,) row of the node whose strut, seen along the vertex' own, comes next clockwise.
        right: (n,) the same counter-clockwise; `near` itself where no strut stands off the own.
        turn: (n,) how far the ruling lies from left to right, from 0 to 1.
        corner: (n,) the turn at which the creases with both of them meet; 0 where they do not.
        radial: (n, 3) unit vector from the strut's axis, or from the sphere's centre.
        along: (n,) position on the strut from the near node, in units of its length.
        share: (n,) position between crease (0) and the strut's middle (1); for a sphere, the angle
            that the vertex keeps from the nearest strut, radians.
        scale: (n,) distance from the axis or centre in units of the strut's or joint's radius.
        level: (n,) distance from the exact surface in units of the strut's radius.
    """

    kind: NDArray[np.int8]
    copy: Ints
    place: Floats
    near: Ints
    far: Ints
    left: Ints
    right: Ints
    turn: Floats
    corner: Floats
    radial: Floats
    along: Floats
    share: Floats
    scale: Floats
    level: Floats


def bind(cell: UnitCell, spec: OctantSpec, key: OctantKey, octant: Octant) -> StrutBinding:
    """Bind the vertices of an octant that `octant_mesh.mesh_octants` made to its struts."""
    size, radius = spec.cell_size, spec.strut_radius
    joint = joint_radius(radius, size)
    places, ends = octant_graph(cell, key)
    copies = cells_of_nodes(cell, key, places)
    nodes = places * size
    points = octant.vertices
    count = len(points)

    struts = sdf.struts(nodes[ends[:, 0]], nodes[ends[:, 1]], radius)
    spheres = sdf.spheres(nodes, joint)
    to_strut, to_joint = _nearest(points, struts), _nearest(points, spheres)
    every = sdf.distances(points[:, None], sdf.join(struts, spheres))
    level = sdf.union(every, spec.fillet) / radius
    kind = np.where(to_joint[0] < to_strut[0] - SPHERE_MARGIN * radius, SPHERE, STRUT)
    kind = np.where(np.isin(octant.entity, _CORNER_ENTITIES), SPACE, kind)

    # The nearer end, unless that is a node whose other struts are not all among the eight cells.
    chosen = ends[to_strut[1]]
    span = nodes[chosen[:, 1]] - nodes[chosen[:, 0]]
    length = np.linalg.norm(span, axis=1)
    axis = span / length[:, None]
    along = np.einsum("ij,ij->i", points - nodes[chosen[:, 0]], axis) / length
    outermost = np.abs(places).max(axis=1) > OUTERMOST
    turned = (along > 0.5) & ~outermost[chosen[:, 1]] | outermost[chosen[:, 0]]
    near = np.where(turned, chosen[:, 1], chosen[:, 0])
    far = np.where(turned, chosen[:, 0], chosen[:, 1])
    axis = np.where(turned[:, None], -axis, axis)
    along = np.where(turned, 1.0 - along, along)
    offset = points - nodes[near]
    offset -= np.einsum("ij,ij->i", offset, axis)[:, None] * axis
    off = np.linalg.norm(offset, axis=1)
    radial = offset / np.maximum(off, 1e-300)[:, None]

    neighbours = neighbour_table(ends, len(nodes))
    directions, others = _directions(nodes, neighbours, near, far)
    uniform = np.full(count, radius)
    start = crease(
        axis, radial, uniform, np.zeros(count), np.full(count, joint),
        directions, np.zeros(others.shape), others,
    )  # fmt: skip
    share = _shares(along * length, start, 0.5 * length, radius)

    left, right, turn = _between(nodes, neighbours, near, far, axis, radial)
    corner = np.zeros(count)
    some = np.flatnonzero((left != near) & (left != right))
    first, second = (nodes[row[some]] - nodes[near[some]] for row in (left, right))
    every, present = directions[some], neighbours[near[some]] >= 0
    meets = corner_turns(axis[some], first, second, axis[some], every, present)
    corner[some] = np.where((meets > AT_SIDE) & (meets < 1.0 - AT_SIDE), meets, 0.0)

    on_sphere = kind == SPHERE
    if on_sphere.any():
        centre = to_joint[1][on_sphere]
        for row in (near, far, left, right):
            row[on_sphere] = centre
        offset = points[on_sphere] - nodes[centre]
        off[on_sphere] = np.linalg.norm(offset, axis=1) * (radius / joint)
        radial[on_sphere] = offset / np.linalg.norm(offset, axis=1)[:, None]
        directions, others = _directions(nodes, neighbours, centre, centre)
        share[on_sphere] = angles_to_struts(radial[on_sphere], directions, others).min(
            axis=1
        ) - np.arcsin(radius / joint)
    used, number = np.unique(np.concatenate([near, far, left, right]), return_inverse=True)
    copy, rows = copies[used], number.reshape(4, count)
    return StrutBinding(
        kind.astype(np.int8),
        copy,
        places[used] - NEIGHBOURS[copy],
        rows[0],
        rows[1],
        rows[2],
        rows[3],
        turn,
        corner,
        radial,
        along,
        share,
        off / radius,
        level,
    )


def _shares(along: Floats, start: Floats, middle: Floats, radius: float) -> Floats:
    """(n,) positions between creases (0) and the middles of struts (1).

    Where the creases of a strut's two ends meet, what is left between them says nothing of where
    on it a vertex is: off it by a hair, it may be many times as far away. It is at the middle then,
    or as far from it as from where there would be just enough room.
    """
    room, least = middle - start, LEAST_ROOM * radius
    crowded = 1.0 + (along - middle) / least
    return np.where(
        room < least, np.clip(crowded, 0.0, 1.0), (along - start) / np.maximum(room, least)
    )


def _nearest(points: Floats, primitives: sdf.Primitives) -> tuple[Floats, Ints]:
    """(n,) distance to the nearest primitive, and which it is."""
    values = sdf.distances(points[:, None], primitives)
    nearest = values.argmin(axis=1)
    return values[np.arange(len(points)), nearest], nearest


def _directions(
    nodes: Floats, table: Ints, near: Ints, far: Ints
) -> tuple[Floats, NDArray[np.bool_]]:
    """(n, k, 3) directions of the struts at the near node; whether they are other struts."""
    ends = table[near]
    span = nodes[ends] - nodes[near][:, None]
    length = np.linalg.norm(span, axis=2)
    return span / np.maximum(length, 1e-300)[:, :, None], (ends >= 0) & (ends != far[:, None])


def _between(
    nodes: Floats, table: Ints, near: Ints, far: Ints, axis: Floats, radial: Floats
) -> tuple[Ints, Ints, Floats]:
    """Between which struts of its joint, seen along its own, each ruling lies, and how far."""
    directions, others = _directions(nodes, table, near, far)
    off = directions - np.einsum("nj,nkj->nk", axis, directions)[:, :, None] * axis[:, None]
    others &= np.linalg.norm(off, axis=2) > STANDS_OFF
    angle = counter_clockwise(radial[:, None], off, axis[:, None])
    # Of struts behind one another, the one nearest to the own stands for all: its crease shows.
    angle = np.where(others, np.round(angle / SAME_ANGLE) * SAME_ANGLE, np.nan)
    rows = np.arange(len(near))
    some = others.any(axis=1)
    ahead, behind = np.where(others, angle, np.inf), np.where(others, angle, -np.inf)
    near_own = np.einsum("nj,nkj->nk", axis, directions)
    right, left = (
        np.where(each == best[:, None], near_own, -np.inf).argmax(axis=1)
        for each, best in ((ahead, ahead.min(axis=1)), (behind, behind.max(axis=1)))
    )
    after, before = ahead[rows, right], 2.0 * np.pi - behind[rows, left]
    turn = np.zeros(len(near))
    turn[some] = before[some] / (before + after)[some]
    return (
        np.where(some, table[near, left], near),
        np.where(some, table[near, right], near),
        turn,
    )


def corner_turns(
    axis: Floats,
    left: Floats,
    right: Floats,
    about: Floats,
    directions: Floats,
    others: NDArray[np.bool_],
) -> Floats:
    """At which turns from left to right the creases of struts with those on both sides meet.

    Struts of one radius at a node meet where a point is equally far along all three.

    Args:
        axis: (n, 3) unit directions of the struts, away from the node.
        left: (n, 3) from the node along the struts that come next clockwise.
        right: (n, 3) those that come next counter-clockwise.
        about: (n, 3) the directions, or their opposites where left and right are seen reflected.
        directions: (n, k, 3) unit directions of all the struts at the node.
        others: (n, k) bool, whether there is such a strut.

    Returns:
        (n,) turns, mostly within 0 and 1; 0 where they meet inside another strut, behind the node
        or nowhere.
    """
    first, second = (side / lengths(side)[:, None] for side in (left, right))
    meets = np.cross(axis - first, axis - second)
    ahead = np.einsum("ni,ni->n", meets, axis)
    meets *= np.sign(ahead)[:, None]
    farther = np.einsum("nki,ni->nk", directions, meets) > (1.0 + AS_FAR) * np.abs(ahead)[:, None]
    shows = (ahead != 0.0) & ~(farther & others).any(axis=1)
    first, second, meets = (
        each - np.einsum("ni,ni->n", each, axis)[:, None] * axis for each in (first, second, meets)
    )
    whole = counter_clockwise(first, second, about)
    to_it = counter_clockwise(first, meets, about)
    result: Floats = np.where(shows, to_it / np.maximum(whole, 1e-300), 0.0)
    return result


def counter_clockwise(start: Floats, end: Floats, axis: Floats) -> Floats:
    """(…,) angles from one (…, 3) vector to another, seen against the axis, from 0 to 2 pi."""
    sine = np.einsum("...i,...i->...", np.cross(start, end), axis)
    angle: Floats = np.arctan2(sine, np.einsum("...i,...i->...", start, end)) % (2.0 * np.pi)
    return angle


def angles_to_struts(radial: Floats, directions: Floats, others: NDArray[np.bool_]) -> Floats:
    """(n, k) angles between unit vectors (n, 3) and struts' directions; pi where there is none."""
    cosine = np.einsum("nj,nkj->nk", radial, directions)
    return np.where(others, np.arccos(np.clip(cosine, -1.0, 1.0)), np.pi)


def crease(
    axis: Floats,
    radial: Floats,
    radius: Floats,
    slope: Floats,
    joint: Floats,
    directions: Floats,
    slopes: Floats,
    others: NDArray[np.bool_],
    strut: Ints | None = None,
) -> Floats:
    """Where rulings leave the joint that their strut begins at.

    The ruling x(t) = radius n + t (d + slope n), seen from the node, is inside another strut of
    direction e and the same radius at the node while |x|2 - (x.e)2 <= (radius + slope_e x.e)2 and
    x.e >= 0, and inside the joint sphere while |x| <= joint: quadratic equations in t.

    Args:
        axis: (m, 3) unit directions d of the struts, away from the node.
        radial: (n, 3) unit vectors n across them, one a ruling.
        radius: (m,) of all the struts at the node, mm.
        slope: (m,) by which the strut's radius grows along d.
        joint: (m,) radius of the joint sphere, mm.
        directions: (m, k, 3) unit directions e of the struts at the node.
        slopes: (m, k) by which their radii grow.
        others: (m, k) bool, whether there is such a strut, and it is not this one.
        strut: (n,) which strut each ruling lies on; None: each on one of its own.

    Returns:
        (n,) t in mm.
    """

    def own(values: NDArray[Any]) -> NDArray[Any]:
        """Each ruling's, of the struts'."""
        return values if strut is None else values.take(strut, mode="clip")

    growth = 1.0 + slope**2
    back = radius * slope
    result: Floats = (-back + np.sqrt(back**2 + growth * (joint**2 - radius**2))) / growth
    result = np.maximum(own(result), 0.0)
    growth, back, radius, slope = own(growth), own(back), own(radius), own(slope)
    x, y, z = (np.ascontiguousarray(each) for each in radial.T)
    # Strut by strut at the node: what a few thousand rulings need stays in the cache.
    for k in np.flatnonzero(others.any(axis=0)):
        ex, ey, ez = (np.ascontiguousarray(each) for each in directions[:, k].T)
        ahead = axis[:, 0] * ex + axis[:, 2] * ez + axis[:, 1] * ey
        off = x * own(ex) + z * own(ez) + y * own(ey)
        turn = own(ahead) + slope * off
        off *= radius
        grows = own(np.ascontiguousarray(slopes[:, k]))
        lean, tapered = 1.0 + grows**2, radius * grows
        square = growth - lean * turn**2
        half = back - lean * off * turn - tapered * turn
        within = half**2 + square * (lean * off**2 + 2.0 * tapered * off)
        real = (within >= 0.0) & (square > PARALLEL)
        if not others[:, k].all():
            real &= own(others[:, k])
        root = (np.sqrt(np.maximum(within, 0.0)) - half) / np.where(real, square, 1.0)
        real &= off + turn * root >= 0.0
        # A maximum "where" something holds takes numpy five times as long.
        np.maximum(result, np.where(real, root, 0.0), out=result)
    return result
