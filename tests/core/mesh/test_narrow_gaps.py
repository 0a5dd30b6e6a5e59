# SPDX-License-Identifier: LGPL-2.1-or-later
"""A bar that grazes the corner of a groove leaves a tunnel of a few thousandths of a mm."""

import numpy as np
import pytest

from samples import GRAZED_SLOPE, grazed_groove
from volfrep.mesh.narrow_gaps import with_wider_gaps
from volfrep.spatial.self_intersection import crossing_triangles

#: How far the bar is from the corner, mm.
LEFT = 0.002


def at_most(points):
    return np.full(len(points), 0.01)


def no_fault(_, new):
    return np.zeros(len(new), bool)


def moved_rows(before, after):
    return np.flatnonzero((before.vertices != after.vertices).any(axis=1))


def test_a_tunnel_along_a_corner_becomes_wider_and_the_walls_stay():
    mesh = grazed_groove(LEFT)
    wider = with_wider_gaps(mesh, at_most, 0.1, no_fault)
    rows = moved_rows(mesh, wider)
    assert len(rows) == 2
    was, now = mesh.vertices[rows], wider.vertices[rows]
    assert np.linalg.norm(now - was, axis=1) == pytest.approx([0.01, 0.01])
    # Both lie on their walls as before, and are a sixth of a circle apart.
    assert np.abs(now[:, 1]) == pytest.approx(GRAZED_SLOPE * now[:, 0], abs=1e-12)
    assert np.linalg.norm(was[0] - was[1]) == pytest.approx(2.0 * GRAZED_SLOPE * LEFT)
    assert np.linalg.norm(now[0] - now[1]) == pytest.approx(
        2.0 * GRAZED_SLOPE * LEFT + 0.01, rel=1e-3
    )
    assert np.array_equal(mesh.triangles, wider.triangles)
    assert not crossing_triangles(wider, np.ones(len(wider.triangles), bool), 0.0).any()
    # The bar has lost a pyramid, less than its edge's facets by 0.01.
    assert 0.0 < mesh.volume - wider.volume < 0.01 * 2.0**0.5 * 2.0 * 2.0 * GRAZED_SLOPE


def test_what_is_wide_or_has_a_fault_then_stays():
    wide, mesh = grazed_groove(0.02), grazed_groove(LEFT)
    assert with_wider_gaps(wide, at_most, 0.1, no_fault) is wide
    assert with_wider_gaps(mesh, at_most, 5.0, no_fault) is mesh  # the tunnel is not that long
    asked = []

    def all_faulty(part, new):
        asked.append(int(new.sum()))
        return new

    assert with_wider_gaps(mesh, at_most, 0.1, all_faulty) is mesh
    assert len(asked) == 1
    assert asked[0] < len(mesh.triangles)


def test_where_less_is_allowed_nothing_narrow_is_left():
    mesh = grazed_groove(LEFT)
    assert with_wider_gaps(mesh, lambda points: 0.2 * at_most(points), 0.1, no_fault) is mesh


def test_one_corner_that_may_not_go_does_not_hold_the_other():
    mesh = grazed_groove(0.5 * LEFT)
    rows = moved_rows(mesh, with_wider_gaps(mesh, at_most, 0.1, no_fault))

    def find_faults(part, new):
        kept = part.vertices[rows[0]] != mesh.vertices[rows[0]]
        at = (part.triangles == rows[0]).any(axis=1) & ~(part.triangles == rows[1]).any(axis=1)
        return at & new & kept.any()

    assert moved_rows(mesh, with_wider_gaps(mesh, at_most, 0.1, find_faults)).tolist() == [rows[1]]
