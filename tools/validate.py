# SPDX-License-Identifier: LGPL-2.1-or-later
"""`make validate`: predictions beside printed specimens, homogenised parts beside beams.

All figures of docs/validation.md, and of a table of docs/method.md.

    .venv/bin/python tools/validate.py [--page]

With --page only the page is made again, of the predictions that were kept.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "core"), str(ROOT / "tools")]

from validation import homogenised, page  # noqa: E402
from validation.predictions import benchmarks, growth, predict, specimens  # noqa: E402

KEPT = ROOT / "tools" / "validation" / "predictions.json"


def _kept(values: dict[str, float]) -> dict[str, float]:
    """To four digits, without what a specimen does not have."""
    return {name: float(f"{value:.4g}") for name, value in values.items() if value == value}


def computed() -> dict[str, Any]:
    """All predictions, computed anew."""
    rows, series = specimens()
    found: dict[str, Any] = {}
    for row in rows:
        own = {"nominal": _kept(predict(row, row.get("diameter")))}
        if "measured_diameter" in row:
            own["measured"] = _kept(predict(row, row["measured_diameter"]))
        found[row["name"]] = own
        print(row["name"], own, flush=True)
    return {
        "specimens": found,
        "growth": {
            row["name"]: float(f"{growth(row['cell'], row['densities']):.4g}") for row in series
        },
        "benchmarks": [asdict(row) for row in benchmarks()],
        "homogenised": {cell: homogenised.of_cell(cell) for cell in homogenised.CELLS},
        "gyroid": homogenised.of_gyroid(),
    }


def made_pages(found: dict[str, Any]) -> dict[Path, str]:
    """The pages, of the specimens and of the predictions that were kept."""
    blocks = {
        page.PAGE: page.blocks(*specimens(), found),
        page.METHOD: {"homogenised": page.homogenised_table(found)},
    }
    return {
        path: page.refreshed(path.read_text(encoding="utf-8"), own) for path, own in blocks.items()
    }


def kept() -> dict[str, Any]:
    """The predictions of the last run."""
    return dict(json.loads(KEPT.read_text(encoding="utf-8")))


def main() -> None:
    """Compute, keep, write."""
    if "--page" not in sys.argv:
        KEPT.write_text(json.dumps(computed(), indent=1) + "\n", encoding="utf-8")
    found = kept()
    for path, text in made_pages(found).items():
        path.write_text(text, encoding="utf-8")
    page.plot(specimens()[0], found["specimens"])


if __name__ == "__main__":
    main()
