# SPDX-License-Identifier: LGPL-2.1-or-later
"""Section 2.4: how many cells of the wing's box hold a lattice."""

from __future__ import annotations

import importlib.util
import time
from pathlib import Path
from types import ModuleType
from typing import Any

from volfrep.grid.activation import active_cells, make_grid
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.progress import Monitor

from ..measuring import ROOT, Context
from ..published import WING_GRID, WING_SHARE

SIZE = 20.0


def measure(context: Context) -> dict[str, Any]:
    """The grid, and the active share by each rule."""
    wing = _samples().naca2412()
    start = time.perf_counter()
    grid = make_grid(wing.bounds, SIZE)
    rows = []
    for rule in ("touching", "centre", "inside"):
        begun = time.perf_counter()
        share = float(active_cells(grid, wing, rule, Monitor()).mean())
        seconds = time.perf_counter() - begun
        rows.append(context.say({"rule": rule, "share": share, "seconds": seconds}))
    bars = [
        {"text": "wing, grid of the paper", "bar": " x ".join(map(str, WING_GRID)),
         "measured": " x ".join(map(str, grid.shape)), "met": grid.shape == WING_GRID},
    ]  # fmt: skip
    volume = _share_of_box(wing)
    return {
        "rows": rows, "bars": bars, "grid": list(grid.shape), "volume_share": volume,
        "seconds": time.perf_counter() - start,
    }  # fmt: skip


def _samples() -> ModuleType:
    """The tests' parts, which are not a package."""
    path = ROOT / "tests" / "core" / "samples.py"
    spec = importlib.util.spec_from_file_location("samples_of_the_tests", path)
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot load {path}")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _share_of_box(wing: TriangleMesh) -> float:
    low, high = wing.bounds
    return float(wing.volume / (high - low).prod())


def render(result: dict[str, Any], images: Path) -> str:
    """What each rule gives."""
    grid = " x ".join(str(n) for n in result["grid"])
    shares = ", ".join(f"{row['rule']} {100 * row['share']:.1f} %" for row in result["rows"])
    return f"""## The wing (section 2.4, Fig. 5)

NACA 2412, chord and span of 1000 mm, modelled from its equations; L = 20. Grid {grid}, the paper's is {" x ".join(map(str, WING_GRID))}. Active cells by our rules: {shares}. The paper prints {100 * WING_SHARE:.1f} %, which agrees with cells that touch the wing, not with those whose centre is inside, the rule in its text.
"""
