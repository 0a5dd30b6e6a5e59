# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts as beams: cones between two nodes whose ends their joints stiffen, all of them at once.

The stiffness of a strut comes from its flexibility, which is an integral along it: so cones are as
exact as cylinders and need no division, and what a change of a radius does to the whole is read
off the forces in the strut (J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..mechanics.frame import CIRCLE, JointLaw, Section
from ..util.linalg import axes_across, cross_matrix
from ..util.types import Bools, Floats, Ints

#: No stiffened end is longer than this part of its strut (as in the deck for CalculiX).
LONGEST_END = 0.45
#: Points of Gauss's rule along the cone, and along each stiffened end.
_ALONG, _IN_END = 6, 3
#: Step of a radius for derivatives, relative.
_STEP = 1e-5


@dataclass(frozen=True)
class Elastic:
    """What of a material counts for beams.

    Attributes:
        young: MPa.
        poisson: the solid's ratio.
        density: t/mm3, which goes with N, mm and s.
    """

    young: float
    poisson: float = 0.3
    density: float = 1e-9

    @property
    def shear(self) -> float:
        """The shear modulus, MPa."""
        return self.young / (2.0 * (1.0 + self.poisson))


#: (m, 2, 3) of radii (m, 2), mm: length in radii, axial and bending factor of the ends.
EndTable = Callable[[Floats], Floats]


def bare_ends(radii: Floats) -> Floats:
    """Ends that no joint stiffens."""
    return np.broadcast_to(np.array([0.0, 1.0, 1.0]), (*radii.shape, 3))


def end_table(law: JointLaw, smallest: float, largest: float) -> EndTable:
    """A cell's fitted ends as a function of many radii at once.

    Args:
        law: the ends of one radius, mm (`volfrep.mechanics.catalogue.joint_law`).
        smallest: between this radius and the largest the law is asked, and interpolated; mm.
        largest: mm.
    """
    at = np.geomspace(smallest * 0.999, largest * 1.001, 41)
    ends = [law(radius) for radius in at.tolist()]
    logs = np.log([[end.length, end.axial, end.bending] for end in ends])
    return partial(_read_table, np.log(at), logs)


def _read_table(at: Floats, logs: Floats, radii: Floats) -> Floats:
    """(n, 3) of (n,) radii, by logarithms: a function of its own, so that its table pickles."""
    place = np.log(radii)
    found = [np.interp(place, at, row) for row in logs.T]
    return np.asarray(np.exp(np.stack(found, axis=-1)))


@dataclass(frozen=True, eq=False)
class Beams:
    """Struts in space, whose radii are given when something is asked.

    Attributes:
        struts: (m, 2) int64, rows of the nodes.
        length: (m,) mm.
        axes: (m, 3, 3) along the strut, and two directions across it.
        joined: (m, 2) bool, whether a joint stiffens this end.
        material: of all of them.
        section: what their section has over a circle's.
        ends: how joints stiffen them.
    """

    struts: Ints
    length: Floats
    axes: Floats
    joined: Bools
    material: Elastic
    section: Section = CIRCLE
    ends: EndTable = bare_ends

    def flexibility(self, radii: Floats) -> Floats:
        """(m, 5) of the second end, the first one held: what a unit force or moment there does.

        Stretch by a pull; twist by a torque; slope by a moment; slope by a force across (and shift
        by a moment); shift by a force across.
        """
        return self.flexibility_between(radii, 0.0, 1.0)

    def flexibility_between(self, radii: Floats, first: float, last: float) -> Floats:
        """(m, 5) as `flexibility`, of a piece of each strut between two shares of its length."""
        length, material = self.length, self.material
        table = self.ends(radii)
        stiff = self.stiff_lengths(radii, table)
        borders = np.stack([0.0 * length, stiff[:, 0], length - stiff[:, 1], length], axis=1)
        start, end = first * length[:, None], last * length[:, None]
        borders = np.clip(borders, start, end)
        result = np.zeros((len(length), 5))
        for zone, points in ((0, _IN_END), (1, _ALONG), (2, _IN_END)):
            place, weight = _gauss(points)
            low, high = borders[:, zone, None], borders[:, zone + 1, None]
            x = 0.5 * (low + high) + 0.5 * (high - low) * place
            step = 0.5 * (high - low) * weight
            share = x / length[:, None]
            radius = radii[:, :1] * (1.0 - share) + radii[:, 1:] * share
            axial = bending = np.ones((1, 1))
            if zone != 1:
                axial, bending = table[:, zone // 2, 1:2], table[:, zone // 2, 2:3]
            area = np.pi * radius**2 * self.section.area * axial
            inertia = 0.25 * np.pi * radius**4
            bend = step / (material.young * inertia * bending)
            arm = end - x
            twist = step / (material.shear * 2.0 * inertia * self.section.torsion * bending)
            slide = step / (material.shear * self.section.shear * np.pi * radius**2 * axial)
            result[:, 0] += (step / (material.young * area)).sum(axis=1)
            result[:, 1] += twist.sum(axis=1)
            result[:, 2] += bend.sum(axis=1)
            result[:, 3] += (arm * bend).sum(axis=1)
            result[:, 4] += (arm**2 * bend + slide).sum(axis=1)
        return result

    def stiff_lengths(self, radii: Floats, table: Floats | None = None) -> Floats:
        """(m, 2) mm, how far the joints reach into the struts."""
        table = self.ends(radii) if table is None else table
        reach = np.minimum(table[..., 0] * radii, LONGEST_END * self.length[:, None])
        return np.where(self.joined, reach, 0.0)

    def flexibility_changes(self, radii: Floats) -> Floats:
        """(m, 2, 5) derivative of the flexibility to the radius at each end."""
        result = np.empty((len(radii), 2, 5))
        for end in (0, 1):
            step = _STEP * radii[:, end]
            shifted = [radii.copy(), radii.copy()]
            shifted[0][:, end] -= step
            shifted[1][:, end] += step
            low, high = (self.flexibility(changed) for changed in shifted)
            result[:, end] = (high - low) / (2.0 * step[:, None])
        return result

    def stiffness(self, flexibility: Floats) -> tuple[Floats, Floats, Floats]:
        """Blocks (m, 6, 6) of the stiffness in global axes: first end, first to second, second."""
        axial, twist, slope, mixed, shift = flexibility.T
        rest = slope * shift - mixed**2
        along = self.axes[:, 0, :, None] * self.axes[:, 0, None, :]
        across = np.eye(3) - along
        second = np.empty((len(axial), 6, 6))
        second[:, :3, :3] = _times(1.0 / axial, along) + _times(slope / rest, across)
        second[:, 3:, 3:] = _times(1.0 / twist, along) + _times(shift / rest, across)
        second[:, :3, 3:] = _times(mixed / rest, cross_matrix(self.axes[:, 0]))
        second[:, 3:, :3] = second[:, :3, 3:].swapaxes(1, 2)
        carried = self._carried()
        between = -carried.swapaxes(1, 2) @ second
        return -between @ carried, between, second

    def forces(self, flexibility: Floats, first: Floats, second: Floats) -> Floats:
        """(m, 6, k) force and moment on the second ends, in local axes, of k displacements.

        Args:
            flexibility: of the struts.
            first: (m, 6, k) how the first ends move and turn, in global axes.
            second: the same of the second ends.
        """
        relative = second - self._carried() @ first
        shift = self.axes @ relative[:, :3]
        turn = self.axes @ relative[:, 3:]
        axial, twist, slope, mixed, lift = (column[:, None] for column in flexibility.T)
        rest = slope * lift - mixed**2
        return np.stack(
            [
                shift[:, 0] / axial,
                (slope * shift[:, 1] - mixed * turn[:, 2]) / rest,
                (slope * shift[:, 2] + mixed * turn[:, 1]) / rest,
                turn[:, 0] / twist,
                (lift * turn[:, 1] + mixed * shift[:, 2]) / rest,
                (lift * turn[:, 2] - mixed * shift[:, 1]) / rest,
            ],
            axis=1,
        )

    def strained(self, flexibility: Floats, strain: Floats) -> tuple[Floats, Floats]:
        """Loads at the ends that move the second ends (m, 6) against the first, in local axes.

        Returns:
            (m, 2, 6) at both ends, in global axes; and (m, 6) forces as of `forces`.
        """
        relative = np.concatenate(
            [np.einsum("mji,mj->mi", self.axes, part) for part in (strain[:, :3], strain[:, 3:])],
            axis=1,
        )[:, :, None]
        local = self.forces(flexibility, np.zeros_like(relative), relative)[:, :, 0]
        ends = np.empty((len(strain), 2, 6))
        ends[:, 1, :3] = np.einsum("mji,mj->mi", self.axes, local[:, :3])
        ends[:, 1, 3:] = np.einsum("mji,mj->mi", self.axes, local[:, 3:])
        ends[:, 0] = -np.einsum("mji,mj->mi", self._carried(), ends[:, 1])
        return ends, local

    def mass(self, radii: Floats) -> tuple[Floats, Floats, Floats]:
        """Consistent mass, blocks as `stiffness`, t and t mm2 (J. S. Archer, AIAA J. 3, 1965)."""
        place, weight = _gauss(5)
        share = 0.5 * (1.0 + place)
        length = self.length
        radius = radii[:, :1] * (1.0 - share) + radii[:, 1:] * share
        area = np.pi * radius**2
        step = 0.5 * weight * length[:, None] * self.material.density
        lift = np.stack([1 - 3 * share**2 + 2 * share**3, 3 * share**2 - 2 * share**3])
        tilt = np.stack([share - 2 * share**2 + share**3, share**3 - share**2])
        linear = np.stack([1 - share, share])
        local = np.zeros((len(length), 12, 12))
        fields = np.zeros((len(length), 4, 12, len(share)))
        fields[:, 0, [0, 6]] = linear
        fields[:, 1, [1, 7]] = fields[:, 2, [2, 8]] = lift
        fields[:, 1, [5, 11]] = tilt * length[:, None, None]
        fields[:, 2, [4, 10]] = -tilt * length[:, None, None]
        fields[:, 3, [3, 9]] = linear
        for kind, carried in enumerate((area, area, area, 0.5 * area * radius**2)):
            weighted = fields[:, kind] * (step * carried)[:, None, :]
            local += weighted @ fields[:, kind].swapaxes(1, 2)
        turn = np.zeros((len(length), 12, 12))
        for corner in range(0, 12, 3):
            turn[:, corner : corner + 3, corner : corner + 3] = self.axes
        whole = turn.swapaxes(1, 2) @ local @ turn
        return whole[:, :6, :6], whole[:, :6, 6:], whole[:, 6:, 6:]

    def _carried(self) -> Floats:
        """(m, 6, 6) how the second end moves when the first one does and the strut is rigid."""
        result = np.zeros((len(self.length), 6, 6))
        result[:] = np.eye(6)
        result[:, :3, 3:] = -_times(self.length, cross_matrix(self.axes[:, 0]))
        return result


def beams_of(
    nodes: Floats,
    struts: Ints,
    material: Elastic,
    *,
    joined: Bools | None = None,
    section: Section = CIRCLE,
    ends: EndTable = bare_ends,
) -> Beams:
    """Struts between nodes.

    Args:
        nodes: (n, 3) mm.
        struts: (m, 2) rows of `nodes`.
        material: of all struts.
        joined: (m, 2) which ends a joint stiffens; None for all.
        section: what the section has over a circle's.
        ends: how joints stiffen them; nothing by default.
    """
    struts = struts.astype(np.int64)
    span = nodes[struts[:, 1]] - nodes[struts[:, 0]]
    length = np.linalg.norm(span, axis=1)
    along = span / length[:, None]
    axes = np.stack([along, *axes_across(along)], axis=1)
    joined = np.ones((len(struts), 2), bool) if joined is None else joined
    return Beams(struts, length, axes, joined, material, section, ends)


def energies(one: Floats, other: Floats) -> Floats:
    """(m, 5, k) what multiplies each flexibility in the work of forces in strain of others.

    Args:
        one: (m, 6, k) forces as `Beams.forces` gives them.
        other: the same of the other loads.
    """
    return np.stack(
        [
            one[:, 0] * other[:, 0],
            one[:, 3] * other[:, 3],
            one[:, 4] * other[:, 4] + one[:, 5] * other[:, 5],
            one[:, 1] * other[:, 5] + one[:, 5] * other[:, 1]
            - one[:, 2] * other[:, 4] - one[:, 4] * other[:, 2],
            one[:, 1] * other[:, 1] + one[:, 2] * other[:, 2],
        ],
        axis=1,
    )  # fmt: skip


def _times(factors: Floats, matrices: Floats) -> Floats:
    result: Floats = factors[:, None, None] * matrices
    return result


def _gauss(points: int) -> tuple[Floats, Floats]:
    """Places from -1 to 1 and weights of Gauss's rule."""
    place, weight = np.polynomial.legendre.leggauss(points)  # type: ignore[no-untyped-call]
    return place, weight
