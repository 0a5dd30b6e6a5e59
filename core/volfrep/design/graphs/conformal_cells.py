# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells laid into hexahedra of any shape: networks that follow a part, its faces or a mesh.

The cell's unit cube is mapped to each hexahedron by its eight corners (the trilinear map of
O. C. Zienkiewicz, The Finite Element Method, chapter on mapped elements), or to each place of a
grid by a function of three coordinates. Nodes that meet on a common face become one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...mesh.topology import pieces_of
from ...util.errors import VolfrepError
from ...util.numbers import place_text
from ...util.types import Floats, Ints
from ..cells import NODE_TOLERANCE, UnitCell, find_same
from .graph import MAX_STRUTS, GivenGraph, make_network

#: Nodes nearer than this part of the shortest edge of a hexahedron are one.
SAME_PLACE = 1e-4
#: Corners of a hexahedron in the order of VTK, Abaqus and Gmsh, in its own coordinates.
CORNERS = np.array(
    [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
)
#: Its faces: an axis and a side, and the corners that lie there.
_FACES = [
    (axis, side, np.flatnonzero(CORNERS[:, axis] == side)) for axis in range(3) for side in (0, 1)
]
#: Its edges, as pairs of corners.
_EDGES = np.array(
    [(a, b) for a in range(8) for b in range(a) if np.abs(CORNERS[a] - CORNERS[b]).sum() == 1]
)


def place_cells_into(
    cell: UnitCell, corners: Floats, hexahedra: Ints, where: str = "mesh", source: str = ""
) -> GivenGraph:
    """A cell laid into every hexahedron of a mesh.

    Args:
        cell: that fits its neighbours on the faces where hexahedra meet; whatever way these are
            turned if it looks alike from all sides, as most of the library's do.
        corners: (n, 3) mm; those at the same place are one.
        hexahedra: (m, 8) rows of `corners`, in the order of VTK, Abaqus and Gmsh.
        where: what the mesh is called in errors.
        source: the file that it is from.

    Raises:
        VolfrepError: a hexahedron is folded, there are too many, or the cell does not fit.

    >>> from volfrep.design.cells import find_cell
    >>> cube = place_cells_into(find_cell("BCC"), 10.0 * CORNERS, [range(8)])
    >>> len(cube.nodes), len(cube.struts)
    (9, 20)
    """
    boxes = np.asarray(hexahedra, np.int64).reshape(-1, 8)
    points = np.asarray(corners, float)
    if len(boxes) * len(cell.struts) > 4 * MAX_STRUTS:
        raise VolfrepError(
            f"The {where} has {len(boxes):,} hexahedra: with {len(cell.struts)} struts in each "
            f"'{cell.name}' that is more than {MAX_STRUTS:,} struts."
        )
    at = points[boxes]
    shortest = np.linalg.norm(at[:, _EDGES[:, 0]] - at[:, _EDGES[:, 1]], axis=2).min(axis=1)
    _refuse_folded(at, shortest, where)
    same = SAME_PLACE * float(shortest.min())
    u, v, w = (np.where(CORNERS[:, k] == 1, c, 1.0 - c)
               for k, c in enumerate(cell.nodes.T[:, :, None]))  # fmt: skip
    places = np.einsum("nc,mcd->mnd", u * v * w, at)
    merged = _merge_near(places.reshape(-1, 3), same)
    nodes, struts = _join_cells(places.reshape(-1, 3), merged, cell, len(boxes))
    corner_rows = _merge_near(points, same)[boxes]
    _refuse_misfits(cell, merged.reshape(len(boxes), -1), corner_rows, where)
    made = make_network(nodes, struts, (), where, source, np.tile(cell.widths, len(boxes)))
    return replace(made, cell=cell.name)


def place_cells_along(
    cell: UnitCell,
    place: Callable[[Floats], Floats],
    counts: tuple[int, int, int],
    where: str = "network",
) -> GivenGraph:
    """A cell laid into a grid that a function bends; struts are straight between its nodes.

    Args:
        cell: of which every one is laid the same way.
        place: from (n, 3) coordinates, each from 0 to 1 through the whole grid, to mm.
        counts: cells along each coordinate. Ends of the grid that meet in space are joined.
        where: what it is called in errors.

    Raises:
        VolfrepError: there are too many cells, or the function draws a cell together.
    """
    total = int(np.prod(counts))
    if min(counts) < 1 or total * len(cell.struts) > 4 * MAX_STRUTS:
        raise VolfrepError(
            f"{' x '.join(map(str, counts))} cells of {len(cell.struts)} struts are none, or more "
            f"than {MAX_STRUTS:,} struts: choose another cell size."
        )
    origins = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1).reshape(-1, 3)
    inside = (origins[:, None] + cell.nodes).reshape(-1, 3)
    # First where the grid's own steps say so, to ask for each place once.
    first, inverse = find_same(inside)
    places = np.asarray(place(inside[first] / np.array(counts)), float)
    if not np.isfinite(places).all():
        raise VolfrepError(f"The {where} has nodes at places that are not finite.")
    rows = inverse[_by_cell(cell, total)].reshape(-1, 2)
    length = np.linalg.norm(places[rows[:, 0]] - places[rows[:, 1]], axis=1)
    usual = float(np.median(length))
    if length.min() < 1e-3 * usual:
        at = place_text(places[rows[int(length.argmin()), 0]])
        raise VolfrepError(
            f"The {where} draws a cell together at {at}: choose faces that have four sides each "
            "and do not meet there."
        )
    merged = _merge_near(places, SAME_PLACE * float(length.min()))
    nodes, struts = _join_cells(places[inverse.ravel()], merged[inverse.ravel()], cell, total)
    made = make_network(nodes, struts, (), where, widths=np.tile(cell.widths, total))
    return replace(made, cell=cell.name)


def layers_on(
    cell: UnitCell,
    corners: Floats,
    quads: Ints,
    thickness: float,
    layers: int = 1,
    where: str = "mesh",
    source: str = "",
) -> GivenGraph:
    """Layers of a cell upon a surface of quadrilaterals, along its normals.

    Args:
        cell: as of `place_cells_into`.
        corners: (n, 3) mm.
        quads: (m, 4) rows of `corners`, all of them turned the same way.
        thickness: of all layers together, mm; below 0 on the other side of the surface.
        layers: how many.
        where: what the mesh is called in errors.
        source: the file that it is from.

    Raises:
        VolfrepError: as of `place_cells_into`, or there is no thickness.
    """
    if not thickness or not np.isfinite(thickness):
        raise VolfrepError(f"Layers on the {where} need a thickness: give it in mm.")
    if layers < 1:
        raise VolfrepError(f"The {where} needs one layer at least, not {layers}.")
    points, faces = np.asarray(corners, float), np.asarray(quads, np.int64).reshape(-1, 4)
    span = np.linalg.norm(points[faces[:, 0]] - points[faces[:, 2]], axis=1)
    rows = _merge_near(points, SAME_PLACE * float(span.min()))
    _, first = np.unique(rows, return_index=True)
    points, faces = points[first], rows[faces]
    a, b, c, d = (points[faces[:, k]] for k in range(4))
    across = np.cross(c - a, d - b)
    normals = np.zeros_like(points)
    for k in range(4):
        np.add.at(normals, faces[:, k], across)
    size = np.linalg.norm(normals, axis=1)
    if size.min() == 0.0 or not _turned_alike(faces):
        raise VolfrepError(
            f"The quadrilaterals of the {where} are not all turned the same way: turn their "
            "normals to one side."
        )
    normals /= size[:, None]
    heights = np.linspace(0.0, thickness, layers + 1)
    stacked = (points + heights[:, None, None] * normals).reshape(-1, 3)
    lifted = faces + len(points) * np.arange(layers + 1)[:, None, None]
    boxes = np.concatenate([lifted[:-1], lifted[1:]], axis=2).reshape(-1, 8)
    return place_cells_into(cell, stacked, boxes, where, source)


def _turned_alike(faces: Ints) -> bool:
    """Whether no two quadrilaterals run along an edge in the same direction."""
    ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)
    return len(np.unique(ends, axis=0)) == len(ends)


def _by_cell(cell: UnitCell, count: int) -> Ints:
    """(count * struts, 2) rows of the nodes of all cells, one cell's after the other's."""
    shift = len(cell.nodes) * np.arange(count)[:, None, None]
    rows: Ints = (cell.struts + shift).reshape(-1, 2)
    return rows


def _join_cells(places: Floats, merged: Ints, cell: UnitCell, count: int) -> tuple[Floats, Ints]:
    """Nodes where they first are, and the struts of all cells between them."""
    _, first, rows = np.unique(merged, return_index=True, return_inverse=True)
    return places[first], rows.ravel()[_by_cell(cell, count)]


def _merge_near(points: Floats, same: float) -> Ints:
    """For each point a number that it shares with all that are nearer than `same` to it."""
    from scipy.spatial import cKDTree  # slow to load, and every job loads this module

    pairs = cKDTree(points).query_pairs(same, output_type="ndarray")
    return pieces_of(pairs[:, 0], pairs[:, 1], len(points))[1]


def _refuse_folded(at: Floats, shortest: Floats, where: str) -> None:
    """Refuse a hexahedron that is turned inside out at one of its corners.

    Args:
        at: (m, 8, 3) corners.
        shortest: (m,) edges.
        where: what the mesh is called in errors.
    """
    volumes = []
    for corner in range(8):
        ends = [
            np.flatnonzero((np.abs(CORNERS - CORNERS[corner]) == np.eye(3, dtype=int)[axis]).all(1))
            for axis in range(3)
        ]
        sides = [(at[:, end[0]] - at[:, corner]) for end in ends]
        turn = 1 if CORNERS[corner].sum() % 2 == 0 else -1
        volumes.append(turn * np.einsum("ij,ij->i", np.cross(sides[0], sides[1]), sides[2]))
    found = np.stack(volumes)
    least = 1e-3 * shortest**3
    # One that is a mirror image as a whole is none the worse.
    bad = np.flatnonzero(~((found > least).all(axis=0) | (found < -least).all(axis=0)))
    if len(bad):
        folded = place_text(at[bad[0]].mean(axis=0))
        raise VolfrepError(
            f"In the {where}, hexahedron {bad[0]} at {folded} is folded or has "
            "no volume: its corners must be numbered as in VTK, and it must be convex there."
        )


def _refuse_misfits(cell: UnitCell, nodes: Ints, corners: Ints, where: str) -> None:
    """Refuse cells whose nodes or struts on a common face of two hexahedra are not the same.

    Where cells stand side by side as in a grid, some of a cell's nodes may have no twin in the
    other: so many, and no more, are let pass.

    Args:
        cell: that was laid.
        nodes: (m, n) merged numbers of the cells' nodes.
        corners: (m, 8) merged numbers of the hexahedra's corners.
        where: what the mesh is called in errors.
    """
    on = [np.flatnonzero(np.abs(cell.nodes[:, a] - s) < NODE_TOLERANCE) for a, s, _ in _FACES]
    along = [cell.struts[np.isin(cell.struts, rows).all(axis=1)] for rows in on]
    keys = np.concatenate([np.sort(corners[:, at], axis=1) for _, _, at in _FACES])
    _, face, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    each = face.reshape(6, len(corners))
    # Which two sides of their hexahedra a face is of, as bits.
    sides = np.zeros(len(count), np.int64)
    np.add.at(sides, each, 1 << np.arange(6)[:, None])
    twins = [_lone_in_grid(cell, on, along, axis) for axis in range(3)]
    for kind, rows in enumerate((on, along)):
        width = kind + 1
        table = np.concatenate([
            np.column_stack([
                np.repeat(f, len(r)), np.sort(nodes[:, r].reshape(-1, width), axis=1)
            ])
            for f, r in zip(each, rows, strict=True)
        ])  # fmt: skip
        found, seen = np.unique(table, axis=0, return_counts=True)
        alone = np.bincount(found[seen == 1, 0], minlength=len(count))
        allowed = np.zeros(len(count), np.int64)
        for axis, lone in enumerate(twins):
            allowed[sides == 3 << 2 * axis] = lone[kind]
        if ((alone > allowed) & (count == 2)).any():
            raise VolfrepError(
                f"The cell '{cell.name}' does not fit itself where two hexahedra of the {where} "
                "meet that are turned differently: choose a cell that looks alike from all sides, "
                "such as BCC or Octet."
            )


def _lone_in_grid(cell: UnitCell, on: list[Ints], along: list[Ints], axis: int) -> tuple[int, int]:
    """Nodes, and struts, on a face between two cells of a grid that only one of them has."""
    others = [k for k in range(3) if k != axis]
    steps = np.round(cell.nodes[:, others] / NODE_TOLERANCE).astype(np.int64)
    points = [{tuple(row) for row in steps[on[2 * axis + side]].tolist()} for side in (0, 1)]
    lines = [
        {frozenset(map(tuple, pair)) for pair in steps[along[2 * axis + side]].tolist()}
        for side in (0, 1)
    ]
    return len(points[0] ^ points[1]), len(lines[0] ^ lines[1])
