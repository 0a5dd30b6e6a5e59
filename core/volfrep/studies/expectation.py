# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a design will come to without a mesh: mass and density beside the forecast of the job."""

from __future__ import annotations

from dataclasses import dataclass

from ..design.forecast import Forecast, forecast_fill
from ..design.spec import LatticeSpec
from ..jobs.kinds import lattice_kind
from ..jobs.preview import PartDepth
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError


@dataclass(frozen=True)
class Expectation:
    """What a design will come to, about.

    Attributes:
        forecast: of the job.
        spec: with the thickness of its target.
        relative_density: of the lattice in what it fills.
        volume_mm3: of the finished part, within a few percent.
        mass_g: the same.
    """

    forecast: Forecast
    spec: LatticeSpec
    relative_density: float
    volume_mm3: float
    mass_g: float

    @property
    def strut_radius(self) -> float:
        """mm; of a target about its, of a graded radius a mean; half a sheet's thickness, 0 for one
        side of a surface.
        """
        return self.spec.kind.mean_radius


def expect(solid: TriangleMesh, spec: LatticeSpec, depth: PartDepth) -> Expectation:
    """What a design will come to.

    The volume within the skin is sampled (`preview.PartDepth`), the density as its kind of lattice
    has it (`LatticeKind.expected`).

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
            f"The part is nowhere thicker than two skins of {spec.shell:g} mm, so that nothing is "
            "left to fill: reduce the skin thickness."
        )
    found = lattice_kind(spec).expected(solid, depth)
    volume = inside if spec.output == "domain" else found.volume
    return Expectation(
        forecast_fill(solid, found.spec), found.spec, found.relative_density, volume,
        volume * spec.density / 1000.0,
    )  # fmt: skip


def plan(solid: TriangleMesh, spec: LatticeSpec) -> Forecast:
    """What the job will come to, for the planning of many: nothing is sampled."""
    try:
        spec = lattice_kind(spec).roughly_solved(solid)
    except VolfrepError:
        return forecast_fill(solid, spec)  # the run itself will say that no radius meets the target
    return forecast_fill(solid, spec)
