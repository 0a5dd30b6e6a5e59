# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coupons of an infill's lattice, and the direction in which a part is built."""

import FreeCAD as App
import pytest

from freecad_volfrep.features.export.coupons import add_coupons, coupons_of, write_coupons
from freecad_volfrep.features.reports.build_direction import (
    find_directions,
    set_build_direction,
    turn_part,
)
from freecad_volfrep.features.reports.print_check import make_print_check
from volfrep.util.errors import VolfrepError


def test_a_part_is_turned_onto_its_best_face(doc, box):
    # A plate on its edge, askew: its best direction is that of its large faces.
    box.Length, box.Width, box.Height = 40, 30, 5
    box.Placement = App.Placement(App.Vector(7, 8, 9), App.Rotation(App.Vector(1, 0.2, 0), 70))
    doc.recompute()
    found = find_directions(box, 45.0)
    best = found.best[0]
    assert best.overhang_mm2 < found.as_it_is.overhang_mm2
    assert best.height_mm == pytest.approx(5, abs=1e-3)
    assert found.hanging(best.up).area == pytest.approx(best.overhang_mm2)
    assert found.hanging(found.as_it_is.up).area == pytest.approx(found.as_it_is.overhang_mm2)
    before = box.Shape.BoundBox.Center
    turn_part(box, found, best)
    doc.recompute()
    around = box.Shape.BoundBox
    assert (around.ZMin, around.ZMax) == pytest.approx((0, 5), abs=1e-4)
    assert (around.Center.x, around.Center.y) == pytest.approx((before.x, before.y), abs=1e-4)
    box.setExpression("Placement.Base.x", "3")
    with pytest.raises(VolfrepError, match="expression"):
        turn_part(box, found, best)


def test_coupons_lie_beside_the_infill_with_their_sizes_and_table(doc, infill, tmp_path):
    made = coupons_of(infill, ["cube", "ladder"], cells=1, first=7)
    group = add_coupons(infill, made)
    cube, ladder = group.Group
    assert (cube.Label, ladder.Label) == ("7 cube", "8 ladder")
    assert "edge 10" in cube.Sizes
    assert ladder.PrintedTable.startswith("inclination,nominal,measured\n0,0.4,")
    boxes = [one.Mesh.BoundBox for one in (cube, ladder)]
    assert all(box.ZMin == pytest.approx(0, abs=1e-5) for box in boxes)
    assert all(box.YMax < infill.Mesh.BoundBox.YMin for box in boxes)
    assert boxes[0].XMax < boxes[1].XMin
    names = {path.rsplit("/", 1)[-1] for path in write_coupons(made, tmp_path / "to print")}
    assert names == {"7_cube.stl", "8_ladder.stl", "8_ladder.csv"}
    with pytest.raises(VolfrepError, match="tick at least one"):
        coupons_of(infill, [])


def test_print_checks_look_along_the_build_direction(doc, infill):
    made = set_build_direction(infill, (1.0, 0.0, 0.0))
    assert len(made) == 1
    assert made[0].BuildDirection == App.Vector(1, 0, 0)
    assert set_build_direction(infill, (0.0, 1.0, 0.0)) == made
    assert made[0].BuildDirection == infill.BuildDirection == App.Vector(0, 1, 0)


def test_the_build_direction_turns_with_the_infill(doc, infill):
    infill.Placement = App.Placement(App.Vector(0, 0, 50), App.Rotation(App.Vector(1, 0, 0), 90))
    set_build_direction(infill, (0.0, 0.0, 1.0))
    assert infill.BuildDirection.isEqual(App.Vector(0, 1, 0), 1e-12)
    assert make_print_check(doc, infill).BuildDirection.isEqual(App.Vector(0, 0, 1), 1e-12)
