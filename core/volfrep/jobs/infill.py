# SPDX-License-Identifier: LGPL-2.1-or-later
"""The stages from a solid to a part, lazily: domain, active cells, struts, lattice, part, beams.

Each is computed when it is asked for, and kept.
"""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import replace
from functools import cached_property

from ..design.spec import LatticeSpec
from ..grid.placement import Placement
from ..grid.strut_graph import BeamModel, Wireframe
from ..mesh.quality import inspect
from ..mesh.triangle_mesh import TriangleMesh
from ..process.pool import backend_of
from ..reports.result import Result, report_of
from ..shell.domain import Domain
from ..trim.beam_model import deformed_struts, part_beams, reaching_into, refuse_fillets
from ..trim.boolean_trim import Ahead
from ..trim.clip_struts import Clipped
from ..trim.drains import Drained, trapped_warnings
from ..trim.finish import finish, piece_warnings
from ..trim.kept_struts import KeptStruts, axes_of, find_kept_struts
from ..trim.loose_pieces import Cleared
from ..trim.prune import Pruned
from ..trim.stage import drained_part
from ..util.cache import Kept, StageCache
from ..util.content import content_of
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.types import Bools
from .active_cells import ActiveCells
from .kinds import lattice_kind
from .part_domain import PartDomain


class Infill:
    """A solid filled with a lattice, stage by stage.

    Every stage is an attribute: `domain`, `cells`, `struts`, `lattice`, `part`, `beams`, `axes`,
    computed when first asked for, with those that it needs, and kept; all lie where the part lies.

    Args:
        solid: checked closed mesh (from `volfrep.io.solid.read_solid` or `check_solid`), mm.
        spec: what to fill it with.
        cache: keeps the costly stages for other infills, as of the same solid with other struts.
        progress: called with the fraction done and the stage; returning False cancels.
        monitor: of a job that this is a part of, in place of one of its own.
        executor: cuts the lattice at the wall, group by group; None: in this process.
        streamed: whether its mesh is never asked for, but an STL file.

    Attributes:
        solid: the part.
        spec: what was asked for.
        monitor: times every stage that was run so far, and counts its work.
        kind: what the kind of lattice does.
        part_domain: what it fills.
        filling: the lattice in it.
        ahead: told which octants a file may begin with (`trim.boolean_trim.trim`); None: nobody.

    Raises:
        VolfrepError: cells larger than the part. Every stage raises it where the specification
            does not fit the solid, and says what to change; and `Cancelled`.

    >>> import numpy as np
    >>> import trimesh
    >>> box = trimesh.creation.box((24, 16, 16))
    >>> solid = TriangleMesh(box.vertices, box.faces.astype(np.int32))
    >>> infill = Infill(solid, LatticeSpec("BCC", cell_size=8, strut_radius=0.8, shell=1))
    >>> round(infill.domain.mesh.volume), len(infill.struts.struts)  # 22 x 14 x 14 within the skin
    (4312, 171)
    """

    def __init__(
        self,
        solid: TriangleMesh,
        spec: LatticeSpec,
        *,
        cache: StageCache | None = None,
        progress: ProgressCallback | None = None,
        monitor: Monitor | None = None,
        executor: Executor | None = None,
        streamed: bool = False,
    ) -> None:
        kind = lattice_kind(spec)
        kind.refuse(solid)
        monitor = monitor or Monitor(progress)
        monitor.backend = backend_of(executor)
        self.solid, self.spec, self.monitor, self.kind = solid, spec, monitor, kind
        self.part_domain = PartDomain(
            solid, spec, monitor, cache or StageCache(), executor, streamed=streamed
        )
        self.filling = kind.fill(self.part_domain)
        self._kept_struts: dict[bool, KeptStruts] = {}
        self.ahead: Ahead | None = None

    @property
    def result(self) -> Result:
        """The stage that the specification's output names: part, lattice or domain."""
        if self.spec.output == "domain":
            return self.cavity_result
        return self.part if self.spec.output == "part" else self.lattice

    @property
    def domain(self) -> Domain:
        """What the lattice fills, with what is to be said of the skin about it."""
        return self.part_domain.domain

    @property
    def cavity(self) -> TriangleMesh:
        """The domain's surface as a file can hold it: float32 takes no triangle of it."""
        return self.part_domain.cavity

    @property
    def placement(self) -> Placement:
        """Where the lattice lies in the part."""
        return self.part_domain.placement

    @property
    def cells(self) -> ActiveCells | None:
        """Which cells hold a lattice; None where it has no cells."""
        return self.filling.cells

    @property
    def pruned(self) -> Pruned | None:
        """What is left when struts with a free end are taken away; None where none are."""
        return self.filling.pruned

    @property
    def struts(self) -> Wireframe:
        """The lattice's nodes and struts, whole, where its mesh has them; of walls none."""
        return self.filling.struts

    @cached_property
    def cavity_result(self) -> Result:
        """The domain as a mesh, with the figures of the cells and struts that it will hold."""
        return self._reported("domain", Cleared(*self.part_domain.finished_cavity[:2], 0, 0))

    @cached_property
    def lattice(self) -> Result:
        """The lattice without the skin: trimmed to its domain, or its cells whole."""
        self.filling.mesh(is_cut=self.spec.ending.is_trimmed)
        with self.monitor.stage("trim", 0.6, 1.0):
            cleared = self.filling.trim(with_skin=False, ahead=self.ahead)
        return self._reported("lattice", cleared)

    @cached_property
    def part(self) -> Result:
        """Skin and lattice in one; without a skin, the lattice trimmed at the part's surface."""
        skin, drains, drained = self.spec.skin, self.spec.drains, None
        if skin is None:
            return self.lattice
        self.filling.mesh(is_cut=True)
        with self.monitor.stage("trim", 0.6, 1.0):
            cleared = self.filling.trim(with_skin=True, ahead=self.ahead)
            if drains is not None:
                cleared, drained = drained_part(
                    cleared, self.solid, self.domain, self.struts, skin, drains,
                    self.filling.smallest, self.monitor,
                )  # fmt: skip
        return self._reported("part", cleared, drained)

    @property
    def beams(self) -> BeamModel:
        """What the specification's output names, with the lattice as beams; nothing is meshed."""
        if self.spec.output == "domain":
            raise VolfrepError(
                "The output 'domain' holds no lattice to write as beams: choose part or lattice."
            )
        return self.part_beams if self.spec.output == "part" else self.lattice_beams

    @cached_property
    def part_beams(self) -> BeamModel:
        """The part, with its lattice as beams."""
        if self.spec.skin is None:
            return self.lattice_beams
        self._refuse_beams()
        kept, drains = self._kept(is_cut=True), self.spec.drains
        struts = self._reaching_into(self.solid, kept)
        made = part_beams(self.solid, self.cavity, struts, self.spec.skin, drains, self.monitor)
        warnings = self._beam_warnings + made.warnings
        return replace(made, warnings=warnings, loose=kept.notes)

    @cached_property
    def lattice_beams(self) -> BeamModel:
        """The lattice as beams, without a skin."""
        self._refuse_beams()
        kept, clip_at = self._kept(is_cut=self.spec.ending.is_trimmed), None
        if self.spec.ending.is_trimmed:
            clip_at = self.solid if self.spec.skin is None else self.cavity
            struts = self._reaching_into(clip_at, kept)
        else:
            struts = kept.without_loose(self.struts)
        return BeamModel(struts, clip_at, warnings=self._beam_warnings, loose=kept.notes)

    @cached_property
    def axes(self) -> Clipped:
        """The struts' axes, cut where they leave the domain."""
        self.kind.refuse_beams()
        is_cut = self.placement.is_cut
        boundary = self.cavity if is_cut else None
        return axes_of(self.struts, boundary, self._kept(is_cut=is_cut), self.domain.openings)

    @property
    def staying(self) -> Bools:
        """(m,) which of the struts the part has: those that hang on something."""
        return self._kept(is_cut=self.placement.is_cut).whole(self.struts)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be said of the solid, its skin and its cells."""
        return self.part_domain.warnings + self.filling.warnings

    @property
    def _beam_warnings(self) -> tuple[str, ...]:
        return self.warnings + deformed_struts(self.spec.grid, self.spec.struts)

    def _reaching_into(self, wall: TriangleMesh, kept: KeptStruts) -> Wireframe:
        """The struts that stay and reach into a closed mesh about the domain or at its wall."""
        struts = kept.without_loose(self.struts)
        inside = kept.inside(self.struts)[kept.whole(self.struts)]
        return reaching_into(struts, wall, inside)

    def _refuse_beams(self) -> None:
        self.kind.refuse_beams()
        refuse_fillets(self.spec.struts)

    def _kept(self, *, is_cut: bool) -> KeptStruts:
        """Which pieces of the struts stay, where a wall cuts them or where they are whole."""
        if is_cut not in self._kept_struts:
            struts, domain = self.struts, self.part_domain.kept_domain
            frame = content_of(struts.nodes, struts.struts, struts.radii, struts.joint_radii)
            self._kept_struts[is_cut] = self.part_domain.cache.run(
                "cut struts" if is_cut else "whole struts", _kept_struts,
                Kept(struts, frame), Kept(self.cavity, domain.key) if is_cut else None,
                self.spec.skin is not None, max(1, inspect(self.solid).quality.bodies),
                Kept(self.domain.openings, domain.key), self.spec.keep_pieces,
            ).value  # fmt: skip
        return self._kept_struts[is_cut]

    def _reported(self, output: str, cleared: Cleared, drained: Drained | None = None) -> Result:
        """A mesh with the figures of what it is and of how it was made."""
        domain, pruned, warnings = self.domain, self.pruned, self.warnings
        surface, quality, cells = cleared.surface, cleared.quality, self.cells
        if output == "domain":
            warnings += self.part_domain.finished_cavity[2]
        else:
            with self.monitor.stage("check", 1.0, 1.0):
                surface, quality, notes = finish(
                    surface, quality, self.monitor, self.filling.is_deformed, least=cleared.least
                )
            warnings += self.filling.notes + notes
        if output == "lattice":
            warnings += piece_warnings(
                quality, cleared.pieces_removed, cleared.volume_removed,
                is_in_skin=self.spec.skin is not None,
            )  # fmt: skip
        volume = domain.mesh.volume
        skin_volume = self.solid.volume - volume if output == "part" else 0.0
        if drained is not None:
            warnings += drained.warnings
            skin_volume -= drained.volume
        elif domain.is_open:
            warnings += trapped_warnings(quality.voids)
        removed = {
            "struts_dangling_removed": pruned.left.dangling if pruned is not None else 0,
            "stubs_removed": pruned.left.stubs if pruned is not None else 0,
            "thin_struts_removed": pruned.left.thin if pruned is not None else 0,
            "flat_struts_removed": pruned.left.flat if pruned is not None else 0,
            "pieces_removed": cleared.pieces_removed,
            "specks_removed": cleared.specks_removed,
            "drain_holes": drained.places if drained is not None else (),
        }
        report = report_of(
            quality, self.struts, None if cells is None else cells.padded.cells,
            None if cells is None else cells.active, self.placement, self.spec, self.monitor,
            domain_volume=volume, skin_volume=skin_volume, warnings=warnings, removed=removed,
        )  # fmt: skip
        if self.spec.skin is not None or "domain" in (output, self.spec.output):
            report = replace(report, spec={**report.spec, "output": output})
        if output != "domain":
            report = self.kind.with_target(report)
        return Result(surface, self.struts, report)


def _kept_struts(
    struts: Wireframe,
    wall: TriangleMesh | None,
    has_skin: bool,
    bodies: int,
    openings: TriangleMesh | None,
    keep_all: bool,
) -> KeptStruts:
    """As `find_kept_struts`, as a stage."""
    return find_kept_struts(
        struts, wall, has_skin=has_skin, bodies=bodies, openings=openings, keep_all=keep_all
    )
