# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench's imports go one way: objects know nothing of windows; one module joins the two.

Read from the sources, which only FreeCAD could import.
"""

from __future__ import annotations

import ast
import functools
from collections.abc import Iterator
from pathlib import Path

from test_layers import says_why_it_is_long, statements

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = "freecad_volfrep"
#: Low to high: what stands here imports from itself and from what stands before it. Modules beside
#: the folders, which only look at FreeCAD and the engine, are the lowest; those beside
#: the rooms of a folder stand where the folder does.
LAYERS = (
    "",
    "bridge",
    "exact_job",
    # How a job is run; what a property is; the infill; what looks at one and what is made of one.
    "features.jobs",
    "features.properties",
    "features.infill",
    "features.reports",
    "features.sizing",
    "features.export",
    "features.study",
    "features",
    "revival",
    "examples",
    # Parts without a subject, the 3D view, jobs, then a room for each subject, and the commands.
    "gui",
    "gui.widgets",
    "gui.windows",
    "gui.draw",
    "gui.view",
    "gui.jobs",
    "gui.colours",
    "gui.cells",
    "gui.panel",
    "gui.sizing",
    "gui.study",
    "gui.printing",
    "gui.commands",
    "gui.view_provider",
    "gui.revived_view",
    "window",
)


def modules() -> dict[str, Path]:
    """Every module of the workbench by its dotted name; packages by their own."""
    found = {}
    for path in sorted((ROOT / PACKAGE).rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def imports(name: str, path: Path, known: dict[str, Path]) -> Iterator[str]:
    """The workbench's modules that a module imports, wherever in it the import stands."""
    package = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    for node in statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in known)
        if not isinstance(node, ast.ImportFrom):
            continue
        base = package[: len(package) - node.level + 1] if node.level else []
        home = ".".join([*base, *(node.module or "").split(".")]).strip(".")
        for alias in node.names:
            inner = f"{home}.{alias.name}"
            if inner in known or home in known:
                yield inner if inner in known else home


@functools.cache
def all_imports() -> dict[str, frozenset[str]]:
    """Every module and what it imports, read once."""
    known = modules()
    return {name: frozenset(imports(name, path, known)) for name, path in known.items()}


def layer(name: str) -> int:
    """Where a module stands in `LAYERS`: by its room, else its folder, else at the bottom."""
    parts = name.split(".")[1:]
    places = [".".join(parts[:n]) for n in (2, 1) if len(parts) >= n]
    return LAYERS.index(next((place for place in places if place in LAYERS), ""))


def test_every_folder_is_a_room_with_a_row() -> None:
    rooms = {".".join(p.parent.relative_to(ROOT / PACKAGE).parts) for p in modules().values()}
    assert rooms <= set(LAYERS)
    assert all(row in rooms or f"{PACKAGE}.{row}" in modules() for row in LAYERS)


def test_a_layer_imports_from_those_before_it_only() -> None:
    back = [
        f"{name} -> {target}"
        for name, targets in all_imports().items()
        for target in targets
        if layer(target) > layer(name)
    ]
    assert back == []
    assert any("bridge" in target for target in imports_of("features.reports.print_check"))


def imports_of(name: str) -> frozenset[str]:
    return all_imports()[f"{PACKAGE}.{name}"]


def test_no_imports_go_round() -> None:
    targets = {name: set(found) - {name} for name, found in all_imports().items()}
    while True:
        free = {name for name, needs in targets.items() if not needs & targets.keys()}
        if not free:
            break
        targets = {name: needs for name, needs in targets.items() if name not in free}
    assert targets == {}


def test_objects_are_shown_by_what_the_window_registers() -> None:
    assert f"{PACKAGE}.features.jobs.screen" in imports_of("window")
    assert any(target.startswith(f"{PACKAGE}.gui") for target in imports_of("window"))


def test_a_long_module_says_why() -> None:
    assert [n for n, p in modules().items() if not says_why_it_is_long(p.read_text("utf-8"))] == []


def test_the_classes_that_documents_name_are_where_they_look() -> None:
    """Documents of every release hold these paths; the view providers' is also pinned in them."""
    known = modules()
    saved = {
        f"{PACKAGE}.features": {"LatticeInfill", "PrintCheck", "DesignStudy"},
        f"{PACKAGE}.gui.view_provider": {"LatticeInfillView", "PrintCheckView", "DesignStudyView"},
    }
    for module, classes in saved.items():
        tree = ast.parse(known[module].read_text("utf-8"))
        names = {node.name for node in tree.body if isinstance(node, ast.ClassDef)}
        for node in tree.body:
            if isinstance(node, ast.ImportFrom):
                names |= {alias.name for alias in node.names}
        assert classes <= names
