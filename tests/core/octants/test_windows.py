# SPDX-License-Identifier: LGPL-2.1-or-later
"""Windows between struts are there in the mesh, however coarse its facets are."""

import numpy as np
import pytest
from test_refinement import facet_deviations, octant_of

from volfrep.design.cells import find_cell
from volfrep.octants import refinement, surface_fit
from volfrep.octants.octant_spec import OctantSpec
from volfrep.octants.windows import sampled_finely_enough


@pytest.mark.slow
def test_a_window_of_a_fifth_of_the_radius_is_open():
    """It was closed: facets strayed by 7.5 times the deviation there."""
    octant = octant_of("Truncated Cube", 15)
    assert (
        facet_deviations("Truncated Cube", octant)[0].max()
        < 1.5 * OctantSpec(10.0, 1.0, 0.0, 15).deviation
    )


@pytest.mark.parametrize("name", ["FCC", "CVC", "Diamond"])
def test_cells_whose_windows_are_seen_are_sampled_as_before(name):
    spec = OctantSpec(10.0, 1.0, 0.0, 15)
    assert sampled_finely_enough(find_cell(name), spec).samples == 1


@pytest.mark.parametrize("name", ["Truncated Cube", "Rhombicuboctahedron"])
def test_narrow_windows_take_more_samples(name):
    assert sampled_finely_enough(find_cell(name), OctantSpec(10.0, 1.0, 0.0, 15)).samples == 2


def test_windows_narrower_than_a_deviation_count_as_either():
    """Kagome of r/L 0.1 has some of 0.02 mm."""
    assert sampled_finely_enough(find_cell("Kagome"), OctantSpec(10.0, 1.0, 0.0, 15)).samples == 1


@pytest.mark.costly
def test_what_is_looked_at_bit_by_bit_is_the_same(monkeypatch):
    """All at once a fit of a cell with many struts took gigabytes."""
    whole = octant_of("FCC", 15)
    monkeypatch.setattr(refinement, "POINTS_AT_ONCE", 1000)
    monkeypatch.setattr(surface_fit, "AT_ONCE", 100)
    assert np.array_equal(octant_of("FCC", 15).vertices, whole.vertices)
