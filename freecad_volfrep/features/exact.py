# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill with exact surfaces: what it is made of, what it will take, its shape."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from volfrep.util.errors import VolfrepError

from .lattice_infill import LatticeInfill
from .progress import job_title, progress_of

if TYPE_CHECKING:
    from volfrep.design.spec import LatticeSpec
    from volfrep.grid.strut_graph import Wireframe
    from volfrep.mesh.triangle_mesh import TriangleMesh
    from volfrep.reports.estimate import Estimate
    from volfrep.util.cache import StageCache


@dataclass(frozen=True, eq=False)
class Ingredients:
    """What an exact infill is made of, in the infill's coordinates, mm.

    Attributes:
        spec: the specification.
        lattice: struts that reach into what the lattice fills.
        solid: the base as a mesh.
        domain: what the lattice fills, as a mesh; None where no wall cuts it.
        warnings: sentences for the user.
    """

    spec: LatticeSpec
    lattice: Wireframe
    solid: TriangleMesh
    domain: TriangleMesh | None
    warnings: tuple[str, ...]

    @property
    def with_skin(self) -> bool:
        """Whether skin and lattice are one part."""
        return self.domain is not None and self.spec.with_skin


def inputs_of(obj: App.DocumentObject) -> tuple[TriangleMesh, LatticeSpec, StageCache]:
    """An infill's solid, specification and cache, for files that are made of its struts.

    Raises:
        VolfrepError: that is no lattice infill, it is out of date, or holds no bare struts.
    """
    require_engine()
    if not isinstance(getattr(obj, "Proxy", None), LatticeInfill):
        raise VolfrepError(f"'{obj.Label}' is a mesh without struts: choose a lattice infill.")
    solid, spec, cache = obj.Proxy.inputs(obj)
    if spec.output == "domain":
        raise VolfrepError(f"'{obj.Label}' holds no lattice: set its Output to part or lattice.")
    if spec.fillet > 0:
        raise VolfrepError(
            f"Struts alone have no fillets between them: set the JointFillet of '{obj.Label}' to "
            "0, or take its mesh."
        )
    return solid, spec, cache


def ingredients_of(obj: App.DocumentObject, progress: Any = None) -> Ingredients:
    """What an infill with exact surfaces is made of.

    Raises:
        VolfrepError: as `inputs_of`.
        Cancelled: in the window, by the user.
    """
    solid, spec, cache = inputs_of(obj)
    from volfrep.jobs.targets import infill_of
    from volfrep.trim.beam_model import deformed_struts

    infill = infill_of(solid, spec, progress=progress, cache=cache)
    lattice = infill.lattice_beams.lattice
    domain = infill.cavity if spec.is_cut else None
    warnings = deformed_struts(spec.grid, spec.struts, "Exact struts")
    return Ingredients(spec, lattice, solid, domain, warnings)


def estimate_of(made_of: Ingredients) -> Estimate:
    """What the exact infill will take.

    Raises:
        VolfrepError: absurdly much; the text names the nearest cell size that fits.
    """
    from volfrep.reports.estimate import Asked, estimate_exact

    cut = made_of.domain is not None
    return estimate_exact(made_of.lattice, Asked(made_of.spec), trimmed=cut)


def checked_ingredients(obj: App.DocumentObject) -> Ingredients:
    """What an exact infill is made of, if that is not absurdly much.

    Raises:
        VolfrepError: as `inputs_of` and `estimate_of`.
        Cancelled: in the window, by the user.
    """
    with progress_of(job_title("Struts of {label}", obj)) as progress:
        made_of = ingredients_of(obj, progress)
    estimate_of(made_of)
    return made_of


def exact_shape(obj: App.DocumentObject, made_of: Ingredients) -> Any:
    """The infill as a solid, or a compound of solids, where it lies in the document.

    Raises:
        VolfrepError: OpenCASCADE does not manage it, or makes something of another volume than
            the mesh's.
        Cancelled: in the window, by the user.
    """
    from freecad_volfrep.bridge.beams import place_in_document

    with progress_of(job_title("Exact surfaces of {label}", obj)) as progress:
        shape = _shape(obj, made_of, progress)
    warn(obj, made_of.warnings)
    shape.Placement = place_in_document(obj).multiply(shape.Placement)
    return shape


def expected_volume(obj: App.DocumentObject, made_of: Ingredients) -> float | None:
    """The mesh's, mm3; None where deformed struts measure something else as a mesh."""
    return None if made_of.warnings else float(obj.Volume.Value)


def walls_of(obj: App.DocumentObject, made_of: Ingredients) -> tuple[Any, Any]:
    """The inner and the outer wall as solids; None for the outer one where there is no skin.

    Raises:
        VolfrepError: OpenCASCADE's offset does not agree with the mesh's wall, and that has too
            many triangles.
    """
    from freecad_volfrep.bridge.trimmed import base_solid, offset_wall, plane_wall

    assert made_of.domain is not None
    base = base_solid(obj.Base, obj, made_of.solid)
    inner = None
    skin = made_of.spec.skin
    if base is not None and (skin is None or skin.is_even):
        # A bush round a hole is too little of the volume for the wall's check to see.
        inner = offset_wall(base, made_of.spec.shell, made_of.domain)
    if inner is None:
        inner = plane_wall(made_of.domain)
    if not made_of.with_skin:
        return inner, None
    return inner, plane_wall(made_of.solid) if base is None else base


def warn(obj: App.DocumentObject, sentences: tuple[str, ...]) -> None:
    """Say something about an object in the report view."""
    for sentence in sentences:
        App.Console.PrintWarning(f"VOLFREP, {obj.Label}: {sentence}\n")


def _shape(obj: App.DocumentObject, made_of: Ingredients, progress: Any) -> Any:
    from freecad_volfrep.bridge.exact import exact_lattice
    from freecad_volfrep.bridge.trimmed import check_volume, exact_part
    from volfrep.reports.estimate import refuse_inexact
    from volfrep.util.progress import Monitor

    refuse_inexact(made_of.spec)
    expected = expected_volume(obj, made_of)
    monitor = Monitor(progress)
    if made_of.domain is not None:
        return exact_part(made_of.lattice, *walls_of(obj, made_of), expected, monitor)
    shape = exact_lattice(made_of.lattice, monitor)
    if expected is not None:
        check_volume(shape.Volume, expected)
    return shape
