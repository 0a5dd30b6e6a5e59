# SPDX-License-Identifier: LGPL-2.1-or-later
"""The surface that sheets follow, without thickness: an open mesh that a slicer prints as one line.

What is solid on one side of the surface ends at the surface or at the wall of what is filled. So
the facets of that side that do not lie on the wall are the surface within the wall, cut exactly
where both meet, however cells are graded, turned or bent.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace

import numpy as np

from ..design.spec import LatticeSpec
from ..design.tpms import TpmsSheet
from ..jobs.infill import Infill
from ..mesh.float32_repair import shortest_edge
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..spatial.proximity import closest_points, index_surface
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..util.threads import threads
from ..util.types import Bools, Floats
from .meshes import mesh_form, write_mesh

#: A facet lies on the wall where its corners and its middle do within so many shortest edges.
_ON_WALL = 2.0
#: The wall is sampled this often along the diagonal of its box: few points are near to a sample.
_SAMPLES_ALONG = 150.0


@dataclass(frozen=True, eq=False, repr=False)
class BareSurface(Shown):
    """An open surface within a part.

    Attributes:
        mesh: of the surface, mm; its facets face where the formula is positive.
        area: mm2.
        rim: length of its open edges, which lie on the wall of what is filled, mm.
        warnings: sentences for the user.
    """

    mesh: TriangleMesh
    area: float
    rim: float
    warnings: tuple[str, ...] = ()

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        return [
            ("surface", f"{self.area:,.2f} mm2, open along {self.rim:,.1f} mm"),
            ("triangles", f"{len(self.mesh.triangles):,}"),
        ]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it as STL, 3MF, PLY, OBJ, OFF or GLB; an old file stays if anything goes wrong.

        Raises:
            VolfrepError: the format holds closed solids only, or the path cannot be written.
        """
        refuse_solid_form(path)
        if mesh_form(path).name == "3mf":
            from ..io.write.threemf import write_3mf

            write_3mf(self.mesh, path, is_open=True)
        else:
            write_mesh(self.mesh, path)


def refuse_solid_form(path: str | os.PathLike[str]) -> None:
    """Refuse a file that holds closed solids only.

    Raises:
        VolfrepError: naming one that does.
    """
    if mesh_form(path).name == "step":
        raise VolfrepError(
            f"'{path}' holds closed solids, and a bare surface is open: write an STL or a 3MF."
        )


def bare_surface(
    solid: TriangleMesh,
    spec: LatticeSpec,
    *,
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> BareSurface:
    """The surface of a specification's sheets within a part, without thickness.

    Args:
        solid: checked closed mesh, mm.
        spec: of sheets along a TPMS, without a skin, or with the output ``lattice``, which ends at
            the skin's inner side. Their thickness says nothing.
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the costly stages of the part.

    Raises:
        VolfrepError: the lattice has no sheets, or something of it is about their thickness.
        Cancelled: the callback said so.
    """
    monitor = Monitor(progress)
    infill = Infill(solid, _one_side(spec), monitor=monitor, cache=cache)
    mesh = infill.lattice.mesh
    boundary = infill.cavity if spec.with_skin or spec.skin is not None else solid
    within = _ON_WALL * shortest_edge(solid)
    at_boundary = _near(boundary, mesh.vertices, within)
    flat = np.flatnonzero(at_boundary[mesh.triangles].all(axis=1))
    middles = mesh.vertices[mesh.triangles[flat]].mean(axis=1)
    is_surface = np.ones(len(mesh.triangles), bool)
    is_surface[flat[_near(boundary, middles, within)]] = False
    if not is_surface.any():
        raise VolfrepError(
            "No piece of the surface lies within the part: make the cells smaller, or move their "
            "origin."
        )
    surface = compact(TriangleMesh(mesh.vertices, mesh.triangles[is_surface]))
    ends = np.sort(surface.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    pairs, uses = np.unique(ends, axis=0, return_counts=True)
    first, second = surface.vertices[pairs[uses == 1]].swapaxes(0, 1)
    rim = float(np.linalg.norm(second - first, axis=1).sum())
    return BareSurface(surface, surface.area, rim, infill.warnings)


def _near(boundary: TriangleMesh, points: Floats, within: float) -> Bools:
    """(n,) which of (n, 3) points lie no farther from the wall, mm."""
    spacing = float(np.linalg.norm(np.ptp(boundary.bounds, axis=0))) / _SAMPLES_ALONG
    index = index_surface(boundary, spacing)
    reach = within + 0.75 * index.spacing
    away = index.tree.query(points, distance_upper_bound=reach, workers=threads())[0]
    result: Bools = np.isfinite(away)
    some = np.flatnonzero(result)
    result[some] = closest_points(boundary, points[some])[1] <= within
    return result


def _one_side(spec: LatticeSpec) -> LatticeSpec:
    """The specification of all on the one side of the surface.

    Raises:
        VolfrepError: the lattice has no sheets, or something of it is about their thickness.
    """
    if spec.kind.has_struts:
        raise VolfrepError(
            "Only sheets along a TPMS have a surface without thickness: choose such a cell as "
            "Gyroid."
        )
    if not spec.wall.is_sheet:
        raise VolfrepError(
            f"A {spec.wall.kind} has no sheets, and a bare surface is that of sheets: leave the "
            "kind of wall out."
        )
    if spec.radius_grading is not None or spec.target is not None:
        raise VolfrepError(
            "A bare surface has no thickness: leave out its grading, and a target of density, mass "
            "or stiffness."
        )
    if spec.output == "domain" or (spec.output == "part" and spec.shell > 0.0):
        raise VolfrepError(
            "A bare surface is joined to no skin: set the skin thickness to 0, or make the lattice "
            "alone, which ends at the skin's inner side."
        )
    # Pieces that hang on nothing are kept: of the side, which nobody prints.
    side = TpmsSheet("skeleton", spec.wall.thickness, 0.0)
    return replace(spec, wall=side, output="lattice", keep_pieces=True)
