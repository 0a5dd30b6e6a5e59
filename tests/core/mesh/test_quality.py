# SPDX-License-Identifier: LGPL-2.1-or-later
"""The measure against shapes whose figures are known in closed form."""

import math
import threading

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from contract import assert_same_quality
from volfrep.mesh.quality import (
    inspect,
    measure,
    quality_after_moves,
    shape_statistics,
    subtract_shells,
)
from volfrep.mesh.topology import pinched_vertices
from volfrep.mesh.triangle_mesh import TriangleMesh, compact, concatenate, empty_mesh
from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor


def mesh_of(shape: trimesh.Trimesh) -> TriangleMesh:
    return TriangleMesh(
        np.array(shape.vertices, float), np.array(shape.faces).astype(np.int32, order="C")
    )


def box(side: float = 2.0, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> TriangleMesh:
    mesh = mesh_of(trimesh.creation.box((side, side, side)))
    return TriangleMesh(mesh.vertices + np.array(at), mesh.triangles)


def torus() -> TriangleMesh:
    return mesh_of(trimesh.creation.torus(5.0, 1.0, major_sections=64, minor_sections=32))


def test_a_box() -> None:
    quality = measure(box())
    assert quality.watertight
    assert (quality.triangles, quality.vertices) == (12, 8)
    assert (quality.shells, quality.bodies, quality.voids, quality.genus) == (1, 1, 0, 0)
    assert quality.volume == pytest.approx(8.0)
    assert quality.area == pytest.approx(24.0)
    assert quality.bounds.tolist() == [[-1, -1, -1], [1, 1, 1]]
    assert quality.degenerate_triangles == 0


def test_a_box_far_away_keeps_its_volume() -> None:
    assert measure(box(at=(1e6, -1e6, 1e6))).volume == pytest.approx(8.0, rel=1e-9)


def test_a_torus_has_one_hole() -> None:
    quality = measure(torus())
    assert (quality.genus, quality.bodies, quality.watertight) == (1, 1, True)
    assert quality.volume == pytest.approx(2 * math.pi**2 * 5, rel=0.01)


def test_bodies_and_voids_and_genus_add_up() -> None:
    hollow = concatenate(box(4.0), box(1.0).reversed())
    quality = measure(concatenate(hollow, box(2.0, (9, 0, 0)), torus(), torus().reversed()))
    assert (quality.shells, quality.bodies, quality.voids) == (5, 3, 2)
    assert quality.genus == 2
    assert quality.watertight
    assert measure(hollow).volume == pytest.approx(63.0)


def test_what_stays_has_the_quality_of_the_whole_less_what_goes() -> None:
    stays = concatenate(box(4.0), box(1.0).reversed(), torus())
    goes = concatenate(box(0.5, (20, 0, 0)), torus().reversed())
    rest = subtract_shells(
        measure(concatenate(stays, goes)), measure(goes), stays.bounds, np.array([64.0, -1.0, 1.0])
    )
    assert_same_quality(rest, measure(stays))


def test_an_open_box() -> None:
    whole = box()
    quality = measure(TriangleMesh(whole.vertices, whole.triangles[:-1]))
    assert not quality.watertight
    assert (quality.open_edges, quality.overused_edges, quality.misoriented_edges) == (3, 0, 0)
    assert quality.genus == -1


def test_one_triangle_turned_over() -> None:
    triangles = box().triangles.copy()
    triangles[0] = triangles[0, ::-1]
    quality = measure(TriangleMesh(box().vertices, triangles))
    assert not quality.watertight
    assert (quality.open_edges, quality.overused_edges, quality.misoriented_edges) == (0, 0, 3)


def test_a_doubled_triangle() -> None:
    triangles = np.concatenate([box().triangles, box().triangles[:1]])
    quality = measure(TriangleMesh(box().vertices, triangles))
    assert (quality.watertight, quality.overused_edges, quality.open_edges) == (False, 3, 0)


def test_two_boxes_that_share_an_edge() -> None:
    pair = concatenate(box(2.0), box(2.0, (2.0, 2.0, 0.0)))
    points, index = np.unique(pair.vertices, axis=0, return_inverse=True)
    joined = TriangleMesh(points, index.ravel()[pair.triangles].astype(np.int32))
    quality = measure(joined)
    assert (quality.watertight, quality.overused_edges) == (False, 1)


def test_a_triangle_without_area_is_counted() -> None:
    flat = TriangleMesh(
        np.array([[0, 0, 0], [1, 0, 0], [3, 0, 0]], float), np.array([[0, 1, 2]], np.int32)
    )
    assert measure(flat).degenerate_triangles == 1


def test_a_repeated_vertex_is_not_watertight() -> None:
    mesh = box()
    extra = np.array([[0, 0, 1]], np.int32)
    quality = measure(TriangleMesh(mesh.vertices, np.concatenate([mesh.triangles, extra])))
    assert quality.degenerate_triangles == 1
    assert not quality.watertight


def test_unused_vertices_do_not_count() -> None:
    mesh = box()
    points = np.concatenate([[[900.0, 0, 0]], mesh.vertices, [[0, 900.0, 0]]])
    quality = measure(TriangleMesh(points, mesh.triangles + np.int32(1)))
    assert (quality.vertices, quality.shells, quality.genus) == (8, 1, 0)
    assert quality.bounds.tolist() == [[-1, -1, -1], [1, 1, 1]]


def test_nothing() -> None:
    quality = measure(empty_mesh())
    assert (quality.triangles, quality.watertight, quality.bodies) == (0, False, 0)
    with pytest.raises(ValueError, match="without triangles"):
        shape_statistics(empty_mesh())


@pytest.mark.costly
def test_more_triangles_than_a_block() -> None:
    sphere = mesh_of(trimesh.creation.icosphere(subdivisions=7))
    assert len(sphere.triangles) > 300_000
    quality = measure(sphere)
    assert (quality.watertight, quality.bodies, quality.genus) == (True, 1, 0)
    assert quality.volume == pytest.approx(4 / 3 * math.pi, rel=1e-3)
    assert quality.area == pytest.approx(4 * math.pi, rel=1e-3)
    assert pinched_vertices(sphere) == 0
    # By way of trimesh's own angles.
    shape = trimesh.Trimesh(sphere.vertices, sphere.triangles, process=False)
    angle = np.degrees(shape.face_angles.min())
    assert shape_statistics(sphere).smallest_angle == pytest.approx(angle)


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_the_order_of_vertices_and_triangles_does_not_matter(seed: int) -> None:
    generator = np.random.default_rng(seed)
    mesh = concatenate(torus(), box(20.0))
    shuffle = generator.permutation(len(mesh.vertices))
    points = np.empty_like(mesh.vertices)
    points[shuffle] = mesh.vertices
    triangles = shuffle[mesh.triangles][generator.permutation(len(mesh.triangles))]
    triangles = np.roll(triangles, generator.integers(3), axis=1).astype(np.int32)
    quality, expected = measure(TriangleMesh(points, triangles)), measure(mesh)
    assert quality.watertight
    assert (quality.bodies, quality.genus) == (expected.bodies, expected.genus) == (2, 1)
    assert quality.volume == pytest.approx(expected.volume)


@settings(max_examples=30)
@given(st.sets(st.integers(0, 1151), min_size=1, max_size=6))
def test_any_missing_triangle_is_seen(missing: set[int]) -> None:
    whole = mesh_of(trimesh.creation.torus(5.0, 1.0, major_sections=24, minor_sections=24))
    assert len(whole.triangles) == 1152
    rest = np.delete(whole.triangles, sorted(missing), axis=0)
    quality = measure(TriangleMesh(whole.vertices, rest))
    assert not quality.watertight
    assert 3 <= quality.open_edges <= 3 * len(missing)


def test_shape_of_known_triangles() -> None:
    equilateral = TriangleMesh(
        np.array([[0, 0, 0], [1, 0, 0], [0.5, math.sqrt(0.75), 0]]), np.array([[0, 1, 2]], np.int32)
    )
    shape = shape_statistics(equilateral)
    assert shape.smallest_angle == pytest.approx(60.0)
    assert shape.radius_ratio_mean == pytest.approx(1.0)
    assert shape.radius_ratio_deviation == pytest.approx(0.0, abs=1e-7)
    assert shape.area_ratio_mean == pytest.approx(math.sqrt(0.75))
    # Sides 3, 4, 5: inradius 1, circumradius 2.5.
    right = TriangleMesh(
        np.array([[0, 0, 0], [3, 0, 0], [0, 4, 0]], float), np.array([[0, 1, 2]], np.int32)
    )
    shape = shape_statistics(right)
    assert shape.smallest_angle == pytest.approx(math.degrees(math.atan(3 / 4)))
    assert shape.radius_ratio_mean == pytest.approx(0.8)
    assert shape.area_mean == pytest.approx(6.0)
    both = shape_statistics(concatenate(equilateral, right))
    assert both.radius_ratio_mean == pytest.approx(0.9)
    assert both.radius_ratio_deviation == pytest.approx(0.1)
    assert both.radius_ratio_min == pytest.approx(0.8)


def test_two_boxes_tip_to_tip_are_pinched() -> None:
    pair = concatenate(box(2.0), box(2.0, (2.0, 2.0, 2.0)))
    points, index = np.unique(pair.vertices, axis=0, return_inverse=True)
    joined = TriangleMesh(points, index.ravel()[pair.triangles].astype(np.int32))
    assert len(points) == 15
    assert measure(joined).watertight  # by its edges alone
    assert pinched_vertices(joined) == 1
    assert pinched_vertices(compact(box())) == 0


def test_many_pinched_vertices_over_several_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("volfrep.mesh.topology.BLOCK_VERTICES", 7)
    chain = concatenate(*(box(2.0, (2.0 * k, 2.0 * k, 2.0 * k)) for k in range(6)))
    points, index = np.unique(chain.vertices, axis=0, return_inverse=True)
    assert pinched_vertices(TriangleMesh(points, index.ravel()[chain.triangles])) == 5


def test_measuring_can_be_cancelled(monkeypatch: pytest.MonkeyPatch) -> None:
    held = threading.Event()

    def slow(*_: object) -> None:
        held.wait(30)

    monkeypatch.setattr("volfrep.mesh.quality.edge_uses", slow)
    with pytest.raises(Cancelled):
        measure(torus(), Monitor(lambda fraction, stage: False))
    held.set()


def moved_a_little(mesh: TriangleMesh, way: float) -> TriangleMesh:
    """Every ninth vertex elsewhere by a part of the way along each axis, mm."""
    vertices = mesh.vertices.copy()
    some = np.arange(0, len(vertices), 9)
    vertices[some] += np.random.default_rng(0).uniform(-way, way, (len(some), 3))
    return TriangleMesh(vertices, mesh.triangles)


def test_vertices_that_move_a_little_change_what_they_touch() -> None:
    before = concatenate(torus(), box(3.0, (20.0, 0.0, 0.0)))
    after, found = moved_a_little(before, 0.01), inspect(before)
    least = float(np.abs(found.volume).min())
    told = quality_after_moves(found.quality, before, after, after.bounds, least)
    assert told is not None
    assert told.volume != found.quality.volume
    assert_same_quality(told, measure(after))


def test_vertices_that_stay_change_nothing() -> None:
    mesh = torus()
    quality = measure(mesh)
    same = quality_after_moves(quality, mesh, mesh, mesh.bounds, 1.0)
    assert same is not None
    assert_same_quality(same, quality)


def test_a_shell_that_may_have_turned_inside_out_is_not_told_by_a_look_at_moves() -> None:
    mesh = concatenate(torus(), box(0.01))
    found = inspect(mesh)
    least = float(np.abs(found.volume).min())
    after = moved_a_little(mesh, 0.01)
    assert quality_after_moves(found.quality, mesh, after, after.bounds, least) is None
