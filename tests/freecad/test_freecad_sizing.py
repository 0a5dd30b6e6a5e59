# SPDX-License-Identifier: LGPL-2.1-or-later
"""Size Lattice and Strut Results without a window: from analyses to radii in the document."""

import json
import shutil

import FreeCAD as App
import numpy as np
import pytest
from test_freecad_fem_loads import add, analysis_of, face_at

from freecad_volfrep import make_lattice_infill, size_lattice
from freecad_volfrep.features.infill.live_preview import LivePreview
from freecad_volfrep.features.sizing.as_built import (
    building_in_words,
    building_of,
    is_sized_for_print,
    sized_as_printed,
)
from freecad_volfrep.features.sizing.sized_states import (
    limit_names,
    limits_of,
    sized_states,
    why_no_limits,
    why_no_states,
)
from freecad_volfrep.features.sizing.sizing import (
    GOALS,
    ONLY_OF,
    analyses_of,
    carried_by,
    first_numbers,
    size_struts,
    solve_struts,
    store_outcome,
)
from volfrep.jobs.figures.point_values import point_values, values_on_struts
from volfrep.util.errors import VolfrepError

BEAM = {
    "CellType": "BCC",
    "CellSize": 10,
    "StrutRadius": 0.8,
    "ShellThickness": 0,
    "Resolution": 13,
    "AutoUpdate": False,  # what is sized needs no mesh
}


@pytest.fixture
def infill(doc):
    """A cantilever of 3 x 1 x 1 cells without a skin."""
    box = doc.addObject("Part::Box", "Beam")
    box.Length, box.Width, box.Height = 30, 10, 10
    doc.recompute()
    return make_lattice_infill(doc, box, **BEAM)


def loaded(infill, name="bend", force=160.0):
    """An analysis: the left side held, the right one pushed down."""
    doc, box = infill.Document, infill.Base
    analysis = analysis_of(doc, name)
    add(analysis, "Fixed", [(box, face_at(box, (0, 5, 5)))])
    load = add(analysis, "Force", [(box, face_at(box, (30, 5, 5)))], Force=force,
               Direction=(box, [upright(box)]))  # fmt: skip
    load.Reversed = load.DirectionVector.z > 0
    doc.recompute()
    return analysis


def upright(box):
    """The name of an edge along z."""
    for k, edge in enumerate(box.Shape.Edges):
        if abs(edge.tangentAt(0).z) > 0.99:
            return f"Edge{k + 1}"
    raise AssertionError


def sized(infill, analyses, told=None, *, goal="mass", prove=False, **numbers):
    """Least mass at half the yield stress, and no other solver, unless it says otherwise."""
    asked = {"safety": 2.0, "thinnest": 0.3, "thickest": 1.6, **numbers}
    return size_struts(infill, analyses, asked, told, goal=goal, prove=prove)


@pytest.mark.slow
def test_thin_struts_are_removed_and_stay_so_in_the_document(infill):
    doc, box = infill.Document, infill.Base
    analysis = analysis_of(doc, "one end")  # nothing is done to the other
    add(analysis, "Fixed", [(box, face_at(box, (15, 5, 0)))])
    add(analysis, "Force", [(box, face_at(box, (0, 5, 5)))], Force=600.0)
    wished = {"safety": 4, "thinnest": 0.4, "thickest": 1.6, "prove": False}
    outcome = size_lattice(infill, [analysis], **wished, remove_thin=True)
    assert outcome.holds
    assert infill.RemoveBelow.Value > 0.4
    assert infill.RemoveDangling
    infill.AutoUpdate = True
    doc.recompute()
    assert infill.Struts == len(outcome.part.model.wireframe.struts)
    assert json.loads(infill.Report)["thin_struts_removed"] > 0
    assert infill.Bodies == 1


@pytest.mark.slow
def test_a_design_for_printing_has_no_flat_struts_and_is_again_one_of_all(infill):
    """Of FCC cells built along x those across it lie flat; the document keeps what was asked."""
    doc, infill.CellType, infill.PrintProcess = infill.Document, "FCC", "LPBF"
    infill.BuildDirection = App.Vector(1, 0, 0)
    loaded(infill)
    wanted = {"safety": 2, "thinnest": 0.1, "thickest": 1.6, "prove": False}
    outcome = size_lattice(infill, **wanted, for_print=True)

    def steepness(model):
        """Inclinations to the plane across x, degrees."""
        ends = model.wireframe.nodes[model.wireframe.struts]
        along = np.abs(ends[:, 1] - ends[:, 0])
        return np.degrees(np.arcsin(along[:, 0] / np.linalg.norm(along, axis=1)))

    assert outcome.holds
    assert steepness(outcome.part.model).min() > 44.9
    assert outcome.part.radii.min() >= 0.3  # LPBF prints 0.6 mm
    assert (infill.RemoveFlatter, is_sized_for_print(infill)) == (45.0, True)
    gone = outcome.part.report["building"]["removed"]
    said = outcome.summary().split("\n")
    assert f"For LPBF, built along x: {gone} struts that lie flatter than 45 degrees" in said[1]
    assert "Struts are no thinner than LPBF prints: 0.3 mm in radius." in said
    assert outcome.summary().count("no thinner") == 1
    rows = dict(next(one for one in outcome.tables() if one.title == "For printing").rows)
    assert (rows["process"], rows["build direction"]) == ("LPBF", "x")
    assert rows["flatter struts removed"] == gone > 0
    assert rows["flatter parts of the outside, mm2"] == 0.0  # an end stands on the plate
    assert "<td>LPBF</td>" in outcome.page("Beam")
    infill.AutoUpdate = True
    doc.recompute()
    assert json.loads(infill.Report)["flat_struts_removed"] == gone
    # Sized again for what it is, all struts are there again.
    whole = size_lattice(infill, **wanted)
    assert (infill.RemoveFlatter, is_sized_for_print(infill)) == (0.0, False)
    assert steepness(whole.part.model).min() < 1.0
    assert "LPBF" not in whole.summary()


def test_what_printing_asks_for_is_told_before(infill):
    assert not is_sized_for_print(infill)
    with pytest.raises(VolfrepError, match="No process is chosen to build for"):
        building_of(infill)
    infill.PrintMaterial = "Ti-6Al-4V"  # which is printed by LPBF
    assert building_in_words(building_of(infill)) == (
        "LPBF, built along z: struts from 0.6 mm thick and 45 degrees steep, walls from 0.4 mm"
    )
    infill.PrintProcess, infill.BuildDirection = "SLS", App.Vector(0, -1, 1)
    said = building_in_words(building_of(infill))
    assert said == "SLS, built along 0, -1, 1: struts from 0.8 mm thick, walls from 0.7 mm"


@pytest.mark.costly
def test_struts_are_sized_stored_and_stay_within_their_limits(infill):
    analyses = [loaded(infill)]
    assert analyses_of(infill) == analyses
    steps = []
    outcome = sized(infill, analyses, steps.append, max_displacement=0.3, buckling=1.0, prove=True)
    assert outcome.holds
    assert len(steps) + 1 == len(outcome.steps) > 3
    stress = max(state.stress.max() for state in outcome.states)
    moved = max(state.displacement.max() for state in outcome.states)
    assert stress <= 1.01 * 903 / 2
    assert moved <= 1.01 * 0.3
    assert "of one radius they would weigh" in outcome.summary()
    tables = {table.title: dict((*row, "")[:2] for row in table.rows) for table in outcome.tables()}
    assert list(tables)[:3] == ["Struts", "Limits", "Results of bend"]
    assert list(tables)[-1] == "Steps"
    page = outcome.page("Beam")
    assert "Beam: sized for loads" in page
    assert "<svg" in page, "its loads are drawn"
    assert tables["Results of bend"]["load before struts buckle together, times"] > 1.0
    if shutil.which("ccx"):
        assert max(outcome.part.report["calculix"]["displacements_off"]) < 0.01
        assert "CalculiX's displacements of the same beams differ by" in outcome.summary()
        assert "does not confirm" not in outcome.summary()
        proof = outcome.part.report["calculix"]
        assert tables["The same beams in CalculiX"]["confirmed"] == "yes"
        proof["confirmed"] = proof["worst_strut_compared"] = False
        assert "CalculiX does not confirm this design" in outcome.summary()
        told = dict(row[:2] for row in outcome.tables()[3].rows)
        assert told["confirmed"] == "no"
        assert "largest stress, CalculiX / VOLFREP" not in told
    else:
        assert "no other solver has proved this design" in outcome.summary()
    assert json.loads(outcome.to_json())["struts"] == len(outcome.states[0].radii)

    assert "no stresses are kept" in why_no_states(infill).lower()
    infill.RemoveBelow = 0.5
    store_outcome(infill, outcome)
    assert infill.RemoveBelow.Value == 0, "nothing is removed that was not asked for"
    assert infill.Proxy.update(infill), infill.Status
    assert infill.StrutRadii == pytest.approx(
        [outcome.part.radii.min(), outcome.part.radii.max()], abs=1e-4
    )
    # The lattice that was made does what the design did.
    (state,) = solve_struts(infill)
    assert state.stress.max() == pytest.approx(stress, rel=1e-3)
    assert state.displacement.max() == pytest.approx(moved, rel=1e-3)


@pytest.mark.costly
def test_what_struts_carry_is_kept_with_the_document(infill, tmp_path):
    analysis = loaded(infill)
    outcome = sized(infill, [analysis])
    store_outcome(infill, outcome)
    name, path = infill.Name, str(tmp_path / "sized.FCStd")
    infill.Document.saveCopy(path)
    doc = App.openDocument(path)
    try:
        again = doc.getObject(name)
        assert why_no_states(again) == ""
        ends, kept = sized_states(again)
        (state,) = outcome.states
        assert ends == pytest.approx(state.ends, abs=1e-4)
        assert kept["Stress"] == pytest.approx(state.stress, rel=1e-6)
        assert kept["Displacement"] == pytest.approx(state.displacement, rel=1e-6)
        assert limits_of(again, "Governing limit")[1] == pytest.approx(state.governing)
        assert len(limit_names(again, "Governing limit")) == state.governing.max() + 1
        assert "skin was not sized" in why_no_limits(again, "Governing limit of the skin")
        shown = LivePreview(again).show()
        assert shown.is_sized
        struts = shown.preview
        drawn = values_on_struts(struts.start, struts.end, ends, kept["Stress"])
        assert drawn.max() == pytest.approx(state.stress.max(), rel=1e-5)
        again.CellSize = 5
        assert "size it again" in why_no_states(again)
        assert not LivePreview(again).show().is_sized
    finally:
        App.closeDocument(doc.Name)


@pytest.mark.slow
def test_colours_peak_where_the_design_does(infill, tmp_path):
    """With a skin, whose triangles follow the struts it was sized with: one figure, not two."""
    infill.ShellThickness = 1
    analyses = [loaded(infill), loaded(infill, "light", 40.0)]
    outcome = sized(infill, analyses, safety=0, max_displacement=0.05)
    store_outcome(infill, outcome)
    told = max(row[1] for table in outcome.tables() for row in table.rows
               if row[0] == "largest stress, MPa")  # fmt: skip

    def peak(obj):
        solid, spec, _ = obj.Proxy.wanted(obj)
        middle = outcome.states[0].ends.mean(axis=1)
        return point_values(
            solid, spec, "Stress", middle, middle, **carried_by(obj, "Stress")
        ).high  # fmt: skip

    assert peak(infill) == pytest.approx(told, rel=1e-6)
    path = str(tmp_path / "peak.FCStd")
    infill.Document.saveCopy(path)
    doc = App.openDocument(path)
    try:
        assert peak(doc.getObject(infill.Name)) == pytest.approx(told, rel=1e-6)
    finally:
        App.closeDocument(doc.Name)
    # Other loads are another question, and what is kept is no answer to it.
    (push,) = [one for one in analyses[0].Group if one.TypeId == "Fem::ConstraintForce"]
    push.Force = 2.0 * push.Force
    infill.Document.recompute()
    assert "loads" in carried_by(infill, "Stress")
    assert peak(infill) == pytest.approx(2.0 * told, rel=0.2)


@pytest.mark.slow
def test_the_stiffest_struts_of_a_mass_beat_one_radius(infill):
    analyses = [loaded(infill)]
    outcome = sized(infill, analyses, goal="stiffness")
    before, after = outcome.part.before, outcome.part.sized.analysis
    assert after.volume == pytest.approx(before.volume, rel=2e-3)
    assert before.compliance[0] > 1.3 * after.compliance[0]
    assert "times as stiff" in outcome.summary()
    heavier = sized(infill, analyses, goal="stiffness", strut_mass=1.5 * outcome.mass)
    assert heavier.mass == pytest.approx(1.5 * outcome.mass, rel=5e-3)


def test_every_analysis_is_a_case(infill):
    analyses = [loaded(infill), loaded(infill, "light", 40.0)]
    states = solve_struts(infill)
    assert [state.name for state in states] == ["bend", "light"]
    assert states[0].stress == pytest.approx(4.0 * states[1].stress, rel=1e-6)
    outcome = sized(infill, analyses[1:])
    assert [state.name for state in outcome.states] == ["light"]


def test_what_cannot_be_sized_is_told(doc, infill):
    with pytest.raises(VolfrepError, match="has no load case: make one with Loads and Sizing"):
        analyses_of(infill)
    analysis = loaded(infill)
    with pytest.raises(VolfrepError, match="No load case is chosen"):
        sized(infill, [])
    with pytest.raises(VolfrepError, match="Least mass needs a limit"):
        sized(infill, [analysis], safety=0)
    with pytest.raises(VolfrepError, match="must be above 0 and below the largest"):
        sized(infill, [analysis], thinnest=2.0)
    (material,) = [o for o in analysis.Group if o.isDerivedFrom("App::MaterialObject")]
    material.Material = {k: v for k, v in material.Material.items() if k != "YieldStrength"}
    with pytest.raises(VolfrepError, match="has no yield stress for safety"):
        sized(infill, [analysis])
    outcome = sized(infill, [analysis], safety=0, max_displacement=1e-5)
    assert not outcome.holds
    assert "The limit of displacement cannot be held" in outcome.summary()


@pytest.mark.costly
def test_struts_are_drawn_so_that_what_is_printed_holds_the_stress(doc):
    """Four bars pulled by 400 N need a section of 400 / 4 / 300 mm2 each at 300 MPa."""
    box = doc.addObject("Part::Box", "Row")
    box.Length, box.Width, box.Height = 40, 10, 10
    doc.recompute()
    row = make_lattice_infill(doc, box, **{
        **BEAM, "CellType": "Box", "StrutRadius": 0.5, "Resolution": 8, "Boundary": "Whole",
        "BuildDirection": App.Vector(1, 0, 1), "PrintMaterial": "Ti-6Al-4V",
    })  # fmt: skip
    analysis = analysis_of(doc, "pull")
    add(analysis, "Fixed", [(box, face_at(box, (0, 5, 5)))])
    add(analysis, "Force", [(box, face_at(box, (40, 5, 5)))], Force=400.0)
    doc.recompute()
    wanted = {"max_stress": 300, "safety": 0, "thinnest": 0.2, "prove": False}
    found = size_lattice(row, **wanted, as_printed="lpbf-ti64")
    needed, added = (
        2 * np.sqrt(400 / 4 / 300 / np.pi),
        0.080,
    )  # by the published table at 45 degrees
    assert 2 * found.part.radii.max() == pytest.approx(needed - added, rel=5e-3)
    assert found.printed == "LPBF, Ti-6Al-4V"
    assert found.summary().count("as printed (LPBF, Ti-6Al-4V)") == 1
    assert "come out" not in found.summary(), "the same is not told twice"
    table = next(one for one in found.tables() if one.title.startswith("As printed"))
    told = {name: values for name, *values in table.rows}
    assert told["thinnest and thickest strut as printed, mm"][1] == pytest.approx(needed, rel=5e-3)
    # The document knows it, and Strut Results are of the same struts.
    assert sized_as_printed(row) == ("LPBF-Ti64", 0.0)
    (state,) = solve_struts(row)
    assert state.stress.max() == pytest.approx(300, rel=2e-2)
    stiffer = size_lattice(row, **wanted)
    assert sized_as_printed(row) == ("", 0.0)
    assert "printed" not in stiffer.summary()
    assert 2 * stiffer.part.radii.max() == pytest.approx(needed, rel=5e-3)
    with pytest.raises(VolfrepError, match="does not say how far diameters scatter"):
        size_lattice(row, **wanted, as_printed="SLS-PA12", scatter=1)


def test_a_script_sizes_in_one_call(infill):
    loaded(infill)
    outcome = size_lattice(infill, safety=2, thinnest=0.3, thickest=1.6, prove=False)
    assert outcome.holds
    assert infill.RadiusGrading == "Field"
    assert list(infill.SizedRadii) == pytest.approx(outcome.part.radii)
    assert json.loads(infill.SizingReport)["holds"] is True
    with pytest.raises(VolfrepError, match="There is no goal 'safty': choose from max_stress"):
        size_lattice(infill, safty=2)


@pytest.mark.slow
def test_a_sized_skin_goes_into_the_part_and_stays_with_the_document(infill, tmp_path):
    """Thicknesses are stored, followed, told, undone and opened again."""
    doc, infill.ShellThickness = infill.Document, 1.0
    analysis = loaded(infill, force=1000.0)
    told = thickness_at_points(infill)
    doc.openTransaction("Loads and Sizing")
    outcome = size_lattice(
        infill, [analysis], safety=2, thinnest=0.3, thickest=1.6, skin_thinnest=0.5,
        skin_thickest=2.5, prove=False,
    )  # fmt: skip
    doc.commitTransaction()
    assert outcome.holds
    low, high = outcome.part.report["skin"]["thickness_mm"]
    assert high > 1.5 * low
    assert (infill.ShellThickness.Value, infill.SkinFollowsSizing) == (0.5, True)
    assert infill.Proxy.update(infill), infill.Status
    # The part weighs what the search has told, skin and struts.
    split = dict(row[:2] for table in outcome.tables() if table.title in ("Struts", "Mass")
                 for row in table.rows)  # fmt: skip
    assert infill.Volume.Value * outcome.density / 1000.0 == pytest.approx(
        split["mass, g"], rel=0.01
    )
    assert split["mass, g"] == pytest.approx(
        split["mass of the struts, g"] + split["mass of the skin, g"]
    )
    assert "a skin of" in outcome.summary()
    # Its outside is coloured by what was asked for there.
    sized = thickness_at_points(infill)
    assert told == pytest.approx(1.0)
    assert 0.5 <= sized.min() < 1.1 * low
    assert sized.max() >= 0.9 * high  # where it is solid, so much goes in from either side
    assert why_no_states(infill) == ""

    volume, path = infill.Volume.Value, str(tmp_path / "skin.FCStd")
    doc.saveCopy(path)
    copy = App.openDocument(path)
    try:
        again = copy.getObject(infill.Name)
        assert why_no_states(again) == ""
        assert thickness_at_points(again) == pytest.approx(sized, abs=1e-5)
        again.touch()
        copy.recompute()
        assert again.Volume.Value == pytest.approx(volume, rel=1e-6)
        again.SkinFollowsSizing = False
        assert thickness_at_points(again) == pytest.approx(0.5)
        assert "size it again" in why_no_states(again)
    finally:
        App.closeDocument(copy.Name)
    App.setActiveDocument(doc.Name)
    doc.undo()
    assert (infill.ShellThickness.Value, len(infill.SizedSkin)) == (1.0, 0)
    doc.redo()
    assert thickness_at_points(infill) == pytest.approx(sized)
    # A file goes before it.
    table = tmp_path / "thickness.csv"
    table.write_text("x,y,z,mm\n0,5,5,0.8\n30,5,5,0.8\n")
    infill.SkinField = str(table)
    assert thickness_at_points(infill) == pytest.approx(0.8)


def thickness_at_points(infill):
    """What Colour By shows as the thickness of the skin, at the middles of its solid's facets."""
    solid, spec, _ = infill.Proxy.wanted(infill)
    middles = solid.vertices[solid.triangles].mean(axis=1)
    return point_values(solid, spec, "Skin", middles, middles).values


@pytest.mark.slow
def test_a_mass_may_be_that_of_struts_and_skin(infill):
    infill.ShellThickness = 1.0
    loaded(infill)
    outcome = size_lattice(infill, goal="stiffness", strut_mass=9.0, skin_thinnest=0.5, prove=False)
    split = outcome.part.report["masses_g"]
    assert split["struts"] + split["skin"] == pytest.approx(9.0, rel=0.02)
    assert infill.Proxy.update(infill), infill.Status
    assert infill.Volume.Value * outcome.density / 1000.0 == pytest.approx(9.0, rel=0.02)


@pytest.mark.slow
def test_a_random_network_is_sized_as_cells_are(doc):
    box = doc.addObject("Part::Box", "Beam")
    box.Length, box.Width, box.Height = 30, 10, 10
    doc.recompute()
    infill = make_lattice_infill(
        doc, box, Network="Voronoi", NetworkPoints=15, StrutRadius=0.6, ShellThickness=1.5
    )
    doc.recompute()
    struts = infill.Struts
    loaded(infill)
    outcome = size_lattice(infill, goal="stiffness", prove=False)
    before, after = outcome.part.before, outcome.part.sized.analysis
    assert before.compliance[0] > after.compliance[0]
    doc.recompute()
    assert infill.isValid(), infill.Status
    assert (infill.Struts, infill.Bodies) == (struts, 1)
    assert list(infill.SizedRadii) == pytest.approx(outcome.part.radii)


@pytest.mark.slow
def test_a_target_gives_the_mass_that_is_distributed(infill):
    loaded(infill)
    infill.RadiusDrivenBy, infill.TargetDensity = "Relative density", 0.05
    outcome = size_lattice(infill, goal="stiffness", thinnest=0.3, thickest=1.6, prove=False)
    assert "asks for struts of" in outcome.part.report["notes"][0]
    assert infill.RadiusDrivenBy == "Radius"
    assert infill.Proxy.update(infill), infill.Status
    assert infill.RelativeDensity == pytest.approx(0.05, rel=0.05)  # of coarse facets


@pytest.mark.slow
def test_an_infill_stays_as_it_is_until_radii_are_stored(infill):
    before = infill.Fingerprint, infill.RadiusGrading
    analysis = loaded(infill)
    size_struts(infill, [analysis], first_numbers(infill), prove=False)
    assert (infill.Fingerprint, infill.RadiusGrading) == before
    assert set(GOALS) == set(ONLY_OF) == {"mass", "stiffness"}
