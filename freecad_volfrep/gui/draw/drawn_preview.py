# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a preview is drawn with, as arrays: made on any thread, before Coin is given it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from volfrep.mesh.display_parts import in_pieces
from volfrep.mesh.shading import shade, sharp_edges

from .prisms import CREASE_ANGLE, prisms

if TYPE_CHECKING:
    from volfrep.jobs.preview import Preview
    from volfrep.mesh.display_parts import Pieces
    from volfrep.mesh.triangle_mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class DrawnSolid:
    """The solid that a preview is in.

    Attributes:
        pieces: its faces.
        edges: (e, 2, 3) ends of its sharp edges, mm.
    """

    pieces: Pieces
    edges: NDArray[Any]


def draw_solid(solid: TriangleMesh) -> DrawnSolid:
    """The faces and edges of a solid."""
    return DrawnSolid(in_pieces(shade(solid)), solid.vertices[sharp_edges(solid)])


def draw_struts(preview: Preview, most_prisms: int) -> Pieces | None:
    """The faces of walls, or of struts as prisms; None: they are so many that lines are drawn."""
    surface = preview.surface
    if surface is None and len(preview.start) > most_prisms:
        return None
    if surface is None:
        surface = prisms(preview.start, preview.end, preview.radii)
    return in_pieces(shade(surface, CREASE_ANGLE))
