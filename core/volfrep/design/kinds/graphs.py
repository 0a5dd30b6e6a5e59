# SPDX-License-Identifier: LGPL-2.1-or-later
"""Graph lattices, meshed joint by joint: of a file, between random points, or cells of any box."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...util.errors import VolfrepError
from ...util.types import Floats
from ..graphs import GivenGraph, RandomGraph
from ..spec_fields import Kind
from ..tpms import PeriodicSurface
from .strut_cells import strut_shares, triangles_of_struts

#: Struts for each point of a random network once short ones are drawn together.
STRUTS_PER_POINT = {"voronoi": 9.0, "delaunay": 7.5}
#: And for each square of the surface as wide as the points are apart: those that it cuts.
STRUTS_PER_FACE = {"voronoi": 0.8, "delaunay": 2.0}


class Graph(Kind):
    """Nodes and struts in place of octants."""

    has_grid = False
    is_cut_in_groups = False
    is_judged_by_preview = False

    def refuse(self) -> None:
        """Refuse what is about cells, of which a network has none."""
        spec = self.spec
        given = {
            "size grading": spec.size_grading is not None,
            "cell map": spec.cell_map is not None,
            "fillet": spec.fillet > 0.0,
            "removal of struts": spec.ending.removes_struts,
            "target of stiffness": spec.target is not None and spec.target.aim == "stiffness",
            "wall": isinstance(spec.cell, PeriodicSurface),
            "choice of active cells": spec.activation != "touching",
            "boundary of whole cells": spec.boundary == "whole" and spec.with_skin,
        }
        for what, is_given in given.items():
            if is_given:
                raise VolfrepError(self._not_for(what))

    def _not_for(self, what: str) -> str:
        return f"A {what} is for cells and not for a network: leave it out."

    def strut_shares(self, on_face: Floats | float = 0.5) -> Floats:
        """(m,) how much of each strut belongs to one cell."""
        return strut_shares(self.unit_cell(), on_face)

    def triangles_of_cell(self, shares: Floats) -> float:
        """Triangles of the struts in one cell, about."""
        return triangles_of_struts(self.spec, self.unit_cell(), shares)


class GraphOfFile(Graph):
    """Nodes and struts that a user brings."""

    @property
    def graph(self) -> GivenGraph:
        """They."""
        assert isinstance(self.spec.network, GivenGraph)
        return self.spec.network

    def refuse(self) -> None:
        """Refuse what is about cells, and a target beside radii of its own."""
        super().refuse()
        target = self.spec.target
        if len(self.graph.radii) and target is not None:
            raise VolfrepError(
                f"The network's own radii say how thick its struts are: leave the target of "
                f"{target.called} out, or the radii."
            )

    @property
    def widths(self) -> Floats:
        """(m,) what the lattice's radius is multiplied by at each strut; none, (0,), for 1."""
        return self.graph.widths

    def as_values(self) -> dict[str, Any]:
        """The file, and how cells are laid upon what it holds."""
        graph = self.graph
        if not graph.source or not Path(graph.source).is_file():
            raise VolfrepError(
                "The network has no file that could be named: save it as .json first."
            )
        return {
            "network": "file", "network_file": graph.source,
            "network_thickness": abs(graph.thickness),
            "network_layers": graph.layers if graph.thickness else 0,
            "network_reversed": graph.thickness < 0.0,
        }  # fmt: skip

    def content_of_0_1_0(self) -> Sequence[NDArray[Any]] | None:
        """Nodes, struts and radii; and the cell, which is of no effect."""
        graph, cell = self.graph, self.unit_cell()
        if len(graph.widths) or not cell.is_uniform_cube:
            return None
        return graph.nodes, graph.struts, graph.radii, cell.nodes, cell.struts

    def graph_in(self, inside: float, area: float) -> tuple[float, float]:
        """One, and the struts that there are."""
        return 1.0, float(len(self.graph.struts))

    def refuse_idle_cell(self, given: Mapping[str, object]) -> None:
        """Refuse a cell where none is laid, and its size where nothing is counted by it."""
        file = f"'{self.graph.source}'"
        if "cell" in given and not self.graph.cell:
            raise VolfrepError(
                f"--cell has no effect with {file}, which holds struts, and no hexahedra or "
                "quadrilaterals to lay cells into: leave it out."
            )
        counts = self.graph.thickness and not given.get("network_layers")
        if "cell_size" in given and not (counts or self.spec.resolution):
            raise VolfrepError(
                f"--cell-size has no effect with {file}, which says where every strut lies: leave "
                "it out."
            )


class GraphOfPoints(Graph):
    """The edges between random points."""

    @property
    def graph(self) -> RandomGraph:
        """What is said of them."""
        assert isinstance(self.spec.network, RandomGraph)
        return self.spec.network

    def refuse(self) -> None:
        """Refuse what is about cells, and what moves a lattice."""
        super().refuse()
        for what, value in (("orientation", self.spec.orientation), ("origin", self.spec.origin)):
            if value is not None:
                raise VolfrepError(
                    f"An {what} moves a lattice that is given, and not random points: leave it "
                    "out, or take another seed."
                )

    def content_of_0_1_0(self) -> Sequence[NDArray[Any]] | None:
        """The cell, which is of no effect."""
        cell = self.unit_cell()
        if self.graph.field is not None or not cell.is_uniform_cube:
            return None
        return cell.nodes, cell.struts

    def graph_in(self, inside: float, area: float) -> tuple[float, float]:
        """Points, and struts between them once short ones are drawn together."""
        points = self.graph.points or max(1.0, inside / self.spec.cell_size**3)
        faced = area / (inside / points) ** (2.0 / 3.0)
        kind = self.graph.kind
        return points, points * STRUTS_PER_POINT[kind] + faced * STRUTS_PER_FACE[kind]

    def refuse_idle_cell(self, given: Mapping[str, object]) -> None:
        """Refuse a cell, and its size beside a number of points."""
        if "cell" in given:
            raise VolfrepError(
                f"--cell has no effect with --network {self.graph.kind}: leave one of them out."
            )
        if "cell_size" in given and self.graph.points and not self.spec.resolution:
            raise VolfrepError(
                "--cell-size has no effect with --network-points: each says how many points there "
                "are; leave one of them out."
            )


class CellsAsGraph(Graph):
    """Cells that are no cubes, or whose struts differ, side by side."""

    @property
    def widths(self) -> Floats:
        """(m,) what the lattice's radius is multiplied by at each strut; none, (0,), for 1."""
        return self.unit_cell().widths

    def _not_for(self, what: str) -> str:
        return (
            f"A {what} is for cells that are cubes with struts of one radius, which "
            f"'{self.unit_cell().name}' is not: leave it out, or choose another cell."
        )

    def graph_in(self, inside: float, area: float) -> tuple[float, float]:
        """Cells, and their struts."""
        cell = self.unit_cell()
        edges = self.spec.cell_size * np.array(cell.edges)
        # A cell that the wall merely touches is there too.
        reached = inside + 0.5 * area * float(edges.mean())
        points = max(1.0, reached / float(edges.prod()))
        return points, points * float(strut_shares(cell).sum())
