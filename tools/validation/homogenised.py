# SPDX-License-Identifier: LGPL-2.1-or-later
"""Homogenised parts of six cells across beside explicit beams, and a gyroid beside its mesh."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import trimesh

from volfrep import LatticeSpec
from volfrep.continuum.model import solve_continuum
from volfrep.design.cells import LIBRARY, PAPERS, UnitCell
from volfrep.design.tpms.sheet import TpmsSheet
from volfrep.io.solid import Solid, check_solid
from volfrep.jobs.homogenised import homogenise_part
from volfrep.jobs.infill import Infill
from volfrep.jobs.part_bricks import PartBricks, cell_law
from volfrep.jobs.pipeline import fill
from volfrep.jobs.sizing import solve_struts
from volfrep.jobs.solving import solve_solid
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.catalogue import catalogue, joint_law
from volfrep.mechanics.frame import frame_tensor
from volfrep.mechanics.joint_fit import periodic_frame
from volfrep.mechanics.materials import find_material
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing.tapered_beams import energies
from volfrep.util.types import Floats

Way = tuple[float | None, float | None, float | None]
#: What is held at one end and moved at the other, free to turn, mm.
MOVED: dict[str, Way] = {"pulled": (0.1, None, None), "sideways": (0.0, 0.0, 0.1)}
CELLS = (*PAPERS, "FCCz", "Cross")
WHOLE: dict[str, Any] = {"cell_size": 10, "shell": 0, "boundary": "whole", "activation": "inside"}
PA12 = find_material("PA12")


def block(x: float, y: float, z: float) -> Solid:
    """A box from the origin, mm."""
    shape = trimesh.creation.box((x, y, z))
    shape.apply_translation((x / 2, y / 2, z / 2))
    return check_solid(TriangleMesh(shape.vertices, shape.faces.astype(np.int32)), "box")


def end(x: float) -> InPlane:
    """The face at x."""
    return InPlane((x, 0, 0), (1, 0, 0))


def moved(length: float, displacement: Way, name: str = "pull") -> LoadCase:
    """One end held, the other moved, both free to turn."""
    free = (True, True, True)
    return LoadCase(name, (Support(end(0), turns=free), Support(end(length), displacement, free)))


def loaded(length: float, force: tuple[float, float, float] = (0, 0, -100.0)) -> LoadCase:
    """One end held, a force at the other."""
    return LoadCase("bend", (Support(end(0)),), (Force(end(length), force),))


def work_of_beams(solid: Solid, spec: LatticeSpec, case: LoadCase) -> float:
    """Work of a part's beams and shells, N mm."""
    model, found = solve_struts(solid, spec, LoadCases(PA12, (case,)))
    if case.loads:
        return float(found.compliance[0])
    own = model.problem.structure.beams
    flexibility = own.flexibility(model.problem.radii.of_struts(found.radii))
    return float((energies(found.forces, found.forces)[:, :, 0] * flexibility).sum())


def work_homogenised(solid: Solid, spec: LatticeSpec, case: LoadCase) -> float:
    """Work of a homogenised part, N mm."""
    made = homogenise_part(solid, spec, LoadCases(PA12, (case,)))
    return float(made.report["cases"][0]["work_nmm"])


def compared(solid: Solid, spec: LatticeSpec, case: LoadCase) -> float:
    """Work of the homogenised part over that of its beams and shells."""
    return work_homogenised(solid, spec, case) / work_of_beams(solid, spec, case)


def work_with_beams_tensor(solid: Solid, spec: LatticeSpec, case: LoadCase) -> float:
    """Work of a homogenised part, N mm, whose tensor is that of the endless lattice's beams."""
    cell, ratio = spec.kind.cube, spec.kind.thickness / spec.cell_size
    assert cell is not None
    loads = LoadCases(PA12, (case,))
    tensors = beams_tensor(cell, ratio)[None]
    bricks = PartBricks(Infill(solid, spec), loads, replace(cell_law(spec), tensors=tensors))
    radius = spec.kind.thickness
    model = bricks.model(lambda at: np.full(len(at), radius), graded=False)
    return solve_continuum(model, loads.cases)[0].work


def of_cell(cell: str, across: int = 6) -> dict[str, float]:
    """Errors of the work: bent under a skin of 2 mm (of displacements), pulled, sideways.

    Sideways also with the tensor of the beams: what is left is of the homogenised part itself.
    """
    length, width = 20.0 * across, 10.0 * across
    solid = block(length, width, width)
    skin = LatticeSpec(cell, cell_size=10, strut_radius=0.8, shell=2)
    found = {"bent": compared(solid, skin, loaded(length)) - 1.0}
    whole = LatticeSpec(cell, strut_radius=0.8, **WHOLE)
    for name, displacement in MOVED.items():
        case = moved(length, displacement)
        beams = work_of_beams(solid, whole, case)
        found[name] = work_homogenised(solid, whole, case) / beams - 1.0
        if name == "sideways":
            found["itself"] = work_with_beams_tensor(solid, whole, case) / beams - 1.0
    found["shear"] = shear_of_beams(cell) - 1.0
    return {name: float(f"{value:.3f}") for name, value in found.items()}


def beams_tensor(cell: UnitCell, ratio: float) -> Floats:
    """(6, 6) stiffness over the solid's E of the endless lattice's beams, with fitted ends."""
    law = joint_law(cell, 1.0, "circle")
    return frame_tensor(periodic_frame(cell), ratio, law(ratio))


def shear_of_beams(cell: str, ratio: float = 0.08) -> float:
    """Shear modulus zx of the endless lattice's beams, with fitted ends, over the solid's."""
    beams = beams_tensor(LIBRARY[cell], ratio)
    compliance = [
        np.linalg.inv(tensor)[4, 4] for tensor in (beams, catalogue()[cell].tensor(ratio))
    ]
    return float(compliance[1] / compliance[0])


def of_gyroid(voxel: float = 0.6) -> dict[str, float]:
    """Errors of the displacements of a cube of six cells, sheet 1.2 mm, beside its mesh on voxels.

    Beside those of that edge, mm, and beside their limit.
    """
    solid = block(60.0, 60.0, 60.0)
    spec = LatticeSpec("Gyroid", cell_size=10, wall=TpmsSheet("sheet", 1.2), shell=0)
    held = Support(end(0))
    ways = {"pulled": (100.0, 0.0, 0.0), "sideways": (0.0, 0.0, 100.0)}
    cases = tuple(
        LoadCase(name, (held,), (Force(end(60.0), force),)) for name, force in ways.items()
    )
    loads = LoadCases(PA12, cases)
    made = homogenise_part(solid, spec, loads).report["cases"]
    finer = solve_solid(fill(solid, spec).mesh, loads, voxel=voxel).report["cases"]
    found = {}
    for own, case in zip(made, finer, strict=True):
        for name, other in (("", case), (", limit", case["extrapolated"])):
            error = own["work_nmm"] / other["compliance_nmm"] - 1.0
            found[case["name"] + name] = float(f"{error:.3f}")
    return found
