# SPDX-License-Identifier: LGPL-2.1-or-later
"""What sizing came to: before and after, at the same mass and at the same limits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..loads.load_cases import LoadCases
from ..sizing.analysis import Analysis
from ..sizing.model import SizingModel
from ..sizing.optimise import Sized

#: Cantilevers of the six cells as second-order tetrahedra, sized and of one radius, gained at least
#: 0.79 of what is told: joints of thick struts between thin ones are less stiff than those of a
#: cell of one radius, to which beams' ends are fitted. So no less than this is left.
GAIN_IN_SOLIDS = 0.75


def sizing_report(
    loads: LoadCases,
    model: SizingModel,
    sized: Sized,
    before: Analysis,
    even: tuple[Analysis, bool] | None,
    proof: Mapping[str, Any] | None,
    *,
    seconds: Mapping[str, float],
    notes: tuple[str, ...] = (),
    unthinned: tuple[Analysis, int] | None = None,
) -> dict[str, Any]:
    """The figures as plain JSON values.

    Args:
        loads: material and cases.
        model: what was solved.
        sized: the design.
        before: one radius, the same volume.
        even: one radius, the same limits, and whether it holds them; None without limits.
        proof: how far another solver agrees; None where none was asked.
        seconds: by stage; their sum is told, too.
        notes: sentences for the user.
        unthinned: the design with the struts that were taken away, and how many these are; None
            where none was.
    """
    problem, final, density = model.problem, sized.analysis, loads.material.density
    # What supports alone strain is not more or less stiff.
    works = np.abs(final.compliance) > 0.0
    solutions = {"before": before} if even is None else {"before": before, "same_limits": even[0]}
    gains = (before.compliance[works] / final.compliance[works]).tolist()
    result: dict[str, Any] = {
        "material": loads.material.as_dict(),
        "struts": len(problem.structure.beams.struts),
        "nodes": len(final.radii),
        "radii_mm": [float(final.radii.min()), float(final.radii.max())],
        "bounds_mm": [float(problem.low.min()), float(problem.high.max())],
        "strut_volume_mm3": final.volume,
        "strut_mass_g": final.volume * density / 1000.0,
        "skin_mass_g": model.skin_volume * density / 1000.0,
        "masses_g": {
            "struts": final.volume * density / 1000.0,
            "skin": model.skin_volume * density / 1000.0,
            "solid": 0.0,
        },
        "holds": sized.holds,
        "uses": final.uses,
        "cases": [_case(model, solutions, final, k) for k in range(len(problem.cases))],
        "same_mass": {
            "radius_mm": float(before.radii.mean()),
            "stiffer": gains,
            "stiffer_at_least": [least_gain(gain) for gain in gains],
            "less_stress": float(before.stress.max() / final.stress.max()),
            "uses": before.uses,
        },
        "stopped": sized.stopped,
        "steps": [
            {"strut_volume_mm3": step.volume, "compliance": step.compliance, "uses": step.uses}
            for step in (*sized.steps, sized.last)
        ],
        "calculix": None if proof is None else dict(proof),
        "seconds": {**seconds, "total": sum(seconds.values())},
        "notes": list(notes),
    }
    if not np.isnan(final.frequency):
        result["lowest_frequency_hz"] = final.frequency
    if unthinned is not None:
        whole, gone = unthinned
        result["removed"] = {
            "struts": gone,
            "with_them": {
                "strut_volume_mm3": whole.volume,
                "strut_mass_g": whole.volume * density / 1000.0,
                "compliance_nmm": whole.compliance.tolist(),
                "displacement_mm": whole.largest.tolist(),
                "uses": whole.uses,
            },
        }
    if even is not None:
        uniform, holds = even
        result["same_limits"] = {
            "radius_mm": float(uniform.radii.mean()),
            "holds": holds,
            "strut_volume_mm3": uniform.volume,
            "mass_saved": 1.0 - final.volume / uniform.volume,
            "uses": uniform.uses,
        }
    if model.skin is not None:
        moved = final.displacements[model.frame_nodes :]
        result["skin_stress_mpa"] = model.skin.peaks(moved)
    return result


def least_gain(gain: float) -> float:
    """What solids may leave of how many times as stiff a design is as one radius."""
    return min(gain, max(1.0, GAIN_IN_SOLIDS * gain))


def _case(
    model: SizingModel, solutions: Mapping[str, Analysis], final: Analysis, k: int
) -> dict[str, Any]:
    """One load case: what is largest in it, and where; beside other designs by their names."""
    beams = model.problem.structure.beams
    strut = int(np.argmax(final.stress[:, :, k].max(axis=1)))
    place = model.problem.structure.nodes[beams.struts[strut]].mean(axis=0)
    return {
        "name": model.problem.cases[k].name,
        **_largest(final, k),
        "worst_strut": {"number": strut, "middle_mm": place.tolist()},
        **{name: _largest(solution, k) for name, solution in solutions.items()},
    }


def _largest(design: Analysis, k: int) -> dict[str, Any]:
    return {
        "compliance_nmm": float(design.compliance[k]),
        "displacement_mm": float(design.largest[k]),
        "stress_mpa": float(design.stress[:, :, k].max()),
        "buckling": float(design.buckling[:, k].max()),
        "frame_buckling_factor": _known(design.factors[k]),
    }


def _known(factor: float) -> float | None:
    """A load factor; None where it was not asked for, or nothing buckles."""
    return float(factor) if np.isfinite(factor) else None
