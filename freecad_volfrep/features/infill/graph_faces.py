# SPDX-License-Identifier: LGPL-2.1-or-later
"""The faces that the cells of a lattice infill follow, from its properties."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCAD as App

from volfrep.design.cells import find_cell
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep.design.graphs import GivenGraph


def cells_along_faces(obj: App.DocumentObject, values: dict[str, Any]) -> GivenGraph:
    """Cells between two faces, or in layers upon one.

    Args:
        obj: the infill.
        values: of the parameters in effect, by name.

    Raises:
        VolfrepError: no face is picked, or they do not serve.
    """
    from freecad_volfrep.bridge.face_layers import between_faces
    from freecad_volfrep.bridge.solids import parent_placement

    faces = [(owner, name) for owner, names in obj.NetworkFaces for name in names]
    if not faces:
        raise VolfrepError(
            "A network along faces has none: pick one or two of the solid as NetworkFaces."
        )
    cell, thickness = values["cell"], values["network_thickness"]
    return between_faces(
        faces,
        parent_placement(obj),
        find_cell(cell) if isinstance(cell, str) else cell,
        values["cell_size"],
        values["network_layers"],
        -thickness if values["network_reversed"] else thickness,
    )
