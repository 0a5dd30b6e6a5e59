# SPDX-License-Identifier: LGPL-2.1-or-later
"""Relative density without a mesh, against closed forms and counted points."""

import numpy as np
import pytest

import exact
from volfrep import VolfrepError
from volfrep.design.cells import LIBRARY, make_cell
from volfrep.mechanics.density import radius_of_density, relative_density
from volfrep.mechanics.endless import all_primitives, endless_cell
from volfrep.octants import sdf as frep


@pytest.mark.slow_but("0.1-CVC", "0.02-Box")
@pytest.mark.parametrize("name", exact.DENSITY)
@pytest.mark.parametrize("radius", [0.02, 0.1, 0.15])
def test_it_is_that_of_the_closed_form(name, radius):
    first, second = exact.DENSITY[name]
    found = relative_density(LIBRARY[name], radius)
    expected = first * radius**2 - second * radius**3
    assert found.value == pytest.approx(expected, rel=5e-4)
    assert abs(found.value - expected) <= found.error
    assert found.error < 2e-3 * found.value


@pytest.mark.slow
@pytest.mark.parametrize(("name", "fillet"), [("FCC", 0.0), ("Octahedron", 0.03), ("CVC", 0.05)])
def test_it_is_that_of_random_points(name, fillet):
    cell, radius, count = LIBRARY[name], 0.08, 200_000
    primitives = all_primitives(endless_cell(cell), radius, fillet + 0.01)
    points = np.random.default_rng(1).random((count, 3))
    solid = sum(
        np.count_nonzero(frep.union(frep.distances(part[:, None], primitives), fillet) <= 0)
        for part in np.array_split(points, 40)
    )
    share = solid / count
    found = relative_density(cell, radius, fillet)
    assert abs(found.value - share) < 4 * np.sqrt(share * (1 - share) / count)
    assert found.error < 2e-3 * found.value


def test_struts_on_shared_edges_count_once():
    endless = endless_cell(LIBRARY["Box"])
    assert len(endless.nodes) == 1
    assert len(endless.struts) == 3
    assert [len(endless_cell(LIBRARY[name]).struts) for name in ("FCC", "BCC", "Octet")] == [
        15,
        11,
        24,
    ]


def test_a_single_column_is_a_cylinder_with_its_joint():
    pillar = make_cell("P", [[0.5, 0.5, 0], [0.5, 0.5, 1]], [[0, 1]])
    radius, joint = 0.1, 0.11
    half = np.sqrt(joint**2 - radius**2)
    bulge = 2 * np.pi * ((joint**2 - radius**2) * half - half**3 / 3)
    found = relative_density(pillar, radius)
    assert found.value == pytest.approx(np.pi * radius**2 + bulge, rel=5e-4)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "density"),
    [pytest.param("Octahedron", 0.2, marks=pytest.mark.slow), ("Box", 0.02), ("CVC", 0.6)],
)
def test_the_radius_of_a_density_has_that_density(name, density):
    cell = LIBRARY[name]
    radius = radius_of_density(cell, density)
    assert relative_density(cell, radius).value == pytest.approx(density, rel=1e-4)
    filleted = radius_of_density(cell, density, 0.05)
    assert filleted < radius
    assert relative_density(cell, filleted, 0.05).value == pytest.approx(density, rel=1e-4)


def test_densities_that_cannot_be():
    cell = LIBRARY["Box"]
    for density in (0.0, 1.0, -1.0, float("nan")):
        with pytest.raises(VolfrepError, match="between 0 and 1"):
            radius_of_density(cell, density)
    with pytest.raises(VolfrepError, match="choose one from"):
        radius_of_density(cell, 0.97)
    with pytest.raises(VolfrepError, match="too large for a cell"):
        radius_of_density(cell, 0.5, 0.6)
    with pytest.raises(VolfrepError, match="do not fit"):
        relative_density(cell, 0.4)
