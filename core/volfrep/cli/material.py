# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's choice of a material and a process: it fills density, print check and deck.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path
from typing import TYPE_CHECKING

from ..util.errors import VolfrepError
from .parameter_options import specification
from .solver_options import DECK_SUFFIX, is_deck, is_meshed
from .telling import print_warnings

if TYPE_CHECKING:
    from ..design.spec import LatticeSpec


def apply(options: argparse.Namespace, out: Path) -> tuple[str, ...]:
    """Look both up before any work, and fill in what the user has not said himself.

    `options.solid` becomes the material or None.

    Returns:
        Sentences for the user.

    Raises:
        VolfrepError: naming what is not known, or cannot be used for this file.
    """
    options.solid = None
    if options.material is not None:
        from ..mechanics.materials import find_material

        options.solid = find_material(options.material)
        if "," in options.material:
            # Without a density it says something about a deck only.
            if not is_deck(out):
                raise VolfrepError(
                    f"'{out}' cannot hold what --material asks for: give it the extension "
                    f"{DECK_SUFFIX}, or name a material with a density."
                )
        elif options.density is None:
            options.density = options.solid.density
    if options.process is None:
        return ()
    from ..reports.processes import find_process

    process = find_process(options.process)
    if options.print_report is None and is_meshed(options):
        options.print_report = process.name
    if options.solid is None or not options.solid.processes:
        return ()
    if process.name in options.solid.processes:
        return ()
    return (
        f"{options.solid.name} is printed by {' or '.join(options.solid.processes)}, not by "
        f"{process.name}.",
    )


def with_material_density(options: argparse.Namespace) -> LatticeSpec:
    """The specification, with the density of the material where none was given."""
    spec = specification(options)
    print_warnings(apply(options, Path(options.output)))
    if options.density is not None:
        spec = dataclasses.replace(spec, density=options.density)
    if options.solid is not None and spec.target is not None and spec.target.aim == "stiffness":
        target = dataclasses.replace(spec.target, young=options.solid.young)
        spec = dataclasses.replace(spec, target=target)
    return spec
