# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh under load cases as a solid: displacements, reactions, nominal stress."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import ndimage

from ..loads.load_cases import LoadCase
from ..loads.nodal_loads import resultant
from ..mechanics.elements import von_mises
from ..mechanics.materials import SolidMaterial
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.peaks import most_but_peaks
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .bricks import Brick, CutBricks, brick
from .loaded import Loaded, VoxelCase, solve_nodal_cases, surface_body
from .multigrid import AT_ONCE, Elements, Fine, Multigrid, elements_at
from .shares import VoxelGrid, voxel_grid

#: Voxels that are less full count as empty: together they were below 0.1 % of every part.
LEAST = 0.01
#: Stress is told of voxels at least so full.
LEAST_FILLED = 0.5
#: A place is thick where so many voxels lie between it and its surfaces, or nearly.
DEEP = 2.0
#: Voxels that count as the outside, from it inwards.
OUTER = 2


@dataclass(frozen=True, eq=False)
class VoxelModel:
    """A part as bricks.

    Attributes:
        grid: its voxels.
        elements: those that are there.
        shares: (e,) how full they are.
        parts: (e, 8) the same of their parts.
        brick: a full one.
        cut: those that are not full.
        material: of all.
        loaded: takes loads to the nodes.
        dropped: mm3 of pieces that hang on nothing, of which voxels know no more than an edge.
    """

    grid: VoxelGrid
    elements: Elements
    shares: Floats
    parts: Floats
    brick: Brick
    cut: CutBricks
    material: SolidMaterial
    loaded: Loaded
    dropped: float

    @property
    def nodes(self) -> Floats:
        """(n, 3) mm."""
        return self.loaded.nodes

    @property
    def volume(self) -> float:
        """Of what the voxels hold, mm3."""
        return float(self.shares.sum() * np.prod(self.grid.edge))


@dataclass(frozen=True, eq=False)
class VoxelState:
    """A load case solved.

    Attributes:
        case: on the nodes.
        displacements: (n, 3) mm.
        stress: (e,) MPa, von Mises, nominal: the largest of a voxel's Gauss points.
        reactions: (n, 3) N on what is held.
        steps: of the conjugate gradients.
    """

    case: VoxelCase
    displacements: Floats
    stress: Floats
    reactions: Floats
    steps: int


def voxel_model(
    mesh: TriangleMesh, voxel: float, material: SolidMaterial, monitor: Monitor | None = None
) -> VoxelModel:
    """Make bricks of a closed mesh.

    Args:
        mesh: closed, mm.
        voxel: edge of a voxel, mm.
        material: of the solid.
        monitor: asked for a cancel.

    Raises:
        VolfrepError: no voxel is filled.
    """
    grid = voxel_grid(mesh, voxel, monitor)
    filled = grid.shares >= LEAST
    labels, count = ndimage.label(filled)
    if not count:
        raise VolfrepError(f"The part fills no voxel of {voxel:g} mm: choose smaller ones.")
    sizes = ndimage.sum_labels(grid.shares, labels, np.arange(1, count + 1))
    keep = 1 + int(np.argmax(sizes))
    filled = labels == keep
    each = float(np.prod(grid.edge))
    place = np.argwhere(filled)
    shares = grid.shares[filled]
    elements = elements_at(place, grid.shares.shape)
    loaded = Loaded(
        surface_body(mesh, float(grid.edge.max())), grid, elements, shares, material.density
    )
    dropped = float(np.delete(sizes, keep - 1).sum()) * each
    own = brick(material.young, material.poisson, grid.edge)
    cut = CutBricks(material.young, material.poisson, grid.edge)
    parts = grid.parts_of(place)
    grid = replace(grid, parts=np.zeros((0, 0, 0), np.float32))  # they are with the elements
    return VoxelModel(grid, elements, shares, parts, own, cut, material, loaded, dropped)


def solve_cases(
    model: VoxelModel,
    cases: Sequence[LoadCase],
    monitor: Monitor | None = None,
) -> list[VoxelState]:
    """Solve load cases.

    Args:
        model: the part.
        cases: what it carries.
        monitor: asked for a cancel, and told how far it is.

    Raises:
        VolfrepError: a case does not fit the part, or it is not held.
        Cancelled: when the monitor says so.
    """
    monitor = monitor or Monitor()

    def solver_of(free: Bools) -> Multigrid:
        fine = Fine(
            model.elements, model.shares < 1.0, model.brick.stiffness,
            lambda rows: model.cut.stiffness(model.parts[rows]), free,
        )  # fmt: skip
        return Multigrid(fine, model.grid.shares.shape, monitor)

    def state_of(case: VoxelCase, displacements: Floats, forces: Floats, steps: int) -> VoxelState:
        reactions = np.where(case.fixed, forces - case.loads, 0.0)
        return VoxelState(case, displacements, stresses(model, displacements), reactions, steps)

    return solve_nodal_cases([model.loaded.case(case) for case in cases], solver_of, state_of)


def stresses(model: VoxelModel, displacements: Floats) -> Floats:
    """(e,) MPa, von Mises: the largest of the eight Gauss points of a full voxel; of one that is
    cut in the middle of what is filled.
    """
    table = model.brick.stress[:8].reshape(48, 24).T
    result = np.empty(len(model.shares))
    for begin in range(0, len(result), AT_ONCE):
        part = slice(begin, begin + AT_ONCE)
        own = displacements[model.elements.nodes[part]].reshape(-1, 24)
        result[part] = von_mises((own @ table).reshape(-1, 8, 6)).max(axis=1)
        rows = np.flatnonzero(model.shares[part] < 1.0)
        stress = model.cut.stress(model.parts[part][rows], own[rows], model.grid.edge)
        result[begin + rows] = von_mises(stress)
    return result


def thick_places(model: VoxelModel) -> Bools:
    """(e,) the voxels of places that are at least four voxels thick."""
    solid = np.pad(model.grid.shares >= LEAST_FILLED, 1)
    deep = ndimage.distance_transform_edt(solid) >= DEEP
    near = ndimage.distance_transform_edt(~deep) <= DEEP if deep.any() else deep
    return np.asarray(near[1:-1, 1:-1, 1:-1][tuple(model.elements.place.T)])


def outer_places(model: VoxelModel) -> Bools:
    """(e,) the voxels next to the outside: the skin of a closed part, not what it encloses."""
    empty = np.pad(model.grid.shares < LEAST, 1, constant_values=True)
    labels, _ = ndimage.label(empty)
    outside = labels == labels[0, 0, 0]
    near = ndimage.binary_dilation(outside, np.ones((3, 3, 3), bool), OUTER)
    return np.asarray(near[1:-1, 1:-1, 1:-1][tuple(model.elements.place.T)])


def figures_of(model: VoxelModel, state: VoxelState) -> dict[str, Any]:
    """What a load case came to, as plain JSON values."""
    case, displacements = state.case, state.displacements
    size = np.linalg.norm(displacements, axis=1)
    most = int(size.argmax())
    filled = model.shares >= LEAST_FILLED
    edge, low = model.grid.edge, model.grid.low
    worst = int(np.argmax(np.where(filled, state.stress, 0.0)))
    places = {"all": filled, "outside": filled & outer_places(model)}
    places["thick"] = filled & thick_places(model)
    applied = np.concatenate(resultant(model.nodes, case.loads))
    back = np.concatenate(resultant(model.nodes, state.reactions))
    return {
        "name": case.name,
        "displacement_mm": float(size[most]),
        "displacement_at": model.nodes[most].tolist(),
        "loads": case.mean_displacements(displacements),
        "compliance_nmm": float(np.vdot(case.loads, displacements)),
        "stress_mpa": {
            name: most_but_peaks(state.stress[at], model.shares[at]) if at.any() else None
            for name, at in places.items()
        },
        "largest_stress_mpa": float(state.stress[worst]),
        "largest_stress_at": ((model.elements.place[worst] + 0.5) * edge + low).tolist(),
        "asked": case.asked.tolist(),
        "reaction": back.tolist(),
        "imbalance": _imbalance(model, case, applied, back),
        "steps": state.steps,
    }


def _imbalance(model: VoxelModel, case: VoxelCase, applied: Floats, back: Floats) -> float:
    """What is left of loads and reactions together, and of what was asked, over all forces."""
    size = float(np.linalg.norm(model.nodes.max(axis=0) - model.nodes.min(axis=0)))
    scale = np.repeat([1.0, 1.0 / size], 3)
    total = np.abs(case.loads).sum() + np.abs(back[:3]).sum()
    left = np.abs((applied + back) * scale).max() + np.abs((applied - case.asked) * scale).max()
    return float(left / max(total, 1e-300))
