# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants: which there are, and what is in them."""

import numpy as np
import pytest

from volfrep.design.cells import PAPERS, find_cell, make_cell
from volfrep.mesh.remesh import edges
from volfrep.octants import sdf
from volfrep.octants.octant import (
    ALL_ACTIVE,
    ZERO_BAND,
    OctantKey,
    corner_patterns,
    octant_mirrors,
    octant_primitives,
    raw_octant,
    sample_octant,
)

SKEW = make_cell("skew", [[0, 0, 0], [1, 1, 1], [0.3, 0.6, 0.45]], [[0, 2], [2, 1]])


def test_the_six_cells_are_their_own_mirror_images():
    assert all(cell.is_mirror_symmetric for cell in map(find_cell, PAPERS))
    assert not SKEW.is_mirror_symmetric


def test_one_cell_has_an_octant_of_each_pattern_of_one():
    pattern = corner_patterns(np.ones((1, 1, 1), bool))
    assert pattern.shape == (4, 4, 4)
    # The cell is bit 0 of its own eight octants, and seen across faces from those around.
    assert (pattern[1:3, 1:3, 1:3] == 1).all()
    assert set(np.unique(pattern)) == {1 << k for k in range(8)}


def test_a_large_block_has_27_patterns_and_all_cells_active_inside():
    pattern = corner_patterns(np.ones((5, 5, 5), bool))
    assert len(np.unique(pattern)) == 27
    assert (pattern[2:-2, 2:-2, 2:-2] == ALL_ACTIVE).all()


def test_frames_are_reflected_in_turn():
    mirrors = octant_mirrors((4, 4, 4))
    assert mirrors[0, 0, 0] == 7
    assert mirrors[1, 0, 0] == 6
    assert mirrors[1, 1, 1] == 0


@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda c: c.name)
@pytest.mark.parametrize("radius", [0.4, 1.0, 1.25])
def test_the_raw_surface_is_open_on_the_octants_faces_only(cell, radius):
    size, steps = 10.0, 9
    primitives = octant_primitives(cell, OctantKey(0, ALL_ACTIVE), size, radius, 2.0)
    samples = sample_octant(primitives, size, steps, 0.0)
    assert (samples != 0).all()
    raw = raw_octant(samples, size)
    table = edges(raw.triangles, len(raw.vertices))
    open_ends = table.ends[table.triangles[:, 1] < 0]
    on_face = (
        (raw.place[open_ends[:, 0]] == raw.place[open_ends[:, 1]])
        & (raw.place[open_ends[:, 0]] != 1)
    ).any(1)
    assert on_face.all()
    inner = table.ends[table.triangles[:, 1] >= 0]
    chord = (
        (raw.place[inner[:, 0]] == raw.place[inner[:, 1]]) & (raw.place[inner[:, 0]] != 1)
    ).any(1)
    assert not chord.any()


def test_samples_are_the_least_of_all_distances_and_few_of_them_are_found(monkeypatch):
    size, steps = 10.0, 24
    primitives = octant_primitives(find_cell("Kagome"), OctantKey(0, ALL_ACTIVE), size, 0.45, 0.3)
    axis = np.linspace(0.0, size / 2, steps + 1)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
    least = sdf.distances(points[..., None, :], primitives).min(-1)
    found = []
    distances = sdf.distances
    monkeypatch.setattr(
        sdf, "distances", lambda *given: found.append(distances(*given)) or found[-1]
    )
    samples = sample_octant(primitives, size, steps, 0.0)
    moved = np.abs(least) < ZERO_BAND * axis[1]
    np.testing.assert_array_equal(samples[~moved], least[~moved])
    assert (samples[moved] == ZERO_BAND * axis[1]).all()
    assert sum(values.size for values in found) < 0.6 * least.size * len(primitives)


def test_faces_of_reflected_neighbours_carry_the_same_samples():
    size, steps = 10.0, 8
    for bit in range(3):
        here, there = (
            sample_octant(
                octant_primitives(SKEW, OctantKey(m, ALL_ACTIVE), size, 1.0, 2.0), size, steps, 0.0
            )
            for m in (0, 1 << bit)
        )
        low = [slice(None)] * 3
        low[bit] = 0
        high = [slice(None)] * 3
        high[bit] = steps
        np.testing.assert_allclose(here[tuple(low)], there[tuple(low)], atol=1e-12)
        near = np.abs(here[tuple(high)]) < 1.5
        np.testing.assert_allclose(here[tuple(high)][near], there[tuple(high)][near], atol=1e-12)
