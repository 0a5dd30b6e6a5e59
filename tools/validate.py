# SPDX-License-Identifier: LGPL-2.1-or-later
"""`make validate`: predictions beside printed specimens, and all figures of docs/validation.md.

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

from validation import page  # noqa: E402
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
    }


def made_page(text: str, found: dict[str, Any]) -> str:
    """The page, of the specimens and of the predictions that were kept."""
    return page.refreshed(text, page.blocks(*specimens(), found))


def kept() -> dict[str, Any]:
    """The predictions of the last run."""
    return dict(json.loads(KEPT.read_text(encoding="utf-8")))


def main() -> None:
    """Compute, keep, write."""
    if "--page" not in sys.argv:
        KEPT.write_text(json.dumps(computed(), indent=1) + "\n", encoding="utf-8")
    found = kept()
    text = page.PAGE.read_text(encoding="utf-8")
    page.PAGE.write_text(made_page(text, found), encoding="utf-8")
    page.plot(specimens()[0], found["specimens"])


if __name__ == "__main__":
    main()
