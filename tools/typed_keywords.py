# SPDX-License-Identifier: LGPL-2.1-or-later
"""The types of a call's keywords, from the table of parameters: what an editor completes.

python tools/typed_keywords.py     # writes core/volfrep/design/parameters/typed.py anew
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "core"))

from volfrep.design.parameters.keywords import FIELDS, KEYS, WORDS  # noqa: E402
from volfrep.design.parameters.table import BY_NAME  # noqa: E402
from volfrep.jobs.sizing import GOALS  # noqa: E402

FILE = ROOT / "core" / "volfrep" / "design" / "parameters" / "typed.py"
_HEAD = '''# SPDX-License-Identifier: LGPL-2.1-or-later
"""The keywords of `fill`, `block`, `size`; written by tools/typed_keywords.py."""

from __future__ import annotations

from typing import Any, Literal, TypedDict


class Keywords(TypedDict, total=False):
    """Keys of a specification's file, and fields of a `LatticeSpec`."""

'''
_TYPES = {"flag": "bool", "length": "float | None", "angle": "float", "number": "float | None"}


def type_of(name: str) -> str:
    """How a keyword is annotated; Any where several kinds of value are taken."""
    row = BY_NAME.get(name)
    if row is None or name not in KEYS or name in WORDS:
        return "Any"
    if row.choices:
        return f"Literal[{', '.join(repr(word) for word in row.choices)}]".replace("'", '"')
    return _TYPES.get(row.kind, "Any")


def comment_of(name: str) -> str:
    """What an editor shows beside a keyword."""
    row = BY_NAME.get(name)
    if row is None or name not in KEYS:
        return f"A `LatticeSpec`'s {name}."
    unit = f", {row.unit}" * bool(row.unit)
    default = f"; {row.default_text} if not given" * bool(row.default_text)
    return f"{row.help}{unit}{default}"


def text() -> str:
    """The module."""
    lines = [_HEAD]
    for name in sorted(KEYS | FIELDS):
        words = " ".join(comment_of(name).split())
        cut = words if len(words) <= 92 else words[:89].rsplit(" ", 1)[0] + " ..."
        lines.append(f"    #: {cut}\n    {name}: {type_of(name)}\n")
    lines.append("\n\nclass SizeKeywords(Keywords, total=False):\n")
    lines.append('    """Those, and what is wanted of sized struts."""\n\n')
    lines += [f"    {name}: float\n" for name in GOALS]
    return "".join(lines)


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
