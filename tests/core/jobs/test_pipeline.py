# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a solid to a part, on modelled samples."""

import json
from dataclasses import replace

import numpy as np
import pytest

import samples
from exact import BLOCK_VOLUME, DENSITY, in_lattice
from volfrep import Cancelled, LatticeSpec, StageCache, VolfrepError
from volfrep.design.cells import LIBRARY, PAPERS
from volfrep.grid.placement import NUDGE
from volfrep.io.write.stl import as_read
from volfrep.jobs import pipeline
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill, forecast_and_fill
from volfrep.mesh import quality

SMALL = LatticeSpec(cell="CVC", cell_size=8, strut_radius=0.8, shell=2)


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", PAPERS)
def test_a_part_is_one_body_with_skin_and_lattice(cell):
    solid = samples.bracket(20.0)
    result = fill(solid, LatticeSpec(cell=cell, cell_size=8, strut_radius=0.8, shell=2))
    report = result.report
    assert report.watertight
    assert report.bodies == 1
    read = quality.measure(as_read(result.mesh))
    assert read.watertight
    assert (read.bodies, read.genus) == (report.bodies, report.genus)
    assert read.degenerate_triangles == 0
    np.testing.assert_allclose(result.mesh.bounds, solid.bounds)
    assert report.volume_mm3 < solid.volume
    if cell in DENSITY:
        a, b = DENSITY[cell]
        # The wall cuts struts at random: near the endless lattice's density.
        assert report.relative_density == pytest.approx(a * 0.01 - b * 0.001, rel=0.15)


@pytest.mark.costly
def test_the_part_is_where_skin_or_lattice_is():
    """Monte Carlo: the volume of the points in the skin or in a strut."""
    solid = samples.box((40.0, 30.0, 20.0), (2.0, -3.0, 5.0))
    spec = LatticeSpec(cell="Octet", cell_size=8, strut_radius=0.8, shell=2)
    result = fill(solid, spec)
    low, high = solid.bounds
    points = np.random.default_rng(11).uniform(low, high, (100_000, 3))
    skin = ((points < low + 2) | (points > high - 2)).any(axis=1)
    strut = in_lattice(points - low, LIBRARY["Octet"], 8.0, 0.8)
    share = (skin | strut).mean()
    deviation = 24_000.0 * np.sqrt(share * (1 - share) / len(points))
    exact = 24_000.0 * share
    assert result.report.volume_mm3 == pytest.approx(exact, abs=0.005 * exact + 3 * deviation)


@pytest.mark.costly
def test_thickness_zero_trims_the_lattice_at_the_outer_surface():
    solid = samples.sphere(20.0)
    result = fill(solid, LatticeSpec(cell="Octet", cell_size=8, strut_radius=0.8, shell=0))
    assert result.report.bodies == 1
    assert result.report.watertight
    radius = np.linalg.norm(result.mesh.vertices, axis=1)
    assert radius.max() <= 20.0 + 1e-9
    assert radius.max() > 19.9


@pytest.mark.slow
def test_the_outputs_add_up():
    solid = samples.plate(64)
    cache = StageCache()
    spec = LatticeSpec(cell="BCC", cell_size=8, strut_radius=0.8, shell=1.5)
    part, lattice, domain = (
        fill(solid, replace(spec, output=o), cache=cache) for o in ("part", "lattice", "domain")
    )
    skin = solid.volume - domain.mesh.volume
    assert part.mesh.volume == pytest.approx(skin + lattice.mesh.volume, rel=1e-4)
    assert part.report.relative_density == pytest.approx(lattice.report.relative_density, rel=1e-3)


@pytest.mark.slow
def test_the_papers_rule_takes_fewer_cells():
    solid = samples.sphere(24.0)
    touching, centre = (
        fill(solid, LatticeSpec(cell="BCC", cell_size=8, strut_radius=0.8, shell=2, activation=a))
        for a in ("touching", "centre")
    )
    assert centre.report.cells_active < touching.report.cells_active
    assert centre.report.watertight
    assert centre.report.struts < touching.report.struts


def test_the_origin_is_a_cells_corner():
    solid = samples.box()
    result = fill(
        solid,
        LatticeSpec(cell="Box", cell_size=8, strut_radius=0.8, shell=2, origin=(1.5, 2.5, 3.5)),
    )
    offset = (result.wireframe.nodes - np.array([1.5, 2.5, 3.5])) / 8.0 - NUDGE
    np.testing.assert_allclose(offset, np.round(offset), atol=1e-9)


@pytest.mark.parametrize("cell", BLOCK_VOLUME)
@pytest.mark.slow
def test_the_papers_block_has_its_true_volume(cell):
    result = block(LatticeSpec(cell=cell, cell_size=10, strut_radius=1), (10, 10, 10))
    assert result.report.volume_mm3 == pytest.approx(BLOCK_VOLUME[cell], rel=0.005)
    assert result.report.genus == result.wireframe.genus
    assert result.report.bodies == 1


def test_a_block_reports_what_it_is():
    result = block(LatticeSpec(cell="CVC", cell_size=5, strut_radius=0.5, density=2.0), (2, 3, 1))
    report = result.report
    assert (report.cells_total, report.cells_active, report.grid) == (6, 6, (2, 3, 1))
    assert (report.nodes, report.struts) == (3 * 4 * 2 + 6, 48)
    assert report.mass_g == pytest.approx(report.volume_mm3 * 2.0 / 1000)
    data = json.loads(report.to_json())
    wanted = {
        "cells_total", "cells_active", "nodes", "struts", "triangles", "bodies", "genus",
        "volume_mm3", "relative_density", "mass_g", "watertight", "stages", "peak_memory_mb",
    }  # fmt: skip
    assert wanted <= data.keys()


def test_a_part_made_again_is_the_part_made_afresh(monkeypatch):
    looked_at, check = [], pipeline.check_solid
    monkeypatch.setattr(
        pipeline, "check_solid", lambda mesh, name: looked_at.append(name) or check(mesh, name)
    )
    cache = StageCache()

    def made(kept, size, **changes):
        """From a mesh of its own, as it comes from another process."""
        spec = replace(SMALL, **changes)
        return forecast_and_fill(samples.box(size), "box", spec, show=(10**6, 10**5), cache=kept)

    large, small = (20.0, 14.0, 14.0), (18.0, 14.0, 14.0)
    for size, changes, is_new in (
        (large, {}, True),
        (large, {"strut_radius": 0.9}, False),
        (large, {"strut_radius": 0.7}, False),
        (large, {"strut_radius": 0.7, "shell": 1.5}, False),
        (large, {"strut_radius": 0.9, "shell": 1.5, "cell_size": 7}, False),
        (small, {"strut_radius": 0.9, "shell": 1.5, "cell_size": 7}, True),
        (large, {}, True),
    ):
        looked_at.clear()
        forecast, part = made(cache, size, **changes)
        assert bool(looked_at) == is_new
        expected, fresh = made(None, size, **changes)
        assert forecast == expected
        np.testing.assert_array_equal(part.mesh.vertices, fresh.mesh.vertices)
        np.testing.assert_array_equal(part.mesh.triangles, fresh.mesh.triangles)
        np.testing.assert_array_equal(part.kinds, fresh.kinds)
        np.testing.assert_array_equal(part.shown.facets, fresh.shown.facets)


@pytest.mark.slow
def test_only_the_stages_that_a_change_affects_run_again(monkeypatch):
    from volfrep.jobs import active_cells
    from volfrep.jobs.kinds import strut_lattice
    from volfrep.shell import domain

    runs = []
    for module, name in (
        (domain, "find_cavity"),
        (active_cells, "active_cells"),
        (strut_lattice, "mesh_octants"),
    ):
        original = getattr(module, name)
        monkeypatch.setattr(
            module,
            name,
            lambda *a, _name=name, _original=original: runs.append(_name) or _original(*a),
        )
    cache, solid = StageCache(), samples.box()

    def stages(**changes):
        runs.clear()
        fill(
            solid,
            LatticeSpec(**{"cell_size": 8, "strut_radius": 0.8, "shell": 2, **changes}),
            cache=cache,
        )
        return set(runs)

    assert stages() == {"find_cavity", "active_cells", "mesh_octants"}
    assert stages() == set()
    assert stages(strut_radius=0.9) == {"mesh_octants"}
    assert stages(strut_radius=0.9, cell_size=7) == {"active_cells", "mesh_octants"}
    assert stages(strut_radius=0.9, cell_size=7, density=3.0) == set()
    assert stages(strut_radius=0.9, cell_size=7, shell=1.5) == {"find_cavity", "active_cells"}


@pytest.mark.costly
def test_progress_rises_and_a_cancel_stops():
    seen = []
    fill(samples.box(), SMALL, progress=lambda fraction, stage: seen.append((fraction, stage)))
    fractions = [fraction for fraction, _ in seen]
    assert fractions == sorted(fractions)
    assert {"shell", "voxels", "tile", "trim"} <= {stage for _, stage in seen}
    for stop_at in (0.0, 0.35, 0.6):
        with pytest.raises(Cancelled):
            fill(samples.box(), SMALL, progress=lambda fraction, _, at=stop_at: fraction < at)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"cell_size": 60.0, "strut_radius": 1.0}, "larger than the part"),
        ({"shell": 11.0}, "nowhere thicker than two skins"),
        ({"cell_size": 0.02, "strut_radius": 0.002}, "Cells of"),
        ({"cell": "Octet", "strut_radius": 2.75}, "completely"),
    ],
)
def test_what_cannot_be_made_is_refused_with_a_sentence(changes, message):
    spec = replace(SMALL, **changes)
    with pytest.raises(VolfrepError, match=message):
        fill(samples.box(), spec)


@pytest.mark.parametrize("count", [(0, 1, 1), (1, 1), (1.5, 1, 1), (-2, 1, 1)])
def test_a_senseless_count_is_refused(count):
    with pytest.raises(VolfrepError, match="whole number"):
        block(SMALL, count)


def test_a_block_larger_than_memory_is_refused_before_it_is_made():
    with pytest.raises(VolfrepError, match="free memory"):
        block(SMALL, (100_000, 100_000, 100_000))


@pytest.mark.slow
def test_a_skin_that_strays_is_said_in_the_report(monkeypatch):
    from volfrep.shell import domain

    original = domain.find_cavity
    monkeypatch.setattr(
        domain, "find_cavity", lambda *a: replace(original(*a), worst=0.2, place=np.ones(3))
    )
    (warning,) = fill(samples.box(), SMALL).report.warnings
    assert "20% off its thickness near (1, 1, 1)" in warning
    monkeypatch.undo()
    assert fill(samples.box(), SMALL).report.warnings == ()
