# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laid octants brought onto struts of other radii and at other places."""

import numpy as np
import pytest

from samples import SKEW
from volfrep import LatticeSpec
from volfrep.design.cells import LIBRARY, joint_radius
from volfrep.grid.coordinate_map import identity_map
from volfrep.grid.node_frames import node_frames
from volfrep.grid.strut_graph import cell_graph
from volfrep.lattice.assembly import coordinates, facets, lay_out
from volfrep.lattice.deform import deform
from volfrep.lattice.strut_binding import STRUT, bind, corner_turns
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.octants.octant import OctantKey, octant_grid
from volfrep.octants.octant_mesh import mesh_octants, octant_spec
from volfrep.octants.sdf import distances, spheres, struts
from volfrep.spatial.piercing import piercing_pairs
from volfrep.util.errors import VolfrepError
from volfrep.util.progress import Monitor

SIZE, RADIUS, SHAPE = 10.0, 1.0, (2, 2, 2)


class Laid:
    """A block of equal octants, laid, and the graph that its vertices hang on."""

    def __init__(self, cell):
        spec = LatticeSpec(cell=cell, cell_size=SIZE, strut_radius=RADIUS, resolution=16)
        self.cell, self.octant_spec = cell, octant_spec(spec.cell_size, spec.struts, spec.detail)
        grid = octant_grid(cell, np.ones(SHAPE, bool), SIZE, np.zeros(3))
        octants = mesh_octants(cell, self.octant_spec, grid.keys, Monitor())
        self.layout = lay_out(grid, octants)
        wide = np.pad(np.ones(SHAPE, bool), 1)
        self.graph = cell_graph(cell, wide, SIZE, np.full(3, -SIZE), first=(1, 1, 1))
        self.bindings = {
            key: bind(cell, self.octant_spec, key, self.layout.octants[key])
            for key, place in zip(grid.keys, self.layout.places, strict=True)
            if len(place) and len(self.layout.octants[key].vertices)
        }

    def brought(self, points=None, radius=RADIUS, stretch=None):
        """The vertices on struts of a radius, or of one for each node, between given places.

        Or between places that the cells' stretch along x, y and z gives.
        """
        nodes, bends = self.graph.nodes, None
        if stretch is not None:
            points = nodes * stretch
            bends = np.broadcast_to(np.diag(stretch), (len(nodes), 3, 3))
        radii = np.broadcast_to(np.asarray(radius, float), len(nodes)).copy()
        made = node_frames(self.graph, nodes if points is None else points, radii, SIZE, bends)
        return deform(
            self.layout, self.bindings, self.cell, made, identity_map(SIZE), 0.0, Monitor()
        )

    def mesh(self, vertices):
        return TriangleMesh(vertices, facets(self.layout, Monitor()))

    def off(self, points, radius):
        """Distances of points to the union of the graph's struts and joints of a radius."""
        ends = self.graph.nodes[self.graph.struts]
        found = np.full(len(points), np.inf)
        for one in struts(ends[:, 0], ends[:, 1], radius), \
                spheres(self.graph.nodes, joint_radius(radius, SIZE)):  # fmt: skip
            for k in range(len(one)):
                found = np.minimum(found, distances(points, one.take(np.full(len(points), k))))
        return found


@pytest.fixture(scope="module", params=[LIBRARY["Box"], LIBRARY["CVC"], SKEW], ids=lambda c: c.name)
def laid(request):
    return Laid(request.param)


@pytest.mark.slow_cases("skew")
def test_with_equal_radii_at_the_same_places_nothing_moves(laid):
    found = laid.brought()
    np.testing.assert_allclose(
        found.vertices, coordinates(laid.layout, Monitor()), atol=1e-3 * SIZE
    )
    # Vertices on the octants' edges and corners aside, to the last digits.
    moved = np.linalg.norm(found.vertices - coordinates(laid.layout, Monitor()), axis=1)
    assert np.median(moved) < 1e-9
    assert found.excess < 0.01


@pytest.mark.slow_but("CVC-0.6")
@pytest.mark.parametrize("radius", [0.6, 1.02])
def test_vertices_come_onto_struts_of_another_radius(laid, radius):
    """As far from them as they were from the first ones, in units of the radius."""
    before = laid.off(coordinates(laid.layout, Monitor()), RADIUS)
    found = laid.brought(radius=radius).vertices
    after = laid.off(found, radius)
    assert np.abs(before).max() < 0.12 * RADIUS
    assert np.abs(after).max() < 0.15 * max(radius, RADIUS)
    assert np.median(np.abs(after / radius - before / RADIUS)) < 0.005
    grown = laid.mesh(found).volume / laid.mesh(coordinates(laid.layout, Monitor())).volume
    # Between struts alone (r2) and joints alone (r3).
    low, high = sorted([radius**1.7, radius**2.1])
    assert low < grown < high


def test_where_creases_meet_vertices_are_bound_to_the_middle_of_their_strut():
    """Kagome's windows are closed there: creases of a strut's two ends meet at its middle. Bound
    beyond it by many times what is left between them, vertices flew off thinner struts."""
    spec = LatticeSpec("Kagome", SIZE, 1.35, resolution=12)
    cell, meshing = spec.unit_cell(), octant_spec(SIZE, spec.struts, spec.detail)
    keys = [OctantKey(mirror, 0xFF) for mirror in (1, 2)]
    for key, octant in mesh_octants(cell, meshing, keys, Monitor()).items():
        bound = bind(cell, meshing, key, octant)
        share = bound.share[bound.kind == STRUT]
        assert -0.1 < share.min() < share.max() < 1.01


@pytest.mark.slow_cases("skew")
def test_moved_nodes_take_their_vertices_along(laid):
    """A lattice turned and shifted as a whole is its mesh turned and shifted."""
    shift = np.array([3.0, -4.0, 0.5])
    first = laid.brought().vertices
    moved = laid.brought(laid.graph.nodes + shift).vertices
    on_struts = np.linalg.norm(moved - first - shift, axis=1)
    # What lies in space (corners of caps) is of the map and not of the nodes.
    assert np.mean(on_struts < 1e-9) > 0.99


@pytest.mark.costly
@pytest.mark.slow_but("1.5")
@pytest.mark.parametrize("stretch", [1.5, 2.5])
def test_no_facets_cross_where_creases_meet_elsewhere_between_struts(stretch):
    """Octet's struts close up where cells are stretched: 8 facets folded at every such corner."""
    octet = Laid(LIBRARY["Octet"])
    vertices = octet.brought(stretch=(stretch, 1.0, 1.0)).vertices
    assert not len(piercing_pairs(octet.mesh(vertices)))


def test_the_corner_of_three_creases_is_found_from_their_struts():
    up, right, aside = np.array([[0.0, 0.0, 1.0]]), np.array([[0.0, 1.0, 1.0]]), (1.0, 0.0, 1.0)

    def found(*left, others=((0.0, 0.0, 1.0),)):
        directions = np.array([others])
        present = np.ones(directions.shape[:2], bool)
        return corner_turns(up, np.array([left]), right, up, directions, present)[0]

    assert found(*aside) == pytest.approx(0.5)
    # A strut that lies nearer to the own one reaches farther along it, and round it.
    assert 0.5 < found(1.0, 0.0, 9.0) < 1.0
    # Another one hides the place; of three struts in one plane the creases do not meet.
    assert found(*aside, others=((0.5, 0.5, np.sqrt(0.5)),)) == 0.0
    assert found(0.0, -1.0, 1.0) == 0.0


@pytest.mark.costly_cases("skew")
def test_struts_that_grow_into_each_other_are_refused(laid):
    with pytest.raises(VolfrepError, match=r"Near \(.*\) struts of radius 5.2 mm .* grow into"):
        laid.brought(radius=5.2)


@pytest.mark.costly_cases("skew")
def test_a_cancel_is_heard(laid):
    from volfrep.util.errors import Cancelled

    nodes = laid.graph.nodes
    made = node_frames(laid.graph, nodes, np.full(len(nodes), RADIUS), SIZE)
    with pytest.raises(Cancelled):
        deform(
            laid.layout, laid.bindings, laid.cell, made, identity_map(SIZE), 0.0,
            Monitor(lambda fraction, stage: False),
        )  # fmt: skip
