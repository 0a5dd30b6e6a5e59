# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables, means and the plot of docs/validation.md, and a table of docs/method.md."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import Any

import numpy as np

from volfrep.mechanics.materials import find_material

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "validation.md"
METHOD = ROOT / "docs" / "method.md"
PLOT = ROOT / "docs" / "images" / "validation.png"
FIGURES = ("young", "strength", "plateau", "energy")
NAMES = {
    "young": "E, MPa",
    "strength": "strength, MPa",
    "plateau": "plateau, MPa",
    "energy": "energy to 50 %, J/g",
}


def refreshed(text: str, blocks: dict[str, str]) -> str:
    """The page with each block between its two comments anew.

    Raises:
        ValueError: a block has no place.
    """
    for name, block in blocks.items():
        place = re.compile(rf"(<!-- {name}: made by make validate -->\n).*?(<!-- end -->)", re.S)
        text, count = place.subn(lambda found, b=block: found[1] + b + found[2], text)
        if count != 1:
            raise ValueError(f"The page has {count} places for '{name}'.")
    return text


def blocks(
    specimens: list[dict[str, Any]],
    series: list[dict[str, Any]],
    found: dict[str, Any],
) -> dict[str, str]:
    """All that is made of the specimens and of what was predicted."""
    return {
        "specimens": specimen_table(specimens, found["specimens"]),
        "notes": notes(specimens),
        "errors": error_table(specimens, found["specimens"]),
        "reasons": reasons(specimens, found["specimens"]),
        "order": order_table(specimens, series, found),
        "benchmarks": benchmark_table(found["benchmarks"]),
    }


def _short(value: float) -> str:
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def best(own: dict[str, Any]) -> dict[str, float]:
    """With measured sizes, where there are some."""
    result: dict[str, float] = own.get("measured") or own["nominal"]
    return result


def specimen_table(specimens: list[dict[str, Any]], found: dict[str, Any]) -> str:
    """A line for each specimen, those of one source together: measured figures and predictions."""
    lines = [f"| specimen | {' | '.join(NAMES.values())} |\n|---|---|---|---|---|\n"]
    head = ""
    for row in specimens:
        if head != (head := f"{row['process']}, {row['material']}; {_source(row)}"):
            lines.append(f"| **{head}** | | | | |\n")
        told = " | ".join(_told(row, figure, found[row["name"]]) for figure in FIGURES)
        lines.append(f"| {row['name']}{_size(row)} | {told} |\n")
    return "".join(lines)


def _told(row: dict[str, Any], figure: str, own: dict[str, Any]) -> str:
    """A figure that was measured, and its predictions with their errors."""
    if figure not in row:
        return ""
    of_sizes = ", ".join(
        f"{_short(values[figure])} ({values[figure] / row[figure] - 1:+.0%})"
        for values in own.values()
    )
    word = row.get("strength_is", "strength") if figure == "strength" else ""
    return f"{word} " * (word not in ("", "strength")) + f"{_short(row[figure])}: {of_sizes}"


def _size(row: dict[str, Any]) -> str:
    """What a specimen's name does not say of its size."""
    if "density" in row:
        stated = f"{100 * row['density']:g} %"
        kind = f" {row['kind']}" if row.get("kind", "") not in row["name"] else ""
        return f",{kind} {stated}" if stated not in row["name"] else kind
    size = f"L {row['cell_size']:g}, " if "cell_size" in row else ""
    text = f", {size}d {row['diameter']:g}"
    if "measured_diameter" in row:
        text += f", measured {row['measured_diameter']:g}"
    return f"{text} mm; {row['cells']}"


def _source(row: dict[str, Any]) -> str:
    source = row["source"]
    link = f"[{source}](https://doi.org/{row['doi']})" if "doi" in row else source
    return f"{link}, {row['read']}"


def notes(specimens: list[dict[str, Any]]) -> str:
    """What is to be known of a specimen beside its figures."""
    return "".join(f"- {row['name']}: {row['note']}.\n" for row in specimens if "note" in row)


def ratios(specimens: list[dict[str, Any]], found: dict[str, Any], figure: str) -> Any:
    """(n,) predicted over measured."""
    return np.array(
        [best(found[row["name"]])[figure] / row[figure] for row in specimens if figure in row]
    )


def error_table(specimens: list[dict[str, Any]], found: dict[str, Any]) -> str:
    """Mean and extremes by figure, of what was read in its source and of what others quote."""
    lines = [
        "| figure | specimens | mean error | mean size of it | from, to | "
        "measured over predicted, least |\n|---|---|---|---|---|---|\n"
    ]
    for figure, read in itertools.product(FIGURES, ("text", "quoted")):
        rows = [row for row in specimens if row["read"] == read and figure in row]
        sound = [row for row in rows if not row.get("suspect")]
        for name, own in ((f"{figure}, {read}", rows), ("without the suspect row", sound)):
            if not own or (own is sound and len(sound) == len(rows)):
                continue
            error = ratios(own, found, figure) - 1.0
            lines.append(
                f"| {name} | {len(error)} | {error.mean():+.0%} | {np.abs(error).mean():.0%} "
                f"| {error.min():+.0%}, {error.max():+.0%} | {1 / (1 + error.max()):.2f} |\n"
            )
    return "".join(lines)


def reasons(specimens: list[dict[str, Any]], found: dict[str, Any]) -> str:
    """What is left of errors by what may explain them: fitted to the tests, and not used."""
    lines = []
    for row in specimens:
        if "plateau" in row:
            own = best(found[row["name"]])["unhardened"]
            lines.append(
                f"- Plateau of {row['name']} if the material did not harden: {own:.2f} "
                f"({own / row['plateau'] - 1:+.0%}).\n"
            )
    for name in dict.fromkeys(row["series"] for row in specimens):
        rows = [row for row in specimens if row["series"] == name and "young" in row]
        if len(rows) < 3:
            continue
        measured = np.array([row["young"] for row in rows])
        ours = np.array([best(found[row["name"]])["young"] for row in rows])
        soft = float((1.0 / measured - 1.0 / ours).mean())
        left = 1.0 / (1.0 / ours + soft) / measured - 1.0
        lines.append(
            f"- E of {name} with one compliance in series, {1000 * soft:.2f}/GPa, as a machine "
            f"has: {left.min():+.0%} to {left.max():+.0%}.\n"
        )
    for row in specimens:
        if "energy" in row:
            solid = find_material(row["material"])
            assert solid.yield_stress is not None
            most = solid.yield_stress * np.log(2.0) / solid.density
            own = best(found[row["name"]])["energy"]
            lines.append(
                f"- Energy of {row['name']} over that of solid metal halved at its yield, "
                f"{most:.3g} J/g: measured {row['energy'] / most:.0%}, ours {own / most:.0%}.\n"
            )
    return "".join(lines)


def order_table(
    specimens: list[dict[str, Any]], series: list[dict[str, Any]], found: dict[str, Any]
) -> str:
    """Pairs of one series in the right order, and ratios of its largest to its smallest."""
    lines = ["Pairs in the right order; the largest over the smallest, measured and predicted:\n\n"]
    names = dict.fromkeys(row["series"] for row in specimens)
    for name, figure in itertools.product(names, FIGURES):
        rows = [row for row in specimens if row["series"] == name and figure in row]
        if len(rows) < 2:
            continue
        measured = np.array([row[figure] for row in rows])
        ours = np.array([best(found["specimens"][row["name"]])[figure] for row in rows])
        pairs = list(itertools.combinations(range(len(rows)), 2))
        right = sum((measured[a] - measured[b]) * (ours[a] - ours[b]) > 0 for a, b in pairs)
        top, low = int(measured.argmax()), int(measured.argmin())
        lines.append(
            f"- {name}, {figure}: {right} of {len(pairs)}; {measured[top] / measured[low]:.2f}, "
            f"{ours[top] / ours[low]:.2f}\n"
        )
    for row in series:
        low, high = row["densities"]
        lines.append(
            f"- {row['name']}, soft polymer, {low:.1%} to {high:.1%} ({row['source']}), young: "
            f"1 of 1; {row['ratio']:.2f}, {found['growth'][row['name']]:.2f}\n"
        )
    return "".join(lines)


def benchmark_table(found: list[dict[str, Any]]) -> str:
    """What is known beside what was found."""
    lines = []
    source = ""
    for row in found:
        error = row["found"] / row["expected"] - 1.0
        known = f"{row['expected']:.4g}"
        if source != (source := row["source"]):
            known += f" ({source})"
        lines.append(f"- {row['name']}: {known}, found {row['found']:.4g} ({error:+.1%})\n")
    return "".join(lines)


def homogenised_table(found: dict[str, Any]) -> str:
    """Errors of homogenised parts, %, and how much too stiffly their beams shear."""
    rows = [
        (cell, *(row[name] for name in ("bent", "pulled", "sideways", "itself", "shear")))
        for cell, row in found["homogenised"].items()
    ]
    lines = [
        "| cell | skin, bent | pulled | sideways | with the beams' tensor | beams' shear |\n"
        "|---|---|---|---|---|---|\n"
    ]
    for cell, *errors in rows:
        lines.append(f"| {cell} | {' | '.join(f'{100 * error:+.1f}' for error in errors)} |\n")
    gyroid = found["gyroid"]
    told = (f"{100 * gyroid[way]:+.1f}, {100 * gyroid[f'{way}, limit']:+.1f}" for way in
            ("pulled", "sideways"))  # fmt: skip
    return "".join([*lines, f"| Gyroid | | {' | '.join(told)} | | |\n"])


def plot(specimens: list[dict[str, Any]], found: dict[str, Any]) -> None:
    """Predicted over measured, a mark for each specimen; matplotlib comes with FreeCAD."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained")
    names = list(dict.fromkeys(row["series"] for row in specimens))
    for plot_, what in zip(axes, FIGURES, strict=False):
        for colour, name in zip(plt.cm.tab10.colors, names, strict=False):
            rows = [row for row in specimens if row["series"] == name and what in row]
            if rows:
                ours = [best(found[row["name"]])[what] for row in rows]
                mark = "D" if rows[0]["read"] == "text" else "o"
                plot_.loglog([row[what] for row in rows], ours, mark, color=colour, label=name)
        ends = np.array(plot_.get_xlim())
        plot_.loglog(ends, ends, "k-", linewidth=1)
        plot_.loglog(ends, 1.25 * ends, "k:", linewidth=0.8)
        plot_.loglog(ends, 0.8 * ends, "k:", linewidth=0.8)
        plot_.set(xlabel=f"measured {NAMES[what]}", ylabel=f"predicted {NAMES[what]}")
        plot_.grid(which="both", linewidth=0.3)
        plot_.legend(fontsize=8)
    figure.savefig(PLOT, dpi=80)
    plt.close(figure)
