# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests inside FreeCAD share: a document, a box in it, and small quick lattices."""

import FreeCAD as App
import pytest

from freecad_volfrep import make_lattice_infill
from freecad_volfrep.engine import require_engine

#: A lattice that is quick to compute.
SMALL = {"CellSize": 10, "StrutRadius": 1, "ShellThickness": 2, "Resolution": 10}


@pytest.fixture
def doc():
    document = App.newDocument("VolfrepTest")
    document.UndoMode = 1
    yield document
    App.closeDocument(document.Name)


@pytest.fixture
def box(doc):
    solid = doc.addObject("Part::Box", "Solid")
    solid.Length, solid.Width, solid.Height = 30, 20, 20
    doc.recompute()
    return solid


@pytest.fixture
def infill(doc, box):
    """A computed lattice infill of the box."""
    obj = make_lattice_infill(doc, box, **SMALL)
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


@pytest.fixture
def runs(monkeypatch):
    """The specifications that the engine has been run with since the test began."""
    require_engine()
    import volfrep.pipeline

    specs = []
    fill = volfrep.pipeline.fill

    def counting(solid, spec, **options):
        specs.append(spec)
        return fill(solid, spec, **options)

    monkeypatch.setattr(volfrep.pipeline, "fill", counting)
    return specs
