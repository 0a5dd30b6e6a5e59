# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's files for the printer: formats by extension, and what a 3MF file holds."""

import json
import re
import zipfile
from functools import partial
from pathlib import Path

import pytest

import command
import samples
from volfrep.io.solid import read_triangles
from volfrep.io.write.stl import write_stl
from volfrep.mesh.quality import measure

LATTICE = ["--cell", "Box", "--cell-size", "10", "--strut-radius", "1"]


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.stl"
    write_stl(samples.box((30.0, 30.0, 30.0)), path)
    return path


fill, block = partial(command.fill, LATTICE), partial(command.block, LATTICE)


def model(path: Path) -> str:
    with zipfile.ZipFile(path) as package:
        return package.read("3D/3dmodel.model").decode()


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".PLY"])
def test_the_extension_picks_the_format(tmp_path: Path, suffix: str) -> None:
    out = tmp_path / f"block{suffix}"
    assert block(out) == 0
    found = measure(read_triangles(out))
    assert found.watertight
    assert found.genus == 20 - 12 + 1


def test_a_3mf_file_holds_the_mesh_unless_told_otherwise(tmp_path: Path) -> None:
    assert block(tmp_path / "part.3mf") == 0
    assert block(tmp_path / "part2.3mf", "--3mf", "mesh") == 0
    for name in ("part.3mf", "part2.3mf"):
        assert "<triangle " in model(tmp_path / name)
        assert "<b:beam " not in model(tmp_path / name)


@pytest.mark.costly
def test_beams_take_no_mesh(
    tmp_path: Path,
    part: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("volfrep.jobs.kinds.strut_lattice.mesh_octants", None)
    assert block(tmp_path / "block.3mf", "--3mf", "beams") == 0
    assert re.search(r"struts +20 between 12 nodes, as beams", capsys.readouterr().out)
    assert model(tmp_path / "block.3mf").count("<b:beam ") == 20
    assert fill(part, tmp_path / "part.3mf", "--3mf", "beams") == 0
    told = capsys.readouterr()
    (expected,) = re.findall(r"Expected: about \d+ cells, \d+ struts, .*", told.out)
    assert "triangles" not in expected
    assert "do not know the beam lattice extension" in told.err
    assert fill(part, tmp_path / "part.3mf", "--3mf", "beams", "--quiet") == 0
    assert capsys.readouterr().out == ""
    assert model(tmp_path / "part.3mf").count("<b:beam ") == 3 * 3 * 4 * 4
    assert '<component objectid="2"/><component objectid="3"/>' in model(tmp_path / "part.3mf")


@pytest.mark.costly
def test_both(tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert fill(part, tmp_path / "part.3mf", "--3mf", "both") == 0
    triangles = re.search(r"triangles +([\d,]+)", capsys.readouterr().out)
    assert triangles
    text = model(tmp_path / "part.3mf")
    assert text.count("<triangle ") == int(triangles[1].replace(",", ""))
    assert text.count("<b:beam ") == 3 * 3 * 4 * 4
    assert block(tmp_path / "block.3mf", "--3mf", "both") == 0
    assert model(tmp_path / "block.3mf").count("<b:beam ") == 20


@pytest.mark.costly
def test_the_print_report(tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    report = tmp_path / "out.json"
    options = ["--print-report", "lpbf", "--report", report, "--density", 4.43]
    assert fill(part, tmp_path / "out.stl", *options) == 0
    said = capsys.readouterr().out
    assert re.search(r"^process +LPBF, metal powder, laser$", said, re.MULTILINE)
    assert re.search(r"^closed voids +1, holding ", said, re.MULTILINE)
    figures = json.loads(report.read_text())
    printing = figures["print_report"]
    assert printing["process"]["name"] == "LPBF"
    assert printing["mass_g"] == pytest.approx(figures["mass_g"])
    # Only what lies under the skin: two of the four layers of nodes each way are in it.
    assert printing["strut_length_mm"] == pytest.approx(3 * 4 * 26, rel=0.05)
    assert len(printing["findings"]) == 3


@pytest.mark.slow
def test_the_build_direction(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shares = {}
    for direction in ("0,0,1", "-1,0,0", "1,1e0,1"):
        options = ["--print-report", "LPBF", "--build-direction", direction]
        assert block(tmp_path / "out.stl", *options) == 0
        found = re.search(r"below 45 degrees +([\d.]+) %", capsys.readouterr().out)
        assert found
        shares[direction] = float(found[1])
    # 6 of 20 struts stand along z, 8 along x, and along a diagonal all lie at 35 degrees.
    assert shares == {"0,0,1": 70.0, "-1,0,0": 60.0, "1,1e0,1": 100.0}
    assert block(tmp_path / "out.stl", "--print-report", "FFF") == 0  # it bridges 10 mm
    assert re.search(r"below 45 degrees +0\.0 %", capsys.readouterr().out)


@pytest.mark.parametrize(
    ("name", "more", "message"),
    [
        ("x.stl", ["--3mf", "beams"], "give it the extension .3mf"),
        ("x.3mf", ["--3mf", "struts"], "invalid choice: 'struts'"),
        ("x.3mf", ["--3mf", "beams", "--report", "r.json"], "does without: use both"),
        ("x.3mf", ["--3mf", "beams", "--print-report", "FFF"], "does without: use both"),
        ("x.stl", ["--print-report", "CNC"], "no process 'CNC'"),
        ("x.stl", ["--print-report", "FFF", "--build-direction", "0,0,0"], "not all 0"),
        ("x.stl", ["--print-report", "FFF", "--build-direction", "0,1"], "takes 3 numbers"),
        ("x.3mf", ["--3mf", "both", "--fillet", "1"], "no fillets"),
        ("x.3mf", ["--3mf", "beams", "--fillet", "1"], "no fillets"),
        ("x.stl", ["--step", "exact"], "give it the extension .step."),
        ("x.step", ["--inp", "beams"], "give it the extension .inp"),
        ("x.stl", ["--material", "A,1,0"], "give it the extension .inp"),
        ("x.inp", ["--material", "STEEL"], "There is no material 'STEEL'"),
        ("x.inp", ["--material", "ST EEL,1,0"], "must consist of letters"),
        ("x.inp", ["--material", "STEEL,1,0.5"], "Poisson's ratio"),
        ("x.inp", ["--3mf", "beams"], "give it the extension .3mf"),
        ("x.inp", ["--report", "r.json"], "which --inp beams does without"),
        ("x.step", ["--step", "wireframe", "--print-report", "FFF"], "--step wireframe does"),
        ("x.inp", ["--fillet", "1"], "set the fillet to 0, or choose tetrahedra"),
        ("x.step", ["--step", "wireframe", "--fillet", "1"], "or choose faceted"),
        ("x.step", ["--step", "round"], "invalid choice: 'round'"),
    ],
)
def test_what_does_not_go_together(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    name: str,
    more: list[str],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert block(Path(name), *more) == 2
    assert message in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
