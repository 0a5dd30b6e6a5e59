# SPDX-License-Identifier: LGPL-2.1-or-later
"""Outlines of closed meshes at a height, from their triangles, against manifold3d's."""

import manifold3d
import numpy as np
import pytest

from volfrep.mesh.booleans import as_manifold, as_mesh
from volfrep.slicing.plane_section import plane_loops


def area(loops):
    return sum(
        0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) for x, y in (p.T for p in loops)
    )


@pytest.mark.parametrize("z", [-6.0, -5.0, -4.1, 0.0, 0.3, 2.5, 5.0])
def test_outlines_enclose_what_the_plane_cuts(z):
    ring = manifold3d.Manifold.cylinder(10.0, 8.0, 5.0, 40, True)
    ring -= manifold3d.Manifold.cube((4.0, 4.0, 20.0), True).rotate((0.0, 20.0, 0.0))
    ring += manifold3d.Manifold.cube((2.0, 2.0, 6.0), True).translate((20.0, 0.0, 2.0))
    mesh = as_mesh(ring)
    theirs = as_manifold(mesh).slice(z)
    found = plane_loops(mesh, z)
    assert area(found) == pytest.approx(theirs.area(), abs=1e-6)
    if theirs.area() > 0.0:
        assert len(found) == len(theirs.to_polygons())
