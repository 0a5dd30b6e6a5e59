"""Facets that lie on one another are found, and go without a trace."""

import numpy as np
import pytest

import samples
from volfrep.fem.fins import folded_facets, without_fins
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh


def test_a_fin_without_thickness_goes():
    """Three facets about a point in their plane, but beyond an edge of the facet they stand for."""
    box = samples.box((10.0, 8.0, 6.0))
    a, b, c = box.triangles[0]
    ends = box.vertices[[a, b, c]]
    lengths = np.linalg.norm(ends - np.roll(ends, -1, axis=0), axis=1)
    # Beyond a side of the box, not its diagonal.
    far = (int(lengths.argmin()) + 2) % 3
    tip = 0.6 * (ends[(far + 1) % 3] + ends[(far + 2) % 3]) - 0.2 * ends[far]
    new = len(box.vertices)
    facets = np.concatenate([box.triangles[1:], [[a, b, new], [b, c, new], [c, a, new]]])
    mesh = TriangleMesh(np.vstack([box.vertices, tip]), facets.astype(np.int32))
    folded = np.zeros(len(facets), bool)
    assert without_fins(mesh, folded) is mesh
    folded[-3:] = True
    better = without_fins(mesh, folded)
    assert len(better.triangles) == 12
    assert len(better.vertices) == 8
    assert better.volume == pytest.approx(480.0)
    assert measure(better).watertight
    # Of a tetrahedron every corner has three facets, and none can go.
    corners = np.vstack([np.zeros(3), np.eye(3)])
    four = TriangleMesh(corners, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32))
    assert without_fins(four, np.ones(4, bool)) is four


def test_a_facet_that_lies_on_its_neighbour():
    corners = np.array([[0.0, 0, 0], [4, 0, 0], [2, 3, 0], [2, 1, 2.0]])
    facets = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32)
    assert not folded_facets(TriangleMesh(corners, facets)).any()
    assert folded_facets(TriangleMesh(corners * (1.0, 1.0, 1e-3), facets)).all()
