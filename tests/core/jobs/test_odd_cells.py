# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells that are no cubes, or whose struts differ: in blocks and in parts."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

import volfrep
from volfrep.design.cells import load_cell, make_cell
from volfrep.mechanics.density import relative_density
from volfrep.util.errors import VolfrepError

HEIGHT = 0.8


def honeycomb(columns: float = 1.0):
    """Hexagons of edge 1/sqrt(3) in a box of sqrt(3) x 1, and columns between two layers of them.

    Per box: 6 corners of hexagons a layer, 9 edges, 6 columns.
    """
    x = np.array([1, 2, 4, 5, 4, 2, 0, 6]) / 6.0
    y = np.array([0.5, 0, 0, 0.5, 1, 1, 0.5, 0.5])
    nodes = [[a, b, z] for z in (0, 1) for a, b in zip(x.tolist(), y.tolist(), strict=True)]
    ring = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (6, 0), (3, 7)]
    flat = ring + [(a + 8, b + 8) for a, b in ring]
    up = [(k, k + 8) for k in range(6)]
    widths = () if columns == 1.0 else [1.0] * len(flat) + [columns] * len(up)
    edges = (3**0.5, 1.0, HEIGHT)
    return make_cell("Honeycomb", nodes, flat + up, edges=edges, widths=widths)


def test_the_hexagons_of_a_block_are_regular() -> None:
    part = volfrep.block((2, 3, 1), cell=honeycomb(), cell_size=8, strut_radius=0.4)
    frame = part.result.wireframe
    along = frame.nodes[frame.struts[:, 1]] - frame.nodes[frame.struts[:, 0]]
    length = np.linalg.norm(along, axis=1)
    upright = np.abs(along[:, 2]) > 1.0
    assert length[upright] == pytest.approx(8 * HEIGHT)
    # Those that cross a cell's border have a node there, in their middle.
    assert set(np.round(length[~upright] * 3**0.5 / 8, 6)) == {0.5, 1.0}
    report = part.report
    assert (report.bodies, report.watertight) == (1, True)
    assert report.genus == len(frame.struts) - len(frame.nodes) + 1


def test_struts_have_radii_of_their_own() -> None:
    part = volfrep.block((1, 1, 1), cell=honeycomb(0.5), cell_size=20, strut_radius=1)
    frame = part.result.wireframe
    along = frame.nodes[frame.struts[:, 1]] - frame.nodes[frame.struts[:, 0]]
    upright = np.abs(along[:, 2]) > 1.0
    assert frame.radii[upright] == pytest.approx(0.5)
    assert frame.radii[~upright] == pytest.approx(1.0)
    # A cut in the middle of a column is a circle of its own radius.
    loops = part.mesh.section((0, 0, 1), (0, 0, 10 * HEIGHT)).discrete
    areas = [abs(np.cross(p[:-1, :2], p[1:, :2]).sum()) / 2 for p in loops]
    assert areas == pytest.approx([np.pi * 0.25] * 6, rel=0.05)


@pytest.mark.slow
def test_a_part_is_filled_and_skinned() -> None:
    box = trimesh.creation.box((40, 30, 24))
    part = volfrep.fill(box, cell=honeycomb(), cell_size=8, strut_radius=0.6, shell=1.5)
    assert (part.report.bodies, part.report.watertight) == (1, True)
    assert part.mesh.bounds == pytest.approx(box.bounds, abs=1e-4)
    hollow = 40 * 30 * 24 - 37 * 27 * 21
    assert part.mesh.volume > hollow


def test_what_only_cubes_have_is_refused() -> None:
    cell = honeycomb()
    box = trimesh.creation.box((40, 30, 24))
    for more in ({"fillet": 0.2}, {"cell_map": "cylindrical"}):
        with pytest.raises(VolfrepError, match="which 'Honeycomb' is not"):
            volfrep.fill(box, cell=cell, cell_size=8, **more)
    with pytest.raises(VolfrepError, match="which 'Honeycomb' is not"):
        relative_density(cell, 0.05)


def test_a_file_says_edges_and_widths(tmp_path: Path) -> None:
    cell = honeycomb(0.5)
    data = {
        "nodes": cell.nodes.tolist(), "struts": cell.struts.tolist(),
        "edges": list(cell.edges), "widths": cell.widths.tolist(),
    }  # fmt: skip
    file = tmp_path / "honeycomb.json"
    file.write_text(json.dumps(data))
    read = load_cell(file)
    assert read.edges == cell.edges
    assert np.array_equal(read.widths, cell.widths)
    for key, value in (("edges", [1, 2]), ("edges", [1, 1, 0]), ("widths", [1, 1]), ("widths", 3)):
        file.write_text(json.dumps(data | {key: value}))
        with pytest.raises(VolfrepError, match=f"'{key}' must be a list"):
            load_cell(file)
