# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report of a sizing as a page to print and file: one HTML file without anything outside it."""

from __future__ import annotations

import html
import os
from collections.abc import Iterable, Mapping
from typing import Any

from ..loads.load_cases import LoadCases
from ..mesh.triangle_mesh import TriangleMesh
from ..util.files import replacing
from .load_drawing import load_drawing
from .sizing_plot import sizing_plot
from .sizing_report import sizing_rows

#: Suffixes of pages; what else a report is written to is JSON.
PAGES = (".html", ".htm")
#: What no figure of the page holds, whatever the part.
NOT_LOOKED_AT = (
    "Linear statics: no plasticity, contact, fatigue or impact.",
    "Stress inside joints and fillets, and in the 0.1 % of a skin where it peaks.",
    "Residual stress, distortion, roughness and pores of the process.",
)
#: Rows of `sizing_rows` that are told as they are.
_TOLD = (
    "struts", "as printed", "built", "skin", "skin governed by", "solid", "one skin", "radius list",
    "removed", "governed by", "same mass", "same limits", "CalculiX",
)  # fmt: skip
#: A limit by its name.
_LIMIT = {
    "stress": "{:.4g} MPa", "skin stress": "{:.4g} MPa", "displacement": "{:.4g} mm",
    "frequency": "{:.4g} Hz or more", "buckling": "at {:.4g} times the loads or more",
    "frame buckling": "at {:.4g} times the loads or more",
}  # fmt: skip
_STYLE = """
body{font:10.5pt/1.4 sans-serif;color:#111;max-width:190mm;margin:8mm auto;padding:0 4mm}
h1{font-size:16pt;margin:0}h2{font-size:11.5pt;margin:5mm 0 1mm;border-bottom:1px solid #999}
table{border-collapse:collapse;width:100%}td,th{padding:.6mm 2mm;text-align:left;
vertical-align:top;border-bottom:1px solid #ddd}th{font-weight:600}
td:first-child{white-space:nowrap}
.verdict{font-size:12.5pt;font-weight:600;margin:2mm 0}.cases{display:flex;flex-wrap:wrap;gap:2%}
figure{width:48%;margin:0 0 3mm}svg{width:100%;height:auto;max-height:75mm}
figcaption{font-size:9.5pt}ul{margin:1mm 0;padding-left:5mm}
tr,figure,li{break-inside:avoid}h2{break-after:avoid}
@page{size:A4;margin:15mm}@media print{body{margin:0;max-width:none;padding:0}}
"""


def is_page(path: str | os.PathLike[str]) -> bool:
    """Whether a report of this name is a page."""
    return os.fspath(path).lower().endswith(PAGES)


def write_sizing_page(
    report: Mapping[str, Any],
    solid: TriangleMesh,
    loads: LoadCases,
    name: str,
    path: str | os.PathLike[str],
) -> None:
    """Write `sizing_page` to a file.

    Raises:
        VolfrepError: it cannot be written.
    """
    with replacing(path) as file:
        file.write(sizing_page(report, solid, loads, name).encode())


def sizing_page(report: Mapping[str, Any], solid: TriangleMesh, loads: LoadCases, name: str) -> str:
    """The report of a sizing: loads, limits, mass, figures of every case, proof, open questions.

    Args:
        report: of `volfrep.reports.sizing_report`.
        solid: the part, mm.
        loads: what it carries.
        name: of the part.
    """
    from .. import __version__

    holds = report["holds"]
    verdict = "holds all limits" if holds else "DOES NOT HOLD ITS LIMITS"
    if not report["uses"]:
        verdict = "the stiffest of its mass"
    proof = report["calculix"]
    if proof is None:
        verdict += "; not solved by another program"
    else:
        verdict += (
            ", confirmed by CalculiX" if proof["confirmed"] else ", NOT CONFIRMED by CalculiX"
        )
    material = report["material"]
    parts = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        f"<title>{_text(name)}: sized for loads</title><style>{_STYLE}</style></head><body>",
        f"<h1>{_text(name)}: sized for loads</h1>",
        f'<p class="verdict">{_text(verdict[0].upper() + verdict[1:])}</p>',
        f"<p>{_text(_material(material))} Units: mm, N, MPa. VOLFREP {_text(__version__)}.</p>",
        "<h2>Loads</h2>",
        "<p>Blue is held, orange is loaded.</p>",
        '<div class="cases">',
        *(
            f"<figure>{load_drawing(solid, case)}<figcaption>{_text(case.name)}</figcaption>"
            "</figure>"
            for case in loads.cases
        ),
        "</div>",
        *_limits(report),
        "<h2>Mass</h2>",
        _table((), _masses(report["masses_g"])),
        "<h2>Load cases</h2>",
        *_cases(report),
        "<h2>Design</h2>",
        _table((), [row for row in sizing_rows(report) if row[0] in _TOLD]),
        "<h2>Search</h2>",
        sizing_plot(report),
        "<h2>What was not looked at, and what to look at</h2>",
        "<ul>",
        *(f"<li>{_text(note)}</li>" for note in (*report["notes"], *NOT_LOOKED_AT)),
        "</ul></body></html>\n",
    ]
    return "\n".join(parts)


def _material(material: Mapping[str, Any]) -> str:
    strength = material.get("yield_stress")
    told = "" if strength is None else f", yield {strength:g} MPa"
    return (
        f"{material['name']}: E {material['young']:g} MPa, Poisson's ratio "
        f"{material['poisson']:g}, {material['density']:g} g/cm3{told}."
    )


def _limits(report: Mapping[str, Any]) -> list[str]:
    """Every limit, its value, and what of it both solutions use; nothing without limits."""
    if not report["uses"]:
        return []
    there = (report["calculix"] or {}).get("uses", {})
    rows = [
        (
            name,
            _LIMIT[name].format(report["limits"][name]),
            f"{use:.1%}",
            f"{there[name]:.1%}" if name in there else "-",
        )
        for name, use in report["uses"].items()
    ]
    return ["<h2>Limits</h2>", _table(("", "limit", "used", "used in CalculiX"), rows)]


def _masses(split: Mapping[str, float]) -> list[tuple[str, str]]:
    """What of the part weighs what."""
    whole = split["struts"] + split["skin"]
    rows = [("struts", split["struts"]), ("skin", split["skin"])]
    if split["solid"]:
        rows.append(("of the skin solid from side to side", split["solid"]))
    return [
        (name, f"{mass:.4g} g ({mass / max(whole, 1e-300):.0%})")
        for name, mass in (*rows, ("whole", whole))
    ]


def _cases(report: Mapping[str, Any]) -> list[str]:
    """Displacement and stress of every case, in all solutions that there are."""
    proof, file = report["calculix"] or {}, report.get("file")
    header = ["", "displacement, mm"]
    if proof:
        header.append("in CalculiX")
    if file:
        header.append("in the file's voxels")
    header.append("stress of struts, MPa")
    skin, there = report.get("skin_stress_mpa"), proof.get("skin_stress_mpa")
    if skin:
        header.append("of the skin")
    if there:
        header.append("of the skin in CalculiX")
    rows = []
    for k, case in enumerate(report["cases"]):
        row = [case["name"], f"{case['displacement_mm']:.4g}"]
        if proof:
            row.append(f"{proof['largest_displacement'][k] * case['displacement_mm']:.4g}")
        if file:
            solved = file["cases"][k]["file"]["extrapolated"]["displacement_mm"]
            row.append(f"{solved:.4g}")
        row.append(f"{case['stress_mpa']:.4g}")
        row += [f"{values[k]:.4g}" for values in (skin, there) if values]
        rows.append(tuple(row))
    return [_table(tuple(header), rows)]


def _table(header: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    head = "".join(f"<th>{_text(name)}</th>" for name in header)
    lines = ["<table>", f"<tr>{head}</tr>" if head else ""]
    lines += ["<tr>" + "".join(f"<td>{_text(cell)}</td>" for cell in row) + "</tr>" for row in rows]
    return "\n".join([*lines, "</table>"])


def _text(text: str) -> str:
    return html.escape(text)
