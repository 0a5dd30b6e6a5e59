# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window's texts: each one is in every language, with what is put in; nothing else is."""

import importlib.util
import string
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def load(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


tool = load(ROOT / "tools" / "translations.py")
TEXTS = tool.texts()
FILES = sorted(tool.FOLDER.glob("volfrep_*.ts"))


def test_the_sources_were_read():
    contexts = {context for context, _ in TEXTS}
    assert {"App::Property", "VOLFREP_LatticeInfill", "VolfrepPreferences", "Workbench"} <= contexts
    assert ("VOLFREP_LatticeInfill", "Lattice Infill") in TEXTS
    assert ("App::Property", "Cell size") in TEXTS
    assert ("VolfrepJobs", "Filling {label}") in TEXTS
    assert len(TEXTS) > 300


def test_there_are_italian_and_german():
    assert [path.name for path in FILES] == ["volfrep_de.ts", "volfrep_it.ts"]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_text_is_translated_and_no_other(path):
    translated = tool.read(path)
    assert sorted(set(TEXTS) - translated.keys()) == []
    assert sorted(translated.keys() - set(TEXTS)) == []


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_translation_has_the_same_places_ellipsis_and_lines(path):
    for (context, text), translation in tool.read(path).items():
        where = context, text, translation
        assert tool.placeholders(translation) == tool.placeholders(text), where
        assert translation.endswith("...") == text.endswith("..."), where
        assert translation.count("\n") == text.count("\n"), where
        assert translation.strip() == translation, where
        if context != "App::Property":
            list(string.Formatter().parse(translation))  # raises where a brace is left open


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_commands_of_a_menu_are_told_apart(path):
    names = [
        translation
        for (context, text), translation in tool.read(path).items()
        if context.startswith("VOLFREP_") and len(text) < 25
    ]
    assert len(set(names)) == len(names) > 10


def test_unfinished_ones_are_written_as_such_and_read_as_missing(tmp_path):
    path = tmp_path / "volfrep_fr.ts"
    wanted = [("A", "one"), ("A", "two"), ("B", "one")]
    tool.write(path, "fr", wanted, {("A", "two"): "deux", ("B", "gone"): "parti"})
    assert tool.read(path) == {("A", "two"): "deux"}
    assert path.read_text(encoding="utf-8").count('type="unfinished"') == 2
