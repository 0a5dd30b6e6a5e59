# SPDX-License-Identifier: LGPL-2.1-or-later
"""The stages from a solid to a part, lazily: domain, active cells, struts, lattice, part, beams.

Each is computed when it is asked for, and kept.
"""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from ..design.cells import UnitCell
from ..design.forecast import refuse_crossing
from ..design.memory_guard import refuse_expected
from ..design.spec import LatticeSpec
from ..grid.placement import Placement, graded_wireframe, placement_in
from ..grid.strut_graph import BeamModel, CellGraph, Wireframe, cell_graph
from ..io.solid import Solid
from ..lattice.assembly import Layout
from ..lattice.deform import Deformed
from ..lattice.padded_grid import keeps_places, least_width, vertices_of
from ..mesh.float32_repair import shortest_edge
from ..mesh.quality import Quality, inspect, measure
from ..mesh.triangle_mesh import TriangleMesh
from ..octants.octant import Octant, OctantKey
from ..octants.octant_mesh import mesh_octants, octant_spec
from ..octants.octant_spec import OctantSpec
from ..reports.result import Result, report_of
from ..shell.domain import Domain, find_domain
from ..trim.beam_model import deformed_struts, part_beams, reaching_into, refuse_fillets
from ..trim.boolean_trim import Ahead
from ..trim.clip_struts import Clipped
from ..trim.culling import KeptOctants, OctantRoles
from ..trim.drains import Drained, trapped_warnings
from ..trim.finish import finish, piece_warnings, tidy
from ..trim.kept_struts import KeptStruts, axes_of, find_kept_struts
from ..trim.loose_pieces import Cleared, smallest_shell
from ..trim.placed_lattice import FIRST_MARGIN, PlacedLattice, in_place, lay
from ..trim.prune import Pruned, prune
from ..trim.stage import chosen_octants, cut_lattice, drained_part, uncut_lattice
from ..trim.trimmed_surface import TrimmedSurface
from ..util.cache import Kept, StageCache
from ..util.content import content_of
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from ..util.types import Bools
from . import octant_guard as guard
from .active_cells import ActiveCells, find_active_cells, roles_of
from .finer import until_sound
from .target_report import report_target


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
        ahead: told which octants a file may begin with (`trim.boolean_trim.trim`); None: nobody.

    Raises:
        VolfrepError: cells larger than the part. Every stage raises it where the specification
            does not fit the solid, and says what to change; and `Cancelled`.

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
        guard.refuse_other_struts(solid, spec, is_of_cells=type(self) is Infill)
        self.solid, self.spec = solid, spec
        self.monitor = monitor or Monitor(progress)
        self._cache, self._executor = cache or StageCache(), executor
        self._streamed = streamed and spec.streams
        self._grid, self._struts = spec.grid, spec.struts
        self._skin, self._boundary = spec.skin, spec.ending
        if spec.network is None:
            self._meshing = self._wanted_meshing()
        self._solid = Kept(solid, content_of(solid.vertices, solid.triangles))
        self._watch = Kept(self.monitor, "no result depends on it")
        self._laid_octants: dict[bool, PlacedLattice] = {}
        self._held_struts: dict[bool, KeptStruts] = {}
        self._notes: tuple[str, ...] = ()
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
        return self._domain.value

    @cached_property
    def _domain(self) -> Kept[Domain]:
        with self.monitor.stage("shell", 0.0, 0.3):
            found = self._cache.run("shell", find_domain, self._solid, self._skin, self._watch)
        guard.refuse_no_domain(found.value.mesh, self.spec.shell, self._skin)
        return found

    @property
    def cavity(self) -> TriangleMesh:
        """The domain's surface as a file can hold it: float32 takes no triangle of it."""
        return self._cavity[0].mesh

    @cached_property
    def _cavity(self) -> tuple[TrimmedSurface, Quality, tuple[str, ...]]:
        wall = TrimmedSurface(self.domain.mesh)
        clean = tidy(wall, shortest_edge(self.solid), self.monitor)
        return finish(clean, measure(clean.mesh), self.monitor, moved=False)

    @cached_property
    def placement(self) -> Placement:
        """Where the lattice lies in the part."""
        is_cut = self._boundary.meets_wall(self._skin)
        return placement_in(self.solid, self._grid, is_cut, self.monitor)

    @property
    def cells(self) -> ActiveCells:
        """Which cells hold a lattice."""
        return self._cells.value

    @cached_property
    def _cells(self) -> Kept[ActiveCells]:
        domain, rule, least = self._domain, self._boundary.activation, 0.0
        with self.monitor.stage("voxels", 0.3, 0.4):
            if self._grid.cell_map is not None:
                least = self._least_width()
            found = self._cache.run(
                "voxels",
                find_active_cells,
                self._solid,
                domain,
                self._grid,
                rule,
                least,
                self._watch,
            )
        guard.refuse_no_cells(found.value.active, self._grid.size, rule)
        return found

    def _least_width(self) -> float:
        size, struts = self._grid.size, self._struts
        return self._cache.run("width", least_width, self._cell, size, struts).value

    def _wanted_meshing(self) -> OctantSpec:
        return octant_spec(self.spec.cell_size, self._struts, self.spec.detail)

    @property
    def _cell(self) -> UnitCell:
        return self.spec.unit_cell()

    @cached_property
    def _keeps_places(self) -> bool:
        return keeps_places(self._struts, self.placement)

    @cached_property
    def pruned(self) -> Pruned | None:
        """What is left when struts with a free end are taken away; None where none are."""
        if not self._boundary.removes_struts:
            return None
        return prune(
            self.cells.padded, self._cell, self.cells.active, self._struts, self._boundary,
            self.placement, self.domain, self._skin is not None,
        )  # fmt: skip

    @cached_property
    def struts(self) -> Wireframe:
        """The nodes and struts of the active cells, whole, where the lattice's mesh has them."""
        pruned = self.pruned
        if pruned is not None:
            frame = pruned.frame
        else:
            cells, size = self.cells.padded.cells, self._grid.size
            active = self.cells.active
            graph = cell_graph(self._cell, active, size, cells.origin, cells.periodic)
            frame = graded_wireframe(graph, self._struts, self.placement)
        guard.refuse_no_struts(frame)
        return frame

    @cached_property
    def cavity_result(self) -> Result:
        """The domain as a mesh, with the figures of the cells and struts that it will hold."""
        return self._reported("domain", Cleared(*self._cavity[:2], 0, 0))

    @cached_property
    def lattice(self) -> Result:
        """The lattice without the skin: trimmed to its domain, or its cells whole."""
        laid = self._laid(is_cut=self._boundary.is_trimmed)
        with self.monitor.stage("trim", 0.6, 1.0):
            cleared = self._cut(laid)
        return self._reported("lattice", cleared)

    @cached_property
    def part(self) -> Result:
        """Skin and lattice in one; without a skin, the lattice trimmed at the part's surface."""
        if self._skin is None:
            return self.lattice
        laid, frame = self._laid(is_cut=True), self.struts
        drained = None
        with self.monitor.stage("trim", 0.6, 1.0):
            cleared = self._cut(laid, with_skin=True)
            if self.spec.drains is not None:
                cleared, drained = drained_part(
                    cleared, self.solid, self.domain, frame, self._skin, self.spec.drains,
                    smallest_shell(self._meshing), self.monitor,
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
        if self._skin is None:
            return self.lattice_beams
        refuse_fillets(self._struts)
        kept, drains = self._held(is_cut=True), self.spec.drains
        struts = kept.without_loose(self.struts)
        made = part_beams(self.solid, self.cavity, struts, self._skin, drains, self.monitor)
        warnings = self._beam_warnings + made.warnings
        return replace(made, warnings=warnings, loose=kept.told)

    @cached_property
    def lattice_beams(self) -> BeamModel:
        """The lattice as beams, without a skin."""
        refuse_fillets(self._struts)
        kept, clip_at = self._held(is_cut=self._boundary.is_trimmed), None
        struts = kept.without_loose(self.struts)
        if self._boundary.is_trimmed:
            clip_at = self.solid if self._skin is None else self.cavity
            struts = reaching_into(struts, clip_at)
        return BeamModel(struts, clip_at, warnings=self._beam_warnings, loose=kept.told)

    @cached_property
    def axes(self) -> Clipped:
        """The struts' axes, cut where they leave the domain."""
        is_cut = self.placement.is_cut
        wall = self.cavity if is_cut else None
        return axes_of(self.struts, wall, self._held(is_cut=is_cut), self.domain.openings)

    @property
    def staying(self) -> Bools:
        """(m,) which of the struts the part has: those that hang on something."""
        return self._held(is_cut=self.placement.is_cut).whole(self.struts)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be said of the solid, its skin and its cells."""
        notes = self.solid.notes if isinstance(self.solid, Solid) else ()
        return notes + self.domain.warnings + self.cells.warnings

    @property
    def _beam_warnings(self) -> tuple[str, ...]:
        return self.warnings + deformed_struts(self._grid, self._struts)

    def _held(self, *, is_cut: bool) -> KeptStruts:
        """Which pieces of the struts stay, where a wall cuts them or where they are whole."""
        if is_cut not in self._held_struts:
            wall = self.cavity if is_cut else None
            self._held_struts[is_cut] = find_kept_struts(
                self.struts, wall, has_skin=self._skin is not None,
                bodies=max(1, inspect(self.solid).quality.bodies),
                openings=self.domain.openings, keep_all=self._boundary.keep_pieces,
            )  # fmt: skip
        return self._held_struts[is_cut]

    def _laid(self, *, is_cut: bool) -> PlacedLattice:
        """The octants laid in the part, as of a lattice that a wall cuts, or as they are."""
        if is_cut not in self._laid_octants:
            refuse_crossing(self.spec)
            refuse_expected(self.spec, 0.0 if self._streamed else self.domain.mesh.volume)
            _ = self.struts  # refused before anything is meshed
            motion = self.placement.motion if self._keeps_places else None
            # Where nothing is cut there is no wall that an octant could reach.
            margin = np.inf if not is_cut else 0.0 if self._keeps_places else FIRST_MARGIN
            with self.monitor.stage("tile", 0.4, 0.5):
                within = partial(self._octants, is_cut)
                first = within(margin)
            with self.monitor.stage("lattice", 0.5, 0.6):
                self._laid_octants[is_cut] = (
                    in_place(*first, motion)
                    if motion is not None
                    else lay(first, margin, within, self._placed, self.monitor)
                )
        return self._laid_octants[is_cut]

    def _octants(self, is_cut: bool, margin: float) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        """Which octants there are, and their meshes."""
        cells, roles = self.cells, self._roles(margin) if is_cut else None
        grid = cells.padded.octants(self._cell, cells.active, self._boundary.is_endless)
        joined = not self._keeps_places

        def meshed(wanted: OctantSpec) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
            kept = chosen_octants(grid, roles, self._cell, self.pruned, wanted, joined=joined)
            keys = tuple(kept.grid.keys)
            made = self._cache.run("tile", mesh_octants, self._cell, wanted, keys, self._watch)
            return kept, made.value

        (kept, octants), self._meshing, notes = until_sound(self._meshing, meshed)
        self._notes = notes + guard.deviation_warnings(octants, self._meshing)
        guard.refuse_solid_cells(octants, self._meshing)
        guard.refuse_too_large(self.spec, kept.grid, octants, kept.border, streamed=self._streamed)
        return kept, octants

    def _roles(self, margin: float) -> OctantRoles:
        on = self._solid, self._domain, self._cells, self._grid
        return self._cache.run("octants", roles_of, *on, margin, self._watch).value

    def _placed(self, layout: Layout) -> Deformed:
        """Where the vertices of numbered octants are in the part."""
        return vertices_of(
            layout, self._graph, self._cell, self._struts,
            self._meshing, self.placement, self.monitor,
        )  # fmt: skip

    def _graph(self) -> CellGraph:
        """The nodes and struts that the octants are bound to."""
        if self.pruned is not None:
            return self.pruned.left_graph
        return self.cells.padded.graph(self._cell, self.cells.active, self._boundary.is_endless)

    def _cut(self, laid: PlacedLattice, *, with_skin: bool = False) -> Cleared:
        keep = self._boundary.keep_pieces
        if not (with_skin or self._boundary.is_trimmed):
            return uncut_lattice(laid, self.solid, self._meshing, self.monitor, keep_pieces=keep)
        return cut_lattice(
            laid, self.solid, self.domain, self._meshing, self.monitor, keep_pieces=keep,
            has_skin=self._skin is not None, with_skin=with_skin, executor=self._executor,
            ahead=self.ahead,
        )  # fmt: skip

    def _reported(self, output: str, cleared: Cleared, drained: Drained | None = None) -> Result:
        """A mesh with the figures of what it is and of how it was made."""
        domain, pruned, warnings = self.domain, self.pruned, self.warnings
        surface, quality, moved = cleared.surface, cleared.quality, not self._keeps_places
        if output == "domain":
            warnings += self._cavity[2]
        else:
            with self.monitor.stage("check", 1.0, 1.0):
                surface, quality, notes = finish(surface, quality, self.monitor, moved)
            warnings += self._notes + notes
        if output == "lattice":
            warnings += piece_warnings(
                quality, cleared.pieces_removed, cleared.volume_removed,
                is_in_skin=self._skin is not None,
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
            "pieces_removed": cleared.pieces_removed,
            "specks_removed": cleared.specks_removed,
            "drain_holes": drained.places if drained is not None else (),
        }
        report = report_of(
            quality, self.struts, self.cells.padded.cells, self.cells.active,
            self.placement, self.spec, self.monitor,
            domain_volume=volume, skin_volume=skin_volume, warnings=warnings, removed=removed,
        )  # fmt: skip
        if self._skin is not None or "domain" in (output, self.spec.output):
            report = replace(report, spec={**report.spec, "output": output})
        if output != "domain":
            report = report_target(report, self.spec)
        return Result(surface, self.struts, report)
