# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill's beams, where its mesh lies."""

from __future__ import annotations

from dataclasses import replace

import FreeCAD as App
import numpy as np

from volfrep.grid.strut_graph import BeamModel, Wireframe
from volfrep.mesh.triangle_mesh import TriangleMesh

from .solids import parent_placement, placed


def place_in_document(obj: App.DocumentObject) -> App.Placement:
    """What takes the coordinates in which an infill is computed to the document's."""
    return parent_placement(obj).multiply(obj.Placement)


def placed_lattice(lattice: Wireframe, placement: App.Placement) -> Wireframe:
    """The lattice moved by a placement."""
    nodes = placed(TriangleMesh(lattice.nodes, np.zeros((0, 3), np.int32)), placement).vertices
    return replace(lattice, nodes=nodes)


def placed_beams(model: BeamModel, placement: App.Placement) -> BeamModel:
    """The model moved by a placement."""
    return replace(
        model,
        lattice=placed_lattice(model.lattice, placement),
        clip=None if model.clip is None else placed(model.clip, placement),
        skin=None if model.skin is None else placed(model.skin, placement),
    )
