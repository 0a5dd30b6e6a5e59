# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part on the screen: its lattice and the skin's inner wall seen through its outside.

Nothing is sorted, which FreeCAD does by triangles' middles and gets wrong for large ones: all is
opaque but the outside, of which only the nearest is drawn, first into the depth buffer, then in its
colour. Cut faces are the insides, in one even colour.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from freecad_volfrep import preferences
from freecad_volfrep.features.infill.skin import is_just_made, kinds_of
from freecad_volfrep.gui.draw import drawing
from volfrep.mesh.display_parts import drawn_parts

if TYPE_CHECKING:
    from volfrep.mesh.display_parts import DrawnPart
    from volfrep.mesh.triangle_mesh import TriangleMesh

#: The display modes: of the mesh itself, and of a proxy in the place of millions of triangles.
FILLED = "Skin and Lattice"
COARSE = "Coarse"
#: The inner wall is so much nearer to white than the skin.
WALL_LIGHTER = 0.35


class FilledPart:
    """Skin and lattice of one mesh in a node of the scene, each in its colour.

    All is opaque but for the outside, and of that only what is nearest to the viewer is drawn,
    last. So the picture does not depend on the order in which anything is drawn. Only what faces
    the viewer is drawn, so that the near wall does not hide the lattice.

    Of large parts a proxy is drawn first; `add_pieces` brings the rest, and takes it away.

    Args:
        node: an empty node of the scene.
        parts: of a closed mesh, of the kinds of `volfrep.reports.facet_roles`.
        is_proxy: leave it at that proxy.
    """

    def __init__(self, node: Any, parts: Sequence[DrawnPart], is_proxy: bool = False) -> None:
        from pivy import coin

        from volfrep.reports.facet_roles import LATTICE, OUTSIDE, WALL

        self._parts = {part.kind: part for part in parts}
        shapes = {kind: coin.SoGroup() for kind in self._parts}
        self._shapes = shapes
        self._looks = {}
        front = drawing.separate(drawing.seen_from(outside=True))
        for kind in self._parts.keys() & {LATTICE, WALL}:
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
        if OUTSIDE in self._parts:
            lines = drawing.edge_lines(self._parts[OUTSIDE].edges)
            self._skin = drawing.SeeThrough(lines, shapes[OUTSIDE])
            node.addChild(self._skin.node)
        for kind, part in self._parts.items():
            if part.first is not None:
                for drawn in drawing.kept_pieces(part.first):
                    shapes[kind].addChild(drawn)
            elif not is_proxy:
                for arrays in part.pieces:
                    shapes[kind].addChild(drawing.piece(*arrays))

    def shapes(self, kinds: Sequence[int]) -> list[Any]:
        """The groups that draw the triangles of these kinds."""
        return [self._shapes[kind] for kind in kinds if kind in self._parts]

    def points(self, kinds: Sequence[int]) -> NDArray[np.float32]:
        """(n, 3) points of the pieces of these kinds, mm, before the object's Placement."""
        return _joined([self._parts[k].pieces.points for k in kinds if k in self._parts])

    def normals(self, kinds: Sequence[int]) -> NDArray[np.float32]:
        """(n, 3) the normals there."""
        return _joined([self._parts[k].pieces.normals for k in kinds if k in self._parts])

    def refine(self, kinds: Sequence[int], longest: float) -> None:
        """Draw these kinds in triangles without longer sides, mm, from now on."""
        from volfrep.mesh.display_parts import finer

        for kind in [kind for kind in kinds if kind in self._parts]:
            self._parts[kind] = replace(
                self._parts[kind], pieces=finer(self._parts[kind].pieces, longest)
            )
            self._shapes[kind].removeAllChildren()
            for arrays in self._parts[kind].pieces:
                self._shapes[kind].addChild(drawing.piece(*arrays))

    def uncolour(self) -> None:
        """Take the colours of points away again."""
        for shape in self._shapes.values():
            for k in range(shape.getNumChildren()):
                drawing.colour_piece(shape.getChild(k), None)

    def coloured(self, kinds: Sequence[int], colours: NDArray[np.float32]) -> Iterator[None]:
        """Give (n, 3) colours to the `points` of these kinds, a piece at each step."""
        first = 0
        for kind in [kind for kind in kinds if kind in self._parts]:
            pieces, shape = self._parts[kind].pieces, self._shapes[kind]
            for k, (low, high) in enumerate(itertools.pairwise(pieces.first_points)):
                drawing.colour_piece(shape.getChild(k), colours[first + low : first + high])
                yield
            first += len(pieces.points)

    @property
    def is_whole(self) -> bool:
        """Whether there is nothing to add to it."""
        return all(part.first is None for part in self._parts.values())

    def add_pieces(self) -> Iterator[None]:
        """Draw what a proxy was drawn of, a piece at each step."""
        for kind, part in self._parts.items():
            shape = self._shapes[kind]
            proxies = shape.getNumChildren()
            for arrays in part.pieces:
                shape.addChild(drawing.piece(*arrays))
                yield
            for _ in range(proxies):
                shape.removeChild(0)
            yield

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


def _joined(arrays: list[NDArray[np.float32]]) -> NDArray[np.float32]:
    return np.concatenate(arrays) if arrays else np.zeros((0, 3), np.float32)


def show_filled(obj: Any, node: Any) -> FilledPart:
    """Fill the node with an infill's mesh, or a proxy that the pieces come to."""
    return show_parts(obj, node, is_coarse=False)


def show_proxy(obj: Any, node: Any) -> FilledPart:
    """Fill the node with a coarse proxy of an infill's mesh, drawn as the mesh itself would be."""
    return show_parts(obj, node, is_coarse=True)


def show_parts(obj: Any, node: Any, is_coarse: bool) -> FilledPart:
    """Fill the node with an infill's mesh, of as many triangles as it has, or coarse.

    What the engine has made with the mesh serves, once; else it is made here.
    """
    from volfrep.reports.facet_roles import OUTSIDE

    made = obj.Proxy.made
    shown = None if made is None else made.shown
    if shown is not None and shown.is_coarse == is_coarse and is_just_made(obj):
        made.shown = None
        return FilledPart(node, shown.parts)
    mesh, kinds = mesh_and_kinds(obj)
    most = int(preferences.LIKENESS * preferences.largest_shown())
    parts = drawn_parts(mesh, kinds, most if is_coarse else len(mesh.triangles), (OUTSIDE,))
    return FilledPart(node, parts)


def mesh_and_kinds(obj: Any) -> tuple[TriangleMesh, NDArray[np.uint8]]:
    """An infill's mesh as it lies before its Placement moves it, and what its triangles are."""
    from freecad_volfrep.bridge.meshes import from_freecad
    from freecad_volfrep.bridge.solids import placed

    # The view moves its nodes by the object's Placement, which the mesh has in it already.
    mesh = placed(from_freecad(obj.Mesh), obj.Placement.inverse())
    return mesh, kinds_of(obj, mesh)
