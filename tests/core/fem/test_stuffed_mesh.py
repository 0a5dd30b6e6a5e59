# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetrahedra cut from a lattice: none is flat, whatever triangles the surface has."""

import numpy as np
import pytest

import samples
from volfrep.fem import stuffed_mesh as stuffing
from volfrep.fem.stuffed_mesh import bodies_of, face_pairs, signed_volumes, stuffed_mesh
from volfrep.mesh.brep import faceted_brep
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial.proximity import closest_points
from volfrep.util.errors import VolfrepError
from volfrep.util.progress import Monitor

#: The least found in millions of tetrahedra of parts was 0.17, of a regular one it is 1.
LEAST_SHAPE = 0.15


def shapes(points, corners):
    """Of each tetrahedron its volume over that of a regular one with edges as long."""
    place = points[corners]
    edges = place[:, [0, 0, 0, 1, 1, 2]] - place[:, [1, 2, 3, 2, 3, 3]]
    length = np.sqrt(np.einsum("ijk,ijk->i", edges, edges) / 6.0)
    return 6.0 * np.sqrt(2.0) * signed_volumes(points, corners) / length**3


def outside(points, corners):
    return TriangleMesh(points, face_pairs(corners)[1].astype(np.int32))


def turned(mesh, angle):
    """About an axis of no special direction."""
    axis = np.array([[0.0, -0.8, 0.5], [0.8, 0.0, -0.33], [-0.5, 0.33, 0.0]])
    axis /= np.linalg.norm([0.33, 0.5, 0.8])
    turn = np.eye(3) + np.sin(angle) * axis + (1.0 - np.cos(angle)) * axis @ axis
    return TriangleMesh(mesh.vertices @ turn.T, mesh.triangles)


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("edge", [0.7, 1.1])
def test_no_tetrahedron_is_flat_and_the_outside_is_a_closed_surface_upon_the_mesh(angle, edge):
    box = turned(samples.box((8.0, 5.0, 3.0)), angle)
    points, corners = stuffed_mesh(box, edge, Monitor())
    assert shapes(points, corners).min() > LEAST_SHAPE
    surface = outside(points, corners)
    assert faceted_brep(surface).bodies == 1, "every edge has two facets"
    used = points[np.unique(surface.triangles)]
    assert closest_points(box, used)[1].max() < 1e-9
    # Edges are rounded by less than the lattice's, faces are kept.
    assert closest_points(surface, box.vertices)[1].max() < edge
    assert surface.volume == pytest.approx(signed_volumes(points, corners).sum())
    # Its edges, 64 mm in all, lose no more than a chamfer of that.
    assert -0.1 < 120.0 - surface.volume < 64.0 * 0.3 * edge**2
    assert bodies_of(corners)[0] == 1


def test_a_ball_is_the_nearer_the_finer_the_lattice_with_the_square_of_it():
    ball = samples.sphere(5.0, 4)
    lost = []
    for edge in (1.6, 0.8):
        points, corners = stuffed_mesh(ball, edge, Monitor())
        assert shapes(points, corners).min() > LEAST_SHAPE
        lost.append(1.0 - signed_volumes(points, corners).sum() / ball.volume)
    assert 0.0 < lost[1] < lost[0] / 3.0 < 0.012


def test_needles_in_the_surface_change_nothing():
    """A facet of a box divided into slivers of a millionth of its width."""
    box = samples.box((6.0, 5.0, 4.0))
    points, triangles = box.vertices, box.triangles.astype(np.int64)
    a, b, c = triangles[0]
    along = np.array([0.4, 0.4 + 1e-7, 0.4 + 2e-7])[:, None]
    fresh = len(points) + np.arange(3)
    inner = points[a] * (1 - along) * 0.5 + points[b] * along * 0.5 + points[c] * 0.5
    p, q, r = fresh
    fan = [[a, b, p], [b, q, p], [b, r, q], [b, c, r], [c, p, r], [c, a, p], [p, q, r]]
    needles = TriangleMesh(
        np.concatenate([points, inner]), np.concatenate([triangles[1:], fan]).astype(np.int32)
    )
    assert needles.volume == pytest.approx(120.0)
    plain, sharp = (stuffed_mesh(mesh, 0.9, Monitor()) for mesh in (box, needles))
    assert np.array_equal(plain[1], sharp[1])
    assert np.abs(plain[0] - sharp[0]).max() < 1e-9


def test_a_room_inside_stays_and_bodies_stay_apart():
    room = samples.box((3.0, 3.0, 3.0))
    room = TriangleMesh(room.vertices + 2.5, room.triangles[:, ::-1])
    hollow = concatenate(samples.box((8.0, 8.0, 8.0)), room)
    both = concatenate(hollow, samples.box((3.0, 3.0, 3.0), (20.0, 0.0, 0.0)))
    points, corners = stuffed_mesh(both, 0.8, Monitor())
    assert bodies_of(corners)[0] == 2
    assert signed_volumes(points, corners).sum() == pytest.approx(512.0, rel=0.02)


def test_what_touches_in_an_edge_has_nodes_of_its_own_and_crumbs_go():
    points = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], float)
    hinge = np.array([[0, 2, 3, 1], [0, 4, 5, 1]])
    apart, corners = stuffing._without_hinges(points, hinge)
    assert len(apart) == 8
    assert len(np.unique(corners)) == 8
    assert np.array_equal(apart[corners], points[hinge])
    small = points.copy()
    small[4:] *= 0.01
    rest, corners = stuffing._without_hinges(small, hinge)
    assert len(corners) == 1
    assert np.array_equal(rest[corners], small[hinge[:1]])


def test_prisms_of_which_the_sides_diagonals_run_round_have_a_point_inside(monkeypatch):
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], float)
    low, high = np.array([[0, 1, 2]]), np.array([[3, 4, 5]])
    for number in range(8):
        ways = iter([bool(number >> k & 1) for k in range(3)])
        monkeypatch.setattr(stuffing, "_is_first", lambda *_, w=ways: np.array([next(w)]))
        middles, pieces = stuffing._prisms(points, low, high)
        corners = np.concatenate(pieces)
        volumes = np.abs(signed_volumes(np.concatenate([points, middles]), corners))
        assert volumes.sum() == pytest.approx(0.5)
        assert volumes.min() > 0.01
        assert (len(middles), len(corners)) == ((1, 8) if number in (0, 7) else (0, 3))


def test_limits(monkeypatch):
    box = samples.box((1.0, 1.0, 1.0))
    tiny = TriangleMesh(box.vertices * 1e-3, box.triangles)
    assert len(stuffed_mesh(tiny, 1.0, Monitor())[1]) == 0
    monkeypatch.setattr(stuffing, "MOST_CUBES", 1000)
    with pytest.raises(VolfrepError, match=r"cubes \(the limit is 1,000\)"):
        stuffed_mesh(box, 0.01, Monitor())
