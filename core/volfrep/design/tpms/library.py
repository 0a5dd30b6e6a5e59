# SPDX-License-Identifier: LGPL-2.1-or-later
"""The library of surfaces that walls follow: formulas of x, y, z that are zero on them.

x, y and z run from 0 to 2 pi along the edges of a cell. The formulas are the level-set
approximations of the triply periodic minimal surfaces (A. H. Schoen, NASA TN D-5541, 1970; H. G.
von Schnering and R. Nesper, Z. Phys. B 83, 1991; L. Han and S. Che, Adv. Mater. 30, 2018). This
module needs no numpy, so that ``volfrep --help`` answers at once.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar

from ...util.errors import VolfrepError

#: The name of a surface whose formula the user gives.
FORMULA = "Formula"


@dataclass(frozen=True)
class PeriodicSurface:
    """A surface that repeats in every cell.

    Attributes:
        name: its own, or `FORMULA`.
        formula: zero on the surface, positive on one side; of x, y, z from 0 to 2 pi.
        about: what it is, in a few words.
        also: other names.
    """

    #: The parameter that says how thick a lattice of it is.
    measure: ClassVar[str] = "wall_thickness"

    name: str
    formula: str
    about: str = field(default="", compare=False)
    also: tuple[str, ...] = field(default=(), compare=False)

    def as_values(self) -> dict[str, Any]:
        """The parameters that name it."""
        name = self.name if SURFACES.get(self.name) == self else FORMULA
        return {"cell": name, "wall_formula": self.formula}


_LIDINOID = (
    "0.5 * (sin(2*x) * cos(y) * sin(z) + sin(2*y) * cos(z) * sin(x) + sin(2*z) * cos(x) * sin(y))"
    " - 0.5 * (cos(2*x) * cos(2*y) + cos(2*y) * cos(2*z) + cos(2*z) * cos(2*x)) + 0.15"
)
_SPLIT_P = (
    "1.1 * (sin(2*x) * sin(z) * cos(y) + sin(2*y) * sin(x) * cos(z) + sin(2*z) * sin(y) * cos(x))"
    " - 0.2 * (cos(2*x) * cos(2*y) + cos(2*y) * cos(2*z) + cos(2*z) * cos(2*x))"
    " - 0.4 * (cos(2*x) + cos(2*y) + cos(2*z))"
)

SURFACES: dict[str, PeriodicSurface] = {
    surface.name: surface
    for surface in (
        PeriodicSurface(
            "Gyroid",
            "sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)",
            "no straight line and no mirror plane; two channels that wind about each other",
            ("G", "Schoen G"),
        ),
        PeriodicSurface(
            "Schwarz P",
            "cos(x) + cos(y) + cos(z)",
            "round openings in the middles of the cell's faces",
            ("P", "Primitive", "Schwarz primitive"),
        ),
        PeriodicSurface(
            "Schwarz D",
            "sin(x) * sin(y) * sin(z) + sin(x) * cos(y) * cos(z) + cos(x) * sin(y) * cos(z)"
            " + cos(x) * cos(y) * sin(z)",
            "both channels branch as the bonds of diamond do",
            ("D", "Schwarz diamond"),
        ),
        PeriodicSurface(
            "IWP",
            "2 * (cos(x) * cos(y) + cos(y) * cos(z) + cos(z) * cos(x))"
            " - (cos(2*x) + cos(2*y) + cos(2*z))",
            "one channel along the diagonals of the body, the other about the faces",
            ("I-WP", "Schoen I-WP"),
        ),
        PeriodicSurface(
            "Neovius",
            "3 * (cos(x) + cos(y) + cos(z)) + 4 * cos(x) * cos(y) * cos(z)",
            "channels to the middles of the cell's edges",
            ("C(P)",),
        ),
        PeriodicSurface(
            "Lidinoid", _LIDINOID, "the gyroid's relative with narrow and wide channels", ("HG",)
        ),
        PeriodicSurface(
            "Split P", _SPLIT_P, "the Schwarz P, its walls split once more", ("SplitP",)
        ),
    )
}


def surface_name(word: str) -> str | None:
    """The library's name of a surface that is called so, `FORMULA` for one; None: no surface.

    >>> surface_name("gyroid"), surface_name("i-wp"), surface_name("Octet")
    ('Gyroid', 'IWP', None)
    """
    wanted = word.strip().lower()
    if wanted == FORMULA.lower():
        return FORMULA
    for surface in SURFACES.values():
        if wanted in (surface.name.lower(), *(other.lower() for other in surface.also)):
            return surface.name
    return None


def find_surface(word: str, formula: str = "") -> PeriodicSurface | None:
    """The surface that is called so, with the user's formula for `FORMULA`; None: no surface.

    Raises:
        VolfrepError: a formula is wanted, and none given.
    """
    name = surface_name(word)
    if name != FORMULA:
        return None if name is None else SURFACES[name]
    if not formula.strip():
        raise VolfrepError(
            "The cell Formula needs a formula of x, y and z, such as 'cos(x) + cos(y) + cos(z)'."
        )
    return PeriodicSurface(FORMULA, formula.strip(), "a formula of your own")
