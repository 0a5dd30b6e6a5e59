# SPDX-License-Identifier: LGPL-2.1-or-later
"""What struts feel: forces and stresses where they leave their joints, and buckling.

A strut by itself buckles between joints that stay. How struts buckle together needs their stiffness
under the forces in them: that of columns, whose places between the joints are solved for exactly,
so that a strut is still one block between two nodes (J. S. Przemieniecki, Theory of Matrix
Structural Analysis, 1968, chapter 15).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..util.linalg import cross_matrix
from ..util.types import Floats
from .tapered_beams import Beams

#: Pieces of a column: clamped at both ends, it buckles within 0.2 % of Euler's load.
_PIECES = 6
#: Its unknowns, a shift and a slope at every border of a piece: those of the ends first.
_ORDER = (0, 1, 2 * _PIECES, 2 * _PIECES + 1, *range(2, 2 * _PIECES))
#: Freedoms of a strut's ends (shift and slope, twice) in its two planes, and their signs.
_PLANES = (((1, 5, 7, 11), (1.0, 1.0, 1.0, 1.0)), ((2, 4, 8, 10), (1.0, -1.0, 1.0, -1.0)))


@dataclass(frozen=True, eq=False)
class StrutStresses:
    """Stresses of round struts at both ends, where the joint lets them go, in every case; MPa.

    Attributes:
        axial: (m, 2, k) positive in tension.
        bending: (m, 2, k) at the rim, not negative.
        shear: (m, 2, k) of the force across, at the axis (4/3 of the mean), not negative.
        torsion: (m, 2, k) at the rim, not negative.
    """

    axial: Floats
    bending: Floats
    shear: Floats
    torsion: Floats

    @property
    def mises(self) -> Floats:
        """(m, 2, k) von Mises' stress: the larger of that at the rim and that at the axis."""
        rim = (np.abs(self.axial) + self.bending) ** 2 + 3.0 * self.torsion**2
        axis = self.axial**2 + 3.0 * self.shear**2
        return np.asarray(np.sqrt(np.maximum(rim, axis)))


def stresses(beams: Beams, radii: Floats, forces: Floats) -> StrutStresses:
    """The stresses of struts of radii (m, 2) from their forces (m, 6, k)."""
    stiff = beams.stiff_lengths(radii)
    length = beams.length
    place = np.stack([stiff[:, 0], length - stiff[:, 1]], axis=1)
    share = place / length[:, None]
    radius = radii[:, :1] * (1.0 - share) + radii[:, 1:] * share
    arm = (length[:, None] - place)[:, :, None]
    axial, one, two, twist, about_two, about_three = (
        forces[:, None, row] for row in (0, 1, 2, 3, 4, 5)
    )
    moment = np.hypot(about_three + arm * one, about_two - arm * two)
    area = (np.pi * radius**2)[:, :, None]
    modulus = (0.25 * np.pi * radius**3)[:, :, None]
    return StrutStresses(
        axial / area,
        moment / modulus,
        4.0 / 3.0 * np.hypot(one, two) / area,
        np.abs(twist) / (2.0 * modulus),
    )


def buckling_loads(beams: Beams, radii: Floats, count: int) -> Floats:
    """(m,) N, the pull at which each strut buckles between joints that its neighbours hold.

    A cone with pinned ends buckles as a cylinder of the mean I, the geometric one (A. N. Dinnik,
    1932). Ends that springs hold: N. M. Newmark, "A simple approximate formula for effective
    end-fixity of columns", J. Aeronaut. Sci. 16, 1949, within 4 %. A joint's spring is what the
    other struts there resist when it turns about the softest axis across the strut, each bent as
    one whose far joint turns alike (2 E I / L); joints do not shift.

    Args:
        beams: the struts.
        radii: (m, 2) of them, mm.
        count: of nodes.
    """
    young = beams.material.young
    inertia = 0.25 * np.pi * radii[:, 0] ** 2 * radii[:, 1] ** 2
    along = beams.axes[:, 0, :, None] * beams.axes[:, 0, None, :]
    bend = (2.0 * young * inertia / beams.length)[:, None, None] * (np.eye(3) - along)
    twist = (beams.material.shear * 2.0 * inertia / beams.length)[:, None, None] * along
    restraint = np.zeros((count, 3, 3))
    np.add.at(restraint, beams.struts[:, 0], bend + twist)
    np.add.at(restraint, beams.struts[:, 1], bend + twist)
    across = beams.axes[:, 1:]
    own = bend + twist
    fixity = np.empty((len(radii), 2))
    for end in (0, 1):
        others = restraint[beams.struts[:, end]] - own
        plane = across @ others @ across.swapaxes(1, 2)
        softest = np.linalg.eigvalsh(plane)[:, 0]
        fixity[:, end] = np.maximum(softest, 0.0) * beams.length / (young * inertia)
    factor = ((np.pi**2 + 2.0 * fixity) / (np.pi**2 + fixity)).prod(axis=1)
    return np.asarray(factor * np.pi**2 * young * inertia / beams.length**2)


@dataclass(frozen=True, eq=False)
class Columns:
    """Struts whose stiffness against bending goes with the pull in them.

    Round struts bend alike in both planes: shifts and slopes at the borders of their pieces are the
    unknowns, of which those between the ends follow the ends.

    Attributes:
        beams: the struts.
        flexibility: (m, 5) of them without a pull.
        stiffness: (m, q, q) against bending, ends' unknowns first.
        string: (m, q, q) what a pull of 1 N adds.
        shares: (m, 2, p) of the second end's shift along the strut, and of its turn about it, that
            the borders of the pieces have.
    """

    beams: Beams
    flexibility: Floats
    stiffness: Floats
    string: Floats
    shares: Floats

    def clamped(self) -> Floats:
        """(m,) N, the load at which each strut buckles between ends that neither move nor turn."""
        lower = np.linalg.cholesky(self.stiffness[:, 4:, 4:])
        half = np.linalg.solve(lower, self.string[:, 4:, 4:])
        softness = np.linalg.eigvalsh(np.linalg.solve(lower, half.swapaxes(1, 2)))[:, -1]
        return np.asarray(1.0 / softness)

    def between_ends(self, axial: Floats) -> tuple[Floats, Floats, Floats]:
        """Stiffness of the ends against bending in a plane under pulls (m,), N.

        Pulls are above minus what `clamped` says.

        Returns:
            (m, 4, 4) of shifts and slopes; the same as its derivative to the pull; and (m, q, 4)
            all unknowns of those of the ends.
        """
        whole = self.stiffness + axial[:, None, None] * self.string
        follow = -np.linalg.solve(whole[:, 4:, 4:], whole[:, 4:, :4])
        ends = whole[:, :4, :4] + whole[:, :4, 4:] @ follow
        shape = np.concatenate([np.broadcast_to(np.eye(4), ends.shape), follow], axis=1)
        return ends, shape.swapaxes(1, 2) @ self.string @ shape, shape

    def blocks(self, factor: float, forces: Floats) -> tuple[_Parts, _Parts]:
        """Blocks as of `Beams.stiffness`, under `factor` times forces (m, 6), N and N mm.

        And their derivative to the factor.
        """
        turn = _turned(self.beams)
        one, two = (turn.swapaxes(1, 2) @ each @ turn for each in self._own(factor, forces))
        return _parts(one), _parts(two)

    def work(self, forces: Floats, mode: Floats) -> Floats:
        """(m,) of the struts' ends in a mode (n, 6), under forces (m, 6): mode K mode."""
        displacements = self._ends(mode)
        return np.asarray(
            np.einsum("mi,mij,mj->m", displacements, self._own(1.0, forces)[0], displacements)
        )

    def turned_by(self, forces: Floats, mode: Floats) -> Floats:
        """(m, 6) derivative of `work` to each of the forces."""
        displacements = self._ends(mode)
        shape = self.between_ends(forces[:, 0])[2]
        result = np.zeros((len(displacements), 6))
        for row in range(6):
            unit = np.zeros_like(forces)
            unit[:, row] = 1.0
            if row > 0:
                added = self._turning(shape, unit)
                result[:, row] = np.einsum("mi,mij,mj->m", displacements, added, displacements)
        softer = shape.swapaxes(1, 2) @ self.string @ shape
        for freedoms, signs in _PLANES:
            bent = displacements[:, list(freedoms)] * signs
            result[:, 0] += np.einsum("mi,mij,mj->m", bent, softer, bent)
        return result

    def _ends(self, mode: Floats) -> Floats:
        """(m, 12) how the struts' ends move and turn in a mode (n, 6), in their own axes."""
        both = mode[self.beams.struts].reshape(-1, 12)
        return np.asarray(np.einsum("mij,mj->mi", _turned(self.beams), both))

    def _own(self, factor: float, forces: Floats) -> tuple[Floats, Floats]:
        """(m, 12, 12) what `blocks` says, in the struts' own axes."""
        axial = forces[:, 0]
        ends, softer, shape = self.between_ends(factor * axial)
        change = self._turning(shape, forces)
        local = factor * change
        for freedoms, signs in _PLANES:
            at, sign = np.array(freedoms), np.outer(signs, signs)
            local[:, at[:, None], at] += ends * sign
            change[:, at[:, None], at] += softer * sign * axial[:, None, None]
        for row, flexible in ((0, self.flexibility[:, 0]), (3, self.flexibility[:, 1])):
            for one, other in ((row, row), (row + 6, row + 6), (row, row + 6), (row + 6, row)):
                local[:, one, other] += (1.0 if one == other else -1.0) / flexible
        return local, change

    def _turning(self, shape: Floats, forces: Floats) -> Floats:
        """(m, 12, 12) what shear, bending and torque do when the sections they act on turn.

        The second-order part of the strains of a beam whose sections turn by a vector (J. C. Simo
        & L. Vu-Quoc, Comput. Methods Appl. Mech. Eng. 58, 1986), so that moments are in balance at
        turned joints, too.
        """
        count, every = len(shape), np.array(_ORDER)
        shift, slope = shape[:, np.argsort(every)].reshape(count, _PIECES + 1, 2, 4).swapaxes(0, 2)
        shift, slope = shift.swapaxes(0, 1), slope.swapaxes(0, 1)
        shifted, turned = np.zeros((2, count, _PIECES + 1, 3, 12))
        (one, _), (two, signs) = _PLANES
        shifted[:, :, 1, one], turned[:, :, 2, one] = shift, slope
        shifted[:, :, 2, two], turned[:, :, 1, two] = shift * signs, -slope * signs
        for field, row, share in ((shifted, 0, self.shares[:, 0]), (turned, 0, self.shares[:, 1])):
            first = 0 if field is shifted else 3
            field[:, :, row, first], field[:, :, row, first + 6] = 1.0 - share, share
        result = np.zeros((count, 12, 12))
        across = forces[:, :3] * (0.0, 1.0, 1.0)
        step = self.beams.length / _PIECES
        for piece in range(_PIECES):
            turn = 0.5 * (turned[:, piece] + turned[:, piece + 1])
            arm = self.beams.length - (piece + 0.5) * step
            moment = forces[:, 3:].copy()
            moment[:, 1] -= arm * forces[:, 2]
            moment[:, 2] += arm * forces[:, 1]
            along = (0.5 * step)[:, None, None] * across[:, :, None] * np.eye(3)[0]
            half = turn.swapaxes(1, 2) @ (
                cross_matrix(across) @ (shifted[:, piece + 1] - shifted[:, piece])
                + 0.5 * cross_matrix(moment) @ (turned[:, piece + 1] - turned[:, piece])
                + along @ turn
            )
            result += half + half.swapaxes(1, 2)
        return result


_Parts = tuple[Floats, Floats, Floats]


def columns_of(beams: Beams, radii: Floats) -> Columns:
    """The struts as columns of radii (m, 2), mm."""
    count, length = len(radii), beams.length
    stiffness, string = np.zeros((2, count, len(_ORDER), len(_ORDER)))
    along = np.zeros((count, 2, _PIECES + 1))
    step = length / _PIECES
    rigid = np.zeros((count, 2, 4))
    rigid[:, 0, 0] = rigid[:, 1, 1] = -1.0
    rigid[:, 0, 1] = -step
    rigid[:, 0, 2] = rigid[:, 1, 3] = 1.0
    slide = 12.0 * beams.material.young / (4.0 * beams.material.shear * beams.section.shear)
    for piece in range(_PIECES):
        first, last = piece / _PIECES, (piece + 1) / _PIECES
        axial, twist, slope, mixed, shift = beams.flexibility_between(radii, first, last).T
        along[:, :, piece + 1] = np.stack([axial, twist], axis=1)
        rest = slope * shift - mixed**2
        stiff = (
            np.array([[slope, -mixed], [-mixed, shift]]).transpose(2, 0, 1) / rest[:, None, None]
        )
        middle = 0.5 * (first + last)
        radius = radii[:, 0] * (1.0 - middle) + radii[:, 1] * middle
        at = slice(2 * piece, 2 * piece + 4)
        stiffness[:, at, at] += rigid.swapaxes(1, 2) @ stiff @ rigid
        string[:, at, at] += _string(step, slide * (radius / step) ** 2)
    stiffness, string = (each[:, _ORDER][:, :, _ORDER] for each in (stiffness, string))
    shares = np.cumsum(along, axis=2)
    shares /= shares[:, :, -1:].copy()
    return Columns(beams, beams.flexibility(radii), stiffness, string, shares)


def _string(length: Floats, slide: Floats) -> Floats:
    """(m, 4, 4) what a pull of 1 N adds to a beam, which also slides: 12 E I / (G A L2)."""
    a = 6.0 / 5.0 + 2.0 * slide + slide**2
    b = 0.1 * length
    c = length**2 * (2.0 / 15.0 + slide / 6.0 + slide**2 / 12.0)
    d = -(length**2) * (1.0 / 30.0 + slide / 6.0 + slide**2 / 12.0)
    rows = [[a, b, -a, b], [b, c, -b, d], [-a, -b, a, -b], [b, d, -b, c]]
    scale = length * (1.0 + slide) ** 2
    return np.asarray(np.array(rows).transpose(2, 0, 1) / scale[:, None, None])


def _turned(beams: Beams) -> Floats:
    """(m, 12, 12) from global axes into the struts' own."""
    turn = np.zeros((len(beams.length), 12, 12))
    for corner in range(0, 12, 3):
        turn[:, corner : corner + 3, corner : corner + 3] = beams.axes
    return turn


def _parts(whole: Floats) -> _Parts:
    return whole[:, :6, :6], whole[:, :6, 6:], whole[:, 6:, 6:]
