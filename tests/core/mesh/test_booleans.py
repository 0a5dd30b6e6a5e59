# SPDX-License-Identifier: LGPL-2.1-or-later
"""Closed meshes cut by manifold3d, and the way there and back."""

import manifold3d
import numpy as np
import pytest

import samples
from volfrep import TriangleMesh, VolfrepError
from volfrep.mesh.booleans import difference, from_library, intersection, to_library
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import compact


def test_a_mesh_comes_back_as_it_went():
    mesh = samples.sphere(10.0, 2)
    back = from_library(to_library(mesh))
    np.testing.assert_array_equal(back.vertices, mesh.vertices)
    np.testing.assert_array_equal(back.triangles, mesh.triangles)
    assert back.triangles.dtype == np.int32


def test_what_is_cut_and_what_is_common_make_up_the_whole():
    box, ball = samples.box((20.0, 20.0, 20.0)), samples.sphere(12.0)
    rest, common = difference(box, ball), intersection(box, ball)
    for mesh in (rest, common):
        assert measure(mesh).watertight
    assert rest.volume + common.volume == pytest.approx(box.volume)
    nothing = difference(box, samples.box((30.0, 30.0, 30.0), (-5.0, -5.0, -5.0)))
    assert len(nothing.triangles) == 0


def test_vertices_that_the_library_doubles_are_one():
    """A box of facets of their own, with the list of which corners are the same."""
    box = samples.box()
    corners = box.triangles.ravel()
    loose = manifold3d.Mesh64(
        box.vertices[corners],
        np.arange(len(corners), dtype=np.uint64).reshape(-1, 3),
        merge_from_vert=np.arange(len(corners), dtype=np.uint64),
        merge_to_vert=np.unique(corners, return_index=True)[1][corners].astype(np.uint64),
    )
    welded = from_library(loose)
    assert len(np.unique(welded.triangles)) == len(box.vertices)
    assert measure(compact(welded)).watertight


def test_a_surface_that_is_no_solid_is_refused():
    box = samples.box()
    with pytest.raises(VolfrepError, match="repair the part"):
        difference(TriangleMesh(box.vertices, box.triangles[1:]), box)
