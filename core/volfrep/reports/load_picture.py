# SPDX-License-Identifier: LGPL-2.1-or-later
"""A load case on its part: what is held, what is loaded, and which way it is pulled."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..loads.load_cases import Force, LoadCase, Moment, Pressure
from ..loads.nodal_loads import Body, Share, nodes_in, share_of
from ..loads.regions import Region
from ..mesh.remesh import facet_normals
from ..mesh.triangle_mesh import TriangleMesh
from ..util.types import Floats
from .picture import SIZE, add_surface, new_stage, show_stage

#: The part, what is held, what is loaded.
PART, HELD, LOADED = "#c9d0da", "#2f6fd0", "#e8792b"
#: An arrow is this part of the part's size long; facets are this much smaller.
ARROW, FACET = 0.22, 0.02
#: What is coloured lies this part of the size above the part.
ABOVE = 5e-4
_SMALL = 1e-12


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
    count = len(fine.vertices)
    body = Body(
        fine.vertices, fine.triangles.astype(np.int64), np.zeros(count), np.ones(count, bool)
    )
    add_surface(stage, solid, PART)
    for support in case.supports:
        _add_region(stage, body, fine, support.region, HELD)
    for load in case.loads:
        _add_region(stage, body, fine, load.region, LOADED)
        share = share_of(body, load.region)
        middle = share.weights @ body.nodes[share.nodes]
        if isinstance(load, Pressure):
            _add_pressure(stage, body, share, load)
        elif isinstance(load, Moment):
            _add_arrow(
                stage, body, middle, np.array(load.moment), arrow_text(load.moment, "N m", 1e-3), 2
            )
        else:
            _add_force(stage, body, middle, load)
    if any(case.acceleration):
        acceleration = np.array(case.acceleration)
        _add_arrow(
            stage,
            body,
            solid.bounds.mean(axis=0),
            acceleration,
            arrow_text(case.acceleration, "g", 1 / 9806.65),
        )
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


def _add_force(stage: Any, body: Body, middle: Floats, load: Force) -> None:
    place = middle if load.at is None else np.array(load.at)
    _add_arrow(stage, body, place, np.array(load.force), arrow_text(load.force, "N", 1.0))
    if load.at is not None and np.linalg.norm(place - middle) > 0:
        import pyvista

        stage.add_mesh(pyvista.Line(middle, place), color=LOADED, line_width=3)


def _add_pressure(stage: Any, body: Body, share: Share, load: Pressure) -> None:
    push = np.sign(load.pressure) * share.pushes
    if not push.any():
        return
    strongest = int(np.argmax(np.linalg.norm(push, axis=1)))
    _add_arrow(
        stage, body, body.nodes[share.nodes[strongest]], push[strongest],
        f"{load.pressure:.4g} MPa",
    )  # fmt: skip


def _add_arrow(
    stage: Any, body: Body, place: Floats, along: Floats, text: str, heads: int = 1
) -> None:
    """An arrow that ends at a place if it points into the part there, else begins there."""
    import pyvista

    way = along / max(float(np.linalg.norm(along)), _SMALL)
    length = ARROW * body.size
    centre = 0.5 * (body.nodes.min(axis=0) + body.nodes.max(axis=0))
    outwards = way @ (place - centre) >= -1e-3 * body.size
    start = place if outwards else place - length * way
    for head in range(heads):
        arrow = pyvista.Arrow(
            start=start, direction=way, scale=length * (1.0 - 0.22 * head), shaft_radius=0.03,
            tip_radius=0.09, tip_length=0.24,
        )  # fmt: skip
        stage.add_mesh(arrow, color=LOADED, ambient=0.3)
    tip = start + (1.15 * length if outwards else -0.12 * length) * way
    stage.add_point_labels(
        tip[None], [text], font_size=26, text_color="black", shape=None, show_points=False,
        always_visible=True, bold=False,
    )  # fmt: skip


def arrow_text(vector: Sequence[float], unit: str, scale: float) -> str:
    """What stands at an arrow: how large it is, times `scale`, in a unit."""
    size = scale * float(np.linalg.norm(vector))
    return (
        f"{size / 1000.0:.4g} k{unit}" if unit == "N" and size >= 1000.0 else f"{size:.4g} {unit}"
    )
