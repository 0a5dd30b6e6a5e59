# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview of a lattice infill: what its present properties would make, at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.engine import require_engine
from freecad_volfrep.features.properties.quantities import mass_of
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, figure, grouped, translate
from volfrep.design.target import Target
from volfrep.util.content import digest_of

from .freshness import is_of
from .materials import advice, material_of

if TYPE_CHECKING:
    from volfrep.design.forecast import Forecast
    from volfrep.design.spec import LatticeSpec
    from volfrep.jobs.preview import Preview
    from volfrep.mesh.triangle_mesh import TriangleMesh
    from volfrep.util.progress import Monitor


#: The property of each driver of the radius.
TARGETS = {
    "Relative density": "TargetDensity",
    "Mass": "TargetMass",
    "Stiffness": "TargetStiffness",
}
#: What a target has come to, by the parameter that says how thick the lattice is.
_THICKNESS = {
    "strut_radius": QT_TRANSLATE_NOOP("VolfrepFigures", "strut radius {radius} mm"),
    "wall_thickness": QT_TRANSLATE_NOOP("VolfrepFigures", "thickness {radius} mm"),
    "wall_offset": QT_TRANSLATE_NOOP("VolfrepFigures", "offset {radius} mm"),
}


@dataclass(frozen=True, eq=False)
class Shown:
    """What is shown while values change.

    Attributes:
        solid: in the coordinates of the infill's group.
        preview: the struts and their figures.
        forecast: what computing it comes to.
        advice: sentences on what does not suit the chosen process.
        stiffness: Young's modulus along the chosen direction, MPa; None without a material, or
            for a cell or radius that the catalogue does not have.
        is_made: whether the infill's mesh is of these values.
        is_sized: whether what struts carry is kept of these values.
    """

    solid: TriangleMesh
    preview: Preview
    forecast: Forecast
    advice: tuple[str, ...] = ()
    stiffness: float | None = None
    is_made: bool = False
    is_sized: bool = False

    @property
    def text(self) -> str:
        """The figures as lines for a user."""
        p, f = self.preview, self.forecast
        figures = translate(
            "VolfrepFigures",
            "{what}\n"
            "relative density {density} %, mass {mass} g\n"
            "about {triangles} triangles, {size} MB as STL, "
            "{seconds} s to compute",
        ).format(
            what=", ".join(self._counted()),
            density=figure(100 * p.relative_density, 3),
            mass=figure(p.mass, 4),
            triangles=figure(f.triangles),
            size=figure(f.stl_mb),
            seconds=figure(max(1.0, f.seconds)),
        )
        found = ()
        if p.spec.target is not None:
            found = (
                translate("VolfrepFigures", _THICKNESS[p.spec.kind.measure]).format(
                    radius=figure(p.spec.kind.thickness, 4)
                ),
            )
        return "\n".join((*found, figures, *self.advice))

    def _counted(self) -> list[str]:
        """What there is of cells and struts; a TPMS has none of these, a network none of those."""
        counts = (
            (translate("VolfrepFigures", "{number} active cells"), self.preview.cells),
            (translate("VolfrepFigures", "{number} struts"), self.preview.struts),
        )
        return [text.format(number=grouped(number)) for text, number in counts if number]

    def figure(self, driver: str) -> float | None:
        """What is shown of what a driver of the radius aims at: a share of 1, g or MPa."""
        figures = {
            "Relative density": self.preview.relative_density,
            "Mass": self.preview.mass,
            "Stiffness": self.stiffness,
        }
        return figures[driver]


@dataclass(frozen=True, eq=False)
class Asked:
    """What a preview is to be of: all that is read of the document for it.

    Attributes:
        spec: the lattice.
        mesh: the solid, not checked, in the coordinates of the infill's group.
        name: the solid's, for sentences on what is wrong with it.
    """

    spec: LatticeSpec
    mesh: TriangleMesh
    name: str


@dataclass(frozen=True, eq=False)
class Answer:
    """What the engine makes of it; attributes as of `Shown`."""

    solid: TriangleMesh
    preview: Preview
    forecast: Forecast


class LivePreview:
    """Makes previews of one infill; what depends on its solid alone is kept between them.

    `answer` touches nothing of the document and may be called on another thread, one at a time.
    """

    def __init__(self, obj: App.DocumentObject) -> None:
        self._obj = obj
        self._key = ""
        self._known: Any = None

    def show(self) -> Shown:
        """The preview of the object's present properties.

        Raises:
            VolfrepError: they make no sense, or do not fit the solid.
        """
        from volfrep.util.progress import Monitor

        asked = self.ask()
        return self.shown(asked, self.answer(asked, Monitor()))

    def ask(self, spec: LatticeSpec | None = None) -> Asked:
        """Read what a preview of the present properties needs; or of another specification.

        Raises:
            VolfrepError: a property makes no sense, or there is no solid.
        """
        require_engine()
        present, mesh = self._obj.Proxy.read(self._obj)
        return Asked(present if spec is None else spec, mesh, self._obj.Base.Label)

    def answer(self, asked: Asked, monitor: Monitor) -> Answer:
        """Make what was asked for.

        Raises:
            VolfrepError: it makes no sense, or does not fit the solid.
            Cancelled: the monitor says so.
        """
        from volfrep.design.forecast import forecast_fill
        from volfrep.io.solid import check_solid
        from volfrep.jobs.preview import PartDepth, preview

        spec, mesh = asked.spec, asked.mesh
        faces = (spec.open_faces, spec.face_skins, spec.keep_solid)
        key = digest_of(mesh.vertices, mesh.triangles, faces)
        if self._key != key:
            solid = check_solid(mesh, asked.name)
            monitor.tick()
            self._known = solid, PartDepth(solid, *faces, monitor)
            self._key = key
        solid, depth = self._known
        depth.monitor = monitor
        shown = preview(solid, spec, depth)
        monitor.tick()
        return Answer(solid, shown, forecast_fill(solid, shown.spec))

    def shown(self, asked: Asked, answer: Answer) -> Shown:
        """The answer, and what the document says about it.

        Raises:
            VolfrepError: its material makes no sense.
        """
        spec = answer.preview.spec
        return Shown(
            answer.solid,
            answer.preview,
            answer.forecast,
            advice(self._obj, spec.struts.extremes[0]),
            stiffness_of(self._obj, spec),
            is_of(self._obj.Fingerprint, self._obj, asked.spec, asked.mesh),
            is_of(self._obj.SizedFor, self._obj, asked.spec, asked.mesh),
        )


def made_text(obj: App.DocumentObject) -> str:
    """The figures of an infill's mesh as a line for a user."""
    return str(
        translate("VolfrepFigures", "{mass} g, {triangles} triangles, made in {seconds} s").format(
            mass=figure(mass_of(obj), 4),
            triangles=grouped(obj.Triangles),
            seconds=figure(max(0.1, obj.Seconds)),
        )
    )


def stiffness_of(obj: App.DocumentObject, spec: LatticeSpec) -> float | None:
    """Young's modulus along the chosen direction, MPa, where it is known at once."""
    from volfrep.jobs.stiffness_target import modulus
    from volfrep.mechanics.catalogue import known_cell

    material, cell = material_of(obj), spec.kind.catalogue_cell
    known = None if cell is None else known_cell(cell)
    if material is None or cell is None or known is None:
        return None
    ratio = spec.strut_radius / spec.cell_size
    if not known.ratios[0] <= ratio <= known.ratios[-1]:
        return None
    aim = Target("stiffness", 1.0, tuple(obj.StiffnessDirection), material.young)
    return modulus(cell, ratio, aim)
