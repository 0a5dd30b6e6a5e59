# SPDX-License-Identifier: LGPL-2.1-or-later
"""What struts feel: forces and stresses where they leave their joints, and buckling."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..util.types import Floats
from .tapered_beams import Beams


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
    pull, one, two, twist, about_two, about_three = (
        forces[:, None, row] for row in (0, 1, 2, 3, 4, 5)
    )
    moment = np.hypot(about_three + arm * one, about_two - arm * two)
    area = (np.pi * radius**2)[:, :, None]
    modulus = (0.25 * np.pi * radius**3)[:, :, None]
    return StrutStresses(
        pull / area,
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
    held = np.zeros((count, 3, 3))
    np.add.at(held, beams.struts[:, 0], bend + twist)
    np.add.at(held, beams.struts[:, 1], bend + twist)
    across = beams.axes[:, 1:]
    own = bend + twist
    fixity = np.empty((len(radii), 2))
    for end in (0, 1):
        others = held[beams.struts[:, end]] - own
        plane = across @ others @ across.swapaxes(1, 2)
        softest = np.linalg.eigvalsh(plane)[:, 0]
        fixity[:, end] = np.maximum(softest, 0.0) * beams.length / (young * inertia)
    factor = ((np.pi**2 + 2.0 * fixity) / (np.pi**2 + fixity)).prod(axis=1)
    return np.asarray(factor * np.pi**2 * young * inertia / beams.length**2)
