# SPDX-License-Identifier: LGPL-2.1-or-later
"""3MF files, as lib3mf (the reference implementation) reads them."""

import json
import os
import shutil
import zipfile
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest

import samples
from exact import DENSITY
from volfrep import LatticeSpec
from volfrep.cli import command as cli
from volfrep.grid.strut_graph import Wireframe
from volfrep.io.write.threemf import write_3mf, write_3mf_beams
from volfrep.jobs.beam_part import beam_model, block_beams
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.output.meshes import write_mesh
from volfrep.trim.beam_model import BeamModel
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.progress import Monitor

lib3mf = pytest.importorskip("lib3mf", reason="lib3mf, which reads the files back, is missing")

SPEC = LatticeSpec(cell="CVC", cell_size=10, strut_radius=1, shell=2)


def read(path):
    """The model as lib3mf reads it: its objects by name, and the one that is built."""
    wrapper = lib3mf.get_wrapper()
    model = wrapper.CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    assert reader.GetWarningCount() == 0
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    objects, numbers = {}, {}
    meshes = model.GetMeshObjects()
    while meshes.MoveNext():
        mesh = meshes.GetCurrentMeshObject()
        objects[mesh.GetName()] = contents(mesh)
        numbers[mesh.GetName()] = mesh.GetUniqueResourceID()
    items = model.GetBuildItems()
    assert items.MoveNext()
    built = items.GetCurrent().GetObjectResource()
    assert not items.MoveNext()
    names = [built.GetName()]
    if built.IsComponentsObject():
        parts = model.GetComponentsObjectByID(built.GetUniqueResourceID())
        names = [
            parts.GetComponent(k).GetObjectResource().GetName()
            for k in range(parts.GetComponentCount())
        ]
    group = model.GetMetaDataGroup()
    metadata = {
        entry.GetName(): entry.GetValue()
        for entry in map(group.GetMetaData, range(group.GetMetaDataCount()))
    }
    return SimpleNamespace(objects=objects, numbers=numbers, built=names, metadata=metadata)


def contents(mesh):
    lattice = mesh.BeamLattice()
    beams = lattice.GetBeams()
    balls = lattice.GetBalls() if lattice.GetBallCount() else []
    vertices = np.array([tuple(p.Coordinates) for p in mesh.GetVertices()], float)
    triangles = np.array([tuple(t.Indices) for t in mesh.GetTriangleIndices()], np.int32)
    return SimpleNamespace(
        mesh=TriangleMesh(vertices.reshape(-1, 3), triangles.reshape(-1, 3)),
        ends=np.array([tuple(b.Indices) for b in beams], int).reshape(-1, 2),
        radii=np.array([tuple(b.Radii) for b in beams]).reshape(-1, 2),
        ball_at=np.array([b.Index for b in balls], int),
        ball_radius=np.array([b.Radius for b in balls]),
        clipping=lattice.GetClipping(),
    )


def in_beams(points, lattice):
    """Whether points lie in the cones and balls that were read."""
    inside = np.zeros(len(points), bool)
    nodes = lattice.mesh.vertices
    for (a, b), (ra, rb) in zip(lattice.ends, lattice.radii, strict=True):
        p, along = nodes[a], nodes[b] - nodes[a]
        share = (points - p) @ along / (along @ along)
        gap = np.linalg.norm(points - p - share[:, None] * along, axis=1)
        inside |= (share >= 0) & (share <= 1) & (gap <= ra + share * (rb - ra))
    for at, radius in zip(lattice.ball_at, lattice.ball_radius, strict=True):
        inside |= np.linalg.norm(points - nodes[at], axis=1) <= radius
    return inside


def random_points(low, high, count=60_000):
    return np.random.default_rng(0).uniform(low, high, (count, 3))


# --- meshes -------------------------------------------------------------------------------------


def test_a_mesh_comes_back(tmp_path: Path):
    mesh = block(LatticeSpec(cell="Octet", cell_size=10, strut_radius=1), (2, 1, 1)).mesh
    write_mesh(mesh, tmp_path / "block & <co>.3mf")
    model = read(tmp_path / "block & <co>.3mf")
    assert model.built == ["part"]
    assert model.metadata["Title"] == "block & <co>"
    assert model.metadata["Application"].startswith("VOLFREP ")
    back = model.objects["part"].mesh
    np.testing.assert_array_equal(back.triangles, mesh.triangles)
    np.testing.assert_allclose(back.vertices, mesh.vertices, atol=2e-6)
    found, expected = measure(back), measure(mesh)
    assert found.watertight
    assert (found.bodies, found.genus) == (expected.bodies, expected.genus)
    assert found.degenerate_triangles == 0


def test_the_same_mesh_makes_the_same_compressed_file(tmp_path: Path):
    mesh = samples.sphere(10.0, 4)
    for name in ("one/ball.3mf", "two/ball.3mf"):
        (tmp_path / name).parent.mkdir()
        write_3mf(mesh, tmp_path / name)
    data = (tmp_path / "one/ball.3mf").read_bytes()
    assert data == (tmp_path / "two/ball.3mf").read_bytes()
    with zipfile.ZipFile(tmp_path / "one/ball.3mf") as package:
        assert package.testzip() is None
        assert all(part.compress_type == zipfile.ZIP_DEFLATED for part in package.infolist())
    assert len(data) < 50 * len(mesh.triangles) / 3


def test_many_blocks_of_lines_are_one_file(tmp_path: Path, monkeypatch):
    write_3mf(samples.sphere(10.0, 3), tmp_path / "a.3mf")
    monkeypatch.setattr("volfrep.mesh.precision.BLOCK_ROWS", 100)
    write_3mf(samples.sphere(10.0, 3), tmp_path / "b.3mf")
    one, two = (read(tmp_path / name).objects["part"].mesh for name in ("a.3mf", "b.3mf"))
    np.testing.assert_array_equal(one.vertices, two.vertices)
    np.testing.assert_array_equal(one.triangles, two.triangles)


def test_what_cannot_be_written_leaves_nothing(tmp_path: Path):
    far = samples.sphere(10.0, 4)
    far = TriangleMesh(far.vertices + 1e8, far.triangles)
    with pytest.raises(VolfrepError, match="nearer to the origin"):
        write_3mf(far, tmp_path / "far.3mf")
    none = Wireframe(np.zeros((0, 3)), np.zeros((0, 2), np.int32), np.zeros((0, 2)), np.zeros(0))
    with pytest.raises(VolfrepError, match="no struts"):
        write_3mf_beams(BeamModel(none), tmp_path / "none.3mf")
    with pytest.raises(Cancelled):
        write_3mf(samples.sphere(), tmp_path / "x.3mf", Monitor(lambda fraction, stage: False))
    assert os.listdir(tmp_path) == []


def test_an_odd_name_is_no_trouble(tmp_path: Path):
    path = tmp_path / os.fsdecode(b"\xff\x01 caf\xc3\xa9.3mf")
    write_3mf(samples.sphere(10.0, 1), path)
    plain = shutil.copy(path, tmp_path / "plain.3mf")
    assert read(plain).metadata["Title"] == " café"


# --- beams --------------------------------------------------------------------------------------


def test_beams_are_the_lattice(tmp_path: Path):
    write_3mf_beams(block_beams(SPEC, (2, 2, 2)), tmp_path / "block.3mf")
    model = read(tmp_path / "block.3mf")
    assert model.built == ["lattice"]
    lattice = model.objects["lattice"]
    assert len(lattice.mesh.triangles) == 0
    assert len(lattice.ends) == 8 * 8
    assert (lattice.radii == 1).all()
    assert sorted(lattice.ball_at) == list(range(27 + 8))
    assert (lattice.ball_radius == 1.1).all()
    # An endless lattice's share of its own cells, within the noise of 60,000 points.
    a, b = DENSITY["CVC"]
    share = in_beams(random_points(0, 20), lattice).mean()
    assert share == pytest.approx(a * 0.1**2 - b * 0.1**3, rel=0.03)


def test_cones_and_joints_of_their_own_keep_their_radii(tmp_path: Path):
    nodes = np.array([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 0, 1.23456]], float)
    struts = np.array([[0, 1], [1, 2], [2, 0], [0, 3]], np.int32)
    radii = np.array([[1, 1], [1, 1], [2, 0.5], [0.25, 0.25]])
    joints = np.array([1.5, 1.5, 2.5, 1.5])
    write_3mf_beams(BeamModel(Wireframe(nodes, struts, radii, joints)), tmp_path / "x.3mf")
    lattice = read(tmp_path / "x.3mf").objects["lattice"]
    found = {tuple(e): tuple(r) for e, r in zip(lattice.ends, lattice.radii, strict=True)}
    assert found == {(0, 1): (1, 1), (1, 2): (1, 1), (2, 0): (2, 0.5), (0, 3): (0.25, 0.25)}
    balls = dict(zip(lattice.ball_at.tolist(), lattice.ball_radius.tolist(), strict=True))
    assert balls == {0: 1.5, 1: 1.5, 2: 2.5, 3: 1.5}
    np.testing.assert_allclose(lattice.mesh.vertices, nodes, atol=2e-5)


@pytest.mark.costly
def test_a_part_is_its_skin_and_its_clipped_beams(tmp_path: Path):
    solid = samples.box((40, 30, 20))
    write_3mf_beams(beam_model(solid, SPEC), tmp_path / "part.3mf")
    model = read(tmp_path / "part.3mf")
    assert model.built == ["skin", "lattice"]
    lattice = model.objects["lattice"]
    assert lattice.clipping == (lib3mf.BeamLatticeClipMode.Inside, model.numbers["clip"])
    np.testing.assert_array_equal(model.objects["clip"].mesh.vertices, solid.vertices)
    points = random_points((0, 0, 0), (40, 30, 20))
    in_skin = ((points < 2) | (points > np.array([38, 28, 18]))).any(axis=1)
    volume = (in_skin | in_beams(points, lattice)).mean() * solid.volume
    assert volume == pytest.approx(fill(solid, SPEC).report.volume_mm3, rel=0.01)
    assert measure(model.objects["skin"].mesh).volume == pytest.approx(
        24000 - 36 * 26 * 16, rel=1e-3
    )


@pytest.mark.slow
def test_with_a_fallback_the_object_is_the_part_twice(tmp_path: Path):
    solid = samples.box((40, 30, 20))
    part = fill(solid, SPEC).mesh
    write_3mf_beams(beam_model(solid, SPEC), tmp_path / "both.3mf", part)
    model = read(tmp_path / "both.3mf")
    assert model.built == ["lattice"]
    assert model.objects.keys() == {"clip", "lattice"}
    both = model.objects["lattice"]
    assert both.clipping == (lib3mf.BeamLatticeClipMode.Inside, model.numbers["clip"])
    found = measure(both.mesh)
    assert found.watertight
    assert found.volume == pytest.approx(part.volume, rel=1e-6)
    assert found.triangles == len(part.triangles)
    assert len(both.ends) == len(beam_model(solid, SPEC).lattice.struts)


@pytest.mark.slow
def test_a_file_of_both_is_checked_by_our_own_command(tmp_path: Path, capsys):
    solid = samples.box((40, 30, 20))
    part = fill(solid, SPEC)
    write_3mf_beams(beam_model(solid, SPEC), tmp_path / "both.3mf", part.mesh)
    assert cli.run(["check", str(tmp_path / "both.3mf")]) == 0
    assert f"{part.report.volume_mm3:,.3f} mm3" in capsys.readouterr().out


def test_the_figures_of_the_run_are_metadata(tmp_path: Path):
    solid = samples.box((40, 30, 20))
    report = fill(solid, SPEC).report
    write_mesh(samples.box(), tmp_path / "part.3mf", figures=report.figures)
    kept = read(tmp_path / "part.3mf").metadata
    assert f"{report.cells_active:,} cells" in kept["Description"]
    own = {name.rpartition(":")[2]: text for name, text in kept.items()}
    assert own["Struts"] == str(report.struts)
    assert float(own["VolumeMm3"]) == pytest.approx(report.volume_mm3, rel=1e-5)
    assert json.loads(own["Specification"]) == json.loads(json.dumps(report.spec))
    again = fill(solid, SPEC).report
    assert again.figures == report.figures  # no times: the same part makes the same file


def test_the_extensions_are_asked_for(tmp_path: Path):
    write_3mf_beams(block_beams(SPEC, (1, 1, 1)), tmp_path / "beams.3mf")
    write_3mf(samples.sphere(10.0, 1), tmp_path / "mesh.3mf")
    roots = {}
    for name in ("beams", "mesh"):
        with zipfile.ZipFile(tmp_path / f"{name}.3mf") as package:
            roots[name] = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    assert roots["beams"].get("requiredextensions") == "b b2"
    assert roots["mesh"].get("requiredextensions") is None


def test_17576_cells_are_small_and_quick(tmp_path: Path):
    import time

    start = time.process_time()
    write_3mf_beams(block_beams(SPEC, (26, 26, 26)), tmp_path / "block.3mf")
    assert time.process_time() - start < 2.0  # 0.2 s on an idle machine
    assert (tmp_path / "block.3mf").stat().st_size < 1e6
    wrapper = lib3mf.get_wrapper()
    model = wrapper.CreateModel()
    model.QueryReader("3mf").ReadFromFile(str(tmp_path / "block.3mf"))
    meshes = model.GetMeshObjects()
    assert meshes.MoveNext()
    lattice = meshes.GetCurrentMeshObject().BeamLattice()
    assert lattice.GetBeamCount() == 8 * 17576
    assert lattice.GetBallCount() == 27**3 + 26**3
