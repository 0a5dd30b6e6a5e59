# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an infill is made of and how it is printed, by the names its properties hold."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.properties.quantities import density_of
from volfrep.design.parameters.table import NOTHING, OWN_MATERIAL, SOLIDS_MATERIAL
from volfrep.util.errors import VolfrepError, listed

if TYPE_CHECKING:
    from volfrep.mechanics.materials import Material, SolidMaterial

#: FreeCAD's names of what we need of a material, and our units.
_CARD = {"density": ("Density", "g/cm^3"), "young": ("YoungsModulus", "MPa"),
         "poisson": ("PoissonRatio", ""), "yield_stress": ("YieldStrength", "MPa")}  # fmt: skip


def material_of(obj: App.DocumentObject) -> SolidMaterial | None:
    """The material that an infill's properties name; None for none.

    Raises:
        VolfrepError: its file, or the solid's material, is missing or lacks something.
    """
    from volfrep.mechanics.materials import find_material

    name = obj.PrintMaterial
    if name == NOTHING:
        return None
    if name == SOLIDS_MATERIAL:
        return _of_solid(obj.Base)
    if name != OWN_MATERIAL:
        return find_material(name)
    if not obj.MaterialFile.lower().endswith((".toml", ".json")):
        raise VolfrepError(
            "The material Custom needs a file: choose its .toml or .json file as MaterialFile."
        )
    return find_material(obj.MaterialFile)


def for_solver(obj: App.DocumentObject) -> Material:
    """The material of an infill's decks and analyses: PETG of its density where none is chosen."""
    from volfrep.mechanics.materials import Material

    found = material_of(obj)
    return Material(density=density_of(obj)) if found is None else found.for_solver()


def process_of(obj: App.DocumentObject) -> str | None:
    """The process that an infill is printed by, or the usual one of its material; None: unknown."""
    if obj.PrintProcess != NOTHING:
        return str(obj.PrintProcess)
    material = material_of(obj)
    return material.processes[0] if material is not None and material.processes else None


def advice(obj: App.DocumentObject, radius: float) -> tuple[str, ...]:
    """Sentences on what the chosen process does not do: the material, or struts of that radius."""
    from volfrep.reports.processes import find_process

    if obj.PrintProcess == NOTHING:
        return ()
    process, material = find_process(obj.PrintProcess), material_of(obj)
    found = []
    if material is not None and material.processes and process.name not in material.processes:
        found.append(
            f"{material.name} is printed by {listed(material.processes)}, not by {process.name}."
        )
    if 2.0 * radius < process.strut:
        found.append(
            f"Struts of {2.0 * radius:.3g} mm are thinner than {process.name} prints: at least "
            f"{process.strut:g} mm."
        )
    return tuple(found)


def _of_solid(base: App.DocumentObject | None) -> SolidMaterial:
    from volfrep.mechanics.materials import SolidMaterial

    cards = [] if base is None else list(_cards(base))
    if not cards:
        called = "The solid" if base is None else f"'{base.Label}'"
        raise VolfrepError(
            f"{called} has no material in FreeCAD: give it one, or choose another for the infill."
        )
    name, card = cards[0]
    values: dict[str, float] = {}
    for key, (entry, unit) in _CARD.items():
        try:
            quantity = App.Units.Quantity(str(card[entry]))
            values[key] = float(quantity.getValueAs(unit) if unit else quantity.Value)
        except (KeyError, ValueError, TypeError, ArithmeticError, App.Base.FreeCADError) as error:
            if key == "yield_stress":
                continue
            raise VolfrepError(
                f"The material '{name}' of '{base.Label}' has no {entry} that can be read: "
                "complete it, or choose another for the infill."
            ) from error
    plain = re.sub(r"[^-A-Za-z0-9_]", "_", name).lstrip("-_")[:70]
    return SolidMaterial(plain or "Material", source=f"the document's {name}", **values)


#: What FreeCAD 1.0 and later call the material of a shape that was given none.
_UNCHOSEN = "Default"


def _cards(base: App.DocumentObject) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Names and entries of the materials that FreeCAD knows of a solid, the nearest first.

    Of FreeCAD 1.0 and later the shape's own; a material that the object has, as in Arch; one of
    the FEM workbench that refers to it.
    """
    for obj in dict.fromkeys((base, base.getLinkedObject(True))):
        shaped = getattr(obj, "ShapeMaterial", None)
        entries = getattr(shaped, "PhysicalProperties", None)
        if entries and shaped.Name != _UNCHOSEN:
            yield str(shaped.Name), entries
        linked = getattr(obj, "Material", None)
        entries = linked if isinstance(linked, Mapping) else getattr(linked, "Material", None)
        if isinstance(entries, Mapping) and entries:
            yield str(entries.get("Name") or getattr(linked, "Label", "Material")), entries
        for other in obj.InList:
            if other.TypeId.startswith("App::MaterialObject") and other.Material:
                yield str(other.Material.get("Name") or other.Label), other.Material
