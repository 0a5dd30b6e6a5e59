# SPDX-License-Identifier: LGPL-2.1-or-later
"""STEP in three forms: a plane face for every triangle, exact surfaces, axes of struts."""

from __future__ import annotations

import os

from ..io import freecad_process
from ..io.write.step_faceted import write_step_faceted
from ..io.write.step_wireframe import write_step_wireframe
from ..reports.estimate import (
    Estimate,
    estimate_axes,
    estimate_exact,
    estimate_faceted,
    refuse_boundary,
    refuse_inexact,
)
from ..trim.beam_model import deformed_struts
from ..util.errors import VolfrepError
from .form import find_form
from .writer import Settings, Source, Writer, Written, writer_of

PLANE_FACES = "The file holds plane faces instead of exact surfaces."


def plane_faces() -> Writer:
    """What writes instead of exact surfaces."""
    return writer_of(find_form("part.step"))


class FacetedWriter(Writer):
    """A plane face for every triangle."""

    def estimate(self, source: Source) -> Estimate:
        """As of `Writer`."""
        return estimate_faceted(source.triangles, source.choice)

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        settings.tell(self.estimate(source))
        write_step_faceted(source.mesh, path)
        return Written()


class ExactWriter(Writer):
    """Cylinders, cones and spheres by FreeCAD, or plane faces where OpenCASCADE has none."""

    def settle(self, source: Source) -> tuple[Writer, tuple[str, ...]]:
        """Plane faces, before a lattice is meshed, where its wall is too much."""
        made_of = source.exact
        boundaries = [
            boundary for boundary in (made_of.inner, made_of.outer) if boundary is not None
        ]
        try:
            refuse_boundary(max((len(boundary.triangles) for boundary in boundaries), default=0))
        except VolfrepError as error:
            return plane_faces(), (f"{error} {PLANE_FACES}",)
        return self, ()

    def estimate(self, source: Source) -> Estimate:
        """As of `Writer`."""
        exact = source.exact
        return estimate_exact(
            exact.lattice, source.choice, trimmed=exact.inner is not None
        )  # fmt: skip

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        spec, made_of = source.spec, source.exact
        settings.tell(self.estimate(source))
        warnings = deformed_struts(spec.grid, spec.struts, "Exact struts")
        measured = source.volume
        try:
            refuse_inexact(spec)
            volume = freecad_process.write_exact_step(
                made_of.lattice, path, None if warnings else measured,
                inner=made_of.inner, outer=made_of.outer, monitor=source.monitor,
            )  # fmt: skip
        except VolfrepError as error:
            faceted = plane_faces().write(source, path, settings)
            return Written((*faceted.warnings, f"{error} {PLANE_FACES}"))
        row = ("exact volume", f"{volume:,.1f} mm3 (mesh: {measured:,.1f} mm3)")
        return Written(warnings, (row,))


class AxesWriter(Writer):
    """A line for each strut."""

    def estimate(self, source: Source) -> Estimate:
        """As of `Writer`."""
        return estimate_axes(len(source.axes.wireframe.struts), source.choice)

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        axes = source.axes
        frame = axes.wireframe
        settings.tell(estimate_axes(len(frame.struts), source.choice))
        write_step_wireframe(frame, path)
        row = ("struts", f"{len(frame.struts):,} between {len(frame.nodes):,} nodes, as lines")
        return Written(axes.warnings, (row,))
