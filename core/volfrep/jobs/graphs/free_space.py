# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks as they are, in free space: their wireframe, their surface, and what is made of it."""

from __future__ import annotations

import numpy as np

from ...design.cells import joint_radius
from ...design.graphs import GivenGraph, place_cells_along
from ...design.spec import LatticeSpec
from ...design.spec_parts import DEFAULT_RELATIVE_DEVIATION
from ...graphs.surface import GraphSurface, graph_surface, sides_for
from ...grid.cell_grid import CellGrid
from ...grid.placement import Placement, node_radii, part_map
from ...grid.strut_graph import Wireframe
from ...mesh.edge_table import plural
from ...mesh.float32_repair import shortest_edge
from ...reports.result import Result, report_of
from ...trim.finish import finish, tidy
from ...trim.loose_pieces import Cleared, clear
from ...trim.trimmed_surface import TrimmedSurface
from ...util.errors import VolfrepError
from ...util.progress import Monitor, ProgressCallback
from ...util.types import Floats, Ints

#: The coarsest step of single precision at a network's farthest node, in radii of its thinnest
#: strut.
FINEST_STEP = 1.0 / 50.0


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
    return cells_beside(spec, (counts[0], counts[1], counts[2]), start + first * size)


def cells_beside(spec: LatticeSpec, counts: tuple[int, int, int], corner: Floats) -> GivenGraph:
    """So many cells of any box along x, y, z from a corner on, mm."""
    cell = spec.unit_cell()
    whole = spec.cell_size * np.array(cell.edges) * counts
    return place_cells_along(cell, lambda q: corner + q * whole, counts, f"cells '{cell.name}'")


def mesh_graph(frame: Wireframe, spec: LatticeSpec, monitor: Monitor) -> GraphSurface:
    """The surface of a network at the specification's resolution or deviation."""
    radius = float(np.median(frame.radii))
    relative = DEFAULT_RELATIVE_DEVIATION
    if spec.deviation is not None:
        relative = spec.deviation / radius
    elif spec.resolution is not None:
        relative = (spec.cell_size / spec.resolution / radius) ** 2 / 16.0
    return graph_surface(frame, sides_for(relative), monitor)


def overlap_warnings(made: GraphSurface, frame: Wireframe) -> tuple[str, ...]:
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


def uncut(made: GraphSurface, smallest: float, monitor: Monitor) -> Cleared:
    """A network that nothing cuts, without slivers, and its quality."""
    surface = tidy(TrimmedSurface(made.mesh), shortest_edge(made.mesh), monitor)
    return clear(surface, smallest, monitor)


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


def mesh_graph_alone(spec: LatticeSpec, *, progress: ProgressCallback | None = None) -> Result:
    """A given network as it is, in free space.

    Raises:
        VolfrepError: the specification has no given network, or it cannot be meshed.
        Cancelled: the callback said so.
    """
    monitor = Monitor(progress)
    frame, placement = frame_alone(spec)
    with monitor.stage("lattice", 0.0, 0.8):
        made = mesh_graph(frame, spec, monitor)
    smallest = float((0.2 * np.median(frame.radii)) ** 3)
    cleared = uncut(made, smallest, monitor)
    surface, quality, notes = finish(cleared.surface, cleared.quality, monitor, moved=False)
    hull = made.mesh.bounds
    none = CellGrid(np.zeros(3), spec.cell_size, (0, 0, 0))
    report = report_of(
        quality, frame, none, np.zeros((0, 0, 0), bool), placement, spec, monitor,
        domain_volume=float(np.prod(hull[1] - hull[0])),
        warnings=overlap_warnings(made, frame) + notes,
    )  # fmt: skip
    return Result(surface, frame, report)
