# SPDX-License-Identifier: LGPL-2.1-or-later
"""How near struts that do not meet come to each other."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree

from ..design.cells import UnitCell
from ..grid.strut_graph import Wireframe, cell_graph
from ..util.types import Floats, Ints

#: Pieces that struts are searched by: short ones lie near to fewer others than whole struts do.
PIECES = 4
#: Struts whose pairs are looked at in one step (bounds the memory).
STRUTS_PER_STEP = 4096
#: Gaps of an endless lattice are looked for up to so many times L.
WIDEST_GAP = 0.3


def narrowest_gap(lattice: Wireframe, among: Ints, widest: float) -> tuple[float, Floats] | None:
    """The smallest gap between two of the struts that have no node in common, and where it is.

    Struts that overlap leave no gap.

    Args:
        lattice: nodes and struts, mm.
        among: rows of its struts.
        widest: gaps above this, in mm, are not looked for.

    Returns:
        The gap in mm and (3,) its middle, or None where there is none.
    """
    if len(among) < 2:
        return None
    ends = lattice.nodes[lattice.struts[among]]
    pieces = (np.arange(PIECES) + 0.5) / PIECES
    middle = ends[:, :1] + pieces[:, None] * (ends[:, 1:] - ends[:, :1])
    middle = middle.reshape(-1, 3)
    longest = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max())
    thickest = max(float(lattice.radii[among].max()), float(lattice.joint_radii.max()))
    reach = longest / PIECES + 2.0 * thickest + widest
    tree = cKDTree(middle)
    best, place = widest, None
    for start in range(0, len(middle), PIECES * STRUTS_PER_STEP):
        some = cKDTree(middle[start : start + PIECES * STRUTS_PER_STEP])
        near = some.sparse_distance_matrix(tree, reach, output_type="ndarray")
        one, two = (near["i"] + start) // PIECES, near["j"] // PIECES
        pair = np.unique((one * len(among) + two)[one < two])
        one, two = among[pair // len(among)], among[pair % len(among)]
        apart = (lattice.struts[one][:, :, None] != lattice.struts[two][:, None]).all(axis=(1, 2))
        gap, at = _gaps(lattice, one[apart], two[apart])
        gap[gap <= 0] = np.inf
        if len(gap) and gap.min() < best:
            best, place = float(gap.min()), at[gap.argmin()]
    return None if place is None else (best, place)


@lru_cache(maxsize=64)
def endless_gap(cell: UnitCell, ratio: float) -> float | None:
    """The narrowest gap of an endless lattice, in units of L; None above `WIDEST_GAP`.

    Args:
        cell: the unit cell.
        ratio: radius of the struts over L.

    >>> from volfrep.design.cells import find_cell
    >>> round(endless_gap(find_cell("Cross"), 0.1), 3)  # between the joint spheres of neighbours
    0.28
    """
    # What is nearer than half a cell lies in two neighbours.
    graph = cell_graph(cell, np.ones((2, 2, 2), bool), 1.0, np.zeros(3))
    radii = np.full((len(graph.struts), 2), ratio)
    joints = np.full(len(graph.nodes), ratio * (1.0 + ratio))
    lattice = Wireframe(graph.nodes, graph.struts, radii, joints)
    found = narrowest_gap(lattice, np.arange(len(graph.struts)), WIDEST_GAP)
    return None if found is None else found[0]


def _gaps(lattice: Wireframe, one: Ints, two: Ints) -> tuple[Floats, Floats]:
    """(n,) gaps between pairs of struts with their joints' balls, and (n, 3) where they are.

    The shortest way between two segments begins at an end of one of them, or is square to both.
    """
    p, q = (lattice.nodes[lattice.struts[rows]] for rows in (one, two))
    gap, at = _square_gaps(lattice, one, two, p, q)
    for ends, strut, other, rows in ((p, one, q, two), (q, two, p, one)):
        for k in range(2):
            point = ends[:, k]
            along = other[:, 1] - other[:, 0]
            share = np.einsum("ij,ij->i", point - other[:, 0], along)
            share = np.clip(share / np.einsum("ij,ij->i", along, along), 0.0, 1.0)
            foot = other[:, 0] + share[:, None] * along
            width = np.linalg.norm(point - foot, axis=1)
            width -= lattice.joint_radii[lattice.struts[strut, k]]
            joint = lattice.joint_radii[lattice.struts[rows, (share > 0.5).astype(int)]]
            at_joint = (share == 0.0) | (share == 1.0)
            width -= np.where(at_joint, joint, _radius(lattice, rows, share))
            nearer = width < gap
            gap[nearer] = width[nearer]
            at[nearer] = 0.5 * (point + foot)[nearer]
    return gap, at


def _square_gaps(
    lattice: Wireframe, one: Ints, two: Ints, p: Floats, q: Floats
) -> tuple[Floats, Floats]:
    """The gaps along the common perpendiculars that meet both axes; infinite for the others."""
    u, v, w = p[:, 1] - p[:, 0], q[:, 1] - q[:, 0], p[:, 0] - q[:, 0]
    uu, uv, vv, uw, vw = (np.einsum("ij,ij->i", x, y) for x, y in
                          ((u, u), (u, v), (v, v), (u, w), (v, w)))  # fmt: skip
    determinant = uu * vv - uv * uv
    crossing = determinant > 1e-12 * uu * vv
    determinant[~crossing] = 1.0
    s, t = (uv * vw - vv * uw) / determinant, (uu * vw - uv * uw) / determinant
    crossing &= (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    a, b = p[:, 0] + s[:, None] * u, q[:, 0] + t[:, None] * v
    gap = np.linalg.norm(a - b, axis=1) - _radius(lattice, one, s) - _radius(lattice, two, t)
    return np.where(crossing, gap, np.inf), 0.5 * (a + b)


def _radius(lattice: Wireframe, rows: Ints, share: Floats) -> Floats:
    start, end = lattice.radii[rows].T
    result: Floats = start + share * (end - start)
    return result
