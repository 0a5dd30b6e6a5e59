# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams and tetrahedra as FreeCAD's finite-element meshes.

FreeCAD takes nodes and elements one by one only, a few microseconds each.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping
from dataclasses import dataclass

import Fem
import FreeCAD as App
import numpy as np
import Part
from numpy.typing import NDArray

from volfrep.fem.beam_mesh import BeamMesh
from volfrep.fem.tet_mesh import TetrahedralMesh

Ints = NDArray[np.int64]

#: Nodes or elements between two looks at the window.
AT_ONCE = 200
#: FreeCAD's order of a tetrahedron's nodes (SMESH's), from that of the solver.
_TETRAHEDRON = [1, 0, 2, 3, 4, 6, 5, 8, 7, 9]


@dataclass(frozen=True, eq=False)
class Runs:
    """Stretches of struts whose elements have one section and stiffness.

    Attributes:
        shape: compound of edges, one a run, in order.
        is_joint: (n,) bool, the stiff ends.
        section: (n,) rows of the model's radii.
    """

    shape: Part.Shape
    is_joint: NDArray[np.bool_]
    section: Ints


def beam_mesh(model: BeamMesh, sets: Mapping[str, Ints]) -> Generator[float, None, Fem.FemMesh]:
    """Three-noded edges, the model's own nodes first and numbered from 1.

    Args:
        model: the beams.
        sets: node groups by name, rows of the model's nodes.

    Yields:
        The share that is done, from time to time.
    """
    middles = model.nodes[model.elements].mean(axis=1)
    mesh = yield from _with_nodes(np.concatenate([model.nodes, middles]))
    first, count = len(model.nodes) + 1, len(model.elements)
    for number, (a, b) in enumerate((model.elements + 1).tolist(), 1):
        mesh.addEdge([a, b, first + number - 1], number)
        if number % AT_ONCE == 0:
            yield 0.5 + 0.5 * number / count
    _add_groups(mesh, sets)
    return mesh


def tetrahedral_mesh(
    filled: TetrahedralMesh, sets: Mapping[str, Ints]
) -> Generator[float, None, Fem.FemMesh]:
    """Ten-noded volumes.

    Args:
        filled: the tetrahedra.
        sets: node groups by name, rows of the nodes.

    Yields:
        The share that is done, from time to time.
    """
    mesh = yield from _with_nodes(filled.nodes)
    count = len(filled.elements)
    for number, nodes in enumerate((filled.elements[:, _TETRAHEDRON] + 1).tolist(), 1):
        mesh.addVolume(nodes, number)
        if number % AT_ONCE == 0:
            yield 0.5 + 0.5 * number / count
    _add_groups(mesh, sets)
    return mesh


def runs_of(model: BeamMesh) -> Runs:
    """The edges that the beams lie on: FreeCAD tells sections and materials by geometry."""
    kind = np.stack([model.strut, model.is_joint, model.section], axis=1)
    first = np.flatnonzero((np.diff(kind, axis=0, prepend=-1) != 0).any(axis=1))
    last = np.append(first[1:], len(kind)) - 1
    start = model.nodes[model.elements[first, 0]].tolist()
    end = model.nodes[model.elements[last, 1]].tolist()
    edges = [Part.makeLine(App.Vector(*a), App.Vector(*b)) for a, b in zip(start, end, strict=True)]
    return Runs(Part.makeCompound(edges), model.is_joint[first], model.section[first])


def points_shape(points: NDArray[np.float64]) -> Part.Shape:
    """A compound of vertices, in order."""
    return Part.makeCompound([Part.Vertex(*point) for point in points.tolist()])


def _with_nodes(places: NDArray[np.float64]) -> Generator[float, None, Fem.FemMesh]:
    mesh = Fem.FemMesh()
    for number, place in enumerate(places.tolist(), 1):
        mesh.addNode(*place, number)
        if number % AT_ONCE == 0:
            yield 0.5 * number / len(places)
    return mesh


def _add_groups(mesh: Fem.FemMesh, sets: Mapping[str, Ints]) -> None:
    for name, rows in sets.items():
        if len(rows):
            mesh.addGroupElements(mesh.addGroup(name, "Node"), (rows + 1).tolist())
