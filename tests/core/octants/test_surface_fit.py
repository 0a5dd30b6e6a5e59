# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fitted facets stray to both sides of the exact surface alike, so that volumes are right."""

import numpy as np
import pytest

from implicit import octant_surface
from samples import SKEW
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.mesh import remesh
from volfrep.octants import isotropic_remesh, surface_fit


def places(parts=6):
    """Barycentric middles of the equal parts of a facet, finer than the fit's own places."""
    up = [(3 * i + 1, 3 * j + 1) for i in range(parts) for j in range(parts - i)]
    down = [(3 * i + 2, 3 * j + 2) for i in range(parts - 1) for j in range(parts - 1 - i)]
    first = np.array(up + down) / (3.0 * parts)
    return np.column_stack([first, 1.0 - first.sum(axis=1)])


PLACES = places()


def distances_of_facets(surface):
    """(m,) areas, and (m, q) distances of points in the facets to the exact surface, mm."""
    corners = surface.vertices[surface.triangles]
    points = np.einsum("qi,mik->mqk", PLACES, corners)
    rows = np.repeat(surface.triangles[:, 0], len(PLACES))
    values = surface.field.rows(rows).values(points.reshape(-1, 3)).reshape(len(corners), -1)
    return 0.5 * np.linalg.norm(remesh.normals(corners), axis=1), values


def missed(surface):
    """The volume that the facets miss (below 0) for each mm2 of them, mm; and their RMS."""
    area, values = distances_of_facets(surface)
    mean = (area * values.mean(axis=1)).sum() / area.sum()
    return mean, np.sqrt((area * (values**2).mean(axis=1)).sum() / area.sum())


@pytest.fixture(params=[*map(find_cell, PAPERS), SKEW], ids=lambda cell: cell.name, scope="module")
def pair(request):
    """The even surface of an octant, and the fitted one."""
    found, _ = isotropic_remesh.remesh_evenly(octant_surface(request.param))
    return found, surface_fit.fit_facets(surface_fit.fit_border(found))


@pytest.mark.slow_but("CVC", "Box")
def test_the_missed_volume_is_put_right(pair):
    before, after = missed(pair[0]), missed(pair[1])
    assert before[0] < 0.0  # facets with their corners on a strut cut inside it
    assert abs(after[0]) < 0.03 * abs(before[0])


@pytest.mark.slow_but("CVC", "Octahedron")
def test_the_facets_come_nearer_to_the_surface(pair):
    assert missed(pair[1])[1] < 0.85 * missed(pair[0])[1]


def test_even_facets_stray_as_the_border_is_told():
    """By e2 (k1 + k2) / 16 in the mean: on struts k1 = 1 / r, k2 = 0."""
    found, _ = isotropic_remesh.remesh_evenly(octant_surface(LIBRARY["Box"], radius=1.5))
    corners = found.vertices[found.triangles]
    edge2 = ((np.roll(corners, -1, axis=1) - corners) ** 2).sum(axis=2).mean()
    assert -missed(found)[0] == pytest.approx(edge2 / (16.0 * 1.5), rel=0.4)


@pytest.mark.costly_cases("Octet")
def test_only_places_change_and_the_border_stays_in_its_faces(pair):
    before, after = pair
    np.testing.assert_array_equal(after.triangles, before.triangles)
    pinned = before.pinned
    np.testing.assert_array_equal(after.vertices[pinned], before.vertices[pinned])
    moved = np.linalg.norm(after.vertices - before.vertices, axis=1)
    assert moved.max() < before.edge


def test_each_piece_is_right_by_itself():
    """Two octants in one mesh: what one of them misses, the other does not give."""
    one, _ = isotropic_remesh.remesh_evenly(octant_surface(LIBRARY["Box"]))
    two, _ = isotropic_remesh.remesh_evenly(octant_surface(LIBRARY["Box"], radius=1.4))
    count = len(one.vertices)
    field = type(one.field)
    primitives = one.field.primitives
    piece = np.repeat([0, 1], [count, len(two.vertices)])
    both = surface_fit.Surface(
        np.concatenate([one.vertices, two.vertices]),
        np.concatenate([one.triangles, two.triangles + count]),
        np.concatenate([one.place, two.place]),
        one.edge,
        one.step,
        piece,
        one.size,
        np.concatenate([one.held, two.held]),
        field(
            type(primitives)(
                *(
                    np.concatenate([getattr(primitives, name), getattr(two.field.primitives, name)])
                    for name in ("middle", "direction", "half_length", "radius", "slope")
                )
            ),
            np.concatenate([one.field.start, one.field.start[-1] + two.field.start[1:]]),
            np.concatenate([one.field.near, two.field.near + len(primitives)]),
            0.0,
        ),
    )
    found = surface_fit.fit_facets(surface_fit.fit_border(both))
    area, values = distances_of_facets(found)
    for number in (0, 1):
        own = piece[found.triangles[:, 0]] == number
        assert abs((area[own] * values[own].mean(axis=1)).sum() / area[own].sum()) < 1e-3
