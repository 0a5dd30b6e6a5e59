# SPDX-License-Identifier: LGPL-2.1-or-later
"""What was made: looked at, checked, saved."""

from __future__ import annotations

import dataclasses
import os
from dataclasses import dataclass
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..design.grading import Field
from ..design.spec import LatticeSpec
from ..grid.strut_graph import Wireframe
from ..io.solid import Solid
from ..reports.report import Report
from ..reports.result import Result
from ..util.arguments import check_kind, check_path
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.types import Floats
from .drawing import drawing

if TYPE_CHECKING:
    import trimesh

    from ..jobs.as_printed import Printed
    from ..jobs.sizing import SizedPart
    from ..jobs.slices import Layers
    from ..mechanics.summary import CellProperties
    from ..output.writer import Source
    from ..reports.printability import PrintReport


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

    >>> import volfrep
    >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
    >>> part
    <Part of BCC: 20 struts, 6,008 triangles, 516.5 mm3, 0.52 g>
    """

    result: Result
    spec: LatticeSpec
    solid: Solid | None
    cache: StageCache
    source: Source
    sized: SizedPart | None = None

    def __repr__(self) -> str:
        report = self.report
        struts = f"{report.struts:,} struts, " * bool(report.struts)
        return (
            f"<Part of {report.lattice}: {struts}"
            f"{report.triangles:,} triangles, {report.volume_mm3:,.1f} mm3, {report.mass_g:,.2f} g>"
        )

    def _repr_html_(self) -> str:
        """Its figures, beside a drawing of its struts, for a notebook."""
        rows = "".join(
            f"<tr><th>{escape(name)}</th><td>{escape(text[:200])}</td></tr>"
            for name, text in self.report.figures.items()
            if name != "Specification"
        )
        return f"{drawing(self.struts)}<table>{rows}</table>"

    @cached_property
    def mesh(self) -> trimesh.Trimesh:
        """The mesh, mm; its vertices and faces are those of `result.mesh`, none merged.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> part.mesh.is_watertight, round(part.mesh.volume) == round(part.report.volume_mm3)
        (True, True)
        """
        import trimesh  # slow to import

        made = self.result.mesh
        return trimesh.Trimesh(made.vertices, made.triangles, process=False)

    @property
    def struts(self) -> Wireframe:
        """The unique nodes and struts of the active cells, with their radii, mm.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> part.struts.struts.shape, float(part.struts.radii.max())
        ((20, 2), 1.0)
        """
        return self.result.wireframe

    @property
    def nodes(self) -> NDArray[np.float64]:
        """(n, 3) nodes of `struts`, mm.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> part.nodes.shape, part.nodes.max(axis=0).tolist()
        ((9, 3), [10.0, 10.0, 10.0])
        """
        return self.struts.nodes

    @cached_property
    def fields(self) -> dict[str, Floats]:
        """Values (n,) at the `nodes`, by name.

        ``radius``: of the thickest strut that ends there, mm; ``to_surface``: distance to the
        solid's surface, mm, where a solid was filled; ``field``: that of the radius, where one
        drives it.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius="1 + x / 50")
        >>> sorted(part.fields), float(part.fields["radius"].round(2).max())
        (['field', 'radius'], 1.2)
        """
        radius = np.zeros(len(self.nodes))
        np.maximum.at(radius, self.struts.struts, self.struts.radii)
        result = {"radius": radius}
        if self.solid is not None and len(radius):
            from ..spatial.proximity import closest_points

            result["to_surface"] = closest_points(self.solid, self.nodes)[1]
        grading = self.spec.radius_grading
        if grading is not None and isinstance(grading.field, Field):
            result["field"] = grading.field(self.nodes)
        return result

    @property
    def mass(self) -> float:
        """Of the mesh at the density of the specification, g.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", strut_radius=1, material="Ti-6Al-4V")
        >>> round(part.mass / part.report.volume_mm3 * 1000, 2)
        4.41
        """
        return self.report.mass_g

    @property
    def report(self) -> Report:
        """The figures: cells, struts, triangles, volume, mass, seconds, warnings.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> part.report.cells_active, part.report.bodies, part.report.watertight
        (1, 1, True)
        """
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
        check_path("path", path)
        from ..mechanics.materials import Material, find_material
        from ..output.form import find_form
        from ..output.writer import Settings, writer_of

        check_kind("form", form, (str, type(None)), "a word such as 'beams'")
        if form is None and layer is not None and not os.path.splitext(path)[1]:
            form = "png"
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

        >>> import tempfile, trimesh, volfrep
        >>> box = trimesh.creation.box((10, 10, 10))
        >>> part = volfrep.fill(box, cell="BCC", strut_radius=1, shell=1, resolution=8)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     part.layers(f"{folder}/layers", layer=1, pixel=0.5).count
        10
        """
        from ..output.form import words

        check_path("folder", folder)
        if form not in words("format"):
            raise VolfrepError(
                f"There is no format '{form}': choose one of {', '.join(words('format'))}."
            )
        return self.source.layers(folder, form, layer, pixel)

    def properties(self, *, exact: bool = False) -> CellProperties:
        """What the endless lattice of the part's cell and radius does, as `volfrep.properties`.

        Raises:
            VolfrepError: the lattice is graded, or a network, and so has no one stiffness.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> round(part.properties().values["E100"], 3)
        0.056
        """
        from ..jobs.figures.properties import lattice_properties

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

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> part.check("SLS").thinnest_strut_mm
        2.0
        """
        from ..grid.inclination import unit_direction
        from ..jobs.figures.print_check import check_print
        from ..jobs.pipeline import fill
        from ..reports.processes import find_process

        limits = find_process(process)
        unit_direction(build_direction)  # what is none is told before the work
        domain = None
        if self.solid is not None:
            inner = dataclasses.replace(self.spec, output="domain", drains=None)
            domain = fill(self.solid, inner, cache=self.cache).mesh
        return check_print(
            self.result.mesh, self.struts, domain, self.spec, limits, build_direction
        )

    def as_printed(
        self, table: str, build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    ) -> Printed:
        """How thick the struts come out of the printer.

        Args:
            table: LPBF-Ti64, LPBF-316L, SLS-PA12, or a .csv file of your own.
            build_direction: from the build plate up, of any length.

        Raises:
            VolfrepError: there is no such table, no struts, or the direction is none.

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=0.5)
        >>> part.as_printed("LPBF-316L").diameters
        (1.0227, 1.0227)
        """
        from ..design.as_printed import find_printed_table
        from ..jobs.as_printed import as_printed

        return as_printed(self.struts, find_printed_table(table), build_direction)

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

        >>> import volfrep
        >>> part = volfrep.block((1, 1, 1), cell="BCC", cell_size=10, strut_radius=1)
        >>> part.plot("part.png")  # doctest: +SKIP
        """
        from ..reports.picture import SIZE, picture

        if file is not None:
            check_path("file", file)
        picture(
            self.result.mesh,
            self.spec,
            file,
            solid=self.solid,
            cut=cut,
            size=size or SIZE,
        )
