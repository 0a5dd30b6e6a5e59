# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a command that makes a lattice was asked for: read once from argparse, and frozen.

Everything that can be refused before any work is refused here. Fields that are called as an option
hold what its row in `run_options` says. numpy and the engine are imported inside the functions, as
in `command`.
"""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..output.form import Form, find_form, suffixes_of
from ..util.errors import VolfrepError, listed
from .files import check_files
from .parameter_options import Specified, specified, values_to_keep
from .run_options import refuse_extensions
from .telling import print_warnings

if TYPE_CHECKING:
    from ..design.as_printed import PrintedTable
    from ..design.file_limits import FileLimits
    from ..design.spec import LatticeSpec
    from ..jobs.sizing import Building, Printing
    from ..mechanics.materials import Material, SolidMaterial
    from ..reports.processes import Process

#: The files that a material of a solver's own goes into.
DECK = "inp"


@dataclass(frozen=True)
class Kept:
    """A specification to write when all is done.

    Attributes:
        values: of parameters.
        path: of the file.
    """

    values: Mapping[str, Any]
    path: str

    def write(self) -> None:
        """Write it."""
        from ..design.parameters.spec_file import write_values

        write_values(dict(self.values), self.path)


@dataclass(frozen=True)
class LatticeOptions:
    """What every command that makes a lattice is told.

    Attributes:
        spec: what to make, with the density of the material where none is given.
        kept: the specification in force, where it is to be written.
    """

    spec: LatticeSpec
    output: str
    quiet: bool
    kept: Kept | None


@dataclass(frozen=True)
class MeshOptions(LatticeOptions):
    """What `fill`, `block` and `network` are told beside it.

    Attributes:
        form: of the output.
        process: of the print report; None for none.
        build_direction: of it, from the build plate up.
        material: of a solver's deck.
        limits: of the file.
        printed: how thick struts come out; None where nobody asks.
        notes: sentences for the user, known before anything is made.
    """

    form: Form
    report: str | None
    picture: str | None
    process: Process | None
    build_direction: tuple[float, float, float]
    material: Material
    limits: FileLimits
    printed: PrintedTable | None
    notes: tuple[str, ...]

    @property
    def is_file_alone(self) -> bool:
        """Whether nothing but a file is wanted, which holds a surface without a mesh of it all."""
        return self.form.streamed and self.process is None and self.picture is None


@dataclass(frozen=True)
class FillOptions(MeshOptions):
    """Of `fill`."""

    part: str
    unit: str | None
    workers: int | None
    scheduler: str | None
    bare_surface: bool


@dataclass(frozen=True)
class BlockOptions(MeshOptions):
    """Of `block`.

    Attributes:
        count: cells along x, y, z.
    """

    count: tuple[int, int, int]


@dataclass(frozen=True)
class SliceOptions(LatticeOptions):
    """Of `slice`; `form` is that of the layers."""

    part: str
    unit: str | None
    form: Form
    layer: float
    pixel: float | None


@dataclass(frozen=True)
class SizeOptions(LatticeOptions):
    """Of `size`.

    Attributes:
        form: of the output.
        goal: what is wanted, by its names in `jobs.sizing.GOALS`.
        solid: the part becomes solid where no skin is enough.
        building: how the part is built; None where it does not count.
        printing: how struts come out; None where they are taken as drawn.
        prove: whether CalculiX solves the final design.
        prove_file: whether the finished file is solved as a solid.
        limits: of the file, kept by coarser facets.
    """

    part: str
    unit: str | None
    form: Form
    loads: str
    goal: Mapping[str, float | None]
    remove_thin: bool
    solid: bool
    radius_list: tuple[float, ...]
    symmetry: str | None
    printing: Printing | None
    building: Building | None
    steps: int
    prove: bool
    prove_file: bool
    voxel: float | None
    radii: str | None
    thickness: str | None
    limits: FileLimits
    write_spec: str | None
    report: str | None
    plot: str | None
    picture: str | None
    colour: str
    case: str | None
    deformed: float


def fill_options(given: argparse.Namespace) -> FillOptions:
    """What `fill` is asked for.

    Raises:
        VolfrepError: it makes no sense, or could not be written.
    """
    common = _mesh_options(given, specified(given))
    if given.bare_surface:
        _refuse_of_solids(given)
    return FillOptions(
        **common, part=given.part, unit=given.unit, workers=given.workers,
        scheduler=given.scheduler, bare_surface=given.bare_surface,
    )  # fmt: skip


def _refuse_of_solids(given: argparse.Namespace) -> None:
    """Refuse, beside a bare surface, what is made or told of a solid."""
    asked = {
        "report": given.report, "picture": given.picture, "print-report": given.print_report,
        "as-printed": given.as_printed, "max-triangles": given.max_triangles,
        "max-size": given.max_size, "service": given.service, "3mf": given.threemf,
    }  # fmt: skip
    for name, value in asked.items():
        if value is not None:
            raise VolfrepError(
                f"--{name} is of a solid, and --bare-surface writes an open surface: leave one out."
            )


def block_options(given: argparse.Namespace) -> BlockOptions:
    """What `block` is asked for; see `fill_options`."""
    return BlockOptions(**_mesh_options(given, specified(given)), count=given.count)


def network_options(given: argparse.Namespace) -> MeshOptions:
    """What `network` is asked for; see `fill_options`."""
    found = specified(given, {"network": "file", "network_file": given.file})
    return MeshOptions(**_mesh_options(given, found))


def slice_options(given: argparse.Namespace) -> SliceOptions:
    """What `slice` is asked for; see `fill_options`."""
    found = specified(given)
    solid = _solid_material(given.material)
    if solid is not None and "," in given.material:
        raise _no_density(given.output)
    check_files(given, found.files, folder=True)
    return SliceOptions(
        **_lattice_options(given, found, solid), part=given.part, unit=given.unit,
        form=find_form(given.output, given.format), layer=given.layer, pixel=given.pixel,
    )  # fmt: skip


def size_options(given: argparse.Namespace) -> SizeOptions:
    """What `size` is asked for; see `fill_options`."""
    from ..jobs.sizing import GOALS
    from ..output.meshes import mesh_form

    found = specified(given)
    if given.write_spec is not None and given.radii is None:  # which the specification names
        radii = str(Path(given.write_spec).with_suffix(".radii.csv"))
        given = argparse.Namespace(**{**vars(given), "radii": radii})
    if given.skin_thinnest is None:
        if given.thickness is not None:
            raise VolfrepError(
                "--thickness has no effect without --skin-thinnest: add that or leave it."
            )
    elif given.write_spec is not None and given.thickness is None:
        thickness = str(Path(given.write_spec).with_suffix(".skin.csv"))
        given = argparse.Namespace(**{**vars(given), "thickness": thickness})
    check_files(given, found.files)
    form = mesh_form(given.output)
    if given.picture is not None:
        from ..reports.picture import check_picture

        check_picture(given.picture)
    elif given.colour or given.case or given.deformed is not None:
        raise VolfrepError("--colour, --case and --deformed say what --picture shows: give it.")
    if given.plot is not None:
        from ..reports.sizing_plot import check_plot

        check_plot(given.plot)
    if given.voxel is not None and given.prove is None:
        raise VolfrepError("--voxel is of the file that is solved: give --prove file.")
    if given.steps < 1:
        raise VolfrepError(f"There must be at least one step, not {given.steps}.")
    return SizeOptions(
        spec=found.spec, output=given.output, quiet=given.quiet, kept=None,
        part=given.part, unit=given.unit, form=form, loads=given.loads,
        goal={name: getattr(given, name) for name in GOALS}, remove_thin=given.remove_thin,
        solid=not given.no_solid,
        radius_list=given.radius_list, symmetry=given.symmetry,
        printing=_printing(given, found), building=_building(given, found),
        steps=given.steps, prove=not given.no_proof,
        prove_file=given.prove == "file", voxel=given.voxel, radii=given.radii,
        thickness=given.thickness, limits=_limits(given, form),
        write_spec=given.write_spec, report=given.report, plot=given.plot, picture=given.picture,
        colour=given.colour or "radius", case=given.case, deformed=given.deformed or 0.0,
    )  # fmt: skip


def _mesh_options(given: argparse.Namespace, found: Specified) -> dict[str, Any]:
    """The fields of `MeshOptions`."""
    out = Path(given.output)
    refuse_extensions(given, "fill", out)
    check_files(given, found.files)
    form = find_form(out, given.threemf or given.step or given.inp)
    solid = _solid_material(given.material)
    if solid is not None and "," in given.material and "material" not in form.takes:
        # Without a density it says something about a deck only.
        raise _no_density(given.output)
    process = _print_process(given, form, solid)
    fields = _lattice_options(given, found, solid)
    table = _printed_table(given, form)
    notes: tuple[str, ...] = ()
    if table is not None and given.compensate:
        from ..jobs.as_printed import compensated

        fields["spec"], note = compensated(fields["spec"], table, found.build_direction)
        notes = (note,)
    _check_reports(given, form)
    if process is not None:
        from ..grid.inclination import unit_direction

        unit_direction(found.build_direction)
    form.refuse(fields["spec"])
    return fields | {
        "form": form,
        "report": given.report,
        "picture": given.picture,
        "process": process,
        "build_direction": found.build_direction,
        "material": _deck_material(solid, _density(found, given.material, solid)),
        "limits": _limits(given, form),
        "printed": table,
        "notes": notes,
    }


def _printed_table(given: argparse.Namespace, form: Form) -> PrintedTable | None:
    """How thick struts come out; None of a network's, whose command has no such option."""
    if getattr(given, "as_printed", None) is None:
        if getattr(given, "compensate", False):
            raise VolfrepError("--compensate goes by a table: name it by --as-printed.")
        return None
    from ..design.as_printed import find_printed_table

    if not form.meshed and not given.compensate:
        raise VolfrepError(
            "What comes out is told of a mesh: write one, or give --compensate for what is drawn."
        )
    return find_printed_table(given.as_printed)


def _printing(given: argparse.Namespace, found: Specified) -> Printing | None:
    """How the struts of a design come out."""
    if given.as_printed is None:
        if given.scatter:
            raise VolfrepError("--scatter is that of a table: name it by --as-printed.")
        return None
    from ..design.as_printed import find_printed_table
    from ..jobs.sizing import Printing

    table = find_printed_table(given.as_printed)
    return Printing(table, found.build_direction, given.scatter)


def _building(given: argparse.Namespace, found: Specified) -> Building | None:
    """How a design is built."""
    if given.process is None:
        return None
    from ..jobs.sizing import building_of

    return building_of(given.process, found.values.get("build_direction"), found.spec)


def _limits(given: argparse.Namespace, form: Form) -> FileLimits:
    """Those of the file."""
    from ..design.file_limits import limits_of

    limits = limits_of(given.service, given.max_triangles, given.max_size)
    if limits and not form.bytes_by:
        raise VolfrepError(
            f"Limits are kept by coarser facets of a mesh, which '{given.output}' is not: leave "
            "them out, or write an STL or a 3MF."
        )
    return limits


def _lattice_options(
    given: argparse.Namespace, found: Specified, solid: SolidMaterial | None
) -> dict[str, Any]:
    """The fields of `LatticeOptions`."""
    spec, density = found.spec, _density(found, given.material, solid)
    if density is not None:
        spec = dataclasses.replace(spec, density=density)
    if solid is not None and spec.target is not None and spec.target.aim == "stiffness":
        target = dataclasses.replace(spec.target, young=solid.young)
        spec = dataclasses.replace(spec, target=target)
    kept = None
    if given.write_spec is not None:
        kept = Kept(values_to_keep(spec, found.build_direction), given.write_spec)
    return {"spec": spec, "output": given.output, "quiet": given.quiet, "kept": kept}


def _solid_material(named: str | None) -> SolidMaterial | None:
    if named is None:
        return None
    from ..mechanics.materials import find_material

    return find_material(named)


def _density(found: Specified, named: str | None, solid: SolidMaterial | None) -> float | None:
    """What was given, else the material's, which one without a density does not say; g/cm3."""
    density: float | None = found.values.get("density")
    if density is not None or solid is None or named is None or "," in named:
        return density
    return solid.density


def _no_density(out: str) -> VolfrepError:
    return VolfrepError(
        f"'{out}' cannot hold what --material asks for: give it the extension "
        f"{suffixes_of(DECK)[0]}, or name a material with a density."
    )


def _deck_material(solid: SolidMaterial | None, density: float | None) -> Material:
    from ..mechanics.materials import Material

    if solid is not None:
        return solid.for_solver(density)
    return Material() if density is None else Material(density=density)


def _print_process(
    given: argparse.Namespace, form: Form, solid: SolidMaterial | None
) -> Process | None:
    """The process of a print report, if one is wanted; it is told if it does not suit."""
    if given.process is None and given.print_report is None:
        return None
    from ..reports.processes import find_process

    name = given.print_report
    if given.process is not None:
        process = find_process(given.process)
        if name is None and form.meshed:
            name = process.name
        if solid is not None and solid.processes and process.name not in solid.processes:
            print_warnings(
                [f"{solid.name} is printed by {listed(solid.processes)}, not by {process.name}."]
            )
    return None if name is None else find_process(name)


def _check_reports(given: argparse.Namespace, form: Form) -> None:
    """Refuse what is made of a mesh where there is none."""
    if given.picture is not None:
        from ..reports.picture import check_picture

        check_picture(given.picture)
        if not form.meshed:
            raise VolfrepError(
                "A picture is made of the mesh, which beams do without: leave it out."
            )
    if form.meshed or not (given.report or given.print_report):
        return
    instead = f"use {form.alternative}" if form.option == "3mf" else "leave one of them out"
    raise VolfrepError(
        f"A report is made of the mesh, which --{form.option} {form.word} does without: {instead}."
    )
