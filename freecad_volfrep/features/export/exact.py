# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill with exact surfaces: what it is made of, what it will take, its shape."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.infill.lattice_infill import is_infill
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.sentences import report_line
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from freecad_volfrep.bridge.worker_calls import ExactJob
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


def infill_made_of(obj: App.DocumentObject) -> tuple[TriangleMesh, LatticeSpec, StageCache]:
    """What the present mesh of an infill was made of: the solid, the specification, the cache.

    Raises:
        VolfrepError: that is no lattice infill, or it is out of date.
    """
    require_engine()
    if not is_infill(obj):
        raise VolfrepError(f"'{obj.Label}' is a mesh without struts: choose a lattice infill.")
    made: tuple[TriangleMesh, LatticeSpec, StageCache] = obj.Proxy.inputs(obj)
    return made


def inputs_of(obj: App.DocumentObject) -> tuple[TriangleMesh, LatticeSpec, StageCache]:
    """An infill's solid, specification and cache, for files that are made of its struts.

    Raises:
        VolfrepError: as `infill_made_of`, or it holds no bare struts.
    """
    solid, spec, cache = infill_made_of(obj)
    if spec.output == "domain":
        raise VolfrepError(f"'{obj.Label}' holds no lattice: set its Output to part or lattice.")
    if spec.fillet > 0:
        raise VolfrepError(
            f"Struts alone have no fillets between them: set the JointFillet of '{obj.Label}' to "
            "0, or take its mesh."
        )
    return solid, spec, cache


def ingredients_of(obj: App.DocumentObject) -> Ingredients:
    """What an infill with exact surfaces is made of.

    Raises:
        VolfrepError: as `inputs_of`.
        Cancelled: in the window, by the user.
    """
    solid, spec, cache = inputs_of(obj)
    from volfrep.jobs.beam_part import exact_struts
    from volfrep.trim.beam_model import deformed_struts

    title = job_title("Struts of {label}", obj)
    lattice, domain = run_job(title, exact_struts, solid, spec, cache=cache)
    warnings = deformed_struts(spec.grid, spec.struts, "Exact struts")
    return Ingredients(spec, lattice, solid, domain, warnings)


def estimate_of(made_of: Ingredients) -> Estimate:
    """What the exact infill will take.

    Raises:
        VolfrepError: absurdly much; the text names the nearest cell size that fits.
    """
    from volfrep.reports.estimate import ExportChoice, estimate_exact

    cut = made_of.domain is not None
    return estimate_exact(made_of.lattice, ExportChoice(made_of.spec), trimmed=cut)


def checked_ingredients(obj: App.DocumentObject) -> Ingredients:
    """What an exact infill is made of, if that is not absurdly much.

    Raises:
        VolfrepError: as `inputs_of` and `estimate_of`.
        Cancelled: in the window, by the user.
    """
    made_of = ingredients_of(obj)
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
    from freecad_volfrep.bridge.worker_calls import packed_exact, unpack

    job = exact_job(obj, made_of)
    shape = unpack(run_job(exact_title(obj), packed_exact, job, in_freecad=True))
    warn(obj, made_of.warnings)
    shape.Placement = place_in_document(obj).multiply(shape.Placement)
    return shape


def exact_title(obj: App.DocumentObject) -> str:
    """What making exact surfaces is called in the window."""
    return job_title("Exact surfaces of {label}", obj)


def exact_job(obj: App.DocumentObject, made_of: Ingredients) -> ExactJob:
    """The infill as FreeCAD is given it in a process of its own.

    Raises:
        VolfrepError: its struts are not what exact ones would be.
    """
    from freecad_volfrep.bridge.trimmed import base_shape
    from freecad_volfrep.bridge.worker_calls import ExactJob, pack
    from volfrep.reports.estimate import refuse_inexact

    refuse_inexact(made_of.spec)
    base = None if made_of.domain is None else base_shape(obj.Base, obj)
    skin = made_of.spec.skin
    return ExactJob(
        made_of.lattice,
        made_of.solid,
        made_of.domain,
        None if base is None else pack(base),
        # A bush round a hole is too little of the volume for the wall's check to see.
        made_of.spec.shell if skin is None or skin.is_even else None,
        made_of.with_skin,
        expected_volume(obj, made_of),
    )


def expected_volume(obj: App.DocumentObject, made_of: Ingredients) -> float | None:
    """The mesh's, mm3; None where deformed struts measure something else as a mesh."""
    return None if made_of.warnings else float(obj.Volume.Value)


def warn(obj: App.DocumentObject, sentences: tuple[str, ...]) -> None:
    """Say something about an object in the report view."""
    for sentence in sentences:
        App.Console.PrintWarning(report_line(obj.Label, sentence))
