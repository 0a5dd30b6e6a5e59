# SPDX-License-Identifier: LGPL-2.1-or-later
"""Absurd numbers: every parameter says in one short sentence what it may be."""

import numpy as np
import pytest

import samples
from volfrep import VolfrepError
from volfrep.design.parameters import PARAMETERS
from volfrep.design.parameters.specification import specification
from volfrep.jobs.infill import Infill
from volfrep.util import numbers

ABSURD = (1e-320, 1e-300, 1e-12, 1e12, 1e300, 1e308, -1e308)
#: What a parameter needs to have an effect.
BESIDE = {
    "lambda_start": {"size_grading": "linear", "lambda_end": 2.0},
    "lambda_end": {"size_grading": "linear"},
    "grading_direction": {"size_grading": "linear", "lambda_end": 2.0},
    "map_centre": {"cell_map": "cylindrical"},
    "map_axis": {"cell_map": "cylindrical"},
    "map_around": {"cell_map": "cylindrical"},
    "rotate_origin": {"rotate": (0, 0, 1, 20)},
    "radius_start": {"radius_grading": "direction", "radius_end": 1.0},
    "radius_end": {"radius_grading": "direction", "radius_start": 1.0},
    "radius_direction": {"radius_grading": "direction", "radius_end": 1.2},
    "radius_reach": {"radius_grading": "skin", "radius_end": 1.2},
    "drain": {"drain_diameter": 2.0},
    "drain_count": {"drain_diameter": 2.0},
    "drain_diameter": {"drain_count": 1},
}
SHAPES = {
    "direction": lambda x: (x, 0.0, 0.0),
    "point": lambda x: (x, 0.0, 0.0),
    "rotation": lambda x: (0.0, 0.0, 1.0, x),
    "planes": lambda x: ((0.0, 0.0, x, 0.0, 0.0, 1.0),),
    "places": lambda x: ((0.0, 0.0, x),),
    "thick_faces": lambda x: ((0.0, 0.0, 20.0, x),),
    "solids": lambda x: ((0.0, 0.0, 20.0, x),),
    "stiffness": lambda x: f"{x}:100",
    "integer": lambda x: int(x),
}
NUMERIC = ("length", "angle", "density", "mass", "number", *SHAPES)
ROWS = [p for p in PARAMETERS if p.in_command and p.kind in NUMERIC]
BOX = samples.box((20.0, 20.0, 20.0))


@pytest.mark.parametrize("value", ABSURD)
@pytest.mark.parametrize("parameter", ROWS, ids=lambda p: p.name)
def test_an_absurd_number_is_refused_shortly_or_does_no_harm(parameter, value):
    given = BESIDE.get(parameter.name, {}) | {
        parameter.name: SHAPES.get(parameter.kind, float)(value)
    }
    with np.errstate(all="raise", under="ignore"):
        try:
            infill = Infill(BOX, specification(given))
        except VolfrepError as error:
            said = str(error)
        else:
            said = ""
    assert len(said) < 250
    with np.errstate(all="raise", under="ignore"):
        # What is taken leads to whole figures.
        if not said and infill.spec.target is None and infill.spec.skin is not None:
            assert np.isfinite(infill.placement.bounds).all()


@pytest.mark.parametrize("unit", numbers.RANGES)
def test_a_refusal_tells_the_range(unit):
    least, most = numbers.RANGES[unit]
    for value in (0.1 * least, 10.0 * most):
        with pytest.raises(VolfrepError, match=f"from {least:g} to {most:g}".replace("+", r"\+")):
            numbers.number("size", value, unit, positive=True)
    assert numbers.number("size", least, unit, positive=True) == least
    with pytest.raises(VolfrepError, match="0 or from"):
        numbers.number("size", 0.1 * least, unit, positive=False)
    with pytest.raises(VolfrepError, match="finite number"):
        numbers.number("size", 10**400, unit, positive=None)


def test_an_origin_far_away_loses_no_strut():
    """At the edge of the range the grid still lies where it is asked to, to the last strut."""
    near = specification(
        {"cell": "BCC", "cell_size": 8.0, "strut_radius": 0.8, "origin": (0, 0, 0)}
    )
    far = specification(
        {"cell": "BCC", "cell_size": 8.0, "strut_radius": 0.8, "origin": (-8e5, 8e5, 0)}
    )
    assert len(Infill(BOX, far).struts.struts) == len(Infill(BOX, near).struts.struts)
    with pytest.raises(VolfrepError, match="origin must be from -1e"):
        specification({"origin": (1e300, 0.0, 0.0)})
