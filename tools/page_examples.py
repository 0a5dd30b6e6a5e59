# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run what the pages show: every command of a shell and every script, page by page.

    python tools/page_examples.py [--jobs 2] [PAGE ...]

Each page has a folder of its own with the files that its examples name (`inputs`), and its
examples run there in their order, as a reader would. What cannot be run is named with its reason.
Ends with 1 where an example does, too. `make site` runs this before it builds.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import trimesh

ROOT = Path(__file__).resolve().parents[1]
#: What the text of a command or a script holds that is not run, and why.
NOT_RUN = {
    "freecad_volfrep": "inside FreeCAD",
    "App.newDocument": "inside FreeCAD",
    "Unit_Cell_Catalog.txt": "a catalogue that does not come with this package",
    "blade.step": "a CAD file and a mesher's",
    "quads.obj": "a mesher's file",
    "scheduler": "a cluster",
    "SLURM": "a cluster",
    " ...": "an outline",
}
LOADS = """
material = "Ti-6Al-4V"
[[support]]
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
fixed = true
[[case]]
name = "down"
[[case.load]]
plane = { point = [80, 0, 0], normal = [1, 0, 0] }
force = [0, 0, -200]
"""
STUDY = """
parts = ["part.stl"]
do = ["forecast"]
[vary]
cell = ["BCC", "CVC"]
strut_radius = [0.8, 1.0]
"""


def inputs(folder: Path) -> None:
    """The files that examples take, in a folder."""
    part = trimesh.creation.box(bounds=((0, 0, -10), (80, 50, 20)))
    for name in ("part", "bracket"):
        part.export(folder / f"{name}.stl")
    trimesh.creation.annulus(20, 40, 30).export(folder / "round.stl")
    trimesh.creation.box((20, 24, 16)).export(folder / "block.stl")
    trimesh.creation.box((6, 6, 30)).export(folder / "boss.stl")
    nodes, struts = [[5, 5, 0], [90, 5, 0], [5, 60, 0], [5, 5, 30]], [(0, 1), (0, 2), (0, 3)]
    (folder / "graph.json").write_text(json.dumps({"nodes": nodes, "struts": struts}))
    with (folder / "graph.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["x1", "y1", "z1", "x2", "y2", "z2"])
        rows.writerows([*nodes[a], *nodes[b]] for a, b in struts)
    with (folder / "stress.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["x", "y", "z", "stress"])
        for x, y, z in np.mgrid[0:81:20, 0:51:25, -10:21:15].reshape(3, -1).T.tolist():
            rows.writerow([x, y, z, 2 * x])
    (folder / "loads.toml").write_text(LOADS)
    (folder / "study.toml").write_text(STUDY)
    for name in ("bench", "demo"):
        (folder / name).symlink_to(ROOT / name)
    (folder / "build").mkdir()


def examples(page: Path) -> list[list[str]]:
    """The commands that a page's examples are, in their order; a script is one command."""
    found = []
    blocks = re.findall(r"```(python|sh)\n(.*?)```", page.read_text("utf-8"), re.S)
    for language, text in blocks:
        if language == "python":
            found.append([sys.executable, "-c", text])
            continue
        for line in text.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            if words and words[0] in ("volfrep", "python"):
                found.append([str(Path(sys.executable).with_name(words[0])), *words[1:]])
    return found


def run(page: Path) -> tuple[int, list[str], list[str]]:
    """How many of a page's examples ran, what was not run, and what went wrong."""
    done, left, wrong = 0, [], []
    paths = [ROOT / ".cache" / name for name in ("plot", "study")]
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join(map(str, paths)),
        "PYVISTA_OFF_SCREEN": "true",
    }
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        inputs(folder)
        for command in examples(page):
            shown = " ".join(command[1:]).strip().splitlines()
            text = " ".join(command)
            first = next((why for mark, why in NOT_RUN.items() if mark in text), "")
            if first:
                left.append(f"{shown[0]}: {first}")
                continue
            ended = subprocess.run(
                command, cwd=folder, env=environment, capture_output=True, text=True,
                stdin=subprocess.DEVNULL,
            )  # fmt: skip
            done += 1
            if ended.returncode:
                wrong.append(f"{shown[0]}\n{ended.stderr[-1500:]}")
    return done, left, wrong


def main() -> int:
    """Run the pages that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pages", nargs="*", type=Path)
    parser.add_argument("--jobs", type=int, default=2, help="pages at a time")
    options = parser.parse_args()
    pages = options.pages or [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    pages = [page for page in pages if examples(page)]
    failed = total = 0
    begin = time.monotonic()
    with ThreadPoolExecutor(options.jobs) as pool:
        for page, (done, left, wrong) in zip(pages, pool.map(run, pages), strict=True):
            total += done
            failed += len(wrong)
            print(f"examples: {page.name}: {done} run, {len(wrong)} wrong", flush=True)
            for text in left:
                print(f"  not run: {text}")
            for text in wrong:
                print(f"  WRONG: {text}")
    print(f"examples: {total} run, {failed} wrong, {time.monotonic() - begin:.0f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
