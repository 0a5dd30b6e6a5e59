# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frames of tapered struts against closed forms, and against CalculiX on the same beams."""

import shutil

import numpy as np
import pytest
from scipy.optimize import brentq

from volfrep import LatticeSpec
from volfrep.design.cells import LIBRARY, PAPERS
from volfrep.fem.beam_mesh import beam_model
from volfrep.fem.model import Case
from volfrep.fem.solved_frame import solve_frame
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.blocks import block_wireframe
from volfrep.mechanics.catalogue import joint_law
from volfrep.mechanics.frame import SQUARE_SECTION, PeriodicFrame, Section, frame_tensor
from volfrep.mechanics.materials import Material
from volfrep.sizing.proof import end_stresses
from volfrep.sizing.structure import MultiPointConstraints, Structure
from volfrep.sizing.strut_results import buckling_loads, columns_of, stresses
from volfrep.sizing.tapered_beams import (
    Elastic,
    beams_of,
    end_table,
    energies,
)
from volfrep.util.errors import VolfrepError
from volfrep.util.linalg import cross_matrix

STEEL = Elastic(210_000.0, 0.3, 7.85e-9)
#: A section that does not slide, as Euler's and Bernoulli's beams.
NO_SHEAR = Section(1.0, 1.0, 1e12)
AREA, INERTIA = np.pi, np.pi / 4.0


def chain(length=50.0, along=(1.0, -2.0, 0.5), parts=1, section=NO_SHEAR):
    """A straight line of struts, held at its first node."""
    axis = np.array(along) / np.linalg.norm(along)
    nodes = np.linspace(0.0, length, parts + 1)[:, None] * axis
    struts = np.stack([np.arange(parts), np.arange(1, parts + 1)], axis=1)
    held = np.zeros((parts + 1, 6), bool)
    held[0] = True
    across = np.cross(axis, [0.3, 0.5, -0.8])
    across /= np.linalg.norm(across)
    return Structure(nodes, beams_of(nodes, struts, STEEL, section=section)), held, axis, across


def tip(structure, held, radii, force=(0, 0, 0), moment=(0, 0, 0)):
    loads = np.zeros((len(structure.nodes), 6))
    loads[-1, :3], loads[-1, 3:] = force, moment
    moved, _ = structure.displacements(radii, [Case(held, loads)])
    return moved[-1, :, 0]


def test_a_cantilever_bends_stretches_and_twists_as_the_closed_forms_say():
    structure, held, axis, across = chain()
    radii = np.ones((1, 2))
    assert tip(structure, held, radii, axis)[:3] @ axis == pytest.approx(50 / 210_000 / AREA)
    bent = tip(structure, held, radii, across)
    assert bent[:3] @ across == pytest.approx(50**3 / 3 / 210_000 / INERTIA)
    assert bent[3:] @ np.cross(axis, across) == pytest.approx(50**2 / 2 / 210_000 / INERTIA)
    turned = tip(structure, held, radii, moment=axis)[3:] @ axis
    assert turned == pytest.approx(50 / STEEL.shear / (2 * INERTIA))


def test_a_cone_is_exact():
    structure, held, axis, across = chain()
    radii = np.array([[2.0, 1.0]])
    assert tip(structure, held, radii, axis)[:3] @ axis == pytest.approx(
        50 / 210_000 / (np.pi * 2.0 * 1.0), rel=1e-4
    )
    assert tip(structure, held, radii, across)[:3] @ across == pytest.approx(
        4 * 50**3 / (3 * np.pi * 210_000 * 2.0**3 * 1.0), rel=1e-4
    )


def test_a_portal_sways_as_the_closed_form_says():
    """Feet fixed, equal sections: H h3 / 12 E I (3 k + 2) / (6 k + 1), k = height / width."""
    height, width = 400.0, 300.0
    nodes = np.array([[0, 0, 0], [0, 0, height], [width, 0, height], [width, 0, 0]], float)
    beams = beams_of(nodes, np.array([[0, 1], [1, 2], [2, 3]]), STEEL, section=NO_SHEAR)
    held = np.zeros((4, 6), bool)
    held[[0, 3]] = True
    loads = np.zeros((4, 6))
    loads[[1, 2], 0] = 0.5
    moved, _ = Structure(nodes, beams).displacements(np.ones((3, 2)), [Case(held, loads)])
    ratio = height / width
    sway = height**3 / 12 / 210_000 / INERTIA * (3 * ratio + 2) / (6 * ratio + 1)
    assert moved[1, 0, 0] == pytest.approx(sway, rel=2e-3)  # the columns stretch a little


def test_a_held_end_that_is_moved_takes_the_rest_along():
    structure, held, axis, _ = chain(parts=3)
    moved = np.zeros((4, 6))
    moved[0, :3] = 0.1 * axis
    case = Case(held, np.zeros((4, 6)), moved)
    found, _ = structure.displacements(np.ones((3, 2)), [case])
    assert found[:, :3, 0] == pytest.approx(np.tile(0.1 * axis, (4, 1)))


def test_its_own_weight_stretches_a_hanging_bar():
    structure, held, axis, _ = chain(parts=8)
    case = Case(held, np.zeros((9, 6)), acceleration=tuple(9810.0 * axis))
    found, _ = structure.displacements(np.ones((8, 2)), [case])
    expected = STEEL.density * 9810 * 50**2 / (2 * 210_000)
    assert found[-1, :3, 0] @ axis == pytest.approx(expected)


def test_a_cantilever_swings_at_its_natural_frequencies():
    structure, held, _, _ = chain(parts=10)
    found, _ = structure.modes(np.ones((10, 2)), held, 4)
    roots = np.array([1.875104, 1.875104, 4.694091, 4.694091])
    expected = roots**2 / (2 * np.pi * 50**2) * np.sqrt(210_000 * INERTIA / (STEEL.density * AREA))
    assert found == pytest.approx(expected, rel=2e-3)  # the rotary inertia of a slender rod


def test_a_node_that_follows_others_moves_with_them():
    """A strut's end hung rigidly beside another's tip: the same as a strut that leads there."""
    nodes = np.array([[0, 0, 0], [50, 0, 0], [50, 20, 0], [90, 20, 0]], float)
    arm = np.eye(6)
    arm[:3, 3:] = -cross_matrix(np.array([[0.0, 20.0, 0.0]]))[0]
    blocks = np.zeros((1, 3, 6, 6))
    blocks[0, 0] = arm
    constraints = MultiPointConstraints(np.array([2]), np.array([[1, 1, 1]]), blocks)
    held = np.zeros((4, 6), bool)
    held[0] = True
    loads = np.zeros((4, 6))
    loads[3, :3] = (0.3, -1.0, 2.0)
    tied = Structure(nodes, beams_of(nodes, np.array([[0, 1], [2, 3]]), STEEL), constraints)
    moved, _ = tied.displacements(np.ones((2, 2)), [Case(held, loads)])
    whole = Structure(nodes, beams_of(nodes, np.array([[0, 1], [1, 2], [2, 3]]), STEEL))
    stiff = np.array([[1.0, 1.0], [30.0, 30.0], [1.0, 1.0]])
    same, _ = whole.displacements(stiff, [Case(held, loads)])
    assert moved == pytest.approx(same, rel=2e-3, abs=1e-6)


def test_a_structure_that_is_not_held_is_refused():
    structure, held, _, across = chain()
    with pytest.raises(VolfrepError, match="move freely"):
        tip(structure, np.zeros_like(held), np.ones((1, 2)), across)


def test_a_strut_of_next_to_no_length_leaves_a_cantilever_as_it_is():
    """Its rows are 1e25 times as stiff as others: what rounding leaves there is no free motion."""
    whole, held, axis, across = chain(parts=2)
    nodes = np.insert(whole.nodes, 1, whole.nodes[1] - 1e-8 * axis, axis=0)
    stubby = Structure(nodes, beams_of(nodes, np.array([[0, 1], [1, 2], [2, 3]]), STEEL))
    held = np.zeros((4, 6), bool)
    held[0] = True
    plain = Structure(whole.nodes, beams_of(whole.nodes, np.array([[0, 1], [1, 2]]), STEEL))
    same = tip(plain, held[:3], np.ones((2, 2)), across)
    assert tip(stubby, held, np.ones((3, 2)), across) == pytest.approx(same, rel=1e-3)
    with pytest.raises(VolfrepError, match="move freely"):
        tip(stubby, np.zeros_like(held), np.ones((3, 2)), across)


def test_forces_and_stresses_of_a_cantilever():
    structure, held, axis, across = chain()
    radii = np.array([[2.0, 1.0]])
    loads = np.zeros((2, 6))
    loads[1, :3] = 3.0 * across + 7.0 * axis
    loads[1, 3:] = 11.0 * axis
    moved, _ = structure.displacements(radii, [Case(held, loads)])
    found = stresses(structure.beams, radii, structure.forces(radii, moved))
    assert found.axial[0, :, 0] == pytest.approx([7 / np.pi / 4, 7 / np.pi])
    assert found.bending[0, :, 0] == pytest.approx([150 * 4 / np.pi / 8, 0.0], abs=1e-9)
    assert found.torsion[0, :, 0] == pytest.approx([11 * 2 / np.pi / 8, 11 * 2 / np.pi])
    assert found.shear[0, :, 0] == pytest.approx([4 / 3 * 3 / np.pi / 4, 4 / 3 * 3 / np.pi])
    rim = np.hypot(found.axial + found.bending, np.sqrt(3) * found.torsion)
    assert found.mises == pytest.approx(rim)


def test_the_work_of_forces_and_its_change_with_a_radius():
    structure, held, axis, across = chain(parts=3, section=Section())
    radii = np.array([[2.0, 1.0], [1.0, 1.5], [1.5, 1.2]])
    loads = np.zeros((4, 6))
    loads[3, :3], loads[2, 3:] = across + 5 * axis, 20 * axis

    def compliance(of):
        moved, _ = structure.displacements(of, [Case(held, loads)])
        return float((loads * moved[:, :, 0]).sum()), structure.forces(of, moved)

    whole, forces = compliance(radii)
    work = energies(forces, forces)[:, :, 0]
    beams = structure.beams
    assert (work * beams.flexibility(radii)).sum() == pytest.approx(whole)
    change = np.einsum("mf,mef->me", work, beams.flexibility_changes(radii))
    thicker = radii.copy()
    thicker[1, 0] += 1e-5
    assert (compliance(thicker)[0] - whole) / 1e-5 == pytest.approx(change[1, 0], rel=1e-4)


def test_columns_buckle_as_euler_and_newmark_say():
    structure, _, _, _ = chain()
    euler = np.pi**2 * 210_000 * INERTIA / 50**2
    assert buckling_loads(structure.beams, np.ones((1, 2)), 2) == pytest.approx(euler)
    cone = buckling_loads(structure.beams, np.array([[1.0, 2.0]]), 2)
    assert cone == pytest.approx(4 * euler)  # the mean I of pi / 4 and 16 pi / 4
    # Between struts that hardly turn, nearly four times as much.
    nodes = np.array([[-1, 0, 0], [0, 0, 0], [50, 0, 0], [51, 0, 0]], float)
    beams = beams_of(nodes, np.array([[0, 1], [1, 2], [2, 3]]), STEEL)
    radii = np.array([[9.0, 9.0], [1.0, 1.0], [9.0, 9.0]])
    assert buckling_loads(beams, radii, 4)[1] == pytest.approx(4 * euler, rel=0.01)


def load_factors(structure, held, loads, radii, count=1):
    """How many times the loads may be until the frame buckles."""
    moved, factors = structure.displacements(radii, [Case(held, loads)])
    forces = structure.forces(radii, moved)[:, :, 0]
    return structure.buckling(columns_of(structure.beams, radii), forces, factors[0], count)[0]


EULER = np.pi**2 * 210_000 * INERTIA / 50**2


@pytest.mark.parametrize("parts", [1, 3])
def test_a_column_with_a_free_end_buckles_at_a_quarter_of_eulers_load(parts):
    structure, held, axis, _ = chain(parts=parts)
    loads = np.zeros((parts + 1, 6))
    loads[-1, :3] = -axis
    found = load_factors(structure, held, loads, np.ones((parts, 2)), 2)
    assert found == pytest.approx([EULER / 4, EULER / 4], rel=1e-4)  # one for each direction
    loads *= -1.0
    assert load_factors(structure, held, loads, np.ones((parts, 2))) == np.inf  # pulled


@pytest.mark.parametrize("parts", [1, 2])
@pytest.mark.parametrize(("clamped", "times"), [((), 1.0), ((0,), 2.0457), ((0, -1), 4.0)])
def test_columns_between_supports_buckle_at_the_textbooks_loads(parts, clamped, times):
    structure, _, _, _ = chain(along=(1.0, 0.0, 0.0), parts=parts)
    held, loads = np.zeros((2, parts + 1, 6))
    held[0, :4], held[-1, 1:3] = 1.0, 1.0
    for end in clamped:
        held[end, 4:] = 1.0
    loads[-1, 0] = -1.0
    found = load_factors(structure, held.astype(bool), loads, np.ones((parts, 2)))
    assert found == pytest.approx(times * EULER, rel=2e-3)


def test_a_portal_sways():
    """Timoshenko & Gere, Theory of Elastic Stability, 1961: kh / tan kh = -6 of equal bars."""
    nodes = np.array([[0, 0, 0], [0, 0, 50], [50, 0, 50], [50, 0, 0]], float)
    held, loads = np.zeros((4, 6), bool), np.zeros((4, 6))
    held[[0, 3]], held[:, [1, 3, 5]] = True, True
    loads[[1, 2], 2] = -1.0
    beams = beams_of(nodes, np.array([[0, 1], [1, 2], [2, 3]]), STEEL, section=NO_SHEAR)
    found = load_factors(Structure(nodes, beams), held, loads, np.full((3, 2), 1.0))
    root = brentq(lambda x: x / np.tan(x) + 6.0, 0.5 * np.pi + 1e-6, np.pi - 1e-6)
    assert found == pytest.approx(root**2 * 210_000 * INERTIA / 50**2, rel=1e-3)


def test_struts_are_those_of_the_homogenised_frame():
    """Two Box cells stretched along their struts, with fitted ends: the periodic frame's E."""
    ends = joint_law(LIBRARY["Box"], 10.0, "square")
    frame = block_wireframe(LatticeSpec("Box", cell_size=10, strut_radius=1), (1, 1, 2))
    beams = beams_of(
        frame.nodes, frame.struts, Elastic(1.0), section=SQUARE_SECTION, ends=end_table(ends, 1, 1)
    )
    bottom, top = (np.isclose(frame.nodes[:, 2], z) for z in (0.0, 20.0))
    held, loads = np.zeros((len(frame.nodes), 6), bool), np.zeros((len(frame.nodes), 6))
    held[bottom], loads[top, 2] = True, 0.25
    moved, _ = Structure(frame.nodes, beams).displacements(frame.radii, [Case(held, loads)])
    single = PeriodicFrame(1, np.zeros((1, 2), np.int64), np.zeros((1, 3)), np.eye(3)[2:] * 10, 1e3)
    tensor = frame_tensor(single, 1.0, ends(1.0), section=SQUARE_SECTION, longest=0.45)
    assert 0.25 * 20 / moved[top, 2, 0].mean() == pytest.approx(tensor[2, 2] * 100, rel=1e-3)


@pytest.mark.slow_cases("CVC-count0")
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
@pytest.mark.parametrize(
    ("cell", "count"),
    [("CVC", (2, 2, 1))]
    + [pytest.param(cell, (5, 3, 3), marks=pytest.mark.slow) for cell in PAPERS],
)
def test_tapered_lattices_move_swing_and_are_stressed_as_calculix_says(cell, count):
    size = 10.0
    law = joint_law(LIBRARY[cell], size, "square")
    frame = block_wireframe(LatticeSpec(cell, cell_size=size, strut_radius=0.7), count)
    at_nodes = 0.75 * (1.0 + 0.25 * np.sin(frame.nodes @ [0.11, 0.23, 0.31]))
    radii = at_nodes[frame.struts]
    frame = Wireframe(frame.nodes, frame.struts, radii, at_nodes)
    ends = end_table(law, radii.min(), radii.max())
    beams = beams_of(frame.nodes, frame.struts, STEEL, section=SQUARE_SECTION, ends=ends)
    structure = Structure(frame.nodes, beams)
    held = np.repeat(frame.nodes[:, :1] < 1e-6, 6, axis=1)
    loads = np.zeros((len(frame.nodes), 6))
    loads[frame.nodes[:, 0] > size * count[0] - 1e-6, 2] = 10.0
    case = Case(held, loads)
    moved, _ = structure.displacements(radii, [case])
    swings, _ = structure.modes(radii, held, 6)
    model = beam_model(frame, joint_law=law, elements_per_strut=12, radius_tolerance=0.002)
    found = solve_frame(model, Material("STEEL", 210_000.0, 0.3, 7.85), [case], modes=6)
    theirs = found.displacements[: len(frame.nodes), :, 0]
    off = np.linalg.norm(theirs - moved[:, :3, 0]) / np.linalg.norm(theirs)
    assert off < 0.01
    assert len(found.frequencies) == 6
    assert found.frequencies == pytest.approx(swings, rel=0.01)
    own = stresses(beams, radii, structure.forces(radii, moved))
    sum_of = (np.abs(own.axial) + own.bending)[:, :, 0]
    stressed = end_stresses(found, model, beams, radii)[:, :, 0]
    assert np.isfinite(stressed).mean() > 0.5
    assert np.nanmax(np.abs(stressed - sum_of)) < 0.06 * sum_of.max()
