# SPDX-License-Identifier: LGPL-2.1-or-later
"""The graph of the active cells against closed forms and against counting by hand."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from volfrep.design.cells import LIBRARY, PAPERS
from volfrep.grid.strut_graph import Wireframe, cell_graph, wireframe
from volfrep.util.types import Bools, Floats

Count = Callable[[int], int]

#: Nodes and struts of n x n x n whole cells, whatever neighbours share counted once.
CLOSED_FORMS: dict[str, tuple[Count, Count]] = {
    "Box": (lambda n: (n + 1) ** 3, lambda n: 3 * n * (n + 1) ** 2),
    "BCC": (lambda n: (n + 1) ** 3 + n**3, lambda n: 8 * n**3 + 3 * n * (n + 1) ** 2),
    "CVC": (lambda n: (n + 1) ** 3 + n**3, lambda n: 8 * n**3),
    "FCC": (
        lambda n: (n + 1) ** 3 + 3 * n**2 * (n + 1),
        lambda n: 12 * n**2 * (n + 1) + 3 * n * (n + 1) ** 2,
    ),
    "Octet": (
        lambda n: (n + 1) ** 3 + 3 * n**2 * (n + 1),
        lambda n: 12 * n**2 * (n + 1) + 12 * n**3,
    ),
    "Octahedron": (lambda n: 3 * n**2 * (n + 1), lambda n: 12 * n**3),
}


def block(name: str, *count: int, size: float = 10.0) -> Wireframe:
    return frame(name, np.ones(count, bool), size, np.zeros(3))


def frame(name: str, active: Bools, size: float, origin: Floats) -> Wireframe:
    graph = cell_graph(LIBRARY[name], active, size, origin)
    return wireframe(graph, graph.nodes, np.full(len(graph.nodes), 0.1 * size), size)


@pytest.mark.parametrize("name", CLOSED_FORMS)
@pytest.mark.parametrize("n", [1, 2, 3, 10])
def test_whole_blocks(name: str, n: int) -> None:
    graph = block(name, n, n, n)
    nodes, struts = CLOSED_FORMS[name]
    assert (len(graph.nodes), len(graph.struts)) == (nodes(n), struts(n))
    assert graph.genus == struts(n) - nodes(n) + 1


@pytest.mark.parametrize(("name", "genus"), [("Box", 2300), ("CVC", 5670), ("FCC", 12200)])
def test_genus_of_the_papers_blocks(name: str, genus: int) -> None:
    assert block(name, 10, 10, 10).genus == genus


def by_hand(
    name: str, active: np.ndarray, size: float, origin: np.ndarray
) -> tuple[set[tuple[float, ...]], set[frozenset[tuple[float, ...]]]]:
    """The same graph, cell by cell with sets."""
    cell = LIBRARY[name]
    nodes: set[tuple[float, ...]] = set()
    struts: set[frozenset[tuple[float, ...]]] = set()
    for index in np.argwhere(active):
        placed = [tuple(np.round(p, 6).tolist()) for p in origin + size * (index + cell.nodes)]
        nodes.update(placed)
        struts.update(frozenset((placed[a], placed[b])) for a, b in cell.struts)
    return nodes, struts


@settings(max_examples=60)
@given(
    name=st.sampled_from(sorted(PAPERS)),
    shape=st.tuples(*[st.integers(1, 4)] * 3),
    seed=st.integers(0, 2**32 - 1),
)
def test_any_pattern_of_cells(name: str, shape: tuple[int, int, int], seed: int) -> None:
    active = np.random.default_rng(seed).random(shape) < 0.5
    origin = np.array([-3.0, 5.0, 0.25])
    graph = frame(name, active, 2.0, origin)
    nodes, struts = by_hand(name, active, 2.0, origin)
    points = [tuple(p) for p in np.round(graph.nodes, 6).tolist()]
    assert set(points) == nodes
    assert len(points) == len(nodes)
    assert {frozenset((points[a], points[b])) for a, b in graph.struts} == struts
    assert len(graph.struts) == len(struts)


def test_size_and_origin() -> None:
    graph = frame("Box", np.ones((2, 1, 1), bool), 4.0, np.array([1.0, 2.0, 3.0]))
    assert graph.nodes.min(axis=0).tolist() == [1, 2, 3]
    assert graph.nodes.max(axis=0).tolist() == [9, 6, 7]
    assert graph.struts.dtype == np.int32


def test_no_active_cell() -> None:
    graph = frame("Box", np.zeros((2, 2, 2), bool), 1.0, np.zeros(3))
    assert (graph.nodes.shape, graph.struts.shape) == ((0, 3), (0, 2))


def test_every_strut_and_joint_knows_its_radius() -> None:
    graph = block("CVC", 2, 1, 1)
    assert graph.radii.shape == graph.struts.shape
    assert (graph.radii == 1.0).all()
    assert graph.joint_radii == pytest.approx(np.full(len(graph.nodes), 1.1))
