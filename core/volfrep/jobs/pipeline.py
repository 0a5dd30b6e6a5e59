# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the whole job in one call: offset, activate, mesh, trim, join.

The stages are those of `volfrep.jobs.infill.Infill`, which computes any of them alone.
"""

from __future__ import annotations

import hashlib
from concurrent.futures import Executor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..design.forecast import Forecast, forecast_fill
from ..design.spec import LatticeSpec
from ..io.solid import check_solid
from ..mesh.display_parts import DrawnPart, drawn_parts, facets_with_neighbours
from ..mesh.triangle_mesh import TriangleMesh
from ..reports.facet_roles import OUTSIDE, kinds_of_triangles
from ..reports.report import Report
from ..reports.result import Result
from ..util.cache import Kept, StageCache
from ..util.content import content_of
from ..util.progress import ProgressCallback
from .kinds import lattice_kind
from .targets import fill_with_target
from .workers import kept_workers, worth_processes


def fill(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    executor: Executor | None = None,
) -> Result:
    """Fill a solid with a lattice: the stage of `Infill` that the specification's output names.

    Where the specification has a target, its radius is found first (`targets`).

    Args:
        solid: checked closed mesh (from `volfrep.io.solid.read_solid` or `check_solid`), mm;
            what they repaired goes into the report's warnings.
        spec: what to make.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages' results between runs.
        executor: cuts the lattice at the wall, group by group; None: in this process.

    Raises:
        VolfrepError: the specification does not fit the solid; the text says what to change.
        Cancelled: the callback said so.
    """
    return fill_with_target(solid, spec, progress=progress, cache=cache, executor=executor)[0]


class FilledMesh(NamedTuple):
    """A filled part as whoever shows it wants it.

    Attributes:
        mesh: of all of it.
        report: the figures.
        kinds: (t,) uint8, what each triangle is: see `reports.facet_roles`.
        digest: of the triangles, see `triangles_digest`.
        shown: what a window draws at once; None: not asked for.
    """

    mesh: TriangleMesh
    report: Report
    kinds: NDArray[np.uint8]
    digest: bytes
    shown: ShownMesh | None


class ShownMesh(NamedTuple):
    """What the window's thread would need seconds for.

    Attributes:
        facets: (t, 6) uint32, triangles and their neighbours: see `mesh.display_parts`.
        parts: what is drawn.
        is_coarse: whether that is a proxy, because the mesh has too many triangles.
    """

    facets: NDArray[np.uint32]
    parts: tuple[DrawnPart, ...]
    is_coarse: bool


def filled_mesh(
    solid: TriangleMesh,
    name: str,
    spec: LatticeSpec,
    *,
    show: tuple[int, int] | None = None,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    executor: Executor | None = None,
) -> FilledMesh:
    """Check a solid, fill it, make one mesh of the result, and tell its triangles apart.

    Args:
        solid: as it came, mm.
        name: of the solid, for sentences about what is wrong with it.
        spec: what to make.
        show: what is drawn is wanted too: up to how many triangles as they are, and of how many
            for each kind of them where there are more.
        progress: as of `fill`.
        cache: as of `fill`.
        executor: as of `fill`.

    Raises:
        VolfrepError: as `check_solid` and `fill`.
        Cancelled: the callback said so.
    """
    cache = cache or StageCache()
    came = Kept(solid, content_of(solid.vertices, solid.triangles))
    checked = cache.run("checked", check_solid, came, name).value
    result = fill(checked, spec, progress=progress, cache=cache, executor=executor)
    mesh = result.mesh
    kinds = kinds_of_triangles(mesh, checked, spec)
    shown = None if show is None else _display_mesh(mesh, kinds, *show)
    return FilledMesh(mesh, result.report, kinds, triangles_digest(mesh), shown)


def forecast_and_fill(
    solid: TriangleMesh,
    name: str,
    spec: LatticeSpec,
    *,
    most: float | None = None,
    show: tuple[int, int] | None = None,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> tuple[Forecast, FilledMesh | None]:
    """What a solid's part will come to, and as `filled_mesh` unless that is too much.

    Workers help with what is worth some, and stay for the next call (`jobs.workers`).

    Args:
        solid: as it came, mm.
        name: of the solid.
        spec: what to make.
        most: expected triangles above which nothing is made; None: it is made in any case.
        show: as of `filled_mesh`.
        progress: as of `fill`.
        cache: as of `fill`.

    Raises:
        VolfrepError: as `filled_mesh`.
        Cancelled: the callback said so.
    """
    cache = cache or StageCache()
    came = Kept(solid, content_of(solid.vertices, solid.triangles))
    # The very mesh of the call before where this is the same: depths and angles are known of that.
    solid = cache.run("solid", _itself, came).value
    forecast = forecast_fill(solid, lattice_kind(spec).roughly_solved(solid))
    if most is not None and forecast.triangles > most:
        return forecast, None
    with kept_workers(worth_processes(spec, forecast)) as executor:
        filled = filled_mesh(
            solid, name, spec, show=show, progress=progress, cache=cache, executor=executor
        )
    return forecast, filled


def _itself(solid: TriangleMesh) -> TriangleMesh:
    """The mesh, as a stage."""
    return solid


def _display_mesh(
    mesh: TriangleMesh, kinds: NDArray[np.uint8], most: int, proxy_triangles: int
) -> ShownMesh:
    is_coarse = len(mesh.triangles) > most
    parts = drawn_parts(mesh, kinds, proxy_triangles if is_coarse else most, (OUTSIDE,))
    return ShownMesh(facets_with_neighbours(mesh), parts, is_coarse)


def triangles_digest(mesh: TriangleMesh) -> bytes:
    """By which a mesh's triangles are known again."""
    return hashlib.blake2b(np.ascontiguousarray(mesh.triangles, np.int32).data).digest()
