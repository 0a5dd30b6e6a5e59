# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks in place of cells, by the properties of the document's object."""

import json

import FreeCAD as App
import pytest

from freecad_volfrep import make_lattice_infill


@pytest.fixture
def box(doc):
    solid = doc.addObject("Part::Box", "Solid")
    solid.Length = solid.Width = solid.Height = 24
    doc.recompute()
    return solid


def test_a_voronoi_network_fills_a_solid_and_follows_its_seed(doc, box):
    obj = make_lattice_infill(
        doc, box, Network="Voronoi", NetworkPoints=15, StrutRadius=0.6, ShellThickness=1.5
    )
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.Mesh.isSolid()
    assert obj.Bodies == 1
    assert obj.Struts > 20
    before = obj.Volume.Value
    obj.NetworkSeed = 2
    doc.recompute()
    assert obj.Volume.Value != before
    assert json.loads(obj.Report)["spec"]["network"]["seed"] == 2


def test_a_network_of_a_file(doc, box, tmp_path):
    nodes = [[0, 0, 0], [24, 24, 24], [24, 0, 0], [0, 24, 24], [12, 12, 12]]
    file = tmp_path / "net.json"
    file.write_text(json.dumps({"nodes": nodes, "struts": [[k, 4] for k in range(4)]}))
    obj = make_lattice_infill(doc, box, Network="File", StrutRadius=1, ShellThickness=1.5)
    doc.recompute()
    assert not obj.isValid()
    assert "needs NetworkFile" in obj.Status
    obj.NetworkFile = str(file)
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert (obj.Nodes, obj.Struts, obj.Bodies) == (5, 4, 1)
    assert App.ActiveDocument is not None
