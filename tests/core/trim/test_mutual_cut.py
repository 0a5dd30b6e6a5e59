"""Two surfaces cut at each other: against manifold3d's Boolean, and where nothing is certain."""

import numpy as np
import pytest
import trimesh

from volfrep.mesh.booleans import difference, intersection
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh, compact, concatenate
from volfrep.spatial.piercing import piercing_pairs
from volfrep.spatial.rays import inside_points
from volfrep.trim.mutual_cut import cut_mutually
from volfrep.trim.seams import NotCertain, seam_of
from volfrep.util.progress import Monitor


def solid(shape, *moves):
    for move in moves:
        shape.apply_translation(move)
    return TriangleMesh(np.array(shape.vertices), np.array(shape.faces, np.int32))


def ball(radius, centre, subdivisions=3):
    return solid(trimesh.creation.icosphere(subdivisions=subdivisions, radius=radius), centre)


def box(size, centre):
    return solid(trimesh.creation.box(size), centre)


def cut(lattice, wall, in_front):
    """The wall less the lattice, or what both have in common."""
    every = np.ones(len(lattice.triangles), bool), np.ones(len(wall.triangles), bool)

    def within(points):
        return inside_points(lattice, points, Monitor())

    parts = cut_mutually(lattice, wall, every, within, in_front=in_front, monitor=Monitor())
    first = parts.first[:, ::-1] if in_front else parts.first
    triangles = np.concatenate([first, parts.second]).astype(np.int32)
    return compact(TriangleMesh(parts.vertices, triangles)), parts


PAIRS = {
    "a ball in a corner": (ball(3.0, (4.1, 3.9, 4.3)), box((10, 10, 10), (0, 0, 0))),
    "a bar through a ball": (box((30, 1.1, 0.9), (0.3, 0.2, 0.1)), ball(7.0, (0, 0, 0))),
    "small facets, large ones": (
        ball(2.0, (5.03, 1.1, 0.3), 4),
        box((10, 40, 40), (0, 0, 0)),
    ),
    "large facets, small ones": (box((10, 9, 8), (4, 3.3, 2.9)), ball(6.0, (0, 0, 0), 4)),
    "one in the other": (ball(1.0, (1, 1, 1)), box((10, 10, 10), (0, 0, 0))),
    "the other in the one": (box((10, 10, 10), (0, 0, 0)), ball(1.0, (1, 1, 1))),
    "apart": (ball(1.0, (9, 9, 9)), box((10, 10, 10), (0, 0, 0))),
}


@pytest.mark.parametrize("name", PAIRS)
@pytest.mark.parametrize("in_front", [True, False])
def test_what_is_left_is_the_librarys_boolean(name, in_front):
    lattice, wall = PAIRS[name]
    expected = difference(wall, lattice) if in_front else intersection(wall, lattice)
    found, _ = cut(lattice, wall, in_front)
    assert found.volume == pytest.approx(expected.volume, rel=1e-12, abs=1e-12)
    if len(expected.triangles):
        ours, theirs = measure(found), measure(expected)
        assert ours.watertight
        assert (ours.bodies, ours.voids, ours.genus) == (
            theirs.bodies,
            theirs.voids,
            theirs.genus,
        )
        assert ours.area == pytest.approx(theirs.area, rel=1e-12)
    else:
        assert not len(found.triangles)


def test_every_piece_lies_in_the_facet_it_was():
    lattice, wall = PAIRS["a ball in a corner"]
    _, parts = cut(lattice, wall, True)
    for source, left, rows in (
        (lattice, parts.first, parts.first_source),
        (wall, parts.second, parts.second_source),
    ):
        was, now = (
            np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
            for p in (source.vertices[source.triangles[rows]], parts.vertices[left])
        )
        assert (np.einsum("ij,ij->i", was, now) >= 0).all()
        middle = parts.vertices[left].mean(axis=1)
        away = np.einsum("ij,ij->i", middle - source.vertices[source.triangles[rows, 0]], was)
        assert np.abs(away / np.linalg.norm(was, axis=1)).max() < 1e-12


def test_only_wanted_facets_are_given_out_and_they_are_the_same():
    lattice, wall = PAIRS["a bar through a ball"]
    half = wall.vertices[wall.triangles].mean(axis=1)[:, 0] > 0
    none = np.zeros(len(lattice.triangles), bool)
    whole = cut(lattice, wall, True)[1]
    part = cut_mutually(
        lattice, wall, (none, half), lambda _: None, in_front=True, monitor=Monitor()
    )
    assert not len(part.first)

    def areas(parts):
        a, b, c = (parts.vertices[parts.second[:, k]] for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        return np.bincount(parts.second_source, area, minlength=len(half))

    assert areas(part)[half] == pytest.approx(areas(whole)[half], abs=1e-12)
    assert not areas(part)[~half].any()


@pytest.mark.parametrize("in_front", [True, False])
def test_what_of_a_wall_reaches_into_the_box_about_a_surface_does_where_they_meet(in_front):
    lattice, wall = PAIRS["large facets, small ones"]
    whole = cut(lattice, wall, in_front)[1]
    corners = wall.vertices[wall.triangles]
    low, high = lattice.bounds
    near = (corners.min(axis=1) <= high).all(axis=1) & (corners.max(axis=1) >= low).all(axis=1)
    assert 0.1 < near.mean() < 0.6
    part = cut_mutually(
        lattice, TriangleMesh(wall.vertices, wall.triangles[near]),
        (np.ones(len(lattice.triangles), bool), np.ones(int(near.sum()), bool)),
        lambda points: inside_points(lattice, points, Monitor()),
        in_front=in_front, closed=False, monitor=Monitor(),
    )  # fmt: skip
    np.testing.assert_array_equal(part.first_source, whole.first_source)
    np.testing.assert_allclose(
        part.vertices[part.first], whole.vertices[whole.first], rtol=0, atol=1e-12
    )
    source = np.flatnonzero(near)[part.second_source]
    stay = near[whole.second_source]
    np.testing.assert_array_equal(np.sort(source), np.sort(whole.second_source[stay]))


def test_an_open_wall_does_not_tell_what_lies_inside():
    lattice, wall = PAIRS["one in the other"]
    every = np.ones(len(lattice.triangles), bool), np.ones(len(wall.triangles), bool)
    with pytest.raises(NotCertain):
        cut_mutually(
            lattice, wall, every, lambda points: np.zeros(len(points), bool),
            in_front=True, closed=False, monitor=Monitor(),
        )  # fmt: skip


def test_points_of_the_seam_lie_on_both():
    lattice, wall = PAIRS["large facets, small ones"]
    seam = seam_of(lattice, wall)
    assert len(seam.ends) == len(np.unique(seam.ends[:, 0])) == len(seam.points)
    for mesh, other, found in ((lattice, wall, seam.first), (wall, lattice, seam.second)):
        start, end = (mesh.vertices[found.edge[:, k]] for k in (0, 1))
        along = np.cross(end - start, found.points - start)
        assert np.abs(along).max() < 1e-12
        corners = other.vertices[other.triangles[found.facet]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert np.abs(np.einsum("ij,ij->i", found.points - corners[:, 0], normal)).max() < 1e-11


@pytest.mark.parametrize("thin", [1.0, 1e-3, 1e-6])
def test_a_seam_runs_through_just_the_facets_that_pierce_each_other(thin):
    random = np.random.default_rng(7)
    soups = []
    for size, width in ((1.0, thin), (2.0, 1.0)):
        corners = random.uniform(-1, 1, (300, 1, 3)) + size * random.uniform(-1, 1, (300, 3, 3))
        corners[:, 2] = corners[:, 1] + width * (corners[:, 2] - corners[:, 1])  # down to needles
        rows = np.arange(900, dtype=np.int32).reshape(-1, 3)
        soups.append(TriangleMesh(corners.reshape(-1, 3), rows))
    found = np.sort(seam_of(*soups).facets @ [300, 1])
    pairs = np.sort(piercing_pairs(concatenate(*soups)), axis=1)
    pairs = pairs[(pairs[:, 0] < 300) & (pairs[:, 1] >= 300)] - [0, 300]
    np.testing.assert_array_equal(found, np.unique(pairs @ [300, 1]))
    assert len(found) > 20


@pytest.mark.parametrize("centre", [(10, 0, 0), (10, 3, 4), (5, 0, 0), (0, 0, 9)])
def test_nothing_is_decided_where_faces_lie_in_one_plane(centre):
    with pytest.raises(NotCertain):
        cut(box((10, 10, 10), centre), box((10, 10, 10), (0, 0, 0)), True)


def test_a_surface_that_ends_in_the_other_is_not_cut():
    lattice, wall = PAIRS["a bar through a ball"]
    crossed = seam_of(lattice, wall).facets[0, 0]
    torn = TriangleMesh(lattice.vertices, np.delete(lattice.triangles, crossed, axis=0))
    with pytest.raises(NotCertain):
        cut(torn, wall, True)
    with pytest.raises(NotCertain):
        cut(lattice, TriangleMesh(wall.vertices, wall.triangles[::2]), True)
