# SPDX-License-Identifier: LGPL-2.1-or-later
"""docs/images/simjeb.png anew: designs of the GE bracket among SimJEB's, by mass.

    .venv/bin/python tools/simjeb_picture.py all_bracket_metadata.csv ours.json [another.json ...]

The table is of https://github.com/simjeb/simjeb.github.io (data/all_bracket_metadata.csv), and is
no part of this project; our designs are reports of `volfrep size` for the challenge's four cases.
Needs matplotlib. Masses are at SimJEB's density.
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import numpy as np

FILE = Path(__file__).parents[1] / "docs" / "images" / "simjeb.png"
CASES = ("ver", "hor", "dia", "tor")
LIMIT, DENSITY, MOST = 903.0, 4.47, 1200.0
GREY, HELD, OURS = "#b8bcc2", "#0b5cad", "#d95f02"


def main() -> None:
    """Draws what the arguments name."""
    table, *reports = sys.argv[1:]
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    mass = np.array([1000.0 * float(row["mass"]) for row in rows])
    stress, moved = (
        np.array([max(float(row[f"max_{case}_{kind}"]) for case in CASES) for row in rows])
        for kind in ("stress", "magdisp")
    )
    held = stress <= LIMIT
    ours = [_design(Path(report)) for report in reports]

    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, both = plt.subplots(1, 2, figsize=(8.4, 3.4), layout="constrained")
    for axes, values, name, row, ticks in (
        (both[0], stress, "largest stress, MPa", 1, (300, 500, 903, 2000, 4000)),
        (both[1], moved, "largest displacement, mm", 2, (0.3, 0.5, 1, 2, 5)),
    ):
        for some, colour, label in (
            (~held, GREY, "SimJEB, beyond 903 MPa"), (held, HELD, "SimJEB, up to 903 MPa"),
        ):  # fmt: skip
            axes.scatter(mass[some], values[some], s=9, color=colour, label=label, lw=0)
        axes.scatter(
            [one[0] for one in ours], [one[row] for one in ours], s=60, marker="*", color=OURS,
            label="skin and struts sized", zorder=3,
        )  # fmt: skip
        axes.set_yscale("log")
        axes.minorticks_off()
        axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.set_xlim(150.0, MOST)
        axes.set_ylim(*np.percentile(values, (0.0, 97.0)) * (0.9, 1.1))
        axes.set_xlabel("mass, g")
        axes.set_ylabel(name)
        axes.grid(True, alpha=0.25)
    both[0].axhline(LIMIT, color="#666666", lw=0.8, ls="--")
    both[0].legend(fontsize=7, loc="upper right")
    figure.savefig(FILE, dpi=110, metadata={"Software": None})


def _design(report: Path) -> tuple[float, float, float]:
    """Mass in g, largest stress in MPa (CalculiX's, where it is larger) and displacement in mm."""
    told = json.loads(report.read_text(encoding="utf-8"))["sizing"]
    made = told["masses_g"]["struts"] + told["masses_g"]["skin"]
    proved = told["calculix"]["uses"]
    used = max(told["uses"][name] for name in ("stress", "skin stress"))
    used = max(used, *(proved[name] for name in ("stress", "skin stress")))
    moved = max(case["displacement_mm"] for case in told["cases"])
    mass = made * DENSITY / told["material"]["density"]
    return mass, used * told["limits"]["stress"], moved


if __name__ == "__main__":
    main()
