# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact surfaces: what FreeCAD and Gmsh read is one valid closed solid of the right volume."""

import dataclasses
import shutil
import subprocess
import time

import numpy as np
import Part
import pytest

from freecad_volfrep.engine import require_engine

require_engine()

from freecad_volfrep.bridge.exact import exact_lattice, write_exact  # noqa: E402
from volfrep import LatticeSpec  # noqa: E402
from volfrep.io.write.step_exact import predict_exact  # noqa: E402
from volfrep.jobs.blocks import block  # noqa: E402
from volfrep.util.errors import Cancelled, VolfrepError  # noqa: E402
from volfrep.util.progress import Monitor  # noqa: E402


def result(cell="CVC", count=(2, 1, 1), size=20.0, radius=2.0, resolution=32):
    spec = LatticeSpec(
        cell=cell, cell_size=size, strut_radius=radius, resolution=resolution, origin=(3, 5, -7)
    )
    return block(spec, count)


def read(path):
    shape = Part.Shape()
    shape.read(str(path))
    return shape


def check(shape, volume):
    assert shape.ShapeType == "Solid"
    assert shape.isValid()
    assert shape.isClosed()
    assert len(shape.Shells) == 1
    assert shape.Volume == pytest.approx(volume, rel=1e-5)


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize(
    "cell",
    ["Box", "CVC", "BCC", "Octet", "Octahedron"],
)
def test_a_block(cell, tmp_path):
    made = result(cell)
    volume = write_exact(made.wireframe, tmp_path / "block.step")
    shape = read(tmp_path / "block.step")
    check(shape, volume)
    assert volume == pytest.approx(made.report.volume_mm3, rel=1e-3)
    kinds = {face.Surface.TypeId for face in shape.Faces}
    assert kinds == {"Part::GeomCylinder", "Part::GeomSphere"} or cell == "Octet"
    assert shape.BoundBox.Center.isEqual(shape.Solids[0].CenterOfMass, 0.05)


@pytest.mark.slow
def test_a_block_of_the_cell_with_most_struts(tmp_path):
    made = result("FCC")
    check(exact_lattice(made.wireframe), write_exact(made.wireframe, tmp_path / "block.step"))


@pytest.mark.slow
def test_the_volume_of_the_papers_sample(tmp_path):
    """9500.11 mm3 by OpenCASCADE's fuse of everything at once; 9497 and 9501 by counting points."""
    spec = LatticeSpec(cell="CVC", cell_size=20, strut_radius=2, resolution=10)
    frame = block(spec, (3, 2, 1)).wireframe
    assert write_exact(frame, tmp_path / "sample.step") == pytest.approx(9500.11, abs=0.02)
    shape = read(tmp_path / "sample.step")
    check(shape, 9500.11)
    assert len(shape.Faces) == 120
    assert (tmp_path / "sample.step").stat().st_size < 0.25e6


@pytest.mark.slow
def test_cones_of_random_radii(tmp_path):
    frame = result("CVC", (1, 1, 1)).wireframe
    radius = np.random.default_rng(1).uniform(1.2, 2.2, len(frame.nodes))
    graded = dataclasses.replace(
        frame, radii=radius[frame.struts], joint_radii=radius * (1 + radius / 20)
    )
    volume = write_exact(graded, tmp_path / "graded.step")
    check(read(tmp_path / "graded.step"), volume)
    assert volume == pytest.approx(sampled_volume(graded), rel=5e-3)


def sampled_volume(frame):
    """Points counted in a box about the lattice, one at random in each of 80^3 parts of it."""
    rng = np.random.default_rng(0)
    low, high = frame.nodes.min(axis=0) - 3, frame.nodes.max(axis=0) + 3
    parts = np.indices((80, 80, 80)).reshape(3, -1).T
    points = low + (parts + rng.random(parts.shape)) / 80 * (high - low)
    inside = np.zeros(len(points), bool)
    for (a, b), (ra, rb) in zip(frame.nodes[frame.struts], frame.radii, strict=True):
        share = (points - a) @ (b - a) / ((b - a) @ (b - a))
        off = np.linalg.norm(points - a - share[:, None] * (b - a), axis=1)
        inside |= (share >= 0) & (share <= 1) & (off <= ra + share * (rb - ra))
    for node, ball in zip(frame.nodes, frame.joint_radii, strict=True):
        inside |= ((points - node) ** 2).sum(axis=1) <= ball**2
    return inside.mean() * np.prod(high - low)


@pytest.mark.slow
def test_pieces_that_do_not_touch_are_solids_of_their_own():
    frame = result("CVC", (1, 1, 1)).wireframe
    two = dataclasses.replace(
        frame,
        nodes=np.concatenate([frame.nodes, frame.nodes + np.array([100, 0, 0])]),
        struts=np.concatenate([frame.struts, frame.struts + len(frame.nodes)]),
        radii=np.tile(frame.radii, (2, 1)),
        joint_radii=np.tile(frame.joint_radii, 2),
    )
    one, both = exact_lattice(frame), exact_lattice(two)
    assert [solid.Volume for solid in both.Solids] == pytest.approx([one.Volume] * 2)


@pytest.mark.costly
def test_what_cannot_be_exact(tmp_path):
    frame = result("BCC", (1, 1, 1)).wireframe
    # As far as their middles: edges and diagonals are 55 degrees apart.
    thick = dataclasses.replace(frame, radii=frame.radii * 2.4, joint_radii=frame.joint_radii * 2.5)
    with pytest.raises(VolfrepError, match="faceted"):
        write_exact(thick, tmp_path / "thick.step")
    none = dataclasses.replace(frame, struts=frame.struts[:0], radii=frame.radii[:0])
    with pytest.raises(VolfrepError, match="no struts"):
        write_exact(none, tmp_path / "none.step")
    with pytest.raises(VolfrepError, match="no folder"):
        write_exact(frame, tmp_path / "nowhere" / "x.step")
    with pytest.raises(Cancelled):
        write_exact(frame, tmp_path / "x.step", Monitor(lambda *_: False))
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not installed")
def test_gmsh_meshes_it(tmp_path):
    frame = result("CVC", (1, 1, 1)).wireframe
    write_exact(frame, tmp_path / "cell.step")
    done = subprocess.run(
        ["gmsh", "cell.step", "-3", "-clmax", "1.5", "-o", "cell.msh"],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0
    assert "Error" not in done.stdout
    assert (tmp_path / "cell.msh").is_file()


@pytest.mark.slow
def test_616_cells(tmp_path):
    spec = LatticeSpec(cell="CVC", cell_size=20, strut_radius=2, resolution=10)
    frame = block(spec, (11, 8, 7)).wireframe
    prediction = predict_exact(frame)
    start = time.process_time()
    volume = write_exact(frame, tmp_path / "block.step")
    assert time.process_time() - start < 15
    assert prediction.kinds == 27
    size = (tmp_path / "block.step").stat().st_size / 1e6
    assert size == pytest.approx(prediction.megabytes, rel=0.15)
    assert size < 25
    shape = read(tmp_path / "block.step")
    check(shape, volume)
    assert len(shape.Faces) == 10_354
