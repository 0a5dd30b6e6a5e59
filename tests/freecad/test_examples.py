# SPDX-License-Identifier: LGPL-2.1-or-later
"""The example parts: valid solids of the stated sizes that follow their spreadsheets."""

import dataclasses

import FreeCAD as App
import MeshPart
import pytest

from freecad_volfrep.examples import make_bracket, make_piston_rod
from freecad_volfrep.features.reports.mesh_check import check_mesh

EXAMPLES = {
    "bracket": (make_bracket, "BracketSizes", (178.5, 62.5, 108.3)),
    "piston_rod": (make_piston_rod, "PistonRodSizes", (121.0, 28.0, 11.6)),
}


@pytest.fixture(params=EXAMPLES)
def example(request):
    make, sheet_name, box = EXAMPLES[request.param]
    doc = App.newDocument(request.param)
    yield make(doc), doc.getObject(sheet_name), box
    App.closeDocument(doc.Name)


def box_of(shape):
    shape = shape.copy()
    shape.tessellate(0.01)
    box = shape.BoundBox
    return (box.XLength, box.YLength, box.ZLength)


@pytest.mark.costly_cases("bracket")
def test_is_one_valid_solid_of_the_stated_size(example):
    part, _, box = example
    assert [obj.Name for obj in part.Document.Objects if not obj.isValid()] == []
    assert part.Shape.isValid()
    assert len(part.Shape.Solids) == 1
    assert part.Shape.Solids[0].isClosed()
    assert box_of(part.Shape) == pytest.approx(box, abs=0.02)
    assert 0.2 < part.Shape.Volume / (box[0] * box[1] * box[2]) < 0.6


@pytest.mark.costly_cases("bracket")
def test_tessellates_to_a_closed_mesh(example):
    part, _, _ = example
    for deflection in (0.2, 0.05):
        mesh = MeshPart.meshFromShape(
            Shape=part.Shape.copy(), LinearDeflection=deflection, AngularDeflection=0.3
        )
        assert mesh.isSolid()
        assert mesh.Volume == pytest.approx(part.Shape.Volume, rel=0.01)


@pytest.mark.costly
@pytest.mark.slow_but("piston_rod")
def test_follows_its_spreadsheet(example):
    part, sheet, box = example
    sheet.set("length", f"{box[0] + 10} mm")
    part.Document.recompute()
    assert [obj.Name for obj in part.Document.Objects if not obj.isValid()] == []
    assert part.Shape.isValid()
    assert len(part.Shape.Solids) == 1
    assert box_of(part.Shape) == pytest.approx((box[0] + 10, box[1], box[2]), abs=0.02)


@pytest.mark.costly
@pytest.mark.slow_but("bracket")
def test_follows_all_its_sizes_at_once(example):
    """Larger by a twentieth, but for a few radii of fillets, which do not change."""
    part, sheet, box = example
    volume, faces = part.Shape.Volume, len(part.Shape.Faces)
    for row in range(1, 100):
        if not sheet.getAlias(f"B{row}"):
            break
        sheet.set(f"B{row}", f"{1.05 * sheet.get(f'B{row}').Value} mm")
    part.Document.recompute()
    assert [obj.Name for obj in part.Document.Objects if not obj.isValid()] == []
    assert part.Shape.isValid()
    assert len(part.Shape.Faces) == faces
    assert box_of(part.Shape) == pytest.approx([1.05 * side for side in box], abs=0.02)
    assert part.Shape.Volume == pytest.approx(1.05**3 * volume, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "coarser"),
    [
        ("Bracket", {"CellSize": 30, "StrutRadius": 3, "Deviation": 0.3, "ShellThickness": 6}),
        ("Bracket", {}),
        ("PistonRod", {}),
    ],
)
def test_a_filled_example_is_ready(monkeypatch, name, coarser):
    from freecad_volfrep.examples import filled

    example = filled.EXAMPLES[name]
    made = dataclasses.replace(example, lattice={**example.lattice, **coarser})
    monkeypatch.setitem(filled.EXAMPLES, name, made)
    infill = filled.open_example(name)
    try:
        assert infill.isValid(), infill.Status
        assert infill.Mesh.isSolid()
        assert (infill.Bodies, infill.Watertight) == (1, True)
        assert [obj.Name for obj in infill.Document.Objects if not obj.isValid()] == []
        if name == "Bracket":  # of which FreeCAD 0.20 names 11 pairs of needles beside each other
            tables = check_mesh(infill)
            assert tables[0].title == f"{infill.Label}: closed and without defects"
            rows = {row[0]: row[1] for table in tables for row in table.rows}
            assert rows["triangles that cross"] == "none"
    finally:
        App.closeDocument(infill.Document.Name)
