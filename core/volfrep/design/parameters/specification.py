# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specifications made of values by name, and taken apart into them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ...util.errors import VolfrepError
from ..cells import LIBRARY, UnitCell, find_cell
from ..grading import CellMap, Orientation, RadiusGrading, SizeGrading, read_point_field
from ..graphs import GivenGraph, RandomGraph, read_network
from ..openings import DrainHoles, DrainPlace, OpenFace, OpenPatch, OpenPlane, SmoothFace
from ..profile import Profile
from ..scattered_field import PointField, read_curve
from ..skins.kept_bodies import KeptBody, read_body
from ..skins.own_faces import FaceSkin, KeptFace
from ..spec import LatticeSpec
from ..spec_parts import first_radius
from ..target import THICKNESSES, Target, read_target, stiffness_text
from ..tpms import FORMULA, SURFACES, PeriodicSurface, TpmsSheet, find_surface, surface_name
from .parameter import Need, effective
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
        cell = find_surface(cell, used["wall_formula"] or "") or find_cell(
            cell, used["cell_values"]
        )
    elif used["cell_values"].strip():
        raise VolfrepError(
            f"{say('cell_values')} are for cells by name or file, not for one that is given whole: "
            "leave them out."
        )
    return LatticeSpec(
        cell=cell,
        cell_size=used["cell_size"],
        strut_radius=radius,
        shell=used["shell"],
        fillet=used["fillet"],
        origin=used["origin"],
        activation=used["activation"],
        boundary=used["boundary"],
        remove_dangling=used["remove_dangling"],
        keep_pieces=used["keep_pieces"],
        shortest_stub=used["shortest_stub"],
        **_skin_of(used),
        remove_below=used["remove_below"],
        drains=_drains(used),
        resolution=used["resolution"] or None,
        deviation=used["deviation"] or None,
        output=used["make"],
        density=used["density"],
        size_grading=_size_grading(used),
        radius_grading=_radius_grading(used, say),
        cell_map=_cell_map(used),
        orientation=_orientation(used),
        keep_radius=used["keep_radius"],
        target=target,
        network=_network(used, say),
        wall=TpmsSheet(used["wall_kind"], used["wall_thickness"], used["wall_offset"]),
    )


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
    cell, values = spec.cell, {}
    if isinstance(cell, UnitCell):
        values = {"cell_values": cell.values}
        own = cell.name not in LIBRARY or find_cell(cell.name, cell.values) != cell
        if own and not (cell.source and is_file(cell.source)):
            raise VolfrepError(
                f"The cell '{cell.name}' has no file that could be named: save it as .json first."
            )
        cell = cell.source if own else cell.name
    walls: dict[str, Any] = {}
    if isinstance(cell, PeriodicSurface):
        walls = {
            "wall_kind": spec.wall.kind,
            "wall_thickness": spec.wall.thickness,
            "wall_offset": spec.wall.offset,
            "wall_formula": cell.formula,
        }
        cell = cell.name if SURFACES.get(cell.name) == cell else FORMULA
    found: dict[str, Any] = {
        "cell": cell, "cell_size": spec.cell_size, "strut_radius": spec.strut_radius,
        "shell": spec.shell, "fillet": spec.fillet, "origin": spec.origin,
        "activation": spec.activation, "boundary": spec.boundary,
        "remove_dangling": spec.remove_dangling, "shortest_stub": spec.shortest_stub,
        "remove_below": spec.remove_below, "keep_pieces": spec.keep_pieces,
        "resolution": spec.resolution, "deviation": spec.deviation, "make": spec.output,
        "density": spec.density, "keep_radius": spec.keep_radius, **walls, **values,
    }  # fmt: skip
    found |= _skin_values(spec)
    if spec.drains is not None:
        found["drain_diameter"] = spec.drains.diameter
        found["drain"] = tuple((*p.point, *(p.direction or ())) for p in spec.drains.places)
        found["drain_count"] = spec.drains.count
        found["build_direction"] = spec.drains.build_direction
    if spec.size_grading is not None:
        profile = spec.size_grading.profile
        found["size_grading"] = _word(profile)
        found["lambda_start"], found["lambda_end"] = profile.start, profile.end
        found["lambda_formula"] = profile.expression
        found["grading_direction"] = spec.size_grading.direction
    if spec.radius_grading is not None:
        found |= _radius_values(spec.radius_grading)
    if spec.cell_map is not None:
        found["cell_map"], found["map_centre"] = spec.cell_map.kind, spec.cell_map.centre
        found["map_axis"], found["map_around"] = spec.cell_map.axis, spec.cell_map.around
    if spec.orientation is not None:
        found["rotate"] = (*spec.orientation.axis, spec.orientation.angle)
        found["rotate_origin"] = spec.orientation.origin
    if isinstance(spec.network, GivenGraph):
        if not spec.network.source or not is_file(spec.network.source):
            raise VolfrepError(
                "The network has no file that could be named: save it as .json first."
            )
        found["network"], found["network_file"] = "file", spec.network.source
        found["network_thickness"] = abs(spec.network.thickness)
        found["network_layers"] = spec.network.layers if spec.network.thickness else 0
        found["network_reversed"] = spec.network.thickness < 0.0
    elif isinstance(spec.network, RandomGraph):
        found |= {
            name: getattr(spec.network, attribute) for name, attribute in _NETWORK_VALUES.items()
        }
        if spec.network.field is not None:
            found["network_field"] = field_file(spec.network.field, "the points' density follows")
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
    what = " or ".join(say(other) for other in need.names)
    if need.absent:
        such = "such a " * bool(need.values)
        return f"{say(name)} has no effect with {such}{what}: leave one of them out."
    if need.values:
        words = [str(value) for value in need.values]
        what += " " + " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))
    return f"{say(name)} has no effect without {what}: add that or leave it."


def _drains(used: Mapping[str, Any]) -> DrainHoles | None:
    if not used["drain_diameter"]:
        return None
    places = [*(used["drain_points"] or ()), *(used["drain"] or ())]
    return DrainHoles(
        used["drain_diameter"],
        tuple(
            DrainPlace((x, y, z), (way[0], way[1], way[2]) if way else None)
            for x, y, z, *way in places
        ),
        used["drain_count"],
        used["build_direction"],
    )


def _profile(kind: str, start: float, end: float | None, formula: str | None) -> Profile:
    if kind == "formula":
        return Profile("expression", expression=formula or "")
    return Profile(kind, start, start if end is None else end)


def _word(profile: Profile) -> str:
    """A profile's kind as users call it."""
    return "formula" if profile.kind == "expression" else profile.kind


def _size_grading(used: Mapping[str, Any]) -> SizeGrading | None:
    kind = used["size_grading"]
    if kind == "none":
        return None
    profile = _profile(kind, used["lambda_start"], used["lambda_end"], used["lambda_formula"])
    return SizeGrading(profile, used["grading_direction"])


def _radius_grading(used: Mapping[str, Any], say: Naming) -> RadiusGrading | None:
    by = used["radius_grading"]
    if by == "none":
        return None
    # Both are read now, so that what is wrong with them is said before the work.
    curve = read_curve(used["radius_curve"]) if used["radius_curve"].strip() else ()
    field, column = used["radius_field"], used["radius_column"] or None
    if isinstance(field, str):
        field = read_point_field(field, column)
    profile, kind = Profile(), used["radius_profile"]  # a curve needs none
    if not curve:
        cell = used["cell"]
        of_walls = isinstance(cell, str) and surface_name(cell) is not None
        usual = used["wall_thickness" if of_walls else "strut_radius"]
        ends = (used["radius_start"], used["radius_end"])
        if kind in TWO_ENDED and ends == (0.0, 0.0):
            raise VolfrepError(
                f"A radius grading needs {say('radius_start')} or {say('radius_end')}: without "
                "both, every strut has the strut radius."
            )
        profile = _profile(kind, ends[0] or usual, ends[1] or usual, used["radius_formula"])
    return RadiusGrading(
        by, profile, used["radius_direction"], used["radius_reach"], field, column, curve
    )


def _radius_values(grading: RadiusGrading) -> dict[str, Any]:
    field = grading.field
    if isinstance(field, PointField):
        field = field_file(field, "the radius follows")
    curve = ", ".join(f"{value!r}:{radius!r}" for value, radius in grading.curve)
    return {
        "radius_grading": grading.by,
        "radius_field": field,
        "radius_column": grading.column or "",
        "radius_curve": curve,
        "radius_profile": _word(grading.profile),
        "radius_start": grading.profile.start,
        "radius_end": grading.profile.end,
        "radius_formula": grading.profile.expression,
        "radius_direction": grading.direction,
        "radius_reach": grading.reach,
    }


def _cell_map(used: Mapping[str, Any]) -> CellMap | None:
    if used["cell_map"] == "cartesian":
        return None
    return CellMap(
        used["cell_map"], used["map_centre"], used["map_axis"], used["map_around"] or None
    )


#: Parameters of random networks, and what `RandomGraph` calls them.
_NETWORK_VALUES = {
    "network": "kind",
    "network_points": "points",
    "network_seed": "seed",
    "network_relax": "relax",
    "network_density": "density",
    "network_shortest": "shortest",
    "network_angle": "least_angle",
    "network_on_wall": "on_wall",
}


def _network(used: Mapping[str, Any], say: Naming) -> GivenGraph | RandomGraph | None:
    if used["network"] == "cells":
        return None
    if used["network"] == "file":
        if not used["network_file"]:
            raise VolfrepError(f"{say('network')} file needs {say('network_file')}: give it.")
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
    field = used["network_field"] or None
    return RandomGraph(
        **{key: used[name] for name, key in _NETWORK_VALUES.items()},
        field=read_point_field(field) if isinstance(field, str) else field,
    )


def _orientation(used: Mapping[str, Any]) -> Orientation | None:
    if used["rotate"] is None:
        return None
    *axis, angle = used["rotate"]
    return Orientation((axis[0], axis[1], axis[2]), angle, used["rotate_origin"])


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
        "keep_solid": tuple(_kept(one) for one in spec.keep_solid),
    }


def _kept(one: KeptFace | KeptBody) -> str | tuple[float, ...]:
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
