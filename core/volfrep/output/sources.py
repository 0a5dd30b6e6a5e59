# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a form is written from: a filled part, a block, or a strut graph in free space.

Every attribute is made when it is first read, so that a form costs what it needs only.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ..design.spec import LatticeSpec
from ..grid.strut_graph import BeamModel, Wireframe
from ..io.solid import Solid
from ..mechanics.materials import Material
from ..mesh.triangle_mesh import TriangleMesh
from ..trim.trimmed_surface import TrimmedSurface
from ..util.errors import VolfrepError
from ..util.progress import Monitor, ProgressCallback
from .form import FORMS
from .writer import Axes, ExactStruts, Settings, Written, writer_of

if TYPE_CHECKING:
    from ..jobs.infill import Infill
    from ..jobs.kinds.kind import BlockLattice
    from ..jobs.slices import Layers
    from ..reports.estimate import ExportChoice
    from ..reports.result import Result
    from ..util.cache import StageCache


class _OfResult:
    """What a source has of its result; a subclass says what that is."""

    spec: LatticeSpec
    count: Sequence[int] | None = None

    @property
    def executor(self) -> Executor | None:
        """As of `Source`."""
        return None

    @property
    def result(self) -> Result:
        """The mesh and its figures."""
        raise NotImplementedError

    @property
    def surface(self) -> TrimmedSurface | TriangleMesh:
        """As of `Source`."""
        return self.result.surface

    @property
    def mesh(self) -> TriangleMesh:
        """As of `Source`."""
        return self.result.mesh

    @property
    def triangles(self) -> int:
        """As of `Source`."""
        return self.result.surface.triangles

    @property
    def figures(self) -> Mapping[str, str]:
        """As of `Source`."""
        return self.result.report.figures

    @property
    def volume(self) -> float:
        """As of `Source`."""
        return self.result.report.volume_mm3

    @property
    def choice(self) -> ExportChoice:
        """As of `Source`."""
        from ..reports.estimate import ExportChoice

        return ExportChoice(self.spec, self.count)


class FilledPart(_OfResult):
    """A filled solid.

    Args:
        infill: its stages.
        cache: keeps them for layers, whose radius is given then.
        progress: called with the fraction done and the stage; returning False cancels.
    """

    def __init__(
        self,
        infill: Infill,
        cache: StageCache | None = None,
        progress: ProgressCallback | None = None,
    ) -> None:
        self.infill, self._cache, self._progress = infill, cache, progress
        self.spec, self.solid = infill.spec, infill.solid
        self.monitor = Monitor(progress)

    @property
    def executor(self) -> Executor | None:
        """As of `Source`."""
        return self.infill.part_domain.executor

    @property
    def result(self) -> Result:
        """The mesh and its figures."""
        return self.infill.result

    @property
    def cavity(self) -> TriangleMesh | None:
        """The surface of what the lattice fills."""
        return self.infill.cavity

    @property
    def beams(self) -> BeamModel:
        """As of `Source`."""
        return self.infill.beams

    @property
    def axes(self) -> Axes:
        """As of `Source`."""
        cut = self.infill.axes
        return Axes(cut.wireframe, cut.on_boundary, cut.warnings)

    @property
    def exact(self) -> ExactStruts:
        """As of `Source`."""
        lattice = self.infill.lattice_beams.lattice
        if not self.spec.is_cut:
            return ExactStruts(lattice)
        outer = self.solid if self.spec.with_skin else None
        return ExactStruts(lattice, self.infill.cavity, outer)

    @property
    def sides(self) -> Wireframe | None:
        """As of `Source`."""
        return None if self.infill.placement.is_cut else self.result.wireframe

    @property
    def outside(self) -> TriangleMesh | None:
        """As of `Source`."""
        return self.infill.cavity if self.spec.output == "lattice" else self.solid

    def layers(
        self, folder: str | os.PathLike[str], form: str, layer: float, pixel: float | None
    ) -> Layers:
        """As of `Source`."""
        from ..jobs.slices import write_layers

        return write_layers(
            self.solid, replace(self.spec, target=None), folder, layer=layer, pixel=pixel,
            form=form, progress=self._progress, cache=self._cache,
        )  # fmt: skip


class Free(_OfResult):
    """A lattice in free space.

    Args:
        spec: what is made.
        progress: called with the fraction done and the stage; returning False cancels.
    """

    cavity: TriangleMesh | None = None
    solid: Solid | None = None

    def __init__(self, spec: LatticeSpec, progress: ProgressCallback | None = None) -> None:
        self.spec, self._progress = spec, progress
        self.monitor = Monitor(progress)

    @property
    def exact(self) -> ExactStruts:
        """As of `Source`."""
        return ExactStruts(self.result.wireframe)

    @property
    def sides(self) -> Wireframe | None:
        """As of `Source`."""
        return self.result.wireframe

    @property
    def outside(self) -> TriangleMesh | None:
        """As of `Source`."""
        return None

    def layers(
        self, folder: str | os.PathLike[str], form: str, layer: float, pixel: float | None
    ) -> Layers:
        """As of `Source`.

        Raises:
            VolfrepError: always.
        """
        raise VolfrepError(
            "Layers are cut of a filled part: fill a box, or write the mesh and slice it with the "
            "printer's own program."
        )


class Block(Free):
    """A free-standing block.

    Args:
        made: it, with the radius of its target.
        progress: as of `FilledPart`.
    """

    def __init__(self, made: BlockLattice, progress: ProgressCallback | None = None) -> None:
        super().__init__(made.spec, progress)
        self._made = made
        self.count = made.count

    @cached_property
    def result(self) -> Result:
        """The mesh and its figures."""
        return self._made.result(Monitor(self._progress))

    @property
    def beams(self) -> BeamModel:
        """As of `Source`."""
        from ..jobs.beam_part import block_beams

        return block_beams(self.spec, self._made.count)

    @property
    def axes(self) -> Axes:
        """As of `Source`."""
        return Axes(self._made.wireframe(), None)


class FreeGraph(Free):
    """A strut graph as it is, in free space."""

    @cached_property
    def result(self) -> Result:
        """The mesh and its figures."""
        from ..jobs.kinds.graphs import mesh_graph_alone

        return mesh_graph_alone(self.spec, progress=self._progress)

    @property
    def beams(self) -> BeamModel:
        """As of `Source`."""
        return BeamModel(self._wireframe)

    @property
    def axes(self) -> Axes:
        """As of `Source`."""
        return Axes(self._wireframe, None)

    @property
    def _wireframe(self) -> Wireframe:
        from ..jobs.kinds.graphs import frame_alone

        return frame_alone(self.spec)[0]


@dataclass(frozen=True, eq=False)
class Given:
    """A part whose pieces are there already, as FreeCAD has them; None for those not needed.

    Attributes: as of `Source`; `progress` is told, and asked for a cancel.
    """

    spec: Any = None
    choice: ExportChoice | None = None
    mesh: Any = None
    triangles: int = 0
    figures: Mapping[str, str] = field(default_factory=dict)
    volume: float = 0.0
    beams: Any = None
    axes: Any = None
    exact: Any = None
    sides: Wireframe | None = None
    outside: TriangleMesh | None = None
    progress: ProgressCallback | None = None
    executor: Executor | None = None

    @property
    def monitor(self) -> Monitor:
        """As of `Source`."""
        return Monitor(self.progress)

    @property
    def surface(self) -> TriangleMesh:
        """As of `Source`."""
        mesh: TriangleMesh = self.mesh
        return mesh

    def layers(
        self, folder: str | os.PathLike[str], form: str, layer: float, pixel: float | None
    ) -> Layers:
        """As of `Source`.

        Raises:
            VolfrepError: always.
        """
        raise VolfrepError("Layers are cut of a solid, and this is a mesh: fill its solid.")


def write_given(
    name: str,
    given: Given,
    path: str | os.PathLike[str],
    material: Material | None = None,
    *,
    progress: ProgressCallback | None = None,
) -> Written:
    """Write pieces in the form of a name, as another process is asked to.

    Raises:
        VolfrepError: as the form's `Writer`.
        Cancelled: the callback said so; no file is left behind.
    """
    form = next(form for form in FORMS if form.name == name)
    settings = Settings() if material is None else Settings(material)
    return writer_of(form).write(replace(given, progress=progress), path, settings)
