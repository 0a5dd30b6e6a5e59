# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every word that a user meets: whether a change of structure changed one.

    make vocabulary                       # shows the difference to tools/vocabulary/
    make vocabulary VOCABULARY=--write    # after a change that is meant to alter words

- help.txt: the options of each command, from its own parser.
- properties.txt: what FreeCAD shows of our objects' properties, from objects made in freecadcmd.
  Where it is not installed this is skipped, which is told, and the kept file stays.
- sentences.txt: errors, warnings, tooltips and labels, from the sources: every text of two words
  or more that is no docstring, with {} where a value is put in. Texts are sorted, each with the
  number of places that say it, so that moving one changes nothing. The parts that a text is
  chosen from are texts of their own.

The lines are the same on every machine (properties.txt with FreeCAD 0.20; later ones may take
other types). No test holds them: words may change at any time.
"""

from __future__ import annotations

import argparse
import ast
import contextlib
import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = Path(__file__).with_suffix("")
SOURCES = ("core/volfrep", "freecad_volfrep")

#: Run by freecadcmd, which takes no arguments of ours. One line a property; of a choice all words.
_IN_FREECAD = """
import os, sys, traceback
try:
    sys.path[:0] = [{root!r}, {core!r}]
    import FreeCAD as App
    from freecad_volfrep.features.study.design_study import make_design_study
    from freecad_volfrep.features.infill.factory import make_lattice_infill
    from freecad_volfrep.features.reports.print_check import make_print_check
    doc = App.newDocument("Vocabulary")
    infill = make_lattice_infill(doc, None)
    kinds = {{
        "plain": doc.addObject("Mesh::FeaturePython", "Plain"),
        "other": doc.addObject("App::FeaturePython", "Other"),
    }}
    made = [infill, make_design_study(doc, infill), make_print_check(doc, infill)]
    native = set(kinds["plain"].PropertiesList) | set(kinds["other"].PropertiesList)
    lines = []
    for obj in made:
        for name in sorted(set(obj.PropertiesList) - native):
            words = obj.getEnumerationsOfProperty(name)
            lines.append(" | ".join([
                type(obj.Proxy).__name__, name, obj.getTypeIdOfProperty(name),
                obj.getGroupOfProperty(name), obj.getDocumentationOfProperty(name),
                ", ".join(obj.getEditorMode(name)), ", ".join(words or ()),
            ]))
    with open({target!r}, "w", encoding="utf-8") as file:
        file.write("\\n".join(lines) + "\\n")
except BaseException:
    traceback.print_exc()
finally:
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)
"""


def help_lines() -> Iterator[str]:
    """A line an option, for every command; as no argparse of a Python's version lays it out."""
    sys.path.insert(0, str(ROOT / "core"))
    from volfrep.cli import command

    found: list[tuple[str, argparse.ArgumentParser]] = []

    def keep(parser: argparse.ArgumentParser, *_: object, **__: object) -> str:
        if not any(other is parser for _, other in found):
            found.append((parser.prog, parser))
        return ""

    argparse.ArgumentParser.format_help = keep  # type: ignore[method-assign]

    def asked(words: list[str]) -> argparse.ArgumentParser:
        with contextlib.suppress(SystemExit):
            command.run([*words, "--help"])
        return found[-1][1]

    names = [
        name
        for action in asked([])._actions
        if isinstance(action, argparse._SubParsersAction)
        for name in action.choices
    ]
    for name in names:
        asked([name])
    for prog, parser in found:
        yield f"== {prog}: {parser.description}"
        for group in parser._action_groups:
            for action in group._group_actions:
                yield f"{prog} | {group.title} | {option_line(parser, action)}"


def option_line(parser: argparse.ArgumentParser, action: argparse.Action) -> str:
    """Names, shape, choices, default and help of an option."""
    names = ", ".join(action.option_strings) or str(action.dest)
    shape = action.metavar or ("" if action.nargs == 0 else action.dest.upper())
    choices = ", ".join(map(str, action.choices or ()))
    text = parser._get_formatter()._expand_help(action) if action.help else ""
    needed = "required" if action.required else ""
    return " | ".join([names, str(shape), choices, needed, text])


def sentence_lines() -> Iterator[str]:
    """The texts of the sources, and in how many places each stands."""
    found: Counter[str] = Counter()
    for folder in SOURCES:
        for path in sorted((ROOT / folder).rglob("*.py")):
            found.update(texts(ast.parse(path.read_text(encoding="utf-8"))))
    for text, count in sorted(found.items()):
        yield text + (f"  [{count} places]" if count > 1 else "")


def texts(tree: ast.AST) -> Iterator[str]:
    """Every text of two words or more, but for docstrings."""
    inner: set[int] = set()
    for node in ast.walk(tree):
        # A docstring, or a text that stands alone below what it describes.
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            inner.add(id(node.value))
        if isinstance(node, ast.JoinedStr):
            inner |= {id(part) for part in node.values if isinstance(part, ast.Constant)}
            inner |= {
                id(part.format_spec)
                for part in node.values
                if isinstance(part, ast.FormattedValue) and part.format_spec
            }
    for node in ast.walk(tree):
        if id(node) in inner:
            continue
        text = ""
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            text = node.value
        elif isinstance(node, ast.JoinedStr):
            text = "".join(
                str(part.value) if isinstance(part, ast.Constant) else "{}" for part in node.values
            )
        if re.search(r"[A-Za-z]{2,}\W* \W*([A-Za-z]{2,}|\{\})", text):
            yield re.sub(r"\s+", " ", text).strip()


def property_lines(folder: Path) -> list[str] | None:
    """A line a property of our objects; None without FreeCAD.

    Raises:
        RuntimeError: FreeCAD wrote none, with what it said.
    """
    if shutil.which("freecadcmd") is None:
        return None
    target, script = folder / "properties.txt", folder / "properties.py"
    script.write_text(
        _IN_FREECAD.format(root=str(ROOT), core=str(ROOT / "core"), target=str(target)),
        encoding="utf-8",
    )
    home = {"FREECAD_USER_HOME": str(ROOT / ".cache" / "fchome"), **os.environ}
    done = subprocess.run(
        ["freecadcmd", str(script)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
        env=home, timeout=300,
    )  # fmt: skip
    if not target.is_file():
        raise RuntimeError(f"FreeCAD wrote no properties:\n{done.stdout}{done.stderr}")
    return target.read_text(encoding="utf-8").splitlines()


def main() -> int:
    """Compare, or write; 0 where all words are as they were, else 1."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--write", action="store_true", help="keep the words as they are now")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = {"properties.txt": property_lines(Path(folder))}
    found |= {"sentences.txt": list(sentence_lines()), "help.txt": list(help_lines())}
    FOLDER.mkdir(exist_ok=True)
    other = 0
    for name, lines in sorted(found.items()):
        kept = FOLDER / name
        if lines is None:
            print(f"vocabulary: skipped {name}: freecadcmd is not installed")
            continue
        if options.write:
            kept.write_text("\n".join(lines) + "\n", encoding="utf-8")
            print(f"vocabulary: wrote {len(lines)} lines of {name}")
            continue
        before = kept.read_text(encoding="utf-8").splitlines() if kept.is_file() else []
        changes = difflib.unified_diff(
            before, lines, f"{name}, kept", f"{name}, now", "", "", 0, ""
        )
        for line in changes:
            print(line)
            other += 1
    if not options.write:
        print("vocabulary: as it was" if not other else "vocabulary: changed, see above")
    return 1 if other else 0


if __name__ == "__main__":
    sys.exit(main())
