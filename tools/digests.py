# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether the command still writes the same files, byte for byte.

    .venv/bin/python tools/digests.py           # compares with tools/digests.json
    .venv/bin/python tools/digests.py --write   # after a change that is meant to alter them

Ten specifications on three parts that are modelled here. The last bits of a coordinate depend on
the packages and the processor, so that digests from another machine say nothing: write them
before a change, compare after it.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import manifold3d
import numpy as np
import trimesh

KEPT = Path(__file__).with_suffix(".json")
COMMAND = Path(sys.executable).with_name("volfrep")

#: Options, and the extension of the file.
SPECIFICATIONS = {
    "skin": ("--cell CVC --cell-size 10 --strut-radius 1 --shell 2", "stl"),
    "no-skin": ("--cell Box --cell-size 8 --strut-radius 0.8 --shell 0", "ply"),
    "fillet": ("--cell Octet --cell-size 12 --strut-radius 1.2 --shell 1.5 --fillet 0.5", "obj"),
    "growing": (
        "--cell FCC --cell-size 8 --strut-radius 0.6 --shell 2 --size-grading linear "
        "--lambda-end 1.5 --grading-direction 0,1,0",
        "stl",
    ),
    "radius": (
        "--cell BCC --cell-size 10 --strut-radius 1 --shell 2 --radius-grading skin "
        "--radius-start 0.6 --radius-end 1.2 --radius-reach 6",
        "stl",
    ),
    "pruned": (
        "--cell Octahedron --cell-size 10 --strut-radius 0.8 --shell 2 --remove-dangling "
        "--shortest-stub 1",
        "stl",
    ),
    "turned": (
        "--cell CVC --cell-size 9 --strut-radius 0.8 --shell 1.5 --rotate 0,0,1,30 --3mf both",
        "3mf",
    ),
    "drained": (
        "--cell Box --cell-size 10 --strut-radius 1 --shell 2 --drain-count 1 --drain-diameter 3",
        "stl",
    ),
    "whole": (
        "--cell BCC --cell-size 7 --strut-radius 0.6 --shell 1 --activation centre "
        "--boundary whole --resolution 24",
        "stl",
    ),
    "beams": ("--cell Octet --cell-size 12 --strut-radius 0.8 --shell 1 --inp beams", "inp"),
}


def parts() -> Iterator[tuple[str, trimesh.Trimesh]]:
    """An L, a plate with holes, a ball: flat, drilled and round."""
    outline = [(0, 0), (50, 0), (50, 14), (14, 14), (14, 50), (0, 50)]
    solids = {"bracket": manifold3d.CrossSection([np.array(outline, float)]).extrude(30.0)}
    hole = manifold3d.Manifold.cylinder(30.0, 5.0, 5.0, 96)
    solids["plate"] = manifold3d.Manifold.cube((60.0, 40.0, 22.0)) - hole.translate((20, 15, -4))
    for name, solid in solids.items():
        mesh = solid.to_mesh64()
        yield name, trimesh.Trimesh(mesh.vert_properties[:, :3], mesh.tri_verts, process=False)
    yield "ball", trimesh.creation.icosphere(4, 21.0)


def main() -> int:
    """Digest every file; 0 where all are as they were, else 1."""
    with tempfile.TemporaryDirectory() as folder:
        jobs = []
        for part, mesh in parts():
            source = Path(folder, f"{part}.stl")
            mesh.export(source)
            for name, (options, kind) in SPECIFICATIONS.items():
                jobs.append((f"{part} {name}", source, options, kind))
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            found = dict(pool.map(digest, jobs))
    if "--write" in sys.argv[1:]:
        KEPT.write_text(json.dumps(found, indent=1) + "\n")
        print(f"digests: wrote {len(found)}")
        return 0
    kept = json.loads(KEPT.read_text())
    other = sorted(name for name in kept.keys() | found.keys() if kept.get(name) != found.get(name))
    print(f"digests: {len(kept) - len(other)} as they were" + "".join(f"\n  {n}" for n in other))
    return 1 if other else 0


def digest(job: tuple[str, Path, str, str]) -> tuple[str, str]:
    """The name of a job and the digest of its file, or what the command said instead."""
    name, source, options, kind = job
    target = source.with_name(f"{name.replace(' ', '-')}.{kind}")
    command = [COMMAND, "fill", source, "-o", target, *options.split(), "--quiet"]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if done.returncode:
        return name, done.stderr.strip()
    return name, hashlib.sha256(target.read_bytes()).hexdigest()


if __name__ == "__main__":
    sys.exit(main())
