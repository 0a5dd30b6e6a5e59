# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part solved as a solid of its lattice's effective stiffness, whatever the cells' number.

The lattice's stiffness follows the radius or wall thickness, the map of the cells and their
turning; the skin lies where it is.
"""

from __future__ import annotations

import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..continuum.deck import write_deck
from ..continuum.eigen import buckling_factors
from ..continuum.eigen import frequencies as natural_frequencies
from ..continuum.model import (
    ContinuumModel,
    ContinuumState,
    conduct,
    figures_of,
    solve_continuum,
)
from ..design.spec import LatticeSpec
from ..io.write.vtu import write_vtu
from ..loads.load_cases import Heat, LoadCases, with_weights
from ..mechanics.endless import stretched_strains
from ..mesh.triangle_mesh import TriangleMesh
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.files import write_json
from ..util.numbers import whole
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..util.types import Floats
from .infill import Infill
from .part_bricks import continuum_model
from .solving import displacement_rows

#: Frequencies or load factors at most.
MOST_MODES = 50
#: Fewer cells across are warned of; and how far displacements were from those of beams with so
#: many and free faces, where struts are stretched and where they are bent (docs/method.md).
FEW_CELLS = 6
STRETCHED, BENT = "4 %", "16 %"


@dataclass(frozen=True, eq=False, repr=False)
class HomogenisedPart(Shown):
    """A filled part that was solved as a homogenised solid.

    Attributes:
        model: its bricks.
        spec: what it is filled with.
        states: of the load cases.
        report: the figures, plain JSON values.
        temperatures: (n,) of the nodes, where there is heat.
        modes: titles and (n, 3) displacements, of natural frequencies and of buckling.
    """

    model: ContinuumModel
    spec: LatticeSpec
    states: tuple[ContinuumState, ...]
    report: dict[str, Any]
    modes: tuple[tuple[str, Floats], ...] = ()
    temperatures: Floats | None = None

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        return homogenised_rows(self.report)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write displacements and stress as .vtu, the figures as .json, or a CalculiX deck, .inp.

        Raises:
            VolfrepError: it is another extension, or cannot be written.
        """
        check_homogenised_file(path)
        kind, model = Path(path).suffix.lower(), self.model
        if kind == ".json":
            self.write_report(path)
        elif kind == ".inp":
            write_deck(path, model, [state.case for state in self.states])
        else:
            points: dict[str, Any] = {}
            cells: dict[str, Any] = {
                "lattice": model.shares.lattice.mean(axis=1),
                "skin": model.shares.solid.mean(axis=1),
                "radius or thickness mm": np.broadcast_to(
                    model.thickness, len(model.elements.nodes)
                ),
            }
            for state in self.states:
                points[f"displacement mm, {state.case.name}"] = state.displacements
                cells[f"share of yield in the lattice, {state.case.name}"] = state.use
                cells[f"stress in the skin MPa, {state.case.name}"] = state.skin
            points.update(self.modes)
            if self.temperatures is not None:
                points["temperature"] = self.temperatures
            write_vtu(path, model.nodes, model.elements.nodes, points, cells)

    def write_report(self, path: str | os.PathLike[str]) -> None:
        """Write the figures as JSON."""
        write_json(path, self.report)

    def conduct(
        self,
        temperatures: Sequence[tuple[Any, float]],
        conductivity: float,
        powers: Sequence[tuple[Any, float]] = (),
        films: Sequence[tuple[Any, float, float]] = (),
    ) -> tuple[Floats, Floats]:
        """Steady heat between regions; see `continuum.model.conduct`."""
        return conduct(self.model, temperatures, conductivity, powers, films)


def check_homogenised_file(path: str | os.PathLike[str]) -> None:
    """Refuse a file of an extension that results are not written in.

    Raises:
        VolfrepError: naming those that they are.
    """
    if Path(path).suffix.lower() not in (".vtu", ".json", ".inp"):
        raise VolfrepError(
            "A homogenised part is written as .vtu (in colours, for ParaView), .json (the figures) "
            f"or .inp (a CalculiX deck), not as '{Path(path).name}'."
        )


def homogenise_part(
    solid: TriangleMesh,
    spec: LatticeSpec,
    loads: LoadCases,
    *,
    element: float | None = None,
    frequencies: int = 0,
    load_factors: int = 0,
    progress: ProgressCallback | None = None,
    monitor: Monitor | None = None,
    cache: StageCache | None = None,
) -> HomogenisedPart:
    """Solve a filled part as a homogenised solid under load cases.

    Args:
        solid: checked closed mesh, mm.
        spec: what it is filled with, graded or not.
        loads: the material, and what the part carries.
        element: edge of the bricks, mm; None for what suits the part.
        frequencies: how many of the lowest natural ones, with the first case's supports.
        load_factors: how many of the lowest at which the part buckles as a whole, in each case.
        progress: called with the fraction done and the stage; returning False cancels.
        monitor: in place of one of its own.
        cache: keeps the costly stages of the part.

    Raises:
        VolfrepError: the lattice has no cells that repeat, nothing lies where a load acts, or the
            part is not held.
        Cancelled: the callback said so.
    """
    from .targets import solve_target

    start = time.perf_counter()
    cache = cache or StageCache()
    monitor = monitor or Monitor(progress)
    refuse_endless(spec)
    if spec.target is not None:
        spec = solve_target(solid, spec, cache=cache, meshed=False).spec
    infill = Infill(solid, spec, monitor=monitor, cache=cache)
    mapping = infill.placement.mapping
    if mapping is not None and not mapping.is_rigid and spec.kind.cube is None:
        raise VolfrepError(
            "Walls in cells that grow or lie about an axis cannot be homogenised: choose equal "
            "cells, or a cell of struts."
        )
    with monitor.stage("elements", 0.3, 0.6):
        model = continuum_model(infill, loads, element)
    for name, count in (("frequencies", frequencies), ("load_factors", load_factors)):
        whole(name.replace("_", " "), count, 0, MOST_MODES)
        if count and not loads.cases:
            raise VolfrepError(
                f"There are {name.replace('_', ' ')} of load cases only, and there is heat alone."
            )
    with monitor.stage("solving", 0.6, 0.8):
        warm, heat = _heat(model, loads)
        states: list[ContinuumState] = []
        if loads.cases:
            states = solve_continuum(model, with_weights(loads).cases, monitor, warm=warm)
    modes: list[tuple[str, Floats]] = []
    hertz: list[float] = []
    factors: list[list[float | None]] = [[] for _ in states]
    with monitor.stage("modes", 0.8, 1.0):
        if frequencies:
            values, shapes = natural_frequencies(
                model, states[0], frequencies, loads.masses, monitor
            )
            hertz = values.tolist()
            modes += [(f"mode of {value:.4g} Hz", shapes[:, :, k]) for k, value in enumerate(hertz)]
        for state, own in zip(states, factors, strict=True):
            if load_factors:
                values, shapes = buckling_factors(model, state, load_factors, monitor)
                for k, value in enumerate(values.tolist()):
                    finite = np.isfinite(value)
                    own.append(value if finite else None)
                    if finite:
                        title = f"buckles at {value:.4g} times {state.case.name}"
                        modes.append((title, shapes[:, :, k]))
    report = {
        "material": loads.material.as_dict(),
        "elements": len(model.elements.nodes),
        "element_mm": model.bricks.edge.tolist(),
        "cells_across": model.across,
        "mass_g": float(model.loaded.shares.sum() * np.prod(model.bricks.edge))
        * loads.material.density
        / 1000.0,
        "lattice_mm3": float(model.shares.lattice.mean(axis=1).sum() * np.prod(model.bricks.edge)),
        "cases": [
            {**figures_of(model, state), "load_factors": own}
            for state, own in zip(states, factors, strict=True)
        ],
        "frequencies_hz": hertz,
        "heat": heat,
        "temperatures": None if warm is None else [float(warm.min()), float(warm.max())],
        "resistance_k_w": _resistance(loads.heat, heat),
        "seconds": time.perf_counter() - start,
        "notes": _notes(infill, model),
    }
    return HomogenisedPart(model, spec, tuple(states), report, tuple(modes), warm)


def refuse_endless(spec: LatticeSpec) -> None:
    """Refuse a lattice that has no stiffness of its own.

    Raises:
        VolfrepError: so it has none.
    """
    if spec.kind.endless is None or spec.output == "domain":
        raise VolfrepError(
            "Only a lattice of cells that repeat can be homogenised: choose a cell, and the output "
            "part or lattice."
        )


def _heat(model: ContinuumModel, loads: LoadCases) -> tuple[Floats | None, list[dict[str, Any]]]:
    """(n,) temperatures, and what each region has and gives; None and nothing without heat."""
    if not loads.heat or loads.conductivity is None:
        return None, []
    heat = loads.heat
    fixed = [one for one in heat if one.temperature is not None and one.film is None]
    films = [one for one in heat if one.film is not None]
    warm, given = conduct(
        model,
        [(one.region, one.temperature) for one in fixed if one.temperature is not None],
        loads.conductivity,
        [(one.region, one.power) for one in heat if one.power is not None],
        [
            (one.region, one.temperature, one.film)
            for one in films
            if one.temperature is not None and one.film is not None
        ],
    )
    gives = dict(zip(map(id, [*fixed, *films]), given.tolist(), strict=True))
    found = []
    for one in heat:
        power = one.power if one.power is not None else gives[id(one)]
        mean = float(np.einsum("n,n->", model.loaded.weights_of(one.region), warm))
        found.append({"name": one.name, "temperature": mean, "power_w": power})
    return warm, found


def _resistance(given: Sequence[Heat], found: Sequence[Mapping[str, Any]]) -> float | None:
    """K/W of what lies between two temperatures, or between a power and a temperature.

    Films are part of it. None where heat flows between more.
    """
    powers = [one for one, own in zip(found, given, strict=True) if own.power is not None]
    held = sorted({one.temperature for one in given if one.temperature is not None})
    if len(powers) == 1 and len(held) == 1 and powers[0]["power_w"]:
        return float((powers[0]["temperature"] - held[0]) / powers[0]["power_w"])
    if not powers and len(held) == 2:
        warm = sum(
            one["power_w"]
            for one, own in zip(found, given, strict=True)
            if own.temperature == held[1]
        )
        return float((held[1] - held[0]) / warm) if warm else None
    return None


def _notes(infill: Infill, model: ContinuumModel) -> list[str]:
    """What the user should know of the figures."""
    cell = infill.spec.kind.cube
    bent = cell is not None and stretched_strains(cell) < 6
    error = BENT if bent else STRETCHED
    found = []
    if model.across < FEW_CELLS:
        found.append(
            f"Only {model.across:.2g} cells lie across the part where it is thickest: as a "
            f"homogenised solid it may move by more than {error} less or more than its lattice "
            f"does; choose smaller cells, or solve it with beams."
        )
    elif bent:
        found.append(
            "The struts of this cell are bent, not stretched: without a skin about it the lattice "
            f"may be up to {BENT} softer or stiffer than said here."
        )
    return found


def homogenised_rows(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The figures as lines for a user."""
    edge = sum(report["element_mm"]) / 3.0
    rows = [
        ("elements", f"{report['elements']:,} of {edge:.3g} mm"),
        ("cells across", f"{report['cells_across']:.3g} where it is thickest"),
        ("mass", f"{report['mass_g']:.4g} g"),
    ]
    if "field" in report:
        field = report["field"]
        first, uses = field["steps"][0], field["uses"]
        told = f"{field['thinnest_mm']:.3g} to {field['thickest_mm']:.3g} mm"
        if uses:
            used = ", ".join(f"{value:.0%} of {name}" for name, value in uses.items())
            told += f"; {used}, at {report['mass_g'] / first['mass_g']:.3g} times the mass"
        else:
            told += f"; forces do {field['work_over_first']:.3g} of their work on even ones"
        rows.append(("radii or thicknesses", told))
    for case in report["cases"]:
        rows.append(
            (
                f"case {case['name']}",
                f"moves {case['displacement_mm']:.4g} mm; work {case['work_nmm'] / 2:.4g} N mm",
            )
        )
        rows += displacement_rows(case)
        if case["lattice_use"] is not None:
            at = ", ".join(f"{value:.4g}" for value in case["lattice_use_at"])
            rows.append(("", f"lattice up to {case['lattice_use']:.0%} of its yield, at ({at}) mm"))
        if case["skin_mpa"] is not None:
            at = ", ".join(f"{value:.4g}" for value in case["skin_mpa_at"])
            rows.append(("", f"skin up to {case['skin_mpa']:.4g} MPa, nominal, at ({at}) mm"))
        if case["strut_buckling"] is not None:
            at = ", ".join(f"{value:.4g}" for value in case["strut_buckling_at"])
            rows.append(
                ("", f"struts up to {case['strut_buckling']:.0%} of what buckles them between "
                 f"pinned ends, at ({at}) mm")
            )  # fmt: skip
        if case["load_factors"]:
            text = ", ".join(
                "none" if value is None else f"{value:.4g}" for value in case["load_factors"]
            )
            rows.append(("", f"buckles as a whole at so many times the loads: {text}"))
    if report["frequencies_hz"]:
        text = ", ".join(f"{value:.4g}" for value in report["frequencies_hz"])
        rows.append(("natural frequencies", f"{text} Hz"))
    rows += [
        (f"heat {one['name']}", f"{one['temperature']:.5g} degrees, gives {one['power_w']:.4g} W")
        for one in report["heat"]
    ]
    if report["temperatures"] is not None:
        low, high = report["temperatures"]
        rows.append(("temperatures", f"{low:.5g} to {high:.5g} degrees"))
    if report["resistance_k_w"] is not None:
        rows.append(("thermal resistance", f"{report['resistance_k_w']:.4g} K/W"))
    rows.append(("time", f"{report['seconds']:.3g} s"))
    return rows
