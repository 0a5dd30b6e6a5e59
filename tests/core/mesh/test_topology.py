# SPDX-License-Identifier: LGPL-2.1-or-later
from collections import Counter

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

import samples
from volfrep.mesh import topology
from volfrep.mesh.quality import inspect
from volfrep.mesh.topology import edge_uses
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.process.pool import WorkerPool, backend_of, processes
from volfrep.util.parallel import ParallelBackend


def torn(seed):
    """Two balls, some of whose triangles are gone, doubled, turned over or share other corners."""
    random = np.random.default_rng(seed)
    both = concatenate(samples.sphere(3.0, 2), samples.sphere(1.0, 1), samples.sphere(2.0, 1))
    triangles = both.triangles[random.random(len(both.triangles)) > 0.02]
    triangles = np.concatenate([triangles, triangles[random.random(len(triangles)) < 0.03]])
    turned = random.random(len(triangles)) < 0.02
    triangles[turned] = triangles[turned, ::-1]
    moved = random.random(len(triangles)) < 0.01
    triangles[moved, 0] = triangles[moved, 1]
    random.shuffle(triangles)
    return TriangleMesh(both.vertices, triangles)


@pytest.mark.parametrize("block", [1, 7, 100, 1 << 17])
@pytest.mark.parametrize("seed", range(3))
def test_edges_that_blocks_have_in_common_are_counted_as_if_there_were_none(
    block, seed, monkeypatch
):
    mesh = torn(seed)
    monkeypatch.setattr("volfrep.mesh.topology.BLOCK_TRIANGLES", block)
    sides = [(a, b) for t in mesh.triangles.tolist() for a, b in zip(t, t[1:] + t[:1], strict=True)]
    ways = Counter((a, b) for a, b in sides if a != b)
    edges = {(min(side), max(side)) for side in ways}
    uses = [(ways[a, b], ways[b, a]) for a, b in edges]
    found = edge_uses(mesh)
    assert found.count == len(edges)
    assert found.open == sum(one + two == 1 for one, two in uses)
    assert found.overused == sum(one + two > 2 for one, two in uses)
    assert found.misoriented == sum(one + two == 2 and one != 1 for one, two in uses)
    assert min(found.open, found.overused, found.misoriented) > 0

    size = len(mesh.vertices)
    a, b = np.array(sides).T
    graph = coo_matrix((np.ones(len(a)), (a, b)), shape=(size, size))
    label = connected_components(graph, directed=False)[1]
    used = np.unique(mesh.triangles)
    # The same pieces, in the order of their lowest vertices.
    expected = np.unique(label[used], return_inverse=True)[1]
    np.testing.assert_array_equal(found.piece[used], expected)
    assert found.pieces == expected.max() + 1 >= 3


@pytest.mark.parametrize(("block", "seed"), [(1, 0), (7, 1), (1 << 17, 2)])
def test_the_triangle_across_a_side_is_the_only_other_one_on_it(block, seed, monkeypatch):
    mesh = torn(seed)
    monkeypatch.setattr(topology, "BLOCK_TRIANGLES", block)
    on = {}
    for row, triangle in enumerate(mesh.triangles.tolist()):
        for k in range(3):
            edge = frozenset((triangle[k], triangle[(k + 1) % 3]))
            on.setdefault(edge, []).append(3 * row + k)
    expected = np.full(mesh.triangles.size, -1)
    for sides in on.values():
        if len(sides) == 2:
            expected[sides] = sides[1] // 3, sides[0] // 3
    assert (expected >= 0).any()
    assert (expected < 0).any()
    found = topology.triangles_across(mesh)
    np.testing.assert_array_equal(found, expected.reshape(-1, 3))


def test_a_mesh_has_the_same_figures_in_blocks(monkeypatch):
    mesh = concatenate(samples.sphere(9.0, 2), samples.sphere(4.0, 1).reversed())
    whole = inspect(mesh)
    monkeypatch.setattr("volfrep.mesh.topology.BLOCK_TRIANGLES", 50)
    assert len(mesh.triangles) > 100
    again = inspect(mesh)
    assert whole.quality.watertight
    for name in vars(whole.quality):
        np.testing.assert_array_equal(getattr(whole.quality, name), getattr(again.quality, name))
    np.testing.assert_array_equal(whole.shell, again.shell)


def test_what_is_empty_has_no_edges():
    nothing = edge_uses(TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32)))
    assert (nothing.count, nothing.pieces) == (0, 0)
    empty = TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32))
    assert topology.triangles_across(empty).shape == (0, 3)


@pytest.mark.parametrize(("count", "pairs"), [(0, 0), (5, 0), (300, 200), (300, 300), (9, 400)])
def test_pieces_are_the_same_with_scipys_graphs_and_without(count, pairs, monkeypatch):
    one, two = np.random.default_rng(7).integers(0, max(count, 1), (2, pairs))
    few, piece = topology.pieces_of(one, two, count)
    monkeypatch.setattr(topology, "FEW_PAIRS", -1)
    by_scipy, of_scipy = topology.pieces_of(one, two, count)
    assert few == by_scipy
    assert np.array_equal(piece, of_scipy)
    lowest = [np.flatnonzero(piece == k)[0] for k in range(few)]
    assert lowest == sorted(lowest), "numbered by their first things"


@pytest.mark.parametrize("chosen", [[], [7], [300, 310, 321], [0, 200, 641]])
def test_triangles_touch_chosen_vertices_that_lie_together_or_anywhere(chosen, monkeypatch):
    monkeypatch.setattr(topology, "BLOCK_TRIANGLES", 300)
    mesh = samples.sphere(10.0, 3)
    among = np.zeros(len(mesh.vertices), bool)
    among[chosen] = True
    expected = np.isin(mesh.triangles, chosen).any(axis=1)
    np.testing.assert_array_equal(topology.touching(among, mesh.triangles), expected)


@pytest.mark.parametrize("chosen", [[], [0, 200, 641]])
def test_processes_look_for_the_triangles_that_touch_in_the_file_of_a_mesh(chosen, monkeypatch):
    monkeypatch.setattr(ParallelBackend, "uses_processes", True)
    monkeypatch.setattr(topology, "CALL_TRIANGLES", 300)
    backend, calls, mesh = ParallelBackend(), [], samples.sphere(10.0, 3)
    real = backend.starmap
    backend.starmap = lambda function, given: real(function, calls.extend(given) or calls)
    among = np.zeros(len(mesh.vertices), bool)
    among[chosen] = True
    expected = topology.touching(among, mesh.triangles, backend)
    assert not calls, "it would be copied there first"
    in_file = backend.gathered([mesh.triangles], mesh.triangles.shape, np.int32)
    np.testing.assert_array_equal(topology.touching(among, in_file, backend), expected)
    assert len(calls) == (5 if chosen else 0)


@pytest.mark.costly
def test_processes_count_the_edges_that_threads_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(topology, "BLOCK_TRIANGLES", 300)
    mesh = samples.sphere(10.0, 3)
    open_ = TriangleMesh(mesh.vertices, np.delete(mesh.triangles, [100, 700], axis=0))
    here = edge_uses(open_)
    assert here.open == 6
    with processes(2) as executor:
        assert isinstance(executor, WorkerPool)
        there = edge_uses(open_, backend_of(executor))
        assert executor.workers, "they were asked"
        for worker in executor.workers:
            worker.kill()
        lost = edge_uses(open_, backend_of(executor))
    for found in (there, lost, edge_uses(open_, backend_of(executor))):
        for name, value in vars(here).items():
            np.testing.assert_array_equal(getattr(found, name), value, name)
