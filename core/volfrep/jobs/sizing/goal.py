# SPDX-License-Identifier: LGPL-2.1-or-later
"""What sizing is for: limits for the least mass, or the most stiffness at a mass."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from numbers import Real

from ...mechanics.materials import SolidMaterial
from ...sizing.analysis import Limits
from ...sizing.symmetry import Mirrors
from ...util.arguments import check_kind
from ...util.errors import VolfrepError, brief
from .building import Building
from .printed import Printing

#: What a user may want: limits, or a mass of struts, and between which radii, how even; between
#: which thicknesses of the skin, and how far apart these are chosen.
GOALS = (
    "max_stress", "safety", "max_displacement", "buckling", "min_frequency", "strut_mass",
    "thinnest", "thickest", "smooth", "skin_thinnest", "skin_thickest", "skin_patch",
    "sized_mass",
)  # fmt: skip


@dataclass(frozen=True)
class Goal:
    """What is wanted of a design.

    Attributes:
        limits: none is gone beyond; without any, stiffness is what is wanted.
        volume: mm3 of struts, and of a skin that is sized, for the most stiffness; None for what
            the specification makes.
        thinnest: mm, the thinnest strut that may be; None for half the specification's radius.
        thickest: mm, the thickest; None for what the cell bears.
        smooth: share that a node's neighbours have in its radius, from 0 to 0.9.
        skin_thinnest: mm, the thinnest skin that may be, where its thickness is chosen together
            with the radii; None where it is the specification's.
        skin_thickest: mm, the thickest; None for half the cell size.
        skin_patch: mm, how far apart values of the skin's thickness are chosen, which is smooth
            between; inf for one thickness everywhere, None for the cell size.
        remove_thin: take away struts that end as thin as they may be, and size the rest again.
        weights: of the load cases, for stiffness; None for all alike.
        radius_list: mm, the radii that nodes may have; empty for any.
        mirrors: planes of symmetry; None for none.
        building: how the part is built: struts are no thinner than that, and none flatter as far
            as limits allow; None where it does not count.
        printing: how struts come out, which all figures are then of; None as they are drawn.
        solid_places: where limits ask for more than the thickest skin, the part becomes solid.
    """

    limits: Limits = field(default_factory=Limits)
    volume: float | None = None
    thinnest: float | None = None
    thickest: float | None = None
    smooth: float = 0.0
    weights: tuple[float, ...] | None = None
    skin_thinnest: float | None = None
    skin_thickest: float | None = None
    skin_patch: float | None = None
    remove_thin: bool = False
    radius_list: tuple[float, ...] = ()
    mirrors: Mirrors | None = None
    printing: Printing | None = None
    solid_places: bool = True
    building: Building | None = None


def goal_of(
    material: SolidMaterial,
    asked: Mapping[str, float | None],
    named: Callable[[str], str] = str,
    *,
    remove_thin: bool = False,
    radius_list: Sequence[float] = (),
    symmetry: str | None = None,
    printing: Printing | None = None,
    solid_places: bool = True,
    building: Building | None = None,
) -> Goal:
    """The goal that a user has written down.

    Args:
        material: of the part.
        asked: of `GOALS`, what was given; the stress as it is or by a safety against yielding, the
            mass of the struts in g.
        named: what the user calls one of them, for messages.
        remove_thin: see `Goal`.
        radius_list: the radii that may be, mm; empty for any between bounds.
        symmetry: planes as a text, such as "x=0, z=2.5"; None for none.
        printing: see `Goal`.
        solid_places: see `Goal`.
        building: see `Goal`.

    Raises:
        VolfrepError: there is no goal of a name, two say the same, or a number makes no sense.
    """
    for name, value in asked.items():
        check_kind(named(name), value, (Real, type(None)), "a number")
    given = {name: float(value) for name, value in asked.items() if value is not None}
    for name in given:
        if name not in GOALS:
            raise VolfrepError(f"There is no goal '{named(name)}': choose from {', '.join(GOALS)}.")
    for name in ("safety", "strut_mass", "sized_mass"):
        if not given.get(name, 1.0) > 0.0:
            raise VolfrepError(f"{named(name)} must be above 0, not {given[name]:g}.")
    stress = given.get("max_stress")
    if "safety" in given:
        if stress is not None:
            raise VolfrepError(
                f"{named('max_stress')} and {named('safety')} say the same: give one of them."
            )
        if material.yield_stress is None:
            raise VolfrepError(
                f"The material '{material.name}' has no yield stress for {named('safety')}: give "
                f"it one (yield_stress in the load file, YieldStrength in FreeCAD), or "
                f"{named('max_stress')} in its place."
            )
        stress = material.yield_stress / given["safety"]
    volume = None
    for name in ("strut_mass", "sized_mass"):
        if name not in given:
            continue
        if (name == "sized_mass") != ("skin_thinnest" in given):
            raise VolfrepError(
                f"{named('sized_mass')} is the mass of struts and of a skin that "
                f"{named('skin_thinnest')} has sized, {named('strut_mass')} that of struts where "
                "the skin is not sized: give the other one."
            )
        volume = given[name] * 1000.0 / material.density
    limits = Limits(
        stress, given.get("max_displacement"), given.get("buckling"), given.get("min_frequency")
    )
    for other in ("skin_thickest", "skin_patch"):
        if other not in given or "skin_thinnest" in given:
            continue
        raise VolfrepError(
            f"{named(other)} has no effect without {named('skin_thinnest')}: add that or leave it."
        )
    return Goal(
        limits, volume, given.get("thinnest"), given.get("thickest"), given.get("smooth", 0.0),
        skin_thinnest=given.get("skin_thinnest"), skin_thickest=given.get("skin_thickest"),
        skin_patch=given.get("skin_patch"), remove_thin=remove_thin,
        radius_list=_list_of(radius_list, given, named),
        mirrors=None if symmetry is None else _mirrors_of(symmetry, named("symmetry")),
        printing=printing,
        solid_places=solid_places,
        building=building,
    )  # fmt: skip


def _list_of(
    radii: Sequence[float], given: Mapping[str, float], named: Callable[[str], str]
) -> tuple[float, ...]:
    """The list in order, in steps as files keep them."""
    name = named("radius_list")
    try:
        numbers = sorted({round(float(radius), 6) for radius in radii})
    except (TypeError, ValueError) as error:
        raise VolfrepError(f"{name} is a list of radii in mm, not {brief(radii)}.") from error
    if not all(isfinite(number) and number > 0.0 for number in numbers):
        raise VolfrepError(f"{name} holds radii in mm above 0, not {brief(radii)}.")
    for other in ("thinnest", "thickest"):
        if numbers and other in given:
            raise VolfrepError(
                f"{name} says the thinnest radius and the thickest: leave {named(other)} out."
            )
    return tuple(numbers)


def _mirrors_of(text: str, name: str) -> Mirrors:
    """Planes, of a text such as "x=0, z=2.5"."""
    check_kind(name, text, str, "a text such as 'x=0, z=2.5'")
    planes: dict[int, float] = {}
    for part in text.split(","):
        axis, equals, value = part.partition("=")
        number = "xyz".find(axis.strip().lower() or "?")
        try:
            place = float(value)
        except ValueError:
            place = float("nan")
        if not equals or number < 0 or not isfinite(place) or number in planes:
            raise VolfrepError(
                f"{name} is planes across x, y or z, one of each at most, such as 'x=0, z=2.5', "
                f"not {brief(text)}."
            )
        planes[number] = place
    return Mirrors(tuple(sorted(planes.items())))
