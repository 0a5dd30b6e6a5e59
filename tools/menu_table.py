# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of docs/commands/clicked.md anew, from what `make test-menu` has seen in each FreeCAD.

First run it here, and with tools/freecad_in.sh in the others: what their runs left lies in build/.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/commands/clicked.md"
#: Of the runs' folders, in the order of FreeCAD's releases.
FOLDERS = ("", "debian13", "forky")
HEAD = """# Clicked in each FreeCAD

What a real click on each entry of the menu brought in FreeCAD {versions} with a lattice selected; `make test-menu` found no error in the report view and no window beyond the screen. With nothing selected {alike} bring the same, and the others are grey.

| it brought | commands |
| --- | --- |
"""  # noqa: E501


def told(seen: dict[str, str]) -> str:
    """What was seen, once where all releases showed the same."""
    short = {
        version: "grey" if text.startswith("grey: ") else text for version, text in seen.items()
    }
    if len(set(short.values())) == 1:
        return next(iter(short.values()))
    return "; ".join(f"{version}: {text}" for version, text in short.items())


def page(runs: list[dict[str, Any]]) -> str:
    """The page, of runs in the order of their releases."""
    tables = {str(run["FreeCAD"]): run["seen"] for run in runs}
    commands = list(dict.fromkeys(name for table in tables.values() for name in table))
    rows: dict[str, list[str]] = {}
    alike = []
    for name in commands:
        brought, without = (
            told(
                {version: table.get(name, {}).get(given, "-") for version, table in tables.items()}
            )
            for given in ("a lattice", "nothing")
        )
        if without == brought != "grey":
            alike.append(name)
        elif without != "grey":
            brought += f"; with nothing selected: {without}"
        kind, _, rest = brought.partition(" *")
        if rest and ";" not in brought:  # one window, box or object of a name
            brought = f"{kind} of that name"
            name += "" if rest == f"{name}*" else f" (*{rest})"
        rows.setdefault(brought, []).append(name)
    lines = [f"| {brought} | {', '.join(names)} |\n" for brought, names in rows.items()]
    return HEAD.format(versions=", ".join(tables), alike=", ".join(alike)) + "".join(lines)


def main() -> None:
    """Write the page's table, if every release was run; what follows it stays."""
    paths = [ROOT / "build" / folder / "gui" / "menu.json" for folder in FOLDERS]
    missing = [str(path.relative_to(ROOT)) for path in paths if not path.is_file()]
    if missing:
        sys.exit(f"menu-table: {', '.join(missing)} is missing: run `make test-menu` there.")
    runs = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    _, heading, rest = PAGE.read_text(encoding="utf-8").partition("\n## ")
    PAGE.write_text(page(runs) + heading + rest, encoding="utf-8")


if __name__ == "__main__":
    main()
