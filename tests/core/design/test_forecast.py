# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is said before the work against what came out of it."""

import numpy as np
import pytest

import samples
from volfrep.design.cells import LIBRARY, PAPERS
from volfrep.design.forecast import (
    Forecast,
    expected_triangles,
    forecast_block,
    forecast_block_beams,
    forecast_fill,
    forecast_fill_beams,
    narrow_gaps,
    share_deeper,
    skin_bends,
    wall_area,
)
from volfrep.design.grading import CellMap, SizeGrading
from volfrep.design.graphs import RandomGraph
from volfrep.design.kinds.strut_cells import unlike_octants
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.design.tpms.library import SURFACES
from volfrep.jobs.blocks import block
from volfrep.jobs.infill import Infill
from volfrep.jobs.pipeline import fill

#: Promised for triangles, cells and struts: a third to either side, and a little for small parts.
FACTOR = 1.5


def agrees(expected: float, found: float) -> bool:
    return found / FACTOR < expected < found * FACTOR


@pytest.mark.costly
@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", PAPERS)
def test_a_part(cell):
    spec = LatticeSpec(cell=cell, cell_size=6.0, strut_radius=0.6, shell=1.5)
    solid = samples.box((40.0, 30.0, 20.0))
    expected, report = forecast_fill(solid, spec), fill(solid, spec).report
    assert agrees(expected.cells, report.cells_active)
    assert agrees(expected.struts, report.struts)
    assert agrees(expected.triangles, report.triangles)


@pytest.mark.slow_but("BCC-1.0", "Octahedron-0.5", "Box-0.5")
@pytest.mark.parametrize(
    ("cell", "radius"), [*((cell, 0.5) for cell in LIBRARY), *((cell, 1.0) for cell in PAPERS)]
)
def test_a_block(cell, radius):
    spec = LatticeSpec(cell=cell, cell_size=10.0, strut_radius=radius, shell=0.0, resolution=15)
    expected, report = forecast_block(spec, (2, 3, 2)), block(spec, (2, 3, 2)).report
    assert expected.cells == report.cells_active
    assert agrees(expected.struts, report.struts)
    assert agrees(expected.triangles, report.triangles)
    assert expected.stl_mb == pytest.approx(50e-6 * expected.triangles, rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("cell", ["Weaire-Phelan", "Truncated Cuboctahedron", "Kelvin", "Laves"])
def test_a_part_of_cells_with_short_struts(cell):
    spec = LatticeSpec(cell=cell, cell_size=6.0, strut_radius=0.4, shell=1.5, deviation=0.05)
    solid = samples.box((30.0, 20.0, 20.0))
    expected, report = forecast_fill(solid, spec), fill(solid, spec).report
    assert agrees(expected.cells, report.cells_active)
    assert agrees(expected.struts, report.struts)
    assert agrees(expected.triangles, report.triangles)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "around"),
    [
        pytest.param("cylindrical", None, marks=pytest.mark.slow),
        ("cylindrical", 12),
        ("spherical", None),
        ("spherical", 12),
    ],
)
def test_cells_about_an_axis_or_a_centre(kind, around):
    spec = LatticeSpec(
        cell="CVC", cell_size=6.0, strut_radius=0.5, shell=0.0, resolution=12,
        cell_map=CellMap(kind, around=around),
    )  # fmt: skip
    solid = samples.sphere(20.0)
    expected, report = forecast_fill(solid, spec), fill(solid, spec).report
    assert agrees(expected.cells, report.cells_active)
    assert agrees(expected.triangles, report.triangles)


def test_a_surface_bends_along_the_edges_of_a_box_and_all_over_a_ball():
    """By right angles along twelve edges; by 1 / R in two directions on 4 pi R^2."""
    spec = LatticeSpec(shell=2.0)
    box = skin_bends(samples.box((40.0, 30.0, 20.0)), spec)
    ball = skin_bends(samples.sphere(20.0, 4), spec)
    assert box == pytest.approx(4 * 90.0 * np.pi / 2.0 / 2.0)
    assert ball == pytest.approx(8.0 * np.pi * 20.0 / 2.0, rel=0.01)
    assert skin_bends(samples.box(), LatticeSpec(shell=0.0)) == 0.0


def test_a_thin_skin_of_a_sheet_takes_as_long_however_thin_it_is():
    """Its few plane faces are moved; a thicker one is looked for along all edges."""
    sheet = samples.sheet((60.0, 70.0, 3.0))
    thick, thin, thinner = (
        forecast_fill(sheet, LatticeSpec(shell=skin, output="domain")) for skin in (0.3, 0.1, 0.05)
    )
    assert thinner.seconds == pytest.approx(thin.seconds, rel=0.01)
    assert thin.seconds < thick.seconds


def test_what_a_thick_skin_leaves_is_known_of_a_box_and_a_ball():
    box, ball = samples.box((40.0, 30.0, 20.0)), samples.sphere(20.0)
    for depth in (1.0, 4.0, 7.0):
        left = np.prod(np.array([40.0, 30.0, 20.0]) - 2.0 * depth) / 24000.0
        assert share_deeper(box, depth) == pytest.approx(left, abs=0.02)
        assert share_deeper(ball, depth) == pytest.approx((1.0 - depth / 20.0) ** 3, abs=0.02)
    assert 0.0 < share_deeper(box, 11.0) < 0.002


@pytest.mark.parametrize("depth", [1.0, 3.0, 8.0])
def test_the_wall_within_a_skin_is_smaller_than_the_surface_of_a_box_and_a_ball(depth):
    a, b, c = np.array([40.0, 30.0, 20.0]) - 2.0 * depth
    found = wall_area(samples.box((40.0, 30.0, 20.0)), depth)
    assert found == pytest.approx(2.0 * (a * b + a * c + b * c), rel=0.1)
    found = wall_area(samples.sphere(20.0), depth)
    assert found == pytest.approx(4.0 * np.pi * (20.0 - depth) ** 2, rel=0.1)


@pytest.mark.costly
def test_a_lattice_under_a_thick_skin_has_the_triangles_that_are_told():
    spec = LatticeSpec("CVC", cell_size=4.0, strut_radius=0.4, shell=6.0)
    solid = samples.box((40.0, 30.0, 20.0))
    assert agrees(forecast_fill(solid, spec).triangles, fill(solid, spec).report.triangles)


def test_rooms_between_two_skins_are_narrow_in_a_plate_little_thicker_than_both():
    """Above and below, room of a fifth of the skin: 5 x 5 cubes on each square of the skin."""
    spec = LatticeSpec(shell=2.0)
    narrow = narrow_gaps(samples.box((60.0, 50.0, 4.4)), spec)
    assert narrow == pytest.approx(2 * 60.0 * 50.0 / 2.0**2 * (5.0**2 - 1.0), rel=0.02)
    assert narrow_gaps(samples.box((60.0, 50.0, 3.9)), spec) == 0.0, "solid"
    assert narrow_gaps(samples.box((60.0, 50.0, 6.1)), spec) == 0.0, "wide"
    assert narrow_gaps(samples.box((60.0, 50.0, 4.4)), LatticeSpec(shell=0.0)) == 0.0
    wide, tight = (forecast_fill(samples.box((60.0, 50.0, z)), spec) for z in (6.1, 4.4))
    assert tight.seconds > wide.seconds + 1.0


def test_a_thin_skin_of_a_flat_sheet_is_no_long_job():
    """190 x 279 x 3 with two holes, a skin of 0.15: found in 1.6 CPU s and 0.17 GB."""
    spec = LatticeSpec(cell_size=50.0, strut_radius=0.5, shell=0.15, output="domain")
    expected = forecast_fill(samples.sheet((190.0, 279.0, 3.0)), spec)
    assert 0.8 < expected.seconds < 3.2
    assert 0.085 < expected.memory_gb < 0.34


@pytest.mark.parametrize(("cell", "made"), [("CVC", 53_478), ("Octet", 121_678)])
def test_cells_far_larger_than_a_sheet_is_thick_leave_few_triangles(cell, made):
    """L 50 in 3 mm: as many on the wall as the seam has, where a million were told."""
    spec = LatticeSpec(cell, cell_size=50.0, strut_radius=0.5, shell=0.15)
    assert agrees(forecast_fill(samples.sheet((190.0, 279.0, 3.0)), spec).triangles, made)


def test_a_file_of_walls_holds_what_the_cut_leaves_and_a_mesh_all_of_them():
    """4.1 million triangles: a fill peaked at 0.29 GB, and at 0.45 where its mesh was wanted."""
    spec = LatticeSpec(SURFACES["Gyroid"], cell_size=8.0, shell=2.0)
    solid = samples.box((80.0, 60.0, 40.0))
    assert agrees(forecast_fill(solid, spec, streamed=True).memory_gb, 0.29)
    assert 0.45 < forecast_fill(solid, spec).memory_gb < 0.9


@pytest.mark.slow
def test_cells_that_grow_are_fewer():
    spec = LatticeSpec(
        cell="CVC", cell_size=5.0, strut_radius=0.5, shell=0.0,
        size_grading=SizeGrading(Profile("linear", 1.0, 2.0)),
    )  # fmt: skip
    solid = samples.sphere(30.0)
    expected, report = forecast_fill(solid, spec), fill(solid, spec).report
    assert agrees(expected.cells, report.cells_active)
    assert agrees(expected.triangles, report.triangles)


def test_finer_facets_grow_with_the_square():
    coarse, fine = (LatticeSpec(cell="BCC", resolution=n) for n in (20, 40))
    assert expected_triangles(fine, 1e6) == pytest.approx(4 * expected_triangles(coarse, 1e6))


def test_memory_and_time_rise_with_the_job():
    spec = LatticeSpec(cell="BCC", cell_size=5.0, strut_radius=0.5)
    sizes = [samples.box((side, side, side)) for side in (20.0, 40.0, 80.0)]
    jobs = [forecast_fill(solid, spec) for solid in sizes]
    for value in ("cells", "struts", "triangles", "memory_gb", "stl_mb", "seconds"):
        assert np.all(np.diff([getattr(job, value) for job in jobs]) > 0)


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.1, "1 s"), (12.4, "12 s"), (600.0, "10 min"), (7300.0, "2 h")]
)
def test_it_reads_as_a_sentence(seconds, words):
    text = str(Forecast(1234, 9876, 1_234_567, 1.26, 61.7, seconds))
    assert text == (
        "about 1,200 cells, 9,900 struts, 1,200,000 triangles, 1.3 GB of memory, an STL file of "
        f"62 MB and {words}"
    )


@pytest.mark.parametrize("kind", ["voronoi", "delaunay"])
def test_a_random_graph_has_the_struts_that_the_surface_cuts_too(kind):
    solid = samples.box((24.0, 12.0, 12.0))
    spec = LatticeSpec(network=RandomGraph(kind), cell_size=4, strut_radius=0.3, shell=0)
    struts = len(Infill(solid, spec).struts.struts)
    assert forecast_fill(solid, spec).struts == pytest.approx(struts, rel=0.15)


def test_cells_without_mirrors_are_told_to_take_longer_where_each_octant_is_another():
    told = {
        name: forecast_block(LatticeSpec(name, cell_size=10.0, strut_radius=0.45), (3, 3, 3))
        for name in ("Octet", "Kagome", "Laves")
    }
    assert told["Kagome"].seconds > 4.0 * told["Octet"].seconds, "14 CPU s and 1.4"
    assert unlike_octants(LIBRARY["Octet"], 8.0) == 1 / 8
    assert unlike_octants(LIBRARY["Laves"], 8.0) > 2.0


def test_a_million_cells_as_beams_are_told_within_a_half():
    """Taken: a block 11 CPU s, 0.76 GB and 40.5 MB; a ball with a skin 42 s, 1.58 GB, 45.7 MB."""
    spec = LatticeSpec(cell="BCC", cell_size=1.0, strut_radius=0.1, shell=1.0)
    block_told = forecast_block_beams(spec, (100, 100, 100))
    assert block_told.struts == pytest.approx(11_060_300, rel=0.01), "(8 + 3) of each, and outside"
    part_told = forecast_fill_beams(samples.sphere(62.0, 4), spec)
    for told, taken in (
        (block_told, (10.8, 0.76, 40.5)),
        (part_told, (41.6, 1.58, 45.7)),
    ):
        for value, found in zip((told.seconds, told.memory_gb, told.file_mb), taken, strict=True):
            assert agrees(value, found)
    assert str(block_told).endswith("0.76 GB of memory, a 3MF file of 46 MB and 12 s")


def test_octants_that_the_wall_does_not_come_near_take_little_time():
    """125,000 cells under a skin, 63 million triangles: 40 CPU s; five minutes were told."""
    spec = LatticeSpec(cell="Box", cell_size=2.0, strut_radius=0.2, shell=1.0, resolution=10)
    told = forecast_fill(samples.box((100.0, 100.0, 100.0)), spec, streamed=True)
    assert agrees(told.seconds, 39.8)
    assert agrees(told.triangles, 62_790_392)


def test_a_plate_whose_walls_touch_flat_struts_takes_as_long_as_told():
    """18.9 s of a processor; 3.66 million triangles."""
    spec = LatticeSpec("FCC", cell_size=2.0, strut_radius=0.2, shell=0.2)
    told = forecast_fill(samples.box((40.0, 40.0, 6.4)), spec, streamed=True)
    assert agrees(told.seconds, 18.9)
    assert agrees(told.triangles, 3_660_502)
