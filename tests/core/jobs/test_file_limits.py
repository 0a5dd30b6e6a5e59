# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files keep within limits by coarser facets, use most of them, and say what that costs."""

import re
from pathlib import Path

import pytest
import trimesh

import samples
from command import run
from volfrep import LatticeSpec, VolfrepError, block, fill, mesh_network, size
from volfrep.design.cells import find_cell
from volfrep.design.costs import FILE_BYTES
from volfrep.design.file_limits import SERVICES, FileLimits, limits_of
from volfrep.io.write.stl import write_stl
from volfrep.jobs.file_limits import fit_within
from volfrep.output.form import files

BOX = samples.box((30.0, 20.0, 20.0))


def part_file(folder: Path) -> Path:
    path = folder / "solid.stl"
    write_stl(BOX, path)
    return path


#: Cells and what is asked of their file: an extension, triangles, MB.
JOBS = [
    (("--cell", "BCC", "--cell-size", 10, "--strut-radius", 1), "stl", 20_000, None),
    (("--cell", "Octet", "--cell-size", 10, "--strut-radius", 0.8), "stl", None, 2.5),
    (("--cell", "CVC", "--cell-size", 10, "--strut-radius", 1), "3mf", None, 0.15),
    (("--cell", "CVC", "--cell-size", 10, "--strut-radius", 1), "ply", 15_000, None),
    (("--cell", "Gyroid", "--cell-size", 10, "--wall-thickness", 1), "stl", 65_000, None),
    (("--cell", "Box", "--cell-size", 5, "--strut-radius", 0.5), "obj", 60_000, 1.4),
]


@pytest.mark.costly_cases("job2")
@pytest.mark.slow_cases("job1", "job3", "job4", "job5")
@pytest.mark.parametrize(
    ("lattice", "extension", "triangles", "megabytes"),
    [pytest.param(*job, id=f"job{k}") for k, job in enumerate(JOBS)],
)
def test_a_file_uses_most_of_its_limits(lattice, extension, triangles, megabytes, tmp_path, capsys):
    out = tmp_path / f"part.{extension}"
    limits = [*(("--max-triangles", triangles) if triangles else ())]
    limits += [*(("--max-size", megabytes) if megabytes else ())]
    part = part_file(tmp_path)
    assert run("fill", part, "-o", out, *lattice, "--shell", 1, *limits) == 0
    mesh = trimesh.load(out, force="mesh")
    used = [len(mesh.faces) / triangles] if triangles else []
    used += [out.stat().st_size / 1e6 / megabytes] if megabytes else []
    assert 0.7 <= max(used) <= 1.0
    said = capsys.readouterr().err
    assert re.search(r"facets along a cell in place of \d+: they stray [\d.e-]+ mm", said)


@pytest.mark.costly
def test_a_file_within_its_limits_is_as_fine_as_ever(tmp_path, capsys):
    lattice = ("--cell", "BCC", "--cell-size", 10, "--strut-radius", 1, "--count", "2,2,2")
    plain, limited = tmp_path / "plain.stl", tmp_path / "limited.stl"
    assert run("block", "-o", plain, *lattice) == 0
    assert run("block", "-o", limited, *lattice, "--service", "shapeways") == 0
    assert len(trimesh.load(plain).faces) == len(trimesh.load(limited).faces)
    assert "to keep within" not in capsys.readouterr().err.lower()


def test_a_block_keeps_within_limits(tmp_path):
    lattice = ("--cell", "BCC", "--cell-size", 10, "--strut-radius", 1, "--count", "2,2,2")
    out = tmp_path / "block.stl"
    assert run("block", "-o", out, *lattice, "--max-triangles", 18_000) == 0
    assert 0.7 * 18_000 <= len(trimesh.load(out).faces) <= 18_000


def test_in_python_the_report_tells_what_it_costs():
    part = fill(BOX, cell="BCC", cell_size=10, strut_radius=1, shell=1, max_triangles=20_000)
    assert 14_000 <= part.report.triangles <= 20_000
    assert any("To keep within 20,000 triangles" in text for text in part.report.warnings)
    assert part.report.watertight


def test_a_block_in_python_keeps_within_limits():
    wanted = {"cell": "BCC", "cell_size": 10, "strut_radius": 1}
    part = block((2, 2, 2), **wanted, max_size=0.9)
    assert 0.7 * 0.9e6 <= 84 + 50 * len(part.mesh.faces) <= 0.9e6
    assert part.spec.deviation is None
    assert any("To keep within 0.9 MB" in text for text in part.report.warnings)
    with pytest.raises(VolfrepError, match="at which its lattice keeps its shape"):
        block((2, 2, 2), **wanted, max_triangles=200)


def test_a_graph_in_python_keeps_within_limits():
    graph = ([[0, 0, 0], [20, 0, 0], [20, 20, 0], [0, 0, 15]], [(0, 1), (1, 2), (2, 3)])
    wanted = {"strut_radius": 1, "deviation": 0.005}
    most = int(0.7 * mesh_network(graph, **wanted).report.triangles)
    part = mesh_network(graph, **wanted, max_triangles=most)
    assert 0.5 * most < len(part.mesh.faces) <= most
    assert any("corners round in place of" in text for text in part.report.warnings)
    with pytest.raises(VolfrepError, match="fewest corners round its struts"):
        mesh_network(graph, **wanted, max_triangles=100)


@pytest.mark.slow
def test_a_sized_part_in_python_keeps_within_limits():
    bar = samples.box((20.0, 10.0, 10.0))
    held, pulled = ({"point": [x, 0, 0], "normal": [1, 0, 0]} for x in (0, 20))
    loads = {
        "material": "PA12",
        "support": [{"plane": held, "fixed": True}],
        "case": [{"load": [{"plane": pulled, "force": [20, 0, 0]}]}],
    }
    wanted = {"cell": "BCC", "cell_size": 10, "strut_radius": 1, "shell": 0, "boundary": "whole",
              "safety": 3, "steps": 2, "proof": False}  # fmt: skip
    free = size(bar, loads, **wanted)
    most = int(0.75 * free.report.triangles)
    part = size(bar, loads, **wanted, max_triangles=most)
    assert 0.6 * most < len(part.mesh.faces) <= most
    assert any("facets along a cell in place of" in text for text in part.report.warnings)
    assert (part.sized.radii == free.sized.radii).all()
    with pytest.raises(VolfrepError, match="limits of 'nobody' are not known"):
        size(bar, loads, **wanted, service="nobody")


@pytest.mark.costly
def test_struts_that_would_lose_their_shape_are_refused(tmp_path, capsys):
    out = tmp_path / "part.stl"
    lattice = ("--cell", "BCC", "--cell-size", 10, "--strut-radius", 1)
    assert run("fill", part_file(tmp_path), "-o", out, *lattice, "--max-triangles", 2_000) == 2
    assert "at which its lattice keeps its shape" in capsys.readouterr().err
    assert not out.exists()


def test_a_form_without_a_mesh_has_no_limits(tmp_path, capsys):
    wanted = ("--cell", "BCC", "--max-size", 5)
    assert run("fill", part_file(tmp_path), "-o", tmp_path / "part.inp", *wanted) == 2
    assert "coarser facets of a mesh" in capsys.readouterr().err


#: Triangles of the GE bracket with CVC cells (L = 10, skin 3) whose radius follows the formula
#: 0.6 + 0.6 s, by facets along a cell: joints of 14 to 16 had to be divided.
DIVIDED = {12: 487_414, 13: 487_510, 14: 1_000_294, 15: 1_724_778, 16: 2_037_142, 17: 874_860,
           18: 914_310}  # fmt: skip


@pytest.mark.parametrize(("most", "facets"), [(500_000, 12), (876_000, 17), (910_000, 17)])
def test_finer_facets_that_are_fewer_are_found(most, facets):
    spec = LatticeSpec(find_cell("CVC"), 10.0, strut_radius=0.85, resolution=18)
    made = fit_within(
        spec, FileLimits(most, None),
        lambda wanted: 983_494 * (wanted.facets_along_cell / 18) ** 2,
        lambda wanted: ("", DIVIDED[wanted.facets_along_cell], 0.0),
        50.0,
    )  # fmt: skip
    assert made.spec.facets_along_cell == facets
    assert 0.7 <= made.used <= 1.0


@pytest.mark.parametrize("limits", [FileLimits(1_000_000, None), FileLimits(None, 64.0)])
def test_what_is_far_too_much_is_refused_before_it_is_made(limits):
    spec = LatticeSpec(find_cell("BCC"), 4.0, strut_radius=0.4)
    with pytest.raises(VolfrepError, match="would have about 6,400,000 triangles, more than"):
        fit_within(spec, limits, lambda _: 6.38e6, pytest.fail, 50.0)


@pytest.fixture(scope="module")
def octets():
    return block((3, 2, 2), cell="Octet", cell_size=10, strut_radius=1)


@pytest.mark.parametrize("form", [pytest.param(f, id=f.name) for f in files() if f.bytes_by])
def test_what_a_triangle_takes_in_a_file_is_known(form, octets, tmp_path):
    path = tmp_path / f"block{form.suffixes[0]}"
    octets.save(path)
    told = FILE_BYTES[form.name] * octets.report.triangles
    assert path.stat().st_size == pytest.approx(told, rel=0.1)


def test_services_are_known_by_name_source_and_date():
    assert limits_of("shapeways", None, None) == FileLimits(1_000_000, 64.0)
    assert all(row.source and re.fullmatch(r"20\d\d-\d\d", row.read) for row in SERVICES.values())
    with pytest.raises(VolfrepError, match="choose Shapeways"):
        limits_of("nobody", None, None)
    with pytest.raises(VolfrepError, match="limits of 5 are not known"):
        fill(BOX, cell="BCC", service=5)


def test_struts_of_a_graph_have_fewer_corners(tmp_path, capsys):
    graph = tmp_path / "graph.csv"
    graph.write_text("x1,y1,z1,x2,y2,z2\n0,0,0,20,0,0\n20,0,0,20,20,0\n20,20,0,0,0,15\n")
    out = tmp_path / "graph.stl"
    wanted = ("network", graph, "-o", out, "--strut-radius", 1, "--deviation", 0.005)
    assert run(*wanted) == 0
    before = len(trimesh.load(out).faces)
    most = int(0.7 * before)
    assert run(*wanted, "--max-triangles", most) == 0
    assert 0.5 * most < len(trimesh.load(out).faces) <= most
    assert "corners round in place of" in capsys.readouterr().err
    assert run(*wanted, "--max-triangles", 100) == 2
    assert "With the fewest corners round its struts (10)" in capsys.readouterr().err
