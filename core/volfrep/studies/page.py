# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a study: one HTML file that needs nothing beside it, no server and no network.

Its plots are drawn by matplotlib, an optional package.
"""

from __future__ import annotations

import base64
import html
import io
import os
import re
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..util.files import replacing
from ..util.packages import install_command
from ..util.types import Bools
from .designs import Design, Designs, command_of
from .study import Study
from .table import SECONDS, Table

#: Refused combinations and failed runs are listed up to so many sentences.
MOST_SENTENCES = 20
#: Pixels of an embedded picture.
THUMBNAIL = (480, 320)

#: Inches.
SIZE = (5.4, 3.9)
#: Colours that are told apart by most eyes (Okabe & Ito, Color Universal Design, 2008).
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#000000", "#b8a800")
#: What is drawn against the mass, where the table has it.
AGAINST_MASS = (
    "properties.E100", "properties.E111", "properties.G", "properties.strength",
    "solve.displacement_mm", "solve.stress_mpa",
    "print.findings", "print.overhang_area_mm2", f"{SECONDS}fill", "forecast.seconds",
)  # fmt: skip
MASSES = ("fill.mass_g", "forecast.mass_g")
MOST_PLOTS = 12

_STYLE = """
body{font:14px/1.45 system-ui,sans-serif;margin:1.5rem auto;max-width:1500px;padding:0 1rem;
color:#1d2433}
h1{font-size:1.5rem;margin:0}h2{font-size:1.15rem;margin:1.8rem 0 .5rem}
.muted{color:#667}.plots,.cards{display:flex;flex-wrap:wrap;gap:1rem}
figure{margin:0;border:1px solid #d5dae3;border-radius:6px;padding:.4rem;background:#fff}
.plots img{width:460px;max-width:100%}
.card{border:1px solid #d5dae3;border-radius:6px;padding:.6rem;width:440px;max-width:100%}
.card img{width:100%;border-radius:4px}.card h3{margin:.2rem 0;font-size:1rem}
.card table{width:100%}.card td{white-space:normal}
pre{white-space:pre-wrap;overflow-wrap:anywhere;background:#f3f5f9;
padding:.5rem;border-radius:4px;font-size:12px;margin:.4rem 0 0;user-select:all}
.scroll{overflow:auto;max-height:75vh;border:1px solid #d5dae3;border-radius:6px}
table{border-collapse:collapse}td,th{padding:.2rem .55rem;text-align:left;white-space:nowrap}
#runs th{position:sticky;top:0;background:#e9edf5;cursor:pointer;white-space:normal;
vertical-align:bottom}
#runs th.up::after{content:" \\25b2"}#runs th.down::after{content:" \\25bc"}
td.n{text-align:right;font-variant-numeric:tabular-nums}
tr:nth-child(even){background:#f8f9fc}tr.front{background:#dff0e6}tr.failed{color:#a33}
input{padding:.3rem .5rem;margin:0 0 .5rem;width:22rem;max-width:100%}
"""
_SCRIPT = """
const table=document.getElementById("runs"),body=table.tBodies[0];
const rows=[...body.rows];
const value=cell=>cell.dataset.v===undefined?cell.textContent:parseFloat(cell.dataset.v);
table.tHead.rows[0].querySelectorAll("th").forEach((head,column)=>head.onclick=()=>{
 const up=!head.classList.contains("up");
 table.tHead.rows[0].querySelectorAll("th").forEach(h=>h.classList.remove("up","down"));
 head.classList.add(up?"up":"down");
 rows.sort((a,b)=>{
  const x=value(a.cells[column]),y=value(b.cells[column]);
  if(x===""||y==="")return (x==="")-(y==="");
  const order=typeof x==="number"&&typeof y==="number"?x-y:
   String(x).localeCompare(String(y),"en",{numeric:true});
  return up?order:-order;});
 body.append(...rows);});
document.getElementById("find").oninput=event=>{
 const words=event.target.value.toLowerCase().split(/\\s+/);
 rows.forEach(row=>row.hidden=!words.every(w=>row.textContent.toLowerCase().includes(w)));};
"""


def write_page(
    path: Path, study: Study, found: Designs, table: Table, front: Mapping[str, int]
) -> None:
    """Write the page of a study.

    Args:
        path: of the file, in the study's folder.
        study: what was asked for.
        found: its designs.
        table: what is known of them.
        front: of those that are chosen, by their keys, the front that each lies on.

    Raises:
        VolfrepError: the file cannot be written.
    """
    designs = {design.key: design for design in found.designs}
    plots = plots_of(table, study, tuple(front))
    names = ", ".join(dict.fromkeys(d.part.name for d in found.designs))
    states = table.column("state")
    counts = ", ".join(f"{states.count(s):,} {s}" for s in dict.fromkeys(states))
    parts = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>{_text(names)}: {len(table.rows):,} designs</title><style>{_STYLE}</style></head>",
        f"<body><h1>{len(table.rows):,} designs of {_text(names)}</h1>",
        f'<p class="muted">{_text(counts)}; done with each: {_text(", ".join(study.do))}. '
        f"{_text(_units(study))}</p>",
        *_sentences("Combinations passed over", found.refused),
        *_drawings(plots),
        *_cards(path.parent, study, table, designs, front),
        *_rows(table),
        *_sentences("What failed", _failures(table)),
        f"<script>{_SCRIPT}</script></body></html>",
    ]
    with replacing(path) as file:
        file.write("\n".join(parts).encode())


def _units(study: Study) -> str:
    material = study.solid_material()
    if material is None:
        return "Stiffness and strength are in units of the solid's; lengths in mm."
    return f"The material is {material.name}: stiffness and strength in MPa; lengths in mm."


def _drawings(plots: list[Plot]) -> list[str]:
    if not plots:
        return [
            "<h2>Plots</h2><p>None: they take at least two figures, and the package matplotlib "
            f"({install_command('matplotlib')}).</p>"
        ]
    images = [
        f'<figure><img alt="{_text(plot.y)} against {_text(plot.x)}" '
        f'src="data:image/svg+xml;base64,{base64.b64encode(plot.svg).decode()}"></figure>'
        for plot in plots
    ]
    return ["<h2>Plots</h2>", '<div class="plots">', *images, "</div>"]


def _cards(
    folder: Path,
    study: Study,
    table: Table,
    designs: Mapping[str, Design],
    front: Mapping[str, int],
) -> list[str]:
    if study.front is None:
        return []
    goals = ", ".join(f"{way} {name}" for name, way in study.front.objectives.items())
    title = f"<h2>Pareto front: {_text(goals)}</h2>"
    if not front:
        return [title, "<p>It is named once every design has its figures.</p>"]
    rows = {row["key"]: row for row in table.dicts()}
    best = sum(rank == 1 for rank in front.values())
    said = f"{len(front):,} designs are chosen, {best:,} of them on the Pareto front."
    parts = [title, f"<p>{said}</p>", '<div class="cards">']
    for key in front:
        row, design = rows[key], designs[key]
        shown = [n for n in (*study.varied, *study.front.objectives, *_MORE) if n in row]
        lines = "".join(
            f"<tr><td>{_text(name)}</td>{_cell(row[name])}</tr>"
            for name in dict.fromkeys(shown)
            if row[name] is not None
        )
        commands = [command_of(design, study, _source(design), f"{key}{study.export}")]
        if row.get("size.file"):
            spec = str(folder / row["size.file"])
            sized = ["-o", f"{key}_sized{study.export}", "--spec", spec]
            commands.append(shlex.join(["volfrep", "fill", _source(design), *sized]))
        listing = "".join(f"<pre>{_text(command)}</pre>" for command in commands)
        parts.append(
            f'<div class="card" id="{key}">{_picture(folder, row)}<h3>{key}</h3>'
            f"<table>{lines}</table>{listing}</div>"
        )
    return [*parts, "</div>"]


#: What a card shows beside what varies and what is aimed at.
_MORE = (
    "fill.mass_g", "fill.triangles", "fill.watertight", "measure.printable", "print.findings",
    "print.said", "solve.displacement_mm", "solve.stress_mpa", "size.strut_mass_g", "size.stiffer",
    "size.mass_saved", "error",
)  # fmt: skip


def _source(design: Design) -> str:
    """The part's file; a word for a solid that came without one."""
    return os.path.abspath(design.part.source) if design.part.source else "PART"


def _picture(folder: Path, row: Mapping[str, Any]) -> str:
    name = row.get("picture.file")
    if not name or not (folder / name).is_file():
        return ""
    from PIL import Image  # came with what drew it

    small = io.BytesIO()
    with Image.open(folder / name) as image:
        image.convert("RGB").resize(THUMBNAIL).save(small, format="JPEG", quality=85)
    data = base64.b64encode(small.getvalue()).decode()
    return f'<img alt="the part, cut open" src="data:image/jpeg;base64,{data}">'


def _rows(table: Table) -> list[str]:
    # What is the same of all designs is said once, and not in a column that pushes others aside.
    same = {
        name: values[0]
        for name in table.columns
        for values in (table.column(name),)
        if len(values) > 1 and name != "key" and all(value == values[0] for value in values)
    }
    shown = [name for name in table.columns if name not in same]
    told = ", ".join(
        f"{name} {_shown(value)}" for name, value in same.items() if value not in (None, "")
    )
    # A column is as wide as the longest part of its name.
    names = (re.sub("([._])", r"\1<wbr>", _text(name)) for name in shown)
    heads = "".join(f"<th>{name}</th>" for name in names)
    state, front = table.columns.index("state"), table.columns.index("front")
    parts = [
        "<h2>All designs</h2>",
        f'<p class="muted">A click on a heading sorts. The same for all: {_text(told or "-")}.</p>',
        '<input id="find" placeholder="Show only rows with these words" aria-label="filter">',
        f'<div class="scroll"><table id="runs"><thead><tr>{heads}</tr></thead><tbody>',
    ]
    for row in table.rows:
        kind = "front" if row[front] else row[state]
        cells = "".join(
            _cell(value, time=name.startswith(SECONDS))
            for name, value in zip(table.columns, row, strict=True)
            if name not in same
        )
        parts.append(f'<tr class="{kind}">{cells}</tr>')
    return [*parts, "</tbody></table></div>"]


def _failures(table: Table) -> Mapping[str, int]:
    said = [sentence for sentence in table.column("error") if sentence]
    return {sentence: said.count(sentence) for sentence in dict.fromkeys(said)}


def _sentences(title: str, sentences: Mapping[str, int]) -> list[str]:
    if not sentences:
        return []
    most = sorted(sentences.items(), key=lambda item: -item[1])
    lines = "".join(f"<li>{n:,} x {_text(text)}</li>" for text, n in most[:MOST_SENTENCES])
    more = len(most) - MOST_SENTENCES
    rest = f"<li>and {more:,} other sentences</li>" if more > 0 else ""
    return [f"<h2>{title}: {sum(sentences.values()):,}</h2><ul>{lines}{rest}</ul>"]


def _cell(value: Any, time: bool = False) -> str:
    if value is None:
        return "<td></td>"
    shown = _shown(value, time)
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return f'<td class="n" data-v="{value!r}">{shown}</td>'
    return f"<td>{_text(shown)}</td>"


def _shown(value: Any, time: bool = False) -> str:
    """A figure or a word as a person reads it."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}"
    return f"{value:.{2 if time else 5}g}" if isinstance(value, float) else str(value)


def _text(text: str) -> str:
    return html.escape(text)


@dataclass(frozen=True)
class Plot:
    """A drawing of two figures.

    Attributes:
        x, y: names of the columns.
        svg: the drawing; empty where matplotlib is missing.
    """

    x: str
    y: str
    svg: bytes


def choose_plots(table: Table, study: Study) -> list[tuple[str, str]]:
    """Pairs of columns worth a drawing: objectives first, then what is known against the mass."""
    known = {c for c in table.columns if np.isfinite(table.numbers(c)).sum() > 1}
    goals = [] if study.front is None else [n for n in study.front.objectives if n in known]
    pairs = [(x, y) for k, x in enumerate(goals) for y in goals[k + 1 :]]
    masses = sorted(
        (name for name in MASSES if name in known),
        key=lambda name: -np.isfinite(table.numbers(name)).sum(),
    )
    if masses:
        pairs += [(masses[0], y) for y in AGAINST_MASS if y in known]
    return list(dict.fromkeys(pairs))[:MOST_PLOTS]


def plots_of(table: Table, study: Study, front: Sequence[str]) -> list[Plot]:
    """The drawings of a study; none where matplotlib is missing."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return []
    chosen = np.isin(np.array(table.column("key"), str), np.array(front, str))
    return [Plot(x, y, _draw(table, x, y, chosen)) for x, y in choose_plots(table, study)]


def _draw(table: Table, x: str, y: str, chosen: Bools) -> bytes:
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    across, up = table.numbers(x), table.numbers(y)
    groups = np.array([str(value) for value in _groups(table)], str)
    figure = Figure(figsize=SIZE, layout="constrained")
    axes = figure.add_subplot()
    for number, name in enumerate(dict.fromkeys(groups.tolist())):
        one = groups == name
        colour = COLOURS[number % len(COLOURS)]
        axes.scatter(across[one], up[one], s=14, color=colour, label=name, linewidths=0)
    if chosen.any():
        axes.scatter(
            across[chosen], up[chosen], s=46, facecolors="none", edgecolors="#202020",
            linewidths=0.9, label="chosen",
        )  # fmt: skip
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.3)
    for set_scale, values in ((axes.set_xscale, across), (axes.set_yscale, up)):
        finite = values[np.isfinite(values)]
        if finite.min() > 0.0 and finite.max() > 30.0 * finite.min():
            set_scale("log")
    if len(axes.get_legend_handles_labels()[1]) > 1:
        axes.legend(fontsize=7, framealpha=0.7)
    drawing = io.BytesIO()
    # The same table gives the same file.
    with rc_context({"svg.hashsalt": "volfrep"}):
        figure.savefig(drawing, format="svg", metadata={"Date": None})
    return drawing.getvalue()


def _groups(table: Table) -> list[object]:
    """What the colour says: the cell, or the part, or nothing."""
    for name in ("cell", "part"):
        if name in table.columns and len(set(table.column(name))) > 1:
            return table.column(name)
    return ["designs"] * len(table.rows)
