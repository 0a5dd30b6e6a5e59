# SPDX-License-Identifier: LGPL-2.1-or-later
"""Design studies as objects of a document: run, opened again, and a design given to the infill."""

from pathlib import Path

import FreeCAD as App
import pytest

from conftest import SMALL
from freecad_volfrep import apply_design, make_design_study, make_lattice_infill, run_study
from freecad_volfrep.engine import require_engine
from freecad_volfrep.features import DesignStudy
from freecad_volfrep.features.study.design_study import designs_of_study
from volfrep.util.errors import VolfrepError


@pytest.fixture(autouse=True)
def _unplotted(monkeypatch):
    """A page's plots take a second each; tests/core/studies/test_page looks at them."""
    require_engine()
    from volfrep.studies import page

    monkeypatch.setattr(page, "plots_of", lambda *_: [])


@pytest.fixture
def infill(doc, box):
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    return obj


@pytest.fixture
def study(doc, infill):
    made = make_design_study(doc, infill, CellType="BCC, cvc", StrutRadius="0.8 mm to 1.2 mm in 3")
    assert run_study(made)
    return made


@pytest.mark.costly
def test_a_study_has_a_design_for_each_combination(study):
    rows = designs_of_study(study)
    assert study.Designs == len(rows) == 6
    assert [row["strut_radius"] for row in rows if row["cell"] == "CVC"] == [0.8, 1.0, 1.2]
    assert all(row["forecast.mass_g"] > 0 and row["properties.E100"] > 0 for row in rows)
    assert any(row["chosen"] for row in rows)
    assert study.Status == "6 designs of Block lattice" or study.Status.startswith("6 designs of")


def test_a_design_given_to_the_infill_is_that_design(study, infill):
    (row,) = (r for r in designs_of_study(study) if r["cell"] == "BCC" and r["strut_radius"] == 1.2)
    assert apply_design(study, row["key"])
    assert infill.CellType == "BCC"
    assert infill.StrutRadius.Value == 1.2
    assert infill.Mesh.Volume / 1000 == pytest.approx(row["forecast.mass_g"], rel=0.06)
    with pytest.raises(VolfrepError, match="no design 'x'"):
        apply_design(study, "x")


@pytest.mark.slow
def test_what_was_measured_is_what_the_infill_becomes(doc, infill):
    study = make_design_study(doc, infill, StrutRadius="0.9, 1.1")
    study.Fill = True
    run_study(study)
    row = designs_of_study(study)[1]
    assert apply_design(study, row["key"])
    assert infill.Volume.Value == pytest.approx(row["fill.volume_mm3"], rel=1e-9)
    assert infill.Triangles == row["fill.triangles"]


def test_saved_and_opened_it_has_its_designs_and_runs_on(doc, study, tmp_path):
    path, name = str(tmp_path / "study.FCStd"), study.Name
    doc.saveCopy(path)
    again = App.openDocument(path)
    try:
        found = again.getObject(name)
        assert isinstance(found.Proxy, DesignStudy)
        assert designs_of_study(found) == designs_of_study(study)
        found.Vary = [*found.Vary, "ShellThickness: 1, 2"]
        assert run_study(found)
        assert found.Designs == 12
    finally:
        App.closeDocument(again.Name)


@pytest.mark.slow
def test_a_graded_lattice_is_studied_by_its_mass_alone(doc, infill):
    infill.SizeGrading = "Linear"
    infill.LambdaEnd = 1.5
    study = make_design_study(doc, infill, StrutRadius="0.8, 1.0")
    run_study(study)
    rows = designs_of_study(study)
    assert len(rows) == 2
    assert "properties.E100" not in rows[0]


@pytest.mark.slow
def test_combinations_without_sense_are_told_and_passed_over(doc, infill):
    study = make_design_study(doc, infill, CellSize="10, 99", StrutRadius="1, 6")
    run_study(study)
    assert study.Designs == 1
    assert len(study.Refused) >= 2
    next(Path(study.Folder).glob("records/*.json")).write_text("{")
    run_study(study)
    assert study.Designs == 1
    assert "is damaged" in study.Refused[-1], "and its run was done anew"


def test_what_a_study_refuses(doc, box, infill):
    with pytest.raises(VolfrepError, match="not a lattice infill"):
        make_design_study(doc, box)
    for vary, words in (
        ({"LambdaEnd": "1, 2"}, "'LambdaEnd' cannot vary here: choose from CellType,"),
        ({"CellSize": "8 kg"}, "CellSize: '8 kg' has the unit 'kg'"),
        ({"CellSize": ""}, "CellSize has no values"),
        ({"CellSize": "9 to 8 in 3"}, "from a number to a larger one"),
        ({"Activation": "sometimes"}, "no 'sometimes'"),
    ):
        with pytest.raises(VolfrepError, match=words):
            make_design_study(doc, infill, **vary)
    assert [obj.Name for obj in doc.Objects] == [box.Name, infill.Name]


def test_a_study_without_its_infill_says_so(doc, study):
    study.Infill = None
    with pytest.raises(VolfrepError, match="choose a lattice infill"):
        run_study(study)
    assert study.Designs == 6, "the last table stays"


@pytest.mark.slow
def test_a_study_varies_what_drives_the_radius(doc, infill):
    infill.RadiusDrivenBy = "Relative density"
    infill.TargetDensity = 0.2
    infill.PrintMaterial = "PA12"
    study = make_design_study(doc, infill, TargetDensity="0.15, 0.25")
    with pytest.raises(VolfrepError, match="'StrutRadius' cannot vary here"):
        make_design_study(doc, infill, StrutRadius="1, 2")
    run_study(study)
    thin, thick = designs_of_study(study)
    assert (thin["relative_density"], thick["relative_density"]) == (0.15, 0.25)
    assert 1.0 < thin["properties.E100"] < thick["properties.E100"] < 1650.0, "MPa of PA12"
    assert apply_design(study, thick["key"])
    assert infill.TargetDensity == 0.25
    assert infill.RelativeDensity == pytest.approx(0.25, rel=0.005)


@pytest.mark.slow
def test_runs_are_done_in_processes_beside_freecad(doc, infill, monkeypatch):
    from volfrep.studies.running import child, scheduling

    program, started = child._program, []

    def starting(batch):
        found = program(batch)
        started.append(found.command[0])
        return found

    monkeypatch.setattr(child, "_program", starting)
    monkeypatch.setattr(scheduling, "WORTH_A_PROCESS", 0.0)
    monkeypatch.setattr(scheduling, "fitting_workers", lambda *_: 2)
    study = make_design_study(doc, infill, StrutRadius="0.9, 1.1")
    study.Fill = True
    assert run_study(study)
    rows = designs_of_study(study)
    assert [row["state"] for row in rows] == ["done", "done"], rows
    assert all("python" in path for path in started)
    assert len(started) >= 2
