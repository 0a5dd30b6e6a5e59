# SPDX-License-Identifier: LGPL-2.1-or-later
"""Formats that hold a part without a mesh of what its wall does not cut."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
import trimesh

import samples
from contract import assert_same_quality
from volfrep import LatticeSpec
from volfrep.design.grading import Orientation
from volfrep.io.write.numbered import number_vertices
from volfrep.io.write.threemf import write_3mf_beams
from volfrep.jobs.infill import Infill
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.output.form import FORMS
from volfrep.output.meshes import write_mesh
from volfrep.trim import stage
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.progress import Monitor

STREAMED = [form.suffixes[0] for form in FORMS if form.streamed and form.bytes_by]
SPEC = LatticeSpec("CVC", 5.0, 0.5, shell=1.0, resolution=8)
TURNED = replace(SPEC, orientation=Orientation((1.0, 2.0, 3.0), 40.0))


@lru_cache
def turned() -> Infill:
    return Infill(samples.box((40.0, 40.0, 40.0)), TURNED)


@lru_cache
def part(edge: float = 40.0) -> Infill:
    return Infill(samples.box((edge, edge, edge)), SPEC)


@pytest.fixture
def unmeshed(monkeypatch: pytest.MonkeyPatch) -> TrimmedSurface:
    """A part's surface, of which nobody may ask for the mesh of the whole."""
    surface = part().part.surface

    def refused(*_: object) -> None:
        raise AssertionError("the mesh of the whole was made")

    monkeypatch.setattr(TrimmedSurface, "whole", refused)
    monkeypatch.setattr(TrimmedSurface, "with_octants", refused)
    return surface


def read(path: Path) -> TriangleMesh:
    """As trimesh reads a file, vertices merged in an STL only."""
    found = trimesh.load(path, process=path.suffix == ".stl", force="mesh")
    return TriangleMesh(np.asarray(found.vertices, float), np.asarray(found.faces, np.int32))


def rows(mesh: TriangleMesh) -> np.ndarray:
    """(m, 9) triangles by their corners in single precision, beginning with the least, sorted."""
    corners = mesh.vertices.astype(np.float32)[mesh.triangles]
    order = np.lexsort(corners.transpose(2, 0, 1)[::-1], axis=1)[:, 0]
    turned = corners[np.arange(len(corners))[:, None], (order[:, None] + np.arange(3)) % 3]
    flat = turned.reshape(-1, 9)
    return flat[np.lexsort(flat.T[::-1])]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", STREAMED)
def test_a_part_is_read_as_its_mesh_is(
    suffix: str, tmp_path: Path, unmeshed: TrimmedSurface
) -> None:
    assert unmeshed.octants is not None
    path = tmp_path / f"part{suffix}"
    write_mesh(unmeshed, path)
    found, wanted = measure(read(path)), part().part.report
    assert found.watertight
    assert (found.triangles, found.vertices) == (wanted.triangles, wanted.vertices)
    assert (found.bodies, found.voids, found.genus) == (wanted.bodies, wanted.voids, wanted.genus)
    assert found.volume == pytest.approx(wanted.volume_mm3, rel=1e-6)


@pytest.mark.costly
@pytest.mark.slow_but(".ply")
@pytest.mark.parametrize("suffix", [".stl", ".ply"])
def test_triangle_for_triangle(suffix: str, tmp_path: Path) -> None:
    write_mesh(part().part.surface, tmp_path / f"streamed{suffix}")
    write_mesh(part().part.mesh, tmp_path / f"meshed{suffix}")
    one, two = (read(tmp_path / f"{name}{suffix}") for name in ("streamed", "meshed"))
    np.testing.assert_array_equal(rows(one), rows(two))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", STREAMED)
def test_a_lattice_that_is_turned(suffix: str, tmp_path: Path) -> None:
    found = turned().part
    assert found.surface.octants is not None
    # What is proved of its octants is what its triangles show.
    whole = measure(found.mesh)
    assert_same_quality(found.surface.inspected(Monitor()).found.quality, whole)
    np.testing.assert_array_equal(found.surface.bounds, whole.bounds)
    write_mesh(found.surface, tmp_path / f"part{suffix}")
    seen = measure(read(tmp_path / f"part{suffix}"))
    assert seen.watertight
    assert (seen.triangles, seen.vertices, seen.genus) == (
        whole.triangles, whole.vertices, whole.genus,
    )  # fmt: skip
    assert seen.volume == pytest.approx(whole.volume, rel=1e-6)


@pytest.mark.slow
def test_a_lattice_that_is_turned_is_what_its_mesh_would_have_been(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(stage, "_to_look_at", lambda laid, _: laid.kept.inside)
    meshed = Infill(samples.box((40.0, 40.0, 40.0)), TURNED).part
    assert meshed.surface.octants is None
    one, two = turned().part.report, meshed.report
    assert one.volume_mm3 == pytest.approx(two.volume_mm3, rel=1e-9)
    assert (one.triangles, one.genus, one.bodies) == (two.triangles, two.genus, two.bodies)


@pytest.mark.slow
def test_beams_and_triangles_in_one_file(tmp_path: Path, unmeshed: TrimmedSurface) -> None:
    path = tmp_path / "both.3mf"
    write_3mf_beams(part().part_beams, path, unmeshed)
    from volfrep.io.solid import read_triangles

    found = measure(read_triangles(path))
    assert (found.watertight, found.triangles) == (True, part().part.report.triangles)


@pytest.mark.slow
def test_what_is_inside_is_numbered_a_layer_at_a_time(tmp_path: Path) -> None:
    surface = part(60.0).part.surface
    given = number_vertices(surface, tmp_path / "part.ply", as_text=False)
    beside = surface.octants
    assert beside is not None
    held = 24 * beside.layout.count + 12 * beside.pieces.triangles
    tracemalloc.start()
    try:
        vertices = sum(len(block) for block in given.points())
        triangles = sum(len(block) for block in given.corners())
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    report = part(60.0).part.report
    assert (vertices, triangles) == (report.vertices, report.triangles)
    assert peak < 0.4 * held
