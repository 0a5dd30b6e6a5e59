# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command: its interface, its one sentence for any bad input, its exit codes."""

import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import samples
from volfrep.cli import command as cli
from volfrep.cli import run_options
from volfrep.design.cells import LIBRARY, USES, UnitCell
from volfrep.design.drawn_cell import save_cell
from volfrep.io.solid import read_triangles
from volfrep.io.write.stl import as_read, write_stl
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial.rays import inside_points
from volfrep.util.progress import Monitor
from volfrep.util.threads import MATRIX_THREADS

COMMAND = [sys.executable, "-m", "volfrep"]

LATTICE = ["--cell", "Box", "--cell-size", "10", "--strut-radius", "1"]


def cube(side: float = 30.0) -> TriangleMesh:
    shape = trimesh.creation.box((side, side, side))
    return TriangleMesh(np.array(shape.vertices), np.array(shape.faces).astype(np.int32))


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.stl"
    write_stl(cube(), path)
    return path


def refused(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    """The sentence with which the command refuses."""
    assert cli.run([str(argument) for argument in arguments]) == 2
    out, err = capsys.readouterr()
    assert not out or out.startswith("Expected: about ")
    assert out.count("\n") <= 1
    assert err.startswith("volfrep: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    return err


# --- without any work ---------------------------------------------------------------------------


def test_help_and_version() -> None:
    for option, expected in (("--help", "fill"), ("--version", "volfrep 0.")):
        done = subprocess.run([*COMMAND, option], capture_output=True, text=True, check=True)
        assert expected in done.stdout


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["fill", "--help"]])
def test_help_and_version_start_at_once_without_numpy(arguments: list[str]) -> None:
    code = (
        "import sys\nfrom volfrep.cli import command as cli\n"
        f"try:\n    cli.run({arguments!r})\nexcept SystemExit:\n    pass\n"
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True).returncode == 0


@pytest.mark.parametrize(
    ("code", "unused"),
    [
        ("import volfrep", ["numpy", "argparse", "dataclasses", "volfrep.design"]),
        (
            "import sys; sys.argv[1:] = ['--version']\nfrom volfrep.__main__ import main\n"
            "try:\n    main()\nexcept SystemExit:\n    pass",
            ["numpy", "argparse", "dataclasses", "volfrep.design"],
        ),
        (
            "from volfrep.cli.command import run\nassert run('block --cell CVC --cell-size 5 "
            "--strut-radius 0.5 --count 1,1,1 --quiet -o block.stl'.split()) == 0",
            [
                "scipy", "manifold3d", "trimesh", "networkx", "multiprocessing",
                "importlib.metadata", "volfrep.cli.size", "volfrep.cli.slice",
                "volfrep.shell", "volfrep.process", "volfrep.io.read", "volfrep.graphs",
                "volfrep.tpms", "volfrep.sizing", "volfrep.slicing", "volfrep.jobs.infill",
                "volfrep.jobs.part_domain", "volfrep.mechanics.catalogue", "volfrep.trim",
                "volfrep.spatial.rays", "volfrep.design.graphs.files", "volfrep.lattice.deform",
            ],
        ),
    ],
    ids=["import", "version", "block"],
)  # fmt: skip
def test_what_a_start_does_not_load(code: str, unused: list[str], tmp_path: Path) -> None:
    ask = f"{code}\nimport sys\nprint([n for n in {unused!r} if n in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", ask], capture_output=True, text=True, check=True, cwd=tmp_path
    )
    assert done.stdout.splitlines()[-1] == "[]", done.stdout


@pytest.mark.parametrize("command", ["size", "homogenise"])
def test_small_matrices_have_one_thread_where_nothing_says_how_many(
    monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    """Before numpy is loaded, which counts them then."""
    told = []
    for name in MATRIX_THREADS:
        monkeypatch.setenv(name, "0")  # so that it is as before in the end
        monkeypatch.delenv(name)
    output = "made.vtu" if command == "homogenise" else "made.stl"
    for asked, given in (("fill", None), (command, "3"), (command, None)):
        if given is not None:
            monkeypatch.setenv("OMP_NUM_THREADS", given)
        made = ["-o", "made.stl"] if asked == "fill" else ["-o", output, "--loads", "none.toml"]
        assert cli.run([asked, "no_such_part.stl", *made]) == cli.EXIT_BAD_INPUT
        told.append(os.environ.get("OPENBLAS_NUM_THREADS"))
        monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    assert told == [None, None, "1"]


def test_cells(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(["cells"]) == 0
    said = capsys.readouterr().out
    for use in USES.values():
        assert f"\n{use}\n" in said
    rows = {line[:25].strip(): line[25:].split() for line in said.splitlines()}
    for cell in LIBRARY.values():
        figures = [str(len(cell.nodes)), str(len(cell.struts)), str(cell.maxwell_number)]
        assert rows[cell.name][:3] == figures
    assert rows["Octet"][3] == "stretching"
    assert rows["Fluorite"][3:] == ["bending", "Rhombic", "dodecahedron"]


@pytest.mark.skipif(os.name == "nt", reason="needs a shell with pipes")
def test_a_reader_that_stops_early_is_no_error() -> None:
    done = subprocess.run(
        f"(sleep 0.5; {' '.join(COMMAND)} cells) | true",
        shell=True,
        executable="/bin/bash",
        capture_output=True,
        text=True,
    )
    assert done.stderr == ""


# --- bad input ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "required: COMMAND"),
        (["melt"], "invalid choice: 'melt'"),
        (["fill"], "required: PART, -o/--output"),
        (["block", "-o", "x.stl", *LATTICE], "required: --count"),
        (["block", "-o", "x.stl", *LATTICE, "--count", "1,2"], "three whole numbers with commas"),
        (
            ["block", "-o", "x.stl", *LATTICE, "--count", "1,2,2.5"],
            "three whole numbers with commas",
        ),
        (["block", "-o", "x.stl", *LATTICE, "--count", "1,2,3", "--foo"], "--foo"),
        (["block", "--cell-size", "ten"], "'ten' is no length such as 10 or '10 mm'"),
        (["cells", "--all"], "Unrecognized arguments: --all"),
        (["check"], "required: FILE"),
    ],
)
def test_arguments_that_make_no_sense(
    capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    assert message in refused(capsys, *arguments)


def test_resolution_or_deviation(capsys: pytest.CaptureFixture[str]) -> None:
    both = ["--count", "1,1,1", "--resolution", "20", "--deviation", "0.1"]
    assert "not both" in refused(capsys, "block", "-o", "x.stl", *LATTICE, *both)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (["--cell", "Gyrate"], "no unit cell named 'Gyrate'"),
        (["--cell-size", "nan"], "cell size must be a finite number"),
        (["--cell-size", "-1e1"], "cell size must be above 0 mm, not -10"),
        (["--strut-radius", "7"], "too thick for a cell"),
        (["--shell", "-1"], "skin thickness must not be negative"),
        (["--activation", "near"], "There is no 'near': choose touching, centre, inside"),
        (["--boundary", "cut"], "There is no 'cut': choose trim, whole"),
        (["--make", "skin"], "There is no 'skin': choose part, lattice, domain"),
        (["--origin", "0,0,inf"], "origin must be a finite number"),
        (["--resolution", "1"], "resolution must be a whole number"),
        (["--deviation", "-1"], "deviation must be above 0"),
        (["--fillet", "9"], "fillet of 9 mm is too large"),
        (["--density", "0"], "density must be above 0"),
    ],
)
def test_values_that_make_no_sense(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    part: Path,
    changed: list[str],
    message: str,
) -> None:
    arguments = ["fill", part, "-o", tmp_path / "out.stl", *LATTICE, "--shell", "2", *changed]
    assert message in refused(capsys, *arguments)
    assert not (tmp_path / "out.stl").exists()


def test_places_that_cannot_be_written(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fill_to(out: object, *more: object) -> str:
        return refused(capsys, "fill", part, "-o", out, *LATTICE, "--shell", "2", *more)

    assert "'.xyz' is not a known format" in fill_to(tmp_path / "out.xyz")
    assert "name without an extension" in fill_to(tmp_path / "out")
    assert "there is no folder" in fill_to(tmp_path / "none" / "out.stl")
    assert "is not a file" in fill_to(tmp_path)
    good = tmp_path / "out.stl"
    assert "there is no folder" in fill_to(good, "--report", tmp_path / "none" / "r.json")
    assert "cannot both be written" in fill_to(good, "--report", good)
    # As a user without the right to write there (root has every right).
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    assert "permission denied" in fill_to(good)


def test_the_tables_of_files_hold_every_option_that_takes_one(
    capsys: pytest.CaptureFixture[str],
) -> None:
    taken = {"part", "cell", "material", "as_printed"}  # PART, and what takes a name, too
    for command in ("fill", "block", "size", "properties", "infill"):
        with pytest.raises(SystemExit):
            cli.run([command, "--help"])
        usage = capsys.readouterr().out
        flags = re.findall(r"--?([\w-]+) (?:FILE|OUT)\b", usage)
        taken |= {"output" if flag == "o" else flag.replace("-", "_") for flag in flags}
    assert taken == {*run_options.INPUTS, *run_options.OUTPUTS}


def inputs_and_outputs() -> Iterator[tuple[str, str, str]]:
    """What each command could mix up: of the files it reads and of those it writes one each."""
    for command in ("fill", "block", "size"):
        rows = [row for row in run_options.RUN_OPTIONS if command in row.commands]
        of_runs = {row.stored for row in run_options.RUN_OPTIONS if row.reads}
        reads = set(run_options.INPUTS) - of_runs | {row.stored for row in rows if row.reads}
        writes = {row.stored for row in rows if row.writes}
        if command == "block":
            reads -= {"part", "network_file", "network_field", "skin_field"}
        for source in sorted(reads):
            yield from ((command, source, output) for output in sorted(writes))


@pytest.mark.parametrize(
    "way",
    [pytest.param(way, marks=pytest.mark.slow) for way in ("its name", "a symbolic link")]
    + ["a hard link"],
)
@pytest.mark.parametrize(("command", "source", "output"), list(inputs_and_outputs()))
def test_no_output_is_an_input(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    part: Path,
    command: str,
    source: str,
    output: str,
    way: str,
) -> None:
    box = LIBRARY["Box"]
    files = {
        "part": part,
        "spec": tmp_path / "own.toml",
        "cell": tmp_path / "own.json",
        "radius_field": tmp_path / "field.csv",
        "skin_field": tmp_path / "thickness.csv",
        "network_file": tmp_path / "graph.csv",
        "network_field": tmp_path / "dense.csv",
        "material": tmp_path / "metal.toml",
        "loads": tmp_path / "loads.toml",
        "as_printed": tmp_path / "printed.csv",
    }
    files["loads"].write_text("[material]\nname = 'PA12'\n")
    files["material"].write_text("young = 100000.0\npoisson = 0.3\ndensity = 4.0\n")
    files["spec"].write_text("cell_size = 10.0\n")
    save_cell(UnitCell("own", box.nodes, box.struts), files["cell"])
    files["radius_field"].write_text("x,y,z,v\n0,0,0,1\n9,0,0,2\n")
    files["skin_field"].write_text("x,y,z,v\n0,0,0,1\n9,0,0,2\n")
    files["network_file"].write_text("0,0,0,9,9,9")
    files["as_printed"].write_text("inclination,nominal,measured\n0,1,1.1\n90,1,1.0\n")
    files["network_field"].write_text("x,y,z,v\n0,0,0,1\n9,0,0,2\n")
    before = {file: file.read_bytes() for file in files.values()}
    target = files[source]
    if way != "its name":
        target = tmp_path / "other.stl"
        (os.symlink if way == "a symbolic link" else os.link)(files[source], target)
    new = {name: tmp_path / f"new.{name}" for name in run_options.OUTPUTS}
    outputs = new | {"output": tmp_path / "new.stl"} | {output: target}
    arguments = [command, *(["--count", "1,1,1"] if command == "block" else [part, "--shell", 2])]
    arguments += ["-o", outputs["output"], "--report", outputs["report"]]
    arguments += ["--write-spec", outputs["write_spec"], "--spec", files["spec"]]
    arguments += ["--picture", outputs["picture"]]
    if not source.startswith("network"):
        arguments += ["--cell", files["cell"]]
    if command == "size":
        arguments += ["--loads", files["loads"], "--radii", outputs["radii"]]
        arguments += ["--plot", outputs["plot"], "--skin-thinnest", 1]
        arguments += ["--thickness", outputs["thickness"]]
    else:
        arguments += ["--material", files["material"]]
    arguments += ["--strut-radius", 1, "--radius-grading", "field"]
    arguments += ["--radius-field", files["radius_field"], "--radius-curve", "1:1,2:0.8"]
    if source == "as_printed":
        arguments += ["--as-printed", files["as_printed"]]
    if source == "skin_field":
        arguments += ["--skin-field", files["skin_field"]]
    if source == "network_file":
        arguments += ["--network", "file", "--network-file", files["network_file"]]
    if source == "network_field":
        arguments += ["--network", "voronoi", "--network-density", "1 + s"]
        arguments += ["--network-field", files["network_field"]]
    said = refused(capsys, *arguments)
    assert f"is the {run_options.INPUTS[source]} itself" in said
    assert {file: file.read_bytes() for file in files.values()} == before
    assert not list(tmp_path.glob("new.*"))


def test_a_file_with_the_name_of_a_library_cell_is_no_input(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    report = tmp_path / "Box"
    report.write_text("old")
    out = tmp_path / "out.stl"
    assert cli.run(["block", "-o", str(out), *LATTICE, "--count", "1,1,1", "--report", "Box"]) == 0
    assert json.loads(report.read_text())["watertight"]


def test_a_file_to_check_must_be_readable(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert "No such file" in refused(capsys, "check", tmp_path / "missing.stl")
    assert "not a kind of file" in refused(capsys, "check", tmp_path / "part.txt")
    (tmp_path / "empty.stl").touch()
    assert "is empty" in refused(capsys, "check", tmp_path / "empty.stl")
    (tmp_path / "folder.stl").mkdir()
    assert "it is not a file but a folder" in refused(capsys, "check", tmp_path / "folder.stl")


@pytest.mark.parametrize(
    "origin", ["-1e0,0,0", "-1.0,-0,0", "-1.,0e5,0", "-10e-1,0,.0", "-.1e1,0,0"]
)
def test_a_vector_may_begin_with_a_minus(origin: str) -> None:
    options = cli.make_parser().parse_args(["fill", "p.stl", "-o", "x.stl", "--origin", origin])
    assert options.parameter_origin == (-1.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--origin", "5", "0", "0"], "It takes 3 numbers with commas"),
        (["--origin", "-5", "0", "0"], "X,Y,Z, such as -5,0,0"),
        (["--rotate", "0", "0", "1", "30"], "X,Y,Z,DEGREES, such as 0,0,1,30"),
        (["--radius-max", "2"], "--radius-max is called --radius-end now"),
        (["--radius-min=2"], "--radius-min is called --radius-start now"),
        (["--stretch-struts"], "--stretch-struts is called --no-keep-radius now"),
        (["--output", "lattice"], "--make lattice"),
        (["--output=domain"], "--make domain"),
    ],
)
def test_what_earlier_versions_took_is_refused_with_what_to_write(
    capsys: pytest.CaptureFixture[str], part: Path, arguments: list[str], message: str
) -> None:
    assert message in refused(capsys, "fill", part, "-o", "x.stl", *LATTICE, *arguments)


# --- check --------------------------------------------------------------------------------------


def checked(capsys: pytest.CaptureFixture[str], path: Path) -> dict[str, str]:
    assert cli.run(["check", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    return {line[:16].strip(): line[16:].strip() for line in lines}


def test_check_of_a_good_file(capsys: pytest.CaptureFixture[str], part: Path) -> None:
    said = checked(capsys, part)
    assert said["triangles"] == "12"
    assert (said["closed"], said["manifold"], said["bodies"]) == ("yes", "yes", "1")
    assert said["volume"] == "27,000.000 mm3"
    assert said["box"] == "30.000 x 30.000 x 30.000 mm"
    assert said["smallest angle"] == "45.00 degrees"


def test_check_of_broken_surfaces(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "odd.stl"
    write_stl(TriangleMesh(cube().vertices, cube().triangles[1:]), path)
    said = checked(capsys, path)
    assert (said["closed"], said["manifold"]) == ("no (3 open edges)", "no")
    assert "genus" not in said

    moved = TriangleMesh(cube().vertices + 30.0, cube().triangles)
    write_stl(concatenate(cube(), moved), path)
    said = checked(capsys, path)
    assert said["closed"] == "yes"
    assert said["manifold"] == "no (1 vertices where surfaces touch)"

    beside = TriangleMesh(cube().vertices + np.array([30.0, 30.0, 0.0]), cube().triangles)
    write_stl(concatenate(cube(), beside), path)
    assert "1 edges of more than two triangles" in checked(capsys, path)["manifold"]


# --- the work -----------------------------------------------------------------------------------


def test_block(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    out, report = tmp_path / "block.stl", tmp_path / "block.json"
    arguments = ["block", "-o", out, *LATTICE, "--count", "2,1,3", "--report", report]
    assert cli.run([str(argument) for argument in arguments]) == 0
    said = capsys.readouterr()
    assert "cells" in said.out
    assert said.err == ""
    figures = json.loads(report.read_text())
    assert figures["cells_total"] == figures["cells_active"] == 6
    assert (figures["nodes"], figures["struts"]) == (24, 46)
    assert figures["genus"] == 46 - 24 + 1
    assert {"write"} < figures["stages"].keys()
    quality = measure(as_read(read_triangles(out)))
    assert quality.watertight
    assert (quality.bodies, quality.genus) == (1, 23)
    assert quality.triangles == figures["triangles"]
    assert quality.volume == pytest.approx(figures["volume_mm3"], rel=1e-5)


def test_fill(capsys: pytest.CaptureFixture[str], tmp_path: Path, part: Path) -> None:
    out, report = tmp_path / "out.stl", tmp_path / "out.json"
    arguments = ["fill", part, "-o", out, *LATTICE, "--shell", "2", "--report", report, "--quiet"]
    arguments += ["--density", "2.7", "--origin", "-1e0,0,0"]
    assert cli.run([str(argument) for argument in arguments]) == 0
    assert capsys.readouterr().out == ""
    figures = json.loads(report.read_text())
    expected = {
        "cells_total", "cells_active", "nodes", "struts", "triangles", "bodies", "genus",
        "volume_mm3", "relative_density", "mass_g", "watertight", "stages", "peak_memory_mb",
    }  # fmt: skip
    assert expected <= figures.keys()
    assert {"read", "write"} < figures["stages"].keys()
    assert figures["mass_g"] == pytest.approx(figures["volume_mm3"] * 2.7e-3)
    assert figures["spec"]["origin"] == [-1, 0, 0]
    quality = measure(as_read(read_triangles(out)))
    assert (quality.watertight, quality.bodies) == (True, 1)
    assert quality.bounds == pytest.approx(np.array([[-15.0] * 3, [15.0] * 3]))


# --- graded lattices ----------------------------------------------------------------------------

GRADED_BLOCK = ["block", "--cell", "Box", "--cell-size", "10", "--strut-radius", "0.8"]


def said_rows(text: str) -> dict[str, str]:
    return {line[:18].strip(): line[18:].strip() for line in text.splitlines()}


def test_block_of_growing_cells(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    out, report = tmp_path / "block.stl", tmp_path / "block.json"
    arguments = [*GRADED_BLOCK, "-o", out, "--count", "2,1,1", "--resolution", "12"]
    arguments += ["--size-grading", "linear", "--lambda-end", "2", "--report", report]
    arguments += ["--grading-direction", "2,0,0"]
    assert cli.run([str(argument) for argument in arguments]) == 0
    rows = said_rows(capsys.readouterr().out)
    # x (1 + x / 20) takes the faces at 0, 10, 20 mm to 0, 15, 40 mm.
    assert rows["cell edges"] == "10 to 25 mm"
    assert rows["strut lengths"] == "10 to 25 mm"
    assert rows["strut radii"] == "0.8 to 0.8 mm"
    figures = json.loads(report.read_text())
    assert figures["cell_edges_mm"] == pytest.approx([10, 25])
    assert figures["strut_lengths_mm"] == pytest.approx([10, 25])
    assert figures["spec"]["size_grading"]["profile"]["end"] == 2
    mesh = as_read(read_triangles(out))
    assert np.ptp(mesh.vertices[:, 0]) == pytest.approx(40 + 2 * 0.8 * 1.08, abs=0.25)
    assert measure(mesh).watertight


def test_block_turned_with_conical_struts(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    out = tmp_path / "block.stl"
    arguments = [*GRADED_BLOCK, "-o", out, "--count", "2,1,1", "--resolution", "12"]
    arguments += ["--radius-grading", "direction", "--radius-end", "1.2", "--radius-start", "0.6"]
    arguments += ["--rotate", "0,0,-1,90", "--radius-direction", "0,-1,0"]
    arguments += ["--rotate-origin", "0,0,0"]
    assert cli.run([str(argument) for argument in arguments]) == 0
    rows = said_rows(capsys.readouterr().out)
    assert rows["cell edges"] == "10 to 10 mm"
    assert rows["strut radii"] == "0.6 to 1.2 mm"
    low, high = as_read(read_triangles(out)).bounds
    # Two cells that lay along x lie along -y; the thick end, its joints r (1 + r / L), is far out.
    assert high[1] == pytest.approx(0.6 * 1.06, abs=0.1)
    assert low[1] == pytest.approx(-20 - 1.2 * 1.12, abs=0.2)


def test_fill_by_a_field(capsys: pytest.CaptureFixture[str], tmp_path: Path, part: Path) -> None:
    table = tmp_path / "field.csv"
    table.write_text("x,y,z,a,b\n-15,0,0,-5,1\n15,0,0,5,1\n")
    out, report = tmp_path / "out.stl", tmp_path / "out.json"
    arguments = ["fill", part, "-o", out, *LATTICE, "--shell", "2", "--resolution", "14"]
    arguments += ["--radius-grading", "field", "--radius-field", table, "--radius-column", "a"]
    arguments += ["--radius-curve", "-5:0.6,5:1.1", "--report", report]
    assert cli.run([str(argument) for argument in arguments]) == 0
    assert capsys.readouterr().err == ""
    figures = json.loads(report.read_text())
    least, most = figures["strut_radii_mm"]
    assert 0.6 <= least < 0.7
    assert 1.0 < most <= 1.1
    assert figures["spec"]["radius_grading"]["field"] == f"2 points of {table.name}"
    assert measure(as_read(read_triangles(out))).bodies == 1


def test_fill_about_an_axis(tmp_path: Path, part: Path) -> None:
    out, report = tmp_path / "out.stl", tmp_path / "out.json"
    arguments = ["fill", part, "-o", out, "--cell", "Box", "--cell-size", "10", "--shell", "2"]
    arguments += ["--strut-radius", "0.6", "--resolution", "12", "--cell-map", "cylindrical"]
    arguments += ["--map-around", "9", "--map-centre", "0,0,5", "--map-axis", "0,0,1"]
    arguments += ["--no-keep-radius", "--report", report, "--quiet"]
    assert cli.run([str(argument) for argument in arguments]) == 0
    figures = json.loads(report.read_text())
    assert figures["grid"][1] == 9
    assert figures["spec"]["keep_radius"] is False
    # Chords of a ninth of a turn, as far out as the box's corners at the most.
    assert figures["cell_edges_mm"][1] <= 2 * 30 * np.sin(np.pi / 9)
    assert measure(as_read(read_triangles(out))).bodies == 1


LINEAR = ["--size-grading", "linear", "--lambda-end", "2"]
BY_X = ["--radius-grading", "direction", "--radius-end", "1.2"]
BY_FIELD = ["--radius-grading", "field"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--size-grading", "cubic"], "There is no 'cubic': choose none, scalar"),
        (["--size-grading", "linear"], "needs --lambda-end"),
        (["--size-grading", "formula"], "needs --lambda-formula"),
        (["--size-grading", "formula", "--lambda-formula", "1 + t"], "'t'"),
        (["--size-grading", "linear", "--lambda-end", "0.4"], "folds the lattice at s ="),
        ([*LINEAR, "--lambda-start", "-1"], "start must be above 0, not -1"),
        ([*LINEAR, "--grading-direction", "0,0,0"], "grading direction must not be zero"),
        (["--lambda-end", "2"], "--lambda-end has no effect without --size-grading"),
        (
            ["--lambda-formula", "1 + s"],
            "--lambda-formula has no effect without --size-grading formula",
        ),
        (["--grading-direction", "1,0,0"], "no effect without --size-grading"),
        (["--no-keep-radius"], "--no-keep-radius has no effect without --size-grading or"),
        (["--radius-grading", "direction"], "needs --radius-start or --radius-end"),
        (["--radius-end", "1.2"], "--radius-end has no effect without --radius-grading"),
        ([*BY_X, "--radius-reach", "4"], "no effect without --radius-grading skin or core"),
        ([*BY_X, "--radius-field", "f.csv"], "no effect without --radius-grading field"),
        ([*BY_X, "--radius-formula", "1"], "no effect without --radius-profile formula"),
        ([*BY_X, "--radius-profile", "formula"], "no effect without --radius-profile linear"),
        ([*BY_X[:2], "--radius-profile", "formula"], "needs --radius-formula"),
        ([*BY_X, "--radius-end", "9"], "too thick for a cell"),
        (["--radius-grading", "skin", "--radius-end", "1.2"], "no skin to grade the radius by"),
        ([*BY_FIELD, "--radius-end", "1.2"], "a CSV or VTK file"),
        ([*BY_FIELD, "--radius-field", "none.csv", "--radius-end", "1.2"], "none.csv"),
        ([*BY_FIELD, "--radius-curve", "1:0.5,2"], "part '2' is no pair"),
        (
            [*BY_FIELD, "--radius-curve", "0:1,1:2", "--radius-end", "1"],
            "has no effect with --radius-curve",
        ),
        ([*BY_FIELD, "--radius-profile", "linear"], "no effect without --radius-grading direction"),
        (["--rotate", "0,0,0,9"], "axis of the rotation must not be zero"),
        (["--rotate", "0,0,9"], "takes 4 numbers with commas"),
        (["--rotate-origin", "0,0,0"], "no effect without --rotate"),
        (["--cell-map", "toroidal"], "There is no 'toroidal': choose cartesian"),
        (["--cell-map", "cylindrical", "--map-around", "2"], "whole number from 4"),
        (["--map-axis", "0,0,1"], "no effect without --cell-map"),
    ],
)
def test_gradings_that_make_no_sense(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, options: list[str], message: str
) -> None:
    out = tmp_path / "out.stl"
    said = refused(capsys, *GRADED_BLOCK, "-o", out, "--count", "2,2,2", *options)
    assert message in said
    assert not out.exists()


def test_a_part_that_cannot_be_read(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for name, content in (("missing.stl", None), ("empty.stl", b""), ("text.stl", b"hello\n" * 99)):
        path = tmp_path / name
        if content is not None:
            path.write_bytes(content)
        out = tmp_path / "out.stl"
        assert name in refused(capsys, "fill", path, "-o", out, *LATTICE, "--shell", "2")


def test_not_enough_memory(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def greedy(*_: Any, **__: Any) -> None:
        raise MemoryError

    monkeypatch.setattr("volfrep.jobs.kinds.octant_block.OctantBlock.write_stl", greedy)
    arguments = ["block", "-o", tmp_path / "x.stl", *LATTICE, "--count", "1,1,1"]
    assert "not enough memory" in refused(capsys, *arguments)


#: The command, which stops for good while it writes, as soon as its unfinished file is there.
HELD = """
import pathlib, sys, time
from volfrep.__main__ import main
from volfrep.util.progress import Monitor
from volfrep.util.threads import MATRIX_THREADS

tick = Monitor.tick

def hold(self, fraction=None):
    tick(self, fraction)
    if list(pathlib.Path().glob(".volfrep-*.part")):
        print("writing", flush=True)
        time.sleep(600)

Monitor.tick = hold
sys.exit(main())
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for another process")
def test_ctrl_c_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "block.stl").write_bytes(b"old")
    arguments = ["block", "-o", "block.stl", "--quiet", *LATTICE, "--count", "4,4,4"]
    running = subprocess.Popen(
        [sys.executable, "-c", HELD, *arguments],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        # A shell starts what it puts into the background with SIGINT ignored, tests included.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert running.stdout is not None
    assert running.stdout.readline() == b"writing\n"
    assert len(os.listdir(tmp_path)) == 2
    running.send_signal(signal.SIGINT)
    _, said = running.communicate(timeout=300)
    assert running.returncode == 130
    assert said == b"volfrep: Interrupted, no file was left half-written.\n"
    assert os.listdir(tmp_path) == ["block.stl"]
    assert (tmp_path / "block.stl").read_bytes() == b"old"


@pytest.mark.costly
def test_open_planes_and_drain_holes(
    part: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = tmp_path / "report.json"
    common = ["fill", str(part), *LATTICE, "--shell", "3", "-o", str(tmp_path / "x.stl")]
    common += ["--report", str(report)]
    assert cli.run([*common, "--open-plane", "0,0,-15,0,0,-1"]) == 0
    assert json.loads(report.read_text())["voids"] == 0
    holes = ["--drain-count", "1", "--drain-diameter", "1.5", "--build-direction", "-1,0,0"]
    assert cli.run([*common, *holes]) == 0
    figures = json.loads(report.read_text())
    assert figures["voids"] == 0
    ((x, _, _),) = figures["drain_holes"]
    assert f"1 at ({x:.4g}," in capsys.readouterr().out
    assert figures["spec"]["drains"]["build_direction"] == [-1.0, 0.0, 0.0]


@pytest.mark.parametrize("at", [1e4, 1e6, 1e308])
def test_a_network_far_from_the_origin_keeps_its_volume_or_is_refused(
    at: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, out = tmp_path / "far.json", tmp_path / "far.stl"
    source.write_text(json.dumps({"nodes": [[at, 0, 0], [at, 37, 0]], "struts": [[0, 1]]}))
    asked = ["network", str(source), "-o", str(out), "--strut-radius", "0.5"]
    if at > 1e5:
        assert "mm from the origin" in refused(capsys, *asked)
        return
    assert cli.run(asked) == 0
    # Closed form: a cylinder and, beyond its ends, all but a little of two half balls.
    volume = trimesh.load_mesh(out).volume
    assert volume == pytest.approx(np.pi * 0.25 * 37.0 + np.pi / 6.0, rel=0.01)


@pytest.mark.costly
def test_properties_of_a_cell_that_is_not_cubic(
    capsys: pytest.CaptureFixture[str],
) -> None:
    asked = ["--cell-size", "10", "--strut-radius", "1", "--voxels", "32"]
    assert cli.run(["properties", "Columns", *asked]) == 0
    told = said_rows(capsys.readouterr().out)
    assert not {"E along [100]", "Zener anisotropy", "Poisson's ratio", "strength"} & set(told)
    assert told["E along x"] == told["E along y"] == "0: it carries nothing that way"
    # Closed form: five prisms of the cell carry side by side, of which four are shared by four.
    assert float(told["E along z"].split()[0]) == pytest.approx(2 * np.pi / 100.0, rel=0.02)
    assert told["strength along z"].startswith("0.06")
    assert cli.run(["properties", "BCC", *asked]) == 0
    assert {"E along [100]", "Zener anisotropy", "strength"} <= set(
        said_rows(capsys.readouterr().out)
    )


@pytest.mark.slow
def test_targets_that_no_radius_meets(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    part = tmp_path / "part.stl"
    write_stl(samples.box((20.0, 20.0, 20.0)), part)

    def said(*options: str) -> str:
        lattice = ["--cell", "Box", *options, "-o", tmp_path / "x.stl"]
        return refused(capsys, "fill", part, *lattice)

    # Struts along the edges of 18 mm, and 2 mm in the part's middle for them.
    beyond = said("--cell-size", "18", "--shell", "9", "--relative-density", "0.1")
    assert "'Box' of 18 mm reaches the 8 mm3 that there are for the lattice" in beyond
    inside = ["--cell-size", "10", "--shell", "1"]
    least = said(*inside, "--relative-density", "0.000001").split(" choose one from ")[1]
    # Closed form: three lines of 18 mm of the thinnest struts, 1.5 / 400 cells, cross the room.
    thinnest = 3.0 * np.pi * 0.0375**2 / 18.0**2
    assert float(least.split()[0]) == pytest.approx(thinnest, rel=0.2)
    # Fillets at struts that are thinner than any told by the first, rough table.
    assert "choose one from" in said(*inside, "--fillet", "1", "--relative-density", "0.00036")


@pytest.mark.slow
def test_walls_are_drained_where_none_stands_in_the_hole(tmp_path: Path) -> None:
    part, out, report = (tmp_path / name for name in ("part.stl", "x.stl", "report.json"))
    write_stl(samples.box((20.0, 20.0, 20.0)), part)
    walls = ["--cell", "Gyroid", "--wall-kind", "skeleton", "--cell-size", "10"]
    holes = ["--shell", "1", "--drain-count", "3", "--drain-diameter", "3"]
    asked = [*walls, *holes, "--resolution", "14", "--report", str(report)]
    assert cli.run(["fill", str(part), "-o", str(out), *asked]) == 0
    places = np.array(json.loads(report.read_text())["drain_holes"])
    assert len(places) == 3
    assert (places[:, 2] == 0.0).all()
    made = trimesh.load_mesh(out)
    # One surface: no void is closed any more.
    assert made.is_watertight
    assert made.body_count == 1
    angle = np.linspace(0.0, 2.0 * np.pi, 13)
    rim = 1.35 * np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    mouths = (places[:, None] + rim + [0.0, 0.0, 1.3]).reshape(-1, 3)
    mesh = TriangleMesh(np.array(made.vertices), np.array(made.faces, np.int32))
    assert not inside_points(mesh, mouths, Monitor()).any()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--open-plane", "0,0,0,0,0"], "--open-plane: It takes 6 numbers"),
        (["--open-plane", "a,0,0,0,0,1"], "is not numbers with commas"),
        (["--drain", "0,0", "--drain-diameter", "2"], "--drain: It takes 3 or 6 numbers"),
        (["--drain", "0,0,0"], "no effect without --drain-diameter"),
        (["--drain-diameter", "2"], "need places, or a count"),
    ],
)
def test_openings_that_make_no_sense(
    part: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    options: list[str],
    message: str,
) -> None:
    command = ["fill", str(part), *LATTICE, "--shell", "1", "-o", str(tmp_path / "x.stl")]
    assert cli.run([*command, *options]) == 2
    assert message in capsys.readouterr().err


def test_a_defect_is_one_sentence_and_its_traceback_a_file(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from volfrep.jobs.kinds.octant_block import OctantBlock

    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("by accident")

    monkeypatch.setattr(OctantBlock, "write_stl", broken)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    out = tmp_path / "block.stl"
    out.write_bytes(b"the old file")
    arguments = ["block", "-o", str(out), *LATTICE, "--count", "1,1,1", "--quiet"]
    assert cli.run(arguments) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "ZeroDivisionError (by accident)" in said
    log = Path(said.split("'")[-2])
    assert log.parent == tmp_path
    assert "in broken" in log.read_text()
    assert out.read_bytes() == b"the old file"
