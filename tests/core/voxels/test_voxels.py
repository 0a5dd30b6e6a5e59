# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed mesh solved by voxels, against closed forms; what its solver takes at any size."""

import numpy as np
import pytest
import trimesh
from manifold3d import Manifold

from volfrep.jobs.solving import solve_solid
from volfrep.loads.load_cases import Force, Load, LoadCase, LoadCases, Moment, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.elements import CORNERS
from volfrep.mechanics.materials import SolidMaterial
from volfrep.mesh.booleans import as_mesh
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.linalg import rotation
from volfrep.voxels.bricks import CutBricks, brick
from volfrep.voxels.shares import voxel_grid
from volfrep.voxels.solution import figures_of, solve_cases, voxel_model

YOUNG, POISSON = 1000.0, 0.3
SHEAR = YOUNG / 2 / (1 + POISSON)
SOLID = SolidMaterial("X", 1.0, YOUNG, POISSON)
AXES = np.eye(3)


def bar(length, side=10.0, turn=None):
    shape = trimesh.creation.box(bounds=((0, 0, 0), (length, side, side)))
    turn = AXES if turn is None else turn
    return TriangleMesh(np.array(shape.vertices) @ turn.T, np.array(shape.faces).astype(np.int32))


def plane(normal, offset=0.0):
    normal = np.array(normal, float)
    return InPlane(tuple(offset * normal), tuple(normal))


def solved(mesh, voxel, *loads: Load, supports=None, along=AXES[0], pull=(0.0, 0.0, 0.0)):
    held = supports or (Support(plane(along)),)
    model = voxel_model(mesh, voxel, SOLID)
    state = solve_cases(model, [LoadCase("one", held, loads, pull)])[0]
    return model, state, figures_of(model, state)


@pytest.mark.parametrize("voxel", [5.0, 2.5, 2.0])
def test_a_bar_in_tension_is_exact(voxel):
    slides = [
        Support(plane(AXES[k]), tuple(0.0 if j == k else None for j in range(3))) for k in range(3)
    ]
    pull = Force(plane(AXES[0], 40.0), (100.0, 0.0, 0.0))
    _, _, told = solved(bar(40.0), voxel, pull, supports=tuple(slides))
    assert told["loads"][0]["moved_mm"][0] == pytest.approx(100 * 40 / YOUNG / 100, rel=1e-3)
    assert told["reaction"][0] == pytest.approx(-100.0)
    assert told["imbalance"] < 1e-6


@pytest.mark.parametrize(
    ("angle", "across", "off"), [(0.0, 2, 0.02), (0.35, 5, 0.03), (0.6, 6, 0.02)]
)
def test_a_cantilever_bends_and_shears_as_a_beam_however_it_lies_in_the_grid(angle, across, off):
    """Of Timoshenko's the held end takes 0.7 %: the section there cannot narrow."""
    turn = rotation(np.array([1.0, 2.0, 3.0]), angle)
    force = turn[:, 2]
    load = Force(plane(turn[:, 0], 100.0), tuple(force.tolist()))
    _, _, told = solved(bar(100.0, turn=turn), 10.0 / across, load, along=turn[:, 0])
    beam = 100.0**3 / 3 / YOUNG / (10.0**4 / 12) + 100.0 / (5 / 6 * SHEAR * 100.0)
    assert told["compliance_nmm"] == pytest.approx(0.993 * beam, rel=off)
    assert np.array(told["loads"][0]["moved_mm"]) @ force == pytest.approx(0.993 * beam, rel=off)


def test_a_square_bar_twists_as_saint_venant_says():
    turned = []
    for length in (30.0, 60.0):  # the difference has no ends
        load = Moment(plane(AXES[0], length), (1000.0, 0.0, 0.0))
        model, state, _ = solved(bar(length), 1.25, load)
        end = model.nodes[:, 0] > length - 1e-6
        at = model.nodes[end] - (length, 5.0, 5.0)
        about = np.cross(at, state.displacements[end])[:, 0]
        turned.append(float(about.sum() / (at[:, 1:] ** 2).sum()))
    expected = 1000.0 * 30.0 / (SHEAR * 0.140577 * 10.0**4)
    assert turned[1] - turned[0] == pytest.approx(expected, rel=0.02)


def test_what_a_part_weighs_is_held_by_its_supports():
    _, _, told = solved(bar(20.0), 2.0, pull=(0.0, 0.0, -9810.0))
    assert told["reaction"][2] == pytest.approx(2000 * 1e-9 * 9810, rel=1e-3)
    assert told["imbalance"] < 1e-6


def test_a_prescribed_displacement_stretches_a_bar():
    ends = (Support(plane(AXES[0])), Support(plane(AXES[0], 40.0), (0.04, None, None)))
    model, state, told = solved(bar(40.0), 2.5, supports=ends)
    assert told["displacement_mm"] == pytest.approx(0.04, rel=0.05)
    right = state.reactions[model.nodes[:, 0] > 39.0].sum(axis=0)
    assert right[0] == pytest.approx(YOUNG * 0.001 * 100.0, rel=0.02)


def test_shares_hold_a_solids_volume_wherever_it_lies():
    ball = as_mesh(Manifold.sphere(10.0, 64))
    for turn in (AXES, rotation(np.array([1.0, 1.0, 0.3]), 0.4)):
        for mesh in (TriangleMesh(ball.vertices @ turn.T, ball.triangles), bar(33.0, turn=turn)):
            grid = voxel_grid(mesh, 1.7)
            held = float(grid.shares.sum() * np.prod(grid.edge))
            assert held == pytest.approx(mesh.volume, rel=3e-3)


def test_an_element_that_is_cut_holds_the_energy_of_what_is_filled():
    """Patch test: of any even strain, whatever of the element is filled; a full one is a brick."""
    edge = np.array([1.0, 1.2, 0.9])
    random = np.random.default_rng(5)
    cut = CutBricks(YOUNG, POISSON, edge)
    parts = np.vstack([random.random((20, 8)), np.eye(8), np.ones(8)])
    stiffness = cut.stiffness(parts)
    assert stiffness[-1] == pytest.approx(brick(YOUNG, POISSON, edge).stiffness, abs=1e-9 * YOUNG)
    slope = random.standard_normal((3, 3))
    moved = (CORNERS * edge @ slope.T).ravel()
    strain = 0.5 * (slope + slope.T)
    stress = (
        YOUNG
        / (1 + POISSON)
        * (strain + POISSON / (1 - 2 * POISSON) * np.trace(strain) * np.eye(3))
    )
    volume = parts.sum(axis=1) * np.prod(edge) / 8
    work = np.einsum("i,kij,j->k", moved, stiffness, moved)
    assert work == pytest.approx(volume * np.sum(stress * strain))
    told = cut.stress(parts, np.tile(moved, (len(parts), 1)), edge)
    assert told == pytest.approx(np.tile(stress[[0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]], (29, 1)))


@pytest.mark.parametrize("angle", [0.3, 0.6])
def test_a_thin_wall_bends_also_where_it_lies_askew_in_the_grid(angle):
    """Three voxels across; cut voxels that count by their share alone bend 8 % too little."""
    turn = rotation(np.array([0.3, 1.0, 0.2]), angle)
    shape = trimesh.creation.box(bounds=((0, 0, 0), (40, 6, 3)))
    wall = TriangleMesh(shape.vertices @ turn.T, np.array(shape.faces).astype(np.int32))
    force = turn[:, 2]
    load = Force(plane(turn[:, 0], 40.0), tuple(force.tolist()))
    _, _, told = solved(wall, 1.0, load, along=turn[:, 0])
    beam = 40.0**3 / 3 / YOUNG / (6 * 3.0**3 / 12) + 40.0 / (5 / 6 * SHEAR * 18.0)
    print(f"over the beam {told['compliance_nmm'] / beam:.3f}")
    assert told["compliance_nmm"] == pytest.approx(0.99 * beam, rel=0.08)


@pytest.mark.slow
def test_steps_do_not_grow_as_voxels_become_smaller():
    ring = Manifold.cylinder(12.0, 10.0, 10.0, 64) - Manifold.cylinder(12.0, 6.0, 6.0, 48)
    mesh = as_mesh(ring)
    force = Force(plane(AXES[2], 12.0), (1.0, 0.0, 0.0))
    steps, counts = [], []
    for voxel in (2.0, 1.0, 0.5):
        model, state, _ = solved(mesh, voxel, force, along=AXES[2])
        steps.append(state.steps)
        counts.append(len(model.shares))
    assert counts[-1] > 20 * counts[0]
    assert max(steps) <= 14
    assert steps[-1] <= steps[0] + 3


@pytest.mark.parametrize("stage", ["voxels", "solving"])
def test_a_cancel_ends_the_job_at_once_in_either_stage(stage):
    force = Force(plane(AXES[0], 40.0), (1.0, 0.0, 0.0))
    loads = LoadCases(SOLID, (LoadCase("one", (Support(plane(AXES[0])),), (force,)),))
    told = []

    def until(fraction, name):
        told.append((fraction, name))
        return name != stage

    with pytest.raises(Cancelled):
        solve_solid(bar(40.0), loads, voxel=2.0, progress=until)
    assert [name for _, name in told].count(stage) == 1


def test_a_part_that_may_move_is_refused_as_such():
    force = Force(plane(AXES[0], 40.0), (1.0, 0.0, 0.0))
    loose = (Support(plane(AXES[0]), (0.0, None, None)),)
    with pytest.raises(VolfrepError, match="may move as a whole"):
        solved(bar(40.0), 5.0, force, supports=loose)


def test_the_moment_of_a_force_that_acts_elsewhere_arrives():
    load = Force(plane(AXES[0], 40.0), (0.0, 0.0, 7.0), at=(60.0, 5.0, 5.0))
    _, _, told = solved(bar(40.0, turn=rotation(AXES[0], 0.2)), 3.0, load)
    assert told["reaction"][4] == pytest.approx(7.0 * 60.0, rel=1e-3)
