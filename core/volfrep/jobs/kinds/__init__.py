# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kinds of lattice: how a part is filled with each, what blocks and previews of it are.

A kind is a module here and one in `volfrep.design.kinds`, and a row of either table.
"""

from __future__ import annotations

from importlib import import_module

from ...design.cells import UnitCell
from ...design.kinds import KINDS
from ...design.kinds import graphs as graph_specs
from ...design.kinds.strut_cells import StrutCells
from ...design.kinds.tpms import Tpms
from ...design.spec import LatticeSpec
from ...design.spec_fields import Kind
from ...design.tpms import PeriodicSurface
from ...util.errors import VolfrepError, brief
from .kind import LatticeKind

#: Module and class, by what the kind is to a specification; loaded when the first one is made.
LATTICE_KINDS: dict[type[Kind], tuple[str, str]] = {
    StrutCells: (f"{__name__}.strut_cells", "StrutCellKind"),
    Tpms: (f"{__name__}.tpms", "TpmsKind"),
    graph_specs.GraphOfFile: (f"{__name__}.graphs", "GraphKind"),
    graph_specs.GraphOfPoints: (f"{__name__}.graphs", "GraphKind"),
    graph_specs.CellsAsGraph: (f"{__name__}.graphs", "GraphKind"),
}


def lattice_kind(spec: LatticeSpec) -> LatticeKind:
    """What the kind of a specification's lattice does with it."""
    return _load(type(spec.kind))(spec)


def kind_of_cell(cell: UnitCell | PeriodicSurface) -> type[LatticeKind]:
    """The kind of lattice of a cell side by side."""
    kind = KINDS.get(type(cell))
    if kind is None:
        raise VolfrepError(f"The cell of a lattice cannot be {brief(cell)}.")
    return _load(kind)


def _load(kind: type[Kind]) -> type[LatticeKind]:
    module, name = LATTICE_KINDS[kind]
    loaded: type[LatticeKind] = getattr(import_module(module), name)
    return loaded
