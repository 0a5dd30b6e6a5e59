# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams with stiff ends beside solid elements: how far apart their displacements are.

    python -m bench.beams [--cells CVC Box] [--ratios 0.05 0.1] [--out build/beams.md]

A block of 2 x 1 x 1 cells is held at the joints of one end and pulled, then pushed sideways, at
those of the other; the mean displacement there along the force is compared. The solid elements
are second-order tetrahedra inside the block's own triangles; at an end's joints all nodes inside
the balls are held, or carry the force in proportion to their share of the volume.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from volfrep import LatticeSpec
from volfrep.design.cells import PAPERS
from volfrep.fem.beam_mesh import JOINT_LENGTH, beam_model
from volfrep.fem.calculix import solve
from volfrep.fem.deck import write_beams, write_tetrahedra
from volfrep.fem.joint_loads import balls_of
from volfrep.fem.tet_mesh import TetrahedralMesh, tetrahedra
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.blocks import block, block_wireframe

from .static_step import StaticStep, joint_displacements, joint_step

ROOT = Path(__file__).resolve().parent.parent
Floats = np.ndarray
SIZE = 20.0
COUNT = (2, 1, 1)
FORCE = 100.0
LOADS = {"pulled": (FORCE, 0.0, 0.0), "sideways": (0.0, 0.0, FORCE)}
#: Edges of facets in units of the radius.
FACET = 0.6


@dataclass(frozen=True)
class Ends:
    """The joints at the two ends of a block along x."""

    frame: Wireframe
    fixed: np.ndarray
    loaded: np.ndarray


def ends_of(spec: LatticeSpec, count: Sequence[int]) -> Ends:
    frame = block_wireframe(spec, count)
    x = frame.nodes[:, 0]
    return Ends(frame, np.flatnonzero(x < x.min() + 1e-6), np.flatnonzero(x > x.max() - 1e-6))


def beam_displacements(
    ends: Ends, force: tuple[float, float, float], folder: Path, joint_length: float = JOINT_LENGTH
) -> Floats:
    """(loaded, 3) mm."""
    model = beam_model(ends.frame, joint_length=joint_length)
    write_beams(model, folder / "beams.inp")
    step = StaticStep(ends.fixed, ends.loaded, force)
    step.add_to(folder / "beams.inp", of_beams=True)
    return solve(folder / "beams.inp")[ends.loaded]


def solid_displacements(
    ends: Ends, filled: TetrahedralMesh, force: tuple[float, float, float], folder: Path
) -> Floats:
    """(loaded, 3) mm: the mean over each joint's ball."""
    fixed, loaded = (balls_of(filled, ends.frame, rows) for rows in (ends.fixed, ends.loaded))
    write_tetrahedra(filled, folder / "solid.inp")
    joint_step(fixed, loaded, force).add_to(folder / "solid.inp", of_beams=False)
    return joint_displacements(solve(folder / "solid.inp"), loaded)


def row(cell: str, ratio: float, folder: Path) -> str:
    """One cell and one ratio of radius to cell size."""
    spec = LatticeSpec(
        cell=cell, cell_size=SIZE, strut_radius=ratio * SIZE, resolution=round(1 / ratio / FACET)
    )
    ends = ends_of(spec, COUNT)
    start = time.perf_counter()
    filled = tetrahedra(block(spec, COUNT).mesh)
    shortest = np.linalg.norm(
        np.diff(ends.frame.nodes[ends.frame.struts], axis=1)[:, 0], axis=1
    ).min()
    columns = [cell, f"{ratio:g}", f"{ratio * SIZE / shortest:.3f}", f"{len(filled.nodes):,}"]
    for force in LOADS.values():
        way = int(np.argmax(force))
        solid = solid_displacements(ends, filled, force, folder)[:, way].mean()
        with_ends, bare = (
            beam_displacements(ends, force, folder, length)[:, way].mean()
            for length in (JOINT_LENGTH, 0.0)
        )
        columns += [f"{solid:.4f}", *(f"{100 * (u / solid - 1):+.0f} %" for u in (with_ends, bare))]
    columns.append(f"{time.perf_counter() - start:.0f}")
    return f"| {' | '.join(columns)} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--cells", nargs="+", choices=PAPERS, default=list(PAPERS))
    parser.add_argument("--ratios", nargs="+", type=float, default=[0.05, 0.075, 0.1])
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "beams.md")
    options = parser.parse_args()
    head = ["cell", "r/L", "r/strut", "nodes"]
    for name in LOADS:
        head += [f"{name}, mm", "beams", "bare beams"]
    head.append("s")
    lines = [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}"]
    print("\n".join(lines), flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for cell in options.cells:
            for ratio in options.ratios:
                lines.append(row(cell, ratio, Path(folder)))
                print(lines[-1], flush=True)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
