# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a script's author wants beyond the gallery (test_gallery): notebooks, refusals, files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import volfrep
from volfrep.api import specified
from volfrep.design.grading import Orientation

LOADS = """
material = "Ti-6Al-4V"
[[support]]
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
fixed = true
[[case]]
name = "down"
[[case.load]]
plane = { point = [20, 0, 0], normal = [1, 0, 0] }
force = [0, 0, -100]
"""


def test_a_part_shows_itself_in_a_notebook() -> None:
    box = trimesh.creation.box((20, 20, 10))
    part = volfrep.fill(box, cell="BCC", cell_size=10, strut_radius=1, shell=0, resolution=8)
    assert part.nodes.shape == (len(part.struts.nodes), 3)
    assert f"{part.report.struts:,} struts" in repr(part)
    shown = part._repr_html_()
    assert shown.count("<path ") == len(part.struts.struts)
    assert f"<td>{part.report.struts}</td>" in shown
    assert part.properties().relative_density == volfrep.properties("BCC", 10, 1).relative_density
    assert part.fields["to_surface"].max() <= 10.0


def test_layers_of_a_part(tmp_path: Path) -> None:
    box = trimesh.creation.box((20, 20, 10))
    part = volfrep.fill(box, cell="BCC", cell_size=10, strut_radius=1, shell=1, resolution=8)
    assert part.layers(tmp_path / "layers", layer=1.0, pixel=0.5).count == 10
    part.save(tmp_path / "saved", layer=2.0)
    assert len(list((tmp_path / "saved").glob("*.png"))) == 5
    with pytest.raises(volfrep.VolfrepError, match="no format 'tif'"):
        part.layers(tmp_path / "more", layer=1.0, form="tif")


@pytest.mark.costly
def test_struts_are_sized_for_loads(tmp_path: Path) -> None:
    (tmp_path / "loads.toml").write_text(LOADS, encoding="utf-8")
    box = trimesh.creation.box(bounds=((0, 0, 0), (20, 10, 10)))
    part = volfrep.size(
        box, tmp_path / "loads.toml", cell="CVC", cell_size=5, strut_radius=0.5, shell=0,
        boundary="whole", activation="inside", resolution=8, safety=3, steps=5, proof=False,
    )  # fmt: skip
    assert part.sized is not None
    assert part.struts.radii.min() < part.struts.radii.max()


def test_a_goal_that_there_is_not(tmp_path: Path) -> None:
    with pytest.raises(volfrep.VolfrepError, match="did you mean 'max_stress'"):
        volfrep.size(
            trimesh.creation.box((9, 9, 9)),
            tmp_path / "loads.toml",
            max_stres=3,  # type: ignore[call-arg]
        )


LINES = [
    [[0, 0, 0], [1, 1, 1]], [[0, 1, 1], [1, 0, 0]], [[0, 0, 1], [1, 1, 0]], [[0, 1, 0], [1, 0, 1]],
]  # fmt: skip


@pytest.mark.costly
def test_a_cell_is_given_by_lines_a_dict_or_arrays() -> None:
    drawn = volfrep.cell_from_lines("X", np.array(LINES, float))
    nodes, struts = drawn.cell.nodes, drawn.cell.struts
    ways: list[Any] = [drawn, {"nodes": nodes, "struts": struts}, (nodes, struts)]
    cubes = [volfrep.block((1, 1, 1), cell=way, cell_size=9, strut_radius=0.9) for way in ways]
    assert {cube.report.struts for cube in cubes} == {len(struts)}
    assert len({round(cube.report.volume_mm3, 6) for cube in cubes}) == 1
    known = {volfrep.properties(way, 9, 1.2, along=16).values["E100"] for way in ways}
    assert len(known) == 1


def test_values_are_those_of_the_command_too() -> None:
    for rotate in ("0,0,1,30", [0, 0, 1, 30], (0.0, 0, 1, 30)):
        assert specified(None, {"rotate": rotate}, None).orientation == Orientation((0, 0, 1), 30)
    assert specified(None, {"open_faces": None}, None) == volfrep.LatticeSpec()
    for given, meant in (({"network": "voronoy"}, "voronoi"), ({"boundary": "hole"}, "whole")):
        with pytest.raises(volfrep.VolfrepError, match=f"did you mean '{meant}'"):
            specified(None, given, None)


def test_a_skin_is_as_thick_as_a_function_says() -> None:
    made = specified(None, {"shell": "1 + x / 10"}, None, lambda s: np.array([[0.0] * 3, [9] * 3]))
    assert made.skin_field is not None
    assert made.shell == 1.0
    assert made.skin_field([[9, 0, 0]]) == pytest.approx([1.9])
    with pytest.raises(volfrep.VolfrepError, match="above 0 everywhere"):
        specified(None, {"shell": "x"}, None, lambda s: np.array([[0.0] * 3, [9] * 3]))


@pytest.mark.costly
def test_a_study_takes_meshes_and_lists(tmp_path: Path) -> None:
    box = trimesh.creation.box((20, 20, 20))
    study = volfrep.Study(parts=[box], vary={"cell": ["BCC", "CVC"]}, do=["forecast"])
    made = volfrep.sweep(study, tmp_path / "runs", workers=1, progress=True)
    assert repr(made).startswith("<Swept: done 2;")
    assert repr(made.table).startswith("<Table of 2 designs: key, part, ")
    assert "<th>done</th><td>2</td>" in made._repr_html_()
    volfrep.evaluate(study, [{"cell": "BCC"}], tmp_path / "more", workers=1, progress=True)


@pytest.mark.costly
def test_results_show_figures_and_no_arrays() -> None:
    box = trimesh.creation.box((20, 20, 10))
    sheet = volfrep.block((1, 1, 1), cell="Gyroid", cell_size=9, wall_thickness=1, resolution=12)
    assert "struts" not in repr(sheet)
    ladder = volfrep.coupons(kinds=["ladder"])[0]
    octet = volfrep.properties("Octet", 10, 0.5)
    shown = (octet, volfrep.orient(box), ladder, volfrep.slicer_infill(box, bands=2))
    for one in shown:
        assert "array" not in repr(one)
        assert repr(one).startswith(f"<{type(one).__name__}: ")
        assert len(repr(one)) < 200
        assert one._repr_html_().startswith("<table><tr><th>")
    assert "E along [100]" in octet._repr_html_()


def test_a_graph_that_does_not_reach_the_skin_is_told_so() -> None:
    box = trimesh.creation.box(bounds=((0, 0, 0), (30, 20, 20)))
    graph = ([[9, 9, 9], [19, 9, 9], [15, 12, 12]], [(0, 1), (1, 2)])
    with pytest.raises(volfrep.VolfrepError, match="struts of a graph go on to the skin"):
        volfrep.fill(box, network=graph, strut_radius=0.8, shell=1)
