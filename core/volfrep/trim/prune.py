# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pruning of struts: those with a free end carry nothing, thin ones next to nothing.

It is told on the struts' axes, before anything is meshed. A strut that the wall cuts ends there:
a skin holds that end, without a skin it is free. So is the end of a strut at a node without other
struts. Where a strut goes, its neighbours may get a free end: the search is repeated. Struts that
are too thin, or lie too flat to be built, go first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..design.cells import UnitCell
from ..design.openings import lie_on
from ..design.spec_parts import Boundary, FlatStruts, Struts
from ..grid.inclination import is_flat, unit_direction
from ..grid.placement import Placement, graded_wireframe
from ..grid.strut_graph import CellGraph, Wireframe, select_struts, struts_of
from ..lattice.padded_grid import PaddedGrid
from ..mesh.triangle_mesh import TriangleMesh
from ..shell.domain import Domain
from ..spatial.proximity import are_nearer
from ..util.types import Bools, Ints
from .clip_struts import Pieces, pieces_inside

#: A node this far outside a wall without skin, in units of its joint's radius, still holds its
#: struts together: a wall through the cells' corners leaves half of every joint there.
NODE_REACH = 0.5


@dataclass(frozen=True, eq=False)
class Remaining:
    """What is left of a lattice's struts.

    Attributes:
        kept: (m,) bool, the struts that stay.
        stubs: struts taken away because they were short and had a free end.
        dangling: struts taken away because they had a free end, whatever their length.
        thin: struts taken away because they were nowhere thick enough.
        flat: struts taken away because they lay too flat to be built.
    """

    kept: Bools
    stubs: int
    dangling: int
    thin: int
    flat: int = 0


@dataclass(frozen=True, eq=False)
class Pruned:
    """A lattice without its struts with free ends.

    Attributes:
        graph: of all the cells that its octants see, with all their struts.
        left: which of these struts stay.
        frame: those that belong to active cells and stay, in the part.
    """

    graph: CellGraph
    left: Remaining
    frame: Wireframe

    @property
    def left_graph(self) -> CellGraph:
        """The graph with the struts that stay; its nodes are numbered as before."""
        return replace(self.graph, struts=self.graph.struts[self.left.kept])


def prune(
    padded: PaddedGrid,
    cell: UnitCell,
    active: Bools,
    struts: Struts,
    boundary: Boundary,
    placement: Placement,
    domain: Domain,
    has_skin: bool,
) -> Pruned:
    """The lattice of the active cells without the struts that its boundary has taken away.

    Args:
        padded: the cells that it is placed on.
        cell: the unit cell.
        active: (nx, ny, nz) bool.
        struts: how thick they are.
        boundary: which of them go.
        placement: where the lattice lies.
        domain: what it fills.
        has_skin: whether a skin lies about the domain, which holds what its wall cuts.
    """
    graph = padded.graph(cell, active, boundary.is_endless)
    placed = graded_wireframe(graph, struts, placement)
    left = remaining(
        placed,
        domain.mesh if placement.is_cut else None,
        has_skin=has_skin,
        openings=domain.openings,
        shortest=boundary.shortest_stub,
        dangling=boundary.remove_dangling,
        thickest=boundary.remove_below,
        flat=boundary.flat_struts,
    )
    inner = graph.row[tuple(slice(n, -n or None) for n in graph.first.tolist())]
    own = struts_of(graph, cell, inner[active])
    return Pruned(graph, left, select_struts(placed, own & left.kept))


def remaining(
    lattice: Wireframe,
    boundary: TriangleMesh | None,
    *,
    has_skin: bool,
    shortest: float,
    dangling: bool,
    thickest: float = 0.0,
    openings: TriangleMesh | None = None,
    flat: FlatStruts | None = None,
) -> Remaining:
    """The struts that stay when thin ones and those with free ends go.

    A strut of which the wall leaves several pieces stays as long as one of them is held at both
    ends. Struts that lie outside the wall altogether stay, and hold nothing.

    Args:
        lattice: all the struts, mm.
        boundary: closed mesh that cuts them; None for none.
        has_skin: whether there is a skin behind the wall, which holds what it cuts.
        shortest: struts with a free end that are shorter than this go, mm.
        dangling: all struts with a free end go.
        thickest: struts whose radius is nowhere above it go, mm; 0 for none.
        openings: faces of the wall that have no skin; None for none.
        flat: struts that lie as flat go, and those with a free end then; None for none.
    """
    count = len(lattice.struts)
    if boundary is None:
        every = np.arange(count)
        pieces = Pieces(every, np.zeros(count), np.ones(count))
    else:
        pieces = pieces_inside(lattice, boundary)
        if not has_skin:
            pieces = _to_near_nodes(pieces, lattice, boundary)
    length = pieces.lengths(lattice)
    ends, fixed = _ends(pieces, lattice, has_skin, openings)
    thin = lattice.radii.max(axis=1) <= thickest
    lies_flat = np.zeros(count, bool)
    if flat is not None:
        lies_flat = is_flat(lattice, unit_direction(flat.build_direction), flat.inclination) & ~thin
        dangling = True
    alive = ~(thin | lies_flat)[pieces.owner]
    owners = np.bincount(pieces.owner, minlength=count) > 0

    def gone() -> Bools:
        left = np.bincount(pieces.owner[alive], minlength=count)
        return np.asarray(owners & (left == 0))

    first = gone()
    are_flat = int((first & lies_flat).sum())
    are_thin = int(first.sum()) - are_flat
    alive = _without_free(ends, fixed, alive, length < shortest)
    stubs = int(gone().sum()) - are_thin - are_flat
    if dangling:
        alive = _without_free(ends, fixed, alive, alive)
    lost = gone()
    loose = int(lost.sum()) - stubs - are_thin - are_flat
    return Remaining(~lost, stubs, loose, are_thin, are_flat)


def _to_near_nodes(pieces: Pieces, lattice: Wireframe, boundary: TriangleMesh) -> Pieces:
    """Pieces that end just before a node outside the wall, prolonged to it.

    A strut that runs outside between two such nodes is a piece as a whole.
    """
    inside = np.zeros(len(lattice.nodes), bool)
    for side, at_end in ((0, pieces.low == 0.0), (1, pieces.high == 1.0)):
        inside[lattice.struts[pieces.owner[at_end], side]] = True
    outside = np.flatnonzero(~inside)
    near = np.zeros(len(lattice.nodes), bool)
    if len(outside):
        reach = NODE_REACH * lattice.joint_radii[outside]
        near[outside] = are_nearer(boundary, lattice.nodes[outside], reach)
    first = np.diff(pieces.owner, prepend=-1) > 0
    last = np.diff(pieces.owner, append=len(lattice.struts)) > 0
    low = np.where(first & near[lattice.struts[pieces.owner, 0]], 0.0, pieces.low)
    high = np.where(last & near[lattice.struts[pieces.owner, 1]], 1.0, pieces.high)
    along = near[lattice.struts].all(axis=1)
    along[pieces.owner] = False
    added = np.flatnonzero(along)
    owner = np.concatenate([pieces.owner, added])
    order = np.argsort(owner, kind="stable")
    none = np.zeros(len(added))
    return Pieces(
        owner[order],
        np.concatenate([low, none])[order],
        np.concatenate([high, none + 1.0])[order],
    )


def _ends(
    pieces: Pieces, lattice: Wireframe, has_skin: bool, openings: TriangleMesh | None
) -> tuple[Ints, Bools]:
    """(p, 2) numbers of the pieces' ends: of the node, or one of its own; and which are held."""
    ends = lattice.struts[pieces.owner].astype(np.int64)
    count = len(lattice.nodes)
    points = []
    for side, share, cut in (
        (0, pieces.low, pieces.low > 0.0),
        (1, pieces.high, pieces.high < 1.0),
    ):
        start, end = lattice.nodes[lattice.struts[pieces.owner[cut]]].swapaxes(0, 1)
        points.append(start + share[cut, None] * (end - start))
        ends[cut, side] = count + np.arange(int(cut.sum()))
        count += int(cut.sum())
    fixed = np.zeros(count, bool)
    fixed[len(lattice.nodes) :] = has_skin
    if has_skin and openings is not None:
        fixed[len(lattice.nodes) :] = ~lie_on(openings, np.concatenate(points))
    return ends, fixed


def _without_free(ends: Ints, fixed: Bools, alive: Bools, may_go: Bools) -> Bools:
    """The pieces that are left when those that may go, do so once they have a free end."""
    while True:
        degree = np.bincount(ends[alive].ravel(), minlength=len(fixed))
        free = (degree == 1) & ~fixed
        going = alive & may_go & free[ends].any(axis=1)
        if not going.any():
            return alive
        alive = alive & ~going
