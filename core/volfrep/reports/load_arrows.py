# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arrows of a load case: where they are, which way they point, what stands at them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..loads.load_cases import LoadCase, Moment, Pressure
from ..loads.nodal_loads import Body, share_of
from ..mesh.triangle_mesh import TriangleMesh
from ..util.types import Floats

#: Colours of what is held and of what is loaded.
HELD, LOADED = "#2f6fd0", "#e8792b"
#: An arrow is this part of the part's size long.
ARROW = 0.22
_SMALL = 1e-12


@dataclass(frozen=True, eq=False)
class Arrow:
    """A force, a pressure, a moment or an acceleration of a part.

    Attributes:
        place: (3,) mm, where it acts.
        along: (3,) which way, of any length but 0.
        text: how much.
        heads: two of a moment, which is read by the right hand.
        middle: (3,) mm, of what is loaded, which may lie beside the place.
    """

    place: Floats
    along: Floats
    text: str
    heads: int
    middle: Floats

    def drawn(self, body: Body) -> tuple[Floats, Floats, bool]:
        """(3,) its start and (3,) its way, of length 1; and whether it points out of the body.

        It ends at its place if it points into the part there, else it begins there.
        """
        way = self.along / max(float(np.linalg.norm(self.along)), _SMALL)
        outwards = bool(way @ (self.place - _middle(body)) >= -1e-3 * body.size)
        start = self.place if outwards else self.place - ARROW * body.size * way
        return start, way, outwards


def solid_body(solid: TriangleMesh) -> Body:
    """A part as what can be held and loaded: its surface."""
    count = len(solid.vertices)
    facets = solid.triangles.astype(np.int64)
    return Body(solid.vertices, facets, np.zeros(count), np.ones(count, bool))


def arrows_of(body: Body, case: LoadCase) -> list[Arrow]:
    """The arrows of a case on a part.

    Raises:
        VolfrepError: nothing of the part lies where the case has a load.
    """
    found = []
    for load in case.loads:
        share = share_of(body, load.region)
        middle = share.weights @ body.nodes[share.nodes]
        if isinstance(load, Pressure):
            push = np.sign(load.pressure) * share.pushes
            if push.any():
                strongest = int(np.argmax(np.linalg.norm(push, axis=1)))
                place = body.nodes[share.nodes[strongest]]
                text = f"{load.pressure:.4g} MPa"
                found.append(Arrow(place, push[strongest], text, 1, place))
        elif isinstance(load, Moment):
            text = _size(load.moment, "N m", 1e-3)
            found.append(Arrow(middle, np.array(load.moment), text, 2, middle))
        else:
            place = middle if load.at is None else np.array(load.at)
            text = _size(load.force, "N", 1.0)
            found.append(Arrow(place, np.array(load.force), text, 1, middle))
    if any(case.acceleration):
        place, text = _middle(body), _size(case.acceleration, "g", 1 / 9806.65)
        found.append(Arrow(place, np.array(case.acceleration), text, 1, place))
    return found


def _middle(body: Body) -> Floats:
    """(3,) mm, of its box."""
    middle: Floats = 0.5 * (body.nodes.min(axis=0) + body.nodes.max(axis=0))
    return middle


def _size(vector: Sequence[float], unit: str, scale: float) -> str:
    """How large a vector is, times `scale`, in a unit."""
    size = scale * float(np.linalg.norm(vector))
    return (
        f"{size / 1000.0:.4g} k{unit}" if unit == "N" and size >= 1000.0 else f"{size:.4g} {unit}"
    )
