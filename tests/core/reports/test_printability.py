# SPDX-License-Identifier: LGPL-2.1-or-later
"""The print report, against closed forms."""

import json

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec, VolfrepError
from volfrep.grid.inclination import inclinations, unit_direction
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.beam_part import block_beams
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.reports.printability import overhanging_facets, print_report
from volfrep.reports.processes import PROCESSES, Process, find_process

UP = np.array([0.0, 0.0, 1.0])
FFF, SLS, LPBF = (PROCESSES[name] for name in ("FFF", "SLS", "LPBF"))
EASY = Process("easy", "anything goes", 0.0, 0.0, 0.0, 0.0, None, None, "nobody")
NOTHING = Wireframe(np.zeros((0, 3)), np.zeros((0, 2), np.int32), np.zeros((0, 2)), np.zeros(0))


def cells(cell, count=(1, 1, 1), **values):
    return block_beams(LatticeSpec(cell=cell, **values), count).lattice


def test_inclinations_of_known_cells():
    box = inclinations(cells("Box"), UP)
    assert sorted(np.round(box)) == [0] * 8 + [90] * 4
    diagonal = np.degrees(np.arcsin(1 / np.sqrt(3)))
    np.testing.assert_allclose(inclinations(cells("CVC"), UP), diagonal)
    # Along a diagonal one of the four stands upright, and the others lie at asin(1/3).
    along = np.sort(inclinations(cells("CVC"), unit_direction((1, 1, 1))))
    np.testing.assert_allclose(along[:6], np.degrees(np.arcsin(1 / 3)))
    np.testing.assert_allclose(along[6:], 90, atol=1e-5)


def test_overhang_of_a_ball_is_its_cap():
    ball = samples.sphere(10.0, 5)
    for limit in (30.0, 45.0, 60.0):
        facing = overhanging_facets(ball, UP, limit)
        area = TriangleMesh(ball.vertices, ball.triangles[facing]).area
        cap = 2 * np.pi * 10**2 * (1 - np.cos(np.radians(limit)))
        assert area == pytest.approx(cap, rel=0.03)
    assert not overhanging_facets(ball, UP, 0.0).any()


def test_what_lies_on_the_build_plate_does_not_hang():
    bracket = samples.bracket(90.0)  # an L standing on its long arm
    sides = {}
    for direction in ((0, 0, 1), (0, 0, -1), (1, 0, 0), (-1, 0, 0)):
        facing = overhanging_facets(bracket, unit_direction(direction), 45.0)
        sides[direction] = TriangleMesh(bracket.vertices, bracket.triangles[facing]).area
    # Standing on an arm's long side nothing hangs; upside down its other arm does not reach.
    assert sides[(0, 0, 1)] == 0
    assert sides[(0, 0, -1)] == pytest.approx(40 * 30)
    assert sides[(1, 0, 0)] == 0
    assert sides[(-1, 0, 0)] == pytest.approx(40 * 30)


def test_a_facet_of_just_the_limit_does_not_hang():
    roof = samples.box((10.0, 10.0, 10.0))
    turn = np.radians(45.0)
    matrix = np.array(
        [[1, 0, 0], [0, np.cos(turn), -np.sin(turn)], [0, np.sin(turn), np.cos(turn)]]
    )
    roof = TriangleMesh(roof.vertices @ matrix.T, roof.triangles)
    assert not overhanging_facets(roof, UP, 45.0).any()
    assert overhanging_facets(roof, UP, 46.0).sum() == 4


def test_a_block_of_boxes():
    spec = LatticeSpec(cell="Box", cell_size=10, strut_radius=0.5, density=8)
    made = block(spec, (2, 1, 1))
    report = print_report(made.mesh, made.wireframe, LPBF, density=8)
    assert report.struts == 20
    assert report.strut_length_mm == pytest.approx(200)
    assert report.thinnest_strut_mm == pytest.approx(1.0)
    assert report.narrowest_gap_mm is None
    assert report.inclinations == pytest.approx((14 / 20, 0, 0, 0, 0, 6 / 20))
    assert report.overhanging_share == pytest.approx(14 / 20)
    assert report.longest_overhang_mm == report.longest_bridge_mm == pytest.approx(10)
    assert (report.voids, report.void_volume_mm3) == (0, 0)
    assert report.volume_mm3 == pytest.approx(made.report.volume_mm3)
    assert report.area_mm2 == pytest.approx(made.report.area_mm2)
    assert report.mass_g == pytest.approx(made.report.mass_g)
    hang, bridge = report.findings
    assert hang.startswith("70 % of the struts' length is less than 45 degrees")
    assert "up to 10 mm" in bridge
    # Underneath a round strut a quarter of its surface is below 45 degrees.
    lower_half = report.overhang_area_mm2 / (14 * np.pi * 1.0 * 10)
    assert lower_half == pytest.approx(0.25, abs=0.06)


def test_flat_struts_hang_over_from_where_they_are_too_long_to_bridge():
    """Those of LPBF's 2 mm; struts at 35 degrees grow in the air, whatever their length."""
    for size, share in ((2.0, 0.0), (2.1, 8 / 12)):
        report = print_report(
            samples.sphere(), cells("Box", cell_size=size, strut_radius=0.3), LPBF
        )
        assert report.overhanging_share == pytest.approx(share)
        assert report.longest_bridge_mm == pytest.approx(size)
    steep = cells("CVC", cell_size=2, strut_radius=0.3)
    assert print_report(samples.sphere(), steep, LPBF).overhanging_share == 1.0


def test_powder_carries_overhangs_and_is_trapped():
    made = fill(samples.box((30, 30, 30)), LatticeSpec(cell="Box", cell_size=10, shell=2))
    domain = samples.box((26, 26, 26), (2, 2, 2))
    report = print_report(made.mesh, made.wireframe, SLS, domain=domain)
    assert report.overhanging_share == 0
    assert report.overhang_area_mm2 == 0
    assert report.voids == 1
    assert report.void_volume_mm3 == pytest.approx(30**3 - made.report.volume_mm3, rel=1e-6)
    (finding,) = report.findings
    assert "1 closed void holds" in finding
    assert "5 mm or more" in finding
    # A filament printer leaves nothing in a void.
    assert not any("void" in said for said in print_report(made.mesh, NOTHING, FFF).findings)


def test_only_what_lies_in_the_domain_counts():
    lattice = cells("Box", (3, 3, 3), cell_size=10)
    domain = samples.box((26, 26, 26), (2, 2, 2))
    report = print_report(domain, lattice, EASY, domain=domain)
    assert report.struts == 3 * 2 * 2 * 3
    assert report.strut_length_mm == pytest.approx(3 * 4 * 26, rel=0.05)  # in eighths of a strut


def test_the_thinnest_place_of_a_cone_in_the_part():
    nodes = np.array([[0, 0, 0], [16, 0, 0]], float)
    cone = Wireframe(nodes, np.array([[0, 1]], np.int32), np.array([[1.0, 0.2]]), np.ones(2))
    whole = print_report(samples.sphere(), cone, FFF)
    assert whole.thinnest_strut_mm == pytest.approx(0.4, abs=0.1)
    assert whole.thinnest_at == (15.0, 0.0, 0.0)
    half = samples.box((16, 10, 10), (-8.0, -5.0, -5.0))
    inside = print_report(half, cone, FFF, domain=half)
    assert inside.thinnest_strut_mm == pytest.approx(1.2, abs=0.1)
    assert "down to" in inside.findings[0]


def test_narrow_gaps_are_found():
    nodes = np.array([[-5, 0, 0], [5, 0, 0], [0, -5, 2.4], [0, 5, 2.4]], float)
    struts = np.array([[0, 1], [2, 3]], np.int32)
    pair = Wireframe(nodes, struts, np.ones((2, 2)), np.ones(4))
    report = print_report(samples.sphere(), pair, FFF)
    assert report.narrowest_gap_mm == pytest.approx(0.4)
    assert any("only 0.4 mm apart near (0, 0, 1.2)" in said for said in report.findings)


def test_a_part_without_struts():
    report = print_report(samples.box(), NOTHING, LPBF)
    assert (report.struts, report.thinnest_strut_mm, report.overhanging_share) == (0, None, 0)
    assert report.findings == ()
    assert "none" in report.to_text()


def test_text_and_json_say_the_same():
    hollow = concatenate(samples.box((30, 30, 30)), samples.box((20, 20, 20), (5, 5, 5)).reversed())
    report = print_report(hollow, cells("CVC"), LPBF, build_direction=(0, 0, 5))
    figures = json.loads(report.to_json())
    assert figures["process"]["name"] == "LPBF"
    assert figures["build_direction"] == [0, 0, 1]
    assert figures["void_volume_mm3"] == pytest.approx(8000)
    rows = dict(report.rows())
    assert rows["closed voids"] == "1, holding 8,000.0 mm3"
    assert rows["below 45 degrees"].startswith("100.0 %")
    assert rows["limits from"] == LPBF.source
    for finding in report.findings:
        assert finding in report.to_text()
    assert len(report.findings) == 2


def test_processes_are_found_by_name():
    assert find_process("lpbf") is LPBF
    assert set(PROCESSES) == {"FFF", "SLA", "SLS", "MJF", "LPBF", "EBM"}
    with pytest.raises(VolfrepError, match="no process 'CNC': choose one of FFF, SLA, SLS, MJF"):
        find_process("CNC")
    for process in PROCESSES.values():
        assert process.source
        assert process.strut > 0
        assert process.gap > 0


@pytest.mark.parametrize("direction", [(0, 0, 0), (0, 0, np.nan), (0, np.inf, 1)])
def test_no_direction(direction):
    with pytest.raises(VolfrepError, match="build direction must be"):
        unit_direction(direction)
