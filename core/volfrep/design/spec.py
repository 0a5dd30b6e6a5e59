# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user asks for, validated once, before any work starts."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from ..util.content import digest_of
from ..util.errors import VolfrepError
from ..util.numbers import number
from .cells import UnitCell, find_cell, joint_radius
from .grading import CellMap, Orientation, RadiusGrading, SizeGrading, as_plain
from .graphs import GivenGraph, RandomGraph, StretchedCells
from .openings import DrainHoles, OpenFace
from .skins.kept_bodies import KeptBody
from .skins.own_faces import FaceSkin, KeptFace
from .spec_parts import (
    ACTIVATIONS,
    BOUNDARIES,
    DEFAULT_RELATIVE_DEVIATION,
    MAX_RESOLUTION,
    MIN_RESOLUTION,
    Boundary,
    Grid,
    Resolution,
    Skin,
    Struts,
)
from .target import Target
from .tpms import PeriodicSurface, TpmsSheet, find_surface
from .tpms.sheet import wanted_facets

__all__ = [
    "ACTIVATIONS",
    "BOUNDARIES",
    "DEFAULT_RELATIVE_DEVIATION",
    "MAX_RESOLUTION",
    "MIN_RESOLUTION",
    "OUTPUTS",
    "LatticeSpec",
]

OUTPUTS = ("part", "lattice", "domain")


@dataclass(frozen=True)
class LatticeSpec:
    """Everything that defines a lattice infill, as a user says it; lengths in mm.

    The stages of a run are given its parts: `grid`, `struts`, `skin`, `drains`, `ending`,
    `detail`. Files that it names are read when it is made, and not again. It is equal to another
    one, and hashes alike, if and only if all its content is equal.

    Attributes:
        cell: name of a library cell, path of a cell's JSON file, or a `UnitCell`; for walls the
            name of a surface or a `PeriodicSurface`. One of the two classes once it is made.
        cell_size: L, edge of the cubic cell.
        strut_radius: r, of every strut.
        shell: thickness of the closed skin; 0 trims the lattice at the outer surface.
        resolution: facets along L, and never fewer than struts need (`coarsest_resolution`); or
        deviation: largest distance in mm between a facet and the exact struts and joints, kept
            within 1.5 times but for cells that docs/limits.md names. With neither, the
            deviation is `DEFAULT_RELATIVE_DEVIATION` r.
        activation: ``touching`` (every cell that touches the domain), ``centre`` (cells whose
            centre lies inside it: the rule of the paper) or ``inside`` (cells that lie wholly
            inside it).
        boundary: ``trim`` (the lattice is cut at the wall of its domain) or ``whole`` (active
            cells stay whole, with full round struts; a skin joins what reaches into it, and its
            outside still cuts).
        open_faces: faces of the part that have no skin (`volfrep.design.openings`); the cavity
            opens there, and struts are cut flush.
        face_skins: faces with a skin thickness of their own (`FaceSkin`); 0 opens them.
        keep_solid: faces round which the part stays solid (`KeptFace`), and bodies whose room in
            it does (`KeptBody`).
        drains: holes through the skin (`volfrep.design.openings`); None for none.
        remove_dangling: take away struts with a free end, again and again until there are none.
        shortest_stub: struts with a free end that are shorter than this are taken away; 0 for
            none, mm.
        remove_below: struts that are nowhere thicker than this radius are taken away; 0 for
            none, mm.
        keep_pieces: keep pieces of the lattice that hang on nothing.
        output: ``part`` (skin and lattice), ``lattice`` (trimmed) or ``domain`` (what it fills).
        fillet: radius of the round between struts at a joint; 0 for none.
        origin: a point that is to be a cell's corner; None puts the grid at the part's box.
        density: of the material in g/cm3.
        size_grading: cells that grow along a direction; None for equal cells.
        radius_grading: struts whose radius varies, in place of `strut_radius`; None for one radius.
        cell_map: cells about an axis or a centre; None for cells along straight axes.
        orientation: the lattice turned; None for along x, y, z.
        keep_radius: where cells are stretched or bent, struts stay straight and round: the nodes
            are moved and joined anew. False: they are deformed with their cells, as published.
        network: nodes and struts in place of cells (`volfrep.design.graphs`); None for cells,
            which becomes a `StretchedCells` where these are no cubes or their struts differ.
            `cell_size` is then how far apart random points lie where their number is not given.
        target: what `strut_radius` is to be chosen for (`volfrep.jobs.targets` does); None where
            it counts as it is. Of walls, the thickness or offset is chosen.
        wall: what is solid beside a cell's surface (`volfrep.design.tpms`); of no effect for
            struts. A radius grading is that of the thickness of a sheet, in mm.

    Raises:
        VolfrepError: at construction, naming the first value that makes no sense.

    >>> spec = LatticeSpec(cell="Octet", cell_size=8, strut_radius=0.6, shell=1.5)
    >>> spec.cell.name, spec.struts.radius, spec.skin.thickness
    ('Octet', 0.6, 1.5)
    >>> spec == LatticeSpec(cell="octet", cell_size=8.0, strut_radius=0.6, shell=1.5)
    True
    >>> LatticeSpec(cell_size=8, strut_radius=0)
    Traceback (most recent call last):
    volfrep.util.errors.VolfrepError: The strut radius must be above 0 mm, not 0.
    """

    cell: str | UnitCell | PeriodicSurface = "CVC"
    cell_size: float = 10.0
    strut_radius: float = 1.0
    shell: float = 2.0
    resolution: int | None = None
    deviation: float | None = None
    activation: str = "touching"
    boundary: str = "trim"
    open_faces: tuple[OpenFace, ...] = ()
    face_skins: tuple[FaceSkin, ...] = ()
    keep_solid: tuple[KeptFace | KeptBody, ...] = ()
    drains: DrainHoles | None = None
    remove_dangling: bool = False
    shortest_stub: float = 0.0
    remove_below: float = 0.0
    keep_pieces: bool = False
    output: str = "part"
    fillet: float = 0.0
    origin: tuple[float, float, float] | None = None
    density: float = 1.0
    size_grading: SizeGrading | None = None
    radius_grading: RadiusGrading | None = None
    cell_map: CellMap | None = None
    orientation: Orientation | None = None
    keep_radius: bool = True
    target: Target | None = None
    network: GivenGraph | RandomGraph | StretchedCells | None = None
    wall: TpmsSheet = field(default_factory=TpmsSheet)

    def __post_init__(self) -> None:
        if isinstance(self.cell, str):
            cell = find_surface(self.cell) or find_cell(self.cell)
            object.__setattr__(self, "cell", cell)
        if self.network is None and self.surface is None and not self.unit_cell().is_plain:
            object.__setattr__(self, "network", StretchedCells())
        grid = self.grid
        object.__setattr__(self, "origin", grid.origin)
        skins = tuple(self.face_skins)
        is_open = tuple(skin.face for skin in skins if skin.thickness == 0.0)
        object.__setattr__(self, "open_faces", (*self.open_faces, *is_open))
        object.__setattr__(self, "face_skins", tuple(s for s in skins if s.thickness > 0.0))
        object.__setattr__(self, "keep_solid", tuple(self.keep_solid))
        number("strut radius", self.strut_radius, "mm", positive=True)
        number("shell thickness", self.shell, "mm", positive=False)
        number("density", self.density, "g/cm3", positive=True)
        if self.network is not None:
            self._refuse_beside_network()
        elif self.surface is not None:
            self._refuse_beside_walls()
            _ = self.facets_along_cell
        else:
            self.struts.refuse_too_thick(grid.size)
            _ = self.facets_along_cell
        _ = self.ending
        if self.target is not None and self.radius_grading is not None:
            raise VolfrepError(
                f"A target of {self.target.called} chooses one radius for every strut: leave the "
                "radius grading out."
            )
        if self.output not in OUTPUTS:
            raise VolfrepError(
                f"There is no output '{self.output}': choose one of {', '.join(OUTPUTS)}."
            )
        of_skin = self.open_faces or self.face_skins or self.keep_solid or self.drains is not None
        if self.shell == 0 and of_skin:
            raise VolfrepError(
                "Open faces, drain holes, faces with a skin of their own, and what is kept solid, "
                "need a skin that they belong to: give a shell thickness above 0."
            )
        if self.drains is not None and self.output == "lattice":
            raise VolfrepError("Drain holes go through the skin of a part: choose the output part.")

    def _refuse_beside_network(self) -> None:
        """Refuse what is about cells, of which a network has none."""
        given = {
            "size grading": self.size_grading is not None,
            "cell map": self.cell_map is not None,
            "fillet": self.fillet > 0.0,
            "removal of struts": self.ending.removes_struts,
            "target of stiffness": self.target is not None and self.target.aim == "stiffness",
            "wall": self.surface is not None,
            "choice of active cells": self.activation != "touching",
            "boundary of whole cells": self.boundary == "whole" and self.with_skin,
        }
        for what, is_given in given.items():
            if is_given:
                if isinstance(self.network, StretchedCells):
                    raise VolfrepError(
                        f"A {what} is for cells that are cubes with struts of one radius, which "
                        f"'{self.unit_cell().name}' is not: leave it out, or choose another cell."
                    )
                raise VolfrepError(f"A {what} is for cells and not for a network: leave it out.")
        if isinstance(self.network, RandomGraph):
            for what, value in (("orientation", self.orientation), ("origin", self.origin)):
                if value is not None:
                    raise VolfrepError(
                        f"An {what} moves a lattice that is given, and not random points: leave it "
                        "out, or take another seed."
                    )
        own = isinstance(self.network, GivenGraph) and len(self.network.radii)
        if own and self.target is not None:
            raise VolfrepError(
                f"The network's own radii say how thick its struts are: leave the target of "
                f"{self.target.called} out, or the radii."
            )

    def _refuse_beside_walls(self) -> None:
        """Refuse what is about struts, of which walls have none."""
        given = {
            "fillet": self.fillet > 0.0,
            "removal of struts": self.ending.removes_struts,
            "radius grading": self.radius_grading is not None and not self.wall.is_sheet,
        }
        for what, is_given in given.items():
            if is_given:
                kind = "walls" if what != "radius grading" else f"a {self.wall.kind}"
                raise VolfrepError(f"A {what} is not for {kind}: leave it out.")
        if self.boundary != "trim" or self.activation != "touching":
            raise VolfrepError(
                "Walls are cut at the wall of what they fill: choose the boundary trim and the "
                "activation touching."
            )
        if self.thicknesses[1] >= self.cell_size:
            raise VolfrepError(
                f"Walls of {self.thicknesses[1]:g} mm are too thick for a cell of "
                f"{self.cell_size:g} mm: reduce the thickness or enlarge the cell."
            )

    @property
    def grid(self) -> Grid:
        """Where the cells lie."""
        return Grid(self.cell_size, self.origin, self.size_grading, self.cell_map, self.orientation)

    @property
    def struts(self) -> Struts:
        """How thick struts are, and how they meet."""
        radius = self.strut_radius if self.radius_grading is None else self.radius_grading
        return Struts(radius, self.fillet, self.keep_radius)

    @property
    def surface(self) -> PeriodicSurface | None:
        """The surface that walls follow; None where the lattice is of struts."""
        return self.cell if isinstance(self.cell, PeriodicSurface) else None

    @property
    def thicknesses(self) -> tuple[float, float]:
        """The smallest and the largest thickness of a sheet, mm; 0 for one side of a surface."""
        if not self.wall.is_sheet:
            return 0.0, 0.0
        if self.radius_grading is not None:
            return self.radius_grading.extremes
        return self.wall.thickness, self.wall.thickness

    @property
    def skin(self) -> Skin | None:
        """The part's skin; None for none."""
        if self.shell == 0:
            return None
        return Skin(self.shell, self.open_faces, self.face_skins, self.keep_solid)

    @property
    def ending(self) -> Boundary:
        """Where the lattice ends."""
        return Boundary(
            self.activation, self.boundary, self.remove_dangling, self.shortest_stub,
            self.keep_pieces, self.remove_below,
        )  # fmt: skip

    @property
    def detail(self) -> Resolution:
        """How fine the facets of struts are."""
        return Resolution(self.resolution, self.deviation)

    @property
    def joint_radius(self) -> float:
        """Radius of the joint spheres, r (1 + r / L) (Eq. 8 of the paper)."""
        return joint_radius(self.strut_radius, self.cell_size)

    @property
    def with_skin(self) -> bool:
        """Whether skin and lattice are asked for as one part."""
        return self.output == "part" and self.skin is not None

    def skin_volume(self, whole: float, inside: float) -> float:
        """Volume of the skin that is asked for with the lattice, mm3; 0 where none is.

        Args:
            whole: volume of the solid, mm3.
            inside: of what lies within the skin, mm3.
        """
        return abs(whole) - inside if self.with_skin else 0.0

    @property
    def is_cut(self) -> bool:
        """Whether a wall cuts what is asked for."""
        return self.boundary == "trim" or self.with_skin

    @property
    def is_graded(self) -> bool:
        """Whether the lattice is anything but equal cells along x, y, z."""
        return self.varies or self.orientation is not None

    @property
    def varies(self) -> bool:
        """Whether octants differ from place to place."""
        parts = (self.size_grading, self.radius_grading, self.cell_map)
        return any(part is not None for part in parts)

    @property
    def streams(self) -> bool:
        """Whether a file of its result needs no mesh of what the wall does not cut.

        Where struts vary, faces that are open and drain holes do.
        """
        is_cut_again = bool(self.open_faces) or self.drains is not None
        return self.is_cut and self.network is None and not (self.varies and is_cut_again)

    @property
    def template_radius(self) -> float:
        """The radius that octants are meshed for, between the extremes, mm."""
        return self.struts.template_radius

    @property
    def facets_along_cell(self) -> int:
        """How many facet edges fit along L: the resolution, or what the deviation asks for."""
        if self.surface is None:
            return self.detail.along_cell(self.cell_size, self.struts)
        wanted = self.resolution or wanted_facets(self.cell_size, self.detail.deviation)
        facets = max(wanted, self.coarsest_resolution)
        if facets > MAX_RESOLUTION:
            raise VolfrepError(
                f"Such walls need {facets} facets along a cell: the limit is {MAX_RESOLUTION}; "
                "make them thicker, the cells smaller or the deviation larger."
            )
        return facets

    @property
    def coarsest_resolution(self) -> int:
        """Facets along L below which struts would not have their volume, or sheets have gaps."""
        if self.surface is not None:
            return self.wall.coarsest(self.cell_size, self.thicknesses[0])
        return self.detail.coarsest(self.cell_size, self.struts)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what is made otherwise than it was asked for."""
        if self.resolution is None or self.network is not None:
            return ()
        facets = self.facets_along_cell
        if facets <= self.resolution:
            return ()
        what = (
            f"struts of radius {self.template_radius:.3g} mm, which would not have their volume"
            if self.surface is None
            else f"walls of {self.thicknesses[0]:.3g} mm, which would have gaps"
        )
        return (
            f"A resolution of {self.resolution} is too coarse for {what}: {facets} facets along a "
            "cell are made.",
        )

    def unit_cell(self) -> UnitCell:
        """The cell of struts, as it was when the specification was made.

        Raises:
            VolfrepError: it is one of walls.
        """
        if not isinstance(self.cell, UnitCell):
            raise VolfrepError(
                f"This is done with struts and not with the walls of a {self.cell_name}: choose "
                "another cell."
            )
        return self.cell

    @property
    def fitted_cell(self) -> UnitCell | None:
        """The cell whose joints stiffen the ends of beams; None for a network, of which none is.

        Raises:
            VolfrepError: the lattice is of walls.
        """
        return self.unit_cell() if self.network is None else None

    @property
    def cell_name(self) -> str:
        """What the cell is called, of struts or of walls."""
        assert not isinstance(self.cell, str)
        return self.cell.name

    def digest(self) -> str:
        """What tells it from every other one, by all its content (`util.content.digest_of`).

        Equal specifications have equal ones. Where files were read does not count, nor what has
        no effect: a wall beside struts, and lengths of picked faces and bodies below 1e-6 mm.

        >>> LatticeSpec(cell="octet").digest() == LatticeSpec(cell="Octet").digest()
        True
        """
        return digest_of(self if self.surface is not None else replace(self, wall=TpmsSheet()))

    def shape_digest(self) -> str:
        """As `digest`, of all that the geometry depends on.

        That is not the density, unless a mass drives the radius.
        """
        by_mass = self.target is not None and self.target.aim == "mass"
        return (self if by_mass else replace(self, density=1.0)).digest()

    def as_dict(self) -> dict[str, Any]:
        """The specification as plain JSON values."""
        values = {name: as_plain(getattr(self, name)) for name in self.__dataclass_fields__}
        values["cell"] = self.cell_name
        del values["wall"]
        if self.surface is not None:
            values["wall"] = {"formula": self.surface.formula, **self.wall.as_plain()}
        return values
