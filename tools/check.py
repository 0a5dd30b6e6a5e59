# SPDX-License-Identifier: LGPL-2.1-or-later
"""Style, types, and the tests that are nearest to what changed, in about a minute.

    make check                  # against the branch's upstream, or main, with what is not committed
    make check BASE=HEAD~3      # against another state
    make check SECONDS=300      # more of them

Which tests: those that import a changed module, then those that import a module which does, and so
on, the nearest first, until the seconds are over; of as near ones the cheapest first. Imports are
read from the sources, wherever in them they stand; names taken from the package `volfrep` count as
imports of the modules that they live in. A changed file that is no module counts for the tests
that name it. The rules of the house (layers, documents, translations) are always among them. Where
the workbench changed and FreeCAD is installed, its tests are chosen and run likewise, beside these.

What was not run is told, and is much: FreeCAD's windows, slow tests, and those there was no time
for. `make test` runs them.
"""

from __future__ import annotations

import argparse
import ast
import functools
import json
import os
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
CORE = ROOT / "tests" / "core"
IN_FREECAD = ROOT / "tests" / "freecad"
ALWAYS = ("test_layers.py", "test_workbench_layers.py", "test_docs.py", "test_translations.py")
#: Seconds that files of tests took when they last ran here, and those of one that never did.
TIMES = ROOT / ".cache" / "check_times.json"
UNKNOWN = 5.0
_UNTIL = "VOLFREP_CHECK_UNTIL"


def changed(base: str) -> list[str]:
    """Files that differ from a state, or are new, by their paths below the root.

    Raises:
        SystemExit: git knows no such state.
    """
    if not base:
        for name in ("@{upstream}", "origin/main", "main"):
            found = _git("merge-base", "HEAD", name)
            if found.returncode == 0:
                base = found.stdout.strip()
                break
    differing = _git("diff", "--name-only", base or "HEAD")
    if differing.returncode:
        raise SystemExit(f"check: git knows no '{base}': give BASE=... another name.")
    beside = _git("ls-files", "--others", "--exclude-standard")
    return sorted({*differing.stdout.split("\n"), *beside.stdout.split("\n")} - {""})


def _git(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)


def module_names() -> dict[str, Path]:
    """Modules of engine, workbench, benchmark and tests by the names they are imported by.

    Those of the tests in FreeCAD begin with `freecad:`: some are called as others of the engine's.
    """
    found = {}
    for folder, start, prefix in (
        ("core", "core/volfrep", ""),
        ("", "freecad_volfrep", ""),
        ("", "bench", ""),
        ("tests/core", "tests/core", ""),
        ("tests/freecad", "tests/freecad", "freecad:"),
    ):
        for path in sorted((ROOT / start).rglob("*.py")):
            parts = path.relative_to(ROOT / folder).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            found[prefix + name] = path
    return found


def imports(name: str, path: Path, known: dict[str, Path], homes: dict[str, str]) -> Iterator[str]:
    """Modules that a module imports, and those that names of the package live in."""
    package = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    beside = "freecad:" if name.startswith("freecad:") else ""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield beside + alias.name if beside + alias.name in known else alias.name
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            home = ".".join(filter(None, [*base, node.module or ""]))
            for alias in node.names:
                inner = f"{home}.{alias.name}"
                yield inner if inner in known else home
                if beside:
                    yield beside + home
                if home == "volfrep" and alias.name in homes:
                    yield f"volfrep.{homes[alias.name].partition(':')[0]}"
        elif (
            isinstance(node, ast.Attribute)
            and node.attr in homes
            and isinstance(node.value, ast.Name)
            and node.value.id == "volfrep"
        ):
            yield f"volfrep.{homes[node.attr].partition(':')[0]}"


@functools.cache
def graph() -> tuple[dict[str, Path], dict[str, set[str]]]:
    """The modules, and who imports each."""
    known = module_names()
    sys.path.insert(0, str(ROOT / "core"))
    from volfrep import _HOMES

    importers: dict[str, set[str]] = {name: set() for name in known}
    for name, path in known.items():
        # The packages themselves load their names when they are first used: they pass nothing on.
        for target in set(imports(name, path, known, _HOMES)) & importers.keys():
            if name not in ("volfrep", "freecad_volfrep"):
                importers[target].add(name)
    return known, importers


def distances(files: list[str]) -> dict[Path, int]:
    """Test files by how many imports lie between them and what changed; 0 for a changed one."""
    known, importers = graph()
    names = {str(path.relative_to(ROOT)): name for name, path in known.items()}
    reached = {names[file]: 0 for file in files if file in names}
    others = [Path(file).name for file in files if file not in names]
    tests = [p for p in known.values() if p.name.startswith("test_") and "tests" in p.parts]
    found = {CORE / name: 1 for name in ALWAYS}
    for path in tests:
        text = path.read_text(encoding="utf-8")
        if any(other in text for other in others):
            found[path] = 1
    layer = list(reached)
    while layer:
        step = []
        for name in layer:
            for importer in importers[name] - reached.keys():
                reached[importer] = reached[name] + 1
                step.append(importer)
        layer = step
    for name, distance in reached.items():
        if known[name] in tests:
            found[known[name]] = min(distance, found.get(known[name], distance))
    return found


def pytest_runtest_setup(item: pytest.Item) -> None:
    """No case begins after the end, but for the rules of the house.

    This module is a plugin of the runs that it starts.
    """
    if time.time() > float(os.environ[_UNTIL]) and item.path.name not in ALWAYS:
        pytest.skip("no time left")


def pytest_configure(config: pytest.Config) -> None:
    """Files' seconds are kept for the next choice, by the process that collects all reports."""
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(_Times(), "check-times")


class _Times:
    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self.cut: set[str] = set()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        file = report.nodeid.partition("::")[0]
        self.seconds[file] = self.seconds.get(file, 0.0) + report.duration
        if report.skipped and "no time left" in str(report.longrepr):
            self.cut.add(file)

    def pytest_sessionfinish(self) -> None:
        kept = json.loads(TIMES.read_text()) if TIMES.is_file() else {}
        for file, seconds in self.seconds.items():
            # One that was cut off takes at least as long.
            kept[file] = max(seconds, kept.get(file, UNKNOWN)) if file in self.cut else seconds
        TIMES.parent.mkdir(exist_ok=True)
        TIMES.write_text(json.dumps(kept, indent=1, sort_keys=True) + "\n")


def main() -> int:
    """Check; 0 where nothing is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--base", default="", help="compare with this state")
    parser.add_argument("--seconds", type=float, default=50.0, help="for all of it")
    options = parser.parse_args()
    end = time.time() + options.seconds
    files = changed(options.base)
    print(f"check: {len(files)} changed files")
    python = sys.executable
    failed = []
    ruff, mypy = (str(Path(python).with_name(name)) for name in ("ruff", "mypy"))
    side = [
        ("style", [ruff, "check", "--quiet", "."]),
        ("format", [ruff, "format", "--check", "--quiet", "."]),
        ("types", [mypy, "--no-error-summary"]),
    ]  # fmt: skip
    running = [(name, subprocess.Popen(command, cwd=ROOT)) for name, command in side]
    near = distances(files)
    times = json.loads(TIMES.read_text()) if TIMES.is_file() else {}
    cost = {path: times.get(str(path.relative_to(ROOT)), UNKNOWN) for path in near}
    lanes = min(2, os.cpu_count() or 1)
    inside = []
    if any(f.startswith(("freecad_volfrep/", "tests/freecad/")) for f in files):
        command = shutil.which("freecadcmd")
        inside = choose(near, cost, IN_FREECAD, options.seconds * 0.5 if command else 0.0)
    lanes = max(1, lanes - bool(inside))
    chosen = choose(near, cost, CORE, options.seconds * 0.7 * lanes)
    failed += [name for name, process in running if process.wait()]
    # Types take longer than all the rest where nothing is known of them yet, as in a new clone.
    end = max(end, time.time() + options.seconds / 2)
    environment = {**os.environ, _UNTIL: str(end), "PYTHONPATH": str(ROOT / "tools")}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    usual = ["-p", "check", "-q", "-m", "not slow"]
    words = [str(path.relative_to(ROOT)) for path in chosen]
    runs = [("tests", subprocess.Popen(
        [python, "-m", "pytest", *usual, "-n", str(lanes), "--dist", "loadfile", *words],
        cwd=ROOT, env=environment,
    ))]  # fmt: skip
    if inside:
        words = [*usual, *(str(path.relative_to(ROOT)) for path in inside)]
        runs.append(("tests in FreeCAD", subprocess.Popen(
            [str(command), "tools/run_in_freecad.py"], stdin=subprocess.DEVNULL, cwd=ROOT,
            env={**environment, "PYTEST_ARGS": shlex.join(words)},
        )))  # fmt: skip
    failed += [name for name, process in runs if process.wait()]
    tell_the_rest(files, near, [*chosen, *inside])
    print(f"check: {', '.join(failed)} failed" if failed else "check: what was run holds")
    return 1 if failed else 0


def choose(
    near: dict[Path, int], cost: dict[Path, float], folder: Path, seconds: float
) -> list[Path]:
    """Test files of a folder, the nearest first, that take so long together."""
    chosen = []
    of_folder = [path for path in near if path.is_relative_to(folder)]
    for path in sorted(of_folder, key=lambda path: (near[path], cost[path])):
        # What was changed itself is run whatever it takes, until the end.
        if cost[path] <= seconds or (near[path] == 0 and seconds):
            chosen.append(path)
            seconds -= cost[path]
    return chosen


def tell_the_rest(files: list[str], near: dict[Path, int], chosen: list[Path]) -> None:
    """Say what was not run."""
    left_out = sorted((near[path], path) for path in near if path not in chosen)
    for folder, whose in ((CORE, "engine's"), (IN_FREECAD, "workbench's")):
        every = list(folder.rglob("test_*.py"))
        run, reach = (len(set(every) & set(paths)) for paths in (chosen, near))
        print(
            f"check: {run} of {len(every)} files of the {whose} tests were run; of the others "
            f"{reach - run} reach what changed by way of imports, {len(every) - reach} do not"
        )
    for distance, path in left_out[:5]:
        print(f"check:   not run, {distance} imports away: {path.relative_to(ROOT)}")
    print("check:   not run: tests/gui (make test-gui)")
    known = {str(path.relative_to(ROOT)) for path in module_names().values()}
    other = [f for f in files if f not in known and not f.startswith(("docs/", "tests/"))]
    if other:
        print(f"check:   changed, and imported by no test: {', '.join(other[:8])}")


if __name__ == "__main__":
    sys.exit(main())
