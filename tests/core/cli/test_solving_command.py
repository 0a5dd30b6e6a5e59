# SPDX-License-Identifier: LGPL-2.1-or-later
"""`volfrep solve`: any solid and its load cases, to figures and a file for ParaView."""

import json
from pathlib import Path

import meshio
import numpy as np
import pytest
import trimesh

from command import run

LOADS = """
material = "Ti-6Al-4V"
[[support]]
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
fixed = true
[[case]]
name = "down"
[[case.load]]
name = "tip"
plane = { point = [40, 0, 0], normal = [1, 0, 0] }
force = [0, 0, -40]
"""


@pytest.fixture
def part(tmp_path: Path) -> Path:
    trimesh.creation.box(bounds=((0, 0, 0), (40, 10, 10))).export(tmp_path / "part.stl")
    (tmp_path / "loads.toml").write_text(LOADS, encoding="utf-8")
    return tmp_path / "part.stl"


def solve(part: Path, *more: object) -> int:
    return run("solve", part, "--loads", part.with_name("loads.toml"), "--voxel", 2.5, *more)


def test_figures_and_fields_are_of_the_same_solution(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fields, figures = part.with_name("out.vtu"), part.with_name("out.json")
    assert solve(part, "-o", fields, "--report", figures) == 0
    said = capsys.readouterr().out
    assert "Expected: about " in said
    assert "nominal: voxels have steps" in said
    told = json.loads(figures.read_text(encoding="utf-8"))
    assert [voxels["count"] for voxels in told["voxels"]] == [11 * 3 * 3, 16 * 4 * 4]
    mesh = meshio.read(fields)
    moved = mesh.point_data["displacement mm, down"]
    most = np.linalg.norm(moved, axis=1).max()
    assert most == pytest.approx(told["cases"][0]["displacement_mm"], rel=1e-5)
    corners = mesh.points[mesh.cells[0].data]
    spans = corners[:, [1, 3, 4]] - corners[:, :1]
    assert np.linalg.det(spans) == pytest.approx(np.full(256, 2.5**3), rel=1e-5)


def test_another_material_moves_by_its_modulus(part: Path) -> None:
    figures = []
    for given in ((), ("--material", "Other,1000,0.34")):
        assert solve(part, "--quiet", "-o", part.with_name("o.json"), *given) == 0
        told = json.loads(part.with_name("o.json").read_text(encoding="utf-8"))
        figures.append((told["cases"][0]["compliance_nmm"], told["material"]))
    (one, usual), (other, soft) = figures
    assert soft["young"] == 1000.0
    assert other / one == pytest.approx(usual["young"] / 1000.0, rel=0.02)


def test_what_cannot_be_written_is_refused_before_the_work(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert solve(part, "-o", part.with_name("o.stl")) == 2
    assert ".vtu" in capsys.readouterr().err
    assert solve(part, "--voxel", "0.001") == 2
    assert "would fit" in capsys.readouterr().err
