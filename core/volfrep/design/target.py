# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a lattice is to come to, in place of the radius of its struts."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ..util.errors import VolfrepError, brief, listed
from ..util.numbers import number

#: What can be aimed at, as parameters and files call it.
AIMS = ("relative_density", "mass", "stiffness")
#: What says how thick struts or walls are in place of a target.
THICKNESSES = ("strut_radius", "wall_thickness", "wall_offset")
_AXES = {"100": (1.0, 0.0, 0.0), "110": (1.0, 1.0, 0.0), "111": (1.0, 1.0, 1.0)}


@dataclass(frozen=True)
class Target:
    """What the radius of the struts is chosen for.

    Attributes:
        aim: ``relative_density`` (of the lattice in what it fills), ``mass`` (of the finished
            part) or ``stiffness`` (Young's modulus of the endless lattice).
        value: the density as a share of 1; g; MPa or, without a material, in units of the solid's
            modulus.
        direction: of the modulus, in the cell's axes, of any length; None for the others.
        young: the solid's Young's modulus, MPa; 1 where the value is in units of it.
    """

    aim: str
    value: float
    direction: tuple[float, float, float] | None = None
    young: float = 1.0

    def __post_init__(self) -> None:
        if self.aim not in AIMS:
            raise VolfrepError(f"There is no target '{self.aim}': choose {', '.join(AIMS)}.")
        unit = {"mass": "g", "stiffness": "MPa"}.get(self.aim, "")
        number(self.called, self.value, unit, positive=True)
        number("Young's modulus of the solid", self.young, "MPa", positive=True)
        if self.aim == "relative_density" and self.value >= 1.0:
            raise VolfrepError(
                f"A relative density must be between 0 and 1, not {self.value:g}: 0.2 is 20 %."
            )
        if (self.direction is None) == (self.aim == "stiffness"):
            raise VolfrepError("A stiffness, and nothing else, is aimed at along a direction.")
        if self.direction is not None:
            length = math.hypot(*self.direction)
            if not (math.isfinite(length) and length > 0.0):
                raise VolfrepError("The direction of a stiffness must have a length.")

    @property
    def called(self) -> str:
        """What is aimed at, in words."""
        return self.aim.replace("_", " ")

    def lattice_volume(self, density: float, domain: float, skin: float) -> float:
        """The volume that a density or a mass asks of the lattice, mm3.

        Args:
            density: of the material, g/cm3.
            domain: volume of the room for the lattice, mm3.
            skin: volume of the skin, mm3, which a mass includes.

        >>> Target("mass", 5.0).lattice_volume(2.5, domain=4000.0, skin=1200.0)
        800.0
        """
        if self.aim == "mass":
            return self.value * 1000.0 / density - skin
        return self.value * domain

    def as_json(self) -> dict[str, Any]:
        """The target as plain JSON values."""
        result: dict[str, Any] = {"aim": self.aim, "value": self.value}
        if self.direction is not None:
            result["direction"] = list(self.direction)
            result["unit"] = "the solid's Young's modulus" if self.young == 1.0 else "MPa"
        return result


def read_target(
    values: Mapping[str, Any], young: float = 1.0, say: Callable[[str], str] = str
) -> Target | None:
    """The target that is among values by name; None where none is.

    Args:
        values: by the names of `AIMS`, of which a stiffness is a text as `read_stiffness` takes it
            or its modulus and direction, and of `THICKNESSES`; `target` is one that is made
            already. None stands for a value that is not given.
        young: the solid's Young's modulus, MPa; 1 where a stiffness is in units of it.
        say: how to call a value in an error.

    Raises:
        VolfrepError: it makes no sense, or several values say how thick struts or walls are.

    >>> read_target({"mass": 20.0, "strut_radius": None}).value
    20.0
    """
    given = [n for n in (*THICKNESSES, *AIMS, "target") if values.get(n) is not None]
    if not given or given[-1] in THICKNESSES:
        return None
    if len(given) > 1:
        both = listed([say(name) for name in given], "and")
        what = "walls" if any("wall" in name for name in given) else "struts"
        raise VolfrepError(f"{both} each say how thick the {what} are: give one of them.")
    aim, value = given[0], values[given[0]]
    if isinstance(value, Target):
        return value
    if aim == "target" or isinstance(value, (dict, set)):
        raise VolfrepError(f"'{aim}' cannot be {brief(value)}.")
    if aim != "stiffness":
        unit = "g" if aim == "mass" else ""
        return Target(aim, number(aim.replace("_", " "), value, unit, positive=None))
    if isinstance(value, tuple) and len(value) == 2:
        modulus, direction = value
        return Target(aim, modulus, direction, young)
    return read_stiffness(value, young)


def read_stiffness(text: str, young: float = 1.0) -> Target:
    """The target of a text such as ``500:100``, a modulus and the direction it is along.

    Raises:
        VolfrepError: it is none.
    """
    modulus, _, way = str(text).partition(":")
    try:
        value, (x, y, z) = float(modulus), read_direction(way)
    except ValueError as error:
        raise VolfrepError(
            f"{brief(text)} is no stiffness: write the modulus and its direction, E:100, E:110, "
            "E:111 or E:X,Y,Z, such as 500:111."
        ) from error
    return Target("stiffness", value, (x, y, z), young)


def read_direction(text: str) -> tuple[float, float, float]:
    """The direction of a text: 100, 110, 111, or three numbers with commas.

    Raises:
        ValueError: it is none.

    >>> read_direction("110"), read_direction("1, 2, 0")
    ((1.0, 1.0, 0.0), (1.0, 2.0, 0.0))
    """
    x, y, z = _AXES.get(text.strip()) or (float(part) for part in text.split(","))
    return x, y, z


def stiffness_text(target: Target) -> str:
    """What `read_stiffness` reads the target of."""
    assert target.direction is not None
    return f"{target.value!r}:{','.join(repr(float(part)) for part in target.direction)}"


def modulus_out_of_reach(what: str, target: Target, least: float, most: float) -> VolfrepError:
    """What is wrong where no thickness has a modulus."""
    unit = "of the solid's" if target.young == 1.0 else "MPa"
    return VolfrepError(
        f"No {what} a modulus of {target.value:.4g} {unit} along this direction: choose one from "
        f"{least:.3g} to {most:.3g} {unit}"
        + (", or name the solid's material." if target.young == 1.0 else ".")
    )


def volume_out_of_reach(
    target: Target,
    cells: str,
    density: float,
    inside: float,
    skin: float,
    span: tuple[float, float],
) -> VolfrepError:
    """What is wrong where no strut radius has a density or a mass.

    Args:
        target: what is asked for.
        cells: the lattice in words.
        density: of the material, g/cm3.
        inside: volume of the room for the lattice, mm3.
        skin: volume of the skin, mm3.
        span: the volumes that the lattice can have, mm3.
    """
    unit, more = "", ""
    least, most = (volume / inside for volume in span)
    if target.aim == "mass":
        unit = " g"
        least, most = ((skin + volume) * density / 1000.0 for volume in span)
        if skin:
            more = f", of which the skin is {skin * density / 1000.0:.4g} g"
    return VolfrepError(
        f"No strut radius gives a {target.called} of {target.value:.4g}{unit} with {cells}: choose "
        f"one from {least:.4g} to {most:.4g}{unit}{more}."
    )
