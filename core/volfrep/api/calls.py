# SPDX-License-Identifier: LGPL-2.1-or-later
"""The calls that make a part: fill, size, block, a graph, layers.

It is long because the text of each call is its reference.
"""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ..design.cells import find_cell
from ..design.file_limits import limits_of
from ..design.grading import Field
from ..design.graphs.files import read_network
from ..design.graphs.graph import GivenGraph
from ..design.parameters import BY_NAME
from ..design.parameters.field_keywords import field_of, is_field, is_sampled
from ..design.parameters.keywords import (
    as_graph,
    refuse_unknown,
    with_current_names,
)
from ..design.sampled_field import sample_function
from ..design.spec import LatticeSpec
from ..io.solid import MeshLike, Solid, solid_of
from ..mesh.triangle_mesh import TriangleMesh
from ..util.arguments import check_kind, check_path
from ..util.cache import StageCache
from ..util.errors import VolfrepError, brief
from ..util.numbers import whole
from ..util.progress import ProgressCallback
from ..util.progress_bar import shown
from ..util.threads import threads
from .part import Part
from .wanted_spec import accepted, specified

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..design.banded_infill import BandedInfill
    from ..design.parameters.typed import Keywords, SizeKeywords
    from ..jobs.coupons import Coupon
    from ..jobs.homogenised import HomogenisedPart
    from ..jobs.infill import Infill
    from ..jobs.sizing import Building, Printing
    from ..jobs.slicer_infill import SlicerInfill
    from ..jobs.slices import Layers
    from ..jobs.solving import Solved
    from ..loads.load_cases import LoadCases
    from ..output.bare_surface import BareSurface
    from ..output.sources import FilledPart
    from ..reports.orientation import Orientations
    from ..reports.result import Result


def fill(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    spec: LatticeSpec | None = None,
    *,
    unit: str | None = None,
    material: str | None = None,
    progress: ProgressCallback | bool | None = None,
    cache: StageCache | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    max_triangles: int | None = None,
    max_size: float | None = None,
    service: str | None = None,
    compensate: str | None = None,
    **parameters: Unpack[Keywords],
) -> Part:
    """Fill a solid with a lattice.

    Args:
        part: a file (STL, OBJ, PLY, 3MF, OFF, GLB; with FreeCAD at hand STEP, IGES, BREP), a mesh
            such as a `trimesh.Trimesh`, or its arrays (vertices in mm, triangles). It is repaired
            where that can mean one thing only, and proved.
        spec: what to make.
        unit: of a file's lengths; None for what it says, else mm.
        material: a name of the table in docs/cells.md, or a file: its density gives the mass where
            none is given, its modulus makes a `stiffness` one in MPa.
        progress: True for a bar in a terminal or a notebook; or a function that is called with the
            fraction done and the stage, and cancels by returning False.
        cache: keeps the stages between calls.
        workers: processes that cut the lattice at the wall; None for this one, and one more for
            every 150,000 triangles, at most one a core. 1: threads of this one alone. They stay
            for the next call, and end with this process, or after two minutes without one. The
            mesh is the same with any number.
        executor: cuts it on its workers in their place.
        max_triangles: of the mesh: facets are as much coarser as it takes; the report's warnings
            tell what that costs in mm.
        max_size: of its binary STL in megabytes, in the same way.
        service: whose limits these are: Shapeways, Artrovo or Ponoko.
        compensate: table of printed diameters (LPBF-Ti64, LPBF-316L, SLS-PA12, or a .csv file)
            by which struts are drawn so that they come out as thick as asked for; None draws them
            as asked for. The report's warnings say so. The print goes up along the parameter
            `build_direction`.
        parameters: keys of a specification's file (docs/reference.md) or fields of a
            `LatticeSpec`, in place of one or on top of it; `cell` may be a dict with nodes and
            struts, `network` a pair of arrays or a `networkx.Graph`, `radius_field` a pair of
            points and values; in place of `strut_radius` also
            `relative_density`, `mass` (g, of the finished part) or `stiffness` (such as
            "500:111": a modulus, and 100, 110, 111 or X,Y,Z); of walls `wall_kind`,
            `wall_thickness`, `wall_offset` and `wall_formula`.

    Raises:
        VolfrepError: the part is no closed solid, or the specification makes no sense or does
            not fit it; one sentence that says what to do.
        Cancelled: the callback said so.

    >>> import numpy as np, trimesh, volfrep
    >>> box = trimesh.creation.box((20, 20, 20))
    >>> part = volfrep.fill((box.vertices, box.faces), cell="BCC", strut_radius=1, shell=0)
    >>> part.report.cells_active
    8
    """
    from ..jobs.targets import solve_target
    from ..output.file_size import fill_within
    from ..output.form import find_form

    cache = _cache(cache)
    check_kind("executor", executor, (Executor, type(None)), "an Executor of concurrent.futures")
    if workers is not None:
        whole("workers", workers, 1, 1000)
    if workers is not None and executor is not None:
        raise VolfrepError("An 'executor' has workers of its own: leave 'workers' out.")
    with shown(progress) as callback:
        solid, wanted = _read_call(part, unit, callback, spec, dict(parameters), material)
        notes = []
        if compensate is not None:
            from ..design.as_printed import find_printed_table
            from ..jobs.as_printed import compensated

            table = find_printed_table(compensate)
            up = parameters.get("build_direction", BY_NAME["build_direction"].default)
            wanted, note = compensated(wanted, table, up)
            notes.append(note)

        def make(spec: LatticeSpec) -> FilledPart:
            with _workers(solid, spec, workers, executor) as helping:
                infill = solve_target(solid, spec, progress=callback, cache=cache, executor=helping)
                return _filled(infill, cache)

        limits = limits_of(service, max_triangles, max_size)
        made, kept = fill_within(solid, wanted, limits, find_form("part.stl"), make)
        return Part(_add_notes(made.result, (*notes, *kept)), made.spec, solid, cache, made)


@contextmanager
def _workers(
    solid: Solid, spec: LatticeSpec, count: int | None, executor: Executor | None
) -> Iterator[Executor | None]:
    """An executor that is given; otherwise so many workers, or as many as a fill is worth."""
    if executor is not None:
        yield executor
        return
    from ..jobs.workers import kept_workers, worth_untold

    if count is None:
        count = 1
        if threads() > 1:
            from ..jobs.kinds import lattice_kind

            count = worth_untold(lattice_kind(spec).roughly_solved(solid), solid, streamed=False)
    with kept_workers(count) as kept:
        yield kept


def _filled(infill: Infill, cache: StageCache) -> FilledPart:
    """A part whose mesh is made, as long as its workers are there."""
    from ..output.sources import FilledPart

    filled = FilledPart(infill, cache)
    _ = filled.result
    return filled


def _add_notes(result: Result, notes: Sequence[str]) -> Result:
    """A result whose report warns of more."""
    if not notes:
        return result
    report = dataclasses.replace(result.report, warnings=(*notes, *result.report.warnings))
    return dataclasses.replace(result, report=report)


def size(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    loads: LoadCases | Mapping[str, Any] | str | os.PathLike[str],
    spec: LatticeSpec | None = None,
    *,
    steps: int = 60,
    proof: bool = True,
    prove: Literal["file"] | None = None,
    voxel: float | None = None,
    remove_thin: bool = False,
    radius_list: Sequence[float] = (),
    symmetry: str | None = None,
    as_printed: str | None = None,
    scatter: float = 0.0,
    process: str | None = None,
    solid_places: bool = True,
    unit: str | None = None,
    progress: ProgressCallback | bool | None = None,
    cache: StageCache | None = None,
    workers: int | None = None,
    max_triangles: int | None = None,
    max_size: float | None = None,
    service: str | None = None,
    **parameters: Unpack[SizeKeywords],
) -> Part:
    """Fill a solid with a lattice whose struts are sized for its load cases.

    Args:
        part: as of `fill`.
        loads: the file of the load cases (docs/loads.md), or a dict with the file's entries.
        spec: what to make; its radius is what the design begins with.
        steps: of the search, at most.
        proof: let CalculiX solve the final design, where it is installed.
        prove: "file" solves the finished mesh as a solid, by voxels, too, and sets it beside the
            design and CalculiX: the report's entry ``file``.
        voxel: edge of its voxels, mm; None for what suits the part.
        remove_thin: take away struts that end as thin as allowed, and size the rest again.
        radius_list: the radii that nodes may have, mm, in place of bounds; empty for any.
        symmetry: planes under which radii and a sized skin are their own images, such as
            "x=0, z=2.5"; None for none.
        as_printed: table of printed diameters, as `compensate` of `fill`: stress, stiffness and
            mass are those of struts as they come out, and the part has them as they are drawn.
            None takes struts as drawn. The print goes up along the parameter `build_direction`.
        scatter: stress and buckling are those of struts thinner by so many standard deviations of
            that table.
        process: FFF, SLA, SLS, MJF, LPBF or EBM: struts are no thinner than it builds and, as far
            as limits allow, none is flatter, along the parameter `build_direction`; without
            that, along the part's axis that is best for it.
        solid_places: where limits ask for more than the thickest skin that may be, the part becomes
            solid.
        unit: as of `fill`.
        progress: as of `fill`.
        cache: as of `fill`.
        workers: as of `fill`; radii are found without.
        max_triangles: as of `fill`; radii are found before, and stay.
        max_size: as of `fill`.
        service: as of `fill`.
        parameters: as of `fill`, and what is wanted, as options of the command: `max_stress`,
            `safety`, `max_displacement`, `buckling`, `min_frequency`, `strut_mass`, `thinnest`,
            `thickest`, `smooth`, `skin_thinnest`, `skin_thickest`, `skin_patch`, `sized_mass`.

    Returns:
        The part; its `sized` holds the radii, and `sized.report` the figures before and after.

    Raises:
        VolfrepError: the specification does not fit the part, nothing lies where a load acts, the
            part is not held, or the goal cannot be.
        Cancelled: the callback said so before there was a design.

    >>> import trimesh, volfrep
    >>> box = trimesh.creation.box(bounds=((0, 0, 0), (10, 10, 5)))
    >>> held, pulled = ({"point": [x, 0, 0], "normal": [1, 0, 0]} for x in (0, 10))
    >>> loads = {
    ...     "material": "PA12",
    ...     "support": [{"plane": held, "fixed": True}],
    ...     "case": [{"load": [{"plane": pulled, "force": [5, 0, 0]}]}],
    ... }
    >>> part = volfrep.size(
    ...     box, loads, cell="CVC", cell_size=5, strut_radius=0.4, shell=0, boundary="whole",
    ...     safety=3, steps=3, proof=False, resolution=8,
    ... )
    >>> len(part.sized.radii) == len(part.sized.points)
    True
    """
    from ..jobs.infill import Infill
    from ..jobs.sizing import GOALS, check_file_proof, goal_of, prove_file
    from ..jobs.sizing import size as size_struts
    from ..output.file_size import fill_within
    from ..output.form import find_form

    whole("steps", steps, 1, 100_000)
    if workers is not None:
        whole("workers", workers, 1, 1000)
    limits = limits_of(service, max_triangles, max_size)
    if prove not in (None, "file"):
        raise VolfrepError(f"'prove' is 'file' or nothing, not {brief(prove)}.")
    given = with_current_names(parameters)
    asked = {name: given.pop(name) for name in GOALS if name in given}
    refuse_unknown(given, accepted() | set(GOALS))
    cache = _cache(cache)
    with shown(progress) as callback:
        solid, wanted = _read_call(part, unit, callback, spec, given, None)
        loads = _loads(loads, solid)
        wanted = dataclasses.replace(wanted, density=loads.material.density)
        asked_up = given.get("build_direction")
        up = BY_NAME["build_direction"].default if asked_up is None else asked_up
        goal = goal_of(
            loads.material, asked, remove_thin=remove_thin, radius_list=radius_list,
            symmetry=symmetry, solid_places=solid_places,
            printing=_printing(as_printed, scatter, up),
            building=_building(process, asked_up, wanted),
        )  # fmt: skip
        if prove == "file":
            check_file_proof(goal)
        made = size_struts(
            solid, wanted, loads, goal, most_steps=steps, prove_it=proof, progress=callback,
            cache=cache,
        )  # fmt: skip

        def fill(spec: LatticeSpec) -> FilledPart:
            with _workers(solid, spec, workers, None) as helping:
                infill = Infill(solid, spec, progress=callback, cache=cache, executor=helping)
                return _filled(infill, cache)

        filled, kept = fill_within(solid, made.spec, limits, find_form("part.stl"), fill)
        if prove == "file":
            prove_file(made, filled.result.mesh, loads, voxel=voxel, progress=callback)
        return Part(_add_notes(filled.result, kept), filled.spec, solid, cache, filled, made)


def _printing(table: str | None, scatter: float, up: Any) -> Printing | None:
    """How struts of a sized part come out of the printer; None where they are taken as drawn."""
    check_kind("scatter", scatter, Real, "a number")
    if table is None:
        if scatter:
            raise VolfrepError("'scatter' is that of a table: name it by 'as_printed'.")
        return None
    from ..design.as_printed import find_printed_table
    from ..jobs.sizing import Printing

    return Printing(find_printed_table(table), up, float(scatter))


def _building(process: str | None, up: Any, spec: LatticeSpec) -> Building | None:
    """How a sized part is built; None where that does not count."""
    if process is None:
        return None
    from ..jobs.sizing import building_of

    return building_of(process, up, spec)


def solve(
    part: Part | str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    loads: LoadCases | Mapping[str, Any] | str | os.PathLike[str],
    *,
    voxel: float | None = None,
    material: str | None = None,
    unit: str | None = None,
    progress: ProgressCallback | bool | None = None,
) -> Solved:
    """Solve any solid under load cases by voxel finite elements: a filled part, or another.

    Args:
        part: as of `fill`; or a `Part`, the finished mesh of which is solved.
        loads: the file of the load cases (docs/loads.md), or a dict with the file's entries.
        voxel: edge of a voxel, mm; None for what makes a quarter of a million of them, or lays a
            few across its walls. It is solved with voxels 1.5 times as large, too.
        material: in place of the loads': a name of the table in docs/cells.md, a file, or
            "NAME,E,NU" in MPa.
        unit: as of `fill`.
        progress: as of `fill`.

    Returns:
        Its `report` holds the figures, `states` the displacements and nominal stress of each case;
        `save` writes them as .vtu or .json.

    Raises:
        VolfrepError: nothing lies where a load acts, the part is not held, or it would not fit
            into memory.
        Cancelled: the callback said so.

    >>> import trimesh, volfrep
    >>> box = trimesh.creation.box(bounds=((0, 0, 0), (40, 10, 10)))
    >>> held, pulled = ({"point": [x, 0, 0], "normal": [1, 0, 0]} for x in (0, 40))
    >>> loads = {
    ...     "material": "PA12",
    ...     "support": [{"plane": held, "fixed": True}],
    ...     "case": [{"load": [{"plane": pulled, "force": [100, 0, 0]}]}],
    ... }
    >>> solved = volfrep.solve(box, loads, voxel=2.5)
    >>> (case,) = solved.report["cases"]
    >>> bool(case["imbalance"] < 1e-6)
    True
    """
    from ..jobs.solving import solve_solid
    from ..mechanics.materials import find_material

    with shown(progress) as callback:
        mesh: TriangleMesh
        if isinstance(part, Part):
            mesh = part.result.mesh
            cases = _loads(loads, part.solid or mesh)
        else:
            mesh = as_solid(part, unit, callback)
            cases = _loads(loads, mesh)
        if material is not None:
            cases = dataclasses.replace(cases, material=find_material(material))
        return solve_solid(mesh, cases, voxel=voxel, progress=callback)


def orient(
    part: Part | str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    *,
    process: str | None = None,
    inclination: float | None = None,
    best: int = 5,
    unit: str | None = None,
    progress: ProgressCallback | bool | None = None,
) -> Orientations:
    """The best build directions of a part: by overhang, closed rooms, supports, height.

    Args:
        part: as of `solve`.
        process: FFF, SLA, SLS, MJF, LPBF or EBM, whose inclination holds.
        inclination: least angle of a facet to the build plate that needs no support, degrees;
            None for the process's, or 45.
        best: how many are told, at most.
        unit: as of `fill`.
        progress: as of `fill`.

    Returns:
        Its `best` holds the figures of each, `turned` gives the part as it stands on the plate.

    Raises:
        VolfrepError: the part is no solid, or there is no such process.
        Cancelled: the callback said so.

    >>> import trimesh, volfrep
    >>> found = volfrep.orient(trimesh.creation.box((40, 10, 20)))
    >>> round(found.best[0].height_mm, 6), round(found.best[0].base_mm2, 3)
    (10.0, 800.0)
    """
    from ..reports.orientation import inclination_of
    from ..reports.orientation import orient as best_orientations

    whole("best", best, 1, 100)
    with shown(progress) as callback:
        mesh = part.result.mesh if isinstance(part, Part) else as_solid(part, unit, callback)
        return best_orientations(
            mesh, inclination_of(process, inclination), best=best, progress=callback
        )


def homogenise(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    loads: LoadCases | Mapping[str, Any] | str | os.PathLike[str],
    spec: LatticeSpec | None = None,
    *,
    element: float | None = None,
    frequencies: int = 0,
    load_factors: int = 0,
    stiffest: bool = False,
    safety: float | None = None,
    max_displacement: float | None = None,
    thinnest: float | None = None,
    thickest: float | None = None,
    steps: int = 40,
    unit: str | None = None,
    progress: ProgressCallback | bool | None = None,
    cache: StageCache | None = None,
    **parameters: Unpack[Keywords],
) -> HomogenisedPart:
    """Solve a filled part as a solid of its lattice's effective stiffness: any number of cells.

    Args:
        part: as of `fill`.
        loads: the file of the load cases (docs/loads.md), or a dict with the file's entries.
        spec: what it is filled with.
        element: edge of an element, mm; None for a cell, or less where there are few.
        frequencies: how many of the lowest natural ones, with the first case's supports.
        load_factors: how many of the lowest at which the part buckles as a whole, in each case.
        stiffest: size radii or thicknesses: as stiff as can be at the mass that the part has.
        safety: size them for the least mass: the lattice is used up to the yield over this.
        max_displacement: the same: of any place, in any case, mm.
        thinnest: mm; None for half of what the radius or thickness is.
        thickest: mm; None for twice.
        steps: of that search, at most.
        unit: as of `fill`.
        progress: as of `fill`.
        cache: as of `fill`.
        parameters: as of `fill`.

    Returns:
        Its `report` holds the figures, `states` displacements, the lattice's share of yield and the
        skin's stress of each case; `save` writes .vtu, .json or a CalculiX deck; `conduct` its
        steady heat. Where something was sized, `spec` has it for `fill`.

    Raises:
        VolfrepError: the lattice has no cells that repeat, nothing lies where a load acts, or the
            part is not held.
        Cancelled: the callback said so.

    >>> import trimesh, volfrep
    >>> box = trimesh.creation.box(bounds=((0, 0, 0), (40, 20, 20)))
    >>> held, pulled = ({"point": [x, 0, 0], "normal": [1, 0, 0]} for x in (0, 40))
    >>> loads = {
    ...     "material": "PA12",
    ...     "support": [{"plane": held, "fixed": True}],
    ...     "case": [{"load": [{"plane": pulled, "force": [100, 0, 0]}]}],
    ... }
    >>> made = volfrep.homogenise(box, loads, cell="Octet", cell_size=5, strut_radius=0.4, shell=1)
    >>> (case,) = made.report["cases"]
    >>> 0.03 < case["displacement_mm"] < 0.05
    True
    """
    from ..jobs.homogenised import homogenise_part
    from ..jobs.sized_field import field_goal, homogenise_sized

    given = with_current_names(parameters)
    refuse_unknown(given, accepted())
    cache = _cache(cache)
    with shown(progress) as callback:
        solid, wanted = _read_call(part, unit, callback, spec, given, None)
        cases = _loads(loads, solid)
        asked = {
            "safety": safety, "max_displacement": max_displacement,
            "thinnest": thinnest, "thickest": thickest,
        }  # fmt: skip
        goal = field_goal(cases, asked, stiffest=stiffest)
        if goal is not None:
            return homogenise_sized(
                solid, wanted, cases, goal, most_steps=steps, element=element,
                frequencies=frequencies, load_factors=load_factors, progress=callback, cache=cache,
            )  # fmt: skip
        return homogenise_part(
            solid, wanted, cases, element=element, frequencies=frequencies,
            load_factors=load_factors, progress=callback, cache=cache,
        )  # fmt: skip


def _loads(
    loads: LoadCases | Mapping[str, Any] | str | os.PathLike[str], solid: TriangleMesh | None
) -> LoadCases:
    """The load cases of a call, on a solid."""
    from ..loads.load_cases import LoadCases
    from ..loads.load_file import load_cases_of, read_load_cases

    if isinstance(loads, LoadCases):
        return loads
    if isinstance(loads, Mapping):
        return load_cases_of(loads, solid)
    check_path("loads", loads)
    return read_load_cases(loads, solid)


def block(
    count: Sequence[int],
    spec: LatticeSpec | None = None,
    *,
    material: str | None = None,
    progress: ProgressCallback | bool | None = None,
    max_triangles: int | None = None,
    max_size: float | None = None,
    service: str | None = None,
    **parameters: Unpack[Keywords],
) -> Part:
    """A free-standing block of whole cells with round struts.

    Args:
        count: cells along x, y, z.
        spec: what to make.
        material: as of `fill`.
        progress: True for a bar in a terminal or a notebook; or a function that is called with the
            fraction done and the stage, and cancels by returning False.
        max_triangles: as of `fill`.
        max_size: as of `fill`.
        service: as of `fill`.
        parameters: as of `fill`.

    Raises:
        VolfrepError: the counts or the specification make no sense, or it would not fit into
            memory.
        Cancelled: the callback said so.

    >>> import volfrep
    >>> cube = volfrep.block((2, 2, 2), cell="Octet", cell_size=5, strut_radius=0.4)
    >>> cube.report.struts - cube.report.nodes + 1 == cube.report.genus
    True
    """
    from ..design.forecast import forecast_block
    from ..jobs.kinds.kind import block_counts
    from ..jobs.targets import solve_block_target
    from ..output.file_size import keep_within
    from ..output.form import find_form
    from ..output.sources import Block

    counts = block_counts(count)
    if is_field("cell_size", parameters.get("cell_size")):
        raise VolfrepError(
            "A block is as large as its cells make it, so that these cannot follow places in it: "
            "give 'size_grading', or 'fill' a box."
        )
    corners = np.array([(0, 0, 0), counts], float)
    with shown(progress) as callback:
        wanted = specified(spec, dict(parameters), material, lambda size: size * corners)
        limits = limits_of(service, max_triangles, max_size)
        made, kept = keep_within(
            wanted, limits, find_form("part.stl"),
            lambda spec: forecast_block(spec, counts).triangles,
            lambda spec: Block(solve_block_target(spec, counts, progress=callback), callback),
        )  # fmt: skip
        return Part(_add_notes(made.result, kept), made.spec, None, StageCache(), made)


def mesh_network(
    graph: Any,
    spec: LatticeSpec | None = None,
    *,
    progress: ProgressCallback | bool | None = None,
    max_triangles: int | None = None,
    max_size: float | None = None,
    service: str | None = None,
    **parameters: Unpack[Keywords],
) -> Part:
    """The nodes and struts of any graph, meshed as they are in free space.

    To fill a part with it, give ``network=volfrep.design.graphs.make_network(...)``, or a
    ``RandomGraph``, to `volfrep.fill`.

    Args:
        graph: a file (see `volfrep.design.graphs.read_network`), or arrays: nodes (n, 3) in
            mm, struts (m, 2), and, if they differ, radii (m,), (m, 2) or (n,) in mm; or a
            `networkx.Graph` whose nodes are points or have one as ``pos``, or a mesh's edges.
        spec: what to make.
        progress: as of `volfrep.fill`.
        max_triangles: of the mesh: struts have as many corners less round them as it takes; the
            report's warnings tell what that costs in mm.
        max_size: of its binary STL in megabytes, in the same way.
        service: as of `volfrep.fill`.
        parameters: as of `volfrep.fill`.

    Raises:
        VolfrepError: the graph or the specification makes no sense.
        Cancelled: the callback said so.

    >>> import volfrep
    >>> made = volfrep.mesh_network(([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [(0, 1), (0, 2), (1, 2)]))
    >>> made.report.genus, made.report.bodies
    (1, 1)
    """
    from ..output.file_size import keep_within
    from ..output.form import find_form
    from ..output.sources import FreeGraph

    limits = limits_of(service, max_triangles, max_size)
    if not isinstance(graph, (str, os.PathLike)):
        found = as_graph(graph)
        check_kind("graph", found, GivenGraph, "a file, nodes and struts, a graph or a mesh")
    else:
        cell: Any = parameters.get("cell", None if spec is None else spec.cell)
        found = read_network(graph, find_cell(cell) if isinstance(cell, str) else cell)
    bounds = np.array([found.nodes.min(axis=0), found.nodes.max(axis=0)])
    wanted = specified(spec, {**parameters, "network": found}, None, lambda size: bounds)
    with shown(progress) as callback:
        made, kept = keep_within(
            wanted, limits, find_form("part.stl"), lambda _: 0.0,
            lambda spec: FreeGraph(spec, callback),
        )  # fmt: skip
        return Part(_add_notes(made.result, kept), made.spec, None, StageCache(), made)


def slice_layers(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    folder: str | os.PathLike[str],
    spec: LatticeSpec | None = None,
    *,
    layer: float,
    pixel: float | None = None,
    form: str = "png",
    unit: str | None = None,
    material: str | None = None,
    progress: ProgressCallback | bool | None = None,
    cache: StageCache | None = None,
    **parameters: Unpack[Keywords],
) -> Layers:
    """Fill a solid and write it in layers along z for a printer; no mesh is made.

    Args:
        part: as of `fill`, as it stands on the build plate.
        folder: to make; one that holds layers is replaced.
        spec: what to make.
        layer: height of a layer, mm.
        pixel: edge of a picture's pixel, mm; None for the height of a layer.
        form: png, svg or cli.
        unit: of a file's lengths; None for what it says, else mm.
        material: as of `fill`.
        progress: True for a bar in a terminal or a notebook; or a function that is called with the
            fraction done and the stage, and cancels by returning False.
        cache: keeps the stages between calls.
        parameters: as of `fill`.

    Raises:
        VolfrepError: as `fill`; or the layers cannot be made or written so.
        Cancelled: the callback said so.

    >>> import tempfile, trimesh, volfrep
    >>> with tempfile.TemporaryDirectory() as place:
    ...     made = volfrep.slice_layers(
    ...         trimesh.creation.box((20, 20, 10)), place, cell="BCC", cell_size=10,
    ...         strut_radius=1, shell=1, layer=0.5, pixel=0.1,
    ...     )
    >>> made.count, made.pixels
    (20, (202, 202))
    """
    from ..jobs.slices import write_layers

    check_path("folder", folder)
    with shown(progress) as callback:
        solid, wanted = _read_call(part, unit, callback, spec, dict(parameters), material)
        return write_layers(
            solid,
            wanted,
            folder,
            layer=layer,
            pixel=pixel,
            form=form,
            progress=callback,
            cache=cache,
        )


def coupons(
    spec: LatticeSpec | None = None,
    kinds: Sequence[str] = ("cube", "tension", "bending", "ladder"),
    *,
    cells: int = 4,
    first: int = 1,
    progress: ProgressCallback | bool | None = None,
    **parameters: Unpack[Keywords],
) -> list[Coupon]:
    """Specimens of a lattice to print and measure, numbered in relief.

    Args:
        spec: of the lattice.
        kinds: of cube, tension, bending and ladder.
        cells: along the edge of the cube.
        first: number of the first one.
        progress: as of `fill`.
        parameters: as of `fill`.

    Raises:
        VolfrepError: there is no such kind, or the lattice makes no sense.
        Cancelled: the callback said so.

    >>> import volfrep
    >>> ladder = volfrep.coupons(kinds=["ladder"], first=7)[0]
    >>> ladder.number, len(ladder.struts), ladder.table().splitlines()[0]
    (7, 25, 'inclination,nominal,measured')
    """
    from ..jobs.coupons import make_coupons

    with shown(progress) as callback:
        wanted = specified(spec, dict(parameters), None)
        return make_coupons(wanted, kinds, cells=cells, first=first, progress=callback)


def bare_surface(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    spec: LatticeSpec | None = None,
    *,
    unit: str | None = None,
    progress: ProgressCallback | bool | None = None,
    cache: StageCache | None = None,
    **parameters: Unpack[Keywords],
) -> BareSurface:
    """The surface that a part's TPMS sheets follow, without thickness, cut at the part's wall.

    Args:
        part: as of `fill`.
        spec: of sheets, without a skin or with the output ``lattice``.
        unit: as of `fill`.
        progress: as of `fill`.
        cache: as of `fill`.
        parameters: as of `fill`.

    Returns:
        Its `mesh` is open; `save` writes it for slicers that print surfaces as single lines.

    Raises:
        VolfrepError: the lattice has no sheets, something of it is about their thickness, or the
            part is no closed solid.
        Cancelled: the callback said so.

    >>> import trimesh, volfrep
    >>> made = volfrep.bare_surface(
    ...     trimesh.creation.box((20, 20, 20)), cell="Schwarz P", cell_size=10, shell=0
    ... )
    >>> round(made.area / 800, 2)
    2.35
    """
    from ..output.bare_surface import bare_surface as made_of

    cache = _cache(cache)
    with shown(progress) as callback:
        solid, wanted = _read_call(part, unit, callback, spec, dict(parameters), None)
        return made_of(solid, wanted, progress=callback, cache=cache)


def slicer_infill(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    wanted: BandedInfill | None = None,
    *,
    sized: LatticeSpec | str | os.PathLike[str] | None = None,
    unit: str | None = None,
    material: str | None = None,
    progress: ProgressCallback | bool | None = None,
    **parameters: Any,
) -> SlicerInfill:
    """Bands of a slicer's own infill, denser where a field says; no lattice is made.

    Args:
        part: as of `fill`, as it stands on the build plate.
        wanted: densities, pattern, walls and layers; None for the defaults.
        sized: a specification with radii that struts were sized to, or its file: the density is
            what these come to.
        unit: of a file's lengths; None for what it says, else mm.
        material: as of `fill`: its density gives the mass.
        progress: as of `fill`.
        parameters: fields of a `BandedInfill` on top of it; `field` may be a file, a pair of points
            and values, or a function of points that gives percents.

    Returns:
        The bands, with the filament that they take; `save` writes the slicer's project.

    Raises:
        VolfrepError: the part is no closed solid, or a parameter makes no sense.
        Cancelled: the callback said so.

    >>> import trimesh, volfrep
    >>> box = trimesh.creation.box((30, 20, 10))
    >>> made = volfrep.slicer_infill(box, grading="direction", start=10, end=40, bands=3)
    >>> len(made.bands), round(made.mean_density)
    (3, 25)
    """
    from ..design.banded_infill import BandedInfill
    from ..design.parameters.spec_file import read_spec
    from ..jobs.figures.sized_density import sized_densities
    from ..jobs.slicer_infill import cut_bands
    from ..mechanics.materials import find_material

    check_kind("wanted", wanted, (BandedInfill, type(None)), "a BandedInfill")
    known = {field.name for field in dataclasses.fields(BandedInfill) if field.init}
    refuse_unknown(parameters, known)
    with shown(progress) as callback:
        solid = as_solid(part, unit, callback)
        values = parameters.get("field")
        if callable(values) and not isinstance(values, Field):
            step = float(np.ptp(solid.bounds, axis=0).max()) / 60.0
            values = sample_function(values, solid.bounds, step, "field")
            low, high = values.range
            parameters |= {"field": values, "start": low, "end": high, "grading": "field"}
        elif isinstance(values, (tuple, list)):
            parameters["field"] = field_of("field", values, None, 1.0)
        if sized is not None:
            spec = read_spec(sized) if isinstance(sized, (str, os.PathLike)) else sized
            parameters["field"], parameters["curve"] = sized_densities(spec)
            parameters["grading"] = "field"
        density = LatticeSpec.density if material is None else find_material(material).density
        wanted = dataclasses.replace(wanted or BandedInfill(), **parameters)
        return cut_bands(solid, wanted, material_density=density, progress=callback)


def _cache(cache: StageCache | None) -> StageCache:
    """The one that was given, or a new one."""
    check_kind("cache", cache, (StageCache, type(None)), "a StageCache")
    return StageCache() if cache is None else cache


def as_solid(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    unit: str | None = None,
    progress: ProgressCallback | bool | None = None,
) -> Solid:
    """A proved solid of a file, a mesh or its arrays; see `fill`.

    Raises:
        VolfrepError: it is none.
        Cancelled: the callback said so while FreeCAD read a CAD file.

    >>> import trimesh, volfrep
    >>> solid = volfrep.as_solid(trimesh.creation.box((10, 20, 30)))
    >>> round(solid.volume, 6), solid.bounds[1].tolist()
    (6000.0, [5.0, 10.0, 15.0])
    """
    with shown(progress) as callback:
        return solid_of(part, unit, callback)


def _read_call(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    unit: str | None,
    progress: ProgressCallback | None,
    spec: LatticeSpec | None,
    parameters: dict[str, Any],
    material: str | None,
) -> tuple[Solid, LatticeSpec]:
    """The solid and what to make; the specification first, where it needs no part."""
    parameters = with_current_names(parameters)
    if any(is_sampled(name, value) for name, value in parameters.items()):
        refuse_unknown(parameters, accepted())
        solid = as_solid(part, unit, progress)
        return solid, specified(spec, parameters, material, lambda size: solid.bounds)
    wanted = specified(spec, parameters, material)
    return as_solid(part, unit, progress), wanted
