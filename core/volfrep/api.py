# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a script's author needs: `fill` a part, make a `block`, mesh a graph, look at it, save it.

>>> import trimesh, volfrep
>>> part = volfrep.fill(
...     trimesh.creation.box((30, 20, 20)), cell="CVC", cell_size=10, strut_radius=1, shell=2
... )
>>> part.report.watertight, part.report.bodies
(True, 1)
>>> bool(0.3 < part.mesh.volume / (30 * 20 * 20) < 0.7)
True
"""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .design.cells import find_cell
from .design.graphs import read_network
from .design.parameters.keywords import (
    FIELDS,
    KEYS,
    as_graph,
    is_key,
    own_data,
    refuse_kind,
    refuse_unknown,
    spec_by_keys,
)
from .design.spec import LatticeSpec
from .design.spec_parts import first_radius
from .design.target import AIMS, THICKNESSES, read_target
from .design.tpms import FORMULA, TpmsSheet, find_surface, surface_name
from .grid.strut_graph import Wireframe
from .io.solid import Solid, check_solid, read_solid
from .mesh.triangle_mesh import TriangleMesh
from .reports.report import Report
from .reports.result import Result
from .util.cache import StageCache
from .util.errors import VolfrepError
from .util.progress import ProgressCallback

if TYPE_CHECKING:
    import trimesh
    from typing_extensions import Unpack

    from .design.parameters.typed import Keywords, SizeKeywords
    from .jobs.sizing import SizedPart
    from .jobs.slices import Layers
    from .loads.load_cases import LoadCases
    from .mechanics.summary import CellProperties
    from .output.writer import Source
    from .reports.printability import PrintReport

#: What of a `Wall` a parameter of a call, an option or an entry of a file says.
_WALL = {"wall_kind": "kind", "wall_thickness": "thickness", "wall_offset": "offset"}


class MeshLike(Protocol):
    """Anything with vertices and faces, such as a `trimesh.Trimesh`."""

    @property
    def vertices(self) -> ArrayLike:
        """(n, 3) in mm."""

    @property
    def faces(self) -> ArrayLike:
        """(m, 3) vertex numbers, counter-clockwise from outside."""


@dataclass(frozen=True, eq=False)
class Part:
    """A filled part, or a block.

    Attributes:
        result: the mesh as arrays, its wireframe and its figures.
        spec: what was asked for.
        solid: what was filled; None for a block.
        cache: holds the stages, so that what is asked for later is not computed anew.
        source: what files are written from.
        sized: of `size`: radii, what they carry, and its report; None otherwise.
    """

    result: Result
    spec: LatticeSpec
    solid: Solid | None
    cache: StageCache
    source: Source
    sized: SizedPart | None = None

    def __repr__(self) -> str:
        report = self.report
        return (
            f"<Part of {report.spec.get('cell')}: {report.struts:,} struts, "
            f"{report.triangles:,} triangles, {report.volume_mm3:,.1f} mm3, {report.mass_g:,.2f} g>"
        )

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><th>{escape(name)}</th><td>{escape(text[:200])}</td></tr>"
            for name, text in self.report.figures.items()
            if name != "Specification"
        )
        return f"<table>{rows}</table>"

    @cached_property
    def mesh(self) -> trimesh.Trimesh:
        """The mesh, mm; its vertices and faces are those of `result.mesh`, none merged."""
        import trimesh  # slow to import

        made = self.result.mesh
        return trimesh.Trimesh(made.vertices, made.triangles, process=False)

    @property
    def struts(self) -> Wireframe:
        """The unique nodes and struts of the active cells, with their radii, mm."""
        return self.result.wireframe

    @property
    def nodes(self) -> NDArray[np.float64]:
        """(n, 3) nodes of `struts`, mm."""
        return self.struts.nodes

    @property
    def mass(self) -> float:
        """Of the mesh at the density of the specification, g."""
        return self.report.mass_g

    @property
    def report(self) -> Report:
        """The figures: cells, struts, triangles, volume, mass, seconds, warnings."""
        return self.result.report

    def save(
        self,
        path: str | os.PathLike[str],
        form: str | None = None,
        *,
        material: str | None = None,
        layer: float | None = None,
        pixel: float | None = None,
    ) -> tuple[str, ...]:
        """Write the part in the form that the extension names (.stl, .3mf, .step, .inp, ...).

        Args:
            path: of the file, or of a folder for layers; what was there before stays if anything
                goes wrong.
            form: which of several: for .3mf "mesh", "beams" or "both"; for .step "faceted",
                "exact" (by an installed FreeCAD) or "wireframe"; for .inp "beams" or
                "tetrahedra" (by Gmsh); for a folder of layers "png", "svg" or "cli". None for the
                first of these.
            material: of an .inp file: a name of the table in docs/cells.md, a file, or
                "NAME,E,NU" in MPa.
            layer: height of a layer, mm.
            pixel: edge of a picture's pixel, mm; None for the height of a layer.

        Returns:
            Sentences on the file, such as that it holds plane faces in place of exact surfaces.

        Raises:
            VolfrepError: there is no such form, it does not suit the part, or the path cannot be
                written.

        >>> import tempfile, volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     said = part.save(f"{folder}/cell.3mf", "beams")
        >>> "beam lattice extension" in said[0]
        True
        """
        from .mechanics.materials import Material, find_material
        from .output.form import find_form
        from .output.writer import Settings, writer_of

        found = find_form(path, form)
        deck = Material(density=self.spec.density)
        if material is not None:
            deck = find_material(material).for_solver(self.spec.density)
        settings = Settings(deck, layer, pixel)
        found.refuse(self.spec)
        writer, settled = writer_of(found).settle(self.source)
        return settled + writer.write(self.source, path, settings).warnings

    def layers(
        self,
        folder: str | os.PathLike[str],
        layer: float,
        pixel: float | None = None,
        form: str = "png",
    ) -> Layers:
        """Write the part in layers along z for a printer, straight from its struts.

        Args:
            folder: to make; one that holds layers is replaced.
            layer: height of a layer, mm.
            pixel: edge of a picture's pixel, mm; None for the height of a layer.
            form: png, svg or cli.

        Raises:
            VolfrepError: it is a block or a graph in free space, or the layers cannot be made so.
        """
        from .output.form import words

        if form not in words("format"):
            raise VolfrepError(
                f"There is no format '{form}': choose one of {', '.join(words('format'))}."
            )
        return self.source.layers(folder, form, layer, pixel)

    def properties(self, *, exact: bool = False) -> CellProperties:
        """What the endless lattice of the part's cell and radius does, as `volfrep.properties`.

        Raises:
            VolfrepError: the lattice is graded, or a network, and so has no one stiffness.
        """
        from .jobs.figures.properties import lattice_properties

        spec = self.spec
        given = spec.kind.endless
        if spec.is_graded or given is None:
            raise VolfrepError(
                "A lattice that is graded, turned or a network has no one stiffness: ask for the "
                "properties of a cell."
            )
        return lattice_properties(**given, exact=exact)

    def check(
        self, process: str, build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    ) -> PrintReport:
        """Hold the part against the limits of a printing process.

        Args:
            process: FFF, SLA, SLS, MJF, LPBF or EBM.
            build_direction: from the build plate up, of any length.

        Raises:
            VolfrepError: there is no such process, or the direction is none.
        """
        from .jobs.figures.print_check import check_print
        from .jobs.pipeline import fill
        from .reports.processes import find_process

        limits = find_process(process)
        domain = None
        if self.solid is not None:
            inner = dataclasses.replace(self.spec, output="domain", drains=None)
            domain = fill(self.solid, inner, cache=self.cache).mesh
        return check_print(
            self.result.mesh, self.struts, domain, self.spec, limits, build_direction
        )

    def plot(
        self,
        file: str | os.PathLike[str] | None = None,
        *,
        cut: bool = True,
        size: tuple[int, int] | None = None,
    ) -> None:
        """Show the part, its eighth towards the viewer cut away; needs the package pyvista.

        Args:
            file: a PNG to write; None opens a window, or shows the picture in a notebook.
            cut: False shows it whole.
            size: of the picture, pixels.

        Raises:
            VolfrepError: pyvista is missing, or the file cannot be written.
        """
        from .reports.picture import SIZE, picture

        picture(
            self.result.mesh,
            self.spec,
            file,
            solid=self.solid,
            cut=cut,
            size=size or SIZE,
        )


def fill(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    spec: LatticeSpec | None = None,
    *,
    unit: str | None = None,
    material: str | None = None,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    executor: Executor | None = None,
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
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages between calls.
        executor: cuts the lattice at the wall on its workers; the mesh is the same with any.
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
    from .jobs.targets import solve_target
    from .output.sources import FilledPart

    wanted = specified(spec, dict(parameters), material)
    solid = as_solid(part, unit, progress)
    cache = cache or StageCache()
    infill = solve_target(solid, wanted, progress=progress, cache=cache, executor=executor)
    return Part(infill.result, infill.spec, solid, cache, FilledPart(infill, cache))


def size(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    loads: LoadCases | str | os.PathLike[str],
    spec: LatticeSpec | None = None,
    *,
    steps: int = 60,
    proof: bool = True,
    remove_thin: bool = False,
    unit: str | None = None,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
    **parameters: Unpack[SizeKeywords],
) -> Part:
    """Fill a solid with a lattice whose struts are sized for its load cases.

    Args:
        part: as of `fill`.
        loads: the file of the load cases (docs/loads.md), or these.
        spec: what to make; its radius is what the design begins with.
        steps: of the search, at most.
        proof: let CalculiX solve the final design, where it is installed.
        remove_thin: take away struts that end as thin as allowed, and size the rest again.
        unit: as of `fill`.
        progress: as of `fill`.
        cache: as of `fill`.
        parameters: as of `fill`, and what is wanted, as options of the command: `max_stress`,
            `safety`, `max_displacement`, `buckling`, `min_frequency`, `strut_mass`, `thinnest`,
            `thickest`, `smooth`.

    Returns:
        The part; its `sized` holds the radii, and `sized.report` the figures before and after.

    Raises:
        VolfrepError: the specification does not fit the part, nothing lies where a load acts, the
            part is not held, or the goal cannot be.
        Cancelled: the callback said so before there was a design.
    """
    from .jobs.infill import Infill
    from .jobs.sizing import GOALS, goal_of
    from .jobs.sizing import size as size_struts
    from .loads.load_file import read_load_cases
    from .output.sources import FilledPart

    if steps < 1:
        raise VolfrepError(f"There must be at least one step, not {steps}.")
    given: dict[str, Any] = dict(parameters)
    asked = {name: given.pop(name) for name in GOALS if name in given}
    refuse_unknown(given, accepted() | set(GOALS))
    wanted = specified(spec, given, None)
    solid, cache = as_solid(part, unit, progress), cache or StageCache()
    if isinstance(loads, (str, os.PathLike)):
        loads = read_load_cases(loads, solid)
    wanted = dataclasses.replace(wanted, density=loads.material.density)
    goal = dataclasses.replace(
        goal_of(loads.material, asked, lambda name: name), remove_thin=remove_thin
    )
    made = size_struts(
        solid, wanted, loads, goal, most_steps=steps, prove_it=proof, progress=progress,
        cache=cache,
    )  # fmt: skip
    infill = Infill(solid, made.spec, progress=progress, cache=cache)
    return Part(infill.result, made.spec, solid, cache, FilledPart(infill, cache), made)


def block(
    count: Sequence[int],
    spec: LatticeSpec | None = None,
    *,
    material: str | None = None,
    progress: ProgressCallback | None = None,
    **parameters: Unpack[Keywords],
) -> Part:
    """A free-standing block of whole cells with round struts.

    Args:
        count: cells along x, y, z.
        spec: what to make.
        material: as of `fill`.
        progress: called with the fraction done and the stage; returning False cancels.
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
    from .jobs.targets import solve_block_target
    from .output.sources import Block

    wanted = solve_block_target(
        specified(spec, dict(parameters), material), count, progress=progress
    )
    made = Block(wanted, count, progress)
    return Part(made.result, wanted, None, StageCache(), made)


def mesh_network(
    graph: Any,
    spec: LatticeSpec | None = None,
    *,
    progress: ProgressCallback | None = None,
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
        parameters: as of `volfrep.fill`.

    Raises:
        VolfrepError: the graph or the specification makes no sense.
        Cancelled: the callback said so.

    >>> import volfrep
    >>> made = volfrep.mesh_network(([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [(0, 1), (0, 2), (1, 2)]))
    >>> made.report.genus, made.report.bodies
    (1, 1)
    """
    from .output.sources import FreeGraph

    if not isinstance(graph, (str, os.PathLike)):
        found = as_graph(graph)
    else:
        cell: Any = parameters.get("cell", None if spec is None else spec.cell)
        found = read_network(graph, find_cell(cell) if isinstance(cell, str) else cell)
    wanted = specified(spec, {**parameters, "network": found}, None)
    made = FreeGraph(wanted, progress)
    return Part(made.result, wanted, None, StageCache(), made)


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
    progress: ProgressCallback | None = None,
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
        progress: called with the fraction done and the stage; returning False cancels.
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
    from .jobs.slices import write_layers

    wanted = specified(spec, dict(parameters), material)
    return write_layers(
        as_solid(part, unit, progress), wanted, folder, layer=layer, pixel=pixel, form=form,
        progress=progress, cache=cache,
    )  # fmt: skip


def as_solid(
    part: str | os.PathLike[str] | TriangleMesh | MeshLike | tuple[ArrayLike, ArrayLike],
    unit: str | None = None,
    progress: ProgressCallback | None = None,
) -> Solid:
    """A proved solid of a file, a mesh or its arrays; see `fill`.

    Raises:
        VolfrepError: it is none.
        Cancelled: the callback said so while FreeCAD read a CAD file.
    """
    if isinstance(part, Solid):
        return part
    if isinstance(part, (str, os.PathLike)):
        return read_solid(part, unit, progress=progress)
    if unit is not None:
        raise VolfrepError("A unit belongs to a file: give the arrays of a mesh in mm.")
    if isinstance(part, TriangleMesh):
        return check_solid(part, "mesh")
    if isinstance(part, tuple) and len(part) == 2:
        vertices, triangles = part
    elif hasattr(part, "vertices") and hasattr(part, "faces"):
        vertices, triangles = part.vertices, part.faces
    else:
        raise VolfrepError(
            f"A part is a file's path, a mesh with vertices and faces, or a pair of arrays, not "
            f"{type(part).__name__}."
        )
    points, rows = np.asarray(vertices, np.float64), np.asarray(triangles)
    shapes_fit = points.ndim == 2 and rows.ndim == 2 and points.shape[1] == rows.shape[1] == 3
    if not shapes_fit or not len(rows) or rows.dtype.kind not in "iu":
        raise VolfrepError(
            "A mesh has (n, 3) vertices and (m, 3) triangles of whole numbers, not arrays of the "
            f"shapes {points.shape} and {rows.shape}."
        )
    if rows.min() < 0 or rows.max() >= len(points):
        raise VolfrepError(f"A triangle names a vertex that is not among the {len(points)}.")
    if not np.isfinite(points).all():
        raise VolfrepError("A vertex of the mesh has a coordinate that is not a finite number.")
    return check_solid(TriangleMesh(points, rows.astype(np.int32)), "mesh")


def specified(
    spec: LatticeSpec | None, parameters: dict[str, Any], material: str | None
) -> LatticeSpec:
    """The specification with parameters of a call on top of it, as `fill` takes them.

    Raises:
        VolfrepError: there is no such parameter, or they make no sense.
    """
    refuse_unknown(parameters, accepted())
    young = 1.0
    if material is not None:
        from .mechanics.materials import find_material

        solid = find_material(material)
        young = solid.young
        parameters = {"density": solid.density, **parameters}
    parameters = own_data(parameters)
    plain = set(AIMS) | set(_WALL) | {"wall_formula"}
    try:
        if any(name not in plain and is_key(name, parameters[name]) for name in parameters):
            return spec_by_keys(spec, parameters, young)
        parameters = _with_wall(_with_target(parameters, spec, young), spec)
        if spec is None:
            return LatticeSpec(**parameters)
        return dataclasses.replace(spec, **parameters) if parameters else spec
    except VolfrepError:
        raise
    except (TypeError, ValueError, AttributeError, IndexError) as error:
        raise refuse_kind(parameters, error) from error


def accepted() -> set[str]:
    """The names of a call's parameters: the keys of a file, and the fields of a `LatticeSpec`."""
    return KEYS | FIELDS


def _with_wall(parameters: dict[str, Any], spec: LatticeSpec | None) -> dict[str, Any]:
    """The parameters with a `Wall` in place of what describes one."""
    given = {_WALL[name]: value for name, value in parameters.items() if name in _WALL}
    rest = {name: value for name, value in parameters.items() if name not in _WALL}
    formula = rest.pop("wall_formula", None)
    if given:
        rest["wall"] = dataclasses.replace(TpmsSheet() if spec is None else spec.wall, **given)
    if formula is not None:
        cell = rest.get("cell", FORMULA)
        if not isinstance(cell, str) or surface_name(cell) != FORMULA:
            raise VolfrepError(f"A wall_formula is of the cell {FORMULA}, not of another one.")
        rest["cell"] = find_surface(FORMULA, formula)
    return rest


def _with_target(
    parameters: dict[str, Any], spec: LatticeSpec | None, young: float
) -> dict[str, Any]:
    """The parameters with a `Target` in place of what one is given by."""
    target = read_target(parameters, young)
    rest = {name: value for name, value in parameters.items() if name not in AIMS}
    if target is not None:
        usual = spec or LatticeSpec()
        size, fillet = (parameters.get(n, getattr(usual, n)) for n in ("cell_size", "fillet"))
        rest |= {"target": target, "strut_radius": first_radius(size, fillet)}
    elif spec is not None and any(rest.get(name) is not None for name in THICKNESSES):
        rest["target"] = None
    return rest
