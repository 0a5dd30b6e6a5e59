# SPDX-License-Identifier: LGPL-2.1-or-later
"""A kind of lattice in one module: upright rods in rows, a cell size apart.

A row of `design.kinds.KINDS` and one of `jobs.kinds.LATTICE_KINDS` bring it into the engine.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from volfrep.design.spec import LatticeSpec
from volfrep.design.spec_fields import Kind
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.kinds.kind import LatticeKind
from volfrep.jobs.kinds.surface_lattice import SurfaceLattice
from volfrep.jobs.part_depth import PartDepth, Preview
from volfrep.jobs.part_domain import PartDomain
from volfrep.jobs.preview import show_struts
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError
from volfrep.util.types import Floats

#: Sides of a rod; how far it reaches beyond the part, mm.
SIDES, BEYOND = 24, 1.0


@dataclass(frozen=True)
class Rods:
    """What a specification has in place of a cell."""

    name: str = "Rods"


class RodSpec(Kind):
    """Rods, as a specification has them."""

    has_grid = is_cut_in_groups = False

    def refuse(self) -> None:
        """Refuse rods that touch each other."""
        if 2.0 * self.spec.strut_radius >= self.spec.cell_size:
            raise VolfrepError("The rods touch each other: make them thinner.")

    def strut_shares(self, on_face: Floats | float = 0.5) -> Floats:
        """One rod in each cell."""
        return np.ones(1)

    def triangles_of_cell(self, shares: Floats) -> float:
        """Two for each side."""
        return 2.0 * SIDES


class RodKind(LatticeKind):
    """What rods do."""

    def fill(self, part: PartDomain) -> RodLattice:
        """The rods of a part."""
        return RodLattice(part)

    def preview(self, solid: TriangleMesh, depth: PartDepth) -> Preview:
        """What of them lies inside."""
        spec = self.spec

        def volume(bare: float, domain: float, skin: float) -> tuple[LatticeSpec, float]:
            return spec, bare * spec.strut_radius**2

        frame = rods_about(solid.bounds, spec)
        return show_struts(solid, spec, depth, frame, volume, "No rod lies inside the skin.")


class RodLattice(SurfaceLattice):
    """Rods in a part."""

    @cached_property
    def struts(self) -> Wireframe:
        """Their axes."""
        return rods_about(self.part.solid.bounds, self.spec)

    @cached_property
    def surface(self) -> TriangleMesh:
        """A prism for each."""
        turns = 2.0 * np.pi * np.arange(SIDES) / SIDES
        circle = self.spec.strut_radius * np.stack([np.cos(turns), np.sin(turns), 0 * turns], 1)
        ends = self.struts.nodes[self.struts.struts]
        rings = (ends[:, :, None] + circle).reshape(len(ends), -1, 3)
        middles = ends.reshape(len(ends), 2, 3)
        low, up = np.arange(SIDES), (np.arange(SIDES) + 1) % SIDES
        triangles = np.concatenate([
            np.stack([low, up, low + SIDES], 1), np.stack([up, up + SIDES, low + SIDES], 1),
            np.stack([up, low, 0 * low + 2 * SIDES], 1),
            np.stack([low + SIDES, up + SIDES, 0 * low + 2 * SIDES + 1], 1),
        ])  # fmt: skip
        points = np.concatenate([rings, middles], axis=1)
        each = points.shape[1] * np.arange(len(points))[:, None, None]
        rows = (each + triangles).reshape(-1, 3).astype(np.int32)
        return TriangleMesh(points.reshape(-1, 3), rows)

    @property
    def spacing(self) -> float:
        """From rod to rod."""
        return self.spec.cell_size

    @property
    def smallest(self) -> float:
        """Of a piece of a rod."""
        return float((0.1 * self.spec.strut_radius) ** 3)


def rods_about(bounds: Floats, spec: LatticeSpec) -> Wireframe:
    """The rods that a box holds whole, the first one half a cell from its corner."""
    (x, y, low), (far_x, far_y, high) = bounds
    rows = np.arange(x, far_x, spec.cell_size), np.arange(y, far_y, spec.cell_size)
    place = np.stack(np.meshgrid(*rows), axis=-1).reshape(-1, 2) + 0.5 * spec.cell_size
    feet = np.column_stack([place, np.full(len(place), low - BEYOND)])
    heads = np.column_stack([place, np.full(len(place), high + BEYOND)])
    rods = np.arange(2 * len(place), dtype=np.int32).reshape(2, -1).T
    radius = spec.strut_radius
    return Wireframe(
        np.concatenate([feet, heads]), rods, np.full((len(rods), 2), radius),
        np.full(2 * len(rods), radius),
    )  # fmt: skip
