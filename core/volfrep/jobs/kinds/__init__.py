# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kinds of lattice: how a part is filled with each, what blocks and previews of it are.

A kind is a module here and one in `volfrep.design.kinds`, and a row of either table.
"""

from __future__ import annotations

from ...design.kinds import graphs as graph_specs
from ...design.kinds.strut_cells import StrutCells
from ...design.kinds.tpms import Tpms
from ...design.spec import LatticeSpec
from ...design.spec_fields import Kind
from .graphs import GraphKind
from .kind import LatticeKind
from .strut_cells import StrutCellKind
from .tpms import TpmsKind

#: By what it is to a specification.
LATTICE_KINDS: dict[type[Kind], type[LatticeKind]] = {
    StrutCells: StrutCellKind,
    Tpms: TpmsKind,
    graph_specs.GraphOfFile: GraphKind,
    graph_specs.GraphOfPoints: GraphKind,
    graph_specs.CellsAsGraph: GraphKind,
}


def lattice_kind(spec: LatticeSpec) -> LatticeKind:
    """What the kind of a specification's lattice does with it."""
    return LATTICE_KINDS[type(spec.kind)](spec)
