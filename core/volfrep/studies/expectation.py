# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a design will come to without a mesh: mass and density beside the forecast of the job."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from ..design.forecast import Forecast, forecast_fill
from ..design.spec import LatticeSpec
from ..jobs.preview import PartDepth, preview
from ..jobs.rough_radius import solve_target_roughly
from ..jobs.stiffness_target import ratio_of_stiffness
from ..mechanics.catalogue import known_cell
from ..mechanics.density import radius_of_density, relative_density
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
    spec = solve_design_roughly(spec, inside, skin)
    if spec.is_graded and spec.output != "domain":
        share = preview(solid, spec, depth).relative_density
    else:
        share = density_of(spec)
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


def solve_design_roughly(spec: LatticeSpec, inside: float, skin: float) -> LatticeSpec:
    """The specification with the radius that the endless lattice has at its target.

    Args:
        spec: with a target, or without one: then it is returned as it is.
        inside: volume of what the lattice fills, mm3.
        skin: volume of the skin, mm3.

    Raises:
        VolfrepError: no radius meets the target.
    """
    target, size = spec.target, spec.cell_size
    if target is None or spec.output == "domain":
        return spec
    cell, fillet = spec.unit_cell(), spec.fillet / size
    if target.aim == "stiffness":
        ratio = ratio_of_stiffness(cell, target, fillet)
    else:
        share = target.value
        if target.aim == "mass":
            share = (target.value * 1000.0 / spec.density - skin) / inside
            if not 0.0 < share < 1.0:
                least, most = (v * spec.density / 1000.0 for v in (skin, skin + inside))
                raise VolfrepError(
                    f"A mass of {target.value:.4g} g is out of reach: choose one between "
                    f"{least:.4g} and {most:.4g} g."
                )
        known = None if fillet else known_cell(cell)
        if known is not None and known.values[0, 0] <= share <= known.values[-1, 0]:
            ratio = known.ratio_of_density(share)
        else:
            ratio = radius_of_density(cell, share, fillet)
    return dataclasses.replace(spec, strut_radius=ratio * size, target=None)


def density_of(spec: LatticeSpec) -> float:
    """The relative density of the endless lattice of a specification's cell and radius."""
    cell, ratio = spec.unit_cell(), spec.strut_radius / spec.cell_size
    known = None if spec.fillet else known_cell(cell)
    if known is not None and known.ratios[0] <= ratio <= known.ratios[-1]:
        return known.at(ratio)["relative_density"]
    return relative_density(cell, ratio, spec.fillet / spec.cell_size).value


def plan(solid: TriangleMesh, spec: LatticeSpec) -> Forecast:
    """What the job will come to, for the planning of many: nothing is sampled."""
    try:
        spec = solve_target_roughly(solid, spec)
    except VolfrepError:
        return forecast_fill(solid, spec)  # the run itself will say that no radius meets the target
    return forecast_fill(solid, spec)
