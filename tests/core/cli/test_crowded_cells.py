# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells of very many struts, or of struts that cross: how long they take is told, or refused."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.cli.command import run
from volfrep.design.cells import find_cell
from volfrep.design.kinds.strut_cells import crossing_struts
from volfrep.io.write.stl import write_stl
from volfrep.jobs import blocks
from volfrep.jobs.kinds.octant_block import OctantBlock
from volfrep.mechanics import homogenise
from volfrep.mechanics.voxels import Voxels
from volfrep.octants import octant_mesh
from volfrep.util.errors import Cancelled

SIZES = ["--cell-size", "10"]


def complete(folder: Path, nodes: int) -> Path:
    """A cell's file: random nodes, each joined to every other."""
    path = folder / f"K{nodes}.json"
    points = np.random.default_rng(5).random((nodes, 3)).round(3).tolist()
    struts = list(itertools.combinations(range(nodes), 2))
    path.write_text(json.dumps({"name": f"K{nodes}", "nodes": points, "struts": struts}))
    return path


@pytest.mark.parametrize("radius", ["0.05", "0.5"])
@pytest.mark.parametrize("command", ["block", "fill"])
def test_780_struts_are_refused_before_any_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str, radius: str
) -> None:
    cell, output = complete(tmp_path, 40), tmp_path / "out.stl"
    given = ["block", "--count", "1,1,1"]
    if command == "fill":
        write_stl(samples.box((24.0, 24.0, 24.0)), tmp_path / "part.stl")
        given = ["fill", str(tmp_path / "part.stl"), "--shell", "1"]
    given += ["--cell", str(cell), "--strut-radius", radius, "-o", str(output), *SIZES]
    assert run(given) == 2
    out, told = capsys.readouterr()
    assert "Expected" not in out
    assert told.startswith("volfrep: The 780 struts of the cell 'K40' run into each other")
    assert told.count("\n") == 1
    assert not output.exists()


def test_what_a_cell_of_a_few_struts_takes_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """One of 28 struts takes 20 s at least, of which 0.5 s were told."""

    def made(*given: object, **named: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(OctantBlock, "write_stl", made)
    given = ["block", "--count", "1,1,1", "--cell", str(complete(tmp_path, 8)), "--cell-size", "10"]
    assert run([*given, "--strut-radius", "0.5", "-o", str(tmp_path / "out.stl")]) == 130
    told = capsys.readouterr().out
    seconds = float(told.split(" MB and ")[1].split(" s.")[0])
    assert 22.0 / 3.0 < seconds < 22.0 * 3.0


@pytest.mark.slow
def test_struts_that_cross_are_counted(tmp_path: Path) -> None:
    """Against the distances of points along them."""
    cell = find_cell(str(complete(tmp_path, 8)))
    places = np.linspace(0.0, 1.0, 401)[:, None]
    lines = [a + places * (b - a) for a, b in cell.nodes[cell.struts]]
    found = 0
    for one, two in itertools.combinations(range(len(lines)), 2):
        if set(cell.struts[one]) & set(cell.struts[two]):
            continue
        apart = np.linalg.norm(lines[one][:, None] - lines[two], axis=2)
        k, j = np.unravel_index(apart.argmin(), apart.shape)
        found += apart.min() < 0.1 and 0 < k < 400 and 0 < j < 400
    assert crossing_struts(cell, 0.05) == found > 10
    assert crossing_struts(find_cell("BCC"), 0.05) == 0


@pytest.mark.costly
def test_a_cancel_is_seen_while_octants_are_refined(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []
    split = octant_mesh.split_where_it_deviates

    def refined(*given):
        asked.append("refined")
        return split(*given)

    monkeypatch.setattr(octant_mesh, "split_where_it_deviates", refined)
    spec = LatticeSpec(str(complete(tmp_path, 4)), cell_size=10.0, strut_radius=0.8)
    with pytest.raises(Cancelled):
        blocks.block(spec, (1, 1, 1), progress=lambda *_: not asked)
    assert asked == ["refined"], "one round later it has ended"


def test_780_struts_have_no_properties(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cell = complete(tmp_path, 40)
    assert run(["properties", str(cell), "--cell-size", "10", "--strut-radius", "0.5"]) == 2
    told = capsys.readouterr().err
    assert "The cell 'K40' has 780 struts, more than 500" in told
    assert told.count("\n") == 1
    crowded = complete(tmp_path, 26)
    assert run(["properties", str(crowded), "--cell-size", "10", "--strut-radius", "0.5"]) == 2
    assert "has 325 struts, which run into each other beside" in capsys.readouterr().err


@pytest.mark.slow
def test_properties_that_take_long_tell_it_before_the_finer_grids(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a cell of 28 struts: two finer grids, so many times as long as the coarsest took."""
    solved: list[int] = []
    solve = homogenise.solve_grid

    def timed(voxels: Voxels, *given: object, **named: object) -> homogenise.Grid:
        solved.append(voxels.along)
        if len(solved) > 1:
            raise KeyboardInterrupt
        return solve(voxels, *given, **named)

    now = iter([100.0, 100.5]).__next__
    monkeypatch.setattr(homogenise, "solve_grid", timed)
    monkeypatch.setattr(homogenise.time, "perf_counter", now)
    cell = complete(tmp_path, 8)
    given = [
        "properties",
        str(cell),
        "--cell-size",
        "10",
        "--strut-radius",
        "0.5",
        "--voxels",
        "48",
    ]
    assert run(given) == 130
    assert solved == [12, 24]
    # 15 struts took 0.5 s, 6 s and about 70 s on three grids.
    assert "Expected: about 80 s more." in capsys.readouterr().err
