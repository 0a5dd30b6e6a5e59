# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a user sets once for all documents: keys, words, defaults and limits, in one place.

The values lie in FreeCAD's parameters (Edit > Preferences > VOLFREP, or Tools > Edit parameters).
Whatever was typed there by hand, what is read here makes sense.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import FreeCAD as App

GROUP = "User parameter:BaseApp/Preferences/Mod/VOLFREP"


@dataclass(frozen=True)
class Preference:
    """One value in FreeCAD's parameters, of the type of its default.

    Attributes:
        key: its name there.
        label: what its page calls it.
        tip: the sentence that explains it.
        default: what holds where nothing is stored.
        low: the least number.
        high: the largest number.
        automatic: whether 0 is allowed as well, and leaves the choice to VOLFREP.
        choices: of a text: called for the texts that are allowed.
        unit: behind a number on its page.
    """

    key: str
    label: str
    tip: str
    default: bool | int | float | str
    low: float = 0.0
    high: float = math.inf
    automatic: bool = False
    choices: Callable[[], Sequence[str]] | None = None
    unit: str = ""


@dataclass(frozen=True)
class Colour(Preference):
    """A colour, as FreeCAD stores it: 0xRRGGBBAA."""

    high: float = 0xFFFFFFFF


def _cells() -> list[str]:
    from volfrep.design.cells import LIBRARY
    from volfrep.design.tpms import SURFACES

    return [*LIBRARY, *SURFACES]


CELL_TYPE = Preference(
    "NewCellType", "Cell type", "The unit cell of a new infill", "CVC", choices=_cells
)
CELL_SIZE = Preference(
    "NewCellSize", "Cell size",
    "Edge length L of a cell; automatic: about four cells across the thinnest side of the part",
    0.0, 0.01, 1000.0, automatic=True, unit=" mm",
)  # fmt: skip
STRUT_SHARE = Preference(
    "NewStrutRadiusShare", "Strut radius",
    "Radius of the struts as a share of the cell size L",
    0.1, 0.01, 0.4, unit=" L",
)  # fmt: skip
SKIN = Preference(
    "NewShellThickness", "Skin thickness",
    "Thickness of the closed skin; automatic: a fifth of the cell size",
    0.0, 0.01, 1000.0, automatic=True, unit=" mm",
)  # fmt: skip
RESOLUTION = Preference(
    "NewResolution", "Resolution",
    "Facets along the edge of a cell; automatic: chosen by the deviation",
    0, 4, 400, automatic=True,
)  # fmt: skip
DEVIATION = Preference(
    "NewDeviation", "Deviation",
    "Distance between a facet and the exact strut, where the resolution is automatic; "
    "automatic: by the strut radius",
    0.0, 0.0001, 10.0, automatic=True, unit=" mm",
)  # fmt: skip
AUTO_UPDATE = Preference(
    "NewAutoUpdate", "Update at every change",
    "The property AutoUpdate of a new infill; without it, use Update Lattice Infill",
    True,
)  # fmt: skip
DENSITY = Preference(
    "NewDensity", "Density",
    "Density of the material, from which the mass comes",
    1.0, 0.001, 25.0, unit=" g/cm³",
)  # fmt: skip
PRICE = Preference(
    "NewMaterialPrice", "Price of a kilogram",
    "Of the material, in your currency, from which the panel tells the cost; 0: no cost is told",
    0.0, 0.0, 1e6,
)  # fmt: skip
LARGEST_AUTOMATIC = Preference(
    "LargestAutomaticTriangles", "Triangles to wait at",
    "A change that comes to more triangles waits for Update Lattice Infill",
    3_000_000, 0, 2_000_000_000,
)  # fmt: skip
LARGEST_SHOWN = Preference(
    "LargestShownTriangles", "Triangles to show",
    "A mesh of more triangles is shown by a coarse likeness; files stay full",
    1_000_000, 1_000, 2_000_000_000,
)  # fmt: skip
TRANSPARENCY = Preference(
    "Transparency", "Transparency",
    "Of a new infill, so that the lattice is seen through the skin",
    60, 0, 100, unit=" %",
)  # fmt: skip
MOST_PRISMS = Preference(
    "LargestShownStruts", "Struts to show as solids",
    "More struts than these are drawn as lines, in the preview and in the display mode "
    "Simplified",
    6_000, 0, 1_000_000,
)  # fmt: skip
STRUT_COLOUR = Colour("StrutColour", "Colour of the lattice", "Of a new infill", 0x216BB8FF)
SKIN_COLOUR = Colour("SkinColour", "Colour of the skin", "Of a new infill", 0xB8C2D1FF)
CUT_COLOUR = Colour("CutColour", "Colour of cut faces", "In Section View", 0xFA9429FF)
OVERHANG_COLOUR = Colour(
    "OverhangColour", "Colour of overhangs", "Of a new print check", 0xD9291FFF
)
THREADS = Preference(
    "Threads", "Threads",
    "For searching nearest points, measuring meshes and writing STL files, and at most so many "
    "processes that fill a part; automatic: one on each core",
    0, 1, 256, automatic=True,
)  # fmt: skip

#: The proxy of a mesh that is too large has this share of the triangles that may be shown.
LIKENESS = 0.25

#: All of them, as the tests and the page see them.
PREFERENCES = (
    CELL_TYPE, CELL_SIZE, STRUT_SHARE, SKIN, RESOLUTION, DEVIATION, AUTO_UPDATE, DENSITY,
    PRICE, LARGEST_AUTOMATIC, LARGEST_SHOWN, TRANSPARENCY, MOST_PRISMS, STRUT_COLOUR, SKIN_COLOUR,
    CUT_COLOUR, OVERHANG_COLOUR, THREADS,
)  # fmt: skip

#: What has been said about stored values, so that it is said once.
_said: set[tuple[str, str]] = set()


def read(preference: Preference) -> Any:
    """The stored value, or the default; what is not allowed is brought to what is, and told."""
    stored = _call("Get", preference, preference.default)
    value = allowed(preference, stored)
    if value != stored and (preference.key, repr(stored)) not in _said:
        _said.add((preference.key, repr(stored)))
        App.Console.PrintWarning(
            f"VOLFREP: the preference {preference.key} is {stored!r}, which is not possible: "
            f"{value!r} is used. Correct it in Edit > Preferences > VOLFREP.\n"
        )
    return value


def write(preference: Preference, value: Any) -> None:
    """Store a value, made an allowed one; the default is stored by storing nothing."""
    value = allowed(preference, value)
    if value == preference.default:
        _call("Rem", preference)
    else:
        _call("Set", preference, value)


def is_folded(section: str, usually: bool) -> bool:
    """Whether the user has folded a section of a panel away, or it usually is."""
    return bool(App.ParamGet(f"{GROUP}/Sections").GetBool(section, usually))


def keep_folded(section: str, folded: bool, usually: bool) -> None:
    """Remember whether a section is folded; what is usual is stored by storing nothing."""
    group = App.ParamGet(f"{GROUP}/Sections")
    if folded == usually:
        group.RemBool(section)
    else:
        group.SetBool(section, folded)


def allowed(preference: Preference, value: Any) -> Any:
    """The nearest value that the preference may have."""
    if preference.choices is not None:
        return value if value in preference.choices() else preference.default
    if isinstance(preference.default, bool) or (preference.automatic and value == 0):
        return value
    if math.isnan(value):
        return preference.default
    return type(preference.default)(min(max(value, preference.low), preference.high))


def colour(preference: Colour) -> tuple[float, float, float]:
    """A colour as red, green and blue from 0 to 1."""
    stored = read(preference)
    red, green, blue = (((stored >> shift) & 0xFF) / 255.0 for shift in (24, 16, 8))
    return red, green, blue


def largest_automatic() -> float:
    """Expected triangles above which a change waits for Update Lattice Infill, in the window.

    Without a window nobody waits: a recompute computes.
    """
    return float(read(LARGEST_AUTOMATIC)) if App.GuiUp else math.inf


def largest_shown() -> int:
    """Triangles above which a mesh is coarsened for the screen."""
    return int(read(LARGEST_SHOWN))


def triangles_drawn() -> tuple[int, int] | None:
    """Up to how many triangles a mesh is drawn as it is, and of how many for each kind otherwise.

    What is small keeps turning. None without a window.
    """
    return (largest_shown(), int(LIKENESS * largest_shown())) if App.GuiUp else None


def _call(verb: str, preference: Preference, *value: Any) -> Any:
    """Get, Set or Rem of FreeCAD's parameters, of the kind that the preference is."""
    if isinstance(preference, Colour):
        kind = "Unsigned"
    else:
        kind = {bool: "Bool", int: "Int", float: "Float", str: "String"}[type(preference.default)]
    return getattr(App.ParamGet(GROUP), verb + kind)(preference.key, *value)
