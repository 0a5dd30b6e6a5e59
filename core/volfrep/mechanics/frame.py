# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elastic tensor of a periodic frame: Timoshenko beams, rigidly joined, with stiffened ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..util.errors import VolfrepError
from ..util.linalg import axes_across
from ..util.types import Floats, Ints
from .elements import SHEARS

#: Stiffness below this part of the largest is a mechanism's.
_NOTHING = 1e-12


@dataclass(frozen=True)
class Section:
    """What a beam's section has, over that of a circle.

    Attributes:
        area, torsion: over a circle's of the same second moment of area.
        shear: the shear coefficient (Cowper, J. Appl. Mech. 33, 1966, at nu = 0.3).
    """

    area: float = 1.0
    torsion: float = 1.0
    shear: float = 0.886


CIRCLE = Section()
#: The square of the same second moment of area as the circle, as CalculiX's two-noded beams have.
SQUARE_SECTION = Section(np.sqrt(3.0 / np.pi), 0.1406 * 3.0 * np.pi / (np.pi / 2.0), 0.85)


@dataclass(frozen=True)
class Ends:
    """The stiffened ends of struts.

    Attributes:
        length: in units of the radius.
        axial: factor of their stiffness along and across the strut.
        bending: factor of their stiffness in bending and torsion.
    """

    length: float = 0.0
    axial: float = 1.0
    bending: float = 1.0

    @property
    def modulus(self) -> float:
        """Young's modulus of their material over the strut's, where width does the rest."""
        return self.axial**2 / self.bending


#: The stiffened ends of struts of a radius, mm.
JointLaw = Callable[[float], Ends]


@dataclass(frozen=True, eq=False)
class PeriodicFrame:
    """One period of a frame without end.

    Attributes:
        nodes: (n,) only how many there are: struts say where they begin and end.
        struts: (m, 2) int64, from 0 to nodes - 1.
        start, end: (m, 3) float64, the places of these ends, copies of nodes included.
        volume: of the period.
    """

    nodes: int
    struts: Ints
    start: Floats
    end: Floats
    volume: float = 1.0


def frame_tensor(
    frame: PeriodicFrame,
    radius: float,
    ends: Ends | None = None,
    *,
    section: Section = CIRCLE,
    poisson: float = 0.3,
    longest: float = 0.4,
) -> Floats:
    """(6, 6) stiffness, Voigt with engineering shear strains, of struts with Young's modulus 1.

    Args:
        frame: the struts.
        radius: of all of them.
        ends: how they are stiffened at both ends; None for bare beams.
        section: of the beams.
        poisson: the solid's ratio.
        longest: no end is longer than this part of its strut.

    Raises:
        VolfrepError: there are no struts.
    """
    stiffness = _strut_stiffness(frame, radius, ends or Ends(), section, poisson, longest)
    uniform, relaxed = _strain_frame(frame, stiffness)
    energy = np.einsum("mij,mik->jk", uniform, stiffness @ (uniform + relaxed))
    result: Floats = energy / frame.volume
    return result


def axial_forces(frame: PeriodicFrame, radius: float, ends: Ends | None = None) -> Floats:
    """(m, 6) forces that pull at struts with Young's modulus 1 under each unit strain, Voigt.

    Args:
        frame: the struts.
        radius: of all of them.
        ends: how they are stiffened at both ends; None for bare beams.

    Raises:
        VolfrepError: there are no struts.
    """
    stiffness = _strut_stiffness(frame, radius, ends or Ends(), CIRCLE, 0.3, 0.4)
    uniform, relaxed = _strain_frame(frame, stiffness)
    span = frame.end - frame.start
    along = span / np.linalg.norm(span, axis=1)[:, None]
    forces = stiffness @ (uniform + relaxed)
    result: Floats = np.einsum("mi,mij->mj", along, forces[:, 6:9])
    return result


def _strain_frame(frame: PeriodicFrame, stiffness: Floats) -> tuple[Floats, Floats]:
    """(m, 12, 6) displacements of struts' ends that go with unit strains, and those they add."""
    unknown = (6 * frame.struts[:, :, None] + np.arange(6)).reshape(-1, 12)
    size = 6 * frame.nodes
    matrix = np.zeros((size, size))
    np.add.at(matrix, (unknown[:, :, None], unknown[:, None, :]), stiffness)
    # Displacements of a strut's ends under each unit strain.
    uniform = np.zeros((len(frame.struts), 12, 6))
    for first, places in ((0, frame.start), (6, frame.end)):
        for axis in range(3):
            uniform[:, first + axis, axis] = places[:, axis]
        for case, (one, two) in enumerate(SHEARS, 3):
            uniform[:, first + one, case] = 0.5 * places[:, two]
            uniform[:, first + two, case] = 0.5 * places[:, one]
    forces = stiffness @ uniform
    load = np.zeros((size, 6))
    np.add.at(load, unknown, forces)
    values, vectors = np.linalg.eigh(matrix)
    kept = values > _NOTHING * values[-1]
    displacements = -vectors[:, kept] @ ((vectors[:, kept].T @ load) / values[kept, None])
    return uniform, displacements[unknown]


def stiffened(length: Floats, radius: float, ends: Ends) -> tuple[Floats, Floats]:
    """How many times as stiff as bare beams struts with stiffened ends are.

    Args:
        length: (m,) from node to node.
        radius: of all.
        ends: of theirs.

    Returns:
        (m,) when pulled, and (m,) when one end moves aside and neither turns.
    """
    zero = np.zeros((len(length), 3))
    far = zero + np.array([1.0, 0.0, 0.0]) * length[:, None]
    rows = np.zeros((len(length), 2), np.int64)
    struts = PeriodicFrame(1, rows, zero, far)
    found = _strut_stiffness(struts, radius, ends, CIRCLE, 0.3, 0.4)
    area = np.pi * radius**2
    return found[:, 0, 0] * length / area, found[:, 1, 1] * length**3 / (3.0 * area * radius**2)


def _strut_stiffness(
    frame: PeriodicFrame,
    radius: float,
    ends: Ends,
    section: Section,
    poisson: float,
    longest: float,
) -> Floats:
    """(m, 12, 12) of struts between their nodes, in global axes."""
    if not len(frame.struts):
        raise VolfrepError("A frame needs at least one strut.")
    span = frame.end - frame.start
    length = np.linalg.norm(span, axis=1)
    end = np.minimum(ends.length * radius, longest * length)
    along = span / length[:, None]
    axes = np.stack([along, *axes_across(along)], axis=1)  # (m, 3, 3)
    if ends.length == 0.0:
        local = _beam(length, radius, Ends(), section, poisson)
    else:
        stiff = _beam(end, radius, ends, section, poisson)
        middle = _beam(length - 2.0 * end, radius, Ends(), section, poisson)
        chain = np.zeros((len(length), 24, 24))
        for place, part in enumerate((stiff, middle, stiff)):
            rows = slice(6 * place, 6 * place + 12)
            chain[:, rows, rows] += part
        outer = np.r_[0:6, 18:24]
        inner = np.arange(6, 18)
        cross = chain[:, inner[:, None], outer]
        local = chain[:, outer[:, None], outer] - cross.swapaxes(1, 2) @ np.linalg.solve(
            chain[:, inner[:, None], inner], cross
        )
    turn = np.zeros((len(length), 12, 12))
    for place in range(0, 12, 3):
        turn[:, place : place + 3, place : place + 3] = axes
    result: Floats = turn.swapaxes(1, 2) @ local @ turn
    return result


def _beam(length: Floats, radius: float, ends: Ends, section: Section, poisson: float) -> Floats:
    """(m, 12, 12) of straight beams along their first local axis, with E = 1."""
    area = np.pi * radius**2 * section.area
    inertia = np.pi * radius**4 / 4.0
    shear = 1.0 / (2.0 * (1.0 + poisson))
    axial = ends.axial * area / length
    twist = ends.bending * shear * 2.0 * inertia * section.torsion / length
    bend = ends.bending * inertia
    slack = 12.0 * bend / (shear * section.shear * ends.axial * area * length**2)
    matrix = np.zeros((len(length), 12, 12))
    for first, value in ((0, axial), (3, twist)):
        matrix[:, first, first] = matrix[:, first + 6, first + 6] = value
        matrix[:, first, first + 6] = matrix[:, first + 6, first] = -value
    across = 12.0 * bend / length**3 / (1.0 + slack)
    mixed = 6.0 * bend / length**2 / (1.0 + slack)
    near = (4.0 + slack) * bend / length / (1.0 + slack)
    far = (2.0 - slack) * bend / length / (1.0 + slack)
    for shift, turn, sign in ((1, 5, 1.0), (2, 4, -1.0)):
        rows = (shift, turn, shift + 6, turn + 6)
        block = (
            (across, sign * mixed, -across, sign * mixed),
            (sign * mixed, near, -sign * mixed, far),
            (-across, -sign * mixed, across, -sign * mixed),
            (sign * mixed, far, -sign * mixed, near),
        )
        for row, entries in zip(rows, block, strict=True):
            for column, entry in zip(rows, entries, strict=True):
                matrix[:, row, column] = entry
    return matrix
