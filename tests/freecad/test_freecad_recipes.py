# SPDX-License-Identifier: LGPL-2.1-or-later
"""Named settings, points of curves and print figures of an infill, without a window."""

import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.infill import recipes
from freecad_volfrep.features.infill.curve_points import (
    PRESETS,
    added,
    formula_of,
    moved,
    points_of,
    preset,
    taken_over,
    without,
)
from freecad_volfrep.features.infill.live_preview import LivePreview
from freecad_volfrep.features.infill.recipes import apply_recipe, known_recipes, save_recipe
from freecad_volfrep.features.infill.values import specification_of
from freecad_volfrep.features.reports.print_figures import print_rows
from volfrep.design.parameters.recipes import RECIPES
from volfrep.design.parameters.spec_file import read_spec
from volfrep.design.profile import Profile
from volfrep.util.errors import VolfrepError


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """A folder of recipes of the test's own."""
    monkeypatch.setattr(recipes, "recipe_folder", lambda: tmp_path / "own")
    return tmp_path / "own"


@pytest.mark.parametrize("name", RECIPES)
def test_an_infill_takes_every_recipe_that_comes_with_it(doc, box, name):
    obj = make_lattice_infill(doc, box, CellMap="Cylindrical", UseOrigin=True, Density=2.7)
    apply_recipe(obj, RECIPES[name])
    assert specification_of(obj) == pytest.approx(read_spec(name)) or (
        specification_of(obj).as_dict() | {"density": 1.0} == read_spec(name).as_dict()
    )


@pytest.mark.parametrize(
    "values",
    [
        {"CellType": "Octet", "CellSize": 7, "StrutRadius": 0.6, "JointFillet": 0.2},
        {"RadiusGrading": "Skin", "RadiusStart": 0.5, "RadiusEnd": 1.2, "RadiusReach": 4},
        {"RadiusGrading": "Direction", "RadiusProfile": "Formula",
         "RadiusFormula": "through(s, 0, 1, 1, 0.5)"},
        {"SizeGrading": "Linear", "LambdaEnd": 1.5, "RemoveDangling": True, "Resolution": 9},
        {"RadiusDrivenBy": "Relative density", "TargetDensity": 0.17},
        {"CellType": "Gyroid", "WallThickness": 0.9, "ShellThickness": 0},
        {"CellMap": "Cylindrical", "MapAround": 12, "Activation": "Touching"},
    ],
)  # fmt: skip
def test_settings_are_saved_and_given_to_another_infill(doc, box, values, folder):
    one = make_lattice_infill(doc, box, **values)
    file = save_recipe(one, "Mine")
    assert file == folder / "Mine.toml"
    assert known_recipes()["Mine"] == file
    other = make_lattice_infill(doc, box, CellSize=3, CellMap="Spherical", ShellThickness=0.3)
    apply_recipe(other, file)
    for name, value in values.items():
        now = getattr(other, name)
        assert (
            getattr(now, "Value", now) == pytest.approx(value)
            if not isinstance(value, str)
            else now == value
        )
    assert specification_of(other) == specification_of(one)


def test_what_an_expression_drives_and_the_material_stay(doc, box):
    obj = make_lattice_infill(doc, box, PrintProcess="SLS")
    obj.setExpression("CellSize", "6 mm")
    doc.recompute([obj])
    apply_recipe(obj, RECIPES["light-bracket-lpbf"])
    assert obj.CellSize.Value == 6.0
    assert obj.PrintProcess == "SLS"
    assert obj.StrutRadius.Value == pytest.approx(0.4)


def test_bad_files_and_names_change_nothing(doc, box, tmp_path):
    obj = make_lattice_infill(doc, box, CellSize=7)
    bad = tmp_path / "bad.toml"
    bad.write_text('cell = "Box"\ncell_size = -3\n')
    with pytest.raises(VolfrepError, match="cell size"):
        apply_recipe(obj, bad)
    assert (obj.CellType, obj.CellSize.Value) == ("CVC", 7.0)
    for name in ("", "a/b", ".hidden"):
        with pytest.raises(VolfrepError, match="no name"):
            save_recipe(obj, name)


def figures_of(obj):
    return {row.name: row for row in print_rows(obj, LivePreview(obj).show())}


def test_print_figures_follow_process_and_price_and_then_the_mesh(doc, box):
    obj = make_lattice_infill(doc, box, **SMALL)
    rows = figures_of(obj)
    assert all(row.is_kept for row in rows.values())
    assert "cost of the material" not in rows
    obj.PrintProcess, obj.MaterialPrice = "SLS", 50
    rows = figures_of(obj)
    assert not rows["closed voids"].is_kept
    assert "a closed skin" in rows["closed voids"].value
    told = float(rows["cost of the material"].value)
    doc.recompute()
    rows = figures_of(obj)
    assert rows["closed voids"].value.startswith("1, holding")
    assert float(rows["cost of the material"].value) == pytest.approx(told, rel=0.1)
    obj.PrintProcess = "FFF"
    thin = figures_of(obj)["thinnest strut"]
    assert thin.is_kept == (2 * obj.StrutRadius.Value >= 2.0)


def test_points_and_formulas_say_the_same():
    points = ((0.0, 0.5), (0.3, 1.25), (1.0, 0.75))
    formula = formula_of(points)
    assert formula == "through(s, 0, 0.5, 0.3, 1.25, 1, 0.75)"
    assert points_of(formula) == points
    assert Profile("formula", expression=formula)(0.3) == pytest.approx(1.25)
    for other in ("1 + s", "through(s, 0, 1, 1)", "through(s, 1, 1, 0, 2)", "2 * " + formula):
        assert points_of(other) is None
    assert taken_over("1 + s") == ((0, 1), (0.25, 1.25), (0.5, 1.5), (0.75, 1.75), (1, 2))


def test_points_keep_their_order_and_their_ends():
    points = ((0.0, 1.0), (0.5, 2.0), (1.0, 1.0))
    assert moved(points, 0, 0.4, 3.0)[0] == (0.0, 3.0)
    assert moved(points, 1, 1.7, -5.0)[1] == (0.99, 0.02)
    more, k = added(points, 0.75, 1.2)
    assert more[k] == (0.75, 1.2)
    assert len(more) == 4
    assert added(points, 0.5, 9.0) == (points, 1)
    assert without(points, 0) == points
    assert without(points, 1) == ((0.0, 1.0), (1.0, 1.0))


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("formula", ["1 + s", "0.7", "not a formula"])
def test_shapes_lie_between_the_values_that_were_there(name, formula):
    values = [value for _, value in preset(name, formula)]
    assert min(values) > 0.0
    assert max(values) > 1.2 * min(values)
    if formula == "1 + s":
        assert (min(values), max(values)) == (1.0, 2.0)
