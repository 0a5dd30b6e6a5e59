# SPDX-License-Identifier: LGPL-2.1-or-later
"""The skin as shells in the middle of its thickness, and the struts that end in it.

Supports and loads are on the outside, and so are the shells' nodes: from each a rigid arm leads to
the middle, as a shell's normal is rigid. Walls that end at a face that is held reach to it: there
the middle is taken to lie on the outside.

Under what is round, such as a slender bar, the inner side of a skin is smaller than its outside:
there the shells lie at the centroid of what is below them, with as much of it.

Where the part is thinner than two skins it is solid: there the shells of both sides have half of
its thickness each, and the material between them holds them together.

Shells and not solids: a layer of solid elements thin enough to bend would have ten times the
unknowns of all struts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import csr_matrix
from scipy.spatial import cKDTree

from ..design.openings import lie_on
from ..fem.wedge_mesh import barycentric, corner_angles, vertex_planes
from ..mesh import remesh
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.medial_balls import wall_thickness
from ..spatial.proximity import closest_points
from ..spatial.rays import segment_crossings
from ..util.linalg import cross_matrix, normalize
from ..util.peaks import most_but_peaks
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .shell_elements import Shells, UnitBlocks, shells_of, worse_side
from .skin_mesh import SHARP, even_surface
from .structure import Blocks, MultiPointConstraints
from .tapered_beams import Elastic

#: A corner of the middle surface lies no farther from the outside's than this many times the depth.
_FARTHEST = 2.0
#: Where a line inwards meets the other side nearer than so many thicknesses, the part is solid.
_SOLID = 2.02
#: What walls have in common counts as rigid by this share, and takes no more than so much of a
#: triangle's inscribed circle. (Hollow boxes of solid bricks say so.)
_COMMON, _RIGID_CORNER = 0.5, 0.8
#: The centroid of what lies below a vertex is so deep, of its thickness: of a cone, of a plane.
_CENTROID = 0.25, 0.5
#: The mean area is so many times as large as that there: as a cone's, and as about a narrow hole.
_FILLED = 0.55, 1.2
#: Walls meet at an angle where a triangle is tilted by more against the surface about its corner.
_SHARP_TILT = np.cos(np.radians(20.0))
#: By so much of their spread about a triangle is a slope of the stress held back.
_NO_SLOPE = 1e-3


@dataclass(frozen=True, eq=False)
class Feet:
    """Where struts meet the skin.

    Attributes:
        places: (k, 3) on the skin, mm.
        radii: (k,) so far about each the skin is stiff, mm.
    """

    places: Floats
    radii: Floats


NO_FEET = Feet(np.empty((0, 3)), np.empty(0))


@dataclass(frozen=True, eq=False)
class Joined:
    """Vertices of the skin that are connected with the skin on the other side.

    Attributes:
        vertices: (j,) of them.
        beyond: (j, 3) the vertices of the triangle there.
        shares: (j, 3) of these in the nearest place.
    """

    vertices: Ints
    beyond: Ints
    shares: Floats


NO_PIECES = np.empty((0, 2), np.int64)
NOT_JOINED = Joined(np.empty(0, np.int64), np.empty((0, 3), np.int64), np.empty((0, 3)))
NOTHING_BETWEEN = Blocks(*np.empty((2, 0), np.int64), *np.empty((2, 0, 6, 6)))


@dataclass(frozen=True, eq=False)
class SkinModel:
    """A skin's shells.

    Attributes:
        outside: the part's surface in even triangles, mm; a row of its vertices is a node, whose
            displacements are those of the outside.
        middle: (n, 3) where the shells' corners are, mm: in the middle of the skin, on the outside
            of what is held.
        inside: (n, 3) the vertices on the other side of the skin, mm.
        shells: triangles between them, those of open faces left out.
        used: (t,) bool, which triangles of `outside` have a shell.
        blocks: stiffness and mass, of shells and of what is solid between them.
        pads: (n,) mm, so far about a vertex that struts meet the skin is stiff; 0 elsewhere.
        joined: what hangs together where the part is solid.
        solid_share: of the shells' area, where the part is thinner than two skins.
        thickness_below: (n,) mm, how thick the part is below each vertex, as far as that
            was looked at.
        between: stiffness of what is solid between shells, which `blocks` has, too.
        stress_ratio: (t,) how many times as stressed as they say the shells are; None for once.
    """

    outside: TriangleMesh
    middle: Floats
    inside: Floats
    shells: Shells
    used: Bools
    blocks: Blocks
    pads: Floats
    joined: Joined
    solid_share: float
    thickness_below: Floats
    between: Blocks
    stress_ratio: Floats | None = None

    def unit_blocks(self) -> UnitBlocks:
        """The shells' blocks for a thickness of 1 mm, between the nodes outside."""
        units, arms = self.shells.unit_blocks(), _arms(self.outside.vertices, self.middle)
        rows, columns = arms[units.rows].swapaxes(1, 2), arms[units.columns]
        return replace(
            units,
            flat=rows @ units.flat @ columns, bent=rows @ units.bent @ columns,
            heavy=rows @ units.heavy @ columns, turning=rows @ units.turning @ columns,
        )  # fmt: skip

    def stresses(self, displacements: Floats, thickness: Floats | None = None) -> Floats:
        """(t, k) the larger von Mises stress of both sides, MPa, of the nodes' (n, 6, k).

        A triangle's own scatters: it has what fits it and those that touch it in its face best, a
        stress that is linear there (O. C. Zienkiewicz, J. Z. Zhu, "The superconvergent patch
        recovery", Int. J. Num. Meth. Eng. 33, 1992).

        Args:
            displacements: mm and radians.
            thickness: (t,) another one, mm; None for the shells' own.
        """
        flat, curved, fit = self._stress_of
        thick = self.shells.thickness if thickness is None else thickness
        moved = displacements.reshape(6 * len(displacements), -1)
        even, bent = flat @ moved, fit @ (np.repeat(thick, 3)[:, None] * (curved @ moved))
        shape = (len(thick), 3, moved.shape[1])
        stress = worse_side(even.reshape(shape), bent.reshape(shape))
        return stress if self.stress_ratio is None else stress * self.stress_ratio[:, None]

    @cached_property
    def _stress_of(self) -> tuple[csr_matrix, csr_matrix, csr_matrix]:
        """Stress of the nodes' displacements as matrices, rows xx, yy and xy of each triangle.

        Returns:
            (3 t, 6 n) in the plane, fitted; (3 t, 6 n) of bending, of 1 mm; and (3 t, 3 t) what
            fits the latter.
        """
        triangles, count = self.shells.triangles, len(self.middle)
        arms = _arms(self.outside.vertices, self.middle)[triangles]
        columns = (6 * triangles[:, :, None] + np.arange(6)).reshape(-1, 1, 18)
        rows = (3 * np.arange(len(triangles))[:, None] + np.arange(3))[:, :, None]
        rows, columns = (np.broadcast_to(one, (len(triangles), 3, 18)) for one in (rows, columns))
        found = []
        for block in self.shells.stress_blocks():
            led = np.einsum("tsci,tcij->tscj", block.reshape(-1, 3, 3, 6), arms, optimize=True)
            entries = led.ravel(), (rows.ravel(), columns.ravel())
            found.append(csr_matrix(entries, (3 * len(triangles), 6 * count)))
        near = self._patches.tocoo()
        across = self.shells.axes[:, :2]
        # How two axes of a triangle lie in those of another one: a tensor turns by it twice.
        turn = np.einsum("kai,kbi->kab", across[near.row], across[near.col])
        one, two, both = ((0, 0), (1, 1), (0, 1))
        blocks = np.empty((len(near.data), 3, 3))
        for row, (i, j) in enumerate((one, two, both)):
            blocks[:, row, 0] = turn[:, i, 0] * turn[:, j, 0]
            blocks[:, row, 1] = turn[:, i, 1] * turn[:, j, 1]
            blocks[:, row, 2] = turn[:, i, 0] * turn[:, j, 1] + turn[:, i, 1] * turn[:, j, 0]
        blocks *= near.data[:, None, None]
        three = np.arange(3)
        to = np.broadcast_to(3 * near.row[:, None, None] + three[:, None], blocks.shape)
        of = np.broadcast_to(3 * near.col[:, None, None] + three, blocks.shape)
        size = 3 * len(triangles)
        fit = csr_matrix((blocks.ravel(), (to.ravel(), of.ravel())), (size, size))
        return csr_matrix(fit @ found[0]), found[1], fit

    def peaks(self, displacements: Floats) -> list[float]:
        """MPa in each case, on all but a little of the area, of the nodes' (n, 6, k)."""
        return [most_but_peaks(row, self.shells.area) for row in self.stresses(displacements).T]

    @cached_property
    def centres(self) -> Floats:
        """(t, 3) mm, of the shells."""
        return np.asarray(self.middle[self.shells.triangles].mean(axis=1))

    def pressed(self, displacements: Floats, shells: Shells | None = None) -> Floats:
        """(c, 6, 6) what the stress in the shells' plane adds to `blocks`, of the nodes' (n, 6)."""
        arms, nodes = _arms(self.outside.vertices, self.middle), self.shells.triangles
        added = (shells or self.shells).pressed(arms @ displacements[:, :, None])
        rows, columns = np.repeat(nodes, 3, axis=1).ravel(), np.tile(nodes, (1, 3)).ravel()
        return np.asarray(arms[rows].swapaxes(1, 2) @ added @ arms[columns])

    @cached_property
    def _patches(self) -> csr_matrix:
        """(t, t) what makes of triangles' own values those of the linear fit in their middles."""
        triangles, area, axes = self.shells.triangles, self.shells.area, self.shells.axes
        count = len(triangles)
        every = np.repeat(np.arange(count), 3)
        shape = (count, len(self.middle))
        at = csr_matrix((np.ones(3 * count), (every, triangles.ravel())), shape)
        touch = (at @ at.T).tocoo()
        row, column = touch.row, touch.col
        turn = np.einsum("ij,ij->i", axes[row, 2], axes[column, 2])
        same = turn > np.cos(np.radians(SHARP))
        row, column = row[same], column[same]
        between = self.centres[column] - self.centres[row]
        away = np.einsum("kij,kj->ki", axes[row, :2], between)
        terms = np.column_stack([np.ones(len(row)), away])
        weight = area[column]
        normal = np.empty((count, 3, 3))
        for one, two in np.ndindex(3, 3):
            normal[:, one, two] = np.bincount(row, weight * terms[:, one] * terms[:, two], count)
        # Of those that lie in a row, or alone, no slope across is known: it is none.
        slope = _NO_SLOPE * (normal[:, 1, 1] + normal[:, 2, 2] + area * area)
        normal[:, 1, 1] += slope
        normal[:, 2, 2] += slope
        share = weight * np.einsum("ki,ki->k", np.linalg.inv(normal)[row, 0], terms)
        return csr_matrix((share, (row, column)), (count, count))

    def of_middle(self, displacements: Floats) -> Floats:
        """(n, 6, k) how the shells' corners move, of the nodes' displacements (n, 6, k)."""
        led: Floats = _arms(self.outside.vertices, self.middle) @ displacements
        return led

    def to_outside(self, loads: Floats) -> Floats:
        """(n, 6) loads on the nodes, of those on the shells' corners (n, 6)."""
        arms = _arms(self.outside.vertices, self.middle)
        return np.asarray(np.einsum("nij,ni->nj", arms, loads))

    def pad_of(self, nodes: Floats) -> Ints:
        """(k,) the vertex whose pad struts' ends at (k, 3) stand on."""
        padded = np.flatnonzero(self.pads > 0.0)
        if not len(padded):
            return np.zeros(len(nodes), np.int64)
        return np.asarray(padded[cKDTree(self.middle[padded]).query(nodes)[1]])


def skin_model(
    solid: TriangleMesh,
    thickness: float | Callable[[Floats], Floats],
    edge: float,
    material: Elastic,
    openings: TriangleMesh | None = None,
    feet: Feet = NO_FEET,
    monitor: Monitor | None = None,
    *,
    fixed: Bools | None = None,
    thickest: float | None = None,
    outside: TriangleMesh | None = None,
) -> SkinModel:
    """The skin of a part as shells.

    Args:
        solid: the part, closed, mm.
        thickness: of the skin, mm, or at (n, 3) points of the surface.
        edge: how long the triangles' edges are to be, mm.
        material: of the skin.
        openings: the faces that have none.
        feet: where struts meet it.
        monitor: asked for a cancel.
        fixed: (m,) which of the part's triangles no load case moves; None for none.
        thickest: mm, up to which the skin may become thicker; None where it does not.
        outside: of `skin_mesh.even_surface` for the same part, edge and feet; None to make it.
    """
    if outside is None:
        outside = even_surface(solid, edge, monitor, feet.places)
    triangles = outside.triangles.astype(np.int64)
    corners = outside.vertices[triangles]
    normal = remesh.normals(corners)
    doubled = np.linalg.norm(normal, axis=1)
    normal /= np.maximum(doubled, 1e-300)[:, None]
    used = doubled > 1e-9 * doubled.max()
    if openings is not None:
        used &= ~lie_on(openings, corners.mean(axis=1), 0.02 * edge)
    wanted = (
        thickness(outside.vertices)
        if callable(thickness)
        else np.full(len(outside.vertices), thickness)
    )
    far = max(float(wanted.max()), thickest or 0.0)
    thickness_below = _thickness_below(outside, triangles, normal, doubled, _SOLID * far)
    # A body is filled where its sides meet, and no further than the skin is thick from there.
    bulky = (wanted > edge) & (wanted > 0.5 * thickness_below)
    if bulky.any():
        meets = cKDTree(outside.vertices[bulky]).query(outside.vertices)[0]
        bulky = (wanted > edge) & (meets <= wanted)
        thickness_below = np.where(
            bulky,
            np.minimum(thickness_below, _share_of_body(solid, outside, bulky, doubled)),
            thickness_below,
        )
    # Each side has its half of what is solid.
    local = np.minimum(wanted, 0.5 * thickness_below)
    kept = triangles[used]
    walls = kept, normal[used], corner_angles(corners[used])
    inside = 2.0 * _inwards(outside.vertices, *walls, 0.5 * local) - outside.vertices
    # Where the surface turns sharply a wall's end is upright, and `_clear` tells what is common.
    upright = corners[used] - local[kept][:, :, None] * normal[used][:, None, :]
    is_sharp = _turned(outside.vertices, *walls)[:, :, None]
    share, filled = _centroid(corners[used], np.where(is_sharp, upright, inside[kept]), kept)
    depth = local * np.append(share, np.full(len(local) - len(share), 0.5))
    middle = _inwards(outside.vertices, *walls, depth)
    if fixed is not None and fixed.any():
        stays = fixed[closest_points(solid, corners[used].mean(axis=1))[2]]
        middle = _inwards(outside.vertices, *walls, depth, stays)
    clear = _clear(outside.vertices, middle, kept, normal[used], local)
    pads = np.zeros(len(middle))
    if len(feet.radii):
        own = cKDTree(outside.vertices[np.unique(kept)])
        near = np.unique(kept)[own.query(closest_points(outside, feet.places)[0])[1]]
        np.maximum.at(pads, near, feet.radii)
    thick = local[kept].mean(axis=1)
    shells = shells_of(middle, kept, thick, material, clear=clear, pads=pads, filled=filled)
    blocks, joined, between = shells.blocks(), NOT_JOINED, NOTHING_BETWEEN
    solid_nodes = np.flatnonzero(thickness_below < _SOLID * wanted)
    if len(solid_nodes) and len(kept):
        shares = np.repeat(shells.area / 3.0, 3)
        area = np.bincount(kept.ravel(), shares, len(middle)).astype(np.float64)
        between, joined = _joined_shells(
            middle, kept, solid_nodes, thickness_below - 2.0 * depth, area, material
        )
        blocks = Blocks(
            np.concatenate([blocks.rows, between.rows]),
            np.concatenate([blocks.columns, between.columns]),
            np.concatenate([blocks.stiffness, between.stiffness]),
            np.concatenate([blocks.mass, between.mass]),
        )
    arms = _arms(outside.vertices, middle)
    rows, columns = arms[blocks.rows].swapaxes(1, 2), arms[blocks.columns]
    blocks = replace(
        blocks, stiffness=rows @ blocks.stiffness @ columns, mass=rows @ blocks.mass @ columns
    )
    if len(between.rows):
        last = len(blocks.rows) - len(between.rows)
        between = replace(between, stiffness=blocks.stiffness[last:])
    is_solid = (thickness_below < _SOLID * wanted)[kept].all(axis=1)
    solid_share = float(shells.area[is_solid].sum() / max(float(shells.area.sum()), 1e-300))
    return SkinModel(
        outside,
        middle,
        inside,
        shells,
        used,
        blocks,
        pads,
        joined,
        solid_share,
        thickness_below,
        between,
    )


def constraints_to(
    skin: SkinModel, nodes: Floats, rows: Ints, offset: int, pieces: Ints = NO_PIECES
) -> MultiPointConstraints:
    """Struts' ends that move as the pad does on which they stand.

    A piece between two walls that lies within a pad, as in the corner of a cavity, is one body with
    the walls: both its ends move as that pad does.

    Args:
        skin: the shells.
        nodes: (k, 3) places of the struts' ends, mm.
        rows: (k,) their rows among the structure's nodes.
        offset: the row of the skin's first node among them.
        pieces: (m, 2) which of them are the two ends of one piece of a strut.
    """
    triangles = skin.shells.triangles
    surface = TriangleMesh(skin.middle, triangles.astype(np.int32))
    foot, _, triangle = closest_points(surface, nodes)
    leaders, shares = triangles[triangle], barycentric(skin.middle[triangles[triangle]], foot)
    vertex = skin.pad_of(nodes)
    stands = np.linalg.norm(foot - skin.middle[vertex], axis=1) < skin.pads[vertex]
    one, two = pieces.T
    short = np.linalg.norm(nodes[one] - nodes[two], axis=1) < 2.0 * skin.pads[vertex[one]]
    stands[pieces[short & (vertex[one] == vertex[two])]] = True
    leaders[stands], shares[stands] = vertex[stands, None], (1.0, 0.0, 0.0)
    foot[stands] = skin.middle[vertex[stands]]
    arm = cross_matrix(nodes - foot)
    blocks = np.zeros((len(nodes), 3, 6, 6))
    for corner in range(3):
        share = shares[:, corner, None, None]
        blocks[:, corner, :3, :3] = blocks[:, corner, 3:, 3:] = share * np.eye(3)
        blocks[:, corner, :3, 3:] = -share * arm
    return MultiPointConstraints(
        rows, leaders + offset, blocks @ _arms(skin.outside.vertices, skin.middle)[leaders]
    )


def _arms(outside: Floats, middle: Floats) -> Floats:
    """(n, 6, 6) what a displacement and a turn of the outside are in the middle."""
    result = np.zeros((len(outside), 6, 6))
    result[:] = np.eye(6)
    result[:, :3, 3:] = -cross_matrix(middle - outside)
    return result


def _thickness_below(
    mesh: TriangleMesh, triangles: Ints, normal: Floats, weight: Floats, far: float
) -> Floats:
    """(n,) how thick the part is below each vertex, mm; `far` where it is thicker."""
    mean = np.zeros_like(mesh.vertices)
    for corner in range(3):
        np.add.at(mean, triangles[:, corner], normal * weight[:, None])
    mean /= np.maximum(np.linalg.norm(mean, axis=1), 1e-300)[:, None]
    start = mesh.vertices - 1e-3 * far * mean
    segment, place, way = segment_crossings(mesh, start, mesh.vertices - far * mean)
    result = np.full(len(mesh.vertices), far)
    leaves = way > 0
    np.minimum.at(result, segment[leaves], far * (1e-3 + 0.999 * place[leaves]))
    # A vertex on the rim of a thin plate looks along the plate: it is as thick as about it.
    near = csr_matrix(
        (np.ones(6 * len(triangles)), (
            triangles[:, [0, 1, 1, 2, 2, 0]].ravel(), triangles[:, [1, 0, 2, 1, 0, 2]].ravel()
        )), shape=(len(result),) * 2,
    )  # fmt: skip
    near.data[:] = 1.0
    known = (result < far).astype(float)
    number = np.asarray(near @ known).ravel()
    about = np.asarray(near @ (result * known)).ravel() / np.maximum(number, 1.0)
    rim = (result >= far) & (number > 0.0)
    return np.maximum(np.where(rim, about, result), 0.02 * far)


def _share_of_body(
    solid: TriangleMesh, outside: TriangleMesh, bulky: Bools, weight: Floats
) -> Floats:
    """(n,) twice how deep what lies nearest to each vertex reaches, mm; inf where not asked for.

    A body that is filled has sides all about: each has what lies nearest to it, so that they have
    the body's volume together.
    """
    result = np.full(len(bulky), np.inf)
    asked = bulky[outside.triangles].any(axis=1)
    corners = outside.triangles[asked]
    deep = wall_thickness(solid, outside.vertices[corners].mean(axis=1))
    share = np.repeat(weight[asked], 3)
    total = np.bincount(corners.ravel(), share * np.repeat(deep, 3), len(bulky))
    number = np.bincount(corners.ravel(), share, len(bulky))
    result[bulky] = (total / np.maximum(number, 1e-300))[bulky]
    return result


def _inwards(
    vertices: Floats,
    triangles: Ints,
    normal: Floats,
    weight: Floats,
    depth: Floats,
    stays: Bools | None = None,
) -> Floats:
    """Vertices moved so that the planes of their triangles lie deeper by (n,) `depth`.

    Planes of triangles that stay (t,) lie no deeper.
    """
    right = np.zeros_like(vertices)
    moves = weight if stays is None else np.where(stays[:, None], 0.0, weight)
    for corner in range(3):
        np.add.at(right, triangles[:, corner], normal * moves[:, corner, None])
    values, axes, known = vertex_planes(vertices, triangles, normal, weight)
    along = np.einsum("nji,nj->ni", axes, right)
    step = np.where(known, along / np.where(known, values, 1.0), 0.0)
    move = -depth[:, None] * np.einsum("nij,nj->ni", axes, step)
    size = np.linalg.norm(move, axis=1)
    limit = np.minimum(1.0, _FARTHEST * depth / np.maximum(size, 1e-300))
    return np.asarray(vertices + move * limit[:, None])


def _turned(outside: Floats, triangles: Ints, normal: Floats, weight: Floats) -> Bools:
    """(t, 3) at which corners of triangles the surface turns sharply."""
    mean = np.zeros_like(outside)
    for corner in range(3):
        np.add.at(mean, triangles[:, corner], normal * weight[:, corner, None])
    tilt = np.einsum("tci,ti->tc", normalize(mean)[triangles], normal)
    return np.asarray(tilt < _SHARP_TILT)


def _centroid(outside: Floats, inside: Floats, triangles: Ints) -> tuple[Floats, Floats]:
    """How deep the centroid is of what lies between two surfaces, (t, 3, 3) triangles each.

    Half-way under a plane; less where the inner side is smaller, as of round bars: a third in a
    solid one. Areas at three depths say all of what lies between, as they are quadratic.

    Args:
        outside: mm.
        inside: mm, where each of their corners is on the other side.
        triangles: (t, 3) their vertices.

    Returns:
        (k,) parts of the thickness, about each vertex up to the last that triangles have; and (t,)
        how many times as large as the area at that depth the mean area is.
    """
    normal = remesh.unit_normals(outside)

    def area(depth: Floats) -> Floats:
        places = outside + depth[:, :, None] * (inside - outside)
        seen = 0.5 * np.einsum("ti,ti->t", remesh.normals(places), normal)
        return np.asarray(np.maximum(seen, 1e-9))

    outer, half, inner = (area(np.full(triangles.shape, depth)) for depth in (0.0, 0.5, 1.0))
    whole, moment = outer + 4.0 * half + inner, 2.0 * half + inner
    size = 1 + int(triangles.max(initial=0))
    total, first = (
        np.bincount(triangles.ravel(), np.repeat(each, 3), size) for each in (whole, moment)
    )
    known = total > 0.0
    share = np.where(known, np.clip(first / np.where(known, total, 1.0), *_CENTROID), 0.5)
    filled = np.clip(whole / 6.0 / area(share[triangles]), *_FILLED)
    # Under planes both are what they are, whatever the last bits of areas say.
    return np.asarray(np.round(share, 9)), np.asarray(np.round(filled, 9), np.float64)


def _clear(
    outside: Floats, middle: Floats, triangles: Ints, normal: Floats, depth: Floats
) -> Floats:
    """(t, 3, 3) where the corners of triangles begin to bend, mm.

    Where walls meet at an angle, what they have in common is as good as rigid: they bend from
    where each leaves the other.
    """
    half = 0.5 * depth[triangles][:, :, None] * normal[:, None, :]
    corner = middle[triangles]
    way = _COMMON * np.asarray(corner - outside[triangles] + half, np.float64)
    # In the triangle's plane; at an edge that turns inwards the wall leaves it the other way.
    plane = remesh.unit_normals(corner)
    way -= np.einsum("tci,ti->tc", way, plane)[:, :, None] * plane[:, None, :]
    inwards = corner.mean(axis=1)[:, None] - corner
    way *= np.where(np.einsum("tci,tci->tc", way, inwards) < 0.0, -1.0, 1.0)[:, :, None]
    # No farther than the inscribed circle, so that no triangle is turned over.
    around = np.linalg.norm(corner - np.roll(corner, 1, axis=1), axis=2).sum(axis=1)
    circle = np.linalg.norm(remesh.normals(corner), axis=1)
    circle /= np.maximum(around, 1e-300)
    size = np.maximum(np.linalg.norm(way, axis=2), 1e-300)
    way *= np.minimum(1.0, _RIGID_CORNER * circle[:, None] / size)[:, :, None]
    return np.asarray(corner + way)


def _joined_shells(
    middle: Floats,
    triangles: Ints,
    nodes: Ints,
    gap: Floats,
    area: Floats,
    material: Elastic,
) -> tuple[Blocks, Joined]:
    """The material between two shells as springs from each node to the shell beyond.

    Half of it at each side: E A / d against being pulled apart and G A / d against sliding, with
    the gap d between the shells. Both are carried to the point half-way, so that bending of the two
    together is that of one plate.
    """
    mean = np.zeros_like(middle)
    corners = middle[triangles]
    way = remesh.normals(corners)
    for corner in range(3):
        np.add.at(mean, triangles[:, corner], way)
    mean /= np.maximum(np.linalg.norm(mean, axis=1), 1e-300)[:, None]
    surface = TriangleMesh(middle, triangles.astype(np.int32))
    start, gap = middle[nodes], gap[nodes]
    foot, away, triangle = closest_points(surface, start - gap[:, None] * mean[nodes])
    beyond = triangles[triangle]
    faces = np.einsum("ij,ij->i", way[triangle], mean[nodes]) < 0.0
    own = (beyond == nodes[:, None]).any(axis=1)
    good = faces & ~own & (away < gap) & (area[nodes] > 0)
    nodes, foot, beyond, gap = nodes[good], foot[good], beyond[good], gap[good]
    shares = barycentric(middle[beyond], foot)
    half = 0.5 * (middle[nodes] + foot)
    follow = np.zeros((len(nodes), 4, 3, 6))
    follow[:, 0, :, :3] = np.eye(3)
    follow[:, 0, :, 3:] = -cross_matrix(half - middle[nodes])
    arm = cross_matrix(half - foot)
    for corner in range(3):
        share = shares[:, corner, None, None]
        follow[:, corner + 1, :, :3] = -share * np.eye(3)
        follow[:, corner + 1, :, 3:] = share * arm
    along = mean[nodes][:, :, None] * mean[nodes][:, None, :]
    stiff = 0.5 * (area[nodes] / gap)[:, None, None]
    spring = stiff * (material.young * along + material.shear * (np.eye(3) - along))
    rows = np.concatenate([nodes[:, None], beyond], axis=1)
    blocks = np.einsum("nami,nmp,nbpj->nabij", follow, spring, follow, optimize=True)
    between = Blocks(
        np.repeat(rows, 4, axis=1).ravel(),
        np.tile(rows, (1, 4)).ravel(),
        blocks.reshape(-1, 6, 6),
        np.zeros((blocks.shape[0] * 16, 6, 6)),
    )
    return between, Joined(nodes, beyond, shares)
