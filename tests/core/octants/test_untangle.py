# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coarse facets and crowded joints: the volume is right, and nothing runs through itself."""

from dataclasses import replace

import numpy as np
import pytest
from trimesh.transformations import rotation_matrix

from volfrep.design.cells import PAPERS, UnitCell
from volfrep.design.spec import LatticeSpec
from volfrep.design.spec_parts import COARSEST
from volfrep.jobs.blocks import block, write_block_stl
from volfrep.jobs.finer import until_sound
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.octants.octant import OctantKey
from volfrep.octants.octant_mesh import FacetsCross, mesh_octants, octant_spec
from volfrep.octants.octant_spec import OctantSpec
from volfrep.spatial.piercing import piercing_pairs
from volfrep.spatial.self_intersection import crossing_triangles
from volfrep.util.errors import VolfrepError
from volfrep.util.progress import Monitor


def crossings(mesh, depth=1e-6):
    return int(crossing_triangles(mesh, np.ones(len(mesh.triangles), bool), depth).sum())


def crowded_cell(seed=0):
    """Struts between nodes anywhere, which cross, graze and end beside each other."""
    random = np.random.default_rng(seed)
    random.choice(158, 60, replace=False)
    nodes = random.random((30, 3))
    ends = {tuple(sorted(int(k) for k in random.choice(30, 2, replace=False))) for _ in range(80)}
    return UnitCell("crowded", nodes, np.array(sorted(ends)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "radius"),
    [
        # Thin struts take many facets: of those, two cells are quick.
        pytest.param(n, r, marks=pytest.mark.slow if r == 0.3 and n not in ("Box", "CVC") else ())
        for r in (0.3, 1.0, 2.0, 3.0)
        for n in PAPERS
    ],
)
def test_a_coarse_block_has_the_volume_of_a_fine_one(name, radius):
    spec = LatticeSpec(name, 10.0, radius, resolution=max(40, round(25 / radius)))
    fine = block(spec, (1, 1, 1)).mesh.volume
    for resolution in (4, 8, 10, 12):
        spec = LatticeSpec(name, 10.0, radius, resolution=resolution)
        mesh = block(spec, (1, 1, 1)).mesh
        assert mesh.volume == pytest.approx(fine, rel=0.015)
        assert not crossings(mesh)


def test_what_is_too_coarse_is_made_finer_and_told():
    spec = LatticeSpec("Box", 10.0, 0.3, resolution=4)
    report = block(spec, (2, 2, 2)).report
    # 148.6 mm3 by the exact cylinders and spheres.
    assert report.volume_mm3 == pytest.approx(148.6, rel=0.003)
    assert "resolution of 4 is too coarse" in report.warnings[0]
    assert f"{spec.facets_along_cell} facets" in report.warnings[0]
    told = LatticeSpec("Box", 10.0, 0.3, resolution=spec.facets_along_cell)
    assert not told.notes
    assert LatticeSpec("Box", 10.0, 3.0, resolution=4).facets_along_cell == COARSEST


def test_struts_too_thin_for_any_facets_are_refused():
    with pytest.raises(VolfrepError, match=r"Cells of 10 mm .* 4 mm or smaller, .* 0\.025 mm or"):
        LatticeSpec("Box", 10.0, 0.01, resolution=100)


@pytest.mark.slow
@pytest.mark.parametrize("resolution", [24, 26])
def test_struts_that_cross_anyhow_leave_no_facets_that_do(resolution):
    spec = LatticeSpec(crowded_cell(), 7.0, 0.4, resolution=resolution)
    keys = [OctantKey(mirror, 0xFF) for mirror in range(8)]
    octants = mesh_octants(
        spec.unit_cell(), octant_spec(spec.cell_size, spec.struts, spec.detail), keys, Monitor()
    )
    for octant in octants.values():
        assert not crossings(TriangleMesh(octant.vertices, octant.triangles))
        # What lies in its own box meets its neighbours in their common faces only.
        inner = octant.vertices[octant.places == 1]
        assert inner.min() > 0.0
        assert inner.max() < 3.5


@pytest.mark.slow
@pytest.mark.parametrize(
    "resolution",
    [24, pytest.param(28, marks=pytest.mark.slow), pytest.param(30, marks=pytest.mark.slow)],
)
def test_narrow_windows_leave_no_facets_that_cross(resolution):
    spec = LatticeSpec("FCC", 10.0, 3.0, resolution=resolution)
    assert not crossings(block(spec, (1, 1, 1)).mesh)


@pytest.mark.costly
def test_facets_in_one_plane_beside_a_face_do_not_overlap():
    """Such touch as they are meshed, and cross once a turned lattice is written to a file."""
    spec = LatticeSpec("Kagome", 10.0, 1.4813)
    key = OctantKey(0, 0xFF, sum(1 << k for k in (226, 237, 238, 247, 253, 296)))  # struts gone
    meshing = octant_spec(spec.cell_size, spec.struts, spec.detail)
    octant = mesh_octants(spec.unit_cell(), meshing, [key], Monitor())[key]
    assert len(octant.triangles)
    turned = octant.vertices @ rotation_matrix(0.8, (1.0, 2.0, 3.0))[:3, :3].T
    for vertices in (octant.vertices, turned.astype(np.float32).astype(float)):
        assert not len(piercing_pairs(TriangleMesh(vertices, octant.triangles)))


def test_where_facets_cross_however_they_are_meshed_finer_ones_are_tried():
    tile = OctantSpec(10.0, 1.0, 0.0, 12)

    def make(spec):
        if spec.facets < 20:
            raise FacetsCross("they cross")
        return spec.facets

    made, finer, notes = until_sound(tile, make)
    assert made == finer.facets >= 20
    assert f"{made} are made" in notes[0]
    fine = replace(tile, facets=20)
    assert until_sound(fine, make) == (20, fine, ())

    def never(spec):
        raise FacetsCross("they cross")

    with pytest.raises(FacetsCross):
        until_sound(tile, never)


@pytest.mark.slow
def test_a_written_block_tells_the_same(tmp_path):
    spec = LatticeSpec("Octet", 10.0, 0.3, resolution=4)
    report = write_block_stl(spec, (1, 1, 1), tmp_path / "a.stl")
    assert report.warnings == block(spec, (1, 1, 1)).report.warnings != ()
