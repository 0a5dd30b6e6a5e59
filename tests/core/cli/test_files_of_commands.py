# SPDX-License-Identifier: LGPL-2.1-or-later
"""What commands read and write: no input is lost, nothing is left, and no file holds them up."""

import json
import os
import shutil
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import trimesh

from command import run
from volfrep.studies import page

LATTICE = ("--cell", "BCC", "--cell-size", 10, "--strut-radius", 1)
SOON = 20  # seconds


@contextmanager
def soon() -> Iterator[None]:
    """Ends with an error what takes too long, as reading a pipe would."""

    def late(*_: object) -> None:
        raise AssertionError("it does not come to an end")

    signal.signal(signal.SIGALRM, late)
    signal.alarm(SOON)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, signal.SIG_DFL)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    trimesh.creation.box((20, 20, 20)).export("part.stl")
    return tmp_path


def refused(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    with soon():
        assert run(*arguments) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    return said


def study(text: str = "") -> None:
    Path("study.toml").write_text(
        'part = "part.stl"\ndo = ["forecast"]\n' + text
        + '[fixed]\ncell_size = 10\nstrut_radius = 1\n[vary]\ncell = ["BCC", "CVC"]\n'
    )  # fmt: skip


@pytest.mark.parametrize("table", ["runs.csv", "index.html"])
@pytest.mark.parametrize("way", ["symlink", "link"])
def test_a_study_does_not_write_over_its_part(way, table, here, capsys) -> None:
    study()
    getattr(os, way)("part.stl", table)
    before = (here / "part.stl").read_bytes()
    said = refused(capsys, "sweep", "study.toml", "-o", ".")
    assert f"{table}'" in said
    assert "the part itself" in said
    assert (here / "part.stl").read_bytes() == before


def test_a_study_does_not_write_over_its_field(here, capsys) -> None:
    study()
    text = (here / "study.toml").read_text()
    grading = 'radius_grading = "field"\nradius_field = "runs.csv"\nradius_curve = "1:1,3:0.8"\n'
    (here / "study.toml").write_text(text.replace("[vary]", grading + "[vary]"))
    (here / "runs.csv").write_text("x,y,z,v\n0,0,0,1\n9,9,9,2\n0,9,0,3\n9,0,9,1\n")
    before = (here / "runs.csv").read_bytes()
    assert "the field file itself" in refused(capsys, "sweep", "study.toml", "-o", ".")
    assert (here / "runs.csv").read_bytes() == before


def test_a_study_does_not_write_over_its_own_file(here, capsys) -> None:
    study()
    os.replace("study.toml", "index.html")
    before = (here / "index.html").read_bytes()
    assert "the study itself" in refused(capsys, "sweep", "index.html", "-o", ".")
    assert (here / "index.html").read_bytes() == before


@pytest.mark.costly
def test_a_run_of_a_study_does_not_write_over_what_the_study_reads(studied, capsys) -> None:
    record = next((studied / "runs" / "records").iterdir())
    record.unlink()
    os.link("part.stl", record)
    before = (studied / "part.stl").read_bytes()
    assert "the part itself" in refused(capsys, "sweep", "study.toml", "-o", "runs")
    assert (studied / "part.stl").read_bytes() == before


def test_files_that_only_the_specification_names_are_kept(here, capsys) -> None:
    trimesh.creation.box((6, 6, 6)).export("solid.stl")
    Path("spec.toml").write_text(
        'cell_size = 10.0\nstrut_radius = 1.0\nkeep_solid = ["solid.stl"]\n'
    )
    before = (here / "solid.stl").read_bytes()
    said = refused(capsys, "fill", "part.stl", "--spec", "spec.toml", "-o", "solid.stl")
    assert "itself" in said
    assert (here / "solid.stl").read_bytes() == before


def slices(here: Path, *more: object) -> list[str]:
    assert run("slice", "part.stl", "-o", "layers", *LATTICE, "--quiet", *more) == 0
    return sorted(path.name for path in (here / "layers").iterdir())


@pytest.mark.costly
def test_slices_take_away_the_last_run_and_nothing_else(here) -> None:
    assert slices(here, "--layer", 4)[:5] == [f"layer_{k:06d}.png" for k in range(5)]
    mine = here / "layers" / "notes.txt"
    mine.write_text("mine")
    (here / "layers" / "layer_000009.txt").mkdir()
    table = json.loads((here / "layers" / "layers.json").read_text())
    table["layers"] += [{"file": "notes.txt"}, {"file": "../part.stl"}]  # it says too much
    (here / "layers" / "layers.json").write_text(json.dumps(table))
    left = slices(here, "--layer", 10, "--format", "svg")
    assert left == [
        "layer_000000.svg", "layer_000001.svg", "layer_000009.txt", "layers.json", "notes.txt",
    ]  # fmt: skip
    assert mine.read_text() == "mine"
    assert (here / "part.stl").exists()


@pytest.mark.costly
def test_slices_do_not_write_over_a_strangers_file(here, capsys) -> None:
    slices(here, "--layer", 10, "--format", "svg")
    (here / "layers" / "part.cli").write_text("mine")
    more = ("--layer", 10, "--format", "cli")
    assert "move it away" in refused(capsys, "slice", "part.stl", "-o", "layers", *LATTICE, *more)
    assert (here / "layers" / "part.cli").read_text() == "mine"
    assert len(list((here / "layers").iterdir())) == 4


@pytest.mark.costly
def test_what_a_killed_slice_leaves_is_known_to_the_next(here, monkeypatch) -> None:
    class KilledError(BaseException):
        pass

    slices(here, "--layer", 4)
    (here / "layers" / "notes.txt").write_text("mine")
    replace, put = os.replace, []

    def dies(source, target):
        put.append(target)
        if len(put) == 3:  # the table of both, then the first layer
            raise KilledError
        replace(source, target)

    monkeypatch.setattr(os, "replace", dies)
    with pytest.raises(KilledError):
        slices(here, "--layer", 10)
    monkeypatch.setattr(os, "replace", replace)
    (here / "layers" / ".volfrep-0123abcd.part").mkdir()  # of one that could not even end
    left = slices(here, "--layer", 10, "--format", "svg")
    assert left == ["layer_000000.svg", "layer_000001.svg", "layers.json", "notes.txt"]


@pytest.mark.parametrize("command", ["fill", "slice"])
def test_what_is_refused_leaves_no_specification(command, here, capsys) -> None:
    more = ("--layer", 5) if command == "slice" else ()
    Path("bad.stl").write_text("nothing of the kind")
    out = "out.stl" if command == "fill" else "out"
    refused(capsys, command, "bad.stl", "-o", out, *LATTICE, "--write-spec", "s.toml", *more)
    assert not Path("s.toml").exists()
    assert run(command, "part.stl", "-o", out, *LATTICE, "--write-spec", "s.toml", *more) == 0
    assert "cell_size = 10" in Path("s.toml").read_text()


#: Each kind of file that is read, and a command that reads it.
READERS = {
    "loads.toml": ("size", "part.stl", "-o", "o.stl", *LATTICE, "--loads", "loads.toml"),
    "spec.toml": ("block", "-o", "o.stl", "--count", "1,1,1", "--spec", "spec.toml"),
    "material.json": ("properties", "BCC", *LATTICE[2:], "--material", "material.json"),
    "material.toml": ("properties", "BCC", *LATTICE[2:], "--material", "material.toml"),
    "study.toml": ("sweep", "study.toml", "-o", "runs"),
    "catalogue.txt": ("cells", "catalogue.txt"),
    "cell.json": ("properties", "cell.json", *LATTICE[2:]),
    "net.csv": ("network", "net.csv", "-o", "o.stl", "--strut-radius", 1),
    "in.stl": ("check", "in.stl"),
    "field.csv": (
        "block", "-o", "o.stl", "--count", "1,1,1", *LATTICE, "--radius-grading", "field",
        "--radius-field", "field.csv", "--radius-curve", "1:1,2:0.8",
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", ["pipe", "device", "folder"])
@pytest.mark.parametrize("name", READERS)
def test_what_is_no_file_is_refused_at_once(name, kind, here, capsys) -> None:
    if kind == "pipe":
        os.mkfifo(name)
    elif kind == "device":
        os.symlink("/dev/zero", name)
    else:
        Path(name).mkdir()
    said = refused(capsys, *READERS[name])
    assert name in said
    assert "it is not a file but a" in said


@pytest.mark.parametrize("name", ["loads.toml", "spec.toml", "material.json", "cell.json"])
def test_what_is_no_text_is_refused(name, here, capsys) -> None:
    Path(name).write_bytes(b"a = '\xff'")
    assert "is no text in UTF-8" in refused(capsys, *READERS[name])


def test_a_study_has_steps_that_can_be_counted(here, capsys) -> None:
    study()
    text = (here / "study.toml").read_text()
    (here / "study.toml").write_text(text + "shell = { from = 1, to = 2, steps = 1000000000 }\n")
    assert "1,000,000,000 designs" in refused(capsys, "sweep", "study.toml", "-o", "runs")


DEEP = "[" * 200_000


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a study and what it made, without plots: `test_page` looks at these."""
    folder = tmp_path_factory.mktemp("done")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        patch.setattr(page, "plots_of", lambda *_: [])
        trimesh.creation.box((20, 20, 20)).export("part.stl")
        study()
        assert run("sweep", "study.toml", "-o", "runs", "--quiet") == 0
    return folder


@pytest.fixture
def studied(done: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of it, whose page is written without plots, too."""
    shutil.copytree(done, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(page, "plots_of", lambda *_: [])
    return tmp_path


@pytest.mark.costly_cases("text0")
@pytest.mark.slow_but("text0", "results")
@pytest.mark.parametrize(
    "text", [DEEP, "[]", "3", "{}", '{"key": 1}', "", b"\xff\xfe", "values", "results", "errors"]
)
def test_a_damaged_record_is_done_anew_and_told(text, studied, capsys) -> None:
    first = (studied / "runs" / "runs.csv").read_text()
    record = sorted((studied / "runs" / "records").iterdir())[0]
    if text in ("values", "results", "errors"):
        text = json.dumps(json.loads(record.read_text()) | {text: 7})
    record.write_bytes(text if isinstance(text, bytes) else text.encode())
    capsys.readouterr()
    with soon():
        assert run("sweep", "study.toml", "-o", "runs") == 0
    told = capsys.readouterr()
    assert f"'{record}' is damaged" in told.err
    assert "done anew" in told.err
    assert "1 design" in told.out
    rows = [line.split(",") for line in (studied / "runs" / "runs.csv").read_text().splitlines()]
    assert [row[:5] for row in rows] == [row.split(",")[:5] for row in first.splitlines()]


@pytest.mark.costly
def test_a_damaged_part_of_a_study_is_written_anew(studied) -> None:
    part = next((studied / "runs" / "parts").iterdir())
    part.write_bytes(part.read_bytes()[:100])
    next((studied / "runs" / "records").iterdir()).unlink()
    assert run("sweep", "study.toml", "-o", "runs", "--quiet") == 0
