# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is taken away from a trimmed mesh because it hangs on nothing, or is too small."""

import pytest

import samples
from contract import assert_same_quality
from volfrep.mesh import quality
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.trim.loose_pieces import clear
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.progress import Monitor


def _ball(radius, centre):
    ball = samples.sphere(radius, 2)
    return TriangleMesh(ball.vertices + centre, ball.triangles)


def cleared_of(mesh, smallest, **rules):
    cleared = clear(TrimmedSurface(mesh), smallest, Monitor(), **rules)
    assert_same_quality(cleared.quality, quality.measure(cleared.surface.mesh))
    return cleared


def test_pieces_that_float_in_a_cavity_go_with_the_voids_in_them():
    cavity = samples.sphere(20.0).reversed()
    loose = concatenate(_ball(3.0, (5, 0, 0)), _ball(1.0, (5, 0, 0)).reversed())
    bubble = _ball(1.0, (-15, 0, 0)).reversed()
    cleared = cleared_of(concatenate(cavity, loose, bubble), 0.01, floating=True)
    assert cleared.pieces_removed == 1
    assert quality.measure(cleared.surface.mesh).shells == 2
    assert cleared.surface.mesh.volume == pytest.approx(cavity.volume + bubble.volume)


def test_without_a_skin_the_largest_body_stays():
    meshes = [_ball(3.0, (0, 0, 0)), _ball(6.0, (20, 0, 0)), _ball(2.0, (40, 0, 0))]
    cleared = cleared_of(concatenate(*meshes), 0.01, bodies=1)
    assert cleared.pieces_removed == 2
    assert cleared.surface.mesh.volume == pytest.approx(meshes[1].volume)


def test_specks_are_removed_and_counted_apart():
    cleared = cleared_of(concatenate(_ball(5.0, (0, 0, 0)), _ball(0.1, (20, 0, 0))), 0.1)
    assert (cleared.pieces_removed, cleared.specks_removed) == (0, 1)


def test_where_nothing_is_too_small_everything_stays():
    mesh = concatenate(_ball(5.0, (0, 0, 0)), _ball(1.0, (20, 0, 0)))
    assert cleared_of(mesh, 0.1).surface.mesh is mesh


def test_a_mesh_with_a_hole_is_measured_anew():
    ball = _ball(5.0, (0, 0, 0))
    holed = TriangleMesh(ball.vertices, ball.triangles[1:])
    cleared = cleared_of(concatenate(holed, _ball(0.1, (20, 0, 0))), 0.1)
    assert cleared.specks_removed == 1
    assert not cleared.quality.watertight
