# SPDX-License-Identifier: LGPL-2.1-or-later
"""The README's table of figures, from the results of the experiments that it tells of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .published import BLOCK, BRACKET, CELLS_IN_AN_HOUR, ROD
from .tables import Row

CELLS = ("Box", "FCC", "CVC")
#: Whose results the table needs.
NEEDED = ("blocks", "bracket", "rod", "scale")
BEGIN, END = "<!-- from here `make bench` writes -->", "<!-- to here -->"


def figures_table(results: dict[str, dict[str, Any]]) -> str:
    """The table as Markdown; what was not measured is left empty.

    Args:
        results: by experiment, as `bench.measuring` leaves them.
    """
    blocks = _by_cell(results, "blocks", kind="ours")
    bracket, rod = _by_cell(results, "bracket"), _by_cell(results, "rod", job="piston rod")
    hour = _scale(results)
    lines = [
        ("job", *CELLS),
        ("---",) * 4,
        ("10 x 10 x 10 cells, L = 10, r = 1", *_seconds(blocks, "seconds", BLOCK)),
        ("their volume, against the exact one", *(
            f"{100 * row['volume_error']:+.2f} %" if "volume_error" in row else ""
            for row in (blocks.get(cell, {}) for cell in CELLS)
        )),
        ("GE bracket, skin 3 mm, skin and lattice in one body",
         *_seconds(bracket, "seconds", BRACKET)),
        ("the same when only r changes", *_seconds(bracket, "change")),
        ("piston rod, skin 1 mm, L = 2, cells graded along it", *_seconds(rod, "seconds", ROD)),
    ]  # fmt: skip
    if hour:
        edge = round(CELLS_IN_AN_HOUR ** (1 / 3))
        lines.append((
            f"{edge} x {edge} x {edge} cells, {hour['triangles'] / 1e6:.0f} million triangles, "
            f"{hour['peak_mb'] / 1e3:.1f} GB of memory", "", "", f"{hour['seconds']:.1f} s (1 h)",
        ))  # fmt: skip
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _by_cell(results: dict[str, dict[str, Any]], name: str, **those: str) -> dict[str, Row]:
    rows = results.get(name, {}).get("rows", [])
    return {row["cell"]: row for row in rows if those.items() <= row.items()}


def _scale(results: dict[str, dict[str, Any]]) -> Row | None:
    rows = results.get("scale", {}).get("rows", [])
    wanted = {"setting": "default, L / 15", "cells": CELLS_IN_AN_HOUR}
    return next((row for row in rows if wanted.items() <= row.items() and "seconds" in row), None)


def _seconds(
    rows: dict[str, Row], key: str, published: dict[str, tuple[float, float]] | None = None
) -> list[str]:
    """A row's figures by cell, the published ones in brackets."""
    return [
        "" if rows.get(cell, {}).get(key) is None
        else f"{rows[cell][key]:.1f} s" + (f" ({published[cell][0]:.0f} s)" if published else "")
        for cell in CELLS
    ]  # fmt: skip


def write_into(readme: Path, table: str) -> None:
    """Put the table between its two marks.

    Raises:
        ValueError: the file has no such marks.
    """
    text = readme.read_text(encoding="utf-8")
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"{readme} has no {BEGIN} with {END} after it")
    readme.write_text(f"{before}{BEGIN}\n{table}\n{END}{after}", encoding="utf-8")
