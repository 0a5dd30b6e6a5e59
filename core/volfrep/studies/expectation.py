# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a design will come to without a mesh: mass and density beside the forecast of the job."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from ..design.forecast import Forecast, forecast_fill
from ..design.spec import LatticeSpec
from ..jobs.preview import PartDepth, preview
from ..jobs.rough_radius import (
    endless_bare,
    endless_density,
    radius_of_target,
    solve_target_roughly,
)
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError


@dataclass(frozen=True)
class Expectation:
    """What a design will come to, about.

    Attributes:
        forecast: of the job.
        strut_radius: mm; of a target the endless lattice's, of a graded radius a mean; half the
            thickness of a sheet, and 0 for one side of a surface.
        relative_density: of the lattice in what it fills.
        volume_mm3: of the finished part, within a few percent.
        mass_g: the same.
    """

    forecast: Forecast
    strut_radius: float
    relative_density: float
    volume_mm3: float
    mass_g: float


def expect(solid: TriangleMesh, spec: LatticeSpec, depth: PartDepth) -> Expectation:
    """What a design will come to.

    The volume within the skin is sampled (`preview.PartDepth`), the density that of the endless
    lattice, or where cells or radii vary the preview's.

    Args:
        solid: checked closed mesh, mm.
        spec: what to make.
        depth: of that solid, with the specification's open faces.

    Raises:
        VolfrepError: no radius meets the target, or the part is nowhere thicker than its skin.
    """
    inside = depth.volume_below(spec.shell)
    if inside <= 0.0:
        raise VolfrepError(
            f"The part is nowhere thicker than two walls of {spec.shell:g} mm, so that nothing is "
            "left to fill: reduce the shell thickness."
        )
    skin = spec.skin_volume(solid.volume, inside)
    if spec.output != "domain" and (spec.surface is not None or spec.network is not None):
        return _expected_otherwise(solid, spec, depth)
    if spec.target is not None and spec.output != "domain":
        radius = radius_of_target(spec, endless_bare(spec, inside), inside, skin)
        spec = dataclasses.replace(spec, strut_radius=radius, target=None)
    if spec.is_graded and spec.output != "domain":
        share = preview(solid, spec, depth).relative_density
    else:
        size = spec.cell_size
        share = endless_density(spec.unit_cell(), spec.strut_radius / size, spec.fillet / size)
    volume = inside if spec.output == "domain" else skin + share * inside
    return Expectation(
        forecast_fill(solid, spec),
        spec.strut_radius if spec.radius_grading is None else spec.template_radius,
        share,
        volume,
        volume * spec.density / 1000.0,
    )


def _expected_otherwise(solid: TriangleMesh, spec: LatticeSpec, depth: PartDepth) -> Expectation:
    """What walls or a network will come to: the preview's figures, with its thickness or radius."""
    shown = preview(solid, spec, depth)
    made = shown.spec
    radius = made.template_radius
    if made.surface is not None:
        radius = 0.25 * sum(made.thicknesses)
    return Expectation(
        forecast_fill(solid, made), radius, shown.relative_density, shown.volume, shown.mass
    )


def plan(solid: TriangleMesh, spec: LatticeSpec) -> Forecast:
    """What the job will come to, for the planning of many: nothing is sampled."""
    try:
        spec = solve_target_roughly(solid, spec)
    except VolfrepError:
        return forecast_fill(solid, spec)  # the run itself will say that no radius meets the target
    return forecast_fill(solid, spec)
