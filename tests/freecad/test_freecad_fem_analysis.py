# SPDX-License-Identifier: LGPL-2.1-or-later
"""Analyses for the FEM workbench, solved by its own tools and beside decks of ours."""

import shutil

import FreeCAD as App
import numpy as np
import pytest

from bench.static_step import StaticStep
from conftest import SMALL
from freecad_volfrep import make_fem_analysis, make_lattice_infill
from freecad_volfrep.features.export.fem_analysis import vertices
from freecad_volfrep.features.export.solver_files import axes_of
from volfrep.util.errors import Cancelled, VolfrepError

needs_calculix = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed"
)
needs_gmsh = pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not installed")
SAMPLE = {"CellType": "CVC", "CellSize": 20, "StrutRadius": 2, "ShellThickness": 0}


def block(doc, size=(60, 40, 20), **properties):
    """An infill of a box without a skin: a block of CVC cells, cut flat at its sides."""
    box = doc.addObject("Part::Box", "Box")
    box.Length, box.Width, box.Height = size
    doc.recompute()
    obj = make_lattice_infill(doc, box, **{**SAMPLE, **properties})
    doc.recompute()
    assert obj.isValid(), obj.getStatusString()
    return obj


def named(doc, name):
    (found,) = [o for o in doc.Objects if o.Name.startswith(name) and o.TypeId == "Part::Feature"]
    return found


def held(doc, analysis, fixed, loaded, force=200.0):
    """A fixed constraint, and a force along +x."""
    import ObjectsFem

    constraint = ObjectsFem.makeConstraintFixed(doc, "Fixed")
    constraint.References = [fixed]
    analysis.addObject(constraint)
    load = ObjectsFem.makeConstraintForce(doc, "Force")
    load.References = [loaded]
    load.Force = force if App.Version()[0] == "0" else f"{force} N"
    # The direction is taken from an edge of any object.
    along = doc.addObject("Part::Box", "Along")
    doc.recompute()
    load.Direction = (along, ["Edge9"])
    doc.recompute()
    load.Reversed = load.DirectionVector.x < 0
    analysis.addObject(load)
    doc.recompute()
    assert load.DirectionVector.isEqual(App.Vector(1, 0, 0), 1e-9)


def solved(doc, analysis, folder):
    """Displacements by place: (n, 3) nodes, (n, 3) mm."""
    from femtools import ccxtools

    (solver,) = [o for o in analysis.Group if "Solver" in o.TypeId]
    fea = ccxtools.FemToolsCcx(analysis, solver)
    fea.update_objects()
    fea.setup_working_dir(str(folder))
    fea.setup_ccx()
    assert fea.check_prerequisites() == ""
    fea.write_inp_file()
    assert fea.ccx_run() == 0
    fea.load_results()
    (result,) = [o for o in doc.Objects if o.isDerivedFrom("Fem::FemResultObject")]
    places = result.Mesh.FemMesh.Nodes
    nodes = np.array([tuple(places[number]) for number in result.NodeNumbers])
    return nodes, np.array([tuple(vector) for vector in result.DisplacementVectors])


def at_side(shape, x):
    """The vertices of an object at a place along x."""
    points = shape.Shape.Vertexes
    return shape, [f"Vertex{k + 1}" for k, v in enumerate(points) if abs(v.X - x) < 0.01]


def test_an_analysis_of_beams_is_complete_but_for_its_constraints(doc, infill):
    analysis = make_fem_analysis(doc, infill)
    types = [getattr(getattr(o, "Proxy", None), "Type", o.TypeId) for o in analysis.Group]
    assert types.count("Fem::MaterialCommon") == 2
    assert types.count("Fem::ElementGeometry1D") == 1
    (mesh,) = [o.FemMesh for o in analysis.Group if o.TypeId == "Fem::FemMeshObject"]
    groups = {mesh.getGroupName(k): mesh.getGroupElements(k) for k in mesh.Groups}
    frame = axes_of(infill)
    assert len(groups["JOINTS"]) == len(frame.wireframe.nodes)
    assert len(groups["SKIN"]) == np.count_nonzero(frame.on_boundary)
    assert len(named(doc, "SkinJoints").Shape.Vertexes) == len(groups["SKIN"])
    assert mesh.EdgeCount > 6 * infill.Struts
    (section,) = [o for o in analysis.Group if o.Name.startswith("Section")]
    assert section.CircDiameter.Value == pytest.approx(2.0)
    # The ends that were fitted to the cell are a material of their own.
    (stiff,) = [o for o in analysis.Group if o.Name.endswith("_END")]
    edges = len(named(doc, "Axes").Shape.Edges)
    assert 0 < len(stiff.References[0][1]) < edges


@pytest.mark.parametrize("last", [False, True], ids=["at the first step", "at the last one"])
def test_a_cancel_leaves_nothing_behind(doc, infill, monkeypatch, last):
    def cancelled(_, steps):
        steps = iter(steps)
        next(steps)
        while last and not any(obj.isDerivedFrom("Fem::FemMeshObject") for obj in doc.Objects):
            next(steps)
        steps.throw(Cancelled())

    monkeypatch.setattr("freecad_volfrep.features.export.fem_analysis.go_through", cancelled)
    before = [obj.Name for obj in doc.Objects]
    with pytest.raises(Cancelled):
        make_fem_analysis(doc, infill)
    assert [obj.Name for obj in doc.Objects] == before


def test_struts_of_several_radii_have_several_sections(doc, box):
    infill = make_lattice_infill(
        doc, box, **SMALL, RadiusGrading="Direction", RadiusStart=0.8, RadiusEnd=1.2
    )
    doc.recompute()
    assert infill.isValid(), infill.getStatusString()
    analysis = make_fem_analysis(doc, infill)
    sections = [o for o in analysis.Group if o.Name.startswith("Section")]
    assert len(sections) > 5
    edges = [name for section in sections for name in section.References[0][1]]
    assert len(edges) == len(set(edges)) == len(named(doc, "Axes").Shape.Edges)


@needs_calculix
def test_beams_solved_by_freecad_and_by_our_own_deck(doc, tmp_path):
    """200 N on the paper's sample: 1.54 mm by solid elements (see docs/solver.md)."""
    from volfrep.design.cells import LIBRARY
    from volfrep.fem.beam_mesh import fitted_beams
    from volfrep.fem.calculix import solve
    from volfrep.fem.deck import write_beams
    from volfrep.mechanics.materials import Material

    infill = block(doc, Resolution=8)
    analysis = make_fem_analysis(doc, infill)
    joints = named(doc, "Joints")
    held(doc, analysis, at_side(joints, 0.004), at_side(joints, 60.004))
    nodes, moved = solved(doc, analysis, tmp_path)
    freecad = moved[np.abs(nodes[:, 0] - 60.004) < 1e-3, 0]
    assert len(freecad) == 6

    frame = axes_of(infill)
    model, _ = fitted_beams(frame.wireframe, frame.on_boundary, LIBRARY["CVC"], 20.0)
    place = model.nodes[: model.joints, 0]
    fixed, loaded = np.flatnonzero(place < 0.01), np.flatnonzero(place > 60)
    step = StaticStep(fixed, loaded, (200.0, 0, 0))
    write_beams(model, tmp_path / "own.inp", Material(), on_boundary=frame.on_boundary)
    step.add_to(tmp_path / "own.inp", of_beams=True)
    own = solve(tmp_path / "own.inp")[loaded, 0]
    # Round three-noded beams there, square two-noded ones here, each with ends of its own.
    assert freecad.mean() == pytest.approx(own.mean(), rel=0.06)
    assert freecad.mean() == pytest.approx(1.54, rel=0.05)
    # The sample has hardly an inner joint, and its corner joints stiffen less than the cell's.
    assert own.mean() == pytest.approx(1.54, rel=0.08)


@pytest.mark.slow
@needs_calculix
def test_the_skin_holds_the_lattice(doc, infill, tmp_path):
    analysis = make_fem_analysis(doc, infill)
    joints, skin = named(doc, "Joints"), named(doc, "SkinJoints")
    held_places = {tuple(np.round(v.Point, 6)) for v in skin.Shape.Vertexes}
    free = next(
        f"Vertex{k + 1}"
        for k, v in enumerate(joints.Shape.Vertexes)
        if tuple(np.round(v.Point, 6)) not in held_places
    )
    held(doc, analysis, vertices(skin), (joints, [free]), 10.0)
    nodes, moved = solved(doc, analysis, tmp_path)
    place = np.array(joints.getSubObject(free).Point)
    own = np.argmin(np.linalg.norm(nodes - place, axis=1))
    assert moved[own, 0] > 1e-4
    assert moved[own, 0] == pytest.approx(np.linalg.norm(moved, axis=1).max(), rel=0.2)


@needs_calculix
@needs_gmsh
@pytest.mark.slow
def test_tetrahedra_solved_by_freecad_and_by_our_own_deck(doc, tmp_path):
    from freecad_volfrep.bridge.solids import mesh_in_document
    from volfrep.fem.calculix import solve
    from volfrep.fem.deck import sides, write_tetrahedra
    from volfrep.fem.tet_mesh import tetrahedra
    from volfrep.mechanics.materials import Material

    infill = block(doc, (16, 14, 14), CellSize=10, StrutRadius=1, ShellThickness=2, Resolution=8)
    steel = Material("STEEL", 210_000.0, 0.3, 7.85)
    analysis = make_fem_analysis(doc, infill, "tetrahedra", steel)
    (mesh,) = [o.FemMesh for o in analysis.Group if o.TypeId == "Fem::FemMeshObject"]
    assert mesh.Volume.Value == pytest.approx(infill.Volume.Value, rel=1e-4)
    boundary = named(doc, "Boundary")
    faces = {
        round(face.CenterOfMass.x): f"Face{k + 1}"
        for k, face in enumerate(boundary.Shape.Faces)
        if abs(abs(face.normalAt(0, 0).x) - 1) < 1e-9
    }
    held(doc, analysis, (boundary, [faces[0]]), (boundary, [faces[16]]), 1000.0)
    nodes, moved = solved(doc, analysis, tmp_path)
    end = nodes[:, 0] > 16 - 1e-3

    filled = tetrahedra(mesh_in_document(infill))
    side = sides(filled.nodes)
    assert np.count_nonzero(end) == len(side["XMAX"])
    step = StaticStep(side["XMIN"], side["XMAX"], (1000.0, 0, 0))
    write_tetrahedra(filled, tmp_path / "own.inp", steel)
    step.add_to(tmp_path / "own.inp", of_beams=False)
    own = solve(tmp_path / "own.inp")[side["XMAX"], 0]
    # FreeCAD spreads the force over the face's area, our deck over its nodes.
    assert moved[end, 0].mean() == pytest.approx(own.mean(), rel=0.5)
    # A tube of the skin with a lattice in it is stiffer than the skin alone, softer than a bar.
    skin, whole = 14**2 - 10**2, 14**2
    assert 1000 * 16 / 210_000 / whole < moved[end, 0].mean() < 2 * 1000 * 16 / 210_000 / skin


@pytest.mark.slow
def test_what_has_no_analysis(doc, box, infill):
    with pytest.raises(VolfrepError, match="no model 'shells': choose beams or tetrahedra"):
        make_fem_analysis(doc, infill, "shells")
    with pytest.raises(VolfrepError, match="a mesh without struts"):
        make_fem_analysis(doc, box)
    before = len(doc.Objects)
    box.Length, box.Width, box.Height = 70, 70, 70
    doc.recompute()
    with pytest.raises(VolfrepError, match=r"limit is 3,000\): choose larger cells"):
        make_fem_analysis(doc, infill)
    assert len(doc.Objects) == before
