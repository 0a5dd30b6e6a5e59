# SPDX-License-Identifier: LGPL-2.1-or-later
"""A specification and its parts: told apart by all that they hold, and by nothing else."""

import json
from dataclasses import fields, replace

import numpy as np
import pytest

from volfrep import LatticeSpec, VolfrepError
from volfrep.design.cells import LIBRARY, UnitCell
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.graphs import RandomGraph
from volfrep.design.openings import DrainHoles, DrainPlace, OpenPatch, OpenPlane
from volfrep.design.profile import Profile
from volfrep.design.scattered_field import PointField
from volfrep.design.skins.own_faces import FaceSkin, KeptFace
from volfrep.design.spec_parts import Boundary, FlatStruts, Grid, Resolution, Skin, Struts
from volfrep.design.target import Target
from volfrep.design.tpms import TpmsSheet

POINTS = np.eye(3)
FIELD = PointField(POINTS, np.array([1.0, 2.0, 3.0]))
PATCH = np.arange(9.0).reshape(1, 3, 3) ** 2
BY_FIELD = RadiusGrading("field", Profile("linear", 0.5, 1.0), field=FIELD)

#: Of every part a value, and for each of its fields another value.
OTHERS = [
    (
        Grid(10.0),
        {
            "size": 9.0,
            "origin": (0.0, 0.0, 0.0),
            "size_grading": SizeGrading(Profile("linear", 1.0, 2.0)),
            "cell_map": CellMap("cylindrical"),
            "orientation": Orientation(angle=30.0),
        },
    ),
    (Struts(1.0), {"radius": BY_FIELD, "fillet": 0.5, "keep_radius": False}),
    (
        Skin(2.0),
        {
            "thickness": 3.0,
            "open_faces": (OpenPlane((0, 0, 0), (0, 0, 1)),),
            "field": FIELD,
            "face_skins": (FaceSkin(OpenPlane((0, 0, 0), (0, 0, 1)), 1.0),),
            "keep_solid": (KeptFace(OpenPlane((0, 0, 0), (0, 0, 1)), 1.0),),
        },
    ),
    (
        Boundary(),
        {
            "activation": "inside",
            "cut": "whole",
            "remove_dangling": True,
            "shortest_stub": 1.0,
            "remove_below": 0.4,
            "flat_struts": FlatStruts(45.0),
            "keep_pieces": True,
        },
    ),
    (Resolution(), {"facets": 20, "deviation": 0.1}),
    (
        SizeGrading(Profile("linear", 1.0, 2.0)),
        {"profile": Profile("linear", 1.0, 3.0), "direction": (0, 1, 0)},
    ),
    (
        BY_FIELD,
        {
            "by": "skin",
            "profile": Profile("linear", 0.5, 1.1),
            "direction": (0, 1, 0),
            "reach": 4.0,
            "field": PointField(POINTS, np.array([1.0, 2.0, 3.5])),
            "column": "T",
            "curve": ((1.0, 0.5), (3.0, 1.0)),
        },
    ),
    (FIELD, {"points": 2.0 * POINTS, "values": np.array([3.0, 2.0, 1.0]), "source": "a.csv"}),
    (
        CellMap("cylindrical"),
        {"kind": "spherical", "centre": (1, 2, 3), "axis": (1, 0, 0), "around": 12},
    ),
    (Orientation(), {"axis": (1, 0, 0), "angle": 10.0, "origin": (1, 2, 3)}),
    (OpenPatch(PATCH), {"corners": PATCH + 1e-9}),
    (OpenPlane((0, 0, 0), (0, 0, 1)), {"point": (0, 0, 1), "normal": (0, 1, 0)}),
    (
        DrainHoles(3.0, count=1),
        {
            "diameter": 4.0,
            "places": (DrainPlace((0, 0, 0)),),
            "count": 2,
            "build_direction": (1, 0, 0),
        },
    ),
    (
        LIBRARY["BCC"],
        {
            "name": "mine",
            "nodes": LIBRARY["BCC"].nodes * 0.5,
            "struts": LIBRARY["BCC"].struts[:, ::-1],
            "edges": (1.0, 1.0, 2.0),
            "widths": np.full(20, 0.5),
        },
    ),
    (
        LatticeSpec(drains=DrainHoles(3.0, count=1)),
        {
            "cell": "BCC",
            "cell_size": 9.0,
            "strut_radius": 0.9,
            "shell": 3.0,
            "resolution": 20,
            "deviation": 0.1,
            "activation": "inside",
            "boundary": "whole",
            "open_faces": (OpenPatch(PATCH),),
            "skin_field": FIELD,
            "face_skins": (FaceSkin(OpenPatch(PATCH), 1.0),),
            "keep_solid": (KeptFace(OpenPatch(PATCH), 1.0),),
            "drains": None,
            "remove_dangling": True,
            "shortest_stub": 1.0,
            "remove_below": 0.4,
            "flat_struts": FlatStruts(45.0),
            "keep_pieces": True,
            "output": "domain",
            "fillet": 0.5,
            "origin": (0, 0, 0),
            "density": 2.0,
            "size_grading": SizeGrading(Profile("linear", 1.0, 2.0)),
            "radius_grading": BY_FIELD,
            "cell_map": CellMap("cylindrical"),
            "orientation": Orientation(angle=30.0),
            "keep_radius": False,
            "target": Target("mass", 5.0),
            "network": RandomGraph(points=9),
            "wall": TpmsSheet("sheet", 2.0),
        },
    ),
]


@pytest.mark.parametrize(("part", "others"), OTHERS, ids=lambda value: type(value).__name__)
def test_a_part_differs_from_another_one_in_any_field(part, others):
    names = {item.name for item in fields(part) if item.init}
    # Where a cell was read, and what is said about it, does not matter.
    apart = {"source", "use", "about", "also", "parameters", "values"}
    assert names - apart == others.keys() - apart
    for name, value in others.items():
        changed = replace(part, **{name: value})
        assert changed != part, name
        assert hash(changed) != hash(part), name
        assert changed == replace(part, **{name: value})
        assert hash(changed) == hash(replace(part, **{name: value}))


def test_specifications_of_equal_content_are_equal_whatever_it_came_from(tmp_path):
    file = tmp_path / "field.csv"
    file.write_text("x,y,z,T\n0,0,0,1\n1,0,0,2\n")
    one, two = (
        LatticeSpec(
            cell=UnitCell("mine", LIBRARY["CVC"].nodes.copy(), LIBRARY["CVC"].struts.tolist()),
            radius_grading=RadiusGrading("field", Profile("linear", 0.5, 1), field=str(file)),
            open_faces=faces,
            origin=origin,
        )
        for faces, origin in (
            ((OpenPatch(PATCH),), (1, 2, 3)),
            ([OpenPatch(PATCH.copy())], [1, 2, 3.0]),
        )
    )
    assert one == two
    assert hash(one) == hash(two)
    assert one.grid == two.grid
    assert one.skin == two.skin


def test_a_cell_is_read_once(tmp_path):
    file = tmp_path / "cell.json"
    box = LIBRARY["Box"]
    file.write_text(json.dumps({"nodes": box.nodes.tolist(), "struts": box.struts.tolist()}))
    spec = LatticeSpec(cell=str(file))
    file.unlink()
    np.testing.assert_array_equal(spec.unit_cell().nodes, box.nodes)
    assert replace(spec, cell_size=12.0).unit_cell() == spec.unit_cell()


def test_a_field_is_read_once(tmp_path):
    file = tmp_path / "field.csv"
    file.write_text("x,y,z,T\n0,0,0,1\n10,0,0,2\n")
    grading = RadiusGrading("field", Profile("linear", 0.5, 1.0), field=str(file))
    before = hash(grading)
    file.write_text("x,y,z,T\n0,0,0,2\n10,0,0,1\n")
    radii = grading.radii(np.array([[0.0, 0, 0], [10.0, 0, 0]]), np.zeros((2, 3)), lambda p: p)
    np.testing.assert_allclose(radii, [0.5, 1.0])
    assert hash(grading) == before
    assert RadiusGrading("field", Profile("linear", 0.5, 1.0), field=str(file)) != grading


def test_what_a_part_holds_cannot_be_changed():
    nodes = LIBRARY["Box"].nodes.copy()
    cell = UnitCell("mine", nodes, LIBRARY["Box"].struts)
    nodes[0] = 0.5
    np.testing.assert_array_equal(cell.nodes, LIBRARY["Box"].nodes)
    for array in (cell.nodes, FIELD.values, FIELD.points, OpenPatch(PATCH).corners):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


def test_a_specification_gives_each_stage_its_part():
    spec = LatticeSpec("BCC", 8.0, 0.7, 3.0, deviation=0.05, fillet=0.2, boundary="whole")
    assert spec.grid == Grid(8.0)
    assert spec.struts == Struts(0.7, 0.2)
    assert spec.skin == Skin(3.0)
    assert spec.ending == Boundary(cut="whole")
    assert spec.detail == Resolution(deviation=0.05)
    assert replace(spec, shell=0).skin is None
    assert replace(spec, radius_grading=BY_FIELD).struts == Struts(BY_FIELD, 0.2)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Grid(-1.0), "cell size must be above 0"),
        (lambda: Grid(1.0, (0.0, 1.0)), "origin must be three"),
        (lambda: Struts(0.0), "strut radius must be above 0"),
        (lambda: Struts(1.0, fillet=-1.0), "fillet must not be negative"),
        (lambda: Skin(0.0), "skin thickness must be above 0"),
        (lambda: Boundary("all"), "no activation 'all'"),
        (lambda: Boundary(cut="bent"), "no boundary 'bent'"),
        (lambda: Resolution(20, 0.1), "not both"),
        (lambda: Resolution(3), "whole number from 4"),
    ],
)
def test_a_part_that_makes_no_sense_is_refused_when_it_is_made(make, message):
    with pytest.raises(VolfrepError, match=message):
        make()
