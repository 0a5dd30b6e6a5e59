# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block of 4 x 4 x 4 cells squeezed between two plates: as tetrahedra and as the deck's beams.

The block ends flat at the plates, in the middle of the struts that lie there, and round at its
sides. It equals its mirror images, so the tetrahedra are those of an eighth.
"""

import subprocess
from pathlib import Path

import manifold3d
import numpy as np

from volfrep import LatticeSpec, VolfrepError
from volfrep.fem.beam_mesh import BeamMesh, beam_model
from volfrep.fem.deck import sides, write_beams, write_tetrahedra
from volfrep.fem.tet_mesh import TetrahedralMesh, filled_by_gmsh
from volfrep.jobs.blocks import block, block_wireframe
from volfrep.mechanics.materials import Material
from volfrep.mesh.booleans import as_manifold, as_mesh
from volfrep.mesh.triangle_mesh import TriangleMesh

COUNT, SIZE, SQUEEZE = 4, 10.0, 0.01
#: Edges of facets in units of the radius, by r/L. Thick struts are mostly joints, whose creases
#: need small elements: with facets of 0.9 r at 0.15 solids come out 4 to 7 % stiffer than so.
FACETS = {0.05: 0.9, 0.1: 0.6, 0.15: 0.45}
SOLID = Material("SOLID", 1000.0, 0.3, 1.0)


def spec_of(cell, ratio, facet=None):
    facet = facet or FACETS[ratio]
    return LatticeSpec(
        cell=cell, cell_size=SIZE, strut_radius=ratio * SIZE,
        resolution=max(round(1 / ratio / facet), 8),
    )  # fmt: skip


def solid_force(cell, ratio, folder: Path, *, bonded=True, facet=None):
    """The force on a plate, N, of tetrahedra in CalculiX; and how many nodes they had."""
    spec = spec_of(cell, ratio, facet)
    whole = as_manifold(block(spec, (COUNT,) * 3).mesh)
    middle = COUNT * SIZE / 2
    box = manifold3d.Manifold.cube((middle + SIZE,) * 2 + (middle,)).translate((middle, middle, 0))
    filled, rough = shaken(as_mesh(whole ^ box))
    x, y, z = filled.nodes.T
    on = {
        name: np.flatnonzero(np.abs(places) <= rough + 1e-6)
        for name, places in (
            ("MIDX", x - middle), ("MIDY", y - middle), ("MIDZ", z - middle), ("PLATE", z)
        )
    }  # fmt: skip
    assert all(len(rows) for rows in on.values())
    path = folder / f"solid_{cell}_{ratio}.inp"
    write_tetrahedra(filled, path, SOLID, sets=on)
    held = "PLATE,1,2\n" if bonded else ""
    squeeze(path, f"MIDX,1,1\nMIDY,2,2\nMIDZ,3,3\n{held}PLATE,3,3,{SQUEEZE}\n")
    return 4 * abs(total_force(path, "PLATE")), len(filled.nodes)


def shaken(mesh: TriangleMesh) -> tuple[TetrahedralMesh, float]:
    """Tetrahedra, and by how much, mm, the vertices were moved at random first.

    Gmsh fails on some of these meshes, whose cut faces are exactly plane and mirror symmetric,
    and manages others that differ from them by a thousandth of a facet.
    """
    for seed, rough in enumerate((0.0, 0.001, 0.001, 0.002, 0.002, 0.004, 0.004, 0.008, 0.008)):
        moved = np.random.default_rng(seed).uniform(-rough, rough, mesh.vertices.shape)
        try:
            return filled_by_gmsh(TriangleMesh(mesh.vertices + moved, mesh.triangles)), rough
        except VolfrepError as error:
            said = error
    raise said


def beam_force(model: BeamMesh, folder: Path, *, bonded=True):
    """The force on a plate, N, of the deck's beams in CalculiX."""
    path = folder / "beams.inp"
    write_beams(model, path, SOLID)
    # Between smooth plates the joints slide, but turn about the vertical only.
    along = "1,2" if bonded else "3,3"
    turn = "4,6" if bonded else "4,5"
    pin = "" if bonded else "PIN,1,2\nSLIDE,1,1\n"
    text = path.read_text()
    if not bonded:
        bottom = sides(model.nodes[: model.joints])["ZMIN"]
        places = model.nodes[bottom]
        corner = bottom[np.lexsort(places[:, :2].T)[0]]
        other = bottom[np.lexsort((-places[:, 1], places[:, 0]))[0]]
        text += f"*NSET,NSET=PIN\n{corner + 1}\n*NSET,NSET=SLIDE\n{other + 1}\n"
        path.write_text(text)
    squeeze(
        path,
        f"ZMIN,{along}\nZMAX,{along}\nZMIN,{turn}\nZMAX,{turn}\n{pin}"
        f"ZMIN,3,3\nZMAX,3,3,{-2 * SQUEEZE}\n",
    )  # fmt: skip
    return abs(total_force(path, "ZMAX"))


def beams_of(cell, ratio, **options) -> BeamMesh:
    frame = block_wireframe(spec_of(cell, ratio), (COUNT,) * 3)
    return beam_model(frame, **options)


def squeeze(path: Path, held: str) -> None:
    plate = "PLATE" if "PLATE" in held else "ZMAX"
    step = f"*STEP\n*STATIC\n*BOUNDARY\n{held}*NODE PRINT,NSET={plate},TOTALS=ONLY\nRF\n*END STEP\n"
    path.write_text(path.read_text() + step)


def total_force(path: Path, plate: str) -> float:
    """The vertical force on a plate's nodes that CalculiX prints, N."""
    run = subprocess.run(["ccx", "-i", path.stem], cwd=path.parent, capture_output=True, text=True)
    lines = path.with_suffix(".dat").read_text().splitlines()
    for other in path.parent.glob(f"{path.stem}.*"):
        other.unlink()
    assert run.returncode == 0, run.stdout[-2000:]
    start = next(k for k, line in enumerate(lines) if "total force" in line and plate in line)
    return float(next(line.split() for line in lines[start + 1 :] if line.strip())[2])
