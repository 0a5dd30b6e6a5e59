# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finer facets where those that were asked for cannot be kept apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from ..design.spec import MAX_RESOLUTION, LatticeSpec
from ..octants.octant_mesh import FacetsCross

T = TypeVar("T")

#: So many times finer facets are tried in turn.
FINER = (1.1, 1.25, 1.4, 1.6, 2.0)


def until_sound(spec: LatticeSpec, make: Callable[[LatticeSpec], T]) -> tuple[T, tuple[str, ...]]:
    """Make a lattice, with finer facets where the facets of its octants would cross.

    Args:
        spec: what is wanted.
        make: makes it.

    Returns:
        What was made, and sentences for the user.

    Raises:
        FacetsCross: so they do with all of those that are tried.
    """
    try:
        return make(spec), ()
    except FacetsCross as error:
        first = error
    for factor in FINER:
        facets = math.ceil(factor * spec.facets_along_cell)
        if facets > MAX_RESOLUTION:
            break
        try:
            made = make(replace(spec, resolution=facets, deviation=None))
        except FacetsCross:
            continue
        note = (
            f"With {spec.facets_along_cell} facets along a cell some would run through each other "
            f"where struts meet: {facets} are made."
        )
        return made, (note,)
    raise first
