# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture of a load case: what is held is blue, what is loaded orange."""

from pathlib import Path

import numpy as np
import pytest

from bench.parts import lug_bracket
from demo.load_picture import load_picture
from volfrep.loads.load_cases import Force, LoadCase, Support
from volfrep.loads.load_file import read_load_cases
from volfrep.loads.nodal_loads import nodal_case
from volfrep.loads.regions import InPlane, NearPoint
from volfrep.reports.load_arrows import solid_body
from volfrep.util.errors import VolfrepError

LOADS = Path(__file__).resolve().parents[3] / "demo" / "bracket_loads.toml"


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
