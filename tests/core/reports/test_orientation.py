# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which way a part is built best, where everybody knows it."""

import json

import numpy as np
import pytest
import trimesh
from manifold3d import CrossSection, Manifold

from command import run
from volfrep.mesh.booleans import as_mesh
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.reports.orientation import Orientations, orient
from volfrep.reports.printability import overhanging_facets
from volfrep.util.linalg import rotation


def turned(solid, axis=(1.0, 2.0, 0.5), angle=0.7):
    mesh = as_mesh(solid)
    turn = rotation(np.array(axis, float), angle)
    return TriangleMesh(mesh.vertices @ turn.T, mesh.triangles), turn


def up_of(found: Orientations, turn):
    """The best direction in the coordinates that the part was drawn in."""
    return np.round(turn.T @ np.array(found.best[0].up), 6)


def test_a_cone_stands_on_its_base_however_it_came():
    mesh, turn = turned(Manifold.cylinder(12.0, 10.0, 0.001, 64))
    found = orient(mesh)
    assert up_of(found, turn) == pytest.approx([0, 0, 1], abs=1e-6)
    best = found.best[0]
    assert best.overhang_mm2 == 0.0
    assert best.base_mm2 == pytest.approx(32 * 100 * np.sin(np.pi / 32), rel=1e-3)
    assert best.height_mm == pytest.approx(12.0, rel=1e-6)
    stands = found.turned()
    assert stands.bounds[0][2] == 0.0
    assert stands.volume == pytest.approx(mesh.volume)


def test_an_angle_lies_on_its_side_where_nothing_hangs_over_and_it_is_lowest():
    """Upright it needs no support either, but is 30 mm high; on a leg's end a leg hangs over."""
    outline = CrossSection([[[0, 0], [30, 0], [30, 4], [4, 4], [4, 30], [0, 30]]])
    mesh, turn = turned(Manifold.extrude(outline, 12.0))
    found = orient(mesh)
    best = found.best[0]
    assert np.abs(up_of(found, turn)) == pytest.approx([0, 0, 1], abs=1e-6)
    assert (best.overhang_mm2, best.support_mm3) == (0.0, 0.0)
    assert best.height_mm == pytest.approx(12.0)
    upright = next(one for one in found.best if one.height_mm == pytest.approx(30.0))
    assert upright.overhang_mm2 == 0.0


def test_a_t_stands_on_its_head():
    bar = Manifold.cube((30.0, 30.0, 4.0)).translate((-15.0, -15.0, 40.0))
    found = orient(as_mesh(bar + Manifold.cube((8.0, 8.0, 40.0)).translate((-4.0, -4.0, 0.0))))
    assert found.best[0].up == pytest.approx((0, 0, -1), abs=1e-9)
    assert found.as_it_is.overhang_mm2 == pytest.approx(30 * 30 - 8 * 8)
    assert found.as_it_is.support_mm3 == pytest.approx((30 * 30 - 8 * 8) * 40)


def test_directions_are_told_in_the_order_of_the_cost_that_is_told():
    """Of a ball on a foot overhang and cost rank them differently."""
    foot = Manifold.cube((8.0, 8.0, 40.0)).rotate((0.0, 20.0, 0.0))
    found = orient(as_mesh(Manifold.sphere(10.0, 24) + foot))
    areas = [one.overhang_mm2 for one in found.best]
    assert areas != sorted(areas)
    told = [text for _, text in found.rows() if text.startswith("cost ")][1:]
    assert len(told) == 5
    assert told == sorted(told, key=lambda text: float(text.split()[1].strip(",")))


def test_of_equal_directions_the_one_that_turns_least_is_taken():
    cube = orient(as_mesh(Manifold.cube((10.0, 10.0, 10.0))))
    assert cube.best[0].angle == 0.0
    assert cube.best[0].rotation == ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    assert cube.as_dict() == orient(as_mesh(Manifold.cube((10.0, 10.0, 10.0)))).as_dict()


def test_a_closed_room_is_built_so_that_its_ceiling_needs_no_support():
    """A box with a room like a roof: all sides are alike, and one of them makes no ceiling."""
    outline = CrossSection([[[-9, 0], [9, 0], [0, 11]]])
    room = Manifold.extrude(outline, 18.0).translate((0.0, 0.0, -9.0)).rotate((90, 0, 0))
    box = Manifold.cube((30.0, 30.0, 30.0)).translate((-15.0, -15.0, -8.0))
    mesh, turn = turned(box - room)
    found = orient(mesh, best=100)
    ceilings = {tuple(np.round(turn.T @ np.array(o.up), 3).tolist()): o for o in found.best}
    assert up_of(found, turn) == pytest.approx([0, 0, 1], abs=1e-5)
    assert found.best[0].inside_mm2 == 0.0
    assert ceilings[0.0, 0.0, -1.0].inside_mm2 == pytest.approx(18.0 * 18.0, rel=1e-3)


def test_the_overhang_is_the_print_reports():
    mesh, _ = turned(Manifold.sphere(10.0, 48) + Manifold.cube((20.0, 6.0, 6.0)))
    for one in orient(mesh, 40.0).best:
        hanging = overhanging_facets(mesh, np.array(one.up), 40.0)
        area = TriangleMesh(mesh.vertices, mesh.triangles[hanging]).area
        assert one.overhang_mm2 == pytest.approx(area, rel=1e-6, abs=1e-9)
        assert np.array(one.rotation) @ np.array(one.up) == pytest.approx([0, 0, 1], abs=1e-9)


def test_the_command_tells_the_best_and_writes_the_turned_part(tmp_path, capsys):
    part, out, report = (tmp_path / name for name in ("t.stl", "turned.stl", "r.json"))
    trimesh.creation.box((10, 40, 20)).export(part)
    assert run("orient", part, "-o", out, "--report", report, "--process", "FFF") == 0
    assert "as it is" in capsys.readouterr().out
    assert np.ptp(trimesh.load(out).bounds, axis=0)[2] == pytest.approx(10.0)
    told = json.loads(report.read_text(encoding="utf-8"))
    assert told["best"][0]["height_mm"] == pytest.approx(10.0)
    assert told["inclination"] == 45.0
    assert run("orient", part, "--process", "FFF", "--inclination", 30) == 2
    assert "give one of the two" in capsys.readouterr().err
    assert run("orient", part, "--take", 9) == 2
