# SPDX-License-Identifier: LGPL-2.1-or-later
"""A specification's digest: another one for every field of every part that it can hold."""

import dataclasses
import os
import subprocess
import sys
import types
import typing
from dataclasses import replace

import numpy as np
import pytest

from volfrep import LatticeSpec
from volfrep.design import cells, expression, grading, openings, scattered_field, spec, target
from volfrep.design.cells import UnitCell
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.graphs import GivenGraph, RandomGraph, StretchedCells, graph
from volfrep.design.openings import DrainHoles, DrainPlace, OpenPatch, OpenPlane, SmoothFace
from volfrep.design.profile import Profile
from volfrep.design.sampled_field import SampledField
from volfrep.design.scattered_field import PointField
from volfrep.design.skins import kept_bodies, own_faces
from volfrep.design.skins.kept_bodies import KeptBody
from volfrep.design.skins.own_faces import FaceSkin, KeptFace
from volfrep.design.spec_parts import FlatStruts
from volfrep.design.target import Target
from volfrep.design.tpms import PeriodicSurface, TpmsSheet, library
from volfrep.design.tpms import sheet as walls
from volfrep.util.content import digest_of

#: Where the classes are that a specification holds, for what their fields' types name.
MODULES = (
    cells, expression, grading, openings, scattered_field, spec, target, graph, kept_bodies,
    own_faces, library, walls,
)  # fmt: skip
#: What is no content: where something was read, and what is said about it.
TOLD_ONLY = {
    UnitCell: {"source", "use", "about", "also", "parameters", "values"},
    PeriodicSurface: {"about", "also"},
    GivenGraph: {"source", "thickness", "layers", "cell"},  # of which the nodes were made
    KeptBody: {"source", "name"},
    SampledField: {"source"},
}
POINTS, PATCH = np.eye(3), np.arange(9.0).reshape(1, 3, 3) ** 2
FIELD = PointField(POINTS, [1.0, 2.0, 3.0])
SAMPLED = SampledField(np.zeros(3), np.ones(3), np.arange(8.0).reshape(2, 2, 2))
OTHER_FIELD = PointField(POINTS, [1.0, 2.0, 3.5])
LINEAR, STEEPER = Profile("linear", 0.5, 1.0), Profile("linear", 0.5, 1.5)
PLANE, OTHER_PLANE = OpenPlane((0, 0, 0), (0, 0, 1)), OpenPlane((0, 0, 1), (0, 0, 1))
CORNERS = np.vstack([np.zeros(3), 3.0 * np.eye(3)])
FACETS = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
TENT = UnitCell("Tent", 0.9 * CORNERS / 3.0, np.array([(0, 1), (1, 2), (2, 3)]))
#: Corners beside those of the tetrahedron, which is cut in two there.
CUT = (
    np.vstack([CORNERS, (1.0, 1.0, 1.0)]),
    np.array([(0, 2, 1), (0, 1, 3), (1, 2, 4), (2, 3, 4), (3, 1, 4), (0, 3, 2)]),
)

#: Of every class a value, and for each of its fields another value.
OTHERS = {
    LatticeSpec: (
        LatticeSpec(drains=DrainHoles(3.0, count=1)),
        {
            "cell": "BCC", "cell_size": 9.0, "strut_radius": 0.9, "shell": 3.0, "resolution": 20,
            "deviation": 0.1, "activation": "inside", "boundary": "whole", "open_faces": (PLANE,),
            "face_skins": (FaceSkin(PLANE, 1.0),), "keep_solid": (KeptFace(PLANE, 1.0),),
            "skin_field": FIELD,
            "drains": None, "remove_dangling": True, "shortest_stub": 1.0, "remove_below": 0.4,
            "flat_struts": FlatStruts(45.0),
            "keep_pieces": True, "output": "domain", "fillet": 0.5, "origin": (0, 0, 0),
            "density": 2.0, "size_grading": SizeGrading(LINEAR),
            "radius_grading": RadiusGrading("skin", LINEAR), "cell_map": CellMap("cylindrical"),
            "orientation": Orientation(angle=30.0), "keep_radius": False,
            "target": Target("mass", 5.0), "network": RandomGraph(points=9), "wall": None,
        },
    ),
    UnitCell: (
        TENT,
        {
            "name": "mine", "nodes": TENT.nodes * 0.5, "struts": TENT.struts[:, ::-1],
            "edges": (1.0, 1.0, 2.0), "widths": np.full(3, 0.5),
        },
    ),
    PeriodicSurface: (PeriodicSurface("Formula", "cos(x)"), {"name": "A", "formula": "cos(y)"}),
    TpmsSheet: (TpmsSheet("skeleton"), {"kind": "complement", "offset": 0.2, "thickness": None}),
    SizeGrading: (SizeGrading(LINEAR), {"profile": STEEPER, "direction": (0, 1, 0)}),
    Profile: (
        LINEAR,
        {"kind": "quadratic", "start": 0.6, "end": 1.1, "expression": None, "values": None},
    ),
    RadiusGrading: (
        RadiusGrading("field", LINEAR, field=FIELD),
        {
            "by": "skin", "profile": STEEPER, "direction": (0, 1, 0), "reach": 4.0,
            "field": OTHER_FIELD, "column": "T", "curve": ((1.0, 0.5), (3.0, 1.0)),
        },
    ),
    SampledField: (
        SAMPLED,
        {"corner": np.ones(3), "spacing": np.full(3, 2.0), "values": np.ones((2, 2, 2))},
    ),
    PointField: (FIELD, {"points": 2 * POINTS, "values": [1.0, 2.0, 3.5], "source": "a.csv"}),
    CellMap: (
        CellMap("cylindrical"),
        {"kind": "spherical", "centre": (1, 2, 3), "axis": (1, 0, 0), "around": 12},
    ),
    Orientation: (Orientation(), {"axis": (1, 0, 0), "angle": 10.0, "origin": (1, 2, 3)}),
    Target: (
        Target("stiffness", 0.1, (1.0, 0.0, 0.0)),
        {"aim": None, "value": 0.2, "direction": (0.0, 1.0, 0.0), "young": 2.0},
    ),
    OpenPlane: (PLANE, {"point": (0, 0, 1), "normal": (0, 1, 0)}),
    OpenPatch: (OpenPatch(PATCH), {"corners": PATCH + 1e-5}),
    SmoothFace: (SmoothFace((0, 0, 0)), {"point": (0, 0, 1)}),
    FaceSkin: (FaceSkin(PLANE, 1.0), {"face": OTHER_PLANE, "thickness": 2.0}),
    KeptFace: (KeptFace(PLANE, 1.0), {"face": OTHER_PLANE, "distance": 2.0}),
    KeptBody: (KeptBody(CORNERS, FACETS), {"vertices": 2.0 * CORNERS, "triangles": None}),
    FlatStruts: (
        FlatStruts(45.0),
        {"inclination": 30.0, "build_direction": (1.0, 0.0, 0.0)},
    ),
    DrainHoles: (
        DrainHoles(3.0, count=1),
        {
            "diameter": 4.0, "places": (DrainPlace((0, 0, 0)),), "count": 2,
            "build_direction": (1, 0, 0),
        },
    ),
    DrainPlace: (DrainPlace((0, 0, 0)), {"point": (1, 0, 0), "direction": (0, 0, 1)}),
    GivenGraph: (
        GivenGraph(CORNERS, [(0, 1), (0, 2), (0, 3)], np.full((3, 2), 0.5), widths=np.ones(3)),
        {
            "nodes": 2.0 * CORNERS, "struts": [(0, 1), (1, 2), (1, 3)],
            "radii": np.full((3, 2), 0.6), "widths": np.full(3, 1.5),
        },
    ),
    RandomGraph: (
        RandomGraph(density="1 + s", field=FIELD),
        {
            "kind": "delaunay", "points": 9, "seed": 2, "relax": 1, "density": "2 + s",
            "shortest": 0.5, "least_angle": 20.0, "field": OTHER_FIELD, "on_wall": True,
        },
    ),
    StretchedCells: (StretchedCells(), {}),
}  # fmt: skip
#: Fields that cannot differ alone: a pair of values that do.
PAIRS = {
    (LatticeSpec, "wall"): (
        LatticeSpec(cell="Gyroid"), LatticeSpec(cell="Gyroid", wall=TpmsSheet("sheet", 2.0)),
    ),
    (TpmsSheet, "thickness"): (TpmsSheet("sheet", 1.0), TpmsSheet("sheet", 2.0)),
    (Profile, "values"): (
        Profile("sampled", values=(1.0, 2.0)), Profile("sampled", values=(1.0, 3.0)),
    ),
    (Profile, "expression"): (
        Profile("formula", expression="1 + s"), Profile("formula", expression="1 + s * s"),
    ),
    (Target, "aim"): (Target("mass", 0.5), Target("relative_density", 0.5)),
    (KeptBody, "triangles"): (KeptBody(CUT[0], CUT[1]), KeptBody(CUT[0], FACETS)),
}  # fmt: skip


def named():
    """All that the fields' types may name."""
    found = {"cKDTree": object}
    for module in MODULES:
        found.update(vars(module))
    return found


def classes_in(kind):
    """The dataclasses that a type names, such as one of a field."""
    if isinstance(kind, type) and dataclasses.is_dataclass(kind):
        yield kind
    elif typing.get_origin(kind) in (typing.Union, types.UnionType, tuple):
        for part in typing.get_args(kind):
            yield from classes_in(part)


def reachable():
    """The dataclasses that a specification may hold, itself included."""
    found, new = set(), [LatticeSpec]
    while new:
        one = new.pop()
        if one in found:
            continue
        found.add(one)
        hints = typing.get_type_hints(one, localns=named())
        for item in content_of_class(one):
            new += classes_in(hints[item])
    return found


def content_of_class(one):
    apart = TOLD_ONLY.get(one, set())
    return {item.name for item in dataclasses.fields(one) if item.init} - apart


def test_every_part_that_a_specification_can_hold_is_looked_at():
    assert reachable() == OTHERS.keys()
    for one, (_, others) in OTHERS.items():
        assert others.keys() == content_of_class(one), one


@pytest.mark.parametrize("kind", OTHERS, ids=lambda kind: kind.__name__)
def test_every_field_of_every_part_changes_the_digest(kind):
    part, others = OTHERS[kind]
    for name, value in others.items():
        one, other = PAIRS.get((kind, name)) or (part, replace(part, **{name: value}))
        assert digest_of(one) != digest_of(other), name
        assert digest_of(other) == digest_of(replace(other)), name
    for name in TOLD_ONLY.get(kind, ()):
        told = replace(part, **{name: 3 if name in ("thickness", "layers") else "other"})
        assert digest_of(told) == digest_of(part), name


def specs():
    """Specifications that hold each of the parts."""
    given, random = OTHERS[GivenGraph][0], OTHERS[RandomGraph][0]
    patch, body = OpenPatch(PATCH), KeptBody(CORNERS, FACETS)
    return {
        "plain": LatticeSpec(),
        "edges": LatticeSpec(cell=replace(TENT, edges=(1.0, 1.0, 2.0))),
        "other edges": LatticeSpec(cell=replace(TENT, edges=(1.0, 1.0, 1.5))),
        "widths": LatticeSpec(cell=replace(TENT, widths=np.full(3, 0.5))),
        "other widths": LatticeSpec(cell=replace(TENT, widths=np.full(3, 0.6))),
        "network": LatticeSpec(network=given),
        "its widths": LatticeSpec(network=replace(given, widths=np.full(3, 1.5))),
        "points": LatticeSpec(network=random),
        "their field": LatticeSpec(network=replace(random, field=OTHER_FIELD)),
        "field": LatticeSpec(radius_grading=RadiusGrading("field", LINEAR, field=FIELD)),
        "walls": LatticeSpec(cell="Gyroid", wall=TpmsSheet("skeleton", offset=0.1)),
        "faces": LatticeSpec(open_faces=(patch,), keep_solid=(body, KeptFace(PLANE, 1.0))),
        "target": LatticeSpec(target=Target("mass", 5.0)),
    }


def test_the_digest_of_a_specification_is_by_what_its_parts_hold():
    shapes = {name: one.shape_digest() for name, one in specs().items()}
    assert len(set(shapes.values())) == len(shapes)
    assert LatticeSpec(cell="octet", cell_size=8).digest() == LatticeSpec("Octet", 8.0).digest()


def test_the_shape_does_not_depend_on_the_density_but_where_a_mass_is_aimed_at():
    for one in (LatticeSpec(), LatticeSpec(target=Target("relative_density", 0.2))):
        heavier = replace(one, density=2.0)
        assert one.shape_digest() == heavier.shape_digest()
        assert one.digest() != heavier.digest()
    by_mass = LatticeSpec(target=Target("mass", 5.0))
    assert by_mass.shape_digest() != replace(by_mass, density=2.0).shape_digest()


def test_what_has_no_effect_does_not_count():
    assert LatticeSpec(wall=TpmsSheet("sheet", 2.0)).digest() == LatticeSpec().digest()
    sheets = [
        LatticeSpec(cell="Gyroid", wall=TpmsSheet("sheet", 1.0, offset)) for offset in (0.0, 0.3)
    ]
    assert sheets[0].digest() == sheets[1].digest()


def test_a_face_is_the_same_whatever_diagonals_are_drawn_in_it():
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
    one, other = (
        OpenPatch(square[list(facets)] + shift)
        for facets, shift in (([(0, 1, 2), (0, 2, 3)], 0.0), ([(1, 2, 3), (0, 1, 3)], 1e-9))
    )
    assert digest_of(one) == digest_of(other)


#: Of `specs`: digests that documents and studies keep. They may change only together with what a
#: lattice is.
KEPT = {
    "plain": "b2b263dbad088618466e3720abba8590",
    "edges": "ef90d4b5f7b16eaa20d233bcbc42c41b",
    "other edges": "6dd4f6c864a4027514b452dad4170e79",
    "widths": "449d5cd77012ba7c3ff289651ab47151",
    "other widths": "832c545039518b25c3a7ba47eab2f3e4",
    "network": "c6bb53a33657ea56ac5a494fa8885f6d",
    "its widths": "5eb61f92f4b0380d2aa4effaaee7d6a7",
    "points": "df2a1acc796be10c8db26d7676b5b028",
    "their field": "931831b1c9541694736d333376e69bd5",
    "field": "3d03dd89074f5cd2c695942d8b797be8",
    "walls": "5ac6031afb4800c79b2eb7a1e0d7787f",
    "faces": "0e75b779ec7d49deb258238c5a019d31",
    "target": "932486e0c40142f4c7e3eb2a2acb15fe",
}


def test_digests_are_those_that_documents_and_studies_have_kept():
    assert {name: one.shape_digest() for name, one in specs().items()} == KEPT


def test_digests_are_the_same_in_another_process():
    code = (
        "from volfrep.design.spec import LatticeSpec; from volfrep.design.target import Target;"
        "print(LatticeSpec('Gyroid', 8, target=Target('mass', 5.0)).digest())"
    )
    # Which hashes its texts with another seed.
    seed = "1" if os.environ.get("PYTHONHASHSEED") != "1" else "2"
    told = subprocess.run(
        [sys.executable, "-c", code], env={**os.environ, "PYTHONHASHSEED": seed},
        capture_output=True, text=True, check=True,
    ).stdout.strip()  # fmt: skip
    assert told == LatticeSpec("Gyroid", 8, target=Target("mass", 5.0)).digest()


def test_values_of_which_nobody_knows_what_they_hold_have_no_digest():
    with pytest.raises(TypeError, match="object has no digest"):
        digest_of(object())
