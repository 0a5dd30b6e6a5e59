# SPDX-License-Identifier: LGPL-2.1-or-later
"""Networks of the elements that files of meshes hold."""

from pathlib import Path

import numpy as np
import pytest

import volfrep
from volfrep.design.cells import find_cell
from volfrep.design.graphs.conformal_cells import CORNERS
from volfrep.design.graphs.files import read_network
from volfrep.util.errors import VolfrepError

meshio = pytest.importorskip("meshio")
CUBES = np.vstack([10.0 * CORNERS, 10.0 * CORNERS + [10.0, 0.0, 0.0]])
QUAD = np.array([[0, 0, 0], [8, 0, 0], [8, 8, 0], [0, 8, 0]], float)


def written(file: Path, points: np.ndarray, kind: str, rows: object, **how: object) -> Path:
    """A mesh of elements of one kind as a file."""
    meshio.Mesh(points, [(kind, np.array(rows))]).write(file, **how)
    return file


@pytest.mark.parametrize("name", ["mesh.vtk", "mesh.vtu", "mesh.inp", "mesh.msh"])
def test_hexahedra_hold_a_cell_each(tmp_path: Path, name: str) -> None:
    rows = [range(8), range(8, 16)]
    how = {"file_format": "gmsh"} if name.endswith(".msh") else {}  # Ansys has this ending, too
    file = written(tmp_path / name, CUBES, "hexahedron", rows, **how)
    made = read_network(file, find_cell("BCC"))
    assert (len(made.nodes), len(made.struts)) == (12 + 2, 16 + 20)
    assert made.cell == "BCC"
    with pytest.raises(VolfrepError, match="give the cell"):
        read_network(tmp_path / name)


def test_tetrahedra_give_their_edges(tmp_path: Path) -> None:
    points = CUBES[[0, 1, 3, 4, 6]]
    file = written(tmp_path / "t.vtk", points, "tetra", [[0, 1, 2, 3], [1, 2, 3, 4]])
    made = read_network(file)
    assert (len(made.nodes), len(made.struts), made.cell) == (5, 9, "")


def test_cells_in_the_hexahedra_of_a_file_are_meshed(tmp_path: Path) -> None:
    file = written(tmp_path / "mesh.vtk", CUBES, "hexahedron", [range(8)])
    made = volfrep.mesh_network(file, cell="Box", strut_radius=0.5)
    assert (made.report.bodies, made.report.genus) == (1, 5)


def test_quadrilaterals_carry_layers(tmp_path: Path) -> None:
    file = written(tmp_path / "q.obj", QUAD, "quad", [[0, 1, 2, 3]])
    made = read_network(file, find_cell("Box"), -6.0, 2)
    assert (len(made.nodes), made.nodes[:, 2].min()) == (12, -6.0)
    assert (made.thickness, made.layers) == (-6.0, 2)


def test_a_mesh_without_anything_to_lay_into_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path / "v.vtk", QUAD, "triangle", [[0, 1, 2]])
    with pytest.raises(VolfrepError, match="holds no lines, hexahedra"):
        read_network(file, find_cell("Box"))
    (tmp_path / "broken.inp").write_text("*NODE\n1, 0, zero, 0\n")
    with pytest.raises(VolfrepError, match="damaged"):
        read_network(tmp_path / "broken.inp", find_cell("Box"))
