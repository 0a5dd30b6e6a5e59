# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts that the project models itself, and the folder that real ones are looked for in."""

import re
from pathlib import Path

import numpy as np
import pytest
import trimesh

from bench import document, parts
from volfrep.io.solid import read_solid

#: The box of each, mm.
BOXES = {
    "bracket": (178.5, 62.5, 108.3),
    "piston_rod": (121.0, 28.0, 11.6),
    "ribbed_housing": (90.0, 60.0, 32.0),
    "imported_flange": (80.0, 80.0, 40.0),
    "three_bodies": (68.0, 68.0, 30.0),
}


@pytest.mark.parametrize("name", parts.MODELLED)
def test_a_modelled_part_is_closed_and_of_its_size(name):
    part = parts.MODELLED[name]()
    other = trimesh.Trimesh(part.vertices, part.triangles, process=False)
    assert other.is_watertight
    assert other.volume == pytest.approx(part.volume)
    np.testing.assert_allclose(np.ptp(part.bounds, axis=0), BOXES[name], atol=1e-6)


def test_the_imported_part_is_made_of_many_narrow_facets():
    part = parts.imported_flange()
    other = trimesh.Trimesh(part.vertices, part.triangles, process=False)
    smallest = np.degrees(np.sort(other.face_angles, axis=1)[:, 0])
    assert len(part.triangles) > 20_000
    assert np.mean(smallest < 5.0) > 0.2


def test_a_file_is_made_where_the_real_part_is_not_there(tmp_path, monkeypatch):
    monkeypatch.setattr(parts, "PARTS", tmp_path)
    monkeypatch.setattr(parts, "ROOT", tmp_path)
    made = parts.at_hand("ge_bracket.stl", "bracket")
    assert made == tmp_path / "build" / "parts" / "bracket.stl"
    assert read_solid(made).volume == pytest.approx(parts.lug_bracket().volume, rel=1e-6)
    (tmp_path / "ge_bracket.stl").write_bytes(b"a real one")
    assert parts.at_hand("ge_bracket.stl", "bracket") == tmp_path / "ge_bracket.stl"


def test_a_variable_names_the_folder(monkeypatch):
    monkeypatch.setenv("VOLFREP_PARTS", "/elsewhere")
    assert parts.folder("parts") == Path("/elsewhere")
    monkeypatch.setenv("VOLFREP_PARTS", "mine")
    assert parts.folder("parts") == parts.ROOT / "mine"
    monkeypatch.delenv("VOLFREP_PARTS")
    assert parts.folder("parts") == parts.ROOT / ".." / "shared" / "parts"


def test_only_one_module_knows_where_the_real_parts_lie():
    knows = re.compile(r"""shared["'/ ]+(parts|torture)""")
    found = [
        path.relative_to(parts.ROOT).as_posix()
        for folder in ("bench", "demo", "tests", "core", "freecad_volfrep")
        for path in (parts.ROOT / folder).rglob("*.py")
        if path != Path(__file__) and knows.search(path.read_text(encoding="utf-8"))
    ]
    assert set(found) <= {"bench/parts.py"}


def test_the_document_says_what_is_a_stand_in():
    class Chapter:
        @staticmethod
        def render(result, images):
            return "## A chapter"

    machine = {
        "processor": "a", "cores": 2, "memory_gb": 4, "system": "b", "python": "3", "load": 0.0,
        "packages": {}, "peer_packages": {}, "commit": "c", "date": "2026-01-01 00:00",
    }  # fmt: skip
    for stand_ins in ([], ["bracket"]):
        result = {"machine": {**machine, "stand_ins": stand_ins}, "seconds": 1.0, "bars": []}
        text, _ = document.document({"x": result}, {"x": Chapter}, Path("images"))
        assert ("parts that the project models itself" in text) == bool(stand_ins)
