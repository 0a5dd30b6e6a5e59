# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fewer triangles, no farther off than was asked for, and still one closed body."""

import math

import numpy as np
import pytest
from scipy.spatial import cKDTree

import samples
from volfrep.design.spec import LatticeSpec
from volfrep.io.write.stl import as_read
from volfrep.jobs.blocks import block
from volfrep.jobs.decimate import reduce_triangles
from volfrep.jobs.pipeline import fill
from volfrep.mesh import quality
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.util.errors import VolfrepError


@pytest.fixture(scope="module")
def fine_block():
    spec = LatticeSpec(cell="BCC", cell_size=10.0, strut_radius=1.0, deviation=0.005)
    return block(spec, (1, 1, 1))


@pytest.fixture(scope="module")
def reduced_block(fine_block):
    return reduce_triangles(fine_block.mesh, 0.02)


def assert_one_body(mesh: TriangleMesh, genus: int) -> None:
    """One closed surface of that genus, as a reader of the file sees it."""
    read = quality.measure(as_read(mesh))
    assert read.watertight
    assert (read.bodies, read.genus, read.degenerate_triangles) == (1, genus, 0)


def points_on(mesh: TriangleMesh, count: int, seed: int = 0) -> np.ndarray:
    random = np.random.default_rng(seed)
    corners = mesh.vertices[mesh.triangles]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    chosen = random.choice(len(area), count, p=area / area.sum())
    share = random.dirichlet(np.ones(3), count)
    return np.einsum("ki,kij->kj", share, corners[chosen])


def test_a_finely_meshed_lattice_needs_half_the_triangles_for_two_hundredths_of_a_mm(
    fine_block, reduced_block
):
    reduced = reduced_block
    assert reduced.triangles_before == len(fine_block.mesh.triangles)
    assert len(reduced.mesh.triangles) < 0.65 * reduced.triangles_before
    assert reduced.deviation <= 0.02
    assert_one_body(reduced.mesh, genus=fine_block.report.genus)
    # What moves by at most a deviation everywhere changes the volume by less than area times it.
    change = reduced.mesh.volume - fine_block.mesh.volume
    assert abs(change) < 0.5 * 0.02 * fine_block.report.area_mm2


def test_no_random_point_of_either_surface_is_farther_off(fine_block, reduced_block):
    reduced = reduced_block.mesh
    # Nearest of very many points of the other surface: too far by at most half their spacing
    # squared over the distance, and never too near.
    for one, other in ((fine_block.mesh, reduced), (reduced, fine_block.mesh)):
        cloud = cKDTree(points_on(other, 1_000_000, seed=1))
        distance = cloud.query(points_on(one, 20_000))[0]
        spacing = math.sqrt(fine_block.report.area_mm2 / 1_000_000)
        assert np.quantile(distance, 0.999) < math.hypot(0.02, 2.0 * spacing)


def test_flat_faces_lose_nearly_all_their_triangles():
    box = samples.box((30.0, 20.0, 10.0))
    fine = TriangleMesh(box.vertices, box.triangles)
    for _ in range(3):
        fine = _quartered(fine)
    reduced = reduce_triangles(fine, 0.001)
    assert len(fine.triangles) == 12 * 4**3
    assert len(reduced.mesh.triangles) < 60
    assert reduced.mesh.volume == pytest.approx(6000.0, rel=1e-6)


@pytest.mark.slow
def test_a_part_keeps_its_skin_its_cavity_and_its_genus():
    spec = LatticeSpec(cell="CVC", cell_size=10.0, strut_radius=1.0, shell=2.0, deviation=0.008)
    part = fill(samples.sphere(14.0, 4), spec)
    reduced = reduce_triangles(part.mesh, 0.02)
    assert len(reduced.mesh.triangles) < 0.9 * part.report.triangles
    assert reduced.quality.voids == part.report.voids
    assert_one_body(reduced.mesh, genus=part.report.genus)


def test_bodies_that_lie_apart_stay_apart():
    ball = samples.sphere(5.0, 4)
    beside = ball.vertices + np.array([10.03, 0.0, 0.0])
    two = concatenate(ball, TriangleMesh(beside, ball.triangles))
    reduced = reduce_triangles(two, 0.01)
    assert reduced.quality.bodies == 2
    assert len(reduced.mesh.triangles) < len(two.triangles)


@pytest.mark.parametrize("deviation", [0.0, -1.0, math.nan, math.inf])
def test_the_deviation_must_be_a_length(deviation: float):
    with pytest.raises(VolfrepError, match="above 0 mm"):
        reduce_triangles(samples.box((1.0, 1.0, 1.0)), deviation)


def test_an_open_mesh_is_refused():
    box = samples.box((1.0, 1.0, 1.0))
    with pytest.raises(VolfrepError, match="closed"):
        reduce_triangles(TriangleMesh(box.vertices, box.triangles[1:]), 0.02)


def _quartered(mesh: TriangleMesh) -> TriangleMesh:
    """Every triangle cut into four at the middles of its edges."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    corners = np.concatenate([np.stack(part, axis=1) for part in parts]).reshape(-1, 3)
    vertices, index = np.unique(corners.round(9), axis=0, return_inverse=True)
    return TriangleMesh(vertices, index.reshape(-1, 3).astype(np.int32))
