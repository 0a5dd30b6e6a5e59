# SPDX-License-Identifier: LGPL-2.1-or-later
"""The window's texts: each one is in every language, with what is put in; nothing else is."""

import ast
import importlib.util
import re
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
    assert ("App::Property", "Cell Size") in TEXTS
    assert ("VolfrepJobs", "Filling {label}") in TEXTS
    assert len(TEXTS) > 300


#: A part of a sentence that many have, in letters.
SHORT = 6
#: Functions that show their arguments to the user.
SHOWING = {
    "tell", "tell_error", "show_error", "ask", "choose", "QLabel", "QPushButton", "QCheckBox",
    "QGroupBox", "setToolTip", "setWindowTitle", "setText", "addAction", "addItem", "addRow",
    "undo_step", "openTransaction", "progress_of", "run_job", "setPlaceholderText", "setSuffix",
}  # fmt: skip


def written_out(argument):
    """The words in an argument that is a text, without HTML's."""
    parts = argument.values if isinstance(argument, ast.JoinedStr) else [argument]
    texts = [part.value for part in parts if isinstance(part, ast.Constant)]
    return re.findall(r"[A-Za-z]{3,}", re.sub(r"<[^>]*>", "", "".join(map(str, texts))))


def test_no_words_are_shown_that_nobody_could_translate():
    found = []
    for path in (ROOT / "freecad_volfrep").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            name = getattr(getattr(node, "func", None), "id", None)
            name = name or getattr(getattr(node, "func", None), "attr", None)
            if isinstance(node, ast.Call) and name in SHOWING:
                words = [word for argument in node.args for word in written_out(argument)]
                found += [(path.name, node.lineno, words)] if words else []
    assert found == []


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


def test_sentences_that_are_found_again_are_still_written_so():
    files = [*(ROOT / "core/volfrep").rglob("*.py"), *(ROOT / "freecad_volfrep").rglob("*.py")]
    sources = "".join(
        # Texts in several lines are one.
        re.sub(r'" *\n *f?"', "", path.read_text(encoding="utf-8"))
        for path in files
        if path.name != "sentences.py"
    )
    sentences = [text for context, text in TEXTS if context == "VolfrepSentences"]
    assert len(sentences) > 40
    # What is put in may be written out in a sentence, so some part of it is looked for.
    parts = {text: re.split(r"{\w+}|[:;,] ", text) for text in sentences}
    lost = [
        text
        for text, some in parts.items()
        if not any(part.strip() in sources for part in some if len(part) > SHORT)
        and text not in sources
    ]
    assert lost == []


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
