# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts in colours: their radius, stress, buckling or displacement, deformed or not."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np

from ..sizing.strut_state import QUANTITIES, StrutState, drawn_factor, value_range
from ..util.errors import VolfrepError
from ..util.types import Floats, Ints
from .picture import SIZE, new_stage, show_stage

#: Struts are tubes of so many sides.
SIDES = 10
#: The colours, which keep their order for all eyes and in grey.
COLOURS = "viridis"


def strut_picture(
    states: Sequence[StrutState],
    quantity: str,
    file: str | os.PathLike[str] | None = None,
    *,
    case: int = 0,
    deformed: bool = False,
    size: tuple[int, int] = SIZE,
    y_up: bool = False,
) -> None:
    """Draw struts in the colours of a quantity into a PNG, or show them in a window.

    Args:
        states: of all load cases, which have one scale.
        quantity: one of `volfrep.sizing.strut_state.QUANTITIES`.
        file: the PNG to write; None opens a window.
        case: which of the load cases.
        deformed: whether displacements are drawn, enlarged; the picture says how much.
        size: of the picture, pixels.
        y_up: whether y is up in it, and not z.

    Raises:
        VolfrepError: there is no such quantity, pyvista is missing, or the file cannot be written.
    """
    if quantity not in QUANTITIES:
        raise VolfrepError(
            f"Struts cannot be coloured by '{quantity}': choose {', '.join(QUANTITIES)}."
        )
    stage = new_stage(file, size)
    import pyvista

    state = states[case]
    ends, said = state.ends, state.name
    if deformed:
        factor = drawn_factor(states)
        ends, said = ends + factor * state.moved, f"{said}, {factor:g} times enlarged"
    points, facets = tubes(ends, state.radii)
    surface = pyvista.PolyData.from_regular_faces(points, facets)
    surface.point_data["value"] = np.repeat(state.values(quantity).ravel(), SIDES)
    low, high = value_range(states, quantity)
    stage.add_mesh(
        surface, scalars="value", clim=(low, high), cmap=COLOURS, ambient=0.3, diffuse=0.7,
        smooth_shading=False,
        scalar_bar_args={
            "title": QUANTITIES[quantity], "vertical": True, "position_x": 0.02,
            "position_y": 0.25, "height": 0.5, "width": 0.07, "color": "black", "fmt": "%.3g",
            "title_font_size": int(size[1] / 45), "label_font_size": int(size[1] / 50),
        },
    )  # fmt: skip
    stage.add_text(said, font_size=int(size[0] / 90), color="black")
    show_stage(stage, file, y_up=y_up, zoom=1.2)


def tubes(ends: Floats, radii: Floats) -> tuple[Floats, Ints]:
    """Open tubes in the place of struts: points, `SIDES` for each end in turn, and quads.

    Args:
        ends: (m, 2, 3) mm.
        radii: (m, 2) mm.

    Returns:
        (2 m SIDES, 3) points, and (m SIDES, 4) rows of them.
    """
    along = ends[:, 1] - ends[:, 0]
    along = along / np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
    one = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    one /= np.linalg.norm(one, axis=1)[:, None]
    two = np.cross(along, one)
    angle = 2.0 * np.pi * np.arange(SIDES) / SIDES
    out = np.cos(angle)[:, None] * one[:, None] + np.sin(angle)[:, None] * two[:, None]
    points = ends[:, :, None] + radii[:, :, None, None] * out[:, None]
    k = np.arange(SIDES)
    following = (k + 1) % SIDES
    sides = np.stack([k, following, following + SIDES, k + SIDES], axis=1)
    first = 2 * SIDES * np.arange(len(ends))
    return points.reshape(-1, 3), (first[:, None, None] + sides).reshape(-1, 4)
