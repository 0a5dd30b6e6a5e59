# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is picked becomes faces, directions and points in the coordinates of the infill's group."""

import FreeCAD as App
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.bridge.picked import direction_of, point_of
from freecad_volfrep.features.infill.picking import pick, pickable, unpick
from volfrep.util.errors import VolfrepError


@pytest.fixture
def infill(doc, box):
    return make_lattice_infill(doc, box, **SMALL)


def test_faces_are_added_and_taken_away(box, infill):
    pick(infill, "OpenFaces", box, "Face6")
    pick(infill, "OpenFaces", box, "Face1")
    assert [(owner.Name, names) for owner, names in infill.OpenFaces] == [
        (box.Name, ("Face6", "Face1"))
    ]
    pick(infill, "OpenFaces", box, "Face6")
    assert [names for _, names in infill.OpenFaces] == [("Face1",)]
    with pytest.raises(VolfrepError, match="'Edge1' is no face"):
        pick(infill, "OpenFaces", box, "Edge1")
    unpick(infill, "OpenFaces")
    assert infill.OpenFaces == []


def test_what_applies_can_be_picked(infill):
    assert {"OpenFaces", "Origin", "BuildDirection"} <= set(pickable(infill))
    assert not {"NetworkFaces", "RadiusDirection", "MapAxis"} & set(pickable(infill))
    infill.RadiusGrading = "Direction"
    assert "RadiusDirection" in pickable(infill)
    infill.Network = "Faces"
    assert "NetworkFaces" in pickable(infill)


def test_directions_and_points_of_a_box(box):
    here = App.Placement()
    normals = {tuple(direction_of(box, f"Face{k}", here)) for k in range(1, 7)}
    assert normals == {
        (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1),
    }  # fmt: skip
    edge = box.Shape.Edge1
    assert direction_of(box, "Edge1", here).cross(edge.tangentAt(0)).Length < 1e-12
    assert point_of(box, "Edge1", here) == edge.CenterOfMass
    assert point_of(box, "Vertex3", here) == box.Shape.Vertex3.Point
    assert point_of(box, "Face6", here) == box.Shape.Face6.CenterOfMass
    with pytest.raises(VolfrepError, match="'Vertex1' has no direction"):
        direction_of(box, "Vertex1", here)
    with pytest.raises(VolfrepError, match="has no middle"):
        point_of(box, "", here)


def test_round_things_have_their_axis_and_centre(doc):
    cylinder = doc.addObject("Part::Cylinder", "Round")
    cylinder.Placement = App.Placement(App.Vector(3, 4, 5), App.Rotation(App.Vector(0, 1, 0), 90))
    doc.recompute()
    here = App.Placement()
    for k, face in enumerate(cylinder.Shape.Faces, 1):
        way = direction_of(cylinder, f"Face{k}", here)
        assert abs(way.x) == pytest.approx(1.0), face.Surface
    circle = next(
        k for k, e in enumerate(cylinder.Shape.Edges, 1) if e.Curve.TypeId == "Part::GeomCircle"
    )
    assert abs(direction_of(cylinder, f"Edge{circle}", here).x) == pytest.approx(1.0)
    centre = point_of(cylinder, f"Edge{circle}", here)
    assert (centre.y, centre.z) == pytest.approx((4.0, 5.0))


def test_axes_and_groups_turn_what_is_picked(doc, box, infill):
    group = doc.addObject("App::Part", "Group")
    group.Placement.Rotation = App.Rotation(App.Vector(0, 0, 1), 90)
    doc.recompute()
    axis = next(o for o in group.Origin.OriginFeatures if getattr(o, "Role", "") == "X_Axis")
    way = direction_of(axis, "", App.Placement())
    assert tuple(way) == pytest.approx((0.0, 1.0, 0.0), abs=1e-9)
    group.addObjects([box, infill])
    doc.recompute()
    pick(infill, "BuildDirection", box, "Face2")
    assert abs(infill.BuildDirection.x) == pytest.approx(1.0), "in the group's own coordinates"
    pick(infill, "Origin", box, "Vertex1")
    assert infill.Origin == box.Shape.Vertex1.Point
