# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plots as small PNG files; matplotlib is imported only where one is made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

#: Where the plots lie beside the document.
FOLDER = "images/benchmarks"
COLOURS = ("#0b5cad", "#d95f02", "#1b9e77", "#7570b3", "#a6761d", "#666666", "#e7298a", "#66a61e")


@dataclass(frozen=True)
class Line:
    """A line of a plot: its name, its points, and how it is drawn (a matplotlib format).

    What comes from the paper (so says the name) is black.
    """

    name: str
    x: Sequence[float]
    y: Sequence[float]
    style: str = "o-"


def lines(
    path: Path, across: str, up: str, data: Sequence[Line], *, log: bool = True, title: str = ""
) -> str:
    """A plot of lines, on logarithmic axes or plain ones; its Markdown."""
    figure, axes = _figure()
    for line, colour in zip(data, _colours(len(data)), strict=True):
        axes.plot(
            line.x, line.y, line.style, label=line.name, markersize=4, lw=1.3,
            color="black" if line.name.startswith("paper") else colour,
        )  # fmt: skip
    if log:
        axes.set_xscale("log")
        axes.set_yscale("log")
        ticks = sorted({x for line in data for x in line.x})
        axes.set_xticks(ticks, [f"{x:,.0f}" for x in ticks], fontsize=7, rotation=40)
        axes.minorticks_off()
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    axes.grid(True, which="major", alpha=0.3)
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    return _save(figure, path, title)


def stacks(
    path: Path,
    up: str,
    names: Sequence[str],
    stages: Sequence[dict[str, float]],
    title: str = "",
) -> str:
    """A bar for each name, of its stages on top of each other; its Markdown."""
    figure, axes = _figure()
    order = list(dict.fromkeys(stage for one in stages for stage in one))
    below = [0.0] * len(names)
    for stage, colour in zip(order, _colours(len(order)), strict=True):
        heights = [one.get(stage, 0.0) for one in stages]
        axes.bar(names, heights, bottom=below, label=stage, color=colour, width=0.7)
        below = [a + b for a, b in zip(below, heights, strict=True)]
    axes.set_ylabel(up)
    axes.tick_params(axis="x", labelsize=7)
    axes.grid(True, axis="y", alpha=0.3)
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    return _save(figure, path, title)


def _figure():
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    return pyplot.subplots(figsize=(7.2, 3.6), dpi=100)


def _colours(count: int) -> list[str]:
    return [COLOURS[k % len(COLOURS)] for k in range(count)]


def _save(figure, path: Path, title: str) -> str:
    from matplotlib import pyplot

    path.parent.mkdir(parents=True, exist_ok=True)
    figure.tight_layout()
    # Without the date and the version, so that equal figures make equal files.
    figure.savefig(path, metadata={"Software": None})
    pyplot.close(figure)
    return f"![{title}]({FOLDER}/{path.name})"
