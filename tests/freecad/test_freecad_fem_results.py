# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD's solvers leave: pipelines as fields, beside the results of the older solver."""

import shutil

import FreeCAD as App
import numpy as np
import ObjectsFem
import pytest

from conftest import SMALL
from freecad_volfrep import make_lattice_infill
from freecad_volfrep.bridge.fem_fields import field_of_result
from volfrep.util.errors import VolfrepError

pytest.importorskip("vtkmodules", reason="VTK is not installed for Python")
NEW = hasattr(ObjectsFem, "makeSolverCalculiX")
GRID = """<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData>
<DataArray type="Float64" Name="von Mises Stress" format="ascii">10 20 30 80</DataArray>
<DataArray type="Float64" Name="Displacement" NumberOfComponents="3" format="ascii">
0 0 0  3 0 4  0 1 0  0 0 -2</DataArray>
<DataArray type="Float64" Name="Stress" NumberOfComponents="6" format="ascii">
1 2 3 4 5 6  1 2 3 4 5 6  1 2 3 4 5 6  1 2 3 4 5 6</DataArray>
</PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0  30 0 0  0 20 0  0 0 20</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
"""


needs_pipelines = pytest.mark.skipif(
    not NEW, reason="this FreeCAD's solver makes no pipeline, and its pipelines are not to be read"
)


@pytest.fixture
def pipeline(doc, tmp_path):
    (tmp_path / "grid.vtu").write_text(GRID)
    made = doc.addObject("Fem::FemPostPipeline", "Result")
    made.read(str(tmp_path / "grid.vtu"))
    doc.recompute()
    return made


@needs_pipelines
def test_a_pipeline_is_a_field_by_the_names_of_either_kind(pipeline):
    field = field_of_result(pipeline, "", App.Placement())
    assert field([[30, 0, 0], [0, 0, 20]]) == pytest.approx([20, 80])
    assert field.source == "Result, vonMises"
    again = field_of_result(pipeline, "von mises stress", App.Placement())
    assert (again.values == field.values).all()
    # Of a vector its length counts.
    for name in ("Displacement", "DisplacementLengths"):
        moved = field_of_result(pipeline, name, App.Placement())
        assert moved([[30, 0, 0], [0, 20, 0]]) == pytest.approx([5, 1])


@needs_pipelines
def test_a_pipeline_lies_where_the_part_is_seen_from(pipeline):
    frame = App.Placement(App.Vector(30, 0, 0), App.Rotation(App.Vector(0, 0, 1), 90))
    field = field_of_result(pipeline, "", frame)
    assert field([[0, 0, 0], [0, 30, 0]]) == pytest.approx([20, 10])


@needs_pipelines
def test_what_a_pipeline_lacks_is_told(pipeline):
    for name in ("Stress", "Temperature"):
        with pytest.raises(VolfrepError, match=f"no '{name}': choose von Mises Stress, Displ"):
            field_of_result(pipeline, name, App.Placement())


def test_an_empty_pipeline_is_told(doc):
    empty = doc.addObject("Fem::FemPostPipeline", "Empty")
    with pytest.raises(VolfrepError, match="'Empty' is empty: run the solver"):
        field_of_result(empty, "", App.Placement())


@needs_pipelines
def test_a_lattice_follows_a_pipeline_also_after_it_was_saved(doc, box, pipeline, tmp_path):
    obj = make_lattice_infill(
        doc, box, **{**SMALL, "StrutRadius": 0.7}, RadiusGrading="Field", RadiusResult=pipeline,
        RadiusEnd=1.1,
    )  # fmt: skip
    doc.recompute()
    assert obj.isValid(), obj.Status
    assert obj.StrutRadii[1] > 1.05
    assert "4 points of Result, vonMises" in obj.Report
    doc.saveCopy(str(tmp_path / "part.FCStd"))
    copy = App.openDocument(str(tmp_path / "part.FCStd"))
    try:
        field = field_of_result(copy.getObject(pipeline.Name), "", App.Placement())
        assert field([[30, 0, 0], [0, 0, 20]]) == pytest.approx([20, 80])
    finally:
        App.closeDocument(copy.Name)


@needs_pipelines
@pytest.mark.skipif(
    not (shutil.which("ccx") and shutil.which("gmsh")), reason="CalculiX or Gmsh is not installed"
)
def test_the_newer_solvers_pipeline_says_what_the_older_ones_result_says(doc, box, tmp_path):
    from femmesh.gmshtools import GmshTools
    from femsolver.calculix.calculixtools import CalculiXTools
    from femtools import ccxtools

    analysis = ObjectsFem.makeAnalysis(doc, "Analysis")
    material = ObjectsFem.makeMaterialSolid(doc, "Material")
    material.Material = {
        "Name": "Steel",
        "YoungsModulus": "210 GPa",
        "PoissonRatio": "0.3",
        "Density": "7900 kg/m^3",
    }
    held = ObjectsFem.makeConstraintFixed(doc)
    held.References = [(box, "Face1")]
    push = ObjectsFem.makeConstraintForce(doc)
    push.References, push.Force, push.Direction = [(box, "Face2")], "500 N", (box, ["Edge2"])
    mesh = ObjectsFem.makeMeshGmsh(doc, "Mesh")
    mesh.Shape, mesh.CharacteristicLengthMax = box, "6 mm"
    new, old = ObjectsFem.makeSolverCalculiX(doc), ObjectsFem.makeSolverCalculiXCcxTools(doc)
    for member in (material, held, push, mesh):
        analysis.addObject(member)
    doc.recompute()
    GmshTools(mesh).create_mesh()

    analysis.addObject(new)
    new.WorkingDirectory = str(tmp_path / "new")
    (tmp_path / "new").mkdir()
    tools = CalculiXTools(new)
    tools.prepare()
    assert tools.compute().waitForFinished()
    tools.update_properties()
    (pipeline,) = [o for o in analysis.Group if o.isDerivedFrom("Fem::FemPostPipeline")]
    # Before the older solver runs: it loads its own result into the pipeline, in Pa and m.
    quantities = ("", "PrincipalMax", "PrincipalMin", "MaxShear", "DisplacementLengths")
    newer = [field_of_result(pipeline, quantity, App.Placement()) for quantity in quantities]

    analysis.addObject(old)
    fea = ccxtools.FemToolsCcx(analysis, old)
    fea.update_objects()
    fea.setup_working_dir(str(tmp_path / "old"))
    fea.setup_ccx()
    fea.write_inp_file()
    assert fea.ccx_run() == 0
    fea.load_results()
    (result,) = [o for o in doc.Objects if o.isDerivedFrom("Fem::FemResultObject")]

    points = np.random.default_rng(1).uniform((1, 1, 1), (29, 19, 19), (50, 3))
    for quantity, field in zip(quantities, newer, strict=True):
        expected = field_of_result(result, quantity, App.Placement())(points)
        scale = np.abs(expected).max()
        assert field(points) == pytest.approx(expected, rel=1e-3, abs=1e-3 * scale), quantity
