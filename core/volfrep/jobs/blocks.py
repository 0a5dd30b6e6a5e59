# SPDX-License-Identifier: LGPL-2.1-or-later
"""Free-standing blocks of whole cells, with full round struts on their outside."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ..design.spec import LatticeSpec
from ..grid.strut_graph import Wireframe
from ..reports.report import Report
from ..reports.result import Result
from ..util.arguments import check_kind, check_path
from ..util.progress import Monitor, ProgressCallback
from .kinds import lattice_kind


def block(
    spec: LatticeSpec,
    count: Sequence[int],
    *,
    progress: ProgressCallback | None = None,
) -> Result:
    """A free-standing block of whole cells.

    Args:
        spec: what to make; only cell, sizes, grading, fillet, resolution, origin and density
            count.
        count: cells along x, y, z.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: the counts make no sense or the block would not fit into memory.
        Cancelled: the callback said so.
    """
    return lattice_kind(spec).block(count).result(Monitor(progress))


def write_block_stl(
    spec: LatticeSpec,
    count: Sequence[int],
    path: str | os.PathLike[str],
    *,
    progress: ProgressCallback | None = None,
) -> Report:
    """A free-standing block straight into a binary STL.

    Equal cells are written octant by octant, so that the memory does not grow with the triangles;
    graded ones, whose octants all differ, are meshed as a whole first.

    Args:
        spec: what to make, as for `block`.
        count: cells along x, y, z.
        path: of the file; an old file stays if anything goes wrong.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: the counts make no sense, the block would not fit into memory or onto the
            disk, or the path cannot be written.
        Cancelled: the callback said so; no file is left behind.

    >>> import tempfile, volfrep
    >>> spec = volfrep.LatticeSpec(cell="BCC", cell_size=10, strut_radius=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     volfrep.write_block_stl(spec, (2, 2, 2), f"{folder}/block.stl").cells_active
    8
    """
    check_kind("spec", spec, LatticeSpec, "a LatticeSpec")
    check_path("path", path)
    return lattice_kind(spec).block(count).write_stl(path, Monitor(progress))


def block_wireframe(spec: LatticeSpec, count: Sequence[int]) -> Wireframe:
    """The nodes and struts of a free-standing block.

    Raises:
        VolfrepError: the counts make no sense, or the block would not fit into memory.
    """
    return lattice_kind(spec).block(count).wireframe()
