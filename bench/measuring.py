# SPDX-License-Identifier: LGPL-2.1-or-later
"""Running processes against the clock, and looking at the files they leave."""

from __future__ import annotations

import json
import math
import os
import platform
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from volfrep.design.cells import LIBRARY
from volfrep.grid.strut_graph import cell_graph
from volfrep.io.solid import read_triangles
from volfrep.io.write.stl import FACET, HEADER_BYTES, as_read
from volfrep.mesh.quality import measure, shape_statistics
from volfrep.mesh.topology import pinched_vertices
from volfrep.mesh.triangle_mesh import TriangleMesh

from . import exact
from .parts import PARTS, at_hand
from .published import RADIUS, SIZE
from .tables import Row

ROOT = Path(__file__).resolve().parent.parent
#: The environment of the other tools; `make bench` makes it.
BENCH_PYTHON = ROOT / ".cache" / "bench" / "bin" / "python"
#: A program that tools/bench_tools.sh compiles where OpenVDB is.
OPENVDB = ROOT / ".cache" / "bench-openvdb" / "openvdb_part"

#: A process that takes longer is ended, and its row says so.
LIMIT = 600.0
SURFACE_SAMPLES = 40_000


@dataclass(frozen=True)
class Context:
    """What an experiment is given.

    Attributes:
        quick: small sizes and few peers.
        folder: for files, emptied afterwards.
        seconds_for_peers: the time limit of one job of another tool.
        most_triangles: of a file that is read back.
        peers_until: of `time.monotonic`; other tools are left out from then on.
    """

    quick: bool
    folder: Path
    seconds_for_peers: float
    most_triangles: int
    peers_until: float = math.inf

    def say(self, row: Row) -> Row:
        """Print a row as it comes in."""
        values = {
            key: round(value, 3) if isinstance(value, float) else value
            for key, value in row.items()
            if not isinstance(value, (list, dict))
        }
        print("   ", "  ".join(f"{key} {value}" for key, value in values.items()), flush=True)
        return row


@dataclass(frozen=True)
class Run:
    """A finished process.

    Attributes:
        seconds: on the clock, from its start to its end.
        cpu: seconds of all the cores together.
        code: exit code.
        said: standard output, then standard error.
        timed_out: whether it was ended at its time limit.
    """

    seconds: float
    cpu: float
    code: int
    said: str
    timed_out: bool

    @property
    def failure(self) -> str | None:
        """Why there is no result, as a note; None where there is one."""
        if self.timed_out:
            return f"ended after {self.seconds:.0f} s, the time limit"
        if not self.code:
            return None
        lines = self.said.splitlines()
        return lines[-1][:300] if lines else f"exit code {self.code}"


def run(
    arguments: Sequence[str], *, limit: float = LIMIT, env: Mapping[str, str] | None = None
) -> Run:
    """Run a process from the checkout's root and wait for it, at most `limit` seconds.

    Python keeps its compiled modules, as it does of an installed package, even where whoever runs
    the benchmark has forbidden that: every tool would compile its own at every start. What earlier
    jobs have left to be written goes to the disk first, for it is not this one's.
    """
    os.sync()
    inherited = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    ended = threading.Event()
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        start = time.perf_counter()
        process = subprocess.Popen(
            arguments, stdin=subprocess.DEVNULL, stdout=output, stderr=errors, cwd=ROOT,
            env={**inherited, **(env or {})}, start_new_session=True,
        )  # fmt: skip

        def end() -> None:
            ended.set()
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(limit, end)
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
        finally:
            timer.cancel()
        seconds = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        said = ""
        for stream in (output, errors):
            stream.seek(0)
            said += stream.read()
    cpu = usage.ru_utime + usage.ru_stime
    return Run(seconds, cpu, process.returncode, said.strip(), ended.is_set())


def run_often(
    arguments: Sequence[str], times: int, out: Path | None = None
) -> tuple[Run, list[float]]:
    """Run a process some times: the run of median time, and all the times, sorted.

    `out` is the file it writes: a new one every time.
    """
    runs = []
    for _ in range(times):
        if out is not None:
            out.unlink(missing_ok=True)
        runs.append(run(arguments))
    runs.sort(key=lambda done: done.seconds)
    failed = [done for done in runs if done.failure]
    return (failed or [runs[(len(runs) - 1) // 2]])[0], [done.seconds for done in runs]


def volfrep(*arguments: str) -> list[str]:
    """The command line of a ``volfrep`` process."""
    return [sys.executable, "-m", "volfrep", *arguments]


def bench_job(*arguments: str) -> list[str]:
    """The command line of a job of `bench.in_process`."""
    return [sys.executable, "-m", "bench.in_process", *arguments]


def lattice_options(size: float = SIZE, radius: float = RADIUS) -> list[str]:
    """L and r as options."""
    return ["--cell-size", f"{size:g}", "--strut-radius", f"{radius:g}"]


def answer(done: Run) -> dict[str, Any]:
    """The JSON that a job printed on a line of its own, whatever its packages say besides.

    Raises:
        ValueError: there is none.
    """
    for line in done.said.splitlines():
        if line.startswith("{"):
            found: dict[str, Any] = json.loads(line)
            return found
    raise ValueError(f"a job printed no figures, but: {done.said[:300]}")


def our_block(
    context: Context, cell: str, count: int, *options: str, times: int = 1, look: bool = True
) -> Row:
    """A block of ours as STL: figures of the run, and of the file where it is looked at.

    The file is removed. The row is marked `failed` where there is none.
    """
    out, report = context.folder / "block.stl", context.folder / "report.json"
    command = volfrep(
        "block", "-o", str(out), "--cell", cell, "--count", ",".join([str(count)] * 3),
        *lattice_options(), *options, "--quiet", "--report", str(report),
    )  # fmt: skip
    done, all_seconds = run_often(command, times, out)
    row: Row = {"tool": "this engine", "cell": cell, "cells": count**3}
    if done.failure:
        return {**row, "note": done.failure, "failed": True}
    row |= figures(done, out) | _reported(report)
    row |= {"fastest": all_seconds[0], "slowest": all_seconds[-1]} if times > 1 else {}
    if look:
        row |= look_at_block(context, out, cell, count)
    out.unlink()
    return row


def our_part(context: Context, part: Path, cell: str, *options: str, look: bool = True) -> Row:
    """A part of ours as STL, from the start of the process to the file; as `our_block`."""
    out, report = context.folder / "part.stl", context.folder / "report.json"
    row: Row = {"tool": "this engine", "cell": cell}
    command = volfrep("fill", str(part), "-o", str(out), "--cell", cell, *options)
    done = run([*command, "--quiet", "--report", str(report)])
    if done.failure:
        return {**row, "note": done.failure, "failed": True}
    row |= figures(done, out) | _reported(report)
    if look:
        row |= look_at(context, out)
    out.unlink()
    return row


def peer_job(context: Context, tool: str, command: Sequence[str], out: Path, **given: Any) -> Row:
    """A job of another tool: it writes `out` and prints its figures as one line of JSON."""
    row: Row = {"tool": tool, **given}
    if not BENCH_PYTHON.exists():
        return {**row, "note": "left out: `make bench` has not made .cache/bench"}
    if time_is_spent(context):
        return {**row, "note": "left out: the time for other tools was spent"}
    done = run(command, limit=context.seconds_for_peers, env={"PYTHONPATH": str(ROOT / "core")})
    if done.failure:
        out.unlink(missing_ok=True)
        return {**row, "note": done.failure}
    return {**row, **figures(done, out), **answer(done)}


def time_is_spent(context: Context) -> bool:
    """Whether other tools are to be left out from now on."""
    return time.monotonic() > context.peers_until


def figures(done: Run, out: Path) -> Row:
    """What a run took, and the size of the STL file that it wrote."""
    return {
        "seconds": done.seconds,
        "cpu": done.cpu,
        "mb": out.stat().st_size / 1e6,
        "triangles": triangles_in(out),
    }


def _reported(report: Path) -> Row:
    told = json.loads(report.read_text(encoding="utf-8"))
    report.unlink()
    names = ("cells_active", "cells_total", "grid", "stages", "watertight", "bodies", "genus")
    return {"peak_mb": told["peak_memory_mb"], **{name: told[name] for name in names}}


def triangles_in(path: Path) -> int:
    """Triangles of a binary STL file."""
    return (path.stat().st_size - HEADER_BYTES - 4) // FACET.itemsize


def look_at(context: Context, path: Path) -> Row:
    """What a reader of an STL file sees: topology, volume and shapes; none of a file too large."""
    if triangles_in(path) > context.most_triangles:
        return {"looked": False}
    mesh = as_read(read_triangles(path))
    return {**_seen(mesh), "pinched": pinched_vertices(mesh)}


def _seen(mesh: TriangleMesh) -> Row:
    quality, shapes = measure(mesh), shape_statistics(mesh)
    return {
        "looked": True,
        "watertight": quality.watertight,
        "bodies": quality.bodies,
        "voids": quality.voids,
        "genus": quality.genus,
        "volume": quality.volume,
        "degenerate": quality.degenerate_triangles,
        "smallest_angle": shapes.smallest_angle,
        "shape": [
            shapes.area_ratio_mean,
            shapes.area_ratio_deviation,
            shapes.area_deviation,
            shapes.radius_ratio_mean,
            shapes.radius_ratio_deviation,
        ],
    }


def look_at_block(context: Context, path: Path, cell: str, count: int) -> Row:
    """As `look_at`, beside the exact block: error of the volume, the genus, distances."""
    if triangles_in(path) > context.most_triangles:
        return {"looked": False}
    mesh = as_read(read_triangles(path))
    row = _seen(mesh)
    graph = cell_graph(LIBRARY[cell], np.ones((count,) * 3, bool), SIZE, np.zeros(3))
    off = gaps(mesh, cell, count)
    one_solid = row["watertight"] and row["bodies"] == 1 and not row["voids"]
    return {
        **row,
        "volume_error": row["volume"] / true_volume(cell, count) - 1,
        "one_solid": bool(one_solid and row["genus"] == graph.genus),
        "rms": float(np.sqrt((off**2).mean())),
        "deviation": float(off.std()),
        "farthest": float(np.abs(off).max()),
    }


def gaps(mesh: TriangleMesh, cell: str, count: int) -> np.ndarray:
    """Signed distances of points spread evenly over a mesh to the exact block, mm."""
    points = exact.sample_surface(mesh, SURFACE_SAMPLES)
    return exact.block_distances(points, LIBRARY[cell], (count,) * 3, SIZE, RADIUS)


@lru_cache
def bracket() -> Path:
    """The GE bracket's file, or a modelled bracket's of the same box."""
    return at_hand("ge_bracket.stl", "bracket")


@lru_cache
def rod() -> Path:
    """The piston rod's file, or a modelled one's of the same box."""
    return at_hand("piston_rod.stl", "piston_rod")


@lru_cache
def true_volume(cell: str, count: int) -> float:
    """Of the exact block, mm3."""
    return exact.block_volume(LIBRARY[cell], count, SIZE, RADIUS)


def machine() -> Row:
    """What the figures were measured on."""
    model, memory = platform.processor() or platform.machine(), 0
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    for line in Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemTotal"):
            memory = round(int(line.split()[1]) / 1024**2)
    packages = ("volfrep", "numpy", "scipy", "scikit-image", "trimesh", "manifold3d")
    return {
        "processor": model,
        "cores": os.cpu_count(),
        "memory_gb": memory,
        "system": platform.platform(),
        "python": platform.python_version(),
        "packages": {name: version(name) for name in packages},
        "peer_packages": peer_versions(),
        "commit": _commit() or "not in a repository",
        "stand_ins": [path.stem for path in (bracket(), rod()) if path.parent != PARTS],
        "date": time.strftime("%Y-%m-%d %H:%M"),
        "load": round(os.getloadavg()[0], 2),
    }


def _commit() -> str:
    """What git calls this state of the code; empty where it is not there, or no repository is."""
    if shutil.which("git") is None:
        return ""
    return subprocess.run(
        ["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True
    ).stdout.strip()


def peer_versions() -> dict[str, str]:
    """Versions in the environment of the other tools; nothing where there is none."""
    if not BENCH_PYTHON.exists():
        return {}
    names = (
        "numpy", "scikit-image", "trimesh", "manifold3d", "vtk", "microgen", "cadquery-ocp", "gmsh",
    )  # fmt: skip
    script = (
        "import json, sys\nfrom importlib.metadata import PackageNotFoundError, version\n"
        "found = {}\nfor name in sys.argv[1:]:\n"
        "    try:\n        found[name] = version(name)\n"
        "    except PackageNotFoundError:\n        found[name] = 'not installed'\n"
        "print(json.dumps(found))"
    )
    done = run([str(BENCH_PYTHON), "-c", script, *names])
    return answer(done) if not done.failure else {}


def middle(values: Sequence[float]) -> float:
    """The median."""
    return float(statistics.median(values))
