# SPDX-License-Identifier: LGPL-2.1-or-later
"""Any closed solid under load cases, solved by voxels at two sizes.

What differs between the two sizes tells how far the finer one may be from the limit, which is
extrapolated.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..design.memory_guard import free_memory, rounded_up
from ..io.write.vtu import write_vtu
from ..loads.load_cases import LoadCases, refuse_heat, with_weights
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.files import write_json
from ..util.numbers import duration, number
from ..util.peaks import PEAKS
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..voxels.shares import grid_of
from ..voxels.solution import (
    VoxelModel,
    VoxelState,
    figures_of,
    solve_cases,
    voxel_model,
)

#: The coarser voxels are so many times as large, and errors go with so much of their edge's power:
#: between 1 at sharp inner edges and 2 elsewhere (docs/method.md).
COARSER, ORDER = 1.5, 2.0
#: So many voxels, if the user does not say how large they are; more where walls are thin, which so
#: many should lie across, up to a number.
USUAL, ACROSS, MOST = 250_000, 2.0, 1_500_000
#: Fewer than so many across a mean wall, or the mean radius of struts, are told.
FEW = 1.5
#: Said beside every stress.
NOMINAL = (
    "nominal: voxels have steps where the surface is smooth, so that single peaks, fillets and "
    "roots of notches are not what they say; trust it least at the surface, most where the part is "
    "thick"
)
#: Seconds of processor time and bytes for each voxel, also for each load case, and for each
#: triangle; bytes for each voxel of the box that the part lies in. Of a bracket, solid and filled,
#: with 26,000 to 293,000 voxels and one or four cases.
SECONDS_PER_VOXEL, SECONDS_PER_CASE, SECONDS_PER_TRIANGLE = 1.2e-4, 9e-5, 8e-6
BYTES, BYTES_PER_VOXEL, BYTES_IN_BOX, BYTES_PER_TRIANGLE = 1.5e8, 5500.0, 150.0, 400.0
#: Cut voxels for each square of a voxel's edge of the surface.
CUT = 0.75
#: What is compared between the two sizes.
LIMITS = ("displacement_mm", "compliance_nmm")


@dataclass(frozen=True)
class Expected:
    """What a job will take.

    Attributes:
        voxel: edge, mm.
        voxels: that are filled.
        seconds: on two cores.
        bytes: at the peak.
    """

    voxel: float
    voxels: float
    seconds: float
    bytes: float

    def __str__(self) -> str:
        return (
            f"about {float(f'{self.voxels:.2g}'):,.0f} voxels of {self.voxel:.3g} mm, "
            f"{duration(self.seconds)}, {self.bytes / 1e9:.2g} GB"
        )


@dataclass(frozen=True, eq=False, repr=False)
class Solved(Shown):
    """A solid that was solved.

    Attributes:
        model: its voxels, the finer ones.
        states: of the load cases, on these.
        report: the figures, plain JSON values.
    """

    model: VoxelModel
    states: tuple[VoxelState, ...]
    report: dict[str, Any]

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        return solving_rows(self.report)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write displacements and stress as a .vtu file for ParaView, or the figures as .json.

        Raises:
            VolfrepError: it is another extension, or cannot be written.
        """
        check_result_file(path)
        if Path(path).suffix.lower() == ".json":
            self.write_report(path)
            return
        points: dict[str, Any] = {}
        cells: dict[str, Any] = {"filled": self.model.shares}
        for state in self.states:
            points[f"displacement mm, {state.case.name}"] = state.displacements
            cells[f"nominal stress MPa, {state.case.name}"] = state.stress
        write_vtu(path, self.model.nodes, self.model.elements.nodes, points, cells)

    def write_report(self, path: str | os.PathLike[str]) -> None:
        """Write the figures as JSON."""
        write_json(path, self.report)


def check_result_file(path: str | os.PathLike[str]) -> None:
    """Refuse a file of an extension that results are not written in.

    Raises:
        VolfrepError: naming those that they are.
    """
    if Path(path).suffix.lower() not in (".vtu", ".json"):
        raise VolfrepError(
            f"Results are written as .vtu (displacements and stress in colours, for ParaView) or "
            f".json (the figures), not as '{Path(path).name}'."
        )


def expect(mesh: TriangleMesh, voxel: float | None, cases: int) -> Expected:
    """What solving a solid will take.

    Args:
        mesh: closed, mm.
        voxel: edge of the finer voxels, mm; None for what suits the part.
        cases: of loads.

    Raises:
        VolfrepError: the voxel is no length, or it needs more memory than is free.
    """
    if voxel is None:
        usual = _edge_for(mesh, USUAL)
        voxel = max(min(usual, thickness(mesh) / ACROSS), _edge_for(mesh, MOST))
    else:
        voxel = number("voxel", voxel, "mm", positive=True)
    count = _count(mesh, voxel)
    box = float(grid_of(mesh.bounds, voxel)[0].astype(float).prod())
    both = count * (1.0 + COARSER**-3)
    seconds = both * (SECONDS_PER_VOXEL + SECONDS_PER_CASE * cases)
    triangles = len(mesh.triangles)
    needed = BYTES + BYTES_PER_VOXEL * count + BYTES_IN_BOX * box + BYTES_PER_TRIANGLE * triangles
    found = Expected(voxel, count, 1.0 + seconds + SECONDS_PER_TRIANGLE * triangles, needed)
    free = free_memory()
    if found.bytes > free:
        fitting = rounded_up(voxel * (1.2 * found.bytes / free) ** (1 / 2.5))
        raise VolfrepError(
            f"Voxels of {voxel:.3g} mm would take {found.bytes / 1e9:.3g} GB of the "
            f"{free / 1e9:.3g} GB of free memory: {fitting:g} mm would fit."
        )
    return found


def thickness(mesh: TriangleMesh) -> float:
    """Twice the volume over the surface, mm: of a wall its thickness, of a strut its radius."""
    return 2.0 * abs(mesh.volume) / mesh.area


def _count(mesh: TriangleMesh, voxel: float) -> float:
    """Voxels that are filled, those that are cut included."""
    return abs(mesh.volume) / voxel**3 + CUT * mesh.area / voxel**2


def _edge_for(mesh: TriangleMesh, count: float) -> float:
    """The voxel of which there are so many."""
    edge: float = (abs(mesh.volume) / count) ** (1 / 3)
    for _ in range(40):
        edge *= (_count(mesh, edge) / count) ** 0.4
    return edge


def solve_solid(
    solid: TriangleMesh,
    loads: LoadCases,
    *,
    voxel: float | None = None,
    progress: ProgressCallback | None = None,
    tell: Callable[[Expected], None] = lambda expected: None,
) -> Solved:
    """Solve a closed solid under load cases.

    Args:
        solid: closed mesh, mm; filled or not.
        loads: the material, and what the solid carries.
        voxel: edge of the finer voxels, mm; None for about a quarter of a million, or for
            so many across its walls as are wanted, where that is more.
        progress: called with the fraction done and the stage; returning False cancels.
        tell: is told before the work what it will take.

    Raises:
        VolfrepError: nothing lies where a load acts, the part is not held, or it would not fit
            into memory.
        Cancelled: the callback said so.
    """
    refuse_heat(loads)
    monitor = Monitor(progress)
    expected = expect(solid, voxel, len(loads.cases))
    tell(expected)
    start = time.perf_counter()
    figures: list[list[dict[str, Any]]] = []
    models: list[VoxelModel] = []
    states: list[VoxelState] = []
    for edge, low, high in ((COARSER * expected.voxel, 0.0, 0.25), (expected.voxel, 0.25, 1.0)):
        with monitor.stage("voxels", low, low + 0.1 * (high - low)):
            model = voxel_model(solid, edge, loads.material, monitor)
        with monitor.stage("solving", low + 0.1 * (high - low), high):
            states = solve_cases(model, with_weights(loads).cases, monitor)
        models.append(model)
        figures.append([figures_of(model, state) for state in states])
    fine = models[-1]
    cases = [_both(*pair) for pair in zip(*figures, strict=True)]
    report = {
        "material": loads.material.as_dict(),
        "solid_volume_mm3": abs(solid.volume),
        "voxels": [_size(model) for model in models],
        "cases": cases,
        "seconds": time.perf_counter() - start,
        "stress_is": NOMINAL,
        "notes": _notes(solid, fine, cases, loads),
    }
    return Solved(fine, tuple(states), report)


def _size(model: VoxelModel) -> dict[str, Any]:
    return {
        "edge_mm": model.grid.edge.tolist(),
        "count": len(model.shares),
        "volume_mm3": model.volume,
        "dropped_mm3": model.dropped,
    }


def _both(coarse: Mapping[str, Any], fine: Mapping[str, Any]) -> dict[str, Any]:
    """A case's figures of the finer voxels, with the coarser ones' and the limit of both."""
    share = 1.0 / (COARSER**ORDER - 1.0)
    limit = {name: fine[name] + share * (fine[name] - coarse[name]) for name in LIMITS}
    change = max(abs(fine[name] - coarse[name]) / max(abs(fine[name]), 1e-300) for name in LIMITS)
    names = ("displacement_mm", "compliance_nmm", "stress_mpa", "largest_stress_mpa")
    return {
        **fine, "coarser": {name: coarse[name] for name in names}, "extrapolated": limit,
        "changed": change,
    }  # fmt: skip


#: A change from the coarser voxels above this is told as one to be made smaller.
SETTLED = 0.08
#: The least part of the volume that may hang on nothing without a word.
LOOSE = 1e-4


def _notes(
    solid: TriangleMesh, model: VoxelModel, cases: Sequence[Mapping[str, Any]], loads: LoadCases
) -> list[str]:
    """What the user should know of the figures."""
    found = []
    across = thickness(solid) / float(model.grid.edge.mean())
    if across < FEW:
        found.append(
            f"Walls are {across:.2g} voxels thick in the mean, or struts {2 * across:.2g}: smaller "
            "voxels would say more."
        )
    if model.dropped > LOOSE * abs(solid.volume):
        found.append(
            f"Pieces of {model.dropped:,.4g} mm3 hang on nothing that voxels of this size see, and "
            "were left out."
        )
    changed = max(case["changed"] for case in cases)
    if changed > SETTLED:
        found.append(
            f"From voxels {COARSER:g} times as large figures have changed by {changed:.0%}: they "
            "have not settled; choose smaller voxels."
        )
    limit = loads.material.yield_stress
    stress = max(case["stress_mpa"]["all"] or 0.0 for case in cases)
    if limit is not None and stress > limit:
        found.append(
            f"The nominal stress of {stress:.4g} MPa is above the yield stress of {limit:.4g} MPa: "
            "the material would not stay elastic."
        )
    return found


def displacement_rows(case: Mapping[str, Any]) -> list[tuple[str, str]]:
    """How far the loads of a case move, as lines for a user."""
    return [
        ("", f"'{load['name']}' moves by ({', '.join(f'{x:.4g}' for x in load['moved_mm'])}) mm")
        for load in case["loads"]
    ]


def solving_rows(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The figures as lines for a user."""
    fine = report["voxels"][-1]
    edge = sum(fine["edge_mm"]) / 3.0
    rows = [
        ("voxels", f"{fine['count']:,} of {edge:.3g} mm, and {COARSER:g} times as large"),
        (
            "volume",
            f"{fine['volume_mm3']:,.5g} mm3 of the solid's {report['solid_volume_mm3']:,.5g}",
        ),
    ]
    for case in report["cases"]:
        limit, name = case["extrapolated"], f"case {case['name']}"
        rows += [
            (
                name,
                f"moves {case['displacement_mm']:.4g} mm, {limit['displacement_mm']:.4g} "
                f"extrapolated; work {case['compliance_nmm'] / 2:.4g} N mm, "
                f"{limit['compliance_nmm'] / 2:.4g} extrapolated",
            )
        ]
        rows += displacement_rows(case)
        stress = case["stress_mpa"]
        parts = [f"nominal stress {stress['all']:.4g} MPa on all but {PEAKS:.1%} of the volume"]
        parts += [
            f"{where} {stress[key]:.4g}"
            for key, where in (("outside", "next to the outside"), ("thick", "where it is thick"))
            if stress[key] is not None
        ]
        rows.append(("", ", ".join(parts)))
        rows.append(
            (
                "",
                f"forces balance to {case['imbalance']:.1g}; {case['steps']} steps; changed by "
                f"{case['changed']:.1%} from the coarser voxels",
            )
        )
    return [*rows, ("stress", NOMINAL), ("time", f"{report['seconds']:.1f} s")]
