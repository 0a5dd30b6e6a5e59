# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sized lattice in colour: by radius, stress and the like, or what governs; deformed or not."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..sizing.analysis import Analysis
from ..sizing.limit_colours import limit_colour
from ..sizing.model import SizingModel
from ..util.errors import VolfrepError
from ..util.linalg import axes_across
from ..util.types import Floats, Ints
from .picture import SIZE, new_stage, show_stage

#: What the colour tells, and the legend's title.
COLOURS = {
    "radius": "radius, mm",
    "stress": "von Mises stress, MPa",
    "buckling": "share of the buckling load",
    "displacement": "displacement, mm",
    "skin": "thickness of the skin, mm",
    "governing": "governing limit",
}
#: Sides of a drawn strut, and rings along it.
_SIDES, _RINGS = 10, 5
_COLOURS = "turbo"
_SKIN = "#c9d0da"


def sizing_picture(
    model: SizingModel,
    analysis: Analysis,
    file: str | os.PathLike[str] | None = None,
    *,
    colour: str = "radius",
    case: int = 0,
    deformed: float = 0.0,
    size: tuple[int, int] = SIZE,
    y_up: bool = False,
    scale: tuple[float, float] | None = None,
    governing: tuple[Ints, Sequence[str]] | None = None,
) -> None:
    """Draw the struts of a design into a PNG, or show them in a window; a skin is transparent.

    In the colour ``skin`` it is not, and hides the struts.

    Args:
        model: what was solved.
        analysis: the design.
        file: the PNG to write; None opens a window.
        colour: one of `COLOURS`.
        case: the number of the load case.
        deformed: how many times as large displacements are drawn; 0 for none.
        size: of the picture, pixels.
        y_up: whether y is up in it, and not z.
        scale: the values at the ends of the colours, so that pictures compare; None for the
            least and the largest that there are.
        governing: of each strut the row of what governs it, and the names; for that colour.

    Raises:
        VolfrepError: pyvista is missing, the file cannot be written, or there is no skin to colour.
    """
    if colour == "skin" and model.skin is None:
        raise VolfrepError("The part has no skin to show in colours: choose another colour.")
    stage = new_stage(file, size)
    import pyvista

    problem = model.problem
    struts = problem.structure.beams.struts
    nodes = problem.structure.nodes + deformed * analysis.displacements[:, :3, case]
    of_struts = problem.radii.of_struts(analysis.radii)
    if colour == "skin" and model.skin is not None:
        shift = deformed * analysis.displacements[model.frame_nodes :, :3, case]
        shells = model.skin.shells
        surface = pyvista.PolyData.from_regular_faces(
            model.skin.outside.vertices + shift, shells.triangles
        )
        surface.cell_data[COLOURS[colour]] = shells.thickness
    else:
        if colour == "governing":
            assert governing is not None
            values = np.repeat(governing[0][:, None], 2, axis=1).astype(np.float64)
        else:
            values = _values(model, analysis, colour, case, of_struts)
        points, facets, shades = tubes(nodes, struts, of_struts, values)
        surface = pyvista.PolyData.from_regular_faces(points, facets)
        surface.point_data[COLOURS[colour]] = shades
    bar: dict[str, Any] = {"n_labels": 5, "fmt": "%.3g"}
    colours: dict[str, Any] = {"cmap": _COLOURS, "clim": scale}
    if colour == "governing" and governing is not None:
        count = len(governing[1])
        colours = {
            "cmap": [limit_colour(k) for k in range(count)], "clim": (-0.5, count - 0.5),
            "n_colors": count, "annotations": dict(enumerate(governing[1])),
        }  # fmt: skip
        bar = {"n_labels": 0}
    stage.add_mesh(
        surface, scalars=COLOURS[colour], smooth_shading=True, ambient=0.35, diffuse=0.65,
        **colours, scalar_bar_args={
            "title": COLOURS[colour], "color": "black", "vertical": True,
            "position_x": 0.88, "position_y": 0.25, "height": 0.5, **bar,
        },
    )  # fmt: skip
    if model.skin is not None and colour != "skin":
        shift = deformed * analysis.displacements[model.frame_nodes :, :3, case]
        outside = model.skin.outside
        skin = pyvista.PolyData.from_regular_faces(outside.vertices + shift, outside.triangles)
        stage.add_mesh(skin, color=_SKIN, opacity=0.15)
    show_stage(stage, file, y_up=y_up, zoom=1.25)


def _values(
    model: SizingModel, analysis: Analysis, colour: str, case: int, of_struts: Floats
) -> Floats:
    """(m, 2) what the colour tells at both ends of every strut."""
    if colour == "radius":
        return of_struts
    if colour == "stress":
        return analysis.stress[:, :, case]
    if colour == "buckling":
        return np.repeat(analysis.buckling[:, case, None], 2, axis=1)
    length = np.linalg.norm(analysis.displacements[:, :3, case], axis=1)
    return np.asarray(length[model.problem.structure.beams.struts])


def tubes(
    nodes: Floats, struts: Ints, radii: Floats, values: Floats
) -> tuple[Floats, Ints, Floats]:
    """Struts as open cones of triangles, with a value at every point.

    Args:
        nodes: (n, 3) mm.
        struts: (m, 2) rows of `nodes`.
        radii: (m, 2) mm.
        values: (m, 2) at their ends.

    Returns:
        (p, 3) points, (q, 3) triangles, (p,) values.
    """
    start, end = nodes[struts[:, 0]], nodes[struts[:, 1]]
    along = end - start
    along /= np.linalg.norm(along, axis=1)[:, None]
    aside, other = axes_across(along)
    share = np.linspace(0.0, 1.0, _RINGS)[None, :, None]
    angle = np.linspace(0.0, 2.0 * np.pi, _SIDES, endpoint=False)
    round_it = (
        np.cos(angle)[None, :, None] * aside[:, None]
        + np.sin(angle)[None, :, None] * other[:, None]
    )
    middle = start[:, None] * (1.0 - share) + end[:, None] * share
    radius = radii[:, :1] * (1.0 - share[:, :, 0]) + radii[:, 1:] * share[:, :, 0]
    points = middle[:, :, None] + radius[:, :, None, None] * round_it[:, None]
    ring, side = np.meshgrid(np.arange(_RINGS - 1), np.arange(_SIDES), indexing="ij")
    a = (ring * _SIDES + side).ravel()
    b = (ring * _SIDES + (side + 1) % _SIDES).ravel()
    pattern = np.concatenate(
        [np.stack([a, b, b + _SIDES], axis=1), np.stack([a, b + _SIDES, a + _SIDES], axis=1)]
    )
    first = np.arange(len(struts)) * _RINGS * _SIDES
    facets = (first[:, None, None] + pattern).reshape(-1, 3)
    shown = values[:, :1] * (1.0 - share[:, :, 0]) + values[:, 1:] * share[:, :, 0]
    shades = np.repeat(shown[:, :, None], _SIDES, axis=2)
    return points.reshape(-1, 3), facets, shades.ravel()
