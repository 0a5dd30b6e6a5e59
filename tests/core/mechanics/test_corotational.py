# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams far past yield and buckling, held against closed forms."""

from collections.abc import Sequence

import numpy as np
import pytest

from volfrep.mechanics.corotational import Balance, Beams, State, rotations

YOUNG, YIELD, RADIUS = 1550.0, 42.0, 1.0
AREA, INERTIA = np.pi * RADIUS**2, np.pi * RADIUS**4 / 4.0


def rod(length: float, count: int, yields: bool, offset: float = 0.0) -> Beams:
    """A rod along z in so many elements; its middle is a little off its axis."""
    place = np.linspace(0.0, 1.0, count + 1)
    nodes = np.stack([offset * np.sin(np.pi * place), 0.0 * place, length * place], axis=1)
    elements = np.stack([np.arange(count), np.arange(count) + 1], axis=1)
    every = np.ones(count)
    limit = YIELD if yields else np.inf
    return Beams(nodes, elements, RADIUS * every, YOUNG * every, limit, 0.0)


def led(beams: Beams, held: dict[int, Sequence[int]], moves: dict[tuple[int, int], float],
        steps: int) -> tuple[list[np.ndarray], State]:  # fmt: skip
    """Forces (n, 6) after each of equal steps, and the end; moves are of a node in a direction."""
    free = np.ones((len(beams.nodes), 6), bool)
    for node, directions in held.items():
        free[node, list(directions)] = False
    even = np.zeros((len(beams.nodes), 6))
    for (node, direction), amount in moves.items():
        free[node, direction] = False
        even[node, direction] = amount / steps
    balance = Balance(beams, free.ravel())
    state, found = beams.at_rest(), []
    for _ in range(steps):
        step = balance.step(state, even)
        assert step is not None
        state = step[0]
        found.append(step[1])
    return found, state


def test_a_rigid_motion_takes_no_force():
    beams = rod(10.0, 3, yields=True)
    turn = rotations(np.array([[0.3, -0.8, 1.2]]))[0]
    turned = State(beams.nodes @ turn.T + 5.0, np.tile(turn, (4, 1, 1)), beams.at_rest().plastic)
    assert np.abs(beams.respond(turned)[0]).max() < 1e-9


def test_the_stiffness_is_the_slope_of_the_forces():
    beams = rod(3.0, 1, yields=False)
    moves = np.random.default_rng(1).normal(size=(2, 6)) * 0.1
    turn = rotations(np.array([[0.5, 0.3, 0.2]]))[0]
    state = State(beams.nodes @ turn.T, np.tile(turn, (2, 1, 1)), beams.at_rest().plastic)
    state = state.moved(moves)
    slope = np.empty((12, 12))
    for column in range(12):
        step = np.zeros(12)
        step[column] = 1e-6
        ahead, behind = (
            beams.respond(state.moved(sign * step.reshape(2, 6)))[0][0] for sign in (1.0, -1.0)
        )
        slope[:, column] = (ahead - behind) / 2e-6
    assert np.abs(beams.respond(state)[1][0] - slope).max() < 1e-4 * np.abs(slope).max()


def test_a_short_rod_is_squashed_at_its_yield_stress():
    forces, _ = led(rod(4.0, 4, yields=True), {0: range(6), 4: (0, 1, 3, 4, 5)}, {(4, 2): -0.4}, 10)
    # It keeps its volume: after 10 % its section is that much wider.
    assert -forces[-1][4, 2] == pytest.approx(YIELD * AREA / 0.9, rel=0.005)
    assert -forces[0][4, 2] == pytest.approx(YOUNG * AREA * 0.01, rel=0.02)


def test_a_cantilever_bends_at_its_plastic_moment():
    forces, _ = led(rod(8.0, 8, yields=True), {0: range(6)}, {(8, 4): 1.5}, 15)
    assert abs(forces[-1][8, 4]) == pytest.approx(4.0 / 3.0 * RADIUS**3 * YIELD, rel=0.03)


def test_a_rod_bent_by_its_end_becomes_half_a_circle():
    length = 60.0
    forces, end = led(rod(length, 12, yields=False), {0: range(6)}, {(12, 4): np.pi}, 12)
    radius = length / np.pi
    tip = end.places[-1]
    assert tip == pytest.approx([2.0 * radius, 0.0, 0.0], abs=0.01 * length)
    assert forces[-1][12, 4] == pytest.approx(YOUNG * INERTIA / radius, rel=0.01)


def test_a_slender_rod_buckles_at_eulers_load():
    length = 80.0
    beams = rod(length, 8, yields=False, offset=0.1)
    forces, _ = led(beams, {0: (0, 1, 2, 5), 8: (0, 1, 5)}, {(8, 2): -0.3}, 30)
    euler = np.pi**2 * YOUNG * INERTIA / length**2
    assert -forces[-1][8, 2] == pytest.approx(euler, rel=0.03)
