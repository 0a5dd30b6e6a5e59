# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coupons: one closed body each, of the sizes that are told, with a number that can be read."""

import json

import numpy as np
import pytest
import trimesh

import volfrep
from command import run
from volfrep.design.as_printed import find_printed_table
from volfrep.mesh.booleans import as_manifold

SPEC = volfrep.LatticeSpec(cell="BCC", cell_size=5, strut_radius=0.5, resolution=12)
#: Lit segments of a clock's digits.
LIT = {0: 6, 1: 2, 2: 5, 3: 5, 4: 4, 5: 5, 6: 6, 7: 3, 8: 7, 9: 6}


@pytest.fixture(scope="module")
def coupons():
    return {one.kind: one for one in volfrep.coupons(SPEC, cells=2, first=7)}


@pytest.mark.costly_cases("cube")
@pytest.mark.parametrize("kind", ["cube", "tension", "bending", "ladder"])
def test_a_coupon_is_one_closed_body_on_the_plate(coupons, kind):
    mesh = coupons[kind].mesh
    judged = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert judged.is_watertight
    assert judged.body_count == 1
    assert mesh.bounds[0] == pytest.approx([0, 0, 0], abs=1e-9)
    assert coupons[kind].number == 7 + ["cube", "tension", "bending", "ladder"].index(kind)


def area_at(mesh, z):
    return as_manifold(mesh).slice(z).area()


def test_the_cube_has_plates_that_are_flat_and_whole(coupons):
    cube = coupons["cube"]
    edge, top = 2 * 5 + 2 * 0.5, cube.mesh.bounds[1, 2]
    for z in (0.2, top - 0.2):
        assert area_at(cube.mesh, z) == pytest.approx(edge**2, rel=0.03)
    assert cube.sizes["area"] == 100
    assert top == pytest.approx(cube.sizes["height"] + 2 * 3)
    level = np.abs(cube.mesh.vertices[:, 2] - top) < 1e-9
    assert np.ptp(cube.mesh.vertices[level], axis=0)[:2] == pytest.approx([edge, edge], rel=0.03)


def test_the_ladder_has_struts_of_their_diameter_and_inclination(coupons):
    """A level cut through a strut of an inclination is an ellipse: the section over its sine."""
    ladder = coupons["ladder"]
    upright = sorted(d for angle, d in ladder.struts if angle > 0)
    z = 2.0 + 3.0  # above the plate, below the bridges
    wanted = sum(
        np.pi * d**2 / 4 / np.sin(np.radians(angle)) for angle, d in ladder.struts if angle > 0
    )
    posts = 2 * 3.0 * 2.0 * 5
    assert area_at(ladder.mesh, z) == pytest.approx(wanted + posts, rel=0.01)
    assert len(upright) == 20


@pytest.mark.parametrize("number", [1, 28, 405])
def test_the_number_stands_out_of_the_front(number):
    with_number = volfrep.coupons(SPEC, ["cube"], cells=2, first=number)[0].mesh
    wide, deep, _ = with_number.bounds[1]
    assert deep - wide == pytest.approx(0.4, abs=1e-6)
    # A cut through the relief alone has the strokes that a clock lights.
    front = as_manifold(with_number).rotate((90, 0, 0))
    low, high = front.bounding_box()[2], front.bounding_box()[5]
    strokes = sum(LIT[int(digit)] for digit in str(number))
    area = min(front.slice(z).area() for z in (low + 0.2, high - 0.2))
    assert area == pytest.approx(strokes * (2.2 / 6) * 1.1, rel=0.3)


def test_the_command_fills_a_folder_and_its_table_comes_back(tmp_path, capsys):
    out = tmp_path / "coupons"
    lattice = ("--cell", "BCC", "--cell-size", 5, "--strut-radius", 0.5, "--resolution", 12)
    wanted = ("--kinds", "cube,ladder", "--cells", 2, "--diameters", "0.5,1", "--number", 3)
    assert run("coupon", "-o", out, *lattice, *wanted, "--inclinations", "0,90") == 0
    names = sorted(path.name for path in out.iterdir())
    assert names == ["3_cube.stl", "4_ladder.csv", "4_ladder.stl", "coupons.json"]
    kept = json.loads((out / "coupons.json").read_text())
    assert kept["coupons"][0]["area"] == 100
    table = out / "4_ladder.csv"
    measured = table.read_text().replace("0,0.5,", "0,0.5,0.56").replace("0,1,", "0,1,1.04")
    table.write_text(measured)
    found = find_printed_table(table)
    assert found.printed([0.5, 1.0], [0.0, 0.0]) == pytest.approx([0.56, 1.04])
    assert run("coupon", "-o", out, *lattice, "--kinds", "sphere") == 2
    assert "choose of cube" in capsys.readouterr().err


@pytest.mark.slow
def test_walls_make_coupons_too():
    cube = volfrep.coupons(kinds=["cube"], cells=1, cell="Gyroid", cell_size=8, wall_thickness=1)[0]
    judged = trimesh.Trimesh(cube.mesh.vertices, cube.mesh.triangles, process=False)
    assert judged.is_watertight
    assert judged.body_count == 1
