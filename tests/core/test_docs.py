# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of the workbench and their help: every one has its page and icon, no link is dead.

The table of commands is read as text: it can be imported inside FreeCAD only.
"""

import ast
import importlib.util
import inspect
import re
import runpy
import shlex
from operator import attrgetter
from pathlib import Path

import pytest

import volfrep
from volfrep.api import accepted
from volfrep.cli.command import make_parser
from volfrep.design.parameters import GROUPS, PARAMETERS

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = DOCS / "commands"
ICONS = ROOT / "freecad_volfrep" / "resources" / "icons"
#: Of FreeCAD 0.20 and 1.0 after the key L: Draft's line, Arch's level, BIM's leader.
TAKEN = {"L, I", "L, V", "L, E"}
SECTIONS = ("## Description", "## Usage")


def table() -> dict[str, tuple[str, str, str]]:
    """Icon, menu text and shortcut of each command, by its name."""
    source = (ROOT / "freecad_volfrep" / "gui" / "commands" / "table.py").read_text(
        encoding="utf-8"
    )
    found = {}
    for call in ast.walk(ast.parse(source)):
        if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Name):
            continue
        texts = [a.value for a in call.args if isinstance(a, ast.Constant)]
        if call.func.id == "Command" and len(texts) == 5:
            name, icon, text, _, keys = texts
            found[name] = icon, text, keys
        elif call.func.id == "_example":
            name, icon, text, _ = texts
            found[f"VOLFREP_Example{name}"] = icon, text, ""
    return found


COMMANDS = table()


def test_the_table_was_read() -> None:
    names = {"VOLFREP_LatticeInfill", "VOLFREP_CellLibrary", "VOLFREP_ExampleBracket"}
    assert names <= set(COMMANDS)
    assert len(COMMANDS) >= 15


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_a_command_has_its_icon_and_its_page(name: str) -> None:
    icon, text, keys = COMMANDS[name]
    assert (ICONS / icon).is_file()
    page = (PAGES / f"{name}.md").read_text(encoding="utf-8")
    title, _, picture = page.splitlines()[:3]
    assert title.startswith(f"# {text}")
    assert picture.endswith(f"icons/{icon})")
    shortcut = " ".join(f"`{key}`" for key in keys.split(", ") if key)
    assert shortcut in page.split("## Description")[0]
    assert all(section in page for section in SECTIONS)
    assert f"({name}.md)" in (PAGES / "README.md").read_text(encoding="utf-8")


def test_every_shortcut_is_of_one_command() -> None:
    keys = [keys for _, _, keys in COMMANDS.values() if keys]
    assert len(keys) == len(set(keys))
    assert not TAKEN & set(keys)
    assert all(key.startswith("L, ") for key in keys), "TAKEN knows these only"


def test_no_page_is_without_a_command() -> None:
    pages = {path.stem for path in PAGES.glob("VOLFREP_*.md")}
    assert pages == set(COMMANDS)


def calls_of_examples() -> list[tuple[str, str, set[str]]]:
    """Page, function and keywords of every call of the package in the pages' Python."""
    found = []
    for page in [*sorted(DOCS.rglob("*.md")), ROOT / "README.md"]:
        for code in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.S):
            for call in ast.walk(ast.parse(code)):
                name = ast.unparse(call.func) if isinstance(call, ast.Call) else ""
                if re.fullmatch(r"volfrep(\.\w+)+", name):
                    keywords = {word.arg for word in call.keywords if word.arg is not None}
                    found.append((page.name, name.removeprefix("volfrep."), keywords))
    return found


def test_every_keyword_of_an_example_exists() -> None:
    calls = calls_of_examples()
    assert ("engine.md", "fill", {"cell", "cell_size", "strut_radius", "shell"}) in calls
    for page, name, keywords in calls:
        function = attrgetter(name)(volfrep)
        own = set(inspect.signature(function).parameters)
        if "parameters" in own:
            own |= accepted()
        assert keywords <= own, f"{page}: {name}"


def commands_of_examples() -> list[tuple[str, list[str]]]:
    """Page and arguments of every command that a page or the workflow file shows."""
    pages = [*sorted(DOCS.rglob("*.md")), ROOT / "README.md"]
    shown = [
        (p.name, t)
        for p in pages
        for t in re.findall(r"```sh\n(.*?)```", p.read_text("utf-8"), re.S)
    ]
    shown.append(("tests.yml", (ROOT / ".github" / "workflows" / "tests.yml").read_text("utf-8")))
    return [
        (name, shlex.split(line.strip(), comments=True)[1:])
        for name, text in shown
        for line in text.replace("\\\n", " ").splitlines()
        if line.strip().startswith("volfrep ")
    ]


def test_every_command_that_is_shown_is_understood() -> None:
    commands = commands_of_examples()
    assert {"tpms.md", "README.md", "tests.yml"} <= {name for name, _ in commands}
    parser = make_parser()
    for _, arguments in commands:
        parser.parse_args([re.sub(r"\$\w+", "1", word) for word in arguments if word != "..."])


@pytest.mark.parametrize(
    "page", [*sorted(DOCS.rglob("*.md")), ROOT / "README.md"], ids=lambda p: p.name
)
def test_every_link_leads_to_a_file(page: Path) -> None:
    links = re.findall(r"\]\(([^)#\s]+)", page.read_text(encoding="utf-8"))
    local = [link for link in links if "://" not in link]
    assert [link for link in local if not (page.parent / link).exists()] == []


def test_every_link_of_the_site_leads_to_a_page_of_it(tmp_path: Path) -> None:
    site = runpy.run_path(str(ROOT / "tools" / "site.py"))
    site["gather"](tmp_path / "pages")
    dead = [
        f"{page.name}: {link}"
        for page in sorted((tmp_path / "pages").rglob("*.md"))
        for link in re.findall(r"\]\(([^)#\s]+)", page.read_text(encoding="utf-8"))
        if "://" not in link and not (page.parent / link).exists()
    ]
    assert dead == []


def anchors(page: Path) -> set[str]:
    """What a page's headings are called in links, as GitHub makes it of them."""
    titles = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def test_every_link_to_a_heading_finds_it() -> None:
    pages = [
        *sorted(DOCS.rglob("*.md")),
        *(ROOT / name for name in ("README.md", "ARCHITECTURE.md")),
    ]
    links = [
        (page, name, anchor)
        for page in pages
        for name, anchor in re.findall(r"\]\(([^)#:]*)#([^)]+)\)", page.read_text(encoding="utf-8"))
    ]
    assert len(links) > 20
    dead = [
        f"{page.name}: {name}#{anchor}"
        for page, name, anchor in links
        if anchor not in anchors(page.parent / name if name else page)
    ]
    assert dead == []


def test_the_modules_that_the_architecture_names_exist() -> None:
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    homes = (ROOT, ROOT / "core" / "volfrep", ROOT / "freecad_volfrep")
    named = set(re.findall(r"`((?:\w+/)+\w+(?:\.py|\.json|\.txt)?)(?:\.[\w.]+)?/?`", text))
    assert len(named) > 30
    gone = [
        name
        for name in sorted(named)
        if not any((home / f"{name}{end}").exists() for home in homes for end in ("", ".py"))
    ]
    assert gone == []


def test_the_tutorials_pictures_are_small_and_used() -> None:
    folder = DOCS / "images" / "tutorial"
    pictures = sorted(folder.rglob("*.png"))
    texts = "".join(path.read_text(encoding="utf-8") for path in DOCS.rglob("*.md"))
    assert [path.name for path in pictures if path.stat().st_size >= 150_000] == []
    assert [
        path.name
        for path in pictures
        if f"tutorial/{path.relative_to(folder).as_posix()}" not in texts
    ] == []


def parameter_tables():
    """The tool that writes the tables of parameters."""
    path = ROOT / "tools" / "parameter_tables.py"
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("page", sorted(DOCS.rglob("*.md")), ids=lambda p: p.name)
def test_the_tables_of_parameters_are_those_of_the_program(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert parameter_tables().refreshed(text) == text, "run make docs-tables"


def test_every_parameter_stands_in_one_table() -> None:
    texts = [page.read_text(encoding="utf-8") for page in sorted(DOCS.rglob("*.md"))]
    shown = [
        name.strip()
        for text in texts
        for groups in re.findall(r"<!-- parameters: ([^>]*) -->", text)
        for name in groups.split(",")
    ]
    assert sorted(shown) == sorted(GROUPS)
    tables = "".join(re.findall(r"<!-- parameters.*?<!-- end", "".join(texts), re.DOTALL))
    assert [p.name for p in PARAMETERS if p.help not in tables] == []


def test_a_group_that_there_is_not_is_refused() -> None:
    with pytest.raises(ValueError, match="no group of parameters 'Grading'"):
        parameter_tables().refreshed("<!-- parameters: Grading -->\n<!-- end of parameters -->")
