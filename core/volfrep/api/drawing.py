# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts as lines, drawn at once: what a notebook shows of a part."""

from __future__ import annotations

import numpy as np

from ..grid.strut_graph import Wireframe
from ..util.linalg import along

#: More lines than these are a smear: of a larger lattice those nearest to the viewer are drawn.
MOST_LINES = 3000
WIDTH = 320
#: Where the viewer looks from, and what lies to his right and above.
_TOWARDS = np.array([1.0, -1.3, 0.8]) / np.sqrt(1.0 + 1.69 + 0.64)
_RIGHT = np.cross([0.0, 0.0, 1.0], _TOWARDS)
_RIGHT /= np.linalg.norm(_RIGHT)
_UP = np.cross(_TOWARDS, _RIGHT)


def drawing(frame: Wireframe) -> str:
    """An SVG of struts, farthest first; empty where there are none."""
    if not len(frame.struts):
        return ""
    ends = frame.nodes[frame.struts]
    order = np.argsort(along(ends.sum(axis=1), _TOWARDS), kind="stable")[-MOST_LINES:]
    across, up = along(ends[order], _RIGHT), -along(ends[order], _UP)
    radius = frame.radii[order].mean(axis=1)
    edge = float(radius.max())
    left, top = across.min() - edge, up.min() - edge
    wide, high = np.ptp(across) + 2.0 * edge, np.ptp(up) + 2.0 * edge
    shade = np.linspace(205.0, 90.0, len(order)).round().astype(int)
    lines = "".join(
        f'<path d="M{x[0]:.2f} {y[0]:.2f}L{x[1]:.2f} {y[1]:.2f}" stroke-width="{2 * r:.2f}" '
        f'stroke="rgb({grey - 40},{grey},{grey + 45})"/>'
        for x, y, r, grey in zip(across, up, radius, shade, strict=True)
    )
    return (
        f'<svg width="{WIDTH}" viewBox="{left:.2f} {top:.2f} {wide:.2f} {high:.2f}" '
        f'stroke-linecap="round">{lines}</svg>'
    )
