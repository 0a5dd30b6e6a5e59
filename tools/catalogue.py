# SPDX-License-Identifier: LGPL-2.1-or-later
"""`make catalogue`: the cells' properties, with the charts and tables of docs/cells.md.

    python tools/catalogue.py [--charts] [--fit] [CELL...]

Cells of the library that are not in the catalogue are computed, or those that are named; with --fit
only the ends of struts are fitted anew; with --charts what is shipped stays. Pictures and tables
are always made again. matplotlib comes with FreeCAD.
"""

from __future__ import annotations

import sys
from pathlib import Path

import catalogue_cells
import matplotlib

matplotlib.use("Agg")
import numpy as np
from lines_to_compare import gibson_ashby, hashin_shtrikman
from matplotlib import pyplot as plt
from matplotlib.colors import Normalize

from volfrep.design.cells import LIBRARY, PAPERS, USES, UnitCell
from volfrep.mechanics import catalogue as shipped
from volfrep.mechanics.endless import stretched_strains
from volfrep.mechanics.materials import MATERIALS
from volfrep.mechanics.tensor import moduli, young

ROOT = Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"
PAGE = ROOT / "docs" / "cells.md"
COLOURS = ("#0b5cad", "#d95f02", "#1b9e77", "#7570b3", "#e7298a", "#a6761d")
#: Cells that are not alike along x, y and z, and two that are.
UNEVEN = ("BCCz", "FCCz", "Pyramid", "Re-entrant", "Kagome", "Diamond")
#: Relative density of the table, and that of the surfaces.
OF_TABLE = 0.1
OF_SURFACES = 0.1


def charts() -> None:
    """E, G and strength over relative density, beside the usual lines."""
    figure, axes = plt.subplots(1, 3, figsize=(15, 5.6), layout="constrained")
    density = np.geomspace(0.01, 0.75, 100)
    bounds, foam = hashin_shtrikman(density), gibson_ashby(density)
    titles = ("E along an edge [100] / E of the solid", "G / E of the solid",
              "strength along an edge / yield stress of the solid")  # fmt: skip
    for name, colour in zip(PAPERS, COLOURS, strict=True):
        cell = shipped.catalogue()[name]
        found = [cell.at(ratio) for ratio in np.geomspace(cell.ratios[0], cell.ratios[-1], 60)]
        tensors = [
            cell.tensor(ratio) for ratio in np.geomspace(cell.ratios[0], cell.ratios[-1], 60)
        ]
        across = [values["relative_density"] for values in found]
        figures = [moduli(tensor) for tensor in tensors]
        columns = (
            [f.E100 for f in figures],
            [f.G for f in figures],
            [v["strength"] for v in found],
        )
        known = [moduli(cell.tensor(ratio)) for ratio in cell.ratios]
        dots = ([f.E100 for f in known], [f.G for f in known], cell.values[:, 4])
        for plot, column, dot in zip(axes, columns, dots, strict=True):
            plot.loglog(across, column, "-", color=colour, label=name, linewidth=1.8)
            plot.loglog(cell.values[:, 0], dot, "o", color=colour, markersize=3.5)
    for plot, line in zip(axes[:2], bounds, strict=True):
        plot.loglog(density, line, "k-", linewidth=1, label="Hashin-Shtrikman, upper bound")
    for plot, line in zip(axes, foam, strict=True):
        plot.loglog(density, line, "k--", linewidth=1, label="Gibson-Ashby, open foam")
    for plot, title in zip(axes, titles, strict=True):
        plot.set_title(title, fontsize=11)
        plot.set_xlabel("relative density")
        plot.grid(which="both", linewidth=0.3)
        plot.set_ylim(bottom=2e-5)
    axes[0].legend(fontsize=8.5, loc="lower right")
    figure.savefig(IMAGES / "cells_stiffness.png", dpi=90)
    plt.close(figure)


def uses() -> None:
    """E along z over relative density of the whole library, a plot for each use."""
    known = shipped.catalogue()
    figure, axes = plt.subplots(2, 3, figsize=(15, 9.4), layout="constrained")
    density = np.geomspace(0.01, 0.75, 100)
    bound, foam = hashin_shtrikman(density)[0], gibson_ashby(density)[0]
    plots = axes.ravel()
    plots[-1].axis("off")
    for plot, (use, text) in zip(plots, USES.items(), strict=False):
        cells = [known[name] for name, cell in LIBRARY.items() if cell.use == use and name in known]
        for cell, colour in zip(cells, plt.cm.tab10.colors * 2, strict=False):
            ratios = np.geomspace(cell.ratios[0], cell.ratios[-1], 40)
            along = [young(cell.tensor(ratio), np.eye(3)[2]) for ratio in ratios]
            across = [cell.at(ratio)["relative_density"] for ratio in ratios]
            plot.loglog(across, along, "-", color=colour, label=cell.name, linewidth=1.8)
        plot.loglog(density, bound, "k-", linewidth=1, label="Hashin-Shtrikman")
        plot.loglog(density, foam, "k--", linewidth=1, label="Gibson-Ashby")
        plot.set_title(text, fontsize=12)
        plot.set_xlabel("relative density")
        plot.set_ylabel("E along z [001] / E of the solid")
        plot.set_ylim(1e-4, 0.7)
        plot.grid(which="both", linewidth=0.3)
        plot.legend(fontsize=8, loc="lower right")
    figure.savefig(IMAGES / "cells_uses.png", dpi=80)
    plt.close(figure)


def surfaces(names: tuple[str, ...], picture: str) -> None:
    """E in every direction, a body for each of six cells, at one relative density."""
    polar, around = np.meshgrid(np.linspace(0, np.pi, 91), np.linspace(0, 2 * np.pi, 181))
    ways = np.stack(
        [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], axis=-1
    )
    figure = plt.figure(figsize=(13, 8.6), layout="constrained")
    for place, name in enumerate(names, 1):
        cell = shipped.catalogue()[name]
        tensor = cell.tensor(cell.ratio_of_density(OF_SURFACES))
        along = young(tensor, ways)
        plot = figure.add_subplot(2, 3, place, projection="3d")
        x, y, z = np.moveaxis(ways * (along / along.max())[..., None], -1, 0)
        colours = plt.cm.viridis(Normalize(0, along.max())(along))
        plot.plot_surface(x, y, z, facecolors=colours, rcount=91, ccount=181, linewidth=0,
                          antialiased=False, shade=True)  # fmt: skip
        found = moduli(tensor)
        zener = "" if len(cell.tensors) else f", Zener {found.zener:.2g}"
        plot.set_title(f"{name}: {along.min():.2g} to {along.max():.2g}{zener}", fontsize=12)
        plot.set_box_aspect((1, 1, 1))
        plot.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1), xticks=[], yticks=[], zticks=[])
        plot.set_xlabel("[100]", labelpad=-10)
        plot.set_ylabel("[010]", labelpad=-10)
        plot.set_zlabel("[001]", labelpad=-10)
    figure.savefig(IMAGES / picture, dpi=80)
    plt.close(figure)


def cells_table() -> str:
    """The library, sorted by what its cells are for, as Markdown."""
    lines = []
    for use, text in USES.items():
        cells = [cell for cell in LIBRARY.values() if cell.use == use]
        ways = {"stretching" if stretched_strains(cell) == 6 else "bending" for cell in cells}
        way = ways.pop() if len(ways) == 1 else ""
        lines.append(f"**{text[0].upper()}{text[1:]}**{f' (by {way})' if way else ''}\n")
        lines += [f"- {cell.name} ({len(cell.struts)}): {_about(cell)}" for cell in cells]
        lines.append("")
    return "\n".join(lines[:-1])


def _about(cell: UnitCell) -> str:
    """What a cell is, and what others call it."""
    return f"{cell.about}; also {', '.join(cell.also)}" if cell.also else cell.about


def properties_table() -> str:
    """The cells at one relative density, as Markdown."""
    lines = ["| cell | E [100] | E [111] | G | strength |", "|---|---|---|---|---|"]
    for name, cell in shipped.catalogue().items():
        if not cell.values[0, 0] <= OF_TABLE <= cell.values[-1, 0]:
            continue
        ratio = cell.ratio_of_density(OF_TABLE)
        tensor, values = cell.tensor(ratio), cell.at(ratio)
        found, upright = moduli(tensor), young(tensor, np.eye(3)[2])
        edge, diagonal, shear = (
            f"{e:.3g}" if e > 1e-6 * upright else "0" for e in (found.E100, found.E111, found.G)
        )
        if abs(upright - found.E100) > 1e-3 * upright:
            edge += f", z {upright:.3g}"
        strength = f"{values['strength']:.3g}" if values["strength"] > 1e-12 else "0"
        lines.append(f"| {name} | {edge} | {diagonal} | {shear} | {strength} |")
    return "\n".join(lines)


def materials_table() -> str:
    """The materials, as Markdown."""
    lines = [
        "| material | density, g/cm3 | E, MPa | Poisson's ratio | yield, MPa | processes | from |",
        "|---|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {m.name} | {m.density:g} | {m.young:,.0f} | {m.poisson:g} | "
        f"{f'{m.yield_stress:g}' if m.yield_stress else '-'} | "
        f"{', '.join(m.processes)} | {m.source} |"
        for m in MATERIALS.values()
    ]
    return "\n".join(lines)


def write_tables() -> None:
    """Put the tables between their marks in docs/cells.md."""
    text = PAGE.read_text(encoding="utf-8")
    tables = {
        "cells": cells_table(),
        "properties": properties_table(),
        "materials": materials_table(),
    }
    for mark, table in tables.items():
        before, _, rest = text.partition(f"<!-- {mark}: made by make catalogue -->\n")
        after = rest.partition(f"<!-- end of {mark} -->")[2]
        marked = f"<!-- {mark}: made by make catalogue -->\n{table}\n<!-- end of {mark} -->"
        text = before + marked + after
    PAGE.write_text(text, encoding="utf-8")


def main() -> None:
    """Compute, draw, write."""
    arguments = sys.argv[1:]
    if "--charts" not in arguments:
        catalogue_cells.main(arguments)
        shipped.catalogue.cache_clear()
    charts()
    uses()
    surfaces(PAPERS, "cells_directions.png")
    surfaces(UNEVEN, "cells_directions_uneven.png")
    write_tables()


if __name__ == "__main__":
    main()
