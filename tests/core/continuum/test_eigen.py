# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frequencies and buckling of homogenised parts against columns, beams and attached bodies."""

import numpy as np
import pytest
from test_continuum import PA12, WHOLE, block, end, moved

from volfrep import LatticeSpec
from volfrep.continuum.eigen import lumped_mass
from volfrep.jobs.homogenised import homogenise_part
from volfrep.jobs.infill import Infill
from volfrep.jobs.part_bricks import cell_law
from volfrep.jobs.sizing import solve_struts
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Mass, Support

LENGTH, WIDE = 120, 60


def pressed(force=-10.0, name="press"):
    return LoadCase(name, (Support(end(0)),), (Force(end(LENGTH), (force, 0, 0)),))


def solved(cell, cases, masses=(), **wanted):
    spec = LatticeSpec(cell, cell_size=10, strut_radius=0.8, shell=0)
    loads = LoadCases(PA12, cases, masses)
    return spec, homogenise_part(block(LENGTH, WIDE, WIDE), spec, loads, element=10, **wanted)


def moduli(spec):
    """E along an edge, G and the density, MPa and t/mm3, of an endless lattice."""
    law = cell_law(spec)
    inverse = np.linalg.inv(law.tensors[0])
    density = PA12.density * 1e-9 * law.density[0]
    return PA12.young / inverse[0, 0], PA12.young / inverse[5, 5], density


@pytest.mark.parametrize(("cell", "within"), [("Octet", 0.03), ("Box", 0.06)])
def test_a_bar_buckles_and_swings_as_a_beam_with_shear(cell, within):
    """Engesser's column; Southwell's sum of a bent and a sheared beam, which is a little low."""
    spec, made = solved(cell, (pressed(), pressed(10.0, "pull")), frequencies=2, load_factors=2)
    young, shear, density = moduli(spec)
    area, inertia = WIDE**2, WIDE**4 / 12
    euler = np.pi**2 * young * inertia / (4 * LENGTH**2)
    column = euler / (1 + 1.2 * euler / (shear * area)) / 10.0
    press, pull = (case["load_factors"] for case in made.report["cases"])
    assert press == pytest.approx([column, column], rel=within)
    assert pull == [None, None]
    bent = 1.8751**2 / (2 * np.pi * LENGTH**2) * np.sqrt(young * inertia / (density * area))
    sheared = np.sqrt(shear / 1.2 / density) / (4 * LENGTH)
    beam = (bent**-2 + sheared**-2) ** -0.5
    assert made.report["frequencies_hz"] == pytest.approx([beam, beam], rel=within + 0.02)


def test_a_heavy_body_swings_on_the_part_as_on_a_spring():
    body = Mass(end(LENGTH), 1e5)
    bend = LoadCase("bend", (Support(end(0)),), (Force(end(LENGTH), (0, 0, 1.0)),))
    _, made = solved("Octet", (bend,), (body,), frequencies=1)
    # The body turns with the bar's end, which takes a little.
    (way,) = made.report["cases"][0]["loads"]
    spring = 1.0 / way["moved_mm"][2]
    assert made.report["frequencies_hz"] == pytest.approx(
        [np.sqrt(spring / 0.1) / (2 * np.pi)], rel=0.03
    )


def test_struts_are_pressed_as_columns_between_pins():
    """Closed form: a strut of Box shortened by a strain, over what buckles it."""
    loads = LoadCases(PA12, (moved(60, (-0.06, None, None)),))
    spec = LatticeSpec("Box", strut_radius=0.5, **WHOLE)
    made = homogenise_part(block(60, 30, 30), spec, loads, element=5)
    closed = 1e-3 * 4 * 10**2 / (np.pi**2 * 0.5**2)
    # Joints stiffen struts by some percent.
    assert closed < made.report["cases"][0]["strut_buckling"] < 1.08 * closed


def test_whole_cells_with_no_strut_in_their_faces_are_solved_as_well():
    """CVC: the mass is that of the endless lattice in as many cells."""
    spec = LatticeSpec("CVC", strut_radius=0.8, **WHOLE)
    made = homogenise_part(
        block(30, 20, 20), spec, LoadCases(PA12, (moved(30, (0.1, 0, 0)),)), element=10
    )
    volume = cell_law(spec).density[0] * 30 * 20 * 20
    assert lumped_mass(made.model).sum() == pytest.approx(volume * PA12.density * 1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("cell", ["Octet", "CVC", "FCC", "BCC", "Box"])
def test_whole_blocks_of_six_cells_swing_as_their_beams_do(cell):
    """Beams weigh joints as often as struts meet there: at the mass of the file."""
    spec, solid = LatticeSpec(cell, strut_radius=0.8, **WHOLE), block(LENGTH, WIDE, WIDE)
    loads = LoadCases(PA12, (pressed(),))
    model, found = solve_struts(solid, spec, loads)
    structure = model.problem.structure
    radii = model.problem.radii.of_struts(found.radii)
    beams, _ = structure.modes(radii, model.problem.cases[0].fixed, 3)
    # Of a whole lattice, the mass of its struts, each from node to node.
    sizes = radii[:, 0] ** 2 + radii[:, 0] * radii[:, 1] + radii[:, 1] ** 2
    heavy = float((np.pi / 3.0 * structure.beams.length * sizes).sum())
    true = abs(Infill(solid, spec).part.mesh.volume)
    made = homogenise_part(solid, spec, loads, frequencies=3)
    assert made.report["frequencies_hz"] == pytest.approx(beams * np.sqrt(heavy / true), rel=0.05)
