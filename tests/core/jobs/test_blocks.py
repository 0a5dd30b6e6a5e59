# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block of equal cells goes into its file octant by octant, and is the same lattice."""

import json
import shutil
import tracemalloc
from collections import namedtuple

import numpy as np
import pytest

from exact import distances_to_one_cell
from samples import SKEW
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.cells import PAPERS, find_cell
from volfrep.design.costs import BYTES_PER_STREAMED_CELL
from volfrep.design.grading import RadiusGrading
from volfrep.design.profile import Profile
from volfrep.io.solid import read_triangles
from volfrep.io.write.stl import FACET, HEADER_BYTES, MOST_FACETS, as_read, write_stl
from volfrep.jobs.blocks import block, write_block_stl
from volfrep.jobs.kinds import octant_block
from volfrep.mesh.quality import measure
from volfrep.mesh.topology import pinched_vertices
from volfrep.util.errors import Cancelled

SPEC = LatticeSpec("CVC", 10.0, 1.0, resolution=8)


def facets_of(path):
    data = path.read_bytes()[HEADER_BYTES + 4 :]
    return np.frombuffer(data, FACET)


def sorted_corners(facets):
    """The facets' corners, each facet from its first corner on, in a fixed order."""
    corners = facets["corners"].astype(np.float64)
    first = np.array([np.lexsort(c.T)[0] for c in corners])
    turned = np.stack([np.roll(c, -k, axis=0) for c, k in zip(corners, first, strict=True)])
    rows = turned.reshape(len(turned), 9)
    return rows[np.lexsort(rows.T)]


@pytest.mark.slow_but("Box")
@pytest.mark.parametrize("cell", [*map(find_cell, PAPERS), SKEW], ids=lambda cell: cell.name)
def test_the_streamed_file_holds_the_facets_of_the_mesh(cell, tmp_path):
    file = tmp_path / "cell.json"
    if cell is SKEW:
        text = {"nodes": cell.nodes.tolist(), "struts": cell.struts.tolist()}
        file.write_text(json.dumps(text), encoding="utf-8")
    spec = LatticeSpec(
        cell.name if cell is not SKEW else str(file), 10.0, 1.0, resolution=8, origin=(3.3, -7, 0.1)
    )
    report = write_block_stl(spec, (2, 1, 2), tmp_path / "streamed.stl")
    whole = block(spec, (2, 1, 2))
    write_stl(whole.mesh, tmp_path / "whole.stl")
    streamed, written = (facets_of(tmp_path / f"{name}.stl") for name in ("streamed", "whole"))
    np.testing.assert_array_equal(sorted_corners(streamed), sorted_corners(written))
    for name in ("triangles", "vertices", "genus", "bodies", "watertight", "struts", "volume_mm3"):
        assert getattr(report, name) == getattr(whole.report, name), name
    assert "write" in report.stages


@pytest.mark.costly
def test_specks_of_nearly_closed_windows_are_removed(tmp_path):
    """Octet of r = L / 5: its windows close, but for specks that no facet can follow."""
    report = write_block_stl(LatticeSpec("Octet", 10.0, 2.0), (2, 2, 2), tmp_path / "a.stl")
    quality = measure(as_read(read_triangles(tmp_path / "a.stl")))
    assert report.specks_removed > 0
    assert quality.watertight
    assert quality.degenerate_triangles == 0
    assert quality.bodies == report.bodies == 1


def test_the_normals_point_out_of_the_material(tmp_path):
    write_block_stl(SPEC, (2, 2, 1), tmp_path / "a.stl")
    facets = facets_of(tmp_path / "a.stl")
    corners = facets["corners"].astype(np.float64)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    assert (np.einsum("ij,ij->i", across, facets["normal"]) > 0.999).all()


@pytest.mark.costly
def test_neighbouring_octants_share_their_vertices_to_the_last_bit(tmp_path):
    """L = 10 / 3 and an odd origin: nothing is a round number."""
    spec = LatticeSpec("Octet", 10.0 / 3.0, 0.3, resolution=8, origin=(0.1, 1e3 / 7.0, -2e3 / 3.0))
    report = write_block_stl(spec, (5, 4, 3), tmp_path / "a.stl")
    mesh = as_read(read_triangles(tmp_path / "a.stl"))
    quality = measure(mesh)
    assert quality.watertight
    assert quality.bodies == 1
    assert quality.genus == report.genus == report.struts - report.nodes + 1
    assert pinched_vertices(mesh) == 0


@pytest.mark.slow
def test_memory_does_not_grow_with_the_triangles(tmp_path):
    """Two and a half times the triangles, within a few bytes for each cell.

    Of fewer cells not all that is made ready to be written at once is full.
    """
    peak = {}
    for count in (4, 16, 22):  # the first run imports
        tracemalloc.start()
        report = write_block_stl(SPEC, (count,) * 3, tmp_path / "a.stl")
        peak[count] = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        size = (tmp_path / "a.stl").stat().st_size
        assert size == report.work["bytes written"] + HEADER_BYTES + 4
    cells = 22**3 - 16**3
    assert peak[22] - peak[16] < BYTES_PER_STREAMED_CELL * cells < 0.2 * size


def test_a_graded_block_is_meshed_as_a_whole(tmp_path):
    thicker = RadiusGrading("direction", Profile("linear", 0.8, 1.2))
    spec = LatticeSpec("CVC", 10.0, 1.0, resolution=8, radius_grading=thicker)
    report = write_block_stl(spec, (2, 2, 2), tmp_path / "a.stl")
    quality = measure(as_read(read_triangles(tmp_path / "a.stl")))
    assert quality.watertight
    assert quality.volume == pytest.approx(report.volume_mm3, rel=1e-5)


def test_facets_finer_than_single_precision_are_refused(tmp_path):
    spec = LatticeSpec("CVC", 1.0, 0.1, resolution=20, origin=(1e6, 1e6, 1e6))
    with pytest.raises(VolfrepError, match="finer than the single precision"):
        write_block_stl(spec, (1, 1, 1), tmp_path / "a.stl")
    assert not list(tmp_path.iterdir())


def test_a_disk_that_is_too_small_is_found_before_the_proof(tmp_path, monkeypatch):
    monkeypatch.setattr(octant_block, "certify", lambda layout: pytest.fail("proved"))
    Usage = namedtuple("Usage", "total used free")
    monkeypatch.setattr(shutil, "disk_usage", lambda path: Usage(2e6, 1e6, 1e6))
    (tmp_path / "a.stl").write_bytes(b"old")
    with pytest.raises(VolfrepError, match=r"it will have .* GB and the disk has 0.001 GB left"):
        write_block_stl(SPEC, (6, 6, 6), tmp_path / "a.stl")
    assert (tmp_path / "a.stl").read_bytes() == b"old"


def test_a_cancel_while_writing_leaves_the_old_file(tmp_path):
    (tmp_path / "a.stl").write_bytes(b"old")
    with pytest.raises(Cancelled):
        write_block_stl(
            SPEC, (6, 6, 6), tmp_path / "a.stl", progress=lambda _, stage: stage != "write"
        )
    assert [path.name for path in tmp_path.iterdir()] == ["a.stl"]
    assert (tmp_path / "a.stl").read_bytes() == b"old"


def test_more_facets_than_the_format_counts_are_refused(tmp_path, monkeypatch):
    assert MOST_FACETS == 2**32 - 1
    monkeypatch.setattr("volfrep.io.write.stl.MOST_FACETS", 1000)
    with pytest.raises(VolfrepError, match="at most 1,000 triangles"):
        write_block_stl(SPEC, (2, 2, 2), tmp_path / "a.stl")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("cell", ["Octet", "CVC"])
def test_the_deviation_is_kept(cell):
    """As docs/limits.md has it, by distances from the struts themselves."""
    spec = LatticeSpec(cell, cell_size=10, strut_radius=1, deviation=0.02)
    mesh = block(spec, (1, 1, 1)).mesh
    corners = mesh.vertices[mesh.triangles]
    area = np.linalg.norm(np.cross(*(corners[:, 1:] - corners[:, :1]).swapaxes(0, 1)), axis=1)
    random = np.random.default_rng(0)
    chosen = corners[random.choice(len(area), 4000, p=area / area.sum())]
    points = (random.dirichlet((1.0, 1.0, 1.0), 4000)[:, :, None] * chosen).sum(axis=1)
    strays = np.abs(distances_to_one_cell(points, find_cell(cell), 10.0, 1.0))
    assert (strays > 1.5 * 0.02).mean() < 0.001
    assert strays.max() < 1.7 * 0.02
