# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers as files: pictures for resin printers, SVG, and the common layer interface.

The common layer interface is that of the Brite-EuRam project BE 2578, version 2.0, in ASCII.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...slicing.raster import PixelGrid
from ...util.types import Floats

if TYPE_CHECKING:
    import manifold3d


def png(pixels: NDArray[np.uint8], grid: PixelGrid) -> bytes:
    """A picture of eight bits a pixel, y upwards: the share of material, 255 for all of it.

    Args:
        pixels: (rows, columns), from low y to high y.
        grid: of the pixels; their size becomes the picture's resolution.
    """
    from PIL import Image  # comes with scikit-image; slow to import

    rows, columns = pixels.shape
    picture = Image.frombytes("L", (columns, rows), pixels[::-1].tobytes())
    file = io.BytesIO()
    picture.save(file, "PNG", compress_level=3, dpi=(25.4 / grid.pixel, 25.4 / grid.pixel))
    return file.getvalue()


def svg(outline: manifold3d.CrossSection, bounds: Floats) -> bytes:
    """A layer's outlines, filled, y upwards; a unit is a mm.

    Args:
        outline: polygons without overlaps, mm.
        bounds: (2, 3) box of the part, whose lowest x and highest y are the picture's corner.
    """
    (x, _, _), (_, y, _) = bounds
    width, height = bounds[1, :2] - bounds[0, :2]
    paths = []
    for polygon in outline.to_polygons():
        corners = np.stack([polygon[:, 0] - x, y - polygon[:, 1]], axis=1)
        paths.append("M" + " ".join(f"{a:.6g},{b:.6g}" for a, b in corners.tolist()) + "Z")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.6g}mm" height="{height:.6g}mm" '
        f'viewBox="0 0 {width:.6g} {height:.6g}">\n'
        f'<path fill-rule="evenodd" d="{" ".join(paths)}"/>\n</svg>\n'
    ).encode()


def cli_header(count: int) -> bytes:
    """What a file of the common layer interface begins with; it ends with `CLI_END`."""
    return (
        "$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$VERSION/200\n$$LABEL/1,part\n"
        f"$$LAYERS/{count}\n$$HEADEREND\n$$GEOMETRYSTART\n"
    ).encode()


CLI_END = b"$$GEOMETRYEND\n"


def cli_layer(outline: manifold3d.CrossSection, top: float) -> bytes:
    """A layer of the common layer interface: closed outlines, the inner ones clockwise.

    Args:
        outline: polygons without overlaps, mm.
        top: z of the layer's upper side, mm.
    """
    lines = [f"$$LAYER/{top:.6g}"]
    for polygon in outline.to_polygons():
        closed = np.concatenate([polygon, polygon[:1]])
        x, y = closed.T
        turns = int((x[:-1] * y[1:] - x[1:] * y[:-1]).sum() > 0)
        numbers = ",".join(f"{value:.6g}" for value in closed.ravel().tolist())
        lines.append(f"$$POLYLINE/1,{turns},{len(closed)},{numbers}")
    return ("\n".join(lines) + "\n").encode()
