# SPDX-License-Identifier: LGPL-2.1-or-later
"""Other people's tools on the same jobs, each as its manual has it; run in .cache/bench.

    python -m bench.peers block TOOL CELL COUNT SAMPLES OUT.stl
    python -m bench.peers part CELL SAMPLES PART.stl DOMAIN.stl OUT.stl voxels|all

L = 10, r = 1. Prints one line of JSON: peak memory, seconds of the stages where they are known.
A tool that is not installed ends with a sentence and exit code 3.
"""

from __future__ import annotations

import json
import math
import sys
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np

from volfrep.design.cells import LIBRARY
from volfrep.grid.strut_graph import Graph, cell_graph
from volfrep.util.progress import peak_memory_mb

from . import published_method
from .published import RADIUS, SIZE

JOINT = published_method.sphere_radius(SIZE, RADIUS)
MISSING = 3
SIDES = 24  # of a cylinder of plane faces
#: Largest distance of a facet from the exact surface where OpenCASCADE makes the facets, mm.
DEFLECTION = 0.02

Floats = np.ndarray


def sampled_field(graph: Graph, count: int, along_cell: int) -> tuple[Floats, float, float]:
    """The distance field of the whole block, each strut in its own box; its corner and step."""
    step = SIZE / along_cell
    low = -JOINT - 2.3 * step  # no sample exactly on a surface, which would pinch it
    samples = math.ceil((count * SIZE - 2 * low) / step) + 1
    axis = (low + step * np.arange(samples)).astype(np.float32)
    field = np.full((samples,) * 3, 2 * step, np.float32)

    def lower(start: Floats, end: Floats, radius: float) -> None:
        reach = radius + 2 * step
        box = tuple(
            slice(*np.searchsorted(axis, (min(p, q) - reach, max(p, q) + reach)))
            for p, q in zip(start, end, strict=True)
        )
        x, y, z = np.meshgrid(*(axis[s] for s in box), indexing="ij", sparse=True)
        d = end - start
        length = float(d @ d)
        px, py, pz = x - start[0], y - start[1], z - start[2]
        t = np.clip((px * d[0] + py * d[1] + pz * d[2]) / length, 0, 1) if length else 0.0
        gap = np.sqrt((px - t * d[0]) ** 2 + (py - t * d[1]) ** 2 + (pz - t * d[2]) ** 2) - radius
        np.minimum(field[box], gap, out=field[box])

    for a, b in graph.struts:
        lower(graph.nodes[a], graph.nodes[b], RADIUS)
    for node in graph.nodes:
        lower(node, node, JOINT)
    return field, low, step


def skimage_block(graph: Graph, count: int, samples: int, out: Path) -> None:
    """One field for the whole block, one marching cubes, trimesh for the file."""
    import trimesh
    from skimage.measure import marching_cubes

    field, low, step = sampled_field(graph, count, samples)
    vertices, triangles, _, _ = marching_cubes(field, 0.0, spacing=(step,) * 3)
    trimesh.Trimesh(vertices + low, triangles, process=False).export(out)


def vtk_block(graph: Graph, count: int, samples: int, out: Path) -> None:
    """The same field, VTK's flying edges on all cores, VTK's STL."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
    from vtkmodules.vtkIOGeometry import vtkSTLWriter

    field, low, step = sampled_field(graph, count, samples)
    image = vtkImageData()
    image.SetDimensions(field.shape)
    image.SetOrigin(low, low, low)
    image.SetSpacing(step, step, step)
    image.GetPointData().SetScalars(numpy_to_vtk(-field.ravel(order="F")))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.ComputeNormalsOff()
    contour.ComputeGradientsOff()
    contour.SetValue(0, 0.0)
    writer = vtkSTLWriter()
    writer.SetInputConnection(contour.GetOutputPort())
    writer.SetFileTypeToBinary()
    writer.SetFileName(str(out))
    if not writer.Write():
        raise OSError(f"VTK could not write {out}")


def manifold_block(graph: Graph, count: int, samples: int, out: Path) -> None:
    """Exact Boolean union of cylinders and balls of plane faces; `samples` has no meaning here."""
    import manifold3d
    import trimesh

    parts = []
    for a, b in graph.struts:
        start, along = graph.nodes[a], graph.nodes[b] - graph.nodes[a]
        length = float(np.linalg.norm(along))
        z = along / length
        x = np.cross(z, [1.0, 0, 0] if abs(z[0]) < 0.9 else [0, 1.0, 0])
        x /= np.linalg.norm(x)
        frame = np.stack([x, np.cross(z, x), z, start], axis=1)
        rod = manifold3d.Manifold.cylinder(length, RADIUS, circular_segments=SIDES)
        parts.append(rod.transform(frame))
    ball = manifold3d.Manifold.sphere(JOINT, SIDES)
    parts += [ball.translate(node.tolist()) for node in graph.nodes]
    solid = manifold3d.Manifold.batch_boolean(parts, manifold3d.OpType.Add).to_mesh()
    trimesh.Trimesh(solid.vert_properties[:, :3], solid.tri_verts, process=False).export(out)


def microgen_block(graph: Graph, count: int, samples: int, out: Path) -> None:
    """One cell fused by OpenCASCADE and repeated, as microgen's examples do; copies stay apart."""
    import cadquery
    import microgen

    cell = first_cell(graph)
    nodes = cell.nodes - SIZE / 2  # the grid of copies is laid about the origin
    shapes = [microgen.Sphere(center=tuple(node), radius=JOINT).generate() for node in nodes]
    for a, b in cell.struts:
        start, along = nodes[a], nodes[b] - nodes[a]
        length = float(np.linalg.norm(along))
        d = along / length
        turn = (math.degrees(math.atan2(d[1], d[0])), 90.0, math.degrees(math.asin(d[2])))
        shapes.append(
            microgen.Cylinder(
                center=tuple(start + along / 2), orientation=turn, height=length, radius=RADIUS
            ).generate()
        )
    fused = microgen.fuse_shapes(shapes, retain_edges=False)
    whole = microgen.repeat_shape(fused, microgen.Rve(dim=(SIZE,) * 3), grid=(count,) * 3)
    whole = whole.translate(cadquery.Vector(*[SIZE * count / 2] * 3))
    whole.exportStl(str(out), tolerance=DEFLECTION, angularTolerance=0.5, ascii=False)


def gmsh_block(graph: Graph, count: int, samples: int, out: Path) -> None:
    """OpenCASCADE's fuse of everything through gmsh, then its mesher at L / samples."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ
    parts = [(3, occ.addSphere(*node, JOINT)) for node in graph.nodes.tolist()]
    for a, b in graph.struts:
        along = graph.nodes[b] - graph.nodes[a]
        parts.append((3, occ.addCylinder(*graph.nodes[a], *along, RADIUS)))
    occ.fuse(parts[:1], parts[1:])
    occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", SIZE / samples)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.model.mesh.generate(2)
    gmsh.write(str(out))
    gmsh.finalize()


def published_block(graph: Graph, count: int, samples: int, out: Path) -> dict[str, object]:
    """The published method; `samples` are its points along a cell."""
    cell = first_cell(graph)
    return published_method.block(cell.nodes, cell.struts, count, SIZE, RADIUS, samples, out)


def first_cell(graph: Graph) -> Graph:
    """The nodes and struts of the first cell of a block, in mm."""
    keep = (graph.nodes <= SIZE + 1e-9).all(axis=1)
    rows = np.cumsum(keep) - 1
    struts = graph.struts[keep[graph.struts].all(axis=1)]
    return Graph(graph.nodes[keep], rows[struts])


Maker = Callable[[Graph, int, int, Path], "dict[str, object] | None"]
TOOLS: dict[str, Maker] = {
    "published": published_block,
    "skimage": skimage_block,
    "vtk": vtk_block,
    "manifold": manifold_block,
    "microgen": microgen_block,
    "gmsh": gmsh_block,
}


def main() -> int:
    """Do the job that the arguments say."""
    warnings.simplefilter("ignore")  # of packages about their own dependencies
    job, *given = sys.argv[1:]
    try:
        if job == "block":
            tool, cell, count, samples, out = given
            cells = np.ones((int(count),) * 3, bool)
            graph = cell_graph(LIBRARY[cell], cells, SIZE, np.zeros(3))
            found = TOOLS[tool](graph, int(count), int(samples), Path(out)) or {}
        else:
            cell, samples, part, domain, out, voxels = given
            unit = LIBRARY[cell]
            found = published_method.fill(
                unit.nodes * SIZE, unit.struts, SIZE, RADIUS, int(samples),
                (Path(part), Path(domain), Path(out)), voxels == "voxels",
            )  # fmt: skip
    except ImportError as error:
        print(f"left out: the Python package {error.name} is not installed in .cache/bench")
        return MISSING
    print(json.dumps({**found, "peak_mb": peak_memory_mb()}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
