# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts of a specification: what each stage of a run is given, and nothing else.

Every part is immutable, checked when it is made, and equal to another one if and only if all that
it holds is equal: the points of a field and the facets of an open face included. So a stage's
result may be kept under the parts that went into it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError, listed
from ..util.numbers import direction, number, point, whole
from ..util.types import Floats
from .grading import CellMap, Field, Orientation, RadiusGrading, SizeGrading, Vector
from .openings import OpenFace
from .skins.kept_bodies import KeptBody
from .skins.own_faces import FaceSkin, KeptFace, Thicknesses, thicknesses

ACTIVATIONS = ("touching", "centre", "inside")
BOUNDARIES = ("trim", "whole")

#: Deviation from the exact surface in units of the strut radius, where the user says nothing.
#: About nine facets round a strut.
DEFAULT_RELATIVE_DEVIATION = 1.0 / 35.0
MIN_RESOLUTION, MAX_RESOLUTION = 4, 400
#: No facet is longer than this many strut radii: fewer than about six round a strut cannot be
#: placed so that its volume is right. Nor are there fewer than so many along L, whose edges could
#: not follow the windows between thick struts.
LONGEST_FACET = 1.0
COARSEST = 8
#: The resolution that is chosen for thick struts, whose windows are smaller than they are.
MIN_AUTOMATIC_RESOLUTION = 15


@dataclass(frozen=True)
class Grid:
    """Where the cells lie.

    Attributes:
        size: L, edge of the cubic cell, mm.
        origin: a point that is to be a cell's corner, mm; None puts the grid at the part's box.
        size_grading: cells that grow along a direction; None for equal cells.
        cell_map: cells about an axis or a centre; None for cells along straight axes.
        orientation: the lattice turned; None for along x, y, z.
    """

    size: float
    origin: Vector | None = None
    size_grading: SizeGrading | None = None
    cell_map: CellMap | None = None
    orientation: Orientation | None = None

    def __post_init__(self) -> None:
        number("cell size", self.size, "mm", positive=True)
        if self.origin is not None:
            point("origin", self.origin)
            x, y, z = self.origin
            object.__setattr__(self, "origin", (x, y, z))


@dataclass(frozen=True)
class Struts:
    """How thick struts are, and how they meet.

    Attributes:
        radius: r in mm, of every strut, or how it varies.
        fillet: radius of the round between struts at a joint; 0 for none, mm.
        keep_radius: where cells are stretched or bent, struts stay straight and round. False:
            they are deformed with their cells, as published.
    """

    radius: float | RadiusGrading
    fillet: float = 0.0
    keep_radius: bool = True

    def __post_init__(self) -> None:
        for value in self.extremes:
            number("strut radius", value, "mm", positive=True)
        number("joint fillet", self.fillet, "mm", positive=False)

    @property
    def is_graded(self) -> bool:
        """Whether the radius varies."""
        return isinstance(self.radius, RadiusGrading)

    @property
    def extremes(self) -> tuple[float, float]:
        """The smallest and the largest radius of a strut, mm."""
        if isinstance(self.radius, RadiusGrading):
            return self.radius.extremes
        return float(self.radius), float(self.radius)

    @property
    def template_radius(self) -> float:
        """The radius that octants are meshed for, between the extremes, mm."""
        least, most = self.extremes
        return least if least == most else math.sqrt(least * most)

    def refuse_too_thick(self, size: float) -> None:
        """Raise a `VolfrepError` where joints reach half-way through a cell of a size in mm."""
        radius = self.extremes[1]
        if radius + radius * radius / size + self.fillet < size / 2:
            return
        limit = largest_radius(size, self.fillet)
        with_fillet = " with this fillet" if self.fillet else ""
        if limit <= 0:
            raise VolfrepError(
                f"A joint fillet of {self.fillet:g} mm is too large for a cell of {size:g} mm: "
                f"keep it below {size / 2:g} mm less the strut radius."
            )
        raise VolfrepError(
            f"Struts of radius {radius:g} mm are too thick for a cell of {size:g} mm{with_fillet}: "
            f"keep the radius below {limit:.4g} mm or enlarge the cell."
        )


@dataclass(frozen=True)
class Skin:
    """The closed skin of a part.

    Attributes:
        thickness: above 0, mm.
        open_faces: faces of the part that have none; the cavity opens there.
        face_skins: faces that have another thickness.
        keep_solid: faces round which the part stays solid, and bodies whose room does.
        field: the thickness below all other faces, mm, where that is more than `thickness`; None
            for the same everywhere.
    """

    thickness: float
    open_faces: tuple[OpenFace, ...] = ()
    face_skins: tuple[FaceSkin, ...] = ()
    keep_solid: tuple[KeptFace | KeptBody, ...] = ()
    field: Field | None = None

    def __post_init__(self) -> None:
        number("skin thickness", self.thickness, "mm", positive=True)
        for name in ("open_faces", "face_skins", "keep_solid"):
            object.__setattr__(self, name, tuple(getattr(self, name)))

    @property
    def is_even(self) -> bool:
        """Whether it is as thick everywhere as it is anywhere."""
        return not (self.face_skins or self.keep_solid) and self.field is None

    @property
    def deepest(self) -> float:
        """Its largest thickness below a face, mm."""
        kept = (one.distance for one in self.keep_solid if isinstance(one, KeptFace))
        most = self.thickness if self.field is None else self.field.range[1]
        return max(self.thickness, most, *(one.thickness for one in self.face_skins), *kept, 0.0)

    def thicknesses(self, solid: TriangleMesh) -> Thicknesses:
        """How thick it is below the triangles of a solid.

        Raises:
            VolfrepError: a face is not found, or all of them are open.
        """
        faces = tuple(one for one in self.keep_solid if isinstance(one, KeptFace))
        return thicknesses(solid, self.open_faces, self.face_skins, faces)

    def rough_volume(self, solid: TriangleMesh) -> float:
        """About its volume below the faces of a solid, mm3: their area times its thickness."""
        if self.is_even:
            return solid.area * self.thickness
        below = float((solid.areas() * self.below(solid)).sum())
        return below + sum(body.volume for body in self.bodies)

    def below(self, solid: TriangleMesh) -> Floats:
        """(m,) mm, how thick it is below each triangle of a solid; 0 where that is open.

        Raises:
            VolfrepError: a face is not found, or all of them are open.
        """
        lengths = self.thicknesses(solid)
        usual: float | Floats = self.thickness
        if self.field is not None:
            usual = np.maximum(self.thickness, self.field(np.mean(solid.corners(), axis=0)))
        result = np.where(lengths.usual, usual, 0.0)
        for faces, length in lengths.others:
            result = np.maximum(result, np.where(faces, length, 0.0))
        return result

    @property
    def bodies(self) -> tuple[TriangleMesh, ...]:
        """The bodies whose room stays solid."""
        return tuple(one.mesh for one in self.keep_solid if isinstance(one, KeptBody))


@dataclass(frozen=True)
class FlatStruts:
    """Struts that lie too flat to be built, and go.

    Attributes:
        inclination: to the build plate, degrees: those of less go.
        build_direction: from the build plate up, of any length.
    """

    inclination: float
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0)

    def __post_init__(self) -> None:
        number("least inclination", self.inclination, "degrees", positive=True)
        if self.inclination > 90.0:
            raise VolfrepError(
                f"The least inclination of struts is at most 90 degrees, not {self.inclination:g}."
            )
        direction("build direction", self.build_direction)


@dataclass(frozen=True)
class Boundary:
    """Where the lattice ends.

    Attributes:
        activation: ``touching``, ``centre`` or ``inside``: which cells are active.
        cut: ``trim`` (at the wall of the lattice's domain) or ``whole`` (active cells stay whole).
        remove_dangling: take away struts with a free end, until there are none.
        shortest_stub: struts with a free end that are shorter than this go; 0 for none, mm.
        keep_pieces: pieces of the lattice that hang on nothing stay.
        remove_below: struts that are nowhere thicker than this radius go; 0 for none, mm.
        flat_struts: those that go because they lie too flat, and what has a free end then; None
            for none.
    """

    activation: str = "touching"
    cut: str = "trim"
    remove_dangling: bool = False
    shortest_stub: float = 0.0
    keep_pieces: bool = False
    remove_below: float = 0.0
    flat_struts: FlatStruts | None = None

    def __post_init__(self) -> None:
        if self.activation not in ACTIVATIONS:
            raise VolfrepError(
                f"There is no activation '{self.activation}': choose one of "
                f"{', '.join(ACTIVATIONS)}."
            )
        if self.cut not in BOUNDARIES:
            raise VolfrepError(f"There is no boundary '{self.cut}': choose {listed(BOUNDARIES)}.")
        number("shortest stub", self.shortest_stub, "mm", positive=False)
        number("radius to remove below", self.remove_below, "mm", positive=False)

    @property
    def is_trimmed(self) -> bool:
        """Whether the wall of its domain cuts the lattice, with a skin or without."""
        return self.cut == "trim"

    def cuts_struts(self, skin: Skin | None) -> bool:
        """Whether a wall cuts the struts: that of their domain or, of whole cells, the skin's."""
        return self.is_trimmed or skin is not None

    @property
    def is_endless(self) -> bool:
        """Whether the octants are those of a lattice without end, of which the wall cuts a piece.

        What lies outside is cut off anyway. Otherwise they are those of the active cells, whose
        struts end round.
        """
        return self.activation == "touching" and self.is_trimmed

    @property
    def removes_struts(self) -> bool:
        """Whether struts go that are thin, lie flat or have a free end."""
        is_any = self.remove_dangling or self.shortest_stub > 0 or self.remove_below > 0
        return is_any or self.flat_struts is not None


@dataclass(frozen=True)
class Resolution:
    """How fine the facets of struts are.

    Attributes:
        facets: along L, and never fewer than struts need (`coarsest`); or
        deviation: largest distance in mm between a facet and the exact struts and joints, kept
            within 1.5 times but for cells that docs/limits.md names. With neither, the
            deviation is `DEFAULT_RELATIVE_DEVIATION` r.
    """

    facets: int | None = None
    deviation: float | None = None

    def __post_init__(self) -> None:
        if self.facets is not None and self.deviation is not None:
            raise VolfrepError("Give either a resolution or a deviation, not both.")
        if self.deviation is not None:
            number("deviation", self.deviation, "mm", positive=True)
        if self.facets is not None:
            whole("resolution", self.facets, MIN_RESOLUTION, MAX_RESOLUTION)

    def along_cell(self, size: float, struts: Struts) -> int:
        """How many facet edges fit along a cell of a size in mm.

        Facets of edge e fitted to a cylinder of radius r in the mean stray from it by up to
        e2 / (16 r) to either side (the sagitta of a chord, e2 / 8 r, halved by the fit). Where
        the radius varies, every strut has as many facets round it, and the thickest one strays
        most.

        Raises:
            VolfrepError: the deviation, or struts so thin, take more than `MAX_RESOLUTION`.
        """
        coarsest = self.coarsest(size, struts)
        if self.facets is not None:
            return max(int(self.facets), coarsest)
        radius = struts.template_radius**2 / struts.extremes[1]
        if self.deviation is None:
            radius = struts.template_radius
        deviation = self.deviation or DEFAULT_RELATIVE_DEVIATION * radius
        wanted = size / math.sqrt(16.0 * radius * deviation)
        if wanted > MAX_RESOLUTION:
            edge = size / MAX_RESOLUTION
            smallest = edge * edge / (16.0 * radius)
            raise VolfrepError(
                f"A deviation of {deviation:.3g} mm needs {wanted:.4g} facets along a cell: the "
                f"limit is {MAX_RESOLUTION}, which reaches {smallest:.3g} mm."
            )
        least = coarsest if self.deviation is not None else MIN_AUTOMATIC_RESOLUTION
        return max(math.ceil(wanted), least)

    @staticmethod
    def coarsest(size: float, struts: Struts) -> int:
        """Facets along a cell of a size in mm below which struts would not have their volume.

        Raises:
            VolfrepError: struts are so thin that not even the finest resolution follows them.
        """
        radius = struts.template_radius
        needed = math.ceil(size / (LONGEST_FACET * radius) - 1e-9)
        if needed > MAX_RESOLUTION:
            thinnest = size / (LONGEST_FACET * MAX_RESOLUTION)
            largest = LONGEST_FACET * MAX_RESOLUTION * radius
            raise VolfrepError(
                f"Cells of {size:g} mm are too large for struts of radius {radius:.3g} mm: make "
                f"the cells {largest:.4g} mm or smaller, or the struts {thinnest:.3g} mm or "
                "thicker."
            )
        return max(needed, COARSEST)


def largest_radius(size: float, fillet: float) -> float:
    """The r at which joint sphere and fillet reach half a cell: r + r2 / L + fillet = L / 2."""
    room = size / 2 - fillet
    return float(size * (math.sqrt(0.25 + max(room, 0.0) / size) - 0.5)) if room > 0 else 0.0


def first_radius(size: float, fillet: float) -> float:
    """A radius to begin with where another one is sought, mm; any if no radius goes with both."""
    return 0.25 * largest_radius(size, fillet) or size / 10
