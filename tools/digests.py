# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether the command still writes the same files, byte for byte.

    make digests                        # compares with tools/digests.json
    make digests DIGESTS=--write        # after a change that is meant to alter them
    make digests DIGESTS="tpms size"    # only what has one of these words in its name

Every kind of lattice, every form of output, sized radii and layers, on small parts that are
modelled here. The last bits of a coordinate depend on the packages and the processor, so that
digests from another machine say nothing: write them before a change, compare after it. What a
file says of when it was written, and a report of how long it took, counts for nothing.

Some forms need a program. Where it is not installed they are skipped, which is told, and their
kept digests stay.
"""

from __future__ import annotations

import argparse
import hashlib
import io
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import manifold3d
import numpy as np
import trimesh

KEPT = Path(__file__).with_suffix(".json")
COMMAND = Path(sys.executable).with_name("volfrep")
#: Of a report: what the clock and the machine say, and where files lie.
PASSING = {
    "stages", "stage_memory_mb", "peak_memory_mb", "workers_memory_mb", "seconds",
    "made_in_seconds",
}  # fmt: skip

#: Options of `fill`, and the extension of the file; on a bracket, a plate with holes and a ball.
ON_EVERY_PART = {
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

#: The same on a small block, by its subject. {name} stands for a file of `inputs`.
CELLS = "--cell BCC --cell-size 8 --resolution 10"
STRUTS = f"{CELLS} --strut-radius 0.8"
SHEET = "--cell Gyroid --cell-size 8 --wall-thickness 1 --resolution 14"
RANDOM = "--network-points 20 --strut-radius 0.4 --deviation 0.08"
FILLS = {
    "tpms sheet": (f"{SHEET} --shell 1", "stl"),
    "tpms sheet-no-skin": (f"{SHEET} --shell 0", "ply"),
    "tpms skeleton": (
        "--cell 'Schwarz P' --cell-size 8 --wall-kind skeleton --wall-offset 0.3 --shell 1 "
        "--resolution 14",
        "stl",
    ),
    "tpms complement": (
        "--cell Gyroid --cell-size 8 --wall-kind complement --shell 0 --resolution 14",
        "stl",
    ),
    "tpms graded": (
        f"{SHEET} --shell 0 --radius-grading direction --radius-start 0.8 --radius-end 1.3",
        "stl",
    ),
    "tpms growing": (f"{SHEET} --shell 0 --size-grading linear --lambda-end 1.4", "stl"),
    "tpms formula": (
        "--cell Formula --wall-formula cos(x)+cos(y)+cos(z) --cell-size 8 --wall-thickness 1 "
        "--shell 0 --resolution 14",
        "stl",
    ),
    "tpms target": (
        "--cell Gyroid --cell-size 8 --relative-density 0.3 --shell 0 --resolution 14",
        "stl",
    ),
    "tpms lattice": (f"{SHEET} --shell 1 --make lattice --3mf mesh", "3mf"),
    "network voronoi": (f"--network voronoi {RANDOM} --shell 1", "stl"),
    "network voronoi-on-wall": (f"--network voronoi --network-on-wall {RANDOM} --shell 0", "stl"),
    "network voronoi-denser": (
        f"--network voronoi --network-density 3-2*s --network-relax 1 {RANDOM} --shell 1",
        "ply",
    ),
    "network voronoi-field": (
        f"--network voronoi --network-density 1+2*s --network-field {{field.csv}} {RANDOM} "
        "--shell 0",
        "stl",
    ),
    "network voronoi-beams": (f"--network voronoi {RANDOM} --shell 1", "inp"),
    "network delaunay": (
        "--network delaunay --network-points 12 --network-seed 3 --strut-radius 0.4 "
        "--deviation 0.08 --shell 0",
        "stl",
    ),
    "network graph": (
        "--network file --network-file {graph.json} --strut-radius 0.8 --shell 1 --deviation 0.08",
        "stl",
    ),
    "network graph-radii": (
        "--network file --network-file {graph.csv} --strut-radius 0.8 --shell 1 --3mf beams",
        "3mf",
    ),
    "target density": (f"{CELLS} --relative-density 0.2 --shell 1", "stl"),
    "target mass": (f"{CELLS} --mass 3 --shell 1", "stl"),
    "target stiffness": (f"{CELLS} --stiffness 0.02:100 --shell 0", "stl"),
    "target tpms-mass": (
        "--cell Gyroid --cell-size 8 --mass 3.5 --shell 0.8 --resolution 14",
        "stl",
    ),
    "skin faces": (
        f"{STRUTS} --shell 1 --open-plane 0,0,0,0,0,-1 --skin-face 0,0,14,0,0,1,2",
        "stl",
    ),
    "skin solid": (f"{STRUTS} --shell 1 --keep-solid 12,9,14,0,0,1,3", "stl"),
    "skin drill": (f"{STRUTS} --shell 1 --drain-diameter 3 --drain 12,9,0,0,0,1", "stl"),
    "graded cylindrical": (f"{STRUTS} --shell 1 --cell-map cylindrical", "stl"),
    "graded deformed": (
        f"{STRUTS} --shell 0 --no-keep-radius --size-grading quadratic --lambda-end 1.5",
        "stl",
    ),
    "graded field": (
        f"{STRUTS} --shell 0 --radius-grading field --radius-field {{field.csv}} "
        "--radius-curve 0:0.6,20:1",
        "stl",
    ),
    "graded thin-gone": (
        f"{STRUTS} --shell 0 --radius-grading direction --radius-start 0.5 --radius-end 0.9 "
        "--remove-below 0.7",
        "stl",
    ),
    "cell own": ("--cell {cell.json} --cell-size 8 --strut-radius 0.6 --shell 1", "stl"),
    "make lattice": (f"{STRUTS} --shell 1 --make lattice", "stl"),
    "make domain": (f"{STRUTS} --shell 1 --make domain", "stl"),
    "pieces kept": (f"{STRUTS} --shell 0 --keep-pieces --rotate 1,1,0,25", "stl"),
    **{f"form {kind}": (f"{STRUTS} --shell 1", kind) for kind in ("ply", "obj", "off", "glb")},
    "form 3mf": (f"{STRUTS} --shell 1 --3mf mesh", "3mf"),
    "form 3mf-beams": (f"{STRUTS} --shell 1 --3mf beams", "3mf"),
    "form step": (f"{STRUTS} --shell 1 --make lattice", "step"),
    "form step-lines": (f"{STRUTS} --shell 1 --step wireframe", "step"),
    "form inp-tetrahedra": (f"{STRUTS} --shell 0 --inp tetrahedra", "inp"),
    "form inp-material": (f"{STRUTS} --shell 1 --material Ti-6Al-4V", "inp"),
}

#: Options of `block`.
BLOCKS = {
    "block stl": ("--count 3,2,2 --cell CVC --cell-size 6 --strut-radius 0.6", "stl"),
    "block fillet": (
        "--count 2,2,2 --cell Octet --cell-size 8 --strut-radius 0.6 --fillet 0.3 --resolution 12",
        "ply",
    ),
    "block turned": (
        "--count 2,2,2 --cell Box --cell-size 6 --strut-radius 0.6 --rotate 0,1,1,20",
        "stl",
    ),
    "block growing": (
        "--count 3,2,2 --cell BCC --cell-size 6 --strut-radius 0.5 --size-grading linear "
        "--lambda-end 1.3 --resolution 10",
        "stl",
    ),
    "block round": (
        "--count 2,12,2 --cell BCC --cell-size 7 --strut-radius 0.4 --cell-map cylindrical "
        "--resolution 10",
        "stl",
    ),
    "block obj": ("--count 2,2,2 --cell Kelvin --cell-size 8 --strut-radius 0.5", "obj"),
    "block 3mf": (f"--count 2,2,2 {STRUTS} --3mf both", "3mf"),
    "block step": (f"--count 2,1,1 {STRUTS} --step wireframe", "step"),
    "block step-exact": (f"--count 1,1,1 {STRUTS} --step exact", "step"),
    "block inp": (f"--count 2,2,2 {STRUTS}", "inp"),
    "block inp-tetrahedra": (f"--count 1,1,1 {STRUTS} --inp tetrahedra", "inp"),
    "block tpms": (f"--count 2,2,2 {SHEET}", "stl"),
    "block tpms-skeleton": (
        "--count 2,1,1 --cell 'Schwarz D' --cell-size 8 --wall-kind skeleton --resolution 14",
        "obj",
    ),
}

#: Options of `network` after its file.
NETWORKS = {
    "network alone": ("{graph.json} --strut-radius 0.8", "stl"),
    "network alone-inp": ("{graph.csv} --strut-radius 0.8", "inp"),
    "network hexahedra": ("{cubes.vtk} --cell BCC --strut-radius 0.6 --deviation 0.08", "stl"),
    "network layers": (
        "{quads.obj} --cell Box --network-thickness 6 --network-layers 1 "
        "--strut-radius 0.6 --deviation 0.08",
        "stl",
    ),
}

#: Options of `slice`; the digest is of all files of the folder.
SLICES = {
    **{
        f"slice {kind}": f"{STRUTS} --shell 1 --layer 1 --format {kind}"
        for kind in ("png", "svg", "cli")
    },
    "slice network": f"--network voronoi {RANDOM} --shell 1 --layer 2 --format svg",
}

#: Options of `size`, each of which writes part, radii, specification and report.
SIZED = "--cell BCC --cell-size 8 --strut-radius 0.8 --resolution 10 --no-proof --steps 12"
SIZES = {
    "size stress": f"{SIZED} --shell 0 --boundary whole --activation inside --safety 3",
    "size stiffest": f"{SIZED} --shell 1 --strut-mass 3",
    "size thin-gone": (
        f"{SIZED} --shell 0 --boundary whole --activation inside --safety 4 --thinnest 0.5 "
        "--remove-thin"
    ),
}

LOADS = """
material = "Ti-6Al-4V"
yield_stress = 900
[[support]]
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
fixed = true
[[case]]
name = "down"
[[case.load]]
plane = { point = [32, 0, 0], normal = [1, 0, 0] }
force = [0, 0, -60]
"""


@dataclass(frozen=True)
class Job:
    """One run of the command.

    Attributes:
        name: of its digest; with several files followed by each one's.
        words: of the command, without those that name its files.
        files: that it writes: the options and the files' names.
        needs: a program, without which it is skipped.
    """

    name: str
    words: tuple[str, ...]
    files: tuple[tuple[str, str], ...]
    needs: str = ""


def inputs(folder: Path) -> dict[str, str]:
    """Write the parts and files that the jobs read; their paths by their names."""
    outline = [(0, 0), (50, 0), (50, 14), (14, 14), (14, 50), (0, 50)]
    hole = manifold3d.Manifold.cylinder(30.0, 5.0, 5.0, 96)
    solids = {
        "bracket": manifold3d.CrossSection([np.array(outline, float)]).extrude(30.0),
        "plate": manifold3d.Manifold.cube((60.0, 40.0, 22.0)) - hole.translate((20, 15, -4)),
        "brick": manifold3d.Manifold.cube((24.0, 18.0, 14.0)),
        "arm": manifold3d.Manifold.cube((32.0, 16.0, 16.0)),
    }
    meshes = {"ball": trimesh.creation.icosphere(4, 21.0)}
    for name, solid in solids.items():
        data = solid.to_mesh64()
        meshes[name] = trimesh.Trimesh(data.vert_properties[:, :3], data.tri_verts, process=False)
    for name, mesh in meshes.items():
        mesh.export(folder / f"{name}.stl")
    for kind in ("obj", "ply", "off", "glb", "3mf"):
        meshes["brick"].export(folder / f"brick.{kind}")

    x, y, z = np.array(list(product((0.0, 12.0, 24.0), (0.0, 9.0, 18.0), (0.0, 7.0, 14.0)))).T
    field = "".join(f"{a:g},{b:g},{c:g},{20 * a / 24:g}\n" for a, b, c in zip(x, y, z, strict=True))
    nodes = [[2, 2, -3], [27, 2, 3], [3, 21, 3], [4, 4, 17], [25, 19, 12]]
    struts = [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3], [1, 3], [1, 4], [2, 4], [3, 4]]
    ends = "".join(",".join(map(str, [*nodes[a], *nodes[b], 0.6, 0.9])) + "\n" for a, b in struts)
    corners = [(0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0), (0, 0, 9), (9, 0, 9), (9, 9, 9)]
    corners += [(0, 9, 9), (19, 0, 1), (19, 9, 1), (19, 0, 8), (19, 9, 8)]
    cubes = (
        "# vtk DataFile Version 3.0\ntwo hexahedra\nASCII\nDATASET UNSTRUCTURED_GRID\n"
        "POINTS 12 double\n" + "".join(f"{a} {b} {c}\n" for a, b, c in corners) + "CELLS 2 18\n"
        "8 0 1 2 3 4 5 6 7\n8 1 8 9 2 5 10 11 6\nCELL_TYPES 2\n12\n12\n"
    )
    quads = "v 0 0 0\nv 8 0 0\nv 8 8 1\nv 0 8 0\nv 16 0 2\nv 16 8 3\nf 1 2 3 4\nf 2 5 6 3\n"
    cell = {
        "name": "Own",
        "nodes": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [0.5, 0.5, 0.45]],
        "struts": [[0, 5], [5, 4], [5, 1], [5, 3], [2, 5], [0, 1]],
    }
    texts = {
        "field.csv": f"x,y,z,value\n{field}", "graph.csv": ends, "cubes.vtk": cubes,
        "graph.json": json.dumps({"nodes": nodes, "struts": struts}), "quads.obj": quads,
        "cell.json": json.dumps(cell), "loads.toml": LOADS,
    }  # fmt: skip
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return {path.name: str(path) for path in folder.iterdir()}


def jobs() -> Iterator[Job]:
    """Every run."""
    for part, (name, (options, kind)) in product(
        ("bracket", "plate", "ball"), ON_EVERY_PART.items()
    ):
        words = ("fill", f"{{{part}.stl}}", *shlex.split(options))
        yield Job(f"{part} {name}", words, (("-o", f"{part}-{name}.{kind}"),))
    for table, first in (
        (FILLS, ("fill", "{brick.stl}")), (BLOCKS, ("block",)), (NETWORKS, ("network",)),
    ):  # fmt: skip
        for name, (options, kind) in table.items():
            needs = "gmsh" * ("tetrahedra" in options) + "freecadcmd" * ("exact" in options)
            yield Job(name, (*first, *shlex.split(options)), (("-o", f"out.{kind}"),), needs)
    for kind in ("obj", "ply", "off", "glb", "3mf"):
        words = ("fill", f"{{brick.{kind}}}", "--unit", "mm", "--shell", "1", "--make", "domain")
        yield Job(f"read {kind}", words, (("-o", "out.stl"),))
    for name, options in SLICES.items():
        yield Job(name, ("slice", "{brick.stl}", *shlex.split(options)), (("-o", "layers"),))
    written = (
        ("-o", "part.stl"), ("--radii", "radii.csv"), ("--write-spec", "spec.toml"),
        ("--report", "report.json"),
    )  # fmt: skip
    for name, options in SIZES.items():
        words = ("size", "{arm.stl}", "--loads", "{loads.toml}", *shlex.split(options))
        yield Job(name, words, written)
    told = (("-o", "out.stl"), ("--report", "report.json"), ("--write-spec", "spec.toml"))
    for name in ("skin solid", "tpms sheet", "network voronoi"):
        words = ("fill", "{brick.stl}", *shlex.split(FILLS[name][0]), "--print-report", "SLS")
        yield Job(f"report {name}", words, told)
    words = ("block", *shlex.split(BLOCKS["block stl"][0]))
    yield Job("report block", words, told)


def run(job: Job, read: dict[str, str], folder: Path) -> dict[str, str]:
    """The digests of a job's files, or what the command said instead of writing them."""
    home = folder / job.name.replace(" ", "-")
    home.mkdir()
    words = [re.sub(r"\{([\w.]+)\}", lambda found: read[found[1]], word) for word in job.words]
    for option, name in job.files:
        words += [option, str(home / name)]
    done = subprocess.run(
        [COMMAND, *words, "--quiet"], capture_output=True, text=True,
        env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
    )  # fmt: skip
    if done.returncode:
        return {job.name: done.stderr.replace(str(folder), "").strip()}
    places = {str(path): path.name for path in (home, *map(Path, read.values()))}
    return {
        f"{job.name} {name}" if len(job.files) > 1 else job.name: digest(home / name, places)
        for _, name in job.files
    }


def digest(path: Path, places: dict[str, str]) -> str:
    """SHA-256 of a file, or of a folder's files, without what changes from run to run.

    Args:
        path: of a file or folder.
        places: paths of this run, and what stands for them.
    """
    made = hashlib.sha256()
    for file in sorted(path.iterdir()) if path.is_dir() else [path]:
        if path.is_dir():
            made.update(file.name.encode())
        data = file.read_bytes()
        if file.suffix in (".json", ".toml", ".csv", ".step"):
            text = data.decode()
            for place, name in places.items():
                text = text.replace(place, name)
            if file.suffix == ".json":
                text = json.dumps(lasting(json.loads(text)), sort_keys=True)
            if file.suffix == ".step":
                text = re.sub(r"'\d{4}-\d\d-\d\dT[\d:]+'", "''", text)
            data = text.encode()
        if file.suffix == ".3mf":
            data = without_places(data, places)
        made.update(data)
    return made.hexdigest()


def without_places(data: bytes, places: dict[str, str]) -> bytes:
    """A 3MF as it is; one whose specification names files of this run, unpacked and without."""
    with zipfile.ZipFile(io.BytesIO(data)) as package:
        inside = b"".join(name.encode() + package.read(name) for name in package.namelist())
    unpacked = inside
    for place, name in places.items():
        unpacked = unpacked.replace(place.encode(), name.encode())
    return data if unpacked == inside else unpacked


def lasting(value: object) -> object:
    """A report without what the clock and the machine say, and the last bits of its numbers."""
    if isinstance(value, float):
        return float(f"{value:.8g}")
    if isinstance(value, dict):
        return {key: lasting(inner) for key, inner in value.items() if key not in PASSING}
    return [lasting(inner) for inner in value] if isinstance(value, list) else value


def main() -> int:
    """Digest every file; 0 where all are as they were, else 1."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("words", nargs="*", help="only jobs with one of these in their names")
    parser.add_argument("--write", action="store_true", help="keep what there is now")
    options = parser.parse_args()
    wanted = [
        job for job in jobs()
        if not options.words or any(word in job.name for word in options.words)
    ]  # fmt: skip
    skipped = [job for job in wanted if job.needs and shutil.which(job.needs) is None]
    found: dict[str, str] = {}
    with tempfile.TemporaryDirectory() as name:
        read = inputs(Path(name))
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for made in pool.map(
                lambda job: run(job, read, Path(name)), [j for j in wanted if j not in skipped]
            ):
                found |= made
    for job in skipped:
        print(f"digests: skipped '{job.name}': {job.needs} is not installed")
    failed = sorted(name for name, value in found.items() if not re.fullmatch(r"\w{64}", value))
    for name in failed:
        print(f"digests: no file of '{name}': {found[name]}")
    kept: dict[str, str] = json.loads(KEPT.read_text()) if KEPT.is_file() else {}
    # Without words, what no job makes any more is gone.
    beside = {
        name: value
        for name, value in kept.items()
        if (options.words and not any(word in name.rpartition(" ")[0] for word in options.words))
        or any(name == job.name or name.startswith(f"{job.name} ") for job in skipped)
    }
    if options.write:
        everything = beside | found
        KEPT.write_text(json.dumps(everything, indent=1, sort_keys=True) + "\n")
        print(f"digests: wrote {len(found)}")
        return 1 if failed else 0
    judged = (kept.keys() - beside.keys()) | found.keys()
    other = sorted(name for name in judged if kept.get(name) != found.get(name))
    print(f"digests: {len(judged) - len(other)} as they were, {len(other)} not")
    for name in other:
        print(
            f"  {name}" + ("" if name in kept else " (new)") + ("" if name in found else " (gone)")
        )
    return 1 if other or failed else 0


if __name__ == "__main__":
    sys.exit(main())
