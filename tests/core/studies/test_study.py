# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies as files, their designs, and the sentences for what makes no sense."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

import samples
from volfrep import Front, Range, Study, VolfrepError, read_study
from volfrep.io.solid import check_solid
from volfrep.studies.designs import combinations, designs_of, key_of, named_part
from volfrep.studies.sampling import latin_hypercube

BOX = check_solid(samples.box(), "box")
PART = named_part("", BOX)

FILE = """
part = "bracket.stl"
material = "PA12"
process = "SLS"
do = ["forecast", "fill", "print"]
spec = "light.toml"

[fixed]
cell_size = "1 cm"

[vary]
cell = ["CVC", "own/skew.json"]
shell = { from = 1, to = 3, steps = 5 }

[front]
objectives = { forecast.mass_g = "least", "fill.area_mm2" = "most" }
designs = 4
"""


def written(folder: Path, text: str, spec: str = "strut_radius = 0.8\nshell = 9\n") -> Path:
    (folder / "light.toml").write_text(spec)
    path = folder / "study.toml"
    path.write_text(text)
    return path


def test_a_file_says_all_of_a_study(tmp_path: Path) -> None:
    study = read_study(written(tmp_path, FILE))
    assert study.parts == (str(tmp_path / "bracket.stl"),)
    assert study.fixed == {"cell_size": 10.0, "strut_radius": 0.8}, "the file's skin varies"
    assert study.vary["cell"] == ("CVC", str(tmp_path / "own/skew.json"))
    assert study.vary["shell"] == Range(1.0, 3.0, 5)
    assert study.front == Front({"forecast.mass_g": "least", "fill.area_mm2": "most"}, (), 4)
    shells = [row["shell"] for row in combinations(study) if row["cell"] == "CVC"]
    assert shells == [1.0, 1.5, 2.0, 2.5, 3.0]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('part = "bracket.stl"', "", "either 'part', a file, or 'parts'"),
        ("material", "metarial", "unknown entry 'metarial'"),
        ('"PA12"', '"PA13"', "no material 'PA13'"),
        ("process", "#", "'print' needs a process"),
        ('"print"]', '"primt"]', "no action 'primt'"),
        ("shell = {", "shel = {", "no parameter 'shel': the nearest is 'shell'"),
        ("from = 1", "from = 4", "from a number to a larger one"),
        (", steps = 5", ", stepz = 5", "unknown entry 'stepz'"),
        (", steps = 5", "", "needs the steps of 'shell'"),
        ('["CVC", "own/skew.json"]', '{ from = 1, to = 2 }', "'cell' has no range"),
        ('cell_size = "1 cm"', "shell = 2", "'shell' is fixed and varies"),
        ('"1 cm"', '"1 kg"', "cell_size: '1 kg' has the unit 'kg'"),
        ('"least"', '"lest"', "cannot be 'lest'"),
        ("forecast.mass_g", "mass_g", "names no figure of an action"),
        ("designs = 4", "designs = 0", "At least 1 design"),
        ("fill.area_mm2", "picture.file", "of no action that is done with every design"),
        ('spec = "light.toml"', 'sampling = "random"', "no sampling 'random'"),
        ('spec = "light.toml"', 'samples = 5', "Latin hypercube, and nothing else"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_in_a_file_is_told(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    assert old in FILE
    with pytest.raises(VolfrepError, match=words):
        combinations(read_study(written(tmp_path, FILE.replace(old, new, 1))))


def test_a_hypercube_has_one_design_in_each_slice_and_is_the_same_again() -> None:
    vary = {"cell": ("BCC", "CVC"), "shell": Range(1.0, 3.0), "map_around": Range(3, 6, whole=True)}
    rows = latin_hypercube(vary, 20, seed=7)
    assert rows == latin_hypercube(vary, 20, seed=7)
    assert rows != latin_hypercube(vary, 20, seed=8)
    slices = np.sort([int((row["shell"] - 1.0) / 2.0 * 20) for row in rows])
    assert slices.tolist() == list(range(20))
    assert [row["cell"] for row in rows].count("BCC") == 10
    around = [row["map_around"] for row in rows]
    assert sorted(around) == sorted([3, 4, 5, 6] * 5)
    assert all(isinstance(number, int) for number in around)


def test_combinations_without_sense_are_counted_and_passed_over() -> None:
    study = Study(
        parts=(BOX,),
        vary={"cell_size": (10.0, 50.0), "strut_radius": (1.0, 1.0, 6.0)},
        fixed={"cell": "CVC"},
    )
    found = designs_of(study, (PART,))
    assert [d.values["strut_radius"] for d in found.designs] == [1.0]
    assert found.repeated == 1
    assert sum(found.refused.values()) == 4
    assert any("larger than 'part'" in text for text in found.refused)


def test_a_key_tells_designs_apart_by_their_content_alone(tmp_path: Path) -> None:
    skew = samples.SKEW
    cell = {"name": "skew", "nodes": skew.nodes.tolist(), "struts": skew.struts.tolist()}
    for name in ("one.json", "two.json"):
        (tmp_path / name).write_text(json.dumps(cell))

    def key(**values: object) -> str:
        study = Study(parts=(BOX,), fixed={"cell": "CVC", **values})
        (design,) = designs_of(study, (PART,)).designs
        return design.key

    plain = key()
    assert key(cell_size=10, strut_radius=1.0) == plain, "what has its default anyway"
    assert key(cell=str(tmp_path / "one.json")) == key(cell=str(tmp_path / "two.json"))
    others = {
        plain,
        key(cell="BCC"),
        key(cell=str(tmp_path / "one.json")),
        key(strut_radius=1.1),
        key(relative_density=0.2),
        key(density=2.0),
        key(build_direction=(1.0, 0.0, 0.0)),
        key(size_grading="formula", lambda_formula="1 + s"),
        key(size_grading="formula", lambda_formula="1 + 2 * s"),
    }
    assert len(others) == 9
    (design,) = designs_of(Study(parts=(BOX,), fixed={"cell": "CVC"}), (PART,)).designs
    assert key_of("another part", design.spec, {}, "0.1.0") != plain
    assert key_of(PART.content, design.spec, {}, "another version") != plain


def test_a_materials_density_counts_where_none_is_given() -> None:
    study = Study(parts=(BOX,), material="Ti-6Al-4V", fixed={"cell": "CVC"})
    (design,) = designs_of(study, (PART,)).designs
    assert design.spec.density == 4.41
    own = dataclasses.replace(study, fixed={"cell": "CVC", "density": 2.0})
    assert designs_of(own, (PART,)).designs[0].spec.density == 2.0
