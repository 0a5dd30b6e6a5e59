# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sizes that a lattice came out with, against closed forms."""

import numpy as np
import pytest

from volfrep.design.cells import find_cell
from volfrep.design.grading import CellMap, Orientation, SizeGrading
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.grid.placement import block_placement, graded_wireframe
from volfrep.grid.size_ranges import mapped_volume, sizes
from volfrep.grid.strut_graph import cell_graph


def sizes_of(shape, active=None, **options):
    spec = LatticeSpec(cell="Box", cell_size=10.0, strut_radius=0.5, **options)
    cells, placement = block_placement(spec.grid, shape)
    active = np.ones(shape, bool) if active is None else active
    graph = cell_graph(find_cell("Box"), active, 10.0, cells.origin, cells.periodic)
    return sizes(
        spec.cell_size,
        cells,
        active,
        placement.mapping,
        graded_wireframe(graph, spec.struts, placement),
    )


def test_equal_cells_are_as_asked_for():
    for orientation in (None, Orientation((1.0, 2.0, 3.0), 40.0)):
        found = sizes_of((2, 3, 1), orientation=orientation)
        assert found.cell_edges == (10.0, 10.0)
        assert found.strut_lengths == pytest.approx((10.0, 10.0))
        assert found.strut_radii == (0.5, 0.5)


def test_cells_that_grow():
    # s (1 + s) takes the four faces to 0, 4/9, 10/9 and 2 of 30 mm.
    found = sizes_of((3, 1, 1), size_grading=SizeGrading(Profile("linear", 1.0, 2.0)))
    assert found.cell_edges == pytest.approx((10.0, 30.0 * 8.0 / 9.0))
    assert found.strut_lengths == pytest.approx(found.cell_edges)


def test_only_active_cells_count():
    active = np.array([True, True, False]).reshape(3, 1, 1)
    found = sizes_of((3, 1, 1), active, size_grading=SizeGrading(Profile("linear", 1.0, 2.0)))
    assert found.cell_edges == pytest.approx((10.0, 30.0 * 6.0 / 9.0))


def test_cells_about_an_axis():
    # Twelve cells of 10 mm: a turn of 120 mm half-way out, chords at 10 mm less and more.
    middle = 120.0 / (2.0 * np.pi)
    chords = 2.0 * np.sin(np.pi / 12.0) * (middle + np.array([-10.0, 10.0]))
    found = sizes_of((2, 12, 1), cell_map=CellMap("cylindrical"))
    assert found.cell_edges == pytest.approx(tuple(chords))
    assert found.strut_lengths == pytest.approx(tuple(chords))


def volume_of(shape, **options):
    spec = LatticeSpec(cell="Box", cell_size=10.0, strut_radius=0.5, **options)
    cells, placement = block_placement(spec.grid, shape)
    return mapped_volume(cells, placement.mapping)


def test_volume_of_a_block_that_grows():
    profile = Profile("quadratic", 1.0, 2.0)
    assert volume_of((3, 1, 2), size_grading=SizeGrading(profile)) == pytest.approx(2.0 * 6000.0)


def test_volume_of_a_ring_and_of_a_shell():
    middle = 120.0 / (2.0 * np.pi)
    ring = np.pi * ((middle + 10.0) ** 2 - (middle - 10.0) ** 2) * 10.0
    assert volume_of((2, 12, 1), cell_map=CellMap("cylindrical")) == pytest.approx(ring)
    inner, outer, reach = middle - 10.0, middle + 10.0, np.sin(2.0 * np.pi / 12.0)
    shell = 4.0 * np.pi / 3.0 * (outer**3 - inner**3) * reach
    found = volume_of((2, 2, 12), cell_map=CellMap("spherical"))
    assert found == pytest.approx(shell, rel=1e-3)
