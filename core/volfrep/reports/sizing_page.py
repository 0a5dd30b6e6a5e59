# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report of a sizing as a page to print and file: one HTML file without anything outside it."""

from __future__ import annotations

import html
import os
from collections.abc import Mapping
from typing import Any

from ..loads.load_cases import LoadCases
from ..mesh.triangle_mesh import TriangleMesh
from ..util.files import replacing
from .load_drawing import load_drawing
from .sizing_plot import sizing_plot
from .sizing_results import CASE, case_table, result_tables, sizing_results
from .tables import table_html

#: Suffixes of pages; what else a report is written to is JSON.
PAGES = (".html", ".htm")
#: What no figure of the page holds, whatever the part.
NOT_LOOKED_AT = (
    "Linear statics: no plasticity, contact, fatigue or impact.",
    "Stress inside joints and fillets, and in the 0.1 % of a skin where it peaks.",
    "Residual stress, distortion, roughness and pores of the process.",
)
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
    results = sizing_results(report)
    tables = result_tables(one for one in results if one.subject != CASE)
    parts = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        f"<title>{_text(name)}: sized for loads</title><style>{_STYLE}</style></head><body>",
        f"<h1>{_text(name)}: sized for loads</h1>",
        f'<p class="verdict">{_text(verdict[0].upper() + verdict[1:])}</p>',
        f"<p>{_text(_material(report['material']))} Units: mm, N, MPa. VOLFREP "
        f"{_text(__version__)}.</p>",
        "<h2>Loads</h2>",
        "<p>Blue is held, orange is loaded.</p>",
        '<div class="cases">',
        *(
            f"<figure>{load_drawing(solid, case)}<figcaption>{_text(case.name)}</figcaption>"
            "</figure>"
            for case in loads.cases
        ),
        "</div>",
        *(
            text
            for table in (*tables, case_table(results))
            for text in (f"<h2>{_text(table.title)}</h2>", table_html(table))
        ),
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


def _text(text: str) -> str:
    return html.escape(text)
