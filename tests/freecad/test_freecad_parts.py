# SPDX-License-Identifier: LGPL-2.1-or-later
"""Real STEP parts, read where they lie; skipped where they are not at hand."""

import FreeCAD as App
import Part
import pytest

from bench.parts import NO_PARTS, PARTS
from freecad_volfrep import make_lattice_infill

pytestmark = pytest.mark.skipif(not PARTS.is_dir(), reason=NO_PARTS)

#: Cell size, strut radius and skin of each, mm.
SETTINGS = {
    "ge_bracket.step": (20.0, 2.0, 5.0),
    "piston_rod.step": (4.0, 0.4, 1.5),
    "trimesh_featuretype.STEP": (10.0, 1.0, 3.0),
    "nist_ctc_01_asme1_rd.stp": (60.0, 5.0, 8.0),
    "nist_ctc_02_asme1_rc.stp": (60.0, 5.0, 10.0),
    "nist_ftc_06_asme1_rd.stp": (25.0, 2.0, 5.0),
    "nist_ftc_10_asme1_rb.stp": (8.0, 0.8, 2.5),
}


@pytest.fixture
def doc():
    document = App.newDocument("Parts")
    yield document
    App.closeDocument(document.Name)


def part(doc, name):
    shape = Part.Shape()
    shape.read(str(PARTS / name))
    base = doc.addObject("Part::Feature", "Base")
    base.Shape = shape
    return base


@pytest.mark.slow
@pytest.mark.parametrize("name", SETTINGS)
def test_a_step_part_becomes_one_printable_body(doc, name):
    size, radius, skin = SETTINGS[name]
    base = part(doc, name)
    infill = make_lattice_infill(
        doc, base, CellType="CVC", CellSize=size, StrutRadius=radius, ShellThickness=skin
    )
    doc.recompute()
    assert infill.isValid(), infill.Status
    assert infill.Watertight
    assert infill.Bodies == 1
    assert infill.Mesh.isSolid()
    assert 0 < infill.Volume.Value < base.Shape.Volume


@pytest.mark.slow
def test_a_part_that_is_thin_everywhere_is_refused_with_a_sentence(doc):
    """The bent tray's sheet is thinner than two skins."""
    infill = make_lattice_infill(
        doc, part(doc, "nist_ctc_03_asme1_rc.stp"), CellSize=10, StrutRadius=1, ShellThickness=3
    )
    doc.recompute()
    assert not infill.isValid()
    assert "nowhere thicker than two skins" in infill.Status
