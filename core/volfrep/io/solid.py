# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading a solid from a file, and making sure that it is one.

The formats lie in `read`, the repairs in `repair`; here is the order in which they are tried. A
repair is made where it can mean one thing only, and is told. Whatever was done, the result is
proved: it is closed, two triangles share each edge and run along it in opposite directions, and
lines through it find the same volume inside, nearly all of it enclosed once.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..mesh.float32_repair import remove_slivers, separate_vertices, shortest_edge
from ..mesh.topology import Sides, edges_of
from ..mesh.triangle_mesh import TriangleMesh, compact
from ..spatial.winding import Windings, windings
from ..util.arguments import check_path
from ..util.errors import VolfrepError, brief
from ..util.numbers import place_text, plural
from ..util.progress import Monitor, ProgressCallback
from ..util.types import Bools, Ints
from .read import read_file
from .read.units import UNITS, find_unit, size_text
from .repair.holes import close_holes, cut_off_sheets
from .repair.junctions import mend_junctions
from .repair.orient import orient, separate
from .repair.overlaps import CLEAN, unite, unite_with_itself
from .repair.shells import empty_shells, face_outward, shells_of
from .repair.weld import ROUNDING, close_cracks, weld_equal, without_double_faces, without_repeats

#: This part of the volume may be enclosed twice or inside out before a surface is refused: real
#: files have facets that run through their neighbours by a hair.
MOST_ODD = 1e-3
#: Along the same lines the solid before and after a union measures the same, to rounding.
SAME_VOLUME = 1e-6
#: Lines find the volume to about 1 / sqrt(lines) of it; a difference this many times as large
#: means that the mesh is not what it says.
VOLUME_ERRORS = 5.0
#: Surfaces that touched are kept apart by a few steps of single precision, if these are no more
#: than this part of the part.
FINE_STEP = 1e-4
#: Coordinates so large that single precision is coarser than this part of the part get a warning,
#: and a refusal: no lattice of a thousandth of it could be written to a file.
COARSE_STEP = 1e-5
COARSEST_STEP = 1e-4


@dataclass(frozen=True, eq=False)
class Solid(TriangleMesh):
    """A closed, oriented mesh in mm, with what was done to make it one.

    Attributes:
        repairs: sentences, one for each kind of repair: what, and how many.
        warnings: sentences about what is odd and was left.
        states_unit: whether the file or the user said the unit (else mm was assumed).
    """

    repairs: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    states_unit: bool = True

    @property
    def notes(self) -> tuple[str, ...]:
        """All that a user should know about how the solid was read, repairs first."""
        return (*(f"Repaired: {text}" for text in self.repairs), *self.warnings)


def read_solid(
    path: str | os.PathLike[str],
    unit: str | None = None,
    *,
    progress: ProgressCallback | None = None,
    seen: Callable[[TriangleMesh], None] = lambda mesh: None,
) -> Solid:
    """Read a closed solid from an STL, OBJ, PLY, 3MF, STEP, IGES or BREP file.

    Args:
        path: the file; STEP, IGES and BREP need FreeCAD on the PATH.
        unit: of its lengths, a name in `volfrep.io.read.units.UNITS`; None for what the file says,
            and mm where it says nothing.
        progress: called while FreeCAD reads a CAD file; returning False cancels.
        seen: told its triangles in mm as they are, before they are looked at.

    Returns:
        The checked solid in mm, as `check_solid` returns it.

    Raises:
        VolfrepError: the file is missing, damaged, of another kind, or holds no closed solid.
        Cancelled: the callback said so.

    >>> import tempfile, trimesh
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "box.stl"
    ...     _ = trimesh.creation.box((3, 2, 1)).export(file)
    ...     solid = read_solid(file, unit="cm")
    >>> round(solid.volume, 3), solid.notes
    (6000.0, ())
    """
    check_path("path", path)
    mesh, notes, states_unit = _in_mm(path, unit, progress)
    seen(mesh)
    solid = check_solid(mesh, Path(path).name)
    return Solid(
        solid.vertices, solid.triangles, solid.repairs, (*notes, *solid.warnings), states_unit
    )


def read_triangles(path: str | os.PathLike[str], unit: str | None = None) -> TriangleMesh:
    """The triangles of a file in mm as they are, nothing repaired; otherwise as `read_solid`."""
    return _in_mm(path, unit)[0]


def _in_mm(
    path: str | os.PathLike[str], unit: str | None, progress: ProgressCallback | None = None
) -> tuple[TriangleMesh, tuple[str, ...], bool]:
    wanted = None if unit is None else find_unit(unit)
    contents = read_file(path, Monitor(progress))
    notes = contents.warnings
    if wanted is not None and contents.unit not in (None, wanted):
        notes += (f"'{Path(path).name}' says {contents.unit}, and was taken as {wanted}.",)
    used = wanted or contents.unit
    mesh = contents.mesh
    if used not in (None, "mm"):
        mesh = TriangleMesh(mesh.vertices * UNITS[used], mesh.triangles)
    return mesh, notes, used is not None


def check_solid(mesh: TriangleMesh, name: str) -> Solid:
    """The mesh as a clean closed solid, repaired where that can mean one thing only.

    Args:
        mesh: any triangles, mm.
        name: of the part, for messages.

    Raises:
        VolfrepError: naming what keeps it from being a solid, and where.

    >>> import trimesh
    >>> box = trimesh.creation.box((3, 2, 1))
    >>> turned = TriangleMesh(box.vertices, box.faces.astype(np.int32)).reversed()
    >>> solid = check_solid(turned, "box")
    >>> round(solid.volume, 6), len(solid.repairs)
    (6.0, 1)
    """
    if not len(mesh.triangles):
        raise VolfrepError(f"'{name}' holds no triangles: export the solid again.")
    if not np.isfinite(mesh.vertices[mesh.triangles]).all():
        raise VolfrepError(f"'{name}' has a coordinate that is not a number: export it again.")
    mesh = compact(mesh)
    size = float(np.ptp(mesh.bounds, axis=0).max())
    farthest = float(np.abs(mesh.bounds).max())
    if not 1e-9 < size < 1e9 or farthest > 1e12:
        raise VolfrepError(
            f"'{name}' is {size:.3g} mm large, up to {farthest:.3g} mm from the origin, which is "
            "no sensible part: is it in another unit?"
        )
    step = float(np.spacing(np.float32(farthest)))
    if step > COARSEST_STEP * size:
        raise VolfrepError(
            f"'{name}' measures {size_text(np.ptp(mesh.bounds, axis=0))} and lies {farthest:.3g} "
            f"mm from the origin, where single precision rounds to {step:.2g} mm: move it to the "
            "origin before export, or is it in another unit?"
        )
    repairs: list[str] = []
    mesh, done = without_repeats(weld_equal(mesh))
    repairs += done
    if not len(mesh.triangles):
        raise VolfrepError(f"'{name}' has no triangle with an area: give a solid, not a surface.")
    mesh, edges, turned, done, why = _close(mesh, size, name)
    repairs += done
    _refuse_defects(mesh, edges, why, name)
    mesh, done = separate(mesh, edges)
    repairs += done
    touched = bool(done)
    shell = shells_of(mesh, edges_of(mesh) if done else edges)
    empty, done = empty_shells(mesh, shell)
    if empty.all():
        raise VolfrepError(f"'{name}' encloses no volume: give a solid, not a surface.")
    if empty.any():
        repairs += done
        mesh, turned = compact(TriangleMesh(mesh.vertices, mesh.triangles[~empty])), turned[~empty]
        shell = np.unique(shell[~empty], return_inverse=True)[1].ravel()
    mesh, done, body = face_outward(mesh, shell, turned, name)
    repairs += done
    mesh, done, warnings = _unite_and_prove(mesh, body, touched, name)
    repairs += done
    if step > COARSE_STEP * size:
        warnings += (
            f"'{name}' lies {farthest:.3g} mm from the origin, where files in single precision "
            f"round to {step:.2g} mm: move it to the origin before export.",
        )
    return Solid(mesh.vertices, mesh.triangles, tuple(f"{text}." for text in repairs), warnings)


def _close(
    mesh: TriangleMesh, size: float, name: str
) -> tuple[TriangleMesh, Sides, Bools, list[str], str]:
    """Neighbours wound alike and, as far as that is certain, no open edges.

    Returns:
        The mesh, its edges, which triangles were turned, what was done, and why holes were left.
    """
    repairs: list[str] = []
    mends: tuple[Callable[[TriangleMesh], tuple[TriangleMesh, list[str]]], ...] = (
        without_double_faces,
        lambda m: close_cracks(m, size),
        lambda m: mend_junctions(m, ROUNDING * size),
        cut_off_sheets,
        without_double_faces,
    )
    edges = edges_of(mesh)
    for mend in mends:
        if edges.is_closed or edges.is_manifold:
            break
        mended, done = mend(mesh)
        if done and len(mended.triangles):
            mesh, more = without_repeats(mended)
            repairs += done + more
            edges = edges_of(mesh)
    turned = np.zeros(len(mesh.triangles), bool)
    if edges.is_closed:
        return mesh, edges, turned, repairs, ""
    mesh, turned = orient(mesh, edges, name)
    mesh, done, why = close_holes(mesh)
    repairs += done
    turned = np.concatenate([turned, np.zeros(len(mesh.triangles) - len(turned), bool)])
    return mesh, edges_of(mesh), turned, repairs, why


def _refuse_defects(mesh: TriangleMesh, edges: Sides, why: str, name: str) -> None:
    def place(side: int) -> str:
        return place_text(mesh.vertices[edges.sides[side]].mean(axis=0))

    open_sides = edges.open_sides
    if len(open_sides):
        number = plural(len(open_sides), "edge has", "edges have")
        raise VolfrepError(
            f"'{name}' is not closed: {number} a triangle on one side only, the first near "
            f"{place(open_sides[0])}{f', and {why}' * bool(why)}; close the hole and try again."
        )
    odd = np.flatnonzero((edges.balance != 0)[edges.number])
    if len(odd):
        number = plural(int((edges.balance != 0).sum()), "edge is", "edges are")
        raise VolfrepError(
            f"'{name}' is not one clean surface: {number} shared by more than two triangles that "
            f"do not fit together, the first near {place(odd[0])}; separate the bodies that meet "
            "there."
        )


def _unite_and_prove(
    mesh: TriangleMesh, body: Ints, touched: bool, name: str
) -> tuple[TriangleMesh, list[str], tuple[str, ...]]:
    """Overlaps united, and the proof that the result is a solid, the one that was meant.

    Args:
        mesh: closed, oriented.
        body: (m,) the body each triangle belongs to.
        touched: whether surfaces that touch were taken apart.
        name: of the part.

    Returns:
        The mesh, what was done, and warnings.

    Raises:
        VolfrepError: naming what is wrong, and where.
    """
    box = mesh.bounds
    before = windings(mesh, box)
    mesh, done = unite(mesh, body, name)
    met = windings(mesh, box) if done else before
    if met.odd > CLEAN * met.solid:
        united = unite_with_itself(mesh, met, name)
        if united is not None and windings(united, box).odd <= CLEAN * met.solid:
            done.append(f"Overlaps of the surface with itself{_near(met)} united")
            mesh, met = united, windings(united, box)
    if abs(met.solid - before.solid) > SAME_VOLUME * before.solid:
        raise VolfrepError(
            f"'{name}' runs through itself{_near(before)}, and its bodies could not be united to "
            "one solid: unite them before export."
        )
    _refuse_contact(mesh, name)
    precision = shortest_edge(mesh)
    if (touched or done) and precision < FINE_STEP * float(np.ptp(box, axis=0).max()):
        mesh = separate_vertices(remove_slivers(mesh, precision), precision)
        met = windings(mesh, box)
    if met.odd > MOST_ODD * met.solid:
        what = "inside out" if met.least < 0 else "enclosed more than once"
        raise VolfrepError(
            f"'{name}' has a surface that runs through itself: {met.odd:.3g} mm3 are {what}"
            f"{_near(met, ', the most near ')}; mend it there and export it again."
        )
    volume = mesh.volume
    error = VOLUME_ERRORS / max(met.lines, 1) ** 0.5
    if volume <= 0.0 or abs(met.solid - volume) > error * volume + met.odd:
        raise VolfrepError(f"'{name}' encloses no volume: give a solid, not a surface.")
    if met.odd <= CLEAN * met.solid:
        return mesh, done, ()
    share = 100.0 * met.odd / volume
    return (
        mesh,
        done,
        (
            f"The surface of '{name}' runs through itself{_near(met)}; {share:.2g} % of "
            "the volume is concerned.",
        ),
    )


def _refuse_contact(mesh: TriangleMesh, name: str) -> None:
    edges = edges_of(mesh)
    odd = np.flatnonzero(((edges.count != 2) | (edges.balance != 0))[edges.number])
    if len(odd):
        place = place_text(mesh.vertices[edges.sides[odd[0]]].mean(axis=0))
        raise VolfrepError(
            f"'{name}' has surfaces that touch near {place} in a way that cannot be taken apart: "
            "mend it there and export it again."
        )


def _near(met: Windings, words: str = " near ") -> str:
    """Where most of what is not enclosed once lies; nothing where no line met it."""
    return "" if met.place is None else words + place_text(met.place)


class MeshLike(Protocol):
    """Anything with vertices and faces, such as a `trimesh.Trimesh`."""

    @property
    def vertices(self) -> ArrayLike:
        """(n, 3) in mm."""

    @property
    def faces(self) -> ArrayLike:
        """(m, 3) vertex numbers, counter-clockwise from outside."""


def solid_of(part: Any, unit: str | None = None, progress: ProgressCallback | None = None) -> Solid:
    """A proved solid of what a script gives: a file, a mesh, or its vertices and triangles.

    Raises:
        VolfrepError: it is none.
        Cancelled: the callback said so while FreeCAD read a CAD file.
    """
    if isinstance(part, Solid):
        return part
    if isinstance(part, (str, os.PathLike)):
        return read_solid(part, unit, progress=progress)
    if unit is not None:
        raise VolfrepError("A unit belongs to a file: give the arrays of a mesh in mm.")
    if isinstance(part, TriangleMesh):
        return check_solid(part, "mesh")
    if isinstance(part, tuple) and len(part) == 2:
        vertices, triangles = part
    elif hasattr(part, "vertices") and hasattr(part, "faces"):
        vertices, triangles = part.vertices, part.faces
    else:
        raise VolfrepError(
            f"A part is a file's path, a mesh with vertices and faces, or a pair of arrays, not "
            f"{type(part).__name__}."
        )
    try:
        points, rows = np.asarray(vertices, np.float64), np.asarray(triangles)
    except (TypeError, ValueError, OverflowError) as error:
        raise VolfrepError(
            f"A mesh has (n, 3) vertices in mm and (m, 3) triangles, not {brief(part)}."
        ) from error
    shapes_fit = points.ndim == 2 and rows.ndim == 2 and points.shape[1] == rows.shape[1] == 3
    if not shapes_fit or not len(rows) or rows.dtype.kind not in "iu":
        raise VolfrepError(
            "A mesh has (n, 3) vertices and (m, 3) triangles of whole numbers, not arrays of the "
            f"shapes {points.shape} and {rows.shape}."
        )
    if rows.min() < 0 or rows.max() >= len(points):
        raise VolfrepError(f"A triangle names a vertex that is not among the {len(points)}.")
    if not np.isfinite(points).all():
        raise VolfrepError("A vertex of the mesh has a coordinate that is not a finite number.")
    return check_solid(TriangleMesh(points, rows.astype(np.int32)), "mesh")
