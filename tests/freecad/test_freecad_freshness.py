# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether a mesh is that of the present values: by all that it is made of, after saving too."""

import json

import FreeCAD as App
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.freshness import (
    _earlier_fingerprint,
    fingerprint_of,
    is_of,
    why_stale,
)
from freecad_volfrep.features.lattice_infill import UP_TO_DATE

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
