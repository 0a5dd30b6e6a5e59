# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flat triangles as thin shells with three displacements and three turns at each corner.

In its plane: the optimal triangle with drilling freedoms (C. A. Felippa, Comput. Methods Appl.
Mech. Eng. 192, 2003), exact for bending of rectangles; across it: the discrete Kirchhoff triangle
(J.-L. Batoz, K.-J. Bathe & L.-W. Ho, Int. J. Num. Meth. Eng. 15, 1980). All triangles at once.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..fem.wedge_mesh import pad_shares
from ..util.types import Floats, Ints
from .structure import Blocks
from .tapered_beams import Elastic

#: The betas of the optimal triangle, by rows of its matrix.
_BETA = np.array([[1.0, 2.0, 1.0], [0.0, 1.0, -1.0], [-1.0, -1.0, -2.0]])
#: Middles of the edges in area coordinates: exact for what is quadratic.
_PLACES = np.array([[0.5, 0.0], [0.5, 0.5], [0.0, 0.5]])
#: Freedoms of three corners in their plane, and across it.
_IN_PLANE = np.array([0, 1, 5, 6, 7, 11, 12, 13, 17])
_ACROSS = np.array([2, 3, 4, 8, 9, 10, 14, 15, 16])
#: No panel has less than this part of its triangle.
_LEAST_PANEL = 1e-4


@dataclass(frozen=True, eq=False)
class Panels:
    """What of the triangles bends: they are stiff where walls meet and where struts end.

    Attributes:
        of: (b,) the triangle that each is a piece of.
        nodes: (b, 3) rows of the structure's nodes that its corners hang on.
        corners: (b, 3, 2) in the triangle's plane, mm.
        arms: (b, 3, 2) from the nodes to the corners, in that plane, mm.
    """

    of: Ints
    nodes: Ints
    corners: Floats
    arms: Floats


@dataclass(frozen=True, eq=False)
class UnitBlocks:
    """What shells of a thickness t are made of: t flat + t3 bent, and t heavy + t3 turning.

    Attributes:
        rows, columns: (9 t,) nodes, of each triangle's corners with each other.
        flat, bent: (9 t, 6, 6) stiffness in the plane and across it, for 1 mm.
        heavy, turning: (9 t, 6, 6) mass and inertia, for 1 mm.
    """

    rows: Ints
    columns: Ints
    flat: Floats
    bent: Floats
    heavy: Floats
    turning: Floats


@dataclass(frozen=True, eq=False)
class Shells:
    """Triangles of a thickness each.

    Attributes:
        triangles: (t, 3) int64, rows of the structure's nodes.
        axes: (t, 3, 3) along the first edge, across it in the plane, and the normal.
        corners: (t, 3, 2) in the plane, mm.
        thickness: (t,) mm.
        material: of all.
        panels: what of them bends.
        filled: (t,) how many times as thick as `thickness` what is there would be if it had the
            triangle's area all through: less where it narrows with depth.
    """

    triangles: Ints
    axes: Floats
    corners: Floats
    thickness: Floats
    material: Elastic
    panels: Panels
    filled: Floats

    @property
    def acting(self) -> Floats:
        """(t,) mm, what of the thickness acts."""
        return self.thickness * self.filled

    @property
    def area(self) -> Floats:
        """(t,) mm2."""
        return _area(self.corners)

    def blocks(self) -> Blocks:
        """Stiffness and mass as blocks between the nodes."""
        flat = np.zeros((len(self.triangles), 18, 18))
        flat[:, _IN_PLANE[:, None], _IN_PLANE] = self._membrane()
        bent = np.zeros((len(self.panels.of), 18, 18))
        bent[:, _ACROSS[:, None], _ACROSS] = self._bending()
        weight = self.material.density * self.area * self.acting / 12.0
        inertia = weight * self.acting**2 / 12.0
        each = np.zeros((len(weight), 6))
        each[:, :3], each[:, 3:] = weight[:, None], inertia[:, None]
        shared = (1.0 + np.eye(3))[None, :, :, None, None] * (each[:, :, None] * np.eye(6))[
            :, None, None
        ]
        nodes = np.concatenate([self.triangles, self.panels.nodes])
        rows, columns = np.repeat(nodes, 3, axis=1).ravel(), np.tile(nodes, (1, 3)).ravel()
        stiffness = np.concatenate(
            [_split(flat, self.axes), _split(bent, self.axes[self.panels.of])]
        )
        mass = np.zeros_like(stiffness)
        mass[: 9 * len(weight)] = shared.reshape(-1, 6, 6)
        return Blocks(rows, columns, stiffness, mass)

    def of_thickness(self, thickness: Floats) -> Shells:
        """The same triangles with other thicknesses (t,), mm."""
        return replace(self, thickness=thickness)

    def unit_blocks(self) -> UnitBlocks:
        """Blocks between the triangles' corners, of which any thickness can be made."""
        count, of = len(self.triangles), self.panels.of
        unit = self.of_thickness(np.ones(count))
        flat, bent = np.zeros((2, count, 18, 18))
        flat[:, _IN_PLANE[:, None], _IN_PLANE] = unit._membrane()
        # A panel's corners hang on those of its triangle.
        is_at, each = self._is_at(), unit._bending().reshape(-1, 3, 3, 3, 3)
        whole = np.einsum("bam,baicj,bcn->bminj", is_at, each, is_at, optimize=True)
        summed = np.zeros((count, 9, 9))
        np.add.at(summed, of, whole.reshape(-1, 9, 9))
        bent[:, _ACROSS[:, None], _ACROSS] = summed
        weight = self.material.density * self.area * self.filled / 12.0
        shared = (1.0 + np.eye(3))[None, :, :, None, None] * weight[:, None, None, None, None]
        turned = shared * (self.filled**2 / 12.0)[:, None, None, None, None]
        moves, turns = np.diag([1.0] * 3 + [0.0] * 3), np.diag([0.0] * 3 + [1.0] * 3)
        return UnitBlocks(
            np.repeat(self.triangles, 3, axis=1).ravel(),
            np.tile(self.triangles, (1, 3)).ravel(),
            _split(flat, self.axes),
            _split(bent, self.axes),
            (shared * moves).reshape(-1, 6, 6),
            (turned * turns).reshape(-1, 6, 6),
        )

    def stress_blocks(self) -> tuple[Floats, Floats]:
        """What corners' displacements are as stress, which thickness does not change.

        Returns:
            Twice (t, 3, 18), of the corners' six in global axes: xx, yy and xy in the triangles'
            axes, MPa, mean over the thickness; and what bending adds on one side of 1 mm, mean
            over each triangle, where what is as good as rigid does not bend.
        """
        of, plane = self.panels.of, self._plane_stress()
        curved = self._curvature(np.full(2, 1.0 / 3.0)) @ self._led()
        share = 0.5 * _area(self.panels.corners) / self.area[of]
        each = ((share * self.filled[of])[:, None, None] * (plane @ curved)).reshape(-1, 3, 3, 3)
        summed = np.zeros((len(self.area), 3, 9))
        whole = np.einsum("bsai,bam->bsmi", each, self._is_at(), optimize=True)
        np.add.at(summed, of, whole.reshape(-1, 3, 9))
        bent = np.zeros((len(summed), 3, 18))
        bent[:, :, _ACROSS] = summed
        return self._of_global(plane @ self._strains()), self._of_global(bent)

    def _of_global(self, blocks: Floats) -> Floats:
        """(t, s, 18) of corners' displacements in global axes, of those in the triangles' own."""
        parts = blocks.reshape(*blocks.shape[:2], 6, 3)
        return np.asarray(np.einsum("tsgi,tij->tsgj", parts, self.axes).reshape(blocks.shape))

    def _is_at(self) -> Floats:
        """(b, 3, 3) which corner of its triangle each corner of a panel hangs on, 0 or 1."""
        at = self.panels.nodes[:, :, None] == self.triangles[self.panels.of][:, None, :]
        return np.asarray(at, float)

    def in_plane(self, displacements: Floats) -> Floats:
        """(t, 3, k) xx, yy and xy in the triangles' axes, MPa, mean over the thickness."""
        displacements = _in_axes(displacements[self.triangles], self.axes)
        return np.asarray(self._plane_stress() @ (self._strains() @ displacements))

    def pressed(self, displacements: Floats) -> Floats:
        """(9 t, 6, 6) blocks as of `unit_blocks` that the stress in the plane adds to stiffness.

        Of displacements (n, 6), which may be so many times as large.
        """
        force = self.acting[:, None] * self.in_plane(displacements[:, :, None])[:, :, 0]
        slopes = self._slopes()
        one, two, both = force.T
        way = np.stack([np.stack([one, both], axis=1), np.stack([both, two], axis=1)], axis=1)
        traction = way[:, None, None] @ slopes
        flat = (len(force), -1, 18)
        weight = (self.area / 3.0)[:, None, None]
        whole = weight * (slopes.reshape(flat).swapaxes(1, 2) @ traction.reshape(flat))
        return _split(whole, self.axes)

    def pressed_work(self, mode: Floats) -> Floats:
        """(t, 3) of a mode (n, 6): what `pressed` does in it, for a force of 1 N/mm each way."""
        displacements = _in_axes(mode[self.triangles][..., None], self.axes)[:, None, None]
        x, y = (self._slopes() @ displacements)[..., 0].transpose(3, 0, 1, 2)
        each = np.stack([x * x, y * y, 2.0 * x * y], axis=1).sum(axis=(2, 3))
        return np.asarray((self.area / 3.0)[:, None] * each)

    def pressed_gradient(self, force: Floats) -> Floats:
        """(t, 3, 6) at the corners: derivative of forces in the plane (t, 3), times (t, 3) of them.

        In global axes, to the displacements of the corners.
        """
        stress = (self.acting[:, None] * force) @ self._plane_stress()
        local = np.einsum("tsi,ts->ti", self._strains(), stress).reshape(-1, 3, 2, 3)
        return np.asarray(np.einsum("tij,tcgi->tcgj", self.axes, local).reshape(-1, 3, 6))

    def _strains(self) -> Floats:
        """(t, 3, 18) strains in the plane, of displacements and turns of the corners."""
        (x, y) = (self.corners[..., 0], self.corners[..., 1])
        strain = np.zeros((len(x), 3, 18))
        for corner in range(3):
            one, two = (corner + 1) % 3, (corner + 2) % 3
            strain[:, 0, 6 * corner] = strain[:, 2, 6 * corner + 1] = y[:, one] - y[:, two]
            strain[:, 1, 6 * corner + 1] = strain[:, 2, 6 * corner] = x[:, two] - x[:, one]
        return np.asarray(strain / (2.0 * self.area)[:, None, None])

    def _slopes(self) -> Floats:
        """(t, 3, 3, 2, 18) slopes of the three displacements at the middles of the edges.

        In the plane they are those of straight edges; across it those that the bending has.
        """
        strain, corners = self._strains(), self.corners
        result = np.zeros((len(corners), 3, 3, 2, 18))
        for corner in range(3):
            across = strain[:, 0, 6 * corner], strain[:, 1, 6 * corner + 1]
            for way in (0, 1):
                for axis in (0, 1):
                    result[:, :, axis, way, 6 * corner + axis] = across[way][:, None]
        for place, (i, j) in enumerate(((0, 1), (1, 2), (2, 0))):
            edge = corners[:, j] - corners[:, i]
            long = np.linalg.norm(edge, axis=1)
            along = edge / long[:, None]
            # w,x is minus the turn about y, w,y the turn about x. Along the edge w is cubic.
            for corner, sign in ((i, -1.0), (j, 1.0)):
                result[:, place, 2, :, 6 * corner + 2] += sign * 1.5 * along / long[:, None]
                for column, slope in ((4, (-1.0, 0.0)), (3, (0.0, 1.0))):
                    own = along @ np.array(slope)
                    result[:, place, 2, :, 6 * corner + column] += (
                        0.5 * np.array(slope) - 0.75 * own[:, None] * along
                    )
        return result

    def _plane_stress(self) -> Floats:
        """(3, 3) stress of strain, E / (1 - nu2)."""
        nu = self.material.poisson
        matrix = np.array([[1.0, nu, 0.0], [nu, 1.0, 0.0], [0.0, 0.0, 0.5 * (1.0 - nu)]])
        return np.asarray(self.material.young / (1.0 - nu**2) * matrix)

    def _membrane(self) -> Floats:
        """(t, 9, 9) in the plane: two displacements and the turn about the normal."""
        (x1, x2, x3), (y1, y2, y3) = self.corners[..., 0].T, self.corners[..., 1].T
        x12, x23, x31, y12, y23, y31 = x1 - x2, x2 - x3, x3 - x1, y1 - y2, y2 - y3, y3 - y1
        x21, x32, x13, y21, y32, y13 = -x12, -x23, -x31, -y12, -y23, -y31
        area, thick, nil = self.area, self.acting, np.zeros(len(x1))
        alpha = 1.5
        lumped = np.array(
            [
                [y23, nil, x32],
                [nil, x32, y23],
                [alpha / 6 * y23 * (y13 - y21), alpha / 6 * x32 * (x31 - x12),
                 alpha / 3 * (x31 * y13 - x12 * y21)],
                [y31, nil, x13],
                [nil, x13, y31],
                [alpha / 6 * y31 * (y21 - y32), alpha / 6 * x13 * (x12 - x23),
                 alpha / 3 * (x12 * y21 - x23 * y32)],
                [y12, nil, x21],
                [nil, x21, y12],
                [alpha / 6 * y12 * (y32 - y13), alpha / 6 * x21 * (x23 - x31),
                 alpha / 3 * (x23 * y32 - x31 * y13)],
            ]
        ).transpose(2, 0, 1) * (0.5 * thick)[:, None, None]  # fmt: skip
        plane = self._plane_stress()
        basic = lumped @ plane @ lumped.swapaxes(1, 2) / (area * thick)[:, None, None]
        squares = np.stack([x21**2 + y21**2, x32**2 + y32**2, x13**2 + y13**2], axis=1)
        natural = np.array(
            [
                [y23 * y13, y31 * y21, y12 * y32],
                [x23 * x13, x31 * x21, x12 * x32],
                [y23 * x31 + x32 * y13, y31 * x12 + x13 * y21, y12 * x23 + x21 * y32],
            ]
        ).transpose(2, 0, 1)
        natural = natural * squares[:, None, :] / (4.0 * area**2)[:, None, None]
        along = natural.swapaxes(1, 2) @ plane @ natural
        (b1, b2, b3), (b4, b5, b6), (b7, b8, b9) = _BETA
        kinds = [
            np.array([[b1, b2, b3], [b4, b5, b6], [b7, b8, b9]]),
            np.array([[b9, b7, b8], [b3, b1, b2], [b6, b4, b5]]),
            np.array([[b5, b6, b4], [b8, b9, b7], [b2, b3, b1]]),
        ]
        scale = (2.0 / 3.0 * area)[:, None, None] / squares[:, :, None]
        corner = [kind * scale for kind in kinds]
        higher = np.zeros((len(x1), 3, 3))
        for one, two in ((0, 1), (1, 2), (2, 0)):
            edge = 0.5 * (corner[one] + corner[two])
            higher += edge.swapaxes(1, 2) @ along @ edge
        rigid = np.zeros((len(x1), 3, 9))
        for node, (dx, dy) in enumerate(((x32, y32), (x13, y13), (x21, y21))):
            rigid[:, :, 3 * node] = (dx / (4.0 * area))[:, None]
            rigid[:, :, 3 * node + 1] = (dy / (4.0 * area))[:, None]
            rigid[:, node, 3 * node + 2] = 1.0
        beta = max(0.5 * (1.0 - 4.0 * self.material.poisson**2), 0.01)
        factor = (0.75 * beta * thick * area)[:, None, None]
        result: Floats = basic + factor * (rigid.swapaxes(1, 2) @ higher @ rigid)
        return result

    def _led(self) -> Floats:
        """(b, 9, 9) what nodes' displacements across and turns are at the panels' corners."""
        result = np.zeros((len(self.panels.of), 9, 9))
        result[:] = np.eye(9)
        for corner in range(3):
            result[:, 3 * corner, 3 * corner + 1] = self.panels.arms[:, corner, 1]
            result[:, 3 * corner, 3 * corner + 2] = -self.panels.arms[:, corner, 0]
        return result

    def _bending(self) -> Floats:
        """(b, 9, 9) across the plane: displacement and two turns of the panels' nodes."""
        plane, led = self._plane_stress(), self._led()
        thickness, area = self.acting[self.panels.of], _area(self.panels.corners)
        rigidity = (thickness**3 / 12.0 * area / 3.0)[:, None, None]
        result = np.zeros((len(thickness), 9, 9))
        for place in _PLACES:
            curved = self._curvature(place) @ led
            result += rigidity * (curved.swapaxes(1, 2) @ plane @ curved)
        return result

    def _curvature(self, place: Floats) -> Floats:
        """(b, 3, 9) curvatures at a place (xi, eta) of displacements and turns of corners."""
        x, y = self.panels.corners[..., 0], self.panels.corners[..., 1]
        xi, eta = place
        p, q, t, r = {}, {}, {}, {}
        for k, (i, j) in ((4, (1, 2)), (5, (2, 0)), (6, (0, 1))):
            dx, dy = x[:, i] - x[:, j], y[:, i] - y[:, j]
            square = dx**2 + dy**2
            p[k], q[k] = -6 * dx / square, 3 * dx * dy / square
            t[k], r[k] = -6 * dy / square, 3 * dy**2 / square
        a, b = 1 - 2 * xi, 1 - 2 * eta
        x_xi = [
            p[6] * a + (p[5] - p[6]) * eta,
            q[6] * a - (q[5] + q[6]) * eta,
            -4 + 6 * (xi + eta) + r[6] * a - eta * (r[5] + r[6]),
            -p[6] * a + eta * (p[4] + p[6]),
            q[6] * a - eta * (q[6] - q[4]),
            -2 + 6 * xi + r[6] * a + eta * (r[4] - r[6]),
            -eta * (p[5] + p[4]),
            eta * (q[4] - q[5]),
            -eta * (r[5] - r[4]),
        ]
        y_xi = [
            t[6] * a + eta * (t[5] - t[6]),
            1 + r[6] * a - eta * (r[5] + r[6]),
            -q[6] * a + eta * (q[5] + q[6]),
            -t[6] * a + eta * (t[4] + t[6]),
            -1 + r[6] * a + eta * (r[4] - r[6]),
            -q[6] * a - eta * (q[4] - q[6]),
            -eta * (t[4] + t[5]),
            eta * (r[4] - r[5]),
            -eta * (q[4] - q[5]),
        ]
        x_eta = [
            -p[5] * b - xi * (p[6] - p[5]),
            q[5] * b - xi * (q[5] + q[6]),
            -4 + 6 * (xi + eta) + r[5] * b - xi * (r[5] + r[6]),
            xi * (p[4] + p[6]),
            xi * (q[4] - q[6]),
            -xi * (r[6] - r[4]),
            p[5] * b - xi * (p[4] + p[5]),
            q[5] * b + xi * (q[4] - q[5]),
            -2 + 6 * eta + r[5] * b + xi * (r[4] - r[5]),
        ]
        y_eta = [
            -t[5] * b - xi * (t[6] - t[5]),
            1 + r[5] * b - xi * (r[5] + r[6]),
            -q[5] * b + xi * (q[5] + q[6]),
            xi * (t[4] + t[6]),
            xi * (r[4] - r[6]),
            -xi * (q[4] - q[6]),
            t[5] * b - xi * (t[4] + t[5]),
            -1 + r[5] * b + xi * (r[4] - r[5]),
            -q[5] * b - xi * (q[4] - q[5]),
        ]
        hx, hy, kx, ky = (np.stack(row, axis=1) for row in (x_xi, y_xi, x_eta, y_eta))
        x31, x12 = (x[:, 2] - x[:, 0])[:, None], (x[:, 0] - x[:, 1])[:, None]
        y31, y12 = (y[:, 2] - y[:, 0])[:, None], (y[:, 0] - y[:, 1])[:, None]
        result: Floats = (
            np.stack(
                [
                    y31 * hx + y12 * kx,
                    -x31 * hy - x12 * ky,
                    -x31 * hx - x12 * kx + y31 * hy + y12 * ky,
                ],
                axis=1,
            )
            / (2.0 * _area(self.panels.corners))[:, None, None]
        )
        return result


def shells_of(
    nodes: Floats,
    triangles: Ints,
    thickness: Floats,
    material: Elastic,
    *,
    clear: Floats | None = None,
    pads: Floats | None = None,
    filled: Floats | None = None,
) -> Shells:
    """Triangles between nodes (n, 3), mm.

    Args:
        nodes: (n, 3) mm.
        triangles: (t, 3) rows of them.
        thickness: of all or (t,) of each, mm.
        material: of all.
        clear: (t, 3, 3) where each triangle's corners begin to bend, mm, in its plane; None for at
            the nodes.
        pads: (n,) about each node so far nothing bends either, mm; None for nowhere.
        filled: (t,) how many times as thick each acts; None for once.
    """
    triangles = triangles.astype(np.int64)
    a, b, c = nodes[triangles].swapaxes(0, 1)
    along = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
    normal = np.cross(along, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    axes = np.stack([along, np.cross(normal, along), normal], axis=1)
    corners = np.einsum("tij,tcj->tci", axes[:, :2], np.stack([a, b, c], axis=1) - a[:, None])
    begin = corners
    if clear is not None:
        begin = np.einsum("tij,tcj->tci", axes[:, :2], clear - a[:, None])
    pad = np.zeros(triangles.shape) if pads is None else pads[triangles]
    panels = _panels(triangles, corners, begin, pad)
    thickness = np.broadcast_to(thickness, len(a))
    filled = np.ones(len(a)) if filled is None else filled
    return Shells(triangles, axes, corners, thickness, material, panels, filled)


def _panels(triangles: Ints, corners: Floats, begin: Floats, pads: Floats) -> Panels:
    """Triangles less their pads: six corners on their edges, and the four triangles of these."""
    points, owners = [], []
    for one, two in ((0, 1), (1, 2), (2, 0)):
        span = begin[:, two] - begin[:, one]
        length = np.linalg.norm(span, axis=1)
        shares = pad_shares(length, pads[:, one], pads[:, two])
        for corner, sign, share in ((one, 1.0, shares[0]), (two, -1.0, shares[1])):
            points.append(begin[:, corner] + sign * share[:, None] * span)
            owners.append(corner)
    pieces = np.array([[0, 1, 2], [2, 3, 4], [4, 5, 0], [0, 2, 4]])
    every = np.stack(points, axis=1)[:, pieces].reshape(-1, 3, 2)
    own = np.tile(np.array(owners)[pieces], (len(triangles), 1))
    of = np.repeat(np.arange(len(triangles)), len(pieces))
    good = _area(every) > _LEAST_PANEL * _area(corners)[of]
    every, own, of = every[good], own[good], of[good]
    arms = every - corners[of[:, None], own]
    return Panels(of, triangles[of[:, None], own], every, arms)


def _area(corners: Floats) -> Floats:
    """(t,) mm2, of (t, 3, 2) corners that run anticlockwise."""
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.asarray(0.5 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]))


def _split(stiffness: Floats, axes: Floats) -> Floats:
    """(9 t, 6, 6) blocks in global axes, of (t, 18, 18) in the triangles' own."""
    turn = np.zeros_like(stiffness)
    for corner in range(0, 18, 3):
        turn[:, corner : corner + 3, corner : corner + 3] = axes
    whole = turn.swapaxes(1, 2) @ stiffness @ turn
    return np.asarray(whole.reshape(-1, 3, 6, 3, 6).swapaxes(2, 3).reshape(-1, 6, 6))


def _in_axes(displacements: Floats, axes: Floats) -> Floats:
    """(t, 18, k) displacements and turns (t, 3, 6, k) of corners, in the triangles' axes."""
    pairs = displacements.reshape(*displacements.shape[:2], 2, 3, -1)
    return np.asarray(
        np.einsum("tij,tcgjk->tcgik", axes, pairs).reshape(len(displacements), 18, -1)
    )


def worse_side(even: Floats, bent: Floats) -> Floats:
    """(t, k) the larger von Mises stress of both sides, of (t, 3, k) in plane and of bending."""
    sides = []
    for xx, yy, xy in ((even + sign * bent).swapaxes(0, 1) for sign in (1.0, -1.0)):
        sides.append(np.sqrt(xx**2 - xx * yy + yy**2 + 3.0 * xy**2))
    return np.asarray(np.maximum(*sides))
