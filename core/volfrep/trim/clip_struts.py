# SPDX-License-Identifier: LGPL-2.1-or-later
"""Clipping of the struts' axes at the domain's wall: what beams, not meshes, are trimmed by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..grid.strut_graph import Wireframe
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import are_nearer
from ..spatial.rays import segment_crossings
from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints

if TYPE_CHECKING:
    pass


#: Pieces shorter than this, in units of their radius, are dropped: no beam is that short.
SHORTEST_PIECE = 0.5
#: A wall this near to a node, in units of the radius, goes through it: nothing is cut there.
AT_WALL = 0.05
#: The direction of the line that tells whether a point is inside: along nothing that parts are.
_LINE = np.array([0.123, 0.456, 0.881])


@dataclass(frozen=True, eq=False)
class Clipped:
    """A wireframe inside a domain.

    Attributes:
        wireframe: nodes and struts inside; a cut strut ends in a node of its own on the wall.
        on_boundary: (n,) bool, nodes of the wireframe at which the wall holds the lattice.
        owner: (m,) int64, the strut of the whole lattice that each strut is a piece of.
        low: (m,) float64, where on it the piece begins, as a share of its length.
        high: (m,) float64, where it ends.
        warnings: sentences for the user.
    """

    wireframe: Wireframe
    on_boundary: Bools
    owner: Ints
    low: Floats
    high: Floats
    warnings: tuple[str, ...] = ()


def clip(wireframe: Wireframe, domain: TriangleMesh, inside: Pieces | None = None) -> Clipped:
    """Keep what of the struts' axes lies inside a closed mesh.

    Pieces shorter than half their radius are dropped; a node that loses such a piece to the
    wall counts as on it. So does a node that the wall goes through (`AT_WALL`): its struts
    still meet there.

    Args:
        wireframe: mm.
        domain: closed and outward oriented, mm; no strut may run along its surface.
        inside: the pieces of the axes inside it that stay; None: all.
    """
    inside = pieces_inside(wireframe, domain) if inside is None else inside
    owner, low, high = inside.owner, inside.low, inside.high
    radius = _between(wireframe.radii[owner], 0.5 * (low + high))
    ends = wireframe.nodes[wireframe.struts[owner]]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    reach = AT_WALL * wireframe.radii[owner]
    low = np.where(low * length < reach[:, 0], 0.0, low)
    high = np.where((1.0 - high) * length < reach[:, 1], 1.0, high)
    whole = (low == 0.0) & (high == 1.0)
    kept = whole | ((high - low) * length > SHORTEST_PIECE * radius)

    on_boundary = are_nearer(domain, wireframe.nodes, AT_WALL * wireframe.joint_radii)
    for side, at_end in ((0, low == 0.0), (1, high == 1.0)):
        on_boundary[wireframe.struts[owner[~kept & at_end], side]] = True
    return _assemble(wireframe, on_boundary, owner[kept], low[kept], high[kept])


@dataclass(frozen=True, eq=False)
class Pieces:
    """What of the struts' axes lies inside a domain, in the order of the struts and along them.

    Attributes:
        owner: (p,) the strut.
        low: (p,) where the piece begins, as a share of the strut's length; 0 at its first node.
        high: (p,) where it ends; 1 at the strut's second node.
    """

    owner: Ints
    low: Floats
    high: Floats

    def lengths(self, wireframe: Wireframe) -> Floats:
        """(p,) in mm."""
        return np.asarray(wireframe.lengths()[self.owner] * (self.high - self.low))


def pieces_inside(wireframe: Wireframe, domain: TriangleMesh) -> Pieces:
    """The pieces of the struts' axes inside a closed mesh, however short."""
    start, end = wireframe.nodes[wireframe.struts].swapaxes(0, 1)
    strut, place, step = segment_crossings(domain, start, end)
    del start, end
    inside = _inside(wireframe, domain, strut, place, step)
    # Every strut becomes pieces between its ends and its crossings, by turns inside and outside.
    count = np.bincount(strut, minlength=len(wireframe.struts))
    owner, piece = spread(count + 1)
    first = np.concatenate([[0], np.cumsum(count)])[owner]
    padded = np.concatenate([place, [np.nan]])
    low = np.where(piece == 0, 0.0, padded[np.minimum(first + piece - 1, len(place))])
    high = np.where(piece == count[owner], 1.0, padded[np.minimum(first + piece, len(place))])
    within = inside[wireframe.struts[owner, 0]] ^ (piece % 2 == 1)
    return Pieces(owner[within], low[within], high[within])


def _assemble(
    wireframe: Wireframe, on_boundary: Bools, owner: Ints, low: Floats, high: Floats
) -> Clipped:
    """A wireframe of the pieces `low` to `high` of the struts `owner`."""
    struts = wireframe.struts[owner].astype(np.int64)
    radii = wireframe.radii[owner]
    ends = wireframe.nodes[struts]
    count = len(wireframe.nodes)
    nodes, joints = [wireframe.nodes], [wireframe.joint_radii]
    new_radii = np.stack([_between(radii, low), _between(radii, high)], axis=1)
    for side, place, cut in ((0, low, low > 0.0), (1, high, high < 1.0)):
        share = place[cut, None]
        nodes.append((1.0 - share) * ends[cut, 0] + share * ends[cut, 1])
        joints.append(new_radii[cut, side])
        struts[cut, side] = count + np.arange(np.count_nonzero(cut))
        count += np.count_nonzero(cut)
    walls = np.concatenate([on_boundary, np.ones(count - len(on_boundary), bool)])
    used, index = np.unique(struts, return_inverse=True)
    clipped = Wireframe(
        np.concatenate(nodes)[used],
        index.reshape(-1, 2).astype(np.int32),
        new_radii,
        np.concatenate(joints)[used],
    )
    return Clipped(clipped, walls[used], owner, low, high)


def _between(ends: Floats, share: Floats) -> Floats:
    """The value at that share of the way from the first to the second column."""
    value: Floats = ends[:, 0] + share * (ends[:, 1] - ends[:, 0])
    return value


def _inside(
    wireframe: Wireframe, domain: TriangleMesh, strut: Ints, place: Floats, step: Ints
) -> Bools:
    """(n,) whether each node lies inside, told by the crossings of its struts.

    A strut that crosses nothing has both its nodes on one side, so that whole clusters of nodes
    share one answer; only clusters without any crossing are asked for by a line to the outside.
    """
    crossed = np.bincount(strut, minlength=len(wireframe.struts))
    a, b = wireframe.struts[crossed == 0].T
    clusters, cluster = pieces_of(a, b, len(wireframe.nodes))
    # The first crossing tells about the strut's start, the last one about its end.
    votes = np.zeros(clusters)
    first = np.flatnonzero(np.diff(strut, prepend=-1))
    last = np.flatnonzero(np.diff(strut, append=len(crossed)))
    np.add.at(votes, cluster[wireframe.struts[strut[first], 0]], step[first])
    np.add.at(votes, cluster[wireframe.struts[strut[last], 1]], -step[last])
    silent = np.flatnonzero(votes == 0)
    if len(silent):
        sample = wireframe.nodes[np.unique(cluster, return_index=True)[1][silent]]
        away = 2.0 * np.linalg.norm(np.ptp(np.vstack([domain.bounds, sample]), axis=0))
        ray, _, way = segment_crossings(domain, sample, sample + away * _LINE)
        votes[silent] = np.bincount(ray, way, len(silent))
    result: Bools = votes[cluster] > 0.5
    return result
