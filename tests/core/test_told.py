# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is told of a part is so: graphs have no cells, help names what there is."""

import zipfile

import numpy as np
import pytest
import trimesh

import volfrep
from command import run
from volfrep.design.forecast import forecast_fill
from volfrep.output.form import suffixes
from volfrep.reports.processes import PROCESSES

CORNER = ([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [(0, 1), (0, 2)])


def test_a_graph_is_told_by_its_struts_and_not_by_cells_that_it_has_not():
    part = volfrep.mesh_network(CORNER, strut_radius=1)
    assert repr(part).startswith("<Part of Strut graph: 2 struts")
    assert part.report.figures["Description"].startswith("Strut graph: 2 struts, 1 body")
    cube = volfrep.block((1, 1, 1), cell="BCC", strut_radius=1)
    assert cube.report.figures["Description"].startswith("BCC lattice: 1 cells, 20 struts")


@pytest.mark.costly_cases("delaunay-Delaunay")
@pytest.mark.parametrize(("network", "name"), [("voronoi", "Voronoi"), ("delaunay", "Delaunay")])
def test_a_random_graph_is_forecast_without_cells(network, name):
    solid = volfrep.as_solid(trimesh.creation.box((20, 20, 20)))
    spec = volfrep.api.specified(None, {"network": network, "strut_radius": 0.5}, None)
    assert str(forecast_fill(solid, spec)).startswith("about ")
    assert "cells" not in str(forecast_fill(solid, spec))
    part = volfrep.fill(solid, spec, network_points=12)
    assert part.report.lattice == f"{name} graph"


def test_a_3mf_of_beams_alone_holds_what_is_known_of_it(tmp_path):
    volfrep.block((1, 1, 1), cell="BCC", strut_radius=1).save(tmp_path / "cell.3mf", "beams")
    with zipfile.ZipFile(tmp_path / "cell.3mf") as package:
        text = package.read("3D/3dmodel.model").decode()
    assert "BCC: 20 struts as beams between" in text
    assert "strut_radius" in text


def test_help_names_every_form_and_where_turned_cells_begin(capsys):
    with pytest.raises(SystemExit):
        run("fill", "--help")
    told = " ".join(capsys.readouterr().out.split())
    assert all(suffix in told for suffix in suffixes())
    assert "a corner of the box that is turned with them" in told


def test_the_docstring_of_check_names_every_process():
    assert all(name in (volfrep.Part.check.__doc__ or "") for name in PROCESSES)


def test_turned_cells_begin_at_a_corner_of_the_box_that_is_turned_with_them():
    box = trimesh.creation.box((20, 20, 20))
    part = volfrep.fill(box, cell="Box", shell=0, rotate=(0, 0, 1, 45), resolution=8)
    turn = np.array([[1, 1, 0], [-1, 1, 0], [0, 0, np.sqrt(2)]]) / np.sqrt(2)
    steps = (part.nodes @ turn.T + np.array([1, 1, 0]) * np.sqrt(200) + (0, 0, 10)) / 10
    assert np.abs(steps - steps.round()).max() < 1e-3
