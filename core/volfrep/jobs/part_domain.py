# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part before there is a lattice in it: what the lattice fills, and where it lies."""

from __future__ import annotations

from concurrent.futures import Executor
from functools import cached_property

from ..design.spec import LatticeSpec
from ..design.spec_parts import Skin
from ..grid.placement import Placement, placement_in
from ..io.solid import Solid
from ..mesh.float32_repair import shortest_edge
from ..mesh.quality import Quality, measure
from ..mesh.triangle_mesh import TriangleMesh
from ..shell.domain import Domain, find_domain
from ..trim.finish import finish, tidy
from ..trim.trimmed_surface import TrimmedSurface
from ..util.cache import Kept, StageCache
from ..util.content import content_of
from ..util.errors import VolfrepError
from ..util.progress import Monitor


class PartDomain:
    """A part, and the domain in it that a lattice fills; arguments as of `infill.Infill`.

    Attributes:
        solid: the part.
        spec: what it is to be filled with.
        monitor: of the job.
        cache: keeps the costly stages.
        executor: cuts the lattice at the wall; None: this process.
        streamed: whether the mesh is never asked for, but an STL file.
        watch: the monitor, as an input of a stage that no result depends on.
        kept_solid: the part as such an input.
    """

    def __init__(
        self,
        solid: TriangleMesh,
        spec: LatticeSpec,
        monitor: Monitor,
        cache: StageCache,
        executor: Executor | None,
        *,
        streamed: bool,
    ) -> None:
        self.solid, self.spec, self.monitor = solid, spec, monitor
        self.cache, self.executor = cache, executor
        self.streamed = streamed and spec.streams
        self.watch = Kept(monitor, "no result depends on it")
        self.kept_solid = Kept(solid, content_of(solid.vertices, solid.triangles))

    @property
    def domain(self) -> Domain:
        """What the lattice fills, with what is to be said of the skin about it."""
        return self.kept_domain.value

    @property
    def has_domain(self) -> bool:
        """Whether the domain was found already."""
        return "kept_domain" in self.__dict__

    @cached_property
    def kept_domain(self) -> Kept[Domain]:
        """The domain as the input of a stage."""
        skin = self.spec.skin
        with self.monitor.stage("shell", 0.0, 0.3):
            found = self.cache.run("shell", find_domain, self.kept_solid, skin, self.watch)
        _refuse_no_domain(found.value.mesh, self.spec.shell, skin)
        return found

    @property
    def cavity(self) -> TriangleMesh:
        """The domain's surface as a file can hold it: float32 takes no triangle of it."""
        return self.finished_cavity[0].mesh

    @cached_property
    def finished_cavity(self) -> tuple[TrimmedSurface, Quality, tuple[str, ...]]:
        """That surface, its quality, and what is to be said of it."""
        boundary = TrimmedSurface(self.domain.mesh)
        clean = tidy(boundary, shortest_edge(self.solid), self.monitor)
        return finish(clean, measure(clean.mesh), self.monitor, deformed=False)

    @cached_property
    def placement(self) -> Placement:
        """Where the lattice lies in the part."""
        is_cut = self.spec.ending.cuts_struts(self.spec.skin)
        return placement_in(self.solid, self.spec.grid, is_cut, self.monitor)

    @property
    def skin_volume(self) -> float:
        """Volume of the skin that is asked for with the lattice, mm3."""
        return self.spec.skin_volume(self.solid.volume, self.domain.mesh.volume)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be said of the solid and its skin."""
        notes = self.solid.notes if isinstance(self.solid, Solid) else ()
        return notes + self.domain.warnings


def _refuse_no_domain(domain: TriangleMesh, shell: float, skin: Skin | None) -> None:
    """Raise a `VolfrepError` where a skin of a thickness in mm leaves nothing to fill."""
    if not len(domain.triangles):
        if skin is not None and not skin.is_even:
            raise VolfrepError(
                "The skin and what is kept solid leave nothing to fill: reduce the skin "
                "thickness, that of faces with their own, or what is kept solid."
            )
        raise VolfrepError(
            f"The part is nowhere thicker than two skins of {shell:g} mm, so that nothing is left "
            "to fill: reduce the skin thickness."
        )
