# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants are meshed once for all that look alike."""

import numpy as np
import pytest

from samples import SKEW
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.octants.octant import octant_grid
from volfrep.octants.octant_mesh import mesh_octants
from volfrep.octants.octant_spec import OctantSpec
from volfrep.util.progress import Monitor


def kinds_of(cell, active):
    return octant_grid(cell, active, 10.0, np.zeros(3)).keys


def border_of(octant):
    """The vertices on the octant's faces, in the order that its neighbours give them."""
    order = np.lexsort((octant.rank, octant.entity))
    on_border = (octant.places[order] != 1).any(axis=1)
    return octant.entity[order][on_border], octant.vertices[order][on_border]


@pytest.mark.parametrize("radius", [1.0, 1.7])
@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda cell: cell.name)
def test_an_octant_that_shares_a_mesh_has_the_border_it_would_have_alone(cell, radius):
    """So it fits to all its neighbours; inside, either mesh follows the same surface."""
    spec = OctantSpec(10.0, radius, 0.0, 8)
    active = np.random.default_rng(5).random((3, 3, 3)) < 0.6
    keys = kinds_of(cell, active)
    monitor = Monitor()
    together = mesh_octants(cell, spec, keys, monitor)
    assert monitor.work["kinds of octants meshed"] < len(keys)
    for key in keys[::17]:
        alone = mesh_octants(cell, spec, [key], Monitor())[key]
        for shared, own in zip(border_of(together[key]), border_of(alone), strict=True):
            np.testing.assert_array_equal(shared, own)
        np.testing.assert_array_equal(together[key].solid_corners, alone.solid_corners)


def test_struts_that_show_keep_octants_apart():
    """With a fillet the hidden struts of a joint show: nothing is shared."""
    cell = LIBRARY["FCC"]
    keys = kinds_of(cell, np.ones((2, 2, 2), bool))
    monitor = Monitor()
    mesh_octants(cell, OctantSpec(10.0, 0.8, 0.5, 8), keys, monitor)
    assert monitor.work["kinds of octants meshed"] == len(keys) == 27
