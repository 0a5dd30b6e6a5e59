# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sized part's skin has the thickness of its faces."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.design.openings import OpenPlane
from volfrep.design.skins.own_faces import FaceSkin
from volfrep.jobs.sizing.part_model import thickness_of_skin
from volfrep.sizing.skin import skin_model
from volfrep.sizing.tapered_beams import Elastic


def test_the_shells_are_as_thick_as_the_skin_below_their_face() -> None:
    solid = samples.box((40.0, 30.0, 20.0))
    top = FaceSkin(OpenPlane((0, 0, 20), (0, 0, 1)), 4.0)
    spec = LatticeSpec(shell=2.0, face_skins=(top,))
    skin = skin_model(solid, thickness_of_skin(solid, spec), 5.0, Elastic(210e3, 0.3))
    middle = skin.outside.vertices[skin.shells.triangles].mean(axis=1)
    inner = (np.abs(middle[:, :2] - (20, 15)) < (12, 8)).all(axis=1)
    assert skin.shells.thickness[inner & (middle[:, 2] > 19.9)] == pytest.approx(4.0)
    assert skin.shells.thickness[inner & (middle[:, 2] < 0.1)] == pytest.approx(2.0)
