# SPDX-License-Identifier: LGPL-2.1-or-later
"""The infill that is asked for, and the strut radius of a target.

The part that comes out has the density, mass or stiffness that was aimed at.

The radius of a density or a mass is read off `lattice.strut_volume`, in the very domain that the
lattice is cut by. The mesh is then measured; where it misses by more than `CLOSE` it is made again,
with what it missed by.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from functools import partial

from ..design.spec import LatticeSpec
from ..io.solid import Solid
from ..mesh.triangle_mesh import TriangleMesh
from ..reports.report import Report
from ..reports.result import Result
from ..util.cache import StageCache
from ..util.progress import Monitor, ProgressCallback
from .infill import Infill
from .kinds import lattice_kind
from .kinds.kind import BlockLattice
from .target_search import make_with_volume


def solve_target(
    solid: TriangleMesh | Solid,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    meshed: bool = True,
    executor: Executor | None = None,
    streamed: bool = False,
) -> Infill:
    """The infill of a solid whose struts have the radius of the specification's target.

    Args:
        solid: checked closed mesh, mm.
        spec: with a target, or without one: then nothing is sought.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages; the wall is found once.
        meshed: whether its result is made and measured; otherwise the radius is the first one,
            as for beams.
        executor: as of `Infill`.
        streamed: as of `Infill`.

    Raises:
        VolfrepError: no radius meets the target (the text says what can be had), or the
            specification does not fit the solid.
        Cancelled: the callback said so.
    """
    cache = cache or StageCache()
    made_of = partial(Infill, solid, cache=cache, executor=executor, streamed=streamed)
    infill = made_of(spec, progress=progress)
    target = spec.target
    if target is None or spec.output == "domain":
        return infill
    if target.aim == "stiffness":
        return made_of(infill.kind.stiffened(target), progress=progress)
    search = infill.filling.search(target)

    def make(volume: float) -> Infill:
        return made_of(search.specification(volume), monitor=infill.monitor)

    def measure(made: Infill) -> Report:
        return made.result.report

    return make_with_volume(make, measure if meshed else None, search.wanted)


def fill_with_target(
    solid: TriangleMesh | Solid,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    executor: Executor | None = None,
) -> tuple[Result, LatticeSpec]:
    """The result of `solve_target`, and the specification with the radius that was found."""
    infill = solve_target(solid, spec, progress=progress, cache=cache, executor=executor)
    return infill.result, infill.spec


def solve_block_target(
    spec: LatticeSpec,
    count: Sequence[int],
    *,
    progress: ProgressCallback | None = None,
    meshed: bool = True,
    tell: Callable[[LatticeSpec], None] | None = None,
) -> BlockLattice:
    """A block with the radius of its target, as it was measured last; see `solve_target`.

    Args:
        spec: with a target, or without one: then it is that of the block.
        count: cells along x, y, z.
        progress: called with the fraction done and the stage; returning False cancels.
        meshed: whether its octants, or the mesh of a graded block, are made and measured;
            otherwise the radius is the first one, as for beams.
        tell: called with a radius each time before that is meshed.

    Raises:
        VolfrepError: as `solve_target`.
    """
    target = spec.target
    kind = lattice_kind(spec)
    block = kind.block(count)
    if target is None:
        return block
    if target.aim == "stiffness":
        stiffened = kind.stiffened(target)
        if tell is not None:
            tell(stiffened)
        return lattice_kind(stiffened).block(count)
    search = block.search(target)

    def make(volume: float) -> BlockLattice:
        tried = search.specification(volume)
        if tell is not None:
            tell(tried)
        return lattice_kind(tried).block(count)

    def measure(made: BlockLattice) -> Report:
        return made.measured(Monitor(progress))

    return make_with_volume(make, measure if meshed else None, search.wanted)
