# SPDX-License-Identifier: LGPL-2.1-or-later
"""The designs of a study: a specification each, its key, and the command that makes just that part.

A design's key is the content of what goes into it: the proved solid, the specification, and the
version of the engine. Where the solid, a cell or a field was read does not matter.
"""

from __future__ import annotations

import dataclasses
import os
import shlex
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..design.parameters.parameter import REPEATED
from ..design.parameters.specification import specification
from ..design.parameters.table import BY_NAME, PARAMETERS
from ..design.parameters.values import LENGTHS, SCALES, value_to_json
from ..design.spec import LatticeSpec
from ..io.solid import Solid, read_solid, solid_of
from ..mechanics.materials import SolidMaterial
from ..util.content import content_of, digest_of
from ..util.errors import VolfrepError
from ..util.version import VERSION
from .sampling import grid, latin_hypercube
from .study import Study


@dataclass(frozen=True)
class Part:
    """A part of a study, as it is kept in the study's folder.

    Attributes:
        name: the file's, or ``part``.
        source: the path that was given; empty for a solid that was.
        content: of the proved solid, as hexadecimal digits.
        box: its size along x, y, z, mm.
    """

    name: str
    source: str
    content: str
    box: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Design:
    """One of many.

    Attributes:
        key: names its record; 16 hexadecimal digits.
        part: what is filled.
        values: of the parameters that were given, by name.
        spec: what is made.
    """

    key: str
    part: Part
    values: Mapping[str, Any]
    spec: LatticeSpec


@dataclass(frozen=True, eq=False)
class Designs:
    """All designs of a study.

    Attributes:
        designs: each once, in the study's order.
        refused: how often a sentence says why a combination makes no sense.
        repeated: combinations that are the same as an earlier one.
    """

    designs: tuple[Design, ...]
    refused: Mapping[str, int]
    repeated: int


def combinations(study: Study) -> list[dict[str, Any]]:
    """The values that differ from design to design, by name."""
    if study.sampling == "list":
        return [dict(values) for values in study.designs]
    if study.sampling == "grid":
        return grid(study.vary)
    return latin_hypercube(study.vary, study.samples, study.seed)


def designs_of(study: Study, parts: tuple[Part, ...]) -> Designs:
    """The designs of a study; combinations that make no sense are counted and passed over."""
    material = study.solid_material()
    found: dict[str, Design] = {}
    refused: Counter[str] = Counter()
    repeated = 0
    rows = combinations(study)
    for part in parts:
        for row in rows:
            try:
                design = design_of(part, {**study.fixed, **row}, material, VERSION)
            except VolfrepError as error:
                refused[str(error)] += 1
                continue
            repeated += design.key in found
            found.setdefault(design.key, design)
    return Designs(tuple(found.values()), refused, repeated)


def design_of(
    part: Part, values: Mapping[str, Any], material: SolidMaterial | None, version: str
) -> Design:
    """The design of values by name.

    Raises:
        VolfrepError: they make no sense, or do not go with the part.
    """
    spec = specified(values, material)
    if spec.cell_size > max(part.box):
        size = " x ".join(f"{side:.4g}" for side in part.box)
        raise VolfrepError(
            f"Cells of {spec.cell_size:g} mm are larger than '{part.name}', which measures {size} "
            "mm: leave such sizes out."
        )
    return Design(key_of(part.content, spec, values, version), part, values, spec)


def specified(values: Mapping[str, Any], material: SolidMaterial | None) -> LatticeSpec:
    """The specification of values by name, with a material's density where they have none.

    Raises:
        VolfrepError: they make no sense.
    """
    spec = specification(values)
    if material is None:
        return spec
    if values.get("density") is None:
        spec = dataclasses.replace(spec, density=material.density)
    if spec.target is not None and spec.target.aim == "stiffness":
        target = dataclasses.replace(spec.target, young=material.young)
        spec = dataclasses.replace(spec, target=target)
    return spec


def key_of(content: str, spec: LatticeSpec, values: Mapping[str, Any], version: str) -> str:
    """The key of a design; the build direction, which a print check sees, is in it too."""
    up = values.get("build_direction") or BY_NAME["build_direction"].default
    return digest_of(version, content, spec.digest(), tuple(up))[:16]


def named_part(source: str, solid: Solid) -> Part:
    """A part with its content; `source` is empty for a solid that was given as it is."""
    name = Path(source).name if source else "part"
    box = tuple(float(side) for side in np.ptp(solid.bounds, axis=0))
    content = content_of(solid.vertices, solid.triangles).hex()
    return Part(name, source, content, (box[0], box[1], box[2]))


def read_part(part: object, unit: str | None) -> tuple[str, Solid]:
    """Where a part of a study is from, and its proved solid.

    Raises:
        VolfrepError: it is no closed solid.
    """
    if isinstance(part, (str, os.PathLike)):
        return os.fspath(part), read_solid(part, unit)
    return "", solid_of(part)


def command_of(design: Design, study: Study, source: str, output: str) -> str:
    """The command that makes a design's part.

    Args:
        design: of which.
        study: says material and process.
        source: of the part's file.
        output: the file to write.
    """
    words = ["volfrep", "fill", source, "-o", output]
    for parameter in PARAMETERS:
        value = design.values.get(parameter.name)
        if value is None or not parameter.in_command:
            continue
        option = f"--{parameter.name.replace('_', '-')}"
        if parameter.kind == "flag":
            words.append(option if value else f"--no-{option[2:]}")
        elif parameter.kind in REPEATED:
            items = (item if isinstance(item, str) else _numbers(item) for item in value)
            words += [f"{option}={item}" for item in items]
        elif parameter.kind in LENGTHS:
            words.append(f"{option}={_numbers(value)}")
        else:
            words += [option, _value_text(parameter.kind, value)]
    if study.material is not None:
        named = study.material
        words += ["--material", named if isinstance(named, str) else named.name]
    if study.unit is not None:
        words += ["--unit", study.unit]
    return shlex.join(words)


def shown_values(design: Design) -> dict[str, Any]:
    """The values as plain JSON values."""
    shown = {}
    for name, value in design.values.items():
        if value is None:
            continue
        parameter = BY_NAME[name]
        if parameter.in_command and not dataclasses.is_dataclass(value):
            shown[name] = value_to_json(parameter, value)
        else:
            shown[name] = getattr(value, "name", None) or str(value)
    return shown


def _value_text(kind: str, value: Any) -> str:
    if dataclasses.is_dataclass(value):
        return str(getattr(value, "source", "") or getattr(value, "name", ""))
    return repr(float(value)) if kind == "number" or kind in SCALES else str(value)


def _numbers(values: Any) -> str:
    return ",".join(repr(float(value)) for value in values)
