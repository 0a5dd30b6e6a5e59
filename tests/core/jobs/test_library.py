# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every cell of the library makes blocks, parts and graded ones to the contract.

Closed, of known bodies and genus, of the volume that points find, and nothing runs through itself.
"""

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

import samples
from exact import volume_of_struts
from volfrep import LatticeSpec, StageCache
from volfrep.design.cells import LIBRARY
from volfrep.design.grading import RadiusGrading, SizeGrading
from volfrep.design.profile import Profile
from volfrep.io.write.stl import as_read
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh.quality import measure
from volfrep.spatial.even_points import even_points
from volfrep.spatial.piercing import piercing_pairs

_stages = StageCache()
SHELL = 1.5


def spec_of(name, size, shell=0.0, is_graded=False, **more):
    """A cell with its windows open, even or with struts and cells that grow."""
    radius = size * (0.05 if len(LIBRARY[name].struts) > 30 else 0.07)
    if is_graded:
        along = Profile("linear", 0.9 * radius, 1.1 * radius)
        more["radius_grading"] = RadiusGrading("direction", along)
        more["size_grading"] = SizeGrading(Profile("linear", 1.0, 1.4))
    return LatticeSpec(name, size, radius, shell, **more)


def is_sound(mesh):
    """Its quality as a file's reader sees it; closed, and no facet pierces another."""
    read_back = as_read(mesh)
    read = measure(read_back)
    assert read.watertight
    assert read.degenerate_triangles == 0
    assert len(piercing_pairs(read_back)) == 0
    return read


def holds_the_contract(result):
    """A body a piece of the wireframe, the genus of its graph, and its volume."""
    frame, read = result.wireframe, is_sound(result.mesh)
    joined = csr_array((frame.struts[:, 0] >= 0, frame.struts.T), shape=(len(frame.nodes),) * 2)
    pieces = connected_components(joined, directed=False)[0]
    assert (read.bodies, read.genus) == (pieces, len(frame.struts) - len(frame.nodes) + pieces)
    assert read.volume == pytest.approx(volume_of_struts(frame, 200_000), rel=0.005)


def depth_in_box(points, size=(40.0, 30.0, 20.0)):
    """How deep points lie in a box at the origin, mm; negative outside."""
    return np.minimum(points, size - points).min(axis=1)


def depth_in_bracket(points, turn):
    """The same in `samples.bracket`, whose inner edge is round from within."""
    angle = np.deg2rad(-turn)
    x, y, z = points.T
    y, z = np.cos(angle) * y - np.sin(angle) * z, np.sin(angle) * y + np.cos(angle) * z
    notch = np.hypot(np.maximum(10.0 - x, 0.0), np.maximum(10.0 - y, 0.0))
    notch = np.where((x > 10.0) & (y > 10.0), -1.0, notch)
    return np.min([x, y, z, 50.0 - x, 50.0 - y, 30.0 - z, notch], axis=0)


def volume_of_part(frame, depth, bounds):
    """Of what is no deeper than the skin or in a strut, by points all over the part."""
    points = bounds[0] + even_points(3, 19) * (bounds[1] - bounds[0])
    each = np.prod(bounds[1] - bounds[0]) / len(points)
    deep = depth(points)
    skin = np.count_nonzero((deep >= 0.0) & (deep <= SHELL))
    inside = points[deep > SHELL]
    tree, held = cKDTree(inside), np.zeros(len(inside), bool)
    start, span = frame.nodes[frame.struts[:, 0]], np.diff(frame.nodes[frame.struts], axis=1)[:, 0]
    length = np.linalg.norm(span, axis=1)
    reach = 0.5 * length + frame.radii.max(axis=1)
    for k, found in enumerate(tree.query_ball_point(start + 0.5 * span, reach)):
        near = np.array(found, int)
        local = inside[near] - start[k]
        share = np.einsum("ij,j->i", local, span[k]) / length[k] ** 2
        off = np.linalg.norm(local - share[:, None] * span[k], axis=1)
        one, two = frame.radii[k]
        held[near] |= (share >= 0) & (share <= 1) & (off <= one + (two - one) * share)
    for found in tree.query_ball_point(frame.nodes, frame.joint_radii):
        held[found] = True
    return (skin + np.count_nonzero(held)) * each


@pytest.mark.slow_but("Columns")
@pytest.mark.parametrize(
    "name",
    [n if n in ("Columns", "Re-entrant") else pytest.param(n, marks=pytest.mark.slow)
     for n in LIBRARY],
)  # fmt: skip
def test_a_block(name):
    holds_the_contract(block(spec_of(name, 10.0, resolution=6), (2, 2, 2)))


@pytest.mark.slow
@pytest.mark.parametrize("is_graded", [False, True], ids=["even", "graded"])
@pytest.mark.parametrize("name", LIBRARY)
def test_a_block_of_four_cells_along_each_edge(name, is_graded):
    holds_the_contract(block(spec_of(name, 10.0, is_graded=is_graded), (4, 4, 4)))


@pytest.mark.slow
@pytest.mark.parametrize("name", LIBRARY)
def test_a_trimmed_part_with_a_skin(name):
    solid, turn = samples.bracket(17.0), 17.0
    made = fill(solid, spec_of(name, 8.0, SHELL), cache=_stages)
    read = is_sound(made.mesh)
    assert read.bodies == 1
    counted = volume_of_part(made.wireframe, lambda p: depth_in_bracket(p, turn), solid.bounds)
    assert read.volume == pytest.approx(counted, rel=0.005)


@pytest.mark.slow
@pytest.mark.parametrize("name", LIBRARY)
def test_a_graded_part_with_a_skin(name):
    solid = samples.box()
    made = fill(solid, spec_of(name, 8.0, SHELL, is_graded=True), cache=_stages)
    read = is_sound(made.mesh)
    assert read.bodies == 1
    counted = volume_of_part(made.wireframe, depth_in_box, solid.bounds)
    assert read.volume == pytest.approx(counted, rel=0.005)
