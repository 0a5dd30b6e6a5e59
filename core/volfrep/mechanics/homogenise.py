# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elastic tensor of the endless lattice, by finite elements on voxels of one cell.

The displacement is that of a uniform strain plus one that repeats from cell to cell. Voxels at the
surface count with their solid part only, so stiffness falls towards its limit as they become
smaller; three grids tell the limit, and how far off it still is. A cell that equals its mirror
images needs an octant: its mid-planes and faces are mirrors under normal strains, and
anti-mirrors of the two axes of a shear.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..design.cells import UnitCell
from ..util.errors import VolfrepError
from ..util.types import Floats
from .assembly import Nodes, System, assemble, look_back, nodes_of, solve
from .elements import SHEARS, hexahedron, solid_stiffness
from .endless import EndlessCell, endless_cell, refuse_odd
from .voxels import Voxels, voxels_of

#: Voxels along a strut's radius on the finest grid: of an octant, and of a whole cell.
PER_RADIUS = {True: 8.0, False: 4.0}
#: Fewest and most voxels along L on the finest grid.
LEAST_ALONG = 40
MOST_ALONG = {True: 400, False: 96}
#: What a user may ask for.
FEWEST, FINEST = 16, 512
#: Solid voxels that a finest grid should not exceed by itself.
MOST_VOXELS = {True: 30_000, False: 12_000}
#: Part of the last step (between the two finest grids, or from there to the limit) that the limit
#: is in doubt by.
DOUBT = 1.0 / 3.0
#: The limit keeps at least this part of the finest grid's stiffness, whatever the strain, and
#: exceeds it by no more than that: where struts nearly touch, coarse voxels join them, and a
#: parabola through them ends anywhere.
KEPT, EXCEEDED = 0.5, 1.02
#: Seconds grow by this power of the voxels along L: to solve cells of 15, 57 and 66 struts, twice
#: as many took 10 to 15 times as long.
COST = 3.6
#: Relative error of solving and of filling voxels, beside that.
FLOOR = 1e-3
#: A lattice softer than this in every way, over the solid, carries nothing.
_NOTHING = 1e-9
#: The three strains of a cubic cell, and how its moduli follow: 3 K', C' and C44.
CUBIC_STRAINS = np.array([[1, 1, 1, 0, 0, 0], [1, -0.5, -0.5, 0, 0, 0], [0, 0, 0, 1, 0, 0]], float)


@dataclass(frozen=True, eq=False)
class Grid:
    """One solution on one grid.

    Attributes:
        voxels: the solid.
        nodes: their corners.
        system: the equations.
        strains: (cases, 6) the macroscopic strains, Voigt.
        fluctuation: (n, cases) what is added to the uniform strain, in voxels.
        energy: (cases, cases) twice the energy of a cell for each pair of strains.
    """

    voxels: Voxels
    nodes: Nodes
    system: System
    strains: Floats
    fluctuation: Floats
    energy: Floats

    @property
    def tensor(self) -> Floats:
        """(6, 6) stiffness, Voigt."""
        if len(self.strains) == 6:
            return self.energy
        bulk, deviator, shear = np.diag(self.energy) / (9.0, 1.5, 1.0)
        tensor = np.diag([0.0, 0.0, 0.0, shear, shear, shear])
        tensor[:3, :3] = bulk - deviator / 3.0 + np.eye(3) * deviator
        return tensor


@dataclass(frozen=True, eq=False)
class Homogenised:
    """The elastic tensor of a lattice of a solid with Young's modulus 1.

    Attributes:
        tensor: (6, 6) stiffness, Voigt with engineering shear strains.
        tensors: (3, 6, 6) what the three grids gave, finest last.
        along: voxels along L of the three grids.
        finest: the solution on the finest.
        coarser: the one before, to tell errors by.
    """

    tensor: Floats
    tensors: Floats
    along: tuple[int, ...]
    finest: Grid
    coarser: Grid

    def error_of(self, modulus: Callable[[Floats], Floats | float]) -> Floats:
        """By how much what `modulus` makes of the tensor may be off, in its shape."""
        limit, finest, coarser = (
            np.asarray(modulus(tensor)) for tensor in (self.tensor, *self.tensors[:0:-1])
        )
        steps = np.maximum(np.abs(limit - finest), np.abs(finest - coarser))
        result: Floats = DOUBT * steps + FLOOR * np.abs(limit)
        return result


def is_cubic(cell: UnitCell) -> bool:
    """Whether a cell that is its own mirror image also looks the same along x, y and z."""
    own = _keys(cell.nodes, cell)
    return cell.is_mirror_symmetric and _keys(np.roll(cell.nodes, 1, axis=1), cell) == own


def _keys(nodes: Floats, cell: UnitCell) -> set[frozenset[tuple[int, ...]]]:
    places = [tuple(row) for row in np.round(nodes * 1e6).astype(np.int64).tolist()]
    return {frozenset((places[a], places[b])) for a, b in cell.struts.tolist()}


def homogenise(
    cell: UnitCell,
    radius: float,
    fillet: float = 0.0,
    *,
    poisson: float = 0.3,
    along: int | None = None,
    density: float | None = None,
    on_estimate: Callable[[float], None] = lambda seconds: None,
) -> Homogenised:
    """The elastic tensor, extrapolated from three grids.

    Args:
        cell: the unit cell.
        radius: of the struts, in units of L.
        fillet: radius of the round between struts, in units of L.
        poisson: the solid's ratio.
        along: voxels along L on the finest grid; None for as many as the radius asks for.
        density: the exact relative density, which every grid is filled to; None: as it comes.
        on_estimate: given how many seconds the rest will take, about, once the coarsest grid is
            solved.

    Raises:
        VolfrepError: the cell is not connected, or is no cube with struts of one radius.
    """
    refuse_odd(cell)
    endless = endless_cell(cell)
    octant = cell.is_mirror_symmetric
    sizes = grid_sizes(endless, radius, octant, along)

    def voxels(size: int) -> Voxels:
        return voxels_of(endless, radius, fillet, size, octant=octant, density=density)

    return homogenise_voxels(
        voxels,
        sizes,
        poisson,
        cubic=octant and is_cubic(cell),
        name=cell.name,
        on_estimate=on_estimate,
    )


def homogenise_voxels(
    voxels: Callable[[int], Voxels],
    sizes: tuple[int, ...],
    poisson: float,
    *,
    cubic: bool,
    name: str,
    on_estimate: Callable[[float], None] = lambda seconds: None,
) -> Homogenised:
    """The elastic tensor of whatever is made of voxels.

    Args:
        voxels: makes those of a number of voxels along L.
        sizes: three such numbers, finest last.
        poisson: the solid's ratio.
        cubic: whether three constants say all of the tensor.
        name: of the cell, for the sentences.
        on_estimate: as of `homogenise`.

    Raises:
        VolfrepError: the solid is not connected.
    """
    start = time.perf_counter()
    grids = [solve_grid(voxels(sizes[0]), poisson, cubic=cubic)]
    took = time.perf_counter() - start
    on_estimate(took * sum((size / sizes[0]) ** COST for size in sizes[1:]))
    grids += [solve_grid(voxels(size), poisson, cubic=cubic) for size in sizes[1:]]
    found = np.array([grid.tensor for grid in grids])
    _refuse_loose(found[-1], name)
    limit = _bound(extrapolate(found, sizes), found[-1])
    return Homogenised(limit, found, sizes, grids[-1], grids[-2])


def _bound(limit: Floats, finest: Floats) -> Floats:
    """The limit, brought between `KEPT` of the finest grid's stiffness and all of it.

    It stays as it is where it lies there, or next to nothing above.
    """
    values, vectors = np.linalg.eigh(0.5 * (finest + finest.T))
    some = values > _NOTHING * values[-1]
    root = np.sqrt(values[some])
    shares, ways = np.linalg.eigh(
        (vectors[:, some] / root).T @ (0.5 * (limit + limit.T)) @ (vectors[:, some] / root)
    )
    if shares[0] >= KEPT and shares[-1] <= EXCEEDED:
        return limit
    back = vectors[:, some] * root @ ways
    result: Floats = (back * np.clip(shares, KEPT, 1.0)) @ back.T
    return result


def grid_sizes(
    endless: EndlessCell, radius: float, octant: bool, along: int | None = None
) -> tuple[int, ...]:
    """Voxels along L on three grids, each about twice as fine as the one before.

    A whole number of voxels lies along the radius as nearly as can be: a surface along a grid's
    plane is represented best.
    """
    if along is None:
        # What struts alone make of the density, without their overlaps.
        rough = min(np.pi * radius**2 * endless.lengths.sum(), 1.0)
        along = bounded(PER_RADIUS[octant] / radius, rough, octant)
    return three_sizes(along)


def bounded(wanted: float, density: float, octant: bool) -> int:
    """Voxels along L, so many as are wanted unless that were too few, or too many to solve."""
    part = density / (8 if octant else 1)
    most = min((MOST_VOXELS[octant] / part) ** (1 / 3), MOST_ALONG[octant])
    return max(_even(min(wanted, most)), LEAST_ALONG)


def three_sizes(along: int) -> tuple[int, ...]:
    """Voxels along L on three grids, of the finest of which they are given.

    Raises:
        VolfrepError: there are too few or too many.
    """
    if not FEWEST <= along <= FINEST:
        raise VolfrepError(f"A cell needs {FEWEST} to {FINEST} voxels along its edge, not {along}.")
    fine = _even(along)
    return _even(fine / 4), _even(fine / 2), fine


def _even(number: float) -> int:
    return 2 * round(number / 2)


def extrapolate(values: Floats, sizes: tuple[int, ...]) -> Floats:
    """The limit of (3, ...) values on three grids.

    Fits a + b h + c h2 with h the voxel's edge: the second-order error of smooth parts, and the
    nearly first-order one of the sharp edges between struts (a reentrant edge's exponent is a
    little above 1/2, and energy goes with its double).
    """
    edges = 1.0 / np.array(sizes, float)
    weights = np.linalg.inv(np.vander(edges, 3, increasing=True))[0]
    limit: Floats = np.tensordot(weights, values, axes=1)
    return limit


def solve_grid(voxels: Voxels, poisson: float, *, cubic: bool) -> Grid:
    """All macroscopic strains on one grid: three of a cubic cell, else six."""
    nodes = nodes_of(voxels)
    element = hexahedron(poisson)
    system = assemble(voxels, nodes, element.stiffness, element.load)
    strains = CUBIC_STRAINS if cubic else np.eye(6)
    loads = system.loads @ strains.T
    free = _free(nodes, strains) if voxels.octant else np.ones_like(loads)
    octants = 8 if voxels.octant else 1
    energy = strains @ solid_stiffness(1.0, poisson) @ strains.T * voxels.relative_density
    uniform = np.diag(energy) * voxels.along**3 / octants
    fluctuation = solve(system, -loads, uniform, free, look_back=look_back(voxels))
    # Quadratic in what the solution still lacks.
    crossed = loads.T @ fluctuation
    inner = crossed + crossed.T + fluctuation.T @ (system.matrix @ fluctuation)
    energy = energy + octants * inner / voxels.along**3
    if voxels.octant:
        # Strains of different symmetry about the mirrors have no energy in common.
        kinds = (strains[:, 3:] != 0) @ np.array([1, 2, 4])
        energy *= kinds[:, None] == kinds
    return Grid(voxels, nodes, system, strains, fluctuation, energy)


def _free(nodes: Nodes, strains: Floats) -> Floats:
    """(3 n, cases) 1 where a displacement in an octant is free.

    On a mirror the displacement across it is held; on an anti-mirror those along it are.
    """
    on = (nodes.place == 0) | (nodes.place == nodes.last)  # (n, axes)
    free = np.ones((len(on), 3, len(strains)))
    for case, strain in enumerate(strains):
        sheared = {axis for k in range(3) if strain[3 + k] for axis in SHEARS[k]}
        for axis in range(3):
            for component in range(3):
                if (component == axis) != (axis in sheared):
                    free[on[:, axis], component, case] = 0.0
    return free.reshape(-1, len(strains))


def _refuse_loose(tensor: Floats, name: str) -> None:
    if not np.linalg.eigvalsh(tensor)[-1] > _NOTHING:
        raise VolfrepError(
            f"The cell '{name}' carries no load: its solid does not reach through it."
        )
