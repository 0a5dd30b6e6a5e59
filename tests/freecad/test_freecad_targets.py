# SPDX-License-Identifier: LGPL-2.1-or-later
"""What drives the radius of an infill, and what it is made of, as properties of the document."""

import json

import FreeCAD as App
import pytest

from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.infill.live_preview import LivePreview
from freecad_volfrep.features.infill.materials import advice, for_solver, process_of
from freecad_volfrep.features.infill.values import specification_of
from freecad_volfrep.features.properties.quantities import (
    density_of,
    is_driven,
    mass_of,
    number_of,
    set_expression,
    set_value,
)
from freecad_volfrep.features.reports.print_check import make_print_check
from volfrep.design.target import Target
from volfrep.util.errors import VolfrepError

#: What is promised, relative.
NEAR = 5e-3
LATTICE = {"CellType": "BCC", "CellSize": 10, "ShellThickness": 2, "Resolution": 8}


def driven(doc, box, by, **settings):
    obj = make_lattice_infill(doc, box, **LATTICE)
    obj.RadiusDrivenBy = by
    for name, value in settings.items():
        set_value(obj, name, value)
    return obj


def inside(obj):
    """Volumes of the skin and of what it encloses, mm3, of the box of 30 x 20 x 20 mm."""
    return 12000.0 - 26.0 * 16.0 * 16.0, 26.0 * 16.0 * 16.0


@pytest.mark.costly
def test_the_mesh_has_the_relative_density_that_drives_the_radius(doc, box):
    obj = driven(doc, box, "Relative density", TargetDensity=0.25)
    doc.recompute()
    skin, domain = inside(obj)
    assert (obj.Mesh.Volume - skin) / domain == pytest.approx(0.25, rel=NEAR)
    assert obj.StrutRadius.Value == pytest.approx(max(obj.StrutRadii))
    assert "ReadOnly" in obj.getEditorMode("StrutRadius")
    assert json.loads(obj.Report)["target"]["strut_radius_mm"] == obj.StrutRadius.Value
    assert not [text for text in obj.Warnings if "missed" in text]


@pytest.mark.costly
def test_the_part_has_the_mass_that_drives_the_radius_in_its_material(doc, box):
    obj = driven(doc, box, "Mass", TargetMass=20.0, PrintMaterial="AlSi10Mg")
    doc.recompute()
    assert obj.Mesh.Volume * 2.67 / 1000.0 == pytest.approx(20.0, rel=NEAR)
    assert mass_of(obj) == pytest.approx(20.0, rel=NEAR)
    assert density_of(obj) == pytest.approx(2.67)


@pytest.mark.slow
def test_a_heavier_material_asks_for_another_mass(doc, box):
    obj = driven(doc, box, "Mass", TargetMass=20.0, PrintMaterial="AlSi10Mg")
    doc.recompute()
    thick = obj.StrutRadius.Value
    obj.PrintMaterial = "316L"  # three times as heavy: the skin alone is too much
    with pytest.raises(VolfrepError, match="of which the skin is"):
        obj.Proxy.execute(obj)
    set_value(obj, "TargetMass", 60.0)
    doc.recompute()
    assert mass_of(obj) == pytest.approx(60.0, rel=NEAR)
    assert obj.StrutRadius.Value == pytest.approx(thick, rel=0.02)


@pytest.mark.costly
def test_the_lattice_has_the_stiffness_along_a_direction_of_its_material(doc, box):
    obj = driven(doc, box, "Stiffness", TargetStiffness=40.0, PrintMaterial="PA12")
    obj.StiffnessDirection = App.Vector(1, 1, 1)
    doc.recompute()
    assert number_of(obj, "TargetStiffness") == 40.0
    told = json.loads(obj.Report)["target"]
    assert told["reached"] == pytest.approx(40.0, rel=NEAR)
    assert told["direction"] == [1.0, 1.0, 1.0]
    along = obj.StrutRadius.Value
    obj.StiffnessDirection = App.Vector(1, 0, 0)  # where BCC is softer
    doc.recompute()
    assert obj.StrutRadius.Value > 1.05 * along
    obj.PrintMaterial = "None"
    with pytest.raises(VolfrepError, match="that of a material: choose one for the infill"):
        specification_of(obj)


@pytest.mark.slow
def test_a_target_follows_what_the_solid_and_an_expression_say(doc, box):
    sheet = doc.addObject("Spreadsheet::Sheet", "Sheet")
    sheet.set("A1", "0.2")
    sheet.setAlias("A1", "share")
    obj = driven(doc, box, "Relative density")
    obj.setExpression("TargetDensity", "Sheet.share")
    doc.recompute()
    first = obj.StrutRadius.Value
    assert obj.RelativeDensity == pytest.approx(0.2, rel=NEAR)
    sheet.set("A1", "0.3")
    doc.recompute()
    assert obj.RelativeDensity == pytest.approx(0.3, rel=NEAR)
    assert obj.StrutRadius.Value > first
    box.Length = 45
    doc.recompute()
    assert obj.RelativeDensity == pytest.approx(0.3, rel=NEAR)


@pytest.mark.slow
def test_an_expression_of_the_radius_stays_beside_a_target(doc, box):
    obj = make_lattice_infill(doc, box, **LATTICE)
    obj.setExpression("StrutRadius", "CellSize / 8")
    obj.RadiusDrivenBy = "Relative density"
    doc.recompute()
    assert obj.RelativeDensity == pytest.approx(0.2, rel=NEAR)
    assert obj.StrutRadius.Value == 1.25
    obj.RadiusDrivenBy = "Radius"
    doc.recompute()
    assert max(obj.StrutRadii) == pytest.approx(1.25)


@pytest.mark.slow
def test_undo_takes_a_target_and_its_radius_back(doc, box):
    obj = make_lattice_infill(doc, box, **LATTICE)
    doc.recompute()
    triangles = obj.Triangles
    doc.openTransaction("Target")
    obj.RadiusDrivenBy = "Relative density"
    obj.TargetDensity = 0.12
    doc.recompute()
    doc.commitTransaction()
    assert obj.StrutRadius.Value < 0.9
    doc.undo()
    assert (obj.RadiusDrivenBy, obj.StrutRadius.Value) == ("Radius", 1.0)
    doc.recompute()
    assert obj.Triangles == triangles
    assert "ReadOnly" not in obj.getEditorMode("StrutRadius")
    doc.redo()
    doc.recompute()
    assert obj.RelativeDensity == pytest.approx(0.12, rel=NEAR)


@pytest.mark.slow
def test_a_saved_target_is_up_to_date_when_it_is_opened(doc, box, tmp_path):
    obj = driven(doc, box, "Relative density", TargetDensity=0.22)
    doc.recompute()
    doc.saveCopy(str(tmp_path / "target.FCStd"))
    copy = App.openDocument(str(tmp_path / "target.FCStd"))
    try:
        again = copy.getObject(obj.Name)
        _, spec, _ = again.Proxy.inputs(again)
        assert spec.strut_radius == pytest.approx(obj.StrutRadius.Value)
        assert specification_of(again).target == Target("relative_density", 0.22)
        assert spec.target is None
        assert "ReadOnly" in again.getEditorMode("StrutRadius")
    finally:
        App.closeDocument(copy.Name)


@pytest.mark.slow
def test_files_and_analyses_have_the_struts_that_were_found(doc, box, tmp_path):
    obj = driven(doc, box, "Relative density", TargetDensity=0.2, PrintMaterial="Ti-6Al-4V")
    doc.recompute()
    from freecad_volfrep.features.export.solver_files import axes_of, write_solver_file

    assert axes_of(obj).wireframe.radii == pytest.approx(obj.StrutRadius.Value)
    write_solver_file(obj, tmp_path / "deck.inp", "beam deck")
    deck = (tmp_path / "deck.inp").read_text()
    assert "Ti-6Al-4V" in deck
    assert for_solver(obj).young == 110_000


def test_only_what_drives_the_radius_is_shown(doc, box):
    obj = make_lattice_infill(doc, box)
    targets = ("TargetDensity", "TargetMass", "TargetStiffness", "StiffnessDirection")

    def shown():
        return [name for name in targets if "Hidden" not in obj.getEditorMode(name)]

    assert shown() == []
    for driver, names in (
        ("Relative density", ["TargetDensity"]),
        ("Mass", ["TargetMass"]),
        ("Stiffness", ["TargetStiffness", "StiffnessDirection"]),
    ):
        obj.RadiusDrivenBy = driver
        assert shown() == names
        assert "Hidden" in obj.getEditorMode("RadiusGrading")
    obj.RadiusDrivenBy = "Radius"
    assert "Hidden" not in obj.getEditorMode("RadiusGrading")


@pytest.mark.parametrize(
    ("by", "settings"),
    [
        ("Relative density", {"TargetDensity": 0.2}),
        pytest.param("Mass", {"TargetMass": 7.0}, marks=pytest.mark.slow),
        ("Stiffness", {"TargetStiffness": 40.0, "PrintMaterial": "PA12"}),
    ],
)
def test_the_preview_and_the_forecast_follow_with_the_radius(doc, box, by, settings):
    obj = driven(doc, box, by, **settings)
    shown = LivePreview(obj).show()
    radius = shown.preview.spec.strut_radius
    obj.AutoUpdate = False
    doc.recompute()
    expected = obj.Expected
    obj.Proxy.update(obj)
    assert radius == pytest.approx(obj.StrutRadius.Value, rel=0.06)
    assert shown.forecast.triangles == pytest.approx(obj.Triangles, rel=0.5)
    assert "triangles" in expected
    if by != "Stiffness":
        assert shown.figure(by) == pytest.approx(settings[max(settings)], rel=NEAR)


def test_a_target_that_cannot_be_met_is_said_and_the_mesh_stays(doc, box):
    obj = make_lattice_infill(doc, box, **LATTICE)
    doc.recompute()
    triangles = obj.Triangles
    obj.RadiusDrivenBy = "Mass"
    set_value(obj, "TargetMass", 900.0)
    doc.recompute()
    assert "choose one from" in obj.Status
    assert obj.Mesh.CountFacets == triangles
    with pytest.raises(VolfrepError, match="No strut radius gives a mass of 900 g"):
        LivePreview(obj).show()


def test_a_material_of_ones_own_fills_density_and_deck(doc, box, tmp_path):
    (tmp_path / "mine.json").write_text('{"density": 3.0, "young": 5000, "poisson": 0.31}')
    obj = make_lattice_infill(doc, box, **LATTICE, PrintMaterial="Custom")
    with pytest.raises(VolfrepError, match="MaterialFile"):
        specification_of(obj)
    obj.MaterialFile = str(tmp_path / "mine.json")
    doc.recompute()
    assert density_of(obj) == pytest.approx(3.0)
    assert for_solver(obj).young == 5000
    assert mass_of(obj) == pytest.approx(obj.Volume.Value * 3.0 / 1000.0)


def test_the_material_of_freecads_solid_is_taken_over(doc, box):
    obj = make_lattice_infill(doc, box, **LATTICE, PrintMaterial="Of the solid")
    with pytest.raises(VolfrepError, match="has no material in FreeCAD"):
        specification_of(obj)
    import ObjectsFem

    made = ObjectsFem.makeMaterialSolid(doc, "Steel")
    made.Material = {
        "Name": "Steel-S235", "Density": "7850 kg/m^3", "YoungsModulus": "210 GPa",
        "PoissonRatio": "0.3",
    }  # fmt: skip
    box.addProperty("App::PropertyLink", "Material", "Base", "As in Arch")
    box.Material = made
    doc.recompute()
    assert density_of(obj) == pytest.approx(7.85)
    assert for_solver(obj).young == pytest.approx(210_000)
    assert for_solver(obj).name == "Steel-S235"
    made.Material = {"Name": "Steel", "Density": "7850 kg/m^3"}
    with pytest.raises(VolfrepError, match="YoungsModulus"):
        specification_of(obj)


def test_the_material_chosen_for_a_shape_is_taken_over(doc, box):
    """FreeCAD 1.0 and later: a shape has a material of the library's own."""
    if not hasattr(box, "ShapeMaterial"):
        pytest.skip("this FreeCAD's shapes have no materials")
    import Materials

    manager = Materials.MaterialManager()
    chosen = next(one for one in manager.Materials.values() if one.Name == "CalculiX-Steel")
    box.ShapeMaterial = manager.getMaterial(chosen.UUID)
    obj = make_lattice_infill(doc, box, **LATTICE, PrintMaterial="Of the solid")
    doc.recompute()
    assert density_of(obj) == pytest.approx(7.9)
    assert mass_of(obj) == pytest.approx(obj.Volume.Value * 7.9 / 1000.0)
    solver = for_solver(obj)
    assert (solver.young, solver.poisson, solver.name) == (210_000.0, 0.3, "CalculiX-Steel")
    other = next(one for one in manager.Materials.values() if "YoungsModulus" not in
                 one.PhysicalProperties and "Density" in one.PhysicalProperties)  # fmt: skip
    box.ShapeMaterial = manager.getMaterial(other.UUID)
    with pytest.raises(VolfrepError, match="has no YoungsModulus that can be read"):
        specification_of(obj)


@pytest.mark.costly_cases("TargetStiffness-MPa")
@pytest.mark.parametrize(("name", "unit"), [("TargetMass", "g"), ("TargetStiffness", "MPa")])
def test_expressions_say_targets_in_the_unit_that_is_shown(doc, box, name, unit):
    obj = driven(doc, box, name.removeprefix("Target"), PrintMaterial="PA12", **{name: 20.0})
    set_expression(obj, name, "2 * 10.5")
    assert is_driven(obj, name)
    assert number_of(obj, name) == pytest.approx(21.0)
    doc.recompute()
    assert number_of(obj, name) == pytest.approx(21.0)
    with pytest.raises(Exception, match="what"):
        set_expression(obj, name, "2 * what")
    assert number_of(obj, name) == pytest.approx(21.0)
    assert is_driven(obj, name)
    set_expression(obj, name, " ")
    assert not is_driven(obj, name)
    if obj.getTypeIdOfProperty(name) != "App::PropertyFloat":  # which knows no units
        set_expression(obj, name, f"3 * 2000 {unit} / 1000")
        assert number_of(obj, name) == pytest.approx(6.0)


def test_a_change_of_material_makes_no_new_mesh(doc, box):
    obj = make_lattice_infill(doc, box, **LATTICE)
    doc.recompute()
    fingerprint, volume = obj.Fingerprint, obj.Volume.Value
    obj.PrintMaterial = "IN718"
    doc.recompute()
    assert obj.Fingerprint == fingerprint
    assert mass_of(obj) == pytest.approx(volume * density_of(obj) / 1000.0)
    assert "ReadOnly" in obj.getEditorMode("Density")


def test_the_process_is_the_print_checks_and_says_what_it_cannot(doc, box):
    obj = make_lattice_infill(doc, box, **LATTICE, PrintMaterial="PA12")
    assert process_of(obj) == "SLS"
    assert advice(obj, 0.1) == ()
    obj.PrintProcess = "LPBF"
    assert process_of(obj) == "LPBF"
    material, struts = advice(obj, 0.2)
    assert material == "PA12 is printed by SLS or MJF, not by LPBF."
    assert struts.startswith("Struts of 0.4 mm are thinner than LPBF prints")
    assert make_print_check(doc, obj).Process == "LPBF"
    assert material in LivePreview(obj).show().text
