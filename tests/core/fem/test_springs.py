# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs between nodes of a deck, in CalculiX."""

import shutil
from types import SimpleNamespace

import numpy as np
import pytest

from volfrep.fem.calculix import run
from volfrep.fem.solved_frame import _skin
from volfrep.mechanics.materials import find_material


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
def test_a_stiffness_that_is_a_whole_number_is_read_as_one():
    skin = SimpleNamespace(
        mesh=SimpleNamespace(elements=np.empty((0, 15), int), is_pad=np.empty(0, bool)),
        followers=np.empty(0, int), leaders=np.empty((0, 1), int),
        weights=np.empty((0, 1, 3, 3)), springs=np.array([[0, 1]]), stiffness=11_000_000.0,
    )  # fmt: skip
    beams = SimpleNamespace(nodes=np.zeros((2, 3)), elements=np.empty((0, 2), int))
    lines = [b"*NODE,NSET=NALL\n1,0,0,0\n2,1,0,0\n"]
    lines += _skin(skin, beams, find_material("PA12").for_solver())
    lines.append(
        b"*BOUNDARY\n1,1,3\n*STEP\n*STATIC\n*CLOAD\n2,1,22.\n*NODE PRINT,NSET=NALL\nU\n"
        b"*NODE FILE\nU\n*END STEP\n"
    )
    with run(iter(lines), "a spring") as results:
        ((number, moved),) = results.displacements
    assert moved[list(number).index(1)] == pytest.approx([2e-6, 0.0, 0.0])
