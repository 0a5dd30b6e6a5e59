# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of studies as the tests compare them."""

from __future__ import annotations

import csv
from pathlib import Path


def timeless(folder: Path) -> list[dict[str, str]]:
    """The table without its times."""
    with (folder / "runs.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return [{k: v for k, v in row.items() if not k.startswith("seconds.")} for row in rows]
