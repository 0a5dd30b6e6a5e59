# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a part has to carry: how it is held, and its load cases. Units: mm, N, MPa, N mm, mm/s2."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..mechanics.materials import SolidMaterial
from ..util.errors import VolfrepError
from ..util.numbers import number
from .regions import Region, Vector, check_vector

#: A cone's directions lie no farther apart than so, degrees; and so much of what is linear in the
#: force may be missed between them.
_RING, CONE_MISSES = 20.0, 0.04
#: Along x, y and z; None where a support leaves an axis free.
Displacement = tuple[float | None, float | None, float | None]


@dataclass(frozen=True)
class Support:
    """A region that is held, or moved by what is given.

    Attributes:
        region: where.
        displacement: along x, y and z, mm; None leaves the axis free.
        turns: about x, y and z: whether the nodes there may turn, if they can turn at all. A solid
            has no say in it: it is held when three of its points are.
        name: for messages and reports.
    """

    region: Region
    displacement: Displacement = (0.0, 0.0, 0.0)
    turns: tuple[bool, bool, bool] = (False, False, False)
    name: str = "support"

    def __post_init__(self) -> None:
        given = [value for value in self.displacement if value is not None]
        if not all(math.isfinite(value) for value in given):
            raise VolfrepError(f"The displacement of '{self.name}' must be of finite numbers.")
        if not given and all(self.turns):
            raise VolfrepError(f"'{self.name}' holds nothing: fix it, or give a displacement.")


@dataclass(frozen=True)
class Force:
    """A force that a region carries: its facets by their area, or its nodes alike.

    Attributes:
        region: where.
        force: the whole of it, N.
        at: a point that it acts through, mm, as if a stiff arm led there; None for the middle of
            the region, so that it turns nothing there.
        name: for messages and reports.
    """

    region: Region
    force: Vector
    at: Vector | None = None
    name: str = "force"

    def __post_init__(self) -> None:
        check_vector(f"force of '{self.name}'", self.force)
        if self.at is not None:
            check_vector(f"point of '{self.name}'", self.at)


@dataclass(frozen=True)
class Moment:
    """A moment that a region carries, as forces that add up to nothing but it.

    Attributes:
        region: where.
        moment: N mm, right-handed about each axis.
        name: for messages and reports.
    """

    region: Region
    moment: Vector
    name: str = "moment"

    def __post_init__(self) -> None:
        check_vector(f"moment of '{self.name}'", self.moment)


@dataclass(frozen=True)
class Pressure:
    """A pressure on the facets of a region.

    Attributes:
        region: where.
        pressure: MPa; positive pushes into the part, negative pulls.
        name: for messages and reports.
    """

    region: Region
    pressure: float
    name: str = "pressure"

    def __post_init__(self) -> None:
        if not math.isfinite(self.pressure):
            raise VolfrepError(f"The pressure of '{self.name}' must be a finite number.")


Load = Force | Moment | Pressure


@dataclass(frozen=True)
class Mass:
    """A body that hangs on a region and is not stiff itself; a facet has its part by area.

    Attributes:
        region: where.
        mass: g.
        name: for messages and reports.
    """

    region: Region
    mass: float
    name: str = "mass"

    def __post_init__(self) -> None:
        if not (math.isfinite(self.mass) and self.mass > 0.0):
            raise VolfrepError(f"The mass of '{self.name}' must be above 0, not {self.mass:g}.")


@dataclass(frozen=True)
class Heat:
    """A region at a temperature, beside a fluid, or through which heat flows into the part.

    Attributes:
        region: where.
        temperature: K or degrees C, of it, or of the fluid; None where heat flows.
        power: W, the whole of it, by area; negative flows out.
        name: for messages and reports.
        film: W/(m2 K), the coefficient between region and fluid; None where there is no fluid.
    """

    region: Region
    temperature: float | None = None
    power: float | None = None
    name: str = "heat"
    film: float | None = None

    def __post_init__(self) -> None:
        given = [value for value in (self.temperature, self.power) if value is not None]
        if len(given) != 1 or not math.isfinite(given[0]):
            raise VolfrepError(f"'{self.name}' needs a temperature or a power: give one of them.")
        if self.film is not None:
            number(f"film of '{self.name}'", self.film, "W/(m2 K)", positive=True)
            if self.temperature is None:
                raise VolfrepError(
                    f"The film of '{self.name}' is towards a fluid: give the fluid's temperature."
                )


@dataclass(frozen=True)
class LoadCase:
    """Loads that act together.

    Attributes:
        name: no other case has it.
        supports: how the part is held.
        loads: on regions.
        acceleration: mm/s2: what pulls at every piece of the part by its mass, as gravity does, so
            (0, 0, -9810) where z is up.
        expansion: the strain by which an even change of temperature makes the part larger where
            nothing holds it.
        heated: a coefficient of expansion, and the temperature at which the part has no stress,
            where it grows by the steady heat; None where it does not.
    """

    name: str
    supports: tuple[Support, ...]
    loads: tuple[Load, ...] = ()
    acceleration: Vector = (0.0, 0.0, 0.0)
    expansion: float = 0.0
    heated: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        check_vector(f"acceleration of '{self.name}'", self.acceleration)
        if not abs(self.expansion) < 0.1:
            raise VolfrepError(
                f"A strain of {self.expansion:g} by the temperature of '{self.name}' makes no "
                "sense: it is the coefficient of expansion, such as 9e-6, times degrees."
            )
        if not self.supports:
            raise VolfrepError(f"The load case '{self.name}' has no support: the part would fly.")
        displaced = any(value for support in self.supports for value in support.displacement)
        strained = self.expansion or self.heated
        if not (self.loads or any(self.acceleration) or displaced or strained):
            raise VolfrepError(
                f"The load case '{self.name}' has no load: give a force, a moment, a pressure, an "
                "acceleration, a displacement or a temperature."
            )


@dataclass(frozen=True)
class LoadCases:
    """A material and all that a part of it has to carry.

    Attributes:
        material: of skin and struts.
        cases: each by itself; at least one, unless there is heat.
        masses: of bodies that are attached in every case.
        heat: what is warm, and what flows in.
        conductivity: of the solid, W/(m K); None where there is no heat.
    """

    material: SolidMaterial
    cases: tuple[LoadCase, ...]
    masses: tuple[Mass, ...] = ()
    heat: tuple[Heat, ...] = ()
    conductivity: float | None = None

    def __post_init__(self) -> None:
        names = [case.name for case in self.cases]
        if not names and not self.heat:
            raise VolfrepError("There is no load case: give at least one.")
        twice = [name for k, name in enumerate(names) if name in names[:k]]
        if twice:
            raise VolfrepError(f"Two load cases have the name '{twice[0]}': rename one.")
        if not self.heat and any(case.heated for case in self.cases):
            raise VolfrepError("A case has the temperature of the heat, and there is no [[heat]].")
        if self.heat and not (self.conductivity and 0.0 < self.conductivity < math.inf):
            raise VolfrepError(
                "Heat flows by the solid's conductivity: give one above 0, W/(m K), such as "
                "conductivity = 7."
            )
        if self.heat and all(one.temperature is None for one in self.heat):
            raise VolfrepError("No heat has a temperature: give one to where the heat leaves.")


def refuse_heat(loads: LoadCases) -> None:
    """Refuse heat where it would be left out.

    Raises:
        VolfrepError: there is some.
    """
    if loads.heat:
        raise VolfrepError(
            "Heat flows in homogenised parts only: solve it by 'volfrep homogenise', or leave the "
            "tables [[heat]] out."
        )


def with_weights(loads: LoadCases) -> LoadCases:
    """The same, where accelerations pull at attached bodies by forces of the cases."""
    cases = []
    for case in loads.cases:
        x, y, z = case.acceleration
        weights = tuple(
            Force(body.region, (1e-6 * body.mass * x, 1e-6 * body.mass * y, 1e-6 * body.mass * z),
                  name=body.name)
            for body in loads.masses
        )  # fmt: skip
        cases.append(replace(case, loads=case.loads + weights) if any((x, y, z)) else case)
    return replace(loads, cases=tuple(cases))


def cone_of(case: LoadCase, number: int, angle: float) -> tuple[LoadCase, ...]:
    """A case for each of several directions of one of its forces, which may act in any of a cone.

    What is linear in the force is by no more than `CONE_MISSES` larger between the directions.

    Args:
        case: whose force has the direction of the cone's axis.
        number: of the force among its loads, from 0.
        angle: between the axis and the cone, above 0 and up to 90 degrees.

    Raises:
        VolfrepError: the load is no force, or the angle makes no sense.
    """
    load = case.loads[number]
    if not isinstance(load, Force):
        raise VolfrepError(f"'{load.name}' is no force: only a force has a cone of directions.")
    size = math.hypot(*load.force)
    if not (math.isfinite(angle) and 0.0 < angle <= 90.0 and size > 0.0):
        raise VolfrepError(
            f"A cone of {angle:g} degrees about the force of '{load.name}' makes no sense: give an "
            "angle above 0 and up to 90, and a force."
        )
    axis = np.array(load.force) / size
    one = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    one /= np.linalg.norm(one)
    two = np.cross(axis, one)
    rings = math.ceil(angle / _RING)
    # The outermost lie a little beyond the cone, so that planes between neighbours touch it.
    last = math.atan2(math.sin(math.radians(angle)),
                      math.cos(math.radians(angle)) * math.cos(math.pi / (6 * rings)))  # fmt: skip
    found: list[LoadCase] = []
    for ring in range(rings + 1):
        off = last * ring / rings
        for turn in np.arange(max(6 * ring, 1)) * (math.tau / max(6 * ring, 1)):
            aside = math.cos(turn) * one + math.sin(turn) * two
            x, y, z = (size * (math.cos(off) * axis + math.sin(off) * aside)).tolist()
            way = (x, y, z) if ring else load.force
            loads = (*case.loads[:number], replace(load, force=way), *case.loads[number + 1 :])
            found.append(replace(case, name=f"{case.name}, way {len(found) + 1}", loads=loads))
    return tuple(found)
