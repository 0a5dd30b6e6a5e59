# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture of a load case: what is held is blue, what is loaded orange."""

from pathlib import Path

import numpy as np
import pytest

from bench.parts import NO_PARTS, PARTS, lug_bracket
from demo.load_picture import load_picture
from volfrep.io.solid import read_solid
from volfrep.loads.load_cases import Force, LoadCase, Support
from volfrep.loads.load_file import read_load_cases
from volfrep.loads.nodal_loads import nodal_case
from volfrep.loads.regions import InPlane, NearPoint
from volfrep.reports.load_arrows import solid_body
from volfrep.util.errors import VolfrepError

DEMO = Path(__file__).resolve().parents[3] / "demo"
LOADS = DEMO / "bracket_loads.toml"
POUND = 4.4482216152605  # N


def test_every_load_of_the_documented_bracket_finds_its_place():
    bracket = lug_bracket()
    body = solid_body(bracket)
    for case in read_load_cases(LOADS, bracket).cases:
        laid = nodal_case(body, case)
        held = body.nodes[laid.fixed[:, 0]]
        assert set(np.sign(held[:, [0, 2]]).ravel()) == {-1.0, 1.0}
        assert np.hypot(np.abs(held[:, 0]) - 70, np.abs(held[:, 2]) - 37).max() < 5.26
        loaded = body.nodes[laid.loads.any(axis=1)]
        assert np.hypot(loaded[:, 0], loaded[:, 1] - 42).max() < 10.01


def test_the_loads_of_the_ge_bracket_are_those_of_its_challenge():
    """8,000 lbf up, 8,500 out, 9,500 at 42 degrees between them, a torque of 5,000 lbf in."""
    loads = read_load_cases(DEMO / "ge_bracket_loads.toml")
    assert loads.material.yield_stress == 903.0
    up, out, between, torque = (case.loads[0] for case in loads.cases)
    assert up.force == pytest.approx((0, 8000 * POUND, 0))
    assert out.force == pytest.approx((0, 0, 8500 * POUND))
    angle = np.radians(42)
    wanted = 9500 * POUND * np.array([0, np.cos(angle), np.sin(angle)])
    assert between.force == pytest.approx(wanted, rel=1e-4)
    assert torque.moment == pytest.approx((0, 5000 * 25.4 * POUND, 0))


@pytest.mark.skipif(not PARTS.is_dir(), reason=NO_PARTS)
def test_the_ge_bracket_is_held_in_its_bolts_holes_and_loaded_in_its_eyes():
    """By the area of the walls of four holes 7.85 mm deep, and of two eyes 6.35 mm wide."""
    bracket = read_solid(PARTS / "ge_bracket.stl")
    case = read_load_cases(DEMO / "ge_bracket_loads.toml", bracket).cases[0]
    one, two, three = bracket.vertices[bracket.triangles].swapaxes(0, 1)
    area = 0.5 * np.linalg.norm(np.cross(two - one, three - one), axis=1)
    held = area[case.supports[0].region.facets(bracket, 1e-3)].sum()
    loaded = area[case.loads[0].region.facets(bracket, 1e-3)].sum()
    assert held == pytest.approx(2 * np.pi * 7.85 * (3 * 5.156 + 5.334), rel=0.01)
    assert loaded == pytest.approx(2 * np.pi * 9.557 * 2 * 6.35, rel=0.01)


@pytest.mark.slow
def test_what_is_held_is_blue_and_what_is_loaded_orange(tmp_path):
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    from PIL import Image

    bracket = lug_bracket()
    case = read_load_cases(LOADS, bracket).cases[0]
    load_picture(bracket, case, tmp_path / "case.png", size=(400, 300), y_up=True)
    picture = np.asarray(Image.open(tmp_path / "case.png").convert("RGB")).astype(int)
    red, _, blue = picture.reshape(-1, 3).T
    assert ((red > 180) & (blue < 110)).mean() > 0.005
    assert ((blue > 120) & (red < 90)).mean() > 0.002
    high, wide = np.nonzero((picture[..., 0] > 180) & (picture[..., 2] < 110))
    assert high.min() < 0.35 * 300  # the arrow points up, out of the part
    assert 0.3 * 400 < wide.mean() < 0.7 * 400


@pytest.mark.costly
def test_a_load_beside_the_part_is_refused(tmp_path):
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    floor = Support(InPlane((0, 0, 0), (0, 1, 0)))
    case = LoadCase("beside", (floor,), (Force(NearPoint((0, 900, 0), 5.0), (0, 1.0, 0)),))
    with pytest.raises(VolfrepError, match="Nothing of the part lies in the ball"):
        load_picture(lug_bracket(), case, tmp_path / "case.png")
    assert not list(tmp_path.iterdir())
