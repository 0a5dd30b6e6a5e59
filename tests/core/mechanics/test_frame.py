# SPDX-License-Identifier: LGPL-2.1-or-later
"""Periodic frames against closed forms and a public catalogue of anisotropic lattices."""

import json
from pathlib import Path

import numpy as np
import pytest

from tools.lines_to_compare import gibson_ashby, hashin_shtrikman
from volfrep import VolfrepError
from volfrep.design.cells import LIBRARY
from volfrep.mechanics.frame import CIRCLE, SQUARE_SECTION, Ends, PeriodicFrame, frame_tensor
from volfrep.mechanics.joint_fit import fit_joint, periodic_frame
from volfrep.mechanics.tensor import cubic, moduli

CATALOGUE = json.loads(Path(__file__).with_name("anisotropic_lattices.json").read_text())[
    "lattices"
]


def test_timoshenko_frames_have_the_stiffness_worked_out_by_hand():
    octet = frame_tensor(periodic_frame(LIBRARY["Octet"]), 0.05)
    found = octet[0, 0], octet[0, 1], octet[3, 3]
    assert found == pytest.approx((2.25336e-2, 1.09476e-2, 1.12668e-2), rel=1e-5)
    box = frame_tensor(periodic_frame(LIBRARY["Box"]), 0.05)
    assert (box[0, 0], box[3, 3]) == pytest.approx((7.85398e-3, 2.88184e-5), rel=1e-5)
    assert box[0, 1] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("lattice", CATALOGUE, ids=[entry["name"] for entry in CATALOGUE])
def test_anisotropic_lattices_have_the_published_compliance(lattice):
    """An independent beam code; its shear coefficient is not told: within 1.5 %.

    Of what couples two strains: of the root of what the two are by themselves.
    """
    axes = periods(*lattice["edges"], *np.radians(lattice["angles"]))
    nodes, struts = np.array(lattice["nodes"]), np.array(lattice["struts"])
    grid = np.round(nodes * 1e4).astype(int)
    _, number = np.unique(grid % 10_000, axis=0, return_inverse=True)
    number = number.ravel()
    rows, seen = [], set()
    for row, (one, two) in enumerate(struts):
        span = grid[two] - grid[one]
        key = frozenset({(number[one], number[two], *span), (number[two], number[one], *-span)})
        if key not in seen:
            rows.append(row)
            seen.add(key)
    start, end = (nodes[struts[rows, side]] @ axes for side in (0, 1))
    volume = float(np.linalg.det(axes))
    frame = PeriodicFrame(number.max() + 1, number[struts[rows]], start, end, volume)
    length = np.linalg.norm(end - start, axis=1).sum()
    tensor = frame_tensor(frame, np.sqrt(0.01 * volume / np.pi / length))
    mandel = np.diag([1, 1, 1, *[np.sqrt(2)] * 3])
    found = np.linalg.inv(mandel @ tensor @ mandel)
    expected = np.array(lattice["compliance"])
    scale = np.sqrt(np.diag(expected))
    assert found / np.outer(scale, scale) == pytest.approx(
        expected / np.outer(scale, scale), abs=0.015
    )


def periods(a, b, c, alpha, beta, gamma):
    """The three periods of a lattice of these edges and angles, the first along x."""
    x, y = np.cos(beta), (np.cos(alpha) - np.cos(beta) * np.cos(gamma)) / np.sin(gamma)
    return np.array([
        [a, 0.0, 0.0],
        [b * np.cos(gamma), b * np.sin(gamma), 0.0],
        [c * x, c * y, c * np.sqrt(1.0 - x * x - y * y)],
    ])  # fmt: skip


def test_ends_stiffen_and_are_never_longer_than_their_strut():
    frame = periodic_frame(LIBRARY["CVC"])
    bare, some, more = (
        moduli(frame_tensor(frame, 0.08, Ends(length, 1.5, 3.0))).E100 for length in (0.0, 1.0, 2.0)
    )
    assert bare < some < more
    capped = frame_tensor(frame, 0.08, Ends(50.0, 1.5, 3.0))
    assert np.isfinite(capped).all()
    none = frame_tensor(frame, 0.08, Ends(1.0, 1.0, 1.0))
    assert none == pytest.approx(frame_tensor(frame, 0.08), rel=1e-6, abs=1e-12)
    with pytest.raises(VolfrepError, match="at least one strut"):
        frame_tensor(PeriodicFrame(1, np.zeros((0, 2), int), np.zeros((0, 3)), np.zeros((0, 3))), 1)


@pytest.mark.parametrize("section", [CIRCLE, SQUARE_SECTION])
def test_a_fit_finds_the_ends_that_a_frame_was_made_with(section):
    cell, made = LIBRARY["Octet"], Ends(1.2, 1.5, 4.0)
    tensor = frame_tensor(periodic_frame(cell), 0.05, made, section=section)
    found = fit_joint(cell, 0.05, tensor, section=section)
    assert found.misfit.max() < 0.005


def test_moduli_of_a_published_cubic_tensor():
    found = moduli(cubic(165.7, 63.9, 79.6))
    assert found.bulk == pytest.approx(97.83, rel=1e-3)
    along = found.E100, found.E111
    assert along == pytest.approx((130.1, 187.9), rel=1e-3)
    assert found.zener == pytest.approx(1.564, rel=1e-3)


def test_the_lines_to_compare_with():
    density = np.array([0.2, 1.0])
    young_bound, shear_bound = hashin_shtrikman(density)
    assert (young_bound[1], shear_bound[1]) == pytest.approx((1.0, 1 / 2.6))
    # For nu = 0.3 the bound of E at low densities tends to about half the density.
    assert 0.4 * 0.2 < young_bound[0] < 0.6 * 0.2
    foam = gibson_ashby(density)
    assert [float(line[0]) for line in foam] == pytest.approx([0.04, 0.015, 0.3 * 0.2**1.5])
