# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is told of octants before they are laid."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.design import memory_guard
from volfrep.jobs.blocks import block
from volfrep.jobs.infill import Infill
from volfrep.jobs.octant_guard import DEVIATION_WARNED, deviation_warnings
from volfrep.octants import sdf
from volfrep.octants.octant import octant_grid, octant_primitives
from volfrep.octants.octant_mesh import mesh_octants, octant_spec
from volfrep.util.errors import VolfrepError
from volfrep.util.progress import Monitor

SIZE = 10.0


def meshed(cell, radius, **options):
    spec = LatticeSpec(cell, SIZE, radius, **options)
    wanted = octant_spec(SIZE, spec.struts, spec.detail)
    grid = octant_grid(spec.unit_cell(), np.ones((1, 1, 1), bool), SIZE, np.zeros(3))
    return spec, wanted, mesh_octants(spec.unit_cell(), wanted, grid.keys, Monitor())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cell", "radius", "is_told"), [("CVC", 1.0, False), ("Weaire-Phelan", 1.5, True)]
)
def test_facets_that_stray_farther_than_promised_are_told_by_how_much(cell, radius, is_told):
    spec, wanted, octants = meshed(cell, radius)
    farthest = 0.0
    random = np.random.default_rng(0)
    for key, octant in octants.items():
        if not len(octant.triangles):
            continue
        weights = random.dirichlet(np.ones(3), (20, 1))
        corners = octant.vertices[octant.triangles]
        points = (weights[..., None] * corners[None]).sum(axis=2).reshape(-1, 1, 3)
        exact = octant_primitives(spec.unit_cell(), key, SIZE, radius, wanted.reach)
        off = np.abs(sdf.union(sdf.distances(points, exact), 0.0)).max()
        assert off <= 1.1 * octant.deviation
        farthest = max(farthest, off)
    told = deviation_warnings(octants, wanted)
    assert bool(told) is is_told
    assert bool(farthest > DEVIATION_WARNED * wanted.deviation) is is_told
    if is_told:
        most = max(octant.deviation for octant in octants.values())
        assert f"by up to {most:.2g} mm" in told[0]
        assert most == pytest.approx(farthest, rel=0.25)
        assert told[0] in block(spec, (1, 1, 1)).report.warnings


def test_fillets_have_no_distances_to_tell():
    _, wanted, octants = meshed("CVC", 0.8, fillet=0.6)
    assert not deviation_warnings(octants, wanted)


@pytest.mark.parametrize("streamed", [False, True])
def test_a_lattice_that_will_not_fit_is_refused_before_its_skin_is_made(monkeypatch, streamed):
    part, spec = samples.box((40.0, 30.0, 20.0)), LatticeSpec("CVC", 2.0, 0.2, shell=1.0)
    monkeypatch.setattr(memory_guard, "free_memory", lambda: 2e7)
    infill = Infill(part, spec, streamed=streamed)
    with pytest.raises(VolfrepError, match=r"free memory: .* would fit"):
        _ = infill.part
    assert "walls found" not in infill.monitor.work


@pytest.mark.costly
def test_a_lattice_that_fits_within_its_skin_only_is_not_refused(monkeypatch):
    part, spec = samples.box((40.0, 30.0, 20.0)), LatticeSpec("CVC", 5.0, 0.5, shell=8.0)
    # A fortieth of the part is left, which is less than the cells of all of it would take.
    monkeypatch.setattr(memory_guard, "free_memory", lambda: 2e7)
    assert Infill(part, spec).lattice is not None
