# SPDX-License-Identifier: LGPL-2.1-or-later
"""Any graph of nodes and struts has one closed surface, of its genus and its volume."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from exact import volume_of_struts
from volfrep import LatticeSpec, VolfrepError
from volfrep.graphs.surface import FEWEST_SIDES, graph_surface, sides_for
from volfrep.grid.strut_graph import Wireframe
from volfrep.io.write.stl import as_read
from volfrep.jobs.blocks import block, block_wireframe
from volfrep.mesh.quality import measure
from volfrep.spatial.winding import windings
from volfrep.util.progress import Monitor


def frame_of(nodes, struts, radius=1.0, ball=1.1):
    """A wireframe of one radius, or of one for each node."""
    struts = np.array(struts, np.int32)
    radii = np.broadcast_to(np.asarray(radius, float), len(nodes))
    return Wireframe(np.array(nodes, float), struts, radii[struts], ball * radii)


def pieces(frame):
    joined = csr_array((frame.struts[:, 0] >= 0, frame.struts.T), shape=(len(frame.nodes),) * 2)
    return connected_components(joined, directed=False)[0]


def apart(count, random, least, tries=4000):
    """Directions that are at least so many degrees from each other."""
    cosine = np.cos(np.radians(least))
    found = np.zeros((0, 3))
    for _ in range(tries):
        way = random.normal(size=3)
        way /= np.linalg.norm(way)
        if not len(found) or (found @ way).max() < cosine:
            found = np.concatenate([found, way[None]])
        if len(found) == count:
            return found
    return apart(count, random, least - 2.0)


def random_graph(number):
    """Two joints of 2 to 20 struts each, a strut between them, and loops at their arms' ends."""
    random = np.random.default_rng(number)
    valence = 2 + number % 19
    nodes, struts, radius = [np.zeros(3), np.array([60.0, 0.0, 0.0])], [(0, 1)], [1.0, 1.0]
    for hub, towards in ((0, 1.0), (1, -1.0)):
        ways = apart(valence, random, 28.0)
        # The strut to the other joint is one of them.
        axis = np.array([towards, 0.0, 0.0])
        turn = _turned(ways[0], axis)
        for way in ways[1:] @ turn.T:
            end = nodes[hub] + random.uniform(14.0, 22.0) * way
            # A triangle of struts at each arm's end.
            side = np.cross(way, random.normal(size=3))
            side /= np.linalg.norm(side)
            first = len(nodes)
            nodes += [end, end + 6.0 * way + 3.0 * side, end + 6.0 * way - 3.0 * side]
            struts += [(hub, first), (first, first + 1), (first, first + 2), (first + 1, first + 2)]
            radius += random.uniform(0.35, 0.6, 3).tolist()
    return frame_of(nodes, struts, np.array(radius))


def _turned(one, two):
    """A rotation of one unit vector to another, by two reflections."""
    middle = one + two + 1e-9
    middle /= np.linalg.norm(middle)
    return (2 * np.outer(middle, middle) - np.eye(3)) @ (2 * np.outer(one, one) - np.eye(3))


def surface_of(frame, sides=FEWEST_SIDES):
    return graph_surface(frame, sides, Monitor())


def holds_the_contract(frame, sides=FEWEST_SIDES, within=0.005, points=100_000):
    made = surface_of(frame, sides)
    read = measure(as_read(made.mesh))
    count = pieces(frame)
    assert read.watertight
    assert read.degenerate_triangles == 0
    assert read.bodies == count
    assert read.genus == len(frame.struts) - len(frame.nodes) + count
    assert read.volume == pytest.approx(volume_of_struts(frame, points), rel=within)
    return made


@pytest.mark.slow_cases("18")
@pytest.mark.parametrize(
    "number", [pytest.param(n, marks=pytest.mark.slow if n % 6 else ()) for n in range(20)]
)
def test_a_random_graph_with_joints_of_two_to_twenty_struts(number):
    frame = random_graph(number)
    assert np.bincount(frame.struts.ravel()).max() >= 2 + number % 19
    made = holds_the_contract(frame)
    assert made.united == 0
    # Nothing runs through itself: lines meet the surface in and out by turns.
    assert windings(made.mesh).odd < 1e-9 * made.mesh.volume


@pytest.mark.slow
@pytest.mark.parametrize("name", ["Octet", "Diamond"])
def test_a_block_of_cells_is_the_one_made_of_octants(name):
    spec = LatticeSpec(name, 10.0, 0.5)
    frame = block_wireframe(spec, (2, 1, 1))
    made = surface_of(frame)
    octants = block(LatticeSpec(name, 10.0, 0.5, deviation=0.005), (2, 1, 1)).report
    read = measure(made.mesh)
    assert (read.bodies, read.genus) == (octants.bodies, octants.genus)
    assert read.volume == pytest.approx(octants.volume_mm3, rel=4e-3)


@pytest.mark.parametrize("degrees", [10.0, 20.0, 30.0, 90.0, 180.0])
def test_two_struts_at_any_angle(degrees):
    turn = np.radians(degrees)
    nodes = [[0, 0, 0], [30, 0, 0], [30 * np.cos(turn), 30 * np.sin(turn), 0]]
    frame = frame_of(nodes, [(0, 1), (0, 2)])
    holds_the_contract(frame)


def test_struts_may_be_cones_and_balls_larger_than_they_are():
    nodes = [[0, 0, 0], [20, 0, 0], [0, 20, 0], [0, 0, 20]]
    struts = [(0, 1), (0, 2), (0, 3), (1, 2), (2, 3), (1, 3)]
    holds_the_contract(frame_of(nodes, struts, [1.5, 0.8, 1.0, 0.5]))
    holds_the_contract(frame_of(nodes, struts, 0.7, ball=2.0))


@pytest.mark.slow
def test_finer_facets_come_nearer_to_the_volume():
    frame = random_graph(4)
    exact = volume_of_struts(frame)
    coarse, fine = (surface_of(frame, sides).mesh.volume for sides in (10, 24))
    assert abs(fine / exact - 1) < 2e-3
    assert abs(coarse / exact - 1) < 5e-3


def test_a_deviation_says_how_many_facets():
    assert sides_for(1 / 35) == FEWEST_SIDES
    assert sides_for(0.002) == 36
    with pytest.raises(VolfrepError, match="the limit is 64"):
        sides_for(1e-4)


def overlapping_graphs():
    cross = frame_of([[-9, 0, 0], [9, 0, 0], [0, -9, 0.3], [0, 9, 0.3]], [(0, 1), (2, 3)])
    short = frame_of(
        [[0, 0, 0], [1.2, 0, 0], [0, 12, 0], [0, -12, 0], [1, 0, 12], [9, 9, 3]],
        [(0, 1), (0, 2), (0, 3), (1, 4), (1, 5)],
    )
    through = frame_of([[-9, 0, 0], [9, 0, 0], [0, 0.4, 0], [0, 9, 0]], [(0, 1), (2, 3)])
    return {"cross": cross, "short": short, "through": through}


@pytest.mark.costly_cases("through")
@pytest.mark.slow_but("through", "cross")
@pytest.mark.parametrize("name", overlapping_graphs())
def test_struts_that_overlap_are_united(name):
    frame = overlapping_graphs()[name]
    made = surface_of(frame)
    assert made.united > 0
    read = measure(as_read(made.mesh))
    assert read.watertight
    assert (read.bodies, read.genus) == (1, 0)
    assert read.volume == pytest.approx(volume_of_struts(frame), rel=0.02)


@pytest.mark.costly
def test_what_overlaps_is_welded_to_what_does_not():
    """Two struts that cross in the middle of an endless ring of others."""
    one, two = overlapping_graphs()["cross"], random_graph(3)
    far = two.nodes + np.array([0.0, 40.0, 0.0])
    struts = np.concatenate([one.struts, two.struts + 4, [[3, 4]]]).astype(np.int32)
    radius = np.concatenate([one.joint_radii, two.joint_radii]) / 1.1
    frame = frame_of(np.concatenate([one.nodes, far]), struts, radius)
    made = surface_of(frame)
    assert 0 < made.united < 8
    read = measure(as_read(made.mesh))
    assert read.watertight
    assert read.bodies == 1
    # The two struts that cross close one more loop than the graph has in its pieces.
    assert read.genus == len(frame.struts) - len(frame.nodes) + pieces(frame)
    assert read.volume == pytest.approx(volume_of_struts(frame), rel=0.01)
