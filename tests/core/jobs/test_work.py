# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much work a job is, counted: what makes the engine fast stays so on any machine."""

import tracemalloc
from functools import lru_cache

import pytest

from samples import box
from volfrep import LatticeSpec, StageCache
from volfrep.design.cells import PAPERS
from volfrep.jobs.blocks import block, write_block_stl
from volfrep.jobs.infill import Infill
from volfrep.jobs.pipeline import fill
from volfrep.util.errors import VolfrepError

SPEC = LatticeSpec("CVC", 5.0, 0.5, shell=1.0, resolution=8)


@lru_cache
def cube(cells):
    """The report of a cube of so many cells along each axis, cut off the grid."""
    spec = LatticeSpec("CVC", 5.0, 0.5, shell=0.0, resolution=8, origin=(2.2, 2.2, 2.2))
    return fill(box((5.0 * cells,) * 3), spec).report


@pytest.mark.slow_but("BCC")
@pytest.mark.parametrize("cell", PAPERS)
def test_a_block_takes_eight_kinds_of_octants_however_large_it_is(cell):
    """Of 27 patterns of neighbours: struts that end in a joint do not show beyond it."""
    spec = LatticeSpec(cell, 10.0, 1.0, resolution=8)
    for count in (3, 5):
        report = block(spec, (count,) * 3).report
        assert report.work["kinds of octants meshed"] <= 8
        assert report.work["triangles laid"] == report.triangles


def test_more_cells_than_fit_are_refused_before_the_skin_is_made():
    infill = Infill(box((5000.0, 5000.0, 5000.0)), LatticeSpec("CVC", 2.0, 0.2, shell=1000.0))
    for asked in ("part", "struts"):
        with pytest.raises(VolfrepError, match="enlarge the cells"):
            getattr(infill, asked)
    assert "walls found" not in infill.monitor.work


def test_a_file_is_written_once(tmp_path):
    report = write_block_stl(
        LatticeSpec("CVC", 10.0, 1.0, resolution=8), (4, 4, 4), tmp_path / "a.stl"
    )
    assert report.work["bytes written"] == 50 * report.triangles
    assert report.work["triangles laid"] == report.triangles


@pytest.mark.slow
def test_the_boolean_grows_with_the_surface():
    """Twice the size: four times the triangles laid and cut, eight times those of the lattice."""
    small, large = cube(7), cube(14)
    assert large.triangles > 6.5 * small.triangles
    for figure in ("triangles laid", "triangles into the Boolean"):
        assert large.work[figure] < 4.4 * small.work[figure]


@pytest.mark.costly
def test_cells_inside_do_not_enter_the_boolean():
    """On 14 cells along each axis less than half of the lattice is at the wall."""
    done = cube(14)
    assert done.work["triangles into the Boolean"] < 0.5 * done.triangles


@pytest.mark.slow
def test_a_change_of_the_radius_finds_no_wall_again():
    solid, cache = box((32.0,) * 3), StageCache()
    first = fill(solid, SPEC, cache=cache).report.work
    again = fill(solid, LatticeSpec(**{**SPEC.as_dict(), "strut_radius": 0.6}), cache=cache)
    assert first["walls found"] == 1
    assert "walls found" not in again.report.work
    assert again.report.work["kinds of octants meshed"] == first["kinds of octants meshed"]


@pytest.mark.slow
def test_the_same_job_again_meshes_no_octant():
    solid, cache = box((32.0,) * 3), StageCache()
    fill(solid, SPEC, cache=cache)
    assert "kinds of octants meshed" not in fill(solid, SPEC, cache=cache).report.work


@pytest.mark.slow
def test_a_block_takes_memory_for_its_mesh_and_little_more():
    """Bytes at the peak, beside those of the mesh: 24 a vertex and 12 a triangle."""
    spec = LatticeSpec("CVC", 10.0, 1.0, resolution=12)
    block(spec, (1, 1, 1))
    tracemalloc.start()
    mesh = block(spec, (8, 8, 8)).mesh
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1.8 * (mesh.vertices.nbytes + mesh.triangles.nbytes)
