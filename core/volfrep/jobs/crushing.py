# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a lattice is crushed: the curve of a block between plates, its plateau and its energy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..design.cells import UnitCell, any_cell
from ..design.drawn_cell import DrawnCell
from ..design.parameters.keywords import as_cell
from ..design.spec import LatticeSpec
from ..fem.beam_mesh import BeamMesh, fitted_beams
from ..fem.deck import sides
from ..mechanics.corotational import SWINGING, Balance, Beams
from ..mechanics.crush_curves import PLATEAU_FROM, mean_stress, work
from ..mechanics.density import radius_of_density
from ..mechanics.density import relative_density as density_of
from ..mechanics.materials import SolidMaterial, find_material
from ..util.errors import VolfrepError
from ..util.numbers import number, whole
from ..util.progress import Monitor, ProgressCallback
from ..util.showing import Shown
from ..util.types import Floats
from .blocks import block_wireframe

MOST_STRAIN = 0.5
#: The slope of stress over plastic strain, in units of the yield stress: tables of printed
#: materials tell none, and metals and plastics have about this one.
HARDENING = 1.0
#: Elements between the stiff ends of a strut.
ELEMENTS = 4
#: How far nodes are off their places, in units of r, so that straight struts find their way to
#: buckle; the same ones in every run.
IMPERFECTION = 0.01
#: Steps of strain: the largest, where there is no way on, and how fast they grow: by so little that
#: none passes over the load at which a strut buckles.
LARGEST, LEAST, GROWTH = 0.01, 1e-5, 1.25
#: An element whose ends are turned so far against each other, radians, is folded.
FOLDED = 2.6
#: Drag on nodes that leave the block's even squeeze, in units of E r^2 / L: it carries a strut that
#: snaps through to its next balance, where none lies near; up to how many times ten where that does
#: not do; and the share of the work, %, from which on what it takes is told.
DRAG, MOST_DRAG, TOLD_DRAG = 1e-3, 4, 3.0


@dataclass(frozen=True, eq=False, repr=False)
class CrushCurve(Shown):
    """Stress over strain of a block of cells between two rough plates.

    Attributes:
        cell: its name.
        cell_size: L, mm.
        strut_radius: r, mm.
        count: cells along each edge of the block.
        material: of the struts.
        relative_density: of the endless lattice.
        strain: (k,) travel of the plate over the block's height, from 0.
        stress: (k,) force over the block's outline, MPa.
        notes: sentences on where the curve ends, and on what it leaves out.
    """

    cell: str
    cell_size: float
    strut_radius: float
    count: int
    material: SolidMaterial
    relative_density: float
    strain: Floats
    stress: Floats
    notes: tuple[str, ...] = ()

    @property
    def modulus(self) -> float:
        """The first slope, MPa."""
        return float(self.stress[1] / self.strain[1])

    @property
    def peak(self) -> tuple[float, float]:
        """Strain and stress (MPa) from where the curve falls first; its end if it never does."""
        falls = np.flatnonzero(np.diff(self.stress) < 0.0)
        place = int(falls[0]) if len(falls) else len(self.stress) - 1
        return float(self.strain[place]), float(self.stress[place])

    @property
    def plateau(self) -> float | None:
        """The mean stress from a strain of 20 % to the end, MPa; None where it ends before."""
        return mean_stress(self.strain, self.stress, PLATEAU_FROM)

    def energy_to(self, strain: float) -> float:
        """What is absorbed up to a strain, mJ/mm3 (MJ/m3)."""
        return work(self.strain, self.stress, strain)

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people."""
        strain, stress = self.peak
        end, plateau = float(self.strain[-1]), self.plateau
        mean = f"mean from {100 * PLATEAU_FROM:.0f} to {100 * end:.0f} %"
        return [
            ("cell", f"{self.cell}, {self.count} x {self.count} x {self.count}"),
            ("relative density", f"{self.relative_density:.4f}"),
            ("material", self.material.name),
            ("first slope", f"{self.modulus:.4g} MPa"),
            ("peak", f"{stress:.4g} MPa at a strain of {100 * strain:.1f} %"),
            ("plateau", "none" if plateau is None else f"{plateau:.4g} MPa, {mean}"),
            ("absorbed energy", f"{self.energy_to(end):.4g} mJ/mm3 to {100 * end:.0f} %"),
            ("not in it", "fracture, and contact of struts"),
        ]

    def table(self) -> str:
        """The curve as lines of a .csv file."""
        lines = [f"{e:.6g},{s:.6g}" for e, s in zip(self.strain, self.stress, strict=True)]
        return "\n".join(["strain,stress_MPa", *lines]) + "\n"

    def as_dict(self) -> dict[str, Any]:
        """The figures and the curve as plain JSON values."""
        strain, stress = self.peak
        return {
            "cell": self.cell,
            "cell_size_mm": self.cell_size,
            "strut_radius_mm": self.strut_radius,
            "count": self.count,
            "material": self.material.as_dict(),
            "relative_density": self.relative_density,
            "first_slope_MPa": self.modulus,
            "peak": {"strain": strain, "stress_MPa": stress},
            "plateau_MPa": self.plateau,
            "energy_mJ_per_mm3": self.energy_to(float(self.strain[-1])),
            "strain": self.strain.tolist(),
            "stress_MPa": self.stress.tolist(),
            "notes": list(self.notes),
        }


def crush(
    cell: str | UnitCell | DrawnCell | Mapping[str, Any],
    cell_size: float,
    strut_radius: float | None = None,
    *,
    relative_density: float | None = None,
    material: str | SolidMaterial,
    count: int = 3,
    strain: float = 0.3,
    progress: ProgressCallback | None = None,
) -> CrushCurve:
    """Crush a block of cells along z between two rough plates.

    Struts are beams that turn, buckle and yield (`mechanics.corotational`), with the ends that were
    fitted to the cell; a plastic strain of 1 adds the yield stress once more. They neither break
    nor touch each other, so that the steep end of a real curve, where the lattice is dense, is
    missing.

    Args:
        cell: as of `properties`; of struts.
        cell_size: L, mm.
        strut_radius: r, mm; or give `relative_density`.
        relative_density: of the endless lattice.
        material: of the struts, by name, file or itself; one without a yield stress stays elastic.
        count: cells along each edge of the block.
        strain: how far the plate goes, in units of the block's height.
        progress: called with the fraction done and the stage; returning False cancels.

    Raises:
        VolfrepError: a value makes no sense, or the cell is a TPMS.
        Cancelled: the callback said so.

    >>> found = crush("Kelvin", 10, 0.6, material="PA12", count=1, strain=0.02)
    >>> round(found.relative_density, 3)
    0.083
    """
    given = as_cell(cell)
    if isinstance(given, str):
        given = any_cell(given)
    solid = find_material(material) if isinstance(material, str) else material
    whole("cells along an edge", count, 1, 10)
    if number("strain", strain, "", positive=True) > MOST_STRAIN:
        raise VolfrepError(f"The strain must be above 0 and at most {MOST_STRAIN:g}.")
    if (strut_radius is None) == (relative_density is None):
        raise VolfrepError("Give either a strut radius or a relative density.")
    if relative_density is not None:
        number("relative density", relative_density, "", positive=True)
    first = 0.1 * cell_size if strut_radius is None else strut_radius
    spec = LatticeSpec(cell=given, cell_size=cell_size, strut_radius=first)
    wireframe = block_wireframe(spec, (count, count, count))
    unit = spec.unit_cell()
    if strut_radius is None:
        assert relative_density is not None
        strut_radius = cell_size * radius_of_density(unit, relative_density)
        wireframe = replace(wireframe, radii=strut_radius / first * wireframe.radii)
    model, notes = fitted_beams(
        wireframe, None, unit, cell_size, section="circle", elements_per_strut=ELEMENTS
    )
    strains, forces, ends = _press_plate(model, solid, cell_size, strain, Monitor(progress))
    area = float(np.prod(np.ptp(wireframe.nodes[:, :2], axis=0)))
    density = density_of(unit, strut_radius / cell_size).value
    return CrushCurve(
        unit.name,
        cell_size,
        strut_radius,
        count,
        solid,
        density,
        strains,
        forces / area,
        notes + ends,
    )


def _press_plate(
    mesh: BeamMesh, solid: SolidMaterial, cell_size: float, most: float, monitor: Monitor
) -> tuple[Floats, Floats, tuple[str, ...]]:
    """A plate comes down on beams.

    Returns:
        (k,) strains, (k,) forces, N, and sentences on why it ends before, and on what it lost.
    """
    beams = _beams(mesh, solid)
    plates = sides(mesh.nodes[: mesh.joints])
    bottom, top = plates["ZMIN"], plates["ZMAX"]
    low, high = float(mesh.nodes[bottom, 2].min()), float(mesh.nodes[top, 2].max())
    held = np.zeros(len(mesh.nodes), bool)
    held[bottom] = held[top] = True
    least = DRAG * solid.young * float(mesh.radii.min()) ** 2 / cell_size
    solver = Balance(beams, np.repeat(~held, 6))
    depth = (mesh.nodes[:, 2] - low) / (high - low)
    state, strain, level, lost = beams.at_rest(), 0.0, 0, 0.0
    step = min(0.25 * _buckling_strain(mesh), LARGEST)
    strains, forces = [0.0], [0.0]
    notes: tuple[str, ...] = ()
    with monitor.stage("crushing", 0.0, 1.0):
        while strain < most * (1.0 - 1e-9):
            monitor.tick(strain / most)
            step = min(step, most - strain)
            squeeze = np.zeros((len(mesh.nodes), 6))
            squeeze[:, 2] = -step * (high - low) * depth
            solver.drag = least * 10.0**level
            found = solver.step(state, squeeze)
            if found is None:
                step *= 0.5
                if step < LEAST:
                    level, step = level + 1, 8.0 * LEAST
                if level > MOST_DRAG:
                    notes += (f"No equilibrium was found beyond {100 * strain:.1f} %.",)
                    break
                continue
            ahead, reactions, corrections = found
            aside = ahead.places - state.places - squeeze[:, :3]
            lost += solver.drag * float((aside[~held] ** 2).sum())
            state = ahead
            strain += step
            strains.append(strain)
            forces.append(-float(reactions[top, 2].sum()))
            if float(beams.folds(state).max()) > FOLDED:
                notes += (
                    f"The curve ends at {100 * strain:.1f} %: a strut is folded, and would touch "
                    "itself.",
                )
                break
            if corrections <= SWINGING:
                step = min(GROWTH * step, LARGEST)
                level = max(level - 1, 0) if step > 0.1 * LARGEST else level
    if len(strains) == 1:
        raise VolfrepError("No equilibrium was found for the first step: use thinner struts.")
    share = 100.0 * lost / ((high - low) * work(np.array(strains), np.array(forces), strain))
    if share > TOLD_DRAG:
        notes += (f"Struts snap: {share:.0f} % of the work went into what slows them.",)
    return np.array(strains), np.array(forces), notes


def _buckling_strain(mesh: BeamMesh) -> float:
    """At which the most slender strut would buckle by itself, its ends free to turn (Euler)."""
    ends = mesh.nodes[mesh.elements]
    length = np.bincount(mesh.strut, np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)).max()
    return float((0.5 * np.pi * mesh.radii.min() / length) ** 2)


def _beams(mesh: BeamMesh, solid: SolidMaterial) -> Beams:
    """The beams of a lattice, whose own nodes are a little off their places."""
    nodes = mesh.nodes.copy()
    off = np.random.default_rng(0).uniform(-1.0, 1.0, (len(nodes), 3))
    nodes += IMPERFECTION * float(mesh.radii.min()) * off
    stiffer = np.array([ends.modulus for ends in mesh.ends])[mesh.section]
    young = solid.young * np.where(mesh.is_joint, stiffer, 1.0)
    limit = solid.yield_stress
    limits = np.where(mesh.is_joint, np.inf, np.inf if limit is None else limit)
    hardening = HARDENING * (limit or 0.0)
    radii = mesh.radii[mesh.section]
    return Beams(nodes, mesh.elements, radii, young, limits, solid.poisson, hardening)
