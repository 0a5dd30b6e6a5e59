# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts coloured by values at their ends, and the legend that says what a colour means."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from volfrep.mesh.shading import shade

from . import drawing
from .prisms import CREASE_ANGLE, SIDES, prisms

#: From the smallest value to the largest: viridis, which keeps its order for all eyes and in grey
#: (S. van der Walt & N. Smith, 2015, public domain).
COLOURS = np.array(
    [
        (0.267, 0.005, 0.329), (0.283, 0.141, 0.458), (0.254, 0.265, 0.530), (0.207, 0.372, 0.553),
        (0.164, 0.471, 0.558), (0.128, 0.567, 0.551), (0.135, 0.659, 0.518), (0.267, 0.749, 0.441),
        (0.478, 0.821, 0.318), (0.741, 0.873, 0.150), (0.993, 0.906, 0.144),
    ]
)  # fmt: skip
#: Of the legend, in units of the view's height: place, size, letters.
LEFT, BOTTOM, WIDTH, HEIGHT = 0.03, 0.28, 0.03, 0.44
LETTERS = 13
#: What the legend stands on, so that it is read on any background, and how far that reaches.
GROUND, INK, GROUND_WIDTH, MARGIN = (0.13, 0.13, 0.16), (1.0, 1.0, 1.0), 0.19, 0.02
TICKS = 5
LINE_WIDTH = 3


def colours_of(values: NDArray[np.float64], low: float, high: float) -> NDArray[np.float32]:
    """(n, 3) red, green and blue from 0 to 1, of (n,) values between two ends."""
    share = np.clip((np.asarray(values, np.float64) - low) / max(high - low, 1e-300), 0.0, 1.0)
    places = np.linspace(0.0, 1.0, len(COLOURS))
    return np.stack([np.interp(share, places, COLOURS[:, k]) for k in range(3)], axis=1).astype(
        np.float32
    )


def coloured_struts(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    radii: NDArray[np.float64],
    colours: NDArray[np.float32],
    most_prisms: int,
) -> Any:
    """A separator that draws struts.

    Args:
        start: (k, 3) where they begin, mm.
        end: (k, 3) where they end.
        radii: (k, 2) mm.
        colours: (k, 2, 3) at both ends.
        most_prisms: where there are more struts, they are lines.
    """
    from pivy import coin

    if len(start) > most_prisms:
        look = coin.SoMaterial()
        binding = coin.SoMaterialBinding()
        binding.value = coin.SoMaterialBinding.PER_VERTEX_INDEXED
        coordinates = coin.SoCoordinate3()
        points = np.stack([start, end], axis=1).reshape(-1, 3).astype(np.float32)
        coordinates.point.setValues(0, len(points), points)
        look.diffuseColor.setValues(0, len(points), colours.reshape(-1, 3))
        lines = coin.SoIndexedLineSet()
        index = np.full((len(start), 3), -1)
        index[:, :2] = np.arange(2 * len(start)).reshape(-1, 2)
        lines.coordIndex.setValues(0, index.size, index.ravel().tolist())
        style = coin.SoDrawStyle()
        style.lineWidth = LINE_WIDTH
        return drawing.separate(drawing.flat_light(), style, look, binding, coordinates, lines)
    mesh = prisms(start, end, radii)
    drawn = shade(mesh, CREASE_ANGLE)
    vertex = np.empty(len(drawn.points), np.int64)
    vertex[drawn.triangles.ravel()] = mesh.triangles.ravel()
    each = np.repeat(colours.reshape(-1, 3), SIDES, axis=0)[vertex]
    index = np.full((len(mesh.triangles), 4), -1)
    index[:, :3] = drawn.triangles
    node = drawing.piece(drawn.points, drawn.normals, index)
    drawing.colour_piece(node, each)
    two_sided = coin.SoShapeHints()
    two_sided.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    return drawing.separate(two_sided, node)


def legend(title: str, low: float, high: float) -> Any:
    """A colour bar with its values at the left of the view, whatever the camera does."""
    from pivy import coin

    camera = coin.SoOrthographicCamera()
    camera.viewportMapping = coin.SoCamera.LEAVE_ALONE
    camera.position, camera.height = (0.5, 0.5, 1.0), 1.0
    camera.nearDistance, camera.farDistance = 0.5, 2.0
    steps = len(COLOURS)
    y = BOTTOM + HEIGHT * np.linspace(0.0, 1.0, steps)
    points = np.zeros((2 * steps, 3), np.float32)
    points[0::2, 0], points[1::2, 0] = LEFT, LEFT + WIDTH
    points[:, 1] = np.repeat(y, 2)
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), points)
    look = coin.SoMaterial()
    look.diffuseColor.setValues(0, 2 * steps, np.repeat(COLOURS, 2, axis=0).astype(np.float32))
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_VERTEX
    strip = coin.SoTriangleStripSet()
    strip.numVertices.setValue(2 * steps)
    bar = drawing.separate(binding, look, coordinates, strip)
    root = coin.SoAnnotation()
    for part in (drawing.unpickable(), camera, drawing.flat_light(), _ground(), bar):
        root.addChild(part)
    for k in range(TICKS):
        share = k / (TICKS - 1)
        value = low + share * (high - low)
        place = (LEFT + 1.3 * WIDTH, BOTTOM + share * HEIGHT - 0.008, 0.0)
        root.addChild(_text(f"{value:.3g}", place))
    root.addChild(_text(title, (LEFT, BOTTOM + HEIGHT + 0.03, 0.0)))
    return root


def _ground() -> Any:
    from pivy import coin

    left, right = LEFT - MARGIN, LEFT - MARGIN + GROUND_WIDTH
    low, high = BOTTOM - 2.0 * MARGIN, BOTTOM + HEIGHT + 4.0 * MARGIN
    points = np.array(
        [[left, low, -0.1], [right, low, -0.1], [right, high, -0.1], [left, high, -0.1]], np.float32
    )
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, 4, points)
    colour = coin.SoBaseColor()
    colour.rgb = GROUND
    return drawing.separate(colour, coordinates, coin.SoFaceSet())


def _text(text: str, place: tuple[float, float, float]) -> Any:
    from pivy import coin

    ink = coin.SoBaseColor()
    ink.rgb = INK
    move = coin.SoTranslation()
    move.translation = place
    font = coin.SoFont()
    font.size = LETTERS
    words = coin.SoText2()
    words.string = text
    return drawing.separate(ink, move, font, words)
