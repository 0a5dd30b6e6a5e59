# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a lattice is to come to, read of values by name; and the skin that counts in its mass."""

from __future__ import annotations

import pytest

import samples
import volfrep
from volfrep import VolfrepError
from volfrep.design.spec import LatticeSpec
from volfrep.design.target import Target, read_target
from volfrep.jobs.preview import PartDepth


@pytest.mark.parametrize(
    ("values", "wanted"),
    [
        ({}, None),
        ({"strut_radius": 1.0, "mass": None}, None),
        ({"wall_thickness": 1.0, "strut_radius": 1.0}, None),
        ({"relative_density": 0.2}, Target("relative_density", 0.2)),
        ({"mass": 20}, Target("mass", 20.0)),
        ({"stiffness": "500:110"}, Target("stiffness", 500.0, (1.0, 1.0, 0.0), 3.0)),
        (
            {"stiffness": (500.0, (0.0, 0.0, 1.0))},
            Target("stiffness", 500.0, (0.0, 0.0, 1.0), 3.0),
        ),
        ({"target": Target("mass", 4.0)}, Target("mass", 4.0)),
    ],
)
def test_one_value_says_what_the_thickness_is_chosen_for(values, wanted) -> None:
    assert read_target(values, 3.0) == wanted


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"mass": 4.0, "strut_radius": 1.0}, "STRUT_RADIUS and MASS each say how thick the struts"),
        ({"mass": 4.0, "wall_offset": 0.0}, "WALL_OFFSET and MASS each say how thick the walls"),
        (
            {"mass": 4.0, "relative_density": 0.2, "stiffness": "1:100"},
            "RELATIVE_DENSITY, MASS and STIFFNESS each",
        ),
        ({"target": Target("mass", 4.0), "mass": 4.0}, "MASS and TARGET each"),
    ],
)
def test_only_one_value_can_say_it(values, text) -> None:
    with pytest.raises(VolfrepError, match=text):
        read_target(values, say=str.upper)


def test_a_script_names_the_thickness_of_walls_or_their_target() -> None:
    with pytest.raises(VolfrepError, match="each say how thick the walls are"):
        volfrep.block((1, 1, 1), cell="Gyroid", wall_thickness=1.0, relative_density=0.3)
    spec = LatticeSpec("Gyroid", target=Target("relative_density", 0.3))
    assert volfrep.block((1, 1, 1), spec, wall_thickness=2.0, resolution=12).spec.target is None


@pytest.mark.parametrize("output", ["part", "lattice"])
@pytest.mark.parametrize("shell", [0.0, 1.0])
def test_a_mass_counts_the_skin_of_a_part(output, shell) -> None:
    solid = samples.box()
    spec = LatticeSpec(cell_size=8.0, strut_radius=0.5, shell=shell, output=output)
    inside = PartDepth(solid).volume_below(shell)
    skin = spec.skin_volume(solid.volume, inside)
    assert (skin > 0.0) == (output == "part" and shell > 0.0)
    assert skin in (0.0, solid.volume - inside)
