# SPDX-License-Identifier: LGPL-2.1-or-later
"""A skinned box with its lattice: struts and shells against second-order tetrahedra of its mesh."""

import contextlib
import shutil
from pathlib import Path

import numpy as np
import pytest
import trimesh

from bench.static_step import StaticStep
from volfrep import LatticeSpec
from volfrep.fem.calculix import solve
from volfrep.fem.deck import write_tetrahedra
from volfrep.fem.tet_mesh import TetrahedralMesh, filled_by_gmsh
from volfrep.io.solid import check_solid
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, size
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.booleans import as_manifold, as_mesh
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError

LENGTH, FORCE = 30.0, (0.0, 0.0, -200.0)
#: No triangle's edge is longer, so that tetrahedra bend with the skin, mm; where Gmsh takes that.
FINE = 2.2

needs_both = pytest.mark.skipif(
    shutil.which("ccx") is None or shutil.which("gmsh") is None,
    reason="CalculiX (ccx) or Gmsh is not installed",
)


def shares_of_face(filled: TetrahedralMesh, x: float) -> np.ndarray:
    """(n,) each node's part of a traction on the face at x: the middles of edges have all of it."""
    corners = [[0, 1, 2, 4, 5, 6], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [0, 2, 3, 6, 9, 7]]
    faces = filled.elements[:, corners].reshape(-1, 6)
    faces = faces[(np.abs(filled.nodes[faces, 0] - x) < 1e-5).all(axis=1)]
    a, b, c = filled.nodes[faces[:, :3]].swapaxes(0, 1)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
    weight = np.bincount(faces[:, 3:].ravel(), np.repeat(area / 3.0, 3), len(filled.nodes))
    return weight / weight.sum()


def filled_with(mesh: TriangleMesh) -> TetrahedralMesh:
    """Tetrahedra of a mesh with fewer facets; Gmsh does not take each of its simplifications."""
    for tolerance, length in ((0.03, FINE), (0.01, 3.0), (0.015, 2.5), (0.025, 2.5), (0.03, 3.0)):
        body = as_manifold(mesh).simplify(tolerance)
        with contextlib.suppress(VolfrepError):
            return filled_by_gmsh(as_mesh(body.refine_to_length(length)))
    raise AssertionError("Gmsh takes none of them")


@needs_both
@pytest.mark.slow
def test_a_skinned_box_bends_as_its_tetrahedra_do(tmp_path: Path) -> None:
    shape = trimesh.creation.box((LENGTH, 20, 20))
    shape.apply_translation((LENGTH / 2, 10, 10))
    solid = check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "box")
    spec = LatticeSpec("CVC", cell_size=10, strut_radius=0.8, shell=1, resolution=13)
    material = find_material("Ti-6Al-4V")
    wall, tip = (InPlane((x, 0, 0), (1, 0, 0)) for x in (0.0, LENGTH))
    case = LoadCase("down", (Support(wall),), (Force(tip, FORCE),))
    made = size(solid, spec, LoadCases(material, (case,)), Goal(), most_steps=1, prove_it=False)
    ours = made.before.compliance[0]

    filled = filled_with(Infill(solid, spec).part.mesh)
    shares = shares_of_face(filled, LENGTH)
    loaded = np.flatnonzero(shares)
    held = np.flatnonzero(filled.nodes[:, 0] < 1e-5)
    deck = tmp_path / "solid.inp"
    step = StaticStep(held, loaded, FORCE, shares[loaded])
    write_tetrahedra(filled, deck, material.for_solver())
    step.add_to(deck, of_beams=False)
    theirs = float(shares @ solve(deck) @ np.array(FORCE))
    assert ours == pytest.approx(theirs, rel=0.05)
