# SPDX-License-Identifier: LGPL-2.1-or-later
from fractions import Fraction

import numpy as np
import pytest
import trimesh

import samples
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial.piercing import (
    meeting_triangles,
    pairs_at_planes,
    piercing_among,
    piercing_pairs,
)
from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor


def in_fractions(mesh):
    """The pairs, of which the first pierces the second, by rational numbers and a double loop."""
    corners = [[[Fraction(float(x)) for x in p] for p in t] for t in mesh.vertices[mesh.triangles]]

    def side(p, q, r, s):
        u, v, w = ([a - b for a, b in zip(x, s, strict=True)] for x in (p, q, r))
        value = sum(
            u[i] * (v[(i + 1) % 3] * w[(i + 2) % 3] - v[(i + 2) % 3] * w[(i + 1) % 3])
            for i in range(3)
        )
        return (value > 0) - (value < 0)

    def both_sides(a, b):
        sides = [side(*b, p) for p in a]
        return max(sides) > 0 > min(sides)

    def pierces(a, b):
        for k in range(3):
            p, q = a[k], a[(k + 1) % 3]
            if side(*b, p) * side(*b, q) < 0:
                turns = [side(p, q, b[e], b[(e + 1) % 3]) for e in range(3)]
                if min(turns) >= 0 or max(turns) <= 0:
                    return True
        return False

    count = len(corners)
    return [
        (i, j)
        for i in range(count)
        for j in range(count)
        if i != j
        and len(set(mesh.triangles[i]) & set(mesh.triangles[j])) < 2
        and both_sides(corners[i], corners[j])
        and both_sides(corners[j], corners[i])
        and pierces(corners[i], corners[j])
    ]


@pytest.mark.slow_but("0.25-0")
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("step", [2.0**-40, 0.25, 1.0])
def test_the_pairs_are_those_of_rational_arithmetic(seed, step):
    """Coarse steps give corners in planes and edges through edges; a fine one gives neither."""
    random = np.random.default_rng(seed)
    vertices = np.round(random.uniform(-4, 4, (24, 3)) / step) * step
    triangles = np.array([random.choice(24, 3, replace=False) for _ in range(40)], np.int32)
    mesh = TriangleMesh(vertices, triangles)
    expected = in_fractions(mesh)
    assert len(expected) > 5
    assert list(map(tuple, piercing_pairs(mesh))) == expected


def test_a_hair_above_is_not_through_and_a_hair_below_is():
    """Last bits of one coordinate decide, far from the origin, in a slanted plane."""
    plane = np.array([[1000.1, 7.3, -3.0], [1009.7, 7.9, -3.4], [1003.3, 15.1, -2.6]])
    inside = plane.mean(axis=0)
    normal = np.cross(plane[1] - plane[0], plane[2] - plane[0])
    needle = np.array([inside, inside + normal, inside + normal + [0.1, 0.2, 0.3]])
    found = set()
    for steps in range(-24, 25):
        corner = needle.copy()
        corner[0, 2] += steps * np.spacing(corner[0, 2])
        mesh = TriangleMesh(
            np.concatenate([plane, corner]), np.array([[0, 1, 2], [3, 4, 5]], np.int32)
        )
        pairs = list(map(tuple, piercing_pairs(mesh)))
        assert pairs == in_fractions(mesh)
        found.add(len(pairs))
    assert found == {0, 1}


def test_closed_surfaces_do_not_pierce_themselves():
    for part in (samples.plate(48), samples.sphere(subdivisions=3), samples.bracket(33.0)):
        assert not len(piercing_pairs(part))


def test_boxes_whose_edges_meet_diagonals_of_faces_pierce_each_other():
    """An edge through the diagonal of a face is inside none of its triangles."""
    box = trimesh.creation.box((10, 10, 10))
    one = TriangleMesh(np.asarray(box.vertices), np.asarray(box.faces, np.int32))
    for shift in ((3, 3, 3), (3, -3, 3), (-3, 3, 3), (3, 3, -3)):
        both = concatenate(one, TriangleMesh(one.vertices + np.asarray(shift), one.triangles))
        pairs = piercing_pairs(both)
        assert len(pairs)
        assert ((pairs[:, 0] < 12) != (pairs[:, 1] < 12)).all()


def test_boxes_that_touch_do_so_where_edges_cross_only():
    """From two triangles alone nobody can tell whether surfaces cross or touch there."""
    box = trimesh.creation.box((10, 10, 10))
    one = TriangleMesh(np.asarray(box.vertices), np.asarray(box.faces, np.int32))
    for shift, edges_cross in (
        ((10, 0, 0), False),
        ((10, 10, 0), False),
        ((10, 10, 10), False),
        ((10, 3, 4), True),
    ):
        both = concatenate(one, TriangleMesh(one.vertices + np.asarray(shift), one.triangles))
        assert bool(len(piercing_pairs(both))) == edges_cross


@pytest.mark.slow_but("0", "1")
@pytest.mark.parametrize("seed", range(8))
def test_nothing_that_small_moves_bring_to_cross_is_left_out(seed):
    """Flat fans, needles and facets a hair above each other, every coordinate moved at random."""
    random = np.random.default_rng(seed)
    moves, count = 1e-3, 70
    vertices = random.uniform(-1.0, 1.0, (count, 3)) * [1.0, 1.0, (1.0, 1e-3)[seed % 2]] + 40.0
    triangles = np.array([random.choice(count, 3, replace=False) for _ in range(90)], np.int32)
    close = pairs_at_planes(TriangleMesh(vertices, triangles), moves)
    every = np.stack(np.triu_indices(len(triangles), 1), axis=1)
    shared = (triangles[every[:, 0], :, None] == triangles[every[:, 1], None, :]).sum(axis=(1, 2))
    every = every[shared < 2]
    assert len(np.unique(np.sort(close, axis=1), axis=0)) < 0.9 * len(every)
    for _ in range(8):
        there = vertices + random.choice([-moves, 0.3 * moves, moves], vertices.shape)
        moved = TriangleMesh(there, triangles)
        assert np.array_equal(piercing_among(moved, close), piercing_among(moved, every))
        assert len(piercing_among(moved, every)) > 100


def test_a_triangle_beyond_an_edge_of_a_long_one_needs_no_exact_look():
    """Each has corners on both sides of the other's plane, and no plane across the way divides."""
    long, small = [[0, 0, 0], [10, 0, 0], [0, 10, 0]], [[9, 1, -1], [9, 1, 1], [9.1, 1.1, 0]]
    triangles = np.arange(6, dtype=np.int32).reshape(2, 3)
    for aside, count in ((0.3, 0), (-0.3, 1)):
        vertices = np.array(long + small) + np.outer([0, 0, 0, 1, 1, 1], [aside, aside, 0])
        assert len(pairs_at_planes(TriangleMesh(vertices, triangles), 0.0)) == count


UP, OUT = np.array([0.0, 0.0, 1.0]), np.array([1.0, 1.0, 0.0]) / 2**0.5
#: Triangles that touch one with corners (0, 0), (4, 0), (0, 4) in a plane: their corners, which of
#: all six they have, and the way off. One stands on a corner or an edge, one has an edge across its
#: longest, and one leaves the corner that they share in its plane.
BESIDE = {
    "corner": ([[1, 1, 0], [2, 1, 3], [1, 2, 3]], [3, 4, 5], UP),
    "edge": ([[1, 1, 0], [3, 3, 0], [3, 3, 3]], [3, 4, 5], UP),
    "edges": ([[2, 2, -1], [2, 2, 1], [5, 5, 0]], [3, 4, 5], OUT),
    "shared": ([[1, 1, 0], [2, 1, 3], [1, 2, 3]], [0, 3, 4], UP),
}


@pytest.mark.parametrize("kind", BESIDE)
def test_what_comes_nearer_than_a_gap_meets(kind):
    corners, other, way = BESIDE[kind]
    for gap, off, meets in ((1e-6, 0.5, True), (1e-6, 2.0, False), (1e-3, 0.5, True)):
        places = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], *corners], float)
        places[3:] += off * gap * way
        mesh = TriangleMesh(places, np.array([[0, 1, 2], other], np.int32))
        for among in ([True, False], [False, True]):
            assert meeting_triangles(mesh, np.array(among), gap).tolist() == [meets] * 2
        assert not meeting_triangles(mesh, np.zeros(2, bool), gap).any()


def test_it_can_be_cancelled():
    with pytest.raises(Cancelled):
        piercing_pairs(samples.bracket(33.0), Monitor(lambda fraction, stage: False))
