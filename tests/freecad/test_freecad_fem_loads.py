# SPDX-License-Identifier: LGPL-2.1-or-later
"""Constraints of the FEM workbench as load cases, beside the decks that FreeCAD writes of them."""

import re
import shutil

import FreeCAD as App
import numpy as np
import ObjectsFem
import pytest

from freecad_volfrep.bridge.fem_loads import has_loads, is_analysis, load_cases_of
from freecad_volfrep.bridge.solids import SolidReader, parent_placement
from volfrep.loads.load_cases import Force, Pressure
from volfrep.loads.nodal_loads import Body, nodal_case, nodes_in, resultant
from volfrep.loads.regions import AnyOf, NearPoint, OnFacets, OnLine
from volfrep.mechanics.materials import find_material
from volfrep.util.errors import VolfrepError

OLD = hasattr(ObjectsFem.makeConstraintSelfWeight(App.newDocument("Probe")), "Gravity_x")
App.closeDocument("Probe")
TITANIUM = {
    "Name": "Ti-6Al-4V",
    "YoungsModulus": "110 GPa",
    "PoissonRatio": "0.34",
    "Density": "4410 kg/m^3",
    "YieldStrength": "903 MPa",
}
needs_gmsh = pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not installed")


def analysis_of(doc, name="Analysis", material=True):
    analysis = ObjectsFem.makeAnalysis(doc, name)
    if material:
        made = ObjectsFem.makeMaterialSolid(doc, "Material")
        made.Material = TITANIUM
        analysis.addObject(made)
    return analysis


def add(analysis, kind, references=(), **values):
    """A constraint of the FEM workbench; values are in N, MPa and mm whatever the FreeCAD."""
    made = getattr(ObjectsFem, f"makeConstraint{kind}")(analysis.Document, kind)
    if references:
        made.References = list(references)
    for name, value in values.items():
        unit = {"Force": "N", "Pressure": "MPa"}.get(name)
        setattr(made, name, f"{value} {unit}" if unit and not OLD else value)
    analysis.addObject(made)
    analysis.Document.recompute()
    return made


def displaced(analysis, references, **moved):
    """A constraint of displacement: x, y or z in mm."""
    values = {}
    for axis, value in moved.items():
        values[f"{axis}Free"] = False
        values[f"{axis}Displacement"] = value
        if OLD and value == 0:
            values[f"{axis}Fix"] = True
    return add(analysis, "Displacement", references, **values)


def body_of(base, frame=None):
    mesh = SolidReader().read(base, frame or parent_placement(base))
    count = len(mesh.vertices)
    return Body(
        mesh.vertices, mesh.triangles.astype(np.int64), np.zeros(count), np.ones(count, bool)
    )


def face_at(obj, point):
    """The name of the face whose middle lies nearest to a point."""
    far = [face.CenterOfMass.distanceToPoint(App.Vector(*point)) for face in obj.Shape.Faces]
    return f"Face{1 + int(np.argmin(far))}"


@pytest.fixture
def case_of(doc, box):
    """A function that reads the one case of an analysis of the box."""
    return lambda analysis: load_cases_of([analysis], parent_placement(box)).cases[0]


def test_an_analysis_is_a_load_case_with_its_material(doc, box):
    analysis = analysis_of(doc)
    assert is_analysis(analysis)
    assert not has_loads(analysis)
    add(analysis, "Fixed", [(box, "Face1")])
    add(analysis, "Pressure", [(box, "Face2")], Pressure=2.5)
    assert has_loads(analysis)
    analysis.Label = "landing"
    cases = load_cases_of([analysis], App.Placement())
    (case,) = cases.cases
    assert case.name == "landing"
    assert (cases.material.young, cases.material.poisson) == pytest.approx((110_000, 0.34))
    assert (cases.material.density, cases.material.yield_stress) == pytest.approx((4.41, 903))
    (held,) = case.supports
    assert (held.displacement, held.turns) == ((0.0, 0.0, 0.0), (False, False, False))
    (load,) = case.loads
    assert isinstance(load, Pressure)
    assert load.pressure == pytest.approx(2.5)
    pa12 = find_material("PA12")
    assert load_cases_of([analysis], App.Placement(), pa12).material == pa12


def test_faces_edges_and_vertices_are_found_on_the_solid(doc, box, case_of):
    analysis = analysis_of(doc)
    right = face_at(box, (30, 10, 10))
    add(analysis, "Fixed", [(box, ("Face1", "Edge6", "Vertex8"))])
    add(analysis, "Force", [(box, right)], Force=100.0)
    case = case_of(analysis)
    face, edge, vertex = case.supports[0].region.regions
    assert (type(face), type(edge), type(vertex)) == (OnFacets, OnLine, NearPoint)
    body = body_of(box)
    ends = np.array([tuple(v.Point) for v in box.Shape.Edges[5].Vertexes])
    assert np.abs(body.nodes[nodes_in(body, edge)][:, None] - ends).sum(axis=2).min(0).max() < 1e-9
    assert body.nodes[nodes_in(body, vertex)[0]] == pytest.approx(
        tuple(box.Shape.Vertexes[7].Point)
    )
    laid = nodal_case(body, case)
    assert set(body.nodes[laid.loads.any(axis=1), 0]) == {30.0}
    assert laid.loads.sum(axis=0)[:3] == pytest.approx([100, 0, 0])  # across the face, outwards


def test_displacements_hold_the_axes_they_say(doc, box, case_of):
    analysis = analysis_of(doc)
    made = displaced(analysis, [(box, "Face1")], x=0.0, z=-0.25)
    made.rotyFree = False
    if OLD:
        made.rotyFix = True
    doc.recompute()
    (support,) = case_of(analysis).supports
    assert support.displacement == (0.0, None, -0.25)
    assert support.turns == (True, False, True)
    made.zRotation, made.rotzFree = 5.0, False
    with pytest.raises(VolfrepError, match="'Displacement' turns its nodes by an angle"):
        case_of(analysis)


def test_weight_pulls_where_it_says(doc, box, case_of):
    analysis = analysis_of(doc)
    add(analysis, "Fixed", [(box, "Face1")])
    weight = add(analysis, "SelfWeight")
    assert case_of(analysis).acceleration == pytest.approx((0, 0, -9806.65))
    if OLD:
        weight.Gravity_x, weight.Gravity_z = 2.0, 0.0
        assert case_of(analysis).acceleration == pytest.approx((9806.65, 0, 0))
    else:
        weight.GravityDirection = App.Vector(2, 0, 0)
        weight.GravityAcceleration = "3 m/s^2"
        assert case_of(analysis).acceleration == pytest.approx((3000, 0, 0))


def test_a_part_that_was_moved_keeps_its_loads(doc, box):
    part = doc.addObject("App::Part", "Part")
    part.addObject(box)
    box.Placement = App.Placement(App.Vector(5, 0, 0), App.Rotation(App.Vector(0, 1, 0), 30))
    doc.recompute()
    analysis = analysis_of(doc)
    right = f"Face{1 + int(np.argmax([f.CenterOfMass.x for f in box.Shape.Faces]))}"
    add(analysis, "Fixed", [(box, "Face1")])
    add(analysis, "Pressure", [(box, right)], Pressure=1.5)
    part.Placement = App.Placement(App.Vector(100, 0, 7), App.Rotation(App.Vector(0, 0, 1), 90))
    doc.recompute()
    frame = parent_placement(box)
    body = body_of(box, frame)
    laid = nodal_case(body, load_cases_of([analysis], frame).cases[0])
    outward = box.Shape.getElement(right).normalAt(0, 0)
    expected = -1.5 * box.Shape.getElement(right).Area * np.array(tuple(outward))
    assert laid.loads.sum(axis=0)[:3] == pytest.approx(expected)


def test_several_analyses_are_several_cases(doc, box):
    analyses = []
    for name, size in (("Up", 5.0), ("Down", -5.0)):
        analysis = analysis_of(doc, name)
        add(analysis, "Fixed", [(box, "Face1")])
        add(analysis, "Force", [(box, "Face2")], Force=size)
        analyses.append(analysis)
    cases = load_cases_of(analyses, App.Placement())
    assert [case.name for case in cases.cases] == ["Up", "Down"]
    assert [case.loads[0].force[0] for case in cases.cases] == pytest.approx([5, -5])
    other = next(o for o in analyses[1].Group if o.isDerivedFrom("App::MaterialObject"))
    other.Material = {**TITANIUM, "Name": "Steel", "YoungsModulus": "210 GPa"}
    with pytest.raises(VolfrepError, match="'Ti-6Al-4V' and 'Steel': a part is printed of one"):
        load_cases_of(analyses, App.Placement())


def test_what_cannot_be_read_is_told_by_its_label(doc, box, case_of):
    analysis = analysis_of(doc, material=False)
    add(analysis, "Fixed", [(box, "Face1")])
    with pytest.raises(VolfrepError, match="The load case 'Analysis' has no load"):
        case_of(analysis)
    force = add(analysis, "Force", [(box, "Face2")], Force=1.0)
    with pytest.raises(VolfrepError, match="Neither the infill nor its load cases"):
        case_of(analysis)
    made = ObjectsFem.makeMaterialSolid(doc, "Material")
    made.Material = {"Name": "Odd", "YoungsModulus": "2 GPa", "Density": "1 g/cm^3"}
    analysis.addObject(made)
    with pytest.raises(VolfrepError, match="'Material' has no PoissonRatio that is a number"):
        case_of(analysis)
    made.Material = TITANIUM
    force.References = [(box, ("Face2", "Edge1"))]
    with pytest.raises(VolfrepError, match="make a force of each kind"):
        case_of(analysis)
    force.References = []
    with pytest.raises(VolfrepError, match="'Force' refers to no face, edge or vertex"):
        case_of(analysis)
    force.References = [(box, "Face2")]
    spin = add(analysis, "Centrif")
    spin.Label = "spinning"
    with pytest.raises(VolfrepError, match="'spinning' of 'Analysis' is a constraint that is not"):
        case_of(analysis)
    if not OLD:
        spin.Suppressed = True
        assert len(case_of(analysis).loads) == 1
    if hasattr(force, "EnableAmplitude"):  # FreeCAD 1.1
        force.EnableAmplitude = True
        with pytest.raises(VolfrepError, match="'Force' changes in time"):
            case_of(analysis)


@pytest.mark.skipif(
    not hasattr(ObjectsFem, "makeConstraintRigidBody"), reason="rigid bodies are FreeCAD 1.0's"
)
def test_a_rigid_body_carries_a_force_through_a_point_and_a_moment(doc, box, case_of):
    analysis = analysis_of(doc)
    add(analysis, "Fixed", [(box, "Face1")])
    made = add(analysis, "RigidBody", [(box, face_at(box, (30, 10, 10)))])
    with pytest.raises(VolfrepError, match="neither holds nor loads"):
        case_of(analysis)
    made.ReferenceNode = App.Vector(50, 4, 10)
    made.TranslationalModeY = made.RotationalModeZ = "Load"
    made.ForceY, made.MomentZ, made.MomentX = "20 N", "0.5 N*m", "9 N*m"  # about x it is free
    body = body_of(box)
    felt, turned = resultant(body.nodes, nodal_case(body, case_of(analysis)).loads, [50, 4, 10])
    assert felt == pytest.approx([0, 20, 0], abs=1e-9)
    assert turned == pytest.approx([0, 0, 500], abs=1e-6)
    made.RotationalModeX = "Constraint"
    with pytest.raises(VolfrepError, match="holds a part of its freedoms"):
        case_of(analysis)


@needs_gmsh
def test_the_loads_are_those_that_freecad_writes_for_calculix(doc, box, case_of, tmp_path):
    """A force along an edge on two faces, one on two vertices, and a pressure that pulls."""
    analysis = analysis_of(doc)
    add(analysis, "Fixed", [(box, "Face1")])
    slanted = doc.addObject("Part::Box", "Slanted")
    slanted.Placement.Rotation = App.Rotation(App.Vector(1, 2, 0), 40)
    doc.recompute()
    right, top = face_at(box, (30, 10, 10)), face_at(box, (15, 10, 20))
    add(analysis, "Force", [(box, (right, top))], Force=300.0, Direction=(slanted, ["Edge1"]))
    corners = [f"Vertex{k + 1}" for k, v in enumerate(box.Shape.Vertexes) if v.X == 30]
    nodes = [(box, name) for name in corners[:2]]
    add(analysis, "Force", nodes, Force=50.0, Direction=(slanted, ["Edge2"]), Reversed=True)
    add(analysis, "Pressure", [(box, top)], Pressure=0.75, Reversed=True)
    case = case_of(analysis)
    forces = [load for load in case.loads if isinstance(load, Force)]
    assert isinstance(forces[1].region, AnyOf)

    from femmesh.gmshtools import GmshTools
    from femtools import ccxtools

    mesh = ObjectsFem.makeMeshGmsh(doc, "Mesh")
    setattr(mesh, "Shape" if hasattr(mesh, "Shape") else "Part", box)
    mesh.CharacteristicLengthMax = 8.0
    doc.recompute()
    GmshTools(mesh).create_mesh()
    analysis.addObject(mesh)
    make = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None)
    solver = (make or ObjectsFem.makeSolverCalculixCcxTools)(doc, "CalculiX")
    analysis.addObject(solver)
    doc.recompute()
    fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
    fea.update_objects()
    fea.setup_working_dir(str(tmp_path))
    assert fea.check_prerequisites() == ""
    fea.write_inp_file()
    deck = (tmp_path / f"{mesh.Name}.inp").read_text()

    written = np.zeros((1 + max(mesh.FemMesh.Nodes), 6))
    places = np.zeros((len(written), 3))
    for number, place in mesh.FemMesh.Nodes.items():
        places[number] = tuple(place)
    for block in re.findall(r"\*CLOAD\n(.*?)(?=\n\*[A-Z]|\Z)", deck, re.DOTALL):
        for node, axis, value in re.findall(r"^(\d+),(\d),([-+\d.E]+)", block, re.MULTILINE):
            written[int(node), int(axis) - 1] += float(value)
    body = body_of(box)
    about = np.array([0.0, 0.0, 0.0])
    ours = sum(resultant(body.nodes, loads, about)[0] for loads in _shares(body, forces))
    turning = sum(resultant(body.nodes, loads, about)[1] for loads in _shares(body, forces))
    force, moment = resultant(places, written, about)
    assert ours == pytest.approx(force, rel=1e-5, abs=1e-3)
    assert turning == pytest.approx(moment, rel=1e-4, abs=0.1)

    # FreeCAD writes a pressure as it is, face by face of its mesh: above 0 pushes.
    (value,) = {float(p) for p in re.findall(r"^\d+,P\d,([-+\d.E]+)", deck, re.MULTILINE)}
    (pull,) = [load for load in case.loads if isinstance(load, Pressure)]
    assert value == pytest.approx(pull.pressure)
    assert pull.pressure == pytest.approx(-0.75)


def _shares(body, forces):
    from volfrep.loads.nodal_loads import nodal_loads

    return [nodal_loads(body, load) for load in forces]
