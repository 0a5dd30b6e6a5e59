# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part on the screen: its lattice and the skin's inner wall seen through its outside."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from freecad_volfrep import preferences
from volfrep.mesh.triangle_mesh import TriangleMesh, compact

from . import drawing

#: The display mode.
FILLED = "Skin and Lattice"
#: The inner wall is so much nearer to white than the skin.
WALL_LIGHTER = 0.35


class FilledPart:
    """Skin and lattice of one mesh in a node of the scene, each in its colour.

    All is opaque but for the outside, and of that only what is nearest to the viewer is drawn,
    last. So the picture does not depend on the order in which anything is drawn. Only what faces
    the viewer is drawn, so that the near wall does not hide the lattice.

    Args:
        node: an empty node of the scene.
        mesh: closed, as it lies before the object's Placement moves it.
        kinds: (t,) of its triangles, see `volfrep.reports.facet_roles`.
        likeness: what is drawn in the place of each of its three parts.
    """

    def __init__(
        self,
        node: Any,
        mesh: TriangleMesh,
        kinds: NDArray[np.uint8],
        likeness: Callable[[TriangleMesh], TriangleMesh] = lambda part: part,
    ) -> None:
        from pivy import coin

        from volfrep.reports.facet_roles import LATTICE, OUTSIDE, WALL

        parts = {}
        for kind in (LATTICE, WALL, OUTSIDE):
            rows = kinds == kind
            if rows.any():
                parts[kind] = likeness(compact(TriangleMesh(mesh.vertices, mesh.triangles[rows])))
        shapes = {kind: drawing.faces(part) for kind, part in parts.items()}
        self._looks = {}
        front = drawing.separate(drawing.seen_from(outside=True))
        for kind in parts.keys() & {LATTICE, WALL}:
            self._looks[kind] = drawing.material((0.0, 0.0, 0.0))
            front.addChild(drawing.separate(self._looks[kind], shapes[kind]))
        self._ends = drawing.Inside(*(shapes[kind] for kind in shapes if kind == LATTICE))
        self._cut_faces = drawing.Inside(*shapes.values())
        self._inside = coin.SoSwitch()
        for inside in (self._ends, self._cut_faces):
            self._inside.addChild(inside.node)
        node.addChild(self._inside)
        node.addChild(front)
        self._skin = None
        if OUTSIDE in parts:
            self._skin = drawing.SeeThrough(parts[OUTSIDE], shapes[OUTSIDE])
            node.addChild(self._skin.node)

    def set_look(self, view: Any, is_cut: bool) -> None:
        """Colours and transparency of the object's view; opaque, with cut faces, in a section."""
        from volfrep.reports.facet_roles import LATTICE, WALL

        skin, lattice = view.ShapeColor[:3], view.LatticeColor[:3]
        wall = [part + WALL_LIGHTER * (1.0 - part) for part in skin]
        for kind, look in (
            (LATTICE, (lattice, drawing.STRUT)), (WALL, (wall, drawing.FACE)),
        ):  # fmt: skip
            if kind in self._looks:
                drawing.paint(self._looks[kind], *look)
        self._ends.paint(lattice)
        self._cut_faces.paint(preferences.colour(preferences.CUT_COLOUR))
        self._inside.whichChild = 1 if is_cut else 0
        if self._skin is not None:
            self._skin.paint(skin, 0.0 if is_cut else view.Transparency / 100.0)


def show_filled(obj: Any, node: Any) -> FilledPart:
    """Fill the node with an infill's mesh."""
    mesh, kinds = mesh_and_kinds(obj)
    return FilledPart(node, mesh, kinds)


def mesh_and_kinds(obj: Any) -> tuple[TriangleMesh, NDArray[np.uint8]]:
    """An infill's mesh as it lies before its Placement moves it, and what its triangles are."""
    from freecad_volfrep.bridge.meshes import from_freecad
    from freecad_volfrep.bridge.solids import placed
    from freecad_volfrep.features.skin import kinds_of

    # The view moves its nodes by the object's Placement, which the mesh has in it already.
    mesh = placed(from_freecad(obj.Mesh), obj.Placement.inverse())
    return mesh, kinds_of(obj, mesh)
