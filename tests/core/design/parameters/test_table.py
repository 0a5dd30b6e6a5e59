# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of parameters: complete, in order, the same as the engine's own words."""

import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from volfrep.design import grading, profile, spec
from volfrep.design.parameters import BY_NAME, GROUPS, PARAMETERS
from volfrep.design.parameters.parameter import SHAPES, effective
from volfrep.design.parameters.specification import specification, values_of
from volfrep.design.spec import LatticeSpec


def test_every_row_has_its_own_name_and_property() -> None:
    assert len(BY_NAME) == len(PARAMETERS)
    assert len({p.property_name for p in PARAMETERS}) == len(PARAMETERS)


@pytest.mark.parametrize("parameter", PARAMETERS, ids=lambda p: p.name)
def test_a_row_makes_sense(parameter) -> None:
    assert parameter.group in GROUPS
    documents = {"link", "faces", "lengths", "points", "stress", "material", "process"}
    assert parameter.kind in {*SHAPES, "flag", "choice"} | documents
    assert parameter.kind not in documents or not parameter.in_command
    assert bool(parameter.choices) == (parameter.kind == "choice")
    assert not parameter.choices or parameter.default in parameter.choices
    assert parameter.in_command or parameter.in_freecad
    before = [p.name for p in PARAMETERS[: PARAMETERS.index(parameter)]]
    for need in parameter.needs:
        assert set(need.names) <= set(before), "what it needs comes before it"
        for name in need.names:
            assert not BY_NAME[name].choices or set(need.values) <= set(BY_NAME[name].choices)
    assert set(parameter.instead_of) <= BY_NAME.keys()
    assert not parameter.help.endswith(".")


def test_the_choices_are_those_of_the_engine() -> None:
    words = [profile.ALIASES.get(kind, kind) for kind in BY_NAME["size_grading"].choices[1:]]
    assert tuple(words) == profile.KINDS
    assert BY_NAME["radius_grading"].choices[1:] == grading.RADIUS_BY
    assert BY_NAME["cell_map"].choices == grading.MAPS
    assert BY_NAME["activation"].choices == spec.ACTIVATIONS
    assert BY_NAME["boundary"].choices == spec.BOUNDARIES
    assert BY_NAME["make"].choices == spec.OUTPUTS


def test_the_defaults_are_those_of_the_specification() -> None:
    assert specification({}) == LatticeSpec()
    assert specification({}).as_dict() == LatticeSpec().as_dict()


def test_every_field_of_the_specification_can_be_asked_for(tmp_path: Path) -> None:
    """With every parameter that a file may hold, no field keeps its default."""
    thickness = tmp_path / "skin.csv"
    thickness.write_text("x,y,z,t\n0,0,0,1\n9,0,0,2\n")
    values = {
        "cell": "BCC", "cell_size": 8.0, "strut_radius": 0.5, "shell": 1.0, "fillet": 0.1,
        "origin": (1.0, 2.0, 3.0), "activation": "centre", "boundary": "whole",
        "remove_dangling": True, "shortest_stub": 0.5, "keep_pieces": True,
        "remove_below": 0.6, "remove_flatter": 45.0, "build_direction": (1.0, 0.0, 0.0),
        "open_plane": ((0, 0, 1, 0, 0, 1),), "skin_face": ((0, 0, 2, 3),),
        "keep_solid": ((0, 0, 2, 0, 0, 1, 4),), "skin_field": str(thickness),
        "drain_diameter": 2.0, "drain_count": 1, "deviation": 0.1, "density": 2.0,
        "size_grading": "linear", "lambda_end": 1.5, "keep_radius": False,
        "radius_grading": "skin", "radius_end": 0.7, "cell_map": "spherical",
        "rotate": (0.0, 0.0, 1.0, 30.0),
    }  # fmt: skip
    made, plain = specification(values), LatticeSpec()
    same = {f.name for f in fields(plain) if getattr(made, f.name) == getattr(plain, f.name)}
    assert same == {"resolution", "output", "target", "network", "wall"}, (
        "resolution excludes deviation, drains need a part, a target a radius grading, a network "
        "stands in place of cells, and walls of struts"
    )
    assert specification(values_of(made)).as_dict() == made.as_dict()


def test_what_has_no_effect_counts_with_its_default_for_others_too() -> None:
    left_over = {"radius_grading": "field", "radius_profile": "formula", "radius_end": 2.0}
    used, idle = effective(PARAMETERS, left_over)
    assert used["radius_profile"] == "linear"
    assert used["radius_end"] == 2.0
    assert "radius_profile" in idle
    assert "radius_end" not in idle


def test_reading_the_table_does_not_import_numpy() -> None:
    code = "import sys, volfrep.design.parameters; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
