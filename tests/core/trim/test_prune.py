# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells that stay whole, and struts with a free end."""

from dataclasses import replace

import numpy as np
import pytest

import samples
from contract import check_contract
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.cells import PAPERS, find_cell
from volfrep.design.grading import RadiusGrading, SizeGrading
from volfrep.design.profile import Profile
from volfrep.design.spec_parts import FlatStruts
from volfrep.grid.strut_graph import Wireframe
from volfrep.io.write.stl import as_read
from volfrep.jobs.pipeline import fill
from volfrep.mesh import quality
from volfrep.trim.prune import remaining

WHOLE = LatticeSpec(cell_size=8, strut_radius=0.8, shell=0, boundary="whole", resolution=10)


def degrees(frame):
    return np.bincount(frame.struts.ravel(), minlength=len(frame.nodes))


def graph(nodes, struts):
    nodes = np.array(nodes, float)
    struts = np.array(struts, np.int32)
    radii = np.full((len(struts), 2), 0.1)
    return Wireframe(nodes, struts, radii, np.full(len(nodes), 0.11))


# A triangle with a tail of two struts, the last of them short.
TAILED = graph(
    [[0, 0, 0], [2, 0, 0], [1, 2, 0], [4, 0, 0], [4.5, 0, 0]],
    [[0, 1], [1, 2], [0, 2], [1, 3], [3, 4]],
)


@pytest.mark.parametrize(
    ("shortest", "dangling", "kept", "counts"),
    [
        (0.0, True, [1, 1, 1, 0, 0], (0, 2)),
        (1.0, False, [1, 1, 1, 1, 0], (1, 0)),
        (3.0, False, [1, 1, 1, 0, 0], (2, 0)),
        (1.0, True, [1, 1, 1, 0, 0], (1, 1)),
        (0.0, False, [1, 1, 1, 1, 1], (0, 0)),
    ],
)
def test_free_ends_go_from_the_tip_on(shortest, dangling, kept, counts):
    left = remaining(TAILED, None, has_skin=False, shortest=shortest, dangling=dangling)
    assert left.kept.tolist() == [bool(k) for k in kept]
    assert (left.stubs, left.dangling) == counts


def test_thin_struts_go_and_those_that_then_have_a_free_end():
    radii = np.array([[0.1, 0.1], [0.1, 0.3], [0.3, 0.3], [0.3, 0.1], [0.1, 0.1]])
    lattice = replace(TAILED, radii=radii)
    free = {"has_skin": False, "shortest": 0.0, "thickest": 0.1}
    left = remaining(lattice, None, dangling=False, **free)
    assert left.kept.tolist() == [False, True, True, True, False]
    assert (left.thin, left.stubs, left.dangling) == (2, 0, 0)
    left = remaining(lattice, None, dangling=True, **free)
    assert not left.kept.any()  # an open chain is left, which goes from both ends
    assert (left.thin, left.dangling) == (2, 3)


def test_struts_that_lie_flat_go_and_those_that_then_have_a_free_end():
    """A chain up, across, up and across: its first two pieces stand, the last one hangs free."""
    nodes = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 2], [0, 0, 2.0], [0, 1, 3]])
    struts = np.array([[0, 1], [1, 2], [2, 3], [3, 4], [1, 4], [4, 0], [4, 5]], np.int32)
    lattice = Wireframe(nodes, struts, np.ones((7, 2)), np.ones(6))
    free = {"has_skin": False, "shortest": 0.0, "dangling": False}
    left = remaining(lattice, None, **free, flat=FlatStruts(45.0))
    assert left.kept.tolist() == [True, False, False, False, True, True, False]
    assert (left.flat, left.dangling) == (2, 2)
    # The last strut rises as much as it goes aside: of just the inclination it is not too flat.
    assert remaining(lattice, None, **free, flat=FlatStruts(46.0)).flat == 3
    along_x = remaining(lattice, None, **free, flat=FlatStruts(45.0, (2.0, 0.0, 0.0)))
    assert along_x.flat == 5


def test_a_skin_holds_what_it_cuts_and_an_open_wall_does_not():
    wall = samples.box((4.0, 10.0, 2.0), (-0.7, -5.0, -1.1))  # through the tail's first strut
    held = remaining(TAILED, wall, has_skin=True, shortest=0.0, dangling=True)
    free = remaining(TAILED, wall, has_skin=False, shortest=0.0, dangling=True)
    assert held.kept.tolist() == [True] * 5
    # The last strut lies outside: it is cut away, and not counted.
    assert free.kept.tolist() == [True, True, True, False, True]
    assert free.dangling == 1
    short = remaining(TAILED, wall, has_skin=False, shortest=1.2, dangling=False)
    assert not short.stubs  # 1.3 of it are inside
    assert remaining(TAILED, wall, has_skin=False, shortest=1.4, dangling=False).stubs == 1


def test_a_wall_just_below_the_nodes_leaves_them_joined():
    """Boxes like cells: a lattice's outermost nodes often lie on the wall, or a hair outside."""
    square = graph([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], [[0, 1], [1, 2], [2, 3], [3, 0]])
    wall = samples.box((1.99, 4.0, 2.0), (-0.01, -1.0, -1.0))  # leaves two nodes 0.02 outside
    assert remaining(square, wall, has_skin=False, shortest=0.0, dangling=True).kept.all()
    wall = samples.box((1.9, 4.0, 2.0), (-0.01, -1.0, -1.0))
    left = remaining(square, wall, has_skin=False, shortest=0.0, dangling=True)
    assert left.kept.tolist() == [False, True, False, False]  # the one outside is cut away


@pytest.mark.slow_but("CVC-centre", "CVC-inside", "CVC-touching")
@pytest.mark.parametrize(
    ("cell", "activation"),
    [
        pytest.param(c, a, marks=() if a == "centre" or c == "CVC" else pytest.mark.slow)
        for c in PAPERS
        for a in ("inside", "centre", "touching")
    ],
)
def test_whole_cells_have_the_genus_of_their_graph(cell, activation):
    """Closed form: struts - nodes + 1 loops, as nothing was cut."""
    result = fill(samples.sphere(16.0), replace(WHOLE, cell=cell, activation=activation))
    report = result.report
    assert report.watertight
    assert (report.bodies, report.voids) == (1, 0)
    assert report.genus == result.wireframe.genus


@pytest.mark.costly
def test_whole_cells_are_told_apart_by_where_they_lie():
    solid = samples.sphere(24.0)
    active = {}
    for activation in ("inside", "centre", "touching"):
        result = fill(solid, replace(WHOLE, cell="Box", activation=activation))
        active[activation] = result.report.cells_active
        reach = np.linalg.norm(result.wireframe.nodes, axis=1).max()
        # Nodes of whole cells inside lie inside; those of others may stick out by a cell.
        assert (reach < 24.0) == (activation == "inside")
    # Cells of the 6 x 6 x 6 about the ball, counted by their corners.
    corner = np.indices((6, 6, 6)).reshape(3, -1).T * 8.0 - 24.0
    far = np.maximum(np.abs(corner), np.abs(corner + 8.0))
    assert active["inside"] == (np.linalg.norm(far, axis=1) < 24.0).sum()
    assert active["inside"] < active["centre"] < active["touching"]


def strut_volume(frame, radius, low, high, points):
    """Monte Carlo: the volume of a wireframe's struts and joint spheres, and its deviation."""
    sample = np.random.default_rng(3).uniform(low, high, (points, 3))
    gap = np.full(points, np.inf)
    for a, b in frame.struts:
        start, along = frame.nodes[a], frame.nodes[b] - frame.nodes[a]
        share = np.clip((sample - start) @ along / (along @ along), 0.0, 1.0)
        off = np.linalg.norm(sample - start - share[:, None] * along, axis=1)
        gap = np.minimum(gap, off - radius)
    for node, joint in zip(frame.nodes, frame.joint_radii, strict=True):
        gap = np.minimum(gap, np.linalg.norm(sample - node, axis=1) - joint)
    box = np.prod(np.subtract(high, low))
    share = (gap < 0.0).mean()
    return box * share, box * np.sqrt(share * (1.0 - share) / points)


@pytest.mark.slow
def test_whole_cells_fill_the_volume_of_their_struts():
    solid = samples.box((25.0, 17.0, 9.0))
    spec = replace(WHOLE, cell="Octet", activation="inside", resolution=None)
    result = fill(solid, spec)
    assert result.report.cells_active == 3 * 2 * 1
    volume, deviation = strut_volume(result.wireframe, 0.8, (-1, -1, -1), (25, 17, 9), 60_000)
    assert result.report.volume_mm3 == pytest.approx(volume, abs=0.005 * volume + 3 * deviation)


@pytest.mark.slow_but("inside")
@pytest.mark.parametrize("activation", ["inside", "centre", "touching"])
def test_no_free_end_is_left_in_whole_cells(activation):
    solid = samples.sphere(16.0)
    spec = replace(WHOLE, cell="CVC", activation=activation)
    before = fill(solid, spec)
    after = fill(solid, replace(spec, remove_dangling=True))
    lost = after.report.struts_dangling_removed
    assert lost > 0
    assert degrees(before.wireframe).min() == 1
    assert degrees(after.wireframe).min() >= 2
    assert after.report.struts == before.report.struts - lost
    # A free strut adds material and no loop.
    assert after.report.genus == before.report.genus == after.wireframe.genus
    assert after.report.volume_mm3 < before.report.volume_mm3
    read = quality.measure(as_read(after.mesh))
    assert read.watertight
    assert (read.bodies, read.genus) == (1, after.report.genus)


def test_a_strut_taken_away_takes_its_volume():
    """One CVC cell loses everything, so two that share a face lose all but their ring."""
    solid = samples.box((16.0, 8.0, 8.0))
    spec = replace(WHOLE, cell="CVC", remove_dangling=True, resolution=None)
    result = fill(solid, spec)
    # Two centres joined by the four corners of the common face.
    assert (result.report.nodes, result.report.struts) == (6, 8)
    assert result.report.struts_dangling_removed == 8
    assert result.report.genus == 3
    volume, deviation = strut_volume(result.wireframe, 0.8, (0, -1, -1), (16, 9, 9), 100_000)
    assert result.report.volume_mm3 == pytest.approx(volume, abs=0.005 * volume + 3 * deviation)


@pytest.mark.slow
def test_without_a_skin_trimming_leaves_stubs_that_can_go():
    solid = samples.sphere(12.0)
    spec = LatticeSpec(cell="CVC", cell_size=8, strut_radius=0.8, shell=0, resolution=8)
    runs = {
        limit: fill(solid, replace(spec, shortest_stub=limit)).report for limit in (0.0, 2.0, 4.0)
    }
    assert runs[0.0].stubs_removed == 0
    assert 0 < runs[2.0].stubs_removed < runs[4.0].stubs_removed
    every = fill(solid, replace(spec, remove_dangling=True)).report
    assert every.struts_dangling_removed > runs[4.0].stubs_removed
    volumes = [runs[0.0], runs[2.0], runs[4.0], every]
    assert sorted((r.volume_mm3 for r in volumes), reverse=True) == [r.volume_mm3 for r in volumes]
    assert all(r.watertight and r.bodies == 1 for r in volumes)


def test_a_skin_holds_every_strut_that_it_cuts():
    spec = LatticeSpec(
        cell="FCC", cell_size=8, strut_radius=0.8, shell=2, resolution=10, remove_dangling=True
    )
    report = fill(samples.sphere(16.0), spec).report
    assert report.struts_dangling_removed == 0


@pytest.mark.costly
def test_with_a_skin_whole_cells_are_joined_to_it():
    """What sticks out is cut at the outside: the part is that of the trimmed lattice."""
    solid = samples.sphere(16.0)
    spec = LatticeSpec(cell="Octet", cell_size=8, strut_radius=0.8, shell=2, resolution=10)
    trimmed, whole = (fill(solid, replace(spec, boundary=b)).report for b in ("trim", "whole"))
    assert whole.volume_mm3 == pytest.approx(trimmed.volume_mm3, rel=1e-4)
    assert (whole.bodies, whole.genus) == (trimmed.bodies, trimmed.genus)


@pytest.mark.costly
def test_a_lattice_that_nothing_holds_is_refused():
    spec = replace(WHOLE, boundary="trim", shell=2, activation="inside")
    with pytest.raises(VolfrepError, match="No strut reaches the skin"):
        fill(samples.sphere(24.0), spec)
    with pytest.raises(VolfrepError, match="No strut reaches the skin"):
        fill(samples.sphere(24.0), replace(spec, output="lattice"))


def test_cells_that_never_lie_wholly_inside_are_refused():
    spec = LatticeSpec(cell_size=15, strut_radius=1, shell=2, activation="inside")
    with pytest.raises(VolfrepError, match="No cell of 15 mm lies wholly inside"):
        fill(samples.box((40.0, 16.0, 16.0)), spec)


@pytest.mark.slow
def test_graded_lattices_lose_free_ends_too():
    solid = samples.sphere(16.0)
    profile = Profile("linear", 1.0, 1.6)
    for spec in (
        replace(WHOLE, cell="CVC", size_grading=SizeGrading(profile)),
        replace(
            WHOLE,
            cell="CVC",
            radius_grading=RadiusGrading("direction", Profile("linear", 0.5, 0.9)),
        ),
    ):
        result = fill(solid, replace(spec, activation="centre", remove_dangling=True))
        assert result.report.struts_dangling_removed > 0
        assert degrees(result.wireframe).min() >= 2
        assert result.report.genus == result.wireframe.genus
        assert quality.measure(as_read(result.mesh)).watertight


@pytest.mark.slow_cases("0")
@pytest.mark.parametrize(
    "seed", [pytest.param(s, marks=pytest.mark.slow if s >= 1 else ()) for s in range(12)]
)
def test_random_boundaries_hold_the_contract(seed):
    random = np.random.default_rng(seed)
    solid = (samples.bracket(17.0), samples.plate(), samples.sphere())[seed % 3]
    spec = LatticeSpec(
        cell=random.choice([*map(find_cell, PAPERS), samples.SKEW]),
        cell_size=float(random.uniform(6.0, 9.0)),
        strut_radius=float(random.uniform(0.3, 0.6)),
        shell=float(random.choice([0.0, 1.0])),
        activation=str(random.choice(["touching", "centre", "inside"])),
        boundary=str(random.choice(["trim", "whole"])),
        remove_dangling=bool(random.integers(2)),
        shortest_stub=float(random.choice([0.0, 1.5])),
        resolution=int(random.integers(8, 14)),
    )
    check_contract(solid, spec, refusals=("reduce",))
