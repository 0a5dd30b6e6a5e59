# SPDX-License-Identifier: LGPL-2.1-or-later
"""Free-standing lattices: one closed surface, the right genus, the right volume."""

import gc
import weakref

import manifold3d
import numpy as np
import pytest

from exact import DENSITY, distances_to_one_cell, in_lattice
from samples import SKEW
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.grid.strut_graph import cell_graph
from volfrep.lattice.assembly import (
    box,
    coordinates,
    facets,
    lay,
    lay_out,
    lay_out_some,
    neighbour_missing,
)
from volfrep.mesh import quality
from volfrep.mesh.triangle_mesh import TriangleMesh, compact
from volfrep.octants.caps import cap, with_corners
from volfrep.octants.octant import ALL_ACTIVE, OctantGrid, OctantKey, octant_grid
from volfrep.octants.octant_mesh import mesh_octants
from volfrep.octants.octant_spec import OctantSpec
from volfrep.util.progress import Monitor

L = 10.0


def lattice(cell, active, radius=1.0, facets_along=16, fillet=0.0):
    spec = OctantSpec(L, radius, fillet, facets_along)
    monitor = Monitor()
    grid = octant_grid(cell, active, L, np.zeros(3))
    return lay(lay_out(grid, mesh_octants(cell, spec, grid.keys, monitor)), monitor)


def monte_carlo_volume(cell, active, radius, samples=60_000):
    size = np.array(active.shape) * L
    low, high = -2.0 * radius * np.ones(3), size + 2.0 * radius
    points = np.random.default_rng(7).uniform(low, high, (samples, 3))
    inside = in_lattice(points, cell, L, radius, active)
    share = inside.mean()
    box = np.prod(high - low)
    return box * share, box * np.sqrt(share * (1 - share) / samples)


@pytest.mark.slow_but("BCC")
@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda c: c.name)
def test_a_block_is_one_closed_surface_of_the_wireframes_genus(cell):
    active = np.ones((2, 2, 2), bool)
    mesh = lattice(cell, active)
    found = quality.measure(mesh)
    graph = cell_graph(cell, active, L, np.zeros(3))
    assert found.watertight
    assert found.shells == 1
    assert found.genus == graph.genus
    volume, deviation = monte_carlo_volume(cell, active, 1.0)
    assert found.volume == pytest.approx(volume, abs=0.005 * volume + 3 * deviation)


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda c: c.name)
def test_scattered_cells_give_closed_surfaces_too(cell):
    active = np.random.default_rng(5).random((3, 3, 2)) < 0.5
    mesh = lattice(cell, active, 0.8, 16)
    found = quality.measure(mesh)
    graph = cell_graph(cell, active, L, np.zeros(3))
    pieces = _pieces(len(graph.nodes), graph.struts)
    assert found.watertight
    assert found.bodies == pieces
    assert found.voids == 0
    assert found.genus == len(graph.struts) - len(graph.nodes) + pieces
    volume, deviation = monte_carlo_volume(cell, active, 0.8)
    assert found.volume == pytest.approx(volume, abs=0.005 * volume + 3 * deviation)


@pytest.mark.parametrize("cell", [find_cell("BCC"), SKEW], ids=lambda c: c.name)
def test_some_octants_keep_their_numbers_and_lie_in_the_box_of_their_vertices(cell):
    monitor, active = Monitor(), np.zeros((2, 3, 2), bool)
    active[0, 1, 0] = active[1, 2, 1] = True
    grid = octant_grid(cell, active, L, np.array([0.3, -7.1, 2.9]))
    octants = mesh_octants(cell, OctantSpec(L, 0.8, 0.0, 12), grid.keys, monitor)
    whole = lay_out(grid, octants)
    where = np.random.default_rng(3).random(grid.kind.shape) < 0.4
    some = lay_out_some(whole, where)
    np.testing.assert_array_equal(
        np.unique(facets(some, monitor)), np.unique(facets(whole, monitor, where))
    )
    assert some.count == len(np.unique(facets(some, monitor)))
    for layout, used in ((whole, slice(None)), (some, np.unique(facets(some, monitor)))):
        points = coordinates(whole, monitor)[used]
        np.testing.assert_array_equal(box(layout), [points.min(axis=0), points.max(axis=0)])


def _pieces(nodes, struts):
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    graph = coo_matrix((np.ones(len(struts)), struts.T), shape=(nodes, nodes))
    return connected_components(graph, directed=False)[0]


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("name", PAPERS)
def test_no_triangles_cross(name):
    mesh = lattice(LIBRARY[name], np.ones((2, 1, 1), bool))
    crossings = _crossing_pairs(mesh)
    assert len(crossings) == 0


def _crossing_pairs(mesh):
    """Pairs of triangles without a common vertex of which an edge of one pierces the other."""
    from scipy.spatial import cKDTree

    corners = mesh.vertices[mesh.triangles]
    centre = corners.mean(axis=1)
    reach = np.linalg.norm(corners - centre[:, None], axis=2).max()
    pairs = cKDTree(centre).query_pairs(2.0 * reach, output_type="ndarray")
    one, two = pairs.T
    box = (corners[one].min(1) <= corners[two].max(1)) & (
        corners[two].min(1) <= corners[one].max(1)
    )
    shared = (mesh.triangles[one][:, :, None] == mesh.triangles[two][:, None, :]).any((1, 2))
    keep = box.all(axis=1) & ~shared
    one, two = one[keep], two[keep]
    return np.concatenate(
        [
            np.stack([a, b], axis=1)[_pierces(corners[a], corners[b])]
            for a, b in ((one, two), (two, one))
        ]
    )


def _pierces(first, second):
    """Whether an edge of the first triangles passes through the inside of the second."""

    def side(a, b, c, d):
        return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)

    a, b, c = (second[:, k] for k in range(3))
    result = np.zeros(len(first), bool)
    for k in range(3):
        p, q = first[:, k], first[:, (k + 1) % 3]
        across = side(a, b, c, p) * side(a, b, c, q) < 0
        s, t, u = side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)
        result |= across & (((s > 0) & (t > 0) & (u > 0)) | ((s < 0) & (t < 0) & (u < 0)))
    return result


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("name", PAPERS)
def test_triangles_are_well_shaped(name):
    mesh = lattice(LIBRARY[name], np.ones((2, 2, 2), bool))
    shape = quality.shape_statistics(mesh)
    assert shape.radius_ratio_mean > 0.87
    assert shape.smallest_angle > 5.0


@pytest.mark.slow_but("15-0.03-CVC", "15-0.03-Octahedron")
@pytest.mark.parametrize("name", PAPERS)
@pytest.mark.parametrize(("resolution", "allowed"), [(15, 0.03), (30, 0.008)])
def test_facets_stray_little_and_to_both_sides_alike(name, resolution, allowed):
    mesh = lattice(LIBRARY[name], np.ones((1, 1, 1), bool), 1.0, resolution)
    a, b, c = mesh.corners()
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(2)
    pick = random.choice(len(area), 20_000, p=area / area.sum())
    u, v, w = random.dirichlet((1.0, 1.0, 1.0), len(pick)).T[:, :, None]
    points = u * a[pick] + v * b[pick] + w * c[pick]
    distance = distances_to_one_cell(points, LIBRARY[name], L, 1.0)
    assert np.sqrt((distance**2).mean()) < allowed
    assert abs(distance.mean()) < 0.1 * allowed


@pytest.mark.slow
@pytest.mark.parametrize("name", ["CVC", "Octet"])
def test_the_volume_converges_with_resolution(name):
    cell, active = LIBRARY[name], np.ones((1, 1, 1), bool)
    exact = lattice(cell, active, 1.0, 48).volume
    for resolution, allowed in ((10, 0.006), (16, 0.0015), (24, 0.0005)):
        assert lattice(cell, active, 1.0, resolution).volume == pytest.approx(exact, rel=allowed)


@pytest.mark.costly
def test_a_fillet_adds_material_at_the_joints_and_keeps_the_genus():
    cell, active = LIBRARY["BCC"], np.ones((2, 2, 2), bool)
    sharp, round_ = (quality.measure(lattice(cell, active, 0.8, 20, f)) for f in (0.0, 0.6))
    assert round_.watertight
    assert round_.genus == sharp.genus
    assert 1.01 * sharp.volume < round_.volume < 1.5 * sharp.volume


@pytest.mark.slow_but("0.5-CVC", "1.0-Box")
@pytest.mark.parametrize("name", DENSITY)
@pytest.mark.parametrize("radius", [0.5, 1.0])
def test_capped_octants_have_the_closed_forms_density(name, radius):
    size = (6, 4, 2)
    mesh = capped_box(LIBRARY[name], np.ones(size, bool), radius, 16 if radius == 1.0 else 32)
    a, b = DENSITY[name]
    x = radius / L
    volume = np.prod(size) * (L / 2) ** 3
    assert mesh.volume / volume == pytest.approx(a * x**2 - b * x**3, rel=0.005)


@pytest.mark.slow_but("CVC", "Box")
@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda c: c.name)
def test_flat_caps_close_any_set_of_octants_that_touch_by_faces(cell):
    where = np.ones((4, 5, 3), bool)
    where[2:, 3:, :] = False
    where[0, 0, 0] = False
    mesh = capped_box(cell, where, 1.4, 14)
    solid = manifold3d.Manifold(manifold3d.Mesh64(mesh.vertices, mesh.triangles.astype(np.uint64)))
    assert solid.status() == manifold3d.Error.NoError
    assert quality.measure(mesh).watertight


def capped_box(cell, where, radius, facets_along):
    monitor = Monitor()
    symmetric = cell.is_mirror_symmetric
    keys = [OctantKey(m, ALL_ACTIVE) for m in range(1 if symmetric else 8)]
    index = np.indices(where.shape) % 2 == 0
    kind = np.zeros(where.shape, np.int16)
    if not symmetric:
        kind = (index[0] + 2 * index[1] + 4 * index[2]).astype(np.int16)
    kind[~where] = -1
    grid = OctantGrid(keys, kind, np.zeros(3), L, symmetric)
    octants = mesh_octants(cell, OctantSpec(L, radius, 0.0, facets_along), keys, monitor)
    layout = lay_out(grid, {key: with_corners(octants[key], L / 2) for key in keys})
    parts = [facets(layout, monitor)]
    for axis in range(3):
        for high in (False, True):
            missing = neighbour_missing(grid, where, axis, high)
            parts.append(facets(layout, monitor, missing, (axis, high)))
    return compact(TriangleMesh(coordinates(layout, monitor), np.concatenate(parts)))


def test_a_cap_is_known_as_long_as_its_octant():
    key = OctantKey(0, ALL_ACTIVE)
    octants = mesh_octants(find_cell("CVC"), OctantSpec(L, 1.0, 0.0, 8), [key], Monitor())
    octant = with_corners(octants[key], L / 2)
    assert cap(octant, 0, True) is cap(octant, 0, True)
    assert not np.array_equal(cap(octant, 0, True), cap(octant, 1, True))
    kept = weakref.ref(octant)
    del octant
    gc.collect()
    assert kept() is None
