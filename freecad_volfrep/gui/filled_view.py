# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part on the screen: its lattice and the skin's inner wall seen through its outside."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from freecad_volfrep import preferences
from volfrep.mesh import TriangleMesh, compact

from . import drawing

#: The display mode.
FILLED = "Skin and Lattice"
#: The inner wall is so much nearer to white than the skin, and edges darker.
WALL_LIGHTER, EDGE_DARKER = 0.35, 0.45


class FilledPart:
    """Skin and lattice of one mesh in a node of the scene, each in its colour.

    All is opaque but for the outside, and of that only what is nearest to the viewer is drawn,
    last. So the picture does not depend on the order in which anything is drawn. Only what faces
    the viewer is drawn, so that the near wall does not hide the lattice; where a section cuts the
    part open one looks at the inside of its surfaces, and these are drawn evenly in the colour of
    cut faces: that covers what is cut through exactly.

    Args:
        node: an empty node of the scene.
        mesh: closed, as it lies before the object's Placement moves it.
        kinds: (t,) of its triangles, see `volfrep.skin`.
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

        from volfrep.skin import LATTICE, OUTSIDE, WALL

        parts = {}
        for kind in (LATTICE, WALL, OUTSIDE):
            rows = kinds == kind
            if rows.any():
                parts[kind] = likeness(compact(TriangleMesh(mesh.vertices, mesh.triangles[rows])))
        shapes = {kind: drawing.faces(part) for kind, part in parts.items()}
        self._looks = {kind: drawing.material((1.0, 1.0, 1.0)) for kind in shapes}
        self._edge_look = drawing.material((0.0, 0.0, 0.0))
        self._cut_look = drawing.material((0.0, 0.0, 0.0))
        front = drawing.separate(drawing.seen_from(outside=True), drawing.behind_edges())
        for kind in (LATTICE, WALL):
            if kind in shapes:
                front.addChild(drawing.separate(self._looks[kind], shapes[kind]))
        node.addChild(front)
        self._cut = coin.SoSwitch()
        self._cut.addChild(
            drawing.separate(
                drawing.seen_from(outside=False), drawing.behind_edges(), drawing.flat_light(),
                self._cut_look, *shapes.values(),
            )
        )  # fmt: skip
        node.addChild(self._cut)
        self._skin = coin.SoSwitch()
        if OUTSIDE in parts:
            node.addChild(drawing.separate(self._edge_look, drawing.edges(parts[OUTSIDE])))
            hints = drawing.seen_from(outside=True), drawing.behind_edges()
            coloured = drawing.separate(self._looks[OUTSIDE], shapes[OUTSIDE])
            unseen = drawing.separate(drawing.material((1.0, 1.0, 1.0), 1.0), shapes[OUTSIDE])
            self._skin.addChild(drawing.separate(*hints, coloured))
            self._skin.addChild(
                drawing.separate(
                    *hints, drawing.see_through(), drawing.nearest_only(), unseen, coloured
                )
            )
            node.addChild(self._skin)

    def set_look(self, view: Any, is_cut: bool) -> None:
        """Colours and transparency of the object's view; opaque, with cut faces, in a section."""
        from volfrep.skin import LATTICE, OUTSIDE, WALL

        skin = np.array(view.ShapeColor[:3])
        colours = {
            OUTSIDE: skin,
            WALL: skin + WALL_LIGHTER * (1.0 - skin),
            LATTICE: view.LatticeColor[:3],
        }
        transparency = 0.0 if is_cut else view.Transparency / 100.0
        for kind, look in self._looks.items():
            look.diffuseColor = tuple(float(part) for part in colours[kind])
            look.transparency = transparency if kind == OUTSIDE else 0.0
        self._edge_look.diffuseColor = tuple(float(part) for part in EDGE_DARKER * skin)
        self._cut_look.diffuseColor = preferences.colour(preferences.CUT_COLOUR)
        self._cut.whichChild = 0 if is_cut else -1
        self._skin.whichChild = 0 if transparency == 0 else 1


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
