# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells with numbers to choose, cells by rules, and cells of a catalogue's text."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from volfrep.cli import command as cli
from volfrep.design.cell_files.catalogue_text import catalogue_entry, catalogue_names
from volfrep.design.cell_files.tessellation import RULES, TESSELLATIONS, tessellate
from volfrep.design.cells import LIBRARY, find_cell, load_cell, make_cell
from volfrep.design.drawn_cell import save_cell
from volfrep.design.parameters.specification import specification, values_of
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.blocks import block
from volfrep.util.errors import VolfrepError

CUBE = (1.0, 1.0, 1.0)
CHEVRON = {
    "name": "Chevron",
    "parameters": {"angle": {"usual": 60, "least": 40, "most": 80}},
    "edges": [1, 1, "tan(angle * pi / 180)"],
    "nodes": [[0, 0.5, 0], [0.5, 0.5, 0.5], [1, 0.5, 0], [0, 0.5, 1], [1, 0.5, 1]],
    "struts": [[0, 1], [1, 2], [1, 3], [1, 4]],
}
#: Two entries as the catalogue writes them: a simple cross from 1, and one that is no box.
CATALOGUE = """
Name: own_cross

Normalized unit cell parameters (a,b,c,alpha,beta,gamma):
0.5, 1, 1, 90, 90, 90

Average connectivity: Z_avg = 6
Relative Young's moduli
1.0, 2.5e-03, 3

Nodal positions:
0 0.5 0.5
1 0.5 0.5
0.5 0 0.5
0.5 1 0.5
0.5 0.5 0
0.5 0.5 1
0.5 0.5 0.5

Bar connectivities:
1 7
2 7
3 7
4 7
5 7
6 7

-----------------------------------------------------------------------------------------
Name: own_tilted

Normalized unit cell parameters (a,b,c,alpha,beta,gamma):
1, 1, 1, 60, 60, 90

Nodal positions:
0 0 0
1.0e+00 0 0

Bar connectivities:
1 2
"""


def written(path: Path, data: dict[str, Any]) -> str:
    path.write_text(json.dumps(data))
    return str(path)


def pairs(nodes: Any, struts: Any) -> set[frozenset[tuple[float, ...]]]:
    rows = [tuple(row) for row in (np.round(nodes, 6) + 0.0).tolist()]
    return {frozenset((rows[a], rows[b])) for a, b in np.asarray(struts).tolist()}


def test_a_cells_angle_is_what_its_values_say(tmp_path: Path) -> None:
    path = written(tmp_path / "chevron.json", CHEVRON)
    assert load_cell(path).edges[2] == pytest.approx(3**0.5)
    cell = load_cell(path, "angle = 45")
    assert cell.edges == pytest.approx(CUBE)
    ends = cell.nodes[cell.struts] * cell.edges
    rise = np.abs(ends[:, 1] - ends[:, 0])
    np.testing.assert_allclose(rise[:, 2], rise[:, 0])


def test_the_librarys_values_change_its_cells() -> None:
    arms = find_cell("Re-entrant", "arm = 0.2").nodes[:2, 2]
    np.testing.assert_allclose(arms, [0.2, 0.8])
    assert find_cell("Re-entrant", "arm = 0.1") == LIBRARY["Re-entrant"]
    with pytest.raises(VolfrepError, match=r"it has arm \(0 to 0.35\), knee \(0.2 to 0.48\)"):
        find_cell("Re-entrant", "angle = 3")
    with pytest.raises(VolfrepError, match="it has none"):
        find_cell("BCC", "angle = 3")
    with pytest.raises(VolfrepError, match=r"must be from 0 to 0\.35"):
        find_cell("Re-entrant", "arm = 0.5")
    with pytest.raises(VolfrepError, match="like 'name = number"):
        find_cell("Re-entrant", "0.5")


def test_values_of_a_cell_go_through_files_of_specifications(tmp_path: Path) -> None:
    for cell in ("Tesseract", written(tmp_path / "chevron.json", CHEVRON)):
        value = "inset = 0.3" if cell == "Tesseract" else "angle = 50.0"
        values = {"cell": cell, "cell_values": value, "cell_size": 9.0}
        spec = specification(values)
        assert values_of(spec)["cell_values"] == value
        assert specification(values_of(spec)) == spec
        assert spec != specification({"cell": cell, "cell_size": 9.0})
    with pytest.raises(VolfrepError, match="given whole"):
        specification({"cell": LIBRARY["Tesseract"], "cell_values": "inset = 0.3"})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"parameters": [1]}, "'parameters' must be an object"),
        ({"parameters": {"pi": {"usual": 1, "least": 0, "most": 2}}}, "must have another name"),
        ({"parameters": {"angle": 3}}, "'usual', 'least' and 'most'"),
        ({"parameters": {"angle": {"usual": 9, "least": 40, "most": 80}}}, "not from 40 to 80"),
        ({"edges": [1, 1, "angles"]}, "'angles' is not known"),
        ({"edges": [1, 1, "log(-angle)"]}, "has no value"),
        ({"edges": [1, 1, "angle"]}, "3 numbers from 0.1 to 10"),
        ({"tessellation": {"about": "cubes", "rules": ["edges"]}}, "leave nodes, struts"),
    ],
)
def test_what_is_wrong_with_a_cell_of_formulas(
    tmp_path: Path, change: dict[str, Any], message: str
) -> None:
    with pytest.raises(VolfrepError, match=message):
        load_cell(written(tmp_path / "cell.json", CHEVRON | change))


@pytest.mark.parametrize(
    ("about", "rules", "name"),
    [
        ("cubes", ["edges"], "Box"),
        ("cubes", ["duals"], "Cross"),
        ("cubes", ["centre to corners"], "CVC"),
        ("cubes", ["edges", "centre to corners"], "BCC"),
        ("cubes", ["edges", "faces to corners"], "FCC"),
        ("cubes", ["edges", "centre to corners", "centre to faces"], "Isotruss"),
        ("truncated octahedra", ["edges"], "Kelvin"),
        ("rhombic dodecahedra", ["duals"], "Octet"),
    ],
)
def test_rules_make_the_librarys_cells(about: str, rules: list[str], name: str) -> None:
    found = tessellate({"about": about, "rules": rules}, CUBE, "cell")
    assert pairs(*found) == pairs(LIBRARY[name].nodes, LIBRARY[name].struts)


@pytest.mark.costly
def test_every_tessellation_and_rule_makes_a_cell_whose_copies_meet() -> None:
    for about in TESSELLATIONS:
        edges = (1.0, 3**0.5, 1.0) if about == "hexagonal prisms" else CUBE
        for rule in RULES:
            cell = make_cell("x", *tessellate({"about": about, "rules": [rule]}, edges, "cell"))
            for axis in range(3):
                low, high = cell.nodes[:, axis] == 0.0, cell.nodes[:, axis] == 1.0
                others = [k for k in range(3) if k != axis]
                assert np.array_equal(
                    *(np.unique(cell.nodes[side][:, others], axis=0) for side in (low, high))
                )
    hexagons = make_cell(
        "x",
        *tessellate({"about": "hexagonal prisms", "rules": ["edges"]}, edges, "cell"),
        edges=edges,
    )
    span = np.diff(hexagons.nodes[hexagons.struts] * np.array(edges), axis=1)[:, 0]
    lengths = np.linalg.norm(span, axis=1)
    # Sides of 1 / sqrt 3, those that cross the box's border halved, and uprights of 1.
    assert set(np.round(lengths, 6)) == {0.57735, 0.288675, 1.0}


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ({"about": "spheres", "rules": ["edges"]}, "no tessellation 'spheres'"),
        ({"about": "cubes", "rules": ["corners"]}, "must be a list of some of edges"),
        ({"about": "cubes"}, "'about' and 'rules'"),
        ({"about": [[0, 0]], "rules": ["edges"]}, "every point must be a list of 3 numbers"),
    ],
)
def test_what_is_wrong_with_a_tessellation(
    tmp_path: Path, data: dict[str, Any], message: str
) -> None:
    with pytest.raises(VolfrepError, match=message):
        load_cell(written(tmp_path / "cell.json", {"tessellation": data}))


def test_a_block_of_a_cell_by_rules_is_one_body(tmp_path: Path) -> None:
    rules = {"about": [["x", 0.5, 0.5]], "rules": ["edges", "centre to corners"]}
    spread = {"x": {"usual": 0.3, "least": 0.3, "most": 0.7}}
    path = written(tmp_path / "own.json", {"tessellation": rules, "parameters": spread})
    spec = LatticeSpec(load_cell(path, "x = 0.5"), 8.0, 0.5, shell=0.0, resolution=16)
    report = block(spec, (2, 1, 1)).report
    assert report.bodies == 1
    assert report.genus == report.struts - report.nodes + 1


def test_a_catalogues_cell_becomes_a_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, cell = tmp_path / "catalogue.txt", tmp_path / "cell.json"
    path.write_text(CATALOGUE)
    assert catalogue_names(path) == ["own_cross", "own_tilted"]
    _, edges, nodes, struts = catalogue_entry(path, "Own_Cross")
    assert edges == (0.5, 1.0, 1.0)
    assert pairs(nodes, struts) == pairs(LIBRARY["Cross"].nodes, LIBRARY["Cross"].struts)
    assert cli.run(["cells", str(path)]) == 0
    assert capsys.readouterr().out.split() == ["own_cross", "own_tilted"]
    assert cli.run(["cells", str(path), "--entry", "own_cross", "-o", str(cell)]) == 0
    again = load_cell(cell)
    assert (again.name, again.edges, len(again.struts)) == ("own_cross", (0.5, 1.0, 1.0), 6)
    # What descends from it counts from 0.
    path.write_text(CATALOGUE.replace("1 7", "0 6").replace("2 7", "1 6").replace("3 7", "2 6")
                    .replace("4 7", "3 6").replace("5 7", "4 6").replace("6 7", "5 6"))  # fmt: skip
    assert catalogue_entry(path, "own_cross")[3] == struts
    assert cli.run(["cells", str(path), "--entry", "own_tilted"]) == 2
    assert "is no box (its angles are 60, 60 and 90 degrees)" in capsys.readouterr().err
    assert cli.run(["cells", str(path), "--entry", "other"]) == 2
    assert "holds no cell 'other'" in capsys.readouterr().err
    assert cli.run(["cells", "--entry", "other"]) == 2
    assert "name its file" in capsys.readouterr().err
    path.write_text("nothing")
    assert cli.run(["cells", str(path)]) == 2
    assert "holds no cells" in capsys.readouterr().err


def test_edges_and_widths_are_saved(tmp_path: Path) -> None:
    cell = make_cell("x", [[0, 0, 0], [1, 1, 1]], [[0, 1]], edges=[1, 2, 1], widths=[0.5])
    save_cell(cell, tmp_path / "x.json")
    assert load_cell(tmp_path / "x.json") == cell


#: As catalogues that descend from it write an entry: further lists about the bars, nodes from 0.
DESCENDED = """----- lattice_transition -----
Name: own_corner_p_0.0_-12

Base name: own_corner
Imperfection level: 0.0
Nodal hash: -12
Normalized unit cell parameters (a,b,c,alpha,beta,gamma):
1, 1, 1, 90, 90, 90


Compliance tensors (Mandel) start (flattened upper triangular)
-> at relative density 0.01:
300,-1.0184e-13,300,9.4e+04
Compliance tensors (Mandel) end

Nodal positions:
0 0.25 0.5
0.25 0 0.5
0.25 0.25 0
0.25 0.25 0.5
0.25 0.25 1
0.25 1 0.5
1 0.25 0.5

Bar connectivities:
0 3
1 3
2 3
3 4
3 5
3 6

Fundamental edge adjacency
3 3
3 3
3 3

Fundamental tesselation vectors
1 0 0
0 1 0
0 0 1
"""


@pytest.mark.costly
def test_lists_of_other_things_in_a_catalogue_are_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "catalogue.lat"
    path.write_text(DESCENDED)
    (name,) = catalogue_names(path)
    assert name == "own_corner_p_0.0_-12"
    _, edges, nodes, struts = catalogue_entry(path, name)
    assert edges == (1.0, 1.0, 1.0)
    assert (len(nodes), struts) == (7, [[0, 3], [1, 3], [2, 3], [3, 4], [3, 5], [3, 6]])
    cell = make_cell(name, nodes, struts)
    # A node on a face has its image on the opposite one: bars go on into the next cell.
    report = block(LatticeSpec(cell, 10, 0.5), (2, 2, 2)).report
    assert (report.watertight, report.bodies) == (True, 1)
