# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's pictures."""

from __future__ import annotations

from pathlib import Path

import pytest

import samples
from volfrep.cli import command as cli
from volfrep.output.meshes import write_mesh

LATTICE = ("--cell", "CVC", "--cell-size", "10", "--strut-radius", "1")


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "box.stl"
    write_mesh(samples.box(), path)
    return path


@pytest.mark.slow
def test_a_part_and_a_block_are_pictured(tmp_path: Path, part: Path) -> None:
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    for job in (["fill", str(part)], ["block", "--count", "1,1,1"]):
        out, picture = tmp_path / "out.stl", tmp_path / f"{job[0]}.png"
        assert cli.run([*job, *LATTICE, "-o", str(out), "--picture", str(picture), "--quiet"]) == 0
        assert out.stat().st_size > 0
        assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("name", "more", "words"),
    [
        ("a.jpg", [], "ends in .png"),
        ("none/a.png", [], "there is no folder"),
        ("out.png", ["--report", "out.png"], "cannot both be written"),
    ],
)
def test_a_picture_that_cannot_be_written_is_refused_before_the_work(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    part: Path,
    capsys: pytest.CaptureFixture[str],
    name: str,
    more: list[str],
    words: str,
) -> None:
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    monkeypatch.chdir(tmp_path)
    assert cli.run(["fill", str(part), *LATTICE, "-o", "o.stl", "--picture", name, *more]) == 2
    assert words in capsys.readouterr().err
    assert not (tmp_path / "o.stl").exists()


def test_beams_have_no_mesh_to_picture(
    tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    out = ["-o", str(tmp_path / "o.3mf"), "--3mf", "beams"]
    job = ["fill", str(part), *LATTICE, *out, "--picture", str(tmp_path / "a.png")]
    assert cli.run(job) == 2
    assert "beams do without" in capsys.readouterr().err
