# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a job would take, and the refusal of one that does not fit into memory."""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import NDArray

from .cells import UnitCell
from .errors import VolfrepError
from .lattice import OctantGrid
from .octant import OctantKey
from .spec import LatticeSpec
from .tile import Octant

#: Bytes that a triangle takes at the peak: laid out and checked, or in the Boolean as well.
BYTES_PER_TRIANGLE = 150
BYTES_PER_BOOLEAN_TRIANGLE = 900
#: Bytes that a cell of the grid takes while cells and octants are told apart.
BYTES_PER_CELL = 500
#: Taken for free memory where the system does not tell.
ASSUMED_MEMORY = 8e9


def refuse_too_large(
    grid: OctantGrid, octants: dict[OctantKey, Octant], border: NDArray[np.bool_] | None
) -> None:
    """Refuse a lattice that would not fit.

    Args:
        grid: which octant lies where.
        octants: their meshes.
        border: octants that go through the Boolean; None for none.

    Raises:
        VolfrepError: it needs more memory than is free.
    """
    per_kind = np.array([len(octants[key].triangles) for key in grid.keys])
    present = grid.kind >= 0
    triangles = int(per_kind[grid.kind[present]].sum())
    in_boolean = 0 if border is None else int(per_kind[grid.kind[present & border]].sum())
    refuse_memory(triangles, in_boolean)


def expected_triangles(cell: UnitCell, spec: LatticeSpec, volume: float) -> float:
    """Triangles of the lattice in a volume, rather too few: known before any work starts.

    A strut on a cell's edge is shared by four cells; facets are equilateral triangles; about
    half of the struts' surface is lost to one another at the joints at the worst.
    """
    ends = cell.nodes[cell.struts]
    length = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()) / 4.0
    surface = 0.5 * length * spec.cell_size * 2.0 * np.pi * spec.template_radius
    facet = np.sqrt(3.0) / 4.0 * (spec.cell_size / spec.facets_along_cell) ** 2
    return float(volume / spec.cell_size**3 * surface / facet)


def refuse_memory(triangles: float, in_boolean: float, other: float = 0.0) -> None:
    """Refuse a job of so many triangles, some of them in the Boolean, and other bytes."""
    needed = triangles * BYTES_PER_TRIANGLE + in_boolean * BYTES_PER_BOOLEAN_TRIANGLE + other
    free = _free_memory()
    if needed > free or triangles > np.iinfo(np.int32).max // 3:
        what = f"have about {triangles / 1e6:.3g} million triangles and " if triangles else ""
        raise VolfrepError(
            f"This lattice would {what}take {needed / 1e9:.3g} GB of the {free / 1e9:.3g} GB of "
            "free memory: enlarge the cells, or choose a coarser resolution or fewer cells."
        )


def _free_memory() -> float:
    """Bytes of memory that are free, as far as the system tells."""
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return float(line.split()[1]) * 1024.0
    except OSError:
        pass
    if hasattr(os, "sysconf") and "SC_AVPHYS_PAGES" in os.sysconf_names:
        return float(os.sysconf("SC_AVPHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    return ASSUMED_MEMORY
