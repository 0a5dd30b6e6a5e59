# SPDX-License-Identifier: LGPL-2.1-or-later
"""docs/images/walls.png anew: the library's surfaces as sheets, and a skeleton.

    .venv/bin/python tools/walls_picture.py

Needs matplotlib. Blocks are drawn by points spread over their facets, the nearest of which counts.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from volfrep import LatticeSpec
from volfrep.design.tpms import SURFACES, TpmsSheet
from volfrep.jobs.blocks import block
from volfrep.spatial.even_points import even_points
from volfrep.util.types import Floats

FILE = Path(__file__).parents[1] / "docs" / "images" / "walls.png"
PIXELS, FINER, FACET_POINTS = 320, 2, 6
VIEW = np.array([1.0, -1.5, 0.9])
LIGHT = np.array([0.3, -0.7, 0.9])
COLOUR, PAPER = np.array([0.42, 0.62, 0.88]), 1.0
SHEET, CELL = 0.9, 10.0


def drawn(corners: Floats) -> Floats:
    """(PIXELS, PIXELS, 3) picture of (m, 3, 3) facets."""
    forward = -VIEW / np.linalg.norm(VIEW)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normal, axis=1)
    facing = normal @ forward < 0.0
    corners, normal, area = corners[facing], (normal / area[:, None])[facing], area[facing]
    size = PIXELS * FINER
    seen = corners.reshape(-1, 3) @ np.stack([right, up], axis=1)
    across, high = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
    scale = 0.96 * size / np.ptp(seen, axis=0).max()
    count = np.maximum(1, (FACET_POINTS * 0.5 * area * scale**2).astype(int))
    row = np.repeat(np.arange(len(corners)), count)
    u, v = even_points(2, int(np.ceil(np.log2(len(row)))))[: len(row)].T
    u, v = np.where(u + v > 1.0, 1.0 - u, u), np.where(u + v > 1.0, 1.0 - v, v)
    a, b, c = (corners[row, k] for k in range(3))
    points = a + u[:, None] * (b - a) + v[:, None] * (c - a)
    x = np.clip((points @ right - across) * scale + size / 2, 0, size - 1).astype(int)
    y = np.clip(size / 2 - (points @ up - high) * scale, 0, size - 1).astype(int)
    depth = points @ forward
    order = np.argsort(-depth, kind="stable")  # the nearest is written last
    light = np.clip(normal @ (LIGHT / np.linalg.norm(LIGHT)), 0.0, 1.0)
    fog = 1.0 - 0.45 * (depth - depth.min()) / np.ptp(depth)
    shade = (0.35 + 0.65 * light[row]) * fog
    image = np.full((size, size, 3), PAPER)
    image[y[order], x[order]] = shade[order, None] * COLOUR
    return image.reshape(PIXELS, FINER, PIXELS, FINER, 3).mean(axis=(1, 3))


def main() -> None:
    """Draw them all."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    chosen = [(name, TpmsSheet("sheet", SHEET)) for name in SURFACES]
    chosen.append(("Gyroid", TpmsSheet("skeleton", offset=-1.0)))
    figure, axes = pyplot.subplots(2, 4, figsize=(12.8, 6.9), dpi=100)
    for axis, (name, wall) in zip(axes.ravel(), chosen, strict=True):
        mesh = block(LatticeSpec(name, CELL, wall=wall), (2, 2, 2)).mesh
        axis.imshow(np.clip(drawn(mesh.vertices[mesh.triangles]), 0.0, 1.0))
        axis.set_title(name if wall.is_sheet else f"{name}, skeleton")
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(FILE, pil_kwargs={"optimize": True})


if __name__ == "__main__":
    main()
