# SPDX-License-Identifier: LGPL-2.1-or-later
"""STEP, IGES and BREP, by way of FreeCAD in a process of its own.

It has an empty profile and opens no document, so that nothing in a file is executed. FreeCAD passes
over what it cannot resolve, so `step_text` looks first. The macro is data to the engine.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from ...mesh.topology import edges_of
from ...process.child import Limits, OverLimit
from ...process.programs import FREECAD, find_freecad, run_program
from ...util.errors import VolfrepError
from ...util.progress import Monitor
from ..repair.weld import weld_equal
from ..tessellation import ANGULAR_DEVIATION, MAX_DEVIATION, RELATIVE_DEVIATION
from .contents import Contents
from .ply import read_ply
from .step_text import refuse_damaged_step

STEP_SUFFIXES = (".step", ".stp")
#: FreeCAD runs it. As an .FCMacro the Addon Manager would copy it among the user's macros.
SCRIPT = Path(__file__).with_name("tessellate.FCScript")
MAX_SECONDS = 1800


def read_cad(data: bytes, file: Path, monitor: Monitor | None = None) -> Contents:
    """The solids of a CAD file, tessellated as FreeCAD's Lattice Infill does, in mm.

    FreeCAD runs with an empty profile and opens no document: nothing in the file is executed.

    Args:
        data: the whole file.
        file: where it is, for FreeCAD.
        monitor: asked for a cancel while FreeCAD runs.

    Raises:
        VolfrepError: FreeCAD is not there, or cannot make solids of the file.
        Cancelled: when the monitor says so; FreeCAD has been ended.
    """
    if file.suffix.lower() in STEP_SUFFIXES:
        refuse_damaged_step(data, file.name)
    program = find_freecad()
    if program is None:
        raise VolfrepError(
            f"Reading '{file.name}' needs FreeCAD, and there is no '{FREECAD[0]}' on the PATH: "
            "install FreeCAD, or convert the file to STL or 3MF first."
        )
    with tempfile.TemporaryDirectory(prefix="volfrep-") as folder:
        mesh = Path(folder) / "mesh.ply"
        # FreeCAD takes the kind of the file from its extension; arguments it would open itself.
        given = {
            "VOLFREP_SOURCE": str(file.resolve()),
            "VOLFREP_MESH": str(mesh),
            "VOLFREP_DEVIATIONS": f"{RELATIVE_DEVIATION} {MAX_DEVIATION} {ANGULAR_DEVIATION}",
            "FREECAD_USER_HOME": folder,
        }
        try:
            with (monitor or Monitor()).stage("reading", 0.0, 0.0) as watched:
                run_program(
                    [program, str(SCRIPT)],
                    Path(folder),
                    watched,
                    {**os.environ, **given},
                    Limits(MAX_SECONDS),
                )
        except OverLimit as error:
            raise VolfrepError(
                f"FreeCAD has not read '{file.name}' in {MAX_SECONDS / 60:.0f} minutes: export a "
                "simpler solid."
            ) from error
        except OSError as error:
            raise VolfrepError(f"'{program}' cannot be started: {error.strerror}.") from error
        said = mesh.with_name(mesh.name + ".txt")
        if said.is_file():
            text = said.read_text(encoding="utf-8").rstrip(".")
            raise VolfrepError(f"FreeCAD cannot make a solid of '{file.name}': {text}.")
        if not mesh.is_file():
            raise VolfrepError(
                f"FreeCAD failed while it read '{file.name}': open it in FreeCAD to see why."
            )
        contents = read_ply(mesh.read_bytes(), file.name)
        warned = mesh.with_name(mesh.name + ".invalid").is_file()
        united = mesh.with_name(mesh.name + ".united")
        notes = _union_notes(united.read_text(encoding="ascii"), file) if united.is_file() else ()
    if warned:
        edges = edges_of(weld_equal(contents.mesh))
        if not (edges.is_manifold and edges.is_closed):
            raise VolfrepError(
                f"FreeCAD finds faults in the geometry of '{file.name}', and its facets do not "
                "close: mend it there (Part > Check geometry) and export it again."
            )
    warning = f"FreeCAD finds faults in the geometry of '{file.name}' (Part > Check geometry)."
    return Contents(contents.mesh, "mm", notes + ((warning,) if warned else ()))


def _union_notes(counts: str, file: Path) -> tuple[str, ...]:
    """What is to be said of so many solids that became so many."""
    found, left = (int(word) for word in counts.split())
    return (
        f"'{file.name}' holds {found} solids that meet, which were united to "
        f"{'one' if left == 1 else left}.",
    )
