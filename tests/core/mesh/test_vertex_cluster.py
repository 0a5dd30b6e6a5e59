# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh for the screen: few triangles that lie where the many do."""

import numpy as np
import pytest

import samples
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh import vertex_cluster
from volfrep.mesh.vertex_cluster import cluster_vertices, is_outside
from volfrep.spatial.proximity import closest_points


@pytest.mark.parametrize("most", [500, 2000, 10_000])
def test_it_has_no_more_triangles_than_allowed_and_not_far_fewer(most):
    mesh = block(LatticeSpec(cell="BCC", cell_size=10.0, strut_radius=1.0), (2, 2, 2)).mesh
    coarse = cluster_vertices(mesh, most)
    assert most / 4 < len(coarse.triangles) <= most


def test_it_lies_where_the_mesh_does():
    mesh = samples.sphere(20.0, 5)
    coarse = cluster_vertices(mesh, 2000)
    spacing = np.sqrt(4 * np.pi * 20.0**2 / 800)
    assert np.abs(coarse.bounds - mesh.bounds).max() < spacing
    assert closest_points(mesh, coarse.vertices)[1].max() < 0.2 * spacing
    assert closest_points(coarse, mesh.vertices)[1].max() < spacing


def test_a_raster_that_is_not_counted_as_a_whole_tells_the_same(monkeypatch):
    whole = cluster_vertices(samples.sphere(20.0, 5), 2000)
    monkeypatch.setattr(vertex_cluster, "CUBES_PER_POINT", 0)
    sparse = cluster_vertices(samples.sphere(20.0, 5), 2000)
    np.testing.assert_array_equal(whole.triangles, sparse.triangles)
    np.testing.assert_array_equal(whole.vertices, sparse.vertices)


def test_a_small_mesh_stays_itself():
    mesh = samples.box()
    assert cluster_vertices(mesh, 12) is mesh


def test_the_outside_is_told_from_cavities():
    solid = samples.box((30.0, 30.0, 30.0))
    part = fill(solid, LatticeSpec(cell="CVC", cell_size=10.0, strut_radius=1.0, shell=2.0))
    volumes = part.mesh.signed_volumes()
    outside = is_outside(part.mesh)
    assert volumes[outside].sum() == pytest.approx(solid.volume)
    assert volumes[~outside].sum() == pytest.approx(part.report.volume_mm3 - solid.volume)


def test_a_lattice_without_skin_has_no_cavity():
    mesh = block(LatticeSpec(cell="BCC", cell_size=10.0, strut_radius=1.0), (1, 1, 1)).mesh
    assert is_outside(mesh).all()
