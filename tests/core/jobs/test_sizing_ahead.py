# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a sizing needs and no load changes, made before the loads are known."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from volfrep.design.spec import LatticeSpec
from volfrep.design.target import Target
from volfrep.jobs import infill, part_domain
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, part_model, prepare
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing.analysis import Limits
from volfrep.util.cache import StageCache
from volfrep.util.content import content_of

SPEC = LatticeSpec("BCC", cell_size=10, strut_radius=0.8, shell=1)
GOAL = Goal(limits=Limits(displacement=0.05), thinnest=0.3, thickest=1.6)
#: What takes long, by the module that asks for it.
COSTLY = (
    (part_domain, "find_domain"), (infill, "find_kept_struts"),
    (part_model, "begun_surface"), (part_model, "even_surface"),
)  # fmt: skip


def beam():
    box = trimesh.creation.box((20, 10, 10))
    return TriangleMesh(np.array(box.vertices), np.array(box.faces, np.int32))


def bent():
    left, right = (InPlane((x, 0, 0), (1, 0, 0)) for x in (-10.0, 10.0))
    case = LoadCase("bend", (Support(left),), (Force(right, (0, 0, -200.0)),))
    return LoadCases(find_material("Ti-6Al-4V"), (case,))


def modelled(cache):
    """What is solved, as its content."""
    part = Infill(beam(), part_model.all_struts(SPEC), cache=cache)
    model = part_model.part_model(part, bent(), GOAL, cache)
    problem = model.problem
    return content_of(
        model.skin.outside.vertices, model.skin.outside.triangles, model.skin.blocks.stiffness,
        problem.structure.nodes, problem.structure.beams.struts, problem.cases[0].loads,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("spec", "is_used"),
    [(SPEC, True), pytest.param(replace(SPEC, shell=0.8), False, marks=pytest.mark.costly)],
)
def test_what_is_solved_is_the_same_whatever_was_made_ahead(monkeypatch, spec, is_used):
    alone, cache, asked = modelled(StageCache()), StageCache(), []
    assert prepare(beam(), spec, Goal(thinnest=0.3, thickest=1.6), cache=cache)
    for module, name in COSTLY:
        function = getattr(module, name)
        monkeypatch.setattr(
            module, name,
            lambda *a, _f=function, _n=name, **k: (asked.append(_n), _f(*a, **k))[1],
        )  # fmt: skip
    assert modelled(cache) == alone
    assert (asked == []) == is_used


def test_what_is_huge_or_has_its_radius_by_a_target_is_not_made_ahead():
    cache = StageCache()
    assert not prepare(beam(), replace(SPEC, cell_size=0.1, strut_radius=0.01), Goal(), cache=cache)
    aim = replace(SPEC, target=Target("relative_density", 0.2))
    assert not prepare(beam(), aim, Goal(), cache=cache)
    assert cache == StageCache()  # nothing was begun
