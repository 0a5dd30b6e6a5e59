# SPDX-License-Identifier: LGPL-2.1-or-later
"""A load case as a line drawing (SVG): the part's edges, what is held and loaded, arrows."""

from __future__ import annotations

from xml.sax.saxutils import escape

import numpy as np

from ..loads.load_cases import LoadCase
from ..loads.nodal_loads import Body, nodes_in
from ..loads.regions import Region
from ..mesh import remesh
from ..mesh.triangle_mesh import TriangleMesh
from ..util.types import Bools, Floats
from .load_arrows import ARROW, HELD, LOADED, Arrow, arrows_of, solid_body

#: Of the part on the drawing, px; what stays free about it; half a figure's width and height.
_SIDE, _BORDER, _FIGURE = 300.0, 10.0, (45.0, 16.0)
#: Where it is seen from.
_VIEW = (1.0, -1.3, 0.9)
#: Edges where the surface turns by more are drawn, degrees.
_SHARP = 30.0
_FRONT, _BEHIND = "#444", "#c4c4c4"


def load_drawing(solid: TriangleMesh, case: LoadCase) -> str:
    """A part with the supports and loads of a case, as SVG.

    Held faces are blue, loaded ones orange; a moment's arrow has two heads and is read by the right
    hand. What the view hides is drawn, too, edges of it paler.

    Args:
        solid: the part, closed, mm.
        case: in its coordinates.

    Raises:
        VolfrepError: nothing of the part lies where the case has a support or a load.
    """
    body = solid_body(solid)
    sheet = _Sheet(solid)
    parts = [*sheet.edges(solid)]
    for support in case.supports:
        parts += sheet.region(solid, body, support.region, HELD)
    for load in case.loads:
        parts += sheet.region(solid, body, load.region, LOADED)
    for arrow in arrows_of(body, case):
        parts += sheet.arrow(body, arrow)
    return "\n".join(
        [
            '<svg xmlns="http://www.w3.org/2000/svg" '
            f'viewBox="{sheet.box()}" '
            'font-family="sans-serif" font-size="14">',
            f"<title>{escape(case.name)}</title>",
            *parts,
            "</svg>",
        ]
    )


class _Sheet:
    """Places of a part on a drawing, which is as high as the part asks for."""

    def __init__(self, solid: TriangleMesh) -> None:
        self.toward = np.array(_VIEW) / np.linalg.norm(_VIEW)
        right = np.cross((0.0, 0.0, 1.0), self.toward)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, -np.cross(self.toward, right)], axis=1)
        flat = solid.vertices @ self.axes
        self.low = flat.min(axis=0)
        span = np.maximum(np.ptp(flat, axis=0), 1e-9)
        self.scale = _SIDE / float(span.max())
        self._reached = [np.zeros(2), self.scale * span]

    def at(self, points: Floats) -> Floats:
        """(n, 2) px, of (n, 3) mm."""
        return np.asarray((points @ self.axes - self.low) * self.scale)

    def box(self) -> str:
        """What is drawn on, as an SVG says it."""
        low = np.min(self._reached, axis=0) - _BORDER
        size = np.max(self._reached, axis=0) + _BORDER - low
        return "{:.0f} {:.0f} {:.0f} {:.0f}".format(*low, *size)

    def edges(self, solid: TriangleMesh) -> list[str]:
        """Sharp edges and the outline, those behind first."""
        triangles = solid.triangles.astype(np.int64)
        normal = remesh.unit_normals(solid.vertices[triangles])
        front = normal @ self.toward > 0.0
        table = remesh.edges(triangles, len(solid.vertices))
        one, two = table.triangles.T
        cosine = np.einsum("ij,ij->i", normal[one], normal[two])
        drawn = (cosine < np.cos(np.radians(_SHARP))) | (front[one] != front[two]) | (two < 0)
        seen = front[one] | front[two]
        found = []
        for chosen, colour in ((drawn & ~seen, _BEHIND), (drawn & seen, _FRONT)):
            ends = self.at(solid.vertices[table.ends[chosen].ravel()]).reshape(-1, 4)
            path = "".join("M{:.1f} {:.1f}L{:.1f} {:.1f}".format(*row) for row in ends.tolist())
            found.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="0.8"/>')
        return found

    def region(self, solid: TriangleMesh, body: Body, region: Region, colour: str) -> list[str]:
        """What a region takes: its facets; its nodes where it has none."""
        taken: Bools = region.facets(solid, 1e-4 * body.size)
        if taken.any():
            corners = self.at(solid.vertices[solid.triangles[taken].ravel()]).reshape(-1, 6)
            path = "".join(
                "M{:.1f} {:.1f}L{:.1f} {:.1f} {:.1f} {:.1f}Z".format(*row)
                for row in corners.tolist()
            )
            return [
                f'<path d="{path}" fill="{colour}" fill-opacity="0.45" stroke="{colour}" '
                'stroke-width="0.3"/>'
            ]
        places = self.at(body.nodes[nodes_in(body, region)])
        return [
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>' for x, y in places.tolist()
        ]

    def arrow(self, body: Body, arrow: Arrow) -> list[str]:
        """An arrow with its text."""
        start, way, outwards = arrow.drawn(body)
        (x, y), (u, v) = self.at(np.stack([start, start + ARROW * body.size * way])).tolist()
        line = np.array([u - x, v - y])
        length = float(np.linalg.norm(line))
        if length < 1.0:  # along the view
            return [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{LOADED}"/>',
                    *self._label(x + 8.0, y, arrow.text)]  # fmt: skip
        step, aside = line / length, np.array([-line[1], line[0]]) / length
        found = [
            f'<path d="M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}" stroke="{LOADED}" stroke-width="2.5"/>'
        ]
        for head in range(arrow.heads):
            tip = np.array([u, v]) - 10.0 * head * step
            one, two = tip - 11.0 * step + 5.0 * aside, tip - 11.0 * step - 5.0 * aside
            points = " ".join(f"{a:.1f},{b:.1f}" for a, b in (tip, one, two))
            found.append(f'<polygon points="{points}" fill="{LOADED}"/>')
        end = (u, v) if outwards else (x, y)
        beyond = step if outwards else -step
        return [
            *found,
            *self._label(end[0] + 10.0 * beyond[0], end[1] + 14.0 * beyond[1], arrow.text),
        ]

    def _label(self, x: float, y: float, told: str) -> list[str]:
        place = np.array([x, y])
        self._reached += [place - _FIGURE, place + _FIGURE]
        return [
            f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="middle" stroke="white" stroke-width="3" '
            f'paint-order="stroke">{escape(told)}</text>'
        ]
