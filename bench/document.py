# SPDX-License-Identifier: LGPL-2.1-or-later
"""The results of all experiments as one Markdown document."""

from __future__ import annotations

import traceback
from pathlib import Path
from types import ModuleType
from typing import Any

from .tables import bars_told

INTRODUCTION = """# Benchmarks

The evaluation of the paper that the method comes from (A. Bacciaglia, A. Liverani, A. Ceruti: Voxelization and one-dimensional lattice structures for industrial components using function representation), repeated by `make bench` beside the printed figures and other tools. `make bench-quick` does a small part in a few minutes, into `build/bench-quick`.

**Only ratios within one run mean something**: the paper's seconds are from an Intel i9-14900F with 96 GB and MATLAB 2024b. Every job is a process, timed from its start to its file on disk (binary STL, 50 bytes a triangle); memory is its peak. Files are judged as a reader sees them: in float32, corners merged by equality. The GE bracket is a public tessellation of the paper's part, the piston rod a stand-in in the same box. Figures that the paper only plots are left out.
"""

STAND_INS = (
    "**Stand-ins.** Without the real parts (VOLFREP_PARTS names their folder) this run took parts "
    "that the project models itself (`bench/parts.py`) for: {}. Rows that name the GE bracket or "
    "the piston rod are of those, in the same boxes: other parts, so that no figure compares with "
    "the paper's or with another run's on the real ones."
)
BARS = (
    "Bars in seconds are meant for two idle cores (see the load above). Those that were missed or "
    "not measured:"
)


def document(
    results: dict[str, dict[str, Any]], experiments: dict[str, ModuleType], images: Path
) -> tuple[str, list[str]]:
    """The text, and the names of the experiments that could not be shown.

    Args:
        results: by experiment, each with "machine" (at its start), "seconds" and its result, or
            with "error".
        experiments: in the order of the document.
        images: folder of the plots.
    """
    chapters, broken, bars = [], [], []
    for name, module in experiments.items():
        result = results.get(name)
        if result is None:
            chapters.append(f"## {name}\n\nNot measured in this run.")
            continue
        if "error" in result:
            chapters.append(f"## {name}\n\nThis experiment failed: {result['error']}")
            continue
        try:
            chapters += filter(None, [module.render(result, images).strip()])
        except Exception as error:  # the other chapters are still worth having
            traceback.print_exc()
            broken.append(name)
            chapters.append(f"## {name}\n\nThis chapter could not be written: {error!r}")
        bars += result["bars"]
    missed = sum(row["met"] is False for row in bars)
    unknown = sum(row["met"] is None for row in bars)
    count = f"{sum(row['met'] is True for row in bars)} of {len(bars)} met, {missed} missed"
    count += f", {unknown} not measured" if unknown else ""
    modelled = {name for r in results.values() for name in r["machine"].get("stand_ins", ())}
    about = [STAND_INS.format(", ".join(sorted(modelled)))] if modelled else []
    parts = [INTRODUCTION.strip(), *about, _machines(results), f"## Bars: {count}"]
    if missed or unknown:
        parts += [BARS, bars_told([row for row in bars if row["met"] is not True])]
    return "\n\n".join([*parts, *chapters]) + "\n", broken


def _machines(results: dict[str, dict[str, Any]]) -> str:
    found = {name: result["machine"] for name, result in results.items()}
    if not found:
        return "Nothing has been measured."
    last = max(found.values(), key=lambda machine: machine["date"])
    packages = ", ".join(f"{name} {number}" for name, number in last["packages"].items())
    lines = [
        f"- Machine: {last['processor']}, {last['cores']} cores, {last['memory_gb']} GB; "
        f"{last['system']}; Python {last['python']}.",
        f"- This engine: commit {last['commit']}; {packages}.",
    ]
    if last["peer_packages"]:
        others = ", ".join(f"{name} {number}" for name, number in last["peer_packages"].items())
        lines.append(f"- Other tools: {others}.")
    dates = [machine["date"] for machine in found.values()]
    loads = [machine["load"] for machine in found.values()]
    lines.append(
        f"- Measured from {min(dates)} to {max(dates)}; load just before each experiment "
        f"{min(loads):g} to {max(loads):g} (of {last['cores']} cores)."
    )
    commits = {machine["commit"] for machine in found.values()}
    if len(commits) > 1:
        lines.append(f"- Measured at different states of the code: {', '.join(sorted(commits))}.")
    return "\n".join(lines)
