# SPDX-License-Identifier: LGPL-2.1-or-later
"""From active cells to the lattice in its part: octants meshed, laid, cut, cleared."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..design.cells import UnitCell
from ..design.memory_guard import cells_are_full
from ..design.spec import LatticeSpec
from ..grid.placement import Placement
from ..grid.strut_graph import CellGraph, Wireframe
from ..lattice.assembly import Layout, facets, refuse_solid_cells, refuse_too_large, used_kinds
from ..lattice.padded_grid import PaddedGrid, keeps_places, vertices_of
from ..lattice.strut_masks import without_struts
from ..mesh.booleans import difference, intersection
from ..mesh.float32_repair import shortest_edge
from ..mesh.quality import combined, inspect, measure
from ..mesh.triangle_mesh import TriangleMesh, compact, concatenate
from ..octants.octant import OctantKey
from ..octants.octant_mesh import Octant, mesh_octants, octant_spec
from ..shell.domain import Domain
from ..spatial.proximity import closest_points
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.progress import Monitor
from ..util.types import Bools, Floats
from .boolean_trim import (
    Cleared,
    KeptOctants,
    clear,
    cull,
    keep_all,
    octant_roles,
    smallest_shell,
    trim,
)
from .drains import Drained, drain
from .finish import tidied
from .prune import Pruned

#: Octants on moved struts mostly reach no farther out of their places than this, in units of
#: their edges. Where they do, they are looked for so many times as far as the last ones reached.
FIRST_MARGIN = 0.05
SPARE_MARGIN = 1.05
#: So often the octants are laid anew because struts reach farther out than was thought.
MOST_LAYINGS = 12
#: Less of a domain than this is no lattice.
NO_LATTICE = 1e-6


@dataclass(frozen=True, eq=False)
class Output:
    """What comes out of a trimming.

    Attributes:
        cleared: the mesh, its quality, and what was removed from it.
        drained: its drain holes; None where none were asked for.
    """

    cleared: Cleared
    drained: Drained | None


@dataclass(frozen=True, eq=False)
class TrimStage:
    """From active cells to the trimmed lattice.

    Attributes:
        solid: the part.
        domain: what the lattice fills.
        cell: the unit cell.
        spec: what is wanted.
        placement: the setting of a graded lattice.
        padded: the cells that the lattice may be laid on.
        active: (nx, ny, nz) bool, those that hold one.
        pruned: what is left when struts are taken away; None where none is.
        key: of all that the active cells depend on.
    """

    solid: TriangleMesh
    domain: Domain
    cell: UnitCell
    spec: LatticeSpec
    placement: Placement
    padded: PaddedGrid
    active: Bools
    pruned: Pruned | None
    key: object

    def octants(
        self, margin: float, cache: StageCache, monitor: Monitor
    ) -> tuple[KeptOctants, dict[OctantKey, Octant]]:
        """Which octants there are, and their meshes."""
        spec, cells = self.spec, self.padded.cells
        tile = octant_spec(spec)
        grid = self.padded.octants(self.cell, self.active, spec.is_endless)
        if spec.is_cut:
            roles = cache.get(
                "octants",
                (self.key, margin),
                lambda: octant_roles(
                    self.domain.wall, cells, monitor, self.placement.mapping, margin
                ),
            )
            kept = cull(grid, roles)
        else:
            kept = keep_all(grid)
        if self.pruned is not None:
            fewer = without_struts(
                kept.grid, self.cell, self.pruned.graph, self.pruned.left.kept, tile.influence,
                joined=not keeps_places(spec, self.placement),
            )  # fmt: skip
            kept = replace(kept, grid=used_kinds(fewer))
        keys = kept.grid.keys
        octants = cache.get(
            "tile",
            (cell_key(self.cell), tile, tuple(keys)),
            lambda: mesh_octants(self.cell, tile, keys, monitor),
        )
        refuse_solid_cells(octants, spec)
        refuse_too_large(spec, kept.grid, octants, kept.border)
        return kept, octants

    def lay(
        self,
        kept: KeptOctants,
        octants: dict[OctantKey, Octant],
        margin: float,
        cache: StageCache,
        monitor: Monitor,
    ) -> tuple[KeptOctants, Layout, Floats]:
        """The octants laid where the struts are; with more of them, where struts reach far out."""
        for _ in range(MOST_LAYINGS):
            layout = kept.lay_out(octants)
            placed = vertices_of(
                layout, self._graph,
                self.cell, self.spec, octant_spec(self.spec), self.placement, monitor,
            )  # fmt: skip
            if placed.excess <= margin + 1e-9:
                return kept, layout, placed.vertices
            margin = SPARE_MARGIN * placed.excess
            kept, octants = self.octants(margin, cache, monitor)
        raise VolfrepError(
            f"The grading moves struts by {placed.excess:.3g} mm and more out of their cells, each "
            "time farther where more of them are kept: make it change more slowly."
        )

    def _graph(self) -> CellGraph:
        """The nodes and struts that the octants hang on."""
        if self.pruned is not None:
            return self.pruned.left_graph
        return self.padded.graph(self.cell, self.active, self.spec.is_endless)

    def output(
        self, kept: KeptOctants, layout: Layout, points: Floats, frame: Wireframe, monitor: Monitor
    ) -> Output:
        """The part or the lattice, without loose pieces and slivers, and its quality."""
        spec, solid = self.spec, self.solid
        if not spec.is_cut:
            return self._uncut(layout, points, monitor)
        with_skin = spec.output == "part" and spec.shell > 0
        wall = self.domain.wall
        trimmed = trim(wall, kept, layout, points, cavity=with_skin, monitor=monitor)
        mesh, cut, removed, lost = trimmed.mesh, trimmed.cut, 0, 0.0
        smallest, precision = smallest_shell(spec), shortest_edge(solid)
        if spec.output == "lattice" and spec.shell > 0:
            on_wall = np.flatnonzero(trimmed.on_wall)
            held = clear(mesh, inspect(mesh, monitor), smallest, keep=on_wall)
            mesh, cut = held.mesh, len(held.mesh.triangles)
            removed, lost = held.pieces_removed, held.volume_removed
            if removed and not len(mesh.triangles):
                raise _nothing_holds()
        mesh = tidied(mesh, precision, monitor, cut)
        found = inspect(mesh, monitor)
        bodies = 0
        if spec.shell == 0:
            bodies = max(1, inspect(solid).quality.bodies)
        cleared = clear(mesh, found, smallest, floating=with_skin, bodies=bodies)
        if not len(cleared.mesh.triangles):
            if with_skin:
                raise cells_are_full(spec)
            raise VolfrepError(
                "No strut lies inside the part: reduce the cell size or move the origin."
            )
        if with_skin and cleared.mesh is not mesh:
            # The cavity's surface counts as negative: what is left may be its wall only.
            cavity = wall.volume
            if cavity + cleared.quality.volume < NO_LATTICE * cavity:
                raise _nothing_holds()
        cleared = replace(
            cleared,
            pieces_removed=cleared.pieces_removed + removed,
            volume_removed=cleared.volume_removed + lost,
        )
        if self.domain.openings is not None:
            cleared = self._opened(cleared, self.domain.openings, with_skin, monitor)
        elif with_skin:
            whole = concatenate(solid, cleared.mesh)
            quality = combined(measure(solid), cleared.quality)
            cleared = replace(cleared, mesh=whole, quality=quality)
        if spec.drains is None:
            return Output(cleared, None)
        drained = drain(
            cleared.mesh, solid, self.domain.mesh, frame, spec.shell, spec.drains, monitor
        )
        clean = tidied(drained.mesh, precision, monitor)
        cleared = replace(cleared, mesh=clean, quality=measure(clean, monitor))
        return Output(cleared, replace(drained, mesh=clean))

    def _opened(
        self, cleared: Cleared, openings: TriangleMesh, with_skin: bool, monitor: Monitor
    ) -> Cleared:
        """The part, or its lattice, cut at its open faces, beyond which the cavity reaches."""
        solid, mesh = self.solid, cleared.mesh
        precision = shortest_edge(solid)
        if with_skin:
            void = mesh.reversed()
            mesh = monitor.call(lambda: difference(solid, void))
        else:
            lattice = mesh
            mesh = monitor.call(lambda: intersection(lattice, solid))
        mesh = tidied(mesh, precision, monitor)
        found, smallest = inspect(mesh, monitor), smallest_shell(self.spec)
        if with_skin:
            rest = clear(mesh, found, smallest, bodies=inspect(solid).quality.bodies)
        else:
            rest = clear(mesh, found, smallest, keep=self._on_skin(mesh, openings, precision))
        if not len(rest.mesh.triangles):
            raise _nothing_holds()
        return replace(
            rest,
            pieces_removed=cleared.pieces_removed + rest.pieces_removed,
            volume_removed=cleared.volume_removed + rest.volume_removed,
            specks_removed=cleared.specks_removed + rest.specks_removed,
        )

    def _on_skin(
        self, mesh: TriangleMesh, openings: TriangleMesh, precision: float
    ) -> NDArray[np.int64]:
        """The triangles of a lattice that lie on the wall, and not in an open face."""
        middle = mesh.vertices[mesh.triangles].mean(axis=1)
        near = np.flatnonzero(closest_points(self.domain.mesh, middle)[1] < precision)
        beyond = closest_points(openings, middle[near])[1] > precision
        return near[beyond]

    def _uncut(self, layout: Layout, points: Floats, monitor: Monitor) -> Output:
        """The lattice of whole cells as it is, without loose pieces, and its quality."""
        laid = compact(TriangleMesh(points, facets(layout, monitor)))
        mesh = tidied(laid, shortest_edge(laid), monitor)
        found = inspect(mesh, monitor)
        bodies = max(1, inspect(self.solid).quality.bodies)
        cleared = clear(mesh, found, smallest_shell(self.spec), bodies=bodies)
        return Output(cleared, None)


def _nothing_holds() -> VolfrepError:
    return VolfrepError(
        "No strut reaches the skin, so that nothing would hold the lattice: reduce the cell size "
        "or choose the activation 'touching'."
    )


def cell_key(cell: UnitCell) -> tuple[bytes, bytes]:
    """Tells a unit cell from any other."""
    return cell.nodes.tobytes(), cell.struts.tobytes()
