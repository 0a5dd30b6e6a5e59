# SPDX-License-Identifier: LGPL-2.1-or-later
"""VOLFREP: strut-and-node lattice infills for solids.

`fill` and `block` make a `Part`, `sweep` many designs, `solve` says what any solid carries,
`homogenise` what a part of any number of cells does. The names below are loaded when first used,
so that importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .util.version import VERSION

if TYPE_CHECKING:
    from .api import (
        Part,
        as_solid,
        bare_surface,
        block,
        coupons,
        fill,
        homogenise,
        mesh_network,
        orient,
        size,
        slice_layers,
        slicer_infill,
        solve,
    )
    from .design.cells import make_cell
    from .design.drawn_cell import cell_from_lines
    from .design.parameters.spec_file import read_spec, write_spec
    from .design.spec import LatticeSpec
    from .io.solid import read_solid
    from .jobs.blocks import write_block_stl
    from .jobs.crushing import crush
    from .jobs.figures.find import find_lattices as find
    from .jobs.figures.properties import lattice_properties as properties
    from .mechanics.summary import CellProperties
    from .mesh.triangle_mesh import TriangleMesh
    from .reports.report import Report
    from .reports.result import Result
    from .studies.sampling import Range
    from .studies.study import Front, Study, read_study
    from .studies.sweep import evaluate, sweep
    from .util.cache import StageCache
    from .util.errors import Cancelled, VolfrepError

__version__ = VERSION

#: Where each name is, and what it is called there if that is another name.
_HOMES = {
    "Cancelled": "util.errors",
    "VolfrepError": "util.errors",
    "TriangleMesh": "mesh.triangle_mesh",
    "Result": "reports.result",
    "CellProperties": "mechanics.summary",
    "properties": "jobs.figures.properties:lattice_properties",
    "StageCache": "util.cache",
    "Part": "api.part",
    "cell_from_lines": "design.drawn_cell",
    "make_cell": "design.cells",
    "as_solid": "api.calls",
    "bare_surface": "api.calls",
    "block": "api.calls",
    "coupons": "api.calls",
    "crush": "jobs.crushing:crush",
    "evaluate": "studies.sweep",
    "sweep": "studies.sweep",
    "Front": "studies.study",
    "Range": "studies.sampling",
    "Study": "studies.study",
    "read_study": "studies.study",
    "fill": "api.calls",
    "homogenise": "api.calls",
    "find": "jobs.figures.find:find_lattices",
    "size": "api.calls",
    "mesh_network": "api.calls",
    "orient": "api.calls",
    "slice_layers": "api.calls",
    "slicer_infill": "api.calls",
    "solve": "api.calls",
    "Report": "reports.report",
    "read_solid": "io.solid",
    "LatticeSpec": "design.spec",
    "read_spec": "design.parameters.spec_file",
    "write_spec": "design.parameters.spec_file",
    "write_block_stl": "jobs.blocks",
}

__all__ = [
    "Cancelled",
    "CellProperties",
    "Front",
    "LatticeSpec",
    "Part",
    "Range",
    "Report",
    "Result",
    "StageCache",
    "Study",
    "TriangleMesh",
    "VolfrepError",
    "as_solid",
    "bare_surface",
    "block",
    "cell_from_lines",
    "coupons",
    "crush",
    "evaluate",
    "fill",
    "find",
    "homogenise",
    "make_cell",
    "mesh_network",
    "orient",
    "properties",
    "read_solid",
    "read_spec",
    "read_study",
    "size",
    "slice_layers",
    "slicer_infill",
    "solve",
    "sweep",
    "write_block_stl",
    "write_spec",
]


def __dir__() -> list[str]:
    return [*__all__, "__version__"]


def __getattr__(name: str) -> Any:
    from .util.deprecation import NAMES, current_name

    name = current_name(name, NAMES)
    if name not in _HOMES:
        raise AttributeError(f"module 'volfrep' has no attribute '{name}'")
    module, _, own = _HOMES[name].partition(":")
    return getattr(import_module(f".{module}", __name__), own or name)
