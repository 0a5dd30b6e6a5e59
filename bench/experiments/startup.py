# SPDX-License-Identifier: LGPL-2.1-or-later
"""How long the command takes to say what it can do."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Any

from ..measuring import Context, run_often
from ..tables import bar

LIMIT = 0.15
TIMES = 7


def measure(context: Context) -> dict[str, Any]:
    """``volfrep --help``, the median of some runs."""
    program = shutil.which("volfrep", path=str(Path(sys.executable).parent))
    if program is None:
        raise RuntimeError("the command volfrep is not installed beside this Python")
    done, seconds = run_often([program, "--help"], TIMES)
    row = context.say({"command": "volfrep --help", "seconds": done.seconds, "all": seconds})
    if done.failure:
        row |= {"note": done.failure, "failed": True}
    return {"rows": [row], "bars": [bar("`volfrep --help`", done.seconds, LIMIT, "s", ".3f")]}


def render(result: dict[str, Any], images: Path) -> str:
    """One sentence."""
    row = result["rows"][0]
    return (
        f"## Start of the command\n\n`volfrep --help`: {row['seconds']:.3f} s, the median of "
        f"{len(row['all'])} runs ({row['all'][0]:.3f} to {row['all'][-1]:.3f} s)."
    )
