# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes lattice infills: for the command, for scripts and for the tests."""

from __future__ import annotations

import math
from typing import Any

import FreeCAD as App

from freecad_volfrep import preferences
from freecad_volfrep.features.jobs.screen import attach_view
from freecad_volfrep.features.properties.quantities import set_value
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError

from .lattice_infill import LatticeInfill
from .properties import INPUTS

#: So many cells are computed in seconds.
_QUICK_CELLS = 4000
#: A TPMS sheet is suggested to be so thick, in cells: a gyroid's relative density is then 31 %.
SHEET = 0.1


def make_lattice_infill(
    doc: App.Document, base: App.DocumentObject | None, **properties: Any
) -> App.DocumentObject:
    """Add a lattice infill of `base` to the document; ``doc.recompute()`` then computes it.

    Args:
        doc: the document that holds `base`.
        base: a solid, a Body, an App::Part, a Link to one of these, or a mesh object; a feature
            inside a Body stands for the Body.
        **properties: any of the object's properties by name, such as ``CellType="CVC"``,
            ``CellSize=10``, ``StrutRadius="0.8 mm"``, ``ShellThickness=3``, ``Label="Light"``;
            lengths in mm where they have no unit, the density in g/cm3.

    Returns:
        The new object, not computed yet.

    Raises:
        VolfrepError: there is no such property, or it does not take that value; nothing is added.
    """
    unknown = set(properties) - set(INPUTS) - {"Label"}
    if unknown:
        raise VolfrepError(
            f"A lattice infill has no property '{min(unknown)}': choose from {', '.join(INPUTS)}."
        )
    obj = doc.addObject("Mesh::FeaturePython", "LatticeInfill")
    try:
        LatticeInfill(obj)
        if base is not None:
            from freecad_volfrep.bridge.solids import resolve_base

            base = resolve_base(base)
            obj.Base = base
            obj.Label = translate("VolfrepLabels", "{label} lattice").format(label=base.Label)
        for name, value in properties.items():
            _set(obj, name, value)
    except VolfrepError:
        doc.removeObject(obj.Name)
        raise
    attach_view(obj)
    return obj


def preferred_values(extent: tuple[float, float, float]) -> dict[str, Any]:
    """What the user wants a new infill of a part of that extent in mm to start with.

    Sizes that are left to us are the suggested ones. Scripts make infills without this: what they
    make must not hang on who runs them.
    """
    sizes = suggested_sizes(extent, preferences.read(preferences.CELL_SIZE))
    sizes["StrutRadius"] = preferences.read(preferences.STRUT_SHARE) * sizes["CellSize"]
    sizes["ShellThickness"] = preferences.read(preferences.SKIN) or sizes["ShellThickness"]
    resolution = preferences.read(preferences.RESOLUTION)
    return {
        **sizes,
        "CellType": preferences.read(preferences.CELL_TYPE),
        "Resolution": resolution,
        "Deviation": 0.0 if resolution else preferences.read(preferences.DEVIATION),
        "AutoUpdate": preferences.read(preferences.AUTO_UPDATE),
        "Density": preferences.read(preferences.DENSITY),
        "MaterialPrice": preferences.read(preferences.PRICE),
    }


def suggested_sizes(extent: tuple[float, float, float], cell_size: float = 0.0) -> dict[str, float]:
    """Sizes to start from for a part of that extent in mm, with cells of that size unless it is 0.

    About four cells across its thinnest side, but not many more than fill its box quickly. The
    cell is a round number (1, 2 or 5 times a power of ten), the strut a tenth of it, and the
    skin a fifth, or more where a part is so large that its skin could not be resolved.
    """
    quick = math.prod(extent) / _QUICK_CELLS
    suitable = max(_round_number(min(extent) / 4.0), _round_number(2.5 * quick ** (1.0 / 3.0)))
    cell = cell_size or suitable
    thinnest_skin = float(f"{math.hypot(*extent) / 400.0:.2g}")
    return {
        "CellSize": cell,
        "StrutRadius": cell / 10.0,
        "WallThickness": SHEET * cell,
        "ShellThickness": max(cell / 5.0, thinnest_skin),
    }


def _round_number(value: float) -> float:
    """The largest of ... 0.5, 1, 2, 5, 10 ... that is not above the value."""
    decade = 10.0 ** math.floor(math.log10(value))
    return decade * max(step for step in (1.0, 2.0, 5.0) if step * decade <= value)


def _set(obj: App.DocumentObject, name: str, value: Any) -> None:
    try:
        set_value(obj, name, value)
    except (TypeError, ValueError, ArithmeticError, App.Base.FreeCADError) as error:
        choices = obj.getEnumerationsOfProperty(name)
        hint = f"choose one of {', '.join(choices)}" if choices else str(error).rstrip(".")
        raise VolfrepError(f"{name} cannot be {value!r}: {hint}.") from error
