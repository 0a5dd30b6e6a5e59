# SPDX-License-Identifier: LGPL-2.1-or-later
"""An infill's properties: the rows of the table of parameters, and what they ask the engine for."""

import FreeCAD as App
import pytest

from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.infill.properties import PROPERTIES, TYPES, editor_group
from freecad_volfrep.features.infill.values import specification_of
from freecad_volfrep.features.jobs import screen
from freecad_volfrep.features.properties.quantities import FALLBACK, density_of, supported
from volfrep.design.parameters import BY_NAME, PARAMETERS
from volfrep.design.parameters.specification import specification
from volfrep.design.spec import LatticeSpec
from volfrep.util.errors import VolfrepError

ROWS = [row for row in PARAMETERS if row.in_freecad and not row.position_of]


@pytest.fixture
def plain(doc, box):
    return make_lattice_infill(doc, box)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_a_row_of_the_table_is_a_property(plain, row):
    name = row.property_name
    kind = TYPES[row.kind]
    assert plain.getTypeIdOfProperty(name) == (kind if supported(plain, kind) else FALLBACK)
    assert plain.getGroupOfProperty(name) == editor_group(row)
    assert plain.getDocumentationOfProperty(name) == row.help
    if row.choices:
        assert plain.getEnumerationsOfProperty(name) == list(row.labels)
        assert getattr(plain, name).lower() == row.default
    if row.switch:
        assert getattr(plain, row.switch_name) is False


def test_a_new_infill_asks_for_what_the_command_does_without_options(plain):
    assert specification_of(plain) == LatticeSpec()


TURN = App.Placement(App.Vector(1, 2, 3), App.Rotation(App.Vector(0, 0, 1), 30))
#: Properties, and the same as values of the table.
SETTINGS = [
    ({"CellSize": 8, "StrutRadius": 0.5}, {"cell_size": 8.0, "strut_radius": 0.5}),
    ({"Origin": App.Vector(1, 2, 3)}, {}),
    ({"Origin": App.Vector(1, 2, 3), "UseOrigin": True}, {"origin": (1.0, 2.0, 3.0)}),
    ({"Output": "Lattice", "Boundary": "Whole"}, {"make": "lattice", "boundary": "whole"}),
    ({"DrainDiameter": 2, "DrainCount": 1}, {"drain_diameter": 2.0, "drain_count": 1}),
    ({"DrainCount": 1}, {}),
    ({"Density": 2.7}, {"density": 2.7}),
    ({"Resolution": 12}, {"resolution": 12}),
    ({"SizeGrading": "Linear"}, {"size_grading": "linear", "lambda_end": 2.0}),
    ({"SizeGrading": "Formula"}, {"size_grading": "formula", "lambda_formula": "1 + s"}),
    ({"LambdaEnd": 3, "KeepRadius": False}, {}),
    ({"Orientation": TURN}, {"rotate": (0.0, 0.0, 1.0, 30.0)}),
    (
        {"Orientation": TURN, "UseRotationOrigin": True},
        {"rotate": (0.0, 0.0, 1.0, 30.0), "rotate_origin": (1.0, 2.0, 3.0)},
    ),
    (
        {"RadiusGrading": "Skin", "RadiusEnd": 1.2},
        {"radius_grading": "skin", "radius_start": 1.0, "radius_end": 1.2},
    ),
    (
        {"CellMap": "Spherical", "MapAround": 12, "KeepRadius": False},
        {"cell_map": "spherical", "map_around": 12, "keep_radius": False},
    ),
]


@pytest.mark.parametrize(("properties", "values"), SETTINGS)
def test_properties_and_options_ask_for_the_same(doc, box, properties, values):
    obj = make_lattice_infill(doc, box, **properties)
    assert specification_of(obj).as_dict() == specification(values).as_dict()


def test_a_rotation_is_the_same_after_saving(doc, box, tmp_path):
    turn = App.Rotation(App.Vector(0.3, -0.2, 0.7), 77.7)
    obj = make_lattice_infill(doc, box, Orientation=App.Placement(App.Vector(), turn))
    asked = specification_of(obj)
    doc.saveCopy(str(tmp_path / "turned.FCStd"))
    copy = App.openDocument(str(tmp_path / "turned.FCStd"))
    try:
        assert specification_of(copy.getObject(obj.Name)) == asked
    finally:
        App.closeDocument(copy.Name)


def test_a_sentence_names_the_property(plain):
    plain.SizeGrading = "Formula"
    plain.LambdaFormula = ""
    with pytest.raises(VolfrepError, match=r"LambdaFormula|formula"):
        specification_of(plain)


def test_a_density_given_to_the_function_is_in_g_per_cm3(doc, box):
    for density in (7.85, "7.85 g/cm^3", "7850 kg/m^3"):
        if isinstance(density, str) and not supported(doc.Solid, "App::PropertyDensity"):
            continue
        obj = make_lattice_infill(doc, box, Density=density)
        assert density_of(obj) == pytest.approx(7.85)


def test_every_property_of_the_table_is_described(plain):
    assert {prop.name for prop in PROPERTIES} <= set(plain.PropertiesList)
    assert all(prop.description for prop in PROPERTIES)
    assert BY_NAME["make"].property_name == "Output"


def test_without_a_window_objects_have_no_view(plain):
    assert not App.GuiUp
    assert screen.screen() is None
    screen.attach_view(plain)  # does nothing
    assert plain.ViewObject is None
