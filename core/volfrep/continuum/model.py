# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part of bricks that lattice and skin fill, solved for load cases; and its heat.

Stress is brought down to the lattice's solid by the cell's own fields: each macroscopic stress in
the cell's axes takes its share of what makes the solid yield, and the sum of these shares is what
is told, which is never less than what all of them together take.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import ndimage
from scipy.sparse import csr_matrix, diags

from ..loads.load_cases import LoadCase
from ..loads.nodal_loads import nodes_in
from ..loads.regions import Region
from ..mechanics.assembly import System, solve
from ..mechanics.elements import CORNERS, solid_stiffness, von_mises
from ..mechanics.materials import SolidMaterial
from ..util.errors import VolfrepError
from ..util.peaks import row_of_most
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from ..voxels.bricks import POINTS
from ..voxels.loaded import Loaded, VoxelCase, solve_nodal_cases
from ..voxels.multigrid import Elements, Fine, Multigrid
from .bricks import AT_ONCE, Bricks, Shares
from .cell_law import in_cell

#: Elements with less lattice, or less skin, are not told of.
LEAST_SHARE = 0.1


@dataclass(frozen=True, eq=False)
class ContinuumModel:
    """A filled part as a solid of bricks.

    Attributes:
        size: (nx, ny, nz) of the grid.
        low: (3,) its first corner, mm.
        elements: those that are there.
        bricks: their integrals.
        shares: what fills them.
        matrices: (e, 24, 24) float32 N/mm.
        lattice: (e, 6, 6) or (1, 6, 6) of the lattice, in the part's axes, MPa; where a wall cuts
            cells, of what is left of them, over their share.
        whole: (e, 6, 6) or (1, 6, 6) of the lattice of whole cells: struts that are left of a cut
            one are strained as theirs are.
        frames: (e, 3, 3) or (1, 3, 3) whose columns are the cells' axes.
        thickness: (e,) or (1,) mm, radii of struts, thicknesses or offsets of walls.
        density: (e,) or (1,) of the lattice, relative, of cut cells as `lattice` is.
        strength: (e, 2) or (1, 2) of the lattice along its edges and in shear, over the solid's.
        conductivity: (e,) or (1,) of the lattice over the solid's, of cut cells as `lattice` is.
        pressed: (e, m, 6) or (1, m, 6) of the cell law; None where it has none.
        material: the solid.
        loaded: takes loads to the nodes.
        across: how many cells lie across the part where it is thickest.
        border: (q,) rows of elements and (q, 8, 8) mm, over the solid's conductivity: the struts
            in free faces that the homogenised cells lack; None where there are none.
    """

    size: tuple[int, int, int]
    low: Floats
    elements: Elements
    bricks: Bricks
    shares: Shares
    matrices: Floats
    lattice: Floats
    whole: Floats
    frames: Floats
    thickness: Floats
    density: Floats
    strength: Floats
    conductivity: Floats
    pressed: Floats | None
    material: SolidMaterial
    loaded: Loaded
    across: float
    border: tuple[Ints, Floats] | None

    @property
    def nodes(self) -> Floats:
        """(n, 3) mm."""
        return self.loaded.nodes

    @property
    def middle(self) -> Floats:
        """(6, 24) strain in the middle of a brick from its nodes' displacements."""
        middle: Floats = self.bricks.strains(np.full((1, 3), 0.5))[0]
        return middle

    def cell_stress(self, own: Floats) -> Floats:
        """(e, 6) MPa of whole cells in their axes, from (e, 24) displacements."""
        stress = (self.whole @ (own @ self.middle.T)[:, :, None])[:, :, 0]
        return in_cell(stress, np.broadcast_to(self.frames, (len(own), 3, 3)))

    def at_nodes(self, each: Floats) -> Floats:
        """(n, 3) sums over the bricks about each node of their (e, 24) forces."""
        result = np.zeros((len(self.nodes), 3))
        np.add.at(result, self.elements.nodes.ravel(), each.reshape(-1, 3))
        return result


@dataclass(frozen=True, eq=False)
class ContinuumState:
    """A load case solved.

    Attributes:
        case: on the nodes.
        displacements: (n, 3) mm.
        strained: (e, 24) mm, those of each brick's nodes beside its growth by heat.
        work: N mm, twice the energy.
        use: (e,) share of the solid's yield stress in the lattice, at most; nan without one.
        skin: (e,) MPa, von Mises in skin and kept solids, nominal; 0 where there is none.
        struts: (e,) what presses the most pressed strut over what buckles it between pins; None
            where the cells have no struts, or a map stretches them.
        steps: of the conjugate gradients.
    """

    case: VoxelCase
    displacements: Floats
    strained: Floats
    work: float
    use: Floats
    skin: Floats
    struts: Floats | None
    steps: int


def solve_continuum(
    model: ContinuumModel,
    cases: Sequence[LoadCase],
    monitor: Monitor | None = None,
    warm: Floats | None = None,
) -> list[ContinuumState]:
    """Solve load cases: those with equal supports with one solver.

    Args:
        model: the part.
        cases: what it carries.
        monitor: asked for a cancel.
        warm: (n,) temperatures of the nodes, for cases that grow by them.

    Raises:
        VolfrepError: a case does not fit the part, or it is not held.
        Cancelled: when the monitor says so.
    """
    monitor = monitor or Monitor()

    def solver_of(free: Bools) -> Multigrid:
        return multigrid_of(model, free, monitor)

    def state_of(
        case: VoxelCase, displacements: Floats, forces: Floats, steps: int
    ) -> ContinuumState:
        work = float(np.vdot(displacements, forces))
        own = displacements[model.elements.nodes].reshape(-1, 24)
        if case.name in free_growth:
            own = own - free_growth[case.name]
        return ContinuumState(
            case, displacements, own, work, *stress_of(model, own), _pressed(model, own), steps
        )

    free_growth: dict[str, Floats] = {}
    laid = []
    for case in cases:
        on_nodes = model.loaded.case(case)
        if case.heated is not None and warm is not None:
            own = free_growth[case.name] = _growth(model, warm, *case.heated)
            forces = model.at_nodes(model.matrices @ own[:, :, None])
            on_nodes = replace(on_nodes, loads=on_nodes.loads + forces)
        laid.append(on_nodes)
    return solve_nodal_cases(laid, solver_of, state_of)


def _growth(model: ContinuumModel, warm: Floats, coefficient: float, reference: float) -> Floats:
    """(e, 24) displacements of each brick's nodes if it grew alone, by its mean temperature."""
    strain = coefficient * (warm[model.elements.nodes].mean(axis=1) - reference)
    result: Floats = strain[:, None] * (CORNERS * model.bricks.edge).ravel()
    return result


def multigrid_of(model: ContinuumModel, free: Bools, monitor: Monitor | None = None) -> Multigrid:
    """The part's equations where (n, 3) are free, and their solver."""

    def own_matrices(rows: Ints) -> Floats:
        return model.matrices[rows].astype(float)

    every = np.ones(len(model.matrices), bool)
    fine = Fine(model.elements, every, np.zeros((24, 24)), own_matrices, free)
    return Multigrid(fine, model.size, monitor)


def stress_of(model: ContinuumModel, own: Floats) -> tuple[Floats, Floats]:
    """(e,) share of yield in the lattice, at most, and (e,) MPa in the skin.

    Args:
        model: the part.
        own: (e, 24) displacements of each brick's nodes, mm, beside its growth by heat.
    """
    local = np.abs(model.cell_stress(own))
    limit = model.material.yield_stress or np.nan
    with np.errstate(divide="ignore", invalid="ignore"):
        use = local[:, :3].sum(axis=1) / model.strength[:, 0]
        use = (use + local[:, 3:].sum(axis=1) / model.strength[:, 1]) / limit
    use = np.where(model.shares.lattice.mean(axis=1) > LEAST_SHARE, use, 0.0)
    law = solid_stiffness(model.material.young, model.material.poisson)
    some = np.flatnonzero(model.shares.solid.max(axis=1) > LEAST_SHARE)
    skin = np.zeros(len(own))
    for table in model.bricks.strains((POINTS + 1.0) / 2.0):
        skin[some] = np.maximum(skin[some], von_mises(own[some] @ table.T @ law))
    return use, skin


def _pressed(model: ContinuumModel, own: Floats) -> Floats | None:
    """(e,) of the most pressed strut of the lattice; None where that is not known."""
    if model.pressed is None:
        return None
    strain = own @ model.middle.T
    half = np.array([1.0, 1.0, 1.0, 0.5, 0.5, 0.5])
    local = in_cell(strain * half, np.broadcast_to(model.frames, (len(own), 3, 3))) / half
    result = np.zeros(len(own))
    some = np.flatnonzero(model.shares.lattice.mean(axis=1) > LEAST_SHARE)
    for rows in np.array_split(some, len(some) // AT_ONCE + 1):
        table = model.pressed if len(model.pressed) == 1 else model.pressed[rows]
        result[rows] = (table @ local[rows][:, :, None]).max(axis=(1, 2), initial=0.0)
    return result


def figures_of(model: ContinuumModel, state: ContinuumState) -> dict[str, Any]:
    """What a load case came to, as plain JSON values."""
    displacements, case = state.displacements, state.case
    size = np.linalg.norm(displacements, axis=1)
    most = int(size.argmax())
    middles = (model.elements.place + 0.5) * model.bricks.edge + model.low
    result: dict[str, Any] = {
        "name": case.name,
        "displacement_mm": float(size[most]),
        "displacement_at": model.nodes[most].tolist(),
        "loads": case.mean_displacements(displacements),
        "work_nmm": state.work,
        "steps": state.steps,
    }
    for name, values, share in (
        ("lattice_use", state.use, model.shares.lattice),
        ("skin_mpa", state.skin, model.shares.solid),
        ("strut_buckling", state.struts, model.shares.lattice),
    ):  # fmt: skip
        result[name] = result[f"{name}_at"] = None
        if values is None:
            continue
        weights = share.mean(axis=1)
        there = (weights > 0.0) & np.isfinite(values)
        if there.any() and values[there].any():
            rows = np.flatnonzero(there)
            row = rows[row_of_most(values[rows], weights[rows])]
            result[name], result[f"{name}_at"] = float(values[row]), middles[row].tolist()
    return result


def cells_across(shares: Floats, edge: Floats, cell_size: float) -> float:
    """Cells across the largest ball in (nx, ny, nz) shares of lattice, to an element too many."""
    inside = np.pad(shares > 0.5, 1)
    deepest = float(ndimage.distance_transform_edt(inside).max())
    return 2.0 * deepest * float(edge.mean()) / cell_size


def conduct(
    model: ContinuumModel,
    temperatures: Sequence[tuple[Region, float]],
    conductivity: float,
    powers: Sequence[tuple[Region, float]] = (),
    films: Sequence[tuple[Region, float, float]] = (),
) -> tuple[Floats, Floats]:
    """Steady heat between regions of given temperatures, and through others; none lost elsewhere.

    A film's conductance is lumped at the nodes of its region, by their parts of its area.

    Args:
        model: the part.
        temperatures: regions and what each is held at, K or degrees C.
        conductivity: of the solid, W/(m K).
        powers: regions and the W that flow into the part through each.
        films: regions beside a fluid, its temperature, and W/(m2 K) between the two.

    Returns:
        (n,) temperatures of the nodes, and (temperatures + films,) W that each of these gives.

    Raises:
        VolfrepError: nothing of the part lies in a region, there are none, or a piece of the part
            hangs on none that is held.
    """
    if not (temperatures or films) or len(temperatures) + len(powers) + len(films) < 2:
        raise VolfrepError("Give two regions or more, one of them with its temperature.")
    count = len(model.nodes)
    own = conductivity * 1e-3 * model.conductivity[:, None, None] * np.eye(3)
    blocks = model.bricks.conductances(model.shares, own, conductivity * 1e-3)
    if model.border is not None:
        np.add.at(blocks, model.border[0], conductivity * 1e-3 * model.border[1])
    rows = np.repeat(model.elements.nodes, 8, axis=1).ravel()
    columns = np.tile(model.elements.nodes, (1, 8)).ravel()
    matrix = csr_matrix((blocks.ravel(), (rows, columns)), (count, count))
    value, fixed_by, given = np.zeros(count), np.full(count, -1), np.zeros(count)
    for region, power in powers:
        given += power * model.loaded.weights_of(region)
    own_films = []
    for region, temperature, film in films:
        area = model.loaded.area_of(region)
        if area == 0.0:
            raise VolfrepError(f"{region} has no area for a film: give a face.")
        passed = film * 1e-6 * area * model.loaded.weights_of(region)
        own_films.append((passed, temperature))
        matrix = matrix + diags(passed)
        given += temperature * passed
    for k, (region, temperature) in enumerate(temperatures):
        surface = np.zeros(len(model.loaded.body.nodes), bool)
        surface[nodes_in(model.loaded.body, region)] = True
        at = model.loaded.nodes_at(surface)[0]
        value[at], fixed_by[at] = temperature, k
    free = (fixed_by < 0).astype(float)[:, None]
    forces = (given - matrix @ value)[:, None]
    try:
        value += solve(System(matrix, forces, 1), forces, np.zeros(1), free)[:, 0]
    except VolfrepError as error:
        raise VolfrepError(
            "The heat's equations did not converge: are the regions connected?"
        ) from error
    flow = matrix @ value - given
    gives = [float(flow[fixed_by == k].sum()) for k in range(len(temperatures))]
    gives += [float(passed @ (temperature - value)) for passed, temperature in own_films]
    return value, np.array(gives)
