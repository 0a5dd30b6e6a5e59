# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets are divided where they stray: in the creases where struts meet, and not along struts."""

import numpy as np
import pytest

from implicit import octant_surface
from volfrep.design.cells import LIBRARY
from volfrep.octants import octant_mesh, sdf
from volfrep.octants.octant import ALL_ACTIVE, OctantKey, octant_primitives
from volfrep.octants.octant_mesh import mesh_octants
from volfrep.octants.octant_spec import OctantSpec
from volfrep.octants.refinement import split_where_it_strays
from volfrep.util.progress import Monitor

KEY = OctantKey(0, ALL_ACTIVE)
#: Barycentric coordinates of 45 points of a triangle.
WITHIN = np.array([(i, j, 8 - i - j) for i in range(9) for j in range(9 - i)]) / 8.0


def octant_of(name, facets=15):
    return mesh_octants(LIBRARY[name], OctantSpec(10.0, 1.0, 0.0, facets), [KEY], Monitor())[KEY]


def strays(name, octant):
    """(m, 45) distances of points of the facets from struts and joints, mm; (m,) areas."""
    primitives = octant_primitives(LIBRARY[name], KEY, 10.0, 1.0, 20.0)
    corners = octant.vertices[octant.triangles]
    points = np.einsum("qi,mik->mqk", WITHIN, corners)
    far = sdf.distances(points[:, :, None], primitives).min(axis=2)
    sides = corners[:, 1:] - corners[:, :1]
    return np.abs(far), 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)


@pytest.mark.parametrize("name", ["BCC", "FCC", "Octet", "Octahedron", "CVC"])
def test_facets_keep_the_deviation_in_creases_too(name):
    deviation = OctantSpec(10.0, 1.0, 0.0, 15).deviation
    assert deviation == pytest.approx(0.0278, rel=1e-2)
    far, area = strays(name, octant_of(name))
    beyond = ((far > 1.5 * deviation).mean(axis=1) * area).sum() / area.sum()
    assert far.max() < 2.5 * deviation
    assert beyond < 0.006


@pytest.mark.parametrize("name", ["FCC", "Octet", "Octahedron"])
def test_as_many_even_facets_stray_farther(monkeypatch, name):
    refined = octant_of(name)
    monkeypatch.setattr(octant_mesh, "REFINEMENTS", 0)
    even = octant_of(name, 18)
    assert len(even.triangles) >= len(refined.triangles)
    assert strays(name, refined)[0].max() < 0.8 * strays(name, even)[0].max()


def test_the_border_stays_as_the_octant_beyond_has_it(monkeypatch):
    refined = octant_of("Octet")
    monkeypatch.setattr(octant_mesh, "REFINEMENTS", 0)
    even = octant_of("Octet")
    assert len(refined.triangles) > len(even.triangles)
    for one, two in ((refined, even), (even, refined)):
        border = one.entity != 13
        beyond = {tuple(row) for row in two.vertices[two.entity != 13]}
        assert {tuple(row) for row in one.vertices[border]} == beyond


def test_what_strays_nowhere_stays():
    surface = octant_surface(LIBRARY["Box"])
    same, parents, found = split_where_it_strays(surface, 1.0)
    assert same is surface
    assert (parents == np.arange(len(surface.vertices))[:, None]).all()
    assert found.tolist() == [0]


def test_what_more_vertices_did_not_bring_nearer_gets_no_more():
    surface = octant_surface(LIBRARY["Octet"])
    finer, parents, found = split_where_it_strays(surface, 0.02)
    assert found[0] > 0
    assert len(parents) == len(finer.vertices) > len(surface.vertices)
    assert split_where_it_strays(surface, 0.02, found)[0] is surface
