# SPDX-License-Identifier: LGPL-2.1-or-later
"""Memory guard: what a job would take, and the refusal of one that does not fit."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Sequence

import numpy as np

from ..util import memory_limit
from ..util.errors import VolfrepError
from . import costs
from .forecast import expected_triangles
from .spec import LatticeSpec

#: The estimate of triangles is good to a third: so much of it will be there.
CERTAIN_SHARE = 0.6
#: Struts of larger cells have so many times more facets for their length, at most.
MORE_BARE = 1.4
#: Taken for free memory where the system does not tell.
ASSUMED_MEMORY = 8e9


def cells_are_full(cell_size: float, radius: float) -> VolfrepError:
    """What is wrong where struts of a radius leave no room between them; mm."""
    return VolfrepError(
        f"Struts of radius {radius:g} mm fill cells of {cell_size:g} mm completely: reduce the "
        "radius or enlarge the cells."
    )


def refuse_cells(count: int, cell_size: float) -> None:
    """Refuse a grid of so many cells of a size in mm.

    Raises:
        VolfrepError: they need more memory than is free; with the cells that would fit.
    """
    needed, free = float(count) * costs.BYTES_PER_CELL, free_memory()
    if needed > free:
        fitting = rounded_up(cell_size * (1.2 * needed / free) ** (1 / 3))
        raise VolfrepError(
            f"This lattice would {_takes(needed, free)}: cells of {fitting:g} mm would fit."
        )


def refuse_block(count: Sequence[int], bytes_each: float) -> None:
    """Refuse a block of so many cells along x, y, z, of which each takes so many bytes.

    Raises:
        VolfrepError: they need more memory than is free; with the block that would fit.
    """
    needed, free = math.prod(count) * float(bytes_each), free_memory()
    if needed > free:
        raise VolfrepError(
            f"This block would {_takes(needed, free)}: {smaller_block(count, 1.2 * needed / free)} "
            "would fit."
        )


def smaller_block(count: Sequence[int], excess: float) -> str:
    """A block of so many times fewer cells than one of so many along x, y, z.

    >>> smaller_block((1000, 1000, 2), 1e5)
    'a block of 4 x 4 x 1 cells'
    """
    shape = list(count)
    for place, axis in enumerate(sorted(range(3), key=lambda k: count[k])):
        # All sides are divided alike; what one that is a single cell cannot give, the others do.
        times = min(excess ** (1.0 / (3 - place)), float(count[axis]))
        shape[axis], excess = max(1, int(count[axis] / times + 1e-9)), excess / times
    return "a block of " + " x ".join(str(n) for n in shape) + " cells"


def refuse_expected(spec: LatticeSpec, volume: float, count: Sequence[int] | None = None) -> None:
    """Refuse a lattice in a volume of mm3 that surely would not fit, before any work starts.

    Raises:
        VolfrepError: it needs more memory than is free.
    """
    refuse_memory(spec, CERTAIN_SHARE * expected_triangles(spec, volume), count=count)


def fits_surely(triangles: float, in_boolean: float) -> bool:
    """Whether a job of so many triangles, and so many in the Boolean, is none to be refused."""
    needed = triangles * costs.BYTES_PER_BLOCK_TRIANGLE
    needed += in_boolean * costs.BYTES_PER_BOOLEAN_TRIANGLE
    return needed <= free_memory() and triangles <= np.iinfo(np.int32).max // 3


def refuse_memory(
    spec: LatticeSpec,
    triangles: float,
    in_boolean: float = 0.0,
    count: Sequence[int] | None = None,
    placed: float = 0.0,
) -> None:
    """Refuse a job of so many triangles, some of them in the Boolean.

    `count` is of the cells of a block along x, y, z; `placed` are triangles beside a mesh whose
    vertices are kept.

    Raises:
        VolfrepError: it needs more memory than is free; with the nearest settings that would fit.
    """
    needed = triangles * costs.BYTES_PER_BLOCK_TRIANGLE
    needed += in_boolean * costs.BYTES_PER_BOOLEAN_TRIANGLE
    needed += placed * costs.BYTES_PER_PLACED_TRIANGLE
    triangles += placed
    free = free_memory()
    most = np.iinfo(np.int32).max // 3
    if needed <= free and triangles <= most:
        return
    excess = 1.2 * max(needed / free, triangles / most)
    # Where the others are not in memory, those at the wall are what is told.
    number, where = (triangles, "") if triangles else (in_boolean, " at its wall")
    raise VolfrepError(
        f"This lattice would have about {number / 1e6:.3g} million triangles{where} and "
        f"{_takes(needed, free)}: {_what_fits(spec, excess, count)}."
    )


def _takes(needed: float, free: float) -> str:
    return f"take {needed / 1e9:.3g} GB of the {free / 1e9:.3g} GB of free memory"


def _what_fits(spec: LatticeSpec, excess: float, count: Sequence[int] | None) -> str:
    """Settings that take so many times less.

    Facets go with the square of their edge, struts in a volume with the square of the cell, of
    which more is bare where cells are larger.
    """
    cells = f"cells of {rounded_up(spec.cell_size * (MORE_BARE * excess) ** 0.5):g} mm or larger"
    if count is not None:
        cells = smaller_block(count, excess)
    facets = int(spec.facets_along_cell / excess**0.5)
    if facets < spec.kind.coarsest_resolution:
        return f"{cells} would fit"
    if spec.resolution is not None:
        return f"a resolution of {facets}, or {cells}, would fit"
    edge = spec.cell_size / facets
    return (
        f"a deviation of {rounded_up(edge**2 / (16 * spec.template_radius)):g} mm, or {cells}, "
        "would fit"
    )


def rounded_up(value: float) -> float:
    """The next number of two significant figures, not below the value."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / step - 1e-9) * step


def free_memory() -> float:
    """Bytes of memory that are free, as far as the system tells, and that may be taken."""
    return min(_free_memory(), memory_limit.left())


def _free_memory() -> float:
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return float(line.split()[1]) * 1024.0
    except OSError:
        if sys.platform == "win32":
            return _free_memory_of_windows()
    if hasattr(os, "sysconf") and "SC_AVPHYS_PAGES" in os.sysconf_names:
        return float(os.sysconf("SC_AVPHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    return ASSUMED_MEMORY


def _free_memory_of_windows() -> float:
    """Bytes of physical memory that are free, as GlobalMemoryStatusEx tells."""
    if sys.platform == "win32":
        import ctypes

        # MEMORYSTATUSEX: two fields of 32 bits, the first its length, then seven of 64 bits: all
        # the physical memory, and what of it is available.
        status = (ctypes.c_uint64 * 8)()
        ctypes.cast(status, ctypes.POINTER(ctypes.c_uint32))[0] = ctypes.sizeof(status)
        if ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status)):
            return float(status[2])
    return ASSUMED_MEMORY
