# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user asks for, validated once, before any work starts."""

from __future__ import annotations

from dataclasses import dataclass, is_dataclass, replace
from typing import Any

from ..util.arguments import check_kind
from ..util.content import digest_of
from ..util.errors import VolfrepError, brief
from ..util.numbers import number
from .cells import UnitCell, any_cell
from .grading import CellMap, Orientation, RadiusGrading, SizeGrading, as_json
from .kinds import Kind, kind_of
from .openings import DrainHoles
from .sampled_field import SampledField
from .scattered_field import PointField
from .spec_fields import SpecFields
from .spec_parts import (
    ACTIVATIONS,
    BOUNDARIES,
    DEFAULT_RELATIVE_DEVIATION,
    MAX_RESOLUTION,
    MIN_RESOLUTION,
    FlatStruts,
)
from .target import Target
from .tpms import TpmsSheet

__all__ = [
    "ACTIVATIONS",
    "BOUNDARIES",
    "DEFAULT_RELATIVE_DEVIATION",
    "MAX_RESOLUTION",
    "MIN_RESOLUTION",
    "OUTPUTS",
    "LatticeSpec",
]

#: Fields that hold a part of their own, or None.
_PARTS = {
    "drains": DrainHoles,
    "flat_struts": FlatStruts,
    "size_grading": SizeGrading,
    "radius_grading": RadiusGrading,
    "cell_map": CellMap,
    "orientation": Orientation,
    "target": Target,
    "wall": TpmsSheet,
}
OUTPUTS = ("part", "lattice", "domain")


@dataclass(frozen=True)
class LatticeSpec(SpecFields):
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
        skin_field: thickness of the skin at points, mm: below all other faces it
            follows that, and is nowhere thinner than `shell`; None for the same everywhere.
        drains: holes through the skin (`volfrep.design.openings`); None for none.
        remove_dangling: take away struts with a free end, again and again until there are none.
        shortest_stub: struts with a free end that are shorter than this are taken away; 0 for
            none, mm.
        remove_below: struts that are nowhere thicker than this radius are taken away; 0 for
            none, mm.
        flat_struts: struts that lie too flat to be built are taken away, and those with a free end
            then (`volfrep.design.spec_parts`); None for none.
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

    def __post_init__(self) -> None:
        for name, kind in _PARTS.items():
            check_kind(name, getattr(self, name), (kind, type(None)), f"a {kind.__name__}")
        check_kind("skin_field", self.skin_field, (PointField, SampledField, type(None)), "a field")
        for name in ("open_faces", "face_skins", "keep_solid"):
            check_kind(name, getattr(self, name), (tuple, list), "a tuple")
            for one in getattr(self, name):
                if not is_dataclass(one):
                    raise VolfrepError(f"'{name}' cannot hold {brief(one)}.")
        if isinstance(self.cell, str):
            cell = any_cell(self.cell)
            object.__setattr__(self, "cell", cell)
        object.__setattr__(self, "network", self.kind.network)
        grid = self.grid
        object.__setattr__(self, "origin", grid.origin)
        skins = tuple(self.face_skins)
        is_open = tuple(skin.face for skin in skins if skin.thickness == 0.0)
        object.__setattr__(self, "open_faces", (*self.open_faces, *is_open))
        object.__setattr__(self, "face_skins", tuple(s for s in skins if s.thickness > 0.0))
        object.__setattr__(self, "keep_solid", tuple(self.keep_solid))
        number("strut radius", self.strut_radius, "mm", positive=True)
        number("skin thickness", self.shell, "mm", positive=False)
        number("density", self.density, "g/cm3", positive=True)
        self.kind.refuse()
        _ = self.ending
        if self.target is not None and self.radius_grading is not None:
            raise VolfrepError(
                f"A target of {self.target.called} chooses one radius for every strut: leave the "
                "radius grading out."
            )
        if self.output not in OUTPUTS:
            raise VolfrepError(
                f"There is no output {brief(self.output)}: choose one of {', '.join(OUTPUTS)}."
            )
        of_skin = self.open_faces or self.face_skins or self.keep_solid or self.drains is not None
        if self.shell == 0 and (of_skin or self.skin_field is not None):
            raise VolfrepError(
                "Open faces, drain holes, faces with a skin of their own, and what is kept solid, "
                "need a skin that they belong to: give a skin thickness above 0."
            )
        flat, drains = self.flat_struts, self.drains
        if flat and drains and flat.build_direction != drains.build_direction:
            raise VolfrepError(
                f"Flat struts go by a build direction of {flat.build_direction}, and drain holes "
                f"by {drains.build_direction}: a part has one."
            )
        if self.drains is not None and self.output == "lattice":
            raise VolfrepError("Drain holes go through the skin of a part: choose the output part.")

    @property
    def kind(self) -> Kind:
        """The kind of lattice that it is of."""
        return kind_of(self)

    def with_thickness(self, value: float) -> LatticeSpec:
        """The same with struts, or walls, of a thickness: `Kind.measure` in mm."""
        return replace(self, **self.kind.of_thickness(value))

    @property
    def streams(self) -> bool:
        """Whether a file of its result needs no mesh of what the wall does not cut.

        Where struts vary, faces that are open and drain holes do.
        """
        is_cut_again = bool(self.open_faces) or self.drains is not None
        return self.is_cut and self.kind.is_cut_in_groups and not (self.varies and is_cut_again)

    @property
    def facets_along_cell(self) -> int:
        """How many facet edges fit along L: the resolution, or what the deviation asks for."""
        return self.kind.facets_along_cell

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what is made otherwise than it was asked for."""
        what = self.kind.too_coarse
        if self.resolution is None or what is None:
            return ()
        facets = self.facets_along_cell
        if facets <= self.resolution:
            return ()
        return (
            f"A resolution of {self.resolution} is too coarse for {what}: {facets} facets along a "
            "cell are made.",
        )

    def unit_cell(self) -> UnitCell:
        """The cell of struts, as it was when the specification was made.

        Raises:
            VolfrepError: it is one of walls.
        """
        return self.kind.unit_cell()

    def digest(self) -> str:
        """What tells it from every other one, by all its content (`util.content.digest_of`).

        Equal specifications have equal ones. Where files were read does not count, nor what has
        no effect: a wall beside struts, and lengths of picked faces and bodies below 1e-6 mm.

        >>> LatticeSpec(cell="octet").digest() == LatticeSpec(cell="Octet").digest()
        True
        """
        return digest_of(replace(self, **self.kind.without_effect))

    def shape_digest(self) -> str:
        """As `digest`, of all that the geometry depends on.

        That is not the density, unless a mass drives the radius.
        """
        by_mass = self.target is not None and self.target.aim == "mass"
        return (self if by_mass else replace(self, density=1.0)).digest()

    def as_dict(self) -> dict[str, Any]:
        """The specification as plain JSON values."""
        values = {name: as_json(getattr(self, name)) for name in self.__dataclass_fields__}
        values["cell"] = self.cell_name
        del values["wall"]
        if self.skin_field is None:  # kept reports do not have it
            del values["skin_field"]
        return values | self.kind.as_json()
