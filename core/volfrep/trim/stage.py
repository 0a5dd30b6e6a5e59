# SPDX-License-Identifier: LGPL-2.1-or-later
"""The trimming stage: octants culled, assembled, cut at the wall, cleared of loose pieces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell
from ..design.memory_guard import cells_are_full
from ..design.openings import DrainHoles
from ..design.spec_parts import Skin
from ..grid.strut_graph import Wireframe
from ..lattice.assembly import Layout, facets
from ..lattice.deform import Deformed
from ..lattice.strut_masks import without_struts
from ..mesh.booleans import difference, intersection
from ..mesh.float32_repair import shortest_edge
from ..mesh.quality import combined, inspect, measure
from ..mesh.triangle_mesh import TriangleMesh, compact, concatenate
from ..octants.octant import OctantGrid, OctantKey, used_kinds
from ..octants.octant_mesh import Octant, OctantSpec
from ..shell.domain import Domain
from ..spatial.proximity import closest_points
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Floats
from .boolean_trim import KeptOctants, OctantRoles, cull, keep_all, trim
from .drains import Drained, drain
from .finish import tidied
from .loose_pieces import Cleared, clear, smallest_shell
from .prune import Pruned

#: Octants on moved struts mostly reach no farther out of their places than this, in units of
#: their edges. Where they do, they are looked for so many times as far as the last ones reached.
FIRST_MARGIN = 0.05
SPARE_MARGIN = 1.05
#: How often they are looked for farther out. From the second time on it is at least twice as far,
#: so that the last time is more than the `SUPPORT` of three cells about an octant: a vertex hangs
#: on the struts of its own cell, and none reaches there.
MOST_WIDENINGS = 9
#: Less of a domain than this is no lattice.
NO_LATTICE = 1e-6


@dataclass(frozen=True, eq=False)
class Laid:
    """Octants laid where their struts are.

    Attributes:
        kept: which octants there are.
        layout: the same, numbered.
        points: (n, 3) where their vertices are, mm.
    """

    kept: KeptOctants
    layout: Layout
    points: Floats


def chosen_octants(
    grid: OctantGrid,
    roles: OctantRoles | None,
    cell: UnitCell,
    pruned: Pruned | None,
    octant_spec: OctantSpec,
    *,
    joined: bool,
) -> KeptOctants:
    """The octants that are assembled: without those outside, and without pruned struts.

    Args:
        grid: of all the octants of the lattice.
        roles: where they lie with respect to the wall; None where nothing cuts the lattice.
        cell: the unit cell.
        pruned: what is left when struts are taken away; None where none is.
        octant_spec: what the octants are meshed for.
        joined: whether their vertices are moved with the struts, so that none may hang on one
            that is gone.
    """
    kept = keep_all(grid) if roles is None else cull(grid, roles)
    if pruned is None:
        return kept
    fewer = without_struts(
        kept.grid, cell, pruned.graph, pruned.left.kept, octant_spec.influence, joined=joined
    )
    return replace(kept, grid=used_kinds(fewer))


def lay(
    first: tuple[KeptOctants, dict[OctantKey, Octant]],
    margin: float,
    within: Callable[[float], tuple[KeptOctants, dict[OctantKey, Octant]]],
    place: Callable[[Layout], Deformed],
) -> Laid:
    """The octants laid where the struts are; with more of them, where struts reach far out.

    Args:
        first: the octants within the margin, and their meshes.
        margin: how far out of their places octants may reach, in units of their edges.
        within: gives the octants within a wider one.
        place: gives where the vertices of numbered octants are.

    Raises:
        VolfrepError: octants reach out farther than `MOST_WIDENINGS` find.
    """
    kept, octants = first
    for widening in range(MOST_WIDENINGS + 1):
        layout = kept.lay_out(octants)
        placed = place(layout)
        if placed.excess <= margin + 1e-9:
            return Laid(kept, layout, placed.vertices)
        if widening < MOST_WIDENINGS:
            margin = max(SPARE_MARGIN * placed.excess, 2.0 * margin if widening else 0.0)
            kept, octants = within(margin)
    raise VolfrepError(
        f"Struts reach {placed.excess / 2.0:.1f} cells out of their places: grade the cells or "
        "their radii less steeply."
    )


def cut_lattice(
    laid: Laid,
    solid: TriangleMesh,
    domain: Domain,
    octant_spec: OctantSpec,
    monitor: Monitor,
    *,
    has_skin: bool,
    with_skin: bool,
    keep_pieces: bool = False,
) -> Cleared:
    """The part or the lattice, without loose pieces and slivers, and its quality.

    Args:
        laid: the octants.
        solid: the part, mm.
        domain: what the lattice fills; its wall cuts it.
        octant_spec: what the octants were meshed for.
        monitor: for progress and cancel.
        has_skin: whether a skin lies about the domain, which holds the lattice.
        with_skin: whether the lattice is joined to it.
        keep_pieces: pieces that hang on nothing stay.

    Raises:
        VolfrepError: nothing is left, or nothing would hold it.
    """
    wall = domain.wall
    trimmed = trim(wall, laid.kept, laid.layout, laid.points, cavity=with_skin, monitor=monitor)
    mesh, cut, removed, lost = trimmed.mesh, trimmed.cut, 0, 0.0
    smallest, precision = smallest_shell(octant_spec), shortest_edge(solid)
    if has_skin and not (with_skin or keep_pieces):
        on_wall = np.flatnonzero(trimmed.on_wall)
        held = clear(mesh, inspect(mesh, monitor), smallest, keep=on_wall)
        mesh, cut = held.mesh, len(held.mesh.triangles)
        removed, lost = held.pieces_removed, held.volume_removed
        if removed and not len(mesh.triangles):
            raise _nothing_holds()
    mesh = tidied(mesh, precision, monitor, cut)
    found = inspect(mesh, monitor)
    bodies = 0
    if not (has_skin or keep_pieces):
        bodies = max(1, inspect(solid).quality.bodies)
    cleared = clear(mesh, found, smallest, floating=with_skin and not keep_pieces, bodies=bodies)
    if not len(cleared.mesh.triangles):
        if with_skin:
            raise cells_are_full(octant_spec.cell_size, octant_spec.strut_radius)
        raise VolfrepError(
            "No strut lies inside the part: reduce the cell size or move the origin."
        )
    if with_skin and cleared.mesh is not mesh:
        # The cavity's surface counts as negative: what is left may be its wall only.
        cavity = wall.volume
        if cavity + cleared.quality.volume < NO_LATTICE * cavity:
            raise _nothing_holds()
    cleared = replace(
        cleared,
        pieces_removed=cleared.pieces_removed + removed,
        volume_removed=cleared.volume_removed + lost,
    )
    if domain.openings is not None:
        return _opened(
            cleared, solid, domain, domain.openings, smallest, with_skin, keep_pieces, monitor
        )
    if not with_skin:
        return cleared
    whole = concatenate(solid, cleared.mesh)
    return replace(cleared, mesh=whole, quality=combined(measure(solid), cleared.quality))


def drained_part(
    cleared: Cleared,
    solid: TriangleMesh,
    domain: Domain,
    frame: Wireframe,
    skin: Skin,
    drains: DrainHoles,
    monitor: Monitor,
) -> tuple[Cleared, Drained]:
    """A part with drain holes through its skin, and these.

    Raises:
        VolfrepError: a hole cannot be where it is wanted.
    """
    drained = drain(cleared.mesh, solid, domain.mesh, frame, skin.thickness, drains, monitor)
    precision = shortest_edge(solid)
    clean = tidied(drained.mesh, precision, monitor)
    cleared = replace(cleared, mesh=clean, quality=measure(clean, monitor))
    return cleared, replace(drained, mesh=clean)


def _opened(
    cleared: Cleared,
    solid: TriangleMesh,
    domain: Domain,
    openings: TriangleMesh,
    smallest: float,
    with_skin: bool,
    keep_pieces: bool,
    monitor: Monitor,
) -> Cleared:
    """The part, or its lattice, cut at its open faces, beyond which the cavity reaches."""
    mesh = cleared.mesh
    precision = shortest_edge(solid)
    if with_skin:
        void = mesh.reversed()
        mesh = monitor.call(lambda: difference(solid, void))
    else:
        lattice = mesh
        mesh = monitor.call(lambda: intersection(lattice, solid))
    mesh = tidied(mesh, precision, monitor)
    found = inspect(mesh, monitor)
    if keep_pieces:
        rest = clear(mesh, found, smallest)
    elif with_skin:
        rest = clear(mesh, found, smallest, bodies=inspect(solid).quality.bodies)
    else:
        rest = clear(mesh, found, smallest, keep=_on_skin(mesh, domain, openings, precision))
    if not len(rest.mesh.triangles):
        raise _nothing_holds()
    return replace(
        rest,
        pieces_removed=cleared.pieces_removed + rest.pieces_removed,
        volume_removed=cleared.volume_removed + rest.volume_removed,
        specks_removed=cleared.specks_removed + rest.specks_removed,
    )


def _on_skin(
    mesh: TriangleMesh, domain: Domain, openings: TriangleMesh, precision: float
) -> NDArray[np.int64]:
    """The triangles of a lattice that lie on the wall, and not in an open face."""
    middle = mesh.vertices[mesh.triangles].mean(axis=1)
    near = np.flatnonzero(closest_points(domain.mesh, middle)[1] < precision)
    beyond = closest_points(openings, middle[near])[1] > precision
    return near[beyond]


def uncut_lattice(
    laid: Laid,
    solid: TriangleMesh,
    octant_spec: OctantSpec,
    monitor: Monitor,
    *,
    keep_pieces: bool = False,
) -> Cleared:
    """The lattice of whole cells as it is, without loose pieces, and its quality."""
    whole = compact(TriangleMesh(laid.points, facets(laid.layout, monitor)))
    mesh = tidied(whole, shortest_edge(whole), monitor)
    found = inspect(mesh, monitor)
    bodies = 0 if keep_pieces else max(1, inspect(solid).quality.bodies)
    return clear(mesh, found, smallest_shell(octant_spec), bodies=bodies)


def _nothing_holds() -> VolfrepError:
    return VolfrepError(
        "No strut reaches the skin, so that nothing would hold the lattice: reduce the cell size "
        "or choose the activation 'touching'."
    )
