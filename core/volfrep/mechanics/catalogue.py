# SPDX-License-Identifier: LGPL-2.1-or-later
"""The library's cells over r / L, computed beforehand and shipped, and what lies between.

`make catalogue` computes what is missing (`tools/catalogue_cells.py`) and draws the charts.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..design.cells import LIBRARY, UnitCell
from ..design.tpms import PeriodicSurface
from ..util.errors import VolfrepError
from ..util.types import Floats
from .frame import CIRCLE, SQUARE_SECTION, Ends, JointLaw
from .homogenise import homogenise
from .joint_fit import fit_joint
from .materials import SolidMaterial
from .summary import MODULI, POISSON, CellProperties
from .summary import RATIOS as PURE_RATIOS
from .tensor import cubic, moduli

FILE = Path(__file__).with_name("catalogue.json")
#: Stiffness below this part of a tensor's largest is none.
_NOTHING = 1e-9
#: What is stored of a cell at each ratio, each with its error: in units of the solid's.
NAMES = ("relative_density", "C11", "C12", "C44", "strength", "shear_strength", "conductivity")
#: Of what the stiffness comes to, the relative errors are stored too; where they were not computed
#: they are bounded by those of the constants.
FIGURES = (*MODULI, *PURE_RATIOS)
#: The sections whose ends are stored: of the deck's two-noded beams, and the round ones of
#: FreeCAD's three-noded beams; and whether ends may be wider than their strut. Where round beams
#: of different width meet, CalculiX makes a rigid knot, which on the paper's sample weighs 6 %.
SECTIONS = {"square": SQUARE_SECTION, "circle": CIRCLE}
WIDEN = {"square": True, "circle": False}


@dataclass(frozen=True, eq=False)
class CatalogueCell:
    """A cell of the catalogue, at every r / L between its first and its last.

    Attributes:
        name: of the library's cell.
        ratios: (n,) r / L.
        values: (n, 7) by `NAMES`; of a cell that is not cubic the means over x, y and z.
        errors: (n, 7) by how much each may be off.
        doubts: (n, 7) by how much `FIGURES` may be off, as shares of them.
        ends: for each section (n, 3) length, axial and bending of the fitted ends.
        misfit: for each section (n, 4), see `joint_fit.JointFit`.
        tensors: (n, 6, 6) of a cell that is not cubic; (0, 6, 6) of one that is.
        tensor_errors: (n, 6, 6) by how much these may be off.
    """

    name: str
    ratios: Floats
    values: Floats
    errors: Floats
    doubts: Floats
    ends: dict[str, Floats]
    misfit: dict[str, Floats]
    tensors: Floats = field(default_factory=lambda: np.zeros((0, 6, 6)))
    tensor_errors: Floats = field(default_factory=lambda: np.zeros((0, 6, 6)))

    def at(self, ratio: float) -> dict[str, float]:
        """The values by name at an r / L: cubic splines through their logarithms.

        C11 and C12 go through the bulk modulus and the shear along a face's diagonal: neither
        vanishes, nor is a small difference of large ones.

        Raises:
            VolfrepError: the ratio lies outside the catalogue.
        """
        self._refuse(ratio)
        values = np.exp(self._log_values(np.log(ratio)))
        found = dict(zip(NAMES, values.tolist(), strict=True))
        shear, bulk = found["C11"], found["C12"]
        found["C11"], found["C12"] = bulk + 4.0 / 3.0 * shear, bulk - 2.0 / 3.0 * shear
        return {name: float(value) for name, value in found.items()}

    def tensor(self, ratio: float) -> Floats:
        """(6, 6) stiffness over the solid's E at an r / L.

        Of a cell that is not cubic by a spline through the matrices' logarithms, which for cubic
        ones is the same.
        """
        if not len(self.tensors):
            found = self.at(ratio)
            return cubic(found["C11"], found["C12"], found["C44"])
        self._refuse(ratio)
        values, axes = np.linalg.eigh(self._log_tensors(np.log(ratio)))
        result: Floats = (axes * np.exp(values)) @ axes.T
        return result

    def error_of_tensor(self, ratio: float) -> Floats:
        """(6, 6) by how much the stiffness at an r / L may be off."""
        place, places = np.log(ratio), np.log(self.ratios)
        if len(self.tensors):
            scale = np.abs(self.tensors).max(axis=(1, 2))
            shares = (self.tensor_errors / scale[:, None, None]).reshape(len(scale), 36)
            found = [np.interp(place, places, column) for column in shares.T]
            return np.reshape(found, (6, 6)) * float(np.abs(self.tensor(ratio)).max())
        values = self.at(ratio)
        return cubic(
            *(
                values[name]
                * float(np.interp(place, places, self.errors[:, k] / self.values[:, k]))
                for k, name in enumerate(NAMES[1:4], 1)
            )
        )

    def ratio_of_density(self, density: float) -> float:
        """The r / L of a relative density.

        Raises:
            VolfrepError: the density lies outside the catalogue.
        """
        known = self.values[:, 0]
        if not known[0] <= density <= known[-1]:
            raise VolfrepError(
                f"The catalogue knows {self.name} at relative densities from {known[0]:.3g} to "
                f"{known[-1]:.3g}, not {density:.4g}."
            )
        places = np.linspace(np.log(self.ratios[0]), np.log(self.ratios[-1]), 2001)
        logs = _spline(self.ratios, np.log(known))(places)
        return float(np.exp(np.interp(np.log(density), logs, places)))

    def radius_of_density(self, density: float, cell_size: float) -> float | None:
        """The radius in mm of a relative density; None where it lies outside the catalogue."""
        known = self.values[:, 0]
        if not known[0] <= density <= known[-1]:
            return None
        return cell_size * self.ratio_of_density(density)

    def joint(self, ratio: float, section: str = "circle") -> Ends:
        """The ends fitted to the cell at an r / L; outside the catalogue those of its border."""
        place = np.log(np.clip(ratio, self.ratios[0], self.ratios[-1]))
        logs = [
            np.interp(place, np.log(self.ratios), column) for column in np.log(self.ends[section]).T
        ]
        return Ends(*(float(value) for value in np.exp(logs)))

    def misfit_at(self, ratio: float, section: str = "circle") -> float:
        """The largest relative error of E along the edges that the ends leave at an r / L."""
        place = np.log(ratio)
        return float(np.interp(place, np.log(self.ratios), self.misfit[section][:, 0]))

    @cached_property
    def _log_values(self) -> Any:
        """(7,) logarithms of what `at` is made of, over the logarithm of r / L."""
        values = self.values.copy()
        along, across = self.values[:, 1], self.values[:, 2]
        values[:, 1], values[:, 2] = (along - across) / 2.0, (along + 2.0 * across) / 3.0
        return _spline(self.ratios, np.log(np.maximum(values, np.finfo(float).tiny)))

    @cached_property
    def _log_tensors(self) -> Any:
        """(6, 6) logarithm of the stiffness, over the logarithm of r / L."""
        values, vectors = np.linalg.eigh(self.tensors)
        values = np.log(np.maximum(values, _NOTHING * values[:, -1:]))
        return _spline(self.ratios, (vectors * values[:, None]) @ vectors.swapaxes(1, 2))

    def _refuse(self, ratio: float) -> None:
        if not self.ratios[0] * (1 - 1e-9) <= ratio <= self.ratios[-1] * (1 + 1e-9):
            raise VolfrepError(
                f"The catalogue knows {self.name} from r / L = {self.ratios[0]:g} to "
                f"{self.ratios[-1]:g}, not at {ratio:.4g}."
            )


def _spline(ratios: Floats, logs: Floats) -> Any:
    from scipy.interpolate import CubicSpline  # slow to load, and every job loads this module

    return CubicSpline(np.log(ratios), logs, bc_type="natural")


@lru_cache(maxsize=1)
def catalogue() -> dict[str, CatalogueCell]:
    """The shipped cells by name.

    Raises:
        VolfrepError: the file that ships with the package is missing or is not its own.
    """
    try:
        data = json.loads(FILE.read_text(encoding="utf-8"))
        return {
            name: CatalogueCell(
                name,
                np.array(cell["ratios"], float),
                np.array(cell["values"], float),
                np.array(cell["errors"], float),
                np.array(cell.get("doubts") or _bounds(cell["values"], cell["errors"]), float),
                {key: np.array(rows, float) for key, rows in cell["ends"].items()},
                {key: np.array(rows, float) for key, rows in cell["misfit"].items()},
                *(
                    _matrices(np.array(cell[key], float)) if key in cell else np.zeros((0, 6, 6))
                    for key in ("constants", "constant_errors")
                ),
            )
            for name, cell in data["cells"].items()
        }
    except (OSError, ValueError, KeyError) as error:
        raise VolfrepError(f"The catalogue '{FILE}' cannot be read: {error}.") from error


def _matrices(rows: Floats) -> Floats:
    """(n, 6, 6) symmetric, of (n, 21) upper triangles."""
    result = np.zeros((len(rows), 6, 6))
    one, two = np.triu_indices(6)
    result[:, one, two] = result[:, two, one] = rows
    return result


def _bounds(values: list[list[float]], errors: list[list[float]]) -> list[list[float]]:
    """By how much `FIGURES` may be off, relative, if the constants err each in the worst way."""

    def figures(constants: list[float]) -> Floats:
        found = moduli(cubic(*constants))
        return np.array([getattr(found, name) for name in FIGURES])

    rows = []
    for row, error in zip(values, errors, strict=True):
        plain, off = figures(row[1:4]), np.zeros(len(FIGURES))
        for k in range(3):
            constants = row[1:4]
            constants[k] += 0.01 * error[1 + k]  # no further: a small shear must stay one
            off += 100.0 * np.abs(figures(constants) - plain)
        rows.append((off / np.abs(plain)).tolist())
    return rows


def known_cell(cell: UnitCell | PeriodicSurface) -> CatalogueCell | None:
    """The catalogue's entry of a cell, if it is the library's own."""
    if LIBRARY.get(cell.name) != cell:
        return None
    return catalogue().get(cell.name)


def known_properties(
    cell: UnitCell,
    cell_size: float,
    strut_radius: float,
    material: SolidMaterial | None = None,
) -> CellProperties | None:
    """What the catalogue knows of a lattice without fillets, at once; None where it does not.

    Its solid has a Poisson's ratio of `POISSON`, whatever the material's.
    """
    ratio = strut_radius / cell_size
    known = known_cell(cell)
    if known is None or not known.ratios[0] <= ratio <= known.ratios[-1]:
        return None
    found, tensor = known.at(ratio), known.tensor(ratio)
    young = 1.0 if material is None else material.young
    limit = 1.0 if material is None or material.yield_stress is None else material.yield_stress
    figure = moduli(tensor)
    values = {
        name: float(getattr(figure, name)) * (young if name in MODULI else 1.0) for name in FIGURES
    }
    for name in ("strength", "shear_strength", "conductivity"):
        values[name] = found[name] * (limit if "strength" in name else 1.0)
    place, places = np.log(ratio), np.log(known.ratios)

    def share(column: Floats) -> float:
        return float(np.interp(place, places, column))

    errors: dict[str, Any] = {
        name: abs(values[name]) * share(known.doubts[:, k]) for k, name in enumerate(FIGURES)
    }
    shares = dict(zip(NAMES, shares_of(known.errors, known.values).T, strict=True))
    for name in ("strength", "shear_strength", "conductivity"):
        errors[name] = values[name] * share(shares[name])
    errors["relative_density"] = found["relative_density"] * share(shares["relative_density"])
    errors["stiffness"] = young * known.error_of_tensor(ratio)
    return CellProperties(
        cell.name,
        float(cell_size),
        float(strut_radius),
        0.0,
        found["relative_density"],
        material,
        young * tensor,
        values,
        errors,
        {},
        0,
    )


def shares_of(errors: Floats, values: Floats) -> Floats:
    """Errors as shares of what they belong to; none of what is zero."""
    some = np.abs(values) > np.finfo(float).tiny
    result: Floats = np.where(some, np.abs(errors / np.where(some, values, 1.0)), 0.0)
    return result


def joint_law(cell: UnitCell, cell_size: float, section: str = "circle") -> JointLaw:
    """How a cell stiffens the ends of struts of any radius, mm.

    Of the library's cells as the catalogue has it. Any other cell is homogenised and fitted when
    a radius is asked for, at the steps of r / L about it; that takes seconds and is kept while the
    program runs.

    Args:
        cell: the unit cell.
        cell_size: L, mm.
        section: of the beams: ``square`` (the deck's) or ``circle``.
    """
    known = known_cell(cell)
    if known is not None:
        return lambda radius: known.joint(radius / cell_size, section)
    key = (cell.nodes.tobytes(), cell.struts.tobytes())
    return lambda radius: _interpolate_ends(cell, key, radius / cell_size, section)


#: Fits of cells that are not the library's: by nodes, struts, step and section.
_FITTED: dict[tuple[bytes, bytes, int, str], Ends] = {}
#: Steps of r / L at which such cells are fitted: powers of this, within these.
_STEP, _THINNEST, _THICKEST = 1.4, 0.03, 0.25


def _interpolate_ends(cell: UnitCell, key: tuple[bytes, bytes], ratio: float, section: str) -> Ends:
    """Interpolated between the two steps about an r / L."""
    place = np.log(np.clip(ratio, _THINNEST, _THICKEST)) / np.log(_STEP)
    below = int(np.floor(place))
    logs = []
    for step in (below, below + 1):
        found = _FITTED.get((*key, step, section))
        if found is None:
            at = _STEP**step
            tensor = homogenise(cell, at, poisson=POISSON).tensor
            for name, kind in SECTIONS.items():
                fitted = fit_joint(cell, at, tensor, section=kind, widen=WIDEN[name])
                _FITTED[(*key, step, name)] = fitted.ends
            found = _FITTED[(*key, step, section)]
        logs.append(np.log([found.length, found.axial, found.bending]))
    share = place - below
    return Ends(*np.exp((1.0 - share) * logs[0] + share * logs[1]).tolist())
