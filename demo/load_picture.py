# SPDX-License-Identifier: LGPL-2.1-or-later
"""A load case on its part: what is held, what is loaded, and which way it is pulled."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from volfrep.loads.load_cases import LoadCase
from volfrep.loads.nodal_loads import Body, nodes_in
from volfrep.loads.regions import Region
from volfrep.mesh.remesh import facet_normals
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.reports.load_arrows import ARROW, HELD, LOADED, Arrow, arrows_of, solid_body
from volfrep.reports.picture import SIZE, add_surface, new_stage, show_stage

PART = "#c9d0da"
#: Facets are this part of the part's size.
FACET = 0.02
#: What is coloured lies this part of the size above the part.
ABOVE = 5e-4


def load_picture(
    solid: TriangleMesh,
    case: LoadCase,
    file: str | os.PathLike[str] | None = None,
    *,
    size: tuple[int, int] = SIZE,
    y_up: bool = False,
) -> None:
    """Draw a part with the supports and loads of a case into a PNG, or show it in a window.

    Supports are blue, loads orange with an arrow and their size; a moment's arrow has two heads and
    is read by the right hand.

    Args:
        solid: the part, mm.
        case: in its coordinates.
        file: the PNG to write; None opens a window.
        size: of the picture, pixels.
        y_up: whether y is up in it, and not z.

    Raises:
        VolfrepError: pyvista is missing, the file cannot be written, or nothing of the part lies
            where the case has a support or a load.
    """
    import trimesh

    remesh: Any = trimesh.remesh
    stage = new_stage(file, size)
    diagonal = float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
    points, facets = remesh.subdivide_to_size(
        solid.vertices, solid.triangles, FACET * diagonal, max_iter=20
    )
    fine = TriangleMesh(np.asarray(points), np.asarray(facets, np.int32))
    body = solid_body(fine)
    add_surface(stage, solid, PART)
    for support in case.supports:
        _add_region(stage, body, fine, support.region, HELD)
    for load in case.loads:
        _add_region(stage, body, fine, load.region, LOADED)
    for arrow in arrows_of(body, case):
        _add_arrow(stage, body, arrow)
    stage.add_text(case.name, font_size=int(size[0] / 70), color="black")
    show_stage(stage, file, y_up=y_up, zoom=1.15)


def _add_region(stage: Any, body: Body, fine: TriangleMesh, region: Region, colour: str) -> None:
    """Its facets in a colour; where it has none, its nodes as balls."""
    import pyvista

    taken = region.facets(fine, 1e-4 * body.size)
    if taken.any():
        chosen = fine.triangles[taken]
        lifted = fine.vertices.copy()
        up = np.zeros_like(lifted)
        for corner in range(3):
            np.add.at(up, chosen[:, corner], facet_normals(fine)[taken])
        lifted += ABOVE * body.size * up / np.maximum(np.linalg.norm(up, axis=1), 1.0)[:, None]
        add_surface(stage, TriangleMesh(lifted, chosen), colour, ambient=0.45)
        return
    for node in nodes_in(body, region):
        ball = pyvista.Sphere(0.012 * body.size, center=body.nodes[node])
        stage.add_mesh(ball, color=colour, smooth_shading=True)


def _add_arrow(stage: Any, body: Body, arrow: Arrow) -> None:
    """An arrow with its text, and a line to it from the middle of what is loaded."""
    import pyvista

    if np.linalg.norm(arrow.place - arrow.middle) > 0:
        line = pyvista.Line(arrow.middle, arrow.place)
        stage.add_mesh(line, color=LOADED, line_width=3)
    start, way, outwards = arrow.drawn(body)
    length = ARROW * body.size
    for head in range(arrow.heads):
        shape = pyvista.Arrow(
            start=start, direction=way, scale=length * (1.0 - 0.22 * head), shaft_radius=0.03,
            tip_radius=0.09, tip_length=0.24,
        )  # fmt: skip
        stage.add_mesh(shape, color=LOADED, ambient=0.3)
    tip = start + (1.15 * length if outwards else -0.12 * length) * way
    stage.add_point_labels(
        tip[None], [arrow.text], font_size=26, text_color="black", shape=None, show_points=False,
        always_visible=True, bold=False,
    )  # fmt: skip
