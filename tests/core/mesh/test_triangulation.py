# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons with holes cut into triangles without manifold3d: all of the area, nothing twice."""

import numpy as np
import pytest

from volfrep.mesh.triangulation import clip_ears, triangulate


def star(rng, middle, radius, count, sense=1):
    """A loop that sees its middle, with corners at random distances from it."""
    angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, count))[::sense]
    far = radius * rng.uniform(0.5, 1.0, count)
    return middle + far[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def area(loop):
    x, y = loop.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def areas(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])


def sides(loops, triangles):
    """Directed sides of triangles that have no partner, and those of the loops."""
    pairs = np.concatenate([triangles, np.roll(triangles, -1, axis=1)], axis=0).reshape(2, -1).T
    found = set(map(tuple, pairs.tolist()))
    assert len(found) == len(pairs)
    first, wanted = 0, set()
    for loop in loops:
        rows = np.arange(first, first + len(loop))
        wanted |= set(zip(rows.tolist(), np.roll(rows, -1).tolist(), strict=True))
        first += len(loop)
    return {(a, b) for a, b in found if (b, a) not in found}, wanted


@pytest.mark.parametrize("seed", range(12))
def test_triangles_fill_outlines_and_leave_holes(seed):
    rng = np.random.default_rng(seed)
    loops = [star(rng, np.zeros(2), 10.0, 40), star(rng, np.array([40.0, 3.0]), 10.0, 9)]
    for x, y in ((-1.7, -1.5), (1.7, -1.2), (0.0, 2.0))[: seed % 4]:
        loops.append(star(rng, np.array([x, y]), 1.2, 7, -1))
    triangles = clip_ears(loops)
    found = areas(np.concatenate(loops), triangles)
    assert (found >= 0.0).all()
    assert found.sum() == pytest.approx(sum(area(loop) for loop in loops))
    border, wanted = sides(loops, triangles)
    assert border == wanted
    assert len(triangles) == len(triangulate(loops))  # as many as manifold3d makes


def test_a_ring_with_an_island():
    """An outline inside a hole is filled, too."""
    square = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    loops = [3.0 * square, 2.0 * square[::-1], square]
    triangles = clip_ears(loops)
    assert areas(np.concatenate(loops), triangles).sum() == pytest.approx(36.0 - 16.0 + 4.0)
    border, wanted = sides(loops, triangles)
    assert border == wanted
