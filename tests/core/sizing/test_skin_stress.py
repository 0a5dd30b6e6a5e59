# SPDX-License-Identifier: LGPL-2.1-or-later
"""The stress of a skin's shells, beside closed forms and CalculiX's wedges of the same skin."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.fem.calculix import find_calculix
from volfrep.jobs.sizing import Goal, size, sizing
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.sizing import proof
from volfrep.sizing.analysis import Limits
from volfrep.sizing.model import elastic
from volfrep.sizing.proof import end_stresses, skin_stresses
from volfrep.sizing.skin import skin_model
from volfrep.sizing.stress_ratios import skin_ratio
from volfrep.util.peaks import most_but_peaks

SIZE, FORCE = (40.0, 20.0, 20.0), 2000.0
TITANIUM = find_material("Ti-6Al-4V")


def hollow(thickness=1.5, edge=4.0):
    return skin_model(samples.box(SIZE), thickness, edge, elastic(TITANIUM))


def test_a_stress_that_is_even_or_linear_in_a_face_is_kept_as_it_is():
    skin = hollow()
    shells = skin.shells
    middle = skin.middle[shells.triangles].mean(axis=1)
    assert np.asarray(skin._patches.sum(axis=1)).ravel() == pytest.approx(1.0, rel=1e-9)
    for face in np.eye(3):
        side = shells.axes[:, 2] @ face > 0.9
        values = np.where(side, 50.0 + middle @ (3.0, -2.0, 1.0), -1e6)  # other faces have no say
        assert (skin._patches @ values)[side] == pytest.approx(values[side], abs=0.1)


@pytest.mark.costly
@pytest.mark.skipif(find_calculix() is None, reason="CalculiX is not installed")
def test_where_a_box_is_held_its_skin_is_stressed_as_calculix_says():
    """The largest piece of each triangle governed there: 1.6 times what wedges have."""
    spec = LatticeSpec("CVC", cell_size=10, strut_radius=0.9, shell=1.5)
    held, loaded = (InPlane((x, 0, 0), (1, 0, 0)) for x in (0.0, SIZE[0]))
    case = LoadCase("down", (Support(held),), (Force(loaded, (0, 0, -FORCE)),))
    seen = {}

    def solved(mesh, stress, shells, real=skin_stresses):
        seen["peaks"] = real(mesh, stress, shells)[0]
        return real(mesh, stress, shells)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(proof, "skin_stresses", solved)
        made = size(samples.box(SIZE), spec, LoadCases(TITANIUM, (case,)), Goal(), most_steps=1)
    (ours,) = made.report["skin_stress_mpa"]
    assert ours == pytest.approx(seen["peaks"][0], rel=0.2)


def test_a_field_of_ratios_is_what_was_found_over_what_shells_say():
    skin = hollow(edge=3.0)
    places = skin.middle[skin.shells.triangles].mean(axis=1)
    smooth = 0.8 + 0.01 * places[:, 0]
    own = 100.0 + 20.0 * np.random.default_rng(1).random((len(places), 2))
    found = own * smooth[:, None]
    found[::7] = np.nan
    ratio = skin_ratio(skin, own, found, 8.0).at(places)
    assert ratio == pytest.approx(smooth, rel=0.12)
    known = np.isfinite(found[:, 0])
    area = skin.shells.area
    worst = max(most_but_peaks(row, area[known]) for row in found[known].T)
    told = max(most_but_peaks(row, area) for row in (own * ratio[:, None]).T)
    assert told == pytest.approx(worst, rel=1e-6)


def cantilever(most_steps=12):
    spec = LatticeSpec("CVC", cell_size=10, strut_radius=0.6, shell=1.0)
    held, loaded = (InPlane((x, 0, 0), (1, 0, 0)) for x in (0.0, 30.0))
    case = LoadCase("down", (Support(held),), (Force(loaded, (0, 0, -300.0)),))
    goal = Goal(Limits(stress=120.0), thinnest=0.3, skin_thinnest=0.3)
    cases = LoadCases(TITANIUM, (case,))
    return size(samples.box((30, 10, 10)), spec, cases, goal, most_steps=most_steps)


@pytest.mark.slow
@pytest.mark.skipif(find_calculix() is None, reason="CalculiX is not installed")
def test_a_skin_that_calculix_finds_too_much_stressed_is_chosen_once_more(monkeypatch):
    """As if wedges had a third more than shells: it holds its limit with them, too."""
    asked = []

    def more(mesh, stress, shells, real=skin_stresses):
        peaks, each = real(mesh, stress, shells)
        asked.append(1.33 * max(peaks))
        return tuple(1.33 * peak for peak in peaks), 1.33 * each

    monkeypatch.setattr(proof, "skin_stresses", more)
    made = cantilever()
    assert asked[0] > 1.01 * 120.0
    assert max(made.report["calculix"]["skin_stress_mpa"]) < 1.01 * 120.0
    assert made.sized.holds


@pytest.mark.slow
@pytest.mark.skipif(find_calculix() is None, reason="CalculiX is not installed")
@pytest.mark.parametrize(("more", "corrections"), [((2.5,) * 6, 1), ((2.5, 5.0, 9.0), 0)])
def test_struts_that_calculix_finds_too_much_stressed_are_chosen_with_the_skin(
    monkeypatch, more, corrections
):
    """As if beams had so many times their stress there: it is held, or the nearest design kept."""
    asked, factors = [], iter(more)

    def stressed(*args, real=end_stresses):
        asked.append(next(factors) * real(*args))
        return asked[-1]

    monkeypatch.setattr(proof, "end_stresses", stressed)
    monkeypatch.setattr(sizing, "CORRECTIONS", corrections)
    made = cantilever()
    used = made.report["calculix"]["uses"]["stress"]
    assert np.nanmax(asked[0]) > 1.1 * 120.0
    assert made.sized.holds == (len(set(more)) == 1)
    if made.sized.holds:
        assert used <= 1.003
        assert len(asked) > 2
    else:
        assert used == pytest.approx(np.nanmax(asked[0]) / 120.0, rel=1e-3)
        assert sum("not held in CalculiX" in note for note in made.report["notes"]) == 1
