# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part held against a printing process, and what of it hangs over."""

from __future__ import annotations

from ...design.spec import LatticeSpec
from ...grid.inclination import unit_direction
from ...grid.strut_graph import Wireframe
from ...mesh.triangle_mesh import TriangleMesh, compact
from ...reports.printability import PrintReport, overhanging_facets, print_report
from ...reports.processes import Process
from ..kinds import lattice_kind


def check_print(
    mesh: TriangleMesh,
    lattice: Wireframe,
    domain: TriangleMesh | None,
    spec: LatticeSpec,
    process: Process,
    build_direction: tuple[float, float, float],
) -> PrintReport:
    """The report alone; arguments as of `print_check`, with None for a block's domain.

    Raises:
        VolfrepError: the build direction is no direction.
    """
    kind = lattice_kind(spec)
    return print_report(
        mesh,
        lattice,
        process,
        build_direction=build_direction,
        density=spec.density,
        domain=domain,
        ball_mm=kind.largest_ball(),
        sheet_and_gap_mm=kind.sheet_and_gap(),
    )


def print_check(
    mesh: TriangleMesh,
    lattice: Wireframe,
    domain: TriangleMesh,
    spec: LatticeSpec,
    process: Process,
    build_direction: tuple[float, float, float],
) -> tuple[PrintReport, TriangleMesh]:
    """The report, and the triangles that face down too flat.

    Args:
        mesh: the part as it will be printed, closed, mm.
        lattice: its nodes and struts.
        domain: closed mesh of what the lattice fills.
        spec: what it was made by.
        process: the limits.
        build_direction: from the build plate up, of any length.

    Raises:
        VolfrepError: the build direction is no direction.
    """
    report = check_print(mesh, lattice, domain, spec, process, build_direction)
    hanging = overhanging_facets(mesh, unit_direction(build_direction), process.inclination)
    return report, compact(TriangleMesh(mesh.vertices, mesh.triangles[hanging]))
