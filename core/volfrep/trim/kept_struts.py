# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which struts of a trimmed lattice hang on nothing: told on their axes, before anything is meshed.

Struts hold each other where they share a node, and where their material meets: those of a node
just outside the wall still do, and so do struts that cross without a node.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..design.openings import lie_on
from ..grid.strut_graph import Wireframe, select_struts
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import are_nearer
from ..util.errors import VolfrepError
from ..util.types import Bools, Floats, Ints
from .clip_struts import AT_WALL, Clipped, Pieces, clip, pieces_inside
from .tied_struts import about, drawn_together, find_touching, groups_of, tied, with_grazing

#: Struts that are one body as a mesh and hang on nothing as beams are refused from this share of
#: their volume on.
MOST_LEFT_OUT = 0.03


@dataclass(frozen=True, eq=False)
class KeptStruts:
    """The pieces of a lattice's struts, and which of them stay.

    Attributes:
        pieces: of the struts' axes inside the domain.
        stays: (p,) bool.
        loose: how many groups of pieces hang on nothing.
        share: their part of the struts' volume, 0 to 1.
        has_skin: whether a skin holds what the wall cuts.
        bodies: without a skin, so many groups stay at most; None: all do.
    """

    pieces: Pieces
    stays: Bools
    loose: int
    share: float
    has_skin: bool
    bodies: int | None

    @property
    def left(self) -> Pieces:
        """Those that stay."""
        pieces, stays = self.pieces, self.stays
        return Pieces(pieces.owner[stays], pieces.low[stays], pieces.high[stays])

    def without_loose(self, lattice: Wireframe) -> Wireframe:
        """The lattice, whole, without the struts of which no piece stays.

        A strut of which no piece lies inside may reach in with its side: it stays where a strut
        that stays has a node of it.
        """
        if self.stays.all() and self.has_skin:
            return lattice
        return select_struts(lattice, self.whole(lattice))

    def whole(self, lattice: Wireframe) -> Bools:
        """(m,) the struts of the lattice that `without_loose` keeps."""
        count = len(lattice.struts)
        if self.stays.all() and self.has_skin:
            return np.ones(count, bool)
        stays = np.zeros(count, bool)
        stays[self.pieces.owner[self.stays]] = True
        outside = ~self.inside(lattice)
        joined = np.zeros(len(lattice.nodes), bool)
        joined[lattice.struts[stays]] = True
        return np.asarray(stays | (outside & joined[lattice.struts].any(axis=1)))

    def inside(self, lattice: Wireframe) -> Bools:
        """(m,) the struts of the lattice that have a piece, whether it stays or not."""
        result = np.zeros(len(lattice.struts), bool)
        result[self.pieces.owner] = True
        return result

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence on the struts that were left out."""
        if not self.loose:
            return ()
        what = "piece that hangs" if self.loose == 1 else "pieces that hang"
        return (
            f"{self.loose:,} {what} on nothing left out, {100.0 * self.share:.2g} % of the "
            "struts' volume: smaller cells or another origin may join them, and so does a skin.",
        )


def find_kept_struts(
    lattice: Wireframe,
    boundary: TriangleMesh | None,
    *,
    has_skin: bool,
    bodies: int = 1,
    openings: TriangleMesh | None = None,
    keep_all: bool = False,
) -> KeptStruts:
    """The pieces of a lattice that hang on something.

    Args:
        lattice: all its struts, mm.
        boundary: closed mesh that cuts them; None for none.
        has_skin: whether a skin behind the wall holds what it cuts.
        bodies: without a skin, so many of the largest pieces stay.
        openings: faces of the wall that have no skin; None for none.
        keep_all: all stay, whatever they hang on.
    """
    count = len(lattice.struts)
    if boundary is None:
        pieces = Pieces(np.arange(count), np.zeros(count), np.ones(count))
    else:
        pieces = pieces_inside(lattice, boundary)
    if keep_all or not len(pieces.owner):
        return KeptStruts(pieces, np.ones(len(pieces.owner), bool), 0, 0.0, has_skin, None)
    sizes = _volumes(pieces, lattice)
    group = _groups(pieces, lattice, None if has_skin else boundary)
    total = np.bincount(group, sizes)
    keeps = np.zeros(len(total), bool)
    if has_skin and boundary is not None:
        keeps[group[_on_skin(pieces, lattice, boundary, openings)]] = True
    else:
        keeps[np.argsort(-total, kind="stable")[:bodies]] = True
    stays = keeps[group]
    lost = sizes[~stays].sum() / max(sizes.sum(), 1e-300)
    return KeptStruts(pieces, stays, int((~keeps).sum()), float(lost), has_skin, bodies)


def largest(pieces: Pieces, lattice: Wireframe, bodies: int) -> Bools:
    """(p,) the pieces of a lattice without a skin that stay: those of its largest groups."""
    group = _groups(pieces, lattice, None)
    total = np.bincount(group, _volumes(pieces, lattice))
    keeps = np.zeros(len(total), bool)
    keeps[np.argsort(-total, kind="stable")[:bodies]] = True
    return np.asarray(keeps[group])


def axes_of(
    lattice: Wireframe,
    boundary: TriangleMesh | None,
    kept: KeptStruts,
    openings: TriangleMesh | None,
) -> Clipped:
    """The axes of the struts that stay, cut where they leave the domain.

    Args:
        lattice: all its struts, mm.
        boundary: as for `find_kept_struts`.
        kept: the pieces that stay.
        openings: faces of the wall that have no skin; None for none.

    Raises:
        VolfrepError: no axis lies inside the wall.
    """
    if boundary is None:
        frame = kept.without_loose(lattice)
        owner = np.flatnonzero(kept.whole(lattice))
        clipped = Clipped(
            frame, np.zeros(len(frame.nodes), bool), owner, np.zeros(len(owner)),
            np.ones(len(owner)), kept.notes,
        )  # fmt: skip
    else:
        clipped = replace(clip(lattice, boundary, kept.left), warnings=kept.notes)
        if openings is not None:
            frame = clipped.wireframe
            free = lie_on(openings, frame.nodes, AT_WALL * frame.joint_radii)
            clipped = replace(clipped, on_boundary=clipped.on_boundary & ~free)
    if not len(clipped.wireframe.struts):
        raise VolfrepError(
            "No strut's axis lies inside the part: reduce the cell size or move the origin."
        )
    if kept.has_skin:
        return clipped
    if boundary is not None:
        grazing = _along(kept.left, lattice, boundary)
        clipped = drawn_together(with_grazing(clipped, lattice, boundary, grazing), lattice)
    clipped = tied(clipped)
    return clipped if kept.bodies is None else _with_joints(clipped, kept.bodies)


def _with_joints(clipped: Clipped, bodies: int) -> Clipped:
    """The largest so many groups of axes that share nodes.

    Raises:
        VolfrepError: the others are more than `MOST_LEFT_OUT` of the struts' volume.
    """
    frame = clipped.wireframe
    count = len(frame.struts)
    whole = Pieces(np.arange(count), np.zeros(count), np.ones(count))
    group = groups_of(frame)[frame.struts[:, 0]]
    sizes = _volumes(whole, frame)
    total = np.bincount(group, sizes)
    keeps = np.zeros(len(total), bool)
    keeps[np.argsort(-total, kind="stable")[:bodies]] = True
    stays = keeps[group]
    if stays.all():
        return clipped
    gone = len(np.unique(group[~stays]))
    share = float(sizes[~stays].sum() / sizes.sum())
    left = (
        f"{gone:,} group{'s' if gone > 1 else ''} of struts ({100.0 * share:.2g} % of their volume)"
    )
    if share > MOST_LEFT_OUT:
        raise VolfrepError(
            f"As beams {left} would hang on nothing, though the mesh is one body: choose "
            "tetrahedra or the mesh, smaller cells, or another origin."
        )
    note = (f"{left} hang on the others by too little for beams, and are left out.",)
    used = np.unique(frame.struts[stays])
    return Clipped(
        select_struts(frame, stays), clipped.on_boundary[used], clipped.owner[stays],
        clipped.low[stays], clipped.high[stays], clipped.warnings + note,
    )  # fmt: skip


def _volumes(pieces: Pieces, lattice: Wireframe) -> Floats:
    """(p,) of the pieces as cylinders, mm3."""
    radius = lattice.radii[pieces.owner].mean(axis=1)
    return np.asarray(np.pi * radius**2 * pieces.lengths(lattice))


def _on_skin(
    pieces: Pieces, lattice: Wireframe, boundary: TriangleMesh, openings: TriangleMesh | None
) -> Bools:
    """(p,) the pieces that a skin holds: it cuts them, or their material reaches it."""
    ends = lattice.struts[pieces.owner]
    cut = np.stack([pieces.low > 0.0, pieces.high < 1.0], axis=1)
    # A node is asked for once, whatever struts it has.
    asked = np.flatnonzero(np.bincount(ends[~cut], minlength=len(lattice.nodes)))
    near = np.zeros(len(lattice.nodes), bool)
    near[asked] = are_nearer(boundary, lattice.nodes[asked], lattice.joint_radii[asked])
    held = cut | near[ends]
    if openings is not None:
        for side, points in enumerate(_ends(pieces, lattice)):
            some = np.flatnonzero(held[:, side])
            reach = lattice.joint_radii[ends[some, side]]
            held[some, side] = ~lie_on(openings, points[some], reach)
    return np.asarray(held.any(axis=1))


def _ends(pieces: Pieces, lattice: Wireframe) -> tuple[Floats, Floats]:
    """(p, 3) where pieces begin and end, mm."""
    start, end = (lattice.nodes[lattice.struts[pieces.owner, side]] for side in (0, 1))
    low, high = np.flatnonzero(pieces.low > 0.0), np.flatnonzero(pieces.high < 1.0)
    cut_low, cut_high = (
        start[some] + share[some, None] * (end[some] - start[some])
        for some, share in ((low, pieces.low), (high, pieces.high))
    )
    start[low], end[high] = cut_low, cut_high
    return start, end


def _groups(pieces: Pieces, lattice: Wireframe, boundary: TriangleMesh | None) -> Ints:
    """(p,) the group of each piece; of one group are those whose material hangs together.

    With a wall, struts that lie in it, or within their radius outside, join what they touch.
    """
    count, nodes = len(pieces.owner), len(lattice.nodes)
    ends = lattice.struts[pieces.owner].astype(np.int64)
    cut = np.stack([pieces.low > 0.0, pieces.high < 1.0], axis=1)
    ends[cut] = nodes + np.arange(int(cut.sum()))
    group = pieces_of(ends[:, 0], ends[:, 1], nodes + int(cut.sum()))[1][ends[:, 0]]
    if (group == group[:1]).all():
        return np.zeros(count, np.int64)
    owner, low, high = pieces.owner, pieces.low, pieces.high
    if boundary is not None:
        along = _along(pieces, lattice, boundary)
        own = group.max() + 1 + np.arange(len(along))
        group = np.concatenate([group, own])
        owner = np.concatenate([owner, along])
        low, high = (
            np.concatenate([values, np.full(len(along), end)])
            for values, end in ((low, 0.0), (high, 1.0))
        )
    group = np.unique(group, return_inverse=True)[1].ravel()
    return _meeting(Pieces(owner, low, high), lattice, group)[:count]


def _along(pieces: Pieces, lattice: Wireframe, boundary: TriangleMesh) -> Ints:
    """The struts without a piece inside whose nodes both lie in the wall or nearly so."""
    outside = np.bincount(pieces.owner, minlength=len(lattice.struts)) == 0
    asked = np.unique(lattice.struts[outside])
    near = np.zeros(len(lattice.nodes), bool)
    if len(asked):
        near[asked] = are_nearer(boundary, lattice.nodes[asked], lattice.joint_radii[asked])
    return np.flatnonzero(outside & near[lattice.struts].all(axis=1))


def _meeting(pieces: Pieces, lattice: Wireframe, group: Ints) -> Ints:
    """(p,) groups, those joined whose pieces' material meets."""
    # Nearly all are of one group: only those about the others can touch one of another.
    asks = np.zeros(len(lattice.nodes), bool)
    asks[lattice.struts[pieces.owner[group != np.bincount(group).argmax()]]] = True
    reach = 2.0 * float(lattice.lengths().max()) + 3.0 * float(lattice.radii.max())
    near = about(lattice.nodes, asks, reach)
    rows = np.flatnonzero(near[lattice.struts[pieces.owner, 0]])
    some = Pieces(pieces.owner[rows], pieces.low[rows], pieces.high[rows])
    radius = lattice.radii[some.owner].max(axis=1)
    pairs = rows[find_touching(*_ends(some, lattice), radius, group[rows])[0]]
    return pieces_of(group[pairs][:, 0], group[pairs][:, 1], int(group.max()) + 1)[1][group]
