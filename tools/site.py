# SPDX-License-Identifier: LGPL-2.1-or-later
"""The documentation as a site: docs/ and what else a reader needs, in build/site.

    make site        # into build/site; a warning is an error

The pages are those of the checkout; only links that leave docs/ are changed. The reference of the
API is made of the docstrings of `volfrep.__all__`, whose examples the tests run.
"""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = ROOT / "build" / "site-pages"
#: Pages of the top, and their names on the site.
TOP = {
    "README.md": "index.md",
    "ARCHITECTURE.md": "architecture.md",
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
}
ICONS = "freecad_volfrep/resources/icons"
#: The table behind docs/validation.md, which it links to.
SPECIMENS = "tools/validation/specimens.toml"

#: Tables without headings, words of code that are not cut in two, and room for both.
STYLE = """\
.md-grid { max-width: 76rem; }
.md-typeset table:not([class]) thead:not(:has(th:not(:empty))) { display: none; }
.md-typeset td code { word-break: normal; }
.md-typeset table:not([class]) td img { max-width: 11rem; display: block; }
"""


def public_names() -> list[str]:
    """The names that the package promises, from its source."""
    tree = ast.parse((ROOT / "core" / "volfrep" / "__init__.py").read_text("utf-8"))
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return list(ast.literal_eval(node.value))
    raise SystemExit("core/volfrep/__init__.py has no __all__")


def homes() -> dict[str, str]:
    """Where each public name is, dotted."""
    tree = ast.parse((ROOT / "core" / "volfrep" / "__init__.py").read_text("utf-8"))
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "_HOMES":
            table = ast.literal_eval(node.value)
            return {
                name: "volfrep." + (place.replace(":", ".") if ":" in place else f"{place}.{name}")
                for name, place in table.items()
            }
    raise SystemExit("core/volfrep/__init__.py has no _HOMES")


def gather(pages: Path = PAGES) -> None:
    """Copy the pages to one folder, with links that lead somewhere there."""
    shutil.rmtree(pages, ignore_errors=True)
    shutil.copytree(ROOT / "docs", pages, ignore=shutil.ignore_patterns("upstream", "gallery"))
    (pages / "commands" / "README.md").rename(pages / "commands" / "index.md")
    shutil.copytree(ROOT / ICONS, pages / "images" / "icons")
    shutil.copy(ROOT / SPECIMENS, pages)
    for source, name in TOP.items():
        text = (ROOT / source).read_text("utf-8")
        text = re.sub(r"\]\(docs/decisions\)", "](decisions/01-octants.md)", text)
        text = text.replace("](docs/", "](").replace("](LICENSE)", "](license.md)")
        for other, new in TOP.items():
            text = text.replace(f"]({other})", f"]({new})")
        (pages / name).write_text(text.replace("commands/README.md", "commands/index.md"), "utf-8")
    licence = (ROOT / "LICENSE").read_text("utf-8")
    (pages / "license.md").write_text(f"# Licence\n\n```text\n{licence}\n```\n", "utf-8")
    for page in pages.rglob("*.md"):
        text = page.read_text("utf-8")
        up = "../" * (len(page.relative_to(pages).parts) - 1)
        text = text.replace(f"{up}../{ICONS}/", f"{up}images/icons/")
        for source, name in TOP.items():
            text = re.sub(rf"\]\({up}\.\./{source}(?=[)#])", f"]({up}{name}", text)
        text = text.replace("commands/README.md", "commands/index.md")
        text = text.replace("](gallery)", "](gallery.md)")
        text = re.sub(
            r"\]\(gallery/(\w+)\.py\)",
            lambda script: f"](gallery.md#{script[1].replace('_', '-')})",
            text,
        )
        text = text.replace(f"](../{SPECIMENS})", f"]({Path(SPECIMENS).name})")
        if page.parent.name == "commands":
            text = text.replace("](README.md", "](index.md")
        page.write_text(text, "utf-8")
    shown = ["# Gallery", "", "Short scripts, each run by the tests.", ""]
    for script in sorted((ROOT / "docs" / "gallery").glob("*.py")):
        title = script.stem.replace("_", " ").capitalize()
        text = script.read_text("utf-8").partition("\n")[2].strip()  # without the licence's line
        told = ast.get_docstring(ast.parse(text)) or ""
        code = text.partition('"""\n')[2].strip()
        shown += [f"## {title}", "", told, "", "```python", code, "```", ""]
    (pages / "gallery.md").write_text("\n".join(shown), "utf-8")
    reference = ["# Python", "", "Every name that the package promises, `volfrep.NAME`.", ""]
    where = homes()
    for name in sorted(public_names(), key=str.lower):
        options = f"      heading: volfrep.{name}\n      toc_label: {name}\n      heading_level: 2"
        reference += [f"::: {where[name]}", "    options:", options, ""]
    (pages / "site.css").write_text(STYLE, "utf-8")
    (pages / "python.md").write_text("\n".join(reference), "utf-8")


if __name__ == "__main__":
    gather()
    command = [sys.executable, "-m", "mkdocs", "build", "--strict"]
    raise SystemExit(subprocess.run([*command, "-f", str(ROOT / "mkdocs.yml")]).returncode)
