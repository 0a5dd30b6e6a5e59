# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rules of FreeCAD's add-on index, as checks of an archive or a folder.

    python tools/index_review.py build/release/VOLFREP-0.1.0.zip

Each check names its rule's source: the Addon Academy (FreeCAD/Addon-Academy, Source/Topics:
Qualities, Structuring, Allow-List, Vendoring; Source/Guides/Publishing), the lists of allowed
packages (FreeCAD/Addons, Data/Python/<version>/Allowed-Packages), and what reviewers asked for in
2025 and 2026 (issues of FreeCAD/Addons by number). Prints what is wrong, and exits with 1 then.
"""

from __future__ import annotations

import ast
import re
import sys
import tempfile
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
#: Python versions of the FreeCADs that are supported, and what their lists allow of what we use
#: (FreeCAD/Addons at 050433b, August 2026; 3.10 to 3.13 are one list, 3.14 has the same of these).
ALLOWED = frozenset({"numpy", "scipy", "scikit-image", "trimesh"})
#: A package that is on no list may be asked for as optional, with a request in this folder.
REQUESTS = ROOT / "docs" / "release"
#: What may stand at the top (Structuring, "Modern layout").
TOP_FILES = re.compile(
    r"(README|Overview|CHANGELOG|CONTRIBUTING|SECURITY)\.md|LICENSE[\w.-]*|CITATION\.cff|"
    r"package\.xml|pyproject\.toml|\.gitignore"
)
TOP_FOLDERS = {"freecad", "Documentation", "Resources", "docs"}
LARGEST = 5_000_000
ICON_LARGEST = 64_000
NEEDED = ("name", "description", "version", "date", "maintainer", "license", "url", "icon")
ADDRESSES = {"repository", "bugtracker", "readme", "documentation"}
#: Names of modules that other add-ons claim on FreeCAD's shared path.
_NAMESPACE = "{https://wiki.freecad.org/Package_Metadata}"

Check = Callable[[Path], Iterator[str]]
CHECKS: list[tuple[str, str, Check]] = []


def rule(source: str) -> Callable[[Check], Check]:
    """Make a function a check of the rule in its docstring; it yields what breaks it."""

    def add(check: Check) -> Check:
        CHECKS.append(((check.__doc__ or "").rstrip("."), source, check))
        return check

    return add


def review(place: Path) -> list[str]:
    """Every fault of an add-on's folder, or of a zip archive of one, as a sentence."""
    if place.suffix == ".zip":
        with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(place) as file:
            if place.stat().st_size > LARGEST:
                return [f"the archive has {place.stat().st_size} bytes, more than {LARGEST}"]
            file.extractall(folder)
            found = list(Path(folder).iterdir())
            root = found[0] if len(found) == 1 else Path(folder)
            return review(root)
    _python.cache_clear()
    return [
        f"{text} ({source}): {fault}" for text, source, check in CHECKS for fault in check(place)
    ]


@lru_cache(maxsize=1)
def _python(root: Path) -> list[tuple[Path, ast.Module]]:
    return [
        (path.relative_to(root), ast.parse(path.read_text("utf-8")))
        for path in sorted(root.rglob("*.py"))
    ]


def _metadata(root: Path) -> ET.Element:
    return ET.parse(root / "package.xml").getroot()


@rule("Structuring; Addons#108")
def no_python_at_the_top(root: Path) -> Iterator[str]:
    """No Python source at the top level."""
    for path in sorted(root.glob("*.py")):
        yield path.name


@rule("Structuring; Addons#108")
def only_metadata_at_the_top(root: Path) -> Iterator[str]:
    """Nothing but metadata and the namespace at the top level."""
    for path in sorted(root.iterdir()):
        known = path.name in TOP_FOLDERS if path.is_dir() else TOP_FILES.fullmatch(path.name)
        if not known and path.suffix != ".py":
            yield path.name


@rule("Structuring")
def namespaced(root: Path) -> Iterator[str]:
    """All Python under freecad/<name>, which FreeCAD shares among add-ons."""
    if (root / "freecad" / "__init__.py").exists():
        yield "freecad/__init__.py would replace FreeCAD's own"
    packages = [path for path in (root / "freecad").glob("*") if path.is_dir()]
    if len(packages) != 1:
        yield f"{len(packages)} packages in freecad/"
    for package in packages:
        for name in ("__init__.py", "init_gui.py"):
            if not (package / name).is_file():
                yield f"freecad/{package.name}/{name} is missing"
    for path, _ in _python(root):
        if path.parts[0] != "freecad" and len(path.parts) > 1:
            yield str(path)


@rule("Addons#57, #43")
def no_write_to_the_path(root: Path) -> Iterator[str]:
    """No write to the module path."""
    for path, tree in _python(root):
        for node in ast.walk(tree):
            target = None
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
                if node.func.attr in {"insert", "append", "extend", "remove"}:
                    target = node.func.value
            elif isinstance(node, (ast.Assign, ast.AugAssign)):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                target = next(
                    (t.value if isinstance(t, ast.Subscript) else t for t in targets), None
                )
            if target is not None and ast.unparse(target) in {"sys.path", "sys.meta_path"}:
                yield f"{path}:{node.lineno}"


def _imported(root: Path) -> Iterator[tuple[str, str]]:
    """Where a module is imported, and its name; those named from where they are are not."""
    for path, tree in _python(root):
        for node in ast.walk(tree):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and not node.level:
                names = [node.module or ""]
            for name in names:
                yield f"{path}:{node.lineno}", name


@rule("Structuring; Vendoring")
def imports_by_namespace(root: Path) -> Iterator[str]:
    """No import of our modules but by the namespace."""
    for place, name in _imported(root):
        if name.split(".")[0] in {"freecad_volfrep", "volfrep", "core"}:
            yield f"{place}: {name}"


@rule("Qualities")
def qt_by_the_wrapper(root: Path) -> Iterator[str]:
    """Qt by FreeCAD's own wrapper, PySide."""
    for place, name in _imported(root):
        if re.match(r"(PySide[26]|PyQt[56])\b", name):
            yield f"{place}: {name}"


@rule("Allow-List")
def dependencies_are_allowed(root: Path) -> Iterator[str]:
    """Needed packages are on the lists of allowed ones; others are optional, with a request."""
    for depend in _metadata(root).iter(f"{_NAMESPACE}depend"):
        name = (depend.text or "").strip()
        if depend.get("type") != "python":
            continue
        if not re.fullmatch(r"[A-Za-z0-9]([A-Za-z0-9._-]*[A-Za-z0-9])?", name):
            yield f"'{name}' is no bare name: versions cannot be given"
        if any(depend.get(limit) for limit in ("version_lt", "version_lte", "version_eq")):
            yield f"'{name}' is pinned (Addons#43)"
        if name in ALLOWED:
            continue
        if depend.get("optional") != "true":
            yield f"'{name}' is on no list, and is not optional"
        if not (REQUESTS / f"{name}.md").is_file():
            yield f"there is no request for '{name}' in docs/release"


@rule("Qualities; Allow-List")
def nothing_is_installed(root: Path) -> Iterator[str]:
    """Nothing goes round the list of allowed packages."""
    for path, tree in _python(root):
        text = [n.value for n in ast.walk(tree) if isinstance(n, ast.Constant)]
        if "pip" in text and "install" in text and path.name != "deps.py":
            yield f"{path} runs pip"


@rule("Qualities; Package_Metadata")
def metadata_is_complete(root: Path) -> Iterator[str]:
    """The metadata is complete."""
    if not (root / "package.xml").is_file():
        yield "package.xml is missing"
        return
    top = _metadata(root)
    for name in NEEDED:
        if top.find(f"{_NAMESPACE}{name}") is None:
            yield f"<{name}> is missing"
    for maintainer in top.iter(f"{_NAMESPACE}maintainer"):
        if "@" not in (maintainer.get("email") or ""):
            yield "a maintainer has no e-mail"
    addresses = {url.get("type") for url in top.iter(f"{_NAMESPACE}url")}
    for kind in sorted(ADDRESSES - addresses):
        yield f"the address of the {kind} is missing"
    workbench = top.find(f"{_NAMESPACE}content/{_NAMESPACE}workbench")
    for name in ("name", "classname", "subdirectory", "icon"):
        if workbench is None or workbench.find(f"{_NAMESPACE}{name}") is None:
            yield f"the workbench's <{name}> is missing"
    for licence in top.iter(f"{_NAMESPACE}license"):
        if not (root / (licence.get("file") or "-")).is_file():
            yield f"the licence's file '{licence.get('file')}' is missing"


@rule("Qualities")
def icons_are_small(root: Path) -> Iterator[str]:
    """Icons are there, are SVG or PNG, and small."""
    for icon in _metadata(root).iter(f"{_NAMESPACE}icon"):
        path = root / (icon.text or "")
        if not path.is_file():
            yield f"'{icon.text}' is missing"
    for path in sorted(root.rglob("*")):
        if path.suffix in {".svg", ".png"} and "icons" in path.parts:
            if path.stat().st_size > ICON_LARGEST:
                yield f"{path.relative_to(root)} has {path.stat().st_size} bytes"
        elif "icons" in path.parts and path.is_file():
            yield f"{path.relative_to(root)} is no SVG or PNG"


@rule("Qualities")
def sources_say_their_licence(root: Path) -> Iterator[str]:
    """Every source file says its licence."""
    for path in sorted(root.rglob("*.py")):
        if "SPDX-License-Identifier:" not in path.read_text("utf-8")[:200]:
            yield str(path.relative_to(root))


@rule("Addons#108")
def no_tests(root: Path) -> Iterator[str]:
    """No tests and no tools among what users get."""
    for path in sorted(root.rglob("*")):
        if path.is_dir() and path.name in {"tests", "tools", "bench", "__pycache__"}:
            yield str(path.relative_to(root))


@rule("Publishing")
def overview(root: Path) -> Iterator[str]:
    """A README, and an overview for the Addon Manager, whose pictures are addresses."""
    if not (root / "README.md").is_file():
        yield "README.md is missing"
    path = root / "Overview.md"
    if not path.is_file():
        yield "Overview.md is missing"
        return
    for address in re.findall(r"!\[[^]]*\]\(([^)]+)\)", path.read_text("utf-8")):
        if not address.startswith("https://") or address.endswith(".webp"):
            yield f"the picture {address}"


@rule("Qualities: external connections")
def no_connections(root: Path) -> Iterator[str]:
    """Nothing is sent or fetched."""
    for place, name in _imported(root):
        if re.match(r"(urllib\.request|http\.client|requests|httpx|aiohttp)\b", name):
            yield f"{place}: {name}"


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    faults = review(Path(sys.argv[1]))
    for fault in faults:
        print(f"index review: {fault}")
    print(f"index review: {len(CHECKS)} rules, {len(faults)} faults")
    raise SystemExit(1 if faults else 0)
