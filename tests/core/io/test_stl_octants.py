# SPDX-License-Identifier: LGPL-2.1-or-later
"""STL files of a surface whose octants inside are written as they are placed."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.design.grading import RadiusGrading
from volfrep.design.profile import Profile
from volfrep.io.write import stl
from volfrep.io.write.stl import FACET, HEADER_BYTES, write_stl
from volfrep.io.write.stl_octants import write_surface_stl
from volfrep.jobs.infill import Infill
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.process.pool import WorkerPool, processes
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.progress import Monitor

SPEC = LatticeSpec("CVC", 5.0, 0.5, shell=1.0, resolution=6)
GRADED = replace(SPEC, radius_grading=RadiusGrading("skin", Profile("linear", 0.5, 0.4), reach=5.0))


@cache
def made(spec: LatticeSpec) -> TrimmedSurface:
    """A part's surface."""
    return Infill(samples.box((30.0, 26.0, 26.0)), spec).part.surface


def corners(path: Path) -> np.ndarray:
    """(m, 9) a file's triangles, each beginning with its least corner, sorted."""
    data = path.read_bytes()
    found = np.frombuffer(data, FACET, offset=HEADER_BYTES + 4)["corners"]
    assert int.from_bytes(data[HEADER_BYTES : HEADER_BYTES + 4], "little") == len(found)
    order = np.lexsort(found.transpose(2, 0, 1)[::-1], axis=1)[:, 0]
    turned = found[np.arange(len(found))[:, None], (order[:, None] + np.arange(3)) % 3]
    flat = turned.reshape(-1, 9)
    return flat[np.lexsort(flat.T[::-1])]


def some_in_the_mesh(surface: TrimmedSurface, step: int) -> TrimmedSurface:
    """The surface with all but each `step`th of the octants beside it in its mesh."""
    beside = surface.octants
    assert beside is not None
    places = np.argwhere(beside.where)
    where = beside.where.copy()
    where[tuple(places[::step].T)] = False
    return surface.with_octants(where, Monitor())


@pytest.mark.costly
@pytest.mark.slow_but("none goes-even", "half go-graded")
@pytest.mark.parametrize("spec", [SPEC, GRADED], ids=["even", "graded"])
@pytest.mark.parametrize("step", [0, 2, 7], ids=["none goes", "half go", "most go"])
def test_the_file_holds_the_triangles_of_the_whole_mesh(
    tmp_path: Path, spec: LatticeSpec, step: int
) -> None:
    surface = made(spec)
    if step:
        surface = some_in_the_mesh(surface, step)
    write_surface_stl(surface, tmp_path / "placed.stl")
    write_stl(surface.whole(Monitor()), tmp_path / "meshed.stl")
    np.testing.assert_array_equal(
        *(corners(tmp_path / f"{name}.stl") for name in ("placed", "meshed"))
    )


def test_octants_whose_places_nothing_could_fill(tmp_path: Path) -> None:
    few = some_in_the_mesh(made(SPEC), 3)
    less = TrimmedSurface(TriangleMesh(few.mesh.vertices, few.mesh.triangles[:50]), few.octants)
    write_surface_stl(less, tmp_path / "placed.stl")
    assert len(corners(tmp_path / "placed.stl")) == less.triangles


def test_a_surface_without_octants_beside_it(tmp_path: Path) -> None:
    whole = TrimmedSurface(made(SPEC).whole(Monitor()))
    write_surface_stl(whole, tmp_path / "placed.stl")
    write_stl(whole.mesh, tmp_path / "mesh.stl")
    assert (tmp_path / "placed.stl").read_bytes() == (tmp_path / "mesh.stl").read_bytes()


@pytest.mark.costly
def test_processes_write_what_threads_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    surface = some_in_the_mesh(made(SPEC), 2)
    write_surface_stl(surface, tmp_path / "here.stl")
    monkeypatch.setattr(stl, "CALL_FACETS", 20_000)
    with processes(2) as executor:
        assert isinstance(executor, WorkerPool)
        write_surface_stl(surface, tmp_path / "there.stl", executor=executor)
        assert executor.workers, "they were asked"
        for worker in executor.workers:
            worker.kill()
        write_surface_stl(surface, tmp_path / "lost.stl", executor=executor)
    write_surface_stl(surface, tmp_path / "after.stl", executor=executor)
    here = (tmp_path / "here.stl").read_bytes()
    for name in ("there", "lost", "after"):
        assert (tmp_path / f"{name}.stl").read_bytes() == here
