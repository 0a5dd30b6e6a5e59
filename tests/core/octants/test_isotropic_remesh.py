# SPDX-License-Identifier: LGPL-2.1-or-later
"""Marching cubes' surface becomes even triangles on the exact surface, edges on its creases."""

import numpy as np
import pytest

from implicit import octant_surface
from samples import SKEW
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.mesh import remesh
from volfrep.octants import isotropic_remesh
from volfrep.octants.sdf import distances

CELLS = [*map(find_cell, PAPERS), SKEW]


@pytest.fixture(params=CELLS, ids=lambda cell: cell.name, scope="module")
def pair(request):
    """The raw surface of an octant, the even one, and where its vertices come from."""
    raw = octant_surface(request.param)
    return raw, *isotropic_remesh.remesh_evenly(raw)


def angles(surface):
    """(m,) smallest angle of each triangle, degrees."""
    corners = surface.vertices[surface.triangles]
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    a, b, c = sides.T
    cosines = [(b**2 + c**2 - a**2) / (2 * b * c), (a**2 + c**2 - b**2) / (2 * a * c),
               (a**2 + b**2 - c**2) / (2 * a * b)]  # fmt: skip
    return np.degrees(np.arccos(np.clip(cosines, -1, 1))).min(axis=0)


def euler(surface):
    used = np.unique(surface.triangles)
    table = remesh.edges(surface.triangles, len(surface.vertices))
    return len(used) - len(table.ends) + len(surface.triangles)


@pytest.mark.slow_but("CVC", "Box")
def test_the_vertices_lie_on_the_exact_surface(pair):
    _, found, _ = pair
    values = np.abs(found.field.values(found.vertices))
    assert values.max() < 1e-3 * found.edge


def test_slivers_are_gone_and_triangles_are_fewer(pair):
    raw, found, _ = pair
    assert len(found.triangles) < len(raw.triangles)
    assert np.percentile(angles(raw), 1) < 5.0
    assert np.percentile(angles(found), 1) > 15.0
    assert np.median(angles(found)) > 45.0


def test_the_surface_stays_what_it_was(pair):
    """As many holes, and its border in the octant's faces."""
    raw, found, origin = pair
    assert euler(found) == euler(raw)
    np.testing.assert_array_equal(found.place, raw.place[origin])
    pinned = found.pinned
    np.testing.assert_array_equal(found.vertices[pinned], raw.vertices[origin][pinned])
    table = remesh.edges(found.triangles, len(found.vertices))
    ends = table.ends[table.triangles[:, 1] < 0]
    assert found.share_face(ends[:, 0], ends[:, 1]).all()


def test_every_vertex_of_the_border_is_kept(pair):
    raw, found, _ = pair
    assert found.pinned.any(axis=1).sum() == raw.pinned.any(axis=1).sum()


def test_creases_have_vertices_that_lie_on_both_their_primitives(pair):
    _, found, _ = pair
    rows = np.flatnonzero(found.held[:, 1] >= 0)
    assert len(rows) > 5
    for column in (0, 1):
        off = distances(found.vertices[rows], found.field.primitives.take(found.held[rows, column]))
        np.testing.assert_allclose(off, 0.0, atol=1e-3 * found.edge)


def test_nothing_comes_of_nothing():
    whole = octant_surface(LIBRARY["Box"])
    none = type(whole)(
        whole.vertices[:0], whole.triangles[:0], whole.place[:0], whole.held[:0],
        whole.field.rows(np.zeros(0, np.int64)), whole.edge, whole.step,
        whole.piece[:0], whole.size,
    )  # fmt: skip
    found, origin = isotropic_remesh.remesh_evenly(none)
    assert len(found.triangles) == len(origin) == 0
