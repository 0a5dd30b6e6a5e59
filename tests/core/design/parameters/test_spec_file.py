# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specifications as files: read as they were written, and refused in one sentence."""

import sys
from pathlib import Path

import numpy as np
import pytest

from volfrep.design.cells import LIBRARY, UnitCell
from volfrep.design.drawn_cell import save_cell
from volfrep.design.openings import OpenPatch
from volfrep.design.parameters.spec_file import read_spec, read_values, write_spec
from volfrep.design.parameters.specification import specification
from volfrep.design.spec import LatticeSpec
from volfrep.util.errors import VolfrepError

FIELD = "x,y,z,a,b\n0,0,0,1,5\n10,0,0,2,6\n"
SPECIFICATIONS = {
    "plain": {},
    "numbers that decimals do not hold": {"cell_size": 10 / 3, "strut_radius": 0.1 + 0.2},
    "openings": {
        "open_plane": ((0, 0, -5, 0, 0, 1), (1, 2, 3, 1, 1, 1)), "drain_diameter": 2.0,
        "drain": ((1.0, 2.0, 3.0), (0.0, 0.0, 5.0, 1.0, 0.0, 0.0)),
        "build_direction": (-1.0, 0.0, 0.0),
    },
    "growing": {"size_grading": "exponential", "lambda_start": 0.5, "lambda_end": 0.9},
    "by formulas": {
        "size_grading": "formula", "lambda_formula": "1 + s ** 2", "radius_grading": "core",
        "radius_profile": "formula", "radius_formula": "0.5 + 0.2 * s", "radius_reach": 4.0,
    },
    "about an axis, turned": {
        "cell_map": "cylindrical", "map_around": 9, "map_centre": (0.0, 0.0, 5.0),
        "keep_radius": False, "rotate": (1.0, 0.0, 0.0, -30.0), "rotate_origin": (1.0, 1.0, 1.0),
    },
    "no skin": {"shell": 0.0, "make": "lattice", "resolution": 12, "origin": (-1.0, 0.0, 1e-9)},
}  # fmt: skip


@pytest.mark.parametrize("values", SPECIFICATIONS.values(), ids=SPECIFICATIONS)
def test_what_is_written_is_read_again(tmp_path: Path, values: dict[str, object]) -> None:
    spec = specification(values)
    path = tmp_path / "spec.toml"
    write_spec(spec, path)
    assert read_spec(path).as_dict() == spec.as_dict()
    assert set(values) - {"drain"} <= set(read_values(path))


def test_files_are_named_from_the_folder_of_the_specification(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "job"
    folder.mkdir()
    (folder / "stress.csv").write_text(FIELD)
    own = UnitCell("own", LIBRARY["BCC"].nodes, LIBRARY["BCC"].struts)
    save_cell(own, folder / "own.json")
    path = folder / "spec.toml"
    path.write_text(
        'cell = "own.json"\nradius_grading = "field"\nradius_field = "stress.csv"\n'
        'radius_column = "b"\nradius_curve = "5:0.5, 6:0.8"\n'
    )
    monkeypatch.chdir(tmp_path)
    spec = read_spec(path)
    assert spec.unit_cell().name == "own"
    write_spec(spec, folder / "again.toml")
    moved = tmp_path / "moved"
    folder.rename(moved)
    again = read_spec(moved / "again.toml")
    assert again.unit_cell().name == "own"
    assert again.radius_grading.column == "b"
    assert again.radius_grading.curve == ((5.0, 0.5), (6.0, 0.8))
    assert again.radius_grading.field.values == pytest.approx([5, 6])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("cellsize = 10", "unknown entry 'cellsize': the nearest is 'cell_size'"),
        ("radius_max = 1", "unknown entry 'radius_max': the nearest is 'radius_"),
        ("[cell]\nsize = 10", "cell: {'size': 10} is no text"),
        ("cell = 5", "cell: 5 is no text: put it between quotation marks"),
        ('cell_size = "10 kg"', "cell_size: '10 kg' has the unit 'kg', which is no unit of it"),
        ('cell_size = "ten"', "'ten' is no length such as 10 or '10 mm'"),
        ("cell_size = true", "True is no length"),
        ('density = "1 mm"', "use g/cm3, kg/m3"),
        ('drain_count = "2 mm"', "it is a plain number"),
        ("resolution = 12.5", "'12.5' is no whole number"),
        ("remove_dangling = 1", "1 is neither true nor false"),
        ('boundary = "cut"', "There is no 'cut': choose trim, whole"),
        ("origin = [1, 2]", "origin: It takes 3 numbers"),
        ("origin = 5", "5 is no list such as [-5, 0, 0]"),
        ("drain = [1, 2, 3]", "no list of lists such as [[0, 0, 10]]"),
        ("rotate = [0, 0, 1, true]", "is not numbers with commas"),
        (f"cell_size = 1{'0' * 400}", "cell_size: It is too large a number"),
        (f"origin = [1{'0' * 400}, 0, 0]", "is not numbers with commas"),
        ("cell_size = 1e999", "must be a finite number"),
        ('resolution = "inf"', "'inf' is no whole number"),
        ("strut_radius = nan", "must be a finite number"),
        ("strut_radius = 9", "too thick for a cell"),
        ("resolution = 12\ndeviation = 0.1", "not both"),
        ("radius_reach = 4", "radius_reach has no effect without radius_grading skin or core"),
        ('size_grading = "linear"', "size_grading linear needs lambda_end: give it"),
        ('cell_size = ', "is no TOML"),
        ("a" * 1_000_001, "has 1,000,001 bytes"),
        ("x = " + "[" * 100_000, "is no TOML"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_one_sentence(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(text)
    with pytest.raises(VolfrepError) as caught:
        read_spec(path)
    said = str(caught.value)
    assert message in said
    assert str(path) in said
    assert "\n" not in said


def test_what_is_no_file_or_no_text_is_refused(tmp_path: Path) -> None:
    with pytest.raises(VolfrepError, match="No such file"):
        read_spec(tmp_path / "none.toml")
    (tmp_path / "bytes.toml").write_bytes(b"cell = '\xff'")
    with pytest.raises(VolfrepError, match="no text in UTF-8"):
        read_spec(tmp_path / "bytes.toml")
    with pytest.raises(VolfrepError, match="there is no folder"):
        write_spec(LatticeSpec(), tmp_path / "none" / "x.toml")


def test_what_no_file_can_say_is_refused(tmp_path: Path) -> None:
    nameless = UnitCell("mine", LIBRARY["BCC"].nodes, LIBRARY["BCC"].struts)
    picked = LatticeSpec(open_faces=(OpenPatch(np.zeros((1, 3, 3))),))
    for spec, message in ((LatticeSpec(cell=nameless), "has no file"), (picked, "picked")):
        with pytest.raises(VolfrepError, match=message):
            write_spec(spec, tmp_path / "x.toml")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("value", "mm"), [('"2 cm"', 20), ('"1 in"', 25.4), ("7", 7), ('"0.5e1mm"', 5)]
)
def test_lengths_may_have_a_unit(tmp_path: Path, value: str, mm: float) -> None:
    path = tmp_path / "spec.toml"
    path.write_text(f"cell_size = {value}\nstrut_radius = 0.1\n")
    assert read_spec(path).cell_size == pytest.approx(mm)


def test_without_a_reader_of_toml_a_sentence_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As with Python 3.10, which has none of its own."""
    path = tmp_path / "spec.toml"
    path.write_text("cell_size = 8\n")
    for name in ("tomllib", "tomli"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(VolfrepError, match="pip install tomli"):
        read_spec(path)


@pytest.mark.parametrize(
    "text", ["relative_density = 0.2", "mass = 45.5", 'stiffness = "0.02:111"']
)
def test_a_target_takes_the_radius_place_in_a_file(tmp_path: Path, text: str) -> None:
    path, again = tmp_path / "spec.toml", tmp_path / "again.toml"
    path.write_text(f"cell_size = 4.0\n{text}\n")
    write_spec(read_spec(path), again)
    assert read_spec(again) == read_spec(path)
    assert read_spec(path).target is not None
    assert "strut_radius" not in again.read_text()
    path.write_text(f"strut_radius = 1.0\n{text}\n")
    with pytest.raises(VolfrepError, match=r"strut_radius and .* give one of them"):
        read_spec(path)
    path.write_text(f'radius_grading = "skin"\nradius_end = 2.0\n{text}\n')
    with pytest.raises(VolfrepError, match=r"one radius for all struts.*radius_grading skin"):
        read_spec(path)


def test_faces_and_bodies_with_their_lengths_go_into_a_file_and_back(tmp_path) -> None:
    """Bodies by where their files are seen from the specification."""
    import trimesh

    trimesh.creation.box((4, 4, 4)).export(tmp_path / "boss.stl")
    file = tmp_path / "lattice.toml"
    file.write_text(
        "skin_face = [[0, 0, 10, 3], [0, 0, 0, 0, 0, 1, 0.5], [9, 9, 9, 0]]\n"
        'keep_solid = ["boss.stl", [5, 0, 0, 2.5]]\n'
    )
    spec = read_spec(file)
    assert [skin.thickness for skin in spec.face_skins] == [3.0, 0.5]
    assert len(spec.open_faces) == 1
    assert len(spec.keep_solid) == 2
    again = tmp_path / "again.toml"
    write_spec(spec, again)
    assert '"boss.stl"' in again.read_text()
    back = read_spec(again)
    assert set(back.face_skins) == set(spec.face_skins)
    assert back.keep_solid == spec.keep_solid
    assert back.open_faces == spec.open_faces


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('keep_solid = ["gone.stl"]', "no file"),
        ('keep_solid = ["boss.step"]', "no file of a body"),
        ("keep_solid = [[0, 0, 1]]", "4 or 7 numbers"),
        ("keep_solid = [[0, 0, 1, -2]]", "distance to keep solid"),
        ("skin_face = [[0, 0, 1, -2]]", "thickness of a face's skin"),
    ],
)
def test_a_body_or_a_length_that_makes_no_sense_is_told(tmp_path, text, said) -> None:
    file = tmp_path / "lattice.toml"
    file.write_text(text)
    with pytest.raises(VolfrepError, match=said):
        read_spec(file)
