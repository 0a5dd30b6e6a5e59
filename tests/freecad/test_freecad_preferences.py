# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user sets once is kept, is used, and makes sense whatever was typed by hand."""

import FreeCAD as App
import pytest

from freecad_volfrep import engine, make_lattice_infill, preferences
from freecad_volfrep.features.infill.factory import preferred_values, suggested_sizes
from freecad_volfrep.features.properties.quantities import density_of
from freecad_volfrep.preferences import PREFERENCES, Colour, colour, read, write

EXTENT = (178.5, 62.5, 108.3)


@pytest.fixture(autouse=True)
def group(monkeypatch):
    """An empty group of parameters in the place of the user's own."""
    path = preferences.GROUP + "Tests"
    monkeypatch.setattr(preferences, "GROUP", path)
    monkeypatch.setattr(preferences, "_said", set())
    yield App.ParamGet(path)
    parent, _, name = path.rpartition("/")
    App.ParamGet(parent).RemGroup(name)


@pytest.fixture
def warnings(monkeypatch):
    said = []

    class Console:
        PrintWarning = staticmethod(said.append)

    monkeypatch.setattr(preferences.App, "Console", Console)
    return said


def another(preference):
    """A value that is allowed and not the default."""
    if preference.choices is not None:
        return next(value for value in preference.choices() if value != preference.default)
    if isinstance(preference.default, bool):
        return not preference.default
    if isinstance(preference, Colour):
        return 0x336699FF
    return type(preference.default)(2 * preference.low + 1) if preference.high > 1 else 0.25


@pytest.mark.parametrize("preference", PREFERENCES, ids=lambda preference: preference.key)
def test_every_preference_is_kept_and_its_default_is_not_stored(preference, group):
    assert read(preference) == preference.default
    write(preference, another(preference))
    assert read(preference) == another(preference)
    assert type(read(preference)) is type(preference.default)
    assert len(group.GetContents()) == 1
    write(preference, preference.default)
    assert read(preference) == preference.default
    assert not group.GetContents()


def test_no_key_is_used_twice():
    assert len({preference.key for preference in PREFERENCES}) == len(PREFERENCES)


@pytest.mark.parametrize("preference", PREFERENCES, ids=lambda preference: preference.key)
def test_every_default_is_allowed(preference):
    assert preferences.allowed(preference, preference.default) == preference.default


@pytest.mark.parametrize(
    ("preference", "typed", "used"),
    [
        (preferences.STRUT_SHARE, 7.5, 0.4),
        (preferences.STRUT_SHARE, -1.0, 0.01),
        (preferences.STRUT_SHARE, float("nan"), 0.1),
        (preferences.DENSITY, float("inf"), 25.0),
        (preferences.CELL_SIZE, -3.0, 0.01),
        (preferences.RESOLUTION, 2, 4),
        (preferences.THREADS, -4, 1),
        (preferences.LARGEST_SHOWN, 0, 1000),
        (preferences.TRANSPARENCY, 250, 100),
        (preferences.CELL_TYPE, "Honeycomb", "CVC"),
    ],
)
def test_what_makes_no_sense_is_mended_and_said_once(group, warnings, preference, typed, used):
    setter = {int: group.SetInt, float: group.SetFloat, str: group.SetString}[type(typed)]
    setter(preference.key, typed)
    assert read(preference) == used
    assert read(preference) == used
    assert len(warnings) == 1
    assert preference.key in warnings[0]
    assert repr(used) in warnings[0]


def test_zero_leaves_the_choice_to_us_without_a_word(group, warnings):
    for preference in PREFERENCES:
        if preference.automatic:
            assert read(preference) == 0
    assert warnings == []


def test_a_colour_is_what_freecad_stores(group):
    group.SetUnsigned("OverhangColour", 0xFF8000FF)
    assert colour(preferences.OVERHANG_COLOUR) == pytest.approx((1.0, 128 / 255, 0.0))


def test_the_limits_of_the_facets_are_the_engines():
    from volfrep.design.spec import MAX_RESOLUTION, MIN_RESOLUTION

    assert preferences.RESOLUTION.low == MIN_RESOLUTION
    assert preferences.RESOLUTION.high == MAX_RESOLUTION


def test_without_preferences_a_new_infill_is_the_suggested_one(doc, box):
    values = preferred_values(EXTENT)
    sizes = suggested_sizes(EXTENT)
    assert {name: values[name] for name in sizes} == pytest.approx(sizes)
    ours = make_lattice_infill(doc, box, **values)
    plain = make_lattice_infill(doc, box, **sizes)
    for name in values:
        assert getattr(ours, name) == getattr(plain, name), name


def test_a_new_infill_starts_with_the_preferences(doc, box):
    chosen = {
        preferences.CELL_TYPE: "Octet",
        preferences.CELL_SIZE: 8.0,
        preferences.STRUT_SHARE: 0.125,
        preferences.SKIN: 1.5,
        preferences.RESOLUTION: 12,
        preferences.DEVIATION: 0.05,
        preferences.AUTO_UPDATE: False,
        preferences.DENSITY: 4.43,
    }
    for preference, value in chosen.items():
        write(preference, value)
    obj = make_lattice_infill(doc, box, **preferred_values(EXTENT))
    assert (obj.CellType, obj.Resolution, obj.AutoUpdate) == ("Octet", 12, False)
    assert obj.CellSize.Value == pytest.approx(8.0)
    assert obj.StrutRadius.Value == pytest.approx(1.0)
    assert obj.ShellThickness.Value == pytest.approx(1.5)
    assert density_of(obj) == pytest.approx(4.43)
    assert obj.Deviation.Value == 0, "the resolution goes first"
    write(preferences.RESOLUTION, 0)
    assert preferred_values(EXTENT)["Deviation"] == pytest.approx(0.05)
    write(preferences.SKIN, 0.0)
    assert preferred_values(EXTENT)["ShellThickness"] == pytest.approx(8.0 / 5)


def test_scripts_make_the_same_whoever_runs_them(doc, box):
    write(preferences.CELL_TYPE, "Octet")
    write(preferences.DENSITY, 4.43)
    obj = make_lattice_infill(doc, box)
    assert obj.CellType == "CVC"
    assert density_of(obj) == 1.0


def test_the_engine_uses_as_many_threads_as_preferred():
    from volfrep.util.threads import threads

    engine.require_engine()
    automatic = threads()
    write(preferences.THREADS, automatic + 3)
    engine.require_engine()
    assert threads() == automatic + 3
    write(preferences.THREADS, 0)
    engine.require_engine()
    assert threads() == automatic
