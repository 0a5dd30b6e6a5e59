# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice cut at the wall, and what is removed afterwards."""

import pickle
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from threading import Event, get_ident

import manifold3d
import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

import samples
from contract import assert_same_quality
from volfrep.design.cells import LIBRARY, PAPERS
from volfrep.grid.activation import make_grid
from volfrep.grid.motion import Motion
from volfrep.grid.placement import NUDGE
from volfrep.mesh import quality
from volfrep.mesh.float32_repair import shortest_edge, slivers
from volfrep.mesh.precision import decimal_step
from volfrep.mesh.triangle_mesh import TriangleMesh, compact
from volfrep.octants.octant import ALL_ACTIVE, OctantGrid, OctantKey
from volfrep.octants.octant_mesh import mesh_octants
from volfrep.octants.octant_spec import OctantSpec
from volfrep.process.pool import processes
from volfrep.spatial.resolve_crossings import folds_of
from volfrep.trim import boolean_trim, group_cut, octant_groups
from volfrep.trim.boolean_trim import join, trim
from volfrep.trim.culling import cull, octant_roles
from volfrep.trim.group_cut import Piece, rim_of
from volfrep.trim.placed_lattice import in_place, prove
from volfrep.trim.seams import NotCertain
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.errors import Cancelled
from volfrep.util.parallel import ParallelBackend
from volfrep.util.progress import Monitor
from volfrep.util.threads import use_threads

L = 10.0


@dataclass
class Found:
    surface: TrimmedSurface
    boolean_triangles: int


def trimmed(
    domain, name="CVC", radius=1.0, cavity=True, grow=0, executor=None, precision=0.0, monitor=None
):
    """The lattice cut at the domain; with `grow`, that many more octants go into the Boolean."""
    cell, monitor = LIBRARY[name] if isinstance(name, str) else name, monitor or Monitor()
    cells = make_grid(domain.bounds, L, (1.3, 2.1, 0.7))
    roles = octant_roles(domain, cells, monitor)
    if grow:
        roles = type(roles)(roles.border | roles.inside, np.zeros_like(roles.inside))
    key = OctantKey(0, ALL_ACTIVE)
    grid = OctantGrid([key], np.zeros(roles.border.shape, np.int16), cells.origin, L, True)
    octants = mesh_octants(cell, OctantSpec(L, radius, 0.0, 15), [key], monitor)
    kept = cull(grid, roles)
    laid = in_place(kept, octants, Motion(NUDGE * L))
    found = trim(
        domain, laid, cavity=cavity, monitor=monitor, executor=executor, precision=precision
    )
    return Found(found.surface, monitor.work["triangles into the Boolean"])


@cache
def ball():
    """The surface of a ball's lattice, which nobody changes."""
    return trimmed(samples.sphere(25.0)).surface


def mesh_of(found):
    """All of the surface as one mesh."""
    return found.surface.whole(Monitor())


@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("name", PAPERS)
def test_lattice_and_cavity_share_the_domain_between_them(name):
    domain = samples.sphere(15.0)
    lattice = mesh_of(trimmed(domain, name, cavity=False))
    cavity = mesh_of(trimmed(domain, name, cavity=True))
    for mesh in (lattice, cavity):
        assert quality.measure(mesh).watertight
    # The cavity's surface is seen from the material: its volume counts as negative.
    assert lattice.volume - cavity.volume == pytest.approx(domain.volume, rel=1e-6)


@pytest.mark.slow
def test_octants_inside_are_put_back_as_the_boolean_would_have_left_them():
    domain = samples.sphere(25.0)
    some, everything = trimmed(domain), trimmed(domain, grow=1)
    assert some.boolean_triangles < 0.8 * everything.boolean_triangles
    one, two = mesh_of(some), mesh_of(everything)
    assert one.volume == pytest.approx(two.volume, rel=1e-9)
    assert quality.measure(one).genus == quality.measure(two).genus


@pytest.mark.slow_but("True-BCC", "False-CVC")
@pytest.mark.parametrize("name", PAPERS)
@pytest.mark.parametrize("cavity", [True, False])
def test_what_is_proved_of_octants_inside_is_what_their_triangles_show(name, cavity):
    surface = trimmed(samples.sphere(25.0), name, cavity=cavity).surface
    found = surface.inspected(Monitor()).found
    whole = surface.whole(Monitor())
    assert surface.octants is not None
    assert len(surface.mesh.triangles) < len(whole.triangles) == surface.triangles
    assert_same_quality(found.quality, quality.measure(whole))
    # Shells, too: each triangle of the mesh has the volume of its own.
    plain = quality.inspect(whole)
    np.testing.assert_allclose(
        found.volume[found.shell], plain.volume[plain.shell[: len(found.shell)]], rtol=1e-6
    )


@pytest.mark.costly
@pytest.mark.parametrize("cavity", [True, False])
def test_what_groups_tell_of_folds_is_what_a_look_at_all_of_it_finds(cavity, monkeypatch):
    monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", 6_000)
    domain = samples.sphere(22.0)
    surface = trimmed(domain, radius=1.3, cavity=cavity, precision=shortest_edge(domain)).surface
    mesh, looks = surface.mesh, surface.looks
    assert looks.step == decimal_step(mesh.vertices)
    one, two = folds_of(mesh, Monitor()), folds_of(mesh, Monitor(), looks=looks)
    assert one.among.any()
    assert looks.uncrossed.sum() > 0.5 * one.among.sum(), "few are left to be looked at"
    np.testing.assert_array_equal(one.among, two.among)
    np.testing.assert_array_equal(one.pairs, two.pairs)
    assert len(looks.unsound) < 0.2 * len(mesh.triangles)
    assert np.isin(slivers(mesh, shortest_edge(domain)), looks.unsound).all()
    # Where nothing is known all of it is looked at.
    unknown = replace(looks, marks=np.zeros_like(looks.marks))
    np.testing.assert_array_equal(folds_of(mesh, Monitor(), looks=unknown).among, one.among)


def test_octants_that_do_not_fit_to_the_cut_are_found_out():
    surface = ball()
    mesh = surface.mesh
    rim = (mesh.vertices == surface.octants.rim_points[0]).all(axis=1)
    off = TriangleMesh(mesh.vertices + 1e-9 * rim[:, None], mesh.triangles)
    with pytest.raises(RuntimeError, match="do not fit"):
        replace(surface, mesh=off).inspected(Monitor())
    away = ~rim[mesh.triangles].any(axis=1)
    hole = TriangleMesh(mesh.vertices, mesh.triangles[~(away & (np.cumsum(away) == 1))])
    found = replace(surface, mesh=hole).inspected(Monitor()).found.quality
    assert (found.watertight, found.open_edges) == (False, 3)


def test_where_vertices_at_the_rim_are_is_looked_up_where_a_guess_is_wrong():
    surface = ball()
    points, rows = surface.octants.rim_points, surface.rim_rows
    turned = TriangleMesh(
        surface.mesh.vertices[::-1], len(surface.mesh.vertices) - 1 - surface.mesh.triangles
    )
    for number in (None, lambda old: old + 1, lambda old: -1 - old):
        other = surface.on(turned, number=number)
        np.testing.assert_array_equal(turned.vertices[other.rim_rows], points)
        np.testing.assert_array_equal(other.rim_rows, len(surface.mesh.vertices) - 1 - rows)


@pytest.mark.slow
def test_the_boolean_takes_only_what_the_wall_crosses():
    """Twice the size has eight times the octants, but the wall crosses only four times as many."""
    small, large = (
        trimmed(samples.box((s, s, s), (1.0, 1.0, 1.0))).boolean_triangles for s in (40.0, 80.0)
    )
    assert large < 5.0 * small


def test_a_wall_in_the_cells_own_faces_cuts_cleanly():
    domain = samples.box((40.0, 30.0, 20.0), (1.3, 2.1, 0.7))
    mesh = mesh_of(trimmed(domain, "Box", cavity=False))
    found = quality.measure(mesh)
    assert found.watertight
    assert found.bodies == 1
    x = 0.1
    density = 3 * np.pi * x**2 - 8 * np.sqrt(2) * x**3
    assert found.volume == pytest.approx(density * 24_000.0, rel=0.005)


def test_a_mesh_that_is_no_solid_is_refused():
    open_box = samples.box()
    open_box = TriangleMesh(open_box.vertices, open_box.triangles[1:])
    with pytest.raises(ValueError, match="repair the part"):
        trimmed(open_box)


def test_the_trimmed_lattice_has_the_genus_of_a_boolean_by_others():
    """Second opinion: the same lattice as one closed block, cut by manifold3d as a whole."""
    domain = samples.sphere(13.0)
    ours = quality.measure(mesh_of(trimmed(domain, "Octahedron", cavity=False)))
    everything = trimmed(
        samples.box((30.0, 30.0, 30.0), (-15.0, -15.0, -15.0)), "Octahedron", cavity=False
    )
    block = mesh_of(everything)
    solid = manifold3d.Manifold(
        manifold3d.Mesh64(block.vertices, block.triangles.astype(np.uint64))
    )
    ball = manifold3d.Manifold(
        manifold3d.Mesh64(domain.vertices, domain.triangles.astype(np.uint64))
    )
    whole = solid ^ ball
    assert ours.volume == pytest.approx(whole.volume(), rel=1e-6)
    # It counts one shell, whatever there are.
    assert ours.genus - ours.shells == whole.genus() - 1


def test_triangles_of_a_wall_touch_the_boxes_that_hold_their_middles(monkeypatch):
    """However many of them are looked at at a time."""
    ball, size = samples.sphere(22.0), 3.0
    places = np.stack(np.unravel_index(np.arange(16**3), (16, 16, 16)), axis=1)
    low = size * (places - 8.0)
    given = low, low + size, ball, 1e-6, ParallelBackend()
    at_once = octant_groups._touching(*given)
    monkeypatch.setattr(octant_groups, "CALL_TRIANGLES", 300)
    np.testing.assert_array_equal(octant_groups._touching(*given), at_once)
    middle = ball.vertices[ball.triangles].mean(axis=1)
    box = np.ravel_multi_index(tuple(np.floor(middle / size + 8.0).astype(int).T), (16, 16, 16))
    held = set(zip(box.tolist(), range(len(box)), strict=True))
    assert held <= set(map(tuple, at_once.tolist()))
    # None is farther than half of its diagonal and a triangle's size.
    farthest = np.linalg.norm(low[at_once[:, 0]] + 0.5 * size - middle[at_once[:, 1]], axis=1)
    assert farthest.max() < 0.5 * np.sqrt(3.0) * size + 2.0


@pytest.fixture
def small_groups(monkeypatch):
    """Groups of so few triangles that a sample has several, cut one after the other."""
    monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", 12_000)
    use_threads(1)
    yield
    use_threads(0)


def joined_of(monkeypatch):
    """What is cut from here on is noted: how many groups there were, each time."""
    counts = []
    cut_each = boolean_trim._cut_each

    def noted(cuts, count, *given):
        counts.append(count)
        return cut_each(cuts, count, *given)

    monkeypatch.setattr(boolean_trim, "_cut_each", noted)
    return counts


def tilted_box():
    """Large flat facets in no plane of the cells'."""
    box = trimesh.creation.box((47.0, 38.0, 29.0))
    box.apply_transform(trimesh.transformations.rotation_matrix(0.4, (1, 2, 3)))
    return TriangleMesh(np.asarray(box.vertices), box.faces.astype(np.int32))


@pytest.mark.costly
@pytest.mark.slow_but("round-CVC-True")
@pytest.mark.parametrize("cavity", [True, False])
@pytest.mark.parametrize("name", ["CVC", "Box"])
@pytest.mark.parametrize("domain", [tilted_box(), samples.sphere(22.0)], ids=["flat", "round"])
def test_groups_give_the_surface_that_one_boolean_gives(
    domain, name, cavity, small_groups, monkeypatch
):
    counts = joined_of(monkeypatch)
    some = quality.measure(mesh_of(trimmed(domain, name, cavity=cavity)))
    assert len(counts) == 1  # none had to be cut again
    assert counts[0] > 3
    monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", 10**9)
    one = quality.measure(mesh_of(trimmed(domain, name, cavity=cavity)))
    assert counts[1:] == [1]
    assert some.watertight
    assert some.volume == pytest.approx(one.volume, rel=1e-9)
    assert some.area == pytest.approx(one.area, rel=1e-9)
    for figure in ("shells", "bodies", "voids", "genus"):
        assert getattr(some, figure) == getattr(one, figure)


@pytest.mark.slow
def test_threads_of_this_process_cut_the_same(small_groups, monkeypatch):
    alone, cutting = mesh_of(trimmed(tilted_box())), set()
    real = boolean_trim.cut_group

    def noted(group, monitor=None):
        cutting.add(get_ident())
        return real(group, monitor)

    monkeypatch.setattr(boolean_trim, "cut_group", noted)
    use_threads(3)
    mesh = mesh_of(trimmed(tilted_box()))
    np.testing.assert_array_equal(mesh.vertices, alone.vertices)
    np.testing.assert_array_equal(mesh.triangles, alone.triangles)
    assert get_ident() not in cutting
    assert cutting


def test_a_process_makes_the_group_that_this_one_would_make(small_groups, monkeypatch):
    monkeypatch.setattr(ParallelBackend, "uses_processes", True)
    seen = []

    def noted(groups, inner, proof, cavity, *_):
        with ParallelBackend().sharing_value(groups.to_share()) as shared:
            seen.extend((groups.group(k, cavity), shared.value.group(k, cavity)) for k in (0, 2))
        raise Cancelled("seen enough")

    monkeypatch.setattr(boolean_trim, "_join_groups", noted)
    with pytest.raises(Cancelled):
        trimmed(tilted_box())
    for one, other in seen:
        assert len(one.boundary.triangles) > one.own_boundary.sum() > 0
        for of in (
            lambda group: group.boundary.vertices,
            lambda group: group.boundary.triangles,
            lambda group: group.own_boundary,
            lambda group: np.stack([group.own, group.adjacent, group.follow]),
            lambda group: group.placed.mesh(*surface_of(group), Monitor())[0].vertices,
        ):
            np.testing.assert_array_equal(of(one), of(other))


def surface_of(group):
    """The facets of a group's own octants, and which these are."""
    return group.placed.facets(group.own, Monitor()), group.own


def test_a_cancel_while_threads_cut_begins_no_more_groups(small_groups, monkeypatch):
    use_threads(2)
    begun, waits = [], Event()

    def noted(group, monitor=None):
        begun.append(group)
        waits.wait()

    monkeypatch.setattr(boolean_trim, "cut_group", noted)
    try:
        with pytest.raises(Cancelled):
            trimmed(tilted_box(), monitor=Monitor(lambda *_: not begun))
    finally:
        waits.set()
    assert 1 <= len(begun) <= 2


@pytest.mark.slow
def test_the_surface_is_the_same_whoever_cuts_the_groups(small_groups):
    domain = tilted_box()
    alone = mesh_of(trimmed(domain))
    with ThreadPoolExecutor(2) as threads, ProcessPoolExecutor(1) as process, processes(2) as two:
        for executor in (threads, process, two):
            mesh = mesh_of(trimmed(domain, executor=executor))
            np.testing.assert_array_equal(mesh.vertices, alone.vertices)
            np.testing.assert_array_equal(mesh.triangles, alone.triangles)


@pytest.mark.slow
def test_a_worker_that_is_gone_costs_time_and_nothing_else(small_groups):
    class Gone(ThreadPoolExecutor):
        taken = 0

        def submit(self, *args):
            Gone.taken += 1
            if Gone.taken > 2:
                raise BrokenExecutor("killed")
            return super().submit(*args)

    with Gone(1) as executor:
        mesh = mesh_of(trimmed(tilted_box(), executor=executor))
    np.testing.assert_array_equal(mesh.vertices, mesh_of(trimmed(tilted_box())).vertices)
    assert Gone.taken > 2


def test_the_proof_of_octants_inside_is_the_same_wherever_it_is_found():
    octants = ball().octants
    found = pickle.loads(pickle.dumps(prove(pickle.loads(pickle.dumps(octants)))))
    told = replace(octants, proof=found)
    np.testing.assert_array_equal(told.rim, octants.rim)
    np.testing.assert_array_equal(told.rim_points, octants.rim_points)
    np.testing.assert_array_equal(told.pieces.rim, octants.pieces.rim)
    assert told.pieces.triangles == octants.pieces.triangles
    assert octants.triangles == octants.pieces.triangles


@pytest.mark.costly
def test_groups_that_do_not_meet_are_cut_as_one(small_groups, monkeypatch):
    counts = joined_of(monkeypatch)
    real, spoilt = boolean_trim.cut_group, []

    def spoiling(group, monitor=None):
        piece = real(group, monitor)
        if not spoilt:
            # One triangle of the first group is lost.
            spoilt.append(True)
            mesh = TriangleMesh(piece.mesh.vertices, piece.mesh.triangles[:-1])
            return replace(piece, mesh=mesh, on_boundary=piece.on_boundary[:-1], rim=rim_of(mesh))
        return piece

    monkeypatch.setattr(boolean_trim, "cut_group", spoiling)
    found = quality.measure(mesh_of(trimmed(tilted_box())))
    assert found.watertight
    assert len(counts) == 2


def joined_halves(order=None, other=None, off=0.0):
    """A ball's halves, joined; with a triangle beside each of them, the second one moved."""
    ball, pieces = trimesh.creation.icosphere(2), []
    upper = ball.triangles_center[:, 2] > 0.0
    for chosen, more, moved in ((upper, order, 0.0), (~upper, other, off)):
        vertices, faces = ball.vertices + moved, ball.faces[chosen]
        if more is not None:
            faces = np.concatenate([faces, [np.add(more, len(vertices))]])
            vertices = np.concatenate([vertices, [[3.0, 0.0, 0.0], [4.0, 0.0, 0.0], [3.0, 1.0, 0]]])
        mesh = compact(TriangleMesh(vertices, faces.astype(np.int32)))
        pieces.append(Piece(mesh, np.ones(len(faces), bool), rim_of(mesh)))
    return join(pieces, np.zeros((0, 3)), 1e-9), len(ball.vertices)


@pytest.mark.parametrize("off", [0.0, 1e-10])
def test_pieces_whose_vertices_differ_by_rounding_only_are_joined(off):
    found, vertices = joined_halves(off=off)
    assert not len(found.loose)
    assert len(found.mesh.vertices) == vertices
    assert quality.measure(found.mesh).watertight
    assert joined_halves(off=1e-6)[0].loose.tolist() == [0, 1]


def test_four_pieces_are_joined_where_two_have_the_very_same_vertices_each():
    """All four meet at two vertices, and differ there by rounding, two and two."""
    ball, pieces = trimesh.creation.icosphere(3), []
    right, front = (ball.triangles_center[:, k] > 0.0 for k in range(2))
    for chosen, moved in ((right & front, 0.0), (right & ~front, 0.0),
                          (~right & front, 1e-10), (~right & ~front, 1e-10)):  # fmt: skip
        mesh = compact(TriangleMesh(ball.vertices + moved, ball.faces[chosen].astype(np.int32)))
        pieces.append(Piece(mesh, np.ones(int(chosen.sum()), bool), rim_of(mesh)))
    found = join(pieces, np.zeros((0, 3)), 1e-9)
    assert not len(found.loose)
    assert len(found.mesh.vertices) == len(ball.vertices)
    assert quality.measure(found.mesh).watertight


@pytest.mark.parametrize("other", [(0, 2, 1), (0, 1, 2)], ids=["back to back", "twice"])
def test_triangles_that_lie_on_each_other_in_two_pieces_are_found_out(other):
    assert joined_halves((0, 1, 2), other)[0].loose.tolist() == [0, 1]


@pytest.mark.costly
@pytest.mark.slow_cases("False")
@pytest.mark.parametrize("cavity", [True, False])
def test_what_is_not_certain_the_library_decides(cavity, small_groups, monkeypatch):
    """And its groups fit to those that were cut along their seams."""
    domain = tilted_box()
    expected = quality.measure(mesh_of(trimmed(domain, cavity=cavity)))
    along_seam, asked = group_cut.cut_mutually, []

    def every_other_time(*arguments, **more):
        asked.append(len(asked))
        if len(asked) % 2:
            raise NotCertain
        return along_seam(*arguments, **more)

    monkeypatch.setattr(group_cut, "cut_mutually", every_other_time)
    found = quality.measure(mesh_of(trimmed(domain, cavity=cavity)))
    assert len(asked) > 2
    assert found.watertight
    assert found.genus == expected.genus
    assert found.volume == pytest.approx(expected.volume, rel=1e-9)


@pytest.mark.slow
def test_slivers_go_in_the_groups_but_not_where_these_meet(small_groups):
    domain, coarse = samples.sphere(22.0), 0.02
    exact = trimmed(domain).surface.mesh
    clean = trimmed(domain, precision=coarse).surface.mesh
    assert len(clean.triangles) < len(exact.triangles)
    rim = [exact.vertices[rim_of(exact)], clean.vertices[rim_of(clean)]]
    assert sorted(map(tuple, rim[0])) == sorted(map(tuple, rim[1]))
    distance = cKDTree(exact.vertices).query(clean.vertices)[0]
    assert distance.max() < 8 * coarse
    assert quality.inspect(clean).quality.overused_edges == 0


@pytest.mark.costly
def test_slivers_that_go_leave_no_vertices_behind():
    exact, clean = (trimmed(samples.sphere(10.0), precision=p).surface.mesh for p in (0.0, 0.02))
    assert len(clean.triangles) < len(exact.triangles)
    assert len(np.unique(clean.triangles)) == len(clean.vertices)
