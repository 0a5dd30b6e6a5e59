# SPDX-License-Identifier: LGPL-2.1-or-later
"""The trimming stage: octants culled, assembled, cut at the wall, cleared of loose pieces.

Octants on moved struts reach out of their places. They are looked for within a margin that at least
doubles from round to round, so that the search ends; what reaches farther than a joint's known
surroundings is refused.
"""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import replace
from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell
from ..design.memory_guard import cells_are_full
from ..design.openings import DrainHoles
from ..design.spec_parts import Skin
from ..grid.strut_graph import Wireframe
from ..lattice.certificate import keeps_corners
from ..lattice.strut_masks import without_struts
from ..mesh.booleans import as_manifold
from ..mesh.float32_repair import BLOCK_TRIANGLES, CALL_ROWS, edge_within, shortest_edge
from ..mesh.quality import combine, inspect
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.octant import OctantGrid, used_kinds
from ..octants.octant_spec import OctantSpec
from ..shell.domain import Domain
from ..spatial.proximity import closest_points
from ..util.errors import VolfrepError
from ..util.parallel import LocalArray, SharedArray
from ..util.progress import Monitor, release_memory
from ..util.types import Bools, Floats
from .boolean_trim import Ahead, Trimmed, cut_again, trim
from .culling import KeptOctants, OctantRoles, cull, keep_all
from .drains import Drained, drain
from .finish import mend, tidy
from .loose_pieces import Cleared, clear, smallest_shell
from .placed_lattice import PlacedLattice
from .prune import Pruned
from .trimmed_surface import TrimmedSurface

Corners = NDArray[np.int32]

#: Less of a domain than this is no lattice.
NO_LATTICE = 1e-6


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


def cut_lattice(
    lattice: PlacedLattice,
    solid: TriangleMesh,
    domain: Domain,
    octant_spec: OctantSpec,
    monitor: Monitor,
    *,
    has_skin: bool,
    with_skin: bool,
    executor: Executor | None = None,
    keep_pieces: bool = False,
    ahead: Ahead | None = None,
) -> Cleared:
    """The part or the lattice, without loose pieces and slivers, and its quality.

    Args:
        lattice: the octants.
        solid: the part, mm.
        domain: what the lattice fills; its wall cuts it.
        octant_spec: what the octants were meshed for.
        monitor: for progress and cancel.
        has_skin: whether a skin lies about the domain, which holds the lattice.
        with_skin: whether the lattice is joined to it.
        executor: of the groups of octants that the wall cuts; None: this process.
        keep_pieces: pieces that hang on nothing stay.
        ahead: as of `trim`.

    Raises:
        VolfrepError: nothing is left, or nothing would hold it.
    """

    def cut() -> Trimmed:
        found = trim(
            domain.boundary, lattice, cavity=with_skin, monitor=monitor, executor=executor,
            precision=shortest_edge(solid), ahead=ahead,
        )  # fmt: skip
        unproved = _to_look_at(lattice, domain.boundary)
        if not unproved.any():
            return found
        surface = found.surface.with_octants(unproved, monitor)
        more = len(surface.mesh.triangles) - len(found.on_boundary)
        return Trimmed(surface, np.pad(found.on_boundary, (0, more)))

    full = cells_are_full(octant_spec.cell_size, octant_spec.strut_radius)
    return cleared_cut(
        cut(), solid, domain, smallest_shell(octant_spec), full, monitor,
        has_skin=has_skin, with_skin=with_skin, keep_pieces=keep_pieces,
    )  # fmt: skip


def cleared_cut(
    trimmed: Trimmed,
    solid: TriangleMesh,
    domain: Domain,
    smallest: float,
    full: VolfrepError,
    monitor: Monitor,
    *,
    has_skin: bool,
    with_skin: bool,
    keep_pieces: bool = False,
) -> Cleared:
    """A part or lattice that was cut, without loose pieces and slivers, and its quality.

    Args:
        trimmed: the cavity's surface, or the lattice.
        solid: the part, mm.
        domain: what the lattice fills.
        smallest: volume of the smallest shell that is meant, mm3.
        full: what to raise where the lattice leaves no room.
        monitor: for progress and cancel.
        has_skin: whether a skin lies about the domain, which holds the lattice.
        with_skin: whether the lattice is joined to it.
        keep_pieces: pieces that hang on nothing stay.

    Raises:
        VolfrepError: nothing is left, or nothing would hold it.
    """
    boundary, precision = domain.boundary, shortest_edge(solid)
    surface, removed, lost = trimmed.surface, 0, 0.0
    if has_skin and not (with_skin or keep_pieces):
        on_boundary = np.flatnonzero(trimmed.on_boundary)
        attached = clear(surface, smallest, monitor, keep=on_boundary)
        surface = attached.surface
        removed, lost = attached.pieces_removed, attached.volume_removed
        if removed and not surface.triangles:
            raise _nothing_holds()
    del trimmed  # nobody else has it: the mesh before slivers go, in the way of that after
    release_memory()
    mended = mend(surface, precision, monitor)
    del surface  # as above
    bodies = 0
    if not (has_skin or keep_pieces):
        bodies = max(1, inspect(solid).quality.bodies)
    floating = with_skin and not keep_pieces
    cleared = clear(mended, smallest, monitor, floating=floating, bodies=bodies)
    if not cleared.surface.triangles:
        if with_skin:
            raise full
        raise VolfrepError(
            "No strut lies inside the part: reduce the cell size or move the origin."
        )
    is_less = cleared.pieces_removed + cleared.specks_removed > 0
    del mended  # as above
    release_memory()
    if with_skin and is_less:
        # The cavity's surface counts as negative: what is left may be its wall only.
        cavity = boundary.volume
        if cavity + cleared.quality.volume < NO_LATTICE * cavity:
            raise _nothing_holds()
    cleared = replace(
        cleared,
        pieces_removed=cleared.pieces_removed + removed,
        volume_removed=cleared.volume_removed + lost,
    )
    if domain.openings is not None:
        return _open_faces(
            cleared, solid, domain, domain.openings, smallest, with_skin, keep_pieces, monitor
        )
    if not with_skin:
        return cleared
    cut = cleared.surface
    outside = len(solid.triangles)
    looks = cut.looks and cut.looks.padded(outside, 0)
    whole = _one_after_the_other(solid, cut.mesh, monitor)
    both = cut.on(whole, looks, partial(np.add, len(solid.vertices)))
    skin = inspect(solid, monitor)
    return replace(
        cleared,
        surface=both,
        quality=combine(skin.quality, cleared.quality),
        least=min(cleared.least, float(np.abs(skin.volume).min(initial=np.inf))),
    )


def _one_after_the_other(
    first: TriangleMesh, second: TriangleMesh, monitor: Monitor
) -> TriangleMesh:
    """As `concatenate`, the second one mostly by far the larger, for calls of others."""
    backend, shift = monitor.backend, np.int32(len(first.vertices))
    size = CALL_ROWS if backend.uses_processes else BLOCK_TRIANGLES

    def made(before: Floats | Corners, after: SharedArray, count: int, more: np.int32) -> Any:
        starts = range(0, count, size)
        calls = ((min(size, count - k), (after, k, size, more)) for k in starts)
        ahead = [(len(before), (LocalArray(before), 0, len(before), np.int32(0)))]
        shape = (len(before) + count, 3)
        return backend.made(_more_by, chain(ahead, calls), shape, before.dtype.type)

    with backend.sharing(second.vertices, second.triangles) as (points, corners):
        vertices = made(first.vertices, points, len(second.vertices), np.int32(0))
        triangles = made(first.triangles, corners, len(second.triangles), shift)
    return TriangleMesh(vertices, triangles)


def _more_by(
    rows: SharedArray, start: int, size: int, shift: np.int32
) -> NDArray[np.float64] | Corners:
    """Some of the rows, so much more; the very same for 0."""
    some = rows.array[start : start + size]
    return some + shift if shift else some


def _to_look_at(lattice: PlacedLattice, boundary: TriangleMesh) -> Bools:
    """(nx, ny, nz) bool, octants inside that are not right without a look at their triangles.

    Of the others files keep the vertices apart, and from what is new on the wall, and the surface
    turns back nowhere.
    """
    inside, bounds = lattice.kept.inside, boundary.bounds
    if not lattice.clearance > edge_within(bounds):
        return inside
    if lattice.deformed is not None:
        return np.asarray(lattice.unsound & inside, np.bool_)
    half = 0.5 * lattice.layout.grid.cell_size
    if lattice.is_proved_by_kind and keeps_corners(lattice.octants.values(), half, bounds):
        return np.zeros_like(inside)
    return inside


def drained_part(
    cleared: Cleared,
    solid: TriangleMesh,
    domain: Domain,
    frame: Wireframe,
    skin: Skin,
    drains: DrainHoles,
    smallest: float,
    monitor: Monitor,
) -> tuple[Cleared, Drained]:
    """A part with drain holes through its skin, and these.

    Shells below the `smallest` volume, mm3, are splinters of a drill, and go.

    Raises:
        VolfrepError: a hole cannot be where it is wanted.
    """
    part = cleared.surface
    drained = drain(part, solid, domain.mesh, frame, skin.deepest, drains, monitor)
    clean = tidy(drained.surface, shortest_edge(solid), monitor)
    rest = clear(clean, smallest, monitor)
    specks = cleared.specks_removed + rest.specks_removed
    found = replace(
        cleared, surface=rest.surface, quality=rest.quality, specks_removed=specks, least=rest.least
    )
    return found, replace(drained, surface=rest.surface)


def _open_faces(
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
    precision, outside = shortest_edge(solid), as_manifold(solid)
    surface = cut_again(
        cleared.surface, (solid,),
        (lambda void: outside - void) if with_skin else (lambda lattice: lattice ^ outside),
        monitor, keeps=True, is_void=with_skin,
    )  # fmt: skip
    surface = tidy(surface, precision, monitor)
    if keep_pieces:
        rest = clear(surface, smallest, monitor)
    elif with_skin:
        rest = clear(surface, smallest, monitor, bodies=inspect(solid).quality.bodies)
    else:
        on_skin = _on_skin(surface.mesh, domain, openings, precision)
        rest = clear(surface, smallest, monitor, keep=on_skin)
    if not rest.surface.triangles:
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
    lattice: PlacedLattice,
    solid: TriangleMesh,
    octant_spec: OctantSpec,
    monitor: Monitor,
    *,
    keep_pieces: bool = False,
) -> Cleared:
    """The lattice of whole cells as it is, without loose pieces, and its quality."""
    everywhere = lattice.kept.grid.kind >= 0
    mesh = lattice.mesh(lattice.facets(everywhere, monitor), everywhere, monitor)[0]
    surface = tidy(TrimmedSurface(mesh), shortest_edge(mesh), monitor)
    bodies = 0 if keep_pieces else max(1, inspect(solid).quality.bodies)
    return clear(surface, smallest_shell(octant_spec), monitor, bodies=bodies)


def _nothing_holds() -> VolfrepError:
    return VolfrepError(
        "No strut reaches the skin, so that nothing would hold the lattice: reduce the cell size, "
        "choose the activation 'touching', or let the struts of a graph go on to the skin."
    )
