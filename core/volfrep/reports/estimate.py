# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a file for CAD or a solver will take, told before any work, and the refusal of absurd ones.

The constants are measured on 2 cores; they stand with what they are about.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..design.memory_guard import rounded_up, smaller_block
from ..design.spec import LatticeSpec
from ..fem.beam_mesh import BeamMesh
from ..fem.deck import BYTES_PER_BEAM, SOLVE_SECONDS_PER_BEAM, WRITE_SECONDS_PER_BEAM
from ..fem.tet_mesh import (
    BYTES_PER_LATTICE_TETRAHEDRON,
    BYTES_PER_TRIANGLE,
    ELEMENTS_PER_TRIANGLE,
    NODES_PER_LATTICE_TETRAHEDRON,
    NODES_PER_TRIANGLE,
    SECONDS_PER_CUT_TRIANGLE,
    SECONDS_PER_LATTICE_TETRAHEDRON,
    SECONDS_PER_TRIANGLE,
)
from ..fem.tet_mesh import MAX_TRIANGLES as MAX_TETRAHEDRA_TRIANGLES
from ..grid.strut_graph import Wireframe
from ..io.write.step_exact import predict_exact
from ..io.write.step_faceted import MAX_TRIANGLES as MAX_PLANE_FACES
from ..io.write.step_faceted import predict_faceted
from ..io.write.step_wireframe import predict_wireframe
from ..util.errors import VolfrepError

#: Files that take longer to make, or are larger, are not made.
MOST_SECONDS = 1800.0
MOST_MEGABYTES = 500.0
#: Beams that CalculiX still solves in minutes, by what 500 to 50,000 take.
MOST_BEAMS = 400_000
#: Seconds that OpenCASCADE takes to cut a lattice at a wall, per strut; measured on lattices of
#: 100 to 900 struts in a box, a cylinder, and a box with a hole.
TRIM_SECONDS_PER_STRUT = 8e-3
#: So many times fewer triangles than just fit are advised, so that the advice is not refused next.
SURE = 1.25
#: A wall of more triangles is not handed to OpenCASCADE's Booleans.
MOST_WALL_TRIANGLES = 3_000
#: Exact solids of more struts than this are not cut: the Boolean grows faster than its input.
MOST_TRIMMED_STRUTS = 5_000


@dataclass(frozen=True)
class Estimate:
    """What a file will take.

    Attributes:
        what: will be in it.
        seconds: to make it.
        megabytes: its size.
        remark: what it will cost whoever reads it; empty for nothing to mention.
    """

    what: str
    seconds: float
    megabytes: float
    remark: str = ""

    def __str__(self) -> str:
        cost = f"about {_seconds(self.seconds)}, {_size(self.megabytes)}"
        return f"{self.what}: {cost}" + f"; {self.remark}" * bool(self.remark)


@dataclass(frozen=True)
class ExportChoice:
    """What the user can change to make a file smaller.

    Attributes:
        spec: of the lattice.
        count: cells of a block along x, y, z; None for a solid that is filled.
    """

    spec: LatticeSpec
    count: Sequence[int] | None = None

    def coarser(self, excess: float) -> str:
        """The setting with so many times fewer facets, or else fewer struts."""
        # Triangles go with the square of the facets along L, but for those along a wall.
        fits = self.spec.facets_along_cell / np.sqrt(excess)
        coarsest = self.spec.kind.coarsest_resolution
        if fits >= coarsest:
            return f"a resolution of {max(int(fits / np.sqrt(SURE)), coarsest)}"
        return self.fewer(excess)

    def fewer(self, excess: float) -> str:
        """The setting with so many times fewer struts."""
        if self.count is None:
            return f"cells of {rounded_up(self.spec.cell_size * excess ** (1.0 / 3.0)):g} mm"
        return smaller_block(self.count, excess)


def estimate_faceted(triangles: int, asked: ExportChoice | None = None) -> Estimate:
    """STEP with a plane face for every triangle.

    Args:
        triangles: of the mesh.
        asked: what the mesh was made of, to say which setting would fit.

    Raises:
        VolfrepError: more than any program reads; the text names the nearest setting that fits.
    """
    if triangles > MAX_PLANE_FACES:
        raise VolfrepError(
            f"{triangles:,} plane faces are more than the {MAX_PLANE_FACES:,} that any program "
            f"reads: choose {_coarser(asked, triangles / MAX_PLANE_FACES)}, or the exact form."
        )
    seconds, megabytes = predict_faceted(triangles)
    # FreeCAD 0.20 took 211 seconds for 54,648 faces on two busy cores, more than in proportion
    # longer for 126,440.
    reading = f"FreeCAD reads it in about {_seconds(4e-3 * triangles)}"
    return Estimate(f"{triangles:,} plane faces", seconds, megabytes, reading)


def estimate_axes(struts: int, asked: ExportChoice | None = None) -> Estimate:
    """STEP of the struts' axes.

    Raises:
        VolfrepError: the file would be larger than `MOST_MEGABYTES`; the text names the nearest
            setting that fits.
    """
    seconds, megabytes = predict_wireframe(struts)
    if megabytes > MOST_MEGABYTES:
        raise VolfrepError(
            f"The axes of {struts:,} struts would be {megabytes:,.0f} MB of STEP: choose "
            f"{_fewer(asked, megabytes / MOST_MEGABYTES)}."
        )
    # FreeCAD 0.20 reads 46,656 lines in 5 seconds.
    reading = f"FreeCAD reads it in about {_seconds(1e-4 * struts)}"
    return Estimate(f"{struts:,} lines", seconds, megabytes, reading)


def estimate_exact(
    lattice: Wireframe, asked: ExportChoice | None = None, *, trimmed: bool = False
) -> Estimate:
    """Solids of cylinders, cones and spheres.

    Args:
        lattice: its struts.
        asked: what it was made of, to say which setting would fit.
        trimmed: whether it is cut at a wall.

    Raises:
        VolfrepError: absurdly long or large; the text names the nearest setting that fits.
    """
    found = predict_exact(lattice)
    struts = len(lattice.struts)
    seconds = found.seconds
    excess = max(seconds / MOST_SECONDS, found.megabytes / MOST_MEGABYTES)
    if trimmed:
        seconds += found.read_seconds + TRIM_SECONDS_PER_STRUT * struts
        excess = max(excess, struts / MOST_TRIMMED_STRUTS)
    what = f"{struts:,} struts, {found.kinds:,} kinds of joints"
    if excess > 1.0:
        raise VolfrepError(
            f"Exact surfaces of {what} would take about {_seconds(seconds)} and "
            f"{_size(found.megabytes)}: choose {_fewer(asked, excess)}, or the faceted or "
            "wireframe form."
        )
    reading = f"FreeCAD reads it in about {_seconds(found.read_seconds)}"
    return Estimate(what, seconds, found.megabytes, reading)


def refuse_boundary(triangles: int) -> None:
    """Refuse a wall of so many triangles, at which exact surfaces would be cut.

    Raises:
        VolfrepError: OpenCASCADE's Booleans do not manage it.
    """
    if triangles > MOST_WALL_TRIANGLES:
        raise VolfrepError(
            f"OpenCASCADE does not cut at a wall of {triangles:,} triangles (the limit is "
            f"{MOST_WALL_TRIANGLES:,})."
        )


def refuse_inexact(spec: LatticeSpec) -> None:
    """Refuse what exact surfaces are not made for.

    Raises:
        VolfrepError: there are drain holes.
    """
    if spec.drains is not None:
        raise VolfrepError("Exact surfaces have no drain holes.")


def estimate_beams(model: BeamMesh, asked: ExportChoice | None = None) -> Estimate:
    """Beams for CalculiX.

    Raises:
        VolfrepError: more than `MOST_BEAMS`; the text names the nearest setting that fits.
    """
    count = len(model.elements)
    if count > MOST_BEAMS:
        raise VolfrepError(
            f"{count:,} beam elements are more than the {MOST_BEAMS:,} that CalculiX takes: "
            f"choose {_fewer(asked, count / MOST_BEAMS)}."
        )
    solving = f"CalculiX solves it in about {_seconds(SOLVE_SECONDS_PER_BEAM * count)}"
    return Estimate(
        f"{count:,} beams", WRITE_SECONDS_PER_BEAM * count, 1e-6 * BYTES_PER_BEAM * count, solving
    )


def estimate_tetrahedra(triangles: int, asked: ExportChoice | None = None) -> Estimate:
    """Second-order tetrahedra for CalculiX, by Gmsh from the mesh.

    Args:
        triangles: of the mesh.
        asked: what the mesh was made of, to say which setting would fit.

    Raises:
        VolfrepError: more than a solver takes; the text names the nearest setting that fits.
    """
    if triangles > MAX_TETRAHEDRA_TRIANGLES:
        fits = _coarser(asked, triangles / MAX_TETRAHEDRA_TRIANGLES)
        raise VolfrepError(
            f"Tetrahedra from {triangles:,} triangles are more than a solver takes (the limit is "
            f"{MAX_TETRAHEDRA_TRIANGLES:,}): choose {fits}, or beams."
        )
    what = (
        f"about {ELEMENTS_PER_TRIANGLE * triangles:,.0f} tetrahedra, "
        f"{NODES_PER_TRIANGLE * triangles:,.0f} nodes"
    )
    is_cut = asked is not None and asked.count is None
    seconds = (SECONDS_PER_CUT_TRIANGLE if is_cut else SECONDS_PER_TRIANGLE) * triangles
    return Estimate(what, seconds, 1e-6 * BYTES_PER_TRIANGLE * triangles)


def estimate_lattice_tetrahedra(count: int) -> Estimate:
    """So many second-order tetrahedra of a lattice, for what Gmsh cannot fill."""
    what = (
        f"Gmsh cannot fill it: about {count:,} tetrahedra of a lattice instead, "
        f"{NODES_PER_LATTICE_TETRAHEDRON * count:,.0f} nodes"
    )
    seconds = SECONDS_PER_LATTICE_TETRAHEDRON * count
    return Estimate(what, seconds, 1e-6 * BYTES_PER_LATTICE_TETRAHEDRON * count)


def _coarser(asked: ExportChoice | None, excess: float) -> str:
    return "a coarser deviation or larger cells" if asked is None else asked.coarser(excess)


def _fewer(asked: ExportChoice | None, excess: float) -> str:
    return "larger cells" if asked is None else asked.fewer(excess)


def _seconds(value: float) -> str:
    return f"{max(value, 0.1):.1f} s" if value < 10 else f"{value:,.0f} s"


def _size(megabytes: float) -> str:
    return f"{max(megabytes, 0.1):.1f} MB" if megabytes < 10 else f"{megabytes:,.0f} MB"
