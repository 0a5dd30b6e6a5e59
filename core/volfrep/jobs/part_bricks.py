# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bricks of a filled part: which there are, what fills each, and how stiff that is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.ndimage import map_coordinates

from ..continuum.border import border_bars
from ..continuum.bricks import Bricks, Shares, add_bars, bar_conductances, constants
from ..continuum.cell_law import CellLaw, pressed_struts, split, stretched_tensors, turned
from ..continuum.cut_cells import CutCells, cut_cells, cut_tensors, near_free_faces
from ..continuum.model import (
    ContinuumModel,
    cells_across,
)
from ..design.spec import LatticeSpec
from ..grid.placement import node_radii
from ..loads.load_cases import LoadCases
from ..mechanics.catalogue import joint_law
from ..mechanics.elements import CORNERS, PARTS, solid_stiffness
from ..mechanics.endless import stretched_strains
from ..mechanics.frame import stiffened
from ..mechanics.free_layer import ALONG as ALONG_LAYER
from ..mechanics.free_layer import free_layer
from ..mechanics.joint_fit import periodic_frame
from ..tpms.solid import TpmsSolid
from ..util.errors import VolfrepError
from ..util.numbers import number
from ..util.types import Floats, Ints
from ..voxels.loaded import Loaded, surface_body
from ..voxels.multigrid import elements_at
from ..voxels.shares import VoxelGrid, fill_grid, grid_of
from .figures.properties import lattice_properties
from .infill import Infill
from .tpms.octants import surface_of
from .tpms.symmetry import is_cubic
from .tpms.voxels import cut_into_voxels

#: So many elements, if the user does not say how large they are; where cells are more, one a cell
#: up to the most.
USUAL, MOST = 12_000, 150_000
#: At so many thicknesses cells are looked up in the catalogue, or homogenised, where they vary.
LOOKED_UP, HOMOGENISED = 17, 4
#: Voxels along L of what is homogenised for this: moduli within 2 %.
ALONG = 40
#: Elements that are less full count as empty.
EMPTY = 0.01


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
        self.shares, self.place, filled, hard = _shares(infill, self.low, self.count, edge)
        self.size = (int(self.count[0]), int(self.count[1]), int(self.count[2]))
        self.elements = elements_at(self.place, self.size)
        # Blocks of whole cells bend no more than their joints move (docs/method.md).
        self.bricks = Bricks(edge, bending=not _is_whole(infill))
        self.middles = (self.place + 0.5) * edge + self.low
        self._body = surface_body(infill.solid, float(edge.max()))
        self.cut = self._cut_cells(filled) if law.free_layer is None else self._opened(filled, hard)

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
        own, frames, thickness = _lattice(infill, law, self.middles, thickness)
        whole = turned(own, frames)
        skin = constants(solid_stiffness(material.young, material.poisson))
        lattice = (
            whole if self.cut is None else turned(cut_tensors(own, self.cut.stiffness), frames)
        )
        matrices = bricks.matrices(shares, material.young * constants(lattice), skin)
        density = self.density_at(thickness)
        filled = (shares.lattice * density[:, None] + shares.solid).mean(axis=1)
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
            material.young * lattice, material.young * whole, frames, thickness, density,
            law.at(law.strength, thickness), self._left(law.at(law.conductivity, thickness)),
            _pressed(infill, law, thickness), material, weighing,
            cells_across(all_lattice, edge, spec.cell_size), border,
        )  # fmt: skip

    def density_at(self, thickness: Floats) -> Floats:
        """(e,) or (1,) of the lattice of (e,) or (1,) thicknesses, relative, where it is there."""
        return self._left(self.law.at(self.law.density, thickness))

    def _left(self, column: Floats) -> Floats:
        """What is as much as there is of struts, of whole cells and then of cut ones."""
        return column if self.cut is None else column * self.cut.mass

    def _opened(self, filled: Floats, hard: Floats) -> CutCells:
        """Of a TPMS, as soft as free faces make it.

        Args:
            filled: shares of lattice of all parts of all bricks.
            hard: of skin.
        """
        assert self.law.free_layer is not None
        step, depth = self.bricks.edge / PARTS, 0.5 * self.infill.spec.cell_size
        near = _by_brick(near_free_faces(filled, hard, step, depth), self.count)
        near = near[tuple(self.place.T)]
        own = self.shares.lattice
        share = (near * own).sum(axis=1) / np.maximum(own.sum(axis=1), 1e-9)
        return CutCells.softened(1.0 - (1.0 - self.law.free_layer) * share)

    def _cut_cells(self, filled: Floats) -> CutCells | None:
        """Of each brick, means of its cells; None without struts.

        Args:
            filled: shares of lattice of all parts of all bricks.
        """
        infill, cell = self.infill, self.infill.spec.kind.cube
        if cell is None or _is_whole(infill):
            return None
        assert infill.cells is not None
        cells, mapping = infill.cells.padded.cells, infill.placement.mapping
        length, step = cells.cell_size, self.bricks.edge / PARTS

        def filled_at(points: Floats) -> Floats:
            points = points * length + cells.origin
            at = ((points if mapping is None else mapping.to_part(points)) - self.low) / step
            inside = ((at >= 0) & (at <= filled.shape)).all(axis=1)
            found = map_coordinates(filled, (at[inside] - 0.5).T, order=1, mode="nearest")
            result = np.zeros(len(points))
            result[inside] = found
            return result

        # The cells that the eighths of bricks lie in, and the lattice there.
        count, split_up = len(self.place), (2, PARTS // 2) * 3
        weights = self.shares.lattice.reshape(count, *split_up).mean(axis=(2, 4, 6))
        weights = weights.reshape(count, 8) + 1e-9
        points = (self.middles[:, None] + (CORNERS - 0.5) * 0.5 * self.bricks.edge).reshape(-1, 3)
        points = points if mapping is None else mapping.to_lattice(points)
        places = np.floor((points - cells.origin) / length).astype(np.int64)
        places, kind = np.unique(places, axis=0, return_inverse=True)
        ratio = float(self.law.thickness.mean()) / length
        found = cut_cells(cell, ratio, places, filled_at)
        return found.means(kind.reshape(-1, 8), weights)


def _pressed(infill: Infill, law: CellLaw, thickness: Floats) -> Floats | None:
    mapping = infill.placement.mapping
    if law.pressed is None or (mapping is not None and not mapping.is_rigid):
        return None
    return law.at(law.pressed, thickness)


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


def _shares(
    infill: Infill, low: Floats, count: Ints, edge: Floats
) -> tuple[Shares, Ints, Floats, Floats]:
    """What fills the bricks' parts, the places of those that are not empty, all shares of both."""
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
    return Shares(own[there], hard[there]), np.argwhere(there), lattice, solid


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
        None if kind.has_struts else _free_layer(spec, float(np.mean(values))),
    )


def _free_layer(spec: LatticeSpec, thickness: float) -> float:
    """Of `CellLaw`, of a TPMS; of its mean thickness, if that varies."""
    wall = replace(spec.wall, thickness=thickness) if spec.wall.is_sheet else spec.wall
    solid = TpmsSolid.of(surface_of(spec), wall, spec.cell_size)
    return free_layer(cut_into_voxels(solid, ALONG_LAYER, octant=False), cubic=is_cubic(solid))


def _lattice(
    infill: Infill, law: CellLaw, middles: Floats, thickness: Floats
) -> tuple[Floats, Floats, Floats]:
    """Stiffness in the cells' axes, these, and how thick, at the bricks' middles.

    One row each where all are alike.
    """
    spec, mapping = infill.spec, infill.placement.mapping
    if mapping is None:
        return law.tensors_at(thickness), np.eye(3)[None], thickness
    if mapping.is_rigid:
        frames, _ = split(mapping.jacobians(mapping.to_lattice(middles[:1])))
        return law.tensors_at(thickness), frames, thickness
    cell = spec.kind.cube
    assert cell is not None  # `homogenise_part` has refused others
    jacobians = mapping.jacobians(mapping.to_lattice(middles))
    frames, stretches = split(jacobians)
    radii = np.broadcast_to(thickness, len(middles))
    tensors = stretched_tensors(cell, spec.cell_size, radii, stretches, law)
    return tensors, frames, radii


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
