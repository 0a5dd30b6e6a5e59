# SPDX-License-Identifier: LGPL-2.1-or-later
"""The library's cells over r / L, computed beforehand and shipped, and what lies between.

`python -m volfrep.mechanics.catalogue` computes it anew (`make catalogue` draws the charts too).
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..design.cells import LIBRARY, PAPERS, UnitCell
from ..util.errors import VolfrepError
from ..util.types import Floats
from .frame import CIRCLE, SQUARE_SECTION, Ends, JointLaw
from .homogenise import homogenise
from .joint_fit import JointFit, fit_joint
from .materials import SolidMaterial
from .summary import MODULI, POISSON, CellProperties, cell_properties
from .summary import RATIOS as PURE_RATIOS
from .tensor import cubic, moduli

FILE = Path(__file__).with_name("catalogue.json")
#: r / L of the catalogue; and the density above which struts are hardly struts any more.
RATIOS = (0.02, 0.03, 0.04, 0.05, 0.07, 0.1, 0.125, 0.15, 0.2)
DENSEST = 0.75
#: The paper's six are known at all of these, the others at fewer.
FEWER_RATIOS = (0.03, 0.05, 0.07, 0.1, 0.15)
#: A cell is listed where its tensor differs from a cubic one by less than this share of C11.
CUBIC_WITHIN = 0.03
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
        values: (n, 7) by `NAMES`.
        errors: (n, 7) by how much each may be off.
        doubts: (n, 7) by how much `FIGURES` may be off, as shares of them.
        ends: for each section (n, 3) length, axial and bending of the fitted ends.
        misfit: for each section (n, 4), see `joint_fit.JointFit`.
    """

    name: str
    ratios: Floats
    values: Floats
    errors: Floats
    doubts: Floats
    ends: dict[str, Floats]
    misfit: dict[str, Floats]

    def at(self, ratio: float) -> dict[str, float]:
        """The values by name at an r / L: cubic splines through their logarithms.

        C11 and C12 go through the bulk modulus and the shear along a face's diagonal: neither
        vanishes, nor is a small difference of large ones.

        Raises:
            VolfrepError: the ratio lies outside the catalogue.
        """
        self._refuse(ratio)
        values = np.exp(_spline(self.ratios, self._logs())(np.log(ratio)))
        found = dict(zip(NAMES, values.tolist(), strict=True))
        shear, bulk = found["C11"], found["C12"]
        found["C11"], found["C12"] = bulk + 4.0 / 3.0 * shear, bulk - 2.0 / 3.0 * shear
        return {name: float(value) for name, value in found.items()}

    def tensor(self, ratio: float) -> Floats:
        """(6, 6) stiffness over the solid's E at an r / L."""
        found = self.at(ratio)
        return cubic(found["C11"], found["C12"], found["C44"])

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

    def joint(self, ratio: float, section: str = "circle") -> Ends:
        """The ends fitted to the cell at an r / L; outside the catalogue those of its border."""
        place = np.log(np.clip(ratio, self.ratios[0], self.ratios[-1]))
        logs = [
            np.interp(place, np.log(self.ratios), column) for column in np.log(self.ends[section]).T
        ]
        return Ends(*(float(value) for value in np.exp(logs)))

    def _logs(self) -> Floats:
        values = self.values.copy()
        along, across = self.values[:, 1], self.values[:, 2]
        values[:, 1], values[:, 2] = (along - across) / 2.0, (along + 2.0 * across) / 3.0
        logs: Floats = np.log(values)
        return logs

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
            )
            for name, cell in data["cells"].items()
        }
    except (OSError, ValueError, KeyError) as error:
        raise VolfrepError(f"The catalogue '{FILE}' cannot be read: {error}.") from error


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


def known_cell(cell: UnitCell) -> CatalogueCell | None:
    """The catalogue's entry of a cell, if it is the library's own."""
    library = LIBRARY.get(cell.name)
    if library is None or not (
        np.array_equal(library.nodes, cell.nodes) and np.array_equal(library.struts, cell.struts)
    ):
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
    shares = dict(zip(NAMES, (known.errors / known.values).T, strict=True))
    for name in ("strength", "shear_strength", "conductivity"):
        errors[name] = values[name] * share(shares[name])
    errors["relative_density"] = found["relative_density"] * share(shares["relative_density"])
    errors["stiffness"] = young * cubic(
        *(found[name] * share(shares[name]) for name in ("C11", "C12", "C44"))
    )
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
    return lambda radius: _fitted(cell, key, radius / cell_size, section)


#: Fits of cells that are not the library's: by nodes, struts, step and section.
_FITTED: dict[tuple[bytes, bytes, int, str], Ends] = {}
#: Steps of r / L at which such cells are fitted: powers of this, within these.
_STEP, _THINNEST, _THICKEST = 1.4, 0.03, 0.25


def _fitted(cell: UnitCell, key: tuple[bytes, bytes], ratio: float, section: str) -> Ends:
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


def is_listed(cell: UnitCell) -> bool:
    """Whether three constants say all of a cell's stiffness: it is cubic, and carries in shear."""
    try:
        found = homogenise(cell, FEWER_RATIOS[1], poisson=POISSON, along=32).tensor
    except VolfrepError:  # it does not hang together
        return False
    cubic_part = cubic(
        found[:3, :3].trace() / 3.0,
        (found[0, 1] + found[0, 2] + found[1, 2]) / 3.0,
        found[3:, 3:].trace() / 3.0,
    )
    return bool(np.abs(found - cubic_part).max() < CUBIC_WITHIN * found[0, 0])


def compute(name: str, say: Callable[[str], None] = lambda _: None) -> CatalogueCell:
    """A cell of the library over its ratios, as far as its density allows."""
    cell = LIBRARY[name]
    ratios, values, errors, doubts = [], [], [], []
    for ratio in RATIOS if name in PAPERS else FEWER_RATIOS:
        row, error, doubt = point(cell, ratio)
        if row[0] > DENSEST:
            break
        ratios.append(ratio)
        values.append(row)
        errors.append(error)
        doubts.append(doubt)
        say(f"{name} r/L {ratio:g}: density {row[0]:.4f}, C11 {row[1]:.5g}, C44 {row[3]:.5g}")
    return refitted(
        CatalogueCell(
            name, np.array(ratios), np.array(values), np.array(errors), np.array(doubts), {}, {}
        )
    )


def refitted(known: CatalogueCell) -> CatalogueCell:
    """The same cell with its ends fitted anew, each beginning at those of the radius before."""
    cell = LIBRARY[known.name]
    ends: dict[str, Floats] = {}
    misfit: dict[str, Floats] = {}
    for key, section in SECTIONS.items():
        fits: list[JointFit] = []
        for ratio, row in zip(known.ratios.tolist(), known.values, strict=True):
            fits.append(
                fit_joint(
                    cell,
                    ratio,
                    cubic(*row[1:4]),
                    section=section,
                    widen=WIDEN[key],
                    start=fits[-1].ends if fits else None,
                )
            )
        ends[key] = np.array([[f.ends.length, f.ends.axial, f.ends.bending] for f in fits])
        misfit[key] = np.array([f.misfit for f in fits])
    return replace(known, ends=ends, misfit=misfit)


def point(cell: UnitCell, ratio: float) -> tuple[list[float], list[float], list[float]]:
    """The values by `NAMES` of one cell and r / L, their errors, and the relative of `FIGURES`."""
    found = cell_properties(cell, 1.0, ratio)
    places = ((0, 0), (0, 1), (3, 3))
    values = [found.relative_density, *(float(found.stiffness[place]) for place in places)]
    errors = [
        found.errors["relative_density"],
        *(float(found.errors["stiffness"][place]) for place in places),
    ]
    for name in NAMES[4:]:
        values.append(found.values[name])
        errors.append(found.errors[name])
    return values, errors, [abs(found.errors[name] / found.values[name]) for name in FIGURES]


def main(arguments: list[str]) -> None:
    """Compute the cells named, or all, and write the file anew with the others as they were.

    With ``--fit`` only the ends are fitted anew, to the stiffness that is known.
    """
    data = json.loads(FILE.read_text(encoding="utf-8"))
    known: dict[str, Any] = data["cells"]
    names = [name for name in arguments if name != "--fit"]
    if "--fit" in arguments:
        for name in names or list(known):
            known[name].update(_fits(refitted(catalogue()[name])))
    else:
        for name in names or [name for name, cell in LIBRARY.items() if is_listed(cell)]:
            cell = compute(name, lambda text: print(text, flush=True))
            known[name] = {
                "ratios": cell.ratios.tolist(),
                "values": _short(cell.values),
                "errors": _short(cell.errors, 2),
                "doubts": _short(cell.doubts, 2),
                **_fits(cell),
            }
    data["cells"] = {name: known[name] for name in LIBRARY if name in known}
    FILE.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


def _fits(cell: CatalogueCell) -> dict[str, Any]:
    return {
        "ends": {key: _short(rows, 4) for key, rows in cell.ends.items()},
        "misfit": {key: _short(rows, 2) for key, rows in cell.misfit.items()},
    }


def _short(rows: Floats, digits: int = 6) -> list[list[float]]:
    return [[float(f"{value:.{digits}g}") for value in row] for row in rows]


if __name__ == "__main__":
    main(sys.argv[1:])
