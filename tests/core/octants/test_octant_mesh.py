# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants are meshed once for all that look alike."""

import numpy as np
import pytest

from samples import SKEW
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.octants import octant_mesh
from volfrep.octants.octant import (
    ALL_ACTIVE,
    OctantKey,
    octant_grid,
    octant_primitives,
    sample_octant,
    sample_octants,
)
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


@pytest.mark.slow_but("CVC-1.0")
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


def test_octants_of_thirds_of_a_cell_are_shared_as_those_of_halves():
    """1 - 0.791666666667 is not 0.208333333333 in binary: 15 were meshed, 6 times as long."""
    monitor = Monitor()
    keys = kinds_of(LIBRARY["Weaire-Phelan"], np.ones((2, 2, 2), bool))
    mesh_octants(LIBRARY["Weaire-Phelan"], OctantSpec(10.0, 0.4, 0.0, 20), keys, monitor)
    assert monitor.work["kinds of octants meshed"] <= 8


@pytest.mark.costly
def test_struts_that_show_keep_octants_apart():
    """With a fillet the hidden struts of a joint show: only those with axes exchanged are alike."""
    cell = LIBRARY["FCC"]
    keys = kinds_of(cell, np.ones((2, 2, 2), bool))
    monitor = Monitor()
    mesh_octants(cell, OctantSpec(10.0, 0.8, 0.5, 8), keys, monitor)
    assert len(keys) == 27
    low_high_or_inside_along_three_axes = 10
    assert monitor.work["kinds of octants meshed"] == low_high_or_inside_along_three_axes


@pytest.mark.costly_cases("Kagome")
@pytest.mark.parametrize("name", ["CVC", "Kagome"])
def test_octants_that_are_others_with_their_axes_exchanged_are_not_meshed(name):
    """They have these octants' insides, and the borders that they would have alone."""
    cell, spec = LIBRARY[name], OctantSpec(10.0, 0.8, 0.0, 15)
    # At a block's edges along x, y and z, in the frame of a cell that three turns leave alike.
    keys = [OctantKey(0, pattern) for pattern in (0b11, 0b101, 0b10001)]
    monitor = Monitor()
    first, *others = mesh_octants(cell, spec, keys, monitor).values()
    assert monitor.work["kinds of octants meshed"] == 1
    for key, octant in zip(keys[1:], others, strict=True):
        places, its = (np.sort(one.vertices, axis=1) for one in (octant, first))
        np.testing.assert_allclose(places, its, rtol=0.0, atol=1e-6)
        corners = octant.vertices[octant.triangles]
        volume, its = (np.linalg.det(c).sum() for c in (corners, first.vertices[first.triangles]))
        assert volume == pytest.approx(its, rel=1e-6)
        alone = mesh_octants(cell, spec, [key], Monitor())[key]
        for shared, own in zip(border_of(octant), border_of(alone), strict=True):
            np.testing.assert_array_equal(shared, own)


def test_octants_that_share_struts_are_sampled_as_each_alone():
    cell = LIBRARY["Octet"]
    keys = [OctantKey(0, pattern, missing) for pattern, missing in [(255, 0), (255, 6), (3, 1)]]
    own = [octant_primitives(cell, key, 10.0, 0.8, 2.0) for key in keys]
    own.append(own[0].take(np.zeros(0, int)))
    for fillet in (0.0, 0.6):
        together = sample_octants(own, 10, 7, fillet)  # whole numbers are given, too
        for samples, alone in zip(together, own, strict=True):
            np.testing.assert_array_equal(samples, sample_octant(alone, 10.0, 7, fillet))
    assert (together[-1] == 10.0).all()


def test_octants_whose_facets_cross_are_evened_out_once(monkeypatch):
    """And once gently: the eight tries begin with what these two give."""
    evened, looked = [], []
    even_out, crossing = octant_mesh.remesh_evenly, octant_mesh.crossing_facets

    def counted(raw, gently=False, **asked):
        evened.append(gently)
        return even_out(raw, gently, **asked)

    def crossed(surface, exact=True, pieces=None):
        looked.append(exact)
        return np.ones(len(surface.triangles), bool) | crossing(surface, exact, pieces)

    monkeypatch.setattr(octant_mesh, "remesh_evenly", counted)
    monkeypatch.setattr(octant_mesh, "crossing_facets", crossed)
    key = OctantKey(0, ALL_ACTIVE)
    spec = OctantSpec(10.0, 1.0, 0.0, 15)
    assert len(mesh_octants(LIBRARY["BCC"], spec, [key], Monitor())[key].triangles)
    assert (evened, looked) == ([False], [True])
    monkeypatch.setattr(
        octant_mesh, "untangle", lambda surface, *_: (surface, crossed(surface, True))
    )
    with pytest.raises(octant_mesh.FacetsCross):
        mesh_octants(LIBRARY["BCC"], spec, [key], Monitor())
    assert evened == [False, False, True]


def test_an_octant_that_lost_all_its_struts_has_no_facets():
    key = OctantKey(0, 1, missing=(1 << len(LIBRARY["Box"].struts)) - 1)
    octant = mesh_octants(LIBRARY["Box"], OctantSpec(10.0, 1.0, 0.0, 8), [key], Monitor())[key]
    assert len(octant.triangles) == len(octant.vertices) == 0
    assert not octant.solid_corners.any()
