# SPDX-License-Identifier: LGPL-2.1-or-later
"""Closed shells: which bound bodies, which voids, and which nothing."""

from __future__ import annotations

import numpy as np

from ...mesh.topology import Sides, pieces_of
from ...mesh.triangle_mesh import TriangleMesh
from ...spatial.winding import winding_by_shell
from ...util.errors import VolfrepError
from ...util.numbers import place_text, plural
from ...util.ragged import spread
from ...util.types import Bools, Floats, Ints

#: Triangles of a shell from whose middles is seen where the shell lies.
SAMPLES = 16
#: A shell encloses nothing when its volume is below this part of its area to the power 3/2.
NO_VOLUME = 1e-7


def shells_of(mesh: TriangleMesh, edges: Sides) -> Ints:
    """(m,) the shell of each triangle of a closed manifold mesh, counted from 0."""
    one, other = edges.pairs()
    return pieces_of(one // 3, other // 3, len(mesh.triangles))[1]


def empty_shells(mesh: TriangleMesh, shell: Ints) -> tuple[Bools, list[str]]:
    """(m,) the triangles of shells that enclose no volume: sheets with two sides, slivers."""
    shells = int(shell.max()) + 1
    volume = np.abs(np.bincount(shell, weights=mesh.signed_volumes(), minlength=shells))
    area = np.bincount(shell, weights=mesh.areas(), minlength=shells)
    empty = volume <= NO_VOLUME * area**1.5
    gone = empty[shell]
    if not gone.any():
        return gone, []
    place = mesh.vertices[mesh.triangles[np.flatnonzero(gone)[0]]].mean(axis=0)
    number = plural(int(empty.sum()), "sheet")
    return gone, [f"{number} without a thickness removed near {place_text(place)}"]


def face_outward(
    mesh: TriangleMesh, shell: Ints, turned: Bools, name: str
) -> tuple[TriangleMesh, list[str], Ints]:
    """Shells that bound bodies look outward, those that bound voids inward.

    A file whose triangles agree says itself which shells are voids, unless it is inside out. In
    shells whose triangles had to be turned, nesting decides: what lies in a body is a void.

    Args:
        mesh: closed, manifold.
        shell: (m,) the shell of each triangle, counted from 0.
        turned: (m,) triangles that had to be turned to agree with their neighbours.
        name: of the part.

    Returns:
        The mesh, what was done, and the body that each triangle belongs to.

    Raises:
        VolfrepError: a shell lies in another that is wound the same way.
    """
    shells = int(shell.max()) + 1
    volume = np.bincount(shell, mesh.signed_volumes(), shells).astype(np.float64)
    sign: Ints = np.where(volume > 0.0, 1, np.where(volume < 0.0, -1, 0))
    mixed = np.bincount(shell[turned], minlength=shells) > 0
    around = _Nesting(mesh, shell, shells, sign)
    wanted: Ints = sign.copy()
    kept = volume[~mixed].sum()
    if kept < 0.0:
        wanted[~mixed] *= -1
    wanted[mixed] = np.where(around.depth[mixed] % 2 == 0, 1, -1)
    # A void needs a body around it.
    lonely = (wanted < 0) & (around.inside_of(wanted) == 0)
    wanted[lonely] = 1
    flip = (wanted * sign < 0)[shell]
    triangles = np.where(flip[:, None], mesh.triangles[:, ::-1], mesh.triangles)
    result = TriangleMesh(mesh.vertices, np.ascontiguousarray(triangles))
    done = []
    if flip.all() and not turned.any():
        done.append("The surface turned right side out")
    else:
        given = np.count_nonzero(flip ^ turned)
        if given:
            done.append(f"{plural(int(given), 'triangle')} turned to look outward")
    _refuse_nested(mesh, shell, wanted, around, name)
    return result, done, around.body_of(wanted, volume)[shell]


class _Nesting:
    """Which shells lie inside which, seen from a few places on each.

    Attributes:
        point_shell: (k,) the shell of each place.
        point, other, number: the winding number of other shells round places, made positive for
            inside, where it is not 0.
        depth: (s,) shells round the first place of each.
    """

    def __init__(self, mesh: TriangleMesh, shell: Ints, shells: int, sign: Ints) -> None:
        order = np.argsort(shell, kind="stable")
        size = np.bincount(shell, minlength=shells)
        begin = np.cumsum(size) - size
        if shells == 1:
            size = np.zeros(1, np.int64)
        self.point_shell, place = spread(np.minimum(size, SAMPLES))
        step = np.maximum(size // SAMPLES, 1)[self.point_shell]
        triangle = order[begin[self.point_shell] + place * step]
        points = mesh.vertices[mesh.triangles[triangle]].mean(axis=1)
        point, other, number = winding_by_shell(mesh, shell, points)
        apart = self.point_shell[point] != other
        self.point, self.other = point[apart], other[apart]
        self.number = number[apart] * sign[self.other]
        self.points = points
        self.shells = shells
        self._first = place == 0
        self.depth = np.bincount(
            self.point_shell[self.point][self._first[self.point]],
            weights=(np.abs(self.number) % 2)[self._first[self.point]],
            minlength=shells,
        ).astype(np.int64)

    def inside_of(self, wanted: Ints) -> Ints:
        """(s,) how often the other shells, turned as wanted, wind round each one's first place."""
        rows = self._first[self.point]
        total = np.bincount(
            self.point_shell[self.point][rows],
            weights=(self.number * wanted[self.other])[rows],
            minlength=self.shells,
        )
        return np.round(total).astype(np.int64)

    def body_of(self, wanted: Ints, volume: Floats) -> Ints:
        """(s,) the body each shell bounds: itself, or for a void the smallest body around it."""
        body = np.arange(self.shells)
        rows = self._first[self.point] & (self.number > 0) & (wanted[self.other] > 0)
        void, around = self.point_shell[self.point][rows], self.other[rows]
        order = np.argsort(-np.abs(volume[around]), kind="stable")
        owner = body.copy()
        owner[void[order]] = around[order]  # the smallest is written last
        return np.where(wanted < 0, owner, body)


def _refuse_nested(
    mesh: TriangleMesh, shell: Ints, wanted: Ints, around: _Nesting, name: str
) -> None:
    """Refuse a body all of whose places lie in another body's material."""
    total = np.bincount(
        around.point, weights=around.number * wanted[around.other], minlength=len(around.points)
    )
    free = np.bincount(around.point_shell[total < 0.5], minlength=around.shells) > 0
    buried = ~free & (wanted > 0) & (around.shells > 1)
    if buried.any():
        first = int(np.flatnonzero(buried)[0])
        place = around.points[np.flatnonzero(around.point_shell == first)[0]]
        raise VolfrepError(
            f"'{name}' has a shell near {place_text(place)} that lies inside a body and is wound "
            "like one, so that it may be a void or a body too many: reverse it there, or delete "
            "it, and export again."
        )
