# SPDX-License-Identifier: LGPL-2.1-or-later
"""Materials to print with, as built: typical figures with their sources, and the user's own.

A printed material depends on machine, parameters, direction and treatment: these are figures to
begin with. `source` says of each figure whose it is, and which were not read there ("not
checked"): those are usual figures of such a material, to be held against your supplier's. Data
sheets give no Poisson's ratio: it is the handbook's for the wrought or moulded material.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ..util.arguments import check_kind
from ..util.errors import VolfrepError
from ..util.numbers import number
from ..util.reading import read_json, read_toml

MAX_FILE_BYTES = 100_000
_NAME = re.compile(r"[A-Za-z0-9][-\w]{0,70}", re.ASCII)


@dataclass(frozen=True)
class Material:
    """A linear elastic material; the default is PETG.

    Attributes:
        name: as it appears in the deck; at most 80 letters, digits, ``-`` and ``_``.
        young: Young's modulus, MPa.
        poisson: Poisson's ratio.
        density: g/cm3.
    """

    name: str = "PETG"
    young: float = 2100.0
    poisson: float = 0.38
    density: float = 1.27

    def __post_init__(self) -> None:
        if not (self.young > 0 and -1 < self.poisson < 0.5 and self.density > 0):
            raise VolfrepError(
                f"The material '{self.name}' must have a modulus and a density above 0 and a "
                "Poisson's ratio between -1 and 0.5."
            )


@dataclass(frozen=True)
class SolidMaterial:
    """A linear elastic material that yields.

    Attributes:
        name: as a user picks it; letters, digits, ``-`` and ``_``.
        density: g/cm3.
        young: Young's modulus, MPa.
        poisson: Poisson's ratio.
        yield_stress: MPa, or the tensile strength where a plastic shows no yield; None: not known.
        processes: the names of the processes that print it.
        source: where the figures are from.
    """

    name: str
    density: float
    young: float
    poisson: float
    yield_stress: float | None = None
    processes: tuple[str, ...] = ()
    source: str = "the user"

    def __post_init__(self) -> None:
        if not _NAME.fullmatch(self.name):
            raise VolfrepError(
                f"The material's name '{self.name}' must consist of letters, digits, '-' and '_'."
            )
        number(f"density of '{self.name}'", self.density, "g/cm3", positive=True)
        number(f"Young's modulus of '{self.name}'", self.young, "MPa", positive=True)
        if self.yield_stress is not None:
            number(f"yield stress of '{self.name}'", self.yield_stress, "MPa", positive=True)
        if not -1.0 < self.poisson < 0.5:
            raise VolfrepError(
                f"The material '{self.name}' must have a Poisson's ratio between -1 and 0.5, "
                f"not {self.poisson:g}."
            )

    def for_solver(self, density: float | None = None) -> Material:
        """The material of a solver's deck, with another density (g/cm3) if one is given."""
        return Material(self.name, self.young, self.poisson, density or self.density)

    def as_dict(self) -> dict[str, Any]:
        """The figures as plain JSON values."""
        return {**asdict(self), "processes": list(self.processes)}


_METAL = ("LPBF",)
_POWDER = ("SLS", "MJF")
#: Typical figures along the build direction, as built.
MATERIALS = {
    material.name.lower(): material
    for material in (
        SolidMaterial("Ti-6Al-4V", 4.41, 110_000, 0.34, 1_000, ("LPBF", "EBM"),
                      "EOS Titanium Ti64, data sheet (M 290, 30 um): density; the others not "
                      "checked (JAMPT measured a yield of 1,130 by LPBF, 996 by EBM)"),
        SolidMaterial("AlSi10Mg", 2.67, 70_000, 0.33, 240, _METAL,
                      "EOS Aluminium AlSi10Mg, data sheet (upright): density, modulus, yield; nu: "
                      "handbook"),
        SolidMaterial("316L", 7.97, 185_000, 0.30, 480, _METAL,
                      "EOS StainlessSteel 316L-4441, data sheet (M 290, 20 um, upright): "
                      "density and yield; modulus within what Hitzler et al. measured "
                      "(Materials 10, 2017, 1136: 148,000 to 227,000 by direction); nu: "
                      "handbook"),
        SolidMaterial("IN718", 8.15, 160_000, 0.29, 634, _METAL,
                      "EOS NickelAlloy IN718, data sheet (M 290, 40 um) as others quote it: "
                      "density; modulus and yield not checked; nu: handbook"),
        SolidMaterial("PA12", 0.93, 1_550, 0.40, 42, _POWDER,
                      "EOS PA 2200, data sheet as others quote it: modulus and strength "
                      "(upright; along X 1,600 and 48 MPa); density within additive.tools' "
                      "(0.88-0.96); nu: handbook"),
        SolidMaterial("PA11", 0.99, 1_600, 0.40, 48, _POWDER,
                      "EOS PA 1101: not checked in its sheet, but within additive.tools' "
                      "(0.93-1.00, 1,000-2,000, 37-48); nu: handbook"),
        SolidMaterial("TPU", 1.10, 80, 0.45, None, _POWDER,
                      "MakerVerse's guide (MJF, Shore A 88 to 90): density, modulus (75 to 85, "
                      "ISO 527, small strains); nu: handbook of rubbers; no yield: it stays "
                      "elastic, and strength has no limit to be sized for"),
        SolidMaterial("PLA", 1.24, 2_350, 0.36, 49.5, ("FFF",),
                      "Ultimaker PLA, data sheet as others quote it: modulus and yield; density "
                      "and nu: FreeCAD's card PLA-Generic"),
        SolidMaterial("PETG", 1.27, 2_100, 0.38, 47, ("FFF",),
                      "Prusament PETG, data sheet as others quote it: density; modulus and nu: "
                      "the VOLFREP paper's sample; yield not checked, but within "
                      "additive.tools' strength (44-56)"),
        SolidMaterial("ABS", 1.10, 1_680, 0.39, 39, ("FFF",),
                      "Ultimaker ABS: not checked in its sheet, but between Kimya's 1,443 and "
                      "35.3 (PMC10406103) and Stratasys' P400 of 1.05 g/cm3, 2,480 and 34; "
                      "FreeCAD's card ABS-Generic: density 1.06, nu 0.37"),
        SolidMaterial("Resin", 1.17, 2_800, 0.40, 65, ("SLA",),
                      "Formlabs Clear Resin V4, cured: not checked in its sheet; density and "
                      "strength within renato.design's for clear resins (1.1-1.2, 38-65), "
                      "modulus near 2,900 of Surgical Guide (PMC10406103); nu: handbook"),
    )
}  # fmt: skip
_FIELDS = {"name", "density", "young", "poisson", "yield_stress", "processes", "source"}


def find_material(text: str) -> SolidMaterial:
    """The material that a text names.

    Args:
        text: a name of the table (case does not matter); the path of a .toml or .json file with
            ``name``, ``density``, ``young``, ``poisson`` and, if known, ``yield_stress``; or
            ``NAME,E,NU`` in MPa, with a density of 1 g/cm3 until one is given.

    Raises:
        VolfrepError: there is no such material, or its figures make no sense.

    >>> find_material("pa12").young, find_material("Mine,2000,0.3").poisson
    (1550, 0.3)
    """
    check_kind("material", text, str, "a material's name or file")
    wanted = text.strip()
    known = MATERIALS.get(wanted.lower())
    if known is not None:
        return known
    if wanted.lower().endswith((".json", ".toml")):
        return load_material(Path(wanted))
    parts = wanted.split(",")
    if len(parts) == 3:
        try:
            young, poisson = float(parts[1]), float(parts[2])
        except ValueError:
            pass
        else:
            listed = MATERIALS.get(parts[0].strip().lower())
            density = 1.0 if listed is None else listed.density
            return SolidMaterial(parts[0].strip(), density, young, poisson)
    names = ", ".join(material.name for material in MATERIALS.values())
    raise VolfrepError(
        f"There is no material '{text}': choose one of {names}, give the path of a .toml or .json "
        "file, or a name and two numbers such as PETG,2100,0.38."
    )


def load_material(path: Path) -> SolidMaterial:
    """A material from a TOML or JSON file.

    Raises:
        VolfrepError: naming the file and what is wrong in it.
    """
    read = read_json if path.suffix.lower() == ".json" else read_toml
    values = read(path, "material file")
    if not isinstance(values, dict):
        raise VolfrepError(f"The material file '{path}' must hold names and values.")
    return material_of(values, f"the material file '{path}'", path.stem, path.name)


def material_of(
    values: Mapping[str, Any], where: str, name: str, source: str = "the user"
) -> SolidMaterial:
    """A material from the entries of a file, or of a table in one.

    Args:
        values: ``density``, ``young``, ``poisson`` and, if known, the other attributes by name.
        where: they stand, for the sentences.
        name: where the entries give none.
        source: where the entries give none.

    Raises:
        VolfrepError: an entry is missing, unknown or makes no sense.
    """
    there = where[0].upper() + where[1:]
    unknown, missing = values.keys() - _FIELDS, {"density", "young", "poisson"} - values.keys()
    if unknown or missing:
        what = f"has no '{min(missing)}'" if missing else f"has an unknown entry '{min(unknown)}'"
        raise VolfrepError(
            f"{there} {what}: give density (g/cm3), young (MPa), poisson and, if known, name, "
            "yield_stress (MPa), processes and source."
        )
    try:
        numbers = {k: float(values[k]) for k in ("density", "young", "poisson")}
        limit = values.get("yield_stress")
        return SolidMaterial(
            name=str(values.get("name", re.sub(r"[^-\w]", "_", name))),
            yield_stress=None if limit is None else float(limit),
            processes=tuple(str(name) for name in values.get("processes", ())),
            source=str(values.get("source", source)),
            **numbers,
        )
    except (TypeError, ValueError) as error:
        if isinstance(error, VolfrepError):
            raise VolfrepError(f"In {where}: {error}") from error
        raise VolfrepError(
            f"In {where}, density, young, poisson and yield_stress must be numbers, processes a "
            "list of names."
        ) from error
