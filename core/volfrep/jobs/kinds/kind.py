# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a kind of lattice does: how a part is filled with it, and what is told of it.

`LatticeKind` is what a kind does with a specification alone, `PartLattice` what it does in a part.
A new kind is a module with both, and one of `volfrep.design.spec_fields.Kind`, which says what a
specification of it may hold.
"""

from __future__ import annotations

import os
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from ...design.spec import LatticeSpec
from ...design.target import Target
from ...grid.strut_graph import Wireframe
from ...io.write.stl import write_stl
from ...mesh.triangle_mesh import TriangleMesh
from ...reports.report import Report, with_warnings
from ...util.errors import VolfrepError, brief
from ...util.numbers import whole
from ...util.progress import Monitor, peak_memory_mb
from ...util.types import Floats

if TYPE_CHECKING:
    from ...mechanics.materials import SolidMaterial
    from ...mechanics.summary import CellProperties
    from ...reports.result import Result
    from ...trim.boolean_trim import Ahead
    from ...trim.loose_pieces import Cleared
    from ...trim.prune import Pruned
    from ..active_cells import ActiveCells
    from ..part_depth import PartDepth, Preview
    from ..part_domain import PartDomain
    from ..target_search import TargetSearch

#: What is promised: a part that misses its target by more, relative, says so.
PROMISED = 5e-3
#: Cells along one axis of a block.
MOST_CELLS = 1_000_000


class RadiiBorne(NamedTuple):
    """How thick struts may become, mm.

    Attributes:
        usual: where nothing else is said.
        most: where they leave each other no room any more.
        own: of struts that are united where they overlap, what they have already; else 0.
    """

    usual: float
    most: float
    own: float = 0.0


#: Said where what the printer adds is asked for of a lattice that does not tell it.
UNDRAWN = "What comes out is known of struts: give their radius as drawn."


class Expected(NamedTuple):
    """What a design will come to, about.

    Attributes:
        spec: with the thickness of its target.
        relative_density: of the lattice in what it fills.
        volume: of the part, mm3.
    """

    spec: LatticeSpec
    relative_density: float
    volume: float


@dataclass(frozen=True)
class EndlessRequest:
    """What is asked of an endless lattice; attributes as of `figures.properties`."""

    strut_radius: float | None
    relative_density: float | None
    fillet: float
    material: SolidMaterial | None
    along: int | None
    cell_values: str
    wall_kind: str | None
    wall_thickness: float | None
    wall_offset: float | None
    wall_formula: str
    exact: bool
    on_estimate: Callable[[float], None]
    as_printed: str | None
    build_direction: tuple[float, float, float]
    note: Callable[[str], None]

    @property
    def given(self) -> list[str]:
        """What says how thick it is."""
        names = ("strut_radius", "wall_thickness", "wall_offset", "relative_density")
        return [name.replace("_", " ") for name in names if getattr(self, name) is not None]


class PartLattice(ABC):
    """The lattice of a kind in a part.

    Args:
        part: what it fills.

    Attributes:
        part, spec, monitor: of the job.
    """

    def __init__(self, part: PartDomain) -> None:
        self.part, self.spec, self.monitor = part, part.spec, part.monitor

    @property
    def cells(self) -> ActiveCells | None:
        """The cells, and which of them hold a lattice; None: it has no cells."""
        return None

    @property
    def pruned(self) -> Pruned | None:
        """What is left when struts with a free end are taken away; None where none are."""
        return None

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on how it was meshed, as soon as it is."""
        return ()

    @property
    @abstractmethod
    def struts(self) -> Wireframe:
        """Its nodes and struts, whole, where its mesh has them; none of it, of walls."""

    @property
    @abstractmethod
    def spacing(self) -> float:
        """L, mm; of a graph the median length of its struts, which stands for it."""

    @property
    @abstractmethod
    def smallest(self) -> float:
        """Volume below which a shell is no piece of it, mm3."""

    @property
    @abstractmethod
    def is_deformed(self) -> bool:
        """Whether its vertices are elsewhere than they were meshed."""

    @abstractmethod
    def mesh(self, *, is_cut: bool) -> None:
        """Mesh it, as what a wall cuts or as it is; what was meshed is kept."""

    @abstractmethod
    def trim(self, *, with_skin: bool, ahead: Ahead | None) -> Cleared:
        """What is left of it, or of the part, where the wall cuts it; whole where none does.

        Args:
            with_skin: whether it is joined to the skin.
            ahead: as of `trim.boolean_trim.trim`.

        Raises:
            VolfrepError: nothing is left, or nothing would hold it.
        """

    def search(self, target: Target) -> TargetSearch:
        """The thickness for which it has the density or the mass of a target.

        Raises:
            VolfrepError: none has (the text says what can be had), or none is looked for.
        """
        raise not_aimed(target)

    def radii_borne(self, own: float) -> RadiiBorne:
        """Up to which radii its struts can be sized.

        Args:
            own: median radius of the struts, mm.

        Raises:
            VolfrepError: it has no struts that could be.
        """
        raise VolfrepError("Such a lattice has no struts that could be sized: choose another cell.")

    @property
    def skin_edge(self) -> float:
        """Edge of the triangles by which the skin about it is solved, mm."""
        return 0.5 * self.spacing

    def slabs(self) -> Callable[[float, float], Wireframe] | None:
        """Gives its struts that reach between two z, mm; None: it can be had as a whole only."""
        return None

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be said of its cells."""
        return self.cells.warnings if self.cells is not None else ()


def block_counts(count: object) -> tuple[int, int, int]:
    """The cells of a block along x, y, z.

    Raises:
        VolfrepError: they are not three whole numbers above 0.
    """
    if isinstance(count, str) or not isinstance(count, Iterable) or len(tuple(count)) != 3:
        raise VolfrepError(f"The count must be three whole numbers, not {brief(count)}.")
    x, y, z = (whole("count", n, 1, MOST_CELLS) for n in count)
    return x, y, z


def not_aimed(target: Target) -> VolfrepError:
    """That no thickness is looked for."""
    return VolfrepError(
        f"No thickness of such a lattice is looked for that meets a target of {target.called}: "
        "give the thickness."
    )


class BlockLattice(ABC):
    """A free-standing block of whole cells.

    Args:
        kind: of the lattice.
        count: cells along x, y, z.

    Raises:
        VolfrepError: the counts make no sense.
    """

    def __init__(self, kind: LatticeKind, count: Sequence[int]) -> None:
        self.kind, self.spec, self.count = kind, kind.spec, block_counts(count)

    @property
    @abstractmethod
    def volume(self) -> float:
        """Volume of its cells, mm3."""

    @abstractmethod
    def wireframe(self) -> Wireframe:
        """Its nodes and struts.

        Raises:
            VolfrepError: it would not fit into memory, or has none.
        """

    @abstractmethod
    def result(self, monitor: Monitor) -> Result:
        """It as a mesh.

        Raises:
            VolfrepError: it would not fit into memory.
        """

    @abstractmethod
    def search(self, target: Target) -> TargetSearch:
        """As `PartLattice.search`."""

    def measured(self, monitor: Monitor) -> Report:
        """Its figures."""
        return self.result(monitor).report

    def write_stl(self, path: str | os.PathLike[str], monitor: Monitor) -> Report:
        """Write it as a binary STL; its figures."""
        return write_whole(self.result(monitor), path)


def write_whole(result: Result, path: str | os.PathLike[str]) -> Report:
    """Write a block's mesh as a binary STL; its figures, with the time that took."""
    start = time.perf_counter()
    write_stl(result.mesh, path)
    stages = {**result.report.stages, "write": time.perf_counter() - start}
    return replace(result.report, stages=stages, peak_memory_mb=peak_memory_mb())


class LatticeKind(ABC):
    """What a kind of lattice does with a specification of that kind.

    Args:
        spec: of the kind.
    """

    #: Whether the thickness of a target is known as well before the part is filled (`expected`).
    foretells_target = False

    def __init__(self, spec: LatticeSpec) -> None:
        self.spec = spec

    def modulus(self, target: Target) -> float:
        """Young's modulus of the endless lattice along a target's direction.

        Raises:
            VolfrepError: it carries no load, or there is none.
        """
        raise not_aimed(target)

    def stiffened(self, target: Target) -> LatticeSpec:
        """The specification with the thickness of a target of stiffness.

        Args:
            target: the stiffness.

        Raises:
            VolfrepError: none has (the text says what can be had), or none is looked for.
        """
        raise not_aimed(target)

    @abstractmethod
    def fill(self, part: PartDomain) -> PartLattice:
        """The lattice in a part."""

    def block(self, count: Sequence[int]) -> BlockLattice:
        """A block of so many cells along x, y, z.

        Raises:
            VolfrepError: the counts make no sense, or there are no such blocks.
        """
        raise VolfrepError("There are no blocks of such a lattice: fill a box with it.")

    @abstractmethod
    def preview(self, solid: TriangleMesh, depth: PartDepth) -> Preview:
        """What it will look like in a solid, and its figures, at once; as of `preview.preview`."""

    def expected(self, solid: TriangleMesh, depth: PartDepth) -> Expected:
        """What a solid with it will come to: the preview's figures."""
        shown = self.preview(solid, depth)
        return Expected(shown.spec, shown.relative_density, shown.volume)

    def roughly_solved(self, solid: TriangleMesh) -> LatticeSpec:
        """The specification with about the thickness of its target, for a forecast, at once.

        As it is where that would take a preview.

        Raises:
            VolfrepError: none meets the target.
        """
        return self.spec

    def densities(self, thickness: Floats) -> Floats:
        """(n,) relative densities of the endless lattice of walls of (n,) thicknesses, mm.

        Raises:
            VolfrepError: it has no walls.
        """
        raise VolfrepError(
            "Densities are known of sized struts and walls in cubic cells: choose such a cell."
        )

    def with_fixed_struts(self) -> LatticeSpec:
        """The specification whose nodes and struts stay the same whatever radii it is given."""
        return self.spec

    def largest_ball(self) -> float | None:
        """Diameter of the largest ball that passes through, mm; None where windows all differ."""
        return None

    def sheet_and_gap(self) -> tuple[float | None, float | None]:
        """The least thickness of walls and the least gap between them, mm; None: not known."""
        return None, None

    @staticmethod
    def properties(cell: Any, cell_size: float, request: EndlessRequest) -> CellProperties:
        """What the endless lattice of a cell of the kind does.

        Raises:
            VolfrepError: a value makes no sense, or the cell carries no load.
        """
        raise VolfrepError(
            f"What the endless lattice of '{cell.name}' does is not known: choose another cell."
        )

    @staticmethod
    def radii_of_densities(cell: Any, densities: Floats, fillet: float) -> Floats:
        """Radii of endless lattices of many relative densities, in units of L, as the fillet is.

        Raises:
            VolfrepError: the cell has no struts, or none give these densities.
        """
        raise VolfrepError(
            "'relative_density' by place is for cells of struts: give 'wall_thickness' or "
            "'strut_radius' by place."
        )

    def refuse(self, solid: TriangleMesh) -> None:  # noqa: B027  a graph fits any
        """Refuse a solid that it does not fit.

        Raises:
            VolfrepError: cells are larger than the part.
        """

    def with_target(self, report: Report) -> Report:
        """A report that says, in `target`, what was aimed at and reached, and by what radius."""
        spec, target = self.spec, self.spec.target
        if target is None:
            return report
        if target.aim == "stiffness":
            reached = self.modulus(target)
        else:
            reached = report.mass_g if target.aim == "mass" else report.relative_density
        found = {f"{spec.kind.measure}_mm": spec.kind.thickness}
        figures = {**target.as_json(), "reached": reached, **found}
        off = reached / target.value - 1.0
        notes: tuple[str, ...] = ()
        if abs(off) > PROMISED:
            notes = (
                f"The target, a {target.called} of {target.value:.5g}, is missed by {off:+.2%}: "
                f"{reached:.5g} came out.",
            )
        return with_warnings(replace(report, target=figures), notes)

    def refuse_beams(self) -> None:  # noqa: B027  struts are
        """Refuse what has no struts that could be beams or axes.

        Raises:
            VolfrepError: it has none.
        """
