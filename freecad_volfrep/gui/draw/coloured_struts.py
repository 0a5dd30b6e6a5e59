# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts coloured by values at their ends, and the legend that says what a colour means."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np
from numpy.typing import NDArray

from freecad_volfrep.translation import figure
from volfrep.mesh.shading import shade
from volfrep.util.numbers import round_values

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
#: Of the legend, in units of the view's height: place, size.
LEFT, BOTTOM, WIDTH, HEIGHT = 0.03, 0.28, 0.018, 0.44
#: Of names there are at most about so many.
MOST_LINES = 12
#: Its letters, which are of the system's own font, and its numbers, which are round but for both
#: ends; a round one nearer to an end than this share of all would lie over it.
FONT, LETTERS, TICKS, DIGITS, NEAR = "Sans", 13, 5, 3, 0.07
#: The name of what colours them.
INK = "VolfrepInk"
#: A background is light from this on, of 1.
LIGHT = 0.5
LINE_WIDTH = 3
#: Of the scale bar, in shares of the view: where it is, its longest, the height of its ends.
BAR_LEFT, BAR_BOTTOM, BAR_LONGEST, BAR_ENDS = 0.03, 0.06, 0.2, 0.008


def colours_of(values: NDArray[np.float64], low: float, high: float) -> NDArray[np.float32]:
    """(n, 3) red, green and blue from 0 to 1, of (n,) values between two ends."""
    share = np.clip((np.asarray(values, np.float64) - low) / max(high - low, 1e-300), 0.0, 1.0)
    places = np.linspace(0.0, 1.0, len(COLOURS))
    return np.stack([np.interp(share, places, COLOURS[:, k]) for k in range(3)], axis=1).astype(
        np.float32
    )


def row_colours(rows: NDArray[np.float64]) -> NDArray[np.float32]:
    """(n, 3) red, green and blue from 0 to 1, of (n,) rows of names."""
    from volfrep.sizing.limit_colours import limit_colours

    return limit_colours(rows).astype(np.float32)


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

    colours = COLOURS if high > low else COLOURS[[0, 0]]
    steps = len(colours)
    y = BOTTOM + HEIGHT * np.linspace(0.0, 1.0, steps)
    points = np.zeros((2 * steps, 3), np.float32)
    points[0::2, 0], points[1::2, 0] = LEFT, LEFT + WIDTH
    points[:, 1] = np.repeat(y, 2)
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), points)
    look = coin.SoMaterial()
    look.diffuseColor.setValues(0, 2 * steps, np.repeat(colours, 2, axis=0).astype(np.float32))
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_VERTEX
    strip = coin.SoTriangleStripSet()
    strip.numVertices.setValue(2 * steps)
    bar = drawing.separate(binding, look, coordinates, strip)
    root = _flat(bar)
    for share, text in ticks(low, high):
        root.addChild(_text(text, (LEFT + 1.5 * WIDTH, BOTTOM + share * HEIGHT - 0.008, 0.0)))
    root.addChild(_text(title, (LEFT, BOTTOM + HEIGHT + 0.03, 0.0)))
    return root


def ticks(low: float, high: float) -> list[tuple[float, str]]:
    """The numbers beside a scale and where they are, from 0 to 1: of a constant there is one."""
    if high <= low:
        return [(0.5, figure(low, DIGITS))]
    between = round_values(low, high, TICKS - 1)
    shares = [(value - low) / (high - low) for value in between]
    kept = [value for value, at in zip(between, shares, strict=True) if NEAR <= at <= 1.0 - NEAR]
    values = [low, *kept, high]
    # As many digits as tell neighbours apart.
    apart = min(b - a for a, b in pairwise(values))
    digits = max(DIGITS, 1 + math.ceil(math.log10(max(abs(low), abs(high)) / apart)))
    return [((value - low) / (high - low), figure(value, digits)) for value in values]


def legend_of_names(title: str, names: Sequence[str]) -> Any:
    """A field of colour and a text for each name, the first on top, at the left of the view."""
    from pivy import coin

    line = HEIGHT / MOST_LINES
    bottom = BOTTOM + HEIGHT - line * np.arange(1, len(names) + 1)
    points = np.zeros((len(names), 4, 3), np.float32)
    points[:, :, 0] = LEFT + WIDTH * np.array([0, 1, 1, 0])
    points[:, :, 1] = bottom[:, None] + 0.7 * line * np.array([0, 0, 1, 1])
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, 4 * len(names), points.reshape(-1, 3))
    look = coin.SoMaterial()
    look.diffuseColor.setValues(0, len(names), row_colours(np.arange(len(names))))
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_FACE
    fields = coin.SoFaceSet()
    fields.numVertices.setValues(0, len(names), [4] * len(names))
    root = _flat(drawing.separate(binding, look, coordinates, fields))
    for name, height in zip(names, bottom.tolist(), strict=True):
        root.addChild(_text(name, (LEFT + 1.5 * WIDTH, height + 0.15 * line, 0.0)))
    root.addChild(_text(title, (LEFT, BOTTOM + HEIGHT + 0.03, 0.0)))
    return root


def save_picture(view: Any, path: str) -> None:
    """Save what a 3D view shows as a picture on white, with letters in black and a scale bar.

    In perspective there is no one scale, and no bar.
    """
    from pivy import coin

    scene, bar = view.getSceneGraph(), scale_bar(view)
    if bar is not None:
        scene.addChild(bar)
    search = coin.SoSearchAction()
    search.setName(INK)
    search.setInterest(coin.SoSearchAction.ALL)
    search.apply(view.getSceneGraph())
    paths = search.getPaths()
    inks = [paths[k].getTail() for k in range(paths.getLength())]
    for ink in inks:
        ink.rgb = (0.0, 0.0, 0.0)
    try:
        view.saveImage(path, *view.getSize(), "White")
    finally:
        for ink in inks:
            ink.rgb = _ink()
        if bar is not None:
            scene.removeChild(bar)


def scale_bar(view: Any) -> Any:
    """A line of a round length in mm, which it tells; None in perspective."""
    from pivy import coin

    camera = view.getCameraNode()
    if not camera.isOfType(coin.SoOrthographicCamera.getClassTypeId()):
        return None
    wide, high = view.getSize()
    # Coin fits the camera's height into the shorter side.
    across = camera.height.getValue() * wide / min(wide, high)
    longest = BAR_LONGEST * across
    decade = 10.0 ** np.floor(np.log10(longest))
    length = decade * max(step for step in (1.0, 2.0, 5.0) if step * decade <= longest)
    x, y = (BAR_LEFT, BAR_LEFT + length / across), BAR_BOTTOM
    ends = (y - BAR_ENDS, y + BAR_ENDS)
    points = [
        (x[0], ends[0], 0.0), (x[0], ends[1], 0.0), (x[0], y, 0.0),
        (x[1], y, 0.0), (x[1], ends[1], 0.0), (x[1], ends[0], 0.0),
    ]  # fmt: skip
    coordinates, line, style = coin.SoCoordinate3(), coin.SoLineSet(), coin.SoDrawStyle()
    coordinates.point.setValues(0, len(points), points)
    line.numVertices.setValue(len(points))
    style.lineWidth = LINE_WIDTH
    ink = coin.SoBaseColor()
    ink.setName(INK)
    root = _flat(drawing.separate(ink, style, coordinates, line))
    root.addChild(_text(f"{figure(length)} mm", (x[0], y + 2.0 * BAR_ENDS, 0.0)))
    return root


def _flat(drawn: Any) -> Any:
    """What is drawn before all else, in shares of the view, whatever its own camera does."""
    from pivy import coin

    root = coin.SoAnnotation()
    camera = coin.SoOrthographicCamera()
    camera.viewportMapping = coin.SoCamera.LEAVE_ALONE
    camera.position, camera.height = (0.5, 0.5, 1.0), 1.0
    camera.nearDistance, camera.farDistance = 0.5, 2.0
    for part in (drawing.unpickable(), camera, drawing.flat_light(), drawn):
        root.addChild(part)
    return root


def _text(text: str, place: tuple[float, float, float]) -> Any:
    from pivy import coin

    ink = coin.SoBaseColor()
    ink.setName(INK)
    ink.rgb = _ink()
    move = coin.SoTranslation()
    move.translation = place
    font = coin.SoFont()
    # Coin counts the screen's own pixels.
    font.name, font.size = FONT, LETTERS * Gui.getMainWindow().devicePixelRatioF()
    words = coin.SoText2()
    words.string = text
    return drawing.separate(ink, move, font, words)


def _ink() -> tuple[float, float, float]:
    """Black or white, whichever is read on the background that the user has chosen for views."""
    view = App.ParamGet("User parameter:BaseApp/Preferences/View")
    names = ["BackgroundColor"]
    if view.GetBool("Gradient", True) or view.GetBool("RadialGradient", False):
        names = ["BackgroundColor2", "BackgroundColor3"]
    first = {"BackgroundColor2": 0x333365FF, "BackgroundColor3": 0xADADCCFF}
    packed = [view.GetUnsigned(name, first.get(name, 0x333365FF)) for name in names]
    channels = [(colour >> shift & 255) / 255 for colour in packed for shift in (24, 16, 8)]
    return (0.0,) * 3 if np.mean(channels) > LIGHT else (1.0,) * 3
