# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is proved on the octants is what is measured on the triangles."""

from dataclasses import replace

import numpy as np
import pytest

from volfrep.design.cells import LIBRARY, PAPERS, find_cell, make_cell
from volfrep.lattice.assembly import lay, lay_out
from volfrep.lattice.certificate import agree_on_faces, certify
from volfrep.mesh import quality
from volfrep.octants.octant import octant_grid
from volfrep.octants.octant_mesh import mesh_octants
from volfrep.octants.octant_spec import OctantSpec
from volfrep.util.progress import Monitor

SKEW = make_cell("skew", [[0, 0, 0], [1, 1, 1], [0.3, 0.6, 0.45]], [[0, 2], [2, 1]])

#: Its octants are no mirror images of each other, and round what they compute otherwise.
TANGLED = make_cell(
    "tangled",
    [
        [0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [1, 1, 0], [1, 1, 1],
        [0.372, 0.298, 0.676], [0.315, 0.656, 0.357], [0.506, 0.325, 0.39],
    ],
    [[0, 1], [0, 2], [0, 3], [0, 6], [1, 7], [2, 7], [3, 6], [4, 8], [5, 6], [5, 8]],
)  # fmt: skip


def layout_of(cell, active, radius=1.0, facets=12, size=10.0):
    monitor = Monitor()
    grid = octant_grid(cell, active, size, np.array([3.0, -40.0, 7.0]))
    spec = OctantSpec(size, radius, 0.0, facets)
    return lay_out(grid, mesh_octants(cell, spec, grid.keys, monitor))


@pytest.mark.slow_but("1.0-BCC", "0.4-CVC")
@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda c: c.name)
@pytest.mark.parametrize("share", [1.0, 0.4])
def test_the_survey_agrees_with_the_measure(cell, share):
    active = np.random.default_rng(3).random((3, 4, 2)) <= share
    layout = layout_of(cell, active)
    mesh = lay(layout, Monitor())
    surveyed, measured = certify(layout), quality.measure(mesh)
    for name in ("triangles", "vertices", "watertight", "shells", "bodies", "voids", "genus"):
        assert getattr(surveyed, name) == getattr(measured, name), name
    # Octants of a cell without mirrors may place a vertex that they share differently by a little;
    # a mesh has it once. Those of the library never do.
    agreed = agree_on_faces(layout)
    assert agreed or cell is SKEW
    near = 1e-9 if agreed else 1e-4
    assert surveyed.volume == pytest.approx(measured.volume, rel=near)
    assert surveyed.area == pytest.approx(measured.area, rel=near)
    np.testing.assert_array_equal(surveyed.bounds, measured.bounds)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cell", "radius", "facets", "share"),
    [("Kagome", 1.5877651511816147, 8, 1.0), ("Kelvin", 1.5690050236742336, 15, 0.6)],
)
def test_octants_fit_where_creases_leave_them(cell, radius, facets, share):
    """On a crease a vertex lies on two struts, and where two creases end it has a twin."""
    active = np.random.default_rng(1).random((2, 2, 2)) <= share
    certify(layout_of(LIBRARY[cell], active, radius, facets))


@pytest.mark.slow
def test_octants_fit_where_a_joint_and_a_strut_are_equally_near():
    """The vertex on their crease is moved by the curvature of one of them, the same beyond."""
    active = np.ones((2, 2, 2), bool)
    layout = layout_of(TANGLED, active, 0.15213236906986066, 9, 1.0950169171910413)
    certify(layout)
    assert agree_on_faces(layout)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("size", "radius", "facets"),
    [(17.776401119427685, 1.217720071165018, 20), (26.103108069836463, 2.184414544820798, 16)],
)
def test_octants_fit_where_both_ends_of_an_edge_are_equally_near_to_a_crease(size, radius, facets):
    """Of Kagome's octants the half on one side of a diagonal is the other one's mirror image."""
    layout = layout_of(LIBRARY["Kagome"], np.ones((2, 2, 2), bool), radius, facets, size)
    certify(layout)
    assert agree_on_faces(layout)


def test_an_octant_with_a_hole_is_found():
    layout = layout_of(LIBRARY["CVC"], np.ones((2, 2, 2), bool))
    key = layout.grid.keys[3]
    holed = replace(layout.octants[key], triangles=layout.octants[key].triangles[1:])
    layout = replace(layout, octants={**layout.octants, key: holed})
    with pytest.raises(RuntimeError):
        certify(layout)


def test_an_octant_that_puts_a_shared_vertex_elsewhere_is_found():
    layout = layout_of(LIBRARY["CVC"], np.ones((2, 2, 2), bool))
    assert agree_on_faces(layout)
    key = layout.grid.keys[3]
    octant = layout.octants[key]
    vertices = octant.vertices.copy()
    vertices[np.flatnonzero((octant.places != 1).any(axis=1))[0]] += 1e-9
    moved = replace(octant, vertices=vertices)
    layout = replace(layout, octants={**layout.octants, key: moved})
    assert not agree_on_faces(layout)


def test_octants_that_do_not_fit_together_are_found():
    layout = layout_of(LIBRARY["CVC"], np.ones((2, 2, 2), bool))
    kind = layout.grid.kind.copy()
    kind[2, 2, 2] = -1
    grid = replace(layout.grid, kind=kind)
    layout = lay_out(grid, layout.octants)
    with pytest.raises(RuntimeError, match="fit together"):
        certify(layout)
