# SPDX-License-Identifier: LGPL-2.1-or-later
"""Graph lattices: their nodes and struts in a part or in free space, their surface, their radius.

Of a file, between random points in a part, or cells of any box side by side: each is meshed joint
by joint.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from ...design.cells import joint_radius
from ...design.graphs import GivenGraph, RandomGraph, StretchedCells
from ...design.graphs.conformal_cells import place_cells_along
from ...design.spec import LatticeSpec
from ...design.spec_parts import DEFAULT_RELATIVE_DEVIATION
from ...design.target import Target
from ...graphs.random_graph import random_graph
from ...graphs.surface import GraphSurface, graph_surface, sides_for
from ...grid.coordinate_map import mapped_box
from ...grid.placement import Placement, depth_below, node_radii, part_map
from ...grid.strut_graph import Wireframe
from ...lattice.padded_grid import keeps_places
from ...lattice.strut_volume import (
    FINE,
    VolumeByRadius,
    points_about,
    points_inside,
    volume_by_radius,
)
from ...mesh.triangle_mesh import TriangleMesh
from ...reports.result import Result, report_of
from ...trim.finish import finish
from ...util.errors import VolfrepError, listed
from ...util.numbers import place_text, plural
from ...util.progress import Monitor, ProgressCallback
from ...util.types import Floats, Ints
from ..part_depth import PartDepth, Preview
from ..part_domain import PartDomain
from ..target_search import REACH, WantedVolume
from .kind import BlockLattice, LatticeKind, RadiiBorne
from .surface_lattice import SurfaceLattice, uncut

#: Struts of a random network are drawn together where they are shorter than so many radii.
SHORTEST = 4.0
#: The coarsest step of single precision at a network's farthest node, in radii of its thinnest
#: strut.
FINEST_STEP = 1.0 / 50.0
#: The thinnest and the thickest radius that is looked for, in units of the median length.
THINNEST, THICKEST = 2e-3, 0.35
#: Struts are sized to so many times their radius at most, where nothing else is said: those that
#: share no joint run into each other then.
TIMES_THICKER = 2.0
#: How often a random network is drawn anew because the struts that are too short for its radius
#: have changed.
DRAWN = 3

#: Points of a network's room and the volume that each stands for, mm and mm3.
Sampler = Callable[[Wireframe], tuple[Floats, Floats]]
#: Points for the table of a target, as a power of 2.
POINTS = FINE - 2


class GraphKind(LatticeKind):
    """Nodes and struts in place of octants."""

    def fill(self, part: PartDomain) -> GraphLattice:
        """The struts in a part."""
        return GraphLattice(part)

    def block(self, count: Sequence[int]) -> GraphBlock:
        """A block of cells that are no cubes, or whose struts differ."""
        if not isinstance(self.spec.network, StretchedCells):
            raise VolfrepError(
                "A block is of cells and not of a network: choose 'network' or 'fill'."
            )
        return GraphBlock(self, count)

    def preview(self, solid: TriangleMesh, depth: PartDepth) -> Preview:
        """The struts; random ones lie between the very points of the part."""
        from ..preview import place_lattice, show_struts

        spec = self.spec
        placement = place_lattice(solid, spec, depth.monitor)

        def domain_of() -> TriangleMesh:
            return depth.domain(spec.skin)

        if spec.target is not None:
            domain, points = depth.volume_below(spec.shell), depth.points_below(spec.shell)
            skin = spec.skin_volume(solid.volume, domain)
            wanted = spec.target.lattice_volume(spec.density, domain, skin)
            weights = np.full(len(points), domain / max(len(points), 1))
            spec = with_radius(
                spec, placement, domain_of, lambda _: (points, weights), wanted, skin,
                depth.monitor,
            )  # fmt: skip
        frame = graph_struts(spec, placement, domain_of, depth.monitor)

        def volume(bare: float, domain: float, skin: float) -> tuple[LatticeSpec, float]:
            return spec, graph_volume(frame, spec, depth.points_below(spec.shell), domain)

        none = "No strut of the network lies inside the skin: reduce the skin thickness."
        return show_struts(solid, spec, depth, frame, volume, none)

    def with_fixed_struts(self) -> LatticeSpec:
        """Struts of a random network are drawn together as they are with the present radius."""
        spec, network = self.spec, self.spec.network
        if not isinstance(network, RandomGraph) or network.shortest:
            return spec
        shortest = SHORTEST * spec.struts.extremes[1]
        return replace(spec, network=replace(network, shortest=shortest))

    def modulus(self, target: Target) -> float:
        """None: the endless lattice of a graph is not known.

        Raises:
            VolfrepError: always.
        """
        raise _not_stiff(target)

    def stiffened(self, target: Target) -> LatticeSpec:
        """None: the endless lattice of a graph is not known.

        Raises:
            VolfrepError: always.
        """
        raise _not_stiff(target)


def _not_stiff(target: Target) -> VolfrepError:
    return VolfrepError(
        f"A network repeats nowhere, and so has no {target.called} of its own: give the strut "
        "radius."
    )


class GraphLattice(SurfaceLattice):
    """The nodes and struts of a graph in a part."""

    @cached_property
    def struts(self) -> Wireframe:
        """The nodes and struts, whole, where their mesh has them."""
        part = self.part
        with self.monitor.stage("network", 0.3, 0.4):
            return graph_struts(self.spec, part.placement, lambda: part.domain.mesh, self.monitor)

    @cached_property
    def made(self) -> GraphSurface:
        """Their surface, and which of them overlap."""
        frame = self.struts
        with self.monitor.stage("lattice", 0.4, 0.6):
            return mesh_graph(frame, self.spec, self.monitor)

    @property
    def surface(self) -> TriangleMesh:
        """Their surface, nothing cut."""
        return self.made.mesh

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence on struts that overlap, as soon as they are meshed."""
        return overlap_warnings(self.made, self.struts) if "made" in self.__dict__ else ()

    @property
    def spacing(self) -> float:
        """The median length of struts, mm."""
        return median_length(self.struts)

    @property
    def smallest(self) -> float:
        """Volume below which a shell is no piece of it, mm3."""
        return smallest_piece(self.struts)

    @property
    def is_deformed(self) -> bool:
        """Whether radii vary, or the graph is bent."""
        return not keeps_places(self.spec.struts, self.part.placement)

    @property
    def skin_edge(self) -> float:
        """Edge of the triangles by which the skin about it is solved, mm."""
        return self.spacing

    def radii_borne(self, own: float) -> RadiiBorne:
        """As thick as leaves struts room; where they have none, they are united."""
        most = max(THICKEST * self.spacing, own)
        return RadiiBorne(min(most, TIMES_THICKER * own), most, own)

    def search(self, target: Target) -> GraphSearch:
        """The radius for which the struts have the density or the mass of a target."""
        spec, part, monitor = self.spec, self.part, self.monitor
        domain = part.domain.mesh
        wanted = WantedVolume(target, spec.density, domain.volume, part.skin_volume)

        def sampler(frame: Wireframe) -> tuple[Floats, Floats]:
            if spec.is_cut:
                return points_inside(domain, POINTS, monitor)
            return points_about(frame, REACH * THICKEST * median_length(frame), POINTS)

        with monitor.stage("target", 0.3, 0.4):
            fixed = with_radius(
                spec, part.placement, lambda: domain, sampler, wanted.lattice, wanted.skin, monitor
            )
            frame = graph_struts(fixed, part.placement, lambda: domain, monitor)
            return GraphSearch(fixed, wanted, volumes(frame, fixed, sampler))


class GraphBlock(BlockLattice):
    """A block of cells that are no cubes, or whose struts differ."""

    @property
    def volume(self) -> float:
        """Volume of its cells, mm3."""
        edges = self.spec.cell_size * np.array(self.spec.unit_cell().edges)
        return float(np.prod(edges * self.count))

    def result(self, monitor: Monitor) -> Result:
        """It as a mesh."""
        corner = np.array(self.spec.origin or (0.0, 0.0, 0.0), float)
        cells = block_of_cells(self.spec, self.count, corner)
        return mesh_graph_alone(replace(self.spec, network=cells), monitor=monitor)

    def wireframe(self) -> Wireframe:
        """Its nodes and struts."""
        corner = np.array(self.spec.origin or (0.0, 0.0, 0.0), float)
        cells = block_of_cells(self.spec, self.count, corner)
        return frame_alone(replace(self.spec, network=cells))[0]

    def search(self, target: Target) -> GraphSearch:
        """None.

        Raises:
            VolfrepError: always.
        """
        raise VolfrepError(
            f"A block of '{self.spec.unit_cell().name}', whose cells are no cubes or whose struts "
            f"differ, takes no target of {target.called}: give the strut radius."
        )


@dataclass(frozen=True, eq=False)
class GraphSearch:
    """Radii of volumes of a graph that stays the same."""

    spec: LatticeSpec
    wanted: WantedVolume
    table: VolumeByRadius

    def specification(self, volume: float) -> LatticeSpec:
        """With the radius of a volume of the struts, mm3."""
        # The first radius is the one that the struts were found for.
        if volume == self.wanted.lattice:
            return self.spec
        return replace(self.spec, strut_radius=self.table.radius_of(volume))


def smallest_piece(frame: Wireframe) -> float:
    """Volume below which a shell is no piece of a graph, mm3."""
    return float((0.2 * np.median(frame.radii)) ** 3)


def graph_struts(
    spec: LatticeSpec,
    placement: Placement,
    domain_of: Callable[[], TriangleMesh],
    monitor: Monitor,
) -> Wireframe:
    """A network's nodes and struts, whole, where its mesh has them.

    Args:
        spec: with a network.
        placement: where it lies in the part.
        domain_of: gives what is filled; asked where the network depends on it.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: nothing is left of it.
    """
    wanted = spec.network
    if isinstance(wanted, RandomGraph):
        domain = domain_of()
        depth = partial(depth_below, domain, monitor)
        shortest = SHORTEST * spec.struts.extremes[1]
        nodes, struts = random_graph(wanted, domain, spec.cell_size, shortest, depth, monitor)
        return graph_wireframe(nodes, None, struts, spec, placement)
    mapping = placement.mapping
    if isinstance(wanted, StretchedCells):
        bounds = domain_of().bounds
        if mapping is not None:
            bounds = mapped_box(mapping.to_lattice, bounds)
        wanted = cells_about(bounds, spec)
        nodes = wanted.nodes
    else:
        assert wanted is not None
        nodes = shift_nodes(wanted, spec)
    if mapping is not None:
        nodes = mapping.to_part(nodes)
    return graph_wireframe(nodes, wanted, wanted.struts, spec, placement)


def median_length(frame: Wireframe) -> float:
    """The median length of struts, which stands for L in their joints, mm."""
    span = frame.nodes[frame.struts[:, 1]] - frame.nodes[frame.struts[:, 0]]
    return float(np.median(np.linalg.norm(span, axis=1)))


def graph_volume(frame: Wireframe, spec: LatticeSpec, points: Floats, domain: float) -> float:
    """About the volume of a network's struts and joints in a domain, mm3.

    Args:
        frame: whole struts.
        spec: whose radius they have.
        points: (n, 3) spread evenly over the domain.
        domain: its volume, mm3.
    """
    radius, median = spec.template_radius, median_length(frame)
    weights = np.full(len(points), domain / max(len(points), 1))
    return volume_by_radius(frame, radius, median, points, weights, radius).at(radius)


def graph_wireframe(
    nodes: Floats,
    network: GivenGraph | None,
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
        if network is not None and len(network.widths):
            radii = radii * network.widths[:, None]
    thickest = np.zeros(len(nodes))
    np.maximum.at(thickest, rows, radii)
    length = np.linalg.norm(nodes[rows[:, 1]] - nodes[rows[:, 0]], axis=1)
    joints = joint_radius(thickest, float(np.median(length)))
    return Wireframe(placement.nudged(nodes), rows, np.array(radii), joints)


def shift_nodes(network: GivenGraph, spec: LatticeSpec) -> Floats:
    """(n, 3) the nodes of a given network, its own origin at the specification's, mm."""
    return network.nodes if spec.origin is None else network.nodes + np.array(spec.origin)


def cells_about(bounds: Floats, spec: LatticeSpec) -> GivenGraph:
    """Cells of any box side by side, as many as cover the bounds of a domain in lattice space.

    The first one's corner lies at the specification's origin, or where the bounds begin.
    """
    size = spec.cell_size * np.array(spec.unit_cell().edges)
    start = bounds[0] if spec.origin is None else np.array(spec.origin)
    first = np.floor((bounds[0] - start) / size + 1e-6)
    last = np.ceil((bounds[1] - start) / size - 1e-6)
    counts = [int(n) for n in last - first]
    return block_of_cells(spec, (counts[0], counts[1], counts[2]), start + first * size)


def block_of_cells(spec: LatticeSpec, counts: tuple[int, int, int], corner: Floats) -> GivenGraph:
    """So many cells of any box along x, y, z from a corner on, mm."""
    cell = spec.unit_cell()
    whole = spec.cell_size * np.array(cell.edges) * counts
    return place_cells_along(cell, lambda q: corner + q * whole, counts, f"cells '{cell.name}'")


def mesh_graph(frame: Wireframe, spec: LatticeSpec, monitor: Monitor) -> GraphSurface:
    """The surface of a network at the specification's resolution or deviation."""
    return graph_surface(frame, sides_at(spec, float(np.median(frame.radii))), monitor)


def sides_at(spec: LatticeSpec, radius: float) -> int:
    """How many corners round a strut of a radius, mm, a specification asks for."""
    relative = DEFAULT_RELATIVE_DEVIATION
    if spec.deviation is not None:
        relative = spec.deviation / radius
    elif spec.resolution is not None:
        relative = (spec.cell_size / spec.resolution / radius) ** 2 / 16.0
    return sides_for(relative)


def overlap_warnings(made: GraphSurface, frame: Wireframe) -> tuple[str, ...]:
    """A sentence on struts that overlap others; none where none do."""
    if not made.united:
        return ()
    count = len(frame.struts)
    parts = []
    if len(made.crowded):
        place = frame.nodes[frame.struts[made.crowded[0]]].mean(axis=0)
        parts.append(
            f"{plural(len(made.crowded), 'strut')} too short or too narrow at a joint, as at "
            f"{place_text(place)}"
        )
    if len(made.overlapping):
        one = made.overlapping[0, 0]
        own = frame.struts[one] if one < count else [one - count]
        place = frame.nodes[own].mean(axis=0)
        parts.append(
            f"{plural(len(made.overlapping), 'pair')} of struts that run into each other, as at "
            f"{place_text(place)}"
        )
    return (f"United as they overlap: {listed(parts, 'and')}; thinner struts would not.",)


def frame_alone(spec: LatticeSpec) -> tuple[Wireframe, Placement]:
    """The nodes and struts of a given network as it is in free space, and where that is.

    Raises:
        VolfrepError: the specification has no given network, or something that needs a part.
    """
    wanted = spec.network
    if not isinstance(wanted, GivenGraph):
        raise VolfrepError("A network in free space is one of a file: give its nodes and struts.")
    if spec.target is not None:
        raise VolfrepError(
            f"A target of {spec.target.called} is for a network in a part: give the strut radius."
        )

    def depth(_: Floats) -> Floats:
        raise VolfrepError(
            "A network in free space has no skin to grade the radius by: grade it along a "
            "direction or by a field."
        )

    first = shift_nodes(wanted, spec)
    _refuse_too_far(first, wanted.radii if len(wanted.radii) else np.array(spec.strut_radius))
    mapping = part_map(spec.grid, np.stack([first.min(axis=0), first.max(axis=0)]))
    nodes = first if mapping is None else mapping.to_part(first)
    bounds = np.stack([nodes.min(axis=0), nodes.max(axis=0)])
    placement = Placement(spec.cell_size, mapping, bounds, depth)
    return graph_wireframe(nodes, wanted, wanted.struts, spec, placement), placement


def _refuse_too_far(nodes: Floats, radii: Floats) -> None:
    """Refuse nodes so far from the origin that files of single precision have no room for struts.

    Raises:
        VolfrepError: naming how far.
    """
    farthest, thinnest = float(np.abs(nodes).max()), float(np.min(radii))
    with np.errstate(over="ignore", invalid="ignore"):
        step = float(np.spacing(np.float32(farthest)))
    if not step <= FINEST_STEP * thinnest:
        held = f"holds steps of {step:.2g} mm" if np.isfinite(step) else "holds no number"
        raise VolfrepError(
            f"The network lies {farthest:.4g} mm from the origin, where the single precision of "
            f"files {held} and struts of {thinnest:.4g} mm radius would lose their shape: move it "
            "nearer to the origin."
        )


def mesh_graph_alone(
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    monitor: Monitor | None = None,
) -> Result:
    """A given network as it is, in free space.

    Raises:
        VolfrepError: the specification has no given network, or it cannot be meshed.
        Cancelled: the callback said so.
    """
    monitor = monitor or Monitor(progress)
    frame, placement = frame_alone(spec)
    with monitor.stage("lattice", 0.0, 0.8):
        made = mesh_graph(frame, spec, monitor)
    cleared = uncut(made.mesh, smallest_piece(frame), monitor)
    surface, quality, notes = finish(cleared.surface, cleared.quality, monitor, deformed=False)
    hull = made.mesh.bounds
    report = report_of(
        quality, frame, None, None, placement, spec, monitor,
        domain_volume=float(np.prod(hull[1] - hull[0])),
        warnings=overlap_warnings(made, frame) + notes,
    )  # fmt: skip
    return Result(surface, frame, report)


def with_radius(
    spec: LatticeSpec,
    placement: Placement,
    domain_of: Callable[[], TriangleMesh],
    sampler: Sampler,
    wanted: float,
    skin: float,
    monitor: Monitor,
) -> LatticeSpec:
    """The specification with the radius for which a network has a volume.

    Of a random network the shortest strut is then fixed too, four of those radii, so that it
    stays the same graph.

    Args:
        spec: with a network and a target.
        placement: where it lies in the part.
        domain_of: gives what is filled.
        sampler: gives points of that, or of all about the network where nothing cuts it.
        wanted: the network's volume, mm3.
        skin: of the part, mm3; named where no radius meets the target.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: no radius gives that volume.
    """
    network = spec.network
    follows = isinstance(network, RandomGraph) and not network.shortest
    for _ in range(DRAWN if follows else 1):
        if isinstance(network, RandomGraph) and follows:
            shortest = SHORTEST * spec.strut_radius
            spec = replace(spec, network=replace(network, shortest=shortest))
        frame = graph_struts(spec, placement, domain_of, monitor)
        table, median = volumes(frame, spec, sampler), median_length(frame)
        low, high = (share * median for share in (THINNEST, THICKEST))
        least, most = table.at(low), table.at(high)
        if not least <= wanted <= most:
            beside = f" beside the skin's {skin:.4g}" if skin else ""
            raise VolfrepError(
                f"No strut radius meets the target: the network would have to have {wanted:.4g} "
                f"mm3, and its struts, {median:.3g} mm long in the median, can have about "
                f"{least:.3g} to {most:.3g} mm3{beside}."
            )
        spec = replace(spec, strut_radius=float(np.clip(table.radius_of(wanted), low, high)))
    return spec


def volumes(frame: Wireframe, spec: LatticeSpec, sampler: Sampler) -> VolumeByRadius:
    """A network's volumes over the radius of its struts; arguments as of `with_radius`."""
    points, weights = sampler(frame)
    median = median_length(frame)
    return volume_by_radius(frame, spec.strut_radius, median, points, weights, THICKEST * median)
