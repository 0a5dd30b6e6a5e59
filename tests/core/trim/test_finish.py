# SPDX-License-Identifier: LGPL-2.1-or-later
"""What leaves the engine is what a reader of its file finds."""

import numpy as np
import pytest
import trimesh

import samples
from volfrep.design.cells import make_cell
from volfrep.design.grading import CellMap
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh import float32_repair
from volfrep.mesh.float32_repair import Repair, repair_slivers
from volfrep.mesh.precision import decimal_step
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.output.meshes import write_mesh
from volfrep.spatial.resolve_crossings import Folds, folds_of, look_at, resolve_fold_crossings
from volfrep.spatial.self_intersection import crossing_triangles
from volfrep.trim.finish import finish, refuse_merging, thinned, tidy
from volfrep.trim.group_cut import rim_of
from volfrep.trim.loose_pieces import clear
from volfrep.trim.mended_surface import MendedSurface
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.errors import VolfrepError
from volfrep.util.parallel import ParallelBackend
from volfrep.util.progress import Monitor

#: Where the wall of a sized skin grazes a strut, mm: facets there are all but lines.
GRAZED = [
    (72.745056, 15.855831, 92.213474),
    (72.392166, 16.045443, 91.534977),
    (73.379580, 15.524664, 92.080027),
    (73.066862, 15.405520, 91.589067),
    (72.048520, 16.413966, 92.395478),
    (71.905599, 15.019006, 91.941214),
    (72.564662, 14.417049, 91.556107),
    (72.564625, 15.365678, 92.038079),
    (72.564564, 15.685693, 92.197805),
    (73.845747, 15.381002, 92.042081),
    (72.717457, 15.939173, 92.323076),
    (72.860510, 15.900526, 92.304842),
    (73.370262, 15.593444, 92.152417),
    (72.564975, 16.077658, 92.390180),
    (72.824351, 15.910357, 92.309538),
    (73.413930, 15.593517, 92.152323),
    (73.206927, 15.695391, 92.205170),
    (73.205994, 15.695972, 92.205470),
    (73.205750, 15.696046, 92.205508),
]
GRAZED_FACETS = [
    (3, 2, 0),
    (3, 0, 1),
    (0, 4, 1),
    (0, 11, 14),
    (0, 14, 10),
    (18, 11, 0),
    (2, 12, 16),
    (0, 2, 16),
    (16, 18, 0),
    (18, 16, 17),
    (0, 10, 13),
    (4, 0, 13),
    (5, 7, 6),
    (8, 7, 5),
    (7, 9, 6),
    (8, 18, 7),
    (15, 9, 7),
    (12, 15, 7),
    (16, 12, 7),
    (7, 17, 16),
    (18, 8, 14),
    (18, 14, 11),
    (17, 7, 18),
]


def moved(mesh, by):
    return TriangleMesh(mesh.vertices + np.asarray(by, float), mesh.triangles)


def shells_read(path):
    """Bodies and voids of a file by trimesh, which merges equal corners; closed or not."""
    mesh = trimesh.load(path, force="mesh")
    volumes = [part.volume for part in mesh.split(only_watertight=False)]
    return sum(v > 0 for v in volumes), sum(v < 0 for v in volumes), mesh.is_watertight


@pytest.mark.parametrize("extension", [".stl", ".ply", ".obj", ".3mf"])
@pytest.mark.parametrize("gap", [1e-9, 2e-7, 1e-6, 4e-6])
def test_bodies_that_nearly_touch_stay_two_in_every_file(tmp_path, extension, gap):
    box = samples.box((10.0, 10.0, 10.0))
    # At the origin float32 tells more apart than decimals do; far from it, less.
    pair = concatenate(box, moved(box, (-10.0 - gap, 0.0, 0.0)), moved(box, (60.0, 70.0, 80.0)))
    surface, quality, notes = finish(TrimmedSurface(pair), measure(pair), Monitor(), deformed=False)
    path = tmp_path / f"a{extension}"
    write_mesh(surface.mesh, path)
    assert shells_read(path) == (quality.bodies, quality.voids, True) == (3, 0, True)
    assert notes == ()


def test_vertices_that_no_file_can_tell_apart_are_refused_with_their_place():
    box = samples.box((10.0, 10.0, 10.0))
    with pytest.raises(VolfrepError, match=r"Near \(.*single precision of files"):
        refuse_merging(concatenate(box, box))


def test_what_encloses_nothing_is_refused():
    for mesh in (samples.box().reversed(), concatenate(samples.box(), samples.box().reversed())):
        with pytest.raises(VolfrepError, match="no solid"):
            finish(TrimmedSurface(moved_apart(mesh)), measure(mesh), Monitor(), deformed=False)


def moved_apart(mesh):
    """No two vertices in one place."""
    random = np.random.default_rng(1)
    return TriangleMesh(mesh.vertices + 1e-3 * random.random(mesh.vertices.shape), mesh.triangles)


def test_flat_shells_that_go_leave_the_count_of_bodies_as_it_is():
    # Four corners in a plane: of no volume but rounding, whose sign depends on where it is seen.
    random = np.random.default_rng(3)
    faces = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], np.int32)
    flat = []
    for _ in range(40):
        plane = np.linalg.qr(random.normal(size=(3, 3)))[0][:, :2]
        corners = random.normal(size=(4, 2)) @ plane.T * 0.01
        flat.append(TriangleMesh(corners + random.uniform(-5.0, 25.0, 3), faces))
    mesh = concatenate(samples.box(), *flat)
    cleared = clear(TrimmedSurface(mesh), 1e-3, Monitor())
    assert len(cleared.surface.mesh.triangles) == 12
    assert (cleared.quality.bodies, cleared.quality.voids) == (1, 0)


@pytest.mark.costly
@pytest.mark.slow_cases("whole-0.0")
@pytest.mark.parametrize(
    ("boundary", "shell"),
    [
        ("trim", 1.0),
        ("whole", 0.0),
        pytest.param("trim", 0.0, marks=pytest.mark.slow),
        pytest.param("whole", 1.0, marks=pytest.mark.slow),
    ],
)
def test_the_report_counts_what_a_reader_of_the_file_does(tmp_path, shell, boundary):
    for k, cell in enumerate(("Box", "BCC", samples.SKEW)):
        spec = LatticeSpec(cell, 8.0, 0.7, shell=shell, boundary=boundary, resolution=12)
        result = fill(samples.box((31.0, 26.0, 24.0)), spec)
        path = tmp_path / f"{k}.stl"
        write_mesh(result.mesh, path)
        report = result.report
        assert shells_read(path) == (report.bodies, report.voids, True)
        assert trimesh.load(path).volume == pytest.approx(report.volume_mm3, rel=1e-6)


#: Three struts that touch neither each other nor the cells beside theirs.
APART = make_cell(
    "apart",
    [[0.2, 0.2, 0.2], [0.2, 0.2, 0.7], [0.5, 0.5, 0.2], [0.5, 0.5, 0.6], [0.8, 0.8, 0.2],
     [0.8, 0.8, 0.8]],
    [[0, 1], [2, 3], [4, 5]],
)  # fmt: skip


def test_pieces_that_are_left_out_are_told_with_their_share():
    spec = LatticeSpec(APART, 10.0, 0.8, shell=0, boundary="whole", activation="inside")
    report = fill(samples.box((20.0, 10.0, 10.0)), spec).report
    # Capsules of 5, 4 and 6 mm, twice; one of the longest stays.
    joint = 0.8 * 1.08
    volume = [np.pi * 0.64 * length + 4.0 / 3.0 * np.pi * joint**3 for length in (5, 4, 6)]
    share = 1.0 - report.volume_mm3 / (2 * sum(volume))
    told = next(text for text in report.warnings if "left out" in text)
    assert report.pieces_removed == 5
    assert told.startswith("5 pieces that hang on nothing left out, ")
    assert float(told.split("left out, ")[1].split(" %")[0]) == pytest.approx(100 * share, abs=2)


@pytest.mark.costly
def test_a_lattice_of_many_bodies_is_told():
    solid = samples.box((31.0, 26.0, 24.0))
    cut = fill(solid, LatticeSpec(APART, 10.0, 0.8, shell=2, output="lattice")).report
    assert cut.bodies > 1
    assert any(f"{cut.bodies} bodies that do not touch" in text for text in cut.warnings)
    whole = fill(solid, LatticeSpec("Box", 10.0, 0.8, shell=0)).report
    assert not any("hang" in text or "touch" in text for text in whole.warnings)


@pytest.mark.slow
def test_graded_struts_that_run_through_each_other_are_told_with_their_place(monkeypatch):
    # Next to the axis the cells of a cylinder are narrower than their struts.
    spec = LatticeSpec("CVC", 10.0, 0.9, resolution=15, cell_map=CellMap("cylindrical"))
    apart = block(spec, (6, 5, 1))
    every = np.ones(apart.report.triangles, bool)
    assert not crossing_triangles(apart.mesh, every, 1e-2).any()
    assert not any("run through" in sentence for sentence in apart.report.warnings)
    # Of 14,000 pairs where these are thicker still a few are left.
    thick = LatticeSpec("CVC", 10.0, 1.0, resolution=15, cell_map=CellMap("cylindrical"))
    left = block(thick, (6, 5, 1))
    assert "facets run through each other" in left.report.warnings[-1]
    # As they come out of the grading:
    monkeypatch.setattr("volfrep.trim.finish.resolve_fold_crossings", lambda mesh, *_: (mesh, None))
    result = block(spec, (6, 5, 1))
    assert crossing_triangles(result.mesh, every, 1e-2).any()
    assert "run through each other there" in result.report.warnings[-1]
    plain = block(LatticeSpec("CVC", 10.0, 1.0, resolution=15), (2, 2, 1))
    assert plain.report.warnings == ()


def test_slivers_stay_where_facets_would_cross_without_them(monkeypatch):
    box = samples.box()

    def bad(mesh, tolerance, among=None, backend=None):
        every, none = np.arange(len(mesh.triangles)), np.zeros(0, np.int64)
        # A corner through the opposite faces.
        through = mesh.vertices[:1] + np.array([70.0, 55.0, 40.0])
        return Repair(every, mesh.triangles, every, every >= 0, every[:1], through, none)

    monkeypatch.setattr("volfrep.trim.finish.repair_slivers", bad)
    assert tidy(TrimmedSurface(box), 1e-4, Monitor()).mesh is box


@pytest.mark.costly
def test_slivers_away_from_all_octants_take_none_of_these_along(monkeypatch):
    """Whatever edges they have: no octant has any there."""

    def rebuilt(mesh, tolerance, among=None, backend=None):
        corner = mesh.vertices.sum(axis=1).argmin()
        rows, none = np.flatnonzero((mesh.triangles == corner).any(axis=1)), np.zeros(0, np.int64)
        piece, every = mesh.triangles[rows], np.arange(len(rows))
        return Repair(rows, piece, every, every >= 0, none, np.zeros((0, 3)), none)

    monkeypatch.setattr("volfrep.trim.finish.repair_slivers", rebuilt)
    monkeypatch.setattr(TrimmedSurface, "has_inner_edges", lambda surface, triangles: True)
    solid = samples.box((36.0, 36.0, 36.0))
    surface = fill(solid, LatticeSpec("Box", 6.0, 0.5, shell=1.0)).surface
    assert surface.octants is not None


def test_new_triangles_are_those_that_were_not_there():
    part = samples.sphere(20.0, 3)
    # One edge made shorter than the tolerance.
    a, b = part.triangles[100, :2]
    vertices = part.vertices.copy()
    vertices[b] = vertices[a] + 3e-5
    pinched = TriangleMesh(vertices, part.triangles)
    repair = repair_slivers(pinched, 1e-4)
    mesh, number = repair.applied(pinched)
    new = np.pad(repair.new, (len(mesh.triangles) - len(repair.new), 0))
    stays = np.flatnonzero(repair.stays(pinched))
    origin = np.concatenate([stays, repair.old[repair.origin]])
    assert len(mesh.triangles) == len(part.triangles) - 2

    def places(mesh, rows):
        corners = np.sort(mesh.vertices[mesh.triangles[rows]].round(7), axis=1)
        return {tuple(row.ravel()) for row in corners}

    old = places(pinched, np.ones(len(pinched.triangles), bool))
    assert 0 < new.sum() < 10
    assert not places(mesh, new) & old
    assert places(mesh, ~new) <= old
    np.testing.assert_array_equal(mesh.triangles[~new], number[pinched.triangles[origin[~new]]])
    for row in np.flatnonzero(~new):
        assert places(mesh, [row]) == places(pinched, [origin[row]])


@pytest.mark.parametrize("is_less", [False, True])
def test_processes_leave_the_same_of_a_repaired_mesh(monkeypatch, is_less):
    one = samples.sphere(20.0, 3)
    both = concatenate(one, TriangleMesh(one.vertices + 60.0, one.triangles))
    a, b = both.triangles[100, :2]
    both.vertices[b] = both.vertices[a] + 3e-5
    repair = repair_slivers(both, 1e-4)
    goes = piece_goes = None
    if is_less:
        goes = np.arange(len(both.triangles)) >= len(one.triangles)
        piece_goes = np.zeros(len(repair.piece), bool)
    wanted, number = repair.applied(both, goes, piece_goes)
    monkeypatch.setattr(ParallelBackend, "uses_processes", True)
    monkeypatch.setattr(float32_repair, "CALL_ROWS", 500)
    found, same = repair.applied(both, goes, piece_goes)
    assert len(wanted.triangles) == len(one.triangles) * (2 - is_less) - 2
    assert isinstance(found.triangles.base, np.memmap)
    assert number.tobytes() == same.tobytes()
    assert wanted.vertices.tobytes() == found.vertices.tobytes()
    assert wanted.triangles.tobytes() == found.triangles.tobytes()


@pytest.mark.costly
def test_vertices_at_the_rim_of_octants_beside_the_mesh_take_these_along(monkeypatch):
    """Drawn apart alone they would leave the octants, which have them where they were."""
    moved = []

    def nudged(mesh, *_):
        rim = rim_of(mesh)
        vertices = mesh.vertices.copy()
        vertices[rim[:1]] += 1e-4
        moved.append(len(rim))
        return TriangleMesh(vertices, mesh.triangles), None

    monkeypatch.setattr("volfrep.trim.finish.resolve_fold_crossings", nudged)
    result = fill(samples.box((36.0, 36.0, 36.0)), LatticeSpec("Box", 6.0, 0.5, shell=1.0))
    assert moved[0]
    assert result.report.watertight
    assert result.report.bodies == 1


@pytest.mark.costly
def test_octants_about_facets_that_cross_go_along_and_the_others_stay_beside(monkeypatch):
    at_rim = []

    def crossing(mesh, *_, looks):
        at_rim.append(rim_of(mesh)[0])
        pair = np.flatnonzero((mesh.triangles == at_rim[0]).any(axis=1))[:2]
        return Folds(np.zeros(len(mesh.triangles), bool), pair[None])

    def nudged(mesh, monitor, deformed, turns):
        assert len(turns.among) == len(mesh.triangles)
        vertices = mesh.vertices.copy()
        vertices[at_rim[0]] += 1e-4
        return TriangleMesh(vertices, mesh.triangles), None

    monkeypatch.setattr("volfrep.trim.finish.folds_of", crossing)
    monkeypatch.setattr("volfrep.trim.finish.resolve_fold_crossings", nudged)
    result = fill(samples.box((36.0, 36.0, 36.0)), LatticeSpec("Box", 6.0, 0.5, shell=1.0))
    assert result.surface.octants is not None
    assert result.surface.is_joined
    assert result.report.watertight
    assert len(at_rim) == 1


def moving(surface: TrimmedSurface, vertex: int) -> MendedSurface:
    """A surface of which one vertex moves."""
    triangles = surface.mesh.triangles
    has = (triangles == vertex).any(axis=1)
    old, row = np.flatnonzero(has), np.array([vertex])
    beside = np.flatnonzero(np.isin(triangles, triangles[old]).any(axis=1) & ~has)
    there, none = surface.mesh.vertices[row] + 1e-3, np.zeros(0, np.int64)
    every = np.arange(len(old)), np.ones(len(old), bool)
    return MendedSurface(surface, Repair(old, triangles[old], *every, row, there, none), beside)


@pytest.mark.costly
def test_a_surface_stays_joined_where_nothing_at_the_octants_rim_moves():
    spec = LatticeSpec("Box", 6.0, 0.5, shell=1.0)
    surface = fill(samples.box((36.0, 36.0, 36.0)), spec).surface
    at_rim = surface.rim_rows
    inner = np.setdiff1d(np.arange(len(surface.mesh.vertices)), at_rim)
    for vertex, joined in ((at_rim[0], False), (inner[0], True)):
        changed = moving(surface, int(vertex))
        assert changed.is_joined_as_before == joined
        assert changed.applied().is_joined == joined


def grazed():
    """In a part of 180 mm, as steps of single precision are as long as these facets are high."""
    corner = samples.box((1.0, 1.0, 1.0))
    return concatenate(
        TriangleMesh(np.array(GRAZED), np.array(GRAZED_FACETS, np.int32)),
        moved(corner, (178.0, 0.0, 0.0)),
    )


def test_facets_that_cannot_go_stay_as_far_apart_as_they_were_drawn(monkeypatch):
    larger = moved(samples.box((3.0, 3.0, 3.0)), (160.0, 0.0, 0.0))  # what is finished is a solid
    mesh, monitor = concatenate(grazed(), larger), Monitor()
    drawn, place = resolve_fold_crossings(mesh, monitor, True)
    assert place is not None
    assert (drawn.vertices != mesh.vertices).any()
    monkeypatch.setattr("volfrep.trim.finish.thinned", lambda *_: None)
    surface, _, notes = finish(TrimmedSurface(mesh), measure(mesh), monitor, True)
    assert np.array_equal(surface.mesh.vertices, drawn.vertices)
    assert notes


def test_facets_that_are_all_but_lines_go_where_they_cross():
    mesh, monitor = grazed(), Monitor()
    turns = folds_of(mesh, monitor, True)
    assert len(turns.pairs)
    assert resolve_fold_crossings(mesh, monitor, True, turns)[1] is not None
    surface, apart, mended = thinned(TrimmedSurface(mesh), turns, monitor, True)
    # What its parts tell of a surface changes nothing, and is told of what is left, too.
    every, step = np.zeros(0, np.int64), decimal_step(mesh.vertices)
    looks = look_at(mesh, every, True, step, lambda rows: np.ones(len(rows), bool), monitor)
    known = thinned(TrimmedSurface(mesh, looks=looks), turns, monitor, True)
    assert np.array_equal(known[1].vertices, apart.vertices)
    assert known[0].looks is not None
    assert len(known[0].looks.marks) == len(apart.triangles)
    assert not len(folds_of(apart, monitor, True).pairs)
    assert len(mesh.triangles) - 8 < len(apart.triangles) < len(mesh.triangles)
    assert surface.mesh.area == pytest.approx(mesh.area, rel=1e-5)
    # What has gone tells the quality of what is left.
    told, found = mended.quality_after(measure(mesh), surface.bounds, 1e-3), measure(surface.mesh)
    assert mended.quality_after(measure(mesh), surface.bounds, 0.0) is None
    assert told is not None
    assert told.triangles == found.triangles
    assert (told.vertices, told.genus, told.shells) == (found.vertices, found.genus, found.shells)
    assert told.volume == pytest.approx(found.volume, rel=1e-12)
    assert told.area == pytest.approx(found.area, rel=1e-12)
