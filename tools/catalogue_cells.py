# SPDX-License-Identifier: LGPL-2.1-or-later
"""The library's cells over r / L, homogenised one by one, for `volfrep.mechanics.catalogue`."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from volfrep.design.cells import LIBRARY, PAPERS, UnitCell
from volfrep.mechanics.catalogue import (
    FIGURES,
    FILE,
    NAMES,
    SECTIONS,
    WIDEN,
    CatalogueCell,
    catalogue,
    shares_of,
)
from volfrep.mechanics.homogenise import homogenise
from volfrep.mechanics.joint_fit import JointFit, fit_joint
from volfrep.mechanics.summary import POISSON, CellProperties, cell_properties
from volfrep.mechanics.tensor import cubic
from volfrep.util.errors import VolfrepError
from volfrep.util.types import Floats

#: r / L of the catalogue; and the density above which struts are hardly struts any more.
RATIOS = (0.02, 0.03, 0.04, 0.05, 0.07, 0.1, 0.125, 0.15, 0.2)
DENSEST = 0.75
#: The paper's six are known at all of these, the others at fewer.
FEWER_RATIOS = (0.03, 0.05, 0.07, 0.1, 0.15)
#: Struts that come to touch beside their joints (at 0.08) change stiffness within little; there
#: voxels tell them apart badly.
MORE_RATIOS = {"Re-entrant": (0.03, 0.04, 0.05, 0.06, 0.07, 0.1, 0.125, 0.15)}
#: Three constants say all of a tensor that differs from a cubic one by less than this share of its
#: largest entry; of any other all 21 are stored.
CUBIC_WITHIN = 0.01


def is_listed(cell: UnitCell) -> bool:
    """Whether a cell belongs in the catalogue: a cube of like struts that carries some load."""
    try:
        homogenise(cell, FEWER_RATIOS[1], poisson=POISSON, along=16)
    except VolfrepError:  # it does not hang together, or is no such cell
        return False
    return True


def compute(name: str, say: Callable[[str], None] = lambda _: None) -> CatalogueCell:
    """A cell of the library over its ratios, as far as its density allows."""
    cell = LIBRARY[name]
    ratios, rows = [], []
    for ratio in MORE_RATIOS.get(name, RATIOS if name in PAPERS else FEWER_RATIOS):
        found = cell_properties(cell, 1.0, ratio)
        if found.relative_density > DENSEST:
            break
        ratios.append(ratio)
        rows.append(point(found))
        row = rows[-1].values
        say(f"{name} r/L {ratio:g}: density {row[0]:.4f}, C11 {row[1]:.5g}, C44 {row[3]:.5g}")
    tensors = np.array([row.tensor for row in rows])
    off = np.array([row.tensor - cubic(*row.values[1:4]) for row in rows])
    is_cubic = np.abs(off).max() < CUBIC_WITHIN * np.abs(tensors).max()
    kept = slice(0, 0) if is_cubic else slice(None)
    return refitted(
        CatalogueCell(
            name,
            np.array(ratios),
            np.array([row.values for row in rows]),
            np.array([row.errors for row in rows]),
            np.array([row.doubts for row in rows]),
            {},
            {},
            tensors[kept],
            np.array([row.tensor_error for row in rows])[kept],
        )
    )


def refitted(known: CatalogueCell) -> CatalogueCell:
    """The same cell with its ends fitted anew, each beginning at those of the radius before."""
    cell = LIBRARY[known.name]
    ends: dict[str, Floats] = {}
    misfit: dict[str, Floats] = {}
    for key, section in SECTIONS.items():
        fits: list[JointFit] = []
        for ratio in known.ratios.tolist():
            fits.append(
                fit_joint(
                    cell,
                    ratio,
                    known.tensor(ratio),
                    section=section,
                    widen=WIDEN[key],
                    start=fits[-1].ends if fits else None,
                )
            )
        ends[key] = np.array([[f.ends.length, f.ends.axial, f.ends.bending] for f in fits])
        misfit[key] = np.array([f.misfit for f in fits])
    return replace(known, ends=ends, misfit=misfit)


@dataclass(frozen=True, eq=False)
class Point:
    """A cell at one r / L.

    Attributes:
        values, errors: (7,) by `NAMES`.
        doubts: (7,) relative errors of `FIGURES`.
        tensor, tensor_error: (6, 6).
    """

    values: Floats
    errors: Floats
    doubts: Floats
    tensor: Floats
    tensor_error: Floats


def point(found: CellProperties) -> Point:
    """What the catalogue keeps of a cell's properties, with means for the three constants."""
    tensor = 0.5 * (found.stiffness + found.stiffness.T)
    wrong = found.errors["stiffness"]
    values = [found.relative_density, *_means(tensor)]
    errors = [found.errors["relative_density"], *_means(wrong)]
    for name in NAMES[4:]:
        values.append(found.values[name])
        errors.append(found.errors[name])
    told, off = (
        np.array([source[name] for name in FIGURES]) for source in (found.values, found.errors)
    )
    return Point(
        np.array(values), np.array(errors), shares_of(off, told), tensor, 0.5 * (wrong + wrong.T)
    )


def _means(tensor: Floats) -> tuple[float, float, float]:
    """C11, C12 and C44, means over x, y and z."""
    direct, across = tensor[:3, :3].trace(), tensor[:3, :3].sum()
    return direct / 3.0, (across - direct) / 6.0, tensor[3:, 3:].trace() / 3.0


def main(arguments: list[str]) -> None:
    """Compute the cells named, or those that are missing, and write the file with the others.

    With ``--fit`` only the ends are fitted anew, to the stiffness that is known.
    """
    data = json.loads(FILE.read_text(encoding="utf-8"))
    known: dict[str, Any] = data["cells"]
    names = [name for name in arguments if name != "--fit"]
    if "--fit" in arguments:
        for name in names or list(known):
            known[name].update(_fits(refitted(catalogue()[name])))
    else:
        missing = [name for name in LIBRARY if name not in known and is_listed(LIBRARY[name])]
        for name in names or missing:
            known[name] = _entry(compute(name, lambda text: print(text, flush=True)))
    data["cells"] = {name: known[name] for name in LIBRARY if name in known}
    FILE.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


def _entry(cell: CatalogueCell) -> dict[str, Any]:
    """A cell as the file has it."""
    entry = {
        "ratios": cell.ratios.tolist(),
        "values": _short(cell.values),
        "errors": _short(cell.errors, 2),
        "doubts": _short(cell.doubts, 2),
    }
    if len(cell.tensors):
        above = (slice(None), *np.triu_indices(6))
        entry["constants"] = _short(cell.tensors[above])
        entry["constant_errors"] = _short(cell.tensor_errors[above], 2)
    return {**entry, **_fits(cell)}


def _fits(cell: CatalogueCell) -> dict[str, Any]:
    return {
        "ends": {key: _short(rows, 4) for key, rows in cell.ends.items()},
        "misfit": {key: _short(rows, 2) for key, rows in cell.misfit.items()},
    }


def _short(rows: Floats, digits: int = 6) -> list[list[float]]:
    return [[float(f"{value:.{digits}g}") for value in row] for row in rows]
