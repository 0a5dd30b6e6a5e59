# SPDX-License-Identifier: LGPL-2.1-or-later
"""From the object to files and to a Part solid."""

import os

import FreeCAD as App
import Mesh
import numpy as np
import Part
import pytest

from conftest import SMALL
from freecad_volfrep import export_mesh, make_lattice_infill, make_solid
from freecad_volfrep.bridge.exact import without_surface_curves
from freecad_volfrep.bridge.faceted import faceted_solid
from freecad_volfrep.bridge.meshes import from_freecad, to_freecad
from freecad_volfrep.features.export.faceted_solid import predict_solid
from freecad_volfrep.features.export.input_files import refuse_inputs_of_all
from freecad_volfrep.features.export.layer_export import (
    estimate_layers,
    export_layers,
    layers_folder,
)
from freecad_volfrep.features.export.mesh_file import (
    FITTED,
    FORMATS,
    chosen_format,
    estimate_export,
    formats_of,
)
from freecad_volfrep.features.export.printer_file import export_for_printer
from freecad_volfrep.features.export.solver_files import CONTENTS
from volfrep.jobs.slices import FORMATS as FORMS_OF_LAYERS
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.output.form import suffixes
from volfrep.util.errors import VolfrepError


def cube(size, centre=(0, 0, 0)):
    mesh = from_freecad(Mesh.createBox(size, size, size))
    return TriangleMesh(mesh.vertices + np.array(centre, float), mesh.triangles)


def test_meshes_pass_both_ways_unchanged():
    mesh = from_freecad(Mesh.createSphere(10, 60))
    again = from_freecad(to_freecad(mesh))
    assert np.array_equal(mesh.vertices, again.vertices)
    assert np.array_equal(mesh.triangles, again.triangles)
    made = to_freecad(mesh)
    assert made.isSolid()
    assert made.CountEdges == Mesh.createSphere(10, 60).CountEdges


def test_an_open_mesh_passes_with_its_border():
    mesh = from_freecad(Mesh.createBox(3, 3, 3))
    made = to_freecad(TriangleMesh(mesh.vertices, mesh.triangles[1:]))
    assert made.CountFacets == 11
    assert made.CountEdges == 18
    assert not made.isSolid()


def test_an_empty_mesh_passes():
    empty = TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int32))
    assert to_freecad(empty).CountFacets == 0
    with pytest.raises(VolfrepError, match="empty"):
        from_freecad(Mesh.Mesh())


@pytest.mark.parametrize("way", ["File > Export", "command"])
def test_stl(infill, tmp_path, way):
    path = tmp_path / "part.stl"
    if way == "command":
        export_mesh(infill, path)
    else:
        Mesh.export([infill], str(path))
    read = Mesh.Mesh(str(path))
    assert read.CountFacets == infill.Triangles
    assert read.isSolid()
    assert not read.hasNonManifolds()
    assert read.Volume == pytest.approx(infill.Volume.Value, rel=1e-4)


@pytest.mark.costly
def test_export_lies_on_the_base_whatever_part_it_is_in(doc, infill, tmp_path):
    part = doc.addObject("App::Part", "Holder")
    part.addObject(infill)
    part.Placement.Base = App.Vector(0, 0, 100)
    infill.Placement.Base = App.Vector(7, 0, 0)
    doc.recompute()
    export_mesh(infill, tmp_path / "part.stl")
    box = Mesh.Mesh(str(tmp_path / "part.stl")).BoundBox
    assert (box.XMin, box.ZMin) == pytest.approx((7, 0), abs=1e-3)


@pytest.mark.parametrize("suffix", ["ply", "obj"])
def test_other_mesh_formats(infill, tmp_path, suffix):
    path = tmp_path / f"part.{suffix}"
    export_mesh(infill, path)
    read = Mesh.Mesh(str(path))
    assert read.CountFacets == infill.Triangles
    assert read.isSolid()
    assert read.Volume == pytest.approx(infill.Volume.Value, rel=1e-4)


def read_3mf(path):
    """Number of triangles, box and number of beams of each object, as lib3mf reads them."""
    lib3mf = pytest.importorskip("lib3mf", reason="lib3mf is not installed")
    model = lib3mf.get_wrapper().CreateModel()
    model.QueryReader("3mf").ReadFromFile(str(path))
    objects, meshes = {}, model.GetMeshObjects()
    while meshes.MoveNext():
        mesh = meshes.GetCurrentMeshObject()
        box = mesh.GetOutbox()
        bounds = (*box.MinCoordinate, *box.MaxCoordinate)
        objects[mesh.GetName()] = (
            mesh.GetTriangleCount(), bounds, mesh.BeamLattice().GetBeamCount()
        )  # fmt: skip
    return objects


@pytest.mark.slow_but("both")
@pytest.mark.parametrize("content", ["mesh", "beams", "both"])
def test_3mf_lies_where_the_mesh_does(doc, infill, tmp_path, content):
    part = doc.addObject("App::Part", "Holder")
    part.addObject(infill)
    part.Placement.Base = App.Vector(0, 0, 100)
    infill.Placement = App.Placement(App.Vector(7, 0, 0), App.Rotation(App.Vector(0, 0, 1), 90))
    doc.recompute()
    export_mesh(infill, tmp_path / "part.3mf", content)
    found = read_3mf(tmp_path / "part.3mf")
    whole = (-13, 0, 0, 7, 30, 20)  # the base stays where it is
    names = {"mesh": {"part"}, "beams": {"clip", "skin", "lattice"}, "both": {"clip", "lattice"}}
    assert found.keys() == names[content]
    for name in found.keys() - {"lattice"}:
        assert found[name][1] == pytest.approx(whole, abs=1e-3)
    if content != "mesh":
        triangles, bounds, beams = found["lattice"]
        assert triangles == (infill.Triangles if content == "both" else 0)
        assert beams == infill.Struts == 8 * 3 * 2 * 2
        if content == "beams":
            nudge = 2.1e-4 * 10.0  # as the lattice of the mesh is, before it is cut
            assert bounds == pytest.approx(whole, abs=1.001 * nudge)


def test_what_cannot_be_exported_as_beams(doc, infill, tmp_path):
    copy = doc.addObject("Mesh::Feature", "Copy")
    copy.Mesh = infill.Mesh
    with pytest.raises(VolfrepError, match="a mesh without beams"):
        export_mesh(copy, tmp_path / "part.3mf", "both")
    with pytest.raises(VolfrepError, match="only a 3MF file"):
        export_mesh(infill, tmp_path / "part.stl", "beams")
    with pytest.raises(VolfrepError, match="only a 3MF file"):
        export_mesh(infill, tmp_path / "part.3mf", "struts")
    infill.AutoUpdate = False
    infill.StrutRadius = 1.1
    doc.recompute()
    with pytest.raises(VolfrepError, match="out of date: update it first"):
        export_mesh(infill, tmp_path / "part.3mf", "beams")
    assert list(tmp_path.iterdir()) == []


def test_the_formats_on_offer(doc, box, infill):
    copy = doc.addObject("Mesh::Feature", "Copy")
    assert [form.filter for form in formats_of(copy)] == [
        "STL (*.stl)", "3MF (*.3mf)",
        "PLY (*.ply)", "OBJ (*.obj)", "OFF (*.off)",
        "GLB, for viewers (*.glb)", "STEP, plane faces (*.step)",
    ]  # fmt: skip
    offered = formats_of(infill)
    assert {form.content for form in offered} == {
        "mesh", "beams", "both", "layers", FITTED, *CONTENTS,
    }  # fmt: skip
    layers = {f".{form}" for form in FORMS_OF_LAYERS}
    assert {form.suffix for form in offered} == set(suffixes()) - {".stp"} | layers
    assert len({form.filter for form in offered}) == len(offered)


def test_export_refuses(doc, box, infill, tmp_path):
    with pytest.raises(VolfrepError, match="no mesh"):
        export_mesh(box, tmp_path / "part.stl")
    with pytest.raises(VolfrepError, match="format"):
        export_mesh(infill, tmp_path / "part.xyz")
    with pytest.raises(VolfrepError, match="nowhere"):
        export_mesh(infill, tmp_path / "nowhere" / "part.stl")
    assert list(tmp_path.iterdir()) == []


def test_solid_and_step(doc, box, tmp_path):
    box.Length = box.Width = box.Height = 12
    infill = make_lattice_infill(doc, box, **{**SMALL, "CellType": "Box", "Resolution": 6})
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    prediction = predict_solid(infill)
    assert prediction.triangles == infill.Triangles
    assert "plane faces" in str(prediction)
    solid = make_solid(doc, infill)
    doc.recompute()
    assert solid.isValid()
    assert solid.TypeId == "Part::Feature"
    assert solid.Shape.ShapeType == "Solid"
    assert solid.Shape.isValid()
    assert solid.Shape.isClosed()
    assert len(solid.Shape.Faces) == infill.Triangles
    assert solid.Shape.Volume == pytest.approx(infill.Volume.Value, rel=1e-4)
    path = tmp_path / "part.step"
    with without_surface_curves():
        solid.Shape.exportStep(str(path))
    assert path.stat().st_size / 1e6 == pytest.approx(prediction.step_mb, rel=0.3)
    assert [file.name for file in tmp_path.iterdir()] == ["part.step"]
    read = Part.Shape()
    read.read(str(path))
    assert len(read.Solids) == 1
    assert read.isValid()
    assert read.Volume == pytest.approx(infill.Volume.Value, rel=1e-4)


def test_the_limit_explains_itself(doc, infill):
    count = len(doc.Objects)
    with pytest.raises(VolfrepError, match=r"limit is 1,000 faces.*coarser deviation") as error:
        make_solid(doc, infill, limit=1000)
    assert f"{infill.Triangles:,} plane faces" in str(error.value)
    assert len(doc.Objects) == count


def test_solid_with_a_void():
    shape = faceted_solid(concatenate(cube(10), cube(4).reversed()))
    assert shape.ShapeType == "Solid"
    assert shape.isValid()
    assert len(shape.Shells) == 2
    assert shape.Volume == pytest.approx(1000 - 64)


def test_several_bodies():
    shape = faceted_solid(concatenate(cube(10), cube(4, (20, 0, 0))))
    assert len(shape.Solids) == 2
    assert shape.isValid()
    assert sorted(solid.Volume for solid in shape.Solids) == pytest.approx([64, 1000])


def test_a_solid_can_be_worked_on():
    shape = faceted_solid(cube(10))
    cut = shape.cut(Part.makeCylinder(2, 20, App.Vector(0, 0, -10)))
    assert cut.isValid()
    assert cut.Volume == pytest.approx(1000 - np.pi * 4 * 10)


def test_no_solid_of_a_bad_mesh():
    box = cube(10)
    with pytest.raises(VolfrepError, match="3 of its edges"):
        faceted_solid(TriangleMesh(box.vertices, box.triangles[1:]))
    with pytest.raises(VolfrepError, match="no volume"):
        faceted_solid(box.reversed())


def test_voids_of_several_bodies():
    hollow = concatenate(cube(10), cube(4).reversed())
    shape = faceted_solid(concatenate(hollow, cube(4, (20, 0, 0))))
    assert shape.isValid()
    assert sorted(solid.Volume for solid in shape.Solids) == pytest.approx([64, 1000 - 64])


def test_solid_of_something_without_a_mesh(doc, box):
    with pytest.raises(VolfrepError, match="no mesh"):
        make_solid(doc, box)


@pytest.mark.slow
def test_a_large_solid(doc):
    """Thousands of triangles at once; FreeCAD's own sewing takes minutes."""
    obj = doc.addObject("Mesh::Feature", "Ball")
    obj.Mesh = Mesh.createSphere(20, 80)
    solid = make_solid(doc, obj)
    assert solid.Shape.Volume == pytest.approx(obj.Mesh.Volume, rel=1e-5)


@pytest.mark.parametrize("way", ["its name", "a symbolic link", "a hard link"])
def test_no_export_replaces_a_file_that_the_object_is_made_of(doc, infill, tmp_path, way):
    base = tmp_path / "base.stl"
    Mesh.createBox(30, 30, 30).write(str(base))
    cell, field = tmp_path / "own.json", tmp_path / "field.csv"
    cell.write_text("{}")
    field.write_text("x")
    imported = doc.addObject("Mesh::Import", "Imported")
    imported.FileName = str(base)
    infill.Base, infill.CellFile, infill.RadiusField = imported, str(cell), str(field)
    doc.saveAs(str(tmp_path / "document.FCStd"))
    before = {file: file.read_bytes() for file in tmp_path.iterdir()}
    for file, what in (
        (base, "FileName of 'Imported'"),
        (cell, "CellFile of "),
        (field, "RadiusField of "),
        (tmp_path / "document.FCStd", "document "),
    ):
        target = file
        if way != "its name":
            target = tmp_path / f"link to {file.name}"
            (os.symlink if way == "a symbolic link" else os.link)(file, target)
        for content in ("mesh", "beams", "both", *CONTENTS):
            with pytest.raises(VolfrepError, match=f"is the {what}"):
                export_mesh(infill, target, content)
    assert all(file.read_bytes() == held for file, held in before.items())


def test_a_saved_table_or_cell_does_not_replace_what_a_document_reads(doc, infill, tmp_path):
    cell, field = tmp_path / "own.json", tmp_path / "field.csv"
    cell.write_text("{}")
    field.write_text("x")
    infill.CellFile, infill.RadiusField = str(cell), str(field)
    refuse_inputs_of_all(tmp_path / "new.csv")
    for path in (cell, field):
        with pytest.raises(VolfrepError, match="give another name"):
            refuse_inputs_of_all(path)
    refuse_inputs_of_all(cell, but=("CellFile",))
    with pytest.raises(VolfrepError, match="is the RadiusField of '"):
        refuse_inputs_of_all(field, but=("CellFile",))


def test_an_extension_that_is_typed_says_more_than_the_kind_that_the_dialog_stands_at():
    by_title = {form.title: form for form in FORMATS}
    stl, beams, axes = (
        by_title[title] for title in ("STL", "3MF, beams only", "STEP, axes of the struts")
    )
    forms = list(FORMATS)
    assert chosen_format("/a/part.inp", stl, forms)[1].content == "beam deck"
    assert chosen_format("/a/part.STEP", stl, forms)[1].title == "STEP, plane faces"
    assert chosen_format("/a/part.stp.stl", beams, forms) == ("/a/part.stp.3mf", beams)
    assert chosen_format("/a/part", axes, forms) == ("/a/part.step", axes)
    assert chosen_format("/a/part.cli", stl, forms)[1].content == "layers"
    assert chosen_format("/a/part.step", axes, forms) == ("/a/part.step", axes)
    with pytest.raises(VolfrepError, match=r"'\.xyz' is not .* \.png, \.svg or \.cli\."):
        chosen_format("/a/part.xyz", stl, forms)


@pytest.mark.parametrize("form", FORMS_OF_LAYERS)
def test_layers_hold_the_volume_of_the_mesh(infill, tmp_path, form):
    folder = layers_folder(tmp_path / f"part.{form}")
    pixel = 0.25 if form == "png" else None
    made = export_layers(infill, folder, 0.5, pixel, form)
    assert made.volume == pytest.approx(infill.Mesh.Volume, rel=0.01)
    assert estimate_layers(infill, 0.5, pixel).startswith(f"{made.count} layers of 0.5 mm")
    if form == "png":
        columns, rows = made.pixels
        assert f"{columns} x {rows} pixels" in estimate_layers(infill, 0.5, pixel)
    names = {path.name for path in folder.iterdir()} - {"layers.json"}
    assert len(names) == (1 if form == "cli" else made.count)
    assert {name.rsplit(".")[-1] for name in names} == {form}


def test_layers_are_refused_before_anything_is_written(doc, infill, tmp_path):
    (tmp_path / "mine.txt").write_text("kept", encoding="utf-8")
    with pytest.raises(VolfrepError, match="holds other files"):
        export_layers(infill, tmp_path, 0.5)
    infill.Placement = App.Placement(App.Vector(), App.Rotation(App.Vector(1, 0, 0), 90))
    with pytest.raises(VolfrepError, match="turn the base instead"):
        export_layers(infill, tmp_path / "part", 0.5)
    copy = doc.addObject("Mesh::Feature", "Copy")
    copy.Mesh = infill.Mesh
    with pytest.raises(VolfrepError, match="mesh without struts"):
        export_layers(copy, tmp_path / "part", 0.5)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_large_files_are_estimated_and_meshes_for_the_printer_are_not(infill):
    by_title = {form.title: form for form in FORMATS}
    assert estimate_export(infill, by_title["STL"]) == ""
    assert "MB" in estimate_export(infill, by_title["STEP, plane faces"])
    assert "MB" in estimate_export(infill, by_title["CalculiX, beams"])


@pytest.mark.costly
def test_a_file_for_a_printer_keeps_limits_and_compensates(doc, box, tmp_path):
    path = tmp_path / "part.stl"
    box.Length = box.Width = box.Height = 12
    infill = make_lattice_infill(doc, box, **{**SMALL, "CellType": "Box", "Resolution": 24})
    doc.recompute()
    most = int(0.7 * infill.Triangles)
    notes = export_for_printer(infill, path, max_triangles=most, compensate="SLS-PA12")
    written = Mesh.Mesh(str(path))
    assert 0.5 * most < written.CountFacets <= most
    assert written.Volume < infill.Volume.Value, "its struts are drawn thinner"
    assert len(notes) == 2
    assert "so that they come out 2.000 mm thick" in notes[0]
    with pytest.raises(VolfrepError, match="Choose limits"):
        export_for_printer(infill, path)
