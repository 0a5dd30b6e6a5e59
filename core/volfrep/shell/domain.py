# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the lattice of a part fills: all of it, or what its skin leaves."""

from __future__ import annotations

from dataclasses import dataclass

from ..design.openings import open_surface, open_triangles
from ..design.spec import LatticeSpec
from ..mesh.booleans import intersection
from ..mesh.triangle_mesh import TriangleMesh
from ..util.cache import StageCache
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
    """

    mesh: TriangleMesh
    wall: TriangleMesh
    openings: TriangleMesh | None = None

    @property
    def is_open(self) -> bool:
        """Whether faces of the part have no skin."""
        return self.openings is not None


def find_domain(
    solid: TriangleMesh, solid_key: str, spec: LatticeSpec, cache: StageCache, monitor: Monitor
) -> tuple[Domain, tuple[str, ...], tuple[object, ...]]:
    """The domain of a part, warnings about its skin, and a key of what it depends on.

    Args:
        solid: checked closed mesh, mm.
        solid_key: tells it from others.
        spec: thickness of the skin and open faces count.
        cache: keeps the inner wall.
        monitor: for progress and cancel.

    Raises:
        VolfrepError: an open face is not found, or the skin cannot be made.
    """
    if spec.shell == 0:
        return Domain(solid, solid), (), (solid_key, 0.0)
    is_open = open_triangles(solid, spec.open_faces) if spec.open_faces else None
    key = (solid_key, spec.shell, None if is_open is None else is_open.tobytes())

    def compute() -> tuple[Domain, tuple[str, ...]]:
        monitor.count("walls found", 1)
        found = inner_wall(solid, spec.shell, monitor, is_open)
        warnings: tuple[str, ...] = ()
        if found.worst > TOLERANCE:
            x, y, z = found.place
            warnings = (
                f"The skin is up to {found.worst:.0%} off its thickness near ({x:.4g}, {y:.4g}, "
                f"{z:.4g}), where the room between two skins is narrow.",
            )
        if is_open is None or not len(found.mesh.triangles):
            return Domain(found.mesh, found.mesh), warnings
        room = monitor.call(lambda: intersection(found.mesh, solid))
        return Domain(room, found.mesh, open_surface(solid, is_open)), warnings

    domain, warnings = cache.get("shell", key, compute)
    return domain, warnings, key
