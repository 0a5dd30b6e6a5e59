# SPDX-License-Identifier: LGPL-2.1-or-later
"""A surface and what will change in it: it is made once, with all that goes for other reasons."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..mesh.float32_repair import NO_REPAIR, Repair
from ..mesh.open_shells import OpenShells, keeps_border, quality_after_repair
from ..mesh.quality import Quality
from ..util.parallel import ParallelBackend
from ..util.progress import Monitor
from ..util.types import Bools, Floats, Ints
from .trimmed_surface import JoinedInspection, TrimmedSurface


@dataclass(frozen=True, eq=False)
class MendedSurface:
    """A closed surface of which a few triangles are to go, with others in their place.

    Attributes:
        surface: as it is.
        repair: of its mesh.
        beside: triangles of the mesh that stay and share a vertex with new ones.
        shells: of what the repair leaves; None: not known.
    """

    surface: TrimmedSurface
    repair: Repair = NO_REPAIR
    beside: Ints = field(default_factory=lambda: np.zeros(0, np.int64))
    shells: OpenShells | None = None

    def inspected(self, monitor: Monitor) -> JoinedInspection:
        """As of `TrimmedSurface`, of what the repair leaves; shells are told as of its mesh.

        Bounds are those of the surface as it is.
        """
        if len(self.repair.old) and self.shells is None:
            raise ValueError("the shells of what the repair leaves are not known")
        return self.surface.inspected(monitor, self.shells)

    @property
    def is_joined_as_before(self) -> bool:
        """Whether the octants follow on what the repair leaves as they do on the surface.

        False also where only a look at all of their rim would tell.
        """
        surface, repair = self.surface, self.repair
        if surface.octants is None:
            return True
        elsewhere = np.concatenate([repair.moved, repair.unused])
        if np.isin(elsewhere, surface.rows_about_rim).any():
            return False
        return keeps_border(surface.mesh, repair, self.beside)

    def quality_after(self, quality: Quality, bounds: Floats, least: float) -> Quality | None:
        """As of `quality_after_repair`."""
        mesh, repair, beside = self.surface.mesh, self.repair, self.beside
        return quality_after_repair(quality, mesh, repair, beside, bounds, least)

    def applied(
        self,
        goes: Bools | None = None,
        piece_goes: Bools | None = None,
        backend: ParallelBackend | None = None,
    ) -> TrimmedSurface:
        """The surface that is left; the same one where nothing changes.

        Args:
            goes: (m,) bool, triangles of the mesh of whole shells that go, too; None: none.
            piece_goes: (p,) bool, the same of those that come.
            backend: as of `Repair.applied`.
        """
        surface, repair, looks = self.surface, self.repair, self.surface.looks
        if goes is None or piece_goes is None:
            if not len(repair.old):
                return surface
            goes = piece_goes = None
        mesh, number = repair.applied(surface.mesh, goes, piece_goes, backend)
        if looks is not None:
            stays, piece_stays = repair.stays(surface.mesh), np.ones(len(repair.piece), bool)
            if goes is not None and piece_goes is not None:
                stays, piece_stays = stays & ~goes, ~piece_goes
            looks = looks.repaired(repair, stays, self.beside, piece_stays)
        return surface.on(mesh, looks, number.take)
