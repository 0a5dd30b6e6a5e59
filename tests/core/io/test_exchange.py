# SPDX-License-Identifier: LGPL-2.1-or-later
"""OFF and GLB: what goes out comes back, others read it, and nothing makes the reader run away."""

import json
import struct

import numpy as np
import pytest
import trimesh

import samples
from volfrep.io.solid import read_solid
from volfrep.output.meshes import write_mesh
from volfrep.util.errors import VolfrepError


def refused(path, words):
    with pytest.raises(VolfrepError, match=words) as error:
        read_solid(path)
    assert path.name in str(error.value)


@pytest.mark.parametrize("kind", ["off", "glb"])
def test_what_is_written_comes_back(tmp_path, kind):
    mesh = samples.bracket(turn=20.0)
    write_mesh(mesh, tmp_path / f"part.{kind}")
    solid = read_solid(tmp_path / f"part.{kind}")
    assert solid.volume == pytest.approx(mesh.volume, rel=1e-6)
    assert np.allclose(solid.bounds, mesh.bounds, atol=1e-4)
    assert solid.states_unit == (kind == "glb")


def test_a_glb_is_in_metres_with_y_up(tmp_path):
    write_mesh(samples.box((40.0, 30.0, 20.0)), tmp_path / "box.glb")
    read = trimesh.load_mesh(tmp_path / "box.glb")
    assert np.allclose(read.extents, (0.04, 0.02, 0.03))
    assert np.allclose(read.bounds[0], (0.0, 0.0, -0.03), atol=1e-9)


def test_a_scene_puts_its_meshes_where_it_says(tmp_path):
    scene = trimesh.Scene()
    box = trimesh.creation.box((1.0, 1.0, 1.0))
    for x in (0.0, 5.0):
        scene.add_geometry(box, transform=trimesh.transformations.translation_matrix((x, 0, 0)))
    (tmp_path / "two.glb").write_bytes(scene.export(file_type="glb"))
    assert np.ptp(read_solid(tmp_path / "two.glb").bounds, axis=0)[0] == pytest.approx(6000.0)


def glb(tree, binary=b""):
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


MESH = {"primitives": [{"attributes": {"POSITION": 0}}]}


@pytest.mark.parametrize(
    ("tree", "words"),
    [
        ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "KHR_draco.*without compression"),
        ({"buffers": [{"uri": "file:///etc/passwd", "byteLength": 4}]}, "in another file"),
        ({"accessors": [{"count": 10**12, "bufferView": 0}]}, "promises 1000000000000 values"),
        ({"accessors": [{"count": -1, "bufferView": 0}]}, "promises -1 values"),
        ({"accessors": [{"count": 3}]}, "nowhere in it"),
        ({"nodes": [{"children": [0, 0]}]}, "in two places"),
        ({"nodes": [{"children": [7]}]}, "in two places"),
        ({"nodes": [{}] * 10_001}, "10001 nodes"),
        ({"nodes": [{"mesh": 5}], "meshes": [MESH]}, "makes no sense"),
        ({"nodes": 7}, "makes no sense"),
        ({"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [MESH]}, "makes no sense"),
    ],
)
def test_a_hostile_glb_is_refused(tmp_path, tree, words):
    path = tmp_path / "part.glb"
    path.write_bytes(glb(tree))
    refused(path, words)


@pytest.mark.parametrize("length", [0, 3, 11, 40, 200])
def test_a_glb_cut_short_is_refused(tmp_path, length):
    write_mesh(samples.box(), tmp_path / "part.glb")
    data = (tmp_path / "part.glb").read_bytes()
    (tmp_path / "part.glb").write_bytes(data[:length])
    refused(tmp_path / "part.glb", "cut short|empty")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("OFF\n8 12\n", "do not fit"),
        ("OFF\n999999999999 1 0\n0 0 0\n", "do not fit"),
        ("OFF\n-1 1 0\n", "do not fit"),
        ("OFF\none two\n", "does not count"),
        ("PLY\n", "header is missing"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n", "cannot be read"),
        ("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "other faces than triangles"),
        ("OFF\n3 1 0\n0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n", "cannot be read"),
    ],
)
def test_a_damaged_off_is_refused(tmp_path, text, words):
    path = tmp_path / "part.off"
    path.write_text(text)
    refused(path, words)


def test_random_damage_to_a_glb_gives_a_sentence_or_a_right_solid(tmp_path):
    write_mesh(samples.box(), tmp_path / "part.glb")
    whole = (tmp_path / "part.glb").read_bytes()
    random = np.random.default_rng(7)
    refusals = 0
    for _ in range(300):
        data = bytearray(whole)
        for place in random.integers(0, len(data), random.integers(1, 5)):
            data[place] = random.integers(0, 256)
        (tmp_path / "part.glb").write_bytes(bytes(data))
        try:
            assert read_solid(tmp_path / "part.glb").volume > 0.0
        except VolfrepError:
            refusals += 1
    assert 0 < refusals < 300
