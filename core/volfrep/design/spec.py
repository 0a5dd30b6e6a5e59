# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user asks for, validated once, before any work starts."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ..util.errors import VolfrepError
from .cells import UnitCell, find_cell, joint_radius
from .grading import CellMap, Orientation, RadiusGrading, SizeGrading, as_plain
from .openings import DrainHoles, OpenFace

ACTIVATIONS = ("touching", "centre", "inside")
BOUNDARIES = ("trim", "whole")
OUTPUTS = ("part", "lattice", "domain")

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
class LatticeSpec:
    """Everything that defines a lattice infill; lengths in mm.

    Attributes:
        cell: name of a library cell, path of a cell's JSON file, or a `UnitCell`.
        cell_size: L, edge of the cubic cell.
        strut_radius: r, of every strut.
        shell: thickness of the closed skin; 0 trims the lattice at the outer surface.
        resolution: facets along L, and never fewer than struts need (`coarsest_resolution`); or
        deviation: largest distance in mm between a facet and the exact strut. With neither,
            the deviation is `DEFAULT_RELATIVE_DEVIATION` r.
        activation: ``touching`` (every cell that touches the domain), ``centre`` (cells whose
            centre lies inside it: the rule of the paper) or ``inside`` (cells that lie wholly
            inside it).
        boundary: ``trim`` (the lattice is cut at the wall of its domain) or ``whole`` (active
            cells stay whole, with full round struts; a skin joins what reaches into it, and its
            outside still cuts).
        open_faces: faces of the part that have no skin (`volfrep.design.openings`); the cavity
            opens there, and struts are cut flush.
        drains: holes through the skin (`volfrep.design.openings`); None for none.
        remove_dangling: take away struts with a free end, again and again until there are none.
        shortest_stub: struts with a free end that are shorter than this are taken away; 0 for
            none, mm.
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

    Raises:
        VolfrepError: at construction, naming the first value that makes no sense.
    """

    cell: str | UnitCell = "CVC"
    cell_size: float = 10.0
    strut_radius: float = 1.0
    shell: float = 2.0
    resolution: int | None = None
    deviation: float | None = None
    activation: str = "touching"
    boundary: str = "trim"
    open_faces: tuple[OpenFace, ...] = ()
    drains: DrainHoles | None = None
    remove_dangling: bool = False
    shortest_stub: float = 0.0
    output: str = "part"
    fillet: float = 0.0
    origin: tuple[float, float, float] | None = None
    density: float = 1.0
    size_grading: SizeGrading | None = None
    radius_grading: RadiusGrading | None = None
    cell_map: CellMap | None = None
    orientation: Orientation | None = None
    keep_radius: bool = True

    def __post_init__(self) -> None:
        size = _number("cell size", self.cell_size, "mm", positive=True)
        _number("strut radius", self.strut_radius, "mm", positive=True)
        _number("shell thickness", self.shell, "mm", positive=False)
        _number("joint fillet", self.fillet, "mm", positive=False)
        _number("density", self.density, "g/cm3", positive=True)
        radius = self.radius_extremes[1]
        if radius + radius * radius / size + self.fillet >= size / 2:
            limit = _largest_radius(size, self.fillet)
            with_fillet = " with this fillet" if self.fillet else ""
            if limit <= 0:
                raise VolfrepError(
                    f"A joint fillet of {self.fillet:g} mm is too large for a cell of "
                    f"{size:g} mm: keep it below {size / 2:g} mm less the strut radius."
                )
            raise VolfrepError(
                f"Struts of radius {radius:g} mm are too thick for a cell of {size:g} mm"
                f"{with_fillet}: keep the radius below {limit:.4g} mm or enlarge the cell."
            )
        if self.resolution is not None and self.deviation is not None:
            raise VolfrepError("Give either a resolution or a deviation, not both.")
        if self.deviation is not None:
            _number("deviation", self.deviation, "mm", positive=True)
        if self.resolution is not None:
            whole = _number("resolution", self.resolution, "facets along L", positive=True)
            if whole != int(whole) or not MIN_RESOLUTION <= whole <= MAX_RESOLUTION:
                raise VolfrepError(
                    f"The resolution must be a whole number from {MIN_RESOLUTION} to "
                    f"{MAX_RESOLUTION}, not {self.resolution}."
                )
        if self.activation not in ACTIVATIONS:
            raise VolfrepError(
                f"There is no activation '{self.activation}': choose one of "
                f"{', '.join(ACTIVATIONS)}."
            )
        if self.boundary not in BOUNDARIES:
            raise VolfrepError(
                f"There is no boundary '{self.boundary}': choose {' or '.join(BOUNDARIES)}."
            )
        _number("shortest stub", self.shortest_stub, "mm", positive=False)
        if self.output not in OUTPUTS:
            raise VolfrepError(
                f"There is no output '{self.output}': choose one of {', '.join(OUTPUTS)}."
            )
        if self.shell == 0 and (self.open_faces or self.drains is not None):
            raise VolfrepError(
                "Open faces and drain holes need a skin: give a shell thickness above 0."
            )
        if self.drains is not None and self.output == "lattice":
            raise VolfrepError("Drain holes go through the skin of a part: choose the output part.")
        if self.origin is not None:
            if len(self.origin) != 3:
                raise VolfrepError("The origin must be three coordinates.")
            for value in self.origin:
                _number("origin", value, "mm", positive=None)
        _ = self.facets_along_cell
        self.unit_cell()

    @property
    def joint_radius(self) -> float:
        """Radius of the joint spheres, r (1 + r / L) (Eq. 8 of the paper)."""
        return joint_radius(self.strut_radius, self.cell_size)

    @property
    def is_endless(self) -> bool:
        """Whether the octants are those of a lattice without end, of which the wall cuts a piece.

        What lies outside is cut off anyway. Otherwise they are those of the active cells, whose
        struts end round.
        """
        return self.activation == "touching" and self.boundary == "trim"

    @property
    def is_cut(self) -> bool:
        """Whether a wall cuts the lattice."""
        return self.boundary == "trim" or (self.output == "part" and self.shell > 0)

    @property
    def removes_struts(self) -> bool:
        """Whether struts with a free end are looked for."""
        return self.remove_dangling or self.shortest_stub > 0

    @property
    def is_graded(self) -> bool:
        """Whether the lattice is anything but equal cells along x, y, z."""
        parts = (self.size_grading, self.radius_grading, self.cell_map, self.orientation)
        return any(part is not None for part in parts)

    @property
    def radius_extremes(self) -> tuple[float, float]:
        """The smallest and the largest radius of a strut, mm."""
        if self.radius_grading is None:
            return float(self.strut_radius), float(self.strut_radius)
        return self.radius_grading.extremes

    @property
    def template_radius(self) -> float:
        """The radius that octants are meshed for, between the extremes, mm."""
        least, most = self.radius_extremes
        return least if least == most else math.sqrt(least * most)

    @property
    def facets_along_cell(self) -> int:
        """How many facet edges fit along L: the resolution, or what the deviation asks for.

        Facets of edge e fitted to a cylinder of radius r in the mean stray from it by up to
        e2 / (16 r) to either side (the sagitta of a chord, e2 / 8 r, halved by the fit). Where
        the radius varies, every strut has as many facets round it, and the thickest one strays
        most.
        """
        coarsest = self.coarsest_resolution
        if self.resolution is not None:
            return max(int(self.resolution), coarsest)
        radius = self.template_radius**2 / self.radius_extremes[1]
        if self.deviation is None:
            radius = self.template_radius
        deviation = self.deviation or DEFAULT_RELATIVE_DEVIATION * radius
        wanted = self.cell_size / math.sqrt(16.0 * radius * deviation)
        if wanted > MAX_RESOLUTION:
            edge = self.cell_size / MAX_RESOLUTION
            smallest = edge * edge / (16.0 * radius)
            raise VolfrepError(
                f"A deviation of {deviation:.3g} mm needs {wanted:.0f} facets along a cell: the "
                f"limit is {MAX_RESOLUTION}, which reaches {smallest:.3g} mm."
            )
        least = coarsest if self.deviation is not None else MIN_AUTOMATIC_RESOLUTION
        return max(math.ceil(wanted), least)

    @property
    def coarsest_resolution(self) -> int:
        """Facets along L below which struts would not have their volume.

        Raises:
            VolfrepError: struts are so thin that not even the finest resolution follows them.
        """
        needed = math.ceil(self.cell_size / (LONGEST_FACET * self.template_radius) - 1e-9)
        if needed > MAX_RESOLUTION:
            thinnest = self.cell_size / (LONGEST_FACET * MAX_RESOLUTION)
            raise VolfrepError(
                f"Struts of radius {self.template_radius:.3g} mm are too thin for cells of "
                f"{self.cell_size:g} mm: they need {needed} facets along a cell, the limit is "
                f"{MAX_RESOLUTION}; make them {thinnest:.3g} mm or thicker, or the cells smaller."
            )
        return max(needed, COARSEST)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what is made otherwise than it was asked for."""
        facets = self.facets_along_cell
        if self.resolution is None or facets <= self.resolution:
            return ()
        return (
            f"A resolution of {self.resolution} is too coarse for struts of radius "
            f"{self.template_radius:.3g} mm, which would not have their volume: {facets} facets "
            "along a cell are made.",
        )

    def unit_cell(self) -> UnitCell:
        """The cell itself, looked up in the library or read from its file."""
        return self.cell if isinstance(self.cell, UnitCell) else find_cell(self.cell)

    def as_dict(self) -> dict[str, Any]:
        """The specification as plain JSON values."""
        values = {name: as_plain(getattr(self, name)) for name in self.__dataclass_fields__}
        values["cell"] = self.unit_cell().name
        return values


def _largest_radius(size: float, fillet: float) -> float:
    """The r at which joint sphere and fillet reach half a cell: r + r2 / L + fillet = L / 2."""
    room = size / 2 - fillet
    return float(size * (math.sqrt(0.25 + max(room, 0.0) / size) - 0.5)) if room > 0 else 0.0


def _number(name: str, value: float, unit: str, *, positive: bool | None) -> float:
    """`value` as a finite float; `positive` True: above 0, False: not below 0, None: any."""
    try:
        number = float(value)
    except (TypeError, ValueError) as error:
        raise VolfrepError(f"The {name} must be a number in {unit}, not {value!r}.") from error
    if not math.isfinite(number):
        raise VolfrepError(f"The {name} must be a finite number in {unit}, not {number}.")
    if positive and number <= 0:
        raise VolfrepError(f"The {name} must be above 0 {unit}, not {number:g}.")
    if positive is False and number < 0:
        raise VolfrepError(f"The {name} must not be negative, not {number:g} {unit}.")
    return number
