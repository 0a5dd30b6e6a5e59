# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specifications made of values by name, and taken apart into them.

A row of the table that names a field goes there and comes back from there by itself (`_fields`,
`spec_value`); only what takes more than copying is spelled out: cells, targets, faces, files.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ...util.errors import VolfrepError, listed
from ..cells import any_cell, find_cell
from ..grading import CellMap, Field, Orientation, RadiusGrading, SizeGrading, read_point_field
from ..graphs import GivenGraph, RandomGraph
from ..openings import DrainHoles, DrainPlace, OpenFace, OpenPatch, OpenPlane, SmoothFace
from ..profile import SAMPLED, Profile
from ..scattered_field import read_curve
from ..skins.kept_bodies import KeptBody, read_body
from ..skins.own_faces import FaceSkin, KeptFace
from ..spec import LatticeSpec
from ..spec_parts import FlatStruts, first_radius
from ..target import THICKNESSES, Target, read_target, stiffness_text
from ..tpms import TpmsSheet
from .parameter import Need, Parameter, effective
from .table import BY_NAME, PARAMETERS, TWO_ENDED
from .values import field_file, is_file

#: How a user calls a parameter: in an option, a file, or a document.
Naming = Callable[[str], str]


def in_file(name: str) -> str:
    """A parameter as the files of specifications call it."""
    return name


def specification(values: Mapping[str, Any], say: Naming = in_file) -> LatticeSpec:
    """The specification that the values stand for; what is not given has its default.

    Args:
        values: by the names of the table. `cell` may be a `UnitCell`, and `radius_field` a
            `PointField`; `open_faces`, `skin_faces` and `keep_solid_around` are as those of
            `LatticeSpec`, beside what is named by numbers and files; `network_faces` is the
            network that is laid along them.
        say: how to call a parameter in an error.

    Raises:
        VolfrepError: a value makes no sense, has no effect, or is missing.
    """
    refuse_idle(values, say)
    used, idle = effective(PARAMETERS, values)
    for parameter in PARAMETERS:
        if parameter.required and parameter.name not in idle and used[parameter.name] is None:
            chooser = parameter.needs[0].names[0]
            raise VolfrepError(
                f"{say(chooser)} {used[chooser]} needs {say(parameter.name)}: give it."
            )
    target = _target(values, used, say)
    radius = used["strut_radius"]
    if target is not None:
        radius = first_radius(used["cell_size"], used["fillet"])
    cell = used["cell"]
    if isinstance(cell, str):
        cell = any_cell(cell, used["cell_values"], used["wall_formula"] or "")
    elif used["cell_values"].strip():
        raise VolfrepError(
            f"{say('cell_values')} are for cells by name or file, not for one that is given whole: "
            "leave them out."
        )
    parts = _fields(used)
    if isinstance(parts[""]["skin_field"], str):
        parts[""]["skin_field"] = read_point_field(parts[""]["skin_field"])
    return LatticeSpec(
        **parts[""] | {"strut_radius": radius},
        **_skin_of(used),
        cell=cell,
        drains=_drains(parts["drains"], used),
        flat_struts=_flat_struts(parts["flat_struts"], used),
        size_grading=_size_grading(parts),
        radius_grading=_radius_grading(parts, used, cell.measure, say),
        cell_map=CellMap(**parts["cell_map"]) if used["cell_map"] != "cartesian" else None,
        orientation=_orientation(used["rotate"], parts["orientation"]),
        target=target,
        network=_network(parts["network"], used, say),
        wall=TpmsSheet(**parts["wall"]),
    )


def _fields(used: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The values as the rows of the table say where they belong: by part, then by field.

    What is a field of the specification itself has the part "".
    """
    parts: dict[str, dict[str, Any]] = {}
    for row in PARAMETERS:
        if row.field:
            part, _, name = row.field.rpartition(".")
            value = used[row.name]
            parts.setdefault(part, {})[name] = None if row.is_none and not value else value
    return parts


def spec_value(spec: LatticeSpec, row: Parameter) -> Any:
    """What a specification holds of a row's value; None where there is no such part of it."""
    value: Any = spec
    for name in row.field.split("."):
        value = getattr(value, name, None)
    if value is None or row.name not in _AS_VALUE:
        return value
    return _AS_VALUE[row.name](value)


def refuse_idle(values: Mapping[str, Any], say: Naming = in_file) -> None:
    """Refuse a value that another one, which it needs, leaves without effect.

    Raises:
        VolfrepError: naming both.
    """
    _, idle = effective(PARAMETERS, values)
    for name, need in idle.items():
        if values.get(name) is not None:
            raise VolfrepError(_useless(name, need, say))


def merge_values(given: Mapping[str, Any], file: Mapping[str, Any]) -> dict[str, Any]:
    """The values of a file, with those that are given in their place.

    What of the file has no effect any more beside the given values is left out.
    """
    replaced = {name for key in given for name in BY_NAME[key].instead_of}
    result = {key: value for key, value in file.items() if key not in replaced} | dict(given)
    _, idle = effective(PARAMETERS, result)
    return {key: value for key, value in result.items() if key in given or key not in idle}


def values_of(spec: LatticeSpec) -> dict[str, Any]:
    """The values by name that `specification` makes the same specification of.

    Only those that differ from their defaults and have an effect, and the sizes.

    Raises:
        VolfrepError: it holds what no value can say: a cell or a field without a file, or a face
            picked in FreeCAD.
    """
    found = {row.name: spec_value(spec, row) for row in PARAMETERS if row.field}
    assert not isinstance(spec.cell, str)
    found |= {**spec.cell.as_values(), **_skin_values(spec)}
    if spec.drains is not None:
        found["drain"] = tuple((*p.point, *(p.direction or ())) for p in spec.drains.places)
    if spec.flat_struts is not None:
        found["build_direction"] = spec.flat_struts.build_direction
    if spec.orientation is not None:
        found["rotate"] = (*spec.orientation.axis, spec.orientation.angle)
    found |= spec.kind.as_values()
    if spec.target is not None:
        aim = spec.target.aim
        found[aim] = stiffness_text(spec.target) if aim == "stiffness" else spec.target.value
        for name in THICKNESSES:
            found.pop(name, None)
    _, idle = effective(PARAMETERS, found)
    always = ("cell", "cell_size", "shell", *(name for name in THICKNESSES if name not in idle))
    return {
        name: value
        for name, value in found.items()
        if name in always
        or (name not in idle and value not in (None, (), BY_NAME[name].default))
    }  # fmt: skip


def _target(values: Mapping[str, Any], used: Mapping[str, Any], say: Naming) -> Target | None:
    """What the radius is to be chosen for; None where it is given or has its default.

    Raises:
        VolfrepError: several values say how thick struts are, or there are none to be chosen.
    """
    target = read_target(values, say=say)
    if target is None:
        return None
    for other, word in (("radius_grading", "none"), ("make", None)):
        value = used[other]
        if value != word and (word or value == "domain"):
            raise VolfrepError(
                f"{say(target.aim)} chooses one radius for all struts, and has no effect with "
                f"{say(other)} {value}: leave one of them out."
            )
    return target


def _useless(name: str, need: Need, say: Naming) -> str:
    what = listed([say(other) for other in need.names])
    if need.absent:
        such = "such a " * bool(need.values)
        return f"{say(name)} has no effect with {such}{what}: leave one of them out."
    if need.values:
        what += f" {listed([str(value) for value in need.values])}"
    return f"{say(name)} has no effect without {what}: add that or leave it."


def _drains(own: Mapping[str, Any], used: Mapping[str, Any]) -> DrainHoles | None:
    if not own["diameter"]:
        return None
    places = tuple(
        DrainPlace((x, y, z), (way[0], way[1], way[2]) if way else None)
        for x, y, z, *way in (*(used["drain_points"] or ()), *(used["drain"] or ()))
    )
    return DrainHoles(places=places, **own)


def _flat_struts(own: Mapping[str, Any], used: Mapping[str, Any]) -> FlatStruts | None:
    if not own["inclination"]:
        return None
    return FlatStruts(**own, build_direction=used["build_direction"])


def _profile(kind: str, start: float, end: float | None, expression: str | None) -> Profile:
    if kind == "formula":
        return Profile("expression", expression=expression or "")
    return Profile(kind, start, start if end is None else end)


def _size_grading(parts: Mapping[str, Any]) -> SizeGrading | None:
    profile = parts["size_grading.profile"]
    if profile["kind"] == "none":
        return None
    return SizeGrading(_profile(**profile), **parts["size_grading"])


def _radius_grading(
    parts: Mapping[str, Any], used: Mapping[str, Any], measure: str, say: Naming
) -> RadiusGrading | None:
    own, wanted = dict(parts["radius_grading"]), parts["radius_grading.profile"]
    if own["by"] == "none":
        return None
    # Both are read now, so that what is wrong with them is said before the work.
    own["curve"] = read_curve(own["curve"]) if own["curve"].strip() else ()
    if isinstance(own["field"], str):
        own["field"] = read_point_field(own["field"], own["column"])
    profile = Profile()  # a curve needs none
    if not own["curve"]:
        usual = used[measure]
        start, end = wanted["start"], wanted["end"]
        if wanted["kind"] in TWO_ENDED and start == end == 0.0:
            raise VolfrepError(
                f"A radius grading needs {say('radius_start')} or {say('radius_end')}: without "
                "both, every strut has the strut radius."
            )
        profile = _profile(**wanted | {"start": start or usual, "end": end or usual})
    return RadiusGrading(profile=profile, **own)


def _word(kind: str) -> str:
    """A profile's kind as users call it.

    Raises:
        VolfrepError: it has no word, because a field gave it.
    """
    if kind == SAMPLED:
        raise VolfrepError(
            "Cell sizes that follow a field have no entry in a file: give 'size_grading' and "
            "'lambda_formula' in place of a 'cell_size' by place."
        )
    return "formula" if kind == "expression" else kind


def _radius_file(field: Field | str) -> str:
    return field if isinstance(field, str) else field_file(field, "the radius follows")


#: Of rows whose value is not what their field holds: the value that stands for it.
_AS_VALUE: dict[str, Callable[[Any], Any]] = {
    "size_grading": _word,
    "radius_profile": _word,
    "radius_field": _radius_file,
    "skin_field": lambda field: field_file(field, "the skin follows"),
    "radius_curve": lambda curve: ", ".join(f"{value!r}:{radius!r}" for value, radius in curve),
    "network_field": lambda field: field_file(field, "the points' density follows"),
}


def _network(
    own: Mapping[str, Any], used: Mapping[str, Any], say: Naming
) -> GivenGraph | RandomGraph | None:
    if used["network"] == "cells":
        return None
    if used["network"] == "file":
        if not used["network_file"]:
            raise VolfrepError(f"{say('network')} file needs {say('network_file')}: give it.")
        from ..graphs.files import read_network  # reads many formats, slow to import

        thickness, layers = used["network_thickness"], used["network_layers"]
        cell = used["cell"]
        made = read_network(
            used["network_file"],
            find_cell(cell, used["cell_values"]) if isinstance(cell, str) else cell,
            -thickness if used["network_reversed"] else thickness,
            layers or max(1, round(thickness / used["cell_size"])),
        )
        for name in ("network_thickness", "network_layers", "network_reversed"):
            if used[name] and not made.thickness:
                raise VolfrepError(
                    f"{say(name)} is for layers of cells upon quadrilaterals, of which none are "
                    f"made of '{used['network_file']}': leave it out."
                )
        return made
    if used["network"] == "faces":
        if used["network_faces"] is None:
            raise VolfrepError(
                "Faces for a network to follow are picked in FreeCAD: give a file of hexahedra or "
                f"of quadrilaterals as {say('network_file')}."
            )
        laid: GivenGraph = used["network_faces"]
        return laid
    field = own["field"]
    return RandomGraph(
        **{**own, "field": read_point_field(field) if isinstance(field, str) else field}
    )


def _orientation(rotate: tuple[float, ...] | None, own: Mapping[str, Any]) -> Orientation | None:
    if rotate is None:
        return None
    *axis, angle = rotate
    return Orientation((axis[0], axis[1], axis[2]), angle, **own)


def _skin_of(used: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a `LatticeSpec` about faces and what is kept solid.

    Args:
        used: values by the names of the table; faces that were picked are those of `LatticeSpec`.

    Raises:
        VolfrepError: a body cannot be read, or a thickness makes no sense.
    """
    planes = tuple(
        OpenPlane((x, y, z), (nx, ny, nz)) for x, y, z, nx, ny, nz in used["open_plane"] or ()
    )
    skins = tuple(FaceSkin(_face(numbers), numbers[-1]) for numbers in used["skin_face"] or ())
    kept = tuple(
        read_body(one) if isinstance(one, str) else KeptFace(_face(one), one[-1])
        for one in used["keep_solid"] or ()
    )
    return {
        "open_faces": (*(used["open_faces"] or ()), *planes),
        "face_skins": (*(used["skin_faces"] or ()), *skins),
        "keep_solid": (*(used["keep_solid_around"] or ()), *kept),
    }


def _skin_values(spec: LatticeSpec) -> dict[str, Any]:
    """The values by name that `_skin_of` makes the same fields of.

    Raises:
        VolfrepError: a face was picked in FreeCAD, or a body has no file.
    """
    opened = [f for f in spec.open_faces if not isinstance(f, SmoothFace)]
    skins = [FaceSkin(f, 0.0) for f in spec.open_faces if isinstance(f, SmoothFace)]
    planes = [_numbers(face, "open") for face in opened]
    own = [
        (*_numbers(skin.face, "have a skin of their own"), skin.thickness)
        for skin in (*skins, *spec.face_skins)
    ]
    return {
        "open_plane": tuple(planes),
        "skin_face": tuple(own),
        "keep_solid": tuple(_kept_text(one) for one in spec.keep_solid),
    }


def _kept_text(one: KeptFace | KeptBody) -> str | tuple[float, ...]:
    if isinstance(one, KeptFace):
        return (*_numbers(one.face, "kept solid"), one.distance)
    if not one.source or not is_file(one.source):
        raise VolfrepError(
            f"'{one.name}' to keep solid has no file that could be named: save it as .stl first."
        )
    return one.source


def _face(numbers: tuple[float, ...]) -> OpenFace:
    """The faces that numbers name, without the length behind them."""
    x, y, z, *normal = numbers[:-1]
    if not normal:
        return SmoothFace((x, y, z))
    nx, ny, nz = normal
    return OpenPlane((x, y, z), (nx, ny, nz))


def _numbers(face: OpenFace, what: str) -> tuple[float, ...]:
    if isinstance(face, OpenPatch):
        to_be = what if what.startswith("have") else f"be {what}"
        raise VolfrepError(
            f"Faces that were picked to {to_be} have no place in a file: leave them out, or give "
            "planes."
        )
    return face.point if isinstance(face, SmoothFace) else (*face.point, *face.normal)
