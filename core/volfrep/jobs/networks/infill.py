# SPDX-License-Identifier: LGPL-2.1-or-later
"""A solid filled with a network in place of cells: the stages of `Infill`, with other struts."""

from __future__ import annotations

from concurrent.futures import Executor
from functools import cached_property

import numpy as np

from ...design.cells import joint_radius
from ...design.networks import GivenNetwork, RandomNetwork
from ...design.spec import LatticeSpec
from ...design.spec_parts import DEFAULT_RELATIVE_DEVIATION
from ...grid.activation import CellGrid
from ...grid.placement import Placement, node_radii
from ...grid.strut_graph import Wireframe
from ...lattice.padded_grid import PaddedGrid
from ...mesh.edge_table import plural
from ...mesh.float32_repair import shortest_edge
from ...mesh.triangle_mesh import TriangleMesh
from ...network.random_graph import random_graph
from ...network.surface import NetworkSurface, network_surface, sides_for
from ...reports.result import Result, report_of
from ...spatial.proximity import closest_points
from ...spatial.rays import inside_points
from ...trim.boolean_trim import Trimmed
from ...trim.finish import finished, tidied
from ...trim.group_cut import cut_mesh
from ...trim.loose_pieces import Cleared, clear
from ...trim.stage import cleared_cut, drained_part
from ...trim.trimmed_surface import TrimmedSurface
from ...util.cache import StageCache
from ...util.errors import VolfrepError
from ...util.progress import Monitor, ProgressCallback
from ...util.types import Floats, Ints
from ..active_cells import ActiveCells
from ..infill import Infill
from ..walls.infill import WallInfill

#: Struts of a random network are drawn together where they are shorter than so many radii.
SHORTEST = 4.0


def infill_of(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    cache: StageCache | None = None,
    progress: ProgressCallback | None = None,
    monitor: Monitor | None = None,
    executor: Executor | None = None,
    streamed: bool = False,
) -> Infill:
    """The stages of a solid filled with cells, walls or a network; arguments as of `Infill`."""
    kind = WallInfill if spec.surface is not None else Infill
    if spec.network is not None:
        kind = NetworkInfill
    return kind(
        solid, spec, cache=cache, progress=progress, monitor=monitor, executor=executor,
        streamed=streamed,
    )  # fmt: skip


def network_frame(
    nodes: Floats,
    network: GivenNetwork | None,
    struts: Ints,
    spec: LatticeSpec,
    placement: Placement,
) -> Wireframe:
    """A network's wireframe in the part: radii of its own, or those of the specification.

    Joint spheres have radius r (1 + r / L), with the median length of a strut for L.
    """
    rows = struts.astype(np.int32)
    if network is not None and len(network.radii) and spec.radius_grading is None:
        radii = network.radii
    else:
        radii = node_radii(spec.struts, nodes, placement)[rows]
    thickest = np.zeros(len(nodes))
    np.maximum.at(thickest, rows, radii)
    length = np.linalg.norm(nodes[rows[:, 1]] - nodes[rows[:, 0]], axis=1)
    joints = joint_radius(thickest, float(np.median(length)))
    return Wireframe(placement.nudged(nodes), rows, np.array(radii), joints)


def meshed(frame: Wireframe, spec: LatticeSpec, monitor: Monitor) -> NetworkSurface:
    """The surface of a network at the specification's resolution or deviation."""
    radius = float(np.median(frame.radii))
    relative = DEFAULT_RELATIVE_DEVIATION
    if spec.deviation is not None:
        relative = spec.deviation / radius
    elif spec.resolution is not None:
        relative = (spec.cell_size / spec.resolution / radius) ** 2 / 16.0
    return network_surface(frame, sides_for(relative), monitor)


def overlaps_told(made: NetworkSurface, frame: Wireframe) -> tuple[str, ...]:
    """A sentence on struts that overlap others; none where none do."""
    if not made.united:
        return ()
    count = len(frame.struts)
    parts = []
    if len(made.crowded):
        x, y, z = frame.nodes[frame.struts[made.crowded[0]]].mean(axis=0)
        parts.append(
            f"{plural(len(made.crowded), 'strut')} too short or too narrow at a joint, as at "
            f"({x:.4g}, {y:.4g}, {z:.4g})"
        )
    if len(made.overlapping):
        one = made.overlapping[0, 0]
        place = frame.nodes[frame.struts[one]].mean(axis=0) if one < count else None
        place = frame.nodes[one - count] if place is None else place
        x, y, z = place
        parts.append(
            f"{plural(len(made.overlapping), 'pair')} of struts that run into each other, as at "
            f"({x:.4g}, {y:.4g}, {z:.4g})"
        )
    return (f"United as they overlap: {' and '.join(parts)}; thinner struts would not.",)


class NetworkInfill(Infill):
    """A solid filled with a network, stage by stage; see `Infill`.

    There are no cells: `cells` is an empty grid.
    """

    @cached_property
    def cells(self) -> ActiveCells:
        """None."""
        none = CellGrid(np.zeros(3), self.spec.cell_size, (0, 0, 0))
        return ActiveCells(PaddedGrid(none, (0, 0, 0), None), np.zeros((0, 0, 0), bool))

    @cached_property
    def struts(self) -> Wireframe:
        """The network's nodes and struts, whole, where its mesh has them."""
        wanted, placement = self.spec.network, self.placement
        if isinstance(wanted, RandomNetwork):
            domain = self.domain.mesh

            def depth(points: Floats) -> Floats:
                inside = inside_points(domain, points, self.monitor)
                found = np.zeros(len(points))
                found[inside] = closest_points(domain, points[inside])[1]
                return found

            shortest = SHORTEST * self.spec.struts.extremes[1]
            with self.monitor.stage("network", 0.3, 0.4):
                nodes, struts = random_graph(
                    wanted, domain, self.spec.cell_size, shortest, depth, self.monitor
                )
            return network_frame(nodes, None, struts, self.spec, placement)
        assert wanted is not None
        return network_frame(wanted.nodes, wanted, wanted.struts, self.spec, placement)

    @cached_property
    def surface(self) -> NetworkSurface:
        """The network's own surface, nothing cut."""
        frame = self.struts
        with self.monitor.stage("lattice", 0.4, 0.6):
            return meshed(frame, self.spec, self.monitor)

    @cached_property
    def lattice(self) -> Result:
        """The network without the skin: trimmed to its domain, or whole."""
        made = self.surface
        with self.monitor.stage("trim", 0.6, 1.0):
            if self.spec.ending.is_trimmed:
                cleared = self._cut_surface(with_skin=False)
            else:
                cleared = uncut(made, self._smallest, self.monitor)
        return self._reported("lattice", cleared)

    @cached_property
    def part(self) -> Result:
        """Skin and network in one; without a skin, the network trimmed at the part's surface."""
        skin = self.spec.skin
        if skin is None:
            return self.lattice
        _, drained = self.surface, None
        with self.monitor.stage("trim", 0.6, 1.0):
            cleared = self._cut_surface(with_skin=True)
            if self.spec.drains is not None:
                cleared, drained = drained_part(
                    cleared, self.solid, self.domain, self.struts, skin, self.spec.drains,
                    self.monitor,
                )  # fmt: skip
        return self._reported("part", cleared, drained)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be said of the solid, of its skin, and of struts that overlap."""
        said = super().warnings
        if "surface" in self.__dict__:
            said += overlaps_told(self.surface, self.struts)
        return said

    @property
    def _smallest(self) -> float:
        """Volume below which a shell is no piece of a network, mm3."""
        return float((0.2 * np.median(self.struts.radii)) ** 3)

    def _cut_surface(self, *, with_skin: bool) -> Cleared:
        full = VolfrepError(
            "The struts fill the whole part: make them thinner, or take fewer of them."
        )
        mesh, on_wall = cut_mesh(
            self.domain.wall, self.surface.mesh, cavity=with_skin, monitor=self.monitor
        )
        trimmed = Trimmed(TrimmedSurface(mesh), on_wall)
        return cleared_cut(
            trimmed, self.solid, self.domain, self._smallest, full, self.monitor,
            has_skin=self.spec.skin is not None, with_skin=with_skin,
            keep_pieces=self.spec.keep_pieces,
        )  # fmt: skip


def uncut(made: NetworkSurface, smallest: float, monitor: Monitor) -> Cleared:
    """A network that nothing cuts, without slivers, and its quality."""
    surface = tidied(TrimmedSurface(made.mesh), shortest_edge(made.mesh), monitor)
    return clear(surface, smallest, monitor)


def network_alone(spec: LatticeSpec, *, progress: ProgressCallback | None = None) -> Result:
    """A given network as it is, in free space.

    Raises:
        VolfrepError: the specification has no given network, or it cannot be meshed.
        Cancelled: the callback said so.
    """
    wanted, monitor = spec.network, Monitor(progress)
    if not isinstance(wanted, GivenNetwork):
        raise VolfrepError("A network in free space is one of a file: give its nodes and struts.")

    def depth(_: Floats) -> Floats:
        raise VolfrepError(
            "A network in free space has no skin to grade the radius by: grade it along a "
            "direction or by a field."
        )

    bounds = np.stack([wanted.nodes.min(axis=0), wanted.nodes.max(axis=0)])
    placement = Placement(spec.cell_size, None, bounds, depth)
    frame = network_frame(wanted.nodes, wanted, wanted.struts, spec, placement)
    with monitor.stage("lattice", 0.0, 0.8):
        made = meshed(frame, spec, monitor)
    smallest = float((0.2 * np.median(frame.radii)) ** 3)
    cleared = uncut(made, smallest, monitor)
    surface, quality, notes = finished(cleared.surface, cleared.quality, monitor, moved=False)
    hull = made.mesh.bounds
    none = CellGrid(np.zeros(3), spec.cell_size, (0, 0, 0))
    report = report_of(
        quality, frame, none, np.zeros((0, 0, 0), bool), placement, spec, monitor,
        domain_volume=float(np.prod(hull[1] - hull[0])),
        warnings=overlaps_told(made, frame) + notes,
    )  # fmt: skip
    return Result(surface, frame, report)
