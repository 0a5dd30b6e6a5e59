# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes the documentation's lists of parameters from the table that the program uses.

    .venv/bin/python tools/parameter_tables.py

A list stands between two comments in a page of docs/, the first of which names its groups, or the
commands whose other options it has:

    <!-- parameters: Cell size, Strut radius -->
    <!-- end of parameters -->
    <!-- options: fill, block -->
    <!-- end of options -->
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "core"))

from volfrep.cli.run_options import RUN_OPTIONS, RunOption  # noqa: E402
from volfrep.design.parameters import GROUPS, PARAMETERS, Need, Parameter  # noqa: E402
from volfrep.design.parameters.parameter import SHAPES  # noqa: E402
from volfrep.design.parameters.table import RANDOM, WALLS  # noqa: E402

_PLACE = re.compile(
    r"(<!-- parameters: (?P<groups>[^>]*) -->\n).*?(<!-- end of parameters -->)", re.DOTALL
)
_OPTIONS = re.compile(
    r"(<!-- options: (?P<commands>[^>]*) -->\n).*?(<!-- end of options -->)", re.DOTALL
)


def refreshed(text: str) -> str:
    """A page with its lists as they should be.

    Raises:
        ValueError: it asks for a group, or a command, that there is not.
    """
    text = _PLACE.sub(lambda found: found[1] + _table(found["groups"]) + found[3], text)
    return _OPTIONS.sub(lambda found: found[1] + _options(found["commands"]) + found[3], text)


def _options(wanted: str) -> str:
    """What some commands have beside the lattice's options, by the commands that share it."""
    commands = [name.strip() for name in wanted.split(",")]
    known = {name for row in RUN_OPTIONS for name in row.commands}
    strange = [name for name in commands if name not in known]
    if strange:
        raise ValueError(f"No options are known of a command '{strange[0]}'.")
    rooms: dict[tuple[str, ...], list[str]] = {}
    for row in RUN_OPTIONS:
        shared = tuple(name for name in commands if name in row.commands)
        if shared:
            rooms.setdefault(shared, []).append(_option(row))
    lines = []
    for shared in sorted(rooms, key=lambda names: (commands.index(names[0]), -len(names))):
        lines += [f"\n**{', '.join(shared)}**\n\n", *rooms[shared]]
    return "".join(lines) + "\n"


def _option(row: RunOption) -> str:
    shape = "|".join(row.choices) or row.shape
    names = ", ".join(row.names)
    option = f"{names} {shape}".strip()
    needed = (" (one is required)" if row.either else " (required)") if row.required else ""
    return f"- `{option}`: {row.help}{needed}\n"


def _table(wanted: str) -> str:
    names = [name.strip() for name in wanted.split(",")]
    strange = [name for name in names if name not in GROUPS]
    if strange:
        raise ValueError(f"There is no group of parameters '{strange[0]}'.")
    lines = []
    for name in names:
        lines.append(f"\n### {name}\n\n")
        lines += [_row(parameter) for parameter in PARAMETERS if parameter.group == name]
    return "".join(lines) + "\n"


def _row(row: Parameter) -> str:
    """What it is called, its default, and what it means; in italics what it needs.

    What the needed parameters need themselves is told with those.
    """
    option = [f"`{row.option}{_shape(row)}`"] if row.in_command else []
    default = row.default_text or ("required" if row.required else "")
    if row.unit and row.default:
        default += f" {row.unit}"
    if row.in_freecad and row.initial is not None:
        default += f"; {row.initial} in FreeCAD"
    told = f" ({default})" if default and (row.kind != "flag" or row.default) else ""
    told_there = {
        need
        for own in row.needs
        for other in PARAMETERS
        if other.name in own.names and not own.absent
        for need in other.needs
    }
    wanted = [_need(need) for need in row.needs if need not in told_there]
    needs = f" *({', '.join(wanted)})*" if wanted else ""
    names = ", ".join([*option, *_properties(row)])
    return f"- {names}{told}: {row.help}{_choices(row)}{needs}\n"


def _shape(row: Parameter) -> str:
    if row.kind == "flag":
        return ""
    return f" {SHAPES[row.kind]}" if row.kind in SHAPES else " WORD"


def _properties(row: Parameter) -> list[str]:
    """The property or properties."""
    if not row.in_freecad:
        return []
    own = [] if row.position_of else [f"`{row.property_name}`"]
    return [f"`{row.switch_name}`", *own] if row.switch else own


def _choices(row: Parameter) -> str:
    if all(f"{word}:" in row.help for word in row.choices):  # which explains them
        return ""
    return f" (`{'`, `'.join(row.choices)}`)"


def _need(need: Need) -> str:
    names = " or ".join(name.replace("_", " ") for name in need.names)
    if need.absent and need.values == WALLS:
        return "struts"
    if need.absent:
        return f"no {names}"
    if need.values == WALLS:
        return f"{names} a [TPMS](tpms.md)"
    if need.values == RANDOM:
        return "random points"
    words = [str(value) for value in need.values]
    return f"{names} {' or '.join(filter(None, (', '.join(words[:-1]), *words[-1:])))}".strip()


def main() -> None:
    """Refresh every page that has such a list."""
    for page in sorted((ROOT / "docs").rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        now = refreshed(text)
        if now != text:
            page.write_text(now, encoding="utf-8")
            print(f"{page.relative_to(ROOT)}: refreshed")


if __name__ == "__main__":
    main()
