# SPDX-License-Identifier: LGPL-2.1-or-later
"""What struts do under a load case, strut by strut: to be shown, or compared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..util.types import Floats, Ints
from .analysis import Analysis, Problem

#: What struts may be coloured by: attributes of a `StrutState`, and what they are called.
QUANTITIES = {
    "radii": "Radius, mm",
    "stress": "Stress (von Mises), MPa",
    "buckling": "Share of the buckling load",
    "displacement": "Displacement, mm",
    "governing": "Governing limit",
}
#: Deformed, the largest displacement is drawn as this part of the lattice's size.
DRAWN = 0.05


@dataclass(frozen=True, eq=False)
class StrutState:
    """The struts of a lattice under one load case.

    Attributes:
        name: of the load case.
        ends: (m, 2, 3) mm, where the struts begin and end, not deformed.
        radii: (m, 2) mm.
        displacements: (m, 2, 3) mm, displacements of the ends.
        stress: (m, 2) von Mises at the ends, MPa.
        buckling: (m, 2) share of its buckling load that each strut carries, alike at both ends.
        governing: (m, 2) the row of what says how thick each strut is, in the names of
            `volfrep.jobs.sizing.governing`, alike at both ends and in all cases; None where nothing
            was sized.
    """

    name: str
    ends: Floats
    radii: Floats
    displacements: Floats
    stress: Floats
    buckling: Floats
    governing: Floats | None = None

    @property
    def displacement(self) -> Floats:
        """(m, 2) mm."""
        size: Floats = np.linalg.norm(self.displacements, axis=2)
        return size

    def values(self, quantity: str) -> Floats:
        """(m, 2) one of `QUANTITIES` at the ends."""
        values: Floats = getattr(self, quantity)
        return values


def strut_states(
    problem: Problem, analysis: Analysis, governing: Ints | None = None
) -> tuple[StrutState, ...]:
    """The struts of a design in each of its load cases.

    Args:
        problem: that was solved.
        analysis: its solution.
        governing: (m,) the row of what says how thick each strut is.
    """
    structure = problem.structure
    struts = structure.beams.struts
    ends = structure.nodes[struts]
    radii = problem.radii.of_struts(analysis.radii)
    displacements = analysis.displacements[struts, :3]  # (m, 2, 3, k)
    governed = None if governing is None else np.repeat(governing[:, None], 2, axis=1).astype(float)
    return tuple(
        StrutState(
            case.name,
            ends,
            radii,
            displacements[..., k],
            analysis.stress[..., k],
            np.repeat(analysis.buckling[:, k : k + 1], 2, axis=1),
            governed,
        )
        for k, case in enumerate(problem.cases)
    )


def value_range(states: Sequence[StrutState], quantity: str) -> tuple[float, float]:
    """One scale for all load cases, so that they compare: from 0, but for radii."""
    values = np.concatenate([state.values(quantity).ravel() for state in states])
    return float(values.min()) if quantity == "radii" else 0.0, float(values.max())


def drawn_factor(states: Sequence[StrutState]) -> float:
    """How many times displacements are enlarged to be seen: 1, 2 or 5 times a power of ten."""
    most = max(float(state.displacement.max(initial=0.0)) for state in states)
    size = float(np.linalg.norm(np.ptp(states[0].ends.reshape(-1, 3), axis=0)))
    factor = DRAWN * size / max(most, 1e-12 * size)
    power = 10.0 ** np.floor(np.log10(factor))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= factor * 1.0001) * power)
