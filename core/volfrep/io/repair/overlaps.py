# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that overlap, and a surface that runs through itself, made one clean surface."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...mesh.booleans import as_manifold, from_library
from ...mesh.topology import pieces_of
from ...mesh.triangle_mesh import TriangleMesh, compact, concatenate
from ...spatial.winding import Windings, windings
from ...util.errors import VolfrepError
from ...util.manifold import manifold_library
from ...util.numbers import place_text
from ...util.packages import MissingPackage
from ...util.ragged import spread
from ...util.types import Ints

#: A body that overlaps itself is halved this often, and into no more pieces than this.
MOST_CUTS = 10
MOST_PIECES = 400
#: Lines see a solid enclosed once when no more than this part of it is not: rounding.
CLEAN = 1e-9


def unite(mesh: TriangleMesh, body: Ints, name: str) -> tuple[TriangleMesh, list[str]]:
    """Bodies that overlap or touch face to face made one; others as they are.

    Args:
        mesh: closed, manifold, oriented.
        body: (m,) the body each triangle belongs to.
        name: of the part.

    Raises:
        VolfrepError: the Boolean library does not take one of them.
    """
    if (body == body[0]).all():
        return mesh, []
    order = np.argsort(body, kind="stable")
    names, begin = np.unique(body[order], return_index=True)
    rows_of = dict(zip(names.tolist(), np.split(order, begin[1:]), strict=True))
    united: list[TriangleMesh] = []
    gone: list[int] = []
    for group in _touching_boxes(mesh, body):
        if len(group) == 1:
            continue
        library = manifold_library("Uniting bodies that overlap")
        solids = [_to_manifold(mesh, rows_of[one], name) for one in group.tolist()]
        union = library.Manifold.batch_boolean(solids, library.OpType.Add)
        volume, area = sum(s.volume() for s in solids), sum(s.surface_area() for s in solids)
        same_volume = abs(union.volume() - volume) <= 1e-9 * abs(volume)
        if same_volume and abs(union.surface_area() - area) <= 1e-9 * area:
            continue
        united.append(from_library(union.to_mesh64()))
        gone += group.tolist()
    if not gone:
        return mesh, []
    rest = compact(TriangleMesh(mesh.vertices, mesh.triangles[~np.isin(body, gone)]))
    return concatenate(rest, *united), [f"{len(gone):,} bodies that overlap or touch united"]


def _touching_boxes(mesh: TriangleMesh, body: Ints) -> list[Ints]:
    """Groups of bodies whose boxes reach into each other."""
    names, index = np.unique(body, return_inverse=True)
    index = index.ravel()
    low = np.full((len(names), 3), np.inf)
    high = np.full((len(names), 3), -np.inf)
    for corner in mesh.corners():
        np.minimum.at(low, index, corner)
        np.maximum.at(high, index, corner)
    # A sweep along x leaves few pairs to compare.
    order = np.argsort(low[:, 0], kind="stable")
    ends = np.searchsorted(low[order, 0], high[order, 0], side="right")
    row, place = spread(np.maximum(ends - np.arange(len(order)) - 1, 0))
    a, b = order[row], order[row + place + 1]
    meet = ((low[a] <= high[b]) & (low[b] <= high[a])).all(axis=1)
    count, group = pieces_of(a[meet], b[meet], len(names))
    by_group = np.argsort(group, kind="stable")
    cuts = np.cumsum(np.bincount(group, minlength=count))[:-1]
    return [names[part] for part in np.split(by_group, cuts)]


def unite_with_itself(mesh: TriangleMesh, met: Windings, name: str) -> TriangleMesh | None:
    """What a surface that runs through itself encloses at least once.

    The solid is halved until the lobes that overlap are pieces of their own; then all pieces are
    united.

    Args:
        mesh: closed, manifold, oriented.
        met: its winding numbers.
        name: of the part.

    Returns:
        None where that does not come to a solid, or parts of it are inside out.
    """
    if met.least < 0:
        return None
    library = manifold_library("Mending a surface that runs through itself")
    waiting = [(_to_manifold(mesh, np.arange(len(mesh.triangles)), name), 0)]
    pieces: list[Any] = []
    while waiting:
        whole, cuts = waiting.pop()
        for solid in whole.decompose():
            piece = from_library(solid.to_mesh64())
            if len(pieces) + len(waiting) > MOST_PIECES:
                return None
            if not len(piece.triangles) or windings(piece).odd <= CLEAN * abs(solid.volume()):
                pieces.append(solid)
            elif cuts == MOST_CUTS:
                return None
            else:
                axis = int(np.ptp(piece.bounds, axis=0).argmax())
                middle = float(piece.bounds[:, axis].mean())
                halves = solid.split_by_plane(np.eye(3)[axis].tolist(), middle)
                waiting += [(half, cuts + 1) for half in halves]
    whole = library.Manifold.batch_boolean(pieces, library.OpType.Add)
    union = from_library(whole.to_mesh64())
    return union if len(union.triangles) else None


def _to_manifold(mesh: TriangleMesh, rows: Ints, name: str) -> Any:
    part = compact(TriangleMesh(mesh.vertices, mesh.triangles[rows]))
    try:
        return as_manifold(part)
    except MissingPackage:
        raise
    except VolfrepError as error:
        raise VolfrepError(
            f"'{name}' has overlapping bodies near {place_text(part.vertices.mean(axis=0))} that "
            "cannot be united: unite them before export."
        ) from error
