# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every value that makes no sense is refused at once, in a sentence that says why."""

import json
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from volfrep.design.cells import LIBRARY
from volfrep.design.spec import MAX_RESOLUTION, MIN_RESOLUTION, LatticeSpec
from volfrep.util.errors import VolfrepError


def test_the_defaults_are_valid() -> None:
    spec = LatticeSpec()
    assert spec.unit_cell() is LIBRARY["CVC"]
    assert spec.joint_radius == pytest.approx(1.1)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"cell": "Gyrate"}, "There is no unit cell named 'Gyrate'"),
        ({"cell_size": 0}, "cell size must be above 0 mm, not 0"),
        ({"cell_size": -3}, "cell size must be above 0 mm, not -3"),
        ({"cell_size": math.nan}, "cell size must be a finite number in mm, not nan"),
        ({"cell_size": "wide"}, "cell size must be a number in mm, not 'wide'"),
        ({"cell_size": None}, "cell size must be a number in mm, not None"),
        ({"strut_radius": 0}, "strut radius must be above 0 mm"),
        ({"strut_radius": math.inf}, "strut radius must be a finite number"),
        ({"strut_radius": 4.9}, "Struts of radius 4.9 mm are too thick for a cell of 10 mm: keep"),
        ({"strut_radius": 2.9, "fillet": 2}, "too thick for a cell of 10 mm with this fillet"),
        ({"fillet": 5}, "joint fillet of 5 mm is too large"),
        ({"fillet": -1}, "joint fillet must not be negative"),
        ({"shell": -0.1}, "skin thickness must not be negative"),
        ({"shell": math.nan}, "skin thickness must be a finite number"),
        ({"density": 0}, "density must be above 0 g/cm3"),
        ({"resolution": 20, "deviation": 0.1}, "either a resolution or a deviation"),
        ({"resolution": 12.5}, "resolution must be a whole number from 4 to 400, not 12.5"),
        ({"resolution": 3}, "resolution must be a whole number"),
        ({"resolution": 401}, "resolution must be a whole number"),
        ({"resolution": 0}, "resolution must be a whole number"),
        ({"deviation": 0}, "deviation must be above 0 mm"),
        ({"deviation": 1e-9}, "needs .* facets along a cell: the limit is 400"),
        (
            {"activation": "nearby"},
            "There is no activation 'nearby': choose one of touching, centre, inside",
        ),
        ({"boundary": "cut"}, "There is no boundary 'cut': choose trim or whole"),
        ({"shortest_stub": -1}, "shortest stub must not be negative"),
        ({"output": "mesh"}, "There is no output 'mesh': choose one of part, lattice, domain"),
        ({"origin": (0, 0)}, "origin must be three coordinates"),
        ({"origin": (0, 0, math.nan)}, "origin must be a finite number"),
    ],
)
def test_what_makes_no_sense(values: dict[str, Any], message: str) -> None:
    with pytest.raises(VolfrepError, match=message) as caught:
        LatticeSpec(**values)
    text = str(caught.value)
    assert text.endswith(".")
    assert "\n" not in text


def test_the_limit_that_the_message_names_is_the_limit() -> None:
    with pytest.raises(VolfrepError) as caught:
        LatticeSpec(cell_size=10, strut_radius=4.9)
    limit = float(str(caught.value).split("below ")[1].split(" mm")[0])
    LatticeSpec(cell_size=10, strut_radius=limit * 0.999)
    with pytest.raises(VolfrepError):
        LatticeSpec(cell_size=10, strut_radius=limit * 1.001)


def test_resolution_and_deviation() -> None:
    assert LatticeSpec(resolution=30).facets_along_cell == 30
    # Facets of edge e stray by e2 / (16 r): e = 10 / 20 gives 1 / 64.
    assert LatticeSpec(deviation=1 / 64).facets_along_cell == 20
    assert (
        LatticeSpec(deviation=100).facets_along_cell == LatticeSpec().kind.coarsest_resolution == 10
    )
    assert LatticeSpec().facets_along_cell < LatticeSpec(deviation=0.005).facets_along_cell


@given(
    size=st.floats(0.01, 1e4),
    slenderness=st.floats(0.005, 0.35),
    accuracy=st.floats(0.001, 0.2),
)
def test_the_deviation_is_kept(size: float, slenderness: float, accuracy: float) -> None:
    radius = size * slenderness
    deviation = accuracy * radius
    try:
        spec = LatticeSpec(cell_size=size, strut_radius=radius, deviation=deviation)
    except VolfrepError as error:
        assert "facets along a cell" in str(error)  # noqa: PT017
        return
    facets = spec.facets_along_cell
    assert MIN_RESOLUTION <= facets <= MAX_RESOLUTION
    assert (size / facets) ** 2 / (16 * radius) <= deviation * (1 + 1e-9)


def test_as_plain_values() -> None:
    spec = LatticeSpec(cell="octet", origin=(1, 2, 3))
    values = json.loads(json.dumps(spec.as_dict()))
    assert values["cell"] == "Octet"
    assert values["origin"] == [1.0, 2.0, 3.0]
    assert values["strut_radius"] == 1.0
    assert json.loads(json.dumps(LatticeSpec(cell=LIBRARY["Box"]).as_dict()))["cell"] == "Box"


def test_a_spec_cannot_be_changed() -> None:
    with pytest.raises(AttributeError):
        LatticeSpec().shell = 3.0  # type: ignore[misc]
