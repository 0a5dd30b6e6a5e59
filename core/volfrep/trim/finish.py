# SPDX-License-Identifier: LGPL-2.1-or-later
"""What may leave the engine: a solid that every file holds as it is, and figures that are its own.

Octants are proved not to run through themselves when they are meshed (`octant_mesh`), and
the Boolean hands out what does not; `tidy` looks at what it changes after that. `finish` draws
apart what would cross in a file, and sends lines through what was moved.
"""

from __future__ import annotations

import numpy as np

from ..mesh.float32_repair import (
    STEPS,
    edge_within,
    repair_slivers,
    separate_vertices,
)
from ..mesh.precision import merging_vertices
from ..mesh.quality import Quality, quality_after_moves, refuse_no_solid
from ..mesh.topology import displaced_vertices, touching, vertices_of
from ..mesh.triangle_mesh import TriangleMesh, corners_at
from ..spatial.regions import in_regions
from ..spatial.resolve_crossings import Folds, folds_of, resolve_fold_crossings
from ..spatial.self_intersection import crossing_edges, near_corners
from ..spatial.winding import Lines
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .mended_surface import MendedSurface
from .trimmed_surface import TrimmedSurface

#: Octants that are nearer to triangles that cross than this may have to go along where these are
#: drawn apart, in units of L.
ABOUT = 0.25
#: Lines see no crossing where less than this part of the volume is not enclosed once: rounding.
ROUNDING = 1e-9
#: Facets that cross and cannot be drawn apart lose slivers as thin as so many shortest edges of a
#: file, one after the other: where a wall grazes a strut facets may be all but a line.
THINNER = (2.0, 4.0, 8.0, 16.0)
#: A solid of which more than this part is not enclosed once is refused; less is told.
MOST_CROSSED = 0.05
#: Vertices that are moved apart change no more than this part of the volume; more is a mesh whose
#: facets are as small as the steps between the numbers of a file.
MOST_MOVED = 1e-3


def tidy(surface: TrimmedSurface, precision: float, monitor: Monitor) -> TrimmedSurface:
    """A surface from a Boolean, without slivers where they can go.

    Octants beside its mesh have none.

    Args:
        surface: closed.
        precision: `shortest_edge` of the part, mm.
        monitor: for cancel.
    """
    return mend(surface, precision, monitor).applied()


def mend(surface: TrimmedSurface, precision: float, monitor: Monitor) -> MendedSurface:
    """As `tidy`, what changes told and not yet done."""
    looks, mesh = surface.looks, surface.mesh
    unsound = looks.unsound if looks and looks.step * STEPS == precision else None
    repair = repair_slivers(mesh, precision, unsound, monitor.backend)
    if not repair.new.any():
        return MendedSurface(surface, repair, shells=surface.shells)
    fresh = repair.piece[repair.new]
    # What lies about the new triangles is little, and is all that is looked at.
    small = repair.some(mesh, fresh)
    corners = corners_at(small.vertices, small.triangles)
    rows = np.flatnonzero(near_corners(mesh, corners, monitor.backend) & repair.stays(mesh))
    every = np.concatenate([mesh.triangles[rows], repair.piece])
    part, among = repair.some(mesh, every), np.pad(repair.new, (len(rows), 0))
    if surface.octants is not None:
        near = surface.octants.reached(corners)
        if near.any() and surface.has_inner_edges(fresh):  # that those octants may have, too
            return mend(surface.with_octants(near, monitor), precision, monitor)
        part = surface.on(part).with_octants(near, monitor).mesh
        among = np.pad(among, (0, len(part.triangles) - len(among)))
    if any(map(len, in_regions(_crossing, part, among, precision, monitor))):
        return MendedSurface(surface)  # a sliver is better than facets that cross
    beside = rows[touching(vertices_of(fresh, len(mesh.vertices)), mesh.triangles[rows])]
    shells = surface.shells and surface.shells.repaired(mesh, repair, beside)
    return MendedSurface(surface, repair, beside, shells)


def _crossing(part: TriangleMesh, among: Bools, precision: float, monitor: Monitor) -> Ints:
    """(k, 2) triangles, one of them among the chosen, that cross by more than the precision."""
    one, other, _ = monitor.call(lambda: crossing_edges(part, among, precision))
    return np.stack([one, other], axis=1)


def finish(
    surface: TrimmedSurface,
    quality: Quality,
    monitor: Monitor,
    deformed: bool,
    cut: bool = True,
    least: float = 0.0,
) -> tuple[TrimmedSurface, Quality, tuple[str, ...]]:
    """A surface as it is handed out, its quality that of any file, and sentences for the user.

    Args:
        surface: closed.
        quality: of it.
        monitor: for progress and cancel.
        deformed: whether the octants' vertices are elsewhere than they were meshed.
        cut: whether a wall has cut them; what is neither needs no look.
        least: no shell of it encloses less, mm3; 0 where that is not known.

    Raises:
        VolfrepError: it encloses no volume, runs through itself, or touches itself so that no
            file can hold it; the text says where.
    """
    mesh = surface.mesh
    apart = separate_vertices(mesh, edge_within(quality.bounds), monitor.backend)
    if apart is not mesh:
        changed = surface.on(apart)
        wider = _with_reached(surface, changed, monitor)
        if wider is not changed:
            return finish(wider, quality, monitor, deformed, cut, least)
        surface = changed
        again = _quality_after(mesh, surface, quality, least, monitor)
        if abs(again.volume - quality.volume) > MOST_MOVED * abs(quality.volume):
            raise _finer_than_files(mesh)
        refuse_merging(apart)
        quality, least = again, 0.5 * least  # the shells may have lost as much
    straight, place, drawn = surface.mesh, None, False
    if deformed or cut:
        folded = folds_of(surface.mesh, monitor, deformed, looks=surface.looks)
        if len(folded.pairs) and surface.octants is not None:  # which may have to go along
            beside = len(surface.mesh.triangles)
            surface = _with_octants_about(surface, folded.pairs, monitor)
            folded = folded.followed_by(len(surface.mesh.triangles) - beside)
        before = surface.mesh
        straight, place = resolve_fold_crossings(before, monitor, deformed, folded)
        if place is not None:
            # A mesh less while slivers are looked for: of this one what has moved is kept.
            moved = np.flatnonzero(displaced_vertices(before, straight))
            moved_to, straight = straight.vertices[moved], before
            without = thinned(surface, folded, monitor, deformed)
            if without is not None:
                surface, straight, mended = without
                place = None
                before, least = surface.mesh, 0.5 * least  # the shells may have lost as much
                found = mended.quality_after(quality, surface.bounds, least)
                quality = surface.inspected(monitor).found.quality if found is None else found
            elif len(moved):
                vertices = monitor.backend.replaced(before.vertices, moved, moved_to)
                straight = TriangleMesh(vertices, before.triangles)
        drawn = straight is not before
    if drawn:
        changed = surface.on(straight)
        wider = _with_reached(surface, changed, monitor)
        if wider is not changed:
            return finish(wider, quality, monitor, deformed, cut, least)
        surface = changed
        quality = _quality_after(before, surface, quality, least, monitor)
    refuse_no_solid(quality)
    notes = () if place is None else (_touching(place),)
    if not deformed:
        return surface, quality, notes
    met = monitor.call(lambda: surface.met_by(Lines(surface.bounds)))
    share = met.odd / quality.volume
    if met.place is None or share <= ROUNDING:
        return surface, quality, notes
    x, y, z = met.place
    where = (
        f"There is so little room about ({x:.4g}, {y:.4g}, {z:.4g}) that facets run through each "
        f"other there: {100 * share:.2g} % of the volume is enclosed twice or inside out"
    )
    advice = "make it thinner or let the cells be larger there"
    if share > MOST_CROSSED:
        raise VolfrepError(f"{where}, {advice}.")
    return surface, quality, (*notes, f"{where}; {advice} if that matters.")


def _quality_after(
    before: TriangleMesh, surface: TrimmedSurface, quality: Quality, least: float, monitor: Monitor
) -> Quality:
    """The quality of a surface that vertices of its mesh have moved on, as of `finish`."""
    found = None
    if least > 0.0 and surface.mesh.triangles is before.triangles and surface.is_joined:
        found = quality_after_moves(
            quality, before, surface.mesh, surface.bounds, 0.5 * least, monitor.backend
        )
    return surface.inspected(monitor).found.quality if found is None else found


def thinned(
    surface: TrimmedSurface, folded: Folds, monitor: Monitor, deformed: bool
) -> tuple[TrimmedSurface, TriangleMesh, MendedSurface] | None:
    """A surface without the slivers about facets that cross, if nothing crosses then.

    Args:
        surface: as it was before anything was drawn apart.
        folded: where it turns back.
        monitor: for cancel.
        deformed: as of `finish`.

    Returns:
        The surface; its mesh, drawn apart; and what has gone from the surface as it was. None where
        something still crosses.
    """
    precision, mesh = edge_within(surface.bounds), surface.mesh
    crossing = vertices_of(mesh.triangles[folded.pairs], len(mesh.vertices))
    about = np.flatnonzero(touching(crossing, mesh.triangles, monitor.backend))
    for factor in THINNER:
        repair = repair_slivers(mesh, factor * precision, about, monitor.backend)
        if not repair.new.any():
            continue
        fresh = vertices_of(repair.piece[repair.new], len(mesh.vertices))
        at_fresh = touching(fresh, mesh.triangles, monitor.backend)
        beside = np.flatnonzero(at_fresh & repair.stays(mesh))
        mended = MendedSurface(surface, repair, beside)
        changed = mended.applied(backend=monitor.backend)
        if not (mended.is_joined_as_before or changed.is_joined):
            continue
        new = np.pad(repair.new, (len(changed.mesh.triangles) - len(repair.new), 0))
        if changed.octants is not None:
            corners = corners_at(changed.mesh.vertices, changed.mesh.triangles[new])
            changed = changed.with_octants(changed.octants.reached(corners), monitor)
        whole = changed.mesh
        new = np.pad(new, (0, len(whole.triangles) - len(new)))
        folded_now = folds_of(whole, monitor, deformed, new, changed.looks)
        apart, left = resolve_fold_crossings(whole, monitor, deformed, folded_now)
        if left is None:
            return changed, apart, mended
    return None


def _with_octants_about(surface: TrimmedSurface, pairs: Ints, monitor: Monitor) -> TrimmedSurface:
    """The surface with the octants in its mesh that lie about some of its triangles."""
    if surface.octants is None:
        return surface
    corners = surface.mesh.vertices[surface.mesh.triangles[np.unique(pairs)]]
    far = ABOUT * surface.octants.lattice.layout.grid.cell_size
    low, high = corners.min(axis=1) - far, corners.max(axis=1) + far
    near = surface.octants.reached(np.stack([low, high, low], axis=1))
    return surface.with_octants(near, monitor)


def _with_reached(
    surface: TrimmedSurface, changed: TrimmedSurface, monitor: Monitor
) -> TrimmedSurface:
    """The surface as it was, with the octants in its mesh that vertices which move belong to.

    Args:
        surface: with its mesh as it was.
        changed: the same with its vertices where they are to be.
        monitor: for cancel.

    Returns:
        The changed one where no octants beside its mesh are touched or reached into.
    """
    if surface.octants is None:
        return changed
    moved = displaced_vertices(surface.mesh, changed.mesh)
    if moved[surface.rim_rows].any():
        return TrimmedSurface(surface.whole(monitor))
    vertices, triangles = changed.mesh.vertices, changed.mesh.triangles
    went = touching(moved, triangles, monitor.backend)
    reached = surface.octants.reached(vertices[triangles[went]])
    return surface.with_octants(reached, monitor) if reached.any() else changed


def piece_warnings(
    quality: Quality, removed: int, volume_removed: float, *, is_in_skin: bool
) -> tuple[str, ...]:
    """Sentences on pieces of a lattice without a skin that hang on nothing.

    Args:
        quality: of what is left.
        removed: how many pieces were left out.
        volume_removed: of these, mm3.
        is_in_skin: whether it was cut out of a skin, which would hold all of them.
    """
    sentences = []
    if removed:
        share = 100.0 * volume_removed / (volume_removed + quality.volume)
        what = "piece that hangs" if removed == 1 else "pieces that hang"
        sentences.append(
            f"{removed:,} {what} on nothing left out, {share:.2g} % of the lattice's volume: "
            "smaller cells or another origin may join them, and so does a skin."
        )
    if is_in_skin and quality.bodies > 1:
        sentences.append(
            f"The lattice is {quality.bodies:,} bodies that do not touch each other: only the "
            "part's skin holds them together."
        )
    return tuple(sentences)


def _touching(place: Floats) -> str:
    x, y, z = place
    return (
        f"Near ({x:.4g}, {y:.4g}, {z:.4g}) two sides of the surface lie so close together that "
        "facets run through each other."
    )


def _finer_than_files(mesh: TriangleMesh) -> VolfrepError:
    x, y, z = mesh.vertices[merging_vertices(mesh)[0]]
    return VolfrepError(
        f"Near ({x:g}, {y:g}, {z:g}) the mesh is finer than the single precision of files there: "
        "move the part nearer to the origin or use a coarser resolution."
    )


def refuse_merging(mesh: TriangleMesh) -> None:
    """Raise a `VolfrepError` where a file would make one vertex of two."""
    twins = merging_vertices(mesh)
    if not len(twins):
        return
    x, y, z = mesh.vertices[twins[0]]
    raise VolfrepError(
        f"Near ({x:.6g}, {y:.6g}, {z:.6g}) the surface touches itself within the single precision "
        "of files: move the part nearer to the origin, or change the lattice's origin or radius "
        "by a little."
    )
