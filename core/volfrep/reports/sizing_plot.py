# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a search for radii went, step by step, as a plot."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any
from xml.sax.saxutils import escape

from ..util.errors import VolfrepError
from ..util.files import replacing

_WIDTH, _HEIGHT = 640, 400
_LEFT, _RIGHT, _TOP, _BOTTOM = 70, 570, 40, 350
#: Colours that are told apart without red and green, too.
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")


def check_plot(path: str | os.PathLike[str]) -> None:
    """Refuse a plot in another format, before any work.

    Raises:
        VolfrepError: it is not an .svg.
    """
    if not os.fspath(path).lower().endswith(".svg"):
        raise VolfrepError(f"A plot is an .svg file, and '{path}' is none.")


def write_sizing_plot(report: Mapping[str, Any], path: str | os.PathLike[str]) -> None:
    """Write `sizing_plot` to an .svg file.

    Raises:
        VolfrepError: it cannot be written.
    """
    with replacing(path) as file:
        file.write(sizing_plot(report).encode())


def sizing_plot(report: Mapping[str, Any]) -> str:
    """The steps of a sizing report as SVG: the mass of what is sized, and the use of every limit.

    Without limits, the work of the loads. A step's mass is that with which it holds the limits, as
    far as one factor for all radii can tell (`volfrep.sizing.optimise.Step`).

    Args:
        report: of `volfrep.reports.sizing_report`.
    """
    steps = report["steps"]
    density = report["strut_mass_g"] / report["strut_volume_mm3"]
    names = list(steps[0]["uses"])
    if names:
        what = "struts and skin" if "skin" in report else "the struts"
        first = f"mass of {what}, g", [step["strut_volume_mm3"] * density for step in steps]
    else:
        first = "work of the loads, N mm", [step["compliance"] for step in steps]
    uses = [(f"use of {name}, %", [100.0 * step["uses"][name] for step in steps]) for name in names]
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" '
        f'width="{_WIDTH}" height="{_HEIGHT}" font-family="sans-serif" font-size="12">',
        f'<rect width="{_WIDTH}" height="{_HEIGHT}" fill="white"/>',
        f'<path d="M{_LEFT} {_TOP}V{_BOTTOM}H{_RIGHT}V{_TOP}" fill="none" stroke="#555"/>',
        f'<text x="{(_LEFT + _RIGHT) / 2}" y="{_HEIGHT - 12}" text-anchor="middle">step</text>',
        f'<text x="{_LEFT}" y="{_BOTTOM + 18}" text-anchor="middle">1</text>',
        f'<text x="{_RIGHT}" y="{_BOTTOM + 18}" text-anchor="middle">{len(steps)}</text>',
        *_line(first[1], max(first[1]), _COLOURS[0]),
        *_axis(max(first[1]), _LEFT - 6, "end", _COLOURS[0]),
    ]
    most = max((max(values) for _, values in uses), default=0.0)
    for (_, values), colour in zip(uses, _COLOURS[1:], strict=False):
        parts += _line(values, most, colour)
    if uses:
        parts += _axis(most, _RIGHT + 6, "start", "#555")
        allowed = _BOTTOM - (_BOTTOM - _TOP) * 100.0 / max(most, 100.0)
        if most >= 100.0:
            parts.append(
                f'<path d="M{_LEFT} {allowed:.1f}H{_RIGHT}" stroke="#999" stroke-dasharray="4 4"/>'
            )
    place = float(_LEFT)
    for (name, _), colour in zip([first, *uses], _COLOURS, strict=False):
        parts.append(f'<text x="{place}" y="22" fill="{colour}">{escape(name)}</text>')
        place += 7.0 * len(name) + 14.0
    return "\n".join([*parts, "</svg>\n"])


def _line(values: Sequence[float], most: float, colour: str) -> list[str]:
    """Values from 0 to the most, over all steps."""
    wide = (_RIGHT - _LEFT) / max(len(values) - 1, 1)
    high = (_BOTTOM - _TOP) / max(most, 1e-300)
    points = " ".join(
        f"{_LEFT + wide * k:.1f},{_BOTTOM - high * value:.1f}" for k, value in enumerate(values)
    )
    return [f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>']


def _axis(most: float, x: float, anchor: str, colour: str) -> list[str]:
    """0, a half and the most, beside an axis."""
    return [
        f'<text x="{x}" y="{_BOTTOM - (_BOTTOM - _TOP) * share + 4:.1f}" text-anchor="{anchor}" '
        f'fill="{colour}">{most * share:.4g}</text>'
        for share in (0.0, 0.5, 1.0)
    ]
