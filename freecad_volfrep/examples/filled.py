# SPDX-License-Identifier: LGPL-2.1-or-later
"""The example parts with a lattice in them, each in a document of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import FreeCAD as App

from freecad_volfrep.features.infill.factory import make_lattice_infill

from .bracket import make_bracket
from .piston_rod import make_piston_rod


@dataclass(frozen=True)
class Example:
    """A part and its lattice.

    Attributes:
        title: of the document.
        make: models the part in a document.
        lattice: properties of the infill.
        turned: what shows most of it is the isometric view turned so many degrees about Z.
    """

    title: str
    make: Callable[[Any], Any]
    lattice: dict[str, Any]
    turned: float = 0.0


#: Facets coarser than by default: an example is there at once.
EXAMPLES = {
    "Bracket": Example(
        "Bracket",
        make_bracket,
        {
            "CellType": "CVC",
            "CellSize": 10,
            "StrutRadius": 1,
            "ShellThickness": 3,
            "Deviation": 0.05,
        },
        turned=180.0,
    ),
    "PistonRod": Example(
        "Piston rod",
        make_piston_rod,
        {
            "CellType": "BCC",
            "CellSize": 4,
            "StrutRadius": 0.4,
            "ShellThickness": 1,
            "Deviation": 0.02,
        },
    ),
}


def open_example(name: str) -> Any:
    """Model an example in a new document and fill it; returns the infill, computed."""
    example = EXAMPLES[name]
    doc = App.newDocument(name)
    doc.Label = example.title
    part = example.make(doc)
    part.Label = example.title
    infill = make_lattice_infill(doc, part, **example.lattice)
    infill.Proxy.update(infill)
    return infill
