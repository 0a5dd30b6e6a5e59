# SPDX-License-Identifier: LGPL-2.1-or-later
"""Imports go one way: from a room of the engine to those before it, never back, and never round."""

from __future__ import annotations

import ast
import functools
from collections.abc import Iterator
from pathlib import Path

import pytest

ENGINE = Path(__file__).resolve().parents[2] / "core" / "volfrep"
#: The rooms, low to high: a room imports from itself and from those before it.
ROOMS = (
    "util", "process", "mesh", "spatial", "design", "shell", "grid", "octants", "lattice", "tpms",
    "graphs", "mechanics", "trim", "fem", "slicing", "io", "loads", "voxels", "sizing", "continuum",
    "reports", "jobs", "output", "studies", "cli", "api",
)  # fmt: skip
#: A module has one subject, and as many lines as that takes. One of more lines than these says in
#: its docstring why it is long; no other number of lines, or of modules in a folder, is a rule.
LONG = 700
#: Modules one of which imports the next, wherever in it the import stands; of rooms as well.
#: Kinds of lattice stand between what asks them and what they share, in `design` and in `jobs`.
LONGEST_CHAIN = 32
LONGEST_CHAIN_OF_ROOMS = 13


def modules() -> dict[str, Path]:
    """Every module of the engine by its dotted name below ``volfrep``; packages by their own."""
    found = {}
    for path in sorted(ENGINE.rglob("*.py")):
        *rooms, name = path.relative_to(ENGINE).with_suffix("").parts
        found[".".join(rooms if name == "__init__" else [*rooms, name])] = path
    return found


def statements(tree: ast.AST) -> Iterator[ast.AST]:
    """All statements of a module, those within others too, without what they are made of."""
    for part in ("body", "orelse", "handlers", "finalbody", "cases"):
        for statement in getattr(tree, part, ()):
            yield statement
            yield from statements(statement)


def imports(name: str, path: Path, known: dict[str, Path]) -> Iterator[str]:
    """The engine's modules that a module imports, wherever in it the import stands."""
    package = name.split(".") if name else []
    if path.name != "__init__.py":
        package = package[:-1]
    for node in statements(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        base = package[: len(package) - node.level + 1]
        home = ".".join([*base, *(node.module or "").split(".")]).strip(".")
        for alias in node.names:
            inner = f"{home}.{alias.name}".strip(".")
            yield inner if inner in known else home


@functools.cache
def all_imports() -> dict[str, frozenset[str]]:
    """Every module and what it imports, read once."""
    known = modules()
    return {name: frozenset(imports(name, path, known)) for name, path in known.items()}


def test_a_room_imports_from_those_before_it_only() -> None:
    back = [
        f"{name} -> {target}"
        for name, targets in all_imports().items()
        if "." in name
        for target in targets
        if target and ROOMS.index(target.split(".")[0]) > ROOMS.index(name.split(".")[0])
    ]
    assert back == []


def test_no_imports_go_round() -> None:
    targets = {name: set(found) - {name, ""} for name, found in all_imports().items()}
    del targets[""]  # the package itself loads its names when they are first used
    while True:
        free = {name for name, needs in targets.items() if not needs & targets.keys()}
        if not free:
            break
        targets = {name: needs for name, needs in targets.items() if name not in free}
    assert targets == {}


def longest(targets: dict[str, set[str]]) -> list[str]:
    """The longest chain of names one of which has the next among its targets."""
    chains: dict[str, list[str]] = {}

    def chain(name: str) -> list[str]:
        if name not in chains:
            below = (chain(target) for target in sorted(targets[name]))
            chains[name] = [name, *max(below, key=len, default=[])]
        return chains[name]

    return max((chain(name) for name in targets), key=len)


def test_chains_of_imports_are_no_longer_than_they_were() -> None:
    targets = {name: set(found) - {name, ""} for name, found in all_imports().items()}
    del targets[""]
    assert len(longest(targets)) <= LONGEST_CHAIN, longest(targets)
    rooms: dict[str, set[str]] = {room: set() for room in ROOMS}
    for name, needs in targets.items():
        room = name.split(".")[0]
        if room in rooms:
            rooms[room] |= {need.split(".")[0] for need in needs} - {room}
    assert len(longest(rooms)) <= LONGEST_CHAIN_OF_ROOMS, longest(rooms)


@pytest.mark.parametrize("room", [p.name for p in sorted(ENGINE.iterdir()) if p.is_dir()])
def test_every_folder_is_a_room_that_says_what_lives_there(room: str) -> None:
    if room == "__pycache__":
        return
    assert room in ROOMS
    for folder in [ENGINE / room, *(p for p in (ENGINE / room).rglob("*") if p.is_dir())]:
        if folder.name != "__pycache__":
            assert ast.get_docstring(ast.parse((folder / "__init__.py").read_text("utf-8")))


def says_why_it_is_long(text: str) -> bool:
    """Whether a module is of no more than LONG lines, or its docstring says "long because ..."."""
    if len(text.splitlines()) <= LONG:
        return True
    told = ast.get_docstring(ast.parse(text)) or ""
    return "long because" in " ".join(told.split())


def test_a_long_module_says_why() -> None:
    assert [n for n, p in modules().items() if not says_why_it_is_long(p.read_text("utf-8"))] == []


@pytest.mark.parametrize(
    ("told", "lines", "accepted"),
    [
        ("A thing.", LONG, True),
        ("A thing.", LONG + 1, False),
        ("A thing; it is long\nbecause cut in two it would be read in two.", LONG + 1, True),
    ],
)
def test_what_is_long_and_what_is_a_reason(told: str, lines: int, accepted: bool) -> None:
    head = f'"""{told}"""\n'
    assert says_why_it_is_long(head + "x = 1\n" * (lines - head.count("\n"))) == accepted
