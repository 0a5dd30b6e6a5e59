# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets that would run through each other in a file, where a surface turns back on itself."""

import manifold3d
import numpy as np
import pytest

import samples
from volfrep.design.grading import CellMap, SizeGrading
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.io.write.stl import as_read
from volfrep.jobs.infill import Infill
from volfrep.mesh.precision import decimal_step, merging_vertices
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial import resolve_crossings
from volfrep.spatial.piercing import piercing_pairs
from volfrep.spatial.resolve_crossings import find_folds, resolve_fold_crossings, turning
from volfrep.util.progress import Monitor


def lens(dent, thin=2e-4):
    """A flat lens of 20 whose rim is a knife's edge; a vertex next to it goes through by `dent`.

    Its facets are `thin` mm apart 1 mm from the rim.
    """
    profile = np.array([(0.0, -3.0), (6.0, -2.0), (9.0, -0.5), (10.0, 0.0), (9.0, 0.5),
                        (6.0, 2.0), (0.0, 3.0)]) * (1.0, thin)  # fmt: skip
    made = manifold3d.CrossSection([profile]).revolve(64).to_mesh64()
    vertices = np.array(made.vert_properties)[:, :3]
    above = np.isclose(np.hypot(*vertices[:, :2].T), 9.0) & (vertices[:, 2] > 0.0)
    vertices[np.flatnonzero(above)[5], 2] = -0.5 * thin - dent if dent else 0.5 * thin
    return TriangleMesh(vertices, np.asarray(made.tri_verts, np.int32))


def test_the_rim_of_a_lens_turns_back_and_the_rest_does_not():
    mesh = lens(0.0)
    reach = np.hypot(*mesh.vertices[:, :2].T)[mesh.triangles]
    found = find_folds(mesh)
    assert found[reach.max(axis=1) > 9.9].all()
    assert not found[reach.max(axis=1) < 8.9].any()
    assert not find_folds(samples.box()).any()


def test_a_rim_that_no_rounding_closes_is_a_fold_of_what_is_deformed_only():
    """A wall along flat struts makes two such rims on each, a fifth of all facets beside them."""
    open_by_far = lens(0.0, thin=0.1)
    assert not find_folds(open_by_far).any()
    assert find_folds(open_by_far, deformed=True).any()


def test_a_wall_makes_no_fold_of_deformed_struts_where_no_rounding_closes_the_rim():
    """Whether one of its sides or both are a wall's; a rim that rounding closes is one with it."""
    for thin, closes in ((0.1, False), (2e-4, True)):
        mesh = lens(0.0, thin)
        step = decimal_step(mesh.vertices)
        above = mesh.vertices[mesh.triangles][:, :, 2].sum(axis=1) > 0.0
        assert len(turning(mesh, True, step, np.zeros(len(above), bool)))
        for at_wall in (above, ~above, above | ~above):
            assert bool(len(turning(mesh, True, step, at_wall))) == closes


def test_a_rim_that_runs_through_itself_is_drawn_apart():
    mesh = lens(4e-5)
    straight, place = resolve_fold_crossings(mesh, Monitor())
    assert len(piercing_pairs(as_read(mesh)))
    assert not len(piercing_pairs(as_read(straight)))
    assert place is None
    assert np.array_equal(straight.triangles, mesh.triangles)
    assert straight.volume == pytest.approx(lens(0.0).volume, rel=0.02)


def test_no_vertex_comes_to_lie_where_another_is(monkeypatch):
    """A reader takes two for one, and finds edges of four triangles where they are a sheet's."""

    def onto_first(mesh, rows, triangles):
        return mesh.vertices[rows[:1]] - mesh.vertices[rows]

    monkeypatch.setattr(resolve_crossings, "_to_neighbours", onto_first)
    monkeypatch.setattr(resolve_crossings, "SHARES", (1.0, 0.01))
    straight, _ = resolve_fold_crossings(lens(4e-5), Monitor())
    assert not len(merging_vertices(straight))


def test_nothing_moves_where_nothing_crosses():
    ball = samples.sphere()
    assert resolve_fold_crossings(ball, Monitor())[0] is ball


def test_what_only_grazes_is_drawn_apart_by_a_hair_in_a_deformed_mesh_too():
    """With as much as folds need, corners of large facets went through others by 0.2 mm."""
    mesh = lens(1e-6, thin=0.1)
    assert len(piercing_pairs(as_read(mesh)))
    straight, place = resolve_fold_crossings(mesh, Monitor(), deformed=True)
    assert not len(piercing_pairs(as_read(straight)))
    assert place is None
    assert np.abs(straight.vertices - mesh.vertices).max() < 1e-3


GRADED = LatticeSpec(
    "Box", 9.0, 1.45, shell=1.0, resolution=8, cell_map=CellMap("cylindrical")
)  # fmt: skip


@pytest.mark.slow
def test_struts_without_room_about_an_axis_do_not_run_through_each_other():
    """140 pairs of facets crossed here before."""
    result = Infill(samples.box((30.0, 24.0, 20.0)), GRADED).result
    assert not len(piercing_pairs(as_read(result.mesh)))
    assert not any("run through each other" in sentence for sentence in result.report.warnings)


FOLDED = LatticeSpec(
    "Box", 10.0, 1.16, shell=0.0, boundary="whole", resolution=12,
    size_grading=SizeGrading(Profile("linear", 1.0, 0.65), (0.6, 0.6, 1.3)),
)  # fmt: skip


@pytest.mark.slow
def test_struts_that_fold_without_turning_back_wholly_are_drawn_apart():
    """25 pairs of facets crossed here, at edges that turn by 110 to 150 degrees."""
    result = Infill(samples.box((24.0, 20.0, 14.0)), FOLDED).result
    assert not len(piercing_pairs(as_read(result.mesh)))


def test_deformed_balls_that_meet_where_nothing_turns_back_are_drawn_apart():
    """Struts of different joints do: 86 pairs of facets crossed in a part, and nobody told."""
    one, two = samples.sphere(10.0, 3), samples.sphere(10.0, 3)
    shifted = TriangleMesh(two.vertices + np.array([19.6, 3.1, 1.7]), two.triangles)
    mesh = concatenate(one, shifted)
    assert not find_folds(mesh, deformed=True).any()
    assert len(piercing_pairs(as_read(mesh)))
    straight, place = resolve_fold_crossings(mesh, Monitor(), deformed=True)
    assert not len(piercing_pairs(as_read(straight)))
    assert place is None
    assert np.abs(straight.vertices - mesh.vertices).max() < 1.0


@pytest.mark.slow
def test_what_cannot_be_drawn_apart_is_told_with_its_place(monkeypatch):
    monkeypatch.setattr(resolve_crossings, "FOLDED_SHARES", ())
    monkeypatch.setattr(resolve_crossings, "SHARES", ())
    told = " ".join(Infill(samples.box((24.0, 20.0, 14.0)), FOLDED).result.report.warnings)
    assert "Near (" in told
    assert "facets run through each other" in told
