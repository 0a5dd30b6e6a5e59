# SPDX-License-Identifier: LGPL-2.1-or-later
"""The add-on as FreeCAD's index wants it, from a checkout.

    python tools/addon_archive.py build/release/VOLFREP

makes that folder, and VOLFREP-0.1.0.zip beside it.

The checkout has `InitGui.py`, `freecad_volfrep` and `core` at its top. The index takes nothing
there but metadata, no package of a common name, and no write to the module path. So in the archive
the workbench is the package `freecad.volfrep`, the engine is `freecad.volfrep.core`, and every
import between them is relative. Nothing else is changed: what is rewritten are import statements,
and strings that name our modules.

Documents name the classes of our objects by `freecad.volfrep` whichever way the workbench is
installed (`freecad_volfrep/saved_names.py`).
"""

from __future__ import annotations

import ast
import io
import re
import shutil
import subprocess
import sys
import tokenize
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
#: A package of the checkout, and its name in the archive.
NAMES = {"freecad_volfrep": "freecad.volfrep", "volfrep": "freecad.volfrep.core"}
#: A file at the checkout's top, and its place in the archive.
TOP = {
    "LICENSE": "LICENSE",
    "CHANGELOG.md": "CHANGELOG.md",
    "Overview.md": "Overview.md",
    "Init.py": "freecad/volfrep/init.py",
    "InitGui.py": "freecad/volfrep/init_gui.py",
}
ICON = "freecad/volfrep/resources/icons/volfrep.svg"
#: Every file has this date in the archive, so that the same sources give the same bytes.
DATE = (1980, 1, 1, 0, 0, 0)

_MODULE = r"(?<![\w.])(freecad_volfrep|volfrep)((?:\.\w+)*)(?![\w-])"
#: A string that is nothing but a module's name, and code in a string.
_NAMES_MODULE = re.compile(rf"^{_MODULE}$")
_IMPORTS = re.compile(rf"\b(from|import) {_MODULE}")
#: What a line has in which a string may be such: only then are strings looked for, which is slow.
_MAY_NAME = re.compile(r"volfrep\.\w|\b(from|import) (freecad_)?volfrep")


def build(target: Path) -> Path:
    """Write the add-on's folder anew, and its archive beside it, whose path is returned."""
    if target.exists():
        shutil.rmtree(target)
    target.mkdir(parents=True)
    for source, place in files():
        path = target / place
        path.parent.mkdir(parents=True, exist_ok=True)
        if source.suffix == ".py":
            path.write_text(rewrite(source.read_text("utf-8"), Path(place)), encoding="utf-8")
        else:
            shutil.copyfile(source, path)
    (target / "package.xml").write_text(metadata(), encoding="utf-8")
    (target / "README.md").write_text(readme(), encoding="utf-8")
    archive = target.parent / f"{target.name}-{version()}.zip"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as file:
        for path in sorted(target.rglob("*")):
            if path.is_file():
                # No folder about them: the Add-on Manager unpacks into one of the add-on's name.
                entry = zipfile.ZipInfo(path.relative_to(target).as_posix(), DATE)
                entry.external_attr = 0o644 << 16
                entry.compress_type = zipfile.ZIP_DEFLATED
                file.writestr(entry, path.read_bytes())
    return archive


def version() -> str:
    """The add-on's version, as package.xml has it."""
    found = ET.parse(ROOT / "package.xml").getroot().find("{*}version")
    assert found is not None
    assert found.text
    return found.text


def files() -> Iterator[tuple[Path, str]]:
    """Files of the checkout that git knows, and their places in the archive."""
    if (ROOT / ".git").exists():
        known = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=ROOT, check=True, capture_output=True, text=True,
        ).stdout.split("\0")  # fmt: skip
    else:  # a copy of a checkout: all but what Python has compiled
        folders = [ROOT / name for name in ("freecad_volfrep", "core/volfrep", "docs")]
        paths = [ROOT / name for name in TOP]
        paths += [path for folder in folders for path in folder.rglob("*") if path.is_file()]
        known = [p.relative_to(ROOT).as_posix() for p in paths if "__pycache__" not in p.parts]
    shown = {
        (page.parent / picture).resolve().relative_to(ROOT).as_posix()
        for page in (ROOT / "docs" / "commands").glob("*.md")
        for picture in re.findall(r"\(([^)]*\.png)\)", page.read_text("utf-8"))
    }
    for name in sorted(filter(None, known)):
        if not (ROOT / name).is_file():
            continue
        if name in TOP:
            yield ROOT / name, TOP[name]
        elif name.startswith("docs/commands/") or (
            name.startswith("docs/images/") and name in shown
        ):
            yield ROOT / name, f"freecad/volfrep/{name}"
        elif name == "freecad_volfrep/checkout.py":
            continue
        for package, folder in (("freecad_volfrep/", ""), ("core/volfrep/", "core/")):
            if name.startswith(package):
                yield ROOT / name, f"freecad/volfrep/{folder}{name.removeprefix(package)}"


def rewrite(text: str, place: Path) -> str:
    """A module's text with our packages under their names in the archive.

    Args:
        text: of the module.
        place: of the module in the archive; import statements become relative to it.

    Raises:
        SystemExit: an import has a form that is not known here.
    """
    text = re.sub(r"^from \. import checkout .*\n", "", text, flags=re.MULTILINE)
    package = list(place.with_suffix("").parts[:-1])
    tree = ast.parse(text)
    lines = text.splitlines(keepends=True)
    changes: list[tuple[tuple[int, int], tuple[int, int], str]] = []
    in_statement = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and not node.level and _ours(node.module):
            assert node.module is not None
            start = (node.lineno, node.col_offset)
            row = lines[node.lineno - 1]
            old = f"from {node.module} import"
            at = node.col_offset
            if not row[at:].startswith(old):
                raise SystemExit(f"{place}:{node.lineno}: an import that is not understood")
            new = f"from {relative(node.module, package)} import"
            changes.append((start, (node.lineno, at + len(old)), new))
            in_statement.add(node.lineno)
        elif isinstance(node, ast.Import) and any(_ours(alias.name) for alias in node.names):
            (alias,) = node.names
            dotted = moved(alias.name).split(".")
            home = relative_dots(dotted[:-1], package)
            name = alias.asname or alias.name
            if "." in name:
                raise SystemExit(f"{place}:{node.lineno}: 'import {alias.name}' needs an 'as'")
            new = f"from {home} import {dotted[-1]}" + (f" as {name}" if name != dotted[-1] else "")
            end = (node.end_lineno or node.lineno, node.end_col_offset or 0)
            changes.append(((node.lineno, node.col_offset), end, new))
            in_statement.add(node.lineno)
    documentation = {
        (node.body[0].lineno, node.body[0].col_offset)
        for node in ast.walk(tree)
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef))
        and ast.get_docstring(node, clean=False) is not None
    }
    strings = {tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING)}
    others = (line for number, line in enumerate(lines, 1) if number not in in_statement)
    may_change = any(map(_MAY_NAME.search, others))
    for token in tokenize.generate_tokens(io.StringIO(text).readline) if may_change else ():
        if (
            token.type not in strings
            or token.start in documentation
            or token.start[0] in in_statement
        ):
            continue
        new = _in_string(token.string)
        if new != token.string:
            changes.append((token.start, token.end, new))
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line))
    for start, end, new in sorted(changes, reverse=True):
        first, last = starts[start[0] - 1] + start[1], starts[end[0] - 1] + end[1]
        text = text[:first] + new + text[last:]
    return text


def _in_string(token: str) -> str:
    quote = re.search(r"['\"]+", token)
    inner = token[quote.end() : len(token) - len(quote.group())] if quote else token
    if _NAMES_MODULE.match(inner) and "." in inner:
        return token.replace(inner, moved(inner))
    return _IMPORTS.sub(lambda found: f"{found[1]} {moved(found[2] + found[3])}", token)


def _ours(name: str | None) -> bool:
    return name is not None and name.split(".")[0] in NAMES


def moved(name: str) -> str:
    """What a module of the checkout is called in the archive."""
    first, _, rest = name.partition(".")
    return f"{NAMES[first]}.{rest}" if rest else NAMES[first]


def relative(module: str, package: list[str]) -> str:
    """A module of the checkout as a relative import names it from a package of the archive."""
    return relative_dots(moved(module).split("."), package)


def relative_dots(module: list[str], package: list[str]) -> str:
    """A dotted path as a relative import names it."""
    common = 0
    while common < min(len(module), len(package)) and module[common] == package[common]:
        common += 1
    return "." * (len(package) - common + 1) + ".".join(module[common:])


def metadata() -> str:
    """The archive's package.xml."""
    text = (ROOT / "package.xml").read_text("utf-8")
    return text.replace("freecad_volfrep/resources/icons/volfrep.svg", ICON)


def readme() -> str:
    """The archive's README: the checkout's own has links that lead nowhere there."""
    home = ET.parse(ROOT / "package.xml").getroot().find("{*}url[@type='repository']")
    assert home is not None
    return (
        "# VOLFREP\n\nWhat it does and needs: [Overview.md](Overview.md). This is what FreeCAD "
        f"installs, made by `make release` from the sources and their tests at {home.text}.\n"
    )


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    print(build(Path(sys.argv[1]).resolve()))
