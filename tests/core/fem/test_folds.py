"""Facets that lie on one another are found."""

import numpy as np

from volfrep.fem.folds import folded_facets
from volfrep.mesh.triangle_mesh import TriangleMesh


def test_a_facet_that_lies_on_its_neighbour():
    corners = np.array([[0.0, 0, 0], [4, 0, 0], [2, 3, 0], [2, 1, 2.0]])
    facets = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32)
    assert not folded_facets(TriangleMesh(corners, facets)).any()
    flat = TriangleMesh(corners * (1.0, 1.0, 1e-3), facets)
    assert folded_facets(flat).all()
    # Asked of few, their neighbours are told, too.
    low = TriangleMesh(np.concatenate([flat.vertices, flat.vertices + 9.0]),
                       np.concatenate([facets, facets + 4]))  # fmt: skip
    assert folded_facets(low, np.arange(8) == 1).tolist() == [True] * 4 + [False] * 4
