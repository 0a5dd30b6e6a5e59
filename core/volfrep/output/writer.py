# SPDX-License-Identifier: LGPL-2.1-or-later
"""What writes a form and what it reads: estimate, file, what is to be said of it."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

from ..design.spec import LatticeSpec
from ..grid.strut_graph import BeamModel, Wireframe
from ..mechanics.materials import Material
from ..mesh.triangle_mesh import TriangleMesh
from ..trim.trimmed_surface import TrimmedSurface
from ..util.progress import Monitor
from ..util.types import Bools
from .form import Form

if TYPE_CHECKING:
    from ..jobs.slices import Layers
    from ..reports.estimate import Estimate, ExportChoice


@dataclass(frozen=True, eq=False)
class Axes:
    """The axes of struts.

    Attributes:
        wireframe: nodes and struts, mm.
        on_boundary: (n,) bool, nodes at which a wall cuts them; None where none does.
        warnings: sentences for the user.
    """

    wireframe: Wireframe
    on_boundary: Bools | None
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class ExactStruts:
    """What exact surfaces are made of.

    Attributes:
        lattice: the struts, mm.
        inner: closed mesh at which they are cut; None for none.
        outer: closed mesh about it: what lies between is the skin. None for no skin.
    """

    lattice: Wireframe
    inner: TriangleMesh | None = None
    outer: TriangleMesh | None = None


class Source(Protocol):
    """What a writer reads, all in mm and in the part's place."""

    @property
    def spec(self) -> LatticeSpec:
        """What was made, with the radius of its target."""

    @property
    def choice(self) -> ExportChoice | None:
        """What whoever writes can change to make a file smaller; None where that is not known."""

    @property
    def monitor(self) -> Monitor:
        """Told the progress, asked for a cancel."""

    @property
    def surface(self) -> TrimmedSurface | TriangleMesh:
        """The part's, perhaps with octants beside its mesh."""

    @property
    def mesh(self) -> TriangleMesh:
        """The same as one mesh."""

    @property
    def triangles(self) -> int:
        """Of the surface."""

    @property
    def figures(self) -> Mapping[str, str]:
        """What a file may keep of the run."""

    @property
    def executor(self) -> Executor | None:
        """Helps to write; None: nobody."""

    @property
    def volume(self) -> float:
        """Of the mesh, mm3."""

    @property
    def beams(self) -> BeamModel:
        """The lattice as beams."""

    @property
    def axes(self) -> Axes:
        """The struts' axes, cut where they leave the part."""

    @property
    def exact(self) -> ExactStruts:
        """What exact surfaces are made of."""

    @property
    def sides(self) -> Wireframe | None:
        """The struts whose joints lie on the sides of a box; None where a wall cuts them."""

    @property
    def outside(self) -> TriangleMesh | None:
        """The surface that a deck's nodes are named by; None for a lattice in free space."""

    def layers(
        self, folder: str | os.PathLike[str], form: str, layer: float, pixel: float | None
    ) -> Layers:
        """Write layers along z."""


def say_nothing(estimate: Estimate) -> None:
    """Nobody is told what a file will take."""


@dataclass(frozen=True)
class Settings:
    """What some forms want to know beside the part.

    Attributes:
        material: of a solver's deck; its density gives the mass.
        layer: height of a layer, mm.
        pixel: edge of a pixel, mm; None for the height of a layer.
        tell: is told what a file will take, before it is made.
    """

    material: Material = field(default_factory=Material)
    layer: float | None = None
    pixel: float | None = None
    tell: Callable[[Estimate], None] = say_nothing


@dataclass(frozen=True)
class Written:
    """What is to be said of a file.

    Attributes:
        warnings: sentences for the user.
        rows: names and values for the user.
        made: what the writer made, where a caller may want it: `jobs.slices.Layers`.
    """

    warnings: tuple[str, ...] = ()
    rows: tuple[tuple[str, str], ...] = ()
    made: Any = None


class Writer:
    """How a form is written; each form's own class.

    Args:
        form: its row.
    """

    def __init__(self, form: Form) -> None:
        self.form = form

    def settle(self, source: Source) -> tuple[Writer, tuple[str, ...]]:
        """What writes this very part, known before it is meshed, and why if that is another form.

        Raises:
            VolfrepError: it cannot be written so.
        """
        return self, ()

    def estimate(self, source: Source) -> Estimate | None:
        """What the file will take; None where nobody would wonder.

        Raises:
            VolfrepError: absurdly much; the text names the nearest setting that fits.
        """
        return None

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """Write the part; an old file stays if anything goes wrong.

        Raises:
            VolfrepError: it cannot be written so, or the path cannot be.
            Cancelled: the source's monitor said so; no file is left behind.
        """
        raise NotImplementedError


def writer_of(form: Form) -> Writer:
    """What writes a form."""
    writer: Writer = load(form.writer)(form)
    return writer


def load(home: str) -> Any:
    """What a row of the table names by its module and its name, imported now."""
    module, _, name = home.partition(":")
    return getattr(import_module(module, __package__), name)
