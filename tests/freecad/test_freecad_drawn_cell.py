# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sketches and wires as the lines of a unit cell."""

import FreeCAD as App
import numpy as np
import Part
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.bridge.drawn_lines import drawn_lines, has_edges
from volfrep.design.cells import LIBRARY
from volfrep.design.drawn_cell import cell_from_lines, save_cell
from volfrep.util.errors import VolfrepError

V = App.Vector


def shape_object(doc, shape, name="Drawn"):
    obj = doc.addObject("Part::Feature", name)
    obj.Shape = shape
    return obj


def test_the_edges_of_a_sketch_lie_where_the_sketch_does(doc):
    sketch = doc.addObject("Sketcher::SketchObject", "Cross")
    sketch.addGeometry(Part.LineSegment(V(0, 0, 0), V(10, 10, 0)), False)
    sketch.addGeometry(Part.LineSegment(V(0, 10, 0), V(10, 0, 0)), False)
    sketch.addGeometry(Part.LineSegment(V(0, 5, 0), V(10, 5, 0)), True)  # construction
    sketch.Placement = App.Placement(V(0, 0, 7), App.Rotation(V(1, 0, 0), 90))
    part = doc.addObject("App::Part", "Part")
    part.addObject(sketch)
    part.Placement.Base = V(100, 0, 0)
    doc.recompute()
    lines = drawn_lines([sketch])
    assert lines.shape == (2, 2, 3)
    np.testing.assert_allclose(lines.min(axis=(0, 1)), (100, 0, 7), atol=1e-9)
    np.testing.assert_allclose(lines.max(axis=(0, 1)), (110, 0, 17), atol=1e-9)


def test_a_box_and_its_diagonals_are_bcc(doc):
    cube = shape_object(doc, Part.makeBox(6, 6, 6, V(20, 0, 0)))
    ways = [((0, 0, 0), (6, 6, 6)), ((6, 0, 0), (0, 6, 6)), ((0, 6, 0), (6, 0, 6)),
            ((0, 0, 6), (6, 6, 0))]  # fmt: skip
    diagonals = shape_object(doc, Part.Compound([Part.makeLine(*way) for way in ways]))
    diagonals.Placement.Base = V(20, 0, 0)
    drawn = cell_from_lines("mine", drawn_lines([cube, diagonals]))
    assert drawn.size == pytest.approx(6)
    assert (len(drawn.cell.nodes), len(drawn.cell.struts)) == (9, 20)
    assert drawn.cell.maxwell_number == LIBRARY["BCC"].maxwell_number
    assert drawn.warnings == ()


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        (lambda: Part.makeCircle(3), "Edge1 of 'Drawn' cannot be a strut, it is a circle"),
        (lambda: Part.makeCylinder(3, 5), "it is a circle: a strut is straight"),
        (lambda: Part.makeSphere(3), "Edge. of 'Drawn' cannot be a strut, it is a circle"),
        (lambda: Part.Vertex(0, 0, 0), "'Drawn' has no edges: select a sketch or a wire"),
    ],
)
def test_what_cannot_be_a_strut_is_named(doc, shape, message):
    with pytest.raises(VolfrepError, match=message):
        drawn_lines([shape_object(doc, shape())])


def test_a_spline_is_named_as_one(doc):
    curve = Part.BSplineCurve()
    curve.interpolate([V(0, 0, 0), V(1, 2, 0), V(3, 0, 0)])
    with pytest.raises(VolfrepError, match="it is a B-spline"):
        drawn_lines([shape_object(doc, curve.toShape())])


def test_what_has_edges(doc, box):
    assert has_edges(box)
    assert not has_edges(shape_object(doc, Part.Vertex(0, 0, 0)))
    assert not has_edges(doc.addObject("App::Part", "Group"))


def test_a_drawn_cell_fills_a_solid(doc, box, tmp_path):
    cube = shape_object(doc, Part.makeBox(4, 4, 4))
    path = tmp_path / "cube.json"
    save_cell(cell_from_lines("Cube", drawn_lines([cube])).cell, path)
    values = {**SMALL, "CellType": "Custom", "CellFile": str(path)}
    own = make_lattice_infill(doc, box, **values)
    library = make_lattice_infill(doc, box, **{**SMALL, "CellType": "Box"})
    doc.recompute()
    assert own.isValid(), own.Status
    assert own.Volume.Value == pytest.approx(library.Volume.Value, rel=1e-6)
