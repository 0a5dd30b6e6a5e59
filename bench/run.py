# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark: what we promise, measured, beside the published figures and other tools.

Every job is a fresh ``volfrep`` process; its time runs from the start of the process to its end
with the file on disk. What is then said about the file is measured on what a reader sees.

    python bench/run.py [--only block fine bracket graded large peers] [--out build/bench.md]
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from exact import block_distances, block_volume, sample_surface
from volfrep.cells import LIBRARY
from volfrep.export.stl import as_read
from volfrep.mesh import TriangleMesh
from volfrep.quality import measure, pinched_vertices, shape_statistics
from volfrep.solid import read_triangles
from volfrep.wireframe import cell_graph

ROOT = Path(__file__).resolve().parent.parent
BRACKET = ROOT.parent / "shared" / "parts" / "ge_bracket.stl"
ROD = BRACKET.with_name("piston_rod.stl")
VOLFREP = [sys.executable, "-m", "volfrep"]
PEERS = [sys.executable, str(Path(__file__).with_name("peers.py"))]
PEER_MISSING = 3

SIZE, RADIUS = 10.0, 1.0
LATTICE = ["--cell-size", f"{SIZE:g}", "--strut-radius", f"{RADIUS:g}"]
SURFACE_SAMPLES = 100_000

#: Seconds and MB that the paper reports on a large workstation: Table 1, Table 3, Fig. 12.
PAPER_BLOCK = {"Box": (22.08, 55.17), "FCC": (41.43, 146.74), "CVC": (12.35, 101.41)}
PAPER_BRACKET = {
    "Box": (231, 44.16),
    "BCC": (335, 104.71),
    "FCC": (363, 117.50),
    "Octet": (422, 150.57),
    "Octahedron": (277, 97.02),
    "CVC": (248, 78.52),
}
#: Table 4; the published rod is another one, of the same box.
PAPER_ROD = {
    "Box": (164, 17.11),
    "BCC": (220, 41.16),
    "FCC": (252, 46.19),
    "Octet": (281, 48.24),
    "Octahedron": (162, 37.30),
    "CVC": (149, 29.68),
}
PAPER_LARGE = (3600, float("nan"))


@dataclass(frozen=True)
class Run:
    """A finished job: seconds on the clock, seconds of all the cores, exit code, its words."""

    seconds: float
    cpu: float
    code: int
    said: str


@dataclass(frozen=True)
class Bar:
    """What was asked for, and whether it was reached."""

    text: str
    met: bool


Row = dict[str, str]


def run(arguments: list[str]) -> Run:
    """Run a process and wait for it."""
    start = time.perf_counter()
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(arguments, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        said = output.read().strip()
    return Run(seconds, usage.ru_utime + usage.ru_stime, process.returncode, said)


def block_case(
    folder: Path,
    cell: str,
    name: str,
    seconds: float | None,
    *,
    count: int = 10,
    options: tuple[str, ...] = (),
    command: list[str] | None = None,
    paper: tuple[float, float] | None = None,
    detail: bool = True,
) -> Row:
    """One block; `seconds` is its bar, None where it is only measured for its quality."""
    out = folder / f"{cell}.stl"
    counts = [str(count)] * 3
    ours = command is None
    if command is None:
        command = [*VOLFREP, "block", "-o", str(out), "--cell", cell, "--count", *counts, *LATTICE]
        command += [*options, "--quiet", "--report", str(folder / "report.json")]
    done = run(command)
    row = {"case": name, "cell": cell}
    if done.code:
        return {**row, "note": done.said.splitlines()[-1] if done.said else f"exit {done.code}"}
    size, mesh = take(out)
    quality = measure(mesh)
    graph = cell_graph(LIBRARY[cell], np.ones((count,) * 3, bool), SIZE, np.zeros(3))
    volume_error = quality.volume / true_volume(cell, count) - 1
    bars = [
        *time_bar(done, seconds),
        Bar("one closed body", quality.watertight and quality.bodies == 1 and not quality.voids),
        Bar(f"genus {graph.genus}", quality.genus == graph.genus),
        Bar("volume 0.5 %", abs(volume_error) < 0.005),
    ]
    row |= figures(done, size, paper, mesh)
    if ours:
        row["peak MB"] = peak_memory(folder)
    row |= {"bodies": str(quality.bodies), "genus": str(quality.genus)}
    row["volume error"] = f"{100 * volume_error:+.2f} %"
    if detail:
        points = sample_surface(mesh, SURFACE_SAMPLES)
        gaps = block_distances(points, LIBRARY[cell], (count,) * 3, SIZE, RADIUS)
        rms = float(np.sqrt((gaps**2).mean()))
        row["RMS mm"] = f"{rms:.3f}"
        bars.append(Bar("RMS 0.03 mm", rms < 0.03))
        row |= shape(mesh, bars if cell == "CVC" else [])
    if paper is not None:
        bars += [Bar(f"{paper[1]:.0f} MB", size <= paper[1])] * (paper[1] == paper[1])
    return {**row, "bars": verdict(bars) if ours else "(not ours)"}


def take(out: Path) -> tuple[float, TriangleMesh]:
    """A file's size in MB and what a reader sees in it; the file is removed."""
    size = out.stat().st_size / 1e6
    mesh = as_read(read_triangles(out))
    out.unlink()
    return size, mesh


def part_case(
    folder: Path,
    case: str,
    part: Path,
    cell: str,
    options: list[str],
    seconds: float,
    paper: tuple[float, float] | None = None,
) -> Row:
    """A real part with a skin and a lattice."""
    row = {"case": case, "cell": cell}
    if not part.is_file():
        return {**row, "note": f"left out: there is no {part}"}
    out, report = folder / f"{cell}.stl", folder / "report.json"
    command = [*VOLFREP, "fill", str(part), "-o", str(out), "--cell", cell, *options]
    done = run([*command, "--quiet", "--report", str(report)])
    if done.code:
        return {**row, "note": done.said.splitlines()[-1] if done.said else f"exit {done.code}"}
    size, mesh = take(out)
    quality = measure(mesh)
    bars = [
        *time_bar(done, seconds),
        Bar("one body", quality.bodies == 1),
        Bar("watertight", quality.watertight),
        Bar("no degenerate triangle", quality.degenerate_triangles == 0),
        Bar("no pinched vertex", pinched_vertices(mesh) == 0),
    ]
    row |= figures(done, size, paper, mesh) | {"peak MB": peak_memory(folder)}
    row |= {"bodies": str(quality.bodies), "genus": str(quality.genus)}
    return {**row, **shape(mesh, []), "bars": verdict(bars)}


def peer_case(folder: Path, peer: str, cell: str, name: str) -> Row:
    """Another tool on the block; nothing of ours is judged."""
    out = folder / f"{cell}.stl"
    command = [*PEERS, peer, cell, "10", str(out)]
    return block_case(folder, cell, name, None, command=command)


def time_bar(done: Run, seconds: float | None) -> list[Bar]:
    return [] if seconds is None else [Bar(f"{seconds:g} s", done.seconds <= seconds)]


def figures(done: Run, size: float, paper: tuple[float, float] | None, mesh: TriangleMesh) -> Row:
    row = {
        "seconds": f"{done.seconds:.2f}",
        "MB": f"{size:.1f}",
        "triangles": f"{len(mesh.triangles):,}",
        "CPU s": f"{done.cpu:.2f}",
    }
    if paper is not None:
        row["paper"] = f"{paper[0]:g} s" + (f" / {paper[1]:.1f} MB" if paper[1] == paper[1] else "")
    return row


def peak_memory(folder: Path) -> str:
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    return f"{report['peak_memory_mb']:,.0f}"


def shape(mesh: TriangleMesh, bars: list[Bar]) -> Row:
    statistics = shape_statistics(mesh)
    bars += [
        Bar("in/circumradius 0.88", statistics.radius_ratio_mean >= 0.88),
        Bar("smallest angle 10", statistics.smallest_angle >= 10),
    ] * bool(bars)
    return {
        "in/circumradius": f"{statistics.radius_ratio_mean:.3f}",
        "smallest angle": f"{statistics.smallest_angle:.1f}",
    }


def verdict(bars: list[Bar]) -> str:
    missed = [bar.text for bar in bars if not bar.met]
    return f"misses {', '.join(missed)}" if missed else f"all {len(bars)} met"


@lru_cache
def true_volume(cell: str, count: int) -> float:
    return block_volume(LIBRARY[cell], count, SIZE, RADIUS)


def block_rows(folder: Path) -> Iterator[Row]:
    for cell in LIBRARY:
        paper = PAPER_BLOCK.get(cell)
        yield block_case(folder, cell, "block 10 x 10 x 10", 2 if paper else None, paper=paper)


def fine_rows(folder: Path) -> Iterator[Row]:
    for cell in PAPER_BLOCK:
        fine = ("--resolution", "30")
        yield block_case(folder, cell, "the same at L / 30", 4, options=fine)


def bracket_rows(folder: Path) -> Iterator[Row]:
    for cell, paper in PAPER_BRACKET.items():
        options = [*LATTICE, "--shell", "3"]
        yield part_case(folder, "GE bracket, skin 3", BRACKET, cell, options, 8, paper)


def graded_rows(folder: Path) -> Iterator[Row]:
    """Sizes and radii that vary: the paper's piston rod, a block, a field on the bracket."""
    rod = ["--cell-size", "2", "--strut-radius", "0.2", "--shell", "1"]
    linear = ["--size-grading", "linear", "--lambda-min", "1", "--lambda-max", "2"]
    for cell, paper in PAPER_ROD.items():
        name = "piston rod, skin 1, linear size 1 to 2 along x"
        yield part_case(folder, name, ROD, cell, [*rod, *linear], 6, paper)
    thicker = ["--radius-min", "0.6", "--radius-max", "1.4"]
    along = ["--radius-grading", "direction", "--resolution", "15", *thicker]
    out = folder / "graded.stl"
    command = [*VOLFREP, "block", "-o", str(out), "--cell", "CVC", *LATTICE]
    done = run([*command, "--count", "10", "10", "10", *along, "--quiet"])
    row = {"case": "block 10 x 10 x 10, radius 0.6 to 1.4", "cell": "CVC"}
    if done.code:
        yield {**row, "note": done.said.splitlines()[-1]}
    else:
        size, mesh = take(out)
        quality = measure(mesh)
        bars = [
            *time_bar(done, 5),
            Bar("one closed body", quality.watertight and quality.bodies == 1),
            Bar("genus 5670", quality.genus == 5670),
        ]
        row |= figures(done, size, None, mesh)
        row |= {"bodies": str(quality.bodies), "genus": str(quality.genus)}
        yield {**row, **shape(mesh, []), "bars": verdict(bars)}
    field = folder / "field.csv"
    write_field(field)
    by_field = ["--radius-grading", "field", "--radius-field", str(field), *thicker]
    options = [*LATTICE, "--shell", "3", *by_field]
    yield part_case(folder, "GE bracket, radius by a field", BRACKET, "CVC", options, 12)


def write_field(path: Path) -> None:
    """A smooth made-up field at 20,000 points in the bracket's box."""
    points = np.random.default_rng(0).uniform((0, 0, 0), (180, 65, 110), (20_000, 3))
    values = 100.0 + 40.0 * np.sin(points[:, 0] / 25.0) * np.cos(points[:, 2] / 30.0)
    rows = np.column_stack([points, values])
    np.savetxt(path, rows, "%.4f", ",", header="x,y,z,value", comments="")


def large_rows(folder: Path) -> Iterator[Row]:
    yield block_case(
        folder, "CVC", "block 26 x 26 x 26", 30, count=26, paper=PAPER_LARGE, detail=False
    )


def peer_rows(folder: Path) -> Iterator[Row]:
    for peer, name in (
        ("skimage", "numpy + scikit-image, L / 15"),
        ("manifold", "manifold3d CSG, 24-gons"),
    ):
        for cell in PAPER_BLOCK:
            yield peer_case(folder, peer, cell, name)


GROUPS: dict[str, Callable[[Path], Iterator[Row]]] = {
    "block": block_rows,
    "fine": fine_rows,
    "bracket": bracket_rows,
    "graded": graded_rows,
    "large": large_rows,
    "peers": peer_rows,
}

COLUMNS = (
    "case", "cell", "seconds", "CPU s", "paper", "MB", "triangles", "peak MB", "bodies", "genus",
    "volume error", "RMS mm", "in/circumradius", "smallest angle", "bars",
)  # fmt: skip


def markdown(rows: list[Row]) -> str:
    """The rows as one table; a row with a note has the note instead of its figures."""
    lines = [f"| {' | '.join(COLUMNS)} |", f"|{'---|' * len(COLUMNS)}"]
    for row in rows:
        cells = [row.get(column, "") for column in COLUMNS]
        if "note" in row:
            cells[-1] = row["note"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=GROUPS, default=list(GROUPS), metavar="GROUP")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "bench.md")
    options = parser.parse_args()
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        for group in options.only:
            for row in GROUPS[group](Path(folder)):
                rows.append(row)
                print("  ".join(f"{key} {value}" for key, value in row.items()), flush=True)
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    text = (
        f"# Benchmark\n\nL = {SIZE:g}, r = {RADIUS:g}; {os.cpu_count()} cores{load}, "
        f"Python {platform.python_version()}, numpy {np.__version__}. Seconds from the start of "
        "the process to the file on disk (CPU s: of all the cores together); everything "
        "else on the file as it is read back.\n\n"
        f"{markdown(rows)}\n"
    )
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(text, encoding="utf-8")
    print(f"\n{text}\nwritten to {options.out}")


if __name__ == "__main__":
    main()
