# SPDX-License-Identifier: LGPL-2.1-or-later
"""What blocks and parts of walls have in common: what is meshed, and where it is placed."""

from __future__ import annotations

import math

import numpy as np

from ...design.grading import RadiusGrading
from ...design.kinds.tpms import Tpms
from ...design.spec import LatticeSpec
from ...design.tpms import PeriodicSurface
from ...grid.coordinate_map import identity_map
from ...grid.placement import Placement
from ...lattice.assembly import Layout, coordinates
from ...lattice.deform import Deformed
from ...octants.octant import Octant, OctantKey
from ...octants.octant_spec import OctantSpec
from ...tpms.deform import deform_tpms
from ...tpms.period import tpms_octants
from ...tpms.solid import TpmsSolid
from ...util.progress import Monitor
from ...util.types import Floats

#: A side of a surface is about as thick as this, in units of L.
SIDE = 0.2


def tpms_of(spec: LatticeSpec) -> Tpms:
    """The walls that a specification is of."""
    kind = spec.kind
    assert isinstance(kind, Tpms)
    return kind


def surface_of(spec: LatticeSpec) -> PeriodicSurface:
    """The surface that the walls of a specification follow."""
    return tpms_of(spec).surface


def tpms_meshing(spec: LatticeSpec) -> OctantSpec:
    """What the octants of walls are meshed for: half their thickness stands for a radius."""
    least, most = tpms_of(spec).thicknesses
    radius = 0.5 * math.sqrt(least * most) if spec.wall.is_sheet else SIDE * spec.cell_size
    return OctantSpec(spec.cell_size, radius, 0.0, spec.facets_along_cell)


def solid_of(spec: LatticeSpec) -> TpmsSolid:
    """The wall whose octants are meshed: of a graded sheet, one of some thickness between."""
    solid = TpmsSolid.of(surface_of(spec), spec.wall, spec.cell_size)
    if not spec.wall.is_sheet:
        return solid
    return TpmsSolid(solid.surface, solid.kind, tpms_meshing(spec).strut_radius / spec.cell_size)


def mesh_tpms(solid: TpmsSolid, wanted: OctantSpec, monitor: Monitor) -> dict[OctantKey, Octant]:
    """The octants of an endless wall."""
    return tpms_octants(solid, wanted.cell_size, wanted.facets, monitor)


def keeps_places(spec: LatticeSpec, placement: Placement) -> bool:
    """Whether the vertices of octants keep their places in lattice space."""
    rigid = placement.mapping is None or placement.mapping.is_rigid
    return rigid and spec.radius_grading is None


def place_tpms(
    layout: Layout, spec: LatticeSpec, placement: Placement, monitor: Monitor
) -> Deformed:
    """Where the vertices of placed octants are in the part."""
    mapping = placement.mapping or identity_map(placement.cell_size)
    if keeps_places(spec, placement):
        inside = coordinates(layout, monitor)
        inside = inside if placement.mapping is None else mapping.to_part(inside)
        return Deformed(placement.nudged(inside), 0.0)
    grading = spec.radius_grading

    def levels(points: Floats) -> Floats:
        if isinstance(grading, RadiusGrading):
            return 0.5 * grading.radii(points, placement.bounds, placement.depth)
        level = 0.5 * spec.wall.thickness if spec.wall.is_sheet else spec.wall.offset
        return np.full(len(points), level)

    moved = deform_tpms(layout, solid_of(spec), levels, mapping, monitor)
    return Deformed(placement.nudged(moved.vertices), moved.excess)
