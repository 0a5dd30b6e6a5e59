# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants placed where their struts are: numbered at once, with coordinates for those asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ..grid.motion import Motion
from ..lattice.assembly import (
    CHUNK_VERTICES,
    Layout,
    box,
    facets,
    in_steps,
    lay_out,
    lay_out_some,
    neighbour_missing,
    numbers,
    placed,
)
from ..lattice.certificate import SAFE_STEPS, CertifiedPieces, agree_on_faces, certify_pieces
from ..lattice.deform import Deformed
from ..lattice.deformed_octants import look_at_deformed
from ..lattice.octant_kinds import DeformedOctants
from ..lattice.placed_octants import Placed
from ..mesh.precision import decimal_step
from ..mesh.triangle_mesh import TriangleMesh, box_of
from ..octants.octant import Octant, OctantKey, wrapped
from ..spatial.self_intersection import meeting_boxes
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.ragged import pairs_in_steps
from ..util.types import Bools, Floats, Ints, Periodic
from .culling import CROSSING_MARGIN, KeptOctants

#: Octants on moved struts mostly reach no farther out of their places than this, in units of
#: their edges. Where they do, they are looked for so many times as far as the last ones reached.
FIRST_MARGIN = 0.05
SPARE_MARGIN = 1.05
#: How often they are looked for farther out. From the second time on it is at least twice as far,
#: so that the last time is more than the `SUPPORT` of three cells about an octant: a vertex hangs
#: on the struts of its own cell, and none reaches there.
MOST_WIDENINGS = 9
#: A triangle reaches into an octant where it does by more than this, in units of L.
REACH = 1e-9


@dataclass(frozen=True, eq=False)
class PlacedLattice(Placed):
    """All the octants of a lattice where their struts are.

    Attributes:
        kept: which octants there are.
        octants: their meshes, without corners.
        excess: how far those that do not keep their places reach out of them, in units of their
            edges.
        monitor: asked for a cancel while these are looked at.
    """

    kept: KeptOctants
    octants: dict[OctantKey, Octant]
    excess: float = 0.0
    monitor: Monitor = field(default_factory=Monitor)

    def alone(self, where: Bools) -> Layout:
        """Some of the octants without their corners, numbered as among all; their own count."""
        return lay_out_some(replace(self.layout, octants=self.octants), where)

    def to_cut(self) -> PlacedLattice:
        """The same for what asks for `cutting` only, without vertices' numbers that takes none of.

        Nor with a monitor.
        """
        layout = self.layout
        if self.points is None:
            layout = replace(layout, places=[], base=layout.base[:0])
        return replace(self, layout=layout, octants={}, monitor=Monitor())

    @cached_property
    def is_proved_by_kind(self) -> bool:
        """Whether what holds for kinds of octants holds for all of them, where they lie.

        They keep their places, octants that share a vertex give it the same coordinates, and the
        wall stays clear of those that it does not cross.
        """
        return self.points is None and agree_on_faces(self.layout)

    @cached_property
    def deformed(self) -> DeformedOctants | None:
        """What is found of octants inside, and those beside them, that do not keep their places."""
        if self.points is None:
            return None
        near, periodic = wrapped(self.kept.inside, self.periodic), self.periodic
        present = wrapped(self.layout.grid.kind >= 0, periodic)
        for axis in range(3):
            near = near | np.roll(near, 1, axis) | np.roll(near, -1, axis)
        where = (near & present)[1:-1, 1:-1, 1:-1]
        octants = [self.octants[key] for key in self.layout.grid.keys]
        safe = SAFE_STEPS * decimal_step(self.points)
        return look_at_deformed(
            self.layout, octants, self.points, where, safe, self.excess, self.monitor
        )

    @cached_property
    def unsound(self) -> Bools:
        """(nx, ny, nz) bool, deformed octants with a fault in them, and those about them."""
        if self.deformed is None:
            return np.zeros(self.kept.inside.shape, bool)
        from scipy import ndimage  # slow to import

        wide = wrapped(self.deformed.unsound, self.periodic)
        return np.asarray(ndimage.binary_dilation(wide, np.ones((3, 3, 3), bool))[1:-1, 1:-1, 1:-1])

    @property
    def periodic(self) -> Periodic:
        """Along which axes the octants close upon themselves."""
        return self.layout.grid.periodic

    @property
    def clearance(self) -> float:
        """How near the wall may come to octants that it does not cross, mm."""
        return 0.25 * CROSSING_MARGIN * self.layout.grid.cell_size


@dataclass(frozen=True, eq=False)
class Caps:
    """Flat faces where octants follow on a solid.

    Attributes:
        mesh: the faces, mm.
        at_rim: (n,) which of the vertices at the octants' rim each of its vertices is; -1 for none.
    """

    mesh: TriangleMesh
    at_rim: Ints


@dataclass(frozen=True, eq=False)
class PlacedVertices:
    """Vertices of octants that are placed already.

    Attributes:
        numbers: (k,) ascending.
        points: (k, 3) where they are, mm.
    """

    numbers: Ints
    points: Floats


@dataclass(frozen=True, eq=False)
class Proof:
    """What is proved of octants inside.

    Attributes:
        pieces: by their kinds.
        rim: the vertices, by their numbers, at which octants are open; ascending.
        points: (k, 3) where these are, mm.
    """

    pieces: CertifiedPieces
    rim: Ints
    points: Floats


@dataclass(frozen=True, eq=False)
class InnerOctants:
    """Octants that belong to a surface without being in its mesh.

    Attributes:
        lattice: all the octants.
        where: (nx, ny, nz) bool, these.
        known: vertices, those at their rim among them; None: none is placed yet.
        proof: of them; None: it is found when it is asked for.
    """

    lattice: PlacedLattice
    where: Bools
    known: PlacedVertices | None = None
    proof: Proof | None = None

    @cached_property
    def layout(self) -> Layout:
        """They alone, numbered as among all."""
        return self.lattice.alone(self.where)

    @property
    def triangles(self) -> int:
        """How many they have, without a proof of them."""
        grid, octants = self.lattice.layout.grid, self.lattice.octants
        kind = grid.kind[self.where]
        often = np.bincount(kind[kind >= 0], minlength=len(grid.keys))
        return int(sum(often * np.array([len(octants[key].triangles) for key in grid.keys])))

    @cached_property
    def pieces(self) -> CertifiedPieces:
        """What is proved of them by their kinds."""
        if self.proof is not None:
            return self.proof.pieces
        return certify_pieces(self.layout, box(self.layout).mean(axis=0), self.lattice.deformed)

    @property
    def sound(self) -> InnerOctants:
        """Those of them in which moving them has left no fault."""
        wrong = self.where & self.lattice.unsound
        return InnerOctants(self.lattice, self.where & ~wrong) if wrong.any() else self

    @cached_property
    def rim(self) -> Ints:
        """The vertices, by their numbers, at which octants are open; ascending."""
        return np.unique(self.pieces.rim) if self.proof is None else self.proof.rim

    @cached_property
    def rim_points(self) -> Floats:
        """(k, 3) where they are, mm."""
        if self.known is not None:
            return self.known.points[self.rim_in_known]
        if self.proof is not None:
            return self.proof.points
        numbers = self.rim.astype(np.int32)
        return self.lattice.coordinates(numbers, self._at_rim, Monitor(), shared=True)

    @property
    def rim_in_known(self) -> Ints:
        """(k,) which of the known vertices they are; of all where none is known."""
        if self.known is None:
            return np.arange(len(self.rim))
        return np.searchsorted(self.known.numbers, self.rim)

    @cached_property
    def _at_rim(self) -> Bools:
        """(nx, ny, nz) bool, octants that have all the vertices at the rim."""
        inner = np.pad(self.where, 1)
        for axis in range(3):
            inner &= np.roll(inner, 1, axis) & np.roll(inner, -1, axis)
        result: Bools = self.where & ~inner[1:-1, 1:-1, 1:-1]
        return result

    @property
    def numbered_alone(self) -> tuple[Layout, Ints]:
        """They alone with numbers of their own, and those of the vertices at the rim."""
        layout, alone = self.layout, lay_out(self.layout.grid, self.layout.octants)
        result = np.full(len(self.rim), -1, np.int64)
        for key, place in zip(layout.grid.keys, layout.places, strict=True):
            octant = layout.octants[key]
            some = place[self._at_rim[tuple(place.T)]]
            number = numbers(layout, octant, some).ravel()
            row = np.minimum(np.searchsorted(self.rim, number), len(self.rim) - 1)
            at_rim = self.rim[row] == number
            result[row[at_rim]] = numbers(alone, octant, some).ravel()[at_rim]
        return alone, result

    @property
    def deformed_vertices(self) -> tuple[Floats, Ints] | None:
        """Where all vertices of the lattice are, and which are theirs, as `numbered_alone` counts.

        None where they keep their places.
        """
        points = self.lattice.points
        if points is None:
            return None
        used = np.zeros(len(points), bool)
        for key, place in zip(self.layout.grid.keys, self.layout.places, strict=True):
            octant = self.layout.octants[key]
            size = max(1, CHUNK_VERTICES // max(1, len(octant.vertices)))
            for begin in range(0, len(place), size):
                used[numbers(self.layout, octant, place[begin : begin + size])] = True
        return points, np.flatnonzero(used)

    @cached_property
    def bounds(self) -> Floats:
        """(2, 3) of their vertices, mm."""
        motion = self.lattice.motion
        if self.lattice.deformed is not None:
            return box_of(np.concatenate(self._boxes(self.lattice.deformed)[1:]))
        if motion.frame is None:
            return motion(box(self.layout))
        farthest = []
        for key, place in zip(self.layout.grid.keys, self.layout.places, strict=True):
            octant = self.layout.octants[key]
            if not len(octant.vertices) or not len(place):
                continue
            steps = in_steps(self.layout.grid, octant)
            corner, sign = self.layout.frames(place)
            for frame in np.unique(sign, axis=0):
                # What is farthest has the farthest place and the farthest vertex of an octant.
                own, points = corner[(sign == frame).all(axis=1)], frame * steps
                where, what = motion.turned(1.0 * own), motion.turned(points)
                for end in (np.argmin, np.argmax):
                    at, of = end(where, axis=0), end(what, axis=0)
                    farthest.append(motion(placed(self.layout.grid, own[at], points[of])))
        return box_of(np.concatenate(farthest))

    def middle(self, places: Ints) -> Floats:
        """(k, 3) the middles of octants at some places, mm."""
        grid = self.lattice.layout.grid
        return self.lattice.motion(grid.origin + 0.5 * grid.cell_size * (places - 0.5))

    def caps(self, monitor: Monitor) -> Caps:
        """What closes the solid that follows on them, seen from there."""
        layout, others = self.lattice.layout, (self.lattice.layout.grid.kind >= 0) & ~self.where
        every, at = [], np.zeros_like(others)
        for axis in range(3):
            for high in (False, True):
                missing = neighbour_missing(layout.grid, others, axis, high)
                missing &= ~neighbour_missing(layout.grid, others | self.where, axis, high)
                every.append(facets(layout, monitor, missing, (axis, high)))
                at |= missing
        mesh, number = self.lattice.mesh(np.concatenate(every), at, monitor)
        row = np.minimum(np.searchsorted(self.rim, number), len(self.rim) - 1)
        return Caps(mesh, np.where(self.rim[row] == number, row, -1))

    def _boxes(self, deformed: DeformedOctants) -> tuple[Ints, Floats, Floats]:
        """(k, 3) places of those with a surface, and (k, 3) corners of the boxes about them, mm."""
        found = []
        for number, (key, place) in enumerate(
            zip(self.layout.grid.keys, self.layout.places, strict=True)
        ):
            if len(self.layout.octants[key].triangles):
                found.append((place, *deformed.boxes(number, place)))
        places, low, high = (np.concatenate(each) for each in zip(*found, strict=True))
        return places, low, high

    def _boxes_reached(self, deformed: DeformedOctants, corners: Floats) -> Bools:
        """`reached` of deformed octants: those whose boxes meet those of triangles."""
        places, low, high = self._boxes(deformed)
        result = np.zeros(self.where.shape, bool)
        if len(places) and len(corners):
            least, most = corners.min(axis=1), corners.max(axis=1)
            met, _ = meeting_boxes(low, high, least, most, float((high - low).max()))
            result[tuple(places[met].T)] = True
        return result

    def reached(self, corners: Floats) -> Bools:
        """(nx, ny, nz) bool, those of them that (k, 3, 3) triangles reach into."""
        if self.lattice.deformed is not None:
            return self._boxes_reached(self.lattice.deformed, corners)
        grid = self.lattice.layout.grid
        # Octant 0 lies on the low side of the grid's corner.
        places = (self.lattice.motion.back(corners) - grid.origin) / (0.5 * grid.cell_size) + 1.0
        limit = np.array(self.where.shape)
        low = np.clip(np.floor(places.min(axis=1) + REACH).astype(np.int64), 0, limit)
        high = np.clip(np.ceil(places.max(axis=1) - REACH).astype(np.int64), 0, limit)
        span = np.maximum(high - low, 0)
        result = np.zeros(self.where.shape, bool)
        normal = np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
        for row, place in pairs_in_steps(span.prod(axis=1)):
            place, z = np.divmod(place, span[row, 2])
            x, y = np.divmod(place, span[row, 1])
            index = low[row] + np.stack([x, y, z], axis=1)
            some = self.where[tuple(index.T)]
            index, row = index[some], row[some]
            # A large triangle is near few of the octants that its box is near.
            across = normal[row]
            above = np.einsum("ij,ij->i", index + 0.5 - places[row, 0], across)
            meets = np.abs(above) <= (0.5 - REACH) * np.abs(across).sum(axis=1)
            result[tuple(index[meets].T)] = True
        return result


def prove(inner: InnerOctants) -> Proof:
    """The proof of some octants, which any process may find."""
    return Proof(inner.pieces, inner.rim, inner.rim_points)


def in_place(kept: KeptOctants, octants: dict[OctantKey, Octant], motion: Motion) -> PlacedLattice:
    """Octants that keep their places but for a motion."""
    return PlacedLattice(kept.lay_out(octants), None, motion, kept, octants)


def lay(
    first: tuple[KeptOctants, dict[OctantKey, Octant]],
    margin: float,
    within: Callable[[float], tuple[KeptOctants, dict[OctantKey, Octant]]],
    place: Callable[[Layout], Deformed],
    monitor: Monitor,
) -> PlacedLattice:
    """The octants placed where the struts are; with more of them, where struts reach far out.

    Args:
        first: the octants within the margin, and their meshes.
        margin: how far out of their places octants may reach, in units of their edges.
        within: gives the octants within a wider one.
        place: gives where the vertices of numbered octants are.
        monitor: asked for a cancel whenever these are looked at.

    Raises:
        VolfrepError: octants reach out farther than `MOST_WIDENINGS` find.
    """
    kept, octants = first
    for widening in range(MOST_WIDENINGS + 1):
        layout = kept.lay_out(octants)
        placed = place(layout)
        if placed.excess <= margin + 1e-9:
            still = Motion(np.zeros(3))
            return PlacedLattice(
                layout, placed.vertices, still, kept, octants, placed.excess, monitor
            )
        if widening < MOST_WIDENINGS:
            margin = max(SPARE_MARGIN * placed.excess, 2.0 * margin if widening else 0.0)
            kept, octants = within(margin)
    raise VolfrepError(
        f"Struts reach {placed.excess / 2.0:.1f} cells out of their places: grade the cells or "
        "their radii less steeply."
    )
