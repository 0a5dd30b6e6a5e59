# SPDX-License-Identifier: LGPL-2.1-or-later
"""Groups of octants at the wall, each small enough to be cut alone, and the wall near each.

Every triangle of the lattice and of the wall is given out by one group, which has all that
touches it: a group's own octants are cut by all of the wall about them, and its own triangles of
the wall by all octants that reach them, those of other groups too. So both sides of a seam have
the same vertices, up to rounding.

Triangles of the wall that reach into two groups are split, or one would draw a whole row of octants
along.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from ..lattice.assembly import Layout
from ..mesh import remesh
from ..mesh.booleans import from_library, to_library
from ..mesh.open_shells import open_shells
from ..mesh.topology import among_edges, corners_among, edge_keys, vertices_of
from ..mesh.triangle_mesh import TriangleMesh, compact, corners_at, triangle_boxes
from ..spatial.self_intersection import meeting_boxes
from ..util.errors import VolfrepError
from ..util.manifold import manifold_library
from ..util.parallel import ParallelBackend, SharedArray
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .culling import without_pinches
from .flat_walls import FlatWall, Tiles, tile, with_squares
from .group_cut import Group, Piece, rim_of
from .placed_lattice import PlacedLattice

#: A group's octants have no more triangles than about so many.
GROUP_TRIANGLES = 200_000
#: Triangles of the wall that reach into more than one group are split until their sides are no
#: longer than so many octants.
LONGEST_SIDE = 1.0
#: How far the wall is taken beyond what a group has, in octants: not a round number, since walls
#: and octants like those.
BEYOND = 0.1373
#: Boxes that are nearer than this count as touching, in octants.
NEAR = 1e-6
#: Equal lengths differ by less than this part of them.
ROUNDING = 1e-9
#: Triangles of the wall that octants at them are looked for at a time.
CALL_TRIANGLES = 1 << 15


@dataclass(frozen=True, eq=False)
class Groups:
    """Which group every octant at the wall and every triangle of the wall belongs to.

    Attributes:
        lattice: all the octants.
        boundary: closed mesh, mm; of small triangles where groups meet.
        places: (k, 3) the octants.
        low, high: (k, 3) corners of their boxes, mm.
        octant: (k,) the group of each.
        triangle: (m,) the group of each triangle; -1 where no octant touches it.
        touch: (t, 2) octants and triangles whose boxes touch.
        count: of groups.
        precision: slivers thinner than that go, mm.
        repeats: (count,) bool, those that probably are as others are.
    """

    lattice: PlacedLattice
    boundary: TriangleMesh
    places: Ints
    low: Floats
    high: Floats
    octant: Ints
    triangle: Ints
    touch: Ints
    count: int
    precision: float
    repeats: Bools

    def merged(self, which: Ints) -> tuple[Groups, Ints]:
        """With some of the groups as one; and (count,) the new number of each."""
        number = np.arange(self.count)
        number[which] = which.min()
        left, number = np.unique(number, return_inverse=True)
        triangle = np.where(self.triangle < 0, -1, number[self.triangle])
        repeats = self.repeats[left]
        repeats[number[which]] = False
        groups = Groups(
            self.lattice, self.boundary, self.places, self.low, self.high, number[self.octant],
            triangle, self.touch, len(left), self.precision, repeats,
        )  # fmt: skip
        return groups, number

    @cached_property
    def _of_group(self) -> tuple[Ints, Ints]:
        """The octants, by their group."""
        return _sort_groups(self.octant, self.count)

    @cached_property
    def _touched(self) -> tuple[Ints, Ints]:
        """The octants that the wall of each group touches, by the group."""
        order, first = _sort_groups(self.triangle[self.touch[:, 1]], self.count)
        return self.touch[order, 0], first

    @cached_property
    def _walls(self) -> Floats:
        """(count, 2, 3) boxes about each group's part of the wall and what cuts its octants, mm.

        All of a triangle of the wall goes in where an octant is cut by it: a part of it would be
        divided otherwise.
        """
        owner = np.concatenate([self.triangle, self.octant[self.touch[:, 0]]])
        every = np.concatenate([np.arange(len(self.triangle)), self.touch[:, 1]])
        order, first = _sort_groups(owner, self.count)
        every, first = every[order[first[0] :]], first - first[0]
        result = np.tile([[np.inf], [-np.inf]], (self.count, 1, 3))
        some = first[1:] > first[:-1]
        for end, corner in enumerate(self._triangle_boxes):
            least = np.maximum if end else np.minimum
            for axis, along in enumerate(corner):
                result[some, end, axis] = least.reduceat(along[every], first[:-1][some])
        return result

    def to_share(self) -> Groups:
        """The same for other processes, which ask for a `group` only: what that takes is found."""
        for found in ("_of_group", "_touched", "_walls", "_triangle_boxes", "_row", "_beyond"):
            getattr(self, found)
        shared = replace(self, lattice=self.lattice.to_cut(), touch=self.touch[:0])
        shared.__dict__.update({k: v for k, v in self.__dict__.items() if k.startswith("_")})
        return shared

    @property
    def untouched(self) -> Piece:
        """The triangles of the wall that no octant reaches, seen from the material."""
        triangles = self.boundary.triangles[self.triangle < 0, ::-1]
        mesh = compact(TriangleMesh(self.boundary.vertices, triangles))
        shells = open_shells(mesh)
        return Piece(mesh, np.ones(len(triangles), bool), rim_of(mesh), shells=shells)

    def group(self, number: int, cavity: bool) -> Group:
        """One of several groups, with all of the wall that reaches into the box about it.

        Args:
            number: of the group.
            cavity: as of a `Group`.
        """
        octants = self._octants(number)
        low, high = self._box(number, octants)
        (least, most), some = self._triangle_boxes, np.arange(len(self.triangle))
        for axis in range(3):
            meets = (least[axis].take(some) <= high[axis]) & (most[axis].take(some) >= low[axis])
            some = some[meets]
        used, local = np.unique(self.boundary.triangles[some], return_inverse=True)
        near = TriangleMesh(self.boundary.vertices[used], local.reshape(-1, 3).astype(np.int32))
        return self._made(number, octants, near, self.triangle[some] == number, cavity)

    def with_solids(
        self, which: Ints, cavity: bool, monitor: Monitor
    ) -> Iterator[tuple[int, Group]]:
        """Some groups with their numbers, in any order, whose walls are solids.

        Args:
            which: of the groups.
            cavity: as of a `Group`.
            monitor: for cancel.

        Raises:
            VolfrepError: the wall is not a solid that can be cut.
        """
        octants = [self._octants(group) for group in which]
        if self.count == 1:
            boundaries = iter([(0, self.boundary, np.ones(len(self.boundary.triangles), bool))])
        else:
            owned = [np.flatnonzero(self.triangle == group) for group in which]
            boxes = np.array([self._box(*each) for each in zip(which, octants, strict=True)])
            boundaries = _solids_near(self.boundary, boxes, owned, monitor)
        for k, boundary, own in boundaries:
            yield int(which[k]), self._made(int(which[k]), octants[k], boundary, own, cavity, True)

    def _made(
        self,
        number: int,
        octants: Ints,
        boundary: TriangleMesh,
        own_boundary: Bools,
        cavity: bool,
        closed: bool = False,
    ) -> Group:
        """A group of some rows of octants, those of others among them."""
        placed, box = self.lattice.cutting(self.places[octants])
        low = np.array([part.start or 0 for part in box])
        mine = np.zeros(placed.layout.grid.kind.shape, bool)
        mine[tuple((self.places[_of(self._of_group, number)] - low).T)] = True
        every = placed.layout.grid.kind >= 0
        follow = (self.lattice.kept.border[box] | self.lattice.kept.inside[box]) & ~every
        return Group(
            placed, mine, every & ~mine, follow, boundary, own_boundary, cavity,
            alone=self.count == 1, closed=closed, precision=self.precision,
        )  # fmt: skip

    @cached_property
    def _row(self) -> NDArray[np.int32]:
        """(nx, ny, nz) the row of each octant, -1 where none is."""
        result = np.full(self.lattice.kept.border.shape, -1, np.int32)
        result[tuple(self.places.T)] = np.arange(len(self.places))
        return result

    @cached_property
    def _triangle_boxes(self) -> tuple[Floats, Floats]:
        """(3, m) corners of the boxes about the wall's triangles, mm."""
        return triangle_boxes(self.boundary.vertices.T, self.boundary.triangles.T)

    @cached_property
    def _beyond(self) -> float:
        """How far the wall is taken beyond what a group has, mm."""
        return BEYOND * _edge(self.low, self.high)

    def _octants(self, group: int) -> Ints:
        """The rows of a group's octants and of those that touch its part of the wall.

        As many more as it takes for no two of them to touch along an edge or a corner only.
        """
        if self.count == 1:
            return np.arange(len(self.places))
        own = _of(self._of_group, group)
        places = self.places[np.concatenate([own, _of(self._touched, group)])]
        border, periodic = self.lattice.kept.border, self.lattice.layout.grid.periodic
        low, high = places.min(axis=0), places.max(axis=0) + 1
        low, high = np.maximum(low - 1, 0), np.minimum(high + 1, border.shape)
        low = np.where(periodic, 0, low)
        high = np.where(periodic, border.shape, high)
        box = tuple(slice(a, b) for a, b in zip(low, high, strict=True))
        mask = np.zeros(border[box].shape, bool)
        mask[tuple((places - low).T)] = True
        mask = without_pinches(mask, border[box], periodic)
        rows: Ints = self._row[box][mask].astype(np.int64)
        return rows

    def _box(self, group: int, octants: Ints) -> Floats:
        """(2, 3) about a group's octants, its part of the wall and what cuts its own octants."""
        low = np.minimum(self._walls[group, 0], self.low[octants].min(axis=0))
        high = np.maximum(self._walls[group, 1], self.high[octants].max(axis=0))
        return np.array([low - self._beyond, high + self._beyond])


def _sort_groups(group: Ints, count: int) -> tuple[Ints, Ints]:
    """The rows of groups one after the other, and where each group's begin, (count + 1,)."""
    # Narrow numbers are sorted by their digits, in a fifth of the time.
    narrow = group.astype(np.int16) if count <= np.iinfo(np.int16).max else group
    order = np.argsort(narrow, kind="stable")
    return order, np.searchsorted(narrow[order], np.arange(count + 1))


def _of(rows: tuple[Ints, Ints], group: int) -> Ints:
    order, first = rows
    return order[first[group] : first[group + 1]]


def group_octants(
    lattice: PlacedLattice, boundary: TriangleMesh, monitor: Monitor, precision: float = 0.0
) -> Groups:
    """Octants and wall in groups.

    Args:
        lattice: all the octants.
        boundary: closed mesh of what the lattice fills.
        monitor: for progress and cancel.
        precision: slivers thinner than that go, mm.
    """
    layout = lattice.layout
    if _triangles(layout, np.argwhere(lattice.kept.border)).sum() <= GROUP_TRIANGLES:
        places = np.argwhere(lattice.kept.border)
        nowhere = np.zeros((0, 3))
        return Groups(
            lattice, boundary, places, nowhere, nowhere, np.zeros(len(places), np.int64),
            np.zeros(len(boundary.triangles), np.int64), np.zeros((0, 2), np.int64), 1,
            precision, np.zeros(1, bool),
        )  # fmt: skip
    places, low, high = lattice.boxes(lattice.kept.border, monitor)
    edge = _edge(low, high)
    flat, longest = _flat_wall(lattice, boundary), LONGEST_SIDE * edge
    tiles = None if flat is None else tile(flat, places, low, high)
    if flat is None or tiles is None:
        tiles = Tiles(np.full(len(places), -1), np.zeros(0, np.int64), 0)
    else:
        boundary = flat.mesh
        # No side of a square is too long, whose halves stay.
        longest = max(longest, 0.5 * layout.grid.cell_size) * (1.0 + ROUNDING)
    octant, tiled, repeating = tiles.octant, tiles.triangle, tiles.count
    rest = np.flatnonzero(octant < 0)
    own, more = _halve(places[rest], _triangles(layout, places[rest]))
    octant[rest], count = own + repeating, repeating + more
    bounds = _bounds(low, high, octant, count)
    fine = _split(boundary, longest, *bounds, len(tiled))
    touch = _touching(low, high, fine, NEAR * edge, monitor.backend)
    return Groups(
        lattice, fine, places, low, high, octant,
        _owners(touch, octant, count, len(fine.triangles), tiled, repeating), touch, count,
        precision, np.arange(count) < repeating,
    )  # fmt: skip


def _flat_wall(lattice: PlacedLattice, boundary: TriangleMesh) -> FlatWall | None:
    """The wall with squares on its flat faces; None where there are none along the octants."""
    grid = lattice.layout.grid
    if lattice.points is not None or lattice.motion.frame is not None or any(grid.periodic):
        return None
    half = 0.5 * grid.cell_size
    return with_squares(boundary, lattice.motion(grid.origin - half), half)


def _edge(low: Floats, high: Floats) -> float:
    """The size of most octants' boxes, mm."""
    return float(np.median((high - low).max(axis=1)))


def _triangles(layout: Layout, places: Ints) -> Ints:
    """(k,) how many triangles octants have."""
    each = np.array([len(layout.octants[key].triangles) for key in layout.grid.keys])
    result: Ints = each[layout.grid.kind[tuple(places.T)]]
    return result


def _halve(places: Ints, weight: Ints) -> tuple[Ints, int]:
    """The group of each octant, by halves along the longest side, and how many there are."""
    group = np.zeros(len(places), np.int64)
    count, waiting = 0, [np.arange(len(places))] if len(places) else []
    while waiting:
        rows = waiting.pop()
        axis = int(np.ptp(places[rows], axis=0).argmax())
        along = places[rows, axis]
        order = np.argsort(along, kind="stable")
        total = np.cumsum(weight[rows[order]])
        middle = along[order[np.searchsorted(total, total[-1] / 2)]]
        first = along < max(middle, int(along.min()) + 1)
        if total[-1] <= GROUP_TRIANGLES or first.all():
            group[rows] = count
            count += 1
        else:
            waiting += [rows[~first], rows[first]]
    return group, count


def _bounds(low: Floats, high: Floats, group: Ints, count: int) -> tuple[Floats, Floats]:
    """(count, 3) corners of the boxes about groups of boxes."""
    least, most = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(least, group, low)
    np.maximum.at(most, group, high)
    return least, most


def _split(
    mesh: TriangleMesh, longest: float, low: Floats, high: Floats, squares: int = 0
) -> TriangleMesh:
    """The same surface, of small triangles where it reaches into more than one box.

    Args:
        mesh: of any triangles.
        longest: side of those, mm.
        low: (k, 3) lowest corners of the boxes, mm.
        high: (k, 3) highest ones, mm.
        squares: so many of the first triangles are halves of squares, no longer than that, and
            stay.
    """
    points, triangles = mesh.vertices, mesh.triangles.astype(np.int64)
    some, others = np.arange(squares, len(triangles)), np.zeros(0, np.int64)
    while True:
        # Axis by axis, which numpy takes in faster than rows of three.
        corners = [[points[triangles[some, k], axis] for k in range(3)] for axis in range(3)]
        squared = [[(a - b) ** 2 for a, b in zip(c, c[1:] + c[:1], strict=True)] for c in corners]
        sides = np.stack([x + y + z for x, y, z in zip(*squared, strict=True)], axis=1)
        is_long = (sides > longest**2).any(axis=1)
        some, sides = some[is_long], sides[is_long]
        spans = [
            (np.minimum(np.minimum(a, b), c)[is_long], np.maximum(np.maximum(a, b), c)[is_long])
            for a, b, c in corners
        ]
        met = np.zeros(len(some), np.int64)
        for least, most in zip(low, high, strict=True):
            inside = np.ones(len(some), bool)
            for (first, last), begin, end in zip(spans, least, most, strict=True):
                inside &= (first <= end) & (last >= begin)
            met += inside
        rows = some[met > 1]
        if not len(rows):
            return TriangleMesh(points, triangles.astype(np.int32))
        at = sides[met > 1].argmax(axis=1)
        ends = np.stack([triangles[rows, at], triangles[rows, (at + 1) % 3]], axis=1)
        count, before = len(points), len(triangles)
        wanted = partial(
            among_edges, keys=np.unique(edge_keys(ends[:, 0], ends[:, 1], count)), count=count
        )
        # Those beyond these sides have a long one, too: no others change.
        long = np.sort(np.concatenate([others, some]))
        beside = corners_among(vertices_of(ends, count), triangles[long]) > 1
        others, some = long[~beside], long[beside]
        points, triangles = remesh.split(points, triangles, wanted, some)
        some = np.concatenate([some, np.arange(before, len(triangles))])


def _touching(
    low: Floats, high: Floats, boundary: TriangleMesh, near: float, backend: ParallelBackend
) -> Ints:
    """(t, 2) boxes and triangles that touch, by their boxes and by the triangles' planes."""
    count = len(boundary.triangles)
    with backend.sharing(low, high, boundary.vertices, boundary.triangles) as shared:
        calls = ((*shared, start, near) for start in range(0, count, CALL_TRIANGLES))
        pairs = np.sort(np.concatenate(list(backend.starmap(_touched_by, calls))))
    return np.stack(np.divmod(pairs, count), axis=1)


def _touched_by(
    low_of: SharedArray,
    high_of: SharedArray,
    vertices: SharedArray,
    triangles: SharedArray,
    start: int,
    near: float,
) -> Ints:
    """As `_touching`, of so many triangles: each pair in one number."""
    low, high = low_of.array, high_of.array
    some = triangles.array[start : start + CALL_TRIANGLES]
    corners = corners_at(vertices.array, some)
    first, last = triangle_boxes(vertices.array.T, some.T)
    a, b = meeting_boxes(low, high, first.T - near, last.T + near, float((high - low).max()))
    # Axis by axis, which numpy takes in faster than rows of three.
    normal = np.ascontiguousarray(remesh.normals(corners).T)
    middle, half = 0.5 * (low + high).T, 0.5 * (high - low).T + near
    above, reach = np.zeros((2, len(a)))
    for axis in range(3):
        along = normal[axis].take(b)
        above += (middle[axis].take(a) - corners[:, 0, axis].take(b)) * along
        reach += half[axis].take(a) * np.abs(along)
    meets = np.abs(above) <= reach
    found: Ints = a[meets] * np.int64(len(triangles.array)) + b[meets] + start
    return found


def _owners(
    touch: Ints, octant: Ints, count: int, triangles: int, tiled: Ints, repeating: int
) -> Ints:
    """(m,) the group that most of the octants about each triangle belong to; -1 for none.

    Args:
        touch: (t, 2) octants and triangles that touch.
        octant: (k,) the group of each.
        count: of groups.
        triangles: how many there are.
        tiled: groups of the first triangles that are known, -1 for others.
        repeating: so many of the first groups have their own triangles only, if others can.
    """
    owner = np.full(triangles, -1, np.int64)
    pair, often = np.unique(touch[:, 1] * count + octant[touch[:, 0]], return_counts=True)
    triangle, group = np.divmod(pair, count)
    order = np.lexsort((often, group >= repeating))
    owner[triangle[order]] = group[order]
    known = np.flatnonzero(tiled >= 0)
    owner[known] = tiled[known]
    return owner


def _halves(boxes: Floats, rows: Ints) -> tuple[Ints, Ints]:
    """Rows of (k, 2, 3) boxes in two halves, along the longest side."""
    middle = boxes[rows].mean(axis=1)
    order = np.argsort(middle[:, np.ptp(middle, axis=0).argmax()], kind="stable")
    half = len(rows) // 2
    return rows[order[half:]], rows[order[:half]]


def _solids_near(
    boundary: TriangleMesh, boxes: Floats, owned: list[Ints], monitor: Monitor
) -> Iterator[tuple[int, TriangleMesh, Bools]]:
    """The solid within the wall, cut to (k, 2, 3) boxes, and which triangles are those owned.

    Each with its row, in any order.
    """
    library = manifold_library("Cutting a lattice at a skin")
    own_id = library.Manifold.reserve_ids(1)
    source = to_library(
        boundary,
        run_index=np.array([0, 3 * len(boundary.triangles)], np.uint64),
        run_original_id=np.array([own_id], np.uint32),
        face_id=np.arange(len(boundary.triangles), dtype=np.uint64),
    )
    whole = monitor.call(lambda: library.Manifold(source))
    if whole.status() != library.Error.NoError:
        raise VolfrepError(
            f"The domain's surface cannot be cut ({whole.status().name}): repair the part's mesh."
        )
    # Halves of what is left of the wall, so that each cut is of a small mesh.
    waiting = [(whole, np.arange(len(boxes)))]
    while waiting:
        solid, rows = waiting.pop()
        low, high = boxes[rows, 0].min(axis=0), boxes[rows, 1].max(axis=0)
        block = library.Manifold.cube(tuple(high - low)).translate(tuple(low))
        solid = solid ^ block
        if len(rows) > 1:
            waiting += [(solid, half) for half in _halves(boxes, rows)]
            continue
        result = solid.to_mesh64()
        origin = np.repeat(
            np.asarray(result.run_original_id).astype(np.int64),
            np.diff(np.asarray(result.run_index).astype(np.int64) // 3),
        )
        face = np.asarray(result.face_id).astype(np.int64)
        mine = (origin == own_id) & np.isin(face, owned[rows[0]])
        monitor.tick()
        yield int(rows[0]), from_library(result), mine
