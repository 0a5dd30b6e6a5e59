# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every cell of the library is what it is named for."""

import itertools

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from volfrep.design.cells import LIBRARY, USES, make_cell
from volfrep.grid.strut_graph import cell_graph
from volfrep.mechanics.endless import endless_cell, stretched_strains
from volfrep.mechanics.frame import Ends, frame_tensor
from volfrep.mechanics.joint_fit import periodic_frame
from volfrep.mechanics.tensor import moduli, young

#: Nodes and struts of one cell, and of one period of the endless lattice, in which those that
#: cells share are there once: from the geometry of each polyhedron, net or foam.
COUNTS = {
    "Box": (8, 12, 1, 3),
    "FCC": (14, 36, 4, 15),
    "BCC": (9, 20, 2, 11),
    "Octet": (14, 36, 4, 24),
    "Octahedron": (6, 12, 3, 12),
    "CVC": (9, 8, 2, 8),
    "Cross": (7, 6, 4, 6),
    "BCCz": (9, 12, 2, 9),
    "FCCz": (12, 20, 3, 9),
    "Isotruss": (15, 26, 5, 17),
    "FBCC": (15, 32, 5, 20),
    "X-Cross": (15, 44, 5, 23),
    "Columns": (10, 5, 2, 2),
    "Pyramid": (10, 12, 2, 8),
    "Diamond": (14, 16, 8, 16),
    "Fluorite": (22, 32, 12, 32),
    "Kelvin": (24, 36, 12, 24),
    "Vintiles": (28, 36, 12, 24),
    "Truncated Cube": (24, 36, 6, 15),
    "Cuboctahedron": (12, 24, 3, 12),
    "Truncated Cuboctahedron": (48, 72, 24, 48),
    "Rhombicuboctahedron": (24, 48, 12, 36),
    "Tesseract": (16, 32, 9, 23),
    "Kagome": (32, 60, 16, 48),
    "Laves": (14, 15, 8, 12),
    "Weaire-Phelan": (88, 122, 46, 92),
    "Re-entrant": (18, 17, 5, 11),
}
#: Edges of a joint, and the angles between any two of them in degrees, where all joints are alike.
NETS = {
    "Box": (6, (90.0, 180.0)),
    "Octet": (12, (60.0, 90.0, 120.0, 180.0)),
    "Diamond": (4, (109.4712,)),
    "Laves": (3, (120.0,)),
    "Kagome": (6, (60.0, 120.0, 180.0)),
    "Kelvin": (4, (90.0, 120.0)),
    "Vintiles": (4, (90.0, 120.0)),
    "Truncated Cuboctahedron": (4, (90.0, 120.0, 135.0)),
}


def period(name):
    """Nodes, struts and struts' directions of one period, straight-through nodes left out."""
    endless = endless_cell(LIBRARY[name])
    nodes, struts = len(endless.nodes), len(endless.struts)
    if name == "Weaire-Phelan":  # cut where it passes the faces of its cell
        through = np.bincount(endless.struts.ravel(), minlength=nodes) == 2
        nodes, struts = nodes - through.sum(), struts - through.sum()
    return int(nodes), int(struts)


def test_every_cell_has_its_count():
    assert len(LIBRARY) >= 25
    found = {name: (len(c.nodes), len(c.struts), *period(name)) for name, c in LIBRARY.items()}
    assert found == COUNTS


def test_cells_are_sorted_by_what_they_are_for():
    uses = [list(USES).index(cell.use) for cell in LIBRARY.values()]
    assert uses == sorted(uses)
    assert set(uses) == set(range(len(USES)))
    names = [n.lower() for cell in LIBRARY.values() for n in (cell.name, *cell.also)]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("name", LIBRARY)
def test_a_library_cell_is_sound(name):
    cell = LIBRARY[name]
    make_cell(name, cell.nodes, cell.struts)  # passes the checks of a custom cell
    # What lies on a face lies on the opposite one too, so that cells join.
    for axis in range(3):
        low, high = (set(map(tuple, _others(cell.nodes, axis, side))) for side in (0.0, 1.0))
        assert low == high or name == "Pyramid"  # whose bars lie on both, its apex on one
    # In one piece when it is repeated, but for free-standing columns.
    graph = cell_graph(cell, np.ones((2, 2, 2), bool), 1.0, np.zeros(3))
    joined = csr_array((np.ones(len(graph.struts)), graph.struts.T), shape=(len(graph.nodes),) * 2)
    pieces = connected_components(joined, directed=False)[0]
    assert pieces == (13 if name == "Columns" else 1)
    # Struts meet in nodes and nowhere else.
    start, end = cell.nodes[cell.struts].swapaxes(0, 1)
    apart = np.array(list(itertools.combinations(range(len(start)), 2)))
    alone = (cell.struts[apart[:, 0], :, None] != cell.struts[apart[:, 1], None, :]).all((1, 2))
    one, two = apart[alone].T
    assert _distance(start[one], end[one], start[two], end[two]).min(initial=1.0) > 0.05


def _others(nodes, axis, side):
    rows = nodes[np.abs(nodes[:, axis] - side) < 1e-9]
    return np.round(np.delete(rows, axis, axis=1), 6) % 1.0  # opposite edges are one


def _distance(a, b, c, d, places=21):
    """Between segments, from above, by points on both."""
    share = np.linspace(0.0, 1.0, places)[:, None]
    one = a[:, None] + (b - a)[:, None] * share
    two = c[:, None] + (d - c)[:, None] * share
    return np.linalg.norm(one[:, :, None] - two[:, None], axis=-1).min(axis=(1, 2))


@pytest.mark.parametrize("name", NETS)
def test_all_joints_of_a_net_are_alike(name):
    endless = endless_cell(LIBRARY[name])
    along = endless.end - endless.start
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    number, angles = NETS[name]
    for node in range(len(endless.nodes)):
        arms = np.concatenate(
            [along[endless.struts[:, 0] == node], -along[endless.struts[:, 1] == node]]
        )
        assert len(arms) == number
        between = np.degrees(np.arccos(np.clip(arms @ arms.T, -1.0, 1.0)))
        found = set(np.round(between[np.triu_indices(number, 1)], 3))
        assert found == set(np.round(angles, 3))


@pytest.mark.parametrize(
    "name",
    ["Octahedron", "Cuboctahedron", "Truncated Cube", "Rhombicuboctahedron", "Kelvin", "Vintiles"],
)
def test_the_edges_of_a_uniform_solid_are_equally_long(name):
    cell = LIBRARY[name]
    ends = cell.nodes[cell.struts]
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    np.testing.assert_allclose(lengths, lengths[0], rtol=1e-9)


def frame(name, ratio=0.05):
    return frame_tensor(periodic_frame(LIBRARY[name]), ratio, Ends(1e-3, 1.0, 1.0))


def test_the_re_entrant_cell_grows_wider_when_it_is_pulled():
    """By rigid struts that turn in hinges: as much as its struts come down, over L."""
    compliance = np.linalg.inv(frame("Re-entrant", 0.02))
    ratios = -compliance[:2, 2] / compliance[2, 2]
    assert ratios == pytest.approx([-0.3, -0.3], rel=0.1)


@pytest.mark.parametrize(("name", "without"), [("BCCz", "CVC"), ("FCCz", None)])
def test_columns_make_a_cell_stiffer_along_them(name, without):
    along, across = young(frame(name), np.array([[0.0, 0, 1], [1, 0, 0]]))
    assert along > 2.0 * across
    if without is not None:
        assert along > 10.0 * young(frame(without), np.array([[0.0, 0, 1]]))[0]


def test_only_cells_that_carry_by_stretching_are_called_stiff():
    held = {name: stretched_strains(cell) for name, cell in LIBRARY.items()}
    assert all(held[name] == 6 for name, cell in LIBRARY.items() if cell.use == "stiff")
    assert all(held[name] <= 3 for name, cell in LIBRARY.items() if cell.use == "open")
    # Foams and nets of four struts a joint withstand nothing but pressure.
    assert {held[n] for n in ("Kelvin", "Weaire-Phelan", "Diamond", "Fluorite", "Laves")} == {1}
    assert (held["Box"], held["CVC"], held["Columns"]) == (3, 4, 1)


@pytest.mark.parametrize("name", ["Octet", "Isotruss", "Kagome", "Kelvin", "CVC", "Tesseract"])
def test_struts_that_stretch_keep_their_stiffness_for_the_weight_when_they_are_thin(name):
    """By frames with bending: E over the struts' volume, in the softest of three directions."""

    def worth(ratio):
        figures = moduli(frame(name, ratio))
        weight = endless_cell(LIBRARY[name]).lengths.sum() * np.pi * ratio**2
        return min(figures.E100, figures.E110, figures.E111) / weight

    share = worth(0.005) / worth(0.02)
    assert share > 0.95 if stretched_strains(LIBRARY[name]) == 6 else share < 0.1
