# SPDX-License-Identifier: LGPL-2.1-or-later
"""A finite-element analysis of a lattice infill in FreeCAD's FEM workbench, without constraints.

FreeCAD 0.20 finds elements of a section, a material or a constraint by the geometry they lie on.
So the beams come with the edges they lie on and the vertices of their joints, and tetrahedra with
the base's faces, whose tolerance is raised to the mesh's deviation.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import numpy as np
from numpy.typing import NDArray

from freecad_volfrep.features.infill.materials import for_solver
from freecad_volfrep.features.jobs.progress import all_or_nothing, go_through, job_title
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError, listed

from .exact import inputs_of, warn
from .solver_files import beams_of, estimate_file, tetrahedra_of

if TYPE_CHECKING:
    from volfrep.fem.beam_mesh import BeamMesh
    from volfrep.fem.tet_mesh import TetrahedralMesh
    from volfrep.mechanics.materials import Material

MODELS = ("beams", "tetrahedra")
#: Three-noded elements along a strut between its stiff ends: with fewer CalculiX's are too stiff.
ELEMENTS_PER_STRUT = 6
#: FreeCAD looks at every element for every edge, in Python: 1,800 edges take it 45 s to write and
#: solve, and the time goes with their square.
MOST_EDGES = 3_000
#: Nodes this near to a face of the base lie on it, mm: the largest deviation of its facets, and a
#: little for their rounding.
FACE_TOLERANCE = 0.11
CUT_FACES = (
    "FreeCAD spreads a force over the whole area of a face, and a lattice that is cut there gets "
    "the share of its ends only: enlarge the force by the ratio of the areas."
)


def make_fem_analysis(
    doc: App.Document,
    obj: App.DocumentObject,
    model: str = "beams",
    material: Material | None = None,
) -> App.DocumentObject:
    """Add an analysis of the infill, ready for constraints, loads and the solver.

    It holds a CalculiX solver, the material, the mesh and, for beams, a circular section for each
    radius and a second material for the stiff ends. Beside it are the shapes that constraints
    refer to: of beams ``Joints`` (a vertex each) and ``SkinJoints`` (those that the skin holds),
    of tetrahedra ``Boundary`` (the base's faces). It stays as it is when the lattice changes.

    Args:
        doc: the document to add it to.
        obj: a lattice infill.
        model: ``beams`` or ``tetrahedra`` (for small lattices).
        material: linear elastic; None for the infill's, or PETG of its density.

    Raises:
        VolfrepError: there is no such model, the lattice is too large for it, or it is no
            lattice infill.
        Cancelled: in the window, by the user; nothing is added.
    """
    if model not in MODELS:
        raise VolfrepError(f"There is no model '{model}': choose {listed(MODELS)}.")
    inputs_of(obj)
    material = material or for_solver(obj)
    return (_beams if model == "beams" else _tetrahedra)(doc, obj, material)


def estimate_analysis(obj: App.DocumentObject, model: str) -> str:
    """What the analysis will take, as a sentence without its full stop.

    Raises:
        VolfrepError: too much; the text names the nearest setting that fits.
    """
    return estimate_file(obj, "beam deck" if model == "beams" else "tetrahedra")


def vertices(shape: App.DocumentObject) -> tuple[App.DocumentObject, list[str]]:
    """All the vertices of an object, as a constraint's References want them."""
    return shape, [f"Vertex{k + 1}" for k in range(len(shape.Shape.Vertexes))]


def _beams(doc: App.Document, obj: App.DocumentObject, material: Material) -> Any:
    model, on_boundary = beams_of(obj, section="circle", elements_per_strut=ELEMENTS_PER_STRUT)
    with all_or_nothing(doc):
        return go_through(_title(obj), _beam_steps(doc, obj, material, model, on_boundary))


def _beam_steps(
    doc: App.Document,
    obj: App.DocumentObject,
    material: Material,
    model: BeamMesh,
    on_boundary: NDArray[np.bool_],
) -> Generator[float, None, Any]:
    """The analysis of beams: the share that is done after each step, and the analysis."""
    from freecad_volfrep.bridge.fem_meshes import beam_mesh, points_shape, runs_of
    from volfrep.fem.deck import sides, stiff_materials, width_of_ends

    runs = runs_of(model)
    if len(runs.section) > MOST_EDGES:
        raise VolfrepError(
            f"FreeCAD's FEM workbench would look for the elements of {len(runs.section):,} edges, "
            f"for minutes (the limit is {MOST_EDGES:,}): choose larger cells, or export the "
            "lattice as beams for CalculiX."
        )
    joints = model.nodes[: model.joints]
    on_skin = np.flatnonzero(on_boundary)
    sets = {"SKIN": on_skin, "JOINTS": np.arange(len(joints)), **sides(joints)}
    mesh = yield from beam_mesh(model, sets)

    analysis = _analysis(doc, obj)
    yield 1.0
    axes = _shape(doc, obj, "Axes", runs.shape)
    yield 1.0
    _shape(doc, obj, "Joints", points_shape(joints))
    yield 1.0
    if len(on_skin):
        _shape(doc, obj, "SkinJoints", points_shape(joints[on_skin]))
        yield 1.0
    _material(analysis, material, 1.0, material.name, [])
    stiffened = stiff_materials(model, material.name)
    used = np.array([name for name, _ in stiffened])[runs.section]
    for name, factor in dict.fromkeys(stiffened):
        chosen = runs.is_joint & (used == name)
        if chosen.any():
            _material(analysis, material, factor, name, [(axes, _edges(chosen))])
            yield 1.0
    wide = np.array([width_of_ends(ends) for ends in model.ends])
    radius = model.radii[runs.section] * np.where(runs.is_joint, wide[runs.section], 1.0)
    for value in np.unique(radius).tolist():
        chosen = radius == value
        _section(analysis, value, [] if chosen.all() else [(axes, _edges(chosen))])
        yield 1.0
    _mesh(analysis, mesh, axes)
    yield 1.0
    doc.recompute()
    return analysis


def _tetrahedra(doc: App.Document, obj: App.DocumentObject, material: Material) -> Any:
    filled = tetrahedra_of(obj)
    with all_or_nothing(doc):
        return go_through(_title(obj), _tetrahedral_steps(doc, obj, material, filled))


def _tetrahedral_steps(
    doc: App.Document, obj: App.DocumentObject, material: Material, filled: TetrahedralMesh
) -> Generator[float, None, Any]:
    """The analysis of tetrahedra: the share that is done after each step, and the analysis."""
    import Part

    from freecad_volfrep.bridge.beams import place_in_document
    from freecad_volfrep.bridge.fem_meshes import tetrahedral_mesh
    from freecad_volfrep.bridge.solids import (
        parent_placement,
        placed,
        resolve_base,
    )
    from volfrep.fem.deck import sides
    from volfrep.fem.tet_mesh import nodes_on

    solid, spec, _ = inputs_of(obj)
    solid = placed(solid, place_in_document(obj))
    sets = {"SKIN": nodes_on(filled, solid), **sides(filled.nodes)}
    mesh = yield from tetrahedral_mesh(filled, sets)
    base = resolve_base(obj.Base)
    shape = Part.getShape(base)
    analysis = _analysis(doc, obj)
    yield 1.0
    boundary = None
    if not shape.isNull() and shape.Faces:
        shape = shape.copy()
        # From where the base lies to where the infill shows.
        own = parent_placement(obj).inverse().multiply(parent_placement(base))
        shape.Placement = place_in_document(obj).multiply(own).multiply(shape.Placement)
        shape.fixTolerance(FACE_TOLERANCE)
        boundary = _shape(doc, obj, "Boundary", shape)
        if spec.output == "lattice" or spec.shell == 0:
            warn(obj, (CUT_FACES,))
        yield 1.0
    _material(analysis, material, 1.0, material.name, [])
    _mesh(analysis, mesh, boundary)
    yield 1.0
    doc.recompute()
    return analysis


def _title(obj: App.DocumentObject) -> str:
    return job_title("FEM analysis of {label}", obj)


def _analysis(doc: App.Document, obj: App.DocumentObject) -> App.DocumentObject:
    import ObjectsFem

    analysis = ObjectsFem.makeAnalysis(doc, f"{obj.Name}Analysis")
    analysis.Label = translate("VolfrepLabels", "{label} analysis").format(label=obj.Label)
    # FreeCAD 1.1 spells it anew.
    make = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None)
    make = make or ObjectsFem.makeSolverCalculixCcxTools
    analysis.addObject(make(doc, "CalculiX"))
    return analysis


def _shape(doc: App.Document, obj: App.DocumentObject, name: str, shape: Any) -> Any:
    feature = doc.addObject("Part::Feature", name)
    feature.Label = f"{obj.Label} {name}"
    feature.Shape = shape
    return feature


def _material(
    analysis: App.DocumentObject,
    material: Material,
    factor: float,
    name: str,
    references: list[Any],
) -> None:
    import ObjectsFem

    made = ObjectsFem.makeMaterialSolid(analysis.Document, name)
    made.Material = {
        **made.Material,
        "Name": name,
        "YoungsModulus": f"{factor * material.young!r} MPa",
        "PoissonRatio": repr(material.poisson),
        "Density": f"{1000.0 * material.density!r} kg/m^3",
    }
    made.References = references
    analysis.addObject(made)


def _section(analysis: App.DocumentObject, radius: float, references: list[Any]) -> None:
    import ObjectsFem

    made = ObjectsFem.makeElementGeometry1D(analysis.Document, "Circular", name="Section")
    made.Label = f"Section of radius {radius:.4g} mm"
    made.CircDiameter = f"{2.0 * radius!r} mm"
    made.References = references
    analysis.addObject(made)


def _mesh(analysis: App.DocumentObject, mesh: Any, geometry: App.DocumentObject | None) -> None:
    made = analysis.Document.addObject("Fem::FemMeshObject", "Mesh")
    made.FemMesh = mesh
    if geometry is not None:
        # Where FreeCAD's writer for CalculiX looks for the geometry of a mesh.
        made.addProperty("App::PropertyLink", "Part", "FEM Mesh", "Geometry that the mesh is of")
        made.Part = geometry
    analysis.addObject(made)


def _edges(chosen: np.ndarray) -> list[str]:
    return [f"Edge{k + 1}" for k in np.flatnonzero(chosen)]
