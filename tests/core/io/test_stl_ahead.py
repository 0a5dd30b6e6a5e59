# SPDX-License-Identifier: LGPL-2.1-or-later
"""STL files that are begun before all of the surface is known."""

from __future__ import annotations

import errno
import shutil
from collections import namedtuple
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest

import command
import samples
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.grading import RadiusGrading
from volfrep.design.profile import Profile
from volfrep.io.write import stl_ahead as module
from volfrep.io.write.stl import FACET, HEADER_BYTES, write_stl
from volfrep.io.write.stl_ahead import stl_ahead
from volfrep.io.write.stl_octants import write_surface_stl
from volfrep.jobs import infill as infill_module
from volfrep.jobs.infill import Infill
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.trim.placed_lattice import InnerOctants
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor

SPEC = LatticeSpec("CVC", 5.0, 0.5, shell=1.0, resolution=6)
GRADED = replace(SPEC, radius_grading=RadiusGrading("skin", Profile("linear", 0.5, 0.4), reach=5.0))
NAMES = ("begun", "meshed")
fill = partial(command.fill, ["--cell", "CVC", "--cell-size", "6", "--strut-radius", "0.6"])


@cache
def made(spec: LatticeSpec) -> tuple[TrimmedSurface, InnerOctants]:
    """A part's surface, and the octants that were told ahead."""
    told: list[InnerOctants] = []
    job = Infill(samples.box((30.0, 26.0, 26.0)), spec)
    job.ahead = told.append
    surface = job.part.surface
    assert len(told) == 1
    return surface, told[0]


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


def write_begun(
    path: Path, told: InnerOctants, surface: TrimmedSurface, monitor: Monitor | None = None
) -> None:
    """A file with the octants that were told first."""
    with stl_ahead(path) as ahead:
        ahead.begin(told)
        ahead.finish(surface, monitor)


@pytest.mark.slow_cases("none goes-graded")
@pytest.mark.parametrize("spec", [SPEC, GRADED], ids=["even", "graded"])
@pytest.mark.parametrize("step", [0, 2, 7], ids=["none goes", "half go", "most go"])
def test_the_file_is_the_same_begun_or_not(tmp_path: Path, spec: LatticeSpec, step: int) -> None:
    surface, told = made(spec)
    if step:
        surface = some_in_the_mesh(surface, step)
    with stl_ahead(tmp_path / "begun.stl") as ahead:
        ahead.begin(told)
        ahead.begin(told)  # as of another try
        ahead.finish(surface)
    write_surface_stl(surface, tmp_path / "once.stl")
    begun, once = ((tmp_path / f"{name}.stl").read_bytes() for name in ("begun", "once"))
    assert begun == once
    write_stl(surface.whole(Monitor()), tmp_path / "meshed.stl")
    np.testing.assert_array_equal(*(corners(tmp_path / f"{name}.stl") for name in NAMES))


def test_octants_whose_places_nothing_could_fill(tmp_path: Path) -> None:
    surface, told = made(SPEC)
    few = some_in_the_mesh(surface, 3)
    less = TrimmedSurface(TriangleMesh(few.mesh.vertices, few.mesh.triangles[:50]), few.octants)
    write_begun(tmp_path / "begun.stl", told, less)
    write_surface_stl(less, tmp_path / "once.stl")
    assert (tmp_path / "begun.stl").read_bytes() == (tmp_path / "once.stl").read_bytes()
    assert len(corners(tmp_path / "begun.stl")) == less.triangles


def test_a_surface_without_octants_beside_it(tmp_path: Path) -> None:
    surface, told = made(SPEC)
    whole = TrimmedSurface(surface.whole(Monitor()))
    write_begun(tmp_path / "begun.stl", told, whole)
    write_stl(whole.mesh, tmp_path / "mesh.stl")
    assert (tmp_path / "begun.stl").read_bytes() == (tmp_path / "mesh.stl").read_bytes()
    assert {path.name for path in tmp_path.iterdir()} == {"begun.stl", "mesh.stl"}


@pytest.fixture
def target(tmp_path: Path) -> Iterator[Path]:
    """A file that has to stay as it is, alone in its folder."""
    path = tmp_path / "target" / "part.stl"
    path.parent.mkdir()
    path.write_bytes(b"as it was")
    yield path
    assert path.read_bytes() == b"as it was"
    assert list(path.parent.iterdir()) == [path]


def test_what_is_not_finished_goes(target: Path) -> None:
    with stl_ahead(target) as ahead:
        ahead.begin(made(SPEC)[1])
        assert len(list(target.parent.iterdir())) == 2, "beside the target"


def test_what_is_interrupted_goes(target: Path) -> None:
    surface, told = made(SPEC)
    with pytest.raises(Cancelled):
        write_begun(target, told, surface, Monitor(lambda fraction, name: False))


def test_a_disk_that_is_full(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    surface, told = made(SPEC)

    def full(*_: object) -> Iterator[object]:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(module, "octant_copies", full)
        with pytest.raises(VolfrepError, match=r"Cannot write '.*part\.stl': No space left"):
            write_begun(target, told, surface)
    usage = namedtuple("usage", "total used free")
    size = told.layout.triangles * FACET.itemsize
    # Too little for the octants, and for what follows on them.
    for free, left in (([1e5], "0.0001"), ([size + 100, 100], "1e-07")):
        some = iter(free)
        monkeypatch.setattr(shutil, "disk_usage", lambda path, some=some: usage(0, 0, next(some)))
        with pytest.raises(VolfrepError, match=rf"the disk has {left} GB left"):
            write_begun(target, told, surface)


def test_the_command_begins_a_file_and_a_refused_job_leaves_nothing(
    target: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    part = tmp_path / "box.stl"
    write_stl(samples.box((30.0, 26.0, 26.0)), part)
    begun: list[int] = []
    begin = module.StlAhead.begin

    def counted(self: module.StlAhead, inner: InnerOctants) -> None:
        begun.append(int(inner.where.sum()))
        begin(self, inner)

    monkeypatch.setattr(module.StlAhead, "begin", counted)
    assert fill(part, tmp_path / "out.stl", "--quiet") == 0
    assert len(begun) == 1
    assert begun[0] > 0

    def refused(*_: object) -> None:
        assert len(list(target.parent.iterdir())) == 2, "a file is begun"
        raise VolfrepError("Nothing is right.")

    monkeypatch.setattr(infill_module, "finish", refused)
    assert fill(part, target, "--quiet") == 2
    assert "Nothing is right." in capsys.readouterr().err
