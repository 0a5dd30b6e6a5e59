# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii of a list, and planes of symmetry."""

from dataclasses import replace

import numpy as np
import pytest
from test_sizing import cantilever

import samples
import volfrep
from volfrep.mechanics.materials import find_material
from volfrep.reports.sizing_plot import sizing_plot
from volfrep.sizing.analysis import Limits, analyse
from volfrep.sizing.discrete_radii import of_list
from volfrep.sizing.optimise import lightest, stiffest
from volfrep.sizing.symmetry import Mirrors
from volfrep.util.errors import VolfrepError

TITANIUM = find_material("Ti-6Al-4V")
LIST = np.array([0.3, 0.45, 0.6, 0.8, 1.0])


def lists_design(limits):
    problem, start = cantilever(count=(4, 2, 2))
    free = lightest(problem, limits, start, most_steps=25)
    assert free.holds
    found, holds = of_list(problem, limits, free.analysis, LIST)
    return problem, free.analysis, found, holds


@pytest.mark.costly_cases("displacement")
@pytest.mark.parametrize(
    ("limits", "most"),
    [(Limits(stress=700.0), 1.25), (Limits(displacement=1.0), 1.1)],
    ids=["stress", "displacement"],
)
def test_radii_of_a_list_hold_the_limits_and_cost_little(limits, most):
    """A single radius of the list that holds them is heavier."""
    problem, free, found, holds = lists_design(limits)
    assert holds
    assert found.most_used <= 1.0
    assert np.isin(found.radii, LIST).all()
    assert free.volume < found.volume < most * free.volume
    for radius in LIST:
        if (radius > problem.high).any() or (radius < problem.low).any():
            continue
        even = analyse(problem, np.full(len(found.radii), radius), limits)[0]
        assert even.most_used > 1.0 or even.volume >= found.volume


@pytest.mark.costly
def test_the_stiffest_radii_of_a_list_have_no_more_than_their_mass():
    problem, start = cantilever(count=(4, 2, 2))
    volume = problem.radii.volume(start)
    free = stiffest(problem, volume, start, most_steps=15).analysis
    found, _ = of_list(problem, Limits(), free, LIST)
    assert np.isin(found.radii, LIST).all()
    assert 0.9 * volume < found.volume <= volume * (1.0 + 1e-9)
    even = analyse(problem, start, Limits())[0]
    assert found.compliance[0] < even.compliance[0]


def test_a_list_without_a_radius_for_a_node_is_refused():
    problem, start = cantilever(count=(2, 1, 1))
    with pytest.raises(VolfrepError, match="No radius of the list lies between"):
        of_list(problem, Limits(), analyse(problem, start, Limits())[0], np.array([9.0]))


@pytest.mark.costly
def test_images_have_one_radius_and_the_worst_side_governs():
    """A load on one side: with symmetry both sides are as thick as that one has to be."""
    problem, start = cantilever(count=(4, 2, 2))
    nodes, (case,) = problem.structure.nodes, problem.cases
    corner = np.abs(nodes - (40.0, 0.0, 20.0)).max(axis=1) < 1e-6
    loads = np.zeros_like(case.loads)
    loads[corner, 2] = -60.0
    problem = replace(problem, cases=(replace(case, loads=loads),))
    mirrors = Mirrors(((1, 10.0),))
    groups, lone = mirrors.groups(nodes, 0.01)
    assert lone == 0.0
    alike = problem.alike(groups)
    limits = Limits(stress=600.0, displacement=0.3)
    free, mirrored = (lightest(one, limits, start, most_steps=25) for one in (problem, alike))
    assert free.holds
    assert mirrored.holds
    radii = mirrored.analysis.radii
    image = nodes * (1, -1, 1) + (0, 20, 0)
    row = np.array([int(np.argmin(np.abs(nodes - place).sum(axis=1))) for place in image])
    assert radii == pytest.approx(radii[row], rel=1e-12)
    assert np.abs(free.analysis.radii - free.analysis.radii[row]).max() > 0.02
    assert mirrored.analysis.volume > free.analysis.volume
    # The other side loaded in its place: the same.
    other = np.zeros_like(loads)
    other[row] = loads
    turned = replace(alike, cases=(replace(case, loads=other),))
    there = analyse(turned, radii, limits)[0]
    assert there.uses == pytest.approx(mirrored.analysis.uses, rel=1e-6)


def test_nodes_without_an_image_are_counted():
    points = np.array([[0.0, 0, 0], [2, 0, 0], [1, 0, 0], [0, 5, 0]])
    groups, lone = Mirrors(((0, 1.0),)).groups(points, 1e-6)
    assert groups[0] == groups[1]
    assert len(np.unique(groups)) == 3
    assert lone == 0.25


LOADS = {
    "material": "Ti-6Al-4V",
    "support": [{"plane": {"point": [0, 0, 0], "normal": [1, 0, 0]}, "fixed": True}],
    "case": [
        {"load": [{"plane": {"point": [40, 0, 0], "normal": [1, 0, 0]}, "force": [0, 0, -1500]}]}
    ],
}


@pytest.mark.slow
def test_a_part_is_its_own_image_and_has_radii_of_the_list():
    """Struts and a sized skin; what the list costs is told."""
    box = samples.box((40.0, 20.0, 10.0))
    made = volfrep.size(
        box, LOADS, cell="CVC", cell_size=10, strut_radius=0.6, shell=1, max_stress=250,
        skin_thinnest=0.5, steps=2, proof=False, radius_list=[0.4, 0.6, 0.8],
        symmetry="y=10", resolution=8,
    ).sized  # fmt: skip
    assert np.isin(np.round(made.radii, 6), [0.4, 0.6, 0.8]).all()
    field = made.spec.skin_field
    inside = np.random.default_rng(1).random((200, 3)) * (40, 20, 10)
    image = inside * (1, -1, 1) + (0, 20, 0)
    assert field(inside) == pytest.approx(field(image), rel=1e-6)
    row = np.array(
        [
            np.argmin(np.abs(made.points - q).sum(axis=1))
            for q in made.points * (1, -1, 1) + (0, 20, 0)
        ]
    )
    assert made.radii == pytest.approx(made.radii[row])
    told = made.report["radius_list"]
    assert sum(told["nodes"]) == len(made.radii)
    assert told["volume_over_any_radii"] == pytest.approx(
        made.report["strut_volume_mm3"] / told["any_radii_strut_volume_mm3"]
    )
    assert any(name == "radius list" for name, _ in made.rows())
    # The last step tells of struts and skin together, and of all limits, as those before.
    report = made.report
    mass = report["strut_mass_g"] + report["skin_mass_g"]
    last, first = report["steps"][-1], report["steps"][0]
    assert last["strut_volume_mm3"] * report["material"]["density"] / 1e3 == pytest.approx(mass)
    assert last["uses"].keys() == first["uses"].keys()
    assert "mass of struts and skin" in sizing_plot(report)


@pytest.mark.costly_cases("given1-have no image in the planes of symmetry")
@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"symmetry": "y"}, "planes across x, y or z"),
        ({"symmetry": "y=3"}, "have no image in the planes of symmetry"),
        ({"radius_list": [0.5, -1]}, "above 0"),
        ({"radius_list": [0.5], "thinnest": 0.4}, "leave thinnest out"),
    ],
)
def test_what_makes_no_sense_is_said(given, said):
    with pytest.raises(VolfrepError, match=said):
        volfrep.size(
            samples.box((40.0, 20.0, 10.0)), LOADS, cell="CVC", cell_size=10, strut_radius=0.6,
            shell=1, max_stress=250, steps=2, proof=False, **given,
        )  # fmt: skip
