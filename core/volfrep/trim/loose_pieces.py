# SPDX-License-Identifier: LGPL-2.1-or-later
"""Removal of loose pieces and specks: shells of a mesh that hang on nothing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..mesh.quality import Quality, measure, subtract_shells
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..octants.octant_spec import OctantSpec
from ..spatial.rays import inside_points
from ..util.progress import Monitor
from .mended_surface import MendedSurface
from .trimmed_surface import TrimmedSurface


@dataclass(frozen=True, eq=False)
class Cleared:
    """A trimmed surface without what does not belong to it.

    Attributes:
        surface: what is left.
        quality: of it.
        pieces_removed: pieces of material that hung on nothing.
        specks_removed: shells smaller than a facet, which no sample could follow.
        volume_removed: of the pieces, mm3.
        least: no shell that is left encloses less, mm3; 0 where that is not known.
    """

    surface: TrimmedSurface
    quality: Quality
    pieces_removed: int
    specks_removed: int
    volume_removed: float = 0.0
    least: float = 0.0


def smallest_shell(octant_spec: OctantSpec) -> float:
    """Volume of half a facet's edge cubed, mm3: no shell smaller than that is meant."""
    return (0.5 * octant_spec.edge) ** 3


def clear(
    surface: TrimmedSurface | MendedSurface,
    smallest: float,
    monitor: Monitor,
    *,
    floating: bool = False,
    keep: NDArray[np.int64] | None = None,
    bodies: int = 0,
) -> Cleared:
    """Remove what hangs on nothing, and shells too small to mean anything.

    Args:
        surface: closed shells.
        smallest: volume in mm3 below which a shell is dropped: less than a facet's size across,
            it is the remainder of a window or a bubble that the samples could not follow.
        monitor: asked for a cancel.
        floating: every piece of material floats (in a cavity's surface, they are not the part).
        keep: triangles of the mesh whose shells stay, all other pieces of material go; None: all
            stay.
        bodies: so many of the largest pieces of material stay, all others go; 0: all stay.
    """
    mended = surface if isinstance(surface, MendedSurface) else MendedSurface(surface)
    if len(mended.repair.old) and mended.shells is None:
        mended = MendedSurface(mended.applied(backend=monitor.backend))
    joined, repair = mended.inspected(monitor), mended.repair
    found, mesh = joined.found, mended.surface.mesh
    label, volume = found.shell, found.volume
    used = joined.beyond | joined.within
    solid, void = used & (volume > 0), used & (volume <= 0)
    tiny = used & (np.abs(volume) < smallest)
    loose = solid & (tiny | floating)
    if keep is not None:
        stays = np.zeros(len(volume), bool)
        stays[label[keep]] = True
        loose |= solid & ~stays
    elif bodies:
        order = np.argsort(np.where(solid, -volume, np.inf), kind="stable")
        loose |= solid
        loose[order[:bodies]] = False
    if not (loose | tiny).any():
        least = float(np.abs(volume[used]).min(initial=np.inf))
        left = mended.applied(backend=monitor.backend)
        quality = found.quality
        if left is not mended.surface:
            quality = replace(quality, bounds=left.bounds)
        return Cleared(left, quality, 0, 0, least=least)
    # What goes has to be in the mesh, with all that may lie in it.
    alone = joined.beyond & ~joined.within
    if (joined.beyond & (loose | tiny)).any() or ((loose & ~tiny).any() and (void & alone).any()):
        whole = TrimmedSurface(mended.applied(backend=monitor.backend).whole(monitor))
        return clear(whole, smallest, monitor, floating=floating, keep=keep, bodies=bodies)
    if (loose & ~tiny).any() and len(repair.old):
        left = mended.applied(backend=monitor.backend)
        return clear(left, smallest, monitor, floating=floating, keep=keep, bodies=bodies)
    # A void inside a loose piece goes with it.
    inside_loose = np.zeros(len(volume), bool)
    if (loose & ~tiny).any() and (void & ~tiny).any():
        inside_loose = void & _find_enclosed(mesh, label, loose & ~tiny, void & ~tiny)
    gone = loose | tiny | inside_loose
    goes, piece_goes = gone[label], gone[label[repair.old[repair.origin]]]
    left = mended.applied(goes, piece_goes, monitor.backend)
    if found.quality.watertight and left.triangles:
        both = mesh.triangles[goes & repair.stays(mesh)], repair.piece[piece_goes]
        taken = measure(repair.some(mesh, np.concatenate(both)))
        quality = subtract_shells(found.quality, taken, left.bounds, volume[used & ~gone])
    else:
        quality = left.inspected(monitor).found.quality
    pieces = loose & ~tiny
    least = float(np.abs(volume[used & ~gone]).min(initial=np.inf))
    return Cleared(
        left, quality, int(pieces.sum()), int(tiny.sum()), float(volume[pieces].sum()), least
    )


def _find_enclosed(
    mesh: TriangleMesh,
    label: NDArray[np.int32],
    loose: NDArray[np.bool_],
    void: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Which of the void shells lie inside a loose one: by the winding number at one vertex."""
    result = np.zeros(len(void), bool)
    pieces = compact(TriangleMesh(mesh.vertices, mesh.triangles[loose[label]]))
    low, high = pieces.bounds
    quiet = Monitor()
    for shell, triangle in zip(*np.unique(label, return_index=True), strict=True):
        if not void[shell]:
            continue
        point = mesh.vertices[mesh.triangles[triangle, 0]]
        if (point < low).any() or (point > high).any():
            continue
        result[shell] = inside_points(pieces, point[None], quiet)[0]
    return result
