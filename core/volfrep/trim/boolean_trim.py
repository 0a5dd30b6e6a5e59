# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Boolean that trims the lattice to its domain and joins it to the skin.

part = outer - (inner - lattice). The cavity (inner - lattice) lies strictly inside the part, so
that the outer minus adds a reversed surface and intersects nothing. Only octants that the wall
crosses go into the one Boolean, closed by flat caps where their neighbours are left out; octants
wholly inside follow where the caps were, vertex on vertex: the Boolean hands the caps out
untouched, and what it hands out untouched has exactly the coordinates that went in.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..lattice.assembly import facets, neighbour_missing
from ..mesh.booleans import from_library, to_library
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from .culling import KeptOctants
from .laid import Laid
from .trimmed_surface import InnerOctants, TrimmedSurface

if TYPE_CHECKING:
    import manifold3d


@dataclass(frozen=True, eq=False)
class Trimmed:
    """The lattice trimmed to its domain.

    Attributes:
        surface: for a part: the cavity's, seen from the material. Otherwise the lattice's.
        on_wall: (m,) bool, triangles of its mesh that lie on the domain's wall.
        boolean_triangles: triangles that went into the Boolean.
    """

    surface: TrimmedSurface
    on_wall: NDArray[np.bool_]
    boolean_triangles: int


def trim(domain: TriangleMesh, laid: Laid, *, cavity: bool, monitor: Monitor) -> Trimmed:
    """Cut the lattice at the domain's wall.

    Args:
        domain: closed mesh of what the lattice fills.
        laid: the octants of the lattice.
        cavity: True for domain - lattice turned inside out (the wall with holes where struts
            meet it, and the struts), False for domain & lattice.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: the domain's mesh is not a solid that can be cut.
    """
    monitor.tick(0.1)
    import manifold3d

    wall = _solid(domain, [len(domain.triangles)], monitor)
    if wall.status() != manifold3d.Error.NoError:
        raise VolfrepError(
            f"The domain's surface cannot be cut ({wall.status().name}): repair the part's mesh."
        )
    kept = laid.kept
    # Caps towards octants inside are taken off again where these follow. Those on the
    # outside lie beyond the wall; what a wall that grazes them leaves belongs to the surface.
    caps, ends = _caps(laid, monitor)
    surface = np.concatenate([laid.facets(kept.border, monitor), ends])
    capped = laid.mesh(np.concatenate([surface, caps]), kept.border, monitor)[0]
    taken = len(capped.triangles) + len(domain.triangles)
    monitor.count("triangles into the Boolean", taken)
    ids = manifold3d.Manifold.reserve_ids(2)
    cutter = _solid(capped, [len(surface), len(caps)], monitor, ids)
    if cutter.status() != manifold3d.Error.NoError:
        raise RuntimeError(f"the lattice's border is not a manifold: {cutter.status()}")
    del capped
    monitor.tick(0.5)
    result = monitor.call(lambda: (wall - cutter if cavity else wall ^ cutter).to_mesh64())
    monitor.tick(0.9)
    mesh, origin = _read(result)
    del result
    is_cap = origin == ids + 1
    rest = mesh.triangles[~is_cap]
    cut = compact(TriangleMesh(mesh.vertices, rest[:, ::-1] if cavity else rest))
    inner = InnerOctants(laid, kept.inside) if kept.inside.any() else None
    trimmed = TrimmedSurface(cut, inner)
    if inner is None and is_cap.any():
        raise RuntimeError("the Boolean left caps where no octant follows")
    if not trimmed.is_joined:
        # The Boolean has taken out vertices at the caps, as it may do between tiny triangles: let
        # all the octants go through it, which takes longer.
        every = KeptOctants(kept.grid, kept.border | kept.inside, np.zeros_like(kept.inside))
        return trim(domain, replace(laid, kept=every), cavity=cavity, monitor=monitor)
    return Trimmed(trimmed, ~np.isin(origin[~is_cap], (ids, ids + 1)), taken)


def _caps(laid: Laid, monitor: Monitor) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """What closes the border's octants towards those inside, and towards nothing."""
    layout, kept = laid.layout, laid.kept
    inward, outward = [], []
    for axis in range(3):
        for high in (False, True):
            every = neighbour_missing(layout.grid, kept.border, axis, high)
            last = neighbour_missing(layout.grid, kept.border | kept.inside, axis, high)
            inward.append(facets(layout, monitor, every & ~last, (axis, high)))
            outward.append(facets(layout, monitor, every & last, (axis, high)))
    return np.concatenate(inward), np.concatenate(outward)


def _solid(
    mesh: TriangleMesh,
    runs: list[int],
    monitor: Monitor,
    first_id: int | None = None,
) -> manifold3d.Manifold:
    """A manifold whose runs of triangles can be told apart after a Boolean."""
    import manifold3d as library

    ids = library.Manifold.reserve_ids(len(runs)) if first_id is None else first_id
    source = to_library(
        mesh,
        run_index=np.concatenate([[0], np.cumsum(runs)]).astype(np.uint64) * np.uint64(3),
        run_original_id=np.arange(ids, ids + len(runs), dtype=np.uint32),
    )
    return monitor.call(lambda: library.Manifold(source))


def _read(result: manifold3d.Mesh64) -> tuple[TriangleMesh, NDArray[np.int64]]:
    """The Boolean's result, and the run that each triangle came from."""
    index = np.asarray(result.run_index).astype(np.int64) // 3
    origin = np.repeat(np.asarray(result.run_original_id).astype(np.int64), np.diff(index))
    return from_library(result), origin
