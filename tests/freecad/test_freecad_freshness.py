# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether a mesh is that of the present values: by all that it is made of, after saving too."""

import json
import re
import zipfile

import FreeCAD as App
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.export.faceted_solid import make_solid
from freecad_volfrep.features.export.mesh_file import export_mesh
from freecad_volfrep.features.infill.freshness import (
    _earlier_fingerprint,
    fingerprint_of,
    is_of,
    why_stale,
)
from freecad_volfrep.features.infill.lattice_infill import UP_TO_DATE
from freecad_volfrep.features.reports.mesh_check import check_mesh
from freecad_volfrep.features.reports.statistics import statistics

CELL = {
    "nodes": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "struts": [[0, 1], [0, 2], [0, 3]],
}


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ({"edges": [1, 1, 1.5]}, {"edges": [1, 1, 1.25]}),
        ({"widths": [1, 1, 1.5]}, {"widths": [1, 1, 1.25]}),
    ],
    ids=["edges", "widths"],
)
def test_another_file_of_the_cell_is_seen(doc, box, tmp_path, before, after):
    file = tmp_path / "cell.json"
    file.write_text(json.dumps(CELL | before))
    values = {**SMALL, "CellType": "Custom", "CellFile": str(file), "AutoUpdate": False}
    obj = make_lattice_infill(doc, box, **values)
    spec, solid = obj.Proxy.read(obj)
    kept = fingerprint_of(obj, spec, solid)
    file.write_text(json.dumps(CELL | after))
    assert not is_of(kept, obj, *obj.Proxy.read(obj))
    file.write_text(json.dumps(CELL | before))
    assert is_of(kept, obj, *obj.Proxy.read(obj))


def test_a_document_is_up_to_date_when_it_is_opened_again(doc, infill, runs, tmp_path):
    """A shape from a file is meshed in another order, and with other diagonals."""
    infill.Base.Placement = App.Placement(App.Vector(1, 2, 3), App.Rotation(10, 20, 30))
    doc.recompute()
    doc.saveCopy(str(tmp_path / "one.FCStd"))
    again = App.openDocument(str(tmp_path / "one.FCStd"))
    try:
        obj = next(one for one in again.Objects if hasattr(one, "Fingerprint"))
        before = len(runs)
        assert why_stale(obj) == ""
        obj.touch()
        again.recompute()
        assert obj.Status == UP_TO_DATE
        assert len(runs) == before
    finally:
        App.closeDocument(again.Name)


def test_the_order_and_the_diagonals_of_a_shapes_mesh_do_not_count(doc, box):
    """As OpenCASCADE draws them otherwise in a part that was imported, saved and opened."""
    import numpy as np

    from volfrep.mesh.triangle_mesh import TriangleMesh

    obj = make_lattice_infill(doc, box, **SMALL, AutoUpdate=False)
    spec, solid = obj.Proxy.read(obj)
    kept = fingerprint_of(obj, spec, solid)
    order = np.random.default_rng(1).permutation(len(solid.vertices))
    place = np.argsort(order).astype(np.int32)
    other = TriangleMesh(solid.vertices[order], place[solid.triangles][::-1])
    assert fingerprint_of(obj, spec, other) == kept
    moved = TriangleMesh(solid.vertices + 1e-4, solid.triangles)
    assert fingerprint_of(obj, spec, moved) != kept


def test_the_fingerprint_of_an_earlier_release_counts(doc, infill, runs):
    spec, solid = infill.Proxy.read(infill)
    now = infill.Fingerprint
    infill.Fingerprint = _earlier_fingerprint(spec, solid)
    infill.touch()
    doc.recompute()
    assert not runs
    assert infill.Fingerprint == now
    infill.Fingerprint = "0" * 64
    assert why_stale(infill)


def test_why_a_mesh_is_stale(doc, infill):
    assert why_stale(infill) == ""
    infill.AutoUpdate = False
    infill.StrutRadius = 0.7
    assert "values or the solid" in why_stale(infill)
    doc.recompute()
    assert "values or the solid" in why_stale(infill)
    infill.StrutRadius = SMALL["StrutRadius"]
    assert why_stale(infill) == ""
    infill.Base.touch()
    assert "not recomputed" in why_stale(infill)
    doc.recompute()
    assert why_stale(infill) == ""
    infill.StrutRadius = 0
    assert "cannot be computed" in why_stale(infill)


@pytest.mark.costly
def test_what_is_made_of_a_stale_mesh_says_so(doc, infill, tmp_path):
    target = tmp_path / "out.stl"
    assert export_mesh(infill, target) == ()
    assert not any(row[0] == "out of date" for table in check_mesh(infill) for row in table.rows)
    assert make_solid(doc, infill).Label2 == ""
    infill.AutoUpdate, infill.StrutRadius = False, 0.7
    doc.recompute()
    (said,) = export_mesh(infill, target)
    assert "is out of date" in said
    assert target.stat().st_size
    for tables in (check_mesh(infill), statistics([infill])):
        assert any(row[0] == "out of date" and said in row for t in tables for row in t.rows)
    assert make_solid(doc, infill).Label2 == said


@pytest.mark.costly
def test_a_choice_that_is_at_none_of_its_values_is_refused(doc, box, tmp_path):
    make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    doc.saveAs(str(tmp_path / "one.FCStd"))
    for name in ("CellType", "Boundary"):
        with zipfile.ZipFile(tmp_path / "one.FCStd") as kept:
            parts = {one: kept.read(one) for one in kept.namelist()}
        before, found, after = parts["Document.xml"].partition(f'name="{name}"'.encode())
        assert found
        after = re.sub(rb'<Integer value="\d+"', b'<Integer value="9999"', after, count=1)
        parts["Document.xml"] = before + found + after
        with zipfile.ZipFile(tmp_path / f"{name}.FCStd", "w") as changed:
            for one, content in parts.items():
                changed.writestr(one, content)
        again = App.openDocument(str(tmp_path / f"{name}.FCStd"))
        try:
            obj = next(one for one in again.Objects if hasattr(one, "Fingerprint"))
            assert f"{name} is at none" in obj.Status
            obj.touch()
            again.recompute()
            assert not obj.isValid()
            assert f"{name} is at none" in obj.Status
            assert obj.Mesh.CountFacets
            try:
                setattr(obj, name, obj.getEnumerationsOfProperty(name)[0])
            except ValueError:  # FreeCAD 1.1 takes no value then
                obj.removeProperty(name)
            again.recompute()
            assert obj.isValid()
        finally:
            App.closeDocument(again.Name)
