# SPDX-License-Identifier: LGPL-2.1-or-later
"""From the constraints of FreeCAD's FEM workbench to load cases: an analysis is one of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import FreeCAD as App

from freecad_volfrep.compat import (
    celsius,
    gravity_of,
    in_unit,
    prescribed,
    prescribed_turn,
    watts,
)
from volfrep.loads.load_cases import (
    Force,
    Heat,
    Load,
    LoadCase,
    LoadCases,
    Moment,
    Pressure,
    Support,
)
from volfrep.loads.regions import AnyOf, NearPoint, OnFacets, OnLine, Region, Vector
from volfrep.mechanics.materials import SolidMaterial
from volfrep.util.errors import VolfrepError

from .solids import edge_points, face_facets, vertex_point

READ = "fixed, displacement, force, pressure, self-weight and rigid body"
#: Kinds that say what is warm and what flows in.
TEMPERATURE, HEAT_FLUX = "Fem::ConstraintTemperature", "Fem::ConstraintHeatflux"
HEAT_KINDS = TEMPERATURE, HEAT_FLUX
#: What a constraint may be: an acceleration is a vector.
Read = Support | Load | App.Vector


def is_analysis(obj: App.DocumentObject) -> bool:
    """Whether an object is an analysis of the FEM workbench."""
    return bool(obj.isDerivedFrom("Fem::FemAnalysis"))


def has_loads(analysis: App.DocumentObject) -> bool:
    """Whether an analysis has a constraint of a kind that is read, so that it may be a case."""
    return any(kind_of(member) in (*_READERS, *HEAT_KINDS) for member in constraints_of(analysis))


def has_heat(analysis: App.DocumentObject) -> bool:
    """Whether an analysis says what is warm."""
    return any(kind_of(member) in HEAT_KINDS for member in constraints_of(analysis))


def has_heat_alone(analysis: App.DocumentObject) -> bool:
    """Whether an analysis says nothing but what is warm."""
    kinds = {kind_of(member) for member in constraints_of(analysis)}
    return bool(kinds) and kinds <= set(HEAT_KINDS)


def load_cases_of(
    analyses: Sequence[App.DocumentObject],
    frame: App.Placement,
    material: SolidMaterial | None = None,
) -> LoadCases:
    """The load cases that some analyses are, in the coordinates of `frame`.

    All constraints of an analysis act together, as they do when FreeCAD solves it; its label is the
    name of the case. What is suppressed is left out, and so is heat, which strains nothing here.

    Args:
        analyses: of the FEM workbench.
        frame: the coordinate system of the part.
        material: in place of the analyses' own.

    Raises:
        VolfrepError: an analysis has a constraint of another kind, no support or no load, or there
            is no one material.
    """
    loaded = [analysis for analysis in analyses if not has_heat_alone(analysis)]
    if analyses and not loaded:
        raise VolfrepError("The load cases have heat alone: hold faces and load some, too.")
    cases = tuple(_case(analysis, frame) for analysis in loaded)
    return LoadCases(material or _one_material(loaded), cases)


def heat_of(
    analyses: Sequence[App.DocumentObject],
    frame: App.Placement,
    conductivity: float,
    material: SolidMaterial | None = None,
) -> LoadCases:
    """The heat of the one analysis that has some, in degrees C, without load cases.

    Args:
        analyses: of the FEM workbench.
        frame: the coordinate system of the part.
        conductivity: of the solid, W/(m K).
        material: in place of the analyses' own.

    Raises:
        VolfrepError: none or several have heat, a constraint of it is not read, none has a
            temperature, or there is no one material.
    """
    warm = [analysis for analysis in analyses if has_heat(analysis)]
    if not warm:
        raise VolfrepError("No load case has heat: give faces a temperature or a heat flow.")
    if len(warm) > 1:
        raise VolfrepError(
            f"Two load cases have heat, '{warm[0].Label}' and '{warm[1].Label}': choose one, or "
            "suppress the heat of the other."
        )
    heat = tuple(
        _heat(constraint, frame)
        for constraint in constraints_of(warm[0])
        if kind_of(constraint) in HEAT_KINDS
    )
    return LoadCases(material or _one_material(warm), (), (), heat, conductivity)


def _heat(constraint: App.DocumentObject, frame: App.Placement) -> Heat:
    """A temperature, a heat flow, or a fluid beside faces.

    Raises:
        VolfrepError: it is of another type.
    """
    kind, region, name = constraint.ConstraintType, _region(constraint, frame), constraint.Label
    if kind == "Temperature":
        return Heat(region, temperature=celsius(constraint.Temperature), name=name)
    if kind == "CFlux":
        return Heat(region, power=watts(constraint.CFlux), name=name)
    if kind == "Convection":
        film = in_unit(constraint.FilmCoef, "W/m^2/K")
        return Heat(region, temperature=celsius(constraint.AmbientTemp), name=name, film=film)
    raise VolfrepError(
        f"'{name}' is of the type {kind}, which is not read: of heat these are a temperature, a "
        "concentrated heat flux and convection."
    )


def _case(analysis: App.DocumentObject, frame: App.Placement) -> LoadCase:
    supports: list[Support] = []
    loads: list[Load] = []
    acceleration = App.Vector()
    for constraint in constraints_of(analysis):
        if kind_of(constraint) in HEAT_KINDS:
            continue
        read = _READERS.get(kind_of(constraint))
        if read is None:
            raise VolfrepError(
                f"'{constraint.Label}' of '{analysis.Label}' is a constraint that is not read for "
                f"load cases: these are {READ}. Suppress it or take it out of the analysis."
            )
        if getattr(constraint, "EnableAmplitude", False) or any(
            getattr(constraint, f"has{axis}Formula", False) for axis in "XYZ"
        ):
            raise VolfrepError(
                f"'{constraint.Label}' changes in time or by a formula: give it a plain value."
            )
        for made in read(constraint, frame):
            if isinstance(made, Support):
                supports.append(made)
            elif isinstance(made, App.Vector):
                acceleration += made
            else:
                loads.append(made)
    return LoadCase(analysis.Label, tuple(supports), tuple(loads), _tuple(acceleration))


def constraints_of(analysis: App.DocumentObject) -> list[App.DocumentObject]:
    """The constraints of an analysis that are not suppressed."""
    return [
        member
        for member in analysis.Group
        if member.isDerivedFrom("Fem::Constraint") and not getattr(member, "Suppressed", False)
    ]


def kind_of(constraint: App.DocumentObject) -> str:
    """The kind of a constraint; those made in Python have one type and say it by their proxy."""
    if constraint.TypeId != "Fem::ConstraintPython":
        return str(constraint.TypeId)
    return str(getattr(constraint.Proxy, "Type", ""))


def _fixed(constraint: App.DocumentObject, frame: App.Placement) -> list[Read]:
    return [Support(_region(constraint, frame), name=constraint.Label)]


def _displacement(constraint: App.DocumentObject, frame: App.Placement) -> list[Read]:
    """A constraint of displacement, whose axes are the document's.

    Raises:
        VolfrepError: it turns the part, or its axes are not the part's.
    """
    moved = [prescribed(constraint, axis) for axis in "xyz"]
    turned = [prescribed_turn(constraint, axis) for axis in "xyz"]
    if any(turned):
        raise VolfrepError(
            f"'{constraint.Label}' turns its nodes by an angle, which is not read: hold the turn "
            "at 0 or leave it free."
        )
    if not frame.Rotation.isIdentity():
        moved = _moved_in(constraint, moved, frame)
    support = Support(
        _region(constraint, frame),
        (moved[0], moved[1], moved[2]),
        (turned[0] is None, turned[1] is None, turned[2] is None),
        constraint.Label,
    )
    return [support]


def _moved_in(
    constraint: App.DocumentObject, moved: list[float | None], frame: App.Placement
) -> list[float | None]:
    if all(value is None for value in moved):
        return moved
    if any(value is None for value in moved):
        raise VolfrepError(
            f"'{constraint.Label}' holds axes of the document, and the part lies in an App::Part "
            "that is turned: hold all three, or turn the App::Part back."
        )
    return list(_tuple(frame.Rotation.inverted().multVec(App.Vector(*moved))))


def _force(constraint: App.DocumentObject, frame: App.Placement) -> list[Read]:
    size = in_unit(constraint.Force, "N")
    along = frame.Rotation.inverted().multVec(constraint.DirectionVector)
    region = _region(constraint, frame, alike=True)
    return [Force(region, _tuple(along * size), name=constraint.Label)]


def _pressure(constraint: App.DocumentObject, frame: App.Placement) -> list[Read]:
    size = in_unit(constraint.Pressure, "MPa") * (-1.0 if constraint.Reversed else 1.0)
    return [Pressure(_region(constraint, frame), size, constraint.Label)]


def _self_weight(constraint: App.DocumentObject, frame: App.Placement) -> list[Read]:
    return [frame.Rotation.inverted().multVec(gravity_of(constraint))]


def _rigid_body(constraint: App.DocumentObject, frame: App.Placement) -> list[Read]:
    """The force through its reference node and the moment; or a support, where it holds all.

    Raises:
        VolfrepError: it holds some of its six freedoms, moves, or neither holds nor loads.
    """
    shifts, turns = (
        [getattr(constraint, f"{kind}Mode{axis}") for axis in "XYZ"]
        for kind in ("Translational", "Rotational")
    )
    if "Constraint" in shifts + turns:
        moves = constraint.Displacement.Length > 0.0 or constraint.Rotation.Angle != 0.0
        if moves or {*shifts, *turns} != {"Constraint"}:
            raise VolfrepError(
                f"'{constraint.Label}' holds a part of its freedoms or moves, which is not read of "
                "a rigid body: hold all six at 0, or give it forces and moments only."
            )
        return [Support(_region(constraint, frame), name=constraint.Label)]
    force, moment = (
        App.Vector(*(
            in_unit(getattr(constraint, f"{name}{axis}"), unit) if mode == "Load" else 0.0
            for axis, mode in zip("XYZ", modes, strict=True)
        ))
        for name, unit, modes in (("Force", "N", shifts), ("Moment", "N*mm", turns))
    )  # fmt: skip
    region, turned = _region(constraint, frame, alike=True), frame.Rotation.inverted()
    through = _tuple(frame.inverse().multVec(constraint.ReferenceNode))
    result: list[Read] = []
    if force.Length > 0.0:
        result.append(Force(region, _tuple(turned.multVec(force)), through, constraint.Label))
    if moment.Length > 0.0:
        result.append(Moment(region, _tuple(turned.multVec(moment)), constraint.Label))
    if not result:
        raise VolfrepError(
            f"'{constraint.Label}' neither holds nor loads anything: set its modes to Load and "
            "give a force or a moment, or to Constraint."
        )
    return result


_READERS: dict[str, Callable[[App.DocumentObject, App.Placement], list[Read]]] = {
    "Fem::ConstraintFixed": _fixed,
    "Fem::ConstraintDisplacement": _displacement,
    "Fem::ConstraintForce": _force,
    "Fem::ConstraintPressure": _pressure,
    "Fem::ConstraintSelfWeight": _self_weight,
    "Fem::ConstraintRigidBody": _rigid_body,
}


def _region(constraint: App.DocumentObject, frame: App.Placement, alike: bool = False) -> Region:
    """The faces, edges and vertices that a constraint refers to.

    Raises:
        VolfrepError: it refers to nothing, or to what is not there any more; or, where they have to
            be alike, to elements of different kinds.
    """
    pairs = [(owner, name) for owner, names in constraint.References for name in names]
    if not pairs or not all(name for _, name in pairs):
        raise VolfrepError(
            f"'{constraint.Label}' refers to no face, edge or vertex: choose some of the part's."
        )
    if alike and len({name.rstrip("0123456789") for _, name in pairs}) > 1:
        raise VolfrepError(
            f"'{constraint.Label}' refers to faces, edges and vertices together: make a force of "
            "each kind."
        )
    regions = tuple(_element(owner, name, frame) for owner, name in pairs)
    return regions[0] if len(regions) == 1 else AnyOf(regions)


def _element(owner: App.DocumentObject, name: str, frame: App.Placement) -> Region:
    said = f"{name} of {owner.Label}"
    if name.startswith("Face"):
        return OnFacets(face_facets(owner, name, frame), said)
    if name.startswith("Edge"):
        return OnLine(edge_points(owner, name, frame), said)
    return NearPoint(vertex_point(owner, name, frame))


def _one_material(analyses: Sequence[App.DocumentObject]) -> SolidMaterial:
    found = [
        _material(member)
        for analysis in analyses
        for member in analysis.Group
        if member.isDerivedFrom("App::MaterialObject")
        and getattr(member, "Category", "Solid") == "Solid"
        and not getattr(member, "Suppressed", False)
    ]
    if not found:
        raise VolfrepError(
            "Neither the infill nor its load cases have a material: choose one for the infill."
        )
    other = [m for m in found if replace(m, name=found[0].name, source=found[0].source) != found[0]]
    if other:
        raise VolfrepError(
            f"The analyses have different materials, '{found[0].name}' and '{other[0].name}': a "
            "part is printed of one."
        )
    return found[0]


def _material(obj: App.DocumentObject) -> SolidMaterial:
    """A material of the FEM workbench.

    Raises:
        VolfrepError: a figure is missing or makes no sense.
    """
    values: dict[str, str] = obj.Material

    def figure(key: str, unit: str) -> float:
        try:
            quantity = App.Units.Quantity(values[key])
            # Of a plain number FreeCAD 0.20 makes nonsense when asked for it in no unit.
            return float(quantity.getValueAs(unit).Value if unit else quantity.Value)
        except (KeyError, ValueError, ArithmeticError) as error:
            wanted = f"a number in {unit}" if unit else "a number"
            raise VolfrepError(
                f"The material '{obj.Label}' has no {key} that is {wanted}: edit it."
            ) from error

    limit = figure("YieldStrength", "MPa") if values.get("YieldStrength") else None
    name = re.sub(r"[^-\w]", "_", values.get("Name", "") or obj.Name, flags=re.ASCII)
    return SolidMaterial(
        name.lstrip("_-") or "material",
        figure("Density", "g/cm^3"),
        figure("YoungsModulus", "MPa"),
        figure("PoissonRatio", ""),
        limit or None,
        source=f"'{obj.Label}' of the document",
    )


def _tuple(vector: Any) -> Vector:
    return float(vector.x), float(vector.y), float(vector.z)
