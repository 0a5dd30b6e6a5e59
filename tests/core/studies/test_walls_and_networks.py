# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of walls and of networks: their forecasts beside the part, and what walls do."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from volfrep import Study
from volfrep.design.graphs import RandomGraph
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.preview import PartDepth
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.studies.expectation import expect
from volfrep.studies.sweep import sweep


@pytest.fixture(scope="module")
def cube(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("part") / "cube.stl"
    trimesh.creation.box((20, 20, 20)).export(path)
    return str(path)


def only_row(study: Study, folder: Path) -> dict[str, Any]:
    table = sweep(study, folder, workers=1).table
    return {name: table.column(name)[0] for name in table.columns}


@pytest.mark.slow
def test_forecasts_and_properties_of_walls_are_those_of_the_part(cube: str, tmp_path: Path) -> None:
    fixed = {"cell": "Schwarz P", "cell_size": 10.0, "wall_thickness": 0.856}
    study = Study(
        (cube,), fixed=fixed, vary={"shell": (1.0,)}, do=("forecast", "properties", "fill")
    )
    row = only_row(study, tmp_path)
    assert row["state"] == "done"
    assert row["forecast.mass_g"] == pytest.approx(row["fill.mass_g"], rel=0.01)
    # Of the endless wall, not of the two cells that the cube cuts: docs/tpms.md has this one.
    assert row["properties.E100"] == pytest.approx(0.0434, rel=0.02)
    assert row["forecast.strut_radius_mm"] == pytest.approx(0.428)


@pytest.mark.slow
def test_networks_have_forecasts_and_no_properties(cube: str, tmp_path: Path) -> None:
    fixed = {"network": "voronoi", "network_points": 20, "strut_radius": 0.4}
    study = Study((cube,), fixed=fixed, vary={"shell": (1.0,)}, do=("forecast", "fill"))
    row = only_row(study, tmp_path / "a")
    assert row["forecast.mass_g"] == pytest.approx(row["fill.mass_g"], rel=0.02)
    study = Study((cube,), fixed=fixed, vary={"shell": (1.0,)}, do=("properties",))
    row = only_row(study, tmp_path / "b")
    assert row["state"] == "failed"
    assert "repeats nowhere" in row["error"]


@pytest.mark.costly
@pytest.mark.slow_but("given0")
@pytest.mark.parametrize("given", [{"cell": "Gyroid"}, {"network": RandomGraph(points=10)}])
def test_of_a_domain_is_expected_what_walls_and_networks_fill(given: dict[str, Any]) -> None:
    box = trimesh.creation.box((20.0, 20.0, 20.0))
    solid = TriangleMesh(box.vertices, box.faces.astype(np.int32))
    spec = LatticeSpec(**given, cell_size=8, strut_radius=0.5, shell=2, output="domain")
    found = expect(solid, spec, PartDepth(solid))
    assert found.volume_mm3 == pytest.approx(16.0**3, rel=0.01)
    part = expect(solid, replace(spec, output="part"), PartDepth(solid))
    assert found.relative_density == pytest.approx(part.relative_density)
