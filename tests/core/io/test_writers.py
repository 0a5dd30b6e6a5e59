# SPDX-License-Identifier: LGPL-2.1-or-later
"""PLY and OBJ files, and what all the writers share, as trimesh reads them."""

import os
from pathlib import Path

import numpy as np
import pytest
import trimesh

import samples
from volfrep import LatticeSpec
from volfrep.jobs.blocks import block
from volfrep.mesh.precision import decimal_step, lines, rounded
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh, empty_mesh
from volfrep.output.form import suffixes
from volfrep.output.meshes import write_mesh
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.files import replacing
from volfrep.util.progress import Monitor

INDEXED = (".ply", ".obj")


@pytest.fixture(scope="module")
def lattice() -> TriangleMesh:
    spec = LatticeSpec(cell="Box", cell_size=10, strut_radius=1, origin=(-5, 0, 300))
    return block(spec, (2, 1, 1)).mesh


@pytest.mark.parametrize("suffix", INDEXED)
def test_a_mesh_comes_back_as_it_was(tmp_path: Path, suffix: str, lattice: TriangleMesh) -> None:
    path = tmp_path / f"block{suffix}"
    write_mesh(lattice, path)
    back = trimesh.load(path, process=False, maintain_order=True)
    np.testing.assert_array_equal(back.faces, lattice.triangles)
    step = np.spacing(np.float32(lattice.bounds.max()))
    np.testing.assert_allclose(back.vertices, lattice.vertices, atol=float(step))
    assert back.is_watertight
    assert back.volume == pytest.approx(lattice.volume, rel=1e-5)
    assert back.euler_number == 2 * (1 - measure(lattice).genus)


@pytest.mark.parametrize("suffix", suffixes(meshes=True))
def test_no_writer_leaves_a_file_that_is_not_whole(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"ball{suffix}"
    with pytest.raises(VolfrepError, match="mesh is empty"):
        write_mesh(empty_mesh(), path)
    with pytest.raises(Cancelled):
        write_mesh(samples.sphere(10.0, 3), path, Monitor(lambda fraction, stage: False))
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("suffix", [".stl", ".3mf", ".ply", ".obj"])
def test_what_single_precision_cannot_hold_is_refused(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"ball{suffix}"
    ball = samples.sphere(10.0, 3)
    with pytest.raises(VolfrepError, match="single-precision"):
        write_mesh(TriangleMesh(ball.vertices + np.inf, ball.triangles), path)
    with pytest.raises(VolfrepError, match=r"near \(.*nearer to the origin"):
        write_mesh(TriangleMesh(ball.vertices + 1e8, ball.triangles), path)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("suffix", suffixes(meshes=True))
def test_every_writer_tells_its_progress(tmp_path: Path, suffix: str, monkeypatch) -> None:
    monkeypatch.setattr("volfrep.io.write.stl.BLOCK_FACETS", 100)
    for module in ("mesh.precision", "io.write.numbered", "io.write.obj", "io.write.threemf"):
        monkeypatch.setattr(f"volfrep.{module}.BLOCK_ROWS", 100)
    monkeypatch.setattr("volfrep.util.text_rows.VALUES", 1000)
    told: list[float] = []
    monitor = Monitor(lambda fraction, stage: told.append(fraction))
    write_mesh(samples.sphere(10.0, 3), tmp_path / f"ball{suffix}", monitor)
    assert told == sorted(told)
    assert told[-1] == pytest.approx(1.0, abs=0.1)
    if suffix not in (".off", ".glb"):  # written in one go
        assert len(told) > 10


def test_ply_is_a_third_of_the_size_of_stl(tmp_path: Path, lattice: TriangleMesh) -> None:
    for suffix in (".stl", ".ply"):
        write_mesh(lattice, tmp_path / f"block{suffix}")
    sizes = [(tmp_path / f"block{suffix}").stat().st_size for suffix in (".stl", ".ply")]
    assert sizes[1] < 0.4 * sizes[0]


def test_numbers_are_written_to_the_step_of_single_precision() -> None:
    ball = samples.sphere(10.0, 2)
    text = rounded(ball.vertices + 290.0, decimal_step(ball.vertices + 290.0))
    assert np.abs(text - ball.vertices - 290.0).max() < np.spacing(np.float32(300.0)) / 2
    assert b"".join(lines("%.9g ", [text[:3, :1]])).count(b".") == 3


def test_lines_are_filled_row_by_row() -> None:
    assert b"".join(lines("<%d %d>", [np.array([[1, 2]]), np.array([[3, 4]])])) == b"<1 2><3 4>"
    assert b"".join(lines("<%d>", [np.zeros((0, 1), int)])) == b""
    short = rounded(np.array([[-1e-9, 0.25, 1.00001]]), 1e-4)
    assert b"".join(lines("%.9g %.9g %.9g", [short])) == b"0 0.25 1"


def test_a_file_that_windows_holds_open_is_told_as_that(tmp_path, monkeypatch):
    target = tmp_path / "part.bin"
    target.write_bytes(b"old")
    held = PermissionError(13, "Access is denied")
    held.winerror = 5  # as Windows sets it

    def refuse(*_):
        raise held

    monkeypatch.setattr("volfrep.util.files.os.replace", refuse)
    with (
        pytest.raises(VolfrepError, match="Access is denied; it may be open in another program"),
        replacing(target) as file,
    ):
        file.write(b"new")
    assert [path.name for path in tmp_path.iterdir()] == ["part.bin"]
    assert target.read_bytes() == b"old"
