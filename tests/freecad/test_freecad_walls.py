# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls in FreeCAD: chosen as a cell, with properties of their own, and made."""

import json

import FreeCAD as App
import pytest

from freecad_volfrep import make_lattice_infill, make_print_check
from freecad_volfrep.features.infill.live_preview import LivePreview

HIDDEN = "Hidden"


@pytest.fixture
def box():
    doc = App.newDocument("walls")
    made = doc.addObject("Part::Box", "Box")
    made.Length, made.Width, made.Height = 24, 20, 16
    doc.recompute()
    yield made
    App.closeDocument(doc.Name)


def hidden(obj, *names):
    return [HIDDEN in obj.getEditorMode(name) for name in names]


@pytest.mark.costly
def test_a_gyroid_fills_a_solid_and_shows_what_applies(box) -> None:
    doc = box.Document
    infill = make_lattice_infill(
        doc, box, CellType="Gyroid", CellSize=8, WallThickness=1.2, ShellThickness=1, Resolution=16
    )
    doc.recompute()
    assert infill.Status == "Up to date"
    assert (infill.Bodies, infill.Watertight, infill.Struts) == (1, True, 0)
    assert infill.Mesh.isSolid()
    assert hidden(infill, "StrutRadius", "JointFillet", "RemoveDangling") == [True] * 3
    assert hidden(infill, "WallKind", "WallThickness", "WallOffset") == [False, False, True]
    infill.WallKind = "Skeleton"
    doc.recompute()
    assert infill.Status == "Up to date"
    assert infill.RelativeDensity == pytest.approx(0.5, rel=0.02)
    assert hidden(infill, "WallThickness", "WallOffset") == [True, False]
    infill.CellType = "CVC"
    doc.recompute()
    assert infill.Struts > 0
    assert hidden(infill, "StrutRadius", "WallKind") == [False, True]


@pytest.mark.slow
def test_a_density_drives_the_thickness(box) -> None:
    doc = box.Document
    infill = make_lattice_infill(
        doc, box, CellType="Schwarz P", CellSize=8, ShellThickness=1, Resolution=16,
        RadiusDrivenBy="Relative density", TargetDensity=0.25,
    )  # fmt: skip
    doc.recompute()
    assert infill.Status == "Up to date"
    assert infill.RelativeDensity == pytest.approx(0.25, rel=5e-3)
    found = json.loads(infill.Report)["target"]["wall_thickness_mm"]
    assert infill.WallThickness.Value == pytest.approx(found)
    assert "ReadOnly" in infill.getEditorMode("WallThickness")
    told = LivePreview(infill).show().text.splitlines()[0]
    assert float(told.removeprefix("thickness ").removesuffix(" mm")) == pytest.approx(
        found, rel=0.03
    )


def test_a_formula_of_ones_own_is_made_and_a_wrong_one_refused(box) -> None:
    doc = box.Document
    infill = make_lattice_infill(
        doc, box, CellType="Formula", CellSize=8, WallThickness=1.2, ShellThickness=1, Resolution=16
    )
    doc.recompute()
    assert infill.Status == "Up to date"
    made = infill.Triangles
    infill.WallFormula = "x + y"
    doc.recompute()
    assert "must repeat" in infill.Status
    assert infill.Triangles == made


@pytest.mark.slow
def test_the_preview_and_the_print_check_know_walls(box) -> None:
    doc = box.Document
    infill = make_lattice_infill(
        doc, box, CellType="Gyroid", CellSize=8, WallThickness=0.6, ShellThickness=1, Resolution=24
    )
    shown = LivePreview(infill).show()
    assert len(shown.preview.surface.triangles) > 1000
    assert shown.stiffness is None
    doc.recompute()
    assert shown.preview.relative_density == pytest.approx(infill.RelativeDensity, rel=0.06)
    check = make_print_check(doc, infill, "SLS")
    doc.recompute()
    assert check.ThinnestWall == pytest.approx(0.6, rel=0.01)
    assert any("Walls are down to 0.6 mm" in sentence for sentence in check.Findings)
