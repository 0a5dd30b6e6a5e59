# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preview of an infill: its figures are those of the mesh, and follow its values."""

import FreeCAD as App
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.infill.live_preview import LivePreview
from freecad_volfrep.features.properties.quantities import mass_of
from volfrep.util.errors import VolfrepError


def test_the_figures_are_those_of_the_computed_infill(doc, infill):
    shown = LivePreview(infill).show()
    assert shown.preview.mass == pytest.approx(mass_of(infill), rel=0.05)
    assert shown.preview.relative_density == pytest.approx(infill.RelativeDensity, rel=0.1)
    assert shown.preview.cells == infill.CellsActive
    assert shown.preview.struts == infill.Struts
    assert "relative density" in shown.text
    assert f"{infill.CellsActive} active cells" in shown.text


def test_it_follows_the_values_without_a_recompute(doc, box):
    obj = make_lattice_infill(doc, box, **SMALL)
    live = LivePreview(obj)
    first = live.show()
    obj.StrutRadius = 1.5
    thicker = live.show()
    assert thicker.preview.mass > first.preview.mass
    assert thicker.solid is first.solid, "what depends on the solid alone is kept"
    assert obj.Mesh.CountFacets == 0
    box.Length = 60
    doc.recompute([box])
    longer = live.show()
    assert longer.solid.bounds[1, 0] == pytest.approx(60)
    assert longer.preview.cells == 2 * first.preview.cells


def test_it_lies_where_the_solid_does(doc, box):
    box.Placement.Base = App.Vector(100, 0, 0)
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute([box])
    shown = LivePreview(obj).show()
    assert shown.preview.start[:, 0].min() > 100
    assert shown.preview.end[:, 0].max() < 130


def test_what_makes_no_sense_is_one_sentence(doc, box):
    obj = make_lattice_infill(doc, box, **SMALL)
    live = LivePreview(obj)
    obj.ShellThickness = 15
    with pytest.raises(VolfrepError, match="inside the skin"):
        live.show()
    obj.ShellThickness = 2
    obj.StrutRadius = 6
    with pytest.raises(VolfrepError, match="too thick"):
        live.show()
    obj.StrutRadius = 1
    assert live.show().preview.struts > 0
