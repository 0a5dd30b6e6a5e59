# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lattices that are meshed as one surface, which the wall of a part cuts as a whole."""

from __future__ import annotations

from abc import abstractmethod

from ...mesh.float32_repair import shortest_edge
from ...mesh.triangle_mesh import TriangleMesh
from ...trim.boolean_trim import Ahead, Trimmed
from ...trim.finish import tidy
from ...trim.group_cut import cut_mesh
from ...trim.loose_pieces import Cleared, clear
from ...trim.stage import cleared_cut
from ...trim.trimmed_surface import TrimmedSurface
from ...util.errors import VolfrepError
from ...util.progress import Monitor
from .kind import PartLattice


class SurfaceLattice(PartLattice):
    """A lattice whose surface is one mesh before it is cut."""

    @property
    @abstractmethod
    def surface(self) -> TriangleMesh:
        """The lattice, closed, nothing cut; made once."""

    @property
    def is_deformed(self) -> bool:
        """Whether its vertices are elsewhere than they were meshed: they are not."""
        return False

    def mesh(self, *, is_cut: bool) -> None:
        """Mesh it."""
        _ = self.surface

    def trim(self, *, with_skin: bool, ahead: Ahead | None) -> Cleared:
        """What the wall leaves of it, joined to the skin or not."""
        spec, part = self.spec, self.part
        if not (with_skin or spec.ending.is_trimmed):
            return uncut(self.surface, self.smallest, self.monitor)
        full = VolfrepError(
            "The struts fill the whole part: make them thinner, or take fewer of them."
        )
        boundary = part.domain.boundary
        mesh, on_boundary = cut_mesh(boundary, self.surface, cavity=with_skin, monitor=self.monitor)
        trimmed = Trimmed(TrimmedSurface(mesh), on_boundary)
        return cleared_cut(
            trimmed, part.solid, part.domain, self.smallest, full, self.monitor,
            has_skin=spec.skin is not None, with_skin=with_skin, keep_pieces=spec.keep_pieces,
        )  # fmt: skip


def uncut(mesh: TriangleMesh, smallest: float, monitor: Monitor) -> Cleared:
    """A lattice that nothing cuts, without slivers and shells below a volume in mm3."""
    surface = tidy(TrimmedSurface(mesh), shortest_edge(mesh), monitor)
    return clear(surface, smallest, monitor)
