# SPDX-License-Identifier: LGPL-2.1-or-later
"""Struts drawn as tubes in the colours of what they carry."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from volfrep import LatticeSpec
from volfrep.io.solid import check_solid
from volfrep.jobs.sizing import Goal, size
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.reports.sizing_picture import sizing_picture, tubes


def test_a_tube_lies_about_its_strut_and_faces_outwards() -> None:
    nodes = np.array([[0, 0, 0], [0, 3, 4]], float)
    radii, values = np.array([[1.0, 2.0]]), np.array([[10.0, 30.0]])
    points, facets, shades = tubes(nodes, np.array([[0, 1]]), radii, values)
    along = points @ [0, 0.6, 0.8]
    away = np.linalg.norm(points - along[:, None] * [0, 0.6, 0.8], axis=1)
    assert away == pytest.approx(1.0 + along / 5.0)
    assert shades == pytest.approx(10.0 + 4.0 * along)
    a, b, c = points[facets].swapaxes(0, 1)
    middle = (a + b + c) / 3
    outwards = middle - (middle @ [0, 0.6, 0.8])[:, None] * [0, 0.6, 0.8]
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), outwards) > 0).all()


@pytest.mark.costly
@pytest.mark.slow_but("stress")
@pytest.mark.parametrize("colour", ["radius", "stress", "governing"])
def test_a_design_is_drawn_in_colours_with_a_legend(tmp_path: Path, colour: str) -> None:
    pytest.importorskip("pyvista", reason="pictures need the optional package pyvista")
    from PIL import Image

    shape = trimesh.creation.box((20, 10, 10))
    solid = check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "box")
    wall, tip = (InPlane((x, 0, 0), (1, 0, 0)) for x in (-10.0, 10.0))
    case = LoadCase("down", (Support(wall),), (Force(tip, (0, 0, -50.0)),))
    loads = LoadCases(find_material("PA12"), (case,))
    spec = LatticeSpec("BCC", cell_size=10, strut_radius=0.7, boundary="whole", activation="centre")
    made = size(solid, spec, loads, Goal(), most_steps=3, prove_it=False)
    file = tmp_path / "design.png"
    governing = made.governing.rows, made.governing.told
    sizing_picture(
        made.model, made.sized.analysis, file, colour=colour, deformed=1.0, size=(400, 300),
        governing=governing,
    )  # fmt: skip
    picture = np.asarray(Image.open(file).convert("RGB")).astype(int)
    lively = np.ptp(picture, axis=2) > 80
    assert lively[:, :300].mean() > 0.01
    assert lively[:, 340:].mean() > 0.005  # the legend
