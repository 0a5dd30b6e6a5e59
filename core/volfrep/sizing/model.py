# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part with its lattice as a structure that can be sized: struts cut at the wall, skin, loads."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from scipy.sparse import block_diag, csr_matrix, identity
from scipy.spatial import cKDTree

from ..design.cells import UnitCell
from ..fem.beam_mesh import ends_law
from ..fem.model import Case
from ..grid.strut_graph import Graph, Wireframe
from ..loads.load_cases import Force, LoadCase, Mass
from ..loads.nodal_loads import ROUNDING, Body, nodal_case, share_of
from ..loads.regions import AnyOf, Region, simple_regions
from ..mechanics.frame import SQUARE_SECTION
from ..mechanics.materials import SolidMaterial
from ..mesh import remesh
from ..mesh.topology import pieces_of
from ..mesh.triangle_mesh import TriangleMesh
from ..spatial.proximity import closest_points
from ..trim.clip_struts import Clipped
from ..util.errors import VolfrepError
from ..util.types import Bools, Floats, Ints
from .analysis import Problem
from .node_radii import ComesOut, NodeRadii, largest_radii
from .skin import NO_FEET, Feet, SkinModel, constraints_to
from .skin_thickness import SkinThickness, control_points, shares_of, with_skin
from .structure import NO_CONSTRAINTS, Structure
from .symmetry import Mirrors
from .tapered_beams import Elastic, beams_of, end_table
from .union_volume import union_volume

#: Struts that graze the skin are not longer in it than at this cosine to its normal.
_STEEPEST = 0.3
#: A star of sections reaches farther than a disc of its second moment of area, and so holds the
#: skin: by so much in skinned boxes of second-order tetrahedra.
_STAR = 1.3
#: Images of control points differ by rounding alone, mm.
_IMAGES = 1e-6


@dataclass(frozen=True, eq=False)
class SizingModel:
    """What is sized.

    Attributes:
        problem: to be solved and varied; its radii are those of the whole wireframe's nodes.
        wireframe: of the active cells, whole.
        struts: (m,) which strut of the wireframe each piece is a part of.
        skin: its shells; None for none. Its nodes follow those of the struts' pieces.
        on_boundary: (n,) bool, of the pieces' nodes, those that the skin holds.
        skin_volume: mm3, of the part outside its domain; 0 without a skin.
    """

    problem: Problem
    wireframe: Wireframe
    struts: Ints
    skin: SkinModel | None
    on_boundary: Bools
    skin_volume: float = 0.0

    @property
    def frame_nodes(self) -> int:
        """How many of the structure's nodes are the struts'."""
        return len(self.on_boundary)


def elastic(material: SolidMaterial) -> Elastic:
    """A material for beams and shells: t/mm3 in place of g/cm3."""
    return Elastic(material.young, material.poisson, material.density * 1e-9)


def feet_of(wireframe: Wireframe, clipped: Clipped, domain: TriangleMesh, radii: Floats) -> Feet:
    """Where struts meet the skin, those that would meet beyond it and overlap there as one.

    The skin is as good as rigid where a strut's section meets it. What belongs together is as a
    disc with the same second moment of area, which bends with the skin about it alike.

    Args:
        wireframe: of the active cells, whole, mm.
        clipped: the same struts, cut at the domain's wall.
        domain: its wall.
        radii: (n,) at the nodes of the whole wireframe, mm.
    """
    frame = clipped.wireframe
    struts = frame.struts.astype(np.int64)
    strut, end = np.nonzero(clipped.on_boundary[struts])
    if not len(strut):
        return NO_FEET
    node, share = struts[strut, end], np.where(end == 0, clipped.low[strut], clipped.high[strut])
    whole = wireframe.struts.astype(np.int64)[clipped.owner[strut]]
    meets = np.where(share < 0.5, whole[:, 0], whole[:, 1])
    along = frame.nodes[struts[strut, 1]] - frame.nodes[struts[strut, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    places = frame.nodes[node]
    triangle = closest_points(domain, places)[2]
    normal = remesh.normals(domain.vertices[domain.triangles[triangle]])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    steep = np.maximum(np.abs(np.einsum("ij,ij->i", normal, along)), _STEEPEST)
    reach = (1.0 - share) * radii[whole[:, 0]] + share * radii[whole[:, 1]]
    reach = reach / np.sqrt(steep)
    pairs = cKDTree(places).query_pairs(2.0 * float(reach.max()), output_type="ndarray")
    one, two = pairs.T
    gap = np.linalg.norm(places[one] - places[two], axis=1)
    alike = (meets[one] == meets[two]) & (gap < reach[one] + reach[two])
    count, group = pieces_of(one[alike], two[alike], len(node))
    number = np.bincount(group, minlength=count)
    total = np.stack([np.bincount(group, row, count) for row in places.T], axis=1)
    middle: Floats = total / number[:, None]
    square = ((places - middle[group]) ** 2).sum(axis=1) + 0.5 * reach**2
    radius = np.sqrt(2.0 * np.bincount(group, square, count) / number)
    return Feet(middle, np.where(number > 1.0, _STAR, 1.0) * radius)


def sizing_model(
    wireframe: Wireframe,
    clipped: Clipped,
    cell: UnitCell | None,
    cell_size: float,
    material: SolidMaterial,
    cases: Sequence[LoadCase],
    *,
    bounds: tuple[float, float],
    borne: float = 0.0,
    skin: SkinModel | None = None,
    solid: TriangleMesh | None = None,
    domain: TriangleMesh | None = None,
    stays: Bools | None = None,
    masses: Sequence[Mass] = (),
    comes_out: ComesOut | None = None,
) -> SizingModel:
    """Struts, skin and loads as one structure.

    Args:
        wireframe: of the active cells, whole, mm.
        clipped: the same struts, cut at the domain's wall.
        cell: the unit cell; None for a network.
        cell_size: L, mm; of a network the median length of its struts.
        material: of struts and skin.
        cases: what the part carries.
        bounds: the smallest radius that a strut may have, and the largest, mm; nodes where struts
            would meet before their middles have less.
        borne: a radius that nodes bear even there, because struts that overlap are united, mm.
        skin: its shells; None for a bare lattice.
        solid: the part, on which regions are looked up; needed with a skin.
        domain: closed mesh, outside of which struts have no volume; None where nothing cuts them.
        stays: (k,) bool, which struts of the wireframe the part has at all; None for all.
        masses: of attached bodies.
        comes_out: what the printer makes of the wireframe's struts; None for what is drawn.

    Raises:
        VolfrepError: nothing of the part lies where a load acts, or no strut hangs together.
    """
    frame, owner, low, high = clipped.wireframe, clipped.owner, clipped.low, clipped.high
    hung = _hanging_together(frame, clipped.on_boundary if skin is not None else None)
    struts = frame.struts.astype(np.int64)[hung]
    owner, low, high = owner[hung], low[hung], high[hung]
    count = len(wireframe.nodes)
    first, second = wireframe.struts.astype(np.int64)[owner].T
    rows = np.repeat(np.arange(2 * len(owner)), 2)
    columns = np.stack([first, second, first, second], axis=1).ravel()
    shares = np.stack([1.0 - low, low, 1.0 - high, high], axis=1).ravel()
    ends = csr_matrix((shares, (rows, columns)), shape=(2 * len(owner), count))
    ends.eliminate_zeros()

    least, most = bounds
    largest = largest_radii(wireframe.nodes, wireframe.struts.astype(np.int64), most)
    largest = np.maximum(largest, min(borne, most))
    if least > largest.min():
        raise VolfrepError(
            f"Struts of radius {least:.4g} mm are the thinnest allowed, and where they are "
            f"nearest to each other no more than {largest.min():.4g} mm fits: allow thinner "
            "struts, or make the cells larger."
        )
    inside = np.zeros(len(frame.nodes), bool)
    inside[struts.ravel()] = True
    made = Graph(wireframe.nodes, wireframe.struts if stays is None else wireframe.struts[stays])
    thin, thick = np.full(count, least), largest
    if comes_out is not None:
        thin = np.minimum(thin, comes_out.at_nodes(thin))
        thick = np.maximum(thick, comes_out.at_nodes(thick))
    filled = union_volume(made, cell_size, thin, thick, domain)
    shape = NodeRadii(ends, filled, None if comes_out is None else comes_out.of(owner))

    alone = np.bincount(struts.ravel(), minlength=len(frame.nodes)) == 1
    on_boundary = np.asarray(
        clipped.on_boundary & inside if skin is not None else np.zeros(len(inside), bool)
    )
    stuff = elastic(material)
    smallest, biggest = least, float(largest.max())
    if comes_out is not None:
        smallest = min(smallest, float(shape.of_struts(np.full(count, least)).min()))
        biggest = max(biggest, float(shape.of_struts(largest).max()))
    table = end_table(ends_law(cell, cell_size, "square"), smallest, biggest)
    joined = ~(clipped.on_boundary & alone)[struts]
    nodes, constraints, blocks = frame.nodes, NO_CONSTRAINTS, None
    facets = np.empty((0, 3), np.int64)
    places = nodes
    if skin is not None:
        tied = np.flatnonzero(on_boundary)
        between_walls = struts[on_boundary[struts].all(axis=1)]
        pieces = np.searchsorted(tied, between_walls)
        constraints = constraints_to(skin, nodes[tied], tied, len(nodes), pieces)
        blocks = replace(
            skin.blocks,
            rows=skin.blocks.rows + len(nodes),
            columns=skin.blocks.columns + len(nodes),
        )
        facets = skin.outside.triangles[skin.used].astype(np.int64)
        places = np.concatenate([nodes, skin.outside.vertices])
        nodes = places
    beams = beams_of(nodes, struts, stuff, joined=joined, section=SQUARE_SECTION, ends=table)
    structure = Structure(nodes, beams, constraints, blocks)

    # What can be held and loaded: struts' nodes that are there, and the skin's.
    there = np.zeros(len(nodes), bool)
    there[: len(inside)] = inside & ~on_boundary
    if skin is not None:
        there[len(inside) + np.unique(facets)] = True
    body_rows = np.flatnonzero(there)
    new_row = np.cumsum(there) - 1
    reach = np.zeros(len(nodes))
    reach[: len(inside)] = frame.joint_radii
    body = Body(
        places[body_rows],
        new_row[facets + len(inside)] if len(facets) else facets,
        reach[body_rows],
        np.ones(len(body_rows), bool),
    )
    laid = []
    for case in cases:
        chosen = case if skin is None or solid is None else _on_skin(case, solid, body)
        nodal = nodal_case(body, chosen)
        fixed, loads, prescribed = (
            np.zeros((len(nodes), 6), kind) for kind in (bool, float, float)
        )
        fixed[body_rows], loads[body_rows], prescribed[body_rows] = (
            nodal.fixed,
            nodal.loads,
            nodal.prescribed,
        )
        x, y, z = nodal.acceleration.tolist()
        laid.append(
            Case(fixed, loads, prescribed if prescribed.any() else None, (x, y, z), nodal.name)
        )
    if masses:
        own = _attached(masses, cases[0], body, solid if skin is not None else None)
        attached = np.zeros(len(nodes))
        attached[body_rows] = own
        structure = replace(structure, attached=attached)
    problem = Problem(
        structure, tuple(laid), shape, np.full(count, least), largest, there, around=skin
    )
    skin_volume = 0.0
    if skin is not None and solid is not None and domain is not None:
        skin_volume = solid.volume - domain.volume
    return SizingModel(problem, wireframe, owner, skin, on_boundary, skin_volume)


def with_sized_skin(
    model: SizingModel,
    wanted: Callable[[Floats], Floats],
    bounds: tuple[float, float],
    patch: float,
    mirrors: Mirrors | None = None,
    given: Callable[[Floats], Floats] | None = None,
) -> tuple[SizingModel, Floats]:
    """A structure whose skin is varied, too.

    Args:
        model: with a skin.
        wanted: thickness to begin with, mm, at (n, 3) points.
        bounds: the least thickness and the largest, mm.
        patch: how far apart the thickness is chosen, mm; inf for one everywhere.
        mirrors: planes under which the thickness is its own image; None for none.
        given: mm, at (n, 3) points, thickness that is not varied; 0 where it is. None for nowhere.

    Returns:
        The structure, and (p,) the roots of the thicknesses to begin with.
    """
    problem, skin = model.problem, model.skin
    assert skin is not None
    places = skin.centres
    if np.isfinite(patch):
        points = control_points(places if mirrors is None else mirrors.folded(places), patch)
        if mirrors is not None:
            points = mirrors.images(points, np.zeros(len(points)))[0]
        shares = shares_of(points, places, patch)
    else:
        points = places.mean(axis=0)[None]
        shares = csr_matrix(np.ones((len(places), 1)))
    varied = SkinThickness(
        skin, model.frame_nodes, len(problem.low), points, shares, model.skin_volume or None
    )
    least, most = (np.full(len(points), np.sqrt(bound)) for bound in bounds)
    if given is not None:
        own = np.sqrt(given(points))
        least, most = np.where(own > 0.0, own, least), np.where(own > 0.0, own, most)
    first = np.clip(np.sqrt(wanted(points)), least, most)
    whole = np.concatenate([problem.low, first])
    structure = problem.structure
    structure = Structure(
        structure.nodes,
        structure.beams,
        structure.constraints,
        varied.blocks(whole),
        structure.attached,
    )
    smoother = problem.smoother
    if smoother is not None:
        smoother = csr_matrix(block_diag([smoother, identity(len(points))]))
    problem = replace(
        problem, structure=structure, radii=with_skin(problem.radii, varied), skin=varied,
        low=np.concatenate([problem.low, least]), high=np.concatenate([problem.high, most]),
        smoother=smoother, groups=None,
    )  # fmt: skip
    nodes = model.problem.groups
    if nodes is not None:
        alike = np.arange(len(points))
        if mirrors is not None and np.isfinite(patch):
            alike = mirrors.groups(points, _IMAGES)[0]
        problem = problem.alike(np.concatenate([nodes, nodes.max() + 1 + alike]))
    return replace(model, problem=problem), problem.most_alike(whole)[len(whole) - len(first) :]


def _attached(
    masses: Sequence[Mass], case: LoadCase, body: Body, solid: TriangleMesh | None
) -> Floats:
    """(n,) t, what of attached bodies moves with each node of a body."""
    acting = tuple(Force(one.region, (1.0, 0.0, 0.0), name=one.name) for one in masses)
    laid = replace(case, name="attached bodies", loads=acting)
    loads = (laid if solid is None else _on_skin(laid, solid, body)).loads
    result = np.zeros(len(body.nodes))
    for one, load in zip(masses, loads, strict=True):
        try:
            share = share_of(body, load.region)
        except VolfrepError as error:
            raise VolfrepError(f"Mass '{one.name}': {error}") from error
        result[share.nodes] += 1e-6 * one.mass * share.weights
    return result


def _hanging_together(frame: Wireframe, on_boundary: Bools | None) -> Bools:
    """(m,) struts of the largest piece; with a skin, those that hang on it somewhere."""
    struts = frame.struts
    piece = pieces_of(struts[:, 0], struts[:, 1], len(frame.nodes))[1]
    if on_boundary is None:
        return np.asarray(piece[struts[:, 0]] == np.argmax(np.bincount(piece[struts[:, 0]])))
    kept = np.zeros(piece.max() + 1, bool)
    kept[piece[on_boundary]] = True
    return np.asarray(kept[piece[struts[:, 0]]])


@dataclass(frozen=True, eq=False)
class _Found:
    """A region whose facets of the skin were found on the part itself, which has finer ones."""

    region: Region
    taken: Bools

    def distance(self, points: Floats) -> Floats:
        return self.region.distance(points)

    def facets(self, mesh: TriangleMesh, tolerance: float) -> Bools:
        del mesh, tolerance
        return self.taken

    def __str__(self) -> str:
        return str(self.region)


def fixed_facets(solid: TriangleMesh, cases: Sequence[LoadCase]) -> Bools:
    """(m,) which facets of the part no case lets move anywhere."""
    result = np.ones(len(solid.triangles), bool)
    for case in cases:
        of_case = np.zeros(len(result), bool)
        for support in case.supports:
            if None not in support.displacement:
                for region in simple_regions(support.region):
                    of_case |= region.facets(solid, _tolerance(solid))
        result &= of_case
    return result


def _tolerance(solid: TriangleMesh) -> float:
    return ROUNDING * float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))


def _on_skin(case: LoadCase, solid: TriangleMesh, body: Body) -> LoadCase:
    """A load case whose regions take those facets of the skin that lie on what they take of it."""
    surface = body.surface()
    middles = surface.vertices[surface.triangles].mean(axis=1)
    nearest = closest_points(solid, middles)[2]

    def found(region: Region) -> Region:
        parts = tuple(
            cast(Any, _Found(simple, simple.facets(solid, _tolerance(solid))[nearest]))
            for simple in simple_regions(region)
        )
        return parts[0] if len(parts) == 1 else AnyOf(parts)

    supports = tuple(replace(entry, region=found(entry.region)) for entry in case.supports)
    loads = tuple(replace(entry, region=found(entry.region)) for entry in case.loads)
    return replace(case, supports=supports, loads=loads)
