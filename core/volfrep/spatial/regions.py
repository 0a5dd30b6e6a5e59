# SPDX-License-Identifier: LGPL-2.1-or-later
"""Looks at which triangles of a mesh meet, region by region, where other processes can look."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh, compact, triangle_boxes
from ..util.parallel import SharedArray
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints

#: What finds pairs (k, 2) of triangles of a mesh, at least one of them wanted, (m,) bool, that meet
#: within a distance in mm.
Look = Callable[[TriangleMesh, Bools, float, Monitor], Ints]

#: Wanted triangles of a region.
REGION_TRIANGLES = 1 << 11


def in_regions(
    look: Look, mesh: TriangleMesh, wanted: Bools, near: float, monitor: Monitor
) -> Iterator[Ints]:
    """The pairs (k, 2) of triangles that a look finds, some of them more than once.

    Args:
        look: a function of a module; two triangles meet, or do not, whatever lies about them.
        mesh: any mesh, mm.
        wanted: (m,) bool, triangles of which each pair has at least one.
        near: mm; no farther apart are triangles that meet.
        monitor: asked for a cancel; its backend looks at the regions, if it uses processes.
    """
    chosen, backend = np.flatnonzero(wanted), monitor.backend
    if not backend.uses_processes or len(chosen) <= REGION_TRIANGLES:
        yield look(mesh, wanted, near, monitor)
        return
    middle = mesh.vertices[mesh.triangles[chosen, 0]]
    regions, waiting = [], [np.arange(len(chosen))]
    while waiting:
        rows = waiting.pop()
        if len(rows) <= REGION_TRIANGLES:
            regions.append(chosen[rows])
            continue
        along = middle[rows, np.ptp(middle[rows], axis=0).argmax()]
        rows = rows[np.argsort(along, kind="stable")]
        waiting += [rows[: len(rows) // 2], rows[len(rows) // 2 :]]
    with backend.sharing(mesh.vertices, mesh.triangles) as arrays:
        for found in backend.starmap(_in_region, ((look, *arrays, rows, near) for rows in regions)):
            monitor.tick()
            yield found


def _in_region(
    look: Look, vertices: SharedArray, triangles: SharedArray, rows: Ints, near: float
) -> Ints:
    """The pairs with one of some triangles, by a look at those whose boxes come near to theirs."""
    mesh = TriangleMesh(vertices.array, triangles.array)
    low, high = _boxes(vertices, triangles)
    within = np.ones(len(mesh.triangles), bool)
    for lowest, highest in zip(low, high, strict=True):
        within &= highest >= lowest[rows].min() - 2.0 * near
        within &= lowest <= highest[rows].max() + 2.0 * near
    some = np.flatnonzero(within)
    wanted = np.zeros(len(within), bool)
    wanted[rows] = True
    part = compact(TriangleMesh(mesh.vertices, mesh.triangles[some]))
    found: Ints = some[look(part, wanted[some], near, Monitor())]
    return found


@lru_cache(maxsize=1)
def _boxes(vertices: SharedArray, triangles: SharedArray) -> tuple[Floats, Floats]:
    """(3, m) least and greatest coordinates of the triangles, which all regions look at."""
    return triangle_boxes(vertices.array.T, triangles.array.T)
