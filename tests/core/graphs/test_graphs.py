# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks in parts: from files, random, trimmed, skinned, graded, on the command line."""

import json
import zipfile

import numpy as np
import pytest

import samples
import volfrep
from exact import volume_of_struts
from volfrep import LatticeSpec, StageCache, VolfrepError
from volfrep.cli import command as cli
from volfrep.design.grading import RadiusGrading, SizeGrading
from volfrep.design.graphs import GivenGraph, RandomGraph, make_network
from volfrep.design.graphs.files import read_network
from volfrep.design.parameters.specification import specification, values_of
from volfrep.design.profile import Profile
from volfrep.graphs.random_graph import merge_short_struts, without_narrow
from volfrep.io.write.stl import as_read
from volfrep.io.write.threemf import write_3mf_beams
from volfrep.jobs.infill import Infill
from volfrep.jobs.kinds.graphs import mesh_graph_alone
from volfrep.mesh.quality import measure
from volfrep.trim.beam_model import BeamModel

NODES = [[0, 0, 0], [12, 0, 0], [0, 12, 0], [0, 0, 12]]
STRUTS = [(0, 1), (0, 2), (0, 3), (1, 2), (2, 3), (1, 3)]
_stages = StageCache()


def written(folder):
    """The same tetrahedron in every format."""
    data = {"nodes": NODES, "struts": STRUTS, "radii": [0.5] * 6}
    (folder / "a.json").write_text(json.dumps(data))
    rows = [[*NODES[a], *NODES[b], 0.5] for a, b in STRUTS]
    lines = "x1,y1,z1,x2,y2,z2,r\n" + "\n".join(",".join(map(str, row)) for row in rows)
    (folder / "a.csv").write_text(lines)
    points = "\n".join("v {} {} {}".format(*node) for node in NODES)
    (folder / "a.obj").write_text(points + "\nl 1 2 3 1 4 2\nl 4 3 # the last\n")
    flat = "\n".join("{} {} {}".format(*node) for node in NODES)
    head = f"# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n{flat}\n"
    (folder / "a.vtk").write_text(head + "LINES 2 10\n6 0 1 2 0 3 1\n2 3 2\n")
    new = (
        head + "LINES 3 8\nOFFSETS vtktypeint64\n0 6 8\nCONNECTIVITY vtktypeint64\n0 1 2 0 3 1 3 2"
    )
    (folder / "b.vtk").write_text(new)
    frame = mesh_graph_alone(LatticeSpec(network=read_network(folder / "a.json"))).wireframe
    write_3mf_beams(BeamModel(frame), folder / "a.3mf")
    return [folder / name for name in ("a.json", "a.csv", "a.obj", "a.vtk", "b.vtk", "a.3mf")]


def lengths(network):
    span = network.nodes[network.struts[:, 1]] - network.nodes[network.struts[:, 0]]
    return np.sort(np.linalg.norm(span, axis=1))


def test_every_format_gives_the_same_network(tmp_path):
    wanted = [12.0] * 3 + [12.0 * 2**0.5] * 3
    for path in written(tmp_path):
        found = read_network(path)
        assert found.source == str(path)
        assert found.nodes.shape == (4, 3)
        assert lengths(found) == pytest.approx(wanted), path
        if path.suffix in (".json", ".csv", ".3mf"):
            assert found.radii == pytest.approx(np.full((6, 2), 0.5))
        else:
            assert not len(found.radii)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.json", "{", "cannot be read"),
        ("a.json", "[]", "must be an object with 'nodes' and 'struts'"),
        ("a.json", '{"nodes": [[0, 0, 0], [1, 0, 0]], "struts": [[0, 2]]}', "strut 0 must name"),
        ("a.json", '{"nodes": [[0, 0, 0], [0, 0, 0]], "struts": [[0, 1]]}', "strut 0 joins node"),
        ("a.json", '{"nodes": [[0, 0, 0], [1, 0, 0]], "struts": [[0, 1]], "radii": [-1]}',
         "radius that is not above 0"),
        ("a.json", '{"nodes": [[0, 0, 0], [1, 0, 0]], "struts": [[0, 1]], "radii": [1, 2, 3]}',
         "radii must be one for each strut"),
        ("a.csv", "1,2,3\n", "every line must hold x, y, z of both ends"),
        ("a.csv", "0,0,0,1,0,nan\n", "not finite"),
        ("a.csv", "0,0,0,1,0,zero\n1,2,3,4,5,x", "cannot be read"),
        ("a.obj", "v 0 0 0\nf 1 1 1\n", "holds no lines"),
        ("a.vtk", "# vtk\nx\nBINARY\nLINES 1 2", "is binary"),
        ("a.vtk", "# vtk\nx\nASCII\n", "is damaged"),
        ("a.3mf", "x", "is no 3MF"),
        ("a.stl", "x", "choose one of .json"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_network_file(tmp_path, name, text, message):
    (tmp_path / name).write_text(text)
    with pytest.raises(VolfrepError, match=message):
        read_network(tmp_path / name)


def test_a_3mf_without_beams_or_with_entities_is_refused(tmp_path):
    for text, message in (
        ("<model/>", "no beam lattice"),
        ("<!DOCTYPE x><model/>", "declarations"),
    ):
        with zipfile.ZipFile(tmp_path / "a.3mf", "w") as archive:
            archive.writestr("3D/3dmodel.model", text)
        with pytest.raises(VolfrepError, match=message):
            read_network(tmp_path / "a.3mf")


def test_short_struts_are_drawn_together_and_narrow_ones_go():
    nodes = np.array([[0, 0, 0], [0.5, 0, 0], [9, 0, 0], [9, 1, 0], [-9, 0, 0]], float)
    struts = np.array([[0, 1], [1, 2], [1, 3], [0, 4]])
    nodes, struts = merge_short_struts(nodes, struts, 1.0)
    assert len(nodes) == 4
    assert len(struts) == 3
    kept = without_narrow(nodes, struts, 20.0)
    assert len(kept) == 2
    span = nodes[kept[:, 1]] - nodes[kept[:, 0]]
    assert np.linalg.norm(span, axis=1).max() < 9.3


def random_spec(**more):
    wanted = {"kind": "voronoi", "points": 60} | more
    return LatticeSpec(strut_radius=0.4, shell=1.5, network=RandomGraph(**wanted))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["voronoi", "delaunay"])
def test_a_random_network_in_a_part_with_a_skin_is_one_body(kind):
    solid = samples.bracket(17.0)
    infill = Infill(solid, random_spec(kind=kind), cache=_stages)
    report, read = infill.part.report, measure(as_read(infill.part.mesh))
    assert read.watertight
    assert read.bodies == report.bodies == 1
    assert read.degenerate_triangles == 0
    assert report.cells_total == 0
    # Struts end on the wall: their axes do, and the mesh is within the part.
    ends = infill.axes
    assert ends.on_boundary.sum() > 30
    np.testing.assert_allclose(infill.part.mesh.bounds, solid.bounds, atol=1e-5)
    length = np.linalg.norm(
        np.diff(infill.struts.nodes[infill.struts.struts], axis=1)[:, 0], axis=1
    )
    assert length.min() >= 4 * 0.4 - 1e-9


@pytest.mark.slow
def test_two_thousand_points_in_a_part_with_a_skin_are_one_body():
    solid = samples.bracket(17.0)
    wanted = RandomGraph(points=2000)
    made = Infill(solid, LatticeSpec(strut_radius=0.25, shell=1.5, network=wanted)).part
    read = measure(as_read(made.mesh))
    assert read.watertight
    assert read.degenerate_triangles == 0
    assert read.bodies == 1


@pytest.mark.slow
def test_the_same_seed_gives_the_same_network():
    solid = samples.box()

    def nodes(**more):
        return Infill(solid, random_spec(**more), cache=_stages).struts.nodes

    np.testing.assert_array_equal(nodes(), nodes())
    assert not np.array_equal(nodes(), nodes(seed=2))


def test_points_may_be_denser_at_the_wall():
    solid = samples.box((30.0, 30.0, 30.0))

    def at_the_wall(density):
        spec = LatticeSpec(
            strut_radius=0.3, shell=0.0,
            network=RandomGraph(points=300, density=density, relax=0),
        )  # fmt: skip
        nodes = Infill(solid, spec).struts.nodes
        inside = nodes[((nodes > 0) & (nodes < 30)).all(axis=1)]
        return (np.minimum(inside, 30 - inside).min(axis=1) < 5.0).mean()

    assert at_the_wall("1 - 0.95 * s") > at_the_wall("") + 0.04


def test_points_may_follow_a_field(tmp_path):
    solid = samples.box((30.0, 30.0, 30.0))
    path = tmp_path / "field.csv"
    path.write_text("x,y,z,v\n0,15,15,0\n30,15,15,8\n")
    values = {
        "network": "voronoi", "network_points": 150, "network_density": "0.05 + s",
        "network_field": str(path), "strut_radius": 0.3, "shell": 0.0,
    }  # fmt: skip
    spec = specification(values)
    assert specification(values_of(spec)) == spec
    nodes = Infill(solid, spec).struts.nodes
    inside = nodes[((nodes > 0) & (nodes < 30)).all(axis=1)]
    # Of a density that grows along x from almost nothing two thirds or more lie in one half.
    assert (inside[:, 0] > 15.0).mean() > 0.62
    with pytest.raises(VolfrepError, match="network_field has no effect"):
        specification({"network": "voronoi", "network_field": str(path)})


@pytest.mark.slow
def test_struts_along_the_wall_lie_on_it_and_hold_what_ends_there():
    solid = samples.box((30.0, 24.0, 20.0))
    wanted = {"strut_radius": 0.4, "shell": 0.0}
    infill = Infill(solid, LatticeSpec(network=RandomGraph(points=60, on_wall=True), **wanted))
    nodes, struts = infill.struts.nodes, infill.struts.struts
    size = np.array([30.0, 24.0, 20.0])
    from_wall = np.minimum(nodes, size - nodes).min(axis=1)
    assert from_wall.min() > -0.01  # nothing is left outside
    on_wall = np.abs(from_wall) < 0.01
    along = on_wall[struts].all(axis=1)
    assert along.sum() > 60
    held = np.bincount(struts[along].ravel(), minlength=len(nodes))[on_wall]
    assert (held >= 2).mean() > 0.9  # a Voronoi edge ends where three faces meet
    report = infill.lattice.report
    plain = Infill(solid, LatticeSpec(network=RandomGraph(points=60), **wanted)).lattice.report
    assert report.bodies == 1
    assert report.volume_mm3 > plain.volume_mm3
    with pytest.raises(VolfrepError, match="choose voronoi"):
        RandomGraph("delaunay", on_wall=True)


@pytest.mark.costly
def test_a_given_network_is_trimmed_skinned_and_graded():
    frame = volfrep.block((2, 2, 1), cell="Kelvin", cell_size=10, strut_radius=0.6).struts
    network = make_network(frame.nodes, frame.struts)
    solid = samples.box((20.0, 20.0, 10.0))
    plain = Infill(solid, LatticeSpec(strut_radius=0.6, shell=1.5, network=network)).part
    assert measure(as_read(plain.mesh)).bodies == 1
    cells = volfrep.fill(solid, cell="Kelvin", cell_size=10, strut_radius=0.6, shell=1.5)
    assert plain.report.volume_mm3 == pytest.approx(cells.report.volume_mm3, rel=5e-3)
    thicker = RadiusGrading("direction", Profile("linear", 0.4, 0.9))
    graded = Infill(solid, LatticeSpec(shell=0.0, radius_grading=thicker, network=network)).lattice
    read = measure(as_read(graded.mesh))
    assert read.watertight
    assert graded.report.strut_radii_mm == pytest.approx((0.4, 0.9), abs=0.02)


def test_a_network_alone_has_its_genus_and_volume():
    network = make_network(NODES, STRUTS, [0.5, 0.6, 0.7, 0.8, 0.6, 0.5])
    made = mesh_graph_alone(LatticeSpec(network=network, deviation=0.01))
    assert (made.report.bodies, made.report.genus) == (1, 3)
    assert made.report.volume_mm3 == pytest.approx(volume_of_struts(made.wireframe), rel=5e-3)


def test_networks_are_values_of_a_specification(tmp_path):
    path = written(tmp_path)[0]
    for values in (
        {"network": "file", "network_file": str(path)},
        {"network": "voronoi", "network_points": 99, "network_density": "2 - s"},
    ):
        spec = specification(values)
        found = values_of(spec)
        assert found | values == found
        assert specification(found) == spec
        json.dumps(spec.as_dict())
    with pytest.raises(VolfrepError, match="needs network_file"):
        specification({"network": "file"})
    with pytest.raises(VolfrepError, match="network_seed has no effect"):
        specification({"network_seed": 3})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"size_grading": SizeGrading(Profile("linear", 1.0, 2.0))}, "A size grading is for cells"),
        ({"fillet": 0.2}, "A fillet is for cells"),
        ({"remove_dangling": True}, "removal of struts is for cells"),
    ],
)
def test_what_is_about_cells_is_refused(change, message):
    with pytest.raises(VolfrepError, match=message):
        LatticeSpec(network=RandomGraph(), **change)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kind": "gyroid"}, "no network 'gyroid'"),
        ({"points": -1}, "points must be a whole number"),
        ({"density": "s -"}, "cannot be read"),
        ({"density": "s - 2"}, "must be a number from 0 up"),
        ({"least_angle": 70.0}, "hardly a strut"),
    ],
)
def test_what_is_wrong_with_a_random_network(change, message):
    with pytest.raises(VolfrepError, match=message):
        RandomGraph(**change)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("voronoi --origin 1,2,3", "--origin has no effect without --network cells or file"),
        ("voronoi --cell Octet", "--cell has no effect with --network voronoi"),
        ("voronoi --network-points 9 --cell-size 4", "--cell-size has no effect"),
        ("voronoi --activation inside", "choice of active cells is for cells"),
        ("voronoi --boundary whole", "boundary of whole cells is for cells"),
        ("file --network-file {1} --cell Octet", "csv', which holds struts"),
        ("file --network-file {2} --cell Octet", "obj', which holds struts"),
        ("file --network-file {3} --cell Octet", "vtk', which holds struts"),
        ("file --network-file {1} --cell-size 4", "which says where every strut lies"),
        ("file --network-file {1} --network-thickness 3", "--network-thickness is for layers"),
        ("file --network-file {1} --network-layers 3", "--network-layers is for layers"),
    ],
)
def test_an_option_without_effect_on_a_network_is_refused(options, said, tmp_path, capsys):
    words = options.format(*written(tmp_path)).split()
    assert cli.run(["fill", "no.stl", "-o", str(tmp_path / "x.stl"), "--network", *words]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.costly
def test_on_the_command_line(tmp_path, capsys):
    box, out = tmp_path / "box.stl", tmp_path / "out.stl"
    samples_box = samples.box((20.0, 20.0, 20.0))
    from volfrep.io.write.stl import write_stl

    write_stl(samples_box, box)
    options = ["fill", str(box), "-o", str(out), "--network", "voronoi", "--network-points", "20"]
    assert cli.run([*options, "--strut-radius", "0.5", "--shell", "1"]) == 0
    assert "watertight" in capsys.readouterr().out
    assert out.stat().st_size > 10_000
    network = written(tmp_path)[1]
    alone = ["network", str(network), "-o", str(tmp_path / "alone.3mf")]
    assert cli.run(alone) == 0
    assert "6 between 4 nodes" in capsys.readouterr().out
    assert isinstance(read_network(network), GivenGraph)
