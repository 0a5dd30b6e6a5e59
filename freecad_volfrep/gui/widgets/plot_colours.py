# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours of plots that are those of the window's theme, light or dark."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

#: Shares of the ink in lines that are behind others.
_GRID, _FAINT = 0.15, 0.35
#: Lightness by which curves are seen on the paper; else so much of the ink is in them.
_APART, _NEARER = 0.25, 0.5


@dataclass(frozen=True)
class PlotColours:
    """What a plot is drawn in, as QColor.

    Attributes:
        paper: behind all of it.
        ink: of letters and frames.
        grid: of lines at the axes' numbers.
        faint: of curves behind others.
    """

    paper: Any
    ink: Any
    grid: Any
    faint: Any

    def seen(self, name: str) -> Any:
        """A curve's colour by its name, nearer to the ink where the paper is about as dark."""
        colour = type(self.ink)(name)
        if abs(colour.lightnessF() - self.paper.lightnessF()) >= _APART:
            return colour
        return _mixed(colour, self.ink, _NEARER)


def plot_colours(widget: Any) -> PlotColours:
    """The colours of the window that a widget is in.

    A style sheet sets the palette of windows once they are shown; of plain widgets only the ink.
    """
    palette = widget.window().palette()
    paper, ink = palette.base().color(), palette.text().color()
    return PlotColours(paper, ink, _mixed(paper, ink, _GRID), _mixed(paper, ink, _FAINT))


def in_theme(svg: str, widget: Any) -> str:
    """A plot of the engine in a widget's colours; its curves' own stay where they are seen."""
    colours = plot_colours(widget)
    svg = re.sub(r"#[0-9a-f]{6}", lambda found: colours.seen(found[0]).name(), svg)
    paper, ink, faint = (one.name() for one in (colours.paper, colours.ink, colours.faint))
    svg = svg.replace("<svg ", f'<svg fill="{ink}" ', 1).replace('fill="white"', f'fill="{paper}"')
    return re.sub(r'="#999"', f'="{faint}"', re.sub(r'="#555"', f'="{ink}"', svg))


def _mixed(one: Any, other: Any, share: float) -> Any:
    """A colour between two, with so much of the other."""
    parts = (
        round(a + share * (b - a))
        for a, b in zip(one.getRgb()[:3], other.getRgb()[:3], strict=True)
    )
    return type(one)(*parts)
