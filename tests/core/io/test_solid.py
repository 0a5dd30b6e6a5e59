# SPDX-License-Identifier: LGPL-2.1-or-later
import re
import struct

import numpy as np
import pytest
import trimesh

import samples
from bench.parts import NO_PARTS, PARTS
from volfrep.io.solid import check_solid, read_solid
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.util.errors import VolfrepError

needs_parts = pytest.mark.skipif(not PARTS.is_dir(), reason=NO_PARTS)
#: Its three shells overlap: united, it is smaller than the sum that the table prints.
OVERLAPPING = "conrod_slevin48.stl"


def as_trimesh(mesh):
    return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)


def soup(mesh):
    """Every triangle with corners of its own, in another order."""
    order = np.random.default_rng(4).permutation(len(mesh.triangles))
    corners = mesh.vertices[mesh.triangles[order]].reshape(-1, 3)
    return TriangleMesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))


@pytest.mark.parametrize("kind", ["stl", "stl_ascii", "obj", "ply"])
def test_files_of_every_kind_give_the_same_solid(tmp_path, kind):
    part = samples.plate(48)
    path = tmp_path / f"plate.{kind[:3]}"
    data = as_trimesh(part).export(file_type=kind)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    solid = read_solid(path)
    assert solid.volume == pytest.approx(part.volume, rel=1e-6)
    assert len(solid.triangles) == len(part.triangles)
    assert len(solid.vertices) == len(part.vertices)
    assert solid.triangles.dtype == np.int32
    assert solid.vertices.dtype == np.float64


@needs_parts
def test_every_real_part_loads_with_its_volume():
    table = (PARTS / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"\| `([^`]+\.stl)` \|.*?\|.*?\| ([\d.]+) \|", table, re.IGNORECASE)
    assert len(rows) >= 10
    for name, volume in rows:
        solid = read_solid(PARTS / name)
        tolerance = 2e-4 if name == OVERLAPPING else 1e-6
        assert solid.volume == pytest.approx(float(volume), rel=tolerance), name
        assert as_trimesh(solid).is_watertight, name


@needs_parts
def test_overlapping_shells_of_a_real_part_are_united():
    solid = read_solid(PARTS / OVERLAPPING)
    assert as_trimesh(solid).body_count == 1


def test_other_kinds_of_files_are_explained():
    with pytest.raises(VolfrepError, match="open it in FreeCAD"):
        read_solid("part.FCStd")
    with pytest.raises(VolfrepError, match="OBJ, PLY, 3MF, OFF, GLB, STEP, IGES or BREP"):
        read_solid("part.docx")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(VolfrepError, match=r"nowhere\.stl"):
        read_solid(tmp_path / "nowhere.stl")


def good_stl():
    return as_trimesh(samples.box()).export(file_type="stl")


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "is empty"),
        (b"   \n", "is empty"),
        (b"no mesh at all", "not an STL"),
        (good_stl()[:-60], "cut short"),
        (good_stl()[:84], "cut short"),
        (good_stl()[:80] + struct.pack("<I", 0), "no triangles"),
        (good_stl()[:80] + struct.pack("<I", 4_000_000_000) + good_stl()[84:], "cut short"),
        (good_stl()[:96] + struct.pack("<f", np.nan) + good_stl()[100:], "not a number"),
        (b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1", "endsolid"),
        (b"solid x\nendsolid x\n", "no triangles"),
        (
            b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 zero\n"
            b"vertex 0 1 0\nendloop\nendfacet\nendsolid x\n",
            "not a number",
        ),
    ],
)
def test_damaged_stl_files_are_refused(tmp_path, content, says):
    path = tmp_path / "part.stl"
    path.write_bytes(content)
    with pytest.raises(VolfrepError, match=says) as error:
        read_solid(path)
    assert "part.stl" in str(error.value)


@pytest.mark.parametrize(
    ("suffix", "content"),
    [
        (".ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 8\n"),
        (".ply", b"not a ply"),
        (".obj", b"v 0 0 0\nv 1 0 0\nf 1 2 9\n"),
        (".obj", b"hello"),
    ],
)
def test_damaged_other_files_are_refused(tmp_path, suffix, content):
    path = tmp_path / f"part{suffix}"
    path.write_bytes(content)
    with pytest.raises(VolfrepError, match="part"):
        read_solid(path)


def test_a_large_hole_is_located():
    part = samples.box()
    with pytest.raises(VolfrepError, match=r"not closed: 3 edges.*\(.*too large to be closed"):
        check_solid(TriangleMesh(part.vertices, part.triangles[np.arange(12) != 1]), "box")


def test_triangles_that_enclose_nothing_are_refused():
    part = samples.box()
    flat = TriangleMesh(part.vertices * [1.0, 1.0, 0.0], part.triangles)
    with pytest.raises(VolfrepError):
        check_solid(flat, "flat")


def test_loose_corners_are_welded_and_the_winding_is_mended():
    part = samples.plate(24)
    turned = part.triangles.copy()
    turned[::3] = turned[::3, ::-1]
    for mesh in (
        soup(part),
        part.reversed(),
        TriangleMesh(part.vertices, turned),
        soup(TriangleMesh(part.vertices, turned)),
    ):
        assert check_solid(mesh, "plate").volume == pytest.approx(part.volume, rel=1e-12)


def test_repeated_and_degenerate_triangles_are_dropped():
    part = samples.box()
    more = np.concatenate([part.triangles, part.triangles[:4], [[0, 0, 1], [2, 3, 2]]])
    solid = check_solid(TriangleMesh(part.vertices, more.astype(np.int32)), "box")
    assert len(solid.triangles) == len(part.triangles)


def test_vertices_written_with_different_rounding_are_welded():
    part = samples.plate(24)
    loose = soup(part)
    noise = np.random.default_rng(6).uniform(-5e-6, 5e-6, loose.vertices.shape)
    solid = check_solid(TriangleMesh(loose.vertices + noise, loose.triangles), "plate")
    assert len(solid.vertices) == len(part.vertices)
    assert solid.volume == pytest.approx(part.volume, rel=1e-5)


@pytest.mark.parametrize("scramble", [False, True])
def test_a_cavity_stays_a_cavity(scramble):
    cavity = samples.box((10.0, 10.0, 10.0), (5.0, 5.0, 5.0)).reversed()
    hollow = concatenate(samples.box(), cavity)
    if scramble:
        turned = hollow.triangles.copy()
        turned[::2] = turned[::2, ::-1]
        hollow = TriangleMesh(hollow.vertices, turned)
    assert check_solid(hollow, "hollow").volume == pytest.approx(23_000.0)


def test_a_hollow_box_that_is_inside_out_is_turned():
    cavity = samples.box((10.0, 10.0, 10.0), (5.0, 5.0, 5.0)).reversed()
    hollow = concatenate(samples.box(), cavity).reversed()
    assert check_solid(hollow, "hollow").volume == pytest.approx(23_000.0)


def test_overlapping_bodies_are_united_and_separate_ones_kept():
    a, b = samples.box(), samples.box((40.0, 30.0, 20.0), (20.0, 5.0, 5.0))
    apart = samples.box((5.0, 5.0, 5.0), (100.0, 0.0, 0.0))
    united = check_solid(concatenate(a, b), "two")
    assert united.volume == pytest.approx(2 * 24_000.0 - 20.0 * 25.0 * 15.0)
    assert as_trimesh(united).body_count == 1
    assert check_solid(concatenate(a, apart), "two").volume == pytest.approx(24_125.0)
