# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cubic cells with struts of one radius, meshed as octants, and what these take to be meshed."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...util.errors import VolfrepError
from ...util.numbers import duration
from ...util.types import Floats
from .. import costs
from ..cells import LIBRARY, UnitCell
from ..graphs import StretchedCells
from ..spec_fields import Kind, SpecFields

#: At a joint a strut's surface is buried in the others up to no more radii from the node.
BURIED = 1.4
#: Facets are no longer than this, in radii: thin struts are sampled finely, so that none is lost.
LONGEST_EDGE = 0.85
#: So many times as many facets as even ones there are, for those in the creases where struts meet;
#: and so much of a short strut's length has facets of its own, at least.
IN_CREASES, SHORTEST_BARE = 1.2, 0.6
#: Octants of a cell without mirrors, or whose struts cross beside their nodes, where facets are
#: divided and drawn apart: seconds for each triangle of a cell, and for each distance of a sample
#: from a strut. Random cells of 10 to 57 struts took 0.5 to 2 times as long.
SECONDS_PER_OWN_TRIANGLE = 1.5e-3
SECONDS_PER_DISTANCE = 4e-8
#: At least so much of a strut's surface is bare; struts whose angle has a smaller squared sine than
#: this are parallel.
LEAST_BARE = 0.05
PARALLEL = 1e-9
#: Cells whose octants take longer than this, s, or whose struts cross more often, are refused.
LONGEST = 900.0
MOST_CROSSING = 1000


class StrutCells(Kind):
    """Cubic cells with struts of one radius; others are taken as a graph."""

    @property
    def network(self) -> StretchedCells | None:
        """None, or what cells are taken as that are no cubes, or whose struts differ."""
        return None if self.unit_cell().is_uniform_cube else StretchedCells()

    @property
    def cube(self) -> UnitCell:
        """The cell."""
        return self.unit_cell()

    @property
    def endless(self) -> Mapping[str, Any]:
        """The cell, its radius and its fillet."""
        spec = self.spec
        sizes = {"cell_size": spec.cell_size, "strut_radius": spec.strut_radius}
        return {"cell": self.cube, **sizes, "fillet": spec.fillet}

    @property
    def catalogue_cell(self) -> UnitCell | None:
        """The cell, without fillets."""
        return None if self.spec.fillet else self.cube

    def content_of_0_1_0(self) -> Sequence[NDArray[Any]]:
        """The cell."""
        return self.cube.nodes, self.cube.struts

    def refuse(self) -> None:
        """Refuse struts that are too thick for the cell, or too thin for facets."""
        self.spec.struts.refuse_too_thick(self.spec.cell_size)
        _ = self.facets_along_cell

    @property
    def too_coarse(self) -> str:
        """Struts, which would not have their volume."""
        radius = self.spec.template_radius
        return f"struts of radius {radius:.3g} mm, which would not have their volume"

    def strut_shares(self, on_face: Floats | float = 0.5) -> Floats:
        """(m,) how much of each strut belongs to one cell."""
        return strut_shares(self.cube, on_face)

    def triangles_of_cell(self, shares: Floats) -> float:
        """Triangles of the struts in one cell, about."""
        return triangles_of_struts(self.spec, self.cube, shares)

    def meshing_seconds(self, sets: float) -> float:
        """As of `Kind`; of cells that are not the library's, and without mirrors or with struts
        that meet beside their nodes, by samples too.
        """
        spec, cell = self.spec, self.cube
        radius = spec.template_radius / spec.cell_size
        if LIBRARY.get(cell.name) == cell or (
            cell.is_mirror_symmetric and not crossing_struts(cell, radius)
        ):
            facets = self.triangles_of_cell(self.strut_shares())
            return costs.SECONDS_PER_OCTANT_TRIANGLE * facets * unlike_octants(cell, sets)
        ends = cell.nodes[cell.struts]
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        # So much of a surface is bare where solids lie anywhere in each other (Boolean model).
        bare = max(float(np.exp(-np.pi * radius**2 * lengths.sum())), LEAST_BARE)
        facets = bare * self.triangles_of_cell(self.strut_shares())
        steps = 0.5 * max(self.facets_along_cell, 1.0 / (0.75 * radius))
        distances = 8.0 * steps**3 * len(lengths)
        seconds = SECONDS_PER_OWN_TRIANGLE * facets + SECONDS_PER_DISTANCE * distances
        return sets * seconds * (0.125 if cell.is_mirror_symmetric else 1.0)

    def refuse_crossing(self) -> None:
        """Refuse a cell of struts whose octants would take too long to mesh.

        Raises:
            VolfrepError: so they would.
        """
        seconds = self.meshing_seconds(1.0)
        cell, spec = self.cube, self.spec
        crossing = crossing_struts(cell, spec.template_radius / spec.cell_size)
        if seconds <= LONGEST and crossing <= MOST_CROSSING:
            return
        if crossing > MOST_CROSSING:
            why = f"run into each other beside their nodes at {crossing:,} places, of which"
            why += f" {MOST_CROSSING:,} at most are meshed"
        else:
            why = f"would take about {duration(seconds)} to mesh in a single cell"
        raise VolfrepError(
            f"The {len(cell.struts):,} struts of the cell '{cell.name}' {why}: leave struts out, "
            "put nodes where they cross, or choose thinner struts with a coarser resolution."
        )


def triangles_of_struts(spec: SpecFields, cell: UnitCell, shares: Floats) -> float:
    """Equilateral facets on the struts of a cell, between its joints, which own shares of them."""
    radius = spec.template_radius
    ends = cell.nodes[cell.struts]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) * spec.cell_size
    bare = np.maximum(length - _buried_length(cell) * radius, SHORTEST_BARE * length)
    edge = min(spec.cell_size / spec.kind.facets_along_cell, LONGEST_EDGE * radius)
    around = 2.0 * np.pi * radius / (np.sqrt(3.0) / 4.0 * edge**2)
    facets: Floats = IN_CREASES * around * bare
    return float(facets @ shares)


def strut_shares(cell: UnitCell, on_face: Floats | float = 0.5) -> Floats:
    """(m,) how much of each strut belongs to one cell: others share it on a face or an edge.

    `on_face` is the share of what lies on a face across x, y and z.
    """
    ends = cell.nodes[cell.struts]
    lies = (np.abs(ends - np.round(ends)) < 1e-9).all(axis=1) & (ends[:, 0] == ends[:, 1])
    shares: Floats = np.where(lies, on_face, 1.0).prod(axis=1)
    return shares


@lru_cache(maxsize=16)
def unlike_octants(cell: UnitCell, sets: float) -> float:
    """How many octants of a cell are meshed, in eighths of it.

    Args:
        cell: they are of.
        sets: as of `Kind.meshing_seconds`; about mirrors, neighbours show in no octant.
    """
    found, ends = set(), cell.nodes[cell.struts]
    for mirror in itertools.product((False, True), repeat=3):
        seen = np.where(mirror, 1.0 - ends, ends)
        seen = seen[(seen.min(axis=1) < 0.5 - 1e-6).all(axis=1)]
        rows = np.sort(np.round(1e6 * seen) @ [1.0, 2e6, 4e12], axis=1)
        found.add(tuple(map(tuple, np.unique(rows, axis=0).tolist())))
    return len(found) / 8.0 * (1.0 if len(found) == 1 else sets)


@lru_cache(maxsize=16)
def crossing_struts(cell: UnitCell, radius: float) -> int:
    """How many pairs of a cell's struts of a radius, in units of L, meet beside their nodes."""
    ends = cell.nodes[cell.struts]
    start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    count = 0
    for k in range(len(ends) - 1):
        w, apart = way[k + 1 :], start[k + 1 :] - start[k]
        # Nearest places of two lines, as shares of their lengths.
        a, b, c = way[k] @ way[k], w @ way[k], (w * w).sum(axis=1)
        d, e = apart @ way[k], (apart * w).sum(axis=1)
        determinant = a * c - b * b
        skew = determinant > PARALLEL * a * c
        with np.errstate(divide="ignore", invalid="ignore"):
            t, u = (d * c - b * e) / determinant, (d * b - a * e) / determinant
        inside = skew & (t > 0.0) & (t < 1.0) & (u > 0.0) & (u < 1.0)
        gap = apart[inside] + u[inside, None] * w[inside] - t[inside, None] * way[k]
        joined = (cell.struts[k + 1 :, :, None] == cell.struts[k]).any(axis=(1, 2))[inside]
        count += int(((np.linalg.norm(gap, axis=1) < 2.0 * radius) & ~joined).sum())
    return count


def _buried_length(cell: UnitCell) -> Floats:
    """(m,) so many radii of each strut lie in others that it meets, at both ends together.

    Two struts part where their distance from the node is r / tan(angle / 2).
    """
    ends = cell.nodes[cell.struts]
    way = ends[:, 1] - ends[:, 0]
    way /= np.linalg.norm(way, axis=1)[:, None]
    leaving = np.concatenate([way, -way])
    # A node of one face is the same as that of the opposite one.
    node = np.round(np.mod(ends.swapaxes(0, 1).reshape(-1, 3) + 1e-9, 1.0), 6)
    alike = (node[:, None] == node[None]).all(axis=2)
    cosine = np.where(alike, leaving @ leaving.T, -1.0)
    cosine[cosine > 1.0 - 1e-9] = -1.0  # itself, and its copies
    nearest = cosine.max(axis=1)
    buried = np.minimum(BURIED, np.sqrt((1.0 + nearest) / (1.0 - nearest)))
    both: Floats = buried[: len(way)] + buried[len(way) :]
    return both
