# SPDX-License-Identifier: LGPL-2.1-or-later
"""STL files: what comes back is what went in, and a failure leaves no trace."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
import trimesh

from volfrep.io.solid import read_triangles
from volfrep.io.write.stl import as_read, merge_corners, write_stl
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh, empty_mesh
from volfrep.output.meshes import mesh_form, write_mesh
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.files import replacing
from volfrep.util.progress import Monitor


def read_back(path: Path) -> TriangleMesh:
    """The file as a reader that merges equal corners sees it."""
    return as_read(read_triangles(path))


def ball(subdivisions: int = 4, at: float = 0.0) -> TriangleMesh:
    sphere = trimesh.creation.icosphere(subdivisions=subdivisions, radius=10.0)
    return TriangleMesh(np.array(sphere.vertices) + at, np.array(sphere.faces).astype(np.int32))


def test_round_trip(tmp_path: Path) -> None:
    path = tmp_path / "ball.stl"
    write_stl(ball(), path)
    assert path.stat().st_size == 84 + 50 * len(ball().triangles)
    back = read_back(path)
    quality, expected = measure(back), measure(ball())
    assert quality.watertight
    assert (quality.vertices, quality.triangles) == (expected.vertices, expected.triangles)
    assert quality.volume == pytest.approx(expected.volume, rel=1e-6)


def test_another_reader_sees_the_same(tmp_path: Path) -> None:
    path = tmp_path / "ball.stl"
    write_stl(ball(), path)
    other = trimesh.load(path)
    assert other.is_watertight
    assert other.volume == pytest.approx(measure(ball()).volume, rel=1e-6)
    stored = np.fromfile(
        path, np.dtype([("n", "<f4", 3), ("v", "<f4", 9), ("a", "<u2")]), -1, "", 84
    )
    np.testing.assert_allclose(stored["n"], other.face_normals, atol=1e-5)
    assert not stored["a"].any()


@pytest.mark.skipif(
    subprocess.run(["which", "admesh"], capture_output=True).returncode != 0,
    reason="admesh is not installed",
)
def test_admesh_has_nothing_to_repair(tmp_path: Path) -> None:
    path = tmp_path / "ball.stl"
    write_stl(ball(), path)
    # It prints the file's header without knowing where it ends.
    said = subprocess.run(
        ["admesh", path], capture_output=True, text=True, errors="replace", check=True
    ).stdout
    figures = dict(re.findall(r"^(\w[\w ]+?) +: +(\d+)", said, re.MULTILINE))
    assert int(figures["Number of facets"]) == len(ball().triangles)
    for defect in (
        "Total disconnected facets",
        "Degenerate facets",
        "Edges fixed",
        "Normals fixed",
    ):
        assert figures[defect] == "0"


def test_many_blocks_keep_their_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_stl(ball(), tmp_path / "one.stl")
    monkeypatch.setattr("volfrep.io.write.stl.BLOCK_FACETS", 100)
    write_stl(ball(), tmp_path / "many.stl")
    assert (tmp_path / "one.stl").read_bytes() == (tmp_path / "many.stl").read_bytes()


def test_as_read_is_what_is_read(tmp_path: Path) -> None:
    write_stl(ball(2), tmp_path / "ball.stl")
    read, predicted = read_back(tmp_path / "ball.stl"), as_read(ball(2))
    np.testing.assert_array_equal(read.vertices, predicted.vertices)
    np.testing.assert_array_equal(read.triangles, predicted.triangles)


def test_negative_zero_is_zero() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    mesh = merge_corners(np.concatenate([corners, -corners]))
    assert len(mesh.vertices) == 5


def test_a_part_too_far_from_the_origin_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "far.stl"
    with pytest.raises(VolfrepError, match="nearer to the origin"):
        write_stl(ball(4, at=1e8), path)
    assert os.listdir(tmp_path) == []
    write_stl(ball(4, at=1e4), path)
    assert measure(read_back(path)).watertight


def test_numbers_beyond_float32_are_refused(tmp_path: Path) -> None:
    for value in (1e39, np.nan, np.inf):
        mesh = ball(1)
        mesh.vertices[3, 1] = value
        with pytest.raises(VolfrepError, match="single-precision"):
            write_stl(mesh, tmp_path / "bad.stl")
    assert os.listdir(tmp_path) == []


def test_an_empty_mesh_is_refused(tmp_path: Path) -> None:
    with pytest.raises(VolfrepError, match="nothing to write"):
        write_stl(empty_mesh(), tmp_path / "empty.stl")


def test_bad_places(tmp_path: Path) -> None:
    with pytest.raises(VolfrepError, match="there is no folder"):
        write_stl(ball(1), tmp_path / "nowhere" / "x.stl")
    with pytest.raises(VolfrepError, match="is not a file"):
        write_stl(ball(1), tmp_path)
    with pytest.raises(VolfrepError, match="is not a file"):
        write_stl(ball(1), os.devnull)
    with pytest.raises(VolfrepError, match="too long"):
        write_stl(ball(1), tmp_path / ("x" * 300 + ".stl"))


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_a_full_disk_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "ball.stl"
    path.write_bytes(b"old")
    opened = Path.open
    monkeypatch.setattr(Path, "open", lambda self, mode: opened(Path("/dev/full"), "wb"))
    with pytest.raises(VolfrepError, match="No space left on device"):
        write_stl(ball(), path)
    monkeypatch.undo()
    assert os.listdir(tmp_path) == ["ball.stl"]
    assert path.read_bytes() == b"old"


def test_an_error_while_writing_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "ball.stl"
    path.write_bytes(b"old")

    def interrupted() -> None:
        with replacing(path) as file:
            file.write(b"new")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    monitor = Monitor(lambda fraction, stage: False)
    with pytest.raises(Cancelled):
        write_stl(ball(), path, monitor)
    assert os.listdir(tmp_path) == ["ball.stl"]
    assert path.read_bytes() == b"old"


@pytest.mark.skipif(os.name == "nt", reason="Windows keeps links for administrators")
def test_the_file_is_replaced_behind_a_link_and_keeps_its_mode(tmp_path: Path) -> None:
    real, link = tmp_path / "real.stl", tmp_path / "link.stl"
    real.write_bytes(b"old")
    real.chmod(0o640)
    link.symlink_to(real)
    write_stl(ball(1), link)
    assert link.is_symlink()
    assert real.stat().st_size > 84
    assert real.stat().st_mode & 0o777 == 0o640


def test_the_extension_picks_the_format(tmp_path: Path) -> None:
    write_mesh(ball(1), tmp_path / "ball.STL")
    assert len(read_back(tmp_path / "ball.STL").triangles) == len(ball(1).triangles)
    with pytest.raises(VolfrepError, match=r"'\.foo' is not a known format, use \.stl"):
        mesh_form("part.foo")
    with pytest.raises(VolfrepError, match="a name without an extension"):
        mesh_form("part")
