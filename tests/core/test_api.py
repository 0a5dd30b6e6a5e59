# SPDX-License-Identifier: LGPL-2.1-or-later
"""The few names that a script's author uses."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

import samples
import volfrep
from volfrep import LatticeSpec, VolfrepError
from volfrep.api import specified
from volfrep.design.tpms import PeriodicSurface, TpmsSheet
from volfrep.jobs import workers
from volfrep.process.pool import WorkerPool
from volfrep.trim import octant_groups

BOX = {"cell": "CVC", "cell_size": 10, "strut_radius": 1, "shell": 2, "resolution": 10}


@pytest.fixture(scope="module")
def part() -> volfrep.Part:
    return volfrep.fill(samples.box(), **BOX)


@pytest.mark.costly
def test_a_part_is_the_same_from_a_file_a_mesh_and_arrays(
    tmp_path: Path, part: volfrep.Part
) -> None:
    box = samples.box()
    mesh = trimesh.Trimesh(box.vertices, box.triangles, process=False)
    mesh.export(tmp_path / "box.stl")
    alike = SimpleNamespace(vertices=box.vertices.tolist(), faces=box.triangles.tolist())
    given = (tmp_path / "box.stl", str(tmp_path / "box.stl"), mesh, alike)
    # Of what they share by content no stage is computed twice; what differed would be anew.
    for one in (*given, (box.vertices, box.triangles)):
        same = volfrep.fill(one, LatticeSpec(**BOX), cache=part.cache)
        assert same.report.volume_mm3 == pytest.approx(part.report.volume_mm3, rel=1e-9)


def test_walls_are_asked_for_as_on_the_command_line() -> None:
    spec = specified(None, {"cell": "Gyroid", "cell_size": 8, "wall_thickness": 0.8}, None)
    assert spec == LatticeSpec("Gyroid", 8, wall=TpmsSheet("sheet", 0.8))
    other = specified(spec, {"wall_kind": "skeleton", "wall_offset": 0.2}, None)
    assert other.wall == TpmsSheet("skeleton", 0.8, 0.2)
    own = specified(None, {"wall_formula": "cos(x) + cos(y) + cos(z)"}, None)
    assert isinstance(own.cell, PeriodicSurface)
    assert own.cell.formula == "cos(x) + cos(y) + cos(z)"
    with pytest.raises(VolfrepError, match="of the cell Formula"):
        specified(None, {"cell": "Gyroid", "wall_formula": "x"}, None)
    with pytest.raises(VolfrepError, match="did you mean 'wall_kind'"):
        specified(None, {"wall_kin": "sheet"}, None)


def test_a_part_shows_its_mesh_struts_and_figures(part: volfrep.Part) -> None:
    assert isinstance(part.mesh, trimesh.Trimesh)
    assert part.mesh.is_watertight
    assert part.mesh.volume == pytest.approx(part.report.volume_mm3)
    assert len(part.struts.struts) == part.report.struts
    assert part.report.mass_g == pytest.approx(part.mesh.volume / 1000.0)


@pytest.mark.parametrize("kind", ["stl", "3mf", "ply", "obj", "off", "glb"])
def test_a_part_saves_itself(tmp_path: Path, part: volfrep.Part, kind: str) -> None:
    part.save(tmp_path / f"light.{kind}")
    again = volfrep.read_solid(tmp_path / f"light.{kind}")
    assert again.volume == pytest.approx(part.mesh.volume, rel=1e-4)


def test_workers_of_a_fill_stay_for_the_next_one_and_the_mesh_is_the_same(
    tmp_path: Path, part: volfrep.Part, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", 6_000)
    alone = volfrep.fill(samples.box(), cache=part.cache, workers=1, **BOX)
    with workers.kept_workers(2) as kept:
        assert isinstance(kept, WorkerPool)
        assert kept.elsewhere(int).result() == 0
    assert alone.report.workers_memory_mb == 0
    for count in (2, None):
        monkeypatch.setattr(workers, "worth_untold", lambda *_, **__: 2)
        one = volfrep.fill(samples.box(), cache=part.cache, workers=count, **BOX)
        assert one.result.mesh.vertices.tobytes() == alone.result.mesh.vertices.tobytes()
        assert one.result.mesh.triangles.tobytes() == alone.result.mesh.triangles.tobytes()
        assert one.report.workers_memory_mb > 10 or not sys.platform.startswith("linux")
    with workers.kept_workers(2) as again:
        assert again is kept
    assert len(kept.workers) == 1
    workers.end_kept_workers()
    assert not kept.is_open
    one.save(tmp_path / "after.stl")
    with pytest.raises(VolfrepError, match="leave 'workers' out"):
        volfrep.fill(samples.box(), workers=2, executor=kept, **BOX)


def test_a_part_is_held_against_a_printer(part: volfrep.Part) -> None:
    report = part.check("SLS")
    assert report.thinnest_strut_mm == pytest.approx(2.0)
    assert report.mass_g == pytest.approx(part.report.mass_g)
    with pytest.raises(VolfrepError, match="FDMX"):
        part.check("FDMX")


def test_parameters_go_on_top_of_a_specification() -> None:
    spec = LatticeSpec("Box", 10, 1, shell=0)
    cube = volfrep.block((1, 1, 1), spec, strut_radius=2)
    assert cube.spec.strut_radius == 2
    assert cube.spec.unit_cell().name == "Box"


def test_a_misspelt_parameter_is_told_with_the_nearest_one() -> None:
    with pytest.raises(VolfrepError, match="'strut_radios': did you mean 'strut_radius'"):
        volfrep.block((1, 1, 1), strut_radios=1)
    with pytest.raises(VolfrepError, match="'zzz': there are activation,"):
        volfrep.block((1, 1, 1), zzz=1)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (7, "not int"),
        ((np.zeros((3, 2)), np.zeros((1, 3), int)), r"shapes \(3, 2\) and \(1, 3\)"),
        ((np.zeros((3, 3)), np.zeros((1, 3))), "whole numbers"),
        ((np.zeros((3, 3)), np.array([[0, 1, 3]])), "not among the 3"),
        ((np.full((3, 3), np.nan), np.array([[0, 1, 2]])), "not a finite number"),
        ((np.eye(3), np.array([[0, 1, 2]])), "mesh"),
    ],
)
def test_what_is_no_solid_is_refused_in_a_sentence(given: object, words: str) -> None:
    with pytest.raises(VolfrepError, match=words):
        volfrep.fill(given, **BOX)  # type: ignore[arg-type]


def test_a_unit_belongs_to_a_file(tmp_path: Path) -> None:
    with pytest.raises(VolfrepError, match="unit belongs to a file"):
        volfrep.fill(samples.box(), unit="cm", **BOX)
    samples_box = trimesh.creation.box((4, 3, 2))
    samples_box.export(tmp_path / "box.stl")
    part = volfrep.fill(tmp_path / "box.stl", unit="cm", **BOX)
    assert np.ptp(part.mesh.bounds, axis=0) == pytest.approx((40, 30, 20))


@pytest.mark.slow
def test_a_picture_shows_skin_lattice_and_cut_in_their_colours(
    tmp_path: Path, part: volfrep.Part
) -> None:
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    from PIL import Image

    part.plot(tmp_path / "cut.png", size=(400, 300))
    cut = np.asarray(Image.open(tmp_path / "cut.png").convert("RGB")).astype(int)
    assert cut.shape == (300, 400, 3)
    red, _, blue = cut.reshape(-1, 3).T
    orange = (red > 180) & (blue < 90)
    assert orange.mean() > 0.01
    assert ((blue > red + 60) & (blue > 120)).mean() > 0.003
    part.plot(tmp_path / "whole.png", cut=False, size=(400, 300))
    whole = np.asarray(Image.open(tmp_path / "whole.png").convert("RGB")).astype(int)
    assert not ((whole[..., 0] > 180) & (whole[..., 2] < 90)).any()


def test_a_picture_that_cannot_be_written_is_refused_before_it_is_drawn(
    tmp_path: Path, part: volfrep.Part
) -> None:
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    with pytest.raises(VolfrepError, match=r"ends in \.png"):
        part.plot(tmp_path / "cut.jpg")
    with pytest.raises(VolfrepError, match="no folder"):
        part.plot(tmp_path / "nowhere" / "cut.png")
