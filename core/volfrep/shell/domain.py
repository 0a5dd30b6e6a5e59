# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the lattice of a part fills: all of it, or what its skin leaves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

from ..design.openings import open_surface, open_triangles
from ..design.skins.own_faces import Thicknesses
from ..design.spec_parts import Skin
from ..mesh.booleans import difference, intersection
from ..mesh.triangle_mesh import TriangleMesh
from ..util.manifold import has_manifold, install_command
from ..util.progress import Monitor
from ..util.types import Bools
from .depth import Depth, sheet_depth, thinnest_of
from .offset import TOLERANCE, Cavity, find_cavity, without_small
from .thickness_field import ThicknessField, thickness_field

#: Rooms between a wall and bodies that are kept solid are filled where they are smaller than this,
#: in cubes of the skin's least thickness.
SMALLEST_ROOM = 0.2


@dataclass(frozen=True, eq=False)
class Domain:
    """What the lattice fills.

    Attributes:
        mesh: its closed surface, inside the part or the part's own; empty where there is no room.
        boundary: closed surface that cuts the lattice: the same, but it reaches out of the part
            beyond faces that are left open.
        openings: the faces that are left open; None where the skin is closed.
        warnings: sentences for the user about the skin.
    """

    mesh: TriangleMesh
    boundary: TriangleMesh
    openings: TriangleMesh | None = None
    warnings: tuple[str, ...] = ()

    @property
    def is_open(self) -> bool:
        """Whether faces of the part have no skin."""
        return self.openings is not None


def find_domain(solid: TriangleMesh, skin: Skin | None, monitor: Monitor) -> Domain:
    """What the lattice of a part fills.

    Args:
        solid: checked closed mesh, mm.
        skin: what lies about the domain; None for none.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: an open face is not found, or the skin cannot be made.
    """
    if skin is None:
        return Domain(solid, solid)
    monitor.count("walls found", 1)
    if skin.is_even:
        is_open = open_triangles(solid, skin.open_faces) if skin.open_faces else None
        found = find_cavity(solid, skin.thickness, monitor, is_open)
    else:
        found, is_open = _uneven(solid, skin, monitor)
    warnings: tuple[str, ...] = ()
    if found.worst > TOLERANCE:
        x, y, z = found.place
        warnings = (
            f"The skin is up to {found.worst:.0%} off its thickness near ({x:.4g}, {y:.4g}, "
            f"{z:.4g}), where the room between two skins is narrow.",
        )
    if not has_manifold():
        warnings += (
            "The skin's inner surface has more facets than it needs, because the Python package "
            f"manifold3d is not installed: install it with the command  {install_command()} .",
        )
    if is_open is None or not len(found.mesh.triangles):
        return Domain(found.mesh, found.mesh, warnings=warnings)
    trimmed = monitor.call(lambda: intersection(found.mesh, solid))
    return Domain(trimmed, found.mesh, open_surface(solid, is_open), warnings)


def _uneven(solid: TriangleMesh, skin: Skin, monitor: Monitor) -> tuple[Cavity, Bools | None]:
    """The wall of a skin that is not alike everywhere, and which triangles are open."""
    lengths = skin.thicknesses(solid)
    thinnest, field = thinnest_of(lengths, skin.thickness), field_of(solid, skin)
    uneven = partial(_depth, solid, lengths, skin.thickness, monitor, field)
    found = find_cavity(
        solid, thinnest, monitor, lengths.is_open,
        uneven if lengths.others or field is not None else None,
    )  # fmt: skip
    if skin.bodies and len(found.mesh.triangles):
        less = partial(_less, found.mesh, skin.bodies, SMALLEST_ROOM * thinnest**3)
        found = replace(found, mesh=monitor.call(less))
    return found, lengths.is_open


def field_of(solid: TriangleMesh, skin: Skin) -> ThicknessField | None:
    """What the thickness of a part's skin follows; None where it is the same below all faces."""
    if skin.field is None:
        return None
    return thickness_field(skin.field, skin.thickness, *solid.bounds)


def _depth(
    solid: TriangleMesh,
    lengths: Thicknesses,
    usual: float,
    monitor: Monitor,
    field: ThicknessField | None,
    spacing: float,
) -> Depth:
    return sheet_depth(solid, lengths, usual, spacing, monitor, field)


def _less(cavity: TriangleMesh, bodies: tuple[TriangleMesh, ...], smallest: float) -> TriangleMesh:
    """A cavity less bodies, without rooms of less than a volume in mm3."""
    left = difference(cavity, *bodies)
    return without_small(left, smallest) if len(left.triangles) else left
