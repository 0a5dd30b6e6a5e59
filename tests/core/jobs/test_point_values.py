# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a part is coloured by, held against closed forms and against every strut looked at."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.grading import CellMap
from volfrep.jobs.figures.point_values import (
    overhang,
    point_values,
    values_in_space,
    values_on_struts,
)
from volfrep.jobs.infill import Infill
from volfrep.jobs.pipeline import fill
from volfrep.spatial.nearest_struts import NearestStrut

SOLID = samples.box((24.0, 16.0, 16.0))


def test_the_nearest_strut_is_the_nearest_of_all():
    random = np.random.default_rng(5)
    start = random.uniform(0.0, 10.0, (200, 3))
    ends = np.stack([start, start + random.normal(0.0, 1.5, (200, 3))], axis=1)
    points = random.uniform(0.0, 10.0, (500, 3))
    along = ends[:, 1] - ends[:, 0]
    share = np.clip(
        ((points[:, None] - start) * along).sum(axis=2) / (along**2).sum(axis=1), 0.0, 1.0
    )
    away = np.linalg.norm(start + share[..., None] * along - points[:, None], axis=2)
    strut, found = NearestStrut(ends).of(points)
    rows = np.arange(len(points))
    assert (away[rows, strut] <= away.min(axis=1) + 0.3).all()
    nearest = strut == away.argmin(axis=1)
    assert nearest.mean() > 0.95
    assert found[nearest] == pytest.approx(share[rows, strut][nearest])


def test_the_lattices_own_radius_is_that_of_its_surface():
    spec = LatticeSpec(cell="Box", cell_size=8, strut_radius=0.8, output="lattice")
    mesh = fill(SOLID, spec).mesh
    found = point_values(SOLID, spec, "Radius", mesh.vertices, mesh.vertices)
    assert found.values == pytest.approx(0.8, rel=1e-6)
    frame = Infill(SOLID, spec).struts
    ends = frame.nodes[frame.struts]
    strut, share = NearestStrut(ends).of(mesh.vertices)
    foot = ends[strut, 0] + share[:, None] * (ends[strut, 1] - ends[strut, 0])
    # No vertex is farther from the axis than the joint's sphere, nor much nearer than the strut.
    away = np.linalg.norm(mesh.vertices - foot, axis=1)
    assert away.max() < 1.1 * 0.8 * 1.05


def test_cells_of_a_grid_have_its_size():
    spec = LatticeSpec(cell="BCC", cell_size=8, strut_radius=0.8)
    assert values_in_space(SOLID, spec, "Cell size", SOLID.vertices) == pytest.approx(8.0)


def test_cells_about_an_axis_grow_with_the_distance_from_it():
    spec = LatticeSpec(
        cell="BCC",
        cell_size=4,
        strut_radius=0.4,
        cell_map=CellMap("cylindrical", (0, 0, 0), around=12),
    )
    points = np.array([[6.0, 0.0, 8.0], [12.0, 0.0, 8.0]])
    near, far = values_in_space(SOLID, spec, "Cell size", points) ** 3
    assert far / near == pytest.approx(2.0, rel=1e-3)


def test_overhangs_are_angles_to_the_plate():
    turns = np.radians([0.0, 30.0, 45.0, 90.0])
    down = np.stack([np.sin(turns), 0 * turns, -np.cos(turns)], axis=1)
    assert overhang(down, (0, 0, 2)) == pytest.approx([0.0, 30.0, 45.0, 90.0])
    assert overhang(-down, (0, 0, 2)) == pytest.approx(90.0)
    found = point_values(SOLID, LatticeSpec(), "Overhang", down, down)
    assert (found.low, found.high) == (0.0, 90.0)


def test_what_is_known_of_struts_is_known_along_them():
    ends = np.array([[[0.0, 0, 0], [10, 0, 0]], [[0, 0, 0], [0, 10, 0]]])
    values = np.array([[1.0, 3.0], [50.0, 70.0]])
    start, end = np.array([[10.0, 0, 0], [0, 2, 0]]), np.array([[4.0, 0, 0], [0, 12, 0]])
    found = values_on_struts(start, end, ends, values)
    assert found == pytest.approx(np.array([[3.0, 1.8], [54.0, 70.0]]))
    points = np.array([[5.0, 0.5, 0.0], [0.3, 5.0, 0.0]])
    told = point_values(SOLID, LatticeSpec(), "Stress", points, points, carried=(ends, values))
    assert told.values == pytest.approx([2.0, 60.0])
    assert (told.low, told.high) == (0.0, 70.0)


def test_what_governs_is_that_of_the_nearest_strut_and_place_of_the_skin():
    ends = np.array([[[0.0, 0, 0], [10, 0, 0]], [[0, 0, 0], [0, 10, 0]]])
    rows, points = np.array([[2.0, 2.0], [1.0, 1.0]]), np.array([[5.0, 0.5, 0.0], [0.3, 5.0, 0.0]])
    told = point_values(
        SOLID, LatticeSpec(), "Governing limit", points, points, carried=(ends, rows)
    )
    assert told.values.tolist() == [2.0, 1.0]
    places = np.array([[0.0, 8.0, 0.0], [9.0, 0.0, 0.0]])
    told = point_values(
        SOLID, LatticeSpec(), "Governing limit of the skin", points, points,
        carried=(places, np.array([3.0, 0.0])),
    )  # fmt: skip
    assert told.values.tolist() == [0.0, 3.0]


def test_what_there_is_not_is_said():
    points = SOLID.vertices
    with pytest.raises(VolfrepError, match="no quantity 'Colour'"):
        point_values(SOLID, LatticeSpec(), "Colour", points, points)
    with pytest.raises(VolfrepError, match="needs loads"):
        point_values(SOLID, LatticeSpec(), "Stress", points, points)
    with pytest.raises(VolfrepError, match="of a sized part only"):
        point_values(SOLID, LatticeSpec(), "Governing limit", points, points)
    with pytest.raises(VolfrepError, match="No field drives"):
        point_values(SOLID, LatticeSpec(), "Field", points, points)
