# SPDX-License-Identifier: LGPL-2.1-or-later
"""What of a lattice hangs on nothing: one answer for mesh, beams, axes and preview."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

import samples
from volfrep import LatticeSpec
from volfrep.design.cells import UnitCell
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.infill import Infill
from volfrep.jobs.preview import PartDepth, preview
from volfrep.trim.kept_struts import find_kept_struts

BOX = samples.box((40.0, 30.0, 30.0), (5.0, -5.0, -10.0))
#: Its corners hold struts whose ends are all cut.
LOOSE = LatticeSpec("Octet", cell_size=13, strut_radius=1, shell=0, output="lattice", resolution=12)


def groups(frame):
    count = len(frame.nodes)
    links = coo_matrix((np.ones(len(frame.struts)), frame.struts.T), shape=(count, count))
    return connected_components(links, directed=False)[0]


def graph(nodes, struts, radius=0.1):
    nodes, struts = np.array(nodes, float), np.array(struts, np.int32)
    return Wireframe(nodes, struts, np.full((len(struts), 2), radius), np.full(len(nodes), radius))


def lines_apart(gap):
    """Two struts that cross at a distance, and a longer third one far away."""
    return graph(
        [[0, 0, 0], [2, 0, 0], [1, -1, gap], [1, 1, gap], [0, 0, 5], [9, 0, 5]],
        [[0, 1], [2, 3], [4, 5]],
    )


@pytest.mark.parametrize(("gap", "loose"), [(0.19, 1), (0.21, 2)])
def test_struts_whose_sides_meet_are_one_piece(gap, loose):
    assert find_kept_struts(lines_apart(gap), None, has_skin=False).loose == loose


def test_the_largest_pieces_stay_as_many_as_the_part_has_bodies():
    lattice = lines_apart(1.0)
    assert find_kept_struts(lattice, None, has_skin=False).stays.tolist() == [False, False, True]
    assert find_kept_struts(lattice, None, has_skin=False, bodies=3).stays.all()
    found = find_kept_struts(lattice, None, has_skin=False, bodies=1)
    assert found.share == pytest.approx(4.0 / 13.0)
    assert len(found.without_loose(lattice).struts) == 1
    assert find_kept_struts(lattice, None, has_skin=False, keep_all=True).loose == 0


def test_a_skin_holds_what_its_wall_cuts_and_nothing_else():
    wall = samples.box((4.0, 4.0, 12.0), (-1.0, -2.0, -1.0))  # cuts the third strut only
    found = find_kept_struts(lines_apart(1.0), wall, has_skin=True)
    assert found.stays.tolist() == [False, False, True]
    assert found.loose == 2


@pytest.fixture(scope="module")
def loose():
    return Infill(BOX, LOOSE)


@pytest.mark.costly
def test_no_form_of_a_lattice_holds_what_its_mesh_leaves_out(loose):
    report = loose.lattice.report
    assert (report.bodies, report.pieces_removed) == (1, 3)
    assert groups(loose.lattice_beams.lattice) == 1
    assert groups(loose.axes.wireframe) == 1
    shown = preview(BOX, LOOSE, PartDepth(BOX))
    assert shown.struts == len(np.unique(loose._kept(is_cut=True).left.owner))
    for said in (loose.lattice_beams.loose, loose.axes.warnings):
        assert any("3 pieces that hang on nothing left out" in sentence for sentence in said)


def test_pieces_are_kept_where_that_is_asked_for(loose):
    kept = Infill(BOX, replace(LOOSE, keep_pieces=True))
    report = kept.lattice.report
    assert (report.bodies, report.pieces_removed) == (4, 0)
    assert report.volume_mm3 > loose.lattice.report.volume_mm3
    assert groups(kept.axes.wireframe) == 4
    assert not kept.axes.warnings


def test_struts_that_cross_without_a_node_are_tied_as_beams():
    nodes = [[0, 0.5, 0.5], [1, 0.5, 0.5], [0.5, 0, 0.52], [0.5, 1, 0.52]]
    crossing = UnitCell("Crossing", nodes, [[0, 1], [2, 3]])
    spec = LatticeSpec(crossing, cell_size=10, strut_radius=1, shell=0, output="lattice")
    infill = Infill(samples.box((30.0, 20.0, 10.0)), replace(spec, resolution=12))
    assert infill.lattice.report.bodies == 1
    assert infill.lattice_beams.loose == ()
    assert groups(infill.axes.wireframe) == 1
    assert infill.axes.warnings == ()
    # All that lies inside is there, and a tie of 0.2 mm where two lines of 10 mm cross.
    frame = infill.axes.wireframe
    length = np.linalg.norm(np.diff(frame.nodes[frame.struts], axis=1)[:, 0], axis=1)
    assert np.isclose(length, 0.2).sum() == 3 * 2
    assert length.sum() == pytest.approx(6 * (10.0 + 10.0 + 0.2))
