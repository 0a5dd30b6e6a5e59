# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whatever a script gives, what comes back is a part or one sentence: a VolfrepError."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import volfrep
from volfrep.api import specified
from volfrep.design.parameters.keywords import FIELDS, KEYS

#: Looked at once: a solid is taken as it is.
TETRAHEDRON = volfrep.as_solid(
    (
        [[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]],
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    )
)
CELL: dict[str, Any] = {"cell": "BCC", "cell_size": 9, "strut_radius": 1, "resolution": 8}
NODES = [[0, 0, 0], [1, 1, 1]]
HELD = {
    "material": "PA12",
    "support": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}, "fixed": True}],
    "case": [{"acceleration": [0, 0, -9810]}],
}
#: Of every kind that a slip of the keyboard makes: each is wrong for most parameters.
WRONG: tuple[Any, ...] = (
    5, -5, True, None, float("nan"), float("inf"), 1e300, 10**400, 1j, "", "x", "1 mm", b"x",
    [], [1, 2], [1, 2, 3], [[1, 2, 3]], np.zeros(3), np.eye(3), np.array(["a"]), {}, {1, 2},
    {"nodes": 5}, {"nodes": [], "struts": []}, {"nodes": NODES, "struts": [[0, 5]]},
    {"nodes": NODES, "struts": "x"}, {"nodes": NODES, "struts": [[0, 1]], "edges": 3},
    ([1], [2]), (np.eye(3), [1, 2, 3]), (NODES, []), object(), int, lambda: 5, lambda at: at,
    SimpleNamespace(nodes=lambda data: [], edges=list), SimpleNamespace(vertices=1, edges_unique=2),
)  # fmt: skip


def _box(size: float) -> Any:
    return np.array([[0.0, 0, 0], [10, 10, 10]])


def _refused_in_a_sentence(call: Callable[[Any], object]) -> int:
    refused = 0
    for value in WRONG:
        told = ""
        try:
            call(value)
        except volfrep.VolfrepError as error:
            refused, told = refused + 1, str(error)
        except Exception as error:
            raise AssertionError(f"{value!r} was told by {error!r}") from error
        assert "\n" not in told, f"{value!r}: {told}"
        assert len(told) < 900, f"{value!r}: {told}"
    return refused


@pytest.mark.parametrize("name", sorted(KEYS | FIELDS))
@pytest.mark.filterwarnings("ignore")
def test_a_keyword_takes_its_kind_or_says_what_it_takes(name: str) -> None:
    assert _refused_in_a_sentence(lambda value: specified(None, {name: value}, None, _box)) > 15


def _study(**given: Any) -> volfrep.Study:
    return volfrep.Study(**{"parts": ("a.stl",), **given})


CALLS: dict[str, Callable[[Any], object]] = {
    "fill(part)": lambda value: volfrep.as_solid(value),
    "fill(spec)": lambda value: specified(5 if value is None else value, {}, None),
    "fill(material)": lambda value: specified(None, {}, 5 if value is None else value),
    "fill(progress)": lambda value: volfrep.as_solid(
        "none.stl", progress=5 if callable(value) else value
    ),
    "fill(cache)": lambda value: volfrep.fill("none.stl", cache=value, **CELL),
    "fill(executor)": lambda value: volfrep.fill("none.stl", executor=value, **CELL),
    "block(count)": lambda value: volfrep.block(value, **CELL),
    "mesh_network(graph)": lambda value: volfrep.mesh_network(value, strut_radius=0.1),
    "size(loads)": lambda value: volfrep.size(TETRAHEDRON, value, **CELL),
    "size(steps)": lambda value: volfrep.size("none.stl", HELD, steps=value, **CELL),
    "size(safety)": lambda value: volfrep.size(
        "none.stl" if isinstance(value, (int, float)) else TETRAHEDRON, HELD,
        safety="x" if value is None else value, **CELL,
    ),
    "solve(part)": lambda value: volfrep.solve(value, HELD),
    "solve(loads)": lambda value: volfrep.solve(TETRAHEDRON, value),
    "solve(voxel)": lambda value: volfrep.solve(
        TETRAHEDRON, HELD, voxel="x" if value is None else value
    ),
    "solve(material)": lambda value: volfrep.solve(TETRAHEDRON, HELD, material=value or 5)
    if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "orient(process)": lambda value: volfrep.orient(TETRAHEDRON, process=value or 5)
    if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "orient(inclination)": lambda value: volfrep.orient(
        TETRAHEDRON, inclination=95 if value is None else value
    ),
    "orient(best)": lambda value: volfrep.orient(TETRAHEDRON, best=value),
    "slice_layers(folder)": lambda value: volfrep.slice_layers(
        "none.stl" if isinstance(value, str) else TETRAHEDRON, value, layer=1, **CELL
    ),
    "slice_layers(layer)": lambda value: volfrep.slice_layers(
        TETRAHEDRON, "layers", layer=-1 if value in (5, True) else value, **CELL
    ) if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "properties(cell)": lambda value: volfrep.properties(value, 10, 1),
    "properties(cell_size)": lambda value: volfrep.properties("BCC", value, 0.5),
    "properties(strut_radius)": lambda value: volfrep.properties("BCC", 10, value),
    "properties(material)": lambda value: volfrep.properties("BCC", 10, 1, material=value or 5)
    if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "properties(cell_values)": lambda value: volfrep.properties("BCC", 10, 1, cell_values=value),
    "properties().young": lambda value: volfrep.properties("BCC", 10, 1).young(value),
    "make_cell(nodes)": lambda value: volfrep.make_cell("own", value, [[0, 1]]),
    "make_cell(struts)": lambda value: volfrep.make_cell("own", NODES, value),
    "cell_from_lines": lambda value: volfrep.cell_from_lines("own", value),
    "read_solid": lambda value: volfrep.read_solid(value),
    "read_spec": lambda value: volfrep.read_spec(value),
    "read_study": lambda value: volfrep.read_study(value),
    "write_spec": lambda value: volfrep.write_spec(value, "spec.toml"),
    "write_block_stl": lambda value: volfrep.write_block_stl(volfrep.LatticeSpec(), value, "a.stl"),
    "Study(parts)": lambda value: volfrep.Study(parts=value),
    "Study(vary)": lambda value: _study(vary=value),
    "Study(vary) values": lambda value: _study(vary={"shell": value}),
    "Study(fixed)": lambda value: _study(fixed=value),
    "Study(do)": lambda value: _study(do=value),
    "Range": lambda value: volfrep.Range(value, 5),
    "Front": lambda value: volfrep.Front(value),
    "sweep(study)": lambda value: volfrep.sweep(value, "runs"),
    "sweep(folder)": lambda value: volfrep.sweep(_study(), value),
    "find(modulus)": lambda value: volfrep.find(modulus="x" if value is None else value),
    "find(relative_density)": lambda value: volfrep.find(
        relative_density="x" if value is None else value
    ),
    "find(direction)": lambda value: volfrep.find(modulus=0.01, direction=value),
    "find(material)": lambda value: volfrep.find(
        modulus=0.01, material="x" if value is None else value
    ),
    "find(cell_size)": lambda value: volfrep.find(modulus=0.01, cell_size=value),
    "homogenise(part)": lambda value: volfrep.homogenise(value, HELD, **CELL),
    "homogenise(loads)": lambda value: volfrep.homogenise(TETRAHEDRON, value, **CELL),
    "homogenise(element)": lambda value: volfrep.homogenise(
        TETRAHEDRON, HELD, element="x" if value is None else value, **CELL
    ),
    "coupons(kinds)": lambda value: volfrep.coupons(None, value, **CELL),
    "coupons(cells)": lambda value: volfrep.coupons(
        None, ["cube"], cells=1 if value == 5 else value, **CELL
    ) if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "coupons(first)": lambda value: volfrep.coupons(None, ["ladder"], first=value, **CELL),
    "orient(part)": lambda value: volfrep.orient(value),
    "orient(unit)": lambda value: volfrep.orient(
        (TETRAHEDRON.vertices, TETRAHEDRON.triangles), unit=value or "x"
    )
    if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "slicer_infill(part)": lambda value: volfrep.slicer_infill(value),
    "slicer_infill(wanted)": lambda value: volfrep.slicer_infill(
        TETRAHEDRON, 5 if value is None else value
    ),
    "slicer_infill(material)": lambda value: volfrep.slicer_infill(
        TETRAHEDRON, material=5 if value is None else value
    ),
    **{
        f"slicer_infill({name})": lambda value, name=name: volfrep.slicer_infill(
            TETRAHEDRON, **{name: "?" if value is None else value}
        )
        for name in ("start", "end", "bands", "grading", "field", "pattern", "reach", "direction",
                     "curve", "formula", "walls", "line_width", "layer")
    },
    "fill(max_triangles)": lambda value: volfrep.fill(TETRAHEDRON, max_triangles=value, **CELL),
    "fill(max_size)": lambda value: volfrep.fill(TETRAHEDRON, max_size=value, **CELL),
    "fill(service)": lambda value: volfrep.fill(
        TETRAHEDRON, service="x" if value is None else value, **CELL
    ),
    "fill(compensate)": lambda value: volfrep.fill(
        TETRAHEDRON, compensate="x" if value is None else value, **CELL
    ),
    **{
        f"{name}({limit})": lambda value, call=call, limit=limit: call(
            **{limit: "x" if value is None else value}
        )
        for name, call in (
            ("size", lambda **limits: volfrep.size("none.stl", HELD, **limits, **CELL)),
            ("block", lambda **limits: volfrep.block((1, 1, 1), **limits, **CELL)),
            ("mesh_network", lambda **limits: volfrep.mesh_network((NODES, [(0, 1)]), **limits)),
        )
        for limit in ("max_triangles", "max_size", "service")
    },
    "fill(unit)": lambda value: volfrep.fill("none.stl", unit=value, **CELL),
    "properties(relative_density)": lambda value: volfrep.properties(
        "BCC", 10, relative_density=value
    ),
    "properties(fillet)": lambda value: volfrep.properties(
        "BCC", 10, 1, fillet="x" if value == 0 else value
    ) if not isinstance(value, (int, np.ndarray)) else volfrep.as_solid(value),
    "properties(wall_kind)": lambda value: volfrep.properties(
        "Gyroid", 10, wall_kind=value or "x", wall_thickness=99
    ) if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "properties(wall_thickness)": lambda value: volfrep.properties(
        "Gyroid", 10, wall_thickness="x" if value is None or value is True else value
    ) if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "properties(wall_formula)": lambda value: volfrep.properties(
        "Formula", 10, wall_formula=value, wall_thickness=99
    ),
    "size(part)": lambda value: volfrep.size(value, HELD, **CELL),
    "size(prove)": lambda value: volfrep.size(TETRAHEDRON, HELD, prove=value or 5, **CELL)
    if not isinstance(value, np.ndarray) else volfrep.as_solid(value),
    "size(voxel)": lambda value: volfrep.size("none.stl", HELD, voxel=value, **CELL),
    "LatticeSpec(cell)": lambda value: volfrep.LatticeSpec(value),
    "LatticeSpec(cell_size)": lambda value: volfrep.LatticeSpec("BCC", value),
    "TriangleMesh": lambda value: volfrep.fill(value, **CELL),
    "evaluate(designs)": lambda value: volfrep.evaluate(_study(), value, "runs"),
}  # fmt: skip


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.filterwarnings("ignore")
def test_a_call_takes_its_kind_or_says_what_it_takes(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert _refused_in_a_sentence(CALLS[name]) > 15


@pytest.mark.parametrize(
    "call",
    [
        lambda part, value: part.save(value),
        lambda part, value: part.save("a.3mf", value or "x"),
        lambda part, value: part.save("a.inp", material=value or 5),
        lambda part, value: part.layers("layers", value),
        lambda part, value: part.check(value),
        lambda part, value: part.check("SLS", [value]),
        lambda part, value: part.plot(value or 5),
        lambda part, value: part.as_printed(value),
        lambda part, value: part.as_printed("SLS-PA12", value),
    ],
    ids=["save", "form", "material", "layers", "check", "direction", "plot", "printed", "up"],
)
@pytest.mark.filterwarnings("ignore")
def test_a_part_takes_its_kind_or_says_what_it_takes(
    call: Callable[[volfrep.Part, Any], object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    part = volfrep.block((1, 1, 1), **CELL)
    arrays = [value for value in WRONG if isinstance(value, np.ndarray)]
    assert _refused_in_a_sentence(
        lambda value: call(part, "x.y" if any(value is one for one in arrays) else value)
    )
