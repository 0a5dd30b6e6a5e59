# SPDX-License-Identifier: LGPL-2.1-or-later
"""Retry of the octants' meshing: finer facets where those asked for cannot be kept apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from ..design.spec_parts import MAX_RESOLUTION
from ..octants.octant_mesh import FacetsCross
from ..octants.octant_spec import OctantSpec

T = TypeVar("T")

#: So many times finer facets are tried in turn.
FINER = (1.1, 1.25, 1.4, 1.6, 2.0)


def until_sound(
    octant_spec: OctantSpec, make: Callable[[OctantSpec], T]
) -> tuple[T, OctantSpec, tuple[str, ...]]:
    """Mesh octants, with finer facets where those that were asked for would cross.

    Args:
        octant_spec: what the octants are wanted for.
        make: meshes them.

    Returns:
        What was made, what it was made for, and sentences for the user.

    Raises:
        FacetsCross: so they do with all of those that are tried.
    """
    try:
        return make(octant_spec), octant_spec, ()
    except FacetsCross as error:
        first = error
    for factor in FINER:
        facets = math.ceil(factor * octant_spec.facets)
        if facets > MAX_RESOLUTION:
            break
        finer = replace(octant_spec, facets=facets)
        try:
            made = make(finer)
        except FacetsCross:
            continue
        note = (
            f"With {octant_spec.facets} facets along a cell some would run through each other: "
            f"{facets} are made."
        )
        return made, finer, (note,)
    raise first
