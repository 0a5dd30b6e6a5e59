# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every cell of the library makes blocks, parts and graded blocks: closed, of known genus."""

import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

import samples
from volfrep import LatticeSpec, StageCache
from volfrep.design.cells import LIBRARY
from volfrep.design.grading import RadiusGrading, SizeGrading
from volfrep.design.profile import Profile
from volfrep.io.write.stl import as_read
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh.quality import measure

#: r / L, thin enough for the smallest windows of every cell.
RATIO = 0.04
_stages = StageCache()
GRADED = {
    "radius_grading": RadiusGrading("direction", Profile("linear", 9 * RATIO, 11 * RATIO)),
    "size_grading": SizeGrading(Profile("linear", 1.0, 1.4)),
}


def holds_the_contract(result):
    """Closed as a reader sees it, a body a piece of the wireframe, and the genus of the graph."""
    frame, read = result.wireframe, measure(as_read(result.mesh))
    joined = csr_array((frame.struts[:, 0] >= 0, frame.struts.T), shape=(len(frame.nodes),) * 2)
    pieces = connected_components(joined, directed=False)[0]
    assert read.watertight
    assert read.degenerate_triangles == 0
    assert (read.bodies, read.genus) == (pieces, len(frame.struts) - len(frame.nodes) + pieces)


def quickly(*names):
    """All cells; those that are not named count as slow."""
    return pytest.mark.parametrize(
        "name",
        [pytest.param(n, marks=() if n in names else pytest.mark.slow) for n in LIBRARY],
    )


@quickly("Columns", "Kelvin", "Re-entrant", "Pyramid")
def test_a_block(name):
    holds_the_contract(block(LatticeSpec(name, 10.0, 10 * RATIO, resolution=4), (2, 2, 2)))


@pytest.mark.slow
@pytest.mark.parametrize("grading", [{}, GRADED], ids=["even", "graded"])
@pytest.mark.parametrize("name", LIBRARY)
def test_a_block_of_four_cells_along_each_edge(name, grading):
    holds_the_contract(block(LatticeSpec(name, 10.0, 10 * RATIO, **grading), (4, 4, 4)))


@quickly("Laves", "Columns")
def test_a_trimmed_part_with_a_skin(name):
    spec = LatticeSpec(name, 8.0, 8 * RATIO, shell=1.5)
    read = measure(as_read(fill(samples.bracket(17.0), spec, cache=_stages).mesh))
    assert read.watertight
    assert read.degenerate_triangles == 0
    assert read.bodies == 1
