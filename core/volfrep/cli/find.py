# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep find``: cells by what they do.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse

from ..util.errors import VolfrepError
from .files import check_files


def run_find(given: argparse.Namespace) -> None:
    """Run ``volfrep find``."""
    from ..jobs.figures.find import direction_of, error_along, find_lattices
    from ..util.files import write_json

    check_files(given)
    if given.most < 1:
        raise VolfrepError(f"There must be at least one cell to tell, not {given.most}.")
    if given.plateau is not None:
        _find_cushions(given)
        return
    found = find_lattices(
        modulus=given.modulus,
        relative_density=given.relative_density,
        direction=given.direction,
        material=given.material,
        cell_size=given.cell_size,
    )
    if not found:
        raise VolfrepError(
            "No cell of the library has that: ask for another modulus, density or material."
        )
    if given.json is not None:
        write_json(given.json, [one.as_dict() for one in found])
    unit = "of the solid" if given.material is None else "MPa"
    way = direction_of(given.direction)
    heads = f"{'r, mm':>9}{'density':>10}{f'E along {given.direction}, {unit}':>32}"
    print(f"{'cell':<25}{heads}{'strength':>12}")
    for one in found[: given.most]:
        modulus = one.young(way)
        text = f"{modulus:.4g} +- {100.0 * error_along(one):.1f} %"
        print(
            f"{one.cell:<25}{one.strut_radius:>9.4g}{100.0 * one.relative_density:>8.2f} %"
            f"{text:>32}{one.values['strength']:>12.4g}"
        )
    if len(found) > given.most:
        print(f"and {len(found) - given.most} more: --most {len(found)} tells them all")


def _find_cushions(given: argparse.Namespace) -> None:
    """Print the cells whose crush curve has a plateau."""
    from dataclasses import asdict

    from ..mechanics.crush_curves import find_cushions
    from ..util.files import write_json

    if given.material is None or given.modulus is not None or given.relative_density is not None:
        raise VolfrepError("--plateau takes --material, and neither a modulus nor a density.")
    found = find_cushions(given.plateau, given.material)
    if not found:
        raise VolfrepError("No cell has that plateau: ask for another, or for another material.")
    if given.json is not None:
        write_json(given.json, [asdict(one) for one in found])
    print(f"{'cell':<25}{'r, mm':>9}{'density':>10}{'energy, mJ/mm3':>17}{'to a strain of':>17}")
    for one in found[: given.most]:
        print(
            f"{one.cell:<25}{one.ratio * given.cell_size:>9.4g}"
            f"{100.0 * one.relative_density:>8.2f} %{one.energy:>17.4g}{100.0 * one.end:>15.0f} %"
        )
