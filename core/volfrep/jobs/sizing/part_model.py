# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part whose struts are to be sized as the structure that is solved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...design.spec import LatticeSpec
from ...grid.strut_graph import Wireframe
from ...loads.load_cases import LoadCases
from ...mesh import remesh
from ...mesh.triangle_mesh import TriangleMesh
from ...shell.domain import field_of
from ...shell.thickness_field import ThicknessField
from ...sizing.model import SizingModel, elastic, feet_of, fixed_facets, sizing_model
from ...sizing.node_radii import ComesOut, smoothing
from ...sizing.skin import NO_FEET, Feet, skin_model
from ...sizing.skin_mesh import begun_surface, even_surface
from ...spatial.proximity import closest_points
from ...trim.clip_struts import Clipped
from ...util.cache import Kept, StageCache
from ...util.content import content_of
from ...util.errors import VolfrepError
from ...util.progress import ProgressCallback
from ...util.types import Floats
from ..infill import Infill
from ..kinds import lattice_kind
from ..targets import solve_target
from .goal import Goal
from .printed import comes_out

#: Edges of the skin's triangles over its thickness, at least.
SKIN_EDGE_LEAST = 1.5
#: They are so much shorter where the skin is kept from buckling: a dimple has four of them or more.
DIMPLED = 0.5
#: Steps in which the wall is found below a point; each leaves less than half of what was missing.
_ALONG = 6
#: A node's image is as near to another node, in cells; and no more nodes may have none.
_IMAGE, MOST_LONE = 1e-3, 0.05


@dataclass(frozen=True, eq=False)
class Unloaded:
    """What of a part's model no load changes.

    Attributes:
        wireframe: of the active cells, whole, mm.
        clipped: the same struts, cut at the wall.
        bounds: the least radius and the largest, mm.
        borne: a radius that all nodes bear, mm.
        comes_out: how struts come out; None as they are drawn.
        edge: how long edges of the skin's triangles are, mm.
        feet: where struts meet the skin.
        outside: the skin's surface in such triangles; None without a skin.
    """

    wireframe: Wireframe
    clipped: Clipped
    bounds: tuple[float, float]
    borne: float
    comes_out: ComesOut | None
    edge: float
    feet: Feet
    outside: TriangleMesh | None


def part_model(
    infill: Infill,
    loads: LoadCases,
    goal: Goal,
    cache: StageCache,
    reach: Floats | None = None,
    thickest: float | None = None,
) -> SizingModel:
    """The part as it is solved.

    Args:
        infill: the part.
        loads: the material, and what the part carries.
        goal: between which radii, how even.
        cache: keeps the costly stages of the part.
        reach: (n,) mm, radii at the nodes by which struts hold the skin; None for the
            specification's.
        thickest: mm, up to which the skin may become thicker; None where it does not.

    Raises:
        VolfrepError: there are no struts that could be sized, or the radii make no sense.
    """
    spec, material = infill.spec, loads.material
    part, skin = unloaded(infill, goal, cache, reach), None
    wireframe = part.wireframe
    if part.outside is not None:
        with infill.monitor.stage("skin", 0.35, 0.4):
            skin = skin_model(
                infill.solid, thickness_of_skin(infill.solid, spec), part.edge, elastic(material),
                infill.domain.openings, part.feet, infill.monitor,
                fixed=fixed_facets(infill.solid, loads.cases), thickest=thickest,
                outside=part.outside,
            )  # fmt: skip
    model = sizing_model(
        wireframe, part.clipped, spec.kind.cube, infill.filling.spacing, material, loads.cases,
        bounds=part.bounds, borne=part.borne, skin=skin, solid=infill.solid,
        domain=infill.domain.mesh if infill.placement.is_cut else None, stays=infill.staying,
        masses=loads.masses, comes_out=part.comes_out,
    )  # fmt: skip
    if goal.smooth:
        smoother = smoothing(wireframe.struts.astype(np.int64), len(wireframe.nodes), goal.smooth)
        model = replace(model, problem=replace(model.problem, smoother=smoother))
    if goal.mirrors is not None:
        groups, lone = goal.mirrors.groups(wireframe.nodes, _IMAGE * infill.filling.spacing)
        if lone > MOST_LONE:
            raise VolfrepError(
                f"{lone:.0%} of the lattice's nodes have no image in the planes of symmetry: lay "
                "a corner or the middle of a cell into each plane (the origin), and choose a cell "
                "and a part that are their own images."
            )
        model = replace(model, problem=model.problem.alike(groups))
    return model


def unloaded(
    infill: Infill, goal: Goal, cache: StageCache, reach: Floats | None = None
) -> Unloaded:
    """What of `part_model` no load changes, with what takes long kept in the part's cache.

    Args:
        infill: the part.
        goal: as of `part_model`.
        cache: as of `part_model`.
        reach: as of `part_model`.

    Raises:
        VolfrepError: there are no struts that could be sized, or the radii make no sense.
    """
    spec = infill.spec
    if spec.output == "domain":
        raise VolfrepError("The output 'domain' holds no lattice to size: choose part or lattice.")
    if spec.fillet:
        raise VolfrepError("Struts with fillets cannot be sized: set the fillet to 0.")
    if len(spec.kind.widths):
        raise VolfrepError(
            "Sizing gives each node one radius, and these struts have widths of their own: choose "
            "a cell without."
        )
    wireframe, clipped = infill.struts, infill.axes
    if spec.radius_grading is not None:
        # Which ends at a wall are too short for a beam goes by the radius: those of the
        # specification's own, so that a design is solved as it was sized.
        plain = Infill(
            infill.solid, replace(spec, radius_grading=None, remove_below=0.0),
            monitor=infill.monitor, cache=cache,
        )  # fmt: skip
        if np.array_equal(plain.struts.struts, wireframe.struts):
            clipped = plain.axes
    own = float(np.median(wireframe.radii))
    if goal.radius_list:
        goal = replace(goal, thinnest=goal.radius_list[0], thickest=goal.radius_list[-1])
    least = goal.thinnest if goal.thinnest is not None else 0.5 * own
    bears = infill.filling.radii_borne(own)
    most = bears.usual if goal.thickest is None else min(goal.thickest, bears.most)
    if not 0.0 < least <= most:
        raise VolfrepError(
            f"Radii from {least:.4g} to {most:.4g} mm make no sense: the smallest must be above 0 "
            "and below the largest, which the cells do not bear beyond "
            f"{bears.most:.4g} mm."
        )
    out = None
    if goal.printing is not None:
        out = comes_out(goal.printing, wireframe, least)
    edge, feet, outside = 0.0, NO_FEET, None
    if spec.with_skin:
        edge = edge_of_skin(infill, goal.limits.frame_buckling is not None)
        held = given_radii(wireframe) if reach is None else reach
        with infill.monitor.stage("skin", 0.3, 0.35):
            feet = feet_of(
                wireframe, clipped, infill.domain.mesh, held if out is None else out.at_nodes(held)
            )
            outside = skin_surface(infill, edge, feet)
    return Unloaded(wireframe, clipped, (least, most), bears.own, out, edge, feet, outside)


def edge_of_skin(infill: Infill, is_dimpled: bool) -> float:
    """The length of the skin's triangles' edges, mm; less where it is kept from buckling."""
    edge = infill.filling.skin_edge * (DIMPLED if is_dimpled else 1.0)
    return max(edge, SKIN_EDGE_LEAST * infill.spec.shell)


def skin_surface(infill: Infill, edge: float, feet: Feet) -> TriangleMesh:
    """The part's surface in triangles with vertices where struts meet it: kept.

    So is what they are made of, whatever meets it there.
    """
    part = infill.part_domain
    begun = part.cache.run("surface", begun_surface, part.kept_solid, edge, part.watch)
    places = Kept(feet.places, content_of(feet.places))
    return part.cache.run(
        "skin surface", even_surface, part.kept_solid, edge, part.watch, places, begun
    ).value


def all_struts(spec: LatticeSpec) -> LatticeSpec:
    """The specification with all struts, of fixed ends: which go is decided anew."""
    return replace(lattice_kind(spec).with_fixed_struts(), remove_below=0.0)


def without_target(
    solid: TriangleMesh,
    spec: LatticeSpec,
    goal: Goal,
    cache: StageCache,
    progress: ProgressCallback | None,
    notes: list[str],
) -> LatticeSpec:
    """The specification with the radius of its target, and what that means in a sentence."""
    target = spec.target
    if target is None or spec.output == "domain":
        return replace(spec, target=None)
    found = solve_target(solid, spec, progress=progress, cache=cache, meshed=False).spec
    kept = "the limits now say how thick struts are"
    if not goal.limits.any:
        kept = "struts have their mass, distributed anew" if goal.volume is None else "it began so"
    notes.append(
        f"The target, a {target.called} of {target.value:.5g}, asks for struts of "
        f"{found.strut_radius:.4g} mm: {kept}."
    )
    return replace(found, target=None)


def given_radii(wireframe: Wireframe) -> Floats:
    """(n,) mm, the radii at the nodes that the specification says."""
    result = np.zeros(len(wireframe.nodes))
    result[wireframe.struts] = wireframe.radii
    return result


def thickness_of_skin(solid: TriangleMesh, spec: LatticeSpec) -> float | Callable[[Floats], Floats]:
    """A skin's thickness, mm, or at points of the part's surface where it is not even."""
    if spec.skin is None or spec.skin.is_even:
        return spec.shell
    field = field_of(solid, spec.skin)
    if field is not None and not (spec.skin.face_skins or spec.skin.keep_solid):
        return partial(_thickness_along, solid, field)
    below = spec.skin.below(solid)
    # Where a face is open there are no shells: any thickness will do.
    below = np.where(below > 0.0, below, spec.shell)
    return lambda points: np.asarray(below[closest_points(solid, points)[2]])


def _thickness_along(solid: TriangleMesh, field: ThicknessField, points: Floats) -> Floats:
    """(n,) mm, how far below points of the surface the wall is where thickness follows a field."""
    triangle = closest_points(solid, points)[2]
    normal = remesh.unit_normals(solid.vertices[solid.triangles[triangle]])
    depth = field(points)
    for _ in range(_ALONG):
        depth = field(points - depth[:, None] * normal)
    return depth
