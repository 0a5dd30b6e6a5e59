# SPDX-License-Identifier: LGPL-2.1-or-later
"""A slicer's own infill whose density follows a field: what is wanted of it, in percent.

A slicer knows one density for a part, and others within modifiers. So the field is cut into a few
bands, each with the mean density that the field has in it.
"""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..util.arguments import check_kind
from ..util.errors import VolfrepError, brief
from ..util.numbers import number, whole
from ..util.types import Floats
from .banded_words import GRADINGS, PATTERNS
from .grading import Field, RadiusGrading, Vector, read_point_field
from .profile import Profile
from .sampled_field import SampledField, sample_function
from .scattered_field import read_curve

#: Slicers refuse sparse patterns that are as good as solid.
MOST = 95.0
FEWEST_BANDS, MOST_BANDS = 2, 8
#: Ends of lines are joined along walls where they are so close, mm, and have hooks so long else:
#: of PrusaSlicer's own profiles; files say so, since narrow bands get much of their filament there.
JOINED, HOOKED = 12.0, 2.5


@dataclass(frozen=True)
class BandedInfill:
    """Densities, and how the slicer is to print the part.

    Attributes:
        grading: what the density follows: ``skin`` (the depth: s = 1 at the surface, 0 at `reach`
            and deeper), ``core`` (the reverse), ``direction`` (s from 0 to 1 along it), ``field``,
            or ``formula``.
        start: density in percent at s = 0, or where the field is smallest.
        end: the same at s = 1, or where the field is largest.
        profile: between them, of `profile.KINDS` with two ends.
        reach: depth at which the grading ends, mm.
        direction: of any length.
        field: values at points; or the CSV or VTK file that holds them.
        column: which values of the file.
        curve: value:density pairs in place of start and end, as "0:10,80:60".
        formula: of x, y and z in mm; gives percent.
        bands: at most; there are fewer where most would be narrower than 3.3 lines, and bands with
            nothing in them are left out.
        pattern: of `PATTERNS`.
        walls: lines side by side.
        top_layers: solid ones below faces that look up.
        bottom_layers: solid ones above faces that look down.
        line_width: of an extruded line, mm.
        layer: height of a layer, mm.

    Raises:
        VolfrepError: at construction, where they make no sense.
    """

    grading: str = "skin"
    start: float = 10.0
    end: float = 50.0
    profile: str = "linear"
    reach: float = 5.0
    direction: Vector = (0.0, 0.0, 1.0)
    field: Field | str | os.PathLike[str] | None = None
    column: str | None = None
    curve: str = ""
    formula: str = ""
    bands: int = 5
    pattern: str = "gyroid"
    walls: int = 3
    top_layers: int = 4
    bottom_layers: int = 4
    line_width: float = 0.45
    layer: float = 0.2
    _along: RadiusGrading | None = dataclasses.field(
        init=False, repr=False, compare=False, default=None
    )

    def __post_init__(self) -> None:
        for name in ("grading", "pattern", "curve", "formula", "profile"):
            check_kind(name, getattr(self, name), str, "a text")
        for name, words in (("grading", GRADINGS), ("pattern", PATTERNS)):
            if getattr(self, name) not in words:
                raise VolfrepError(
                    f"There is no {name} '{getattr(self, name)}' of a slicer's infill: choose "
                    f"{', '.join(words)}."
                )
        whole("number of bands", self.bands, FEWEST_BANDS, MOST_BANDS)
        for name in ("walls", "top_layers", "bottom_layers"):
            whole(name.replace("_", " "), getattr(self, name), 0, 1000)
        number("line width", self.line_width, "mm", positive=True)
        number("height of a layer", self.layer, "mm", positive=True)
        if self.layer >= self.line_width:
            raise VolfrepError(
                f"A layer of {self.layer:g} mm is as high as a line of {self.line_width:g} mm is "
                "wide: give a lower layer or a wider line."
            )
        if (self.grading == "formula") != bool(self.formula):
            raise VolfrepError("A formula and the grading 'formula' go together: give both.")
        if (self.grading == "field") != (self.field is not None):
            raise VolfrepError("A field and the grading 'field' go together: give both.")
        if self.grading != "formula":
            for name in ("start", "end"):
                refuse_density(f"density at the {name}", getattr(self, name))
            object.__setattr__(self, "_along", self._as_radius())

    def _as_radius(self) -> RadiusGrading:
        """What a radius would follow with the same words; its values are percent here."""
        values = self.field
        if isinstance(values, (str, os.PathLike)):
            values = read_point_field(values, self.column)
        if self.grading == "field" and not isinstance(values, Field):
            raise VolfrepError(
                f"A field is a CSV or VTK file, or points with values, not {brief(values)}."
            )
        curve = read_curve(self.curve) if self.curve else ()
        for _, density in curve:
            refuse_density("density of the curve", density)
        # Profiles are of what is above 0.
        ends = (max(self.start, 1e-6), max(self.end, 1e-6))
        return RadiusGrading(
            self.grading, Profile(self.profile, *ends), self.direction, self.reach, values,
            curve=curve,
        )  # fmt: skip

    @property
    def needs_depth(self) -> bool:
        """Whether the density follows the depth below the surface."""
        return self.grading in ("skin", "core")

    def densities(
        self, points: Floats, bounds: Floats, depth: Callable[[Floats], Floats], spacing: float
    ) -> Floats:
        """(n,) densities in percent at (n, 3) points, mm.

        Args:
            points: anywhere.
            bounds: (2, 3) the part's box, mm.
            depth: gives depths below the part's surface, mm.
            spacing: of the samples of a formula, mm.

        Raises:
            VolfrepError: a formula gives what is no density, naming the place.
        """
        if self._along is not None:
            return self._along.radii(points, bounds, depth)
        sampled = self._sample(bounds, spacing)
        return sampled(points)

    def _sample(self, bounds: Floats, spacing: float) -> SampledField:
        sampled = sample_function(self.formula, bounds, spacing, "formula")
        low, high = sampled.range
        for value in (low, high):
            refuse_density(f"formula '{self.formula}' in the part's box", value)
        return sampled

    @property
    def spacing(self) -> float:
        """From the middle of a line to that of the next, mm: their sides are half circles."""
        return self.line_width - self.layer * (1.0 - np.pi / 4.0)

    @property
    def wall_thickness(self) -> float:
        """Of all walls together, mm."""
        return self.walls * self.spacing

    def uniform(self, density: float) -> BandedInfill:
        """The same print with one density, %."""
        return replace(
            self, grading="direction", start=density, end=density, field=None, formula="", curve=""
        )


def refuse_density(name: str, value: float) -> None:
    """Refuse what is no density of a sparse infill in percent.

    Raises:
        VolfrepError: naming it.
    """
    if not 0.0 <= number(name, value, "", positive=None) <= MOST:
        raise VolfrepError(
            f"The {name} must be from 0 to {MOST:g} %, not {value:.4g}: what is to be solid is "
            "made by walls and solid layers."
        )
