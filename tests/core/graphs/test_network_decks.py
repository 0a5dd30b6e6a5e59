# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks for a solver, sized for loads, moved and turned."""

import json
import shutil

import numpy as np
import pytest
import trimesh

from volfrep import LatticeSpec, VolfrepError
from volfrep.cli import command as cli
from volfrep.design.cells import make_cell
from volfrep.design.grading import Orientation
from volfrep.design.graphs import RandomGraph, make_network
from volfrep.fem.beam_mesh import JOINT_LENGTH, fitted_beams
from volfrep.io.solid import check_solid
from volfrep.jobs.infill import Infill
from volfrep.jobs.kinds.graphs import frame_alone
from volfrep.jobs.sizing import Goal, size
from volfrep.loads.load_file import read_load_cases
from volfrep.mesh.triangle_mesh import TriangleMesh

NODES = [[0, 0, 0], [12, 0, 0], [0, 12, 0], [0, 0, 12]]
STRUTS = [(0, 1), (0, 2), (0, 3), (1, 2), (2, 3), (1, 3)]
LOADS = """material = "Ti-6Al-4V"
[[support]]
plane = { point = [0, 0, -10], normal = [0, 0, 1] }
fixed = true
[[case]]
name = "bent"
[[case.load]]
plane = { point = [0, 0, 10], normal = [0, 0, 1] }
force = [200, 0, 0]
"""


def cube():
    box = trimesh.creation.box((20, 20, 20))
    return check_solid(TriangleMesh(box.vertices, box.faces.astype(np.int32)), "cube")


def graph(folder):
    path = folder / "graph.json"
    path.write_text(json.dumps({"nodes": NODES, "struts": STRUTS}))
    return path


def test_a_networks_beams_have_rigid_ends_and_say_so():
    frame, _ = frame_alone(LatticeSpec(strut_radius=0.6, network=make_network(NODES, STRUTS)))
    model, said = fitted_beams(frame, None, None, 10.0)
    assert all(end.length == JOINT_LENGTH for end in model.ends)
    assert "rigid ends" in said[0]
    # Each strut has two of them, as long as that.
    ends = model.elements[model.is_joint]
    assert len(ends) == 2 * len(STRUTS)
    lengths = np.linalg.norm(model.nodes[ends[:, 1]] - model.nodes[ends[:, 0]], axis=1)
    np.testing.assert_allclose(lengths, 0.6 * JOINT_LENGTH, rtol=1e-6)


@pytest.mark.costly
def test_decks_of_a_graph_alone_and_in_a_part(tmp_path, capsys):
    path, out = graph(tmp_path), tmp_path / "deck.inp"
    assert cli.run(["network", str(path), "-o", str(out), "--strut-radius", "0.6"]) == 0
    assert "as beams" in capsys.readouterr().out
    assert "*BEAM SECTION" in out.read_text()
    lines = tmp_path / "axes.step"
    assert cli.run(["network", str(path), "-o", str(lines), "--step", "wireframe"]) == 0
    part = tmp_path / "cube.stl"
    trimesh.creation.box((20, 20, 20)).export(part)
    fill = ["fill", str(part), "--network", "voronoi", "--network-points", "20", "--strut-radius"]
    assert cli.run([*fill, "0.3", "--shell", "1", "-o", str(out)]) == 0
    assert "rigid ends" in capsys.readouterr().err


@pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not installed")
def test_a_graph_alone_as_tetrahedra_has_its_volume(tmp_path, capsys):
    out = tmp_path / "deck.inp"
    words = ["network", str(graph(tmp_path)), "-o", str(out), "--inp", "tetrahedra"]
    assert cli.run([*words, "--strut-radius", "0.6", "--quiet"]) == 0
    assert "type=c3d10" in out.read_text().lower()
    assert capsys.readouterr().err == ""


@pytest.mark.slow
def test_a_voronoi_network_sized_for_a_load_is_stiffer_and_stays_the_same_graph(tmp_path):
    (tmp_path / "loads.toml").write_text(LOADS)
    solid = cube()
    loads = read_load_cases(tmp_path / "loads.toml", solid)
    spec = LatticeSpec(strut_radius=0.4, shell=0, network=RandomGraph(points=20))
    made = size(solid, spec, loads, Goal(), most_steps=8, prove_it=False)
    assert made.sized.analysis.compliance.sum() < 0.95 * made.before.compliance.sum()
    assert made.radii.max() <= 0.8 + 1e-6  # no more than twice the radius that was asked for
    # Thicker struts do not move what short ones are drawn together to.
    again = Infill(solid, made.spec).struts
    np.testing.assert_array_equal(again.struts, made.model.wireframe.struts)
    placed = np.zeros(len(made.radii))
    placed[again.struts] = again.radii
    np.testing.assert_allclose(placed, made.radii, atol=1e-9)


def test_struts_of_several_widths_are_not_sized(tmp_path):
    (tmp_path / "loads.toml").write_text(LOADS)
    solid = cube()
    loads = read_load_cases(tmp_path / "loads.toml", solid)
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    cell = make_cell("two", corners, [(0, 1), (0, 2), (0, 3)], widths=[1, 1, 2])
    spec = LatticeSpec(cell, cell_size=5, strut_radius=0.3, shell=1)
    with pytest.raises(VolfrepError, match="widths of their own"):
        size(solid, spec, loads)


def test_a_graph_is_moved_by_its_origin_and_turned_about_a_point():
    network = make_network(NODES, STRUTS)
    turn = Orientation((0, 0, 1), 90.0, (0.0, 0.0, 0.0))
    spec = LatticeSpec(strut_radius=0.5, network=network, origin=(5, 0, 0), orientation=turn)
    frame, _ = frame_alone(spec)
    wanted = [[0, 5, 0], [0, 17, 0], [-12, 5, 0], [0, 5, 12]]
    np.testing.assert_allclose(frame.nodes, wanted, atol=1e-9)
    inside = Infill(cube(), LatticeSpec(
        strut_radius=0.5, shell=1, network=network, origin=(-4, -4, -4),
        orientation=Orientation((0, 0, 1), 90.0, (-4.0, -4.0, -4.0)),
    ))  # fmt: skip
    np.testing.assert_allclose(inside.struts.nodes[1], [-4, 8, -4], atol=0.01)


@pytest.mark.slow
def test_cells_of_any_box_are_turned_and_still_cover_the_part():
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    cell = make_cell("flat", corners, [(0, 1), (0, 2), (0, 3)], edges=(1, 1, 0.5))
    turn = Orientation((0, 0, 1), 30.0)
    infill = Infill(cube(), LatticeSpec(cell, 5, 0.4, 1.0, orientation=turn))
    nodes = infill.struts.nodes
    assert (nodes.max(axis=0) > 8.99).all()
    assert (nodes.min(axis=0) < -8.99).all()
    along = np.diff(nodes[infill.struts.struts], axis=1)[:, 0]
    flat = along[np.abs(along[:, 2]) < 1e-6]
    angle = np.degrees(np.arctan2(flat[:, 1], flat[:, 0])) % 90.0
    np.testing.assert_allclose(angle, 30.0, atol=1e-6)
    assert infill.part.report.watertight


def test_random_points_are_neither_turned_nor_moved():
    for where in ({"orientation": Orientation((0, 0, 1), 30.0)}, {"origin": (1, 2, 3)}):
        with pytest.raises(VolfrepError, match="random points"):
            LatticeSpec(network=RandomGraph(), **where)


def test_what_is_about_whole_cells_is_refused_beside_a_network():
    for what in ({"activation": "inside"}, {"boundary": "whole", "shell": 1.0}):
        with pytest.raises(VolfrepError, match="for cells and not for a network"):
            LatticeSpec(network=RandomGraph(), **what)
    # Without a skin a whole network is one that nothing cuts.
    assert LatticeSpec(network=RandomGraph(), boundary="whole", shell=0).network
