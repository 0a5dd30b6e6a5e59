# SPDX-License-Identifier: LGPL-2.1-or-later
"""The add-on's archive is what FreeCAD's index takes, and the review refuses what it does not."""

from __future__ import annotations

import ast
import importlib.util
import zipfile
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
# The archive is built first.
pytestmark = pytest.mark.costly


def tool(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made: Path = tool("addon_archive").build(tmp_path_factory.mktemp("release") / "VOLFREP")
    return made


@pytest.fixture
def folder(archive: Path, tmp_path: Path) -> Path:
    """The add-on without most of its modules, which the rules treat alike."""
    with zipfile.ZipFile(archive) as file:
        few = [name for name in file.namelist() if name.count("/") < 3 or "/icons/" in name]
        file.extractall(tmp_path, few)
    return tmp_path


@pytest.mark.slow
def test_the_archive_breaks_no_rule_of_the_index(archive: Path) -> None:
    assert tool("index_review").review(archive) == []
    assert archive.stat().st_size < 5_000_000


def test_the_same_sources_give_the_same_bytes(archive: Path, tmp_path: Path) -> None:
    assert tool("addon_archive").build(tmp_path / "VOLFREP").read_bytes() == archive.read_bytes()


def test_every_module_of_the_archive_is_python(archive: Path) -> None:
    with zipfile.ZipFile(archive) as file:
        for name in file.namelist():
            if name.endswith(".py"):
                ast.parse(file.read(name))


@pytest.mark.parametrize(
    ("place", "text", "fault"),
    [
        ("InitGui.py", "", "No Python source at the top level"),
        ("tests/test_x.py", "", "Nothing but metadata"),
        ("freecad/__init__.py", "", "would replace FreeCAD's own"),
        ("freecad/volfrep/x.py", "import sys\nsys.path.insert(0, 'x')\n", "module path"),
        ("freecad/volfrep/x.py", "from volfrep.design import cells\n", "by the namespace"),
        ("freecad/volfrep/x.py", "from PySide2 import QtCore\n", "PySide2"),
        ("freecad/volfrep/x.py", "import urllib.request\n", "Nothing is sent"),
        ("freecad/volfrep/x.py", "X = 1\n", "says its licence"),
        ("Overview.md", "![A picture](docs/x.png)", "an overview"),
    ],
)
def test_what_the_index_sends_back_is_named(
    folder: Path, place: str, text: str, fault: str
) -> None:
    path = folder / place
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, "utf-8")
    assert any(fault in said for said in tool("index_review").review(folder))


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("<version>0.1.0</version>", "", "<version> is missing"),
        ('email="volfrep@example.org"', "", "no e-mail"),
        ('type="python">numpy<', 'type="python">left-pad<', "'left-pad' is on no list"),
        ('type="python">numpy<', 'type="python" version_eq="1">numpy<', "is pinned"),
    ],
)
def test_faults_of_the_metadata_are_named(folder: Path, old: str, new: str, fault: str) -> None:
    path = folder / "package.xml"
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new), "utf-8")
    assert any(fault in said for said in tool("index_review").review(folder))


@pytest.mark.parametrize(
    ("line", "moved"),
    [
        ("from volfrep.util.errors import X\n", "from ..core.util.errors import X\n"),
        ("from freecad_volfrep.gui.qt import X\n", "from .qt import X\n"),
        ("from freecad_volfrep import ICONS\n", "from .. import ICONS\n"),
        ('NAME = "volfrep.jobs.pipeline"\n', 'NAME = "freecad.volfrep.core.jobs.pipeline"\n'),
        ('CODE = "from volfrep.x import y; y()"\n',
         'CODE = "from freecad.volfrep.core.x import y; y()"\n'),
        ('SAID = "volfrep fill part.stl"\n', 'SAID = "volfrep fill part.stl"\n'),
    ],
)  # fmt: skip
def test_imports_become_relative_and_nothing_else_changes(line: str, moved: str) -> None:
    place = Path("freecad/volfrep/gui/x.py")
    assert tool("addon_archive").rewrite(line, place) == moved
