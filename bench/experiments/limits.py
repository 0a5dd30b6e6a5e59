# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files within limits: what 20 files of parts use of 65 to 90 % of what they would have."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ..measuring import ROOT, Context, run, volfrep
from ..parts import MODELLED, PARTS, modelled_file
from ..tables import Row

#: Least that a file is to use of its limit.
LEAST = 0.7
_FORMULA = (
    "--cell CVC --cell-size 10 --shell 3 --radius-grading direction --radius-profile formula "
    "--radius-formula 0.6+0.6*s"
)
#: Part (modelled ones by their names), lattice, extension, most triangles, most MB; small ones
#: first. Between formulas 0.6 + 0.6 s of 13 and of 17 facets joints are divided.
JOBS = (
    ("trimesh_angle_block.STL", "--cell BCC --cell-size 0.2 --strut-radius 0.02 --shell 0.05",
     "stl", 250_000, None),
    ("conrod_slevin48.stl", "--cell Octet --cell-size 0.4 --strut-radius 0.03 --shell 0.06",
     "stl", None, 8.0),
    ("comodo_bracket_01.stl", "--cell BCC --cell-size 8 --strut-radius 0.8 --shell 2",
     "3mf", None, 1.7),
    ("three_bodies", "--cell Diamond --cell-size 6 --strut-radius 0.6 --shell 1",
     "glb", 300_000, None),
    ("axom_naca0012.stl", "--cell CVC --cell-size 0.08 --strut-radius 0.008 --shell 0.02",
     "ply", 400_000, None),
    ("comodo_bracket_01.stl", "--cell Gyroid --cell-size 12 --wall-thickness 1.2 --shell 2",
     "obj", None, 6.0),
    ("imported_flange", "--cell CVC --cell-size 6 --strut-radius 0.6 --shell 2",
     "3mf", None, 4.5),
    ("odri_lower_leg_v2.STL", "--cell CVC --cell-size 5 --strut-radius 0.5 --shell 1",
     "3mf", 350_000, None),
    ("piston_rod", "--cell BCC --cell-size 4 --strut-radius 0.4 --shell 0.8",
     "obj", None, 15.0),
    ("piston_rod.stl", "--cell CVC --cell-size 3 --strut-radius 0.3 --shell 1",
     "stl", None, 20.0),
    ("piston_rod.stl", "--cell Gyroid --cell-size 6 --wall-thickness 0.6 --shell 1",
     "ply", 250_000, None),
    ("bracket", "--cell FCC --cell-size 12 --strut-radius 1 --shell 2", "ply", None, 13.0),
    ("ge_bracket.stl", "--cell CVC --cell-size 10 --strut-radius 1 --shell 3",
     "stl", 600_000, None),
    ("ge_bracket.stl", "--cell Octet --cell-size 15 --strut-radius 1 --shell 2",
     "stl", 750_000, None),
    ("ge_bracket.stl", "--cell Gyroid --cell-size 16 --wall-thickness 1.6 --shell 3",
     "3mf", None, 10.0),
    ("ge_bracket.stl", _FORMULA, "stl", 770_000, None),
    ("fw_ExpansionCard_SelfTapping.stl",
     "--cell BCC --cell-size 2 --strut-radius 0.16 --shell 0.3", "stl", None, 30.0),
    ("ribbed_housing", "--cell BCC --cell-size 5 --strut-radius 0.5 --shell 1",
     "off", 600_000, None),
    ("numpystl_rear_case.stl", "--cell BCC --cell-size 5 --strut-radius 0.5 --shell 1",
     "stl", None, 30.0),
    ("odri_electronics_box_base.STL", "--cell BCC --cell-size 6 --strut-radius 0.5 --shell 1.5",
     "stl", 1_000_000, None),
)  # fmt: skip
QUICK = 4


def measure(context: Context) -> dict[str, Any]:
    """One job after the other."""
    rows = [_job(context, *job) for job in (JOBS[:QUICK] if context.quick else JOBS)]
    made = [row for row in rows if "used" in row]
    met = sum(LEAST <= row["used"] <= 1.0 for row in made)
    there = [row for row in rows if not row.get("absent")]
    bars = [
        {"text": f"files within limits that use {LEAST:.0%} of them",
         "bar": f"all of {len(there)}", "measured": str(met), "met": met == len(there)}
    ]  # fmt: skip
    return {"rows": rows, "bars": bars}


def _job(
    context: Context,
    part: str,
    lattice: str,
    suffix: str,
    most: int | None,
    megabytes: float | None,
) -> Row:
    row: Row = {
        "part": part,
        "lattice": lattice,
        "file": suffix,
        "most": most,
        "most_mb": megabytes,
    }
    path = modelled_file(part, ROOT / "build/parts") if part in MODELLED else PARTS / part
    if not path.is_file():
        return context.say({**row, "note": "left out: not at hand", "absent": True})
    out, report = context.folder / f"part.{suffix}", context.folder / "report.json"
    limit = ("--max-size", f"{megabytes}") if most is None else ("--max-triangles", f"{most}")
    done = run(
        volfrep("fill", str(path), "-o", str(out), *lattice.split(), *limit,
                "--report", str(report), "--quiet")
    )  # fmt: skip
    row |= {"seconds": done.seconds, "cpu": done.cpu}
    if done.failure:
        return context.say({**row, "note": done.failure, "failed": True})
    row["triangles"] = json.loads(report.read_text(encoding="utf-8"))["triangles"]
    row["mb"] = out.stat().st_size / 1e6
    row["used"] = row["mb"] / megabytes if most is None else row["triangles"] / most
    out.unlink()
    return context.say(row)


def render(result: dict[str, Any], images: Path) -> str:
    """What files use of their limits."""
    rows = result["rows"]
    used = sorted(row["used"] for row in rows if "used" in row)
    missed = [f"{row['part']}, {row['lattice']}: {row['note']}" for row in rows if "note" in row]
    shares = f"use {used[0]:.0%} to {used[-1]:.0%} of them" if used else "were made"
    return f"""## Files within limits

{len(used)} of {len(rows)} files, of triangles or MB (`bench/experiments/limits.py`), {shares}, in {sum(row.get("cpu", 0.0) for row in rows):,.0f} s of a processor. {"; ".join(missed)}
"""
