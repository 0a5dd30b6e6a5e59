# SPDX-License-Identifier: LGPL-2.1-or-later
"""The types of a call's keywords, from the table of parameters: what an editor completes.

python tools/typed_keywords.py     # writes core/volfrep/design/parameters/typed.py anew
"""

from __future__ import annotations

import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "core"))

from volfrep.design.parameters.field_keywords import FIELD_KEYWORDS  # noqa: E402
from volfrep.design.parameters.keywords import FIELDS, KEYS, WORDS  # noqa: E402
from volfrep.design.parameters.table import BY_NAME  # noqa: E402
from volfrep.jobs.sizing import GOALS  # noqa: E402
from volfrep.util.numbers import RANGES  # noqa: E402

FILE = ROOT / "core" / "volfrep" / "design" / "parameters" / "typed.py"
_HEAD = '''# SPDX-License-Identifier: LGPL-2.1-or-later
"""The keywords of `fill`, `block`, `size`; written by tools/typed_keywords.py."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypedDict

from numpy.typing import ArrayLike

from ..grading import Field

#: A value by place: a function of (n, 3) points that gives (n,) values, a formula of x, y and z,
#: or (n, 3) points and (n,) values.
ByPlace = Callable[[Any], ArrayLike] | str | tuple[ArrayLike, ArrayLike] | Field


class Keywords(TypedDict, total=False):
    """Keys of a specification's file, and fields of a `LatticeSpec`."""

'''
_TYPES = {
    "flag": "bool",
    "length": "float | str | None",
    "angle": "float | str",
    "mass": "float | str | None",
    "density": "float | str | None",
    "number": "float | None",
    "integer": "int | None",
    "text": "str",
    "formula": "str",
}


def type_of(name: str) -> str:
    """How a keyword is annotated; Any where several kinds of value are taken."""
    row = BY_NAME.get(name)
    if row is None or name not in KEYS or name in WORDS:
        return "Any"
    if name in FIELD_KEYWORDS:
        return "str | ByPlace" if row.kind in ("file", "text") else "float | ByPlace | None"
    if row.choices:
        return f"Literal[{', '.join(repr(word) for word in row.choices)}]".replace("'", '"')
    return _TYPES.get(row.kind, "Any")


def comment_of(name: str) -> str:
    """What an editor shows beside a keyword."""
    row = BY_NAME.get(name)
    if row is None or name not in KEYS:
        return f"A `LatticeSpec`'s {name}."
    least, most = RANGES.get(row.unit, RANGES[""])
    unit = f", {row.unit}" * bool(row.unit)
    if row.kind in ("length", "mass", "density", "number"):
        nothing = "0 or " * (row.default == 0.0)
        unit += f", {nothing}{least:g} to {most:g}"
    default = f"; {row.default_text} if not given" * bool(row.default_text)
    by_place = "; or by place" * (name in FIELD_KEYWORDS)
    return f"{row.help}{unit}{default}{by_place}."


def text() -> str:
    """The module."""
    lines = [_HEAD]
    for name in sorted(KEYS | FIELDS):
        words = textwrap.wrap(f'"""{comment_of(name)}"""', 96)
        told = "\n".join(f"    {line}" for line in words)
        closed = told if len(words) == 1 else told.removesuffix('"""') + '\n    """'
        lines.append(f"    {name}: {type_of(name)}\n{closed}\n")
    lines.append("\n\nclass SizeKeywords(Keywords, total=False):\n")
    lines.append('    """Those, and what is wanted of sized struts."""\n\n')
    lines += [f"    {name}: float\n" for name in GOALS]
    return "".join(lines)


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
