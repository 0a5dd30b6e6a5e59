# SPDX-License-Identifier: LGPL-2.1-or-later
"""The finished file of a design solved as a solid: a third word beside the design and CalculiX.

It shares where loads and supports act with the design's own model, and nothing else: the mesh is
the one that is written, and voxels know neither beams nor shells.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...loads.load_cases import LoadCases
from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import Cancelled, VolfrepError
from ...util.progress import ProgressCallback
from ..solving import Expected, solve_solid
from .goal import Goal
from .sizing import SizedPart

#: Design and file agree where displacements differ by no more than this part of the file's.
AGREES = 0.15


def check_file_proof(goal: Goal) -> None:
    """Refuse to solve a file for a design of other struts, before any work.

    Raises:
        VolfrepError: the design is of struts as they come out.
    """
    if goal.printing is not None:
        raise VolfrepError(
            "The finished file has struts as they are drawn, and this design is of struts as they "
            "come out: leave out the proof by the file."
        )


def prove_file(
    made: SizedPart,
    mesh: TriangleMesh,
    loads: LoadCases,
    *,
    voxel: float | None = None,
    progress: ProgressCallback | None = None,
    tell: Callable[[Expected], None] = lambda expected: None,
) -> dict[str, Any] | None:
    """Solve the finished mesh of a design, and put its figures into the design's report.

    Args:
        made: the design; its report gets the entry ``file`` and, where the two disagree, a note.
        mesh: of the part that is written, closed, mm.
        loads: the material, and what the part carries.
        voxel: edge of a voxel, mm; None for what suits the part.
        progress: called with the fraction done and the stage; returning False cancels.
        tell: is told before the work what it will take.

    Returns:
        That entry: of every case displacement (largest), work and nominal stress in the file's
        voxels beside the design's, and displacement in CalculiX. None where it cannot be solved,
        of which the report has a note.

    Raises:
        Cancelled: the callback said so.
    """
    report = made.report
    try:
        solved = solve_solid(mesh, loads, voxel=voxel, progress=progress, tell=tell).report
    except Cancelled:
        raise
    except VolfrepError as error:  # minutes of work are not lost to a proof
        report["notes"].append(f"{error} The finished file was not solved.")
        return None
    proof = report["calculix"] or {}
    times = proof.get("largest_displacement", [None] * len(report["cases"]))
    skin = report.get("skin_stress_mpa", [None] * len(report["cases"]))
    cases = []
    for k, (own, case) in enumerate(zip(report["cases"], solved["cases"], strict=True)):
        there = {"displacement_mm": None if times[k] is None else times[k] * own["displacement_mm"]}
        limit = case["extrapolated"]
        cases.append(
            {
                "name": own["name"],
                "design": {
                    "displacement_mm": own["displacement_mm"],
                    "compliance_nmm": own["compliance_nmm"],
                    "skin_stress_mpa": skin[k],
                },
                "calculix": there,
                "file": case,
                "displacement_of_file": own["displacement_mm"] / limit["displacement_mm"],
                "compliance_of_file": own["compliance_nmm"] / limit["compliance_nmm"],
            }
        )
    found: dict[str, Any] = {**solved, "cases": cases}
    report["file"] = found
    far = [case for case in cases if abs(case["displacement_of_file"] - 1.0) > AGREES]
    for case in far:
        report["notes"].append(
            f"Case '{case['name']}': the finished file, solved as a solid, moves "
            f"{case['file']['extrapolated']['displacement_mm']:.4g} mm and the design's own model "
            f"{case['design']['displacement_mm']:.4g} mm, which is "
            f"{case['displacement_of_file'] - 1.0:+.0%}: believe the file where walls meet and "
            "struts are short, and take smaller voxels where its figures have not settled."
        )
    report["notes"] += [f"The finished file as a solid: {note}" for note in solved["notes"]]
    return found
