# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes cut at the wall: held to slabs solved by hand, Monte Carlo and exact inside tests."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.beam_part import clipped_infill
from volfrep.jobs.blocks import block
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial import rays
from volfrep.spatial.proximity import closest_points
from volfrep.spatial.rays import segment_crossings
from volfrep.trim.clip_struts import clip
from volfrep.util.errors import VolfrepError


def lattice(count=(4, 4, 4), cell="CVC", at=(0.0, 0.0, 0.0)):
    spec = LatticeSpec(cell=cell, cell_size=10, strut_radius=1, resolution=10, origin=at)
    return block(spec, count).wireframe


def lengths(frame):
    start, end = frame.nodes[frame.struts].swapaxes(0, 1)
    return np.linalg.norm(end - start, axis=1)


def inside_box(frame, low, high):
    """Length of each strut inside an axis-parallel box: intervals, axis by axis."""
    start, end = frame.nodes[frame.struts].swapaxes(0, 1)
    along = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        one, two = (low - start) / along, (high - start) / along
    flat = along == 0
    outside = (flat & ((start < low) | (start > high))).any(axis=1)
    first = np.where(flat, -np.inf, np.minimum(one, two)).max(axis=1).clip(0, 1)
    last = np.where(flat, np.inf, np.maximum(one, two)).min(axis=1).clip(0, 1)
    return np.where(outside, 0, np.maximum(last - first, 0)) * np.linalg.norm(along, axis=1)


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", ["CVC", "Box", "Octet"])
def test_cut_at_a_box(cell):
    frame = lattice(cell=cell)
    low, high = np.array([3.1, 5.3, -2.7]), np.array([33.3, 36.9, 27.7])
    clipped = clip(frame, samples.box(tuple(high - low), tuple(low)))
    expected = inside_box(frame, low, high)
    kept = expected[expected > 0.5]  # shorter pieces are dropped
    assert lengths(clipped.wireframe).sum() == pytest.approx(kept.sum(), rel=1e-9)
    assert len(clipped.wireframe.struts) == len(kept)
    walls = clipped.wireframe.nodes[clipped.on_boundary]
    off = np.minimum(np.abs(walls - low), np.abs(walls - high)).min(axis=1)
    is_node = np.isin(walls.round(6), frame.nodes.round(6)).all(axis=1)
    assert (off[~is_node] < 1e-9).all()
    assert (off[is_node] < 0.5).all()  # these lost a short piece to the wall


def test_cut_at_a_curved_wall_with_a_hollow():
    frame = lattice((5, 5, 5))
    centre = np.full(3, 25.3)
    outer, inner = samples.sphere(21.0, 4), samples.sphere(8.0, 4)
    moved = [TriangleMesh(ball.vertices + centre, ball.triangles) for ball in (outer, inner)]
    clipped = clip(frame, concatenate(moved[0], moved[1].reversed()))
    middle = clipped.wireframe.nodes[clipped.wireframe.struts].mean(axis=1)
    distance = np.linalg.norm(middle - centre, axis=1)
    assert (distance < 21.0).all()
    assert (distance > 7.9).all()  # the ball's facets lie inside it
    rng = np.random.default_rng(4)
    strut = rng.integers(0, len(frame.struts), 100_000)
    share = rng.random((len(strut), 1))
    ends = frame.nodes[frame.struts[strut]]
    distance = np.linalg.norm((1 - share) * ends[:, 0] + share * ends[:, 1] - centre, axis=1)
    inside = (distance < 21.0) & (distance > 8.0)
    expected = inside.mean() * lengths(frame).sum()
    assert lengths(clipped.wireframe).sum() == pytest.approx(expected, rel=0.02)


def test_a_lattice_that_the_wall_does_not_touch():
    frame = lattice((2, 2, 2))
    whole = clip(frame, samples.box((100.0, 100.0, 100.0), (-40.0, -40.0, -40.0)))
    assert len(whole.wireframe.struts) == len(frame.struts)
    assert not whole.on_boundary.any()
    nothing = clip(frame, samples.box((5.0, 5.0, 5.0), (100.0, 100.0, 100.0)))
    assert len(nothing.wireframe.struts) == len(nothing.wireframe.nodes) == 0


def test_radii_of_a_cut_cone():
    frame = Wireframe(
        np.array([[0.0, 0, 0], [10, 0, 0]]),
        np.array([[0, 1]], np.int32),
        np.array([[2.0, 1.0]]),
        np.array([2.5, 1.25]),
    )
    clipped = clip(frame, samples.box((6.0, 8.0, 8.0), (2.0, -4.1, -4.2)))
    assert clipped.wireframe.radii == pytest.approx(np.array([[1.8, 1.2]]))
    assert clipped.on_boundary.tolist() == [True, True]
    assert clipped.wireframe.nodes[clipped.wireframe.struts[0]] == pytest.approx(
        np.array([[2.0, 0, 0], [8, 0, 0]])
    )


def test_crossings_agree_with_an_exact_inside_test(monkeypatch):
    mesh = samples.bracket(turn=17)
    rng = np.random.default_rng(1)
    low, high = mesh.bounds
    start, end = rng.uniform(low - 5, high + 5, (2, 4000, 3))
    segment, place, way = segment_crossings(mesh, start, end)
    monkeypatch.setattr(rays, "SEGMENTS_PER_STEP", 999)
    for some, whole in zip(segment_crossings(mesh, start, end), (segment, place, way), strict=True):
        np.testing.assert_array_equal(some, whole)
    is_in = [samples.inside_bracket(points, turn=17).astype(int) for points in (start, end)]
    assert np.array_equal(np.bincount(segment, -way, len(start)), is_in[1] - is_in[0])
    assert (np.diff(place)[np.diff(segment) == 0] > 0).all()
    at = start[segment] + place[:, None] * (end - start)[segment]
    assert closest_points(mesh, at)[1].max() < 1e-9


def test_an_infill_is_cut_at_its_inner_wall():
    spec = LatticeSpec(cell="CVC", cell_size=8, strut_radius=0.8, shell=2, resolution=8)
    solid = samples.box((36.0, 28.0, 20.0))  # its inside measures 4 x 3 x 2 cells
    clipped = clipped_infill(solid, spec)
    frame = clipped.wireframe
    assert (frame.nodes > 2 - 1e-6).all()
    assert (frame.nodes < np.array([34, 26, 18]) + 1e-6).all()
    # Wherever a window of whole cells lies, it holds the same length of struts.
    assert lengths(frame).sum() == pytest.approx(24 * 8 * np.sqrt(3) / 2 * 8, rel=0.01)
    low, high = np.full(3, 2.0), np.array([34.0, 26.0, 18.0])
    off = np.minimum(frame.nodes - low, high - frame.nodes).min(axis=1)
    assert np.array_equal(off < 1e-5, clipped.on_boundary)


def test_struts_still_meet_where_the_wall_goes_through_their_joint():
    spec = LatticeSpec(cell="CVC", cell_size=20, strut_radius=2, shell=0, resolution=8)
    clipped = clipped_infill(samples.box((60.0, 40.0, 20.0)), spec)
    frame = clipped.wireframe
    whole = block(spec, (3, 2, 1)).wireframe
    assert len(frame.nodes) == len(whole.nodes)
    assert len(frame.struts) == len(whole.struts)
    # The corners of the cells lie in the box's surface, the middles inside.
    assert np.array_equal(clipped.on_boundary, np.bincount(frame.struts.ravel()) < 8)


def test_nothing_inside():
    spec = LatticeSpec(cell="Box", cell_size=10, strut_radius=1, shell=2, resolution=8)
    with pytest.raises(VolfrepError, match="No strut's axis"):
        clipped_infill(samples.box((10.0, 10.0, 10.0)), spec)
