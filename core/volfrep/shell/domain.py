# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the lattice of a part fills: all of it, or what its skin leaves."""

from __future__ import annotations

from dataclasses import dataclass

from ..design.openings import open_surface, open_triangles
from ..design.spec_parts import Skin
from ..mesh.booleans import intersection
from ..mesh.triangle_mesh import TriangleMesh
from ..util.progress import Monitor
from .offset import TOLERANCE, inner_wall


@dataclass(frozen=True, eq=False)
class Domain:
    """What the lattice fills.

    Attributes:
        mesh: its closed surface, inside the part or the part's own; empty where there is no room.
        wall: closed surface that cuts the lattice: the same, but it reaches out of the part
            beyond faces that are left open.
        openings: the faces that are left open; None where the skin is closed.
        warnings: sentences for the user about the skin.
    """

    mesh: TriangleMesh
    wall: TriangleMesh
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
    is_open = open_triangles(solid, skin.open_faces) if skin.open_faces else None
    monitor.count("walls found", 1)
    found = inner_wall(solid, skin.thickness, monitor, is_open)
    warnings: tuple[str, ...] = ()
    if found.worst > TOLERANCE:
        x, y, z = found.place
        warnings = (
            f"The skin is up to {found.worst:.0%} off its thickness near ({x:.4g}, {y:.4g}, "
            f"{z:.4g}), where the room between two skins is narrow.",
        )
    if is_open is None or not len(found.mesh.triangles):
        return Domain(found.mesh, found.mesh, warnings=warnings)
    trimmed = monitor.call(lambda: intersection(found.mesh, solid))
    return Domain(trimmed, found.mesh, open_surface(solid, is_open), warnings)
