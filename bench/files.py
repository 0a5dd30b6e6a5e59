# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files for CAD beside their bars: seconds to write and size, and what FreeCAD reads back.

    python bench/files.py [--out build/files.md]

FreeCAD must be installed; reading 100,000 plane faces takes it more than a minute.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from volfrep import LatticeSpec
from volfrep.io.freecad_process import freecad_program, write_exact_step
from volfrep.io.write.step_faceted import write_step_faceted
from volfrep.io.write.step_wireframe import write_step_wireframe
from volfrep.jobs.blocks import block, block_wireframe

ROOT = Path(__file__).resolve().parent.parent
_READ = """import json, os, time
import Part
start = time.perf_counter()
shape = Part.Shape()
shape.read({path!r})
found = {{"seconds": time.perf_counter() - start, "solids": len(shape.Solids),
         "valid": shape.isValid(), "closed": bool(shape.Solids) and shape.isClosed(),
         "volume": shape.Volume, "length": shape.Length}}
json.dump(found, open({answer!r}, "w"))
os._exit(0)
"""


def read_back(path: Path) -> dict[str, float]:
    """What FreeCAD finds in a file."""
    script, answer = path.with_name("look_at_it.py"), path.with_name("answer.json")
    script.write_text(_READ.format(path=str(path), answer=str(answer)), encoding="utf-8")
    subprocess.run(
        [freecad_program(), str(script)], stdin=subprocess.DEVNULL, capture_output=True, check=True
    )
    found: dict[str, float] = json.loads(answer.read_text(encoding="utf-8"))
    return found


def exact(path: Path) -> tuple[str, float, Callable[[], float]]:
    spec = LatticeSpec(cell="CVC", cell_size=20, strut_radius=2)
    frame = block_wireframe(spec, (11, 8, 7))
    made = block(spec, (11, 8, 7))
    volume: list[float] = []
    return (
        "exact, 616 CVC cells",
        made.report.volume_mm3,
        lambda: volume.append(write_exact_step(frame, path, made.report.volume_mm3)) or volume[0],
    )


def faceted(path: Path) -> tuple[str, float, Callable[[], float]]:
    spec = LatticeSpec(cell="Octet", cell_size=10, strut_radius=1)
    mesh = block(spec, (4, 3, 2)).mesh
    return (
        f"plane faces, {len(mesh.triangles):,}",
        mesh.volume,
        lambda: write_step_faceted(mesh, path) or mesh.volume,
    )


def axes(path: Path) -> tuple[str, float, Callable[[], float]]:
    frame = block_wireframe(LatticeSpec(cell="CVC", cell_size=10, strut_radius=1), (18, 18, 18))
    return (
        f"axes, {len(frame.struts):,} struts",
        0.0,
        lambda: write_step_wireframe(frame, path) or 0.0,
    )


def rows() -> Iterator[str]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lattice.step"
        for case in (axes, exact, faceted):
            name, mesh_volume, write = case(path)
            start = time.perf_counter()
            volume = write()
            seconds = time.perf_counter() - start
            found = read_back(path)
            apart = abs(found["volume"] / volume - 1) if volume else 0.0
            against = f"{100 * (volume / mesh_volume - 1):+.3f} %" if volume else ""
            yield (
                f"| {name} | {seconds:.2f} | {path.stat().st_size / 1e6:.1f} "
                f"| {found['seconds']:.1f} | {found['solids']:.0f} | {bool(found['valid'])} "
                f"| {bool(found['closed'])} | {apart:.1e} | {against} |"
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "files.md")
    options = parser.parse_args()
    columns = (
        "file", "s to write", "MB", "s to read", "solids", "valid", "closed", "volume read",
        "against the mesh",
    )  # fmt: skip
    lines = [f"| {' | '.join(columns)} |", f"|{'---|' * len(columns)}"]
    print("\n".join(lines), flush=True)
    for line in rows():
        lines.append(line)
        print(line, flush=True)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
