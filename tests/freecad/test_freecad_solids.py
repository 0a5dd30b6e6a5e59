# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes and files for CAD and for a solver, made of a lattice infill."""

import re
import shutil

import FreeCAD as App
import Part
import pytest

from conftest import SMALL
from freecad_volfrep import export_mesh, make_lattice_infill
from freecad_volfrep.features.export.solids import KINDS, kinds_of, make_kind
from freecad_volfrep.features.export.solver_files import CONTENTS, estimate_file
from freecad_volfrep.features.properties.quantities import set_value
from volfrep.util.errors import VolfrepError

needs_gmsh = pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not installed")


def read(path):
    shape = Part.Shape()
    shape.read(str(path))
    return shape


def moved(doc, obj):
    """The infill in an App::Part elsewhere, turned against its base, which stays."""
    part = doc.addObject("App::Part", "Holder")
    part.addObject(obj)
    part.Placement.Base = App.Vector(0, 0, 100)
    obj.Placement = App.Placement(App.Vector(7, 0, 0), App.Rotation(App.Vector(0, 0, 1), 90))
    doc.recompute()


def infill_of(doc, base, **properties):
    obj = make_lattice_infill(doc, base, **{**SMALL, **properties})
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


def cylinder(doc):
    base = doc.addObject("Part::Cylinder", "Round")
    base.Radius, base.Height = 11, 15
    doc.recompute()
    return base


@pytest.mark.slow
def test_an_exact_part_of_a_box(doc, infill):
    infill.CellSize = 15
    moved(doc, infill)
    solid = make_kind(doc, infill, "exact")
    doc.recompute()
    shape = solid.Shape
    assert shape.ShapeType == "Solid"
    assert shape.isValid()
    assert shape.isClosed()
    assert shape.Volume == pytest.approx(infill.Volume.Value, rel=2e-3)
    assert "Part::GeomCylinder" in {face.Surface.TypeId for face in shape.Faces}
    box = shape.BoundBox
    assert (box.XMin, box.YMin, box.ZMin) == pytest.approx((-13, 0, 0), abs=1e-3)
    assert (box.XMax, box.YMax, box.ZMax) == pytest.approx((7, 30, 20), abs=1e-3)


@pytest.mark.slow
def test_the_wall_of_a_round_part_is_round(doc):
    infill = infill_of(doc, cylinder(doc), Output="Lattice")
    shape = make_kind(doc, infill, "exact").Shape
    assert shape.isValid()
    assert shape.Volume == pytest.approx(infill.Volume.Value, rel=1e-2)
    # The ends of the struts lie in the cylinder of the inner wall.
    walls = [f for f in shape.Faces if f.Surface.TypeId == "Part::GeomCylinder"]
    assert any(face.Surface.Radius == pytest.approx(9) for face in walls)


def test_plane_faces_where_opencascade_does_not_manage(doc, infill, monkeypatch):
    def fails(*_):
        raise VolfrepError("OpenCASCADE lost a strut.")

    monkeypatch.setattr("freecad_volfrep.bridge.worker_calls._exact", fails)
    said = []
    monkeypatch.setattr(
        "freecad_volfrep.features.export.solids.warn", lambda _, text: said.extend(text)
    )
    infill.CellType, infill.Resolution = "Box", 5
    doc.recompute()
    solid = make_kind(doc, infill, "exact")
    assert len(solid.Shape.Faces) == infill.Triangles
    assert solid.Visibility
    assert said == [
        "OpenCASCADE lost a strut. The solid has plane faces instead of exact surfaces."
    ]
    # FreeCAD's window would stand still while it draws more faces.
    monkeypatch.setattr("freecad_volfrep.features.export.faceted_solid.LONGEST_DRAWING", 0.1)
    assert not make_kind(doc, infill, "faceted").Visibility


@pytest.mark.slow
def test_instances_are_solids_that_are_there_once(doc, box, tmp_path):
    """Written, each kind of joint is one solid in the file, and read again it has all places."""
    box.Length, box.Width, box.Height = 40, 30, 30
    infill = infill_of(doc, box, ShellThickness=1)
    group = make_kind(doc, infill, "instances")
    doc.recompute()
    links = [o for o in group.Group if o.TypeId == "App::Link"]
    assert sum(link.ElementCount for link in links) > len(links)
    assert len({link.LinkedObject.Name for link in links}) == len(links)
    volume = Part.getShape(group).Volume
    assert volume == pytest.approx(infill.Volume.Value, rel=3e-3)
    path = tmp_path / "part.step"
    export_mesh(infill, path, "instances")
    assert [file.name for file in tmp_path.iterdir()] == ["part.step"]
    assert App.ActiveDocument.Name == doc.Name
    shape = read(path)
    assert shape.Volume == pytest.approx(volume, rel=1e-4)
    written = len(re.findall(r"MANIFOLD_SOLID_BREP\(|BREP_WITH_VOIDS\(", path.read_text()))
    single = [o for o in group.Group if o.TypeId == "Part::Feature"]
    assert written == len(links) + sum(len(o.Shape.Solids) for o in single)
    assert len(shape.Solids) > written


@pytest.mark.slow
def test_instances_are_read_again_as_links(doc, box, tmp_path):
    import Import

    infill = infill_of(
        doc,
        box,
        Output="Lattice",
        ShellThickness=0,
        CellType="BCC",
        Activation="Inside",
        Boundary="Whole",
    )
    export_mesh(infill, tmp_path / "part.step", "instances")
    again = App.newDocument("Again")
    try:
        Import.insert(str(tmp_path / "part.step"), again.Name, merge=False, useLinkGroup=True)
        links = [o for o in again.Objects if o.TypeId == "App::Link"]
        assert links
        (top,) = [o for o in again.Objects if not o.InList and o.TypeId != "App::Origin"]
        assert Part.getShape(top).Volume == pytest.approx(infill.Volume.Value, rel=3e-3)
    finally:
        App.closeDocument(again.Name)


def test_axes(doc, infill):
    moved(doc, infill)
    axes = make_kind(doc, infill, "axes").Shape
    assert len(axes.Edges) >= infill.Struts
    box = axes.BoundBox  # under the skin of 2 mm
    assert (box.XMin, box.YMin, box.ZMin) == pytest.approx((-11, 2, 2), abs=1e-2)
    assert (box.XMax, box.YMax, box.ZMax) == pytest.approx((5, 28, 18), abs=1e-2)


@pytest.mark.slow
def test_exact_and_wireframe_files(doc, infill, tmp_path):
    moved(doc, infill)
    export_mesh(infill, tmp_path / "exact.step", "exact")
    shape = read(tmp_path / "exact.step")
    assert shape.isValid()
    assert shape.Volume == pytest.approx(infill.Volume.Value, rel=2e-3)
    assert shape.BoundBox.XMin == pytest.approx(-13, abs=1e-3)
    export_mesh(infill, tmp_path / "axes.step", "wireframe")
    assert read(tmp_path / "axes.step").BoundBox.XMin == pytest.approx(-11, abs=1e-2)


@pytest.mark.slow
def test_a_lattice_of_whole_cells_is_never_built_as_a_shape(doc, box, tmp_path, monkeypatch):
    infill = infill_of(
        doc, box, Output="Lattice", ShellThickness=0, Activation="Inside", Boundary="Whole"
    )
    monkeypatch.setattr("freecad_volfrep.bridge.worker_calls._exact", None)
    export_mesh(infill, tmp_path / "whole.step", "exact")
    shape = read(tmp_path / "whole.step")
    assert shape.isValid()
    assert len(shape.Solids) == 1
    assert shape.Volume == pytest.approx(infill.Volume.Value, rel=5e-3)


@needs_gmsh
@pytest.mark.parametrize(
    ("content", "low"),
    [("beam deck", -11), pytest.param("tetrahedra", -13, marks=pytest.mark.slow)],
)
def test_decks_for_calculix(doc, infill, tmp_path, content, low):
    moved(doc, infill)
    set_value(infill, "Density", 7.85)
    path = tmp_path / "deck.inp"
    export_mesh(infill, path, content)
    text = path.read_text()
    assert "*DENSITY\n7.85e-09\n" in text
    assert "*NSET,NSET=SKIN\n" in text
    places = [float(x) for x in re.findall(r"^\d+,([-\d.e]+),[-\d.e]+,[-\d.e]+$", text, re.M)]
    assert min(places) == pytest.approx(low, abs=1e-2)


@pytest.mark.costly
def test_every_file_and_every_shape_says_what_it_takes(doc, infill):
    for content in CONTENTS:
        assert re.search(r": about [\d.]+ s, [\d.]+ MB", estimate_file(infill, content))
    for kind in KINDS:
        assert "about" in kind.predict(infill)


@pytest.mark.costly
def test_what_is_not_on_offer(doc, box, infill, tmp_path):
    copy = doc.addObject("Mesh::Feature", "Copy")
    copy.Mesh = infill.Mesh
    assert [kind.name for kind in kinds_of(copy)] == ["faceted"]
    with pytest.raises(VolfrepError, match="'Copy' cannot be made into 'exact': choose faceted"):
        make_kind(doc, copy, "exact")
    with pytest.raises(VolfrepError, match="a mesh without struts"):
        export_mesh(copy, tmp_path / "a.step", "exact")
    with pytest.raises(VolfrepError, match=r"give it the extension \.inp"):
        export_mesh(infill, tmp_path / "a.step", "beam deck")
    with pytest.raises(VolfrepError, match="no content 'lines'"):
        estimate_file(infill, "lines")
    infill.JointFillet = 0.3
    doc.recompute()
    with pytest.raises(VolfrepError, match="set the JointFillet"):
        make_kind(doc, infill, "exact")
    with pytest.raises(VolfrepError, match="set the JointFillet"):
        export_mesh(infill, tmp_path / "a.step", "exact")
    infill.JointFillet, infill.Output = 0, "Domain"
    doc.recompute()
    with pytest.raises(VolfrepError, match="holds no lattice"):
        export_mesh(infill, tmp_path / "a.inp", "beam deck")
    assert list(tmp_path.iterdir()) == []
