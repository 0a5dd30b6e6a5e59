# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part solved as a solid of its lattice's effective stiffness, whatever the cells' number.

The lattice's stiffness follows the radius or wall thickness, the map of the cells and their
turning; the skin lies where it is.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..continuum.border import border_bars
from ..continuum.bricks import Bricks, Shares, add_bars, bar_conductances, constants
from ..continuum.cell_law import CellLaw, pressed_struts, split, stretched_tensors, turned
from ..continuum.deck import write_deck
from ..continuum.eigen import buckling_factors
from ..continuum.eigen import frequencies as natural_frequencies
from ..continuum.model import (
    ContinuumModel,
    ContinuumState,
    cells_across,
    conduct,
    figures_of,
    solve_continuum,
)
from ..design.spec import LatticeSpec
from ..grid.placement import node_radii
from ..io.write.vtu import write_vtu
from ..loads.load_cases import Heat, LoadCases, with_weights
from ..mechanics.catalogue import joint_law
from ..mechanics.elements import PARTS, solid_stiffness
from ..mechanics.endless import stretched_strains
from ..mechanics.frame import stiffened
from ..mechanics.joint_fit import periodic_frame
from ..mesh.triangle_mesh import TriangleMesh
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.files import write_json
from ..util.numbers import number, whole
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..util.types import Floats, Ints
from ..voxels.loaded import Loaded, surface_body
from ..voxels.multigrid import elements_at
from ..voxels.shares import VoxelGrid, fill_grid, grid_of
from .figures.properties import lattice_properties
from .infill import Infill
from .solving import displacement_rows

#: So many elements, if the user does not say how large they are; where cells are more, one a cell
#: up to the most.
USUAL, MOST = 12_000, 150_000
#: At so many thicknesses cells are looked up in the catalogue, or homogenised, where they vary.
LOOKED_UP, HOMOGENISED = 17, 4
#: Voxels along L of what is homogenised for this: moduli within 2 %.
ALONG = 40
#: Frequencies or load factors at most.
MOST_MODES = 50
#: Elements that are less full count as empty.
EMPTY = 0.01
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
    with monitor.stage("solving", 0.6, 0.8):
        warm, heat = _heat(model, loads)
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


def continuum_model(
    infill: Infill, loads: LoadCases, element: float | None = None
) -> ContinuumModel:
    """A part's bricks, filled by its skin and its lattice.

    Raises:
        VolfrepError: the bricks are no length, or nothing of the lattice lies in the part.
    """
    spec, placement = infill.spec, infill.placement
    graded = spec.radius_grading is not None
    bricks = PartBricks(infill, loads, cell_law(spec), element)
    return bricks.model(lambda at: node_radii(spec.struts, at, placement), graded=graded)


class PartBricks:
    """A part's bricks, whatever the thickness of what fills them.

    Args:
        infill: the part.
        loads: its material.
        law: of its cells.
        element: edge of the bricks, mm; None for what suits the part.

    Raises:
        VolfrepError: the bricks are no length, or nothing of the lattice lies in the part.
    """

    def __init__(
        self, infill: Infill, loads: LoadCases, law: CellLaw, element: float | None = None
    ) -> None:
        self.infill, self.law, self.material = infill, law, loads.material
        self.low, self.count, edge = _grid(infill, element)
        self.shares, self.place = _shares(infill, self.low, self.count, edge)
        self.size = (int(self.count[0]), int(self.count[1]), int(self.count[2]))
        self.elements = elements_at(self.place, self.size)
        self.bricks = Bricks(edge)
        self.middles = (self.place + 0.5) * edge + self.low
        self._body = surface_body(infill.solid, float(edge.max()))

    def model(
        self, thickness_at: Callable[[Floats], Floats], *, graded: bool = True
    ) -> ContinuumModel:
        """The bricks, filled.

        Args:
            thickness_at: gives (n,) radii of struts or thicknesses of walls at (n, 3) points, mm.
            graded: whether it varies; else the law's is everywhere.
        """
        infill, law, bricks, place = self.infill, self.law, self.bricks, self.place
        spec, edge, shares, material = infill.spec, self.bricks.edge, self.shares, self.material
        thickness = thickness_at(self.middles) if graded else law.thickness[:1]
        lattice, frames, thickness = _lattice(infill, law, self.middles, thickness)
        skin = constants(solid_stiffness(material.young, material.poisson))
        matrices = bricks.matrices(shares, material.young * constants(lattice), skin)
        filled = (shares.lattice * _of(law.at(law.density, thickness)) + shares.solid).mean(axis=1)
        border = None
        if _is_whole(infill) and spec.kind.cube is not None:
            more, border = _add_border(
                infill, bricks, matrices, place, (self.low, self.count), law, material.young,
                thickness_at,
            )  # fmt: skip
            filled += more / np.prod(edge) * _of_bare(infill, law)
        grid = VoxelGrid(self.low, edge, np.zeros(0), np.zeros(0, np.float32))
        weighing = Loaded(self._body, grid, self.elements, filled, material.density)
        all_lattice = np.zeros(self.size)
        all_lattice[tuple(place.T)] = shares.lattice.mean(axis=1)
        return ContinuumModel(
            self.size, self.low, self.elements, bricks, shares, matrices,
            material.young * lattice, frames, thickness, law.at(law.density, thickness),
            law.at(law.strength, thickness), law.at(law.conductivity, thickness),
            _pressed(infill, law, thickness), material, weighing,
            cells_across(all_lattice, edge, spec.cell_size), border,
        )  # fmt: skip


def _pressed(infill: Infill, law: CellLaw, thickness: Floats) -> Floats | None:
    mapping = infill.placement.mapping
    if law.pressed is None or (mapping is not None and not mapping.is_rigid):
        return None
    return law.at(law.pressed, thickness)


def _of(values: Floats) -> Floats:
    return values[:, None] if values.ndim == 1 else values


def _is_whole(infill: Infill) -> bool:
    """Whether the lattice is of whole cells, which nothing cuts."""
    return not infill.placement.is_cut


def _nodes_are_joints(infill: Infill) -> bool:
    """Whether bricks of a cell have the lattice's joints as nodes, and its struts are bent.

    Smaller ones would be sheared in layers narrower than a cell, across struts that are stiff along
    and soft across, as no strut is.
    """
    cell = infill.spec.kind.cube
    if cell is None or not _is_whole(infill) or stretched_strains(cell) == 6:
        return False
    return bool((np.minimum(np.abs(cell.nodes), np.abs(cell.nodes - 1.0)) < 1e-9).all())


def _grid(infill: Infill, element: float | None) -> tuple[Floats, Ints, Floats]:
    """(3,) the first corner, (3,) how many bricks, (3,) their edges, mm."""
    solid, length = infill.solid, infill.spec.cell_size
    bounds = solid.bounds
    if element is not None:
        edge = number("element", element, "mm", positive=True)
    else:
        usual = float((abs(solid.volume) / USUAL) ** (1 / 3))
        most = float((abs(solid.volume) / MOST) ** (1 / 3))
        # A part of one cell, or a whole number of them; where there are many, one.
        small = usual < length and not _nodes_are_joints(infill)
        edge = length / np.ceil(length / usual - 1e-9) if small else length
        if edge < most:
            edge = length * np.ceil(most / length)
    count, edges = grid_of(bounds, float(edge))
    if _is_whole(infill) and infill.cells is not None and infill.placement.mapping is None:
        # Along the cells, so that none is cut by a brick's face.
        cells = infill.cells.padded.cells
        steps = np.floor((bounds[0] - cells.origin) / edge + 1e-6)
        low = cells.origin + steps * edge
        count = np.maximum(np.ceil((bounds[1] - low) / edge - 1e-6), 1).astype(np.int64)
        return low, count, np.full(3, float(edge))
    return bounds[0], count, edges


def _shares(infill: Infill, low: Floats, count: Ints, edge: Floats) -> tuple[Shares, Ints]:
    """What fills the bricks' parts, and the places of those that are not empty."""
    spec, fine, step = infill.spec, count * PARTS, edge / PARTS
    solid: Any = np.zeros(fine)
    lattice: Any
    if _is_whole(infill):
        lattice = _cells_filled(infill, low, fine, step)
    else:
        inner = infill.domain.mesh if spec.skin is not None else infill.solid
        lattice = fill_grid(inner, low, fine, step, infill.monitor)
        if spec.with_skin:
            whole = fill_grid(infill.solid, low, fine, step, infill.monitor)
            solid = np.maximum(whole - lattice, 0.0)
    own, hard = (_by_brick(each, count) for each in (lattice, solid))
    there = (own + hard).mean(axis=3) > EMPTY
    if not (own[there] > 0.0).any():
        raise VolfrepError("No lattice lies in the part: choose smaller cells or a thinner skin.")
    return Shares(own[there], hard[there]), np.argwhere(there)


def _by_brick(shares: Floats, count: Ints) -> Floats:
    """(nx, ny, nz, PARTS^3) float32 of the parts of all bricks."""
    x, y, z = count.tolist()
    split_up = shares.reshape(x, PARTS, y, PARTS, z, PARTS).transpose(0, 2, 4, 1, 3, 5)
    result: Floats = split_up.reshape(x, y, z, -1).astype(np.float32)
    return np.where(result > 1.0 - 1e-6, np.float32(1.0), result)


def _cells_filled(infill: Infill, low: Floats, fine: Ints, step: Floats) -> Floats:
    """(fine) 1 where an active cell is."""
    assert infill.cells is not None
    cells, active = infill.cells.padded.cells, infill.cells.active
    mapping = infill.placement.mapping
    origin = cells.origin
    result = np.zeros(fine)
    y, z = (low[k] + (np.arange(fine[k]) + 0.5) * step[k] for k in (1, 2))
    for plane in range(int(fine[0])):
        points = np.stack(np.meshgrid([low[0] + (plane + 0.5) * step[0]], y, z, indexing="ij"), -1)
        points = points.reshape(-1, 3)
        if mapping is not None:
            points = mapping.to_lattice(points)
        at = np.floor((points - origin) / cells.cell_size).astype(np.int64)
        inside = ((at >= 0) & (at < active.shape)).all(axis=1)
        filled = np.zeros(len(at))
        filled[inside] = active[tuple(at[inside].T)]
        result[plane] = filled.reshape(int(fine[1]), int(fine[2]))
    return result


def cell_law(spec: LatticeSpec) -> CellLaw:
    """What a specification's lattice is as a material, at all thicknesses that it has."""
    kind, grading = spec.kind, spec.radius_grading
    values = [kind.thickness]
    if grading is not None and grading.extremes[0] < grading.extremes[1]:
        known = kind.catalogue_cell is not None and not spec.fillet
        spread = np.linspace if known else np.geomspace
        values = spread(*grading.extremes, LOOKED_UP if known else HOMOGENISED).tolist()
    along = {} if kind.has_struts else {"along": ALONG}
    found = []
    for value in values:
        wish: dict[str, Any] = {**(kind.endless or {}), kind.measure: value, **along}
        found.append(lattice_properties(**wish))
    return CellLaw(
        np.array(values),
        np.array([one.relative_density for one in found]),
        np.array([one.stiffness for one in found]),
        np.array([[one.values["strength"], one.values["shear_strength"]] for one in found]),
        np.array([one.values["conductivity"] for one in found]),
        None
        if kind.cube is None
        else np.stack([pressed_struts(kind.cube, spec.cell_size, value) for value in values]),
    )


def _lattice(
    infill: Infill, law: CellLaw, middles: Floats, thickness: Floats
) -> tuple[Floats, Floats, Floats]:
    """Stiffness in the part's axes, the cells' axes, and how thick, at the bricks' middles.

    One row each where all are alike.
    """
    spec, mapping = infill.spec, infill.placement.mapping
    if mapping is None:
        return law.tensors_at(thickness), np.eye(3)[None], thickness
    if mapping.is_rigid:
        frames, _ = split(mapping.jacobians(mapping.to_lattice(middles[:1])))
        return turned(law.tensors_at(thickness), frames), frames, thickness
    cell = spec.kind.cube
    assert cell is not None  # `homogenise_part` has refused others
    jacobians = mapping.jacobians(mapping.to_lattice(middles))
    frames, stretches = split(jacobians)
    radii = np.broadcast_to(thickness, len(middles))
    tensors = stretched_tensors(cell, spec.cell_size, radii, stretches, law)
    return turned(tensors, frames), frames, radii


def _add_border(
    infill: Infill, bricks: Bricks, matrices: Floats, place: Ints, grid: tuple[Floats, Ints],
    law: CellLaw, young: float, radii_at: Callable[[Floats], Floats],
) -> tuple[Floats, tuple[Ints, Floats] | None]:  # fmt: skip
    """Add the struts in free faces that the homogenised cells lack, in place.

    Returns:
        (e,) mm3 of them in each brick, joints counted as often as struts meet there, and what they
        conduct, as a `ContinuumModel` has it.
    """
    spec, mapping = infill.spec, infill.placement.mapping
    low, count = grid
    assert infill.cells is not None
    assert spec.kind.cube is not None
    cells, active = infill.cells.padded.cells, infill.cells.active
    origin = cells.origin
    bars = border_bars(spec.kind.cube, active)
    if not len(bars.shares):
        return np.zeros(len(place)), None
    # Two pieces or more in every brick, so that a bar has no gap.
    pieces = 2 * int(np.ceil(cells.cell_size / float(bricks.edge.min()) - 1e-6))
    share = (np.arange(pieces + 1) / pieces)[None, :, None]
    points = bars.start[:, None] + (bars.end - bars.start)[:, None] * share
    points = (points * cells.cell_size + origin).reshape(-1, 3)
    if mapping is not None:
        points = mapping.to_part(points)
    points = points.reshape(-1, pieces + 1, 3)
    span = np.diff(points, axis=1).reshape(-1, 3)
    middles = (0.5 * (points[:, 1:] + points[:, :-1])).reshape(-1, 3)
    length = np.linalg.norm(span, axis=1)
    radii = radii_at(middles)
    volume = np.repeat(bars.shares, pieces) * length * np.pi * radii**2
    sizes = volume * young
    bent = sizes * 3.0 * radii**2 / (pieces * length) ** 2
    whole = np.linalg.norm(bars.end - bars.start, axis=1)
    lengths, kind = np.unique(np.round(whole, 6), return_inverse=True)
    ends = joint_law(spec.kind.cube, cells.cell_size)
    ratios = law.thickness / cells.cell_size
    found = [
        stiffened(lengths, ratio, ends(radius))
        for ratio, radius in zip(ratios.tolist(), law.thickness.tolist(), strict=True)
    ]
    kind = np.repeat(kind.ravel(), pieces)
    for k in range(len(lengths)):
        rows = kind == k
        for values, factor in ((sizes, 0), (bent, 1)):
            samples = [each[factor][k] for each in found]
            values[rows] *= np.interp(radii[rows], law.thickness, samples)
    number_of = np.full(tuple(count), -1, np.int64)
    number_of[tuple(place.T)] = np.arange(len(place))
    # A bar in a free face lies between bricks that are there and others: it takes what is there.
    inside = (middles - low) / bricks.edge
    best, at = np.full(len(inside), -1, np.int64), np.zeros_like(inside)
    for nudge in np.array(np.meshgrid(*[(-1e-6, 1e-6)] * 3)).reshape(3, -1).T:
        where = np.floor(inside + nudge).astype(np.int64)
        valid = ((where >= 0) & (where < count)).all(axis=1) & (best < 0)
        rows = np.flatnonzero(valid)
        found = number_of[tuple(where[rows].T)]
        best[rows] = found
        at[rows] = inside[rows] - where[rows]
    kept = best >= 0
    way = span[kept] / length[kept, None]
    at = np.clip(at[kept], 0.0, 1.0)
    add_bars(matrices, bricks, best[kept], at, way, sizes[kept], bent[kept])
    conducted = bar_conductances(bricks, at, way, volume[kept])
    own_volume = np.asarray(np.bincount(best[kept], volume[kept], len(place)), float)
    return own_volume, (best[kept], conducted)


def _of_bare(infill: Infill, law: CellLaw) -> float:
    """The volume of a cell over that of its struts, each from node to node."""
    cell = infill.spec.kind.cube
    assert cell is not None
    frame = periodic_frame(cell)
    length = np.linalg.norm(frame.end - frame.start, axis=1).sum()
    bare = np.pi * length * (law.thickness / infill.spec.cell_size) ** 2
    return float(np.mean(law.density / bare))


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
    if report["resistance_k_w"] is not None:
        rows.append(("thermal resistance", f"{report['resistance_k_w']:.4g} K/W"))
    rows.append(("time", f"{report['seconds']:.3g} s"))
    return rows
