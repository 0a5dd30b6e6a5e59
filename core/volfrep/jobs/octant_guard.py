# SPDX-License-Identifier: LGPL-2.1-or-later
"""Refusals before octants are assembled: cells too large, too many, none, or without a surface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..design import costs
from ..design.forecast import expected_triangles
from ..design.memory_guard import CERTAIN_SHARE, cells_are_full, fits_surely, refuse_memory
from ..design.spec import LatticeSpec
from ..grid.strut_graph import Wireframe
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.octant import Octant, OctantGrid, OctantKey
from ..octants.octant_spec import OctantSpec
from ..util.errors import VolfrepError
from ..util.types import Bools

#: Facets that stray more than so many times as far as asked for are told: 1.5 is what is kept to,
#: but for cells that docs/limits.md names.
DEVIATION_WARNED = 2.25


def refuse_before_skin(spec: LatticeSpec, solid: TriangleMesh, *, streamed: bool) -> None:
    """Refuse a lattice within a skin that surely would not fit, before the skin is made.

    By points of the part, where a lattice in all of it would not fit; by as many less as chance
    may have put there.

    Args:
        spec: what to make; with a skin.
        solid: the part, mm.
        streamed: whether only the octants that the wall cuts are in memory.

    Raises:
        VolfrepError: it needs more memory than is free.
    """
    skin, layer = spec.skin, costs.CUT_LAYER * spec.cell_size
    if skin is None or skin.bodies:  # what bodies leave is not known by the depth
        return
    at_wall = expected_triangles(spec, min(layer * solid.area, abs(solid.volume)))
    inner = 0.0 if streamed else expected_triangles(spec, abs(solid.volume))
    if fits_surely(inner, at_wall):
        return
    from .part_depth import PartDepth  # slow to load

    depth = PartDepth(solid)
    inside, beyond = (len(depth.points_below(skin.deepest + far)) for far in (0.0, 0.5 * layer))
    each = abs(solid.volume) / len(depth.points_below(-np.inf))
    # Half of the octants that the wall cuts lies on either side of it.
    cut = 2.0 * max(inside - beyond - 2.0 * (inside - beyond) ** 0.5, 0.0)
    inner = 0.0 if streamed else expected_triangles(spec, each * max(inside - 2.0 * inside**0.5, 0))
    refuse_memory(spec, CERTAIN_SHARE * inner, CERTAIN_SHARE * expected_triangles(spec, each * cut))


def refuse_too_large(
    spec: LatticeSpec,
    grid: OctantGrid,
    octants: dict[OctantKey, Octant],
    border: NDArray[np.bool_] | None,
    count: Sequence[int] | None = None,
    *,
    streamed: bool = False,
) -> None:
    """Refuse a lattice that would not fit.

    Args:
        spec: what to make.
        grid: which octant lies where.
        octants: their meshes.
        border: octants that go through the Boolean; None for none.
        count: cells of a block along x, y, z; None for a part.
        streamed: whether no others are in memory.

    Raises:
        VolfrepError: it needs more memory than is free.
    """
    per_kind = np.array([len(octants[key].triangles) for key in grid.keys])
    present = grid.kind >= 0
    triangles = int(per_kind[grid.kind[present]].sum())
    in_boolean = 0 if border is None else int(per_kind[grid.kind[present & border]].sum())
    placed = triangles if streamed and spec.varies else 0
    refuse_memory(spec, 0 if streamed else triangles, in_boolean, count, placed)


def refuse_solid_cells(octants: dict[OctantKey, Octant], spec: OctantSpec) -> None:
    """Raise a `VolfrepError` where no octant has a surface: struts fill everything."""
    if not any(len(octant.triangles) for octant in octants.values()):
        raise cells_are_full(spec.cell_size, spec.strut_radius)


def refuse_no_cells(active: Bools, cell_size: float, rule: str) -> None:
    """Raise a `VolfrepError` where no cell is active."""
    if not active.any():
        where_not = "has its centre" if rule == "centre" else "lies wholly"
        raise VolfrepError(
            f"No cell of {cell_size:g} mm {where_not} inside the domain: reduce the cell size or "
            "choose the activation 'touching'."
        )


def refuse_no_struts(frame: Wireframe, flat: int) -> None:
    """Raise a `VolfrepError` where every strut was taken away, `flat` of them as too flat."""
    if not len(frame.struts) and flat:
        raise VolfrepError(
            "Every strut lies too flat to be built, or has a free end without those, so that none "
            "is left: choose another build direction or cell."
        )
    if not len(frame.struts):
        raise VolfrepError(
            "Every strut has a free end or is too thin, so that none is left: keep dangling and "
            "thin struts, reduce the cell size or choose the activation 'touching'."
        )


def refuse_large_cells(solid: TriangleMesh, cell_size: float) -> None:
    """Raise a `VolfrepError` where a cell of a size in mm is larger than the part."""
    size = solid.bounds[1] - solid.bounds[0]
    if cell_size > size.max():
        raise VolfrepError(
            f"Cells of {cell_size:g} mm are larger than the part, which measures "
            f"{size[0]:.4g} x {size[1]:.4g} x {size[2]:.4g} mm: reduce the cell size, "
            "or see whether the part is in another unit."
        )


def deviation_warnings(
    octants: Mapping[OctantKey, Octant], octant_spec: OctantSpec
) -> tuple[str, ...]:
    """A sentence where facets stray farther from the exact struts than is promised; or none.

    That is known of the octants as they are meshed, before a grading moves them.
    """
    allowed = DEVIATION_WARNED * octant_spec.deviation
    deviations = np.array([octant.deviation for octant in octants.values()])
    count, farthest = int((deviations > allowed).sum()), float(deviations.max(initial=0.0))
    if not count:
        return ()
    return (
        f"Where struts meet, facets stray by up to {farthest:.2g} mm from the exact joints, in "
        f"{count:,} of {len(deviations):,} kinds of joint, {farthest / octant_spec.deviation:.2g} "
        f"times what is asked for: a smaller deviation brings them nearer.",
    )
