# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forms of output: one table, by which the command, `Part.save` and studies write alike."""

from __future__ import annotations

from pathlib import Path

import dummy_form
import pytest
import trimesh

import command
import volfrep
import volfrep.cli.run_options  # whose sentences name the forms there are when it is read
from volfrep import VolfrepError
from volfrep.io.write.stl import write_stl
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.output import form as table
from volfrep.output.form import FORMS, find_form, words
from volfrep.output.writer import Writer, writer_of

LATTICE = {"cell": "BCC", "cell_size": 10.0, "strut_radius": 1.0, "resolution": 8}
OPTIONS = ["--cell", "BCC", "--cell-size", 10, "--strut-radius", 1, "--resolution", 8]


@pytest.fixture(scope="module")
def part() -> volfrep.Part:
    return volfrep.fill(trimesh.creation.box((20, 20, 10)), shell=1, **LATTICE)


@pytest.fixture(scope="module")
def solid(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("solid") / "solid.stl"
    box = trimesh.creation.box((20, 20, 10))
    write_stl(TriangleMesh(box.vertices, box.faces.astype("int32")), path)
    return path


@pytest.mark.costly
def test_a_form_is_one_class_and_one_row(
    part: volfrep.Part,
    solid: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The command, the API and a study write it, and say what it has to say."""
    monkeypatch.setattr(table, "FORMS", (*FORMS, dummy_form.ROW))
    assert command.run("fill", solid, "-o", tmp_path / "a.xyz", *OPTIONS, "--shell", 1) == 0
    told = capsys.readouterr()
    assert "Points have no triangles." in told.err
    assert "triangles" in told.out
    assert part.save(tmp_path / "b.xyz") == ("Points have no triangles.",)
    lines = (tmp_path / "b.xyz").read_text().splitlines()
    assert len(lines) == part.report.vertices
    assert (tmp_path / "a.xyz").read_text().splitlines() == lines
    study = volfrep.Study((solid,), fixed={**LATTICE, "shell": 1.0}, do=("export",), export=".xyz")
    made = volfrep.sweep(study, tmp_path / "study", workers=1)
    assert made.table.column("error") == [None]
    file = tmp_path / "study" / made.table.column("export.file")[0]
    assert file.read_text().splitlines() == lines


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.name)
def test_rows_are_whole(form: table.Form) -> None:
    assert isinstance(writer_of(form), Writer)
    assert [one.name for one in FORMS].count(form.name) == 1
    assert all(suffix.startswith(".") for suffix in form.suffixes)
    assert bool(form.word) == bool(form.option)
    name = "layers" if form.is_folder else f"part{form.suffixes[-1].upper()}"
    assert find_form(name, form.name) is form


def test_the_first_row_of_an_extension_is_the_usual_one() -> None:
    assert [find_form(f"a{end}").name for end in (".stp", ".inp", ".3MF")] == ["step", "inp", "3mf"]
    assert words("step")[0] == "faceted"


@pytest.mark.parametrize(
    ("name", "word", "message"),
    [
        ("a.foo", None, r"the extension '\.foo' is not a known format, use \.stl,"),
        ("a", None, "a name without an extension is not a known format"),
        ("a.stl", "beams", "its extension stands for stl"),
        ("a.3mf", "exact", "its extension stands for mesh, both or beams"),
        ("a.xyz", "exact", r"give it the extension \.step"),
    ],
)
def test_what_there_is_no_form_of(name: str, word: str | None, message: str) -> None:
    with pytest.raises(VolfrepError, match=message):
        find_form(name, word)


def test_a_part_is_saved_in_every_form_that_needs_no_other_program(
    part: volfrep.Part, tmp_path: Path
) -> None:
    said = part.save(tmp_path / "beams.3mf", "beams")
    assert "beam lattice extension" in said[-1]
    part.save(tmp_path / "both.3mf", "both")
    part.save(tmp_path / "axes.step", "wireframe")
    assert "POLYLINE(" in (tmp_path / "axes.step").read_text()
    part.save(tmp_path / "beams.inp", material="STEEL,210000,0.3")
    assert "210000" in (tmp_path / "beams.inp").read_text()
    part.save(tmp_path / "layers", "svg", layer=2.0)
    assert len(list((tmp_path / "layers").glob("layer_*.svg"))) == 5
    with pytest.raises(VolfrepError, match="Layers need a height"):
        part.save(tmp_path / "layers", "png")


@pytest.mark.parametrize("form", ["wireframe", "beams"])
def test_forms_of_axes_have_no_fillets(tmp_path: Path, form: str) -> None:
    rounded = volfrep.block((1, 1, 1), fillet=0.5, **LATTICE)
    name = "a.inp" if form == "beams" else "a.step"
    with pytest.raises(VolfrepError, match="set the fillet to 0"):
        rounded.save(tmp_path / name, form)
    assert list(tmp_path.iterdir()) == []
