# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice as beams for a finite-element solver: fast where solid elements are out of reach.

Bare beams from node to node are far too soft, because struts of ordinary thickness overlap at
their joints. So the ends of each strut are stiffened. How far and how much depends on the cell and
the radius, and is fitted to the cell's homogenised stiffness (`volfrep.mechanics.joint_fit`);
without a fit they are rigid over a part of the radius.

Ends are stiffened by modulus and width. FreeCAD's round beams keep their width, because CalculiX
ties sections of different width into a rigid knot.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..design.cells import UnitCell
from ..grid.strut_graph import Wireframe
from ..mechanics.catalogue import joint_law, known_cell
from ..mechanics.frame import Ends, JointLaw
from ..util.errors import VolfrepError
from ..util.ragged import spread
from ..util.types import Bools, Floats, Ints

#: Length of a strut's stiff ends in units of its radius, where no fit of the cell is given. With it
#: the displacements of all six cells come nearest to those of solid elements.
JOINT_LENGTH = 0.8
#: What is told of beams whose ends no cell was fitted to.
OF_NETWORK = (
    "The beams of a network have rigid ends of 0.8 radii, fitted to none: a Voronoi network of "
    "them was 6 % stiffer than its tetrahedra, a Delaunay network 13 % softer."
)
#: How many times as stiff as the material such ends are: rigid, yet solvable.
JOINT_STIFFNESS = 1000.0
#: The r / L up to which lattices of such beams were compared with solid elements (docs/solver.md).
MEASURED_TO = 0.15
#: Where the frame of a library's cell misses Young's modulus by more, whatever its ends, that is
#: told.
LARGEST_MISFIT = 0.05
#: Ends are never longer than this part of a strut.
LONGEST_JOINT = 0.45
#: Elements along a strut between its stiff ends, none shorter than so many radii.
ELEMENTS_PER_STRUT = 8
SHORTEST_ELEMENT = 0.4
#: A beam has the same radius all along: a cone becomes steps. Steps of different struts whose
#: radii differ by less than this fraction to either side share a section.
RADIUS_TOLERANCE = 0.01


@dataclass(frozen=True, eq=False)
class BeamMesh:
    """Straight two-noded beams of circular section.

    Attributes:
        nodes: (k, 3) float64, mm; the wireframe's own nodes come first.
        joints: how many nodes are the wireframe's own.
        elements: (e, 2) int64, rows of `nodes`.
        strut: (e,) int64, the strut each element is a part of.
        section: (e,) int64, rows of `radii`.
        radii: (s,) float64, the sections' radii, mm.
        is_joint: (e,) bool, the stiff ends.
        ends: (s,) how the stiff ends of each section's radius are stiffened.
    """

    nodes: Floats
    joints: int
    elements: Ints
    strut: Ints
    section: Ints
    radii: Floats
    is_joint: Bools
    ends: tuple[Ends, ...]


def rigid_ends(length: float) -> JointLaw:
    """Ends that do not bend, so many radii long, for all radii."""
    return lambda _: Ends(length, JOINT_STIFFNESS, JOINT_STIFFNESS)


def beam_model(
    wireframe: Wireframe,
    on_boundary: Bools | None = None,
    *,
    joint_length: float = JOINT_LENGTH,
    joint_law: JointLaw | None = None,
    elements_per_strut: int = ELEMENTS_PER_STRUT,
    radius_tolerance: float = RADIUS_TOLERANCE,
) -> BeamMesh:
    """Divide every strut into stiff ends and a flexible middle.

    Args:
        wireframe: the struts, mm.
        on_boundary: (n,) bool, nodes on the skin: a strut that ends there alone, not in a joint,
            gets no stiff end there. None: all are joints.
        joint_length: of rigid ends, in units of the radius there; 0 for bare beams.
        joint_law: the ends that were fitted to the cell, in place of rigid ones.
        elements_per_strut: of the flexible middle.
        radius_tolerance: sections whose radii differ by less than this fraction to either side
            become one; a lattice of one radius keeps it exactly.

    Raises:
        VolfrepError: there are no struts, or an argument makes no sense.
    """
    if not len(wireframe.struts):
        raise VolfrepError("The lattice has no struts to make beams of.")
    if not 0.0 <= joint_length <= 2.0:
        raise VolfrepError(f"Stiff ends must be 0 to 2 radii long, not {joint_length:g}.")
    if elements_per_strut < 1:
        raise VolfrepError("A strut needs at least one element.")
    if not 0.0 < radius_tolerance < 0.5:
        raise VolfrepError(
            f"The tolerance of the radius must be between 0 and 0.5, not {radius_tolerance:g}."
        )
    start, end = wireframe.nodes[wireframe.struts].swapaxes(0, 1)
    length = np.linalg.norm(end - start, axis=1)
    profile = joint_law or rigid_ends(joint_length)
    section, at_ends = _sections(wireframe.radii.ravel(), radius_tolerance)
    stretch = np.array([profile(radius).length for radius in at_ends.tolist()])[section]
    stiff = np.minimum(stretch.reshape(-1, 2) * wireframe.radii, LONGEST_JOINT * length[:, None])
    if on_boundary is not None:
        alone = np.bincount(wireframe.struts.ravel(), minlength=len(wireframe.nodes)) == 1
        stiff[(on_boundary & alone)[wireframe.struts]] = 0.0
    flexible = length - stiff.sum(axis=1)
    shortest = SHORTEST_ELEMENT * wireframe.radii.max(axis=1)
    middle = np.clip(np.floor(flexible / shortest), 1, elements_per_strut).astype(np.int64)

    before = (stiff[:, 0] > 0).astype(np.int64)
    counts = middle + before + (stiff[:, 1] > 0)
    strut, place = spread(counts)
    is_joint = ((place == 0) & (before[strut] > 0)) | (
        (place == counts[strut] - 1) & (stiff[strut, 1] > 0)
    )
    # An element's second node: behind its stiff start, so many equal steps on; or the strut's end.
    last = place == counts[strut] - 1
    steps = (place + 1 - before[strut]) / middle[strut]
    high = np.where(last, length[strut], stiff[strut, 0] + flexible[strut] * steps) / length[strut]
    low = np.where(place == 0, 0.0, np.roll(high, 1))

    # Behind the lattice's own nodes come those between the elements of each strut.
    joints = len(wireframe.nodes)
    own = joints + np.arange(len(strut)) - strut
    elements = np.stack(
        [
            np.where(place == 0, wireframe.struts[strut, 0], own - 1),
            np.where(last, wireframe.struts[strut, 1], own),
        ],
        axis=1,
    )
    nodes = np.concatenate([wireframe.nodes, np.empty((len(strut) - len(counts), 3))])
    nodes[own[~last]] = (start[strut] + high[:, None] * (end - start)[strut])[~last]
    share = 0.5 * (low + high)
    radius = (1.0 - share) * wireframe.radii[strut, 0] + share * wireframe.radii[strut, 1]
    section, radii = _sections(radius, radius_tolerance)
    ends = tuple(profile(value) for value in radii.tolist())
    return BeamMesh(nodes, joints, elements, strut, section, radii, is_joint, ends)


def ends_law(cell: UnitCell | None, cell_size: float, section: str) -> JointLaw:
    """How joints stiffen the ends of struts: as was fitted to a cell; None for a network.

    Args:
        cell: the unit cell; None where the struts are no cell's.
        cell_size: L, mm.
        section: of the beams, ``square`` or ``circle``.
    """
    return rigid_ends(JOINT_LENGTH) if cell is None else joint_law(cell, cell_size, section)


def fitted_beams(
    wireframe: Wireframe,
    on_boundary: Bools | None,
    cell: UnitCell | None,
    cell_size: float,
    *,
    section: str = "square",
    elements_per_strut: int = ELEMENTS_PER_STRUT,
) -> tuple[BeamMesh, tuple[str, ...]]:
    """Beams whose ends are those that were fitted to their cell.

    Args:
        wireframe: the struts, mm.
        on_boundary: as for `beam_model`.
        cell: the unit cell; one that is not the library's is fitted first, which takes seconds.
            None for a network, whose ends are rigid.
        cell_size: L, mm.
        section: of the beams, ``square`` or ``circle``.
        elements_per_strut: of the flexible middle.

    Returns:
        The beams, and sentences for the user: where struts are thicker than beams were held
        against solids for; and where the cell by itself carries no load, so that there is nothing
        to fit to and the ends are rigid.
    """
    profile = ends_law(cell, cell_size, section)
    if cell is None:
        model = beam_model(
            wireframe, on_boundary, joint_law=profile, elements_per_strut=elements_per_strut
        )
        return model, (OF_NETWORK,)
    try:
        model = beam_model(
            wireframe, on_boundary, joint_law=profile, elements_per_strut=elements_per_strut
        )
        return model, _too_thick(wireframe, cell_size) + _misfit(
            wireframe, cell, cell_size, section
        )
    except VolfrepError as error:
        model = beam_model(wireframe, on_boundary, elements_per_strut=elements_per_strut)
        return model, (f"The beams have rigid ends of {JOINT_LENGTH:g} radii. {error}",)


def _too_thick(wireframe: Wireframe, cell_size: float) -> tuple[str, ...]:
    """A sentence where struts are thicker than what the fitted ends were measured for."""
    ratio = float(wireframe.radii.max()) / cell_size
    if ratio <= MEASURED_TO:
        return ()
    return (
        f"Struts of r/L = {ratio:.2g} are hardly beams: these were held against solid elements up "
        f"to {MEASURED_TO:g}, where they are within 5 %; beyond it they may be farther off, and "
        "tetrahedra are safer.",
    )


def _misfit(
    wireframe: Wireframe, cell: UnitCell, cell_size: float, section: str
) -> tuple[str, ...]:
    """A sentence where no ends give a library's cell its stiffness."""
    known = known_cell(cell)
    if known is None:
        return ()
    ratio = float(wireframe.radii.max()) / cell_size
    missed = known.misfit_at(ratio, section)
    if missed <= LARGEST_MISFIT:
        return ()
    return (
        f"No ends make beams of {cell.name} at r/L = {ratio:.2g} as stiff as their solid: Young's "
        f"modulus along an edge is up to {100 * missed:.0f} % off; tetrahedra are safer.",
    )


def _sections(radius: Floats, tolerance: float) -> tuple[Ints, Floats]:
    """The section of every element, and every section's radius: midway between its elements'."""
    ratio = np.log1p(tolerance) - np.log1p(-tolerance)
    bins = np.floor(np.log(radius / radius.min()) / ratio + 1e-6).astype(np.int64)
    used, section = np.unique(bins, return_inverse=True)
    low, high = np.full(len(used), np.inf), np.zeros(len(used))
    np.minimum.at(low, section, radius)
    np.maximum.at(high, section, radius)
    return section.ravel().astype(np.int64), 0.5 * (low + high)
