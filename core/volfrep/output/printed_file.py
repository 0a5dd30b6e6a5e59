# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part as a printer's or a service's file is to have it: compensated, within limits."""

from __future__ import annotations

from dataclasses import dataclass

from ..design.as_printed import find_printed_table
from ..design.file_limits import FileLimits
from ..design.spec import LatticeSpec
from ..io.solid import Solid
from ..jobs.as_printed import compensated
from ..jobs.targets import solve_target
from ..mesh.triangle_mesh import TriangleMesh
from ..util.cache import StageCache
from ..util.progress import ProgressCallback
from .file_size import fill_within
from .form import find_form
from .sources import FilledPart


@dataclass(frozen=True, eq=False)
class PrintedFile:
    """What a file is to hold.

    Attributes:
        mesh: closed, mm.
        notes: what limits and compensation have cost, for the user.
    """

    mesh: TriangleMesh
    notes: tuple[str, ...]


def fill_for_printer(
    solid: Solid,
    spec: LatticeSpec,
    limits: FileLimits,
    suffix: str,
    *,
    compensate: str | None = None,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
    cache: StageCache | None = None,
    progress: ProgressCallback | None = None,
) -> PrintedFile:
    """Fill a part so that its file keeps within limits and its struts come out as asked for.

    Args:
        solid: the checked part.
        spec: what is wanted.
        limits: of the file.
        suffix: of a mesh format, such as ``.stl``.
        compensate: name of a table of printed diameters, or a file of one's own; None for none.
        build_direction: from the build plate up, in the part's coordinates.
        cache: keeps the stages between calls.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: limits or the table cannot be kept, or as `solve_target`.
        Cancelled: the callback said so.
    """
    notes = []
    cache = StageCache() if cache is None else cache
    if compensate is not None:
        spec, note = compensated(spec, find_printed_table(compensate), build_direction)
        notes.append(note)

    def make(wanted: LatticeSpec) -> FilledPart:
        return FilledPart(solve_target(solid, wanted, progress=progress, cache=cache), cache)

    made, kept = fill_within(solid, spec, limits, find_form(f"part{suffix}"), make)
    return PrintedFile(made.mesh, (*notes, *kept))
