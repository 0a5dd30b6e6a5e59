# SPDX-License-Identifier: LGPL-2.1-or-later
"""The VOLFREP workbench: everything that knows FreeCAD.

Importing this package costs nothing: the engine (`volfrep`) and its packages are imported by the
first thing that computes.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

from . import checkout  # noqa: F401  (left out of archives)
from .saved_names import register_names

_HERE = Path(__file__).resolve().parent
ICONS = _HERE / "resources" / "icons"
#: Pages of help: inside the package as it is installed, beside it in a checkout.
DOCS = next(folder / "docs" for folder in (_HERE, _HERE.parent) if (folder / "docs").is_dir())

register_names()

_EXPORTS = {
    "make_lattice_infill": "freecad_volfrep.features.infill.factory",
    "make_solid": "freecad_volfrep.features.export.faceted_solid",
    "export_mesh": "freecad_volfrep.features.export.mesh_file",
    "make_print_check": "freecad_volfrep.features.reports.print_check",
    "make_slicer_infill": "freecad_volfrep.features.export.slicer_infill",
    "save_project": "freecad_volfrep.features.export.slicer_infill",
    "make_design_study": "freecad_volfrep.features.study.design_study",
    "run_study": "freecad_volfrep.features.study.design_study",
    "apply_design": "freecad_volfrep.features.study.design_study",
    "make_fem_analysis": "freecad_volfrep.features.export.fem_analysis",
    "size_lattice": "freecad_volfrep.features.sizing.sizing",
}
__all__ = [
    "DOCS",
    "ICONS",
    "apply_design",
    "export_mesh",
    "make_design_study",
    "make_fem_analysis",
    "make_lattice_infill",
    "make_print_check",
    "make_slicer_infill",
    "make_solid",
    "run_study",
    "save_project",
    "size_lattice",
]


def __getattr__(name: str) -> Any:
    if name not in _EXPORTS:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    # What is made is to be seen, whether or not FreeCAD has read InitGui.py.
    import_module("freecad_volfrep.window").register()
    return getattr(import_module(_EXPORTS[name]), name)
