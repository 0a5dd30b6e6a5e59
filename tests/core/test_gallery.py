# SPDX-License-Identifier: LGPL-2.1-or-later
"""The gallery's scripts do what they say, in a few lines each, with public names only."""

from __future__ import annotations

import ast
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import volfrep

GALLERY = Path(__file__).resolve().parents[2] / "docs" / "gallery"
Seen = dict[str, Any]


def _mesh(seen: Seen, at: Path) -> None:
    assert trimesh.load(at / "filled.ply").volume == pytest.approx(seen["part"].mesh.volume)
    assert seen["part"].mass == pytest.approx(seen["part"].report.volume_mm3 / 1000.0)


def _densities(seen: Seen, at: Path) -> None:
    assert (at / "densities.png").stat().st_size > 5000
    moduli = [cube.values["E100"] for cube in seen["cubes"]]
    assert moduli == sorted(moduli)


def _own_cell(seen: Seen, at: Path) -> None:
    assert seen["cube"].report.bodies == 1
    assert volfrep.read_solid(at / "tents.stl").volume == pytest.approx(seen["cube"].mesh.volume)


def _own_field(seen: Seen, at: Path) -> None:
    # Of points the radius follows x; of the function it is smallest in the middle.
    frame, by_points = seen["part"].nodes, seen["part"].fields["radius"]
    assert np.corrcoef(frame[:, 0], by_points)[0, 1] > 0.95
    nodes, radius = seen["round_it"].nodes, seen["round_it"].fields["radius"]
    inside = (np.abs(nodes) <= (20, 10, 10)).all(axis=1)
    wanted = 0.4 + np.linalg.norm(nodes, axis=1) / 40.0
    assert radius[inside] == pytest.approx(wanted[inside], abs=0.01)


def _networkx(seen: Seen, at: Path) -> None:
    loops = seen["graph"].number_of_edges() - seen["graph"].number_of_nodes() + 1
    assert seen["part"].report.genus == loops == 28
    assert (at / "grid.3mf").is_file()


def _properties(seen: Seen, at: Path) -> None:
    octet = seen["found"]["Octet"]
    assert seen["table"].loc[("Octet", "E100"), "value"] == octet.values["E100"]


def _optimise(seen: Seen, at: Path) -> None:
    assert seen["best"].fun < 0.2
    assert 0.4 < seen["best"].x < 1.6


def _optuna(seen: Seen, at: Path) -> None:
    trials = seen["search"].trials
    assert [trial.state.name for trial in trials] == ["COMPLETE"] * 30
    assert len(list((at / "runs" / "records").iterdir())) == 30
    masses = [trial.values[0] for trial in seen["best"]]
    assert min(masses) == min(trial.values[0] for trial in trials)


def _report(seen: Seen, at: Path) -> None:
    assert volfrep.read_solid(at / "light.3mf").volume == pytest.approx(
        seen["part"].mesh.volume, rel=1e-4
    )
    assert '"mass_g"' in (at / "light.json").read_text("utf-8")


def _layers(seen: Seen, at: Path) -> None:
    assert seen["made"].count == len(list((at / "layers").glob("*.png"))) == 20


def _sized(seen: Seen, at: Path) -> None:
    assert seen["part"].sized.report
    assert seen["part"].struts.radii.min() < seen["part"].struts.radii.max()


def _fem(seen: Seen, at: Path) -> None:
    fields = seen["part"].fields
    assert 0.4 <= fields["radius"].min() < 0.5
    assert np.corrcoef(fields["radius"], fields["field"])[0, 1] > 0.9


def _dask(seen: Seen, at: Path) -> None:
    assert seen["made"].count("done") == 4


def _tpms(seen: Seen, at: Path) -> None:
    assert seen["cube"].mesh.is_volume
    assert seen["cube"].mesh.center_mass[2] < 9.0


def _conformal(seen: Seen, at: Path) -> None:
    radius = np.hypot(*seen["part"].nodes[:, [0, 2]].T)
    assert 20.0 - 0.5 < radius.min() < radius.max() <= 32.0 + 1e-3
    assert seen["part"].report.bodies == 1


#: What each script is to have made, and whether it is a wish of eight lines at most.
SCRIPTS: dict[str, tuple[Callable[[Seen, Path], None], bool]] = {
    "a_mesh": (_mesh, True),
    "densities": (_densities, True),
    "own_cell": (_own_cell, True),
    "own_field": (_own_field, True),
    "networkx_graph": (_networkx, True),
    "properties_table": (_properties, True),
    "optimise": (_optimise, True),
    "optuna_search": (_optuna, False),
    "report_3mf": (_report, True),
    "layers": (_layers, True),
    "sized_for_loads": (_sized, True),
    "fem_field": (_fem, False),
    "dask_study": (_dask, False),
    "tpms_formula": (_tpms, False),
    "conformal": (_conformal, False),
}
NEEDS = {
    "densities": "matplotlib",
    "networkx_graph": "networkx",
    "properties_table": "pandas",
    "sized_for_loads": "pandas",
    "dask_study": "distributed",
    "optuna_search": "optuna",
    "conformal": "meshio",
}


def test_every_script_is_looked_at() -> None:
    assert {path.stem for path in GALLERY.glob("*.py")} == SCRIPTS.keys()


@pytest.mark.parametrize("name", SCRIPTS)
def test_a_script_is_short_and_takes_public_names_only(name: str) -> None:
    body = ast.parse((GALLERY / f"{name}.py").read_text("utf-8")).body
    assert ast.get_docstring(ast.Module(body, []))
    lines = body[1:]
    imported = [line for line in lines if isinstance(line, (ast.Import, ast.ImportFrom))]
    steps = sum(1 for line in lines if line not in imported)
    assert steps <= 8 or not SCRIPTS[name][1]
    names = {alias.name for line in imported for alias in line.names}
    assert "volfrep" in names
    assert not any(one.startswith("volfrep.") for one in names)
    for node in ast.walk(ast.Module(body, [])):
        if isinstance(node, ast.Attribute):
            assert not node.attr.startswith("_")
            if isinstance(node.value, ast.Name) and node.value.id == "volfrep":
                assert node.attr in volfrep.__all__


@pytest.mark.costly_cases("a_mesh", "own_field", "report_3mf", "sized_for_loads")
@pytest.mark.slow_cases(
    "dask_study", "optimise", "optuna_search", "own_cell", "tpms_formula", "fem_field"
)
@pytest.mark.parametrize("name", SCRIPTS)
def test_a_script_does_what_it_says(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if name in NEEDS:
        pytest.importorskip(NEEDS[name], reason=f"needs the optional package {NEEDS[name]}")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    SCRIPTS[name][0](runpy.run_path(str(GALLERY / f"{name}.py"), run_name="__main__"), tmp_path)
