# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells by rules: struts along or within the bodies that fill space about points that repeat.

The bodies are the points' Voronoi cells (G. Voronoi, J. reine angew. Math. 133, 1908): cubes about
the points of a simple cubic lattice, truncated octahedra about those of a body-centred one,
rhombic dodecahedra of a face-centred one. A rule says which of their corners, centres and faces'
centres struts join. What reaches out of the cell's box is cut at its faces, behind which the next
cell goes on.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial import Voronoi

from ...util.errors import VolfrepError
from ...util.types import Floats, Ints

#: What may be joined, in the order of the documentation.
RULES = {
    "edges": "along the bodies' edges",
    "centre to corners": "from a body's centre to its corners",
    "centre to faces": "from a body's centre to the middles of its faces",
    "faces to corners": "from the middle of a face to its corners",
    "duals": "from a body's centre to those of its neighbours",
}
#: Points about which bodies of known names lie, in units of the box's edges.
TESSELLATIONS = {
    "cubes": [[0.5, 0.5, 0.5]],
    "truncated octahedra": [[0, 0, 0], [0.5, 0.5, 0.5]],
    "rhombic dodecahedra": [[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]],
    "hexagonal prisms": [[0, 0, 0.5], [0.5, 0.5, 0.5]],
}
#: Places nearer than this, in units of L, are one; so short a piece is none.
SAME = 1e-7


def tessellate(data: Any, edges: tuple[float, float, float], where: str) -> tuple[Floats, Ints]:
    """The nodes and struts of a cell by rules.

    Args:
        data: ``{"about": (n, 3) points, "rules": ["edges", …]}``; ``about`` may name one of
            `TESSELLATIONS`, and points are in units of the box's edges.
        edges: of the box, in units of L.
        where: the file, in errors.

    Returns:
        nodes (n, 3) in units of the box's edges, from 0 to 1, and struts (m, 2).

    Raises:
        VolfrepError: naming what is wrong, or what rules there are.

    >>> nodes, struts = tessellate({"about": "cubes", "rules": ["duals"]}, (1.0, 1.0, 1.0), "cell")
    >>> len(nodes), len(struts)  # the Cross
    (7, 6)
    """
    if not isinstance(data, dict) or not {"about", "rules"} <= data.keys():
        raise VolfrepError(
            f"In the {where}, 'tessellation' must be an object with 'about' and 'rules'."
        )
    about, rules = data["about"], data["rules"]
    if isinstance(about, str):
        if about not in TESSELLATIONS:
            raise VolfrepError(
                f"In the {where}, there is no tessellation '{about}': choose one of "
                f"{', '.join(TESSELLATIONS)}, or give points."
            )
        about = TESSELLATIONS[about]
    if not isinstance(rules, list) or not rules or not all(rule in RULES for rule in rules):
        raise VolfrepError(f"In the {where}, 'rules' must be a list of some of {', '.join(RULES)}.")
    points = np.asarray(about, float) % 1.0
    segments = _segments(points, np.array(edges), set(rules))
    return _in_box(segments / np.array(edges))


def _segments(points: Floats, edges: Floats, rules: set[str]) -> Floats:
    """(m, 2, 3) what the rules join, of the bodies in and about one box, in units of L."""
    steps = np.arange(-2, 3)
    shifts = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    all_points = ((points[None] + shifts[:, None]) * edges).reshape(-1, 3)
    near = np.repeat((np.abs(shifts) <= 1).all(axis=1), len(points))
    found = Voronoi(all_points)
    joined = [np.zeros((0, 2, 3))]
    for (one, two), ridge in zip(found.ridge_points, found.ridge_vertices, strict=True):
        if not (near[one] or near[two]) or -1 in ridge:
            continue
        corners = _without_repeats(found.vertices[ridge])
        if len(corners) < 3:
            continue  # bodies that only touch along an edge or at a corner
        middle = _middle(corners)
        following = np.roll(corners, -1, axis=0)
        ends = all_points[[one, two]]
        if "edges" in rules:
            joined.append(np.stack([corners, following], axis=1))
        if "faces to corners" in rules:
            joined.append(_spokes(middle, corners))
        if "centre to faces" in rules:
            joined.append(_spokes(middle, ends))
        if "duals" in rules:
            joined.append(ends[None])
        if "centre to corners" in rules:
            joined += [_spokes(ends[0], corners), _spokes(ends[1], corners)]
    return np.concatenate(joined)


def _without_repeats(corners: Floats) -> Floats:
    """A face's corners in turn, each once: where four bodies or more meet some come twice."""
    gap = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)
    return np.asarray(corners[gap > SAME])


def _middle(corners: Floats) -> Floats:
    """The centre of area of a flat face."""
    first, second = corners[1:-1] - corners[0], corners[2:] - corners[0]
    area = np.linalg.norm(np.cross(first, second), axis=1)
    centres = corners[0] + (first + second) / 3.0
    result: Floats = (centres * area[:, None]).sum(axis=0) / area.sum()
    return result


def _spokes(hub: Floats, ends: Floats) -> Floats:
    return np.stack([np.broadcast_to(hub, ends.shape), ends], axis=1)


def _in_box(segments: Floats) -> tuple[Floats, Ints]:
    """What of segments lies in the unit box, as nodes and struts."""
    start, way = segments[:, 0], segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        to_low, to_high = (0.0 - start) / way, (1.0 - start) / way
    flat = np.abs(way) < SAME
    outside = (flat & ((start < -SAME) | (start > 1.0 + SAME))).any(axis=1)
    enter = np.where(flat, 0.0, np.minimum(to_low, to_high)).max(axis=1).clip(0.0)
    leave = np.where(flat, 1.0, np.maximum(to_low, to_high)).min(axis=1).clip(max=1.0)
    kept = ~outside & ((leave - enter) * np.linalg.norm(way, axis=1) > SAME)
    pieces = (
        start[kept, None] + np.stack([enter, leave], axis=1)[kept][:, :, None] * way[kept, None]
    )
    ends = np.round(pieces.reshape(-1, 3).clip(0.0, 1.0), 9) + 0.0
    _, first, row = np.unique(np.round(ends / SAME), axis=0, return_index=True, return_inverse=True)
    struts = np.unique(np.sort(row.reshape(-1, 2), axis=1), axis=0)
    return ends[first], struts
