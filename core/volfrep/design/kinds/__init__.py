# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kinds of lattice, as specifications have them: what is refused, what counts, facets, words.

How a solid is filled with one is in `volfrep.jobs.kinds`.
"""

from __future__ import annotations

from ...util.errors import VolfrepError, brief
from ..cells import UnitCell
from ..graphs import GivenGraph, RandomGraph, StretchedCells
from ..spec_fields import Kind, SpecFields
from ..tpms import PeriodicSurface
from .graphs import CellsAsGraph, GraphOfFile, GraphOfPoints
from .strut_cells import StrutCells
from .tpms import Tpms

__all__ = ["KINDS", "Kind", "kind_of"]

#: By the class of a specification's network or, where it has none, of its cell.
KINDS: dict[type, type[Kind]] = {
    UnitCell: StrutCells,
    PeriodicSurface: Tpms,
    GivenGraph: GraphOfFile,
    RandomGraph: GraphOfPoints,
    StretchedCells: CellsAsGraph,
}


def kind_of(spec: SpecFields) -> Kind:
    """The kind of lattice of a specification."""
    of = spec.cell if spec.network is None else spec.network
    kind = KINDS.get(type(of))
    if kind is None:
        what = "cell" if spec.network is None else "network"
        raise VolfrepError(f"The {what} of a lattice cannot be {brief(of)}.")
    return kind(spec)
