# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specimens of a lattice to print and measure, each with its number in relief.

What they tell goes back as a table of printed diameters (`design.as_printed`) or a material file.
Faces that are pressed or lie on supports carry no number.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..design.spec import LatticeSpec
from ..mesh.booleans import as_manifold, as_mesh
from ..mesh.triangle_mesh import TriangleMesh
from ..util.arguments import check_kind
from ..util.errors import VolfrepError
from ..util.manifold import manifold_library
from ..util.numbers import number, whole
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from .kinds import lattice_kind

if TYPE_CHECKING:
    import manifold3d

KINDS = ("cube", "tension", "bending", "ladder")
#: Of plates that are pressed and of grips, mm; a grip is so many times as long as the bar is wide.
PLATE, GRIP = 3.0, 1.5
#: Cells across a bar and along its gauge; across a beam and along it.
BAR, BEAM = (2, 6), (2, 10)
#: Digits: how far they stand out, how deep they are rooted, their height on a plate; mm.
RELIEF, ROOT, DIGIT = 0.4, 0.3, 2.2
#: Of the ladder: strut length, bridge, height of a bridge above its plate, thickness of that plate.
LENGTH, BRIDGE, CLEAR, BASE = 10.0, 8.0, 4.0, 2.0
DIAMETERS, INCLINATIONS = (0.4, 0.6, 0.8, 1.0, 1.5), (0.0, 30.0, 45.0, 60.0, 90.0)
#: Corners of the ladder's struts.
_CORNERS = 64
#: Segments of each digit: top, upper right, lower right, bottom, lower left, upper left, middle.
_SEGMENTS = ("abcdef", "bc", "abged", "abgcd", "fgbc", "afgcd", "afgecd", "abc", "abcdefg",
             "abcdfg")  # fmt: skip
_PLACES = {
    "a": (0, 2, 1, 2), "b": (1, 1, 1, 2), "c": (1, 0, 1, 1), "d": (0, 0, 1, 0),
    "e": (0, 0, 0, 1), "f": (0, 1, 0, 2), "g": (0, 1, 1, 1),
}  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class Coupon(Shown):
    """A specimen.

    Attributes:
        kind: of `KINDS`.
        number: in relief.
        mesh: closed, mm, as it stands on the build plate.
        sizes: names and values in mm or mm2 that a test is evaluated by.
        struts: of a ladder (inclination, diameter) of each, degrees and mm.
    """

    kind: str
    number: int
    mesh: TriangleMesh
    sizes: dict[str, float]
    struts: tuple[tuple[float, float], ...] = ()

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        sizes = [(name, f"{value:g}") for name, value in self.sizes.items()]
        return [("coupon", f"{self.number}, {self.kind}"), *sizes]

    def table(self) -> str:
        """Of a ladder the file to fill in: `as_printed.find_printed_table` reads it."""
        rows = [f"{angle:g},{diameter:g}," for angle, diameter in self.struts]
        return "\n".join(["inclination,nominal,measured", *rows]) + "\n"


def make_coupons(
    spec: LatticeSpec,
    kinds: Sequence[str] = KINDS,
    *,
    cells: int = 4,
    first: int = 1,
    diameters: Sequence[float] = DIAMETERS,
    inclinations: Sequence[float] = INCLINATIONS,
    progress: ProgressCallback | None = None,
) -> list[Coupon]:
    """Specimens of a lattice.

    Args:
        spec: of the lattice; its skin does not count.
        kinds: ``cube`` (cells under two plates, to be pressed), ``tension`` (a bar between two
            grips), ``bending`` (a beam under two plates for three points) and ``ladder`` (single
            struts of several diameters and inclinations).
        cells: along the edge of the cube.
        first: number of the first one.
        diameters: of the ladder, mm.
        inclinations: of the ladder, degrees to the build plate.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: there is no such kind, or a number makes no sense.
        Cancelled: the callback said so.
    """
    kinds = (kinds,) if isinstance(kinds, str) else kinds
    check_kind("kinds", kinds, (tuple, list), f"some of {', '.join(KINDS)}")
    for kind in kinds:
        check_kind("kinds", kind, str, f"some of {', '.join(KINDS)}")
    unknown = [kind for kind in kinds if kind not in KINDS]
    if unknown or not kinds:
        what = f"There is no coupon '{unknown[0]}'" if unknown else "No coupon is named"
        raise VolfrepError(f"{what}: choose of {', '.join(KINDS)}.")
    whole("cells along the cube", cells, 1, 100)
    whole("number of the first coupon", first, 0, 9999)
    for diameter in diameters:
        number("diameter of the ladder", diameter, "mm", positive=True)
    for angle in inclinations:
        if not 0.0 <= number("inclination", angle, "degrees", positive=None) <= 90.0:
            raise VolfrepError(f"An inclination is from 0 to 90 degrees, not {angle:g}.")
    monitor = Monitor(progress)
    made = []
    for count, kind in enumerate(kinds):
        with monitor.stage(kind, count / len(kinds), (count + 1) / len(kinds)):
            if kind == "ladder":
                made.append(_ladder(first + count, diameters, inclinations))
            else:
                make = {"cube": _cube, "tension": _bar, "bending": _beam}[kind]
                made.append(make(spec, first + count, cells, monitor))
    return made


def _cube(spec: LatticeSpec, number: int, cells: int, monitor: Monitor) -> Coupon:
    """Cells between two plates."""
    lattice = _lattice(spec, (cells, cells, cells), monitor)
    low, high = np.array(lattice.bounding_box()).reshape(2, 3)
    edge = cells * spec.cell_size
    solid = lattice
    for bottom in (low[2] - PLATE + _sunk(spec), high[2] - _sunk(spec)):
        solid = solid + _box((low[0], low[1], bottom), (high[0], high[1], bottom + PLATE))
    solid = solid + _on_front(number, low[0] + 1.0, low[1], low[2] - PLATE + _sunk(spec))
    sizes = {"edge": edge, "area": edge**2, "height": high[2] - low[2] - 2.0 * _sunk(spec)}
    return Coupon("cube", number, _stood(solid), sizes)


def _bar(spec: LatticeSpec, number: int, cells: int, monitor: Monitor) -> Coupon:
    """Cells between two grips, upright."""
    across, along = BAR
    lattice = _lattice(spec, (across, across, along), monitor)
    low, high = np.array(lattice.bounding_box()).reshape(2, 3)
    grip = GRIP * across * spec.cell_size
    solid, sunk = lattice, _sunk(spec)
    for bottom in (low[2] - grip + sunk, high[2] - sunk):
        solid = solid + _box((low[0], low[1], bottom), (high[0], high[1], bottom + grip))
    solid = solid + _on_front(number, low[0] + 1.0, low[1], low[2] - grip + sunk)
    edge = across * spec.cell_size
    sizes = {"edge": edge, "area": edge**2, "gauge": high[2] - low[2] - 2.0 * sunk, "grip": grip}
    return Coupon("tension", number, _stood(solid), sizes)


def _beam(spec: LatticeSpec, number: int, cells: int, monitor: Monitor) -> Coupon:
    """Cells between a plate below and one above, with its number at its end."""
    across, along = BEAM
    lattice = _lattice(spec, (along, across, across), monitor)
    low, high = np.array(lattice.bounding_box()).reshape(2, 3)
    thick, sunk = PLATE / 3.0, _sunk(spec)
    solid = lattice
    for bottom in (low[2] - thick + sunk, high[2] - sunk):
        solid = solid + _box((low[0], low[1], bottom), (high[0], high[1], bottom + thick))
    # A cap at one end carries the number; it lies beyond the supports.
    cap = _box((high[0] - sunk, low[1], low[2]), (high[0] + thick, high[1], high[2]))
    digits = _digits(str(number), min(DIGIT, 0.6 * (high[2] - low[2])))
    digits = digits.rotate((90.0, 0.0, 90.0))
    box = np.array(digits.bounding_box()).reshape(2, 3)
    middle = (low + high) / 2.0 - (box[0] + box[1]) / 2.0
    digits = digits.translate((high[0] + thick - ROOT - box[0, 0], middle[1], middle[2]))
    length = along * spec.cell_size
    sizes = {
        "width": across * spec.cell_size, "height": high[2] - low[2] + 2.0 * (thick - sunk),
        "length": length, "span": 0.8 * length, "plate": thick,
    }  # fmt: skip
    return Coupon("bending", number, _stood(solid + cap + digits), sizes)


def _ladder(number: int, diameters: Sequence[float], inclinations: Sequence[float]) -> Coupon:
    """Struts on a plate: a row for each inclination, a column for each diameter."""
    pitch = max(7.0, 4.0 * max(diameters))
    solids, struts = [], []
    y = 3.0
    for angle in inclinations:
        slope = math.radians(angle)
        reach = BRIDGE if angle == 0.0 else LENGTH * math.cos(slope)
        for column, diameter in enumerate(diameters):
            x = 5.0 + pitch * column
            if angle == 0.0:
                solids += [
                    _box((x - 1.5, end - 1.0, 0.0), (x + 1.5, end + 1.0, CLEAR + diameter))
                    for end in (y, y + BRIDGE)
                ]
                start, length = (x, y, CLEAR), BRIDGE
            else:
                start, length = (x, y, -0.5 * BASE), LENGTH + 0.5 * BASE / math.sin(slope)
            strut = _round(length, diameter).rotate((-(90.0 - angle), 0.0, 0.0))
            solids.append(strut.translate(start))
            struts.append((float(angle), float(diameter)))
        y += reach + 6.0
    wide = 5.0 + pitch * len(diameters)
    solid = _box((0.0, -5.0, -BASE), (wide, y, 0.0))
    for column, diameter in enumerate(diameters):  # in hundredths of a millimetre
        digits = _digits(str(round(100.0 * diameter)), DIGIT)
        solid = solid + digits.translate((3.0 + pitch * column, -3.8, -ROOT))
    mark = _digits(str(number), 1.2 * DIGIT)
    solid = solid + mark.translate((wide - 1.0 - 1.2 * len(str(number)) * DIGIT, y - 4.0, -ROOT))
    for one in solids:
        solid = solid + one
    sizes = {"length": LENGTH, "bridge": BRIDGE, "pitch": pitch}
    return Coupon("ladder", number, _stood(solid), sizes, tuple(struts))


def _lattice(
    spec: LatticeSpec, count: tuple[int, int, int], monitor: Monitor
) -> manifold3d.Manifold:
    return as_manifold(lattice_kind(spec).block(count).result(monitor).mesh)


def _sunk(spec: LatticeSpec) -> float:
    """How far the lattice's outermost struts, or walls, reach into a plate, mm."""
    least, most = 0.05 * spec.cell_size, 0.25 * spec.cell_size
    return float(np.clip(0.9 * spec.kind.mean_radius, least, most))


def _stood(solid: manifold3d.Manifold) -> TriangleMesh:
    """On z = 0, its corner at the origin."""
    low = np.array(solid.bounding_box()).reshape(2, 3)[0]
    return as_mesh(solid.translate(tuple((-low).tolist())))


def _box(low: Sequence[float], high: Sequence[float]) -> manifold3d.Manifold:
    library = manifold_library("Making a coupon")
    size = [b - a for a, b in zip(low, high, strict=True)]
    box: manifold3d.Manifold = library.Manifold.cube(size).translate(list(low))
    return box


def _round(length: float, diameter: float) -> manifold3d.Manifold:
    """A prism along z with the section of a cylinder."""
    library = manifold_library("Making a coupon")
    share = _CORNERS / (2.0 * math.pi) * math.sin(2.0 * math.pi / _CORNERS)
    radius = diameter / 2.0 / math.sqrt(share)
    made: manifold3d.Manifold = library.Manifold.cylinder(length, radius, radius, _CORNERS)
    return made


def _on_front(number: int, x: float, front: float, bottom: float) -> manifold3d.Manifold:
    """A number on an upright face that looks along -y, above its lower edge."""
    digits = _digits(str(number), DIGIT).rotate((90.0, 0.0, 0.0))
    return digits.translate((x, front + ROOT, bottom + (PLATE - DIGIT) / 2.0))


def _digits(text: str, height: float) -> manifold3d.Manifold:
    """A number of seven segments in x and y, from z = 0 on up to root and relief."""
    line, wide = height / 6.0, height / 2.2
    solid = None
    for place, letter in enumerate(text):
        left = place * (wide + 2.0 * line)
        for segment in _SEGMENTS[int(letter)]:
            a, b, c, d = _PLACES[segment]
            low = (left + a * (wide - line), b * (height - line) / 2.0, 0.0)
            high = (
                left + c * (wide - line) + line, d * (height - line) / 2.0 + line, RELIEF + ROOT,
            )  # fmt: skip
            box = _box(low, high)
            solid = box if solid is None else solid + box
    assert solid is not None
    return solid
