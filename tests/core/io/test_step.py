# SPDX-License-Identifier: LGPL-2.1-or-later
"""STEP text: its grammar and its topology. tests/freecad lets FreeCAD read it."""

import re
import time
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.grid.strut_graph import Wireframe
from volfrep.io.write.step import quoted
from volfrep.io.write.step_faceted import MAX_TRIANGLES, predict_faceted, write_step_faceted
from volfrep.io.write.step_wireframe import predict_wireframe, write_step_wireframe
from volfrep.jobs.blocks import block
from volfrep.mesh.brep import faceted_brep
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate, empty_mesh
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.progress import Monitor


def entities(path: Path) -> dict[int, tuple[str, list[int]]]:
    """Every entity's name and the numbers it refers to, by its number."""
    text = path.read_text(encoding="ascii")
    assert text.startswith("ISO-10303-21;\n")
    assert text.endswith("ENDSEC;\nEND-ISO-10303-21;\n")
    found = {}
    for number, name, rest in re.findall(r"^#(\d+)=\(?(\w+)(.*);$", text, re.MULTILINE):
        assert int(number) not in found
        found[int(number)] = (name, [int(k) for k in re.findall(r"#(\d+)", rest)])
    for _, used in found.values():
        assert all(number in found for number in used)
    for real in re.findall(r"POINT\('',\((.*?)\)\)", text):
        assert all(re.fullmatch(r"-?\d+\.\d*(E[-+]\d+)?", x) for x in real.split(","))
    return found


def small(mesh, size, at):
    return TriangleMesh(mesh.vertices * size + np.array(at, float), mesh.triangles)


def test_a_ball_is_a_closed_solid_of_planes(tmp_path: Path):
    ball = samples.sphere(20.0, 2)
    write_step_faceted(ball, tmp_path / "ball.step")
    found = entities(tmp_path / "ball.step")
    count = Counter(name for name, _ in found.values())
    assert count["ADVANCED_FACE"] == count["PLANE"] == len(ball.triangles) == 320
    assert count["EDGE_CURVE"] == 480
    assert count["VERTEX_POINT"] == len(ball.vertices)
    assert count["MANIFOLD_SOLID_BREP"] == count["CLOSED_SHELL"] == 1
    # Every edge is used twice, once in either direction.
    text = (tmp_path / "ball.step").read_text()
    ways = re.findall(r"ORIENTED_EDGE\('',\*,\*,#(\d+),\.([TF])\.\)", text)
    assert set(Counter(ways).values()) == {1}
    assert len(ways) == 960


def test_voids_and_bodies(tmp_path: Path):
    box = samples.box((1.0, 1.0, 1.0))
    mesh = concatenate(
        small(box, 10, (0, 0, 0)), small(box, 2, (2, 2, 2)).reversed(),
        small(box, 2, (6, 6, 6)).reversed(), small(box, 1, (6.5, 6.5, 6.5)),
        small(box, 4, (20, 0, 0)),
    )  # fmt: skip
    brep = faceted_brep(mesh)
    assert brep.bodies == 3
    assert [len(brep.shells_of(body)) for body in range(3)] == [3, 1, 1]
    write_step_faceted(mesh, tmp_path / "boxes.step")
    count = Counter(name for name, _ in entities(tmp_path / "boxes.step").values())
    assert count["BREP_WITH_VOIDS"] == 1
    assert count["ORIENTED_CLOSED_SHELL"] == 2
    assert count["MANIFOLD_SOLID_BREP"] == 2


def test_a_void_belongs_to_the_body_around_it():
    box = samples.box((1.0, 1.0, 1.0))
    mesh = concatenate(
        small(box, 10, (0, 0, 0)), small(box, 10, (20, 0, 0)), small(box, 2, (24, 4, 4)).reversed()
    )
    brep = faceted_brep(mesh)
    assert [len(brep.shells_of(body)) for body in range(2)] == [1, 2]
    with pytest.raises(VolfrepError, match="outside every body"):
        faceted_brep(
            concatenate(small(box, 10, (0, 0, 0)), small(box, 9, (20, 0, 0)),
                        small(box, 2, (40, 4, 4)).reversed())
        )  # fmt: skip


def test_what_is_not_a_solid(tmp_path: Path):
    box = samples.box()
    path = tmp_path / "box.step"
    for mesh, words in (
        (TriangleMesh(box.vertices, box.triangles[1:]), "3 of its edges"),
        (box.reversed(), "no volume"),
        (empty_mesh(), "empty"),
        (TriangleMesh(box.vertices, np.tile(box.triangles, (MAX_TRIANGLES // 12 + 1, 1))), "STL"),
    ):
        with pytest.raises(VolfrepError, match=words):
            write_step_faceted(mesh, path)
    with pytest.raises(Cancelled):
        write_step_faceted(box, path, Monitor(lambda *_: False))
    assert not list(tmp_path.iterdir())


@pytest.mark.costly
def test_a_hundred_thousand_triangles_take_seconds(tmp_path: Path):
    ball = samples.sphere(20.0, 6)
    start = time.process_time()
    write_step_faceted(ball, tmp_path / "ball.step")
    assert (time.process_time() - start) * 100_000 / len(ball.triangles) < 5
    seconds, megabytes = predict_faceted(len(ball.triangles))
    assert (tmp_path / "ball.step").stat().st_size / 1e6 == pytest.approx(megabytes, rel=0.1)
    assert seconds < 3


def test_the_axes_share_their_points(tmp_path: Path):
    spec = LatticeSpec(cell="Octet", cell_size=10, strut_radius=1, resolution=8)
    frame = block(spec, (2, 1, 1)).wireframe
    path = tmp_path / "it's über.step"
    write_step_wireframe(frame, path)
    found = entities(path)
    lines = [used for name, used in found.values() if name == "POLYLINE"]
    assert len(lines) == len(frame.struts)
    first = min(min(used) for used in lines)
    assert np.array_equal(np.array(lines) - first, frame.struts)
    points = re.findall(r"#(\d+)=CARTESIAN_POINT\('',\((.*)\)\)", path.read_text())
    read = {int(k): [float(x) for x in at.split(",")] for k, at in points}
    assert np.array([read[first + k] for k in range(len(frame.nodes))]) == pytest.approx(
        frame.nodes
    )
    assert "'it''s \\X4\\000000FC\\X0\\ber'" in path.read_text()


def test_many_axes_take_a_moment(tmp_path: Path):
    rng = np.random.default_rng(0)
    frame = Wireframe(
        rng.random((20_000, 3)) * 100,
        rng.integers(0, 20_000, (46_656, 2), dtype=np.int32),
        np.ones((46_656, 2)),
        np.ones(20_000),
    )
    start = time.process_time()
    write_step_wireframe(frame, tmp_path / "axes.step")
    assert time.process_time() - start < 2
    assert (tmp_path / "axes.step").stat().st_size / 1e6 == pytest.approx(
        predict_wireframe(46_656)[1], rel=0.3
    )


def test_no_axes(tmp_path: Path):
    nothing = Wireframe(np.zeros((0, 3)), np.zeros((0, 2), np.int32), np.zeros((0, 2)), np.zeros(0))
    with pytest.raises(VolfrepError, match="no struts"):
        write_step_wireframe(nothing, tmp_path / "axes.step")


def test_text_of_any_alphabet():
    assert quoted("a\\b") == "a\\\\b"
    assert quoted("Δ") == "\\X4\\00000394\\X0\\"
