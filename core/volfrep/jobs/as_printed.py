# SPDX-License-Identifier: LGPL-2.1-or-later
"""What comes out of the printer of what was drawn, and what to draw so that it comes out.

Each strut gets what the table says at its inclination. The lattice that is drawn so has struts of
different thickness where these differ, as a cell with widths of its own has.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..design.as_printed import PrintedTable
from ..design.cells import UnitCell
from ..design.spec import LatticeSpec
from ..grid.inclination import inclinations, unit_direction
from ..grid.strut_graph import Wireframe
from ..util.errors import VolfrepError
from ..util.linalg import along, times
from ..util.showing import Shown
from ..util.types import Floats

#: Radii that differ by less are the same, relative.
_SAME = 1e-6


@dataclass(frozen=True, eq=False, repr=False)
class Printed(Shown):
    """What comes out.

    Attributes:
        table: that says so.
        struts: as they come out.
        diameters: (least, largest) of them, mm.
        drawn: the same as they were drawn, mm.
        swelling: volume of the struts over that of those drawn, without regard to joints.
    """

    table: PrintedTable
    struts: Wireframe
    diameters: tuple[float, float]
    drawn: tuple[float, float]
    swelling: float

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        both = (("printed", self.diameters), ("drawn", self.drawn))
        thicknesses = [
            (name, f"{least:.3f} to {most:.3f} mm thick") for name, (least, most) in both
        ]
        return [("table", self.table.title), *thicknesses, ("swelling", f"{self.swelling:.4g}")]

    def row(self, lattice_mm3: float, volume_mm3: float, density: float) -> tuple[str, str]:
        """A name and a value for the user.

        Args:
            lattice_mm3: volume of the lattice that was drawn.
            volume_mm3: of all that was drawn.
            density: g/cm3.
        """
        (least, most), (thin, thick) = self.diameters, self.drawn
        mass = (volume_mm3 + (self.swelling - 1.0) * lattice_mm3) * density / 1000.0
        return (
            "as printed",
            f"struts {least:.3f} to {most:.3f} mm thick, drawn {thin:.3f} to {thick:.3f}, about "
            f"{mass:,.2f} g ({self.table.title})",
        )


def as_printed(
    lattice: Wireframe,
    table: PrintedTable,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
) -> Printed:
    """The struts as they come out of the printer.

    Args:
        lattice: as drawn.
        table: of what is added.
        build_direction: from the build plate up, of any length.

    Raises:
        VolfrepError: there are no struts, or the direction is none.
    """
    if not len(lattice.struts):
        raise VolfrepError("Only struts are known as they are printed, and there are none.")
    angle = inclinations(lattice, unit_direction(build_direction))
    diameters = 2.0 * lattice.radii
    printed = np.stack([table.printed(diameters[:, k], angle) for k in (0, 1)], axis=1)
    printed = np.maximum(printed, 0.0)
    grown = np.ones(len(lattice.nodes))
    for k in (0, 1):
        np.maximum.at(grown, lattice.struts[:, k], printed[:, k] / diameters[:, k])
    ends = lattice.nodes[lattice.struts]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    solid, drawn = ((length * (across**2).mean(axis=1)).sum() for across in (printed, diameters))
    struts = replace(lattice, radii=printed / 2.0, joint_radii=lattice.joint_radii * grown)
    return Printed(
        table, struts, (float(printed.min()), float(printed.max())),
        (float(diameters.min()), float(diameters.max())), float(solid / drawn),
    )  # fmt: skip


def printed_radius(
    cell: UnitCell,
    cell_size: float,
    radius: float,
    table: PrintedTable,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
) -> tuple[float, str]:
    """The one radius whose struts take the volume of those that come out of an endless lattice.

    Args:
        cell: of struts; its axes are the printer's.
        cell_size: L, mm.
        radius: as drawn, mm.
        table: of what is added.
        build_direction: from the build plate up, of any length.

    Returns:
        The radius in mm, and a sentence that says so.

    Raises:
        VolfrepError: the direction is none, or no strut comes out.

    >>> from volfrep.design.as_printed import find_printed_table
    >>> from volfrep.design.cells import find_cell
    >>> radius, _ = printed_radius(find_cell("BCC"), 5, 0.4, find_printed_table("LPBF-316L"))
    >>> round(2 * radius, 4)
    0.8227
    """
    way, angle = _ways(cell, unit_direction(build_direction), np.eye(3))
    length = np.linalg.norm(way, axis=1) * cell_size
    widths = cell.widths if len(cell.widths) else np.ones(len(way))
    drawn = 2.0 * radius * widths
    out = np.maximum(table.printed(drawn, angle), 0.0)
    mean = float(np.sqrt((length * out**2).sum() / (length * widths**2).sum()))
    if mean <= 0.0:
        raise VolfrepError(
            f"Struts of {drawn.min():.3g} mm do not come out at all ({table.title}): draw thicker "
            "ones."
        )
    text = f"{out.min():.3f}" if np.ptp(out) < 5e-4 else f"{out.min():.3f} to {out.max():.3f}"
    note = (
        f"Struts that are drawn {drawn.max():.3f} mm thick come out {text} mm thick "
        f"({table.title}); told are the properties of {mean:.3f} mm, which take the same volume."
    )
    return mean / 2.0, note


def compensated(
    spec: LatticeSpec,
    table: PrintedTable,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
) -> tuple[LatticeSpec, str]:
    """What to draw so that the struts of a specification come out, and a sentence that says so.

    Args:
        spec: of cells with struts of one radius, along straight axes.
        table: of what is added.
        build_direction: from the build plate up, of any length.

    Raises:
        VolfrepError: the lattice is of another kind, or the printer's struts are thicker than
            wanted however thin they are drawn.
    """
    up = unit_direction(build_direction)
    straight = spec.size_grading is None and spec.cell_map is None
    if spec.kind.cube is None or not straight or spec.radius_grading is not None or spec.target:
        raise VolfrepError(
            "Struts are compensated in cells along straight axes, by one radius that is given: "
            "leave gradings, maps, targets and other kinds of lattice out."
        )
    cell = spec.kind.cube
    turn = np.eye(3) if spec.orientation is None else spec.orientation.matrix
    way, angle = _ways(cell, up, turn)
    widths = cell.widths if len(cell.widths) else np.ones(len(way))
    wanted = 2.0 * spec.strut_radius * widths
    drawn: Floats = table.drawn(wanted, angle)
    if (drawn <= 0.0).any():
        worst = int(drawn.argmin())
        raise VolfrepError(
            f"Struts at {angle[worst]:.0f} degrees come out thicker than {wanted[worst]:.3g} mm "
            f"however thin they are drawn ({table.title}): ask for thicker ones."
        )
    thickest = float(drawn.max())
    factors = drawn / thickest
    text = f"{drawn.min():.3f}" if np.ptp(drawn) < 5e-4 else f"{drawn.min():.3f} to {thickest:.3f}"
    note = (
        f"Struts are drawn {text} mm thick, so that they come out {wanted.min():.3f}"
        f"{'' if np.ptp(wanted) < 5e-4 else f' to {wanted.max():.3f}'} mm thick ({table.title})."
    )
    if np.ptp(factors) < _SAME:
        factors = factors[:0]
    drawn_cell = replace(cell, widths=factors)
    # Whether it is laid as octants or as a graph follows from the cell.
    return replace(spec, cell=drawn_cell, network=None, strut_radius=thickest / 2.0), note


def _ways(cell: UnitCell, up: Floats, turn: Floats) -> tuple[Floats, Floats]:
    """(s, 3) struts of a cell in units of L, and (s,) their inclinations, degrees."""
    ends = cell.nodes[cell.struts] * np.array(cell.edges)
    way = times(ends[:, 1] - ends[:, 0], turn.T)
    rise = np.abs(along(way, up)) / np.linalg.norm(way, axis=1)
    return way, np.asarray(np.degrees(np.arcsin(np.minimum(rise, 1.0))))
