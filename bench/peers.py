# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other people's tools on the same block, each as one would use it at first.

``python bench/peers.py skimage|manifold CELL COUNT OUT.stl``: L = 10, r = 1. Exit code 3 and a
sentence when the tool is not installed.
"""

from __future__ import annotations

import importlib
import sys
from typing import Any

import numpy as np

from volfrep.cells import LIBRARY
from volfrep.wireframe import cell_graph

SIZE, RADIUS = 10.0, 1.0
JOINT = RADIUS * (1 + RADIUS / SIZE)
SAMPLES_ALONG_CELL = 15  # about the published file sizes
SIDES = 24


def skimage_block(nodes: np.ndarray, struts: np.ndarray, count: int) -> Any:
    """One sampled field for the whole block, one marching cubes, trimesh for the file."""
    import trimesh
    from skimage.measure import marching_cubes

    step = SIZE / SAMPLES_ALONG_CELL
    low = -JOINT - 2 * step
    samples = int(np.ceil((count * SIZE - 2 * low) / step)) + 1
    axis = (low + step * np.arange(samples)).astype(np.float32)
    field = np.full((samples,) * 3, 2 * step, np.float32)

    def lower(start: np.ndarray, end: np.ndarray, radius: float) -> None:
        box = [
            slice(
                *np.searchsorted(
                    axis, (min(p, q) - radius - 2 * step, max(p, q) + radius + 2 * step)
                )
            )
            for p, q in zip(start, end, strict=True)
        ]
        x, y, z = np.meshgrid(*(axis[s] for s in box), indexing="ij", sparse=True)
        d = end - start
        length = float(d @ d)
        px, py, pz = x - start[0], y - start[1], z - start[2]
        t = np.clip((px * d[0] + py * d[1] + pz * d[2]) / length, 0, 1) if length else 0.0
        gap = np.sqrt((px - t * d[0]) ** 2 + (py - t * d[1]) ** 2 + (pz - t * d[2]) ** 2) - radius
        np.minimum(field[tuple(box)], gap, out=field[tuple(box)])

    for a, b in struts:
        lower(nodes[a], nodes[b], RADIUS)
    for node in nodes:
        lower(node, node, JOINT)
    vertices, triangles, _, _ = marching_cubes(field, 0.0, spacing=(step,) * 3)
    mesh = trimesh.Trimesh(vertices + low, triangles[:, ::-1], process=False)
    if mesh.volume < 0:
        mesh.invert()
    return mesh


def manifold_block(nodes: np.ndarray, struts: np.ndarray, count: int) -> Any:
    """Exact Boolean union of polygonal cylinders and balls."""
    import manifold3d
    import trimesh

    parts = []
    for a, b in struts:
        start, along = nodes[a], nodes[b] - nodes[a]
        length = float(np.linalg.norm(along))
        z = along / length
        x = np.cross(z, [1.0, 0, 0] if abs(z[0]) < 0.9 else [0, 1.0, 0])
        x /= np.linalg.norm(x)
        frame = np.stack([x, np.cross(z, x), z, start], axis=1)
        rod = manifold3d.Manifold.cylinder(length, RADIUS, circular_segments=SIDES)
        parts.append(rod.transform(frame))
    ball = manifold3d.Manifold.sphere(JOINT, SIDES)
    parts += [ball.translate(node.tolist()) for node in nodes]
    solid = manifold3d.Manifold.batch_boolean(parts, manifold3d.OpType.Add).to_mesh()
    return trimesh.Trimesh(solid.vert_properties[:, :3], solid.tri_verts, process=False)


PEERS = {
    "skimage": (skimage_block, ("skimage", "trimesh")),
    "manifold": (manifold_block, ("manifold3d", "trimesh")),
}


def main() -> int:
    name, cell, count, out = sys.argv[1:]
    build, needed = PEERS[name]
    for module in needed:
        try:
            importlib.import_module(module)
        except ImportError:
            print(f"The Python package {module} is not installed: {name} is left out.")
            return 3
    graph = cell_graph(LIBRARY[cell], np.ones((int(count),) * 3, bool), SIZE, np.zeros(3))
    build(graph.nodes, graph.struts, int(count)).export(out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
