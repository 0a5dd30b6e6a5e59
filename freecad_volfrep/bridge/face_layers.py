# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells laid along faces of a solid: between two of them, or in layers upon one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD as App
import numpy as np

from volfrep.design.cells import UnitCell
from volfrep.design.graphs import GivenGraph
from volfrep.design.graphs.conformal_cells import place_cells_along
from volfrep.util.errors import VolfrepError
from volfrep.util.types import Floats

from .solids import placed_face

#: A face is looked at in so many places along each of its two directions.
_LOOKS = 9
#: A face closes where its ends are nearer than this part of its size.
_CLOSED = 1e-6
#: Places at which a closed face may begin, for it to begin where the other one does.
_BEGINNINGS = 16

#: From (n, 2) coordinates, each from 0 to 1 over the face, to (n, 3) mm.
Surface = Callable[[Floats], Floats]


def between_faces(
    faces: list[tuple[App.DocumentObject, str]],
    frame: App.Placement,
    cell: UnitCell,
    cell_size: float,
    layers: int,
    thickness: float,
) -> GivenGraph:
    """A cell laid between two faces, or upon one, its outermost nodes on the faces themselves.

    Args:
        faces: one or two, by their objects and names; each has four sides, or two and closes.
        frame: a placement in the document, in whose coordinates the network is.
        cell: that is laid.
        cell_size: that the cells come nearest to, mm.
        layers: of cells from one face to the other; 0 for as many as come nearest to the size.
        thickness: of all layers upon one face, mm, into its solid; below 0 out of it.

    Raises:
        VolfrepError: a face is no more, or has not four sides; no thickness for one face.
    """
    if not 1 <= len(faces) <= 2:
        raise VolfrepError(f"Cells lie upon one face or between two, not {len(faces)}: pick those.")
    first = placed_face(*faces[0], frame)
    lower = _surface(first, faces[0][1])
    if len(faces) == 1:
        if not thickness:
            raise VolfrepError(
                "Layers of cells upon one face need a thickness: give NetworkThickness, or pick "
                "the face up to which they go."
            )
        inward = _inward(first)

        def upper(q: Floats) -> Floats:
            ends = lower(q)
            return ends + thickness * inward(ends)
    else:
        upper = _facing(lower, _surface(placed_face(*faces[1], frame), faces[1][1]))

    def place(q: Floats) -> Floats:
        # Nodes above each other ask for one place.
        flat, rows = np.unique(np.round(q[:, :2], 12), axis=0, return_inverse=True)
        rows = rows.ravel()
        low, high = lower(flat)[rows], upper(flat)[rows]
        return low + q[:, 2:] * (high - low)

    lengths = _lengths(place)
    counts = [max(1, round(length / cell_size)) for length in lengths]
    if layers:
        counts[2] = layers
    return place_cells_along(
        cell, place, (counts[0], counts[1], counts[2]), "layers along the faces"
    )


def _surface(face: Any, name: str) -> Surface:
    """A face as a function of two coordinates from 0 to 1.

    Raises:
        VolfrepError: the face has not four sides.
    """
    u0, u1, v0, v1 = face.ParameterRange
    steps = np.linspace(0.0, 1.0, _LOOKS)
    whole = all(
        face.isPartOfDomain(u0 + (u1 - u0) * s, v0 + (v1 - v0) * t) for s in steps for t in steps
    )
    if whole and len(face.Wires) == 1:
        return lambda q: np.array(
            [tuple(face.valueAt(u0 + (u1 - u0) * s, v0 + (v1 - v0) * t)) for s, t in q]
        )
    edges = face.OuterWire.OrderedEdges
    if len(face.Wires) != 1 or len(edges) != 4:
        raise VolfrepError(
            f"{name} has {len(edges)} sides{' and holes' * (len(face.Wires) > 1)}: cells are laid "
            "along faces of four sides."
        )
    return _patch(face, edges)


def _patch(face: Any, edges: list[Any]) -> Surface:
    """A face between four edges, by the patch of S. A. Coons (MIT MAC-TR-41, 1967) upon it."""

    def along(edge: Any) -> Surface:
        """Points of an edge, in the direction of the wire, from 0 to 1."""
        low, high = edge.FirstParameter, edge.LastParameter
        if edge.Orientation == "Reversed":
            low, high = high, low
        return lambda s: np.array([tuple(edge.valueAt(low + (high - low) * k)) for k in s])

    south, east, north, west = map(along, edges)
    one, zero = np.ones(1), np.zeros(1)
    a, b, c, d = south(zero), south(one), north(zero), north(one)

    def place(q: Floats) -> Floats:
        s, t = q[:, :1], q[:, 1:]
        up, down = north(1.0 - q[:, 0]), south(q[:, 0])
        left, right = west(1.0 - q[:, 1]), east(q[:, 1])
        corners = (1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d
        points = (1 - t) * down + t * up + (1 - s) * left + s * right - corners
        return np.array(
            [
                tuple(face.Surface.value(*face.Surface.parameter(App.Vector(*point))))
                for point in points
            ]
        )

    return place


def _inward(face: Any) -> Surface:
    """Unit normals into the solid at (n, 3) points of a face."""
    sign = -1.0  # a face's normal points out of its solid

    def normals(points: Floats) -> Floats:
        found = [
            tuple(face.normalAt(*face.Surface.parameter(App.Vector(*point)))) for point in points
        ]
        return sign * np.array(found)

    return normals


def _facing(lower: Surface, upper: Surface) -> Surface:
    """The second face turned so that its coordinates run as the first one's do."""
    steps = np.linspace(0.0, 1.0, 5)
    q = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
    goal = lower(q)
    closed = [_closes(upper, axis) for axis in range(2)]
    best: tuple[float, Surface] | None = None
    for swap in (False, True):
        for flip in np.ndindex(2, 2):
            shifts = [np.arange(_BEGINNINGS) / _BEGINNINGS if c else np.zeros(1) for c in closed]
            for shift in np.array(np.meshgrid(*shifts)).reshape(2, -1).T:
                turned = _turned(upper, swap, flip, shift, closed)
                away = float(np.linalg.norm(turned(q) - goal, axis=1).sum())
                if best is None or away < best[0] * (1.0 - 1e-9):
                    best = away, turned
    assert best is not None
    return best[1]


def _turned(
    surface: Surface, swap: bool, flip: tuple[int, ...], shift: Floats, closed: list[bool]
) -> Surface:
    def place(q: Floats) -> Floats:
        at = q[:, ::-1] if swap else q
        at = np.where(np.array(flip) == 1, 1.0 - at, at)
        if any(closed):
            moved = at + shift
            at = np.where(closed, np.where(moved > 1.0, moved - 1.0, moved), at)
        return surface(at)

    return place


def _closes(surface: Surface, axis: int) -> bool:
    ends = np.full((2, 2), 0.3)
    ends[:, axis] = 0.0, 1.0
    across = np.full((2, 2), 0.3)
    across[:, axis] = 0.0, 0.5
    gap, size = (float(np.linalg.norm(np.diff(surface(q), axis=0))) for q in (ends, across))
    return gap < _CLOSED * size


def _lengths(place: Surface) -> list[float]:
    """Mean length of the three coordinates' lines, mm."""
    steps = np.linspace(0.0, 1.0, 17)
    found = []
    for axis in range(3):
        others = [k for k in range(3) if k != axis]
        lengths = []
        for rest in np.ndindex(2, 2):
            q = np.zeros((len(steps), 3))
            q[:, axis] = steps
            q[:, others] = rest
            lengths.append(np.linalg.norm(np.diff(place(q), axis=0), axis=1).sum())
        found.append(float(np.mean(lengths)))
    return found
