# SPDX-License-Identifier: LGPL-2.1-or-later
"""docs/images/graphs.png anew: a graph of a file, layers in a tube's sector and on a wing's skin.

    .venv/bin/python tools/networks_picture.py

Needs matplotlib. Drawn as `walls_picture` does.
"""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import numpy as np
import trimesh
from walls_picture import drawn

import volfrep
from volfrep.design.cells import find_cell
from volfrep.design.graphs import GivenGraph
from volfrep.design.graphs.conformal_cells import place_cells_along
from volfrep.util.types import Floats

FILE = Path(__file__).parents[1] / "docs" / "images" / "graphs.png"


def dome(folder: Path) -> Path:
    """The edges of half a sphere in triangles, as a file."""
    ball = trimesh.creation.icosphere(3, 30.0)
    edges = ball.edges_unique[(ball.vertices[ball.edges_unique][:, :, 2] > -1e-6).all(axis=1)]
    used, rows = np.unique(edges, return_inverse=True)
    file = folder / "dome.json"
    graph = {"nodes": ball.vertices[used].tolist(), "struts": rows.reshape(-1, 2).tolist()}
    file.write_text(json.dumps(graph))
    return file


def sector() -> GivenGraph:
    """Two layers of BCC between the curved faces of a tube's sector."""

    def place(q: Floats) -> Floats:
        angle, radius = np.radians(30.0 + 120.0 * q[:, 0]), 20.0 + 10.0 * q[:, 1]
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), 30.0 * q[:, 2]], axis=1)

    return place_cells_along(find_cell("BCC"), place, (12, 2, 6), "tube sector")


def wing() -> GivenGraph:
    """One layer of FCC below the upper skin of a symmetrical wing (NACA 0012), 6 mm deep."""

    def place(q: Floats) -> Floats:
        x = 0.02 + 0.86 * q[:, 0]
        half = (
            0.6
            * 120.0
            * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4)
        )
        return np.stack([120.0 * x, 60.0 * q[:, 1], half - 6.0 + 6.0 * q[:, 2]], axis=1)

    return place_cells_along(find_cell("FCC"), place, (17, 10, 1), "wing")


def main() -> None:
    """Draw them all."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
    from PIL import Image

    with tempfile.TemporaryDirectory() as folder:
        made = {
            "The graph of a file": volfrep.mesh_network(dome(Path(folder)), strut_radius=0.5),
        }
    for title, laid in (
        ("Between the curved faces of a tube's sector", sector()),
        ("Below the skin of a wing", wing()),
    ):
        made[title] = volfrep.mesh_network((laid.nodes, laid.struts), strut_radius=0.4)
    figure, axes = pyplot.subplots(1, 3, figsize=(12.8, 4.6), dpi=100)
    for axis, (title, part) in zip(axes, made.items(), strict=True):
        print(title, part.report.bodies, part.report.genus, part.report.watertight)
        axis.imshow(np.clip(drawn(np.asarray(part.mesh.triangles)), 0.0, 1.0))
        axis.set_title(title)
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(FILE)
    Image.open(FILE).convert("RGB").quantize(32).save(FILE, optimize=True)


if __name__ == "__main__":
    main()
