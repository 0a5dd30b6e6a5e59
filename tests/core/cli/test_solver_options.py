# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's files for CAD and for CalculiX: the extension and one option say which."""

import re
import shutil
import subprocess
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import trimesh

import command
import samples
from volfrep.fem.calculix import solve
from volfrep.io.write.stl import write_stl

LATTICE = ["--cell", "CVC", "--cell-size", "10", "--strut-radius", "1", "--resolution", "10"]
needs_freecad = pytest.mark.skipif(
    shutil.which("freecadcmd") is None, reason="FreeCAD is not installed"
)
needs_calculix = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed"
)
needs_gmsh = pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not installed")


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.stl"
    write_stl(samples.box((24.0, 24.0, 14.0)), path)
    return path


fill, block = partial(command.fill, LATTICE), partial(command.block, LATTICE)


def sets_of(deck: Path) -> dict[str, list[int]]:
    """The node sets of a deck."""
    found = re.findall(r"\*NSET,NSET=(\w+)\n((?:[\d,]+\n)+)", deck.read_text())
    return {name: [int(k) for k in re.findall(r"\d+", rows)] for name, rows in found}


def test_step_is_faceted_unless_told_otherwise(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert block(tmp_path / "a.step") == 0
    said = capsys.readouterr().out
    assert re.search(r"a\.step: [\d,]+ plane faces: about ", said)
    triangles = re.search(r"triangles +([\d,]+)", said)
    assert triangles
    text = (tmp_path / "a.step").read_text()
    assert text.count("ADVANCED_FACE(") == int(triangles[1].replace(",", ""))
    assert block(tmp_path / "b.stp", "--step", "faceted", "--quiet") == 0
    assert (tmp_path / "b.stp").stat().st_size == (tmp_path / "a.step").stat().st_size
    assert capsys.readouterr().out == ""


def test_axes_take_no_mesh(
    tmp_path: Path,
    part: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("volfrep.jobs.kinds.strut_lattice.mesh_octants", None)
    assert block(tmp_path / "axes.step", "--step", "wireframe") == 0
    assert (tmp_path / "axes.step").read_text().count("POLYLINE(") == 16
    said = capsys.readouterr().out
    assert "16 lines: about" in said
    assert re.search(r"struts +16 between 14 nodes, as lines", said)
    assert fill(part, tmp_path / "cut.step", "--step", "wireframe") == 0
    # All the struts of 2 x 2 x 1 cells, 20 mm wide under a skin of 2 mm, in pieces.
    assert (tmp_path / "cut.step").read_text().count("POLYLINE(") > 32
    assert block(tmp_path / "block.inp") == 0
    assert "160 beams" in capsys.readouterr().out


@needs_calculix
def test_a_deck_of_beams_is_ready_for_a_step(tmp_path: Path, part: Path) -> None:
    out = tmp_path / "part.inp"
    assert fill(part, out, "--inp", "beams", "--material", "STEEL,210000,0.3", "--quiet") == 0
    text = out.read_text()
    assert "*MATERIAL,NAME=STEEL\n*ELASTIC\n210000,0.3\n" in text
    # The ends as they were fitted to the cell: a material and a section of their own.
    stiff = re.search(r"\*MATERIAL,NAME=STEEL_END\n\*ELASTIC\n([\d.]+),0.3\n", text)
    assert stiff
    assert float(stiff[1]) != 210_000
    sections = re.findall(r"MATERIAL=(\w+),SECTION=RECT\n([\d.]+),", text)
    assert len({width for name, width in sections if name == "STEEL"}) == 1
    struts, ends = (
        float(next(width for name, width in sections if name == kind))
        for kind in ("STEEL", "STEEL_END")
    )
    assert struts < ends < 4 * struts
    named = sets_of(out)
    assert set(named["SKIN"]) < set(named["JOINTS"])
    # What a user adds: the skin holds the lattice, one joint inside is pulled.
    inner = min(set(named["JOINTS"]) - set(named["SKIN"]))
    out.write_text(
        f"{text}*BOUNDARY\nSKIN,1,6\n*STEP\n*STATIC\n*CLOAD\n{inner},1,10.\n"
        "*NODE PRINT,NSET=NALL\nU\n*END STEP\n"
    )
    moved = solve(out)
    assert np.abs(moved[np.array(named["SKIN"]) - 1]).max() < 1e-12
    assert moved[inner - 1, 0] > 1e-9


@pytest.mark.slow
@needs_gmsh
def test_a_deck_of_tetrahedra(tmp_path: Path, part: Path) -> None:
    out = tmp_path / "part.inp"
    coarse = ("--resolution", 8)
    assert fill(part, out, "--inp", "tetrahedra", "--density", 7.85, "--quiet", *coarse) == 0
    text = out.read_text()
    assert "*ELEMENT,TYPE=C3D10" in text
    assert "*DENSITY\n7.85e-09\n" in text
    rows = re.findall(r"^(\d+),(.+),(.+),(.+)$", text.split("*NODE")[1].split("\n*")[0], re.M)
    where = {int(number): np.array(place, float) for number, *place in rows}
    points = np.array(list(where.values()))
    ends = points.min(axis=0), points.max(axis=0)
    off = np.minimum(points - ends[0], ends[1] - points)
    outside = {number for number, away in zip(where, off.min(axis=1), strict=True) if away < 1e-6}
    assert outside == set(sets_of(out)["SKIN"])
    assert (np.sort(off, axis=1)[:, 2] < 1e-6).sum() == 8  # the corners


@pytest.mark.slow
@needs_freecad
def test_exact_surfaces_of_a_block(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert block(tmp_path / "block.step", "--step", "exact") == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert "16 struts, 13 kinds of joints: about" in captured.out
    volumes = re.search(r"exact volume +([\d.,]+) mm3 \(mesh: ([\d.,]+) mm3\)", captured.out)
    assert volumes
    exact, mesh = (float(text.replace(",", "")) for text in volumes.groups())
    assert exact == pytest.approx(mesh, rel=5e-3)  # coarse facets
    text = (tmp_path / "block.step").read_text()
    assert text.count("CYLINDRICAL_SURFACE(") > 10
    assert text.count("MANIFOLD_SOLID_BREP(") == 1


@pytest.mark.slow
@needs_freecad
def test_an_exact_part_is_cut_at_its_inner_wall(
    tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert fill(part, tmp_path / "part.step", "--step", "exact") == 0
    assert capsys.readouterr().err == ""
    text = (tmp_path / "part.step").read_text()
    assert text.count("CYLINDRICAL_SURFACE(") > 10
    assert "BREP_WITH_VOIDS(" in text


@needs_freecad
@pytest.mark.slow
def test_whole_cells_are_not_cut(
    tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = ["--step", "exact", "--activation", "inside", "--boundary", "whole"]
    lattice = [*whole, "--make", "lattice", "--shell", 0]
    assert command.run("fill", part, "-o", tmp_path / "a.step", *LATTICE, *lattice) == 0
    captured = capsys.readouterr()
    assert "kinds of joints" in captured.out
    assert captured.err == ""
    assert (tmp_path / "a.step").read_text().count("CYLINDRICAL_SURFACE(") > 10


@pytest.mark.costly
@needs_freecad
def test_plane_faces_are_told_before_the_work_where_opencascade_does_not_manage(
    tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    ball = tmp_path / "ball.stl"
    write_stl(samples.sphere(11.0, 4), ball)

    def met(*_: object, **__: object) -> None:
        raise AssertionError("FreeCAD is asked for what it does not do")

    monkeypatch.setattr("volfrep.io.freecad_process.write_exact_step", met)
    assert fill(ball, tmp_path / "ball.step", "--step", "exact") == 0
    assert "holds plane faces instead" in capsys.readouterr().err
    assert "CYLINDRICAL_SURFACE(" not in (tmp_path / "ball.step").read_text()
    assert "ADVANCED_FACE(" in (tmp_path / "ball.step").read_text()


@needs_freecad
@pytest.mark.slow
def test_openings_of_the_skin_are_there_or_missed_with_a_message(
    tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """An open face is exact too; drain holes are in the mesh only."""
    exact = ["--step", "exact"]
    assert fill(part, tmp_path / "a.step", *exact, "--open-plane", "12,12,14,0,0,1") == 0
    assert capsys.readouterr().err == ""
    assert "CYLINDRICAL_SURFACE(" in (tmp_path / "a.step").read_text()
    drains = ["--drain", "12,12,14", "--drain-diameter", 3]
    assert fill(part, tmp_path / "b.step", *exact, *drains) == 0
    assert "have no drain holes. The file holds plane faces" in capsys.readouterr().err
    assert "CYLINDRICAL_SURFACE(" not in (tmp_path / "b.step").read_text()


@needs_freecad
@pytest.mark.slow
def test_struts_deformed_with_their_cells_are_warned_about(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stretched = ["--size-grading", "linear", "--lambda-end", 1.5, "--no-keep-radius"]
    for out, more in (("a.step", ["--step", "exact"]), ("a.inp", [])):
        assert block(tmp_path / out, *more, *stretched) == 0
        assert "these struts are deformed" in capsys.readouterr().err


def test_exact_surfaces_need_freecad(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert block(tmp_path / "a.step", "--step", "exact") == 2
    assert "there is no 'freecadcmd' on the PATH" in capsys.readouterr().err


def test_what_only_a_domain_cannot_give(
    tmp_path: Path, part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert fill(part, tmp_path / "x.inp", "--make", "domain") == 2
    assert "holds no lattice" in capsys.readouterr().err


@pytest.mark.costly
def test_absurd_sizes_name_what_would_fit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "x.inp"
    assert command.run("block", "-o", out, *LATTICE, "--count", "24,24,24") == 2
    said = capsys.readouterr().err
    assert "choose a block of 17 x 17 x 17 cells" in said
    assert not out.exists()


@pytest.mark.slow
@needs_calculix
def test_a_tube_of_cut_struts_is_as_stiff_in_beams_as_in_solids(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    part, out = tmp_path / "tube.stl", tmp_path / "tube.inp"
    tube = trimesh.creation.annulus(10.0, 20.0, 40.0, sections=96)
    tube.apply_translation([0.0, 0.0, 20.0])
    tube.export(part)
    # All struts are cut: none has both its nodes inside.
    lattice = ["--cell", "FCC", "--cell-size", "13.33", "--strut-radius", "1.3", "--shell", "0"]
    lattice += ["--material", "PETG,2100,0.38", "--quiet"]
    assert command.run("fill", part, "-o", out, "--inp", "beams", *lattice) == 0
    assert "left out, 0.77 % of" in capsys.readouterr().err
    ends = "*STEP\n*STATIC\n*BOUNDARY\nZMIN,1,6\nZMAX,1,2\nZMAX,3,3,-0.001\n"
    asked = "*NODE PRINT,NSET=ZMAX,TOTALS=ONLY\nRF\n*END STEP\n"
    out.write_text(out.read_text() + ends + asked)
    subprocess.run(["ccx", "-i", out.stem], cwd=tmp_path, capture_output=True, check=True)
    carried = -float(out.with_suffix(".dat").read_text().split()[-1])
    # Second-order tetrahedra of the same part at resolution 20, held alike: 2.621 N.
    assert carried == pytest.approx(2.621, rel=0.06)
