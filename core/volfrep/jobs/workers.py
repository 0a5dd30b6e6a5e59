# SPDX-License-Identifier: LGPL-2.1-or-later
"""The worker processes of fills: how many a lattice is worth, and those that stay for the next one.

A job of its own, such as the command's, starts them for itself (`process.pool.processes`).
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ..design.memory_guard import free_memory
from ..process.kept_pool import KeptPool
from ..process.worker import Ending
from ..util.errors import VolfrepError
from ..util.threads import threads

if TYPE_CHECKING:
    from ..design.forecast import Forecast
    from ..design.spec import LatticeSpec
    from ..mesh.triangle_mesh import TriangleMesh

#: Every so many triangles are worth a process that helps to make them.
WORTH_WORKER = 150_000
#: What a worker takes of the memory beside the fill, bytes: 0.13 to 0.17 GB were measured.
WORKER_BYTES = 0.2e9
#: Of no more triangles and with so much free memory, bytes, a fill that nobody is told of needs no
#: forecast, which takes 0.1 s: without its seams it comes to as many processes or a fifth fewer.
FEW_TRIANGLES, MUCH_MEMORY = 3_000_000, 8e9
#: Where what workers are given lies.
MODULES = (
    "volfrep.trim.boolean_trim", "volfrep.octants.octant_mesh", "volfrep.io.write.stl",
    "scipy.spatial",
)  # fmt: skip

_kept = KeptPool(MODULES)


def worth_processes(spec: LatticeSpec, expected: Forecast) -> int:
    """How many processes a fill is worth, this one among them: at most one a core.

    Nor more than the memory that is free has room for, beside what the fill takes itself.
    """
    room = (free_memory() - 1e9 * expected.memory_gb) // WORKER_BYTES
    return min(_worth(spec, expected.triangles), 1 + max(int(room), 0))


def worth_untold(spec: LatticeSpec, solid: TriangleMesh, *, streamed: bool) -> int:
    """As `worth_processes`, where nobody is told the forecast; `streamed` as of that."""
    from ..design.forecast import expected_triangles, forecast_fill

    if not _is_shared(spec):
        return 1
    skin = 0.0 if spec.skin is None else spec.skin.rough_volume(solid)
    triangles = expected_triangles(spec, max(abs(solid.volume) - skin, 0.0))
    if triangles > FEW_TRIANGLES or free_memory() < MUCH_MEMORY:
        return worth_processes(spec, forecast_fill(solid, spec, streamed=streamed))
    return _worth(spec, triangles)


def worth_head_start(spec: LatticeSpec, mesh: TriangleMesh) -> bool:
    """Whether a part is so large that others will help, before it is known to be a solid.

    It is seldom wrong: where the skin leaves less, or the mesh is no solid.
    """
    if spec.target is not None:  # how thick it will be is not known yet
        return False
    from ..design.forecast import expected_triangles

    triangles = expected_triangles(spec, abs(mesh.volume))
    return _worth(spec, triangles) > 1 and free_memory() > WORKER_BYTES


def _worth(spec: LatticeSpec, triangles: float) -> int:
    return min(threads(), 1 + int(triangles) // WORTH_WORKER) if _is_shared(spec) else 1


def _is_shared(spec: LatticeSpec) -> bool:
    """Whether there is work for others."""
    return spec.kind.is_cut_in_groups and spec.output != "domain"


@contextmanager
def kept_workers(count: int) -> Iterator[Executor | None]:
    """So many processes for a fill, this one among them, which stay for the next; None for one.

    Raises:
        VolfrepError: fewer than one is wanted.
    """
    if count < 1:
        raise VolfrepError(f"At least 1 worker is needed, not {count}.")
    with _kept.lent(count, _warn_lost) as executor:
        yield executor


def end_kept_workers() -> None:
    """Let go of those that no fill uses now."""
    _kept.end()


def lost_worker(ending: Ending) -> str:
    """What is said of a worker that has ended; what it did is done again."""
    return f"A worker has ended {ending}: the others go on."


def _warn_lost(ending: Ending) -> None:
    warnings.warn(lost_worker(ending), RuntimeWarning, stacklevel=2)
