# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sweeps: nothing is done twice, nothing is lost, and what is promised of a design is made."""

from __future__ import annotations

import json
import shlex
import shutil
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import trimesh

import samples
import volfrep
from command import run
from swept import timeless
from volfrep import Cancelled, Front, Range, Study, VolfrepError
from volfrep.io.solid import check_solid
from volfrep.io.write.stl import write_stl
from volfrep.mechanics.materials import find_material
from volfrep.studies import page
from volfrep.studies.actions import ACTIONS
from volfrep.studies.running import evaluator
from volfrep.studies.sweep import Swept

BOX = check_solid(samples.box((24.0, 16.0, 16.0)), "box")
QUICK = Study(
    parts=(BOX,),
    vary={"cell": ("BCC", "CVC", "Octet"), "relative_density": (0.1, 0.2)},
    fixed={"cell_size": 8.0, "shell": 1.0},
    do=("forecast", "properties"),
    front=Front({"forecast.mass_g": "least", "properties.E100": "most"}),
)


@pytest.fixture(autouse=True)
def _unplotted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Drawing takes longer than all else; `test_page` looks at it."""
    monkeypatch.setattr(page, "plots_of", lambda *_: [])


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Swept:
    """The study, done; nobody changes its folder."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(page, "plots_of", lambda *_: [])
        return volfrep.sweep(QUICK, tmp_path_factory.mktemp("whole"))


@pytest.fixture
def done(whole: Swept, tmp_path: Path) -> Path:
    """A copy of its folder."""
    shutil.copytree(whole.page.parent, tmp_path, dirs_exist_ok=True)
    return tmp_path


def test_a_study_makes_a_record_a_design_a_table_and_a_page(tmp_path: Path) -> None:
    made = volfrep.sweep(QUICK, tmp_path)
    rows = timeless(tmp_path)
    assert made.count("done") == made.runs == len(rows) == 6
    assert {path.stem for path in (tmp_path / "records").iterdir()} == {r["key"] for r in rows}
    assert [(r["cell"], r["relative_density"]) for r in rows[:3]] == [
        ("BCC", "0.1"), ("BCC", "0.2"), ("CVC", "0.1")
    ]  # fmt: skip
    text = (tmp_path / "index.html").read_text()
    assert all(row["key"] in text for row in rows)
    assert not list(tmp_path.rglob("*.part"))


@pytest.mark.costly
def test_what_is_done_is_not_done_again(done: Path) -> None:
    before = timeless(done)
    times = {path: path.stat().st_mtime_ns for path in (done / "records").iterdir()}
    again = volfrep.sweep(QUICK, done)
    assert again.runs == 0
    assert timeless(done) == before
    assert {p: p.stat().st_mtime_ns for p in (done / "records").iterdir()} == times
    next(iter(times)).unlink()
    assert volfrep.sweep(QUICK, done).runs == 1
    assert timeless(done) == before


@pytest.mark.slow
def test_what_hangs_on_the_material_is_done_anew_with_another(tmp_path: Path) -> None:
    import dataclasses

    given = dataclasses.replace(QUICK, fixed={**QUICK.fixed, "density": 1.0})
    volfrep.sweep(given, tmp_path)
    soft = volfrep.sweep(dataclasses.replace(given, material="PA12"), tmp_path)
    stiff = volfrep.sweep(dataclasses.replace(given, material="316L"), tmp_path)
    assert (soft.runs, stiff.runs) == (6, 6)
    ratio = stiff.table.numbers("properties.E100") / soft.table.numbers("properties.E100")
    assert ratio == pytest.approx(find_material("316L").young / find_material("PA12").young)


@pytest.mark.slow
def test_the_forecast_of_the_mass_is_near_what_a_fill_makes(tmp_path: Path) -> None:
    study = Study(
        parts=(BOX,),
        vary={"cell": ("BCC", "CVC")},
        fixed={"cell_size": 8.0, "strut_radius": 0.9, "shell": 1.0},
        do=("forecast", "fill"),
    )
    made = volfrep.sweep(study, tmp_path, workers=1)
    table = made.table
    assert table.numbers("forecast.mass_g") == pytest.approx(table.numbers("fill.mass_g"), rel=0.05)
    assert table.column("fill.watertight") == [True, True]


def test_the_chosen_are_those_that_no_other_design_beats(whole: Swept) -> None:
    rows = {row["key"]: row for row in whole.table.dicts()}

    def better(one: dict, two: dict) -> bool:
        mass, stiffness = "forecast.mass_g", "properties.E100"
        lighter = float(f"{one[mass]:.6g}") - float(f"{two[mass]:.6g}")
        softer = float(f"{one[stiffness]:.6g}") - float(f"{two[stiffness]:.6g}")
        return lighter <= 0 <= softer and (lighter < 0 or softer > 0)

    best = {k for k, row in rows.items() if not any(better(r, row) for r in rows.values())}
    assert set(whole.front) == best
    assert set(whole.front.values()) == {1}


def triangles_of(file: Path) -> Counter[bytes]:
    """The triangles of a binary STL, each with its first corner first, however often."""
    rows = np.frombuffer(file.read_bytes()[84:], np.dtype([("at", "<f4", (4, 3)), ("", "u2")]))
    corners = rows["at"][:, 1:]
    first = np.array([min(range(3), key=lambda k: tuple(one[k])) for one in corners.tolist()])
    turned = corners[np.arange(len(corners))[:, None], (first[:, None] + np.arange(3)) % 3]
    return Counter(one.tobytes() for one in turned)


@pytest.mark.slow
def test_the_command_of_a_chosen_design_makes_exactly_that_part(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_stl(BOX, tmp_path / "a box.stl")
    study = Study(
        parts=(str(tmp_path / "a box.stl"),),
        vary={"strut_radius": (0.7, 0.9)},
        fixed={
            "cell": "BCC", "cell_size": 7.3, "shell": 1.0, "resolution": 8, "remove_dangling": True,
            "open_plane": ((0.0, 0.0, 16.0, 0.0, 0.0, 1.0),), "rotate": (0.0, 0.0, 1.0, 15.0),
        },
        do=("forecast",),
        front=Front({"forecast.mass_g": "least"}, ("export",), 1),
        material="PA12",
    )  # fmt: skip
    made = volfrep.sweep(study, "runs", workers=1)
    (key,) = made.front
    text = (tmp_path / "runs" / "index.html").read_text()
    command = text.split(f'id="{key}"')[1].split("<pre>")[1].split("</pre>")[0]
    words = shlex.split(command.replace("&#x27;", "'"))
    assert words[:2] == ["volfrep", "fill"]
    assert run(*words[1:]) == 0
    files = tmp_path / f"{key}.stl", tmp_path / "runs" / "files" / f"{key}.stl"
    # The command writes octants as they are laid: the same triangles in another order.
    assert triangles_of(files[0]) == triangles_of(files[1])


@pytest.mark.costly
def test_a_run_that_fails_keeps_its_sentence_and_ends_nothing(tmp_path: Path) -> None:
    study = Study(
        parts=(BOX,),
        vary={"shell": (1.0, 8.5)},  # the second leaves nothing to fill
        fixed={"cell": "BCC", "cell_size": 8.0},
        do=("forecast", "fill"),
    )
    made = volfrep.sweep(study, tmp_path, workers=1)
    assert (made.count("done"), made.count("failed")) == (1, 1)
    (said,) = (text for text in made.table.column("error") if text)
    assert "nowhere thicker than two skins of 8.5 mm" in said
    assert volfrep.sweep(study, tmp_path, workers=1).runs == 0
    assert volfrep.sweep(study, tmp_path, workers=1, retry_failed=True).runs == 1


def test_behind_every_action_is_a_function() -> None:
    assert list(evaluator.FIGURES) == list(ACTIONS)


@pytest.mark.costly
def test_a_defect_of_the_engine_is_told_and_ends_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: evaluator.Evaluator) -> dict:
        raise KeyError("no such thing")

    monkeypatch.setitem(evaluator.FIGURES, "forecast", broken)
    made = volfrep.sweep(QUICK, tmp_path, workers=1)
    assert made.count("failed") == 6
    assert "defect of VOLFREP" in made.table.column("error")[0]
    record = json.loads(next((tmp_path / "records").iterdir()).read_text())
    assert "no such thing" in record["notes"]["forecast"][0]
    assert made.front == {}


@pytest.mark.slow
def test_shards_together_are_the_whole_study(whole: Swept, tmp_path: Path) -> None:
    first = volfrep.sweep(QUICK, tmp_path / "parts", shard=(1, 2))
    assert (first.count("done"), first.count("open"), first.front) == (3, 3, {})
    second = volfrep.sweep(QUICK, tmp_path / "parts", shard=(2, 2))
    assert second.front == whole.front
    assert timeless(tmp_path / "parts") == timeless(whole.page.parent)
    with pytest.raises(VolfrepError, match="1/4 or 4/4, not 3/2"):
        volfrep.sweep(QUICK, tmp_path, shard=(3, 2))


@pytest.mark.slow
def test_any_executor_does_the_runs(whole: Swept, tmp_path: Path) -> None:
    with ThreadPoolExecutor(2) as pool:
        made = volfrep.sweep(QUICK, tmp_path / "pool", executor=pool)
    assert made.runs == 6
    assert timeless(tmp_path / "pool") == timeless(whole.page.parent)
    with pytest.raises(VolfrepError, match="one of workers, executor and scheduler"):
        volfrep.sweep(QUICK, tmp_path, executor=pool, workers=2)
    with pytest.raises(VolfrepError, match="takes no more runs"):
        volfrep.sweep(QUICK, tmp_path / "shut", executor=pool)


@pytest.mark.costly
def test_a_cancelled_study_goes_on_where_it_stopped(tmp_path: Path) -> None:
    told = []

    def stop_half_way(fraction: float, stage: str) -> bool:
        told.append((fraction, stage))
        return fraction < 0.5

    with pytest.raises(Cancelled):
        volfrep.sweep(QUICK, tmp_path, workers=1, progress=stop_half_way)
    done = len(list((tmp_path / "records").iterdir()))
    assert 3 <= done < 6
    assert "of 6 runs, about" in told[-1][1]
    assert volfrep.sweep(QUICK, tmp_path, workers=1).runs == 6 - done


@pytest.mark.costly
def test_an_optimiser_gets_figures_by_name_and_sentences_for_what_makes_no_sense(
    tmp_path: Path,
) -> None:
    study = Study(parts=(BOX,), fixed={"cell_size": 8.0, "shell": 1.0}, do=("forecast",))
    asked = [{"strut_radius": 0.5}, {"strut_radius": -1.0}, {"strut_radius": 0.8}]
    thin, none, thick = volfrep.evaluate(study, asked, tmp_path)
    assert thin["forecast.mass_g"] < thick["forecast.mass_g"]
    assert thin["error"] is None
    assert "strut radius" in none["error"]
    assert volfrep.evaluate(study, asked[:1], tmp_path) == [thin]
    assert len(list((tmp_path / "records").iterdir())) == 2


@pytest.mark.slow
def test_a_grid_may_take_several_parts(tmp_path: Path) -> None:
    ball = check_solid(samples.sphere(12.0), "ball")
    study = Study(parts=(BOX, ball), fixed={"cell": "CVC", "cell_size": 8.0}, do=("forecast",))
    made = volfrep.sweep(study, tmp_path)
    assert len(made.table.rows) == 2
    with pytest.raises(VolfrepError, match="one part, not at 2"):
        volfrep.evaluate(study, [{}], tmp_path)


@pytest.mark.costly
def test_an_objective_that_is_no_column_is_told(tmp_path: Path) -> None:
    import dataclasses

    study = dataclasses.replace(QUICK, front=Front({"forecast.weight": "least"}))
    with pytest.raises(VolfrepError, match=r"no column 'forecast\.weight'.*forecast\.mass_g"):
        volfrep.sweep(study, tmp_path)


@pytest.mark.costly
def test_the_command_does_a_study(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trimesh.creation.box((24, 16, 16)).export(tmp_path / "box.stl")
    (tmp_path / "study.toml").write_text(
        'part = "box.stl"\ndo = ["forecast"]\n[vary]\ncell_size = [6, 8, 99]\n'
        '[front]\nobjectives = { forecast.mass_g = "least" }\n'
    )
    assert run("sweep", tmp_path / "study.toml", "-o", tmp_path / "runs", "--dry-run") == 0
    said = capsys.readouterr()
    assert "designs              2" in said.out
    assert "1 passed over: Cells of 99 mm are larger than 'box.stl'" in said.err
    assert not (tmp_path / "runs").exists()
    assert run("sweep", tmp_path / "study.toml", "-o", tmp_path / "runs", "--shard", "1/1") == 0
    assert "chosen     1, 1 of them on the Pareto front" in capsys.readouterr().out
    assert run("sweep", tmp_path / "none.toml", "-o", tmp_path / "runs") == 2
    assert run("sweep", tmp_path / "study.toml", "-o", tmp_path / "box.stl") == 2
    assert run("sweep", tmp_path / "study.toml", "-o", tmp_path, "--shard", "a") == 2
    errors = capsys.readouterr().err.splitlines()
    assert [line for line in errors if not line.startswith("volfrep: ")] == []


@pytest.mark.slow
def test_the_table_reads_as_parquet_where_pandas_is_there(whole: Swept) -> None:
    pandas = pytest.importorskip("pandas", reason="needs the optional package pandas")
    pytest.importorskip("fastparquet", reason="needs the optional package fastparquet")
    frame = pandas.read_parquet(whole.page.with_name("runs.parquet"))
    assert list(frame.columns) == list(whole.table.columns)
    assert np.array_equal(frame["forecast.mass_g"], whole.table.numbers("forecast.mass_g"))


@pytest.mark.slow
def test_a_range_is_bounds_for_an_optimiser(tmp_path: Path) -> None:
    from scipy.optimize import differential_evolution

    study = Study(
        parts=(BOX,),
        vary={"strut_radius": Range(0.4, 1.2)},
        sampling="latin-hypercube",
        samples=3,
        fixed={"cell": "BCC", "cell_size": 8.0, "shell": 1.0},
        do=("forecast",),
    )
    bounds = [(way.low, way.high) for way in study.vary.values() if isinstance(way, Range)]

    def off(radii: np.ndarray) -> np.ndarray:
        rows = [{"strut_radius": float(f"{radius:.4g}")} for radius in radii[0]]
        figures = volfrep.evaluate(study, rows, tmp_path)
        return np.array([abs(row["forecast.mass_g"] - 3.0) for row in figures])

    best = differential_evolution(
        off,
        bounds,
        vectorized=True,
        updating="deferred",
        maxiter=5,
        tol=0.0,
        popsize=5,
        seed=1,
        polish=False,
    )
    assert best.fun < 0.1
