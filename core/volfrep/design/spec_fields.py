# SPDX-License-Identifier: LGPL-2.1-or-later
"""The fields of a specification, the parts of it that stages are given, and what a kind says of it.

Below the kinds of lattice, which judge a specification, and so below `spec`, which asks them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..util.errors import VolfrepError
from ..util.types import Floats
from .cells import UnitCell, joint_radius
from .grading import CellMap, Field, Orientation, RadiusGrading, SizeGrading
from .graphs import GivenGraph, RandomGraph, StretchedCells
from .openings import DrainHoles, OpenFace
from .skins.kept_bodies import KeptBody
from .skins.own_faces import FaceSkin, KeptFace
from .spec_parts import Boundary, FlatStruts, Grid, Resolution, Skin, Struts
from .target import Target
from .tpms import PeriodicSurface, TpmsSheet


@dataclass(frozen=True)
class SpecFields:
    """What a `LatticeSpec` holds, which says what it means: as its kind of lattice is given it."""

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
    skin_field: Field | None = None
    drains: DrainHoles | None = None
    remove_dangling: bool = False
    shortest_stub: float = 0.0
    remove_below: float = 0.0
    flat_struts: FlatStruts | None = None
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
    def skin(self) -> Skin | None:
        """The part's skin; None for none."""
        if self.shell == 0:
            return None
        return Skin(self.shell, self.open_faces, self.face_skins, self.keep_solid, self.skin_field)

    @property
    def ending(self) -> Boundary:
        """Where the lattice ends."""
        return Boundary(
            self.activation, self.boundary, self.remove_dangling, self.shortest_stub,
            self.keep_pieces, self.remove_below, self.flat_struts,
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
    def template_radius(self) -> float:
        """The radius that octants are meshed for, between the extremes, mm."""
        return self.struts.template_radius

    @property
    def cell_name(self) -> str:
        """What the cell is called, of struts or a TPMS."""
        assert not isinstance(self.cell, str)
        return self.cell.name

    @property
    def kind(self) -> Kind:
        """The kind of lattice that it is of."""
        raise NotImplementedError


class Kind(ABC):
    """A kind of lattice, as a specification of that kind has it.

    Args:
        spec: of that kind.
    """

    #: The parameter that says how thick the lattice is.
    measure = "strut_radius"
    #: Whether it has struts: to be coloured, or held against a printer's limits.
    has_struts = True
    #: Whether its cells lie in a grid, so that each place has a cell size.
    has_grid = True
    #: Whether it is cut in groups of octants, and goes into a file without a mesh of all.
    is_cut_in_groups = True
    #: Whether what its preview refuses cannot be made either.
    is_judged_by_preview = True

    def __init__(self, spec: SpecFields) -> None:
        self.spec = spec

    @abstractmethod
    def refuse(self) -> None:
        """Refuse what makes no sense for the kind.

        Raises:
            VolfrepError: naming the first such value.
        """

    @property
    def network(self) -> GivenGraph | RandomGraph | StretchedCells | None:
        """The specification's network, or what its cell has to be taken as."""
        return self.spec.network

    @property
    def cube(self) -> UnitCell | None:
        """The cube with struts of one radius that the lattice repeats; None: it is none of such."""
        return None

    @property
    def widths(self) -> Floats:
        """(m,) what the lattice's radius is multiplied by at each strut; none, (0,), for 1."""
        return np.zeros(0)

    @property
    def endless(self) -> Mapping[str, Any] | None:
        """What `jobs.figures.properties` is to be asked with; None: it repeats nowhere.

        Every number is a length, mm.
        """
        return None

    @property
    def catalogue_cell(self) -> UnitCell | None:
        """The cell by which the catalogue may know the endless lattice; None: it does not."""
        return None

    def content_of_0_1_0(self) -> Sequence[NDArray[Any]] | None:
        """What releases up to 0.1.0 knew of it beside its plain values; None: they knew it not."""
        return None

    def unit_cell(self) -> UnitCell:
        """The cell of struts.

        Raises:
            VolfrepError: there is none.
        """
        if not isinstance(self.spec.cell, UnitCell):
            raise VolfrepError(
                f"This is done with struts, of which a {self.spec.cell_name} has none: choose "
                "another cell."
            )
        return self.spec.cell

    @property
    def thickness(self) -> float:
        """The value of `measure`, mm."""
        return self.spec.strut_radius

    def of_thickness(self, value: float) -> dict[str, Any]:
        """The fields of a specification whose `measure` has a value in mm."""
        return {"strut_radius": value}

    @property
    def mean_radius(self) -> float:
        """The radius of struts, of a graded one a mean; or half of what is as thick, mm."""
        return self.spec.template_radius

    @property
    def without_effect(self) -> dict[str, Any]:
        """Fields that count for nothing, with the values that they are counted as."""
        return {"wall": TpmsSheet()}

    def as_json(self) -> dict[str, Any]:
        """What is said of it beside the specification's fields, as plain JSON values."""
        return {}

    def as_values(self) -> dict[str, Any]:
        """Parameters that are said of it beside those that hold a field, and those of its cell.

        Raises:
            VolfrepError: no value can say what it holds.
        """
        return {}

    @property
    def coarsest_resolution(self) -> int:
        """Facets along L below which struts would lose their volume, or sheets their thickness."""
        return self.spec.detail.coarsest(self.spec.cell_size, self.spec.struts)

    @property
    def facets_along_cell(self) -> int:
        """How many facet edges fit along L: the resolution, or what the deviation asks for.

        Raises:
            VolfrepError: there would be too many.
        """
        return self.spec.detail.along_cell(self.spec.cell_size, self.spec.struts)

    def deviation_of(self, facets: int) -> float:
        """How far so many facet edges along L stray from the lattice to either side, mm."""
        struts = self.spec.struts
        radius = struts.template_radius**2 / struts.extremes[1]
        return (self.spec.cell_size / facets) ** 2 / (16.0 * radius)

    @property
    def too_coarse(self) -> str | None:
        """What fewer facets than are made would be too coarse for; None: they are made so."""
        return None

    def strut_shares(self, on_face: Floats | float = 0.5) -> Floats:
        """(m,) how much of each strut belongs to one cell (`forecast.strut_shares`)."""
        return np.zeros(0)

    @abstractmethod
    def triangles_of_cell(self, shares: Floats) -> float:
        """Triangles of the lattice in one cell, about, whose struts belong to it by shares."""

    def graph_in(self, inside: float, area: float) -> tuple[float, float] | None:
        """About how many points, or cells, and struts a graph has; None: it is of octants.

        Args:
            inside: volume of what is filled, mm3.
            area: of the part's surface, mm2.
        """
        return None

    def meshing_seconds(self, sets: float) -> float:
        """What octants take to be meshed, s; 0 where that is next to nothing.

        Args:
            sets: how many different sets of a cell's eight octants there are.
        """
        return 0.0

    @property
    def meshing_bytes(self) -> float:
        """Memory that meshing octants takes, bytes; 0 where that is next to nothing."""
        return 0.0

    def refuse_crossing(self) -> None:  # noqa: B027  most kinds have none
        """Refuse octants that would take too long to mesh.

        Raises:
            VolfrepError: so they would.
        """

    def refuse_idle_cell(self, given: Mapping[str, object]) -> None:  # noqa: B027  as above
        """Refuse options of a cell, or of its size, that the lattice has no use for.

        Args:
            given: the options by their parameters' names; a file's values are not among them.

        Raises:
            VolfrepError: naming one.
        """
