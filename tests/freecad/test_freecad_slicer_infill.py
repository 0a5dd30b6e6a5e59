# SPDX-License-Identifier: LGPL-2.1-or-later
"""A slicer's infill as an object: its bands follow the solid, are saved, copied and undone."""

import zipfile

import FreeCAD as App
import pytest
from test_freecad_grading import STRESS, result_of

from freecad_volfrep import make_slicer_infill, save_project
from freecad_volfrep.engine import require_engine
from freecad_volfrep.features import SlicerInfill
from freecad_volfrep.features.export.slicer_infill import UP_TO_DATE, pieces_of, source_of
from freecad_volfrep.features.properties.quantities import mass_of
from volfrep.util.errors import VolfrepError


@pytest.fixture(autouse=True)
def _coarse(monkeypatch):
    """Fine grids take seconds each; tests/core/jobs/test_slicer_infill looks at what they give."""
    require_engine()
    from volfrep.jobs import slicer_infill

    monkeypatch.setattr(slicer_infill, "NODES", 8000)


@pytest.fixture
def bands(doc, box):
    obj = make_slicer_infill(doc, box, Bands=3, Reach=6)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


def test_its_bands_lie_in_the_solid_and_follow_it(doc, box, bands):
    assert bands.Status == UP_TO_DATE
    solid, *rest = pieces_of(bands)
    assert solid.volume == pytest.approx(30 * 20 * 20)
    assert len(rest) == len(bands.BandDensities) - 1 == 2
    assert rest[0].volume > rest[1].volume > 0
    assert sorted(bands.BandDensities) == bands.BandDensities
    assert bands.FilamentVolume.Value > bands.SolidVolume.Value > 0
    assert mass_of(bands) == pytest.approx(bands.FilamentVolume.Value * 1.24 / 1000)
    before = bands.FilamentVolume.Value
    box.Length = 60
    doc.recompute()
    assert pieces_of(bands)[0].volume == pytest.approx(60 * 20 * 20)
    assert bands.FilamentVolume.Value > 1.5 * before


def test_saved_opened_copied_and_undone(doc, box, bands, tmp_path):
    densities, counts = list(bands.BandDensities), list(bands.Facets)
    path, name = str(tmp_path / "bands.FCStd"), bands.Name
    doc.saveCopy(path)
    again = App.openDocument(path)
    try:
        found = again.getObject(name)
        assert isinstance(found.Proxy, SlicerInfill)
        assert list(found.Facets) == counts
        assert len(pieces_of(found)) == 3
        save_project(found, tmp_path / "again.3mf", "orca")
        copy = again.copyObject(found, False)
        assert isinstance(copy.Proxy, SlicerInfill)
        assert list(copy.Facets) == counts
        assert copy.Base == found.Base
    finally:
        App.closeDocument(again.Name)
    doc.openTransaction("Denser")
    bands.DensityEnd = 80
    doc.recompute()
    doc.commitTransaction()
    assert list(bands.BandDensities) != densities
    doc.undo()
    assert list(bands.BandDensities) == densities
    assert len(pieces_of(bands)) == 3


def test_it_lies_where_the_solid_does(doc, box):
    part = doc.addObject("App::Part", "Assembly")
    part.Placement.Base = App.Vector(100, 0, 0)
    obj = make_slicer_infill(doc, box, Bands=2, Follows="Formula", Formula="10 + z")
    part.addObject(obj)  # and the box with it
    doc.recompute()
    placed = pieces_of(obj, is_placed=True)
    assert placed[0].bounds[0] == pytest.approx([100, 0, 0], abs=1e-4)
    assert pieces_of(obj)[0].bounds[0] == pytest.approx([0, 0, 0], abs=1e-4)
    # 20 % and more lie above half the height.
    assert placed[1].bounds[0, 2] == pytest.approx(10, abs=0.6)


@pytest.mark.parametrize(
    ("slicer", "config"),
    [("prusa", "Metadata/Slic3r_PE_model.config"), ("orca", "Metadata/model_settings.config")],
)
def test_a_project_for_each_slicer(bands, tmp_path, slicer, config):
    path = tmp_path / "part.3mf"
    save_project(bands, path, slicer)
    with zipfile.ZipFile(path) as package:
        said = package.read(config).decode()
    for told in bands.ToldDensities:
        assert f'value="{told:.1f}%"' in said


def test_what_it_refuses(doc, box, bands, infill, tmp_path):
    bands.Follows = "Formula"
    with pytest.raises(VolfrepError, match="out of date"):
        save_project(bands, tmp_path / "part.3mf")
    doc.recompute()
    assert "write one as Formula" in bands.Status
    bands.Follows, bands.FieldObject = "Sized lattice", infill
    doc.recompute()
    assert "no radii of a sizing" in bands.Status
    bands.Follows, bands.Bands = "Direction", 9
    doc.recompute()
    assert "number of bands" in bands.Status
    with pytest.raises(VolfrepError, match="no property 'Colour'"):
        make_slicer_infill(doc, box, Colour=1)


def test_bands_follow_a_fem_result(doc, box, tmp_path):
    """10 MPa at one end and 80 at the other, alike on both sides of the middle at x = 15."""
    result = result_of(doc, STRESS)
    obj = make_slicer_infill(
        doc, box, Follows="FEM result", FieldObject=result, Bands=2, DensityEnd=50, Walls=0,
        TopLayers=0, BottomLayers=0,
    )  # fmt: skip
    doc.recompute()
    assert obj.Status == UP_TO_DATE
    assert source_of(result) == obj.Follows
    low, high = obj.BandDensities
    assert low + high == pytest.approx(60, abs=0.5)
    (band,) = pieces_of(obj, is_placed=True)[1:]
    assert band.bounds[0, 0] == pytest.approx(15, abs=0.1)
    save_project(obj, tmp_path / "part.3mf")
    before = obj.FilamentVolume.Value
    result.vonMises = [10.0, 80.0, 80.0, 80.0, 80.0, 80.0]
    doc.recompute()
    assert obj.FilamentVolume.Value > 1.05 * before, "it follows the result"
    obj.FieldColumn = "Temperature"
    doc.recompute()
    assert "no number 'Temperature'" in obj.Status
    assert "choose vonMises as FieldColumn" in obj.Status
    obj.FieldColumn, obj.FieldObject = "", box
    doc.recompute()
    assert "as FieldObject" in obj.Status


def test_bands_of_a_sized_lattice(doc, box, infill):
    import numpy as np

    from freecad_volfrep.features.infill.sized_radii import store_radii

    x = np.linspace(0.0, 30.0, 13)
    nodes = np.stack([x, np.full(13, 10.0), np.full(13, 10.0)], axis=1)
    store_radii(infill, nodes, 0.5 + x / 30.0)
    obj = make_slicer_infill(doc, box, Follows="Sized lattice", Bands=3)
    obj.FieldObject = infill
    doc.recompute([obj])
    assert obj.Status == UP_TO_DATE
    assert 3 < obj.BandDensities[0] < 25 < obj.BandDensities[-1]
