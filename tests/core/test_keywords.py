# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keywords of a call: the keys of files, own arrays, and sentences for what is no value."""

from __future__ import annotations

import ast
import importlib.util
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import volfrep
from volfrep.api import specified
from volfrep.design.parameters.keywords import FIELDS, KEYS, as_graph
from volfrep.design.parameters.specification import specification
from volfrep.design.parameters.typed import Keywords, SizeKeywords
from volfrep.jobs.sizing import GOALS

TRIANGLE = ([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [(0, 1), (0, 2), (1, 2)])


@pytest.mark.parametrize(
    "given",
    [
        {"rotate": (0.0, 0.0, 1.0, 30.0)},
        {"network": "voronoi", "network_points": 20},
        {"radius_grading": "skin", "radius_start": 0.6, "radius_end": 1.2, "radius_reach": 5.0},
        {"size_grading": "linear", "lambda_end": 1.5},
        {"make": "lattice", "shell": 1.0},
    ],
)
def test_a_keyword_is_the_key_of_a_file(given: dict[str, Any]) -> None:
    assert specified(None, given, None) == specification(given)
    on_top = specified(volfrep.LatticeSpec(cell="Octet"), given, None)
    if "network" not in given:
        assert on_top == specification({**given, "cell": "Octet"})


def test_lists_stand_for_tuples() -> None:
    turned = specified(None, {"rotate": [0.0, 0.0, 1.0, 30.0]}, None)
    assert turned == specification({"rotate": (0.0, 0.0, 1.0, 30.0)})


def test_a_cell_is_a_dict_and_a_network_a_pair_of_arrays() -> None:
    nodes, struts = [[0, 0, 0], [1, 1, 1], [1, 0, 0]], [[0, 1], [1, 2], [2, 0]]
    made = specified(None, {"cell": {"name": "Own", "nodes": nodes, "struts": struts}}, None)
    assert made.unit_cell() == volfrep.make_cell("Own", nodes, struts)
    graph = specified(None, {"network": TRIANGLE}, None).network
    assert graph == as_graph(TRIANGLE)


def test_a_graph_of_networkx_is_a_network() -> None:
    class Nodes(dict):  # as networkx has them
        def __call__(self, data: bool) -> Any:
            return self.items()

    places = {name: {"pos": tuple(at)} for name, at in zip("abc", TRIANGLE[0], strict=True)}
    edges = [("a", "b"), ("a", "c"), ("b", "c")]
    graph = SimpleNamespace(nodes=Nodes(places), edges=lambda: edges)
    assert as_graph(graph) == as_graph(TRIANGLE)
    with pytest.raises(volfrep.VolfrepError, match="has no struts"):
        as_graph(SimpleNamespace(nodes=Nodes(places), edges=list))
    with pytest.raises(volfrep.VolfrepError, match="'d' of the graph has no place"):
        as_graph(SimpleNamespace(nodes=Nodes({"d": {}}), edges=list))


def test_a_field_is_points_and_values() -> None:
    points, values = np.array([[0.0, 0, 0], [10, 0, 0]]), np.array([0.5, 1.0])
    given = {"radius_grading": "field", "radius_field": (points, values)}
    made = specified(None, {**given, "radius_start": 0.5, "radius_end": 1.0}, None)
    assert made.radius_grading is not None
    assert made.radius_grading.field.range == (0.5, 1.0)


@pytest.mark.parametrize(
    "value",
    [
        lambda points: 1.0 + points[:, 0] / 50.0,
        "1 + x / 50",
        (np.array([[0.0, 0, 0], [10, 0, 0]]), np.array([1.0, 1.2])),
    ],
    ids=["function", "formula", "points"],
)
def test_radius_thickness_and_density_are_given_by_place(value: Any) -> None:
    def box(size: float) -> Any:
        return np.array([[0.0, 0, 0], [10, 10, 10]])

    at = [[0, 0, 0], [10, 0, 0]]
    made = specified(None, {"strut_radius": value}, None, box)
    assert made.radius_grading is not None
    assert made.radius_grading.radii(np.array(at, float), box(1), lambda p: p) == pytest.approx(
        [1.0, 1.2]
    )
    sheet = specified(None, {"cell": "Gyroid", "wall_thickness": value}, None, box)
    assert sheet.kind.thicknesses == pytest.approx((1.0, 1.2))
    points = specified(None, {"network": "voronoi", "network_density": value}, None, box).network
    assert points.field(at) == pytest.approx([1.0, 1.2])
    assert points.formula(np.array([0.0, 1.0])) == pytest.approx([1.0, 1.2])


def test_a_density_by_place_is_the_even_lattices_radius_there() -> None:
    given = {"cell": "BCC", "relative_density": lambda points: 0.1 + points[:, 0] / 100.0}
    made = specified(None, given, None, lambda size: np.array([[0.0, 0, 0], [20, 20, 20]]))
    assert made.radius_grading is not None
    for place, density in ((0, 0.1), (20, 0.3)):
        radius = made.radius_grading.field([[place, 0, 0]])[0]
        assert volfrep.properties("BCC", 10, radius).relative_density == pytest.approx(density)


def test_a_function_needs_a_part() -> None:
    with pytest.raises(volfrep.VolfrepError, match="function of places in a part"):
        specified(None, {"strut_radius": lambda points: points[:, 0]}, None)


def test_a_radius_by_place_and_a_grading_are_one_too_many() -> None:
    given = {"strut_radius": ([[0, 0, 0]], [1.0]), "radius_grading": "skin", "radius_end": 2}
    with pytest.raises(volfrep.VolfrepError, match="leave 'radius_grading' out"):
        specified(None, given, None)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"cel": "BCC"}, "did you mean 'cell'"),
        ({"radius_strat": 1.0}, "did you mean 'radius_start'"),
        ({"origin": 5}, "origin: 5 is no list such as"),
        ({"cell": {"nodes": []}}, "struts are missing"),
    ],
)
def test_what_is_no_value_is_a_sentence(given: dict[str, Any], message: str) -> None:
    with pytest.raises(volfrep.VolfrepError, match=message):
        specified(None, given, None)


def test_the_catalogue_comes_first() -> None:
    found = volfrep.properties("BCC", 10, 1)
    known = volfrep.properties(volfrep.LatticeSpec(cell="BCC").unit_cell(), 10, 1)
    assert found.values == known.values
    assert set(volfrep.__all__) <= set(dir(volfrep))


def test_an_editor_knows_every_name_that_the_package_promises() -> None:
    from volfrep import api

    assert all(hasattr(api, name) for name in api.__all__)
    tree = ast.parse(Path(volfrep.__file__).read_text("utf-8"))
    checked = next(node for node in tree.body if isinstance(node, ast.If))
    names = {
        alias.asname or alias.name
        for node in checked.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert names >= {name for name in volfrep.__all__ if name != "__version__"}


def test_an_editor_knows_the_keywords_of_the_table() -> None:
    path = Path(__file__).resolve().parents[2] / "tools" / "typed_keywords.py"
    found = importlib.util.spec_from_file_location(path.stem, path)
    assert found is not None
    assert found.loader is not None
    tool = importlib.util.module_from_spec(found)
    found.loader.exec_module(tool)
    typed = {
        name: kind.__forward_arg__.replace("'", '"')
        for name, kind in Keywords.__annotations__.items()
    }
    assert typed == {name: tool.type_of(name) for name in KEYS | FIELDS}
    assert set(SizeKeywords.__annotations__) == {*typed, *GOALS}


@pytest.mark.slow
def test_mypy_refuses_a_keyword_that_there_is_not(tmp_path: Path) -> None:
    api = pytest.importorskip("mypy.api")
    file = tmp_path / "script.py"
    file.write_text('import volfrep\nvolfrep.fill("a.stl", cel="BCC")\n', encoding="utf-8")
    told, _, status = api.run(["--follow-imports=silent", str(file)])
    assert status == 1
    assert 'Unexpected keyword argument "cel" for "fill"' in told
