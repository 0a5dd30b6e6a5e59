# SPDX-License-Identifier: LGPL-2.1-or-later
"""How large a mesh's file is, found by writing it where nobody sees it, and files within limits."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from ..design.costs import FILE_BYTES
from ..design.file_limits import FileLimits
from ..design.forecast import forecast_fill
from ..design.spec import LatticeSpec
from ..jobs.file_limits import fit_within
from ..jobs.kinds import lattice_kind
from ..mesh.triangle_mesh import TriangleMesh
from .form import Form
from .writer import Settings, Source, writer_of

S = TypeVar("S", bound=Source)


def written_size(source: Source, form: Form) -> float:
    """Size of the file of a form, in millions of bytes.

    Raises:
        VolfrepError: as the form's writer.
    """
    if form.name == "stl":
        return (84 + 50 * source.triangles) / 1e6
    with tempfile.TemporaryDirectory(prefix="volfrep-") as folder:
        path = Path(folder) / f"part{form.suffixes[0]}"
        writer_of(form).write(source, path, Settings())
        return path.stat().st_size / 1e6


def keep_within(
    spec: LatticeSpec,
    limits: FileLimits,
    form: Form,
    expect: Callable[[LatticeSpec], float],
    make: Callable[[LatticeSpec], S],
) -> tuple[S, tuple[str, ...]]:
    """What has facets as fine as limits of its file let them be, if there are any.

    Args:
        spec: what is wanted.
        limits: of the file.
        form: of it.
        expect: about how many triangles a specification has, such as `filled_triangles`.
        make: makes one.

    Returns:
        What `make` has made, and what the limits have cost, for the user.

    Raises:
        VolfrepError: as of `fit_within`.
    """
    if not limits:
        return make(spec), ()

    def tried(spec: LatticeSpec) -> tuple[S, int, float]:
        made = make(spec)
        size = written_size(made, form) if limits.megabytes is not None else 0.0
        return made, made.triangles, size

    found = fit_within(spec, limits, expect, tried, FILE_BYTES[form.name])
    return found.made, (found.note,) if found.note else ()


def fill_within(
    solid: TriangleMesh,
    spec: LatticeSpec,
    limits: FileLimits,
    form: Form,
    make: Callable[[LatticeSpec], S],
) -> tuple[S, tuple[str, ...]]:
    """The same of a filled solid.

    Raises:
        VolfrepError: as of `fit_within`.
    """
    return keep_within(spec, limits, form, filled_triangles(solid), make)


def filled_triangles(solid: TriangleMesh) -> Callable[[LatticeSpec], float]:
    """What tells about how many triangles a solid has that a specification fills."""

    def expect(spec: LatticeSpec) -> float:
        return forecast_fill(solid, lattice_kind(spec).roughly_solved(solid)).triangles

    return expect
