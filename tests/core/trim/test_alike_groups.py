# SPDX-License-Identifier: LGPL-2.1-or-later
"""Groups that are cut alike: copies are what a cut of each of them leaves."""

import manifold3d
import numpy as np
import pytest
import trimesh
from test_boolean_trim import trimmed

from volfrep import LatticeSpec
from volfrep.design.cells import UnitCell
from volfrep.design.openings import DrainHoles, DrainPlace
from volfrep.io.write.stl import as_read
from volfrep.jobs.infill import Infill
from volfrep.mesh import quality
from volfrep.mesh.booleans import as_mesh
from volfrep.mesh.float32_repair import shortest_edge
from volfrep.spatial.piercing import piercing_pairs
from volfrep.spatial.resolve_crossings import folds_of
from volfrep.trim import alike_groups, boolean_trim, flat_walls, octant_groups
from volfrep.util.progress import Monitor


@pytest.fixture(autouse=True)
def _tiles_welcome(monkeypatch):
    """However little of a wall they are."""
    monkeypatch.setattr(flat_walls, "LEAST_SHARE", 0.0)


@pytest.fixture
def small_groups(monkeypatch):
    monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", 12_000)


def plate(size=(122.0, 97.0, 13.0)):
    """With a hole, whose flat faces a library has cut into needles."""
    solid, hole = manifold3d.Manifold.cube(size), manifold3d.Manifold.cylinder(60.0, 6.0, 6.0, 24)
    return as_mesh(solid - hole.translate((9.0, 11.0, -9.0)))


SMALL, LARGE = plate(), plate((162.0, 131.0, 23.0))
#: Stars that touch nothing: where a wall meets none only a solid one tells what is inside. They are
#: smaller than the squares, too, which stay whole.
ARMS = np.concatenate([np.zeros((1, 3)), 0.3 * np.eye(3), -0.3 * np.eye(3)])
STAR = UnitCell("Star", 0.5 + ARMS, np.array([[0, k] for k in range(1, 7)]))


@pytest.mark.slow_but("small CVC", "small stars")
@pytest.mark.parametrize(
    ("domain", "name", "cavity"),
    [
        pytest.param(SMALL, "CVC", True, id="small CVC"),
        pytest.param(SMALL, "Octet", False, id="small Octet"),
        pytest.param(SMALL, STAR, False, id="small stars"),
        pytest.param(LARGE, "CVC", True, id="large CVC"),
        pytest.param(LARGE, "Octet", False, id="large Octet"),
    ],
)
def test_copies_give_the_surface_that_one_boolean_gives(
    domain, name, cavity, small_groups, monkeypatch
):
    monitor = Monitor()
    some = trimmed(
        domain, name, cavity=cavity, precision=shortest_edge(domain), monitor=monitor
    ).surface
    assert monitor.work["groups copied"] > 1
    assert name is not STAR or monitor.work["groups cut again at a solid wall"]
    mesh = some.whole(Monitor())
    judge = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert judge.is_watertight
    assert judge.is_winding_consistent
    monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", 10**9)
    one = trimmed(domain, name, cavity=cavity).surface.whole(Monitor())
    assert judge.volume == pytest.approx(one.volume, rel=1e-9)
    assert judge.area == pytest.approx(quality.measure(one).area, rel=1e-9)
    one = trimesh.Trimesh(one.vertices, one.triangles, process=False)
    assert judge.euler_number == one.euler_number
    assert not len(piercing_pairs(mesh))
    # What is known of the copies is what a look at all of it finds.
    told, looked = some.inspected(Monitor()).found.quality, quality.measure(mesh)
    assert told.volume == pytest.approx(looked.volume, rel=1e-9)
    assert (told.genus, told.shells) == (looked.genus, looked.shells)
    known, plain = (folds_of(some.mesh, Monitor(), looks=looks) for looks in (some.looks, None))
    np.testing.assert_array_equal(known.among, plain.among)
    np.testing.assert_array_equal(known.pairs, plain.pairs)


def test_a_copy_is_what_a_cut_of_its_group_leaves(small_groups, monkeypatch):
    """Where octants follow and where they are looked for by equal numbers, to the last bit."""
    copied, taken, real = {}, {}, boolean_trim.find_alike

    def noted(groups, which, cavity, *calls):
        found = real(groups, which, cavity, *calls)
        taken.update(
            {k: groups.group(k, cavity) for each in found.values() for k, _ in each.others}
        )
        return found

    def copies(self, piece):
        found = every(self, piece)
        copied.update(found)
        return found

    every = alike_groups.Alike.copies
    monkeypatch.setattr(boolean_trim, "find_alike", noted)
    monkeypatch.setattr(alike_groups.Alike, "copies", copies)
    domain = plate()
    trimmed(domain, precision=shortest_edge(domain))
    assert len(copied) == len(taken) > 3
    for number in list(copied)[:2]:
        copy, group = copied[number], taken[number]
        own = boolean_trim.cut_group(group)
        assert copy.shells.volume == pytest.approx(own.shells.volume, rel=1e-9)
        assert copy.shells.area == pytest.approx(own.shells.area, rel=1e-9)
        rims = [each.mesh.vertices[each.rim] for each in (copy, own)]
        rims = [rim[np.lexsort(np.round(rim, 6).T)] for rim in rims]
        np.testing.assert_allclose(*rims, atol=1e-12)
        both = group.own | group.adjacent
        octants = group.placed.mesh(group.placed.facets(both, Monitor()), both, Monitor())[0]
        at_octants = [set(map(tuple, octants.vertices)) & set(map(tuple, rim)) for rim in rims]
        assert at_octants[0] == at_octants[1]
        assert len(at_octants[0]) > 20


def test_other_octants_or_another_wall_are_not_alike(small_groups):
    """A plate that grows thicker by a step has the same groups on either side of that only."""
    step = manifold3d.Manifold.cube((80.0, 131.0, 3.7)).translate((0, 0, 23.0))
    monitor, domain = Monitor(), as_mesh(manifold3d.Manifold.cube((162.0, 131.0, 23.0)) + step)
    surface = trimmed(domain, monitor=monitor).surface
    assert monitor.work["groups copied"] > 5
    mesh = surface.whole(Monitor())
    assert trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).is_watertight
    assert quality.measure(mesh).volume == pytest.approx(mesh.volume)


@pytest.fixture
def plates(monkeypatch):
    """Makes finished plates: with small groups, or cut as one."""

    def made(groups=4_000, **spec):
        monkeypatch.setattr(octant_groups, "GROUP_TRIANGLES", groups)
        corner, size = PLATE
        solid = as_mesh(manifold3d.Manifold.cube(tuple(size)).translate(tuple(corner)))
        spec = LatticeSpec("Box", cell_size=2.0, strut_radius=0.2, shell=0.5, **spec)
        part = Infill(solid, spec).part
        mesh = as_read(part.mesh)
        judge = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
        assert judge.is_watertight
        assert judge.is_winding_consistent
        return part.report, judge

    return made


#: Lowest corner and size, mm.
PLATE = np.array([3.0, -2.0, 1.0]), np.array([45.0, 37.0, 7.0])


def test_a_file_with_copies_holds_the_skin_and_the_struts(plates):
    """By random points, and distances to walls and axes."""
    report, judge = plates(resolution=16)
    assert report.work["groups copied"] > 8
    size = PLATE[1]
    points = np.random.default_rng(3).uniform(0.0, 1.0, (2_000_000, 3)) * size
    skin = (np.minimum(points, size - points) < 0.5).any(axis=1)
    away = np.abs((points + 1.0) % 2.0 - 1.0) ** 2
    strut = (away.sum(axis=1)[:, None] - away < 0.2**2).any(axis=1)
    share = (skin | strut).mean()
    error = np.sqrt(share * (1.0 - share) / len(points)) / share
    assert judge.volume == pytest.approx(share * size.prod(), rel=4.0 * error + 1e-3)


def test_a_file_with_copies_and_drain_holes_is_that_of_one_cut(plates):
    places = (12.3, 8.1, 1.0), (30.2, 20.7, 8.0), (41.9, 4.4, 1.0)
    drains = DrainHoles(1.5, tuple(map(DrainPlace, places)))
    (report, judge), (one, alone) = (
        plates(groups, resolution=5, drains=drains) for groups in (4_000, 10**9)
    )
    assert report.work["groups copied"] > 8
    assert "groups copied" not in one.work
    assert judge.volume == pytest.approx(alone.volume, rel=1e-8)
    assert judge.area == pytest.approx(alone.area, rel=1e-7)
    assert judge.euler_number == alone.euler_number
    assert not report.voids
