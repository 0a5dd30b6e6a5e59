# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetrahedra: the mesh's own triangles outside, or those of a lattice; bars that are stretched."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull, Delaunay, cKDTree

import samples
from bench.static_step import StaticStep
from volfrep import LatticeSpec
from volfrep.fem import tet_mesh
from volfrep.fem.calculix import solve
from volfrep.fem.deck import sides, write_tetrahedra
from volfrep.fem.folds import folded_facets
from volfrep.fem.strayed import farthest_apart
from volfrep.fem.stuffed_mesh import signed_volumes
from volfrep.fem.tet_mesh import (
    MAX_TRIANGLES,
    CannotFill,
    TetrahedralMesh,
    filled_by_gmsh,
    mend_surface,
    nodes_on,
    tetrahedra,
)
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mechanics.materials import Material
from volfrep.mesh.brep import faceted_brep
from volfrep.mesh.triangle_mesh import TriangleMesh, compact, concatenate
from volfrep.mesh.well_shaped import is_bad
from volfrep.process.child import OverLimit
from volfrep.spatial.self_intersection import crossing_triangles
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.progress import Monitor

needs_gmsh = pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not installed")
needs_both = pytest.mark.skipif(
    shutil.which("gmsh") is None or shutil.which("ccx") is None,
    reason="Gmsh or CalculiX is not installed",
)


@pytest.mark.costly
@needs_gmsh
def test_a_lattice_keeps_its_triangles():
    spec = LatticeSpec(cell="CVC", cell_size=10, strut_radius=1)
    mesh = block(spec, (1, 1, 1)).mesh
    filled = tetrahedra(mesh)
    corners = filled.elements[:, :4]
    assert filled.volumes().sum() == pytest.approx(mesh.volume, rel=1e-9)
    assert filled.volumes().min() > 0
    # Faces of a single tetrahedron, seen from outside, are the mesh's triangles.
    faces = np.concatenate([corners[:, k] for k in ([0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2])])
    _, index, uses = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    outside = filled.nodes[faces[index[uses == 1]]]
    own = mesh.vertices[mesh.triangles]
    assert np.array_equal(canonical(outside), canonical(own))
    # The order that solvers ask for: each further node in the middle of its edge.
    for node, (a, b) in enumerate(((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)), 4):
        middle = filled.nodes[corners[:, [a, b]]].mean(axis=1)
        assert np.abs(filled.nodes[filled.elements[:, node]] - middle).max() < 1e-12


def corners_of(mesh):
    return mesh.vertices[mesh.triangles]


def canonical(triangles):
    """Triangles turned to begin with their least corner, then sorted."""
    rounded = triangles.round(9) + 0.0
    turns = [np.roll(rounded, k, axis=1).reshape(-1, 9) for k in range(3)]
    first = np.lexsort(np.stack([t[:, :3] for t in turns]).transpose(2, 0, 1)[::-1], axis=0)[0]
    chosen = np.stack(turns)[first, np.arange(len(rounded))]
    return chosen[np.lexsort(chosen.T[::-1])]


def shapes(filled):
    """Of each tetrahedron its volume over that of a regular one with edges as long."""
    corners = filled.nodes[filled.elements[:, :4]]
    edges = corners[:, [0, 0, 0, 1, 1, 2]] - corners[:, [1, 2, 3, 2, 3, 3]]
    length = np.sqrt(np.einsum("ijk,ijk->i", edges, edges) / 6.0)
    return 6.0 * np.sqrt(2.0) * filled.volumes() / length**3


@needs_both
def test_a_stretched_bar(tmp_path: Path):
    bar = samples.box((40.0, 4.0, 4.0))
    filled = tetrahedra(bar)
    side = sides(filled.nodes)
    path = tmp_path / "bar.inp"
    # Held all over its end the bar cannot contract there: without lateral strain it can.
    step = StaticStep(side["XMIN"], side["XMAX"], (320.0, 0, 0))
    write_tetrahedra(filled, path, Material("STEEL", 210_000.0, 0.0, 7.85))
    step.add_to(path, of_beams=False)
    moved = solve(path)[side["XMAX"], 0]
    assert moved.mean() == pytest.approx(320 * 40 / 210_000 / 16, rel=0.02)


@needs_gmsh
def test_what_gmsh_cannot_fill():
    box = samples.box((10.0, 10.0, 10.0))
    with pytest.raises(VolfrepError, match="not closed"):
        tetrahedra(TriangleMesh(box.vertices, box.triangles[1:]))
    crossing = samples.sphere(10.0, 2)
    crossing.vertices[0] *= -1.5  # out at the other side
    with pytest.raises(CannotFill, match="Gmsh cannot fill"):
        filled_by_gmsh(crossing)


def from_lattice(
    monkeypatch, mesh: TriangleMesh, count: int = 20_000, tell=lambda _: None
) -> TetrahedralMesh:
    def refuse(*_):
        raise CannotFill("Gmsh cannot fill it.")

    monkeypatch.setattr(tet_mesh, "filled_by_gmsh", refuse)
    monkeypatch.setattr(tet_mesh, "LATTICE_TETRAHEDRA", (count,))
    monkeypatch.setattr(tet_mesh, "_median_edge", lambda _: 0.0)
    return tetrahedra(mesh, tell=tell)


def test_what_gmsh_cannot_fill_is_filled_from_a_lattice(monkeypatch):
    spec = LatticeSpec(cell="CVC", cell_size=10, strut_radius=1)
    mesh, told = block(spec, (1, 1, 1)).mesh, []
    filled = from_lattice(monkeypatch, mesh, 60_000, told.append)
    assert told == [60_000]
    assert 50_000 < len(filled.elements) < 75_000
    assert shapes(filled).min() > 0.15
    assert filled.volumes().sum() == pytest.approx(mesh.volume, rel=0.02)
    assert filled.grown == pytest.approx(filled.volumes().sum() / mesh.volume - 1.0)
    corners = filled.elements[:, :4]
    for node, (a, b) in enumerate(((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)), 4):
        middle = filled.nodes[corners[:, [a, b]]].mean(axis=1)
        assert np.abs(filled.nodes[filled.elements[:, node]] - middle).max() < 1e-12
    # What is told of it: no point of either surface is farther away.
    (sentence,) = filled.warnings
    assert f"from a lattice of {filled.lattice:.3g} mm" in sentence
    assert f"within {filled.away[0]:.2g} mm" in sentence
    assert 0.0 < filled.away[1] <= filled.away[0] < filled.lattice
    outside = tet_mesh.outer_nodes(filled)
    apart = cKDTree(filled.nodes[outside]).query(mesh.vertices)[0]
    assert (apart < 0.5 * filled.lattice).all()


def test_surfaces_are_as_far_apart_as_the_farthest_place_of_either():
    """A spike that only one of them has is told from either side."""
    box = samples.box((10.0, 10.0, 10.0))
    spiked = TriangleMesh(box.vertices.copy(), box.triangles)
    top = int(np.argmax(box.vertices.sum(axis=1)))
    spiked.vertices[top] += 2.0
    for one, other in ((box, spiked), (spiked, box)):
        assert tet_mesh._apart(one, other, 0.5)[0] == pytest.approx(2.0 * 3**0.5)


def test_a_lattice_that_loses_or_joins_too_much_is_refused(monkeypatch):
    sheet = samples.box((20.0, 20.0, 0.3))
    near = concatenate(samples.box((4.0, 4.0, 4.0)), samples.box((4.0, 4.0, 4.0), (4.02, 0.0, 0.0)))
    for mesh in (sheet, near):
        with pytest.raises(CannotFill, match=r"Gmsh cannot fill it. A lattice .* (bodies|volume)"):
            from_lattice(monkeypatch, mesh, 1000)
    # A finer one is tried before.
    monkeypatch.setattr(tet_mesh, "LATTICE_TETRAHEDRA", (1000, 60_000))
    filled = tetrahedra(sheet)
    assert filled.lattice < 0.35
    assert filled.volumes().sum() == pytest.approx(120.0, rel=0.05)


@pytest.mark.costly
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
def test_a_bar_from_a_lattice_is_stretched_and_knows_its_outside(monkeypatch, tmp_path: Path):
    bar = samples.box((40.0, 4.0, 4.0))
    filled = from_lattice(monkeypatch, bar, 12_000)
    on = nodes_on(filled, bar)
    low, high = bar.bounds
    depth = np.minimum(filled.nodes - low, high - filled.nodes).min(axis=1)
    # All of its faces' nodes, and those that bridge its edges.
    assert np.array_equal(on, tet_mesh.outer_nodes(filled))
    assert set(np.flatnonzero(depth < 1e-9)) <= set(on)
    assert depth[on].max() < filled.lattice / 2
    side = sides(filled.nodes)
    assert len(side["XMIN"]) > 20 < len(side["XMAX"])
    path = tmp_path / "bar.inp"
    step = StaticStep(side["XMIN"], side["XMAX"], (320.0, 0, 0))
    write_tetrahedra(filled, path, Material("STEEL", 210_000.0, 0.0, 7.85))
    step.add_to(path, of_beams=False)
    moved = solve(path)[side["XMAX"], 0]
    area = filled.volumes().sum() / 40.0
    assert moved.mean() == pytest.approx(320 * 40 / 210_000 / area, rel=0.05)


def test_a_node_that_mending_took_off_the_surface_is_on_it_and_a_struts_beside_it_is_not():
    """A bar's end was raised by 0.02 mm; a node of its side is 0.01 mm below that end."""
    bar = samples.box((10.0, 10.0, 10.0))
    top, right = np.array([0.0, 0.0, 5.02]), np.array([5.01, 0.0, 4.99])
    points = np.vstack([bar.vertices - bar.vertices.mean(axis=0), right, top])
    own = points[:-1]
    hull = ConvexHull(own)
    sides = np.einsum(
        "ij,ij->i",
        hull.equations[:, :3],
        np.cross(*np.diff(own[hull.simplices], axis=1).swapaxes(0, 1)),
    )
    facets = np.where(sides[:, None] > 0, hull.simplices, hull.simplices[:, ::-1])
    before = TriangleMesh(own, facets.astype(np.int32))
    nodes, elements = tet_mesh._second_order(points, Delaunay(points).simplices.astype(np.int64))
    filled = TetrahedralMesh(nodes, elements, moved=0.01, strayed=0.03, before=before)
    part = samples.box((30.0, 30.0, 10.0))
    part.vertices[:] -= part.vertices.mean(axis=0)
    upper = filled.nodes[nodes_on(filled, part)]
    upper = upper[upper[:, 2] > 0.0]
    # Its corners, the raised node, and the middles of the eight edges between them.
    assert len(upper) == 13
    assert (np.linalg.norm(upper - top, axis=1) < 1e-9).any()
    assert np.abs(upper[:, :2]).max() < 5.0 + 1e-9


@pytest.mark.slow
@needs_gmsh
def test_a_part_has_its_cavity_and_knows_its_outside():
    """Also where the wall's Boolean left needles, which are mended."""
    solid = samples.box((20.0, 20.0, 20.0))
    mesh = fill(solid, LatticeSpec(cell="CVC", shell=2, resolution=8)).mesh
    assert is_bad(mesh.vertices[mesh.triangles]).any()
    filled = tetrahedra(mesh)
    assert 0.0 < filled.moved < 0.1
    assert filled.volumes().sum() == pytest.approx(mesh.volume, rel=1e-4)
    on = nodes_on(filled, solid)
    # Of the surface's pieces, its outside and that of its cavity, all nodes of one.
    faces = tet_mesh._outer_faces(filled)
    ends = faces[:, [0, 1, 2, 0, 1, 2]].ravel(), faces[:, [1, 2, 3, 4, 5, 5]].ravel()
    links = coo_array((np.ones(len(ends[0])), ends), shape=(len(filled.nodes),) * 2)
    piece = connected_components(links, directed=False)[1]
    outer = np.isin(piece, piece[np.argmax(filled.nodes[:, 0])])
    assert np.array_equal(on, np.flatnonzero(outer))
    outside = filled.nodes[on]
    low, high = solid.bounds
    assert (np.minimum(outside - low, high - outside).min(axis=1) < 1e-4).all()
    # Its twelve triangles are divided, since the cavity's are small: its corners stay.
    assert len(outside) > 8 + 18
    places = {tuple(place) for place in outside.round(9)}
    assert {tuple(place) for place in solid.vertices.round(9)} <= places


@pytest.mark.slow
@needs_gmsh
@pytest.mark.parametrize("shell", [0, 2])
@pytest.mark.parametrize("cell", ["Box", "FCC", "BCC", "Octet", "Octahedron", "CVC"])
def test_every_cell_fills_a_box(cell, shell):
    """Without a skin its faces run through the middles of struts, a hair beside their facets."""
    solid = samples.box((30.0, 30.0, 30.0), (5.0, -5.0, -10.0))
    spec = LatticeSpec(cell, cell_size=10, strut_radius=1, shell=shell)
    mesh = fill(solid, spec).mesh
    filled = tetrahedra(mesh)
    assert filled.volumes().sum() == pytest.approx(mesh.volume, rel=1e-3)
    # Were the box's sides kept in twelve facets, one in a hundred would be flat.
    assert (shapes(filled) < 0.01).mean() < 2e-4


@needs_gmsh
def test_a_volume_that_mending_changed_is_told(monkeypatch):
    """Gmsh fills the mended mesh, and its volume is compared with that of the mesh as it was."""
    box = samples.box((10.0, 8.0, 2.0))
    thinner = TriangleMesh(box.vertices * (1.0, 1.0, 0.99), box.triangles)
    monkeypatch.setattr(tet_mesh, "mend_surface", lambda mesh, *_: (thinner, 0.02))
    filled = tetrahedra(box)
    assert filled.grown == pytest.approx(-0.01)
    assert "-1.00%" in filled.warnings[0]
    assert filled.strayed == pytest.approx(np.abs(thinner.bounds - box.bounds).max())
    monkeypatch.setattr(tet_mesh, "mend_surface", lambda mesh, *_: (mesh, 0.0))
    assert tetrahedra(box).warnings == ()


@needs_gmsh
def test_what_gmsh_finds_to_intersect_is_mended_less(monkeypatch):
    said = "Error : Invalid boundary mesh (facet-facet intersection), intersection (1.5,-2,3e-1)"
    filled, asked = tet_mesh._run_gmsh, []

    def mend(mesh, _, places, deviation):
        asked.append(places.tolist())
        return mesh, 0.01

    monkeypatch.setattr(tet_mesh, "mend_surface", mend)
    monkeypatch.setattr(tet_mesh, "_run_gmsh", lambda *_: (said, None))
    with pytest.raises(CannotFill, match="facet-facet intersection"):
        filled_by_gmsh(samples.box((4.0, 4.0, 4.0)))
    assert asked == [[], [[1.5, -2.0, 0.3]]]
    asked.clear()
    monkeypatch.setattr(
        tet_mesh, "_run_gmsh", lambda *given: filled(*given) if len(asked) > 1 else (said, None)
    )
    assert tetrahedra(samples.box((4.0, 4.0, 4.0))).volumes().sum() == pytest.approx(64)
    assert len(asked) == 2


@needs_gmsh
def test_what_is_no_solid_once_mended_is_not_given_to_gmsh(monkeypatch):
    """The lattice takes the mesh as it was; one that is open from the start is refused."""
    box = samples.box((10.0, 8.0, 2.0))
    opened = TriangleMesh(box.vertices, box.triangles[1:])
    monkeypatch.setattr(tet_mesh, "mend_surface", lambda *_: (opened, 0.01))
    monkeypatch.setattr(tet_mesh, "LATTICE_TETRAHEDRA", (2000,))
    monkeypatch.setattr(tet_mesh, "MOST_GROWN", 0.2)
    monkeypatch.setattr(tet_mesh, "_median_edge", lambda _: 0.0)
    with pytest.raises(CannotFill, match=r"mended it is no solid: .*closed"):
        filled_by_gmsh(box)
    assert tetrahedra(box).lattice > 0.0


@needs_gmsh
def test_a_lip_that_all_but_lies_on_the_surface_is_filled():
    """A pyramid upon a block, its apex beyond the foot: below it is a gap of 0.05 degrees."""
    height = np.tan(np.radians(0.05))
    foot = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, -1, height]]
    low, high = ([[-3, -4, z], [5, -4, z], [5, 4, z], [-3, 4, z]] for z in (-4, 0))
    pyramid = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    ring = [[5, 6, 0], [0, 6, 1], [6, 7, 1], [1, 7, 2], [7, 8, 2], [2, 8, 3], [8, 5, 3], [3, 5, 0]]
    sides = [[9, 11, 10], [9, 12, 11], [5, 9, 6], [6, 9, 10], [6, 10, 7], [7, 10, 11]]
    facets = [*pyramid, *ring, *sides, [7, 11, 8], [8, 11, 12], [8, 12, 5], [5, 12, 9]]
    mesh = TriangleMesh(np.array([*foot, *high, *low], float), np.array(facets, np.int32))
    assert folded_facets(mesh).any()
    filled = tetrahedra(mesh)
    assert filled.moved == 0.0
    assert filled.volumes().sum() == pytest.approx(256 + 4 * height / 3, rel=1e-9)


@pytest.mark.costly
def test_a_thin_skin_is_mended_without_a_fold_or_a_crossing():
    """Gmsh refuses a surface of which one facet is folded back onto the next, too."""
    solid = samples.box((15.0, 12.0, 12.0))
    mesh = fill(solid, LatticeSpec(cell="CVC", shell=1, resolution=8)).mesh
    better, moved = mend_surface(mesh, Monitor())
    assert moved > 0.0
    assert is_bad(better.vertices[better.triangles]).sum() < 20
    assert not folded_facets(better).any()
    assert not crossing_triangles(better, np.ones(len(better.triangles), bool), 0.0).any()
    assert faceted_brep(better).bodies == 1


@needs_gmsh
def test_along_a_tunnel_a_hair_wide_no_tetrahedra_are_flat():
    """Between a groove's corner and a bar that grazes it."""
    mesh = samples.grazed_groove(0.002)
    filled = tetrahedra(mesh)
    assert shapes(filled).min() > 0.01
    # The walls' move is told, and the tunnel is one still: as many handles.
    assert 0.0 < filled.strayed <= filled.moved
    faces = tet_mesh._outer_faces(filled)[:, :3]
    surface = compact(TriangleMesh(filled.nodes, faces.astype(np.int32)))
    for one in (mesh, surface):
        assert len(one.vertices) - len(one.triangles) // 2 == 2


def test_no_move_takes_more_than_a_third_of_the_deviation_that_is_asked_for():
    groove = samples.grazed_groove(0.002)
    usual = mend_surface(groove, Monitor())[1]
    assert usual == pytest.approx(0.2, rel=1e-3)
    for deviation, most in ((3.0, usual), (0.03, 0.01)):
        better, moved = mend_surface(groove, Monitor(), deviation=deviation)
        assert moved == pytest.approx(most)
        assert farthest_apart(groove, better) <= deviation
    # The tunnel is widened by that, and no more.
    assert better.volume == pytest.approx(groove.volume, rel=1e-4)


def test_where_all_would_cross_nothing_is_mended(monkeypatch):
    """Neither by many moves nor by single ones."""
    slender = samples.box((100.0, 1.0, 1.0))
    monkeypatch.setattr(tet_mesh, "meeting_triangles", lambda _, among, *__: among)
    monkeypatch.setattr(tet_mesh, "piercing_pairs", lambda *_: np.zeros((1, 2), int))
    better, moved = mend_surface(slender, Monitor())
    assert moved > 0.0
    assert np.array_equal(canonical(corners_of(better)), canonical(corners_of(slender)))


@needs_gmsh
@pytest.mark.parametrize("is_filled", [True, False])
def test_without_an_end_of_improving_the_tetrahedra_stay_as_they_are(monkeypatch, is_filled):
    run = tet_mesh.run_program

    def impatient(command, folder, monitor, limits):
        run(command, folder, monitor, limits=limits)
        (folder / "improved.msh").write_bytes((folder / "improved.msh").read_bytes()[:-9])
        if not is_filled:
            (folder / "filled.msh").unlink()
        raise OverLimit("processor time")

    monkeypatch.setattr(tet_mesh, "run_program", impatient)
    box = samples.box((4.0, 4.0, 4.0))
    if is_filled:
        filled = tetrahedra(box)
        assert filled.volumes().sum() == pytest.approx(64)
        assert "Gmsh came to no end" in filled.warnings[0]
    else:
        with pytest.raises(CannotFill, match=r"no end within 120 s of processor time.*beams"):
            filled_by_gmsh(box)


def test_a_flat_tetrahedron_on_the_surface_goes():
    """Two below it have its other two faces; with an edge between these it has to stay."""
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1e-9], [0.5, 0.5, -1]])
    below, flat = [[0, 1, 3, 4], [1, 2, 3, 4]], [0, 1, 2, 3]
    assert without_flat(points, [*below, flat]) == below
    assert len(without_flat(points, below)) == 2
    cap = [[0, 1, 2, 4], [0, 2, 1, 3]]
    on_top = points * 1.0
    on_top[3] = (0.7, 0.3, 1e-9)
    assert without_flat(on_top, cap) == [[0, 1, 2, 4]]
    above = [*below, flat, [1, 3, 5, 6]]
    more = np.concatenate([points, [[0.5, 0.5, 1], [0, 0, 1]]])
    assert len(without_flat(more, above)) == 4
    # Edges across are half as far apart as the corner is high.
    points[3, 2] = on_top[3, 2] = 0.01
    for given, places, height in (([*below, flat], points, 0.005), (cap, on_top, 0.01)):
        assert len(without_flat(places, given, 1.01 * height)) == len(given) - 1
        assert len(without_flat(places, given, 0.99 * height)) == len(given)


def test_of_two_flat_tetrahedra_with_a_common_face_the_flatter_goes():
    points = np.array(
        [[0, 0, 1e-6], [1, 0, 0], [1, 1, 0], [0, 1, 0], [-0.5, -0.5, 0], [0.2, 0.2, -1]]
    )
    below, flat = [[1, 2, 3, 5], [1, 3, 4, 5]], [[0, 1, 3, 2], [0, 1, 4, 3]]
    assert np.abs(signed_volumes(points, np.array(flat))) == pytest.approx([1e-6 / 6, 1e-6 / 3])
    for given in (flat, flat[::-1]):
        assert without_flat(points, [*below, *given]) == [*below, flat[1]]


def without_flat(points, corners, tolerance=1e-6):
    return tet_mesh.without_flat(points, np.array(corners), tolerance).tolist()


@needs_gmsh
def test_bodies_that_do_not_touch():
    one, two = samples.box((4.0, 4.0, 4.0)), samples.box((4.0, 4.0, 4.0), (9.0, 0.0, 0.0))
    assert tetrahedra(concatenate(one, two)).volumes().sum() == pytest.approx(128)


def test_limits(tmp_path: Path, monkeypatch):
    box = samples.box()
    many = TriangleMesh(box.vertices, np.tile(box.triangles, (MAX_TRIANGLES // 12 + 1, 1)))
    if shutil.which("gmsh"):
        with pytest.raises(VolfrepError, match=r"200,000.*beams"):
            tetrahedra(many)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(VolfrepError, match="Gmsh is not installed"):
        tetrahedra(box)


@needs_gmsh
def test_cancel():
    with pytest.raises(Cancelled):
        tetrahedra(samples.sphere(20.0, 6), Monitor(lambda *_: False))
