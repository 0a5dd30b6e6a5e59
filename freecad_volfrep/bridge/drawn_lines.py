# SPDX-License-Identifier: LGPL-2.1-or-later
"""The straight edges of sketches and wires, as the engine takes lines."""

from __future__ import annotations

import FreeCAD as App
import numpy as np
import Part
from numpy.typing import NDArray

from volfrep.util.errors import VolfrepError

_LINE = "Part::GeomLine"


def drawn_lines(objects: list[App.DocumentObject]) -> NDArray[np.float64]:
    """(n, 2, 3) starts and ends of the objects' edges, in the document's coordinates, mm.

    Raises:
        VolfrepError: naming the first object without edges, or the first edge that is not straight.
    """
    lines = []
    for obj in objects:
        # As the document shows it: the place of an App::Part that holds it is not in its shape.
        shape = Part.getShape(obj)
        if shape.isNull() or not shape.Edges:
            raise VolfrepError(
                f"'{obj.Label}' has no edges: select a sketch or a wire of straight lines."
            )
        place = obj.getGlobalPlacement().multiply(obj.Placement.inverse())
        for number, edge in enumerate(shape.Edges, start=1):
            if edge.Degenerated:
                continue
            kind = edge.Curve.TypeId
            if kind != _LINE:
                raise VolfrepError(
                    f"Edge{number} of '{obj.Label}' cannot be a strut, it is a "
                    f"{_spoken(kind)}: a strut is straight, draw it as a line."
                )
            ends = (edge.valueAt(edge.FirstParameter), edge.valueAt(edge.LastParameter))
            lines.append([tuple(place.multVec(point)) for point in ends])
    return np.array(lines, np.float64).reshape(-1, 2, 3)


def has_edges(obj: App.DocumentObject) -> bool:
    """Whether the object is a shape with edges; quick enough to be asked at every click."""
    if not obj.isDerivedFrom("Part::Feature") or obj.Shape.isNull():
        return False
    return bool(obj.Shape.Edges)


def _spoken(kind: str) -> str:
    """Part::GeomBSplineCurve as 'B-spline'."""
    name = kind.rpartition("Geom")[2].replace("Curve", "").replace("BSpline", "B-spline")
    return name[0].lower() + name[1:] if not name.startswith("B-") else name
