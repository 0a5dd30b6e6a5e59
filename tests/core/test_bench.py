# SPDX-License-Identifier: LGPL-2.1-or-later
"""The harness of the benchmark: tables, fits, failures kept, the published method as a peer."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from volfrep.design.cells import LIBRARY

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.append(str(ROOT))

from bench import __main__ as bench  # noqa: E402
from bench import measuring, plots, published, published_method  # noqa: E402
from bench.document import document  # noqa: E402
from bench.exact import block_volume  # noqa: E402
from bench.experiments import EXPERIMENTS  # noqa: E402
from bench.experiments.shares import expected_seconds  # noqa: E402
from bench.readme import figures_table, write_into  # noqa: E402
from bench.tables import Column, bar, bars_told, power_law, table  # noqa: E402

pytestmark = pytest.mark.skipif(
    not hasattr(os, "wait4"), reason="the benchmark runs on POSIX systems only"
)


def test_a_table_shows_figures_and_leaves_empty_columns_out():
    columns = (Column("cell", "cell"), Column("s", "seconds", ".2f"), Column("genus", "genus"))
    rows = [{"cell": "CVC", "seconds": 1.234}, {"cell": "a|b", "note": "ended after 40 s"}]
    assert table(columns, rows).splitlines() == [
        "| cell | s |  |",
        "| --- | --- | --- |",
        "| CVC | 1.23 |  |",
        "| a/b |  | ended after 40 s |",
    ]


def test_a_column_that_says_the_same_in_all_rows_is_told_once():
    columns = (Column("cell", "cell"), Column("s", "seconds", ".0f"), Column("bodies", "bodies"))
    rows = [
        {"cell": cell, "seconds": k, "bodies": 1} for k, cell in enumerate(("BCC", "CVC", "FCC"))
    ]
    told = table(columns, rows).splitlines()
    assert told[0] == "| cell | s |"
    assert told[-2:] == ["", "In all rows bodies: 1."]
    rows[1]["bodies"] = 2
    assert table(columns, rows).splitlines()[0] == "| cell | s | bodies |"


def test_bars_that_are_alike_share_a_line_with_what_was_measured():
    rows = [bar("block, fast", 0.9, 1.0, "s"), bar("block, slow", 1.1, 1.0, "s"),
            bar("block, gone", None, 1.0, "s"), bar("large", 70, 64, "MB", ".0f")]  # fmt: skip
    assert bars_told(rows).splitlines() == [
        "- block, bar of 1 s: fast 0.90 s (met); slow 1.10 s; gone (not measured)",
        "- large, bar of 64 MB: 70 MB",
    ]


def test_the_exponent_of_a_power_law():
    x = [1e3, 8e3, 27e3, 125e3]
    law = power_law(x, [2e-3 * value**1.07 for value in x])
    assert law.exponent == pytest.approx(1.07)
    assert law.factor == pytest.approx(2e-3)
    assert law.r2 == pytest.approx(1.0)
    assert law.inverse(2e-3 * 5e4**1.07) == pytest.approx(5e4)
    assert power_law([1, 2, 4], [1, 3, 2]).r2 < 0.8
    with pytest.raises(ValueError, match="two different points"):
        power_law([5, 5], [1, 2])


def test_what_one_thread_does_alone_bounds_what_cores_gain():
    assert expected_seconds(12.0, 100.0, 1) == pytest.approx(100.0)
    assert expected_seconds(12.0, 100.0, 8) == pytest.approx(12.0 + 88.0 / 8)
    assert expected_seconds(12.0, 100.0, 10**9) == pytest.approx(12.0)


@pytest.mark.slow_but("Box")
@pytest.mark.parametrize("cell", ["Box", "CVC"])
def test_one_cell_of_the_published_method_is_the_cell(cell):
    unit, size, radius = LIBRARY[cell], published.SIZE, published.RADIUS
    vertices, triangles = published_method.mesh_cell(
        unit.nodes * size, unit.struts, size, radius, 60
    )
    a, b, c = vertices[triangles].swapaxes(0, 1)
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    expected = block_volume(unit, 1, size, radius, samples=32)
    assert volume == pytest.approx(expected, rel=0.02)


def test_the_published_method_stacks_overlapping_copies():
    unit, size = LIBRARY["Box"], published.SIZE
    vertices, triangles = published_method.mesh_cell(
        unit.nodes * size, unit.struts, size, published.RADIUS, 30
    )
    active = np.array([[[True, False]], [[True, True]]])
    stacked, faces = published_method.replicate(vertices, triangles, active, size, np.zeros(3))
    assert len(stacked) == 3 * len(vertices)
    assert faces.shape == (3 * len(triangles), 3)
    assert faces.max() == len(stacked) - 1
    reach = published_method.sphere_radius(size, published.RADIUS)
    assert stacked.max() == pytest.approx(2 * size + reach, abs=0.05)
    bad = np.vstack([faces[:2], [[0, 1, 1]]])
    assert len(published_method.valid(bad)) == 2


@pytest.mark.slow
def test_a_job_of_ours_is_timed_looked_at_and_removed(tmp_path):
    context = measuring.Context(
        quick=True, folder=tmp_path, seconds_for_peers=10, most_triangles=10**6
    )
    row = measuring.our_block(context, "CVC", 1)
    assert row["one_solid"]
    assert abs(row["volume_error"]) < 5e-3
    assert row["rms"] < 0.03
    assert row["cpu"] > 0
    assert row["triangles"] * 50 + 84 == round(row["mb"] * 1e6)
    assert not list(tmp_path.iterdir())
    failed = measuring.our_block(context, "CVC", 0)
    assert failed["failed"]
    assert "from 1 to" in failed["note"]


def test_a_process_is_ended_at_its_limit():
    done = measuring.run([sys.executable, "-c", "import time; time.sleep(60)"], limit=0.2)
    assert done.timed_out
    assert done.failure is not None
    assert "the time limit" in done.failure
    assert done.seconds < 60


def test_other_tools_are_left_out_when_their_time_is_spent(tmp_path, monkeypatch):
    monkeypatch.setattr(measuring, "BENCH_PYTHON", Path(sys.executable))
    context = measuring.Context(True, tmp_path, 10, 10**6, peers_until=0.0)
    row = measuring.peer_job(context, "a tool", ["false"], tmp_path / "x.stl", cell="Box")
    assert row["note"] == "left out: the time for other tools was spent"
    assert row["cell"] == "Box"


class Broken:
    """An experiment that cannot be done."""

    @staticmethod
    def measure(context):
        raise RuntimeError("no such part")


class Works:
    """One that can, of which a job of ours failed."""

    @staticmethod
    def measure(context):
        return {"rows": [{"failed": True, "note": "exit code 2"}], "bars": [bar("x", 1, 2, "s")]}

    @staticmethod
    def render(result, images):
        return "## It works"


def test_an_experiment_that_fails_stays_alone(tmp_path, monkeypatch, capsys):
    experiments = {"broken": Broken, "works": Works}
    monkeypatch.setattr(bench, "EXPERIMENTS", experiments)
    bench.measure(["broken", "works"], quick=True, results=tmp_path, peer_minutes=1.0)
    assert "no such part" in capsys.readouterr().err
    results = {name: json.loads((tmp_path / f"{name}.json").read_text()) for name in experiments}
    assert bench.failures(results["broken"]) == ["RuntimeError: no such part"]
    assert bench.failures(results["works"]) == ["exit code 2"]
    text, broken = document(results, experiments, tmp_path)
    assert "This experiment failed: RuntimeError: no such part" in text
    assert "## It works" in text
    assert "Bars: 1 of 1 met" in text
    assert not broken
    assert "Not measured in this run" in document({}, experiments, tmp_path)[0]


def test_every_experiment_measures_and_renders():
    for module in EXPERIMENTS.values():
        assert callable(module.measure)
        assert callable(module.render)


def test_plots_are_small_files(tmp_path):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed (FreeCAD brings it)")
    line = plots.Line("ours", [1, 10, 100], [1, 12, 110])
    said = plots.lines(tmp_path / "a" / "plot.png", "cells", "seconds", [line], title="growth")
    assert said == "![growth](images/benchmarks/plot.png)"
    assert 1000 < (tmp_path / "a" / "plot.png").stat().st_size < 60_000
    plots.stacks(tmp_path / "bars.png", "s", ["CVC", "Box"], [{"a": 1.0}, {"a": 2.0, "b": 1.0}])
    assert (tmp_path / "bars.png").stat().st_size > 1000


def test_the_command_names_its_experiments():
    done = subprocess.run(
        [sys.executable, "-m", "bench", "--only", "everything"],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "accuracy" in done.stderr


@pytest.mark.parametrize("quick", [True, False])
def test_when_every_job_fails_every_chapter_says_so(quick, tmp_path, monkeypatch):
    def fail(arguments, **options):
        return measuring.Run(0.1, 0.1, 2, "volfrep: no such luck", False)

    def fail_often(arguments, times, out=None):
        return fail(arguments), [0.1] * times

    for module in (measuring, *EXPERIMENTS.values()):
        for name, stand_in in (("run", fail), ("run_often", fail_often)):
            if hasattr(module, name):
                monkeypatch.setattr(module, name, stand_in)
    monkeypatch.setattr(measuring, "BENCH_PYTHON", Path(sys.executable))
    monkeypatch.setattr(plots, "lines", lambda *_, **__: "a plot")
    monkeypatch.setattr(plots, "stacks", lambda *_, **__: "a plot")
    monkeypatch.setattr(bench, "machine", lambda: dict(MACHINE))
    bench.measure(list(EXPERIMENTS), quick=quick, results=tmp_path, peer_minutes=1.0)
    results = {name: json.loads((tmp_path / f"{name}.json").read_text()) for name in EXPERIMENTS}
    for name in EXPERIMENTS:
        assert name == "wing" or bench.failures(results[name]), name
    text, broken = document(results, EXPERIMENTS, tmp_path)
    assert not broken
    assert text.count("no such luck") >= len(EXPERIMENTS) - 2
    assert "not measured" in text


MACHINE = {
    "processor": "a", "cores": 2, "memory_gb": 4, "system": "b", "python": "3", "packages": {},
    "peer_packages": {}, "commit": "c", "date": "2026-01-01 00:00", "load": 0.0,
}  # fmt: skip


def test_a_machine_without_git_has_no_commit(monkeypatch):
    monkeypatch.setenv("PATH", "")
    assert measuring.machine()["commit"] == "not in a repository"


def test_the_readme_gets_its_table_between_its_marks(tmp_path):
    row = {"cell": "CVC", "kind": "ours", "seconds": 1.12, "volume_error": -5e-4}
    big = {"setting": "default, L / 15", "cells": 26**3, "seconds": 4.42, "triangles": 33_400_000,
           "peak_mb": 61.0}  # fmt: skip
    made = figures_table({
        "blocks": {"rows": [row, {**row, "kind": "fine", "seconds": 9.0}]},
        "bracket": {"rows": [{"cell": "CVC", "seconds": 5.78, "change": 2.64}]},
        "rod": {"rows": [{"cell": "CVC", "job": "piston rod", "note": "exit code 2"}]},
        "scale": {"rows": [big]},
    })  # fmt: skip
    assert made.splitlines()[2:] == [
        "| 10 x 10 x 10 cells, L = 10, r = 1 |  |  | 1.1 s (12 s) |",
        "| their volume, against the exact one |  |  | -0.05 % |",
        "| GE bracket, skin 3 mm, skin and lattice in one body |  |  | 5.8 s (248 s) |",
        "| the same when only r changes |  |  | 2.6 s |",
        "| piston rod, skin 1 mm, L = 2, cells graded along it |  |  |  |",
        "| 26 x 26 x 26 cells, 33 million triangles, 0.1 GB of memory |  |  | 4.4 s (1 h) |",
    ]
    readme = tmp_path / "README.md"
    readme.write_text((ROOT / "README.md").read_text(encoding="utf-8"), encoding="utf-8")
    before = readme.read_text(encoding="utf-8").splitlines()
    write_into(readme, made)
    after = readme.read_text(encoding="utf-8").splitlines()
    assert set(made.splitlines()) <= set(after)
    assert [line for line in before if line[:1] != "|"] == [
        line for line in after if line[:1] != "|"
    ]
    readme.write_text("# No table", encoding="utf-8")
    with pytest.raises(ValueError, match="has no"):
        write_into(readme, made)
