# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keeps the translations: every text of the window in each volfrep_LANGUAGE.ts, compiled to .qm.

    python tools/translations.py

New texts come in as unfinished, texts that are gone are dropped, translations stay. Edit the .ts
files with Qt Linguist or by hand, then run this again. lrelease is Qt's, in Debian's package
qttools5-dev-tools; the .qm files are committed, so that nobody else needs it.

Qt's own lupdate does not know our tables, nor texts that Python joins from several literals.
"""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "freecad_volfrep" / "resources" / "translations"
#: A text and the context that it is looked up in.
Text = tuple[str, str]
#: Functions whose arguments are a context and a text.
_MARKS = ("translate", "QT_TRANSLATE_NOOP")
#: Functions and classes of tables, with the context of the arguments of these numbers.
_TABLES = {
    "Format": ("VolfrepFormats", (0,)),
    "Kind": ("VolfrepSolids", (1,)),
    "job_title": ("VolfrepJobs", (0,)),
    "Preference": ("VolfrepPreferences", (1, 2)),
    "Colour": ("VolfrepPreferences", (1, 2)),
    "Property": ("App::Property", (2, 3)),
    "result": ("App::Property", (2,)),
    "wants": ("VolfrepCommands", (0,)),
}
_HEAD = """<?xml version="1.0" encoding="utf-8"?>
<!-- SPDX-License-Identifier: LGPL-2.1-or-later -->
<!DOCTYPE TS>"""


def texts() -> list[Text]:
    """Every text of the sources that is to be translated, sorted, each once."""
    found: set[Text] = set()
    found.update(_of_parameters())
    for path in [ROOT / "InitGui.py", *sorted((ROOT / "freecad_volfrep").rglob("*.py"))]:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        constants = {
            node.targets[0].id: node.value.value
            for node in tree.body
            if isinstance(node, ast.Assign)
            and isinstance(node.targets[0], ast.Name)
            and isinstance(node.value, ast.Constant)
        }
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                values = [_literal(argument, constants) for argument in node.args]
                found.update(_marked(node.func.id, values))
    return sorted((context, text) for context, text in found if text)


def _of_parameters() -> Iterator[Text]:
    """The texts of the engine's tables: parameters that become properties, forms of output."""
    sys.path.insert(0, str(ROOT / "core"))
    from volfrep.design.parameters import PARAMETERS
    from volfrep.output.form import FORMS

    yield from (("VolfrepFormats", form.title) for form in FORMS)
    for row in PARAMETERS:
        if row.in_freecad:
            texts = [row.group, *row.labels]
            if not row.position_of:
                texts += [row.help, _spaced(row.property_name)]
            if row.switch:
                texts += [row.switch, _spaced(row.switch_name)]
            yield from (("App::Property", text) for text in texts)


def placeholders(text: str) -> list[str]:
    """What is put in: {label}, {size:g}."""
    return sorted(re.findall(r"\{[^}]*\}", text))


def read(path: Path) -> dict[Text, str]:
    """The finished translations of a .ts file."""
    translations = {}
    for context in ElementTree.parse(path).getroot().iter("context"):
        for message in context.iter("message"):
            translation = message.find("translation")
            if translation is not None and translation.get("type") is None and translation.text:
                key = context.findtext("name") or "", message.findtext("source") or ""
                translations[key] = translation.text
    return translations


def write(path: Path, language: str, wanted: list[Text], translations: dict[Text, str]) -> None:
    """Write a .ts file of the wanted texts; those without a translation are unfinished."""
    root = ElementTree.Element("TS", version="2.1", language=language, sourcelanguage="en")
    context, node = None, root
    for name, text in wanted:
        if name != context:
            context, node = name, ElementTree.SubElement(root, "context")
            ElementTree.SubElement(node, "name").text = name
        message = ElementTree.SubElement(node, "message")
        ElementTree.SubElement(message, "source").text = text
        translation = ElementTree.SubElement(message, "translation")
        translation.text = translations.get((name, text))
        if translation.text is None:
            translation.set("type", "unfinished")
    ElementTree.indent(root)
    body = ElementTree.tostring(root, encoding="unicode")
    path.write_text(f"{_HEAD}\n{body}\n", encoding="utf-8")


def _literal(node: ast.expr, constants: dict[str, str]) -> str | None:
    """The text that an argument is; None for what is not written out."""
    if isinstance(node, ast.Name):
        return constants.get(node.id)
    if isinstance(node, ast.Call) and len(node.args) == 2:  # of a mark inside a table
        return None
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


def _marked(function: str, values: list[str | None]) -> list[Text]:
    """The texts of one call with these literal arguments."""
    found = []
    if function in _MARKS and len(values) == 2 and None not in values:
        found.append((values[0], values[1]))
    elif function == "marked" and values[0]:
        found += [(values[0], text) for text in values[1:] if text]
    elif function in _TABLES:
        context, places = _TABLES[function]
        found += [(context, values[k]) for k in places if k < len(values) and values[k]]
        if context == "App::Property" and len(values) > 1 and values[1]:
            found.append((context, _spaced(values[1])))
    elif function == "Command" and len(values) > 4 and values[0]:
        found += [(values[0], values[2]), (values[0], values[3])]
    elif function == "_example":
        found += [(f"VOLFREP_Example{values[0]}", values[k]) for k in (2, 3)]
    return found


def _spaced(name: str) -> str:
    """As `freecad_volfrep.translation.spaced`, which only FreeCAD can import."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)


def main() -> int:
    """Refresh and compile; returns 1 where texts are unfinished."""
    lrelease = shutil.which("lrelease")
    if lrelease is None:
        print("lrelease is missing: install Debian's qttools5-dev-tools.", file=sys.stderr)
        return 2
    wanted, missing = texts(), 0
    for path in sorted(FOLDER.glob("volfrep_*.ts")):
        translations = read(path)
        write(path, path.stem.removeprefix("volfrep_"), wanted, translations)
        unfinished = [text for text in wanted if text not in translations]
        missing += len(unfinished)
        for context, text in unfinished:
            print(f"{path.name}: unfinished: {context}: {text}")
        subprocess.run([lrelease, "-silent", path, "-qm", path.with_suffix(".qm")], check=True)
        print(f"{path.name}: {len(wanted)} texts, {len(unfinished)} unfinished")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
