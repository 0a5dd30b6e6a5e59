# SPDX-License-Identifier: LGPL-2.1-or-later
"""VOLFREP: strut-and-node lattice infills for solids.

The names below are loaded when first used, so that importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .blocks import block, write_block_stl
    from .cache import StageCache
    from .errors import Cancelled, VolfrepError
    from .mesh import TriangleMesh
    from .pipeline import fill
    from .report import Report
    from .result import Result
    from .solid import read_solid
    from .spec import LatticeSpec

__version__ = "0.1.0"

_HOMES = {
    "Cancelled": "errors",
    "VolfrepError": "errors",
    "TriangleMesh": "mesh",
    "Result": "result",
    "StageCache": "cache",
    "block": "blocks",
    "fill": "pipeline",
    "Report": "report",
    "read_solid": "solid",
    "LatticeSpec": "spec",
    "write_block_stl": "blocks",
}

__all__ = [
    "Cancelled",
    "LatticeSpec",
    "Report",
    "Result",
    "StageCache",
    "TriangleMesh",
    "VolfrepError",
    "block",
    "fill",
    "read_solid",
    "write_block_stl",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'volfrep' has no attribute '{name}'")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)
