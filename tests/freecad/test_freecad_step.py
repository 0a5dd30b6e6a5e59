# SPDX-License-Identifier: LGPL-2.1-or-later
"""STEP files of ours, read by FreeCAD."""

import numpy as np
import Part
import pytest

from freecad_volfrep.engine import require_engine

require_engine()

from volfrep import LatticeSpec  # noqa: E402
from volfrep.io.write.step_faceted import write_step_faceted  # noqa: E402
from volfrep.io.write.step_wireframe import write_step_wireframe  # noqa: E402
from volfrep.jobs.blocks import block  # noqa: E402
from volfrep.jobs.pipeline import fill  # noqa: E402
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate  # noqa: E402


def read(path):
    shape = Part.Shape()
    shape.read(str(path))
    return shape


def cube(size, at=(0.0, 0.0, 0.0)):
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    faces = [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]  # fmt: skip
    return TriangleMesh(corners * size + np.array(at), np.array(faces, np.int32))


@pytest.mark.costly
def test_a_faceted_lattice(tmp_path):
    mesh = block(LatticeSpec("CVC", 10, 1, resolution=8), (1, 1, 1)).mesh
    write_step_faceted(mesh, tmp_path / "cell.step")
    shape = read(tmp_path / "cell.step")
    assert shape.ShapeType == "Solid"
    assert shape.isValid()
    assert shape.isClosed()
    assert len(shape.Faces) == len(mesh.triangles)
    assert shape.Volume == pytest.approx(mesh.volume, rel=1e-7)
    assert shape.Area == pytest.approx(mesh.area, rel=1e-7)


@pytest.mark.slow
def test_a_faceted_part_with_its_cavity(tmp_path):
    spec = LatticeSpec(cell="CVC", cell_size=10, strut_radius=1, shell=2, resolution=8)
    mesh = fill(cube(24.0), spec).mesh
    write_step_faceted(mesh, tmp_path / "part.step")
    shape = read(tmp_path / "part.step")
    assert len(shape.Solids) == 1
    assert len(shape.Shells) > 1
    assert shape.isValid()
    assert shape.Volume == pytest.approx(mesh.volume, rel=1e-6)


def test_several_faceted_bodies(tmp_path):
    mesh = concatenate(cube(10.0), cube(4.0, (3.0, 3.0, 3.0)).reversed(), cube(2.0, (20.0, 0, 0)))
    write_step_faceted(mesh, tmp_path / "bodies.step")
    solids = read(tmp_path / "bodies.step").Solids
    assert sorted(solid.Volume for solid in solids) == pytest.approx([8, 1000 - 64])
    assert all(solid.isValid() for solid in solids)


@pytest.mark.slow
def test_forty_thousand_facets(tmp_path):
    mesh = block(LatticeSpec(cell="Octet", cell_size=10, strut_radius=1), (2, 2, 2)).mesh
    assert len(mesh.triangles) > 30_000
    write_step_faceted(mesh, tmp_path / "block.step")
    shape = read(tmp_path / "block.step")
    assert shape.isValid()
    assert shape.isClosed()
    assert shape.Volume == pytest.approx(mesh.volume, rel=1e-7)


def test_axes(tmp_path):
    frame = block(LatticeSpec(cell="Octet", cell_size=10, strut_radius=1), (3, 2, 1)).wireframe
    write_step_wireframe(frame, tmp_path / "axes.step")
    shape = read(tmp_path / "axes.step")
    assert len(shape.Edges) == len(frame.struts)
    ends = frame.nodes[frame.struts]
    total = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
    assert shape.Length == pytest.approx(total, rel=1e-9)
