# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces without thickness: their area by quadrature, their open edges on the part's wall."""

import zipfile

import numpy as np
import pytest
import trimesh
from skimage.measure import marching_cubes, mesh_surface_area

import samples
import slicers
import volfrep
from command import run
from volfrep.io.write.stl import write_stl

FORMULAS = {
    "Schwarz P": lambda x, y, z: np.cos(x) + np.cos(y) + np.cos(z),
    "Gyroid": lambda x, y, z: np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x),
}
CELL, BOX = 10.0, (10.0, 10.0, 10.0)


def area_of_period(formula):
    """Over L2: marching cubes at two steps, whose error falls by the square of the step."""

    def at(count):
        # Off the symmetric places, where whole faces of cubes are zero.
        steps = 2.0 * np.pi * (np.arange(count + 1) + 0.137) / count
        values = formula(*np.meshgrid(steps, steps, steps, indexing="ij"))
        points, triangles, _, _ = marching_cubes(values, 0.0)
        return mesh_surface_area(points / count, triangles)

    fine, coarse = at(64), at(32)
    return fine + (fine - coarse) / 3.0


def open_edges(mesh):
    edges = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    pairs, uses = np.unique(edges, axis=0, return_counts=True)
    assert uses.max() == 2
    return mesh.vertices[pairs[uses == 1]]


@pytest.mark.parametrize("cell", FORMULAS)
def test_area_is_that_of_whole_periods_and_edges_are_open_on_the_wall_alone(cell):
    made = volfrep.bare_surface(samples.box(BOX), cell=cell, cell_size=CELL, shell=0)
    periods = np.prod(BOX) / CELL**3
    assert made.area == pytest.approx(area_of_period(FORMULAS[cell]) * periods * CELL**2, rel=3e-3)
    ends = open_edges(made.mesh)
    box = np.array(BOX)
    off = np.minimum(np.abs(ends), np.abs(ends - box)).min(axis=2)
    assert off.max() < 1e-5
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
    assert made.rim == pytest.approx(length, rel=1e-9)
    # What lies off the wall is on the surface.
    points = made.mesh.vertices
    inner = np.minimum(points, box - points).min(axis=1) > 1e-3
    assert inner.sum() > 1000
    assert np.abs(FORMULAS[cell](*(2 * np.pi * points[inner] / CELL).T)).max() < 0.05


def test_the_rim_lies_on_a_balls_wall_and_within_it():
    ball = trimesh.creation.icosphere(3, 8.0)
    made = volfrep.bare_surface(ball, cell="Gyroid", cell_size=8, shell=0, rotate=(1, 2, 3, 30))
    ends = open_edges(made.mesh).reshape(-1, 3)
    normals, middles = ball.face_normals, ball.triangles_center
    # A ball is where all planes of its facets have it: the farthest beyond any of them is 0 on it.
    beyond = np.max([((p - middles) * normals).sum(axis=1).max() for p in ends[::7]])
    within = np.min([((p - middles) * normals).sum(axis=1).max() for p in ends[::7]])
    assert -1e-5 < within <= beyond < 1e-5
    inner = made.mesh.vertices[::50]
    assert max(((p - middles) * normals).sum(axis=1).max() for p in inner) < 1e-5


@pytest.mark.slow
@pytest.mark.skipif(slicers.cura_resources() is None, reason="needs CuraEngine")
def test_cura_lays_one_line_along_the_surface(tmp_path, monkeypatch):
    """A layer's lines are as long as its section: the surface's area by its angle to the layer."""
    monkeypatch.setitem(slicers._CURA, "magic_mesh_surface_mode", "surface")
    made = volfrep.bare_surface(samples.box((20, 20, 20)), cell="Gyroid", cell_size=10, shell=0)
    made.save(tmp_path / "surface.stl")
    one, two, three = made.mesh.corners()
    normal = np.cross(two - one, three - one) / 2.0
    section = np.linalg.norm(normal[:, :2], axis=1).sum()
    laid = slicers.cura_volume(tmp_path / "surface.stl")
    assert laid == pytest.approx(section * slicers.WIDTH, rel=0.01)


@pytest.mark.slow
def test_the_command_writes_it_and_tells_the_area(tmp_path, capsys):
    solid = tmp_path / "solid.stl"
    write_stl(samples.box((10, 10, 10)), solid)
    lattice = ("--cell", "Gyroid", "--cell-size", 5, "--shell", 1, "--bare-surface")
    for suffix in ("stl", "3mf"):
        out = tmp_path / f"out.{suffix}"
        assert run("fill", solid, "-o", out, *lattice, "--make", "lattice") == 0
        assert "mm2, open along" in capsys.readouterr().out
        read = trimesh.load(out, force="mesh")
        assert not read.is_watertight
        # The inside of the skin.
        assert np.abs(read.bounds - [[1, 1, 1], [9, 9, 9]]).max() < 0.05
    with zipfile.ZipFile(out) as package:
        assert b'type="surface"' in package.read("3D/3dmodel.model")[:3000]
    assert run("fill", solid, "-o", out, *lattice) == 2
    assert "joined to no skin" in capsys.readouterr().err
    for wrong in (("-o", "out.step"), ("-o", "out.stl", "--max-size", 5)):
        assert run("fill", solid, *wrong, *lattice) == 2
        assert "open" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        ({"cell": "BCC", "strut_radius": 1}, "Only sheets along a TPMS"),
        ({"shell": 1}, "joined to no skin"),
        ({"wall_kind": "skeleton"}, "has no sheets"),
        ({"relative_density": 0.2}, "has no thickness"),
        ({"radius_grading": "skin", "radius_start": 1}, "has no thickness"),
    ],
)
def test_what_has_no_bare_surface_is_refused(wanted, said):
    asked = {"cell": "Gyroid", "shell": 0, **wanted}
    with pytest.raises(volfrep.VolfrepError, match=said):
        volfrep.bare_surface(samples.box(BOX), cell_size=CELL, **asked)
